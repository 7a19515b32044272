"""A heavy roving accelerometer on rings of points: its load, and the FRFs without it."""

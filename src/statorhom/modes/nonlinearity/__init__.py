"""Hints that a mode is not linear: distorted Nyquist circle, asymmetric flanks, dependence on the level."""

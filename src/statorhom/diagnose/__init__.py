"""Says what physics a study's model left out: locates the mismatch, names it, fits it, and says how sure that is."""

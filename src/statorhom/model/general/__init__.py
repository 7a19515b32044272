"""Bodies without symmetry: one sparse problem of the whole mesh."""

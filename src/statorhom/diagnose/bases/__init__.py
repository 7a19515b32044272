"""Small bases in which a stator's modes are found again at other materials, and under what breaks its symmetry."""

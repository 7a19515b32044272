"""Stators whose symmetry something breaks, solved in the basis of the symmetric one."""

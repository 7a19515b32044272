"""Equivalent homogeneous materials of layered and fibrous ones, computed from their parts."""

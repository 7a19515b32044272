"""Sparse factorizations of symmetric positive definite matrices, one library a file."""

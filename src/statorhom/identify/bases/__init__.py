"""Reduced models that stand in for the mesh: over the prior, and around what a search found."""

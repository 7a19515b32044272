"""Simulated against measured frequencies: errors of the mesh, declared effects, and what each constant moves."""

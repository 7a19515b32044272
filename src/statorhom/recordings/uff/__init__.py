"""Universal files: tolerant of dialects when read, strict when written.

Formats of the datasets: documentation of the Structural Dynamics Research Laboratory, University of Cincinnati.
"""

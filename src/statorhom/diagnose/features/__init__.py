"""Measured against predicted, in standard deviations."""

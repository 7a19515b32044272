"""Identification of parameters from measurements: optimizers, polish, uncertainty."""

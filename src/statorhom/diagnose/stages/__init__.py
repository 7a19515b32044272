"""The tested steps of a study as models of their constants, and what acts on their frequencies."""

"""The best explanations: of one effect, of two, and where no ordinary refit gets to."""

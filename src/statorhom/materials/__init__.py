"""Materials: Hooke matrices, their symmetries, densities, and what is known before anything is measured."""

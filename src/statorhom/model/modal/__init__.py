"""A body with mirror planes in a basis of its own modes, where whatever breaks the symmetry is a small matrix."""

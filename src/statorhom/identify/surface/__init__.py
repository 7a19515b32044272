"""Response surfaces: designs of experiments, surfaces, the gate that they must pass, the search on them."""

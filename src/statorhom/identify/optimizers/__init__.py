"""Global optimizers behind one interface, and ensembles of them."""

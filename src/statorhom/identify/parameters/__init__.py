"""Constants with priors, ties and limits, and the coordinates that optimizers move."""

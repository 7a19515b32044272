"""From residuals and a prior to all optima, the posterior around them, and its intervals."""

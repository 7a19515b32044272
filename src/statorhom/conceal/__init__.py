"""Studies with a concealed effect: recordings of a true machine that differs from what the study says."""

"""Modal extraction: poles, damping, modal constants and complex shapes from measured receptances."""

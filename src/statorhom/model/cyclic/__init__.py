"""All harmonics of a stator at once: what they share is factorized once."""

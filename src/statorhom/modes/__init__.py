"""Mode shapes: spatial DFT, names (r, n), MAC, and the pairing of measured with simulated modes."""

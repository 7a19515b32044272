"""Measured and simulated modes at the result, side by side: frequencies, shapes, MAC."""

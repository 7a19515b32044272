"""What is independent in a diagnosis, side by side; what is dear, remembered."""

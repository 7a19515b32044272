"""What is independent in an identification, side by side; and what tells how far it is."""

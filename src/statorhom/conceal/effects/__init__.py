"""What can be concealed, one file each."""

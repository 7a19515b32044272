"""Recordings: what sensors wrote, from universal files, tables and time records to receptances."""

"""Sections of the report, one file each, in words that need no knowledge of the program."""

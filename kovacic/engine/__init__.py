"""Kovacic's three cases.  Each module decides one of them and returns what it found with what it excluded on the way."""

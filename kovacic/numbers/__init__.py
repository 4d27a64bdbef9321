"""Numbers: which exact number a user's object is (`exact`), and numbers of any length as text (`numerals`)."""

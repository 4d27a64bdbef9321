"""Input and output: the grammar and the readers of S, and the views of an answer.  No view imports another."""

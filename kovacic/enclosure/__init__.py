"""Values of solutions with proven error bounds; `evaluate` is the entry."""

"""What goes out: text, LaTeX, HTML, JSON, explanations, pictures."""

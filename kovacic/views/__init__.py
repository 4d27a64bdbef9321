"""The views of an answer: a `Solution` or its parts go in, text, LaTeX, HTML, JSON or a picture comes out.

`text`, `explain`, `theorem`, `json` and `plot` are the views; none imports another, but for the picture in an explanation.
They are made of `kovacic.writing` (formulas and documents), `sentences` (shared by several views), `steps` (Kovacic's steps,
found by `kovacic.engine.paper`) and `bibliography`.
"""

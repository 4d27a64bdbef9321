"""What goes out: an answer (a `Solution`, or its parts) goes in, text, LaTeX, HTML, JSON or a picture comes out.

`text`, `explain`, `json` and `plot` are the views, and none of them imports another.  They are made of `kovacic.writing`
(formulas and documents), `sentences` (what several views say of an answer), `steps` (Kovacic's steps, found by
`kovacic.engine.paper`), `products` (solutions without SymPy) and `bibliography`.
"""

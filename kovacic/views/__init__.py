"""What goes out: an answer (a `Solution`, or its parts) goes in, text, LaTeX, HTML, JSON or a picture comes out.

`text`, `explain`, `json` and `plot` are the views, and none of them imports another.  They are made of
`formula` (a function or place as text and as LaTeX: read this first), `sentences` (what several views say of an answer),
`document` (headings, formulas, tables, and their four renderings), `steps` (Kovacic's steps, found by `families`),
`products` (solutions without SymPy) and `bibliography`.
"""

"""What goes out: an answer (a `Solution`, or its parts) goes in, text, LaTeX, HTML, JSON or a picture comes out.

`text`, `explain`, `notebook`, `json` and `plot` are the views, and none of them imports another.  They are made of
`formula` (a function, place or equation as text and as LaTeX: read this first), `document` (headings, formulas, tables, and
their four renderings), `trace` (the derivation as data) and `bibliography`.
"""

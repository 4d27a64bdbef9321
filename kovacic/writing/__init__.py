"""Mathematics in writing: functions, places and documents as text, LaTeX, Markdown and HTML.

Nothing here knows of answers.  `formula` has a function or place as text and as LaTeX (read this first), `escaped` text from
outside, `document` headings, formulas and tables with their four renderings, `breaking` where a line of LaTeX may end, and
`maps` a picture of two parameters.
"""

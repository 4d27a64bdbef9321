"""Special functions: S goes in, two solutions in Airy's, Bessel's, Kummer's or Gauss' functions come out.

A file a standard equation: `airy`, `bessel`, `whittaker` and `gauss` have its S0, its pull-backs, how its solutions are written
and what their values are; `pullback.StandardEquation` says what such a file has to have, and `airy` is the one to read first.
`search` goes through them; it returns nothing that doesn't satisfy its identity exactly.  What they share: `maps`
finds functions f from the polar parts and from the exponents of S; `writer` writes.
`mathieu` is for coefficients that are waves.
"""

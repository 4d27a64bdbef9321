"""Special functions: S goes in, two solutions in Airy's, Bessel's, Kummer's or Gauss' functions come out.

`answer.special_functions` is the entry, and the module to read first.  Its `find` searches: `confluent` and `gauss` propose
pull-backs of the standard equations (`pullback`) from the polar parts and the exponents of S; none is returned that doesn't
satisfy its identity exactly.  `express` and `hypergeometric` write the solutions down, out of the parts in `writer`.
`mathieu` is for coefficients that are waves.
"""

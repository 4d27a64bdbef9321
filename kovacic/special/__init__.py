"""Special functions: S goes in, two solutions in Airy's, Bessel's, Kummer's or Gauss' functions come out.

`answer.special_functions` is the entry, and the module to read first.  `find.find` searches: `confluent` and `gauss` propose
pull-backs of the standard equations (`pullback`) from the polar parts (`polar`) and the exponents of S; none is returned that
doesn't satisfy its identity exactly.  `express` lets `bessel`, `kummer` and `hypergeometric` write the solutions down, out of
the parts in `writer`, and checks them as they are shown.  `wronskian` serves those who need constants and integrals.
"""

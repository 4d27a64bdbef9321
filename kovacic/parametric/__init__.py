"""For which values of the parameters does y'' = S y have Liouvillian solutions?

In goes S over Q(t1, ..., tk), out comes `Conditions`: the partition of parameter space into regions, each an exact statement
with Kovacic's case, and whether the list is proven to be complete.  Read `api` first, then `partition`.
- `answer`: what is returned, with views and points, made of `regions`; `check` compares it with the engine, `plot` draws it;
- `assumptions`: what is known about parameters; `functions`: factors of functions of the parameters; `formulas` and `spectra`:
  how these and statements about integers are written;
- `statements`, `integers`, `natural`: exact conditions on the parameters, which can be evaluated at every algebraic point, and
  determinants Delta_d; `record` writes and reads them as data;
- `partition`: the theory that applies, regions, their order, and why they are complete;
- `riemann`: at most three regular singular points (Kimura's theorem with Schwarz's table);
- `confluent`: one irregular singular point and at most one more, with two or three terms (Whittaker, Bessel, Weber, Airy);
- `quotient`: symmetric equations whose quotient by a cyclic group of Moebius maps has at most three singular points;
- `search`: everything else, through the `exponents` and `ranks`: polynomial conditions, or those with a natural number;
- `solutions`: formulas for the solutions in a region, for all parameters or for one natural number;
- `generic` and `restriction`: where S itself changes, and S there; algebraic constants beside parameters.
"""

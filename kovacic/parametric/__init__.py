"""For which values of the parameters does y'' = S y have Liouvillian solutions?

`conditions` gives the partition of parameter space; its parts are
- `answer`: what it returns, with views and the check against the engine;
- `assumptions` and `slices`: what is known about parameters, and algebraic constants beside them;
- `statements`: exact conditions on the parameters, which can be evaluated at every algebraic point;
- `riemann`: at most three regular singular points (Kimura's theorem with Schwarz's table);
- `confluent`: one irregular singular point and at most one more, with two or three terms (Whittaker, Bessel, Weber, Airy);
- `bounded`: exponents that don't depend on the parameter, so that every unknown has a bounded degree;
- `search`: everything else, up to a degree;
- `degenerate` and `restriction`: where S itself changes, and S there;
- `partition`: the theory that applies, regions, their order, and why they are complete.
"""

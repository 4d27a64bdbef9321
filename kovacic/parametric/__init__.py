"""For which values of the parameters does y'' = S y have Liouvillian solutions?

`conditions` gives the partition of parameter space; its parts are
- `statements`: exact conditions on the parameters, which can be evaluated at every algebraic point;
- `riemann`: at most three regular singular points (Kimura's theorem with Schwarz's table);
- `confluent`: one irregular singular point and at most one more, with two or three terms (Whittaker, Bessel, Weber, Airy);
- `bounded`: exponents that don't depend on the parameter, so that every unknown has a bounded degree;
- `search`: everything else, up to a degree;
- `partition`: regions, their order, and the degenerate values.
"""

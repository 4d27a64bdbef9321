"""Values of solutions with proven error bounds.

In goes an equation (text, S, an `Equation` or a `Solution`), a path and initial values; out comes a `Ball`, a midpoint and a
radius, that contains the exact value, or the monodromy and its comparison with the Galois group.  Read `evaluate`, `states`,
`journey` and `way`: a state is carried along straight lines by an equation's `Way`.  Rational coefficients have discs of exact
series (`rational`, with `frame`, `taylor` and `splitting` below it), the certificate of case 1 (`closed_form`) or
FLINT's special functions (`classical`); other coefficients, constants known by balls and right-hand sides have power series in
balls (`jets`), matrices or many periods at once (all three in `analytic`), or another variable (`functions`).  A journey
begins with initial values, with a Frobenius basis (`singular`, `frobenius`) or with the decaying solution (`start`).
"""

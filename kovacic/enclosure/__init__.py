"""Values of solutions with proven error bounds.

In goes an equation (text, S, an `Equation` or a `Solution`), a path and initial values; out comes a `Ball`, a midpoint and a
radius, that contains the exact value, or the monodromy and its comparison with the Galois group.  Read `evaluate`, `states` and
`journey`: states are carried along a path by transition matrices, from Taylor discs (`transport`, with `frame`, `taylor` and
`splitting` below it), from the certificate of case 1 (`closed_form`) or from FLINT's special functions (`classical`).  A
journey begins with initial values, with a Frobenius basis (`singular`, `frobenius`) or with the decaying solution (`start`);
`forcing` adds right-hand sides.
"""

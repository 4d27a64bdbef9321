"""Exact arithmetic: polynomials and rational functions over coefficient fields, and the same modulo primes.

Nothing in here knows about differential equations.  Numbers, parameters and algebraic constants go in, as coefficients of a
`Poly` or `RatFunc`; out come sums, quotients, factors, roots, values modulo primes, and the way back from these.  Read `poly`
first: it has the abstract classes.  Above it are `rationals`, `function_field` and `extension`, one field each, with
what each needs to come back from primes (`lifting`, `interpolation` and `splitting`), and `ratfunc`.  What is computed
modulo a prime is in `modular`, below all of these.
"""

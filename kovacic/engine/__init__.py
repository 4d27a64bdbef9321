"""The theory: from S of y'' = S y to a `Decision`, with Kovacic's cases in order.  Read `decide` first.

Kovacic's paper [J. Symb. Comp. 2 (1986)], and where its steps are:

- section 2.1, the poles, their orders, the necessary conditions: `places`;
- section 3, case 1, omega in C(x): `reducible`; the exponents, the degree of P and, instead of trying all combinations of
  signs, expansions modulo primes: `local`;
- section 4, case 2, omega of degree 2, and section 5, case 3, omega of degree 4, 6, 12: `irreducible`;
- the recursion for the polynomial of omega, in all cases: `riccati`;
- the paper's own steps 1 to 3, for reading: `paper`.

In place of the search for exponents in cases 2 and 3 (and for two rational omegas) there are the rational invariants of the
group: `invariants`, modulo primes, and `expansion`, one of a high degree over Q from its recurrence.
"""

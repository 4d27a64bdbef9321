"""Exact arithmetic: polynomials and rational functions over coefficient fields, and the same modulo primes.

Nothing in here knows about differential equations.
"""

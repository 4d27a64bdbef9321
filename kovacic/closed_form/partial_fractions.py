"""Rational functions as derivatives and residues: what an integral looks like before any logarithm is written down.

Every r in K(x) is r = R' + sum over the irreducible factors p of its denominator, and over the roots a of p, of
rho(a)/(x - a), with R in K(x) and rho in K[x]/p [Hermite 1872].  R is unique up to a constant; the residues rho are unique.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Residue:
    """The residue `value`(a) at every root a of the monic irreducible `factor`; a constant polynomial if it is the same."""

    factor: Poly
    value: Poly

    @property
    def is_constant(self) -> bool:
        return self.value.degree <= 0

    @property
    def logarithmic(self) -> RatFunc:
        """sum over the roots a of value(a)/(x - a), a rational function over K."""
        return RatFunc(self.value * self.factor.derivative() % self.factor, self.factor)


@dataclass(frozen=True)
class Decomposition:
    """r = exact' + sum of the logarithmic parts of `residues`."""

    exact: RatFunc
    residues: tuple[Residue, ...]

    @property
    def derivative(self) -> RatFunc:
        """r again."""
        return sum((residue.logarithmic for residue in self.residues), self.exact.derivative())


def integral(polynomial: Poly) -> Poly:
    """The antiderivative without constant term."""
    field = polynomial.field
    return field.poly([0, *(polynomial[k] / field.poly([k + 1]) for k in range(polynomial.degree + 1))])


def decompose(r: RatFunc) -> Decomposition:
    """The exact part and the residues of a rational function, residues in the order of `Field.factor`.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> parts = decompose(x + 1 / x**2 + 3 * x / (x**2 - 2))
    >>> print(parts.exact, [(str(part.factor), str(part.value)) for part in parts.residues])
    (x**3 - 2)/(2*x) [('x**2 - 2', '3/2')]
    """
    field = r.field
    polynomial, rest = divmod(r.num, r.den)
    exact = RatFunc(integral(polynomial))
    residues = []
    for p, k in field.factor(r.den) if r.den.degree > 0 else []:
        cofactor = r.den // p**k
        numerator = rest * cofactor.inverse_modulo(p**k) % p**k if k * p.degree < r.den.degree else rest
        part, numerator = _hermite(numerator, p, k, field)
        exact = exact + part
        value = numerator * p.derivative().inverse_modulo(p) % p if p.degree > 1 else numerator % p
        if value:
            residues.append(Residue(p, value))
    return Decomposition(exact, tuple(residues))


def _hermite(numerator: Poly, p: Poly, k: int, field: Field) -> tuple[RatFunc, Poly]:
    """R and n with numerator/p^k = R' + n/p + polynomial, the polynomial being zero for a proper fraction."""
    if k == 1:
        return RatFunc(field.poly([])), numerator % p
    slope = p.derivative()
    inverse = slope.inverse_modulo(p)
    parts = []
    for power in range(k, 1, -1):
        # numerator = B (1 - power) p' + C p, so numerator/p^power = (B/p^(power-1))' + (C - B')/p^(power-1).
        B = numerator * inverse % p / field.poly([1 - power])
        parts.append(B)
        numerator = (numerator - B * slope * (1 - power)) // p - B.derivative()
    return power_sum(parts, p), numerator % p


def power_sum(numerators: Sequence[Poly], p: Poly) -> RatFunc:
    """numerators[0]/p^n + numerators[1]/p^(n-1) + ... + numerators[n-1]/p for as many numerators as there are, n > 0."""
    total = numerators[-1]
    for numerator in numerators[-2::-1]:
        total = total * p + numerator
    return RatFunc(total, p ** len(numerators))

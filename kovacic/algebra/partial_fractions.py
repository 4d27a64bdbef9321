"""Rational functions as derivatives and residues: an integral before any logarithm is written down.

Every r in K(x) is r = R' + sum over the irreducible factors p of its denominator, and over the roots a of p, of
rho(a)/(x - a), with R in K(x) and rho in K[x]/p [Hermite 1872].  R is unique up to a constant; the residues rho are unique.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from kovacic.algebra.factors import squarefree_factors
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.limits import check_time


@dataclass(frozen=True)
class Residue:
    """The residue `value`(a) at every root a of the monic irreducible `factor`; a constant polynomial if it is the same."""

    factor: Poly
    value: Poly

    @property
    def is_constant(self) -> bool:
        return self.value.degree <= 0

    @property
    def rational(self) -> Fraction | None:
        """The residue if it is the same rational number at all roots, else None."""
        return self.value.field.rational_value(self.value) if self.is_constant else None

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


def decompose(r: RatFunc) -> Decomposition:
    """The exact part and the residues of a rational function, residues in the order of `Field.factor`.

    >>> from kovacic.algebra.rationals import QQ
    >>> x = RatFunc(QQ.x)
    >>> parts = decompose(x + 1 / x**2 + 3 * x / (x**2 - 2))
    >>> print(parts.exact, [(str(part.factor), str(part.value)) for part in parts.residues])
    (x**3 - 2)/(2*x) [('x**2 - 2', '3/2')]
    """
    field = r.field
    polynomial, rest = divmod(r.num, r.den)
    exact = RatFunc(field.poly([0, *(polynomial[k] / field.poly([k + 1]) for k in range(polynomial.degree + 1))]))
    W, _, residues = reduce_poles(RatFunc(rest, r.den, reduced=True), RatFunc(field.zero))
    return Decomposition(exact + W, residues)


class PartialFraction(NamedTuple):
    """above/factor^power, with an irreducible factor of larger degree."""

    above: Poly
    factor: Poly
    power: int


def partial_fractions(r: RatFunc) -> tuple[Poly, list[PartialFraction]]:
    """The polynomial and the fractions whose sum is r, by factors in the order of `Field.factor`, and by powers.

    >>> from kovacic.algebra.rationals import QQ
    >>> whole, parts = partial_fractions(RatFunc(QQ.poly([1, 0, 1, 1]), QQ.x**2))
    >>> str(whole), [(str(part.above), str(part.factor), part.power) for part in parts]
    ('x + 1', [('1', 'x', 2)])
    """
    whole, rest = divmod(r.num, r.den)
    found: list[PartialFraction] = []
    for factor, k in r.field.factor(r.den):
        power = factor**k
        above = rest * (r.den // power).inverse_modulo(power) % power
        start = len(found)
        for j in range(k, 0, -1):  # above/factor^k = d_1/factor + d_2/factor^2 + ..., d_k first
            above, digit = divmod(above, factor)
            if digit:
                found.insert(start, PartialFraction(digit, factor, j))
    return whole, found


def reduce_poles(r: RatFunc, slope: RatFunc, apart: Poly | None = None) -> tuple[RatFunc, RatFunc, tuple[Residue, ...]]:
    """(W, rest, residues) with r = W' + W slope + rest, where rest has simple poles only, with these residues.

    The poles at the zeros of `apart` stay as they are; no other is a pole of the slope.  For the slope k'/k, W k is the part
    of int r k dx that Hermite's reduction finds; the slope 0 is that of int r dx.
    """
    W = RatFunc(r.field.zero)
    den = r.den if apart is None else prime_part(r.den, apart)
    for p, multiplicity in squarefree_factors(den):
        if multiplicity > 1:
            part, r = _reduce_at(r, p, multiplicity, slope)
            W = W + part
    left = r.den if apart is None else prime_part(r.den, apart)
    return W, r, tuple(Residue(p, residue_at_simple_pole(r, p)) for p, _ in r.field.factor(left))


def prime_part(polynomial: Poly, other: Poly) -> Poly:
    """The largest divisor of a polynomial that is prime to another."""
    while (common := polynomial.gcd(other)).degree > 0:
        polynomial = polynomial // common
    return polynomial


def residue_at_simple_pole(r: RatFunc, p: Poly) -> Poly:
    """The residue at the roots of the irreducible p, once in the denominator, as an element of K[x]/p."""
    return r.num * (r.den // p * p.derivative()).inverse_modulo(p) % p


def _reduce_at(r: RatFunc, p: Poly, multiplicity: int, slope: RatFunc) -> tuple[RatFunc, RatFunc]:
    """W and r - W' - W slope, which has p in its denominator once at most, for a squarefree p prime to that of `slope`."""
    cofactor = r.den // p**multiplicity
    # r = A/(p^k C) and the derivative of B/p^(k-1) is (B' p C - (k-1) B p' C + B p C slope)/(p^k C).
    C = cofactor * (slope.den // cofactor.gcd(slope.den))
    A = r.num * (C // cofactor)
    rate = slope.num * (C // slope.den)
    scale = (p.derivative() * C).inverse_modulo(p)
    total = r.num * 0
    for k in range(multiplicity, 1, -1):
        check_time()
        B = A * scale % p * Fraction(1, 1 - k)
        A = (A + (k - 1) * B * p.derivative() * C) // p - B.derivative() * C - rate * B
        total = total + B * p ** (multiplicity - k)
    return RatFunc(total, p ** (multiplicity - 1)), RatFunc(A, p * C)

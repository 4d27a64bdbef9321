"""Constants: parameters of special functions, linear in square roots of constants of the field; roots in the field itself."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.poly import Poly, Scalar
from kovacic.algebra.ratfunc import RatFunc

HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Number:
    """part + sum of coefficient * sqrt(square) over `roots`, pairs (square, coefficient) of constants of one field."""

    part: Poly
    roots: tuple[tuple[Poly, Poly], ...] = ()

    def __add__(self, other: Number | Poly | Scalar) -> Number:
        if not isinstance(other, Number):
            return Number(self.part + other, self.roots)
        total = dict(self.roots)
        for square, coefficient in other.roots:
            total[square] = total[square] + coefficient if square in total else coefficient
        return Number(self.part + other.part, tuple((square, c) for square, c in total.items() if c))

    __radd__ = __add__

    def __mul__(self, factor: Poly | Scalar) -> Number:
        return Number(self.part * factor, tuple((square, c * factor) for square, c in self.roots))

    __rmul__ = __mul__

    def __neg__(self) -> Number:
        return self * -1

    def __sub__(self, other: Number | Poly | Scalar) -> Number:
        return self + -other

    def __rsub__(self, other: Poly | Scalar) -> Number:
        return -self + other


def multiplicities(f: RatFunc) -> list[tuple[Poly, int]]:
    """The monic irreducible factors with their multiplicities, negative in the denominator."""
    zeros = _factors(f.num)
    poles = _factors(f.den)
    return zeros + [(p, -k) for p, k in poles]


def _factors(polynomial: Poly) -> list[tuple[Poly, int]]:
    return polynomial.field.factor(polynomial) if polynomial.degree > 0 else []


def root(value: Poly, n: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of a constant of the field within it, None if there is none."""
    field = value.field
    if n == 2:
        return field.sqrt(value)
    factors = field.factor(field.poly([-value, *[0] * (n - 1), 1]))
    return next((-factor[0] for factor, _ in factors if factor.degree == 1), None)

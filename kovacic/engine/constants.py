"""Constants that the answer adjoins to the field: square roots, by a simple minimal polynomial."""

from __future__ import annotations

from flint import fmpz

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ, to_fraction

#: Bits of the primes whose squares are taken out of a radicand.
_SMOOTH_BITS = 15


def square_root(field: Field, value: Poly) -> Poly:
    """A square root of a non-zero constant: in the field if it has one, else in K(c) with c^2 the simplified radicand."""
    root = field.sqrt(value)
    if root is not None:
        return root
    radicand, factor = _without_squares(field, value)
    return AlgebraicField(field, field.poly([-radicand, 0, 1])).generator * factor


def _without_squares(field: Field, value: Poly) -> tuple[Poly, Poly]:
    """`(r, f)` with value = r f^2; over Q, r is an integer without the squares of small primes."""
    one = field.poly([1])
    if field != QQ:
        return value, one
    fraction = to_fraction(value.rational_coefficients()[0])
    product, radicand, factor = fraction.numerator * fraction.denominator, 1, 1
    for p, exponent in fmpz(abs(product)).factor_smooth(_SMOOTH_BITS):
        radicand *= int(p) ** (exponent % 2)
        factor *= int(p) ** (exponent // 2)
    return field.poly([radicand if product > 0 else -radicand]), field.poly([factor]) / fraction.denominator

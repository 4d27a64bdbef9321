"""Polar parts at the irregular places: what S says about f where f has its poles.

At a finite place with the irreducible p, S = V/p^k for a p-adic unit V.  Infinity is the place z = 0 of S(1/z)/z^4, and what
is found there is a polynomial in x = 1/z.  All computing is in K[x]/p^j, so that conjugate poles stay together.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Place


@dataclass(frozen=True)
class PolarPart:
    """That of int sqrt(S/q) dx, up to the sign, its order, and the residue of sqrt(S/q) dx, a constant in K[x]/p."""

    part: RatFunc
    order: int
    residue: Poly


def unit(place: Place, precision: int) -> Poly:
    """V modulo p^precision, for S = V/p^k."""
    power = place.factor**precision
    return place.num * (place.den // place.factor**place.order).inverse_modulo(power) % power


def root_modulo(v: Poly, p: Poly, n: int, precision: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of v modulo p^precision, None if there is none; by Newton's method."""
    if p.degree == 1:
        w = root(v % p, n)
    else:
        extension = AlgebraicField(v.field, p, "_a")
        element = root(ExtensionPoly(extension, tuple((v % p)[k] for k in range(p.degree))), n)
        w = None if element is None else v.field.poly([part[0] for part in element.parts])
    known = 1
    while w is not None and known < precision:
        known = min(2 * known, precision)
        power = p**known
        w = (w * (n - 1) + v * (w ** (n - 1)).inverse_modulo(power)) * Fraction(1, n) % power
    return w


def root(value: Poly, n: int) -> Poly | None:
    """A square (n = 2) or cubic (n = 3) root of a constant of the field within it, None if there is none."""
    field = value.field
    if n == 2:
        return field.sqrt(value)
    factors = field.factor(field.poly([-value, *[0] * (n - 1), 1]))
    return next((-factor[0] for factor, _ in factors if factor.degree == 1), None)


def integral_of_square_root(place: Place, q: Poly) -> PolarPart | None:
    """int sqrt(S/q) dx at an unramified place, up to its sign.

    None if S/q has no square root over the residue field, or its residues at the roots of p aren't equal.
    """
    p, m = place.factor, place.order // 2
    s = root_modulo(unit(place, m) / q, p, 2, m)
    if s is None:
        return None
    parts = decompose(RatFunc(s, p**m))
    residue = parts.residues[0].value if parts.residues else s.field.poly([])
    return None if residue.degree > 0 else PolarPart(_in_x(parts.exact, place), m - 1, residue)


def leading_square(place: Place) -> Poly:
    """T modulo p for the t = T/p^d with t'^2/t = -S + ..., d = k - 2: d^2 p'^2 T = -V."""
    p, d = place.factor, place.order - 2
    return -unit(place, 1) * (d * d * p.derivative() ** 2).inverse_modulo(p) % p


def square(place: Place) -> RatFunc:
    """The polar part of t with t'^2/t = -S + ... at a ramified place: (T'p - d T p')^2 = -T V modulo p^d for t = T/p^d."""
    p, d = place.factor, place.order - 2
    return _in_x(RatFunc(expanded_square(place, d), p**d), place)


def expanded_square(place: Place, precision: int) -> Poly:
    """T modulo p^precision, term by term; for even d = k - 2 only d/2 terms are determined."""
    p, d = place.factor, place.order - 2
    V, slope, T = unit(place, precision), p.derivative(), leading_square(place)
    scale = (d * slope * slope * T).inverse_modulo(p)
    for i in range(1, precision):
        # T + p^i e changes the difference of both sides by d (d - 2 i) p'^2 T e p^i.
        step = T.derivative() * p - d * slope * T
        rest = (step * step + T * V) // p**i
        T = T - rest * scale % p * Fraction(1, d - 2 * i) * p**i
    return T


def integral_of_cubic_root(place: Place, q: Poly) -> RatFunc | None:
    """F at a place where q F'^2 F = S + ...: F^3 = -9 t/q has a pole of order d = k - 2; None without a cubic root."""
    p, d = place.factor, (place.order - 2) // 3
    W = root_modulo(expanded_square(place, d) * -9 / q, p, 3, d)
    return None if W is None else _in_x(RatFunc(W, p**d), place)


def _in_x(function: RatFunc, place: Place) -> RatFunc:
    """A function of the coordinate of the place as one of x."""
    if not place.at_infinity:
        return function
    field = function.field
    return function(RatFunc(field.poly([1]), field.poly([0, 1])))

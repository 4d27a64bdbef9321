"""f from its polar parts, up to its constant term: for the standard equations whose pull-backs have irregular singular points.

The irregular places of S are the poles of f, where S = f'^2 S0(f) + O(order 2).  With q = S0(infinity), and S0 = q - r/z + ...,

- q != 0: sqrt(S/q) dx = df - (r/(2 q)) dlog f + ..., so f is the integral of the polar parts of sqrt(S/q), up to a sign at each
  place; the residues, r/(2 q) times the order of the pole, tell the signs where r != 0.  All orders of poles of S are even;
- q = 0, r = 1: S = -f'^2/f + ..., so where all orders are odd all polar parts of f are determined;
- S0 = q z (Airy's), q F'^2 F = S + ...: F is a cubic root, and all polar parts are determined.

S0(f) has its only other pole at f = 0: so the zeros of f, which give its constant term, are the regular places of S, or
critical points of f.
What is found is tested by the exact identity; the theory shows that nothing of the first three kinds is overlooked but where a
scale q or a root of unity lies in the residue field of a conjugate set of poles alone.

At a finite place with the irreducible p, S = V/p^k for a p-adic unit V.  Infinity is the place z = 0 of S(1/z)/z^4, and what
is found there is a polynomial in x = 1/z.  All computing is in K[x]/p^j, so that conjugate poles stay together.

References: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; Q. Yuan, M. van Hoeij, ISSAC 2010, 37-43.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.engine.places import Kind, Place, Problem
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time
from kovacic.special.numbers import root

#: Conjugate poles up to which roots are taken where the field has parameters: factoring there takes long.
_WITH_PARAMETERS = 2


def irregular_places(problem: Problem) -> list[Place]:
    """The poles of f."""
    return [place for place in problem.places if place.kind in (Kind.UNRAMIFIED, Kind.RAMIFIED)]


def check_conjugates(problem: Problem, places: list[Place]) -> None:
    """Raise `LimitExceeded` where poles are conjugate over a larger field than the limit on constants allows."""
    largest = max(place.degree for place in places)
    most = problem.budget.limits.constants if problem.field.ground == QQ else _WITH_PARAMETERS
    if largest > most:
        raise LimitExceeded(f"f has {largest} conjugate poles; roots are taken up to degree {most}", limit="constants")


@dataclass(frozen=True)
class PolarPart:
    """That of int sqrt(S/q) dx, up to the sign, its order, and the residue of sqrt(S/q) dx, a constant in K[x]/p."""

    part: RatFunc
    order: int
    residue: Poly


def half_rate(m: Poly) -> RatFunc:
    """The logarithmic derivative of sqrt(m)."""
    return RatFunc(m.derivative(), m) * Fraction(1, 2)


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


def integral_of_square_root(place: Place, q: Poly) -> PolarPart | None:
    """int sqrt(S/q) dx at an unramified place, up to its sign.

    None if S/q has no square root over the residue field, or its residues at the roots of p aren't equal.
    """
    p = place.factor
    m = place.order // 2
    s = root_modulo(unit(place, m) / q, p, 2, m)
    if s is None:
        return None
    parts = decompose(RatFunc(s, p**m))
    residue = parts.residues[0].value if parts.residues else s.field.poly([])
    return None if residue.degree > 0 else PolarPart(in_x(parts.exact, place), m - 1, residue)


def leading_square(place: Place) -> Poly:
    """T modulo p for the t = T/p^d with t'^2/t = -S + ..., d = k - 2: d^2 p'^2 T = -V."""
    p = place.factor
    d = place.order - 2
    return -unit(place, 1) * (d * d * p.derivative() ** 2).inverse_modulo(p) % p


def square(place: Place) -> RatFunc:
    """The polar part of t with t'^2/t = -S + ... at a ramified place: (T'p - d T p')^2 = -T V modulo p^d for t = T/p^d."""
    p = place.factor
    d = place.order - 2
    return in_x(RatFunc(expanded_square(place, d), p**d), place)


def expanded_square(place: Place, precision: int) -> Poly:
    """T modulo p^precision, term by term; for even d = k - 2 only d/2 terms are determined."""
    p = place.factor
    d = place.order - 2
    V = unit(place, precision)
    slope = p.derivative()
    T = leading_square(place)
    scale = (d * slope * slope * T).inverse_modulo(p)
    for i in range(1, precision):
        # T + p^i e changes the difference of both sides by d (d - 2 i) p'^2 T e p^i.
        step = T.derivative() * p - d * slope * T
        rest = (step * step + T * V) // p**i
        T = T - rest * scale % p * Fraction(1, d - 2 * i) * p**i
    return T


def integral_of_cubic_root(place: Place, q: Poly) -> RatFunc | None:
    """F at a place where q F'^2 F = S + ...: F^3 = -9 t/q has a pole of order d = k - 2; None without a cubic root."""
    p = place.factor
    d = (place.order - 2) // 3
    W = root_modulo(expanded_square(place, d) * -9 / q, p, 3, d)
    return None if W is None else in_x(RatFunc(W, p**d), place)


def in_x(function: RatFunc, place: Place) -> RatFunc:
    """A function of the coordinate of the place as one of x."""
    if not place.at_infinity:
        return function
    field = function.field
    return function(RatFunc(field.poly([1]), field.poly([0, 1])))


# ------------------------------------------------------------------------------------------ scale and constant


def scales(places: list[Place], value: Callable[[Place], Poly], n: int) -> list[Poly]:
    """What q can be, up to n-th powers: the leading coefficient at a place of degree 1; else 1, -1 and what norms tell."""
    place = min(places, key=lambda place: place.degree)
    v = value(place)
    field = place.num.field
    one = field.poly([1])
    if place.degree == 1:
        is_power = root(v[0], n) is not None
        return [one] if is_power else [v[0]]
    scales = [one] if n == 3 else [one, -one]
    if place.degree == 2 and n == 2:
        # v = q w^2 has the norm (q N(w))^2, and (v + sqrt N(v))^2 = v (tr v + 2 sqrt N(v)).
        p = place.factor
        trace = 2 * v[0] - v[1] * p[1]
        norm = field.sqrt(v[0] * v[0] - v[0] * v[1] * p[1] + v[1] * v[1] * p[0])
        if norm is not None:
            scales += [trace + 2 * norm, trace - 2 * norm]
    return list(dict.fromkeys(scale for scale in scales if scale))


def zeros(problem: Problem, polar: RatFunc, *, shifted: bool) -> Iterator[tuple[RatFunc, Poly]]:
    """f with its constant, and e^2 for the standard equation's exponent difference e at 0: a k-fold zero of f has k e.

    Zeros of f are all places with exponents that integers don't explain; without such, apparent places or critical points.
    With `shifted`, S has k e up to integers only.
    """
    if not polar.derivative():
        return
    regular = [place for place in problem.places if place.kind is Kind.REGULAR]
    seen = [place for place in regular if not place.is_apparent]
    points = [(place.factor, place.at_infinity, place.delta_squared) for place in seen or regular]
    if not seen:
        slope = polar.derivative().num
        critical = slope.field.factor(slope) if slope.degree > 0 else []
        one = slope.field.poly([1])
        points += [*((p, False, one) for p, _ in critical), (slope.field.poly([0, 1]), True, one)]
    for p, at_infinity, delta_squared in points:
        value = value_at(polar, p, at_infinity=at_infinity)
        if value is None or delta_squared is None:
            continue
        check_time()
        f = polar - value
        k = -f.degree if at_infinity else f.num.remove(p)[1]
        yield f, delta_squared * Fraction(1, k * k)
        if shifted:
            yield from ((f, e_squared) for e_squared in _shifted_differences(delta_squared, k))


def value_at(f: RatFunc, p: Poly, *, at_infinity: bool) -> Poly | None:
    """The value at all roots of p, or at infinity, if it is one and finite."""
    if at_infinity:
        if not f or f.degree < 0:
            return f.num * 0
        return f.num.lc / f.den.lc if f.degree == 0 else None
    if f.den.gcd(p).degree > 0:
        return None
    value = f.num * f.den.inverse_modulo(p) % p
    return value if value.degree <= 0 else None


def _shifted_differences(square: Poly, k: int) -> Iterator[Poly]:
    """The squares of e with k e = Delta up to sign and integers, small ones first where they are rational."""
    root = square.field.sqrt(square) if square else square
    if root is None:
        return
    rational = root.field.rational_value(root)
    centre = 0 if rational is None else round(rational)
    found = [(root - centre + j) * Fraction(1, k) for j in range(-k, k + 1)]
    if rational is not None:
        found.sort(key=lambda e: abs(e.field.rational_value(e) or Fraction(0)))
    yield from (e * e for e in found)

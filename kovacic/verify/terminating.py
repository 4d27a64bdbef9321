"""A P that is known by a recurrence of two terms: y = exp(int theta) P solves y'' = S y for a polynomial P of a named degree.

The condition on P is P'' + 2 theta P' + (theta' + theta^2 - S) P = 0.  Multiplied by a common denominator it takes t^k,
t = x - c, to a sum of U_j(k) t^(k+j) with quadratic polynomials U_j.  If U_h and U_l, l < h, are the only ones that aren't 0,
P = sum p_k t^k solves it exactly when

    U_h(k) p_k + U_l(k+s) p_(k+s) = 0,    s = h - l,                                                              (1)

for all integers k: so there is a P of degree d exactly when U_h(d) = 0 and, of the numbers d, d - s, d - 2s, ..., the first one
at which U_l vanishes, e >= 0, comes before the first one below d at which U_h does.

All theta that a solution can have, with the degree of its P: at each pole y has one of two exponents, and at an irregular one
y'/y has the polar part of +-sqrt(S) besides; the same holds at z = 1/x = 0 for v = y/x.  By the sum of the residues of y'/y
the exponents, that at infinity included, and deg P add up to 1.  [Kovacic 1986, section 3.1]
"""

from __future__ import annotations

from itertools import product
from math import prod
from typing import NamedTuple

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, over_one_denominator
from kovacic.decision import TerminatingSeries
from kovacic.limits import MOST_TRIALS, check_time
from kovacic.verify.factors import inverse, quotient
from kovacic.verify.local import Point


class Recurrence(NamedTuple):
    """s, U_h and U_l of (1)."""

    step: int
    high: Poly
    low: Poly

    def end(self, degree: int) -> int | None:
        """The least power in a P of this degree; None if there is no such P."""
        if degree < 0 or self.high(degree):
            return None
        ends = [k for k in integers_among_the_roots(self.low) if 0 <= k <= degree and (degree - k) % self.step == 0]
        stops = [k for k in integers_among_the_roots(self.high) if k < degree and (degree - k) % self.step == 0]
        return None if not ends or any(k >= max(ends) for k in stops) else max(ends)


def recurrence(S: RatFunc, theta: RatFunc, centre: Poly) -> Recurrence | None:
    """Equation (1) about a point; None if the operator has other than two terms there."""
    field = theta.field
    one = RatFunc(field.one)
    S = RatFunc(S.num.over(field), S.den.over(field))
    parts = over_one_denominator([one, 2 * theta, theta.derivative() + theta * theta - S])
    second, first, zeroth = (part(field.x + centre) for part in parts)
    terms = []
    for j in range(-2, max(second.degree - 2, first.degree - 1, zeroth.degree) + 1):
        U = field.poly([zeroth[j], first[j + 1] - second[j + 2], second[j + 2]])
        if U:
            terms.append((j, U))
    if len(terms) != 2:
        return None
    (low, U_low), (high, U_high) = terms
    return Recurrence(high - low, U_high, U_low)


def integers_among_the_roots(U: Poly) -> list[int]:
    """The integers at which a polynomial of degree at most 2 vanishes."""
    field = U.field
    candidates = []
    if U.degree == 1:
        candidates = [-U[0] / U[1]]
    elif U.degree == 2:
        root = field.sqrt(U[1] * U[1] - 4 * U[0] * U[2])  # an integer root makes it a square
        candidates = [] if root is None else [(root - U[1]) / (2 * U[2]), (-root - U[1]) / (2 * U[2])]
    values = [field.rational_value(candidate) for candidate in candidates]
    return [int(value) for value in values if value is not None and value.denominator == 1]


def solves(S: RatFunc, series: TerminatingSeries) -> bool:
    """True if exp(int theta) P solves y'' = S y, with a P of this degree in these powers."""
    if series.centre.degree > 0:
        return False
    found = recurrence(S, series.theta, series.centre)
    return found is not None and found.step == series.step and found.end(series.degree) == series.lowest


def numbers_of_series(S: RatFunc, points: list[Point]) -> tuple[int, int] | None:
    """The number of theta with a natural degree of P, and the number of these with a P; None unless recurrences decide all."""
    choices = []
    for point in points:
        found = _local_parts(point)
        if found is None:
            return None
        choices.append(found)
    if prod(map(len, choices)) > MOST_TRIALS:
        return None
    tried = ending = 0
    for parts in product(*choices):
        check_time()
        theta = sum((part for _, part in parts), RatFunc(S.field.zero))
        degree = S.field.rational_value(1 - sum((exponent for exponent, _ in parts), S.field.zero))
        if degree is None or degree < 0 or degree.denominator > 1:
            continue
        tried += 1
        found_here = [recurrence(S, theta, centre) for centre in _centres(points, theta)]
        usable = [found for found in found_here if found is not None]
        if not usable:
            return None
        ending += usable[0].end(int(degree)) is not None
    return tried, ending


def _centres(points: list[Point], theta: RatFunc) -> list[Poly]:
    """The poles, all rational, and the mean of all of them; without poles the mean of the zeros of theta."""
    poles = [-point.factor[0] for point in points[:-1]]
    if poles:
        return [*poles, sum(poles[1:], poles[0]) / len(poles)]
    n = theta.num.degree
    return [-theta.num[n - 1] / (n * theta.num[n])] if n > 0 else []


def _local_parts(point: Point) -> list[tuple[Poly, RatFunc]] | None:
    """The exponents at a point with the part of theta that belongs to each; None unless all numbers lie in the field of S.

    For y'/y = polar + exponent/t + ..., t = x - c, that part is polar + exponent/t; at infinity, where it refers to
    v(z) = z y(1/z), y'/y = 1/x - (v'/v)(1/x)/x^2, and the part is -polar(1/x)/x^2.
    """
    field = point.factor.field
    zero = field.zero
    if point.factor.degree > 1 or (point.order > 2 and point.order % 2):
        return None
    if point.order < 2:
        exponents = [zero, zero + 1] if point.at_infinity else [zero + 1]  # the solution without a logarithm
        found = [(exponent, [zero]) for exponent in exponents]
    elif point.order == 2:
        N, M = point.at_double_pole
        difference = field.sqrt(1 + 4 * quotient(N[0], M[0]))
        if difference is None:
            return None
        found = [((1 + sign * difference) / 2, [zero]) for sign in ((1, -1) if difference else (1,))]
    else:
        root = _square_root(point)
        if root is None:
            return None
        *polar, residue = root
        nu = len(root)
        found = [((nu + 2 * sign * residue) / 2, [sign * w for w in polar]) for sign in (1, -1)]
    t = point.factor
    parts = []
    for exponent, polar in found:
        nu = len(polar) + 1
        if point.at_infinity:
            theta = RatFunc(-field.poly([*reversed(polar)]))
        else:
            theta = RatFunc(exponent, t)
            for k, w in enumerate(polar):
                theta = theta + RatFunc(w, t ** (nu - k))
        parts.append((exponent, theta))
    return parts


def _square_root(point: Point) -> list[Poly] | None:
    """w_0, ..., w_(nu-1) with S = (w_0 + w_1 t + ...)^2/t^(2 nu) at an irregular point; None if w_0 lies in another field."""
    field = point.factor.field
    nu = point.order // 2
    t = field.x
    N, q = (part(t - point.factor[0]) for part in point.near)
    u = N * inverse(q, t**nu) % t**nu
    first = field.sqrt(u[0])
    if first is None or first * first != u[0]:
        return None
    w = [first]
    for k in range(1, nu):
        known = sum((w[i] * w[k - i] for i in range(1, k)), field.zero)
        w.append((u[k] - known) / (2 * first))
    return w

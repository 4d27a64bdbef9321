"""An upper bound for the dimension of the rational forms of degree m in the solutions: the dimension modulo a prime.

A rational form F of degree m in a fundamental system has, at each singular point, a valuation from a short list; so F is the
product of the p^v, v the least of these, and of a polynomial of a bounded degree.  At an ordinary point, F is a combination of
y1^(m-i) y2^i, i = 0, ..., m, and modulo a prime the rank of the equations which say that the terms beyond that degree vanish
is at most that over the field.  [van Hoeij & Weil, J. Pure Appl. Algebra 117-118 (1997)]
"""

from __future__ import annotations

from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.verify.local import Point
from kovacic.verify.primes import BadPrimeError, Homomorphism, translated
from kovacic.verify.series import nullity, product_of_powers, solutions_at_ordinary_point

#: Equations beyond the number of unknowns.
_MORE_EQUATIONS = 7


def least_valuation(point: Point, m: int) -> int | None:
    """The least integer among the valuations that a rational form of degree m can have at the point; None if there is none.

    With the exponents (1 +- Delta)/2 a form has the valuations m/2 + i Delta/2, i = -m, -m + 2, ..., m; the middle one alone
    for an irrational Delta (i = 0), the largest alone with a logarithm, since such a form is a power of the solution without
    it.  At an irregular point of order k a rational form is a multiple of (y+ y-)^(m/2), of the valuation m k/4.
    """
    if point.order > 2:
        quarter, rest = divmod(m * point.order, 4)
        return None if rest else quarter
    if point.difference is None:
        return None if m % 2 else m // 2
    numerator, denominator = point.difference.as_integer_ratio()
    signs = [m] if point.logarithm else range(-m, m + 1, 2)
    for i in signs:
        valuation, rest = divmod(m * denominator + i * numerator, 2 * denominator)
        if not rest:
            return valuation
    return None


def room(points: list[Point], m: int) -> tuple[list[int], int] | None:
    """The least valuations at the finite points, and the largest degree of the polynomial factor; None if no form exists.

    The valuations at all points of the sphere, as those of a form in solutions of y'' = S y, add up to m.
    """
    valuations = []
    degree = m
    for point in points:
        valuation = least_valuation(point, m)
        if valuation is None:
            return None
        valuations.append(valuation)
        degree -= valuation * point.factor.degree
    return None if degree < 0 else (valuations[:-1], degree)


def dimension_modulo(
    h: Homomorphism, S: RatFunc, at: int, m: int, *, factors: list[tuple[Poly, int]], degree: int
) -> int:
    """The dimension modulo a prime of the forms of degree m whose quotient by prod p^v is a polynomial of at most this degree.

    They are expanded at the integer `at`, to some terms more than there are unknowns.  Raises `BadPrimeError` if the point is
    singular, or the series would be longer than the prime allows.
    """
    count = degree + m + 1 + _MORE_EQUATIONS
    bottom = translated(h.keeping_degree(S.den), at)
    if h.p <= 2 * count or not int(bottom[0]):
        raise BadPrimeError("the point is singular, or the prime is small")
    y1, y2 = solutions_at_ordinary_point(translated(h(S.num), at), bottom, count)
    images = [(translated(h.keeping_degree(p), at), -v) for p, v in factors]
    form = product_of_powers(images, count, h.p).mul_low(y1.pow_trunc(m, count), count)
    ratio = y2.mul_low(y1.inverse_series_trunc(count), count)
    forms = [form]  # the quotients of y1^(m-i) y2^i, i = 0, ..., m
    for _ in range(m):
        forms.append(forms[-1].mul_low(ratio, count))
    return nullity(forms, degree + 1, count)


def ordinary_point(den: Any) -> int:
    """The least natural number at which a polynomial modulo a prime doesn't vanish."""
    at = 0
    while not int(den(at)):
        at += 1
    return at

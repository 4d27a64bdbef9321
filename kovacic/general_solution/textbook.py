"""The shortest of equal forms of an answer with values: hyperbolic functions of the distance from the ends, as in books.

For y'' = k^2 y and values at two points a, b, the solution u_a that satisfies the homogeneous condition at a is
sinh(k (x - a)) for a given y(a), and cosh(k (x - a)) for a given y'(a).  With u_b likewise, and l_a, l_b the conditions,

    y = v_a u_b/l_a(u_b) + v_b u_a/l_b(u_a),                                                                           (1)

since l_a(u_a) = l_b(u_b) = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.general_solution.conditions import Condition
from kovacic.numerals import as_text

Expr = Any  # SymPy publishes no types


def shortest(forms: Sequence[Expr | None]) -> Expr:
    """The first of the forms that take the fewest characters."""
    return min((form for form in forms if form is not None), key=lambda form: len(as_text(form)))


def by_end_points(y1: Expr, y2: Expr, particular: Expr, conditions: Sequence[Condition], x: Expr) -> Expr | None:
    """Form (1); None where the solutions aren't exp(k x) and exp(-k x), or the conditions aren't values at two points."""
    k = _rate(y1, y2, x)
    if k is None or len(conditions) != 2 or not all(c.is_value for c in conditions):
        return None
    a, b = (c.terms[0] for c in conditions)
    if a.point == b.point or not (_is_finite(a.point) and _is_finite(b.point)) or particular.has(sympy.Integral):
        return None
    total = particular
    for own, other, condition in ((a, b, conditions[0]), (b, a, conditions[1])):
        rest = condition.value - particular.diff(x, own.order).subs(x, own.point)
        distance = k * (x - other.point)
        u = sympy.cosh(distance) if other.order else sympy.sinh(distance)
        there = u.diff(x, own.order).subs(x, own.point)
        if there == 0:
            return None
        total += rest * (u / there)
    return total


def _rate(y1: Expr, y2: Expr, x: Expr) -> Expr | None:
    """k for exp(k x) and exp(-k x), up to constants, k without a minus sign; None for others, and for waves."""
    rates = [sympy.cancel(y.diff(x) / y) for y in (y1, y2)]
    if any(rate.has(x) or rate == 0 or rate.has(sympy.I) for rate in rates) or sympy.expand(rates[0] + rates[1]) != 0:
        return None
    return next(rate for rate in rates if not rate.could_extract_minus_sign())


def _is_finite(point: Expr) -> bool:
    return point not in (sympy.oo, -sympy.oo)

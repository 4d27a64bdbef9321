"""The value and the slope of an expression at a point, where it may be of the form 0/0."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import sympy

from kovacic.general_solution.behaviour import Approach, finite_limit
from kovacic.general_solution.steps import place_of
from kovacic.general_solution.substitution import finite_value, slope
from kovacic.general_solution.zero import agree, is_zero
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
Pair = tuple[Expr, Expr]  # f(a), f'(a)
_ZERO = sympy.Integer(0)


def values_at(expression: Expr, x: Expr, point: Expr) -> Pair:
    """(f(a), f'(a)) at an ordinary point of f; at the jump of a step function, just before it.

    Raises `NotImplementedError` for a form 0/0 whose limit isn't found.

    >>> x = sympy.Symbol("x")
    >>> values_at(x * sympy.exp(2 * x), x, sympy.Integer(1))
    (exp(2), 3*exp(2))
    """
    return value_at(expression, x, point), value_at(expression, x, point, 1)


def value_at(expression: Expr, x: Expr, point: Expr, order: int = 0) -> Expr:
    """The value of the function (order 0) or of its slope (order 1), as for `values_at`."""
    check_time()
    e = sympy.sympify(expression, strict=True)
    if not e.has_free(x):
        return _ZERO if order else e
    # Steps and impulses have the values just before the point: neither has a slope there.
    steps = [jump for jump in e.atoms(sympy.Heaviside, sympy.DiracDelta) if jump.has(x)]
    e = e.xreplace({jump: _just_before(e, jump, x, point, order) for jump in steps})
    if order:
        is_series_at_zero = any(f.argument.subs(x, point) == 0 for f in e.atoms(sympy.hyper))
        derivative = e.diff(x) if is_series_at_zero else slope(e, x)
        e = derivative.xreplace(dict(_contiguous(e, x, point)))
    value = finite_value(e, x, point)
    if value is not None:
        return value
    for integral in e.atoms(sympy.Integral):  # nothing, from the point to x
        letter = sympy.Dummy()
        in_letter = e.xreplace({integral: letter})
        if integral.limits[0][1:] == (point, x) and have_values([in_letter.diff(letter)], x, point):
            e = in_letter.xreplace({letter: _ZERO})
    # The limit from the right, if it is that from the left: a closed form with roots may be another solution there.
    right, left = (finite_limit(e, x, Approach(point, direction)) for direction in (1, -1))
    if right is None or left is None or not agree(right, left):
        said = f"the functions of the closed form are singular at {point}, where the solutions aren't"
        raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of this solution")
    return right


def _contiguous(e: Expr, x: Expr, point: Expr) -> Iterator[tuple[Expr, Expr]]:
    """Functions that derivatives have in those of the expression itself, and of the next degree, which exist for n = 0, too.

    H_n' = 2 x H_n - H_(n+1), and for L_n^(a)' ((n + 1) L_(n+1)^(a) - (n + 1 + a - x) L_n^(a))/x [DLMF 18.9].
    """
    for f in e.atoms(sympy.hermite, sympy.laguerre, sympy.assoc_laguerre):
        *_, z = f.args
        if isinstance(f, sympy.hermite):
            n = f.args[0]
            yield sympy.hermite(n - 1, z), (2 * z * f - sympy.hermite(n + 1, z)) / (2 * n)
        elif z.subs(x, point) != 0:
            n, a = (*f.args[:-1], sympy.Integer(0))[:2]
            more = sympy.assoc_laguerre(n + 1, a, z)
            yield sympy.assoc_laguerre(n - 1, a + 1, z), ((n + 1 + a - z) * f - (n + 1) * more) / z


def _just_before(e: Expr, jump: Expr, x: Expr, point: Expr, order: int) -> Expr:
    """The value of a step or an impulse just before the point; as H(u, 0) where parameters may put the point on the step."""
    if isinstance(jump, sympy.DiracDelta):
        return _ZERO
    u = sympy.expand(jump.args[0].subs(x, point))
    place = place_of(jump, x)
    at_the_jump = _ZERO
    if place is not None and place.slope.is_negative:  # H(s (x - a)) is 1 before a
        at_the_jump = sympy.Integer(1)
    if u == 0:
        return at_the_jump
    step = sympy.Heaviside(u)
    if not isinstance(step, sympy.Heaviside):
        return step
    if place is not None:  # neither the function nor its slope may jump where the step does
        across = (e.xreplace({jump: sympy.Integer(1)}) - e.xreplace({jump: _ZERO})).diff(x, order)
        value = finite_value(across, x, place.a)
        if value is not None and is_zero(value):
            return step
    return sympy.Heaviside(u, at_the_jump)


def have_values(expressions: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """True if all of them have a value at the point, or a limit.

    >>> x = sympy.Symbol("x")
    >>> have_values([x, 1 / x], x, sympy.Integer(0))
    False
    """
    try:
        for expression in expressions:
            value_at(expression, x, point)
    except NotImplementedError:
        return False
    return True

"""The value and the slope of an expression at a point, where it may be of the form 0/0."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.general_solution.behaviour import Approach, behaviour
from kovacic.general_solution.expansion import UnknownBehaviour
from kovacic.general_solution.substitution import finite_value
from kovacic.general_solution.zero import Zero, agree, when_zero
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
    e = _before_jumps(e, x, point)
    if order:
        e = e.diff(x)
    value = finite_value(e, x, point)
    if value is None:
        value = _limit(e, x, point)
    if value is None:
        said = f"the functions of the closed form are singular at {point}, where the solutions aren't"
        raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of this solution")
    return value


def _before_jumps(e: Expr, x: Expr, point: Expr) -> Expr:
    """With 0 for steps and impulses at the point."""
    jumps = e.atoms(sympy.Heaviside, sympy.DiracDelta)
    if not jumps:
        return e
    return e.xreplace({jump: _ZERO for jump in jumps if jump.args[0].subs(x, point) == 0})


def have_values(expressions: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """Have all of them a value at the point, or a limit?

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


def _limit(expression: Expr, x: Expr, point: Expr) -> Expr | None:
    """The limit from the right, if it is that from the left: None without, or where it isn't known.

    A closed form with roots may be another solution on the other side.
    """
    limits = []
    for direction in (1, -1):
        limit = _limit_from(expression, x, Approach(point, direction))
        if limit is None:
            return None
        limits.append(limit)
    right, left = limits
    if agree(right, left):
        return right
    return None


def _limit_from(expression: Expr, x: Expr, place: Approach) -> Expr | None:
    """The limit from one side; None without, or where it isn't known."""
    try:
        parts = behaviour(expression, x, place).parts
    except (UnknownBehaviour, NotImplementedError):
        return None
    if any(when_zero(coefficient) is not Zero.ALWAYS for coefficient in parts.large.values()):
        return None
    return parts.constant

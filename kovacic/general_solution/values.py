"""The value and the slope of an expression at a point; where SymPy's limit is taken, the expression may be of the form 0/0."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.apart import last_of
from kovacic.limits import watched_seconds

Expr = Any  # SymPy publishes no types
Pair = tuple[Expr, Expr]  # f(a), f'(a)
#: Seconds for a question about a constant.
SECONDS = 10.0
_ZERO, _ONE = sympy.Integer(0), sympy.Integer(1)
_OPEN = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}


class _SingularError(Exception):
    """A subexpression isn't finite at the point."""


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
    e = sympy.sympify(expression, strict=True)
    if not e.has_free(x):
        return _ZERO if order else e
    if jumps := e.atoms(sympy.Heaviside, sympy.DiracDelta):
        e = e.xreplace({jump: _ZERO for jump in jumps if jump.args[0].subs(x, point) == 0})
    if order:
        e = e.diff(x)
    value = finite_value(e, x, point)
    if value is None and not e.has(sympy.hyper, BesselBase):  # SymPy takes limits of sqrt(x) besselk(1/4, x^2/2) wrong
        value = last_of(_limit, e, x, point, seconds=watched_seconds(SECONDS))
    if value is None:
        said = f"the functions of the closed form are singular at {point}, where the solutions aren't"
        raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of this solution")
    return value


def finite_value(expression: Expr, x: Expr, point: Expr) -> Expr | None:
    """The value at a point; None where it isn't finite."""
    try:
        return _substituted(expression, x, point)
    except _SingularError:
        return None


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


def _substituted(e: Expr, x: Expr, point: Expr) -> Expr:
    """The value of a function, of a series at 0, or of an integral from the point on."""
    special = e.atoms(sympy.RootSum, sympy.hyper, sympy.Integral)
    sums = {  # SymPy's substitution would compute rational ones exactly, without end
        r: sympy.RootSum(r.poly, sympy.Lambda(r.fun.variables, _substituted(r.fun.expr, x, point)), auto=False)
        for r in special
        if isinstance(r, sympy.RootSum)
    }
    value = (e.xreplace(sums) if sums else e).subs(x, point)
    if special:
        value = value.xreplace({f: _ONE for f in value.atoms(sympy.hyper) if f.argument == 0})
        empty = (i for i in value.atoms(sympy.Integral) if i.limits[0][1:2] == i.limits[0][2:])
        value = value.xreplace(dict.fromkeys(empty, _ZERO))
    if not _OPEN.isdisjoint(value.atoms()):
        raise _SingularError
    return value


def _limit(expression: Expr, x: Expr, point: Expr) -> Iterator[Expr]:
    yield sympy.limit(expression, x, point)

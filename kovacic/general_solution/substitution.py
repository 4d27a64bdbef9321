"""The value of an expression at a point by substitution, where each part of it is finite; its size, and its derivative."""

from __future__ import annotations

import math
from typing import Any

import sympy

from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)
#: Mathieu's odd function, and the slope of his even one, which SymPy leaves as they are at 0.
_ODD = (sympy.mathieus, sympy.mathieucprime)
_OPEN = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}


class _SingularError(Exception):
    """A subexpression isn't finite at the point."""


def finite_value(expression: Expr, x: Expr, point: Expr) -> Expr | None:
    """The value at a point; None where it isn't finite."""
    check_time()
    try:
        return _substituted(expression, x, point)
    except _SingularError:
        return None


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


def slope(expression: Expr, x: Expr) -> Expr:
    """What SymPy's `diff` gives, with a look at the clock at each term and factor: it takes seconds where there are many."""
    check_time()
    if expression.is_Add:
        return sympy.Add(*[slope(term, x) for term in expression.args])
    if expression.is_Mul:
        return _slope_of_product(expression.args, x)
    if expression.is_Pow and expression.exp.is_Number:
        inner = slope(expression.base, x)
        return expression * (inner * expression.exp / expression.base)
    return expression.diff(x)


def _slope_of_product(factors: tuple[Expr, ...], x: Expr) -> Expr:
    terms = []
    for i, factor in enumerate(factors):
        inner = slope(factor, x)
        if inner != 0:
            terms.append(math.prod((*factors[:i], inner, *factors[i + 1 :]), start=_ONE))
    return sympy.Add(*terms)


def _substituted(e: Expr, x: Expr, point: Expr) -> Expr:
    """The value of a function, of a series at 0, or of an integral from the point on."""
    sums = e.atoms(sympy.RootSum)
    if sums:
        e = e.xreplace({r: _substituted_in_sum(r, x, point) for r in sums})
    value = e.subs(x, point)
    if value.has(sympy.hyper, sympy.Integral, *_ODD):
        value = _at_zero(value)
    if not _OPEN.isdisjoint(value.atoms()):
        raise _SingularError
    return value


def _substituted_in_sum(r: Expr, x: Expr, point: Expr) -> Expr:
    """Beside the root alone: SymPy's substitution would compute rational sums exactly, without end."""
    term = sympy.Lambda(r.fun.variables, _substituted(r.fun.expr, x, point))
    return sympy.RootSum(r.poly, term, auto=False)


def _at_zero(value: Expr) -> Expr:
    """With the values of series and odd functions of 0, and of integrals over nothing, which SymPy leaves as they are."""
    known = {f: _ONE for f in value.atoms(sympy.hyper) if f.argument == 0}
    value = value.xreplace(known)
    known = {f: _ZERO for f in value.atoms(*_ODD) if f.args[-1] == 0}
    value = value.xreplace(known)
    empty = [i for i in value.atoms(sympy.Integral) if i.limits[0][1:2] == i.limits[0][2:]]
    return value.xreplace(dict.fromkeys(empty, _ZERO))

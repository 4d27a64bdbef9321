"""The value of an expression at a point by substitution, where each part of it is finite; and the size of an expression."""

from __future__ import annotations

from typing import Any

import sympy

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
    try:
        return _substituted(expression, x, point)
    except _SingularError:
        return None


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


def _substituted(e: Expr, x: Expr, point: Expr) -> Expr:
    """The value of a function, of a series at 0, or of an integral from the point on."""
    special = e.atoms(sympy.RootSum, sympy.hyper, sympy.Integral, *_ODD)
    sums = {  # SymPy's substitution would compute rational ones exactly, without end
        r: sympy.RootSum(r.poly, sympy.Lambda(r.fun.variables, _substituted(r.fun.expr, x, point)), auto=False)
        for r in special
        if isinstance(r, sympy.RootSum)
    }
    value = (e.xreplace(sums) if sums else e).subs(x, point)
    if special:
        value = value.xreplace({f: _ONE for f in value.atoms(sympy.hyper) if f.argument == 0})
        value = value.xreplace({f: _ZERO for f in value.atoms(*_ODD) if f.args[-1] == 0})
        empty = (i for i in value.atoms(sympy.Integral) if i.limits[0][1:2] == i.limits[0][2:])
        value = value.xreplace(dict.fromkeys(empty, _ZERO))
    if not _OPEN.isdisjoint(value.atoms()):
        raise _SingularError
    return value

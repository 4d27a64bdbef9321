"""The value and the slope of an expression at a point, without its derivative being written out.

Each subexpression becomes the pair (f(a), f'(a)), by the rules for sums, products, powers and elementary functions; others are
differentiated.  Where that isn't finite, the expression may be of the form 0/0, and SymPy's limit is taken.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import sympy
from sympy import Add, Heaviside, Mul, Pow, cos, exp, log, sin
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.apart import last_of
from kovacic.limits import watched_seconds

Expr = Any  # SymPy publishes no types
Pair = tuple[Expr, Expr]  # f(a), f'(a)
#: Seconds for a question about a constant.
SECONDS = 10.0
_ZERO, _ONE = sympy.Integer(0), sympy.Integer(1)
_OPEN = (sympy.nan, sympy.zoo, sympy.oo, -sympy.oo)
_SLOPES: dict[Any, Callable[[Expr], Expr]] = {
    exp: exp,
    log: lambda u: 1 / u,
    sin: cos,
    cos: lambda u: -sin(u),
    Heaviside: lambda u: _ZERO,  # beside the jump
}


class _SingularError(Exception):
    """A subexpression isn't finite at the point."""


def values_at(expression: Expr, x: Expr, point: Expr) -> Pair:
    """(f(a), f'(a)) at an ordinary point of f; at the jump of a step function, just before it.

    Raises `NotImplementedError` for a form 0/0 whose limit isn't found.

    >>> x = sympy.Symbol("x")
    >>> values_at(x * exp(2 * x), x, sympy.Integer(1))
    (exp(2), 3*exp(2))
    """
    expression = sympy.sympify(expression, strict=True)
    try:
        return _pair(expression, x, point)
    except _SingularError:
        return _limit_at(expression, x, point), _limit_at(expression.diff(x), x, point)


def wronskian_at(y1: Expr, y2: Expr, x: Expr, point: Expr) -> Expr | None:
    """y1 y2' - y1' y2 at a point; None where these aren't finite."""
    try:
        (u, du), (v, dv) = _pair(y1, x, point), _pair(y2, x, point)
    except _SingularError:
        return None
    return _product((u, dv)) - _product((du, v))


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


def _pair(e: Expr, x: Expr, a: Expr) -> Pair:
    if e == x:
        return a, _ONE
    if e.is_Atom:
        return e, _ZERO
    if isinstance(e, sympy.RootSum):  # SymPy's substitution would compute rational sums exactly, without end
        root, inner = e.fun.variables[0], e.fun.expr
        sums = (sympy.Lambda(root, _substituted(part, x, a)) for part in (inner, inner.diff(x)))
        value, slope = (sympy.RootSum(e.poly, part, auto=False) for part in sums)
        return value, slope
    if not (e.is_Add or e.is_Mul or e.is_Pow or e.func in _SLOPES):
        return (_substituted(e, x, a), _substituted(e.diff(x), x, a)) if e.has_free(x) else (e, _ZERO)
    pairs = [_pair(argument, x, a) for argument in (e.args[:1] if e.func is Heaviside else e.args)]
    values, slopes = zip(*pairs, strict=True)
    if e.is_Add:
        return Add(*values), Add(*slopes)
    if e.is_Mul:
        return _product(values), Add(*(_product((*values[:k], s, *values[k + 1 :])) for k, s in enumerate(slopes)))
    if e.func is Heaviside and values[0] == 0:
        return _ZERO, _ZERO
    value = _finite(e.func(*values))
    if e.func in _SLOPES:
        return value, _product((_SLOPES[e.func](values[0]), slopes[0])) if slopes[0] != 0 else _ZERO
    base, exponent = values
    by_base = _ZERO if slopes[0] == 0 else _finite(exponent * Pow(base, exponent - 1)) * slopes[0]
    return value, by_base if slopes[1] == 0 else by_base + value * _finite(log(base)) * slopes[1]


def _product(values: tuple[Expr, ...]) -> Expr:
    """Of finite values; SymPy takes milliseconds to find that something else times zero is zero."""
    return _ZERO if any(value == 0 for value in values) else Mul(*values)


def _finite(value: Expr) -> Expr:
    if value.has(*_OPEN):
        raise _SingularError
    return value


def _substituted(e: Expr, x: Expr, point: Expr) -> Expr:
    """The value of a function, of a series at 0, or of an integral from the point on."""
    value = e.subs(x, point)
    value = value.xreplace({f: _ONE for f in value.atoms(sympy.hyper) if f.argument == 0})
    empty = (i for i in value.atoms(sympy.Integral) if i.limits[0][1:2] == i.limits[0][2:])
    return _finite(value.xreplace(dict.fromkeys(empty, _ZERO)))


def _limit_at(e: Expr, x: Expr, point: Expr) -> Expr:
    jumps = e.atoms(Heaviside, sympy.DiracDelta)
    e = e.xreplace({jump: _ZERO for jump in jumps if jump.args[0].subs(x, point) == 0})
    try:
        return _substituted(e, x, point)
    except _SingularError:
        limit = None
    if not e.has(sympy.hyper, BesselBase):  # SymPy takes limits of sqrt(x) besselk(1/4, x^2/2) wrong
        limit = last_of(_limit, e, x, point, seconds=watched_seconds(SECONDS))
    if limit is None:
        said = f"the functions of the closed form are singular at {point}, where the solutions aren't"
        raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of this solution")
    return limit


def _limit(expression: Expr, x: Expr, point: Expr) -> Iterator[Expr]:
    yield sympy.limit(expression, x, point)

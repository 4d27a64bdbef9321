"""Lower bounds of an elementary function on a half-line [c, oo), proven in interval arithmetic with infinite ends.

>>> import sympy
>>> x = sympy.Symbol("x")
>>> round(float(lower_bound(x**4 - 20*x**2, x, sympy.Integer(5))), 9)  # x^4 (1 - 20/x^2)
125.0
>>> float(lower_bound(sympy.cosh(x) - x**2, x, sympy.Integer(4))) > 11
True
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import sympy
from flint import arb

from kovacic.closed_form.balls import BallEvaluator
from kovacic.errors import InputError

Expr = Any
#: Exact lower and upper bound, possibly infinite.
Range = tuple[Any, Any]

_INFINITY = arb.pos_inf()
_EVERYTHING = (-_INFINITY, _INFINITY)
#: Derivatives that are tried: cosh(x) - x^2 needs three.
_MOST_DERIVATIVES = 4
_HYPERBOLIC = [sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch]
#: Terms of a sum, up to which each is tried as the dominant one.
_MOST_TERMS_OF_SUM = 12


def lower_bound(e: Expr, x: Expr, c: Expr, *, derivatives: int = _MOST_DERIVATIVES) -> Any:
    """A number (an exact arb, maybe -oo) that isn't above any value of e on [c, oo).

    The expression as it stands, with its dominant term as a factor, and, where its derivative isn't negative, its
    value at c.
    """
    simple = _direct(e, x, c)
    if simple > -_INFINITY:
        return simple
    factored = _dominated(e, x, c)
    if factored > -_INFINITY:
        return factored
    if derivatives == 0:
        return -_INFINITY
    slope = lower_bound(sympy.expand(e.diff(x)), x, c, derivatives=derivatives - 1)
    if slope >= 0:
        value = BallEvaluator({x: BallEvaluator({})(c)})(e).real
        if value.is_finite():
            return value.lower()
    return -_INFINITY


def _direct(e: Expr, x: Expr, c: Expr) -> Any:
    start = BallEvaluator({})(c).real
    try:
        return _Ranges(x, (start.lower(), _INFINITY)).of(e)[0]
    except InputError:  # a function that isn't known here
        return -_INFINITY


def _dominated(e: Expr, x: Expr, c: Expr) -> Any:
    """num/den, each as a term times 1 plus quotients of terms; for hyperbolic functions in exponentials."""
    in_exponentials = e.rewrite(_HYPERBOLIC, sympy.exp)
    num, den = sympy.fraction(sympy.together(in_exponentials))
    best = -_INFINITY
    for above in _by_its_terms(num):
        for below in _by_its_terms(den):
            leading = sympy.powsimp(above[0] / below[0])
            best = max(best, _direct(leading * above[1] / below[1], x, c))
    return best


def _by_its_terms(e: Expr) -> list[tuple[Expr, Expr]]:
    """(T, e/T) for each term T of e, with e/T expanded."""
    terms = sympy.Add.make_args(sympy.expand(e))
    if len(terms) > _MOST_TERMS_OF_SUM:
        return [(e, sympy.Integer(1))]
    return [(term, sympy.Add(*(sympy.powsimp(other / term) for other in terms))) for term in terms]


class _Ranges:
    """The range of an expression whose variable has a range."""

    def __init__(self, x: Expr, start: Range) -> None:
        self.known: dict[Expr, Range] = {x: start}

    def of(self, e: Expr) -> Range:
        """Raises `InputError` for functions that aren't known here."""
        found = self.known.get(e)
        if found is None:
            found = self.known[e] = self._computed(e)
        return found

    def _computed(self, e: Expr) -> Range:
        if not e.free_symbols:
            return _range_of_constant(e)
        if e.is_Add:
            lower, upper = zip(*map(self.of, e.args), strict=True)
            return reduce(lambda a, b: _exact_lower(a + b), lower), reduce(lambda a, b: _exact_upper(a + b), upper)
        if e.is_Mul:
            return reduce(_product_of_ranges, map(self.of, e.args))
        if e.is_Pow and e.base is not sympy.E:
            return self._power(e)
        argument = self.of(e.exp if e.is_Pow else e.args[0])
        if e.func in (sympy.sin, sympy.cos):
            return -arb(1), arb(1)
        if e.func in (sympy.cosh, sympy.Abs):
            return _even(_INCREASING[e.func], argument)
        increasing = sympy.exp if e.is_Pow else e.func
        if increasing not in _INCREASING:
            raise InputError(f"the range of {e} isn't known here")
        return _monotone(_INCREASING[increasing], argument)

    def _power(self, e: Expr) -> Range:
        low, high = self.of(e.base)
        exponent = e.exp
        if exponent.free_symbols:
            raise InputError(f"the range of {e} isn't known here")
        if exponent.is_negative:
            low, high = self.of(e.base ** (-exponent))
            return (
                (_exact_lower(_reciprocal(high)), _exact_upper(_reciprocal(low)))
                if low > 0 or high < 0
                else _EVERYTHING
            )
        if exponent.is_Integer and exponent % 2 == 0:
            return _even(lambda b: b ** int(exponent), (low, high))
        if exponent.is_Integer:
            return _monotone(lambda b: b ** int(exponent), (low, high))
        if not low >= 0:
            return _EVERYTHING
        ball = BallEvaluator({})(exponent).real
        return _monotone(lambda b: b**ball, (low, high))


def _range_of_constant(e: Expr) -> Range:
    value = BallEvaluator({})(e)
    if not value.is_finite() or not value.imag.is_zero():
        raise InputError(f"{e} isn't known to be real")
    return value.real.lower(), value.real.upper()


#: Increasing functions, the last two of the absolute value.
_INCREASING: dict[Any, Callable[[Any], Any]] = {
    sympy.exp: lambda b: arb(0) if b < 0 and not b.is_finite() else b.exp(),
    sympy.log: lambda b: b.log() if b > 0 else -_INFINITY,
    sympy.sinh: lambda b: b.sinh(),
    sympy.tanh: lambda b: b.tanh() if b.is_finite() else b.sgn(),
    sympy.atan: lambda b: b.atan() if b.is_finite() else b.sgn() * arb.pi() / 2,
    sympy.cosh: lambda b: b.cosh(),
    sympy.Abs: lambda b: b,
}


def _monotone(function: Callable[[Any], Any], argument: Range) -> Range:
    return _exact_lower(_limit_at(function, argument[0])), _exact_upper(_limit_at(function, argument[1]))


def _limit_at(function: Callable[[Any], Any], bound: Any) -> Any:
    """The value at a bound; a function that isn't bounded there tends to an infinity of the same sign."""
    value = function(bound)
    return bound if value.is_nan() else value


def _even(function: Callable[[Any], Any], argument: Range) -> Range:
    low, high = argument
    nearest = max(low, -high, arb(0))
    return _monotone(function, (nearest, max(-low, high)))


def _product_of_ranges(a: Range, b: Range) -> Range:
    """Infinite bounds aren't reached, so that 0 times such a one is 0."""
    products = [arb(0) if s == 0 or t == 0 else s * t for s in a for t in b]
    return min(map(_exact_lower, products)), max(map(_exact_upper, products))


def _reciprocal(bound: Any) -> Any:
    return 1 / bound if bound.is_finite() else arb(0)


def _exact_lower(bound: Any) -> Any:
    """An exact lower bound; -oo where nothing is known (oo - oo)."""
    if bound.is_nan():
        return -_INFINITY
    return bound.lower() if bound.is_finite() else bound


def _exact_upper(bound: Any) -> Any:
    if bound.is_nan():
        return _INFINITY
    return bound.upper() if bound.is_finite() else bound

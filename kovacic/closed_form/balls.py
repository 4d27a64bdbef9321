"""SymPy expressions in ball arithmetic, operation by operation: nothing of SymPy's own numerical evaluation goes in, whose
digits aren't proven.

A symbol has a ball (flint's `acb`) or, where derivatives are wanted, a Taylor series of balls (`acb_series`) for its value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache, reduce
from operator import add, mul
from typing import Any

import sympy
from flint import acb, acb_series, arb, ctx, fmpq, fmpz_poly

from kovacic.algebra.embedding import root_near
from kovacic.errors import InputError
from kovacic.limits import check_duration, check_time

BallValue = Any  # an acb or an acb_series
#: Of a product or a quotient of power series, for each coefficient and bit: FLINT can't be stopped inside.
_SERIES_SECONDS = 6e-8

_CONSTANTS = {
    sympy.pi: arb.pi,
    sympy.E: arb.const_e,
    sympy.EulerGamma: arb.const_euler,
    sympy.Catalan: arb.const_catalan,
}
#: Flint's methods of the same names; none of these has a branch cut.
_MEROMORPHIC = """
    exp sin cos tan cot sec csc sinh cosh tanh coth sech csch gamma erf erfc erfi zeta
"""
#: Their branch cuts are those of logarithms and roots.
_INVERSE = "asin acos atan asinh acosh atanh"
_NAMES = {getattr(sympy, name): name for name in (_MEROMORPHIC + _INVERSE).split()}
_CUT = {getattr(sympy, name) for name in _INVERSE.split()}
#: Of power series flint has fewer functions: others are quotients,
_QUOTIENTS: dict[str, Callable[[Any], Any]] = {
    "cot": lambda s: _quotient(s.cos(), s.sin()),
    "sec": lambda s: _quotient(1, s.cos()),
    "csc": lambda s: _quotient(1, s.sin()),
    "sinh": lambda s: (s.exp() - (-s).exp()) / 2,
    "cosh": lambda s: (s.exp() + (-s).exp()) / 2,
    "tanh": lambda s: 1 - _quotient(2, (2 * s).exp() + 1),
    "coth": lambda s: 1 + _quotient(2, (2 * s).exp() - 1),
    "sech": lambda s: _quotient(2, s.exp() + (-s).exp()),
    "csch": lambda s: _quotient(2, s.exp() - (-s).exp()),
}
#: or have a derivative that it knows, on their principal branches.
_SLOPES: dict[str, Callable[[Any], Any]] = {
    "asin": lambda s: (1 - s * s).rsqrt(),
    "acos": lambda s: -(1 - s * s).rsqrt(),
    "asinh": lambda s: (1 + s * s).rsqrt(),
    "acosh": lambda s: (s - 1).rsqrt() * (s + 1).rsqrt(),
    "atanh": lambda s: _quotient(1, 1 - s * s),
}


class BallEvaluator:
    """The values of expressions at given values of some symbols; those of subexpressions are kept.

    With `analytic` a value isn't finite where the expression isn't analytic on the balls, for quadratures.
    """

    def __init__(self, values: Mapping[Any, BallValue], *, analytic: bool = False) -> None:
        self.values = values
        self.analytic = analytic
        self._known: dict[Any, BallValue] = dict(values)

    def __call__(self, e: Any) -> BallValue:
        """Raises `InputError` for functions that aren't known here."""
        found = self._known.get(e)
        if found is None:
            check_time()
            found = self._known[e] = self._evaluated(e)
            if isinstance(found, acb_series):
                _check_series()
        return found

    def _evaluated(self, e: Any) -> BallValue:
        if e.is_Add:
            return reduce(add, map(self, e.args))
        if e.is_Mul:
            return reduce(mul, map(self, e.args))
        if e.is_Pow:
            return self._power(*e.args)
        number = _number(e)
        if number is not None:
            return number
        if e.func is sympy.log and len(e.args) == 1:
            return self._cut(e.args[0], "log")
        if e.func in _NAMES and len(e.args) == 1:
            return self._applied(e)
        if e.func is sympy.acot:
            return self(sympy.atan(1 / e.args[0]))
        return self.other(e)

    def _power(self, base: Any, exponent: Any) -> BallValue:
        if exponent.is_Integer:
            return _whole_power(self(base), int(exponent))
        if base is sympy.E:
            return self(exponent).exp()
        if exponent in (sympy.S.Half, -sympy.S.Half):
            root = self._cut(base, "sqrt")
            return root if exponent == sympy.S.Half else _quotient(1, root)
        return (self(exponent) * self._cut(base, "log")).exp()

    def _cut(self, argument: Any, name: str) -> BallValue:
        """A root or a logarithm."""
        value = self(argument)
        function = getattr(value, name)
        if isinstance(value, acb):
            return function(analytic=self.analytic and self.depends(argument))
        return function()

    def depends(self, argument: Any) -> bool:
        """False for a constant, which may lie on a cut."""
        return bool(argument.free_symbols)

    def _applied(self, e: Any) -> BallValue:
        if self.analytic and e.func in _CUT:
            return self(e.rewrite(sympy.log))
        value = self(e.args[0])
        name = _NAMES[e.func]
        if isinstance(value, acb) and value.imag.is_zero() and hasattr(arb, name):
            real = getattr(value.real, name)()  # FLINT's complex atanh isn't exactly real
            if real.is_finite():
                return acb(real)
        if hasattr(value, name):
            return getattr(value, name)()
        if name in _QUOTIENTS:
            return _QUOTIENTS[name](value)
        if name in _SLOPES:
            return (_SLOPES[name](value) * value.derivative()).integral() + getattr(value[0], name)()
        return self.other(e)

    def other(self, e: Any) -> BallValue:
        """What isn't arithmetic and an elementary function."""
        known = ", ".join((_MEROMORPHIC + _INVERSE).split())
        raise InputError(f"{e} isn't known in balls", hint=f"the functions are log, sqrt, {known}")


def _quotient(above: Any, below: BallValue) -> BallValue:
    """above/below; FLINT has a value that isn't finite where a ball contains zero, and for a series raises an error."""
    if isinstance(below, acb_series) and below[0].contains(0):
        return above * below**-1
    return above / below


def _number(e: Any) -> acb | None:
    """A rational number, a float, a constant or a root of a polynomial over Q; None for another expression."""
    if e.is_Rational:
        return acb(arb(fmpq(int(e.p), int(e.q))))
    if e.is_Float:
        return acb(e)
    if e is sympy.I:
        return acb(0, 1)
    if e in _CONSTANTS:
        return acb(_CONSTANTS[e]())
    if isinstance(e, sympy.CRootOf):
        integers = e.poly.clear_denoms()[1].all_coeffs()[::-1]
        return root_near(fmpz_poly([int(c) for c in integers]), acb(_coarse_value(e)))
    return None


@lru_cache(maxsize=256)
def _coarse_value(root: Any) -> complex:
    """A root of a polynomial to a few digits: which one it is."""
    return complex(root.evalf(15))


def _check_series() -> None:
    """Raises `LimitExceeded` where there isn't the time for another operation with such a series."""
    check_duration(_SERIES_SECONDS * ctx.cap * ctx.prec, f"a product of power series with {ctx.cap} terms")


def _whole_power(value: BallValue, exponent: int) -> BallValue:
    """That of a series by squarings, so that the clock is looked at between them."""
    if not isinstance(value, acb_series):
        return value**exponent
    if exponent < 0:
        power = _whole_power(value, -exponent)
        return _quotient(1, power)
    power = acb_series([1])
    for digit in f"{exponent:b}":
        power = power * power
        if digit == "1":
            power = power * value
        _check_series()
    return power

"""Removable singularities of coefficients: sin(x)/x at 0, (1 - cos(x))/x^2, x/(exp(x) - 1), cot(x) - 1/x.

A coefficient is a quotient n/d of functions that are analytic at z, and vanish there to the orders k and l at least: this is
decided exactly, by their derivatives at z as SymPy evaluates them (sin(0) = 0).  With N = n/(x - z)^k and D = d/(x - z)^l it
is (x - z)^(k - l) N/D, and N and D are analytic where n and d are.  Where g = n or d has the series sum g_j u^j at z,
u = x - z, and is bounded by M for |u| <= R, which balls show,

    g/u^k = sum_(j<T) g_(j+k) u^j + tail,    |tail| <= M R^-k (r/R)^T/(1 - r/R)    for |u| <= r < R                  [Cauchy],

with the first k coefficients 0 exactly.  Farther from z it is the quotient itself.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import sympy
from flint import acb, acb_poly, acb_series, arb, ctx

from kovacic.algebra.precision import series_length
from kovacic.closed_form.balls import BallEvaluator
from kovacic.enclosure.points import are_real, around_zero

_MOST = 12
"""The highest order of a zero that is looked for."""
_LONGEST = 60
"""Coefficients of a polynomial that is moved to the middle of a ball, at most."""
_NEAR = arb(0.5)
_WIDER = (2.0, 1.25)
"""R/r, as tried."""
_QUOTIENTS = {
    sympy.tan: lambda u: sympy.sin(u) / sympy.cos(u),
    sympy.cot: lambda u: sympy.cos(u) / sympy.sin(u),
    sympy.sec: lambda u: 1 / sympy.cos(u),
    sympy.csc: lambda u: 1 / sympy.sin(u),
    sympy.coth: lambda u: sympy.cosh(u) / sympy.sinh(u),
    sympy.csch: lambda u: 1 / sympy.sinh(u),
}


class Divided(sympy.Function):  # type: ignore[misc]
    """g/((x - z1)^k1 (x - z2)^k2 ...), of g, x, z1, k1, z2, k2, ...: analytic where g is."""

    @classmethod
    def eval(cls, *_arguments: Any) -> None:
        """It stays."""


def without_removable(e: Any, x: Any) -> Any:
    """The same function, where removable singularities at the zeros of its polynomial factors are none of its writing."""
    if not e.has(x) or e.is_rational_function(x):
        return e
    plain = e
    for function, quotient in _QUOTIENTS.items():
        plain = plain.replace(function, quotient)
    numerator, denominator = sympy.fraction(sympy.together(plain))
    over: list[tuple[Any, int]] = []
    under: list[tuple[Any, int]] = []
    powers = []
    for zero in _zeros(numerator, x) | _zeros(denominator, x):
        k = _order(numerator, x, zero)
        m = _order(denominator, x, zero)
        if k > 0 and m > 0:
            over.append((zero, k))
            under.append((zero, m))
            powers.append((x - zero) ** (k - m))
    if not over:
        return e
    return sympy.Mul(*powers, _divided(numerator, x, over), 1 / _divided(denominator, x, under))


def _divided(function: Any, x: Any, zeros: list[tuple[Any, int]]) -> Any:
    pairs: list[Any] = []
    for zero, k in zeros:
        pairs += [zero, sympy.Integer(k)]
    return Divided(function, x, *pairs)


def _zeros(product: Any, x: Any) -> set[Any]:
    """The zeros of linear factors over Q of its polynomial factors."""
    found = set()
    for factor in sympy.Mul.make_args(product):
        base = factor.base if factor.is_Pow else factor
        if not base.has(x) or not base.is_polynomial(x):
            continue
        for part, _ in sympy.Poly(base, x).factor_list()[1]:
            if part.degree() == 1:
                found.add(-part.nth(0) / part.nth(1))
    return found


def _order(function: Any, x: Any, zero: Any) -> int:
    """So many derivatives, from the function itself on, are 0 at the point."""
    for k in range(_MOST):
        if function.xreplace({x: zero}) != 0:
            return k
        function = function.diff(x)
    return _MOST


class CoefficientEvaluator(BallEvaluator):
    """Values of coefficients at values of the variable and of parameters, with the functions that were divided."""

    def __init__(self, values: Mapping[Any, Any], *, variable: Any, analytic: bool = False) -> None:
        super().__init__(values, analytic=analytic)
        self.variable = variable

    def depends(self, argument: Any) -> bool:
        """A parameter is a number: log(a) with a = -2 is a constant."""
        return bool(argument.has(self.variable))

    def _evaluated(self, e: Any) -> Any:
        """A polynomial on a ball by its Taylor polynomial at the midpoint, since terms that cancel would widen it."""
        x: Any = self.values.get(self.variable)
        coefficients = _coefficients(e, self.variable) if e.is_Add and isinstance(x, acb) else None
        if coefficients is None:
            return super()._evaluated(e)
        middle = acb(x.mid())
        return acb_poly(list(map(self, coefficients)))(acb_poly([middle, 1]))(x - middle)

    def other(self, e: Any) -> Any:
        if not isinstance(e, Divided):
            return super().other(e)
        function, symbol, *rest = e.args
        x = self.values[symbol]
        pairs = list(zip(map(self, rest[::2]), map(int, rest[1::2]), strict=True))
        near = next((pair for pair in pairs if _is_near(x, pair[0])), None)
        value = self(function) if near is None else self._near(function, symbol, x, *near)
        for zero, k in pairs:
            if (zero, k) != near:
                value = value / (x - zero) ** k
        return value

    def _near(self, function: Any, symbol: Any, x: Any, zero: acb, k: int) -> Any:
        """The function over (x - zero)^k, by its series there."""
        if isinstance(x, acb_series):
            centre = x[0] - zero
            scale = x[1]
        else:
            centre = x - zero
            scale = acb(0)
        reach = (abs(centre) + 2 * abs(scale)).upper()
        if reach.is_zero():
            reach = arb(_NEAR)
        for wider in _WIDER:
            size = self._size(function, symbol, zero, reach * wider)
            if size.is_finite():
                break
        else:
            return self(function) / (x - zero) ** k
        terms = int(ctx.prec / math.log2(wider)) + 8
        coefficients = self._series(function, symbol, zero, terms + k)[k:]
        tail = (size / (reach * wider) ** k * arb(wider) ** -terms / (1 - 1 / arb(wider))).upper()
        polynomial = acb_poly(coefficients)
        inside = zero + arb(0, reach)
        values = CoefficientEvaluator({**self.values, symbol: inside}, variable=symbol)
        error = around_zero(tail, real=are_real([inside, centre, scale, values(function)]))
        if not isinstance(x, acb_series):
            return polynomial(centre) + error
        found = polynomial(acb_poly([centre, scale])).coeffs()[: ctx.cap]
        found += [acb(0)] * (ctx.cap - len(found))
        return acb_series([value + error / 2**j for j, value in enumerate(found)])

    def _size(self, function: Any, symbol: Any, zero: acb, radius: arb) -> arb:
        """A bound in a disc; not finite where the function isn't known to be analytic there."""
        radius = radius.upper()
        box = acb(zero.real + arb(0, radius), zero.imag + arb(0, radius))
        values = {**self.values, symbol: box}
        return abs(CoefficientEvaluator(values, variable=symbol, analytic=True)(function)).upper()

    def _series(self, function: Any, symbol: Any, zero: acb, terms: int) -> list[acb]:
        """The coefficients at the zero."""
        with series_length(terms):
            values = {**self.values, symbol: acb_series([zero, acb(1)])}
            found = CoefficientEvaluator(values, variable=symbol)(function).coeffs()
        return [*found, *[acb(0)] * (terms - len(found))]


@lru_cache(maxsize=1024)
def _coefficients(e: Any, x: Any) -> list[Any] | None:
    """Those of a polynomial of some degree from 2 on, from low to high; None for other expressions."""
    if not e.is_polynomial(x):
        return None
    found: list[Any] = sympy.Poly(e, x).all_coeffs()[::-1]
    return found if 2 < len(found) <= _LONGEST else None


def _is_near(x: Any, zero: acb) -> bool:
    """Is the quotient better taken from the series?"""
    if isinstance(x, acb_series):
        return not abs(x[0] - zero) > _NEAR + 2 * abs(x[1])
    distance = abs(x - zero)
    return not (distance.lower() > _NEAR and distance.lower() > distance.rad())

"""f, f' and f''/2 of a SymPy expression at a complex point, without its derivatives as expressions; in mpmath's precision.

A list of at most three Taylor coefficients stands for a function near the point, one of a single element for a constant.
Powers, exponentials and logarithms have their own rules; any other function of one argument is evaluated beside the
argument's value, at the distance h, which leaves an error of about h^2.

An unevaluated integral may be any antiderivative: its slope is the integrand, and its value a random number, the same one
wherever that integral occurs.  A sum over the roots of a polynomial is taken over the roots as numbers.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from functools import cache
from typing import Any

import flint
import mpmath
import sympy

Series = list[Any]
_Z = sympy.Symbol("z_")


class Unreadable(Exception):
    """The expression has functions or symbols that aren't known here."""


class Known:
    """What doesn't depend on the point: the values of constants, and of integrals; within a sum over roots, for each root."""

    def __init__(self, rng: random.Random) -> None:
        self.constants: dict[Any, Series] = {}
        self.integrals: dict[Any, Any] = {}
        self.rng = rng
        self._at_roots: dict[Any, Known] = {}

    def at_root(self, e: Any, k: int) -> Known:
        if (e, k) not in self._at_roots:
            self._at_roots[e, k] = Known(self.rng)
        return self._at_roots[e, k]


class Expansion:
    """Expressions near a point, which `variables` gives: x stands for [point, 1], the others are constants."""

    def __init__(self, variables: dict[Any, Series], known: Known) -> None:
        self._variables, self._known = variables, known
        self._memo: dict[Any, Series] = dict(variables)

    def __call__(self, e: Any) -> Series:
        constants = self._known.constants
        if e in constants:
            return constants[e]
        if e not in self._memo:
            series = self._expand(e)
            (self._memo if len(series) > 1 else constants)[e] = series
            return series
        return self._memo[e]

    def _expand(self, e: Any) -> Series:
        if e.is_Rational:
            return [mpmath.mpf(e.p) / e.q]
        if e.is_Symbol:
            raise Unreadable(e.name)
        if e.is_Add:
            return _sum([self(term) for term in e.args])
        if e.is_Mul:
            result = self(e.args[0])
            for factor in e.args[1:]:
                result = _product(result, self(factor))
            return result
        if isinstance(e, sympy.exp):
            return _chain(self(e.args[0]), _exponential)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, sympy.log):
            return _chain(self(e.args[0]), _logarithm)
        if isinstance(e, sympy.Integral):
            return self._integral(e)
        if isinstance(e, sympy.RootSum):
            return self._sum_over_roots(e)
        return self._function(e) if e.free_symbols else [e._to_mpmath(mpmath.mp.prec)]

    def _power(self, e: Any) -> Series:
        base, exponent = self(e.base), self(e.exp)
        if len(exponent) > 1:
            return _chain(_product(exponent, _chain(base, _logarithm)), _exponential)
        k = int(e.exp) if e.exp.is_Integer else exponent[0]
        if len(base) == 1:
            return [base[0] ** k]
        if k == 2:
            return _product(base, base)
        return _chain(base, lambda u: _power_at(u, k))

    def _integral(self, e: Any) -> Series:
        values, rng = self._known.integrals, self._known.rng
        if e not in values:
            values[e] = mpmath.mpc(rng.random() + 1, rng.randint(1, 9))
        slope = self(e.function)
        return [values[e], slope[0], slope[1] / 2 if len(slope) > 1 else mpmath.mpf(0)]

    def _sum_over_roots(self, e: Any) -> Series:
        terms = []
        coefficients = e.poly.all_coeffs()
        rational = all(c.is_Rational for c in coefficients)
        roots = _rational_roots(e.poly) if rational else _roots([self(c)[0] for c in coefficients])
        for k, root in enumerate(roots):
            near = Expansion({**self._variables, e.fun.variables[0]: [root]}, self._known.at_root(e, k))
            terms.append(near(e.fun.expr))
        return _sum(terms)

    def _function(self, e: Any) -> Series:
        """Any other function, of one argument that isn't a constant."""
        varying = [k for k, argument in enumerate(e.args) if argument.free_symbols]
        if len(varying) != 1 or not isinstance(e, sympy.Function):
            raise Unreadable(type(e).__name__)
        (k,) = varying
        outer = _outer(e.func, (*e.args[:k], _Z, *e.args[k + 1 :]))
        return _chain(self(e.args[k]), lambda u: _by_differences(outer, u))


def _sum(terms: list[Series]) -> Series:
    length = max(map(len, terms), default=0)
    return [mpmath.fsum(term[k] for term in terms if len(term) > k) for k in range(length)] or [mpmath.mpf(0)]


def _product(f: Series, g: Series) -> Series:
    if len(f) == 1 or len(g) == 1:
        (c, *_), rest = (f, g) if len(f) == 1 else (g, f)
        return [c * value for value in rest]
    f, g = ([*series, 0][:3] for series in (f, g))
    return [f[0] * g[0], f[0] * g[1] + f[1] * g[0], f[0] * g[2] + f[1] * g[1] + f[2] * g[0]]


def _chain(u: Series, outer: Callable[[Any], Series]) -> Series:
    """outer(u), from the three Taylor coefficients of `outer` at u[0]."""
    value, first, second = outer(u[0])
    if len(u) == 1:
        return [value]
    bend = first * u[2] if len(u) > 2 else 0
    return [value, first * u[1], second * u[1] ** 2 + bend]


def _exponential(u: Any) -> Series:
    value = mpmath.exp(u)
    return [value, value, value / 2]


def _logarithm(u: Any) -> Series:
    return [mpmath.log(u), 1 / u, -1 / (2 * u * u)]


def _power_at(u: Any, k: Any) -> Series:
    value = u**k
    slope = k * value / u
    return [value, slope, (k - 1) * slope / (2 * u)]


def _by_differences(f: Callable[[Any], Any], u: Any) -> Series:
    h = mpmath.mpf(10) ** (-(mpmath.mp.dps // 5))
    before, value, after = (mpmath.mpmathify(f(u + step)) for step in (-h, 0, h))
    return [value, (after - before) / (2 * h), (after - 2 * value + before) / (2 * h * h)]


@cache
def _outer(function: Any, arguments: tuple[Any, ...]) -> Callable[[Any], Any]:
    compiled: Callable[[Any], Any] = sympy.lambdify(_Z, function(*arguments), "mpmath")
    return compiled


@cache
def _rational_roots(polynomial: Any) -> list[Any]:
    """The complex roots, in the precision of the first call."""
    integers = polynomial.clear_denoms()[1].all_coeffs()[::-1]
    with flint.ctx.workdps(mpmath.mp.dps):
        roots = [root for root, _ in flint.fmpz_poly([int(c) for c in integers]).complex_roots()]
        parts = [[part.str(mpmath.mp.dps, radius=False) for part in (root.real, root.imag)] for root in roots]
    return [mpmath.mpc(*pair) for pair in parts]


def _roots(coefficients: list[Any]) -> list[Any]:
    found: list[Any] = mpmath.polyroots(coefficients, maxsteps=500, extraprec=2 * mpmath.mp.prec)
    return found

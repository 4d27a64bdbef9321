"""Values with first and second derivatives of SymPy expressions, by mpmath: the numerical check of what is shown.

An unevaluated integral counts as an antiderivative with an arbitrary constant: its value is taken as 1, and its derivatives
are those of the integrand.  In y1 int y1^-2 and exp(int ...) the constant changes the solution into another one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath
import sympy

Number = Any  # mpmath's mpc and mpf
Jet = tuple[Number, Number, Number]
Unary = Callable[[Number], Jet]


def jet(expression: Any, variable: Any, point: Number) -> Jet:
    """(f, f', f'') at the point, in the current precision of mpmath.

    Raises `NotImplementedError` for a function that no closed form of this package contains.
    """
    return _Evaluator(variable, point)(expression)


def parameter_value(name: str) -> Number:
    """The value that a parameter takes in the check: a number that isn't special."""
    return mpmath.mpf(1) + mpmath.mpf(sum(ord(c) * 31**k for k, c in enumerate(name)) % 9973) / 9967


class _Evaluator:
    def __init__(self, variable: Any, point: Number) -> None:
        self.bindings: dict[Any, Jet] = {variable: (mpmath.mpmathify(point), mpmath.mpf(1), mpmath.mpf(0))}
        self.variable = variable
        self.memo: dict[Any, Jet] = {}

    def __call__(self, e: Any) -> Jet:
        if e in self.bindings:
            return self.bindings[e]
        known = self.memo.get(e)
        if known is None:
            known = self._evaluate(e)
            self.memo[e] = known
        return known

    def _evaluate(self, e: Any) -> Jet:
        if e.is_Rational:
            return _constant(mpmath.mpf(int(e.p)) / int(e.q))
        if e.is_Add:
            jets = [self(arg) for arg in e.args]
            return tuple(mpmath.fsum(part) for part in zip(*jets, strict=True))
        if e.is_Mul:
            result = self(e.args[0])
            for arg in e.args[1:]:
                result = _times(result, self(arg))
            return result
        if isinstance(e, sympy.exp):
            return _chain(self(e.args[0]), _exp)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, sympy.RootSum):
            return self._root_sum(e)
        if isinstance(e, sympy.Integral):
            value, first, _ = self(e.function)
            return mpmath.mpf(1), value, first
        if isinstance(e, (sympy.uppergamma, sympy.lowergamma)):
            return self._incomplete_gamma(e)
        if isinstance(e, sympy.hyper):
            return self._hyper(e)
        function = _UNARY.get(e.func)
        if function is not None:
            return _chain(self(e.args[0]), function)
        if e.is_Symbol:
            return _constant(parameter_value(e.name))
        if not e.free_symbols:
            return _constant(mpmath.mpmathify(e._to_mpmath(mpmath.mp.prec)))
        raise NotImplementedError(f"the function {e.func} can't be evaluated")

    def _power(self, e: Any) -> Jet:
        base, exponent = e.args
        value = self(base)
        if self.variable in exponent.free_symbols:
            return _chain(_times(self(exponent), _chain(value, _log)), _exp)
        k = int(exponent) if exponent.is_Integer else self(exponent)[0]
        if k == -1:
            inverse = 1 / value[0]
            first = -value[1] * inverse**2
            return inverse, first, -(value[2] * inverse**2) - 2 * first * value[1] * inverse
        power = value[0] ** k
        if k == 0 or value[1] == 0 == value[2]:
            return _constant(power)
        slope = k * power / value[0]
        return power, slope * value[1], slope * value[2] + (k - 1) * slope / value[0] * value[1] ** 2

    def _root_sum(self, e: Any) -> Jet:
        a = e.fun.variables[0]
        coefficients = [mpmath.mpf(int(c.p)) / int(c.q) for c in e.poly.all_coeffs()]
        total = _constant(mpmath.mpf(0))
        for root in mpmath.polyroots(coefficients, maxsteps=500, extraprec=4 * mpmath.mp.prec):
            inner = _Evaluator(self.variable, self.bindings[self.variable][0])
            inner.bindings[a] = _constant(root)
            total = _plus(total, inner(e.fun.expr))
        return total

    def _incomplete_gamma(self, e: Any) -> Jet:
        s = self(e.args[0])[0]
        upper = isinstance(e, sympy.uppergamma)

        def unary(z: Number) -> Jet:
            value = mpmath.gammainc(s, z) if upper else mpmath.gammainc(s, 0, z)
            slope = mpmath.exp(-z) * z ** (s - 1) * (-1 if upper else 1)
            return value, slope, slope * ((s - 1) / z - 1)

        return _chain(self(e.args[1]), unary)

    def _hyper(self, e: Any) -> Jet:
        top, bottom = [self(a)[0] for a in e.ap], [self(b)[0] for b in e.bq]

        def unary(z: Number) -> Jet:
            values, factor = [], mpmath.mpf(1)
            for k in range(3):
                values.append(factor * mpmath.hyper([a + k for a in top], [b + k for b in bottom], z))
                factor *= mpmath.fprod(a + k for a in top) / mpmath.fprod(b + k for b in bottom)
            return values[0], values[1], values[2]

        return _chain(self(e.argument), unary)


def _constant(value: Number) -> Jet:
    return value, mpmath.mpf(0), mpmath.mpf(0)


def _plus(f: Jet, g: Jet) -> Jet:
    return f[0] + g[0], f[1] + g[1], f[2] + g[2]


def _times(f: Jet, g: Jet) -> Jet:
    return f[0] * g[0], f[1] * g[0] + f[0] * g[1], f[2] * g[0] + 2 * f[1] * g[1] + f[0] * g[2]


def _chain(u: Jet, function: Unary) -> Jet:
    value, first, second = function(u[0])
    return value, first * u[1], second * u[1] ** 2 + first * u[2]


def _exp(z: Number) -> Jet:
    value = mpmath.exp(z)
    return value, value, value


def _log(z: Number) -> Jet:
    return mpmath.log(z), 1 / z, -1 / z**2


def _sin(z: Number) -> Jet:
    c, s = mpmath.cos(z), mpmath.sin(z)
    return s, c, -s


def _cos(z: Number) -> Jet:
    c, s = mpmath.cos(z), mpmath.sin(z)
    return c, -s, -c


def _atan(z: Number) -> Jet:
    slope = 1 / (1 + z * z)
    return mpmath.atan(z), slope, -2 * z * slope**2


def _erf(z: Number) -> Jet:
    slope = 2 / mpmath.sqrt(mpmath.pi) * mpmath.exp(-z * z)
    return mpmath.erf(z), slope, -2 * z * slope


def _erfi(z: Number) -> Jet:
    slope = 2 / mpmath.sqrt(mpmath.pi) * mpmath.exp(z * z)
    return mpmath.erfi(z), slope, 2 * z * slope


def _ei(z: Number) -> Jet:
    slope = mpmath.exp(z) / z
    return mpmath.ei(z), slope, slope * (1 - 1 / z)


_UNARY: dict[Any, Unary] = {
    sympy.log: _log,
    sympy.sin: _sin,
    sympy.cos: _cos,
    sympy.atan: _atan,
    sympy.erf: _erf,
    sympy.erfi: _erfi,
    sympy.Ei: _ei,
}

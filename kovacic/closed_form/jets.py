"""Values with first and second derivatives of SymPy expressions in ball arithmetic: the numerical check of what is shown.

The balls contain the values.

An unevaluated integral counts as an antiderivative with an arbitrary constant: its value is taken as 1, and its derivatives
are those of the integrand.  In y1 int y1^-2 and exp(int ...) the constant changes the solution into another one.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import prod
from typing import Any

import sympy
from flint import acb, acb_poly, arb, ctx, fmpq, fmpz_poly

Number = Any  # flint's acb
Jet = tuple[Number, Number, Number]
Unary = Callable[[Number], Jet]

_ZERO, _ONE = acb(0), acb(1)


def jet(expression: Any, variable: Any, point: Number) -> Jet:
    """(f, f', f'') at the point, in the current precision of flint.

    Raises `NotImplementedError` for a function that no closed form of this package contains.
    """
    return _Evaluator(variable, point)(expression)


def parameter_value(name: str) -> Number:
    """The value that a parameter takes in the check: a number that isn't special."""
    return acb(1 + arb(fmpq(sum(ord(c) * 31**k for k, c in enumerate(name)) % 9973, 9967)))


class _Evaluator:
    def __init__(self, variable: Any, point: Number) -> None:
        self.bindings: dict[Any, Jet] = {variable: (acb(point), _ONE, _ZERO)}
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
            return _constant(acb(arb(fmpq(int(e.p), int(e.q)))))
        if e.is_Add:
            value, first, second = self(e.args[0])
            for arg in e.args[1:]:
                jet = self(arg)
                value, first, second = value + jet[0], first + jet[1], second + jet[2]
            return value, first, second
        if e.is_Mul:
            constant, result = _ONE, None
            for arg in e.args:
                if arg.is_Rational:
                    constant = constant * self(arg)[0]
                else:
                    result = self(arg) if result is None else _times(result, self(arg))
            assert result is not None
            return result if constant is _ONE else (constant * result[0], constant * result[1], constant * result[2])
        if isinstance(e, sympy.exp):
            return _chain(self(e.args[0]), _exp)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, sympy.RootSum):
            return self._root_sum(e)
        if isinstance(e, sympy.Integral):
            value, first, _ = self(e.function)
            return _ONE, value, first
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
            return _constant(_number(e))
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
        if k == 0 or (value[1].is_zero() and value[2].is_zero()):
            return _constant(power)
        slope = k * power / value[0]
        return power, slope * value[1], slope * value[2] + (k - 1) * slope / value[0] * value[1] ** 2

    def _root_sum(self, e: Any) -> Jet:
        a = e.fun.variables[0]
        total = _constant(_ZERO)
        for root in self._roots(e.poly):
            inner = _Evaluator(self.variable, self.bindings[self.variable][0])
            inner.bindings[a] = _constant(root)
            total = _plus(total, inner(e.fun.expr))
        return total

    def _roots(self, polynomial: Any) -> list[Number]:
        """The complex roots, which are simple."""
        coefficients = polynomial.all_coeffs()[::-1]
        if not all(c.is_Rational for c in coefficients):
            tolerance = arb(2) ** -ctx.prec
            with ctx.workprec(3 * ctx.prec):  # the roots of a polynomial are less exact than its coefficients
                precise = _Evaluator(self.variable, self.bindings[self.variable][0])
                return _with_real_roots(acb_poly([precise(c)[0] for c in coefficients]), tolerance)
        integers = polynomial.clear_denoms()[1].all_coeffs()[::-1]
        return [root for root, _ in fmpz_poly([int(c) for c in integers]).complex_roots()]

    def _incomplete_gamma(self, e: Any) -> Jet:
        s = self(e.args[0])[0]
        upper = isinstance(e, sympy.uppergamma)

        def unary(z: Number) -> Jet:
            value = z.gamma_upper(s) if upper else z.gamma_lower(s)
            slope = (-z).exp() * z ** (s - 1) * (-1 if upper else 1)
            return value, slope, slope * ((s - 1) / z - 1)

        return _chain(self(e.args[1]), unary)

    def _hyper(self, e: Any) -> Jet:
        top, bottom = [self(a)[0] for a in e.ap], [self(b)[0] for b in e.bq]

        def unary(z: Number) -> Jet:
            values, factor = [], _ONE
            for k in range(3):
                values.append(factor * z.hypgeom([a + k for a in top], [b + k for b in bottom]))
                factor *= prod((a + k for a in top), start=_ONE) / prod((b + k for b in bottom), start=_ONE)
            return values[0], values[1], values[2]

        return _chain(self(e.argument), unary)


def _with_real_roots(polynomial: Any, tolerance: Any) -> list[Number]:
    """The roots, those of a real polynomial that are certainly real as real balls."""
    roots = polynomial.roots(tol=tolerance)
    if not all(c.imag == 0 for c in polynomial.coeffs()):
        return list(roots)
    # The conjugate of a root is a root: itself if no other ball meets the mirror image of its own.
    mirrored = [root.conjugate() for root in roots]
    return [
        acb(root.real) if [other for other in roots if other.overlaps(mirror)] == [root] else root
        for root, mirror in zip(roots, mirrored, strict=True)
    ]


@lru_cache(maxsize=256)
def _coarse_value(root: Any) -> complex:
    """A root of a polynomial to a few digits: which one it is."""
    return complex(root.evalf(15))


def _number(e: Any) -> Number:
    """A constant that isn't made of the functions above."""
    if e is sympy.I:
        return acb(0, 1)
    if e is sympy.pi:
        return acb.pi()
    if isinstance(e, sympy.CRootOf):
        near = acb(_coarse_value(e))
        integers = e.poly.clear_denoms()[1].all_coeffs()[::-1]
        roots = fmpz_poly([int(c) for c in integers]).complex_roots()
        return min((root for root, _ in roots), key=lambda root: float(abs(root - near).mid()))
    number = e._to_mpmath(ctx.prec)
    parts = number._mpc_ if hasattr(number, "_mpc_") else (number._mpf_,)
    return acb(*(arb((-mantissa if sign else mantissa, exponent)) for sign, mantissa, exponent, _ in parts))


def _constant(value: Number) -> Jet:
    return value, _ZERO, _ZERO


def _plus(f: Jet, g: Jet) -> Jet:
    return f[0] + g[0], f[1] + g[1], f[2] + g[2]


def _times(f: Jet, g: Jet) -> Jet:
    return f[0] * g[0], f[1] * g[0] + f[0] * g[1], f[2] * g[0] + 2 * f[1] * g[1] + f[0] * g[2]


def _chain(u: Jet, function: Unary) -> Jet:
    value, first, second = function(u[0])
    return value, first * u[1], second * u[1] ** 2 + first * u[2]


def _exp(z: Number) -> Jet:
    value = z.exp()
    return value, value, value


def _log(z: Number) -> Jet:
    inverse = 1 / z
    return z.log(), inverse, -inverse * inverse


def _sin(z: Number) -> Jet:
    s, c = z.sin_cos()
    return s, c, -s


def _cos(z: Number) -> Jet:
    s, c = z.sin_cos()
    return c, -s, -c


def _atan(z: Number) -> Jet:
    slope = 1 / (1 + z * z)
    return z.atan(), slope, -2 * z * slope**2


def _erf(z: Number) -> Jet:
    slope = 2 / acb.pi().sqrt() * (-z * z).exp()
    return z.erf(), slope, -2 * z * slope


def _erfi(z: Number) -> Jet:
    slope = 2 / acb.pi().sqrt() * (z * z).exp()
    return z.erfi(), slope, 2 * z * slope


def _ei(z: Number) -> Jet:
    slope = z.exp() / z
    return z.ei(), slope, slope * (1 - 1 / z)


_UNARY: dict[Any, Unary] = {
    sympy.log: _log,
    sympy.sin: _sin,
    sympy.cos: _cos,
    sympy.atan: _atan,
    sympy.erf: _erf,
    sympy.erfi: _erfi,
    sympy.Ei: _ei,
}

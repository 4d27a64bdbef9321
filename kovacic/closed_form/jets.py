"""Values of SymPy expressions, with derivatives, in ball arithmetic: the numerical check of printed formulas.

The balls contain the values: nothing of SymPy's own numerical evaluation goes in, whose digits aren't proven.  A symbol has a
ball (flint's `acb`) or, for `jet`, three terms of a Taylor series of balls (`acb_series`).

An unevaluated or elliptic integral counts as an antiderivative with an arbitrary constant: its value is taken as 1, and its
derivatives are those of the integrand.  In y1 int y1^-2 and exp(int ...) the constant changes the solution into another one.
Mathieu's functions have arbitrary values and slopes that fit their equation, their parity and their Wronskian: what holds for
all such pairs holds for his.

Reference: DLMF 10.2, 10.6, 10.25, 10.29 (Bessel), 13.6, 16.3 (hypergeometric), 14.9, 18.5, 18.9 (polynomials), 28.2
(Mathieu).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import lru_cache, partial, reduce
from math import prod
from operator import add, mul
from typing import Any
from zlib import crc32

import sympy
from flint import acb, acb_poly, acb_series, arb, ctx, fmpq, fmpz_poly
from sympy.core.function import AppliedUndef

from kovacic.algebra.embedding import complex_zeros, root_near
from kovacic.algebra.precision import working_precision
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
#: Of power series flint has fewer functions: others are written by these.
_REWRITTEN = {
    **dict.fromkeys((sympy.cot, sympy.csc), sympy.sin),
    sympy.sec: sympy.cos,
    **dict.fromkeys((sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch), sympy.exp),
}
_U = sympy.Dummy("u")


class BallEvaluator:
    """The values of expressions at given values of some symbols; those of subexpressions are cached.

    With `analytic` a value isn't finite where the expression isn't analytic on the balls, for quadratures.
    """

    def __init__(self, values: Mapping[Any, BallValue], *, analytic: bool = False) -> None:
        self.values = values
        self.analytic = analytic
        self._known: dict[Any, BallValue] = dict(values)

    def __call__(self, e: Any) -> BallValue:
        """Raises `InputError` for unsupported functions."""
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
        value = self(base)
        if not self.analytic and isinstance(value, acb) and value.contains(0) and exponent.is_positive:
            size = abs(value).upper()  # |z^e| = |z|^e for e > 0
            bound = (self(exponent).real * size.log()).exp().upper() if size > 0 else size
            return acb(arb(0, bound), arb(0, bound))
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
        if e.func in _REWRITTEN:
            return self(_rewritten(e))
        if e.func in _CUT:  # on the principal branch
            slope = BallEvaluator({_U: value})(e.func(_U).fdiff())
            return (slope * value.derivative()).integral() + getattr(value[0], name)()
        return self.other(e)

    def other(self, e: Any) -> BallValue:
        """Values of anything but arithmetic and elementary functions."""
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
def _rewritten(e: Any) -> Any:
    return e.rewrite(_REWRITTEN[e.func])


@lru_cache(maxsize=256)
def _coarse_value(root: Any) -> complex:
    """A root of a polynomial to a few digits: which one it is."""
    return complex(root.evalf(15))


def _check_series(products: int = 1) -> None:
    """Raise `LimitExceeded` if the time left is too short for this number of products of power series."""
    check_duration(products * _SERIES_SECONDS * ctx.cap * ctx.prec, f"a product of power series with {ctx.cap} terms")


def _whole_power(value: BallValue, exponent: int) -> BallValue:
    if not isinstance(value, acb_series):
        return value**exponent
    _check_series(products=2 * exponent.bit_length())  # by squarings
    return value**exponent if exponent >= 0 else _quotient(1, value**-exponent)


Acb = Any  # flint's acb

#: Functions with the names that flint's series have for them; the last argument is the series.
_POWER_SERIES = {
    sympy.Ei: "ei",
    sympy.Si: "si",
    sympy.Ci: "ci",
    sympy.fresnels: "fresnel_s",
    sympy.fresnelc: "fresnel_c",
    sympy.airyai: "airy_ai",
    sympy.airybi: "airy_bi",
    sympy.airyaiprime: "airy_ai_prime",
    sympy.airybiprime: "airy_bi_prime",
    sympy.uppergamma: "gamma_upper",
    sympy.lowergamma: "gamma_lower",
}

ANTIDERIVATIVES = (sympy.Integral, sympy.elliptic_f, sympy.elliptic_e, sympy.elliptic_pi)
MATHIEU = (sympy.mathieuc, sympy.mathieucprime, sympy.mathieus, sympy.mathieusprime)
#: What has the value of one of several functions.
ARBITRARY = (*ANTIDERIVATIVES, *MATHIEU)


def jet(expression: Any, variable: Any, point: Acb) -> tuple[Acb, Acb, Acb]:
    """(f, f', f'') at the point, in flint's current precision.  Raises `NotImplementedError` for unsupported functions."""
    series = acb_series([0], prec=3) + _Evaluator({variable: acb_series([point, 1], prec=3)})(expression)
    return series[0], series[1], 2 * series[2]


def parameter_value(name: str) -> Acb:
    """The value that a parameter takes in the check, between 1 and 2 and in no simple relation to those of other names.

    With p = 1 + k/n and q = 1 + (k + 1)/n for the neighbours p and q, p/(p - q) would be an integer.
    """
    return acb(1 + arb(fmpq(crc32(name.encode()), 2**32 - 5)))


class _Evaluator(BallEvaluator):
    """The values of all that a closed form of this package contains, with the conventions above."""

    def other(self, e: Any) -> BallValue:
        if isinstance(e, sympy.RootSum):
            a = e.fun.variables[0]
            return reduce(add, (_Evaluator({**self.values, a: root})(e.fun.expr) for root in self._roots(e.poly)))
        is_complete = isinstance(e, sympy.elliptic_e) and len(e.args) == 1  # E(m), which is no integral up to x
        if isinstance(e, ANTIDERIVATIVES) and not is_complete:
            x = next(iter(self.values))
            # SymPy differentiates even an indefinite integral with care for its limits, which takes milliseconds.
            is_indefinite = isinstance(e, sympy.Integral) and e.limits == (sympy.Tuple(x),)
            slope = _lifted(self(e.function if is_indefinite else e.diff(x)))
            return acb_series([1, slope[0], slope[1] / 2], prec=3)
        if isinstance(e, sympy.Abs | sympy.sign | sympy.Heaviside):
            return self._of_sign(e)
        # a parameter, or a given function without the variable
        if not e.has(*self.values) if isinstance(e, AppliedUndef) else e.is_Atom and not e.is_number:
            return parameter_value(str(e))
        return self._special(e)

    def _special(self, e: Any) -> BallValue:
        """A special function, or another constant by SymPy's numbers."""
        if e.func in _POWER_SERIES:
            *parameters, last = map(self, e.args)
            return getattr(acb_series, _POWER_SERIES[e.func])(*parameters, _lifted(last))
        if (by_series := _BY_SERIES.get(e.func)) is not None:
            return self(by_series(*e.args))
        if isinstance(e, sympy.hyper):
            z = _lifted(self(e.argument))
            return _composed_series(z, _hypergeometric_jet(e, self, z[0]))
        if (rule := _DERIVATIVES_AT.get(e.func)) is not None:
            parameter, last = map(self, e.args)
            z = _lifted(last)
            return _composed_series(z, rule(parameter, z[0]))
        if isinstance(e, MATHIEU):
            return self._of_mathieu(e)
        if not e.free_symbols:
            with suppress(ValueError):  # where mpmath doesn't have the function
                return acb(e._to_mpmath(ctx.prec))
        raise NotImplementedError(f"the function {e.func} can't be evaluated")

    def _of_mathieu(self, e: Any) -> BallValue:
        """c, c', s or s' for an even and an odd solution of w'' = f w, f = 2 q cos(2 z) - a; c s' - c' s is constant."""
        a, q, last = map(self, e.args)
        z = _lifted(last)
        # The first three have names, c' = s = 0 at 0, and s' is given by the Wronskian elsewhere.
        c, dc, s, ds = (parameter_value(str(function(*e.args))) for function in MATHIEU)
        at_zero = (*e.args[:2], sympy.S.Zero)
        if e.args == at_zero:
            dc = s = acb(0)
        else:
            W = parameter_value(str(sympy.mathieuc(*at_zero))) * parameter_value(str(sympy.mathieusprime(*at_zero)))
            ds = (W + dc * s) / c
        value, slope = (c, dc) if isinstance(e, sympy.mathieuc | sympy.mathieucprime) else (s, ds)
        f = 2 * q * (2 * z[0]).cos() - a
        values = [value, slope, f * value, f * slope - 4 * q * (2 * z[0]).sin() * value]
        if isinstance(e, sympy.mathieucprime | sympy.mathieusprime):
            return _composed_series(z, values[1:])
        return _composed_series(z, values[:3])

    def _of_sign(self, e: Any) -> BallValue:
        """|f|, the sign of f or the step H(f): for a function of the variable, near a point where it isn't zero, and real."""
        value = self(e.args[0])
        if isinstance(value, acb) and isinstance(e, sympy.Abs):
            return acb(abs(value))
        middle = _lifted(value)[0]
        if middle.imag != 0 or middle.contains(0):
            raise NotImplementedError(f"{e} isn't evaluated here")
        sign = 1 if middle.real > 0 else -1
        if isinstance(e, sympy.Abs):
            return value * sign
        return acb(max(sign, 0) if isinstance(e, sympy.Heaviside) else sign)

    def _roots(self, polynomial: Any) -> list[Acb]:
        """The complex roots, which are simple."""
        coefficients = polynomial.all_coeffs()[::-1]
        if not all(c.is_Rational for c in coefficients):
            tolerance = arb(2) ** -ctx.prec
            with working_precision(3 * ctx.prec):  # the roots of a polynomial are less exact than its coefficients
                precise = list(map(_Evaluator({}), coefficients))
                roots = acb_poly(precise).roots(tol=tolerance)
            if not all(c.imag == 0 for c in precise):
                return list(roots)
            # Of a real polynomial a root is real if no other ball meets the mirror image of its own.
            mirrored = [[other for other in roots if other.overlaps(root.conjugate())] for root in roots]
            return [acb(root.real) if others == [root] else root for root, others in zip(roots, mirrored, strict=True)]
        integers = polynomial.clear_denoms()[1].all_coeffs()[::-1]
        return [root for root, _ in complex_zeros(fmpz_poly([int(c) for c in integers]))]


def _lifted(value: BallValue) -> BallValue:
    """As a series."""
    if isinstance(value, acb):
        return acb_series([value], prec=3)
    return value


def _composed_series(z: BallValue, values: list[Acb]) -> BallValue:
    """g(z) for a series z, from g and its derivatives at the constant term."""
    step = z - z[0]
    return values[0] + step * (values[1] + step * (values[2] / 2))


# ------------------------------------------------------------------------------------------ special functions


def _bessel(name: str, nu: Acb, z: Acb) -> list[Acb]:
    """C, C' = +-C_(nu-1) - (nu/z) C, with - for K, and C'' by Bessel's equation, modified for I and K."""
    function = getattr(acb, name)
    C = function(z, nu)
    below = function(z, nu - 1)
    if name == "bessel_k":
        below = -below
    slope = below - nu / z * C
    sign = 1 if name in ("bessel_i", "bessel_k") else -1
    return [C, slope, (sign + (nu / z) ** 2) * C - slope / z]


#: (parameter, z) -> the function and its first two derivatives.
_DERIVATIVES_AT: dict[Any, Callable[[Acb, Acb], list[Acb]]] = {
    sympy.besselj: partial(_bessel, "bessel_j"),
    sympy.bessely: partial(_bessel, "bessel_y"),
    sympy.besseli: partial(_bessel, "bessel_i"),
    sympy.besselk: partial(_bessel, "bessel_k"),
    # E_s' = -E_(s-1) [DLMF 8.19.13], H_n' = 2 n H_(n-1) [18.9.25], Li_s' = Li_(s-1)/z [25.12.10]
    sympy.expint: lambda s, z: [z.expint(s), -z.expint(s - 1), z.expint(s - 2)],
    sympy.hermite: lambda n, z: [z.hermite_h(n), 2 * n * z.hermite_h(n - 1), 4 * n * (n - 1) * z.hermite_h(n - 2)],
    sympy.polylog: lambda s, z: [z.polylog(s), z.polylog(s - 1) / z, (z.polylog(s - 2) - z.polylog(s - 1)) / z**2],
}


def _binomial(n: Any, a: Any) -> Any:
    """n + a over a."""
    return sympy.gamma(n + a + 1) / sympy.gamma(n + 1) / sympy.gamma(a + 1)


def _associated_legendre(n: Any, m: Any, z: Any) -> Any:
    factor = sympy.gamma(n + m + 1) / sympy.gamma(n - m + 1) / sympy.gamma(m + 1) / (-2) ** m
    return factor * (1 - z**2) ** (m / 2) * sympy.hyper((m - n, n + m + 1), (m + 1,), (1 - z) / 2)


#: By Bessel's functions, and by hypergeometric series.
_BY_SERIES: dict[Any, Callable[..., Any]] = {
    sympy.elliptic_k: lambda m: sympy.elliptic_k(m).rewrite(sympy.hyper),
    sympy.elliptic_e: lambda m: sympy.elliptic_e(m).rewrite(sympy.hyper),
    sympy.jn: lambda n, z: sympy.sqrt(sympy.pi / (2 * z)) * sympy.besselj(n + sympy.S.Half, z),
    sympy.yn: lambda n, z: sympy.sqrt(sympy.pi / (2 * z)) * sympy.bessely(n + sympy.S.Half, z),
    sympy.laguerre: lambda n, z: sympy.hyper((-n,), (1,), z),
    sympy.assoc_laguerre: lambda n, a, z: _binomial(n, a) * sympy.hyper((-n,), (a + 1,), z),
    sympy.legendre: lambda n, z: sympy.hyper((-n, n + 1), (1,), (1 - z) / 2),
    sympy.gegenbauer: lambda n, a, z: (
        _binomial(n, 2 * a - 1) * sympy.hyper((-n, n + 2 * a), (a + sympy.S.Half,), (1 - z) / 2)
    ),
    sympy.assoc_legendre: _associated_legendre,
    sympy.jacobi: lambda n, a, b, z: _binomial(n, a) * sympy.hyper((-n, n + a + b + 1), (a + 1,), (1 - z) / 2),
}


def _hypergeometric_jet(e: Any, value: Callable[[Any], Acb], z: Acb) -> list[Acb]:
    """SymPy's `hyper` and its first two derivatives: F' = (prod a/prod b) F(a + 1; b + 1) [DLMF 16.3.1]."""
    top, bottom = list(map(value, e.ap)), list(map(value, e.bq))
    counts = len(top), len(bottom)
    # Which differences of parameters are integers is taken from the expression, for balls don't show it.
    exact = []
    if counts == (2, 1):
        (a, b), (c,) = e.ap, e.bq
        exact = [sympy.expand(d).is_integer is True for d in (a - b, a - c, b - c, a + b - c)]
    found = []
    factor = acb(1)
    for _ in range(3):
        if exact:
            F = z.hypgeom_2f1(*top, *bottom, False, *exact)
        elif counts == (2, 0):  # 2F0(a, b; z) = (-1/z)^a U(a, a - b + 1, -1/z)
            F = (-1 / z) ** top[0] * (-1 / z).hypgeom_u(top[0], value(sympy.expand(e.ap[0] - e.ap[1] + 1)))
        else:
            F = z.hypgeom(top, bottom)
        found.append(factor * F)
        factor *= prod(top, start=acb(1)) / prod(bottom, start=acb(1))
        top, bottom = [a + 1 for a in top], [b + 1 for b in bottom]
    return found

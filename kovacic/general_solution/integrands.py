"""Integrals of rational functions, and of products of powers and exponentials, by the engine; and those in special functions.

These are incomplete gamma functions, hypergeometric series, dilogarithms, and complex exponentials for waves.

References: DLMF 7.2(iii), 8.2, 25.12.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import sympy
from sympy import Add, cancel, cos, cot, csc, exp, expand, log, pi, powsimp, sec, sin, sqrt, tan
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.simplify.fu import TR1, TR2

from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, factors, hypergeometric, is_seen_negative
from kovacic.closed_form.cuts import common_place
from kovacic.closed_form.integrals import integral, logarithms
from kovacic.closed_form.product import product
from kovacic.equation import EULER, PI
from kovacic.errors import InputError
from kovacic.general_solution.substitution import changed_beside, expanded_size, powers_of_roots
from kovacic.limits import check_duration, manageable
from kovacic.reading.read import read_input

Expr = Any  # SymPy publishes no types
#: SymPy's time for a subexpression of what it expands.
_PART_SECONDS = 2e-5
#: The numbers that are parameters in coefficients.
NUMBERS = {sympy.Symbol(PI): pi, sympy.Symbol(EULER): sympy.E}
#: A sum of more functions of complex arguments is harder to read than the integral that it equals.
MOST_COMPLEX = 4


class UnknownIntegral(Exception):
    """The method that was tried doesn't find the integral."""


def require(holds: Any) -> None:
    """Raise `UnknownIntegral` unless a condition of a method holds."""
    if not holds:
        raise UnknownIntegral


def first_known(methods: Iterable[Callable[..., Expr]], *arguments: Expr) -> Expr:
    """The integral by the first method that finds it.  Raises `UnknownIntegral` if none does."""
    for method in methods:
        with suppress(UnknownIntegral):
            return method(*arguments)
    raise UnknownIntegral


@dataclass(frozen=True)
class ChangeOfIntegrand:
    """int f(x) dx = int g(t) dt for t = u(x)."""

    #: g(t) = f(x) dx/dt.
    integrand: Expr
    t: Expr
    u: Expr

    def back(self, found: Expr) -> Expr:
        """A function of t in x; with v^r e^s for e^(r t + s) where u = log(v), but exp(-t^2) stays an exponential."""
        v = self.u.args[0]

        def power(e: Expr) -> Expr:
            rate = e.diff(self.t)
            return exp(e) if rate.has(self.t) else v**rate * exp(e.subs(self.t, 0))

        if isinstance(self.u, exp):
            found = found.subs(log(self.t), v)
        if isinstance(self.u, log):
            found = found.replace(exp, power)
        return found.subs(self.t, self.u)


def prepared_integrand(integrand: Expr) -> Expr:
    """Expanded, in sines, cosines and exponentials."""
    integrand = integrand.rewrite(HyperbolicFunction, exp)
    if integrand.has(tan, cot, sec, csc):
        integrand = TR2(TR1(integrand))
    # SymPy would write log(x/(1 - x) + 1/(1 - x))
    quotients = [f for f in integrand.atoms(log) if f.args[0].is_Mul and sympy.denom(f.args[0]).is_Add]

    def expanded(rest: Expr) -> Expr:
        check_duration(_PART_SECONDS * expanded_size(rest), "expanding an integrand")
        return expand(rest, power_exp=False)

    below = (power for power in powers_of_roots(integrand) if power.exp < 0)
    return changed_beside((*quotients, *below), integrand, expanded)


def radicands(expression: Expr) -> list[Expr]:
    """The bases of its powers with fractions as exponents."""
    return [power.base for power in expression.atoms(sympy.Pow) if power.exp.is_Rational and not power.exp.is_Integer]


def integral_of_product(term: Expr, x: Expr) -> Expr:
    """int g dx for a product g of powers and exponentials of rational functions."""
    functions = [f for f in term.atoms(sympy.Function) if f.has(x)]
    require(all(f.func is exp for f in functions))
    # sqrt(x^2 + a^2)/sqrt(a^2) for sqrt(x^2/a^2 + 1); one root of a linear function is left, as a new variable
    parts = {base: sympy.fraction(sympy.together(base)) for base in radicands(term) if base.has(x)}
    split = {base: (n, d) for base, (n, d) in parts.items() if d.free_symbols and not d.has(x)}
    require(functions or len(parts) != 1 or all(n.diff(x).has(x) for n, _ in split.values()))
    for base, (n, d) in split.items():
        term = term.replace(lambda e: e.is_Pow and e.base == base, lambda e: n**e.exp * d**-e.exp)  # noqa: B023
    # a quotient is positive where the product of its parts is
    products = (sympy.Mul(*sympy.fraction(sympy.together(base))) for base in radicands(term) if base.has(x))
    polynomials = [sympy.Poly(base, x) for base in products if base.is_polynomial(x)]
    # roots of a - x and the like are real for x -> -oo
    odd = [polynomial for polynomial in polynomials if polynomial.degree() % 2]
    if odd and all(polynomial.LC().is_negative for polynomial in odd):
        return -integral_of_product(term.subs(x, -x), x).subs(x, -x)
    # the term is a constant times h, which has its logarithmic derivative; of t1 + t2 + ... that of t1 (1 + t2/t1 + ...)
    first, *others = Add.make_args(term)
    whole = Add(1, *((other / first).replace(exp, lambda u: exp(cancel(u))) for other in others))
    atoms = Atoms(x, at=_place_of_real_roots(polynomials, x))
    h = product(_as_ratfunc(relative_slope(first, x) + whole.diff(x) / whole, x))
    scale, shown = factors(h, atoms)
    # SymPy's arithmetic with algebraic numbers takes minutes
    found = None if sympy.Tuple(*shown).has(sympy.CRootOf) else integral(h, atoms)
    if found is None:
        raise UnknownIntegral
    return expand(_constant_value(term, scale * sympy.Mul(*shown), x) * found, deep=False)


def _place_of_real_roots(radicands: list[Any], x: Expr) -> Expr | None:
    """A point, or oo, near which the square roots of polynomials in x are real; None if none is found."""
    if radicands and all(polynomial.LC().is_positive for polynomial in radicands):
        return sympy.oo
    if not radicands or any(polynomial.free_symbols_in_domain for polynomial in radicands):
        return None
    zeros = sorted({zero for polynomial in radicands for zero in polynomial.ground_roots()})
    between = ((a + b) / 2 for a, b in pairwise(zeros))
    inside = next((point for point in between if all(f(point) > 0 for f in radicands)), None)
    return inside or common_place(x, {polynomial: polynomial.as_expr() for polynomial in radicands})


def _constant_value(term: Expr, other: Expr, x: Expr) -> Expr:
    """The constant term/other, at a point where it has a value and the term a real one, if possible."""
    points = (2, 3, 5, sympy.S.Half, -sympy.S.Half)
    for point in sorted(points, key=lambda point: term.subs(x, point).is_real is False):
        value = powsimp((term / other).subs(x, point))
        if value.free_symbols and manageable(value):  # without terms that cancel
            value = cancel(value)
        if value != 0 and not value.has(sympy.nan, sympy.zoo):
            return value
    raise UnknownIntegral


def relative_slope(e: Expr, x: Expr) -> Expr:
    """e'/e by factors, in a short form."""
    if isinstance(e, cos):
        return -e.args[0].diff(x) * tan(e.args[0])
    if e.is_Mul:
        return Add(*(relative_slope(part, x) for part in e.args))
    if e.is_Pow and not e.exp.has(x):
        return e.exp * relative_slope(e.base, x)
    rate = e.diff(x) / e
    if e.is_polynomial(x):  # without gcds over fields of algebraic numbers
        return rate
    return cancel(rate) if rate.is_rational_function(x) else powsimp(sympy.factor_terms(rate))


def integral_of_fraction(g: Expr, x: Expr) -> Expr:
    """By partial fractions, for a rational function of x."""
    K, rest = g.as_independent(x, as_Add=False)  # roots of numbers in a factor stay as they are
    atoms = Atoms(x)
    parts = decompose(_as_ratfunc(rest, x))
    return K * (atoms.sum(parts.exact) + Add(*logarithms(parts.residues, atoms))).xreplace(NUMBERS)


def ratfunc(expression: Expr, x: Expr) -> RatFunc | None:
    """The expression as a rational function, pi and e being parameters of its field; None for other expressions."""
    with suppress(UnknownIntegral):
        return _as_ratfunc(expression, x)
    return None


def _as_ratfunc(expression: Expr, x: Expr) -> RatFunc:
    require(expression.is_rational_function(x))
    try:
        return read_input(expression, var=x.name).S
    except InputError:
        raise UnknownIntegral from None


# -------------------------------------------------------------------------------------------------- special functions


def incomplete_gamma(term: Expr, x: Expr) -> Expr:
    """int K x^s exp(c x^m) dx = K x^(s+1)/(m e) 1F1(e; e + 1; c x^m), e = (s + 1)/m; s and m may be symbols.

    For a positive z = -c x^m it is -(K/m) x^(s+1) z^-e Gamma(e, z), where x^(s+1) z^-e is a constant.
    Without an exponential it is K x^(s+1)/(s+1).

    >>> x, s = sympy.symbols("x s")
    >>> print(incomplete_gamma(x**s * exp(-x), x), incomplete_gamma((x + 2) ** s * exp(-x), x))
    -uppergamma(s + 1, x) -exp(2)*uppergamma(s + 1, x + 2)
    """
    K, rest = term.as_independent(x, as_Add=False)
    powers = rest.as_powers_dict()
    exponent = powers.pop(sympy.E, sympy.Integer(0))
    line, s = next(iter(powers.items()), (x, sympy.Integer(0)))
    slope = line.diff(x)
    require(len(powers) <= 1 and slope != 0 and not slope.has(x) and not s.has(x) and (exponent, s) != (0, -1))
    if exponent == 0:
        return K * line ** (s + 1) / (s + 1) / slope
    # exp(d + c t^m) for t = a x + b
    t = sympy.Dummy()
    d, c, m = _single_power(exponent.subs(x, (t - line.subs(x, 0)) / slope), t)
    e = cancel((s + 1) / m)
    if e == sympy.S.Half:  # u = t^(s+1): t^s dt is du/(s + 1)
        function, root = (sympy.erf, sqrt(-c)) if is_seen_negative(c) else (sympy.erfi, sqrt(c))
        found = sqrt(pi) * function(root * t ** (s + 1)) / (2 * root * (s + 1))
    elif is_seen_negative(c) or e.is_Integer:  # for an integer e it is elementary, or has Ei
        z = -c * t**m
        found = -powsimp(t ** (s + 1) * z**-e) * sympy.uppergamma(e, z) / m
    else:
        found = t ** (s + 1) / (s + 1) * hypergeometric((e,), (e + 1,), c * t**m)
    return (K / slope * exp(d) * found).xreplace({t: line})


def power_beside_wave(term: Expr, x: Expr) -> Expr:
    """int K x^s cos(c x^m + d) dx, or of the sine: with 1F2, odd or even in the angle; s and m may be symbols.

    With e = (s + 1)/m and z = -(c x^m/2)^2,

        int x^s cos(c x^m) dx = x^(s+1)/(s+1) 1F2(e/2; 1/2, e/2 + 1; z),
        int x^s sin(c x^m) dx = c x^(s+m+1)/(s+m+1) 1F2((e + 1)/2; 3/2, (e + 3)/2; z).

    >>> x, s = sympy.symbols("x s")
    >>> print(power_beside_wave(x**s * cos(x), x))
    x**(s + 1)*hyper((s/2 + 1/2,), (1/2, s/2 + 3/2), -x**2/4)/(s + 1)
    """
    K, rest = term.as_independent(x, as_Add=False)
    s, wave = rest.as_independent(sin, cos, as_Add=False)
    base, s = s.as_base_exp() if s != 1 else (x, sympy.S.Zero)
    require(wave.func in (sin, cos) and base == x and not s.has(x))
    d, c, m = _single_power(wave.args[0], x)
    if wave.func is cos:  # sin(u + d) = sin(u) cos(d) + cos(u) sin(d)
        d += pi / 2
    e = cancel((s + 1) / m)
    require(not any(value.is_Integer and not value.is_positive for value in (e / 2, (e + 1) / 2)))  # a logarithm
    z = -((c * x**m) ** 2) / 4
    half = sympy.S.Half
    of_cos = x ** (s + 1) / (s + 1) * hypergeometric((e / 2,), (half, e / 2 + 1), z)
    of_sin = c * x ** (s + m + 1) / (s + m + 1) * hypergeometric(((e + 1) / 2,), (3 * half, (e + 3) / 2), z)
    return K * (cos(d) * of_sin + sin(d) * of_cos)


def _single_power(e: Expr, t: Expr) -> tuple[Expr, Expr, Expr]:
    """d, c and m with e = d + c t^m."""
    d, single = expand(e).as_independent(t, as_Add=True)
    c, power = single.as_independent(t, as_Add=False)
    base, m = power.as_base_exp()
    require(base == t and not m.has(t) and m != 0)
    return d, c, m


def dilogarithm(u: Expr, g: Expr, x: Expr) -> Expr | None:
    """int k log(u)/(x - p) dx for u = a x + b and s = u(p) != 0: k (log(u) log(1 - u/s) + Li_2(u/s)).

    For s > 0 it is k (log(s) log(x - p) - Li_2(1 - u/s)), which is real where log(u) is.

    >>> x = sympy.Symbol("x")
    >>> print(dilogarithm(x, 1 / (x + 1), x))
    log(x)*log(x + 1) + polylog(2, -x)
    """
    k, rest = g.as_independent(x, as_Add=False)
    base, exponent = rest.as_base_exp()
    linear = all(e.is_polynomial(x) and sympy.degree(e, x) == 1 for e in (u, base))
    if exponent != -1 or not linear:
        return None
    slope = base.diff(x)
    s = u.subs(x, x - base / slope).expand()
    if s == 0 or s.has(x):
        return None
    w = expand(u / s)
    if s.is_positive:
        return k / slope * (log(s) * log(base) - sympy.polylog(2, 1 - w))
    return k / slope * (log(u) * log(1 - w) + sympy.polylog(2, w))


def in_complex_exponentials(term: Expr, x: Expr) -> Expr:
    """Waves as sums of exponentials: Ei, error functions and incomplete gamma functions of complex arguments."""
    parts = Add.make_args(expand(term.rewrite((sin, cos), exp), power_exp=False))
    require(term.has(sin, cos) and len(parts) <= MOST_COMPLEX)
    return Add(*(first_known((integral_of_product, incomplete_gamma), part, x) for part in parts))

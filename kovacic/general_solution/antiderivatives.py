"""int g dx for the integrands that variation of parameters meets, without SymPy's integration.

`_RULES`, at the end, lists the rules in the order in which they are tried on a term.  What none of them covers is integrated
by parts: logarithms, inverse and error functions, exponential integrals, polynomials times other functions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import partial
from math import lcm
from typing import Any

import sympy
from sympy import Add, Dummy, Integral, Mul, atan, cancel, cos, exp, expand, log, sin, sqrt

from kovacic.closed_form.check import letter_samples
from kovacic.closed_form.cuts import cuts_of
from kovacic.equation import EULER
from kovacic.general_solution.behaviour import have_values
from kovacic.general_solution.integrands import (
    ChangeOfIntegrand,
    UnknownIntegral,
    dilogarithm,
    first_known,
    in_complex_exponentials,
    incomplete_gamma,
    integral_of_fraction,
    integral_of_product,
    power_beside_wave,
    prepared_integrand,
    radicands,
    require,
)
from kovacic.general_solution.substitution import inverted, size
from kovacic.general_solution.waves import beside_waves, by_coefficients, common_factor, wave_changes
from kovacic.general_solution.zero import ball_of, differs_from_zero, known_jet, quadrant_points
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
#: Functions whose derivatives are simpler.
_BY_PARTS = (
    *(log, atan, sympy.asin, sympy.acos, sympy.atanh, sympy.asinh, sympy.acosh),
    *(sympy.erf, sympy.erfi, sympy.Ei, sympy.Si, sympy.Ci, sympy.fresnels, sympy.fresnelc),
)
_SIMPLE = {exp, sin, cos}
#: In different quadrants of the waves, and on both sides of the points where roots of polynomials usually become real.
_REAL_POINTS = tuple(
    map(sympy.Rational, ("3/10", "6/5", "9/5", "3", "18/5", "5", "11", "-2/7", "-7/5", "-2", "-4", "-9"))
)


def antiderivative(integrand: Expr, x: Expr, start: Expr | None = None) -> Expr | None:
    """int g dx, or None if it isn't found; beside tangents it may contain an `Integral` that isn't elementary.

    None as well if g has a value or a limit at `start` and the integral has a branch cut there that g hasn't, as
    Ei(x) - log(x) for (exp(x) - 1)/x.  Assumptions on symbols aren't used.

    >>> x = sympy.Symbol("x")
    >>> antiderivative(sympy.tan(x) ** 2 + log(x), x)
    x*log(x) - 2*x + tan(x)
    """
    plain = {symbol: sympy.Symbol(symbol.name) for symbol in integrand.free_symbols | {x}}
    # e exp(e x) is exp(e x + 1) for SymPy, which hides the factor: Euler's number gets a letter.
    euler = sympy.Symbol(f"{EULER}_")
    own = inverted(plain) | {euler: sympy.E}
    powers = {power: euler**power.exp for power in integrand.atoms(exp) if power.exp.is_Integer}
    try:
        found = _by_rules(integrand.xreplace(plain | powers | {sympy.E: euler}), plain[x]).xreplace(own)
    except UnknownIntegral:
        return None
    if start is not None:
        cuts = {*cuts_of(found, x)} - {*cuts_of(integrand, x)}
        if any(cut.subs(x, start) == 0 for cut in cuts) and have_values([integrand], x, start):
            return None
    return found if _holds_on_every_side(found, integrand, x, start) else None


def _by_rules(given: Expr, x: Expr) -> Expr:
    """The integral of the whole, of each term, or of several terms by parts; x may be a root or an exponential, so positive."""
    integrand = prepared_integrand(given)
    functions = _functions(integrand)
    require(functions <= _SIMPLE | set(_BY_PARTS))
    if functions <= {exp}:
        in_power, in_exponential = (partial(_in_another_variable, change) for change in (_power, _exponentials))
        rules = (in_power, integral_of_product, in_exponential)
        with suppress(UnknownIntegral):  # 1/((x - 1)*sqrt(x)) is a product before it is expanded
            return first_known(partial(rule, whole, x) for rule in rules for whole in (integrand, given))
    total = sympy.S.Zero
    for product, terms in _by_inverse_functions(integrand, x).items():
        check_time()
        together = partial(_by_parts, product, Add(*(term / product for term in terms)), x)
        total += first_known([partial(_of_terms, terms, x), together])
    return total


def _holds_on_every_side(found: Expr, integrand: Expr, x: Expr, start: Expr | None) -> bool:
    """False if roots of sums have another sign at `start`, at distant points where the integrand is real, or beside the axis.

    sqrt(1 + tan(x)^2) is 1/cos(x) on one side of pi/2, and -1/cos(x) on the other one; so is sqrt(1 - 1/x^2), of asin(1/x).
    """
    has_root, gets_root = (any(base.has(x) and not base.is_Symbol for base in radicands(e)) for e in (integrand, found))
    if not has_root and not gets_root:
        return True
    difference = found.diff(x) - integrand
    letters = next(letter_samples(integrand.free_symbols - {x}))
    values = {point: ball_of(integrand, {**letters, x: point}) for point in _REAL_POINTS}
    real = [point for point, value in values.items() if value is not None and value.imag.contains(0)]
    points = real if start is None else [*real, start]
    if any(differs_from_zero(difference, {**letters, x: point}) for point in points):
        return False
    if not has_root:  # acosh(x), real for x >= 1, has the slope 1/(sqrt(x - 1) sqrt(x + 1))
        return True
    beside = (known_jet(difference.xreplace(letters), x, point) for point in quadrant_points() if point.imag != 0)
    return all(value is None or value[0].contains(0) for value in beside)


def _functions(expression: Expr) -> set[Any]:
    return {f.func for f in expression.atoms(sympy.Function, Integral)}


def _by_inverse_functions(integrand: Expr, x: Expr) -> dict[Expr, list[Expr]]:
    """The terms by their powers of functions that are to be differentiated, or of polynomials in terms without such."""
    groups: dict[Expr, list[Expr]] = {}
    for term in Add.make_args(integrand):
        factors = [factor for factor in Mul.make_args(term) if factor.has(x)]
        powers = [factor for factor in factors if factor.as_base_exp()[0].func in _BY_PARTS]
        powers = powers or [factor for factor in factors if factor.is_polynomial(x)]
        groups.setdefault(Mul(*powers), []).append(term)
    return groups


def _of_terms(terms: Iterable[Expr], x: Expr) -> Expr:
    """The sum of the integrals, each by the first rule that applies."""
    return Add(*(first_known(_RULES.values(), term, x) for term in terms))


# ------------------------------------------------------------------------------------------------ changes of variable


def _in_another_variable(changes: Callable[[Expr, Expr], Iterable[ChangeOfIntegrand]], term: Expr, x: Expr) -> Expr:
    """The shortest of the integrals that are found in a new variable, back in x."""
    found = []
    for change in changes(term, x):
        t, g = change.t, change.integrand
        with suppress(UnknownIntegral):
            # in log(t), where t is exp(k x), exponentials would come back
            require(not (change.u.has(exp) and any(not (f.args[0] / t).has(t) for f in g.atoms(log))))
            require(not g.has(x))
            integral = first_known((integral_of_fraction, _by_rules), g, t)
            require(not integral.has(Integral))  # which would have another variable
            found.append(change.back(integral))
    require(found)
    return min(found, key=size)


def _arguments(term: Expr, x: Expr) -> Iterator[ChangeOfIntegrand]:
    """To functions, their arguments and bases of powers, u, where the term is u' f(u), or x is known as a function of u.

    It is for u = log(x), and for linear arguments with letters: a*asin(t) for asin(x/a), without a root of a^2.
    """
    t = Dummy(real=True)
    functions = term.atoms(*_BY_PARTS)
    slopes = {f.args[0]: f.args[0].diff(x) for f in functions}
    lines = {u: (t - u.subs(x, 0)) / k for u, k in slopes.items() if k.free_symbols and not k.has(x)}
    known = lines | {log(x): exp(t)}
    own = functions | {*lines} | {f.args[0] for f in term.atoms(sympy.Function) if f.args[0].has(exp, sin, cos, log)}
    own |= {p.base for p in term.atoms(sympy.Pow) if p.exp.free_symbols and not p.exp.has(x)}
    for u in sorted((u for u in own if u.has(x) and u != x), key=str):
        inner = term / _slope_of_inverse(u, x)
        yield ChangeOfIntegrand(prepared_integrand(inner.subs(x, known[u])) if u in known else inner.subs(u, t), t, u)


def _power(term: Expr, x: Expr) -> Iterator[ChangeOfIntegrand]:
    """To u = x^k, k > 1, for x^(k - 1) f(x^k), where f isn't a polynomial, and of rational ones, one without a pole at 0."""
    is_rational = term.is_rational_function(x)
    require(not (is_rational and sympy.denom(sympy.together(term)).subs(x, 0) == 0) and not term.is_polynomial(x))
    t = Dummy(real=True)
    exponents = {int(power.exp) for power in term.atoms(sympy.Pow) if power.base == x and power.exp.is_Integer}
    for k in sorted({d for e in exponents for d in sympy.divisors(e)} - {1}, reverse=True):
        root = t ** sympy.Rational(1, k)
        inner = term.subs(x, root) * root / (k * t)
        if not any(power.base == t and not power.exp.is_Integer for power in inner.atoms(sympy.Pow)):
            yield ChangeOfIntegrand(inner, t, x**k)
            return


def _exponentials(term: Expr, x: Expr) -> Iterator[ChangeOfIntegrand]:
    """To u = exp(k x), of which all exponentials of multiples of x are powers."""
    term = expand(term)
    rates = {e: rate for e in term.atoms(exp) if not (rate := expand(e.args[0] / x)).has(x)}
    k = common_factor([*rates.values()])
    if k is None:
        return
    # One u for all terms, or logarithms that cancel would stay; polynomials in it under roots and in logarithms.
    k = -k if k.could_extract_minus_sign() else k
    inner = sympy.Tuple(*radicands(term), *(f.args[0] for f in term.atoms(log))).atoms(exp)
    powers = [rates[e] / k for e in inner & {*rates}]
    if powers and all(power.is_negative for power in powers):
        k = -k
    t = Dummy(positive=True)
    in_t = term.xreplace({e: t ** (rate / k) for e, rate in rates.items()}) / (k * t)
    yield ChangeOfIntegrand(prepared_integrand(in_t), t, exp(k * x))


def _root_of_line(term: Expr, x: Expr) -> Iterator[ChangeOfIntegrand]:
    """To t = (a x + b)^(1/q), of which all roots of functions of x are powers."""
    bases = {base for base in radicands(term) if base.has(x)}
    require(len(bases) == 1 and all(map(radicands, term.atoms(*_BY_PARTS))))
    (line,) = bases
    slope = line.diff(x)
    require(not slope.has(x))
    q = lcm(*(int(power.exp.q) for power in term.atoms(sympy.Pow) if power.base == line and power.exp.is_Rational))
    t = Dummy(positive=True)
    inner = term.subs(x, (t**q - line.subs(x, 0)) / slope) * q * t ** (q - 1) / slope
    yield ChangeOfIntegrand(inner, t, sympy.root(line, q))


# ------------------------------------------------------------------------------------------------------------ by parts


def _by_parts(product: Expr, g: Expr, x: Expr) -> Expr:
    """int g l dx = G l - int G l' dx for a product l of powers of inverse functions and the like, or of polynomials.

    If g = k l' + H' with a constant k, int g l^m dx = k l^(m+1)/(m+1) + int H' l^m dx, and H takes the place of G.
    """
    powers = [factor.as_base_exp() for factor in Mul.make_args(product)]
    require(product != 1 and all(m.is_Integer and m > 0 for _, m in powers))
    if isinstance(product, log) and g.is_rational_function(x):
        with suppress(UnknownIntegral):
            return _beside_logarithm(product, g, x)
    G = _by_rules(g, x)
    require(not G.has(Integral, sympy.RootSum))
    total = sympy.S.Zero
    function, m = powers[0]
    k = expand(G).coeff(function)
    if len(powers) == 1 and k != 0 and not k.has(x):
        total = k * function ** (m + 1) / (m + 1)
        G = expand(G - k * function)
    left = Add(*(m * _slope_of_inverse(function, x) * product / function * G for function, m in powers))
    is_simple, is_polynomial = _functions(G) <= _SIMPLE, product.is_polynomial(x)
    require(is_simple or is_polynomial)
    # functions of G by parts would lead back here: without that, each term by a rule
    rest = _by_rules(left, x) if is_simple else _of_terms(Add.make_args(prepared_integrand(left)), x)
    require(not (is_polynomial and rest.has(Integral)))
    return Add(total, *(part * product for part in Add.make_args(G)), -rest)


def _slope_of_inverse(function: Expr, x: Expr) -> Expr:
    """1/sqrt(x^2 + 1) for log(x + sqrt(x^2 + 1)), and a/sqrt(b^2 - a^2 x^2) for asin(a x/sqrt(b^2))."""
    slope = cancel(function.diff(x))
    if isinstance(function, log):
        return sympy.powsimp(sympy.radsimp(slope))
    if slope.is_rational_function(x):
        return slope
    P, square = sympy.fraction(cancel(1 / slope**2))
    c = sympy.powdenest(sqrt(square), force=True)
    is_right = P.is_polynomial(x) and cancel(slope.subs(x, 0) * sqrt(P.subs(x, 0)) / c) == 1
    return c / sqrt(expand(P)) if is_right else slope


def _beside_logarithm(logarithm: Expr, g: Expr, x: Expr) -> Expr:
    """int R log(u) dx, where a partial fraction of R leads to a dilogarithm."""
    known = {R: dilogarithm(logarithm.args[0], R, x) for R in Add.make_args(sympy.apart(g, x))}
    require(any(known.values()))
    return Add(*(found or _by_parts(logarithm, R, x) for R, found in known.items()))


# ------------------------------------------------------------------------------------------------------------ tangents


def _beside_tangents(term: Expr, x: Expr) -> Expr:
    """int q + (a + b s)/c dx for a wave c with simple zeros: at these s = 1 or -1, and residues must be constant [Risch]."""
    below = [f.base for f in Mul.make_args(term) if f.is_Pow and f.exp == -1 and f.base.func in (sin, cos)]
    require(len(below) == 1)
    (c,) = below
    s = (cos if c.func is sin else sin)(c.args[0])
    require((term * c).is_polynomial(s, c))
    (_, q), rest = sympy.reduced(term * c, [s**2 + c**2 - 1, c], s, c)
    residues = [rest.xreplace({s: sympy.Integer(sign)}) for sign in (1, -1)]
    require(not rest.has(log, atan) and all(residue.has(x) and not residue.has(sin, cos) for residue in residues))
    return _by_rules(q, x) + Integral(rest / c, x)


# --------------------------------------------------------------------------------------------------------------- rules


#: int g dx for a term g of x, by its class.  Each rule raises `UnknownIntegral` for other terms.
_RULES: dict[str, Callable[[Expr, Expr], Expr]] = {
    "int P exp(r x) cos(w x) dx: undetermined coefficients": by_coefficients,
    "int f(u) u' dx = int f(u) du": partial(_in_another_variable, _arguments),
    "int f(exp(k x)) dx = int f(u)/(k u) du": partial(_in_another_variable, _exponentials),
    "int R(sin(u), cos(u)) dx for linear u: rational in a wave or tangent": partial(_in_another_variable, wave_changes),
    "products of powers and exponentials of rational functions": integral_of_product,
    "int R cos(u) dx: Si and Ci for linear u, Fresnel functions for quadratic u": beside_waves,
    "int q + (a + b s)/c dx where the second part isn't elementary": _beside_tangents,
    "int f(x, u^(1/q)) dx for u = a x + b: in t = u^(1/q)": partial(_in_another_variable, _root_of_line),
    "int x^s cos(c x^m) dx: 1F2": power_beside_wave,
    "int f(x) cos(u) dx: Ei, erf and gamma functions of complex arguments": in_complex_exponentials,
    "int x^s exp(c x^m) dx: incomplete gamma functions": incomplete_gamma,
}

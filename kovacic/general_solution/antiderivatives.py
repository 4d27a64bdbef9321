"""int g dx for the integrands that variation of parameters meets, at once, without SymPy's integration.

- Products of powers and exponentials of rational functions (Ei, erf, gamma functions): `kovacic.closed_form.primitive`.
- Logarithms, inverse and error functions, exponential integrals times these, by parts, and l^m l'.
- Waves times rational functions: sine and cosine integrals, Fresnel functions, Ei and erf of complex arguments.
- Tangents, cotangents, secants, ... times functions whose residues aren't constant: the rest, and an `Integral` that stays.
- Polynomials times exponentials and waves in x or exp(k x): Y' for Y'' = g, by undetermined coefficients.
- All of these in log(x), a root of x, or an argument u of a function beside u'.
- Rational functions of exp(k x), or of s = sin(theta) and c = cos(theta), theta = w x + phi, by partial fractions in

      c if g is odd in s,    s if g is odd in c,    tan(theta) if g(-s, -c) = g(s, c),    tan(theta/2) otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from math import lcm
from typing import Any

import sympy
from sympy import atan, cos, exp, log, sin, tan
from sympy.simplify.fu import TR8, TR2i

from kovacic.general_solution.integrands import integral_of_fraction, integral_of_product, prepared, radicands, sum_of
from kovacic.general_solution.special_integrals import dilogarithm, fresnel, in_complex_exponentials, incomplete_gamma
from kovacic.general_solution.substitution import size
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.zero import ball, samples
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
#: Functions whose derivatives are simpler.
_BY_PARTS = (
    *(log, atan, sympy.asin, sympy.acos, sympy.atanh, sympy.asinh, sympy.acosh),
    *(sympy.erf, sympy.erfi, sympy.Ei, sympy.Si, sympy.Ci, sympy.fresnels, sympy.fresnelc),
)
_SIMPLE = {exp, sin, cos}
#: In different quadrants of the waves, and on both sides of where roots of polynomials usually become real.
_POINTS = tuple(map(sympy.Rational, ("3/10", "6/5", "9/5", "3", "18/5", "5", "11", "-2/7", "-7/5", "-2", "-4", "-9")))


def antiderivative(integrand: Expr, x: Expr) -> Expr | None:
    """int g dx, None where a term isn't of one of these kinds; an `Integral` that isn't elementary beside tangents.

    >>> x = sympy.Symbol("x")
    >>> antiderivative(tan(x) ** 2 + log(x), x)
    x*log(x) - 2*x + tan(x)
    """
    found = _by_rules(integrand, x)
    if found is None:
        return None
    if _has_a_root_of_a_sum(integrand, x) and not _holds_on_every_side(found, integrand, x):
        return None
    return found


def _by_rules(integrand: Expr, x: Expr) -> Expr | None:
    """As a whole, or term by term; x may be a root or an exponential, which is positive."""
    integrand = prepared(integrand)
    functions = _functions(integrand)
    if not functions <= _SIMPLE | set(_BY_PARTS):
        return None
    if functions <= {exp}:
        whole = integral_of_product(integrand, x)
        if whole is not None:
            return whole
    groups = _by_inverse_functions(integrand, x)
    return sum_of(_of_terms(inverse, terms, x) for inverse, terms in groups.items())


def _has_a_root_of_a_sum(integrand: Expr, x: Expr) -> bool:
    """As in sqrt(1 + tan(x)^2), which is 1/cos(x) on one side of pi/2, and -1/cos(x) on the other one."""
    return any(base.has(x) and not base.is_Symbol for base in radicands(integrand))


def _holds_on_every_side(found: Expr, integrand: Expr, x: Expr) -> bool:
    """Is its derivative the integrand at real points far apart, wherever that is real?"""
    slope = found.diff(x)
    others = next(samples(integrand.free_symbols - {x}))
    for point in _POINTS:
        here = {**others, x: point}
        value = ball(integrand, here)
        if not _is_real(value):
            continue
        if _is_another(ball(slope, here), value):
            return False
    return True


def _is_real(value: Any) -> bool:
    """Is a value known, finite, and a real number as far as its ball says?"""
    return value is not None and value.is_finite() and value.imag.contains(0)


def _is_another(value: Any, wanted: Any) -> bool:
    """Is a value known, finite, and seen not to be the one that is wanted?"""
    return value is not None and value.is_finite() and not value.overlaps(wanted)


def _of_terms(inverse: Expr, terms: list[Expr], x: Expr) -> Expr | None:
    """One after the other; or, where one isn't known, their sum by parts."""
    check_time()
    found = sum_of(_of_term(term, x) for term in terms)
    if found is not None:
        return found
    beside = sympy.Add(*(term / inverse for term in terms))
    return _by_parts(inverse, beside, x)


def _functions(expression: Expr) -> set[Any]:
    return {f.func for f in expression.atoms(sympy.Function, sympy.Integral)}


def _by_inverse_functions(integrand: Expr, x: Expr) -> dict[Expr, list[Expr]]:
    """The terms, those with the same powers of functions that are to be differentiated together."""
    groups: dict[Expr, list[Expr]] = {}
    for term in sympy.Add.make_args(integrand):
        powers = [factor for factor in sympy.Mul.make_args(term) if _goes_by_parts(factor, x)]
        groups.setdefault(sympy.Mul(*powers), []).append(term)
    return groups


def _goes_by_parts(factor: Expr, x: Expr) -> bool:
    """Is it a power of a function of x that is to be differentiated?"""
    return factor.as_base_exp()[0].func in _BY_PARTS and factor.has(x)


def _of_term(term: Expr, x: Expr) -> Expr | None:
    """By the first rule that knows it."""
    rules = (
        _by_coefficients,
        _in_logarithms,
        _in_roots,
        _in_an_argument,
        _in_exponentials,
        _in_waves,
        _with_real_arguments,
        integral_of_product,
        fresnel,
        _beside_waves,
        _beside_tangents,
        _powers_by_parts,
        _in_a_linear_argument,
        in_complex_exponentials,
        incomplete_gamma,
        _in_roots_of_x,
    )
    for rule in rules:
        found = rule(term, x)
        if found is not None:
            return found
    return None


def in_powers(expression: Expr, t: Expr, u: Expr) -> Expr:
    """For t = log(u), with powers of u for exponentials."""
    powers = expression.replace(exp, lambda e: u ** e.diff(t) * exp(e.subs(t, 0)))
    return powers.subs(t, log(u))


def _by_coefficients(term: Expr, x: Expr) -> Expr | None:
    """Y' for Y'' = g."""
    found = undetermined(sympy.Integer(0), sympy.Integer(0), term, x)
    if found is None:
        return None
    return sympy.expand(found.diff(x))


def _in_logarithms(term: Expr, x: Expr) -> Expr | None:
    """In t = log(x)."""
    if not term.has(log(x)):
        return None
    t = sympy.Dummy(real=True)
    inner = prepared(term.subs(x, exp(t)) * exp(t))
    if inner.has(log) or inner.has(x):
        return None
    found = _known(inner, t)
    if found is None:
        return None
    return in_powers(found, t, x)


def _in_roots(term: Expr, x: Expr) -> Expr | None:
    """In t with x = t^q, for the root of x that stands within functions, or beside waves."""
    arguments = [f.args[0] for f in term.atoms(sympy.Function)]
    if term.has(sin, cos):
        arguments = [term]
    q = lcm(*(_index_of_root(argument, x) for argument in arguments))
    if q == 1:
        return None
    t = sympy.Dummy(positive=True)
    found = _known(_in_root(term, x, t, q), t)
    return _at(sympy.root(x, q), t, found)


def _index_of_root(e: Expr, x: Expr) -> int:
    """q, where x^(1/q) is the root of which all powers of x with rational exponents are powers."""
    powers = [power for power in e.atoms(sympy.Pow) if power.base == x and power.exp.is_Rational]
    return lcm(*(int(power.exp.q) for power in powers))


def _in_root(integrand: Expr, x: Expr, t: Expr, q: int) -> Expr:
    """The integrand for x = t^q, times dx/dt."""
    return integrand.subs(x, t**q) * q * t ** (q - 1)


def _in_roots_of_x(term: Expr, x: Expr) -> Expr | None:
    """A rational function of a root of x."""
    q = _index_of_root(term, x)
    if q == 1:
        return None
    t = sympy.Dummy(positive=True)
    found = integral_of_fraction(sympy.cancel(_in_root(term, x, t, q)), t)
    return _at(sympy.root(x, q), t, found)


def _at(u: Expr, t: Expr, found: Expr | None) -> Expr | None:
    """An integral that was found in t, for t = u."""
    if found is None:
        return None
    return found.subs(t, u)


def _in_a_linear_argument(term: Expr, x: Expr) -> Expr | None:
    """In u = a x + b, where a root of that alone stands beside functions."""
    bases = {base for base in radicands(term) if base.has(x)}
    if len(bases) != 1 or not _functions(term):
        return None
    (base,) = bases
    if not base.is_Add or not base.is_polynomial(x) or sympy.degree(base, x) != 1:
        return None
    u = sympy.Dummy()
    slope = base.diff(x)
    inner = term.subs(x, sympy.expand(x - (base - u) / slope)) / slope
    if inner.has(x):
        return None
    return _at(base, u, _known(inner, u))


def _in_an_argument(term: Expr, x: Expr) -> Expr | None:
    """In an argument u of a function, beside whose slope the term is one of u."""
    u = sympy.Dummy()
    for argument in sorted(_arguments_with_functions(term, x), key=str):
        inner = (term / argument.diff(x)).subs(argument, u)
        if inner.has(x):
            continue
        found = _known(inner, u)
        if found is not None:
            return found.subs(u, argument)
    return None


def _arguments_with_functions(term: Expr, x: Expr) -> set[Expr]:
    """The arguments of functions of which x isn't the only part."""
    arguments = {f.args[0] for f in term.atoms(sympy.Function)}
    return {argument for argument in arguments if argument.has(x) and argument.has(exp, sin, cos, log)}


def _known(integrand: Expr, t: Expr) -> Expr | None:
    """As `antiderivative` in another variable: an `Integral` that stays would have that."""
    found = _by_rules(integrand, t)
    return None if found is None or found.has(sympy.Integral) else found


def _in_exponentials(term: Expr, x: Expr) -> Expr | None:
    """In u = exp(k x), for which x is written."""
    term = sympy.expand(term)
    rates = {e: e.args[0].diff(x) for e in term.atoms(exp) if e.args[0].subs(x, 0) == 0}
    k = _rate_of_variable(term, rates)
    if k is None:
        return None
    u = sympy.Dummy()
    in_u = term.xreplace({e: u ** (rate / k) for e, rate in rates.items()}) / (k * u)
    if in_u.has(x):
        return None
    found = _in_one_exponential(prepared(in_u.xreplace({u: x})), x)
    return _at(exp(k * x), x, found)


def _rate_of_variable(term: Expr, rates: dict[Expr, Expr]) -> Expr | None:
    """k, with polynomials in exp(k x) under roots and in logarithms if that can be; None where there is no common rate."""
    k = _common_rate(list(rates.values()))
    if k is None:
        return None
    inner: set[Expr] = set()
    for argument in _arguments_of_roots_and_logarithms(term):
        inner |= argument.atoms(exp)
    powers = [rates[e] / k for e in inner if e in rates]
    if powers and all(power.is_negative for power in powers):
        return -k
    return k


def _in_one_exponential(integrand: Expr, u: Expr) -> Expr | None:
    """The integral of what is written in u = exp(k x)."""
    found = integral_of_fraction(integrand, u)
    if found is None:
        found = _by_coefficients(integrand, u)
    if found is None and not integrand.has(log(u)):  # in t = log(u) exponentials would come back
        found = _known(integrand, u)
    return found


def _arguments_of_roots_and_logarithms(term: Expr) -> list[Expr]:
    return [*radicands(term), *(f.args[0] for f in term.atoms(log))]


def _common_rate(rates: list[Expr]) -> Expr | None:
    """k, of which all rates are integer multiples; None where there is none."""
    if not rates or rates[0] == 0:
        return None
    ratios = [rate / rates[0] for rate in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    k = rates[0] * reduce(sympy.gcd, ratios)  # gcd_list stops at 1, though 1/2 may follow
    # One u for all terms, or logarithms that cancel would stay.
    if k.could_extract_minus_sign():
        return -k
    return k


@dataclass(frozen=True)
class _Change:
    """To a function u of theta: the integrand times dtheta/du, and s and c in u, for which x is written."""

    integrand: Expr
    waves: dict[Expr, Expr]
    u: Expr

    def integral(self, slope: Expr, x: Expr) -> Expr | None:
        """In theta, whose derivative is `slope`; None where it isn't known in u."""
        inner = self.integrand.subs(self.waves) / slope
        found = integral_of_fraction(sympy.cancel(inner), x)
        if found is None:  # beside a root of a wave
            found = _known(inner, x)
        if found is None:
            return None
        if self.u.func is not tan:
            return TR2i(found.xreplace({x: self.u}))
        angle = self.u.args[0]
        u = sympy.Dummy()
        known = {atan(u): angle, log(u**2 + 1): -2 * log(cos(angle)), u**2 + 1: cos(angle) ** -2}
        return TR2i(found.xreplace({x: u}).xreplace(known).xreplace({u: sin(angle) / cos(angle)}))


def _in_waves(term: Expr, x: Expr) -> Expr | None:
    """In c, s or a tangent."""
    waves = sorted(term.atoms(sin, cos), key=str)
    theta = _common_angle(waves)
    if theta is None:
        return None
    s = sympy.Dummy()
    c = sympy.Dummy()
    R = term.xreplace({wave: _multiple_angle(wave, theta, s, c) for wave in waves})
    slope = theta.diff(x)
    if R.has(x) or slope.has(x) or slope == 0:
        return None
    found = [change.integral(slope, x) for change in _changes(R, s, c, theta, x)]
    return min((done for done in found if done is not None), key=size, default=None)


def _common_angle(waves: list[Expr]) -> Expr | None:
    """theta, of which the arguments of all waves are integer multiples; None where there is none."""
    if not waves:
        return None
    first = waves[0].args[0]
    ratios = [sympy.cancel(wave.args[0] / first) for wave in waves]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    return first * reduce(sympy.gcd, ratios)


def _multiple_angle(wave: Expr, theta: Expr, s: Expr, c: Expr) -> Expr:
    """sin(n theta) or cos(n theta) in s = sin(theta) and c = cos(theta)."""
    n = int(sympy.cancel(wave.args[0] / theta))
    if wave.func is cos:
        return sympy.chebyshevt(abs(n), c)
    return sympy.sign(n) * s * sympy.chebyshevu(abs(n) - 1, c)


def _changes(R: Expr, s: Expr, c: Expr, theta: Expr, x: Expr) -> list[_Change]:
    """The changes of variable that make R, a function of s and c, a rational function; u is x."""
    root = sympy.sqrt(1 - x**2)
    square = 1 + x**2
    found = []
    if sympy.cancel(R + R.xreplace({s: -s})) == 0:
        found.append(_Change(-R / s, {s: root, c: x}, cos(theta)))
    if sympy.cancel(R + R.xreplace({c: -c})) == 0:
        found.append(_Change(R / c, {c: root, s: x}, sin(theta)))
    if found:
        return found
    if sympy.cancel(R - R.xreplace({s: -s, c: -c})) == 0:
        return [_Change(R / square, {s: x / sympy.sqrt(square), c: 1 / sympy.sqrt(square)}, tan(theta))]
    return [_Change(2 * R / square, {s: 2 * x / square, c: (1 - x**2) / square}, tan(theta / 2))]


def _with_real_arguments(term: Expr, x: Expr) -> Expr | None:
    """exp(i w x) as cos(w x) + i sin(w x), beside waves."""
    waves = {}
    for e in term.atoms(exp):
        angle = sympy.expand(e.args[0] / sympy.I)
        if e.args[0].has(sympy.I) and not angle.has(sympy.I):
            waves[e] = cos(angle) + sympy.I * sin(angle)
    if not waves:
        return None
    return _in_waves(term.xreplace(waves), x)


@dataclass(frozen=True)
class _Power:
    """function^m with a natural number m."""

    function: Expr
    m: Expr


def _by_parts(inverse: Expr, g: Expr, x: Expr) -> Expr | None:
    """int g l dx = G l - int G l' dx for a product l of inverse functions and the like, where G is simpler than these."""
    powers = _natural_powers(inverse)
    if not powers:
        return None
    if len(powers) == 1:
        found = _of_one_function(powers[0], g, x)
        if found is not None:
            return found
    G = _by_rules(g, x)
    if G is None:
        return None
    if len(powers) == 1:
        share = sympy.expand(G).coeff(powers[0].function)
        if share != 0 and not share.has(x):
            return _with_share(powers[0], share, g, x)
    if not _functions(G) <= _SIMPLE:
        return None
    rates = [power.m * _slope(power.function, x) / power.function for power in powers]  # l'/l, by factors
    rest = _by_rules(sympy.Add(*(rate * inverse * G for rate in rates)), x)
    if rest is None:
        return None
    return sympy.expand(G * inverse) - rest


def _natural_powers(inverse: Expr) -> list[_Power]:
    """The factors of a product; none where an exponent isn't a natural number, and of 1."""
    powers = [_Power(*factor.as_base_exp()) for factor in sympy.Mul.make_args(inverse)]
    if inverse == 1 or not all(power.m.is_Integer and power.m > 0 for power in powers):
        return []
    return powers


def _with_share(power: _Power, share: Expr, g: Expr, x: Expr) -> Expr | None:
    """int g l^m dx for g = k l' + H' with a constant share k: k l^(m + 1)/(m + 1) + int H' l^m dx."""
    function = power.function
    m = power.m
    rest = _by_parts(function**m, sympy.expand(g - share * function.diff(x)), x)
    if rest is None:
        return None
    return share * function ** (m + 1) / (m + 1) + rest


def _slope(function: Expr, x: Expr) -> Expr:
    """1/sqrt(x^2 + 1) for log(x + sqrt(x^2 + 1))."""
    slope = sympy.cancel(function.diff(x))
    if slope.is_rational_function(x):
        return slope
    return sympy.powsimp(sympy.radsimp(slope))


def _of_one_function(power: _Power, g: Expr, x: Expr) -> Expr | None:
    """int l^m l' dx, and dilogarithms."""
    function = power.function
    m = power.m
    ratio = sympy.cancel(g / function.diff(x))
    if not ratio.has(x):
        return ratio * function ** (m + 1) / (m + 1)
    if function.func is not log or m != 1 or not g.is_rational_function(x):
        return None
    return _beside_logarithm(function, g, x)


def _beside_logarithm(logarithm: Expr, g: Expr, x: Expr) -> Expr | None:
    """int R log(u) dx, where a partial fraction of R has a dilogarithm; None where none has."""
    fractions = sympy.Add.make_args(sympy.apart(g, x))
    known = {fraction: dilogarithm(logarithm.args[0], fraction, x) for fraction in fractions}
    if all(found is None for found in known.values()):
        return None
    unknown = [fraction for fraction, found in known.items() if found is None]
    known |= {fraction: _by_parts(logarithm, fraction, x) for fraction in unknown}
    return sum_of(known.values())


def _powers_by_parts(term: Expr, x: Expr) -> Expr | None:
    """int P g dx = P G - int P' G dx for a polynomial P, as in x/cos(x)^2; g has no functions that go by parts themselves."""
    factors = sympy.Mul.make_args(term)
    P = sympy.Mul(*(factor for factor in factors if factor.is_polynomial(x)))
    g = term / P
    if not P.has(x) or not g.has(x) or not _functions(g) <= _SIMPLE:
        return None
    G = _known(g, x)
    if G is None:
        return None
    rest = _beside_slope(P.diff(x), G, x)
    if rest is None or rest.has(sympy.Integral):
        return None
    return P * G - rest


def _beside_slope(slope: Expr, G: Expr, x: Expr) -> Expr | None:
    """int P' G dx; term by term where G has functions that go by parts, which would come back to P."""
    if _functions(G) <= {exp, sin, cos, tan}:
        return _known(slope * G, x)
    terms = sympy.Add.make_args(prepared(slope * G))
    return sum_of(_of_term(term, x) for term in terms)


def _beside_waves(term: Expr, x: Expr) -> Expr | None:
    """int R cos(w x + b) dx for rational R, after partial fractions, by sine and cosine integrals."""
    if not term.has(sin, cos) or term.has(exp, log, atan):
        return None
    singles = sympy.Add.make_args(sympy.expand(TR8(term)))
    return sum_of(_beside_at_most_one_wave(single, x) for single in singles)


def _beside_at_most_one_wave(term: Expr, x: Expr) -> Expr | None:
    """The integral of R, or of R times a wave, by partial fractions."""
    waves = term.atoms(sin, cos)
    if len(waves) > 1:
        return None
    wave = next(iter(waves), sympy.Integer(1))
    R = term / wave
    if not R.is_rational_function(x) or R.has(sin, cos):
        return None
    fractions = sympy.Add.make_args(sympy.apart(R, x))
    if not waves:
        return sum_of(integral_of_product(fraction, x) for fraction in fractions)
    return sum_of(_beside_one_wave(fraction, wave, x) for fraction in fractions)


def _beside_one_wave(fraction: Expr, wave: Expr, x: Expr) -> Expr | None:
    """The integral of a polynomial, or of a single pole, times a wave."""
    slope = wave.args[0].diff(x)
    if slope.has(x):
        return None
    found = _by_coefficients(fraction * wave, x)
    if found is not None:
        return found
    return _at_a_pole(fraction, wave, slope, x)


def _at_a_pole(fraction: Expr, wave: Expr, slope: Expr, x: Expr) -> Expr | None:
    """int f g/(x - c)^k dx for a constant f and a wave g: by parts down to k = 1, which is Si and Ci."""
    base, exponent = fraction.as_independent(x, as_Add=False)[1].as_base_exp()
    if not exponent.is_Integer or exponent >= 0 or base.diff(x).has(x):
        return None
    c = sympy.expand(x - base / base.diff(x))
    k = -int(exponent)
    factor = sympy.cancel(fraction * (x - c) ** k)
    total = sympy.Integer(0)
    while k > 1:
        total -= factor * wave / ((k - 1) * (x - c) ** (k - 1))
        factor = factor / (k - 1)
        wave = wave.diff(x)
        k -= 1
    number, wave = wave.as_independent(x, as_Add=False)
    return total + factor * number * _over_a_line(wave, c, slope, x)


def _over_a_line(wave: Expr, c: Expr, slope: Expr, x: Expr) -> Expr:
    """int sin(u + p)/(x - c) dx = cos(p) Si(u) + sin(p) Ci(u) with u = slope (x - c), and p + pi/2 for the cosine."""
    u = slope * (x - c)
    phase = sympy.expand(wave.args[0].subs(x, c))
    if wave.func is sin:
        return cos(phase) * sympy.Si(u) + sin(phase) * sympy.Ci(u)
    return -sin(phase) * sympy.Si(u) + cos(phase) * sympy.Ci(u)


def _beside_tangents(term: Expr, x: Expr) -> Expr | None:
    """int q + (a + b s)/c dx for a wave c with simple zeros: at these s = 1 or -1, and residues must be constant [Risch]."""
    c = _only_wave_below(term)
    if c is None:
        return None
    s = cos(c.args[0]) if c.func is sin else sin(c.args[0])
    above = term * c
    if not above.is_polynomial(s, c):
        return None
    (_, q), rest = sympy.reduced(above, [s**2 + c**2 - 1, c], s, c)
    if rest.has(log, atan):
        return None
    residues = [rest.xreplace({s: sympy.Integer(sign)}) for sign in (1, -1)]
    if any(residue.has(sin, cos) or not residue.has(x) for residue in residues):
        return None
    found = _by_rules(q, x)
    if found is None:
        return None
    return found + sympy.Integral(rest / c, x)


def _only_wave_below(term: Expr) -> Expr | None:
    """The wave c of the only factor 1/c; None where there are others or none."""
    below = [factor.base for factor in sympy.Mul.make_args(term) if factor.is_Pow and factor.exp == -1]
    waves = [base for base in below if base.func in (sin, cos)]
    if len(waves) != 1:
        return None
    return waves[0]

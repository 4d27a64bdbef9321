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

from kovacic.general_solution.integrands import integral_of_fraction, integral_of_product, prepared
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
    if found is None or (_has_a_root_of_a_sum(integrand, x) and not _holds_on_every_side(found, integrand, x)):
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
    parts = []
    for inverse, terms in _by_inverse_functions(integrand, x).items():
        check_time()
        found = _of_terms(inverse, terms, x)
        if found is None:
            return None
        parts.append(found)
    return sympy.Add(*parts)


def _has_a_root_of_a_sum(integrand: Expr, x: Expr) -> bool:
    """As in sqrt(1 + tan(x)^2), which is 1/cos(x) on one side of pi/2, and -1/cos(x) on the other one."""
    roots = [p.base for p in integrand.atoms(sympy.Pow) if p.exp.is_Rational and not p.exp.is_Integer]
    return any(base.has(x) and not base.is_Symbol for base in roots)


def _holds_on_every_side(found: Expr, integrand: Expr, x: Expr) -> bool:
    """Is its derivative the integrand at real points far apart, wherever that is real?"""
    slope = found.diff(x)
    others = next(samples(integrand.free_symbols - {x}))
    for point in _POINTS:
        here = {**others, x: point}
        value = ball(integrand, here)
        if value is None or not value.is_finite() or not value.imag.contains(0):
            continue
        derivative = ball(slope, here)
        if derivative is not None and derivative.is_finite() and not derivative.overlaps(value):
            return False
    return True


def _of_terms(inverse: Expr, terms: list[Expr], x: Expr) -> Expr | None:
    """One after the other; or, where one isn't known, their sum by parts."""
    found = [_of_term(term, x) for term in terms]
    if None not in found:
        return sympy.Add(*found)
    beside = sympy.Add(*(term / inverse for term in terms))
    return _by_parts(inverse, beside, x)


def _functions(expression: Expr) -> set[Any]:
    return {f.func for f in expression.atoms(sympy.Function, sympy.Integral)}


def _by_inverse_functions(integrand: Expr, x: Expr) -> dict[Expr, list[Expr]]:
    """The terms, those with the same powers of functions that are to be differentiated together."""
    groups: dict[Expr, list[Expr]] = {}
    for term in sympy.Add.make_args(integrand):
        powers = [p for p in sympy.Mul.make_args(term) if p.as_base_exp()[0].func in _BY_PARTS and p.has(x)]
        groups.setdefault(sympy.Mul(*powers), []).append(term)
    return groups


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
    found = undetermined(sympy.Integer(0), sympy.Integer(0), term, x)
    return None if found is None else sympy.expand(found.diff(x))


def _in_logarithms(term: Expr, x: Expr) -> Expr | None:
    """In t = log(x)."""
    if not term.has(log(x)):
        return None
    t = sympy.Dummy(real=True)
    inner = prepared(term.subs(x, exp(t)) * exp(t))
    if inner.has(log) or inner.has(x):
        return None
    found = _known(inner, t)
    return None if found is None else in_powers(found, t, x)


def _in_roots(term: Expr, x: Expr) -> Expr | None:
    """In t with x = t^q, for the root of x that stands within functions."""
    q = _index_of_root(term, x)
    if q == 1:
        return None
    t = sympy.Dummy(positive=True)
    found = _known(term.subs(x, t**q) * q * t ** (q - 1), t)
    return None if found is None else found.subs(t, sympy.root(x, q))


def _index_of_root(term: Expr, x: Expr) -> int:
    """q, where x^(1/q) is the root of which all powers of x in arguments, or beside waves, are powers."""
    arguments = [f.args[0] for f in term.atoms(sympy.Function)]
    if term.has(sin, cos):
        arguments = [term]
    q = 1
    for argument in arguments:
        powers = [power for power in argument.atoms(sympy.Pow) if power.base == x and power.exp.is_Rational]
        q = lcm(q, *(int(power.exp.q) for power in powers))
    return q


def _in_roots_of_x(term: Expr, x: Expr) -> Expr | None:
    """A rational function of a root of x."""
    powers = [p for p in term.atoms(sympy.Pow) if p.base == x and p.exp.is_Rational]
    q = lcm(*(int(p.exp.q) for p in powers))
    t = sympy.Dummy(positive=True)
    inner = term.subs(x, t**q) * q * t ** (q - 1)
    found = None if q == 1 else integral_of_fraction(sympy.cancel(inner), t)
    return None if found is None else found.subs(t, sympy.root(x, q))


def _in_a_linear_argument(term: Expr, x: Expr) -> Expr | None:
    """In u = a x + b, where a root of that alone stands beside functions."""
    roots = {p.base for p in term.atoms(sympy.Pow) if p.exp.is_Rational and not p.exp.is_Integer and p.base.has(x)}
    if len(roots) != 1 or not _functions(term):
        return None
    (base,) = roots
    if not base.is_Add or not base.is_polynomial(x) or sympy.degree(base, x) != 1:
        return None
    u = sympy.Dummy()
    inner = term.subs(x, sympy.expand(x - (base - u) / base.diff(x))) / base.diff(x)
    found = None if inner.has(x) else _known(inner, u)
    return None if found is None else found.subs(u, base)


def _in_an_argument(term: Expr, x: Expr) -> Expr | None:
    """In an argument u of a function, beside whose slope the term is one of u."""
    u = sympy.Dummy()
    arguments = {f.args[0] for f in term.atoms(sympy.Function)}
    for argument in sorted((a for a in arguments if a.has(x) and a.has(exp, sin, cos, log)), key=str):
        inner = (term / argument.diff(x)).subs(argument, u)
        found = None if inner.has(x) else _known(inner, u)
        if found is not None:
            return found.subs(u, argument)
    return None


def _known(integrand: Expr, t: Expr) -> Expr | None:
    """As `antiderivative` in another variable: an `Integral` that stays would have that."""
    found = _by_rules(integrand, t)
    return None if found is None or found.has(sympy.Integral) else found


def _in_exponentials(term: Expr, x: Expr) -> Expr | None:
    """In u = exp(k x), for which x is written."""
    term = sympy.expand(term)
    rates = {e: e.args[0].diff(x) for e in term.atoms(exp) if e.args[0].subs(x, 0) == 0}
    k = _common_rate(list(rates.values()))
    if k is None:
        return None
    inner = [e for argument in _arguments_of_roots_and_logarithms(term) for e in argument.atoms(exp)]
    inner_rates = [rates[e] for e in inner if e in rates]
    if inner_rates and all((rate / k).is_negative for rate in inner_rates):  # with polynomials there
        k = -k
    u = sympy.Dummy()
    inner = term.xreplace({e: u ** (rate / k) for e, rate in rates.items()}) / (k * u)
    if inner.has(x):
        return None
    inner = prepared(inner.xreplace({u: x}))
    found = integral_of_fraction(inner, x)
    if found is None:
        found = _by_coefficients(inner, x)
    if found is None and not inner.has(log(x)):
        found = _known(inner, x)
    return None if found is None else found.subs(x, exp(k * x))


def _arguments_of_roots_and_logarithms(term: Expr) -> list[Expr]:
    roots = [p.base for p in term.atoms(sympy.Pow) if p.exp.is_Rational and not p.exp.is_Integer]
    return [*roots, *(f.args[0] for f in term.atoms(log))]


def _common_rate(rates: list[Expr]) -> Expr | None:
    """k, of which all rates are integer multiples; None where there is none."""
    if not rates or rates[0] == 0:
        return None
    ratios = [rate / rates[0] for rate in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    k = rates[0] * reduce(sympy.gcd, ratios)  # gcd_list stops at 1, though 1/2 may follow
    # One u for all terms, or logarithms that cancel would stay.
    return -k if k.could_extract_minus_sign() else k


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
    return _in_waves(term.xreplace(waves), x) if waves else None


def _by_parts(inverse: Expr, g: Expr, x: Expr) -> Expr | None:
    """int g l dx = G l - int G l' dx for a product l of inverse functions and the like, where G is simpler than these."""
    powers = [power.as_base_exp() for power in sympy.Mul.make_args(inverse)]
    if inverse == 1 or not all(m.is_Integer and m > 0 for _, m in powers):
        return None
    if len(powers) == 1:
        function, m = powers[0]
        found = _of_one_function(function, m, g, x)
        if found is not None:
            return found
    G = _by_rules(g, x)
    if G is None:
        return None
    (function, m), *others = powers
    share = sympy.expand(G).coeff(function)
    if not others and share != 0 and not share.has(x):  # int (k l' + H') l^m dx
        whole = share * function ** (m + 1) / (m + 1)
        rest = _by_parts(inverse, sympy.expand(g - share * function.diff(x)), x)
        return None if rest is None else whole + rest
    if not _functions(G) <= _SIMPLE:
        return None
    slopes = [m * _slope(function, x) * inverse / function for function, m in powers]
    rest = _by_rules(sympy.Add(*(slope * G for slope in slopes)), x)
    return None if rest is None else sympy.expand(G * inverse) - rest


def _slope(function: Expr, x: Expr) -> Expr:
    """1/sqrt(x^2 + 1) for log(x + sqrt(x^2 + 1))."""
    slope = sympy.cancel(function.diff(x))
    return slope if slope.is_rational_function(x) else sympy.powsimp(sympy.radsimp(slope))


def _of_one_function(function: Expr, m: Expr, g: Expr, x: Expr) -> Expr | None:
    """int l^m l' dx, and dilogarithms."""
    ratio = sympy.cancel(g / function.diff(x))
    if not ratio.has(x):
        return ratio * function ** (m + 1) / (m + 1)
    if function.func is not log or m != 1 or not g.is_rational_function(x):
        return None
    u = function.args[0]
    parts = sympy.Add.make_args(sympy.apart(g, x))
    found = [dilogarithm(u, part, x) for part in parts]
    if all(part is None for part in found):
        return None
    rest = [_by_parts(function, part, x) if done is None else done for part, done in zip(parts, found, strict=True)]
    return None if None in rest else sympy.Add(*rest)


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
    if _functions(G) <= {exp, sin, cos, tan}:
        rest = _known(P.diff(x) * G, x)
    else:  # what goes by parts would come back
        found = [_of_term(part, x) for part in sympy.Add.make_args(prepared(P.diff(x) * G))]
        rest = None if None in found else sympy.Add(*found)
    return None if rest is None or rest.has(sympy.Integral) else P * G - rest


def _beside_waves(term: Expr, x: Expr) -> Expr | None:
    """int R cos(w x + b) dx for rational R, after partial fractions, by sine and cosine integrals."""
    if not term.has(sin, cos) or term.has(exp, log, atan):
        return None
    parts = []
    for single in sympy.Add.make_args(sympy.expand(TR8(term))):
        waves = single.atoms(sin, cos)
        if len(waves) > 1:
            return None
        wave = next(iter(waves), sympy.Integer(1))
        R = single / wave
        if not R.is_rational_function(x) or R.has(sin, cos):
            return None
        for fraction in sympy.Add.make_args(sympy.apart(R, x)):
            found = _beside_one_wave(fraction, wave, x) if waves else integral_of_product(fraction, x)
            if found is None:
                return None
            parts.append(found)
    return sympy.Add(*parts)


def _beside_one_wave(fraction: Expr, wave: Expr, x: Expr) -> Expr | None:
    """The integral of a polynomial, or of a single pole, times a wave."""
    slope = wave.args[0].diff(x)
    if slope.has(x):
        return None
    found = _by_coefficients(fraction * wave, x)
    return _at_a_pole(fraction, wave, slope, x) if found is None else found


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
    reciprocals = [f for f in sympy.Mul.make_args(term) if f.is_Pow and f.exp == -1 and f.base.func in (sin, cos)]
    if len(reciprocals) != 1:
        return None
    c = reciprocals[0].base
    s = cos(c.args[0]) if c.func is sin else sin(c.args[0])
    if not (term * c).is_polynomial(s, c):
        return None
    (_, q), rest = sympy.reduced(term * c, [s**2 + c**2 - 1, c], s, c)
    if rest.has(log, atan):
        return None
    for sign in (1, -1):
        residue = rest.xreplace({s: sympy.Integer(sign)})
        if residue.has(sin, cos) or not residue.has(x):
            return None
    found = _by_rules(q, x)
    return None if found is None else found + sympy.Integral(rest / c, x)

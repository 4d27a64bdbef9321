"""int g dx for the integrands that variation of parameters meets, at once, without SymPy's integration.

- Products of powers and exponentials of rational functions (Ei, erf, gamma functions): `kovacic.closed_form.primitive`.
- Logarithms and inverse tangents times these, by parts; waves times rational functions (sine and cosine integrals).
- Tangents, cotangents, secants, ... times functions whose residues aren't constant: the rest, and an `Integral` that stays.
- Polynomials times exponentials and waves in x or exp(k x): Y' for Y'' = g, by undetermined coefficients.
- All of these in log(x), a root of x, or an argument u of a function beside u'.
- Rational functions of exp(k x), or of s = sin(theta) and c = cos(theta), theta = w x + phi, by partial fractions in

      c if g is odd in s,    s if g is odd in c,    tan(theta) if g(-s, -c) = g(s, c),    tan(theta/2) otherwise.
"""

from __future__ import annotations

from math import lcm
from typing import Any

import sympy
from sympy import atan, cos, cosh, cot, coth, csc, csch, exp, log, sec, sech, sin, sinh, tan, tanh
from sympy.simplify.fu import TR8, TR2i

from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, factors
from kovacic.closed_form.integrals import integral, logarithms
from kovacic.closed_form.product import product
from kovacic.equation import EULER, PI
from kovacic.errors import InputError
from kovacic.general_solution.substitution import size
from kovacic.general_solution.undetermined import undetermined
from kovacic.limits import check_time
from kovacic.reading.read import read_input

Expr = Any  # SymPy publishes no types
#: The numbers that are parameters in coefficients.
NUMBERS = {sympy.Symbol(PI): sympy.pi, sympy.Symbol(EULER): sympy.E}


def antiderivative(integrand: Expr, x: Expr) -> Expr | None:
    """int g dx, None where a term isn't of one of these kinds; an `Integral` that isn't elementary beside tangents.

    >>> x = sympy.Symbol("x")
    >>> antiderivative(tan(x) ** 2 + log(x), x)
    x*log(x) - 2*x + tan(x)
    """
    integrand, parts = prepared(integrand), []
    functions = {f.func for f in integrand.atoms(sympy.Function, sympy.Integral)}
    if not functions <= {exp, log, sin, cos, atan}:
        return None
    if functions <= {exp} and (whole := _of_product(integrand, x)) is not None:
        return whole
    rules = (
        _by_coefficients,
        _in_logarithms,
        _in_roots,
        _in_an_argument,
        _in_exponentials,
        _in_waves,
        _of_product,
        _beside_waves,
        _beside_tangents,
    )
    groups: dict[Expr, list[Expr]] = {}  # terms with the same logarithms
    for term in sympy.Add.make_args(integrand):
        inverse = [factor for factor in sympy.Mul.make_args(term) if factor.as_base_exp()[0].func in (log, atan)]
        groups.setdefault(sympy.Mul(*inverse), []).append(term)
    for inverse, terms in groups.items():
        check_time()
        found = [next((part for rule in rules if (part := rule(term, x)) is not None), None) for term in terms]
        if None in found:
            found = [_by_parts(inverse, sympy.Add(*(term / inverse for term in terms)), x)]
        if None in found:
            return None
        parts += found
    return sympy.Add(*parts)


def prepared(integrand: Expr) -> Expr:
    """Expanded, in sines, cosines and exponentials."""
    integrand = integrand.rewrite((sinh, cosh, tanh, coth, sech, csch), exp)
    if integrand.has(tan, cot, sec, csc):
        integrand = integrand.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        integrand = integrand.replace(sec, lambda a: 1 / cos(a)).replace(csc, lambda a: 1 / sin(a))
    return sympy.expand(integrand, power_exp=False)


def in_powers(expression: Expr, t: Expr, u: Expr) -> Expr:
    """For t = log(u), with powers of u for exponentials."""
    powers = expression.replace(exp, lambda e: u ** e.diff(t) * exp(e.subs(t, 0)))
    return powers.subs(t, log(u))


def _by_coefficients(term: Expr, x: Expr) -> Expr | None:
    found = undetermined(sympy.Integer(0), sympy.Integer(0), term, x)
    return None if found is None else sympy.expand(found.diff(x))


def _in_logarithms(term: Expr, x: Expr) -> Expr | None:
    """In t = log(x)."""
    t = sympy.Dummy(real=True)
    inner = prepared(term.subs(x, exp(t)) * exp(t)) if term.has(log(x)) else term
    found = None if inner.has(log) or inner.has(x) else _known(inner, t)
    return None if found is None else in_powers(found, t, x)


def _in_roots(term: Expr, x: Expr) -> Expr | None:
    """In the root of x that stands within functions."""
    arguments = [f.args[0] for f in term.atoms(sympy.Function)]
    q = lcm(*(int(p.exp.q) for u in arguments for p in u.atoms(sympy.Pow) if p.base == x and p.exp.is_Rational))
    t = sympy.Dummy(positive=True)
    found = None if q == 1 else _known(term.subs(x, t**q) * q * t ** (q - 1), t)
    return None if found is None else found.subs(t, sympy.root(x, q))


def _in_an_argument(term: Expr, x: Expr) -> Expr | None:
    """In an argument u of a function, beside whose slope the term is one of u."""
    u, arguments = sympy.Dummy(), {f.args[0] for f in term.atoms(sympy.Function)}
    for argument in sorted((a for a in arguments if a.has(x) and a.has(exp, sin, cos, log)), key=str):
        inner = (term / argument.diff(x)).subs(argument, u)
        if not inner.has(x) and (found := _known(inner, u)) is not None:
            return found.subs(u, argument)
    return None


def _known(integrand: Expr, t: Expr) -> Expr | None:
    """As `antiderivative` in another variable: an `Integral` that stays would have that."""
    found = antiderivative(integrand, t)
    return None if found is None or found.has(sympy.Integral) else found


def _in_exponentials(term: Expr, x: Expr) -> Expr | None:
    """In u = exp(k x), for which x is written."""
    term = sympy.expand(term)
    rates = {e: e.args[0].diff(x) for e in term.atoms(exp) if e.args[0].subs(x, 0) == 0}
    if not rates or not all(rate.is_Rational for rate in rates.values()):
        return None
    k, u = sympy.gcd_list([*rates.values()]), sympy.Dummy()
    inner = term.xreplace({e: u ** (rate / k) for e, rate in rates.items()}) / (k * u)
    if inner.has(x):
        return None
    inner = sympy.expand(inner.xreplace({u: x}))
    found = _rational(inner, x)
    found = _by_coefficients(inner, x) if found is None else found
    return None if found is None else found.subs(x, exp(k * x))


def _in_waves(term: Expr, x: Expr) -> Expr | None:
    """In c, s or a tangent, for which x is written."""
    waves = sorted(term.atoms(sin, cos), key=str)
    ratios = [sympy.cancel(wave.args[0] / waves[0].args[0]) for wave in waves]
    if not waves or not all(ratio.is_Rational for ratio in ratios):
        return None
    unit, s, c = sympy.gcd_list(ratios), sympy.Dummy(), sympy.Dummy()
    theta, multiples = waves[0].args[0] * unit, {}
    for wave, n in zip(waves, (int(ratio / unit) for ratio in ratios), strict=True):
        sine = sympy.sign(n) * s * sympy.chebyshevu(abs(n) - 1, c)
        multiples[wave] = sine if wave.func is sin else sympy.chebyshevt(abs(n), c)
    R, slope = term.xreplace(multiples), theta.diff(x)
    if R.has(x) or slope.has(x) or slope == 0:
        return None
    root, square, changes = sympy.sqrt(1 - x**2), 1 + x**2, []
    if sympy.cancel(R + R.xreplace({s: -s})) == 0:
        changes.append((-R / s, {s: root, c: x}, cos(theta)))
    if sympy.cancel(R + R.xreplace({c: -c})) == 0:
        changes.append((R / c, {c: root, s: x}, sin(theta)))
    if not changes and sympy.cancel(R - R.xreplace({s: -s, c: -c})) == 0:
        changes.append((R / square, {s: x / sympy.sqrt(square), c: 1 / sympy.sqrt(square)}, tan(theta)))
    if not changes:
        changes.append((2 * R / square, {s: 2 * x / square, c: (1 - x**2) / square}, tan(theta / 2)))
    done = []
    for inner, values, back in changes:
        found = _rational(sympy.cancel(inner.subs(values) / slope), x)
        if found is not None:
            angle, u = back.args[0], sympy.Dummy()
            known = {atan(u): angle, log(u**2 + 1): -2 * log(cos(angle)), u**2 + 1: cos(angle) ** -2}
            found = found.xreplace({x: u}).xreplace(known if back.func is tan else {})
            done.append(TR2i(found.xreplace({u: sin(angle) / cos(angle) if back.func is tan else back})))
    return min(done, key=size, default=None)


def _of_product(term: Expr, x: Expr) -> Expr | None:
    rate = None if term.has(sin, cos, log) else ratfunc(_rate(term, x), x)
    if rate is None:
        return None
    atoms, h = Atoms(x), product(rate)
    scale, shown = factors(h, atoms)
    ratio, found = term / (scale * sympy.Mul(*shown)), integral(h, atoms)
    values = (sympy.powsimp(ratio.subs(x, k)) for k in (2, 3, 5))
    constant = next((c for c in values if c != 0 and not c.has(sympy.nan, sympy.zoo)), None)
    return None if found is None or constant is None else sympy.expand(constant * found)


def _by_parts(power: Expr, g: Expr, x: Expr) -> Expr | None:
    """int g l^m dx = G l^m - int m G l^(m - 1) l' dx for l = log(u) or atan(u), where G is simpler than these."""
    inverse, m = power.as_base_exp()
    if inverse.func not in (log, atan) or not m.is_Integer or m < 1:
        return None
    G = antiderivative(g, x)
    if G is None or not {f.func for f in G.atoms(sympy.Function)} <= {exp, sin, cos}:
        return None
    rest = antiderivative(sympy.cancel(m * inverse.diff(x)) * G * inverse ** (m - 1), x)
    return None if rest is None else sympy.expand(G * power) - rest


def _beside_waves(term: Expr, x: Expr) -> Expr | None:
    """int cos(w x + b)/(x - c)^k dx by sine and cosine integrals, after partial fractions."""
    if not term.has(sin, cos) or term.has(exp, log, atan):
        return None
    parts = []
    for single in sympy.Add.make_args(sympy.expand(TR8(term))):
        waves = single.atoms(sin, cos)
        R, wave = (single / next(iter(waves)), next(iter(waves))) if waves else (single, sympy.Integer(1))
        slope = wave.args[0].diff(x) if waves else sympy.Integer(1)
        if len(waves) > 1 or not R.is_rational_function(x) or R.has(sin, cos) or slope.has(x):
            return None
        for fraction in sympy.Add.make_args(sympy.apart(R, x)):
            done = undetermined(sympy.Integer(0), sympy.Integer(0), fraction * wave, x)
            parts.append(_of_product(fraction, x) if not waves else done and sympy.expand(done.diff(x)))
            if parts[-1] is None:
                parts[-1] = _at_a_pole(fraction, wave, slope, x)
            if parts[-1] is None:
                return None
    return sympy.Add(*parts)


def _at_a_pole(fraction: Expr, wave: Expr, slope: Expr, x: Expr) -> Expr | None:
    base, exponent = fraction.as_independent(x, as_Add=False)[1].as_base_exp()
    if not exponent.is_Integer or exponent >= 0 or base.diff(x).has(x):
        return None
    c, k = sympy.expand(x - base / base.diff(x)), -int(exponent)
    total, factor = sympy.Integer(0), sympy.cancel(fraction * (x - c) ** k)
    while k > 1:
        total -= factor * wave / ((k - 1) * (x - c) ** (k - 1))
        factor, wave, k = factor / (k - 1), wave.diff(x), k - 1
    number, wave = wave.as_independent(x, as_Add=False)
    u, phase = slope * (x - c), sympy.expand(wave.args[0].subs(x, c))
    # sin(u + p) = cos(p) sin(u) + sin(p) cos(u), and p + pi/2 for the cosine.
    a, b = (cos(phase), sin(phase)) if wave.func is sin else (-sin(phase), cos(phase))
    return total + factor * number * (a * sympy.Si(u) + b * sympy.Ci(u))


def _beside_tangents(term: Expr, x: Expr) -> Expr | None:
    """int q + (a + b s)/c dx for a wave c with simple zeros: at these s = 1 or -1, and residues must be constant [Risch]."""
    below = [f.base for f in sympy.Mul.make_args(term) if f.is_Pow and f.exp == -1 and f.base.func in (sin, cos)]
    if len(below) != 1:
        return None
    c, s = below[0], (cos if below[0].func is sin else sin)(below[0].args[0])
    if not (term * c).is_polynomial(s, c):
        return None
    (_, q), rest = sympy.reduced(term * c, [s**2 + c**2 - 1, c], s, c)
    values = [rest.xreplace({s: sympy.Integer(sign)}) for sign in (1, -1)]
    if rest.has(log, atan) or not all(value.has(x) and not value.has(sin, cos) for value in values):
        return None
    found = antiderivative(q, x)
    return None if found is None else found + sympy.Integral(rest / c, x)


def _rate(g: Expr, x: Expr) -> Expr:
    """The logarithmic derivative, by factors; that of t (1 + u/t + ...) for a sum t + u + ..."""
    parts = []
    for term in sympy.Add.make_args(g):
        powers = [factor.as_base_exp() for factor in sympy.Mul.make_args(term)]
        exponent = sympy.Add(*(e for base, e in powers if base is sympy.E))
        parts.append(([(base, e) for base, e in powers if base is not sympy.E], exponent))
    (first, E), *rest = parts
    found, others = E.diff(x), sympy.Integer(1)
    for base, e in first:
        if base.is_Add and base.has(exp) and e.is_Rational:  # as in exp(-x)/(x + 1), which SymPy expands
            found += e * _rate(base, x)
        else:
            found += e * base.diff(x) / base if base.has(x) else e.diff(x) * log(base)
    for powers, exponent in rest:
        quotient = sympy.Mul(*(base**e for base, e in powers), *(base**-e for base, e in first))
        others += quotient * exp(sympy.cancel(exponent - E))
    return found + others.diff(x) / others


def _rational(g: Expr, x: Expr) -> Expr | None:
    """By partial fractions; None where g isn't a rational function of x."""
    r = ratfunc(g, x)
    if r is None:
        return None
    atoms, parts = Atoms(x), decompose(r)
    return (atoms.sum(parts.exact) + sympy.Add(*logarithms(parts.residues, atoms))).xreplace(NUMBERS)


def ratfunc(expression: Expr, x: Expr) -> RatFunc | None:
    """A rational function, over a field with pi as a parameter; None for anything else."""
    if not expression.is_rational_function(x):
        return None
    try:
        return read_input(expression.xreplace({sympy.pi: sympy.Symbol(PI)}), var=x.name).S
    except InputError:
        return None

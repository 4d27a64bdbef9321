"""int g dx for the integrands that variation of parameters meets, at once, without SymPy's integration.

- Products of powers and exponentials of rational functions (Ei, erf, gamma functions): `kovacic.closed_form.primitive`.
- Polynomials times exponentials and waves in x, log(x) or exp(k x): Y' for Y'' = g, by undetermined coefficients.
- Rational functions of exp(k x), or of s = sin(theta) and c = cos(theta), theta = w x + phi, by partial fractions in

      c if g is odd in s,    s if g is odd in c,    tan(theta) if g(-s, -c) = g(s, c),    tan(theta/2) otherwise.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy import cos, cot, csc, exp, log, sec, sin, tan
from sympy.simplify.fu import TR2i

from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, factors
from kovacic.closed_form.integrals import integral, logarithms
from kovacic.closed_form.product import product
from kovacic.errors import InputError
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.values import size
from kovacic.reading.given import EULER, PI
from kovacic.reading.read import read_input

Expr = Any  # SymPy publishes no types
#: The numbers that are parameters in coefficients.
NUMBERS = {sympy.Symbol(PI): sympy.pi, sympy.Symbol(EULER): sympy.E}


def antiderivative(integrand: Expr, x: Expr) -> Expr | None:
    """int g dx, None where a term isn't of one of these kinds.

    >>> x = sympy.Symbol("x")
    >>> antiderivative(tan(x) ** 2 + log(x), x)
    x*log(x) - 2*x + tan(x)
    """
    integrand, parts = prepared(integrand), []
    functions = {f.func for f in integrand.atoms(sympy.Function, sympy.Integral)}
    if not functions <= {exp, log, sin, cos}:
        return None
    if functions <= {exp} and (whole := _of_product(integrand, x)) is not None:
        return whole
    for term in sympy.Add.make_args(integrand):
        rules = (_by_coefficients, _in_logarithms, _in_exponentials, _in_waves, _of_product)
        part = next((found for rule in rules if (found := rule(term, x)) is not None), None)
        if part is None:
            return None
        parts.append(part)
    return sympy.Add(*parts)


def prepared(integrand: Expr) -> Expr:
    """Expanded, in sines and cosines."""
    if integrand.has(tan, cot, sec, csc):
        integrand = integrand.replace(tan, lambda a: sin(a) / cos(a)).replace(cot, lambda a: cos(a) / sin(a))
        integrand = integrand.replace(sec, lambda a: 1 / cos(a)).replace(csc, lambda a: 1 / sin(a))
    return sympy.expand(integrand)


def in_powers(expression: Expr, t: Expr, u: Expr) -> Expr:
    """For t = log(u), with powers of u for exponentials."""
    powers = expression.replace(exp, lambda e: u ** e.diff(t) * exp(e.subs(t, 0)))
    return powers.subs(t, log(u))


def _by_coefficients(term: Expr, x: Expr) -> Expr | None:
    found = undetermined(sympy.Integer(0), sympy.Integer(0), term, x)
    return None if found is None else sympy.expand(found.diff(x))


def _in_logarithms(term: Expr, x: Expr) -> Expr | None:
    if not term.has(log):
        return None
    t = sympy.Dummy(real=True)
    found = _by_coefficients(term.subs(x, exp(t)) * exp(t), t)
    return None if found is None else in_powers(found, t, x)


def _in_exponentials(term: Expr, x: Expr) -> Expr | None:
    """In u = exp(k x), for which x is written."""
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
            known = {sympy.atan(u): angle, log(u**2 + 1): -2 * log(cos(angle)), u**2 + 1: cos(angle) ** -2}
            found = found.xreplace({x: u}).xreplace(known if back.func is tan else {})
            done.append(TR2i(found.xreplace({u: sin(angle) / cos(angle) if back.func is tan else back})))
    return min(done, key=size, default=None)


def _of_product(term: Expr, x: Expr) -> Expr | None:
    rate = None if term.has(sin, cos, log) else _rate(term, x)
    if rate is None:
        return None
    atoms, h = Atoms(x), product(rate)
    scale, shown = factors(h, atoms)
    ratio, found = term / (scale * sympy.Mul(*shown)), integral(h, atoms)
    constant = next((c for c in (sympy.powsimp(ratio.subs(x, k)) for k in (2, 3, 5)) if c.is_finite and c != 0), None)
    return None if found is None or constant is None else sympy.expand(constant * found)


def _rate(term: Expr, x: Expr) -> RatFunc | None:
    """The logarithmic derivative, where it is rational; that of t (1 + u/t + ...) for a sum t + u + ..."""
    first, *rest = sympy.Add.make_args(term)
    rate = sympy.Integer(0)
    for factor in sympy.Mul.make_args(first):
        base, exponent = factor.as_base_exp()
        rate += exponent.diff(x) * log(base) if not base.has(x) else exponent * base.diff(x) / base
    found, ratio = ratfunc(rate, x), ratfunc(sympy.Add(1, *(other / first for other in rest)), x) if rest else None
    if found is None or not rest:
        return found
    return None if ratio is None else found + ratio.derivative() / ratio


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

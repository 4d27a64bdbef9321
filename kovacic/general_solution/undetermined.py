"""y'' + b y' + c y = sum of polynomials times exp(rho x) cos(omega x) and sin(omega x), by undetermined coefficients.

p cos(omega x) + q sin(omega x) is the real part of (p - i q) exp(i omega x), for a symbol i whatever p, q, omega are.  With
lambda = rho + i omega, y = Q exp(lambda x) is a solution for the right-hand side P exp(lambda x) if

    Q'' + (2 lambda + b) Q' + (lambda^2 + b lambda + c) Q = P,                                                      (1)

which gives the coefficients of Q from the highest one down, divided by the first of the three factors that isn't 0: in
resonance Q has a degree one or two higher, and no part that solves the homogeneous equation.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import perm
from typing import Any

import sympy
from sympy import cos, cosh, sin, sinh
from sympy.simplify.fu import TR8

from kovacic.general_solution.substitution import size

Expr = Any  # SymPy publishes no types
Pair = tuple[Expr, Expr]  # u + i v
#: The largest degree of a polynomial, and number of terms, that is solved for.
_LARGEST = 200


def undetermined(b: Expr, c: Expr, right: Expr, x: Expr) -> Expr | None:
    """A solution of y'' + b y' + c y = right for constants b and c; None if the right-hand side has another form.

    >>> x = sympy.Symbol("x")
    >>> undetermined(0, 1, sin(x), x)
    -x*cos(x)/2
    """
    terms = _terms(right, x)
    if terms is None:
        return None
    total = []
    for (rate, frequency), P in terms.items():
        Q = _solved(b, c, rate, frequency, P)
        if Q is None:
            return None
        A = sympy.Add(*(u * x**k for k, (u, _) in Q.items()))
        B = sympy.Add(*(v * x**k for k, (_, v) in Q.items()))
        total.append(sympy.exp(rate * x) * _wave(A, B, frequency * x))
    return sympy.Add(*total)


def _wave(A: Expr, B: Expr, angle: Expr) -> Expr:
    """A cos(angle) - B sin(angle): a term each, or over one denominator where that has parameters and is shorter.

    >>> a, b, t = sympy.symbols("a b t")
    >>> _wave(a / (a**2 + b**2), -b / (a**2 + b**2), t)
    (a*cos(t) + b*sin(t))/(a**2 + b**2)
    """
    expanded = sympy.expand_mul(A * cos(angle) - B * sin(angle))
    denominators = [sympy.denom(sympy.together(part)) for part in (A, B)]
    common = sympy.lcm(*denominators)
    if not common.free_symbols or not common.is_polynomial():
        return expanded
    numerators = [sympy.cancel(part * common) for part in (A, -B)]
    shared = sympy.gcd(*numerators)
    if shared == 0:
        return expanded
    first, second = (sympy.cancel(part / shared) for part in numerators)
    joined = sympy.factor(shared / common) * (first * cos(angle) + second * sin(angle))
    return min(expanded, joined, key=size)


@dataclass(frozen=True)
class _ForcingTerm:
    """(u + i v) x^degree exp((rate + i frequency) x), of which the real part is meant."""

    degree: int
    rate: Expr
    frequency: Expr
    u: Expr
    v: Expr


def _terms(right: Expr, x: Expr) -> dict[Pair, dict[int, Pair]] | None:
    """{(rho, omega): {k: the coefficient of x^k exp((rho + i omega) x)}}; a real part is meant."""
    if not all(map(_is_natural, _exponents(right, x))):
        return None  # before it is expanded
    right = sympy.expand(right.rewrite((sinh, cosh), sympy.exp))
    if right.has(sin, cos):
        right = sympy.expand(TR8(right))  # powers and products of waves become waves
    result: dict[Pair, dict[int, Pair]] = {}
    if right == 0:
        return result
    summands = sympy.Add.make_args(right)
    if len(summands) > _LARGEST:
        return None
    for summand in summands:
        term = _term(summand, x)
        if term is None:
            return None
        P = result.setdefault((term.rate, term.frequency), {})
        u, v = P.get(term.degree, (0, 0))
        P[term.degree] = (u + term.u, v + term.v)
    return result


def _exponents(e: Expr, x: Expr) -> list[Expr]:
    """Those of the powers of functions of x."""
    return [power.exp for power in e.atoms(sympy.Pow) if power.base.has(x)]


def _is_natural(exponent: Expr) -> bool:
    return bool(exponent.is_Integer and exponent > 0)


def _term(summand: Expr, x: Expr) -> _ForcingTerm | None:
    """A product of a constant, powers of x, exponentials and one wave."""
    constant, rest = summand.as_independent(x, as_Add=False)
    factors = sympy.Mul.make_args(rest)
    waves = [factor for factor in factors if factor.func in (sin, cos)]
    if len(waves) > 1:
        return None
    degree = 0
    rate = sympy.Integer(0)
    for factor in factors:
        base, exponent = factor.as_base_exp()
        if factor in waves:
            continue
        if base == x and exponent.is_Integer and 0 <= exponent <= _LARGEST:
            degree += int(exponent)
            continue
        line = _line(exponent, x)
        if base.has(x) or line is None:
            return None
        constant *= base ** line[0]
        rate += line[1] * sympy.log(base)
    plain = _ForcingTerm(degree, rate, sympy.Integer(0), constant, sympy.Integer(0))
    if not waves:
        return plain
    return _times_wave(plain, waves[0], x)


def _times_wave(term: _ForcingTerm, wave: Expr, x: Expr) -> _ForcingTerm | None:
    """A term without a frequency times cos(phase + frequency x), or sin, as the real part of one with a frequency."""
    line = _line(wave.args[0], x)
    if line is None:
        return None
    phase, frequency = line
    real = term.u * cos(phase)
    imaginary = term.u * sin(phase)
    if wave.func is sin:  # the same, an angle of pi/2 before
        real = term.u * sin(phase)
        imaginary = -term.u * cos(phase)
    if frequency.could_extract_minus_sign():
        return _ForcingTerm(term.degree, term.rate, -frequency, real, -imaginary)
    return _ForcingTerm(term.degree, term.rate, frequency, real, imaginary)


def _line(expression: Expr, x: Expr) -> Pair | None:
    """(d, e) for d + e x, None for another expression."""
    rest, linear = sympy.expand(expression).as_independent(x, as_Add=True)
    slope = sympy.Add(*(term / x for term in sympy.Add.make_args(linear)))
    if slope.has(x):
        return None
    return rest, slope


def _solved(b: Expr, c: Expr, rate: Expr, frequency: Expr, P: dict[int, Pair]) -> dict[int, Pair] | None:
    """Q of equation (1); None where u^2 + v^2 = 0 for a factor u + i v other than 0."""
    factors = [
        (_constant(rate**2 - frequency**2 + b * rate + c), _constant((2 * rate + b) * frequency)),
        (_constant(2 * rate + b), 2 * frequency),
        (sympy.Integer(1), sympy.Integer(0)),
    ]
    m = next(k for k, factor in enumerate(factors) if factor != (0, 0))
    f, g = factors[m]
    norm = _constant(f**2 + g**2)
    if norm == 0:
        return None
    Q: dict[int, Pair] = {}
    for n in range(max(P), -1, -1):
        u, v = P.get(n, (0, 0))
        for j in range(m + 1, 3):
            product = _product(factors[j], Q.get(n + j, (0, 0)))
            u -= perm(n + j, j) * product[0]
            v -= perm(n + j, j) * product[1]
        scale = norm * perm(n + m, m)  # (u + i v)/(f + i g) = (u + i v) (f - i g)/norm
        real, imaginary = _product((u, v), (f, -g))
        Q[n + m] = (_constant(real / scale), _constant(imaginary / scale))
    return Q


def _product(first: Pair, second: Pair) -> Pair:
    """(f + i g) (r + i s)."""
    f, g = first
    r, s = second
    return f * r - g * s, f * s + g * r


def _constant(value: Expr) -> Expr:
    """In a form that shows whether it is zero."""
    value = sympy.sympify(value, strict=True)
    if value.is_Rational:
        return value
    value = sympy.radsimp(sympy.cancel(sympy.expand(value)))
    if value.is_number and value.equals(0):
        return sympy.Integer(0)
    return value

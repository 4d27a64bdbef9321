"""y'' + b y' + c y = sum of polynomials times exp(rho x) cos(omega x) and sin(omega x), by undetermined coefficients.

p cos(omega x) + q sin(omega x) is the real part of (p - i q) exp(i omega x), for a symbol i whatever p, q, omega are.  With
lambda = rho + i omega, y = Q exp(lambda x) is a solution for the right-hand side P exp(lambda x) if

    Q'' + (2 lambda + b) Q' + (lambda^2 + b lambda + c) Q = P,                                                      (1)

which gives the coefficients of Q from the highest one down, divided by the first of the three factors that isn't 0: in
resonance Q has a degree one or two higher, and no part that solves the homogeneous equation.  u + i v is the pair (u, v),
with letters for u and v as well.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from math import perm
from typing import Any

import sympy
from sympy import cos, cosh, sin, sinh

from kovacic.general_solution.substitution import in_single_waves, size

Expr = Any  # SymPy publishes no types
Complex = tuple[Expr, Expr]
#: The largest degree of a polynomial, and number of terms, that is solved for.
_LARGEST = 200
_ZERO, _ONE = (sympy.S.Zero, sympy.S.Zero), (sympy.S.One, sympy.S.Zero)


def _product(first: Complex, second: Complex) -> Complex:
    (a, b), (u, v) = first, second
    return a * u - b * v, a * v + b * u


def undetermined(b: Expr, c: Expr, right: Expr, x: Expr) -> Expr | None:
    """A solution of y'' + b y' + c y = right for constants b and c; None if the right-hand side has another form.

    >>> x = sympy.Symbol("x")
    >>> undetermined(0, 1, sin(x), x)
    -x*cos(x)/2
    """
    polynomials = _polynomials(right, x)
    if polynomials is None:
        return None
    total = []
    for (rho, omega), P in polynomials.items():
        Q = _solved(b, c, (rho, omega), P)
        if Q is None:
            return None
        A, B = (sympy.Add(*(coefficient[part] * x**k for k, coefficient in Q.items())) for part in (0, 1))
        total.append(sympy.powdenest(sympy.exp(rho * x)) * _wave_terms(A, B, omega * x))
    return sympy.Add(*total)


def _wave_terms(A: Expr, B: Expr, angle: Expr) -> Expr:
    """A cos(angle) - B sin(angle): a term each, or over one denominator where that has parameters and is shorter.

    >>> a, b, t = sympy.symbols("a b t")
    >>> _wave_terms(a / (a**2 + b**2), -b / (a**2 + b**2), t)
    (a*cos(t) + b*sin(t))/(a**2 + b**2)
    """
    expanded = sympy.expand_mul(A * cos(angle) - B * sin(angle))
    if A.is_polynomial() and B.is_polynomial():
        return expanded
    denominators = [sympy.denom(sympy.together(part)) for part in (A, B)]
    common = sympy.lcm(*denominators)
    if not common.free_symbols or not common.is_polynomial():
        return expanded
    numerators = [sympy.cancel(part * common) for part in (A, -B)]
    shared = sympy.gcd(*numerators)
    first, second = (sympy.cancel(part / shared) for part in numerators)
    joined = sympy.factor(shared / common) * (first * cos(angle) + second * sin(angle))
    return min(expanded, joined, key=size)


def _polynomials(right: Expr, x: Expr) -> dict[Complex, dict[int, Complex]] | None:
    """By the rates (rho, omega) the coefficients of x^k in the P beside exp((rho + i omega) x); a real part is meant.

    None for another right-hand side.
    """
    summands = _summands(right, x)
    if summands is None:
        return None
    result: dict[Complex, dict[int, Complex]] = {}
    for summand in summands:
        number, rest = summand.as_independent(x, as_Add=False)
        coefficient: Complex = (number, sympy.S.Zero)
        degree = 0
        rho = omega = sympy.Integer(0)
        for factor in sympy.Mul.make_args(rest):
            base, exponent = factor.as_base_exp()
            is_wave = factor.func in (sin, cos)
            constant, slope = _line(factor.args[0] if is_wave else exponent, x)
            if base == x and exponent.is_Integer and 0 <= exponent <= _LARGEST:
                degree += int(exponent)
            elif slope.has(x):
                return None
            elif is_wave and omega == 0:
                omega = slope
                # the sine is the cosine of an angle that is pi/2 less
                c, s = cos(constant), sin(constant)
                coefficient = _product(coefficient, (c, s) if factor.func is cos else (s, -c))
            elif not base.has(x):
                coefficient = _product(coefficient, (base**constant, sympy.S.Zero))
                rho += slope * sympy.log(base)
            else:
                return None
        P = result.setdefault((rho, omega), defaultdict(lambda: _ZERO))
        P[degree] = (P[degree][0] + coefficient[0], P[degree][1] + coefficient[1])
    return result


def _summands(right: Expr, x: Expr) -> Sequence[Expr] | None:
    """Products with one wave at most; none of 0.  None if powers of functions of x aren't natural, or there are too many."""
    exponents = [power.exp for power in right.atoms(sympy.Pow) if power.base.has(x)]
    if not all(exponent.is_Integer and exponent > 0 for exponent in exponents):
        return None  # before it is expanded
    right = sympy.expand(right.rewrite((sinh, cosh), sympy.exp))
    if right.has(sin, cos):
        right = in_single_waves(right)
    summands: tuple[Expr, ...] = sympy.Add.make_args(right) if right != 0 else ()
    return summands if len(summands) <= _LARGEST else None


def _line(expression: Expr, x: Expr) -> tuple[Expr, Expr]:
    """p and q of p + q x, where q has x if the expression is no line."""
    constant, linear = sympy.expand(expression).as_independent(x, as_Add=True)
    return constant, sympy.Add(*(term / x for term in sympy.Add.make_args(linear)))


def _solved(b: Expr, c: Expr, rate: Complex, P: dict[int, Complex]) -> dict[int, Complex] | None:
    """Q of equation (1); None if u^2 + v^2 = 0 for a factor u + i v other than 0."""
    rho, omega = rate
    squared = rho**2 - omega**2 + b * rho + c, (2 * rho + b) * omega
    factors = [(_constant(u), _constant(v)) for u, v in (squared, (2 * rho + b, 2 * omega), _ONE)]
    m = next(k for k, factor in enumerate(factors) if factor != _ZERO)
    u, v = factors[m]
    norm = _constant(u**2 + v**2)
    if norm == 0:
        return None
    Q: dict[int, Complex] = defaultdict(lambda: _ZERO)
    for n in range(max(P), -1, -1):
        products = [(perm(n + j, j), _product(factors[j], Q[n + j])) for j in range(m + 1, 3)]
        rest = [P[n][part] - sympy.Add(*(k * product[part] for k, product in products)) for part in (0, 1)]
        p, q = _product((u, -v), (rest[0], rest[1]))
        Q[n + m] = _constant(p / (norm * perm(n + m, m))), _constant(q / (norm * perm(n + m, m)))
    return Q


def _constant(value: Expr) -> Expr:
    """In a form that shows whether it is zero."""
    value = sympy.sympify(value, strict=True)
    if value.is_Rational:
        return value
    value = sympy.radsimp(sympy.cancel(sympy.expand(value)), symbolic=False)
    if value.is_number and value.equals(0):
        return sympy.Integer(0)
    return value

"""y'' + b y' + c y = sum of polynomials times exp(rho x) cos(omega x) and sin(omega x), by undetermined coefficients.

p cos(omega x) + q sin(omega x) is the real part of (p - i q) exp(i omega x), for a symbol i whatever p, q, omega are.  With
lambda = rho + i omega, y = Q exp(lambda x) is a solution for the right-hand side P exp(lambda x) if

    Q'' + (2 lambda + b) Q' + (lambda^2 + b lambda + c) Q = P,                                                      (1)

which gives the coefficients of Q from the highest one down, divided by the first of the three factors that isn't 0: in
resonance Q has a degree one or two higher, and no part that solves the homogeneous equation.
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
#: i
_I = sympy.Dummy("i")
#: The largest degree of a polynomial, and number of terms, that is solved for.
_LARGEST = 200


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
    for rate, P in polynomials.items():
        Q = _solved(b, c, rate, P)
        if Q is None:
            return None
        A, B = _parts(sympy.Add(*(coefficient * x**k for k, coefficient in Q.items())))
        rho, omega = _parts(rate)
        total.append(sympy.powdenest(sympy.exp(rho * x)) * _wave_terms(A, B, omega * x))
    return sympy.Add(*total)


def _parts(value: Expr) -> tuple[Expr, Expr]:
    """u and v of u + i v."""
    return value.xreplace({_I: sympy.S.Zero}), value.diff(_I)


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


def _polynomials(right: Expr, x: Expr) -> dict[Expr, dict[int, Expr]] | None:
    """By the rates rho + i omega the coefficients of x^k in the P beside exp((rho + i omega) x); a real part is meant.

    None for another right-hand side.
    """
    summands = _summands(right, x)
    if summands is None:
        return None
    result: dict[Expr, dict[int, Expr]] = defaultdict(lambda: defaultdict(lambda: sympy.S.Zero))
    for summand in summands:
        coefficient, rest = summand.as_independent(x, as_Add=False)
        degree = 0
        rate = sympy.S.Zero
        for factor in sympy.Mul.make_args(rest):
            base, exponent = factor.as_base_exp()
            is_wave = factor.func in (sin, cos)
            constant, slope = _line(factor.args[0] if is_wave else exponent, x)
            if base == x and exponent.is_Integer and 0 <= exponent <= _LARGEST:
                degree += int(exponent)
            elif slope.has(x) or (is_wave and rate.has(_I)) or (not is_wave and base.has(x)):
                return None
            elif is_wave:
                rate += _I * slope
                # the sine is the cosine of an angle that is pi/2 less
                c, s = cos(constant), sin(constant)
                coefficient *= c + _I * s if factor.func is cos else s - _I * c
            else:
                coefficient *= base**constant
                rate += slope * sympy.log(base)
        result[rate][degree] += coefficient
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


def _solved(b: Expr, c: Expr, rate: Expr, P: dict[int, Expr]) -> dict[int, Expr] | None:
    """Q of equation (1); None if u^2 + v^2 = 0 for a factor u + i v other than 0."""
    factors = [_constant(factor) for factor in (rate**2 + b * rate + c, 2 * rate + b, sympy.S.One)]
    m = next(k for k, factor in enumerate(factors) if factor != 0)
    conjugate = factors[m].xreplace({_I: -_I})
    norm = _constant(factors[m] * conjugate)
    if norm == 0:
        return None
    Q: dict[int, Expr] = defaultdict(lambda: sympy.S.Zero)
    for n in range(max(P), -1, -1):
        rest = P[n] - sympy.Add(*(perm(n + j, j) * factors[j] * Q[n + j] for j in range(m + 1, 3)))
        Q[n + m] = _constant(conjugate * rest / (norm * perm(n + m, m)))
    return Q


def _constant(value: Expr) -> Expr:
    """A product of three factors as u + i v, in forms that show whether u and v are zero."""
    expanded = sympy.expand(value)
    powers = [expanded.coeff(_I, k) for k in range(4)]
    u, v = (
        part if part.is_Rational else sympy.radsimp(sympy.cancel(part), symbolic=False)
        for part in (powers[0] - powers[2], powers[1] - powers[3])
    )
    u, v = (sympy.S.Zero if part.is_number and part.equals(0) else part for part in (u, v))
    return u + _I * v

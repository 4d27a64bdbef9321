"""y'' + b y' + c y = sum of polynomials times exp(rho x) cos(omega x) and sin(omega x), by undetermined coefficients.

p cos(omega x) + q sin(omega x) is the real part of (p - i q) exp(i omega x), for a symbol i whatever p, q, omega are.  With
lambda = rho + i omega, y = Q exp(lambda x) is a solution for the right-hand side P exp(lambda x) if

    Q'' + (2 lambda + b) Q' + (lambda^2 + b lambda + c) Q = P,                                                      (1)

which gives the coefficients of Q from the highest one down, divided by the first of the three factors that isn't 0: in
resonance Q has a degree one or two higher, and no part that solves the homogeneous equation.
"""

from __future__ import annotations

from collections import defaultdict
from math import perm
from typing import Any

import sympy
from sympy import Add, cancel, cos, cosh, expand, sin, sinh

from kovacic.general_solution.substitution import in_single_waves, size
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
#: i
_I = sympy.Dummy("i")


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
        Q = _response(b, c, rate, P)
        if Q is None:
            return None
        A, B = _real_and_imaginary(Add(*(coefficient * x**k for k, coefficient in Q.items())))
        rho, omega = _real_and_imaginary(rate)
        total.append(sympy.powdenest(sympy.exp(rho * x)) * _wave_terms(A, B, omega * x))
    return Add(*total)


def _real_and_imaginary(value: Expr) -> tuple[Expr, Expr]:
    """u and v for u + i v."""
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
    numerators = [cancel(part * common) for part in (A, -B)]
    shared = sympy.gcd(*numerators)
    first, second = (cancel(part / shared) for part in numerators)
    joined = sympy.factor(shared / common) * (first * cos(angle) + second * sin(angle))
    return min(expanded, joined, key=size)


def _polynomials(right: Expr, x: Expr) -> dict[Expr, dict[int, Expr]] | None:
    """For each rate lambda the coefficients of P by the powers of x, where the real part is meant; None for another form."""
    if not all(power.exp.is_Integer and power.exp > 0 for power in right.atoms(sympy.Pow) if power.base.has(x)):
        return None  # before it is expanded
    right = expand(right.rewrite((sinh, cosh), sympy.exp))
    if right.has(sin, cos):
        right = in_single_waves(right)
    result: dict[Expr, dict[int, Expr]] = defaultdict(lambda: defaultdict(lambda: sympy.S.Zero))
    for summand in Add.make_args(right) if right != 0 else ():
        coefficient, rest = summand.as_independent(x, as_Add=False)
        degree, rate = 0, sympy.S.Zero
        for factor in sympy.Mul.make_args(rest):
            base, exponent = factor.as_base_exp()
            if base == x and exponent.is_Integer:
                degree += int(exponent)
                continue
            is_wave = factor.func in (sin, cos)
            constant, linear = expand(factor.args[0] if is_wave else exponent).as_independent(x, as_Add=True)
            slope = expand(linear / x)
            if slope.has(x) or (rate.has(_I) if is_wave else base.has(x)):
                return None
            if is_wave:
                rate += _I * slope
                # the sine is the cosine of an angle that is pi/2 less
                c, s = cos(constant), sin(constant)
                coefficient *= c + _I * s if factor.func is cos else s - _I * c
            else:
                rate += slope * sympy.log(base)
                coefficient *= base**constant
        result[rate][degree] += coefficient
    return result


def _response(b: Expr, c: Expr, rate: Expr, P: dict[int, Expr]) -> dict[int, Expr] | None:
    """Q of equation (1); None if u^2 + v^2 = 0 for a factor u + i v other than 0."""
    factors = [_reduced(factor) for factor in (rate**2 + b * rate + c, 2 * rate + b, sympy.S.One)]
    m = next(k for k, factor in enumerate(factors) if factor != 0)
    conjugate = factors[m].xreplace({_I: -_I})
    norm = _reduced(factors[m] * conjugate)
    if norm == 0:
        return None
    Q: dict[int, Expr] = defaultdict(lambda: sympy.S.Zero)
    for n in range(max(P), -1, -1):
        check_time()
        rest = P[n] - Add(*(perm(n + j, j) * factors[j] * Q[n + j] for j in range(m + 1, 3)))
        Q[n + m] = _reduced(conjugate * rest / (norm * perm(n + m, m)))
    return Q


def _reduced(value: Expr) -> Expr:
    """A product of three factors as u + i v, in forms that show whether u and v are zero."""
    expanded = expand(value)
    powers = [expanded.coeff(_I, k) for k in range(4)]
    u, v = (
        part if part.is_Rational else sympy.radsimp(cancel(part), symbolic=False)
        for part in (powers[0] - powers[2], powers[1] - powers[3])
    )
    u, v = (sympy.S.Zero if part.is_number and part.equals(0) else part for part in (u, v))
    return u + _I * v

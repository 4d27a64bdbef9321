"""y'' + b y' + c y = sum of polynomials times exp(rho x) cos(omega x) and sin(omega x), by undetermined coefficients.

p cos(omega x) + q sin(omega x) is the real part of (p - i q) exp(i omega x), for a symbol i whatever p, q, omega are.  With
lambda = rho + i omega, y = Q exp(lambda x) is a solution for the right-hand side P exp(lambda x) if

    Q'' + (2 lambda + b) Q' + (lambda^2 + b lambda + c) Q = P,                                                      (1)

which gives the coefficients of Q from the highest one down, divided by the first of the three factors that isn't 0: in
resonance Q has a degree one or two higher, and no part that solves the homogeneous equation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import perm
from typing import Any, NamedTuple

import sympy
from sympy import cos, cosh, sin, sinh
from sympy.simplify.fu import TR8

from kovacic.general_solution.substitution import size

Expr = Any  # SymPy publishes no types
#: The largest degree of a polynomial, and number of terms, that is solved for.
_LARGEST = 200


class RealAndImaginary(NamedTuple):
    """u + i v."""

    u: Expr
    v: Expr

    def times(self, other: RealAndImaginary) -> RealAndImaginary:
        return RealAndImaginary(self.u * other.u - self.v * other.v, self.u * other.v + self.v * other.u)


class Rate(NamedTuple):
    """rho + i omega, of exp((rho + i omega) x)."""

    rho: Expr
    omega: Expr


#: The coefficients of a polynomial, by the powers of x.
Coefficients = dict[int, RealAndImaginary]
_NOTHING = RealAndImaginary(0, 0)


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
        Q = _solved(_factors(b, c, rate), P)
        if Q is None:
            return None
        A = sympy.Add(*(coefficient.u * x**k for k, coefficient in Q.items()))
        B = sympy.Add(*(coefficient.v * x**k for k, coefficient in Q.items()))
        total.append(sympy.exp(rate.rho * x) * _wave(A, B, rate.omega * x))
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
    """coefficient * x^degree * exp(rate x), of which the real part is meant."""

    degree: int
    rate: Rate
    coefficient: RealAndImaginary


def _polynomials(right: Expr, x: Expr) -> dict[Rate, Coefficients] | None:
    """The P beside each exp((rho + i omega) x); a real part is meant.  None for another right-hand side."""
    summands = _summands(right, x)
    if summands is None:
        return None
    result: dict[Rate, Coefficients] = {}
    for summand in summands:
        term = _term(summand, x)
        if term is None:
            return None
        P = result.setdefault(term.rate, {})
        known = P.get(term.degree, _NOTHING)
        P[term.degree] = RealAndImaginary(known.u + term.coefficient.u, known.v + term.coefficient.v)
    return result


def _summands(right: Expr, x: Expr) -> Sequence[Expr] | None:
    """Products with one wave at most; none of 0.  None where powers of functions of x aren't natural, or there are too many."""
    exponents = [power.exp for power in right.atoms(sympy.Pow) if power.base.has(x)]
    if not all(exponent.is_Integer and exponent > 0 for exponent in exponents):
        return None  # before it is expanded
    right = sympy.expand(right.rewrite((sinh, cosh), sympy.exp))
    if right.has(sin, cos):
        right = sympy.expand(TR8(right))  # powers and products of waves become waves
    if right == 0:
        return ()
    summands: tuple[Expr, ...] = sympy.Add.make_args(right)
    if len(summands) > _LARGEST:
        return None
    return summands


def _term(summand: Expr, x: Expr) -> _ForcingTerm | None:
    """A product of a constant, powers of x, exponentials and one wave; None for another one."""
    constant, rest = summand.as_independent(x, as_Add=False)
    factors = sympy.Mul.make_args(rest)
    waves = [factor for factor in factors if factor.func in (sin, cos)]
    if len(waves) > 1:
        return None
    term = _without_waves(constant, [factor for factor in factors if factor not in waves], x)
    if term is None or not waves:
        return term
    return _beside_wave(term, waves[0], x)


def _without_waves(constant: Expr, factors: Sequence[Expr], x: Expr) -> _ForcingTerm | None:
    """A constant times powers of x and exponentials c^(k x + d); None where there is another factor."""
    degree = 0
    rho = sympy.Integer(0)
    for factor in factors:
        base, exponent = factor.as_base_exp()
        if base == x and exponent.is_Integer and 0 <= exponent <= _LARGEST:
            degree += int(exponent)
            continue
        line = _line(exponent, x)
        if base.has(x) or line is None:
            return None
        constant *= base**line.constant
        rho += line.slope * sympy.log(base)
    nothing = sympy.Integer(0)
    return _ForcingTerm(degree, Rate(rho, nothing), RealAndImaginary(constant, nothing))


def _beside_wave(term: _ForcingTerm, wave: Expr, x: Expr) -> _ForcingTerm | None:
    """A term without a frequency, times cos(phase + omega x), or sin, as the real part of a term with one."""
    line = _line(wave.args[0], x)
    if line is None:
        return None
    phase = line.constant
    omega = line.slope
    constant = term.coefficient.u
    real = constant * cos(phase)
    imaginary = constant * sin(phase)
    if wave.func is sin:  # the same, an angle of pi/2 before
        real = constant * sin(phase)
        imaginary = -constant * cos(phase)
    rho = term.rate.rho
    if omega.could_extract_minus_sign():
        return _ForcingTerm(term.degree, Rate(rho, -omega), RealAndImaginary(real, -imaginary))
    return _ForcingTerm(term.degree, Rate(rho, omega), RealAndImaginary(real, imaginary))


class _Line(NamedTuple):
    """constant + slope * x."""

    constant: Expr
    slope: Expr


def _line(expression: Expr, x: Expr) -> _Line | None:
    """An expression as a line; None for another one."""
    rest, linear = sympy.expand(expression).as_independent(x, as_Add=True)
    slope = sympy.Add(*(term / x for term in sympy.Add.make_args(linear)))
    if slope.has(x):
        return None
    return _Line(rest, slope)


def _factors(b: Expr, c: Expr, rate: Rate) -> list[RealAndImaginary]:
    """Those of Q, Q' and Q'' in equation (1)."""
    rho, omega = rate
    return [
        RealAndImaginary(_constant(rho**2 - omega**2 + b * rho + c), _constant((2 * rho + b) * omega)),
        RealAndImaginary(_constant(2 * rho + b), 2 * omega),
        RealAndImaginary(sympy.Integer(1), sympy.Integer(0)),
    ]


def _solved(factors: Sequence[RealAndImaginary], P: Coefficients) -> Coefficients | None:
    """Q of equation (1); None where u^2 + v^2 = 0 for a factor u + i v other than 0."""
    m = next(k for k, factor in enumerate(factors) if factor != (0, 0))
    first = factors[m]
    norm = _constant(first.u**2 + first.v**2)
    if norm == 0:
        return None
    conjugate = RealAndImaginary(first.u, -first.v)
    Q: Coefficients = {}
    for n in range(max(P), -1, -1):
        rest = _without_known(P.get(n, _NOTHING), factors[m + 1 :], Q, n, m)
        scale = norm * perm(n + m, m)  # (u + i v)/(f + i g) = (u + i v) (f - i g)/norm
        above = rest.times(conjugate)
        Q[n + m] = RealAndImaginary(_constant(above.u / scale), _constant(above.v / scale))
    return Q


def _without_known(
    p: RealAndImaginary, later: Sequence[RealAndImaginary], Q: Coefficients, n: int, m: int
) -> RealAndImaginary:
    """The coefficient p of x^n in P without what the derivatives after the first one with a factor, the m-th, give."""
    u, v = p
    for j, factor in enumerate(later, m + 1):
        known = factor.times(Q.get(n + j, _NOTHING))
        u -= perm(n + j, j) * known.u
        v -= perm(n + j, j) * known.v
    return RealAndImaginary(u, v)


def _constant(value: Expr) -> Expr:
    """In a form that shows whether it is zero."""
    value = sympy.sympify(value, strict=True)
    if value.is_Rational:
        return value
    value = sympy.radsimp(sympy.cancel(sympy.expand(value)))
    if value.is_number and value.equals(0):
        return sympy.Integer(0)
    return value

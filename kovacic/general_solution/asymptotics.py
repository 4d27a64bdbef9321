"""How functions behave at 0, 1 and infinity: rules that give terms in elementary functions of z, and the size of the rest.

Of Gauss' function 2F1(a, b; c; 1 - w) the terms are in w.  At minus infinity the argument is -z.

Reference: DLMF 6.6, 6.12 (Ei, Si, Ci), 7.12 (erf), 9.7 (Airy), 10.2, 10.8, 10.25, 10.31, 10.17, 10.40 (Bessel), 13.7
(confluent), 15.8 (Gauss' function at 1).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import sympy
from sympy import Rational, exp, factorial, gamma, log, pi, polygamma, rf, sqrt

from kovacic.general_solution.expansion import UnknownBehaviour

Expr = Any  # SymPy publishes no types
_ONE = sympy.Integer(1)


class Asymptotic(NamedTuple):
    """What a rule says of a function: an expression in z, and expressions of the size of what is left out."""

    main: Expr
    errors: list[Expr]


#: (parameters, z, number of terms) -> the terms.
Rule = Callable[[Sequence[Any], Expr, int], Asymptotic]


def _bessel_series(nu: Expr, z: Expr, n: int, sign: int) -> Expr:
    """J (sign -1) or I (sign 1)."""
    terms = (Rational(sign) ** k * (z / 2) ** (2 * k + nu) / (factorial(k) * gamma(nu + k + 1)) for k in range(n))
    return sympy.Add(*terms)


def _first_kind(sign: int) -> Rule:
    def rule(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        (nu,) = parameters
        return Asymptotic(_bessel_series(nu, z, n, sign), [z ** (2 * n + nu)])

    return rule


def _second_kind(sign: int) -> Rule:
    """Y (sign -1) and K (sign 1), where nu is an integer, one that isn't known, and where it isn't."""

    def rule(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        (nu,) = parameters
        if not nu.is_integer:
            return _second_kind_of_noninteger(nu, z, n, sign)
        if nu.is_Integer and nu >= 0:
            return _second_kind_of_integer(int(nu), z, n, sign)
        return _first_term_of_second_kind(nu, z, sign)

    return rule


def _second_kind_of_noninteger(nu: Expr, z: Expr, n: int, sign: int) -> Asymptotic:
    """By J or I of the orders nu and -nu, DLMF 10.2.3 and 10.27.4."""
    plus = _bessel_series(nu, z, n, sign)
    minus = _bessel_series(-nu, z, n, sign)
    sine = sympy.sin(sympy.expand(nu * pi))
    errors = [z ** (2 * n + nu), z ** (2 * n - nu)]
    if sign < 0:
        return Asymptotic((sympy.cos(sympy.expand(nu * pi)) * plus - minus) / sine, errors)
    return Asymptotic(pi / 2 * (minus - plus) / sine, errors)


def _first_term_of_second_kind(nu: Expr, z: Expr, sign: int) -> Asymptotic:
    """DLMF 10.7.4 and 10.30.2."""
    first = (z / 2) ** (-nu) * gamma(nu)
    errors = [z ** (2 - nu), z**nu * log(z)]
    if sign < 0:
        return Asymptotic(-first / pi, errors)
    return Asymptotic(first / 2, errors)


def _second_kind_of_integer(nu: int, z: Expr, n: int, sign: int) -> Asymptotic:
    """A finite sum, a logarithm and a series, DLMF 10.8.1 and 10.31.1."""
    half = z / 2
    finite = []
    for k in range(min(nu, n + nu)):
        coefficient = Rational(-sign) ** k * factorial(nu - k - 1) / factorial(k)
        finite.append(coefficient * half ** (2 * k - nu))
    series = []
    for k in range(n):
        shift = polygamma(0, k + 1) + polygamma(0, nu + k + 1)
        series.append(shift * Rational(sign) ** k * half ** (2 * k + nu) / (factorial(k) * factorial(nu + k)))
    first = _bessel_series(sympy.Integer(nu), z, n, sign) * log(half)
    errors = [z ** (2 * n + nu) * log(z)]
    if sign < 0:
        return Asymptotic((2 * first - sympy.Add(*finite) - sympy.Add(*series)) / pi, errors)
    whole = (-1) ** nu * (-2 * first + sympy.Add(*series))
    return Asymptotic((sympy.Add(*finite) + whole) / 2, errors)


def _hyper_series(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    top, bottom = parameters
    terms = []
    for k in range(n):
        above = sympy.Mul(*(rf(a, k) for a in top))
        below = sympy.Mul(*(rf(b, k) for b in bottom))
        terms.append(above / below * z**k / factorial(k))
    return Asymptotic(sympy.Add(*terms), [z**n])


def _hyper_at_one(parameters: Sequence[Any], w: Expr, n: int) -> Asymptotic:
    """2F1(a, b; c; 1 - w): a polynomial, or by s = c - a - b."""
    top, bottom = parameters
    if len(top) != 2 or len(bottom) != 1:
        raise UnknownBehaviour("how a generalized hypergeometric function behaves at 1 isn't known")
    a, b = top
    (c,) = bottom
    if _is_natural(-a):
        return _polynomial_at_one(-a, b, c, w, n)
    if _is_natural(-b):
        return _polynomial_at_one(-b, a, c, w, n)
    s = sympy.expand(c - a - b)
    if not s.is_integer:
        return _two_series_at_one(a, b, c, w, n)
    if not s.is_Integer:
        raise UnknownBehaviour(f"whether {s} is positive isn't known")
    if s >= 0:
        return _logarithmic_at_one(a, b, int(s), w, n)
    main, errors = _logarithmic_at_one(c - a, c - b, int(-s), w, n)  # Euler's transformation
    return Asymptotic(w**s * main, [w**s * error for error in errors])


def _is_natural(N: Expr) -> bool:
    return bool(N.is_integer and N.is_nonnegative)


def _polynomial_at_one(N: Expr, b: Expr, c: Expr, w: Expr, n: int) -> Asymptotic:
    """2F1(-N, b; c; 1 - w) for a natural number N, DLMF 15.8.7."""
    s = sympy.expand(c + N - b)
    main, errors = _hyper_series(((-N, b), (sympy.expand(1 - s),)), w, n)
    return Asymptotic(_rising(sympy.expand(c - b), N) / _rising(c, N) * main, errors)


def _two_series_at_one(a: Expr, b: Expr, c: Expr, w: Expr, n: int) -> Asymptotic:
    """2F1(a, b; c; 1 - w) where s isn't an integer, DLMF 15.8.4."""
    s = sympy.expand(c - a - b)
    regular, _ = _hyper_series(((a, b), (1 - s,)), w, n)
    other, _ = _hyper_series(((c - a, c - b), (1 + s,)), w, n)
    first = gamma(c) * gamma(s) / (gamma(c - a) * gamma(c - b))
    second = gamma(c) * gamma(-s) / (gamma(a) * gamma(b))
    return Asymptotic(first * regular + second * w**s * other, [w**n, w ** (s + n)])


def _rising(x: Expr, N: Expr) -> Expr:
    """(x)_N, by factorials where x is an integer <= -N."""
    if N.is_Integer:
        return rf(x, N)
    if (-x).is_integer and (-x).is_nonnegative:
        return (-1) ** N * factorial(-x) / factorial(-x - N)
    return gamma(x + N) / gamma(x)


def _logarithmic_at_one(a: Expr, b: Expr, m: int, w: Expr, n: int) -> Asymptotic:
    """2F1(a, b; a + b + m; 1 - w) for m = 0, 1, 2, ..., DLMF 15.8.10."""
    finite = [
        rf(a, k) * rf(b, k) * factorial(m - k - 1) / factorial(k) * (-w) ** k / (gamma(a + m) * gamma(b + m))
        for k in range(m)
    ]
    infinite = []
    for k in range(n):
        shift = polygamma(0, k + 1) + polygamma(0, k + m + 1) - polygamma(0, a + k + m) - polygamma(0, b + k + m)
        coefficient = rf(a + m, k) * rf(b + m, k) / (factorial(k) * factorial(k + m))
        infinite.append(coefficient * w**k * (log(w) - shift))
    whole = (-w) ** m / (gamma(a) * gamma(b)) * sympy.Add(*infinite)
    return Asymptotic(gamma(a + b + m) * (sympy.Add(*finite) - whole), [w ** (m + n) * log(w)])


def _hankel(nu: Expr, k: int) -> Expr:
    """a_k(nu) of DLMF 10.17.1."""
    return sympy.Mul(*((4 * nu**2 - (2 * j - 1) ** 2) for j in range(1, k + 1))) / (factorial(k) * 8**k)


def _hankel_wave(nu: Expr, z: Expr, n: int, i: Expr) -> Expr:
    """Hankel's functions for i and -i, but for sqrt(2/(pi z)); DLMF 10.17.5 and 10.17.6."""
    total = sympy.Add(*(i**k * _hankel(nu, k) / z**k for k in range(n)))
    return exp(i * (z - nu * pi / 2 - pi / 4)) * total


def _waves(combine: Callable[[Expr, Expr], Expr]) -> Rule:
    """J and Y for large z, by Hankel's functions."""

    def rule(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        (nu,) = parameters
        up = _hankel_wave(nu, z, n, sympy.I)
        down = _hankel_wave(nu, z, n, -sympy.I)
        errors = [exp(i * z) * z ** (-n - Rational(1, 2)) for i in (sympy.I, -sympy.I)]
        return Asymptotic(sqrt(2 / (pi * z)) * combine(up, down), errors)

    return rule


def _growing(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """I for large z."""
    (nu,) = parameters
    total = sympy.Add(*((-1) ** k * _hankel(nu, k) / z**k for k in range(n)))
    return Asymptotic(exp(z) / sqrt(2 * pi * z) * total, [exp(z) * z ** (-n - Rational(1, 2))])


def _decaying(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """K for large z."""
    (nu,) = parameters
    total = sympy.Add(*(_hankel(nu, k) / z**k for k in range(n)))
    return Asymptotic(sqrt(pi / (2 * z)) * exp(-z) * total, [exp(-z) * z ** (-n - Rational(1, 2))])


def _airy(sign: int) -> Rule:
    """Ai (-1) and Bi (1), and their derivatives' order aside, for large z: the leading terms."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        zeta = 2 * z ** Rational(3, 2) / 3
        terms = []
        for k in range(n):
            u = sympy.Mul(*(2 * j + 1 for j in range(k, 3 * k))) / (sympy.Integer(216) ** k * factorial(k))
            terms.append(sign**k * u / zeta**k)
        before = exp(sign * zeta) * z ** Rational(-1, 4) / sqrt(pi)
        if sign < 0:
            before = before / 2
        return Asymptotic(before * sympy.Add(*terms), [exp(sign * zeta) * z ** (Rational(-1, 4) - Rational(3, 2) * n)])

    return rule


def _oscillating_airy(shift: Expr) -> Rule:
    """Ai(-z) and Bi(-z) for large z: the leading terms."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        zeta = 2 * z ** Rational(3, 2) / 3
        errors = [exp(sign * sympy.I * zeta) * z ** Rational(-7, 4) for sign in (1, -1)]
        return Asymptotic(z ** Rational(-1, 4) / sqrt(pi) * sympy.cos(zeta + shift), errors)

    return rule


def _confluent_at_infinity(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """1F1(a; b; z) for large z: exp(z) z^(a - b), and what is O(z^(-a)) beside."""
    a, b = _one_and_one(parameters)
    total = sympy.Add(*(rf(1 - a, k) * rf(b - a, k) / (factorial(k) * z**k) for k in range(n)))
    main = gamma(b) / gamma(a) * exp(z) * z ** (a - b) * total
    return Asymptotic(main, [exp(z) * z ** (a - b - n), z ** (-a)])


def _confluent_at_minus_infinity(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """1F1(a; b; -z) = exp(-z) 1F1(b - a; b; z)."""
    a, b = _one_and_one(parameters)
    main, errors = _confluent_at_infinity(((sympy.expand(b - a),), (b,)), z, n)
    return Asymptotic(sympy.expand_mul(exp(-z) * main), [sympy.expand_mul(exp(-z) * error) for error in errors])


def _tricomi(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """2F0(a, b; -z) for large z: w^a U(a, c, w), w = 1/z, c = a - b + 1; DLMF 13.2.9 and 13.2.42."""
    top, bottom = parameters
    if len(top) != 2 or bottom:
        raise UnknownBehaviour("how the hypergeometric function behaves at infinity isn't known")
    a, b = top
    c = sympy.expand(a - b + 1)
    if c.is_Integer and c <= 0:  # the function is symmetric in a and b
        return _tricomi(((b, a), ()), z, n)
    w = 1 / z
    if not c.is_integer:
        first, _ = _hyper_series(((a,), (c,)), w, n)
        second, _ = _hyper_series(((a - c + 1,), (2 - c,)), w, n)
        main = gamma(1 - c) / gamma(a - c + 1) * first + gamma(c - 1) / gamma(a) * w ** (1 - c) * second
        return Asymptotic(w**a * main, [w ** (a + n), w ** (a + 1 - c + n)])
    if not c.is_Integer:
        raise UnknownBehaviour(f"whether {c} is positive isn't known")
    return _tricomi_of_integer(a, int(c) - 1, w, n)


def _tricomi_of_integer(a: Expr, m: int, w: Expr, n: int) -> Asymptotic:
    """w^a U(a, m + 1, w) for m = 0, 1, 2, ...; DLMF 13.2.9."""
    terms = []
    for k in range(n):
        shift = polygamma(0, a + k) - polygamma(0, k + 1) - polygamma(0, m + k + 1)
        terms.append(rf(a, k) / (rf(m + 1, k) * factorial(k)) * w**k * (log(w) + shift))
    finite = [factorial(k - 1) * rf(1 - a + k, m - k) / factorial(m - k) * w**-k for k in range(1, m + 1)]
    whole = Rational(-1) ** (m + 1) / (factorial(m) * gamma(a - m)) * sympy.Add(*terms)
    return Asymptotic(w**a * (whole + sympy.Add(*finite) / gamma(a)), [w ** (a + n) * log(w)])


def _tricomi_on_the_cut(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """2F0(a, b; z) for large z, where log(-1/z) has two values: what both have in common."""
    main, errors = _tricomi(parameters, z, n)
    a, b = parameters[0]
    leading = [*errors, z ** (-sympy.expand(a)), z ** (-sympy.expand(b))]
    return Asymptotic(main, leading)


def _hyper_at_infinity(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """1F1, or 2F0 where there is no parameter below."""
    if parameters[1]:
        return _confluent_at_infinity(parameters, z, n)
    return _tricomi_on_the_cut(parameters, z, n)


def _hyper_at_minus_infinity(parameters: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    """1F1, or 2F0 where there is no parameter below."""
    if parameters[1]:
        return _confluent_at_minus_infinity(parameters, z, n)
    return _tricomi(parameters, z, n)


def _one_and_one(parameters: Sequence[Any]) -> tuple[Expr, Expr]:
    """a and b of 1F1(a; b; z).  Raises `UnknownBehaviour` for another function."""
    top, bottom = parameters
    if len(top) != 1 or len(bottom) != 1:
        raise UnknownBehaviour("how the hypergeometric function behaves at infinity isn't known")
    return top[0], bottom[0]


def _exponential_integral(sign: int) -> Rule:
    """Ei at 0: gamma + log|z| + ..."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        terms = (z**k / (k * factorial(k)) for k in range(1, n))
        return Asymptotic(sympy.EulerGamma + log(sign * z) + sympy.Add(*terms), [z**n])

    return rule


def _sine_integral(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    terms = ((-1) ** k * z ** (2 * k + 1) / ((2 * k + 1) * factorial(2 * k + 1)) for k in range(n))
    return Asymptotic(sympy.Add(*terms), [z ** (2 * n + 1)])


def _cosine_integral(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    terms = ((-1) ** k * z ** (2 * k) / (2 * k * factorial(2 * k)) for k in range(1, n))
    return Asymptotic(sympy.EulerGamma + log(z) + sympy.Add(*terms), [z ** (2 * n)])


def _sine_integral_at_infinity(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    errors = [exp(sign * sympy.I * z) * z**-3 for sign in (1, -1)]
    return Asymptotic(pi / 2 - sympy.cos(z) / z - sympy.sin(z) / z**2, errors)


def _cosine_integral_at_infinity(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
    errors = [exp(sign * sympy.I * z) * z**-3 for sign in (1, -1)]
    return Asymptotic(sympy.sin(z) / z - sympy.cos(z) / z**2, errors)


def _error_function(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        terms = (Rational(-1, 2) ** k * sympy.factorial2(2 * k - 1) / z ** (2 * k + 1) for k in range(n))
        return Asymptotic(sign * (1 - exp(-(z**2)) / sqrt(pi) * sympy.Add(*terms)), [exp(-(z**2)) * z ** (-2 * n - 1)])

    return rule


def _imaginary_error_function(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        terms = (Rational(1, 2) ** k * sympy.factorial2(2 * k - 1) / z ** (2 * k + 1) for k in range(n))
        return Asymptotic(sign * exp(z**2) / sqrt(pi) * sympy.Add(*terms), [exp(z**2) * z ** (-2 * n - 1), _ONE])

    return rule


def _exponential_integral_at_infinity(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        main = exp(sign * z) * sympy.Add(*(factorial(k) / (sign * z) ** (k + 1) for k in range(n)))
        errors = [exp(sign * z) * z ** (-n - 1)]
        if sign > 0:  # beside what grows, a constant
            errors.append(_ONE)
        return Asymptotic(main, errors)

    return rule


def _arc(sign: int) -> Rule:
    """atan at infinity."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> Asymptotic:
        return Asymptotic(sign * (pi / 2 - sympy.atan(1 / z)), [])

    return rule


AT_ZERO: dict[Any, Rule] = {
    sympy.besselj: _first_kind(-1),
    sympy.besseli: _first_kind(1),
    sympy.bessely: _second_kind(-1),
    sympy.besselk: _second_kind(1),
    sympy.hyper: _hyper_series,
    sympy.Ei: _exponential_integral(1),
    sympy.Si: _sine_integral,
    sympy.Ci: _cosine_integral,
}
BELOW_ZERO: dict[Any, Rule] = {sympy.Ei: _exponential_integral(-1)}
AT_ONE: dict[Any, Rule] = {sympy.hyper: _hyper_at_one}
AT_INFINITY: dict[Any, Rule] = {
    sympy.atan: _arc(1),
    sympy.besselj: _waves(lambda up, down: (up + down) / 2),
    sympy.bessely: _waves(lambda up, down: (up - down) / (2 * sympy.I)),
    sympy.besseli: _growing,
    sympy.besselk: _decaying,
    sympy.airyai: _airy(-1),
    sympy.airybi: _airy(1),
    sympy.hyper: _hyper_at_infinity,
    sympy.Si: _sine_integral_at_infinity,
    sympy.Ci: _cosine_integral_at_infinity,
    sympy.erf: _error_function(1),
    sympy.erfi: _imaginary_error_function(1),
    sympy.Ei: _exponential_integral_at_infinity(1),
}
AT_MINUS_INFINITY: dict[Any, Rule] = {
    sympy.atan: _arc(-1),
    sympy.airyai: _oscillating_airy(-pi / 4),
    sympy.airybi: _oscillating_airy(pi / 4),
    sympy.hyper: _hyper_at_minus_infinity,
    sympy.erf: _error_function(-1),
    sympy.erfi: _imaginary_error_function(-1),
    sympy.Ei: _exponential_integral_at_infinity(-1),
}

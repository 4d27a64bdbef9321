"""The behaviour of solutions, SymPy expressions, near a point: the expansion of each function where it isn't analytic.

A rule gives, for a function of z where z tends to 0, to 1 or to infinity, an expression in elementary functions of z and the
errors beside it.  Functions without a rule, and integrals that aren't done, aren't known.

Reference: DLMF 6.6, 6.12 (Ei, Si, Ci), 7.12 (erf), 9.7 (Airy), 10.2, 10.8, 10.25, 10.31, 10.17, 10.40 (Bessel), 13.7
(confluent), 15.8 (Gauss' function at 1).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy
from sympy import Rational, exp, factorial, gamma, log, pi, polygamma, rf, sqrt

from kovacic.closed_form.jets import rewritten
from kovacic.general_solution.expansion import CONSTANT, Expansion, ExpansionTerm, UnknownBehaviour

Expr = Any  # SymPy publishes no types
_ONE = sympy.Integer(1)
_ZERO = sympy.Integer(0)
_HYPERBOLIC = (sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch)
_QUOTIENTS = (sympy.tan, sympy.cot, sympy.sec, sympy.csc)
#: Numbers of terms that are tried, one after the other.
_DEPTHS = (4, 8, 16)


@dataclass(frozen=True)
class Approach:
    """x = point + direction * t, or direction/t for infinite points; t > 0 tends to 0."""

    point: Expr
    direction: int = 1

    @property
    def is_infinite(self) -> bool:
        return self.point in (sympy.oo, -sympy.oo)

    def in_terms_of(self, t: Expr) -> Expr:
        if self.point == sympy.oo:
            return 1 / t
        if self.point == -sympy.oo:
            return -1 / t
        return self.point + self.direction * t


def behaviour(expression: Expr, x: Expr, place: Approach) -> Expansion:
    """The expansion, up to errors that tend to 0 where as many terms show that.

    Raises `UnknownBehaviour`.

    >>> x = sympy.Symbol("x")
    >>> found = behaviour((1 - sympy.cos(x)) / x**2 + log(x), x, Approach(_ZERO))
    >>> found.terms[CONSTANT], found.terms[ExpansionTerm(k=1)]
    (1/2, 1)
    """
    t = sympy.Dummy("t", positive=True)
    inner = sympy.sympify(expression, strict=True).xreplace({x: place.in_terms_of(t)})
    found = None
    for depth in _DEPTHS:
        try:
            found = _Expander(t, depth)(inner)
        except UnknownBehaviour as unknown:
            if not unknown.deeper or depth == _DEPTHS[-1]:
                raise
            continue
        if _is_enough(found):
            break
    assert found is not None
    return found


def _is_enough(found: Expansion) -> bool:
    try:
        return all(error.size < 0 for error in found.errors)
    except UnknownBehaviour:
        return True  # more terms don't tell


class _Expander:
    """Expands expressions in t; what was expanded is kept."""

    def __init__(self, t: Expr, depth: int) -> None:
        self.depth = depth
        self.known: dict[Expr, Expansion] = {t: Expansion({ExpansionTerm(e=_ONE): _ONE})}
        self.variables = {t}  # t, and what stands for functions of t

    def __call__(self, e: Expr) -> Expansion:
        found = self.known.get(e)
        if found is None:
            found = self.known[e] = self._expanded(e)
        return found

    def _expanded(self, e: Expr) -> Expansion:
        if not e.free_symbols & self.variables:
            return Expansion.constant(e)
        if e.is_Add:
            total = Expansion({})
            for part in e.args:
                total = total + self(part)
            return total
        if e.is_Mul:
            total = Expansion.constant(_ONE)
            for part in e.args:
                total = total * self(part)
            return total
        if isinstance(e, exp):
            return self(e.args[0]).exp(self.depth)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, log):
            return self(e.args[0]).log(self.depth)
        return self._function(e)

    def _power(self, e: Expr) -> Expansion:
        if not e.exp.free_symbols & self.variables:
            return self(e.base).power(e.exp, self.depth)
        return self(e.exp * log(e.base)).exp(self.depth)

    def _function(self, e: Expr) -> Expansion:
        if isinstance(e, sympy.Heaviside):
            return Expansion.constant(_step_at(self(e.args[0])))
        if isinstance(e, sympy.DiracDelta):
            return Expansion({})
        if isinstance(e, _HYPERBOLIC):
            return self(e.rewrite(exp))
        if isinstance(e, _QUOTIENTS):
            return self(_as_quotient(e))
        plain = None if isinstance(e, sympy.acos | sympy.atanh) else rewritten(e)
        if plain is not None:
            return self(plain)
        inner = self._argument(e)
        found = None
        if not self._is_singular(e, inner):
            found = inner.taylor(lambda z: _with_argument(e, z), self.depth)
        if found is not None:
            return found
        if isinstance(e, sympy.sin | sympy.cos):
            return self(e.rewrite(exp))
        return self._by_rule(e, inner)

    def _is_singular(self, e: Expr, inner: Expansion) -> bool:
        """Is the argument at a singular point of the function, where SymPy has a name for the value?"""
        constant = inner.terms.get(CONSTANT, _ZERO)
        if constant == 0:
            return e.func in _AT_ZERO
        return constant == 1 and e.func in _AT_ONE

    def _argument(self, e: Expr) -> Expansion:
        """That of the last argument, the only one in which t occurs."""
        *parameters, last = e.args
        if isinstance(e, sympy.Integral | sympy.RootSum):
            raise _unknown(e)
        if any(p.free_symbols & self.variables for p in parameters):
            raise _unknown(e)
        return self(last)

    def _by_rule(self, e: Expr, inner: Expansion) -> Expansion:
        rules = _rules_near(e, inner)
        rule = rules.get(e.func)
        if rule is None:
            raise _unknown(e)
        if rules is _AT_MINUS_INFINITY:
            inner = inner.times(-_ONE)
        elif rules is _AT_ONE:
            inner = Expansion.constant(_ONE) + inner.times(-_ONE)
        z = sympy.Dummy("z", positive=True)
        *parameters, _ = e.args
        main, errors = rule(parameters, z, self.depth)
        self.known[z] = inner
        self.variables.add(z)
        total = self(main)
        rest: list[ExpansionTerm] = []
        for error in errors:
            beside = self(error)
            rest += [*beside.terms, *beside.errors]
        return total + Expansion({}, rest)


def _step_at(inner: Expansion) -> Expr:
    """H(u) close to the point, for the expansion of u: 1 or 0 by its sign there."""
    parts = inner.parts
    if parts.large or parts.constant == 0:
        first = inner.leading()
        m = first.monomial
        if m.growth or m.k:
            raise UnknownBehaviour("how a step behaves there isn't known")
        return sympy.Heaviside(first.coefficient)
    return sympy.Heaviside(parts.constant)


def _rules_near(e: Expr, inner: Expansion) -> Mapping[Any, Rule]:
    """The table for the point to which the argument of a function tends, and for the side."""
    parts = inner.parts
    if parts.large:
        return _rules_at_infinity(e, inner)
    if parts.constant == 1 and isinstance(e, sympy.hyper):
        return _AT_ONE
    if parts.constant != 0:
        raise _unknown(e)
    if e.func in _BELOW_ZERO and inner.leading().coefficient.is_negative:
        return _BELOW_ZERO
    return _AT_ZERO


def _rules_at_infinity(e: Expr, inner: Expansion) -> Mapping[Any, Rule]:
    """For an argument whose largest term is a real multiple of a power."""
    first = inner.leading()
    m = first.monomial
    is_real_power = not m.growth and not m.k and first.coefficient.is_real
    if not is_real_power:
        raise _unknown(e)
    if first.coefficient.is_positive:
        return _AT_INFINITY
    return _AT_MINUS_INFINITY


def _unknown(e: Expr) -> UnknownBehaviour:
    return UnknownBehaviour(f"how {e.func.__name__} behaves there isn't known")


def _as_quotient(e: Expr) -> Expr:
    u = e.args[0]
    return {
        sympy.tan: sympy.sin(u) / sympy.cos(u),
        sympy.cot: sympy.cos(u) / sympy.sin(u),
        sympy.sec: 1 / sympy.cos(u),
        sympy.csc: 1 / sympy.sin(u),
    }[e.func]


def _with_argument(e: Expr, z: Expr) -> Expr:
    return e.func(*e.args[:-1], z)


# ------------------------------------------------------------------------------------------------------------------ rules

#: (parameters, z, number of terms) -> an expression in z, and expressions of the size of what is left out.
Rule = Callable[[Sequence[Any], Expr, int], tuple[Expr, list[Expr]]]


def _bessel_series(nu: Expr, z: Expr, n: int, sign: int) -> Expr:
    """J (sign -1) or I (sign 1)."""
    terms = (Rational(sign) ** k * (z / 2) ** (2 * k + nu) / (factorial(k) * gamma(nu + k + 1)) for k in range(n))
    return sympy.Add(*terms)


def _first_kind(sign: int) -> Rule:
    def rule(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        (nu,) = parameters
        return _bessel_series(nu, z, n, sign), [z ** (2 * n + nu)]

    return rule


def _second_kind(sign: int) -> Rule:
    """Y (sign -1) and K (sign 1), where nu is an integer and where it isn't."""

    def rule(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        nu = parameters[0]
        if not nu.is_integer:
            plus = _bessel_series(nu, z, n, sign)
            minus = _bessel_series(-nu, z, n, sign)
            wave = sympy.sin(sympy.expand(nu * pi))
            errors = [z ** (2 * n + nu), z ** (2 * n - nu)]
            if sign < 0:
                return (sympy.cos(sympy.expand(nu * pi)) * plus - minus) / wave, errors
            return pi / 2 * (minus - plus) / wave, errors
        if not nu.is_Integer or nu < 0:
            factor = 2 if sign > 0 else -pi
            return (z / 2) ** (-nu) * gamma(nu) / factor, [z ** (2 - nu), z**nu * log(z)]
        return _second_kind_of_integer(int(nu), z, n, sign)

    return rule


def _second_kind_of_integer(nu: int, z: Expr, n: int, sign: int) -> tuple[Expr, list[Expr]]:
    half = z / 2
    finite = [
        Rational(-sign) ** k * factorial(nu - k - 1) / factorial(k) * half ** (2 * k - nu)
        for k in range(min(nu, n + nu))
    ]
    sums = [
        (polygamma(0, k + 1) + polygamma(0, nu + k + 1))
        * Rational(sign) ** k
        * half ** (2 * k + nu)
        / (factorial(k) * factorial(nu + k))
        for k in range(n)
    ]
    first = _bessel_series(sympy.Integer(nu), z, n, sign) * log(half)
    errors = [z ** (2 * n + nu) * log(z)]
    if sign < 0:
        return (2 * first - sympy.Add(*finite) - sympy.Add(*sums)) / pi, errors
    whole = (-1) ** nu * (-2 * first + sympy.Add(*sums))
    return (sympy.Add(*finite) + whole) / 2, errors


def _hyper_series(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    top, bottom = parameters
    terms = []
    for k in range(n):
        above = sympy.Mul(*(rf(a, k) for a in top))
        below = sympy.Mul(*(rf(b, k) for b in bottom))
        terms.append(above / below * z**k / factorial(k))
    return sympy.Add(*terms), [z**n]


def _hyper_at_one(parameters: Sequence[Any], w: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """2F1(a, b; c; 1 - w): a polynomial, or by s = c - a - b."""
    top, bottom = parameters
    if len(top) != 2 or len(bottom) != 1:
        raise UnknownBehaviour("how a generalized hypergeometric function behaves at 1 isn't known")
    a, b = top
    (c,) = bottom
    for N, other in ((-a, b), (-b, a)):
        if N.is_integer and N.is_nonnegative:
            return _polynomial_at_one(N, other, c, w, n)
    s = sympy.expand(c - a - b)
    if not s.is_integer:
        return _two_series_at_one(a, b, c, w, n)
    if not s.is_Integer:
        raise UnknownBehaviour(f"whether {s} is positive isn't known")
    if s >= 0:
        return _logarithmic_at_one(a, b, int(s), w, n)
    main, errors = _logarithmic_at_one(c - a, c - b, int(-s), w, n)  # Euler's transformation
    return w**s * main, [w**s * error for error in errors]


def _polynomial_at_one(N: Expr, b: Expr, c: Expr, w: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """2F1(-N, b; c; 1 - w) for a natural number N, DLMF 15.8.7."""
    s = sympy.expand(c + N - b)
    main, errors = _hyper_series(((-N, b), (sympy.expand(1 - s),)), w, n)
    return _rising(sympy.expand(c - b), N) / _rising(c, N) * main, errors


def _two_series_at_one(a: Expr, b: Expr, c: Expr, w: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """2F1(a, b; c; 1 - w) where s isn't an integer, DLMF 15.8.4."""
    s = sympy.expand(c - a - b)
    regular, _ = _hyper_series(((a, b), (1 - s,)), w, n)
    other, _ = _hyper_series(((c - a, c - b), (1 + s,)), w, n)
    first = gamma(c) * gamma(s) / (gamma(c - a) * gamma(c - b))
    second = gamma(c) * gamma(-s) / (gamma(a) * gamma(b))
    return first * regular + second * w**s * other, [w**n, w ** (s + n)]


def _rising(x: Expr, N: Expr) -> Expr:
    """(x)_N, by factorials where x is an integer <= -N."""
    if N.is_Integer:
        return rf(x, N)
    if (-x).is_integer and (-x).is_nonnegative:
        return (-1) ** N * factorial(-x) / factorial(-x - N)
    return gamma(x + N) / gamma(x)


def _logarithmic_at_one(a: Expr, b: Expr, m: int, w: Expr, n: int) -> tuple[Expr, list[Expr]]:
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
    return gamma(a + b + m) * (sympy.Add(*finite) - whole), [w ** (m + n) * log(w)]


def _hankel(nu: Expr, k: int) -> Expr:
    """a_k(nu) of DLMF 10.17.1."""
    return sympy.Mul(*((4 * nu**2 - (2 * j - 1) ** 2) for j in range(1, k + 1))) / (factorial(k) * 8**k)


def _waves(combine: Callable[[Expr, Expr], Expr]) -> Rule:
    """J and Y for large z, by Hankel's functions."""

    def rule(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        (nu,) = parameters
        i = sympy.I
        phase = z - nu * pi / 2 - pi / 4
        sums = [sympy.Add(*((sign * i) ** k * _hankel(nu, k) / z**k for k in range(n))) for sign in (1, -1)]
        up, down = (exp(sign * i * phase) * total for sign, total in zip((1, -1), sums, strict=True))
        errors = [exp(sign * i * z) * z ** (-n - Rational(1, 2)) for sign in (1, -1)]
        return sqrt(2 / (pi * z)) * combine(up, down), errors

    return rule


def _growing(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """I for large z."""
    (nu,) = parameters
    total = sympy.Add(*((-1) ** k * _hankel(nu, k) / z**k for k in range(n)))
    return exp(z) / sqrt(2 * pi * z) * total, [exp(z) * z ** (-n - Rational(1, 2))]


def _decaying(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """K for large z."""
    (nu,) = parameters
    total = sympy.Add(*(_hankel(nu, k) / z**k for k in range(n)))
    return sqrt(pi / (2 * z)) * exp(-z) * total, [exp(-z) * z ** (-n - Rational(1, 2))]


def _airy(sign: int) -> Rule:
    """Ai (-1) and Bi (1), and their derivatives' order aside, for large z: the leading terms."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        zeta = 2 * z ** Rational(3, 2) / 3
        terms = []
        for k in range(n):
            u = sympy.Mul(*(2 * j + 1 for j in range(k, 3 * k))) / (sympy.Integer(216) ** k * factorial(k))
            terms.append(sign**k * u / zeta**k)
        before = exp(sign * zeta) * z ** Rational(-1, 4) / sqrt(pi)
        scale = _ONE if sign > 0 else Rational(1, 2)
        return scale * before * sympy.Add(*terms), [exp(sign * zeta) * z ** (Rational(-1, 4) - Rational(3, 2) * n)]

    return rule


def _oscillating_airy(shift: Expr) -> Rule:
    """Ai(-z) and Bi(-z) for large z: the leading terms."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        zeta = 2 * z ** Rational(3, 2) / 3
        errors = [exp(sign * sympy.I * zeta) * z ** Rational(-7, 4) for sign in (1, -1)]
        return z ** Rational(-1, 4) / sqrt(pi) * sympy.cos(zeta + shift), errors

    return rule


def _confluent_at_infinity(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """1F1(a; b; z) for large z: exp(z) z^(a - b), and what is O(z^(-a)) beside."""
    top, bottom = parameters
    (a,), (b,) = _one_and_one(top, bottom)
    total = sympy.Add(*(rf(1 - a, k) * rf(b - a, k) / (factorial(k) * z**k) for k in range(n)))
    main = gamma(b) / gamma(a) * exp(z) * z ** (a - b) * total
    return main, [exp(z) * z ** (a - b - n), z ** (-a)]


def _confluent_at_minus_infinity(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """1F1(a; b; -z) = exp(-z) 1F1(b - a; b; z)."""
    top, bottom = parameters
    (a,), (b,) = _one_and_one(top, bottom)
    main, errors = _confluent_at_infinity(((sympy.expand(b - a),), (b,)), z, n)
    return sympy.expand_mul(exp(-z) * main), [sympy.expand_mul(exp(-z) * error) for error in errors]


def _tricomi(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
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
        return w**a * main, [w ** (a + n), w ** (a + 1 - c + n)]
    if not c.is_Integer:
        raise UnknownBehaviour(f"whether {c} is positive isn't known")
    return _tricomi_of_integer(a, int(c) - 1, w, n)


def _tricomi_of_integer(a: Expr, m: int, w: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """w^a U(a, m + 1, w) for m = 0, 1, 2, ...; DLMF 13.2.9."""
    terms = []
    for k in range(n):
        shift = polygamma(0, a + k) - polygamma(0, k + 1) - polygamma(0, m + k + 1)
        terms.append(rf(a, k) / (rf(m + 1, k) * factorial(k)) * w**k * (log(w) + shift))
    finite = [factorial(k - 1) * rf(1 - a + k, m - k) / factorial(m - k) * w**-k for k in range(1, m + 1)]
    whole = Rational(-1) ** (m + 1) / (factorial(m) * gamma(a - m)) * sympy.Add(*terms)
    return w**a * (whole + sympy.Add(*finite) / gamma(a)), [w ** (a + n) * log(w)]


def _tricomi_on_the_cut(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """2F0(a, b; z) for large z, where log(-1/z) has two values: what both have in common."""
    main, errors = _tricomi(parameters, z, n)
    a, b = parameters[0]
    leading = [*errors, z ** (-sympy.expand(a)), z ** (-sympy.expand(b))]
    return main, leading


def _hyper_at_infinity(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """1F1, or 2F0 where there is no parameter below."""
    if parameters[1]:
        return _confluent_at_infinity(parameters, z, n)
    return _tricomi_on_the_cut(parameters, z, n)


def _hyper_at_minus_infinity(parameters: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    """1F1, or 2F0 where there is no parameter below."""
    if parameters[1]:
        return _confluent_at_minus_infinity(parameters, z, n)
    return _tricomi(parameters, z, n)


def _one_and_one(top: Any, bottom: Any) -> tuple[Any, Any]:
    if len(top) != 1 or len(bottom) != 1:
        raise UnknownBehaviour("how the hypergeometric function behaves at infinity isn't known")
    return top, bottom


def _exponential_integral(sign: int) -> Rule:
    """Ei at 0: gamma + log|z| + ..."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        terms = (z**k / (k * factorial(k)) for k in range(1, n))
        return sympy.EulerGamma + log(sign * z) + sympy.Add(*terms), [z**n]

    return rule


def _sine_integral(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    terms = ((-1) ** k * z ** (2 * k + 1) / ((2 * k + 1) * factorial(2 * k + 1)) for k in range(n))
    return sympy.Add(*terms), [z ** (2 * n + 1)]


def _cosine_integral(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    terms = ((-1) ** k * z ** (2 * k) / (2 * k * factorial(2 * k)) for k in range(1, n))
    return sympy.EulerGamma + log(z) + sympy.Add(*terms), [z ** (2 * n)]


def _sine_integral_at_infinity(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    errors = [exp(sign * sympy.I * z) * z**-3 for sign in (1, -1)]
    return pi / 2 - sympy.cos(z) / z - sympy.sin(z) / z**2, errors


def _cosine_integral_at_infinity(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
    errors = [exp(sign * sympy.I * z) * z**-3 for sign in (1, -1)]
    return sympy.sin(z) / z - sympy.cos(z) / z**2, errors


def _error_function(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        terms = (Rational(-1, 2) ** k * sympy.factorial2(2 * k - 1) / z ** (2 * k + 1) for k in range(n))
        return sign * (1 - exp(-(z**2)) / sqrt(pi) * sympy.Add(*terms)), [exp(-(z**2)) * z ** (-2 * n - 1)]

    return rule


def _imaginary_error_function(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        terms = (Rational(1, 2) ** k * sympy.factorial2(2 * k - 1) / z ** (2 * k + 1) for k in range(n))
        return sign * exp(z**2) / sqrt(pi) * sympy.Add(*terms), [exp(z**2) * z ** (-2 * n - 1), _ONE]

    return rule


def _exponential_integral_at_infinity(sign: int) -> Rule:
    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        main = exp(sign * z) * sympy.Add(*(factorial(k) / (sign * z) ** (k + 1) for k in range(n)))
        errors = [exp(sign * z) * z ** (-n - 1)]
        if sign > 0:  # beside what grows, a constant
            errors.append(_ONE)
        return main, errors

    return rule


def _arc(sign: int) -> Rule:
    """atan at infinity."""

    def rule(_: Sequence[Any], z: Expr, n: int) -> tuple[Expr, list[Expr]]:
        return sign * (pi / 2 - sympy.atan(1 / z)), []

    return rule


_AT_ZERO: dict[Any, Rule] = {
    sympy.besselj: _first_kind(-1),
    sympy.besseli: _first_kind(1),
    sympy.bessely: _second_kind(-1),
    sympy.besselk: _second_kind(1),
    sympy.hyper: _hyper_series,
    sympy.Ei: _exponential_integral(1),
    sympy.Si: _sine_integral,
    sympy.Ci: _cosine_integral,
}
_BELOW_ZERO: dict[Any, Rule] = {sympy.Ei: _exponential_integral(-1)}
_AT_ONE: dict[Any, Rule] = {sympy.hyper: _hyper_at_one}
_AT_INFINITY: dict[Any, Rule] = {
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
_AT_MINUS_INFINITY: dict[Any, Rule] = {
    sympy.atan: _arc(-1),
    sympy.airyai: _oscillating_airy(-pi / 4),
    sympy.airybi: _oscillating_airy(pi / 4),
    sympy.hyper: _hyper_at_minus_infinity,
    sympy.erf: _error_function(-1),
    sympy.erfi: _imaginary_error_function(-1),
    sympy.Ei: _exponential_integral_at_infinity(-1),
}

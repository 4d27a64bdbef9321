"""Limits of solutions, SymPy expressions, at a singular point and at infinity; their values and slopes at other points.

SymPy's `limit` is asked after the special functions have been replaced by their leading terms where the argument tends to a
singular point of theirs.  Leading terms may cancel, and SymPy's series of special functions have errors: no limit leaves this
module without having been compared with values, in balls, on the way to the point.

Reference: DLMF 9.7 (Airy), 10.7, 10.17, 10.30, 10.40 (Bessel), 13.7, 13.2(iii) (confluent), 14.8 (Legendre's function at -1),
15.4(ii) (Gauss' function at 1), 18.3 (leading coefficients of polynomials).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice, pairwise
from typing import Any

import sympy
from flint import arb
from sympy import Rational, cos, exp, factorial, gamma, log, pi, rf, sin, sqrt
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.atoms import sign_of_root
from kovacic.closed_form.jets import ANTIDERIVATIVES
from kovacic.general_solution.steps import jump_place
from kovacic.general_solution.substitution import finite_value, size, slope
from kovacic.general_solution.zero import NOT_EVALUATED, agree, ball, is_zero, known_jet, opposite, samples
from kovacic.limits import check_time
from kovacic.reading.parser import excerpt

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)
#: What a wave, or a quotient of waves, has in the place of a limit.
OSCILLATING = sympy.AccumBounds(-1, 1)
#: The longest expression whose limit is asked for, in subexpressions: SymPy's work isn't bounded otherwise.
_LONGEST = 120
#: The largest order of a zero that is looked for.
_MOST_DERIVATIVES = 6
#: Terms of a power series that are taken where the argument tends to 0.
_TERMS = 4
#: Distances from the point (their inverses, at infinity) at which a limit is compared with values, three at a time; the
#: larger ones serve where values nearer to the point are lost to cancellation.
_STAGES = (
    (Rational(1, 100), Rational(1, 1600), Rational(1, 50000)),
    (Rational(1, 9), Rational(1, 20), Rational(1, 41)),
)
_AROUND = (Rational(1), Rational(8, 7), Rational(17, 13))
_DIGITS = 60
#: Below this a value may be nothing but the error of what cancels.
_LOST = arb(10) ** (-_DIGITS // 2)
#: How many values of the letters are tried, and how many have to agree.
_SAMPLES = 6
_ENOUGH = 2


_JUMPING = (sympy.Heaviside, sympy.DiracDelta)
#: Functions whose series SymPy knows.
_KNOWN = (
    *(exp, log, sin, cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc, sympy.asin, sympy.acos, sympy.atan, sympy.Abs),
    *(sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch, sympy.asinh, sympy.acosh, sympy.atanh),
    *(sympy.erf, sympy.erfi, sympy.Ei, sympy.Si, sympy.Ci, sympy.Heaviside, sympy.elliptic_k, sympy.elliptic_e),
)


class UnknownLimit(NotImplementedError):
    """It isn't known how the expression behaves."""


@dataclass(frozen=True)
class Approach:
    """x = point + direction * t, or direction/t for infinite points; t > 0 tends to 0."""

    point: Expr
    direction: int = 1

    @property
    def is_infinite(self) -> bool:
        return self.point in (sympy.oo, -sympy.oo)

    def in_terms_of(self, t: Expr) -> Expr:
        if self.is_infinite:
            return sympy.sign(self.point) / t
        return self.point + self.direction * t


def limit_at(expression: Expr, x: Expr, place: Approach) -> Expr:
    """The limit; `oo` for what is unbounded, and `OSCILLATING` for waves and their quotients, which have none.

    Raises `UnknownLimit` where it isn't found, and where values on the way don't confirm it.

    >>> x = sympy.Symbol("x")
    >>> limit_at((1 - sympy.cos(x)) / x**2, x, Approach(_ZERO)), limit_at(sympy.airybi(x), x, Approach(sympy.oo))
    (1/2, oo)
    """
    check_time()
    e = sympy.sympify(expression, strict=True)
    if not e.has_free(x):
        return e
    if e.has(*ANTIDERIVATIVES, sympy.RootSum):
        raise UnknownLimit(f"the limit of {excerpt(e, 60)} isn't known")
    # At infinity the variable is x or -x, as SymPy has it; else the distance from the point.
    variable = sympy.Dummy("s", positive=True)
    towards = sympy.oo if place.is_infinite else _ZERO
    way = place.in_terms_of(1 / variable if place.is_infinite else variable)
    jumps = {jump: _near_the_point(jump, jump.args[0].subs(x, way), variable, towards) for jump in e.atoms(*_JUMPING)}
    if jumps:  # what cancels beyond them has no value that could be compared
        e = sympy.expand(e.xreplace(jumps))
    for found in _candidates(e, x, way, variable, towards):
        if found is not None and _is_confirmed(found, e, x, place):
            return found
    raise UnknownLimit(f"the limit of {excerpt(e, 60)} isn't known")


def _candidates(e: Expr, x: Expr, way: Expr, variable: Expr, towards: Expr) -> Iterator[Expr | None]:
    """Candidates for the limit: by Taylor series at a finite point, else by leading terms, of each summand or of the whole."""
    if towards == 0:
        yield _quotient_of_analytic_functions(e, x, way.subs(variable, 0))
    leading = _with_leading_terms(e.xreplace({x: way}), variable, towards)
    yield _classified(_term_by_term(leading, variable, towards))
    yield _classified(_by_sympy(leading, variable, towards))


def _near_the_point(jump: Expr, argument: Expr, variable: Expr, towards: Expr) -> Expr:
    """The value of a step or an impulse on the way to the point, where the argument has a sign there."""
    if isinstance(jump, sympy.DiracDelta):
        return _ZERO
    end = _by_sympy(argument, variable, towards)
    return jump if end is None or end == 0 else sympy.Heaviside(end)


def _quotient_of_analytic_functions(e: Expr, x: Expr, point: Expr) -> Expr | None:
    """The limit by the first derivatives of numerator and denominator that aren't 0 (L'Hospital); None for other functions."""
    value = finite_value(e, x, point)
    if value is not None:
        return value
    above, below = sympy.fraction(sympy.together(e))
    with suppress(NotImplementedError):  # whether a value is zero isn't known
        for _ in range(_MOST_DERIVATIVES):
            check_time()
            top, bottom = (finite_value(part, x, point) for part in (above, below))
            if top is None or bottom is None:
                return None
            if not is_zero(bottom):
                return top / bottom
            if not is_zero(top):
                return sympy.oo
            above, below = above.diff(x), below.diff(x)
    return None


def _by_sympy(e: Expr, variable: Expr, towards: Expr) -> Any:
    """SymPy's limit of an expression in functions that it knows; None if it gives up, by whichever exception."""
    # of a function without a series SymPy computes derivatives forever; a Bessel function of an integer order has one
    others = [f for f in e.atoms(sympy.Function) if f.has(variable) and not isinstance(f, _KNOWN)]
    if size(e) > _LONGEST or not all(isinstance(f, BesselBase) and f.order.is_Integer for f in others):
        return None
    constant, rest = e.as_independent(variable, as_Add=False)
    rates = _rates_with_signs(rest, variable)
    found = sympy.nan
    with suppress(*NOT_EVALUATED, RecursionError, sympy.PoleError):
        found = sympy.limit(rest.xreplace(rates), variable, towards)
    if found.has(sympy.Limit, sympy.nan, sympy.Order):  # it is left undone
        return None
    return found if found.has(sympy.AccumBounds) else constant * found


def _term_by_term(e: Expr, variable: Expr, towards: Expr) -> Any:
    """The limit of a sum from those of its terms; None if it isn't known, as where unbounded terms cancel."""
    limits = {term: _by_sympy(term, variable, towards) for term in sympy.Add.make_args(sympy.expand_mul(e))}
    if None in limits.values():
        return None
    unbounded = [term for term, found in limits.items() if _classified(found) == sympy.oo]
    if not unbounded:
        return sympy.Add(*limits.values())
    ratios = [_by_sympy(sympy.powsimp(term / unbounded[0]), variable, towards) for term in unbounded]
    is_comparable = all(ratio is not None and not ratio.has(sympy.oo, -sympy.oo, sympy.AccumBounds) for ratio in ratios)
    return sympy.oo if is_comparable and sympy.expand(sympy.Add(*ratios)) != 0 else None


def _rates_with_signs(e: Expr, variable: Expr) -> dict[Expr, Expr]:
    """Powers of e and of the variable with a rate of decay or growth whose sign SymPy doesn't see, and with one that it does.

    These are the two roots of a quadratic equation, as in exp(x (v - sqrt(v^2 + 4 k))/2).
    """
    found = {}
    for power in e.atoms(exp, sympy.Pow):
        base, exponent = power.as_base_exp()
        rate, rest = sympy.factor(exponent).as_independent(variable, as_Add=False)
        sign = sign_of_root(rate) if rate.is_positive is None and rate.has(sympy.Pow) else None
        if sign is not None and not base.has_free(*rate.free_symbols):
            found[power] = base ** (sign * sympy.Dummy(positive=True) * rest)
    return found


def _classified(found: Expr | None) -> Expr | None:
    """A finite number, `oo` or `OSCILLATING`; None for anything else that SymPy may return."""
    if found is None or found.has(sympy.nan):
        return None
    if isinstance(found, sympy.AccumBounds):
        return OSCILLATING
    if found.has(sympy.oo, -sympy.oo, sympy.zoo):
        return sympy.oo
    return None if found.has(sympy.sign) else found


# ------------------------------------------------------------------------------------------- confirmed by values


def _is_confirmed(found: Expr, e: Expr, x: Expr, place: Approach) -> bool:
    """True if values nearer to the point agree better, for two of the first values of the letters.

    Not for all of them: what holds for generic letters needn't for small integers, as where 1/gamma(-m) is 0.
    """
    confirming = 0
    for sizes in _sizes_near(e if found in (sympy.oo, OSCILLATING) else e - found, x, place, _SAMPLES):
        confirming += bool(sizes) and all(_is_nearer(found, far, near) for far, near in pairwise(sizes))
        if confirming == _ENOUGH:
            return True
    return False


def is_refuted(value: Expr | None, y: Expr, x: Expr, place: Approach) -> bool:
    """True if values near the point show that y doesn't tend to the value (None: isn't bounded); False if they are lost."""
    (sizes,) = _sizes_near(y if value is None else y - value, x, place, 1)
    return bool(sizes) and all(bool(near > far * 2) for far, near in pairwise(sizes))


def _sizes_near(e: Expr, x: Expr, place: Approach, count: int) -> Iterator[list[Any]]:
    """The size at three distances, from the largest on; none where the values are lost.

    For several values of the letters that fit what is assumed, of both signs where that is open.
    """
    for k, sample in enumerate(islice(samples((e.free_symbols | place.point.free_symbols) - {x}), 1, 1 + count)):
        letters = opposite(sample) if k % 2 else sample
        here = replace(place, point=place.point.xreplace(letters))
        stages = ([_size_near(e.xreplace(letters), x, here, t) for t in stage] for stage in _STAGES)
        yield next((sizes for sizes in stages if None not in sizes), [])


def _is_nearer(found: Expr, far: Any, near: Any) -> bool:
    """True if a value, or its distance from a finite limit, compares as it should with one further from the point."""
    if found == sympy.oo:
        return bool(near > far * arb("1.02"))
    if found == OSCILLATING:
        return bool(far / 1000 < near < far * 1000)
    return bool(near < far / arb("1.02")) or bool(near < _LOST)


def _size_near(e: Expr, x: Expr, place: Approach, t: Expr) -> Any:
    """The largest of some values about this distance; None if they aren't known well."""
    with working_digits(_DIGITS):
        points = [ball(place.in_terms_of(t * factor)) for factor in _AROUND]
        found = [known_jet(e, x, point) for point in points if point is not None]
        values = [abs(jet[0]) for jet in found if jet is not None]
    is_known = [value.is_finite() and (value.rel_accuracy_bits() >= 10 or bool(value < _LOST)) for value in values]
    return max(values) if is_known == [True] * len(_AROUND) else None


# --------------------------------------------------------------------------------------------------- leading terms


#: (parameters, distance) -> the leading term, with the distance z for z to +oo, 0 and complex infinity, -z for z to -oo,
#: 1 - z and 1 + z for z to 1 and -1.
Rule = Callable[..., Any]


def _with_leading_terms(e: Expr, variable: Expr, towards: Expr) -> Expr:
    """Special functions replaced where their arguments tend to infinity, or to a point where they aren't analytic."""
    known: dict[Expr, Expr] = {}
    for f in e.atoms(sympy.Function):
        *parameters, z = f.args
        rules = _LEADING.get((len(f.ap), len(f.bq)) if isinstance(f, sympy.hyper) else f.func)
        if rules is None or not z.has(variable) or sympy.Tuple(*parameters).has(variable):
            continue
        end = _by_sympy(z, variable, towards)
        if end not in rules and end is not None and not end.is_finite:
            end = sympy.zoo  # in another direction
        if end in rules:
            near = {sympy.oo: z, -sympy.oo: -z, _ONE: 1 - z, -_ONE: 1 + z}.get(end, z)
            leading = rules[end](*parameters, sympy.expand(near))
            known |= {} if leading is None else {f: leading}
    joined = sympy.powsimp(sympy.expand_power_base(e.xreplace(known))) if known else e
    # s^(1/2 - p/(2 p + 4) - 1/(p + 2)) is 1
    return joined.replace(
        lambda u: u.is_Pow and u.exp.is_Add and bool(u.exp.free_symbols), lambda u: u.base ** sympy.cancel(u.exp)
    )


def _series(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """Of a hypergeometric function at 0; an asymptotic one of 2F0."""
    rising = (sympy.Mul(*(rf(a, k) for a in top)) / sympy.Mul(*(rf(b, k) for b in bottom)) for k in range(_TERMS))
    return sympy.Add(*(c * z**k / factorial(k) for k, c in enumerate(rising)))


def _confluent(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """1F1, z to +oo."""
    (a,), (b,) = top, bottom
    if _is_natural(-a):
        return (-z) ** (-a) * gamma(b) / gamma(b - a)
    return gamma(b) / gamma(a) * exp(z) * z ** (a - b)


def _confluent_below(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """1F1(-z) = exp(-z) 1F1(b - a; b; z)."""
    return sympy.powsimp(sympy.expand(exp(-z) * _confluent([sympy.expand(bottom[0] - top[0])], bottom, z)))


def _bessel_hyper(sign: int, _: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """0F1, which is I for z to +oo, and J for z to -oo."""
    (b,) = bottom
    wave = exp(2 * sqrt(z)) / 2 if sign > 0 else cos(2 * sqrt(z) - pi * (2 * b - 1) / 4)
    return gamma(b) / sqrt(pi) * z ** ((1 - 2 * b) / 4) * wave


def _tricomi(sign: int, top: Sequence[Any], _: Sequence[Any], z: Expr) -> Expr | None:
    """2F0(a, b; z) = w^a U(a, a - b + 1, w), w = -1/z to 0: the smaller of the powers w^a and w^b, by the sign of a - b."""
    w = -sign / z
    top = sorted(top, key=lambda a: not _is_natural(-a))
    for a, b in (top, top[::-1]):
        c = sympy.expand(a - b)
        if _is_natural(-a):  # a polynomial
            return rf(b, -a) * w**a
        if c.is_negative:
            return gamma(-c) / gamma(b) * w**a
    return -(w**a) * log(w) / gamma(a) if c == 0 else None


def _gauss_at_one(top: Sequence[Any], bottom: Sequence[Any], w: Expr) -> Expr | None:
    """2F1(a, b; c; 1 - w), by the sign of s = c - a - b; (c - b)_N/(c)_N for a polynomial of degree N = -a."""
    (a, b), (c,) = top, bottom
    for N, other in ((-a, sympy.expand(c - b)), (-b, sympy.expand(c - a))):
        if _is_natural(N):
            return _rising(other, N) / _rising(c, N)
    s = sympy.expand(c - a - b)
    if s == 0:
        psi = sympy.polygamma(0, a) + sympy.polygamma(0, b) + 2 * sympy.EulerGamma
        return -gamma(a + b) / (gamma(a) * gamma(b)) * (log(w) + psi)
    if s.is_positive:
        return gamma(c) * gamma(s) / (gamma(c - a) * gamma(c - b))
    return gamma(c) * gamma(-s) / (gamma(a) * gamma(b)) * w**s if s.is_negative else None


def _rising(x: Expr, N: Expr) -> Expr:
    """(x)_N, by factorials where x is an integer <= -N."""
    if _is_natural(-x):
        return (-1) ** N * factorial(-x) / factorial(sympy.expand(-x - N))
    return gamma(x + N) / gamma(x)


def _is_natural(N: Expr) -> bool:
    return bool(N.is_integer and N.is_nonnegative)


def _airy(constant: Expr, sign: int, power: Rational, wave: Any, shift: Expr) -> dict[Any, Rule]:
    """Ai, Bi and their derivatives: constant e^(+-zeta) z^power/sqrt(pi) with zeta = 2 z^(3/2)/3, and waves of zeta."""
    return {
        sympy.oo: lambda z: constant * exp(sign * 2 * z ** Rational(3, 2) / 3) * z**power / sqrt(pi),
        -sympy.oo: lambda z: wave(2 * z ** Rational(3, 2) / 3 + shift) * z**power / sqrt(pi),
    }


def _polynomial(leading: Callable[..., Expr]) -> dict[Any, Rule]:
    """A polynomial of the symbolic degree N: its leading coefficient, and (-1)^N of it at minus infinity."""
    return {
        sympy.oo: lambda N, *p: leading(N) * p[-1] ** N,
        -sympy.oo: lambda N, *p: leading(N) * (-1) ** N * p[-1] ** N,
    }


def _first_kind(sign: int, nu: Expr, z: Expr) -> Expr | None:
    """J and I at 0, of an order that isn't an integer known to SymPy."""
    return None if nu.is_Integer else (z / 2) ** nu / gamma(nu + 1) * _series((), (nu + 1,), sign * z**2 / 4)


def _second_kind(constant: Expr, nu: Expr, z: Expr) -> Expr | None:
    """Y and K at 0: Gamma(nu)/2 (2/z)^nu times a constant, or the logarithm."""
    if nu == 0:
        return -constant * (log(z / 2) + sympy.EulerGamma)
    return constant * gamma(nu) / 2 * (2 / z) ** nu if nu.is_positive else None


def _wave(wave: Any, nu: Expr, z: Expr) -> Expr:
    """J and Y at infinity: waves with the amplitude sqrt(2/(pi z))."""
    return sqrt(2 / (pi * z)) * wave(z - nu * pi / 2 - pi / 4)


#: By function, or by the numbers of parameters of a hypergeometric one: what is taken where the argument tends to a place.
_LEADING: dict[Any, dict[Any, Rule]] = {
    sympy.airyai: _airy(sympy.S.Half, -1, -Rational(1, 4), cos, -pi / 4),
    sympy.airybi: _airy(_ONE, 1, -Rational(1, 4), cos, pi / 4),
    sympy.airyaiprime: _airy(-sympy.S.Half, -1, Rational(1, 4), sin, -pi / 4),
    sympy.airybiprime: _airy(_ONE, 1, Rational(1, 4), sin, pi / 4),
    sympy.besselj: {sympy.oo: partial(_wave, cos), _ZERO: partial(_first_kind, -1)},
    sympy.bessely: {sympy.oo: partial(_wave, sin), _ZERO: partial(_second_kind, -2 / pi)},
    sympy.besseli: {sympy.oo: lambda nu, z: exp(z) / sqrt(2 * pi * z), _ZERO: partial(_first_kind, 1)},
    sympy.besselk: {sympy.oo: lambda nu, z: exp(-z) * sqrt(pi / (2 * z)), _ZERO: partial(_second_kind, _ONE)},
    sympy.jn: {_ZERO: lambda n, z: sqrt(pi / (2 * z)) * _first_kind(-1, n + Rational(1, 2), z)},
    sympy.yn: {_ZERO: lambda n, z: sqrt(pi / (2 * z)) * _second_kind(-2 / pi, n + Rational(1, 2), z)},
    sympy.hermite: _polynomial(lambda N: 2**N),
    sympy.laguerre: _polynomial(lambda N: (-1) ** N / factorial(N)),
    sympy.assoc_laguerre: _polynomial(lambda N: (-1) ** N / factorial(N)),
    sympy.legendre: {-_ONE: lambda n, w: None if n.is_integer else sin(pi * n) / pi * log(w / 2)},
    (0, 1): {_ZERO: _series, sympy.oo: partial(_bessel_hyper, 1), -sympy.oo: partial(_bessel_hyper, -1)},
    (1, 1): {_ZERO: _series, sympy.oo: _confluent, -sympy.oo: _confluent_below},
    (2, 0): {
        _ZERO: _series,
        sympy.oo: partial(_tricomi, 1),
        sympy.zoo: partial(_tricomi, 1),
        -sympy.oo: partial(_tricomi, -1),
    },
    (2, 1): {_ZERO: _series, _ONE: _gauss_at_one},
    (2, 2): {_ZERO: _series},
    (1, 2): {_ZERO: _series},
}


# -------------------------------------------------------------------------------------------------- values at a point


def values_at(expression: Expr, x: Expr, point: Expr) -> tuple[Expr, Expr]:
    """(f(a), f'(a)) at an ordinary point of f; at the jump of a step function, just before it.

    Raises `NotImplementedError` for a form 0/0 whose limit isn't found.

    >>> x = sympy.Symbol("x")
    >>> values_at(x * sympy.exp(2 * x), x, sympy.Integer(1))
    (exp(2), 3*exp(2))
    """
    return value_at(expression, x, point), value_at(expression, x, point, 1)


def value_at(expression: Expr, x: Expr, point: Expr, order: int = 0) -> Expr:
    """The value of the function (order 0) or of its slope (order 1), as for `values_at`."""
    check_time()
    e = sympy.sympify(expression, strict=True)
    if not e.has_free(x):
        return _ZERO if order else e
    # Steps and impulses have the values just before the point: neither has a slope there.
    e = e.xreplace({jump: _just_before(e, jump, x, point, order) for jump in e.atoms(*_JUMPING) if jump.has(x)})
    if order:
        is_series_at_zero = any(f.argument.subs(x, point) == 0 for f in e.atoms(sympy.hyper))
        derivative = e.diff(x) if is_series_at_zero else slope(e, x)
        e = derivative.xreplace(dict(_contiguous(e, x, point)))
    value = finite_value(e, x, point)
    if value is not None:
        return value
    for integral in e.atoms(sympy.Integral):  # from the point to x it is 0 there, and so is a bounded multiple
        letter = sympy.Dummy()
        in_letter = e.xreplace({integral: letter})
        if integral.limits[0][1:] == (point, x) and have_values([in_letter.diff(letter)], x, point):
            e = in_letter.xreplace({letter: _ZERO})
    # The limit from the right, if it is that from the left: a closed form with roots may be another solution there.
    with suppress(NotImplementedError):
        right, left = (limit_at(e, x, Approach(point, direction)) for direction in (1, -1))
        if {right, left}.isdisjoint((sympy.oo, OSCILLATING)) and agree(right, left):
            return right
    said = f"the functions of the closed form are singular at {point}, where the solutions aren't"
    raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of this solution")


def _contiguous(e: Expr, x: Expr, point: Expr) -> Iterator[tuple[Expr, Expr]]:
    """Functions that derivatives have in those of the expression itself, and of the next degree, which exist for n = 0, too.

    H_n' = 2 x H_n - H_(n+1), and for L_n^(a)' ((n + 1) L_(n+1)^(a) - (n + 1 + a - x) L_n^(a))/x [DLMF 18.9].
    """
    for f in e.atoms(sympy.hermite, sympy.laguerre, sympy.assoc_laguerre):
        *_, z = f.args
        if isinstance(f, sympy.hermite):
            n = f.args[0]
            yield sympy.hermite(n - 1, z), (2 * z * f - sympy.hermite(n + 1, z)) / (2 * n)
        elif z.subs(x, point) != 0:
            n, a = (*f.args[:-1], sympy.Integer(0))[:2]
            more = sympy.assoc_laguerre(n + 1, a, z)
            yield sympy.assoc_laguerre(n - 1, a + 1, z), ((n + 1 + a - z) * f - (n + 1) * more) / z


def _just_before(e: Expr, jump: Expr, x: Expr, point: Expr, order: int) -> Expr:
    """The value of a step or an impulse just before the point; as H(u, 0) where parameters may put the point on the step."""
    if isinstance(jump, sympy.DiracDelta):
        return _ZERO
    place = jump_place(jump, x)
    is_one_before = place is not None and bool(place.slope.is_negative)  # H(s (x - a)) is 1 before a
    step = sympy.Heaviside(sympy.expand(jump.args[0].subs(x, point)), int(is_one_before))
    if place is None or not isinstance(step, sympy.Heaviside):
        return step
    # Neither the function nor its slope may jump where the step does.
    across = (e.xreplace({jump: _ONE}) - e.xreplace({jump: _ZERO})).diff(x, order)
    value = finite_value(across, x, place.a)
    return sympy.Heaviside(step.args[0]) if value is not None and is_zero(value) else step


def have_values(expressions: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """True if all of them have a value at the point, or a limit.

    >>> x = sympy.Symbol("x")
    >>> have_values([x, 1 / x], x, sympy.Integer(0))
    False
    """
    with suppress(NotImplementedError):
        return all(value_at(expression, x, point) is not None for expression in expressions)
    return False

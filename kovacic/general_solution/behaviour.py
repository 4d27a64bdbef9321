"""Limits of solutions, SymPy expressions, at a singular point and at infinity; their values and slopes at other points.

Special functions are replaced by their leading terms where their arguments tend to singular points of theirs; the limit of
the result is SymPy's.  Leading terms may cancel, and SymPy's series of special functions have errors: every limit is compared
with values, in balls, on the way to the point.

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
from sympy import Add, Heaviside, Rational, S, cos, exp, expand, factorial, gamma, hermite, log, oo, pi, rf, sin, sqrt
from sympy.functions.special.bessel import BesselBase

from kovacic.algebra.precision import working_digits
from kovacic.closed_form.atoms import sign_of_root
from kovacic.closed_form.jets import ANTIDERIVATIVES
from kovacic.closed_form.steps import jump_place
from kovacic.general_solution.substitution import finite_value, slope
from kovacic.general_solution.zero import (
    NOT_EVALUATED,
    agree,
    ball_of,
    generic_samples,
    is_zero,
    known_jet,
    opposite,
)
from kovacic.limits import check_time, manageable
from kovacic.reading.parser import excerpt

Expr = Any  # SymPy publishes no types
#: Stands for the missing limit of a wave, or of a quotient of waves.
OSCILLATING = sympy.AccumBounds(-1, 1)
#: Distances from the point (their inverses, at infinity) at which a limit is compared with values, three at a time; the
#: larger ones serve where values nearer to the point are lost to cancellation.
_STAGES = (
    (Rational(1, 100), Rational(1, 1600), Rational(1, 50000)),
    (Rational(1, 9), Rational(1, 20), Rational(1, 41)),
)
#: Distances for a function that is unbounded at a finite point: a logarithm and a constant may cancel at larger ones.
_NEAREST = (Rational(1, 10**4), Rational(1, 10**8), Rational(1, 10**16))
#: Each distance stands for three, times these factors, since a wave may be small at one of them.
_AROUND = (Rational(1), Rational(8, 7), Rational(17, 13))
_LIMIT_DIGITS = 60
#: Smaller values may be nothing but rounding errors after cancellation.
_NOISE = arb(10) ** (-_LIMIT_DIGITS // 2)
_DISCONTINUOUS = (Heaviside, sympy.DiracDelta)
#: Functions whose series SymPy knows.
_WITH_SERIES = (
    *(exp, log, sin, cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc, sympy.asin, sympy.acos, sympy.atan, sympy.Abs),
    *(sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch, sympy.asinh, sympy.acosh, sympy.atanh),
    *(sympy.erf, sympy.erfi, sympy.Ei, sympy.Si, sympy.Ci, Heaviside, sympy.elliptic_k, sympy.elliptic_e),
)


class UnknownLimit(NotImplementedError):
    """The behaviour of an expression near a point isn't known."""


@dataclass(frozen=True)
class Approach:
    """x = point + direction * t, or direction/t for infinite points; t > 0 tends to 0."""

    point: Expr
    direction: int = 1

    @property
    def is_infinite(self) -> bool:
        return self.point in (oo, -oo)

    def in_terms_of(self, t: Expr) -> Expr:
        if self.is_infinite:
            return sympy.sign(self.point) / t
        return self.point + self.direction * t


def limit_at(expression: Expr, x: Expr, place: Approach) -> Expr:
    """The limit; `oo` for unbounded expressions, and `OSCILLATING` for waves and their quotients, which have none.

    Raises `UnknownLimit` if it isn't found, or if values on the way don't confirm it.

    >>> x = sympy.Symbol("x")
    >>> limit_at((1 - cos(x)) / x**2, x, Approach(S.Zero)), limit_at(sympy.airybi(x), x, Approach(oo))
    (1/2, oo)
    """
    check_time()
    e = sympy.sympify(expression, strict=True)
    if not e.has_free(x):
        return e
    t = sympy.Dummy("s", positive=True)
    way = place.in_terms_of(t)
    jumps = dict.fromkeys(e.atoms(*_DISCONTINUOUS), S.Zero)
    for step in e.atoms(Heaviside):  # its value on the way to the point, if the argument has a sign there
        end = _by_sympy(step.args[0].subs(x, way), t)
        jumps[step] = step if end is None or end == 0 else Heaviside(end)
    if jumps:  # what cancels beyond them has no value that could be compared
        e = expand(e.xreplace(jumps))
    if not e.has(*ANTIDERIVATIVES, sympy.RootSum):
        for found in _limit_candidates(e, x, place, t):
            if found is not None and _is_confirmed(found, e, x, place):
                return found
    raise UnknownLimit(f"the limit of {excerpt(e, 60)} isn't known")


def _limit_candidates(e: Expr, x: Expr, place: Approach, t: Expr) -> Iterator[Expr | None]:
    """Candidates for the limit: by Taylor series at a finite point, else by leading terms, of each summand or of the whole."""
    if not place.is_infinite:
        yield _quotient_of_analytic_functions(e, x, place.point)
    leading = _with_leading_terms(e.xreplace({x: place.in_terms_of(t)}), t)
    yield _classified(_term_by_term(leading, t))
    yield _classified(_by_sympy(leading, t))


def zeros_of_leading_term(e: Expr, x: Expr, place: Approach) -> set[Expr]:
    """1/gamma(u) in leading terms: where one is zero, what is unbounded for generic letters may be bounded."""
    t = sympy.Dummy("s", positive=True)
    powers = _with_leading_terms(e.xreplace({x: place.in_terms_of(t)}), t).atoms(sympy.Pow)
    return {1 / p.base for p in powers if isinstance(p.base, gamma) and p.exp.is_negative and p.free_symbols}


def _quotient_of_analytic_functions(e: Expr, x: Expr, point: Expr) -> Expr | None:
    """The limit by the first derivatives of numerator and denominator that aren't 0 (L'Hospital); None for other functions."""
    above, below = sympy.fraction(sympy.together(e))
    with suppress(NotImplementedError):  # whether a value is zero isn't known
        while manageable(above, below):
            check_time()
            top, bottom = (finite_value(part, x, point) for part in (above, below))
            if top is None or bottom is None:
                return None
            if not is_zero(bottom):
                return top / bottom
            if not is_zero(top):
                return oo
            above, below = above.diff(x), below.diff(x)
    return None


def _by_sympy(e: Expr, t: Expr) -> Any:
    """SymPy's limit for t to 0 of an expression in functions that it knows; None if it gives up, by whichever exception."""
    # of a function without a series SymPy computes derivatives forever; a Bessel function of an integer order has one
    others = [f for f in e.atoms(sympy.Function) if f.has(t) and not isinstance(f, _WITH_SERIES)]
    if not manageable(e) or not all(isinstance(f, BesselBase) and f.order.is_Integer for f in others):
        return None
    constant, rest = e.as_independent(t, as_Add=False)
    found = sympy.nan
    with suppress(*NOT_EVALUATED, RecursionError, sympy.PoleError):
        found = sympy.limit(rest.xreplace(_rates_with_signs(rest, t)), t, 0)
    if found.has(sympy.Limit, sympy.nan, sympy.Order):  # it is left undone
        return None
    return found if found.has(sympy.AccumBounds) else constant * found


def _term_by_term(e: Expr, t: Expr) -> Any:
    """The limit of a sum from those of its terms; None if it isn't known, as where unbounded terms cancel."""
    limits = {term: _by_sympy(term, t) for term in Add.make_args(sympy.expand_mul(e))}
    if None in limits.values():
        return None
    unbounded = [term for term, found in limits.items() if _classified(found) == oo]
    if not unbounded:
        return Add(*limits.values())
    ratios = [_classified(_by_sympy(sympy.powsimp(term / unbounded[0]), t)) for term in unbounded]
    is_comparable = {None, oo, OSCILLATING}.isdisjoint(ratios)
    return oo if is_comparable and expand(Add(*ratios)) != 0 else None


def _rates_with_signs(e: Expr, t: Expr) -> dict[Expr, Expr]:
    """Powers of e and t with positive letters for rates of unseen sign, roots of quadratics: exp(x (v - sqrt(v^2 + 4 k)))."""
    found = {}
    for power in e.atoms(exp, sympy.Pow):
        base, exponent = power.as_base_exp()
        rate, rest = sympy.factor(exponent).as_independent(t, as_Add=False)
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
    if found.has(oo, -oo, sympy.zoo):
        return oo
    return None if found.has(sympy.sign) else found


# ------------------------------------------------------------------------------------------- confirmed by values


def _is_confirmed(found: Expr, e: Expr, x: Expr, place: Approach) -> bool:
    """True if values nearer to the point agree better, for two of several values of the letters.

    Not for all of them: what holds for generic letters needn't for small integers, as where 1/gamma(-m) is 0.
    """
    rest = e if found in (oo, OSCILLATING) else e - found
    stages = (_NEAREST, *_STAGES) if found == oo and not place.is_infinite else _STAGES
    known = filter(None, _sizes_near(rest, x, place, stages))
    confirming = (sizes for sizes in known if _is_approached(found, sizes))
    wanted = 2 if (rest.free_symbols | place.point.free_symbols) - {x} else 1
    return len([*islice(confirming, wanted)]) == wanted


def is_refuted(value: Expr | None, y: Expr, x: Expr, place: Approach) -> bool:
    """True if values near the point show that y doesn't tend to the value (None: isn't bounded); False if they are lost."""
    sizes = next(_sizes_near(y if value is None else y - value, x, place))
    return bool(sizes) and all(bool(near > far * 2) for far, near in pairwise(sizes))


def _sizes_near(e: Expr, x: Expr, place: Approach, stages: Sequence[Any] = _STAGES) -> Iterator[list[Any]]:
    """The sizes at three distances, from the largest on, for several values of the letters, or [] if the values are lost."""
    for k, sample in enumerate(generic_samples((e.free_symbols | place.point.free_symbols) - {x})):
        letters = opposite(sample) if k % 2 else sample  # of both signs if none is known
        here = replace(place, point=place.point.xreplace(letters))
        known = ([_size_near(e.xreplace(letters), x, here, t) for t in stage] for stage in stages)
        yield next((sizes for sizes in known if None not in sizes), [])


def _is_approached(found: Expr, sizes: Sequence[Any]) -> bool:
    """True if the sizes, nearer and nearer, of e or of its distance from a finite limit, fit each other.

    A logarithm grows as much from the second distance to the third as from the first to the second; what rises to a finite
    limit grows less and less.
    """
    far, middle, near = sizes
    if found == oo:
        return all(bool(b > a * arb("1.02")) for a, b in pairwise(sizes)) and bool(2 * (near - middle) > middle - far)
    if found == OSCILLATING:
        return all(bool(a / 1000 < b < a * 1000) for a, b in pairwise(sizes))
    return all(bool(b < a / arb("1.02")) or bool(b < _NOISE) for a, b in pairwise(sizes))


def _size_near(e: Expr, x: Expr, place: Approach, t: Expr) -> Any:
    """The largest of some values about this distance; None if they aren't known well."""
    with working_digits(_LIMIT_DIGITS):
        points = [ball_of(place.in_terms_of(t * factor)) for factor in _AROUND]
        jets = [known_jet(e, x, point) for point in points if point is not None]
    if None in jets or len(jets) < len(_AROUND):
        return None
    sizes = [abs(value) for value, *_ in jets]
    is_known = all(size.is_finite() and (size.rel_accuracy_bits() >= 10 or size < _NOISE) for size in sizes)
    return max(sizes) if is_known else None


# --------------------------------------------------------------------------------------------------- leading terms


#: (parameters, distance) -> the leading term, with the distance z for z to +oo, 0 and complex infinity, -z for z to -oo,
#: 1 - z and 1 + z for z to 1 and -1.
_LeadingTerm = Callable[..., Any]


def _with_leading_terms(e: Expr, t: Expr) -> Expr:
    """Leading terms for special functions whose arguments tend to infinity, or to a point where they aren't analytic."""
    known: dict[Expr, Expr] = {}
    for f in e.atoms(sympy.Function):
        *parameters, z = f.args
        rules = _LEADING.get((len(f.ap), len(f.bq)) if isinstance(f, sympy.hyper) else f.func)
        if rules is None or not z.has(t) or sympy.Tuple(*parameters).has(t):
            continue
        end = _by_sympy(z, t)
        if end not in rules and end is not None and not end.is_finite:
            end = sympy.zoo  # in another direction
        if end in rules:
            near = {oo: z, -oo: -z, S.One: 1 - z, -S.One: 1 + z}.get(end, z)
            leading = rules[end](*parameters, expand(near))
            known |= {} if leading is None else {f: leading}
    joined = sympy.powsimp(sympy.expand_power_base(e.xreplace(known))) if known else e
    # s^(1/2 - p/(2 p + 4) - 1/(p + 2)) is 1
    return joined.replace(
        lambda u: u.is_Pow and u.exp.is_Add and bool(u.exp.free_symbols), lambda u: u.base ** sympy.cancel(u.exp)
    )


def _first_terms(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """The first four terms of a hypergeometric series in z; for 2F0 they are asymptotic."""
    rising = (sympy.Mul(*(rf(a, k) for a in top)) / sympy.Mul(*(rf(b, k) for b in bottom)) for k in range(4))
    return Add(*(c * z**k / factorial(k) for k, c in enumerate(rising)))


def _kummer(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """1F1, z to +oo."""
    (a,), (b,) = top, bottom
    if _is_natural(-a):
        return (-z) ** (-a) * gamma(b) / gamma(b - a)
    return gamma(b) / gamma(a) * exp(z) * z ** (a - b)


def _kummer_below(top: Sequence[Any], bottom: Sequence[Any], z: Expr) -> Expr:
    """1F1(a; b; -z) = exp(-z) 1F1(b - a; b; z)."""
    return sympy.powsimp(expand(exp(-z) * _kummer([expand(bottom[0] - top[0])], bottom, z)))


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
        c = expand(a - b)
        if _is_natural(-a):  # a polynomial
            return rf(b, -a) * w**a
        if c.is_negative:
            return gamma(-c) / gamma(b) * w**a
    return -(w**a) * log(w) / gamma(a) if c == 0 else None


def _gauss_at_one(top: Sequence[Any], bottom: Sequence[Any], w: Expr) -> Expr | None:
    """2F1(a, b; c; 1 - w), by the sign of s = c - a - b; (c - b)_N/(c)_N for a polynomial of degree N = -a."""
    (a, b), (c,) = top, bottom
    for N, other in ((-a, expand(c - b)), (-b, expand(c - a))):
        if _is_natural(N):
            return _rising(other, N) / _rising(c, N)
    s = expand(c - a - b)
    if s == 0:
        psi = sympy.polygamma(0, a) + sympy.polygamma(0, b) + 2 * sympy.EulerGamma
        return -gamma(a + b) / (gamma(a) * gamma(b)) * (log(w) + psi)
    if s.is_positive:
        return gamma(c) * gamma(s) / (gamma(c - a) * gamma(c - b))
    return gamma(c) * gamma(-s) / (gamma(a) * gamma(b)) * w**s if s.is_negative else None


def _rising(x: Expr, N: Expr) -> Expr:
    """(x)_N, by factorials where x is an integer <= -N."""
    if _is_natural(-x):
        return (-1) ** N * factorial(-x) / factorial(expand(-x - N))
    return gamma(x + N) / gamma(x)


def _is_natural(N: Expr) -> bool:
    return bool(N.is_integer and N.is_nonnegative)


def _airy(constant: Expr, sign: int, power: Rational, wave: Any, shift: Expr) -> dict[Any, _LeadingTerm]:
    """Ai, Bi and their derivatives: constant e^(sign zeta) z^power/sqrt(pi) with zeta = 2 z^(3/2)/3, and waves of zeta."""
    return {
        oo: lambda z: constant * exp(sign * 2 * z ** Rational(3, 2) / 3) * z**power / sqrt(pi),
        -oo: lambda z: wave(2 * z ** Rational(3, 2) / 3 + shift) * z**power / sqrt(pi),
    }


def _polynomial_of_degree_N(leading: Callable[..., Expr]) -> dict[Any, _LeadingTerm]:
    """A polynomial of the symbolic degree N: its leading coefficient, and (-1)^N of it at minus infinity."""
    return {
        oo: lambda N, *p: leading(N) * p[-1] ** N,
        -oo: lambda N, *p: leading(N) * (-1) ** N * p[-1] ** N,
    }


def _first_kind(sign: int, nu: Expr, z: Expr) -> Expr | None:
    """J and I at 0, of an order that isn't an integer known to SymPy."""
    return None if nu.is_Integer else (z / 2) ** nu / gamma(nu + 1) * _first_terms((), (nu + 1,), sign * z**2 / 4)


def _second_kind(constant: Expr, nu: Expr, z: Expr) -> Expr | None:
    """Y and K at 0: Gamma(nu)/2 (2/z)^nu times a constant, or the logarithm."""
    if nu == 0:
        return -constant * (log(z / 2) + sympy.EulerGamma)
    return constant * gamma(nu) / 2 * (2 / z) ** nu if nu.is_positive else None


def _wave(wave: Any, nu: Expr, z: Expr) -> Expr:
    """J and Y at infinity: waves with the amplitude sqrt(2/(pi z))."""
    return sqrt(2 / (pi * z)) * wave(z - nu * pi / 2 - pi / 4)


#: Leading terms by function, or by the numbers of parameters of a hypergeometric one, and by the limit of the argument.
_LEADING: dict[Any, dict[Any, _LeadingTerm]] = {
    sympy.airyai: _airy(S.Half, -1, -Rational(1, 4), cos, -pi / 4),
    sympy.airybi: _airy(S.One, 1, -Rational(1, 4), cos, pi / 4),
    sympy.airyaiprime: _airy(-S.Half, -1, Rational(1, 4), sin, -pi / 4),
    sympy.airybiprime: _airy(S.One, 1, Rational(1, 4), sin, pi / 4),
    sympy.besselj: {oo: partial(_wave, cos), S.Zero: partial(_first_kind, -1)},
    sympy.bessely: {oo: partial(_wave, sin), S.Zero: partial(_second_kind, -2 / pi)},
    sympy.besseli: {oo: lambda nu, z: exp(z) / sqrt(2 * pi * z), S.Zero: partial(_first_kind, 1)},
    sympy.besselk: {oo: lambda nu, z: exp(-z) * sqrt(pi / (2 * z)), S.Zero: partial(_second_kind, S.One)},
    sympy.jn: {S.Zero: lambda n, z: sqrt(pi / (2 * z)) * _first_kind(-1, n + Rational(1, 2), z)},
    sympy.yn: {S.Zero: lambda n, z: sqrt(pi / (2 * z)) * _second_kind(-2 / pi, n + Rational(1, 2), z)},
    hermite: _polynomial_of_degree_N(lambda N: 2**N),
    sympy.laguerre: _polynomial_of_degree_N(lambda N: (-1) ** N / factorial(N)),
    sympy.assoc_laguerre: _polynomial_of_degree_N(lambda N: (-1) ** N / factorial(N)),
    sympy.legendre: {-S.One: lambda n, w: None if n.is_integer else sin(pi * n) / pi * log(w / 2)},
    (0, 1): {S.Zero: _first_terms, oo: partial(_bessel_hyper, 1), -oo: partial(_bessel_hyper, -1)},
    (1, 1): {S.Zero: _first_terms, oo: _kummer, -oo: _kummer_below},
    (2, 0): {S.Zero: _first_terms, **dict.fromkeys((oo, sympy.zoo), partial(_tricomi, 1)), -oo: partial(_tricomi, -1)},
    (2, 1): {S.Zero: _first_terms, S.One: _gauss_at_one},
    (2, 2): {S.Zero: _first_terms},
    (1, 2): {S.Zero: _first_terms},
}


# -------------------------------------------------------------------------------------------------- values at a point


def values_at(expression: Expr, x: Expr, point: Expr) -> tuple[Expr, Expr]:
    """(f(a), f'(a)) at an ordinary point of f; at the jump of a step function, just before it.

    Raises `NotImplementedError` for a form 0/0 whose limit isn't found.

    >>> x = sympy.Symbol("x")
    >>> values_at(x * exp(2 * x), x, S.One)
    (exp(2), 3*exp(2))
    """
    return value_or_limit(expression, x, point), value_or_limit(expression, x, point, 1)


def value_or_limit(expression: Expr, x: Expr, point: Expr, order: int = 0) -> Expr:
    """The value of the function (order 0) or of its slope (order 1), as for `values_at`."""
    check_time()
    e = sympy.sympify(expression, strict=True)
    # Steps and impulses have the values just before the point: neither has a slope there.
    e = e.xreplace({jump: _just_before(e, jump, x, point, order) for jump in e.atoms(*_DISCONTINUOUS) if jump.has(x)})
    if order:
        is_series_at_zero = any(f.argument.subs(x, point) == 0 for f in e.atoms(sympy.hyper))
        derivative = e.diff(x) if is_series_at_zero else slope(e, x)
        e = derivative.xreplace(dict(_contiguous(e, x, point)))
    value = _checked_value(e, x, point)
    if value is not None:
        return value
    for integral in e.atoms(sympy.Integral):  # from the point to x it is 0 there, and so is a bounded multiple
        letter = sympy.Dummy()
        in_letter = e.xreplace({integral: letter})
        if integral.limits[0][1:] == (point, x) and have_values([in_letter.diff(letter)], x, point):
            e = in_letter.xreplace({letter: S.Zero})
    # The limit from the right, if it is that from the left: a closed form with roots may be another solution there.
    with suppress(NotImplementedError):
        right, left = (limit_at(e, x, Approach(point, direction)) for direction in (1, -1))
        if {right, left}.isdisjoint((oo, OSCILLATING)) and agree(right, left):
            return right
    said = f"a finite value of the closed form isn't found at {point}"
    raise NotImplementedError(f"{said}: kovacic.evaluate gives the values of solutions that are regular there")


def _checked_value(e: Expr, x: Expr, point: Expr) -> Expr | None:
    """The finite value at a point; SymPy doesn't see that 1/q(a) isn't finite for an irrational root a of q."""
    value = finite_value(e, x, point)
    if value is None or point.is_Rational or not point.is_number:
        return value
    found = ball_of(value, next(generic_samples(value.free_symbols)))
    return value if found is None or found.is_finite() else None


def _contiguous(e: Expr, x: Expr, point: Expr) -> Iterator[tuple[Expr, Expr]]:
    """Functions that derivatives have in those of the expression itself, and of the next degree, which exist for n = 0, too.

    H_n' = 2 x H_n - H_(n+1), and for L_n^(a)' ((n + 1) L_(n+1)^(a) - (n + 1 + a - x) L_n^(a))/x [DLMF 18.9].
    """
    for f in e.atoms(hermite, sympy.laguerre, sympy.assoc_laguerre):
        *_, z = f.args
        if isinstance(f, hermite):
            n = f.args[0]
            yield hermite(n - 1, z), (2 * z * f - hermite(n + 1, z)) / (2 * n)
        elif z.subs(x, point) != 0:
            n, a = (*f.args[:-1], S.Zero)[:2]
            more = sympy.assoc_laguerre(n + 1, a, z)
            yield sympy.assoc_laguerre(n - 1, a + 1, z), ((n + 1 + a - z) * f - (n + 1) * more) / z


def _just_before(e: Expr, jump: Expr, x: Expr, point: Expr, order: int) -> Expr:
    """The value of a step or an impulse just before the point; as H(u, 0) where parameters may put the point on the step."""
    if isinstance(jump, sympy.DiracDelta):
        return S.Zero
    place = jump_place(jump, x)
    is_one_before = place is not None and bool(place.slope.is_negative)  # H(s (x - a)) is 1 before a
    step = Heaviside(expand(jump.args[0].subs(x, point)), int(is_one_before))
    if place is None or not isinstance(step, Heaviside):
        return step
    # Neither the function nor its slope may jump where the step does.
    across = (e.xreplace({jump: S.One}) - e.xreplace({jump: S.Zero})).diff(x, order)
    value = finite_value(across, x, place.a)
    return Heaviside(step.args[0]) if value is not None and is_zero(value) else step


def have_values(expressions: Sequence[Expr], x: Expr, point: Expr) -> bool:
    """True if all of them have a value at the point, or a limit.

    >>> x = sympy.Symbol("x")
    >>> have_values([x, 1 / x], x, S.Zero)
    False
    """
    with suppress(NotImplementedError):
        return all(value_or_limit(expression, x, point) is not None for expression in expressions)
    return False

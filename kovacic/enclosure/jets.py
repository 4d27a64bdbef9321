"""Equations a y'' + b y' + c y = f with analytic coefficients in a disc: their series with proven bounds, and series solutions.

The guarantee: for every point of the disc the returned balls contain the exact solution there.

With x = z + H u, H = 2^e, the equation is A y'' + B y' + C y = F, ' = d/du, A = a/a(z), B = H b/a(z), C = H^2 c/a(z),
F = H^2 f/a(z).  Where a function is analytic for |u| <= R, bounded by M, which a box that contains the disc shows, its
coefficients are at most M R^-n [Cauchy], and the rest of its series after N terms is at most M R^-N R/(R - 1) for |u| <= 1.
The coefficients themselves are those of power series in balls.  A polynomial has no rest: a isn't 1 where b and c would be over
a polynomial.

Let A~, B~, C~, F~ be these polynomials, and Y the polynomial of degree n - 1 that the recurrence

    (k+1)(k+2) a_(k+2) = F~_k - sum_(j>=1) A~_j (k+2-j)(k+1-j) a_(k+2-j) - sum_j B~_j (k+1-j) a_(k+1-j) - sum_j C~_j a_(k-j)

gives, in balls.  The defect r = A~ Y'' + B~ Y' + C~ Y - F~ has no terms below u^(n-2), so that its size is bounded by sums of
absolute values; the rests of A, B, C and F are added.  With |A| >= mu the error e satisfies
|e''| <= beta |e'| + gamma |e| + rho on every ray, beta, gamma and rho the bounds of B, C and r over mu, so

    |e|, |e'| <= rho exp(lambda),    lambda = (beta + (beta^2 + 4 gamma)^(1/2))/2,

by comparison with the solution z of z'' = beta z' + gamma z + rho, z(0) = z'(0) = 0, z <= z' <= rho exp(lambda) on [0, 1].

Reference: R. E. Moore, "Interval Analysis", Prentice-Hall 1966, chapter 11 (series in intervals); W. Walter, "Differential and
Integral Inequalities", Springer 1970 (the comparison).

Removable singularities of coefficients: sin(x)/x at 0, (1 - cos(x))/x^2, x/(exp(x) - 1), cot(x) - 1/x.  A coefficient is a
quotient n/d of functions that are analytic at z, and vanish there to the orders k and l at least: this is decided exactly, by
their derivatives at z as SymPy evaluates them (sin(0) = 0).  With N = n/(x - z)^k and D = d/(x - z)^l it is
(x - z)^(k - l) N/D.  Where g = n or d has the series sum g_j u^j at z, u = x - z, and is bounded by M for |u| <= R,

    g/u^k = sum_(j<T) g_(j+k) u^j + tail,    |tail| <= M R^-k 2^(1-T)    for |u| <= R/2                              [Cauchy],

with the first k coefficients 0 exactly.  Farther from z it is the quotient itself.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy
from flint import acb, acb_poly, acb_series, arb, arb_poly, ctx, fmpq

from kovacic.algebra.precision import series_length, working_precision
from kovacic.closed_form.jets import BallEvaluator
from kovacic.enclosure.frame import log2
from kovacic.enclosure.matrices import adjugate, inverse_matrix
from kovacic.enclosure.points import ExactPoint, are_real, around_zero, binary_exponent, to_acb
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.way import Local, Step, check_terms, disc_step
from kovacic.limits import MOST_TRIALS, check_time, manageable

_QUOTIENTS = {
    sympy.tan: lambda u: sympy.sin(u) / sympy.cos(u),
    sympy.cot: lambda u: sympy.cos(u) / sympy.sin(u),
    sympy.sec: lambda u: 1 / sympy.cos(u),
    sympy.csc: lambda u: 1 / sympy.sin(u),
    sympy.coth: lambda u: sympy.cosh(u) / sympy.sinh(u),
    sympy.csch: lambda u: 1 / sympy.sinh(u),
}


class Divided(sympy.Function):  # type: ignore[misc]
    """g/((x - z1)^k1 (x - z2)^k2 ...), of g, x, z1, k1, z2, k2, ...: analytic where g is."""

    @classmethod
    def eval(cls, *_arguments: Any) -> None:
        """It stays."""


def without_removable(e: Any, x: Any) -> Any:
    """The function without removable singularities at the zeros of its polynomial factors."""
    if not e.has(x) or e.is_rational_function(x):  # in lowest terms; else a first value takes a sixth more
        return e
    plain = e
    for function, quotient in _QUOTIENTS.items():
        plain = plain.replace(function, quotient)
    numerator, denominator = sympy.fraction(sympy.together(plain))
    # n/d = (x - z)^(k - m) N/D with N = n/(x - z)^k and D = d/(x - z)^m, for all common zeros z at once.
    over: list[Any] = []  # zeros and their orders, as arguments of `Divided`
    under: list[Any] = []
    power = sympy.Integer(1)
    for zero in _rational_zeros(numerator, x) | _rational_zeros(denominator, x):
        k = _order_of_zero(numerator, x, zero)
        m = _order_of_zero(denominator, x, zero)
        if k > 0 and m > 0:
            over += [zero, k]
            under += [zero, m]
            power *= (x - zero) ** (k - m)
    return power * Divided(numerator, x, *over) / Divided(denominator, x, *under) if over else e


def _rational_zeros(product: Any, x: Any) -> set[Any]:
    """The zeros of linear factors over Q of its polynomial factors."""
    found: set[Any] = set()
    for factor in sympy.Mul.make_args(product):
        base, _ = factor.as_base_exp()
        if base.has(x) and base.is_polynomial(x):
            found.update(sympy.Poly(base, x).ground_roots())
    return found


def _order_of_zero(function: Any, x: Any, zero: Any) -> int:
    """A lower bound of the order of the zero: of a sum the number of derivatives, from itself on, that are 0 there."""
    if function.is_Mul:
        return sum(_order_of_zero(factor, x, zero) for factor in function.args)
    if function.is_Pow and function.exp.is_Integer:
        return max(0, int(function.exp)) * _order_of_zero(function.base, x, zero)
    # Exact, by automatic evaluation: sin(0) is 0.  What isn't seen to be 0 isn't divided.
    order = 0
    while function.xreplace({x: zero}) == 0 and order < MOST_TRIALS and manageable(function):
        function = function.diff(x)
        order += 1
    return order


class CoefficientEvaluator(BallEvaluator):
    """Values of coefficients at values of the variable and of parameters, with the functions that were divided."""

    def __init__(self, values: Mapping[Any, Any], *, variable: Any, analytic: bool = False) -> None:
        super().__init__(values, analytic=analytic)
        self.variable = variable

    def depends(self, argument: Any) -> bool:
        """A parameter is a number: log(a) with a = -2 is a constant."""
        return bool(argument.has(self.variable))

    def _evaluated(self, e: Any) -> Any:
        """A polynomial on a ball by its Taylor polynomial at the midpoint, since terms that cancel would widen it; a sine or a
        cosine by the mean value theorem, where that is sharper: beside a zero of its slope."""
        x: Any = self.values.get(self.variable)
        if not isinstance(x, acb):
            return super()._evaluated(e)
        coefficients = _polynomial_coefficients(e, self.variable) if e.is_Add else None
        if coefficients is not None:
            middle = acb(x.mid())
            return acb_poly(list(map(self, coefficients)))(acb_poly([middle, 1]))(x - middle)
        found = super()._evaluated(e)
        if e.func not in (sympy.sin, sympy.cos):
            return found
        z: Any = self(e.args[0])
        middle = acb(z.mid())
        value, slope = (middle.sin(), z.cos()) if e.func is sympy.sin else (middle.cos(), -z.sin())
        return max(found, value + slope * (z - middle), key=acb.rel_accuracy_bits)

    def other(self, e: Any) -> Any:
        if not isinstance(e, Divided):
            return super().other(e)
        function, symbol, *rest = e.args
        x = self.values[symbol]
        pairs = list(zip(map(self, rest[::2]), map(int, rest[1::2]), strict=True))
        near = next((pair for pair in pairs if _is_close(x, pair[0])), None)
        value = None if near is None else self._near(function, symbol, x, *near)
        if value is None:
            near, value = None, self(function)
        for zero, k in pairs:
            if (zero, k) != near:
                value = value / (x - zero) ** k
        return value

    def _near(self, function: Any, symbol: Any, x: Any, zero: acb, k: int) -> Any:
        """The function over (x - zero)^k, by its series there; None unless it is proven to be analytic around."""
        # A ball counts as a series of one term.
        centre, scale, length = (x[0] - zero, x[1], ctx.cap) if isinstance(x, acb_series) else (x - zero, acb(0), 1)
        # Around the zero, so far that |u| <= 2 is within; the function is bounded on twice that.
        reach = (abs(centre) + 2 * abs(scale)).upper()
        # At the zero itself any reach will do for which the disc is free of other singularities.
        reaches = [arb((1, -k)) for k in range(1, ctx.prec)] if reach.is_zero() else [reach]
        for reach in reaches:
            # A bound in a disc; infinite unless the function is proven to be analytic there.
            box = zero + around_zero(2 * reach, real=False)
            around = CoefficientEvaluator({**self.values, symbol: box}, variable=symbol, analytic=True)
            size = abs(around(function)).upper()
            if size.is_finite():
                break
        else:
            return None
        terms = ctx.prec + 8
        with series_length(terms + k):
            beside = CoefficientEvaluator({**self.values, symbol: acb_series([zero, acb(1)])}, variable=symbol)
            given = beside(function).coeffs()
        # The first k are 0 exactly, and the others are those of g/u^k.
        coefficients = [*given, *[acb(0)] * (terms + k - len(given))][k:]
        tail = (size / (2 * reach) ** k * arb((1, 1 - terms))).upper()
        polynomial = acb_poly(coefficients)
        inside = zero + arb(0, reach)
        values = CoefficientEvaluator({**self.values, symbol: inside}, variable=symbol)
        error = around_zero(tail, real=are_real([inside, centre, scale, values(function)]))
        # With x = centre + scale u the bound of the rest holds for |u| <= 2, so that of its j-th coefficient is 2^-j of it
        # [Cauchy].
        moved = polynomial(acb_poly([centre, scale]))
        found = [moved[j] + error / 2**j for j in range(length)]
        return acb_series(found) if isinstance(x, acb_series) else found[0]


@lru_cache(maxsize=1024)
def _polynomial_coefficients(e: Any, x: Any) -> list[Any] | None:
    """Those of a polynomial of some degree from 2 on, from low to high; None for other expressions."""
    if not e.is_polynomial(x):
        return None
    polynomial = sympy.Poly(e, x)
    # One of a high degree usually has few terms, which are evaluated as they stand.
    found: list[Any] = polynomial.all_coeffs()[::-1] if polynomial.degree() < 60 else []
    return found if len(found) > 2 else None


def _is_close(x: Any, zero: acb) -> bool:
    """True unless the quotient is sharp: at a distance above 1/2, and above the radius of a ball."""
    if isinstance(x, acb_series):
        return not abs(x[0] - zero) > 2 * abs(x[1]) + 0.5
    distance = abs(x - zero)
    return not (distance.lower() > 0.5 and distance.lower() > distance.rad())


#: Bits of bounds.
_BITS_OF_BOUNDS = 64
#: Bits for roundings, in addition to those of the growth.
_SPARE_BITS = 28
#: Bounds by boxes are too large by about this factor.
_EXCESS_OF_BOXES = 4.0
#: Terms of a recurrence that are computed one by one.
_ONE_BY_ONE = 6
#: Successive slopes that are small at the end of a series.
_SMALL_AT_THE_END = 8


@dataclass(frozen=True)
class Jets:
    """A~ - 1, B~, C~, F~ in the disc around `centre`, bounds of the rests, mu (`least`) and lambda (`rate`), for solutions to
    this number of `bits`, computed at this `precision`."""

    centre: ExactPoint
    e: int
    parts: Sequence[Any]
    rests: Sequence[arb]
    least: arb
    rate: arb
    bits: int
    precision: int


class CoefficientField:
    """The coefficients as functions in balls."""

    def __init__(self, coefficients: Coefficients) -> None:
        self.coefficients = coefficients
        x = coefficients.variable
        self._parts = [
            without_removable(part, x) for part in (sympy.sympify(coefficients.a, strict=True), *coefficients.parts)
        ]
        # Of polynomials, 0 for zero; None for other functions.
        self._degrees = [
            int(max(0, sympy.Poly(part, x).degree())) if part.is_polynomial(x) else None for part in self._parts
        ]

    def all_values(self, x: Any, *, analytic: bool = False) -> list[Any]:
        """a, b, c and f at a ball or a series; not finite where one of them isn't analytic, with `analytic`."""
        return [*map(self._evaluator(x, analytic=analytic), self._parts)]

    def _evaluator(self, x: Any, *, analytic: bool = False) -> CoefficientEvaluator:
        return CoefficientEvaluator(self.coefficients.at(x), variable=self.coefficients.variable, analytic=analytic)

    def values(self, x: acb, *, analytic: bool = False) -> list[Any]:
        """b, c and f over a at a ball."""
        a, *others = self.all_values(x, analytic=analytic)
        return [part / a for part in others]

    def is_real(self, centre: ExactPoint, e: int) -> bool:
        """True if the coefficients, analytic in the disc with the scale 2^e, are proven to be real on its real diameter."""
        # By the identity theorem a short interval tells of the whole diameter.
        return centre.is_real() and are_real(self.all_values(to_acb(centre) + arb(0, arb((1, e - 6)))))

    def is_regular(self, x: acb) -> bool:
        """True if the coefficients are provably analytic on the ball."""
        return all(value.is_finite() for value in self.values(x, analytic=True))

    def sizes(self, centre: ExactPoint, radius: arb) -> list[arb] | None:
        """Bounds of |b|, |c| and |f| over |a| in a disc, or None unless they are proven to be analytic there."""
        return _sizes(self.values(_box(centre, radius), analytic=True))

    def crowd(self, x: acb, e: int, steepest: float) -> float:
        """The least number of discs on a unit of length at x, by the largest scale up to 2^e whose bounds `jets` admits, or NaN
        if it admits none."""
        with working_precision(_BITS_OF_BOUNDS):
            for k in range(_BITS_OF_BOUNDS):
                h = arb((1, e - k))
                near = _sizes(self.values(x + around_zero(h, real=False), analytic=True))
                if near is not None and _growth_rate(near, h) <= _EXCESS_OF_BOXES * steepest:
                    return float(1 / (2 * h))
        return math.nan

    def jets(self, centre: ExactPoint, e: int, prec: int, steepest: float) -> Jets | None:
        """The series for solutions to about 2^-prec; None if the disc of twice this scale has a singularity, lambda is above
        `steepest`, or a function grows so much that its series would be long or cancel."""
        # Bits by which the centre is longer than the details around it.
        longer = max(0, binary_exponent(centre.norm_squared()) // 2 - e) if centre != ExactPoint(0) else 0
        with working_precision(_BITS_OF_BOUNDS + longer):
            h = arb((1, e))
            near = self.sizes(centre, h)
            if near is None:
                return None
            rate = _growth_rate(near, h)
            if not rate <= _EXCESS_OF_BOXES * steepest:
                return None
            inner = self.sizes(centre, h / 4)
            # Next to a solution of size 1, a right-hand side below 1 doesn't count.
            if inner is None or not near[2] * h * h <= (inner[2] * h * h).max(arb(1)) * arb(steepest).exp():
                return None
            growth = int(min(steepest, float(rate)) / math.log(2))  # in bits
            bits = prec + growth + _SPARE_BITS
            # An error of dy/du counts for y beyond a small disc, over its size; but not where the coefficients are small.
            lost = max(0, min(-e, int(-log2(rate)))) if rate > 0 else 0
            # The rests are multiplied by the sum of the |a_k|, which is as large as the growth, and by that of the error.
            precision = bits + growth + _SPARE_BITS
            terms, rests = self._truncated(centre, h, precision + lost)
        with working_precision(precision + longer):
            parts = self.series(centre, e, terms) if terms else None
        if parts is None:
            return None
        with working_precision(_BITS_OF_BOUNDS):
            a = self._evaluator(to_acb(centre))(self._parts[0])
            rests = [(rest / abs(a).lower()).upper() for rest in rests]
            sizes = [_absolute_values(part.coeffs())(1) + rest for part, rest in zip(parts, rests, strict=True)]
            # |A| >= 1 - |A - 1|.
            least = (1 - sizes[0]).lower()
            if not least > 0.25:
                return None
            rate = _growth_rate([(size / least).upper() for size in sizes[1:]], arb(1))
        return Jets(centre, e, parts, rests, least, rate, bits, precision) if rate <= steepest else None

    def _truncated(self, centre: ExactPoint, h: arb, bits: int) -> tuple[int, list[arb]]:
        """The number of terms of A, B, C and F that leaves rests below 2^-bits, and bounds of the rests, times a(z).

        It is 0 if there is a singularity within twice the disc, or functions are as large as 2^bits beside the way.
        """
        longest = max(degree or 0 for degree in self._degrees) + 1
        if None not in self._degrees:
            return longest, [arb(0)] * len(self._parts)
        found = []
        # On a larger disc that is free of singularities fewer terms are needed.
        for radius in (2, 3, 4, 6, 8, 12, 16):
            sizes = _sizes(self.all_values(_box(centre, h * radius), analytic=True))
            if sizes is None:
                break
            scaled = [
                size * factor if degree is None else arb(0)
                for size, factor, degree in zip(sizes, (arb(1), h, h * h, h * h), self._degrees, strict=True)
            ]
            largest = max(scaled)
            needed = log2(largest) + bits + 1 if largest > 0 else 0.0
            terms = max(4, int(needed / math.log2(radius)) + 2)
            # R^-N R/(R - 1) for N terms: times M it bounds the rest for |u| <= 1.
            share = arb(radius) ** (1 - terms) / (radius - 1)
            found.append((terms, [(size * share).upper() for size in scaled]))
        terms, rests = min(found, key=lambda choice: choice[0], default=(0, []))
        return (max(terms, longest), rests) if 0 < terms <= 2 * bits else (0, [])

    def series(self, centre: ExactPoint, e: int, terms: int) -> list[Any] | None:
        """The first `terms` coefficients of A - 1, B, C and F, or None if they aren't finite."""
        H = arb((1, e))
        try:
            with series_length(terms):
                values = self.all_values(acb_series([to_acb(centre), H]))
                rows = [value.coeffs() if isinstance(value, acb_series) else [value] for value in values]
        except (ZeroDivisionError, ValueError):
            return None
        # a(z) is the first coefficient of a: A = a/a(z), B = H b/a(z), C = H^2 c/a(z), F = H^2 f/a(z).
        scale = 1 / rows[0][0]
        factors = (scale, scale * H, scale * H**2, scale * H**2)
        rows = [[value * factor for value in row] for row, factor in zip(rows, factors, strict=True)]
        # Exactly: it would be a ball around 0.
        rows[0][0] = acb(0)
        if not all(value.is_finite() for row in rows for value in row):
            return None
        if self.is_real(centre, e):
            return [arb_poly([value.real for value in row]) for row in rows]
        return [acb_poly(row) for row in rows]


def _box(centre: ExactPoint, radius: arb) -> acb:
    """A box that contains a disc."""
    return to_acb(centre) + around_zero(radius, real=False)


def _sizes(values: list[Any]) -> list[arb] | None:
    """Bounds of the absolute values; None if one isn't finite."""
    found = [abs(value).upper() for value in values]
    return found if all(size.is_finite() for size in found) else None


def _growth_rate(sizes: Sequence[arb], h: arb) -> arb:
    """lambda, by bounds of |b| and |c| over |a|: beta = h |b| and gamma = h^2 |c|."""
    beta, gamma = sizes[0] * h, sizes[1] * h * h
    return ((beta + (beta * beta + 4 * gamma).sqrt()) / 2).upper()


def step_of(jets: Jets, enter: ExactPoint, leave: ExactPoint) -> Step:
    """The disc of a way that is entered and left at these points."""
    _, B, _, F = jets.parts
    # Without rests a part is exactly zero; without B the Wronskian is constant.
    own = None if F.degree() < 0 and jets.rests[3].is_zero() else _solution(jets, None)
    inverse = adjugate if B.degree() < 0 and jets.rests[1].is_zero() else inverse_matrix
    return disc_step(enter, leave, (_solution(jets, 0), _solution(jets, 1)), own, inverse)


def _solution(jets: Jets, start: int | None) -> Local:
    """The solution with the state (1, 0) or (0, 1) at the centre, or with the right-hand side and (0, 0)."""
    A, B, C, F = jets.parts
    number = arb if isinstance(F, arb_poly) else acb
    right = F if start is None else F * 0
    with working_precision(jets.precision):
        # a_0 and a_1: 1, 0 or 0, 1; with the right-hand side (start is None) 0, 0.
        first = [number(start == k) for k in (0, 1)]
        values = _coefficients((A, B, C), right, first, jets.bits)
        scale = arb((1, jets.e if start == 1 else 0))  # the slope 1 in x
        poly = type(F)(values) * scale
    with working_precision(_BITS_OF_BOUNDS):
        # rho: the defect has no terms below u^(n - 2) but the rests.
        y = _absolute_values(values)
        slope = y.derivative()
        rho = arb(0) if right.degree() < 0 else jets.rests[3]
        total = _absolute_values(right.coeffs())
        for part, rest, series in zip(jets.parts, jets.rests, (slope.derivative(), slope, y), strict=False):
            total += _absolute_values(part.coeffs()) * series
            rho += rest * series(1)
        rho += sum(total.coeffs()[len(values) - 2 :], arb(0))
        error = (rho / jets.least * jets.rate.exp() * scale).upper()
    return Local(jets.centre, jets.e, poly, error, error, fmpq(1), jets.precision)


def _absolute_values(values: list[Any]) -> arb_poly:
    """The polynomial with the absolute values as its coefficients: at 1 it bounds that with the values for |u| <= 1."""
    return arb_poly([abs(value).upper() for value in values])


def _coefficients(parts: Sequence[Any], right: Any, values: list[Any], bits: int) -> list[Any]:
    """The coefficients a_k, from a_0 and a_1 on, by halving: what the first half gives to the second is a product of
    polynomials.

    With the coefficients d_k = (k+1) a_(k+1) of Y' and e_k = (k+1) d_(k+1) of Y'', and A_0 = 0 in place of 1,
    s_k = sum_j (A_(k-j) e_j + B_(k-j) d_j + C_(k-j) a_j) - F_k is -e_k.
    """
    kind = type(right)
    slopes = values[1:]
    bends: list[Any] = []
    # A goes with Y'', B with Y' and C with Y.
    series = bends, slopes, values
    terms = [(part.coeffs(), known) for part, known in zip(parts, series, strict=True) if part.degree() >= 0]
    zero = values[0] * 0
    sums = defaultdict(lambda: zero, {k: -value for k, value in enumerate(right.coeffs())})
    least = max(_SMALL_AT_THE_END + 2, len(sums), *(len(part) for part, _ in terms), 0)

    def is_ended(low: int, high: int) -> bool:
        """The steps k = low, ..., high - 1, or up to the end, where what comes from j < low is in the sums."""
        if high - low > _ONE_BY_ONE:
            middle = (low + high) // 2
            if is_ended(low, middle):
                return True
            # What comes from j = low, ..., middle - 1 to the sums k = middle, ..., high - 1.
            product = kind([])
            for part, known in terms:
                product += kind(part[: high - low]) * kind(known[low:middle])
            for k, value in enumerate(product.coeffs()[middle - low : high - low], start=middle):
                sums[k] += value
            return is_ended(middle, high)
        for k in range(low, high):
            total = sums[k]
            for part, known in terms:
                for j in range(max(low, k + 1 - len(part)), min(k + 1, len(known))):
                    total += part[k - j] * known[j]
            # e_k = -s_k, d_(k+1) = e_k/(k + 1), a_(k+2) = d_(k+1)/(k + 2).
            bends.append(-total)
            slopes.append(-total / (k + 1))
            values.append(slopes[-1] / (k + 2))
        check_time()
        check_terms(len(values), bits)
        last = slopes[-_SMALL_AT_THE_END:]  # where these are small, the others are, too
        return len(values) > least and all(abs(value) < arb((1, -bits)) for value in last)

    is_ended(0, _ONE_BY_ONE << 40)  # no series is so long
    return values

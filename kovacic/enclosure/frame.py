"""The normal form, its singular points, and the equation seen from the centre of a disc, with bounds there.

With x = c + H u the equation is q(u) y'' = p(u) y over Z[i]: `shift` gives it exactly.  A `Frame` has this equation for a disc
|u| <= 1 without singular points (and 2^-16 more, for rounded points), and the majorant z'' = sigma z + rho of
`kovacic.enclosure.taylor`, with, on |u| <= r,

    |p| <= sum |p_j| r^j,    |q| >= q_0 prod (1 - r/|zeta|),    sigma >= |p/q|,

zeta the zeros of q, enclosed; r runs through at most eight rings.  The bounds are computed in balls of 64 bits.

Symbols: c centre, H = 2^e scale, u = (x - c)/H.

A `System` is the normal form den y'' = num y with integer coefficients.  The zeros of den (the singular points) and of num are
enclosed by FLINT's certified isolation (`fmpz_poly.complex_roots`: pairwise disjoint rectangles, one zero in each) and refined
when a distance cannot be told from zero.  Whether a path meets a singular point is decided exactly, by Sturm-free real root
isolation of the common factor of two polynomials over Q.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any, Literal

from flint import acb, acb_poly, arb, arb_poly, fmpq_poly, fmpz_poly

from kovacic.algebra.embedding import Zeros, complex_zeros
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly, foresee_move, to_fraction
from kovacic.enclosure.matrices import Affine, apply, state_image
from kovacic.enclosure.points import ExactPoint, midpoint, power_of_two, to_acb
from kovacic.errors import InputError
from kovacic.limits import check_time

_DISTANCE_BITS = 40  # relative bits to which the distances of singular points are known
_FRAME_BITS = 64
_RINGS = 8
REACH = 1 + power_of_two(-16)  # radius of the disc on which bounds hold, in scales
_MOST_GROWTH = 2400  # growth of the majorant, in logarithms, at most
# Shares of a way at which a rate is sampled.
_NEAR_ENDS = [2.0**-k for k in (5, 6, 7, 8, 10, 12, 16, 24, 40)]
_MARKS = sorted([0.0, 1.0, *(k / 16 for k in range(1, 16)), *_NEAR_ENDS, *(1 - t for t in _NEAR_ENDS)])
# Real and imaginary parts of the coefficients; None if all of the latter are zero
GaussianParts = tuple[list[int], list[int] | None]
Which = Literal["num", "den"]


@dataclass(frozen=True)
class System:
    """den y'' = num y: integer coefficients, low to high, without a common factor, den not zero.

    >>> from kovacic.algebra.rationals import QQ
    >>> System.of(RatFunc(QQ.poly([2]), QQ.poly([0, 0, 4])))   # S = 2/(4 x^2)
    System(num=(1,), den=(0, 0, 2))
    """

    num: tuple[int, ...]
    den: tuple[int, ...]

    @classmethod
    def of(cls, function: RatFunc) -> System:
        """A rational function over Q, as num/den; raises InputError over another field."""
        if not isinstance(function.num, RationalPoly) or not isinstance(function.den, RationalPoly):
            raise InputError(
                "numerical evaluation needs S with rational coefficients (no parameters, no algebraic constants)"
            )
        # (p/d1)/(q/d2) = p d2/(q d1) with integer coefficients, where p and q are coprime.
        p, q = function.num.rep, function.den.rep
        num, den = p.numer() * q.denom(), q.numer() * p.denom()
        content = math.gcd(int(num.content()), int(den.content()))
        return cls(*(tuple(int(c) for c in (part // content).coeffs()) for part in (num, den)))

    def along(self, which: Which, a: ExactPoint, step: ExactPoint) -> tuple[fmpq_poly, fmpq_poly]:
        """Real and imaginary part of numerator or denominator at a + t step, as polynomials in t over Q, by Horner's rule."""
        coefficients: tuple[int, ...] = getattr(self, which)
        # Raises before numbers are made that would fill the memory.
        bits = max((c.bit_length() for c in coefficients), default=0)
        foresee_move(len(coefficients), bits, max(a.height_bits(), step.height_bits()))
        x = fmpq_poly([a.x, step.x])
        y = fmpq_poly([a.y, step.y])
        if y == 0:
            return fmpq_poly(list(coefficients))(x), fmpq_poly([])
        real = imag = fmpq_poly([])
        for c in reversed(coefficients):
            check_time()
            real, imag = real * x - imag * y + c, real * y + imag * x
        return real, imag

    def roots(self, which: Which, prec: int) -> Zeros:
        """Enclosures of the zeros of numerator or denominator at about `prec` bits, with multiplicities."""
        # Rounded up to a power of two, so that nearby precisions share the cache.
        return isolated_zeros(getattr(self, which), max(64, 1 << (prec - 1).bit_length()))

    def is_singular(self, point: ExactPoint) -> bool:
        """True if the point is a zero of the denominator, decided exactly."""
        if point.is_real():
            return bool(fmpz_poly(list(self.den))(point.x) == 0)
        return all(part == 0 for part in self.along("den", point, ExactPoint(0)))


@lru_cache(maxsize=64)
def isolated_zeros(coefficients: tuple[int, ...], prec: int) -> Zeros:
    """Enclosures of the zeros of a polynomial, kept for the next call at this precision."""
    with working_precision(prec):
        return complex_zeros(fmpz_poly(list(coefficients)))


def offsets(system: System, centre: ExactPoint) -> Zeros:
    """The singular points seen from `centre`, none of them, (point - centre) to 40 relative bits at least, with their
    multiplicities."""
    # The digits of the centre may cancel in the differences.
    prec = 64 + min(centre.height_bits(), 1 << 14)
    while True:
        with working_precision(max(128, prec)):
            here = to_acb(centre)
            found = tuple((root - here, k) for root, k in system.roots("den", prec))
        if all(d.rel_accuracy_bits() >= _DISTANCE_BITS for d, _ in found):
            return found
        prec *= 2


def is_apart(system: System, *points: ExactPoint) -> bool:
    """True if no singular point lies in the convex hull of these: each is beyond all of them in some direction."""
    with working_precision(128):
        left = [root for root, _ in system.roots("den", 128)]
        for a, b in combinations(points, 2):
            # In the direction of each side, and across it.
            along = b - a
            across = ExactPoint(a.y - b.y, along.x)
            left = _not_beyond(_not_beyond(left, points, along), points, across)
    return not left


def _not_beyond(zeros: list[acb], points: Sequence[ExactPoint], direction: ExactPoint) -> list[acb]:
    """The zeros that aren't certain to be beyond all points in this direction."""
    reach = [direction.x * p.x + direction.y * p.y for p in points]
    low, high, x, y = map(arb, (min(reach), max(reach), direction.x, direction.y))
    places = [(z, x * z.real + y * z.imag) for z in zeros]
    return [z for z, place in places if not (low > place or place > high)]


def check_segment(system: System, a: ExactPoint, b: ExactPoint) -> None:
    """Raise InputError if the closed segment from a to b contains a singular point; the message names it and its distance."""
    if len(system.den) == 1:
        return
    for name, point in (("start", a), ("end", b)):
        if system.is_singular(point):
            raise InputError(
                f"the {name} {point} of the path is a singular point of the equation (distance 0)",
                hint="choose a point beside it; the solutions aren't analytic there",
            )
    if a == b or is_apart(system, a, b):
        return
    meeting = _first_meeting(system, a, b)
    if meeting is None:
        return
    name, share = meeting
    distance = share * math.sqrt(to_fraction((b - a).norm_squared()))
    raise InputError(
        f"the path from {a} to {b} runs through the singular point {name} (distance 0; {distance:.6g} from the start)",
        hint="go around it through the complex plane: path='above' or 'below', or path=[...] with a vertex off "
        "the axis; the result depends on the side",
        shell="go around it through the complex plane: --path above or --path below; the result depends on the side",
    )


def _first_meeting(system: System, a: ExactPoint, b: ExactPoint) -> tuple[str, float] | None:
    """The name of the first singular point on the segment, whose ends are regular, and the share of the way to it; or None.

    Exact: with z = x or, on a vertical line, z = iy for its points, den(z + ...) = A + i B with A, B in Q[x] or Q[y]; the line
    is singular where gcd(A, B), on the real axis the denominator itself, has a real zero.
    """
    step = b - a
    first, length = (a.x, step.x) if step.x != 0 else (a.y, step.y)
    # The abscissa, or on a vertical line the ordinate, is the parameter.
    unit = step.scaled(1 / length)
    real, imaginary = system.along("den", a - unit.scaled(first), unit)
    coefficients = tuple(int(c) for c in real.gcd(imaginary).numer().coeffs())
    if len(coefficients) <= 1:
        return None
    prec = 128
    while True:
        zeros = isolated_zeros(coefficients, prec)
        with working_precision(prec):
            # Real zeros only: where both parts vanish at a real parameter.
            shares = [(z.real - first) / length for z, _ in zeros if z.imag.is_zero()]
            inside = [share for share in shares if not (share < 0 or share > 1)]
            if not inside:
                return None
            share = min(inside, key=lambda ball: float(ball.mid()))
            if not (share.contains(0) or share.contains(1)):  # the ends were excluded exactly: else refine
                return name_of(system, to_acb(a) + to_acb(step) * share), float(share.mid())
        prec *= 2


def name_of(system: System, point: acb) -> str:
    """The singular point in this ball, in words: its exact value if that is a short Gaussian rational, else 12 digits."""
    middle = midpoint(point)
    guess = ExactPoint(*(part.limit_denominator(10**9) for part in (middle.re, middle.im)))
    if point.overlaps(to_acb(guess)) and system.is_singular(guess):
        return str(guess)
    re, im = (part.mid().str(12, radius=False) + "..." for part in (point.real, point.imag))
    return re if point.imag.contains(0) else f"{re} + {im}i"


def shift(system: System, centre: ExactPoint, scale: ExactPoint) -> tuple[GaussianParts, GaussianParts]:
    """p and q of the exact equation q y'' = p y in the variable (x - centre)/scale, with q_0 > 0, without a common factor."""
    q = system.along("den", centre, scale)
    p = system.along("num", centre, scale)
    # q_0 times its conjugate is positive; if q_0 is real its sign suffices.
    re, im = q[0][0], q[1][0]
    turn = ExactPoint(re, -im) if im != 0 else ExactPoint(1 if re > 0 else -1)
    # y_uu = scale^2 y_xx: p is multiplied by scale^2, and both by the turn.
    parts = [*_multiplied(p, scale * scale * turn), *_multiplied(q, turn)]
    common = math.lcm(*(int(part.denom()) for part in parts))
    integral = [(part * common).numer() for part in parts]
    content = math.gcd(*(int(part.content()) for part in integral))
    p_re, p_im, q_re, q_im = ([int(c) for c in (part // content).coeffs()] for part in integral)
    return _gaussian_parts(p_re, p_im), _gaussian_parts(q_re, q_im)


def _multiplied(part: tuple[fmpq_poly, fmpq_poly], factor: ExactPoint) -> tuple[fmpq_poly, fmpq_poly]:
    # (A + i B)(x + i y).
    return part[0] * factor.x - part[1] * factor.y, part[0] * factor.y + part[1] * factor.x


def _gaussian_parts(re: list[int], im: list[int]) -> GaussianParts:
    if not im:
        return re, None
    size = max(len(re), len(im))
    return re + [0] * (size - len(re)), im + [0] * (size - len(im))


def coefficient_sum(parts: GaussianParts) -> int:
    """The sum of the absolute values of the coefficients (of both parts), a bound of the polynomial for |u| <= 1."""
    re, im = parts
    return sum(map(abs, re)) + sum(map(abs, im or []))


@dataclass(frozen=True)
class DefectBound:
    """Bounds for e'' = S e + r/q, e(0) = e'(0) = 0, on a disc around 0, as exact balls.

    With |r| <= q(0) on the disc, |e| <= `gain` and |e'| <= `slope_gain`; `log2_least` is about log2 of the least |q/q(0)|, and
    `log2_growth` about log2 of the growth of the solutions.
    """

    gain: arb
    slope_gain: arb
    log2_least: float
    log2_growth: float


@dataclass(frozen=True)
class Frame:
    """The equation q y'' = p y in u, x = c + H u, H = 2^e, and the bounds for |u| <= 1."""

    centre: ExactPoint
    e: int
    p: GaussianParts
    q: GaussianParts
    bound: DefectBound

    @property
    def scale(self) -> Any:
        """H, exactly."""
        return power_of_two(self.e)

    def seen(self, x: ExactPoint) -> ExactPoint:
        """u at x; raises ArithmeticError where the bounds don't hold."""
        u = (x - self.centre).scaled(power_of_two(-self.e))
        if u.norm_squared() > REACH * REACH:
            raise ArithmeticError("the target lies outside of its disc")
        return u


def make_frame(
    system: System, centre: ExactPoint, e: int, share: float = 1.0, growth: float = math.inf
) -> Frame | None:
    """The frame of the equation at `centre` with scale 2^e; None if this may be more than `share` of the distance to a
    singular point, or if the solutions grow by more than 2^growth, or far too much for bounds."""
    if system.is_singular(centre):
        return None
    with working_precision(_FRAME_BITS):
        poles = [((abs(d) * arb((1, -e))).lower(), k) for d, k in offsets(system, centre)]
        if not all(size > 1 and size * share >= 1 for size, _ in poles):
            return None
        p, q = shift(system, centre, ExactPoint(power_of_two(e)))
        bound = _defect_bound(p, q[0][0], poles)
        if bound is None or bound.log2_growth > growth:
            return None
        return Frame(centre, e, p, q, bound)


def _defect_bound(p: GaussianParts, q_0: int, poles: list[tuple[arb, int]]) -> DefectBound | None:
    """The bounds for poles of these sizes and multiplicities, or None if the solutions may grow too much."""
    sizes = [arb(a * a + b * b).sqrt().upper() for a, b in zip(p[0], p[1] or [0] * len(p[0]), strict=True)]
    majorant = arb_poly(sizes) * (1 / arb(q_0))

    def bounds(r: arb) -> tuple[arb, arb]:  # of |q/q_0| from below and of |p/q| from above, for |u| <= r
        least = arb(1)
        for size, k in poles:
            least *= (1 - r / size) ** k
        return least, (majorant(r) / least).upper()

    least, sigma = bounds(arb(REACH))
    # The last ring has the least |q| and the largest sigma.
    if not (least > 0 and sigma < _MOST_GROWTH**2):
        return None
    rings = min(_RINGS, 1 + int(float(sigma.sqrt().upper())))  # growth by exp(1) in each, or more
    # The majorant is constant on each ring: its largest value, at the outer end.
    delta = arb(REACH) / rings
    error: Any = (arb(0), arb(0))  # z and z' for z'' = sigma z + 1
    growth: Any = (arb(1), arb(1))  # and for z'' = sigma z
    for j in range(rings):
        _, sigma = bounds(delta * (j + 1))
        ring = _over_a_ring(sigma, delta)
        error = state_image(ring, error)
        growth = apply(ring[0], growth)
    total = max(growth[0].upper(), growth[1].upper())
    return DefectBound((error[0] / least).upper(), (error[1] / least).upper(), log2(least), log2(total))


def _over_a_ring(sigma: arb, delta: arb) -> Affine:
    """The map of (z, z') for z'' = sigma z + 1 over a ring of width delta, from its inner to its outer end."""
    # With t = sigma^(1/2) delta: cosh t, delta sinh(t)/t and delta^2 (cosh t - 1)/t^2, where cosh t - 1 = 2 sinh(t/2)^2.
    t = sigma.sqrt() * delta
    cosh = t.cosh()
    rise, push = delta, delta * delta / 2
    if t > 0:
        rise = delta * (t.sinh() / t)
        push = delta * delta * (2 * ((t / 2).sinh() / t) ** 2)
    return (cosh, rise, sigma * rise, cosh), (push, rise)


def largest_exponent(system: System, point: ExactPoint) -> int | None:
    """The largest exponent e of a frame whose disc may contain the point, or None if S may vanish or isn't defined there."""
    with working_precision(_FRAME_BITS):
        here = to_acb(point)
        # A frame needs sigma < _MOST_GROWTH^2 for its sigma >= |p/q|, which is 4^e |S| at the point.
        size = abs(acb_poly(list(system.num))(here)).lower()
        steepest = arb(_MOST_GROWTH**2) * abs(acb_poly(list(system.den))(here)).upper()
        return math.ceil(log2(steepest / size) / 2) if size > 0 and steepest > 0 else None


def foreseen_growth(rate: Callable[[acb], Any], a: ExactPoint, b: ExactPoint) -> float:
    """The integral of `rate` |dx| along the segment from a to b, by the lower sum on pieces that get shorter towards both ends.

    Not a bound: between two marks the function counts as the smaller of its values there, and NaN as none.  For |S|^(1/2) it
    estimates by how much solutions grow or oscillate.
    """
    with working_precision(_FRAME_BITS):
        start = to_acb(a)
        step = to_acb(b - a)
        length = abs(step)
        sizes = []
        for t in _MARKS:
            check_time()
            # The product may be a double where its factors aren't.
            sizes.append(float((rate(start + step * t) * length).mid()))
        # (t - s) min(value at s, value at t), without those that are NaN.
        pieces = zip(_MARKS, _MARKS[1:], sizes, sizes[1:], strict=False)
        return sum((t - s) * min([v for v in (x, y) if not math.isnan(v)], default=0.0) for s, t, x, y in pieces)


def frequency(system: System) -> Callable[[acb], arb]:
    """|S|^(1/2) as a function."""
    num, den = acb_poly(list(system.num)), acb_poly(list(system.den))
    return lambda x: abs(num(x) / den(x)).sqrt()


def log2(value: arb) -> float:
    """log2 of the midpoint of a ball, a positive number of any size; infinite if that isn't a double."""
    mantissa, exponent = value.mid().man_exp()
    if not mantissa:
        return -math.inf
    try:
        return math.log2(int(mantissa)) + int(exponent)
    except OverflowError:
        return math.copysign(math.inf, int(exponent))


def upper_exponent(value: arb) -> int:
    """An integer e with |midpoint| < 2^e."""
    mantissa, exponent = value.mid().man_exp()
    return int(mantissa).bit_length() + int(exponent)

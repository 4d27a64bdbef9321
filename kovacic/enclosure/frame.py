"""The equation seen from the centre of a disc, and bounds of its coefficients along rays.

With x = c + H u the equation is q(u) y'' = p(u) y over Z[i]: `shift` gives it exactly, and `ray_bound` the majorant
z'' = sigma z + rho of `kovacic.enclosure.taylor`, with sigma >= |p/q| and the least |q| from the enclosed zeros of the
numerator and the denominator of S.  The bounds are computed in balls of 64 bits.

Symbols: c centre, H = 2^e scale, u = (x - c)/H.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from fractions import Fraction

from flint import acb, arb, fmpq_poly

from kovacic.algebra.rationals import to_fmpq, to_fraction
from kovacic.enclosure.points import Point, power_of_two, to_acb
from kovacic.enclosure.problem import System, Zeros, along, distance_lower, offsets
from kovacic.enclosure.working import working_precision
from kovacic.errors import InputError

Parts = tuple[list[int], list[int] | None]
"""Real and imaginary parts of the coefficients; None where all of the latter are zero."""

_BITS = 64
_PIECES = 8
_STEEPEST = 300
"""Growth of the majorant, in logarithms, on one piece of a ray."""

_LARGEST = 900
"""Growth of the majorant along a ray, in bits."""


def shift(system: System, centre: Point, scale: Point) -> tuple[Parts, Parts]:
    """p and q of the exact equation q y'' = p y in the variable (x - centre)/scale, with q_0 > 0, without a common factor."""
    q, p = along(system.den, centre, scale), along(system.num, centre, scale)
    re, im = (to_fraction(part[0]) for part in q)
    turn = Point(re, -im) if im else Point(Fraction(1 if re > 0 else -1))  # makes q_0 positive
    parts = [*_times(p, scale * scale * turn), *_times(q, turn)]
    common = math.lcm(*(int(part.denom()) for part in parts))
    whole = [(part * common).numer() for part in parts]
    content = math.gcd(*(int(part.content()) for part in whole))
    p_re, p_im, q_re, q_im = ([int(c) for c in (part // content).coeffs()] for part in whole)
    return _paired(p_re, p_im), _paired(q_re, q_im)


def _times(part: tuple[fmpq_poly, fmpq_poly], factor: Point) -> tuple[fmpq_poly, fmpq_poly]:
    a, b = to_fmpq(factor.re), to_fmpq(factor.im)
    return part[0] * a - part[1] * b, part[0] * b + part[1] * a


def _paired(re: list[int], im: list[int]) -> Parts:
    size = max(len(re), len(im))
    return re + [0] * (size - len(re)), im + [0] * (size - len(im)) if im else None


def norm(parts: Parts) -> int:
    """The sum of the absolute values of the coefficients (of both parts), a bound of the polynomial for |u| <= 1."""
    return sum(abs(v) for part in parts if part is not None for v in part)


@dataclass(frozen=True)
class Frame:
    """The equation seen from a centre: x = c + H u, H = 2^e.

    `poles` and `zeros` are those of S in the variable u, with |H^2 S(c + H u)| = lead prod |u - zero|/prod |u - pole|.
    Where the zeros aren't isolated there are none, and `lead` makes this an upper bound for |u| <= 1.  `blur` is a bound of
    |H^2 (S - S~)| there, where S~ is the system and the coefficients of S are known by balls.
    """

    centre: Point
    e: int
    poles: Zeros
    zeros: Zeros
    lead: arb
    blur: arb | None = None

    @property
    def scale(self) -> Fraction:
        """H, exactly."""
        return power_of_two(self.e)


def make_frame(system: System, centre: Point, e: int) -> Frame:
    """The frame of the equation at `centre` with scale 2^e; raises InputError at a singular point."""
    with working_precision(_BITS):
        unit = arb((1, -e))
        poles, zeros = (
            None if found is None else tuple((d * unit, k) for d, k in found)
            for found in (offsets(system, which, centre) for which in ("den", "num"))
        )
        assert poles is not None
        if zeros is not None:
            power = e * (2 + len(system.num) - len(system.den))
            lead = arb(abs(system.num[-1]) if system.num else 0) / system.den[-1] * arb((1, power))
            return Frame(centre, e, poles, zeros, lead, _blur(system, centre, e, poles))
        p, q = shift(system, centre, Point(power_of_two(e)))
        leading = acb(*(0 if part is None else part[-1] for part in q))
        blur = _blur(system, centre, e, poles)
        return Frame(centre, e, poles, (), arb(norm(p)) / abs(leading), blur)


def _blur(system: System, centre: Point, e: int, poles: Zeros) -> arb | None:
    """The bound `Frame.blur`: with |N - N~| <= n, |D - D~| <= d and |D~| >= m > d on the disc,

    |S - S~| <= (|N~| d/m + n)/(m - d).

    Raises InputError where D may vanish there.
    """
    if not system.radius:
        return None
    unit = arb((1, e))
    reach, least = abs(to_acb(centre)).upper() + unit, arb(abs(system.den[-1]))
    for zeta, k in poles:  # in the variable u
        least *= ((abs(zeta) - 1).lower() * unit) ** k
    size = sum((abs(c) * reach**k for k, c in enumerate(system.num)), arb(0))
    n, d = (system.radius * sum((reach**k for k in range(len(c))), arb(0)) for c in (system.num, system.den))
    if not least > d:
        raise InputError(
            f"the path runs through a singular point near {centre}, or so near to one that the constants don't tell",
            hint="go around it through the complex plane, e.g. path=[...] with a vertex off the axis",
        )
    return ((size * d / least + n) / (least - d) * unit * unit).upper()


@dataclass(frozen=True)
class RayBound:
    """Bounds along the ray from 0 to u for e'' = S e + r/q, e(0) = e'(0) = 0, as exact balls.

    With |r| <= q(0) on the ray, |e| <= `gain` and |e'| <= `slope_gain` at u; `log2_least` is about log2 of the least
    |q/q(0)|, and `log2_growth` about log2 of the growth of the solutions.
    """

    gain: arb
    slope_gain: arb
    log2_least: float
    log2_growth: float

    def worst(self, other: RayBound) -> RayBound:
        """A bound for both rays."""
        return RayBound(
            max(self.gain, other.gain),
            max(self.slope_gain, other.slope_gain),
            min(self.log2_least, other.log2_least),
            max(self.log2_growth, other.log2_growth),
        )


def ray_bound(frame: Frame, target: Point) -> RayBound | None:
    """The bounds along the ray from the centre to `target`; None if a pole can't be excluded from it or the growth is
    too large."""
    with working_precision(_BITS):
        u = to_acb((target - frame.centre).scaled(1 / frame.scale))
        half = (abs(u) / (2 * _PIECES)).upper()
        delta, at_centre = 2 * half, arb(1)
        for zeta, k in frame.poles:
            at_centre *= abs(zeta) ** k
        error = slope = arb(0)
        growth, slope_growth, least = arb(1), arb(1), arb.pos_inf()
        for j in range(_PIECES):
            middle = u * (2 * j + 1) / (2 * _PIECES)
            q, p = arb(1), frame.lead
            for zeta, k in frame.poles:
                gap = abs(zeta - middle) - half
                if not gap > 0:
                    return None
                q *= gap**k
            for eta, k in frame.zeros:
                p *= (abs(eta - middle) + half) ** k
            least = min(least, (q / at_centre).lower())
            sigma = (p / q if frame.blur is None else p / q + frame.blur).upper()
            t = sigma.sqrt() * delta
            if not t < _STEEPEST:
                return None
            c, s, h = arb(1), arb(1), arb(1) / 2
            if t > 0:  # cosh t, sinh(t)/t and (cosh t - 1)/t^2
                c, s, h = t.cosh(), t.sinh() / t, 2 * ((t / 2).sinh() / t) ** 2
            rise = delta * s
            error, slope = error * c + slope * rise + delta * delta * h, error * sigma * rise + slope * c + rise
            growth, slope_growth = growth * c + slope_growth * rise, growth * sigma * rise + slope_growth * c
        total = max(growth.upper(), slope_growth.upper())
        if not total < arb((1, _LARGEST)):
            return None
        return RayBound((error / least).upper(), (slope / least).upper(), log2(least), log2(total))


def least_growth(system: System, a: Point, b: Point) -> float:
    """A lower bound of int |S|^(1/2) |dx| along the segment from a to b: so much the solutions grow, or oscillate.

    From the enclosed zeros, on pieces that get shorter towards both ends; 0 for a numerator whose zeros aren't isolated.
    """
    zeros, poles = offsets(system, "num", a), offsets(system, "den", a)
    if not zeros and len(system.num) != 1:
        return 0.0
    total = 0.0
    towards = [i / 64 * 2.0**-k for k in range(60) for i in range(32, 16, -1 if k == 0 else -4)]  # 1/2, 31/64, ...
    with working_precision(_BITS):
        step = to_acb(b - a)
        marks = [arb(0), *map(arb, reversed(towards)), *(1 - arb(t) for t in towards[1:]), arb(1)]
        for start, stop in itertools.pairwise(marks):
            middle, half = step * (start + stop) / 2, abs(step).upper() * (stop - start) / 2
            size = arb(abs(system.num[-1])) / abs(system.den[-1])
            for eta, n in zeros or ():
                size *= max((abs(eta - middle) - half).lower(), arb(0)) ** n
            for zeta, n in poles or ():
                size /= (abs(zeta - middle) + half) ** n
            total += float((size.sqrt() * 2 * half).lower())
    return total


def fitting(
    system: System, centre: Point, e: int, share: float, growth: float, targets: tuple[Point, Point]
) -> tuple[Frame, tuple[RayBound, RayBound]] | None:
    """The frame at `centre` with scale 2^e, and the bounds of the rays to two points; None where it doesn't fit.

    It fits where the scale is at most `share` of the distance to the nearest singular point, and the solutions grow by at
    most 2^growth along the rays.
    """
    if system.is_singular(centre):
        return None
    near = distance_lower(system, centre)
    if near is not None and not near * share >= arb((1, e)):
        return None
    frame = make_frame(system, centre, e)
    first, second = (ray_bound(frame, target) for target in targets)
    if first is None or second is None or max(first.log2_growth, second.log2_growth) > growth:
        return None
    return frame, (first, second)


def ray_to(frame: Frame, target: Point) -> RayBound:
    """Bounds along the ray from the centre to `target`; raises ArithmeticError where they can't be given."""
    bound = ray_bound(frame, target)
    if bound is None:
        raise ArithmeticError("the target lies outside of its disc")
    return bound


def log2(value: arb) -> float:
    """log2 of the midpoint of a ball, a positive number of any size."""
    mantissa, exponent = value.mid().man_exp()
    return math.log2(int(mantissa)) + int(exponent) if mantissa else -math.inf

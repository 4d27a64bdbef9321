"""The equation seen from the centre of a disc, and bounds of its coefficients and solutions there.

With x = c + H u the equation is q(u) y'' = p(u) y over Z[i]: `shift` gives it exactly.  A `Frame` has this equation for a disc
|u| <= 1 without singular points (and 2^-16 more, for rounded points), and the majorant z'' = sigma z + rho of
`kovacic.enclosure.taylor`, with, on |u| <= r,

    |p| <= sum |p_j| r^j,    |q| >= q_0 prod (1 - r/|zeta|),    sigma >= |p/q|,

zeta the zeros of q, enclosed; r runs through at most eight rings.  The bounds are computed in balls of 64 bits.

Symbols: c centre, H = 2^e scale, u = (x - c)/H.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, arb_poly, fmpq_poly

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.points import ExactPoint, power_of_two, to_acb
from kovacic.enclosure.system import System, distance_lower, offsets
from kovacic.limits import check_time

# Real and imaginary parts of the coefficients; None where all of the latter are zero
GaussianParts = tuple[list[int], list[int] | None]
_BITS = 64
_RINGS = 8
REACH = 1 + power_of_two(-16)  # radius of the disc on which bounds hold, in scales
_STEEPEST = 2400  # growth of the majorant, in logarithms, at most
# Shares of a way at which a rate is looked at.
_NEAR = [2.0**-k for k in (5, 6, 7, 8, 10, 12, 16, 24, 40)]
_MARKS = sorted([0.0, 1.0, *(k / 16 for k in range(1, 16)), *_NEAR, *(1 - t for t in _NEAR)])
_LARGEST = 900  # growth of the majorant in a disc, in bits


def shift(system: System, centre: ExactPoint, scale: ExactPoint) -> tuple[GaussianParts, GaussianParts]:
    """p and q of the exact equation q y'' = p y in the variable (x - centre)/scale, with q_0 > 0, without a common factor."""
    q = system.along("den", centre, scale)
    p = system.along("num", centre, scale)
    re = q[0][0]
    im = q[1][0]
    turn = ExactPoint(re, -im)  # makes q_0 positive
    if im == 0:
        turn = ExactPoint(1) if re > 0 else ExactPoint(-1)
    parts = [*_times(p, scale * scale * turn), *_times(q, turn)]
    common = math.lcm(*(int(part.denom()) for part in parts))
    whole = [(part * common).numer() for part in parts]
    content = math.gcd(*(int(part.content()) for part in whole))
    p_re, p_im, q_re, q_im = ([int(c) for c in (part // content).coeffs()] for part in whole)
    return _paired(p_re, p_im), _paired(q_re, q_im)


def _times(part: tuple[fmpq_poly, fmpq_poly], factor: ExactPoint) -> tuple[fmpq_poly, fmpq_poly]:
    if factor.y == 0 and part[1] == 0:
        return part[0] * factor.x, part[1]
    return part[0] * factor.x - part[1] * factor.y, part[0] * factor.y + part[1] * factor.x


def _paired(re: list[int], im: list[int]) -> GaussianParts:
    if not im:
        return re, None
    size = max(len(re), len(im))
    return re + [0] * (size - len(re)), im + [0] * (size - len(im))


def norm(parts: GaussianParts) -> int:
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


def make_frame(system: System, centre: ExactPoint, e: int) -> Frame | None:
    """The frame of the equation at `centre` with scale 2^e; None where a singular point can't be excluded from the disc, or the
    solutions grow too much there.  Raises InputError at a singular point."""
    with working_precision(_BITS):
        poles = [((abs(d) * arb((1, -e))).lower(), k) for d, k in offsets(system, centre)]
        if any(not size > 1 for size, _ in poles):
            return None
        p, q = shift(system, centre, ExactPoint(power_of_two(e)))
        bound = _bound(p, q[0][0], poles)
        return None if bound is None else Frame(centre, e, p, q, bound)


def _bound(p: GaussianParts, q_0: int, poles: list[tuple[arb, int]]) -> DefectBound | None:
    """The bounds, for the sizes of the poles; None where they would be too large."""
    sizes = [arb(a * a + b * b).sqrt().upper() for a, b in zip(p[0], p[1] or [0] * len(p[0]), strict=True)]
    majorant = arb_poly(sizes) * (1 / arb(q_0))

    def bounds(r: arb) -> tuple[arb, arb]:  # of |q/q_0| from below and of |p/q| from above, for |u| <= r
        least = arb(1)
        for size, k in poles:
            least *= (1 - r / size) ** k
        return least, (majorant(r) / least).upper()

    least, sigma = bounds(arb(REACH))
    if not (least > 0 and sigma < _STEEPEST**2):
        return None
    rings = min(_RINGS, 1 + int(float(sigma.sqrt().upper())))  # growth by exp(1) in each, or more
    delta = arb(REACH) / rings
    error = (arb(0), arb(0))  # z and z' for z'' = sigma z + 1
    growth = (arb(1), arb(1))  # and for z'' = sigma z
    for j in range(rings):
        _, sigma = bounds(delta * (j + 1))
        ring = _Ring.of(sigma, delta)
        error = ring.forced(error)
        growth = ring.carried(growth)
    total = max(growth[0].upper(), growth[1].upper())
    if not total < arb((1, _LARGEST)):
        return None
    return DefectBound((error[0] / least).upper(), (error[1] / least).upper(), log2(least), log2(total))


@dataclass(frozen=True)
class _Ring:
    """z'' = sigma z over a ring of width delta: with t = sigma^(1/2) delta, cosh t, delta sinh(t)/t and
    delta^2 (cosh t - 1)/t^2."""

    sigma: arb
    cosh: arb
    rise: arb
    push: arb

    @classmethod
    def of(cls, sigma: arb, delta: arb) -> _Ring:
        """The numbers, also for sigma = 0."""
        t = sigma.sqrt() * delta
        if not t > 0:
            return cls(sigma, arb(1), delta, delta * delta * (arb(1) / 2))
        return cls(sigma, t.cosh(), delta * (t.sinh() / t), delta * delta * (2 * ((t / 2).sinh() / t) ** 2))

    def carried(self, z: tuple[arb, arb]) -> tuple[arb, arb]:
        """(z, z') at its outer end, from those at its inner end."""
        return z[0] * self.cosh + z[1] * self.rise, z[0] * self.sigma * self.rise + z[1] * self.cosh

    def forced(self, z: tuple[arb, arb]) -> tuple[arb, arb]:
        """The same for z'' = sigma z + 1."""
        value, slope = self.carried(z)
        return value + self.push, slope + self.rise


def fitting(system: System, centre: ExactPoint, e: int, share: float, growth: float) -> Frame | None:
    """The frame at `centre` with scale 2^e, where this is at most `share` of the distance to a singular point, and the
    solutions grow by at most 2^growth; else None."""
    if system.is_singular(centre):
        return None
    near = distance_lower(system, centre)
    if near is not None and not near * share >= arb((1, e)):
        return None
    frame = make_frame(system, centre, e)
    if frame is None or frame.bound.log2_growth > growth:
        return None
    return frame


def largest_exponent(system: System, point: ExactPoint) -> int | None:
    """No disc that contains the point has a frame with a larger exponent e: 4^e |S(point)| is below its majorant.

    None where S vanishes there, may vanish, or isn't defined.
    """
    with working_precision(_BITS):
        here = to_acb(point)
        size = abs(system.polynomial("num")(here)).lower()
        steepest = arb(_STEEPEST**2) * abs(system.polynomial("den")(here)).upper()
        is_known = size > 0 and steepest > 0
        return math.ceil(log2(steepest / size) / 2) if is_known else None


def foreseen_growth(rate: Callable[[acb], arb], a: ExactPoint, b: ExactPoint) -> float:
    """The integral of `rate` |dx| along the segment from a to b, by the lower sum on pieces that get shorter towards both ends.

    No bound: between two marks the function counts as its smaller value there.  With |S|^(1/2) it tells by how much solutions
    grow or oscillate.
    """
    with working_precision(_BITS):
        start = to_acb(a)
        step = to_acb(b - a)
        sizes = []
        for t in _MARKS:
            check_time()
            sizes.append(rate(start + step * t).mid())
        least = zip(_MARKS, _MARKS[1:], sizes, sizes[1:], strict=False)
        pieces = ((t - s) * min((v for v in (x, y) if v.is_finite()), default=arb(0)) for s, t, x, y in least)
        return float(sum(pieces, arb(0)) * abs(step).mid())


def frequency(system: System) -> Callable[[acb], arb]:
    """|S|^(1/2) as a function."""
    num, den = system.polynomial("num"), system.polynomial("den")
    return lambda x: abs(num(x) / den(x)).sqrt()


def log2(value: arb) -> float:
    """log2 of the midpoint of a ball, a positive number of any size; infinite where that isn't a double."""
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

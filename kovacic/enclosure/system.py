"""The normal form den y'' = num y with integer coefficients: its singular points, and which paths meet them.

Symbols: S = num/den; zeta_i the zeros of den (the singular points), eta_j the zeros of num.  The zeros are enclosed by
FLINT's certified isolation (`fmpz_poly.complex_roots`: pairwise disjoint rectangles, one zero in each) and refined when a
distance cannot be told from zero.  Whether a path meets a singular point is decided exactly, by Sturm-free real root
isolation of the common factor of two polynomials over Q.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Literal

from flint import acb, acb_poly, arb, fmpq_poly, fmpz_poly

from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly, foresee_move, to_fraction
from kovacic.enclosure.points import ExactPoint, midpoint, to_acb
from kovacic.errors import InputError
from kovacic.limits import check_time

_SHARP = 40  # relative bits to which the distances of singular points are known
_SHORT = 10**9  # the largest denominator of a singular point that messages name exactly
_EXACT = 400  # bits from which on it is worth while to decide exactly whether a point is singular
Zeros = tuple[tuple[acb, int], ...]  # zeros with their multiplicities
Which = Literal["num", "den"]


@dataclass(frozen=True)
class System:
    """den y'' = num y: integer coefficients, low to high, without a common factor, den not zero.

    >>> System.make((2, 0), (0, 0, 4))   # S = 2/(4 x^2)
    System(num=(1,), den=(0, 0, 2))
    """

    num: tuple[int, ...]
    den: tuple[int, ...]

    @classmethod
    def make(cls, num: tuple[int, ...], den: tuple[int, ...]) -> System:
        """The system in lowest terms; raises InputError if den is zero."""
        p = fmpz_poly(list(num))
        q = fmpz_poly(list(den))
        if q == 0:
            raise InputError("the denominator of S is zero")
        common = p.gcd(q)
        if q.leading_coefficient() < 0:
            common = common * -1
        num, den = (tuple(int(c) for c in (part // common).coeffs()) for part in (p, q))
        return cls(num, den)

    @classmethod
    def of(cls, function: RatFunc) -> System:
        """A rational function over Q, as num/den; raises InputError over another field."""
        num = function.num
        den = function.den
        if not isinstance(num, RationalPoly) or not isinstance(den, RationalPoly):
            raise InputError(
                "numerical evaluation needs S with rational coefficients (no parameters, no algebraic constants)"
            )
        p = num.rep
        q = den.rep
        whole = (p.numer() * q.denom(), q.numer() * p.denom())
        return cls.make(*(tuple(int(c) for c in part.coeffs()) for part in whole))

    def polynomial(self, which: Which) -> acb_poly:
        """Numerator or denominator, at the working precision in force."""
        return acb_poly(list(self.num if which == "num" else self.den))

    def along(self, which: Which, a: ExactPoint, step: ExactPoint) -> tuple[fmpq_poly, fmpq_poly]:
        """Real and imaginary part of numerator or denominator at a + t step, as polynomials in t over Q, by Horner's rule."""
        coefficients = self.num if which == "num" else self.den
        bits = max((c.bit_length() for c in coefficients), default=0)
        foresee_move(len(coefficients), bits, max(a.height_bits(), step.height_bits()))
        x = fmpq_poly([a.x, step.x])
        y = fmpq_poly([a.y, step.y])
        if y == 0:
            return fmpq_poly(list(coefficients))(x), fmpq_poly([])
        real = fmpq_poly([])
        imag = fmpq_poly([])
        for c in reversed(coefficients):
            check_time()
            real, imag = real * x - imag * y + c, real * y + imag * x
        return real, imag

    def roots(self, which: Which, prec: int) -> Zeros:
        """Enclosures of the zeros of numerator or denominator at about `prec` bits, with multiplicities."""
        return _isolated(self.num if which == "num" else self.den, max(64, 1 << (prec - 1).bit_length()))

    def is_singular(self, point: ExactPoint) -> bool:
        """True if the point is a zero of the denominator, decided exactly."""
        if point.is_real():
            return bool(fmpz_poly(list(self.den))(point.x) == 0)
        return all(part == 0 for part in self.along("den", point, ExactPoint(0)))


@lru_cache(maxsize=64)
def _isolated(coefficients: tuple[int, ...], prec: int) -> Zeros:
    with working_precision(prec):
        return complex_zeros(fmpz_poly(list(coefficients)))


def offsets(system: System, centre: ExactPoint) -> Zeros:
    """The singular points seen from `centre` (point - centre), to 40 relative bits at least, with their multiplicities.

    Raises InputError if the centre is one of them.
    """
    prec = 64 + min(centre.height_bits(), 1 << 14)
    while True:
        with working_precision(max(128, prec)):
            here = to_acb(centre)
            found = tuple((root - here, k) for root, k in system.roots("den", prec))
        if all(d.rel_accuracy_bits() >= _SHARP for d, _ in found):
            return found
        if prec > _EXACT and system.is_singular(centre):
            raise InputError(f"the point {centre} is a singular point of the equation")
        prec *= 2


def distance_lower(system: System, centre: ExactPoint) -> arb | None:
    """A proven lower bound, positive and exact, of the distance to the nearest singular point; None if there is none."""
    with working_precision(64):
        return min((d.abs_lower() for d, _ in offsets(system, centre)), default=None)


def is_apart(system: System, *points: ExactPoint) -> bool:
    """Is it certain that no singular point lies in the convex hull of these?  In some direction each is beyond all of them."""
    with working_precision(128):
        left = [root for root, _ in system.roots("den", 128)]
        for a, b in combinations(points, 2):
            along = b - a
            across = ExactPoint(a.y - b.y, along.x)
            left = _not_beyond(_not_beyond(left, points, along), points, across)
    return not left


def _not_beyond(zeros: list[acb], points: Sequence[ExactPoint], direction: ExactPoint) -> list[acb]:
    """Those of the zeros that in this direction aren't certain to be beyond all points."""
    reach = [direction.x * p.x + direction.y * p.y for p in points]
    low = arb(min(reach))
    high = arb(max(reach))
    x = arb(direction.x)
    y = arb(direction.y)
    found = []
    for z in zeros:
        place = x * z.real + y * z.imag
        if not (low > place or place > high):
            found.append(z)
    return found


def check_segment(system: System, a: ExactPoint, b: ExactPoint) -> None:
    """Raise InputError if the closed segment from a to b contains a singular point, with that point and the distances."""
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
    distance = meeting.share * math.sqrt(to_fraction((b - a).norm_squared()))
    raise InputError(
        f"the path from {a} to {b} runs through the singular point {meeting.name} "
        f"(distance 0; {distance:.6g} from the start)",
        hint="go around it through the complex plane: path='above' or 'below', or path=[...] with a vertex off "
        "the axis; the result depends on the side",
        shell="go around it through the complex plane: --path above or --path below; the result depends on the side",
    )


@dataclass(frozen=True)
class _Meeting:
    """Where a segment meets a singular point: the name of the point, and the share of the way to it."""

    name: str
    share: float


def _first_meeting(system: System, a: ExactPoint, b: ExactPoint) -> _Meeting | None:
    """The first singular point on the segment, whose ends aren't singular; None where there is none.

    Exact: with z = x or, on a vertical line, z = iy for its points, den(z + ...) = A + i B with A, B in Q[x] or Q[y]; the line
    is singular where gcd(A, B), on the real axis the denominator itself, has a real zero.
    """
    step = b - a
    first, length = (a.x, step.x) if step.x != 0 else (a.y, step.y)
    unit = step.scaled(1 / length)
    real, imaginary = system.along("den", a - unit.scaled(first), unit)
    coefficients = tuple(int(c) for c in real.gcd(imaginary).numer().coeffs())
    if len(coefficients) <= 1:
        return None
    prec = 128
    while True:
        zeros = _isolated(coefficients, prec)
        with working_precision(prec):
            shares = [(z.real - first) / length for z, _ in zeros if z.imag.is_zero()]
            inside = [share for share in shares if not (share < 0 or share > 1)]
            if not inside:
                return None
            share = min(inside, key=lambda ball: float(ball.mid()))
            if not (share.contains(0) or share.contains(1)):  # the ends were excluded exactly: else refine
                return _Meeting(name_of([system], to_acb(a) + to_acb(step) * share), float(share.mid()))
        prec *= 2


def name_of(systems: Sequence[System], point: acb) -> str:
    """The singular point in this ball, in words: its exact value where that is a short Gaussian rational, else 12 digits."""
    middle = midpoint(point)
    guess = ExactPoint(*(part.limit_denominator(_SHORT) for part in (middle.re, middle.im)))
    if point.overlaps(to_acb(guess)) and any(system.is_singular(guess) for system in systems):
        return str(guess)
    re, im = (part.mid().str(12, radius=False) + "..." for part in (point.real, point.imag))
    return re if point.imag.contains(0) else f"{re} + {im}i"

"""Transition matrices of y'' = S y along polygonal paths: discs, junctions, and a product tree.

The guarantee: `transport` returns balls that contain the exact analytic continuation along the path (in its homotopy
class
in the plane without the singular points), or raises.

A straight piece from a to b is covered by discs.  Disc i has a dyadic centre c_i beside or on the piece and is free
of singular points; it
contains the junctions s_i and s_(i+1) of the piece, so it contains the part of the piece between them (discs are
convex), and
the matrix from s_i to s_(i+1) is E_i(s_(i+1)) E_i(s_i)^-1 with the expansion E_i at c_i; the inverse is the adjugate,
since
det = 1 exactly.  Products are formed as a balanced tree: with k factors one after the other ball arithmetic would lose
up to k bits ("wrapping"), the tree loses O(log k).

The matrices E_i come from one expansion, summed term by term (`kovacic.enclosure.taylor`), or at thousands of digits from
binary splitting (`kovacic.enclosure.splitting`).

Step size: half the distance from the centre to the nearest singular point (the terms then fall like 2^-n on both
sides), and less
where the solutions grow by more than a fixed share of the working precision.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from kovacic.enclosure.frame import Frame, RayBound, log2_lead, log2_norm, make_frame, ray_bound, ray_to, shift_system
from kovacic.enclosure.points import Point
from kovacic.enclosure.singular import System, check_segment, distance_lower
from kovacic.enclosure.splitting import is_split, legs
from kovacic.enclosure.taylor import Matrix, expand, transition
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget

if TYPE_CHECKING:
    from flint import acb

_RATIO = 0.5
"""Scale of a disc as a share of the distance to the nearest singular point."""

_GROWTH = 0.2
"""Growth of the solutions in one disc, as a share of the working precision."""

_MAX_DISCS = 200_000


@dataclass(frozen=True)
class Disc:
    """One expansion: its frame, the junctions where it is entered and left, and the parameter t in [0, 1] of the
    latter.

    A junction is a short dyadic point beside the point a + t (b - a) of the piece; the disc contains both.
    """

    frame: Frame
    enter: Point
    leave: Point
    stop: Fraction
    bound: RayBound
    norm_p: float | None


def multiply(m: Matrix, n: Matrix) -> Matrix:
    """The product m n."""
    a, b, c, d = m
    e, f, g, h = n
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h


def adjugate(m: Matrix) -> Matrix:
    """The inverse of a matrix of determinant 1."""
    a, b, c, d = m
    return d, -b, -c, a


def identity() -> Matrix:
    """The identity matrix."""
    from flint import acb

    return acb(1), acb(0), acb(0), acb(1)


def apply(m: Matrix, v: tuple[acb, acb]) -> tuple[acb, acb]:
    """m v for a state v = (y, y')."""
    return m[0] * v[0] + m[1] * v[1], m[2] * v[0] + m[3] * v[1]


def product(matrices: list[Matrix]) -> Matrix:
    """M_k ... M_1 for the list [M_1, ..., M_k], as a balanced tree."""
    if not matrices:
        return identity()
    level = matrices
    while len(level) > 1:
        paired = [multiply(level[i + 1], level[i]) for i in range(0, len(level) - 1, 2)]
        if len(level) % 2:
            paired.append(level[-1])
        level = paired
    return level[0]


def piece_matrices(system: System, a: Point, b: Point, prec: int, budget: Budget) -> list[Matrix]:
    """The matrices of the discs that cover the straight piece from a to b, in order (each accurate to about
    2^-prec)."""
    step = b - a
    if step.norm_squared() == 0:
        return []
    check_segment(system, a, b)
    result: list[Matrix] = []
    piece = Piece(a, b)
    t, enter = Fraction(0), a
    guess: int | None = None
    while t < 1:
        budget.check()
        disc = _next_disc(system, piece, t, enter, prec, guess)
        if disc is None:  # the junction beside the path is too far from it for a disc that fits: back to the path
            result += piece_matrices(system, enter, piece.at(t), prec, budget)
            enter = piece.at(t)
            continue
        guess = disc.frame.e
        start, stop = _legs(system, disc, prec, budget)
        result.append(multiply(product(stop), adjugate(product(start))) if start else product(stop))
        t, enter = disc.stop, disc.leave
        if len(result) > _MAX_DISCS:
            raise LimitExceeded(f"the path needs more than {_MAX_DISCS} steps", limit="unknown_degree")
    return result


def _legs(system: System, disc: Disc, prec: int, budget: Budget) -> tuple[list[Matrix], list[Matrix]]:
    """Factors, in order, of the matrices from the centre to the junctions where the disc is entered and left."""
    frame = disc.frame
    if is_split(system, prec):
        return legs(system, frame, disc.enter, disc.leave, disc.bound, prec, budget)
    expansion = expand(system, frame, prec, disc.bound, budget)
    start, stop = (
        [] if point == frame.centre else [transition(expansion, point, ray_to(system, frame, point, disc.norm_p))]
        for point in (disc.enter, disc.leave)
    )
    return start, stop


@dataclass(frozen=True)
class Piece:
    """The straight piece from a to b."""

    a: Point
    b: Point

    @property
    def step(self) -> Point:
        """b - a."""
        return self.b - self.a

    @property
    def real(self) -> bool:
        """True if it lies on the real axis."""
        return self.a.is_real() and self.b.is_real()

    def at(self, t: Fraction) -> Point:
        """The point a + t (b - a)."""
        return self.b if t == 1 else self.a + self.step.scaled(t)


def _next_disc(system: System, piece: Piece, t: Fraction, enter: Point, prec: int, guess: int | None) -> Disc | None:
    """The disc that is entered at the parameter t: as large as the singular points and the growth of the solutions
    allow.

    None if the junction `enter` lies off the path and no disc down to an eighth of the last one contains both.
    """
    remaining = (1 - t) ** 2 * piece.step.norm_squared()
    e = _exponent(remaining)
    if guess is not None:
        e = min(e, guess + 2)
    near = distance_lower(system, enter)
    if near is not None:  # H <= 5/8 (distance here + H), so H <= 5/3 of the distance here
        e = min(e, near[1] + math.frexp(near[0])[1] + 1)
    for _ in range(20_000):
        disc = _try_disc(system, piece, t, enter, prec, e)
        if disc is not None:
            return disc
        e -= 1
        if guess is not None and e < guess - 3 and enter != piece.at(t):
            return None
    raise LimitExceeded("no disc of positive size was found for the next step", limit="unknown_degree")


def _try_disc(system: System, piece: Piece, t: Fraction, enter: Point, prec: int, e: int) -> Disc | None:
    """The disc of scale 2^e entered at t, its centre ahead by one scale (half way to the end if that's within reach);
    None if it doesn't fit."""
    step, unit = piece.step, Fraction(2) ** e
    size = step.norm_squared()
    last = (1 - t) ** 2 * size <= (2 * unit) ** 2 * Fraction(9, 10)
    forward = (1 - t) / 2 if last else _ratio_down(unit, size) * (1 if piece.real else Fraction(15, 16))
    centre = piece.at(t + forward).rounded(e - 4)
    if system.is_singular(centre):
        return None
    near = distance_lower(system, centre)
    if near is not None and not _fits(near, e):
        return None
    frame = make_frame(system, centre, 1, e)
    if last:
        stop, leave = Fraction(1), piece.b
    elif piece.real:
        leave = Point(centre.re + (unit if step.re > 0 else -unit))
        stop = (leave.re - piece.a.re) / step.re
    else:
        stop = t + _dyadic_down(2 * forward * Fraction(31, 32))
        leave = piece.at(stop).rounded(e - 4)
    if stop <= t or stop > 1:
        return None
    if any((p - centre).norm_squared() > unit * unit for p in (piece.at(t), piece.at(stop), enter, leave)):
        return None
    norm_p = None
    if frame.zeros is None:
        shifted = shift_system(system, frame)
        norm_p = log2_norm(shifted.p) - log2_lead(shifted.q)
    bounds = []
    for point in (enter, leave):
        u = (point - centre).scaled(1 / unit)
        bound = ray_bound(frame, complex(float(u.re), float(u.im)), norm_p)
        if bound is None or bound.log2_growth > max(100.0, prec * _GROWTH):
            return None
        bounds.append(bound)
    worst = RayBound(
        max(b.gain for b in bounds),
        max(b.gain_derivative for b in bounds),
        min(b.log2_min_q for b in bounds),
        max(b.log2_growth for b in bounds),
    )
    return Disc(frame, enter, leave, stop, worst, norm_p)


def _fits(near: tuple[float, int], e: int) -> bool:
    """True if 2^e <= ratio * distance (the ratio may be exceeded by a quarter: powers of two only)."""
    shift = near[1] - e
    return shift > 1000 or (shift > -1000 and _RATIO * 1.25 * math.ldexp(near[0], shift) >= 1)


def _exponent(square: Fraction) -> int:
    """An integer e with 2^e within a factor of 2 of the root of `square`."""
    return (square.numerator.bit_length() - square.denominator.bit_length()) // 2


def _ratio_down(unit: Fraction, size: Fraction) -> Fraction:
    """A short dyadic number just below unit / sqrt(size)."""
    square = unit * unit / size
    e = _exponent(square)
    scaled = square / Fraction(4) ** (e - 12)
    return Fraction(math.isqrt(int(scaled))) * Fraction(2) ** (e - 12)


def _dyadic_down(value: Fraction) -> Fraction:
    """A dyadic number of at most 8 significant bits just below a positive value."""
    e = value.numerator.bit_length() - value.denominator.bit_length() - 8
    return Fraction(math.floor(value / Fraction(2) ** e)) * Fraction(2) ** e


def transport(system: System, vertices: list[Point], prec: int, budget: Budget) -> Matrix:
    """Enclosure of the transition matrix along the polygon; call it within `flint.ctx.workprec(prec + some)`."""
    matrices: list[Matrix] = []
    for a, b in itertools.pairwise(vertices):
        matrices.extend(piece_matrices(system, a, b, prec, budget))
    return product(matrices)

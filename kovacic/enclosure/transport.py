"""Transition matrices of y'' = S y along straight pieces: discs and junctions.

The guarantee: the matrices of a walk are balls that contain the exact analytic continuation along the piece.

A straight piece from a to b is covered by discs.  Disc i has a dyadic centre c_i beside or on the piece and is free of
singular points; it contains the junctions s_i and s_(i+1) of the piece, so it contains the part of the piece between them
(discs are convex), and the matrix from s_i to s_(i+1) is E_i(s_(i+1)) E_i(s_i)^-1 with the expansion E_i at c_i; the inverse
is the adjugate, since det = 1 exactly.

The matrices E_i come from one expansion, summed term by term (`kovacic.enclosure.taylor`), or at thousands of digits from
binary splitting (`kovacic.enclosure.splitting`).

The scale of a disc is half the distance from the centre to the nearest singular point (the terms then fall like 2^-n), or less
where the solutions grow by more than a fixed share of the working precision.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from flint import fmpq

from kovacic.enclosure.frame import REACH, Frame, System, distance_lower, fitting, is_apart, largest_exponent, log2
from kovacic.enclosure.matrices import Matrix, State, adjugate, matrix_product, multiply
from kovacic.enclosure.points import ExactPoint, binary_exponent, power_of_two, root_below
from kovacic.enclosure.splitting import legs
from kovacic.enclosure.taylor import expand
from kovacic.enclosure.way import DiscStep, Homogeneous, Local, WayStep
from kovacic.limits import check_time, count_work

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class Disc:
    """One expansion: its frame, the junctions where it is entered and left, and the parameter `t_leave` of the latter.

    A junction is a short dyadic point beside the point a + t (b - a) of the piece, 0 <= t <= 1; the disc contains both.
    `begin` is that point for the first junction; None on the way back to the piece.
    """

    frame: Frame
    enter: ExactPoint
    leave: ExactPoint
    t_leave: Any
    begin: ExactPoint | None

    def served(self, system: System, a: ExactPoint, stops: Sequence[ExactPoint]) -> Iterator[ExactPoint]:
        """Those stops to which the disc carries a solution from a as the straight line does: in it, and without a singular
        point in the triangle of a, `begin` and the stop, so that both ways are homotopic; or the end of the way."""
        if self.begin is None:
            return
        centre = self.frame.centre
        reach = self.frame.scale * REACH
        # A square that contains the disc: if no singular point lies between it and a, none does for any stop.
        corners = [centre + ExactPoint(x * reach, y * reach) for x in (1, -1) for y in (1, -1)]
        is_free = self.begin == a or is_apart(system, a, *corners)
        square = self.frame.scale**2
        for stop in stops:
            # The end is reached along the piece itself, whatever lies beside it.
            is_end = self.t_leave == 1 and stop == self.leave
            is_inside = is_end or (stop - centre).norm_squared() <= square
            if is_inside and (is_end or is_free or is_apart(system, a, self.begin, stop)):
                yield stop


@dataclass(frozen=True)
class Split(Homogeneous):
    """A disc of which only the matrix is known, from binary splitting."""

    leave: ExactPoint
    matrix: Matrix

    def local(self, state: State) -> Local:
        """Raises `NotImplementedError`: by splitting no targets are served but the end."""
        raise NotImplementedError


def walk(
    system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True, split: bool = False
) -> Iterator[tuple[Disc, WayStep]]:
    """The discs of the straight way from a to b, with the steps in them.

    `alone` if only the state at the end is needed, `split` for matrices from binary splitting.
    """
    _LOG.debug("from %s to %s, %d bits%s", a, b, prec, ", by binary splitting" if split else "")
    for number, disc in enumerate(cover(system, a, b, prec, alone=alone), 1):
        _LOG.debug("disc %d: centre %s, radius 2^%d", number, disc.frame.centre, disc.frame.e)
        count_work(prec)
        if split:
            # E(leave) E(enter)^-1: the determinants are 1.
            start, stop = map(matrix_product, legs(system, disc.frame, disc.enter, disc.leave, prec))
            yield disc, Split(disc.leave, multiply(stop, adjugate(start)))
        else:
            yield disc, DiscStep(disc.enter, disc.leave, expand(disc.frame, prec))


def growth_of_disc(prec: int, *, alone: bool) -> float:
    """The bits by which the solutions may grow from the centre of a disc to its junctions.

    They are fewer where the disc is kept: polynomials are shorter at its targets, and a value that is smaller than the others
    in the disc by more than the spare bits of the precision would need a second run.
    """
    return max(100.0, 0.2 * prec) if alone else max(30.0, 0.05 * prec)


def cover(system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True) -> Iterator[Disc]:
    """The discs that cover the straight piece from a to b, in order: O(log(far/near)) of them for each singular point at a
    distance between near and far.  Towards a singular point on it they never end."""
    if a == b:
        return
    piece = StraightPiece(system, a, b, growth_of_disc(prec, alone=alone))
    t = fmpq(0)
    enter = a
    guess = None
    while t < 1:
        disc = piece.next_disc(t, enter, guess)
        if disc is None:  # the junction is too far off the path for a disc that fits: back to the path
            yield from (replace(disc, begin=None) for disc in cover(system, enter, piece.at(t), prec))
            enter = piece.at(t)
        else:
            yield disc
            guess, t, enter = disc.frame.e, disc.t_leave, disc.leave


@dataclass(frozen=True)
class StraightPiece:
    """The straight piece from a to b, and by how many bits the solutions may grow in a disc."""

    system: System
    a: ExactPoint
    b: ExactPoint
    growth: float

    def at(self, t: Any) -> ExactPoint:
        """The point a + t (b - a)."""
        return self.b if t == 1 else self.a + (self.b - self.a).scaled(t)

    def next_disc(self, t: Any, enter: ExactPoint, guess: int | None) -> Disc | None:
        """The disc that is entered at the parameter t: as large as the singular points and the growth of the solutions allow.

        None if the junction `enter` lies off the path and no disc down to an eighth of the last one (`guess`) contains both.
        """
        # 2^e is about the rest of the way.
        e = binary_exponent((1 - t) ** 2 * (self.b - self.a).norm_squared()) // 2
        if not self._reaches_end(t, e):  # a scale at which the last disc never comes would be taken again and again
            e += 1
        near = distance_lower(self.system, enter)
        if near is not None:  # H <= 5/8 (distance here + H), so H <= 5/3 of the distance here
            e = min(e, math.ceil(log2(near)) + 1)
        # Beside a disc that fits the next one is seldom much larger.
        steepest = largest_exponent(self.system, enter) if guess is None else guess + 2
        if steepest is not None:
            e = min(e, steepest)
        # Singular points are apart from the way: a disc that is small enough fits.
        while (disc := self._disc(t, enter, e)) is None:
            e -= 1
            if guess is not None and e < guess - 3 and enter != self.at(t):
                return None
        return disc

    def _disc(self, t: Any, enter: ExactPoint, e: int) -> Disc | None:
        """The disc of scale 2^e that is entered at t; None if it doesn't fit."""
        check_time()
        step = self.b - self.a
        if self._reaches_end(t, e):
            centre, leave, t_leave = self.at((1 + t) / 2).rounded(e - 4), self.b, fmpq(1)
        elif self.a.is_real() and self.b.is_real():
            # One scale ahead, rounded towards the junction behind: a nearest point may lie beyond the scale from there.
            sign = 1 if step.x > 0 else -1
            unit, grain = power_of_two(e), power_of_two(e - 4)
            centre = ExactPoint(sign * (((sign * enter.x + unit) / grain).floor() * grain))
            leave = ExactPoint(centre.x + sign * unit)
            t_leave = (leave.x - self.a.x) / step.x
        else:
            # Ahead by short dyadic parameters, just below 2^e/|b - a| and twice as much: a sixteenth less, since centre and
            # junctions are rounded.
            square = power_of_two(2 * e) / step.norm_squared()
            forward = root_below(square, 12) * fmpq(15, 16)
            grain = power_of_two(binary_exponent(square) // 2 - 8)
            t_leave = t + (forward * fmpq(31, 16) / grain).floor() * grain
            centre, leave = self.at(t + forward).rounded(e - 4), self.at(t_leave).rounded(e - 4)
        if not t < t_leave <= 1:
            return None
        begin = self.at(t)
        corners = (begin, self.at(t_leave), enter, leave)
        if any((point - centre).norm_squared() > power_of_two(2 * e) for point in corners):
            return None
        # Scales are powers of two: 5/8 of the distance to a singular point allows one half.
        frame = fitting(self.system, centre, e, 0.625, self.growth)
        return None if frame is None else Disc(frame, enter, leave, t_leave, begin)

    def _reaches_end(self, t: Any, e: int) -> bool:
        """True if a disc of scale 2^e with its centre in the middle contains the rest of the way, with room to spare."""
        # (length/2)^2 <= 9/10 4^e.
        return bool((1 - t) ** 2 * (self.b - self.a).norm_squared() <= power_of_two(2 * e + 2) * fmpq(9, 10))

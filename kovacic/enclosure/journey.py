"""Journeys: a state is carried from the start along a polygon, and from there along straight lines to the targets.

A state is carried along each line by a `Way`.  A journey from a regular singular point begins with its Frobenius series.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from kovacic.enclosure.classical import Closed
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, Number, Points, binary_exponent, middle, power_of_two
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.rational import ClosedWay, sides
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import ReadStart
from kovacic.enclosure.way import States, Traveller, Way
from kovacic.errors import InputError


@dataclass(frozen=True, eq=False)
class Journey:
    """From the start along the polygon `vertices`, then from its end a straight line to each target, or (`chain`) from
    target to target.  `side` says on which side of the real axis singular points on it are passed ("above", "below").

    `problem` is the equation where its coefficients are rational.
    """

    way: Way
    start: ReadStart
    vertices: tuple[Number, ...] = ()
    chain: bool = False
    side: str | None = None
    problem: NumericProblem | None = None
    _begun: dict[tuple[Closed | None, int], Traveller] = field(default_factory=dict, init=False)

    @property
    def place(self) -> ExactPoint | Singular:
        """Where it begins."""
        return self.start.place if isinstance(self.start.place, Singular) else middle(self.start.place)

    def is_exact(self, targets: Sequence[Number]) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.start.place, *self.start.data, *self.vertices, *targets)
        return self.way.is_exact and not any(number.fixed for number in numbers)

    def states(self, targets: Sequence[Number], closed: Closed | None, prec: int) -> list[State]:
        """The states at the targets, to about `prec` bits: exact points are travelled, the midpoints of balls."""
        key = closed, prec
        if key not in self._begun:
            # A higher precision begins anew; a few lower ones are kept for the next targets.
            if len(self._begun) >= 4:
                self._begun.clear()
            self._begun[key] = self._begin(closed, prec)
        traveller = self._begun[key]
        stops = [middle(target) for target in targets]
        found: list[State] = []
        if self.chain:
            for stop in stops:
                if not traveller.is_at(stop):
                    traveller = traveller.moved(stop)
                found.append(traveller.resting())
        else:
            fan = traveller.fan(stops) if self.side is None else self._around(traveller, stops, self.side)
            found = [fan[stop] for stop in stops]
        return [traveller.way.spread(target, state) for target, state in zip(targets, found, strict=True)]

    def _begin(self, closed: Closed | None, prec: int) -> Traveller:
        """At the end of the polygon."""
        way = replace(self.way, prec=prec)
        if closed is not None:
            assert self.problem is not None
            way = ClosedWay(self.problem, closed, prec=prec)
        place = self.place
        # A start at a singular point of the user's equation is refused at once.
        if isinstance(place, ExactPoint):
            way.check(place, place)
        traveller = Traveller(way, place, self.start.state(way))
        for vertex in self.vertices:
            traveller = traveller.moved(middle(vertex))
        return traveller

    def _around(self, traveller: Traveller, stops: Points, side: str) -> States:
        """As `Traveller.fan`, around singular points of the real axis on this side.

        A detour is as wide as its distance to the start and to other singular points allows: near an irregular one the
        solutions are as large as exp(1/distance).  Stops that are nearer to it are reached along the axis from its ends.  Where
        there are no stops between singular points, one detour leads around them all.
        """
        assert self.problem is not None
        singular = self.problem.singular_points(256)
        found: States = {}
        for waiting in sides(traveller.here, list(dict.fromkeys(stops))):
            one = traveller
            for detour in _detours(one.here, waiting, singular):
                # Before the place, in the direction of the way: they are reached before the detour begins.
                nearer = [stop for stop in waiting if detour.sign * (stop.x - detour.place) < 0]
                found |= one.fan(nearer)
                waiting = waiting[len(nearer) :]
                for point in detour.corners(side):
                    one = one.turned(point)
            found |= one.fan(waiting)
        return found


@dataclass(frozen=True)
class _Detour:
    """Around singular points of the real axis, the last one at `place`: by a triangle with slopes of 45 degrees over the way
    from `begin` to `end`.

    `sign` is the direction: 1 to the right, -1 to the left.
    """

    place: Any
    begin: Any
    end: Any
    sign: int

    def corners(self, side: str) -> tuple[ExactPoint, ...]:
        """Where the axis is left, the corner "above" or "below" it, and where it is reached again."""
        # A right angle at the corner: the triangle is as high as half its base.
        height = abs(self.end - self.begin) / 2
        top = ExactPoint((self.begin + self.end) / 2, height if side == "above" else -height)
        return ExactPoint(self.begin), top, ExactPoint(self.end)

    def is_free(self, singular: Points) -> bool:
        """True if no singular point beside the real axis lies in the triangle, or near it."""
        # There 2 |x - centre| + 2 |y| is at most the base; singular points are known to far more than 16 bits.
        ends = self.begin + self.end
        least = abs(self.end - self.begin) * (1 + power_of_two(-16))
        return all(p.is_real() or abs(2 * p.x - ends) + 2 * abs(p.y) > least for p in singular)


def _detours(here: ExactPoint | Singular, stops: Points, singular: Points) -> list[_Detour]:
    """Those on the way to the last stop, in order; from infinity beyond all singular points.

    Those without stops between their places become one, if no other singular point is between them and that.
    """
    last = stops[-1]
    if isinstance(here, Singular):
        # From infinity: beyond all singular points and the last stop.
        far = 2 * max(abs(p.x) for p in (last, *singular)) + 1
        here = ExactPoint(far if last.x > 0 else -far) if here.inverted else here.near
    if not (here.is_real() and last.is_real()):
        raise InputError(
            "a side of the real axis needs a start and points on it",
            hint="path=[v1, v2, ...]",
            shell="leave --path out, where the straight line meets no singular point",
        )
    sign = 1 if last.x > here.x else -1
    distance = sign * (last.x - here.x)
    places = [p.x for p in singular if p.is_real() and 0 < sign * (p.x - here.x) < distance]
    found: list[_Detour] = []
    for place in sorted(places, reverse=sign < 0):
        point = ExactPoint(place)
        # Half the distance to another singular point, or the whole one to the start, whichever is less.
        squares = [(other - point).norm_squared() / 4 for other in singular if other != point]
        square = min([*squares, (here - point).norm_squared()])
        # A power of two below the root.
        radius = power_of_two((binary_exponent(square) - 1) // 2)
        # A short number, at most a sixteenth of the radius to the left of the place.
        centre = (place / radius * 16).floor() * radius / 16
        detour = _Detour(place, centre - sign * radius, centre + sign * radius, sign)
        if found:
            both = replace(detour, begin=found[-1].begin)
            near, far = sorted((found[-1].place, place))
            if both.is_free(singular) and not any(near < stop.x < far for stop in stops):
                found.pop()
                detour = both
        found.append(detour)
    return found

"""Where a solution is asked for, and how a state gets there: along a polygon, then along straight lines to the targets.

A state is carried along each line by a `Way`.  A journey from a regular singular point begins with its Frobenius series.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from kovacic.enclosure.classical import Closed
from kovacic.enclosure.constants import Number
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, power_of_two
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.rational import ClosedWay, sides
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import Start, middle
from kovacic.enclosure.way import Traveller, Way
from kovacic.errors import InputError

_KEPT = 4  # precisions at which the beginning of a journey is kept for the next targets


@dataclass(frozen=True, eq=False)
class Journey:
    """From the start along the polygon `vertices`, then from its end a straight line to each target, or (`chain`) from
    target to target.  `side` says on which side of the real axis singular points on it are passed ("above", "below").

    `problem` is the equation where its coefficients are rational.
    """

    way: Way
    start: Start
    vertices: tuple[Number, ...] = ()
    chain: bool = False
    side: str | None = None
    problem: NumericProblem | None = None

    @property
    def place(self) -> ExactPoint | Singular:
        """Where it begins."""
        return self.start.place if isinstance(self.start.place, Singular) else middle(self.start.place)

    def is_exact(self, targets: Sequence[Number]) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.start.place, *self.start.data, *self.vertices, *targets)
        return self.way.is_exact and not any(getattr(number, "fixed", False) for number in numbers)

    def states(self, targets: Sequence[Number], closed: Closed | None, prec: int) -> list[State]:
        """The states at the targets, at about so many bits: exact points are travelled, the midpoints of balls."""
        key = closed, prec
        if key not in self._begun:
            if len(self._begun) >= _KEPT:
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

    @cached_property
    def _begun(self) -> dict[tuple[Closed | None, int], Traveller]:
        return {}

    @cached_property
    def routes(self) -> dict[Any, Any]:
        """The choices of `kovacic.enclosure.routes`, by what they depend on."""
        return {}

    def _begin(self, closed: Closed | None, prec: int) -> Traveller:
        """At the end of the polygon."""
        way = self.way.at(prec)
        if closed is not None:
            assert self.problem is not None
            way = ClosedWay(self.problem, prec, closed)
        place = self.place
        if isinstance(place, ExactPoint):
            way.check(place, place)
        traveller = Traveller(way, place, self.start.state(way))
        for vertex in self.vertices:
            traveller = traveller.moved(middle(vertex))
        return traveller

    def _around(self, traveller: Traveller, stops: Sequence[ExactPoint], side: str) -> dict[ExactPoint, State]:
        """As `Traveller.fan`, around singular points of the real axis on this side.

        A detour is as wide as its distance to the start and to other singular points allows: near an irregular one the
        solutions are as large as exp(1/distance).  Stops that are nearer to it are reached along the axis from its ends.
        """
        assert self.problem is not None
        found: dict[ExactPoint, State] = {}
        for waiting in sides(traveller.here, list(dict.fromkeys(stops))):
            one = traveller
            for detour in _detours(one.here, waiting[-1], self.problem.singular_points(256)):
                for stage in detour.stages(side):
                    nearer = [stop for stop in waiting if detour.sign * (stop.x - stage.reach) <= 0]
                    found |= one.fan(nearer)
                    waiting = waiting[len(nearer) :]
                    for point in stage.onward:
                        one = one.moved(point)
            found |= one.fan(waiting)
        return found


class _Stage(NamedTuple):
    """From where we are, the stops up to a place of the real axis (`reach`) are visited; then we go `onward`."""

    reach: Any
    onward: tuple[ExactPoint, ...]


@dataclass(frozen=True)
class _Detour:
    """Around the singular point `place` of the real axis: by a triangle over `centre`, a short number beside it.

    `sign` is the direction: 1 to the right, -1 to the left.
    """

    place: Any
    centre: Any
    radius: Any
    sign: int

    def stages(self, side: str) -> tuple[_Stage, ...]:
        """To where the axis is left; over the corner "above" or "below" it, to where it is reached again; and back there."""
        begin = self.centre - self.sign * self.radius
        end = self.centre + self.sign * self.radius
        top = ExactPoint(self.centre, self.radius if side == "above" else -self.radius)
        return _Stage(begin, (ExactPoint(begin),)), _Stage(self.place, (top, ExactPoint(end))), _Stage(end, ())


def _detours(here: ExactPoint | Singular, last: ExactPoint, singular: Sequence[ExactPoint]) -> Iterator[_Detour]:
    """Those on the way to `last`, in order; from infinity beyond all singular points."""
    if isinstance(here, Singular) and here.inverted:
        far = 2 * max(abs(p.x) for p in (last, *singular)) + 1
        here = ExactPoint(far) if last.x > 0 else ExactPoint(-far)
    elif isinstance(here, Singular):
        here = here.near
    if not (here.is_real() and last.is_real()):
        raise InputError(
            "a side of the real axis needs a start and points on it",
            hint="path=[v1, v2, ...]",
            shell="leave --path out, where the straight line meets no singular point",
        )
    sign = 1 if last.x > here.x else -1
    distance = sign * (last.x - here.x)
    on_axis = {p.x for p in singular if p.is_real()}
    places = [place for place in on_axis if 0 < sign * (place - here.x) < distance]
    for place in sorted(places, reverse=sign < 0):
        point = ExactPoint(place)
        squares = [(other - point).norm_squared() / 4 for other in singular if other != point]
        square = min([*squares, (here - point).norm_squared()])
        radius = power_of_two((square.p.bit_length() - square.q.bit_length() - 1) // 2)
        centre = (place / radius * 16).floor() * radius / 16
        yield _Detour(place, centre, radius, sign)

"""Where a solution is asked for, and how a state gets there: along a polygon, then along straight lines to the targets.

A state (y, y') of the normal form is carried by the transition matrices of straight legs, Taylor discs (each serves all
targets inside it) or a closed form; with a gauge g, z = g y is the user's solution, and g/g(x0) is followed along the same
legs (`kovacic.enclosure.log_derivative`):

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u),    E = exp int_u^v gamma,    G(x) = (1, 0; gamma(x), 1).

A pole of gamma is a singular point of the user's equation even where S is regular: legs through one are refused.  A journey
from a regular singular point begins with its Frobenius series.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any, NamedTuple

from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.classical import Classical, Closed, classical_of
from kovacic.enclosure.constants import Number
from kovacic.enclosure.embedded import check_apart
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.frobenius import basis, junction, limit
from kovacic.enclosure.log_derivative import LogDerivative, log_derivative
from kovacic.enclosure.matrices import Matrix, MatrixProduct, State, apply, real_part
from kovacic.enclosure.points import ExactPoint, power_of_two, to_acb, to_double
from kovacic.enclosure.precision import Method
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.splitting import is_split
from kovacic.enclosure.start import Start, middle, spread
from kovacic.enclosure.system import check_segment
from kovacic.enclosure.transport import Leg, Stop, walk
from kovacic.enclosure.way import Way, by_rays, ray
from kovacic.errors import InputError
from kovacic.limits import check_time, count_work

_KEPT = 4  # precisions at which the beginning of a journey is kept for the next targets


@dataclass
class ChosenForm:
    """A closed form that was chosen for a journey, for which a target has this `price`, and for how many targets at `most` it
    is known to be the cheaper way.

    It has `served` so many; with so many `bits` the first precision is enough where both solutions grow to the start.
    """

    closed: Closed
    price: float = 0.0
    most: float = math.inf
    served: int = 0
    bits: int = 0

    def pays(self, count: int) -> bool:
        """Does it for so many targets more?"""
        return self.served + count <= self.most


@dataclass(frozen=True, eq=False)
class Journey:
    """From the start along the polygon `vertices`, then from its end a straight line to each target, or (`chain`) from
    target to target.  `side` says on which side of the real axis singular points on it are passed ("above", "below")."""

    problem: NumericProblem
    start: Start
    vertices: tuple[Number, ...]
    chain: bool = False
    side: str | None = None

    def is_exact(self, targets: Sequence[Number]) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.start.place, *self.start.data, *targets)
        return self.problem.is_exact and not any(getattr(number, "fixed", False) for number in numbers)

    def states(self, targets: Sequence[Number], closed: Closed | None, prec: int) -> list[State]:
        """The states at the targets, at about so many bits: exact points are travelled, the midpoints of balls."""
        key = closed, prec
        if key not in self._begun:
            if len(self._begun) >= _KEPT:
                self._begun.clear()
            self._begun[key] = self._begin(closed, prec)
        traveller, start = self._begun[key]
        states = self._visited(traveller, [middle(target) for target in targets], start)
        return [spread(traveller.problem, target, state) for target, state in zip(targets, states, strict=True)]

    def _visited(self, traveller: Traveller, stops: list[ExactPoint], start: State) -> list[State]:
        """The states at the stops: one after the other, or along straight lines, or on one side of the real axis."""
        if self.chain:
            one = replace(traveller)
            return [one.visit(stop, start) for stop in stops]
        if self.side is None:
            return traveller.fan(stops, start)
        found: dict[int, State] = {}
        for numbers in _rays(traveller.here, stops):
            states = replace(traveller).around([stops[i] for i in numbers], start, self.side)
            found |= zip(numbers, states, strict=True)
        return [found[i] for i in range(len(stops))]

    def knows(self, targets: Sequence[Number], prec: int) -> bool:
        """Do the ways that were gone by Taylor's method at this precision lead to all of the targets?"""
        if (None, prec) not in self._begun or self.chain or self.side is not None:
            return False
        traveller, _ = self._begun[None, prec]
        with working_precision(prec):
            return all(traveller.knows(middle(target)) for target in targets)

    def classical(self, work: int | None) -> Classical | None:
        """The equation that S is pulled back from, if it is found in so much work."""
        return None if self.problem.S is None else classical_of(self.problem.S, work)

    @cached_property
    def choices(self) -> dict[tuple[Method | None, int], ChosenForm]:
        """What was chosen, by the method that was asked for and the digits."""
        return {}

    @cached_property
    def _begun(self) -> dict[tuple[Closed | None, int], tuple[Traveller, State]]:
        return {}

    def _begin(self, closed: Closed | None, prec: int) -> tuple[Traveller, State]:
        """At the end of the polygon, and the start's coordinates."""
        problem = self.problem.at(prec)
        place = self.start.place
        start = self.start.state(problem, prec)
        here = place if isinstance(place, Singular) else middle(place)
        traveller = Traveller.at(problem, here, closed, prec)
        for vertex in self.vertices:
            traveller.go(middle(vertex), start)
        return traveller, start


def _rays(here: ExactPoint | Singular, stops: Sequence[ExactPoint]) -> list[list[int]]:
    """The numbers of the stops, by straight ways that are shared: those on the same side on the real axis, in the order of
    visit (from infinity the farthest first), and each of the others alone."""
    origin = here.near if isinstance(here, Singular) else here
    right = []
    left = []
    alone = []
    for number, stop in enumerate(stops):
        if not (origin.is_real() and stop.is_real()):
            alone.append([number])
        elif stop.x >= origin.x:
            right.append(number)
        else:
            left.append(number)
    from_infinity = isinstance(here, Singular) and here.inverted
    right.sort(key=lambda number: stops[number].x, reverse=from_infinity)
    left.sort(key=lambda number: stops[number].x, reverse=not from_infinity)
    return [numbers for numbers in (right, left, *alone) if numbers]


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

    @property
    def begin(self) -> Any:
        """Where the axis is left."""
        return self.centre - self.sign * self.radius

    @property
    def end(self) -> Any:
        """Where it is reached again."""
        return self.centre + self.sign * self.radius

    def stages(self, side: str) -> tuple[_Stage, ...]:
        """To where the axis is left; over the corner "above" or "below" it, to where it is reached again; and back there."""
        height = self.radius if side == "above" else -self.radius
        top = ExactPoint(self.centre, height)
        begin = ExactPoint(self.begin)
        end = ExactPoint(self.end)
        return _Stage(self.begin, (begin,)), _Stage(self.place, (top, end)), _Stage(self.end, ())


@dataclass
class Traveller:
    """Where we are, and the map from the start's coordinates to (y, y') here: `product`, and `particular` is added.

    `growth` is g here over g at the first point where there is a state.
    """

    problem: NumericProblem
    closed: Closed | None
    gauge: LogDerivative | None
    prec: int
    here: ExactPoint | Singular
    product: MatrixProduct
    growth: acb
    forcing: Forcing | None = None
    particular: State = (acb(0), acb(0))
    ways: dict[ExactPoint, Way] = field(default_factory=dict)

    @classmethod
    def at(cls, problem: NumericProblem, x0: ExactPoint | Singular, closed: Closed | None, prec: int) -> Traveller:
        """At the start of a journey."""
        gauge = None if problem.embedded is None else problem.embedded.log_derivative()
        if problem.gauge is not None:
            gauge = log_derivative(problem.gauge)
        found = cls(problem, closed, gauge, prec, x0, MatrixProduct(), acb(1), forcing_of(problem))
        if isinstance(x0, ExactPoint):
            found._begin(x0)
        return found

    def _begin(self, x: ExactPoint) -> None:
        """From (z, z') to (y, y') at x."""
        if self.problem.gauge is not None:
            check_segment(self.problem.system, x, x)
            check_segment(self.problem.gauge_poles, x, x)
        if self.gauge is not None:
            self.product = self.product.after((acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1)))
        self._arrive(x)

    def _arrive(self, x: ExactPoint) -> None:
        self.here = x
        self.ways = {}

    def go(self, stop: ExactPoint, start: State) -> None:
        """Straight on to a point."""
        if isinstance(self.here, Singular):
            self._leave(self.here, stop, start)
        assert isinstance(self.here, ExactPoint)
        if stop == self.here:
            return
        if self.closed is not None:
            self.product = self.product.after(self._closed_matrix(self.closed, stop, start))
        else:
            self._walk(self.here, stop)
        self.growth *= self._growth(stop)
        self._arrive(stop)

    def _walk(self, here: ExactPoint, stop: ExactPoint) -> None:
        """The legs of a straight way by Taylor's method."""
        self._check_gauge(here, stop)
        forcing = self.forcing
        if forcing is not None:
            forcing.check(here, stop)
        on_axis = here.is_real() and stop.is_real() and self.growth.imag.is_zero()
        for leg in walk(self.problem.system, here, stop, self.prec, targets=int(forcing is not None)):
            if forcing is not None:
                y, dy = self.particular
                change, slope_change = forcing.step(leg, self._inverse_growth, on_axis=on_axis)
                self.particular = apply(leg.matrix, (y + change, dy + slope_change))
            self.product = self.product.after(leg.matrix)

    def fan(self, stops: Sequence[ExactPoint], start: State) -> list[State]:
        """The user's (z, z') at the ends of straight lines from here."""
        if self.closed is not None:
            return [self.by_closed_form(self.closed, stop, start) for stop in stops]
        split = is_split(self.problem.system, self.prec // max(1, len(stops))) and not all(map(self.knows, stops))
        alone = self.forcing is not None or split
        if alone or isinstance(self.here, Singular):
            return self._by_rays(stops, start, alone=alone)
        if self.here.is_real() and all(stop.is_real() for stop in stops):
            return self._by_ways(self.here, stops, start)
        return self._by_discs(self.here, stops, start)

    def knows(self, stop: ExactPoint) -> bool:
        """Is there a way from here that contains the point?"""
        if not isinstance(self.here, ExactPoint) or stop == self.here:
            return False
        way = self.ways.get(ray(self.here, stop))
        return way is not None and way.contains(stop)

    def _by_ways(self, here: ExactPoint, stops: Sequence[ExactPoint], start: State) -> list[State]:
        """Along the real axis, on ways that are kept for the next call."""
        found: dict[ExactPoint, State] = {here: self.state(start)}
        for direction, on_it in by_rays(here, stops).items():
            for stop in on_it:
                self._check_gauge(here, stop)
            way = self.ways.get(direction)
            if way is None or not way.has(on_it[0]):
                discs = partial(walk, self.problem.system, prec=self.prec, targets=len(stops))
                way = self.ways[direction] = Way(here, discs, start, self.product)
            found |= zip(on_it, map(self._given, way.states(on_it), on_it), strict=True)
        return [found[stop] for stop in stops]

    def _by_rays(self, stops: Sequence[ExactPoint], start: State, *, alone: bool) -> list[State]:
        """Stop by stop along each straight way: out of a singular point, or all the way where the stops can't share discs."""
        found: dict[int, State] = {}
        for stops_of_ray in _rays(self.here, stops):
            one = replace(self)
            while stops_of_ray and (alone or isinstance(one.here, Singular)):
                first = stops_of_ray.pop(0)
                found[first] = one.visit(stops[first], start)
            found |= zip(stops_of_ray, one.fan([stops[i] for i in stops_of_ray], start), strict=True)
        return [found[i] for i in range(len(stops))]

    def _by_discs(self, here: ExactPoint, stops: Sequence[ExactPoint], start: State) -> list[State]:
        """Along the line to the farthest stop, again and again: the discs on it serve others, too."""
        origin = to_double(here)
        found: dict[int, State] = {}
        waiting = []
        for stop in Stop.all(stops):
            if stop.point == here:
                found[stop.number] = self.state(start)
            else:
                waiting.append(stop)
        waiting.sort(key=lambda stop: abs(stop.near - origin))
        while waiting:
            farthest = waiting[-1].point
            for leg, way in self._legs(here, farthest, len(waiting)):
                served = [*leg.disc.served(self.problem.system, here, waiting)]
                if served:
                    found |= self._at_stops(here, leg, way.apply(start), served)
                    waiting = [stop for stop in waiting if stop.number not in found]
        return [found[number] for number in range(len(stops))]

    def _legs(self, here: ExactPoint, stop: ExactPoint, targets: int) -> Iterator[tuple[Leg, MatrixProduct]]:
        """The legs of the straight line to a stop, each with the map from the start's coordinates to where it begins."""
        way = self.product
        for leg in walk(self.problem.system, here, stop, self.prec, targets):
            yield leg, way
            if leg.disc.leave != stop:  # the matrix of the last leg isn't needed
                way = way.after(leg.matrix)

    def _at_stops(self, here: ExactPoint, leg: Leg, entering: State, served: Sequence[Stop]) -> dict[int, State]:
        """The user's (z, z') by the numbers of the stops that a disc serves, from the state where it is entered."""
        for stop in served:
            self._check_gauge(here, stop.point)
        local = leg.local(entering)
        return {stop.number: self._given(local.state(stop.point), stop.point) for stop in served}

    def by_closed_form(self, closed: Closed, stop: ExactPoint, start: State) -> State:
        """The user's (z, z') at the end of a straight line from here."""
        check_time()
        count_work(self.prec)
        here = self.here
        if isinstance(here, Singular):
            if here.is_at(stop):
                return limit(here, start)
            return apply(self._closed_matrix(closed, stop, start), start)
        state = self.product.apply(start)
        if stop != here:
            state = apply(self._closed_matrix(closed, stop, start), state)
        return self._given(state, stop)

    def _closed_matrix(self, closed: Closed, stop: ExactPoint, start: State) -> Matrix:
        if isinstance(self.here, Singular):
            assert isinstance(closed, Classical)
            needed = not start[0].is_zero(), not start[1].is_zero()
            return closed.frobenius(self.here, self.problem.gauge, needed, stop)
        self._check_gauge(self.here, stop)
        matrix = closed.leg(self.here, stop)
        return real_part(matrix) if self.here.is_real() and stop.is_real() else matrix

    def _check_gauge(self, here: ExactPoint, stop: ExactPoint) -> None:
        """Raise InputError where the gauge has a pole on the way, at a point where S is regular."""
        if self.problem.gauge is not None and len(self.problem.gauge_poles.den) > 1:
            check_segment(self.problem.gauge_poles, here, stop)
        if self.problem.embedded and self.gauge:
            check_apart((pole.zeta for pole in self.gauge.poles), to_acb(here), to_acb(stop))

    def _inverse_growth(self, x: acb, analytic: bool) -> acb:
        """1/g on a ball."""
        if self.gauge is None or not isinstance(self.here, ExactPoint):
            return acb(1)
        return (-self.gauge.exponent(to_acb(self.here), x, analytic=analytic)).exp() / self.growth

    def visit(self, stop: ExactPoint, start: State) -> State:
        """Straight on to a point, and the user's (z, z') there; the start itself, if that's a singular point, isn't left."""
        if isinstance(self.here, Singular) and self.here.is_at(stop):
            return limit(self.here, start)
        self.go(stop, start)
        return self.state(start)

    def state(self, start: State) -> State:
        """The user's (z, z') here."""
        assert isinstance(self.here, ExactPoint)
        return self._given(self.product.apply(start), self.here)

    def around(self, stops: list[ExactPoint], start: State, side: str) -> list[State]:
        """As `fan`, around singular points of the real axis on this side; the stops lie in one direction, in order.

        A detour is as wide as its distance to the start and to other singular points allows: near an irregular one the
        solutions are as large as exp(1/distance).  Stops that are nearer to it are reached along the axis from its ends.
        """
        result: list[State] = []
        for detour in self._detours(stops[-1]):
            for stage in detour.stages(side):
                nearer = [stop for stop in stops[len(result) :] if detour.sign * (stop.x - stage.reach) <= 0]
                result += self.fan(nearer, start)
                for point in stage.onward:
                    self.go(point, start)
        return [*result, *self.fan(stops[len(result) :], start)]

    def _detours(self, last: ExactPoint) -> Iterator[_Detour]:
        """Those on the way to `last`, in order."""
        singular = self.problem.singular_points(256)
        here = self._beginning(last, singular)
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

    def _beginning(self, last: ExactPoint, singular: Sequence[ExactPoint]) -> ExactPoint:
        """Where a way on the real axis to `last` begins; from infinity beyond all singular points."""
        here = self.here
        if isinstance(here, ExactPoint):
            return here
        if not here.inverted:
            return here.near
        far = 2 * max(abs(p.x) for p in (last, *singular)) + 1
        return ExactPoint(far) if last.x > 0 else ExactPoint(-far)

    def _leave(self, point: Singular, stop: ExactPoint, start: State) -> None:
        """Out of the disc around a singular point, or to the stop itself."""
        if point.is_at(stop):
            raise InputError(f"the path doesn't leave the singular point {point}", hint="go on to another point")
        if self.closed is not None:
            self.product = self.product.after(self._closed_matrix(self.closed, stop, start))
        else:
            last, bound = junction(point, stop, self.prec)
            needed = not start[0].is_zero(), not start[1].is_zero()
            self.product = self.product.after(basis(point, last, stop, bound, self.prec, needed=needed))
            stop = last
        self._begin(stop)

    def _growth(self, x: ExactPoint) -> acb:
        """g(x)/g(here)."""
        assert isinstance(self.here, ExactPoint)
        if self.gauge is None or x == self.here:
            return acb(1)
        factor = self.gauge.growth(to_acb(self.here), to_acb(x))
        real = self.problem.is_real and self.here.is_real() and x.is_real()
        return acb(factor.real) if real else factor

    def _given(self, state: State, x: ExactPoint) -> State:
        """The user's (z, z') at x."""
        state = state[0] + self.particular[0], state[1] + self.particular[1]
        if self.gauge is None:
            return state
        factor = self.growth * self._growth(x)
        return state[0] * factor, (state[1] + self.gauge.value(to_acb(x)) * state[0]) * factor

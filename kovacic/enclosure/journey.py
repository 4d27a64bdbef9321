"""Where a solution is asked for, and how a state gets there: along a polygon, then along straight lines to the targets.

A state (y, y') of the normal form is carried by the transition matrices of straight legs, Taylor discs (each serves all
targets inside it) or a closed form; with a gauge g, z = g y is the user's solution, and g/g(x0) is followed along the same
legs (`kovacic.enclosure.exponential`):

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u),    E = exp int_u^v gamma,    G(x) = (1, 0; gamma(x), 1).

A pole of gamma is a singular point of the user's equation even where S is regular: legs through one are refused.  A journey
from a regular singular point begins with its Frobenius series.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from flint import acb, ctx

from kovacic.enclosure.classical import Classical, frobenius
from kovacic.enclosure.closed_form import ClosedForm
from kovacic.enclosure.constants import Number
from kovacic.enclosure.embedded import EmbeddedGauge
from kovacic.enclosure.exponential import LogDerivative, rational_log_derivative
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.frobenius import Basis, junction, limit
from kovacic.enclosure.matrices import Matrix, Product, State, apply, real_part
from kovacic.enclosure.points import Point, power_of_two, to_acb
from kovacic.enclosure.problem import NumericProblem, check_segment
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.splitting import is_split
from kovacic.enclosure.start import Start, middle, spread
from kovacic.enclosure.transport import walk
from kovacic.errors import InputError
from kovacic.limits import check_time

Closed = ClosedForm | Classical
_KEPT = 4  # precisions at which the beginning of a journey is kept for the next targets


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
        stops = [middle(target) for target in targets]
        if self.chain:
            one = traveller.copy()
            states = [state for stop in stops for state in one.around([stop], start, self.side)]
        elif closed is not None and self.side is None:
            states = [traveller.by_closed_form(closed, stop, start) for stop in stops]
        else:
            found: dict[int, State] = {}
            for branch in _branches(traveller.here, stops):
                found |= zip(branch, traveller.copy().around([stops[i] for i in branch], start, self.side), strict=True)
            beside = [i for i in range(len(stops)) if i not in found]
            found |= zip(beside, traveller.fan([stops[i] for i in beside], start, self.side), strict=True)
            states = [found[i] for i in range(len(stops))]
        return [spread(traveller.problem, target, state) for target, state in zip(targets, states, strict=True)]

    @cached_property
    def _begun(self) -> dict[tuple[Closed | None, int], tuple[Traveller, State]]:
        return {}

    def _begin(self, closed: Closed | None, prec: int) -> tuple[Traveller, State]:
        """At the end of the polygon, and the start's coordinates."""
        problem, place = self.problem.at(prec), self.start.place
        start = self.start.state(problem, prec)
        traveller = Traveller.at(problem, place if isinstance(place, Singular) else middle(place), closed, prec)
        for vertex in self.vertices:
            traveller.go([middle(vertex)], start)
        return traveller, start


def _branches(here: Point | Singular, stops: list[Point]) -> list[list[int]]:
    """The stops on the real axis in the order of visit: two chains (right and left) share their way."""
    origin, inverted = (here.near, here.inverted) if isinstance(here, Singular) else (here, False)
    keys = {i: stop.x for i, stop in enumerate(stops) if origin.is_real() and stop.is_real()}
    right = sorted((i for i in keys if keys[i] >= origin.x), key=keys.__getitem__, reverse=inverted)
    left = sorted((i for i in keys if keys[i] < origin.x), key=keys.__getitem__, reverse=not inverted)
    return [chain for chain in (right, left) if chain]


@dataclass
class Traveller:
    """Where we are, and the map from the start's coordinates to (y, y') here: `product`, and `particular` is added.

    `growth` is g here over g at the first point where there is a state.
    """

    problem: NumericProblem
    closed: Closed | None
    gauge: LogDerivative | EmbeddedGauge | None
    prec: int
    here: Point | Singular
    product: Product
    growth: acb
    forcing: Forcing | None = None
    particular: State = (acb(0), acb(0))

    @classmethod
    def at(cls, problem: NumericProblem, x0: Point | Singular, closed: Closed | None, prec: int) -> Traveller:
        """At the start of a journey."""
        gauge: LogDerivative | EmbeddedGauge | None = None
        if problem.embedded is not None and problem.embedded.gauge is not None:
            gauge = problem.embedded.growth_of(problem.embedded.gauge)
        elif problem.gauge is not None:
            gauge = rational_log_derivative(problem.gauge, ctx.prec)
        found = cls(problem, closed, gauge, prec, x0, Product(), acb(1), forcing_of(problem))
        if isinstance(x0, Point):
            found._begin(x0)
        return found

    def copy(self) -> Traveller:
        """Another one at the same place."""
        return replace(self, product=self.product.copy())

    def _begin(self, x: Point) -> None:
        """From (z, z') to (y, y') at x."""
        if self.problem.gauge is not None:
            check_segment(self.problem.system, x, x)
            check_segment(self.problem.gauge_poles, x, x)
        if self.gauge is not None:
            self.product.push((acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1)))
        self.here = x

    def go(self, stops: Sequence[Point], start: State) -> list[State]:
        """Straight on to the last of `stops`; the user's (z, z') at each of them."""
        if self.closed is not None:
            result = [self.by_closed_form(self.closed, stop, start) for stop in stops]
            if isinstance(self.here, Singular) and self.here.is_at(stops[-1]):
                return result
            self.product.push(self._closed_matrix(self.closed, stops[-1], start))
            if isinstance(self.here, Singular):
                self._begin(stops[-1])
        else:
            result = self._leave(self.here, list(stops), start) if isinstance(self.here, Singular) else []
            if isinstance(self.here, Singular):
                return result
            self._check_gauge(self.here, stops[-1])
            while len(result) < len(stops) and stops[len(result)] == self.here:
                result.append(self.state(start))
            here, rest = self.here, list(stops[len(result) :])
            if self.forcing is not None:
                self._forced(self.forcing, here, rest, start, result)
            elif rest:
                for leg in walk(self.problem.system, here, rest, self.prec):
                    if leg.stops:
                        states = leg.states(self.product.apply(start), leg.stops)
                        result += [self._given(state, stop) for state, stop in zip(states, leg.stops, strict=True)]
                    self.product.push(leg.matrix)
        self.growth *= self._growth(stops[-1])
        self.here = stops[-1]
        return result

    def fan(self, stops: list[Point], start: State, side: str | None) -> list[State]:
        """The states at the ends of straight lines from here, in the order of `stops`.

        A disc on the line to the farthest one serves others, too.
        """
        here, system, found = self.here, self.problem.system, dict[int, State]()
        alone = side or self.closed or self.forcing or isinstance(here, Singular) or len(stops) == 1
        if alone or is_split(system, self.prec // max(1, len(stops))):
            return [self.copy().around([stop], start, side)[0] for stop in stops]
        assert isinstance(here, Point)
        waiting = sorted(range(len(stops)), key=lambda i: (stops[i] - here).norm_squared())
        while waiting:
            last, traveller = stops[waiting[-1]], self.product.copy()
            if last == here:
                found |= dict.fromkeys(waiting, self.state(start))
                break
            for leg in walk(system, here, [last], self.prec, expanded=True):
                done = leg.disc.leave == last
                served = [i for i in waiting if (done and stops[i] == last) or leg.disc.serves(system, here, stops[i])]
                ends = [stops[i] for i in served]
                for end in ends:
                    self._check_gauge(here, end)
                states = leg.states(traveller.apply(start), ends) if ends else []
                found |= zip(served, map(self._given, states, ends), strict=True)
                waiting = [i for i in waiting if i not in found]
                traveller.push(leg.matrix)
        return [found[i] for i in range(len(stops))]

    def by_closed_form(self, closed: Closed, stop: Point, start: State) -> State:
        """The user's (z, z') at the end of a straight line from here."""
        check_time()
        here = self.here
        if isinstance(here, Singular):
            return limit(here, start) if here.is_at(stop) else apply(self._closed_matrix(closed, stop, start), start)
        state = self.product.apply(start)
        return self._given(state if stop == here else apply(self._closed_matrix(closed, stop, start), state), stop)

    def _closed_matrix(self, closed: Closed, stop: Point, start: State) -> Matrix:
        if isinstance(self.here, Singular):
            assert isinstance(closed, Classical)
            needed = not start[0].is_zero(), not start[1].is_zero()
            return frobenius(closed, self.here, self.problem.gauge, needed, ctx.prec).at(stop)
        self._check_gauge(self.here, stop)
        matrix = closed.leg(self.here, stop)
        return real_part(matrix) if self.here.is_real() and stop.is_real() else matrix

    def _check_gauge(self, here: Point, stop: Point) -> None:
        """Raise InputError where the gauge has a pole on the way, at a point where S is regular."""
        if self.problem.gauge is not None and len(self.problem.gauge_poles.den) > 1:
            check_segment(self.problem.gauge_poles, here, stop)

    def _forced(self, forcing: Forcing, here: Point, stops: list[Point], start: State, result: list[State]) -> None:
        """As the end of `go`, with a right-hand side."""
        forcing.check(here, stops[-1] if stops else here)

        def inverse(x: acb, analytic: bool) -> acb:
            if not isinstance(self.gauge, LogDerivative) or not isinstance(self.here, Point):
                return acb(1)
            return (-self.gauge.exponent(to_acb(self.here), x, analytic=analytic)).exp() / self.growth

        for stop in stops:
            for leg in walk(self.problem.system, here, [stop], self.prec, expanded=True):
                change = forcing.step(leg, inverse)
                self.particular = apply(leg.matrix, (self.particular[0] + change[0], self.particular[1] + change[1]))
                self.product.push(leg.matrix)
            here = stop
            result.append(self._given(self.product.apply(start), stop))

    def state(self, start: State) -> State:
        """The user's (z, z') here."""
        assert isinstance(self.here, Point)
        return self._given(self.product.apply(start), self.here)

    def around(self, stops: list[Point], start: State, side: str | None) -> list[State]:
        """As `go`, around singular points of the real axis on this side.

        A detour is as wide as its distance to the start and to other singular points allows: near an irregular one the
        solutions are as large as exp(1/distance).  Stops that are nearer to it are reached along the axis from its ends.
        """
        result: list[State] = []
        for sign, cut, place, unit in self._cuts(stops[-1]) if side else ():
            first, last = Point(cut - sign * unit), Point(cut + sign * unit)
            far, near, behind = (
                [stop for stop in stops if sign * (stop.x - mark) <= 0] for mark in (first.x, place, last.x)
            )
            near, behind, stops = near[len(far) :], behind[len(near) :], stops[len(behind) :]
            result += self.go([*far, first], start)[: len(far)]
            result += self.copy().go(near, start) if near else []
            self.go([Point(cut, unit if side == "above" else -unit)], start)
            self.go([last], start)
            result += self.copy().go(behind[::-1], start)[::-1] if behind else []
        return [*result, *(self.go(stops, start) if stops else [])]

    def _cuts(self, last: Point) -> Iterator[tuple[int, Any, Any, Any]]:
        """The detours on the way to `last`: direction, a short number beside the singular point, the point, and radius."""
        here, singular = self.here, self.problem.singular_points(256)
        if isinstance(here, Singular) and here.inverted:
            far = 2 * max(abs(p.x) for p in (last, *singular)) + 1
            here = Point(far if last.x > 0 else -far)
        elif isinstance(here, Singular):
            here = here.near
        if not (here.is_real() and last.is_real()):
            raise InputError("a side of the real axis needs a start and points on it", hint="path=[v1, v2, ...]")
        sign = 1 if last.x > here.x else -1
        cuts = {p.x for p in singular if p.is_real() and 0 < sign * (p.x - here.x) < sign * (last.x - here.x)}
        for cut in sorted(cuts, reverse=sign < 0):
            squares = [(p - Point(cut)).norm_squared() / 4 for p in singular if p != Point(cut)]
            square = min([*squares, (here - Point(cut)).norm_squared()])
            unit = power_of_two((square.p.bit_length() - square.q.bit_length() - 1) // 2)
            yield sign, (cut / unit * 16).floor() * unit / 16, cut, unit

    def _leave(self, point: Singular, stops: list[Point], start: State) -> list[State]:
        """Out of the disc around a singular point; the states at the stops inside, and before at the point itself."""
        count = sum(map(point.is_at, stops))
        states = [limit(point, start)] * count if count else []
        if len(stops) == count:
            return states
        needed = not start[0].is_zero(), not start[1].is_zero()
        last, bound = junction(point, stops[-1], self.prec)
        basis = Basis(point, last, stops[-1], bound, self.prec, needed)
        ahead, matrix, place = stops[-1] - last, None, None
        for stop in stops[count:]:
            step = stop - last
            if step.x * ahead.x + step.y * ahead.y <= 0:
                matrix, place = basis.at(stop), stop
                states.append(apply(matrix, start))
        self.product.push(basis.at(last) if matrix is None or place != last else matrix)
        self._begin(last)
        return states

    def _growth(self, x: Point) -> acb:
        """g(x)/g(here)."""
        assert isinstance(self.here, Point)
        if self.gauge is None or x == self.here:
            return acb(1)
        factor = self.gauge.growth(to_acb(self.here), to_acb(x))
        return acb(factor.real) if self.here.is_real() and x.is_real() else factor

    def _given(self, state: State, x: Point) -> State:
        """The user's (z, z') at x."""
        state = state[0] + self.particular[0], state[1] + self.particular[1]
        if self.gauge is None:
            return state
        factor = self.growth * self._growth(x)
        return state[0] * factor, (state[1] + self.gauge.value(to_acb(x)) * state[0]) * factor

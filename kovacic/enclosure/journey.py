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
from typing import Any

from flint import acb, ctx

from kovacic.enclosure.classical import Classical, Solutions, frobenius
from kovacic.enclosure.closed_form import ClosedForm
from kovacic.enclosure.constants import Number
from kovacic.enclosure.embedded import EmbeddedGauge
from kovacic.enclosure.exponential import LogDerivative, rational_log_derivative
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.frobenius import Basis, junction, limit
from kovacic.enclosure.matrices import Product, State, apply, real_part
from kovacic.enclosure.points import Point, power_of_two, to_acb
from kovacic.enclosure.problem import NumericProblem, check_segment
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import Start, middle, spread
from kovacic.enclosure.transport import walk
from kovacic.errors import InputError
from kovacic.limits import Budget


@dataclass(frozen=True)
class Journey:
    """From the start along the polygon `vertices`, then from its end a straight line to each target, or (`chain`) from
    target to target.  `side` says on which side of the real axis singular points on it are passed ("above", "below")."""

    problem: NumericProblem
    start: Start
    vertices: tuple[Number, ...]
    targets: tuple[Number, ...]
    chain: bool = False
    side: str | None = None
    closed: ClosedForm | Classical | None = None

    @property
    def is_exact(self) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.start.place, *self.start.data, *self.targets)
        return self.problem.is_exact and not any(getattr(number, "fixed", False) for number in numbers)

    def states(self, prec: int, budget: Budget) -> list[State]:
        """The states at the targets, at about so many bits: exact points are travelled, the midpoints of balls."""
        problem, place = self.problem.at(prec), self.start.place
        start, stops = self.start.state(problem, prec, budget), [middle(target) for target in self.targets]
        here = place if isinstance(place, Singular) else middle(place)
        traveller = Traveller.at(problem, here, self.closed, prec, budget)
        for vertex in self.vertices:
            traveller.go([middle(vertex)], start)
        result: dict[int, State] = {}
        branches = [[i] for i in range(len(stops))] if self.chain else _branches(traveller.here, stops)
        for branch in branches:
            one = traveller if self.chain else traveller.copy()
            states = one.around([stops[i] for i in branch], start, self.side)
            result |= zip(branch, states, strict=True)
        return [spread(problem, target, result[i]) for i, target in enumerate(self.targets)]


def _branches(here: Point | Singular, stops: list[Point]) -> list[list[int]]:
    """The stops in the order of visit: straight lines to points on one ray from here share their way, on the real axis two
    chains (right and left)."""
    origin, inverted = (here.near, here.inverted) if isinstance(here, Singular) else (here, False)
    keys = {i: stop.x for i, stop in enumerate(stops) if origin.is_real() and stop.is_real()}
    right = sorted((i for i in keys if keys[i] >= origin.x), key=keys.__getitem__, reverse=inverted)
    left = sorted((i for i in keys if keys[i] < origin.x), key=keys.__getitem__, reverse=not inverted)
    return [chain for chain in (right, left, *([i] for i in range(len(stops)) if i not in keys)) if chain]


@dataclass
class Traveller:
    """Where we are, and the map from the start's coordinates to (y, y') here: `product`, and `particular` is added.

    `growth` is g here over g at the first point where there is a state.
    """

    problem: NumericProblem
    closed: ClosedForm | Classical | None
    gauge: LogDerivative | EmbeddedGauge | None
    prec: int
    budget: Budget
    here: Point | Singular
    product: Product
    growth: acb
    forcing: Forcing | None = None
    particular: State = (acb(0), acb(0))

    @classmethod
    def at(
        cls,
        problem: NumericProblem,
        x0: Point | Singular,
        closed: ClosedForm | Classical | None,
        prec: int,
        budget: Budget,
    ) -> Traveller:
        """At the start of a journey."""
        gauge: LogDerivative | EmbeddedGauge | None = None
        if problem.embedded is not None and problem.embedded.gauge is not None:
            gauge = problem.embedded.growth_of(problem.embedded.gauge, budget)
        elif problem.gauge is not None:
            gauge = rational_log_derivative(problem.gauge, ctx.prec)
        found = cls(problem, closed, gauge, prec, budget, x0, Product(), acb(1), forcing_of(problem))
        if isinstance(x0, Point):
            found._begin(x0)
        return found

    def copy(self) -> Traveller:
        """Another one at the same place."""
        return replace(self, product=self.product.copy())

    def _begin(self, x: Point) -> None:
        """From (z, z') to (y, y') at x."""
        if self.problem.gauge is not None:
            check_segment(self.problem.gauge_system, x, x)
        if self.gauge is not None:
            self.product.push((acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1)))
        self.here = x

    def go(self, stops: Sequence[Point], start: State) -> list[State]:
        """Straight on to the last of `stops`; the user's (z, z') at each of them."""
        result: list[State] = []
        if isinstance(self.here, Singular):
            result = self._leave(self.here, list(stops), start)
            if isinstance(self.here, Singular):
                return result
        here = self.here
        if self.problem.gauge is not None and stops[len(result) :]:
            check_segment(self.problem.gauge_system, here, stops[-1])
        while len(result) < len(stops) and stops[len(result)] == here:
            result.append(self.state(start))
        rest = list(stops[len(result) :])
        if rest and self.closed is not None:
            for stop in rest:
                self.budget.check()
                matrix, way = self.closed.leg(here, stop), self.product.copy()
                way.push(real_part(matrix) if here.is_real() and stop.is_real() else matrix)
                result.append(self._given(way.apply(start), stop))
            self.product = way
        elif self.forcing is not None:
            self._forced(self.forcing, here, rest, start, result)
        elif rest:
            for leg in walk(self.problem.system, here, rest, self.prec, self.budget):
                if leg.stops:
                    states = leg.states(self.product.apply(start))
                    result += [self._given(state, stop) for state, stop in zip(states, leg.stops, strict=True)]
                self.product.push(leg.matrix)
        self.growth *= self._growth(stops[-1])
        self.here = stops[-1]
        return result

    def _forced(self, forcing: Forcing, here: Point, stops: list[Point], start: State, result: list[State]) -> None:
        """As the end of `go`, with a right-hand side."""
        forcing.check(here, stops[-1] if stops else here)

        def inverse(x: acb, analytic: bool) -> acb:
            if not isinstance(self.gauge, LogDerivative) or not isinstance(self.here, Point):
                return acb(1)
            return (-self.gauge.exponent(to_acb(self.here), x, analytic=analytic)).exp() / self.growth

        for stop in stops:
            for leg in walk(self.problem.system, here, [stop], self.prec, self.budget, expanded=True):
                change = forcing.step(leg, inverse, self.budget)
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
        count = 0 if point.inverted or not point.exact else stops.count(point.near)
        states = [limit(point, start, self.budget)] * count if count else []
        if len(stops) == count:
            return states
        needed, last = (not start[0].is_zero(), not start[1].is_zero()), stops[-1]
        basis: Basis | Solutions
        if isinstance(self.closed, Classical):
            basis = frobenius(self.closed, point, self.problem.gauge, needed, ctx.prec)
        else:
            last, bound = junction(point, last, self.prec)
            basis = Basis(point, last, stops[-1], bound, self.prec, self.budget, needed)
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

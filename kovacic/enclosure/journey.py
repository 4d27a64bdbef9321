"""Where a solution is asked for, and how a state gets there: along a polygon, then along straight lines to the targets.

A state (y, y') of the normal form is carried by the transition matrices of straight legs, Taylor discs (each serves all
targets inside it) or a closed form; with a gauge g, z = g y is the user's solution, and g/g(x0) is followed along the same
legs (`kovacic.enclosure.exponential`):

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u),    E = exp int_u^v gamma,    G(x) = (1, 0; gamma(x), 1).

A pole of gamma is a singular point of the user's equation even where S is regular: legs through one are refused.  A journey
from a regular singular point begins with its Frobenius series.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import acb

from kovacic.enclosure.closed_form import ClosedForm
from kovacic.enclosure.embedded import EmbeddedGauge
from kovacic.enclosure.exponential import LogDerivative
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.frobenius import Basis, junction, limit
from kovacic.enclosure.matrices import Product, State, apply, real_part
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.problem import NumericProblem, System, check_segment
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.transport import walk
from kovacic.errors import InputError
from kovacic.limits import Budget


@dataclass(frozen=True)
class Itinerary:
    """Where to go: the polygon `trunk` from x0, then from its end a straight line to each target, or (`chain`) from
    target to target.  `side` says on which side of the real axis singular points on it are passed ("above", "below")."""

    trunk: tuple[Point | Singular, ...]
    targets: tuple[Point, ...]
    chain: bool = False
    side: str | None = None

    @property
    def start(self) -> Point | Singular:
        """x0."""
        return self.trunk[0]

    def branches(self) -> list[list[int]]:
        """The targets in the order of visit: chains that start at the end of the trunk.

        Straight lines to points on one ray from there share their way: on the real axis two chains (right and left).
        """
        here, indices = self.trunk[-1], range(len(self.targets))
        if self.chain:
            return [[i] for i in indices]
        origin, inverted = (here.near, here.inverted) if isinstance(here, Singular) else (here, False)
        keys = {i: _order(t.re) for i, t in enumerate(self.targets) if origin.is_real() and t.is_real()}
        zero = _order(origin.re)
        right = sorted((i for i in keys if keys[i] >= zero), key=keys.__getitem__, reverse=inverted)
        left = sorted((i for i in keys if keys[i] < zero), key=keys.__getitem__, reverse=not inverted)
        return [chain for chain in (right, left, *([i] for i in indices if i not in keys)) if chain]


def carry(
    problem: NumericProblem, plan: Itinerary, start: State, closed: ClosedForm | None, prec: int, budget: Budget
) -> list[State]:
    """The states at the targets; `start` are y(x0), y'(x0), or the coordinates in the Frobenius basis."""
    traveller = Traveller.at(problem, plan.start, closed, prec, budget)
    for vertex in plan.trunk[1:]:
        assert isinstance(vertex, Point)
        traveller.go([vertex], start)
    result: dict[int, State] = {}
    for branch in plan.branches():
        one = traveller if plan.chain else traveller.copy()
        states = one.around([plan.targets[i] for i in branch], start, plan.side)
        result |= zip(branch, states, strict=True)
    return [result[i] for i in range(len(plan.targets))]


@dataclass
class Traveller:
    """Where we are, and the map from the start's coordinates to (y, y') here: `product`, and `particular` is added.

    `growth` is g here over g at the first point where there is a state.
    """

    problem: NumericProblem
    closed: ClosedForm | None
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
        cls, problem: NumericProblem, x0: Point | Singular, closed: ClosedForm | None, prec: int, budget: Budget
    ) -> Traveller:
        """At the start of a journey."""
        gauge: LogDerivative | EmbeddedGauge | None = None
        if problem.embedded is not None and problem.embedded.gauge is not None:
            gauge = problem.embedded.growth_of(problem.embedded.gauge, budget)
        elif problem.gauge is not None:
            gauge = LogDerivative.make(problem.gauge, None)
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
            check_segment(System.of(self.problem.gauge), x, x)
        if self.gauge is not None:
            self.product.push((acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1)))
        self.here = x

    def go(self, stops: Sequence[Point], start: State) -> list[State]:
        """Straight on to the last of `stops`; the user's (z, z') at each of them."""
        result: list[State] = []
        stops = list(stops)
        if isinstance(self.here, Singular):
            result = self._at_once(self.here, stops, start)
            if len(result) == len(stops):
                return result
            result += self._leave(self.here, stops[len(result) :], start)
        here = self.here
        assert isinstance(here, Point)
        if self.problem.gauge is not None and stops[len(result) :]:
            check_segment(System.of(self.problem.gauge), here, stops[-1])
        while len(result) < len(stops) and stops[len(result)] == here:
            result.append(self._given(self.product.apply(start), here))
        rest = stops[len(result) :]
        if rest and self.closed is not None:
            for stop in rest:
                self.budget.check()
                matrix, way = self.closed.leg(here, stop), self.product.copy()
                way.push(real_part(matrix) if here.is_real() and stop.is_real() else matrix)
                result.append(self._given(way.apply(start), stop))
            self.product = way
        elif rest and self.forcing is not None:
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
        forcing.check(here, stops[-1])
        for stop in stops:
            for leg in walk(self.problem.system, here, [stop], self.prec, self.budget, expanded=True):

                def inverse(x: acb, analytic: bool) -> acb:
                    if not isinstance(self.gauge, LogDerivative) or not isinstance(self.here, Point):
                        return acb(1)
                    return (-self.gauge.exponent(to_acb(self.here), x, analytic=analytic)).exp() / self.growth

                change = forcing.step(leg, inverse, self.budget)
                moved = (self.particular[0] + change[0], self.particular[1] + change[1])
                self.particular = apply(leg.matrix, moved)
                self.product.push(leg.matrix)
            here = stop
            result.append(self._given(self.product.apply(start), stop))

    def state(self, start: State) -> State:
        """The user's (z, z') here."""
        assert isinstance(self.here, Point)
        return self._given(self.product.apply(start), self.here)

    def around(self, stops: Sequence[Point], start: State, side: str | None) -> list[State]:
        """As `go`, around singular points of the real axis on this side."""
        result: list[State] = []
        for group, detour in self._stretches(list(stops)) if side else [(list(stops), [])]:
            result += self.go([*group, *detour[:1]], start)[: len(group)]
            for vertex in detour[1:]:
                turned = vertex if side == "above" else Point(vertex.re, -vertex.im)
                self.go([turned], start)
        return result

    def _stretches(self, stops: list[Point]) -> list[tuple[list[Point], list[Point]]]:
        """The stops before each singular point of the axis, and the way around it through the upper half-plane."""
        here = self.here.near if isinstance(self.here, Singular) else self.here
        singular = self.problem.singular_points(256)
        if not (here.is_real() and stops[-1].is_real()):
            raise InputError("a side of the real axis needs a start and points on it", hint="path=[v1, v2, ...]")
        sign = 1 if stops[-1].re > here.re else -1
        cuts = sorted(
            {p.re for p in singular if p.is_real() and 0 < sign * (p.re - here.re) < sign * (stops[-1].re - here.re)}
        )
        result, done = [], 0
        for cut in cuts if sign > 0 else reversed(cuts):
            count = sum(sign * (stop.re - cut) < 0 for stop in stops)
            near = [here, *stops, *(p for p in singular if p != Point(cut))]
            square = min(((p - Point(cut)).norm_squared() for p in near if p != Point(cut)), default=Fraction(1))
            unit = Fraction(2) ** ((square.numerator.bit_length() - square.denominator.bit_length()) // 2 - 3)
            middle = round(cut / unit * 16) * unit / 16
            detour = [Point(middle - sign * unit), Point(middle, unit), Point(middle + sign * unit)]
            result.append((stops[done:count], detour))
            done = count
        return [*result, (stops[done:], [])]

    def _at_once(self, point: Singular, stops: list[Point], start: State) -> list[State]:
        """The states at the stops that are the singular point itself; nothing moves."""
        count = 0 if point.inverted or not point.exact else sum(stop == point.near for stop in stops)
        return [limit(point, start, self.budget)] * count if count else []

    def _leave(self, point: Singular, stops: list[Point], start: State) -> list[State]:
        """Out of the disc around a singular point; the states at the stops inside."""
        last, bound = junction(point, stops[-1], self.prec)
        needed = [not coordinate.is_zero() for coordinate in start]
        basis = Basis(point, last, stops[-1], bound, self.prec, self.budget, needed)
        ahead = stops[-1] - last
        inside = [stop for stop in stops if _inner(stop - last, ahead) <= 0]
        states = [apply(basis.at(stop), start) for stop in inside]
        self.product.push(basis.at(last))
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


def _inner(a: Point, b: Point) -> Fraction:
    """The real inner product of two vectors of the plane."""
    return a.re * b.re + a.im * b.im


def _order(value: Fraction) -> tuple[float, Fraction]:
    """A key that sorts as the number does: first by the nearest double, which is quick to compare."""
    near = value.numerator.bit_length() - value.denominator.bit_length() < 1000
    return float(value) if near else math.inf if value > 0 else -math.inf, value

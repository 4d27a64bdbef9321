"""An equation seen from the middle of a piece, x = c + H u, |u| <= 1, and the states of one of its solutions in balls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import acb, arb, arb_poly, fmpq_poly

from kovacic.doubles.region import Region, region_of
from kovacic.enclosure.forcing import Forcing, forcing_of
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import Point, power_of_two
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.states import evaluate_states
from kovacic.limits import Limits


@dataclass(frozen=True)
class Chart:
    """The equation a y'' + b y' + c y = f, and which solution: the options of `evaluate`."""

    problem: NumericProblem
    given: dict[str, Any]

    def region(self, interval: tuple[object, object]) -> Region:
        """See `region_of`."""
        return region_of(self.problem, interval)[0]

    def states(self, points: Sequence[Point], digits: int, limits: Limits) -> list[State]:
        """y and y', to so many digits where they can be had."""
        return [s.state for s in evaluate_states(self.problem, points, digits=digits, limits=limits, **self.given)]

    @cached_property
    def forcing(self) -> Forcing | None:
        """f/a, None where it is zero."""
        return forcing_of(self.problem)

    @cached_property
    def _equation(self) -> Sequence[Any]:
        return self.problem.equation if self.problem.embedded is None else self.problem.embedded.equation()

    @cached_property
    def _singular(self) -> list[Point]:
        return self.problem.singular_points(128)

    def local(self, centre: Point, e: int, terms: int) -> list[list[arb]] | None:
        """a, H b and H^2 c over a(c), so many terms in u; None where a singular point is nearer than 4 H."""
        if any((centre - point).norm_squared() < power_of_two(2 * e + 4) for point in self._singular):
            return None
        line: Any = fmpq_poly([centre.x, power_of_two(e)])
        line = line if self.problem.embedded is None else arb_poly(line)
        found = [[arb(v) for v in part(line).coeffs()[:terms]] for part in self._equation]
        if found[0][0].contains(0):
            return None
        factors = [arb((1, k * e)) / found[0][0] for k in range(3)]
        return [[v * factor for v in part] for part, factor in zip(found, factors, strict=True)]

    def source(self, centre: Point, e: int, u: arb) -> arb:
        """H^2 f/a at u."""
        assert self.forcing is not None
        return self.forcing.value(acb(centre.x) + acb(u) * acb(arb((1, e)))).real * arb((1, 2 * e))

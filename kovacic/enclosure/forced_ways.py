"""Equations with rational coefficients and a right-hand side, at many points or far away: on ways that are kept.

`kovacic.enclosure.forcing` integrates what the right-hand side adds, disc by disc, anew for each target.  Where it is analytic
all along the real way, the power series of coefficients and right-hand side (`kovacic.enclosure.jets`) give the solution in
each disc as a polynomial, which serves all targets there: as for equations whose coefficients aren't rational.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy
from flint import acb, arb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.atoms import Atoms
from kovacic.enclosure.analytic import AnalyticJourney
from kovacic.enclosure.constants import Number
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.points import ExactPoint
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.removable import without_removable
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.system import check_segment
from kovacic.equation import Equation
from kovacic.errors import InputError

_FEW = 2
"""So many targets are integrated, one by one, if they are near."""
_FAR = 60.0
_STEEP = 1e6
"""int |S|^(1/2) to a target beyond which even one is worth a way, and beyond which a way would have too many discs."""
_POINTS = 12
_BITS = 53


@dataclass
class ForcedWays:
    """The journey that is asked for, the same by power series, and how many targets were asked for before.

    Where the right-hand side has a removable singularity, as sin(x)/x at 0, an integration doesn't know it.
    """

    asked: Journey
    journey: AnalyticJourney
    is_removable: bool
    served: int = 0

    def pay(self, targets: Sequence[Number]) -> bool:
        """Are they cheaper for these targets than an integration for each?"""
        stops = [middle(target) for target in targets]
        if not stops:
            return False
        here = self._here
        if not all(point.is_real() for point in (here, *stops)):
            return self.is_removable
        self.served += len(targets)
        places = [stop.x for stop in stops]
        return self._ways_pay(here.x, min(places), max(places))

    def _ways_pay(self, here: Any, leftmost: Any, rightmost: Any) -> bool:
        """Are those to the ends allowed, and neither too steep nor, for few targets, too short?"""
        for end in (leftmost, rightmost):
            if not self._is_allowed(ExactPoint(end)):
                return False
        growth = max(self._growth(here, leftmost), self._growth(here, rightmost))
        is_worth = self.is_removable or self.served > _FEW or growth > _FAR
        return is_worth and growth < _STEEP

    def _is_allowed(self, end: ExactPoint) -> bool:
        """May one go straight to this end, whatever side of singular points was asked for?"""
        return self.asked.side is None or self._is_free(end)

    def _is_free(self, end: ExactPoint) -> bool:
        """Is there no pole of the coefficients on the straight way?  Then it is homotopic to those on either side."""
        problem = self.asked.problem
        try:
            check_segment(problem.system, self._here, end)
            check_segment(problem.gauge_poles, self._here, end)
        except InputError:
            return False
        return True

    def _growth(self, a: Any, b: Any) -> float:
        """int |S|^(1/2) between two numbers, about: no bound."""
        with working_precision(_BITS):
            num, den = self.asked.problem.polynomials()
            points = [acb(a + (b - a) * fmpq(2 * k + 1, 2 * _POINTS)) for k in range(_POINTS)]
            sizes = [float(abs(num(x) / den(x)).sqrt().mid()) for x in points]
            length = float(abs(arb(b - a)).mid())
        return length * sum(size for size in sizes if size < math.inf) / _POINTS

    @property
    def _here(self) -> ExactPoint:
        """Where the straight ways begin."""
        last = self.journey.x0
        if self.journey.vertices:
            last = self.journey.vertices[-1]
        return middle(last)


@lru_cache(maxsize=32)
def ways_of(journey: Journey) -> ForcedWays | None:
    """The ways of a journey; None where constants aren't rational."""
    problem = journey.problem
    start = journey.start
    if problem.right is None or problem.embedded is not None:
        return None
    if start.decaying or isinstance(start.place, Singular):
        return None
    coefficients = _coefficients(problem.right)
    is_removable = without_removable(coefficients.f, coefficients.variable) != coefficients.f
    analytic = AnalyticJourney(coefficients, start.place, start.data, journey.vertices, journey.chain)
    return ForcedWays(journey, analytic, is_removable)


def _coefficients(equation: Equation) -> Coefficients:
    """b/a, c/a and (f + h)/a."""
    x = sympy.Symbol(equation.variable)
    atoms = Atoms(x)
    over = 1 / equation.a
    b, c, f, inverse = (atoms.ratio(part) for part in (equation.b * over, equation.c * over, equation.f * over, over))
    if equation.h is not None:
        f += equation.h.xreplace(dict.fromkeys(equation.h.free_symbols, x)) * inverse
    return Coefficients(x, b, c, f)

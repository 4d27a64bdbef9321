"""Equations with rational coefficients and a right-hand side, along straight ways that are kept.

The power series of coefficients and right-hand side (`kovacic.enclosure.jets`) give the solution in each disc as a polynomial,
which serves all targets there.  `kovacic.enclosure.forcing` integrates where constants aren't rational, around singular points,
and where the right-hand side isn't analytic at an end of the way, as sqrt(x) at 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy

from kovacic.closed_form.atoms import Atoms
from kovacic.enclosure.analytic import AnalyticJourney
from kovacic.enclosure.constants import Number
from kovacic.enclosure.journey import Journey
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.start import middle
from kovacic.enclosure.system import check_segment
from kovacic.equation import Equation
from kovacic.errors import InputError


@lru_cache(maxsize=32)
def forced_journey(journey: Journey) -> AnalyticJourney | None:
    """The same journey by power series; None without a right-hand side, and where there is no such journey."""
    problem = journey.problem
    start = journey.start
    if problem.right is None or problem.embedded is not None:
        return None
    if start.decaying or isinstance(start.place, Singular):
        return None
    return AnalyticJourney(_coefficients(problem.right), start.place, start.data, journey.vertices, journey.chain)


def is_straight(journey: Journey, targets: Sequence[Number]) -> bool:
    """True if the journey goes straight to its targets: no side was asked for, or nothing lies between that has two sides."""
    if journey.side is None:
        return True
    problem = journey.problem
    last = journey.vertices[-1] if journey.vertices else journey.start.place
    assert not isinstance(last, Singular)
    here = middle(last)
    stops = sorted((middle(target) for target in targets), key=lambda stop: stop.x)
    try:
        for stop in {*stops[:1], *stops[-1:]}:
            check_segment(problem.system, here, stop)
            check_segment(problem.gauge_poles, here, stop)
    except InputError:
        return False
    return here.is_real() and all(stop.is_real() for stop in stops)


def _coefficients(equation: Equation) -> Coefficients:
    """b/a, c/a and (f + h)/a."""
    x = sympy.Symbol(equation.variable)
    atoms = Atoms(x)
    over = 1 / equation.a
    b, c, f, inverse = (atoms.ratio(part) for part in (equation.b * over, equation.c * over, equation.f * over, over))
    if equation.h is not None:
        f += equation.h.xreplace(dict.fromkeys(equation.h.free_symbols, x)) * inverse
    return Coefficients(x, b, c, f)

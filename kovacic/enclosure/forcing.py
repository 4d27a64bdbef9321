"""Right-hand sides: a y'' + b y' + c y = f by variation of constants, disc by disc.

The guarantee: `Forcing.step` returns balls that contain the coordinates that the right-hand side adds along one disc.

The mathematics.  With z = g y the normal form is y'' = S y + F, F = f/(a g).  In a disc with the solutions y1, y2 that have the
states (1, 0) and (0, 1) at its centre (Wronskian 1), a solution's coordinates change on the way from s to t by

    int_s^t (-y2 F, y1 F) dx.

y1 and y2 are polynomials up to a proven bound delta_k on the way; those are integrated, by FLINT's rigorous quadrature, and
delta_k int |F| is added.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import acb, acb_poly, arb, fmpq

from kovacic.algebra.ratfunc import RatFunc
from kovacic.enclosure.closed_form import value
from kovacic.enclosure.constants import in_balls, to_ball
from kovacic.enclosure.embedded import Embedded, check_apart
from kovacic.enclosure.log_derivative import integral
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, are_real, around_zero, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.system import System, check_segment
from kovacic.enclosure.taylor import error_radii
from kovacic.enclosure.transport import Leg
from kovacic.errors import InputError

_PIECES = 16  # pieces of a way on which |F| is bounded
_LEAST = fmpq(1, 2**40)  # the part of a way that is looked at for a singularity


@dataclass(frozen=True)
class Forcing:
    """(f + h)/a of the user's equation: `rational` is f/a, `function` h, a SymPy expression in `symbol` or None, `over` 1/a.

    `real` says that the coefficients on the left are.
    """

    rational: RatFunc
    function: Any
    over: RatFunc
    symbol: str
    embedded: Embedded | None
    real: bool

    def value(self, x: acb, analytic: bool = False) -> acb:
        """f/a + h/a on a ball; not finite where h isn't analytic, with `analytic`."""
        total = self._at(self.rational, x)
        if self.function is None:
            return total
        numbers = {} if self.embedded is None else {name: to_ball(v) for name, v in self.embedded.values.items()}
        values = {s: (numbers | {self.symbol: x})[s.name] for s in self.function.free_symbols}
        return total + in_balls(self.function, values, analytic=analytic) * self._at(self.over, x)

    def _at(self, function: RatFunc, x: acb) -> acb:
        return value(function, None, x) if self.embedded is None else self.embedded.value(function, x)

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        """Raise InputError where a part has a pole or a branch point on the way.

        At an end it may have a value, such as sqrt(x) at 0, and not be analytic.
        """
        for end in (a, b):
            if not self.value(to_acb(end)).is_finite():
                raise InputError(
                    f"the right-hand side has no value at {end}, an end of the path",
                    hint="choose a point beside it",
                )
        for function in (self.rational, self.over):
            if self.embedded is None:
                check_segment(System.of(function), a, b)
            else:
                check_apart((root for root, _ in self.embedded.poles(function)), to_acb(a), to_acb(b))
        if self.function is not None:
            self._check_analytic(to_acb(a), to_acb(b))

    def _check_analytic(self, a: acb, b: acb) -> None:
        """Raise InputError where the function isn't seen to be analytic on a short piece of the way, its ends left out."""
        pieces = [(fmpq(0), fmpq(1))]
        while pieces:
            low, high = pieces.pop()
            middle = (low + high) / 2
            inside = acb(arb(arb(middle), arb((high - low) / 2).upper()))
            if self.value(a + (b - a) * inside, analytic=True).is_finite():
                continue
            if high - low > _LEAST:
                pieces += [(low, middle), (middle, high)]
            elif low > 0 and high < 1:
                where = a + (b - a) * arb(middle)
                raise InputError(f"{self.function} isn't analytic near {where.mid().str(6, radius=False)}, on the way")

    def step(self, leg: Leg, growth: Callable[[acb, bool], acb], *, on_axis: bool) -> State:
        """What the right-hand side adds to the state where the disc is entered; `growth` is 1/g on a ball.

        `on_axis` says that the whole way is on the real axis, with the centres of its discs, and that g is real on it: it isn't
        enough that the disc is entered and left there, since junctions are rounded.  The right-hand side is analytic inside the
        way, so real on all of it where it is on a part.
        """
        frame = leg.disc.frame
        expansion = leg.expansion
        assert expansion is not None
        centre = to_acb(frame.centre)
        h = acb(arb((1, frame.e)))
        unit = acb(arb((1, -expansion.w)))
        polys = []
        for re, im in expansion.columns:
            poly = acb_poly(re)
            if im is not None:
                poly += acb(0, 1) * acb_poly(im)
            polys.append(poly)
        start = to_acb(leg.disc.enter)
        stop = to_acb(leg.disc.leave)

        def source(x: acb, analytic: bool) -> acb:
            return self.value(x, analytic) * growth(x, analytic)

        step = (stop - start) / _PIECES
        half = arb(0, 0.5)
        pieces = (start + step * acb(arb(2 * k + 1) / 2 + half) for k in range(_PIECES))
        size = sum((abs(source(x, False)) for x in pieces), arb(0)) * abs(step)
        middle = (start + stop) / 2 + step * acb(half) / _PIECES
        real = self.real and on_axis and are_real([self.value(middle)])
        found = []
        for poly, defect in zip(polys, expansion.defect, strict=True):

            def integrand(x: acb, analytic: bool, poly: acb_poly = poly) -> acb:
                return poly((x - centre) / h) * source(x, analytic)

            area = integral(integrand, start, stop) * unit
            error = (size * error_radii(arb((defect + 1, -expansion.w)), frame)[0]).upper()
            total = area + around_zero(error, real=real)
            if real:
                total = acb(total.real)
            found.append(total)
        here = (-found[1] * h, found[0])
        if leg.to_centre is None:
            return here
        d, b, c, a = leg.to_centre  # the adjugate, of determinant 1
        return a * here[0] - b * here[1], -c * here[0] + d * here[1]


def forcing_of(problem: NumericProblem) -> Forcing | None:
    """The right-hand side; None where it is zero."""
    given = problem.right
    if given is None:
        return None
    return Forcing(given.f / given.a, given.h, 1 / given.a, given.variable, problem.embedded, problem.is_real)

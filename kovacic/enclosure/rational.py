"""Ways of equations with rational coefficients: by Taylor discs of the normal form, or by a closed form.

A state (y, y') of the normal form y'' = S y is carried; with a gauge g, z = g y is the user's solution, and on a straight line
from u to v, with gamma = g'/g,

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u),    E = exp int_u^v gamma,    G(x) = (1, 0; gamma(x), 1).

A pole of gamma is a singular point of the user's equation even where S is regular: lines through one are refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import acb, acb_poly

from kovacic.enclosure.classical import Classical, Closed
from kovacic.enclosure.closed_form import value
from kovacic.enclosure.constants import Number
from kovacic.enclosure.frame import foreseen_growth, frequency, largest_exponent
from kovacic.enclosure.frobenius import basis, junction
from kovacic.enclosure.log_derivative import LogDerivative, log_derivative
from kovacic.enclosure.matrices import Matrix, MatrixProduct, State, apply, multiply, real_part
from kovacic.enclosure.oscillation import swing, swing_from
from kovacic.enclosure.points import ExactPoint, power_of_two, to_acb, to_double
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.splitting import is_split
from kovacic.enclosure.start import logarithmic_derivative, spread_by
from kovacic.enclosure.transport import Stop, growth_of_disc, walk
from kovacic.enclosure.way import MAX_DISCS, NOTHING, Forecast, Traveller, Way, WayStep
from kovacic.limits import check_time, count_work


@dataclass(frozen=True, eq=False)
class RationalWay(Way):
    """The user's equation without a right-hand side, in discs of its normal form."""

    problem: NumericProblem
    prec: int = 64

    @property
    def is_exact(self) -> bool:
        return True

    def at(self, prec: int) -> RationalWay:
        return RationalWay(self.problem, prec)

    @cached_property
    def gauge(self) -> LogDerivative | None:
        """gamma; None for a normal form."""
        return None if self.problem.gauge is None else log_derivative(self.problem.gauge)

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        self.problem.check_segment(a, b)

    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        system = self.problem.system
        enter, leave = self._in_discs(a, b)
        # A disc of growth g bits, on either side of its centre, has int |S|^(1/2) below 2 (g + 10) log 2.
        in_a_disc = 2 * (growth_of_disc(self.prec, alone=True) + 10) * math.log(2)
        found = Forecast(enter, leave, lambda: foreseen_growth(frequency(system), enter, leave), in_a_disc)
        e = largest_exponent(system, enter)
        if e is not None and power_of_two(2 * e) * MAX_DISCS**2 < (leave - enter).norm_squared():
            found.refuse()  # too many steps, were all as short as the first one has to be
        return found

    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[WayStep]:
        system = self.problem.system
        split = alone and is_split(system, self.prec, a, b)
        enter, leave = self._in_discs(a, b)
        if enter != a:
            yield swing(system, a, enter, self.prec)
        yield from walk(system, enter, leave, self.prec, growth=growth_of_disc(self.prec, alone=alone), split=split)
        if leave != b:
            yield swing(system, leave, b, self.prec)

    def _in_discs(self, a: ExactPoint, b: ExactPoint) -> tuple[ExactPoint, ExactPoint]:
        """The part of the way that goes by discs: far out, solutions that oscillate are known by amplitude and phase."""
        system = self.problem.system
        return swing_from(system, b, a, self.prec), swing_from(system, a, b, self.prec)

    def into(self, x: ExactPoint) -> Matrix | None:
        return None if self.gauge is None else (acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1))

    def out_of(self, a: ExactPoint, x: ExactPoint) -> Matrix | None:
        if self.gauge is None:
            return None
        E = self.gauge.growth(to_acb(a), to_acb(x))
        if a.is_real() and x.is_real():
            E = acb(E.real)
        return E, acb(0), E * self.gauge.value(to_acb(x)), E

    def spread(self, number: Number, state: State) -> State:
        def coefficients(ball: acb) -> tuple[acb, acb, acb, bool]:
            top, first, last = (acb_poly(poly)(ball) for poly in self.problem.equation)
            return first / top, last / top, acb(0), True

        return spread_by(coefficients, number, state)

    def decay_rate(self, x: ExactPoint) -> acb:
        system = self.problem.system
        prec = self.prec + 20
        rate = logarithmic_derivative(RationalWay(NumericProblem(system), prec), system, x, prec)
        return rate if self.problem.gauge is None else rate + value(self.problem.gauge, None, to_acb(x))

    def departure(self, point: Singular, stop: ExactPoint, start: State) -> tuple[ExactPoint, Matrix]:
        last, bound = junction(point, stop, self.prec)
        needed = not start[0].is_zero(), not start[1].is_zero()
        return last, basis(point, last, stop, bound, self.prec, needed=needed)

    def fan(self, traveller: Traveller, stops: Sequence[ExactPoint]) -> dict[ExactPoint, State]:
        here = traveller.here
        found: dict[ExactPoint, State] = {}
        ends = stops if isinstance(here, Singular) else [here, *stops]
        is_far = is_split(self.problem.system, self.prec // len(stops), *ends)
        if is_far or isinstance(here, Singular):
            for first, *others in sides(here, stops):
                one = traveller.moved(first)
                found[first] = one.state
                found |= one.fan(others) if others else {}
            return found
        if here.is_real() and all(stop.is_real() for stop in stops):
            return traveller.along_rays(stops)
        return self._by_discs(traveller, here, stops)

    def _by_discs(self, traveller: Traveller, here: ExactPoint, stops: Sequence[ExactPoint]) -> dict[ExactPoint, State]:
        """Along the line to the farthest stop, again and again: the discs on it serve others, too."""
        origin = to_double(here)
        found: dict[ExactPoint, State] = {}
        waiting = sorted(Stop.all(stops), key=lambda stop: abs(stop.near - origin))
        inward = self.into(here)
        while waiting:
            farthest = waiting[-1].point
            self.check(here, farthest)
            product = traveller.product if inward is None else traveller.product.after(inward)
            ahead = self.forecast(here, farthest)
            for number, leg in enumerate(walk(self.problem.system, here, farthest, self.prec), 1):
                served = [*leg.disc.served(self.problem.system, here, waiting)]
                if served:
                    local = leg.local(product.apply(traveller.start))
                    for stop in served:
                        if self.gauge is not None:
                            self.check(here, stop.point)
                        outward = self.out_of(here, stop.point)
                        state = local.state(stop.point)
                        found[stop.point] = state if outward is None else apply(outward, state)
                    waiting = [stop for stop in waiting if stop.point not in found]
                if leg.disc.leave != farthest:  # the matrix of the last leg isn't needed
                    product = product.after(leg.matrix)
                    ahead.check(number)
        return found


@dataclass(frozen=True, eq=False)
class ClosedWay(RationalWay):
    """The same by a closed form of the solutions of its normal form, in one step to each target."""

    closed: Closed | None = None

    def carried(
        self, a: ExactPoint, b: ExactPoint, product: MatrixProduct, particular: State
    ) -> tuple[MatrixProduct, State]:
        assert self.closed is not None
        check_time()
        count_work(self.prec)
        self.check(a, b)
        matrix = self.closed.leg(a, b)
        if a.is_real() and b.is_real():
            matrix = real_part(matrix)
        inward = self.into(a)
        outward = self.out_of(a, b)
        if inward is not None and outward is not None:
            matrix = multiply(outward, multiply(matrix, inward))
        return product.after(matrix), NOTHING

    def fan(self, traveller: Traveller, stops: Sequence[ExactPoint]) -> dict[ExactPoint, State]:
        return {stop: traveller.moved(stop).state for stop in stops}

    def departure(self, point: Singular, stop: ExactPoint, start: State) -> tuple[ExactPoint, Matrix]:
        assert isinstance(self.closed, Classical)
        check_time()
        count_work(self.prec)
        needed = not start[0].is_zero(), not start[1].is_zero()
        return stop, self.closed.frobenius(point, self.problem.gauge, needed, stop)


def way_for(problem: NumericProblem) -> Way:
    """The way of an equation with rational coefficients."""
    if problem.right is None and problem.embedded is None:
        return RationalWay(problem)
    from kovacic.enclosure.constant import way_of  # imports SymPy

    return way_of(problem)


def sides(here: ExactPoint | Singular, stops: Sequence[ExactPoint]) -> list[list[ExactPoint]]:
    """The stops by straight ways that are shared: those on the same side on the real axis, in the order of visit (from
    infinity the farthest first), and each of the others alone."""
    origin = here.near if isinstance(here, Singular) else here
    from_infinity = isinstance(here, Singular) and here.inverted
    alone = [[stop] for stop in stops if not (origin.is_real() and stop.is_real())]
    on_axis = sorted((stop for stop in stops if origin.is_real() and stop.is_real()), key=lambda stop: stop.x)
    right = [stop for stop in on_axis if stop.x >= origin.x]
    left = [stop for stop in on_axis if stop.x < origin.x]
    if from_infinity:
        right.reverse()
    else:
        left.reverse()
    return [group for group in (right, left, *alone) if group]

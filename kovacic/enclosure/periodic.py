"""Coefficients with a common period T: any number of periods in one step.

With the map P from the state at a to that at a + T, affine where there is a right-hand side, and R from a to a + r, the map to
a + n T + r is R P^n [Floquet].  T is known by a ball: discs lead to the midpoint of a + T, and its state is spread over the
ball.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import gcd, lcm
from typing import Any

import sympy
from flint import arb, ctx

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.analytic import AnalyticWay
from kovacic.enclosure.constants import Constant, in_balls, to_ball
from kovacic.enclosure.matrices import Matrix, MatrixProduct, State, apply, fundamental, identity, multiply
from kovacic.enclosure.points import ExactPoint, to_acb
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.start import middle
from kovacic.enclosure.way import NOTHING, Traveller

_LEAST = 4
"""Periods from which on they are taken in one step."""
_LOST = 64
"""Precisions rise by multiples of so many bits."""
_WAVES = (sympy.sin, sympy.cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc, sympy.exp)
Affine = tuple[Matrix, State]  # v -> M v + p


@dataclass(frozen=True, eq=False)
class PeriodicWay(AnalyticWay):
    """An equation all of whose coefficients have the `period`, an expression."""

    period: Any = None

    def _length(self) -> arb:
        return abs(in_balls(self.period, self.functions.coefficients.at(sympy.Integer(0))))

    def _periods(self, a: ExactPoint, b: ExactPoint) -> int:
        """The whole periods from a to b, about, negative to the left; 0 beside the real axis."""
        if not (a.is_real() and b.is_real()):
            return 0
        with working_precision(64 + (b - a).height_bits()):
            return int((arb((b - a).x) / self._length()).mid().floor().unique_fmpz())

    def carried(
        self, a: ExactPoint, b: ExactPoint, product: MatrixProduct, particular: State
    ) -> tuple[MatrixProduct, State]:
        n = self._periods(a, b)
        if abs(n) < _LEAST:
            return super().carried(a, b, product, particular)
        # Where P isn't diagonal, P^m is of the size m, and its square loses log2(m) bits and some more; n T loses those of n.
        squares = n.bit_length()
        lost = -(-squares * (squares + 12) // (2 * _LOST)) * _LOST
        with working_precision(ctx.prec + lost):
            way = replace(self, prec=self.prec + lost)
            step = self._length() * (1 if n > 0 else -1)
            key = a, n > 0, lost
            if key not in self._maps:
                self._maps[key] = way._map(a, Constant("a period later", lambda: to_acb(a) + step))
            power: Affine = (identity(), NOTHING)
            square = self._maps[key]
            for bit in reversed(bin(abs(n))[2:]):
                power = _after(square, power) if bit == "1" else power
                square = _after(square, square)
            rest = way._map(a, Constant("less than a period later", lambda: to_acb(b) - step * abs(n)))
            matrix, added = _after(rest, power)
        y, dy = apply(matrix, particular)
        return product.after(matrix), (y + added[0], dy + added[1])

    @cached_property
    def _maps(self) -> dict[Any, Affine]:
        return {}

    def _map(self, a: ExactPoint, number: Constant) -> Affine:
        """From the state at a to that at a number in a ball."""
        stop = middle(number)
        M, particular = identity(), NOTHING
        if stop != a:
            product, particular = super().carried(a, stop, MatrixProduct(), NOTHING)
            M = product.matrix()
        first, second, own = (self.spread(number, v) for v in ((M[0], M[2]), (M[1], M[3]), particular))
        return fundamental(first, second), own

    def fan(self, traveller: Traveller, stops: Sequence[ExactPoint]) -> dict[ExactPoint, State]:
        here = traveller.here
        assert isinstance(here, ExactPoint)
        periods = {stop: abs(self._periods(here, stop)) for stop in stops}
        if max(periods.values()) < _LEAST + len(stops):  # discs on the way serve all of them
            return super().fan(traveller, stops)
        return {stop: traveller.moved(stop).state for stop in stops}


def _after(second: Affine, first: Affine) -> Affine:
    """The first map, then the second one."""
    y, dy = apply(second[0], first[1])
    return multiply(second[0], first[0]), (y + second[1][0], dy + second[1][1])


def period_of(coefficients: Coefficients) -> Any:
    """A period of functions of waves of commensurable frequencies; None where none is seen."""
    x = coefficients.variable
    waves = {e for part in coefficients.parts for e in part.atoms(*_WAVES) if e.has(x)}
    waves = {e for e in waves if not e.args[0].diff(x).has(x)}
    known = {e: sympy.Dummy() for e in waves}
    if not waves or any(part.xreplace(known).has(x) for part in coefficients.parts):
        return None
    rates = [e.args[0].diff(x) / (sympy.I if e.func is sympy.exp else 1) for e in sorted(waves, key=str)]
    shares = [sympy.simplify(rate / rates[0]) for rate in rates]
    if not all(share.is_Rational for share in shares):
        return None
    under = lcm(*(int(share.q) for share in shares))
    period = 2 * sympy.pi * under / (rates[0] * gcd(*(int(share * under) for share in shares)))
    value = in_balls(period, coefficients.at(to_ball(ExactPoint(0))))
    return period if value.is_finite() and value.imag.is_zero() and not value.contains(0) else None

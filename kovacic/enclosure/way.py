"""Straight ways that are kept: a solution along a ray, disc after disc, as far as somebody has asked.

A value in a disc that was passed is that of a polynomial; farther ones continue the way from where it ends.  The second
question continues farther than to its own point, so that many questions in a row don't make a disc each.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Protocol

from flint import acb, acb_poly, arb, arb_poly

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.matrices import Matrix, MatrixProduct, State, apply
from kovacic.enclosure.points import ExactPoint, power_of_two, to_acb
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import watched_seconds

_TRIED = 32
_WORTH = 0.2
"""Discs and seconds after which the time of the others is known well enough to be foreseen."""
MAX_DISCS = 200_000
_MOST_DISCS = 4000
"""Discs that a way keeps: some kilobytes each at 15 digits."""


@dataclass(frozen=True)
class Local:
    """A solution in a disc, x = centre + 2^e u: `poly` in u, off by at most `error`, and its derivative by `slope_error`.

    |u| is at most `reach` there; values need so many bits of `precision`.
    """

    centre: ExactPoint
    e: int
    poly: Any
    slope: Any
    error: arb
    slope_error: arb
    reach: Any
    precision: int

    @classmethod
    def of(cls, centre: ExactPoint, e: int, poly: Any, errors: tuple[arb, arb], *, reach: Any, precision: int) -> Local:
        """With the derivative of the polynomial."""
        return cls(centre, e, poly, poly.derivative(), *errors, reach, precision)

    def state(self, x: ExactPoint) -> State:
        """(y, dy/dx); raises ArithmeticError outside of the disc."""
        u = (x - self.centre).scaled(power_of_two(-self.e))
        if u.norm_squared() > self.reach * self.reach:
            raise ArithmeticError("the target lies outside of its disc")
        with working_precision(self.precision):
            return self._state(u)

    def _state(self, u: ExactPoint) -> State:
        h = arb((1, self.e))
        if isinstance(self.poly, arb_poly) and u.is_real():
            at = arb(u.x)
            return acb(self.poly(at) + arb(0, self.error)), acb((self.slope(at) + arb(0, self.slope_error)) / h)
        z = to_acb(u)
        y = acb_poly(self.poly)(z)
        dy = acb_poly(self.slope)(z)
        return y + _square(self.error), (dy + _square(self.slope_error)) / h


def _square(radius: arb) -> acb:
    return acb(arb(0, radius), arb(0, radius))


class WayStep(Protocol):
    """A disc of a way."""

    @property
    def leave(self) -> ExactPoint:
        """Where the next one begins."""

    @property
    def matrix(self) -> Matrix:
        """From the state where the disc is entered to that where it is left, without a right-hand side."""

    @property
    def added(self) -> State:
        """What a right-hand side adds to that."""

    def local(self, state: State) -> Local:
        """The solution in the disc, from its state where the disc is entered."""


@dataclass
class Forecast:
    """How many discs the way from a to b has at least, and whether the limits allow them.

    `growth` gives int |S|^(1/2) or less on the way, `in_a_disc` is the most that one disc covers.
    """

    a: ExactPoint
    b: ExactPoint
    growth: Callable[[], float]
    in_a_disc: float
    begun: float = field(default_factory=lambda: watched_seconds(math.inf))
    is_known: bool = False

    def check(self, number: int) -> None:
        """After so many discs: raise LimitExceeded if the time doesn't suffice for the others, as soon as that is clear."""
        if number > MAX_DISCS:
            raise LimitExceeded(f"the path needs more than {MAX_DISCS} steps", limit="unknown_degree")
        used = self.begun - watched_seconds(math.inf)
        if not self.is_known and number >= _TRIED and not used < _WORTH:
            self.refuse(used / number)

    def refuse(self, each: float = 0.0) -> None:
        """Raise LimitExceeded if the limits don't allow all discs, of so many seconds each."""
        self.is_known = True
        growth = self.growth()
        least = growth / self.in_a_disc
        size = f"exp({growth:.2g})" if growth < math.inf else "more than exp(1e308)"
        way = f"on the way from {self.a} to {self.b}"
        reason = f"the solutions grow or oscillate by {size} {way}, which takes {least:.2g} steps"
        if least > MAX_DISCS:
            raise LimitExceeded(f"{reason} or more, above the limit of {MAX_DISCS}", limit="unknown_degree")
        if each * (least - _TRIED) > watched_seconds(math.inf):
            raise LimitExceeded(f"{reason} of {each:.2g} s each: more than the time limit allows", limit="seconds")


def position(here: ExactPoint, x: ExactPoint) -> Any:
    """How far x is from here, for points of one ray."""
    step = x - here
    return max(abs(step.x), abs(step.y))


def ray(here: ExactPoint, x: ExactPoint) -> ExactPoint:
    """The direction, the same for all points of one ray."""
    return (x - here).scaled(1 / position(here, x))


def by_rays(here: ExactPoint, stops: Sequence[ExactPoint]) -> dict[ExactPoint, list[ExactPoint]]:
    """The points but `here`, each once, by their directions, the nearest first."""
    found: dict[ExactPoint, list[ExactPoint]] = {}
    for stop in sorted({*stops} - {here}, key=lambda stop: position(here, stop)):
        found.setdefault(ray(here, stop), []).append(stop)
    return found


@dataclass
class Way:
    """From `here` along one ray: `walk(a, b)` makes the discs from a to b, junctions on the ray.

    The state at `here` is `product` times the start, plus `particular`.
    """

    here: ExactPoint
    walk: Callable[[ExactPoint, ExactPoint], Iterator[WayStep]]
    start: State
    product: MatrixProduct
    particular: State = (acb(0), acb(0))
    end: ExactPoint = field(init=False)
    begin: Any = 0
    _stops: list[Any] = field(default_factory=list)
    _locals: list[Local] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.end = self.here

    def has(self, x: ExactPoint) -> bool:
        """Is it not known that x lies before the part that is kept?"""
        return bool(position(self.here, x) >= self.begin)

    def contains(self, x: ExactPoint) -> bool:
        """Is the point on the part that is kept?"""
        return self.has(x) and bool(position(self.here, x) <= position(self.here, self.end))

    def states(self, stops: Sequence[ExactPoint]) -> list[State]:
        """(y, y') at points of the ray, the nearest first."""
        reached = position(self.here, self.end)
        known = [stop for stop in stops if position(self.here, stop) <= reached]
        found = [self._locals[bisect_left(self._stops, position(self.here, stop))].state(stop) for stop in known]
        waiting = deque(stops[len(known) :])
        if waiting and self._stops:
            far = self.here + (waiting[-1] - self.here).scaled(2)
            with suppress(InputError, LimitExceeded):
                self._go(far, waiting, found, spare=len(self._stops))
        if waiting:
            self._go(waiting[-1], waiting, found, spare=0)
        return found

    def _go(self, far: ExactPoint, waiting: deque[ExactPoint], found: list[State], *, spare: int) -> None:
        """Towards `far`, past all that wait, whose states are found, and then so many discs more: but for the first time a way
        goes on to twice the distance, for no more discs than there are, if nothing is in the way."""
        for step in self.walk(self.end, far):
            y, dy = self.particular
            state = self.product.apply(self.start)
            self._locals.append(step.local((state[0] + y, state[1] + dy)))
            self._stops.append(position(self.here, step.leave))
            y, dy = apply(step.matrix, self.particular)
            self.product = self.product.after(step.matrix)
            self.particular = y + step.added[0], dy + step.added[1]
            self.end = step.leave
            while waiting and position(self.here, waiting[0]) <= self._stops[-1]:
                found.append(self._locals[-1].state(waiting.popleft()))
            if not waiting:
                spare = min(spare - 1, _MOST_DISCS - len(self._stops))
            if spare < 0:
                return
            if len(self._stops) > _MOST_DISCS:
                self._forget()

    def _forget(self) -> None:
        """The first half of the discs."""
        half = _MOST_DISCS // 2
        self.begin = self._stops[half - 1]
        del self._stops[:half]
        del self._locals[:half]

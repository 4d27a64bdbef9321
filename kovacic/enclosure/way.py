"""Ways: how the solutions of an equation are carried along straight lines, disc after disc.

A `Way` is an equation at some precision.  Its coefficients may be rational (`kovacic.enclosure.rational`) or analytic
(`kovacic.enclosure.analytic`), or its solutions known in closed form; a right-hand side is part of the carried state.

A `Ray` keeps the discs of one straight line.  These depend on where the line begins and on its `horizon`, the power of two
beyond the target, and on nothing else: no value depends on earlier calls.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from typing import Any, TypeVar

from flint import acb, arb, arb_poly, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import foreseen_growth
from kovacic.enclosure.frobenius import limit
from kovacic.enclosure.matrices import (
    IDENTITY,
    NOTHING,
    Affine,
    MapProduct,
    Matrix,
    State,
    adjugate,
    apply,
    fundamental,
    multiply,
)
from kovacic.enclosure.points import (
    ExactPoint,
    Number,
    Points,
    are_real,
    around_zero,
    binary_exponent,
    power_of_two,
    root_below,
    to_acb,
)
from kovacic.enclosure.singular import Singular
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import check_duration, check_time, watched_seconds

#: Discs after which their time tells that of the others.
_DISCS_FOR_A_FORECAST = 16
#: Discs of one way: a minute or two at 15 digits.  A ray keeps 1/50 of them, of some kilobytes each.
MAX_DISCS = 200_000

States = dict[ExactPoint, State]  # what was found, by points
T = TypeVar("T")


@dataclass(frozen=True)
class Local:
    """A solution in a disc, x = centre + 2^e u: `poly` in u, off by at most `error`, and its derivative by `slope_error`.

    |u| is at most `reach` there; values need `precision` bits.
    """

    centre: ExactPoint
    e: int
    poly: Any
    error: arb
    slope_error: arb
    reach: Any
    precision: int

    @cached_property
    def slope(self) -> Any:
        """The derivative of the polynomial."""
        return self.poly.derivative()

    def state(self, x: ExactPoint) -> State:
        """(y, dy/dx); raises ArithmeticError outside of the disc."""
        u = (x - self.centre).scaled(power_of_two(-self.e))
        if u.norm_squared() > self.reach * self.reach:
            raise ArithmeticError("the target lies outside of its disc")
        with working_precision(self.precision):
            real = isinstance(self.poly, arb_poly) and u.is_real()
            z = arb(u.x) if real else to_acb(u)
            y = self.poly(z) + around_zero(self.error, real=real)
            dy = self.slope(z) + around_zero(self.slope_error, real=real)
            return y, dy / arb((1, self.e))  # dy/dx = (dy/du)/2^e


Followed = Callable[[ExactPoint], State]
"""A solution on a part of a way: (y, dy/dx) at a point; raises ArithmeticError elsewhere."""


@dataclass(frozen=True, eq=False)
class Step:
    """A part of a way: `affine()` maps the state where it begins to that where it ends, at `leave`, and `local` gives the
    solution with a state where it begins."""

    leave: ExactPoint
    affine: Callable[[], Affine]
    local: Callable[[State], Followed]


def check_terms(count: int, bits: int) -> None:
    """Raise `LimitExceeded` if a series to this number of bits has far more terms than the one or two a bit of most discs."""
    most = 40 * bits + 4000
    if count > most:
        raise LimitExceeded(f"a Taylor expansion needs more than {most} terms", limit="unknown_degree")


Columns = tuple[Local, Local]
"""The solutions with the states (1, 0) and (0, 1) at the centre of a disc."""


def transition(columns: Columns, x: ExactPoint) -> Matrix:
    """From the state at the centre to that at x."""
    first, second = columns
    return fundamental(first.state(x), second.state(x))


def disc_step(
    enter: ExactPoint,
    leave: ExactPoint,
    columns: Columns,
    own: Local | None = None,
    inverse: Callable[[Matrix], Matrix] = adjugate,
) -> Step:
    """The step through a disc by its solutions: `own` is one of the equation with its right-hand side, zero at the centre."""
    precision = columns[0].precision

    @cache
    def to_centre() -> Matrix:
        with working_precision(precision):  # FLINT rounds where it changes a sign
            return inverse(transition(columns, enter))

    def affine() -> Affine:
        matrix = multiply(transition(columns, leave), to_centre())
        if own is None:
            return matrix, NOTHING
        # With p = `own` the solution is p + M (v - p(enter)): without v, p - M p(enter).
        y, dy = apply(matrix, own.state(enter))
        p, dp = own.state(leave)
        return matrix, (p - y, dp - dy)

    def local(state: State) -> Followed:
        # v - p(enter) is carried by the solutions without a right-hand side, and p has the factor 1.
        p, dp = NOTHING if own is None else own.state(enter)
        total: Any = arb_poly([])
        errors = [arb(0), arb(0)]
        with working_precision(precision):
            factors = (*apply(to_centre(), (state[0] - p, state[1] - dp)), acb(1))
            for factor, part in zip(factors, (*columns, own), strict=True):
                if part is not None and not factor.is_zero():
                    # A real factor leaves a real polynomial real.
                    total = total + part.poly * (factor.real if factor.imag.is_zero() else factor)
                    size = abs(factor).upper()
                    errors = [errors[0] + size * part.error, errors[1] + size * part.slope_error]
            return replace(columns[0], poly=total, error=errors[0].upper(), slope_error=errors[1].upper()).state

    return Step(leave, affine, local)


def cover(
    a: ExactPoint, b: ExactPoint, e: int, fits: Callable[[ExactPoint, int, ExactPoint], T | None]
) -> Iterator[tuple[ExactPoint, T, ExactPoint]]:
    """Discs that cover the straight way from a to b, the first one of radius 2^e at most: where each is entered, what `fits`
    gives for it, and where it is left.

    Both points lie on the way and in the disc, and so does the way between them.  `fits(centre, e, enter)` is None for a disc
    that is too large.
    """
    is_real = a.is_real() and b.is_real()
    sign = 1 if b.x > a.x else -1
    enter = a
    while enter != b:
        rest = b - enter
        square = rest.norm_squared()
        # Centres are rounded to short numbers: discs of this radius contain the rest of the way, with room to spare.
        wide = (binary_exponent(square) + 1) // 2
        wide -= int(square < power_of_two(2 * wide - 2) * fmpq(7, 2))
        e = min(e, wide)
        while True:
            check_time()
            if e == wide:
                centre, leave = (enter + rest.scaled(fmpq(1, 2))).rounded(e - 4), b
            elif is_real:
                unit, grain = sign * power_of_two(e), power_of_two(e - 4)
                centre = ExactPoint(sign * ((sign * (enter.x + unit) / grain).floor() * grain))
                leave = ExactPoint(centre.x + unit)
            else:
                ahead = rest.scaled(root_below(power_of_two(2 * e) / square, 6) * fmpq(15, 16))
                centre, leave = (enter + ahead).rounded(e - 4), enter + ahead + ahead
            found = fits(centre, e, enter)
            if found is not None:
                break
            e -= 1
        yield enter, found, leave
        enter, e = leave, e + 2


@dataclass
class Forecast:
    """An estimate of how many discs the way from a to b has, and whether the limits allow them.

    `rate` is about |S|^(1/2): the estimate of its integral is rather too small, and a disc covers at most `in_a_disc` of it.
    Where functions are larger beside the way, `crowd` gives the discs for a unit of length; it takes some time.
    """

    a: ExactPoint
    b: ExactPoint
    rate: Callable[[acb], Any]  # an arb or a double
    in_a_disc: float
    crowd: Callable[[acb], float] | None = None
    begun: float = field(default_factory=lambda: watched_seconds(math.inf))
    is_known: bool = False

    def check(self, number: int) -> None:
        """Raise `LimitExceeded` if, after this number of discs, the remaining time clearly can't suffice for the others."""
        if number > MAX_DISCS:
            raise LimitExceeded(f"the path needs more than {MAX_DISCS} steps", limit="unknown_degree")
        used = self.begun - watched_seconds(math.inf)  # both are seconds that were left
        # Less than 0.2 s says little of the time of a disc; without a time limit `used` is NaN, which is no less.
        if not self.is_known and number >= _DISCS_FOR_A_FORECAST and not used < 0.2:
            self.is_known = True
            self.refuse(used / number)

    def refuse(self, each: float = 0.0) -> None:
        """Raise `LimitExceeded` if the limits don't allow all discs, at `each` seconds a disc."""
        growth = foreseen_growth(self.rate, self.a, self.b)
        least = growth / self.in_a_disc
        size = f"exp({growth:.2g})" if growth < math.inf else "more than exp(1e308)"
        way = f"the way from {self.a} to {self.b}"
        if least > MAX_DISCS:
            reason = f"the solutions grow or oscillate by {size} on {way}, which takes {least:.2g} steps or more"
            raise LimitExceeded(f"{reason}, above the limit of {MAX_DISCS}", limit="unknown_degree")
        if each and self.crowd is not None:
            least = max(least, foreseen_growth(self.crowd, self.a, self.b))
        # Some of the discs are behind.
        check_duration(each * (least - _DISCS_FOR_A_FORECAST), way)


@dataclass(frozen=True, eq=False, kw_only=True)
class Way(ABC):
    """An equation at a precision of about `prec` bits, whose solutions are carried along straight lines.

    The carried state may differ from the user's (y, y'): `into` and `out_of` convert between them.
    """

    prec: int = 64

    @property
    def is_exact(self) -> bool:
        """True if a higher precision makes every ball smaller."""
        return True

    @abstractmethod
    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        """Raise InputError if the coefficients are known beforehand not to be analytic on the straight line."""

    @abstractmethod
    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        """An estimate of the discs from a to b; raises LimitExceeded if they are clearly too many."""

    @abstractmethod
    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[Step]:
        """The discs from a towards b; `alone` if only the state at the end is needed."""

    @abstractmethod
    def around(self, ball: acb) -> tuple[acb, acb, acb, bool]:
        """b, c and f of y'' + b y' + c y = f on a ball, and True if they are proven to be real there."""

    def spread(self, number: Number, state: State) -> State:
        """The state at a number in a ball from that at its midpoint."""
        if isinstance(number, ExactPoint):
            return state
        ball = number.value()
        *values, real = self.around(ball)
        return spread(values, abs(ball - to_acb(number.point())), state, real=real and are_real([ball, *state]))

    def into(self, x: ExactPoint) -> Matrix:
        """From the user's (y, y') at x to the carried state."""
        return IDENTITY

    def out_of(self, a: ExactPoint, x: ExactPoint) -> Matrix:
        """Back to the user's (y, y') at x, at the end of the straight line from a."""
        return IDENTITY

    def horizon(self, here: ExactPoint, stop: ExactPoint) -> ExactPoint:
        """The end of the ray that serves this target and nearer ones: at the next power of two."""
        distance = position(here, stop)
        # The least power of two that isn't smaller than the distance: it is 2^e or 2^(e + 1).
        e = binary_exponent(distance)
        far = power_of_two(e if power_of_two(e) >= distance else e + 1)
        return here + (stop - here).scaled(far / distance)

    def carried(self, a: ExactPoint, b: ExactPoint, maps: MapProduct) -> MapProduct:
        """The maps to the user's state at b from those to the one at a."""
        self.check(a, b)
        ahead = self.forecast(a, b)
        maps = maps.after(self.into(a))
        for number, step in enumerate(self.walk(a, b, alone=True), 1):
            maps = maps.after(*step.affine())
            ahead.check(number)
        return maps.after(self.out_of(a, b))

    def fan(self, traveller: Traveller, stops: Points) -> States:
        """The states at the ends of straight lines from where the traveller is, which is none of them."""
        return traveller.along_rays(stops)

    def departure(self, point: Singular, stop: ExactPoint, needed: tuple[bool, bool]) -> tuple[ExactPoint, Matrix]:
        """Where the neighbourhood of a singular point is left, and the user's (y, y') there from coordinates at the point.

        Columns of Frobenius solutions that aren't `needed` may be zero.
        """
        raise InputError(f"{point} is a singular point: values start at a regular one")

    def decay_rate(self, x: ExactPoint) -> acb:
        """y'/y at x of the solution that decays for large x."""
        raise InputError("the decaying solution needs rational coefficients", hint="give y0 and dy0")


def spread(values: Sequence[acb], length: arb, state: State, *, real: bool) -> State:
    """The state anywhere on a piece of this length from that at a point of it; `values` are b, c and f of
    y'' + b y' + c y = f on the piece.

    For 1/s >= |b| + s |c|, (y, s y') changes by at most (exp(r/s) - 1) (max(|y|, s |y'|) + s^2 |f|) [equation (1) of
    `kovacic.enclosure.analytic`].
    """
    b, c, f = values
    tiny = arb((1, -64))
    steepness = (abs(b) + abs(c).upper().sqrt()).upper()  # then s b and s^2 c are 1 at most
    # Nor is s f above about |y'|, |y|/s and f times the length.
    slope = (abs(f) * abs(state[0])).upper().sqrt().max(abs(state[1])).max(abs(f) * length).upper()
    s = (1 / steepness.max(abs(f) / (slope + tiny)).max(tiny)).lower()
    largest = abs(state[0]).max(s * abs(state[1])) + s**2 * abs(f)
    change = (length / s).expm1() * largest
    return state[0] + around_zero(change.upper(), real=real), state[1] + around_zero((change / s).upper(), real=real)


def position(here: ExactPoint, x: ExactPoint) -> Any:
    """How far x is from here, for points of one ray."""
    step = x - here
    return max(abs(step.x), abs(step.y))


@dataclass
class Ray:
    """The discs from `here` towards `far`, as far as they were needed; `maps` lead from the start to the user's state here."""

    way: Way
    here: ExactPoint
    far: ExactPoint
    start: State
    maps: MapProduct

    def __post_init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        self._end = self.here
        self._nearest: Any = 0  # discs that are left before this distance were forgotten
        # Of disc k: how far from here it is left, the disc with the maps to where it is entered, and the solution in it if it
        # was needed.
        self._leave: list[Any] = []
        self._passed: list[tuple[Step, MapProduct]] = []
        self._locals: dict[int, Followed] = {}
        self._steps = self.way.walk(self.here, self.far)

    def state(self, stop: ExactPoint) -> State:
        """(y, y') at a point of the ray."""
        place = position(self.here, stop)
        if place < self._nearest:
            self._begin()
        if not self._leave or place > self._leave[-1]:
            try:
                self._advance(stop, place)
            except BaseException:  # the discs can't be continued after an interruption
                self._begin()
                raise
        # The first disc that is left at this place or behind it.
        k = bisect_left(self._leave, place)
        if k not in self._locals:
            step, maps = self._passed[k]
            self._locals[k] = step.local(maps.apply(self.start))
        return apply(self.way.out_of(self.here, stop), self._locals[k](stop))

    def _advance(self, stop: ExactPoint, place: Any) -> None:
        """To the disc that contains the stop."""
        self.way.check(self.here, stop)
        ahead = self.way.forecast(self._end, stop)
        number = 0
        while not self._leave or self._leave[-1] < place:
            if number:
                ahead.check(number)
            number += 1
            step = next(self._steps)
            if self._passed:
                last, maps = self._passed[-1]
                maps = maps.after(*last.affine())
            else:
                maps = self.maps.after(self.way.into(self.here))
            self._passed.append((step, maps))
            self._leave.append(position(self.here, step.leave))
            self._end = step.leave
            if len(self._passed) > MAX_DISCS // 50:  # all but the last one are forgotten
                self._nearest = self._leave[-2]
                self._locals.clear()
                del self._leave[:-1], self._passed[:-1]


@dataclass(frozen=True, eq=False)
class Traveller:
    """A place, the `maps` from the start to the user's (y, y') there, rays from here, and travellers who went `onward`.

    The start is a state, or coordinates in the Frobenius basis at a singular point.
    """

    way: Way
    here: ExactPoint | Singular
    start: State
    maps: MapProduct = field(default_factory=MapProduct)
    rays: dict[ExactPoint, Ray] = field(default_factory=dict)
    onward: dict[ExactPoint, Traveller] = field(default_factory=dict)

    @property
    def state(self) -> State:
        """The user's (y, y') here."""
        return self.maps.apply(self.start)

    @property
    def point(self) -> ExactPoint:
        """The place, which is a regular point."""
        assert isinstance(self.here, ExactPoint)
        return self.here

    def moved(self, stop: ExactPoint) -> Traveller:
        """Straight on to a point."""
        if isinstance(self.here, Singular):
            if self.here.is_at(stop):
                said = f"the path doesn't leave the singular point {self.here}"
                raise InputError(said, hint="go on to another point")
            first, second = (not coordinate.is_zero() for coordinate in self.start)
            # Coordinates at the point become a state beside it; from there on the way is regular.
            last, matrix = self.way.departure(self.here, stop, (first, second))
            return replace(self, here=last, maps=self.maps.after(matrix), rays={}, onward={}).moved(stop)
        if stop == self.here:
            return self
        return replace(self, here=stop, maps=self.way.carried(self.here, stop, self.maps), rays={}, onward={})

    def turned(self, corner: ExactPoint) -> Traveller:
        """As `moved`, to a corner that later targets are reached by as well: the traveller is kept there."""
        if corner not in self.onward:
            self.onward[corner] = self.moved(corner)
        return self.onward[corner]

    def fan(self, stops: Points) -> States:
        """The states at the ends of straight lines from here."""
        at_rest = {stop for stop in stops if self.is_at(stop)}
        others = [stop for stop in stops if stop not in at_rest]
        # A line needs a direction.
        found = self.way.fan(self, others) if others else {}
        return found | {stop: self.resting() for stop in at_rest}

    def is_at(self, stop: ExactPoint) -> bool:
        """True if the point is provably this one."""
        return self.here.is_at(stop) if isinstance(self.here, Singular) else self.here == stop

    def resting(self) -> State:
        """The state here, at a singular point the limits of y and y'."""
        return limit(self.here, self.start) if isinstance(self.here, Singular) else self.state

    def to_each(self, stops: Points) -> States:
        """Straight on to one after the other, from here."""
        return {stop: self.moved(stop).state for stop in stops}

    def along_rays(self, stops: Points) -> States:
        """In discs that are kept for the next call."""
        here = self.point
        rays: dict[ExactPoint, list[ExactPoint]] = {}  # the points in one direction together, the nearest first
        for stop in sorted({*stops}, key=lambda stop: position(here, stop)):
            # The same point for all stops in one direction.
            rays.setdefault((stop - here).scaled(1 / position(here, stop)), []).append(stop)
        found: States = {}
        for on_it in rays.values():
            far = self.way.horizon(here, on_it[-1])
            if far not in self.rays:
                self.rays[far] = Ray(self.way, here, far, self.start, self.maps)
            found |= {stop: self.rays[far].state(stop) for stop in on_it}
        return found

"""Values of solutions of y'' + b y' + c y = f whose coefficients are analytic functions of x, along straight ways.

The guarantee is that of `kovacic.enclosure.journey`: the exact continuation along the path lies in the balls, or an exception
says why not.

A way is covered by discs around points of it (`kovacic.enclosure.jets`).  In each of them balls that contain twice the disc
show that the coefficients are analytic: a pole or a branch point on the way is never passed, since no disc contains it.  Discs
become smaller towards one; where they would be as small as 2^-60 of what lies on either side, the way is refused.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, partial
from typing import Any

from flint import acb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.arguments import check_method, comparable, comparables, looked_up
from kovacic.enclosure.constants import Number, as_number, to_ball
from kovacic.enclosure.functions import coefficients_of_any
from kovacic.enclosure.jets import CoefficientField, JetBasis
from kovacic.enclosure.matrices import Matrix, MatrixProduct, State, apply, multiply
from kovacic.enclosure.points import ExactPoint, are_real, power_of_two, to_acb
from kovacic.enclosure.precision import Method, PointValue, number_of_digits, raise_precision
from kovacic.enclosure.problem import Coefficients
from kovacic.enclosure.start import middle, spread_by
from kovacic.enclosure.through import Through
from kovacic.enclosure.way import Forecast, Local, Way, by_rays
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Budget, Limits, check_time, count_work, limits_of

_STEEPEST = 40.0
_SHARE = 0.15
"""The growth exp(lambda) in one disc: lambda is at most so large, or that share of the bits."""
_LEAST = 60
_SAMPLES = 32
"""Points at which the coefficients are looked at for a forecast."""
_ROUGH = 64
_KEPT = 4
"""Precisions at which ways are kept."""
_START = 512
"""Binary exponents that are tried from the length of the way downwards, at its first point."""


@dataclass(frozen=True)
class AnalyticStep:
    """One disc of a way, entered and left at these points."""

    basis: JetBasis
    enter: ExactPoint
    leave: ExactPoint

    @cached_property
    def _to_centre(self) -> Matrix:
        return self.basis.inverse(self.enter)

    @cached_property
    def matrix(self) -> Matrix:
        """From (y, y') where it is entered to where it is left, without the right-hand side."""
        return multiply(self.basis.matrix(self.leave), self._to_centre)

    @cached_property
    def added(self) -> State:
        """What the right-hand side adds: the particular solution that is zero where the disc is entered."""
        y, dy = apply(self.matrix, self.basis.particular(self.enter))
        p, dp = self.basis.particular(self.leave)
        return p - y, dp - dy

    def local(self, state: State) -> Local:
        """The solution in the disc with this state where it is entered."""
        p, dp = self.basis.particular(self.enter)
        return self.basis.local(apply(self._to_centre, (state[0] - p, state[1] - dp)))


def walk(functions: CoefficientField, a: ExactPoint, b: ExactPoint, prec: int) -> Iterator[AnalyticStep]:
    """The discs of the straight way from a to b, which aren't the same."""
    _check_regular(functions, b, "end", prec)
    length = b - a
    square = length.norm_squared()
    t = fmpq(0)
    steepest = max(_STEEPEST, _SHARE * prec)
    forecast = Forecast(a, b, lambda: _growth(functions, a, b), 2 * steepest)
    forecast.refuse()
    e = _exponent(square)
    number = 0
    while t < 1:
        check_time()
        count_work(prec)
        rest = 1 - t
        e = min(e + 1, _exponent(square * rest * rest))
        while True:
            half = min(_share(square, e), rest / 2)
            centre = a + length.scaled(t + half)
            jets = functions.jets(centre, e, prec, steepest)
            if jets is not None:
                break
            e -= 1
            _check_size(a, b, t, e, number == 0)
        enter = a + length.scaled(t)
        t += 2 * half
        leave = b if t == 1 else a + length.scaled(t)
        yield AnalyticStep(JetBasis(jets), enter, leave)
        number += 1
        forecast.check(number)


def _growth(functions: CoefficientField, a: ExactPoint, b: ExactPoint) -> float:
    """The integral of max(|b|, |c|^(1/2)) along the way, about: no bound."""
    with working_precision(_ROUGH):
        sizes = []
        for k in range(_SAMPLES):
            b_value, c_value, _ = functions.values(to_acb(a + (b - a).scaled(fmpq(2 * k + 1, 2 * _SAMPLES))))
            sizes.append(float(abs(b_value).max(abs(c_value).sqrt()).mid()))
        length = float(abs(to_acb(b - a)).mid())
    return length * sum(size for size in sizes if size < math.inf) / _SAMPLES


def _check_regular(functions: CoefficientField, point: ExactPoint, name: str, prec: int) -> None:
    with working_precision(prec):
        if not functions.is_regular(to_acb(point)):
            raise InputError(f"the coefficients aren't known to be analytic at the {name} {point} of the path")


def _share(square: Any, e: int) -> Any:
    """A dyadic number just below 2^e over the length whose square this is."""
    ratio = power_of_two(2 * e) / square
    k = (ratio.p.bit_length() - ratio.q.bit_length()) // 2
    root = (ratio * power_of_two(24 - 2 * k)).floor().isqrt()
    return fmpq(root) * power_of_two(k - 12)


def _exponent(square: Any) -> int:
    """An integer e with 2^(e+1) at least the length whose square this is."""
    return int(square.p.bit_length() - square.q.bit_length() + 1) // 2


def _check_size(a: ExactPoint, b: ExactPoint, t: Any, e: int, first: bool) -> None:
    """Raise InputError where steps are too small for what lies behind and ahead: a singular point is there."""
    square = (b - a).norm_squared()
    behind = square * t * t
    ahead = square * (1 - t) ** 2
    if first:
        behind = square * power_of_two(-2 * _START)
    if power_of_two(2 * (e + _LEAST)) < min(behind, ahead):
        where = to_acb(a + (b - a).scaled(t)).mid()
        with working_precision(64):
            shown = where.real.str(10, radius=False)
            if not where.imag.is_zero():
                shown = where.str(10, radius=False)
        raise InputError(
            f"the coefficients aren't known to be analytic near {shown}, on the way to {b}",
            hint="go around it through the complex plane, e.g. path=[...] with a vertex off the axis; "
            "the result depends on the side",
        )


@dataclass(frozen=True, eq=False)
class AnalyticJourney:
    """From x0 along the polygon `vertices`, then straight to each target, or (`chain`) from target to target."""

    coefficients: Coefficients
    x0: Number
    data: tuple[Number, Number]
    vertices: tuple[Number, ...] = ()
    chain: bool = False

    @cached_property
    def functions(self) -> CoefficientField:
        """The coefficients as functions."""
        return CoefficientField(self.coefficients)

    @cached_property
    def through(self) -> Through | None:
        """The same solution in another variable; None along a polygon, and where there is no such variable."""
        if self.vertices:
            return None
        return Through.of(self.coefficients, self.x0, self.data, chain=self.chain)

    @cached_property
    def _begun(self) -> dict[int, _Begun]:
        return {}

    def is_exact(self, targets: Sequence[Number]) -> bool:
        """True if a higher precision makes every ball smaller."""
        numbers = (self.x0, *self.data, *self.vertices, *targets)
        return self.coefficients.is_exact and not any(getattr(number, "fixed", False) for number in numbers)

    def states(self, targets: Sequence[Number], closed: object, prec: int) -> list[State]:
        """The states at the targets, at about so many bits."""
        if prec not in self._begun:
            if len(self._begun) >= _KEPT:
                self._begun.clear()
            self._begun[prec] = self._begin(prec)
        begun = self._begun[prec]
        stops = [middle(target) for target in targets]
        found: dict[ExactPoint, State] = {}
        if self.chain:
            for stop in stops:
                begun = begun.moved(stop)
                found |= begun.states([stop])
        else:
            found = begun.states(stops)
        return [self._spread(target, found[stop]) for target, stop in zip(targets, stops, strict=True)]

    def _begin(self, prec: int) -> _Begun:
        """At the end of the polygon."""
        y, dy = map(to_ball, self.data)
        start = self._spread(self.x0, (y, dy))
        _check_regular(self.functions, middle(self.x0), "start", prec)
        found = _Begun(middle(self.x0), partial(walk, self.functions, prec=prec), start, MatrixProduct())
        for vertex in self.vertices:
            found = found.moved(middle(vertex))
        return found

    def _spread(self, number: Number, state: State) -> State:
        def coefficients(ball: acb) -> tuple[acb, acb, acb, bool]:
            b, c, f = self.functions.values(ball, analytic=True)
            return b, c, f, are_real(self.functions.values(ball))

        return spread_by(coefficients, number, state)


@dataclass(frozen=True, eq=False)
class _Begun:
    """A point that was reached, and the straight ways from there that are known, by their directions."""

    here: ExactPoint
    walk: Callable[[ExactPoint, ExactPoint], Iterator[AnalyticStep]]
    start: State
    product: MatrixProduct
    particular: State = (acb(0), acb(0))
    ways: dict[ExactPoint, Way] = field(default_factory=dict)

    def states(self, stops: Sequence[ExactPoint]) -> dict[ExactPoint, State]:
        """(y, y') at the ends of straight ways to these points."""
        y, dy = self.product.apply(self.start)
        found = {self.here: (y + self.particular[0], dy + self.particular[1])}
        for direction, on_it in by_rays(self.here, stops).items():
            way = self.ways.get(direction)
            if way is None or not way.has(on_it[0]):
                way = self.ways[direction] = self._way()
            found |= zip(on_it, way.states(on_it), strict=True)
        return found

    def moved(self, stop: ExactPoint) -> _Begun:
        """To the end of a straight way."""
        if stop == self.here:
            return self
        way = self._way()
        way.states([stop])
        return _Begun(stop, self.walk, self.start, way.product, way.particular)

    def _way(self) -> Way:
        return Way(self.here, self.walk, self.start, self.product, self.particular)


@dataclass(frozen=True)
class AnalyticQuestion:
    """One solution, of which values are asked for: the journey keeps what was computed for them."""

    journey: AnalyticJourney
    digits: int
    limits: Limits
    method: Method | None = None

    def states(self, points: Sequence[object]) -> tuple[PointValue, ...]:
        """y and y' with the circumstances, for each of `points` (no warnings: see `PointValue.note`)."""
        targets = tuple(as_number(p, "x") for p in points)
        through = self.journey.through
        with Budget(self.limits).watched():
            if through is not None:
                with suppress(InputError, LimitExceeded):  # whose reasons would speak of t
                    found = through.states(targets, self.digits, self.method, self.limits)
                    if found is not None:
                        return found
            return raise_precision(self.journey, targets, None, self.digits, self.limits)


def analytic_question(
    equation: object,
    *,
    x0: object,
    y0: object = None,
    dy0: object = None,
    params: Mapping[str, object] | None = None,
    digits: int = 15,
    path: object = None,
    limits: Limits | None = None,
    method: Method | None = None,
    which: object = None,
    frobenius: object = None,
) -> AnalyticQuestion:
    """As `kovacic.enclosure.states.question_of`, for an equation whose coefficients aren't rational."""
    limits = limits_of(limits)
    digits = number_of_digits(digits, limits)
    _check_start(y0, dy0, method, which, frobenius)
    coefficients = coefficients_of_any(equation, params, limits)
    start = [comparable(value) for value in (x0, y0, dy0)]
    journey: AnalyticJourney = looked_up(_journey_of, coefficients, *start, comparables(path, "path"))
    return AnalyticQuestion(journey, digits, limits, method)


def _check_start(y0: object, dy0: object, method: str | None, which: object, frobenius: object) -> None:
    """Raise InputError for what needs rational coefficients."""
    check_method(method)
    if method == "closed form":
        raise InputError("the method 'closed form' is for rational coefficients", hint="leave the method out")
    name = "which" if which is not None else "frobenius"
    if which is not None or frobenius is not None:
        said = f"{name} isn't for equations whose coefficients are functions of x"
        raise InputError(said, hint="give y0 and dy0 at a regular point")
    if y0 is None or dy0 is None:
        raise InputError("both y0 and dy0 are needed where coefficients are functions of x")


@lru_cache(maxsize=32, typed=True)
def _journey_of(coefficients: Coefficients, x0: object, y0: object, dy0: object, path: Any) -> AnalyticJourney:
    """What doesn't depend on the targets; kept, with the ways that are known."""
    if path in ("above", "below"):
        hint = "path=[v1, v2, ...] goes through these vertices"
        raise InputError(f"path={path!r} isn't for equations whose coefficients are functions of x", hint=hint)
    if isinstance(path, str) and path != "chain":
        raise InputError(f"unknown path {path!r}", hint='a sequence of vertices, "chain", or None')
    polygon = () if path is None or path == "chain" else path
    vertices = tuple(as_number(vertex, "a vertex of the path") for vertex in polygon)
    data = as_number(y0, "y0"), as_number(dy0, "dy0")
    return AnalyticJourney(coefficients, as_number(x0, "x0"), data, vertices, path == "chain")

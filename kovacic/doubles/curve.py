"""A solution as a curve for a picture: proven values as dense as it oscillates, or its envelope where that can't be drawn.

In the normal form u'' = S u, y = u exp(-int beta), beta = b/(2a), a solution oscillates with the local frequency
q = sqrt(-S) where S < 0.  There are 12 samples of y and y' for each period 2 pi/q, so that nothing is seen that isn't there,
and at least the requested number.  Between samples runs the cubic with their values and slopes; it is compared with one more
value in the middle of each interval, and the interval is halved until they agree.

Where a period would be drawn on less than 1/125 of the picture's width, only the envelope is given:
    A = sqrt(u^2 + u'^2/q^2) exp(-int beta) = sqrt(y^2 + (y' + beta y)^2/q^2),
which is the amplitude up to a relative error of about S'/(4 q^3), small where S changes little within a period.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kovacic.doubles.chart import PieceChart
from kovacic.enclosure.ball import finite_ball
from kovacic.enclosure.points import ExactPoint, Points, to_double
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
SolutionStates = Callable[[Points], Sequence[Any]]  # y and y' in balls at points

_EXACT_TERMS = 24
#: Samples of a curve: each costs some 50 microseconds and 100 bytes.
_MOST_SAMPLES = 400_000


class Arc(NamedTuple):
    """A part of the curve between singular points: samples with y, y' and the proven error bounds of y."""

    x: Floats
    y: Complexes
    dy: Complexes
    radius: Floats

    def times(self, factor: float) -> Arc:
        """That of a positive multiple of the solution."""
        return Arc(self.x, factor * self.y, factor * self.dy, factor * self.radius)

    def drawn(self) -> tuple[Floats, Complexes]:
        """Points so dense that straight lines between them are as good as the cubics."""
        h = np.diff(self.x)[:, None]
        t = np.arange(6) / 6
        # The basis of the cubics on [0, 1]: values and slopes at both ends.
        value = (1 + 2 * t) * (1 - t) ** 2
        slope = t * (1 - t) ** 2
        last_slope = -(t**2) * (1 - t)
        inner = value * self.y[:-1, None] + (1 - value) * self.y[1:, None]
        inner = inner + h * (slope * self.dy[:-1, None] + last_slope * self.dy[1:, None])
        x = self.x[:-1, None] + h * t
        return np.append(x.ravel(), self.x[-1]), np.append(inner.ravel(), self.y[-1])


class Envelope(NamedTuple):
    """A part whose oscillation is too fine to be drawn: |Re y| <= Re size and |Im y| <= Im size, nearly reached."""

    x: Floats
    size: Complexes
    periods: float

    def times(self, factor: float) -> Envelope:
        """That of a positive multiple of the solution."""
        return self._replace(size=factor * self.size)


class CurveCoefficients(NamedTuple):
    """beta = b/(2a) and S at points x."""

    x: Floats
    beta: Floats
    S: Floats

    @property
    def frequency(self) -> Floats:
        return np.sqrt(np.maximum(-self.S, 0.0))


def curve_coefficients(chart: PieceChart, points: Points) -> CurveCoefficients:
    """By y'' + b y' + c y = f/a at each point, divided by a: S = b'/2 + b^2/4 - c."""
    rows = []
    for point in points:
        check_time()
        # Polynomials of at most this many terms, of which two are used, are expanded exactly, which is faster.
        a, b, c, *_ = ([float(v.mid()) for v in part] + [0.0, 0.0] for part in chart.local(point, 0, _EXACT_TERMS))
        # (b/a)' = b' - b a' at the point, where a = 1.
        rows.append((float(point.re), b[0] / 2, (b[1] - b[0] * a[1]) / 2 + b[0] ** 2 / 4 - c[0]))
    return CurveCoefficients(*np.array(rows).T)


def arcs(
    chart: PieceChart, interval: tuple[Fraction, Fraction], width: Fraction, points: int, states: SolutionStates
) -> list[Arc | Envelope]:
    """The curve over an interval without singular points, of a picture of this width with this many samples or more.

    `states` gives y and y' in balls.  Raises `LimitExceeded` where more than 400,000 samples would be needed.
    """
    # S is computed at equidistant points, and at nearer and nearer ones beside singular points.
    low, high = interval
    count = max(8, round(800 * (high - low) / width))
    equidistant = {low + (high - low) * Fraction(k, count) for k in range(count + 1)}
    beside = map(Fraction, _beside_singular_points(chart, float(low), float(high)))
    here = curve_coefficients(chart, [ExactPoint(x) for x in sorted(equidistant.union(beside))])
    if not np.isfinite(here.S).all():  # there the states raise the reason, or nothing oscillates
        states([ExactPoint(Fraction(float(at))) for at in here.x[~np.isfinite(here.S)]])
        here = here._replace(S=np.nan_to_num(here.S))
    # The envelope is that of a solution of the homogeneous equation.
    too_fine = (here.frequency * float(width) / 125 > 2 * np.pi) & (not chart.is_forced)
    for first, last in _stretches(too_fine):
        # A few periods are drawn, however short they are.
        if _periods(here.x[first : last + 1], here.frequency[first : last + 1]) < 10:
            too_fine[first : last + 1] = False
    found: list[Arc | Envelope] = []
    for first, last in _stretches(too_fine):
        part = CurveCoefficients(*(values[first : last + 1] for values in here))
        found.append(_envelope(chart, part, width, states) if too_fine[first] else _arc(part, width, points, states))
    return found


def _beside_singular_points(chart: PieceChart, low: float, high: float) -> list[float]:
    """Points between low and high, nearer and nearer to the singular points on the axis, at its ends or beside it.

    Solutions and S are powers of the distance there: on steps that grow by a half they are nearly straight.
    """
    found = []
    for z in map(to_double, chart.singular):
        inside = min(max(z.real, low), high)
        distance = abs(z - inside)
        while 0 < distance < high - low:
            found += [x for x in (z.real - distance, z.real, z.real + distance) if low < x < high]
            distance *= 1.5
    return found


def _stretches(kind: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last index of each stretch of points of one kind; the next stretch begins at the last one."""
    ends = [0, *(int(k) + 1 for k in np.flatnonzero(kind[1:] != kind[:-1])), len(kind) - 1]
    return [(first, last) for first, last in pairwise(ends) if first < last]


def _arc(part: CurveCoefficients, width: Fraction, points: int, states: SolutionStates) -> Arc:
    """Samples by the local frequency, and in the middle of intervals on which the cubic isn't good enough."""
    # The requested number on the whole width, and 12 in each period.
    density = np.maximum(points / float(width), 12 * part.frequency / (2 * np.pi))
    steps = np.maximum(density[1:], density[:-1]) * np.diff(part.x)
    # How many samples there are up to each point; they are equidistant in that.
    reached = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(2, int(np.ceil(reached[-1])) + 1)
    if count > _MOST_SAMPLES:
        raise LimitExceeded(f"the curve needs more than {_MOST_SAMPLES} samples", limit="samples")
    x = np.interp(np.linspace(0.0, reached[-1], count), reached, part.x)
    arc = _with_samples(np.unique(x), states)
    doubtful = np.ones(len(arc.x) - 1, dtype=bool)
    # Near zeros the cubic may be off by a share of the usual size.
    usual = float(np.median(np.abs(arc.y)))
    while doubtful.any():
        arc, doubtful = _halved(arc, doubtful, usual, states)
    return arc


def _halved(
    arc: Arc, doubtful: NDArray[np.bool_], usual: float, states: SolutionStates
) -> tuple[Arc, NDArray[np.bool_]]:
    """One more sample in the middle of each doubtful interval; both halves stay doubtful where the cubic missed it."""
    middles = arc.x[:-1] + np.diff(arc.x) / 2
    # Neighbouring doubles have no double between them.
    left = np.flatnonzero(doubtful & (middles > arc.x[:-1]) & (middles < arc.x[1:]))
    right = left + 1
    h, middles = arc.x[right] - arc.x[left], middles[left]
    new = _with_samples(middles, states)
    # The cubic with these values and slopes, in the middle.
    cubic = (arc.y[left] + arc.y[right]) / 2 + h * (arc.dy[left] - arc.dy[right]) / 8
    allowed = 2e-3 * np.maximum(np.abs(new.y), usual) + new.radius
    missed = np.abs(cubic - new.y) > allowed
    merged = Arc(*(np.insert(known, right, one) for known, one in zip(arc, new, strict=True)))
    still = np.zeros(len(merged.x) - 1, dtype=bool)
    # The places of the new samples: each one that was inserted moves the next ones by one.
    places = (right + np.arange(len(right)))[missed]
    still[places - 1] = still[places] = True
    return merged, still


def _envelope(chart: PieceChart, part: CurveCoefficients, width: Fraction, states: SolutionStates) -> Envelope:
    """The amplitude at 300 points across the whole width, and beside singular points."""
    low, high = float(part.x[0]), float(part.x[-1])
    count = max(8, int(300 * (high - low) / float(width)))
    x = np.unique(np.append(np.linspace(low, high, count + 1), _beside_singular_points(chart, low, high)))
    here = curve_coefficients(chart, [ExactPoint(Fraction(float(at))) for at in x])
    samples = _with_samples(x, states)
    q = here.frequency
    # u' exp(-int beta) = y' + beta y.
    velocity = samples.dy + here.beta * samples.y
    # There is no envelope where nothing oscillates.
    turned = np.divide(velocity, q, out=np.full_like(velocity, np.nan), where=q != 0)
    size = np.hypot(samples.y.real, turned.real) + 1j * np.hypot(samples.y.imag, turned.imag)
    return Envelope(x, size, _periods(part.x, part.frequency))


def _periods(x: Floats, frequency: Floats) -> float:
    """The number of periods."""
    return float(np.trapezoid(frequency, x) / (2 * np.pi))


def _with_samples(x: Floats, states: SolutionStates) -> Arc:
    found = states([ExactPoint(Fraction(float(at))) for at in x])
    balls = [[finite_ball(value) for value in state] for state in found]
    try:
        y, dy = (np.array([complex(ball.mid) for ball in part]) for part in zip(*balls, strict=True))
        radius = np.array([float(value.radius) for value, _ in balls])
    except OverflowError:
        said = "the solution grows beyond the range of doubles, and can't be drawn: take a shorter interval"
        raise LimitExceeded(said, limit="digits") from None
    return Arc(x, y, dy, radius)

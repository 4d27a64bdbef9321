"""Pictures of solutions: real and imaginary part over an interval of the real axis, with the singular points marked.

What is drawn are midpoints of proven enclosures at every sample point; the error band is drawn where it's visible at all.
Between sample points the curve is a straight line, which proves nothing.  Beyond a singular point on the axis the solution
is the continuation through the upper half-plane.

matplotlib is needed (`pip install kovacic[plot]`) and imported here only, with a canvas of its own: no window is opened,
and neither the backend nor the state of pyplot is touched.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kovacic.enclosure.evaluate import evaluate_states
from kovacic.enclosure.points import Point, as_point, midpoint
from kovacic.enclosure.precision import Evaluation
from kovacic.enclosure.problem import as_problem
from kovacic.errors import InputError
from kovacic.limits import Limits

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MARGIN, _IRREGULAR_MARGIN = 256, 16
"""The curve ends this share of its interval before a singular point."""


@dataclass(frozen=True)
class Samples:
    """The solution at points of an interval, in runs that are separated by singular points (real parts as doubles)."""

    runs: tuple[tuple[Evaluation, ...], ...]
    singular: tuple[complex, ...]


def sample(
    equation: object,
    start: object,
    stop: object,
    *,
    x0: object | None = None,
    y0: object = 1,
    dy0: object = 0,
    which: str | None = None,
    frobenius: Sequence[object] | None = None,
    points: int = 400,
    digits: int = 8,
    limits: Limits | None = None,
) -> Samples:
    """Enclosures at about `points` points of [start, stop]; x0 is the middle of the longest regular interval by default,
    and real.  `which` and `frobenius` as for `evaluate`.

    Raises InputError if start isn't below stop, and what `evaluate` raises.
    """
    a, b = (as_point(value, name) for value, name in ((start, "from"), (stop, "to")))
    if not (a.is_real() and b.is_real()) or a.re >= b.re:
        raise InputError(f"the interval from {a} to {b} is empty", hint="give real numbers, the smaller one first")
    if points < 2:
        raise InputError("at least 2 points are needed")
    problem = as_problem(equation, forced=True)
    singular = problem.singular_points(128)
    cuts = sorted({z.re for z in singular if z.is_real() and a.re <= z.re <= b.re})
    wide = {float(midpoint(root).re) for root, order in problem.system.roots("den", 128) if order > 2}
    intervals = _regular_intervals(a.re, b.re, cuts, wide)
    longest = max(intervals, key=lambda i: i[1] - i[0])
    grids = []
    for left, right in intervals:
        count = max(2, round(points * (right - left) / (b.re - a.re)))
        grids.append([left + (right - left) * Fraction(k, count - 1) for k in range(count)])
    initial = (y0, dy0) if which is None and frobenius is None else (None, None)
    states = iter(
        evaluate_states(
            problem,
            list(itertools.chain(*grids)),
            x0=(longest[0] + longest[1]) / 2 if x0 is None else x0,
            y0=initial[0],
            dy0=initial[1],
            which=which,
            frobenius=frobenius,
            digits=digits,
            path="above",
            limits=limits,
        )
    )
    return Samples(tuple(tuple(itertools.islice(states, len(grid))) for grid in grids), tuple(map(complex, singular)))


def _regular_intervals(
    a: Fraction, b: Fraction, cuts: list[Fraction], irregular: set[float]
) -> list[tuple[Fraction, Fraction]]:
    """The intervals between the cuts; where a cut is irregular, solutions beside it are as large as exp(1/distance)."""
    ends = [a, *cuts, b]
    result = []
    for left, right in itertools.pairwise(ends):
        if right == left:
            continue
        start, stop = (
            (right - left) / (_IRREGULAR_MARGIN if float(end) in irregular else _MARGIN) if end in cuts else 0
            for end in (left, right)
        )
        result.append((left + start, right - stop))
    return result


def plot(
    equation: object,
    start: object,
    stop: object,
    *,
    x0: object | None = None,
    y0: object = 1,
    dy0: object = 0,
    which: str | None = None,
    frobenius: Sequence[object] | None = None,
    points: int = 400,
    digits: int = 8,
    title: str | None = None,
    output: str | Path | None = None,
    limits: Limits | None = None,
) -> Figure:
    """A figure with the real part over [start, stop], and the imaginary part unless it can't be told from zero; saved to
    `output` if given.

    Arguments as for `sample`.  The file type follows the suffix of `output` (png, svg, pdf).  Returns the matplotlib
    figure.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as NewFigure

    samples = sample(
        equation,
        start,
        stop,
        x0=x0,
        y0=y0,
        dy0=dy0,
        which=which,
        frobenius=frobenius,
        points=points,
        digits=digits,
        limits=limits,
    )
    figure = NewFigure(figsize=(8, 4.8), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    is_complex = any(abs(result.y.mid.imag) > result.y.radius for run in samples.runs for result in run)
    _curves(axes, samples, is_complex)
    low, high = float(as_point(start, "from").re), float(as_point(stop, "to").re)
    _marks(axes, samples, low, high)
    _limit_height(axes, samples)
    axes.set_xlim(low, high)
    axes.set_xlabel("x")
    axes.set_ylabel("y")
    axes.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    if title:
        axes.set_title(title)
    handles, _ = axes.get_legend_handles_labels()
    if handles:
        axes.legend(loc="best", frameon=False)
    if output is not None:
        figure.savefig(output, dpi=150)
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]  # Jupyter shows it without pyplot
    return figure


def _png(figure: Figure) -> bytes:
    file = BytesIO()
    figure.savefig(file, format="png")
    return file.getvalue()


def _curves(axes: Any, samples: Samples, is_complex: bool) -> None:
    parts: tuple[tuple[str, str, Callable[[complex], float]], ...] = (
        ("Re y", "C0", lambda z: z.real),
        ("Im y", "C1", lambda z: z.imag),
    )
    span = max(max(abs(z.real), abs(z.imag)) for run in samples.runs for z in (result.y.mid for result in run))
    band: str | None = "error band"
    for label, colour, pick in parts if is_complex else parts[:1]:
        for number, run in enumerate(samples.runs):
            xs = [float(x.re) for x in (result.x for result in run) if isinstance(x, Point)]
            ys = [pick(result.y.mid) for result in run]
            radii = [result.y.radius for result in run]
            shown = label if is_complex else "y"
            axes.plot(xs, ys, color=colour, linewidth=1.5, label=shown if number == 0 else None)
            if any(radius > 2e-3 * span for radius in radii):
                below = [y - r for y, r in zip(ys, radii, strict=True)]
                above = [y + r for y, r in zip(ys, radii, strict=True)]
                axes.fill_between(xs, below, above, color=colour, alpha=0.25, linewidth=0, label=band)
                band = None


def _marks(axes: Any, samples: Samples, low: float, high: float) -> None:
    on_axis = [z.real for z in samples.singular if z.imag == 0 and low <= z.real <= high]
    for number, x in enumerate(on_axis):
        axes.axvline(x, color="C3", linestyle="--", linewidth=1, label="singular point" if number == 0 else None)


def _limit_height(axes: Any, samples: Samples) -> None:
    """Cut the picture where a solution runs to infinity at a singular point, so that the rest can be seen."""
    sizes = sorted(
        abs(part) for run in samples.runs for result in run for part in (result.y.mid.real, result.y.mid.imag)
    )
    usual, largest = sizes[int(0.9 * (len(sizes) - 1))], sizes[-1]
    if usual > 0 and largest > 12 * usual:
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, -4 * usual), min(high, 4 * usual))

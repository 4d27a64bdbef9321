"""Pictures of solutions: real and imaginary part over an interval of the real axis, with the singular points marked.

What is drawn are midpoints of proven enclosures at every sample point; the error band is drawn where it's visible at all.
Between sample points the curve is a straight line, which proves nothing.  Beyond a singular point on the axis the solution
is the continuation through the upper half-plane.

matplotlib is needed (`pip install kovacic[plot]`) and imported here only, with a canvas of its own: no window is opened,
and neither the backend nor the state of pyplot is touched.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from io import BytesIO
from itertools import chain, islice, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from kovacic.doubles.chart import chart_of
from kovacic.enclosure.ball import Ball, finite_ball
from kovacic.enclosure.points import Point, as_point, midpoint
from kovacic.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHARE, _IRREGULAR_SHARE = Fraction(1, 256), Fraction(1, 16)
"""The curve ends this share of its interval before a singular point."""


class Sample(NamedTuple):
    """The solution at one point."""

    x: Point
    y: Ball


@dataclass(frozen=True)
class Samples:
    """The solution at points of an interval, in runs that are separated by singular points (real parts as doubles)."""

    runs: tuple[tuple[Sample, ...], ...]
    singular: tuple[complex, ...]


def sample(
    equation: object, start: object, stop: object, *, x0: object | None = None, points: int = 400, **options: Any
) -> Samples:
    """Enclosures at about `points` points of [start, stop]; x0 is the middle of the longest regular interval by default,
    and real.  `y0` = 1, `dy0` = 0, `which`, `frobenius`, `digits` = 8 and `limits` as for `evaluate`.

    Raises InputError if start isn't below stop, and what `evaluate` raises.
    """
    a, b = (as_point(value, name) for value, name in ((start, "from"), (stop, "to")))
    if not (a.is_real() and b.is_real()) or a.re >= b.re:
        raise InputError(f"the interval from {a} to {b} is empty", hint="give real numbers, the smaller one first")
    if points < 2:
        raise InputError("at least 2 points are needed")
    chart = chart_of(equation, {}, options.pop("params", None))
    singular = chart.singular
    cuts = sorted({z.re for z in singular if z.is_real() and a.re <= z.re <= b.re})
    wild = {float(midpoint(root).re) for root, order in chart.problem.system.roots("den", 128) if order > 2}
    grids, longest = [], (a.re, a.re)
    for left, right in pairwise([a.re, *cuts, b.re]):
        # Beside an irregular singular point, solutions are as large as exp(1/distance).
        shares = [0 if end not in cuts else _IRREGULAR_SHARE if float(end) in wild else _SHARE for end in (left, right)]
        first, last = left + (right - left) * shares[0], right - (right - left) * shares[1]
        longest = max(longest, (first, last), key=lambda interval: interval[1] - interval[0])
        count = max(2, round(points * (last - first) / (b.re - a.re)))
        grids.append([first + (last - first) * Fraction(k, count - 1) for k in range(count)] if left < right else [])
    initial = {"y0": 1, "dy0": 0} if options.get("which") is options.get("frobenius") is None else {}
    options = {"limits": None, **initial, **(options if initial else options | {"y0": None, "dy0": None})}
    chart = replace(chart, given={"x0": sum(longest) / 2 if x0 is None else x0})
    places = [Point(x) for x in chain(*grids)]
    values = map(finite_ball, (y for y, _ in chart.states(places, path="above", **{"digits": 8, **options})))
    samples = map(Sample, places, values)
    runs = (tuple(islice(samples, len(grid))) for grid in grids if grid)
    return Samples(tuple(runs), tuple(map(complex, singular)))


def plot(
    equation: object, start: object, stop: object, *, title: str = "", output: str | Path | None = None, **options: Any
) -> Figure:
    """A figure with the real part over [start, stop], and the imaginary part unless it can't be told from zero; saved to
    `output` if given.

    `options` are those of `sample`.  The file type follows the suffix of `output` (png, svg, pdf).  Returns the matplotlib
    figure.
    """
    import numpy as np
    from matplotlib.figure import Figure as NewFigure

    samples = sample(equation, start, stop, **options)
    figure = NewFigure(figsize=(8, 4.8), layout="constrained")
    axes = figure.add_subplot()
    rows = [[*((float(x.re), y.mid, y.radius) for x, y in run), (np.nan,) * 3] for run in samples.runs]
    x, y, radius = map(np.array, zip(*[*chain(*rows)][:-1], strict=True))  # nothing is drawn from one run to the next
    parts = {"y": y.real} if np.nanmax(np.abs(y.imag) - radius) <= 0 else {"Re y": y.real, "Im y": y.imag}
    sizes = np.abs([y.real, y.imag])
    for k, (label, part) in enumerate(parts.items()):
        axes.plot(x, part, linewidth=1.5, label=label)
        if np.nanmax(radius) > 2e-3 * np.nanmax(sizes):
            band = "_" * k + "error band"  # once in the legend
            axes.fill_between(x, part - radius, part + radius, color=f"C{k}", alpha=0.25, linewidth=0, label=band)
    low, high = float(as_point(start, "from").re), float(as_point(stop, "to").re)
    marked = [z.real for z in samples.singular if z.imag == 0 and low <= z.real <= high]
    for k, z in enumerate(marked):
        axes.axvline(z, color="C3", linestyle="--", linewidth=1, label=None if k else "singular point")
    usual = 4 * np.nanquantile(sizes, 0.9)
    if 0 < 3 * usual < np.nanmax(sizes):  # a solution runs to infinity, and the rest is to be seen
        bottom, top = axes.get_ylim()
        axes.set_ylim(max(bottom, -usual), min(top, usual))
    axes.set(xlim=(low, high), xlabel="x", ylabel="y", title=title)
    axes.axhline(0, color="0.8", linewidth=0.8, zorder=0)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best", frameon=False)
    if output is not None:
        figure.savefig(output, dpi=150)
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]  # Jupyter shows it without pyplot
    return figure


def _png(figure: Figure) -> bytes:
    figure.savefig(file := BytesIO(), format="png")
    return file.getvalue()

"""A picture of a scan over two parameters: which values are solvable, and how."""

from __future__ import annotations

import os
from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise

from kovacic.batch.grid import Grid
from kovacic.batch.items import CASES, ERROR, FAILED, LABELS, NONE, UNDECIDED
from kovacic.errors import InputError

# Okabe and Ito's palette, which colour-blind readers can tell apart; "none" is light, so that the solvable values stand out.
_COLOURS = {
    "case 1": "#0072b2",
    "case 2": "#e69f00",
    "case 3 (4)": "#009e73",
    "case 3 (6)": "#cc79a7",
    "case 3 (12)": "#d55e00",
    NONE: "#eeeeee",
    UNDECIDED: "#f0e442",
    ERROR: "#777777",
    FAILED: "#000000",
}
_MEANINGS = dict(zip(CASES, ("1", "2", "3, tetrahedral", "3, octahedral", "3, icosahedral"), strict=True))
_NAMES = {label: f"case {_MEANINGS[label]}" if label in _MEANINGS else label for label in LABELS} | {
    NONE: "no Liouvillian solution",
    ERROR: "not defined",
}
_LARGEST = 4_000_000


def draw_map(
    expression: str, grids: tuple[Grid, Grid], labels: Mapping[int, str], path: str | os.PathLike[str]
) -> None:
    """Write the map to `path` (png, pdf, svg): the first parameter upwards, the second to the right.

    `labels` are those of the records by their numbers.  A cell reaches half-way to the neighbouring values, and a missing
    number leaves it white.  Raises `InputError` for a grid that isn't increasing or decreasing, or too large for a picture.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    upwards, rightwards = grids
    height, width = len(upwards.values), len(rightwards.values)
    if height * width > _LARGEST:
        raise InputError(f"a map of {height} x {width} points is too large for a picture")
    codes = [[_code(labels.get(1 + i * width + k)) for k in range(width)] for i in range(height)]
    figure = Figure(figsize=(7.5, 5.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.pcolormesh(
        _edges(rightwards),
        _edges(upwards),
        codes,
        cmap=ListedColormap(["white", *_COLOURS.values()]),
        norm=BoundaryNorm([k - 0.5 for k in range(len(LABELS) + 2)], len(LABELS) + 1),
    )
    axes.set_xlabel(rightwards.name)
    axes.set_ylabel(upwards.name)
    axes.set_title(f"y'' = S y,  S = {expression if len(expression) <= 70 else expression[:67] + '...'}", fontsize=10)
    shown = set(labels.values())
    figure.legend(
        handles=[Patch(facecolor=_COLOURS[k], edgecolor="#444444", label=_NAMES[k]) for k in LABELS if k in shown],
        loc="outside right upper",
        fontsize=9,
        frameon=False,
    )
    figure.savefig(path, dpi=150)


def _code(label: str | None) -> int:
    return 0 if label is None else 1 + tuple(_COLOURS).index(label)


def _edges(grid: Grid) -> list[float]:
    """Half-way between neighbouring values, and as far beyond the first and the last one."""
    values = list(grid.values)
    if len(values) == 1:
        values = [values[0] - Fraction(1, 2), values[0], values[0] + Fraction(1, 2)]
        return [float((a + b) / 2) for a, b in pairwise(values)]
    steps = [b - a for a, b in pairwise(values)]
    if not (all(step > 0 for step in steps) or all(step < 0 for step in steps)):
        raise InputError(f"the values of {grid.name} aren't in order, and a map needs that")
    middles = [(a + b) / 2 for a, b in pairwise(values)]
    return [float(edge) for edge in (values[0] - steps[0] / 2, *middles, values[-1] + steps[-1] / 2)]

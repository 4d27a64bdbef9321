"""A picture of a scan over two parameters: which values are solvable, and how."""

from __future__ import annotations

import os
from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise

from kovacic.batch.scan import Grid
from kovacic.errors import InputError, needs

# Okabe and Ito's palette, which colour-blind readers can tell apart; "none" is light, so that the solvable values stand out.
_COLOURS_AND_NAMES = {
    "case 1": ("#0072b2", "case 1"),
    "case 2": ("#e69f00", "case 2"),
    "case 3 (4)": ("#009e73", "case 3, tetrahedral"),
    "case 3 (6)": ("#cc79a7", "case 3, octahedral"),
    "case 3 (12)": ("#d55e00", "case 3, icosahedral"),
    "none": ("#eeeeee", "no Liouvillian solution"),
    "undecided": ("#f0e442", "undecided"),
    "bad input": ("#777777", "not defined"),
    "failed": ("#000000", "failed"),
}
_LARGEST = 4_000_000


def draw_map(
    expression: str, grids: tuple[Grid, Grid], labels: Mapping[int, str], path: str | os.PathLike[str]
) -> None:
    """Write the map to `path` (png, pdf, svg): the first parameter upwards, the second to the right.

    `labels` are those of the records by their numbers.  A cell reaches half-way to the neighbouring values, and a missing
    number leaves it white.  Raises `InputError` for a grid that isn't increasing or decreasing, or too large for a picture.
    """
    with needs("plot", "a map"):
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.colors import BoundaryNorm, ListedColormap
        from matplotlib.figure import Figure
        from matplotlib.patches import Patch

    upwards, rightwards = grids
    height, width = len(upwards), len(rightwards)
    if height * width > _LARGEST:
        raise InputError(f"a map of {height} x {width} points is too large for a picture")
    code = {label: number for number, label in enumerate(_COLOURS_AND_NAMES, start=1)}
    codes = [[code.get(labels.get(1 + i * width + k, ""), 0) for k in range(width)] for i in range(height)]
    figure = Figure(figsize=(7.5, 5.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.pcolormesh(
        _edges(rightwards),
        _edges(upwards),
        codes,
        cmap=ListedColormap(["white", *(colour for colour, _ in _COLOURS_AND_NAMES.values())]),
        norm=BoundaryNorm([k - 0.5 for k in range(len(code) + 2)], len(code) + 1),
    )
    axes.set_xlabel(rightwards.name)
    axes.set_ylabel(upwards.name)
    axes.set_title(f"y'' = S y,  S = {expression if len(expression) <= 70 else expression[:67] + '...'}", fontsize=10)
    shown = set(labels.values())
    figure.legend(
        handles=[
            Patch(facecolor=colour, edgecolor="#444444", label=name)
            for label, (colour, name) in _COLOURS_AND_NAMES.items()
            if label in shown
        ],
        loc="outside right upper",
        fontsize=9,
        frameon=False,
    )
    figure.savefig(path, dpi=150)


def _edges(grid: Grid) -> list[float]:
    """Half-way between neighbouring values, and as far beyond the first and the last one."""
    values = [value for value in grid if isinstance(value, Fraction)]
    if len(values) < len(grid):
        raise InputError(f"the values of {grid.name} aren't all rational, and a map needs that")
    steps = [b - a for a, b in pairwise(values)] or [Fraction(1)]
    if not (all(step > 0 for step in steps) or all(step < 0 for step in steps)):
        raise InputError(f"the values of {grid.name} aren't in order, and a map needs that")
    middles = [(a + b) / 2 for a, b in pairwise(values)]
    return [float(edge) for edge in (values[0] - steps[0] / 2, *middles, values[-1] + steps[-1] / 2)]

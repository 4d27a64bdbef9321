"""A map of two parameters by matplotlib: a coloured cell around each point, and a legend.

matplotlib gets a canvas of its own: no window is opened, and the state of pyplot isn't touched.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from kovacic.errors import InputError
from kovacic.numbers.numerals import in_a_message

#: The range of doubles, in which pictures are drawn.
FARTHEST = 10**300


@dataclass(frozen=True)
class CellKind:
    """A kind of cell: its name in the legend, empty for none, and its colour."""

    name: str
    colour: str


def edges(values: Sequence[Fraction]) -> list[float]:
    """Half-way between neighbouring values, and as far beyond the first and the last one."""
    steps = [b - a for a, b in pairwise(values)] or [Fraction(1)]
    middles = [(a + b) / 2 for a, b in pairwise(values)]
    return [float(edge) for edge in (values[0] - steps[0] / 2, *middles, values[-1] + steps[-1] / 2)]


def check_size(height: int, width: int) -> None:
    """Raise `InputError` for a map of more points than a large screen has pixels."""
    if height * width > 4_000_000:
        raise InputError(f"a map of {in_a_message(height)} x {in_a_message(width)} points is too large for a picture")


def new_axes(width: float, height: float) -> Any:
    """The axes of a new figure, which can be saved."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure.add_subplot()


def draw_cells(
    axes: Any,
    rightwards: Sequence[Fraction],
    upwards: Sequence[Fraction] | None,
    cells: Sequence[Sequence[int]],
    kinds: Sequence[CellKind],
) -> list[Any]:
    """Rows of numbers of `kinds`, from below; a single row without values `upwards`.  Returns the entries of the legend."""
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    rows = [0.0, 1.0] if upwards is None else edges(upwards)
    axes.pcolormesh(
        edges(rightwards),
        rows,
        cells,
        cmap=ListedColormap([kind.colour for kind in kinds]),
        norm=BoundaryNorm(range(len(kinds) + 1), len(kinds)),
    )
    present = sorted({kind for row in cells for kind in row})
    return [
        Patch(facecolor=kinds[k].colour, edgecolor="#555555", label=kinds[k].name) for k in present if kinds[k].name
    ]

"""A map of a two-parameter slice: for which values is the equation solvable?  Needs matplotlib (the extra `plot`)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kovacic.errors import InputError
from kovacic.parametric.restriction import UndefinedError

if TYPE_CHECKING:
    from kovacic.parametric.answer import Conditions

_LABELS = ("no Liouvillian solution", "case 1", "case 2", "case 3", "not determined", "S not defined")
#: Colours that keep apart in print and for colour-blind readers [Okabe & Ito].
_COLOURS = ("#ffffff", "#0072b2", "#e69f00", "#cc79a7", "#dddddd", "#000000")


def grid_of_cases(
    answer: Conditions, names: Sequence[str], axes: Sequence[Sequence[Fraction]], fixed: Mapping[str, Any]
) -> list[list[int]]:
    """For every pair of values: 0 for no solution, else the case; 4 where nothing is claimed, 5 where S isn't defined."""
    table = []
    for second in axes[1]:
        row = []
        for first in axes[0]:
            point = answer.point({**fixed, names[0]: first, names[1]: second})
            try:
                verdict = answer.predicted(point)
            except (UndefinedError, ZeroDivisionError):
                verdict = None
            row.append(5 if verdict is None else 4 if not verdict.known else verdict.case or 0)
        table.append(row)
    return table


def plot(
    answer: Conditions,
    axes: Any = None,
    *,
    parameters: tuple[str, str] | None = None,
    ranges: tuple[tuple[Any, Any], tuple[Any, Any]] = ((-4, 4), (-4, 4)),
    steps: int = 48,
    fixed: Mapping[str, Any] | None = None,
) -> Any:
    """Draw the cases over a grid of exact rational points into matplotlib axes, which are returned.

    `parameters` are the two that vary (by default the first two), `fixed` gives values to the others; `ranges` with `steps`
    intervals each make the grid, whose points are rational, so that lines such as n - 1/2 in Z are met exactly when the step
    divides them.  Without `axes` a figure is made with the Agg backend; save it with `axes.figure.savefig`.  Nothing is
    ever shown on a screen.  Raises `InputError` with fewer than two parameters.
    """
    names = parameters or answer.parameters[:2]
    if len(names) != 2 or any(name not in answer.parameters for name in names):
        raise InputError("a map needs two parameters", hint=f"the parameters are {', '.join(answer.parameters)}")
    values = [
        [Fraction(low) + (Fraction(high) - Fraction(low)) * k / steps for k in range(steps + 1)] for low, high in ranges
    ]
    table = grid_of_cases(answer, names, values, fixed or {})

    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    if axes is None:
        figure = Figure(figsize=(6.5, 5.5), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
    edges = [
        [float(column[0] - step / 2 + k * step) for k in range(len(column) + 1)]
        for column in values
        for step in [column[1] - column[0]]
    ]
    axes.pcolormesh(edges[0], edges[1], table, cmap=ListedColormap(_COLOURS), norm=BoundaryNorm(range(7), 6))
    present = sorted({case for row in table for case in row})
    handles = [Patch(facecolor=_COLOURS[k], edgecolor="#666666", label=_LABELS[k]) for k in present]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    axes.set_xlabel(names[0])
    axes.set_ylabel(names[1])
    axes.set_title(f"y'' = ({answer.S.to_str(answer.variable).replace('**', '^')}) y", fontsize="medium")
    return axes

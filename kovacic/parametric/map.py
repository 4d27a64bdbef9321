"""A map of a two-parameter slice: for which values is the equation solvable?  Needs matplotlib (the extra `plot`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from kovacic.errors import InputError
from kovacic.numbers.exact import exact_real, whole
from kovacic.numbers.numerals import in_a_message, plain_text
from kovacic.writing.maps import CellKind, draw_cells, new_axes

#: What can be known at a point, in colours that keep apart in print and for colour-blind readers [Okabe & Ito].
_KINDS = (
    CellKind("no Liouvillian solution", "#ffffff"),
    CellKind("case 1", "#0072b2"),
    CellKind("case 2", "#e69f00"),
    CellKind("case 3", "#cc79a7"),
    CellKind("not determined", "#dddddd"),
    CellKind("S not defined", "#000000"),
)
#: The ends of ranges, and so many intervals, at most.
_FARTHEST = 10**300
_MOST_STEPS = 10_000
LABELS = tuple(kind.name for kind in _KINDS)


def _grid(low: Any, high: Any, steps: int) -> list[Fraction]:
    """So many intervals from one number to another, exactly."""
    first = exact_real(low, "an end of a range")
    last = exact_real(high, "an end of a range")
    if max(abs(first), abs(last)) > _FARTHEST:
        raise InputError("a range of a map is beyond the range of doubles, in which pictures are drawn")
    if first >= last:
        said = f"the range from {plain_text(first)[:60]} to {plain_text(last)[:60]} is empty"
        raise InputError(said, hint="give the smaller number first")
    return [first + (last - first) * k / steps for k in range(steps + 1)]


def plot(
    label_at: Callable[[dict[str, Any]], str],
    names: Sequence[str],
    title: str,
    axes: Any = None,
    *,
    parameters: Sequence[str] | None = None,
    ranges: Sequence[tuple[Any, Any]] | None = None,
    steps: int = 48,
    fixed: Mapping[str, Any] | None = None,
) -> Any:
    """Draw the cases, given by their labels, over a grid of exact rational points, so that lines such as n - 1/2 in Z are met.

    The arguments are those of `ParametricAnswer.plot`.  Nothing is ever shown on a screen: a new figure has the Agg backend.
    """
    chosen = tuple(parameters or names[:2])
    if len(chosen) not in (1, 2) or not {*chosen} <= {*names}:
        raise InputError("a map needs one parameter or two", hint=f"the parameters are {', '.join(names)}")
    if any(name in chosen for name in fixed or {}):
        raise InputError(f"a parameter that is fixed doesn't vary: {', '.join(chosen)}")
    grids = _grids(chosen, ranges, steps)
    columns = grids[0]
    is_map = len(chosen) == 2
    rows = grids[1] if is_map else None

    def colour(*point: Fraction) -> int:
        values = dict(zip(chosen, point, strict=True))
        return LABELS.index(label_at({**(fixed or {}), **values}))

    if rows is None:
        table = [[colour(first) for first in columns]]
    else:
        table = [[colour(first, second) for first in columns] for second in rows]
    if axes is None:
        axes = new_axes(6.5, 5.5)
    handles = draw_cells(axes, columns, rows, table, _KINDS)
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    axes.set(xlabel=chosen[0])
    if is_map:
        axes.set(ylabel=chosen[1])
    else:
        axes.set(yticks=[])
    axes.set_title(title, fontsize="medium")
    return axes


def _grids(chosen: Sequence[str], ranges: Sequence[tuple[Any, Any]] | None, steps: int) -> list[list[Fraction]]:
    given = [(-4, 4) for _ in chosen] if ranges is None else list(ranges)
    if len(given) != len(chosen):
        raise InputError(f"{len(given)} ranges for {len(chosen)} parameters", hint="ranges=[(0, 1), (-2, 2)]")
    steps = whole(steps, "steps", least=1)
    if steps > _MOST_STEPS:
        raise InputError(f"steps = {in_a_message(steps)}: at most {_MOST_STEPS} are drawn")
    return [_grid(low, high, steps) for low, high in given]

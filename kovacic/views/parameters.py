"""Conditions on parameters in lines, as a formula, explained, and as a map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

from kovacic.errors import InputError, visible
from kovacic.numbers.exact import exact_real, whole
from kovacic.numbers.numerals import plain_text
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.regions import in_lines
from kovacic.writing.document import SCREEN_LINES
from kovacic.writing.maps import FARTHEST, CellKind, check_size, draw_cells, new_axes

#: The possible claims at a point, in colours that print and colour-blind readers keep apart [Okabe & Ito].
_KINDS = (
    CellKind("no Liouvillian solution", "#ffffff"),
    CellKind("case 1", "#0072b2"),
    CellKind("case 2", "#e69f00"),
    CellKind("case 3", "#cc79a7"),
    CellKind("not determined", "#dddddd"),
    CellKind("S not defined", "#000000"),
)
_LABELS = tuple(kind.name for kind in _KINDS)


def conditions_text(answer: ParametricAnswer, *, all: bool) -> str:
    """The equation, its parameters with their assumptions, and the partition in lines; by default as many as fit a screen."""
    complete = "proven to be complete" if answer.complete is True else f"complete {answer.complete}"
    regions = in_lines(answer.regions)
    shown = regions if all or len(regions) <= SCREEN_LINES + 1 else regions[:SCREEN_LINES]
    first = f"y'' = {answer.right.text}, parameters {', '.join(answer.parameters)}"
    assumed = answer.assumptions.without(name for name, _ in answer.letters)
    if assumed:
        first += f" ({assumed})"
    lines = [first, *(f"  note: {notice}" for notice in answer.notices)]
    if answer.equation is not None and answer.equation.change is not None:
        lines.append(f"  cases and groups over {answer.equation.change.field}")
    lines += (f"  {region}" for region in shown)
    if len(shown) < len(regions):
        lines.append(f"  ... and {len(regions) - len(shown)} more regions: text(all=True), or --all")
    lines += [f"  {_where_generic(answer)}: {answer.generic}", f"  ({complete}; {answer.theory})"]
    return visible("\n".join(lines))


def _where_generic(answer: ParametricAnswer) -> str:
    words = []
    if answer.regions:
        words.append("otherwise")
    if answer.complete is not True:
        words.append("for generic values")
    return ", ".join(words) or "always"


def conditions_latex(answer: ParametricAnswer) -> str:
    """A `cases` environment."""
    rows = [rf"\text{{{r.verdict}}} & {r.statement.latex()}" for r in in_lines(answer.regions) if r.defined]
    rows.append(rf"\text{{{answer.generic}}} & \text{{{_where_generic(answer)}}}")
    return rf"y'' = {answer.right.latex}" + r"\colon\quad \begin{cases} " + r" \\ ".join(rows) + r" \end{cases}"


def explain_conditions(answer: ParametricAnswer) -> str:
    """The partition, and solutions of each region where they are known."""
    lines = [conditions_text(answer, all=True)]
    for region in answer.regions:
        known = [*region.solution()]  # in all of the region, and for the first natural numbers
        for number in range(len(region.determinants)):
            known += region.solution(number)
        said = [*map(str, known)] or [region.why_no_solution] * (region.case == 1)
        lines += ["", f"{region.statement.text()}: {region.said}", *(f"  {line}" for line in said)]
    return visible("\n".join(lines))


def plot_map(
    answer: ParametricAnswer,
    axes: Any,
    parameters: Sequence[str] | None,
    ranges: Sequence[tuple[Any, Any]] | None,
    steps: int,
    fixed: Mapping[str, Any] | None,
) -> Any:
    """A map of two parameters, or a strip for one, coloured by the claims of the regions."""
    chosen = tuple(parameters or answer.parameters[:2])
    if len(chosen) not in (1, 2) or not {*chosen} <= {*answer.parameters}:
        raise InputError("a map needs one parameter or two", hint=f"the parameters are {', '.join(answer.parameters)}")
    if any(name in chosen for name in fixed or {}):
        raise InputError(f"a parameter that is fixed doesn't vary: {', '.join(chosen)}")
    # Exact rational points, so that lines such as n - 1/2 in Z are met.
    columns, *rows = _grids(chosen, ranges, steps)

    def colour(*point: Fraction) -> int:
        values = dict(zip(chosen, point, strict=True))
        verdict = answer.predicted(answer.point({**(fixed or {}), **values}))
        return _LABELS.index(str(verdict or "S not defined"))

    table = [[colour(first, *others) for first in columns] for others in product(*rows)]
    if axes is None:
        axes = new_axes(6.5, 5.5)
    handles = draw_cells(axes, columns, rows[0] if rows else None, table, _KINDS)
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    axes.set(xlabel=chosen[0])
    if rows:
        axes.set(ylabel=chosen[1])
    else:
        axes.set(yticks=[])
    axes.set_title(f"y'' = {answer.right.text}", fontsize="medium")
    return axes


def _grids(chosen: Sequence[str], ranges: Sequence[tuple[Any, Any]] | None, steps: int) -> list[list[Fraction]]:
    given = [(-4, 4) for _ in chosen] if ranges is None else list(ranges)
    if len(given) != len(chosen):
        raise InputError(f"{len(given)} ranges for {len(chosen)} parameters", hint="ranges=[(0, 1), (-2, 2)]")
    steps = whole(steps, "steps", least=1)
    check_size(steps + 1, (steps + 1) ** (len(chosen) - 1))
    return [_equidistant(low, high, steps) for low, high in given]


def _equidistant(low: Any, high: Any, steps: int) -> list[Fraction]:
    """The ends of equal intervals from one number to another, exactly."""
    first, last = (exact_real(end, "an end of a range") for end in (low, high))
    if max(abs(first), abs(last)) > FARTHEST:
        raise InputError("a range of a map is beyond the range of doubles, in which pictures are drawn")
    if first >= last:
        said = f"the range from {plain_text(first)[:60]} to {plain_text(last)[:60]} is empty"
        raise InputError(said, hint="give the smaller number first")
    return [first + (last - first) * k / steps for k in range(steps + 1)]

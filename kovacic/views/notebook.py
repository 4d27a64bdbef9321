"""How an answer shows itself in Jupyter: a formula, and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kovacic.decision import Status
from kovacic.errors import LimitExceeded
from kovacic.views.document import FORMATS, Sentence, Table
from kovacic.views.formula import Formulas, Math, given

if TYPE_CHECKING:
    from kovacic.solution import Solution

#: Longer formulas aren't typeset in a table.
_LONGEST = 3000


def latex_view(solution: Solution) -> str:
    """The equation and, where there are some, two solutions, between dollar signs."""
    words = {Status.NONE_EXISTS: r"\text{no Liouvillian solution}", Status.UNDECIDED: r"\text{undecided}"}
    found, _ = _solutions(solution)
    lines = [_equation(solution), *(f"{name} = {value}" for name, value, _ in found)]
    if solution.status in words:
        lines.insert(1, words[solution.status])
    body = r" \\ ".join(lines)
    return rf"$\displaystyle \begin{{array}}{{l}} {body} \end{{array}}$"


def html_view(solution: Solution) -> str:
    """A table of status, case, group, solutions and check."""
    rows: list[tuple[Sentence, Sentence]] = [(["equation"], [Math("", _equation(solution))])]
    if solution.equation is not None and not solution.equation.is_normal_form:
        rows.append((["normal form"], [Math("", _normal_form(solution))]))
    words = {
        Status.LIOUVILLIAN: "Liouvillian solutions exist",
        Status.NONE_EXISTS: "no Liouvillian solution exists",
        Status.UNDECIDED: f"undecided: {solution.reason}",
    }
    rows.append((["status"], [words[solution.status]]))
    if solution.case is not None:
        rows.append((["case"], [str(solution.case)]))
    group = solution.group
    if group is not None:
        rows.append((["Galois group"], [Math(group.name, group.latex), f", {group.description}"]))
    found, notes = _solutions(solution)
    for name, latex, text in found:
        rows.append(([Math("", name)], [Math(text[:_LONGEST], latex if len(latex) <= _LONGEST else "")]))
    rows += [(["note"], [note]) for note in notes]
    if found and solution.closed_form is not None:
        rows.append((["solutions checked"], [solution.closed_form.checked]))
    rows.append((["verified"], ["yes, by independent code" if solution.verified else "no"]))
    rows += [(["note"], [notice]) for notice in solution.notices]
    return FORMATS["html"].render([Table((), rows)]).rstrip()


def _solutions(solution: Solution) -> tuple[list[tuple[str, str, str]], tuple[str, ...]]:
    """y_1 and y_2, in special functions where nothing is Liouvillian: name and LaTeX, and the expression as text; and notes."""
    from sympy import latex

    if solution.status is Status.UNDECIDED:
        return [], ()
    try:
        form = solution.closed_form
    except LimitExceeded as limit:
        return [], (f"the solutions weren't written out: {limit}",)
    values = solution.special if form is None else (form.y1, form.y2)
    y = "y" if solution.equation is None else solution.equation.unknown
    written = [(f"{y}_{{{k}}}", latex(value), str(value)) for k, value in enumerate(values, start=1)]
    return written, () if form is None else form.notes


def _equation(solution: Solution) -> str:
    return _normal_form(solution) if solution.equation is None else given(solution.equation).latex


def _normal_form(solution: Solution) -> str:
    if not solution.S:
        return "y'' = 0"
    return rf"y'' = \left({Formulas(solution.variable, solution.S.field).math(solution.S).latex}\right) y"

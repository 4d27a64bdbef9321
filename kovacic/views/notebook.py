"""How an answer shows itself in Jupyter: a formula, and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kovacic.decision import Status
from kovacic.errors import LimitExceeded
from kovacic.views.document import FORMATS, Sentence, Table
from kovacic.views.formula import Math
from kovacic.views.sentences import SHORTER, equation_of, normal_form, shorter_pair, solutions_of

if TYPE_CHECKING:
    from kovacic.solution import Solution

#: Longer formulas aren't typeset in a table.
_LONGEST = 3000


def latex_view(solution: Solution) -> str:
    """The equation and, where there are some, two solutions, between dollar signs."""
    words = {Status.NONE_EXISTS: r"\text{no Liouvillian solution}", Status.UNDECIDED: r"\text{undecided}"}
    found, _ = _solutions(solution)
    shorter = shorter_pair(solution, max((len(value.text) for _, value in found), default=0))
    lines = [equation_of(solution).latex, *(f"{name.latex} = {value.latex}" for name, value in found)]
    if shorter:
        lines += [rf"\text{{{SHORTER}}}", *(f"{name.latex} = {value.latex}" for name, value in shorter)]
    if solution.status in words:
        lines.insert(1, words[solution.status])
    body = r" \\ ".join(lines)
    return rf"$\displaystyle \begin{{array}}{{l}} {body} \end{{array}}$"


def html_view(solution: Solution) -> str:
    """A table of status, case, group, solutions and check."""
    rows: list[tuple[Sentence, Sentence]] = [(["equation"], [equation_of(solution)])]
    if solution.equation is not None and not solution.equation.is_normal_form:
        rows.append((["normal form"], [normal_form(solution)]))
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
    for name, value in found:
        rows.append(([name], [value if len(value.latex) <= _LONGEST else Math(value.text[:_LONGEST], "")]))
    rows += [(["note"], [note]) for note in notes]
    if found and solution.closed_form is not None:
        rows.append((["solutions checked"], [solution.closed_form.checked]))
    rows.append((["verified"], ["yes, by independent code" if solution.verified else "no"]))
    rows += [(["note"], [notice]) for notice in solution.notices]
    return FORMATS["html"].render([Table((), rows)]).rstrip()


def _solutions(solution: Solution) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    if solution.status is Status.UNDECIDED:
        return [], ()
    try:
        return solutions_of(solution)
    except LimitExceeded as limit:
        return [], (f"the solutions weren't written out: {limit}",)

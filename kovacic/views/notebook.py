"""How an answer shows itself in Jupyter: a formula, and a table."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from kovacic.decision import Status
from kovacic.reading.names import Names, parameters_of
from kovacic.views.latex import latex_ratfunc, latex_text

if TYPE_CHECKING:
    from kovacic.solution import Solution

#: Longer formulas aren't typeset in a table.
_LONGEST = 3000


def latex_view(solution: Solution) -> str:
    """The equation and, where there are some, two solutions, between dollar signs."""
    from sympy import latex

    lines = [_equation(solution)]
    form = solution.closed_form
    if form is not None:
        y = "y" if solution.equation is None else solution.equation.unknown
        lines += [f"{y}_{{{k}}} = {latex(value)}" for k, value in enumerate((form.y1, form.y2), start=1)]
    elif solution.status is Status.NONE_EXISTS:
        lines.append(r"\text{no Liouvillian solution}")
    else:
        lines.append(r"\text{undecided}")
    body = r" \\ ".join(lines)
    return rf"$\displaystyle \begin{{array}}{{l}} {body} \end{{array}}$"


def html_view(solution: Solution) -> str:
    """A table of status, case, group, solutions and check."""
    rows = [("equation", f"${escape(_equation(solution))}$")]
    if solution.equation is not None and not solution.equation.is_normal_form:
        rows.append(("normal form", f"${escape(_normal_form(solution))}$"))
    words = {
        Status.LIOUVILLIAN: "Liouvillian solutions exist",
        Status.NONE_EXISTS: "no Liouvillian solution exists",
        Status.UNDECIDED: f"undecided: {solution.reason}",
    }
    rows.append(("status", escape(words[solution.status])))
    if solution.case is not None:
        rows.append(("case", str(solution.case)))
    group = solution.group
    if group is not None:
        rows.append(("Galois group", f"${escape(group.latex)}$, {escape(group.description)}"))
    form = solution.closed_form
    if form is not None:
        from sympy import latex

        y = "y" if solution.equation is None else solution.equation.unknown
        for k, value in enumerate((form.y1, form.y2), start=1):
            text = latex(value)
            shown = f"${escape(text)}$" if len(text) <= _LONGEST else f"<code>{escape(str(value)[:_LONGEST])}</code>"
            rows.append((f"${y}_{{{k}}}$", shown))
        rows += [("note", escape(note)) for note in form.notes]
        rows.append(("solutions checked", escape(form.checked)))
    rows.append(("verified", "yes, by independent code" if solution.verified else "no"))
    rows += [("note", escape(notice)) for notice in solution.notices]
    cells = "".join(
        f'<tr><th style="text-align:left">{name}</th><td style="text-align:left">{value}</td></tr>'
        for name, value in rows
    )
    return f"<table>{cells}</table>"


def _equation(solution: Solution) -> str:
    if solution.equation is None:
        return _normal_form(solution)
    return latex_text(solution.equation.text(caret=False))


def _normal_form(solution: Solution) -> str:
    if not solution.S:
        return "y'' = 0"
    names = Names(solution.variable, parameters_of(solution.S.field))
    return rf"y'' = \left({latex_ratfunc(names.renamed(solution.S), latex_text(solution.variable))}\right) y"

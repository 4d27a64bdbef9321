"""Answers for a terminal, as one line or a readable paragraph, and for Jupyter, as a formula and a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from kovacic import derived
from kovacic.answer import Answer
from kovacic.decision import Status
from kovacic.equation import parameters_of
from kovacic.errors import LimitExceeded, visible
from kovacic.reading.pieces import Paste
from kovacic.views.sentences import (
    NOT_DECIDED,
    OF_HOMOGENEOUS,
    SOLVABLE,
    UNSOLVABLE,
    equation_of,
    formulas_of,
    is_inhomogeneous,
    normal_form_of,
    of_degree,
    omega_lines,
    reason,
    solutions_of,
    verdict_in_words,
)
from kovacic.writing.escaped import in_one_line
from kovacic.writing.formula import Math, of_sympy, text_of_words

if TYPE_CHECKING:
    from kovacic.writing.document import Sentence

_ROLES = {SOLVABLE: "good", UNSOLVABLE: "bad", NOT_DECIDED: "unsure"}
_NEITHER = {Status.NONE_EXISTS: "no Liouvillian solution", Status.UNDECIDED: "undecided"}

#: Marks a piece of text by its role ("good", "bad", "unsure", "title", "faint"): in colour on a terminal, not elsewhere.
Style = Callable[[str, str], str]


def one_line(answer: Answer) -> str:
    """The equation and the verdict."""
    riccati = answer.riccati
    if answer.status is Status.UNDECIDED:
        said = ("" if answer.assumed else "undecided, ") + in_one_line(answer.reason or "")
    elif answer.status is Status.NONE_EXISTS:
        said = "no Liouvillian solution"
    elif riccati is None:
        said = f"case {answer.case}"
    elif riccati.degree > 1:
        said = f"case {answer.case}, omega {of_degree(riccati.degree)}"
    else:
        said = f"case {answer.case}, {', '.join(omega_lines(answer))}"
    return f"{_given_text(answer)}: {said}"


def render(
    answer: Answer, *, style: Style = lambda text, role: text, solutions: Iterable[str] | None = None
) -> Iterator[str]:
    """The lines: the equation, the verdict in words, the `solutions`, omega or its polynomial, and how it was verified.

    Each line is yielded as soon as it is known: the verdict doesn't wait for the solutions.
    """
    yield style(_given_text(answer), "title")
    for notice in answer.notices:
        yield style(f"  note: {visible(notice)}", "faint")
    is_gauged = answer.equation is not None and not answer.equation.is_normal_form
    if is_gauged:
        over = "" if answer.change is None else f", over {answer.change.field}"
        yield f"  normal form: {normal_form_of(answer).text}, to which case and omega belong{over}"
    found, more = verdict_in_words(answer)
    yield f"  {style(found, _ROLES[found])}: {visible(more)}"
    if solutions is not None:
        yield from map("  {}".format, solutions)
    if answer.riccati is not None or answer.series is not None:
        yield from map("  {}".format, omega_lines(answer))
    if answer.omega is not None and solutions is None:
        of_what = ", a solution of the normal form" if is_gauged else ""
        yield f"  y = exp(integral of omega d{answer.variable}){of_what}"
    yield from map("  {}".format, _lines_of_exclusions(answer))
    is_open = answer.status is Status.UNDECIDED
    if parameters_of(answer.S.field) and not is_open and not answer.assumed:
        from kovacic.parametric.restriction import generic_conditions

        yield f"  for generic parameters: {generic_conditions(answer)}"
        yield "  (kovacic conditions tells for which values more is solvable)"
    if answer.verified:
        yield f"  {style('verified', 'good')}: {_how_verified(answer)}"
    elif not is_open:  # an undecided equation may leave nothing to check
        yield f"  {style('not verified', 'bad')}"


def _how_verified(answer: Answer) -> str:
    """The claims that the kernel recomputed."""
    if answer.status is Status.NONE_EXISTS:
        return "every exclusion was recomputed by independent code"
    if answer.status is Status.UNDECIDED:
        return "every exclusion before the limit was recomputed by independent code"
    if answer.series is not None:
        return "the recurrence for P, and where it ends, were recomputed by independent code"
    if answer.proof:
        return "omega' + omega^2 = S holds exactly, and every exclusion was recomputed by independent code"
    return "omega' + omega^2 = S holds exactly"


def _given_text(answer: Answer) -> str:
    """The equation in the user's variable; a notice has the rational one, if there is a change of variable."""
    if answer.change is None:
        return equation_of(answer).text
    text = in_one_line(answer.text)
    return text if Paste(text).is_equation else f"y'' = ({text}) y"


def solution_lines(answer: Answer) -> Iterator[str]:
    """y1 and y2 of the homogeneous equation as given, with notes, or the limit that was reached.

    Without a Liouvillian solution: two in special functions, or the classes that were searched in vain.  For an undecided
    equation: two in special functions, if any were found.
    """
    found, notes = _solutions_in_time(answer)
    named = [name.equals(value.shortened).text for name, value in found]
    if answer.case is not None:
        yield from named
    elif named:
        yield "in special functions, verified:"
        yield from map("  {}".format, named)
    elif answer.status is Status.NONE_EXISTS and not notes:
        yield str(derived.special(answer))
    yield from (f"note: {note}" for note in notes)


def _lines_of_exclusions(answer: Answer) -> Iterator[str]:
    """One line for each excluded structure, finite groups with equal reasons together."""
    formulas = formulas_of(answer)
    grouped: dict[tuple[int, str], list[str]] = {}
    for exclusion in answer.proof:
        reasons = "; ".join(text_of_words(reason(evidence, formulas)) for evidence in exclusion.evidence)
        grouped.setdefault((exclusion.structure.case, reasons), []).append(exclusion.structure.value)
    for (case, reasons), structures in grouped.items():
        which = f" ({', '.join(structures)})" if case == 3 else ""
        yield f"not case {case}{which}: {reasons}"


def latex_view(answer: Answer) -> str:
    """The equation and any two solutions, between dollar signs."""
    found, _ = _solutions_in_time(answer)
    lines = [equation_of(answer).latex]
    if answer.equation is not None and answer.change is not None:
        from kovacic.reading.change_of_variable import function_of_x  # imports SymPy

        lines.append(Math.of(answer.variable).equals(of_sympy(function_of_x(answer.equation))).latex)
    if answer.status in _NEITHER:
        lines.append(rf"\text{{{_NEITHER[answer.status]}}}")
    if found and is_inhomogeneous(answer):
        lines.append(rf"\text{{{OF_HOMOGENEOUS}}}")
    lines += (name.equals(value).latex for name, value in found)
    body = r" \\ ".join(lines)
    return rf"$\displaystyle \begin{{array}}{{l}} {body} \end{{array}}$"


def html_view(answer: Answer) -> str:
    """A table of status, case, group, two solutions, notes and checks."""
    from kovacic.writing.document import notebook_table

    rows: list[tuple[Sentence, Sentence]] = [("equation", equation_of(answer))]
    if answer.equation is not None and not answer.equation.is_normal_form:
        rows.append(("normal form", normal_form_of(answer)))
    found, more = verdict_in_words(answer)
    if found == NOT_DECIDED:
        found = f"undecided: {more}"
    elif answer.assumed:  # the reason names the assumptions
        found = more
    rows.append(("status", found))
    if answer.case is not None:
        rows.append(("case", str(answer.case)))
    group = derived.group(answer)
    if group is not None:
        rows.append(("Galois group", [Math(group.name, group.latex), f", {group.description}"]))
    pair, notes = _solutions_in_time(answer)
    for name, value in pair:
        short = value.shortened
        rows.append((name, value if short == value else Math(short.text, "")))
    rows += [("note", OF_HOMOGENEOUS)] if pair and is_inhomogeneous(answer) else []
    rows += [("note", note) for note in notes]
    form = derived.closed_form(answer) if pair else None
    if form is not None:
        rows.append(("solutions checked", form.checked))
    rows.append(("verified", "yes, by independent code" if answer.verified else "no"))
    rows += [("note", notice) for notice in answer.notices]
    return notebook_table(rows)


def _solutions_in_time(answer: Answer) -> tuple[list[tuple[Math, Math]], tuple[str, ...]]:
    """Two solutions and notes; if a limit was reached, a note that says so."""
    try:
        return solutions_of(answer)
    except LimitExceeded as limit:
        return [], (f"the solutions weren't written out: {limit}",)

"""`kovacic solve`, `dsolve`, `explain`, `check`, `schema`: a few equations, their answers, and the proofs of these."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli import options
from kovacic.cli.main import Exit
from kovacic.cli.options import fitted
from kovacic.errors import KovacicError
from kovacic.writing.escaped import json_line

if TYPE_CHECKING:
    from pathlib import Path

    from kovacic.solution import Solution


@options.equation_command()
@click.argument("equations", metavar="S...", nargs=-1, required=True)
@options.formats(
    json="One JSON object (schema 1) a line for each equation.",
    latex="The equation and its solutions in LaTeX.",
    code="Two solutions as code of another system.",
)
@click.option(
    "--full",
    is_flag=True,
    help="With --json: the group, two solutions, and any polynomial of omega as well.",
)
@click.option("--no-solutions", is_flag=True, help="Only the verdict and omega: faster.")
@click.option("--explain", "derived", is_flag=True, hidden=True)
@click.option("--ics", multiple=True, hidden=True)
@options.PROBLEM
@click.pass_context
def solve(
    context: click.Context,
    /,
    equations: tuple[str, ...],
    form: str,
    full: bool,
    no_solutions: bool,
    derived: bool,
    ics: tuple[str, ...],
    **given: Any,
) -> int:
    """Decide y'' = S(x) y for every S, or an equation with y'' in it; "-" reads one a line from standard input.

    Two solutions are printed where there are Liouvillian ones, and the general solution for an equation with a right-hand
    side.  `kovacic dsolve` takes initial values, and `kovacic explain` has the derivation.

    \b
    kovacic solve "x^2 + 3"
    kovacic solve "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    kovacic solve "y'' + 4*y = sin(x)"
    kovacic solve --json "x" "1/x - 3/(16*x^2)"
    kovacic solve --as mathematica "x^2 + 3"
    """
    from kovacic.reading.pieces import Paste
    from kovacic.views.sentences import is_inhomogeneous
    from kovacic.views.text import render, solution_lines

    if form != "json":
        options.refuse({"full"}, "without --json")
    if form != "text":
        named = {"json": "--json", "formula": "--latex"}
        options.refuse({"no_solutions", "derived"}, f"with {named.get(form, '--as')}")
    if form in options.CODE_FORMS:
        options.refuse({"ics"}, "with --as")
    if derived:  # the former names of what explain and dsolve do
        options.refuse({"ics"}, "with --explain")
        return int(context.invoke(explain, equations=equations, no_solutions=no_solutions, **given))
    if ics:
        options.refuse({"assume", "full", "no_solutions"}, "with --ics")
        given |= {"form_json": form == "json" and form, "form_latex": form == "formula" and form, "ics": ", ".join(ics)}
        texts = (text if Paste(text).is_equation else f"y'' = ({text.strip()})*y" for text in equations)
        return max(int(context.invoke(dsolve, equation=text, **given)) for text in texts)

    def lines(answer: Solution) -> Iterable[str]:
        solutions: Iterable[str] | None = None
        if not no_solutions:
            solutions = _inhomogeneous(answer) if is_inhomogeneous(answer) else solution_lines(answer)
        return map(fitted, render(answer, style=options.styled, solutions=solutions))

    show = options.in_form(
        form,
        text=lines,
        json=lambda answer: [answer.to_json(full=full)],
        formula=lambda answer: [answer._repr_latex_()],
        others=partial(_assignments, language=form),
    )
    refuse = _print_refusal if form == "json" else None
    return options.answer_each(equations, show, gap="\n" * (show is lines), refuse=refuse, **given)


def _assignments(answer: Solution, language: str) -> Iterator[str]:
    """The equation and the verdict as a comment, and any two solutions, in Mathematica, Maple or Julia."""
    import sympy

    from kovacic.views.sentences import OF_HOMOGENEOUS, is_inhomogeneous
    from kovacic.writing.code import CODE_LANGUAGES, as_code, letters_to_rename

    comment, assignment = CODE_LANGUAGES[language].comment, CODE_LANGUAGES[language].assignment
    yield comment.format(answer)
    found = sympy.Tuple(*(answer.solutions or answer.special or ()))
    if found and is_inhomogeneous(answer):
        yield comment.format(OF_HOMOGENEOUS)
    others = letters_to_rename(found, language)
    for symbol, other in others.items():
        yield comment.format(f"{other} stands for {symbol}")
    for k, y in enumerate(found.xreplace(others), start=1):
        yield assignment.format(f"y{k}", as_code(y, language))


def _print_refusal(text: str, error: KovacicError) -> None:
    """Print the line of JSON for a text without an answer, as a batch has it."""
    from kovacic.batch.records import Item, refused

    data = refused(Item(0, text), error, shell=True).data
    del data["line"]
    print(json_line(data), flush=True)


def _inhomogeneous(answer: Solution) -> Iterator[str]:
    """The general solution, or why there is none; no line for an undecided equation."""
    from kovacic.writing.formula import shortened

    if answer.status == "undecided":
        return
    equation = answer.text if answer.change else answer.equation
    try:
        yield from map(shortened, _solution_lines(equation, limits=answer.limits))
    except NotImplementedError as reason:
        if answer.case is None and not answer.special:
            yield str(answer.special)
        else:
            yield f"the solution wasn't written out: {reason}"


@options.equation_command()
@click.argument("equation", metavar="EQUATION")
@options.formats(json="One JSON object (schema 1).", latex="The solution in LaTeX.")
@click.option(
    "--ics",
    metavar="VALUES",
    multiple=True,
    callback=lambda _, __, values: ", ".join(values),
    help='Conditions: "y(0)=1, y\'(0)=0", "y(0)=0, y(pi)=0", "y(0)=bounded, y(oo)=0".',
)
@click.option("--func", metavar="NAME", help="The unknown function, y or y(x), where other functions occur.")
@options.PROBLEM
def dsolve(equation: str, form: str, ics: str, **given: Any) -> int:
    """The general solution of a linear equation of second order; with values, or --ics, the one that has these.

    The right-hand side may contain exp, log, sin, cos and the like.  Where nothing is Liouvillian, special functions are
    tried; if none is found either, the reason is printed, and the exit status is 0 as well.

    \b
    kovacic dsolve "y'' + 4*y' + 4*y = exp(-2*x)/x^2"
    kovacic dsolve "y'' - 2*x*y' + 2*y = 0, y(0)=0, y'(0)=5"
    kovacic dsolve "x*y'' + y' - x*y = 0" --ics "y(0)=bounded, y(1)=1"
    kovacic dsolve --json "y'' + y = 0"
    """
    from kovacic.general_solution import NothingKnown

    try:
        if form == "json":
            print(_solution_in_json(equation, ics, **given))
            return Exit.DECIDED
        with options.waiting("solving"):
            lines = list(_solution_lines(equation, latex=form == "formula", ics=ics, **given))
        options.say_reading(equation, given["var"], given["parameters"])
        for line in lines:
            print(options.in_form(form, text=fitted, others=str)(line))
        return Exit.DECIDED
    except KovacicError as error:
        if form == "json":
            _print_refusal(equation, error)
        raise
    except NotImplementedError as reason:
        is_proven = isinstance(reason, NothingKnown) and reason.is_proven
        if form == "json":
            status = "none" if is_proven else "undecided"
            print(json_line({"schema": 1, "input": equation, "status": status, "reason": str(reason)}))
        elif is_proven:
            print(fitted(str(reason)))
        else:
            print(f"kovacic: {reason}", file=sys.stderr)
        return Exit.DECIDED if is_proven else Exit.UNDECIDED


def _solution_lines(equation: Any, *, latex: bool = False, **given: Any) -> Iterator[str]:
    """The solution that `dsolve` finds, and its domain of validity."""
    from kovacic.general_solution import dsolve, validity
    from kovacic.numbers.numerals import as_latex, as_text
    from kovacic.writing.formula import caret

    found = dsolve(equation, **given)
    for solution in found if isinstance(found, list) else [found]:
        yield as_latex(solution) if latex else f"{solution.lhs} = {caret(as_text(solution.rhs))}"
    needed = None if latex else validity(found, given.get("assume"))
    if needed:
        yield f"  {needed.claim} for {caret(as_text(needed))}"


def _solution_in_json(equation: str, ics: str, **given: Any) -> str:
    """The solution that `dsolve` finds, with its notices, as a line of JSON."""
    from kovacic.general_solution import dsolve, given_answer, in_special_functions, validity
    from kovacic.numbers.numerals import as_latex, as_text

    with options.waiting("solving"), warnings.catch_warnings(record=True, action="always") as noticed:
        found = dsolve(equation, ics=ics, **given)
        needed = str(validity(found, given.get("assume"))) or None
        data: dict[str, Any] = {"schema": 1, "input": equation, "ics": ics or None, "status": "solved"}
        if isinstance(found, list):  # a system
            data |= {
                "unknown": [str(solution.lhs) for solution in found],
                "solution": [as_text(solution.rhs) for solution in found],
                "latex": [as_latex(solution) for solution in found],
                "validity": needed,
            }
        else:
            shorter = in_special_functions(found, equation, ics=ics, **given)
            exceptions = getattr(given_answer(found), "exceptions", ())  # values of letters with another solution
            data |= {
                "unknown": str(found.lhs),
                "solution": as_text(found.rhs),
                "latex": as_latex(found),
                "special": None if shorter is None else as_text(shorter.rhs),
                "validity": needed,
                "exceptions": [
                    {"where": str(case), "solution": case.answer and as_text(case.answer.eq.rhs)} for case in exceptions
                ],
            }
    return json_line(data | {"notices": [str(warning.message) for warning in noticed]})


@options.equation_command()
@click.argument("equations", metavar="EQUATION...", nargs=-1, required=True)
@options.formats(
    format="Text (the default); Markdown with formulas between dollar signs; the body of a LaTeX document (amsmath, amssymb, "
    "graphicx); or a page of its own for a browser.",
)
@click.option(
    "-o",
    "--output",
    type=options.OutputFile(tuple(options.DOCUMENTS)),
    help=f"Write to this file; without --format its suffix says which: {', '.join(options.DOCUMENTS)}.",
)
@click.option("--cite", is_flag=True, help="Only the references, as BibTeX.")
@click.option("--no-solutions", is_flag=True, help="Leave the closed forms out.")
@options.PROBLEM
def explain(
    equations: tuple[str, ...],
    form: str,
    output: Path | None = None,
    cite: bool = False,
    no_solutions: bool = False,
    **given: Any,
) -> int:
    """Explain the answer for y'' = S(x) y, or for an equation with y'' in it; "-" reads one a line.

    For an equation with a right-hand side or values, or of first order, these are the steps to its solution.

    \b
    kovacic explain "x^2 + 3"
    kovacic explain "x^2*y'' + x*y' + (x^2-1/4)*y = 0" -o bessel.html
    kovacic explain "y'' + y = 1/cos(x), y(0) = 1, y'(0) = 0"
    """
    from kovacic.general_solution import explain as explain_problem
    from kovacic.general_solution import is_problem

    if cite:
        options.refuse({"form_format", "output", "no_solutions"}, "with --cite")
    if output is not None and (len(equations) > 1 or equations == ("-",)):
        raise click.UsageError("--output takes the explanation of one equation")

    def written(text: str) -> str:
        """The text as printed, or a message after it was written to the output file."""
        text = text.rstrip("\n")
        if output is not None:
            output.write_text(f"{text}\n", encoding="utf-8")
            return f"wrote {output}"
        return str(options.in_form(form, text=fitted, others=str)(text))

    def show(answer: Solution) -> Iterable[str]:
        if cite:
            return (answer.citation(style="bibtex"),)
        return (written(answer.explain(format=form, solutions=not no_solutions)),)

    if len(equations) == 1 and equations != ("-",) and not cite and is_problem(equations[0]):
        try:
            with options.waiting("solving"):
                text = explain_problem(equations[0], format=form, **given)
        except NotImplementedError as reason:
            print(f"kovacic: {reason}", file=sys.stderr)
            return Exit.UNDECIDED
        print(written(text))
        return Exit.DECIDED
    return options.answer_each(equations, show, gap="\n", **given)


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True)
def check(files: tuple[str, ...]) -> int:
    """Check answers that `kovacic solve --json` or `kovacic batch` wrote, one a line; "-" reads standard input.

    \b
    kovacic solve --json --full "x^2 + 3" "x" | kovacic check -

    \b
    checked: S from input; case; omega; not checked: notices, seconds
    refuted: why
    not checked: why
    unreadable: why

    Says one of these for each line: what was proven, and which keys weren't looked at.  The checker is one file that also
    runs alone, kovacic/checker.py, and begins with what it proves.

    Exit status: 0 all checked, 1 one refuted, 2 a file or a line unreadable or nothing to check, 3 one not checked; the first
    of 1, 2, 3 that applies.
    """
    from kovacic.checker import check_files

    return check_files(list(files))


@click.command()
def schema() -> None:
    """Print the JSON Schema that describes every line that solve, batch, scan, conditions and ball print with --json.

    \b
    kovacic schema > schema.json
    """
    from pkgutil import get_data

    click.echo((get_data("kovacic.views", "schema.json") or b"").decode("utf-8"), nl=False)

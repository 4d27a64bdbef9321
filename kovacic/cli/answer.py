"""`kovacic solve`, `dsolve`, `explain`, `check`, `schema`: a few equations, their answers, and what these rest on."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli import options
from kovacic.cli.main import DECIDED, UNDECIDED
from kovacic.cli.options import fitted

if TYPE_CHECKING:
    from kovacic.solution import Solution

_ICS = click.option(
    "--ics",
    metavar="VALUES",
    multiple=True,
    callback=lambda _, __, values: ", ".join(values),
    help='Conditions: "y(0)=1, y\'(0)=0", "y(0)=0, y(pi)=0", "y(0)=bounded, y(oo)=0".',
)


@options.equation_command()
@options.equation_argument("equations", metavar="S...", nargs=-1, required=True)
@click.option("--json", "as_json", is_flag=True, help="One JSON object (schema 1) a line for each equation.")
@click.option("--full", is_flag=True, help="With --json: the group and two solutions in closed form as well.")
@click.option("--latex", is_flag=True, help="The equation and its solutions in LaTeX.")
@click.option("--explain", "derived", is_flag=True, help="The derivation, step by step (see `kovacic explain`).")
@click.option("--no-solutions", is_flag=True, help="Only the verdict and omega: faster.")
@_ICS
@options.VAR
@options.ASSUME
@options.LIMIT
def solve(
    equations: tuple[str, ...],
    as_json: bool,
    full: bool,
    latex: bool,
    derived: bool,
    no_solutions: bool,
    ics: str,
    **given: Any,
) -> int:
    """Decide y'' = S(x) y for every S, or an equation with y'' in it; "-" reads one a line from standard input.

    Two solutions are printed where there are Liouvillian ones; the general solution for an equation with a right-hand side,
    and the only one where initial values are given.

    \b
    kovacic solve "x^2 + 3"
    kovacic solve "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    kovacic solve "y'' + 4*y = sin(x)" --ics "y(0)=1, y'(0)=0"
    kovacic solve --json "x" "1/x - 3/(16*x^2)"
    """
    from kovacic.views.text import render, solution_lines

    if ics and (as_json or latex or derived or no_solutions):
        raise click.UsageError("--ics belongs to the solutions as text (kovacic dsolve --latex has the others)")

    def show(answer: Solution) -> Iterable[str]:
        if as_json:
            return (answer.to_json(full=full),)
        if latex:
            return (answer._repr_latex_(),)
        if derived:
            return (fitted(answer.explain().rstrip("\n")),)
        homogeneous = answer.equation is None or answer.equation.is_homogeneous
        solutions = solution_lines(answer) if homogeneous and not ics else _inhomogeneous(answer, ics)
        return map(fitted, render(answer, style=options.styled, solutions=None if no_solutions else solutions))

    return options.answer_each(equations, show, gap="" if as_json or latex else "\n", **given)


def _inhomogeneous(answer: Solution, values: str) -> Iterator[str]:
    """The general solution, or that with the initial values; why not; no line for an undecided equation."""
    if answer.status == "undecided":
        return
    from kovacic.equation import Equation
    from kovacic.writing.formula import shortened

    zero = answer.S * 0
    normal = Equation(zero + 1, zero, -answer.S, zero, variable=answer.variable)
    equation = answer.text if answer.change else answer.equation or normal
    try:
        yield from map(shortened, _general(equation, ics=values, limits=answer.limits))
    except NotImplementedError as reason:
        nothing = answer.case is None and not answer.special
        yield str(answer.special) if nothing else f"the solution wasn't written out: {reason}"


@options.equation_command()
@options.equation_argument("equation", metavar="EQUATION")
@click.option("--latex", is_flag=True, help="The solution in LaTeX.")
@_ICS
@options.VAR
@options.LIMIT
def dsolve(equation: str, latex: bool, ics: str, **given: Any) -> int:
    """The general solution of a linear equation of second order; with --ics the one that has these values.

    The right-hand side may contain exp, log, sin, cos and the like.  Where nothing is Liouvillian, special functions are
    looked for; where none is found either, this is said, with the reason, and the exit status is 0 as well.

    \b
    kovacic dsolve "y'' + 4*y' + 4*y = exp(-2*x)/x^2"
    kovacic dsolve "y'' - 2*x*y' + 2*y = 0" --ics "y(0)=0, y'(0)=5"
    kovacic dsolve "x*y'' + y' - x*y = 0" --ics "y(0)=bounded, y(1)=1"
    """
    from kovacic.decision import Status
    from kovacic.solution import solve

    try:
        for line in _general(equation, latex=latex, ics=ics, **given):
            print(line if latex else fitted(line))
    except NotImplementedError as reason:
        answer = solve(equation, **given)
        if answer.status is Status.NONE_EXISTS and not answer.special:
            print(fitted(str(reason)))
            return DECIDED
        print(f"kovacic: {reason}", file=sys.stderr)
        return UNDECIDED
    return DECIDED


def _general(equation: Any, *, latex: bool = False, **given: Any) -> Iterator[str]:
    """What `dsolve` finds; beside formulas of many lines a shorter one in special functions, if one is known."""
    from kovacic.general_solution import dsolve, in_special_functions
    from kovacic.numerals import as_latex, as_text
    from kovacic.views.sentences import SHORTER
    from kovacic.writing.formula import caret

    found = dsolve(equation, **given)
    shorter = in_special_functions(found, equation, **given)
    for k, solution in enumerate([found] if shorter is None else [found, shorter]):
        if latex:
            yield from (r"\text{" + SHORTER + "}", as_latex(solution)) if k else (as_latex(solution),)
        else:
            yield from (SHORTER,) if k else ()
            yield f"{'  ' if k else ''}{solution.lhs} = {caret(as_text(solution.rhs))}"


@options.equation_command()
@options.equation_argument("equations", metavar="EQUATION...", nargs=-1, required=True)
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "markdown", "latex", "html"]),
    default="text",
    help="Text; Markdown with formulas between dollar signs; the body of a LaTeX document (amsmath, amssymb, graphicx); "
    "or a page of its own for a browser.",
)
@click.option("--cite", is_flag=True, help="Only the references, as BibTeX.")
@click.option("--no-solutions", is_flag=True, help="Leave the closed forms out.")
@options.VAR
@options.ASSUME
@options.LIMIT
def explain(equations: tuple[str, ...], form: str, cite: bool, no_solutions: bool, **given: Any) -> int:
    """Explain the answer for y'' = S(x) y, or for an equation with y'' in it; "-" reads one a line.

    \b
    kovacic explain "x^2 + 3"
    kovacic explain --format html "x^2*y'' + x*y' + (x^2-1/4)*y = 0" > bessel.html
    """

    def show(answer: Solution) -> tuple[str]:
        if cite:
            return (answer.citation(style="bibtex"),)
        text = answer.explain(format=form, solutions=not no_solutions).rstrip("\n")
        return (fitted(text) if form == "text" else text,)

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

    Exit status: 0 all checked, 1 one refuted, 2 a file or a line unreadable, 3 one not checked; the first of 1, 2, 3
    that applies.
    """
    from kovacic.checker import main

    return main(list(files))


@click.command()
def schema() -> None:
    """Print the JSON Schema that describes every line that solve, batch, scan, conditions and ball print with --json.

    \b
    kovacic schema > schema.json
    """
    from pkgutil import get_data

    click.echo((get_data("kovacic.views", "schema.json") or b"").decode("utf-8"), nl=False)

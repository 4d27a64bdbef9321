"""`kovacic solve`: the answers for a few equations, as text or as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.options import (
    answer_each,
    assume_option,
    equation_argument,
    equation_command,
    fitted,
    ics_option,
    limit_option,
    styled,
    var_option,
)

if TYPE_CHECKING:
    from kovacic.solution import Solution


@equation_command()
@equation_argument("equations", metavar="S...", nargs=-1, required=True)
@click.option("--json", "as_json", is_flag=True, help="One JSON object (schema 1) a line for each equation.")
@click.option("--full", is_flag=True, help="With --json: the group and two solutions in closed form as well.")
@click.option("--latex", is_flag=True, help="The equation and its solutions in LaTeX.")
@click.option("--explain", is_flag=True, help="The derivation, step by step (see `kovacic explain`).")
@click.option("--no-solutions", is_flag=True, help="Only the verdict and omega: faster.")
@ics_option
@var_option
@assume_option
@limit_option
def command(
    equations: tuple[str, ...],
    as_json: bool,
    full: bool,
    latex: bool,
    explain: bool,
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

    if ics and (as_json or latex or explain or no_solutions):
        raise click.UsageError("--ics belongs to the solutions as text (kovacic dsolve --latex has the others)")

    def show(answer: Solution) -> Iterable[str]:
        if as_json:
            return (answer.to_json(full=full),)
        if latex:
            return (answer._repr_latex_(),)
        if explain:
            return (fitted(answer.explain().rstrip("\n")),)
        homogeneous = answer.equation is None or answer.equation.is_homogeneous
        solutions = solution_lines(answer) if homogeneous and not ics else _general_lines(answer, ics)
        return map(fitted, render(answer, style=styled, solutions=None if no_solutions else solutions))

    return answer_each(equations, show, gap="" if as_json or latex else "\n", **given)


def _general_lines(answer: Solution, values: str) -> Iterator[str]:
    """The general solution, or that with the initial values; why not; no line for an undecided equation."""
    if answer.status == "undecided":
        return
    from kovacic.cli.dsolve import general_lines
    from kovacic.reading.given import Equation
    from kovacic.views.formula import shortened

    zero = answer.S * 0
    normal = Equation(zero + 1, zero, -answer.S, zero, variable=answer.variable)
    equation = answer.text if answer.change else answer.equation or normal
    try:
        yield from map(shortened, general_lines(equation, ics=values, limits=answer.limits))
    except NotImplementedError as reason:
        nothing = answer.case is None and not answer.special
        yield str(answer.special) if nothing else f"the solution wasn't written out: {reason}"

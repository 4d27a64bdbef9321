"""`kovacic dsolve`: the general solution of an equation, or that with given initial values."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import click

from kovacic.cli.main import DECIDED, UNDECIDED
from kovacic.cli.options import equation_argument, equation_command, fitted, ics_option, limit_option, var_option


@equation_command()
@equation_argument("equation", metavar="EQUATION")
@click.option("--latex", is_flag=True, help="The solution in LaTeX.")
@ics_option
@var_option
@limit_option
def command(equation: str, latex: bool, ics: str, **given: Any) -> int:
    """The general solution of a linear equation of second order; with --ics the one that has these values.

    The right-hand side may contain exp, log, sin, cos and the like.  Where nothing is Liouvillian, special functions are
    looked for; where none is found either, this is said, with the reason, and the exit status is 0 as well.

    \b
    kovacic dsolve "y'' + 4*y' + 4*y = exp(-2*x)/x^2"
    kovacic dsolve "y'' - 2*x*y' + 2*y = 0" --ics "y(0)=0, y'(0)=5"
    """
    from kovacic.api import solve
    from kovacic.decision import Status

    try:
        for line in general_lines(equation, latex=latex, ics=ics, **given):
            print(line if latex else fitted(line))
    except NotImplementedError as reason:
        answer = solve(equation, **given)
        if answer.status is Status.NONE_EXISTS and not answer.special:
            print(fitted(str(reason)))
            return DECIDED
        print(f"kovacic: {reason}", file=sys.stderr)
        return UNDECIDED
    return DECIDED


def general_lines(equation: Any, *, latex: bool = False, **given: Any) -> Iterator[str]:
    """What `dsolve` finds; beside formulas of many lines a shorter one in special functions, if one is known."""
    from kovacic.general_solution import dsolve, in_special_functions
    from kovacic.views.formula import caret
    from kovacic.views.sentences import SHORTER

    found = dsolve(equation, **given)
    shorter = in_special_functions(found, equation, **given)
    for k, solution in enumerate([found] if shorter is None else [found, shorter]):
        if latex:
            from sympy import latex as formula

            yield from (r"\text{" + SHORTER + "}", formula(solution)) if k else (formula(solution),)
        else:
            yield from (SHORTER,) if k else ()
            yield f"{'  ' if k else ''}{solution.lhs} = {caret(str(solution.rhs))}"

"""`kovacic conditions`: the values of the parameters for which an equation is solvable."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.main import CHECK_FAILED, DECIDED, UNDECIDED
from kovacic.cli.options import assume_option, equation_argument, equation_command, fitted, limit_option

if TYPE_CHECKING:
    from kovacic.parametric.check import CheckReport


@equation_command()
@equation_argument("equation", metavar="S")
@click.option("--json", "as_json", is_flag=True, help="One line of JSON.")
@click.option("--latex", "as_latex", is_flag=True, help="A LaTeX formula.")
@click.option("--var", metavar="NAME", help="The name of the variable, by default x; all other names are parameters.")
@assume_option
@click.option("--max-degree", default=2, show_default=True, help="The determinants Delta_d are shown up to this d.")
@click.option("--all", "everything", is_flag=True, help="All regions, however many.")
@click.option("--explain", "explained", is_flag=True, help="What each region follows from, and its solutions.")
@click.option("--check", "samples", metavar="N", type=int, help="Solve at N exact points, and compare.")
@limit_option
def command(
    equation: str, as_json: bool, as_latex: bool, everything: bool, explained: bool, samples: int | None, **given: Any
) -> int:
    """For which values of its parameters does y'' = S(x) y have Liouvillian solutions?

    \b
    kovacic conditions "(4*n^2 - 1)/(4*x^2) - 1"
    kovacic conditions --check 200 "x^4 + mu*x"
    """
    from kovacic.parametric.api import conditions

    answer = conditions(equation, **given)
    report = None if samples is None else answer.check(samples)
    shown = answer.explain() if explained else answer.text(all=everything)
    print(answer.to_json() if as_json else answer.latex() if as_latex else fitted(shown))
    if report is not None:
        print(
            f"  checked at {report.inside} points inside and {report.outside} outside: {_agreement(report)}",
            file=sys.stderr if as_json or as_latex else sys.stdout,
        )
        if not report:
            return CHECK_FAILED
    return DECIDED if answer.within_limits else UNDECIDED


def _agreement(report: CheckReport) -> str:
    if not report:
        return f"{len(report.disagreements)} disagree"
    return "all agree" if report.inside + report.outside else "no point with these properties was found"

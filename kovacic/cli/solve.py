"""`kovacic solve`: the answers for a few equations, as text or as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from kovacic.cli.options import EQUATIONS, answer_each, assume_option, fitted, limit_option, styled, var_option

if TYPE_CHECKING:
    from kovacic.solution import Solution


@click.command(context_settings=EQUATIONS)
@click.argument("equations", metavar="S...", nargs=-1, required=True)
@click.option("--json", "as_json", is_flag=True, help="One JSON object (schema 1) a line for each equation.")
@click.option("--full", is_flag=True, help="With --json: the group and two solutions in closed form as well.")
@click.option("--latex", is_flag=True, help="The equation and its solutions in LaTeX.")
@click.option("--explain", is_flag=True, help="The derivation, step by step (see `kovacic explain`).")
@var_option
@assume_option
@limit_option
def command(
    equations: tuple[str, ...],
    as_json: bool,
    full: bool,
    latex: bool,
    explain: bool,
    var: str | None,
    assume: tuple[str, ...],
    limits: tuple[str, ...],
) -> int:
    """Decide y'' = S(x) y for every S, or an equation with y'' in it; "-" reads one a line from standard input.

    \b
    kovacic solve "x^2 + 3"
    kovacic solve "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    kovacic solve --json "x" "1/x - 3/(16*x^2)"
    """
    from kovacic.views.text import render

    def show(answer: Solution) -> str:
        if as_json:
            return answer.to_json(full=full)
        if latex:
            return answer._repr_latex_()
        return fitted(answer.explain().rstrip("\n") if explain else render(answer, style=styled))

    gap = "" if as_json or latex else "\n"
    return answer_each(equations, show, var=var, limits=limits, assume=assume, gap=gap)

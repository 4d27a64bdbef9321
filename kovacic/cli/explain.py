"""`kovacic explain`: the derivation of an answer, step by step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from kovacic.cli.options import EQUATIONS, answer_each, fitted, limit_option, var_option

if TYPE_CHECKING:
    from kovacic.solution import Solution


@click.command(context_settings=EQUATIONS)
@click.argument("equations", metavar="EQUATION...", nargs=-1, required=True)
@click.option("--markdown", "form", flag_value="markdown", help="Markdown with formulas between dollar signs.")
@click.option("--latex", "form", flag_value="latex", help="The body of a LaTeX document (amsmath).")
@click.option("--cite", is_flag=True, help="Only the references, as BibTeX.")
@click.option("--no-solutions", is_flag=True, help="Leave the closed forms out.")
@var_option
@limit_option
def command(
    equations: tuple[str, ...],
    form: str | None,
    cite: bool,
    no_solutions: bool,
    var: str | None,
    limits: tuple[str, ...],
) -> int:
    """Explain the answer for y'' = S(x) y, or for an equation with y'' in it; "-" reads one a line.

    \b
    kovacic explain "x^2 + 3"
    kovacic explain --markdown "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    """

    def show(answer: Solution) -> str:
        if cite:
            return answer.citation(style="bibtex")
        text = answer.explain(format=form or "text", solutions=not no_solutions).rstrip("\n")
        return text if form else fitted(text)

    return answer_each(equations, show, var=var, limits=limits, gap="\n")

"""`kovacic explain`: the derivation of an answer, step by step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from kovacic.cli.options import (
    answer_each,
    assume_option,
    equation_argument,
    equation_command,
    fitted,
    limit_option,
    var_option,
)

if TYPE_CHECKING:
    from kovacic.solution import Solution


@equation_command()
@equation_argument("equations", metavar="EQUATION...", nargs=-1, required=True)
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
@var_option
@assume_option
@limit_option
def command(equations: tuple[str, ...], form: str, cite: bool, no_solutions: bool, **given: Any) -> int:
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

    return answer_each(equations, show, gap="\n", **given)

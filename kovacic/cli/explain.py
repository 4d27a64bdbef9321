"""`kovacic explain`: the derivation of an answer, step by step."""

from __future__ import annotations

import click

from kovacic.cli.main import DECIDED, UNDECIDED
from kovacic.cli.options import expressions, parse_limits, refuse_options


@click.command(context_settings={"ignore_unknown_options": True})
@click.argument("equations", metavar="EQUATION...", nargs=-1, required=True)
@click.option("--markdown", "form", flag_value="markdown", help="Markdown with formulas between dollar signs.")
@click.option("--latex", "form", flag_value="latex", help="The body of a LaTeX document (amsmath).")
@click.option("--cite", is_flag=True, help="Only the references, as BibTeX.")
@click.option("--no-solutions", is_flag=True, help="Leave the closed forms out.")
@click.option("--var", metavar="NAME", help="The name of the variable; by default the only symbol, or x.")
@click.option("--limit", "limits", metavar="NAME=VALUE", multiple=True, help="Change a limit, as for `kovacic solve`.")
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
    from kovacic.api import solve
    from kovacic.decision import Status

    refuse_options(equations)
    chosen = parse_limits(limits)
    outcome = DECIDED
    for k, text in enumerate(expressions(equations)):
        answer = solve(text, var=var, limits=chosen)
        if answer.status is Status.UNDECIDED:
            outcome = UNDECIDED
        if k:
            print()
        if cite:
            print(answer.citation(style="bibtex"))
        else:
            print(answer.explain(format=form or "text", solutions=not no_solutions), end="")
    return outcome

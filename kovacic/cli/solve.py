"""`kovacic solve`: the answers for a few equations, as text or as JSON."""

from __future__ import annotations

import sys

import click

from kovacic.cli.main import BAD_INPUT, CHECK_FAILED, DECIDED, UNDECIDED
from kovacic.cli.options import expressions, parse_assumptions, parse_limits, refuse_options
from kovacic.cli.terminal import styled

# The most serious outcome of several equations is the exit status.
_SEVERITY = (DECIDED, UNDECIDED, BAD_INPUT, CHECK_FAILED)


@click.command(context_settings={"ignore_unknown_options": True})
@click.argument("equations", metavar="S...", nargs=-1, required=True)
@click.option("--json", "as_json", is_flag=True, help="One JSON object (schema 1) a line for each equation.")
@click.option("--full", is_flag=True, help="With --json: the group and two solutions in closed form as well.")
@click.option("--latex", is_flag=True, help="The equation and its solutions in LaTeX.")
@click.option("--explain", is_flag=True, help="The derivation, step by step (see `kovacic explain`).")
@click.option("--var", metavar="NAME", help="The name of the variable; by default the only symbol of S, or x.")
@click.option("--assume", metavar="NAME=WHAT", multiple=True, help="What is known about a parameter: n=integer.")
@click.option(
    "--limit",
    "limits",
    metavar="NAME=VALUE",
    multiple=True,
    help="Change a limit: seconds, degree, bits, digits, exponent, text_length, unknown_degree.",
)
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
    from kovacic.api import solve
    from kovacic.decision import Status
    from kovacic.errors import InputError, LimitExceeded, VerificationFailed

    refuse_options(equations)
    chosen = parse_limits(limits)
    assumptions = parse_assumptions(assume)
    outcomes = [DECIDED]
    first = True
    for text in expressions(equations):
        try:
            answer = solve(text, var=var, assume=assumptions, limits=chosen)
        except (InputError, LimitExceeded, VerificationFailed) as error:
            print(f"kovacic: {error}", file=sys.stderr)
            outcomes.append(
                BAD_INPUT
                if isinstance(error, InputError)
                else UNDECIDED
                if isinstance(error, LimitExceeded)
                else CHECK_FAILED
            )
            continue
        outcomes.append(UNDECIDED if answer.status is Status.UNDECIDED else DECIDED)
        if as_json:
            print(answer.to_json(full=full), flush=True)
        elif latex:
            print(answer._repr_latex_(), flush=True)
        elif explain:
            print(("" if first else "\n") + answer.explain(), end="", flush=True)
        else:
            from kovacic.views.text import render

            print(("" if first else "\n") + render(answer, style=styled), flush=True)
        first = False
    return max(outcomes, key=_SEVERITY.index)

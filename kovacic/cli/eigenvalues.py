"""`kovacic eigenvalues`: the lowest eigenvalues of a boundary problem as proven numbers."""

from __future__ import annotations

import os
import sys
from collections import deque
from typing import Any

import click

from kovacic.cli import options
from kovacic.cli.main import DECIDED, UNDECIDED
from kovacic.writing.escaped import json_line


@options.equation_command()
@click.argument("equation", metavar="EQUATION")
@click.option(
    "--conditions", metavar="TEXT", help='"y(0)=0, y(1)=0", "y\'(0)=0, y(1)+y\'(1)=0", "y(0)=y(1), y\'(0)=y\'(1)".'
)
@click.option("--parameter", default="lambda", show_default=True, metavar="NAME", help="The name of the eigenvalue.")
@click.option("--from", "start", metavar="A", help="The left end, if the conditions don't name both; -oo for infinity.")
@click.option("--to", "stop", metavar="B", help="The right end.")
@click.option("--count", default=5, show_default=True, type=click.IntRange(min=1), help="How many eigenvalues.")
@click.option("--digits", default=15, show_default=True, type=click.IntRange(min=1), help="Proven digits of each.")
@click.option("--json", "as_json", is_flag=True, help="One line of JSON.")
@options.PARAM
@options.VAR
@options.LIMIT
def eigenvalues(
    equation: str, start: str | None, stop: str | None, count: int, digits: int, as_json: bool, **given: Any
) -> int:
    """The lowest eigenvalues of a boundary problem, each with a proven bound of its error, none left out.

    The equation is linear in the parameter; conditions are homogeneous, at the ends, or periodic.  At a singular end or at
    infinity none is needed.  Without conditions and ends it is a problem on the whole line.  Interrupted, the command prints
    what it has found.

    \b
    kovacic eigenvalues "y'' + lambda*y = 0" --conditions "y(0)=0, y(1)=0"
    kovacic eigenvalues "-y'' + x^4*y = E*y" --parameter E --digits 30
    """
    from kovacic.general_solution.boundary_problems import read_eigenproblem
    from kovacic.limits import Budget

    options.say_reading(equation, given["var"], (given["parameter"], *(given["params"] or ())))
    domain = None if start is None and stop is None else (start or "-oo", stop or "oo")
    budget = Budget(given["limits"])
    with budget.watched():
        problem = read_eigenproblem(equation, domain=domain, **given)
        # `problem.answer` has the levels that were found so far: also after an interruption, or where a limit was reached.
        levels = problem.levels(count, digits)
        try:
            if sys.stderr.isatty() and os.environ.get("TERM") != "dumb":
                with click.progressbar(levels, count, label="levels", show_pos=True, file=sys.stderr) as bar:
                    deque(bar, maxlen=0)
            else:
                deque(levels, maxlen=0)
        finally:
            found = problem.answer()
            if found or problem.search.complete:
                print(json_line({"schema": 1, "input": equation, **found.to_dict()}) if as_json else found)
    return DECIDED if len(found) == count or found.complete else UNDECIDED

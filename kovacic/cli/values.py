"""`kovacic evaluate`, `plot`: values of a solution; `conditions`, `spectrum`, `eigenvalues`: parameters that admit one."""

from __future__ import annotations

import os
import sys
import warnings
from collections import deque
from functools import partial
from pathlib import Path
from typing import Any

import click

from kovacic.cli import options
from kovacic.cli.main import Exit
from kovacic.writing.escaped import json_line


@options.equation_command()
@click.argument("equation", metavar="S")
@click.option("--x0", required=True, metavar="NUMBER", help="Where the solution is given.")
@click.option("--y0", metavar="NUMBER", help="y(x0).")
@click.option("--dy0", metavar="NUMBER", help="y'(x0).")
@click.option("--frobenius", metavar="C1,C2", help="c1 y1 + c2 y2 of the Frobenius basis at x0, instead of y0 and dy0.")
@click.option("--regular", "which", flag_value="regular", help="The solution that is smaller than all others at x0.")
@click.option("--at", "points", required=True, multiple=True, metavar="NUMBERS", help='Where: 1,5/2,0.1,"1+2*I".')
@click.option("--digits", default=15, show_default=True, type=click.IntRange(min=1), help="Proven digits.")
@click.option("--path", type=click.Choice(["above", "below"]), help="The side on which singular points are passed.")
@options.formats(json="One JSON object (schema 1) a line for each point.")
@options.PARAM
@options.VAR
@options.VERBOSE
@options.LIMIT
def evaluate(equation: str, points: tuple[str, ...], frobenius: str | None, form: str, **given: Any) -> None:
    """Values of one solution of y'' = S(x) y, or of an equation with y'' in it, and of its derivative.

    The exact value differs from what is printed by at most the bound after it; that is proven.  Numbers are exact: integers,
    fractions, decimals, constants such as sqrt(2), complex ones.  The path is the straight line from x0.

    \b
    kovacic evaluate "x" --x0 0 --y0 1 --dy0 0 --at 1,2,3 --digits 30
    kovacic evaluate "x^2*y'' + x*y' + x^2*y = 0" --x0 0 --regular --at 1/2,10
    kovacic evaluate "-k*x" --param k=2 --x0 0 --y0 1 --dy0 0 --at 1 --json
    """
    from kovacic.enclosure.evaluate import evaluate
    from kovacic.enclosure.precision import AccuracyWarning

    options.say_reading(equation, given["var"], [*(given["params"] or ())])
    places = [place for text in points for place in _values_in_list(text)]
    basis = None if frobenius is None else _values_in_list(frobenius)
    with (
        options.waiting("computing"),
        warnings.catch_warnings(record=True, action="always", category=AccuracyWarning) as notes,
    ):
        found = evaluate(equation, places, derivative=True, frobenius=basis, **given)
    for place, (y, dy) in zip(places, found, strict=True):
        data = {"schema": 1, "input": equation, "x": place, "y": y.to_dict(), "dy": dy.to_dict()}
        text = f"y({place}) = {y}\ny'({place}) = {dy}"
        print(options.in_form(form, json=partial(json_line, data), others=partial(str, text))())
    for note in notes:
        print(f"kovacic: {note.message}", file=sys.stderr)


def _values_in_list(text: str) -> list[str]:
    """The numbers between commas; those within parentheses, root(2, 3), separate nothing."""
    from kovacic.reading.lexer import scanned
    from kovacic.reading.notations import Tokens

    return [text[part[0].start : part[-1].end] if part else "" for part in Tokens(scanned(text)).split()]


@options.equation_command()
@click.argument("equation", metavar="EQUATION")
@click.option("--from", "start", required=True, metavar="A", help="Left end of the interval (a number or p/q).")
@click.option("--to", "stop", required=True, metavar="B", help="Right end of the interval.")
@click.option("-o", "--output", type=options.PICTURE, required=True, help="The file: png, svg or pdf.")
@click.option(
    "--x0",
    help="Where the initial values are given (default: the left end; without values, the middle of the longest regular "
    "interval).",
)
@click.option("--y0", help="y(x0).  [default: 1]")
@click.option("--dy0", help="y'(x0).  [default: 0]")
@click.option("--points", default=400, show_default=True, type=click.IntRange(2, 100_000), help="Samples at the least.")
@click.option(
    "--digits", default=8, show_default=True, type=click.IntRange(1, 1000), help="Proven digits of each value."
)
@options.PARAM
@options.VAR
@options.LIMIT
def plot(equation: str, start: str, stop: str, output: Path, **given: Any) -> None:
    """Draw the solution of y'' = S(x) y, or of an equation with y'' in it, with y(x0) = y0, y'(x0) = dy0.

    Every sample is the midpoint of an enclosure whose error is proven, and there are some for each oscillation; where these
    are too fine to be drawn, their envelope is.  Singular points on the axis are marked; beyond
    one, the continuation through the upper half-plane is drawn, with its real and imaginary part.

    \b
    kovacic plot "x" --from -12 --to 2 -o airy.png
    kovacic plot "-1/x - 3/(16*x^2)" --from -3 --to 30 -o bessel.png
    kovacic plot "-omega^2*x" --param omega=2 --from -1 --to 5 -o waves.png
    """
    from kovacic.errors import needs

    options.say_reading(equation, given["var"], [*(given["params"] or ())])
    with needs("plot", "a picture"), options.waiting("drawing"):
        from kovacic.views.plot import plot

        plot(equation, start, stop, output=output, **given)
    click.echo(f"wrote {output}")


@options.equation_command()
@click.argument("equation", metavar="S")
@options.formats(
    json="One line of JSON.",
    latex="A LaTeX formula.",
    default="summary",
    format="The theorem as a paper prints it: text; Markdown with formulas between dollar signs; theorem and proof for a LaTeX "
    "document (amsmath, amssymb, amsthm, graphicx); or a page of its own for a browser.",
)
@click.option("--var", metavar="NAME", help="The name of the variable, by default x; all other names are parameters.")
@options.DECLARED
@options.ASSUME
@click.option("--max-degree", default=2, show_default=True, help="The determinants Delta_d are shown up to this d.")
@click.option("--all", "everything", is_flag=True, help="All regions, however many.")
@click.option("--explain", "explained", is_flag=True, help="What each region follows from, and its solutions.")
@click.option("--check", "samples", metavar="N", type=int, help="Solve at N exact points, and compare.")
@options.LIMIT
def conditions(equation: str, form: str, everything: bool, explained: bool, samples: int | None, **given: Any) -> int:
    """The values of the parameters for which y'' = S(x) y has Liouvillian solutions.

    \b
    kovacic conditions "(4*n^2 - 1)/(4*x^2) - 1"
    kovacic conditions --check 200 "x^4 + mu*x"
    kovacic conditions --format latex "x^4 + a*x^2 + b*x + c"
    """
    from kovacic.solution.conditions import conditions

    if form != "summary":
        options.refuse({"everything", "explained"}, "with --json, --latex or --format")
    if explained:
        options.refuse({"everything"}, "with --explain")
    with options.waiting("searching"):
        answer = conditions(equation, **given)
        report = None if samples is None else answer.check(samples)
        shown = options.in_form(
            form,
            json=answer.to_json,
            formula=answer.latex,
            summary=lambda: options.fitted(answer.explain() if explained else answer.text(all=everything)),
            text=lambda: options.fitted(answer.theorem()),
            others=lambda: answer.theorem(format=form),
        )().rstrip("\n")
    print(shown)
    if report is not None:
        stream = sys.stdout if form == "summary" else sys.stderr
        found = "all agree" if report.inside + report.outside else "no point with these properties was found"
        if not report:
            found = f"{len(report.disagreements)} disagree"
        print(f"  checked at {report.inside} points inside and {report.outside} outside: {found}", file=stream)
        if not report:
            return Exit.CHECK_FAILED
    return Exit.DECIDED if answer.within_limits else Exit.UNDECIDED


@options.equation_command()
@click.argument("potential", metavar="V")
@click.option("--from", "start", default="-oo", show_default=True, metavar="A", help="The left end of the domain.")
@click.option("--to", "stop", default="oo", show_default=True, metavar="B", help="The right end.")
@click.option("--energy", default="E", show_default=True, metavar="NAME", help="The name of the energy.")
@click.option("--var", metavar="NAME", help="The name of the variable, by default x; all other names are parameters.")
@options.DECLARED
@options.ASSUME
@click.option(
    "--boundary", metavar="CONDITIONS", help="At finite ends: y'(0) = 0; or friedrichs, the smaller solution at each."
)
@click.option("--max-degree", default=2, show_default=True, help="Quasi-exactly solvable levels up to this degree d.")
@click.option(
    "--plot", "picture", metavar="FILE", help="Draw the potential with its lowest levels to a file (png, pdf, svg)."
)
@click.option("--levels", type=click.IntRange(min=1), metavar="N", help="Also the N lowest levels as proven numbers.")
@click.option("--digits", default=15, show_default=True, type=click.IntRange(min=1), help="Proven digits of these.")
@options.formats(json="One line of JSON.", latex="A LaTeX formula.")
@options.LIMIT
def spectrum(potential: str, start: str, stop: str, form: str, picture: str | None, **given: Any) -> int:
    """The energies E for which -y'' + V y = E y has a square integrable solution.

    \b
    kovacic spectrum "2/x^2 - Z/x" --from 0 --to oo --assume Z=positive
    kovacic spectrum "exp(-2*x) - 2*b*exp(-x)" --assume b=positive
    """
    from kovacic.bound_states.api import spectrum

    with options.waiting("searching"):
        answer = spectrum(potential, domain=(start, stop), **given)
    text = partial(answer.text, shell=True)
    shown = options.in_form(form, json=answer.to_json, formula=answer.latex, others=lambda: options.fitted(text()))
    print(shown())
    if picture is not None:
        answer.plot().savefig(picture)
    return Exit.DECIDED if answer.is_decided or answer.numeric else Exit.UNDECIDED


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
@options.formats(json="One line of JSON.")
@options.PARAM
@options.VAR
@options.LIMIT
def eigenvalues(
    equation: str, start: str | None, stop: str | None, count: int, digits: int, form: str, **given: Any
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
            if found or problem.complete:
                data = {"schema": 1, "input": equation, **found.to_dict()}
                print(options.in_form(form, json=json_line, others=lambda _: found)(data))
    return Exit.DECIDED if len(found) == count or found.complete else Exit.UNDECIDED

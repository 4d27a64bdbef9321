"""`kovacic evaluate`: values of a solution with proven error bounds."""

from __future__ import annotations

import sys

import click

from kovacic.cli.options import EQUATIONS, limit_option, listed, parse_limits, refuse_options


@click.command(context_settings=EQUATIONS)
@click.argument("equation", metavar="S")
@click.option("--x0", required=True, metavar="NUMBER", help="Where the initial values are given.")
@click.option("--y0", required=True, metavar="NUMBER", help="y(x0).")
@click.option("--dy0", required=True, metavar="NUMBER", help="y'(x0).")
@click.option("--at", "points", required=True, multiple=True, metavar="NUMBERS", help="Where, for example 1,5/2,0.1.")
@click.option("--digits", default=15, show_default=True, type=click.IntRange(min=1), help="Proven digits.")
@limit_option
def command(
    equation: str, x0: str, y0: str, dy0: str, points: tuple[str, ...], digits: int, limits: tuple[str, ...]
) -> None:
    """Values of the solution of y'' = S(x) y, or of an equation with y'' in it, with y(x0) = y0 and y'(x0) = dy0.

    The exact value differs from what is printed by at most the bound after it; that is proven.  Numbers are exact: integers,
    fractions, decimals.  The path is the straight line from x0.

    \b
    kovacic evaluate "x" --x0 0 --y0 1 --dy0 0 --at 1,2,3 --digits 30
    kovacic evaluate "x^2*y'' + x*y' + x^2*y = 0" --x0 1 --y0 1 --dy0 0 --at 1/2 --at 10
    """
    from kovacic.enclosure.evaluate import evaluate_states

    refuse_options((equation,))
    places = [place for text in points for place in listed(text)]
    found = evaluate_states(equation, places, x0=x0, y0=y0, dy0=dy0, digits=digits, limits=parse_limits(limits))
    for place, state in zip(places, found, strict=True):
        print(f"y({place}) = {state.y}", flush=True)
        print(f"y'({place}) = {state.dy}", flush=True)
        if state.note is not None:
            print(f"kovacic: at {place}: {state.note}", file=sys.stderr)

"""`kovacic evaluate`: values of a solution with proven error bounds."""

from __future__ import annotations

import sys
import warnings
from typing import Any

import click

from kovacic.cli.options import equation_argument, equation_command, limit_option


@equation_command()
@equation_argument("equation", metavar="S")
@click.option("--x0", required=True, metavar="NUMBER", help="Where the solution is given.")
@click.option("--y0", metavar="NUMBER", help="y(x0).")
@click.option("--dy0", metavar="NUMBER", help="y'(x0).")
@click.option("--frobenius", metavar="C1,C2", help="c1 y1 + c2 y2 of the Frobenius basis at x0, instead of y0 and dy0.")
@click.option("--regular", "which", flag_value="regular", help="The solution that is smaller than all others at x0.")
@click.option("--at", "points", required=True, multiple=True, metavar="NUMBERS", help='Where: 1,5/2,0.1,"1+2*I".')
@click.option("--digits", default=15, show_default=True, type=click.IntRange(min=1), help="Proven digits.")
@click.option("--path", type=click.Choice(["above", "below"]), help="The side on which singular points are passed.")
@limit_option
def command(equation: str, points: tuple[str, ...], frobenius: str | None, **options: Any) -> None:
    """Values of one solution of y'' = S(x) y, or of an equation with y'' in it, and of its derivative.

    The exact value differs from what is printed by at most the bound after it; that is proven.  Numbers are exact: integers,
    fractions, decimals, constants such as sqrt(2), complex ones.  The path is the straight line from x0.

    \b
    kovacic evaluate "x" --x0 0 --y0 1 --dy0 0 --at 1,2,3 --digits 30
    kovacic evaluate "x^2*y'' + x*y' + x^2*y = 0" --x0 0 --regular --at 1/2,10
    """
    from kovacic.enclosure.evaluate import evaluate
    from kovacic.enclosure.precision import AccuracyWarning
    from kovacic.reading.parser import listed

    places = [place for text in points for place in listed(text)]
    basis = None if frobenius is None else listed(frobenius)
    with warnings.catch_warnings(record=True, action="always", category=AccuracyWarning) as notes:
        found = evaluate(equation, places, derivative=True, frobenius=basis, **options)
    for place, (y, dy) in zip(places, found, strict=True):
        print(f"y({place}) = {y}")
        print(f"y'({place}) = {dy}")
    for note in notes:
        print(f"kovacic: {note.message}", file=sys.stderr)

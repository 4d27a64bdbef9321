"""`kovacic plot`: a picture of a solution with proven values."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from kovacic.cli.options import PICTURE, equation_argument, equation_command, limit_option


@equation_command()
@equation_argument("equation", metavar="EQUATION")
@click.option("--from", "start", required=True, metavar="A", help="Left end of the interval (a number or p/q).")
@click.option("--to", "stop", required=True, metavar="B", help="Right end of the interval.")
@click.option("-o", "--output", type=PICTURE, required=True, help="The file: png, svg or pdf.")
@click.option("--x0", help="Where the initial values are given (default: the middle of the longest regular interval).")
@click.option("--y0", default="1", show_default=True, help="y(x0).")
@click.option("--dy0", default="0", show_default=True, help="y'(x0).")
@click.option("--points", default=400, show_default=True, type=click.IntRange(2, 100_000), help="Sample points.")
@click.option(
    "--digits", default=8, show_default=True, type=click.IntRange(1, 1000), help="Proven digits of each value."
)
@limit_option
def command(equation: str, start: str, stop: str, output: Path, **options: Any) -> None:
    """Draw the solution of y'' = S(x) y, or of an equation with y'' in it, with y(x0) = y0, y'(x0) = dy0.

    Every sample is the midpoint of an enclosure whose error is proven.  Singular points on the axis are marked; beyond
    one, the continuation through the upper half-plane is drawn, with its real and imaginary part.

    \b
    kovacic plot "x" --from -12 --to 2 -o airy.png
    kovacic plot "-1/x - 3/(16*x^2)" --from -3 --to 30 -o bessel.png
    """
    from kovacic.errors import needs
    from kovacic.views.plot import plot

    with needs("plot", "a picture"):
        plot(equation, start, stop, title=_title(equation), output=output, **options)
    click.echo(f"wrote {output}")


def _title(equation: str) -> str:
    if "=" in equation:
        return equation
    return f"y'' = {equation} y" if equation.strip().isalnum() else f"y'' = ({equation.strip()}) y"

"""`kovacic plot`: a picture of a solution with proven values."""

from __future__ import annotations

from pathlib import Path

import click


@click.command(
    "plot",
    context_settings={"ignore_unknown_options": True},
    short_help="Draw a solution of y'' = S y over an interval.",
)
@click.argument("S", metavar="S")
@click.option("--from", "start", required=True, help="Left end of the interval (a number or a fraction p/q).")
@click.option("--to", "stop", required=True, help="Right end of the interval.")
@click.option(
    "-o", "--output", type=click.Path(dir_okay=False, path_type=Path), required=True, help="File: png, svg or pdf."
)
@click.option("--x0", default=None, help="Where the initial values are given (default: the middle of the interval).")
@click.option("--y0", default="1", show_default=True, help="y(x0).")
@click.option("--dy0", default="0", show_default=True, help="y'(x0).")
@click.option("--points", default=400, show_default=True, type=click.IntRange(2, 100_000), help="Sample points.")
@click.option(
    "--digits", default=8, show_default=True, type=click.IntRange(1, 1000), help="Proven digits of each value."
)
def plot_command(
    s: str, start: str, stop: str, output: Path, x0: str | None, y0: str, dy0: str, points: int, digits: int
) -> None:
    """Draw the solution of y'' = S y with the initial values y(x0) = y0, y'(x0) = dy0.

    Every sample is the midpoint of an enclosure whose error is proven.  Singular points on the axis are marked; beyond
    one, the continuation through the upper half-plane is drawn, with its real and imaginary part.
    """
    from kovacic.errors import KovacicError
    from kovacic.numeric.plot import plot

    if output.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise click.BadParameter(f"{output.suffix or 'no suffix'} isn't one of .png, .svg, .pdf", param_hint="--output")
    try:
        plot(s, start, stop, x0=x0, y0=y0, dy0=dy0, points=points, digits=digits, title=f"y'' = ({s}) y", output=output)
    except KovacicError as error:
        raise click.ClickException(str(error)) from error
    except ModuleNotFoundError as error:
        raise click.ClickException(f"plots need matplotlib: pip install kovacic[plot] ({error})") from error
    click.echo(f"wrote {output}")

"""The pictures of the gallery: `python docs/pictures.py FOLDER` draws those that aren't there yet."""

from __future__ import annotations

import contextlib
import io
import json
import sys
from collections.abc import Callable
from pathlib import Path

import sympy
from matplotlib.figure import Figure

import kovacic
from kovacic.cli.main import run

ROOT = Path(__file__).parent.parent


def airy(path: Path) -> None:
    """No closed form, but proven values."""
    kovacic.solve("x").plot(-14, 2, x0=0, y0=1, dy0=0, output=path, title="y'' = x y, y(0) = 1, y'(0) = 0")


def bessel(path: Path) -> None:
    """A singular point on the way."""
    kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0").plot(
        "1/8", 25, x0=1, y0=1, dy0=0, output=path, title="Bessel's equation of order 1/2"
    )


def oscillator(path: Path) -> None:
    """The first bound states of the harmonic oscillator."""
    figure = Figure(figsize=(8, 4.8), layout="constrained")
    axes = figure.add_subplot()
    xs = [k / 40 for k in range(-180, 181)]
    for E in (1, 3, 5, 7):
        y1 = kovacic.solve(f"x^2 - {E}").solutions[0]
        y = sympy.lambdify("x", y1, "math")
        scale = max(abs(y(x)) for x in xs)
        axes.plot(xs, [E + 0.9 * y(x) / scale for x in xs], label=f"E = {E}: {y1}")
    axes.plot(xs, [x * x for x in xs], color="0.8", zorder=0)
    axes.set_ylim(0, 9)
    axes.set_xlabel("x")
    axes.set_ylabel("E")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


def whittaker(path: Path) -> None:
    """For which kappa and mu is Whittaker's equation solvable?"""
    S = "1/4 - k/x + (4*m^2-1)/(4*x^2)"
    run(
        [
            "scan",
            S,
            "k=-3:3:1/4",
            "m=0:3:1/4",
            "--no-group",
            "--quiet",
            "--format",
            "csv",
            "--map",
            str(path),
            "-o",
            str(path.with_suffix(".csv")),
        ]
    )
    path.with_suffix(".csv").unlink()


def ball(path: Path) -> None:
    """A ball that rolls on a sphere."""
    body = ["--mass", "1", "--radius", "1", "--offset", "1/5", "--A1", "1/4", "--A3", "1/3", "--sphere", "3"]
    with contextlib.redirect_stdout(io.StringIO()):
        run(["ball", *body, "--simulate", "--time", "40", "--plot", str(path)])


def poles(path: Path) -> None:
    """Time against the number of poles, from the figures of `benchmarks/engine.py`."""
    measured = json.loads((ROOT / "benchmarks" / "results" / "engine.json").read_text(encoding="utf-8"))
    figure = Figure(figsize=(8, 4.8), layout="constrained")
    axes = figure.add_subplot()
    for series in measured["series"]:
        if series["kind"] == "poles":
            points = series["measurements"]
            axes.loglog([p["poles"] for p in points], [p["total"] for p in points], marker="o", label=series["name"])
    axes.set_xlabel("poles of S")
    axes.set_ylabel("seconds, verification included")
    axes.legend(frameon=False, fontsize="small")
    figure.savefig(path, dpi=110)


PICTURES: dict[str, Callable[[Path], None]] = {
    "airy.png": airy,
    "bessel.png": bessel,
    "oscillator.png": oscillator,
    "whittaker.png": whittaker,
    "ball.png": ball,
    "poles.png": poles,
}


def draw_all(folder: Path) -> None:
    """Draw what isn't in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in PICTURES.items():
        if not (folder / name).exists():
            draw(folder / name)


if __name__ == "__main__":
    draw_all(Path(sys.argv[1] if len(sys.argv) > 1 else "pictures"))

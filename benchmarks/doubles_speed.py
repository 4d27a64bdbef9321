"""Speed and error of NumPy functions: `lambdify` beside scipy.special and SymPy's lambdify, on 10^5 points in one process.

Regenerate:  python benchmarks/doubles_speed.py      writes results/doubles_speed.{json,md}      (`--quick` prints only)

Processor time of building with its check and of one call, the best of nine; errors in units in the last place at 24 points,
median / worst, measured for all in the same way.  SciPy's and SymPy's functions are multiplied by what makes them solutions of
the equation.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import frame
import numpy as np
import scipy
import scipy.special as special
import sympy

import kovacic
from kovacic.doubles.lambdify import lambdify, measure

POINTS = 100_000
X = sympy.Symbol("x")


@dataclass(frozen=True)
class Row:
    """One solution: `start` for initial values, None for the one that the certificate gives."""

    name: str
    equation: str
    interval: tuple[float, float]
    scipy: Callable[[Any], Any]
    sympy: Any
    start: dict[str, Any] | None = None


@dataclass(frozen=True)
class Other:
    """A function in place of one of `lambdify`, to be measured like it."""

    region: Any
    base: Any
    function: Callable[[Any], Any]

    def __call__(self, x: Any) -> Any:
        return self.function(x)


def rows() -> list[Row]:
    found = []
    for n in (2, 50):
        hermite = sympy.hermite(n, X)
        polynomial = f"y'' - 2*x*y' + {2 * n}*y = 0"
        found.append(Row(f"Hermite {n}", polynomial, (-9, 9), lambda x, n=n: special.eval_hermite(n, x), hermite))
        found.append(
            Row(
                f"Hermite {n} exp(-x^2/2)",
                f"x^2 - {2 * n + 1}",
                (-9, 9),
                lambda x, n=n: special.eval_hermite(n, x) * np.exp(-x * x / 2),
                hermite * sympy.exp(-(X**2) / 2),
            )
        )
    for n in (10, 60):
        equation = f"(1-x^2)*y'' - 2*x*y' + {n * (n + 1)}*y = 0"
        found.append(
            Row(
                f"Legendre {n}",
                equation,
                (-1, 1),
                lambda x, n=n: special.eval_legendre(n, x),
                sympy.legendre(n, X),
            )
        )
    bessel = "x^2*y'' + 2*x*y' + (x^2 - 30)*y = 0"
    first, second = sympy.expand_func(sympy.jn(5, X)), sympy.expand_func(sympy.yn(5, X))
    found.append(
        Row(
            "spherical Hankel 5",
            bessel,
            (2, 60),
            lambda x: special.spherical_jn(5, x) + 1j * special.spherical_yn(5, x),
            first + sympy.I * second,
        )
    )
    value, slope = first.subs(X, 2), sympy.diff(first, X).subs(X, 2)
    start = {"x0": 2, "y0": str(sympy.N(value, 60)), "dy0": str(sympy.N(slope, 60))}
    found.append(
        Row("spherical Bessel 5", bessel, (2, 60), lambda x: special.spherical_jn(5, x), first, start),
    )
    airy = {"x0": 0, "which": "decaying", "y0": str(sympy.N(sympy.airyai(0), 60))}
    found.append(Row("Airy", "x", (-30, 2), lambda x: special.airy(x)[0], None, airy))
    return found


def seconds(function: Callable[[Any], Any], points: Any) -> float:
    best = np.inf
    for _ in range(9):
        begin = time.process_time()
        function(points)
        best = min(best, time.process_time() - begin)
    return float(best)


def compare(row: Row) -> dict[str, Any]:
    """Times in ms and errors; the errors of the solution that conjugates swap are those of the conjugate."""
    solution = kovacic.solve(row.equation)
    points = np.linspace(*row.interval, POINTS + 2)[1:-1]
    options: dict[str, Any] = row.start or {}
    begin = time.process_time()
    ours = lambdify(solution, interval=row.interval, **options)
    result: dict[str, Any] = {"name": row.name, "build": time.process_time() - begin, "careful": ours.careful}
    base = ours.base
    functions = {"kovacic": ours, "scipy": row.scipy}
    functions["double-doubles"] = lambdify(solution, interval=row.interval, careful=True, check=False, **options)
    if row.sympy is not None:
        functions["sympy"] = sympy.lambdify(X, row.sympy, "numpy")
    for name, function in functions.items():
        result[name] = {"ms": 1e3 * seconds(function, points)}
        errors = []
        for f in (function, lambda x, f=function: np.conj(f(x))):
            other = Other(ours.region, base, f)
            errors.append(measure(other, solution, start=row.start))  # type: ignore[arg-type]
            if not np.iscomplexobj(f(points[:1])):
                break
        best = min(errors, key=lambda e: e.median)
        result[name] |= {"median": best.median, "worst": best.worst}
    return result


def markdown(found: list[dict[str, Any]]) -> str:
    versions = frame.line(NumPy=np.__version__, SciPy=scipy.__version__, SymPy=sympy.__version__)
    lines = [
        "# NumPy functions",
        "",
        f"{versions}  {POINTS:,} points.  Regenerate: `python benchmarks/doubles_speed.py`.",
        "",
        "Processor time in ms of one call, and errors in units in the last place, median / worst of 24 points.",
        "",
        "| solution | lambdify | error | build (s) | double-doubles | error | scipy.special | error | sympy.lambdify | error |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in found:
        cells = [row["name"]]
        for name in ("kovacic", "double-doubles", "scipy", "sympy"):
            part = row.get(name)
            cells += [f"{part['ms']:.2g}", f"{part['median']:.2g} / {part['worst']:.2g}"] if part else ["", ""]
            if name == "kovacic":
                cells.append(f"{row['build']:.3f}")
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="print the table, write nothing")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    with np.errstate(all="ignore"):
        found = [compare(row) for row in rows()]
    text = markdown(found)
    print(text)
    if not options.quick:
        frame.save("doubles_speed", found, text)


if __name__ == "__main__":
    main()

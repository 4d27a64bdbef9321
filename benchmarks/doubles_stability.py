"""Stability: what is left of the digits under stress, by enclosures and in double precision, against a naive evaluation.

Regenerate:  python benchmarks/doubles_stability.py      writes results/doubles_stability.{json,md}      (`--quick` prints only)

Every solution is known in closed form.  Two tables:

- enclosures: the Taylor route, which knows nothing of the closed form, against mpmath at 160 digits and more (the reference).
  "right" says that the reference lies in the ball.  "naive" is SymPy's lambdify of the known closed form with NumPy.
- double precision: careful `lambdify` on 24 points of each row, in units in the last place against 50 digits; and SymPy's
  lambdify of the same solution (polynomials expanded) measured in the same way.
"""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import frame
from stability_families import Row, expression, families, number, reference

DIGITS = 30
SECONDS = 60


def quietly(action: Callable[[], Any]) -> Any:
    import numpy as np

    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        return action()


def enclosure(row: Row) -> dict[str, Any]:
    """Route (b) at x, against the reference."""
    import mpmath

    from kovacic.enclosure.points import ExactPoint
    from kovacic.enclosure.states import evaluate_states
    from kovacic.errors import KovacicError
    from kovacic.limits import Limits

    large = {"large exponent": 400, "recessive": 700}
    with mpmath.workdps(160 + large.get(row.family, 0)):
        start, end = number(row.x0), number(row.x)
        y0, dy0 = reference(row.y, start)
        exact, _ = reference(row.y, end)
        begin = time.perf_counter()
        try:
            (state,) = evaluate_states(
                row.S,
                [ExactPoint(end)],
                x0=ExactPoint(start),
                y0=y0,
                dy0=dy0,
                digits=DIGITS,
                limits=Limits(seconds=SECONDS),
            )
        except KovacicError as error:
            return {
                "obtained": None,
                "right": None,
                "note": str(error).splitlines()[0],
                "seconds": time.perf_counter() - begin,
            }
        seconds = time.perf_counter() - begin
        parts = [mpmath.mpf(p.numerator) / p.denominator for p in state.y.midpoint]
        radius = mpmath.mpf(state.y.rad[0]) * mpmath.mpf(2) ** state.y.rad[1]
        right = abs(mpmath.mpc(*parts) - exact) <= radius + abs(exact) * mpmath.mpf(10) ** -120
        found = quietly(lambda: naive(row)(float(end)))
        return {
            "requested": DIGITS,
            "obtained": round(state.y.digits, 1),
            "right": bool(right),
            "note": state.note,
            "seconds": seconds,
            "naive": round(min(digits_of(found, exact), 16.0), 1),
        }


def naive(row: Row) -> Callable[[Any], Any]:
    import sympy

    formula, symbol = expression(row.y)
    compiled = sympy.lambdify(symbol, formula, "numpy")

    def value(x: Any) -> Any:
        try:
            return compiled(x)
        except (OverflowError, TypeError, RecursionError):  # integers beyond the range of doubles
            return math.nan * x

    return value


def digits_of(value: Any, exact: Any) -> float:
    import mpmath

    if not mpmath.isfinite(value):
        return 0.0
    error = abs(mpmath.mpmathify(complex(value)) - exact) / abs(exact)
    return 40.0 if error == 0 else max(0.0, float(-mpmath.log10(error)))


@dataclass(frozen=True)
class Plain:
    """A function in place of one of `lambdify`, to be measured like it."""

    region: Any
    base: Any
    function: Callable[[Any], Any]

    def __call__(self, x: Any) -> Any:
        return quietly(lambda: self.function(x))


def doubles(row: Row) -> dict[str, Any]:
    """The errors of `lambdify` and of the naive evaluation in units in the last place, and the warning if there is one."""
    import numpy as np

    import kovacic
    from kovacic.doubles.lambdify import measure
    from kovacic.errors import KovacicError
    from kovacic.limits import Limits

    solution, points = kovacic.solve(row.S), np.array(row.points)
    which = number_of(solution, row)
    begin = time.perf_counter()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        function = solution.lambdify(interval=row.interval, which=which, careful=True)
    build = time.perf_counter() - begin
    many = np.resize(points, 1000)
    function(many)
    begin = time.perf_counter()
    function(many)
    per_point = (time.perf_counter() - begin) / 1000
    result: dict[str, Any] = {
        "arrangement": type(function).__name__,
        "warning": str(caught[0].message) if caught else None,
        "build_seconds": build,
        "seconds_per_point": per_point,
    }
    others = {"": function, "naive_": Plain(function.region, function.base, naive(row))}
    if row.y.startswith("chebyshev"):
        others["product_"] = product_of_zeros(function, int(row.y.split()[1]))
    for name, candidate in others.items():
        try:
            found = measure(candidate, solution, points, which=which, limits=Limits(seconds=SECONDS))
            result |= {f"{name}median": found.median, f"{name}worst": found.worst, f"{name}points": found.points}
        except KovacicError as error:
            result[f"{name}note"] = str(error).splitlines()[0]
    return result


def number_of(solution: Any, row: Row) -> int:
    """The number of the solution y, by its logarithmic derivative at the middle of the points."""
    import mpmath

    from kovacic.enclosure.closed_form import exponential_solutions, omega
    from kovacic.enclosure.points import as_point
    from kovacic.enclosure.problem import as_problem

    x, problem = row.points[7], as_problem(solution)
    with mpmath.workdps(60):
        value, slope = reference(row.y, Fraction(x))
        wanted = complex(slope / value)
    found = [complex(omega(problem, k, as_point(x, "x"), 60)) for k in range(len(exponential_solutions(problem)))]
    return min(range(len(found)), key=lambda k: abs(found[k] - wanted))


def product_of_zeros(function: Any, k: int) -> Any:
    """(1 - x^2)^(1/4) T_k(x) as a product over its zeros cos((2j - 1) pi/(2k))."""
    from flint import arb, ctx

    from kovacic.doubles.double_double import Complex, Pair
    from kovacic.doubles.product_form import ProductForm, RationalFunction, RootFactor

    one, quarter = Complex(Pair(1.0)), Complex(Pair(0.25))
    with ctx.workprec(200):
        zeros = [Pair.of((arb.pi() * (2 * j - 1) / (2 * k)).cos()) for j in range(1, k + 1)]
        scale = Pair.of(arb(2).log() * (k - 1))  # T_k = 2^(k-1) x^k + ...
    factors = [RootFactor(Complex(z), one, one, False) for z in zeros]
    factors += [RootFactor(Complex(Pair(z)), quarter, one, False) for z in (1.0, -1.0)]
    constant = RationalFunction((Complex(scale),))
    return ProductForm(function.region, function.base, tuple(factors), constant, is_real=True)


def markdown(rows: list[dict[str, Any]]) -> str:
    lines = [
        "# Stability",
        "",
        f"{frame.line()}  Regenerate: `python benchmarks/doubles_stability.py`.",
        "",
        "## Enclosures",
        "",
        f"Taylor route, {DIGITS} digits requested.  *lost*: of about 16 digits, by SymPy's lambdify of the closed form.",
        "",
        "| family | parameter | obtained | right | lost | seconds |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        e = row["enclosure"]
        if e["obtained"] is None:
            lines.append(f"| {row['family']} | {row['parameter']} | {e['note']} | | | {e['seconds']:.2f} |")
            continue
        right = "yes" if e["right"] else "NO"
        lost = 16 - e["naive"]
        lines.append(
            f"| {row['family']} | {row['parameter']} | {e['obtained']:.1f} | {right} | {lost:.1f} | {e['seconds']:.3f} |"
        )
    lines += [
        "",
        "## Double precision",
        "",
        "Errors in units in the last place against the Taylor route at 50 digits: median / worst of 24 points.",
        "*naive*: SymPy's lambdify of the same solution, polynomials expanded.",
        "*zeros*: the polynomial as a product over its known zeros.",
        "",
        "| family | parameter | arrangement | median / worst | naive | zeros | warning | µs per point |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in (row for row in rows if row["double"]):
        d = row["double"]
        cells = [units(d, ""), units(d, "naive_"), units(d, "product_")]
        lines.append(
            f"| {row['family']} | {row['parameter']} | {d['arrangement']} | {' | '.join(cells)} | {d['warning'] or ''} "
            f"| {1e6 * d['seconds_per_point']:.1f} |"
        )
    lines += ["", "By family: median of the medians / worst.", "", "| family | lambdify | naive |", "|---|---|---|"]
    for family in dict.fromkeys(row["family"] for row in rows):
        own = [row["double"] for row in rows if row["family"] == family and row["double"]]
        cells = []
        for name in ("", "naive_"):
            medians = sorted(d[f"{name}median"] for d in own if f"{name}median" in d)
            worst = max((d[f"{name}worst"] for d in own if f"{name}worst" in d), default=math.nan)
            cells.append(f"{medians[len(medians) // 2]:.2g} / {worst:.2g}" if medians else "")
        lines.append(f"| {family} | {cells[0]} | {cells[1]} |")
    return "\n".join(lines) + "\n"


def units(row: dict[str, Any], name: str) -> str:
    if f"{name}median" in row:
        return f"{row[f'{name}median']:.2g} / {row[f'{name}worst']:.2g}"
    return str(row.get(f"{name}note", ""))


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="print the table, write nothing")
    parser.add_argument("--family", help="this family only (implies --quick)")
    options = parser.parse_args()
    rows = []
    for row in families():
        if options.family in (None, row.family):
            rows.append(
                {
                    "family": row.family,
                    "parameter": row.parameter,
                    "enclosure": enclosure(row),
                    "double": doubles(row) if row.points else None,
                }
            )
            print(rows[-1], flush=True)
    text = markdown(rows)
    print(text)
    if not options.quick and options.family is None:
        frame.save("doubles_stability", rows, text)


if __name__ == "__main__":
    main()

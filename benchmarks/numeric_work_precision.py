"""Run time against error: our routes, scipy's integrators and mpmath.odefun.

Regenerate:  python benchmarks/numeric_work_precision.py
writes results/numeric_work_precision.{json,md,png}.  Errors are relative, against the Taylor route at twice the
digits (at least
50).  Times are the best of several runs; "double" rows are per point of a vectorised call on 1,000 points, all others
per call from x0 to x.
"""

from __future__ import annotations

import json
import math
import platform
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"

# name, S, x0, x: y(x0) = 1, y'(x0) = 0
PROBLEMS = [
    ("Airy", "x", "0", "5"),
    ("Bessel, order 21/2", "-1 + 110/x^2", "12", "40"),
    ("Bessel, order 101/2", "-1 + 2550/x^2", "55", "90"),
    ("Legendre, degree 100", "-(10100*(1-x^2) + 1)/(1-x^2)^2", "0", "9/10"),
    ("Legendre, degree 500", "-(250500*(1-x^2) + 1)/(1-x^2)^2", "0", "9/10"),
    ("Hermite, degree 50", "x^2 - 101", "0", "8"),
    ("Hermite, degree 500", "x^2 - 1001", "0", "20"),
    ("exp(x^2/2), growing", "x^2 + 1", "0", "8"),
    ("exp(-x^2/2), recessive", "x^2 - 1", "0", "6"),
    ("irregular at 0", "1/x^4", "1/10", "2"),
    ("tetrahedral", "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)", "2", "9"),
    ("octahedral", "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)", "2", "9"),
    ("icosahedral", "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)", "2", "9"),
    *[(f"ball, k = {k}", k, "-9/10", "9/10") for k in ("1/2", "3/2", "1/3", "10", "577/408")],
]


def ball_normal_form(k: str) -> Any:
    """y1 y2 = sqrt(D), w^2 = k^2 (lc D): S from phi = D'/(2 D) and w^2 = f^2 (4 S - 2 phi' - phi^2), D = 5 + 2 x -
    x^2/2."""
    from kovacic.algebra.fields import QQ
    from kovacic.algebra.ratfunc import RatFunc

    D = RatFunc(QQ.poly([5, 2, Fraction(1, 2)]))
    phi = D.derivative() / (2 * D)
    w2 = Fraction(k) ** 2 * 2
    return (RatFunc(QQ.poly([w2])) / D + 2 * phi.derivative() + phi * phi) / 4


def best(action: Callable[[], Any], seconds: float = 0.15) -> tuple[float, Any]:
    """Best time of repeated runs (at least one), and the last result."""
    times, begin = [], time.perf_counter()
    while True:
        start = time.perf_counter()
        result = action()
        times.append(time.perf_counter() - start)
        if time.perf_counter() - begin > seconds or len(times) >= 20:
            return min(times), result


def relative(value: Any, exact: Fraction) -> float:
    """log10 of the relative error (a double can't hold errors of 1e-1000), at least -2200."""
    error = abs(Fraction(value) - exact) / abs(exact)
    if error == 0:
        return -2200.0
    return (error.numerator.bit_length() - error.denominator.bit_length()) * math.log10(2)


def rows_of(name: str, S: Any, x0: str, x: str) -> list[dict[str, Any]]:
    import mpmath
    import numpy as np
    from scipy.integrate import solve_ivp

    import kovacic
    from kovacic.errors import LimitExceeded
    from kovacic.io.read import read_input
    from kovacic.limits import Limits
    from kovacic.numeric.evaluate import evaluate, evaluate_states

    rows: list[dict[str, Any]] = []
    S = read_input(S).S
    initial = {"x0": x0, "y0": 1, "dy0": 0}
    exact = evaluate(S, x, **initial, digits=100).midpoint[0]

    def add(method: str, digits: float, seconds: float, error: float | None) -> None:
        rows.append({"problem": name, "method": method, "digits": digits, "seconds": seconds, "log10_error": error})

    for digits in (15, 50, 500, 1000):
        seconds, ball = best(partial(evaluate, S, x, **initial, digits=digits))
        reference = exact if digits <= 50 else evaluate(S, x, **initial, digits=2 * digits).midpoint[0]
        add("Taylor route", digits, seconds, relative(ball.midpoint[0], reference))
    solution = kovacic.solve(S)
    degree = solution.semi_invariant.P.degree if solution.semi_invariant else 0
    if degree > 300 and name.startswith("Hermite"):
        print("   the closed form is left out: isolating the zeros of its polynomial takes a minute")
        solution = kovacic.solve("x")
    if solution.case is not None:
        for digits in (15, 50, 500):
            try:
                seconds, (state,) = best(
                    partial(
                        evaluate_states,
                        solution,
                        [x],
                        **initial,
                        digits=digits,
                        method="closed form",
                        limits=Limits(seconds=5),
                    )
                )
            except LimitExceeded:
                add("closed form, enclosure (given up)", digits, 5.0, None)
                break
            add(
                "closed form, enclosure",
                digits,
                seconds,
                relative(state.y.midpoint[0], exact) if digits < 100 else None,
            )
    if solution.case == 1:
        try:
            add(*double_row(solution, x0, x))
        except kovacic.InputError as error:
            print("   no double-precision closed form:", error)
    num = [float(c) for c in reversed(S.num.coefficients())]
    den = [float(c) for c in reversed(S.den.coefficients())]

    def field(t: float, y: Any) -> Any:
        if time.perf_counter() > deadline:
            raise TimeoutError
        return [y[1], np.polyval(num, t) / np.polyval(den, t) * y[0]]

    span = (float(Fraction(x0)), float(Fraction(x)))
    for method in ("DOP853", "Radau", "LSODA"):
        for tolerance in (1e-6, 1e-9, 1e-12):
            if method == "Radau" and tolerance < 1e-9:
                continue
            deadline = time.perf_counter() + 5.0  # an integrator may crawl along a recessive solution
            try:
                seconds, answer = best(
                    partial(solve_ivp, field, span, [1.0, 0.0], method=method, rtol=tolerance, atol=tolerance * 1e-3),
                    0.1,
                )
            except TimeoutError:
                add(f"{method} (given up)", tolerance, 5.0, None)
                continue
            add(method, tolerance, seconds, relative(float(answer.y[0, -1]), exact) if answer.success else None)
    with mpmath.workdps(50):
        numerator = [mpmath.mpf(c.numerator) / c.denominator for c in reversed(S.num.coefficients())]
        denominator = [mpmath.mpf(c.numerator) / c.denominator for c in reversed(S.den.coefficients())]

        def slope(t: Any, y: Any) -> list[Any]:
            return [y[1], mpmath.polyval(numerator, t) / mpmath.polyval(denominator, t) * y[0]]

        ends = [mpmath.mpf(v.numerator) / v.denominator for v in (Fraction(x0), Fraction(x))]
        start = time.perf_counter()
        if name in ("Airy", "tetrahedral", "exp(x^2/2), growing", "ball, k = 1/2"):
            value = mpmath.odefun(slope, ends[0], [1, 0])(ends[1])[0]
            seconds = time.perf_counter() - start
            sign, man, exp, _ = value._mpf_
            add("mpmath.odefun", 50, seconds, relative((-1) ** sign * man * Fraction(2) ** exp, exact))
    return rows


def double_row(solution: Any, x0: str, x: str) -> tuple[str, float, float, float]:
    import warnings

    import numpy as np

    from kovacic.numeric.accuracy import measure
    from kovacic.numeric.lambdify import lambdify

    low, high = sorted((float(Fraction(x0)), float(Fraction(x))))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        function = lambdify(solution, interval=(low - 1e-3, high + 1e-3), check=False)
        points = np.linspace(low, high, 1000)
        seconds, _ = best(lambda: function(points))
        median, worst, _ = measure(function, solution)
    print(f"   double precision: median {median:.2g}, worst {worst:.2g} units in the last place")
    return "closed form, double", 16, seconds / 1000, math.log10(max(worst, 0.5) * 2.0**-53)


def markdown(rows: list[dict[str, Any]]) -> str:
    lines = [
        "# Run time against error",
        "",
        f"Python {platform.python_version()}, {platform.machine()}.",
        "Regenerate: `python benchmarks/numeric_work_precision.py`.",
        "",
        "Errors are relative, against the Taylor route at twice the digits.  *digits*: digits asked for, or the tolerance.",
        "The closed form in double precision is timed per point of a vectorised call; its error is the worst of 24 points.",
        "",
        "| problem | method | digits | seconds | error |",
        "|---|---|---|---|---|",
    ]
    for row in rows:
        error = "" if row["log10_error"] is None else f"1e{row['log10_error']:.0f}"
        lines.append(f"| {row['problem']} | {row['method']} | {row['digits']:g} | {row['seconds']:.2e} | {error} |")
    return "\n".join(lines) + "\n"


def picture(rows: list[dict[str, Any]], target: Path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    names = list(dict.fromkeys(row["problem"] for row in rows))
    columns = 3
    lines = -(-len(names) // columns)
    figure = Figure(figsize=(13, 3.1 * lines), layout="constrained")
    FigureCanvasAgg(figure)
    methods = list(dict.fromkeys(row["method"] for row in rows))
    handles = {}
    for index, name in enumerate(names):
        axes = figure.add_subplot(lines, columns, index + 1)
        for number, method in enumerate(methods):
            own = [r for r in rows if r["problem"] == name and r["method"] == method and r["log10_error"] is not None]
            if own:
                (handles[method],) = axes.loglog(
                    [max(-r["log10_error"], 1.0) for r in own],
                    [r["seconds"] for r in own],
                    "o-",
                    color=f"C{number}",
                    markersize=4,
                )
        axes.set_title(name, fontsize=10)
        axes.set_xlabel("correct digits (1 or fewer: at 1)", fontsize=8)
        axes.set_ylabel("seconds", fontsize=8)
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncol=4)
    figure.savefig(target, dpi=110)


def main() -> None:
    rows: list[dict[str, Any]] = []
    for name, S, x0, x in PROBLEMS:
        print(name, flush=True)
        rows += rows_of(name, ball_normal_form(S) if name.startswith("ball") else S, x0, x)
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "numeric_work_precision.json").write_text(json.dumps(rows, indent=1) + "\n")
    (RESULTS / "numeric_work_precision.md").write_text(markdown(rows))
    picture(rows, RESULTS / "numeric_work_precision.png")


if __name__ == "__main__":
    main()

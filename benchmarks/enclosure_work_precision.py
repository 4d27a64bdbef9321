"""Run time against error: our routes, scipy's integrators and mpmath.odefun.

Regenerate:  python benchmarks/enclosure_work_precision.py
writes results/enclosure_work_precision.{json,md,png} (about eight minutes).  Errors are relative, against the Taylor route
at twice the digits; times are processor times, the best of several runs, of one call from x0 to x.  Thousands of digits:
`enclosure_long_series.py`.
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
DIGITS = (15, 50, 500, 1000)
PATIENCE = 3.0
"""Seconds for one run of an integrator; twice as many for mpmath.odefun."""

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
    """y1 y2 = sqrt(D), w^2 = 2 k^2: S from phi = D'/(2 D) and w^2 = f^2 (4 S - 2 phi' - phi^2), D = 5 + 2 x + x^2/2."""
    from kovacic.algebra.ratfunc import RatFunc
    from kovacic.algebra.rationals import QQ

    D = RatFunc(QQ.poly([5, 2, Fraction(1, 2)]))
    phi = D.derivative() / (2 * D)
    w2 = Fraction(k) ** 2 * 2
    return (RatFunc(QQ.poly([w2])) / D + 2 * phi.derivative() + phi * phi) / 4


def best(action: Callable[[], Any], seconds: float = 0.15) -> tuple[float, Any]:
    """Least processor time of repeated runs (at least one), and the last result."""
    times, begin = [], time.process_time()
    while True:
        start = time.process_time()
        result = action()
        times.append(time.process_time() - start)
        if time.process_time() - begin > seconds or len(times) >= 20:
            return min(times), result


def relative(value: Any, exact: Fraction) -> float:
    """log10 of the relative error (a double can't hold errors of 1e-1000), at least -2200."""
    error = abs(Fraction(value) - exact) / abs(exact)
    if error == 0:
        return -2200.0
    return (error.numerator.bit_length() - error.denominator.bit_length()) * math.log10(2)


def rows_of(name: str, S: Any, x0: str, x: str) -> list[dict[str, Any]]:
    import kovacic
    from kovacic.enclosure.evaluate import evaluate, evaluate_states
    from kovacic.reading.read import read_input

    rows: list[dict[str, Any]] = []
    S = read_input(S).S
    initial = {"x0": x0, "y0": 1, "dy0": 0}
    references = {
        d: evaluate(S, x, **initial, digits=2 * d).midpoint[0] for d in DIGITS
    }  # S has no certificate: the Taylor route

    def add(method: str, digits: float, seconds: float, error: float | None) -> None:
        rows.append({"problem": name, "method": method, "digits": digits, "seconds": seconds, "log10_error": error})

    for digits in DIGITS:
        seconds, ball = best(partial(evaluate, S, x, **initial, digits=digits))
        add("Taylor route", digits, seconds, relative(ball.midpoint[0], references[digits]))
    solution = kovacic.solve(S)
    if solution.case is not None:
        for digits in DIGITS if solution.case == 1 else ():
            call = partial(evaluate_states, solution, [x], **initial, digits=digits, method="closed form")
            seconds, (state,) = best(call)
            add("closed form, enclosure", digits, seconds, relative(state.y.midpoint[0], references[digits]))
        double_rows(solution, x0, x, add)
    peers(S, x0, x, references[50], add)
    return rows


def double_rows(solution: Any, x0: str, x: str, add: Callable[..., None]) -> None:
    """The closed form in double precision: its time for one point, and per point of a call with 1,000 points."""
    import warnings

    import numpy as np

    from kovacic.doubles.lambdify import lambdify, measure
    from kovacic.errors import KovacicError

    low, high = sorted((float(Fraction(x0)), float(Fraction(x))))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            function = lambdify(solution, interval=(low - 1e-3, high + 1e-3), check=False)
            worst = measure(function, solution).worst
    except KovacicError as error:
        print("   no double-precision closed form:", error)
        return
    points = np.linspace(low, high, 1000)
    error = math.log10(max(worst, 0.5) * 2.0**-53)
    add("closed form, double, one point", 16, best(lambda: function(points[:1]))[0], error)
    add("closed form, double, per point of 1,000", 16, best(lambda: function(points))[0] / 1000, error)


def peers(S: Any, x0: str, x: str, exact: Fraction, add: Callable[..., None]) -> None:
    """scipy's integrators and mpmath.odefun, each for a limited time: an integrator may crawl along a recessive solution."""
    import mpmath
    import numpy as np
    from scipy.integrate import solve_ivp

    num = [float(c) for c in reversed(S.num.coefficients())]
    den = [float(c) for c in reversed(S.den.coefficients())]

    def field(t: float, y: Any) -> Any:
        if time.process_time() > deadline:
            raise TimeoutError
        return [y[1], np.polyval(num, t) / np.polyval(den, t) * y[0]]

    span = (float(Fraction(x0)), float(Fraction(x)))
    for method, tolerances in (
        ("DOP853", (1e-6, 1e-9, 1e-12)),
        ("Radau", (1e-6, 1e-9)),
        ("LSODA", (1e-6, 1e-9, 1e-12)),
    ):
        for tolerance in tolerances:
            deadline = time.process_time() + PATIENCE
            call = partial(solve_ivp, field, span, [1.0, 0.0], method=method, rtol=tolerance, atol=tolerance * 1e-3)
            try:
                seconds, answer = best(call, 0.1)
            except TimeoutError:
                add(f"{method} (given up)", tolerance, PATIENCE, None)
                continue
            add(method, tolerance, seconds, relative(float(answer.y[0, -1]), exact) if answer.success else None)
    with mpmath.workdps(50):
        numerator = [mpmath.mpf(c.numerator) / c.denominator for c in reversed(S.num.coefficients())]
        denominator = [mpmath.mpf(c.numerator) / c.denominator for c in reversed(S.den.coefficients())]

        def slope(t: Any, y: Any) -> list[Any]:
            if time.process_time() > deadline:
                raise TimeoutError
            return [y[1], mpmath.polyval(numerator, t) / mpmath.polyval(denominator, t) * y[0]]

        ends = [mpmath.mpf(v.numerator) / v.denominator for v in (Fraction(x0), Fraction(x))]
        start = time.process_time()
        deadline = start + 2 * PATIENCE
        try:
            value = mpmath.odefun(slope, ends[0], [1, 0])(ends[1])[0]
        except TimeoutError:
            add("mpmath.odefun (given up)", 50, 2 * PATIENCE, None)
            return
        sign, man, exp, _ = value._mpf_
        error = relative((-1) ** sign * man * Fraction(2) ** exp, exact)
        add("mpmath.odefun", 50, time.process_time() - start, error)


def goals(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The three goals for every problem; None where there is no closed form."""

    def least(rows: list[dict[str, Any]]) -> float | None:
        return min((row["seconds"] for row in rows), default=None)

    result = []
    for name in dict.fromkeys(row["problem"] for row in rows):
        own = [row for row in rows if row["problem"] == name]
        named = {key: [r for r in own if r["method"].startswith(key)] for key in ("closed form", "DOP853", "mpmath")}
        finest = [r for r in named["DOP853"] if r["digits"] == 1e-12]
        error = finest[0]["log10_error"]
        bound = max(-12.0, -99.0 if error is None else error)
        rivals = [r for r in named["closed form"] if r["log10_error"] <= bound]
        closed = least([r for r in rivals if "1,000" not in r["method"]])
        shared = least([r for r in rivals if "1,000" in r["method"]])
        taylor = {r["digits"]: r["seconds"] for r in own if r["method"] == "Taylor route"}
        DOP853 = finest[0]["seconds"]
        result.append(
            {
                "problem": name,
                "DOP853": DOP853,
                "DOP853 / closed form": None if closed is None else DOP853 / closed,
                "DOP853 / closed form, one of 1,000 points": None if shared is None else DOP853 / shared,
                "odefun / Taylor, 50 digits": least(named["mpmath"]) / taylor[50],
                "odefun gave up": "given up" in named["mpmath"][0]["method"],
                "Taylor, 1,000 digits": taylor[1000],
            }
        )
        print(result[-1], flush=True)
    return result


def crossover() -> list[dict[str, Any]]:
    """Both routes over families whose closed form has a polynomial of growing degree, and the one that is chosen."""
    import kovacic
    from kovacic.enclosure.evaluate import evaluate_states

    families = [
        (f"Legendre, degree {n}", f"-({n * (n + 1)}*(1-x^2) + 1)/(1-x^2)^2", "0", "9/10") for n in (2, 30, 60, 100)
    ]
    families += [
        (f"Bessel, order {2 * n + 1}/2", f"-1 + {n * (n + 1)}/x^2", str(n + 2), str(n + 30)) for n in (1, 30, 60, 100)
    ]
    families += [(f"Hermite, degree {n}", f"x^2 - {2 * n + 1}", "0", "3") for n in (2, 30, 60)]
    rows = []
    for name, S, x0, x in families:
        solution = kovacic.solve(S)
        call = partial(evaluate_states, solution, [x], x0=x0, y0=1, dy0=0)
        for digits in (15, 50, 500):
            taylor, closed = (best(partial(call, digits=digits, method=m), 0.05)[0] for m in ("taylor", "closed form"))
            (state,) = call(digits=digits)
            rows.append(
                {"problem": name, "digits": digits, "Taylor": taylor, "closed form": closed, "chosen": state.run.method}
            )
    return rows


def markdown(data: dict[str, list[dict[str, Any]]]) -> str:
    def table(head: tuple[str, ...], lines: list[tuple[str, ...]]) -> list[str]:
        return ["| " + " | ".join(line) + " |" for line in (head, ("---",) * len(head), *lines)]

    def ratio(value: float | None, bound: float) -> str:
        return "" if value is None else f"{value:.3g}{'' if value >= bound else ' (missed)'}"

    rows = data["rows"]
    parts = [
        "# Run time against error",
        "",
        f"Python {platform.python_version()}, {platform.machine()}.",
        "Regenerate: `python benchmarks/enclosure_work_precision.py`.",
        "",
        "Processor time of one call from x0 to x.  Errors are relative, against the Taylor route at twice the digits.",
        "",
        "## Goals",
        "",
        "At 1e-12 the closed form (double or enclosure) costs at most a tenth of DOP853 at rtol 1e-12, which isn't more",
        "accurate; one point alone, where the cost of a Python call shows, and one of 1,000 points of one call.  At 50 digits",
        "the Taylor route costs at most a fiftieth of mpmath.odefun (> where that was stopped); 1,000 digits take less than a",
        "second.",
        "",
    ]
    parts += table(
        ("problem", "DOP853, s", "DOP853 / one point", "DOP853 / one of 1,000", "odefun / Taylor", "1,000 digits, s"),
        [
            (
                g["problem"],
                f"{g['DOP853']:.1e}",
                ratio(g["DOP853 / closed form"], 10),
                ratio(g["DOP853 / closed form, one of 1,000 points"], 10),
                ("> " if g["odefun gave up"] else "") + ratio(g["odefun / Taylor, 50 digits"], 50),
                f"{g['Taylor, 1,000 digits']:.3f}" + ("" if g["Taylor, 1,000 digits"] < 1 else " (missed)"),
            )
            for g in data["goals"]
        ],
    )
    parts += [
        "",
        "## Which route",
        "",
        "Milliseconds of either route, and the one that is taken unless asked otherwise.",
        "",
    ]
    parts += table(
        ("problem", "digits", "Taylor", "closed form", "chosen"),
        [
            (r["problem"], str(r["digits"]), f"{1e3 * r['Taylor']:.2f}", f"{1e3 * r['closed form']:.2f}", r["chosen"])
            for r in data["crossover"]
        ],
    )
    parts += ["", "## All runs", "", "*digits*: digits asked for, or the tolerance.", ""]
    parts += table(
        ("problem", "method", "digits", "seconds", "error"),
        [
            (
                r["problem"],
                r["method"],
                f"{r['digits']:g}",
                f"{r['seconds']:.2e}",
                "" if r["log10_error"] is None else f"1e{r['log10_error']:.0f}",
            )
            for r in rows
        ],
    )
    return "\n".join(parts) + "\n"


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
    data = {"goals": goals(rows), "crossover": crossover(), "rows": rows}
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "enclosure_work_precision.json").write_text(json.dumps(data, indent=1) + "\n")
    (RESULTS / "enclosure_work_precision.md").write_text(markdown(data))
    picture(rows, RESULTS / "enclosure_work_precision.png")


if __name__ == "__main__":
    main()

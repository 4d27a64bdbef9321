"""Work against error: all routes, LSODA, DOP853, odefun, Chebyshev collocation, heyoka; two values, 1 to 10^6 points.

Regenerate:  python -m venv ENV; ENV/bin/pip install heyoka; python benchmarks/work_against_error.py --heyoka ENV/bin/python
writes results/work_against_error.{json,md,png}; without --heyoka that integrator is left out.

Processor times.  A first value is from the text of the equation to y(x) and y'(x), with what is compiled or decided for it; a
second one is at another point, beyond which the first one went.  Correct digits are relative to the larger of |y| and |y'|,
against 1,100 digits.  An integrator is given up after 3 s; heyoka, which runs beside the others in own processes, a number of
digits each, four minutes after these are through: to compile a thousand digits takes it longer.
"""

from __future__ import annotations

import json
import math
import subprocess
import time
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import frame

PATIENCE = 3.0
HEYOKA_PATIENCE = 240
#: What was given up in this run.
GIVEN_UP: list[str] = []
# name, equation, x0, first x, second x, y''/y in Python's notation
PROBLEMS = [
    ("Airy", "x", 0, 5, "9/2", "t"),
    ("rational", "(x+1)/((x^2+2)*(x^2+3))", 0, 5, "9/2", "(t+1)/((t*t+2)*(t*t+3))"),
    ("Bessel 1/3", "-1 - 5/(36*x^2)", 1, 20, "39/2", "-1 - 5/(36*t*t)"),
    ("Mathieu", "y'' + (2 + cos(x))*y = 0", 0, 5, "9/2", "-2 - cos(t)"),
]
DIGITS = (15, 30, 100, 1000)
COUNTS = (1, 10, 100, 1000, 10_000, 100_000, 1_000_000)

# Run by another interpreter: problems on its standard input, rows on its standard output.
HEYOKA = """
import json, sys, time
import heyoka as hy, numpy as np
problems, digits, counts = json.load(sys.stdin)
rows = []
y, v = hy.make_vars("y", "v")
for name, x0, first, second, text in problems:
    S = eval(text, {"t": hy.time, "cos": hy.cos})
    for d in digits:
        try:
            begin = time.process_time()
            if d <= 15:
                number, options = float, {"tol": 1e-16}
            else:
                bits = int(d * 3.33) + 16
                number = lambda x: hy.real(x, bits)
                options = {"fp_type": hy.real, "prec": bits, "tol": hy.real(10, bits) ** -d}
            start = [number(1), number(0)]
            ta = hy.taylor_adaptive([(y, v), (v, S * y)], start, time=number(x0), **options)
            ta.propagate_until(number(first))
            made = time.process_time() - begin
            values = [str(w) if d > 15 else repr(float(w)) for w in ta.state]
            begin = time.process_time()
            ta.time = number(x0)
            ta.state[:] = start
            ta.propagate_until(number(second))
            again = time.process_time() - begin
            rows.append({"problem": name, "digits": d, "first": made, "second": again, "value": values})
        except Exception as reason:
            print(name, d, repr(reason), file=sys.stderr)
S = hy.time
ta = hy.taylor_adaptive([(y, v), (v, S * y)], [1.0, 0.0], time=0.0, tol=1e-16)
for count in counts:
    begin = time.process_time()
    ta.time = 0.0
    ta.state[:] = [1.0, 0.0]
    ta.propagate_grid(np.linspace(0, -20, count + 1))
    rows.append({"points": count, "seconds": time.process_time() - begin})
print(json.dumps([hy.__version__, rows]))
"""


def timed(action: Callable[..., Any], *arguments: Any, **options: Any) -> tuple[float, Any]:
    begin = time.process_time()
    result = action(*arguments, **options)
    return time.process_time() - begin, result


def both(table: Any, x: float) -> list[float]:
    return [table(x), table.derivative(x)]


def correct(values: list[Any], exact: list[Any]) -> float:
    import mpmath

    with mpmath.workdps(1200):
        size = max(abs(value) for value in exact)
        error = max(abs(mpmath.mpf(a) - b) for a, b in zip(values, exact, strict=True)) / size
        return 1100.0 if error == 0 else min(1100.0, float(-mpmath.log10(error)))


def ours(problem: tuple[Any, ...], exact: list[Any]) -> list[dict[str, Any]]:
    import kovacic
    from kovacic.enclosure import functions, states
    from kovacic.enclosure import problem as problems

    name, equation, x0, first, second, _ = problem
    rows = []
    for method in ("taylor", "closed form"):
        for digits in DIGITS:
            for cached in (states.journey_of, states.analytic_journeys, problems._of_text, functions._of_text):
                cached.cache_clear()
            start = {"x0": x0, "y0": 1, "dy0": 0, "digits": digits, "method": method}
            try:
                made, solution = timed(kovacic.prepared, equation, **start)
                once, balls = timed(solution, first, derivative=True)
            except kovacic.InputError:
                continue
            again, _ = timed(solution, second, derivative=True)
            values = [ball.to_mpmath() for ball in balls]
            row = {"problem": name, "method": f"ours, {method}, proven", "digits": digits}
            rows.append(row | {"first": made + once, "second": again, "correct": correct(values, exact)})
    for careful in (True, False):
        end = first + 0.001
        made, table = timed(kovacic.tabulate, equation, x0, end, x0=x0, y0=1, dy0=0, careful=careful)
        once, value = timed(both, table, float(first))
        again, _ = timed(both, table, float(Fraction(second)))
        row = {"problem": name, "method": f"ours, table{'' if careful else ', plain'}", "digits": 15}
        rows.append(row | {"first": made + once, "second": again, "correct": correct(value, exact)})
    return rows


class GivenUp(Exception):
    """The patience is over."""


def field(text: str, module: Any) -> Callable[[Any, Any], Any]:
    code, clock = compile(text, "S", "eval"), time.process_time() + PATIENCE

    def slope(t: Any, s: Any) -> Any:
        if time.process_time() > clock:
            raise GivenUp
        return [s[1], eval(code, {"t": t, "cos": module.cos}) * s[0]]

    return slope


def collocated(text: str, x0: float, end: float) -> Callable[[Any], list[Any]]:
    """y and y' by collocation with as many Chebyshev polynomials as make the last coefficients small: 16, 32, ..., 512."""
    import numpy as np
    from numpy.polynomial import chebyshev

    code, half = compile(text, "S", "eval"), (end - x0) / 2

    def share(x: Any) -> Any:
        return (x - x0) / half - 1

    for n in (16, 32, 64, 128, 256, 512):
        nodes = chebyshev.chebpts1(n - 2)
        D = np.vstack([chebyshev.chebder(np.eye(n)), np.zeros(n)]) / half
        inside, begin = chebyshev.chebvander(nodes, n - 1), chebyshev.chebvander(np.array([-1.0]), n - 1)
        S = eval(code, {"t": x0 + half * (nodes + 1), "cos": np.cos})
        rows = np.vstack([inside @ D @ D - S[:, None] * inside, begin, begin @ D])
        found = np.linalg.solve(rows, np.array([*np.zeros(n - 2), 1.0, 0.0]))
        if np.abs(found[-4:]).max() < 1e-15 * np.abs(found).max():
            break
    slopes = D @ found
    return lambda x: [chebyshev.chebval(share(x), found), chebyshev.chebval(share(x), slopes)]


def others(problem: tuple[Any, ...], exact: list[Any]) -> list[dict[str, Any]]:
    import mpmath
    from scipy.integrate import solve_ivp

    name, _, x0, first, second, text = problem
    rows = []
    for method in ("LSODA", "DOP853"):
        options = {"method": method, "rtol": 2.3e-14, "atol": 1e-14}
        ends = [float(Fraction(end)) for end in (first, second)]
        once, found = timed(solve_ivp, field(text, math), (x0, ends[0]), [1.0, 0.0], **options)
        again, _ = timed(solve_ivp, field(text, math), (x0, ends[1]), [1.0, 0.0], **options)
        values = [float(value) for value in found.y[:, -1]]
        row = {"problem": name, "method": method, "digits": 15}
        rows.append(row | {"first": once, "second": again, "correct": correct(values, exact)})
    made, solution = timed(collocated, text, x0, float(first))
    once, values = timed(solution, float(first))
    again, _ = timed(solution, ends[1])
    row = {"problem": name, "method": "Chebyshev collocation", "digits": 15}
    rows.append(row | {"first": made + once, "second": again, "correct": correct([*map(float, values)], exact)})
    for digits in DIGITS:
        with mpmath.workdps(digits):
            try:
                made, solution = timed(mpmath.odefun, field(text, mpmath), x0, [1, 0])
                once, values = timed(solution, first)
                again, _ = timed(solution, mpmath.mpf(Fraction(second).numerator) / 2)
            except GivenUp:
                GIVEN_UP.append(f"odefun with {digits} digits and more: {name}")
                break
        row = {"problem": name, "method": "mpmath.odefun", "digits": digits}
        rows.append(row | {"first": made + once, "second": again, "correct": correct(values, exact)})
    return rows


def many_points() -> list[dict[str, Any]]:
    """Airy's equation on [-20, 0], 15 digits."""
    import numpy as np
    from scipy.integrate import solve_ivp

    import kovacic

    rows = []
    for count in COUNTS:
        points = np.linspace(0, -20, count + 1)[1:]
        dop = {"rtol": 2.3e-14, "atol": 1e-14, "t_eval": points}

        def table(points: Any = points, careful: bool = True) -> Any:
            return kovacic.tabulate("x", -20, 0, x0=0, y0=1, dy0=0, careful=careful)(points)

        calls: dict[str, Callable[[], Any]] = {
            "ours, table": table,
            "ours, table, plain": lambda table=table: table(careful=False),
            "DOP853": lambda dop=dop: solve_ivp(field("t", math), (0, -20), [1.0, 0.0], method="DOP853", **dop),
            "LSODA": lambda dop=dop: solve_ivp(field("t", math), (0, -20), [1.0, 0.0], method="LSODA", **dop),
            "Chebyshev collocation": lambda points=points: collocated("t", 0, -20)(points),
        }
        if count <= 10_000:
            calls["ours, balls, proven"] = lambda points=points: kovacic.evaluate(
                "x", list(points), x0=0, y0=1, dy0=0, method="taylor"
            )
        for method, call in calls.items():
            seconds, _ = timed(call)
            rows.append({"points": count, "method": method, "seconds": seconds})
    return rows


def exact_values(problem: tuple[Any, ...]) -> list[Any]:
    import kovacic

    _, equation, x0, first, _, _ = problem
    balls = kovacic.evaluate(equation, first, x0=x0, y0=1, dy0=0, digits=1100, derivative=True, method="taylor")
    import mpmath

    with mpmath.workdps(1200):
        return [ball.to_mpmath() for ball in balls]


def begun(python: str) -> dict[int, subprocess.Popen[str]]:
    """A process for each number of digits, which run beside the other methods; the first one has the many points, too."""
    given = [(name, x0, float(first), float(Fraction(second)), text) for name, _, x0, first, second, text in PROBLEMS]
    found = {}
    for digits in DIGITS:
        pipes: Any = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
        found[digits] = subprocess.Popen([python, "-c", HEYOKA], **pipes)
        counts = COUNTS if digits == DIGITS[0] else ()
        found[digits].stdin.write(json.dumps([given, [digits], counts]))
        found[digits].stdin.close()
        found[digits].stdin = None
    return found


def by_heyoka(
    processes: dict[int, subprocess.Popen[str]], exact: dict[str, list[Any]]
) -> tuple[str, list[dict[str, Any]], list[dict[str, Any]]]:
    """Its version, and the rows; without those of a process that isn't through by now and some patience."""
    version, single, many = "left out", [], []
    for digits, process in processes.items():
        try:
            text, _ = process.communicate(timeout=HEYOKA_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            GIVEN_UP.append(f"heyoka with {digits} digits")
            continue
        version, rows = json.loads(text)
        single += [row for row in rows if "problem" in row]
        many += [row | {"method": "heyoka"} for row in rows if "points" in row]
    for row in single:
        row["method"] = "heyoka"
        row["correct"] = correct(row.pop("value"), exact[row["problem"]])
    return version, single, many


def markdown(data: dict[str, Any]) -> str:
    def shown(seconds: float) -> str:
        return f"{1e3 * seconds:.3g}"

    lines = ["# Work against error", "", frame.line(heyoka=data["heyoka"]), ""]
    lines += [
        "Processor times in milliseconds; the picture is `work_against_error.png`.  Ours are proven where it says so; the",
        "",
    ]
    lines[-2] += (
        " others give no bound.  Under a load above 1 other programs share the caches, and all methods take longer."
    )
    if data["given up"]:
        lines += [f"Given up: {'; '.join(data['given up'])}.", ""]
    lines += ["## One value, and a second one", ""]
    head = ["problem", "method", "digits asked for", "correct", "first", "second"]
    rows = [
        [r["problem"], r["method"], str(r["digits"]), f"{r['correct']:.1f}", shown(r["first"]), shown(r["second"])]
        for r in sorted(data["one"], key=lambda r: (r["problem"], r["digits"], r["first"]))
    ]
    lines += [*frame.table(head, rows), "", "## Where we are slower", ""]
    lines += [
        *slower(data["one"]),
        *slower_at_many(data["many"]),
        "",
        "## Many points: Airy's equation on [-20, 0], 15 digits, the first point included",
        "",
    ]
    methods = list(dict.fromkeys(row["method"] for row in data["many"]))
    times = {(row["points"], row["method"]): shown(row["seconds"]) for row in data["many"]}
    rows = [[f"{count:,}", *(times.get((count, method), "") for method in methods)] for count in COUNTS]
    return "\n".join([*lines, *frame.table(["points", *methods], rows)])


def slower_at_many(rows: list[dict[str, Any]]) -> list[str]:
    """The same for many points; heyoka's integrator is compiled before, which isn't counted there."""
    found = []
    for count in COUNTS:
        own = [row for row in rows if row["points"] == count]
        best = min(own, key=lambda row: row["seconds"])
        mine = min((row for row in own if row["method"].startswith("ours")), key=lambda row: row["seconds"])
        if best is not mine:
            times = f"{1e3 * best['seconds']:.3g} ms, ours {1e3 * mine['seconds']:.3g} ms"
            said = " (compiled before)" if best["method"] == "heyoka" else ""
            found.append(f"- {count:,} points: {best['method']}{said} {times} ({mine['method']}).")
    return found


def slower(rows: list[dict[str, Any]]) -> list[str]:
    """A sentence for each problem, number of digits and kind of value where another one is faster with as many digits."""
    found = []
    for name in dict.fromkeys(row["problem"] for row in rows):
        for digits in DIGITS:
            own = [row for row in rows if row["problem"] == name and row["digits"] == digits]
            enough = [row for row in own if row["correct"] > digits - 3]
            for kind in ("first", "second"):
                best = min(enough, key=lambda row, kind=kind: row[kind])
                mine = min((r for r in enough if r["method"].startswith("ours")), key=lambda row, kind=kind: row[kind])
                if best is not mine:
                    times = f"{1e3 * best[kind]:.3g} ms, ours {1e3 * mine[kind]:.3g} ms"
                    found.append(
                        f"- {name}, {digits} digits, {kind} value: {best['method']} {times} ({mine['method']})."
                    )
    return found or ["Nowhere in this run."]


def picture(data: dict[str, Any]) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 4.6), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, 3)
    methods = list(dict.fromkeys(row["method"] for row in data["one"] + data["many"]))
    for k, method in enumerate(methods):
        own = [row for row in data["one"] if row["method"] == method]
        for axes, kind in zip(panels[:2], ("first", "second"), strict=True):
            if own:
                axes.scatter(
                    [max(1, r["correct"]) for r in own], [r[kind] for r in own], s=16, color=f"C{k}", label=method
                )
        many = [row for row in data["many"] if row["method"] == method]
        if many:
            panels[2].loglog(
                [r["points"] for r in many], [r["seconds"] for r in many], "o-", color=f"C{k}", label=method
            )
    for axes, title in zip(panels, ("first value", "second value", "many points: Airy, 15 digits"), strict=True):
        axes.set(xscale="log", yscale="log", ylabel="seconds", title=title)
        axes.set_xlabel("points" if title.startswith("many") else "correct digits")
        axes.grid(alpha=0.3)
        axes.legend(frameon=False, fontsize=7)
    figure.savefig(frame.RESULTS / "work_against_error.png", dpi=110)


def main() -> None:
    arguments = frame.parser(__doc__)
    arguments.add_argument("--heyoka", help="an interpreter that has heyoka")
    given = arguments.parse_args()
    exact, one = {}, []
    processes = begun(given.heyoka) if given.heyoka else {}
    for problem in PROBLEMS:
        exact[problem[0]] = exact_values(problem)
        one += ours(problem, exact[problem[0]]) + others(problem, exact[problem[0]])
        print(problem[0], flush=True)
    many = many_points()
    version = "left out"
    if given.heyoka:
        version, single, crowd = by_heyoka(processes, exact)
        one += single
        many += crowd
    data = {"heyoka": version, "given up": GIVEN_UP, "one": one, "many": many}
    frame.save("work_against_error", data, markdown(data))
    picture(data)


if __name__ == "__main__":
    main()

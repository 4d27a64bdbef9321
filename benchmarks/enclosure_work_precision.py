"""What a proven value costs: against integrators, against Arb's own functions, for many points, and what each call computes.

Regenerate:  python benchmarks/enclosure_work_precision.py
writes results/enclosure_work_precision.{json,md,png} (about two minutes).  Times are processor times, the least of several
calls; errors are relative, against the Taylor route at more digits.  Thousands of digits: `enclosure_long_series.py`.
"""

from __future__ import annotations

import math
import statistics
import time
from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import flint
import frame

import kovacic
from kovacic.enclosure import classical, closed_form, frobenius, journey, rational, way
from kovacic.enclosure.monodromy import connection_matrix, monodromy
from kovacic.enclosure.states import evaluate_states

RESULTS = Path(__file__).parent / "results"
PATIENCE = 3.0

# name, S, x0, x: y(x0) = 1, y'(x0) = 0
PROBLEMS = [
    ("Airy", "x", "0", "5"),
    ("Bessel, order 1/3", "-1 - 5/(36*x^2)", "1", "20"),
    ("Bessel, order 21/2", "-1 + 110/x^2", "12", "40"),
    ("Legendre, degree 100", "-(10100*(1-x^2) + 1)/(1-x^2)^2", "0", "9/10"),
    ("Hermite, degree 50", "x^2 - 101", "0", "8"),
    ("irregular at 0", "1/x^4", "1/10", "2"),
    ("icosahedral", "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)", "2", "9"),
]

BESSEL = "x^2*y'' + x*y' + (x^2 - 1/9)*y = 0"
GAUSS = "x*(1-x)*y'' + (5/4 - 11/6*x)*y' - 1/6*y = 0"
THIRD = flint.fmpq(1, 3)


def gauss_function(z: Any) -> Any:
    """2F1(1/2, 1/3; 5/4; z)."""
    return z.hypgeom_2f1(flint.arb(1) / 2, flint.arb(THIRD), flint.arb(5) / 4)


# name, equation, x, start, the function of Arb
FUNCTIONS: list[tuple[str, str, Any, dict[str, Any], Callable[[Any], Any]]] = [
    ("Airy, from 0", "x", 2, {"x0": 0, "y0": 1, "dy0": 0}, lambda z: z.airy_ai()),
    ("Bessel 1/3, from 1", BESSEL, 3, {"x0": 1, "y0": 1, "dy0": 0}, lambda z: z.bessel_j(flint.arb(THIRD))),
    ("Bessel 1/3, from 0", BESSEL, 3, {"x0": 0, "which": "regular"}, lambda z: z.bessel_j(flint.arb(THIRD))),
    ("2F1, from 0", GAUSS, Fraction(1, 3), {"x0": 0, "which": "regular"}, gauss_function),
]
GOALS = {15: 10, 50: 10, 1000: 5, 10_000: 2}


def best(action: Callable[[], Any], seconds: float = 0.15) -> tuple[float, Any]:
    """Least processor time of repeated runs (at least one), and the last result."""
    times, begin = [], time.process_time()
    while True:
        start = time.process_time()
        result = action()
        times.append(time.process_time() - start)
        if time.process_time() - begin > seconds or len(times) >= 20:
            return min(times), result


def correct_digits(value: Fraction, exact: Fraction) -> float:
    """-log10 of the relative error, for errors of any size."""
    error = abs(value - exact) / abs(exact)
    return 1e4 if not error else (error.denominator.bit_length() - error.numerator.bit_length()) * math.log10(2)


def one_value() -> list[dict[str, Any]]:
    """Our route, DOP853, Radau and mpmath.odefun, on every problem."""
    import mpmath
    import numpy as np
    from scipy.integrate import solve_ivp

    from kovacic.reading.read import read_input

    rows: list[dict[str, Any]] = []
    clock = [0.0]  # when an integrator is given up
    for name, text, x0, x in PROBLEMS:
        S = read_input(text).S
        start = {"x0": x0, "y0": 1, "dy0": 0}
        exact = evaluate_states(S, [x], **start, digits=1100)[0].y.midpoint[0]

        def add(method: str, seconds: float, value: Fraction, name: str = name, exact: Fraction = exact) -> None:
            rows.append({"problem": name, "method": method, "seconds": seconds, "digits": correct_digits(value, exact)})

        for digits in (5, 15, 50, 200, 1000):
            seconds, _ = best(partial(evaluate_states, S, [x], **start, digits=digits))
            rows.append({"problem": name, "method": "ball (proven)", "seconds": seconds, "digits": float(digits)})
        num, den = ([float(c) for c in reversed(part.coefficients())] for part in (S.num, S.den))

        def field(t: float, y: Any, num: Any = num, den: Any = den) -> Any:
            if time.process_time() > clock[0]:
                raise TimeoutError
            return [y[1], np.polyval(num, t) / np.polyval(den, t) * y[0]]

        span = (float(Fraction(x0)), float(Fraction(x)))
        for method, tolerances in (("DOP853", (1e-6, 1e-9, 1e-12)), ("Radau", (1e-6, 1e-9))):
            for tolerance in tolerances:
                clock[0] = time.process_time() + PATIENCE
                options = {"method": method, "rtol": tolerance, "atol": tolerance * 1e-3}
                try:
                    seconds, answer = best(partial(solve_ivp, field, span, [1.0, 0.0], **options), 0.1)
                except TimeoutError:
                    continue
                add(method, seconds, Fraction(float(answer.y[0, -1])))
        for digits in (15, 50):
            with mpmath.workdps(digits):
                tops = [
                    [mpmath.mpf(c.numerator) / c.denominator for c in reversed(p.coefficients())]
                    for p in (S.num, S.den)
                ]
                clock[0] = time.process_time() + PATIENCE

                def slope(t: Any, y: Any, tops: Any = tops) -> list[Any]:
                    if time.process_time() > clock[0]:
                        raise TimeoutError
                    return [y[1], mpmath.polyval(tops[0], t) / mpmath.polyval(tops[1], t) * y[0]]

                begin, ends = (
                    time.process_time(),
                    [mpmath.mpf(v.numerator) / v.denominator for v in map(Fraction, (x0, x))],
                )
                try:
                    sign, man, exp, _ = mpmath.odefun(slope, ends[0], [1, 0])(ends[1])[0]._mpf_
                except TimeoutError:
                    continue
                add("mpmath.odefun", time.process_time() - begin, (-1) ** sign * int(man) * Fraction(2) ** exp)
        print(name, flush=True)
    return rows


def many_values() -> list[dict[str, Any]]:
    """Airy's equation on [-20, 0], 12 digits: time against the number of points."""
    import numpy as np
    from scipy.integrate import solve_ivp

    from kovacic.doubles.tabulate import tabulate

    rows = []
    start = {"x0": 0, "y0": 1, "dy0": 0}
    for count in (1, 10, 100, 1000, 10_000):
        points = np.linspace(-20, 0, count)

        def dop853(points: Any = points) -> Any:
            options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12, "t_eval": points[::-1]}
            return solve_ivp(lambda t, y: (y[1], t * y[0]), (0, -20), (1.0, 0.0), **options)

        def table(points: Any = points) -> Any:
            return tabulate("x", -20, 0, **start)(points)

        calls = {
            "balls, one call": partial(evaluate_states, "x", points, **start, digits=12),
            "DOP853": dop853,
            "tabulate, with building": table,
        }
        if count <= 100:
            calls["balls, a call a point"] = lambda points=points: [
                evaluate_states("x", [x], **start, digits=12) for x in points
            ]
        rows += [{"points": count, "method": name, "seconds": best(call)[0]} for name, call in calls.items()]
    return rows


def against_arb() -> list[dict[str, Any]]:
    """The ratio of our time to Arb's, with both to so many digits; the equation was read and decided before.

    What is compared is a call for one more point: the functions at the start are kept from the first one.
    """
    rows = []
    for name, text, x, start, function in FUNCTIONS:
        for digits in GOALS:
            equation, begin = kovacic.solve(text), time.process_time()
            evaluate_states(equation, [x], **start, digits=digits)
            first = time.process_time() - begin
            ours = best(partial(evaluate_states, equation, [x], **start, digits=digits))[0]

            def theirs(digits: int = digits, x: Any = x, function: Any = function) -> Any:
                with flint.ctx.workprec(int(digits * 3.33) + 30):
                    return function(flint.arb(flint.fmpq(Fraction(x).numerator, Fraction(x).denominator)))

            arb = best(theirs)[0]
            row = {"function": name, "digits": digits, "first call": first, "ours": ours, "Arb": arb}
            rows.append({**row, "ratio": ours / arb})
    return rows


def the_ball() -> list[dict[str, Any]]:
    """The rolling ball's closed forms at one point, from -9/10 to 9/10, against DOP853 and the Taylor route."""
    import numpy as np
    from scipy.integrate import solve_ivp

    rows = []
    for ratio in ("1/2", "3/2", "1/3", "10", "577/408"):
        w, D = 2 * Fraction(ratio) ** 2, "(5 + 2*x + x^2/2)"
        answer = kovacic.solve(f"({w + 1})/(4*{D}) - 3*(x + 2)^2/(16*{D}^2)")
        num, den = ([float(c) for c in reversed(part.coefficients())] for part in (answer.S.num, answer.S.den))

        def field(t: float, y: Any, num: Any = num, den: Any = den) -> Any:
            return [y[1], np.polyval(num, t) / np.polyval(den, t) * y[0]]

        options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-15}
        row = {"R/R1": ratio, "case": answer.case}
        row["DOP853, ms"] = 1e3 * best(partial(solve_ivp, field, (-0.9, 0.9), [1.0, 0.0], **options))[0]
        call, begin = partial(evaluate_states, answer, ["9/10"], x0="-9/10", y0=1, dy0=0), time.process_time()
        call(digits=12)
        row["first call, ms"] = 1e3 * (time.process_time() - begin)
        row["NumPy function, ms"] = 1e3 * best(partial(answer.lambdify(interval=(-0.9, 0.9)), 0.9))[0]
        for digits in (12, 1000):
            row[f"{digits} digits, ms"] = 1e3 * best(partial(call, digits=digits))[0]
        row["1,000 digits by Taylor, ms"] = 1e3 * best(partial(call, digits=1000, method="taylor"))[0]
        rows.append({**row, "DOP853 over 12 digits": row["DOP853, ms"] / row["12 digits, ms"]})
    return rows


COUNTED = {
    "Taylor expansions": (rational, "expand"),
    "matrices of one": (way, "transition"),
    "values in one": (way.Local, "state"),
    "Frobenius series": (frobenius, "_expand"),
    "closed-form legs": (closed_form.CaseOneForm, "leg"),
    "legs by FLINT's functions": (classical.Classical, "leg"),
    "Frobenius solutions by these": (classical, "_frobenius"),
    "runs": (journey.Journey, "states"),
}


def costs() -> list[dict[str, Any]]:
    """What a call of each kind computes, at 15 digits, and its time."""
    airy = {"x0": 0, "y0": 1, "dy0": 0}
    bessel, crowd = kovacic.solve("-1 + 2/x^2"), [Fraction(k, 50) for k in range(1000)]
    calls: dict[str, Callable[[], Any]] = {
        "one point": lambda: evaluate_states("x", [2], **airy),
        "the same far away": lambda: evaluate_states("-1 - 1/x^2", [300], x0=1, y0=1, dy0=0),
        "1,000 points": lambda: evaluate_states("x", crowd, **airy),
        "a closed form of case 1": lambda: evaluate_states(bessel, [20], x0=1, y0=1, dy0=0),
        "regular at 0, near": lambda: evaluate_states(BESSEL, [Fraction(1, 2)], x0=0, which="regular"),
        "regular at 0, x = 20": lambda: evaluate_states(BESSEL, [20], x0=0, which="regular"),
        "at infinity": lambda: evaluate_states(GAUSS, [-3], x0="oo", which="regular"),
        "decaying": lambda: evaluate_states("x", [2], x0=0, which="decaying"),
        "a right-hand side": lambda: evaluate_states("y'' + y = 1/(x+1)", [2], **airy),
        "around a singular point": lambda: evaluate_states("1/x^2", [2], x0=-1, y0=1, dy0=0, path="above"),
        "connection of 0 and 1": lambda: connection_matrix(GAUSS, [0, 1]),
        "monodromy, two points": lambda: monodromy(GAUSS),
    }
    rows = []
    for name, call in calls.items():
        seconds, counts = best(call)[0], Counter[str]()
        kept = {key: getattr(*place) for key, place in COUNTED.items()}

        def counted(key: str, own: Any, counts: Counter[str] = counts) -> Any:
            def wrapped(*arguments: Any, **options: Any) -> Any:
                counts[key] += 1
                return own(*arguments, **options)

            return wrapped

        for key, (owner, attribute) in COUNTED.items():
            setattr(owner, attribute, counted(key, kept[key]))
        call()
        for key, (owner, attribute) in COUNTED.items():
            setattr(owner, attribute, kept[key])
        rows.append({"call": name, "milliseconds": 1e3 * seconds, **{key: counts[key] for key in COUNTED}})
    return rows


def crossover() -> list[dict[str, Any]]:
    """Both routes over families whose closed form has a polynomial of growing degree, and the one that is chosen."""
    import kovacic

    families = [
        (f"Legendre, degree {n}", f"-({n * (n + 1)}*(1-x^2) + 1)/(1-x^2)^2", "0", "9/10") for n in (2, 30, 60, 100)
    ]
    families += [(f"Bessel, order {2 * n + 1}/2", f"-1 + {n * (n + 1)}/x^2", str(n + 2), str(n + 30)) for n in (1, 60)]
    rows = []
    for name, S, x0, x in families:
        call = partial(evaluate_states, kovacic.solve(S), [x], x0=x0, y0=1, dy0=0)
        for digits in (15, 50, 500):
            ours, closed = (best(partial(call, digits=digits, method=m), 0.05)[0] for m in ("taylor", "closed form"))
            row = {"problem": name, "digits": digits, "Taylor, ms": 1e3 * ours, "closed form, ms": 1e3 * closed}
            rows.append({**row, "chosen": call(digits=digits)[0].route.method})
    return rows


def table(rows: list[dict[str, Any]]) -> list[str]:
    def shown(value: Any) -> str:
        return f"{value:.3g}" if isinstance(value, float) else str(value)

    lines = [list(rows[0]), ["---"] * len(rows[0]), *([shown(v) for v in row.values()] for row in rows)]
    return ["| " + " | ".join(line) + " |" for line in lines] + [""]


def markdown(data: dict[str, list[dict[str, Any]]]) -> str:
    missed = [r for r in data["against Arb"] if r["ratio"] > GOALS[r["digits"]]]
    parts = [
        "# What a proven value costs",
        "",
        f"{frame.line()}  Processor times.",
        "Regenerate: `python benchmarks/enclosure_work_precision.py`.",
        "",
        "## What each kind of call computes and costs",
        "",
        *table(data["costs"]),
        "## Against Arb's own functions",
        "",
        f"Goals: {', '.join(f'{v} times at {k} digits' for k, v in GOALS.items())}.  Missed: {len(missed)} of "
        f"{len(data['against Arb'])}.",
        "",
        *table(data["against Arb"]),
        "## The ball's closed forms at one point",
        "",
        *table(data["the ball"]),
        "## Many points: Airy's equation on [-20, 0], 12 digits",
        "",
        *table(data["many values"]),
        "## Which route",
        "",
        *table(data["crossover"]),
        "## One value",
        "",
        *table(data["one value"]),
    ]
    return "\n".join(parts)


def picture(data: dict[str, list[dict[str, Any]]], target: Path) -> None:
    """One panel a question; a method has the same colour everywhere."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 8.5), layout="constrained")
    FigureCanvasAgg(figure)
    one, many, arb, cost = figure.subplots(2, 2).flat
    colours = {"ball (proven)": "C0", "balls, one call": "C0", "DOP853": "C1", "Radau": "C2", "mpmath.odefun": "C3"}
    colours |= {"balls, a call a point": "C9", "tabulate, with building": "C4"}
    for method in ("ball (proven)", "DOP853", "Radau", "mpmath.odefun"):
        own = [r for r in data["one value"] if r["method"] == method]
        one.scatter(
            [max(r["digits"], 1) for r in own], [r["seconds"] for r in own], s=14, color=colours[method], label=method
        )
        if method == "ball (proven)":
            digits = sorted({r["digits"] for r in own})
            middle = [statistics.median(r["seconds"] for r in own if r["digits"] == d) for d in digits]
            one.plot(digits, middle, color=colours[method])
    one.set(xscale="log", yscale="log", xlabel="correct digits", ylabel="seconds")
    one.set_title(f"One value: what does a digit cost?  ({len(PROBLEMS)} problems, a dot each)")
    for method in dict.fromkeys(r["method"] for r in data["many values"]):
        own = [r for r in data["many values"] if r["method"] == method]
        many.loglog([r["points"] for r in own], [r["seconds"] for r in own], "o-", color=colours[method], label=method)
    many.set(xlabel="points", ylabel="seconds", title="Many values: Airy on [-20, 0], 12 digits")
    for k, name in enumerate(dict.fromkeys(r["function"] for r in data["against Arb"])):
        own = [r for r in data["against Arb"] if r["function"] == name]
        arb.loglog([r["digits"] for r in own], [r["ratio"] for r in own], "o-", color=f"C{k + 5}", label=name)
    arb.loglog(list(GOALS), list(GOALS.values()), "k--", label="goal")
    arb.set(xlabel="digits", ylabel="our time / Arb's", title="How far from Arb's own functions?")
    names = [r["call"] for r in data["costs"]]
    cost.barh(names, [r["milliseconds"] for r in data["costs"]], color="C0")
    cost.invert_yaxis()
    cost.set(xscale="log", xlabel="milliseconds, 15 digits", title="What does a call of each kind cost?")
    for axes in (one, many, arb):
        axes.legend(frameon=False, fontsize=8)
        axes.grid(alpha=0.3)
    figure.savefig(target, dpi=110)


def main() -> None:
    data = {
        "one value": one_value(),
        "many values": many_values(),
        "against Arb": against_arb(),
        "the ball": the_ball(),
        "costs": costs(),
        "crossover": crossover(),
    }
    frame.save("enclosure_work_precision", data, markdown(data))
    picture(data, frame.RESULTS / "enclosure_work_precision.png")


if __name__ == "__main__":
    main()

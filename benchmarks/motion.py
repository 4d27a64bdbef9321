"""Run time against error for the ball's motion: closed form and quadratures against direct integration.

    python benchmarks/motion.py      writes benchmarks/results/motion.json, .md and .png; about eight minutes of processor time

Every method gives the whole motion (u, v, omega_3, n and the contact point on the sphere) at the same times, spread over the
last oscillation.  The error is the largest of the differences of u, omega_3, n, of v on the circle, and of the contact point
in units of R1.  Times are processor time from the initial state on; Woronetz's equations are compiled beforehand.
Direct integration: SciPy's DOP853 and Radau on Woronetz's eight equations, rtol = tolerance, atol = tolerance/100.

The reference knows nothing of the closed form: Woronetz's equations over one oscillation in 30-digit arithmetic
(extrapolation), whose period is found by Newton's method and checked: all five reduced coordinates return to 1e-25.
After k oscillations the frame at the contact is the k-th power of a rotation times the frame in the first one, and v has
gained k times the same angle.  Its error is far below 1e-20, a rounding of the times (doubles of about 3e4) costs 1e-11.
"""

from __future__ import annotations

import argparse
import json
import platform
import time
from dataclasses import asdict, astuple, dataclass, replace
from pathlib import Path

import mpmath
import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

import kovacic
from kovacic.ball import Ball, U
from kovacic.ball.attitude import locate
from kovacic.ball.direct import State, equations, integrate_precisely, jacobian
from kovacic.ball.motion import solve_motion

RESULTS = Path(__file__).parent / "results"
SPHERE = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
POTENTIAL = sp.Rational(3, 2) * sp.cos(U)
START = State(1.0, 0.1, 0.3, 1.2, 0.2, 0.5, 0.25, 2.0)
SYSTEM = equations(SPHERE.body, POTENTIAL)
DIGITS, SAMPLES = 30, 25
EXPONENTS = range(3, 13)
LONG, SHORTER = 10_000, (1, 10, 100, 1000)
#: Radau is stopped after so many seconds, and isn't asked for smaller tolerances once it was.
PATIENCE = 60.0


@dataclass(frozen=True, slots=True)
class Row:
    """One run; `seconds` None means that it was stopped after PATIENCE seconds."""

    method: str
    oscillations: int
    tolerance: float
    seconds: float | None
    error: float | None


@dataclass(frozen=True, slots=True)
class Values:
    """The motion at the sample times; the contact point as a unit vector."""

    u: np.ndarray
    v: np.ndarray
    omega_3: np.ndarray
    n: np.ndarray
    contact: np.ndarray

    def distance(self, other: Values) -> float:
        turn = np.angle(np.exp(1j * (self.v - other.v)))
        pairs = ((self.u, other.u), (self.omega_3, other.omega_3), (self.n, other.n), (turn, 0 * turn))
        return max(
            *(float(np.abs(p - q).max()) for p, q in pairs),
            float(np.linalg.norm(self.contact - other.contact, axis=1).max()),
        )


def reference(counts: tuple[int, ...]) -> tuple[float, float, dict[int, tuple[np.ndarray, Values]]]:
    """The period, the largest defect of periodicity, and for each count the sample times with the motion there."""
    with mpmath.workdps(DIGITS + 10):
        rough = mpmath.mpf(solve_motion(SPHERE, POTENTIAL, START).period)
        [back] = integrate_precisely(SPHERE.body, POTENTIAL, START, [rough], digits=DIGITS)
        period = rough
        for _ in range(2):
            change = (START.u - back.u) / back.du
            period += change
            [back] = integrate_precisely(SPHERE.body, POTENTIAL, back, [change], digits=DIGITS)
        defect = max(abs(getattr(back, name) - mpmath.mpf(getattr(START, name))) for name in ("u", "du", "dv", "n"))
        assert defect < mpmath.mpf(10) ** -25, mpmath.nstr(defect)
        gain, turn = back.v - START.v, frame(back) * frame(START).T
        times = {k: float(period) * (k - 1 + np.arange(1, SAMPLES + 1) / (SAMPLES + 1)) for k in counts}
        rests = sorted((mpmath.mpf(t) - (k - 1) * period, k) for k in counts for t in times[k])
        states = integrate_precisely(SPHERE.body, POTENTIAL, START, [rest for rest, _ in rests], digits=DIGITS)
        result = {}
        for count in counts:
            mine = [state for state, (_, k) in zip(states, rests, strict=True) if k == count]
            rotation = turn ** (count - 1)
            contact = [list(-(rotation * frame(state))[:, 2]) for state in mine]
            result[count] = (
                times[count],
                Values(
                    u=np.array([float(state.u) for state in mine]),
                    v=np.array([float(mpmath.fmod(state.v + (count - 1) * gain, 2 * mpmath.pi)) for state in mine]),
                    omega_3=np.array([float(SYSTEM.omega_3([float(value) for value in astuple(s)])) for s in mine]),
                    n=np.array([float(state.n) for state in mine]),
                    contact=np.array(contact, dtype=float),
                ),
            )
    return float(period), float(defect), result


def frame(state: State) -> mpmath.matrix:
    """e_u, e_v, e_n as columns, in space; the contact point on the unit sphere is -e_n."""
    sin, cos = mpmath.sin, mpmath.cos
    south = mpmath.matrix([cos(state.u1) * cos(state.v1), cos(state.u1) * sin(state.v1), -sin(state.u1)])
    east = mpmath.matrix([-sin(state.v1), cos(state.v1), 0])
    out = mpmath.matrix([sin(state.u1) * cos(state.v1), sin(state.u1) * sin(state.v1), cos(state.u1)])
    s, c = sin(state.theta), cos(state.theta)
    columns = (c * east - s * south, c * south + s * east, -out)
    return mpmath.matrix([[column[i] for column in columns] for i in range(3)])


def closed(tolerance: float, times: np.ndarray) -> Values:
    motion = solve_motion(SPHERE, POTENTIAL, START, tolerance=tolerance)
    phi = motion.phase(times)
    omega_3, n = motion.rotation(phi)
    return Values(
        motion.band.colatitude(phi), motion.v(phi), omega_3, n, locate(motion, phi).contact * motion.ball.kappa
    )


class Stopped(Exception):
    """An integration took longer than PATIENCE."""


def direct(method: str, tolerance: float, times: np.ndarray) -> Values:
    end = time.process_time() + PATIENCE if method == "Radau" else np.inf

    def rates(t: float, y: np.ndarray) -> list[float]:
        if time.process_time() > end:
            raise Stopped
        return SYSTEM.rates(t, y)

    result = solve_ivp(
        rates if method == "Radau" else SYSTEM.rates,
        (0.0, times[-1]),
        astuple(START),
        method=method,
        t_eval=times,
        rtol=tolerance,
        atol=tolerance / 100,
        **({"jac": jacobian(SYSTEM)} if method == "Radau" else {}),
    )
    assert result.success, result.message
    u, v, _, u1, v1, _, _, n = result.y
    omega_3 = np.array([SYSTEM.omega_3(list(column)) for column in result.y.T])
    return Values(u, v, omega_3, n, np.stack([np.sin(u1) * np.cos(v1), np.sin(u1) * np.sin(v1), np.cos(u1)], axis=1))


def measure(method: str, count: int, exponent: int, samples: tuple[np.ndarray, Values], repeat: int) -> Row:
    """The least time of `repeat` runs, for other work on the machine only adds to it."""
    times, exact = samples
    tolerance = 10.0**-exponent
    row = Row(method, count, tolerance, None, None)
    for _ in range(repeat):
        begin = time.process_time()
        try:
            values = closed(tolerance, times) if method == "closed form" else direct(method, tolerance, times)
        except Stopped:
            return row
        seconds = time.process_time() - begin
        row = replace(row, seconds=min(seconds, row.seconds or seconds), error=values.distance(exact))
    return row


def run(long: int) -> tuple[float, float, list[Row]]:
    counts = (*SHORTER, long)
    period, defect, samples = reference(counts)
    closed(1e-9, samples[1][0])  # imports and caches aren't part of the first measurement
    rows: list[Row] = []

    def add(method: str, count: int, exponent: int, repeat: int) -> Row:
        row = measure(method, count, exponent, samples[count], repeat)
        rows.append(row)
        print(text(row), flush=True)
        return row

    for exponent in EXPONENTS:
        add("closed form", long, exponent, 5)
        add("DOP853", long, exponent, 1)
    for exponent in EXPONENTS:
        if add("Radau", long, exponent, 1).seconds is None:
            break
    for count in SHORTER:
        for exponent in (6, 9, 12):
            add("closed form", count, exponent, 5)
            add("DOP853", count, exponent, 5 if count < 100 else 1)
            if count <= 10:
                add("Radau", count, exponent, 1)
    return period, defect, rows


def text(row: Row) -> str:
    seconds = f"more than {PATIENCE:g}" if row.seconds is None else f"{row.seconds:.4f}"
    return f"| {row.oscillations} | {row.tolerance:.0e} | {row.method} | {seconds} | {_error(row)} |"


def _error(row: Row) -> str:
    return "" if row.error is None else f"{row.error:.1e}"


def markdown(period: float, defect: float, rows: list[Row], long: int) -> str:
    closed_rows = [row for row in rows if row.method == "closed form"]
    ratios = {row: _partner(rows, row).seconds / row.seconds for row in closed_rows}
    below = [ratio for row, ratio in ratios.items() if row.oscillations == long and row.tolerance < 1e-6]
    slower = [row for row, ratio in ratios.items() if ratio <= 1]
    times = [1000 * row.seconds for row in closed_rows]
    floor = max(row.error for row in closed_rows if row.oscillations == long and row.tolerance <= 1e-11)
    verdict = (
        f"- At {long} oscillations the closed form is {min(below):.0f} to {max(below):.0f} times as fast as DOP853 at the"
        " tolerances below 1e-6."
        if min(below) > 1
        else "- The closed form isn't faster at every tolerance below 1e-6: see the second table."
    )
    if slower:
        where = "; ".join(f"{row.tolerance:.0e} with {row.oscillations} oscillation(s)" for row in slower)
        verdict += f"\n- It isn't faster at these tolerances: {where}.  It always works out a whole oscillation and the series."
    return "\n".join(
        [
            "# The motion of the ball: run time against error",
            "",
            "Written by `python benchmarks/motion.py`; see there for what is measured.  Seconds of processor time.",
            "",
            f"kovacic {kovacic.__version__}, python {platform.python_version()}, {platform.system()} {platform.machine()}",
            "",
            verdict,
            f"- The closed form costs {min(times):.1f} to {max(times):.1f} ms for any number of oscillations; the cost of"
            " direct integration grows with it.",
            "- The error of direct integration grows with the number of oscillations as well, so that equal tolerances aren't",
            f"  equal errors.  The closed form's has a floor, {floor:.0e} at {long} oscillations: the sample times and the",
            "  period are doubles, and their rounding errors are multiplied by the number of oscillations.",
            f"- The reference has the period {period:.15f} and is periodic up to {defect:.0e}.",
            "",
            "| oscillations | tolerance | method | seconds | error |",
            "|---|---|---|---|---|",
            *(text(row) for row in rows),
            "",
            "| oscillations | tolerance | DOP853's time over the closed form's |",
            "|---|---|---|",
            *(f"| {row.oscillations} | {row.tolerance:.0e} | {ratio:.3g} |" for row, ratio in ratios.items()),
            "",
        ]
    )


def _partner(rows: list[Row], row: Row) -> Row:
    return next(r for r in rows if r.method == "DOP853" and astuple(r)[1:3] == astuple(row)[1:3])


def draw(rows: list[Row], path: Path, long: int) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.8), layout="constrained", dpi=120)
    left, right = figure.subplots(1, 2)
    styles = {"closed form": ("o-", "#1f5f99"), "DOP853": ("s-", "#d9731a"), "Radau": ("^-", "#2f7d4f")}
    for method, (style, colour) in styles.items():
        done = [row for row in rows if row.method == method and row.seconds is not None]
        whole = [row for row in done if row.oscillations == long]
        label = "closed form and quadratures" if method == "closed form" else f"direct integration, {method}"
        if whole:
            left.loglog([row.error for row in whole], [row.seconds for row in whole], style, color=colour, label=label)
        for exponent, line in ((6, ":"), (9, "--"), (12, "-")):
            part = sorted((r.oscillations, r.seconds) for r in done if round(-np.log10(r.tolerance)) == exponent)
            if len(part) > 1:
                label = f"{method}, 1e-{exponent}"
                right.loglog(*zip(*part, strict=True), style[0] + line, color=colour, label=label)
    left.invert_xaxis()
    left.set(xlabel=r"largest error of $u$, $v$, $\omega_3$, $n$ and the contact point", ylabel="processor time (s)")
    left.set_title(f"{long} oscillations; tolerances 1e-3 (left) to 1e-12 (right)", fontsize=10)
    right.set(xlabel="number of oscillations", ylabel="processor time (s)")
    right.set_title("the cost of a longer motion", fontsize=10)
    right.set_ylim(bottom=1e-4)
    left.legend(fontsize=8, loc="center")
    right.legend(title="method, tolerance", fontsize=7.5, title_fontsize=8, ncols=3, loc="lower center")
    for axes in (left, right):
        axes.grid(True, which="major", color="#dddddd")
    figure.savefig(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--oscillations", type=int, default=LONG, help="the longest motion (default %(default)s)")
    parser.add_argument("--results", type=Path, default=RESULTS, help="the folder that is written to")
    options = parser.parse_args()
    period, defect, rows = run(options.oscillations)
    data = {
        "python": platform.python_version(),
        "period": period,
        "defect": defect,
        "rows": [asdict(row) for row in rows],
    }
    (options.results / "motion.json").write_text(json.dumps(data, indent=1) + "\n")
    (options.results / "motion.md").write_text(markdown(period, defect, rows, options.oscillations))
    draw(rows, options.results / "motion.png", options.oscillations)


if __name__ == "__main__":
    main()

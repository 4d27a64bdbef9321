"""Run time against error for the ball's motion: one oscillation and its powers against integration all the way.

    python benchmarks/motion.py      writes benchmarks/results/motion.json, .md and .png; about two minutes of processor time

`kovacic.ball.motion` integrates one oscillation and carries it on by rotations; its rivals are SciPy's DOP853 and Radau on
Newton and Euler's equations with multipliers (`tests/shared/newton_euler.py`), with
rtol = tolerance and atol = tolerance/100, stopped
after PATIENCE seconds.  All give u, the contact point on the ball, omega_3 and n at the same times, spread over the last
oscillation.  Times are processor time from the initial state on.

The reference: the period T and the gain of v by quadratures in 30 digits (`tests/shared/ball_quadratures.py`), and the first
oscillation by the same equations at rtol = 3e-14; its error is about 1e-13, a rounding of the times (3e4) costs 1e-11.
"""

from __future__ import annotations

import sys
import time
from dataclasses import asdict, astuple, dataclass, fields
from pathlib import Path

import frame
import mpmath
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "shared"))
import newton_euler
from ball_quadratures import quadratures

from kovacic.ball import RollingBall
from kovacic.ball.motion import MotionStart, solve_motion

RESULTS = Path(__file__).parent / "results"
SPHERE = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
START = MotionStart(u=1.0, du=0.5, dv=0.25, n=2.0)
BODY = newton_euler.Body(1.0, 1.0, 0.2, 0.25, 1 / 3, 3.0, newton_euler.central(lambda x: 1.0, 1.0, 0.2, 3.0))
SAMPLES, COUNTS = 25, (1, 10, 100, 1000, 10_000)
PATIENCE = 10.0


@dataclass(frozen=True, slots=True)
class Row:
    """One run; `seconds` None means that it was stopped after PATIENCE seconds."""

    method: str
    oscillations: int
    tolerance: float | None
    seconds: float | None
    error: float | None


class Stopped(Exception):
    """An integration took longer than PATIENCE."""


def values(found: dict[str, np.ndarray]) -> np.ndarray:
    return np.column_stack([found["u"], found["omega_3"], found["n"], found["contact_on_ball"]])


def ours(times: np.ndarray) -> np.ndarray:
    motion = solve_motion(SPHERE, START, potential="cos(u)")
    return values({name: getattr(motion, name)(times) for name in ("u", "omega_3", "n", "contact_on_ball")})


def direct(method: str, tolerance: float, times: np.ndarray) -> np.ndarray:
    end = time.process_time() + PATIENCE

    class Watched(newton_euler.Body):
        def rates(self, t: float, y: np.ndarray) -> np.ndarray:
            if time.process_time() > end:
                raise Stopped
            return super().rates(t, y)

    body = Watched(**{field.name: getattr(BODY, field.name) for field in fields(BODY)})
    options = {"method": method, "rtol": tolerance, "atol": tolerance / 100}
    return values(newton_euler.integrate(body, astuple(START), np.concatenate([[0.0], times]), **options))[1:]


def reference() -> tuple[float, dict[int, tuple[np.ndarray, np.ndarray]]]:
    """The period, and for each count of oscillations the sample times with the motion there."""
    with mpmath.workdps(30):
        turning = solve_motion(SPHERE, START, potential="cos(u)").turning_points
        period, gain = quadratures(SPHERE, START, turning)
        shares = np.arange(1, SAMPLES + 1) / (SAMPLES + 1)
        result = {}
        for count in COUNTS:
            times = float(period) * (count - 1 + shares)
            rest = np.array([float(mpmath.mpf(t) - (count - 1) * period) for t in times])
            first = newton_euler.integrate(BODY, astuple(START), np.concatenate([[0.0], rest]))
            turn = float(mpmath.fmod((count - 1) * gain, 2 * mpmath.pi))
            z = (first["contact_on_ball"][:, 0] + 1j * first["contact_on_ball"][:, 1]) * np.exp(1j * turn)
            first["contact_on_ball"][:, 0], first["contact_on_ball"][:, 1] = z.real, z.imag
            result[count] = (times, values(first)[1:])
    return float(period), result


def measure(method: str, count: int, tolerance: float | None, sample: tuple[np.ndarray, np.ndarray]) -> Row:
    """The least time of three runs (one, where it takes seconds): other work on the machine only adds to it."""
    times, exact = sample
    seconds, error = np.inf, 0.0
    for _ in range(3):
        begin = time.process_time()
        try:
            found = ours(times) if tolerance is None else direct(method, tolerance, times)
        except Stopped:
            return Row(method, count, tolerance, None, None)
        seconds, error = min(seconds, time.process_time() - begin), float(np.abs(found - exact).max())
        if seconds > 2:
            break
    return Row(method, count, tolerance, seconds, error)


def run() -> tuple[float, list[Row]]:
    period, samples = reference()
    ours(samples[1][0])  # imports aren't part of the first measurement
    rows: list[Row] = []
    stopped: set[tuple[str, float | None]] = set()
    for count in COUNTS:
        for method, tolerance in (("ours", None), *(("DOP853", 10.0**-k) for k in (4, 6, 8, 10, 12)), ("Radau", 1e-6)):
            if (method, tolerance) in stopped:
                continue
            rows.append(measure(method, count, tolerance, samples[count]))
            if rows[-1].seconds is None:
                stopped.add((method, tolerance))
            print(text(rows[-1]), flush=True)
    return period, rows


def text(row: Row) -> str:
    tolerance = "" if row.tolerance is None else f"{row.tolerance:.0e}"
    seconds = f"more than {PATIENCE:g}" if row.seconds is None else f"{row.seconds:.4f}"
    error = "" if row.error is None else f"{row.error:.1e}"
    return f"| {row.oscillations} | {row.method} | {tolerance} | {seconds} | {error} |"


def markdown(period: float, rows: list[Row]) -> str:
    mine = [row for row in rows if row.method == "ours"]
    return "\n".join(
        [
            "# The motion of the ball: run time against error",
            "",
            "Written by `python benchmarks/motion.py`; see there for what is measured.  Seconds of processor time.",
            "",
            frame.line(),
            "",
            f"- One oscillation and its powers (ours) cost {1000 * min(row.seconds for row in mine):.0f} to"
            f" {1000 * max(row.seconds for row in mine):.0f} ms for any number of oscillations; the cost of direct integration"
            " grows with it, and so does its error.",
            f"- Our error is {mine[0].error:.0e} after one oscillation and {mine[-1].error:.0e} after {mine[-1].oscillations}.",
            f"- The period is {period:.15f}.",
            "",
            "| oscillations | method | tolerance | seconds | error |",
            "|---|---|---|---|---|",
            *(text(row) for row in rows),
            "",
        ]
    )


def draw(rows: list[Row], path: Path) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.8), layout="constrained", dpi=120)
    axes = figure.subplots()
    styles = {"ours": ("o", "#1f5f99"), "DOP853": ("s-", "#d9731a"), "Radau": ("^", "#2f7d4f")}
    for count, alpha in zip(COUNTS, np.linspace(0.3, 1, len(COUNTS)), strict=True):
        for method, (style, colour) in styles.items():
            part = [r for r in rows if (r.method, r.oscillations) == (method, count) and r.seconds is not None]
            if part:
                label = f"{method}, {count}" if method != "Radau" else f"Radau (1e-6), {count}"
                errors, seconds = zip(*((r.error, r.seconds) for r in part), strict=True)
                axes.loglog(errors, seconds, style, color=colour, alpha=alpha, label=label)
    axes.invert_xaxis()
    axes.set(
        xlabel=r"largest error of $u$, $\omega_3$, $n$, the contact point on the ball", ylabel="processor time (s)"
    )
    axes.legend(title="method, oscillations", fontsize=7, title_fontsize=8, ncols=2)
    axes.grid(True, which="major", color="#dddddd")
    figure.savefig(path)


def main() -> None:
    parser = frame.parser(__doc__)
    parser.parse_args()
    period, rows = run()
    frame.save("motion", {"period": period, "rows": [asdict(row) for row in rows]}, markdown(period, rows))
    draw(rows, frame.RESULTS / "motion.png")


if __name__ == "__main__":
    main()

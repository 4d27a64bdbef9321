"""Decisions next to solvable equations, and what each kind of call costs.

Regenerate:  python benchmarks/numeric_decisions.py      writes results/numeric_decisions.{json,md}
"""

from __future__ import annotations

import json
import platform
import subprocess
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"


def timed(action: Callable[[], Any], repeats: int = 5) -> tuple[float, Any]:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = action()
        times.append(time.perf_counter() - start)
    return min(times), result


def ball(ratio: Fraction) -> Any:
    """The rolling ball's normal form for R/R1 = ratio; reducible exactly when 2 R/R1 is an integer."""
    from numeric_work_precision import ball_normal_form

    return ball_normal_form(str(ratio))


def decisions() -> list[dict[str, Any]]:
    import kovacic

    rows = []
    cases: list[tuple[str, str, Any]] = [("x^2 + 3", "exact", "x^2 + 3")]
    cases += [("x^2 + 3 + 10^-k", f"k = {k}", f"x^2 + 3 + 1/10^{k}") for k in (1, 5, 15, 30, 100, 300)]
    cases += [("ball, R/R1 = 1/2 + 10^-k", "exact", ball(Fraction(1, 2)))]
    cases += [
        ("ball, R/R1 = 1/2 + 10^-k", f"k = {k}", ball(Fraction(1, 2) + Fraction(1, 10**k))) for k in (1, 5, 15, 30, 100)
    ]
    for q in (7, 1009, 10**9 + 7, 10**30 + 57):
        e = Fraction(q // 3, q)
        cases.append(("x^e, e = p/q", f"q = {q}", f"({e * (e - 1)})/x^2"))
        cases.append(
            ("exponents p/q at 0, 1, infinity", f"q = {q}", f"({e * (e - 1)})/x^2 + (2/9)/(x-1)^2 + (1/7)/(x*(x-1))")
        )
    for family, parameter, S in cases:
        seconds, verdict = timed(partial(kovacic.decide, S), 3)
        rows.append(
            {
                "family": family,
                "parameter": parameter,
                "status": verdict.status.value,
                "case": verdict.case,
                "seconds": seconds,
            }
        )
        print(rows[-1], flush=True)
    return rows


def skipping() -> list[dict[str, Any]]:
    import kovacic
    from kovacic.numeric.evaluate import evaluate

    rows = []
    for name, S in (
        ("case 1", "x^2 + 3"),
        ("case 2", "(16*x - 3)/(16*x^2)"),
        ("tetrahedral", "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)"),
        ("icosahedral", "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)"),
        ("none", "x"),
    ):
        solution = kovacic.solve(S)
        calls: list[tuple[str, Callable[[], Any]]] = [
            ("decide", partial(kovacic.decide, S)),
            ("solve (with certificate, verified)", partial(kovacic.solve, S)),
            ("15 digits at one point, from S", partial(evaluate, S, 3, x0=2, y0=1, dy0=0)),
            ("1,000 digits at one point, from S", partial(evaluate, S, 3, x0=2, y0=1, dy0=0, digits=1000)),
        ]
        if solution.case is not None:
            calls.append(
                (
                    "15 digits by the closed form",
                    partial(evaluate, solution, 3, x0=2, y0=1, dy0=0, method="closed form"),
                )
            )
        for what, call in calls:
            seconds, _ = timed(call)
            rows.append({"equation": name, "call": what, "seconds": seconds, "loads": loaded(S, what)})
            print(rows[-1], flush=True)
    return rows


def loaded(S: str, what: str) -> list[str]:
    """Which heavy or optional modules a fresh process has loaded after the call."""
    call = {
        "decide": f"kovacic.decide({S!r})",
        "solve (with certificate, verified)": f"kovacic.solve({S!r})",
        "15 digits at one point, from S": f"evaluate({S!r}, 3, x0=2, y0=1, dy0=0)",
        "1,000 digits at one point, from S": f"evaluate({S!r}, 3, x0=2, y0=1, dy0=0, digits=1000)",
        "15 digits by the closed form": f"evaluate(kovacic.solve({S!r}), 3, x0=2, y0=1, dy0=0, method='closed form')",
    }[what]
    watched = ("sympy", "numpy", "mpmath", "matplotlib", "kovacic.closed_form", "kovacic.galois")
    code = (
        f"import sys, kovacic\nfrom kovacic.numeric.evaluate import evaluate\n{call}\n"
        f"print(*[m for m in {watched!r} if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return run.stdout.split()


def main() -> None:
    found, costs = decisions(), skipping()
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "numeric_decisions.json").write_text(
        json.dumps({"decisions": found, "skipping": costs}, indent=1) + "\n"
    )
    head = f"Python {platform.python_version()}.  Regenerate: `python benchmarks/numeric_decisions.py`."
    lines = [
        "# Decision stability",
        "",
        head,
        "",
        "| family | parameter | status | case | seconds |",
        "|---|---|---|---|---|",
    ]
    lines += [
        f"| {r['family']} | {r['parameter']} | {r['status']} | {r['case'] or ''} | {r['seconds']:.4f} |" for r in found
    ]
    lines += [
        "",
        "# What is computed, and what it costs",
        "",
        "*loads*: heavy or optional modules in a fresh process after the call.",
        "",
    ]
    lines += ["| equation | call | seconds | loads |", "|---|---|---|---|"]
    lines += [
        f"| {r['equation']} | {r['call']} | {r['seconds']:.4f} | {', '.join(r['loads']) or 'none'} |" for r in costs
    ]
    (RESULTS / "numeric_decisions.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

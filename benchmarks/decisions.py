"""Decisions next to solvable equations, decimals made exact visibly, and what each kind of call loads and costs.

Regenerate:  python benchmarks/decisions.py      writes results/decisions.{json,md}
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

import frame


def timed(action: Callable[[], Any], repeats: int = 5) -> tuple[float, Any]:
    """The least processor time of some runs, and the last result."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        result = action()
        times.append(time.process_time() - start)
    return min(times), result


def ball(ratio: Fraction) -> Any:
    """The rolling ball's normal form for R/R1 = ratio; reducible exactly when 2 R/R1 is an integer.

    y1 y2 = sqrt(D), w^2 = 2 ratio^2: S from phi = D'/(2 D) and w^2 = f^2 (4 S - 2 phi' - phi^2), D = 5 + 2 x + x^2/2.
    """
    from kovacic.algebra.ratfunc import RatFunc
    from kovacic.algebra.rationals import QQ

    D = RatFunc(QQ.poly([5, 2, Fraction(1, 2)]))
    phi = D.derivative() / (2 * D)
    w2 = ratio**2 * 2
    return (RatFunc(QQ.poly([w2])) / D + 2 * phi.derivative() + phi * phi) / 4


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


def notices() -> list[dict[str, Any]]:
    """Decimals and floats: what they are taken for, and what the answer says about it."""
    import sympy

    import kovacic

    x = sympy.Symbol("x")
    inputs = [
        ('"x^2 + 3.0"', "x^2 + 3.0"),
        ('"x^2 + 3.0000000000000001"', "x^2 + 3.0000000000000001"),
        ('"0.1/x^2"', "0.1/x^2"),
        ("x**2 + 3.0 (SymPy)", x**2 + 3.0),
        ("0.1/x**2 (SymPy)", 0.1 / x**2),
        ("([3.0, 0, 1], [1])", ([3.0, 0, 1], [1])),
        ("([0.1], [0, 0, 1])", ([0.1], [0, 0, 1])),
    ]
    rows = []
    for text, given in inputs:
        try:
            answer = kovacic.solve(given)
        except kovacic.InputError as error:
            rows.append(
                {"input": text, "S": "", "status": "refused", "notices": " ".join(str(error).split()).split("hint:")}
            )
            continue
        rows.append({"input": text, "S": str(answer.S), "status": answer.status.value, "notices": list(answer.notices)})
        print(rows[-1], flush=True)
    return rows


#: What is asked for, and how, for an equation S.
CALLS = {
    "decide": "kovacic.decide(S)",
    "solve (certificate, verified)": "kovacic.solve(S)",
    "group": "kovacic.solve(S).group",
    "one solution: omega or its polynomial": "kovacic.solve(S).riccati.coefficients",
    "both solutions as expressions": "kovacic.solve(S).solutions",
    "15 digits at one point, from S": "kovacic.evaluate(S, 3, x0=2, y0=1, dy0=0)",
    "1,000 digits at one point, from S": "kovacic.evaluate(S, 3, x0=2, y0=1, dy0=0, digits=1000)",
    "15 digits, from the answer": "kovacic.solve(S).at(3, x0=2, y0=1, dy0=0)",
    "15 digits, by the closed form": "kovacic.solve(S).at(3, x0=2, y0=1, dy0=0, method='closed form')",
}
NEEDS_SOLUTION = (
    "one solution: omega or its polynomial",
    "both solutions as expressions",
    "15 digits, by the closed form",
)

#: Parts of the program and libraries: what a call has loaded of these is listed.
PARTS = {
    "engine": "kovacic.engine.decide",
    "galois": "kovacic.galois",
    "closed_form": "kovacic.closed_form",
    "numeric": "kovacic.enclosure.evaluate",
    "SymPy": "sympy",
    "NumPy": "numpy",
    "mpmath": "mpmath",
}


def skipping() -> list[dict[str, Any]]:
    import kovacic

    rows = []
    for name, S in (
        ("case 1", "x^2 + 3"),
        ("case 2", "(16*x - 3)/(16*x^2)"),
        ("tetrahedral", "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)"),
        ("icosahedral", "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)"),
        ("none", "x"),
    ):
        exists = kovacic.solve(S).case is not None
        for what, expression in CALLS.items():
            if not exists and what in NEEDS_SOLUTION:
                continue
            code = compile(expression, what, "eval")
            seconds, _ = timed(partial(eval, code, {"kovacic": kovacic, "S": S}))
            rows.append({"equation": name, "call": what, "seconds": seconds, **fresh(S, expression)})
            print(rows[-1], flush=True)
    return rows


def fresh(S: str, expression: str) -> dict[str, Any]:
    """What a new process has loaded after the call, and the time of its first call (imports included)."""
    code = (
        "import sys, time, kovacic\n"
        f"S, start = {S!r}, time.process_time()\n{expression}\nseconds = time.process_time() - start\n"
        f"print(seconds, *[name for name, module in {PARTS!r}.items() if module in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    seconds, *loads = run.stdout.split()
    return {"first": float(seconds), "loads": loads}


def main() -> None:
    found, exact, costs = decisions(), notices(), skipping()
    head = f"{frame.line()}  Processor times.  Regenerate: `python benchmarks/decisions.py`."
    lines = [
        "# Decision stability",
        "",
        head,
        "",
        "S near a solvable equation is decided as the equation that it is.  For R/R1 = 1/2 + 10^-k the answer is case 2, the",
        "finite group of a rational R/R1, and not case 1; an exponent p/q with a large q is as good as any.",
        "",
        "| family | parameter | status | case | seconds |",
        "|---|---|---|---|---|",
    ]
    lines += [
        f"| {r['family']} | {r['parameter']} | {r['status']} | {r['case'] or ''} | {r['seconds']:.4f} |" for r in found
    ]
    lines += ["", "# Decimals", "", "| input | S | status | notice |", "|---|---|---|---|"]
    lines += [f"| `{r['input']}` | {r['S']} | {r['status']} | {'; '.join(r['notices'])} |" for r in exact]
    lines += [
        "",
        "# What is computed, and what it costs",
        "",
        "*seconds*: the least of five calls; *first*: the first call in a new process, imports included; *loads*: which of the",
        f"parts {', '.join(PARTS)} this process has loaded.",
        "",
    ]
    lines += ["| equation | call | seconds | first | loads |", "|---|---|---|---|---|"]
    lines += [
        f"| {r['equation']} | {r['call']} | {r['seconds']:.4f} | {r['first']:.3f} | {', '.join(r['loads']) or 'none'} |"
        for r in costs
    ]
    frame.save("decisions", {"decisions": found, "notices": exact, "skipping": costs}, "\n".join(lines))


if __name__ == "__main__":
    main()

"""Times, growth and memory of the engine: prints tables, writes benchmarks/results/engine.json and engine.md.

    python benchmarks/engine.py                 # everything: a few minutes
    python benchmarks/engine.py --quick         # up to 20 poles and 100 digits

Measured inside one process after import: `solve` from coefficient sequences, verification included, the median of
several runs, in seconds of processor time (the work is done by one thread, so that on an idle machine it's the wall
clock); then the decision and the verification of the decision alone, the physical limit of any engine whose answers are
checked.  "memory" is the growth of the peak resident set of a fresh process in which
nothing else runs, against one that only imports the package and builds the equation.  "exponent" is the slope of
log(time) over log(parameter) from the second size on; the number of poles is counted, not taken from the name.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import families
import frame

import kovacic
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine import decide as engine
from kovacic.limits import Budget
from kovacic.verify import verify as verified

HERE = Path(__file__).resolve().parent
PUBLISHED = HERE.parent / "tests" / "data" / "cases.jsonl"


@dataclass(frozen=True)
class Measurement:
    """Seconds and MiB for one equation."""

    name: str
    parameter: int
    poles: int
    degree: int
    digits: int
    total: float
    decide: float
    verify: float
    memory: float | None
    resident: float | None


def coefficients(S: RatFunc) -> tuple[Sequence[Any], Sequence[Any]]:
    return S.num.coefficients(), S.den.coefficients()  # type: ignore[attr-defined]


def spent() -> float:
    """Processor time until now, that of finished processes included: polynomials of high degree are factored in one."""
    return sum(os.times()[:4])


def timed(run: Any, budget: float = 1.0) -> tuple[float, Any]:
    """The median time of up to 7 runs, fewer for slow ones; and the last result."""
    times: list[float] = []
    result = None
    while len(times) < 7 and (not times or sum(times) < budget):
        start, start_of_all = time.process_time(), spent()
        result = run()
        own, of_all = time.process_time() - start, spent() - start_of_all
        times.append(of_all if of_all > own + 0.05 else own)  # the latter is the finer clock
    return statistics.median(times), result


def measure(name: str, parameter: int, *, memory: bool) -> Measurement:
    """One equation of `families`; raises SystemExit where the answer isn't the expected one."""
    one = families.sample(name, parameter)
    pair = coefficients(one.S)
    total, answer = timed(lambda: kovacic.solve(pair))
    if answer.case != one.case or answer.status is kovacic.Status.UNDECIDED:
        raise SystemExit(f"{name}, {parameter}: case {answer.case} instead of {one.case}")
    decide, _ = timed(lambda: engine.decide(one.S, Budget()))
    verify, _ = timed(lambda: verified(one.S, answer.decision))
    peak = resident = None
    if memory:
        resident = _peak(name, parameter, "solve")
        peak = max(resident - _peak(name, parameter, "build"), 0.0)
    degree = max(one.S.num.degree, one.S.den.degree)
    digits = int(max(one.S.num.height_bits(), one.S.den.height_bits()) * math.log10(2)) + 1
    return Measurement(name, parameter, one.poles, degree, digits, total, decide, verify, peak, resident)


def _peak(name: str, parameter: int, what: str) -> float:
    command = [sys.executable, str(Path(__file__).resolve()), "--child", what, name, str(parameter)]
    return float(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def child(what: str, name: str, parameter: int) -> None:
    """In a fresh process: build (and solve) one equation, print the peak resident set in MiB."""
    pair = coefficients(families.sample(name, parameter).S)
    if what == "solve":
        kovacic.solve(pair)
    print(peak_resident_set())


def peak_resident_set() -> float:
    """MiB.  On Linux ru_maxrss survives exec and would show the parent's peak; VmHWM is the process's own."""
    status = Path("/proc/self/status")
    if status.exists():
        line = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
        return int(line.split()[1]) / 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024**2 if sys.platform == "darwin" else 1024)


def exponent(points: Sequence[tuple[int, float]]) -> float | None:
    """The least-squares slope of log(time) over log(size), from the second size on."""
    logs = [(math.log(n), math.log(t)) for n, t in points[1:] if n > 0]
    if len({n for n, _ in logs}) < 2:
        return None
    return statistics.linear_regression(*zip(*logs, strict=True)).slope


def published() -> dict[str, Any]:
    """Every entry of cases.jsonl from its text: parsing, decision and verification."""
    rows = []
    for line in PUBLISHED.read_text(encoding="utf-8").splitlines():
        entry = json.loads(line)
        total, answer = timed(lambda text=entry["S"]: kovacic.solve(text), 0.2)
        if answer.case != entry["case"]:
            raise SystemExit(f"{entry['id']}: case {answer.case} instead of {entry['case']}")
        verify, _ = timed(lambda one=answer: verified(one.S, one.decision), 0.2)
        decide, _ = timed(lambda text=entry["S"]: kovacic.decide(text), 0.2)
        rows.append({"id": entry["id"], "total": total, "verify": verify, "decide": decide})
    summary = {
        key: {
            "median": statistics.median(row[key] for row in rows),
            "90%": statistics.quantiles((row[key] for row in rows), n=10)[-1],
            "max": max(row[key] for row in rows),
        }
        for key in ("total", "decide", "verify")
    }
    return {"count": len(rows), "seconds": summary, "slowest": sorted(rows, key=lambda row: -row["total"])[:5]}


def environment() -> dict[str, Any]:
    import flint

    return {
        "kovacic": kovacic.__version__,
        "python": platform.python_version(),
        "python-flint": flint.__version__,
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} CPUs",
        "load at start": round(os.getloadavg()[0], 2),
    }


def markdown(report: dict[str, Any]) -> str:
    """The report as tables."""
    lines = [
        "# The engine, measured",
        "",
        "Written by `python benchmarks/engine.py`; see there for what is measured.",
        "",
    ]
    lines += [", ".join(f"{key} {value}" for key, value in report["environment"].items()) + ".", ""]
    table = report["published"]
    lines += [f"## {table['count']} published equations, from their text (ms)", ""]
    lines += ["| | median | 90% | max |", "|---|---:|---:|---:|"]
    names = {"total": "solve, verified", "decide": "decide", "verify": "verification alone"}
    for key, row in table["seconds"].items():
        lines.append(f"| {names[key]} | " + " | ".join(f"{1000 * row[c]:.1f}" for c in ("median", "90%", "max")) + " |")
    lines += ["", "Slowest: " + ", ".join(f"{r['id']} {1000 * r['total']:.0f} ms" for r in table["slowest"]) + ".", ""]
    titles = {
        "poles": "poles",
        "many poles": "poles, all rational and close together",
        "digits": "digits of the parameters of the construction (digits of the coefficients of S in brackets)",
        "many digits": "digits of the parameters, up to coefficients of 10^5 digits",
        "order": "order of the poles",
        "degree of P": "degree of P",
        "degree of S": "degree of S, a polynomial",
    }
    for kind, title in titles.items():
        chosen = [one for one in report["series"] if one["kind"] == kind]
        if not chosen:
            continue
        lines += [f"## By {title} (seconds: total = decision + verification; MiB)", ""]
        parameters = [m["parameter"] for m in chosen[0]["measurements"]]
        lines += ["| | " + " | ".join(map(str, parameters)) + " | exponent |"]
        lines += ["|---" + "|---:" * (len(parameters) + 1) + "|"]
        for one in chosen:
            slope = "" if one["exponent"] is None else f"{one['exponent']:.1f}"
            lines.append(
                f"| {one['name']} | " + " | ".join(_cell(kind, m) for m in one["measurements"]) + f" | {slope} |"
            )
        lines.append("")
    residents = [m["resident"] for one in report["series"] for m in one["measurements"] if m["resident"] is not None]
    if residents:
        lines += [f"Largest peak resident set of a process that solves one of these: {max(residents):.0f} MiB.", ""]
    return "\n".join(lines)


def _cell(kind: str, m: dict[str, Any]) -> str:
    memory = "" if m["memory"] is None else f"; {m['memory']:.0f}"
    digits = f" ({m['digits']})" if "digits" in kind else ""
    return f"{m['total']:.3f} = {m['decide']:.3f} + {m['verify']:.3f}{memory}{digits}"


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="small sizes, no memory, nothing written")
    parser.add_argument("--only", default="", help="only the series whose names contain this; nothing written")
    parser.add_argument("--child", nargs=3, metavar=("WHAT", "NAME", "PARAMETER"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        child(options.child[0], options.child[1], int(options.child[2]))
        return
    report: dict[str, Any] = {"environment": environment(), "published": published(), "series": []}
    small = {"poles": 20, "many poles": 100, "digits": 100, "many digits": 0, "degree of P": 1000, "degree of S": 1000}
    largest = small if options.quick else {}
    for kind, items in families.series():
        chosen = [(name, k) for name, k in items if options.only in name and k <= largest.get(kind, k)]
        if not chosen:
            continue
        results = []
        for name, parameter in chosen:
            results.append(measure(name, parameter, memory=not options.quick))
            m = results[-1]
            print(
                f"{name:32} {parameter:5}  {m.poles:3} poles  decide {m.decide:8.3f} s  verify {m.verify:8.3f} s",
                flush=True,
            )
        size = (lambda m: m.poles) if kind == "poles" else (lambda m: m.parameter)
        slope = exponent([(size(m), m.total) for m in results])
        report["series"].append(
            {"kind": kind, "name": chosen[0][0], "exponent": slope, "measurements": [asdict(m) for m in results]}
        )
    text = markdown(report)
    print("\n" + text)
    if not options.quick and not options.only:
        frame.save("engine", report, text)


if __name__ == "__main__":
    main()

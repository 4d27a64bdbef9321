"""Times of `kovacic.conditions`, of generic answers, and of answers over number fields.

    python benchmarks/conditions.py               # under a minute
    python benchmarks/conditions.py --samples 200 # also the agreement with the engine at exact points
    python benchmarks/conditions.py --check 100   # only that, for the families of parametric_families.jsonl: 20,000 points

Processor time inside one process, in milliseconds: the first call for conditions (nothing is cached), the median of several
calls for answers.  Writes benchmarks/results/conditions.json.
"""

from __future__ import annotations

import json
import re
import statistics
import sys
import time
from pathlib import Path
from typing import Any

import frame

import kovacic

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "tests" / "shared"), str(HERE.parent / "tests" / "algebra")]
from parametric_cases import BALL, FAMILIES, hypergeometric  # noqa: E402
from test_algebraic_constants import ENTRIES  # noqa: E402

RUNS = 5

#: Beside the families of the tests: the largest parts of parameter space.
LARGE = {
    "riemann, three exponents": hypergeometric(("l", "m", "n")),
    "yoshida, degree 3": "((24*lam-35)*x^2 + (40-24*lam)*x - 32)/(144*x^2*(x-1)^2)",
    "quadratic potential": "a*x^2 + b*x + c",
    "sextic oscillator": "x^6 + a*x^2 + b",
}
GENERIC = {
    "bessel": "(4*n^2-1)/(4*x^2) - 1",
    "case 1": "(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2",
    "ball on the sphere": BALL,
}


def seconds(call: Any) -> float:
    start = time.process_time()
    call()
    return time.process_time() - start


def check(samples: int, seed: int) -> int:
    """Agreement of every family with the engine at so many exact points; 1 where one disagrees."""
    totals, wrong = [0, 0, 0], 0
    families = [json.loads(line) for line in (HERE / "parametric_families.jsonl").read_text().splitlines()]
    for family in families:
        names = re.findall(r"[a-z]\w+", family["S"])  # of more than one letter
        answer = kovacic.conditions(family["S"], var="x", parameters=names, limits=kovacic.Limits(seconds=10))
        report = answer.check(samples, seed=seed)
        counts = (report.inside, report.outside, report.open)
        totals = [a + b for a, b in zip(totals, counts, strict=True)]
        wrong += len(report.disagreements)
        print(
            f"{family['name']:45.45} {counts[0]:5} {counts[1]:5} {counts[2]:5}  {report.disagreements or ''}",
            flush=True,
        )
    print(
        f"{len(families)} families: {totals[0]} points inside, {totals[1]} outside, {totals[2]} open; {wrong} disagree"
    )
    return int(wrong > 0)


def main() -> int:
    parser = frame.parser(__doc__)
    parser.add_argument("--samples", type=int, default=0)
    parser.add_argument("--check", type=int, metavar="N", help="N points for each of the families, and nothing else")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.check:
        return check(options.check, options.seed)
    results: dict[str, Any] = {}
    conditions: dict[str, Any] = {}
    print(f"{'conditions':30} {'ms':>8}  complete  samples")
    for name, S in {**{family.name: family.S for family in FAMILIES}, **LARGE}.items():
        spent = seconds(lambda S=S: kovacic.conditions(S, var="x"))
        answer = kovacic.conditions(S, var="x")
        row: dict[str, Any] = {"milliseconds": 1000 * spent, "complete": answer.complete}
        agreement = ""
        if options.samples:
            report = answer.check(options.samples)
            row |= {"inside": report.inside, "outside": report.outside, "agree": bool(report)}
            agreement = f"{report.inside} + {report.outside} {'agree' if report else 'DISAGREE'}"
        conditions[name] = row
        print(f"{name:30} {1000 * spent:8.1f}  {answer.complete is True!s:8}  {agreement}")
    results["conditions"] = conditions
    for title, entries in (("generic", GENERIC), ("algebraic", {S: S for S, _ in ENTRIES})):
        times = {}
        for name, S in entries.items():
            kovacic.solve(S, var="x")
            times[name] = 1000 * statistics.median(seconds(lambda S=S: kovacic.solve(S, var="x")) for _ in range(RUNS))
        results[title] = {"milliseconds": times, "median": statistics.median(times.values())}
        print(f"\n{title} answers: median {results[title]['median']:.1f} ms, largest {max(times.values()):.1f} ms")
    frame.save("conditions", results)
    return 0


if __name__ == "__main__":
    sys.exit(main())

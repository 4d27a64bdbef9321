"""How many generated pull-backs of each standard equation are found, and the time from S to the solutions; then the same for
the equations of SymPy's and Maxima's tests that have no Liouvillian solution (tests/data/special.jsonl).

python benchmarks/special.py [count for each kind and degree] [largest degree]
"""

from __future__ import annotations

import json
import sys
import time
from collections import Counter
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from special_cases import KINDS, pull_backs

from kovacic.limits import Budget, Limits
from kovacic.reading.read import read_input
from kovacic.special.search import Wanted, find, special_functions


def main(count: int, largest: int) -> None:
    print(f"{'kind':24} {'degree':>6} {'found':>9} {'search ms':>10} {'all ms':>8} {'slowest':>8}")
    for kind in KINDS:
        for degree in range(1, largest + 1):
            found, search, whole = Counter[bool](), [], []
            for case in pull_backs(count, kinds=(kind,), degrees=range(degree, degree + 1), seed=degree):
                limits = Limits(seconds=10)
                start = time.process_time()
                find(case.S, Budget(limits))
                middle = time.process_time()
                answer = special_functions(Wanted(case.S, case.S * 0, "x"), Budget(limits))
                whole.append(time.process_time() - middle)
                search.append(middle - start)
                found[bool(answer)] += 1
                if not answer and "-v" in sys.argv:
                    print("  not found:", case.f, "|", case.S)
            times = " ".join(f"{1000 * value:8.1f}" for value in (median(search), median(whole), max(whole)))
            print(f"{kind:24} {degree:6} {found[True]:4} of {count:3} {times}")


def corpus() -> None:
    """The equations as they are published, most of them with parameters; some need functions that SymPy hasn't."""
    found, times = Counter[str](), []
    for line in (Path(__file__).parent.parent / "tests" / "data" / "special.jsonl").read_text().splitlines():
        row = json.loads(line)
        parsed = read_input(row["equation"], var="x")
        assert parsed.equation is not None
        start = time.process_time()
        answer = special_functions(Wanted(parsed.S, parsed.equation.gauge, "x"), Budget(Limits(seconds=30)))
        times.append(time.process_time() - start)
        found["found" if answer else row.get("other", "not found")] += 1
    print(f"published: {dict(found)}; median {1000 * median(times):.1f} ms, slowest {1000 * max(times):.0f} ms")


if __name__ == "__main__":
    numbers = [int(argument) for argument in sys.argv[1:] if argument.isdigit()]
    main(*(numbers + [20, 4][len(numbers) :]))
    corpus()

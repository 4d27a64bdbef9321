"""Times of a full answer: verdict, verified omega and two checked solutions in closed form, from the text.

    python benchmarks/closed_forms.py            # textbook equations, and the published ones; under a minute
    python benchmarks/closed_forms.py --show     # prints the solutions too

Measured inside one process after one warm-up run of everything (imports, SymPy's own caches for constants), the median
of several runs, in milliseconds of processor time.  SymPy's expression cache is cleared before every run, so that no
answer is looked up.  "full" is reading, deciding, verifying, building and checking; "closed form" the last two.
Writes benchmarks/results/closed_forms.json.
"""

from __future__ import annotations

import json
import statistics
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import frame
from sympy.core.cache import clear_cache

import kovacic

HERE = Path(__file__).resolve().parent
PUBLISHED = HERE.parent / "tests" / "data" / "cases.jsonl"
RUNS = 5

TEXTBOOK = (
    # Constant coefficients.
    "y'' + y = 0",
    "y'' - y = 0",
    "y'' + 4*y' + 4*y = 0",
    "y'' + 2*y' + 5*y = 0",
    "y'' - 5*y' + 6*y = 0",
    "y'' - 3*y = 0",
    # Euler.
    "x^2*y'' + x*y' - y = 0",
    "x^2*y'' - 3*x*y' + 4*y = 0",
    "x^2*y'' + x*y' + 4*y = 0",
    "x^2*y'' - 2*y = 0",
    "2*x^2*y'' + 3*x*y' - y = 0",
    "x^2*y'' + 3*x*y' + 5*y = 0",
    "(x-1)^2*y'' + 2*(x-1)*y' - 6*y = 0",
    # Bessel, of half-integer order; spherical and modified Bessel.
    "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0",
    "x^2*y'' + x*y' + (x^2 - 9/4)*y = 0",
    "x^2*y'' + x*y' + (x^2 - 25/4)*y = 0",
    "x^2*y'' + x*y' - (x^2 + 1/4)*y = 0",
    "x^2*y'' + x*y' - (x^2 + 9/4)*y = 0",
    "x^2*y'' + 2*x*y' + x^2*y = 0",
    "x^2*y'' + 2*x*y' + (x^2 - 2)*y = 0",
    "x*y'' + 2*y' - x*y = 0",
    # Legendre, associated Legendre, Chebyshev, Gegenbauer.
    "(1-x^2)*y'' - 2*x*y' = 0",
    "(1-x^2)*y'' - 2*x*y' + 2*y = 0",
    "(1-x^2)*y'' - 2*x*y' + 6*y = 0",
    "(1-x^2)*y'' - 2*x*y' + 12*y = 0",
    "(1-x^2)*y'' - 2*x*y' + (2 - 1/(1-x^2))*y = 0",
    "(1-x^2)*y'' - 2*x*y' + (6 - 4/(1-x^2))*y = 0",
    "(1-x^2)*y'' - x*y' + y = 0",
    "(1-x^2)*y'' - x*y' + 4*y = 0",
    "(1-x^2)*y'' - x*y' + 9*y = 0",
    "(1-x^2)*y'' - x*y' + y/4 = 0",
    "(1-x^2)*y'' - x*y' + y/9 = 0",
    "(1-x^2)*y'' - 3*x*y' + 8*y = 0",
    "(1-x^2)*y'' - 5*x*y' + 5*y = 0",
    # Hermite, Laguerre, Weber, Whittaker, confluent hypergeometric.
    "y'' - 2*x*y' + 2*y = 0",
    "y'' - 2*x*y' + 4*y = 0",
    "y'' - x*y' + 3*y = 0",
    "y'' = (x^2 - 5)*y",
    "y'' = (x^2 + 3)*y",
    "x*y'' + (1-x)*y' + y = 0",
    "x*y'' + (1-x)*y' + 2*y = 0",
    "x*y'' + (2-x)*y' + 2*y = 0",
    "x*y'' + (1/2-x)*y' + y = 0",
    "x*y'' - (x+3)*y' + 3*y = 0",
    "y'' = (1/4 - 1/x)*y",
    # Hypergeometric and others.
    "x*(1-x)*y'' + (1/2 - x)*y' + y = 0",
    "x*(1-x)*y'' + (2 - 4*x)*y' - 2*y = 0",
    "(1+x^2)*y'' + x*y' - y = 0",
    "(1+x^2)*y'' - 2*x*y' + 2*y = 0",
    "x*y'' - y' + 4*x^3*y = 0",
    "4*x*y'' + 2*y' + y = 0",
    "x^4*y'' + y = 0",
    "x*y'' - (2*x+1)*y' + (x+1)*y = 0",
    "y'' - 2*y/x^2 = 0",
    "(x^2-1)*y'' - 6*y = 0",
)


@dataclass(frozen=True)
class Row:
    """Milliseconds of processor time for one equation."""

    equation: str
    full: float
    closed_form: float
    checked: str
    notes: tuple[str, ...]
    solutions: tuple[str, str]


def measure(equation: str, runs: int = RUNS) -> Row | None:
    """The median times; None if there is no Liouvillian solution."""
    full, part = [], []
    form = None
    for _ in range(runs):
        clear_cache()
        start = time.process_time()
        answer = kovacic.solve(equation)
        middle = time.process_time()
        form = answer.closed_form
        end = time.process_time()
        if form is None:
            return None
        full.append(1e3 * (end - start))
        part.append(1e3 * (end - middle))
    assert form is not None
    return Row(
        equation[:100],
        statistics.median(full),
        statistics.median(part),
        form.checked,
        form.notes,
        (str(form.y1)[:300], str(form.y2)[:300]),
    )


def published() -> dict[str, str]:
    """The normal forms, by name."""
    rows = map(json.loads, PUBLISHED.read_text(encoding="utf-8").splitlines())
    return {row["id"]: row["S"] for row in rows if "S" in row}


def summary(name: str, rows: list[Row]) -> str:
    full = sorted(row.full for row in rows)
    part = sorted(row.closed_form for row in rows)
    open_integrals = sum(bool(row.notes) for row in rows)
    return (
        f"{name}: {len(rows)} equations, full answer median {statistics.median(full):.1f} ms, "
        f"90 % within {full[9 * len(full) // 10]:.1f} ms, largest {full[-1]:.1f} ms; closed form and its check: median "
        f"{statistics.median(part):.1f} ms; {open_integrals} with an integral left or a constant explained"
    )


def main() -> None:
    parser = frame.parser(__doc__)
    parser.add_argument("--show", action="store_true", help="print the solutions")
    options = parser.parse_args()
    groups = {"textbook": list(TEXTBOOK), "published": list(published().values())}
    results: dict[str, list[Row]] = {}
    for name, equations in groups.items():
        for equation in equations:
            measure(equation, 1)
        results[name] = [row for equation in equations if (row := measure(equation)) is not None]
        print(summary(name, results[name]))
        if options.show:
            for row in results[name]:
                y1, y2 = row.solutions
                print(f"  {row.full:7.1f}  {row.equation[:60]}\n           {y1}\n           {y2}")
    frame.save("closed_forms", {"rows": {name: [asdict(row) for row in rows] for name, rows in results.items()}})


if __name__ == "__main__":
    main()

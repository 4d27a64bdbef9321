"""Lifting one invariant to the rational numbers: by primes, and by its recurrence; and large polynomial solutions.

    python benchmarks/lifting.py        prints a table and writes benchmarks/results/lifting.json and .md

Both ways start from the same degree bound N.  `kovacic.engine.invariants` begins with primes and changes to the recurrence when
that is expected to be cheaper; the columns show what each way takes alone, and what `invariants` takes.  The last table
shows why series at ordinary points come from Newton's iteration and from no recurrence.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from operator import mul
from pathlib import Path
from typing import Any
from unittest import mock

import frame
from flint import nmod_poly

import kovacic
from kovacic.algebra.lifting import prime
from kovacic.algebra.modular import fundamental_system
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.engine import invariants
from kovacic.engine.decide import decide
from kovacic.engine.expansion import polynomial_invariant
from kovacic.engine.places import analyse
from kovacic.limits import Budget
from kovacic.verify import verify

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "shared"))
import transform

X = RatFunc(QQ.poly([0, 1]))
HALF, THIRD = Fraction(1, 2), Fraction(1, 3)
#: Prime by prime takes minutes above this degree bound, so it isn't run there.
LARGEST_BY_PRIMES = 200


def seconds(function: Callable[[], object]) -> float:
    """Wall-clock time of one call."""
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def invariant_rows() -> list[dict[str, object]]:
    """Invariants of Schwarz's equations with shifted exponents, and of a pull-back with more poles."""
    equations = [
        (f"icosahedral, shifted by {k}", transform.hypergeometric(HALF + k, THIRD, Fraction(1, 5)), 12)
        for k in (2, 4, 8, 20, 56, 112, 168)
    ]
    f = RatFunc(QQ.poly([3, -1, 2, 5, 1]))
    equations += [
        (
            f"octahedral, shifted by {k}, pull-back",
            transform.pull_back(transform.hypergeometric(HALF + k, THIRD, Fraction(1, 4)), f),
            8,
        )
        for k in (2, 8)
    ]
    return [_invariant_row(name, S, m) for name, S, m in equations]


def _invariant_row(name: str, S: RatFunc, m: int) -> dict[str, object]:
    problem = analyse(S, Budget())
    bound = invariants.bounds(problem, m)
    if bound is None:
        raise AssertionError("these equations have invariants")
    valuations, N = bound
    by_primes = None
    if N <= LARGEST_BY_PRIMES:
        with mock.patch.object(invariants, "polynomial_invariant", return_value=None):
            by_primes = seconds(lambda: invariants.invariants(problem, m))
    return {
        "equation": name,
        "poles": S.den.degree // 2,
        "N": N,
        "primes": by_primes,
        "recurrence": seconds(lambda: polynomial_invariant(problem, m, N, valuations)),
        "invariants": seconds(lambda: invariants.invariants(problem, m)),
    }


def solution_rows() -> list[dict[str, object]]:
    """Equations whose solutions have polynomials of high degree: decision and verification together."""
    equations = [(f"Hermite, degree {d}", X**2 - (2 * d + 1)) for d in (500, 1000, 2000)]
    equations += [(f"Legendre, degree {d}", (d * (d + 1) * (X**2 - 1) - 1) / (X**2 - 1) ** 2) for d in (500, 2000)]
    rows: list[dict[str, object]] = []
    for name, S in equations:
        start = time.perf_counter()
        decision = decide(S, Budget())
        decided = time.perf_counter()
        if not verify(S, decision):
            raise AssertionError(f"{name} isn't verified")
        rows.append({"equation": name, "decide": decided - start, "verify": time.perf_counter() - decided})
    return rows


def _by_recurrence(num: Any, den: Any, order: int, first: int, second: int) -> list[int]:
    """The solution y = first + second t + ... of den y'' = num y modulo p, coefficient by coefficient."""
    p, a, b = den.modulus(), [int(c) for c in den.coeffs()], [int(c) for c in num.coeffs()]
    y, weighted, inverse = [first, second], [0, 0], pow(a[0], -1, p)  # weighted: k (k - 1) y_k
    for k in range(2, order):
        total = sum(map(mul, b, y[k - 2 :: -1])) - sum(map(mul, a[1:], weighted[::-1]))
        weighted.append(total * inverse % p)
        y.append(weighted[k] * pow(k * (k - 1), -1, p) % p)
    return y


def series_rows() -> list[dict[str, object]]:
    """Both solutions at an ordinary point modulo a prime: Newton's iteration, which the engine uses, and the recurrence."""
    rows: list[dict[str, object]] = []
    p = prime(0)
    for degree in (2, 10, 40):
        den, num = (nmod_poly([pow(7, 13 * k + start, p) for k in range(degree + 1)], p) for start in (1, 5))
        for order in (4, 8, 16, 32, 128, 512, 2048):
            y1, y2 = fundamental_system(num, den, order)
            plain = [_by_recurrence(num, den, order, *start) for start in ((1, 0), (0, 1))]
            if [[int(y[k]) for k in range(order)] for y in (y1, y2)] != plain:
                raise AssertionError("both ways give the same series")
            newton = least(partial(fundamental_system, num, den, order))
            recurrence = least(lambda n=num, d=den, k=order: [_by_recurrence(n, d, k, *s) for s in ((1, 0), (0, 1))])
            rows.append({"degree of S": degree, "terms": order, "Newton, us": newton, "recurrence, us": recurrence})
    return rows


def least(function: Callable[[], object]) -> str:
    """Microseconds of processor time, the least of several runs."""
    times = []
    for _ in range(7):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return f"{1e6 * min(times):.0f}"


def _cell(value: object) -> str:
    return "-" if value is None else f"{value:.3f}" if isinstance(value, float) else str(value)


def _table(rows: list[dict[str, object]]) -> str:
    names = list(rows[0])
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    return "\n".join(lines + ["| " + " | ".join(_cell(row[name]) for name in names) + " |" for row in rows])


def main() -> None:
    kovacic.solve("x^2 + 3")
    found = {"invariants": invariant_rows(), "solutions": solution_rows(), "series": series_rows()}
    text = "\n\n".join(
        [
            "# Lifting\n\nWritten by `python benchmarks/lifting.py`; see there for what is measured.  Times in seconds.",
            frame.line(),
            _table(found["invariants"]),
            _table(found["solutions"]),
            "Series modulo a prime near 2^60 at an ordinary point, both solutions:",
            _table(found["series"]),
        ]
    )
    frame.save("lifting", found, text)
    print(text)


if __name__ == "__main__":
    main()

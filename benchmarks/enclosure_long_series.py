"""Cost of the Taylor route against the digits: term by term and by binary splitting, and where one takes over.

Regenerate:  python benchmarks/enclosure_long_series.py
writes results/enclosure_long_series.{json,md} (about five minutes).  Times are processor times of one call of `evaluate`,
the least of several runs where they are short; the load of the machine is stored with them.
"""

from __future__ import annotations

import math
import multiprocessing
import os
import time
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from typing import Any

import frame

from kovacic.enclosure import rational
from kovacic.enclosure.evaluate import evaluate
from kovacic.enclosure.splitting import is_split
from kovacic.limits import Limits
from kovacic.reading.read import read_input

DIGITS = (300, 1_000, 3_000, 10_000, 30_000, 100_000)
PATIENCE = 3.0
"""Term by term is followed to more digits while its last time is below this; the choice, below three times this."""

# nu = 1/3: y = sqrt(1 - x^2) P_nu(x)
LEGENDRE = "-(4/9*(1-x^2) + 1)/(1-x^2)^2"
SEVENTH = f"{Fraction(2 * 7**4000, 7**4001 + 1)}"
# name, S, x0, x
PROBLEMS: list[tuple[str, str, Any, Any]] = [
    ("Airy, 0 to 1", "x", 0, 1),
    ("Airy, 0 to 1 + i", "x", 0, 1 + 1j),
    ("Legendre, degree 1/3, 0 to 1/3", LEGENDRE, 0, "1/3"),
    ("Legendre, degree 1/3, 0 to 0.3141592653589793", LEGENDRE, 0, "0.3141592653589793"),
    ("Legendre, degree 1/3, 0 to a fraction of 3,400 digits", LEGENDRE, 0, SEVENTH),
    ("tetrahedral, 2 to 3", "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)", 2, 3),
]
ORDERS = [
    ("1", 0, 1),
    ("x", 0, 1),
    ("x^4 + 1", 0, 1),
    ("x^8 + x + 3", 0, 1),
    (LEGENDRE, 0, "1/3"),
    (LEGENDRE, "1/4", 0.25 + 0.3j),
    ("(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)", 2, 3),
    ("(x^2 + 3)/(x^6 + x + 5)", 0, "3/2"),
]


def seconds(text: str, x0: Any, x: Any, digits: int, split: bool | None) -> float:
    """Processor time; `split` forces one of the ways, None leaves the choice to the package.

    In a process of its own: what ran before leaves the memory allocator in a state that costs up to ten times as much.
    """
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=1, mp_context=spawn) as pool:
        return pool.submit(measure, text, x0, x, digits, split).result()


def measure(text: str, x0: Any, x: Any, digits: int, split: bool | None) -> float:
    if split is not None:
        rational.is_split = lambda *_: split  # type: ignore[assignment]
    S, times, limits = read_input(text).S, [], Limits(digits=10**6, seconds=math.inf)
    evaluate(S, x, x0=x0, y0=1, dy0=0, digits=50, method="taylor")
    while not times or (sum(times) < 0.3 and len(times) < 10):
        start = time.process_time()
        evaluate(S, x, x0=x0, y0=1, dy0=0, digits=digits, method="taylor", limits=limits)
        times.append(time.process_time() - start)
    return min(times)


def one_product(digits: int) -> float:
    """Processor time of the product of two integers of that many digits: what "near-linear" is measured against."""
    from flint import fmpz

    a, count, start = fmpz(3) ** int(digits / math.log10(3)), 0, time.process_time()
    while time.process_time() - start < 0.2:
        a * (a + count)
        count += 1
    return (time.process_time() - start) / count


def growth() -> list[dict[str, Any]]:
    rows = [
        {"problem": "one product of two integers", "method": "FLINT", "digits": digits, "seconds": one_product(digits)}
        for digits in DIGITS
    ]
    for name, text, x0, x in PROBLEMS:
        for method, split, patience in (("term by term", False, PATIENCE), ("as chosen", None, 3 * PATIENCE)):
            last = 0.0
            for digits in DIGITS:
                if last > patience:
                    break
                last = seconds(text, x0, x, digits, split)
                rows.append({"problem": name, "method": method, "digits": digits, "seconds": last})
                print(rows[-1], flush=True)
    return rows


def exponent(rows: list[dict[str, Any]]) -> float | None:
    """The least-squares slope of log(seconds) against log(digits) from 3,000 digits on."""
    points = [(math.log(r["digits"]), math.log(r["seconds"])) for r in rows if r["digits"] >= 3_000]
    if len(points) < 2:
        return None
    x, y = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def crossover() -> list[dict[str, Any]]:
    """Both ways by the order of the recurrence, on both sides of the bound of `is_split`."""
    rows = []
    for text, x0, x in ORDERS:
        S = read_input(text).S
        order = max(2, S.num.degree + 2, S.den.degree)
        for digits in (500, 1_000, 2_000, 4_000, 8_000, 16_000):
            one, other = (seconds(text, x0, x, digits, split) for split in (False, True))
            rows.append(
                {
                    "S": text,
                    "to": str(x),
                    "order": order,
                    "digits": digits,
                    "term by term": one,
                    "splitting": other,
                    "chosen": chosen(S, digits),
                }
            )
            print(rows[-1], flush=True)
    return rows


def chosen(S: Any, digits: int) -> str:
    from kovacic.enclosure.precision import start_bits
    from kovacic.enclosure.problem import as_problem

    return "splitting" if is_split(as_problem(S).system, start_bits(digits)) else "term by term"


def markdown(data: dict[str, Any]) -> str:
    def table(head: tuple[str, ...], lines: list[tuple[str, ...]]) -> list[str]:
        return ["| " + " | ".join(line) + " |" for line in (head, ("---",) * len(head), *lines)]

    found = {(r["problem"], r["method"], r["digits"]): r["seconds"] for r in data["growth"]}
    lines = []
    for key in dict.fromkeys((r["problem"], r["method"]) for r in data["growth"]):
        cells = [f"{found[*key, d]:.2g}" if (*key, d) in found else "" for d in DIGITS]
        slope = data["exponents"][" / ".join(key)]
        lines.append((*key, *cells, "" if slope is None else f"{slope:.2f}"))
    parts = [
        "# Cost of the Taylor route against the digits",
        "",
        f"{frame.line()}  Load {data['load'][0]:.1f} at the start, {data['load'][1]:.1f} at the end.",
        "Regenerate: `python benchmarks/enclosure_long_series.py`.",
        "",
        "Seconds of processor time of one call of `evaluate`; the exponent k of digits^k is fitted from 3,000 digits on.",
        "Empty: not waited for.  The exponent of one product is what near-linear methods can have at these lengths, up to",
        "powers of the logarithm.",
        "",
        *table(("problem", "way", *(f"{d:,}" for d in DIGITS), "exponent"), lines),
        "",
        "## Where splitting takes over",
        "",
        "Milliseconds of either way by the order r of the recurrence, and the one that is chosen.",
        "",
        *table(
            ("S", "to", "r", "digits", "term by term", "splitting", "chosen"),
            [
                (
                    f"`{r['S']}`",
                    r["to"],
                    str(r["order"]),
                    f"{r['digits']:,}",
                    f"{1000 * r['term by term']:.1f}",
                    f"{1000 * r['splitting']:.1f}",
                    r["chosen"],
                )
                for r in data["crossover"]
            ],
        ),
    ]
    return "\n".join(parts) + "\n"


def main() -> None:
    before = os.getloadavg()[0]
    rows = growth()
    data: dict[str, Any] = {
        "growth": rows,
        "exponents": {
            f"{name} / {method}": exponent([r for r in rows if (r["problem"], r["method"]) == (name, method)])
            for name, method in dict.fromkeys((r["problem"], r["method"]) for r in rows)
        },
        "crossover": crossover(),
    }
    data["load"] = [before, os.getloadavg()[0]]
    text = markdown(data)
    frame.save("enclosure_long_series", data, text)
    print(text)


if __name__ == "__main__":
    main()

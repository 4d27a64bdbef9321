"""What a block with a working precision costs beside FLINT's operations, and how many of either a value takes.

Regenerate:  python benchmarks/precision.py      writes results/precision.{json,md}
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import frame

BITS = (100, 1000, 10_000)
EXAMPLES = {
    "y'' = x y, Taylor": {"equation": "x", "method": "taylor"},
    "y'' = x y, FLINT's function": {"equation": "x", "method": "closed form"},
    "y'' = (x^3 + x + 1) y": {"equation": "x^3 + x + 1"},
    "a constant": {"equation": "sqrt(2)*x^3 + x + 1"},
    "a right-hand side": {"equation": "y'' = x*y + exp(x)"},
}


def each(action: Callable[[], Any], repeats: int = 20_000) -> float:
    """Processor seconds of one call: the least of five averages."""
    action()
    found = []
    for _ in range(5):
        start = time.process_time()
        for _ in range(repeats):
            action()
        found.append((time.process_time() - start) / repeats)
    return min(found)


def operations() -> list[dict[str, Any]]:
    from flint import acb, acb_poly

    from kovacic.algebra.precision import working_precision

    def block() -> None:
        with working_precision(200):
            pass

    rows = [{"what": "a block with another precision", "seconds": each(block)}]
    for bits in BITS:
        with working_precision(bits):
            z = acb(2).sqrt() + acb(0, 3).sqrt()
            p = acb_poly([z] * 30)
            few = max(20, 200_000 // bits)
            rows.append({"what": f"z z, {bits} bits", "seconds": each(lambda z=z: z * z, few)})
            rows.append({"what": f"exp z, {bits} bits", "seconds": each(lambda z=z: z.exp(), few)})
            rows.append({"what": f"p(z) of degree 29, {bits} bits", "seconds": each(lambda z=z, p=p: p(z), few)})
    return rows


def blocks() -> list[dict[str, Any]]:
    """How many blocks the values take, counted, and the seconds of the first call."""
    import sys

    import kovacic
    from kovacic.algebra import precision as points

    original, counts = points.working_precision, [0]

    @contextmanager
    def counted(bits: int) -> Iterator[None]:
        counts[0] += 1
        with original(bits):
            yield

    kovacic.evaluate("x + 7/3", 1, x0=0, y0=1, dy0=0)  # everything is imported
    for module in [module for name, module in sys.modules.items() if name.startswith("kovacic.")]:
        if getattr(module, "working_precision", None) is original:
            module.working_precision = counted  # type: ignore[attr-defined]
    rows = []
    for name, options in EXAMPLES.items():
        counts[0] = 0
        start = time.process_time()
        kovacic.evaluate(x=5, x0=0, y0=1, dy0=0, digits=30, **options)  # type: ignore[call-overload]
        rows.append({"value": name, "blocks": counts[0], "seconds": time.process_time() - start})
    return rows


def main() -> None:
    costs, counted = operations(), blocks()
    lines = [
        "# Precision: a state of FLINT, and not an argument",
        "",
        f"{frame.line()}  Processor times.  Regenerate: `python benchmarks/precision.py`.",
        "",
        "| operation | microseconds |",
        "|---|---|",
        *(f"| {row['what']} | {1e6 * row['seconds']:.2f} |" for row in costs),
        "",
        "Values to 30 digits at x = 5, from 0; *blocks* are those in which another precision is in force.",
        "",
        "| value | blocks | milliseconds | part of the blocks |",
        "|---|---|---|---|",
    ]
    for row in counted:
        part = row["blocks"] * costs[0]["seconds"] / row["seconds"]
        lines.append(f"| {row['value']} | {row['blocks']} | {1000 * row['seconds']:.1f} | {100 * part:.1f} % |")
    frame.save("precision", {"operations": costs, "blocks": counted}, "\n".join(lines))


if __name__ == "__main__":
    main()

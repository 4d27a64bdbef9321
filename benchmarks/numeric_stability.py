"""Stability: digits requested, digits obtained, digits that a naive double-precision evaluation of the same
expression keeps.

Regenerate:  python benchmarks/numeric_stability.py      writes results/numeric_stability.{json,md}

Every solution is known in closed form; it is evaluated by mpmath at 120 digits and more (the reference), by SymPy's
lambdify with NumPy
(naive, expanded where the family says so), and by the Taylor route, which knows nothing of the closed form.  "right"
says that the reference
lies in the ball.
"""

# ruff: noqa: PERF401 (one append a family reads better than nested generators)

from __future__ import annotations

import json
import math
import platform
import time
import warnings
from fractions import Fraction
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"
DIGITS = 30


def families() -> list[tuple[str, str, str, str, str, str]]:
    """(family, parameter, solution, S, x0, x)."""
    rows = []
    for k in (0, 1, 3, 10, 20, 30):
        d = f"1/10^{k}" if k else "1"
        y = f"(x-1)^(1/3)*(x-1-{d})^(-1/3)"
        rows.append(
            ("confluent singular points", f"distance 1e-{k}", y, _from_logs(("1/3", "1"), ("-1/3", f"1+{d}")), "5", "3")
        )
    for k in (1, 3, 10, 20, 30):
        y = "(x-1)^(1/3)*(x+2)^(1/2)"
        rows.append(
            (
                "near a singular point",
                f"distance 1e-{k}",
                y,
                _from_logs(("1/3", "1"), ("1/2", "-2")),
                "2",
                f"1+1/10^{k}",
            )
        )
    for k in (10, 1000, 100_000, 1_000_000):
        rows.append(("large exponent", f"k = {k}", f"x^{k}", f"({k}*({k}-1))/x^2", "1", "3/2"))
    for n in (10, 50, 200, 1000, 2000):
        rows.append(
            (
                "large degree (expanded)",
                f"Legendre {n}",
                f"legendre {n}",
                f"-({n * (n + 1)}*(1-x^2) + 1)/(1-x^2)^2",
                "0",
                "9/10",
            )
        )
    for x in (5, 10, 20, 30):
        rows.append(("recessive solution", f"exp(-x^2/2), x = {x}", "exp(-x^2/2)", "x^2 - 1", "0", str(x)))
    rows.append(("coefficients", "1e30", "cos(10^15*x)", "-10^30", "0", "1/10^13"))
    rows.append(("coefficients", "1e-30", "cos(x/10^15)", "-1/10^30", "0", "10^13"))
    for k in (3, 10, 30, 100):
        rows.append(("huge x", f"x = 1e{k}", "1/x", "2/x^2", "1", f"10^{k}"))
    rows.append(("huge x", "cos, x = 1e5", "cos(x)", "-1", "0", "10^5"))
    return rows


def _from_logs(*terms: tuple[str, str]) -> str:
    omega = " + ".join(f"({r})/(x-({z}))" for r, z in terms)
    slope = " + ".join(f"-({r})/(x-({z}))^2" for r, z in terms)
    return f"({omega})^2 + {slope}"


def number(text: str) -> Fraction:
    """A number written with + and / and powers of ten."""
    total = Fraction(0)
    for part in text.split("+"):
        top, _, bottom = part.partition("/")
        total += Fraction(_power(top)) / _power(bottom or "1")
    return total


def _power(text: str) -> int:
    base, _, exponent = text.partition("^")
    return int(base) ** int(exponent or "1")


def reference(y: str, x: Fraction) -> tuple[Any, Any]:
    """y and y' by mpmath."""
    import mpmath
    import sympy

    t = mpmath.mpf(x.numerator) / x.denominator
    if y.startswith("legendre"):
        n = int(y.split()[1])
        p, q = mpmath.legendre(n, t), mpmath.legendre(n - 1, t)
        root = mpmath.sqrt(1 - t * t)
        slope = n * (q - t * p) / (1 - t * t)
        return root * p, root * slope - t / root * p
    symbol = sympy.Symbol("x")
    expression = sympy.sympify(y.replace("^", "**"), locals={"x": symbol})  # text of this file only
    both = sympy.lambdify(symbol, (expression, sympy.diff(expression, symbol)), "mpmath")
    value, slope = both(t)
    return mpmath.mpf(value), mpmath.mpf(slope)


def naive(y: str, x: Fraction) -> float:
    import numpy as np
    import sympy

    symbol = sympy.Symbol("x")
    if y.startswith("legendre"):
        expression = sympy.sqrt(1 - symbol**2) * sympy.legendre_poly(int(y.split()[1]), symbol)
    else:
        expression = sympy.sympify(y.replace("^", "**"), locals={"x": symbol})
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            return float(sympy.lambdify(symbol, expression, "numpy")(float(x)))
        except (OverflowError, ZeroDivisionError, TypeError, RecursionError):
            return math.nan


def digits_of(value: Any, exact: Any) -> float:
    import mpmath

    if not mpmath.isfinite(value):
        return 0.0
    error = abs(value - exact) / abs(exact)
    return 40.0 if error == 0 else max(0.0, float(-mpmath.log10(error)))


def main() -> None:
    import mpmath

    from kovacic.errors import KovacicError
    from kovacic.limits import Limits
    from kovacic.numeric.evaluate import evaluate_states
    from kovacic.numeric.points import Point

    rows = []
    for family, parameter, y, S, x0, x in families():
        with mpmath.workdps(1200 if "large" in family or "recessive" in family else 160):
            start, end = number(x0), number(x)
            y0, dy0 = reference(y, start)
            exact, _ = reference(y, end)
            begin = time.perf_counter()
            try:
                (state,) = evaluate_states(
                    S, [Point(end)], x0=Point(start), y0=y0, dy0=dy0, digits=DIGITS, limits=Limits(seconds=60)
                )
            except KovacicError as error:
                rows.append(
                    {"family": family, "parameter": parameter, "obtained": None, "right": None, "error": str(error)}
                )
                print(family, parameter, error, flush=True)
                continue
            seconds = time.perf_counter() - begin
            middle = mpmath.mpf(state.y.midpoint[0].numerator) / state.y.midpoint[0].denominator
            radius = mpmath.mpf(state.y.rad[0]) * mpmath.mpf(2) ** state.y.rad[1]
            right = bool(abs(middle - exact) <= radius + abs(exact) * mpmath.mpf(10) ** -120)
            kept = digits_of(mpmath.mpf(naive(y, end)), exact)
        row = {
            "family": family,
            "parameter": parameter,
            "requested": DIGITS,
            "obtained": round(state.y.digits, 1),
            "right": right,
            "reached": state.reached,
            "note": state.note,
            "runs": state.runs,
            "naive_digits": None if kept is None else round(min(kept, 16.0), 1),
            "seconds": seconds,
        }
        rows.append(row)
        print(row, flush=True)
    RESULTS.mkdir(exist_ok=True)
    (RESULTS / "numeric_stability.json").write_text(json.dumps(rows, indent=1) + "\n")
    lines = [
        "# Stability",
        "",
        f"Python {platform.python_version()}.  Regenerate: `python benchmarks/numeric_stability.py`.",
        f"Taylor route, {DIGITS} digits asked for.",
        "*naive*: correct digits (of about 16) of SymPy's lambdify in double precision.",
        "",
        "| family | parameter | obtained | right | naive | runs | seconds |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        if row["obtained"] is None:
            lines.append(f"| {row['family']} | {row['parameter']} | {row['error']} | | | | |")
            continue
        kept = "" if row["naive_digits"] is None else f"{row['naive_digits']:.1f}"
        lines.append(
            f"| {row['family']} | {row['parameter']} | {row['obtained']:.1f} | {'yes' if row['right'] else 'NO'} | {kept} "
            f"| {row['runs']} | {row['seconds']:.3f} |"
        )
    (RESULTS / "numeric_stability.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

"""Equations under stress whose solutions are known: points that nearly merge, huge exponents, degrees and arguments.

Data for `doubles_stability.py`, with the values of the solutions by mpmath.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any


@dataclass(frozen=True)
class Row:
    """y solves y'' = S y; values are wanted at x, starting from x0, and in double precision at `points` of `interval`."""

    family: str
    parameter: str
    y: str
    S: str
    x0: str
    x: str
    interval: tuple[Any, Any] | None = None
    points: tuple[float, ...] = ()


def from_logs(*terms: tuple[str, str]) -> str:
    """S of y = prod (x - z)^r."""
    omega = " + ".join(f"({r})/(x-({z}))" for r, z in terms)
    slope = " + ".join(f"-({r})/(x-({z}))^2" for r, z in terms)
    return f"({omega})^2 + {slope}"


def spread(low: float, high: float, n: int = 24) -> tuple[float, ...]:
    return tuple(low + (high - low) * (k + 0.37) / n for k in range(n))


def families() -> list[Row]:
    rows = []
    for k in (0, 1, 3, 10, 20, 30):
        d, S = 10.0**-k, from_logs(("1/3", "0"), ("-1/3", f"1/10^{k}"))
        points = (*(d * (1.5 + j) for j in range(12)), *spread(20 * d, 20, 12))
        y = f"x^(1/3)*(x-1/10^{k})^(-1/3)"
        rows.append(
            Row(
                "nearly confluent",
                f"distance 1e-{k}",
                y,
                S,
                "5",
                f"3/10^{k}" if k < 11 else "3",
                (Fraction(1, 10**k), 500),
                points,
            )
        )
    for k in (1, 3, 10, 20, 30):
        S = from_logs(("1/3", "1"), ("1/2", "-2"))
        y, points = "(x-1)^(1/3)*(x+2)^(1/2)", tuple(1 + 10.0**-k * p for p in spread(1, 3)) if k <= 10 else ()
        x = f"{10**k + 1}/10^{k}"
        rows.append(Row("near a singular point", f"distance 1e-{k} from 1", y, S, "2", x, (1, 3), points))
    for k in (1, 30, 300):
        S = from_logs(("1/3", "0"), ("1/2", "-2"))
        y, points = "x^(1/3)*(x+2)^(1/2)", tuple(10.0**-k * p for p in spread(1, 3))
        rows.append(Row("near a singular point", f"distance 1e-{k} from 0", y, S, "1", f"1/10^{k}", (0, 3), points))
    for k in (10, 1000, 100_000, 1_000_000):
        S, width = f"({k}*({k}+1))/x^2", 5 / k
        y, x = (f"x^(-{k})", "2/3") if k <= 1000 else (f"x^({k}+1)", "3/2")  # the one that the decision finds
        interval, points = (1 - width, 1 + width), spread(1 - width, 1 + width)
        rows.append(Row("large exponent", y, y, S, "1", x, interval, points))
    for k in (10, 1000, 1_000_000):
        S, y = from_logs((str(k), "0"), (str(-k), "-1")), f"x^{k}/(x+1)^{k}"
        rows.append(
            Row("large exponent", f"x^k/(x+1)^k, k = {k}", y, S, f"{k}", f"{2 * k}", (0, 9 * k), spread(k / 2, 8 * k))
        )
    for n in (10, 50, 200, 400, 1000, 2000):
        S = f"-({n * n}/4 - 1/4)/(1-x^2) - 3/(4*(1-x^2)^2)"
        y = f"chebyshev {n // 2}"
        rows.append(
            Row("large degree", f"N = 2 R/R1 = {n}", y, S, "1/3", "9/10", ("-99/100", "99/100"), spread(-0.9, 0.9))
        )
    for x in (5, 10, 20, 30):
        y = "exp(-x^2/2)"
        rows.append(Row("recessive", f"{y}, x = {x}", y, "x^2 - 1", "0", str(x), (0, x), spread(x / 2, x)))
    for k in (30, -30):
        half = f"10^{k // 2}" if k > 0 else f"1/10^{-k // 2}"
        S, scale = (f"-10^{k}" if k > 0 else f"-1/10^{-k}"), 10.0 ** (-k // 2)
        top = f"100/10^{k // 2}" if k > 0 else f"100*10^{-k // 2}"
        rows.append(
            Row(
                "coefficients",
                f"1e{k}",
                f"exp(I*x*{half})",
                S,
                "0",
                top,
                (0, 200 * scale),
                spread(1e-3 * scale, 150 * scale),
            )
        )
    for k in (3, 10, 30, 100):
        y, points = "1/x", tuple(10.0**k * p for p in spread(1, 3))
        rows.append(Row("huge x", f"1/x, x = 1e{k}", y, "2/x^2", "1", f"10^{k}", (1, f"{10 ** (k + 1)}"), points))
    rows.append(Row("huge x", "exp(i x), x = 1e4", "exp(I*x)", "-1", "0", "10^4", (0, 20_000), spread(9000, 10_000)))
    return rows


def number(text: str) -> Fraction:
    """A number written with *, /, and powers of ten."""
    total = Fraction(1)
    top, _, bottom = text.partition("/")
    for part in top.split("*"):
        total *= power(part)
    return total / power(bottom or "1")


def power(text: str) -> int:
    base, _, exponent = text.partition("^")
    return int(base) ** int(exponent or "1")


def expression(y: str) -> tuple[Any, Any]:
    """The solution in SymPy, polynomials expanded (the text is of this file only)."""
    import sympy

    x = sympy.Symbol("x")
    if y.startswith("chebyshev"):
        return sympy.root(1 - x**2, 4) * sympy.chebyshevt_poly(int(y.split()[1]), x), x
    return sympy.sympify(y.replace("^", "**"), locals={"x": x}), x


def reference(y: str, x: Fraction) -> tuple[Any, Any]:
    """y and y' by mpmath."""
    import mpmath
    import sympy

    t = mpmath.mpf(x.numerator) / x.denominator
    if y.startswith("chebyshev"):
        k = int(y.split()[1])
        root, T, U = mpmath.root(1 - t * t, 4), mpmath.chebyt(k, t), mpmath.chebyu(k - 1, t)
        return root * T, root * (k * U - t / (2 * (1 - t * t)) * T)
    formula, symbol = expression(y)
    value, slope = sympy.lambdify(symbol, (formula, sympy.diff(formula, symbol)), "mpmath")(t)
    return mpmath.mpmathify(value), mpmath.mpmathify(slope)

"""Double-double helpers on NumPy arrays: a number is an unevaluated sum hi + lo, good to about 106 bits.

Reference: T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971).
"""

from __future__ import annotations

from typing import Any

Pair = tuple[Any, Any]
"""(hi, lo): arrays or floats."""

_SPLIT = 134217729.0  # 2^27 + 1


def two_sum(a: Any, b: Any) -> Pair:
    """a + b exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def two_product(a: Any, b: Any) -> Pair:
    """a b exactly, unless it over- or underflows."""
    p = a * b
    x, y = _SPLIT * a, _SPLIT * b
    ah, bh = x - (x - a), y - (y - b)
    al, bl = a - ah, b - bh
    return p, ((ah * bh - p) + ah * bl + al * bh) + al * bl


def add(a: Pair, b: Pair) -> Pair:
    """The sum of two pairs."""
    s, e = two_sum(a[0], b[0])
    return two_sum(s, e + (a[1] + b[1]))


def multiply(a: Pair, b: Pair) -> Pair:
    """The product of two pairs."""
    p, e = two_product(a[0], b[0])
    return two_sum(p, e + (a[0] * b[1] + a[1] * b[0]))


def horner(coefficients: tuple[tuple[float, float], ...], x: Any) -> Pair:
    """A polynomial (coefficients high to low, as pairs) at the doubles x."""
    total: Pair = (0.0 * x, 0.0 * x)
    for c in coefficients:
        total = add(multiply(total, (x, 0.0 * x)), c)
    return total

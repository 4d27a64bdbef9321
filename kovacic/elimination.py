"""Two linear equations of first order as one of second order: the other unknown is eliminated.

For x' = a x + b y, y' = c x + d y with b != 0 it is y = (x' - a x)/b, and x satisfies

    x'' - (a + d + b'/b) x' + (a d - b c - a' + a b'/b) x = 0.                                                        (1)
"""

from __future__ import annotations

from typing import Any

Expr = Any  # SymPy publishes no types


def eliminated(matrix: tuple[tuple[Expr, Expr], tuple[Expr, Expr]], t: Expr) -> tuple[Expr, Expr]:
    """The coefficients of x' and x in (1), not simplified; `matrix` is ((a, b), (c, d)).

    >>> from sympy.abc import t
    >>> eliminated(((t, t), (-t, 1 / t)), t)
    (-t - 2/t, t**2 + 1)
    """
    (a, b), (c, d) = matrix
    rate = b.diff(t) / b
    return -(a + d + rate), a * d - b * c - a.diff(t) + a * rate

"""Equations with the unknown function in denominators, y''/y = x: multiplied out.

>>> x, y = sympy.Symbol("x"), sympy.Function("y")
>>> multiplied_out(y(x).diff(x, 2) / y(x) - x, y(x))
-x*y(x) + Derivative(y(x), (x, 2))
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy.core.function import AppliedUndef

Expr = Any  # SymPy publishes no types


def multiplied_out(expression: Expr, function: Expr) -> Expr | None:
    """What is zero where a quotient is, linear in y, y' and y''; None where there is no such.  y = 0 is left out."""
    x = function.args[0]
    derivatives = [function.diff(x, 2), function.diff(x), function]
    unknown = [sympy.Dummy("y2"), sympy.Dummy("y1"), sympy.Dummy("y0")]
    plain = expression.xreplace(dict(zip(derivatives, unknown, strict=True)))
    is_left = any(f.func == function.func for f in plain.atoms(AppliedUndef))
    if is_left or plain.has(sympy.Derivative):
        return None
    numerator, denominator = sympy.fraction(sympy.together(plain))
    if not denominator.has(*unknown) or not numerator.is_polynomial(*unknown):
        return None
    polynomial = sympy.Poly(numerator, *unknown)
    if polynomial.total_degree() != 1:
        return None
    return sympy.expand(polynomial.as_expr().xreplace(dict(zip(unknown, derivatives, strict=True))))

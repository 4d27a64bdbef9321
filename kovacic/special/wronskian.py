"""`wronskian`: y1 y2' - y1' y2 for pairs of Airy and Bessel functions, which SymPy doesn't simplify.

For y1 = P C1(z), y2 = P C2(z) it is P^2 z' (C1 C2' - C1' C2)(z).  Reference: DLMF 9.2.7, 10.5.2, 10.28.2, 10.50.1.
"""

from __future__ import annotations

from typing import Any

import sympy

#: C1 with C2 and C1 C2' - C1' C2.
_PAIRS: dict[Any, tuple[Any, Any]] = {
    sympy.airyai: (sympy.airybi, lambda z: 1 / sympy.pi),
    sympy.besselj: (sympy.bessely, lambda z: 2 / (sympy.pi * z)),
    sympy.besseli: (sympy.besselk, lambda z: -1 / z),
    sympy.jn: (sympy.yn, lambda z: z**-2),
}


def wronskian(y1: Any, y2: Any, x: Any) -> Any | None:
    """y1 y2' - y1' y2 in elementary functions; None where y1 and y2 aren't such a pair.

    >>> x = sympy.Symbol("x")
    >>> print(wronskian(x * sympy.besselj(0, x**2), x * sympy.bessely(0, x**2), x))
    4*x/pi
    """
    found = [f for f in sympy.sympify(y1, strict=True).atoms(*_PAIRS) if f.has(x)]
    if len(found) != 1:
        return None
    (function,) = found
    partner, value = _PAIRS[function.func]
    P, z = y1 / function, function.args[-1]
    if P.has(*_PAIRS) or y2 / partner(*function.args) != P:
        return None
    W = P**2 * z.diff(x) * value(z)
    return sympy.cancel(W) if W.is_rational_function(x) else W

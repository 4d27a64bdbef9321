"""Special functions with two derivatives in ball arithmetic, by flint: for each of SymPy's names the value and its derivatives.

Reference: DLMF 10.6, 10.29 (Bessel), 13.6, 16.3 (hypergeometric), 18.5, 18.9 (polynomials).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import prod
from typing import Any

import sympy
from flint import acb

Number = Any  # flint's acb
Function = Callable[[Sequence[Number], Number], Number]
Derivative = Callable[[int, Sequence[Number], Number], Number]


def _bessel(name: str, k: int, parameters: Sequence[Number], z: Number) -> Number:
    """2^k times the k-th derivative is a sum over neighbours: (C_(nu-1) - C_(nu+1))/2 for J and Y, + for I, and -(+) for K."""
    (nu,) = parameters
    inner, outer = {"bessel_i": (1, 1), "bessel_k": (1, -1)}.get(name, (-1, 1))
    total = acb(0)
    for j in range(k + 1):
        total += (1, k, 1)[j] * inner**j * getattr(acb, name)(z, nu - k + 2 * j)
    return total * outer**k / 2**k


def _hermite(k: int, parameters: Sequence[Number], z: Number) -> Number:
    (n,) = parameters
    return 2**k * prod((n - i for i in range(k)), start=acb(1)) * z.hermite_h(n - k)


_DERIVATIVES: dict[Any, Derivative] = {
    sympy.besselj: partial(_bessel, "bessel_j"),
    sympy.bessely: partial(_bessel, "bessel_y"),
    sympy.besseli: partial(_bessel, "bessel_i"),
    sympy.besselk: partial(_bessel, "bessel_k"),
    sympy.hermite: _hermite,
}


def derivatives(function: Any) -> Derivative | None:
    """(k, parameters, z) -> the k-th derivative, k <= 2; None for a function that isn't known."""
    return _DERIVATIVES.get(function)


def rewritten(e: Any) -> Any:
    """Spherical Bessel functions by Bessel's, polynomials by hypergeometric functions; None for all others."""
    half, gamma = sympy.S.Half, sympy.gamma
    if isinstance(e, sympy.jn | sympy.yn):
        n, z = e.args
        kind = sympy.besselj if isinstance(e, sympy.jn) else sympy.bessely
        return sympy.sqrt(sympy.pi / (2 * z)) * kind(n + half, z)
    if isinstance(e, sympy.laguerre | sympy.assoc_laguerre):
        n, a, z = e.args if len(e.args) == 3 else (e.args[0], sympy.S.Zero, e.args[1])
        return gamma(n + a + 1) / gamma(n + 1) / gamma(a + 1) * sympy.hyper((-n,), (a + 1,), z)
    if isinstance(e, sympy.legendre | sympy.gegenbauer):
        n, a, z = e.args if len(e.args) == 3 else (e.args[0], half, e.args[1])
        return gamma(n + 2 * a) / gamma(n + 1) / gamma(2 * a) * sympy.hyper((-n, n + 2 * a), (a + half,), (1 - z) / 2)
    if isinstance(e, sympy.jacobi):
        n, a, b, z = e.args
        factor = gamma(n + a + 1) / gamma(n + 1) / gamma(a + 1)
        return factor * sympy.hyper((-n, n + a + b + 1), (a + 1,), (1 - z) / 2)
    return None


def hypergeometric(e: Any, value: Callable[[Any], Number], z: Number) -> list[Number]:
    """The values of SymPy's `hyper` and its first two derivatives; 2F0(a, b; z) = (-1/z)^a U(a, a - b + 1, -1/z).

    Differences of parameters that are integers are taken from the expression, for balls don't show that they are.
    """
    top, bottom = [value(a) for a in e.ap], [value(b) for b in e.bq]
    exact = [sympy.expand(difference).is_integer is True for difference in _differences(e)]
    found, factor = [], acb(1)
    for k in range(3):
        above, below = [a + k for a in top], [b + k for b in bottom]
        if len(above) == 2 and len(below) == 1:
            found.append(factor * z.hypgeom_2f1(*above, *below, False, *exact))
        elif len(above) == 2 and not below:
            w = -1 / z
            found.append(factor * w ** above[0] * w.hypgeom_u(above[0], value(sympy.expand(e.ap[0] - e.ap[1] + 1))))
        else:
            found.append(factor * z.hypgeom(above, below))
        factor *= prod(above, start=acb(1)) / prod(below, start=acb(1))
    return found


def _differences(e: Any) -> list[Any]:
    """a - b, a - c, b - c and a + b - c of a 2F1."""
    if len(e.ap) != 2 or len(e.bq) != 1:
        return []
    (a, b), (c,) = e.ap, e.bq
    return [a - b, a - c, b - c, a + b - c]

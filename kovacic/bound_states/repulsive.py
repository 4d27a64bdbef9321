"""Repulsive potentials have no eigenvalues: the virial theorem.

Let c be the finite end of a half-line, or any point of the line, and (x - c) V'(x) <= 0, V not constant.  For y'' = (V - E) y

    G = (x - c) (y'^2 - (V - E) y^2) + y y'        has        G' = 2 y'^2 - (x - c) V' y^2 >= 0.

V has finite limits at infinity, where y and y' are square integrable, so that G comes as near to 0 as one likes; and G -> 0 at
the end c, where y is the smaller solution: V' <= 0 means that V isn't below -1/(4 (x - c)^2) there.  So G = 0, and y = 0.

Reference: J. Weidmann, Bull. Amer. Math. Soc. 73 (1967) 452.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.bound_states.ends import End
from kovacic.bound_states.frame import RealPotential, range_of
from kovacic.bound_states.signs import Signs

REASON = "a repulsive potential, (x - c) V'(x) <= 0 for some c: no solution is square integrable (the virial theorem)"


def is_repulsive(real: RealPotential, ends: Sequence[End], signs: Signs) -> bool:
    """True if the theorem is proven to apply."""
    original = real.original
    infinite = [end for end in ends if end.at.is_infinite]
    is_monotonic = original.kind in ("x", "exp", "sinh")
    if not infinite or not is_monotonic or any(end.threshold is None for end in infinite) or not real.V.has(real.t):
        return False
    rate = signs.sign(original.rate)
    slope = sympy.factor(sympy.diff(real.V, real.t))
    first, last = (end.at for end in ends)
    centre = first if first.is_finite else last
    if centre.is_infinite:
        centre = sympy.Integer(0)
    sides = [(sign, half) for sign, half in ((1, (first, centre)), (-1, (centre, last))) if half[0] != half[1]]
    return rate is not None and all(
        _has_sign(slope, real.t, range_of(original, half, signs), sign * rate, signs) for sign, half in sides
    )


def _has_sign(function: Any, t: Any, bounds: tuple[Any, Any], sign: int, signs: Signs) -> bool:
    """True if the function isn't of the other sign between two bounds, of which one may be infinite."""
    low, high = bounds
    s = sympy.Dummy("s", positive=True)
    if low is not None and high is not None:
        inside = low + (high - low) * s / (1 + s)
    elif low is None and high is None:
        inside = sympy.Dummy("t", real=True)
    else:
        inside = low + s if high is None else high - s
    return signs.is_nonnegative(sign * function.xreplace({t: inside})) is True

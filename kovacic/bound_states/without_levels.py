"""Periodic and repulsive potentials have no levels.

Where a periodic V has no poles there is no eigenvalue on the whole line: the multipliers of a period have the product 1, so
that what decays at one end grows at the other [Floquet; Eastham, The Spectral Theory of Periodic Differential Equations, 1973].

Repulsive potentials have no eigenvalues either, by the virial theorem.  Let c be the finite end of a half-line, or any point
of the line, and (x - c) V'(x) <= 0, V not constant.  For y'' = (V - E) y

    G = (x - c) (y'^2 - (V - E) y^2) + y y'        has        G' = 2 y'^2 - (x - c) V' y^2 >= 0.

V has finite limits at infinity, where y and y' are square integrable, so that G comes as near to 0 as one likes; and G -> 0 at
the end c, where y is the smaller solution: V' <= 0 means that V isn't below -1/(4 (x - c)^2) there.  So G = 0, and y = 0.

Reference: J. Weidmann, Bull. Amer. Math. Soc. 73 (1967) 452.
"""

from __future__ import annotations

import sympy

from kovacic.bound_states.ends import Examined

NO_LEVELS = "a periodic potential: what decays at one end grows at the other (Floquet), the spectrum consists of bands"
REASON = "a repulsive potential, (x - c) V'(x) <= 0 for some c: no solution is square integrable (the virial theorem)"


def is_repulsive(question: Examined) -> bool:
    """True if the theorem is proven to apply."""
    real, signs = question.real, question.signs
    assert real is not None
    original = real.original
    thresholds = [end.threshold for end in question.ends if end.at.is_infinite]
    rate = signs.sign(original.rate)
    if rate is None or not thresholds or None in thresholds:  # V has no limit
        return False
    if original.kind not in ("x", "exp", "sinh") or not real.V.has(real.t):
        return False
    first, last = original.domain
    centre = next((at for at in (first, last) if at.is_finite), sympy.Integer(0))
    slope = sympy.factor(sympy.diff(real.V, real.t))
    # V increases on the left of the centre, and falls on the right; t grows with x for a positive rate.
    halves = ((rate, (first, centre)), (-rate, (centre, last)))
    s = sympy.Dummy("s", positive=True)
    for sign, half in halves:
        if half[0] == half[1]:
            continue
        low, high = original.on(*half).range  # one of these may be infinite
        inside = low + s if low.is_finite else high - s
        if low.is_finite and high.is_finite:
            inside = low + (high - low) * s / (1 + s)
        if signs.is_nonnegative(sign * slope.xreplace({real.t: inside})) is not True:
            return False
    return True

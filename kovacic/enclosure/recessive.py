"""The recessive solution: the one that becomes smaller than all others as x goes to infinity along the positive real axis.

The guarantee: `logarithmic_derivative` returns a ball that contains y'/y at x0 for it.

The mathematics.  Where S > 0 on [X, infinity), positive solutions are convex, and one of them is falling.  It is alone, up to a
factor: the derivatives of two of them would tend to 0, and with these their constant Wronskian.  So its state at X is a
positive multiple of (s, -(1 - s)) with 0 < s < 1.  Let M, det M = 1, be the transition matrix from X to x0, and m = M (1, 0),
n = M (0, -1).  Then

    y'/y at x0 = n'/n + s/(n (n + s (m - n))),                                                                          (1)

where both m and n are of the size of the other solutions' growth g: the ball has some 2 log2(g) bits, and X is chosen for
the bits that are wanted.  Nothing is known of the solution at X but its signs, and nothing else is needed.

Reference: P. Hartman, "Ordinary Differential Equations" (1964), XI.6 (principal solutions).
"""

from __future__ import annotations

import math
from fractions import Fraction

from flint import acb, arb

from kovacic.enclosure.frame import least_growth
from kovacic.enclosure.matrices import product
from kovacic.enclosure.points import Point
from kovacic.enclosure.problem import System
from kovacic.enclosure.transport import piece_matrices
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Budget


def logarithmic_derivative(system: System, x0: Point, prec: int, budget: Budget) -> acb:
    """y'/y at x0, to about `prec` bits, at the working precision in force.

    Raises InputError where no solution of y'' = S y decays in this way: S must be positive for large x, and grow or fall
    more slowly than 1/x^2.
    """
    if not system.num or system.num[-1] * system.den[-1] < 0 or len(system.num) - len(system.den) < -1:
        raise InputError(
            "no solution decays for large x: S must be positive there, and x^2 S unbounded",
            hint="for a regular singular point at infinity: x0='oo', which='regular'",
        )
    roots = [root.real for which in ("num", "den") for root, _ in system.roots(which, 64)]
    first = Fraction(math.ceil(max((float(root.upper()) for root in roots), default=0.0))) + 1
    first = max(first, Fraction(math.ceil(x0.re)))
    step, bits = Fraction(1), (prec + 20) * math.log(2) / 2
    while least_growth(system, Point(first), Point(first + step)) < bits:
        step *= 2
        if step > 1 << 200:
            raise LimitExceeded("no starting point was found for the decaying solution", limit="unknown_degree")
    m, n, _dm, dn = product(piece_matrices(system, Point(first + step), x0, prec + 20, budget))
    n, dn = -n, -dn
    return dn / n + acb(arb(0.5, 0.5)) / (n * (n + acb(arb(0.5, 0.5)) * (m - n)))

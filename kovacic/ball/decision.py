"""The engine's decision for a ball, and the answer that the theorems predict for it.

`decide` runs the engine and the verifying kernel; `degree_of_omega` and `group_of` only read the theorems, which
`kovacic.ball.theorems` proves.  The tests compare the two.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.ball.ball import BallOnSphere, Scalar, exact
from kovacic.ball.field import Quotient, Ring
from kovacic.ball.irrational import generators
from kovacic.ball.meridian import X
from kovacic.ball.theorems import normal_form
from kovacic.decision import Decision
from kovacic.engine.decide import decide as decide_structure
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Budget
from kovacic.verify import verify


@dataclass(frozen=True, slots=True)
class Verdict:
    """The engine's decision for one ball, checked by the verifying kernel."""

    ratio: sp.Expr
    degree: int | None
    decision: Decision
    verified: bool


def decide(equation: Quotient, ratio: sp.Expr) -> Verdict:
    """Run the engine on y'' = S y with a numeric S, and verify its decision.

    Raises `InputError` if S still contains a symbol or an irrational number.
    """
    sides = equation.coefficients()
    if sides is None:
        raise InputError(
            "the engine decides equations over Q here: every parameter needs a rational value",
            hint="kovacic.solve(equation.expression()) takes irrational numbers too, kovacic.conditions symbols",
        )
    S = RatFunc(*(QQ.poly([Fraction(value) for value in side]) for side in sides))
    decision = decide_structure(S, Budget(DEFAULT_LIMITS))
    degree = decision.riccati.degree if decision.riccati is not None else None
    return Verdict(ratio, degree, decision, bool(verify(S, decision)))


def normalised(ratio: Scalar) -> Quotient:
    """(13) with x1 = 1, x2 = -1, which is the general case up to an affine change of x, for R/R1 = `ratio`."""
    rho = exact(ratio, "R/R1")
    names = sorted(symbol.name for symbol in rho.free_symbols)
    ring = Ring((*names, X.name), generators([rho]))
    x = ring.element(X)
    return normal_form(x - 1, x + 1, ring.element(rho) * ring.element(rho))


def degree_of_omega(sphere: BallOnSphere) -> int | None:
    """Theorems 1 and 2 with the degenerate balls: 1 or 2, the degree of omega; None if the symbols don't decide it."""
    if sphere.leading == 0 or sphere.discriminant == 0:
        return 1
    if not sphere.ratio.is_number:
        return None
    return 1 if (2 * sphere.ratio).is_integer else 2


def group_of(sphere: BallOnSphere) -> str | None:
    """The differential Galois group of (13) by step (d) and its degenerate counterparts; None if symbols leave it open
    (or a ratio such as e^pi/pi^e, of which nobody knows whether it is rational).

    For real rho, D with two simple roots (the constants are C): rho = 0: G_a extended by mu_4; 2 rho an integer: mu_4;
    2 rho = p/q: dicyclic of order 4q; irrational: N(T).  A1 = A3: mu_4 (a = 0: trivial, y'' = 0).  A double root:
    y = (x - x1)^(1/2 +- rho), so mu_n with n the denominator of 1/2 + rho, or G_m; on the plane sqrt(x - x1) and a logarithm.
    """
    rho = sphere.ratio
    if sphere.leading == 0:
        return "trivial" if sphere.ball.a == 0 else "mu_4"
    if not rho.is_number or rho.is_rational is None or not sphere.discriminant.is_number:
        return None
    if sphere.discriminant == 0:
        if rho == 0:
            return "G_a extended by mu_2"
        if not rho.is_rational:
            return "G_m"
        n = int(sp.denom(rho + sp.Rational(1, 2)))
        return "trivial" if n == 1 else f"mu_{n}"
    if rho == 0:
        return "G_a extended by mu_4"
    if not rho.is_rational:
        return "N(T)"
    q = int(sp.denom(2 * rho))
    return "mu_4" if q == 1 else f"dicyclic of order {4 * q}"

"""Potentials V(u) of forces on the rolling body: functions of cos u alone, since the motion's reduction to u needs that.

V depends on the place of the contact point on the body only, as for a force towards the centre of the sphere, or for gravity
on a plane.  A uniform field over a sphere is none: it depends on the place on the sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import sympy as sp
from sympy.functions.elementary.hyperbolic import HyperbolicFunction, InverseHyperbolicFunction
from sympy.functions.elementary.trigonometric import InverseTrigonometricFunction, TrigonometricFunction

from kovacic.ball.ball import BallOnSphere, Scalar, exact
from kovacic.ball.meridian import U, as_expression
from kovacic.ball.reading import read_expression
from kovacic.errors import InputError

Potential: TypeAlias = "sp.Expr | str | float"
_SAMPLES = 32
_ELEMENTARY = (
    sp.Symbol,
    sp.Number,
    sp.NumberSymbol,
    sp.CRootOf,
    sp.Add,
    sp.Mul,
    sp.Pow,
    sp.exp,
    sp.log,
    TrigonometricFunction,
    InverseTrigonometricFunction,
    HyperbolicFunction,
    InverseHyperbolicFunction,
)


def potential_of(value: Potential) -> sp.Expr:
    """V as a SymPy expression in u; text is read by `kovacic.ball.reading`.

    A potential is only ever evaluated, so it may contain floats, which are taken as they are; decimals in text are exact.
    Raises `InputError` for anything but an elementary function of u.

    >>> potential_of("3/2*cos(u)")
    3*cos(u)/2
    """
    if isinstance(value, str):
        V = read_expression(value, what="the potential", names={U.name: U})
    else:
        V = as_expression(value, "the potential")
    if V.free_symbols - {U} or V.has(sp.I):
        raise InputError(f"the potential is a real function that depends on u alone, it can't be {value}")
    for part in sp.preorder_traversal(V):
        if not isinstance(part, _ELEMENTARY) or part in (sp.oo, -sp.oo, sp.zoo, sp.nan):
            raise InputError(f"the potential is an elementary function of u, it can't contain {part}")
    return V


def central_gravity(sphere: BallOnSphere, g: Scalar) -> sp.Expr:
    """The potential V(u) of a force m g of constant strength towards the centre of the sphere (on the plane: downwards).

    The distance of the centre of mass from the sphere's centre is sqrt(R1^2 + 2 R1 eps + |rho|^2), eps = R + a cos u; V
    is m g times its excess over |R1|.
    """
    m, R, a, _, _ = sphere.ball.parameters
    g = exact(g, "g")
    eps = R + a * sp.cos(U)
    if sphere.R1.is_infinite:
        return m * g * eps
    square = sphere.R1**2 + 2 * sphere.R1 * eps + R**2 + a**2 + 2 * R * a * sp.cos(U)
    return m * g * (sp.sqrt(square) - sp.Abs(sphere.R1))


def compiled(potential: Potential) -> Callable[[Any], Any]:
    """V for NumPy's arrays.

    Raises `InputError` where V isn't finite and real on 0 <= u <= pi, or isn't even about both poles, u = 0 and u = pi, as
    every function of cos u is: the force would jump there.
    """
    exact = sp.lambdify(U, potential_of(potential), modules="numpy", cse=True)

    def V(u: Any) -> Any:
        return np.asarray(exact(u), dtype=float)

    u = np.linspace(0.0, np.pi, _SAMPLES + 1)
    with np.errstate(all="ignore"):
        values = [np.broadcast_to(V(at), u.shape) for at in (u, -u, 2 * np.pi - u)]
    here, mirrored, beyond = values
    bad = ~np.isfinite(here)
    if bad.any():
        raise InputError(f"the potential isn't finite at u = {u[bad.argmax()]:.3g}; it must be on 0 <= u <= pi")
    size = np.abs(here).max()
    if max(np.abs(mirrored - here).max(), np.abs(beyond - here).max()) > 1e-9 * size:
        raise InputError(
            "the potential isn't smooth at the poles: V(-u) = V(u) = V(2 pi - u) fails",
            hint="a function of cos(u) is: cos(u), sin(u)^2, exp(-cos(u))",
        )
    return V

"""Forces on the rolling ball: those with a potential V(u), a function of cos u alone, which leaves a quadrature for u.

V depends on the place of the contact point on the body only, as for a force towards the centre of the sphere, or for gravity
on a plane.  A uniform field over a sphere is none: it depends on the place on the sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import sympy as sp

from kovacic.ball.ball import BallOnSphere, Scalar, exact, read_expression
from kovacic.errors import InputError

Potential: TypeAlias = "sp.Expr | str | float"
U = sp.Symbol("u")
#: What a potential consists of; the functions are told by their modules.
_ARITHMETIC = (sp.Symbol, sp.Number, sp.NumberSymbol, sp.CRootOf, sp.Add, sp.Mul, sp.Pow, sp.exp, sp.log)
_FUNCTIONS = ("sympy.functions.elementary.trigonometric", "sympy.functions.elementary.hyperbolic")


@dataclass(frozen=True, slots=True)
class Force:
    """V(u), and V and V' compiled for NumPy's arrays; g is the strength of `gravity`, None for another potential."""

    V: sp.Expr
    value: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    g: float | None = None

    @classmethod
    def of(cls, potential: Potential, g: float | None = None) -> Force:
        """The force with the potential V(u).  Raises `InputError` as `potential_of` does, and where V isn't smooth."""
        V = potential_of(potential)
        value, slope = (sp.lambdify(U, f, modules="numpy", cse=True) for f in (V, sp.diff(V, U)))
        _check(value)
        return cls(V, value, slope, g)

    @classmethod
    def gravity(cls, sphere: BallOnSphere, g: Scalar) -> Force:
        """A force m g at the centre of mass that presses the ball to the fixed surface (a negative g: pulls it off).

        It points to the centre of the sphere, away from it inside, and downwards on a plane.  The centre of mass is at the
        distance d/|k| from the sphere's, d^2 = 1 + a^2 k^2 + 2 a k cos u, 1/k = R1 + R; V is m g (d - 1)/k.
        """
        m, R, a, _, _ = sphere.ball.parameters
        strength = exact(g, "g")
        k = sp.Integer(0) if sphere.R1.is_infinite else 1 / (sphere.R1 + R)
        V = m * strength * a * (a * k + 2 * sp.cos(U)) / (1 + sp.sqrt(1 + a**2 * k**2 + 2 * a * k * sp.cos(U)))
        if not V.free_symbols <= {U}:
            raise InputError(f"numbers are needed for a motion, and {V} contains symbols")
        return cls.of(V, float(strength))


def potential_of(value: Potential) -> sp.Expr:
    """V as a SymPy expression in u; text is read by `kovacic.reading.symbolic`.

    A potential is only ever evaluated, so it may contain floats, which are taken as they are; decimals in text are exact.
    Raises `InputError` for anything but an elementary function of u.

    >>> potential_of("3/2*cos(u)")
    3*cos(u)/2
    """
    try:
        if isinstance(value, str):
            V = read_expression(value, what="the potential", names={U.name: U})
        else:
            V = sp.sympify(value, strict=True)
    except sp.SympifyError:
        V = None
    if not isinstance(V, sp.Expr):
        raise InputError(f"the potential is text, a number or a SymPy expression, it can't be {value!r}")
    if V.free_symbols - {U} or V.has(sp.I):
        raise InputError(f"the potential is a real function that depends on u alone, it can't be {value}")
    for part in sp.preorder_traversal(V):
        known = isinstance(part, _ARITHMETIC) or type(part).__module__ in _FUNCTIONS
        if not known or part in (sp.oo, -sp.oo, sp.zoo, sp.nan):
            raise InputError(f"the potential is an elementary function of u, it can't contain {part}")
    return V


def _check(V: Callable[[Any], Any]) -> None:
    """V is finite and real on 0 <= u <= pi, and even about both poles, as functions of cos u are: no jump of the force."""
    u = np.linspace(0.0, np.pi, 33)
    with np.errstate(all="ignore"):
        here, mirrored, beyond = (np.broadcast_to(np.asarray(V(at), dtype=float), 33) for at in (u, -u, 2 * np.pi - u))
    bad = ~np.isfinite(here)
    if bad.any():
        raise InputError(f"the potential isn't finite at u = {u[bad.argmax()]:.3g}; it must be on 0 <= u <= pi")
    if max(np.abs(mirrored - here).max(), np.abs(beyond - here).max()) > 1e-9 * np.abs(here).max():
        raise InputError(
            "the potential isn't smooth at the poles: V(-u) = V(u) = V(2 pi - u) fails",
            hint="a function of cos(u) is: cos(u), sin(u)^2, exp(-cos(u))",
        )

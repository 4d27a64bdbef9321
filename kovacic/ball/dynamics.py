"""The equations of motion of the ball in its own axes, where they have no singularity, the forces, the closed form in numbers.

Symbols as in `kovacic.ball.body`; x = cos u.  With s the unit vector from the centre to the contact point, omega the angular
velocity, r = R s + a e_3 (from the centre of mass to the contact point), and b such that the centre of mass has the
acceleration -(omega' x r) - b, Euler's equations about the contact point are
    (1 + rho) s' = s x omega,   J omega' - m r x (r x omega') = J omega x omega - m r x b + V_x/(1 + rho) s x e_3,
where x = s_3, n = omega . s [E. J. Routh, Advanced Dynamics of a System of Rigid Bodies, ch. V].

V is a function of cos u alone, the place of the contact point on the body, as for a force towards the centre of the sphere, or
for gravity on a plane: that leaves a quadrature for u.  A uniform field over a sphere is none: it depends on the place there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from kovacic.ball.body import BallOnSphere, Quantity, U, exact_quantity, read_short
from kovacic.errors import InputError

Array = NDArray[np.float64]
Vector: TypeAlias = "Sequence[Any] | NDArray[Any]"
Potential: TypeAlias = "sp.Expr | str | float"
#: The range of numbers in a motion: products of several of them, and of their inverses, are still floats.
_LARGEST_NUMBER = 1e50


@dataclass(frozen=True, slots=True)
class Force:
    """V(u), and V and V' compiled for NumPy arrays; g is the strength of `gravity`, or None for another potential."""

    V: sp.Expr
    value: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    g: float | None = None

    @classmethod
    def of(cls, V: sp.Expr, g: float | None = None) -> Force:
        """The force with the potential V(u).

        Raises `InputError` for a V that isn't finite on 0 <= u <= pi, or isn't even about both poles, as functions of cos u
        are: the force would jump there.
        """
        value, slope = (sp.lambdify(U, f, modules="numpy", cse=True) for f in (V, sp.diff(V, U)))
        u = np.linspace(0.0, np.pi, 33)
        with np.errstate(all="ignore"):
            here, *others = (np.broadcast_to(np.asarray(value(at), dtype=float), 33) for at in (u, -u, 2 * np.pi - u))
        if not np.isfinite(here).all():
            at = u[np.isfinite(here).argmin()]
            raise InputError(f"the potential isn't finite at u = {at:.3g}; it must be on 0 <= u <= pi")
        if np.abs(np.subtract(others, here)).max() > 1e-9 * np.abs(here).max():
            hint = "a function of cos(u) is: cos(u), sin(u)^2, exp(-cos(u))"
            raise InputError("the potential isn't smooth at the poles: V(-u) = V(u) = V(2 pi - u) fails", hint=hint)
        return cls(V, value, slope, g)

    @classmethod
    def gravity(cls, sphere: BallOnSphere, g: Quantity) -> Force:
        """A force m g at the centre of mass that presses the ball to the fixed surface; a negative g pulls it off.

        It points to the centre of the sphere, away from it inside, and downwards on a plane.  The centre of mass is at the
        distance d/|k| from the sphere's, d^2 = 1 + a^2 k^2 + 2 a k cos u, 1/k = R1 + R; V is m g (d - 1)/k.
        """
        m, R, a, _, _ = sphere.ball.parameters
        strength = exact_quantity(g, "g")
        k = sp.Integer(0) if sphere.R1.is_infinite else 1 / (sphere.R1 + R)
        V = m * strength * a * (a * k + 2 * sp.cos(U)) / (1 + sp.sqrt(1 + a**2 * k**2 + 2 * a * k * sp.cos(U)))
        return cls.of(V, as_float(strength, "g"))


def as_float(value: Any, name: str, *, least: float = 0.0) -> float:
    """The value as a float; text and SymPy's numbers are read exactly.  Raises `InputError` for symbols, and out of range."""
    number = sp.Float(value) if isinstance(value, float | np.floating) else exact_quantity(value, name)
    if not number.is_number or (number != 0 and not least <= abs(float(number)) <= _LARGEST_NUMBER):
        hint = (
            f"numbers are needed; choose units that bring them between {1 / _LARGEST_NUMBER:g} and {_LARGEST_NUMBER:g}"
        )
        raise InputError(f"{name} = {value} isn't a number that a motion can start with", hint=hint)
    return float(number)


def potential_of(value: Potential) -> sp.Expr:
    """V as a SymPy expression in u; floats are their binary values, decimals in text are exact.

    Raises `InputError` for anything but a real elementary function of u, and `LimitExceeded` if it is too long.

    >>> potential_of("3/2*cos(u)")
    3*cos(u)/2
    """
    if not isinstance(value, str | sp.Expr | float | int):
        raise InputError(f"the potential is text, a number or a SymPy expression, it can't be {value!r}")
    names = {"u": U}
    if not isinstance(value, str):  # in text, E isn't Euler's number
        value = str(sp.nsimplify(value, rational=True, rational_conversion="exact"))
        names["E"] = sp.E
    V = read_short(value, what="the potential", names=names)
    corners = sorted(map(str, V.atoms(sp.Abs, sp.sign, sp.Heaviside, sp.DiracDelta)))
    if corners:
        raise InputError(f"the potential can't contain {corners[0]}: its force has to be smooth")
    if V.has(sp.I):
        raise InputError(f"the potential is a real function of u, it can't be {value}")
    return V


@dataclass(frozen=True, slots=True)
class Dynamics:
    """The parameters as floats, kappa = 1/R1, and the equations of motion; vectors are sequences of components."""

    m: float
    R: float
    a: float
    A1: float
    A3: float
    kappa: float

    @classmethod
    def of(cls, sphere: BallOnSphere) -> Dynamics:
        """The parameters of this ball; raises `InputError` for symbols, and for numbers out of range."""
        values = zip(("m", "R", "a", "A1", "A3", "1/R1"), (*sphere.ball.parameters, 1 / sphere.R1), strict=True)
        return cls(*(as_float(value, name, least=1 / _LARGEST_NUMBER) for name, value in values))

    @property
    def rho(self) -> float:
        return self.R * self.kappa

    def D(self, x: Any) -> Any:
        """D(x) of `kovacic.ball.body`."""
        return self.A1 * (self.A3 + self.m * self.R**2 * (1 - x * x)) + self.A3 * self.m * (self.R * x + self.a) ** 2

    def arm(self, s: Vector) -> tuple[Any, Any, Any]:
        """r, from the centre of mass to the contact point."""
        return self.R * s[0], self.R * s[1], self.R * s[2] + self.a

    def acceleration(self, s: Vector, omega: Vector) -> tuple[Any, Any, Any]:
        """b: the centre of mass has the acceleration -(omega' x r) - b."""
        k = self.R / (1 + self.rho)
        parts = zip(cross(omega, self.arm(s)), cross(omega, s), strict=True)
        return cross(omega, [turn - k * drift for turn, drift in parts])

    def rates(self, slope: Callable[[Any], Any], y: Vector) -> list[Any]:
        """The derivatives of y: omega, s, the rows of B, and the contact point's way on a plane; floats or arrays of them."""
        omega, s = y[:3], y[3:6]
        r = self.arm(s)
        ds = cross(s, omega)  # (1 + rho) s'
        moved = [cross(y[k : k + 3], omega) for k in (6, 9, 12)]
        J = (self.A1, self.A1, self.A3)
        spin = cross([p * q for p, q in zip(J, omega, strict=True)], omega)
        lever = cross(self.acceleration(s, omega), r)
        torque = [p + self.m * q for p, q in zip(spin, lever, strict=True)]
        sine = np.hypot(s[0], s[1])
        force = -slope(np.arctan2(sine, s[2])) / (np.maximum(sine, 1e-300) * (1 + self.rho))  # V_x/(1 + rho)
        torque[0] += force * s[1]
        torque[1] -= force * s[0]
        # The inverse of diag(d) - m r r^T, d = J + m r^2, whose determinant is D(x) times a d.
        d = [p + self.m * dot(r, r) for p in J]
        first = [p / q for p, q in zip(torque, d, strict=True)]
        share = self.m * dot(r, first) * d[0] * d[2] / self.D(s[2])
        domega = [p + share * q / e for p, q, e in zip(first, r, d, strict=True)]
        way = [self.R * dot(y[k : k + 3], ds) for k in (6, 9, 12)]
        return [*domega, *(p / (1 + self.rho) for p in ds), *(p for row in moved for p in row), *way]

    def transport(self, x: Array, x0: float, omega_3: float, n: float) -> tuple[Array, Array]:
        """(omega_3, n) at x from their values at x0 = cos u0: the closed form of `kovacic.ball.theorems`, for either sign of l.

        eta and zeta are turned by the hyperbolic angle rho sqrt(l) (xi - xi0), an ordinary one for l < 0.
        """

        def half(x: Any) -> Any:  # D'/2
            return self.m * self.R * ((self.A3 - self.A1) * self.R * x + self.A3 * self.a)

        weight = self.m * self.R**2 * self.A1
        root0, root = np.sqrt(self.D(x0)), np.sqrt(self.D(x))
        eta0, zeta0 = omega_3 * root0, weight * n + half(x0) * omega_3
        scale = np.sqrt(complex(self.m * self.R**2 * (self.A3 - self.A1))) or 1e-30 * root0  # the limit of l -> 0
        angle = 2 * self.rho * np.arctanh(scale * (x - x0) / (root + root0))
        even, odd = np.cosh(angle).real, np.sinh(angle)
        eta = eta0 * even - zeta0 * (odd / scale).real
        zeta = zeta0 * even - eta0 * (odd * scale).real
        return eta / root, (zeta - half(x) * eta / root) / weight


def unsteadiness(y: Array, f: Array, rate: float) -> Array:
    """The distance of (omega, s) from turning uniformly about the axis, as in steady motions; at most about 1."""
    z = np.array([y[1] / rate, -y[0] / rate, y[4], -y[3]])  # turned by -90 degrees
    change = np.array([f[0] / rate, f[1] / rate, f[3], f[4], f[2] / rate, f[5]]) / rate
    square = (z * z).sum(0)
    share = (change[:4] * z).sum(0) / np.where(square > 0, square, 1.0)
    return np.asarray(np.sqrt(((change[:4] - share * z) ** 2).sum(0) + (change[4:] ** 2).sum(0)))


def cross(a: Vector, b: Vector) -> tuple[Any, Any, Any]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def colatitude(s: Array) -> Array:
    return np.asarray(np.arctan2(np.hypot(s[0], s[1]), s[2]))

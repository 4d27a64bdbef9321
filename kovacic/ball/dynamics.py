"""The equations of motion of the ball in its own axes, where they have no singularity, and the closed form in numbers.

Symbols as in `kovacic.ball.ball`; x = cos u.  With s the unit vector from the centre to the contact point, omega the angular
velocity, r = R s + a e_3 (from the centre of mass to the contact point), and b such that the centre of mass has the
acceleration -(omega' x r) - b, Euler's equations about the contact point are
    (1 + rho) s' = s x omega,   J omega' - m r x (r x omega') = J omega x omega - m r x b + V_x/(1 + rho) s x e_3,
where x = s_3, n = omega . s [E. J. Routh, Advanced Dynamics of a System of Rigid Bodies, ch. V].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kovacic.ball.ball import BallOnSphere
from kovacic.errors import InputError

Array = NDArray[np.float64]
Vector: TypeAlias = "Sequence[Any] | NDArray[Any]"
#: The range of numbers in a motion: products of several of them are still floats.
LEAST, LARGEST = 1e-50, 1e50


@dataclass(frozen=True, slots=True)
class Dynamics:
    """The parameters as floats, kappa = 1/R1, and what the equations need of them; vectors are sequences of components."""

    m: float
    R: float
    a: float
    A1: float
    A3: float
    kappa: float

    @classmethod
    def of(cls, sphere: BallOnSphere) -> Dynamics:
        """Raises `InputError` where a parameter is a symbol, or out of range."""
        values: list[float] = []
        for value in (*sphere.ball.parameters, 1 / sphere.R1):
            if not value.is_number:
                raise InputError(f"numbers are needed for a motion, and {value} isn't one")
            values.append(float(value))
            if value and not LEAST <= abs(values[-1]) <= LARGEST:
                raise InputError(
                    f"{values[-1]:.3g} isn't between {LEAST:g} and {LARGEST:g}", hint="choose units that bring it there"
                )
        return cls(*values)

    @property
    def rho(self) -> float:
        return self.R * self.kappa

    def D(self, x: Any) -> Any:
        """D(x) of `kovacic.ball.ball`."""
        return self.A1 * (self.A3 + self.m * self.R**2 * (1 - x * x)) + self.A3 * self.m * (self.R * x + self.a) ** 2

    def acceleration(self, s: Vector, omega: Vector) -> tuple[Any, Any, Any]:
        """b."""
        drift, k = cross(omega, s), self.R / (1 + self.rho)
        turn = cross(omega, (self.R * s[0], self.R * s[1], self.R * s[2] + self.a))
        return cross(omega, [p - k * q for p, q in zip(turn, drift, strict=True)])

    def rates(self, slope: Callable[[Any], Any], y: Vector) -> list[Any]:
        """The derivatives of omega, s, the rows of B, and the contact point's way on a plane; floats or arrays of them."""
        omega, s = y[:3], y[3:6]
        r = (self.R * s[0], self.R * s[1], self.R * s[2] + self.a)
        ds, moved = cross(s, omega), [cross(y[k : k + 3], omega) for k in (6, 9, 12)]
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
        """(omega_3, n) at x from their values at x0 = cos u0: the closed form of `kovacic.ball.ball`, on either sign of l."""

        def half(x: Any) -> Any:  # D'/2
            return self.m * self.R * ((self.A3 - self.A1) * self.R * x + self.A3 * self.a)

        weight, root0, root = self.m * self.R**2 * self.A1, np.sqrt(self.D(x0)), np.sqrt(self.D(x))
        eta0, zeta0 = omega_3 * root0, weight * n + half(x0) * omega_3
        scale = np.sqrt(complex(self.m * self.R**2 * (self.A3 - self.A1))) or 1e-30 * root0  # the limit of l -> 0
        angle = 2 * self.rho * np.arctanh(scale * (x - x0) / (root + root0))
        even, odd = np.cosh(angle).real, np.sinh(angle)
        eta = eta0 * even - zeta0 * (odd / scale).real
        zeta = zeta0 * even - eta0 * (odd * scale).real
        return eta / root, (zeta - half(x) * eta / root) / weight


def unsteadiness(y: Array, f: Array, rate: float) -> Array:
    """How far (omega, s) is from turning uniformly about the axis, as it does in steady motions; at most about 1."""
    z = np.array([y[1] / rate, -y[0] / rate, y[4], -y[3]])  # turned by -90 degrees
    change = np.array([f[0] / rate, f[1] / rate, f[3], f[4], f[2] / rate, f[5]]) / rate
    square = (z * z).sum(0)
    share = (change[:4] * z).sum(0) / np.where(square > 0, square, 1.0)
    result: Array = np.sqrt(((change[:4] - share * z) ** 2).sum(0) + (change[4:] ** 2).sum(0))
    return result


def cross(a: Vector, b: Vector) -> tuple[Any, Any, Any]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def colatitude(s: Array) -> Array:
    u: Array = np.arctan2(np.hypot(s[0], s[1]), s[2])
    return u

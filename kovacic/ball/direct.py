"""The reference: direct numerical integration of Woronetz's full equations of motion and of the constraints.

State: (u, v, theta, u1, v1, u', v', n); on the plane u1, v1 are the Cartesian coordinates of the contact point.  This uses
nothing of the closed form: only the kinetic energy and the coefficients of `kovacic.ball.woronetz`, for any body.
The coordinates are singular where f(u) = 0 and where sin(u1) = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from kovacic.ball.extrapolation import GUARD, extrapolate
from kovacic.ball.field import Element
from kovacic.ball.meridian import U, X
from kovacic.ball.potential import Potential, potential_of
from kovacic.ball.quantity import as_float, as_mpf, as_times, as_tolerance
from kovacic.ball.woronetz import Body, Quantities
from kovacic.errors import InputError, KovacicError

Array = NDArray[np.float64]

METHODS = ("DOP853", "Radau", "RK45", "RK23", "BDF", "LSODA")


@dataclass(frozen=True, slots=True)
class State:
    """Position and velocity at one instant: angles in radians, rates in radians per unit of time, n the spin.

    Floats, or exact numbers: Fraction, SymPy's, or text such as "sqrt(2)/2".

    v is the longitude of the contact point on the body, theta the angle between the meridians, u1 and v1 colatitude
    and longitude on the sphere (Cartesian coordinates on the plane).
    """

    u: Any
    v: Any
    theta: Any
    u1: Any
    v1: Any
    du: Any
    dv: Any
    n: Any


class IntegrationFailed(KovacicError):
    """A numerical integration didn't reach the end; the message is the solver's."""


@dataclass(frozen=True, slots=True)
class Equations:
    """The right-hand side of the eight equations and the energy, compiled for numpy's floats or for mpmath."""

    rates: Callable[[Any, Sequence[Any]], list[Any]]
    energy: Callable[[Sequence[Any]], Any]
    omega_3: Callable[[Sequence[Any]], Any]


def equations(body: Body, potential: Potential, module: str = "math") -> Equations:
    """Woronetz's equations for a body with numeric parameters under V(u) = `potential`; `module` is math or mpmath.

    Raises `InputError` if a parameter is still a symbol or V depends on anything but u.
    """
    if body.names:
        raise InputError(f"numbers are needed for a motion; still symbols: {', '.join(body.names)}")
    compiled = sp.lambdify(U, _coefficients(body.quantities(), potential_of(potential)), modules=module, cse=True)
    functions: Any = {"math": __import__("math"), "mpmath": mpmath}[module]
    sin, cos = functions.sin, functions.cos
    flat = body.R1.is_infinite

    def rates(_: Any, y: Sequence[Any]) -> list[Any]:
        u, _, theta, u1, _, du, dv, n = y
        K, dK, (P, Q, W, Y, Z, T), (spin, f, h, cos_psi, _, kappa), (_, dV) = compiled(u)
        K11, K22, K23, K33 = K
        dK11, dK22, dK23, dK33 = dK
        pn, pv = K33 * n + K23 * dv, K23 * n + K22 * dv
        quadratic = (dK33 * n * n + 2 * dK23 * dv * n - dK11 * du * du + dK22 * dv * dv) / 2
        ddu = (quadratic + P * pn * dv + Q * pv * n - spin * n * n - Z * n * dv - dV) / K11
        fn = du * (-W * K11 * dv - Q * pv + spin * n - T * dv - dK33 * n - dK23 * dv)
        fv = du * (-P * pn + W * K11 * n + Y * n - dK23 * n - dK22 * dv)
        det = K33 * K22 - K23 * K23
        forward, side = h * du, f * dv
        dx = side * cos(theta) - forward * sin(theta)
        dy = forward * cos(theta) + side * sin(theta)
        if flat:
            return [du, dv, -n - cos_psi * dv, dx, dy, ddu, (K33 * fv - K23 * fn) / det, (K22 * fn - K23 * fv) / det]
        dv1 = kappa * dy / sin(u1)
        turn = -n - cos_psi * dv - dv1 * cos(u1)
        return [du, dv, turn, kappa * dx, dv1, ddu, (K33 * fv - K23 * fn) / det, (K22 * fn - K23 * fv) / det]

    def energy(y: Sequence[Any]) -> Any:
        u, _, _, _, _, du, dv, n = y
        (K11, K22, K23, K33), _, _, _, (value, _) = compiled(u)
        return (K33 * n * n + 2 * K23 * dv * n + K11 * du * du + K22 * dv * dv) / 2 + value

    def omega_3(y: Sequence[Any]) -> Any:
        _, _, _, (_, f, _, cos_psi, sin_psi, kappa), _ = compiled(y[0])
        return (kappa * f - sin_psi) * sin_psi * y[6] + cos_psi * y[7]

    return Equations(rates, energy, omega_3)


def _coefficients(q: Quantities, V: sp.Expr) -> list[list[sp.Expr]]:
    c = q.meridian

    def at_u(element: Element) -> sp.Expr:
        return element.expression().subs(X, sp.cos(U) if c.trigonometric else U)

    K = (q.K11, q.K22, q.K23, q.K33)
    groups = (
        K,
        [c.derivative(entry) for entry in K],
        q.gyroscopic(),
        (q.m * c.h * q.q, c.f, c.h, c.cos_psi, c.sin_psi, q.kappa),
    )
    return [*([at_u(element) for element in group] for group in groups), [V, sp.diff(V, U)]]


@dataclass(frozen=True, slots=True)
class DirectSolution:
    """The state at the times asked for, `states` of shape (8, len(times)), with omega_3 and the energy."""

    times: Array
    states: Array
    omega_3: Array
    energy: Array
    evaluations: int


def integrate(
    body: Body,
    potential: Potential,
    state: State,
    times: Array,
    *,
    method: str = "DOP853",
    rtol: float = 1e-10,
    atol: float = 1e-12,
) -> DirectSolution:
    """The motion from `state` at time 0 by SciPy's `solve_ivp`, at increasing `times` >= 0.

    Raises `InputError` for what isn't a state, a time, a tolerance or a method of `solve_ivp`, and `IntegrationFailed`
    with the solver's message if it stops early.
    """
    if method not in METHODS:
        raise InputError(f"{method!r} isn't one of SciPy's methods {', '.join(METHODS)}")
    times, rtol, atol = as_times(times), as_tolerance(rtol, "rtol"), as_tolerance(atol, "atol")
    start = [as_float(value, name) for name, value in asdict(state).items()]
    if not np.isfinite(start).all():
        raise InputError("a motion can't start with numbers that aren't finite")
    system = equations(body, potential)
    # SciPy's own differences overflow in the columns of v and v1, on which nothing depends.
    extra: dict[str, Any] = {"jac": jacobian(system)} if method in {"Radau", "BDF"} else {}
    span = (0.0, float(times[-1]))
    try:
        result = solve_ivp(system.rates, span, start, method=method, t_eval=times, rtol=rtol, atol=atol, **extra)
    except OverflowError as error:  # of the math module, where NumPy has an infinity
        raise IntegrationFailed(f"the forces are beyond the range of floats ({error})") from error
    if not result.success:
        raise IntegrationFailed(str(result.message))
    columns = list(result.y.T)
    return DirectSolution(
        times=times,
        states=np.asarray(result.y, dtype=float),
        omega_3=np.array([system.omega_3(column) for column in columns]),
        energy=np.array([system.energy(column) for column in columns]),
        evaluations=int(result.nfev),
    )


def jacobian(system: Equations) -> Callable[[float, Array], Array]:
    """Central differences of the rates, with steps relative to max(1, |y_i|)."""

    def matrix(time: float, y: Array) -> Array:
        columns = []
        for i, value in enumerate(y):
            step = 1e-6 * max(1.0, abs(value))
            shift = np.zeros(len(y))
            shift[i] = step
            ahead, behind = system.rates(time, list(y + shift)), system.rates(time, list(y - shift))
            columns.append((np.array(ahead, dtype=float) - np.array(behind, dtype=float)) / (2 * step))
        return np.array(columns).T

    return matrix


def integrate_precisely(
    body: Body, potential: Potential, state: State, times: Sequence[Any], *, digits: int = 50
) -> list[State]:
    """The states at `times` (monotonic from 0, backwards too) in mpmath's arithmetic, with about `digits` right digits.

    A few seconds per unit of time at 50 digits; see `extrapolation` for the method.
    """
    if digits < 1:
        raise InputError(f"at least one digit, not {digits}")
    system = equations(body, potential, "mpmath")
    with mpmath.workdps(digits + GUARD):
        start = [as_mpf(value, name) for name, value in asdict(state).items()]
        instants = [as_mpf(value, "a time") for value in times]
    if not all(map(mpmath.isfinite, (*start, *instants))):
        raise InputError("a motion can't start with, or go on to, numbers that aren't finite")
    return [State(*values) for values in extrapolate(system.rates, start, instants, digits=digits)]

"""The motion of the ball from any start: u(t), omega_3(t), n(t), the contact point, the attitude, the reaction.

Symbols as in `kovacic.ball.body`; x = cos u.  With omega_3(x) and n(x) in closed form the motion is a quadrature,
t = int dx/sqrt(W(x)), which is singular at turning points, near the poles of the ball and where the motion is steady.
In the ball's own axes the same motion has no singularity (`kovacic.ball.dynamics`): it is integrated over one oscillation of
x, to about 5e-14.  One period T later the ball is where it was, but for a rotation: s and omega are turned
about the axis by an angle Delta, and with B' = B [omega]x, B(0) = 1,
    s(t + T) = Rz(Delta) s(t),   B(t + k T) = G^k B(t) Rz(-k Delta),   G = B(T) Rz(Delta),
so that 10^4 oscillations cost what one does.  omega_3 and n are given by their closed form, at x(t), and not by the
integration: `Motion.defects` compares the two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from kovacic.ball.body import BallOnSphere, Quantity
from kovacic.ball.dynamics import (
    Array,
    Dynamics,
    Force,
    Potential,
    as_float,
    colatitude,
    cross,
    dot,
    potential_of,
    unsteadiness,
)
from kovacic.errors import InputError, LimitExceeded

#: Evaluations of the equations for four turns: 20 s, where usual motions take some thousand.
_MOST_EVALUATIONS = 300_000
#: Oscillations that a motion is followed for: its errors, about 5e-14 for each, reach 5e-9.
_MOST_OSCILLATIONS = 100_000
#: A motion with a smaller `unsteadiness` is steady.
_STEADY = 1e-12
#: A motion whose `approach` is smaller is asymptotic, and followed for as long as two integrations, with tolerances that differ
#: by a factor of ten, agree to this accuracy.
_ASYMPTOTIC = 1e-6
#: The integrator's relative tolerance, the least that SciPy accepts.
_RELATIVE_TOLERANCE = 2.3e-14
_AXIS = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class MotionStart:
    """Position and velocity at time 0: angles in radians, rates in radians per unit of time, n the spin; floats or exact.

    v is the longitude of the contact point on the body, u1 and v1 are its colatitude and longitude on the sphere (Cartesian
    coordinates on the plane), theta is the angle from the direction of growing v1 to that of growing u on the body,
    e_u = -sin(theta) e_u1 + cos(theta) e_v1.  At a pole, u = 0 or pi, the meridian v is the one in which the contact point
    leaves it with the speed u'.  Inside a sphere, where R1 < 0, the paper's (u1, v1) are those of the antipode; here they are
    the contact point's.
    """

    u: Any
    du: Any
    dv: Any
    n: Any
    v: Any = 0
    theta: Any = 0
    u1: Any = 1
    v1: Any = 0


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion; its methods take times, an array of any shape or a number, negative ones too, and 0 is the start.

    `period` is the time of one oscillation of x = cos u; None for a steady motion, with constant u, and for an asymptotic
    one.  `determined` is the time up to which the digits of an asymptotic motion are known, from 0; other times raise
    `LimitExceeded`.  It is infinite for every other motion.
    `turning_points` are the least and the largest u: 0 or pi, up to rounding, for a path through a pole.
    The last index of a result is that of the vector.  Errors are about 5e-14 times the number of oscillations; beyond 10^5
    of these, `LimitExceeded` is raised.  `approach` is the least distance from an unstable steady motion relative to the
    greatest: if it is small, neighbouring motions part, and one passage multiplies errors by 1/approach^2.
    """

    ball: Dynamics
    force: Force
    start: MotionStart
    period: float | None
    turning_points: tuple[float, float]
    approach: float
    determined: float
    _solution: Callable[[Array], Array]
    _cycle: float
    _gain: float
    _turn: Array  # the rotation vector of G
    _space: Array

    def u(self, times: Any) -> Array:
        """The angle between the ball's axis and the normal, in [0, pi]."""
        return colatitude(self._at(times)[1][3:6])

    def omega_3(self, times: Any) -> Array:
        """The spin about the axis of symmetry, in closed form."""
        return self._closed(self._at(times)[1])[0]

    def n(self, times: Any) -> Array:
        """The spin about the common normal, in closed form."""
        return self._closed(self._at(times)[1])[1]

    def contact(self, times: Any) -> Array:
        """The contact point in space: on the sphere about the origin, or on the plane."""
        if self.ball.kappa:
            s = np.moveaxis(self.contact_on_ball(times), -1, 0)
            return _rotate(self.attitude(times), -s / self.ball.kappa)
        count, y = self._at(times)
        # The ways of `count` oscillations, each turned by one angle more, add up to a chord.
        angle = float(np.linalg.norm(self._turn))
        half = np.sin(angle / 2)
        chord = np.where(np.abs(half) > 1e-12, np.sin(angle * count / 2) / (half or 1.0), count)
        whole = _rotations(self._turn, (count - 1) / 2) @ self._solution(np.array(self._cycle))[15:]
        way = (_rotate(_rotations(self._turn, count), y[15:]) + chord[..., None] * whole) @ self._space.T
        return np.asarray(way * [1.0, 1.0, 0.0] + [self.start.u1, self.start.v1, 0.0], dtype=float)

    def contact_on_ball(self, times: Any) -> Array:
        """The unit vector from the ball's centre to the contact point, in its axes: (sin u cos v, sin u sin v, cos u)."""
        count, y = self._at(times)
        return _rotate(_rotations(_AXIS, count * self._gain), y[3:6])

    def attitude(self, times: Any) -> Array:
        """The ball's axes in space, as columns of (..., 3, 3)."""
        count, y = self._at(times)
        rows = np.moveaxis(y[6:15], 0, -1).reshape(*count.shape, 3, 3)
        return np.asarray(self._space @ _rotations(self._turn, count) @ rows @ _rotations(_AXIS, -count * self._gain))

    def energy(self, times: Any) -> Array:
        """Kinetic and potential energy, from the integrated angular velocity: constant up to its errors."""
        ball = self.ball
        _, y = self._at(times)
        velocity = cross(y[:3], ball.arm(y[3:6]))
        twice = ball.m * dot(velocity, velocity) + ball.A1 * (y[0] ** 2 + y[1] ** 2) + ball.A3 * y[2] ** 2
        return np.asarray(twice / 2 + self.force.value(colatitude(y[3:6])), dtype=float)

    def reaction(self, times: Any) -> Array | None:
        """The normal reaction of the sphere on the ball; negative where it would have to pull.

        None for a general potential V(u), which doesn't determine the force.
        """
        if self.force.g is None:
            return None
        ball = self.ball
        _, y = self._at(times)
        omega, s = y[:3], y[3:6]
        turn = cross(ball.rates(self.force.slope, y)[:3], ball.arm(s))
        lever = ball.a * ball.kappa / (1 + ball.rho)  # of the centre of mass, by the distance of the two centres
        weight = self.force.g * (1 + lever * s[2]) / np.sqrt(1 + lever**2 + 2 * lever * s[2])
        return np.asarray(ball.m * (dot(s, turn) + dot(s, ball.acceleration(s, omega)) + weight))

    def defects(self, times: Any) -> dict[str, Array]:
        """The closed forms of omega_3 and n at x(t) minus the components of the integrated angular velocity."""
        _, y = self._at(times)
        omega_3, n = self._closed(y)
        return {"omega_3": omega_3 - y[2], "n": n - dot(y[:3], y[3:6])}

    def _closed(self, y: Array) -> tuple[Array, Array]:
        start = self._solution(np.array(0.0))
        return self.ball.transport(y[5], start[5], start[2], self.start.n)

    def _at(self, times: Any) -> tuple[Array, Array]:
        """The number of whole oscillations, and the states (18, ...) in the first one."""
        instants = np.asarray(times, dtype=float)
        if not np.isfinite(instants).all():
            raise InputError("times must be finite")
        if np.isfinite(self.determined):
            end = f"{self.determined:.6g}"
            if ((instants < 0) | (instants > self.determined)).any():
                why = "it comes so near to an unstable steady motion that floats don't tell whether and when it turns"
                hint = f"times from 0 to {end}, or a velocity at the start that differs by 1e-5 of itself"
                lost = f"the motion is asymptotic, its digits are lost from t = {end} on: {why}\n  hint: {hint}"
                raise LimitExceeded(lost, limit="digits")
            return np.zeros(instants.shape), self._solution(instants.ravel()).reshape(18, *instants.shape)
        count = np.floor(instants / self._cycle)
        if np.abs(count).max(initial=0) > _MOST_OSCILLATIONS:
            end = f"{_MOST_OSCILLATIONS} oscillations, to t = {_MOST_OSCILLATIONS * self._cycle:.6g}"
            raise LimitExceeded(f"a motion is followed for {end}", limit="time")
        rest = np.clip(instants - count * self._cycle, 0, self._cycle)
        return count, self._solution(rest.ravel()).reshape(18, *rest.shape)


def solve_motion(
    sphere: BallOnSphere, start: MotionStart, *, gravity: Quantity | None = None, potential: Potential | None = None
) -> Motion:
    """The motion from `start` at t = 0 under a force of strength m g (default: g = 1), or with a potential energy V(u).

    `Force.gravity` says where the force points; V is text or SymPy, a smooth function of cos u.  Rolling is enforced, also
    where the reaction would have to pull: see `Motion.reaction`.
    Every start has a motion, at the poles and steady ones included.  Asymptotic ones, which come as near as 1e-6 to an
    unstable steady motion, depend on digits that floats don't have: they are followed up to `Motion.determined`.
    Raises `InputError` for symbolic parameters, numbers out of range and potentials that aren't smooth.

    >>> from kovacic.ball.body import RollingBall
    >>> sphere = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    >>> motion = solve_motion(sphere, MotionStart(u=1, du="1/2", dv=0, n=2))
    >>> bool(motion.turning_points[0] < 1 < motion.turning_points[1])
    True
    """
    ball = Dynamics.of(sphere)
    state = MotionStart(*(as_float(getattr(start, field.name), field.name) for field in fields(start)))
    if not 0 <= state.u <= np.pi:
        raise InputError(f"u is an angle between 0 and pi, not {state.u}")
    if potential is None:
        force = Force.gravity(sphere, 1 if gravity is None else gravity)
    elif gravity is None:
        force = Force.of(potential_of(potential))
    else:
        raise InputError("either gravity or a potential")
    frame = Rotation.from_euler("ZY", [state.v, state.u]).as_matrix()  # (e_u, e_v, e_r) as columns
    along = [(1 + ball.rho) * np.sin(state.u) * state.dv, -(1 + ball.rho) * state.du, state.n]
    y = np.concatenate([frame @ along, frame[:, 2], np.eye(3).ravel(), np.zeros(3)])
    slopes = np.abs(np.broadcast_to(force.slope(np.linspace(0, np.pi, 65)), 65))
    rate = float(np.linalg.norm(y[:3]) + np.sqrt(slopes.mean() / (ball.A1 + ball.m * ball.R**2))) or 1.0
    course = _follow(ball, force, y, rate)
    turned = course["_solution"](np.array(course["_cycle"]))
    before, after = (z[[0, 3]] + 1j * z[[1, 4]] for z in (y, turned))  # of omega and s, across the axis
    gain = float(np.angle((after * before.conj() * [rate**-2, 1.0]).sum()))
    turn = Rotation.from_matrix(turned[6:15].reshape(3, 3) @ _rotations(_AXIS, np.array(gain))).as_rotvec()
    space = _contact_frame(ball, state) @ frame.T
    return Motion(ball=ball, force=force, start=state, _gain=gain, _turn=turn, _space=space, **course)


def _contact_frame(ball: Dynamics, state: MotionStart) -> Array:
    """(e_u, e_v, e_r) at the start as columns in space: e_u = -sin(theta) e_u1 + cos(theta) e_v1; the normals are opposite.

    Inside a sphere e_u1, e_v1 are still the directions to the south and to the east, and the ball's normal is the sphere's.
    """
    s, c = np.sin(state.theta), np.cos(state.theta)
    side = -1.0 if ball.kappa < 0 else 1.0
    frame = np.array([[-s, side * c, 0.0], [c, side * s, 0.0], [0.0, 0.0, -side]])
    return np.asarray(Rotation.from_euler("ZY", [state.v1, state.u1]).as_matrix() @ frame) if ball.kappa else frame


def _follow(ball: Dynamics, force: Force, y: Array, rate: float) -> dict[str, Any]:
    """Fields of `Motion`: one oscillation from y, some time of a steady motion, or an asymptotic one as far as it is known."""

    def distances(states: Array) -> Array:
        return unsteadiness(states, np.array(ball.rates(force.slope, states)), rate)

    approach, determined, period = 1.0, np.inf, None
    if float(distances(y)) < _STEADY:
        solution = _integrate(ball, force, y, rate, turns=0)
        cycle = 10 / rate
        u = colatitude(y[3:6])
    else:
        solution = _integrate(ball, force, y, rate, turns=4)
        turns = solution.t_events[0]
        distance = distances(solution.y)
        approach = float(distance.min() / distance.max())
        # x'' at two turning points: the period is known best between those where it is larger.
        p = solution.sol(turns[:2])
        f = np.array(ball.rates(force.slope, p))
        first, second = np.abs(f[3] * p[1] + p[3] * f[1] - f[4] * p[0] - p[4] * f[0])
        start = 0 if first >= second else 1
        cycle = period = float(turns[start + 2] - turns[start])
        u = colatitude(p[3:6])
    if approach < _ASYMPTOTIC:
        rough = _integrate(ball, force, y, rate, turns=4, tolerance=10 * _RELATIVE_TOLERANCE)
        period = None
        cycle = determined = _last_agreement(solution, rough, rate)
        u = colatitude(solution.sol(np.array([0.0, *turns[turns < cycle], cycle]))[3:6])
    return {
        "_solution": solution.sol,
        "_cycle": cycle,
        "period": period,
        "turning_points": (float(u.min()), float(u.max())),
        "approach": approach,
        "determined": determined,
    }


def _last_agreement(fine: Any, rough: Any, rate: float) -> float:
    """The last time up to which two integrations agree in omega and s; the rough one errs ten times as much."""
    times = np.linspace(0.0, min(fine.t[-1], rough.t[-1]), 4000)
    scale = np.repeat([rate, 1.0], 3)[:, None]
    difference = np.abs((fine.sol(times) - rough.sol(times))[:6] / scale).max(axis=0)
    lost = np.append(difference > _ASYMPTOTIC, True)
    return float(times[max(int(lost.argmax()) - 1, 0)])


def _integrate(
    ball: Dynamics, force: Force, y: Array, rate: float, *, turns: int, tolerance: float = _RELATIVE_TOLERANCE
) -> Any:
    """SciPy's solution from y, until x' has been 0 `turns` times; without any, for the time 10/rate.

    Raises `LimitExceeded` after too many evaluations, and where the potential isn't smooth.
    """
    count = 0

    def rates(_: float, state: Array) -> list[Any]:
        nonlocal count
        count += 1
        if count > _MOST_EVALUATIONS:
            why = "it is almost asymptotic, or the potential isn't smooth"
            said = f"the motion doesn't turn within {_MOST_EVALUATIONS} evaluations of its equations: {why}"
            raise LimitExceeded(said, limit="evaluations")
        return ball.rates(force.slope, state.tolist())

    def speed(_: float, state: Array) -> float:  # (1 + rho) x', up to its sign
        return float(state[3] * state[1] - state[4] * state[0])

    speed.terminal = turns or False  # type: ignore[attr-defined]
    scale = np.repeat([rate, 1.0, ball.R], [3, 12, 3])
    end = (1e12 if turns else 10) / rate
    errors = {"rtol": tolerance, "atol": 1e-16 * (tolerance / _RELATIVE_TOLERANCE) * scale}
    events = speed if turns else None
    result = solve_ivp(rates, (0.0, end), y, events=events, dense_output=True, method="DOP853", **errors)
    if not result.success or (turns and len(result.t_events[0]) < turns):
        said = f"the motion can't be followed beyond t = {result.t[-1]:.6g}: {result.message}"
        raise LimitExceeded(said, limit="steps")
    return result


def _rotate(matrices: Array, vectors: Array) -> Array:
    """Matrices (..., 3, 3) times vectors (3, ...), as (..., 3)."""
    return np.asarray(np.einsum("...ij,j...->...i", matrices, vectors))


def _rotations(vector: Array, counts: Array) -> Array:
    """Rotations by `counts` times this rotation vector, (..., 3, 3)."""
    found = Rotation.from_rotvec(np.multiply.outer(np.ravel(counts), vector)).as_matrix()
    return np.asarray(found.reshape(*np.shape(counts), 3, 3))

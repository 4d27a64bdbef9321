"""The motion of the ball from any start: u(t), omega_3(t), n(t), the contact point, the attitude, the reaction.

Symbols as in `kovacic.ball.ball`; x = cos u.  With omega_3(x) and n(x) in closed form the motion is a quadrature,
t = int dx/sqrt(W(x)); the integral is singular at turning points, near the poles of the ball and where the motion is
steady.  In the ball's own axes the same motion has no singularity at all: with s the unit vector from the centre to the
contact point, omega the angular velocity, r = R s + a e_3 (from the centre of mass to the contact point),
    s' = s x omega/(1 + rho),   I omega' = J omega x omega - m r x b + V_x/(1 + rho) s x e_3,
    I = J + m (r^2 - r r^T),   b = omega x r' + omega x (omega x r),   x = s_3,   n = omega . s,
which are Euler's equations about the contact point [E. J. Routh, Advanced Rigid Dynamics, ch. V].  They are integrated
over one oscillation of x (`kovacic.ball.collocation`), to about 1e-15.

After the period T the ball is where it was, but for a rotation: s and omega are turned about the axis of the ball by an
angle Delta, and with B' = B [omega]x, B(0) = 1,
    s(t + T) = Rz(Delta) s(t),   B(t + k T) = G^k B(t) Rz(-k Delta),   G = B(T) Rz(Delta),
so that 10^4 oscillations cost what one does.  omega_3 and n are given by their closed form, at x(t), and not by the
integration: `Motion.defects` compares the two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, astuple, dataclass
from typing import Any

import numpy as np

from kovacic.ball.ball import BallOnSphere, Scalar, exact
from kovacic.ball.collocation import Array, Solution
from kovacic.ball.potential import Force, Potential
from kovacic.errors import InputError, LimitExceeded

#: The range of numbers in a motion: products of several of them are still floats.
LEAST, LARGEST = 1e-50, 1e50
#: The steps for one oscillation, about three radians of rotation each, and the oscillations that a motion is followed for.
MAX_STEPS, LONGEST = 5000, 1_000_000
#: Below the first a motion counts as steady; below the second, in the course of a motion, as asymptotic to a steady one.
_STEADY, _ASYMPTOTIC = 1e-12, 1e-7


@dataclass(frozen=True, slots=True)
class State:
    """Position and velocity at time 0: angles in radians, rates in radians per unit of time, n the spin; floats or exact.

    v is the longitude of the contact point on the body, theta the angle between the meridians, u1 and v1 colatitude
    and longitude on the sphere (Cartesian coordinates on the plane).  At a pole, u = 0 or pi, the meridian v is the one
    in which the contact point leaves it with the speed u'.
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
class Numbers:
    """The parameters as floats, kappa = 1/R1, and what Euler's equations need of them."""

    m: float
    R: float
    a: float
    A1: float
    A3: float
    kappa: float

    @classmethod
    def of(cls, sphere: BallOnSphere) -> Numbers:
        """Raises `InputError` where a parameter is a symbol, or out of range."""
        ball, values = sphere.ball, []
        for value in (ball.m, ball.R, ball.a, ball.A1, ball.A3, 1 / sphere.R1):
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

    def arm(self, s: Array) -> Array:
        """r = R s + a e_3."""
        result: Array = self.R * s + self.a * np.array([0.0, 0.0, 1.0])
        return result

    def acceleration(self, s: Array, omega: Array) -> Array:
        """b: the acceleration of the centre of mass is -(omega' x r) - b."""
        spin = _cross_matrix(omega)
        drift = self.R / (1 + self.rho) * _times(s, spin)
        return _times(_times(self.arm(s), spin) - drift, spin)

    def rates(self, slope: Callable[[Array], Array], states: Array) -> Array:
        """The derivatives of states (n, 6, 3): omega, s, the rows of B, and the contact point's way on a plane."""
        omega, s = states[:, 0], states[:, 1]
        spin = _cross_matrix(omega)
        result = np.empty_like(states)
        result[:, 1:5] = states[:, 1:5] @ spin
        result[:, 5] = self.R * np.einsum("nij,nj->ni", states[:, 2:5], result[:, 1])
        result[:, 1] /= 1 + self.rho
        r, J = self.arm(s), np.array([self.A1, self.A1, self.A3])
        torque = _times(J * omega, spin) - self.m * np.cross(r, self.acceleration(s, omega))
        sine = np.hypot(s[:, 0], s[:, 1])
        force = -slope(np.arctan2(sine, s[:, 2])) / (np.maximum(sine, 1e-300) * (1 + self.rho))  # V_x/(1 + rho)
        torque[:, 0] += force * s[:, 1]
        torque[:, 1] -= force * s[:, 0]
        square = (r * r)[:, [1, 0, 0]] + (r * r)[:, [2, 2, 1]]
        inertia = -self.m * r[:, :, None] * r[:, None, :]
        inertia[:, range(3), range(3)] = J + self.m * square
        result[:, 0] = np.linalg.solve(inertia, torque[:, :, None])[:, :, 0]
        return result

    def transport(self, x: Array, x0: float, omega_3: float, n: float) -> tuple[Array, Array]:
        """(omega_3, n) at x from their values at x0 = cos u0: the closed form of `kovacic.ball.ball`, on either sign of l."""

        def D(x: Any) -> Any:
            square = self.m * (self.R * x + self.a) ** 2
            return self.A1 * (self.A3 + self.m * self.R**2 * (1 - x * x)) + self.A3 * square

        def half(x: Any) -> Any:
            return self.m * self.R * ((self.A3 - self.A1) * self.R * x + self.A3 * self.a)

        weight, root0, root = self.m * self.R**2 * self.A1, np.sqrt(D(x0)), np.sqrt(D(x))
        eta0, zeta0 = omega_3 * root0, weight * n + half(x0) * omega_3
        scale = np.sqrt(complex(self.m * self.R**2 * (self.A3 - self.A1))) or 1e-30 * root0  # the limit of l -> 0
        angle = 2 * self.rho * np.arctanh(scale * (x - x0) / (root + root0))
        even, odd = np.cosh(angle).real, np.sinh(angle)
        eta = eta0 * even - zeta0 * (odd / scale).real
        zeta = zeta0 * even - eta0 * (odd * scale).real
        return eta / root, (zeta - half(x) * eta / root) / weight


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion; its methods take times, an array of any shape or a number, negative ones too, and 0 is the start.

    `period` is the time of one oscillation of x = cos u; None for a steady motion, where u stays constant.
    `turning_points` are the least and the largest u: 0 or pi, up to rounding, where the path goes through a pole.
    Vectors are the last index of what is returned.  Errors are about 1e-15 times the number of oscillations (more near an
    asymptotic motion, whose neighbours part exponentially); beyond 10^6 of these, `LimitExceeded` is raised.
    """

    ball: Numbers
    force: Force
    start: State
    period: float | None
    turning_points: tuple[float, float]
    _solution: Solution
    _cycle: float
    _gain: float
    _space: Array

    def u(self, times: Any) -> Array:
        """The angle between the ball's axis and the normal, in [0, pi]."""
        s = self.contact_on_ball(times)
        result: Array = np.arctan2(np.hypot(s[..., 0], s[..., 1]), s[..., 2])
        return result

    def omega_3(self, times: Any) -> Array:
        """The spin about the axis of symmetry, in closed form."""
        return self._closed(times)[0]

    def n(self, times: Any) -> Array:
        """The spin about the common normal, in closed form."""
        return self._closed(times)[1]

    def contact(self, times: Any) -> Array:
        """The contact point in space: on the sphere about the origin, or on the plane."""
        if self.ball.kappa:
            return -np.einsum("...ij,...j->...i", self.attitude(times), self.contact_on_ball(times)) / self.ball.kappa
        count, states = self._at(times)
        axis, angle = _axis_and_angle(self._return())
        turned = _rotation(axis, angle * count) @ states[..., 5, :, None]
        # The ways of `count` oscillations, each turned by one angle more, add up to a chord.
        half = np.sin(angle / 2)
        chord = np.where(np.abs(half) > 1e-12, np.sin(angle * count / 2) / (half or 1.0), count)
        whole = _rotation(axis, angle * (count - 1) / 2) @ self._solution(np.array([self._cycle]))[0, 5, :, None]
        way: Array = (turned + chord[..., None, None] * whole)[..., 0] @ self._space.T
        return way + np.array([self.start.u1, self.start.v1, 0.0])

    def contact_on_ball(self, times: Any) -> Array:
        """The unit vector from the ball's centre to the contact point, in the ball's axes: (sin u cos v, sin u sin v, cos u)."""
        count, states = self._at(times)
        return np.einsum("...ij,...j->...i", _about_axis(count * self._gain), states[..., 1, :])

    def attitude(self, times: Any) -> Array:
        """The ball's axes in space, as columns of (..., 3, 3)."""
        count, states = self._at(times)
        axis, angle = _axis_and_angle(self._return())
        result: Array = self._space @ _rotation(axis, angle * count) @ states[..., 2:5, :] @ _about_axis(-count * self._gain)
        return result

    def energy(self, times: Any) -> Array:
        """Kinetic and potential energy, from the integrated angular velocity: constant up to its errors."""
        _, states = self._at(times)
        omega, s = states[..., 0, :], states[..., 1, :]
        moments = np.array([self.ball.A1, self.ball.A1, self.ball.A3])
        velocity = np.cross(omega, self.ball.arm(s))
        twice = self.ball.m * (velocity**2).sum(-1) + (moments * omega**2).sum(-1)
        return np.asarray(twice / 2 + self.force.value(self.u(times)), dtype=float)

    def reaction(self, times: Any) -> Array | None:
        """The normal reaction of the sphere on the ball; negative: it would have to pull.  None under another potential.

        For a potential V(u) alone doesn't say which force it belongs to.
        """
        if self.force.g is None:
            return None
        ball, (_, states) = self.ball, self._at(times)
        flat = states.reshape(-1, 6, 3)
        omega, s = flat[:, 0], flat[:, 1]
        inertial = np.cross(ball.rates(self.force.slope, flat)[:, 0], ball.arm(s)) + ball.acceleration(s, omega)
        lever = ball.a * ball.kappa / (1 + ball.rho)  # of the centre of mass, by the distance of the two centres
        weight = self.force.g * (1 + lever * s[:, 2]) / np.sqrt(1 + lever**2 + 2 * lever * s[:, 2])
        result: Array = ball.m * ((s * inertial).sum(1) + weight)
        return result.reshape(states.shape[:-2])

    def defects(self, times: Any) -> dict[str, Array]:
        """The closed forms of omega_3 and n at x(t) less the integrated angular velocity's components."""
        _, states = self._at(times)
        omega, s = states[..., 0, :], states[..., 1, :]
        omega_3, n = self._closed(times)
        return {"omega_3": omega_3 - omega[..., 2], "n": n - (omega * s).sum(-1)}

    def _closed(self, times: Any) -> tuple[Array, Array]:
        _, states = self._at(times)
        u, spin = self.start.u, _body_frame(self.start) @ _contact_rates(self.ball, self.start)
        return self.ball.transport(states[..., 1, 2], float(np.cos(u)), float(spin[2]), self.start.n)

    def _return(self) -> Array:
        """G, the nearest rotation to it."""
        left, _, right = np.linalg.svd(self._solution(np.array([self._cycle]))[0, 2:5] @ _about_axis(np.array(self._gain)))
        result: Array = left @ right
        return result

    def _at(self, times: Any) -> tuple[Array, Array]:
        """The number of whole oscillations, and the states in the first one."""
        instants = np.asarray(times, dtype=float)
        if not np.isfinite(instants).all():
            raise InputError("times must be finite")
        count = np.floor(instants / self._cycle)
        if np.abs(count).max(initial=0) > LONGEST:
            raise LimitExceeded(
                f"a motion is followed for {LONGEST} oscillations, to t = {LONGEST * self._cycle:.6g}", limit="time"
            )
        rest = np.clip(instants - count * self._cycle, 0, self._cycle)
        return count, self._solution(rest.ravel()).reshape(*rest.shape, 6, 3)


def solve_motion(
    sphere: BallOnSphere, start: State, *, gravity: Scalar | None = None, potential: Potential | None = None
) -> Motion:
    """The motion from `start` at t = 0 under a force of strength m g (default: g = 1), or with a potential energy V(u).

    The force acts at the centre of mass and presses the ball to the fixed surface: towards the centre of the sphere, away
    from it inside, downwards on a plane.  V is text or SymPy, a smooth function of cos u.  Rolling is enforced, also where
    the reaction would have to pull: see `Motion.reaction`.
    Every start has a motion, at the poles and steady ones included, but for asymptotic ones, which come as near as 1e-7
    to an unstable steady motion: their further course depends on digits that floats don't have, and `LimitExceeded` says so.
    Raises `InputError` for symbolic parameters, numbers out of range and potentials that aren't smooth.

    >>> from kovacic.ball.ball import Ball
    >>> sphere = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    >>> motion = solve_motion(sphere, State(u=1, du="1/2", dv=0, n=2))
    >>> bool(motion.turning_points[0] < 1 < motion.turning_points[1])
    True
    """
    ball = Numbers.of(sphere)
    state = State(*(as_float(value, name) for name, value in asdict(start).items()))
    if not 0 <= state.u <= np.pi:
        raise InputError(f"u is an angle between 0 and pi, not {state.u}")
    force = Force.gravity(sphere, 1 if gravity is None else gravity) if potential is None else Force.of(potential)
    if gravity is not None and potential is not None:
        raise InputError("either gravity or a potential")
    frame = _body_frame(state)
    y = np.vstack([frame @ _contact_rates(ball, state), frame[:, 2], np.eye(3), np.zeros(3)])
    inertia = ball.A1 + ball.m * ball.R**2
    slopes = np.abs(force.slope(np.linspace(0, np.pi, 65)))
    rate = float(np.linalg.norm(y[0]) + np.sqrt(slopes.mean() / inertia)) or 1.0
    scale = np.ones((6, 1))
    scale[0], scale[5] = rate, ball.R

    def rates(states: Array) -> Array:
        return ball.rates(force.slope, states)

    solution = Solution(rates, y, scale, 1 / rate, [])
    if _unsteadiness(y[None], rates(y[None]), rate)[0] < _STEADY:
        cycle, period, turns = 10 / rate, None, np.zeros(1)
        while not solution.steps or solution.steps[-1].start < cycle:
            solution.extend()
    else:
        cycle, turns = _oscillation(solution, rate)
        period = cycle
    s0, s1 = y[:2, :2], solution(np.array([cycle]))[0, :2, :2]
    factor = np.array([1 / rate, 1.0])
    gain = float(np.angle(np.sum(factor**2 * (s1 @ [1, 1j]) * (s0 @ [1, -1j]))))
    tips = solution(turns)[:, 1]
    ends = np.sort(np.arctan2(np.hypot(tips[:, 0], tips[:, 1]), tips[:, 2]))
    space = _space_frame(state, flat=ball.kappa == 0) @ frame.T
    return Motion(ball, force, state, period, (float(ends[0]), float(ends[-1])), solution, cycle, gain, space)


def _oscillation(solution: Solution, rate: float) -> tuple[float, Array]:
    """The period and two successive turning points, where x' = 0; the solution is extended to reach beyond the period."""
    zeros: list[float] = []
    slopes: list[float] = []
    largest, mark, side = 0.0, 0.0, 0.0
    least, most = np.inf, 0.0
    needed = 3
    while len(zeros) < needed:
        if len(solution.steps) == MAX_STEPS:
            raise LimitExceeded(
                f"the motion doesn't turn within {MAX_STEPS} steps, t = {solution.steps[-1].start:.6g}: it is almost"
                " asymptotic, or the potential isn't smooth",
                limit="steps",
            )
        step = solution.extend()
        unsteady = _unsteadiness(step.values, step.slopes, rate)
        least, most = min(least, float(unsteady.min())), max(most, float(unsteady.max()))
        if least < _ASYMPTOTIC * most:
            raise LimitExceeded(
                f"the motion is asymptotic: by t = {step.start + step.length:.6g} it differs from a steady one by less than"
                f" {_ASYMPTOTIC:g}, where floats don't tell whether and when it turns\n"
                "  hint: change the initial velocity by 1e-5 of itself",
                limit="digits",
            )
        speeds = step.slopes[:, 1, 2]
        for time, speed in zip(step.times, speeds, strict=True):
            largest = max(largest, abs(speed))
            if abs(speed) <= 1e-3 * largest:
                continue
            if speed * side < 0:
                zeros.append(_zero(solution, mark, time))
                slopes.append(abs(_second(solution, zeros[-1])))
            mark, side = time, speed
        if len(zeros) >= 2 and slopes[1] > slopes[0]:
            needed = 4  # the period between the turning points where x'' is larger is known better
    return zeros[needed - 1] - zeros[needed - 3], np.array(zeros[:2])


def _speed(solution: Solution, times: Array) -> Array:
    """x' but for the factor 1 + rho."""
    y = solution(times)
    result: Array = y[:, 1, 0] * y[:, 0, 1] - y[:, 1, 1] * y[:, 0, 0]
    return result


def _second(solution: Solution, time: float) -> float:
    """x'' but for the same factor."""
    (y,) = solution(np.array([time]))
    (f,) = solution.rates(y[None])
    return float(f[1, 0] * y[0, 1] + y[1, 0] * f[0, 1] - f[1, 1] * y[0, 0] - y[1, 1] * f[0, 0])


def _zero(solution: Solution, low: float, high: float) -> float:
    """Where x' changes its sign, by dividing into 32 parts again and again."""
    for _ in range(11):
        grid = np.linspace(low, high, 33)
        speeds = _speed(solution, grid)
        k = int(np.argmax(speeds * speeds[-1] > 0))
        low, high = float(grid[max(k - 1, 0)]), float(grid[k])
    return (low + high) / 2


def _unsteadiness(states: Array, slopes: Array, rate: float) -> Array:
    """How far (omega, s) is from turning uniformly about the axis, as it does in steady motions; at most about 1."""
    scale = np.array([[1 / rate], [1.0]])
    change = slopes[:, :2] * (scale / rate)
    turned = states[:, :2, [1, 0, 2]] * [-1.0, 1.0, 0.0] * scale
    square = (turned * turned).sum((1, 2))
    share = (change * turned).sum((1, 2)) / np.where(square > 0, square, 1.0)
    result: Array = np.sqrt(((change - share[:, None, None] * turned) ** 2).sum((1, 2)))
    return result


def as_float(value: Any, name: str) -> float:
    """A float as it is; text and SymPy's numbers are read exactly."""
    if isinstance(value, float | np.floating):
        number = float(value)
    else:
        expression = exact(value, name)
        if not expression.is_number:
            raise InputError(f"{name} = {value} isn't a number")
        number = float(expression)
    if not abs(number) <= LARGEST:
        raise InputError(f"{name} = {value} isn't a number that a motion can start with")
    return number


def _contact_rates(ball: Numbers, start: State) -> Array:
    """omega's components along e_u, e_v and the normal."""
    return np.array([(1 + ball.rho) * np.sin(start.u) * start.dv, -(1 + ball.rho) * start.du, start.n])


def _body_frame(start: State) -> Array:
    """(e_u, e_v, the outward normal) at (u, v) as columns, in the ball's axes."""
    return _spherical(start.u, start.v)


def _spherical(u: float, v: float) -> Array:
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    return np.array([[cu * cv, -sv, su * cv], [cu * sv, cv, su * sv], [-su, 0.0, cu]])


def _space_frame(start: State, *, flat: bool) -> Array:
    """The same in space: e_u = -sin(theta) e_u1 + cos(theta) e_v1, and the normal is opposite to the sphere's."""
    south, east, out = np.eye(3) if flat else _spherical(start.u1, start.v1).T
    s, c = np.sin(start.theta), np.cos(start.theta)
    return np.column_stack([-s * south + c * east, c * south + s * east, -out])


def _times(vectors: Array, matrices: Array) -> Array:
    result: Array = (vectors[:, None, :] @ matrices)[:, 0]
    return result


def _cross_matrix(vectors: Array) -> Array:
    """[w]x, for which [w]x v = w x v and v [w]x = v x w."""
    result = np.zeros((*vectors.shape, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[..., k, j], result[..., j, k] = vectors[..., i], -vectors[..., i]
    return result


def _rotation(axis: Array, angles: Array) -> Array:
    """Rotations about an axis, one for each angle."""
    along = np.outer(axis, axis)
    c, s = np.cos(angles)[..., None, None], np.sin(angles)[..., None, None]
    result: Array = along + c * (np.eye(3) - along) + s * _cross_matrix(axis)
    return result


def _about_axis(angles: Array) -> Array:
    return _rotation(np.array([0.0, 0.0, 1.0]), angles)


def _axis_and_angle(rotation: Array) -> tuple[Array, float]:
    """A rotation's axis, any for the identity, and its angle in [-pi, pi]."""
    _, _, (across, _, axis) = np.linalg.svd(rotation - np.eye(3))
    turned = rotation @ across
    return axis, float(np.arctan2(axis @ np.cross(across, turned), across @ turned))

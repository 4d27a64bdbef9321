"""The motion of the ball from any start: u(t), omega_3(t), n(t), the contact point, the attitude, the reaction.

Symbols as in `kovacic.ball.body`; x = cos u.  The quadrature t = int dx/sqrt(W(x)) is singular at turning points, poles, and
for steady motions; in the ball's own axes nothing is.  With s the unit vector from the centre to the contact point, omega the
angular velocity, r = R s + a e_3 (from the centre of mass to the contact point), and b such that the centre of mass has the
acceleration -(omega' x r) - b, Euler's equations about the contact point are
    (1 + rho) s' = s x omega,   J omega' - m r x (r x omega') = J omega x omega - m r x b + V_x/(1 + rho) s x e_3,
where x = s_3, n = omega . s [E. J. Routh, Advanced Dynamics of a System of Rigid Bodies, ch. V].  They are integrated over one
oscillation of x, to about 5e-14.  One period T later s and omega are turned about the axis by an angle Delta, and with
B' = B [omega]x, B(0) = 1,
    s(t + T) = Rz(Delta) s(t),   B(t + k T) = G^k B(t) Rz(-k Delta),   G = B(T) Rz(Delta):
10^4 oscillations cost as much as one.  omega_3 and n are given by their closed form; `Motion.defects` compares it with the
integration.  V is a function of cos u alone, as for a force towards the centre of the sphere, or gravity on a plane.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from kovacic.ball.body import BallOnSphere, Quantity, U, exact_quantity, read_short
from kovacic.errors import InputError, LimitExceeded

Array = NDArray[np.float64]
Vector: TypeAlias = "Sequence[Any] | NDArray[Any]"
Potential: TypeAlias = "sp.Expr | str | float"
#: The range of numbers in a motion: products of several of them, and of their inverses, are still floats.
_LARGEST_NUMBER = 1e50
#: Evaluations of the equations for four turns: 20 s, where usual motions take some thousand.
_MOST_EVALUATIONS = 300_000
#: Oscillations that a motion is followed for: its errors, about 5e-14 for each, reach 5e-9.
_MOST_OSCILLATIONS = 100_000
#: A motion with a smaller `unsteadiness` is steady.
_STEADY = 1e-12
#: A motion whose `approach` is smaller is asymptotic, and followed while integrations with tolerances t and 10 t agree to this.
_ASYMPTOTIC = 1e-6
#: The integrator's relative tolerance, the least that SciPy accepts.
_RELATIVE_TOLERANCE = 2.3e-14
_AXIS = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class Force:
    """V(u), and V and V' compiled for NumPy arrays; g is the strength of `gravity`, or None for another potential."""

    V: sp.Expr
    value: Callable[[Any], Any]
    slope: Callable[[Any], Any]
    g: float | None = None

    @classmethod
    def of(cls, V: sp.Expr, g: float | None = None) -> Force:
        """The force with the potential V(u).  Raises `InputError` unless V is finite, and even about both poles."""
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
        """A force m g at the centre of mass towards the centre of the sphere, away from it inside, downwards on a plane.

        A negative g pulls the ball off.  The centre of mass is at the distance d/|k| from the sphere's,
        d^2 = 1 + a^2 k^2 + 2 a k cos u, 1/k = R1 + R; V is m g (d - 1)/k.
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
        span = f"between {1 / _LARGEST_NUMBER:g} and {_LARGEST_NUMBER:g}"
        hint = f"numbers are needed; choose units that bring them {span}"
        raise InputError(f"{name} = {value} isn't a number that a motion can start with", hint=hint)
    return float(number)


def potential_of(value: Potential) -> sp.Expr:
    """V as a SymPy expression in u; floats are their binary values, decimals in text are exact.

    Raises `InputError` for anything but a real elementary function of u, and `LimitExceeded` if it is too long.
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
        weight = self.m * self.R**2 * self.A1
        root0, root = np.sqrt(self.D(x0)), np.sqrt(self.D(x))
        half0, half = (self.m * self.R * ((self.A3 - self.A1) * self.R * z + self.A3 * self.a) for z in (x0, x))  # D'/2
        eta0, zeta0 = omega_3 * root0, weight * n + half0 * omega_3
        scale = np.sqrt(complex(self.m * self.R**2 * (self.A3 - self.A1))) or 1e-30 * root0  # the limit of l -> 0
        angle = 2 * self.rho * np.arctanh(scale * (x - x0) / (root + root0))
        even, odd = np.cosh(angle).real, np.sinh(angle)
        eta = eta0 * even - zeta0 * (odd / scale).real
        zeta = zeta0 * even - eta0 * (odd * scale).real
        return eta / root, (zeta - half * eta / root) / weight


def unsteadiness(ball: Dynamics, force: Force, y: Array, rate: float) -> Array:
    """The distance of (omega, s) from turning uniformly about the axis, as in steady motions; at most about 1."""
    f = np.array(ball.rates(force.slope, y))
    z = np.array([y[1] / rate, -y[0] / rate, y[4], -y[3]])  # turned by -90 degrees
    change = np.array([f[0] / rate, f[1] / rate, f[3], f[4], f[2] / rate, f[5]]) / rate
    square = (z * z).sum(0)
    share = (change[:4] * z).sum(0) / np.where(square > 0, square, 1.0)
    return np.asarray(np.sqrt(((change[:4] - share * z) ** 2).sum(0) + (change[4:] ** 2).sum(0)))


def cross(a: Vector, b: Vector) -> tuple[Any, Any, Any]:  # for three floats eighty times as fast as NumPy's
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def colatitude(s: Array) -> Array:
    return np.asarray(np.arctan2(np.hypot(s[0], s[1]), s[2]))


@dataclass(frozen=True, slots=True)
class MotionStart:
    """Position and velocity at time 0: angles in radians, rates in radians per unit of time, n the spin; floats or exact.

    v is the longitude of the contact point on the body, u1 and v1 are its colatitude and longitude on the sphere (Cartesian
    coordinates on the plane), theta is the angle from e_v1 to e_u, e_u = -sin(theta) e_u1 + cos(theta) e_v1.  At a pole, u = 0
    or pi, the contact point leaves in the meridian v with the speed u'.  Inside a sphere the paper's (u1, v1) are those of the
    antipode; here they are the contact point's.
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

    `period` is the time of one oscillation of x = cos u; None for a steady motion, with constant u, and for an asymptotic one,
    whose digits are known from 0 to `determined`; other times raise `LimitExceeded`, as do those beyond 10^5 oscillations.
    Errors are about 5e-14 times the number of oscillations.  `turning_points` are the least and the largest u: 0 or pi for a
    path through a pole.  The last index of a result is that of the vector.  `approach` is the least distance from an unstable
    steady motion relative to the greatest: one passage multiplies errors by 1/approach^2.
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
        return self._spins(self._at(times)[1])[0]

    def n(self, times: Any) -> Array:
        """The spin about the common normal, in closed form."""
        return self._spins(self._at(times)[1])[1]

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
        omega_3, n = self._spins(y)
        return {"omega_3": omega_3 - y[2], "n": n - dot(y[:3], y[3:6])}

    def _spins(self, y: Array) -> tuple[Array, Array]:
        """omega_3 and n in closed form."""
        start = self._solution(np.array(0.0))
        return self.ball.transport(y[5], start[5], start[2], self.start.n)

    def _at(self, times: Any) -> tuple[Array, Array]:
        """The number of whole oscillations, and the states (18, ...) in the first one."""
        instants = np.asarray(times, dtype=float)
        if not np.isfinite(instants).all():
            raise InputError("times must be finite")
        count = np.floor(instants / self._cycle)
        if np.isfinite(self.determined):
            count = np.zeros(instants.shape)
            if ((instants < 0) | (instants > self.determined)).any():
                end = f"{self.determined:.6g}"
                why = "it comes so near to an unstable steady motion that floats don't tell whether and when it turns"
                hint = f"times from 0 to {end}, or a velocity at the start that differs by 1e-5 of itself"
                lost = f"the motion is asymptotic, its digits are lost from t = {end} on: {why}\n  hint: {hint}"
                raise LimitExceeded(lost, limit="digits")
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
    where the reaction would have to pull.  Every start has a motion; asymptotic ones, which come as near as 1e-6 to an unstable
    steady motion, depend on digits that floats don't have.
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
    # (e_u, e_v, e_r) at the start as columns in space: e_u = -sin(theta) e_u1 + cos(theta) e_v1; the normals are opposite.
    # Inside a sphere e_u1, e_v1 are still the directions to the south and to the east, and the ball's normal is the sphere's.
    s, c = np.sin(state.theta), np.cos(state.theta)
    side = -1.0 if ball.kappa < 0 else 1.0
    in_space = np.array([[-s, side * c, 0.0], [c, side * s, 0.0], [0.0, 0.0, -side]])
    if ball.kappa:
        in_space = Rotation.from_euler("ZY", [state.v1, state.u1]).as_matrix() @ in_space
    space = in_space @ frame.T
    return Motion(ball=ball, force=force, start=state, _gain=gain, _turn=turn, _space=space, **course)


def _follow(ball: Dynamics, force: Force, y: Array, rate: float) -> dict[str, Any]:
    """Fields of `Motion`: one oscillation from y, some time of a steady motion, or an asymptotic one as far as determined."""
    approach, determined, period = 1.0, np.inf, None
    if float(unsteadiness(ball, force, y, rate)) < _STEADY:
        solution = _integrate(ball, force, y, rate, turns=0)
        cycle = 10 / rate
        u = colatitude(y[3:6])
    else:
        solution = _integrate(ball, force, y, rate, turns=4)
        turns = solution.t_events[0]
        distance = unsteadiness(ball, force, solution.y, rate)
        approach = float(distance.min() / distance.max())
        # x'' at two turning points: the period is known best between those where it is larger.
        p = solution.sol(turns[:2])
        f = np.array(ball.rates(force.slope, p))
        first, second = np.abs(f[3] * p[1] + p[3] * f[1] - f[4] * p[0] - p[4] * f[0])
        start = 0 if first >= second else 1
        cycle = period = float(turns[start + 2] - turns[start])
        u = colatitude(p[3:6])
    if approach < _ASYMPTOTIC:
        rough = _integrate(ball, force, y, rate, turns=4, looser=10)
        # The last time up to which the two agree in omega and s: the rough one errs ten times as much.
        times = np.linspace(0.0, min(solution.t[-1], rough.t[-1]), 4000)
        scale = np.repeat([rate, 1.0], 3)[:, None]
        difference = np.abs((solution.sol(times) - rough.sol(times))[:6] / scale).max(axis=0)
        lost = int(np.append(difference > _ASYMPTOTIC, True).argmax())
        period = None
        cycle = determined = float(times[max(lost - 1, 0)])
        u = colatitude(solution.sol(np.array([0.0, *turns[turns < cycle], cycle]))[3:6])
    turning_points = float(u.min()), float(u.max())
    course = {"period": period, "turning_points": turning_points, "approach": approach, "determined": determined}
    return course | {"_solution": solution.sol, "_cycle": cycle}


def _integrate(ball: Dynamics, force: Force, y: Array, rate: float, *, turns: int, looser: int = 1) -> Any:
    """SciPy's solution from y, until x' has been 0 `turns` times; without any, for the time 10/rate."""
    evaluations = iter(range(_MOST_EVALUATIONS))

    def rates(_: float, state: Array) -> list[Any]:
        if next(evaluations, None) is None:
            why = "it is almost asymptotic, or the potential isn't smooth"
            said = f"the motion doesn't turn within {_MOST_EVALUATIONS} evaluations of its equations: {why}"
            raise LimitExceeded(said, limit="evaluations")
        return ball.rates(force.slope, state.tolist())

    def speed(_: float, state: Array) -> float:  # (1 + rho) x', up to its sign
        return float(state[3] * state[1] - state[4] * state[0])

    speed.terminal = turns or False  # type: ignore[attr-defined]
    scale = np.repeat([rate, 1.0, ball.R], [3, 12, 3])
    end = (1e12 if turns else 10) / rate
    errors = {"rtol": looser * _RELATIVE_TOLERANCE, "atol": looser * 1e-16 * scale}
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

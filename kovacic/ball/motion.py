"""The motion of the ball under a potential V(u), by quadratures.

Symbols as in `kovacic.ball.ball`; x = cos u.  With omega_3(x), n(x) in closed form, the energy integral is
    (dx/dt)^2 = W(x) = [2 (H - V)(1 - x^2) - T(x)] / K11,   T = `NumericBall.transverse_energy`,
which is regular at the poles x = +-1, where it is <= 0.  Between the turning points x = mid + amp cos(phi), and
    dphi/dt = Q(phi) = sqrt(W / ((x_max - x)(x - x_min))) > 0,
so t and v are quadratures over phi (`kovacic.ball.series`), valid through any number of turning points: 10^4
oscillations cost what one does.  v' = (x n - omega_3)/((1 + rho)(1 - x^2)) is nearly singular when the path passes near a
pole of the body; that part is integrated exactly.

The place on the fixed surface isn't a quadrature in general: the body's attitude obeys a linear equation on SO(3) with
quasi-periodic coefficients.  `kovacic.ball.attitude` integrates it over one oscillation, and powers of that step
carry it on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.optimize import brentq

from kovacic.ball import series
from kovacic.ball.ball import BallOnSphere
from kovacic.ball.closed import LARGEST, NumericBall
from kovacic.ball.direct import State
from kovacic.ball.potential import Potential, compiled
from kovacic.ball.quantity import as_float, as_tolerance
from kovacic.ball.series import Primitive
from kovacic.errors import InputError

Array = NDArray[np.float64]

#: For the series whose error is one of the period or of the gain of v, which the number of oscillations multiplies.
_FINEST = 1e-14
#: Of one piece of W, as a function of u, on the way to a turning point.
_NODES = 32


@dataclass(frozen=True, slots=True)
class Band:
    """The band between the turning points, with the distances from the poles kept apart to full relative accuracy.

    x_max = 1 - top, x_min = -1 + bottom, amp = (x_max - x_min)/2.
    """

    top: float
    bottom: float
    amp: float

    def x(self, phi: Array) -> Array:
        """cos u, in [x_min, x_max]."""
        result: Array = (self.bottom - self.top) / 2 + self.amp * np.cos(phi)
        return result

    def sine(self, phi: Array) -> Array:
        """sin u >= 0, without cancellation near the poles."""
        above = self.top + 2 * self.amp * np.sin(phi / 2) ** 2
        below = self.bottom + 2 * self.amp * np.cos(phi / 2) ** 2
        return np.sqrt(above * below)

    def colatitude(self, phi: Array) -> Array:
        """u in [0, pi]."""
        u: Array = np.arctan2(self.sine(phi), self.x(phi))
        return u


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion: `phase(t)` gives phi, everything else is a function of phi; see `solve_motion`.

    `period` is the time of one oscillation of u (one passage from turning point to turning point and back).
    """

    ball: NumericBall
    potential: Callable[[Any], Any]
    start: State
    energy: float
    band: Band
    omega_3_0: float
    speed: Array
    time: Primitive
    longitude: Primitive
    phi_0: float
    tolerance: float

    @property
    def period(self) -> float:
        return self.time.over_period

    @property
    def turning_points(self) -> tuple[float, float]:
        """The least and the largest u, in radians; 0 or pi where the path goes through a pole."""
        ends = self.band.colatitude(np.array([0.0, np.pi]))
        return float(ends[0]), float(ends[1])

    def phase(self, times: Array) -> Array:
        """phi at the given times, negative ones too; time 0 is the initial state."""
        instants = np.asarray(times, dtype=float)
        if not np.isfinite(instants).all():
            raise InputError("times must be finite")
        begin = float(self.time(np.array(self.phi_0)))
        return series.invert(self.time, instants + begin, self.tolerance)

    def rotation(self, phi: Array) -> tuple[Array, Array]:
        """(omega_3, n) at phi, from the closed form."""
        omega_3, n = self.ball.transport(self.band.x(phi), np.cos(self.start.u), self.omega_3_0, self.start.n)
        return omega_3, n

    def v(self, phi: Array) -> Array:
        """The longitude of the contact point on the body, in radians, continuous except through a pole itself."""
        result: Array = self.start.v + self.longitude(phi) - self.longitude(np.array(self.phi_0))
        return result

    def phase_speed(self, phi: Array) -> Array:
        """dphi/dt."""
        result: Any = chebyshev.chebval(np.cos(phi), self.speed)
        return np.asarray(result, dtype=float)

    def rates(self, phi: Array) -> tuple[Array, Array]:
        """(u', v'), not defined at a pole."""
        sine, x = self.band.sine(phi), self.band.x(phi)
        omega_3, n = self.rotation(phi)
        du = self.band.amp * np.sin(phi) * self.phase_speed(phi) / sine
        return du, (x * n - omega_3) / ((1 + self.ball.rho) * sine**2)

    def energies(self, phi: Array) -> Array:
        """The energy from u, u', v' and n at phi, not at a pole: `energy` up to the errors of the series."""
        sine2, x = self.band.sine(phi) ** 2, self.band.x(phi)
        omega_3, n = self.rotation(phi)
        du, _ = self.rates(phi)
        twice = self.ball.K11(x) * du**2 + self.ball.transverse_energy(x, sine2, omega_3, n) / sine2
        result: Array = twice / 2 + self.potential(self.band.colatitude(phi))
        return result


def solve_motion(sphere: BallOnSphere, potential: Potential, state: State, *, tolerance: float = 1e-13) -> Motion:
    """The motion with V(u) = `potential` (text or SymPy: a smooth function of cos u) from `state` at t = 0.

    `tolerance` bounds the relative error of t(phi) and of the attitude (1e-13 is about the rounding of floats); what the
    number of oscillations multiplies is always as exact as floats allow.
    Raises `InputError` for symbolic parameters, for a start at a pole of the body (u = 0 or pi: v isn't defined), for
    a steady motion, where u stays constant, and for an asymptotic one, which never turns and so has no phase;
    `LimitExceeded` for a motion that takes almost forever to turn (less than about 1e-6 of its energy away from an
    asymptotic one).  `kovacic.ball.direct` integrates all of these but the start at a pole.

    >>> from kovacic.ball.ball import Ball
    >>> sphere = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    >>> motion = solve_motion(sphere, "cos(u)", State(1.0, 0, 0, 1, 0, 0.5, 0.3, 2.0))
    >>> 0 < motion.turning_points[0] < 1 < motion.turning_points[1]
    True
    """
    tolerance = as_tolerance(tolerance, "the tolerance")
    ball = NumericBall.of(sphere, np)
    start = State(*(as_float(value, name) for name, value in asdict(state).items()))
    for name, value in asdict(start).items():
        if not abs(value) <= LARGEST:
            raise InputError(f"{name} = {value} isn't a number that a motion can start with")
    u0, du, dv, n0 = start.u, start.du, start.dv, start.n
    if not 0 < u0 < np.pi:
        raise InputError(f"the motion must start between the poles, 0 < u < pi, not at u = {u0}")
    V = compiled(potential)
    x0, s0 = np.cos(u0), np.sin(u0)
    omega0 = x0 * n0 - (1 + ball.rho) * s0**2 * dv
    transverse = ball.transverse_energy(x0, s0**2, omega0, n0)
    energy = float((ball.K11(x0) * du**2 + transverse / s0**2) / 2 + V(u0))

    def numerator(x: Any, sine2: Any) -> Any:
        omega_3, n = ball.transport(x, x0, omega0, n0)
        u = np.arctan2(np.sqrt(sine2), x)
        return 2 * (energy - V(u)) * sine2 - ball.transverse_energy(x, sine2, omega_3, n)

    cancelling = 2 * (abs(energy) + abs(float(V(u0)))) * s0**2 + transverse
    band = _turning_points(lambda x, sine2: numerator(x, sine2) / ball.K11(x), u0, float(cancelling / ball.K11(x0)))

    def speed(phi: Array) -> Array:
        x = band.x(phi)
        W = numerator(x, band.sine(phi) ** 2) / ball.K11(x)
        square: Array = W / (band.amp * np.sin(phi)) ** 2
        if square.min() <= 0:
            raise InputError(
                "the motion is asymptotic, or nearly: W has a double zero at a turning point", hint=series.ASYMPTOTIC
            )
        root: Array = np.sqrt(square)
        return root

    # The quotient is 0/0 at the turning points, so it is sampled once, coarsely, and continued as a Chebyshev series.
    Q = series.cosine_series(speed, _FINEST)

    def longitude_numerator(phi: Array) -> Array:
        x = band.x(phi)
        omega_3, n = ball.transport(x, x0, omega0, n0)
        quotient: Array = (x * n - omega_3) / ((1 + ball.rho) * chebyshev.chebval(np.cos(phi), Q))
        return quotient

    time = Primitive.of(series.cosine_series(lambda phi: 1 / chebyshev.chebval(np.cos(phi), Q), tolerance))
    longitude = _longitude(band, longitude_numerator)
    height = np.clip((x0 - (band.bottom - band.top) / 2) / band.amp, -1.0, 1.0)
    phi_0 = float(np.arccos(height)) if du >= 0 else -float(np.arccos(height))
    return Motion(ball, V, start, energy, band, float(omega0), Q, time, longitude, phi_0, tolerance)


def _turning_points(W: Callable[[Any, Any], Any], u0: float, scale: float) -> Band:
    """The zeros of W(x, 1 - x^2) on both sides of u0; `scale` is the size of what cancels in W at u0."""

    def from_pole(sign: int) -> Callable[[float], float]:
        """W as a function of the angle from the pole x = `sign`, exact near it."""
        return lambda w: float(W(sign * np.cos(w), np.sin(w) ** 2))

    along = from_pole(1)
    at_rest = along(u0) <= 1e-13 * scale
    step = 1e-6 * min(u0, np.pi - u0)
    slope = (along(u0 + step) - along(u0 - step)) / (2 * step)
    if at_rest and abs(slope) <= 1e-9 * scale:
        raise InputError(f"the motion is steady: u = {u0} stays constant")

    def distance(sign: int, begin: float) -> float:
        """The distance 1 - cos w of the turning point from the pole x = `sign`, from which the start is at an angle `begin`."""
        F = from_pole(sign)
        if at_rest and sign * slope > 0:
            return float(2 * np.sin(begin / 2) ** 2)

        def deflated(w: float) -> float:
            return abs(slope) if w == begin else F(w) / (begin - w)

        w = _largest_zero(deflated if at_rest else F, begin, 1e-30 * scale)
        return float(2 * np.sin(w / 2) ** 2)

    top, bottom = distance(1, u0), distance(-1, np.pi - u0)
    return Band(top, bottom, 1 - (top + bottom) / 2)


def _largest_zero(F: Callable[[float], float], begin: float, negligible: float) -> float:
    """The largest zero in [0, begin] of F, which is positive at `begin`; 0 where there is none before the pole w = 0.

    F is interpolated piece by piece, and looked at between the real zeros of the interpolants: a zero is where F turns
    negative.  At the pole itself F is minus a square, and counts as negative beyond `negligible`.
    """
    nodes = np.cos((np.arange(_NODES) + 0.5) * np.pi / _NODES)
    above = end = length = begin
    while end > 0:
        start = max(0.0, end - length)
        middle, half = (start + end) / 2, (end - start) / 2
        coefficients = chebyshev.chebfit(nodes, [F(middle + half * z) for z in nodes], _NODES - 1)
        size = np.abs(coefficients)
        if size[-4:].max() > 1e-9 * size.max():
            length = (end - start) / 2
            if length < 1e-6:
                raise InputError(
                    f"the potential isn't smooth: its part near an angle {end:.4g} from a pole isn't resolved"
                )
            continue
        roots = chebyshev.chebroots(chebyshev.chebtrim(coefficients, 1e-15 * size.max()))
        near = roots.real[(np.abs(roots.imag) < 1e-7) & (np.abs(roots.real) < 1)]
        stops = [end, *(middle + half * np.sort(near)[::-1]), start]
        for gate in [*((p + q) / 2 for p, q in pairwise(stops)), start]:
            value = F(gate)
            if value < (0 if gate > 0 else -negligible):
                return float(brentq(F, gate, above, xtol=1e-300, rtol=1e-15, maxiter=500))
            if value > 0:
                above = gate
        end, length = start, 2 * (end - start)
    return 0.0


def _longitude(band: Band, numerator: Callable[[Array], Array]) -> Primitive:
    """The primitive of numerator/(1 - x^2) over phi, as half the sum of numerator/(1 - x) and numerator/(1 + x)."""
    G = series.cosine_series(numerator, _FINEST)
    regular = np.zeros(1)
    near: list[tuple[float, float, float]] = []
    for sign, gap in ((1, band.top), (-1, band.bottom)):
        pole = sign * (1 + gap / band.amp)
        if gap > 0.05 * band.amp:
            part = series.cosine_series(
                lambda phi, pole=pole, sign=sign: (  # type: ignore[misc]
                    chebyshev.chebval(np.cos(phi), G) / (2 * band.amp * sign * (pole - np.cos(phi)))
                ),
                _FINEST,
            )
        else:
            H, value = series.divide(G, pole)
            part = -sign * H / (2 * band.amp)
            width = np.sqrt(gap * (gap + 2 * band.amp))
            offset = 0.0 if sign > 0 else np.pi
            if gap == 0:
                near.append((offset, 0.5, np.inf))
            else:
                near.append((offset, value / (2 * width), float(np.sqrt((gap + 2 * band.amp) / gap))))
        size = max(len(regular), len(part))
        regular = np.pad(regular, (0, size - len(regular))) + np.pad(part, (0, size - len(part)))
    return Primitive.of(regular, tuple(near))

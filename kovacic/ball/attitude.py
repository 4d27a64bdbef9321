"""The place of the ball on the fixed surface: its attitude in space and the contact point, through any number of oscillations.

In axes fixed in the ball the contact point on its unit sphere is s = (sin u cos v, sin u sin v, cos u); the angular
velocity and ds/dt are smooth there, at the poles too.  With phi in place of t, the pose X = (attitude, contact point) in
SE(3) obeys the linear equation `dX/dphi = X Xi(phi)`, and `Xi(phi + 2 pi)` is Xi rotated about the ball's axis by the gain
Delta of v in one oscillation.  Hence
    X(phi + 2 pi k) = M^k X(phi) Rz(-k Delta),   M = X(2 pi) Rz(Delta):
one oscillation is integrated (Gauss's collocation, eight stages, which keeps the attitude orthogonal to rounding), the
powers of M do the rest.  On the sphere the contact point is -R1 times the common normal; on the plane it is the
translation part of X.  In general there is no closed form for X: this is where the quadratures end.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from kovacic.ball.motion import Motion
from kovacic.errors import LimitExceeded

Array = NDArray[np.float64]
_STAGES = 8


@dataclass(frozen=True, slots=True)
class Place:
    """At each time: the contact point in space (n, 3), and theta, u1, v1 (wrapped; Cartesian coordinates on the plane).

    `attitude` (n, 3, 3) holds the ball's axes as columns; `normal` (n, 3) the ball's outward normal at the contact.
    """

    contact: Array
    attitude: Array
    normal: Array
    theta: Array
    u1: Array
    v1: Array


@cache
def _gauss() -> tuple[Array, Array, Array, Array]:
    """Nodes c, weights b, the matrix A of the collocation method, and the polynomials behind A (rows, low to high)."""
    nodes, weights = np.polynomial.legendre.leggauss(_STAGES)
    c, b = (nodes + 1) / 2, weights / 2
    inverse = np.linalg.inv(np.vander(c, increasing=True))
    degrees = np.arange(1, _STAGES + 1)
    primitives = (inverse / degrees[:, None]).T
    A = (c[:, None] ** degrees) @ primitives.T
    return c, b, A, primitives


@dataclass(frozen=True, slots=True)
class Track:
    """One oscillation, from phi = 0, in equal steps: the pose at each step's start and the slopes at its stages."""

    poses: Array  # (steps + 1, 4, 4)
    slopes: Array  # (steps, stages, 4, 4)
    gain: float

    def pose(self, phi: Array) -> Array:
        """X(phi) for any phi, shape (n, 4, 4)."""
        turns = np.floor(phi / (2 * np.pi)).astype(int)
        steps = len(self.slopes)
        place = (phi / (2 * np.pi) - turns) * steps
        index = np.clip(place.astype(int), 0, steps - 1)
        powers = (place - index)[:, None] ** np.arange(1, _STAGES + 1)
        shares = powers @ _gauss()[3].T * (2 * np.pi / steps)
        X = self.poses[index] + np.einsum("ns,nsij->nij", shares, self.slopes[index])
        M = _orthonormal(self.poses[-1:])[0] @ _about_axis(np.array([self.gain]))[0]
        distinct, where = np.unique(turns, return_inverse=True)
        gains = np.stack([np.linalg.matrix_power(M, int(k)) for k in distinct])
        result: Array = gains[where] @ X @ _about_axis(-turns * self.gain)
        return result


def locate(motion: Motion, phi: Array) -> Place:
    """The ball's place in space at the phases `phi` (see `Motion.phase`)."""
    phi = np.atleast_1d(np.asarray(phi, dtype=float))
    ball, start = motion.ball, motion.start
    track = follow(motion)
    first = track.pose(np.array([motion.phi_0]))[0]
    frame_space = _space_frame(start.theta, start.u1, start.v1, flat=ball.kappa == 0)
    initial = np.eye(4)
    initial[:3, :3] = frame_space @ _body_frame(np.array([start.u]), np.array([start.v]))[0].T
    if ball.kappa == 0:
        initial[:2, 3] = start.u1, start.v1
    X = initial @ np.linalg.inv(first) @ track.pose(phi)
    frame = X[:, :3, :3] @ _body_frame(motion.band.colatitude(phi), motion.v(phi))
    e_u, normal = frame[:, :, 0], frame[:, :, 2]
    if ball.kappa == 0:
        contact = X[:, :3, 3]
        theta = np.arctan2(-e_u[:, 0], e_u[:, 1])
        return Place(contact, X[:, :3, :3], normal, theta, contact[:, 0], contact[:, 1])
    out = -normal
    u1 = np.arctan2(np.hypot(out[:, 0], out[:, 1]), out[:, 2])
    v1 = np.arctan2(out[:, 1], out[:, 0])
    south = np.stack([np.cos(u1) * np.cos(v1), np.cos(u1) * np.sin(v1), -np.sin(u1)], axis=1)
    east = np.stack([-np.sin(v1), np.cos(v1), np.zeros_like(v1)], axis=1)
    theta = np.arctan2(-(e_u * south).sum(axis=1), (e_u * east).sum(axis=1))
    return Place(out / ball.kappa, X[:, :3, :3], normal, theta, u1, v1)


def follow(motion: Motion) -> Track:
    """One oscillation of the pose, in steps halved until the pose changes by less than the motion's tolerance.

    Raises `LimitExceeded` if 4096 steps don't suffice.
    """
    tolerance = max(motion.tolerance, 2e-14)
    rates = _rates(motion)
    steps, previous = 8, _integrate(rates, 8, motion.longitude.over_period)
    while steps < 4096:
        steps *= 2
        track = _integrate(rates, steps, motion.longitude.over_period)
        middle = 2 * np.pi * (np.arange(steps // 2) + 0.5) / (steps // 2)
        error = np.abs(previous.pose(middle) - track.poses[1::2]).max()
        if error <= tolerance * max(1.0, np.abs(track.poses).max()) * 10:
            return track
        previous = track
    raise LimitExceeded("one oscillation of the attitude needs more than 4096 steps", limit="steps")


def _rates(motion: Motion) -> Callable[[Array], Array]:
    """Xi(phi), shape (n, 4, 4): angular velocity and speed of the contact point along the ball, per unit of phi."""
    ball, band = motion.ball, motion.band

    def rates(phi: Array) -> Array:
        x, sine, v = band.x(phi), band.sine(phi), motion.v(phi) - motion.start.v
        omega_3, n = motion.rotation(phi)
        Q = motion.phase_speed(phi)
        du = band.amp * np.sin(phi) / sine
        dv = (x * n - omega_3) / ((1 + ball.rho) * sine**2 * Q)
        turn = np.exp(1j * v)
        transverse = ((n - x * omega_3) / (sine * Q) - 1j * (1 + ball.rho) * du) * turn
        slide = ball.R * (x * du + 1j * sine * dv) * turn
        Xi = np.zeros((len(phi), 4, 4))
        w1, w2, w3 = transverse.real, transverse.imag, omega_3 / Q
        Xi[:, 0, 1], Xi[:, 0, 2], Xi[:, 1, 2] = -w3, w2, -w1
        Xi[:, 1, 0], Xi[:, 2, 0], Xi[:, 2, 1] = w3, -w2, w1
        Xi[:, 0, 3], Xi[:, 1, 3], Xi[:, 2, 3] = slide.real, slide.imag, -ball.R * band.amp * np.sin(phi)
        return _turned(Xi, motion.start.v)

    return rates


def _turned(Xi: Array, angle: float) -> Array:
    """Xi in axes turned back about the third one."""
    forward, back = _about_axis(np.array([angle, -angle]))
    result: Array = forward @ Xi @ back
    return result


def _integrate(rates: Callable[[Array], Array], steps: int, gain: float) -> Track:
    c, b, A, _ = _gauss()
    h = 2 * np.pi / steps
    phi = h * (np.arange(steps)[:, None] + c)
    Xi = rates(phi.ravel()).reshape(steps, _STAGES, 4, 4)
    # Stages Y_i = X_k + h sum_j A_ij Y_j Xi_j: linear, and X_k factors out on the left, so all steps are solved at once.
    size = 4 * _STAGES
    system = np.eye(size) - h * np.einsum("ij,njab->njaib", A, Xi).reshape(steps, size, size)
    right = np.broadcast_to(np.tile(np.eye(4), (1, _STAGES)), (steps, 4, size))
    stages = np.linalg.solve(system.transpose(0, 2, 1), right.transpose(0, 2, 1)).transpose(0, 2, 1)
    blocks = stages.reshape(steps, 4, _STAGES, 4).transpose(0, 2, 1, 3)
    slopes = blocks @ Xi
    jumps = _orthonormal(np.eye(4) + h * np.einsum("j,njab->nab", b, slopes))
    poses = np.empty((steps + 1, 4, 4))
    poses[0] = np.eye(4)
    for k in range(steps):
        poses[k + 1] = poses[k] @ jumps[k]
    return Track(poses, poses[:-1, None] @ slopes, gain)


def _orthonormal(X: Array) -> Array:
    """The same poses with the nearest rotations: takes away what rounding has added, before powers multiply it."""
    left, _, right = np.linalg.svd(X[:, :3, :3])
    result = X.copy()
    result[:, :3, :3] = left @ right
    return result


def _about_axis(angles: Array) -> Array:
    """Rotations about the third axis, as 4 x 4 matrices."""
    result = np.zeros((len(angles), 4, 4))
    result[:, 0, 0] = result[:, 1, 1] = np.cos(angles)
    result[:, 1, 0] = np.sin(angles)
    result[:, 0, 1] = -result[:, 1, 0]
    result[:, 2, 2] = result[:, 3, 3] = 1
    return result


def _body_frame(u: Array, v: Array) -> Array:
    """(e_u, e_v, e_n) as columns, in the ball's axes."""
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    rows = ((cu * cv, -sv, su * cv), (cu * sv, cv, su * sv), (-su, np.zeros_like(u), cu))
    return np.moveaxis(np.array(rows), -1, 0)


def _space_frame(theta: float, u1: float, v1: float, *, flat: bool) -> Array:
    """(e_u, e_v, e_n) as columns in space: e_u = -sin(theta) e_u1 + cos(theta) e_v1, e_n opposite to the sphere's."""
    if flat:
        south, east, out = np.eye(3)
    else:
        south, east, out = _body_frame(np.array([u1]), np.array([v1]))[0].T
    s, c = np.sin(theta), np.cos(theta)
    return np.stack([-s * south + c * east, c * south + s * east, -out], axis=1)

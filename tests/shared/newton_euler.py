"""The rolling ball by Newton's and Euler's equations with multipliers, for comparison: nothing of Woronetz's formalism.

Unknowns: the centre of mass G and its velocity, the attitude matrix, the angular velocity, all in axes fixed in space, and the
ball's contact force, the multiplier of the rolling constraint.  At each instant nine linear equations,
    m a = F + L,    J w' + w x J w = r x L,    a + w' x r + w x r' = 0,
r from G to the contact point.  Integrated by SciPy's DOP853.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Body:
    """R1 = infinity is a plane; `force` maps (G, x = cos u) to the force at G."""

    m: float
    R: float
    a: float
    A1: float
    A3: float
    R1: float
    force: object

    def accelerations(self, y):
        """The unit vector from the contact point to the ball's centre, and the nine unknowns."""
        G, V, (_, _, k1, _, _, k2, _, _, k3), w = y[:3], y[3:6], y[6:15].tolist(), y[15:]
        k, distance = np.array([k1, k2, k3]), self.R1 + self.R
        N = UPWARDS if np.isinf(self.R1) else (G + self.a * k) / distance
        dk = cross(w, k)
        r, dr = self.a * k - self.R * N, self.a * dk - self.R * (V + self.a * dk) / distance
        J = self.A1 * ONE + (self.A3 - self.A1) * (k[:, None] * k)
        x, y, z = r.tolist()
        matrix = np.empty((9, 9))
        matrix[:3], matrix[3:6, :3], matrix[6:, :3], matrix[6:, 6:] = self.first, 0.0, ONE, 0.0
        matrix[3:6, 3:6] = J
        matrix[3:6, 6:] = matrix[6:, 3:6] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]  # of -r x
        right = np.concatenate([self.force(G, -(N @ k)), -cross(w, J @ w), -cross(w, dr)])
        return N, np.linalg.solve(matrix, right)

    @cached_property
    def first(self):
        """m a - L, of the nine equations."""
        return np.hstack([self.m * ONE, np.zeros((3, 3)), -ONE])

    def rates(self, _, y):
        unknown = self.accelerations(y)[1]
        (w1, w2, w3), (a, b, c, d, e, f, g, h, i) = y[15:].tolist(), y[6:15].tolist()
        turned = (w2 * g - w3 * d, w2 * h - w3 * e, w2 * i - w3 * f)  # w x the columns of the attitude, by rows
        turned += (w3 * a - w1 * g, w3 * b - w1 * h, w3 * c - w1 * i, w1 * d - w2 * a, w1 * e - w2 * b, w1 * f - w2 * c)
        return np.concatenate([y[3:6], unknown[:3], turned, unknown[3:6]])


ONE, UPWARDS = np.eye(3), np.array([0.0, 0.0, 1.0])


def cross(p, q):
    """As np.cross, which takes ten times as long."""
    (a, b, c), (d, e, f) = p.tolist(), q.tolist()
    return np.array([b * f - c * e, c * d - a * f, a * e - b * d])


def integrate(body, start, times, *, method="DOP853", rtol=3e-14, atol=1e-14):
    """The same quantities as `Motion` has, from `start` (u, du, dv, n, v, theta, u1, v1) at increasing times."""
    u, du, dv, n, v, theta, u1, v1 = start
    kappa, c, s = 1 / body.R1, np.cos, np.sin
    if kappa:
        radial = np.array([s(u1) * c(v1), s(u1) * s(v1), c(u1)])
        south, east = np.array([c(u1) * c(v1), c(u1) * s(v1), -s(u1)]), np.array([-s(v1), c(v1), 0.0])
        contact = abs(body.R1) * radial
        out = np.sign(kappa) * radial  # from the contact point to the ball's centre
    else:
        south, east, out = np.eye(3)
        contact = np.array([u1, v1, 0.0])
    e_u = c(theta) * east - s(theta) * south
    e_v = np.cross(-out, e_u)
    # The axis, and the meridian v = 0: at the angle u from the contact point's direction -out, and v back about the axis.
    k = -s(u) * e_u - c(u) * out
    radial = c(u) * e_u - s(u) * out
    first = c(v) * radial - s(v) * e_v
    A = np.column_stack([first, np.cross(k, first), k])
    # The contact point moves on the ball with R u' e_u + R sin u v' e_v; the ball's spin about the normal is n.
    w = (1 + kappa * body.R) * (s(u) * dv * e_u - du * e_v) - n * out
    G = contact + body.R * out - body.a * k
    V = np.cross(w, G - contact)
    solved = solve_ivp(
        body.rates,
        (0.0, times[-1]),
        np.concatenate([G, V, A.ravel(), w]),
        method=method,
        t_eval=times,
        rtol=rtol,
        atol=atol,
    )
    assert solved.success
    y = solved.y.T
    N, reaction = [], []
    for state in y:
        normal, unknown = body.accelerations(state)
        N.append(normal)
        reaction.append(normal @ unknown[6:])
    N, A, w = np.array(N), y[:, 6:15].reshape(-1, 3, 3), y[:, 15:]
    k = A[:, :, 2]
    in_space = y[:, :3] + body.a * k - body.R * N
    on_ball = -np.einsum("nij,ni->nj", A, N)
    return {
        "u": np.arctan2(np.hypot(on_ball[:, 0], on_ball[:, 1]), on_ball[:, 2]),
        "omega_3": (w * k).sum(1),
        "n": -(w * N).sum(1),
        "contact": in_space,
        "contact_on_ball": on_ball,
        "attitude": A,
        "reaction": np.array(reaction),
    }


def gravity(body_m, g, R1):
    """Of constant strength: downwards, to the sphere's centre, or away from it inside."""
    if np.isinf(R1):
        return lambda G, x: np.array([0.0, 0.0, -body_m * g])
    return lambda G, x: -np.sign(R1) * body_m * g * G / np.linalg.norm(G)


def central(slope, R, a, R1):
    """The force along G with the potential V(x), `slope` = V', in which |G|^2 = (R1 + R)^2 + a^2 + 2 (R1 + R) a x."""
    if np.isinf(R1):
        return lambda G, x: np.array([0.0, 0.0, -slope(x) / a])
    return lambda G, x: -slope(x) * G / ((R1 + R) * a)

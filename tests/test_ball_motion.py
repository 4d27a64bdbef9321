"""The motion by quadratures: against direct integration, against Newton and Euler's equations, and against itself."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from dataclasses import astuple, replace

import mpmath
import numpy as np
import pytest
import sympy as sp
from numpy.polynomial import chebyshev
from scipy.integrate import solve_ivp

from kovacic.ball import Ball, Body, Profile, U
from kovacic.ball.attitude import follow, locate
from kovacic.ball.ball import ball_with_roots
from kovacic.ball.closed import NumericBall, closed_form_in_roots
from kovacic.ball.decision import normalised
from kovacic.ball.direct import IntegrationFailed, State, equations, integrate, integrate_precisely
from kovacic.ball.extrapolation import extrapolate
from kovacic.ball.motion import solve_motion
from kovacic.ball.plot import compare, draw
from kovacic.ball.potential import central_gravity, compiled, potential_of
from kovacic.ball.series import Primitive, cosine_series, divide, invert
from kovacic.ball.theorems import rational_solutions
from kovacic.errors import InputError, LimitExceeded

POTENTIAL = sp.Rational(3, 2) * sp.cos(U)
START = State(1.0, 0.1, 0.3, 1.2, 0.2, 0.5, 0.3, 2.0)
BALLS = {
    "l > 0": Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3"),
    "l < 0": Ball(m=1, R=1, a="1/5", A1="1/3", A3="1/4"),
    "A1 = A3": Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/4"),
}


def places(ball):
    return {
        "outside": ball.on_sphere(3),
        "small": ball.on_sphere("2/3"),
        "inside": ball.on_sphere(-3),
        "plane": ball.on_plane(),
    }


def wrapped(angle):
    return np.abs(np.angle(np.exp(1j * angle))).max()


@pytest.mark.parametrize("place", ["outside", "small", "inside", "plane"])
@pytest.mark.parametrize("name", sorted(BALLS))
def test_all_eight_coordinates_agree_with_direct_integration(name, place):
    """Through several turning points: u, v, theta, u1, v1, the spins, and the energy."""
    sphere = places(BALLS[name])[place]
    start = START if name != "l < 0" else replace(START, du=-0.5)
    motion = solve_motion(sphere, POTENTIAL, start)
    times = np.linspace(0, 9, 60)
    direct = integrate(sphere.body, POTENTIAL, start, times, rtol=1e-11, atol=1e-13)
    phi = motion.phase(times)
    assert phi[-1] - phi[0] > 4 * np.pi
    u, v, theta, u1, v1, du, dv, n = direct.states
    omega_3, spin = motion.rotation(phi)
    place_ = locate(motion, phi)
    rates = motion.rates(phi)
    errors = {
        "u": np.abs(motion.band.colatitude(phi) - u).max(),
        "v": np.abs(motion.v(phi) - v).max(),
        "omega_3": np.abs(omega_3 - direct.omega_3).max(),
        "n": np.abs(spin - n).max(),
        "du": np.abs(rates[0] - du).max(),
        "dv": np.abs(rates[1] - dv).max(),
        "theta": wrapped(place_.theta - theta),
        "u1": np.abs(place_.u1 - u1).max(),
        "v1": np.abs(place_.v1 - v1).max() if place == "plane" else wrapped(place_.v1 - v1),
        "energy": np.abs(direct.energy - motion.energy).max(),
    }
    assert max(errors.values()) < 3e-9, errors


def test_radau_and_dop853_agree_with_the_quadratures():
    sphere = BALLS["l > 0"].on_sphere(3)
    times = np.linspace(0, 4, 9)
    motion = solve_motion(sphere, POTENTIAL, START)
    radau = integrate(sphere.body, POTENTIAL, START, times, method="Radau", rtol=1e-8, atol=1e-10)
    assert np.abs(motion.band.colatitude(motion.phase(times)) - radau.states[0]).max() < 1e-6


def newton_euler(sphere, g, start, times, axis_v=0.0):
    """The rigid body in space, without coordinates on the surfaces: normal N, axis k, marked axis e, angular velocity."""
    m, R, a, A1, A3 = (float(value) for value in sphere.ball.parameters)
    R1 = float(sphere.R1)
    kappa = 1 / R1
    u, v, theta, u1, v1, du, dv, n = (float(getattr(start, field)) for field in start.__dataclass_fields__)
    c, s = np.cos, np.sin
    out = np.array([s(u1) * c(v1), s(u1) * s(v1), c(u1)])
    south = np.array([c(u1) * c(v1), c(u1) * s(v1), -s(u1)])
    east = np.array([-s(v1), c(v1), 0.0])
    e_u, e_v, e_n = -s(theta) * south + c(theta) * east, c(theta) * south + s(theta) * east, -out
    k = -s(u) * e_u + c(u) * e_n
    radial = c(u) * e_u + s(u) * e_n
    marked = c(v) * radial - s(v) * e_v
    tau, sigma = (1 + kappa * R) * s(u), -1 - kappa * R
    omega = tau * dv * e_u + sigma * du * e_v + n * e_n

    def rates(_, y):
        N, k, e, w = y[:3], y[3:6], y[6:9], y[9:]
        rho = -R * N + a * k
        velocity = -np.cross(w, rho)
        dN = (velocity + a * np.cross(w, k)) / (R1 + R)
        drho = -R * dN + a * np.cross(w, k)
        G = (R1 + R) * N - a * k
        force = -m * g * G / np.linalg.norm(G)
        J = A1 * np.eye(3) + (A3 - A1) * np.outer(k, k)
        whole = J + m * (rho @ rho * np.eye(3) - np.outer(rho, rho))
        right = -np.cross(w, J @ w) + np.cross(rho, -m * np.cross(w, drho) - force)
        return np.concatenate([dN, np.cross(w, k), np.cross(w, e), np.linalg.solve(whole, right)])

    first = np.concatenate([out, k, marked, omega])
    y = solve_ivp(rates, (0, times[-1]), first, method="DOP853", t_eval=times, rtol=1e-10, atol=1e-12).y
    N, k, e, w = y[:3].T, y[3:6].T, y[6:9].T, y[9:].T
    return {
        "contact": R1 * N,
        "axis": k,
        "marked": e,
        "omega_3": (w * k).sum(1),
        "n": -(w * N).sum(1),
        "x": -(N * k).sum(1),
    }


@pytest.mark.parametrize("radius", [3, "2/3", -3])
@pytest.mark.parametrize(
    ("du", "dv", "n"),
    [
        (0.5, 0.3, 2.0),
        (-0.4, 0.9, -1.0),
        (3.5, 1e-2, 1e-2),
        (3.5, 1e-4, 1e-4),
        (3.5, 1e-8, 1e-8),
        (3.5, 0.0, 0.0),
    ],
    ids=["ordinary", "backwards", "near the poles", "nearer", "nearest", "through the poles"],
)
def test_newton_and_euler_agree_also_near_and_through_the_poles(radius, du, dv, n):
    """An independent derivation: no Woronetz, no spherical coordinates.  The ball turns over with u' = 3.5."""
    sphere = BALLS["l > 0"].on_sphere(radius)
    g = sp.Rational(1, 2)
    start = State(1.0, 0.1, 0.3, 1.2, 0.2, du, dv, n)
    times = np.linspace(0, 4, 41)
    motion = solve_motion(sphere, central_gravity(sphere, g), start)
    if du == 3.5:
        assert motion.turning_points[0] < 0.02
        assert motion.turning_points[1] > np.pi - 0.02
    if dv == 0:
        assert motion.turning_points == (0.0, np.pi)
    phi = motion.phase(times)
    reference = newton_euler(sphere, float(g), start, times)
    place = locate(motion, phi)
    omega_3, spin = motion.rotation(phi)
    found = {
        "contact": place.contact,
        "axis": place.attitude[:, :, 2],
        "marked": place.attitude[:, :, 0],
        "omega_3": omega_3,
        "n": spin,
        "x": motion.band.x(phi),
    }
    errors = {name: np.abs(found[name] - reference[name]).max() for name in found}
    assert max(errors.values()) < 2e-9, errors
    # The point (u, v) of the ball's surface, carried by the attitude, is where the ball touches.
    u, v = motion.band.colatitude(phi), motion.v(phi)
    s = np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)], axis=1)
    assert np.abs(np.einsum("nij,nj->ni", place.attitude, s) - place.normal).max() < 1e-12


def test_ten_thousand_oscillations_are_as_exact_as_one():
    """Time and longitude by periodicity, the attitude by powers: compared with stepping one oscillation at a time."""
    sphere = BALLS["l > 0"].on_sphere(3)
    motion = solve_motion(sphere, POTENTIAL, START)
    count = 10_000
    late = motion.phase(np.array([count * motion.period]))
    assert abs(late[0] - motion.phi_0 - 2 * np.pi * count) < 1e-8
    track = follow(motion)
    one = track.pose(np.array([2 * np.pi]))[0]
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(track.gain), -np.sin(track.gain)], [np.sin(track.gain), np.cos(track.gain)]]
    pose = np.eye(4)
    for _ in range(count):
        pose = pose @ (one @ turn)
    direct = track.pose(np.array([2 * np.pi * count]))[0]
    expected = pose @ np.linalg.matrix_power(np.linalg.inv(turn), count)
    assert np.abs(direct[:3, :3] - expected[:3, :3]).max() < 1e-9
    assert np.abs(direct[:3, :3] @ direct[:3, :3].T - np.eye(3)).max() < 1e-10


def test_energy_and_the_linear_integrals_are_conserved():
    """l eta^2 - zeta^2 is constant along the direct solution: an integral that the integrator knows nothing of."""
    sphere = BALLS["l > 0"].on_sphere(3)
    times = np.linspace(0, 10, 41)
    direct = integrate(sphere.body, POTENTIAL, START, times, rtol=1e-11, atol=1e-13)
    ball = NumericBall.of(sphere, np)
    x, n = np.cos(direct.states[0]), direct.states[7]
    eta = direct.omega_3 * np.sqrt(ball.D(x))
    zeta = ball.m * ball.R**2 * ball.A1 * n + ball.half_derivative(x) * direct.omega_3
    quadratic = ball.lead * eta**2 - zeta**2
    assert np.ptp(quadratic) < 1e-9
    assert np.ptp(direct.energy) < 1e-9
    flat = BALLS["l > 0"].on_plane()
    direct = integrate(flat.body, POTENTIAL, START, times, rtol=1e-11, atol=1e-13)
    assert np.ptp(direct.omega_3 * np.sqrt(ball.D(np.cos(direct.states[0])))) < 1e-9  # Chaplygin's integral


def quadrature(sphere, start):
    """x_min, x_max and the period under V = cos u, from the closed form and the energy integral, by mpmath alone."""
    ball, mpf = NumericBall.of(sphere, mpmath), mpmath.mpf
    x0 = mpmath.cos(mpf(start.u))
    omega_0 = x0 * start.n - (1 + ball.rho) * (1 - x0**2) * start.dv
    first = ball.transverse_energy(x0, 1 - x0**2, omega_0, start.n) / (1 - x0**2)
    energy = (ball.K11(x0) * start.du**2 + first) / 2 + x0

    def W(x):
        omega_3, n = ball.transport(x, x0, omega_0, start.n)
        return (2 * (energy - x) * (1 - x * x) - ball.transverse_energy(x, 1 - x * x, omega_3, n)) / ball.K11(x)

    rough = solve_motion(sphere, "cos(u)", State(*map(float, astuple(start)))).turning_points
    top, bottom = (mpmath.findroot(W, mpmath.cos(mpf(u))) for u in rough)
    middle, amp, count = (top + bottom) / 2, (top - bottom) / 2, 128
    nodes = [middle + amp * mpmath.cos((mpf(2 * j + 1) / 2) * mpmath.pi / count) for j in range(count)]
    slowness = [mpmath.sqrt((top - x) * (x - bottom) / W(x)) for x in nodes]
    return bottom, top, 2 * mpmath.pi * mpmath.fsum(slowness) / count


def test_fifty_digits_over_one_oscillation():
    """The period, omega_3 and n from the closed form, against the full equations in 50-digit arithmetic."""
    sphere = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(2)
    with mpmath.workdps(60):
        start = State(*map(mpmath.mpf, (1, 0, 0, 1, 0, "0.5", "0.25", 2)))
        bottom, top, period = quadrature(sphere, start)
        half, whole = integrate_precisely(sphere.body, sp.cos(U), start, [period / 2, period], digits=50)
        tiny = mpmath.mpf(10) ** -48
        for name in ("u", "du", "dv", "n"):
            assert abs(getattr(whole, name) - getattr(start, name)) < tiny, name
        assert bottom < mpmath.cos(half.u) < top
        ball, x0 = NumericBall.of(sphere, mpmath), mpmath.cos(start.u)
        omega_0 = x0 * start.n - (1 + ball.rho) * mpmath.sin(start.u) ** 2 * start.dv
        omega_3, n = ball.transport(mpmath.cos(half.u), x0, omega_0, start.n)
        assert abs(half.n - n) < tiny
        assert abs((mpmath.cos(half.u) * n - omega_3) / ((1 + ball.rho) * mpmath.sin(half.u) ** 2) - half.dv) < tiny


def test_extrapolation_runs_backwards_and_stops_at_a_singularity():
    there, back = extrapolate(lambda t, y: [y[0] ** 2], [1], ["0.5", 0], digits=30)
    assert abs(there[0] - 2) < 1e-29
    assert abs(back[0] - 1) < 1e-29
    with pytest.raises(LimitExceeded, match="too short"):
        extrapolate(lambda t, y: [y[0] ** 2], [1], [2], digits=15)


@pytest.mark.parametrize("tolerance", [1e-5, 1e-9, 1e-13])
def test_energy_and_constraints_hold_to_the_tolerance(tolerance):
    """The three constraints, with derivatives of the computed path; the energy, from the computed u', v' and n."""
    sphere = BALLS["l > 0"].on_sphere(3)
    motion = solve_motion(sphere, POTENTIAL, START, tolerance=tolerance)
    nodes = np.cos((np.arange(64) + 0.5) * np.pi / 64)
    phi = motion.phase(100.5 + nodes / 2)
    place, (du, dv) = locate(motion, phi), motion.rates(phi)
    (_, n), u, R1 = motion.rotation(phi), motion.band.colatitude(phi), 3.0
    assert np.abs(motion.energies(phi) - motion.energy).max() < 1e-12

    def rate(values):
        fit = chebyshev.chebfit(nodes, np.unwrap(values), 40)
        return 2 * chebyshev.chebval(nodes, chebyshev.chebder(fit))

    dtheta, du1, dv1 = rate(place.theta), rate(place.u1), rate(place.v1)
    s, c = np.sin(place.theta), np.cos(place.theta)
    defects = (
        R1 * du1 + du * s - np.sin(u) * dv * c,
        R1 * dv1 * np.sin(place.u1) - du * c - np.sin(u) * dv * s,
        n + dtheta + np.cos(u) * dv + dv1 * np.cos(place.u1),
    )
    assert max(np.abs(defect).max() for defect in defects) < 1e-9 + 1e3 * tolerance


def test_a_coarse_tolerance_stays_one_over_ten_thousand_oscillations():
    """What the number of oscillations multiplies, the period and the gain of v, doesn't depend on the tolerance."""
    sphere = BALLS["l > 0"].on_sphere(3)
    coarse, fine = (solve_motion(sphere, POTENTIAL, START, tolerance=tolerance) for tolerance in (1e-4, 1e-13))
    times = 10_000 * fine.period + np.linspace(0, fine.period, 9)
    errors = [
        np.abs(f(coarse) - f(fine)).max()
        for f in (lambda m: m.band.colatitude(m.phase(times)), lambda m: m.v(m.phase(times)))
    ]
    assert max(errors) < 1e-4


def pendulum(sphere, gap):
    """A start without spin at u = 2 whose kinetic energy falls short of the equilibrium u = 0 by the fraction `gap`."""
    V = compiled(central_gravity(sphere, sp.Integer(1)))
    speed = np.sqrt(2 * (V(0.0) - V(2.0)) / NumericBall.of(sphere, np).K11(np.cos(2.0)))
    return State(2.0, 0.0, 0.3, 1.2, 0.2, -speed * np.sqrt(1 - gap), 0.0, 0.0)


@pytest.mark.parametrize("radius", [3, "2/3"])
@pytest.mark.parametrize("gap", [1e-2, 1e-5, -1e-5, -1e-2])
def test_near_the_separatrix(radius, gap):
    """The ball just swings back before it stands upright, or just goes over: against Newton and Euler's equations."""
    sphere = BALLS["l > 0"].on_sphere(radius)
    start = pendulum(sphere, gap)
    motion = solve_motion(sphere, central_gravity(sphere, sp.Integer(1)), start)
    assert motion.turning_points[1] == np.pi
    assert (motion.turning_points[0] > 0) == (gap > 0)
    times = np.linspace(0, 0.6 * motion.period, 40)
    phi = motion.phase(times)
    reference = newton_euler(sphere, 1.0, start, times)
    assert np.abs(motion.energies(phi[1:]) - motion.energy).max() < 1e-9
    # The equations themselves multiply an error by about 1/gap on the way past the equilibrium.
    assert np.abs(motion.band.x(phi) - reference["x"]).max() < 1e-10 / abs(gap)


@pytest.mark.parametrize("gap", [1e-9, 0.0, -1e-9])
def test_motions_that_are_asymptotic_up_to_rounding_are_refused(gap):
    sphere = BALLS["l > 0"].on_sphere(3)
    with pytest.raises((InputError, LimitExceeded), match="asymptotic"):
        solve_motion(sphere, central_gravity(sphere, sp.Integer(1)), pendulum(sphere, gap))


def test_direct_integration_knows_other_bodies():
    """The thin disk on the plane conserves its energy, which includes the height R sin u of its centre."""
    disk = Body(
        Profile(sp.Integer(1), sp.Integer(0), edge=True), sp.Integer(1), sp.Rational(1, 4), sp.Rational(1, 2), sp.oo
    )
    potential = sp.sin(U)
    result = integrate(disk, potential, State(1.2, 0, 0, 0, 0, 0.3, 2.0, 0.4), np.linspace(0, 3, 10))
    assert np.ptp(result.energy) < 1e-8
    assert np.ptp(result.states[0]) > 0.1


def test_start_at_a_turning_point_and_steady_motion():
    sphere = BALLS["l > 0"].on_sphere(3)
    at_rest = replace(START, du=0.0)
    motion = solve_motion(sphere, POTENTIAL, at_rest)
    assert min(abs(turn - 1.0) for turn in motion.turning_points) < 1e-12
    times = np.linspace(0, 6, 20)
    direct = integrate(sphere.body, POTENTIAL, at_rest, times, rtol=1e-11, atol=1e-13)
    assert np.abs(motion.band.colatitude(motion.phase(times)) - direct.states[0]).max() < 1e-9
    # A steady rotation: n is chosen so that u'' = 0 at u = 1 (a homogeneous ball without a potential, v' = 0, n = 0).
    plain = Ball(m=1, R=1, a=0, A1="2/5", A3="2/5").on_plane()
    with pytest.raises(InputError, match="steady"):
        solve_motion(plain, sp.Integer(0), State(1.0, 0, 0, 0, 0, 0.0, 0.0, 0.0))


def test_what_is_refused():
    sphere = BALLS["l > 0"].on_sphere(3)
    with pytest.raises(InputError, match="between the poles"):
        solve_motion(sphere, POTENTIAL, replace(START, u=0.0))
    with pytest.raises(InputError, match="depends on u alone"):
        solve_motion(sphere, sp.Symbol("q") * sp.cos(U), START)
    with pytest.raises(InputError, match="depends on u alone"):
        equations(sphere.body, sp.Symbol("q"))
    symbolic = Ball(m=sp.Symbol("m"), R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    with pytest.raises(InputError, match="numbers are needed"):
        solve_motion(symbolic, POTENTIAL, START)
    with pytest.raises(InputError, match="numbers are needed"):
        equations(symbolic.body, POTENTIAL)
    for value in (np.nan, np.inf, 1e60):
        with pytest.raises(InputError, match="can start with"):
            solve_motion(sphere, POTENTIAL, replace(START, du=value))
    heavy = Ball(m=10**60, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    with pytest.raises(InputError, match="choose units"):
        solve_motion(heavy, POTENTIAL, START)
    with pytest.raises(IntegrationFailed):  # the potential pulls u to 1 in a finite time, with infinite speed
        integrate(sphere.body, -1 / (U - 1) ** 4, replace(START, u=1.2, du=-1), np.array([0.0, 5.0]), rtol=1e-6)


@pytest.mark.parametrize(
    ("potential", "message"),
    [
        ("u", "smooth at the poles"),
        ("sin(u)", "smooth at the poles"),
        ("1/(1 - cos(u))", "isn't finite at u = 0;"),
        ("sqrt(cos(u) - 2)", "isn't finite"),
        ("sqrt(-1)*cos(u)", "real function"),
        ("q*cos(u)", "can't contain q"),
        ("__import__('os')", "unexpected character"),
        ("cos(u", "never closed"),
        ("cos(u)^0.5", "isn.t finite"),
        ("cos(u, u)", "one argument"),
        ("log(0)", "isn't finite"),
        ("u' + 1", "derivative"),
        ("V = u", "can't contain V"),
        ("cos(u) = 1", "not an equation"),
        ("", "empty"),
        ("1/(u - u)", "division by zero"),
    ],
)
def test_potentials_that_are_refused(potential, message):
    with pytest.raises(InputError, match=message):
        compiled(potential)


@pytest.mark.parametrize("potential", ["9^9^9", "1e999", "(9^99)^99", "+".join(["cos(u)"] * 200)])
def test_potentials_that_are_too_large(potential):
    with pytest.raises(LimitExceeded):
        potential_of(potential)


@pytest.mark.parametrize(
    "potential",
    [
        "0",
        "3/2*cos(u)",
        "exp(-cos(2u)) + pi",
        "log(2 + cos(u))",
        "1/(1.0001 - cos(u))",
        "1/(cos(u) - 1/3)",
        "cos(40u)/9",
    ],
)
def test_motion_under_other_potentials(potential):
    """Steep ones, with a barrier that isn't reached, with many equilibria: the turning points next to the start count."""
    sphere = BALLS["l > 0"].on_sphere(3)
    motion = solve_motion(sphere, potential, START)
    times = np.linspace(0, 2 * motion.period, 30)
    phi = motion.phase(times)
    direct = integrate(sphere.body, potential, START, times, rtol=1e-11, atol=1e-13)
    assert np.abs(motion.band.colatitude(phi) - direct.states[0]).max() < 1e-8
    assert np.abs(motion.energies(phi) - motion.energy).max() < 1e-11 * max(1, abs(motion.energy))


def test_series_tools():
    series = cosine_series(lambda phi: 1 / (2 + np.cos(phi)), 1e-14)
    whole = Primitive.of(series)
    assert abs(whole.over_period - 2 * np.pi / np.sqrt(3)) < 1e-13
    at = np.array([0.3, 3.0, 40.0, -7.0])
    assert np.abs(invert(whole, whole(at), 1e-14) - at).max() < 1e-12
    G = np.array([0.5, -1.0, 0.25, 2.0])
    H, value = divide(G, 1.01)
    z = np.linspace(-1, 1, 7)
    chebval = np.polynomial.chebyshev.chebval
    assert np.abs(chebval(z, G) - value - (z - 1.01) * chebval(z, H)).max() < 1e-14
    assert abs(value - chebval(1.01, G)) < 1e-14
    with pytest.raises(LimitExceeded):
        cosine_series(lambda phi: np.sign(phi - 1), 1e-14)


def test_picture_and_comparison(tmp_path):
    for place in ("outside", "plane"):
        sphere = places(BALLS["l > 0"])[place]
        comparison = compare(sphere, POTENTIAL, solve_motion(sphere, POTENTIAL, START), 5.0, samples=100, rtol=1e-10)
        assert max(error.max() for error in comparison.errors.values()) < 1e-7
        path = tmp_path / f"{place}.png"
        draw(comparison, path, title="A ball")
        assert path.stat().st_size > 20_000


@pytest.fixture
def run(capsys):
    from kovacic.cli.main import run as command_line

    def call(*arguments):
        status = command_line(["ball", *arguments])
        return status, capsys.readouterr()

    return call


def test_command_by_ratio(run):
    status, output = run("--ratio", "3/2", "--json")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 1, "mu_4", True)
    assert data["omega_3"] == "c1*(4*x - x1 - 3*x2)/sqrt(x - x2) + c2*(4*x - 3*x1 - x2)/sqrt(x - x1)"
    status, output = run("--ratio", "1/4")
    assert "dicyclic of order 8" in output.out


@pytest.mark.parametrize("ratio", ["3/2", "1/3", "-2/5", "1/2"])
def test_command_prints_n_in_closed_form(run, ratio):
    """n and omega_3 as printed, read back, solve the linear equations derived from the profile; also in --json."""
    status, output = run("--ratio", ratio, "--json")
    data = json.loads(output.out)
    assert status == 0
    n, omega_3 = (sp.parse_expr(data[name]) for name in ("n", "omega_3"))
    x = sp.Symbol("x")
    assert n.free_symbols == set(sp.symbols("x x1 x2 c1 c2 A1 A3"))
    rolling = ball_with_roots()
    system, values = rolling.linear_system(), {"x1": -3, "x2": -2, "A1": 2, "A3": 3, "R": sp.Rational(ratio), "R1": 1}
    at = {x: sp.Rational(1, 7), "c1": 2, "c2": -5}
    rates = [
        (entry / sp.sin(U)).subs(sp.cos(U), x).subs(values) for entry in (system.a1, system.a2, system.b1, system.b2)
    ]
    n, omega_3 = n.subs(values), omega_3.subs(values)
    for derivative, first, second in ((sp.diff(n, x), *rates[:2]), (sp.diff(omega_3, x), *rates[2:])):
        assert abs(sp.N((derivative + first * n + second * omega_3).subs(at), 30)) < 1e-25
    text = run("--ratio", ratio)[1].out
    for label in ("equation (12):", "case:", "group:", "omega_3:", "n:"):
        assert label in text


def test_command_with_a_large_ratio(run):
    """Theorem 1 with N = 401: decided, and the solutions in powers instead of pages of coefficients."""
    status, output = run("--ratio", "401/2", "--json")
    data = json.loads(output.out)
    assert (status, data["case"], data["verified"]) == (0, 1, True)
    assert "(sqrt(x - x1) + sqrt(x - x2))**401" in data["omega_3"]


def test_command_with_an_irrational_ratio_and_latex(run):
    status, output = run("--ratio", "sqrt(2)", "--json", "--latex")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 2, "N(T)", True)
    assert set(data["latex"]) == {"12", "13"}


def test_command_with_another_potential(run):
    body = ("--mass", "1", "--radius", "1", "--offset", "1/5", "--A1", "1/4", "--A3", "1/3", "--sphere", "-4")
    status, output = run(*body, "--simulate", "--potential", "3/2*cos(u)", "--time", "5", "--json")
    motion = json.loads(output.out)["motion"]
    assert status == 0
    assert motion["potential"] == "3*cos(u)/2"
    assert max(motion["difference"].values()) < 1e-9
    assert motion["energy_drift"] < 1e-12


def test_command_by_parameters_with_a_picture(run, tmp_path):
    body = ("--mass", "1", "--radius", "2", "--offset", "1/5", "--A1", "1", "--A3", "4/3", "--sphere", "3")
    picture = tmp_path / "path.png"
    status, output = run(*body, "--json", "--latex", "--simulate", "--time", "4", "--plot", str(picture))
    data = json.loads(output.out)
    assert status == 0
    assert data["case"] == 2
    assert data["group"] == "dicyclic of order 12"
    assert max(data["motion"]["difference"].values()) < 1e-9
    assert set(data["latex"]) == {"7", "11", "12", "13"}
    assert picture.stat().st_size > 20_000


_BALL = ("--mass", "1", "--radius", "1", "--sphere", "3")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--mass", "1", "--radius", "1", "--offset", "2", "--sphere", "1"), "|a| <= R"),
        (("--mass", "1", "--radius", "1"), "either --ratio"),
        (("--ratio", "1", "--mass", "1"), "stands alone"),
        (("--ratio", "x"), "can't contain x"),
        (("--ratio", "0"), "R/R1 = 0"),
        (("--mass", "-1", "--radius", "1", "--sphere", "1"), "m > 0 fails, as m = -1"),
        (("--mass", "1", "--radius", "0", "--sphere", "1"), "R > 0 fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "0"), "other than 0"),
        (("--mass", "1", "--radius", "1", "--sphere", "-1/2"), "R < |R1| fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "1", "--A3", "2"), "A3 <= 2 A1 fails"),
        (("--mass", "one", "--radius", "1", "--sphere", "1"), "can't contain one"),
        ((*_BALL, "--potential", "cos(w)", "--simulate"), "can't contain w"),
        ((*_BALL, "--potential", "cos(u)", "--gravity", "1"), "either --gravity"),
        ((*_BALL, "--simulate", "--time", "nan"), "can't contain nan"),
        ((*_BALL, "--simulate", "--time", "-1"), "must be positive"),
        ((*_BALL, "--simulate", "--time", "1e9"), "at most 1000 oscillations"),
        ((*_BALL, "--simulate", "--start", "0", "1", "1", "1"), "between the poles"),
        ((*_BALL, "--simulate", "--start", "inf", "1", "1", "1"), "can't contain inf"),
        ((*_BALL, "--simulate", "--start", "1", "1e60", "1", "1"), "can start with"),
        ((*_BALL, "--plot", "a.gif"), "doesn't end in"),
        ((*_BALL, "--plot", "/nowhere/a.png"), "can't be written"),
        (("--ratio", "-3/2"), "R < |R1| fails"),
    ],
)
def test_command_refuses(run, arguments, message):
    status, output = run(*arguments)
    assert status == 2
    assert message in output.err


def test_command_with_irrational_numbers_everywhere(run):
    body = ("--mass", "sqrt(2)", "--radius", "1", "--offset", "1/5", "--A1", "sqrt(2)/4", "--A3", "sqrt(2)/3")
    motion = ("--sphere", "2*sqrt(2)", "--simulate", "--start", "sqrt(2)/2", "1/2", "-0.3", "2", "--time", "sqrt(5)")
    status, output = run(*body, *motion, "--json")
    data = json.loads(output.out)
    assert (status, data["ratio"], data["case"], data["group"]) == (0, "sqrt(2)/4", 2, "N(T)")
    assert data["motion"]["time"] == np.sqrt(5)
    assert max(data["motion"]["difference"].values()) < 1e-9


def test_ctrl_c_during_a_simulation_is_status_130_and_leaves_no_picture(tmp_path):
    """A run of minutes, interrupted when it has begun to integrate; an older picture stays what it was."""
    picture, started = tmp_path / "path.png", tmp_path / "started"
    picture.write_bytes(b"an older one")
    script = f"""
import sys
from pathlib import Path
from kovacic.cli import main
from kovacic.ball import plot
compare = plot.compare
def marked(*arguments, **options):
    Path({str(started)!r}).touch()
    return [compare(*arguments, **options) for _ in range(1000)]
plot.compare = marked
main.main(sys.argv[1:])
"""
    arguments = ["ball", *_BALL, "--offset", "1/5", "--simulate", "--time", "500", "--plot", str(picture)]
    process = subprocess.Popen(
        [sys.executable, "-c", script, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    while process.poll() is None and not started.exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=60)
    assert (process.returncode, output, errors) == (130, "", "kovacic: interrupted\n")
    assert picture.read_bytes() == b"an older one"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["path.png", "started"]


def test_a_picture_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    sphere = BALLS["l > 0"].on_sphere(3)
    comparison = compare(sphere, POTENTIAL, solve_motion(sphere, POTENTIAL, START), 1.0, samples=20, rtol=1e-8)
    picture = tmp_path / "path.svg"
    picture.write_bytes(b"an older one")

    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(type(picture), "replace", interrupted)
        with pytest.raises(KeyboardInterrupt):
            draw(comparison, picture)
    assert picture.read_bytes() == b"an older one"
    draw(comparison, picture)
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    assert [path.name for path in tmp_path.iterdir()] == ["path.svg"]


EVIL = "print('executed') or 1#"


@pytest.mark.parametrize(
    "call",
    [
        lambda text: closed_form_in_roots(text),
        lambda text: normalised(text),
        lambda text: rational_solutions(text),
        lambda text: central_gravity(BALLS["l > 0"].on_sphere(3), text),
        lambda text: solve_motion(BALLS["l > 0"].on_sphere(3), text, START),
        lambda text: solve_motion(BALLS["l > 0"].on_sphere(3), POTENTIAL, replace(START, n=text)),
        lambda text: solve_motion(BALLS["l > 0"].on_sphere(3), POTENTIAL, START, tolerance=text),
        lambda text: BALLS["l > 0"].on_sphere(text),
        lambda text: Body(Profile(sp.sin(U), sp.cos(U)), text, 1, 1, sp.oo),
        lambda text: integrate(BALLS["l > 0"].on_sphere(3).body, POTENTIAL, replace(START, u=text), np.array([1.0])),
        lambda text: integrate_precisely(BALLS["l > 0"].on_sphere(3).body, POTENTIAL, START, [text]),
    ],
)
@pytest.mark.parametrize("text", [EVIL, "__import__('os').getcwd()"])
def test_text_is_never_executed(call, text, capsys):
    with pytest.raises(InputError):
        call(text)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("value", [0.1, sp.Float("0.1"), sp.nan, sp.zoo, -sp.oo, sp.I, True, None])
def test_bodies_refuse_what_is_not_exact_real_and_finite(value):
    for field in ("m", "A1", "A3", "R1"):
        with pytest.raises(InputError):
            Body(Profile(sp.sin(U), sp.cos(U)), **{"m": 1, "A1": 1, "A3": 1, "R1": 3, field: value})
    with pytest.raises(InputError):
        Profile(value * sp.sin(U) if isinstance(value, float | sp.Expr) else value, sp.cos(U))


@pytest.mark.parametrize(
    ("change", "message"),
    [({"m": -1}, "m > 0"), ({"A1": 0}, "A1 > 0"), ({"A3": 3}, "A3 <= 2 A1"), ({"R1": 0}, "other than 0")],
)
def test_impossible_bodies_are_refused_with_the_inequality(change, message):
    with pytest.raises(InputError, match=message):
        Body(Profile(sp.sin(U), sp.cos(U)), **{"m": 1, "A1": 1, "A3": 1, "R1": 3, **change})


def test_numerical_settings_are_checked():
    sphere = BALLS["l > 0"].on_sphere(3)
    body, times = sphere.body, np.array([0.0, 0.1])
    for wrong in ([], [3, 2], [-1, 1], [0, np.nan], [np.inf], [0], "a", [None]):
        with pytest.raises(InputError):
            integrate(body, POTENTIAL, START, wrong)
    for options in ({"rtol": -1}, {"atol": np.nan}, {"method": "Euler"}):
        with pytest.raises(InputError):
            integrate(body, POTENTIAL, START, times, **options)
    for tolerance in (0, -1, np.nan, np.inf, None):
        with pytest.raises(InputError, match="tolerance"):
            solve_motion(sphere, POTENTIAL, START, tolerance=tolerance)
    for value in (None, 1j, True, sp.Symbol("q"), [1.0], sp.I):
        for solve in (solve_motion, lambda s, V, start: integrate(s.body, V, start, times)):
            with pytest.raises(InputError):
                solve(sphere, POTENTIAL, replace(START, dv=value))
    with pytest.raises(InputError, match="finite"):
        integrate(body, POTENTIAL, replace(START, dv=np.nan), times)
    with pytest.raises(InputError, match="finite"):
        solve_motion(sphere, POTENTIAL, START).phase(np.array([np.inf]))
    with pytest.raises(InputError, match="digit"):
        integrate_precisely(body, POTENTIAL, START, [1], digits=0)
    with pytest.raises(InputError, match="finite"):
        integrate_precisely(body, POTENTIAL, START, [mpmath.nan])
    with pytest.raises(IntegrationFailed, match="range of floats"):
        integrate(body, "exp(exp(exp(exp(5))))", START, times)


@pytest.mark.parametrize(
    "potential",
    [sp.Function("f")(U), sp.Function("exit")(U), sp.Abs(sp.cos(U)), sp.Integral(sp.cos(U), U), sp.zoo, sp.oo, sp.nan],
)
def test_potentials_that_are_not_elementary(potential):
    with pytest.raises(InputError, match="elementary"):
        potential_of(potential)

"""The motion of the ball: against Newton and Euler's equations in space, against quadratures, and against itself."""

from __future__ import annotations

from dataclasses import astuple, replace
from fractions import Fraction
from functools import cache

import mpmath
import newton_euler
import numpy as np
import pytest
import sympy as sp
from ball_quadratures import quadratures
from build import parametrize
from numpy.polynomial import chebyshev

from kovacic import InputError, LimitExceeded
from kovacic.ball import RollingBall, U
from kovacic.ball.motion import MotionStart, solve_motion
from kovacic.ball.picture import draw

POTENTIAL = sp.Rational(3, 2) * sp.cos(U)
START = MotionStart(u=1.0, du=0.5, dv=0.3, n=2.0, v=0.1, theta=0.3, u1=1.2, v1=0.2)
BALLS = {
    "l > 0": RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3"),
    "l < 0": RollingBall(m=1, R=1, a="1/5", A1="1/3", A3="1/4"),
    "A1 = A3": RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/4"),
}
SPHERE = BALLS["l > 0"].on_sphere(3)


def random_body(generator):
    """m, R, a, A1, A3 within the inequalities that `RollingBall` demands."""
    m, R = generator.uniform(0.5, 2, 2)
    a = generator.uniform(-0.6, 0.6) * R
    room = m * (R**2 - a**2)
    A1 = generator.uniform(0.1, 0.55) * room
    A3 = 0.95 * min(2 * A1, generator.uniform(0.2, 1.0) * 2 * (room - A1))
    m, R, a, A1, A3 = (Fraction(round(1000 * value), 1000) for value in (m, R, a, A1, A3))
    return RollingBall(m=m, R=R, a=a, A1=A1, A3=A3)


def random_place(generator, place, R):
    if place == "plane":
        return None
    size = np.exp(generator.uniform(-1, 2)) if place == "outside" else -(1.05 + generator.exponential(2))
    return Fraction(round(1000 * float(R) * size), 1000)


def put(ball, R1):
    return ball.on_plane() if R1 is None else ball.on_sphere(R1)


def reference(sphere, start, times, *, g=1.0, slope=None):
    """By Newton and Euler's equations; `slope` = V' as a function of x in place of gravity."""
    m, R, a, A1, A3 = map(float, sphere.ball.parameters)
    R1 = float(sphere.R1)
    force = newton_euler.gravity(m, g, R1) if slope is None else newton_euler.central(slope, R, a, R1)
    body = newton_euler.Body(m, R, a, A1, A3, R1, force)
    return newton_euler.integrate(body, tuple(map(float, astuple(start))), times)


@cache
def usual(R1):
    """The motion from the usual start under gravity, solved once."""
    return solve_motion(put(BALLS["l > 0"], R1), START)


def differences(motion, found, times):
    names = [name for name in found if name != "reaction" or motion.reaction(0.0) is not None]
    return {name: float(np.abs(getattr(motion, name)(times) - found[name]).max()) for name in names}


@parametrize("place", ["outside", "inside", "plane"], ordinary=1, long=1)
@parametrize("seed", range(20), ordinary=1, long=2)
def test_newton_and_euler_agree_on_random_bodies(seed, place):
    """u, both spins, the contact point in space and on the ball, the attitude and the normal reaction."""
    generator = np.random.default_rng([seed, len(place)])
    ball = random_body(generator)
    sphere = put(ball, random_place(generator, place, ball.R))
    u, du, dv, n, v, theta = generator.uniform(0, np.pi), *generator.normal(size=5)
    start = MotionStart(u, du, dv, 2 * n, v, theta, 1.2, 0.2)
    times = np.linspace(0, 3, 13)
    motion = solve_motion(sphere, start)
    errors = differences(motion, reference(sphere, start, times), times)
    assert max(errors.values()) < 1e-9, errors


def test_the_reference_starts_with_the_rates_that_are_meant():
    """u' and v' of the path on the ball, which the reference gets as an angular velocity."""
    for R1 in (3, -3, None):
        step = 1e-4
        found = reference(put(BALLS["l > 0"], R1), START, np.array([0, step, 2 * step]))
        s = found["contact_on_ball"]
        v = np.arctan2(s[:, 1], s[:, 0])
        for values, rate in ((found["u"], START.du), (v, START.dv)):
            assert abs((4 * values[1] - 3 * values[0] - values[2]) / (2 * step) - rate) < 1e-6
        assert abs(found["n"][0] - START.n) < 1e-14


@parametrize("R1", [3, "2/3", -3], ordinary=1, long=1)
@parametrize(
    ("du", "dv", "n"),
    [
        (0.5, 0.3, 2.0),
        (-0.4, 0.9, -1.0),
        (3.5, 1e-2, 1e-2),
        (3.5, 1e-4, 1e-4),
        (3.5, 1e-8, 1e-8),
        (3.5, 0.0, 0.0),
    ],
    ordinary=1,
    long=3,
    ids=["ordinary", "backwards", "near the poles", "nearer", "nearest", "through the poles"],
)
def test_newton_and_euler_agree_also_near_and_through_the_poles(R1, du, dv, n):
    """The ball turns over with u' = 3.5."""
    sphere = BALLS["l > 0"].on_sphere(R1)
    start = replace(START, du=du, dv=dv, n=n)
    times = np.linspace(0, 4, 41)
    motion = solve_motion(sphere, start, gravity="1/2")
    if du == 3.5:
        assert motion.turning_points[0] < 0.02
        assert motion.turning_points[1] > np.pi - 0.02
    if dv == 0:
        assert np.abs(np.subtract(motion.turning_points, (0.0, np.pi))).max() < 1e-12
    errors = differences(motion, reference(sphere, start, times, g=0.5), times)
    assert max(errors.values()) < 1e-9, errors
    # The point of the ball's surface at the contact is where the ball touches: the common normal, in space.
    normal = np.einsum("nij,nj->ni", motion.attitude(times), motion.contact_on_ball(times))
    assert np.abs(normal + motion.contact(times) / float(sphere.R1)).max() < 1e-12


# What version 0.1 refused or answered wrongly, and other starts where something is zero: mass 1, radius 1.
STARTS = {
    "the series' plateau": ("1/5", 3, (1.41, 0.07, 0.85, -0.14)),
    "a narrow cavity": ("1/5", "-11/10", (1.0, 0.5, 0.3, 2.0)),
    "at rest near a pole": ("1/5", 3, (3.1415, 0.0, 0.0, 0.0)),
    "homogeneous": (0, 3, (0.71, -0.05, 0.17, 1.64)),
    "released from rest": ("1/5", 3, (1.0, 0.0, 0.0, 0.0)),
    "almost from rest": ("1/5", 3, (1.0, 0.0, 0.0, 1e-6)),
    "at a pole": ("1/5", 3, (0.0, 1.0, 0.0, 2.0)),
    "at the other pole": ("1/5", -3, (np.pi, -1.0, 0.0, 1.0)),
    "next to a pole": ("1/5", 3, (1e-9, 0.5, 0.0, 2.0)),
    "upright": ("1/5", 3, (0.0, 0.0, 0.0, 2.0)),
    "at rest at the bottom": ("1/5", 3, (np.pi, 0.0, 0.0, 0.0)),
    "at rest, homogeneous": (0, None, (1.0, 0.0, 0.0, 0.0)),
    "straight on": (0, None, (1.0, 2.0, 0.0, 0.0)),
}


@parametrize("name", STARTS, ordinary=1, long=(1, 7, 11))
def test_every_start_has_its_motion(name):
    a, R1, (u, du, dv, n) = STARTS[name]
    moments = {"A1": "2/5", "A3": "2/5"} if a == 0 else {"A1": "1/4", "A3": "1/3"}
    sphere = put(RollingBall(m=1, R=1, a=a, **moments), R1)
    start, times = MotionStart(u, du, dv, n), np.linspace(0, 5, 21)
    motion = solve_motion(sphere, start)
    errors = differences(motion, reference(sphere, start, times), times)
    assert max(errors.values()) < 1e-9, errors
    late = motion.energy(np.linspace(0, 3000, 501))
    assert np.ptp(late) < 1e-11


def steady_precession(sphere):
    """v' such that u'' = 0 at u = 1 with n = 2, by bisection of Newton and Euler's u'' in the first instant."""

    def change(dv):
        start = MotionStart(1.0, 0.0, dv, 2.0)
        return reference(sphere, start, np.array([0.0, 1e-3]))["u"][1] - 1.0

    low, high = -2.0, 1.0
    assert change(low) * change(high) < 0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if change(low) * change(middle) > 0 else (low, middle)
    return middle


@parametrize("R1", [3, -3, None], ordinary=0, long=1)
def test_steady_precession(R1):
    """And motions as near to it as rounding allows: all of them are the same up to their distance."""
    sphere = put(BALLS["l > 0"], R1)
    dv, times = steady_precession(sphere), np.linspace(0, 200, 101)
    steady = solve_motion(sphere, MotionStart(1.0, 0.0, dv, 2.0))
    assert np.ptp(steady.u(times)) < 1e-8
    for distance in (1e-11, 1e-9, 1e-6):
        near = solve_motion(sphere, MotionStart(1.0, distance, dv, 2.0))
        assert np.abs(near.u(times) - 1).max() < 10 * distance + 1e-8
        assert np.abs(near.contact(times) - steady.contact(times)).max() < 1e-6 + 1e4 * distance
    at_rest = solve_motion(sphere, MotionStart(0.0, 0.0, 0.0, 2.0))
    assert at_rest.period is None
    assert at_rest.turning_points == (0.0, 0.0)
    assert np.abs(at_rest.contact(times) - at_rest.contact(0.0)).max() < 1e-12


def random_starts(seed, count):
    """Bodies, places and starts of many sizes, with zeros and poles among them."""
    generator = np.random.default_rng(seed)
    for _ in range(count):
        ball = random_body(generator)
        sphere = put(ball, random_place(generator, generator.choice(["outside", "inside", "plane"]), ball.R))
        sizes = 10.0 ** generator.uniform(-3, 1) * generator.choice([0, 1, 1, 1, 1e-4], 3)
        near = 10.0 ** generator.uniform(-4, 0)
        u = generator.choice(
            [generator.uniform(0, np.pi), near, np.pi - near, 0.0, np.pi], p=[0.6, 0.15, 0.15, 0.05, 0.05]
        )
        yield sphere, MotionStart(float(u), *(float(x) for x in generator.normal(size=3) * sizes))


@pytest.mark.parametrize(
    ("seed", "count"), [pytest.param(1, 25, marks=pytest.mark.long), pytest.param(2, 500, marks=pytest.mark.slow)]
)
def test_no_start_is_refused(seed, count):
    """Energy and both closed forms hold over three periods; or as long as a motion next to an unstable steady one is known."""
    asymptotic = 0
    for sphere, start in random_starts(seed, count):
        motion = solve_motion(sphere, start)
        asymptotic += bool(np.isfinite(motion.determined))
        times = np.linspace(0, min(3 * (motion.period or 1), motion.determined), 100)
        speed = 1e-6 + np.abs(motion.omega_3(times)).max() + np.abs(motion.n(times)).max() + abs(start.du)
        energy = motion.energy(times)
        size = np.abs(energy).max() + np.abs(motion.force.value(motion.u(times))).max()
        assert np.ptp(energy) <= 1e-10 * size, (sphere, start)
        assert all(np.abs(error).max() < 1e-9 * speed for error in motion.defects(times).values()), (sphere, start)
    assert asymptotic <= count / 100


@pytest.mark.long
def test_ten_thousand_oscillations_are_as_exact_as_one():
    """Against the quadratures in 30 digits, and against stepping from one oscillation to the next."""
    for ball in BALLS.values():
        sphere = ball.on_sphere(3)
        motion = solve_motion(sphere, START, potential="cos(u)")
        with mpmath.workdps(30):
            period, gain = quadratures(sphere, START, motion.turning_points)
            assert abs(motion.period - period) < 1e-13 * period
            late = 10_000 * period
            s = motion.contact_on_ball(np.array([0.0, float(late)]))
            turned = np.angle(complex(*s[1, :2]) / complex(*s[0, :2]))
            assert abs(np.angle(np.exp(1j * (turned - float(mpmath.fmod(10_000 * gain, 2 * mpmath.pi)))))) < 3e-9
    first, one = motion.attitude(0.0), motion.attitude(motion.period)
    relabel = np.linalg.lstsq(np.eye(3), first.T @ one, rcond=None)[0]
    assert np.abs(relabel @ relabel.T - np.eye(3)).max() < 1e-12
    assert np.abs(motion.attitude(7 * motion.period + 0.3) - long_way(motion, sphere, 7, 0.3)).max() < 1e-11


def long_way(motion, sphere, count, rest):
    """The attitude by Newton and Euler's equations, which know no period."""
    time = count * motion.period + rest
    slope = lambda x: 1.0  # noqa: E731
    return reference(sphere, START, np.array([0.0, time]), slope=slope)["attitude"][-1]


@parametrize("name", sorted(BALLS), ordinary=1)
@parametrize("R1", [-3, "2/3", 3, None], ordinary=1, long=1)
def test_the_closed_form_and_the_energy_hold_along_the_motion(name, R1):
    """omega_3 and n by the theorem, on either sign of l, against the integrated motion, and along the reference."""
    sphere = put(BALLS[name], R1)
    motion = solve_motion(sphere, START, potential=POTENTIAL)
    times = np.linspace(-5, 40, 200)
    assert max(np.abs(error).max() for error in motion.defects(times).values()) < 1e-12
    assert np.ptp(motion.energy(times)) < 3e-12
    times = np.linspace(0, 5, 21)
    found = reference(sphere, START, times, slope=lambda x: 1.5)
    assert np.abs(motion.omega_3(times) - found["omega_3"]).max() < 1e-11
    assert np.abs(motion.n(times) - found["n"]).max() < 1e-11
    # l eta^2 - zeta^2 is constant (on the plane: eta, Chaplygin's integral), which the reference knows nothing of.
    (m, R, a, A1, A3), x = map(float, sphere.ball.parameters), np.cos(found["u"])
    eta = found["omega_3"] * np.sqrt(A1 * A3 + A1 * m * R**2 * (1 - x**2) + A3 * m * (R * x + a) ** 2)
    half = m * R * ((A3 - A1) * R * x + A3 * a)
    zeta = m * R**2 * A1 * found["n"] + half * found["omega_3"]
    assert np.ptp(m * R**2 * (A3 - A1) * eta**2 - zeta**2) < 1e-11
    if R1 is None:
        assert np.ptp(eta) < 1e-12


@parametrize("R1", [3, -3, None], ordinary=1)
def test_rolling_holds_late(R1):
    """At t = 100 the point of the ball at the contact is at rest: derivatives of the computed path by Chebyshev series."""
    motion = usual(R1)
    nodes = np.cos((np.arange(64) + 0.5) * np.pi / 64)
    times = 100.5 + nodes / 2
    contact, attitude, s = motion.contact(times), motion.attitude(times), motion.contact_on_ball(times)
    normal = np.einsum("nij,nj->ni", attitude, s)

    def rate(values):
        fit = chebyshev.chebfit(nodes, values.reshape(64, -1), 40)
        return 2 * chebyshev.chebval(nodes, chebyshev.chebder(fit)).T.reshape(values.shape)

    # The contact point moves on the ball as it does in space: d(contact)/dt = A R s'.
    assert np.abs(rate(contact) - np.einsum("nij,nj->ni", attitude, rate(s))).max() < 1e-9
    spin = rate(attitude) @ attitude.transpose(0, 2, 1)
    omega = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
    assert np.abs((omega * normal).sum(1) - motion.n(times)).max() < 1e-9
    assert np.abs((omega * attitude[:, :, 2]).sum(1) - motion.omega_3(times)).max() < 1e-9


def pendulum(sphere, gap):
    """A start without spin at u = 2 whose kinetic energy falls short of the equilibrium u = 0 by the fraction `gap`."""
    m, R, a, A1, _ = map(float, sphere.ball.parameters)
    V = solve_motion(sphere, START).force.value
    K11 = (1 + float(sphere.ratio)) ** 2 * (A1 + m * (R**2 + a**2 + 2 * R * a * np.cos(2.0)))
    return replace(START, u=2.0, du=-np.sqrt(2 * (V(0.0) - V(2.0)) / K11 * (1 - gap)), dv=0.0, n=0.0)


@parametrize("R1", [3, "2/3"], ordinary=0, long=1)
@parametrize("gap", [1e-2, 1e-5, -1e-5, -1e-2], ordinary=0, long=2)
def test_near_the_separatrix(R1, gap):
    """The ball just swings back before it stands upright, or just goes over: against Newton and Euler's equations."""
    sphere = BALLS["l > 0"].on_sphere(R1)
    start = pendulum(sphere, gap)
    motion = solve_motion(sphere, start)
    assert abs(motion.turning_points[1] - np.pi) < 1e-12
    assert (motion.turning_points[0] > 1e-6) == (gap > 0)
    times = np.linspace(0, 0.6 * motion.period, 40)
    assert np.ptp(motion.energy(times)) < 1e-12
    # The equations themselves multiply an error by about 1/gap on the way past the equilibrium.
    assert np.abs(motion.u(times) - reference(sphere, start, times)["u"]).max() < 1e-10 / abs(gap)


@parametrize("gap", [1e-15, 0.0, -1e-15], ordinary=0, long=2)
def test_asymptotic_motions_are_followed_as_long_as_their_digits_last(gap):
    start = pendulum(SPHERE, gap)
    motion = solve_motion(SPHERE, start)
    times = np.linspace(0, motion.determined, 50)
    assert np.abs(motion.u(times) - reference(SPHERE, start, times)["u"]).max() < 1e-6
    for time in (1.001 * motion.determined, -1e-3):
        with pytest.raises(LimitExceeded, match=f"lost from t = {motion.determined:.6g} on"):
            motion.contact(time)


@pytest.mark.long
def test_from_rest_beside_the_upright_position():
    """Up to the second time that it stands upright: u = 1e-7 to 1e-11 only shift the time by log(10^k) over the growth rate."""
    motions = [solve_motion(SPHERE, MotionStart(u=10.0**-k, du=0, dv=0, n=0)) for k in (7, 8, 9)]
    assert all(10 < motion.determined < np.inf for motion in motions)
    times = []
    for motion in motions:
        grid = np.linspace(0, motion.determined, 20_001)
        times.append(grid[np.argmax(motion.u(grid) > 1)])
    first, second = np.diff(times)
    assert first > 0
    assert abs(first - second) < 3 * grid[1]


@pytest.mark.long
def test_motions_that_just_turn_are_periodic():
    for gap in (1e-9, -1e-9):
        motion = solve_motion(SPHERE, pendulum(SPHERE, gap))
        assert motion.approach < 1e-3
        assert motion.period is not None


@pytest.mark.parametrize("R1", [3, pytest.param("-7/2", marks=pytest.mark.long)])
def test_the_start_is_where_the_state_says(R1):
    """u1 and v1 are the contact point's, inside too; the ball moves there along e_u as theta says."""
    sphere = BALLS["l > 0"].on_sphere(R1)
    start = MotionStart(u=1.0, du=0.5, dv=0.0, n=2.0, v=0.1, theta=0.3, u1=0.4, v1=0.2)
    motion = solve_motion(sphere, start)
    south = np.array([np.cos(0.4) * np.cos(0.2), np.cos(0.4) * np.sin(0.2), -np.sin(0.4)])
    east = np.array([-np.sin(0.2), np.cos(0.2), 0.0])
    at = motion.contact(0.0)
    assert np.abs(at / abs(float(sp.S(R1))) - np.cross(south, east)).max() < 1e-12
    way = (motion.contact(1e-5) - motion.contact(-1e-5)) / 2e-5
    e_u = -np.sin(0.3) * south + np.cos(0.3) * east
    assert np.abs(way - 0.5 * e_u).max() < 1e-8


@pytest.mark.long
def test_the_reaction_presses_unless_the_ball_is_fast():
    """Inside a sphere the default force presses the ball to the wall; outside a fast ball would leave the sphere."""
    slow = replace(START, du=0.01, dv=0.01, n=0.0)
    for R1 in (3, -3, None):
        assert solve_motion(put(BALLS["l > 0"], R1), slow).reaction(np.linspace(0, 9, 50)).min() > 0.8
    fast = replace(START, du=5.0)
    assert solve_motion(SPHERE, fast).reaction(0.0) < 0
    assert solve_motion(BALLS["l > 0"].on_sphere(-3), fast).reaction(0.0) > 2
    assert solve_motion(SPHERE, slow, potential="cos(u)").reaction(0.0) is None
    assert solve_motion(SPHERE, slow, gravity=-1).reaction(0.0) < 0


def test_what_is_refused():
    for wrong in (-0.1, 3.2):
        with pytest.raises(InputError, match="between 0 and pi"):
            solve_motion(SPHERE, replace(START, u=wrong))
    with pytest.raises(InputError, match="the potential can't contain q"):
        solve_motion(SPHERE, START, potential=sp.Symbol("q") * sp.cos(U))
    symbolic = RollingBall(m=sp.Symbol("m"), R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    with pytest.raises(InputError, match="numbers are needed"):
        solve_motion(symbolic, START)
    for value in (np.nan, np.inf, 1e60):
        with pytest.raises(InputError, match="can start with"):
            solve_motion(SPHERE, replace(START, du=value))
    heavy = RollingBall(m=10**60, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    with pytest.raises(InputError, match="choose units"):
        solve_motion(heavy, START)
    with pytest.raises(InputError, match="either"):
        solve_motion(SPHERE, START, gravity=1, potential="cos(u)")
    for value in (None, 1j, True, sp.Symbol("q"), [1.0], sp.I):
        with pytest.raises(InputError):
            solve_motion(SPHERE, replace(START, dv=value))
    motion = usual(3)
    for late in (np.inf, np.nan):
        with pytest.raises(InputError, match="finite"):
            motion.u([0.0, late])
    with pytest.raises(LimitExceeded, match="100000 oscillations"):
        motion.contact(1e7)


@pytest.mark.long
def test_work_is_bounded(monkeypatch):
    """A fall into a singularity, and one oscillation that takes too long, end with a reason."""
    with pytest.raises(LimitExceeded, match="can't be followed beyond t ="):
        solve_motion(SPHERE, START, potential="-1/(cos(u) - 1/3)^2")
    monkeypatch.setattr("kovacic.ball.motion._MOST_EVALUATIONS", 100)
    with pytest.raises(LimitExceeded, match="within 100 evaluations"):
        solve_motion(SPHERE, START)


@pytest.mark.parametrize(
    ("potential", "message"),
    [
        ("u", "smooth at the poles"),
        ("sin(u)", "smooth at the poles"),
        ("1/(1 - cos(u))", "isn't finite at u = 0;"),
        ("sqrt(cos(u) - 2)", "isn't finite"),
        ("sqrt(-1)*cos(u)", "real function"),
        ("q*cos(u)", "can't contain q"),
        ("E*cos(u)", "can't contain E"),
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
        solve_motion(SPHERE, START, potential=potential)


@pytest.mark.parametrize("potential", ["9^9^9", "1e999", "(9^99)^99", "+".join(["cos(u)"] * 200)])
def test_potentials_that_are_too_large(potential):
    with pytest.raises(LimitExceeded):
        solve_motion(SPHERE, START, potential=potential)


@pytest.mark.parametrize(
    "potential",
    [
        sp.Function("f")(U),
        sp.Function("exit")(U),
        sp.Abs(sp.cos(U)),
        "abs(cos(u))",
        "sign(cos(u))*cos(u)^2",
        "Heaviside(u - 1)*u",
        sp.Integral(sp.cos(U), U),
        sp.zoo,
        sp.oo,
        sp.nan,
    ],
)
def test_potentials_that_are_not_elementary(potential):
    with pytest.raises(InputError, match="the potential can't contain"):
        solve_motion(SPHERE, START, potential=potential)


@parametrize(
    "potential",
    [
        "0",
        "3/2*cos(u)",
        "exp(-cos(2u)) + pi",
        "log(2 + cos(u))",
        "1/(1.0001 - cos(u))",
        "1/(cos(u) - 1/3)",
        "cos(40u)/9",
        sp.tanh(sp.cos(U)) / 2 + 0.25,
    ],
    ordinary=1,
    long=1,
)
def test_motion_under_other_potentials(potential):
    """Steep ones, with a barrier that isn't reached, with many equilibria: as central forces in the reference."""
    motion = solve_motion(SPHERE, START, potential=potential)
    times = np.linspace(0, 2 * motion.period, 30)
    x = sp.Symbol("x")
    slope = sp.lambdify(x, sp.diff(sp.expand_trig(motion.force.V).subs(sp.cos(U), x), x))
    if "40" in str(potential):
        slope = lambda x: 40 / 9 * np.sin(40 * np.arccos(x)) / np.sqrt(1 - x * x)  # noqa: E731
    errors = differences(motion, reference(SPHERE, START, times, slope=slope), times)
    assert max(errors.values()) < 1e-9, errors
    assert np.ptp(motion.energy(times)) < 1e-11 * max(1, abs(motion.energy(0.0)))


@pytest.mark.long
def test_parameters_and_starts_may_be_irrational():
    ball = RollingBall(m="sqrt(2)", R=1, a="1/5", A1="sqrt(2)/4", A3="sqrt(2)/3")
    sphere = ball.on_sphere("2*sqrt(2)")
    start = MotionStart("sqrt(2)/2", "1/2", Fraction(-3, 10), sp.sqrt(3))
    motion = solve_motion(sphere, start, potential="sqrt(2)*cos(u)")
    times = np.linspace(0, 3, 9)
    exactly = MotionStart(np.sqrt(0.5), 0.5, -0.3, np.sqrt(3))
    found = reference(sphere, exactly, times, slope=lambda x: np.sqrt(2))
    assert max(differences(motion, found, times).values()) < 1e-10
    assert motion.u(0.0).shape == ()
    assert motion.attitude(times.reshape(3, 3)).shape == (3, 3, 3, 3)


EVIL = "print('executed') or 1#"


@pytest.mark.parametrize(
    "call",
    [
        lambda text: solve_motion(SPHERE, START, gravity=text),
        lambda text: solve_motion(SPHERE, START, potential=text),
        lambda text: solve_motion(SPHERE, replace(START, n=text)),
    ],
)
@pytest.mark.parametrize("text", [EVIL, "__import__('os').getcwd()"])
def test_text_is_never_executed(call, text, capsys):
    with pytest.raises(InputError):
        call(text)
    assert capsys.readouterr().out == ""


@pytest.mark.long
def test_pictures(tmp_path):
    for name, R1, options in (("outside", 3, {}), ("inside", -3, {"potential": POTENTIAL}), ("plane", None, {})):
        path = tmp_path / f"{name}.png"
        draw(solve_motion(put(BALLS["l > 0"], R1), START, **options), np.linspace(0, 5, 100), path, title="A ball")
        assert path.stat().st_size > 20_000


@pytest.mark.long
def test_a_picture_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    motion, times = solve_motion(SPHERE, START), np.linspace(0, 1, 20)
    picture = tmp_path / "path.svg"
    picture.write_bytes(b"an older one")

    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(type(picture), "replace", interrupted)
        with pytest.raises(KeyboardInterrupt):
            draw(motion, times, picture)
    assert picture.read_bytes() == b"an older one"
    draw(motion, times, picture)
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    assert [path.name for path in tmp_path.iterdir()] == ["path.svg"]


@parametrize(
    "potential",
    [
        sp.log(3 + sp.cos(2 * U)) * sp.sqrt(2) + sp.sin(U) ** 2 * sp.tanh(sp.cos(U)) + sp.E * sp.cos(U) + sp.pi,
        sp.exp(-3 * sp.cos(U) / 2) / (2 + sp.cos(U)) ** sp.Rational(3, 2),
        sp.cosh(sp.cos(U)) + sp.atan(sp.sin(U) ** 4) - sp.acos(sp.cos(U) / 2),
    ],
    ordinary=1,
)
def test_potentials_of_sympy_are_taken_as_they_are(potential):
    """They are read as text, by the parser of everything else; floats in them have all their digits."""
    V = solve_motion(SPHERE, START, potential=(0.1 + 0.2) * potential).force.V
    assert float(V.subs(U, 1)) == float((sp.Rational(0.1 + 0.2) * potential).subs(U, 1))

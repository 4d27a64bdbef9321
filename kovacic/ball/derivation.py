"""The paper's equations (1) to (13) derived from the definitions, for all values of the parameters.

The two velocities of the contact point in the frame (e_u, e_v, e_n) agree (rolling without slipping): that gives (2).  The
angular velocity is that of the frame in space, known by (u1, v1, theta), less that in the ball, known by (u, v): (4), (5).
The equations of motion (7) are d'Alembert's principle for the velocities u', v', n that rolling leaves free; the rest follows
by elimination.  `residuals` is the difference of each printed formula from what is derived here, and `holds` decides that
they vanish, in the engine's field of rational functions.  The accelerations are unique, since the matrix of K22, K23, K33 is
positive definite.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp
from sympy import cos, sin

from kovacic.ball.body import A1, A3, InRoots, x1, x2
from kovacic.ball.paper import (
    K11,
    K22,
    K23,
    K33,
    PRINTED,
    R1,
    D,
    R,
    T_du,
    T_dv,
    T_n,
    T_u,
    V_u,
    a,
    ddu,
    ddv,
    dn,
    dtheta,
    du,
    du1,
    dv,
    dv1,
    m,
    n,
    sigma,
    tau,
    theta,
    u,
    u1,
    v,
    v1,
    w3,
    x,
)
from kovacic.limits import Limits
from kovacic.reading.read import read_input


def rate(expression: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """d/dt, the symbols in `clock` having these rates."""
    return sum((expression.diff(symbol) * speed for symbol, speed in clock.items()), expression * 0)


def _axes(p: sp.Symbol, q: sp.Symbol) -> tuple[Any, Any, Any]:
    """The unit vectors along the meridian, along the circle and outwards on a sphere of colatitude p, longitude q."""
    out = sp.Matrix([sin(p) * cos(q), sin(p) * sin(q), cos(p)])
    east = sp.Matrix([-sin(q), cos(q), 0])
    return out.diff(p), east, out


def _turning(frame: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """The angular velocity of a frame, in itself."""
    W = frame.T * rate(frame, clock)
    return sp.Matrix([W[2, 1], W[0, 2], W[1, 0]])


def _cosines() -> Any:
    """The printed direction cosines, e_u, e_v, e_n as columns in the axes of the ball."""
    return sp.Matrix(3, 3, [PRINTED["1"][f"c{column}{row}"] for row in (1, 2, 3) for column in (1, 2, 3)])


def _surface() -> Any:
    """The printed surface, from the centre of mass."""
    return sp.Matrix([PRINTED["8"][name] for name in ("x", "y", "z")])


def _space() -> Any:
    """The frame at the contact point as (u1, v1, theta) tell it, as columns in space."""
    south, east, out = _axes(u1, v1)
    along = -sin(theta) * south + cos(theta) * east
    across = cos(theta) * south + sin(theta) * east
    return sp.Matrix.hstack(along, across, -out)


_ON_BALL = {u: du, v: dv}
_ON_SPHERE = {u1: du1, v1: dv1, theta: dtheta}


def _rolling() -> dict[sp.Symbol, sp.Expr]:
    """u1' and v1' as (2) prints them."""
    return {du1: PRINTED["2"]["u1'"], dv1: PRINTED["2"]["v1'"]}


def _energy() -> sp.Expr:
    """2 Theta as (6) prints it."""
    K = PRINTED["6"]
    return K["K11"] * du**2 + K["K22"] * dv**2 + 2 * K["K23"] * dv * n + K["K33"] * n**2


def _surface_and_frame() -> Iterator[tuple[str, list[Any]]]:
    """(8) and (1): the surface is a sphere about its centre; its fundamental forms; the direction cosines."""
    forms = PRINTED["8"]
    r = _surface()
    c = _cosines()
    r_u = r.diff(u)
    r_v = r.diff(v)
    e_n = c[:, 2]
    centre = sp.Matrix([0, 0, a])
    sphere = (r - centre).dot(r - centre) - R**2
    first = [r_u.dot(r_u) - forms["E"], r_u.dot(r_v), r_v.dot(r_v) - forms["G"]]
    second = [r.diff(u, 2).dot(e_n) - forms["L"], r.diff(u, v).dot(e_n), r.diff(v, 2).dot(e_n) - forms["N"]]
    yield "(8)", [sphere, *first, *second]
    # sqrt(E) = R and sqrt(G) = R sin u.
    yield "(1)", [*(R * c[:, 0] - r_u), *(R * sin(u) * c[:, 1] - r_v), *(c[:, 0].cross(c[:, 1]) - e_n)]


def _kinematics() -> Iterator[tuple[str, list[Any]]]:
    """(2), (4) and (5)."""
    five = PRINTED["5"]
    c = _cosines()
    in_space = _space()
    rolling = _rolling()
    contact_on_sphere = R1 * _axes(u1, v1)[2]
    slip = c.T * rate(_surface(), _ON_BALL) - in_space.T * rate(contact_on_sphere, _ON_SPHERE)
    yield "(2)", list(slip.xreplace(rolling))
    in_frame = _turning(in_space, _ON_SPHERE) - _turning(c, _ON_BALL)
    along = in_frame[0].xreplace(rolling) - five["tau"] * dv
    across = in_frame[1].xreplace(rolling) - five["sigma"] * du
    yield "(5)", [along, across, in_frame[2] - five["n"]]
    omega = c * sp.Matrix([tau * dv, sigma * du, n])
    yield "(4)", [omega[i] - PRINTED["4"][f"omega_{i + 1}"] for i in range(3)]


def _dynamics() -> Iterator[tuple[str, list[Any]]]:
    """(3) with (6), and (7)."""
    five = PRINTED["5"]
    values = {tau: five["tau"], sigma: five["sigma"]}
    energy = _energy()
    # (3) and (4), in the axes of the ball.
    one, two, three = (PRINTED["4"][f"omega_{i}"].xreplace(values) for i in (1, 2, 3))
    X, Y, Z = _surface()
    w = sp.Matrix([three * Y - two * Z, one * Z - three * X, two * X - one * Y])
    yield "(3), (6)", [m * w.dot(w) + A1 * (one**2 + two**2) + A3 * three**2 - energy]
    # In the frame, where v doesn't occur.
    c = _cosines()
    omega = sp.Matrix([five["tau"] * dv, five["sigma"] * du, n])
    frame_turns = _turning(c, _ON_BALL)
    rho, axis = (c.T * vector for vector in (_surface(), sp.Matrix([0, 0, 1])))
    velocity = rho.cross(omega)
    momentum = A1 * omega + (A3 - A1) * omega.dot(axis) * axis
    clock = {u: du, du: ddu, dv: ddv, n: dn}
    force, moment = (rate(vector, clock) + (omega + frame_turns).cross(vector) for vector in (m * velocity, momentum))
    at = {V_u: sp.S.Zero} | {name: energy.diff(z) / 2 for name, z in ((T_u, u), (T_du, du), (T_dv, dv), (T_n, n))}
    parts = []
    for z, name in ((du, "dTheta_u'/dt"), (dv, "dTheta_v'/dt"), (n, "dTheta_n/dt")):
        inertia = force.dot(velocity.diff(z)) + moment.dot(omega.diff(z))
        parts.append(inertia - rate(energy.diff(z) / 2, clock) + PRINTED["7"][name].xreplace(at))
    yield "(7)", parts


def _elimination() -> Iterator[tuple[str, list[Any]]]:
    """(9), (10), the system in n and omega_3, and (11)."""
    K = PRINTED["6"]
    in_K = dict(zip((K11, K22, K23, K33), (K[name] for name in ("K11", "K22", "K23", "K33")), strict=True))
    nine = {name: value.xreplace(in_K) for name, value in PRINTED["9"].items()}
    momenta = {T_du: K11 * du, T_dv: K22 * dv + K23 * n, T_n: K33 * n + K23 * dv}
    of_v, of_n = (PRINTED["7"][name].xreplace(momenta).xreplace(in_K) for name in ("dTheta_v'/dt", "dTheta_n/dt"))
    yield "(9)", [of_v - (nine["a1"] * n + nine["b1"] * dv) * du, of_n - (nine["a2"] * n + nine["b2"] * dv) * du]
    # d/dt = u' d/du, and the derivatives of K22, K23, K33 go to the right-hand side.
    named = {sp.Symbol(name): value for name, value in nine.items()}
    ten = {name: value.xreplace(named) for name, value in PRINTED["10"].items()}
    first = nine["a1"] * n + nine["b1"] * dv - (sp.diff(K["K23"], u) * n + sp.diff(K["K22"], u) * dv)
    second = nine["a2"] * n + nine["b2"] * dv - (sp.diff(K["K33"], u) * n + sp.diff(K["K23"], u) * dv)
    yield "(10)", [ten["a1'"] * n + ten["b1'"] * dv - first, ten["a2'"] * n + ten["b2'"] * dv - second]
    p = {
        name: value.xreplace({D: PRINTED["system"]["D"]})
        for key in ("system", "11")
        for name, value in PRINTED[key].items()
    }
    # v' from the third of (4), in which c23 = 0.
    slope = (cos(u) * n - w3) / (PRINTED["5"]["tau"] * sin(u))
    along = {u: 1, n: p["a1"] * n + p["a2"] * w3, w3: p["b1"] * n + p["b2"] * w3}
    rates = along[n], rate(slope, along)
    parts = [
        K["K23"] * rates[0] + K["K22"] * rates[1] - ten["a1'"] * n - ten["b1'"] * slope,
        K["K33"] * rates[0] + K["K23"] * rates[1] - ten["a2'"] * n - ten["b2'"] * slope,
    ]
    yield "a1, a2, b1, b2", parts
    growth = sp.diff(p["b1"], u) / p["b1"]
    d1 = -(growth + p["a1"] + p["b2"])
    d2 = growth * p["b2"] - sp.diff(p["b2"], u) + p["a1"] * p["b2"] - p["a2"] * p["b1"]
    yield "(11)", [p["d1"] - d1, p["d2"] - d2]


def _in_the_roots() -> Iterator[tuple[str, list[Any]]]:
    """(12) and (13): the roots in place of m and a; their sum gives a, and their product is linear in 1/m."""
    p = {name: value.xreplace({D: PRINTED["system"]["D"]}) for name, value in PRINTED["11"].items()}
    offset = -R * (A3 - A1) * (x1 + x2) / (2 * A3)
    mass = A1 * A3 / (R**2 * (A3 - A1) * x1 * x2 - A1 * R**2 - A3 * offset**2)
    place = InRoots(R / R1)
    one, two = place.second_order
    in_u = one * sin(u) ** 2 + cos(u) + p["d1"] * sin(u), two * sin(u) ** 2 - p["d2"]
    yield "(12)", [part.xreplace({x: cos(u), m: mass, a: offset}) for part in in_u]
    yield "(13)", [place.S - (sp.diff(one, x) / 2 + one**2 / 4 - two)]


def residuals() -> Iterator[tuple[str, list[Any]]]:
    """For each formula of `PRINTED`, and for (12) and (13), in this order: what vanishes if it is right."""
    for part in (_surface_and_frame, _kinematics, _dynamics, _elimination, _in_the_roots):
        yield from part()


def vanishes(expression: Any) -> bool:
    """Is an expression, rational in names and in sines and cosines of names, zero?  Decided in the engine's fields."""
    rational: dict[Any, Any] = {}
    for z in (u, v, theta, u1, v1):
        t = sp.Symbol(f"t_{z}")
        rational |= {sin(z): 2 * t / (1 + t**2), cos(z): (1 - t**2) / (1 + t**2)}
    return not read_input(sp.sympify(expression).xreplace(rational), var="t_u", limits=Limits(parameters=30)).S.num


def holds() -> dict[str, bool]:
    """For each group of formulas: does the derivation confirm it, for all values of the parameters?"""
    return {name: all(map(vanishes, parts)) for name, parts in residuals()}

"""Woronetz's equations for the ball on the sphere, as the paper prints them, and their derivation from the definitions.

The contact point is r(u, v) on the ball, in axes through its centre of mass, and r1(u1, v1) on the sphere; theta is the angle
between the meridians there.  The frame (e_u, e_v, e_n), e_n being the ball's outward normal, is known in the ball by (u, v)
and in space by (u1, v1, theta).  The two velocities of the contact point in this frame agree (rolling without slipping):
that gives u1', v1', the c_ij.  The angular velocity is that of the frame in space less that in the ball: (tau v', sigma u', n).
The equations of motion are d'Alembert's principle for the velocities u', v', n that rolling leaves free.

`PRINTED` is what the paper prints; `residuals` is the difference of each from what SymPy derives here, and `holds`
decides that they vanish, in the engine's field of rational functions.  The accelerations are unique, since the matrix of
K22, K23, K33 is positive definite.
P. Woronetz, Math. Ann. 70 (1911) 410-453; A. S. Kuleshov & D. V. Katasonova (2018).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp
from sympy import cos, sin

from kovacic.ball.ball import A1, A3, InRoots, Rolling, U, X, x1, x2
from kovacic.limits import Limits
from kovacic.reading.read import read_input
from kovacic.writing.document import FORMATS, Block, Formula, Heading, say
from kovacic.writing.formula import Math

u, x = U, X
m, R, a, R1, D = sp.symbols("m R a R1 D")
v, theta, u1, v1, n, w3 = sp.symbols("v theta u1 v1 n omega_3")
du, dv, dtheta, du1, dv1, ddu, ddv, dn = sp.symbols("u' v' theta' u1' v1' u'' v'' n'")
#: The partial derivatives of the kinetic energy Theta, and dV/du.
T_u, T_du, T_dv, T_n, V_u = sp.symbols("Theta_u Theta_u' Theta_v' Theta_n V_u")

#: How names are written in LaTeX.
_TEX = {du: r"\dot{u}", dv: r"\dot{v}", dtheta: r"\dot{\theta}", du1: r"\dot{u}_{1}", dv1: r"\dot{v}_{1}"}
_TEX[V_u] = r"\frac{dV}{du}"
for _name, _tex in (("u", "u"), ("u'", r"\dot{u}"), ("v'", r"\dot{v}"), ("n", "n")):
    _part = rf"\frac{{\partial\Theta}}{{\partial {_tex}}}"
    _TEX |= {sp.Symbol(f"Theta_{_name}"): _part, sp.Symbol(f"dTheta_{_name}/dt"): rf"\frac{{d}}{{dt}}{_part}"}

_k, _eps, _tilt = 1 + R / R1, R + a * cos(u), (A3 - A1) * R * cos(u) + A3 * a
_s, _c, _rho, _pull, _turn = sin(u), cos(u), R / R1, R / (R + R1), _k * _eps
#: What the paper prints, by name; D is a name in a1, ..., d2.
PRINTED: dict[str, sp.Expr] = {
    "c11": -_rho * sin(theta),
    "c12": _rho * _s * cos(theta),
    "c21": _rho * cos(theta) / sin(u1),
    "c22": _rho * _s * sin(theta) / sin(u1),
    "n": -dtheta - _c * dv - cos(u1) * dv1,
    "sigma": -_k,
    "tau": _k * _s,
    "K11": _k**2 * (A1 + m * (R**2 + a**2 + 2 * R * a * _c)),
    "K22": _k**2 * _s**2 * (m * _eps**2 + A1 * _c**2 + A3 * _s**2),
    "K23": _k * _s**2 * (m * a * _eps - (A3 - A1) * _c),
    "K33": (A1 + m * a**2) * _s**2 + A3 * _c**2,
    "dTheta_u'/dt": T_u
    + (1 - _rho**2) * _s * dv * T_n
    + _pull / _s * n * T_dv
    + m * R * _s * n * (a * n + _turn * dv)
    - V_u,
    "dTheta_v'/dt": -(1 - _rho**2) * _s * du * T_n - _pull * _s * n * T_du - m * R * _s * n * _turn * du,
    "dTheta_n/dt": _pull * _s * dv * T_du - _pull / _s * du * T_dv - m * R * a * _s * du * n,
    "D": A1 * A3 + A1 * m * R**2 * _s**2 + A3 * m * (R * _c + a) ** 2,
    "a1": -m * R**2 * _tilt * _s / (R1 * D),
    "a2": (R1 + R) * ((A3 + m * R**2) * (A3 - A1) - A3 * m * a**2) * _s / (R1 * D),
    "b1": m * R**3 * A1 * _s / (R1 * D),
    "b2": m * R * (R1 + R) * _tilt * _s / (R1 * D),
    "d1": -(2 * m * R**2 * (A3 - A1) * _s**2 * _c + (3 - _c**2) * m * R * a * A3 + A3 * (A1 + m * R**2 + m * a**2) * _c)
    / (D * _s),
    "d2": m * R**2 * (R1**2 - R**2) * (A3 - A1) * _s**2 / (R1**2 * D),
}


def equation(d1: sp.Expr, d2: sp.Expr, variable: sp.Symbol = x) -> Math:
    """omega_3'' + d1 omega_3' + d2 omega_3 = 0."""
    text, tex = f"omega_3''({variable})", r"\omega_{3}''"
    for coefficient, prime in ((d1, "'"), (d2, "")):
        if coefficient != 0:
            text += f" + ({coefficient})*omega_3{prime}({variable})"
            tex += rf" + \left({sp.latex(coefficient)}\right) \omega_{{3}}{prime}"
    return Math(f"{text} = 0", f"{tex} = 0")


def named(name: str, value: sp.Expr) -> Math:
    """name = value."""
    return Math(f"{name} = {value}", " = ".join(sp.latex(z, symbol_names=_TEX) for z in (sp.Symbol(name), value)))


def equations_of(place: Rolling) -> dict[str, Math]:
    """a1, a2, b1, b2, and the equations 11, 12 and 13 with the values of one ball, or in the roots."""
    (d1, d2), S = place.second_order, place.S
    in_u = [part.subs(x, cos(u)) for part in (*place.linear_system, d1, d2)]
    found = {name: named(name, part * sin(u)) for name, part in zip(("a1", "a2", "b1", "b2"), in_u, strict=False)}
    factor = rf"\left({sp.latex(S)}\right)" if S.is_Add else sp.latex(S)
    return {
        **found,
        "11": equation(-sin(u) * in_u[4] - cos(u) / sin(u), sin(u) ** 2 * in_u[5], u),
        "12": equation(d1, d2),
        "13": Math(f"y''(x) = ({S})*y(x)", f"y'' = {factor} y") if S else Math("y''(x) = 0", "y'' = 0"),
    }


#: The steps of the derivation: what is said, a relation in plain text and in LaTeX, and the names that it introduces.
_STEPS = (
    ("Rolling without slipping", "u1' = c11 u' + c12 v', v1' = c21 u' + c22 v'",
     r"\dot{u}_{1} = c_{11}\dot{u} + c_{12}\dot{v}, \quad \dot{v}_{1} = c_{21}\dot{u} + c_{22}\dot{v}",
     ("c11", "c12", "c21", "c22")),
    ("Angular velocity along the meridian, the circle and the normal of the ball", "omega = (tau v', sigma u', n)",
     r"\boldsymbol{\omega} = (\tau\dot{v}, \sigma\dot{u}, n)", ("tau", "sigma", "n")),
    ("Kinetic energy", "2 Theta = K11 u'^2 + K22 v'^2 + 2 K23 v' n + K33 n^2",
     r"2\Theta = K_{11}\dot{u}^{2} + K_{22}\dot{v}^{2} + 2K_{23}\dot{v}n + K_{33}n^{2}", ("K11", "K22", "K23", "K33")),
    ("(7) The equations of motion", "Theta + V(u) = const; Theta_z is dTheta/dz, V_u is dV/du",
     r"\Theta + V(u) = \mathrm{const}", ("dTheta_u'/dt", "dTheta_v'/dt", "dTheta_n/dt")),
    ("The last two, divided by u'",
     "omega_3 = cos(u) n - tau sin(u) v', dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3",
     r"\omega_{3} = n\cos u - \tau\dot{v}\sin u, \quad \frac{dn}{du} = a_{1}n + a_{2}\omega_{3}, "
     r"\quad \frac{d\omega_{3}}{du} = b_{1}n + b_{2}\omega_{3}", ("a1", "a2", "b1", "b2", "D")),
    ("(11) Without n", "d^2 omega_3/du^2 + d1 d omega_3/du + d2 omega_3 = 0",
     r"\frac{d^{2}\omega_{3}}{du^{2}} + d_{1}\frac{d\omega_{3}}{du} + d_{2}\omega_{3} = 0", ("d1", "d2")),
)  # fmt: skip


def derivation(*, format: str = "text") -> str:
    """The equations for all values of the parameters, as "text", "markdown", "latex" or "html", as `explain` has them."""
    in_roots, y = equations_of(InRoots(R / R1)), Math("y = D(x)^(3/4) omega_3", r"y = D(x)^{3/4}\omega_{3}")
    surface = "x = R sin u cos v, y = R sin u sin v, z = R cos u + a about the centre of mass"
    blocks: list[Block] = [say(f"The ball's surface: {surface}; (u1, v1) on the sphere; theta between the meridians.")]
    for title, rows in (
        *((title, [Math(*said), *(named(name, PRINTED[name]) for name in names)]) for title, *said, names in _STEPS),
        ("(12) In the roots x1, x2 of D(x), with x = cos u", [in_roots["12"]]),
        ("(13) The normal form", [y, in_roots["13"]]),
    ):
        array = r" \\ \displaystyle ".join(row.latex for row in rows)
        text = "\n".join(row.text for row in rows)
        blocks += [Heading(title), Formula(Math(text, rf"\begin{{array}}{{l}} \displaystyle {array} \end{{array}}"))]
    return FORMATS[format].render(blocks)


def rate(expression: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """d/dt, the symbols in `clock` having these rates."""
    return sum((expression.diff(symbol) * speed for symbol, speed in clock.items()), expression * 0)


def _axes(p: sp.Symbol, q: sp.Symbol) -> tuple[Any, Any, Any]:
    """The unit vectors along the meridian, along the circle and outwards on a sphere of colatitude p, longitude q."""
    out = sp.Matrix([sin(p) * cos(q), sin(p) * sin(q), cos(p)])
    return out.diff(p), sp.Matrix([-sin(q), cos(q), 0]), out


def _turning(frame: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """The angular velocity of a frame, in itself."""
    W = frame.T * rate(frame, clock)
    return sp.Matrix([W[2, 1], W[0, 2], W[1, 0]])


def residuals() -> Iterator[tuple[str, list[Any]]]:
    """For each formula of `PRINTED`, and for (12) and (13), in this order: what vanishes if it is right."""
    p = {name: value.xreplace({D: PRINTED["D"]}) for name, value in PRINTED.items()}
    in_ball = sp.Matrix.hstack(*_axes(u, v))
    south, east, out = _axes(u1, v1)
    in_space = sp.Matrix.hstack(-sin(theta) * south + cos(theta) * east, cos(theta) * south + sin(theta) * east, -out)
    r = R * in_ball[:, 2] + sp.Matrix([0, 0, a])
    on_ball, on_sphere = {u: du, v: dv}, {u1: du1, v1: dv1, theta: dtheta}
    rolling = {du1: p["c11"] * du + p["c12"] * dv, dv1: p["c21"] * du + p["c22"] * dv}
    slip = in_ball.T * rate(r, on_ball) - in_space.T * rate(R1 * out, on_sphere)
    turn = _turning(in_ball, on_ball)
    spin = _turning(in_space, on_sphere) - turn
    yield "c_ij", list(slip.xreplace(rolling))
    yield "n", [spin[2] - p["n"]]
    yield "sigma, tau", [spin[0].xreplace(rolling) - p["tau"] * dv, spin[1].xreplace(rolling) - p["sigma"] * du]
    # In the frame: rho leads from the centre of mass to the contact point, whose velocity is zero.
    omega = sp.Matrix([p["tau"] * dv, p["sigma"] * du, n])
    rho, axis = (in_ball.T * vector for vector in (r, sp.Matrix([0, 0, 1])))
    velocity, momentum = rho.cross(omega), A1 * omega + (A3 - A1) * omega.dot(axis) * axis
    energy = p["K11"] * du**2 + p["K22"] * dv**2 + 2 * p["K23"] * dv * n + p["K33"] * n**2
    yield "K_ij", [m * velocity.dot(velocity) + omega.dot(momentum) - energy]
    clock = {u: du, du: ddu, dv: ddv, n: dn}
    force, moment = (rate(vector, clock) + (omega + turn).cross(vector) for vector in (m * velocity, momentum))
    inertia = {z: force.dot(velocity.diff(z)) + moment.dot(omega.diff(z)) for z in (du, dv, n)}
    at = {V_u: sp.S.Zero} | {name: energy.diff(z) / 2 for name, z in ((T_u, u), (T_du, du), (T_dv, dv), (T_n, n))}
    sides = ((du, "dTheta_u'/dt"), (dv, "dTheta_v'/dt"), (n, "dTheta_n/dt"))
    yield "(7)", [inertia[z] - rate(energy.diff(z) / 2, clock) + p[name].xreplace(at) for z, name in sides]
    # omega_3 = tau sin(psi) v' + cos(psi) n with psi = -u, in place of v'.
    slope = (cos(u) * n - w3) / (p["tau"] * sin(u))
    along = {u: 1, n: p["a1"] * n + p["a2"] * w3, w3: p["b1"] * n + p["b2"] * w3}
    rates = {ddv: rate(slope, along) * du, dn: along[n] * du}
    yield "a1, a2, b1, b2", [inertia[z].xreplace(rates).xreplace({dv: slope}) for z in (dv, n)]
    growth = sp.diff(p["b1"], u) / p["b1"]
    d1 = -(growth + p["a1"] + p["b2"])
    d2 = growth * p["b2"] - sp.diff(p["b2"], u) + p["a1"] * p["b2"] - p["a2"] * p["b1"]
    yield "(11)", [p["d1"] - d1, p["d2"] - d2]
    # The roots in place of m and a: their sum gives a, and their product is linear in 1/m.
    offset = -R * (A3 - A1) * (x1 + x2) / (2 * A3)
    mass = A1 * A3 / (R**2 * (A3 - A1) * x1 * x2 - A1 * R**2 - A3 * offset**2)
    place = InRoots(R / R1)
    one, two = place.second_order
    in_u = one * sin(u) ** 2 + cos(u) + p["d1"] * sin(u), two * sin(u) ** 2 - p["d2"]
    yield "(12)", [part.xreplace({x: cos(u), m: mass, a: offset}) for part in in_u]
    yield "(13)", [place.S - (sp.diff(one, x) / 2 + one**2 / 4 - two)]


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

"""Woronetz's equations (1) to (13) for the ball on the sphere: printed as in the paper, and derived from the definitions.

The contact point is (x, y, z)(u, v) on the ball, in axes through its centre of mass, and (u1, v1) on the sphere; theta is
the angle between the u-line there and the v1-line.  E, F, G and L, M, N are the fundamental forms of the ball's surface, e_n
its outward normal.  `PRINTED` has the paper's formulas under its numbers (1) to (11), general ones specialized to the ball.

The derivation holds for all values of the parameters.  The two velocities of the contact point in the frame (e_u, e_v, e_n)
agree (rolling without slipping): (2).  The angular velocity is that of the frame in space, given by (u1, v1, theta), minus that
in the ball, given by (u, v): (4), (5).  The equations of motion (7) are d'Alembert's principle for the velocities
u', v', n that rolling leaves free; the rest follows by elimination.  The accelerations are unique, since the matrix of K22,
K23, K33 is positive definite.
P. Woronetz, Math. Ann. 70 (1911) 410-453; A. S. Kuleshov & D. V. Katasonova (2018).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files
from itertools import chain
from typing import Any

import sympy as sp
from sympy import cos, sin

from kovacic.ball.body import A1, A3, InRoots, Rolling, U, X, read_short, x1, x2
from kovacic.equation import eliminated
from kovacic.limits import Limits
from kovacic.reading.read import read_input
from kovacic.writing.document import Block, Formula, Heading, format_of, say
from kovacic.writing.formula import Math

u, x = U, X
m, R, a, R1, D = sp.symbols("m R a R1 D")
v, theta, u1, v1, n, w3 = sp.symbols("v theta u1 v1 n omega_3")
du, dv, dtheta, du1, dv1, ddu, ddv, dn = sp.symbols("u' v' theta' u1' v1' u'' v'' n'")
#: The partial derivatives of the kinetic energy Theta, and dV/du.
T_u, T_du, T_dv, T_n, V_u = sp.symbols("Theta_u Theta_u' Theta_v' Theta_n V_u")
sigma, tau, K11, K22, K23, K33 = sp.symbols("sigma tau K11 K22 K23 K33")


@dataclass(frozen=True)
class PaperStep:
    """A step of the paper: its title, general relations, and the formulas of the ball by their names."""

    title: str
    relations: tuple[Math, ...]
    formulas: dict[str, sp.Expr]


def _paper_steps() -> Iterator[tuple[str, PaperStep]]:
    """The steps of `paper.txt` with their keys in `PRINTED`, in logical order: (8) comes first.

    There "key | title" stands before the relations, text and LaTeX in turn, and the formulas, which begin with "="; a line
    that is indented twice continues the one above.  In a formula z_u is the derivative by u of the z printed before, and u'
    is read as u_dot.
    """
    # The symbols of this module, and those of (9) and (10).
    symbols = [*(z for z in globals().values() if isinstance(z, sp.Symbol)), *sp.symbols("a1 b1 a2 b2")]
    names = {symbol.name.replace("'", "_dot"): symbol for symbol in symbols}
    text = (files(__package__) / "paper.txt").read_text(encoding="utf-8").strip()
    for step in re.split(r"\n(?! )", text):
        heading, *lines = step.replace("\n      ", " ").splitlines()
        key, _, title = heading.partition("| ")
        formulas = {}
        for line in lines:
            if line.startswith("  = "):
                name, _, value = line.removeprefix("  = ").partition(" = ")
                formulas[name] = read_short(value.replace("'", "_dot"), names=names)
                names[f"{name}_u"] = formulas[name].diff(u)
        rows = [line.strip() for line in lines if not line.startswith("  = ")]
        yield key.strip(), PaperStep(title, tuple(map(Math, rows[::2], rows[1::2])), formulas)


#: All steps; those without formulas follow from the roots x1, x2 of D, (12) and (13), or from others, (3).
PAPER_STEPS = tuple(_paper_steps())
#: For each of the paper's numbers (and "system", which has none) the formulas by name; "system" and (11) have D as a name.
PRINTED: dict[str, dict[str, sp.Expr]] = {key: step.formulas for key, step in PAPER_STEPS if step.formulas}


def rate(expression: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """d/dt of an expression or a matrix, with the rates of the symbols in `clock`."""
    return sum((expression.diff(symbol) * speed for symbol, speed in clock.items()), expression * 0)


def _turning(frame: Any, clock: Mapping[sp.Symbol, Any]) -> Any:
    """The angular velocity of a frame, in its own axes: the entries of the skew matrix F^T F'."""
    W = frame.T * rate(frame, clock)
    return sp.Matrix([W[2, 1], W[0, 2], W[1, 0]])


def _surface_and_frame() -> tuple[Any, Any]:
    """The printed surface from the centre of mass, and e_u, e_v, e_n as columns in the axes of the ball."""
    c = sp.Matrix(3, 3, lambda i, j: PRINTED["1"][f"c{j + 1}{i + 1}"])
    return sp.Matrix([PRINTED["8"][name] for name in "xyz"]), c


_BALL_CLOCK = {u: du, v: dv}
_SPHERE_CLOCK = {u1: du1, v1: dv1, theta: dtheta}


def _kinematics() -> Iterator[tuple[str, list[Any]]]:
    """(8), (1), (2), (5), (4): the surface is a sphere; its fundamental forms; the direction cosines; rolling."""
    forms, five = PRINTED["8"], PRINTED["5"]
    r, c = _surface_and_frame()
    r_u, r_v = r.diff(u), r.diff(v)
    e_u, e_v, e_n = (c[:, k] for k in range(3))
    from_centre = r - sp.Matrix([0, 0, a])
    first = [r_u.dot(r_u) - forms["E"], r_u.dot(r_v), r_v.dot(r_v) - forms["G"]]
    second = [r_u.diff(u).dot(e_n) - forms["L"], r_u.diff(v).dot(e_n), r_v.diff(v).dot(e_n) - forms["N"]]
    yield "(8)", [from_centre.dot(from_centre) - R**2, *first, *second]
    # sqrt(E) = R and sqrt(G) = R sin u.
    yield "(1)", [*(R * e_u - r_u), *(R * sin(u) * e_v - r_v), *(e_u.cross(e_v) - e_n)]
    rolling = {du1: PRINTED["2"]["u1'"], dv1: PRINTED["2"]["v1'"]}
    # The frame at the contact point in terms of (u1, v1, theta): the meridian and the circle on the sphere, turned by theta.
    out = sp.Matrix([sin(u1) * cos(v1), sin(u1) * sin(v1), cos(u1)])
    south, east = out.diff(u1), sp.Matrix([-sin(v1), cos(v1), 0])
    in_space = sp.Matrix.hstack(-sin(theta) * south + cos(theta) * east, cos(theta) * south + sin(theta) * east, -out)
    slip = c.T * rate(r, _BALL_CLOCK) - in_space.T * rate(R1 * out, _SPHERE_CLOCK)
    yield "(2)", list(slip.xreplace(rolling))
    in_frame = _turning(in_space, _SPHERE_CLOCK) - _turning(c, _BALL_CLOCK)
    along, across, about = in_frame - sp.Matrix([five["tau"] * dv, five["sigma"] * du, five["n"]])
    yield "(5)", [along.xreplace(rolling), across.xreplace(rolling), about]  # the printed n has u1' and v1' itself
    omega = c * sp.Matrix([tau * dv, sigma * du, n])
    yield "(4)", [omega[i] - PRINTED["4"][f"omega_{i + 1}"] for i in range(3)]


def _dynamics() -> Iterator[tuple[str, list[Any]]]:
    """(3) with (6), and (7)."""
    five, K = PRINTED["5"], PRINTED["6"]
    r, c = _surface_and_frame()
    energy = K["K11"] * du**2 + K["K22"] * dv**2 + 2 * K["K23"] * dv * n + K["K33"] * n**2  # 2 Theta
    # In the frame (e_u, e_v, e_n), where v doesn't occur; the velocity of the centre of mass is that of (3).
    omega = sp.Matrix([five["tau"] * dv, five["sigma"] * du, n])
    turning = omega + _turning(c, _BALL_CLOCK)
    axis = c.T * sp.Matrix([0, 0, 1])
    velocity = (c.T * r).cross(omega)
    momentum = A1 * omega + (A3 - A1) * omega.dot(axis) * axis
    yield "(3), (6)", [m * velocity.dot(velocity) + momentum.dot(omega) - energy]
    clock = {u: du, du: ddu, dv: ddv, n: dn}
    force, moment = (rate(vector, clock) + turning.cross(vector) for vector in (m * velocity, momentum))
    at = {V_u: sp.S.Zero} | {name: energy.diff(z) / 2 for name, z in ((T_u, u), (T_du, du), (T_dv, dv), (T_n, n))}
    parts = []
    for z, name in ((du, "dTheta_u'/dt"), (dv, "dTheta_v'/dt"), (n, "dTheta_n/dt")):
        inertia = force.dot(velocity.diff(z)) + moment.dot(omega.diff(z))
        parts.append(inertia - rate(energy.diff(z) / 2, clock) + PRINTED["7"][name].xreplace(at))
    yield "(7)", parts


def _elimination() -> Iterator[tuple[str, list[Any]]]:
    """(9), (10), the system in n and omega_3, (11), (12), (13); the matrices act on (v', n)."""
    in_K = {symbol: PRINTED["6"][symbol.name] for symbol in (K11, K22, K23, K33)}
    K = sp.Matrix([[K22, K23], [K23, K33]]).xreplace(in_K)
    momenta = {T_du: K11 * du, T_dv: K22 * dv + K23 * n, T_n: K33 * n + K23 * dv}
    forces = sp.Matrix([PRINTED["7"][f"dTheta_{z}/dt"] for z in ("v'", "n")]).xreplace(momenta).xreplace(in_K)
    entries = sp.symbols("b1 a1 b2 a2")
    nine = sp.Matrix(2, 2, [PRINTED["9"][entry.name] for entry in entries]).xreplace(in_K)
    in_nine = dict(zip(entries, nine, strict=True))
    ten = sp.Matrix(2, 2, [PRINTED["10"][f"{entry.name}'"].xreplace(in_nine) for entry in entries])
    speeds = sp.Matrix([dv, n])
    yield "(9)", list(forces - nine * speeds * du)
    # d/dt = u' d/du, and K' goes to the right-hand side.
    yield "(10)", list((ten - nine + K.diff(u)) * speeds)
    printed = PRINTED["system"] | PRINTED["11"]
    p = {name: value.xreplace({D: printed["D"]}) for name, value in printed.items()}
    # v' from the third of (4), in which c23 = 0.
    speeds = sp.Matrix([(cos(u) * n - w3) / (PRINTED["5"]["tau"] * sin(u)), n])
    along = {u: 1, n: p["a1"] * n + p["a2"] * w3, w3: p["b1"] * n + p["b2"] * w3}
    yield "a1, a2, b1, b2", list(K * rate(speeds, along) - ten * speeds)
    d1, d2 = eliminated(((p["b2"], p["b1"]), (p["a2"], p["a1"])), u)  # n is eliminated
    yield "(11)", [p["d1"] - d1, p["d2"] - d2]
    # The roots in place of m and a: their sum gives a, and their product is linear in 1/m.
    offset = -R * (A3 - A1) * (x1 + x2) / (2 * A3)
    mass = A1 * A3 / (R**2 * (A3 - A1) * x1 * x2 - A1 * R**2 - A3 * offset**2)
    place = InRoots(R / R1)
    one, two = place.second_order
    in_u = one * sin(u) ** 2 + cos(u) + p["d1"] * sin(u), two * sin(u) ** 2 - p["d2"]
    yield "(12)", [part.xreplace({x: cos(u), m: mass, a: offset}) for part in in_u]
    yield "(13)", [place.S - (sp.diff(one, x) / 2 + one**2 / 4 - two)]


def residuals() -> Iterator[tuple[str, list[Any]]]:
    """Expressions that vanish if the formulas are right: for each number in `PRINTED`, and for (12) and (13)."""
    return chain(_kinematics(), _dynamics(), _elimination())


def vanishes(expression: Any) -> bool:
    """True if an expression, rational in names and in sines and cosines of angles, is zero; decided in the engine's fields."""
    rational: dict[Any, Any] = {}
    for z in (u, v, theta, u1, v1):
        t = sp.Symbol(f"t_{z}")
        rational |= {sin(z): 2 * t / (1 + t**2), cos(z): (1 - t**2) / (1 + t**2)}
    return not read_input(sp.sympify(expression).xreplace(rational), var="t_u", limits=Limits(parameters=30)).S.num


def holds() -> dict[str, bool]:
    """The verdict on each group of formulas: True if the derivation confirms it for all values of the parameters."""
    return {name: all(map(vanishes, parts)) for name, parts in residuals()}


#: LaTeX names.
_TEX = {du: r"\dot{u}", dv: r"\dot{v}", dtheta: r"\dot{\theta}", du1: r"\dot{u}_{1}", dv1: r"\dot{v}_{1}"}
_TEX |= {V_u: r"\frac{dV}{du}", **{sp.Symbol(f"{c}{k}'"): f"{c}'_{{{k}}}" for c in "ab" for k in "12"}}  # those of (10)
for _name, _tex in (("u", "u"), ("u'", r"\dot{u}"), ("v'", r"\dot{v}"), ("n", "n")):
    _part = rf"\frac{{\partial\Theta}}{{\partial {_tex}}}"
    _TEX |= {sp.Symbol(f"Theta_{_name}"): _part, sp.Symbol(f"dTheta_{_name}/dt"): rf"\frac{{d}}{{dt}}{_part}"}


def second_order_equation(d1: sp.Expr, d2: sp.Expr, variable: sp.Symbol = x) -> Math:
    """omega_3'' + d1 omega_3' + d2 omega_3 = 0."""
    text, tex = f"omega_3''({variable})", r"\omega_{3}''"
    for coefficient, prime in ((d1, "'"), (d2, "")):
        if coefficient != 0:
            text += f" + ({coefficient})*omega_3{prime}({variable})"
            tex += rf" + \left({sp.latex(coefficient)}\right) \omega_{{3}}{prime}"
    return Math(f"{text} = 0", f"{tex} = 0")


def named(name: str, value: sp.Expr) -> Math:
    """name = value."""
    left, right = (sp.latex(side, symbol_names=_TEX) for side in (sp.Symbol(name), value))
    return Math(f"{name} = {value}", f"{left} = {right}")


def equations_of(place: Rolling) -> dict[str, Math]:
    """a1, a2, b1, b2, and the equations 11, 12 and 13 with the values of one ball, or in the roots."""
    *system, d1, d2 = (part.subs(x, cos(u)) for part in (*place.linear_system, *place.second_order))
    found = {name: named(name, part * sin(u)) for name, part in zip(("a1", "a2", "b1", "b2"), system, strict=True)}
    factor = rf"\left({sp.latex(place.S)}\right)" if place.S.is_Add else sp.latex(place.S)
    normal_form = Math(f"y''(x) = ({place.S})*y(x)", f"y'' = {factor} y") if place.S else Math("y''(x) = 0", "y'' = 0")
    return {
        **found,
        "11": second_order_equation(-sin(u) * d1 - cos(u) / sin(u), sin(u) ** 2 * d2, u),
        "12": second_order_equation(*place.second_order),
        "13": normal_form,
    }


def explained(*, format: str = "text") -> str:
    """The equations (1) to (13) for all values of the parameters, as "text", "markdown", "latex" or "html".

    >>> explained().splitlines()[0]
    'A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre.'
    """
    in_roots = equations_of(InRoots(R / R1))
    body = "A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre."
    blocks: list[Block] = [say(body)]
    for key, step in PAPER_STEPS:
        rows = [*step.relations, *(named(name, value) for name, value in step.formulas.items())]
        if key in ("12", "13"):
            rows.append(in_roots[key])
        blocks += [Heading(step.title), Formula(Math.lines(rows))]
    return format_of(format).render(blocks)

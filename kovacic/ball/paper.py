"""Woronetz's equations for the ball on the sphere as the paper prints them, under the paper's own numbers (1) to (13).

The contact point is (x, y, z)(u, v) on the ball, in axes through its centre of mass, and (u1, v1) on the sphere; theta is
the angle between the u-line there and the v1-line.  E, F, G and L, M, N are the fundamental forms of the ball's surface, e_n
its outward normal.  `PRINTED` is what the paper prints, or, where that is general, what it says of the ball;
`kovacic.ball.derivation` derives each formula from the definitions.
P. Woronetz, Math. Ann. 70 (1911) 410-453; A. S. Kuleshov & D. V. Katasonova (2018).
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy import cos, sin

from kovacic.ball.body import A1, A3, InRoots, Rolling, U, X
from kovacic.writing.document import FORMATS, Block, Formula, Heading, say
from kovacic.writing.formula import Math

u = U
x = X
m, R, a, R1, D = sp.symbols("m R a R1 D")
v, theta, u1, v1, n, w3 = sp.symbols("v theta u1 v1 n omega_3")
du, dv, dtheta, du1, dv1, ddu, ddv, dn = sp.symbols("u' v' theta' u1' v1' u'' v'' n'")
w1, w2 = sp.symbols("omega_1 omega_2")
sigma, tau = sp.symbols("sigma tau")
#: The partial derivatives of the kinetic energy Theta, and dV/du.
T_u, T_du, T_dv, T_n, V_u = sp.symbols("Theta_u Theta_u' Theta_v' Theta_n V_u")

#: How names are written in LaTeX.
_TEX = {du: r"\dot{u}", dv: r"\dot{v}", dtheta: r"\dot{\theta}", du1: r"\dot{u}_{1}", dv1: r"\dot{v}_{1}"}
_TEX[V_u] = r"\frac{dV}{du}"
for _name, _tex in (("u", "u"), ("u'", r"\dot{u}"), ("v'", r"\dot{v}"), ("n", "n")):
    _part = rf"\frac{{\partial\Theta}}{{\partial {_tex}}}"
    _TEX |= {sp.Symbol(f"Theta_{_name}"): _part, sp.Symbol(f"dTheta_{_name}/dt"): rf"\frac{{d}}{{dt}}{_part}"}

# The surface of the ball, with r the radius vector from its centre of mass.
_k = 1 + R / R1
_rho = R / R1
_pull = R / (R + R1)
_eps = R + a * cos(u)
_turn = _k * _eps
_tilt = (A3 - A1) * R * cos(u) + A3 * a
_D = A1 * A3 + A1 * m * R**2 * sin(u) ** 2 + A3 * m * (R * cos(u) + a) ** 2
_coordinates = {"x": R * sin(u) * cos(v), "y": R * sin(u) * sin(v), "z": R * cos(u) + a}
_cosines = {
    "c11": cos(u) * cos(v),
    "c12": cos(u) * sin(v),
    "c13": -sin(u),
    "c21": -sin(v),
    "c22": cos(v),
    "c23": sp.Integer(0),
    "c31": sin(u) * cos(v),
    "c32": sin(u) * sin(v),
    "c33": cos(u),
}
_K11 = _k**2 * (A1 + m * (R**2 + a**2 + 2 * R * a * cos(u)))
_K22 = _k**2 * sin(u) ** 2 * (m * _eps**2 + A1 * cos(u) ** 2 + A3 * sin(u) ** 2)
_K23 = _k * sin(u) ** 2 * (m * a * _eps - (A3 - A1) * cos(u))
_K33 = (A1 + m * a**2) * sin(u) ** 2 + A3 * cos(u) ** 2
K11, K22, K23, K33 = sp.symbols("K11 K22 K23 K33")
#: The coefficients of (9), functions of u.
_nine = {
    "a1": -(1 - _rho**2) * sin(u) * K33 - _pull * sin(u) * K11 - m * R * sin(u) * _turn,
    "b1": -(1 - _rho**2) * sin(u) * K23,
    "a2": -_pull * K23 / sin(u) - m * R * a * sin(u),
    "b2": _pull * (sin(u) * K11 - K22 / sin(u)),
}
_a1, _b1, _a2, _b2 = sp.symbols("a1 b1 a2 b2")

#: For each of the paper's numbers (and "system", which has none) the formulas by name.  D is a name in "system" and (11).
PRINTED: dict[str, dict[str, sp.Expr]] = {
    "8": {**_coordinates, "E": R**2, "G": R**2 * sin(u) ** 2, "L": -R, "N": -R * sin(u) ** 2},
    "1": _cosines,
    "2": {
        "u1'": _rho * (-du * sin(theta) + dv * sin(u) * cos(theta)),
        "v1'": _rho * (du * cos(theta) + dv * sin(u) * sin(theta)) / sin(u1),
    },
    "4": {
        "omega_1": tau * dv * cos(u) * cos(v) - sigma * du * sin(v) + n * sin(u) * cos(v),
        "omega_2": tau * dv * cos(u) * sin(v) + sigma * du * cos(v) + n * sin(u) * sin(v),
        "omega_3": -tau * dv * sin(u) + n * cos(u),
    },
    "5": {"tau": _k * sin(u), "sigma": -_k, "n": -dtheta - cos(u) * dv - cos(u1) * dv1},
    "6": {"K11": _K11, "K22": _K22, "K23": _K23, "K33": _K33},
    "7": {
        "dTheta_u'/dt": T_u
        + (1 - _rho**2) * sin(u) * dv * T_n
        + _pull / sin(u) * n * T_dv
        + m * R * sin(u) * n * (a * n + _turn * dv)
        - V_u,
        "dTheta_v'/dt": -(1 - _rho**2) * sin(u) * du * T_n
        - _pull * sin(u) * n * T_du
        - m * R * sin(u) * n * _turn * du,
        "dTheta_n/dt": _pull * sin(u) * dv * T_du - _pull / sin(u) * du * T_dv - m * R * a * sin(u) * du * n,
    },
    "9": _nine,
    "10": {
        "a1'": _a1 - sp.diff(_K23, u),
        "b1'": _b1 - sp.diff(_K22, u),
        "a2'": _a2 - sp.diff(_K33, u),
        "b2'": _b2 - sp.diff(_K23, u),
    },
    "system": {
        "a1": -m * R**2 * _tilt * sin(u) / (R1 * D),
        "a2": (R1 + R) * ((A3 + m * R**2) * (A3 - A1) - A3 * m * a**2) * sin(u) / (R1 * D),
        "b1": m * R**3 * A1 * sin(u) / (R1 * D),
        "b2": m * R * (R1 + R) * _tilt * sin(u) / (R1 * D),
        "D": _D,
    },
    "11": {
        "d1": -(
            2 * m * R**2 * (A3 - A1) * sin(u) ** 2 * cos(u)
            + (3 - cos(u) ** 2) * m * R * a * A3
            + A3 * (A1 + m * R**2 + m * a**2) * cos(u)
        )
        / (D * sin(u)),
        "d2": m * R**2 * (R1**2 - R**2) * (A3 - A1) * sin(u) ** 2 / (R1**2 * D),
    },
}


def equation(d1: sp.Expr, d2: sp.Expr, variable: sp.Symbol = x) -> Math:
    """omega_3'' + d1 omega_3' + d2 omega_3 = 0."""
    text = f"omega_3''({variable})"
    tex = r"\omega_{3}''"
    for coefficient, prime in ((d1, "'"), (d2, "")):
        if coefficient != 0:
            text += f" + ({coefficient})*omega_3{prime}({variable})"
            tex += rf" + \left({sp.latex(coefficient)}\right) \omega_{{3}}{prime}"
    return Math(f"{text} = 0", f"{tex} = 0")


def named(name: str, value: sp.Expr) -> Math:
    """name = value."""
    if name.endswith("'") and name[0] in "ab":  # the coefficients of (10)
        left = f"{name[0]}'_{{{name[1]}}}"
    else:
        left = sp.latex(sp.Symbol(name), symbol_names=_TEX)
    return Math(f"{name} = {value}", f"{left} = {sp.latex(value, symbol_names=_TEX)}")


def equations_of(place: Rolling) -> dict[str, Math]:
    """a1, a2, b1, b2, and the equations 11, 12 and 13 with the values of one ball, or in the roots."""
    d1, d2 = place.second_order
    S = place.S
    in_u = [part.subs(x, cos(u)) for part in (*place.linear_system, d1, d2)]
    found = {name: named(name, part * sin(u)) for name, part in zip(("a1", "a2", "b1", "b2"), in_u, strict=False)}
    return {
        **found,
        "11": equation(-sin(u) * in_u[4] - cos(u) / sin(u), sin(u) ** 2 * in_u[5], u),
        "12": equation(d1, d2),
        "13": _normal_form(S),
    }


def _normal_form(S: sp.Expr) -> Math:
    """Equation 13."""
    if S == 0:
        return Math("y''(x) = 0", "y'' = 0")
    factor = rf"\left({sp.latex(S)}\right)" if S.is_Add else sp.latex(S)
    return Math(f"y''(x) = ({S})*y(x)", f"y'' = {factor} y")


@dataclass(frozen=True)
class DerivationStep:
    """One step of the derivation: its title, the paper's general relations, and the key of the ball's formulas in `PRINTED`."""

    title: str
    relations: tuple[Math, ...]
    key: str | None = None

    def rows(self) -> list[Math]:
        """The relations, then the ball's formulas."""
        printed = {} if self.key is None else PRINTED[self.key]
        return [*self.relations, *(named(name, value) for name, value in printed.items())]


def _steps() -> tuple[DerivationStep, ...]:
    """The paper's steps in the order in which one needs the next; (8) is its surface, so it comes first."""
    in_roots = equations_of(InRoots(R / R1))
    return (
        DerivationStep(
            "(8) The surface of the ball, r = (x, y, z) from its centre of mass; its fundamental forms, F = M = 0",
            (
                Math(
                    "x = f(u) cos(v), y = f(u) sin(v), z = g(u)",
                    r"x = f(u)\cos v, \quad y = f(u)\sin v, \quad z = g(u)",
                ),
            ),
            "8",
        ),
        DerivationStep(
            "(1) The frames at the contact point, on the ball and on the sphere; c_ij are the direction cosines of the first",
            (
                Math(
                    "e_u = (dr/du)/sqrt(E), e_v = (dr/dv)/sqrt(G), e_n = e_u x e_v",
                    r"\mathbf{e}_{u} = \frac{1}{\sqrt{E}}\frac{\partial\mathbf{r}}{\partial u}, \quad "
                    r"\mathbf{e}_{v} = \frac{1}{\sqrt{G}}\frac{\partial\mathbf{r}}{\partial v}, \quad "
                    r"\mathbf{e}_{n} = \mathbf{e}_{u}\times\mathbf{e}_{v}",
                ),
                Math(
                    "e_u1 = (dr1/du1)/R1, e_v1 = (dr1/dv1)/(R1 sin(u1)), e_n1 = e_u1 x e_v1",
                    r"\mathbf{e}_{u_{1}} = \frac{1}{R_{1}}\frac{\partial\mathbf{r}_{1}}{\partial u_{1}}, \quad "
                    r"\mathbf{e}_{v_{1}} = \frac{1}{R_{1}\sin u_{1}}\frac{\partial\mathbf{r}_{1}}{\partial v_{1}}, \quad "
                    r"\mathbf{e}_{n_{1}} = \mathbf{e}_{u_{1}}\times\mathbf{e}_{v_{1}}",
                ),
                Math(
                    "r1 = R1 (sin(u1) cos(v1), sin(u1) sin(v1), cos(u1))",
                    r"\mathbf{r}_{1} = R_{1}(\sin u_{1}\cos v_{1}, \sin u_{1}\sin v_{1}, \cos u_{1})",
                ),
                Math(
                    "e_u = -sin(theta) e_u1 + cos(theta) e_v1, e_n = -e_n1",
                    r"\mathbf{e}_{u} = -\sin\theta\,\mathbf{e}_{u_{1}} + \cos\theta\,\mathbf{e}_{v_{1}}, \quad "
                    r"\mathbf{e}_{n} = -\mathbf{e}_{n_{1}}",
                ),
            ),
            "1",
        ),
        DerivationStep(
            "(2) Rolling without slipping",
            (
                Math(
                    "R1 u1' = -sqrt(E) u' sin(theta) + sqrt(G) v' cos(theta)",
                    r"R_{1}\dot{u}_{1} = -\sqrt{E}\,\dot{u}\sin\theta + \sqrt{G}\,\dot{v}\cos\theta",
                ),
                Math(
                    "R1 v1' sin(u1) = sqrt(E) u' cos(theta) + sqrt(G) v' sin(theta)",
                    r"R_{1}\dot{v}_{1}\sin u_{1} = \sqrt{E}\,\dot{u}\cos\theta + \sqrt{G}\,\dot{v}\sin\theta",
                ),
            ),
            "2",
        ),
        DerivationStep(
            "(3) The contact point is at rest, w being the velocity of the centre of mass",
            (
                Math(
                    "w1 + omega_2 z - omega_3 y = 0, w2 + omega_3 x - omega_1 z = 0, w3 + omega_1 y - omega_2 x = 0",
                    r"w_{1} + \omega_{2}z - \omega_{3}y = 0, \quad w_{2} + \omega_{3}x - \omega_{1}z = 0, \quad "
                    r"w_{3} + \omega_{1}y - \omega_{2}x = 0",
                ),
            ),
        ),
        DerivationStep(
            "(4) The angular velocity in the axes of the ball",
            (
                Math(
                    "omega_i = c1i tau v' + c2i sigma u' + c3i n, i = 1, 2, 3",
                    r"\omega_{i} = c_{1i}\tau\dot{v} + c_{2i}\sigma\dot{u} + c_{3i}n, \quad i = 1, 2, 3",
                ),
            ),
            "4",
        ),
        DerivationStep(
            "(5) tau, sigma and n",
            (
                Math(
                    "tau = -(N/G - 1/R1) sqrt(G), sigma = (L/E - 1/R1) sqrt(E)",
                    r"\tau = -\left(\frac{N}{G} - \frac{1}{R_{1}}\right)\sqrt{G}, \quad "
                    r"\sigma = \left(\frac{L}{E} - \frac{1}{R_{1}}\right)\sqrt{E}",
                ),
                Math(
                    "n = -theta' + (u' dE/dv - v' dG/du)/(2 sqrt(E G)) - v1' cos(u1)",
                    r"n = -\dot{\theta} + \frac{1}{2\sqrt{EG}}\left(\frac{\partial E}{\partial v}\dot{u} - "
                    r"\frac{\partial G}{\partial u}\dot{v}\right) - \dot{v}_{1}\cos u_{1}",
                ),
            ),
            "5",
        ),
        DerivationStep(
            "(6) The kinetic energy, K12 = K13 = 0",
            (
                Math(
                    "2 Theta = K33 n^2 + 2 K23 v' n + K11 u'^2 + K22 v'^2",
                    r"2\Theta = K_{33}n^{2} + 2K_{23}\dot{v}n + K_{11}\dot{u}^{2} + K_{22}\dot{v}^{2}",
                ),
            ),
            "6",
        ),
        DerivationStep(
            "(7) The equations of motion",
            (Math("Theta + V(u) = const; Theta_z is dTheta/dz, V_u is dV/du", r"\Theta + V(u) = \mathrm{const}"),),
            "7",
        ),
        DerivationStep(
            "(9) The last two, linear in n and v'",
            (
                Math(
                    "d(K23 n + K22 v')/dt = (a1 n + b1 v') u', d(K33 n + K23 v')/dt = (a2 n + b2 v') u'",
                    r"\frac{d}{dt}(K_{23}n + K_{22}\dot{v}) = (a_{1}n + b_{1}\dot{v})\dot{u}, \quad "
                    r"\frac{d}{dt}(K_{33}n + K_{23}\dot{v}) = (a_{2}n + b_{2}\dot{v})\dot{u}",
                ),
            ),
            "9",
        ),
        DerivationStep(
            "(10) The same with u in place of t",
            (
                Math(
                    "K23 dn/du + K22 dv'/du = a1' n + b1' v', K33 dn/du + K23 dv'/du = a2' n + b2' v'",
                    r"K_{23}\frac{dn}{du} + K_{22}\frac{d\dot{v}}{du} = a'_{1}n + b'_{1}\dot{v}, \quad "
                    r"K_{33}\frac{dn}{du} + K_{23}\frac{d\dot{v}}{du} = a'_{2}n + b'_{2}\dot{v}",
                ),
            ),
            "10",
        ),
        DerivationStep(
            "The same in n and omega_3, with other a1, ..., b2 than in (9)",
            (
                Math(
                    "omega_3 = cos(u) n - tau sin(u) v', dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3",
                    r"\omega_{3} = n\cos u - \tau\dot{v}\sin u, \quad \frac{dn}{du} = a_{1}n + a_{2}\omega_{3}, "
                    r"\quad \frac{d\omega_{3}}{du} = b_{1}n + b_{2}\omega_{3}",
                ),
            ),
            "system",
        ),
        DerivationStep(
            "(11) Without n",
            (
                Math(
                    "d^2 omega_3/du^2 + d1 d omega_3/du + d2 omega_3 = 0",
                    r"\frac{d^{2}\omega_{3}}{du^{2}} + d_{1}\frac{d\omega_{3}}{du} + d_{2}\omega_{3} = 0",
                ),
            ),
            "11",
        ),
        DerivationStep("(12) In the roots x1, x2 of D(x), with x = cos u", (in_roots["12"],)),
        DerivationStep(
            "(13) The normal form",
            (Math("y = D(x)^(3/4) omega_3", r"y = D(x)^{3/4}\omega_{3}"), in_roots["13"]),
        ),
    )


def explained(*, format: str = "text") -> str:
    """The equations (1) to (13) for all values of the parameters, as "text", "markdown", "latex" or "html".

    >>> explained().splitlines()[0]
    'A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre.'
    """
    blocks: list[Block] = [
        say("A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre.")
    ]
    for step in _steps():
        rows = step.rows()
        text = "\n".join(row.text for row in rows)
        lines = r" \\ \displaystyle ".join(row.latex for row in rows)
        array = rf"\begin{{array}}{{l}} \displaystyle {lines} \end{{array}}"
        blocks += [Heading(step.title), Formula(Math(text, array))]
    return FORMATS[format].render(blocks)

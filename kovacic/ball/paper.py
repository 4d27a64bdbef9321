"""Woronetz's equations (1) to (13) as text and LaTeX: step by step for all balls, and with the values of one of them."""

from __future__ import annotations

import re

import sympy as sp
from sympy import cos, sin

from kovacic.ball.body import InRoots, Rolling
from kovacic.ball.derivation import PRINTED, R1, R, V_u, dtheta, du, du1, dv, dv1, u, x
from kovacic.writing.document import Block, Formula, Heading, format_of, say
from kovacic.writing.formula import Math

#: How names are written in LaTeX.
_TEX = {du: r"\dot{u}", dv: r"\dot{v}", dtheta: r"\dot{\theta}", du1: r"\dot{u}_{1}", dv1: r"\dot{v}_{1}"}
_TEX[V_u] = r"\frac{dV}{du}"
for _name, _tex in (("u", "u"), ("u'", r"\dot{u}"), ("v'", r"\dot{v}"), ("n", "n")):
    _part = rf"\frac{{\partial\Theta}}{{\partial {_tex}}}"
    _TEX |= {sp.Symbol(f"Theta_{_name}"): _part, sp.Symbol(f"dTheta_{_name}/dt"): rf"\frac{{d}}{{dt}}{_part}"}


#: The paper's steps in the order in which one needs the next; (8) is its surface, so it comes first.  Before a title stands the
#: key of the ball's formulas in `PRINTED`, below it each of the paper's general relations as text and as LaTeX; a line that is
#: indented twice continues the one above.
_PAPER_STEPS = r"""
8 | (8) The surface of the ball, r = (x, y, z) from its centre of mass; its fundamental forms, F = M = 0
  x = f(u) cos(v), y = f(u) sin(v), z = g(u)
  x = f(u)\cos v, \quad y = f(u)\sin v, \quad z = g(u)
1 | (1) The frames at the contact point, on the ball and on the sphere; c_ij are the direction cosines of the first
  e_u = (dr/du)/sqrt(E), e_v = (dr/dv)/sqrt(G), e_n = e_u x e_v
  \mathbf{e}_{u} = \frac{1}{\sqrt{E}}\frac{\partial\mathbf{r}}{\partial u}, \quad
      \mathbf{e}_{v} = \frac{1}{\sqrt{G}}\frac{\partial\mathbf{r}}{\partial v}, \quad
      \mathbf{e}_{n} = \mathbf{e}_{u}\times\mathbf{e}_{v}
  e_u1 = (dr1/du1)/R1, e_v1 = (dr1/dv1)/(R1 sin(u1)), e_n1 = e_u1 x e_v1
  \mathbf{e}_{u_{1}} = \frac{1}{R_{1}}\frac{\partial\mathbf{r}_{1}}{\partial u_{1}}, \quad
      \mathbf{e}_{v_{1}} = \frac{1}{R_{1}\sin u_{1}}\frac{\partial\mathbf{r}_{1}}{\partial v_{1}}, \quad
      \mathbf{e}_{n_{1}} = \mathbf{e}_{u_{1}}\times\mathbf{e}_{v_{1}}
  r1 = R1 (sin(u1) cos(v1), sin(u1) sin(v1), cos(u1))
  \mathbf{r}_{1} = R_{1}(\sin u_{1}\cos v_{1}, \sin u_{1}\sin v_{1}, \cos u_{1})
  e_u = -sin(theta) e_u1 + cos(theta) e_v1, e_n = -e_n1
  \mathbf{e}_{u} = -\sin\theta\,\mathbf{e}_{u_{1}} + \cos\theta\,\mathbf{e}_{v_{1}}, \quad
      \mathbf{e}_{n} = -\mathbf{e}_{n_{1}}
2 | (2) Rolling without slipping
  R1 u1' = -sqrt(E) u' sin(theta) + sqrt(G) v' cos(theta)
  R_{1}\dot{u}_{1} = -\sqrt{E}\,\dot{u}\sin\theta + \sqrt{G}\,\dot{v}\cos\theta
  R1 v1' sin(u1) = sqrt(E) u' cos(theta) + sqrt(G) v' sin(theta)
  R_{1}\dot{v}_{1}\sin u_{1} = \sqrt{E}\,\dot{u}\cos\theta + \sqrt{G}\,\dot{v}\sin\theta
| (3) The contact point is at rest, w being the velocity of the centre of mass
  w1 + omega_2 z - omega_3 y = 0, w2 + omega_3 x - omega_1 z = 0, w3 + omega_1 y - omega_2 x = 0
  w_{1} + \omega_{2}z - \omega_{3}y = 0, \quad w_{2} + \omega_{3}x - \omega_{1}z = 0, \quad
      w_{3} + \omega_{1}y - \omega_{2}x = 0
4 | (4) The angular velocity in the axes of the ball
  omega_i = c1i tau v' + c2i sigma u' + c3i n, i = 1, 2, 3
  \omega_{i} = c_{1i}\tau\dot{v} + c_{2i}\sigma\dot{u} + c_{3i}n, \quad i = 1, 2, 3
5 | (5) tau, sigma and n
  tau = -(N/G - 1/R1) sqrt(G), sigma = (L/E - 1/R1) sqrt(E)
  \tau = -\left(\frac{N}{G} - \frac{1}{R_{1}}\right)\sqrt{G}, \quad
      \sigma = \left(\frac{L}{E} - \frac{1}{R_{1}}\right)\sqrt{E}
  n = -theta' + (u' dE/dv - v' dG/du)/(2 sqrt(E G)) - v1' cos(u1)
  n = -\dot{\theta} + \frac{1}{2\sqrt{EG}}\left(\frac{\partial E}{\partial v}\dot{u} - \frac{\partial G}{\partial
      u}\dot{v}\right) - \dot{v}_{1}\cos u_{1}
6 | (6) The kinetic energy, K12 = K13 = 0
  2 Theta = K33 n^2 + 2 K23 v' n + K11 u'^2 + K22 v'^2
  2\Theta = K_{33}n^{2} + 2K_{23}\dot{v}n + K_{11}\dot{u}^{2} + K_{22}\dot{v}^{2}
7 | (7) The equations of motion
  Theta + V(u) = const; Theta_z is dTheta/dz, V_u is dV/du
  \Theta + V(u) = \mathrm{const}
9 | (9) The last two, linear in n and v'
  d(K23 n + K22 v')/dt = (a1 n + b1 v') u', d(K33 n + K23 v')/dt = (a2 n + b2 v') u'
  \frac{d}{dt}(K_{23}n + K_{22}\dot{v}) = (a_{1}n + b_{1}\dot{v})\dot{u}, \quad
      \frac{d}{dt}(K_{33}n + K_{23}\dot{v}) = (a_{2}n + b_{2}\dot{v})\dot{u}
10 | (10) The same with u in place of t
  K23 dn/du + K22 dv'/du = a1' n + b1' v', K33 dn/du + K23 dv'/du = a2' n + b2' v'
  K_{23}\frac{dn}{du} + K_{22}\frac{d\dot{v}}{du} = a'_{1}n + b'_{1}\dot{v}, \quad
      K_{33}\frac{dn}{du} + K_{23}\frac{d\dot{v}}{du} = a'_{2}n + b'_{2}\dot{v}
system | The same in n and omega_3, with other a1, ..., b2 than in (9)
  omega_3 = cos(u) n - tau sin(u) v', dn/du = a1 n + a2 omega_3, d omega_3/du = b1 n + b2 omega_3
  \omega_{3} = n\cos u - \tau\dot{v}\sin u, \quad \frac{dn}{du} = a_{1}n + a_{2}\omega_{3}, \quad
      \frac{d\omega_{3}}{du} = b_{1}n + b_{2}\omega_{3}
11 | (11) Without n
  d^2 omega_3/du^2 + d1 d omega_3/du + d2 omega_3 = 0
  \frac{d^{2}\omega_{3}}{du^{2}} + d_{1}\frac{d\omega_{3}}{du} + d_{2}\omega_{3} = 0
| (12) In the roots x1, x2 of D(x), with x = cos u
| (13) The normal form
  y = D(x)^(3/4) omega_3
  y = D(x)^{3/4}\omega_{3}
"""


def second_order_equation(d1: sp.Expr, d2: sp.Expr, variable: sp.Symbol = x) -> Math:
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
    normal_form = Math("y''(x) = 0", "y'' = 0")
    if S != 0:
        factor = rf"\left({sp.latex(S)}\right)" if S.is_Add else sp.latex(S)
        normal_form = Math(f"y''(x) = ({S})*y(x)", f"y'' = {factor} y")
    return {
        **found,
        "11": second_order_equation(-sin(u) * in_u[4] - cos(u) / sin(u), sin(u) ** 2 * in_u[5], u),
        "12": second_order_equation(d1, d2),
        "13": normal_form,
    }


def explained(*, format: str = "text") -> str:
    """The equations (1) to (13) for all values of the parameters, as "text", "markdown", "latex" or "html".

    >>> explained().splitlines()[0]
    'A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre.'
    """
    in_roots = equations_of(InRoots(R / R1))
    blocks: list[Block] = [
        say("A ball of radius R rolls on a sphere of radius R1, its centre of mass at the distance a from its centre.")
    ]
    for step in re.split(r"\n(?! )", _PAPER_STEPS.strip()):
        heading, *lines = step.replace("\n      ", " ").splitlines()
        key, _, title = heading.partition("| ")
        relations = [Math(text.strip(), latex.strip()) for text, latex in zip(lines[::2], lines[1::2], strict=True)]
        printed = [named(name, value) for name, value in PRINTED.get(key.strip(), {}).items()]
        rows = [*relations, *printed, *(in_roots[number] for number in ("12", "13") if title.startswith(f"({number})"))]
        array = r" \\ \displaystyle ".join(row.latex for row in rows)
        formula = Math(
            "\n".join(row.text for row in rows), rf"\begin{{array}}{{l}} \displaystyle {array} \end{{array}}"
        )
        blocks += [Heading(title), Formula(formula)]
    return format_of(format).render(blocks)

"""Woronetz's equations (1) to (13) as text and LaTeX: step by step for all balls, and with the values of one of them."""

from __future__ import annotations

import sympy as sp
from sympy import cos, sin

from kovacic.ball.body import InRoots, Rolling
from kovacic.ball.derivation import R1, STEPS, R, V_u, dtheta, du, du1, dv, dv1, u, x
from kovacic.writing.document import Block, Formula, Heading, format_of, say
from kovacic.writing.formula import Math

#: How names are written in LaTeX.
_TEX = {du: r"\dot{u}", dv: r"\dot{v}", dtheta: r"\dot{\theta}", du1: r"\dot{u}_{1}", dv1: r"\dot{v}_{1}"}
_TEX |= {V_u: r"\frac{dV}{du}", **{sp.Symbol(f"{c}{k}'"): f"{c}'_{{{k}}}" for c in "ab" for k in "12"}}  # those of (10)
for _name, _tex in (("u", "u"), ("u'", r"\dot{u}"), ("v'", r"\dot{v}"), ("n", "n")):
    _part = rf"\frac{{\partial\Theta}}{{\partial {_tex}}}"
    _TEX |= {sp.Symbol(f"Theta_{_name}"): _part, sp.Symbol(f"dTheta_{_name}/dt"): rf"\frac{{d}}{{dt}}{_part}"}


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
    for key, step in STEPS:
        rows = [*step.relations, *(named(name, value) for name, value in step.formulas.items())]
        if key in ("12", "13"):
            rows.append(in_roots[key])
        array = r" \\ \displaystyle ".join(row.latex for row in rows)
        formula = Math(
            "\n".join(row.text for row in rows), rf"\begin{{array}}{{l}} \displaystyle {array} \end{{array}}"
        )
        blocks += [Heading(step.title), Formula(formula)]
    return format_of(format).render(blocks)

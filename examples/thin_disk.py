"""The thin disk on a plane: Appell's and Korteweg's Legendre equation, derived, and for which moments it is solved.

    python examples/thin_disk.py

P. Appell, Rend. Circ. Mat. Palermo 14 (1900) 1-6; D. J. Korteweg, same volume, 7-8.
"""

from __future__ import annotations

import sys

import sympy as sp

import kovacic
from kovacic.ball import Body, Profile, U, X


def main() -> int:
    m, R, A1, A3 = sp.symbols("m R A1 A3")
    disk = Body(Profile(R, sp.Integer(0), edge=True), m, A1, A3, sp.oo)
    system = disk.linear_system()
    print("A thin disk of radius R rolls on a plane; u is the angle between its axis and the normal, x = cos u.")
    print(f"  n'       = ({system.a1}) n + ({system.a2}) omega_3")
    print(f"  omega_3' = ({system.b1}) n + ({system.b2}) omega_3")
    equation = system.second_order().rational_form()
    constant = sp.factor(-equation.d2 * (1 - X**2))
    legendre = sp.cancel(equation.d1 + 2 * X / (1 - X**2)) == 0 and not constant.has(X)
    print(f"(1 - x^2) omega_3'' - 2 x omega_3' - k omega_3 = 0,  k = {constant}: Legendre's equation: {legendre}")
    print("with nu (nu + 1) = -k, so nu = -1/2 +- sqrt(1/4 - k), and k > 0 for every body.\n")
    print(kovacic.conditions("-1/(1-x^2)^2 + k/(1-x^2)", var="x"), end="\n\n")
    print(
        "Legendre's exponent differences at 1, -1, infinity are 0, 0, 2 nu + 1.  By Kimura's theorem it has a Liouvillian"
    )
    print(
        "solution exactly if nu is an integer, as above; then nu (nu + 1) >= 0, while here it is -k < 0.  So no disk has one:"
    )
    bodies = [
        ("homogeneous disk, A3 = m R^2/2, A1 = A3/2", {m: 1, R: 1, A1: sp.Rational(1, 4), A3: sp.Rational(1, 2)}),
        ("hoop, A3 = m R^2, A1 = A3/2", {m: 1, R: 1, A1: sp.Rational(1, 2), A3: 1}),
        ("nu = -1/2: k = 1/4", {m: 1, R: 1, A1: 2, A3: 1}),
        ("nu = -2/3: k = 2/9", {m: 1, R: 1, A1: sp.Rational(9, 4), A3: 1}),
    ]
    good = legendre
    symbolic_S = equation.normal_form().factored()
    for label, values in bodies:
        numeric = Body(
            Profile(values[R] * sp.Integer(1), sp.Integer(0), edge=True),
            *(sp.sympify(values[k]) for k in (m, A1, A3)),
            sp.oo,
        )
        S = numeric.linear_system().second_order().rational_form().normal_form().expression()
        good = good and sp.cancel(S - symbolic_S.subs(values)) == 0
        answer = kovacic.solve(S)
        good = good and answer.case is None and answer.verified
        print(f"  {label:<44} k = {constant.subs(values)!s:<5} case {answer.case}, proven: {answer.verified}")
    print("\nFor comparison k = -2, which no body has (nu = 1), is solved:")
    S = sp.cancel(-1 / (1 - X**2) ** 2 - 2 / (1 - X**2))
    answer = kovacic.solve(S)
    good = good and answer.case == 1
    print(f"  case {answer.case}, omega = {answer.omega}")
    torus = Body(Profile(2 + sp.sin(U), sp.cos(U)), sp.Integer(1), sp.Integer(3), sp.Integer(4), sp.oo)
    S = torus.linear_system().second_order().rational_form(half_angle=True).normal_form().expression()
    answer = kovacic.solve(S)
    good = good and answer.verified
    print(f"\nA torus (f = 2 + sin u, g = cos u; m = 1, A1 = 3, A3 = 4) on the plane, in tan(u/2): case {answer.case}")
    print("everything holds" if good else "SOMETHING FAILS")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

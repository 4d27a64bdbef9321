"""Theorems 1 and 2 on the ball that rolls on a sphere, by computation, with the data of their proofs.

    python examples/ball_on_sphere.py

Paper: A. S. Kuleshov and D. V. Katasonova, "Existence of Liouvillian solutions in the problem of motion of a rotationally
symmetric body on a sphere" (2018).
"""

from __future__ import annotations

import sys
import time
from fractions import Fraction

import sympy as sp

import kovacic
from kovacic.ball import Ball, closed_form
from kovacic.ball.decision import decide, group_of, normalised
from kovacic.ball.theorems import (
    constant_coefficients,
    double_root,
    exponents,
    printed_forms,
    rational_solutions,
    semi_invariant,
    spin_in_the_roots,
    symbolic_ball,
    two_exponentials,
)

GENERAL = "(1+8*r^2)/(8*(p-q)*(x-p)) - (1+8*r^2)/(8*(p-q)*(x-q)) - 3/16/(x-p)^2 - 3/16/(x-q)^2"


def main() -> int:
    started = time.perf_counter()
    print("The equations, derived from the profile f = R sin u, g = R cos u + a; every identity for all parameters.\n")
    sphere = symbolic_ball()
    proofs = [
        printed_forms(),
        constant_coefficients(sphere),
        semi_invariant(sphere),
        two_exponentials(),
        exponents(),
        double_root(),
        spin_in_the_roots(),
    ]
    for proof in proofs:
        print(proof.text(), end="\n\n")

    print("Theorem 1: omega is rational exactly if 2R/R1 = N is an integer (or x1 = x2, or A1 = A3).")
    print("  If: both solutions and both omega for N = 1..50 with symbolic x1, x2, in the Riccati equation:", end=" ")
    rational = all(rational_solutions(N).verified for N in range(1, 51))
    print("all verified" if rational else "FAILS")
    for N in (1, 2, 3, 4):
        first, second = rational_solutions(N).expressions()
        print(f"  N = {N}: omega_3 = c1 ({first}) + c2 ({second})")
    statement = kovacic.conditions(GENERAL, var="x")
    print("  Both directions, by the parametric engine, for (13) with symbolic p = x1, q = x2, r = R/R1:")
    print("    " + str(statement).partition("\n")[2].strip().replace("\n", "\n  "))
    samples = ({"p": 1, "q": 2, "r": "5/2"}, {"p": 1, "q": 2, "r": "1/3"})
    engine_0 = statement.complete is True and statement.generic.case == 2
    engine_0 = engine_0 and [statement.case_at({k: Fraction(v) for k, v in s.items()}) for s in samples] == [1, 2]
    print("  Only if, once more by hand: for other values y1/y2 = t^(2R/R1) isn't in C(t), and a branch point of")
    print("  sqrt(D) exchanges y1 and y2.")
    halves = [decide(normalised(sp.Rational(N, 2)), sp.Rational(N, 2)) for N in range(1, 51)]
    engine_1 = all(verdict.degree == 1 and verdict.verified for verdict in halves)
    degrees = sorted({verdict.degree for verdict in halves})
    print(f"  The engine, N = 1..50: omega of degree {degrees}, all verified: {engine_1}\n")

    print("Theorem 2: omega has degree 2 otherwise, and")
    print("  omega_3 = (c1 (sqrt(x-x1) + sqrt(x-x2))^(2R/R1) + c2 (...)^(-2R/R1)) / sqrt((x-x1)(x-x2))")
    ratios = [sp.Rational(p, q) for q in range(3, 8) for p in range(1, 2 * q) if (2 * sp.Rational(p, q)).q > 1]
    others = [decide(normalised(ratio), ratio) for ratio in ratios]
    engine_2 = all(verdict.degree == 2 and verdict.verified for verdict in others)
    print(f"  The engine, {len(ratios)} values of R/R1: omega of degree {sorted({v.degree for v in others})}, ", end="")
    print(f"all verified: {engine_2}\n")

    print("Groups, from the engine and from the theorem:")
    agree = True
    for label, ball, radius in _balls():
        place = ball.on_plane() if radius is None else ball.on_sphere(radius)
        group = kovacic.solve(place.S).group
        found, expected = None if group is None else group.name, group_of(place)
        agree = agree and found == expected
        print(
            f"  {label:<34} R/R1 = {place.ratio!s:<4} {found:<22} {'agrees' if found == expected else f'expected {expected}'}"
        )
    irrational = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(sp.sqrt(2))
    print(f"  {'two roots, irrational ratio':<34} R/R1 = sqrt(2)/2: {group_of(irrational)} (from the theorem)\n")

    example = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    print("One ball: m = R = 1, a = 1/5, A1 = 1/4, A3 = 1/3 on R1 = 3")
    print("  " + example.equation(12).text())
    print(f"  omega_3 = {closed_form(example).omega_3}")
    holds = all(proofs) and rational and engine_0 and engine_1 and engine_2 and agree
    print(f"\n{'Everything holds' if holds else 'SOMETHING FAILS'}; {time.perf_counter() - started:.2f} s")
    return 0 if holds else 1


def _balls() -> list[tuple[str, Ball, str | None]]:
    general = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3")
    linear = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/4")
    even = Ball(m=1, R=1, a=0, A1="2/5", A3="2/5")
    double = Ball(m=1, R=1, a="1/4", A1=sp.Rational(1, 3) - sp.Rational(1, 64), A3="1/3")
    return [
        ("two roots", general, "2"),
        ("two roots", general, "1"),
        ("two roots", general, "3"),
        ("two roots, quaternion group", general, "4"),
        ("two roots, inside the sphere", general, "-7"),
        ("two roots, on the plane", general, None),
        ("a double root", double, "3"),
        ("A1 = A3", linear, "3"),
        ("homogeneous", even, "3"),
    ]


if __name__ == "__main__":
    sys.exit(main())

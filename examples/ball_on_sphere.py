"""Theorems 1 and 2 on the ball that rolls on a sphere, by the engine, and the closed forms.

    python examples/ball_on_sphere.py

Paper: A. S. Kuleshov and D. V. Katasonova, "Existence of Liouvillian solutions in the problem of motion of a rotationally
symmetric body on a sphere" (2018).
"""

from __future__ import annotations

import sys
import time

import sympy as sp

import kovacic
from kovacic.ball import InRoots, RollingBall, closed_form
from kovacic.ball.derivation import R1, R, equations_of, explained, holds
from kovacic.ball.theorems import ball_theorem


def main() -> int:
    started = time.perf_counter()
    print("Woronetz's equations for the ball, all parameters symbolic:")
    print(explained())
    derived = holds()
    print(f"derived from the definitions: {derived}\n")

    statement = kovacic.conditions(InRoots(R / R1).S, var="x")
    print("Theorems 1 and 2, one call of kovacic.conditions on equation (13):")
    print(str(statement).partition("\n")[2], end="\n\n")
    reproduced = statement.complete is True and statement.generic.case == 2

    print("The closed forms in the roots x1, x2 of D:")
    good = True
    for ratio in (sp.Rational(1, 2), sp.Integer(1), sp.Rational(3, 2), sp.Symbol("k")):
        form = closed_form(InRoots(ratio))
        solves = form.solves(InRoots(ratio))
        good = good and solves
        print(f"  R/R1 = {ratio}: omega_3 = {form.omega_3}; by substitution: {solves}")

    print("\nBalls: the engine's case and group, and what the theorems say:")
    for label, ball, radius in _balls():
        place = ball.on_plane() if radius is None else ball.on_sphere(radius)
        answer, (said, case) = kovacic.solve(place.S), ball_theorem(place)
        form = closed_form(place)
        agrees = answer.case == case and form.solves(place)
        good = good and agrees
        print(f"  {label:<30} R/R1 = {place.ratio!s:<9} {answer.group.name:<22} {said}: {agrees}")

    example = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(3)
    print("\nOne ball: m = R = 1, a = 1/5, A1 = 1/4, A3 = 1/3 on R1 = 3")
    print(f"  {equations_of(example)['12'].text}\n  omega_3 = {closed_form(example).omega_3}")
    everything = good and reproduced and all(derived.values())
    print(f"\n{'Everything holds' if everything else 'SOMETHING FAILS'}; {time.perf_counter() - started:.2f} s")
    return 0 if everything else 1


def _balls() -> list[tuple[str, RollingBall, str | None]]:
    general = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3")
    linear = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/4")
    even = RollingBall(m=1, R=1, a=0, A1="2/5", A3="2/5")
    double = RollingBall(m=1, R=1, a="1/4", A1=sp.Rational(1, 3) - sp.Rational(1, 64), A3="1/3")
    return [
        ("two roots", general, "2"),
        ("two roots, R1 = R", general, "1"),
        ("two roots", general, "3"),
        ("two roots, quaternion group", general, "4"),
        ("two roots, inside the sphere", general, "-7"),
        ("two roots, irrational ratio", general, "sqrt(2)"),
        ("two roots, on the plane", general, None),
        ("a double root", double, "3"),
        ("A1 = A3", linear, "3"),
        ("homogeneous", even, "3"),
    ]


if __name__ == "__main__":
    sys.exit(main())

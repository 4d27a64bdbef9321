"""Bodies with irrational numbers for parameters: exact zero tests, and the engine's decision."""

from __future__ import annotations

import pytest
import sympy as sp
from build import parametrize

import kovacic
from kovacic import InputError, LimitExceeded
from kovacic.ball import RollingBall, closed_form

CUBIC = sp.CRootOf(sp.Symbol("z") ** 3 - sp.Symbol("z") - 1, 0)
# m, R, a, A1, A3, R1 (None: a plane), the group
BODIES = {
    "mass": ("sqrt(2)", 1, "1/5", "1/4", "1/3", 3, "dicyclic of order 12"),
    "ratio": (1, 1, "1/5", "1/4", "1/3", "sqrt(2)", "N(T)"),
    "inside": (1, 1, "1/5", "1/4", "1/3", "-2*sqrt(2)", "N(T)"),
    "plane": ("sqrt(2)", 1, "1/5", "1/4", "1/3", None, "G_a extended by mu_4"),
    "three roots": ("sqrt(2)", "sqrt(3)", "1/5", "sqrt(5)/4", "sqrt(5)/3", 3, "N(T)"),
    "cubic": (CUBIC, 1, "1/5", "1/4", "1/3", 3, "dicyclic of order 12"),
    "trigonometric": (2 * sp.cos(sp.pi / 7), 1, "1/5", "1/4", "1/3", 3, "dicyclic of order 12"),
}
# The same number in two ways: what makes a ball degenerate has to be seen through the way it is written.
DEGENERATE = {
    "A1 = A3": ((4, 1, "1/5", "sqrt(3-2*sqrt(2))", "sqrt(2)-1", 3, "mu_4"), "linear"),
    "homogeneous": (
        (4, 1, "sqrt(3-2*sqrt(2))-sqrt(2)+1", "sqrt(3-2*sqrt(2))", "sqrt(2)-1", 3, "trivial"),
        "homogeneous",
    ),
    "double root": ((1, 1, "1/sqrt(12)", "1/3-1/48", "1/3", "sqrt(2)", "G_m"), "double"),
    "rational ratio": (
        (1, "sqrt(5+2*sqrt(6))", 0, "1/4", "1/3", "3*sqrt(2)+3*sqrt(3)", "dicyclic of order 12"),
        "complex",
    ),
}


def rolling(values):
    *body, R1, group = values
    ball = RollingBall(**dict(zip(("m", "R", "a", "A1", "A3"), body, strict=True)))
    return ball.on_plane() if R1 is None else ball.on_sphere(R1), group


@parametrize(
    "values", [*BODIES.values(), *(v for v, _ in DEGENERATE.values())], ids=[*BODIES, *DEGENERATE], ordinary=0, long=3
)
def test_the_engine_agrees_with_the_theorem_and_the_closed_form_holds(values):
    sphere, group = rolling(values)
    answer = kovacic.solve(sphere.S)
    assert answer.verified
    assert (answer.case, answer.group.name) == (2 if group.startswith(("N", "dicyclic")) else 1, group)
    assert closed_form(sphere).solves(sphere)


@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_balls_are_recognised(name):
    values, kind = DEGENERATE[name]
    assert kind in rolling(values)[0].kind


def test_inequalities_are_decided_exactly():
    """A3 = 2 A1 is possible, 10^-70 more isn't."""
    body = {"m": 9, "R": 1, "a": 0, "A1": "sqrt(3-2*sqrt(2))/2"}
    assert RollingBall(**body, A3="sqrt(2)-1").A3 == sp.sqrt(2) - 1
    with pytest.raises(InputError, match="A3 <= 2 A1 fails"):
        RollingBall(**body, A3="sqrt(2)-1+1e-70")
    with pytest.raises(InputError, match="A1 > 0 fails"):
        RollingBall(**{**body, "A1": "sqrt(3-2*sqrt(2))-sqrt(2)+1"}, A3=1)
    with pytest.raises(InputError, match="doesn't fit"):
        RollingBall(m=1, R="sqrt(3+2*sqrt(2))", a=0, A1="1/4", A3="1/3").on_sphere("-1-sqrt(2)")


@pytest.mark.long
def test_a_transcendental_number_is_a_letter():
    sphere, _ = rolling(("pi", 1, "1/5", "1/4", "1/3", 3, None))
    assert sphere.S.has(sp.pi)
    assert closed_form(sphere).solves(sphere)
    assert kovacic.solve(sphere.S).case == 2


@pytest.mark.long
def test_signs_and_simplest_forms():
    root = sp.sqrt

    def mass(value):
        return RollingBall(m=value, R=1, a=0, A1="1/100", A3="1/100").m

    assert mass(root(3 + 2 * root(2)) / (1 + root(2))) == 1
    assert mass(root(5 + 2 * root(6))) == root(2) + root(3)
    assert mass(sp.Symbol("m") * root(2)) == sp.Symbol("m") * root(2)
    assert mass(sp.pi - 3) == sp.pi - 3
    for value in (root(2) - root(2 + sp.Rational(1, 10**80)), sp.cos(sp.pi / 8) - root(2 + root(2)) / 2):
        with pytest.raises(InputError, match="m > 0 fails"):
            mass(value)
    with pytest.raises(InputError, match="can't be decided"):
        mass(sp.pi**2 - sp.pi * sp.log(sp.exp(sp.pi) + sp.Rational(1, 10**90)))


def test_numbers_of_a_high_degree_are_refused():
    with pytest.raises(LimitExceeded, match="degree"):
        rolling(("sqrt(2)+sqrt(3)+sqrt(5)+sqrt(7)+sqrt(11)", 1, "1/5", "1/4", "1/3", 3, None))

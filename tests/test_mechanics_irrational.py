"""Bodies with irrational numbers for parameters: the same equations, exact zero tests, the engine's decision."""

from __future__ import annotations

import pytest
import sympy as sp

import kovacic
from kovacic.ball import Ball, Body, Profile, U, X
from kovacic.ball.decision import degree_of_omega, group_of
from kovacic.ball.field import Ring
from kovacic.ball.irrational import generators, settled, sign
from kovacic.ball.theorems import symbolic_ball
from kovacic.errors import InputError, LimitExceeded

CUBIC = sp.CRootOf(sp.Symbol("z") ** 3 - sp.Symbol("z") - 1, 0)
# m, R, a, A1, A3, R1 (None: a plane)
BODIES = {
    "mass": ("sqrt(2)", 1, "1/5", "1/4", "1/3", 3),
    "ratio": (1, 1, "1/5", "1/4", "1/3", "sqrt(2)"),
    "inside": (1, 1, "1/5", "1/4", "1/3", "-2*sqrt(2)"),
    "plane": ("sqrt(2)", 1, "1/5", "1/4", "1/3", None),
    "three roots": ("sqrt(2)", "sqrt(3)", "1/5", "sqrt(5)/4", "sqrt(5)/3", 3),
    "cubic": (CUBIC, 1, "1/5", "1/4", "1/3", 3),
    "trigonometric": (2 * sp.cos(sp.pi / 7), 1, "1/5", "1/4", "1/3", 3),
}
# The same number in two ways: what makes a ball degenerate has to be seen through the way it is written.
DEGENERATE = {
    "A1 = A3": ((4, 1, "1/5", "sqrt(3-2*sqrt(2))", "sqrt(2)-1", 3), "linear", "mu_4"),
    "homogeneous": (
        (4, 1, "sqrt(3-2*sqrt(2))-sqrt(2)+1", "sqrt(3-2*sqrt(2))", "sqrt(2)-1", 3),
        "homogeneous",
        "trivial",
    ),
    "double root": ((1, 1, "1/sqrt(12)", "1/3-1/48", "1/3", "sqrt(2)"), "double", "G_m"),
    "rational ratio": (
        (1, "sqrt(5+2*sqrt(6))", 0, "1/4", "1/3", "3*sqrt(2)+3*sqrt(3)"),
        "complex",
        "dicyclic of order 12",
    ),
}


def rolling(values):
    *body, R1 = values
    ball = Ball(**dict(zip(("m", "R", "a", "A1", "A3"), body, strict=True)))
    return ball.on_plane() if R1 is None else ball.on_sphere(R1)


@pytest.mark.parametrize("name", [name for name in BODIES if name != "plane"])
def test_the_equations_are_the_symbolic_ones_at_these_values(name):
    sphere, general = rolling(BODIES[name]), symbolic_ball()
    names = sp.symbols("m R a A1 A3 R1")
    values = dict(zip(names, (*sphere.ball.parameters, sphere.R1), strict=True))
    for number in (7, 11, 12, 13):
        for found, expected in zip(
            sphere.equation(number).coefficients, general.equation(number).coefficients, strict=True
        ):
            at = {X: sp.Rational(2, 7), U: sp.Rational(9, 7)}
            assert abs(sp.N((found - expected.subs(values)).subs(at), 30)) < 1e-25, number


@pytest.mark.parametrize("name", BODIES)
def test_the_engine_agrees_with_the_theorem(name):
    sphere = rolling(BODIES[name])
    answer = kovacic.solve(sphere.S)
    assert answer.verified
    assert (answer.case, answer.group.name) == (degree_of_omega(sphere), group_of(sphere))


@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_balls_are_recognised(name):
    values, kind, group = DEGENERATE[name]
    sphere = rolling(values)
    assert kind in sphere.kind
    assert group_of(sphere) == kovacic.solve(sphere.S).group.name == group


def test_inequalities_are_decided_exactly():
    """A3 = 2 A1 is possible, 10^-70 more isn't."""
    body = {"m": 9, "R": 1, "a": 0, "A1": "sqrt(3-2*sqrt(2))/2"}
    assert Ball(**body, A3="sqrt(2)-1").A3 == sp.sqrt(2) - 1
    with pytest.raises(InputError, match="A3 <= 2 A1 fails"):
        Ball(**body, A3="sqrt(2)-1+1e-70")
    with pytest.raises(InputError, match="A1 > 0 fails"):
        Ball(**{**body, "A1": "sqrt(3-2*sqrt(2))-sqrt(2)+1"}, A3=1)
    with pytest.raises(InputError, match="doesn't fit"):
        Ball(m=1, R="sqrt(3+2*sqrt(2))", a=0, A1="1/4", A3="1/3").on_sphere("-1-sqrt(2)")


def test_another_body():
    """A paraboloid of irrational mass on a plane: its equation is that of any mass, at this value."""
    profile, half, third = Profile(2 * sp.tan(U), sp.tan(U) ** 2), sp.Rational(1, 2), sp.Rational(1, 3)
    m = sp.Symbol("m")
    found, general = (
        Body(profile, mass, half, third, sp.oo).linear_system().second_order().rational_form()
        for mass in (sp.sqrt(2), m)
    )
    for left, right in ((found.d1, general.d1), (found.d2, general.d2)):
        assert abs(sp.N((left - right.subs(m, sp.sqrt(2))).subs(X, sp.Rational(1, 3)), 30)) < 1e-25


def test_a_number_that_is_not_algebraic_has_equations_but_no_decision():
    sphere = rolling(("pi", 1, "1/5", "1/4", "1/3", 3))
    assert sphere.equation(12).coefficients[0].has(sp.pi)
    assert group_of(sphere) == "dicyclic of order 12"
    with pytest.raises(InputError, match="algebraic"):
        kovacic.solve(sphere.S)


def test_signs_and_simplest_forms():
    root = sp.sqrt
    assert settled(root(3 + 2 * root(2)) / (1 + root(2))) == 1
    assert settled(root(5 + 2 * root(6))) == root(2) + root(3)
    assert settled(sp.Symbol("m") * root(2)) == sp.Symbol("m") * root(2)
    assert sign(root(2) - root(2 + sp.Rational(1, 10**80))) == -1
    assert sign(sp.cos(sp.pi / 8) - root(2 + root(2)) / 2) == 0
    assert sign(sp.pi - 3) == 1
    third = sp.Rational(1, 3)
    assert set(generators([root(6) * sp.Symbol("m"), 2**third + sp.pi])) == {sp.pi, 2**third, root(6)}


def test_numbers_of_a_high_degree_are_refused():
    with pytest.raises(LimitExceeded, match="degree 32"):
        rolling(("sqrt(2)+sqrt(3)+sqrt(5)+sqrt(7)+sqrt(11)", 1, "1/5", "1/4", "1/3", 3))


def test_dependent_constants_cancel():
    """sqrt(6) is another generator than sqrt(2) and sqrt(3), and yet the product of the two."""
    root = sp.sqrt
    ring = Ring(("m", "x"), generators([root(2), root(3), root(6)]))
    product = ring.element(root(2) * sp.Symbol("m")) * ring.element(root(3) / sp.Symbol("x"))
    assert product == ring.element(root(6) * sp.Symbol("m") / sp.Symbol("x"))
    assert product - 1 != product
    assert not product - ring.element(root(6) * sp.Symbol("m") / sp.Symbol("x"))
    with pytest.raises(ZeroDivisionError):
        (ring.element(root(2)) * ring.element(root(3)) - ring.element(root(6))).inverse()

"""Bodies beyond the ball: derived equations with numeric parameters, decided by the engine."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sp

import kovacic
from kovacic.ball import Body, Profile, U

HALF, THIRD = sp.Rational(1, 2), sp.Rational(1, 3)
BODIES = {
    "paraboloid": (Profile(2 * sp.tan(U), sp.tan(U) ** 2), False),
    "ellipsoid": (Profile(2 * sp.sin(U), sp.cos(U)), False),
    "torus": (Profile(2 + sp.sin(U), sp.cos(U)), True),
}


@pytest.mark.parametrize("name", BODIES)
def test_on_a_plane_there_is_no_closed_form_and_it_is_proven(name: str) -> None:
    profile, half_angle = BODIES[name]
    equation = Body(profile, sp.Integer(1), HALF, THIRD, sp.oo).linear_system().second_order()
    S = equation.rational_form(half_angle=half_angle).normal_form().expression()
    answer = kovacic.solve(S)
    assert answer.status is kovacic.Status.NONE_EXISTS
    assert answer.verified


def test_paraboloid_on_a_sphere() -> None:
    equation = Body(BODIES["paraboloid"][0], sp.Integer(1), HALF, THIRD, sp.Integer(5)).linear_system().second_order()
    answer = kovacic.solve(equation.rational_form().normal_form().expression())
    assert answer.status is kovacic.Status.NONE_EXISTS
    assert answer.verified


def test_a_profile_without_a_rational_form_is_refused_with_the_reason() -> None:
    equation = Body(BODIES["ellipsoid"][0], sp.Integer(1), HALF, THIRD, sp.Integer(5)).linear_system().second_order()
    with pytest.raises(kovacic.InputError, match="square root"):
        equation.rational_form()


def test_thin_disk_on_a_plane_with_all_parameters_symbolic() -> None:
    """k = A3 m R^2/(A1 (A3 + m R^2)) > 0 for every body, and the solvable values of k aren't positive."""
    m, R, A1, A3 = sp.symbols("m R A1 A3")
    equation = Body(Profile(R, sp.Integer(0), edge=True), m, A1, A3, sp.oo).linear_system().second_order()
    statement = kovacic.conditions(equation.rational_form().normal_form().factored(), var="x")
    assert statement.complete is True
    assert statement.generic.case is None
    hoop = {"m": 1, "R": 1, "A1": Fraction(1, 2), "A3": 1}
    assert statement.case_at(hoop) is None
    assert statement.case_at({**hoop, "A1": Fraction(-1, 4)}) == 1  # k = -2, no body: Legendre's equation with nu = 1


def test_torus_on_a_plane_with_a_symbolic_moment() -> None:
    """No moment A3 > 0 has a closed form: proven for all of them at once."""
    A3 = sp.Symbol("A3")
    equation = Body(BODIES["torus"][0], sp.Integer(1), sp.Integer(3), A3, sp.oo).linear_system().second_order()
    statement = kovacic.conditions(equation.rational_form(half_angle=True).normal_form().factored(), var="x")
    assert statement.complete is True
    assert statement.generic.case is None
    for value in (Fraction(1, 2), 4, 6):
        assert statement.case_at({"A3": value}) is None


@pytest.mark.parametrize("value", ["__import__('os').getcwd()", "1", None, [1]])
def test_text_and_other_objects_never_become_expressions_of_a_body(value: object) -> None:
    """Nothing that isn't an expression is interpreted: SymPy would execute text."""
    with pytest.raises(kovacic.InputError, match="can't be"):
        Body(Profile(sp.Symbol("R"), sp.Integer(0), edge=True), value, 1, 1, sp.oo)  # type: ignore[arg-type]
    with pytest.raises(kovacic.InputError, match="can't be"):
        Profile(value, sp.Integer(0))  # type: ignore[arg-type]

"""Bodies beyond the ball: derived equations with numeric parameters, decided by the engine."""

from __future__ import annotations

import pytest
import sympy as sp

import kovacic
from kovacic.mechanics import Body, Profile, U

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

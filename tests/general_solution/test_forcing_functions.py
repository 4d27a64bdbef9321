"""A right-hand side with a function that isn't known: the formula of variation of parameters holds for any."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize, size
from sympy import cos, exp, sin

import kovacic

x, k = sympy.Symbol("x"), sympy.Symbol("k", positive=True)
y, g = sympy.Function("y"), sympy.Function("g")
D2, D1, D0 = y(x).diff(x, 2), y(x).diff(x), y(x)

PROBLEMS = [D2 + k**2 * D0 - g(x), D2 - 2 * D1 + D0 - exp(x) * g(x), x**2 * D2 + x * D1 - D0 - x * g(x) - x**3]


@parametrize("equation", PROBLEMS, ordinary=0, long=2)
@parametrize("func", [y(x), y], ordinary=0, long=1)
def test_the_formula_holds_for_functions_that_are_put_in(equation: Any, func: Any) -> None:
    found = kovacic.dsolve(equation, func).rhs
    residual = equation.subs(D0, found)
    for function in (x**2, exp(3 * x), sin(5 * x)):
        value = residual.subs(g(x), function).doit().subs({x: 0.75, k: 2, "C1": 3, "C2": 4})
        assert size(value) < 1e-12


def test_integrals_have_the_function_under_them() -> None:
    equation = D2 + D0 - g(x)
    found = kovacic.dsolve(equation, y(x)).rhs
    assert found.has(sympy.Integral)
    assert sympy.simplify(found.diff(x, 2) + found - g(x)) == 0
    assert any("is any function" in notice for notice in kovacic.solve(sympy.Eq(equation, 0)).notices)


@pytest.mark.long
def test_values() -> None:
    found = kovacic.dsolve(PROBLEMS[0], y(x), ics={y(0): 0, D1.subs(x, 0): 1}).rhs
    value = found.replace(g, lambda argument: argument).doit()
    assert sympy.simplify(value - x / k**2 - (1 - 1 / k**2) * sin(k * x) / k) == 0
    assert not found.has(cos(k * x) ** 2)


def test_two_functions_without_func_are_refused() -> None:
    with pytest.raises(kovacic.InputError, match=r"which is the unknown function.*\n.*func=y\(x\)"):
        kovacic.dsolve(PROBLEMS[0])


@pytest.mark.parametrize("term", [y(x - 1), y(2 * x), y(-x)])
def test_other_arguments_are_refused(term: Any) -> None:
    for problem in (D2 + term, D1 + term, [g(x).diff(x) - term, D1 - g(x)]):
        with pytest.raises(kovacic.InputError, match="different arguments"):
            kovacic.dsolve(problem, [g(x), y(x)] if isinstance(problem, list) else y(x))


@pytest.mark.parametrize("left", [D1, D2])
def test_another_variable_than_that_of_the_unknown_is_refused(left: Any) -> None:
    with pytest.raises(kovacic.InputError, match="isn't a function of z"):
        kovacic.dsolve(left + y(x), var="z")

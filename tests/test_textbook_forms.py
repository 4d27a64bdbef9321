"""Answers in the form that books print, and no longer than it."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize, read_expression

import kovacic

x = sympy.Symbol("x")

#: The problem, and the form in the books.
BOUNDARY_VALUES: list[tuple[str, str]] = [
    ("y'' - k^2*y = 0, y(0) = 0, y(a) = 1", "sinh(k*x)/sinh(k*a)"),
    ("T'' - k^2*T = 0, T(0) = b, T'(L) = 0", "b*cosh(k*(L - x))/cosh(k*L)"),
    ("y'' - k^2*y = 0, y'(0) = -q, y'(L) = 0", "q*cosh(k*(L - x))/(k*sinh(k*L))"),
    ("y'' - y = 0, y(0) = 0, y(1) = 1", "sinh(x)/sinh(1)"),
    ("y'' - y = 0, y(-1) = 2, y(1) = 3", "(2*sinh(1 - x) + 3*sinh(1 + x))/sinh(2)"),
    ("y'' - k^2*y = x, y(0) = 0, y(L) = 0", "L*sinh(k*x)/(k^2*sinh(k*L)) - x/k^2"),
    ("y'' - 4*y = 1, y(0) = 0, y(1) = 0", "(sinh(2*x) + sinh(2 - 2*x))/(4*sinh(2)) - 1/4"),
    ("y'' - m^2*y = -m^2*c, y(0) = a, y'(L) = 0", "c + (a - c)*cosh(m*(L - x))/cosh(m*L)"),
]

GENERAL: list[tuple[str, str, str]] = [
    ("y'' + 2*tan(x)*y' = 0", "1", "x + sin(x)*cos(x)"),
    ("y'' - 2*sec(x)^2*y = 0", "sin(x)/cos(x)", "1 + x*sin(x)/cos(x)"),
    ("y'' = (2*tanh(x)^2 - 1)*y", "1/cosh(x)", "2*x/cosh(x) + 2*sinh(x)"),
]


@parametrize("problem", BOUNDARY_VALUES, ids=str, ordinary=3)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_boundary_values_are_hyperbolic_functions_of_the_distance(problem: tuple[str, str]) -> None:
    equation, book = problem
    found = kovacic.dsolve(equation, var="x").rhs
    wanted = read_expression(book)
    values: dict[Any, Any] = {s: sympy.Rational(3 + k, 5) for k, s in enumerate(sorted(wanted.free_symbols, key=str))}
    assert abs(sympy.N((found - wanted).subs(values), 20)) < 1e-15
    assert not found.has(sympy.exp)
    assert len(str(found)) <= 1.3 * len(str(wanted))


@parametrize("problem", GENERAL, ids=str, ordinary=1)
def test_functions_of_waves_are_continued(problem: tuple[str, str, str]) -> None:
    """x for asin(sin(x)), cos(x) for sqrt(1 - sin(x)^2): solutions beyond the first quadrant, too."""
    equation, first, second = problem
    found = kovacic.dsolve(equation, var="x").rhs
    C1, C2 = sympy.symbols("C1 C2")
    assert sympy.simplify(found.diff(C1) - read_expression(first)) == 0
    assert sympy.simplify(found.diff(C2) - read_expression(second)) == 0

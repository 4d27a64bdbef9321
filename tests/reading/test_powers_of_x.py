"""Coefficients with x^n for a symbol n, sqrt(x), exp(x^2): the solutions are known before."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize, size
from sympy import Rational

import kovacic

x = sympy.Symbol("x")
y = sympy.Function("y")
D2, D1, D0 = y(x).diff(x, 2), y(x).diff(x), y(x)
n, a, p = sympy.Symbol("n"), sympy.Symbol("a", positive=True), sympy.Symbol("p", positive=True)
VALUES = {n: Rational(3, 2), a: 2, p: Rational(5, 3)}


def is_solution(u: Any, found: Any) -> bool:
    """Is u a combination of the two solutions: is the determinant with their derivatives zero?"""
    y1, y2 = (found.diff(constant).subs(VALUES) for constant in ("C1", "C2"))
    rows = [[e.diff(x, k) for k in range(3)] for e in (y1, y2, u.subs(VALUES))]
    integrals = {e: sympy.Rational(3, 4) for row in rows for part in row for e in part.atoms(sympy.Integral)}
    rows = [[part.xreplace(integrals).subs(x, Rational(7, 5)).evalf(30) for part in row] for row in rows]
    matrix = sympy.Matrix(rows)
    return bool(abs(matrix.det()) < 1e-20 and abs(matrix[:2, :2].det()) > 1e-9)


@parametrize(
    ("alpha", "beta", "gamma", "nu"),
    [
        (Rational(1, 2), 2 * a / (n + 2), n / 2 + 1, 1 / (n + 2)),
        (0, a, p, Rational(1, 3)),
        (Rational(1, 2), 1, Rational(5, 4), Rational(2, 5)),
        (1, 2, Rational(1, 3), 0),
        (-n, a, -p, 2),
        (0, sympy.I * a, n, p),
        (Rational(1, 3), 1, sympy.pi, Rational(1, 4)),
    ],
    ordinary=1,
    long=3,
)
def test_bessel_functions_of_powers(alpha: Any, beta: Any, gamma: Any, nu: Any) -> None:
    """x^alpha J_nu(beta x^gamma) is a solution [DLMF 10.13.4]."""
    c = sympy.expand((beta * gamma) ** 2 * x ** (2 * gamma)) + sympy.expand(alpha**2 - (nu * gamma) ** 2)
    found = kovacic.dsolve(x**2 * D2 + (1 - 2 * alpha) * x * D1 + c * D0).rhs
    assert is_solution(x**alpha * sympy.besselj(nu, beta * x**gamma), found)


@parametrize(
    ("left", "solution"),
    [
        (D2 - (x ** (2 * n) + n * x ** (n - 1)) * D0, sympy.exp(x ** (n + 1) / (n + 1))),
        (x * D2 - D1 + x**3 * sympy.exp(x**2) * D0, sympy.besselj(0, sympy.exp(x**2 / 2))),
        (4 * x * D2 + 2 * D1 + sympy.exp(2 * sympy.sqrt(x)) * D0, sympy.besselj(0, sympy.exp(sympy.sqrt(x)))),
        (x**2 * D2 + sympy.sqrt(x) * D1 - D0 / 4 * (1 / sympy.sqrt(x) + 0), 0),
    ],
    ordinary=1,
)
def test_other_solutions(left: Any, solution: Any) -> None:
    found = kovacic.dsolve(left).rhs
    if solution == 0:
        assert size(left.subs(D0, found).doit().subs({x: 1.7, "C1": 2, "C2": 3}), 15) < 1e-10
    else:
        assert is_solution(solution, found)


@pytest.mark.long
def test_values_and_right_hand_sides() -> None:
    solution = kovacic.dsolve(D2 + x**p * D0, ics={y(1): 2, D1.subs(x, 1): 3}).rhs.subs(VALUES)
    assert abs(solution.subs(x, 1).evalf(20) - 2) < 1e-15
    assert abs(solution.diff(x).subs(x, 1).evalf(20) - 3) < 1e-15
    assert size((solution.diff(x, 2) + x ** VALUES[p] * solution).subs(x, 2.5)) < 1e-12
    assert kovacic.dsolve(D2 + sympy.sqrt(x) * D0 - x).rhs.has(sympy.Integral)
    with pytest.raises(kovacic.InputError, match="singular point"):
        kovacic.dsolve(D2 + sympy.sqrt(x) * D0, ics={y(-1): 0, y(1): 1})


@pytest.mark.long
def test_values_at_the_origin() -> None:
    """y'' + a x^p y = 0 with p > 0 has solutions with any values at 0."""
    for value in (0, 2):
        found = kovacic.dsolve(D2 + a * x**p * D0, ics={y(0): value}).rhs.subs({**VALUES, "C1": 1, "C2": 1})
        assert abs(found.subs(x, Rational(1, 10**6)).evalf(20) - value) < 1e-5


@pytest.mark.long
def test_numbers() -> None:
    """The proven value is that of the formula."""
    formula = kovacic.dsolve("y'' = sqrt(x)*y", ics="y(1)=1, y'(1)=0").rhs.subs(x, 2).evalf(20)
    for equation in ("y'' = sqrt(x)*y", kovacic.solve("y'' = sqrt(x)*y")):
        proven = kovacic.evaluate(equation, 2, x0=1, y0=1, dy0=0)
        assert abs(complex(proven) - complex(formula)) < 1e-12
    answer = kovacic.solve("y'' = a*x^n*y")
    assert answer.case is None
    assert kovacic.Solution.from_json(answer.to_json()) == answer


@pytest.mark.long
def test_the_degree_of_a_solution_has_the_root_that_is_in_it() -> None:
    """sqrt(a/m^2) is sqrt(a)/m or minus that; for a negative m the degree and the index of the polynomial would differ."""
    answer = kovacic.conditions("y'' = (a*x^(2*m-2) + b*x^(m-2))*y")
    region = answer.region_at({"a": 1, "b": -4, "m": -1})
    assert region is not None
    a, b, m, x = sympy.symbols("a b m x")
    there = {a: 1, b: -4, m: -1}
    found = [s for s in region.solution() if s.degree.subs(there) in range(9)]
    assert found
    for solution in found:
        (polynomial,) = solution.y.atoms(sympy.assoc_laguerre)
        assert polynomial.args[0].subs(there) == solution.degree.subs(there)
        y = solution.y.subs(there)
        residual = sympy.diff(y, x, 2) - (x**-4 - 4 * x**-3) * y
        assert sympy.simplify(residual) == 0
        assert not solution.y.has(sympy.log)

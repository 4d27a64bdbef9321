"""Solutions of a region for all of its parameters at once: they solve the equation wherever their degree is natural."""

from __future__ import annotations

import pickle
from typing import Any

import pytest
import sympy

import kovacic
from kovacic.cli.main import main

R = sympy.Rational
x = sympy.Symbol("x")

CASES: list[tuple[str, dict[str, Any]]] = [
    ("(4*n^2-1)/(4*x^2) - 1", {"n": R(-7, 2)}),
    ("-2*e - 2*Z/x + l*(l+1)/x^2", {"e": R(-9, 32), "Z": 3, "l": 2}),
    ("1/4 - k/x + (4*m^2-1)/(4*x^2)", {"k": R(10, 3), "m": R(5, 6)}),
    ("x^2 - e + l*(l+1)/x^2", {"e": 11, "l": 2}),
    ("x^4 + mu*x", {"mu": -8}),
    ("b/x^4 + c/x^3", {"b": 4, "c": 24}),
    ("(n*(n+1)*x^2 - n^2 - n - 1)/(x^2-1)^2", {"n": 3}),
    (
        "-(1-l^2)/(4*(x-2)^2)-(1-m^2)/(4*(x-3)^2)-(l^2+m^2-n^2-1)/(4*(x-2)*(x-3))",
        {"l": R(1, 3), "m": R(1, 2), "n": R(29, 6)},
    ),
]


@pytest.mark.parametrize(("S", "values"), CASES)
def test_every_solution_with_a_natural_degree_solves_the_equation(S: str, values: dict[str, Any]) -> None:
    answer = kovacic.conditions(S, var="x")
    region = answer.region_at(values)
    assert region is not None
    at = {sympy.Symbol(name): value for name, value in values.items()}
    known = sympy.sympify(S.replace("^", "**")).subs(at)
    natural = 0
    for solution in region.solution():
        degree = sympy.nsimplify(solution.degree.subs(at))
        if not (degree.is_Integer and degree >= 0):
            continue
        natural += 1
        y = sympy.expand_func(solution.y.subs(at)).doit()
        value = (y.diff(x, 2) - known * y).subs(x, R(13, 7)).evalf(30)
        assert abs(value) < sympy.Float("1e-20") * abs(y.subs(x, R(13, 7)).evalf(30))
    assert natural


def test_hydrogen_has_its_wave_functions() -> None:
    region = kovacic.conditions("-2*E - 2*Z/x + l*(l+1)/x^2", var="x").regions[-1]
    E, Z, l = sympy.symbols("E Z l")  # noqa: E741
    rate = sympy.sqrt(2) * sympy.sqrt(-E)
    degree = Z / rate - l - 1
    wanted = x ** (l + 1) * sympy.exp(-rate * x) * sympy.assoc_laguerre(degree, 2 * l + 1, 2 * rate * x)
    assert any(sympy.simplify(solution.y - wanted) == 0 for solution in region.solution())


def test_regions_without_known_solutions_and_pickles(capsys: pytest.CaptureFixture[str]) -> None:
    answer = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x")
    assert answer.regions[0].solution() == ()
    bessel = kovacic.conditions("(4*n^2-1)/(4*x^2) - 1", var="x")
    assert pickle.loads(pickle.dumps(bessel)).regions[0].solution() == bessel.regions[0].solution()
    with pytest.raises(SystemExit) as status:
        main(["conditions", "--explain", "(4*n^2-1)/(4*x^2) - 1"])
    assert status.value.code == 0
    assert "where n - 1/2 is a natural number" in capsys.readouterr().out

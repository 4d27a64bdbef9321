"""Answers with values are those of an integration, on both sides of every branch cut that their functions meet."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from build import parametrize

import kovacic
from kovacic.general_solution.check import check_answer, jumps
from kovacic.general_solution.question import read_question

x = sympy.Symbol("x")

#: Equations and a point with y = y' = 0; their right-hand sides lead to Ei, Si, Ci, log, atan, asin, roots, Fresnel's
#: functions, error and gamma functions, dilogarithms, whose arguments cross a cut on the real axis.
PROBLEMS: list[tuple[str, int]] = [
    pytest.param(("y'' + 4*y = x/(1 + x^2)", 0), marks=pytest.mark.long),
    ("y'' + y = x/(x^2 - 2*x + 2)", 0),
    ("y'' + y = 1/(x^2 + x + 1)", 0),
    ("y'' + y = 1/(x^2 + 2*x + 5)", 0),
    ("y'' + y = 1/(4 + x^2)", 0),
    ("y'' + y = 1/(1 + x^2)", 0),
    ("y'' + y = 1/(2 + cos(x))", 0),
    ("y'' + y = 1/(3 + sin(x))", 0),
    ("y'' + y = 1/(5 - 4*cos(x))", 0),
    ("y'' = 1/(2 + cos(x))", 0),
    ("y'' = atan(x)", 0),
    ("y'' = x/(x^2 + 4)", 0),
    ("y'' = log(1 + x^2)", 0),
    ("y'' = log(x)", 1),
    ("y'' - y = 1/(1 + x^2)", 0),
    ("y'' - y = x/(x^2 - 2*x + 2)", 0),
    ("y'' - y = 1/(exp(x) + 1)", 0),
    ("y'' - y = 1/(exp(x) + exp(-x))", 0),
    ("y'' - 3*y' + 2*y = 1/(1 + exp(-x))", 0),
    ("y'' + y = 1/x", 1),
    ("y'' + y = sin(x)/(x^2 + 1)", 0),
    ("y'' = sin(x)/x", 1),
    ("y'' = exp(-x^2)", 0),
    ("y'' + y = exp(-x^2)", 0),
    ("y'' - y = exp(x^2)", 0),
    ("y'' = sin(x^2)", 0),
    ("y'' + y = sqrt(x)", 1),
    ("y'' = sqrt(1 + x^2)", 0),
    ("y'' = 1/sqrt(4 + x^2)", 0),
    ("y'' = asinh(x)", 0),
    ("y'' - y = sqrt(x)*exp(x)", 1),
    ("y'' + y = log(x)", 1),
    ("y'' + 4*y = tan(x)", 0),
    ("y'' + y = 1/cos(x)", 0),
    ("y'' + y' = x/(1 + x^2)", 0),
    ("y'' + 2*y' + 2*y = 1/(1 + x^2)", 0),
    ("y'' = x*atan(x)/(1 + x^2)", 0),
    ("y'' + y' = atan(x)/(1 + x^2)", 0),
    ("y'' + y' = 1/(2 + cos(x))", 0),
    ("y'' - 2*y' = log(1 + x^2)", 0),
    ("y'' + 9*y = 1/(2 + cos(3*x))", 0),
    ("y'' = log(x)/(1 + x)", 1),
]


@parametrize("problem", PROBLEMS, ids=str, ordinary=3, long=(7, 21, 35, 39), always=[("y'' + y' = 1/(2 + cos(x))", 0)])
def test_values_on_both_sides(problem: tuple[str, int]) -> None:
    equation, start = problem
    found = kovacic.dsolve(equation, ics={f"y({start})": 0, f"y'({start})": 0}).rhs
    places = [sympy.Rational(k, 10) for k in (-37, -21, -7, 3, 12, 29, 41)]
    singular = equation.count("1/x") or ("(x)" in equation and ("log(" in equation or "sqrt(x" in equation))
    for place in places:
        if start == 1 and (singular or "sin(x)/x" in equation) and place <= 0:
            continue
        if ("tan(" in equation or "1/cos" in equation) and abs(place) > 1.5:
            continue
        wanted = complex(kovacic.evaluate(equation, place, x0=start, y0=0, dy0=0).mid)
        value = complex(sympy.N(found.subs(x, place), 15))
        assert abs(value - wanted) < 1e-8 * (1 + abs(wanted)), place


@pytest.mark.parametrize(
    ("formula", "coefficient", "is_seen"),
    [
        (sympy.atan(2 * sympy.tan(x / 2)), x, True),
        (sympy.atan(sympy.Symbol("c") * sympy.tan(x / 2)), sympy.Symbol("c") * x, True),
        (sympy.atan(x), x, False),
        (sympy.log(x), 1 / x, False),
        (sympy.log(x**2 + 1), x, False),
        (sympy.Ei(sympy.I * x - 1), x, True),
        (sympy.expint(1, 1 - sympy.I * x), x, False),
        (sympy.sqrt(sympy.sin(x) ** 2) / sympy.sin(x), x, True),
        (sympy.log(sympy.I * x - 1), x, True),
        (sympy.acot(x), x, True),
        (sympy.atan(1 / (x**2 - 2)), x, True),
        (sympy.atan(1 / (x**2 - 2)), 1 / (x**2 - 2), False),
        (sympy.sqrt((x - 1) ** 2) * sympy.sqrt(x), 1 / x, True),
        (sympy.polylog(2, 2 + sympy.I * x), x, True),
    ],
)
def test_jumps_are_seen(formula: Any, coefficient: Any, is_seen: bool) -> None:
    assert jumps(formula, x, [coefficient]) is is_seen


def test_a_letter_of_known_sign_chooses_the_half_plane() -> None:
    """Whether Ei(a + i x) crosses its cut depends on the sign of a; where it isn't known, the integrals stay."""
    plain = "y'' + y = 1/(x^2 + a^2)"
    assert kovacic.dsolve(plain).has(sympy.Integral)
    known = kovacic.dsolve(plain, assume={"a": "positive"}).rhs
    assert known.has(sympy.expint)
    assert known.has(sympy.Ei)


def test_a_formula_that_jumps_is_said_to() -> None:
    """sqrt(x^2) satisfies y'' = 0 on either side of 0, an ordinary point at which its slope jumps; x does everywhere."""
    question = read_question("y'' = 0", None, None, None, kovacic.Limits())
    assert any("jumps" in note for note in check_answer(question, sympy.sqrt(x**2)))
    assert check_answer(question, x) == []


def test_functions_of_pairs_count_as_continuous() -> None:
    """The rest is looked at beside them, without their values in wide balls, which take minutes."""
    series = sympy.hyper((sympy.Rational(-1, 24), sympy.Rational(11, 24)), (sympy.Rational(3, 4),), x**2 / (x - 2) ** 2)
    assert not jumps(series * sympy.log(x), x, [1 / x])
    assert jumps(series * sympy.sqrt(sympy.sin(x) ** 2) / sympy.sin(x), x, [x])

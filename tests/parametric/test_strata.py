"""What `conditions` prints is true on every stratum: lists and formulas, as printed, against the engine at exact points.

Solving a condition for a parameter divides by its coefficient; specialising a formula moves singular points into one another.
The members are generated: each has parameters that can vanish, and the points lie on a small lattice, so that half of them are
on such a stratum, or on the values that the printed functions of an integer give.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import product
from random import Random
from typing import Any

import mpmath
import pytest
import sympy
from build import Conditions, parametrize
from parametric_formulas import as_sympy, numbers_in, residual, vanishes
from printed import printed_verdict, wrongly_printed

import kovacic
from kovacic.decision import Structure
from kovacic.parametric import solutions
from kovacic.parametric.claims import Classes, DegreeExists
from kovacic.parametric.integers import integer_condition
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import RegionVerdict

x = sympy.Symbol("x")
#: k g^2 = n^2 and its kin: at the zeros of g, or of a product, every k is possible.
LISTS = [
    *(f"k*(1+{g}/x)" for g in ("g", "g*h", "(g-h)", "g^2", "(2*g-1)", "g*(h+1)")),
    *(f"k*(1/x^4+{g}/x^3)" for g in ("g", "g*h")),
    "k*(1+g/(x-1)+h/x)",
    "k*(x^2+g*x)",
    *(f"x*y''+(1-x)*y'+m*(1+{q}/x)*y=0" for q in ("q", "q*(q-1)")),
    "x*y''+(c-x)*y'-a*c*y=0",
    "l*(l+1)/x^2 - Z/x - E",
    "a^2*(1-exp(-x))^2 - a*b*exp(-x)",
    "(a*x+b)/(x^2-2)^2 + c/x",
    "(a*x+b)/(x^2+k)^2 + x^2",
    "a/(x-sqrt(2))^2 + b/(x-1)^2 + c/x^2 + 1",
]
#: Equations whose singular points move into one another, or to infinity, at values of the parameters.
FORMULAS = {
    "(1+L*x)*y''+b*y'+c*y=0": "(1+L*x, b, c)",
    "x^2*(1+L*x)*y''+(2*x+5/2*L*x^2)*y'+(k*x+m)*y=0": "(x**2*(1+L*x), 2*x+Rational(5,2)*L*x**2, k*x+m)",
    "(x-p)*(x-q)*y''+x*y'+c*y=0": "((x-p)*(x-q), x, c)",
    "(x-p)*y''+(1+q)*y'+c*y=0": "(x-p, 1+q, c)",
    "(x^2-p^2)*y''+b*x*y'+c*y=0": "(x**2-p**2, b*x, c)",
    "x*(1+L*x)*y''+b*y'+c*y=0": "(x*(1+L*x), b, c)",
}


@parametrize("S", LISTS, ordinary=(4, 8), long=1)
def test_lists_are_true_as_printed(S: str) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=0)
    assert answer.complete is True
    tried, wrong = wrongly_printed(answer, 70 if len(answer.parameters) < 3 else 30, texts=4)
    assert tried >= 20
    assert not wrong, wrong[:3]


@pytest.mark.long
@pytest.mark.parametrize("S", ["(a*x+b)/(x^2+1)^2 + c/(x-1)^3", "(1+b*x)/(x^2+1)^2 + 3*x^4/(x^2-2)^3"])
def test_points_with_conjugate_exponents_beside_irregular_ones(S: str) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=0)
    assert answer.complete is True
    assert answer.check(10)


@pytest.mark.parametrize("constant", ["sqrt(2)", "2^(1/3)", "I"])
def test_a_double_pole_at_an_algebraic_number_has_its_own_exponents(constant: str) -> None:
    answer = kovacic.conditions(f"a/(x-{constant})^2 + b/x^2 + 1", var="x", max_degree=0)
    assert all(region.defined for region in answer.regions)
    assert str(answer.regions[2].statement).startswith("d + 1 = +-sqrt(4*b + 1)/2 +- sqrt(4*a + 1)/2, d in N")
    assert type(answer).from_json(answer.to_json()) == answer


def test_a_parameter_is_free_where_its_coefficient_vanishes() -> None:
    answer = kovacic.conditions("k*(1+g/x)")
    assert [str(region.statement) for region in answer.regions] == [
        "k = 0",
        "k = 4*n^2/g^2 for an integer n, or g = 0",
    ]
    verdict = printed_verdict(answer, answer.point({"k": 4, "g": 0}))
    assert verdict is not None
    assert verdict.case == kovacic.solve("4").case == 1


PLANTED: dict[str, tuple[str, str, Callable[..., Any]]] = {
    "a stratum isn't said": ("k*(1+g/x)", "kovacic.parametric.integers.on_zeros", lambda rest, zero: rest * 0 + 1),
    "a class is wrong": (
        "k*(1+g/x)",
        "kovacic.parametric.integers.integer_condition",
        lambda equation, numbers, *rest: integer_condition(
            equation, Classes(numbers.residues, 2 * numbers.modulus), *rest
        ),
    ),
    "a gauge is the generic one": (
        "(1+L*x)*y''+b*y'+c*y=0",
        "kovacic.parametric.regions.equation_at",
        lambda equation, point: equation,
    ),
    "a formula is another function": (
        "(1+L*x)*y''+b*y'+c*y=0",
        "kovacic.parametric.solutions.translated_solution",
        lambda y, equation: y + x**7,
    ),
    "a group is too small": ("k*(1+g/x)", "kovacic.parametric.theorems.borel", lambda *_, **__: G_M),
}
G_M = RegionVerdict(Structure.REDUCIBLE, family="G_m", abelian="abelian")


@pytest.mark.parametrize("fault", PLANTED)
def test_conditions_that_are_false_never_leave(
    fault: str, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    S, where, wrong = PLANTED[fault]
    monkeypatch.setattr(where, wrong)
    solutions.given.cache_clear()  # what was right before
    request.addfinalizer(solutions.given.cache_clear)
    with pytest.raises(kovacic.VerificationFailed, match="failed their own check"):
        kovacic.conditions(S, var="x", max_degree=0)


@pytest.mark.long
def test_a_degree_is_allowed_for_all_values_where_the_other_integer_is_zero() -> None:
    """d = 15 and j = 0 in a = -(d - 15)^2/(4*j^2) + 25/16."""
    answer = kovacic.conditions("x*(x-1)*(x-2)*y''-(3*x^2-6*x+2)/2*y'+(a*x+b)*y=0", var="x", max_degree=0)
    claim = answer.regions[-1].statement.claim
    assert isinstance(claim, DegreeExists)
    for a in (Fraction(1, 3), Fraction(25, 16), Fraction(-3, 16)):
        point = answer.point({"a": a, "b": 0})
        statement = answer.regions[-1].statement
        assert isinstance(statement, Natural)
        assert {*claim.degree.numbers_at(point)} == {*statement.numbers_at(point)} >= {15}


def lattice(names: tuple[str, ...], number: int) -> Iterator[dict[str, Fraction]]:
    """Points with small coordinates, many of them 0 or equal to another one."""
    values = [Fraction(v) for v in (0, 1, -1, 2, Fraction(1, 2), 3)]
    points = [*product(values, repeat=len(names))]
    Random(7).shuffle(points)
    for point in points[:number]:
        yield dict(zip(names, point, strict=True))


def wrong_formulas(answer: Conditions, equation: tuple[Any, Any, Any], number: int) -> tuple[int, list[str]]:
    tried, wrong = 0, list[str]()
    for values in lattice(answer.parameters, number):
        point = answer.point(values)
        region = answer.region_at(point)
        symbols = as_sympy(point)
        if region is None or region.case != 1 or symbols is None:
            continue
        there = tuple(sympy.sympify(part).subs(symbols) for part in equation)
        for number_of_zeros in numbers_in(point, region):
            for solution in region.solution(number_of_zeros):
                degree = solution.degree.subs(symbols)
                is_meant = degree.is_Integer and degree >= 0
                if not is_meant or not all(vanishes(condition.subs(symbols)) for condition in solution.conditions):
                    continue
                y = solution.y.subs(symbols)
                if y == 0:
                    continue
                tried += 1
                if y.has(sympy.nan, sympy.zoo) or residual(y, there, x, mpmath.mpf(13) / 7)[0] > 1e-20:
                    wrong.append(f"{solution} at {point}")
    return tried, wrong


@parametrize("text", FORMULAS, ordinary=(3,), long=1)
def test_formulas_are_those_of_the_equation_on_their_region(text: str) -> None:
    answer = kovacic.conditions(text, var="x", max_degree=0)
    equation = sympy.sympify(FORMULAS[text])
    tried, wrong = wrong_formulas(answer, equation, 60)
    assert tried > 5
    assert not wrong, wrong[:3]


@pytest.mark.long
def test_the_region_where_a_singular_point_goes_to_infinity_has_its_own_gauge() -> None:
    region = kovacic.conditions("(1+L*x)*y''+b*y'+c*y=0", var="x").regions[0]
    (solution,) = region.solution()
    assert sympy.simplify(solution.y.subs(dict(zip(sympy.symbols("b c"), (3, 2), strict=True)))) == sympy.exp(-x)


@pytest.mark.parametrize("root", ["sqrt(2)", "2^(1/3)", "1/sqrt(3)"])
def test_a_quotient_with_a_constant_in_it_is_read_as_printed(root: str) -> None:
    """b/sqrt(a/root) is an odd integer; 2*b^2/sqrt(2)*n^2 would be another function of n."""
    answer = kovacic.conditions(f"{root}*y'' = (a*x^2 + {root}*b)*y", var="x")
    printed = answer.regions[1].statement.text().partition(" for ")[0]
    name, _, right = printed.partition(" = ")
    assert name == "a"
    for n in range(1, 5):
        value = sympy.sympify(right.replace("^", "**")).subs({"n": n, "b": 2})
        assert answer.case_at({"a": value, "b": 2}) == (1 if n % 2 else None)

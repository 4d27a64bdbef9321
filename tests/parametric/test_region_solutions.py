"""Solutions of a region for all of its parameters at once: they solve the equation wherever their degree is natural."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from typing import Any

import pytest
import sympy
from build import parametrize, run
from test_symmetric_conditions import moved, pulled_back

import kovacic

R = sympy.Rational
x = sympy.Symbol("x")

CASES: list[tuple[str, dict[str, Any]]] = [
    ("(4*n^2-1)/(4*x^2) - 1", {"n": R(-7, 2)}),
    ("-2*q - 2*Z/x + l*(l+1)/x^2", {"q": R(-9, 32), "Z": 3, "l": 2}),
    ("1/4 - k/x + (4*m^2-1)/(4*x^2)", {"k": R(10, 3), "m": R(5, 6)}),
    ("x^2 - q + l*(l+1)/x^2", {"q": 11, "l": 2}),
    ("x^4 + mu*x", {"mu": -8}),
    ("b/x^4 + c/x^3", {"b": 4, "c": 24}),
    # irregular at a finite point, and the regular one, or the centre, elsewhere
    ("(b*x^2/(1-x)^2 + r*x/(1-x) + q)/x^4", {"b": R(3, 4), "q": R(1, 4), "r": R(7, 2)}),
    ("(x^2 + mu*(x-t)^2)/(x-t)^6", {"mu": 7, "t": 1}),
    ("(n*(n+1)*x^2 - n^2 - n - 1)/(x^2-1)^2", {"n": 3}),
    (
        "-(1-l^2)/(4*(x-2)^2)-(1-m^2)/(4*(x-3)^2)-(l^2+m^2-n^2-1)/(4*(x-2)*(x-3))",
        {"l": R(1, 3), "m": R(1, 2), "n": R(29, 6)},
    ),
    # some signs give the degree -1/2, of which SymPy has no polynomials
    ("(9*l^2*x^2 - 6*l^2*x + l^2 - x^2 + x - 1)/(4*x^2*(x - 1)^2)", {"l": R(5, 6)}),
]


@parametrize(("S", "values"), CASES, ordinary=1, long=1)
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
        value = (y.diff(x, 2) - known * y).subs(x, R(13, 7)).evalf(30, maxn=60)
        assert abs(value) < sympy.Float("1e-20") * abs(y.subs(x, R(13, 7)).evalf(30))
    assert natural


@parametrize(
    ("S", "d", "values"),
    [
        ("x^4 + a*x^2 + b*x + c", 1, {"a": 2}),
        ("x^6 + a*x^2 + b", 2, {}),
        ("a*x^4 + b*x^2 + c + x^6", 2, {"a": R(2, 3)}),
        ("g*x^4 + b*x + c", 1, {"b": R(3, 2)}),
        ("l*(l+1)/x^2 + a*x^2 + c + x^6", 2, {"l": R(3, 7)}),
        (
            "k^2/4 + A/x + B/(x-1) + (a^2-1)/(4*x^2) + (b^2-1)/(4*(x-1)^2)",
            1,
            {"a": R(1, 3), "b": R(2, 5), "k": R(3, 2)},
        ),
    ],
    ordinary=0,
    long=1,
)
def test_solutions_with_a_determinant_solve_the_equation_where_it_vanishes(
    S: str, d: int, values: dict[str, Any]
) -> None:
    """At a point that is found from the printed conditions, by derivatives to 30 digits."""
    limits = kovacic.Limits(seconds=600)  # of the clock, and the machine may be busy: determinants get a share of it
    regions = kovacic.conditions(S, var="x", limits=limits).regions
    region = next(r for r in regions if r.determinants and r.solution(d))
    given = {sympy.Symbol(name): value for name, value in values.items()}
    checked = 0
    for solution in region.solution(d):
        sides = [text.replace("^", "**").split(" = ") for text in solution.where.split(" or ")[0].split(", ")]
        equations = [(sympy.sympify(a) - sympy.sympify(b)).subs(given) for a, b in sides]
        for point in sympy.solve(equations, dict=True)[:2]:
            y, known = (f.subs(given).subs(point) for f in (solution.y, sympy.sympify(S.replace("^", "**"))))
            value = (y.diff(x, 2) - known * y).subs(x, R(13, 7)).evalf(30, maxn=60)
            assert abs(value) < sympy.Float("1e-20") * abs(y.subs(x, R(13, 7)).evalf(30))
            checked += 1
    assert checked


def test_the_quartic_has_the_solutions_of_its_paper() -> None:
    """y = (x + (4 c - a^2)/8) exp(-x^3/3 - a x/2) for b = -4 [Acosta-Humanez & Blazquez-Sanz 2008]."""
    region = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x").regions[0]
    a, c = sympy.symbols("a c")
    first = region.solution(1)[0]
    assert sympy.simplify(first.y - (x + (4 * c - a**2) / 8) * sympy.exp(-(x**3) / 3 - a * x / 2)) == 0
    assert first.where == "b = -4, a^4 - 8*a^2*c + 32*a + 16*c^2 = 0"
    assert {solution.where for solution in region.solution(0)} == {"b = -2, a^2 - 4*c = 0", "b = 2, a^2 - 4*c = 0"}


@parametrize(
    ("S", "values"),
    [
        (pulled_back(2, "p", "q", "r"), {"p": R(1, 3), "q": R(1, 5), "r": R(53, 15)}),
        (pulled_back(3, "p", "q", "r"), {"p": R(1, 3), "q": R(1, 5), "r": R(53, 15)}),
        (
            lambda: moved(pulled_back(2, "p", "q", "r"), "(2*x + 1)/(x - 3)"),
            {"p": R(1, 3), "q": R(1, 5), "r": R(53, 15)},
        ),
        # exponent differences m at the conjugate points, n at infinity
        ("-(1-m^2)*(2*x^2+4)/(4*(x^2-2)^2) - (2*m^2-n^2-1)/(4*(x^2-2))", {"m": R(1, 3), "n": R(17, 3)}),
        ("-(1-m^2)*(2*x^2-6)/(4*(x^2+3)^2) - (2*m^2-n^2-1)/(4*(x^2+3))", {"m": R(1, 3), "n": R(17, 3)}),
        # l, m, n at 1, 2, 4, and infinity is an ordinary point
        (
            "(-3*(1-l^2)/(x-1) + 2*(1-m^2)/(x-2) - 6*(1-n^2)/(x-4))/(4*(x-1)*(x-2)*(x-4))",
            {"l": R(1, 3), "m": R(1, 5), "n": R(53, 15)},
        ),
    ],
    ordinary=1,
    long=(1, 2),
)
def test_quotients_and_conjugate_poles_have_solutions(S: str | Callable[[], str], values: dict[str, Any]) -> None:
    test_every_solution_with_a_natural_degree_solves_the_equation(S if isinstance(S, str) else S(), values)


@pytest.mark.parametrize(
    ("S", "reasons"),
    [
        ("x^4 + a*x^2 + b*x + c", ["for each natural number: solution(d)"]),
        ("(4*n^2 - 1)/(4*x^2) - 1", [""]),
        ("b/x^2 + r*x", ["", "degree 2"]),
        ("(m^2-1)*(x^4+4*x)/(4*(x^3-2)^2) - (m^2-1)*x/(4*(x^3-2))", ["cubic", "degree 2", "degree 4, 6 or 12"]),
    ],
)
def test_a_region_says_why_it_has_no_solution(S: str, reasons: list[str]) -> None:
    regions = kovacic.conditions(S, var="x").regions
    for region, reason in zip(regions, reasons, strict=False):
        assert reason in region.why_no_solution
        assert bool(region.solution()) == (region.why_no_solution == "")


@pytest.mark.long
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
    assert run(["conditions", "--explain", "(4*n^2-1)/(4*x^2) - 1"]) == 0
    assert "where n - 1/2 is a natural number" in capsys.readouterr().out


@parametrize(("d", "numbers"), [(1, (0, 2)), *((d, range(-5, 7)) for d in range(5))], ordinary=(0,))
def test_where_a_jacobi_polynomial_vanishes_is_said_in_short(d: int, numbers: Sequence[int]) -> None:
    """Of one parameter where both are the same, and nothing where they are opposite; checked at each number."""
    region = kovacic.conditions("x*(1-x)*y'' + (c-2*x)*y' - m*y = 0", var="x").regions[0]
    solutions = region.solution()
    said = [str(solution).partition("natural number")[2] for solution in solutions]
    assert said[0] == said[1] == ", unless c - 1 is an integer with -d <= c - 1 < -d/2"
    assert said[-1] == said[-2] == ", unless 1 - c is an integer with -d <= 1 - c < -d/2"
    assert said[2:-2] == [""] * 4
    c, m = sympy.symbols("c m")
    for solution, words in zip(solutions, said, strict=True):
        for number in numbers:
            there = {c: sympy.Integer(number)}
            vanishes = bool(words) and -d <= solution.jacobi[0].xreplace(there) < -R(d, 2)
            for value in sympy.solve(solution.degree.xreplace(there) - d, m):
                assert (solution.at({**there, m: value}) is None) == vanishes


def test_no_formula_is_offered_where_its_degree_is_never_natural() -> None:
    """With two half-integers in x^2 the equation in x is reducible, and its solutions aren't Jacobi's polynomials."""
    answer = kovacic.conditions("(m^2-1/4)/x^2 + a/(x^2-1) + b/(x^2-1)^2", var="x")
    region = answer.region_at({"m": "9/2", "a": 0, "b": "-7/2"})
    assert region is not None
    assert region.case == 1
    assert region.solution() == ()
    assert "solve_at" in region.why_no_solution
    assert answer.solve_at({"m": "9/2", "a": 0, "b": "-7/2"}).case == 1


@pytest.mark.long
def test_a_solution_doesnt_vanish_where_a_root_in_it_does() -> None:
    """y'' = (6/x^2 + a) y has solutions exp(sqrt(a) x) (a x^2 - 3 sqrt(a) x + 3)/x^2, and 3/x^2 for a = 0."""
    answer = kovacic.conditions("6/x^2 + a + b*x^2", var="x")
    region = answer.region_at({"a": 0, "b": 0})
    assert region is not None
    (solution,) = region.solution()
    x, a = sympy.symbols("x a")
    for value in (0, 1, 4):
        y = solution.y.subs(a, value)
        assert y != 0
        assert sympy.simplify(sympy.diff(y, x, 2) - (6 / x**2 + value) * y) == 0


def test_no_formula_has_equations_that_exclude_one_another() -> None:
    """(x - i)^(1/4) (x + i)^(3/4) P would need b = 6 and b = 9/2."""
    answer = kovacic.conditions("x^2 + a + b/(x^2+1) + 3/(4*(x^2+1)^2)", var="x", max_degree=0)
    for number in (1, 2):
        found = [solution for region in answer.regions for solution in region.solution(number)]
        assert len(found) == 4
        assert all(sympy.solve(solution.conditions, dict=True) for solution in found)


@pytest.mark.long
def test_no_condition_is_printed_twice() -> None:
    """The exceptional polynomials X1 of Jacobi with b = 1/a - 1: at a = 1 two theorems say the same."""
    S = "(x^2-1)*y''+2*a*((1-(1/a-1)*x)/(1/a-1-x))*((x-2/a+1)*y'-y)-L*y=0"
    answer = kovacic.conditions(S, var="x", max_degree=0)
    said = [region.statement.text() for region in answer.regions]
    assert len(said) == len({*said}) > 5
    # L + 1 = 0 needn't be said where Delta_0 = 0 for all values.
    deltas = answer.regions[-1].determinants[0]
    assert deltas.count("L = 2*a - 2") == 1


@pytest.mark.parametrize(
    "S",
    [
        "a/(x - sqrt(2))^2 + b",
        "2^(1/3)*a/x^2 + b/x + 1/4",
        pytest.param("x*(1-x)*y'' + (1/2 - sqrt(2)*x)*y' + a*y = 0", marks=pytest.mark.long),
        "I*a*x^2 + b",
    ],
)
def test_a_constant_is_a_number_in_solutions_and_after_json(S: str) -> None:
    """Not a symbol of this name: sqrt(2)^2 is 2.  No condition about the constant alone is printed."""
    answer = kovacic.conditions(S, var="x", max_degree=0)
    found = [solution for region in answer.regions for solution in region.solution()]
    assert found
    assert {symbol.name for solution in found for symbol in solution.y.free_symbols} <= {"x", *answer.parameters}
    text = answer.text()
    assert "!= 0" not in text
    assert "is an odd integer, or" not in text
    again = type(answer).from_json(answer.to_json())
    assert again.text() == text
    assert again.theorem() == answer.theorem()


@pytest.mark.parametrize(
    ("S", "groups"),
    [
        pytest.param("k*(1 + g/x)", {"trivial"}, marks=pytest.mark.long),
        ("-b/(x^3 + a*x)", {"trivial"}),
        ("a*(x^2 + b*x) + 1", {"G_m"}),
    ],
)
def test_the_group_is_known_where_no_parameter_is_left(S: str, groups: set[str]) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=0)
    assert {
        region.group for region in answer.regions if not region.statement.text().startswith(("k = 4", "("))
    } == groups
    assert answer.check(20)

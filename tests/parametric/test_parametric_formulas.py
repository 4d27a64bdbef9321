"""Formulas of `conditions` mean what they say: solutions solve the equation, Delta_d is a rank, JSON is read back."""

from __future__ import annotations

import re
from functools import cache

import pytest
import sympy
from build import Conditions, parametrize
from parametric_formulas import all_families, equation_of, misread, wrong_solutions

import kovacic

x = sympy.Symbol("x")
FAMILIES = all_families()
#: Of the families, some of each theory; all of them are tried by the long tests.
SOME = [
    "coulomb, in the energy",
    "irr_c, published",
    "quartic_abc, published",
    "x6_b, published",
    "shifted_whit, published",
    "rosenmorse, published",
    "posch_E, published",
    "P_conj, published",
    "heun_qa, published",
    "whittaker_hill, published",
]
#: General Heun, with six parameters, takes minutes.
ALL = [name for name in FAMILIES if not name.startswith("heun_gen")]


@cache
def conditions_of(name: str) -> Conditions:
    return kovacic.conditions(FAMILIES[name], var="x", max_degree=0)


def solutions_are_right(name: str, points: int) -> None:
    answer = conditions_of(name)
    _, wrong = wrong_solutions(answer, equation_of(answer), x, points)
    assert not wrong, wrong[:3]


#: One family of seventy-two in the long tests, each of them in the slow ones.
EACH = [pytest.param(name, marks=pytest.mark.long if k % 72 == 6 else pytest.mark.slow) for k, name in enumerate(ALL)]


@parametrize("name", SOME, ordinary=1, long=1)
def test_solutions_solve_the_equation(name: str) -> None:
    solutions_are_right(name, 3)


@pytest.mark.parametrize("name", EACH)
def test_all_solutions_solve_the_equation(name: str) -> None:
    solutions_are_right(name, 20)


@parametrize("S", ["1 + D/x + q/x^2 + a/x^4", "x^2 + l/x^6 - E", "x^2 + a/x^4 + b/x^3 + c/x^2 - E"], ordinary=0, long=1)
def test_a_root_of_a_parameter_has_the_sign_that_solves_the_equation(S: str) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=0)
    tried, wrong = wrong_solutions(answer, equation_of(answer), x, 12)
    assert tried > 12
    assert not wrong, wrong[:3]


@pytest.mark.long
def test_the_sign_of_q_chooses_the_root_of_a() -> None:
    region = kovacic.conditions("1 + D/x + q/x^2 + a/x^4", var="x").regions[-1]
    D, q, a = sympy.symbols("D q a")
    there = {D: 2, q: 4, a: 4}
    meant = [s for s in region.solution(0) if not any(condition.subs(there) for condition in s.conditions)]
    assert [s.y.subs(there) for s in meant] == [x * sympy.exp(x - 2 / x)]


EQUATIONS = {
    "Bessel": ("x^2*y'' + x*y' + (x^2 - n^2)*y = 0", (x**2, x, x**2 - sympy.Symbol("n") ** 2)),
    "Kummer": ("x*y'' + (c - x)*y' - a*y = 0", (x, sympy.Symbol("c") - x, -sympy.Symbol("a"))),
    "Hermite": ("y'' - 2*x*y' + 2*n*y = 0", (1, -2 * x, 2 * sympy.Symbol("n"))),
    "Legendre": (
        "(1 - x^2)*y'' - 2*x*y' + n*(n + 1)*y = 0",
        (1 - x**2, -2 * x, sympy.Symbol("n") * (sympy.Symbol("n") + 1)),
    ),
    "Jacobi": (
        "(1 - x^2)*y'' + (b - a - (a + b + 2)*x)*y' + n*(n + a + b + 1)*y = 0",
        sympy.sympify("(1 - x**2, b - a - (a + b + 2)*x, n*(n + a + b + 1))"),
    ),
    "Morse": (
        "y'' = (A^2*exp(-2*x) - B*exp(-x) - E)*y",
        (1, 0, sympy.sympify("-(A**2*exp(-2*x) - B*exp(-x) - E)", {"E": sympy.Symbol("E")})),
    ),
    "Poeschl-Teller": (
        "y'' = (-l*(l + 1)/cosh(x)^2 - E)*y",
        (1, 0, sympy.sympify("l*(l + 1)/cosh(x)**2 + E", {"E": sympy.Symbol("E")})),
    ),
    "Eckart": (
        "y'' = (a*(a - 1)/sinh(x)^2 - 2*b*coth(x) - E)*y",
        (1, 0, sympy.sympify("-(a*(a - 1)/sinh(x)**2 - 2*b*coth(x) - E)", {"E": sympy.Symbol("E")})),
    ),
    "trigonometric Poeschl-Teller": (
        "y'' = (l*(l - 1)/sin(x)^2 - E)*y",
        (1, 0, sympy.sympify("-(l*(l - 1)/sin(x)**2 - E)", {"E": sympy.Symbol("E")})),
    ),
    "Razavy": (
        "y'' = (b^2*cosh(2*x)^2/4 - (k + 1)*b*cosh(2*x) - E)*y",
        (1, 0, sympy.sympify("-(b**2*cosh(2*x)**2/4 - (k + 1)*b*cosh(2*x) - E)", {"E": sympy.Symbol("E")})),
    ),
}


@parametrize("name", EQUATIONS, ordinary=0, long=(0, 4))
def test_solutions_are_those_of_the_equation_that_was_given(name: str) -> None:
    text, equation = EQUATIONS[name]
    answer = kovacic.conditions(text, var="x", max_degree=0)
    tried, wrong = wrong_solutions(answer, tuple(map(sympy.sympify, equation)), x, 5)  # type: ignore[arg-type]
    assert tried
    assert not wrong, wrong[:3]
    assert Conditions.from_json(answer.to_json()) == answer


@parametrize("name", SOME, ordinary=2, long=(1, 6, 8))
def test_answers_are_read_back(name: str) -> None:
    """With everything that is printed of them."""
    answer = conditions_of(name)
    read = Conditions.from_json(answer.to_json())
    assert read == answer
    assert read.text(all=True) == answer.text(all=True)
    assert read.theorem(format="latex") == answer.theorem(format="latex")
    assert [r.why_no_solution for r in read.regions] == [r.why_no_solution for r in answer.regions]


@pytest.mark.parametrize("name", EACH)
def test_all_answers_are_read_back(name: str) -> None:
    test_answers_are_read_back(name)


def test_a_determinant_without_parameters_is_that_of_its_degree() -> None:
    """Darboux' transformation decides this one for every E: no determinant is left."""
    answer = kovacic.conditions("x^2 + 8*(2*x^2-1)/(2*x^2+1)^2 - E", var="x", max_degree=0)
    assert [answer.case_at({"E": E}) for E in (-3, 3, 9, -9, 2, 0)] == [1, 1, 1, 1, None, None]
    with pytest.raises(kovacic.InputError, match="natural number"):
        answer.determinant(0)


def texts_say_what_is_meant(name: str, points: int) -> None:
    _, wrong = misread(conditions_of(name), points)
    assert not wrong, wrong[:3]


@parametrize("name", SOME, ordinary=1, long=4)
def test_texts_say_what_is_meant(name: str) -> None:
    texts_say_what_is_meant(name, 6)


@pytest.mark.parametrize("name", EACH)
def test_all_texts_say_what_is_meant(name: str) -> None:
    texts_say_what_is_meant(name, 20)


@parametrize(
    "S",
    ["x^6 + a*x^2 + b*x^4 + c/x^4", "x^2 + l/x^4 - E", "x^2 + l/x^4 + b/x^2 - E", "(x - a)^2 + l/(x - a)^4 - E"],
    ordinary=1,
)
def test_a_symmetry_that_changes_one_root_of_two_excludes_case_1(S: str) -> None:
    """Only where the pole, and with it the root that changes, is gone."""
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert all(region.statement.text().startswith(("l = 0", "c = 0")) for region in answer.regions)
    assert answer.check(30)


def test_pi_is_a_number() -> None:
    answer = kovacic.conditions("pi*x^2 + a", var="x")
    assert not any(text in str(answer) for text in ("pi = 0", "pi = a"))


@pytest.mark.long
def test_an_invariant_of_degree_4_alone_shows_no_case_1() -> None:
    """Its exponents make y1^4 rational in case 1; in case 2, the generic one, (y1 y2)^2 is."""
    answer = kovacic.conditions(FAMILIES["lame1_k, published"], var="x", max_degree=0)
    assert answer.generic.case == 2
    assert answer.check(30)


@pytest.mark.parametrize("name", EACH)
def test_all_families_agree_with_the_engine(name: str) -> None:
    """Where a natural number is involved, statements are decided by ranks, and the engine by its own way."""
    assert conditions_of(name).check(40)


@parametrize("product", ["2*a*b", "a*b*c", "(a - 1)*b", "2*(a + b)*(a - c)", "a*(b + 1)^2"], ordinary=1, long=2)
def test_no_single_name_is_in_parentheses(product: str) -> None:
    """Where the spectrum has a pole, a product has to vanish: b*a = 0, not (b)*(a) = 0."""
    answer = kovacic.conditions(f"a*(a-1)/x^2 + {product}/x + g", var="x")
    assert any(" = 0 where " in str(region) for region in answer.regions)
    assert not re.search(r"(?<!\w)\(\w+\)", answer.text())
    assert answer.check(20)

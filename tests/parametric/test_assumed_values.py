"""Values and inequalities as assumptions: the same answers as for the equation with these values, and at points within them."""

from __future__ import annotations

from contextlib import nullcontext
from fractions import Fraction
from itertools import product
from math import isqrt

import pytest
import sympy
from build import QQ, parametrize, run

import kovacic

BESSEL = "(4*n^2 - 1)/(4*x^2) - 1"
EULER = "(n^2 - 1/4)/x^2 + k"


@parametrize("value", ["3", "-7/2", "0", "sqrt(2)", "I/2", Fraction(5, 2), sympy.sqrt(3) / 2, 2], ordinary=1, long=1)
def test_a_value_is_put_in_for_the_parameter(value: object) -> None:
    for S in (EULER, sympy.sympify(EULER.replace("^", "**"))):
        answer = kovacic.conditions(S, assume={"n": value}, var="x")
        assert answer.parameters == ("k",)
        assert answer.complete is True
        general = kovacic.conditions(EULER, var="x")
        for k in (0, 1, -2):
            assert answer.case_at({"k": k}) == general.case_at({"n": value, "k": k})
        assert kovacic.solve(S, assume={"n": value, "k": 1}, var="x").case == general.case_at({"n": value, "k": 1})
    assert kovacic.decide(BESSEL, assume={"n": value}).case == kovacic.conditions(BESSEL).case_at({"n": value})


def test_a_value_in_an_equation() -> None:
    bessel = "x^2*y'' + x*y' + (x^2 - n^2)*y = 0"
    answer = kovacic.solve(bessel, assume={"n": "3/2"})
    assert answer.case == 1
    assert answer.equation is not None
    assert str(answer.S) == str(kovacic.solve(bessel.replace("n", "(3/2)")).S)
    x, n = sympy.symbols("x n")
    y = sympy.Function("y")(x)
    equation = sympy.Eq(x**2 * y.diff(x, 2) + x * y.diff(x) + (x**2 - n**2) * y, 0)
    assert kovacic.solve(equation, assume={n: Fraction(3, 2)}).S == answer.S


def test_a_value_in_coefficients_and_in_exponentials() -> None:
    assert kovacic.solve(a="x^2", b="x", c="x^2 - n^2", assume={"n": "5/2"}).case == 1
    for S in ("a*exp(2*x) + b^2", sympy.sympify("a*exp(2*x) + b**2")):
        answer = kovacic.conditions(S, assume={"a": 2}, var="x")  # Bessel in exp(x), the square root of exp(2*x)
        assert [answer.case_at({"b": b}) for b in ("1/2", "1/3", "-7/2")] == [2, None, 2]
        assert kovacic.solve(S, assume={"a": 2, "b": "3/2"}, var="x").case == 2


@pytest.mark.parametrize(
    "assume",
    [{"x": 2}, {"n": "n + 1"}, {"n": "x"}, {"m": 3}, {"n": "prime"}, {"n": ">=a"}, {"n": ">1/0"}, {"n": "1/0"}],
)
def test_what_is_no_value_of_a_parameter_is_refused(assume: dict[str, object]) -> None:
    for ask in (kovacic.conditions, kovacic.solve):
        with pytest.raises(kovacic.InputError):
            ask(BESSEL, assume=assume, var="x")


def test_a_parameter_must_be_left_for_conditions() -> None:
    with pytest.raises(kovacic.InputError, match="every parameter has a value"):
        kovacic.conditions(BESSEL, assume={"n": 3})


INEQUALITIES = ["<0", "<=0", ">0", ">=0", ">=1/2", ">-3 <=5/3", "integer >0", "odd >=2 <7", ">=-1 >1 >=0"]


@parametrize("what", INEQUALITIES, ordinary=1, long=3)
def test_bounds_admit_the_numbers_between(what: str) -> None:
    answer = kovacic.conditions("x^2 + n*x^3", assume={"n": what}, var="x")
    relations = [word for word in what.split() if word[0] in "<>"]
    for value in {Fraction(a, b) for a, b in product(range(-12, 13), (1, 2, 3))}:
        expected = all(sympy.sympify(f"{value} {word}") for word in relations)
        expected &= "integer" not in what or value.denominator == 1
        expected &= "odd" not in what or (value.denominator == 1 and value % 2 == 1)
        with nullcontext() if expected else pytest.raises(kovacic.InputError, match="contradicts"):
            answer.case_at({"n": value})


@parametrize("what", INEQUALITIES, ordinary=1, long=5)
@parametrize(
    "S", [BESSEL, "x^6 + n*x^2", "x^4 + n*x", "n*x^5 + x", "(n+2)*x^4 + x^2 + n*x", "x^2 + n"], ordinary=2, long=2
)
def test_inequalities_leave_out_only_what_cannot_happen(S: str, what: str) -> None:
    general, answer = kovacic.conditions(S, var="x"), kovacic.conditions(S, assume={"n": what}, var="x")
    assert len(answer.regions) <= len(general.regions)
    assert kovacic.solution.conditions.Conditions.from_json(answer.to_json()) == answer
    for value in (Fraction(k, 2) for k in range(-14, 15)):
        if answer.assumptions.admits([("n", QQ.poly([value]))]):
            assert answer.case_at({"n": value}) == general.case_at({"n": value})


def test_a_sign_shortens_the_statement() -> None:
    sextic = "x^6 + b*x^2 + c"
    for what, expected in (("> -2", "b = 2*d + 3, "), ("<0", "b = -2*d - 3, "), ("nonnegative", "b = 2*d + 3, ")):
        (region,) = kovacic.conditions(sextic, assume={"b": what}, var="x").regions
        assert str(region.statement).startswith(expected)
    assert not kovacic.conditions(sextic, assume={"b": ">-3 <3"}, var="x").regions
    assert not kovacic.conditions(BESSEL, assume={"n": ">0 <1/2"}).regions
    b = sympy.Symbol("b", nonnegative=True)
    x, c = sympy.symbols("x c")
    (region,) = kovacic.conditions(x**6 + b * x**2 + c, var=x).regions
    assert str(region.statement).startswith("b = 2*d + 3, ")


def test_algebraic_values_have_a_sign() -> None:
    answer = kovacic.conditions("x^2 + n", assume={"n": ">=0"}, var="x")
    for value in ("sqrt(2)", "3 - sqrt(2)", "2^(1/3)"):
        assert answer.case_at({"n": value}) is None
    for value in ("-sqrt(2)", "1 - sqrt(2)", "I", "1 + I", "-2^(1/3)"):
        with pytest.raises(kovacic.InputError, match="contradicts"):
            answer.case_at({"n": value})


def test_inequalities_and_values_in_the_shell(capsys: pytest.CaptureFixture[str]) -> None:
    given = ("n>=0", "n < 7/2", "k=3", "m=odd", "m!=1", "j = -1/2")
    S = "k*x^2 + n + j*m"
    assert run(["conditions", "--json", "--var", "x", *(f"--assume={word}" for word in given), S]) == 0
    assume = {"n": ">=0 <7/2", "k": "3", "m": "odd !=1", "j": "-1/2"}
    assert capsys.readouterr().out.strip() == kovacic.conditions(S, var="x", assume=assume).to_json()


def test_the_sign_of_a_difference_with_long_terms() -> None:
    """10^300 sqrt(2) - floor(10^300 sqrt(2)) is positive; an approximation of sqrt(2) of less than 300 digits can't say so."""
    answer = kovacic.conditions("a/x^2 + 1", assume={"a": ">0"})
    assert answer.case_at({"a": f"10^300*sqrt(2) - {isqrt(2 * 10**600)}"}) is None
    with pytest.raises(kovacic.errors.InputError, match="contradicts the assumption"):
        answer.case_at({"a": f"{isqrt(2 * 10**200)} - 10^100*sqrt(2) - 1/10"})

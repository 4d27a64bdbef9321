"""Generic parameters: the field Q(t), its lift, and the generic answers."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from fractions import Fraction
from itertools import combinations
from typing import Any

import pytest
import sympy
from build import Conditions, FunctionField, RatFunc, parametrize, run
from parametric_cases import BALL

import kovacic
from kovacic import Status
from kovacic.parametric.assumptions import read_assumptions

K = FunctionField(("s", "t"))
s, t = K.generator("s"), K.generator("t")
x = K.poly([0, 1])


GENERIC = [
    ("(4*n^2-1)/(4*x^2) - 1", None),
    ("n", 1),
    ("n^2", 1),
    ("x^2 + mu", None),
    ("a*x + b", None),
    ("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", 1),
    ("n*(n-1)/x^2 + 2*n*m + m^2*x^2 + m", 1),
    ("-3/(16*x^2) + q/x", 2),
    (BALL, 2),
    ("(2*n*x + x^2 + n^2 + 1)*t^2", None),
    ("sqrt(2)*n/x^2", 1),
    ("x^2 + I*n", None),
    ("-1/4/x^2 + n/x^3", None),
]


@parametrize(("S", "case"), GENERIC, ordinary=5)
def test_generic_answers_are_verified(S: str, case: int | None) -> None:
    answer = kovacic.solve(S, var="x")
    assert answer.case == case
    assert answer.verified
    assert any("parameter" in notice for notice in answer.notices)
    again = kovacic.Solution.from_json(answer.to_json())
    assert again == answer
    assert again.verify()


def test_the_ball_with_symbols() -> None:
    answer = kovacic.solve(BALL, var="x")
    assert answer.case == 2
    assert answer.riccati is not None
    k, x1, x2, X = sympy.symbols("k x1 x2 x")
    total = sympy.sympify(str(answer.riccati.coefficients[1]))
    expected = -sympy.Rational(1, 2) * (1 / (X - x1) + 1 / (X - x2))
    assert sympy.cancel(total - expected) == 0
    del k


def test_generic_answers_specialise_where_nothing_vanishes() -> None:
    """omega at random values of the parameters solves the Riccati equation of S at these values."""
    answer = kovacic.solve("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", var="x")
    assert answer.omega is not None
    X = sympy.Symbol("x")
    for values in ({"m": 2, "n": 3}, {"m": -1, "n": Fraction(1, 2)}, {"m": Fraction(5, 3), "n": 7}):
        chosen = {sympy.Symbol(name): sympy.Rational(str(value)) for name, value in values.items()}
        omega, S = (sympy.sympify(str(f)).subs(chosen) for f in (answer.omega, answer.S))
        assert sympy.cancel(sympy.diff(omega, X) + omega**2 - S) == 0


def test_the_conditions_of_a_generic_answer() -> None:
    conditions = kovacic.solve("(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2", var="x").generic_conditions
    assert {str(f) for f in conditions.nonzero} == {"m", "n", "n - 1"}
    assert [str(f) for f in conditions.irrational_squares] == ["4*n**2 - 4*n + 1"]
    ball = kovacic.solve(BALL, var="x").generic_conditions
    assert any(str(f) == "x1 - x2" for f in ball.nonzero)
    assert not kovacic.solve("x^2 + 3").generic_conditions


def test_sympy_input_with_parameters() -> None:
    X, n = sympy.symbols("x n")
    assert kovacic.solve((4 * n**2 - 1) / (4 * X**2) - 1).status is Status.NONE_EXISTS
    assert kovacic.solve(n**2 + 0 * X, var=X).case == 1


def test_many_equations_whose_omega_is_chosen() -> None:
    """omega first: S = omega' + omega^2 must give case 1, with a verified omega."""
    one = RatFunc(K.poly([1]))
    for omega in (one * s / x + t, one * (s - t) / (x - s) + one * t / x, one * s * x + one / (x * x - t)):
        answer = kovacic.solve(omega.derivative() + omega * omega)
        assert answer.case == 1
        assert answer.verified


def test_the_conditions_are_part_of_text_and_json(capsys: pytest.CaptureFixture[str]) -> None:
    S = "(m^2*x^4 + (2*n+1)*m*x^2 + n^2 - n)/x^2"
    answer = kovacic.solve(S, var="x")
    assert run(["solve", "--no-solutions", "--var", "x", S]) == 0
    assert "m != 0, n != 0, n - 1 != 0" in capsys.readouterr().out
    assert json.loads(answer.to_json())["generic_conditions"]["nonzero"] == ["m", "n", "n - 1"]
    assert json.loads(kovacic.solve("x^2 + 3").to_json())["generic_conditions"] is None


@pytest.mark.parametrize(
    ("words", "inside", "outside"),
    [
        (">sqrt(2)", ["3/2", "sqrt(3)", 7], ["7/5", 1, "-sqrt(3)", "I"]),
        ("0<E<20", ["1/2", 19, "sqrt(2)"], [0, 20, -1, "sqrt(401)"]),
        ("1/3 <= E < sqrt(10)", ["1/3", 3], ["1/4", "16/5"]),
        (">-sqrt(2), <sqrt(2), !=1", [0, "-7/5", "141/100"], [1, 2, "-3/2"]),
        ("integer, >sqrt(2)", [2, 3], [1, "5/2"]),
    ],
)
def test_bounds_that_are_no_rational_numbers_and_two_ends(words: str, inside: list[Any], outside: list[Any]) -> None:
    answer = kovacic.conditions("x^2 - E", var="x", assume={"E": words})
    for value in inside:
        assert answer.case_at({"E": value}) == kovacic.decide("x^2 - E", var="x", assume={"E": str(value)}).case
    for value in outside:
        with pytest.raises(kovacic.InputError, match="contradicts the assumption"):
            answer.case_at({"E": value})
    assert kovacic.solution.conditions.Conditions.from_json(answer.to_json()) == answer


def test_a_bound_between_two_squares_excludes_them() -> None:
    """E + 3 can't vanish above -sqrt(8), and can above -sqrt(10)."""
    S = "x^2/(E + 3) - E"
    assert "S isn't defined" not in str(kovacic.conditions(S, var="x", assume={"E": ">-sqrt(8)"}))
    assert "S isn't defined" in str(kovacic.conditions(S, var="x", assume={"E": ">-sqrt(10)"}))
    assert "S isn't defined" not in str(kovacic.conditions(S, var="x", assume={"E": "!=-3"}))


def test_a_parameter_that_is_a_function_of_others() -> None:
    answer = kovacic.conditions("a*x^2 - E", var="x", assume={"a": "b^2", "b": "positive"})
    assert answer.parameters == ("b", "E")
    assert [str(region.statement) for region in answer.regions] == ["E/b is an odd integer"]
    for value in ("x^2", "a + 1", "!=sqrt(2)", ">I"):
        with pytest.raises(kovacic.InputError):
            kovacic.conditions("a*x^2 - E", var="x", assume={"a": value})


@pytest.mark.parametrize(
    ("S", "assume", "case"),
    [("x^2 - (2*n+1)", "nonnegative integer", 1), ("n*(n+1)/x^2 - 1", "integer", 1), ("x^2 - n", "odd", 1)],
)
def test_an_answer_for_all_values_with_assumptions_says_its_case(S: str, assume: str, case: int) -> None:
    """omega depends on n, so there is no certificate; but it isn't undecided, and the shell says so by its exit status."""
    answer = kovacic.solve(S, var="x", assume={"n": assume})
    assert answer.assumed
    assert f"case {case} for all values with n {assume}" in str(answer)
    assert "undecided" not in str(answer).lower()
    assert kovacic.decide(S, var="x", assume={"n": assume}).case == case
    assert run(["solve", "--no-solutions", "--assume", f"n={assume}", S]) == 0


# ------------------------------------------------------------------------------- assumptions that contradict one another

#: Assumptions, with admitted numbers of a sample; two that have none in common contradict one another.
SAMPLE = [Fraction(k, 6) for k in range(-18, 19)]
ASSUMED = {
    "positive": lambda a: a > 0,
    "negative": lambda a: a < 0,
    "nonnegative": lambda a: a >= 0,
    "nonpositive": lambda a: a <= 0,
    "nonzero": lambda a: a != 0,
    "integer": lambda a: a.denominator == 1,
    "natural": lambda a: a.denominator == 1 and a >= 0,
    "even": lambda a: a.denominator == 1 and a % 2 == 0,
    "odd": lambda a: a % 2 == 1,
    "half-integer": lambda a: a.denominator == 2,
    "noninteger": lambda a: a.denominator > 1,
    ">=1/2": lambda a: a >= Fraction(1, 2),
    "<1/2": lambda a: a < Fraction(1, 2),
    "<=0": lambda a: a <= 0,
    ">sqrt(2)": lambda a: a * abs(a) > 2,
    "<sqrt(2)": lambda a: a * abs(a) < 2,
}


def test_contradicting_assumptions_are_refused_with_both() -> None:
    refused = 0
    for first, second in combinations(ASSUMED, 2):
        is_possible = any(ASSUMED[first](a) and ASSUMED[second](a) for a in SAMPLE)
        assume = {"a": f"{first} {second}"}
        if is_possible:
            assert read_assumptions(assume, None, ("a",))
            continue
        refused += 1
        with pytest.raises(kovacic.InputError, match=r"contradict one another: .* and "):
            read_assumptions(assume, None, ("a",))
    assert refused == 23


@pytest.mark.parametrize("door", [kovacic.conditions, kovacic.solve])
def test_a_contradiction_is_refused_before_anything_is_answered(door: Callable[..., object]) -> None:
    with pytest.raises(kovacic.InputError, match="the assumptions on a contradict one another: positive and negative"):
        door("a*x^2+1", assume={"a": "positive negative"})
    with pytest.raises(kovacic.InputError, match="positive and even"):
        door(sympy.Symbol("a", positive=True) * sympy.Symbol("x") ** 2 + 1, assume={"a": "even <2"})


def test_the_command_refuses_contradicting_assumptions(capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("conditions", "solve"):
        assert run([command, "a*x^2+1", "--assume", "a=positive", "--assume", "a=negative"]) == 2
        captured = capsys.readouterr()
        assert not captured.out
        assert "positive and negative" in captured.err


def test_natural_numbers_are_known() -> None:
    answer = kovacic.conditions("x^2 + n", assume={"n": "natural"})
    assert str(answer.assumptions) == "n nonnegative integer"


# ------------------------------------------------------------------------------- the user's letters

#: Equations with constants that aren't rational in symbols: the user's parameters, values with a solution and without.
LETTERED = {
    "x^2+sqrt(a)*x+b": (("a", "b"), {"a": 4, "b": 2}, {"a": 4, "b": 3}),
    "x^2+sqrt(a)*x+a": (("a",), {"a": "4/3"}, {"a": 1}),
    "y''+sqrt(a)*y'+b*x*y=0": (("a", "b"), {"a": 2, "b": 0}, {"a": 2, "b": 1}),
    "a^(1/3)*x+b*x^2": (("a", "b"), {"a": 8, "b": 1}, {"a": 27, "b": 1}),
    "2^a*x+1": (("a",), None, {"a": 2}),
    "exp(a)*x+1": (("a",), None, None),
    "x^2+b+exp(a)": (("a", "b"), None, None),
    "x^2+sqrt(a+b)*x+1": (("a", "b"), {"a": 0, "b": 0}, {"a": 1, "b": 0}),
    "a*exp(-x)+exp(a)*b": (("a", "b"), None, None),
}


@parametrize("S", LETTERED, ordinary=(0, 1, 4), long=2)
def test_letters_are_the_users(S: str) -> None:
    names, solvable, unsolvable = LETTERED[S]
    answer = kovacic.conditions(S, var="x")
    assert {*answer.parameters} == {*names}
    for text in (str(answer), answer.theorem(), answer.explain(), answer.latex()):
        assert not re.search(r"sqrt_|exp_|c_2|a_1", text)
        assert "exp(a/2) = 0" not in text
        assert not re.search(r"\((a\^\(1/3\)|2\^a|2\^\(a/2\))\)(?!\^)", text)
        assert not re.search(r"(exp\(a/2\)|sqrt\(a\)|\^\(?a/2\)+)\^2", text)
    if solvable is not None:
        assert answer.case_at(solvable) is not None
    if unsolvable is not None:
        assert answer.case_at(unsolvable) is None
    for region in answer.regions:
        for solution in region.solution():
            assert {symbol.name for symbol in solution.y.free_symbols} <= {"x", *names}
    read = Conditions.from_json(answer.to_json())
    assert read == answer
    assert read.theorem() == answer.theorem()
    assert answer.check(20)


@pytest.mark.parametrize(
    ("S", "said"),
    [
        ("x^2 + sqrt(n)*x + b", "b = (8*N + n + 4)/4 for an integer N: case 1"),
        ("(-1)^n/x^2 + 1", "(-1)^n = N^2 + N for an integer N: case 1"),
        ("n^(1/3)/x^2 + 1 + k/x", "n^(1/3) = (2*N - k)*(2*N - k + 2)/4 for an integer N: case 1"),
    ],
)
def test_no_integer_is_called_like_a_parameter_inside_a_function(S: str, said: str) -> None:
    assert said in str(kovacic.conditions(S))


def test_a_value_that_makes_a_letter_transcendental_is_refused() -> None:
    with pytest.raises(kovacic.InputError, match=r"exp\(a/2\) is exp\(1/2\) there"):
        kovacic.conditions("exp(a)*x+1").case_at({"a": 1})

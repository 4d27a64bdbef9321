"""Conditions as data: every kind of statement is written and read back, and says the same at points."""

from __future__ import annotations

import json
from contextlib import suppress
from fractions import Fraction
from random import Random
from typing import Any

import pytest
import sympy
from build import Conditions, parametrize
from parametric_cases import FAMILIES, hypergeometric

import kovacic

EQUATIONS = {
    **{family.name: family.S for family in FAMILIES},
    "Riemann": hypergeometric(("l", "m", "n")),
    "one radical": "(4*a^2-1)/(4*x^2) - b - sqrt(2)",
    "a cube root": "x^4 + a*x^2 + 2^(1/3)*b*x",
    "the imaginary unit": "(n^2 - 1/4)/x^2 + I*k/x - 1",
    "two radicals": "(4*a^2-1)/(4*x^2) - b - sqrt(2) - sqrt(3)",
    "quartic": "x^4 + a*x^2 + b*x + c",
    "Coulomb": "-2*E - 2*Z/x + l*(l+1)/x^2",
    "sextic with a centrifugal term": "x^6 + a*x^2 + c + l*(l+1)/x^2",
}


#: Families with an algebraic constant, in x and in functions of x; parameters come in the order in which they occur.
CONSTANTS = ("sqrt(2)", "2^(1/3)", "I", "(sqrt(2) + sqrt(3))")
FUNCTIONS = ("x", "exp(x)", "cosh(2*x)", "sin(x)", "tan(x)")
SHAPES = ("(a*{f} - {c})^2 - E", "y'' + a*{c}*y' + b*{f}*y = 0", "b*{c}*{f} + a")
EQUATIONS |= {(text := shape.format(f=f, c=c)): text for f in FUNCTIONS for c in CONSTANTS for shape in SHAPES}
EQUATIONS |= {(text := f"{c}*x^(2*n) + b/x^2"): text for c in CONSTANTS}


@parametrize(
    "name", EQUATIONS, ordinary=4, long=2, always=["(a*cosh(2*x) - sqrt(2))^2 - E", "b*(sqrt(2) + sqrt(3))*exp(x) + a"]
)
def test_conditions_are_read_back(name: str) -> None:
    answer = kovacic.conditions(EQUATIONS[name], var="x", max_degree=0)
    again = Conditions.from_json(answer.to_json())
    assert again.to_dict() == answer.to_dict()
    assert again.text(all=True) == answer.text(all=True)
    random = Random(3)
    for _ in range(30):
        point = {name: Fraction(random.randint(-12, 12), random.choice((1, 2, 4))) for name in answer.parameters}
        with suppress(kovacic.InputError):  # a value at which the equation is none
            assert again.case_at(point) == answer.case_at(point)


def test_a_lattice_is_written_as_one() -> None:
    (region,) = json.loads(kovacic.conditions("(4*n^2-1)/(4*x^2) - 1").to_json())["regions"]
    assert region["statement"] == {"kind": "lattice", "form": "(2*n - 1)/2", "modulus": 1}


@pytest.mark.parametrize(
    "change", [{"kind": "else"}, {"kind": "zero"}, {"kind": "lattice", "form": "1/", "modulus": 1}]
)
def test_wrong_data_are_refused(change: dict[str, Any]) -> None:
    data = json.loads(kovacic.conditions("(4*n^2-1)/(4*x^2) - 1").to_json())
    data["regions"][0]["statement"] = change
    with pytest.raises(kovacic.InputError):
        Conditions.from_json(json.dumps(data))
    with pytest.raises(kovacic.InputError):
        Conditions.from_json("{")


@pytest.mark.long
def test_the_root_that_is_meant_is_read_back() -> None:
    for root in ("sqrt(2)", "-sqrt(2)", "sqrt(2) + sqrt(3)", "sqrt(2) - 2*sqrt(3)"):
        answer = kovacic.conditions(f"x^2 + b + ({root})", var="x")
        again = Conditions.from_json(answer.to_json())
        for value, case in ((f"1 - ({root})", 1), (f"1 + ({root})", None), (f"-3 - ({root})", 1), ("1/2", None)):
            assert again.case_at({"b": value}) == answer.case_at({"b": value}) == case
    data = kovacic.conditions("x^2 + b + sqrt(2)", var="x").to_dict()
    for wrong in ("t**2 - 4", "t - 1", "(t**2 - 2)**2"):
        root = data["constant_root"] | {"minimal_polynomial": wrong}
        with pytest.raises(kovacic.InputError):
            Conditions.from_json(json.dumps(data | {"constant_root": root}))


@pytest.mark.long
def test_several_algebraic_values_beside_an_algebraic_constant() -> None:
    answer = kovacic.conditions("(4*a^2-1)/(4*x^2) - b - sqrt(2) - sqrt(3)", var="x")
    for a, b, case in (
        ("sqrt(5)", "-sqrt(2) - sqrt(3)", 1),
        ("sqrt(5)", "-sqrt(2) + sqrt(3)", None),
        ("I", "sqrt(2)", None),
        ("1/2", "sqrt(2)", 1),
        ("sqrt(2)*sqrt(6)/sqrt(3)/4", "2^(1/3)", 1),
    ):
        assert answer.case_at({"a": a, "b": b}) == case
        assert answer.case_at({"a": sympy.sympify(a), "b": sympy.sympify(b.replace("^", "**"))}) == case


def test_a_changed_statement_is_another_answer() -> None:
    answer = kovacic.conditions("(4*n^2-1)/(4*x^2) - 1")
    data = json.loads(answer.to_json())
    data["regions"][0]["statement"]["form"] = "n"
    wrong = Conditions.from_json(data)
    assert wrong != answer
    assert not wrong.check(20)

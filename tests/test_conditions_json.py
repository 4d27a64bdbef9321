"""Conditions as data: every kind of statement is written and read back, and says the same at points."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest

import kovacic
from kovacic.parametric import sampling
from kovacic.parametric.answer import Conditions
from tests.parametric_cases import FAMILIES, hypergeometric

EQUATIONS = {
    **{family.name: family.S for family in FAMILIES},
    "Riemann": hypergeometric(("l", "m", "n")),
    "quartic": "x^4 + a*x^2 + b*x + c",
    "Coulomb": "-2*E - 2*Z/x + l*(l+1)/x^2",
    "sextic with a centrifugal term": "x^6 + a*x^2 + c + l*(l+1)/x^2",
}


@pytest.mark.parametrize("name", EQUATIONS)
def test_conditions_are_read_back(name: str) -> None:
    answer = kovacic.conditions(EQUATIONS[name], var="x", max_degree=0)
    again = Conditions.from_json(answer.to_json())
    assert again.to_dict() == answer.to_dict()
    assert again.text(all=True) == answer.text(all=True)
    statements = [region.statement for region in answer.regions]
    points = sampling.points(statements, answer.constant, answer.parameters, answer.assumptions, Random(3))
    for point in (next(points) for _ in range(30)):
        if point is not None:
            assert again.predicted(point) == answer.predicted(point)


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


def test_a_changed_statement_is_another_answer() -> None:
    answer = kovacic.conditions("(4*n^2-1)/(4*x^2) - 1")
    data = json.loads(answer.to_json())
    data["regions"][0]["statement"]["form"] = "n"
    wrong = Conditions.from_json(data)
    assert wrong != answer
    assert not wrong.check(20)

"""Numbers of more than 4,300 digits, which Python doesn't convert: in and out, through every view and the command."""

from __future__ import annotations

import json
import subprocess
import sys

import jsonschema
import pytest

import kovacic
from kovacic import checker
from kovacic.numerals import digits

N = 10**5000 + 7
TEXT = digits(N)

EQUATIONS = {
    "exponents": f"(1/{TEXT}^2 - 1/{TEXT})/x^2",
    "far apart": f"{TEXT}*({TEXT} + 1)/x^2",
    "degree": f"x^2 + {TEXT}",
    "Legendre": f"(1 - x^2)*y'' - 2*x*y' + {TEXT}*({TEXT} + 1)*y = 0",
}


@pytest.mark.slow
@pytest.mark.parametrize("equation", EQUATIONS.values(), ids=EQUATIONS.keys())
def test_every_view_of_an_answer(equation: str) -> None:
    answer = kovacic.solve(equation)
    line = answer.to_json(full=True)
    assert kovacic.Solution.from_json(line) == answer
    verdict = checker.verdict(line)
    assert verdict.startswith("not checked" if answer.case is None else "checked")
    for text in (str(answer), answer.explain(), answer.explain(format="latex"), answer.explain(format="markdown")):
        assert text
    assert answer._repr_latex_()


def test_the_group_of_a_root_of_high_order() -> None:
    """y = x^(1/N), whose group has N elements: its order is a text in JSON."""
    answer = kovacic.solve(EQUATIONS["exponents"])
    assert answer.group is not None
    assert answer.group.name == f"mu_{TEXT}"
    line = answer.to_json(full=True)
    data = json.loads(line)
    assert data["group"]["order"] == data["group"]["n"] == TEXT
    jsonschema.validate(data, json.loads(_schema()))
    assert checker.verdict(line).startswith("checked")
    data["group"]["n"] = digits(N + 1)
    assert checker.verdict(json.dumps(data)).startswith("refuted")


def _schema() -> str:
    from importlib.resources import files

    return (files("kovacic") / "views" / "schema.json").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_command() -> None:
    equation = EQUATIONS["exponents"]
    command = [sys.executable, "-m", "kovacic"]
    solved = subprocess.run(
        [*command, "solve", "--json", "--full", equation], capture_output=True, text=True, timeout=60
    )
    assert solved.returncode == 0
    checked = subprocess.run([*command, "check", "-"], input=solved.stdout, capture_output=True, text=True, timeout=60)
    assert checked.returncode == 0
    shown = subprocess.run([*command, "solve", equation], capture_output=True, text=True, timeout=60)
    assert shown.returncode == 0

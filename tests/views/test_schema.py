"""One published schema describes every line of JSON that any command prints: on real output."""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from build import parametrize, run

import kovacic

EQUATIONS = [
    "x^2 + 3",
    "x",
    "1/x - 3/(16*x^2)",
    "2",
    "-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))",
    "0",
    "sqrt(2)*x + I",
    "(4*n^2-1)/(4*x^2) - 1",
    "x^2*y'' + x*y' + (x^2 - 1/4)*y = exp(x)",
]
WRONG = ['{"S": "x+", "id": [1, {"a": null}]}', '{"id": 3}', "5", '{"S": 5}', "not json", '{"S": "x/0"}', "\x00"]
#: None of their solutions is known, proven for Liouvillian ones: with values and as a Riccati equation, too.
WITHOUT = ["y'' = (x^5+1/x^3)*y", "y'' = (x^5+1/x^3)*y, y(1)=1", "w' = x^5 + 1/x^3 + w^2"]
BALL = ["--mass", "1", "--radius", "1", "--sphere", "3"]


@pytest.fixture(scope="module")
def schema() -> dict[str, Any]:
    return json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text("utf-8"))


@pytest.fixture
def validator(schema: dict[str, Any]) -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def printed(capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0) -> Iterator[dict[str, Any]]:
    assert run(arguments) == status
    return map(json.loads, capsys.readouterr().out.splitlines())


def test_the_command_prints_it(schema: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["schema"]) == 0
    assert json.loads(capsys.readouterr().out) == schema


def test_lines_of_solve(validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]) -> None:
    lines = [
        *printed(capsys, "solve", "--json", *EQUATIONS),
        *printed(capsys, "solve", "--json", "--full", *EQUATIONS[:4]),
        *printed(capsys, "solve", "--json", "x^2-100001", "--limit", "unknown_degree=9"),
        *printed(capsys, "solve", "--json", "x^6+105*x^2", "--limit", "unknown_degree=9"),
        *printed(capsys, "solve", "--json", "x^4 + x^2 + 42*x + 1/4", "--limit", "unknown_degree=9", status=3),
    ]
    assert len(lines) == len(EQUATIONS) + 7
    for line in lines:
        validator.validate(line)


def test_lines_of_bad_input(
    validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Every text has its line, in order, with a hint for the command line."""
    bad, ambiguous, good, large = printed(capsys, "solve", "--json", "1/2x", "a*b", "x", "x^100001", status=2)
    assert (bad["input"], bad["error"]["position"], bad["error"]["hint"]) == ("1/2x", 0, "write 1/(2x) or (1/2)*x")
    assert ambiguous["error"]["hint"] == "name it: --var a; the others are parameters"
    assert (good["status"], large["status"]) == ("none", "undecided")
    for line in (bad, ambiguous, good, large):
        validator.validate(line)
    answers = tmp_path / "answers.jsonl"
    answers.write_text("".join(json.dumps(line) + "\n" for line in (bad, good, large)))
    run(["check", str(answers)])
    said = [line.split(": ")[1] for line in capsys.readouterr().out.splitlines()[:3]]
    assert said == ["not checked", "checked", "not checked"]


def test_lines_of_dsolve(validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]) -> None:
    (general,) = printed(capsys, "dsolve", "--json", "y'' + y = x")
    (special,) = printed(capsys, "dsolve", "--json", "w'' + w = 0, w(0)=1, w'(0)=0")
    (also,) = printed(capsys, "dsolve", "--json", "y'' + y = 0", "--ics", "y(0)=1, y'(0)=0")
    none = [line for text in WITHOUT for line in printed(capsys, "dsolve", "--json", text)]
    (bad,) = printed(capsys, "dsolve", "--json", "y'' + y = x+", status=2)
    (late,) = printed(capsys, "dsolve", "--json", "y'' = x*y", "--limit", "seconds=0.000001", status=3)
    assert (general["unknown"], general["solution"]) == ("y(x)", "C1*cos(x) + C2*sin(x) + x")
    assert (special["solution"], also["solution"], also["ics"]) == ("cos(x)", "cos(x)", "y(0)=1, y'(0)=0")
    assert [line["status"] for line in none] == ["none"] * len(WITHOUT)
    assert (bad["status"], late["status"]) == ("error", "undecided")
    for line in (general, special, also, *none, bad, late):
        validator.validate(line)


def test_lines_of_evaluate(validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]) -> None:
    """The disc contains the value of cos(2 x), and that of a solution far beyond the doubles is written out."""
    start = ["--x0", "0", "--y0", "1", "--dy0", "0"]
    near, far = printed(capsys, "evaluate", "--json", "-k^2", "--param", "k=2", "--var", "x", *start, "--at", "1/2,1+I")
    (huge,) = printed(capsys, "evaluate", "--json", "x", *start, "--at", "2000")
    assert abs(float(near["y"]["re"]) - math.cos(1)) < 1e-15
    assert abs(complex(float(far["y"]["re"]), float(far["y"]["im"])) - cmath.cos(2 + 2j)) < 1e-13
    assert float(near["y"]["radius"]) < 1e-15
    assert near["x"] == "1/2"
    assert Decimal(huge["y"]["re"]) > 10**20000
    for line in (near, far, huge):
        validator.validate(line)


@pytest.mark.long
def test_lines_of_batch(
    tmp_path: Path, validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]
) -> None:
    source, slow = tmp_path / "in.jsonl", tmp_path / "slow.jsonl"
    good = [json.dumps({"S": S, "id": k}) for k, S in enumerate([*EQUATIONS, "x^100001"])]
    source.write_text("\n".join([*good, *WRONG]) + "\n")
    slow.write_text(json.dumps({"S": "(x+1)^15000/(x^3000-x-1)", "id": "slow"}) + "\n")
    lines = list(printed(capsys, "batch", str(source), "-q", "--group", "--timeout", "60", status=2))
    assert [line["line"] for line in lines] == list(range(1, len(good) + len(WRONG) + 1))
    assert [line["status"] for line in lines[len(EQUATIONS) :]] == ["undecided", *["error"] * len(WRONG)]
    late = list(printed(capsys, "batch", str(slow), "-q", "--group", "--timeout", "1", status=3))
    assert [line["status"] for line in late] == ["undecided"]
    for line in lines + late:
        validator.validate(line)


@pytest.mark.long
def test_lines_of_scan(validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]) -> None:
    lines = list(printed(capsys, "scan", "x^2 + 1/n", "n=-1:1:1/2", "-q", status=2))
    assert [line["parameters"]["n"] for line in lines] == ["-1", "-1/2", "0", "1/2", "1"]
    for line in lines:
        validator.validate(line)


@parametrize("S", ["(4*n^2-1)/(4*x^2) - 1", "x^4 + mu*x", "x^2 + n", "1/(n*x)", "x^6 + a*x^2 + b"], ordinary=1)
def test_lines_of_conditions(
    S: str, validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]
) -> None:
    (line,) = printed(capsys, "conditions", "--json", S)
    validator.validate(line)


@pytest.mark.long
def test_conditions_that_are_not_complete(validator: jsonschema.Draft202012Validator) -> None:
    heun = "a/x^2 + b/(x-1)^2 + c/(x-t)^2 + (e*x+q)/(x*(x-1)*(x-t))"
    answer = kovacic.conditions(heun, var="x", limits=kovacic.Limits(seconds=0.5))
    assert answer.complete is not True
    validator.validate(answer.to_dict())


@parametrize(
    "arguments",
    [["--ratio", "3/2"], ["--ratio", "1/3", "--latex"], BALL, [*BALL, "--simulate", "--time", "1"]],
    ids=str,
    ordinary=0,
    long=2,
)
def test_lines_of_ball(
    arguments: list[str], validator: jsonschema.Draft202012Validator, capsys: pytest.CaptureFixture[str]
) -> None:
    (line,) = printed(capsys, "ball", "--json", *arguments)
    validator.validate(line)


@parametrize(
    "line",
    [{}, {"line": 1}, {"line": 1, "schema": 1, "input": "x", "status": "error"}, {"S": "x", "variable": "x"}, [], "x"],
    ordinary=1,
    long=3,
    ids=str,
)
def test_other_lines_are_refused(line: object, validator: jsonschema.Draft202012Validator) -> None:
    with pytest.raises(jsonschema.ValidationError):
        validator.validate(line)

"""Every door says what was guessed when a text was read, and nothing where nothing was: guesses and doors, each with each.

`solve`, `conditions` and `spectrum` have notes; `dsolve` and `evaluate`, which return bare answers, warn.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest
from build import read_input, run

import kovacic
from kovacic import InputError

#: Texts of functions, with what is said of them.
GUESSED = {
    "a^1/2*x^2": "a root is written ^(1/2)",
    "xa + x^2": "xa was read as x*a",
    "i*x^2 + a": "the imaginary unit is I",
    "x^2^1/3 + a": "a root is written ^(1/3)",
}
CERTAIN = ("a^(1/2)*x^2", "a*x + x^2", "2*x^2 + a", "a*x^2")
#: What may stand around an equation.
AROUND = {"3. {}": "number in a list", "Solve the equation {}": "left out", "Consider {}": "left out"}
VALUES = {"a": "1", "i": "2"}


def warned(ask: Callable[[], object]) -> list[str]:
    with warnings.catch_warnings(record=True, action="always") as found:
        ask()
    return [str(warning.message) for warning in found]


def params(text: str) -> dict[str, str]:
    return {
        name: value for name, value in VALUES.items() if name in text.replace("Consider", "").replace("equation", "")
    }


def evaluated(text: str, names: str) -> list[str]:
    return warned(lambda: kovacic.evaluate(text, 2, x0=1, y0=1, dy0=0, params=params(names)))


DOORS: dict[str, Callable[[str], list[str]]] = {
    "solve": lambda S: list(kovacic.solve(S).notices),
    "solve, an equation": lambda S: list(kovacic.solve(f"y'' = ({S})*y").notices),
    "conditions": lambda S: list(kovacic.conditions(S, var="x").notices),
    "spectrum": lambda S: list(kovacic.spectrum(S).notices),
    "spectrum, an equation": lambda S: list(kovacic.spectrum(f"-y'' + ({S})*y = E*y").notices),
    "evaluate": lambda S: evaluated(S, S),
    "dsolve": lambda S: warned(lambda: kovacic.dsolve(f"y'' = ({S})*y")),
    "dsolve, first order": lambda S: warned(lambda: kovacic.dsolve(f"y' = ({S})*y")),
    "dsolve, a system": lambda S: warned(lambda: kovacic.dsolve(f"y' = z + ({S})*0, z' = y")),
}


@pytest.mark.parametrize("door", DOORS)
def test_every_door_says_what_was_guessed(door: str) -> None:
    for S, note in GUESSED.items():
        assert any(note in said for said in DOORS[door](S)), S
    for S in CERTAIN:
        found = DOORS[door](S)
        assert not any(word in said for said in found for word in ("was read as", "imaginary unit", "left out")), found


@pytest.mark.parametrize("around", AROUND)
def test_every_door_says_what_was_left_out(around: str) -> None:
    text = around.format("y'' + a*y = 0")
    note = AROUND[around]
    found = {
        "solve": kovacic.solve(text).notices,
        "conditions": kovacic.conditions(text).notices,
        "spectrum": kovacic.spectrum(around.format("-y'' + x^2*y = E*y")).notices,
        "evaluate": evaluated(text, "a"),
        "dsolve": warned(lambda: kovacic.dsolve(text)),
        "dsolve, values": warned(lambda: kovacic.dsolve(f"{text}, y(0) = 1, y'(0) = 0")),
    }
    for door, said in found.items():
        assert any(note in each for each in said), door


def test_the_command_says_it_too(capsys: pytest.CaptureFixture[str]) -> None:
    for S, note in GUESSED.items():
        for command in (["solve", S], ["conditions", S, "--var", "x"], ["spectrum", S]):
            assert run(command) == 0
            assert note in capsys.readouterr().out
    assert run(["solve", "--json", "a^1/2*x^2"]) == 0
    assert any("a root" in note for note in json.loads(capsys.readouterr().out)["notices"])


READINGS = [
    json.loads(line) for line in (Path(__file__).parents[1] / "data" / "readings.jsonl").read_text("utf-8").splitlines()
]


@pytest.mark.parametrize(("text", "said"), [tuple(row.values()) for row in READINGS], ids=range(len(READINGS)))
def test_what_is_read_and_what_is_said_of_it(text: str, said: list[str]) -> None:
    """The equation and the notices, or the kind of the error and all of its message, with its position and its hint."""
    try:
        read = read_input(text, exponentials=True)
        found = [str(read.equation or read.S), read.variable, *read.notices]
    except InputError as error:
        found = [type(error).__name__, str(error)]
    assert found == said

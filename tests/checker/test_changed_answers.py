"""Whatever is changed in an answer, left out or said twice: the checker refutes it, or says that it didn't look at it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from build import parametrize
from documents import ROOT
from published import load

import kovacic
from kovacic import checker

Path = tuple[Any, ...]

#: With S, with an equation, with a gauge, with a constant, a group on a curve, parameters, square roots and exponentials.
ANSWERS = [
    "2",
    "x",
    "x^2 + 3",
    "1/x - 3/(16*x^2)",
    "-27*x/(8*(x^3-2)^2)",
    "-(5*x^2 + 27)/(36*(x^2-1)^2)",
    "y'' = x*y",
    "x^2*y'' + x*y' + (x^2 - 1/4)*y = exp(x)",
    "x^2*y'' - 2*x*y' + 2*y = x",
    "y'' + sqrt(2)/x*y' - y = 0",
    "y'' + exp(2*x)*y = 0",
    "a/x^2",
    "sqrt(2)/x^2",
    "-3/16/x^2 - 3/16/(x-sqrt(2))^2 + 3/16/x/(x-sqrt(2))",
    "(sqrt(2)*x + 1)/(x^2 - sqrt(3))^2",
]
WRONG = [None, True, 3, -1, 0.5, "7", "t", "", [], {}, ["x"], 10**30, "1/0", "y'' + (", "infinity", "\ud800\n"]

#: Keys without which the answer claims less, or which are absent in answers of older versions.
MAY_BE_ABSENT = {"field", "near", "letters", "generic_conditions", "group", "solutions", "family", "n", "change"}
#: Fewer places may prove the same, and one order with the absence of a form.
FEWER = {"places", "orders"}
#: Another prime, point or place may prove the same; another rational form may be one; names may be others.
MAY_BE_OTHERS = {"prime", "point", "place", "places", "invariant", "variable", "symbol"}


def paths(data: Any, prefix: Path = ()) -> Iterator[Path]:
    """Every place inside of a JSON object."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*prefix, key)
        yield from paths(value, (*prefix, key))


def at(data: Any, path: Path) -> Any:
    for key in path:
        data = data[key]
    return data


def others(value: Any) -> Iterator[Any]:
    """Values of other kinds, and near ones."""
    yield from WRONG
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + 1, value - 1, 2 * value, float(value), str(value))
    elif isinstance(value, str):
        yield from (f"({value}) + 1", f"({value})*x", f"{value}_")
        yield from (f"2*({value})", f"-({value})") if value != "0" else ()
    elif isinstance(value, list) and value:
        yield from (value[:-1], value + value[-1:])


def is_named(path: Path, said: str) -> bool:
    """Does the verdict name this place among what wasn't looked at?"""
    named = said.partition("; not checked: ")[2].split(", ")
    if path[0] in named or ".".join(map(str, path[:2])) in named:
        return True
    return path[-1] == "degree" and "excluded" in path and "degree of no_rational_omega" in named


def changed(line: str, path: Path) -> Iterator[tuple[str, Any, str]]:
    """What is done at this place, and the line in which it is: another value, no value, or the key a second time."""
    value = at(json.loads(line), path)
    for other in others(value):
        data = json.loads(line)
        at(data, path[:-1])[path[-1]] = other
        if repr(other) != repr(value) and (other != "0" or value != "0"):
            yield "changed", other, json.dumps(data)
    data = json.loads(line)
    del at(data, path[:-1])[path[-1]]
    yield "left out", None, json.dumps(data)
    if isinstance(path[-1], str):
        data = json.loads(line)
        at(data, path[:-1])["the key again"] = value
        yield "twice", None, json.dumps(data).replace('"the key again"', json.dumps(path[-1]))


def may_pass(path: Path, what: str, value: Any, other: Any) -> bool:
    """Is the answer possibly a right one all the same?"""
    if what == "left out":
        key = path[-1] if isinstance(path[-1], str) else path[-2]
        return key in MAY_BE_ABSENT or key in FEWER or (key in ("equation", "gauge") and value is None)
    if what == "twice":
        return False
    if path[0] == "solutions":  # nothing is claimed, or the checker proves what stands there now, a multiple for one
        return True
    same_zero = value == "0" and isinstance(other, str) and "*x" in other
    shorter = path[-1] in FEWER and other == value[:-1]
    return same_zero or shorter or not MAY_BE_OTHERS.isdisjoint(path)


def look(line: str) -> int:
    """Change everything; how many lines were judged."""
    judged = 0
    for path in paths(json.loads(line)):
        value = at(json.loads(line), path)
        for what, other, text in changed(line, path):
            said = checker.verdict(text)
            judged += 1
            assert "\n" not in said
            if said.startswith("checked: ") and not is_named(path, said):
                assert may_pass(path, what, value, other), (path, what, value, other, said)
            elif what == "twice":
                assert said == "unreadable: a key occurs twice in one object"
    return judged


@parametrize("text", ANSWERS, ordinary=0, long=1)
def test_a_change_is_refuted_or_named(text: str) -> None:
    assert look(kovacic.solve(text).to_json(full=True)) > 300


@pytest.mark.slow
def test_changes_of_published_and_textbook_answers_are_refuted_or_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    from closed_forms import TEXTBOOK

    texts = [*(entry.S for entry in load()), *TEXTBOOK][::12]
    assert sum(look(kovacic.solve(text).to_json()) for text in texts) > 10_000


def test_a_constant_whose_polynomial_has_factors_is_refuted() -> None:
    """omega = c with c^2 = 1 would be two solutions of y'' = y at once."""
    data = json.loads(kovacic.solve("2").to_json())
    for S, modulus in (("1", "c**2 - 1"), ("6", "c**2 - 6")):
        data |= {"S": S, "input": S, "constants": {"symbol": "c", "minimal_polynomial": modulus}}
        said = checker.verdict(json.dumps(data))
        assert said.startswith("checked: ") == (S == "6"), said
    assert "irreducible" in checker.verdict(json.dumps(data | {"S": "4", "input": "4", "constants": {
        "symbol": "c", "minimal_polynomial": "c**2 - 4"}}))  # fmt: skip

"""Is every answer what it was?  Records the answers of one version, and compares another version with the record.

    python benchmarks/answers.py record before.jsonl      # in the old checkout: some minutes
    python benchmarks/answers.py compare before.jsonl     # in the new one: prints what differs; status 1 if anything does

An answer is all that a user can see of it: JSON (without times), text, LaTeX, explanation, the groups, both closed
forms, conditions on parameters, enclosures, general solutions, and for wrong input the message.  The equations are the
published and the textbook ones, 2,000 random ones of the tests' strategies, families with parameters, and texts with a
character removed, doubled or replaced.  `compare` takes the inputs from the record, so that both versions answer the same
questions.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from random import Random
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "tests" / "shared")]

import kovacic  # noqa: E402

RANDOM = 2000
BROKEN = 400
Record = dict[str, Any]


def attempt(view: Callable[[], Any]) -> str:
    """The view as text, or the error that it ends in."""
    try:
        return str(view())
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def answer(text: str) -> Record:
    """Everything that can be seen of one answer."""
    solution = kovacic.solve(text)
    data = json.loads(solution.to_json())
    data.pop("seconds", None)
    return {
        "json": json.dumps(data, sort_keys=True),
        "text": str(solution),
        "latex": attempt(solution._repr_latex_),
        "explained": attempt(solution.explain),
        "group": attempt(lambda: solution.group),
        "equation group": attempt(lambda: repr(solution.equation_group)),
        "closed form": attempt(lambda: solution.solutions),
        "generic": attempt(lambda: solution.generic_conditions),
    }


def family(text: str) -> Record:
    """The conditions on the parameters."""
    return {"conditions": attempt(lambda: kovacic.conditions(text))}


def value(text: str) -> Record:
    """A value to 30 digits, by the general route, and by the closed form where there is one."""
    start = {"x0": "17/16", "y0": 1, "dy0": "1/3", "digits": 30}
    question = kovacic.solve(text)  # the closed form needs its certificate
    return {
        method: attempt(lambda method=method: kovacic.evaluate(question, 1.1875 + 0.125j, method=method, **start))
        for method in ("taylor", "closed form")
    }


def general(text: str) -> Record:
    """The general solution."""
    return {"dsolve": attempt(lambda: kovacic.dsolve(text))}


#: Classes that have another name since a record was made.
RENAMED = {"<Kind.": "<GroupKind."}

KINDS: dict[str, Callable[[str], Record]] = {
    "answer": answer,
    "broken": answer,
    "family": family,
    "value": value,
    "general": general,
}


def examine(question: tuple[str, str]) -> Record:
    """The record of one question: its kind, its text, and the views or the error."""
    kind, text = question
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            views = KINDS[kind](text)
        except Exception as error:
            views = {"error": f"{type(error).__name__}: {error}"}
    return {"kind": kind, "input": text, **views}


def questions() -> Iterator[tuple[str, str]]:
    """All inputs, in a fixed order."""
    import closed_forms
    import parametric_cases
    import textbook_equations

    lines = (HERE.parent / "tests" / "data" / "cases.jsonl").read_text(encoding="utf-8").splitlines()
    published = [json.loads(line)["S"] for line in lines]
    books = [*closed_forms.TEXTBOOK, *(entry.S for entry in textbook_equations.equations())]
    yield from (("answer", text) for text in (*published, *books, *random_equations()))
    yield from (("broken", text) for text in broken_texts(Random(13), [*published, *books]))
    yield from (("family", entry.S) for entry in parametric_cases.FAMILIES)
    yield from (("value", text) for text in published)
    yield from (("general", text) for text in closed_forms.TEXTBOOK)


def random_equations() -> list[str]:
    """Equations of all the tests' strategies, the same on every run of one version."""
    import strategies
    from hypothesis import HealthCheck, Phase, given, settings
    from hypothesis import strategies as st

    found: list[str] = []

    @settings(max_examples=RANDOM, derandomize=True, database=None, deadline=None, phases=[Phase.generate],
              suppress_health_check=list(HealthCheck))  # fmt: skip
    @given(st.one_of(strategies.examples(), strategies.odd_shapes()))
    def collect(example: strategies.Example) -> None:
        found.append(example.S.to_str("x"))

    collect()
    return found


def broken_texts(rng: Random, texts: list[str]) -> list[str]:
    """Texts with one character removed, doubled or replaced; most are wrong, and some still mean something."""
    found = []
    for _ in range(BROKEN):
        text = rng.choice([text for text in texts if len(text) < 80])
        k = rng.randrange(len(text))
        found.append(text[:k] + rng.choice(["", text[k] * 2, *"()+-*/^=',.1xyqI @"]) + text[k + 1 :])
    return found


def recorded(asked: list[tuple[str, str]], jobs: int) -> Iterator[Record]:
    with ProcessPoolExecutor(jobs) as pool:
        yield from pool.map(examine, asked, chunksize=4)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mode", choices=["record", "compare"])
    parser.add_argument("file", type=Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--kind", choices=sorted(KINDS), help="compare these only")
    parser.add_argument("--every", type=int, default=1, help="record or compare every n-th")
    options = parser.parse_args()
    if options.mode == "record":
        with options.file.open("w", encoding="utf-8") as file:
            for record in recorded(list(questions())[:: options.every], options.jobs):
                file.write(json.dumps(record) + "\n")
        return 0
    text = options.file.read_text(encoding="utf-8")
    for former, now in RENAMED.items():
        text = text.replace(former, now)
    before = [json.loads(line) for line in text.splitlines()]
    before = [record for record in before if options.kind in (None, record["kind"])][:: options.every]
    differing = 0
    after = recorded([(record["kind"], record["input"]) for record in before], options.jobs)
    for old, new in zip(before, after, strict=True):
        changed = [key for key in {**old, **new} if old.get(key) != new.get(key)]
        differing += bool(changed)
        for key in changed:
            print(f"{old['kind']} {old['input']}\n  {key}\n    was: {old.get(key)}\n    is:  {new.get(key)}")
    print(f"{len(before)} compared, {differing} differ")
    return 1 if differing else 0


if __name__ == "__main__":
    raise SystemExit(main())

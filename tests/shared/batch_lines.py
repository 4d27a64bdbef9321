"""Lines of a batch, made from what the answer to each has to be."""

from __future__ import annotations

import json
import random
from collections.abc import Iterable

# Minutes of work with numbers that take hundreds of megabytes, most of it in single calls of the C library.
SLOW = "(x + 1)^15000/(x^3000 - x - 1)"

#: What a line can be: its text, and the label of its answer.
KINDS = {
    "good": (json.dumps({"S": "x^2 + 17"}), "case 1"),
    "proof": (json.dumps({"S": "x", "id": "airy"}), "none"),
    "long text": (json.dumps({"S": "x^2 + 17" + " " * 20_000}), "case 1"),
    "long name": (json.dumps({"S": "x", "id": "a" * 90_000}), "none"),
    "wrong key": (json.dumps({"equation": "y'' = (x^2 + 17)*y", "source": "abcabcabc"}), "bad input"),
    "long wrong key": (json.dumps({"equation": "x", "source": "abc" * 7_000}), "bad input"),
    "not JSON": ("y'' = (x^2 + 17)*y", "bad input"),
    "no expression": (json.dumps({"S": "x^2 +"}), "bad input"),
    "slow": (json.dumps({"S": SLOW}), "undecided"),
}

#: A kind, and how many lines of it come in a row.
Run = tuple[str, int]


def lines_of(runs: Iterable[Run]) -> list[str]:
    """The lines of the runs; the first one says that they are JSON."""
    lines = [KINDS["good"][0]]
    for kind, count in runs:
        lines += [KINDS[kind][0]] * count
    return lines


def answers_of(runs: Iterable[Run]) -> list[tuple[int, str]]:
    """The number and the label of the answer to each line."""
    labels = [KINDS["good"][1]]
    for kind, count in runs:
        labels += [KINDS[kind][1]] * count
    return list(enumerate(labels, start=1))


def random_runs(seed: int, count: int) -> list[Run]:
    """Runs with so many lines in all, about; one of them in five hundred is slow or long."""
    chosen = random.Random(seed)
    common = [kind for kind in KINDS if "long" not in kind and kind != "slow"]
    runs = []
    while count > 0:
        rare = chosen.random() < 0.1
        kind = chosen.choice([kind for kind in KINDS if kind not in common] if rare else common)
        length = 1 if rare else chosen.choice((1, 7, 60, 300))
        runs.append((kind, length))
        count -= length
    return runs

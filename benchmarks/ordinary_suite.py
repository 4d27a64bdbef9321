"""Choose the tests of the ordinary suite: few seconds, in which every branch is executed.

    python benchmarks/ordinary_suite.py                  # of all tests not marked `long` or `slow` by hand, in 10 to 20 minutes
    python benchmarks/ordinary_suite.py tests/galois     # of some: arguments for pytest

Needs pytest-cov.  Lists the tests whose branches others execute in less time: those of LONG seconds or more in
tests/data/long_tests.txt, those of SLOW seconds or more in slow_tests.txt.  `tests/conftest.py` marks them so: .ci/run has the
long ones, and a release the slow ones.  The shortest row of a test function isn't slow, so that .ci/run has a row of each.
A test that isn't listed is ordinary.

Method: V. Chvatal, "A greedy heuristic for the set-covering problem", Mathematics of Operations Research 4 (1979).
"""

from __future__ import annotations

import heapq
import json
import os
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
#: Of processor time, measured with coverage: shorter tests cost less than a list of them is worth.
LONG = 0.05
SLOW = 0.5
#: What each test costs beside its own time: its collection, its set-up.
OVERHEAD = 0.003


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """As a plugin of the run: the processor time of each test, a line each, in a file for each process."""
    start = time.process_time()
    result = yield
    line = json.dumps([item.nodeid, time.process_time() - start])
    with Path(os.environ["SECONDS_OF_TESTS"], f"{os.getpid()}.jsonl").open("a", encoding="utf-8") as file:
        print(line, file=file)
    return result


def measured(arguments: list[str]) -> tuple[dict[str, float], dict[str, set[int]]]:
    """The seconds of each test, and the branches that it executes, by numbers."""
    with tempfile.TemporaryDirectory() as folder:
        added = {
            "COVERAGE_FILE": f"{folder}/coverage",
            "KOVACIC_TESTS_BY_LENGTH": folder,
            "PYTHONPATH": os.pathsep.join([str(ROOT / "benchmarks"), os.environ.get("PYTHONPATH", "")]),
            "SECONDS_OF_TESTS": folder,
        }
        options = ["--cov=kovacic", "--cov-branch", "--cov-context=test", "--cov-report="]
        command = [sys.executable, "-m", "pytest", "--quiet", "-n", "auto", "-p", "ordinary_suite", *options]
        if subprocess.run([*command, *arguments], cwd=ROOT, env=os.environ | added, check=False).returncode:
            raise SystemExit("a test fails")
        files = Path(folder).glob("*.jsonl")
        seconds: dict[str, float] = dict(json.loads(line) for f in files for line in f.read_text().splitlines())
        branches, numbers = defaultdict[str, set[int]](set), dict[tuple[int, int, int], int]()
        with sqlite3.connect(f"{folder}/coverage") as store:  # coverage.readthedocs.io/en/latest/dbschema.html
            rows = store.execute(
                "select context, file_id, fromno, tono from arc join context on context.id = context_id"
            )
            for context, *arc in rows:
                number = numbers.setdefault((arc[0], arc[1], arc[2]), len(numbers))
                branches[context.rpartition("|")[0]].add(number)
        return seconds, {test: branches[test] for test in seconds}


def covering(seconds: dict[str, float], branches: dict[str, set[int]]) -> set[str]:
    """Tests that execute all branches: again and again the one with the most new branches in a second."""
    left = set[int]().union(*branches.values())

    def rate(test: str) -> float:
        return -len(branches[test] & left) / (seconds[test] + OVERHEAD)

    queue = sorted((rate(test), test) for test in seconds)
    chosen = set[str]()
    while left:
        # Rates only fall as branches are covered: a test that is still the first with its present rate is the best.
        test = heapq.heappop(queue)[1]
        if queue and (now := rate(test)) > queue[0][0]:
            heapq.heappush(queue, (now, test))
        else:
            chosen.add(test)
            left -= branches[test]
    return chosen


def main() -> None:
    """Write the lists, and print what they save."""
    seconds, branches = measured(sys.argv[1:])
    lengths = dict.fromkeys(covering(seconds, branches), "ordinary")
    functions = {test.partition("[")[0] for test in lengths}
    for test in sorted(seconds.keys() - lengths.keys(), key=seconds.__getitem__):
        function = test.partition("[")[0]
        is_slow = seconds[test] >= SLOW
        # .ci/run looks for long tests in tests/; docstrings are tested where they stand.
        if seconds[test] < LONG or not test.startswith("tests/"):
            lengths[test] = "ordinary"
        else:  # the shortest row of a function, which may state what no other does, is never slow
            lengths[test] = "slow" if is_slow and function in functions else "long"
        functions.add(function)
    for name in ("long", "slow"):
        listed = sorted(test for test, length in lengths.items() if length == name)
        (ROOT / f"tests/data/{name}_tests.txt").write_text("".join(f"{test}\n" for test in listed), encoding="utf-8")
        saved = sum(seconds[test] for test in listed)
        print(f"{len(listed)} of {len(seconds)} tests are {name}, with {saved:.0f} of {sum(seconds.values()):.0f} s")


if __name__ == "__main__":
    main()

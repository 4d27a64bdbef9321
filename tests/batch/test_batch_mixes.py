"""Whatever the lines of a batch are, good, bad, long or slow, every one of them is answered, and once."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from batch_lines import KINDS, SLOW, Run, answers_of, lines_of, random_runs
from build import generated
from hypothesis import example, given
from hypothesis import strategies as st
from processes import finished

import kovacic
from kovacic.batch.files import read_items
from kovacic.batch.pool import Pool
from kovacic.batch.records import Item, Job, Record, label_of

Pools = Callable[[int], Pool]

_JOB = Job(timeout=0.5)


@pytest.fixture(scope="module")
def pools() -> Iterator[Pools]:
    """A pool with so many processes, kept for the next example."""
    kept: dict[int, Pool] = {}

    def pool(jobs: int) -> Pool:
        return kept.setdefault(jobs, Pool(jobs, _JOB))

    yield pool
    for one in kept.values():
        one.close()


def items(runs: list[Run]) -> Iterator[Item]:
    return read_items(io.BytesIO("\n".join(lines_of(runs)).encode()))


def verdicts(records: list[Record]) -> list[tuple[int, str]]:
    return [(record.number, record.label) for record in records]


_RUNS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from([kind for kind in KINDS if kind != "slow"]), st.integers(1, 40)),
        st.tuples(st.sampled_from(["wrong key", "not JSON"]), st.integers(500, 900)),
        st.just(("slow", 1)),
    ),
    max_size=4,
)


@pytest.mark.long
@generated(6)
@given(_RUNS, st.sampled_from([1, 2, 8]), st.booleans(), st.booleans())
@example([("wrong key", 2000)], 1, True, False)
@example([("slow", 1), ("long wrong key", 40)], 2, True, False)
@example([("long wrong key", 600)], 1, True, True)
def test_every_line_is_answered_once(pools: Pools, runs: list[Run], jobs: int, ordered: bool, stream: bool) -> None:
    pool = pools(jobs)
    records = finished(lambda: list(pool.run(items(runs), ordered=ordered, stream=stream)))
    found = verdicts(records)
    assert (found if ordered else sorted(found)) == answers_of(runs)


@pytest.mark.long
def test_bad_lines_without_end_keep_nobody_from_his_answer_nor_from_his_time_limit() -> None:
    """An input that never ends, all of it refused but for two lines, one of which is slow."""

    def lines() -> Iterator[object]:
        yield {"S": SLOW}
        yield {"S": "x"}
        while True:
            yield {"equation": "x"}

    records = kovacic.solve_many(lines(), jobs=2, timeout=0.5, ordered=False)

    def wanted() -> dict[int, str]:
        found: dict[int, str] = {}
        for record in records:
            if record.number < 3:
                found[record.number] = record.label
            if len(found) == 2:
                break
        return found

    assert finished(wanted) == {1: "undecided", 2: "none"}
    records.close()  # type: ignore[attr-defined]


@pytest.mark.long
def test_a_named_pipe_is_answered_while_it_is_silent(tmp_path: Path) -> None:
    """As `kovacic batch <(generate)`: the first answer comes before the second line."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    arguments = [sys.executable, "-m", "kovacic", "batch", str(path), "-j", "1", "-q"]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        with path.open("w") as lines:
            for text, case in (("x^2 + 3", 1), ("x", None)):
                print(text, file=lines, flush=True)
                assert json.loads(finished(process.stdout.readline))["case"] == case
        assert process.wait() == 0


@pytest.mark.slow
@pytest.mark.parametrize("jobs", range(1, 9))
def test_a_hundred_thousand_lines_of_all_kinds(tmp_path: Path, jobs: int) -> None:
    """12,500 for each number of processes: a file, standard input, `solve_many`."""
    runs = random_runs(jobs, 12_500)
    path = tmp_path / "lines.jsonl"
    path.write_text("\n".join(lines_of(runs)) + "\n")
    if jobs % 3 == 0:
        texts = [json.loads(line) if line.startswith("{") else {} for line in lines_of(runs)]
        found = verdicts(list(kovacic.solve_many(texts, jobs=jobs, timeout=1.0)))
    else:
        standard = jobs % 3 == 1
        arguments = [sys.executable, "-m", "kovacic", "batch", "-" if standard else str(path), "-j", str(jobs)]
        with path.open() as lines:
            ran = subprocess.run([*arguments, "-q", "--timeout", "1"], stdin=lines, capture_output=True, timeout=600)
        output = io.StringIO(ran.stdout.decode())
        answers = [json.loads(line) for line in output]
        found = [(answer["line"], label_of(answer)) for answer in answers]
    assert found == answers_of(runs)

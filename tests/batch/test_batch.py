"""Batches: every input gets exactly one answer, whatever happens to the processes; limits hold; runs can be resumed."""

from __future__ import annotations

import gzip
import io
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import workers
from build import parametrize, run
from hypothesis import given
from hypothesis import strategies as st
from processes import finished, started

import kovacic
from kovacic import InputError, KovacicError, Limits
from kovacic.batch.files import answers, count_items, guess_format, item_from, read_items, take_up
from kovacic.batch.pool import GRACE_SECONDS, Pool
from kovacic.batch.records import LABELS, Item, Job, ProcessLost, Record, Summary, label_of, refused, stopped
from kovacic.batch.worker import solve_item
from kovacic.limits import DEFAULT_LIMITS

CASES = Path(__file__).parents[1] / "data" / "cases.jsonl"

# Minutes of work with numbers that take hundreds of megabytes, most of it in single calls of the C library.
SLOW = "(x + 1)^15000/(x^3000 - x - 1)"
LINUX = Path("/proc/self/statm").exists()  # other systems have no memory limits
QUICK = ("x^2 + 3", "x", "1/x - 3/(16*x^2)", "2", "(2 - x^2)/x^2")
QUICK_CASES = [1, None, 2, 1, 1]


def items(texts: list[str] | tuple[str, ...]) -> list[Item]:
    return [Item(number, text) for number, text in enumerate(texts, start=1)]


def read(data: bytes, form: str | None = None, **options: str) -> list[Item]:
    return list(read_items(io.BytesIO(data), form=form, **options))


def command(*arguments: str, **options: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "kovacic", "batch", *arguments], capture_output=True, text=True, timeout=60, **options
    )


@pytest.fixture(scope="module")
def pool() -> Iterator[Pool]:
    with Pool(2, Job()) as running:
        yield running


# Reading


def test_plain_lines_are_numbered_by_their_place() -> None:
    found = read(b"\xef\xbb\xbfx^2+3\n\n# a comment\n  x \r\nlast")
    assert [(item.number, item.text) for item in found] == [(1, "x^2+3"), (4, "x"), (5, "last")]


def test_jsonl_is_recognised_and_bad_lines_keep_their_place() -> None:
    found = read(b'{"S": "t", "var": "t", "id": "airy"}\n{"id": 3}\n[1]\n{"S": 5}\n"x"\nnot json\n')
    assert found[0] == Item(1, "t", "t", {"id": "airy"})
    assert [item.error is not None for item in found] == [False, True, True, True, False, True]
    assert found[1].extra == {"id": 3}


def test_csv_with_and_without_header() -> None:
    found = read(b'id,S\nfirst,"x^2 +\n 3"\nsecond,x\nthird\n', "csv")
    assert [(item.number, item.text, item.extra.get("id")) for item in found[:2]] == [
        (2, "x^2 +\n 3", "first"),
        (4, "x", "second"),
    ]
    assert found[2].error is not None
    assert found[2].number == 5
    (_, wrong) = read(b"id,S\n 1 , x^2 \n 2 , x , y \n", "csv")
    assert (wrong.text, str(wrong.error)) == ("2,x,y", "a row of length 3 in a table of 2 columns")
    assert [item.text for item in read(b"x,1\nx^2+3,2\n", "csv")] == ["x", "x^2+3"]


def csv_file(seed: int) -> tuple[str, dict[int, str | None]]:
    """A table, and by line the expression that begins there, or None for a line with an error."""
    chosen = random.Random(seed)
    with_id = chosen.random() < 0.5
    rows = ["S,id" if with_id else "S"]
    expected: dict[int, str | None] = {}
    number = 2
    for k in range(chosen.randint(1, 12)):
        text = f"x^{k} + {seed}"
        kind = chosen.choice(["plain", "quoted", "two lines", "unclosed", "stray"])
        if kind == "two lines":
            text = text.replace(" ", " \n")
        shown = {"plain": text, "unclosed": f'"{text}', "stray": f'"{text}"{k}'}.get(kind, f'"{text}"')
        rows.append(f"{shown},{k}" if with_id else shown)
        expected[number] = None if kind in ("unclosed", "stray") else text
        number += 1 + text.count("\n")
    return "\n".join(rows) + "\n" * chosen.randint(0, 2), expected


def test_an_unclosed_quotation_mark_costs_no_other_line() -> None:
    """400 tables with closed cells of one and two lines, unclosed quotation marks and text behind closing ones."""
    for seed in range(400):
        text, expected = csv_file(seed)
        found = {item.number: None if item.error else item.text for item in read(text.encode(), "csv")}
        assert found == expected, text


def test_an_unclosed_quotation_mark_is_named_and_does_not_keep_the_file_in_memory() -> None:
    found = list(read_items(io.BytesIO(b'S\n"x\n+1\n-x^2'), form="csv"))
    assert [(item.number, item.text) for item in found[1:]] == [(3, "+1"), (4, "-x^2")]
    assert "a quotation mark isn't closed" in str(found[0].error)
    assert found[0].number == 2

    def lines() -> Iterator[bytes]:
        yield b'S\n"x\n'
        while True:
            yield b"x+1\n" * 100

    class Endless(io.RawIOBase):
        source = lines()

        def readable(self) -> bool:
            return True

        def readinto(self, buffer: bytearray) -> int:
            part = next(self.source)
            buffer[: len(part)] = part
            return len(part)

    endless = read_items(io.BufferedReader(Endless()), form="csv", limits=Limits(text_length=1000))
    assert [next(endless).number for _ in range(3)] == [2, 3, 4]


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("equation,id", "there is no 'S' with the expression"),
        ("id,equation", "there is no 'S' with the expression"),
        ("f,id", "there is no 'S' with the expression"),
        ("name,formula", "there is no 'S' with the expression"),
        ("ode", "there is no 'S' with the expression"),
        ("y'',var", "there is no 'S' with the expression"),
        ("S,S", "two columns have the name 'S'"),
        ("S,id,id", "two columns have the name 'id'"),
        ("S,note,note", "two columns have the name 'note'"),
        ("S,input", "'S' and 'input' both name the expression"),
    ],
)
def test_a_header_that_names_no_expression_is_no_equation(header: str, message: str) -> None:
    row = ",".join("x" * (header.count(",") + 1))
    found = read(f"{header}\n{row}\n{row}\n".encode(), "csv")
    assert [item.number for item in found] == [1, 2, 3]
    assert all(message in str(item.error) for item in found)


def test_further_columns_are_carried_along() -> None:
    (item,) = read(b"note,S,id,source\nhello,x,7,\n", "csv")
    assert (item.text, item.extra) == ("x", {"id": "7", "columns": {"note": "hello", "source": ""}})
    first, second = read(b"x^2+3,7,,well\nx\n", "csv")
    assert (first.text, first.extra) == ("x^2+3", {"columns": {"2": "7", "4": "well"}})
    assert (second.text, second.extra) == ("x", {})


@pytest.mark.parametrize("header", ["S;var", "id; S", "input;note;id", "expression;x"])
def test_semicolons_between_cells_are_refused(header: str) -> None:
    """For "x^2+1,5;x" would be x^2+1 beside other cells."""
    found = read(f"{header}\nx^2+1,5;x\nx;x\n".encode(), "csv")
    assert [item.number for item in found] == [1, 2, 3]
    assert all("semicolons between cells" in str(item.error) for item in found)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('{"S": "x", "id": NaN}', "NaN isn't a number in JSON"),
        ('{"S": "x", "id": [-Infinity]}', "-Infinity isn't a number in JSON"),
        ('{"S": "x", "id": 1e999}', "an id is a JSON value, not a float"),
        ('{"S": "x", "S": "y"}', "a key occurs twice in one object: 'S'"),
        ('{"S": "x", "id": {"a": 1, "a": 2}}', "a key occurs twice in one object: 'a'"),
        ('{"S": "x", "input": "y"}', "'S' and 'input' both name the expression"),
        ('{"S": "x", "Var": "t"}', "unknown key 'Var'"),
        ('{"S": "x", "assume": {"a": "positive"}}', "unknown key 'assume'"),
    ],
)
def test_a_line_of_json_that_says_more_than_is_read_is_refused(line: str, message: str) -> None:
    bad, good = read(f'{line}\n{{"S": "x"}}\n'.encode(), "jsonl")
    assert message in str(bad.error)
    assert good.error is None
    assert json.loads(refused(bad, bad.error).json, parse_constant=lambda name: pytest.fail(name))["status"] == "error"


@pytest.mark.parametrize("form", ["lines", "jsonl", "csv"])
def test_bytes_that_are_no_text_are_reported_in_their_line(form: str) -> None:
    found = read(b"S\nx\xff\n" if form == "csv" else b"\nx\xff\n", form)
    assert len(found) == 1
    assert found[0].number == 2
    assert "UTF-8" in str(found[0].error)


def test_a_line_above_the_limit_is_not_kept() -> None:
    found = list(read_items(io.BytesIO(b"x+" * 5000 + b"x\nx\n"), form="lines", limits=Limits(text_length=100)))
    assert [(item.number, item.error is None) for item in found] == [(1, False), (2, True)]


def test_gzip_is_recognised_by_its_first_bytes(tmp_path: Path) -> None:
    path = tmp_path / "data"
    path.write_bytes(gzip.compress(b"x\nx^2\n"))
    with path.open("rb") as stream:
        assert [item.text for item in read_items(stream)] == ["x", "x^2"]
    assert count_items(str(path)) == 2


def test_a_torn_gzip_file_is_an_error_after_its_items() -> None:
    lines = b"".join(b"x + %d\n" % (k * k) for k in range(20_000))
    found = read_items(io.BytesIO(gzip.compress(lines)[:-2000]))
    assert next(found).text == "x + 0"
    with pytest.raises(InputError, match="can't be read beyond line"):
        list(found)


def test_formats_by_name() -> None:
    assert [guess_format(name) for name in ("a.jsonl", "b.ndjson.gz", "c.csv", "d.txt", "-")] == [
        "jsonl",
        "jsonl",
        "csv",
        None,
        None,
    ]


def test_everything_that_solve_takes_is_an_item() -> None:
    import sympy

    x = sympy.Symbol("x")
    assert item_from(1, x**2 + 3).text == "x**2 + 3"
    assert item_from(2, ([3, 0, 1], [1])).text == "x**2 + 3"
    assert item_from(3, {"S": "t", "var": "t", "id": 5}) == Item(3, "t", "t", {"id": 5})
    assert item_from(4, object()).error is not None
    assert item_from(5, {"S": "x", "id": {1, 2}}).error is not None
    assert item_from(6, Item(9, "x")) == Item(9, "x")


def test_names_are_a_list_or_one_text() -> None:
    found = [item_from(1, {"S": "x", "names": names}) for names in ("EI mass", ["EI", "mass"], 3)]
    assert [item.names for item in found] == [("EI", "mass"), ("EI", "mass"), ()]
    assert "a list of strings" in str(found[2].error)


@pytest.mark.parametrize(("S", "label"), [("x^2 + 3", "case 1"), ("x^4 + x^2 + 202*x + 1/4", "undecided")])
def test_labels_are_those_of_the_answers(S: str, label: str) -> None:
    record = solve_item(Item(1, S), Job(), Limits(unknown_degree=5))
    assert label_of(record.data) == record.label == label


@pytest.mark.long
@given(st.text(), st.none() | st.text(), st.dictionaries(st.text().map("k".__add__), st.text()))
def test_items_survive_the_pipe(pool: Pool, text: str, var: str | None, extra: dict[str, str]) -> None:
    (record,) = pool.run([Item(3, text, var, extra)])
    assert record.number == 3
    assert record.data["input"].strip() == text.strip()
    assert {key: record.data[key] for key in extra} == extra


@pytest.mark.long
def test_records_survive_the_pipe() -> None:
    item = Item(7, "x^2+3", extra={"id": "tab\tnewline\n"})
    conditions = {"timeout": 20, "group": True, "limits": Limits(degree=7)}
    with Pool(1, Job(memory=200 if LINUX else None, **conditions)) as pool:
        record, refused = pool.run([item, Item(8, "x^8")])
    here = solve_item(item, Job(group=True), DEFAULT_LIMITS)
    assert (record.number, record.label) == (7, here.label)
    assert {**record.data, "seconds": 0} == {**here.data, "seconds": 0}
    assert record.data["group"]["name"] == "Borel"
    assert "above the limit of 7" in refused.data["proof"]["undecided"]


# Running


@pytest.mark.long
def test_solve_many_answers_in_order_with_schema_1() -> None:
    records = list(kovacic.solve_many([*QUICK, "x+", {"S": "x", "id": "a"}], jobs=2, timeout=60))
    assert [record.number for record in records] == list(range(1, 8))
    assert [record.case for record in records[:5]] == QUICK_CASES
    assert records[5].label == "bad input"
    assert records[5].data["error"]["position"] == 1
    assert records[6].data["id"] == "a"
    assert records[0].solution == kovacic.solve("x^2 + 3")
    assert records[0].solution.verify()
    with pytest.raises(KovacicError, match="line 6"):
        _ = records[5].solution


@pytest.mark.long
def test_answers_validate_against_the_schema(pool: Pool) -> None:
    import jsonschema

    schema = json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text(encoding="utf-8"))
    with Pool(1, Job(timeout=0.2)) as short:
        records = [*pool.run(items(QUICK)), *short.run(items([SLOW]))]
    for record in records:
        jsonschema.validate(record.data, schema)
    assert records[-1].label == "undecided"


@pytest.mark.long
def test_published_equations_have_their_answers(pool: Pool) -> None:
    expected = [json.loads(line)["case"] for line in CASES.read_text(encoding="utf-8").splitlines()][:60]
    texts = [json.loads(line)["S"] for line in CASES.read_text(encoding="utf-8").splitlines()][:60]
    finished = list(pool.run(items(texts), ordered=False))
    assert sorted(record.number for record in finished) == list(range(1, 61))
    assert [record.case for record in sorted(finished, key=lambda record: record.number)] == expected


def test_lines_of_lost_processes_and_failed_checks(monkeypatch: pytest.MonkeyPatch) -> None:
    import jsonschema

    schema = json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    item = Item(3, "x", extra={"id": "a"})
    validator.validate(refused(item, ProcessLost("the worker process ended with signal SIGKILL"), 0.5).data)
    validator.validate(stopped(item, "the memory limit of 30 MiB is exceeded", 0.5).data)
    validator.validate(solve_item(item, Job(), Limits(degree=1, text_length=0)).data)

    def failing(*arguments: object, **options: object) -> None:
        raise kovacic.VerificationFailed("the answer failed its own check; please report it")

    monkeypatch.setattr(kovacic, "solve", failing)
    record = solve_item(item, Job(), DEFAULT_LIMITS)
    assert record.label == "failed"
    validator.validate(record.data)


@pytest.fixture(scope="module")
def single() -> Iterator[Pool]:
    """One process."""
    with Pool(1, Job()) as running:
        yield running


@pytest.mark.parametrize(
    ("timeout", "seconds", "label"),
    [(0.05, 600.0, "undecided"), pytest.param(60.0, 0.3, "none", marks=pytest.mark.long)],
)
def test_a_late_line_ends_and_costs_no_other(timeout: float, seconds: float, label: str) -> None:
    """What comes after it is answered, and the pool knows that nothing is left.

    A line that takes a while within its time is answered by the same process.
    """
    texts = ["x", workers.FATAL, "x^2", "x^3"]
    with Pool(1, Job(timeout=timeout), serve=partial(workers.late, seconds)) as pool:
        found = finished(lambda: list(pool.run(items(texts))))
        assert pool.replaced == (label == "undecided")
    assert [record.label for record in found] == ["none", label, "none", "none"]


@pytest.mark.parametrize(
    ("serve", "words", "replaced"),
    [
        pytest.param(workers.leaves, "the worker process ended with exit status 0", 1, marks=pytest.mark.long),
        (workers.is_killed, "the worker process ended with signal SIGKILL", 4),
    ],
    ids=["leaves", "is killed"],
)
def test_a_process_that_ends_costs_no_other_line(serve: Any, words: str, replaced: int) -> None:
    """Ended by itself, the item isn't tried again; killed by somebody else it is, four times in all."""
    with Pool(1, Job(memory=1000), serve=serve) as pool:
        found = finished(lambda: list(pool.run(items(["x", workers.FATAL, "x^2", "x^3"]))))
        assert pool.replaced == replaced
    assert [(record.number, record.label) for record in found] == [(1, "none"), (2, "failed"), (3, "none"), (4, "none")]
    assert found[1].error == words


def test_lines_that_need_no_process_have_their_records(single: Pool) -> None:
    """All of them wrong: nothing is handed out, and nothing waits for an event."""
    wrong = read(b'{"S": 1}\n[]\n{"T": "x"}\n', "jsonl")
    records = finished(lambda: list(single.run(wrong)))
    assert [(record.number, record.label) for record in records] == [(k, "bad input") for k in (1, 2, 3)]


@parametrize("stream", [True, False], ordinary=1)
def test_what_ends_an_input_too_early_is_raised_after_the_answers(single: Pool, stream: bool) -> None:
    def torn() -> Iterator[Item]:
        yield Item(1, "x")
        yield Item(2, "x^2 + 17")
        raise OSError("the disk is gone")

    records = single.run(torn(), stream=stream)
    first_two = finished(lambda: [next(records), next(records)])
    assert [(record.number, record.label) for record in first_two] == [(1, "none"), (2, "case 1")]
    with pytest.raises(OSError, match="the disk is gone"):
        next(records)


def test_answers_longer_than_a_pipe_arrive_whole(single: Pool) -> None:
    sizes = (0, 1, 65_000, 65_536, 131_072, 5, 900_000, 3, 400_000)
    some = [Item(k, "x", extra={"id": str(k % 10) * size}) for k, size in enumerate(sizes, start=1)]
    for record, item in zip(single.run(some), some, strict=True):
        assert (record.number, record.label, record.data["id"]) == (item.number, "none", item.extra["id"])


@pytest.mark.long
def test_equations_are_taken_lazily(pool: Pool) -> None:
    taken = 0

    def endless() -> Iterator[Item]:
        nonlocal taken
        while True:
            taken += 1
            yield Item(1000 + taken, "x")

    records = pool.run(endless())
    assert [next(records).number for _ in range(20)] == list(range(1001, 1021))
    records.close()
    assert taken < 1000
    pool.close()


@pytest.mark.long
def test_the_time_limit_holds_and_costs_nobody_else_an_answer() -> None:
    with Pool(2, Job(timeout=1.0)) as pool:
        records = list(pool.run(items([SLOW, *QUICK, SLOW, *QUICK])))
        assert pool.replaced == 2
    assert [record.label for record in records if record.number in (1, 7)] == ["undecided", "undecided"]
    assert [record.case for record in records if record.number not in (1, 7)] == QUICK_CASES * 2
    for record in (records[0], records[6]):
        assert 1.0 <= record.seconds < 1.0 + GRACE_SECONDS + 1.0
        assert "time limit of 1 s" in record.solution.reason


@pytest.mark.long
def test_an_equation_never_waits_for_a_slow_one_without_limit() -> None:
    with Pool(2, Job()) as pool:
        records = pool.run(items([SLOW, *QUICK]), ordered=False)
        cases = {}
        for _ in QUICK:
            record = next(records)
            cases[record.number] = record.case
        assert [cases[number] for number in range(2, 7)] == QUICK_CASES


@pytest.mark.long
@pytest.mark.skipif(not LINUX, reason="needs Linux's memory limits")
def test_the_memory_limit_holds() -> None:
    with Pool(1, Job(memory=30, timeout=60)) as pool:
        records = list(pool.run(items(["x", SLOW, "x^2 + 3"])))
    assert [record.label for record in records] == ["none", "undecided", "case 1"]
    assert "memory limit of 30 MiB" in records[1].data["proof"]["undecided"]


@pytest.mark.long
def test_killed_processes_lose_nothing_and_repeat_nothing() -> None:
    """Processes are killed that have started; the records that they have given arrive afterwards."""
    texts = [QUICK[k % 5] for k in range(300)]
    killed: list[int] = []
    with Pool(2, Job(timeout=60)) as pool:
        finished = []
        for record in pool.run(items(texts), ordered=False):
            finished.append(record)
            alive = [child.pid for child in pool._children if child.ready and child.pid not in killed]
            if alive and len(killed) < 4 and len(finished) >= 20 * (len(killed) + 1):
                killed.append(alive[-1])
                os.kill(alive[-1], signal.SIGKILL)
        assert pool.replaced == 4
    assert sorted(record.number for record in finished) == list(range(1, 301))
    assert [record.case for record in sorted(finished, key=lambda r: r.number)] == QUICK_CASES * 60


@pytest.mark.long
def test_an_item_that_loses_every_process_is_reported() -> None:
    with Pool(1, Job()) as pool:
        records = pool.run(items(["x", SLOW, "x"]))
        assert next(records).label == "none"
        _kill_later(pool, 4)
        record = next(records)
        assert record.label == "failed"
        assert "SIGKILL" in (record.error or "")
        assert next(records).label == "none"
        assert pool.replaced == 4


def _kill_later(pool: Pool, times: int) -> None:
    """Kill the process that works on the slow item, and then its successors."""
    import threading

    def kill() -> None:
        killed: set[int] = set()
        while len(killed) < times:
            time.sleep(0.05)
            child = pool._children[0]
            if child.pid not in killed and child.item is not None and child.item.text == SLOW:
                killed.add(child.pid)
                os.kill(child.pid, signal.SIGKILL)

    threading.Thread(target=kill, daemon=True).start()


@pytest.mark.long
def test_an_unexpected_exception_is_reported_once_and_costs_nobody_else_an_answer() -> None:
    with Pool(2, Job(), workers.divides_by_zero) as pool:
        found = list(pool.run(items([*QUICK, workers.FATAL, *QUICK])))
        assert pool.replaced == 1
    assert [record.case for record in found] == [*QUICK_CASES, None, *QUICK_CASES]
    assert found[5].label == "failed"
    assert "ZeroDivisionError" in (found[5].error or "")


@parametrize("end", ["exception", "exit", "signal 15", "signal 40"], ordinary=0, long=1)
def test_a_worker_that_dies_is_reported_where_a_system_lacks_signals(monkeypatch: pytest.MonkeyPatch, end: str) -> None:
    """As on Windows, in both processes; timeouts hold there, too."""
    known = [one for one in signal.Signals if one.name not in workers.MISSING_SIGNALS]
    monkeypatch.setattr("kovacic.batch.pool.signal", SimpleNamespace(Signals=known))
    with Pool(1, Job(timeout=1.0), partial(workers.without_signals, end)) as pool:
        records = list(pool.run(items(["x", workers.FATAL, "x^2 + 3", SLOW, "x"])))
    assert [record.label for record in records] == ["none", "failed", "case 1", "undecided", "none"]
    assert "the worker process ended with" in (records[1].error or "")


@pytest.mark.long
def test_a_system_that_does_not_say_how_many_cores_there_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    assert [record.label for record in kovacic.solve_many(["x"])] == ["none"]


def test_memory_limits_are_refused_where_the_system_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    exists = os.path.exists
    monkeypatch.setattr(os.path, "exists", lambda path: path != "/proc/self/statm" and exists(path))
    with pytest.raises(InputError, match="memory limits need a Linux system"):
        kovacic.solve_many(["x"], memory=100)


@pytest.mark.long
def test_a_worker_that_cannot_start_is_an_error() -> None:
    with Pool(1, Job(), workers.cannot_start) as pool, pytest.raises(KovacicError, match="no such module"):
        list(pool.run(items(["x"])))


@pytest.mark.long
def test_workers_end_with_their_parent() -> None:
    program = (
        "import os, time\n"
        "from kovacic.batch.records import Item, Job\nfrom kovacic.batch.pool import Pool\n"
        f"pool = Pool(1, Job())\nrecords = pool.run([Item(1, 'x'), Item(2, {SLOW!r})])\n"
        "next(records)\nprint(pool.pids()[0], flush=True)\nos.kill(os.getpid(), 9)\n"
    )
    ran = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, timeout=60)
    worker = int(ran.stdout)
    for _ in range(200):
        if not _alive(worker):
            return
        time.sleep(0.1)
    pytest.fail("the worker process is still there")


def _alive(pid: int) -> bool:
    try:
        with open(f"/proc/{pid}/stat", encoding="ascii") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@parametrize(
    ("options", "message"),
    [
        ({"jobs": 0}, "at least 1"),
        ({"timeout": 0}, "timeout"),
        ({"memory": 0}, "memory"),
        ({"scheduler": "tcp://localhost:1"}, "needs a backend"),
        ({"backend": "nonsense"}, "unknown backend"),
    ],
    ordinary=1,
)
def test_impossible_options_are_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        list(kovacic.solve_many(["x"], **options))


# The file of answers


def records(numbers: list[int]) -> list[Record]:
    return [solve_item(Item(number, f"x + {number}"), Job(), DEFAULT_LIMITS) for number in numbers]


@pytest.mark.parametrize(
    "rest",
    [
        b"",
        b'{"line": 9, "inp',
        b"\0" * 4096,
        b'{"line": 9}\n',
        b"\n",
        b"[]\n",
        b'"\xff"\n',
        b'{"line": 3, "input": "x + 3", "case": 99}\n',
        b'{"line": 3, "input": "x + 3", "schema": 1, "status": "error"}\n',
    ],
)
def test_what_an_interruption_leaves_is_removed(tmp_path: Path, rest: bytes) -> None:
    path = tmp_path / "answers.jsonl"
    with answers(path) as write:
        for record in records([1, 2, 5]):
            write(record)
    whole = path.read_bytes()
    path.write_bytes(whole + rest)
    done = take_up(path)
    assert path.read_bytes() == whole
    assert [Item(k, f"x + {k}") in done for k in (1, 2, 3, 5)] == [True, True, False, True]
    with pytest.raises(InputError, match="differs from the line"):
        _ = Item(2, "x^2") in done
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    "change",
    [
        {"case": 99},
        {"case": None},
        {"case": 2},
        {"status": "none"},
        {"status": "liouville"},
        {"status": "undecided"},
        {"riccati": None},
        {"riccati": {"variable": "w", "degree": 2, "coefficients": ["1", "x", "1"]}},
        {"verified": False},
        {"schema": 2},
        {"proof": {}},
        {"proof": {"structure": None, "undecided": None}},
    ],
    ids=str,
)
def test_a_record_that_contradicts_itself_is_no_answer(tmp_path: Path, change: dict[str, object]) -> None:
    path = tmp_path / "answers.jsonl"
    right, other = (solve_item(Item(k, "x^2 + 3"), Job(), DEFAULT_LIMITS).data for k in (1, 2))
    path.write_text(json.dumps(right) + "\n" + json.dumps(other) + "\n")
    assert len(take_up(path)) == 2
    path.write_text(json.dumps({**right, **change}) + "\n" + json.dumps(other) + "\n")
    assert take_up(path).labels == {2: "case 1"}
    assert json.loads(path.read_text(encoding="utf-8")) == other


@parametrize("content", ["x^2 + 3\n", '{"S": "x", "id": 1}\n"x^2"\n', "\0\nprecious\n", "[]\n"], ordinary=0, long=2)
def test_a_file_of_something_else_is_not_taken_up(tmp_path: Path, content: str) -> None:
    path = tmp_path / "equations.jsonl"
    path.write_text(content)
    ran = command(str(path), "-o", str(path), "--resume")
    assert ran.returncode == 2
    assert "has no answers" in ran.stderr
    assert path.read_text(encoding="utf-8") == content
    assert list(tmp_path.iterdir()) == [path]


def test_broken_and_repeated_lines_in_the_middle_are_removed(tmp_path: Path) -> None:
    path = tmp_path / "answers.jsonl"
    first, second = (record.json.encode() + b"\n" for record in records([1, 2]))
    path.write_bytes(first + b"\0\0\0\n" + second + first)
    assert len(take_up(path)) == 2
    assert path.read_bytes() == first + second


@pytest.mark.long
@given(st.integers(min_value=0))
def test_a_run_cut_anywhere_is_completed(tmp_path_factory: pytest.TempPathFactory, cut: int) -> None:
    path = tmp_path_factory.mktemp("cut") / "answers.jsonl"
    whole = b"".join(record.json.encode() + b"\n" for record in records([1, 2, 3]))
    path.write_bytes(whole[: cut % (len(whole) + 1)])
    done = take_up(path)
    with answers(path) as write:
        for record in records([1, 2, 3]):
            if Item(record.number, f"x + {record.number}") not in done:
                write(record)
    assert [json.loads(line)["line"] for line in path.read_text(encoding="utf-8").splitlines()] == [1, 2, 3]


# The command


@pytest.mark.long
def test_the_command_answers_every_line(tmp_path: Path) -> None:
    path = tmp_path / "in.txt"
    path.write_text("\n".join([*QUICK, "x +"]) + "\n")
    ran = command(str(path), "--jobs", "2", "--group", "--progress")  # which nothing shows in a pipe
    assert ran.returncode == 2
    answers = [json.loads(line) for line in ran.stdout.splitlines()]
    assert [answer["line"] for answer in answers] == list(range(1, 7))
    assert [answer["status"] for answer in answers] == ["liouvillian", "none", *["liouvillian"] * 3, "error"]
    assert answers[0]["group"] == {"name": "Borel", "order": None, "finite": False, "family": "borel", "n": None}
    assert re.search(r"case 1\s+3\n", ran.stderr)
    assert re.search(r"bad input\s+1\n", ran.stderr)
    assert "6/6" not in ran.stderr


@pytest.mark.long
def test_the_command_reads_standard_input_and_answers_at_once() -> None:
    arguments = [sys.executable, "-m", "kovacic", "batch", "-", "-j", "1", "-q"]
    with started(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        for text, case in (("x^2 + 3", 1), ("x", None)):
            process.stdin.write(text + "\n")
            process.stdin.flush()
            assert json.loads(process.stdout.readline())["case"] == case
        process.stdin.close()
        assert process.wait(timeout=60) == 0


def test_an_output_with_something_in_it_is_refused_before_any_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, output = tmp_path / "in.txt", tmp_path / "out.jsonl"
    source.write_text("x\n")
    output.write_text("precious\n")
    assert run(["batch", str(source), "-o", str(output)]) == 2
    assert "isn't empty: --resume continues it" in capsys.readouterr().err
    assert output.read_text() == "precious\n"
    assert run(["batch", str(source), "--resume"]) == 2
    assert "--resume needs --output FILE" in capsys.readouterr().err
    new = tmp_path / "new.jsonl"
    assert run(["batch", str(source), "-o", str(new), "-j", "1"]) == 0
    assert json.loads(new.read_text())["case"] is None


@pytest.mark.long
def test_an_output_file_is_not_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "answers.jsonl"
    path.write_text("precious\n")
    ran = command("-", "-o", str(path), input="x\n")
    assert ran.returncode == 2
    assert "--resume" in ran.stderr
    assert path.read_text(encoding="utf-8") == "precious\n"
    assert command("-", "--resume", input="x\n").returncode == 2
    assert command(str(tmp_path / "absent")).returncode == 2


@parametrize("signal_sent", [signal.SIGINT, signal.SIGKILL], ordinary=0, long=1)
def test_an_interrupted_run_is_resumed(tmp_path: Path, signal_sent: int) -> None:
    source, output = tmp_path / "in.txt", tmp_path / "out.jsonl"
    count = 2000
    source.write_text("".join(f"x^2 + {k % 20}\n" for k in range(count)))
    arguments = [str(source), "-o", str(output), "-j", "2", "--as-finished"]
    with started([sys.executable, "-m", "kovacic", "batch", *arguments], stderr=subprocess.PIPE) as process:
        while process.poll() is None and (not output.exists() or output.read_bytes().count(b"\n") < 50):
            time.sleep(0.01)
        process.send_signal(signal_sent)
        _, errors = process.communicate(timeout=60)
        assert process.returncode == (130 if signal_sent == signal.SIGINT else -signal.SIGKILL), errors
    before = output.read_bytes().count(b"\n")
    assert before < count
    ran = command(*arguments, "--resume")
    assert ran.returncode == 0, ran.stderr
    assert "had been answered before" in ran.stderr
    numbers = [json.loads(line)["line"] for line in output.read_text(encoding="utf-8").splitlines()]
    assert sorted(numbers) == list(range(1, count + 1))


def test_a_resumed_run_with_nothing_left_to_do_has_the_status_of_its_file(tmp_path: Path) -> None:
    source, output = tmp_path / "in.txt", tmp_path / "out.jsonl"
    source.write_text("x\nx +\n")
    lines = [Item(1, "x"), Item(2, "x +")]
    with answers(output) as write:
        write(solve_item(lines[0], Job(), DEFAULT_LIMITS))
        write(solve_item(lines[1], Job(), DEFAULT_LIMITS))
    assert run(["batch", str(source), "-o", str(output), "--resume", "-q", "-j", "1"]) == 2
    assert len(output.read_text(encoding="utf-8").splitlines()) == 2


# The summary


def test_quantiles_and_exit_status() -> None:
    summary = Summary()
    for k in range(1, 1001):
        summary.add(Record(k, "none", k / 1000, ""))
    assert summary.quantile(0.5) == pytest.approx(0.5, rel=0.01)
    assert summary.quantile(0.9) == pytest.approx(0.9, rel=0.01)
    assert summary.slowest is not None
    assert summary.slowest.number == 1000
    assert summary.exit_status == 0
    for label, status in (("undecided", 3), ("bad input", 2), ("failed", 4)):
        summary.add(Record(0, label, 0.0, ""))
        assert summary.exit_status == status
    assert set(summary.counts) <= set(LABELS)


def test_an_empty_summary() -> None:
    assert Summary().quantile(0.5) == 0.0


@pytest.mark.parametrize(
    ("S", "label"),
    [
        ("(-32*x^2 + 27*x - 27)/(144*x^2*(x - 1)^2)", "case 3 (4)"),
        pytest.param("(-135*x^2 + 115*x - 108)/(576*x^2*(x - 1)^2)", "case 3 (6)", marks=pytest.mark.long),
    ],
)
def test_a_record_that_is_read_again_has_its_label(S: str, label: str) -> None:
    """The pull-backs of Klein with the differences 1/2, 1/3 and 1/3 or 1/4 at 0, 1 and infinity."""
    (record,) = kovacic.solve_many([S], jobs=1)
    assert record.label == label_of(record.data) == label

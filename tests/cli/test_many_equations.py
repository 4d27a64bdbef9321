"""`kovacic batch` and `kovacic scan` in this process: what goes to the files, to the terminal and into the summary."""

from __future__ import annotations

import io
import json
import re
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest
from build import run

from kovacic.batch.records import Item, Job, Record, Summary, refused
from kovacic.batch.worker import solve_item


@pytest.fixture(autouse=True)
def without_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    def answered(items: Iterable[Item], job: Job) -> Iterator[Record]:
        for item in items:
            yield refused(item, item.error) if item.error else solve_item(item, job, job.engine_limits)

    monkeypatch.setattr("kovacic.batch.run_items", answered)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "in.txt"
    path.write_text("x\nx^2 + 3\n\nx +\n")
    return path


def on_a_terminal(monkeypatch: pytest.MonkeyPatch, *streams: Any) -> None:
    monkeypatch.setenv("TERM", "xterm")
    for stream in streams:
        monkeypatch.setattr(stream, "isatty", lambda: True)


def lines_of(text: str) -> list[int]:
    return [json.loads(line)["line"] for line in text.splitlines()]


def test_answers_and_their_summary(source: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["batch", str(source)]) == 2
    shown = capsys.readouterr()
    assert lines_of(shown.out) == [1, 2, 4]
    counts = dict(re.findall(r"^\W*(none|case 1|bad input|all)\s+(\d+)\s*$", shown.err, re.MULTILINE))
    assert counts == {"none": "1", "case 1": "1", "bad input": "1", "all": "3"}
    assert re.search(r"time of an equation: median \S+ s, 90 % within \S+ s, slowest \S+ s \(line \d\)\n", shown.err)
    assert re.search(r"^\d+\.\d s in all, \d+\.\d equations a second$", shown.err, re.MULTILINE)
    assert "before" not in shown.err
    assert run(["batch", str(source), "--quiet"]) == 2
    again = capsys.readouterr()
    assert lines_of(again.out) == [1, 2, 4]
    assert again.err == ""


def test_an_empty_file_is_written_to_and_one_with_answers_is_continued(
    source: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "answers.jsonl"
    output.touch()
    command = ["batch", str(source), "-o", str(output)]
    assert run(command) == 2
    whole = output.read_text()
    assert lines_of(whole) == [1, 2, 4]
    assert capsys.readouterr().out == ""
    assert run(command) == 2
    assert "isn't empty: --resume continues it" in capsys.readouterr().err
    output.write_text("".join(whole.splitlines(keepends=True)[:2]))
    assert run([*command, "--resume"]) == 2
    assert lines_of(output.read_text()) == [1, 2, 4]
    assert "2 more had been answered before" in capsys.readouterr().err


def test_what_is_resumed_need_not_have_begun(source: Path, tmp_path: Path) -> None:
    output = tmp_path / "new.jsonl"
    assert run(["batch", str(source), "-o", str(output), "--resume", "-q"]) == 2
    assert lines_of(output.read_text()) == [1, 2, 4]


@pytest.mark.parametrize(
    ("options", "is_shown"), [([], True), (["--no-progress"], False), (["--progress"], True), (["-q"], True)]
)
def test_a_terminal_shows_the_progress(
    options: list[str],
    is_shown: bool,
    source: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    on_a_terminal(monkeypatch, sys.stderr)
    output = tmp_path / "answers.jsonl"
    run(["batch", str(source), "-o", str(output), *options])
    assert ("3/3  case 1 1  none 1  bad input 1" in capsys.readouterr().err) == is_shown
    output.write_text("".join(output.read_text().splitlines(keepends=True)[:1]))
    run(["batch", str(source), "-o", str(output), "--resume", *options])
    assert ("2/2  case 1 1  bad input 1" in capsys.readouterr().err) == is_shown


def test_answers_on_a_terminal_are_the_progress(
    source: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    on_a_terminal(monkeypatch, sys.stderr, sys.stdout)
    run(["batch", str(source)])
    assert "3/3" not in capsys.readouterr().err
    run(["batch", str(source), "--progress"])
    assert "3/3" in capsys.readouterr().err


def test_a_stream_has_no_known_end(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    on_a_terminal(monkeypatch, sys.stderr)
    stdin = io.TextIOWrapper(io.BytesIO(b"x\nx^2 + 3\n"))
    monkeypatch.setattr(sys, "stdin", stdin)
    assert run(["batch", "-"]) == 0
    shown = capsys.readouterr()
    assert lines_of(shown.out) == [1, 2]
    assert "case 1 1  none 1" in shown.err
    assert "/2" not in shown.err


def test_a_scan_in_its_formats(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr("kovacic.batch.scan.draw_map", lambda *arguments: drawn.append(arguments))
    output, picture = tmp_path / "scan.jsonl", tmp_path / "map.png"
    command = ["scan", "-n^2 + m*x", "n=2:3", "m=0:2", "-o", str(output), "--map", str(picture), "-q"]
    assert run(command) == 0
    whole = output.read_text()
    assert [json.loads(line)["parameters"] for line in whole.splitlines()][4] == {"n": "3", "m": "1"}
    ((S, (rows, columns), labels, path),) = drawn
    assert (S, rows.name, columns.name, path) == ("-n^2 + m*x", "n", "m", picture)
    assert labels == {1: "case 1", 2: "none", 3: "none", 4: "case 1", 5: "none", 6: "none"}
    output.write_text("".join(whole.splitlines(keepends=True)[:4]))
    assert run([*command, "--resume"]) == 0
    assert lines_of(output.read_text()) == [1, 2, 3, 4, 5, 6]
    assert drawn[1][2] == labels
    capsys.readouterr()
    assert run(["scan", "n/(m*x^2)", "n=2", "m=0,1", "--format", "csv", "-q"]) == 2
    head, first, second = capsys.readouterr().out.splitlines()
    assert head == "n,m,status,case,degree,group,order,seconds,remark"
    assert first.startswith("2,0,error,,,,,")
    assert second.startswith("2,1,liouvillian,1,1,")
    assert run(["scan", "n*x", "n=2", "--format", "csv", "--resume", "-o", str(tmp_path / "a.csv")]) == 2
    assert "--resume needs --output FILE.jsonl" in capsys.readouterr().err


def test_the_slowest_equation_is_the_first_of_the_slowest() -> None:
    summary = Summary(before=["case 2", "undecided"])
    for number, seconds in ((3, 0.2), (5, 0.7), (8, 0.7), (9, 0.1)):
        summary.add(Record(number, "case 1", seconds, ""))
    assert summary.slowest is not None
    assert summary.slowest.number == 5
    assert (summary.total, summary.before.total(), summary.exit_status) == (4, 2, 3)
    assert list(summary.rows()) == [("case 1", 4)]
    assert summary.quantile(0.5) == 0.7

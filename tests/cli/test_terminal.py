"""What a terminal shows, and standard streams that are closed, broken or full, in this process."""

from __future__ import annotations

import errno
import io
import json
import os
import re
import sys
import time
from types import SimpleNamespace
from typing import Any

import pytest
from build import Conditions, run, run_and_exit

from kovacic.cli import main, options


def on_a_terminal(monkeypatch: pytest.MonkeyPatch, *streams: Any) -> None:
    monkeypatch.setenv("TERM", "xterm")
    for stream in streams:
        monkeypatch.setattr(stream, "isatty", lambda: True)


def test_waiting_is_shown_after_a_while_and_wiped_away(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with options.waiting("no terminal", patience=0):
        time.sleep(0.01)
    assert capsys.readouterr().err == ""
    on_a_terminal(monkeypatch, sys.stderr)
    with options.waiting("never seen", patience=600):
        pass
    assert capsys.readouterr().err == ""
    with options.waiting("working", patience=0):
        time.sleep(0.03)
    shown = capsys.readouterr().err
    assert re.search(r"working.*0 s", shown)
    assert shown.endswith("\x1b[1A\x1b[2K")
    monkeypatch.setenv("TERM", "dumb")
    with options.waiting("dumb", patience=0):
        time.sleep(0.01)
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("width", "text", "shown"),
    [
        (12, "  one two three four", ["  one two", "    three", "    four"]),
        (9, "one two three", ["one two", "  three"]),
        (7, "one two three", ["one two", "  three"]),
        (6, "one two", ["one", "  two"]),
        (5, "x^2+3*x+5 y", ["x^2+3*x+5 y"]),
        (8, "one two  three  four five", ["one two  three  four five"]),
        (9, "\x1b[32mone\x1b[0m two three", ["\x1b[32mone\x1b[0m two", "  three"]),
        (4, "one\n\ntwo two", ["one", "", "two", "  two"]),
    ],
)
def test_lines_are_broken_at_spaces(width: int, text: str, shown: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    assert options.fitted(text) == text
    on_a_terminal(monkeypatch, sys.stdout)
    monkeypatch.setenv("COLUMNS", str(width))
    assert options.fitted(text) == "\n".join(shown)


def test_colours_are_for_terminals(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["solve", "--no-solutions", "x^2+3"]
    assert run(command) == 0
    plain = capsys.readouterr().out
    assert "\x1b[" not in plain
    on_a_terminal(monkeypatch, sys.stdout)
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert run(command) == 0
    coloured = capsys.readouterr().out
    assert "\x1b[" in coloured
    assert re.sub(r"\x1b\[\d*m", "", coloured) == plain
    for name, value in (("NO_COLOR", "1"), ("TERM", "dumb")):
        with monkeypatch.context() as changed:
            changed.setenv(name, value)
            assert run(command) == 0
            assert capsys.readouterr().out == plain


def test_levels_are_counted_on_a_terminal(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class Found(list[int]):
        complete = False

        def to_dict(self) -> dict[str, object]:
            return {"levels": [*self]}

    taken = Found()
    problem = SimpleNamespace(
        levels=lambda count, digits: (taken.append(k) for k in range(2)), answer=lambda: taken, complete=False
    )
    monkeypatch.setattr("kovacic.general_solution.boundary_problems.read_eigenproblem", lambda *_, **given: problem)
    command = ["eigenvalues", "y'' + lambda*y = 0", "--count", "3"]
    assert run(command) == 3
    assert capsys.readouterr() == ("[0, 1]\n", "")
    taken.clear()
    on_a_terminal(monkeypatch, sys.stderr)
    assert run(command) == 3
    shown = capsys.readouterr()
    assert shown.out == "[0, 1]\n"
    assert re.search(r"levels.*2/3", shown.err)
    taken.clear()
    monkeypatch.setenv("TERM", "dumb")
    assert run([*command[:-1], "2"]) == 0
    assert capsys.readouterr() == ("[0, 1]\n", "")


def test_standard_input_has_an_equation_a_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("x\n\n# a comment\n  x^2+3  \n"))
    assert run(["solve", "--json", "2", "-"]) == 0
    assert [json.loads(line)["input"] for line in capsys.readouterr().out.splitlines()] == ["2", "x", "x^2+3"]
    monkeypatch.setattr(sys, "stdin", Failing(errno.EIO, "r"))
    assert run(["solve", "-"]) == 2
    assert "standard input can't be read: Input/output error" in capsys.readouterr().err


class Failing(io.StringIO):
    """A stream on which every reading or writing fails."""

    def __init__(self, number: int, mode: str) -> None:
        super().__init__()
        self.error = OSError(number, os.strerror(number), *([] if mode == "r" else ["answers.txt"]))

    def __next__(self) -> str:
        raise self.error

    def write(self, _: str) -> int:
        raise self.error


@pytest.mark.parametrize(
    ("number", "status", "said"),
    [
        (errno.EPIPE, 141, ""),
        (errno.ENOSPC, 5, "kovacic: the output can't be written to answers.txt: No space left on device\n"),
    ],
)
def test_an_output_that_fails(
    number: int, status: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdout", Failing(number, "w"))
    assert run(["solve", "--no-solutions", "x"]) == status
    assert capsys.readouterr().err == said


def test_streams_are_utf8_and_arguments_those_of_the_process(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "argv", ["kovacic", "solve", "--no-solutions", "α x"])
    monkeypatch.setattr("warnings.formatwarning", None)
    with pytest.raises(SystemExit) as ended:
        run_and_exit()
    assert ended.value.code == 0
    assert "y'' = α x y\n" in out.buffer.getvalue().decode("utf-8")
    assert (out.encoding, out.errors) == ("utf-8", "backslashreplace")


def test_closed_streams_fail_as_in_c(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their descriptors are open in the other direction, standard error's to nowhere."""
    done: list[Any] = []
    free = iter([0, 9])
    fake = SimpleNamespace(
        devnull=os.devnull,
        O_RDONLY=os.O_RDONLY,
        O_WRONLY=os.O_WRONLY,
        open=lambda path, access: done.append(("open", access)) or next(free),
        dup2=lambda old, new: done.append(("dup2", new)),
        close=lambda number: done.append(("close", number)),
    )
    monkeypatch.setattr(main, "os", fake)
    monkeypatch.setattr("builtins.open", lambda number, mode, **_: (number, mode))
    kept = sys.stderr
    monkeypatch.setattr(sys, "stdin", None)
    monkeypatch.setattr(sys, "stdout", None)
    main._open_closed_streams()
    opened = (sys.stdin, sys.stdout, sys.stderr)
    monkeypatch.undo()
    assert opened == ((0, "r"), (1, "w"), kept)
    assert done == [("open", os.O_WRONLY), ("open", os.O_RDONLY), ("dup2", 1), ("close", 9)]


def test_a_conflict_in_a_check_is_status_4(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class Report(SimpleNamespace):
        def __bool__(self) -> bool:
            return not self.disagreements

    for disagreements, status, said in (
        ([], 0, "3 points inside and 5 outside: all agree"),
        ([1, 2], 4, "3 points inside and 5 outside: 2 disagree"),
    ):
        report = Report(inside=3, outside=5, disagreements=disagreements)
        monkeypatch.setattr(Conditions, "check", lambda *_, found=report: found)
        assert run(["conditions", "n*x^2 + 2", "--check", "8"]) == status
        assert said in capsys.readouterr().out

"""What must be killed: a process of its own gives what it has found, however it ends."""

from __future__ import annotations

import io
import pickle
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from build import parametrize
from processes import answered, talks

from kovacic import process as process_module
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, Limits
from kovacic.process import Channel, Process, computed_apart, echo


@parametrize("value", [None, 1, "x^2 + 3", (None, (2**100,))], ordinary=(1,))
def test_the_value_comes_back(value: Any) -> None:
    assert computed_apart("answer", answered, "a value", value) == value


@pytest.mark.parametrize("how", [pytest.param("an exception", marks=pytest.mark.long), "an end"])
def test_without_a_value_there_is_a_reason(how: str) -> None:
    with pytest.raises(LimitExceeded, match="a process of its own gave no answer"):
        computed_apart("answer", answered, how, 1)


def test_it_is_killed_when_the_time_is_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The time is over once the computation has begun, however long that takes."""
    begun = tmp_path / "begun"

    class Timer(threading.Thread):
        def __init__(self, seconds: float, kill: Callable[[], None]) -> None:
            super().__init__()
            self.kill = kill

        def run(self) -> None:
            while not begun.exists():
                time.sleep(0.01)
            self.kill()

        def cancel(self) -> None:
            """It has run."""

    monkeypatch.setattr(threading, "Timer", Timer)
    with pytest.raises(LimitExceeded, match="a process of its own gave no answer"):
        computed_apart("answer", answered, str(begun), 1)


def test_nothing_is_started_without_time() -> None:
    with Budget(Limits(seconds=0)).watched(), pytest.raises(LimitExceeded, match="time limit"):
        computed_apart("answer", answered, "a value", "not asked for before")


def test_what_a_process_prints_is_no_answer_and_its_last_words_are_kept() -> None:
    process = Process(talks)
    process.send(2)
    assert process.receive() == 3
    with pytest.raises(EOFError):
        process.receive()
    status, words = process.last_words()
    process.close()
    assert status == 1
    assert words.startswith("something that isn't meant for the parent")
    assert words.endswith("ArithmeticError: after that")


def test_a_process_that_was_killed_ends() -> None:
    process = Process(talks)
    process.kill()
    process.send(1)
    with pytest.raises(EOFError):
        process.receive()
    assert process.last_words() == (-9, "")
    process.close()
    process.close()


def test_the_child_answers_its_parent_and_leaves_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pickles in their order; standard output is the error stream; when the parent is another one, the child ends."""
    given, answers, done = io.BytesIO(b"".join(map(pickle.dumps, (echo, 3, "x")))), io.BytesIO(), list[Any]()
    parents = iter([70, 70, 70, 1])

    def leave(status: int) -> None:
        done.append(("left", status))

    monkeypatch.setattr(
        process_module, "signal", SimpleNamespace(signal=lambda *of: done.append(of), SIGINT=2, SIG_IGN=1)
    )
    monkeypatch.setattr(
        process_module,
        "os",
        SimpleNamespace(
            dup=lambda number: 40 + number,
            dup2=lambda old, new: done.append((old, new)),
            fdopen=lambda number, mode: answers if (number, mode) == (41, "wb") else None,
            getppid=lambda: next(parents),
            _exit=leave,
        ),
    )
    monkeypatch.setattr(process_module.time, "sleep", lambda seconds: done.append(seconds))
    monkeypatch.setattr(process_module.sys, "stdin", SimpleNamespace(buffer=given))
    threads: list[Any] = []

    class Thread:
        def __init__(self, target: Callable[[], None], daemon: bool) -> None:
            threads.append((target, daemon))

        def start(self) -> None:
            """Later."""

    monkeypatch.setattr(process_module.threading, "Thread", Thread)
    process_module.serve_parent()
    answers.seek(0)
    assert (pickle.load(answers), pickle.load(answers), answers.read()) == (3, "x", b"")
    assert done == [(2, 1), (2, 1)]
    ((watch, daemon),) = threads
    watch()
    assert daemon
    assert done[2:] == [1.0, 1.0, ("left", 1)]


def test_a_computation_has_a_second_more_than_its_parent_waits(monkeypatch: pytest.MonkeyPatch) -> None:
    alarms: list[float] = []
    monkeypatch.setattr(process_module, "set_alarm", alarms.append)
    given, found = io.BytesIO(pickle.dumps((pow, (2, 5), 7.5))), io.BytesIO()
    process_module._compute(Channel(given, found))
    found.seek(0)
    assert (pickle.load(found), alarms) == (32, [8.5])


def test_an_alarm_is_set_where_the_system_has_one(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[Any] = []
    monkeypatch.setattr(process_module, "signal", SimpleNamespace(setitimer=lambda *of: done.append(of), ITIMER_REAL=3))
    process_module.set_alarm(2.5)
    monkeypatch.setattr(process_module, "signal", SimpleNamespace())
    process_module.set_alarm(4.5)
    assert done == [(3, 2.5)]

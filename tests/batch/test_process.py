"""What must be killed: a process of its own gives what it has found, however it ends."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from build import parametrize
from processes import answered, talks

from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, Limits
from kovacic.process import Process, computed_apart


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

"""What must be killed: a process of its own gives what it has found, however it ends."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from processes import talks, values

from kovacic.process import Process, last_of

FOUND = pytest.mark.parametrize("found", [(), (1,), (1, "x^2 + 3", (None, [2**100]))])


@FOUND
@pytest.mark.parametrize("how", ["to the end", "an exception"])
def test_the_last_value_before_the_end(how: str, found: tuple[Any, ...]) -> None:
    assert last_of(values, how, *found, seconds=60) == (found[-1] if found else None)


@FOUND
def test_the_last_value_before_the_time_is_over(
    found: tuple[Any, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The time is over once all values were sent, however long that takes."""
    sent = tmp_path / "sent"

    class Timer(threading.Thread):
        def __init__(self, seconds: float, kill: Callable[[], None]) -> None:
            super().__init__()
            self.kill = kill

        def run(self) -> None:
            while not sent.exists():
                time.sleep(0.01)
            self.kill()

        def cancel(self) -> None:
            """It has run."""

    monkeypatch.setattr(threading, "Timer", Timer)
    assert last_of(values, str(sent), *found, seconds=60) == (found[-1] if found else None)


@pytest.mark.parametrize("seconds", [0, -1])
def test_nothing_is_started_without_time(seconds: float) -> None:
    assert last_of(values, "to the end", 1, seconds=seconds) is None


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

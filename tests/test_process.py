"""What must be killed: a process of its own gives what it has found, however it ends."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import pytest
from build import parametrize

from kovacic.process import Channel, Process, last_of


def values(how: str, *found: Any) -> Iterator[Any]:
    yield from found
    if how == "for ever":
        while True:
            time.sleep(1)
    if how == "an exception":
        raise ZeroDivisionError


def talks(channel: Channel) -> None:
    print("something that isn't meant for the parent", flush=True)
    channel.send(channel.receive() + 1)
    raise ArithmeticError("after that")


@parametrize("how", ["to the end", "for ever", "an exception"], ordinary=1)
@parametrize("found", [(), (1,), (1, "x^2 + 3", (None, [2**100]))], ordinary=1)
def test_the_last_value_before_the_end(how: str, found: tuple[Any, ...]) -> None:
    assert last_of(values, how, *found, seconds=2 if how == "for ever" else 60) == (found[-1] if found else None)


@pytest.mark.parametrize("seconds", [0, -1])
def test_nothing_is_started_without_time(seconds: float) -> None:
    assert last_of(values, "for ever", 1, seconds=seconds) is None


@pytest.mark.long
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

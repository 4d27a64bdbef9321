"""A text that breaks off anywhere, or has its tokens in any order, is read or refused with a message, and never an accident."""

from __future__ import annotations

from contextlib import suppress
from itertools import product

import pytest
from build import parametrize, read_input

from kovacic import InputError, LimitExceeded

TEXTS = [
    "x*e^-2*x + e^(-x)",
    "y'' + 2*e^-x y' - n(n+1)*y = 0",
    "x^1/2 + 2e-3*x",
    "diff(y(x), x, 2) = (x^2 + pi)*y(x)",
    "d^2y/dx^2 + (1/x) dy/dx + y = sin(x)^2",
    "D2y + t*Dy = y, y(0) = 1, y'(0) = e^-1",
    r"\frac{d^2 y}{dx^2} + \left(\sqrt{2} - x\right) y = e^{-x}",
    "dsolve(Eq(y(x).diff(x, 2), -y(x)), y(x), ics={y(0): 1})",
    "DSolve[{y''[x] == x y[x], y[0] == 1}, y[x], x]",
]
TOKENS = ["e", "^", "-", "2", "x", "y", "y''", "(", ")", "n", "*", "/", "=", ",", "diff(", "sin(", "D2y", "'", "{", "]"]


def is_read_or_refused(text: str) -> bool:
    with suppress(InputError, LimitExceeded):
        read_input(text)
    return True


@pytest.mark.parametrize("text", TEXTS)
def test_texts_that_break_off(text: str) -> None:
    assert all(is_read_or_refused(text[:k]) for k in range(len(text) + 1))


@pytest.mark.parametrize("command", [r"\frac", r"\sqrt", "sin(", "diff("])
def test_unfinished_text_may_be_deep(command: str) -> None:
    assert is_read_or_refused("y'' = " + 900 * command + "x")


@parametrize("first", TOKENS, ordinary=0, long=(0, 4, 8, 12, 14))
def test_tokens_in_any_order(first: str) -> None:
    for others in product(TOKENS, repeat=2):
        text = first + "".join(others)
        assert is_read_or_refused(text)
        assert is_read_or_refused(f"y'' = {text}")

"""What an answer in numbers costs, in looks at the clock, and how sharp it is: rows of both, which any machine finds again.

A row says what the work is, not what it has to be.  A change that is meant puts the row that the failure prints in its place;
one that isn't meant, a slower or a blunter way, doesn't pass unseen.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from decimal import Decimal
from functools import _lru_cache_wrapper
from typing import Any

from clocks import controlled

from kovacic import Ball


def printed(ball: Ball) -> str:
    """Its midpoint to 15 digits, where an imaginary part may be more than rounding errors, and its radius to two."""
    middle = f"{ball.mid:.15g}" if abs(ball.mid.imag) > ball.radius else f"{ball.mid.real:.15g}"
    return f"{middle} ± {str(ball).partition('± ')[2] or 0}"


def _balls(found: Any) -> Iterator[Ball]:
    if isinstance(found, Ball):
        yield found
    else:
        for one in found:
            yield from _balls(one)


def _forget() -> None:
    """Empty what is kept from one call to the next, or the work would depend on the tests that came before."""
    modules = [module for name, module in sys.modules.items() if name.startswith("kovacic.")]
    for kept in {
        value for module in modules for value in vars(module).values() if isinstance(value, _lru_cache_wrapper)
    }:
        kept.cache_clear()


def check_work(call: Callable[[], Any], looks: int, balls: list[str]) -> None:
    """The looks at the clock during the call, and the balls of what it returns, whose radii depend a little on FLINT."""
    _forget()
    with controlled() as hands:
        found = call()
    shown = [*map(printed, _balls(found))]
    row = f"{hands.looks}, {shown!r}"
    assert hands.looks == looks, row
    assert len(shown) == len(balls), row
    for one, other in zip(shown, balls, strict=True):
        (middle, radius), (other_middle, size) = (text.split(" ± ") for text in (one, other))
        assert middle == other_middle, row
        assert abs(Decimal(radius) - Decimal(size)) <= Decimal(size) / 8, row

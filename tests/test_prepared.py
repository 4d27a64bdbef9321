"""Solutions that keep what was computed: the digits of a call are its own, and no call changes what the next one answers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import kovacic

CALLS: list[tuple[str, dict[str, Any]]] = [
    ("-1", {"x0": 0, "y0": 0, "dy0": 1}),
    ("x", {"x0": 0, "y0": 1, "dy0": 0}),
    ("x^2 + 3", {"x0": 0, "y0": 0, "dy0": 1}),
    ("x^2*y'' + x*y' + x^2*y = 0", {"x0": 0, "which": "regular"}),
    ("1", {"x0": 0, "y0": 1, "dy0": -1}),
]


@pytest.mark.parametrize(("equation", "start"), CALLS)
def test_a_call_far_away_changes_no_answer(equation: str, start: dict[str, Any]) -> None:
    first = kovacic.evaluate(equation, "3/2", **start)
    kovacic.evaluate(equation, 10**60 if equation == "-1" else 12, **start)
    assert str(kovacic.evaluate(equation, "3/2", **start)) == str(first)


@pytest.mark.parametrize(("equation", "start"), CALLS)
def test_a_solution_is_prepared_with_digits_per_call(equation: str, start: dict[str, Any]) -> None:
    solution = kovacic.solve(equation)
    prepared = solution.prepared(digits=20, **start)
    sharp = prepared("3/2", digits=50)
    assert sharp.digits >= 50
    assert prepared("3/2").digits >= 20
    assert sharp.overlaps(solution.at("3/2", digits=60, **start))
    with pytest.raises(kovacic.InputError, match="beyond the limit"):
        prepared("3/2", digits=10**9)


def test_complex_values_beyond_the_doubles_are_infinite_in_arrays_too() -> None:
    table = kovacic.tabulate("1", 0, 1000, x0=0, y0="1 + I", dy0="1 + 2*I")
    assert str(table(900.0)) == str(complex(table(np.array([900.0]))[0]))
    assert np.isinf(table(np.array([900.0]))[0].real)

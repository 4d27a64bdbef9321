"""Solutions that keep what was computed: the digits of a call are its own, and no call changes what the next one answers."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest
from build import parametrize

import kovacic
from kovacic.enclosure.states import analytic_journeys, journey_of

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


OTHERS: list[tuple[str, dict[str, Any]]] = [
    ("y'' + 10*y = sin(3*x)", {"x0": 0, "y0": 1, "dy0": "1/3"}),
    ("y'' + sqrt(2)*y = sqrt(x)", {"x0": 1, "y0": 1, "dy0": 0}),
    ("y'' + exp(x)*y = 0", {"x0": 0, "y0": 1, "dy0": 0}),
    ("y'' + (2 + sin(x))*y = 0", {"x0": 0, "y0": 1, "dy0": 0}),
    ("y'' + y/(x + 3) + y/(x^2 + 1) = 0", {"x0": 1, "y0": "1 + I", "dy0": "pi"}),
    ("-(x^2 + 1)/(x^2 + 4)", {"x0": 0, "y0": 1, "dy0": 0}),
    ("y'' + 100*y' + y = 0", {"x0": 0, "y0": 1, "dy0": 0}),
]


@pytest.mark.parametrize("seed", range(2))
@parametrize(("equation", "start"), [*CALLS, *OTHERS], ordinary=4, long=9)
def test_no_value_depends_on_what_was_asked_before(equation: str, start: dict[str, Any], seed: int) -> None:
    """Lists, single points, digits and orders: each ball is that of a solution of which nothing else was asked."""
    rng = random.Random(f"{equation} {seed}")
    places = ["3/2", "1/7", 2, "20/3", "sqrt(3)", "1 + I/2", *([12, 40] if equation == "-1" else [])]
    calls = [(rng.sample(places, rng.randint(1, 4)), rng.choice([5, 15, 40])) for _ in range(6)]
    together = kovacic.prepared(equation, **start)
    found = [together(points, digits=digits, derivative=True) for points, digits in calls]
    for (points, digits), values in zip(calls, found, strict=True):
        for journeys in (journey_of, analytic_journeys):
            journeys.cache_clear()
        alone = kovacic.prepared(equation, **start)(points, digits=digits, derivative=True)
        assert [*map(repr, alone)] == [*map(repr, values)]


@parametrize(("equation", "start"), [*OTHERS, *CALLS], always=[OTHERS[-1]], ordinary=2)
def test_two_orders_of_calls_give_the_same_balls(equation: str, start: dict[str, Any]) -> None:
    """Points in one disc, at its ends and beyond, asked for in an order and in the reverse one: what a disc keeps is the same,
    whoever asked first."""
    calls = [["sqrt(3)", "1/7", 2], ["1/7", "sqrt(3)", "3/2"], ["1/7"], ["3/2", 1], [2, "1 + I/2"], ["20/3", "1/2"]]
    found = []
    for order in (calls, calls[::-1]):
        for journeys in (journey_of, analytic_journeys):
            journeys.cache_clear()
        together = kovacic.prepared(equation, method="taylor", **start)
        found.append({str(points): [*map(repr, together(points, derivative=True))] for points in order})
    assert found[0] == found[1]


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

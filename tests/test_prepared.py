"""A prepared solution: the values are those of single calls, whatever was asked before, and nothing is expanded twice."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from build import bounded_work, parametrize

import kovacic

START = {"x0": 0, "y0": 1, "dy0": "-1/3"}
EQUATIONS: list[tuple[str, dict[str, Any]]] = [
    ("x^3 + 1", START),
    ("(x + 1)/((x^2 + 2)*(x^2 + 3))", START),
    ("(x + 5)*y'' + y' + x*y = 0", START),
    ("y'' + sqrt(2)*x*y = 0", START),
    ("y'' + y = 1/(x + 5)", START),
    ("y'' + (2 + cos(x))*y = 0", START),
    ("y'' + tan(x/9)*y' + exp(-x^2)*y = cos(x)", START),
    ("x^2*y'' + x*y' + x^2*y = 0", {"x0": 0, "which": "regular"}),
]


@parametrize(("equation", "start"), EQUATIONS, ordinary=1)
def test_values_in_any_order_are_those_of_single_calls(equation: str, start: dict[str, Any]) -> None:
    rng = random.Random(equation)
    solution = kovacic.prepared(equation, **start, digits=20)
    places = [Fraction(rng.randint(1, 40), 10) for _ in range(8)]
    if "which" not in start:
        places += [-place for place in places[:4]]
    for place in places:
        y, dy = solution(place, derivative=True)
        # by more digits, so that it is another journey
        other, slope = kovacic.evaluate(equation, place, derivative=True, digits=33, **start)
        assert y.digits > 19
        assert y.contains(other.midpoint[0])
        assert dy.overlaps(slope)
    together = solution(places)
    assert all(ball.overlaps(solution(place)) for ball, place in zip(together, places, strict=True))


@pytest.mark.parametrize(("equation", "start"), [pair for pair in EQUATIONS if "1/(x + 5)" not in pair[0]][:-1])
def test_nothing_is_expanded_twice(equation: str, start: dict[str, Any]) -> None:
    solution = kovacic.prepared(equation, **start, method="taylor")
    solution([3, -3])
    rng = random.Random(0)
    with bounded_work(0):
        for _ in range(20):
            solution(rng.uniform(-3, 3), derivative=True)
        # a single call for the same solution begins where that one ended
        kovacic.evaluate(equation, "7/5", **start)
    with pytest.raises(kovacic.LimitExceeded), bounded_work(0):
        solution(4)


def test_arrays_and_complex_points() -> None:
    airy = kovacic.prepared("x", x0=0, y0=1, dy0=0)
    found = airy(np.array([[0.0, 1.0], [math.nan, -2.0]]))
    assert found.shape == (2, 2)
    assert math.isnan(found[1, 0])
    assert float(found[0, 0]) == 1
    assert airy("1 + I").overlaps(kovacic.evaluate("x", "1 + I", x0=0, y0=1, dy0=0, digits=30))
    assert repr(airy) == "<Prepared x0=0, y0=1, dy0=0, 15 digits>"


@pytest.mark.long
def test_a_singular_point_is_no_place_to_go_beyond() -> None:
    """The second question looks farther than its point; what is there isn't its matter."""
    for equation in ("1/(x - 2)^2", "y'' + y/sin(x - 2) = 0"):
        solution = kovacic.prepared(equation, x0=0, y0=1, dy0=0)
        for place in (1, "3/2", "7/4", "15/8", "1999/1000"):
            assert solution(place).digits > 14
        with pytest.raises(kovacic.InputError):
            solution(3)
        assert solution("-1/2").digits > 14


def test_a_closed_form_that_was_chosen_serves_the_next_values_at_its_precision() -> None:
    # a polynomial of degree 27 that cancels: the first precisions don't suffice, and aren't tried again
    solution = kovacic.prepared("-1 + 756/(x + 1)^2", x0="1/3", y0=1, dy0="1/5", digits=5, method="closed form")
    first = solution(2)
    second = solution("7/4")
    assert first.route is not None
    assert second.route is not None
    assert (first.route.runs > 1, second.route.runs) == (True, 1)
    assert second.route.bits == first.route.bits
    assert second.overlaps(kovacic.evaluate("-1 + 756/(x + 1)^2", "7/4", x0="1/3", y0=1, dy0="1/5", method="taylor"))


def test_many_later_values_of_a_chosen_closed_form_go_by_discs() -> None:
    solution = kovacic.prepared("-1 - 5/(36*x^2)", x0=1, y0=1, dy0=0)
    far = solution(20)
    assert far.route is not None
    assert far.route.method == "closed form"
    crowd = solution([1 + Fraction(k, 40) for k in range(1, 700)])
    assert {ball.route.method for ball in crowd} == {"taylor"}
    assert crowd[-1].overlaps(
        kovacic.evaluate("-1 - 5/(36*x^2)", 1 + Fraction(699, 40), x0=1, y0=1, dy0=0, method="closed form")
    )

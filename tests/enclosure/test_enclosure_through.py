"""Equations that are rational in exp(k x): values in t are those along the discs in x, which a vertex on the way demands."""

from __future__ import annotations

import random
from typing import Any

from build import bounded_work, parametrize

import kovacic

FUNCTIONS = [
    "exp(x)",
    "exp(-x/2)",
    "cosh(x)",
    "sinh(x)",
    "tanh(x)",
    "sech(x/2)^2",
    "1/(2 + exp(x))",
    "exp(2*x) - 3*exp(x)",
    "coth(x + 4)",
]


def member(seed: int) -> str:
    rng = random.Random(seed)
    b, c = rng.choice(["0", "0", *FUNCTIONS]), rng.choice(FUNCTIONS)
    f = rng.choice(["0", "0", "1", "exp(x)", "x", "cos(x)"])
    return f"y'' + {rng.randint(-3, 3)}/3*({b})*y' + ({rng.randint(-5, 5)} + a*({c}))*y = {f}"


@parametrize("first", range(0, 40, 10), ordinary=0, long=1)
def test_values_through_a_change_of_variable(first: int) -> None:
    for seed in range(first, first + 10):
        rng = random.Random(-seed)
        start: dict[str, Any] = {
            "x0": rng.choice([0, "1/3", "sqrt(2)", -1]),
            "y0": rng.choice([1, "1 + I"]),
            "dy0": "-1/3",
        }
        start["params"] = {"a": rng.choice(["2", "1/2", "sqrt(3)", "-1"])}
        points = ["9/5", -2, "pi/2", "1/7"]
        found = kovacic.evaluate(member(seed), points, derivative=True, **start)
        others = kovacic.evaluate(member(seed), points, derivative=True, path=["1/2"], **start)
        for ball, other in zip(found, others, strict=True):
            assert all(one.overlaps(two) for one, two in zip(ball, other, strict=True)), member(seed)
            assert ball[0].digits >= 15


def test_far_away_it_takes_little_work() -> None:
    """y'' + exp(x) y = 0 is Bessel's equation in t = exp(x); discs in x would be twenty million."""
    with bounded_work(2000):
        y, dy = kovacic.evaluate("y'' + exp(x)*y = 0", 40, x0=0, y0=1, dy0="1/3", derivative=True)
        kovacic.evaluate("y'' + exp(2*x)*y = 0", 10, x0=0, y0=1, dy0=0)
    assert y.digits >= 15
    assert dy.digits >= 15
    start = dict(
        zip(("y0", "dy0"), kovacic.evaluate("y'' + exp(x)*y = 0", 0, x0=20, y0=1, dy0=0, derivative=True), strict=True)
    )
    assert kovacic.evaluate("y'' + exp(x)*y = 0", 20, x0=0, **start).contains(1)

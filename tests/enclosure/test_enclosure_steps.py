"""Discs of equations with any functions: chosen by the size of all three coefficients, and foreseen where they are too many."""

from __future__ import annotations

import itertools
import random
from typing import Any

import numpy as np
import pytest
from build import bounded_work, parametrize
from scipy.integrate import solve_ivp

import kovacic
from kovacic.enclosure.analytic import period_of
from kovacic.enclosure.functions import coefficients_of_any
from kovacic.limits import CLOCK

BUMPS = [
    "exp(-x^2)",
    "exp(-(x-5)^2)",
    "erf(1/(x^2-2*x+2))",
    "1/(1 + 25*(x-3)^2)",
    "exp(-x^4/9)",
    "sin(x^2/9)*exp(-x/5)",
]


def integrated(b: str, c: str, f: str, stops: list[float]) -> list[float]:
    from scipy.special import erf

    names = {"exp": np.exp, "sin": np.sin, "cos": np.cos, "erf": erf, "tanh": np.tanh}
    code = [compile(part.replace("^", "**"), "equation", "eval") for part in (b, c, f)]

    def slope(x: float, state: Any) -> list[float]:
        b_value, c_value, f_value = (eval(part, names | {"x": x}) for part in code)
        return [state[1], f_value - b_value * state[1] - c_value * state[0]]

    return list(solve_ivp(slope, (0, stops[-1]), [1, 0], "DOP853", t_eval=stops, rtol=1e-10, atol=1e-12).y[0])


@parametrize("seed", range(8), ordinary=0, long=1)
def test_bumps_are_passed_in_few_discs(seed: int) -> None:
    rng = random.Random(seed)
    b, c, f = rng.choice(["0", "tanh(x)"]), rng.choice(["1", "2 + cos(x)", *BUMPS]), rng.choice([*BUMPS, "0"])
    equation = f"y'' + ({b})*y' + ({c})*y = {f}"
    stops = [1.0, 2.0, 25.0]
    with bounded_work(60_000):
        found = kovacic.evaluate(equation, stops, x0=0, y0=1, dy0=0)
        table = kovacic.tabulate(equation, 0, 25, x0=0, y0=1, dy0=0)
    others = integrated(b, c, f, stops)
    size = max(1.0, *map(abs, others))
    for stop, ball, other in zip(stops, found, others, strict=True):
        assert abs(float(ball) - other) < 1e-7 * size, equation
        assert abs(table(stop) - float(ball)) < 1e-12 * size, equation


@pytest.mark.parametrize(
    ("equation", "x"), [("y'' + exp(x^2)*y = 0", 7), ("y'' + exp(exp(x))*y = 0", 5), ("y'' + exp(x)*y = x", 40)]
)
def test_too_many_discs_are_foreseen(equation: str, x: int) -> None:
    with bounded_work(100), pytest.raises(kovacic.LimitExceeded, match=r"takes .* steps or more"):
        kovacic.evaluate(equation, x, x0=0, y0=1, dy0=0)


def test_discs_are_foreseen_by_the_size_of_functions_beside_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """|sin(x^5)| <= 1 on the way, and about exp(5 x^4 |y|) beside it; beside a pole discs are small, but few.

    At 0 no disc shows that sqrt(x) is analytic.
    """
    ticks = itertools.count()
    monkeypatch.setattr(CLOCK, "now", lambda: next(ticks) / 100)
    start = {"x0": 0, "y0": 1, "dy0": 0, "limits": kovacic.Limits(seconds=1000)}
    for coefficient in ("sin(x^5)", "sin(x^5)*sqrt(x)"):
        with pytest.raises(kovacic.LimitExceeded, match="the way from 0 to 30 takes about"):
            kovacic.evaluate(f"y'' + {coefficient}*y = 0", 30, **start)
    assert kovacic.evaluate("y'' + cos(x)/((x - 15)^2 + 1/10^6)*y = 0", 30, **start).digits >= 15


@pytest.mark.parametrize(
    ("S", "x0", "x"),
    [
        ("-(x^2+1)/(x^2+4)", 0, 1000),
        ("x", 0, -150),
        ("x", -150, -2),
        pytest.param("x", -40, -150, marks=pytest.mark.long),
        pytest.param("x - x^3", 1, 40, marks=pytest.mark.long),
        ("(1-x)/(x^2+5)", 3, 300_000),
        ("-2 + 3/(x^2+1)", -900, 700),
        pytest.param("-(x^2+9*x+1)/(2*x^2+4)", -1000, 900, marks=pytest.mark.long),
    ],
)
def test_oscillations_far_out_are_those_that_discs_beside_the_axis_find(S: str, x0: int, x: int) -> None:
    start: dict[str, Any] = {"x0": x0, "y0": 1, "dy0": "1/3", "derivative": True, "method": "taylor"}
    with bounded_work(1600):
        states = kovacic.evaluate(S, [x, x + 1], **start)
    (around,) = kovacic.evaluate(S, [x], path=[(x0 + x) // 2 + 0.5j], digits=35, **start)
    for ball, other in zip(states[0], around, strict=True):
        assert other.radius < ball.radius
        assert ball.overlaps(other)


def test_thousands_of_oscillations_are_one_step() -> None:
    with bounded_work(1600):
        value = kovacic.evaluate("-(x^2+1)/(x^2+4)", 10**5, x0=0, y0=1, dy0=0)
    assert float(value) == pytest.approx(-0.02070360324758066, abs=1e-17)  # 3,131 discs gave the same


@pytest.mark.parametrize("coefficient", ["sin(x^2 + x)", "sin(x) + cos(sqrt(2)*x)", "sin(x)/(x + 2)"])
def test_functions_without_a_period_have_none(coefficient: str) -> None:
    given = coefficients_of_any(f"y'' + ({coefficient})*y = 0", None, kovacic.Limits())
    assert period_of(given) is None


def test_a_gauge_with_conjugate_poles_keeps_values_real() -> None:
    assert kovacic.evaluate("y'' + 2*x/(x^2 + 1)*y' + y = 0", 1, x0=0, y0=1, dy0=0).real

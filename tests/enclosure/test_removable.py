"""Coefficients with removable singularities: entire where they are written as quotients.

The truth is an integration by SciPy of functions that are given by their limits there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from build import parametrize
from scipy.integrate import solve_ivp

import kovacic

CASES: list[tuple[str, float, float, Callable[[float], float], float]] = [
    ("(1 - cos(x))/x^2", 0, 1, lambda x: 2 * (math.sin(x / 2) / x) ** 2, 0.5),
    ("x/(exp(x) - 1)", -1, 1, lambda x: x / math.expm1(x), 1),
    ("log(x)/(x - 1) + 1/(x + 5)", 0.5, 2, lambda x: math.log(x) / (x - 1) + 1 / (x + 5), 1 + 1 / 6),
    ("a*sin(x)^2/(x^2 + x^2*a)", -1, 1, lambda x: 0.75 * (math.sin(x) / x) ** 2, 0.75),
    ("x*cot(x)", -1, 1, lambda x: x / math.tan(x), 1),
    ("sin(x)/x*sqrt(x + 1/9)", 0, 1, lambda x: math.sin(x) / x * math.sqrt(x + 1 / 9), 1 / 3),
    ("(1 - cos(x))/x^2/(x + 10^(-4))", 0, 0.1, lambda x: 2 * (math.sin(x / 2) / x) ** 2 / (x + 1e-4), 5e3),
    ("9^5*(sin(x) - x)^5/x^15", -1, 1, lambda x: (9 * sine_less_x(x)) ** 5, -(1.5**5)),  # a zero of order 15
]


def sine_less_x(x: float) -> float:
    """(sin(x) - x)/x^3."""
    return sum((-1) ** k * x ** (2 * k - 2) / math.factorial(2 * k + 1) for k in range(1, 12))


@parametrize(("coefficient", "x0", "x", "function", "limit"), CASES, ordinary=(0, 4, 7), long=2)
def test_removable_singularities_are_on_the_way(
    coefficient: str, x0: float, x: float, function: Callable[[float], float], limit: float
) -> None:
    def slope(t: float, state: Any) -> Any:
        near = abs(t - ("log" in coefficient)) < 1e-12
        return [state[1], -(limit if near else function(t)) * state[0]]

    params = {"a": 3} if "a*" in coefficient else None
    given = {"x0": x0, "y0": 1, "dy0": 0, "params": params}
    balls = kovacic.evaluate(f"y'' + ({coefficient})*y = 0", x, derivative=True, **given)
    found = solve_ivp(slope, (x0, x), [1.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-13)
    for ball, other in zip(balls, found.y[:, -1], strict=True):
        assert abs(complex(ball) - other) < 1e-10
        assert ball.digits >= 14
    sharper = kovacic.evaluate(f"y'' + ({coefficient})*y = 0", x, digits=50, **given)
    assert abs(sharper.to_mpmath() - balls[0].to_mpmath()) <= balls[0].radius


@parametrize("coefficient", ["cos(x)/x", "sin(x)/x^2", "sqrt(x)/x", "x/sin(x)/(x - 1/2)"], ordinary=(2,), long=1)
def test_poles_stay_singular(coefficient: str) -> None:
    with pytest.raises(kovacic.InputError, match="analytic"):
        kovacic.evaluate(f"y'' + ({coefficient})*y = 0", 1, x0=-1, y0=1, dy0=0)


def test_tables_go_through_them() -> None:
    table = kovacic.tabulate("y'' + sin(x)/x*y = 0", -1, 1, x0=0, y0=1, dy0=0)
    ball = kovacic.evaluate("y'' + sin(x)/x*y = 0", 1, x0=0, y0=1, dy0=0)
    assert table(1.0) == pytest.approx(float(ball), rel=1e-14)
    assert table(-1.0) == pytest.approx(float(ball), rel=1e-14)

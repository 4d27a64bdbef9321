"""Balls as points, initial values and parameters: the result holds for every number in them."""

from __future__ import annotations

import cmath
import random
import re
from collections.abc import Callable
from fractions import Fraction
from math import cos, cosh, exp, nextafter, sin, sinh
from typing import Any

import flint
import pytest
from build import ball_to_flint, parametrize
from flint import arb, fmpq

import kovacic
from kovacic import evaluate

# n is a parameter; the points are between -3 and 3, or between 1 and 3 where 0 is singular
EQUATIONS = {
    -3: [
        "x^2 - 3",
        "y'' + y = exp(x)",
        "y'' + n*y = x^2",
        "n*x + 1",
        "y'' + (x + n)*y' + y = cos(n*x)",
        "1/(x + 6)^2 - n",
        "(x + 7)*y'' + y' - n*y = log(x + 8)",
        "(n + I)*x",
        "y'' + sqrt(2)*y' + n*y = 1/(x + 9)",
        "(112 - 20*x - 5*x^2)/(36*(x^2 + 4*x + 10)^2)",
    ],
    1: ["y'' + y'/x + y = 1/x", "x^2*y'' + x*y' + (x^2 - 1/9)*y = 0"],
}
RADII = [Fraction(0), Fraction(0), Fraction(1, 64), Fraction(1, 1000), Fraction(1, 10**9)]


def rational(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def encloses(seed: int) -> None:
    rng = random.Random(seed)
    low = rng.choice(list(EQUATIONS))
    equation = rng.choice(EQUATIONS[low])
    names = ["x", "x0", "y0", "dy0", *re.findall(r"\bn\b", equation)[:1]]
    middle = {name: Fraction(rng.randint(low * 8, 24), 8) for name in names}
    radius = {name: rng.choice(RADII) for name in names}

    def call(given: dict[str, Any], **options: Any) -> Any:
        x, params = given["x"], {"params": {"n": given["n"]}} if "n" in given else {}
        start = {name: given[name] for name in ("x0", "y0", "dy0")}
        return evaluate(equation, x, **start, **params, **options, derivative=True)

    balls = {k: arb(rational(middle[k]), rational(radius[k])) if radius[k] else middle[k] for k in names}
    found = call(balls, digits=rng.choice([5, 15, 30]))
    for _ in range(3):
        inside = {k: middle[k] + radius[k] * Fraction(rng.choice([-8, 8, rng.randint(-8, 8)]), 8) for k in names}
        with flint.ctx.workprec(300):
            for wide, sharp in zip(found, call(inside, digits=40, method="taylor"), strict=True):
                assert ball_to_flint(wide).overlaps(ball_to_flint(sharp)), (equation, balls, inside)


@parametrize("seed", range(60), ordinary=4, long=24)
@pytest.mark.filterwarnings("ignore::kovacic.enclosure.evaluate.AccuracyWarning")
def test_every_number_in_the_balls_is_served(seed: int) -> None:
    encloses(seed)


Function = Callable[[float], float]


@pytest.mark.filterwarnings("ignore::kovacic.enclosure.evaluate.AccuracyWarning")
@pytest.mark.parametrize(
    ("equation", "y", "dy", "most"),
    [
        ("y'' = 14", lambda x: 7 * x**2 + 3 * x, lambda x: 14 * x + 3, (2.01, 2.08)),
        ("y'' = 14", lambda x: 7 * x**2, lambda x: 14 * x, (3.5, 1.8)),
        ("y'' = 14", lambda x: 7 * x**2 + 5, lambda x: 14 * x, (156, 2.1)),
        ("y'' = 400*y", lambda x: 3 * cosh(20 * x), lambda x: 60 * sinh(20 * x), (7.5, 1.2)),
        ("y'' = 400*y", lambda x: 0.15 * sinh(20 * x), lambda x: 3 * cosh(20 * x), (1.2, 7.5)),
        (
            "y'' + 30*y' = 60",
            lambda x: 2 * x + 1.1 - exp(-30 * x) / 10,
            lambda x: 2 + 3 * exp(-30 * x),
            (7.1, 10.7),
        ),
        (
            "y'' + y = 500",
            lambda x: 500 - 500 * cos(x) + 7 * sin(x),
            lambda x: 500 * sin(x) + 7 * cos(x),
            (2.4, 3.3),
        ),
    ],
)
def test_a_ball_around_a_point_gives_few_values_beyond_those_in_it(
    equation: str, y: Function, dy: Function, most: tuple[float, float]
) -> None:
    """The radius is at most `most` times what the function changes by, also where only the right-hand side changes it."""
    r = 1 / 64
    found = evaluate(equation, arb(0, r), x0=0, y0=y(0), dy0=dy(0), derivative=True)
    for ball, f, times in zip(found, (y, dy), most, strict=True):
        assert ball.contains(f(r))
        assert ball.contains(f(-r))
        assert float(ball.radius) <= times * max(abs(f(r) - f(0)), abs(f(-r) - f(0)))


def test_a_real_ball_has_complex_values_where_the_coefficients_are_complex() -> None:
    with pytest.warns(kovacic.AccuracyWarning):
        found = evaluate("y'' = 200*I*y", arb(0, 0.125), x0=0, y0=3, dy0=0)
    assert not found.real
    assert found.contains(3 * cmath.cosh((10 + 10j) / 8))


def test_edges_of_balls() -> None:
    """Doubles on the outer side; discs that touch overlap, and one contains another that touches it from inside."""
    half = kovacic.Ball((1, 0), rad=(1, -1))
    assert (half.lower, half.upper) == (0.5, 1.5)
    tiny = kovacic.Ball((-3, -2), rad=(1, -70))
    assert (tiny.lower, tiny.upper) == (nextafter(-0.75, -1), nextafter(-0.75, 0))
    disc = kovacic.Ball((3, 0), (4, 0), rad=(5, 0), real=False)
    assert disc.contains(0)
    assert not disc.contains(kovacic.Ball((0, 0), rad=(1, -9)))
    assert disc.contains(kovacic.Ball((6, 0), (8, 0), real=False))
    assert not disc.contains(kovacic.Ball((6, 0), (9, 0), real=False))
    assert half.overlaps(kovacic.Ball((2, 0), rad=(1, -1)))
    assert not half.overlaps(kovacic.Ball((33, -4), rad=(1, -1)))
    assert kovacic.Ball((0, 0), rad=(1, 0)).contains(kovacic.Ball((1, -1), rad=(1, -1)))
    assert not kovacic.Ball((0, 0), rad=(1, 0)).contains(kovacic.Ball((5, -3), rad=(1, -1)))
    with pytest.raises(TypeError, match="complex numbers have no order"):
        _ = disc.upper
    assert str(kovacic.Ball((-7, -3))) == "-0.875" + "0" * 37
    small = kovacic.Ball((3, -2), (5, 0), rad=(1, -60), real=False)
    assert small._repr_latex_() == r"$(0.75000000000000000000 + 5.0000000000000000000\,i) \pm 8.7 \cdot 10^{-19}$"
    assert kovacic.Ball((7, -2), rad=(1, -8)).to_dict() == {"re": "1.75000", "im": "0", "radius": "0.0040"}


def test_routes_are_named() -> None:
    def route(equation: str, x: int, **options: Any) -> str:
        return str(kovacic.evaluate(equation, x, x0=0, **options).route)

    growing = {"y0": 1, "dy0": -1, "digits": 15, "method": "taylor"}
    assert route("1", 2, **growing) == "Taylor's method, 73 bits, 1 run"
    assert route("1", 50, **growing) == "Taylor's method, 201 bits, 2 runs"
    assert route("x^2 + 5", 2, y0=1, dy0=2, digits=30, method="closed form") == "a closed form, 123 bits, 1 run"

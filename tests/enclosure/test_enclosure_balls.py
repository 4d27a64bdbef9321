"""Balls as points, initial values and parameters: the result holds for every number in them."""

from __future__ import annotations

import random
import re
from fractions import Fraction
from typing import Any

import flint
import pytest
from build import ball_to_flint, parametrize
from flint import arb, fmpq

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

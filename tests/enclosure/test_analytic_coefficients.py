"""Values where coefficients are any functions of x: a solution is chosen first, and the equation is made from it."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from build import parametrize

import kovacic

x = sympy.Symbol("x")
SOLUTIONS = [
    sympy.sin(x) + 2,
    sympy.exp(sympy.sin(x)),
    sympy.cos(x) ** 2 + x,
    sympy.sqrt(x + 3),
    sympy.log(x + 4) + x**2,
    sympy.exp(-(x**2)) + 1,
    sympy.atan(x) + 3,
]
FIRST = [
    "0",
    "cot(x)",
    "tan(x/2)",
    "sin(2*x)",
    "exp(-x^2)",
    "log(x)",
    "1/sqrt(x)",
    "x^(1/3)",
    "1/(2 + cos(x))",
    "asinh(x)",
]
ZEROTH = [
    "6",
    "sin(2*x) + 2",
    "1/cos(x/3)^2",
    "exp(x) + x",
    "sec(x/2)",
    "erf(x)",
    "x*log(x + 1)",
    "acos(x/9)",
    "tanh(x)",
]


def member(seed: int) -> tuple[str, Any]:
    """y'' + b y' + c y = f with f made from the solution, as text, and the solution."""
    rng = random.Random(seed)
    solution = rng.choice(SOLUTIONS)
    b, c = rng.choice(FIRST), rng.choice(ZEROTH)
    first, zeroth = (sympy.sympify(part.replace("^", "**")) for part in (b, c))
    right = sympy.expand(solution.diff(x, 2) + first * solution.diff(x) + zeroth * solution)
    return f"y'' + ({b})*y' + ({c})*y = {str(right).replace('**', '^')}", solution


def check(seed: int) -> float:
    """The error over the radius of values on the way from 1 to a point below 3."""
    equation, solution = member(seed)
    rng = random.Random(-seed - 1)
    place = Fraction(rng.randint(1, 11), 4)
    digits = rng.choice([10, 15, 30])
    start = {"x0": 1, "y0": str(solution.subs(x, 1)), "dy0": str(solution.diff(x).subs(x, 1))}
    y, dy = kovacic.evaluate(equation, place, derivative=True, digits=digits, **start)
    with mpmath.workdps(60):
        at = mpmath.mpf(place.numerator) / place.denominator
        worst = 0.0
        for ball, function in ((y, solution), (dy, solution.diff(x))):
            exact = sympy.lambdify(x, function, "mpmath")(at)
            error = abs(ball.to_mpmath() - exact)
            assert ball.digits >= digits - 1
            worst = max(worst, float(error / mpmath.mpf(ball.radius))) if ball.radius else worst
    return worst


@parametrize("seed", range(12), ordinary=1, long=7)
def test_the_chosen_solution_lies_in_the_ball(seed: int) -> None:
    assert check(seed) <= 1


@pytest.mark.slow
@pytest.mark.parametrize("block", range(30))
def test_the_chosen_solution_lies_in_the_ball_hundreds(block: int) -> None:
    assert max(check(1000 + 20 * block + k) for k in range(20)) <= 1


def odefun(b: Any, c: Any, x0: float, place: float) -> Any:
    """(y, y') by mpmath's Taylor series, for y(x0) = 1, y'(x0) = 0."""
    return mpmath.odefun(lambda t, s: [s[1], -b(t) * s[1] - c(t) * s[0]], x0, [1, 0])(place)


@parametrize(
    ("equation", "x0", "place", "b", "c"),
    [
        ("y'' + cot(x)*y' + 6*y = 0", 1, 2, mpmath.cot, lambda t: 6),  # Legendre's in the polar angle
        ("y'' + tan(x)*y' + y = 0", 0, 1, mpmath.tan, lambda t: 1),
        ("y'' + tan(x)^2*y = 0", 0, 1.25, lambda t: 0, lambda t: mpmath.tan(t) ** 2),
        ("y'' + sec(x)*y = 0", 2, 4, lambda t: 0, mpmath.sec),
        ("y'' + y/cos(x)^2 = 0", -1, 1, lambda t: 0, lambda t: mpmath.sec(t) ** 2),
        ("y'' + (2 + sin(2*x))*y = 0", 0, 2, lambda t: 0, lambda t: 2 + mpmath.sin(2 * t)),
        ("y'' + (2 + cos(x) + sin(2*x))*y = 0", 0, 7, lambda t: 0, lambda t: 2 + mpmath.cos(t) + mpmath.sin(2 * t)),
    ],
    ordinary=0,
    long=1,
)
def test_trigonometric_equations_between_their_singular_points(
    equation: str, x0: Any, place: Any, b: Any, c: Any
) -> None:
    """As text and solved, as a ball and in a table."""
    start = {"x0": x0, "y0": 1, "dy0": 0}
    with mpmath.workdps(20):
        own = odefun(b, c, x0, place)
    for found in (
        kovacic.evaluate(equation, place, derivative=True, **start),
        kovacic.solve(equation).at(place, derivative=True, **start),
    ):
        for ball, value in zip(found, own, strict=True):
            assert ball.real
            assert abs(ball.to_mpmath() - value) < 1e-14
    table = kovacic.tabulate(equation, x0, place, **start)
    assert table(float(place)) == pytest.approx(float(own[0]), rel=1e-14)


@pytest.mark.long
def test_what_cancels_is_no_singular_point() -> None:
    """sin(2x)/sin(x) = 2 cos(x), (1 - cos(x)^2)/sin(x) = sin(x)."""
    start = {"x0": 0, "y0": 1, "dy0": 0}
    given = kovacic.evaluate("y'' + sin(2*x)/sin(x)*y = 0", 4, **start)
    plain = kovacic.evaluate("y'' + 2*cos(x)*y = 0", 4, **start)
    assert given.overlaps(plain)
    assert given.digits > 15
    assert kovacic.evaluate("y'' + (1 - cos(x)^2)/sin(x)*y = 0", 4, **start).digits > 15


@pytest.mark.long
def test_a_complex_way_around_a_singular_point() -> None:
    """y = tan(x) + i has the equation y'' = 2 tan(x) y' by either side of pi/2."""
    equation = "y'' - 2*tan(x)*y' = 0"
    start = {"x0": 1, "y0": "tan(1)", "dy0": "1/cos(1)^2"}
    for vertex in ("3/2 + I", "3/2 - I"):
        value = kovacic.evaluate(equation, 2, path=[vertex], **start)
        assert abs(complex(value) - np.tan(2)) < 1e-14
    with pytest.raises(kovacic.InputError, match=r"near 1\.570796327, on the path from 1"):
        kovacic.evaluate(equation, 2, **start)
    together = kovacic.evaluate(equation, ["5/4", "3/4", 1], path="chain", **start)
    assert np.allclose([float(value) for value in together], np.tan([1.25, 0.75, 1]), rtol=1e-14)


KINK = ("y'' + asin(sin(x))*y = 0", 0, 3)
"""The slope is 1 before pi/2 and -1 behind: discs in balls that are too wide there become small too slowly, and never end."""


@parametrize(
    ("equation", "x0", "place"),
    [
        ("y'' + log(x)*y = 0", 1, -1),
        ("y'' + sqrt(x)*y = 0", 1, -1),
        ("y'' + y/(x - sqrt(2)) + exp(x)*y = 0", 1, 2),
        ("y'' + y/sin(x^2) = 0", 1, 3),
        ("y'' + log(cos(x))*y = 0", 0, 2),
        ("y'' + sqrt(x - 1)*y = exp(x)", 2, "1/2"),
        ("y'' + asin(x)*y = 0", 0, 2),
        ("y'' + acos(cos(x))*y = 0", 1, 4),
        KINK,
    ],
    ordinary=2,
    long=1,
    always=[KINK],
)
def test_no_singular_point_is_passed(equation: str, x0: Any, place: Any) -> None:
    with pytest.raises(kovacic.InputError, match="analytic"):
        kovacic.evaluate(equation, place, x0=x0, y0=1, dy0=0)


@pytest.mark.long
def test_parameters_constants_and_balls() -> None:
    """exp(k sin(x)) solves y'' = k (k cos(x)^2 - sin(x)) y; a start in a ball gives a ball that contains all values."""
    equation = "y'' = k*(k*cos(x)^2 - sin(x))*y"
    start = {"x0": "pi/4", "y0": "exp(sqrt(2)*sin(pi/4))", "dy0": "sqrt(2)*cos(pi/4)*exp(sqrt(2)*sin(pi/4))"}
    value = kovacic.evaluate(equation, "sqrt(2)", params={"k": "sqrt(2)"}, digits=30, **start)
    with mpmath.workdps(50):
        assert value.contains(value)
        assert abs(value.to_mpmath() - mpmath.exp(mpmath.sqrt(2) * mpmath.sin(mpmath.sqrt(2)))) < 1e-29
    wide = kovacic.evaluate("cos(x)", 1, x0=0, y0=kovacic.Ball.of(1), dy0=0)
    assert wide.digits > 15
    with pytest.raises(kovacic.InputError, match="values are needed for k"):
        kovacic.evaluate(equation, 1, x0=0, y0=1, dy0=0)


@pytest.mark.long
def test_many_digits_and_the_same_digits_by_few() -> None:
    start = {"x0": 0, "y0": 1, "dy0": 0}
    many = kovacic.evaluate("y'' + tan(x)*y' + exp(-x^2)*y = 0", 1, digits=300, **start)
    few = kovacic.evaluate("y'' + tan(x)*y' + exp(-x^2)*y = 0", 1, **start)
    assert many.digits >= 300
    assert few.contains(many.midpoint[0])


@parametrize(
    "text",
    [
        "y'' + sin(x/3)*y' + sin(x/7)^2*y = 0",
        "y'' + 1/2*csc(x/9)*y' + (-3*cos(x) + tan(x/5)^2)*y = 0",
        "y'' + tan(x/11)*y' + cos(3*x)*y = 0",
        "y'' + sin(x/3)*y' + (sec(x/5 + 1/3) + cot(2*x))*y = 0",
    ],
    ordinary=1,
    long=(1, 2),
)
def test_waves_of_which_the_common_angle_is_small(text: str) -> None:
    """Coefficients of high degree in exp(ix/45) are evaluated as they are written."""
    value = kovacic.evaluate(text, "7/5", x0="3/5", y0=1, dy0=0)
    b, c = text.removeprefix("y'' + ").removesuffix("*y = 0").split("*y' + ")
    first, zeroth = (sympy.lambdify(x, sympy.sympify(part.replace("^", "**")), "mpmath") for part in (b, c))
    (expected, _) = mpmath.odefun(lambda z, y: [y[1], -first(z) * y[1] - zeroth(z) * y[0]], 0.6, [1, 0])(1.4)
    assert abs(float(value) - expected) < 1e-10


@parametrize(
    ("text", "stop"),
    [
        ("y'' + sin(31*x)/sin(x)*y = 0", 5),
        ("y'' + (1 - cos(40*x))/sin(x)^2*y = 0", 5),
        ("y'' + sin(x/2)/(90*sin(x/14))*y' + cos(x/3)*y = 0", 50),
        ("y'' + sin(31*x)*csc(x)*y = 0", 5),
        ("y'' + (tan(20*x)*cos(20*x) + cot(x)*tan(x))*y = 0", 5),
    ],
    ordinary=0,
    long=1,
)
def test_quotients_of_waves_without_singular_points_are_on_the_way(text: str, stop: int) -> None:
    there = kovacic.evaluate(text, stop, x0=1, y0=1, dy0=0, derivative=True, digits=32)
    back = kovacic.evaluate(text, 1, x0=stop, y0=there[0], dy0=there[1])
    assert abs(float(back) - 1) < 1e-9


PERIODIC = [
    ("y'' = (cos(x)^2 - sin(x))*y", lambda x: mpmath.exp(mpmath.sin(x))),
    ("y'' + (2 + cos(x))*y = (1 + cos(x))*sin(x)", mpmath.sin),
    ("y'' + (w^2 + sin(w*x/2))*y = sin(w*x/2)*cos(w*x)", lambda x: mpmath.cos(mpmath.sqrt(3) * x)),
    ("y'' + exp(I*x)*y = exp(2*I*x) - exp(I*x)", lambda x: mpmath.exp(1j * x)),
]


@parametrize(
    ("problem", "x"), product(PERIODIC, [-70, "1234567.5", 10**15]), ordinary=(0,), long=2
)  # each equation, each place
def test_many_periods_are_one_step(problem: tuple[str, Any], x: Any) -> None:
    equation, exact = problem
    with mpmath.workdps(90):
        start = exact(mpmath.mpf(0)), mpmath.diff(exact, 0)
        y0, dy0 = (mpmath.nint(value.real) + 1j * mpmath.nint(value.imag) for value in start)
        params = {"w": "sqrt(3)"} if "w" in equation else None
        ball = kovacic.evaluate(equation, x, x0=0, y0=y0, dy0=dy0, params=params)
        assert ball.contains(mpmath.mpmathify(exact(mpmath.mpf(x))))
    assert ball.radius < 1e-8

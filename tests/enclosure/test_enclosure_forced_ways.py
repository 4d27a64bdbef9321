"""Right-hand sides at many points: kept ways have the values of the integration, and nothing is expanded twice."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from build import bounded_work, parametrize, sample
from scipy.integrate import solve_ivp

import kovacic

START = {"y0": 1, "dy0": "1/3"}


@parametrize(
    ("equation", "x0", "points"),
    [
        ("y'' + 10*y = sin(3*x)", 0, ["1/2", 3, -4, "77/10"]),
        ("y'' + x*y = 1/(x + 1)", 0, [1, 2, 3, 4]),
        ("x^2*y'' + x*y' + (x^2 - 4)*y = log(x)", 1, ["1/3", 2, 5, 9]),
        ("y'' + y'/(x - 1) + a*y = a*exp(x)", 2, [2, 3, "3/2", 6]),
    ],
    ordinary=1,
)
def test_values_on_kept_ways_are_those_of_the_integration(equation: str, x0: Any, points: list[Any]) -> None:
    start = {"x0": x0, **START} | ({"params": {"a": "2/3"}} if "a*y" in equation else {})
    ways = kovacic.evaluate(equation, points, digits=25, derivative=True, **start)
    others = kovacic.evaluate(equation, points, digits=25, derivative=True, method="taylor", **start)
    for pair, other in zip(ways, others, strict=True):
        assert all(first.overlaps(second) for first, second in zip(pair, other, strict=True))
        assert pair[0].digits >= 25


@pytest.mark.long
def test_a_side_matters_only_where_a_singular_point_is_passed() -> None:
    start = {"x0": 1, "path": "above", **START}
    equation = "y'' + y/(4*x^2) = exp(x)"
    together = kovacic.evaluate(equation, ["1/2", 2, 3, "5/2", -1], **start)
    alone = [kovacic.evaluate(equation, x, method="taylor", **start) for x in ("1/2", 2, 3, "5/2", -1)]
    assert all(first.overlaps(second) for first, second in zip(together, alone, strict=True))
    assert abs(complex(together[-1]).imag) > 0.1


@pytest.mark.parametrize("f", ["log(x)", "1/sqrt(x)", "sqrt(x)*log(x)", "exp(-1/x)", "sin(1/x)"])
@pytest.mark.parametrize(("x0", "x"), [(0, 1), (1, 0)])
def test_a_right_hand_side_without_a_value_at_an_end_is_refused_at_once(f: str, x0: int, x: int) -> None:
    with pytest.raises(kovacic.InputError, match="no value at 0"):
        kovacic.evaluate(f"y'' + y = {f}", x, x0=x0, **START)


@parametrize(("x0", "x"), [(0, "11/10"), (-1, "11/10"), (-1, 0), (-1, "1 + I")], ordinary=4)
@pytest.mark.parametrize("digits", [15, 40])
def test_removable_singularities_of_right_hand_sides_are_none(x0: int, x: str, digits: int) -> None:
    """y = sin(x)/x has y'' + y = (2 sin(x) - 2 x cos(x))/x^3."""
    equation = "y'' + y = (2*sin(x) - 2*x*cos(x))/x^3"
    y0, dy0 = ("1", "0") if x0 == 0 else ("sin(1)", "sin(1) - cos(1)")
    value = kovacic.evaluate(equation, x, x0=x0, y0=y0, dy0=dy0, digits=digits)
    exact = (
        kovacic.Ball(1) if x == 0 else kovacic.evaluate("x*y'' + 2*y' + x*y = 0", x, x0=0, which="regular", digits=50)
    )
    assert value.overlaps(exact)
    assert value.digits >= digits


def test_a_right_hand_side_that_is_singular_at_the_start_is_integrated() -> None:
    """y'' = sqrt(x) from 0: 4 x^(5/2)/15."""
    found = kovacic.evaluate("y'' = sqrt(x)", [1, 4, 9, 16], x0=0, y0=0, dy0=0)
    assert [float(value) for value in found] == pytest.approx([4 * x**2.5 / 15 for x in (1, 4, 9, 16)], rel=1e-13)


@pytest.mark.long
def test_a_coefficient_that_is_singular_at_the_start_is_integrated() -> None:
    """y'' + sqrt(x) y = 0 from 0 has sqrt(x) J(2/5, 4/5 x^(5/4)), whose derivative there is (2/5)^(2/5)/Gamma(7/5)."""
    with mpmath.workdps(60):
        slope = mpmath.mpf("0.4") ** mpmath.mpf("0.4") / mpmath.gamma(mpmath.mpf("1.4"))
        argument = mpmath.mpf("0.8") * mpmath.mpf("1.5") ** mpmath.mpf("1.25")
        exact = mpmath.sqrt(mpmath.mpf("1.5")) * mpmath.besselj(mpmath.mpf("0.4"), argument)
    value = kovacic.evaluate("y'' + sqrt(x)*y = 0", "3/2", x0=0, y0=0, dy0=slope, digits=30)
    assert value.digits >= 30
    assert abs(value.to_mpmath() - exact) < 1e-29


@pytest.mark.filterwarnings("ignore::kovacic.AccuracyWarning")
@parametrize(
    ("equation", "x0", "x"),
    [
        ("y'' + sqrt(x)*y = 0", 0, 2),
        ("y'' + sqrt(x)*y' + y = cos(x)", 0, 3),
        ("y'' + sqrt(2)*y = sqrt(x - 1)", 1, 3),
        ("y'' + sqrt(1 - x^2)*y = 0", -1, 1),
        ("(x + I)*y'' + y = sqrt(x - I)", "I", 2),
        ("y'' + x^(1/3)*y = x^sqrt(2)", 0, 2),
        ("y'' + (x - 1)^(4/3)*y' + y = cos(x)^(2/3)", 1, "3/2"),
    ],
    ordinary=(0,),
    long=(1, 5),
)
def test_there_and_back_from_an_end_without_power_series(equation: str, x0: Any, x: Any) -> None:
    y, dy = kovacic.evaluate(equation, x, x0=x0, digits=15, derivative=True, y0="2/3", dy0="1/3")
    back, slope = kovacic.evaluate(equation, x0, x0=x, y0=y, dy0=dy, digits=15, derivative=True)
    assert back.overlaps("2/3")
    assert slope.overlaps("1/3")
    assert min(y.digits, back.digits) > 12


@parametrize(
    ("c", "f", "x"),
    [("exp(x)", "x", 11), ("exp(x)", "1", 12), ("x^8", "exp(-x)", 6), ("400", "x/(x^2 + 1)", 90)],
    ordinary=1,
    long=1,
)
def test_a_right_hand_side_costs_no_digits(c: str, f: str, x: int) -> None:
    """Over hundreds of periods the first precision suffices, with a right-hand side as without."""
    for right in ("0", f):
        y, dy = kovacic.evaluate(f"y'' + {c}*y = {right}", x, x0=0, derivative=True, method="taylor", **START)
        assert y.route.runs == 1
    function = sympy.lambdify("x", [sympy.sympify(text.replace("^", "**")) for text in (c, f)])

    def slope(t: float, state: Any) -> Any:
        frequency, force = function(t)
        return [state[1], force - frequency * state[0]]

    found = solve_ivp(slope, (0, x), [1.0, 1 / 3], method="DOP853", rtol=1e-12, atol=1e-14)
    assert [float(y), float(dy)] == pytest.approx(list(found.y[:, -1]), abs=1e-6 * float(np.abs(found.y).max()))


@parametrize(
    "equation", ["y'' + (10 + x/9)*y = sin(3*x)", "y'' + (100 + cos(x))*y = 0", "y'' + 100*y = sqrt(x + 1)"], ordinary=1
)
def test_nothing_is_expanded_twice(equation: str) -> None:
    """Whatever precision a value needs: near zeros of the solution it is higher."""
    solution = kovacic.prepared(equation, x0=0, **START)
    places = [Fraction(k, 64) for k in range(1, 400)]
    found = [tuple(solution(places)), [solution(place) for place in places]]
    with bounded_work(0):
        assert [tuple(solution(places)), [solution(place) for place in places]] == found


def test_pictures_of_equations_with_a_right_hand_side_are_drawn_on_ways() -> None:
    with bounded_work(1000):
        curve = sample("y'' + (10 + x/9)*y = sin(3*x)", "7/5", "42/5", x0="49/10", y0="5/4", dy0="9/4")
    assert len(curve.arcs) == 1


@parametrize("seed", range(40), ordinary=(13, 20, 26), long=1)
def test_constant_coefficients(seed: int) -> None:
    """The right-hand side is that of a solution that was chosen; one in three is resonant, and some are stiff."""
    rng = random.Random(seed)
    x = sympy.Symbol("x")
    roots = [
        rng.choice([-1000, -3, sympy.Rational(-1, 2), 0, 2, sympy.sqrt(2), sympy.I, -1 + 2 * sympy.I]) for _ in "12"
    ]
    rates = [rng.choice([*roots, sympy.Rational(1, 3), -2, 3 * sympy.I]) for _ in "123"]
    chosen = [rng.randint(-3, 3) * x ** rng.randint(0, 2) * sympy.exp(rate * (x - 2)) for rate in rates]
    solution = sympy.Add(*chosen) + sympy.exp(roots[0] * (x - 2))
    b, c = -sympy.expand(roots[0] + roots[1]), sympy.expand(roots[0] * roots[1])
    f = sympy.expand(solution.diff(x, 2) + b * solution.diff(x) + c * solution)
    start = {name: sympy.expand(e.subs(x, 2)) for name, e in (("y0", solution), ("dy0", solution.diff(x)))}
    place = rng.choice([3, sympy.Rational(5, 2), 9, 2 + sympy.I])
    y = sympy.Function("y")(x)
    equation = sympy.Eq(y.diff(x, 2) + b * y.diff(x) + c * y, f)
    balls = kovacic.evaluate(equation, place, x0=2, derivative=True, **start)
    with mpmath.workdps(60):
        for ball, e in zip(balls, (solution, solution.diff(x)), strict=True):
            exact = mpmath.mpc(sympy.N(e.subs(x, place), 50))
            assert abs(ball.to_mpmath() - exact) <= ball.radius + mpmath.mpf(10) ** -45 * abs(exact)
    assert balls[0].digits >= 15 or balls[0].contains_zero()


def test_a_stiff_equation_takes_one_step() -> None:
    with bounded_work(1000):
        value = kovacic.evaluate("y'' + 1000*y' + 1000*y = sin(x)", 200, x0=0, y0=1, dy0=0)
    assert value.digits >= 15
    far = kovacic.evaluate("y'' + y = sin(x)", 10**300, x0=0, y0=0, dy0=0)  # (sin(x) - x cos(x))/2
    with mpmath.workdps(400):
        x = mpmath.mpf(10) ** 300
        assert far.contains((mpmath.sin(x) - x * mpmath.cos(x)) / 2)
    with pytest.raises(kovacic.LimitExceeded, match="values lose"):
        kovacic.evaluate("y'' + y = sin(x)", 10**5000, x0=0, y0=0, dy0=0)

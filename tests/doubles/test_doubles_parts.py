"""Parts of the room `kovacic.doubles`, alone: double-doubles, the measurement of errors and its reference, long arrays."""

from __future__ import annotations

import dataclasses
import math
from fractions import Fraction
from itertools import count
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import mpmath
import numpy as np
import pytest
from build import as_problem, ball_to_flint, bounded_work, evaluate_states, parametrize
from flint import acb, arb
from published import load

import kovacic
from kovacic import AccuracyWarning, InputError, LimitExceeded, tabulate
from kovacic.doubles import double_double as dd
from kovacic.doubles.chart import BLOCK, PieceChart
from kovacic.doubles.curve import _beside_singular_points
from kovacic.doubles.lambdify import lambdify, measure, measured_points
from kovacic.doubles.product_form import ProductForm
from kovacic.enclosure.ball import ball_from_flint
from kovacic.enclosure.closed_form import omega
from kovacic.enclosure.points import as_point
from kovacic.limits import CLOCK

CONJUGATE_POLES = "9/(2*x^4 + 16*x^3 + 72*x^2 + 160*x + 200)"  # omega over Q(sqrt(-6))


def exact(pair: dd.Pair) -> list[Fraction]:
    return [Fraction(float(h)) + Fraction(float(r)) for h, r in zip(pair.hi, pair.lo, strict=True)]


def numbers(seed: int, spread: int = 9) -> dd.Pair:
    rng = np.random.default_rng(seed)
    hi = rng.normal(size=200) * 10.0 ** rng.integers(-spread, spread, 200)
    return dd.two_sum(hi, hi * 2.0**-54 * rng.uniform(-1, 1, 200))


def test_sums_and_products_of_doubles_are_exact() -> None:
    a, b = numbers(1).hi, numbers(2).hi
    assert exact(dd.two_sum(a, b)) == [Fraction(p) + Fraction(q) for p, q in zip(a, b, strict=True)]
    assert exact(dd.two_product(a, b)) == [Fraction(p) * Fraction(q) for p, q in zip(a, b, strict=True)]


def test_arithmetic_of_pairs_is_good_to_a_hundred_bits() -> None:
    a, b = numbers(3), numbers(4)
    for got, wanted in (
        (a * b, [p * q for p, q in zip(exact(a), exact(b), strict=True)]),
        (a / b, [p / q for p, q in zip(exact(a), exact(b), strict=True)]),
        (a + b, [p + q for p, q in zip(exact(a), exact(b), strict=True)]),
        (a - b, [p - q for p, q in zip(exact(a), exact(b), strict=True)]),
    ):
        assert all(abs(g / w - 1) < Fraction(2) ** -100 for g, w in zip(exact(got), wanted, strict=True))
    assert exact(dd.absolute(a)) == [abs(v) for v in exact(a)]


def test_an_array_less_a_constant_loses_neither_half() -> None:
    """Beside zeros of factors, in plain arithmetic."""
    zeta = numbers(8)
    for hi, lo in zip(zeta.hi, zeta.lo, strict=True):
        x, exactly = hi * (1 + 2.0**-40 * np.arange(-3, 4)), Fraction(float(hi)) + Fraction(float(lo))
        found = [(v, Fraction(float(p)) - exactly) for v, p in zip(x - dd.Pair(hi, lo), x, strict=True)]
        found += [(v, exactly - Fraction(float(p))) for v, p in zip(dd.Pair(hi, lo) - x, x, strict=True)]
        assert all(abs(Fraction(float(v)) - wanted) <= Fraction(2) ** -52 * abs(wanted) for v, wanted in found)


def test_complex_numbers_are_those_of_python_whatever_is_zero() -> None:
    parts = [2.0, -3.0, 0.5, 7.0]
    for a, b, c, d in [parts, [2.0, 0.0, 0.5, 7.0], [2.0, -3.0, 0.5, 0.0], [2.0, 0.0, 0.5, 0.0]]:
        z, w = complex(a, b), complex(c, d)
        for kind in (np.array, dd.Pair):
            p, q = (dd.Complex(kind(v.real), kind(v.imag) if v.imag else None) for v in (z, w))
            for found, wanted in ((p + q, z + w), (p - q, z - w), (p * q, z * w), (p.reciprocal(), 1 / z)):
                at = complex(dd.double(found.re), 0.0 if found.im is None else dd.double(found.im))
                assert at == pytest.approx(wanted, rel=1e-15)


def test_logarithms_and_angles_are_good_to_a_hundred_bits() -> None:
    a, b = numbers(5, 100), numbers(6)
    near_one = dd.two_sum(1 + np.linspace(-1e-3, 1e-3, 50), 1e-18)
    with mpmath.workdps(60):

        def mp(pair: dd.Pair) -> list[mpmath.mpf]:
            halves = zip(*np.broadcast_arrays(pair.hi, pair.lo), strict=True)
            return [mpmath.mpf(float(h)) + mpmath.mpf(float(r)) for h, r in halves]

        for argument in (dd.absolute(a), near_one):
            pairs = zip(mp(dd.log(argument)), mp(argument), strict=True)
            assert all(abs(got - mpmath.log(v)) <= mpmath.mpf(2) ** -100 * abs(mpmath.log(v)) for got, v in pairs)
        c = numbers(7)
        pairs = zip(mp(dd.angle(dd.Complex(c, b))), mp(b), mp(c), strict=True)
        assert all(abs(got - mpmath.atan2(y, x)) < mpmath.mpf(2) ** -100 for got, y, x in pairs)
    assert dd.log(dd.Pair(np.array([0.0]), np.array([0.0]))).hi == -np.inf


@pytest.mark.parametrize("S", ["x^2 + 3", "1 + 2/x^2", "-2", CONJUGATE_POLES, "y'' - x*y' + 3*y = 0"])
def test_the_reference_of_case_1_is_that_of_the_taylor_route(S: str) -> None:
    """The closed form in balls, and the integration of the equation."""
    problem = as_problem(kovacic.solve(S))
    base, points = as_point("1/3", "x"), [as_point(v, "x") for v in ("1/7", "2/3", "5/8")]
    found = PieceChart({}, problem).beginning(0, base).states(points, 50, None)
    slope = ball_from_flint(omega(problem, 0, base, 4000))
    exact = evaluate_states(problem, points, x0=base, y0=1, dy0=slope, digits=50)
    for (y, dy), state in zip(found, exact, strict=True):
        assert y.overlaps(ball_to_flint(state.y))
        assert dy.overlaps(ball_to_flint(state.dy))
        assert y.rel_accuracy_bits() > 166


def logs(*terms: tuple[str, str]) -> str:
    """S of prod (x - z)^r."""
    omega = " + ".join(f"({r})/(x-({z}))" for r, z in terms)
    return f"({omega})^2 + " + " + ".join(f"-({r})/(x-({z}))^2" for r, z in terms)


STRESS = [
    (logs(("1/3", "0"), ("-1/3", "1/10^30")), (Fraction(1, 10**30), 9), 1e-30 * np.arange(1.5, 30)),  # nearly confluent
    (logs(("1/3", "0"), ("1/2", "-2")), (0, 3), 1e-80 * np.arange(1.1, 30)),  # near a singular point
    (logs(("10^6", "0"), ("-10^6", "-1")), (0, 10**7), 1e5 * np.arange(3.3, 90, 3)),  # large exponents
    ("x^2 - 1", (0, 30), np.arange(15, 30, 0.7)),  # recessive
    ("-10^30", (0, 1e-12), 1e-15 * np.arange(3.3, 150, 7)),  # large coefficients
    ("2/x^2", (1, 10**31), 1e30 * np.arange(1.1, 9, 0.4)),  # huge x
    ("-(400^2/4 - 1/4)/(1-x^2) - 3/(4*(1-x^2)^2)", (-1, 1), np.arange(-0.9, 0.9, 0.23)),  # large degree: T_200 or U_199
]


@pytest.mark.parametrize(("S", "interval", "points"), STRESS)
def test_the_measured_error_under_stress(S: str, interval: Any, points: Any) -> None:
    solution = kovacic.solve(S)
    function = lambdify(solution, interval=interval, careful=True, check=False)
    median, worst, count = measure(function, solution, points)
    assert count == len(points)
    assert median <= 1
    assert worst <= 4


@pytest.mark.slow
def test_the_promise_for_the_published_equations() -> None:
    for entry in load():
        if entry.case is None:
            continue
        solution = kovacic.solve(entry.S)
        try:
            poles = [float(p.real.mid()) for p, _ in as_problem(solution).system.roots("den", 64)]
        except InputError:
            continue  # algebraic constants
        start = max(poles, default=0.0)
        for which in (0,) if entry.case == 1 else (0, 1):
            lambdify(solution, interval=(start + 0.1, start + 4), which=which)


@parametrize("size", [BLOCK + 1, BLOCK, 3 * BLOCK + 5], ordinary=1, long=1)
def test_long_arrays_have_the_values_of_their_points(size: int) -> None:
    functions = [
        lambdify(kovacic.solve("x^2 - 11"), interval=(-3, 3), check=False),
        lambdify(kovacic.solve("-1"), interval=(0, 3), check=False),  # complex
        tabulate("x", -3, 3, x0=0, y0=1, dy0=0),
        lambdify("x", interval=(-3, 3), x0=0, y0=1, dy0=0, check=False),
    ]
    points = np.linspace(0, 3, size)
    for f in functions:
        whole = f(points)
        assert whole.shape == points.shape
        for k in (0, 1, BLOCK - 2, size - 1):
            assert whole[k] == f(points[k])
        assert np.array_equal(f(points[::-1].reshape(1, -1, 1)), whole[::-1].reshape(1, -1, 1))
        mixed = np.random.default_rng(1).permutation(size)
        assert np.array_equal(f(points[mixed]), whole[mixed])


def test_a_measurement_ends_where_its_steps_are_used_up() -> None:
    function = lambdify("x", interval=(-9, 2), x0=0, y0=1, dy0=0, check=False)
    with bounded_work(100), pytest.raises(LimitExceeded, match="more than 100 units of work"):
        measure(function, "y'' = x*y", start={"x0": 0, "y0": 1, "dy0": 0})  # no way is kept for this text


def test_an_inaccurate_function_warns_with_its_measured_error(monkeypatch: pytest.MonkeyPatch) -> None:
    solution = kovacic.solve("x^2 + 3")
    good = lambdify(solution, interval=(-3, 5))
    assert isinstance(good, ProductForm)
    (a, b, *rest) = good.exponent.polynomial
    wrong = dd.Complex(dd.Pair(a.re.hi * (1 + 1e-11)), a.im)
    bad = dataclasses.replace(good, exponent=dataclasses.replace(good.exponent, polynomial=(wrong, b, *rest)))
    monkeypatch.setattr("kovacic.doubles.lambdify.product_form", lambda *arguments: bad)
    with pytest.warns(AccuracyWarning, match=r"median \d.*worst \d"):
        assert lambdify(solution, interval=(-3, 5)).careful  # that was tried


def test_a_wrong_zero_counts_as_an_error() -> None:
    solution = kovacic.solve("x^2 + 3")
    good = lambdify(solution, interval=(-3, 5))
    points = np.array([1.0, 2.0, 3.0])

    class Broken:
        region, base = good.region, good.base

        def __call__(self, x: Any) -> Any:
            return np.where(x == 2.0, 0.0, good(x))

    assert measure(Broken(), solution, points).worst > 1e15  # type: ignore[arg-type]


def test_the_ends_and_both_sides_of_zeros_are_measured() -> None:
    airy = lambdify("x", interval=(-9, 3), x0=0, y0=1, dy0=0)
    points = np.sort(measured_points(airy))
    assert len(points) == 24
    assert (points[0], points[-1]) == (-9.0, 3.0)
    signs, steps = np.sign(airy(points)), np.diff(points)
    assert np.sum((signs[1:] != signs[:-1]) & (steps < 0.04)) == 3  # the zeros are 1 to 3 apart
    singular = lambdify(kovacic.solve("2/(x+1)^2"), interval=(-1, 1), check=False)
    assert min(measured_points(singular)) == pytest.approx(-0.998)


def test_a_function_that_is_wrong_beside_its_zeros_only_is_seen() -> None:
    good = lambdify("x", interval=(-9, 3), x0=0, y0=1, dy0=0)

    class Shifted:
        region, base = good.region, good.base

        def __call__(self, x: Any) -> Any:
            return good(x) + np.where(np.abs(x + 1.986) < 0.05, 1e-14, 0)

    assert measure(good, "x", start={"x0": 0, "y0": 1, "dy0": 0}).keeps_the_promise
    assert not measure(Shifted(), "x", start={"x0": 0, "y0": 1, "dy0": 0}).keeps_the_promise  # type: ignore[arg-type]
    even = np.linspace(-8.7, 2.7, 24)  # evenly spread points wouldn't see it
    assert measure(Shifted(), "x", even, start={"x0": 0, "y0": 1, "dy0": 0}).keeps_the_promise  # type: ignore[arg-type]


def test_the_error_is_measured_on_a_slow_machine_too() -> None:
    seconds = count()
    with patch.object(CLOCK, "now", lambda: float(next(seconds))):
        function = lambdify("-1 - 1/x", interval=(1, 90), x0=1, y0=1, dy0=0)
    assert function.measured == lambdify("-1 - 1/x", interval=(1, 90), x0=1, y0=1, dy0=0).measured


def test_the_measured_error_is_that_of_the_solution_asked_for() -> None:
    airy = lambdify("x", interval=(-9, 3), x0=0, y0="0.3", dy0=1)
    assert measure(airy, "x", start={"x0": 0, "y0": "0.3", "dy0": 1}) == airy.measured
    assert measure(airy, "x", start={"x0": 0, "y0": "0.6", "dy0": 2}).worst > 1e12  # the factor isn't free


def test_values_close_to_a_zero_keep_their_relative_accuracy_at_every_point() -> None:
    solution = kovacic.solve("x^2 - 21")  # H_10(x) exp(-x^2/2)
    zero = float(max(np.polynomial.hermite.hermroots([0] * 10 + [1])))
    points = np.array([0.1, *(zero + k * 2.0**-40 for k in range(-3, 4))])
    assert measure(lambdify(solution, interval=(-5, 5), careful=True), solution, points).worst <= 4
    assert measure(lambdify(solution, interval=(-5, 5)), solution, points).worst <= 40


def test_points_of_a_curve_accumulate_at_singular_points() -> None:
    """At 2 + i/8, beside the axis: 2 and the distances 1/8, 3/16, ... on both sides; at -1, before the begin, 1/2 and more."""
    beside = SimpleNamespace(singular=[arb(2) + acb(0, 1) / 8])
    found = _beside_singular_points(beside, 1.75, 4.0)  # type: ignore[arg-type]
    distances = [0.125 * 1.5**k for k in range(8)]
    assert found == [x for d in distances if d < 2.25 for x in (2 - d, 2.0, 2 + d) if 1.75 < x < 4]
    before = SimpleNamespace(singular=[acb(-1)])
    assert _beside_singular_points(before, -0.5, 1.0) == [-0.25, 0.125]  # type: ignore[arg-type]


def test_a_table_where_units_in_the_last_place_change() -> None:
    """Centres are doubles on both sides of -2^33: sin(x + 2^33)."""
    sine = kovacic.tabulate("-1", -(2**33) - 2, 1 - 2**33, x0=-(2**33), y0=0, dy0=1)
    for shift in (-1.75, -1.0, -0.25, 0.75):
        assert sine(shift - 2.0**33) == pytest.approx(math.sin(shift), rel=1e-15)


def test_a_table_with_the_right_hand_side_1() -> None:
    start = {"x0": 0, "y0": "3/2", "dy0": "-1/3"}
    equation = "y'' + cos(x)*y = 1"
    table = kovacic.tabulate(equation, 0, 2, **start)
    for x in (0.5, 1.75):
        assert table(x) == pytest.approx(float(kovacic.evaluate(equation, x, **start)), rel=1e-15)

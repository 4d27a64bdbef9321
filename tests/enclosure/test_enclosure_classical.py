"""FLINT's special functions against the Taylor route, and what they must not be used for."""

from __future__ import annotations

import random
import warnings
from fractions import Fraction
from typing import Any

import pytest
from build import QQ, Budget, ExactPoint, RatFunc, System, as_problem, ball_to_flint, evaluate_states, parametrize
from flint import acb, ctx

from kovacic import AccuracyWarning, InputError, LimitExceeded, Limits, connection_matrix, evaluate
from kovacic.enclosure.classical import Classical, NotServed, classical_of
from kovacic.special.airy import Airy
from kovacic.special.bessel import Bessel
from kovacic.special.gauss import Gauss
from kovacic.special.pullback import Pullback
from kovacic.special.whittaker import Whittaker

START: dict[str, Any] = {"y0": 1, "dy0": 0}
BESSEL = "x^2*y'' + x*y' + (x^2 - ({})^2)*y = 0"
DIHEDRAL = "x*(1-x)*y'' + (1/3 - 5/6*x)*y' + 1/18*y = 0"
BALL = "(112 - 20*x - 5*x^2)/(36*(x^2 + 4*x + 10)^2)"  # R/R1 = 1/3: the differences 1/2, 1/2, 1/3
LEGENDRE = "(1-x^2)*y'' - 2*x*y' + 3/7*y = 0"


def a_pullback(kind: str, rng: random.Random) -> Pullback:
    """A standard equation with random constants, and a function of degree 1 or 2."""

    def few(k: int = 6) -> Fraction:
        return Fraction(rng.choice([-1, 1]) * rng.randint(1, k), rng.randint(1, 3))

    def constant(value: Fraction) -> Any:
        return QQ.poly([value])

    x = RatFunc(QQ.poly([0, 1]))
    f = rng.choice(
        [x * few(), x * few() + few(), x**2 * few(), x**2 * few() + few(), few() / x, 1 + few() / (x - few())]
    )
    mu = rng.choice([Fraction(0), Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(7, 4), Fraction(3)])
    M = mu * mu - Fraction(1, 4) if rng.random() < 0.8 else few()
    if kind == "Airy":
        return Pullback(Airy(constant(few())), f)
    if kind == "Bessel":
        if rng.random() < 0.5:
            return Pullback(Whittaker(constant(few()), constant(Fraction(0)), constant(M)), f)
        return Pullback(Bessel(constant(Fraction(0)), constant(few()), constant(M)), f)
    if kind == "Whittaker":
        return Pullback(Whittaker(constant(few()), constant(few()), constant(M)), f)
    squares = [rng.choice([few(), mu * mu, Fraction(1, 9), Fraction(0), Fraction(4)]) for _ in range(3)]
    if kind == "dihedral":
        squares[1:] = [Fraction(1, 4)] * 2
        rng.shuffle(squares)
    return Pullback(Gauss(*map(constant, squares)), f)


def compare(pullback: Pullback, a: ExactPoint, b: ExactPoint, bits: int) -> bool:
    """Do both routes agree on the leg?  False where it isn't served; Taylor steps refuse it, too, or go another way."""
    with ctx.workprec(bits):
        try:
            matrix = Classical(pullback).leg(a, b)
        except NotServed:
            return False
    rows = connection_matrix(pullback.S, [a, b], digits=bits * 3 // 10)
    with ctx.workprec(bits + 20):
        taylor = [ball_to_flint(entry) for row in rows for entry in row]
        assert all(m.overlaps(n) for m, n in zip(matrix, taylor, strict=True)), (pullback, a, b, bits)
        assert (matrix[0] * matrix[3] - matrix[1] * matrix[2]).contains(1)
    return True


def places(rng: random.Random, real: bool) -> tuple[ExactPoint, ExactPoint]:
    a, b = (
        ExactPoint(Fraction(rng.randint(-40, 40), 8), 0 if real else Fraction(rng.randint(-24, 24), 8)) for _ in "ab"
    )
    return a, b


def agree_on(kind: str, seed: int, count: int) -> int:
    rng, served = random.Random(f"{kind} {seed}"), 0
    for _ in range(count):
        pullback, (a, b) = a_pullback(kind, rng), places(rng, rng.random() < 0.5)
        if not System.of(pullback.S).is_singular(a) and not System.of(pullback.S).is_singular(b):
            served += compare(pullback, a, b, rng.choice([60, 100, 250]))
    return served


@parametrize("kind", ["Airy", "Bessel", "Whittaker", "Gauss", "dihedral"], ordinary=0, long=3)
def test_both_routes_agree_on_random_legs(kind: str) -> None:
    assert agree_on(kind, 1, 60) > 15


@pytest.mark.parametrize("kind", ["Airy", "Bessel", "Whittaker", "Gauss"])
def test_both_routes_agree_on_a_few_legs(kind: str) -> None:
    assert agree_on(kind, 2, 12) > 1


@parametrize("ends", [("0", "1/2"), ("1/2", "0"), ("0", "-1/3"), ("-1/3", "1/2"), ("1/4", "1/2")], ordinary=5)
@pytest.mark.parametrize(("slope", "order"), [(0, 2), (1, 2), (Fraction(-1, 2), 2), (1, 3), (Fraction(1, 2), 5)])
def test_a_leg_from_to_and_through_an_ordinary_zero_of_the_function(
    slope: Fraction, order: int, ends: tuple[str, str]
) -> None:
    # f = x^k (1 + slope x) and exponents 1/2 +- 1/(2 k) at 0: the first solution has a slope at 0 unless that is 0
    constants = [QQ.poly([v]) for v in (1, 0, Fraction(1, 4 * order**2) - Fraction(1, 4))]
    x = RatFunc(QQ.poly([0, 1]))
    a, b = (ExactPoint(Fraction(end)) for end in ends)
    assert compare(Pullback(Whittaker(*constants), x**order * (1 + x * slope)), a, b, 120)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("kind", ["Airy", "Bessel", "Whittaker", "Gauss", "dihedral"])
def test_both_routes_agree_on_thousands_of_random_legs(kind: str, seed: int) -> None:
    assert agree_on(kind, 100 + seed, 250) > 60


@parametrize(
    ("equation", "x0", "x"),
    [
        ("x", 0, 2),
        ("x", 0, "-1 + 3*I"),
        (BESSEL.format("1/3"), 1, 20),
        (BESSEL.format("1/3"), -1, -3),
        (BESSEL.format(0), 2, "1 + I"),
        ("x^2 - 7/3", -1, 2),  # through a zero of f that is an ordinary point
        ("x^2 - 7/3", 0, 3),
        ("x^2 - 7/3", 3, 0),
        ("1/x^3", 1, 5),
        ("1/4 - 3/x + 3/(4*x^2)", 1, 9),
        (LEGENDRE, 0, "1/2"),
        (LEGENDRE, 2, 5),
        (LEGENDRE, -3, "-5 + I"),
        ("x*(1-x)*y'' + (5/4 - 11/6*x)*y' - 1/6*y = 0", "1/3", "9/10"),
        (BALL, "-9/10", "9/10"),
        (BALL, 1, "3 + I"),
        ("x^2 - 201", 0, 8),  # two solutions that are nearly the same at 8
        ("-1 + 160400/x^2", 402, 800),
    ],
    ordinary=6,
    long=13,
)
@parametrize("digits", [5, 15, 60, 300], ordinary=2)
def test_flints_functions_and_taylor_steps_agree(equation: str, x0: Any, x: Any, digits: int) -> None:
    (chosen,), (other,) = (
        evaluate_states(equation, [x], x0=x0, digits=digits, method=method, **START)
        for method in ("closed form", "taylor")
    )
    assert (chosen.route.method, other.route.method) == ("closed form", "taylor")
    assert chosen.missing == 0
    assert chosen.y.overlaps(other.y)
    assert chosen.dy.overlaps(other.dy)
    assert chosen.y.real == other.y.real


@parametrize(
    ("equation", "x0", "x", "start"),
    [
        (BESSEL.format("1/3"), 0, 3, (2, 3)),
        (BESSEL.format("1/3"), 0, -3, (2, 3)),
        (BESSEL.format("1/3"), 0, "1 + 2*I", (1, 1)),
        (BESSEL.format("1/3"), 0, ["1/2", 3, 40], (0, 1)),
        (BESSEL.format(2), 0, 3, (0, 1)),
        ("x^2*y'' + x*y' + (x^2 - 2)*y = 0", 0, 5, (1, 1)),
        ("x*(1-x)*y'' + (5/4 - 11/6*x)*y' - 1/6*y = 0", 0, "1/3", (1, 2)),
        ("x*(1-x)*y'' + (5/4 - 11/6*x)*y' - 1/6*y = 0", 1, "1/3", (1, 2)),
        (LEGENDRE, 1, "1/3", (0, 1)),
        ("(x+2)^2*y'' + (x+2)*y' + ((x+2)^4 - 1/9)*y = 0", -2, 1, (1, 1)),
        ("x*y'' + (4/3 - x)*y' - 2/7*y = 0", 0, 3, (1, -1)),
        (DIHEDRAL, 0, "1/3", (1, 2)),
        (DIHEDRAL, 1, "1/3", (1, 2)),
        (DIHEDRAL, 0, "-5 + I", (1, 2)),
    ],
    ordinary=14,
)
def test_frobenius_solutions_by_flints_functions(equation: str, x0: Any, x: Any, start: Any) -> None:
    points = x if isinstance(x, list) else [x]
    found, others = (
        evaluate_states(equation, points, x0=x0, frobenius=start, digits=30, method=method)
        for method in ("closed form", "taylor")
    )
    for one, other in zip(found, others, strict=True):
        assert one.route.method == "closed form"
        assert one.missing == 0
        assert one.y.overlaps(other.y)
        assert one.dy.overlaps(other.dy)


def test_logarithms_are_left_to_the_series() -> None:
    (found,) = evaluate_states(BESSEL.format(2), [3], x0=0, frobenius=(1, 0))
    assert found.route.method == "taylor"
    with pytest.raises(InputError, match="doesn't prove its values on this path"):
        evaluate(BESSEL.format(2), 3, x0=0, frobenius=(1, 0), method="closed form")


@pytest.mark.parametrize(
    "equation", ["(1-x^2)*y'' - 2*x*y' + 12*y = 0", "x*y'' + (1-x)*y' + 3*y = 0", "x*y'' + (3-x)*y' + 20*y = 0"]
)
def test_where_both_functions_are_the_same_polynomial_the_leg_is_not_served(equation: str) -> None:
    rational = as_problem(equation).S
    assert rational is not None
    found = classical_of(rational)
    assert found is not None
    with ctx.workprec(200), pytest.raises(NotServed):
        found.leg(ExactPoint(Fraction(1, 2)), ExactPoint(Fraction(1, 3)))


def test_a_leg_over_a_cut_is_left_to_taylor_steps_or_followed() -> None:
    for order, method in (("1/3", "closed form"), ("0", "taylor")):  # the powers are followed, Y isn't
        (found,) = evaluate_states(BESSEL.format(order), ["-3 - I"], x0="1 + I", **START)
        (other,) = evaluate_states(BESSEL.format(order), ["-3 - I"], x0="1 + I", method="taylor", **START)
        assert found.y.overlaps(other.y)
        assert found.route.method == method


def test_a_path_around_a_singular_point_is_followed() -> None:
    for order in ("1/3", "0"):
        options: dict[str, Any] = {"x0": "1 + I", "path": ["-1 + I", "-1 - I", "1 - I"], **START}
        (found,) = evaluate_states(BESSEL.format(order), ["1 + I"], **options)
        (other,) = evaluate_states(BESSEL.format(order), ["1 + I"], method="taylor", **options)
        assert found.route.method == "closed form"
        assert found.y.overlaps(other.y)
        assert found.y.contains(1) is False


def test_singular_points_are_refused_as_before() -> None:
    with pytest.raises(InputError, match="through the singular point 0 "):
        evaluate(BESSEL.format("1/3"), -1, x0=1, **START)
    with pytest.raises(InputError, match="through the singular point 1 "):
        evaluate(LEGENDRE, 2, x0=0, **START)


def test_far_away_and_many_digits_cost_no_steps() -> None:
    states = evaluate_states("x", [10**6, -(10**6)], x0=0, **START)
    assert all(state.missing == 0 and state.route.method == "closed form" for state in states)
    with ctx.workprec(400):
        airy, zero = acb(-(10**6)).airy(), acb(0).airy()
        expected = acb.pi() * (zero[3] * airy[0] - zero[1] * airy[2])
        assert ball_to_flint(states[1].y).overlaps(expected)


def test_known_functions_and_shared_expansions_agree_at_many_points() -> None:
    circle = [complex(k - 15, 8) / 16 for k in range(30)]
    with warnings.catch_warnings():
        warnings.simplefilter("error", AccuracyWarning)
        for points in (circle, [Fraction(k, 50) for k in range(30)]):
            found, others = (
                evaluate_states("x", points, x0=0, method=method, **START) for method in ("closed form", "taylor")
            )
            assert {state.route.method for state in found} == {"closed form"}
            assert all(one.y.overlaps(other.y) for one, other in zip(found, others, strict=True))


@pytest.mark.parametrize("S", ["x^3 + x + 1", "10^8/x^2 - 1", "x^30 + 1", "1/(x^2-2)^2"])
def test_other_equations_and_large_parameters_are_left_to_taylor_steps(S: str) -> None:
    rational = as_problem(S).S
    assert rational is not None
    assert classical_of(rational) is None


def test_a_search_that_ran_out_of_time_isnt_remembered() -> None:
    rational = as_problem("x + 17/19").S
    assert rational is not None
    with Budget(Limits(seconds=1e-9)).watched(), pytest.raises(LimitExceeded):
        classical_of(rational)
    assert classical_of(rational) is not None


@parametrize(
    "S",
    ["-1 - 2/(7*x^2)", "-x^4 - 3/(16*x^2)", "-30/(16*x^2) - x^4", "-400*x^2", "-9 + 5/x - 1/(4*x^2)"],
    ordinary=1,
    long=2,
)
def test_many_points_where_a_series_loses_its_digits_cost_little(S: str) -> None:
    """Between the power series and the asymptotic expansion FLINT's values may be worse at a higher precision."""
    points = [1 + Fraction(40 * k + 1, 300) for k in range(1, 300)]
    found = evaluate_states(S, points, x0=1, y0=0, dy0=100, digits=8)
    assert max(state.route.bits for state in found) < 1000
    assert all(state.missing == 0 for state in found)
    chosen = found[::60]
    others = evaluate_states(S, points[::60], x0=1, y0=0, dy0=100, digits=8, method="taylor")
    assert all(one.y.overlaps(other.y) for one, other in zip(chosen, others, strict=True))

"""No true value outside of its ball: random problems against FLINT's special functions, whose balls are proven, too."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import pytest
from build import ball_to_flint, bounded_work, evaluate_states, parametrize
from flint import acb, arb, ctx, fmpq

from kovacic import InputError, connection_matrix, evaluate

Function = Callable[[acb], acb]


def exactly(value: Fraction) -> acb:
    return acb(arb(fmpq(value.numerator, value.denominator)))


@dataclass(frozen=True)
class Family:
    """An equation, and a solution of it with its derivative (by FLINT, in the right half-plane)."""

    equation: str
    y: Function
    dy: Function
    frobenius: tuple[Function, Function] | None = None
    inside: Callable[[complex], bool] = lambda z: z.real > 0


def airy(rng: random.Random) -> Family:
    first, second = rng.randint(-9, 9), rng.randint(-9, 9) or 1

    def y(z: acb, k: int = 0) -> acb:
        return first * z.airy_ai(derivative=k) + second * z.airy_bi(derivative=k)

    return Family("x", y, lambda z: y(z, 1), inside=lambda z: True)


def bessel(rng: random.Random) -> Family:
    nu, sign = Fraction(rng.randint(0, 40), rng.randint(1, 7)), rng.choice([1, -1])
    v = nu

    def y(z: acb, shift: int = 0) -> acb:
        order = exactly(v + shift)
        return z.bessel_j(order) if sign == 1 else z.bessel_i(order)

    def dy(z: acb) -> acb:  # y' = nu/z y -+ y_(nu+1)
        return exactly(v) / z * y(z) - sign * y(z, 1)

    start = lambda _: acb(0), lambda _: 1 / (acb(2) ** exactly(v) * (exactly(v) + 1).gamma())
    return Family(f"x^2*y'' + x*y' + ({sign}*x^2 - ({nu})^2)*y = 0", y, dy, start)


def second_kind(rng: random.Random) -> Family:
    nu, sign = Fraction(rng.randint(0, 12), rng.randint(1, 3)), rng.choice([1, -1])

    def y(z: acb, shift: int = 0) -> acb:
        order = exactly(nu + shift)
        return z.bessel_y(order) if sign == 1 else z.bessel_k(order)

    return Family(f"x^2*y'' + x*y' + ({sign}*x^2 - ({nu})^2)*y = 0", y, lambda z: exactly(nu) / z * y(z) - y(z, 1))


def whittaker(rng: random.Random) -> Family:
    k, m = Fraction(rng.randint(-9, 9), rng.randint(1, 5)), Fraction(rng.randint(0, 9), rng.randint(1, 5))
    a, b = m - k + Fraction(1, 2), 2 * m + 1

    def power(z: acb) -> acb:
        return (-z / 2).exp() * z ** exactly(m + Fraction(1, 2))

    def y(z: acb) -> acb:
        return power(z) * z.hypgeom_1f1(exactly(a), exactly(b))

    def dy(z: acb) -> acb:
        inner = exactly(a / b) * z.hypgeom_1f1(exactly(a + 1), exactly(b + 1))
        return (exactly(m + Fraction(1, 2)) / z - acb(1) / 2) * y(z) + power(z) * inner

    return Family(f"1/4 - ({k})/x + (({m})^2 - 1/4)/x^2", y, dy, (lambda _: acb(0), lambda _: acb(1)))


def gauss(rng: random.Random) -> Family:
    a, b = (Fraction(rng.randint(-12, 12), rng.randint(1, 5)) for _ in "ab")
    c = Fraction(rng.randint(1, 12), rng.randint(1, 5))

    def y(z: acb, shift: int = 0) -> acb:
        return z.hypgeom_2f1(exactly(a + shift), exactly(b + shift), exactly(c + shift))

    start = (lambda _: acb(c < 1), lambda _: acb(c >= 1)) if c != 1 else (lambda _: acb(0), lambda _: acb(1))
    return Family(
        f"x*(1-x)*y'' + ({c} - ({a}+{b}+1)*x)*y' - ({a})*({b})*y = 0",
        y,
        lambda z: exactly(a * b / c) * y(z, 1),
        start,
        lambda z: z.imag > 0 or 0 < z.real < 1,
    )


FAMILIES = [airy, bessel, second_kind, whittaker, gauss]


def check(seed: int) -> None:
    rng = random.Random(seed)
    family, digits = rng.choice(FAMILIES)(rng), rng.choice([5, 10, 15, 20, 30, 60])

    def place(real: bool) -> tuple[Fraction, Fraction]:
        while True:
            scale = rng.choice([1, 1, 4, 20])
            re, im = Fraction(rng.randint(-64 * scale, 64 * scale), 64), Fraction(rng.randint(-64, 64) * scale, 64)
            point = re, Fraction(0) if real else im
            if any(point) and point != (1, 0) and family.inside(complex(*point)):
                return point

    real = rng.random() < 0.5
    origin, target = place(real), place(real)
    if not real and (origin[1] < 0) != (target[1] < 0):
        origin = origin[0], -origin[1]  # both on one side of the cuts
        if not family.inside(complex(*origin)):
            return
    with ctx.workprec(1200):
        z, x0 = (exactly(p[0]) + acb(0, 1) * exactly(p[1]) for p in (target, origin))
        x = f"{target[0]} + ({target[1]})*I"
        if family.frobenius is not None and rng.random() < 0.5:
            start = {"x0": 0, "frobenius": [part(z) for part in family.frobenius]}
        else:
            start = {"x0": f"{origin[0]} + ({origin[1]})*I", "y0": family.y(x0), "dy0": family.dy(x0)}
        expected, slope = family.y(z), family.dy(z)
        if "y0" in start and not (start["y0"].is_finite() and start["dy0"].is_finite()):  # type: ignore[attr-defined]
            return
        methods: tuple[Any, ...] = "taylor", None  # without FLINT's functions, and as the rule has it
        for method in methods:
            (state,) = evaluate_states(family.equation, [x], digits=digits, method=method, **start)  # type: ignore[arg-type]
            if not expected.is_finite():  # FLINT can't either
                return
            assert ball_to_flint(state.y).overlaps(expected), (seed, family.equation, start, x, method)
            assert ball_to_flint(state.dy).overlaps(slope), (seed, family.equation, start, x, method)
            assert state.missing == 0 or expected.rel_accuracy_bits() < 4 * digits, (seed, state.note)


@parametrize("block", range(6), ordinary=0, long=1)
def test_no_true_value_is_outside_of_its_ball(block: int) -> None:
    for seed in range(50 * block, 50 * (block + 1)):
        check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(40))
def test_no_true_value_is_outside_of_its_ball_thousands(block: int) -> None:
    for seed in range(1000 + 100 * block, 1000 + 100 * (block + 1)):
        check(seed)


@parametrize("seed", range(30), ordinary=3)
def test_a_frobenius_basis_goes_on_as_taylor_expansions_do(seed: int) -> None:
    """From c to x2 at once, and through x1: the exponents were put in, with integer differences and double ones among them."""
    rng = random.Random(seed)

    def few(k: int) -> Fraction:
        return Fraction(rng.randint(-k, k), rng.randint(1, 3))

    c, l1 = few(3), few(4)
    l2, t = l1 + rng.choice([0, 0, 1, 2, 3, Fraction(1, 2), few(3)]), f"(x-({c}))"
    equation = (
        f"{t}^2*(1+({few(2)})*{t}+({few(2)})*{t}^2)*y'' + {t}*(1-({l1 + l2})+({few(2)})*{t})*y'"
        f" + (({l1 * l2})+({few(3)})*{t}+({few(3)})*{t}^2)*y = 0"
    )
    first, second = c + Fraction(rng.randint(1, 9), 32), c + Fraction(rng.randint(1, 9), 16)
    ends = [str(first), f"{second} + ({Fraction(rng.randint(-5, 5), 16)})*I"]
    start = (rng.randint(-3, 3), rng.randint(1, 3))
    try:
        there, beyond = evaluate_states(equation, ends, x0=c, frobenius=start, digits=rng.choice([5, 15, 40]))
        (onward,) = evaluate_states(equation, [ends[1]], x0=ends[0], y0=there.y, dy0=there.dy)
    except InputError:  # another singular point is in the way
        return
    assert beyond.y.overlaps(onward.y)
    assert beyond.dy.overlaps(onward.dy)


@parametrize("seed", range(25), ordinary=4)
def test_connection_matrices_turn_coordinates(seed: int) -> None:
    """The solution with coordinates c at one point has the coordinates C c at the other: both say the same in between."""
    rng = random.Random(seed)
    p = [Fraction(rng.randint(-3, 3), rng.randint(1, 3)) for _ in range(5)]
    equation = f"x^2*(x-1)^2*y'' + x*(x-1)*(({p[0]})+({p[1]})*x)*y' + (({p[2]})+({p[3]})*x+({p[4]})*x^2)*y = 0"
    path = rng.choice(
        [(0, "1/2", 1), (1, "1/3", 0), (0, "-1/2", "oo"), ("oo", 3, 1), (0, "1/4", "1/2"), ("1/3", "1/2", 1)]
    )
    coordinates = rng.randint(-3, 3), rng.randint(1, 3)
    matrix = connection_matrix(equation, path, digits=20)
    with ctx.workprec(200):
        turned = [sum((ball_to_flint(v) * k for v, k in zip(row, coordinates, strict=True)), acb(0)) for row in matrix]
    (from_one,) = evaluate_states(equation, [path[1]], x0=path[0], frobenius=coordinates, digits=20)
    (from_other,) = evaluate_states(equation, [path[1]], x0=path[2], frobenius=turned, digits=20)
    assert from_one.y.overlaps(from_other.y)
    assert from_one.dy.overlaps(from_other.dy)
    assert from_one.y.digits > 18


def off_axis(rng: random.Random, count: int) -> list[complex]:
    """Points around 0 and 2 + i, some of them twice, in no order."""
    found = [complex(rng.randint(-24, 24) / 8, rng.choice([-1, 1]) * rng.randint(1, 24) / 8) for _ in range(count)]
    found += [*found[: count // 4], 2 + 1j, 0j]
    rng.shuffle(found)
    return found


@parametrize(
    ("S", "x0"),
    [
        ("x^3 + x + 1", "1/5"),
        ("(x + 3)/(x^2 + 1)", 2 + 1j),
        ("1/(x - 1)^2 + 2/(x^2 + 2)", "1/5"),
        ("1 + 1/(8*x + 3)^3", 2 + 1j),
        ("x^3 + x + 1", 2 + 1j),
        ("(x + 3)/(x^2 + 1)", "1/5"),
        ("1/(x - 1)^2 + 2/(x^2 + 2)", 2 + 1j),
        ("1 + 1/(8*x + 3)^3", "1/5"),
    ],
    ordinary=0,
    long=2,
)
def test_values_at_many_complex_points_are_those_at_each_alone(S: str, x0: Any) -> None:
    """One expansion serves the points of its disc, on the right side of every singular point."""
    rng = random.Random(f"{S} {x0}")
    points = [x for x in off_axis(rng, 40) if abs(x) > 1.5 or rng.random() < 0.5]
    start: dict[str, Any] = {"x0": x0, "y0": 1, "dy0": Fraction(-2, 3), "method": "taylor"}
    alone: dict[complex, Any] = {}
    for x in set(points):
        try:
            alone[x] = evaluate(S, x, derivative=True, digits=20, **start)
        except InputError:  # through a singular point
            points = [p for p in points if p != x]
    assert len(alone) > 25
    for x, found in zip(points, evaluate(S, points, derivative=True, digits=20, **start), strict=True):
        assert all(ball.overlaps(other) and ball.digits > 19 for ball, other in zip(found, alone[x], strict=True)), x


@pytest.mark.long
def test_a_thousand_complex_points_take_a_few_dozen_expansions() -> None:
    points = off_axis(random.Random(7), 1000)
    with bounded_work(10_000):  # an expansion counts the bits of its numbers
        values = evaluate("x^3 + x + 1", points, x0=0, y0=1, dy0=0)
    assert len(values) == 1252

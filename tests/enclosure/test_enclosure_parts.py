"""Parts of the room `kovacic.enclosure`, alone: points, shifted equations, discs and their bounds, ways, tails, quadratures."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from random import Random
from typing import Any

import flint
import mpmath
import pytest
from build import Budget, ExactPoint, System, as_problem, make_frame, system_of
from flint import acb, acb_poly, arb, arb_poly, ctx, fmpq, fmpq_poly
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from kovacic import Ball, InputError, Limits
from kovacic.enclosure import frobenius
from kovacic.enclosure.frame import check_segment, foreseen_growth, frequency, is_apart, offsets, shift
from kovacic.enclosure.log_derivative import _principal_part
from kovacic.enclosure.matrices import NOTHING, MapProduct, State
from kovacic.enclosure.points import as_number, as_point
from kovacic.enclosure.rational import RationalWay, frames
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.way import Followed, Forecast, Local, Ray, Step, Way


def test_numbers_of_every_kind_are_read_exactly() -> None:
    import numpy as np
    import sympy

    third = Fraction(1, 3)
    same = [third, "1/3", sympy.Rational(1, 3), flint.fmpq(1, 3)]
    assert {as_point(v, "x") for v in same} == {ExactPoint(third)}
    assert as_point("0.1", "x").re == as_point(Decimal("0.1"), "x").re == Fraction(1, 10)
    assert as_point(0.1, "x").re == as_point(np.float64(0.1), "x").re == Fraction(0.1) != Fraction(1, 10)
    assert as_point(mpmath.mpf("0.5"), "x") == as_point(sympy.Float(0.5), "x") == ExactPoint(Fraction(1, 2))
    assert as_point(flint.arb(0.5), "x") == as_point(flint.acb(0.5), "x") == ExactPoint(Fraction(1, 2))
    assert as_point(mpmath.mpc(1, 2), "x") == as_point(1 + 2 * sympy.I, "x") == as_point(1 + 2j, "x")


@pytest.mark.parametrize(
    "bad",
    [
        math.nan,
        math.inf,
        complex(0, math.inf),
        "1e999999999",
        "abc",
        "__import__('os')",
        "1/0",
        None,
        [],
        True,
        Decimal("NaN"),
        mpmath.mpf("inf"),
        Ball((1, 0), rad=(1, -3)),
    ],
)
def test_what_isnt_an_exact_finite_number_is_refused(bad: object) -> None:
    with pytest.raises(InputError):
        as_point(bad, "x")


@pytest.mark.long
@given(
    st.lists(st.integers(-50, 50), min_size=1, max_size=7),
    st.fractions(-8, 8, max_denominator=64),
    st.fractions(-8, 8, max_denominator=64),
    st.fractions(-3, 3, max_denominator=9),
    st.fractions(-3, 3, max_denominator=9),
    st.sampled_from([(7, -2, 0, 3), (0, 1), (1, 0, 1)]),
)
@example([1, 2], Fraction(2), Fraction(1), Fraction(1), Fraction(0), (0, 1))  # the denominator there is 2 + i
@example([1, 2], Fraction(1), Fraction(0), Fraction(1), Fraction(0), (0, 1))
@example([1, 2], Fraction(-1), Fraction(0), Fraction(1), Fraction(0), (0, 1))
def test_the_shifted_equation_is_the_equation(
    num: list[int], re: Fraction, im: Fraction, step: Fraction, turn: Fraction, den: tuple[int, ...]
) -> None:
    system = system_of(tuple(num), den)
    re, im = Fraction(round(re * 64), 64), Fraction(round(im * 64), 64)
    centre = ExactPoint(re, im)
    scale = ExactPoint(step, turn)
    if system.is_singular(centre) or not scale.norm_squared():
        return
    p, q = shift(system, centre, scale)

    def at(parts: tuple[list[int], list[int] | None], u: ExactPoint) -> ExactPoint:
        total = ExactPoint(Fraction(0))
        imaginary = parts[1] or [0] * len(parts[0])
        for a, b in zip(reversed(parts[0]), reversed(imaginary), strict=True):
            total = total * u + ExactPoint(Fraction(a), Fraction(b))
        return total

    def original(coefficients: tuple[int, ...], x: ExactPoint) -> ExactPoint:
        total = ExactPoint(Fraction(0))
        for c in reversed(coefficients):
            total = total * x + ExactPoint(Fraction(c))
        return total

    u = ExactPoint(Fraction(2, 5), Fraction(1, 7))
    x = centre + u * scale
    left = at(p, u) * original(system.den, x)
    right = at(q, u) * original(system.num, x) * scale * scale
    assert left == right
    assert q[0][0] > 0
    assert q[1] is None or q[1][0] == 0


@settings(max_examples=20)
@given(
    st.lists(st.integers(-9, 9), min_size=1, max_size=14),
    st.lists(st.integers(-9, 9), max_size=4),
    st.integers(-5, 5),
    st.sampled_from([4, 60]),
)
def test_the_principal_part_at_a_pole(part: list[int], rest: list[int], at: int, n: int) -> None:
    """Of c_1/t + ... + c_k/t^k + f(t)/(3 t + 1)^n, t = x - at, the coefficients are c_1, ..., c_k."""
    assume(part[-1])
    t, third, k = fmpq_poly([-at, 1]), fmpq_poly([1 - 3 * at, 3]) ** n, len(part)
    num = sum((c * t ** (k - j) for j, c in enumerate(part, 1)), fmpq_poly([])) * third + fmpq_poly(rest) * t**k
    with ctx.workprec(2000):
        found = _principal_part(acb_poly(num), acb_poly(t**k * third), acb(at), k)
    assert [ball.unique_fmpz() for ball in found] == part


@pytest.mark.parametrize("seed", range(16))
def test_the_bounds_of_a_disc_hold_along_a_ray(seed: int) -> None:
    rng = random.Random(seed)
    system = random_system(rng)
    centre = ExactPoint(Fraction(rng.randint(-16, 16), 8), Fraction(rng.randint(-16, 16), 8))
    if system.is_singular(centre):
        return
    frame = make_frame(system, centre, rng.randint(-6, 0))
    u = 0.9 * complex(math.cos(seed), math.sin(seed))
    if frame is None:
        return
    bound = frame.bound
    p, q = ([complex(a, b) for a, b in zip(re, im or [0] * len(re), strict=True)] for re, im in (frame.p, frame.q))
    smallest, rise, slope, step = math.inf, 0.0, 0.0, 0.9 / 200
    for k in range(200):
        t = u * k / 200
        value = abs(sum(c * t**j for j, c in enumerate(q)))
        s_value = abs(sum(c * t**j for j, c in enumerate(p))) / value
        smallest = min(smallest, math.log2(value / abs(q[0])))
        slope, rise = (
            slope + step * (1 + s_value * rise),
            rise + step * slope,
        )  # Euler's method stays below z'' = |S| z + 1
    assert bound.log2_least <= smallest + 1e-9
    distances = [d.abs_lower() for d, _ in offsets(system, centre)]
    if all(near > 2 * float(frame.scale) for near in distances):  # |S| doesn't fall much between the sample points
        assert bound.gain >= 0.95 * rise / 2**smallest
        assert bound.slope_gain >= 0.95 * slope / 2**smallest


def random_system(rng: random.Random) -> System:
    degree = rng.randint(0, 4)
    den = [rng.choice([-3, -1, 0, 1, 2, 7]) for _ in range(degree)] + [rng.choice([1, 2, 5])]
    num = [rng.choice([-9, -1, 0, 1, 4, 10**3]) for _ in range(rng.randint(0, 4))]
    return system_of(tuple(num), tuple(den))


def test_an_irrational_singular_point_on_the_path_is_found_and_a_near_miss_isnt() -> None:
    system = system_of((1,), (-2, 0, 1))  # +-sqrt 2
    with pytest.raises(InputError, match=r"1\.41421356"):
        check_segment(system, ExactPoint(Fraction(0)), ExactPoint(Fraction(2)))
    tiny = Fraction(1, 10**40)
    check_segment(system, ExactPoint(Fraction(0), tiny), ExactPoint(Fraction(2), tiny))


def discs(pole: Fraction, a: ExactPoint, b: ExactPoint) -> int:
    system = system_of((3,), (-pole.numerator, pole.denominator))
    with Budget(Limits(seconds=5)).watched():
        return sum(1 for _ in frames(system, a, b, 74))


def discs_stay_few(rng: random.Random, count: int) -> None:
    """From a distance m/10^k of a pole to a length beyond: ties of the rounding of centres are common there."""
    for _ in range(count):
        pole = rng.choice([Fraction(0), Fraction(1), Fraction(1, 3)])
        near = Fraction(rng.randint(1, 9), 10 ** rng.randint(0, 9))
        length = rng.choice([Fraction(1), Fraction(2), Fraction(4), Fraction(1, 2), Fraction(1, 4), Fraction(7, 5)])
        turn = rng.choice(
            [ExactPoint(Fraction(1)), ExactPoint(Fraction(-1)), ExactPoint(Fraction(3, 5), Fraction(4, 5))]
        )
        ends = [ExactPoint(pole) + turn.scaled(near), ExactPoint(pole) + turn.scaled(near + length)]
        rng.shuffle(ends)
        assert discs(pole, ends[0], ends[1]) <= 3 + 1.5 * math.log2((near + length) / near)


@pytest.mark.long
def test_paths_from_close_to_a_singular_point_take_few_discs() -> None:
    discs_stay_few(random.Random(1), 150)


@pytest.mark.slow
def test_thousands_of_paths_take_few_discs() -> None:
    discs_stay_few(random.Random(2), 5000)


@pytest.mark.parametrize("k", range(12))
def test_a_complex_path_comes_to_its_end(k: int) -> None:
    """Where the rest of the way is just longer than the disc that was tried, the next one has to be larger."""
    a, b = ExactPoint(Fraction(59, 64), Fraction(47, 64)), ExactPoint(Fraction(-63, 64), Fraction(13, 32))
    ends = [ExactPoint(p.re + Fraction(k, 97), p.im).scaled(Fraction(2) ** (k - 3)) for p in (a, b)]
    system = system_of((0, 1), (1,))
    with Budget(Limits(seconds=5)).watched():
        assert sum(1 for _ in frames(system, ends[0], ends[1], 223)) < 400
        if k == 0:
            assert len(list(frames(system, a, b, 223))) < 10


@pytest.mark.parametrize("seed", range(5))
def test_no_path_takes_fewer_steps_than_are_foreseen(seed: int) -> None:
    rng = Random(seed)
    num = tuple(rng.randrange(-9, 10) * 10 ** rng.randrange(0, 6) for _ in range(rng.randrange(1, 4)))
    system = system_of((*num, 1), (1, 0, 1) if rng.random() < 0.5 else (1,))
    a, b = (ExactPoint(Fraction(rng.randrange(-40, 41), 4), Fraction(rng.randrange(2, 9), 8)) for _ in "ab")
    steps = len(list(frames(system, a, b, 60)))
    assert foreseen_growth(frequency(system), a, b) <= 2 * 110 * math.log(2) * steps


@pytest.mark.parametrize(
    ("num", "den", "a", "b", "exact"),
    [
        ((0, 1), (1,), 0, 100, 2000 / 3),  # int x^(1/2)
        ((1,), (0, 0, 1), 2, 1, math.log(2)),
        ((1,), (0, 0, 1), 1, 10**6, math.log(10**6)),
        ((), (1,), 2, 1, 0),
    ],
)
def test_the_growth_is_the_integral_of_the_root(num: Any, den: Any, a: int, b: int, exact: float) -> None:
    found = foreseen_growth(frequency(system_of(num, den)), ExactPoint(a), ExactPoint(b))
    assert exact * 0.5 <= found <= exact


@pytest.mark.parametrize(
    ("den", "a", "b", "name"),
    [
        ((0, 1), -1, 1, "point 0 "),
        ((-1, 3), -1, 1, "point 1/3 "),
        ((-1, 0, 10**12), 0, 1, "point 1/1000000 "),
        ((1, 0, 9), -2j, 2j, "point 0 - 1/3i "),
        ((-2, 0, 1), 0, 2, r"point 1\.41421356237\.\.\. "),
        ((-2, *[0] * 499, 1), "1/3", 2, r"point 1\.0013872557\d*\.\.\. "),
    ],
)
def test_a_singular_point_has_its_exact_name(den: tuple[int, ...], a: Any, b: Any, name: str) -> None:
    ends = [as_point(v, "x") for v in (a, b)]
    with pytest.raises(InputError, match=name):
        check_segment(system_of((1,), den), *ends)
    check_segment(system_of((1,), den), *(end + ExactPoint(Fraction(0), Fraction(9)) for end in ends))


def straight_step(enter: ExactPoint) -> Step:
    """A disc of y'' = 0, of radius 1/2."""

    def local(state: State) -> Followed:
        y, dy = (value.real for value in state)
        poly = arb_poly([y + dy / 2, dy / 2])
        return Local(enter + ExactPoint(Fraction(1, 2)), -1, poly, arb(0), arb(0), fmpq(1), 64).state

    return Step(enter + ExactPoint(1), lambda: ((acb(1), acb(1), acb(0), acb(1)), NOTHING), local)


class Straight(Way):
    """y'' = 0, in such discs."""

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        pass

    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        return Forecast(a, b, lambda _: arb(0), 1.0)

    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[Step]:
        while a != b:
            yield straight_step(a)
            a = a + ExactPoint(1)

    def around(self, ball: acb) -> tuple[acb, acb, acb, bool]:
        return acb(0), acb(0), acb(0), True


@pytest.mark.long
def test_a_ray_that_forgets_its_first_discs_begins_again() -> None:
    """y = 3 + 2x, over more discs than are kept."""
    ray = Ray(Straight(), ExactPoint(0), ExactPoint(1 << 15), (acb(3), acb(2)), MapProduct())
    for place in (1, 2500, 5000, 9000, 8999, 1, 9100, 20_000):
        assert ray.state(ExactPoint(place)) == (3 + 2 * place, 2)


def test_an_imaginary_state_is_spread_in_both_directions() -> None:
    """y'' = y, y(0) = i, y'(0) = 0 for a point known to 1/4: the value may be i cosh(1/4)."""
    way = RationalWay(as_problem("1"))
    y, _ = way.spread(as_number(arb(0, 0.25), "x"), (acb(0, 1), acb(0)))
    assert y.contains(acb(0, 1.03))
    real, _ = way.spread(as_number(arb(0, 0.25), "x"), (acb(1), acb(0)))
    assert real.contains(1.03)
    assert real.imag.is_zero()


@pytest.mark.parametrize("seed", range(3))
def test_the_tail_is_below_its_bound(seed: int) -> None:
    """The same basis with few bits and with many: the ball of the first contains that of the second."""
    rng = random.Random(seed)
    n, d = ([rng.randint(-9, 9) for _ in range(3)] for _ in range(2))
    equation = f"({n[0]} + {n[1]}*x + {n[2]}*x^2)/(x^2*({d[0] or 1} + {d[1]}*x + {d[2]}*x^2))"
    problem = as_problem(equation)
    place = Singular.at(problem, ExactPoint(Fraction(0)))
    x = ExactPoint(Fraction(rng.choice([-1, 1]), 16), Fraction(rng.randint(-1, 1), 16))
    found = []
    for prec in (30, 400):
        with ctx.workprec(prec + 40):
            last, bound = frobenius.junction(place, x, prec)
            found.append((last, bound))
    last = min((last for last, _ in found), key=lambda p: p.norm_squared())
    with ctx.workprec(600):
        few, many = (
            frobenius.basis(place, last, x, bound, prec) for prec, (_, bound) in zip((30, 400), found, strict=True)
        )
        assert all(a.overlaps(b) for a, b in zip(few, many, strict=True))
        assert all(
            float((a - b).abs_upper()) < 2.0**-20 * max(1.0, float(b.abs_upper()))
            for a, b in zip(few, many, strict=True)
        )


@pytest.mark.parametrize("place", [ExactPoint(0), None], ids=["0", "infinity"])
def test_the_junction_is_the_target_itself_or_on_the_way_to_it(place: ExactPoint | None) -> None:
    point = Singular.at(as_problem("3/(x^2*(x - 2))"), place)
    for length in (fmpq(1, 2**40), fmpq(1, 70), fmpq(5, 3), fmpq(10**6, 7)):
        towards = ExactPoint(Fraction(3), Fraction(4)).scaled(length if place else 1 / length)
        last, bound = frobenius.junction(point, towards, 60)
        here, there = (abs(point.offset(x)) for x in (last, towards))
        assert here < bound.rho
        assert last == towards or here < 0.51 * there


def test_a_hull_of_points_is_free_of_singular_ones() -> None:
    system = system_of((1,), (1, 0, 1))  # at I and -I
    origin, right, left = ExactPoint(0), ExactPoint(2), ExactPoint(-2)
    high = ExactPoint(fmpq(0), fmpq(3))
    assert is_apart(system, origin, right)
    assert is_apart(system, left, right, ExactPoint(fmpq(1), fmpq(1, 2)))
    assert is_apart(system, ExactPoint(fmpq(1), fmpq(3)), right, ExactPoint(fmpq(1), fmpq(-3)))
    assert not is_apart(system, left, right, high)
    assert not is_apart(system, origin, high)

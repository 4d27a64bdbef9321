"""Enclosures: every value is computed in two ways, and the ball must be right as well as small."""

from __future__ import annotations

import copy
import math
import pickle
import random
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from typing import Any

import flint
import mpmath
import numpy
import pytest
import sympy
from build import ball_to_flint, evaluate_states, parametrize
from hypothesis import given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import AccuracyWarning, Ball, InputError, LimitExceeded, Limits, connection_matrix, evaluate
from kovacic.limits import bounded_work

AIRY = ([0, 1], [1])


def as_mp(value: Fraction) -> mpmath.mpf:
    return mpmath.mpf(value.numerator) / value.denominator


def mp_close(ball: Ball, reference: mpmath.mpf, digits: int) -> bool:
    """The reference (accurate to some 10 digits more than asked) lies in the ball, up to its own error."""
    with mpmath.workdps(digits + 30):
        middle = mpmath.mpc(*(as_mp(part) for part in ball.midpoint))
        return bool(abs(middle - reference) <= ball.radius + abs(reference) * mpmath.mpf(10) ** (-digits - 8))


# --- balls -----------------------------------------------------------------------------------------------------------


@settings(max_examples=20)
@given(st.integers(), st.integers(-200, 200), st.integers(0), st.integers(-300, 100))
def test_balls_survive_the_way_through_flint_and_pickle(m: int, e: int, r: int, k: int) -> None:
    with flint.ctx.workprec(2000):
        ball = Ball.of(flint.arb((m, e), (r, k)))
        again = Ball.of(ball_to_flint(ball))
    assert pickle.loads(pickle.dumps(ball)) == ball
    assert again.contains(ball)
    assert again.radius <= ball.radius * (1 + 2.0**-20)  # flint's radii have 30 bits and are rounded outwards
    middle = ball.midpoint[0]
    assert middle == Fraction(m) * Fraction(2) ** e
    assert ball.contains(middle)
    assert Fraction(r) * Fraction(2) ** k <= Fraction(ball.radius)


@settings(max_examples=20)
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_float_goes_through_a_ball_unchanged(value: float) -> None:
    ball = Ball.of(value)
    assert ball.is_exact()
    assert float(ball) == value
    assert ball.to_mpmath() == mpmath.mpf(value)


def test_the_nearest_double_is_taken_even_far_below_the_last_bit() -> None:
    tie_and_a_bit = Ball.exact((1 << 200) + (1 << 147) + 1)  # above the tie between two doubles by one unit
    assert float(tie_and_a_bit) == float((1 << 200) + (1 << 147) + 1)
    assert Ball((0, 0), rad=(1, -5000)).radius > 0


def test_a_complex_ball_isnt_a_float_and_overlap_is_symmetric() -> None:
    z = Ball((1, 0), (1, 0), (1, -10), False)
    with pytest.raises(TypeError):
        float(z)
    assert complex(z) == 1 + 1j
    assert z.overlaps(Ball.exact(1)) is Ball.exact(1).overlaps(z) is False
    assert Ball((0, 0), rad=(1, 0)).contains(Ball((1, -1), rad=(1, -1)))
    assert not Ball((0, 0), rad=(1, 0)).contains(Ball((1, -1), rad=(3, -2)))


@pytest.mark.parametrize("method", ["taylor", "closed form"])
@parametrize("digits", [5, 150], ordinary=1)
@pytest.mark.parametrize("x", ["-20", "-1/3", "2.5", "11"])
def test_airy_functions(digits: int, x: str, method: Any) -> None:
    ball = evaluate(AIRY, x, x0=0, y0=1, dy0=0, digits=digits, method=method)
    with mpmath.workdps(digits + 40):
        point = as_mp(Fraction(x))
        reference = mpmath.pi * (
            mpmath.airybi(0, derivative=1) * mpmath.airyai(point)
            - mpmath.airyai(0, derivative=1) * mpmath.airybi(point)
        )
        assert mp_close(ball, reference, digits)
    assert ball.digits >= digits
    assert ball.real


def test_a_thousand_digits_of_an_airy_function_against_arb() -> None:
    ball = evaluate(AIRY, 5, x0=0, y0=1, dy0=0, digits=1000, method="taylor")
    with flint.ctx.workprec(3500):
        zero, five = flint.arb(0), flint.arb(5)
        ai, bi, dai, dbi = five.airy_ai(), five.airy_bi(), zero.airy_ai(derivative=1), zero.airy_bi(derivative=1)
        reference = flint.arb.pi() * (dbi * ai - dai * bi)
        assert ball_to_flint(ball).real.overlaps(reference)
    assert ball.digits >= 1000


def test_bessel_functions_of_order_one_third_along_the_axis_and_towards_zero() -> None:
    # sqrt(x) J_nu(x): S = (nu^2 - 1/4)/x^2 - 1
    S = ([Fraction(1, 9) - Fraction(1, 4), 0, -1], [0, 0, 1])

    def state(x: object) -> tuple[mpmath.mpf, mpmath.mpf]:
        f = lambda t: mpmath.sqrt(t) * mpmath.besselj(mpmath.mpf(1) / 3, t)  # noqa: E731
        t = mpmath.mpf(x)
        return f(t), f(t) / (2 * t) + mpmath.sqrt(t) * mpmath.besselj(mpmath.mpf(1) / 3, t, derivative=1)

    with mpmath.workdps(60):
        y0, dy0 = state(1)
        points = ["1e-30", "1e-5", "0.5", "3", "40", "300"]
        balls = evaluate(S, points, x0=1, y0=y0, dy0=dy0, digits=20)
        assert isinstance(balls, tuple)
        for point, ball in zip(points, balls, strict=True):
            assert mp_close(ball, state(point)[0], 19), point


def test_legendre_of_high_degree_between_its_singular_points() -> None:
    # y = sqrt(1 - x^2) P_n(x): S = -(n (n+1) (1 - x^2) + 1)/(1 - x^2)^2
    n = 60
    S = ([-n * (n + 1) - 1, 0, n * (n + 1)], [1, 0, -2, 0, 1])
    with mpmath.workdps(60):
        ball = evaluate(S, "0.99", x0=0, y0=mpmath.legendre(n, 0), dy0=0, digits=30)
        x = mpmath.mpf(99) / 100
        start = mpmath.legendre(n, 0)
        assert mp_close(ball, mpmath.sqrt(1 - x * x) * mpmath.legendre(n, x), 28)
        assert start != 0


def test_a_loop_around_a_logarithm() -> None:
    # S = -1/(4 x^2): y = sqrt(x) log x; once around 0 from 1: -(sqrt(x) (log x + 2 pi i)), so y(1) = 0 becomes -2 pi i
    loop = [1j, -1, -1j]
    ball = evaluate(([-1], [0, 0, 4]), 1, x0=1, y0=0, dy0=1, path=loop, digits=40)
    with mpmath.workdps(60):
        assert mp_close(ball, -2j * mpmath.pi, 40)
    back = evaluate(([-1], [0, 0, 4]), 1, x0=1, y0=0, dy0=1, path=[-1j, -1, 1j], digits=40)
    with mpmath.workdps(60):
        assert mp_close(back, 2j * mpmath.pi, 40)


def test_the_recessive_solution_gets_the_digits_that_growth_costs() -> None:
    # exp(-x^2/2) for S = x^2 - 1: the dominant solution has grown by e^100 at x = 10
    states = evaluate_states(([-1, 0, 1], [1]), [10, 30], x0=0, y0=1, dy0=0, digits=15, method="taylor")
    for state, x in zip(states, (10, 30), strict=True):
        with mpmath.workdps(40):
            assert mp_close(state.y, mpmath.exp(-(mpmath.mpf(x) ** 2) / 2), 15)
        assert state.y.digits >= 15
        assert state.missing == 0
    assert states[1].route.runs > 1


def random_equation(rng: random.Random) -> tuple[list[int], list[int]]:
    """The coefficients of S, upwards."""
    degree = rng.randint(0, 4)
    den = [rng.choice([-3, -1, 0, 1, 2, 7]) for _ in range(degree)] + [rng.choice([1, 2, 5])]
    num = [rng.choice([-9, -1, 0, 1, 4, 10**3]) for _ in range(rng.randint(0, 4))]
    return num or [0], den


def complex_number(re: Fraction, im: Fraction) -> sympy.Expr:
    return sympy.Rational(re) + sympy.Rational(im) * sympy.I


@parametrize("seed", range(60), ordinary=2, long=12)
def test_higher_precision_lies_inside_and_the_determinant_is_one(seed: int) -> None:
    rng = random.Random(seed)
    S = random_equation(rng)
    polygon = [complex_number(Fraction(rng.randint(-30, 30), 7), Fraction(rng.randint(-30, 30), 11)) for _ in range(3)]
    try:
        rough, fine = (connection_matrix(S, polygon, digits=digits) for digits in (8, 30))
    except InputError:
        pytest.skip("the random path meets a singular point")
    for row, finer in zip(rough, fine, strict=True):
        assert all(x.overlaps(y) for x, y in zip(row, finer, strict=True))
    with flint.ctx.workprec(2000):
        a, b, c, d = (ball_to_flint(ball) for row in fine for ball in row)
        assert (a * d - b * c).contains(1)
    largest = max(abs(entry.mid) for row in fine for entry in row)
    assert all(entry.radius <= 1e-30 * largest for row in fine for entry in row)


@pytest.mark.parametrize("seed", range(8))
def test_a_contractible_loop_is_the_identity(seed: int) -> None:
    rng = random.Random(1000 + seed)
    num, den = random_equation(rng)
    re, im = Fraction(rng.randint(-30, 30), 7), Fraction(rng.randint(1, 30), 11)
    poles = numpy.roots(den[::-1])
    size = Fraction(min([1.0, *(abs(poles - complex(re, im)) / 3)])).limit_denominator(10**6)
    polygon = [complex_number(*corner) for corner in ((re, im), (re + size, im), (re, im + size), (re, im))]
    (a, b), (c, d) = connection_matrix((num, den), polygon, digits=20)
    assert a.contains(1)
    assert d.contains(1)
    assert b.contains_zero()
    assert c.contains_zero()
    assert a.radius < 1e-10


def test_large_denominators_dont_cost_precision() -> None:
    # 40 poles on the circle |x| = 3: absolute values of the coefficients of 1/den would lose 2^40 in every disc
    value = evaluate(f"1/(x^40 - {3**40})", "5/2", x0=0, y0=1, dy0=0, digits=30, method="taylor")
    assert value.digits >= 30
    assert value.route.runs == 1


# --- what must be refused --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"x": 1, "x0": -1}, "through the singular point 0 "),
        ({"x": 0, "x0": -1}, "is a singular point"),
        ({"x": 1, "x0": 0}, "is a singular point"),
        ({"x": 1j, "x0": -1j}, "through the singular point"),
        ({"x": math.nan, "x0": 1}, "finite"),
        ({"x": 2, "x0": 1, "y0": math.inf}, "finite"),
        ({"x": 2, "x0": 1, "digits": 0}, "at least 1"),
        ({"x": 2, "x0": 1, "digits": 10**9}, "beyond the limit"),
        ({"x": 2, "x0": 1, "digits": 15.0}, "integer"),
        ({"x": 2, "x0": 1, "method": "euler"}, "unknown method"),
        ({"x": 2, "x0": 1, "path": "zigzag"}, "unknown path"),
        ({"x": 2, "x0": 1, "path": [-1, 3]}, "through the singular point"),
    ],
)
def test_wrong_input_is_refused(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        evaluate(([2], [0, 0, 1]), **{"y0": 1, "dy0": 0, **arguments})  # type: ignore[arg-type]


def test_an_exhausted_limit_is_an_error_when_nothing_is_known() -> None:
    with pytest.raises(LimitExceeded):
        evaluate(AIRY, 10**4, x0=0, y0=1, dy0=0, digits=50, method="taylor", limits=Limits(seconds=0.05))


def test_a_value_that_is_zero_is_a_tiny_ball_with_a_warning() -> None:
    with pytest.warns(AccuracyWarning, match="can't be told from zero"):
        ball = evaluate(([2], [0, 0, 1]), 1, x0=2, y0="7/2", dy0="17/4")  # x^2 - 1/x
    assert ball.contains_zero()
    assert ball.radius < 1e-300


def test_initial_values_that_are_balls_widen_the_result_and_it_says_so() -> None:
    start = Ball((1, 0), rad=(1, -30))
    with pytest.warns(AccuracyWarning, match="initial values"):
        ball = evaluate(([1], [1]), 1, x0=0, y0=start, dy0=1, digits=15)
    for corner in (1 - Fraction(1, 2**30), 1 + Fraction(1, 2**30)):
        assert ball.overlaps(evaluate(([1], [1]), 1, x0=0, y0=corner, dy0=1))


def test_the_global_precision_is_untouched_even_by_an_interruption() -> None:
    before = flint.ctx.prec
    evaluate(AIRY, 3, x0=0, y0=1, dy0=0, digits=200)
    with pytest.raises(LimitExceeded):
        evaluate(AIRY, 10**4, x0=0, y0=1, dy0=0, digits=50, method="taylor", limits=Limits(seconds=0.02))
    assert flint.ctx.prec == before


def test_many_points_come_back_in_the_order_asked_for() -> None:
    points = [3, -2, Fraction(1, 2), 0, 1j, -7]
    together = evaluate(AIRY, points, x0=0, y0=1, dy0=0)
    assert isinstance(together, tuple)
    alone = [evaluate(AIRY, p, x0=0, y0=1, dy0=0, digits=25) for p in points]
    assert all(a.overlaps(b) for a, b in zip(together, alone, strict=True))
    assert together[3] == Ball.exact(1)
    chain = evaluate(AIRY, points, x0=0, y0=1, dy0=0, path="chain")
    assert all(a.overlaps(b) for a, b in zip(chain, alone, strict=True))


@parametrize("S", ["3/16/x^2", "1/(x^2 + 2*x)", "x + 1/x"], ordinary=1, long=1)
@pytest.mark.parametrize("solve", [str, kovacic.solve])
def test_a_chain_visits_its_points_one_after_the_other(S: str, solve: Any) -> None:
    points = [1j, "-3/4", "-5/4", -1 - 1j, "-1/2", -1j, 1, 1j]  # back and forth, and once around 0
    chain = evaluate(solve(S), points, x0=1, y0=1, dy0="1/3", path="chain", derivative=True)
    for k, found in enumerate(chain):
        alone = evaluate(S, points[k], x0=1, y0=1, dy0="1/3", path=points[:k], derivative=True, method="taylor")
        assert all(ball.overlaps(other) for ball, other in zip(found, alone, strict=True)), k
    assert not chain[0][0].overlaps(chain[-1][0])


# --- equations with a first derivative ---------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ["x^2*y'' + x*y' + (x^2 - 1/9)*y = 0"])
def test_an_equation_with_a_first_derivative_is_solved_itself_and_not_its_normal_form(text: str) -> None:
    with mpmath.workdps(60):
        nu, one = mpmath.mpf(1) / 3, mpmath.mpf(1)
        y0, dy0 = mpmath.besselj(nu, one), mpmath.besselj(nu, one, derivative=1)
        for equation in (text, kovacic.solve(text)):
            balls = evaluate(equation, [3, 20, "1/100"], x0=1, y0=y0, dy0=dy0, digits=25)
            assert isinstance(balls, tuple)
            for x, ball in zip((3, 20, mpmath.mpf(1) / 100), balls, strict=True):
                assert mp_close(ball, mpmath.besselj(nu, x), 25)


def test_both_routes_for_an_equation_with_a_first_derivative() -> None:
    elementary = kovacic.solve("x*y'' + 2*y' - x*y = 0")  # sinh(x)/x, cosh(x)/x
    values = [
        evaluate(elementary, 2, x0=1, y0=math.e, dy0=0, digits=25, method=m)  # type: ignore[arg-type]
        for m in ("taylor", "closed form")
    ]
    with mpmath.workdps(50):
        # y = exp(x - 1)/x c1 + exp(1 - x)/x c2 with y(1) = c1 + c2, y'(1) = -2 c2
        e = mpmath.mpf(math.e)
        exact = e * mpmath.exp(1) / 2
        assert all(mp_close(v, exact, 25) for v in values)  # type: ignore[arg-type]


def test_poles_of_the_first_coefficient_are_singular_even_where_the_normal_form_is_regular() -> None:
    with pytest.raises(InputError, match="through the singular point 0 "):
        evaluate("x*y'' + 2*y' - x*y = 0", 1, x0=-1, y0=1, dy0=0)


# --- numbers of discs --------------------------------------------------------------------------------------------------


@pytest.mark.long
def test_a_path_from_close_to_a_singular_point_doesnt_stall() -> None:
    ball = evaluate("1/x", "1.000001", x0="0.000001", y0=1, dy0=0, limits=Limits(seconds=20))
    assert ball.digits >= 15
    assert ball.overlaps(evaluate("1/x", "1.000001", x0="0.000001", y0=1, dy0=0, path=["1/3"], digits=25))


# --- threads -----------------------------------------------------------------------------------------------------------


def test_threads_get_the_balls_that_each_would_get_alone_and_leave_the_precision_alone() -> None:
    def task(number: int) -> Ball:
        return evaluate(["x", "1/x", "x^2 + 1"][number % 3], 3, x0=1, y0=1, dy0=0, digits=15 + 40 * number)

    before = flint.ctx.prec
    alone = [task(number) for number in range(8)]
    with ThreadPoolExecutor(8) as threads:
        for _ in range(3):
            assert list(threads.map(task, range(8))) == alone
    assert flint.ctx.prec == before


# --- real problems -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["taylor", "closed form", None])
@parametrize(
    "equation",
    ["-1", "-2", "1 + 2/x^2", "9/(2*x^4 + 16*x^3 + 72*x^2 + 160*x + 200)", "y'' + y' + y = 0"],
    ordinary=2,
)
def test_a_real_problem_has_a_real_ball(equation: str, method: Any) -> None:
    solution = kovacic.solve(equation)
    balls = evaluate(solution, [3, "1/2"], x0=1, y0=1, dy0="-1/7", path=[2, "3/2"], method=method)
    assert isinstance(balls, tuple)
    assert all(ball.real for ball in balls)
    around = evaluate(solution, 3, x0=1, y0=1, dy0="-1/7", path=[2 + 1j], method=method)
    assert isinstance(around, Ball)
    assert around.overlaps(balls[0])
    assert not around.real
    assert float(kovacic.solve("-1").at(1, x0=0, y0=1, dy0=0)) == math.cos(1)


@pytest.mark.parametrize(
    "equation", ["x", "1/(x^2+1)", "(x-1)/(x^2+4)", "y'' - 2*x*y' + 3*y = 0", "x^2*y'' + x*y' + (x^2 - 2)*y = 0"]
)
def test_a_crowd_of_points_has_the_balls_of_single_ones(equation: str) -> None:
    """Sixty points share the polynomials of a few discs, and each is where a call for it alone says."""
    points = [Fraction(k, 37) + 1 for k in range(1, 240, 4)] + [Fraction(1, k) for k in range(1, 20)]
    together = evaluate_states(equation, points, x0=1, y0=1, dy0=Fraction(1, 2), digits=20)
    for x, state in list(zip(points, together, strict=True))[::7]:
        (alone,) = evaluate_states(equation, [x], x0=1, y0=1, dy0=Fraction(1, 2), digits=30)
        assert state.y.digits >= 20
        assert state.y.overlaps(alone.y)
        assert state.dy.overlaps(alone.dy)


def test_arrays_of_any_shape_keep_it_and_holes_stay_holes() -> None:
    x = numpy.array([[0.5, math.nan, 2.0], [1.0, -1.0, 0.0]])
    values = evaluate(AIRY, x, x0=0, y0=1, dy0=0)
    assert values.shape == (2, 3)
    assert math.isnan(values[0, 1])
    assert values[0, 2] == evaluate(AIRY, 2.0, x0=0, y0=1, dy0=0) or values[0, 2].overlaps(
        evaluate(AIRY, 2, x0=0, y0=1, dy0=0)
    )
    pair = evaluate(AIRY, numpy.float64(1), x0=0, y0=1, dy0=0, derivative=True)
    assert [part.real for part in pair] == [True, True]


def test_numbers_may_be_constants_and_balls_of_every_library() -> None:
    with flint.ctx.workprec(300):
        root = flint.acb(2).sqrt()
        for x in ("sqrt(2)", sympy.sqrt(2)):
            assert ball_to_flint(evaluate("1", x, x0=0, y0=1, dy0=0, digits=50)).overlaps(root.cosh())
        assert evaluate("1", "sqrt(2)", x0="pi", y0="sin(1)", dy0="1 + 2*I", digits=50).digits >= 50
        wide = flint.arb(2, 0.001)
        with pytest.warns(AccuracyWarning):
            ball = evaluate("1", wide, x0=0, y0=1, dy0=0)
        for end in (1.999, 2.001, 2):
            assert ball_to_flint(ball).contains(flint.acb(end).cosh())
        assert ball.radius < 0.02
        interval = mpmath.iv.mpf(["-2.001", "-1.999"])
        with pytest.warns(AccuracyWarning):
            other = evaluate("1", interval, x0=0, y0=1, dy0=0)
        assert other.overlaps(ball)
        assert other.radius < 0.02
        plane = evaluate("1", "1 + 2*I", x0=0, y0=1, dy0=0)
        assert ball_to_flint(plane).overlaps(flint.acb(1, 2).cosh())
        # the start may be a ball, too: exp(x - pi)
        start = evaluate("1", 0, x0="pi", y0=1, dy0=1, digits=40)
        assert ball_to_flint(start).overlaps((-flint.acb.pi()).exp())


@pytest.mark.long
@given(st.fractions(), st.fractions(), st.fractions(min_value=0, max_value=1), st.fractions(min_value=0, max_value=1))
def test_the_arithmetic_of_balls_contains_that_of_their_numbers(
    a: Fraction, b: Fraction, r: Fraction, s: Fraction
) -> None:
    """x in X and y in Y: x op y in X op Y, and comparisons say what holds for all of them."""
    X, Y = (Ball.of(f"{v.numerator}/{v.denominator}") for v in (a, b))
    X, Y = X + Ball((0, 0), rad=(int(r * 2**20), -20)), Y + Ball((0, 0), rad=(int(s * 2**20), -20))
    r, s = (Fraction(int(v * 2**20), 2**20) for v in (r, s))
    pairs = [(a + i * r, b + j * s) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    for x, y in pairs:
        assert (X + Y).contains(x + y)
        assert (X - Y).contains(x - y)
        assert (X * Y).contains(x * y)
        assert (X**3).contains(x**3)
        assert abs(X).contains(abs(x))
        assert (2 - X).contains(2 - x)
        if not Y.contains_zero():
            assert (X / Y).contains(x / y)
            assert (1 / Y).contains(1 / y)
        assert X.lower <= x <= X.upper
        assert (X < Y) in (x < y, None)
        assert (X >= Y) in (x >= y, None)
        assert (X <= Y) in (x <= y, None)
        assert (X > Y) in (x > y, None)
        assert X.equals(Y) in (x == y, None)
    if X.upper < Y.lower:
        assert X < Y


def test_balls_go_to_other_libraries_and_back() -> None:
    ball = evaluate(AIRY, 1, x0=0, y0=1, dy0=0, digits=40)
    plane = evaluate(AIRY, 1j, x0=0, y0=1, dy0=0, digits=40)
    for one in (ball, plane):
        for way in (one.to_flint(), one.to_interval()):
            again = Ball.of(way)
            assert again.contains(one)
            assert again.digits >= 38
    assert isinstance(ball.to_flint(), flint.arb)
    assert f"{ball:.25f}" == mpmath.nstr(ball.to_mpmath(), 26)
    assert f"{Ball.exact(-3, -2):.3f}" == "-0.750"
    assert f"{plane:.5f}" == f"({plane.mid.real:.5f} - {-plane.mid.imag:.5f}j)"
    assert (ball * 2 - ball - ball).contains_zero()
    assert Ball.of("pi").digits > 100
    with pytest.raises(ZeroDivisionError):
        1 / (ball - ball)
    with pytest.raises(TypeError):
        plane < 1  # noqa: B015
    with pytest.raises(TypeError):
        ball + "x"
    assert float(sum([ball, ball])) == 2 * float(ball)


RIGHT_HAND_SIDES: list[tuple[str, str, Any, Any]] = [
    ("y'' + y", "x + sin(x)", 0, 3),
    ("y'' + y", "cos(x) - x*cos(x)/2", 0, [3, -2]),
    ("y'' - y", "exp(x)/x - exp(-x)", 1, [3, Fraction(1, 2)]),
    ("x^2*y'' + x*y' - y", "x - log(x)", 1, [3, Fraction(1, 5)]),
    ("y'' - 2*x*y' - 2*y", "exp(x^2) + sin(x)", 0, 1),
    ("y'' + 2*x*y'", "x + 2", 0, [3, -1, 1 + 1j]),
    ("(x^2+1)*y'' + y", "x^2", 0, [5, -5]),
    ("x^2*y'' + x*y' - 3*y", "x - log(x)", 1, [1 + 1j, 3, 2 + 1j]),
]


@parametrize(("equation", "solution", "x0", "x"), RIGHT_HAND_SIDES, ordinary=2)
def test_equations_with_a_right_hand_side(equation: str, solution: str, x0: Any, x: Any) -> None:
    """The answer first: y is known, and f is what makes it a solution."""
    t = sympy.Symbol("x")
    y = sympy.sympify(solution.replace("^", "**"))
    coefficients = []
    for unit in ((0, 0, 1), (0, 1, 0), (1, 0, 0)):  # what is left of the equation for y'' = 1, y' = 1, y = 1
        text = equation
        for name, number in zip(("y''", "y'", "y"), unit[::-1], strict=True):
            text = text.replace(name, str(number))
        coefficients.append(sympy.sympify(text.replace("^", "**")))
    f = sympy.expand(sum(p * y.diff(t, k) for p, k in zip(coefficients, (2, 1, 0), strict=True)))
    given = f"{equation} = {f}".replace("**", "^")
    start = [y.subs(t, x0), y.diff(t).subs(t, x0)]
    path = [x0, Fraction(3, 2) + x0] if "3*y" in equation else None
    points = x if isinstance(x, list) else [x]
    found = evaluate(given, points, x0=x0, y0=start[0], dy0=start[1], path=path, digits=25, derivative=True)
    for point, pair in zip(points, found, strict=True):
        for ball, exact in zip(pair, (y, y.diff(t)), strict=True):
            assert mp_close(
                ball, mpmath.mpmathify(sympy.N(exact.subs(t, sympy.nsimplify(point, rational=True)), 60)), 40
            )
        assert pair[0].digits >= 25


def test_a_ball_that_says_nothing_is_refused() -> None:
    with pytest.raises(InputError, match="y0 isn't a finite ball"):
        evaluate(AIRY, 1, x0=0, y0=flint.acb("nan"), dy0=0)
    with pytest.raises(InputError, match="finite"):
        evaluate(AIRY, mpmath.iv.mpf(["0", "inf"]), x0=0, y0=1, dy0=0)


def test_a_right_hand_side_that_cannot_be_is_refused() -> None:
    for equation, options, words in [
        ("y'' + y = 1/(x-1)", {"x0": 0, "y0": 1, "dy0": 0}, "singular point 1"),
        ("x*y'' + y = 1", {"x0": 0, "which": "regular"}, "right-hand side needs"),
        ("y'' + y = x", {"x0": 0, "y0": 1, "dy0": 0, "method": "closed form"}, "without a right-hand side"),
    ]:
        with pytest.raises(InputError, match=words):
            evaluate(equation, 2, **options)
    with pytest.raises(InputError, match="without a right-hand side"):
        connection_matrix("y'' + y = x", [0, 1])


@pytest.mark.parametrize("order", [3, 10, 11, 12, 40])
def test_a_gauge_with_a_pole_of_high_order(order: int) -> None:
    """x exp(-1/((k - 1) x^(k - 1))): from the order 11 on, FLINT's series lost the terms of low order, the residue first."""
    gamma = f"(1/x + 1/x^{order})"
    equation = f"y'' - 2*{gamma}*y' + ({gamma}^2 + 1/x^2 + {order}/x^{order + 1})*y = 0"
    value = evaluate(equation, 3, x0=1, y0=1, dy0=2, digits=30)
    with mpmath.workdps(90):
        assert value.contains(3 * mpmath.exp((1 - mpmath.mpf(3) ** (1 - order)) / (order - 1)))
        assert float(value) > 3


@pytest.mark.long
@pytest.mark.parametrize("digits", [5, 50, 300])
def test_a_ball_is_printed_with_the_digits_that_were_asked_for(digits: int) -> None:
    """y = (Bi'(0) Ai - Ai'(0) Bi)/W, by mpmath; the representation is short."""
    value = kovacic.evaluate("x", 2, x0=0, y0=1, dy0=0, digits=digits)
    text, _, radius = str(value).partition(" ± ")
    with mpmath.workdps(digits + 100):
        u, v, w, z = (f(x) for f in (mpmath.airyai, mpmath.airybi) for x in (0, 2))
        du, dw = mpmath.airyai(0, derivative=1), mpmath.airybi(0, derivative=1)
        exact = (dw * v - du * z) / (u * dw - w * du)
        assert abs(mpmath.mpf(text) - exact) < abs(exact) * mpmath.mpf(10) ** -digits
        assert abs(mpmath.mpf(text) - exact) <= mpmath.mpf(radius)
    assert len(repr(value)) < 80


@pytest.mark.parametrize("equation", ["x^2*y'' + x*y' + (x^2 - 1/9)*y = 0", "1/x + 1", "pi*x", "sqrt(2)*x"])
def test_a_solution_pickles_after_it_was_evaluated(equation: str) -> None:
    solution = kovacic.solve(equation)
    values = solution.at([2, 3j], x0=1, y0=1, dy0=0)
    for other in (pickle.loads(pickle.dumps(solution)), copy.deepcopy(solution)):
        assert other == solution
        assert other.at([2, 3j], x0=1, y0=1, dy0=0) == values


@parametrize("name", ["atan", "asin", "acos", "asinh", "atanh", "acosh"], ordinary=2)
def test_inverse_functions_on_the_right(name: str) -> None:
    """y'' = h, y(0) = y'(0) = 0: y(1) = int_0^1 (1 - s) h(s) ds."""
    given = f"{name}(x/2 + 3)" if name == "acosh" else f"{name}(x/2)"
    h = getattr(mpmath, name)
    exact = mpmath.quad(lambda s: (1 - s) * h(s / 2 + 3 * (name == "acosh")), [0, 1])
    assert abs(float(evaluate(f"y'' = {given}", 1, x0=0, y0=0, dy0=0)) - exact) < 1e-12


@parametrize("right", ["tan(x)", "1/cos(x)", "1/(exp(x) - 3)", "log(2 - x)", "sqrt(3/2 - x)"], ordinary=(0,), long=2)
def test_singular_points_of_the_right_hand_side_are_refused(right: str) -> None:
    """Between 1 and 11/5; rational right-hand sides are refused likewise.  Beside it, and up to it, there are values."""
    with pytest.raises(InputError, match="on the path"):
        evaluate(f"y'' + y' + 2*y = {right}", "11/5", x0="1/2", y0=0, dy0=0)
    assert evaluate(f"y'' + y' + 2*y = {right}", "1", x0="1/2", y0=0, dy0=0).digits >= 15


def test_an_exact_zero_beside_a_value_that_needs_more_bits() -> None:
    zero, small = evaluate("-251 + 7/3/(x+7)^2", ["9/2", "4.301757"], x0="9/2", y0=0, dy0=2, digits=25)
    assert zero.is_exact()
    assert zero.contains_zero()
    assert small.digits >= 25


@pytest.mark.parametrize("height", ["1/4", "1", "3"])
@pytest.mark.parametrize("side", ["above", "below"])
def test_singular_points_without_targets_between_them_are_passed_together(height: str, side: str) -> None:
    """By the way that keeps near the axis: other singular points are not passed on their far side."""
    start: dict[str, Any] = {"x0": 0, "y0": 1, "dy0": "1/3"}
    equation = f"2/(x - 1)^2 - 1/(x - 2) + 1/((x - 3/2)^2 + ({height})^2)"
    sign = 1 if side == "above" else -1
    near = [(Fraction(k, 16), Fraction(sign, 8)) for k in (14, 18, 30, 34)]
    path = [f"{x} + {y}*I" for x, y in near]
    together = kovacic.evaluate(equation, 3, path=side, **start)
    assert together.overlaps(kovacic.evaluate(equation, 3, path=path, **start))
    assert together.digits > 14
    (with_targets, *_) = kovacic.evaluate(equation, [3, "3/2"], path=side, **start)
    assert together.overlaps(with_targets)


def test_a_detour_is_made_once() -> None:
    """Around -1, 0 and 1: a second point beyond them takes none of the discs again."""
    equation = "(x^3 - x)*y'' + y = 0"
    kovacic.evaluate(equation, "5/2", x0=-2, y0=1, dy0=0, path="above")
    with bounded_work(0):
        kovacic.evaluate(equation, "51/20", x0=-2, y0=1, dy0=0, path="above")

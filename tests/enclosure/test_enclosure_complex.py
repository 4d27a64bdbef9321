"""Complex constants, and right-hand sides beside constants and parameters: solutions that were chosen first."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import product
from math import isqrt
from typing import Any

import flint
import mpmath
import pytest
import sympy
from build import ball_to_flint, parametrize
from flint import acb, arb, fmpq

import kovacic
from kovacic import InputError, evaluate, monodromy

X = sympy.Symbol("x")
CONSTANTS = ["I", "1 + I", "2 - I*sqrt(2)", "sqrt(3)*I", "sqrt(2)", "-1/2 + sqrt(3)*I/2", "1/3 - 2*I"]
SOLUTIONS = [
    "(x + 3)^2 - {c}*x",
    "cos({c}*x) + x",
    "exp({c}*x/2)",
    "x^3 - {c}",
    "1/(x - {c}*I - 4)",
    "sin(x) + {c}*exp(-x)",
]
COEFFICIENTS = [
    ("0", "-{c}*x"),
    ("{c}", "x^2"),
    ("1/(x + 4 + {c})", "{c}/(x + 5)"),
    ("x - {c}", "2"),
    ("0", "{c}/(x - 5 + {c})^2"),
]


def sympified(text: str, **names: Any) -> sympy.Expr:
    return sympy.sympify(text.replace("^", "**"), locals=names)


def holds(ball: Any, value: sympy.Expr, at: Any) -> bool:
    """Is the value at a rational number, or at a pair of them for a complex one, in the ball?  By SymPy's numbers."""
    re, im = at if isinstance(at, tuple) else (at, 0)
    with mpmath.workdps(120):
        exact = mpmath.mpmathify(sympy.N(value.subs(X, sympy.Rational(re) + im * sympy.I), 100))
        return bool(abs(ball.to_mpmath() - exact) <= ball.radius + mpmath.mpf(10) ** -90 * (1 + abs(exact)))


def forced(seed: int) -> None:
    """y'' + b y' + c y = f with a chosen y: f is what is left."""
    rng = random.Random(seed)
    constant, y = rng.choice(CONSTANTS), rng.choice(SOLUTIONS)
    b, c = rng.choice(COEFFICIENTS)
    texts = [text.format(c=f"({constant})") for text in (y, b, c)]
    solution, first, zeroth = map(sympified, texts)
    right = sympy.expand(solution.diff(X, 2) + first * solution.diff(X) + zeroth * solution)
    equation = f"y'' + ({texts[1]})*y' + ({texts[2]})*y = {str(right).replace('**', '^')}"
    x0, x = Fraction(rng.randint(-3, 3), 2), Fraction(rng.randint(-6, 6), 4)
    values = [str(part.subs(X, sympy.Rational(x0))) for part in (solution, solution.diff(X))]
    digits = rng.choice([6, 15, 40])
    found = evaluate(equation, x, x0=x0, y0=values[0], dy0=values[1], digits=digits, derivative=True)
    for ball, value in zip(found, (solution, solution.diff(X)), strict=True):
        assert holds(ball, value, x), (equation, x0, x)
    assert found[0].digits >= digits or found[0].contains_zero()


@parametrize("seed", range(40), ordinary=1, long=(1, 5))
def test_a_chosen_solution_of_an_equation_with_constants_and_a_right_hand_side(seed: int) -> None:
    forced(seed)


def airy_basis(root: acb, x: acb) -> list[acb]:
    """Ai and Bi of root x, and their derivatives."""
    ai, dai, bi, dbi = (root * x).airy()
    return [ai, bi, root * dai, root * dbi]


@parametrize("seed", range(12), ordinary=5)
@pytest.mark.parametrize("digits", [5, 30, 200])
def test_airy_with_complex_constants(seed: int, digits: int) -> None:
    rng = random.Random(seed)
    slope, shift = (complex(rng.randint(-3, 3), rng.randint(1, 3)) / 2 for _ in "ab")  # y'' = (p x + q) y
    x0, x = rng.randint(-3, 0), rng.choice([2, Fraction(5, 4), 1 + 2j, -2.5j])
    text = "({})*x + ({})".format(*(f"{z.real} + ({z.imag})*I" for z in (slope, shift)))
    given = evaluate(
        "p*x + q", x, x0=x0, y0=1, dy0="I", params={"p": slope, "q": shift}, digits=digits, derivative=True
    )
    for found in (evaluate(text, x, x0=x0, y0=1, dy0="I", digits=digits, derivative=True), given):
        assert found[0].digits >= digits
        with flint.ctx.workprec(1500):
            root, zero = (
                acb(slope.real, slope.imag) ** (acb(1) / 3),
                acb(shift.real, shift.imag) / acb(slope.real, slope.imag),
            )
            place = acb(fmpq(x.numerator, x.denominator)) if isinstance(x, int | Fraction) else acb(x.real, x.imag)
            (ai, bi, dai, dbi), (a, b, da, db) = (airy_basis(root, x + zero) for x in (acb(x0), place))
            c, d = dbi - acb(0, 1) * bi, acb(0, 1) * ai - dai
            over = ai * dbi - bi * dai
            for ball, value in zip(found, (c * a + d * b, c * da + d * db), strict=True):
                assert ball_to_flint(ball).contains(value / over)


@parametrize(("c", "m"), [("I", 2), ("sqrt(3)*I", -1), ("1 + I", 3), ("-sqrt(2) + I", -3)], ordinary=1, long=2)
def test_complex_poles(c: str, m: int) -> None:
    # y = (x - c)^m; the conjugate of c is an ordinary point
    solution = (X - sympified(c)) ** m
    for x in ((2, 0), (-2, 5)):
        y0, dy0 = (str(part.subs(X, -1)) for part in (solution, solution.diff(X)))
        point = f"{x[0]} + ({x[1]})*I"
        for equation in (f"{m * (m - 1)}/(x - ({c}))^2", f"(x - ({c}))*y'' = {m - 1}*y'"):
            ball = evaluate(equation, point, x0=-1, y0=y0, dy0=dy0, digits=30)
            assert holds(ball, solution, x)
            assert ball.digits >= 30
    conjugate = str(sympy.conjugate(sympified(c)))
    over = evaluate(f"{m * (m - 1)}/(x - ({c}))^2", conjugate, x0="-7/10", y0=1, dy0=0)
    assert over.digits >= 14
    with pytest.raises(InputError, match="singular point"):
        evaluate(f"{m * (m - 1)}/(x - ({c}))^2", c, x0=-1, y0=1, dy0=0)


@pytest.mark.parametrize(("x0", "x"), [("1415", "1414.3"), pytest.param("1414.5", "1416", marks=pytest.mark.long)])
def test_beside_a_pole_of_high_order_that_is_far_from_zero(x0: str, x: str) -> None:
    # y = (x - c)^6, c = 1000 sqrt(2), whose denominator in x has large coefficients that cancel
    solution = (X - 1000 * sympy.sqrt(2)) ** 6
    y0, dy0 = (str(part.subs(X, sympy.Rational(x0))) for part in (solution, solution.diff(X)))
    for S in ("30/(x - 1000*sqrt(2))^2", "30*(x - 1000*sqrt(2))^4*(x^6 + 2)/((x - 1000*sqrt(2))^6*(x^6 + 2))"):
        ball = evaluate(S, x, x0=x0, y0=y0, dy0=dy0, digits=20)
        assert holds(ball, solution, Fraction(x))
        assert ball.digits >= 20
    if x0 == "1414.5":
        assert evaluate("x/(x - 1000*sqrt(2))^6", x, x0=x0, y0=1, dy0=0).digits >= 15


def test_the_path_through_a_complex_pole_is_refused() -> None:
    with pytest.raises(InputError, match=r"runs through the singular point near 0 \+ 1i"):
        evaluate("2/(x - I)^2", "2*I", x0=0, y0=1, dy0=0)
    assert evaluate("2/(x - I)^2", "-2*I", x0=0, y0=-1, dy0="-2*I").contains(-9)
    with pytest.raises(InputError, match="so near that its constants don't tell"):
        evaluate("y'' = y + 1/(x - sqrt(2))", 2, x0=0, y0=1, dy0=0)


def test_a_path_that_begins_just_beyond_a_pole_is_no_path_through_it() -> None:
    """sqrt(2) < x0, by less than balls of 128 bits tell apart."""
    x0 = Fraction(isqrt(2 << 264) + 1, 1 << 132)
    assert evaluate("1/(x^2 - 2)", x0 + Fraction(1, 1 << 120), x0=x0, y0=1, dy0=0, digits=3).contains(1)


def test_an_imaginary_part_below_the_precision_isnt_lost() -> None:
    ball = evaluate("x + I/10^200", 2, x0=0, y0=1, dy0=0)
    assert not ball.real
    sharp = evaluate("x + I/10^200", 2, x0=0, y0=1, dy0=0, digits=300)
    assert sharp.im[0] != 0
    assert ball.overlaps(sharp)


def test_monodromy_around_a_complex_pole() -> None:
    (place,) = monodromy("-2/(9*(x - 1 - I)^2)")
    assert place.point.contains(1 + 1j)
    assert place.consistent
    assert place.is_identity_to_the_power(3)


@pytest.mark.parametrize("x0", ["1", "3/2"])
@parametrize("right", ["1", "10^6*x", "exp(x)", "1/x"], ordinary=4)
@pytest.mark.filterwarnings("ignore::kovacic.enclosure.evaluate.AccuracyWarning")
def test_a_ball_as_a_point_of_an_equation_with_a_right_hand_side(right: str, x0: str) -> None:
    equation = f"y'' = {right}"
    low, middle, high = (str(Fraction(x0) + k * Fraction(1, 8)) for k in (-1, 0, 1))
    ball = arb(float(Fraction(middle)), 0.125)
    begin = evaluate(equation, 2, x0=ball, y0=0, dy0=0, derivative=True)
    end = evaluate(equation, ball, x0=2, y0=0, dy0=0, derivative=True)
    for place in (low, middle, high):
        for found, exact in (
            (begin, evaluate(equation, 2, x0=place, y0=0, dy0=0, derivative=True)),
            (end, evaluate(equation, place, x0=2, y0=0, dy0=0, derivative=True)),
        ):
            assert all(one.contains(other.midpoint[0]) for one, other in zip(found, exact, strict=True))


def test_functions_of_real_numbers_refuse_complex_equations() -> None:
    for equation in ("x + I", "y'' + 2*I*y' = 0", "y'' = x*y + I", "y'' = x*y + exp(I*x)"):
        with pytest.raises(InputError, match=r"real coefficients"):
            kovacic.tabulate(equation, 0, 1, x0=0, y0=1, dy0=0)


@pytest.mark.long
def test_constants_beside_functions_of_x() -> None:
    found = evaluate("y'' + I*exp(x)*y = 0", 1, x0="1/2", y0=1, dy0=0)
    with flint.ctx.workprec(200):  # J0 and Y0 of 2 sqrt(I) exp(x/2)
        root = 2 * acb(0, 1).sqrt()
        a, z = (root * arb(t).exp() for t in (0.25, 0.5))
        exact = (a.bessel_y(1) * z.bessel_j(0) - a.bessel_j(1) * z.bessel_y(0)) / (
            a.bessel_y(1) * a.bessel_j(0) - a.bessel_j(1) * a.bessel_y(0)
        )
        assert ball_to_flint(found).overlaps(exact)
    wave = evaluate("y'' + I*cos(x)*y = 1", 1, x0=0, y0=1, dy0=0, digits=10)
    with mpmath.workdps(20):
        own = mpmath.odefun(lambda t, s: [s[1], 1 - 1j * mpmath.cos(t) * s[0]], 0, [mpmath.mpc(1), mpmath.mpc(0)])(1)[0]
        assert abs(wave.to_mpmath() - own) < 1e-15


#: Real solutions, and real b and c: what is real between real points isn't on a way that begins beside the axis.
REAL_SOLUTIONS = ["exp(x)", "sin(x) + x", "x^2 + 1/(x + 5)", "x*log(x)", "sqrt(x + 1)"]
REAL_COEFFICIENTS = [("-8/5/x^2", "(7/3 + 2/5*x)/x^2"), ("0", "1/x"), ("0", "-4"), ("3/x", "x"), ("exp(-x)", "sin(x)")]


@parametrize(
    ("coefficients", "solution"), product(REAL_COEFFICIENTS, REAL_SOLUTIONS), ordinary=(12,), long=1
)  # each of both
def test_real_right_hand_sides_on_ways_beside_the_axis(coefficients: tuple[str, str], solution: str) -> None:
    """Junctions of discs are rounded, and may lie on the axis; with its centre beside it, or 1/g complex, a disc isn't real."""
    b, c = coefficients
    y, B, C = (sympified(text) for text in (solution, b, c))
    f = str(sympy.diff(y, X, 2) + B * sympy.diff(y, X) + C * y).replace("**", "^")
    ways: list[tuple[str, list[str], Any]] = [
        ("37/10 - 1/10*I", ["3/2", "3", "1/2", "3/2 + 1/10*I"], None),
        ("6/10 + 1/10*I", ["37/10", "9/10"], "chain"),
        ("1 + 1/1000*I", ["4 + 1/1000*I", "4"], None),
        ("2", ["1/2", "5"], ["3 + 1/2*I", "3"]),
    ]
    for x0, points, path in ways:
        start = sympified(x0)
        y0, dy0 = (part.subs(X, start) for part in (y, sympy.diff(y, X)))
        found = evaluate(f"y'' + ({b})*y' + ({c})*y = {f}", points, x0=x0, y0=y0, dy0=dy0, digits=20, path=path)
        for point, value in zip(points, found, strict=True):
            exact = sympy.N(y.subs(X, sympified(point)), 40)
            assert value.digits >= 20
            with mpmath.workdps(40):
                distance = abs(value.to_mpmath() - mpmath.mpmathify(exact))
            assert distance <= value.radius, (x0, point)


#: Numbers that aren't real, most of them without an i, and two that are.
NUMBERS = [
    "acos(2)",
    "(-1)^(1/3)",
    "atanh(2)",
    "(-8)^(2/3)",
    "log(-3)",
    "(-2)^sqrt(2)",
    "I",
    "(1 + I)^2",
    "acos(1/2)",
    "sqrt(3)",
]


@parametrize("number", NUMBERS, ordinary=4, long=2)
@pytest.mark.parametrize("right", ["{c}*exp(x)", "{c}*sqrt(x + 2)", "{c}*x", "exp({c}*x/5)"])
@pytest.mark.parametrize("given", ["in the text", "a parameter"])
def test_numbers_on_the_right_that_are_not_real(number: str, right: str, given: str) -> None:
    """y(x) = cos(x) + int_0^x sin(x - t) f(t) dt for y'' + y = f."""
    exact = sympified(number.replace("1/3", "Rational(1, 3)").replace("2/3", "Rational(2, 3)"))
    f = sympy.lambdify(X, sympified(right.format(c="c"), c=exact), "mpmath")
    end = mpmath.mpf(1) / 2
    options: dict[str, Any] = {"params": {"c": number}} if given == "a parameter" else {}
    text = right.format(c="c" if options else f"({number})")
    found = evaluate(f"y'' + y = {text}", "1/2", x0=0, y0=1, dy0=0, digits=12, **options)
    assert found.digits >= 12
    with mpmath.workdps(30):
        wanted = mpmath.cos(end) + mpmath.quad(lambda t: mpmath.sin(end - t) * f(t), [0, end])
        assert abs(found.to_mpmath() - wanted) <= found.radius + 1e-25
    assert found.real == (number in NUMBERS[-2:])

"""Initial values on either side of a singular point: the answer is real there, and says so."""

from __future__ import annotations

from itertools import product

import pytest
import sympy
from build import parametrize, size
from sympy.abc import x

import kovacic

#: Equations with closed forms of every kind, and a point in each interval between singular points.
EQUATIONS: list[tuple[str, tuple[str, ...]]] = [
    # a root beside an arc tangent or a logarithm on a curve
    ("x*(x-1)*y'' + 7/2*x*y' + y = 0", ("-1", "1/2", "2")),
    ("x*(x-1)*y'' + 5/2*x*y' + y/2 = 0", ("-2", "1/2", "3")),
    ("(x-1)*(x-3)*y'' + 5/2*(x-1)*y' - y = 0", ("-1", "2", "4")),
    ("(x^2-4)*y'' + 7*x*y' + 9*y = 0", ("-3", "1", "3")),
    ("x*(x-1)*(x-2)*y'' + (x-1)*y' - y = 0", ("-1", "1/2", "3/2", "3")),
    # exponentials on a curve
    ("4*x*y'' + 2*y' + y = 0", ("-1", "1")),
    ("4*x*y'' + 2*y' - y = 0", ("-1", "1")),
    ("(1-x^2)*y'' - x*y' + y/9 = 0", ("-2", "0", "2")),
    ("x*(1-x)*y'' + (1/2-x)*y' + y/9 = 0", ("-1", "1/3", "2")),
    ("(x^2-1)*y'' + x*y' + y = 0", ("-2", "0", "2")),
    ("(x^2-x-1)*y'' + (x-1/2)*y' + y = 0", ("-2", "0", "2")),
    ("y'' + 3/16*(x^2+3)/(x^2-1)^2*y = 0", ("-2", "0", "2")),
    # powers, rational logarithms, error and gamma functions
    ("x^2*y'' + x*y' + y = 0", ("-1", "1")),
    ("2*x^2*y'' + 3*x*y' - y = 0", ("-1", "1")),
    ("x^2*(x-1)*y'' + x*y' - y = 0", ("-1", "1/2", "2")),
    ("(1-x^2)*y'' - 2*x*y' + 2*y = 0", ("-2", "0", "2")),
    ("x*y'' + (1/2-x)*y' - y/2 = 0", ("-1", "1")),
    ("2*x*y'' + (1+x)*y' - y = 0", ("-1", "1")),
    ("x*y'' + (1/3-x)*y' - y/3 = 0", ("-1", "1")),
    ("x*y'' + (1/3+x)*y' + y/3 = 0", ("-1", "1")),
    ("x*y'' + (5/3-x)*y' - y = 0", ("-1", "1")),
    # Bessel's functions of a root
    ("4*x^2*y'' + 4*x*y' + (4*x-1)*y = 0", ("-1", "1")),
    ("4*x^2*y'' + 4*x*y' - (4*x+1)*y = 0", ("-1", "1")),
    # a particular solution
    ("x*(x-1)*y'' + 5/2*x*y' + y/2 = x", ("-2", "1/2", "2")),
    ("x^2*y'' + 2*x*y' - 3/4*y = x^3", ("-1", "1")),
]


@parametrize(
    ("equation", "point", "values"),
    [(equation, p, v) for equation, points in EQUATIONS for p, v in product(points, [(1, 0), (-2, 3)])],
    ordinary=(42, 85, 106),
    long=1,
)
def test_the_solution_is_real_where_its_values_are(equation: str, point: str, values: tuple[int, int]) -> None:
    """No i and no complex part near the point; the values, and the equation at a point beside."""
    answer = kovacic.answer_to(equation, ics=f"y({point})={values[0]}, y'({point})={values[1]}")
    value = answer.eq.rhs
    assert not value.has(sympy.I)
    at = sympy.Rational(point)
    assert all(relation.subs(x, at + sympy.Rational(1, 97)) == sympy.true for relation in answer.validity.real)
    for order, given in enumerate(values):
        assert size(value.diff(x, order).subs(x, at) - given, 25) < 1e-20
    a, b, c, f = answer.question.coefficients
    beside = at + sympy.Rational(1, 13)
    residual = a * value.diff(x, 2) + b * value.diff(x) + c * value - f
    assert size(residual.subs(x, beside)) < 1e-15


@pytest.mark.long
@pytest.mark.parametrize("point", [pytest.param("-1", marks=pytest.mark.long), "1/2"])
def test_an_answer_left_of_a_root_has_the_right_slope_everywhere(point: str) -> None:
    """Compared with the proven values of the general route, three points further on."""
    equation = "x*(x-1)*y'' + 7/2*x*y' + y = 0"
    value = kovacic.dsolve(equation, ics=f"y({point})=1, y'({point})=2").rhs
    for step in ("1/10", "1/5", "2/5"):
        at = sympy.Rational(point) + sympy.Rational(step)
        ball = kovacic.evaluate(equation, str(at), x0=point, y0=1, dy0=2, digits=20)
        assert abs(sympy.N(value.subs(x, at), 25) - sympy.Rational(ball.midpoint[0])) < 1e-15


@pytest.mark.parametrize("text", ["y'' + y/(3-x) = x", "y'' + y/(L-x) = 1"])
def test_a_right_hand_side_is_answered_around_an_ordinary_origin(text: str) -> None:
    real = kovacic.answer_to(text).validity.real
    assert all(relation.subs({x: 0, "L": 2}) == sympy.true for relation in real)


def test_a_pair_in_special_functions_is_that_of_solve() -> None:
    found = kovacic.dsolve("y'' + y/(3-x) = 0").rhs
    special = kovacic.solve("y'' + y/(3-x) = 0").special
    assert special is not None
    y1, y2 = special
    assert sympy.expand(found - sympy.symbols("C1") * y1 - sympy.symbols("C2") * y2) == 0


@pytest.mark.parametrize("right", [pytest.param("0", marks=pytest.mark.long), "x"])
def test_the_members_of_a_pair_are_real_on_one_interval(right: str) -> None:
    """(1 - x)^(c-2) beside 2F1(1, 1; c; x), which is real below 1."""
    answer = kovacic.answer_to(f"x*(1-x)*y'' + (c-3*x)*y' - y = {right}")
    assert str(answer.validity).startswith("1 - x > 0, x > 0, ")


def test_letters_have_the_signs_that_are_assumed() -> None:
    """On the left of a positive a, in roots and in logarithms; and between -L and L lies 0."""
    circle = kovacic.dsolve("(x^2-a^2)*y'' + x*y' + y = 0", ics="y(0)=1, y'(0)=0", assume={"a": "positive"})
    assert circle.rhs == sympy.cosh(sympy.asin(x / sympy.Symbol("a")))
    line = kovacic.answer_to("x*(x-a)*y'' + a*y' = 0", ics="y(-1)=1, y(-2)=0", assume={"a": "positive"})
    assert not line.eq.has(sympy.I)
    with pytest.raises(kovacic.InputError, match="between -L, L: 0"):
        kovacic.dsolve("x^2*y'' + x*y' - y = 0", ics="y(-L)=1, y(L)=0", assume={"L": "positive"})
    with pytest.raises(kovacic.InputError, match="between -1, 1: 0"):
        kovacic.dsolve("x*(x-a)*y'' + a*y' = 0", ics="y(-1)=1, y(1)=0")


@pytest.mark.parametrize(
    ("equation", "point"),
    [
        ("x*y'' + (1-x)*y' + n*y = 0", "1"),
        pytest.param("y'' - 2*x*y' + 2*n*y = 0", "1/2", marks=pytest.mark.long),
        ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", "1/2"),
    ],
)
def test_values_hold_for_each_natural_number(equation: str, point: str) -> None:
    """Also where the derivative has a polynomial of degree n - 1."""
    found = kovacic.answer_to(equation, ics=f"y({point})=2, y'({point})=3", assume={"n": "natural"}).eq.rhs
    at = sympy.Rational(point)
    for n in range(4):
        value = found.subs(sympy.Symbol("n"), n)
        assert size(value.subs(x, at) - 2) < 1e-12
        assert size(value.diff(x).subs(x, at) - 3) < 1e-12


@pytest.mark.parametrize(
    "equation",
    [
        "y'' + k*y = 0",
        "y'' - k*y = 0",
        "m*y'' + k*y = 0",
        "x^2*y'' + x*y' + k*y = 0",
        "y'' + k*x*y = 0",
        pytest.param("x*y'' + k*y = 0", marks=pytest.mark.long),
        pytest.param("x^2*y'' + x*y' + (k*x^2 - 1/9)*y = 0", marks=pytest.mark.long),
    ],
)
def test_a_pair_is_real_for_negative_letters(equation: str) -> None:
    """cosh or exponentials for waves, I and K for J and Y, and the real cubic root of k."""
    known = {"k": "negative", "x": "positive"} | ({"m": "positive"} if "m" in equation else {})
    answer = kovacic.answer_to(equation, assume=known, var="x")
    assert sympy.false not in answer.validity.real
    letters = {sympy.Symbol("k"): -2, sympy.Symbol("m"): 3}
    own = answer.eq.lhs.args[0]
    a, b, c, _ = (e.subs(letters) for e in answer.question.coefficients)
    for y in answer.pair:
        value = y.subs(letters).subs(own, x)
        residual = (a * value.diff(x, 2) + b * value.diff(x) + c * value).subs(x, sympy.Rational(7, 10))
        assert size(residual) < 1e-15
        assert abs(sympy.im(sympy.N(value.subs(x, sympy.Rational(7, 10)), 20))) < 1e-18


def test_the_right_hand_side_says_on_which_side_an_answer_is_meant() -> None:
    """Beside log(-x) and sqrt(-x) a pair with log(x), and a particular solution with i*sqrt(x), are real nowhere."""
    for equation in ("x^2*y'' - x*y' + y = x*log(-x)", "x^2*y'' + x*y' - y = sqrt(-x)"):
        answer = kovacic.answer_to(equation)
        value = answer.eq.rhs.subs({"C1": 2, "C2": 3})
        a, b, c, f = answer.question.coefficients
        residual = (a * value.diff(x, 2) + b * value.diff(x) + c * value - f).subs(x, sympy.Rational(-7, 10))
        assert size(residual) < 1e-15
        assert all(relation.subs(x, sympy.Rational(-7, 10)) == sympy.true for relation in answer.validity.real)


@parametrize(("m", "letters"), [("2", "n"), ("m", "nm"), ("1", "n")], ordinary=0, long=(0,))
def test_a_turned_pair_keeps_its_wronskian(m: str, letters: str) -> None:
    """(1 - x^2)^(m/2) beside P_n^m, which is real between -1 and 1; and its W has no special functions of x."""
    equation = f"(1-x^2)*y'' - 2*x*y' + (n*(n+1) - {m}^2/(1-x^2))*y = 0"
    answer = kovacic.answer_to(equation, assume=dict.fromkeys(letters, "natural"))
    assert str(answer.validity) == "1 - x**2 > 0"
    assert not answer.basis.wronskian.has(sympy.hyper, sympy.assoc_legendre)


def test_the_wronskian_of_gauss_functions_is_a_product_of_powers() -> None:
    gauss = kovacic.answer_to("x*(1-x)*y'' + (c-3*x)*y' - y = 0")
    assert gauss.basis.wronskian.subs("c", 5) == 4 * (1 - x) ** 2 / x**5

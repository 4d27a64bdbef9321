"""dsolve with conditions: Sturm-Liouville problems built from their answers, values that are judged by integration, limits."""

from __future__ import annotations

import itertools
import re
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from random import Random
from typing import Any

import pytest
import sympy
from build import parametrize, size
from clocks import controlled
from scipy.integrate import solve_ivp
from sympy import E, Rational, Symbol, cbrt, cos, exp, log, oo, pi, sec, sin, sqrt, tan

import kovacic
from kovacic import dsolve

x, C1, C2 = sympy.symbols("x C1 C2")
y = sympy.Function("y")
D2, D1, D0 = y(x).diff(x, 2), y(x).diff(x), y(x)
n = Symbol("n", integer=True, positive=True)
m = Symbol("m", integer=True, nonnegative=True)
L = Symbol("L", positive=True)
k, a = Symbol("k", positive=True), Symbol("a", positive=True)

#: s(x), and the points where s is 0 and 1.
SCALES = [
    (x, 0, 1),
    (x / L, 0, L),
    ((x + 1) / 2, -1, 1),
    ((x - a) / L, a, a + L),
    (log(x), 1, E),
    (1 / x - 1, 1, Rational(1, 2)),
]
FACTORS = [sympy.Integer(1), exp(-x), x + 3]
#: The eigenvalue's root and the eigenfunction of u'' + w^2 u = 0, and which derivatives vanish at 0 and 1.
PROBLEMS = [
    (n * pi, sin, (0, 0)),
    (n * pi, cos, (1, 1)),
    ((n - Rational(1, 2)) * pi, sin, (0, 1)),
    ((2 * m + 1) * pi / 2, cos, (1, 0)),
]


def slope_at(point: Any) -> Any:
    return D1.subs(x, point)


def equation_of(w: Any, s: Any, g: Any) -> Any:
    """The left side of the equation of y = g(x) u(s(x)) with u'' + w^2 u = 0."""
    u = D0 / g
    first = u.diff(x) / s.diff(x)
    whole = (first.diff(x) / s.diff(x) + w**2 * u) * g * s.diff(x) ** 2
    return sympy.Add(*(sympy.factor(sympy.expand(whole).coeff(d)) * d for d in (D2, D1, D0)))


def condition(order: int, g: Any, point: Any) -> Any:
    """The left side of u = 0 or u' = 0 at a point, with y = g u."""
    if order == 0:
        return y(point)
    rate = sympy.simplify((g.diff(x) / g).subs(x, point))
    return slope_at(point) - rate * y(point)


def numbers(expression: Any, count: int) -> Iterator[dict[Any, Any]]:
    """Values of the symbols beside x and constants, that fit their assumptions."""
    for number in range(1, count + 1):
        values = {n: number, m: number - 1, L: Rational(7, 3) + number, a: Rational(1, 5), k: Rational(11, 7) + number}
        yield {symbol: value for symbol, value in values.items() if symbol in expression.free_symbols}


#: Letters with which a quadratic equation has roots of both signs.
POSITIVE = {"k": "positive", "v": "positive"}


def is_multiple(found: Any, expected: Any, point: Any) -> bool:
    """Is found a constant times expected: the determinant with the slopes vanishes at a point?"""
    total = found * expected.diff(x) - found.diff(x) * expected
    values = (total.subs(v).subs({C1: 2, C2: 3}).subs(x, point.subs(v)) for v in numbers(total, 3))
    return found != 0 and all(size(value, 30) < 1e-20 for value in values)


@parametrize(("s", "left", "right"), SCALES, ids=str, ordinary=0, long=1)
def test_eigenfunctions(s: Any, left: Any, right: Any) -> None:
    """Built from the answer; Dirichlet, Neumann (Robin after a factor) and mixed conditions: one free constant."""
    middle = sympy.sympify(left + (right - left) * Rational(3, 11))
    for g, (w, function, orders) in itertools.product(FACTORS, PROBLEMS):
        if g == x + 3 and s.has(log, 1 / x):
            continue  # longer than it says more
        expected = g * function(w * s)
        ics = {condition(order, g, point): 0 for order, point in zip(orders, (left, right), strict=True)}
        found = dsolve(equation_of(w, s, g), ics=ics).rhs
        assert len(found.free_symbols & {C1, C2}) == 1, (w, s, g)
        assert is_multiple(found, expected, middle), (w, s, g)


@pytest.mark.long
def test_what_has_no_solution_and_what_has_one() -> None:
    """Fredholm: a value at the end of an eigenfunction, a right-hand side with a part along it; and no resonance."""
    oscillator = D2 + n**2 * D0
    with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution"):
        dsolve(oscillator, ics={y(0): 0, y(pi): 1})
    with pytest.raises(kovacic.UnsatisfiableConditions, match=r"no solution.*unless.*where y\(x\) = C2\*sin\(n\*x\)"):
        dsolve(oscillator - 1, ics={y(0): 0, y(pi): 0})
    even, odd = Symbol("n", even=True, positive=True), Symbol("n", odd=True, positive=True)
    assert dsolve(D2 + even**2 * D0 - 1, ics={y(0): 0, y(pi): 0}).rhs.has(C2)
    with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution"):
        dsolve(D2 + odd**2 * D0 - 1, ics={y(0): 0, y(pi): 0})
    assert dsolve(oscillator, ics={y(0): 0, y(pi): 0, slope_at(0): n}).rhs == sin(n * x)
    assert dsolve(D2 + k**2 * D0, ics={y(0): 0, y(pi / k): 0}).rhs == C2 * sin(k * x)
    assert dsolve(D2 + (n - Rational(1, 2)) ** 2 * D0, ics={y(0): 0, y(pi): 0}).rhs == 0
    found = dsolve(D2 + (n - Rational(1, 2)) ** 2 * D0, ics={y(0): 0, y(pi): 1}).rhs
    assert [found.subs({n: j, x: pi}) for j in (1, 2, 3)] == [1, 1, 1]


@pytest.mark.long
def test_particular_values_of_parameters_are_said() -> None:
    w, h = sympy.symbols("w h")
    with pytest.warns(UserWarning, match=r"unless sin\(L\*w\) = 0 and w != 0, where y\(x\) = C2\*sin\(w\*x\)"):
        assert dsolve(D2 + w**2 * D0, ics={y(0): 0, y(L): 0}).rhs == 0
    with pytest.warns(UserWarning, match=r"sin\(L\*w\) = 0 and w != 0, where there is a solution only if h = 0"):
        assert dsolve(D2 + w**2 * D0, ics={y(0): 0, y(L): h}).rhs == h * sin(w * x) / sin(L * w)
    with pytest.warns(UserWarning, match=r"unless h \+ 1 = 0, where y\(x\) = .*x"):
        assert dsolve(D2, ics={slope_at(0): h * y(0), y(1): 0}).rhs == 0
    with pytest.warns(UserWarning, match=r"unless cos\(2\*pi\*w\) - 1 = 0"):
        assert dsolve(D2 + w**2 * D0, ics={y(0): y(2 * pi), slope_at(0): slope_at(2 * pi)}).rhs == 0


@pytest.mark.long
def test_periodic_and_robin_conditions() -> None:
    periodic = {y(0): y(2 * pi), slope_at(0): slope_at(2 * pi)}
    assert dsolve(D2 + n**2 * D0, ics=periodic).rhs == C1 * cos(n * x) + C2 * sin(n * x)
    forced = dsolve(D2 + 2 * D0 - cos(x), ics=periodic).rhs
    assert forced == cos(x)
    antiperiodic = {y(0) + y(pi): 0, slope_at(0) + slope_at(pi): 0}
    assert dsolve(D2 + (2 * m + 1) ** 2 * D0, ics=antiperiodic).rhs.free_symbols >= {C1, C2}
    found = dsolve("y'' - y = 0", ics="y'(0) = 2*y(0), y(1) - 3*y'(1) = 1").rhs
    u = [sympy.N(found.diff(x, order).subs(x, point), 30) for order in (0, 1) for point in (0, 1)]
    assert abs(u[2] - 2 * u[0]) < 1e-25
    assert abs(u[1] - 3 * u[3] - 1) < 1e-25


@pytest.mark.parametrize(
    ("ics", "said"),
    [
        ({y(0): x}, "the variable"),
        ({y(x): 1}, "the variable"),
        ("y(x)=1", "the variable"),
        ({y(0): sympy.zoo}, "value"),
        ({y(0) ** 2: 1}, "linear"),
        ({y(0) * y(1): 1}, "linear"),
        ({y(0): "bounded"}, "ordinary point"),
        ("y(0)=y(0)", "isn't an initial value"),
    ],
)
def test_what_is_no_condition(ics: Any, said: str) -> None:
    with pytest.raises(kovacic.InputError, match=said):
        dsolve(D2 + D0, ics=ics)


# ------------------------------------------------------------------------------------------------- judged by integration

#: Equations a y'' + b y' + c y = f, with floats too, and an interval without singular points.
INTEGRATED = [
    ("1", "0.4", "0.04", "0", (-2, 3)),
    ("1", "0.1", "9.81", "0.5", (0, 3)),
    ("1", "0", "k**2", "sin(x)", (-1, 2)),
    ("x**2", "x", "x**2 - 1/4", "x", (Rational(1, 2), 4)),
    ("x**2", "x", "x**2 - 1/4", "1", (-4, Rational(-1, 2))),
    ("x", "1", "x", "0", (-3, Rational(-1, 4))),
    ("x", "1", "-x", "0", (Rational(1, 4), 3)),
    ("x**2", "3*x", "0.75", "x", (-3, Rational(-1, 3))),
    ("1 - x**2", "-2*x", "6", "0", (1 + Rational(1, 9), 3)),
    ("1 - x**2", "-x", "k**2", "0", (Rational(-4, 5), Rational(4, 5))),
    ("1", "0", "-x", "0", (-2, 1)),
    ("1", "0", "x**2", "0", (-2, 2)),
    ("1", "cot(x)", "2", "0", (Rational(1, 3), 2)),
    ("1", "tan(x)", "cos(x)**2", "0", (-1, 1)),
    ("1", "-3", "2", "exp(x)", (-1, 1)),
    ("1", "0", "1", "1/x", (Rational(1, 2), 3)),
]


@parametrize(("a2", "a1", "a0", "f", "interval"), INTEGRATED, ids=str, ordinary=0, long=(0, 2, 10))
def test_values_are_those_of_an_integration(a2: str, a1: str, a0: str, f: str, interval: tuple[Any, Any]) -> None:
    """Generated points and values: the conditions hold, and between them the solution is that of Dormand and Prince."""
    random = Random(a2 + a1 + a0 + f)
    parts = [sympy.sympify(part, locals={"k": k, "x": x}) for part in (a2, a1, a0, f)]
    left = parts[0] * D2 + parts[1] * D1 + parts[2] * D0 - parts[3]
    low, high = map(sympy.sympify, interval)
    points = [low + (high - low) * Rational(random.randint(1, 9), 10) for _ in range(2)]
    points[1] = points[1] if points[0] != points[1] else (low + high) / 2 + Rational(1, 97)
    u, v = Rational(random.randint(-9, 9), 4), random.choice([0.5, 2, Rational(-2, 3)])
    second = y(points[1]) if random.random() < 0.5 else slope_at(points[1])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = dsolve(left, ics={y(points[0]): u, second: v}).rhs
    assert found.free_symbols <= {x, k}
    values = {k: Rational(17, 10)}
    exact = [found.subs(values), found.diff(x).subs(values)]
    (y0, dy0), (y1, dy1) = ([complex(sympy.N(e.subs(x, point), 20)) for e in exact] for point in points)
    assert abs(y0 - complex(u)) < 1e-9
    assert abs((y1 if second.func == y else dy1) - complex(v)) < 1e-9
    rates = sympy.lambdify(x, [(part / parts[0]).subs(values) for part in parts[1:]], "math")

    def slope(t: float, state: Any) -> list[float]:
        b, c, right = rates(t)
        return [state[1], right - b * state[1] - c * state[0]]

    own = solve_ivp(slope, (float(points[0]), float(points[1])), [y0.real, dy0.real], rtol=1e-10, atol=1e-12)
    assert abs(own.y[0, -1] - y1) < 1e-6 * (1 + abs(y1))
    assert abs(own.y[1, -1] - dy1) < 1e-6 * (1 + abs(dy1))


@parametrize(
    ("text", "values"),
    [
        ("x*y'' + 2*y' = 0", "y(-1)=1, y(1)=0"),
        ("y'' + cot(x)*y' + 2*y = 0", "y(-1)=1, y(1)=0"),
        ("y'' + cot(x)*y' + 2*y = 0", "y(1)=1, y(4)=0"),
        ("x^2*y'' - 2*y = 0", "y(-1)=1, y'(2)=0"),
        ("y'' - 2*y/sin(x)^2 = 0", "y(-1)=1, y(1)=0"),
        ("x*y'' + y' + x*y = 0", "y(-1)=1, y(0)=bounded, y(1)=2"),
        ("(exp(x) - 1)*y'' + y = 0", "y(-1)=1, y(1)=0"),
        ("(exp(x) - 2)*y'' + y = 0", "y(-1)=1, y(1)=0"),
        ("y'' = 1/(exp(2*x) - 3*exp(x) + 2)", "y(-1)=0, y(1/2)=1"),
        ("y'' = tan(3*x)", "y(0)=0, y(1)=1"),
        ("y'' + y = 1/(2*cos(x)^2 + 3*cos(x) - 2)", "y(0)=0, y(3)=1"),
        ("(x-1)^2*y'' - 2*y = 0", "y(0)=1, y(oo)=0"),
        # several waves of one angle, and a pole in roots beside a root of x
        ("y'' - y = 1/(sin(x) + cos(x))", "y(0)=1, y(3)=0"),
        ("y'' - y = 1/(sin(2*x) - sin(x))", "y(1/2)=1, y(2)=0"),
        ("y'' + y = sqrt(x + 2)/(x^3 - x - 1)", "y(0)=1, y(2)=0"),
    ],
    ordinary=3,
    long=3,
    always=[
        ("(exp(x) - 2)*y'' + y = 0", "y(-1)=1, y(1)=0"),
        ("(x-1)^2*y'' - 2*y = 0", "y(0)=1, y(oo)=0"),
        ("y'' - y = 1/(sin(x) + cos(x))", "y(0)=1, y(3)=0"),
    ],
)
def test_two_sides_of_a_singular_point(text: str, values: str) -> None:
    with pytest.raises(kovacic.InputError, match="a singular point of the equation lies between"):
        dsolve(text, ics=values)


@pytest.mark.parametrize(
    "below", [pytest.param("x^sqrt(2) - sqrt(x) - 1", marks=pytest.mark.long), "sin(3*x) + cos(5*x) + 5"]
)
def test_zeros_that_sympy_does_not_know_are_passed_over(below: str) -> None:
    """Of the first it raises an error, and it thinks of the second for minutes."""
    assert dsolve(f"y'' = 1/({below})", ics="y(1/2)=0, y(1)=1").rhs.has(sympy.Integral)


#: Equations with a pole of the coefficients, or of a right-hand side that isn't rational, at a point.
POLES: list[Callable[[Any], Any]] = [
    lambda p: (x - p) ** 2 * D2 - 6 * D0,
    lambda p: (x - p) ** 2 * D2 + (x - p) * D1 - D0,
    lambda p: (x - p) * D2 + 2 * D1 - (x - p) * D0,
    lambda p: D2 - 1 / (x - p) ** 3,
    lambda p: D2 - exp(x) / (x - p) ** 3,
    lambda p: D2 - sec(x - p + pi / 2) ** 2 * tan(x - p + pi / 2),
    lambda p: D2 - cos(x - p) / sin(x - p) ** 3,
]


@parametrize(
    ("equation", "p"), [(equation, p) for equation in POLES for p in (1, sqrt(2), cbrt(5))], ordinary=(0, 15), long=2
)
def test_values_on_two_sides_of_a_pole(equation: Callable[[Any], Any], p: Any) -> None:
    """The pole was found where coefficients were rational, or a logarithm changed its sign."""
    with pytest.raises(kovacic.InputError, match="a singular point of the equation lies between"):
        dsolve(equation(p), ics={y(p - 1): 0, y(p + 1): 1})
    assert dsolve(equation(p), ics={y(p + 1): 0, y(p + 2): 1}).lhs == D0


@parametrize("right", [log(x) / (x - 1), (sqrt(x) + 3) / (x - 9), 1 / (sqrt(x) - 3)], ordinary=(0,))
def test_poles_of_another_right_hand_side(right: Any) -> None:
    """log(x)/(x - 1) has none at 1; 1/(sqrt(x) - 3) is infinite at 9."""
    if right.subs(x, 1) is sympy.nan:
        assert dsolve(D2 - right, ics={y(sympy.S.Half): 0, y(2): 0}).lhs == D0
        return
    with pytest.raises(kovacic.InputError, match="a singular point of the equation lies between"):
        dsolve(D2 - right, ics={y(4): 0, y(16): 0})


# ---------------------------------------------------------------------------------------------------------------- limits


@parametrize(
    ("left", "ics", "expected"),
    [
        (x * D2 + D1 + x * D0, {y(0): 1, slope_at(0): 0}, sympy.besselj(0, x)),
        (x**2 * D2 + x * D1 + (x**2 - n**2) * D0, {y(0): "bounded"}, C1 * sympy.besselj(n, x)),
        (x**2 * D2 - 2 * D0, {y(0): 0}, C2 * x**2),
        (x**2 * D2 - 2 * D0, {y(oo): 0}, C1 / x),
        (x**2 * D2 - 2 * D0, {y(0): "bounded", y(-1): 3}, 3 * x**2),
        (x**2 * D2 + x * D1 - n**2 * D0, {y(0): "bounded", y(1): 1}, x**n),
        (D2 + 2 * D1 / x + D0, {y(0): 1}, sin(x) / x),
        ((1 - x**2) * D2 - 2 * x * D1 + 6 * D0, {y(1): 1, y(-1): "bounded"}, (3 * x**2 - 1) / 2),
        (D2 + sympy.cot(x) * D1 + n * (n + 1) * D0, {y(0): 1}, sympy.legendre(n, cos(x))),
        (x * D2 + (1 - x) * D1 + n * D0, {y(0): 1}, sympy.laguerre(n, x)),
        (D2 - D0, {y(oo): 0, y(0): 1}, exp(-x)),
        (D2 - D0, {y(-oo): 0, y(0): 1}, exp(x)),
        (D2 - D0, {y(oo): "bounded", y(0): 1}, exp(-x)),
        (D2 + D0, {y(oo): 0}, 0),
        (D2 + D0, {y(oo): "bounded"}, C1 * cos(x) + C2 * sin(x)),
        (D2 - k**2 * D0, {y(oo): 0, y(0): a}, a * exp(-k * x)),
        (D2 - x * D0, {y(oo): 0, y(0): 1}, sympy.airyai(x) / sympy.airyai(0)),
        (x * D2 + D1 - x * D0, {y(oo): 0, y(1): 1}, sympy.besselk(0, x) / sympy.besselk(0, 1)),
        (D2 - (x**2 - 1) * D0, {y(oo): 0, y(-oo): 0}, C1 * exp(-(x**2) / 2)),
        (D2 - (x**2 - 2) * D0, {y(oo): 0, y(-oo): 0}, 0),
        (x * D2 + D1 - 1, {y(0): 0}, x),
    ],
    ordinary=2,
    long=10,
    ids=str,
)
def test_limits(left: Any, ics: dict[Any, Any], expected: Any) -> None:
    found = dsolve(left, ics=ics).rhs
    assert sympy.simplify(found - expected) == 0


@parametrize(
    ("text", "ics", "assume", "expected"),
    [
        ("y'' - (x - a)*y = 0", "y(oo)=0", {}, "C1*airyai(-a + x)"),
        ("y'' = (E0 - x)*y", "y(oo)=0", {}, "C1*airyai(E0 - x) + C2*airybi(E0 - x)"),
        ("y'' + (E0 - x)*y = 0", "y(oo)=0", {}, "C1*airyai(-E0 + x)"),
        (
            "y'' + (2/x - 1/n^2)*y = 0",
            "y(0)=0, y(oo)=0",
            {"n": "natural"},
            "C1*x*exp(-x/n)*assoc_laguerre(n - 1, 1, 2*x/n)",
        ),
        ("y'' + (2*m + 1 - x^2)*y = 0", "y(oo)=0", {"m": "natural"}, "C1*exp(-x**2/2)*hermite(m, x)"),
        ("r^2*y'' + r*y' - m^2*y = 0", "y(0)=bounded", {"m": "natural"}, "C1*r**m"),
        ("r^2*y'' + r*y' - m^2*y = 0, y(0) = bounded", None, {"m": "positive"}, "C1*r**m"),
        ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", "y(1)=1", {"n": "natural"}, "legendre(n, x)"),
        ("x^2*y'' + 2*x*y' + (x^2 - n*(n+1))*y = 0", "y(0)=bounded", {"n": "natural"}, "C1*jn(n, x)"),
        (
            "(1-x^2)*y'' - 2*x*y' + 2*a*(2*a+1)*y = 0",
            "y(1)=bounded, y(0)=1",
            {"a": "positive"},
            "-2*x*gamma(1/2 - a)*gamma(a + 1)*hyper((1/2 - a, a + 1), (3/2,), x**2)/(gamma(-a)*gamma(a + 1/2))"
            " + hyper((-a, a + 1/2), (1/2,), x**2)",
        ),
        # U at infinity in an imaginary direction: Coulomb's regular wave function, eta = 1.
        ("y'' + (1 - 2/x)*y = 0", "y(0)=0, y'(0)=1", {}, "x*exp(-I*x)*hyper((1 - I,), (2,), 2*I*x)"),
        # The signs of both roots of a quadratic equation.
        ("y'' - 2*v*y' - k*y = 0", "y(0)=1, y(oo)=0", POSITIVE, "exp(v*x - x*sqrt(k + v**2))"),
        ("y'' - 2*v*y' - k*y = 0", "y(0)=1, y(-oo)=0", POSITIVE, "exp(v*x + x*sqrt(k + v**2))"),
        ("x^2*y'' + (2*v+1)*x*y' - k*y = 0", "y(1)=1, y(oo)=0", POSITIVE, "x**(-v - sqrt(k + v**2))"),
        ("x^2*y'' + (2*v+1)*x*y' - k*y = 0", "y(1)=1, y(0)=0", POSITIVE, "x**(-v + sqrt(k + v**2))"),
    ],
    ordinary=(0,),
    long=(1, 7, 10),
    ids=str,
)
def test_limits_with_letters(text: str, ics: str | None, assume: dict[str, str], expected: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert str(kovacic.dsolve(text, ics=ics, assume=assume).rhs) == expected


@pytest.mark.long
def test_the_decaying_oscillator_for_every_letter() -> None:
    """One formula for all m: even and odd solution with 1/gamma before them, of which one is 0 at each natural m."""
    found = kovacic.dsolve("y'' + (2*m + 1 - x^2)*y = 0", ics="y(oo)=0").rhs
    for m in (-3, -2, -1, 0, 1, 2, 3, Rational(1, 2), Rational(-5, 2)):
        far, near = (abs(sympy.N(found.subs({Symbol("m"): m, x: at, C1: 1}), 40, maxn=2000)) for at in (4, 9))
        assert 0 < near < far / 1000, m


def test_bound_states_are_exceptions_of_the_zero_solution() -> None:
    """1F1(1 - n; 2; 2 x/n) grows as exp(2 x/n)/gamma(1 - n): not for the energies of the hydrogen atom."""
    found = kovacic.answer_to(
        "y'' + 2/x*y' + (2/x - 1/n^2)*y = 0", ics="y(0)=bounded, y(oo)=0", assume={"n": "positive"}
    )
    assert found.eq.rhs == 0
    values = "n - 1 is one of 0, 1, 2, ..."
    assert found.notices == [f"this holds unless {values}: substitute such values for the solutions there"]


def test_a_large_particular_solution_has_a_coefficient() -> None:
    with pytest.raises(kovacic.UnsatisfiableConditions, match=r"unless a = 0, where y\(x\) = 0"):
        dsolve("y'' - y = a*x", ics="y(0)=0, y(oo)=bounded")


@pytest.mark.long
def test_limits_that_cannot_be() -> None:
    """A logarithm in y', a pole, an eigenvalue that isn't one; and a sign that nobody knows is undecided."""
    for text, values in (
        ("y'' + y = 1/x", "y(0)=1, y'(0)=0"),
        ("x^2*y'' - 2*y = 0", "y(0)=1"),
        ("(1-x^2)*y'' - 2*x*y' + 3*y = 0", "y(1)=1, y(-1)=bounded"),
        ("x*y'' + y' = 1/x", "y(0)=0"),
        ("y'' - y = 1", "y(oo)=0"),
        ("y'' - y = x", "y(oo)=0"),
    ):
        with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution"):
            dsolve(text, ics=values)
    with pytest.raises(kovacic.UnsatisfiableConditions, match="unless"):  # P_n is bounded at -1 for an integer n
        dsolve("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", ics="y(1)=1, y(-1)=bounded", assume={"n": "positive"})
    w = Symbol("w", real=True)
    with pytest.raises(NotImplementedError, match=r"the limit of exp\(w\*x\) isn't known"):
        dsolve(D2 - w**2 * D0, ics={y(oo): 0, y(0): 1})
    with pytest.raises(kovacic.InputError, match="given apart"):
        dsolve("x*y'' + y' + x*y = 0", ics="y(0) - y(1) = 0")


@parametrize(
    ("text", "values"),
    [
        ("x^2*y'' + (1-a-b)*x*y' + a*b*y = 0", "y(0)=bounded"),
        ("x*y'' + (c-x)*y' - y = 0", "y(0)=bounded"),
        ("x*(1-x)*y'' + (c-2*x)*y' - y/4 = 0", "y(1)=bounded"),
        ("x*y'' + (c-x)*y' - a*y = 0", "y(0)=bounded"),
        ("x*(1-x)*y'' + (c-(a+b+1)*x)*y' - a*b*y = 0", "y(1)=bounded"),
    ],
    ordinary=(0, 1, 2),
)
def test_a_power_of_zero_with_a_letter_is_no_limit(text: str, values: str) -> None:
    """x^a is bounded at 0 for a >= 0 alone."""
    with pytest.raises(NotImplementedError, match="assumptions may decide it"):
        dsolve(text, ics=values)


# -------------------------------------------------------------------------------------------- zero, rank and what leaves


@pytest.mark.long
def test_entire_solutions_where_bessel_functions_jump() -> None:
    """y'' + c x^m y = 0: the values from the left and from the right agree at 0, for any constants."""
    c = Symbol("c")
    for power in (2, 3, 4):
        found = dsolve(D2 + c * x**power * D0).rhs.subs({c: Rational(3, 2), C1: 2, C2: 5})
        for derivative in (found, found.diff(x)):
            left, right = (sympy.N(derivative.subs(x, sign * Rational(1, 10**9)), 20) for sign in (-1, 1))
            assert abs(left - right) < 1e-7


def test_floats_come_back() -> None:
    """The double root of 0.4 and 0.04; no integers of 16 digits."""
    assert str(dsolve(D2 + 0.4 * D1 + 0.04 * D0).rhs) == "(C1 + C2*x)*exp(-0.2*x)"
    found = dsolve(D2 + 0.1 * D1 + 9.81 * D0, ics={y(0): 0.5, slope_at(0): 0}).rhs
    assert len(str(found)) < 90
    assert found.atoms(sympy.Float)
    assert abs(found.subs(x, 2).evalf() - 0.4523) < 1e-3 or found.subs(x, 0) == 0.5
    assert str(dsolve("y'' + 0.4*y' + 0.04*y = 0").rhs) == "(C1 + C2*x)*exp(-x/5)"


@pytest.mark.slow
def test_long_constants_with_parameters_come_to_an_end() -> None:
    """Determinants that are too long to be factored, and a Wronskian whose terms cancel."""
    g = Symbol("g")
    with pytest.warns(UserWarning, match="unless"):
        assert dsolve(D2 + (x**2 + g) * D0, ics={y(1): y(2), slope_at(1): slope_at(2)}).rhs == 0
    with pytest.raises(kovacic.UnsatisfiableConditions, match=r"no solution.*unless"):
        dsolve(D2 + 2 * x * D1 - x * exp(-x) * sin(x), ics={slope_at(Rational(1, 3)): g + 1, slope_at(-2): 0})
    found = dsolve(x**2 * D2 + 2 * x * D1 - (x**2 * (g + 2) ** 2 + 6) * D0 - 1).rhs
    assert found.has(sympy.Ei)
    assert len(str(found)) < 1500


@pytest.mark.long
def test_numbers_for_integers_are_ones_for_which_the_answer_holds() -> None:
    """At n = 4 the particular solution has a pole; and integrals in integrals, if there are any, have their own variable."""
    even, b = Symbol("n", even=True, positive=True), Symbol("b")
    left = (1 - x**2) * D2 - x * D1 + (even - 2) ** 2 * D0 - x**2
    with pytest.warns(UserWarning, match="unless"):
        found = dsolve(left, ics={y(Rational(1, 5)): 1, slope_at(Rational(1, 3)): -2}).rhs
    assert abs(sympy.N(found.subs({even: 6, x: Rational(1, 5)}), 20) - 1) < 1e-15
    found = dsolve(x * D2 + (b**2 - x) * D1 + D0 - 1 / x, ics={slope_at(Rational(-3, 2)): 1}).rhs
    inner = [e for e in found.atoms(sympy.Integral) if e.function.has(sympy.Integral)]
    assert all(e.limits[0][0] not in e.function.atoms(sympy.Integral).pop().bound_symbols for e in inner)


def test_a_zero_that_the_pair_alone_has_is_no_exception() -> None:
    """sin(sqrt(k)) = 0 at k = 0 as well, where the equation has the solution x with these values."""
    with pytest.warns(UserWarning, match=r"unless sin\(sqrt\(k\)\) = 0 and k != 0, where there is no solution"):
        found = kovacic.dsolve("y'' + k*y = 0", ics="y(0)=0, y(1)=1")
    k = next(symbol for symbol in found.rhs.free_symbols if symbol.name == "k")
    assert sympy.limit(found.rhs, k, 0) == sympy.Symbol("x")
    assert kovacic.dsolve("y'' = 0", ics="y(0)=0, y(1)=1").rhs == sympy.Symbol("x")


@pytest.mark.parametrize(
    ("equation", "ics", "said"),
    [
        pytest.param(
            "y'' + a*y' + b*y = 0",
            "y(0)=0, y(1)=1",
            "sin(sqrt(-a**2 + 4*b)/2) = 0 and a**2 - 4*b != 0, where there is no solution",
            marks=pytest.mark.long,
        ),
        ("y'' + k^2*y = x", "y(0)=0, y'(1)=0", "unless cos(k) = 0, where there is no solution"),
        ("y'' - (a + b)*y' + a*b*y = 0", "y(0)=0, y(1)=1", "exp(a) - exp(b) = 0 and a - b != 0, where there is no"),
        ("y'' + (a - b)*y' = 0", "y(0)=0, y(1)=1", "exp(-a + b) - 1 = 0 and a - b != 0, where there is no solution"),
        ("y'' + k^2*y = 0", "y'(0)=1", "unless k = 0, where y(x) = C1 + x"),
        ("x^2*y'' + a*x*y' = 0", "y'(1)=1", "unless a = 1, where y(x) = C1 + log(x)"),
    ],
)
def test_what_holds_in_exceptional_cases_is_said(equation: str, ics: str, said: str) -> None:
    with pytest.warns(UserWarning, match=re.escape(said)):
        kovacic.dsolve(equation, ics=ics)


@parametrize(
    ("equation", "ics"),
    [
        ("y'' - k^2*y = 0", "y'(1)=0"),
        ("x^2*y'' + x*y' - n^2*y = 0", "y'(1)=0"),
        ("x^2*y'' + 2*x*y' - n*(n+1)*y = 0", "y(R)=1, y(oo)=0"),
    ],
    ordinary=(0,),
)
def test_an_answer_that_holds_in_an_exceptional_case_has_none(equation: str, ics: str) -> None:
    """The row of the condition is zero at k = 0, and the solutions there are C1 all the same."""
    assume = {"n": "natural"} if "n" in equation else None
    assert not kovacic.answer_to(equation, ics=ics, assume=assume).notices


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # whether there are solutions at such values isn't known for the integral
        (
            "y'' + k^2*y = 1/(1+x^4), y(0) = 0, y(L) = 0",
            "sin(L*k) = 0 and k != 0: substitute such values for the solutions there",
        ),
        # an integral from 1 to 3 is divided by sqrt(k - n^2), another has that inside
        (
            "y'' + 2*n*y' + k*y = x^k, y(1) = 0, y(3) = 0",
            "sin(2*sqrt(k - n**2)) = 0 and k - n**2 != 0: substitute such values",
        ),
        # (17/4)^(5/7), for generic values, would have larger numerators
        (
            "(1+a*x)*y'' - q*y' = 0, y(2) = p, y(3) = 0",
            "(2*a + 1)**(1 + q/a) - (3*a + 1)**(1 + q/a) = 0 and a + q != 0, where",
        ),
    ],
)
def test_there_is_an_answer_beside_exceptions_that_are_hard(text: str, said: str) -> None:
    (notice,) = kovacic.answer_to(text).notices
    assert f"unless {said}" in notice


def test_the_answer_is_kept_where_an_exceptional_case_takes_too_long() -> None:
    """At k = 0 the equation is solved once more, in a part of the time that is left."""
    notices: set[str] = set()
    for looks in range(0, 1000, 8):
        with controlled(step=0.001), suppress(NotImplementedError):
            limits = kovacic.Limits(seconds=0.2 + looks / 500)
            notices |= {*kovacic.answer_to("y'' + k^2*y = 0", ics="y'(0)=1", limits=limits).notices}
        if "this holds unless k = 0, where y(x) = C1 + x" in notices:
            break
    assert "this holds unless k = 0: substitute such values for the solutions there" in notices


@parametrize(
    ("ics", "said"),
    [
        ("y(0)=0, y(a)=1", "unless sinh(a*k) = 0 and k != 0, where there is no solution"),
        ("y(b)=0, y(a)=1", "unless sinh(k*(a - b)) = 0 and k != 0, where there is no solution"),
        ("y'(0)=0, y(a)=1", "unless cosh(a*k) = 0, where there is a solution only if k = 0"),
        ("y'(0)=0, y'(a)=1", "unless k*sinh(a*k) = 0:"),
        ("y(0)=1, y'(a)=-h*y(a)", "unless h*sinh(a*k) + k*cosh(a*k) = 0 and k != 0"),
    ],
    ordinary=(0, 3),
)
def test_exceptions_are_in_the_functions_of_the_answer(ics: str, said: str) -> None:
    """What is named is the denominator, up to a factor that is none of these functions."""
    with pytest.warns(UserWarning, match=re.escape(said)):
        found = kovacic.dsolve("y'' - k^2*y = 0", ics=ics).rhs
    _, below = sympy.fraction(sympy.together(found))
    zero = sympy.sympify(said.removeprefix("unless ").partition(" = 0")[0])
    plain = {symbol: sympy.Symbol(symbol.name) for symbol in found.free_symbols}
    assert not sympy.cancel(below.xreplace(plain) / zero).has(sympy.sinh, sympy.cosh)


def test_exceptions_beside_an_answer_in_exponentials_are_in_these() -> None:
    with pytest.warns(UserWarning, match=r"unless exp\(a\*k\) - 1 = 0 and k != 0, where there is no solution"):
        kovacic.dsolve("y'' - 3*k*y' + 2*k^2*y = 0", ics="y(0)=0, y(a)=1")

"""Linear equations of first order and systems of two, built from their solutions, and integrated independently."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path
from typing import Any

import jsonschema
import mpmath
import pytest
import sympy
from build import parametrize, run
from sympy import Heaviside, Rational, asin, atan, cos, exp, log, pi, sin, sqrt, tan

import kovacic

t, x, k, n = sympy.Symbol("t"), sympy.Symbol("x"), sympy.Symbol("k", positive=True), sympy.Symbol("n", positive=True)
y, u, v = map(sympy.Function, "yuv")
VALUES = {k: Rational(7, 5), n: Rational(9, 4)}


def integrated(right: list[Any], unknowns: list[Any], start: Any, values: list[Any], end: Any) -> list[Any]:
    """The solution of unknowns' = right at `end`, by mpmath's Taylor series."""
    variable = unknowns[0].args[0]
    letters = [sympy.Dummy() for _ in unknowns]
    replaced = [e.xreplace(VALUES).xreplace(dict(zip(unknowns, letters, strict=True))) for e in right]
    slopes = sympy.lambdify((variable, letters), replaced, "mpmath")
    with mpmath.workdps(20):
        found = mpmath.odefun(
            slopes, mpmath.mpf(start), [mpmath.mpf(sympy.N(e.xreplace(VALUES), 25)) for e in map(sympy.S, values)]
        )
        return [*found(mpmath.mpf(end))]


def number(e: Any, at: float, variable: Any = x) -> Any:
    return mpmath.mpmathify(sympy.N(e.xreplace(VALUES).subs(variable, Rational(at)), 20))


#: a, b, the point and the value of y' = a y + b: constant and variable coefficients, from textbooks.
LINEAR: list[tuple[Any, Any, int, Any]] = [
    (sympy.S(3), sympy.S(0), 0, 2),
    (-k, x, 0, 1),
    (-k, sin(n * x), 0, 0),
    (-2 * x, sympy.S(1), 0, 1),
    (-1 / x, x**2, 1, 3),
    (n / x, x**2, 1, 1),
    (tan(x), cos(x), 0, 1),
    (-cos(x) / sin(x), 2 * cos(x), 1, 1),
    (-2 * x / (1 + x**2), 1 / (1 + x**2), 0, 1),
    (-1 / x, exp(x) / x, 1, 2),
    (sympy.S(1), exp(x), 0, 0),
    (sympy.S(1), exp(x**2), 0, 1),
    (-sin(x), sin(x), 0, 3),
    (2 / x, x**2 * cos(x), 2, 0),
    (-3 / x, sin(x) / x**3, 1, 0),
    (1 / (x + 1), (x + 1) ** 2, 0, 1),
    (-4 * x / (x**2 + 1), x, 0, 0),
    (-Rational(1, 2) / x, sqrt(x), 1, 1),
    (x, x**3, 0, 2),
    (-exp(x), exp(x), 0, 0),
    (-1 / (x * log(x)), 1 / x, 2, 1),
    (-k, exp(-k * x), 0, 1),
    (-k, cos(k * x), 0, 0),
    (cos(x), cos(x), 0, 1),
    (-2 * tan(x), sin(x), 0, 1),
    (1 / (1 + x**2), sympy.S(0), 0, 2),
    (-1 / (1 + x**2), atan(x) / (1 + x**2), 0, 0),
    (sympy.S(0), log(x), 1, 0),
    (-1, 1 / (2 + cos(x)), 0, 0),
    (-1, 1 / x, 1, 0),
]


@parametrize("problem", LINEAR, ids=str, ordinary=(0, 3, 15, 18), long=(1, 6, 12))
@pytest.mark.filterwarnings("ignore:this holds unless n = 3")
def test_linear_equations_with_values(problem: tuple[Any, Any, int, Any]) -> None:
    a, b, point, value = problem
    found = kovacic.dsolve(sympy.Eq(y(x).diff(x), a * y(x) + b), ics={y(point): value})
    assert found.lhs == y(x)
    assert found.rhs.free_symbols <= {x, k, n}
    wanted = integrated([a * y(x) + b], [y(x)], point, [value], point + 0.75)[0]
    assert abs(number(found.rhs, point + 0.75) - wanted) < 1e-12 * (1 + abs(wanted))


@parametrize("problem", LINEAR, ids=str, ordinary=4, long=6)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_general_solutions_of_linear_equations(problem: tuple[Any, Any, int, Any]) -> None:
    a, b, point, _ = problem
    found = kovacic.dsolve(sympy.Eq(y(x).diff(x), a * y(x) + b)).rhs
    C1 = sympy.Symbol("C1")
    residual = found.diff(x) - a * found - b
    assert found.has(C1)
    assert abs(number(residual.subs(C1, 2).doit(), point + 0.5)) < 1e-12


@pytest.mark.parametrize("side", [-1, 1])
@parametrize(
    ("a", "b", "pole"),
    [
        (1 / x, sympy.S(2), 0),
        (-1 / x, x**-2, 0),
        (-1 / (x - 2), (x - 2) ** -2, 2),
        (1 / (x - 2), x / (x - 2), 2),
        (n / x, sympy.S(1), 0),
        (-x / (x**2 - 4), 1 / (x**2 - 4), 2),
        (Rational(1, 3) / (x + 1), sympy.S(1), -1),
        (-1 / (2 * sqrt(x)), sympy.S(0), 0),
    ],
    ids=str,
    ordinary=4,
    long=4,
)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_values_on_either_side_of_a_pole(a: Any, b: Any, pole: int, side: int) -> None:
    start = pole + side * Rational(1, 2)
    answer = kovacic.answer_to(sympy.Eq(y(x).diff(x), a * y(x) + b), ics={y(start): 3})
    found = answer.eq.rhs
    assert not found.has(sympy.Integral)
    assert abs(number(found, start) - 3) < 1e-15
    if a.subs(x, start).is_real:
        assert answer.validity.claim == "real and valid"
        beyond = start + side * Rational(1, 3)
        assert abs(sympy.im(number(found, beyond))) < 1e-15
        assert abs(number(found.diff(x) - a * found - b, beyond)) < 1e-13


#: q, r, m, the point and the value of y' = q y + r y^m, Bernoulli's equation.
BERNOULLI: list[tuple[Any, Any, Any, int, Any]] = [
    (k, -n, sympy.S(3), 0, Rational(1, 2)),
    (k, -n, sympy.S(3), 0, -1),
    (x, x, sympy.S(3), 0, Rational(1, 2)),
    (-1 / x, x, Rational(1, 2), 1, 4),
    (-1 / x, sympy.S(1), sympy.S(-1), 1, -2),
    (tan(x), cos(x), sympy.S(4), 0, Rational(1, 2)),
    (-k, sympy.S(1), n, 0, Rational(1, 3)),
    (sympy.S(0), k, Rational(2, 3), 0, 1),
]


@pytest.mark.filterwarnings("ignore:this holds unless")
def test_the_power_in_bernoullis_equation_may_be_a_letter() -> None:
    """On the side where u > 0 in w = u^(1/(1 - n)), as `validity` says."""
    answer = kovacic.answer_to("y' = y + y^n")
    u = sympy.sympify("C1*exp(x*(1 - n)) - 1")
    assert answer.eq.rhs == u ** sympy.sympify("1/(1 - n)")
    assert answer.validity.real == (u > 0,)


@parametrize("problem", BERNOULLI, ids=str, ordinary=3)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_bernoulli_equations_with_values(problem: tuple[Any, Any, Any, int, Any]) -> None:
    q, r, m, point, value = problem
    right = q * y(x) + r * y(x) ** m
    found = kovacic.dsolve(sympy.Eq(y(x).diff(x), right), ics={y(point): value}).rhs
    wanted = integrated([right], [y(x)], point, [value], point + 0.25)[0]
    assert abs(number(found, point + 0.25) - wanted) < 1e-12 * (1 + abs(wanted))


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("y' + a*tanh(x)*y = 0", "C1/cosh(x)**a"),
        ("y' + y*tanh(x) = 1", "(C1 + sinh(x))/cosh(x)"),
        ("y' + a*tan(x)*y = 0", "C1*cos(x)**a"),
        ("y' + y*sec(x) = 0", "C1*cos(x)/(sin(x) + 1)"),
        ("y' = x/(1 - x^2)", "C1 - log(1 - x**2)/2"),
        ("y' + y/(1 - x^2) = 0", "C1*sqrt(1 - x)/sqrt(x + 1)"),
        ("(a*x + b)*y' + c*y = 1", "C1/(a*x + b)**(c/a) + 1/c"),
        ("(1 + a*x)*y' = 1, y(0) = 0", "log(a*x + 1)/a"),
        ("(1 - k*x)*y' = 2*y, y(0) = 1", "(-k*x + 1)**(-2/k)"),
        ("y' = x*y + x*y^3, y(0) = 1", "1/sqrt(-1 + 2*exp(-x**2))"),
        ("y' = y/(x*(L - x))", "C1*x**(1/L)/(L - x)**(1/L)"),
        ("y' = b*y/(x - a), y(1) = 2", "2*((a - x)/(a - 1))**b"),
        ("y' = 1/(3 - x)", "C1 - log(3 - x)"),
        ("y' = 1/(x*sqrt(a*x^2 + b))", "C1 - log((1 + sqrt(a*x**2 + b)/sqrt(b))/x)/sqrt(b)"),
        ("y' = (x/a + 1)^(1/3)", "C1 + 3*a*(1 + x/a)**(4/3)/4"),
        ("y' = 1/sqrt(1 - x^2/a^2)", "C1 + sqrt(a**2)*asin(x/sqrt(a**2))"),
        ("y' = asinh(x/a)", "C1 - a*sqrt(1 + x**2/a**2) + x*asinh(x/a)"),
        ("y' = x*asin(x/a)", "C1 - a**2*asin(x/a)/4 + a*x*sqrt(1 - x**2/a**2)/4 + x**2*asin(x/a)/2"),
        ("y' = log(x/a + 1)", "C1 + a*(1 + x/a)*log(1 + x/a) - a*(1 + x/a)"),
        ("y' = x^a*exp(b*x^(2*a + 2))", "C1 + sqrt(pi)*erfi(sqrt(b)*x**(a + 1))/(2*sqrt(b)*(a + 1))"),
        ("(x^2 - 1)*y' + y = 1/(x - 1), y(0) = 0", "x/(1 - x)"),
    ],
)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_what_a_textbook_prints(text: str, printed: str) -> None:
    assert str(kovacic.dsolve(text).rhs) == printed


def test_text_of_first_order() -> None:
    g = sympy.Function("g")
    assert kovacic.dsolve("y' + y = g(x)", "y").rhs.diff(x) == g(x) - kovacic.dsolve("y' + y = g(x)", "y(x)").rhs
    assert kovacic.dsolve("y' = a*y").rhs == sympy.Symbol("C1") * exp(sympy.Symbol("a") * x)
    assert kovacic.dsolve("y' + y = Heaviside(t - 1), y(0) = 0").rhs == (1 - exp(1 - t)) * Heaviside(t - 1)
    assert kovacic.dsolve("y' = y*tan(x)").rhs == sympy.Symbol("C1") / cos(x)


def test_the_general_form_of_coefficients_is_kept() -> None:
    g = sympy.Function("g")
    found = kovacic.dsolve(sympy.Eq(y(x).diff(x), g(x)), y(x), ics={y(0): 1}).rhs
    assert found.diff(x) == g(x)
    assert found.subs(x, 0).doit() == 1
    found = kovacic.dsolve(sympy.Eq(y(x).diff(x), g(x) * y(x)), y(x), ics={y(1): 3}).rhs
    assert str(found) == "3*exp(Integral(g(s), (s, 1, x)))"


def test_the_hint_beside_a_function_without_a_formula() -> None:
    with pytest.raises(kovacic.NotRational) as refused:
        kovacic.dsolve("y'' + a(x)*y = 0")
    assert 'dsolve takes a given function a with func="y(x)"' in str(refused.value)


def test_a_function_without_a_formula_in_a_system_is_refused() -> None:
    with pytest.raises(kovacic.NotRational, match="isn't a rational function of t"):
        kovacic.dsolve("x' = f(t)*x - y, y' = x + f(t)*y")


@parametrize(
    ("equation", "f"),
    product(
        ["y'' = {}", "y'' + y = {}", "y'' + y' = {}", "y' = {}", "y' = {}*y", "y' = {}*y^2"],
        ["atan(x)/x", "sin(x)/x", "(exp(x)-1)/x", "log(1+x)/x", "(1-cos(x))/x^2"],
    ),
    ordinary=8,
    long=(1, 4, 8, 16, 23),
)
def test_values_where_a_coefficient_has_only_a_limit(equation: str, f: str) -> None:
    """One formula, put into the equation and its values, that is real on both sides of 0."""
    answer = kovacic.answer_to(equation.format(f), ics="y(0)=1, y'(0)=1" if "''" in equation else "y(0)=1")
    assert answer.unchecked == ()
    assert answer.validity.claim == "real and valid"
    for side in (-1, 1):
        away_from_poles = {x: Rational(side, 9)}
        relations = [r for r in answer.validity.real if not r.has(sympy.Integral)]
        assert all(relation.subs(away_from_poles) == sympy.true for relation in relations)


def test_values_at_a_singular_point() -> None:
    assert kovacic.dsolve("x*y' = 2*y, y(0) = 0").rhs == sympy.Symbol("C1") * x**2
    with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution with this value at 0, a singular point"):
        kovacic.dsolve("x*y' = 2*y, y(0) = 1")
    for text in ("(x-1)*y' = 1", "y' = y + 1/(x-1)^2"):  # every solution is infinite at 1
        with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution with this value at 1, a singular point"):
            kovacic.dsolve(text, ics="y(1)=2")
    with pytest.raises(NotImplementedError, match="a finite value of the closed form isn't found at 0"):
        kovacic.dsolve("y' = exp(1/x)/x^2", ics="y(0)=1")  # it has this limit from the left alone
    with pytest.raises(kovacic.InputError, match="at most one solution is finite at 0, a singular point"):
        kovacic.dsolve("x*y' + y = sin(x), y(0) = 1")


def test_a_sum_over_roots_has_no_value_where_one_of_its_terms_is_infinite() -> None:
    with pytest.raises(NotImplementedError, match="a finite value of the closed form isn't found at a"):
        kovacic.dsolve("y' = x^(1/3)/(x-a), y(a)=1")


def test_letters_in_denominators_are_named() -> None:
    with pytest.warns(UserWarning, match=r"unless n = 3, where y\(x\) = x\*\*3\*\(C1 \+ log\(x\)\)$"):
        kovacic.dsolve(sympy.Eq(y(x).diff(x), n * y(x) / x + x**2))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("y' + p*y = q*exp(-r*x), y(0) = y0", ["p = r, where y(x) = (q*x + y0)*exp(-r*x)"]),
        ("x' = -k*x, y' = k*x - m*y, x(0) = 1, y(0) = 0", ["k = m, where x(t) = exp(-m*t), y(t) = m*t*exp(-m*t)"]),
        ("x' = k*x, y' = x + c*y, x(0) = 0, y(0) = 1", []),  # x = 0, and what y is divided by isn't there
        ("x' = y, y' = -k^2*x, x(0) = 0, y(0) = 1", ["k = 0, where x(t) = t, y(t) = 1"]),
        # where k = 0 cos(k t) and sin(k t) are dependent, and the answer holds all the same
        ("x' = y, y' = -k^2*x, x(0) = 1, y(1) = 0", ["cos(k) = 0: substitute such values for the solutions there"]),
        ("y' = a*y + b*exp(c*x) + x", ["a = 0 or a - c = 0: substitute such values for the solutions there"]),
    ],
)
def test_what_holds_where_a_denominator_vanishes_is_said(text: str, said: list[str]) -> None:
    assert kovacic.answer_to(text).notices == [f"this holds unless {what}" for what in said]


@pytest.mark.parametrize("text", ["y' = e*y + 1", "y' = y/e + 1", "y' = x*e^2*y + x", "y' = y/(x - e) + 1"])
def test_eulers_number_in_a_coefficient(text: str) -> None:
    """For SymPy e exp(e x) is exp(e x + 1); the integral mixed e with a letter for it."""
    answer = kovacic.answer_to(text)
    assert answer.notices == ["e is Euler's number"]
    w, argument = answer.eq.rhs, answer.eq.lhs.args[0]
    right = sympy.sympify(text.partition(" = ")[2].replace("^", "**"), {"e": sympy.E, "y": w, "x": argument})
    assert sympy.simplify(w.diff(argument) - right) == 0
    assert not kovacic.answer_to("y' = y + e^x").notices
    with pytest.raises(kovacic.InputError, match="e is Euler's number, and no name of a parameter"):
        kovacic.answer_to(text, parameters=["e"])


#: The right-hand sides of u' and v', the point and the values: constant, triangular, diagonal, variable matrices.
SYSTEMS: list[tuple[Any, Any, int, Any, Any]] = [
    (v(t), -u(t), 0, 1, 0),
    (u(t) + 2 * v(t), 3 * u(t) + 2 * v(t), 0, 0, -4),
    (2 * u(t), 3 * v(t), 0, 1, 2),
    (2 * u(t) + v(t), 2 * v(t), 0, 1, 1),
    (2 * u(t), u(t) + 2 * v(t), 0, 1, 2),
    (-k * u(t), k * u(t) - n * v(t), 0, 1, 0),
    (u(t) + v(t) + t, u(t) - v(t), 0, 0, 1),
    (v(t) / t, -t * u(t), 1, 1, 0),
    (u(t) - v(t) + exp(t), u(t) + v(t), 0, 1, 1),
    (t * v(t), u(t), 0, 1, 2),
    (3 * u(t) - 18 * v(t), 2 * u(t) - 9 * v(t), 0, 2, 1),
    (v(t) + sin(t), cos(t) - u(t), 0, 0, 1),
    (-2 * u(t) + v(t) + 2 * exp(-t), u(t) - 2 * v(t) + 3 * t, 0, 1, 0),
    (v(t) * cos(t), -u(t) * cos(t), 0, 1, 0),
    (k * u(t) + n * v(t), n * u(t) + k * v(t), 0, 1, 0),
    (v(t), t * u(t), 0, 1, 0),
    (4 * u(t) - 2 * v(t), u(t) + v(t), 0, 1, 1),
    (-u(t) + v(t), -u(t) - v(t), 0, 1, 0),
    (u(t) - 5 * v(t), u(t) - 3 * v(t), 0, 1, 1),
    (5 * u(t) - v(t), 3 * u(t) + v(t), 0, 2, -1),
    (u(t) - 4 * v(t), 4 * u(t) - 7 * v(t), 0, 3, 2),
    (2 * u(t) - v(t), 3 * u(t) - 2 * v(t) + t, 0, 0, 0),
    (v(t), -2 * u(t) - 3 * v(t) + 1, 0, 0, 0),
    (-v(t) / (1 + t), u(t) / (1 + t), 0, 1, 0),
    (u(t) / t + v(t), v(t) / t, 1, 1, 1),
    (2 * u(t) / t, u(t) + v(t), 1, 1, 0),
    (v(t), u(t) - v(t) / t, 1, 1, 0),
    (-n * v(t), n * u(t), 0, 1, 0),
    (v(t), -sin(t) - u(t), 0, 0, 0),
    (u(t) * tan(t) + v(t), sympy.S(0), 0, 1, 1),
]


@parametrize("problem", SYSTEMS, ids=str, ordinary=(0, 3, 15), long=4)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_systems_with_values(problem: tuple[Any, Any, int, Any, Any]) -> None:
    first, second, start, u0, v0 = problem
    equations = [sympy.Eq(u(t).diff(t), first), sympy.Eq(v(t).diff(t), second)]
    found = kovacic.dsolve(equations, [u(t), v(t)], ics={u(start): u0, v(start): v0})
    assert [e.lhs for e in found] == [u(t), v(t)]
    wanted = integrated([first, second], [u(t), v(t)], start, [u0, v0], start + 0.75)
    for answer, value in zip(found, wanted, strict=True):
        assert answer.rhs.free_symbols <= {t, k, n}
        assert abs(number(answer.rhs, start + 0.75, t) - value) < 1e-12 * (1 + abs(value))


@parametrize("problem", SYSTEMS, ids=str, ordinary=(0, 15, 22), long=2)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_general_solutions_of_systems(problem: tuple[Any, Any, int, Any, Any]) -> None:
    first, second, start, *_ = problem
    equations = [sympy.Eq(u(t).diff(t), first), sympy.Eq(v(t).diff(t), second)]
    found = [e.rhs for e in kovacic.dsolve(equations)]
    constants = sorted((found[0].free_symbols | found[1].free_symbols) - {t, k, n}, key=str)
    assert list(map(str, constants)) == ["C1", "C2"]
    values = dict(zip(constants, (2, -3), strict=True))
    solution = {u(t): found[0].subs(values), v(t): found[1].subs(values)}
    for f, right in ((u(t), first), (v(t), second)):
        residual = solution[f].diff(t) - right.xreplace(solution)
        assert abs(number(residual, start + 0.5, t)) < 1e-12
    fundamental = sympy.Matrix(2, 2, lambda i, j: found[i].diff(constants[j]))
    assert abs(number(fundamental.det(), start + 0.5, t)) > 1e-6


@parametrize(
    ("text", "printed"),
    [
        ("x' = tanh(t)*x + y, y' = x + tanh(t)*y", "(-C1*exp(-t) + C2*exp(t))*cosh(t)"),
        ("x' = tan(t)*x + y, y' = -x + tan(t)*y", "-C1*tan(t) + C2"),
        ("x' = coth(t)*x - y, y' = x + coth(t)*y", "(C1*sin(t) - C2*cos(t))*sinh(t)"),
        ("x' = y + abs(t), y' = -x", "C1*cos(t) + C2*sin(t) + sin(Abs(t)) - Abs(t)"),
    ],
    ordinary=1,
)
def test_the_second_unknown_is_short(text: str, printed: str) -> None:
    assert str(kovacic.dsolve(text)[1].rhs) == printed


@pytest.mark.parametrize("text", ["y' + dirac(x-1)*y = 0", "w' = dirac(x)*w^2, w(-1) = 1"])
def test_an_impulse_times_a_function_that_jumps_there_has_no_value(text: str) -> None:
    with pytest.raises(kovacic.InputError, match=r"an impulse is multiplied by .\(x\), which jumps there"):
        kovacic.dsolve(text)


def test_where_the_solutions_of_a_system_with_letters_are_real_and_independent() -> None:
    found = kovacic.answer_to("x' = a*x + b*y, y' = c*x + d*y")
    said = ("unless b = -(a - d)**2/(4*c), where x(t) = ", "unless b = 0: substitute such values")
    assert any(words in notice for words in said for notice in found.notices)
    assert str(found.validity) == "-a**2 + 2*a*d - 4*b*c - d**2 > 0, b != 0"
    assert str(kovacic.answer_to("x' = y, y' = k*x, x(0) = 1").validity) == "k > 0"
    assert str(kovacic.answer_to("x' = y, y' = k*x, y(0) = 0").validity) == "k >= 0"  # cosh(sqrt(k) t) is left


@pytest.mark.parametrize(
    ("text", "assume", "printed"),
    [
        ("x' = a*y, y' = b*x, x(0) = 1, y(0) = 0", {"a": "positive", "b": "negative"}, "cos(sqrt(a)*t*sqrt(-b))"),
        (
            "t*x' = y, t*y' = a*x",
            {"t": "positive", "a": "negative"},
            "C1*cos(sqrt(-a)*log(t)) + C2*sin(sqrt(-a)*log(t))",
        ),
    ],
)
def test_what_is_assumed_of_the_letters_of_a_system_is_used(text: str, assume: dict[str, str], printed: str) -> None:
    answer = kovacic.answer_to(text, assume=assume)
    assert str(answer.eq[0].rhs) == printed
    assert str(answer.validity) == ""
    assert all(symbol == sympy.Symbol(symbol.name) for eq in answer.eq for symbol in eq.free_symbols)
    with pytest.raises(kovacic.InputError, match="q isn't a parameter"):
        kovacic.answer_to(text, assume={"q": "positive"})


def test_integrals_beside_a_value_begin_at_its_point() -> None:
    w = kovacic.dsolve("y' + tan(x)*y = cos(x)*log(cos(x)), y(0) = 1").rhs
    assert all(len(integral.limits[0]) == 3 for integral in w.atoms(sympy.Integral))
    assert w.subs("x", 0).doit() == 1


def test_derivatives_may_be_mixed() -> None:
    equations = [sympy.Eq(u(t).diff(t) + v(t).diff(t), u(t)), sympy.Eq(u(t).diff(t) - v(t).diff(t), v(t))]
    found = {e.lhs: e.rhs for e in kovacic.dsolve(equations, ics={u(0): 1, v(0): 0})}
    for equation in equations:
        residual = (equation.lhs - equation.rhs).subs(found).doit()
        assert abs(number(residual, 0.5, t)) < 1e-15


def test_values_at_two_points() -> None:
    equations = [sympy.Eq(u(t).diff(t), v(t)), sympy.Eq(v(t).diff(t), -u(t))]
    found = kovacic.dsolve(equations, ics={u(0): 1, v(pi): 2})
    assert found[0].rhs.subs(t, 0) == 1
    assert found[1].rhs.subs(t, pi) == 2
    with pytest.raises(kovacic.UnsatisfiableConditions, match="contradict"):
        kovacic.dsolve(equations, ics={u(0): 1, u(pi): 3})


JUMPING = [
    ("v + {}", "-u"),
    ("v", "-u + {}"),
    ("u + v + {}", "t*Heaviside(t - 2) - u"),
    ("-u + {}", "u - 2*v"),
    ("{} - v", "u - v"),
]
JUMPS = ["Heaviside(t - 1)", "Piecewise((1, t < 1), (0, True))", "abs(t - 1)"]


@parametrize(
    ("system", "jump"),
    product(JUMPING, JUMPS),
    ordinary=(12,),
    long=2,
)
def test_the_unknowns_of_a_system_are_continuous_at_jumps(system: tuple[str, str], jump: str) -> None:
    first, second = system
    found = kovacic.dsolve(f"u' = {first.format(jump)}, v' = {second.format(jump)}, u(0) = 1, v(0) = 0")
    solution = {e.lhs: e.rhs for e in found}
    near = Rational(1, 10**9)
    for e in solution.values():
        assert not e.has(sympy.DiracDelta)
        assert all(abs(number(e, a - near, t) - number(e, a + near, t)) < 1e-7 for a in (1, 2))
    names = {"u": u(t), "v": v(t), "t": t}
    for f, right in ((u(t), first), (v(t), second)):
        wanted = sympy.sympify(right.format(jump.replace("abs", "Abs")), locals=names).xreplace(solution)
        for point in (0.5, 1.5, 2.5):
            assert abs(number(solution[f].diff(t) - wanted, point, t)) < 1e-12


@pytest.mark.long
def test_given_functions_in_a_system() -> None:
    g = sympy.Function("g")
    found = {e.lhs: e.rhs for e in kovacic.dsolve("u' = v + g(t), v' = -u, u(0) = 0, v(0) = 0")}
    solution = {f: e.xreplace({g(z): exp(z) for z in (t, sympy.Symbol("s"))}).doit() for f, e in found.items()}
    assert sympy.simplify(solution[u(t)].diff(t) - solution[v(t)] - exp(t)) == 0
    assert sympy.simplify(solution[v(t)].diff(t) + solution[u(t)]) == 0


@parametrize(
    ("matrix", "f"),
    product(
        [(0, 1, -1, 0), (1, 1, 1, -1), (3, -4, 1, -1), (2, -1, 1, 2), (0, 1, -2, -3), (1, 0, 2, 1)],
        ["cos(t)", "sin(t) + 1", "exp(t)", "t*exp(2*t)", "1/t"],
    ),
    ordinary=10,
    long=8,  # each matrix, each f
)
def test_free_constants_stand_in_terms_of_their_own(matrix: tuple[int, ...], f: str) -> None:
    """C1 and C2 are 0 in each term that has them, for none is collected with numbers."""
    a, b, c, d = matrix
    names = dict.fromkeys(sympy.symbols("C1 C2"), 0)
    for solution in kovacic.dsolve(f"x' = {a}*x + {b}*y, y' = {c}*x + {d}*y + {f}"):
        terms = sympy.Add.make_args(solution.rhs)
        assert solution.rhs.has(*names)
        assert all(term.subs(names) == 0 for term in terms if term.has(*names))


def test_the_second_unknown_of_a_forced_oscillator() -> None:
    _, y = kovacic.dsolve("x' = y, y' = -x + cos(t)")
    assert str(y.rhs) == "-C1*sin(t) + C2*cos(t) + t*cos(t)/2 + sin(t)/2"


def test_what_is_no_such_system_is_refused() -> None:
    first = sympy.Eq(u(t).diff(t), v(t))
    with pytest.raises(kovacic.InputError, match="3 equations"):
        kovacic.dsolve([first, first, first])
    with pytest.raises(kovacic.InputError, match="isn't linear"):
        kovacic.dsolve([first, sympy.Eq(v(t).diff(t), v(t) ** 2)])
    with pytest.raises(kovacic.InputError, match="of first order is expected"):
        kovacic.dsolve([sympy.Eq(u(t).diff(t, 2), v(t)), sympy.Eq(v(t).diff(t), u(t))])
    with pytest.raises(kovacic.InputError, match="'k = 2' contains no derivative"):
        kovacic.dsolve("y'' + k^2*y = 0, k = 2")
    with pytest.raises(kovacic.InputError, match="don't determine both derivatives"):
        kovacic.dsolve([first, sympy.Eq(u(t).diff(t), v(t) + u(t))], [u(t), v(t)])


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("u' = v, v' = -u", marks=pytest.mark.long),
        "u' = v + g(t), v' = -u, u(0) = 0, v(0) = 1",
        "y' = -2*y + t",
    ],
)
@pytest.mark.filterwarnings("ignore:the answer could not be verified")
def test_json_of_systems_and_of_first_order_follows_the_schema(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "--json", text]) == 0
    data = json.loads(capsys.readouterr().out)
    jsonschema.validate(data, json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text("utf-8")))
    assert (data["unknown"] == ["u(t)", "v(t)"]) == ("v'" in text)


def test_an_answer_to_a_system_says_where_it_is_valid() -> None:
    answer = kovacic.answer_to("u' = v/t, v' = -u/t, u(1) = 0, v(1) = 1")
    assert str(answer) == "u(t) = sin(log(t))\nv(t) = cos(log(t))"
    assert answer.eq == kovacic.dsolve("u' = v/t, v' = -u/t, u(1) = 0, v(1) = 1")
    assert str(answer.validity) == "t > 0"
    _, v = kovacic.dsolve("u' = v + exp(t^3), v' = u, u(0) = 0, v(0) = 0")  # integrands cancel in u' - exp(t^3)
    assert not v.rhs.subs(dict.fromkeys(v.rhs.atoms(sympy.Integral), 0)).has(sympy.Symbol("t") ** 2)


def test_a_step_whose_side_depends_on_a_sign_is_no_step_at_its_place() -> None:
    """H(k x - 1) is H(x - 1/k) for k > 0 alone: an answer, if there is one, satisfies the equation for both signs."""
    x, k = sympy.Symbol("x"), sympy.Symbol("k", real=True, nonzero=True)
    y = sympy.Function("y")
    step = sympy.Heaviside(k * x - 1)
    for rate, right in ((sympy.Integer(-1), step), (step, sympy.Integer(0))):
        try:
            w = kovacic.dsolve(y(x).diff(x) - rate * y(x) - right, y(x)).rhs
        except NotImplementedError:
            continue
        miss = w.diff(x) / w - rate - right / w
        for sign in (1, -1):
            for point in (-3, Rational(1, 2), 3):
                assert sympy.simplify(miss.subs({k: sign, "C1": 2}).subs(x, point)) == 0


@pytest.mark.parametrize(("text", "value"), [("cos(x)*y' + sin(x)*y = 1", 1), ("y' + tan(x)*y = sec(x), y(0) = 1", 1)])
def test_a_tangent_does_not_stay_beside_its_cosine(text: str, value: int) -> None:
    """C cos(x) + sin(x) has a value at pi/2."""
    assert kovacic.dsolve(text).rhs.subs("x", pi / 2) == value


def test_a_system_with_an_impulse_is_written_as_one_wave() -> None:
    found, _ = kovacic.dsolve("x' = y, y' = -x + DiracDelta(t-a)", ics="x(0)=0, y(0)=0")
    t, a = sympy.symbols("t a")
    response = found.rhs.expand().coeff(Heaviside(t - a))
    assert sympy.count_ops(response) <= sympy.count_ops(-sin(a - t))
    assert sympy.simplify(response - sin(t - a)) == 0


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("(1 - x^2)*y' - x*y = 1, y(0) = 0", asin(x) / sqrt(1 - x**2)),
        pytest.param("(4 - x^2)*y' + x*y = 1, y(1) = 0", x / 4 - sqrt(3) * sqrt(4 - x**2) / 12, marks=pytest.mark.long),
        ("x*y' + y/2 = x, y(-1) = 0", 2 * x / 3 + 2 / (3 * sqrt(-x))),
        pytest.param(
            "(x^2 - 4)*y' + y = 1/(x - 2), y(0) = 0",
            (x - 1) / (6 - 3 * x) + sympy.root((x + 2) / (2 - x), 4) / 6,
            marks=pytest.mark.long,
        ),
    ],
)
def test_a_solution_is_real_on_the_side_of_its_value(text: str, wanted: Any) -> None:
    found = kovacic.dsolve(text).rhs
    assert not found.has(sympy.I)
    for point in (Rational(-2, 3), Rational(-1, 5)):
        assert abs(number(found - wanted, point)) < 1e-18


def test_hyperbolic_coefficients_have_no_logarithm_of_an_exponential() -> None:
    found = kovacic.dsolve("y' + y*tanh(x) = exp(x), y(0) = 0").rhs
    wanted = (x + exp(2 * x) / 2 - Rational(1, 2)) / (exp(x) + exp(-x))
    assert not found.has(log, sqrt(2))
    for point in (-2, Rational(1, 3), 3):
        assert abs(number(found - wanted, point)) < 1e-15


def test_the_only_finite_solution_at_a_singular_point() -> None:
    assert kovacic.dsolve("x*y' + y = x, y(0) = 0").rhs == x / 2
    with pytest.raises(kovacic.InputError, match="at most one solution is finite"):
        kovacic.dsolve("x*y' + y = x, y(0) = 1")


@pytest.mark.parametrize("power", ["1/2", "2/3", "3/4"])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_power_without_a_root_is_a_solution_on_one_side_alone(power: str, side: int) -> None:
    """w = u^k, which is emptied where u is zero, as in Torricelli's law: w^(1/k) is u for u >= 0."""
    answer = kovacic.answer_to(f"y' = {side}*y^({power}), y(0) = 1")
    w = answer.eq.rhs
    assert answer.validity.real
    for at in (-40, -1, 0, 1, 40):
        residual = (w.diff(x) - side * w ** Rational(power)).subs(x, at)
        holds = all(relation.subs(x, at) == sympy.true for relation in answer.validity.real)
        assert holds == (residual == 0), at
    assert holds == (side == 1)


@pytest.mark.parametrize(
    ("text", "assume", "printed"),
    [
        ("y' = y - y^m", {"m": "positive"}, "(C1*exp(x*(1 - m)) + 1)**(1/(1 - m))"),
        ("y' = y, y(a) = 1", {"a": "positive"}, "exp(-a + x)"),
    ],
)
def test_something_may_be_assumed_of_an_exponent_and_of_a_point(
    text: str, assume: dict[str, str], printed: str
) -> None:
    assert str(kovacic.answer_to(text, assume=assume).eq.rhs) == printed


def test_bernoulli_through_any_value() -> None:
    """The logistic equation: its formula doesn't divide by the value, and names no exception."""
    r, K, P = sympy.symbols("r K P")
    found = kovacic.dsolve("y' = r*y*(1 - y/K), y(0) = P").rhs
    assert sympy.simplify(found - K * P / (P + (K - P) * exp(-r * x))) == 0
    assert found.subs(P, 0) == 0


def test_a_right_hand_side_with_endlessly_many_corners_stays_in_the_integral() -> None:
    found = kovacic.dsolve("y' + y = abs(sin(x)), y(0) = 1").rhs
    s = sympy.Symbol("s")
    assert found.subs(x, 0).doit() == 1
    assert sympy.simplify(found.diff(x) + found - sympy.Abs(sin(x))) == 0
    assert sympy.Integral(exp(s) * sympy.Abs(sin(s)), (s, 0, x)) in {
        sympy.Integral(*e.args) for e in found.atoms(sympy.Integral)
    }


@pytest.mark.parametrize(("k", "v"), [(2, 4), (3, 8), (4, 1)])
def test_a_root_of_the_unknown_is_at_least_zero_wherever_its_solution_is_said_to_hold(k: int, v: int) -> None:
    """w' = w^(1 - 1/k) has the solution (v^(1/k) + x/k)^k, where v^(1/k) + x/k >= 0 only."""
    solution = kovacic.dsolve(f"y' = y^({k - 1}/{k})", ics=f"y(0)={v}")
    (needed,) = kovacic.validity(solution).real
    root = sympy.root(v, k)
    assert [needed.subs(x, -k * root + side) for side in (1, -1)] == [True, False]
    with pytest.raises(kovacic.UnsatisfiableConditions, match=r"no real solution with y\(0\) = -1"):
        kovacic.dsolve(f"y' = y^({k - 1}/{k}), y(0) = -1")


@pytest.mark.parametrize(("a", "m", "v"), [(0, 2, 0), (1, 2, -3), (0, 3, 2)])
def test_all_solutions_may_tend_to_one_value_at_an_irregular_point(a: int, m: int, v: int) -> None:
    """(x - a)^m y' = y - v: all y = v + C exp(-1/((m - 1) (x - a)^(m - 1))) tend to v from the right."""
    equation = f"(x-({a}))^{m}*y' = y - ({v})"
    wanted = v + sympy.Symbol("C1") * sympy.exp(-1 / sympy.Integer(m - 1) / (x - a) ** (m - 1))
    assert sympy.simplify(kovacic.dsolve(equation, ics=f"y({a})={v}").rhs - wanted) == 0
    with pytest.raises(kovacic.UnsatisfiableConditions, match=f"no solution with this value at {a}"):
        kovacic.dsolve(equation, ics=f"y({a})={v + 1}")

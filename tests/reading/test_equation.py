"""Equations as users have them: reading, the normal form and the gauge, refusals."""

from __future__ import annotations

import contextlib
import json
import pickle
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import strategies
import sympy
from build import QQ, Equation, RatFunc, generated, parametrize, read_input
from hypothesis import given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import InputError, NotLinear, NotRational, ParseError

X = RatFunc(QQ.poly([0, 1]))
ZERO = X * 0
x = sympy.Symbol("x")
y = sympy.Function("y")


def bessel(order: Fraction) -> Equation:
    return Equation(X**2, X, X**2 - order**2, ZERO)


@pytest.mark.parametrize(
    "text",
    [
        "x^2*y'' + x*y' + (x^2-1/4)*y = 0",
        "x^2*y'' + x*y' = -(x^2-1/4)*y",
        "x^2 y'' + x y' + (x^2 - 1/4) y",
        "x**2*y''(x) + x*y'(x) + (x**2 - 1/4)*y(x) = 0",
        "x^2*diff(y,x,2) + x*diff(y,x) + (x^2-1/4)*y = 0",
        "x^2*diff(y(x),(x,2)) + x*diff(y(x),x) + (x^2-1/4)*y(x) = 0",
        "x^2*Derivative(y(x), (x, 2)) + x*Derivative(y(x), x) + (x^2-1/4)*y(x) = 0",
        "x^2*Derivative(y(x), x, x) + x*Derivative(y(x), x) + (x^2-1/4)*y(x)",
        "x*diff(x*diff(y, x), x) + (x^2 - 1/4)*y = 0",
        "x²y″ + x y′ + (x² − 1/4)·y = 0",
    ],
)
def test_one_equation_in_many_notations(text: str) -> None:
    parsed = read_input(text)
    assert parsed.equation == bessel(Fraction(1, 2))
    assert parsed.notices == ()


@pytest.mark.parametrize(
    ("text", "variable", "unknown"),
    [
        ("w'' = t w", "t", "w"),
        ("u''(s) + u(s) = 0", "s", "u"),
        ("diff(f(z), z, 2) = z*f(z)", "z", "f"),
        ("diff(q, t, t) + q = 0", "t", "q"),
        ("y'' = y", "x", "y"),
        ("y'' + k^2*y(x) = 0", "x", "y"),
        ("n*(n+1)*y + diff((1-x^2)*diff(y,x),x) = 0", "x", "y"),
    ],
)
def test_names_are_found(text: str, variable: str, unknown: str) -> None:
    equation = read_input(text).equation
    assert (equation.variable, equation.unknown) == (variable, unknown)


def test_the_names_can_be_given() -> None:
    parsed = read_input("y'' + k^2*y = 0", var="x")
    assert (parsed.equation.variable, len(parsed.notices)) == ("x", 1)
    parsed = read_input("y'' + k^2*y = 0", var="k")
    assert parsed.equation.c == X**2
    assert not parsed.notices


@pytest.mark.parametrize(
    ("right", "f", "h"),
    [
        ("x^2 + 1/x", X**2 + 1 / X, None),
        ("exp(x)", ZERO, sympy.exp(x)),
        ("x^2 + 3*exp(-x)*sin(2x)", X**2, 3 * sympy.exp(-x) * sympy.sin(2 * x)),
        ("1/cos(x)", ZERO, 1 / sympy.cos(x)),
        ("e^x", ZERO, sympy.exp(x)),
        ("sqrt(x) + x^(1/3)", ZERO, sympy.sqrt(x) + sympy.cbrt(x)),
        ("ln(x)^2", ZERO, sympy.log(x) ** 2),
        ("pi*x", ZERO, sympy.pi * x),
    ],
)
def test_right_hand_sides(right: str, f: RatFunc, h: sympy.Expr | None) -> None:
    for text in (f"y'' + y = {right}", f"y'' + y - ({right})", f"{right} = y + y''"):
        equation = read_input(text).equation
        assert equation.f == f
        assert equation.h == h
        assert equation.c == 1


@pytest.mark.parametrize(
    ("text", "kind", "message", "position"),
    [
        ("y''*y = 1", NotLinear, "product", 0),
        ("x + y'*y'' = 0", NotLinear, "product", 4),
        ("y'' + y^2 = 0", NotLinear, "power", 6),
        ("y'' + 1/y = 0", NotLinear, "denominator", 6),
        ("y'' + sin(y) = 0", NotLinear, "within a function", 6),
        ("y' = y", NotLinear, "order 1", 0),
        ("y''' = y", NotLinear, "order 3", 0),
        ("x = 3", NotLinear, "no derivative", 0),
        ("y'' - y'' = y", NotLinear, "no derivative", 0),
        ("exp(x)*y'' = y", NotRational, "coefficient", 0),
        ("y'' + w' = 0", NotLinear, "derivative of something else", 6),
        ("y''(t) + y(x) = 0", NotLinear, "different arguments", 9),
        ("diff(y, z) + x*y'' + diff(y, x) = 0", NotLinear, "something else", 21),
        ("diff(y, x, 1/2) = 0", NotLinear, "order of a derivative", 0),
        ("diff(diff(y, x, 60), x, 60) = 0", NotLinear, "order 101, above the limit of 100", 0),
        ("diff(1/x, x, 10^9)*y'' = y", NotLinear, "order 1000000000, above the limit", 0),
        ("(((D^10)^10)^10)^10 y = 0", NotLinear, "order 101, above the limit of 100", 1),
        ("D^11 y = 0", NotLinear, "order 11", 0),
        ("x(x) y'' = y", ParseError, "followed by a parenthesis", 0),
        ("y'' = y = 0", ParseError, "doesn't belong here", 8),
        ("y'' + = 0", ParseError, "missing", 4),
        ("y'' + y/0 = 0", NotRational, "zero", 8),
        ("y'' = (0*sin(x))^-2", NotRational, "0 has no powers", 6),
        ("y'' = abcd*y", ParseError, "abcd is a word that isn't known here", 6),
        ("y''(theta) = y*dtheta", ParseError, "write y' or dy/dtheta for a derivative", 15),
        ("y'' + r^2*y + tau^2*y' + tau*y = 0", InputError, "r, tau: which is the variable?", 14),
        ("y'' = ln^-1(x)*y", ParseError, "write 1/ln(x) for the reciprocal", 6),
        (r"y'' = \sin^{n+1} x", NotRational, "without its parentheses", 6),
        ("y'' = e^-2.5t y", ParseError, "write e^(-2.5*t) or e^(-2.5)*t", 6),
        ("y'' = (x, 3)*y", ParseError, "values, y(0) = 1, are for dsolve", 8),
        (".diff(y, x) = x*y", ParseError, "unexpected character '.'", 0),
        ("y.diff + x*y = 0", ParseError, "unexpected character '.'", 1),
        ("y'' = x.(y)", ParseError, "unexpected character '.'", 7),
        ("dsolve()", ParseError, "there is no expression", 0),
        ("dsolve(y'' = y) = 0", ParseError, "'=' doesn't belong here", 11),
        ("dsolve(y'' = y, numeric)", ParseError, "numeric isn't read in dsolve", 16),
        ("dsolve(y'' = y, z(t))", ParseError, "z(t) isn't read in dsolve", 16),
        ("desolve(y'' = y, ics=[0, 3, 2])", ParseError, "isn't read in desolve", 17),
        ("desolve(y'' = y, y, ics=[0, 3, , 2])", ParseError, "isn't read in desolve", 20),
        ("desolve(y'' = y, y, ics=[0, 3, 2, 5])", ParseError, "isn't read in desolve", 20),
    ],
)
def test_refusals_have_a_place(text: str, kind: type, message: str, position: int) -> None:
    with pytest.raises(kind) as caught:
        read_input(text)
    assert message in str(caught.value)
    assert caught.value.position == position


@pytest.mark.long
@given(strategies.rational_functions(), strategies.rational_functions(), strategies.rational_functions())
@generated(10)
def test_text_of_an_equation_reads_back(a: RatFunc, b: RatFunc, c: RatFunc) -> None:
    equation = Equation(a, b, c, b * c)
    assert read_input(str(equation)).equation == equation
    assert read_input(equation.text(caret=False)).equation == equation


@pytest.mark.long
@given(strategies.rational_functions(), strategies.rational_functions(), strategies.rational_functions())
@generated(8)
def test_sympy_equations_read_like_text(a: RatFunc, b: RatFunc, c: RatFunc) -> None:
    equation = Equation(a, b, c, ZERO)
    A, B, C = (sympy.sympify(value.to_str()) for value in (a, b, c))
    expression = A * y(x).diff(x, 2) + B * y(x).diff(x) + C * y(x)
    for given_form in (expression, sympy.Eq(A * y(x).diff(x, 2), -B * y(x).diff(x) - C * y(x))):
        assert read_input(given_form).equation == equation


@given(strategies.rational_functions(), strategies.rational_functions())
@settings(max_examples=8)
def test_the_normal_form_in_two_ways(p: RatFunc, gamma: RatFunc) -> None:
    """y = v exp(int gamma) satisfies y'' - 2 gamma y' + (gamma^2 - gamma' - S) y = 0 when v'' = S v."""
    equation = Equation(p, -2 * gamma * p, (gamma * gamma - gamma.derivative() - gamma) * p, ZERO)
    assert equation.S == gamma
    assert equation.gauge == gamma


def test_solve_takes_equations_in_every_form() -> None:
    expected = kovacic.solve("x^2*y'' + x*y' + (x^2-1/4)*y = 0")
    assert (expected.case, str(expected.S), str(expected.gauge)) == (1, "-1", "-1/(2*x)")
    quarter = sympy.Rational(1, 4)
    forms = [
        x**2 * y(x).diff(x, 2) + x * y(x).diff(x) + (x**2 - quarter) * y(x),
        sympy.Eq(x**2 * y(x).diff(x, 2) + x * y(x).diff(x), (quarter - x**2) * y(x)),
        expected.equation,
    ]
    for form in forms:
        assert kovacic.solve(form).equation == expected.equation
    assert kovacic.solve(a="x^2", b="x", c="x^2 - 1/4").equation == expected.equation
    assert kovacic.solve(a=x**2, b=x, c=x**2 - quarter).equation == expected.equation
    assert kovacic.solve(a=X**2, b=X, c=X**2 - Fraction(1, 4)).equation == expected.equation
    assert kovacic.solve(a=1, c="x").equation.text() == "y'' + x*y = 0"


def test_a_symbol_with_assumptions() -> None:
    t = sympy.Symbol("t", positive=True)
    assert kovacic.solve(sympy.Eq(y(t).diff(t, 2), t * y(t))).variable == "t"


@pytest.mark.parametrize(
    "expression",
    [
        y(x).diff(x) ** 2 + y(x).diff(x, 2),
        y(x).diff(x, 2) + sympy.exp(y(x)),
        y(x).diff(x, 2) + sympy.Function("z")(x).diff(x),
        y(x).diff(x) - y(x),
        y(x).diff(x, 2) + y(2 * x),
        y(x).diff(x, 2) + sympy.Derivative(y(x), sympy.Symbol("t")),
        sympy.Eq(y(2 * x), 3),
    ],
    ids=str,
)
def test_sympy_equations_that_are_not_linear(expression: sympy.Expr) -> None:
    with pytest.raises(NotLinear):
        kovacic.solve(expression)


def test_a_coefficient_of_sympy_that_is_not_rational() -> None:
    with pytest.raises(NotRational, match="coefficient"):
        kovacic.solve(sympy.log(x) * y(x).diff(x, 2) + y(x))


@pytest.mark.parametrize("a", [sympy.true, sympy.Eq(x, 3), sympy.Matrix([x])], ids=str)
def test_a_coefficient_is_a_function(a: Any) -> None:
    with pytest.raises(InputError, match="is a function of the variable, not "):
        kovacic.solve(a=a, b=x, c=3)


@pytest.mark.parametrize(
    ("name", "said"), [("2a", "can't be the name"), ("pi", "is a number"), (3, "can't be the name")]
)
def test_what_cannot_be_declared(name: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        kovacic.solve("a*x", parameters=["a", name])


def test_an_equation_or_coefficients_but_not_both() -> None:
    with pytest.raises(InputError, match="one equation"):
        kovacic.solve("x", a="x")
    with pytest.raises(InputError, match="one equation"):
        kovacic.solve()


def test_an_answer_with_an_equation_pickles() -> None:
    answer = kovacic.solve("y'' + y = exp(x)")
    assert pickle.loads(pickle.dumps(answer)) == answer


def test_an_equation_of_lower_order_is_no_equation() -> None:
    with pytest.raises(ValueError, match="second derivative"):
        Equation(ZERO, X, X, X)


def test_constants_and_parameters_in_equations() -> None:
    answer = kovacic.solve("y'' = sqrt(2)*y")
    assert str(answer.S) == "sqrt(2)"
    normal = kovacic.solve("y'' + 2*sqrt(2)*y' + y = 0")
    assert str(normal.S) == "1"
    assert normal.S.field == QQ


@pytest.mark.long
@given(st.text(alphabet="xy'=+-*/^() 0123diff,", max_size=30))
@generated(40)
def test_garbage_is_refused_with_an_input_error(text: str) -> None:
    with contextlib.suppress(kovacic.InputError, kovacic.LimitExceeded):
        read_input(text)


@pytest.mark.parametrize(
    "text",
    [
        "x^2*y'' + x*y' + (x^2-1/4)*y = 0",
        "w'' + w = tan(t)^2 + t",
        "y'' + 2*sqrt(2)*y' + y = 0",
        "y'' + n^2*y'/x + y(x) = 0",
        "y'' = sqrt(2)*x*y",
    ],
)
def test_equations_in_json(text: str) -> None:
    answer = kovacic.solve(text)
    assert kovacic.Solution.from_json(answer.to_json()) == answer


def test_the_full_json_has_group_and_solutions() -> None:
    data = json.loads(kovacic.solve("x^2*y'' + x*y' + (x^2-1/4)*y = 0").to_json(full=True))
    assert data["group"] == {"name": "G_m", "order": None, "finite": False, "family": "multiplicative", "n": None}
    assert data["gauge"] == "-1/(2*x)"
    assert [sympy.sympify(s) for s in data["solutions"]] == [sympy.cos(x) / sympy.sqrt(x), sympy.sin(x) / sympy.sqrt(x)]
    schema = json.loads((Path(kovacic.__file__).parent / "views" / "schema.json").read_text("utf-8"))
    jsonschema.validate(data, schema)
    assert json.loads(kovacic.solve("x").to_json(full=True))["solutions"] is None


@pytest.mark.long
def test_reading_an_equation_as_text_doesn_t_import_sympy() -> None:
    code = "import sys, kovacic; kovacic.solve(\"x*y'' + y' + x*y = 0\").group; print('sympy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_E_is_the_energy_and_not_the_base_of_the_exponential_function() -> None:
    schroedinger = kovacic.solve("-y'' + x^2*y = E*y")
    assert schroedinger.S.to_str("x") == "x**2 - E"
    assert any("energy" in notice for notice in schroedinger.notices)
    with pytest.raises(kovacic.NotLinear, match=r"write exp"):
        kovacic.solve("y'' - y = E^x")


@pytest.mark.parametrize("number", ["e", "pi", "e^2", "(1 + x*pi)/pi", "1/(2*e - 1)"])
def test_pi_and_e_in_coefficients_are_parameters(number: str) -> None:
    """They are transcendental, so that Q(pi) is isomorphic to Q(t)."""
    answer = kovacic.solve(f"(1-x)*y'' + {number}*y = 0")
    letter = "pi" if "pi" in number else "e"
    expected = kovacic.solve(f"(1-x)*y'' + {number.replace(letter, 'q')}*y = 0")
    assert answer.S.to_str("x").replace(letter, "q") == expected.S.to_str("x")
    assert answer.case == expected.case


#: Constants that aren't rational in symbols, and how many letters they need.
CONSTANTS = [
    ("exp(sqrt(2))", 1),
    ("E + pi", 2),
    ("a*(-1)**n", 2),
    ("pi**n*a + pi", 3),
    ("sin(b)**2 + cos(b)**2", 0),
    ("a + sqrt(a)", 1),
    ("cos(2*b) + Abs(c) + tan(b)*sin(b)*cos(b)", 2),
    ("log(6) - log(2) - 2*log(3) + gamma(Rational(1, 3))", 2),
    ("sqrt(a + sqrt(b))*sqrt(b) + b", 2),
    ("exp(-b) + exp(2*b) + cosh(b)", 1),
    ("a**(1/S(3)) + sqrt(a) + a", 1),
    ("2**p + 8**p", 1),
    ("log(12) + log(2)", 2),
    ("sin(1) + tan(1)", 2),
    ("cos(2*a) + 3*cos(a)", 1),
    ("tanh(a) + exp(a)", 1),
    ("pi**(1/S(3)) + 3*pi", 2),
]


def with_constant(constant: str) -> Any:
    x, y = sympy.Symbol("x"), sympy.Function("y")
    return y(x).diff(x, 2) - (x + sympy.sympify(constant)) * y(x)


@pytest.mark.parametrize(("constant", "number"), CONSTANTS)
def test_constants_are_letters(constant: str, number: int) -> None:
    """The letters stand for what was given, and there are no more than needed."""
    x = sympy.Symbol("x")
    given = sympy.sympify(constant)
    parsed = read_input(with_constant(constant), exponentials=True)
    letters = {sympy.Symbol(name): meaning for name, meaning in parsed.letters}
    S = sympy.sympify(parsed.S)
    assert len(S.free_symbols - {x}) == number - ("pi" in constant)  # pi is a number there
    values = {symbol: sympy.Rational(k + 3, 7) for k, symbol in enumerate(sorted(given.free_symbols | {x}, key=str))}
    difference = S.xreplace(letters).xreplace({sympy.Symbol("pi"): sympy.pi}) - x - given
    assert abs(difference.subs(values).evalf(30, maxn=200)) < 1e-25


def test_pi_beside_its_powers_is_one_of_them() -> None:
    parsed = read_input(with_constant("pi**(1/S(3)) + 3*pi"), exponentials=True)
    assert [name for name, _ in parsed.letters] == ["pi_1_3"]


@parametrize("constant", [row[0] for row in CONSTANTS], ordinary=3)
def test_answers_have_letters_for_constants(constant: str) -> None:
    answer = kovacic.solve(with_constant(constant))
    assert answer.case is None
    assert kovacic.Solution.from_json(answer.to_json()) == answer


@pytest.mark.parametrize("text", ["y''+exp(x)^n*y=0", "y''+sin(x)^n*y=0"])
def test_powers_with_a_letter_in_the_exponent_are_refused(text: str) -> None:
    with pytest.raises(kovacic.NotRational, match="isn't a rational function of"):
        kovacic.solve(text, var="x")


@pytest.mark.parametrize(
    ("text", "S"),
    [
        ("exp(x^2)*y'' + exp(x^2)*y = 0", "-1"),
        ("sqrt(x)*y'' + x*sqrt(x)*y = 0", "-x"),
        ("x^n*y'' + x^n*y = x^n", "-1"),
        ("log(x)*y'' = x*log(x)*y", "x"),
    ],
)
def test_a_common_factor_cancels_that_is_not_rational(text: str, S: str) -> None:
    assert str(kovacic.solve(text, var="x").S) == S


def test_an_answer_says_that_e_is_euler_s_number() -> None:
    (notice,) = [n for n in kovacic.solve("x^2 + e").notices if "Euler" in n]
    assert "where it is declared" in notice
    assert not any("Euler" in n for n in kovacic.solve("x^2 + e", parameters=["e"]).notices)


@pytest.mark.parametrize(
    ("text", "linear"),
    [
        ("y''/y = x^2 + 3", "y'' = (x^2 + 3)*y"),
        ("y''/y' + x*y/y' = 2/x", "x*y'' - 2*y' + x^2*y = 0"),
        ("(y'' + y)/(y' - x) = x", "y'' - x*y' + y = -x^2"),
        ("1/y'' = x/(y + 1)", "x*y'' - y = 1"),
    ],
)
def test_quotients_are_multiplied_out(text: str, linear: str) -> None:
    y = sympy.Function("y")
    values = {"y''": "Derivative(y(x), (x, 2))", "y'": "Derivative(y(x), x)"}
    written = re.sub(r"y'*", lambda found: values.get(found[0], "y(x)"), text)
    left, right = (sympy.sympify(side.replace("^", "**"), locals={"y": y}) for side in written.split("="))
    for form in (text, sympy.Eq(left, right)):
        answer, expected = kovacic.solve(form).equation, kovacic.solve(linear).equation
        assert all(getattr(answer, k) / answer.a == getattr(expected, k) / expected.a for k in "bcf")


@pytest.mark.parametrize("text", ["y''/y = y", "y''/y + y'/y^2 = 0", "y''/sin(y') = 1", "y'' + 1/y(x-1) = 0"])
def test_what_stays_nonlinear_is_refused(text: str) -> None:
    with pytest.raises(kovacic.InputError):
        kovacic.solve(text)

"""Coefficients rational in exp(k x), sines, hyperbolic functions, ...: brought to rational ones, answers in x."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy
from build import parametrize, read_input, run, sample, size

import kovacic
from kovacic.reading.change_of_variable import SQUARES, is_of_a_line, slope_squared

F = Fraction
x = sympy.Symbol("x")
y = sympy.Function("y")


def residual(solution: Any, S: Any, point: Any) -> Any:
    """How far y'' is from S y at a point, relatively, with 40 digits."""
    value = (solution.diff(x, 2) - S * solution).subs(x, point).evalf(40, maxn=80)
    return abs(value) / abs(solution.subs(x, point).evalf(40))


#: The superpotentials' spectra: the potential, what is printed, and for integers n and numbers a, b an eigenvalue.
POTENTIALS = {
    "Morse": (
        "A^2*exp(-2*x) - 2*A*b*exp(-x) - E",
        "E = -(n - 2*b)^2/4 for an odd integer n: case 1",
        lambda n, a, b: {"A": a, "b": b, "E": -((b - n - F(1, 2)) ** 2)},
    ),
    "Poeschl-Teller": (
        "-l*(l+1)*sech(x)^2 - E",
        "l in Z, or E = -(n - l)^2 for an integer n: case 1",
        lambda n, a, _: {"l": a, "E": -((a - n) ** 2)},
    ),
    "Poeschl-Teller, trigonometric": (
        "a*(a-1)/sin(x)^2 + b*(b-1)/cos(x)^2 - E",
        "E = (n + b - a)^2 for an odd integer n, or E = (2*n + b + a)^2 for an integer n: case 1",
        lambda n, a, b: {"a": a, "b": b, "E": (a + b + 2 * n) ** 2},
    ),
    "Rosen-Morse": (
        "b*tanh(x) - l*(l+1)*sech(x)^2 - E",
        "E = -(n - l)^2 - b^2/(4*(n - l)^2) (b = 0 where n = l) for an integer n: case 1",
        lambda n, a, b: {"l": a, "b": b, "E": -((a - n) ** 2) - b * b / (4 * (a - n) ** 2)},
    ),
    "Eckart": (
        "-2*b*coth(x) + a*(a-1)*csch(x)^2 - E",
        "E = -(n - a)^2 - b^2/(n - a)^2 (b = 0 where n = a) for an integer n: case 1",
        lambda n, a, b: {"a": a, "b": b, "E": -((a + n) ** 2) - b * b / (a + n) ** 2},
    ),
    "Rosen-Morse, trigonometric": (
        "l*(l+1)/sin(x)^2 + 2*b*cot(x) - E",
        "E = (n - l)^2 - b^2/(n - l)^2 (b = 0 where n = l) for an integer n: case 1",
        lambda n, a, b: {"l": a, "b": b, "E": (a + n + 1) ** 2 - b * b / (a + n + 1) ** 2},
    ),
    "Scarf": (
        "(A^2 - A + B^2)/cos(x)^2 - B*(2*A-1)*sin(x)/cos(x)^2 - E",
        "E = (n - A)^2 for an integer n, or E = (n - 2*B)^2/4 for an odd integer n: case 1",
        lambda n, a, b: {"A": a, "B": b, "E": (a + n) ** 2},
    ),
    "Scarf, hyperbolic": (
        "-(A^2 + A - B^2)/cosh(x)^2 + B*(2*A+1)*sinh(x)/cosh(x)^2 - E",
        "E = -(n - A)^2 for an integer n, or 2*B*I +- 2*sqrt(-E) is an odd integer: case 1",
        lambda n, a, b: {"A": a, "B": b, "E": -((a - n) ** 2)},
    ),
}


@parametrize("name", POTENTIALS, ordinary=1, long=2)
def test_shape_invariant_potentials_have_their_spectra(name: str) -> None:
    """Cooper, Khare & Sukhatme 1995, table 4.1: complete, as printed there, and solvable exactly there."""
    S, printed, eigenvalue = POTENTIALS[name]
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert printed in [line.strip() for line in answer.text().splitlines()]
    assert answer.check(20)
    for n, a, b in ((0, F(7, 3), F(1, 5)), (2, F(16, 5), F(3, 7))):
        assert answer.case_at(eigenvalue(n, a, b)) == 1
        assert answer.case_at({**eigenvalue(n, a, b), "E": F(22, 7)}) is None


@pytest.mark.long
def test_mathieu_and_hill() -> None:
    """No Liouvillian solution but for q = 0; Whittaker-Hill: c = -b^2/(2 (d+1)^2) and a determinant."""
    mathieu = kovacic.conditions("2*q*cos(2*x) - a", var="x")
    assert mathieu.complete is True
    assert [str(region.statement) for region in mathieu.regions] == ["q = 0"]
    hill = kovacic.conditions("a + b*cos(x) + c*cos(2*x)", var="x")
    assert hill.complete is True
    assert hill.case_at({"a": F(1, 2), "b": 1, "c": -F(1, 2)}) == 1
    assert hill.case_at({"a": F(1, 3), "b": 1, "c": -F(1, 2)}) is None


SOLUTIONS = [
    sympy.cosh(x) ** 3 * sympy.exp(2 * x),
    sympy.exp(sympy.sin(x)),
    sympy.sin(x) ** 2 * sympy.exp(sympy.cos(x)),
    sympy.exp(sympy.exp(2 * x) - x) * (sympy.exp(x) + 3),
    sympy.tanh(x) * sympy.sqrt(sympy.cosh(x)),
    sympy.exp(sympy.tan(x) + x),
    sympy.cos(3 * x) / sympy.sin(x),
    sympy.exp(x / 2) * sympy.sqrt(2 + sympy.exp(x)),
]


@parametrize("known", SOLUTIONS, ids=str, ordinary=0, long=(0, 2))
def test_the_answer_is_found_that_the_equation_was_made_from(known: Any) -> None:
    """S = y''/y for a chosen y: a solution is found, and both that are returned solve the equation in x."""
    S = sympy.expand(sympy.simplify((known.diff(x, 2) / known).rewrite(sympy.exp)))
    answer = kovacic.solve(S, var="x")
    assert answer.verified
    assert answer.change is not None
    assert answer.change.variable == "x"
    y1, y2 = answer.solutions
    points = [sympy.Rational(3, 10), sympy.Rational(7, 10)]
    for solution in (y1, y2):
        if not solution.has(sympy.Integral):
            assert all(residual(solution, S, point) < sympy.Float("1e-30") for point in points)
    if not y2.has(sympy.Integral):
        rows = [[f.subs(x, p).evalf(30) for f in (known, y1, y2)] for p in (*points, sympy.Rational(11, 10))]
        assert abs(sympy.Matrix(rows).det()) < sympy.Float("1e-20")  # the chosen one is among their combinations


@pytest.mark.long
def test_first_derivatives_and_the_general_solution() -> None:
    solution = kovacic.dsolve("y'' + tan(x)*y' + cos(x)^2*y = 0")
    C1, C2 = sympy.symbols("C1 C2")
    assert solution.rhs == C1 * sympy.cos(sympy.sin(x)) + C2 * sympy.sin(sympy.sin(x))
    given = sympy.Eq(y(x).diff(x, 2) + 2 * sympy.cot(x) * y(x).diff(x) - 3 * y(x), 0)
    assert sympy.checkodesol(given, kovacic.dsolve(given))[0]
    started = kovacic.dsolve("y'' + tan(x)*y' + cos(x)^2*y = 0", ics={"y(0)": 2, "y'(0)": 3}).rhs
    assert started == 2 * sympy.cos(sympy.sin(x)) + 3 * sympy.sin(sympy.sin(x))


@pytest.mark.slow
def test_right_hand_sides() -> None:
    """The particular solution by variation of constants, its integral in x and done numerically."""
    C1, C2 = sympy.symbols("C1 C2")
    forced = kovacic.dsolve("y'' - tanh(x)*y' = exp(x)").rhs.subs({C1: 0, C2: 0})
    left = (forced.diff(x, 2) - sympy.tanh(x) * forced.diff(x)).doit(deep=False).subs(x, sympy.Rational(2, 5))
    assert abs(left.evalf(20) - sympy.exp(sympy.Rational(2, 5)).evalf(20)) < 1e-12


@parametrize(
    ("S", "T", "same"),
    [
        ("exp(x + c)", "exp(c + x)", "exp(x)"),
        ("exp(2*(x + 1/2)) - exp(x + 1/2)", "exp(x + 1/2)", "exp(2*x) - exp(x)"),
        ("sin(2*x + 1)", "tan(x + 1/2)", "sin(2*x)"),
        ("exp(2*x)*exp(3)", "exp(2*x)", "e^3*exp(2*x)"),
    ],
    ordinary=2,
)
def test_a_constant_in_the_exponent_is_a_shift_of_x_or_a_power_of_e(S: str, T: str, same: str) -> None:
    found, other = (read_input(f"y'' = ({text})*y", exponentials=True) for text in (S, same))
    assert found.S == other.S
    assert found.equation is not None
    assert found.equation.change is not None
    assert found.equation.change.expression == T


def test_the_answer_of_a_shifted_equation_solves_it() -> None:
    c = sympy.Symbol("c")
    answer = kovacic.solve("exp(2*x + 2*c) + exp(x + c)")
    y = answer.solutions[0]
    assert sympy.simplify(y.diff(x, 2) / y - sympy.exp(2 * x + 2 * c) - sympy.exp(x + c)) == 0


def test_special_functions_come_back_in_x() -> None:
    """y'' = (e^(2x) - nu^2) y: Bessel functions of e^x."""
    found = kovacic.dsolve("y'' = (exp(2*x) + 9)*y").rhs
    assert found.has(sympy.exp(x))
    assert found.has(sympy.besseli)


def test_rates_are_parameters_and_radicals() -> None:
    answer = kovacic.solve("y'' = (exp(2*k*x) - k*exp(k*x))*y")
    assert answer.case == 1
    assert sympy.simplify(answer.solutions[0] - sympy.exp(-sympy.exp(sympy.Symbol("k") * x) / sympy.Symbol("k"))) == 0
    assert kovacic.decide("2*exp(2*sqrt(2)*x) + 2*exp(sqrt(2)*x)").case == 1


@pytest.mark.parametrize(
    ("S", "message"),
    [
        ("x*exp(x)", "x and exp\\(x\\) both occur: that isn't rational in one exponential"),
        ("exp(x) + exp(sqrt(2)*x)", "no rational quotient"),
        ("exp(x)*cos(x)", "no rational quotient"),
        ("exp(x^2)", "multiple of x"),
        ("sqrt(x + 1) + log(x)", "log"),
        ("sin(2^x)", "multiple of x"),
    ],
)
def test_other_coefficients_are_refused(S: str, message: str) -> None:
    with pytest.raises(kovacic.InputError, match=message):
        kovacic.solve(S, var="x")


@pytest.mark.parametrize(
    ("equation", "message", "position"),
    [
        ("y'' + exp(x)*y(2*x) = 0", "different arguments", 13),
        ("y'' + sin(x)*y^2 = 0", "a power of y", 13),
        ("y'' + exp(x)*y*y' = 0", "a product of y", 6),
        ("exp(x) + y", "the symbol y in", 9),
        ("gamma(x)", "isn't a rational function", 0),
    ],
)
def test_texts_with_exponentials_are_refused_where_others_are(equation: str, message: str, position: int) -> None:
    with pytest.raises(kovacic.InputError, match=message) as caught:
        kovacic.solve(equation)
    assert caught.value.position == position


def test_known_functions_are_differentiated_and_decimals_noticed_as_in_other_texts() -> None:
    one, other = (read_input(f"y'' = {S}*y", exponentials=True) for S in ("diff(0.5*cosh(k*x))", "k/2*sinh(k*x)"))
    assert one.S == other.S
    assert "0.5 was taken exactly, as 1/2" in one.notices


def mp_states(coefficient: Any, x0: Any, x: Any, right: Any = lambda x: 0) -> Any:
    """(y, y') at x of y'' = coefficient(x) y + right(x), y(x0) = 1, y'(x0) = 0, by mpmath's Taylor series."""
    return mpmath.odefun(lambda x, y: [y[1], coefficient(x) * y[0] + right(x)], x0, [1, 0])(x)


@parametrize(
    ("equation", "x0", "x", "params", "coefficient", "right"),
    [
        ("y'' = (exp(2*x) + 9)*y", 0, "1/2", {}, lambda x: mpmath.e ** (2 * x) + 9, None),
        ("y'' = (exp(k*x) + 1)*y", -1, 1, {"k": "sqrt(2)"}, lambda x: mpmath.e ** (mpmath.sqrt(2) * x) + 1, None),
        ("y'' + (1 + cos(2*x)/2)*y", "1/2", 4, {}, lambda x: -1 - mpmath.cos(2 * x) / 2, None),  # on the unit circle
        ("y'' = y/(2 + cos(x))", 0, 7, {}, lambda x: 1 / (2 + mpmath.cos(x)), None),  # and a singular point near it
        ("y'' + (k + sin(x))*y", 0, 1, {"k": 2}, lambda x: -2 - mpmath.sin(x), None),
        ("y'' = tanh(x + 1)*y", -2, 1, {}, lambda x: mpmath.tanh(x + 1), None),
        ("y'' = exp(x)*y + exp(2*x)", 0, 1, {}, mpmath.exp, lambda x: mpmath.e ** (2 * x)),
    ],
    ordinary=0,
    long=1,
)
def test_values_in_the_users_variable(
    equation: str, x0: Any, x: Any, params: dict[str, Any], coefficient: Any, right: Any
) -> None:
    with mpmath.workdps(24):
        expected = mp_states(
            coefficient, mpmath.mpf(sympy.Rational(x0)), mpmath.mpf(sympy.Rational(x)), right or (lambda x: 0)
        )
        options: dict[str, Any] = {"x0": x0, "y0": 1, "dy0": 0, "digits": 20, "derivative": True, "params": params}
        for y, dy in (kovacic.solve(equation).at(x, **options), kovacic.evaluate(equation, x, **options)):
            for ball, value in zip((y, dy), expected, strict=True):
                assert ball.digits > 19
                assert abs(ball.to_mpmath() - value) < mpmath.mpf(10) ** -18 * (1 + abs(value))


@pytest.mark.long
def test_values_of_a_closed_form_with_constants_as_initial_values() -> None:
    answer = kovacic.solve("-2/cosh(x)^2 + 1")
    found = answer.at([2, 3, -1], x0=1, y0="1/cosh(1)", dy0="-sinh(1)/cosh(1)^2", digits=30)
    with mpmath.workdps(35):
        for ball, x in zip(found, (2, 3, -1), strict=True):
            assert abs(ball.to_mpmath() - mpmath.sech(x)) < mpmath.mpf(10) ** -29


@parametrize(
    ("equation", "x0", "x", "message"),
    [
        ("y'' + y/(exp(x) - 1) = 0", "-1/2", "1/2", "analytic near"),
        ("y'' + coth(x)*y' - (6 + cosh(x))*y = 0", 0, 1, "no value at 0, an end of the path"),
        ("y'' + coth(x)*y' - (6 + cosh(x))*y = 0", -1, 1, "analytic near"),
        ("y'' = y/(2 + exp(I*x) - exp(2*I*x))", 1, 4, "analytic near 3.14159"),
        ("y'' + y/(exp(x) - 1) = 0", 1, 0, "at the end 0"),
    ],
    ordinary=(0, 1),
    long=2,
)
def test_singular_points_on_the_way_are_refused(equation: str, x0: Any, x: Any, message: str) -> None:
    with pytest.raises(kovacic.InputError, match=message):
        kovacic.solve(equation).at(x, x0=x0, y0=1, dy0=0)


def test_values_from_a_frobenius_basis_are_refused() -> None:
    with pytest.raises(kovacic.InputError, match="needs y0 and dy0 at a regular point"):
        kovacic.evaluate("2*sech(x)^2*(-1) + 1", 2, x0=1, which="regular")
    with pytest.raises(kovacic.InputError):
        read_input("sin(x)")


SECH = {"x0": 1, "y0": "1/cosh(1)", "dy0": "-sinh(1)/cosh(1)^2"}


@pytest.mark.long
@pytest.mark.parametrize("careful", [False, True])
def test_numpy_functions_and_pictures_are_those_of_the_users_variable(careful: bool) -> None:
    """1/cosh(x), by initial values and as the solution that the certificate has, and exp(exp(x) - x/2)."""
    answer, x = kovacic.solve("2*sech(x)^2*(-1) + 1"), np.linspace(-3, 4, 701)
    assert answer.change is not None
    table = kovacic.tabulate(answer, -3, 4, careful=careful, **SECH)
    function = answer.lambdify(interval=(-3, 4), careful=careful, **SECH)
    for f in (table, function):
        assert np.max(np.abs(f(x) * np.cosh(x) - 1)) < 2e-15
    assert function.measured is not None
    assert function.measured.worst < (1 if careful else 20)
    own = answer.lambdify(interval=(-3, 4), careful=careful)
    assert np.ptp(own(x) * np.cosh(x)) < 4e-15 * own(0.0)
    growing = kovacic.solve("exp(2*x) + 1/4")
    found = [growing.lambdify(interval=(0, 2), which=which)(x[300:501]) for which in (0, 1)]
    known = [np.exp(sign * np.exp(x[300:501]) - x[300:501] / 2) for sign in (-1, 1)]
    assert min(np.ptp(np.log(y / known[0])) for y in found) < 1e-14
    assert min(np.ptp(np.log(y / known[1])) for y in found) < 1e-14


@parametrize(
    ("equation", "interval", "start", "second"),
    [
        ("y'' = (2 + cos(x))*y", (-3, 5), (0, 1, 0), lambda t, y: (2 + mpmath.cos(t)) * y),
        ("y'' = -(2 + sin(x))*y", (-2, 3), (0, 1, "1/3"), lambda t, y: -(2 + mpmath.sin(t)) * y),
        ("y'' = exp(x)*y + exp(2*x)", (-1, 2), (0, 1, 0), lambda t, y: mpmath.exp(t) * y + mpmath.exp(2 * t)),
        ("y'' = (exp(k*x) + 1)*y", (-1, 2), (0, 1, 1), lambda t, y: (mpmath.exp(mpmath.sqrt(2) * t) + 1) * y),
    ],
    ordinary=0,
    long=1,
)
def test_a_table_in_the_users_variable(equation: str, interval: Any, start: Any, second: Any) -> None:
    """Against an independent integrator, on both sides of the start."""
    options = dict(zip(("x0", "y0", "dy0"), start, strict=True))
    options |= {"params": {"k": "sqrt(2)"}} if "k" in equation else {}
    table = kovacic.tabulate(equation, *interval, **options)
    with mpmath.workdps(20):
        for end in interval:
            sign = 1 if end > 0 else -1
            begin = [mpmath.mpf(1), sign * mpmath.mpf(Fraction(start[2]).numerator) / Fraction(start[2]).denominator]
            own = mpmath.odefun(lambda t, s, sign=sign: [s[1], second(sign * t, s[0])], 0, begin)
            for share in (0.21, 0.6, 1):
                assert table(end * share) == pytest.approx(float(own(abs(end) * share)[0]), rel=1e-14)


@pytest.mark.long
@pytest.mark.parametrize(
    ("equation", "interval", "message"),
    [
        ("y'' = y/(exp(x) - 2)", (0, 1), "analytic near 0.69314"),
        ("y'' = exp(I*x)*y", (0, 1), "need an equation with real coefficients"),
        ("y'' + exp(x)*y = I", (0, 1), "need an equation with real coefficients"),
        ("y'' + sin(sqrt(x + 1))*y = acos(2)", (0, 1), "need an equation with real coefficients"),
        ("y'' + exp(x)*y = (-1)^(1/3)*sin(x)", (0, 1), "need an equation with real coefficients"),
    ],
)
def test_tables_and_pictures_where_there_are_no_values_are_refused(equation: str, interval: Any, message: str) -> None:
    with pytest.raises(kovacic.InputError, match=message):
        kovacic.tabulate(equation, *interval, x0=0, y0=1, dy0=0)
    if message != "need an equation with real coefficients":
        with pytest.raises(kovacic.InputError, match=message):
            kovacic.solve(equation).plot(*interval, x0=0)


@pytest.mark.long
def test_a_picture_in_the_users_variable() -> None:
    (arc,) = sample("2*sech(x)^2*(-1) + 1", -3, 4, points=30, **SECH).arcs
    assert (arc.x[0], arc.x[-1]) == (-3, 4)
    assert np.abs(arc.y.real * np.cosh(arc.x) - 1).max() < 1e-7


def test_json_keeps_the_change_of_variable() -> None:
    answer = kovacic.solve("-2/cosh(x)^2 + 1")
    text = answer.to_json()
    assert json.loads(text)["equation"]["change"] == {"variable": "x", "expression": "exp(2*x)", "field": "C(exp(2*x))"}
    again = kovacic.Solution.from_json(text)
    assert again == answer
    assert again.solutions == answer.solutions
    assert "t = exp(2*x)" in answer.notices[0]


@pytest.mark.long
def test_json_of_a_sympy_equation_is_read_in_the_users_variable() -> None:
    x, b, theta = sympy.symbols("x b theta")
    y = sympy.Function("y")
    coefficients = [
        sympy.exp(x),
        sympy.exp(x - b) * sympy.sin(theta),
        sympy.exp(x) + sympy.exp(x - b),
        sympy.root(x, 3),
    ]
    inputs = [sympy.Eq(y(x).diff(x, 2), c * y(x) + sympy.sin(x)) for c in coefficients]
    for given in [*inputs, sympy.exp(2 * x) + 1, (sympy.exp(x) * y(x).diff(x)).diff(x) + y(x)]:
        answer = kovacic.solve(given)
        assert kovacic.Solution.from_json(answer.to_json()) == answer


@parametrize(
    ("shifted", "same"),
    [
        ("cos(x) + cos(x - b)", "2*cos(b/2)*cos(x - b/2)"),
        ("exp(x) + exp(x - b)", "(1 + exp(-b))*exp(x)"),
        ("2^x + 2^(x - 1)", "3/2*exp(log(2)*x)"),
    ],
    ordinary=1,
    long=1,
)
def test_constants_that_are_added_in_exponents(shifted: str, same: str) -> None:
    """The answer solves the same equation, written in another way."""
    x, b = sympy.symbols("x b")
    y = kovacic.dsolve(f"y'' = ({shifted})*y").rhs
    assert len(y.free_symbols & {sympy.Symbol("C1"), sympy.Symbol("C2")}) == 2
    coefficient = sympy.sympify(same.replace("^", "**"))
    rest = (y.diff(x, 2) - coefficient * y).subs({b: sympy.Rational(2, 3), "C1": 2, "C2": 3})
    functions = rest.atoms(sympy.mathieuc, sympy.mathieus)
    parts = [rest.coeff(f) for f in functions] if functions else [rest]
    assert all(abs(part.subs(x, sympy.Rational(5, 7)).evalf(30, chop=True)) < 1e-20 for part in parts)


def test_the_command_reads_a_formula_that_begins_with_a_minus_and_has_an_h(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["solve", "-2/cosh(x)^2 + 1"]) == 0
    assert "y1 = 1/cosh(x)" in capsys.readouterr().out


@pytest.mark.parametrize("text", ["y'' = (2 + cos(x)) y", "u'' + exp(x)*u' = 0", "exp(2*x) + 3"])
def test_the_first_line_is_what_the_user_asked(text: str) -> None:
    answer = kovacic.solve(text)
    title = str(answer).splitlines()[0].partition(": ")[0]
    assert text in title
    assert " t" not in title  # the equation in t comes after it, where t is told
    again = kovacic.solve(title)
    assert (again.S, again.equation) == (answer.S, answer.equation)


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "second", "real"),
    [
        ("y'' = (2 + cos(x))*y", lambda t, y, d: (2 + mpmath.cos(t)) * y, True),
        ("y'' = (sin(x)^2 - 2)*y", lambda t, y, d: (mpmath.sin(t) ** 2 - 2) * y, True),
        ("y'' = y/(2 + cos(x))", lambda t, y, d: y / (2 + mpmath.cos(t)), True),
        ("y'' = exp(I*x)*y", lambda t, y, d: mpmath.expj(t) * y, False),
    ],
)
def test_real_is_real_on_the_unit_circle_too(text: str, second: Any, real: bool) -> None:
    """A real ball for a real equation, the values those of an independent integrator."""
    value, slope = kovacic.evaluate(text, "3/2", x0=0, y0=1, dy0=0, derivative=True)
    with mpmath.workdps(20):
        start = [mpmath.mpf(1), mpmath.mpf(0)]
        own = mpmath.odefun(lambda t, state: [state[1], second(t, *state)], 0, start)(mpmath.mpf(3) / 2)
    for ball, number in zip((value, slope), own, strict=True):
        assert ball.real is real
        assert abs(complex(ball) - complex(number)) < 1e-14


def test_the_shell_and_none_as_an_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "exp(x)", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1,2"]) == 0
    with mpmath.workdps(20):  # the modified Bessel functions of 2 e^(x/2)
        a, b = (mpmath.besseli(0, 2, derivative=1), mpmath.diff(lambda z: mpmath.besselk(0, z), 2))
        wronskian = mpmath.besseli(0, 2) * b - a * mpmath.besselk(0, 2)
        z = 2 * mpmath.exp(mpmath.mpf(1) / 2)
        value = (b * mpmath.besseli(0, z) - a * mpmath.besselk(0, z)) / wronskian
    assert capsys.readouterr().out.startswith(f"y(1) = {mpmath.nstr(value, 14)}")
    start = {"x0": 0, "y0": 1, "dy0": 0}
    assert float(kovacic.evaluate("exp(x)", 1, **start, path=None, which=None, frobenius=None)) == pytest.approx(
        float(value)
    )
    for option in ({"path": "above"}, {"which": "regular"}, {"frobenius": (1, 0)}):
        with pytest.raises(kovacic.InputError, match="functions of x"):
            kovacic.evaluate("exp(x)", 1, **start, **option)


@parametrize(
    ("equation", "second"),
    [
        ("cos(x)*y'' + sin(x)*y' = 0", sympy.sin),
        ("sin(x)*y'' - cos(x)*y' = 0", sympy.cos),
        ("cosh(x)*y'' - sinh(x)*y' = 0", sympy.sinh),
    ],
    ordinary=1,
)
def test_solutions_join_where_the_new_variable_has_a_branch_point(equation: str, second: Any) -> None:
    """sin(x) isn't sqrt(cos(2 x) - 1), whose slope jumps at the ordinary point 0; 1 and `second` are solutions."""
    x = sympy.Symbol("x")
    found = kovacic.dsolve(equation, ics={"y(1)": 2, "y'(1)": 3}).rhs
    expected = 2 + 3 * (second(x) - second(1)) / second(x).diff(x).subs(x, 1)
    for point in (-2, -1, Fraction(1, 3), 3, 5):
        assert size((found - expected).subs(x, sympy.Rational(point))) < 1e-15


@parametrize(
    "right",
    [
        "log(exp(x) + 1)",
        "sqrt(exp(x) + 1)",
        "x",
        "log(x)",
        "Heaviside(x - 1)",
    ],
    ordinary=0,
    long=1,
)
def test_a_right_hand_side_that_is_another_function(right: str) -> None:
    """It was left out, in formulas and in proven values, where it is a function of exp(x) that isn't rational."""
    equation, start = f"y'' + exp(x)*y = {right}", {"x0": 1, "y0": 0, "dy0": 0}
    x = sympy.Symbol("x")
    found = kovacic.dsolve(equation).rhs
    parts = {e: e.function.as_independent(x, sympy.Symbol("s"), as_Add=False) for e in found.atoms(sympy.Integral)}
    found = found.xreplace({e: c * sympy.Integral(f, *e.limits) for e, (c, f) in parts.items()})
    residual = found.diff(x, 2) + sympy.exp(x) * found - sympy.sympify(right)
    integrals = sorted(residual.atoms(sympy.Integral), key=str)
    values = {integral: sympy.Rational(k + 2, 5) for k, integral in enumerate(integrals)}
    point = {x: sympy.Rational(3, 2), "C1": 1, "C2": 2}
    steps = {f: f.subs(point) for f in residual.atoms(sympy.Heaviside, sympy.DiracDelta)}
    assert size(residual.xreplace(values).doit().xreplace(steps).subs(point)) < 1e-12
    assert kovacic.solve(equation).case is None
    if "Heaviside" in right:
        with pytest.raises(kovacic.InputError, match="isn't known in balls"):
            kovacic.evaluate(equation, 2, **start)
        return
    value = kovacic.evaluate(equation, 2, **start)
    assert kovacic.solve(equation).at(2, **start).overlaps(value)
    with mpmath.workdps(20):
        f = sympy.lambdify(sympy.Symbol("x"), right, "mpmath")
        own = mpmath.odefun(lambda t, s: [s[1], f(t) - mpmath.exp(t) * s[0]], 1, [0, 0])(2)[0]
    assert abs(float(value) - float(own)) < 1e-14
    assert kovacic.tabulate(equation, 1, 2, **start)(2.0) == pytest.approx(float(own), rel=1e-14)


NOT_ALGEBRAIC = [
    f"{number}*{factor}"
    for number in ("pi", "e", "log(2)", "2^pi", "(pi + sqrt(2))")
    for factor in ("1", "exp(x)", "(1 + exp(2*x))", "exp(a)")
]


@pytest.mark.parametrize("coefficient", ["2 + cos(x)", "pi*exp(x)", "sinh(2*x)"])
@parametrize("right", NOT_ALGEBRAIC, ordinary=3)
def test_numbers_on_the_right_that_are_not_algebraic_are_read(coefficient: str, right: str) -> None:
    """It ended in an AssertionError: such numbers are no constants of the equation in exp(x)."""
    equation = kovacic.solve(f"y'' + ({coefficient})*y = {right}").equation
    assert not equation.is_homogeneous
    assert equation.S == kovacic.solve(f"y'' + ({coefficient})*y = 0").equation.S


@parametrize("right", NOT_ALGEBRAIC, ordinary=0, long=(0, 5, 10))
@pytest.mark.filterwarnings("ignore:e is Euler's number")
def test_solutions_with_numbers_on_the_right_that_are_not_algebraic(right: str) -> None:
    found = kovacic.dsolve(f"y'' - y' + exp(2*x)*y = {right}").rhs
    values = {"C1": 2, "C2": 3, "a": sympy.Rational(1, 4)}
    left = found.diff(x, 2) - found.diff(x) + sympy.exp(2 * x) * found
    residual = left - sympy.sympify(right.replace("e*", "E*"))
    assert size(residual.subs(values).subs(x, sympy.Rational(3, 4))) < 1e-15


SHAPES = [
    "a*sech(x)^2 + b",
    "a*sech(x)^2 + b*tanh(x) + c",
    "a*exp(2*x) + b*exp(x) + c",
    "a/sin(x)^2 + b",
    "a/sinh(x)^2 + b",
    "a*cot(x)^2 + b*cot(x) + c",
    "a/cosh(x)^2 + b*sinh(x)/cosh(x)^2 + c",
    "a/cos(x)^2 + b*sin(x)/cos(x)^2 + c",
    "a/(exp(x)+1) + b/(exp(x)+1)^2 + c",
    "a*exp(x)/(exp(x)+2)^2 + b",
    "y'' + a*tan(x)*y' + b*y = 0",
]
#: With which singular points become ordinary: of exponent differences 1, and their neighbours.
SPECIAL = [F(k, 4) for k in (-9, -8, -4, -3, -1, 1, 3, 4, 5, 8, 15)]


@parametrize("shape", SHAPES, ordinary=1, long=(1, 5), always=["a*exp(2*x) + b*exp(x) + c", "a/sin(x)^2 + b"])
def test_the_variable_is_the_same_for_letters_and_special_numbers(shape: str) -> None:
    family = kovacic.conditions(shape, var="x", max_degree=0)
    names = family.parameters
    for k in range(8):
        values = {name: SPECIAL[(3 * k + 5 * i * (k + 1)) % len(SPECIAL)] for i, name in enumerate(names)}
        text = shape
        for name, value in values.items():
            text = re.sub(rf"\b{name}\b", f"({value})", text)
        solution = kovacic.solve(text)
        assert solution.equation.change.expression == family.equation.change.expression
        assert family.case_at(values) == solution.case, values


@pytest.mark.parametrize(
    ("S", "variable"),
    [
        ("1/(2 + cos(x))", "exp(I*x)"),
        ("exp(x)", "exp(x)"),
        ("cosh(x)", "exp(x)"),
        ("2^x", "exp(log_2*x)"),
        ("1/(2 + sin(x))", "sin(x)"),
        ("tan(x)", "tan(x)"),
    ],
)
def test_the_variable_of_coefficients_that_are_not_invariant(S: str, variable: str) -> None:
    assert read_input(S, exponentials=True).equation.change.expression == variable


def test_a_singular_point_that_is_ordinary_for_special_numbers_counts() -> None:
    family = kovacic.conditions("-a + 3*l*sech(x)^2/2", var="x", max_degree=0)
    solution = kovacic.solve("1/4 + 15*sech(x)^2/8")
    assert solution.equation.change.expression == family.equation.change.expression == "exp(2*x)"
    assert solution.case == family.case_at({"a": "-1/4", "l": "5/4"})


@pytest.mark.parametrize(
    ("text", "variable"),
    [
        ("y'' + 3*exp(2*x)/(exp(2*x)+5)*y' + (2*exp(4*x)-7)/(exp(2*x)-3)*y = 11*exp(6*x)/(exp(2*x)+2)", "exp(2*x)"),
        ("(2+sin(3*x))*y'' + 5*cos(3*x)*y' + (7+sin(3*x)^2)*y = 11*sin(3*x)", "sin(3*x)"),
        ("(2+cos(3*x))*y'' + 5*sin(3*x)*y' + (7+cos(3*x)^2)*y = 11*cos(3*x)", "exp(3*I*x)"),
        ("(2+tan(x/2))*y'' + 5*y' + (7+tan(x/2)^3)*y = 11*tan(x/2)", "tan(x/2)"),
        ("(2+sinh(3*x))*y'' + 5*cosh(3*x)*y' + (7+sinh(3*x)^2)*y = 11*cosh(3*x)", "exp(3*x)"),
        ("sin(4*t)*y'' + 3*cos(2*t)*y' + 5*y = 0", "tan(t)"),
        ("y'' + 3*cos(4*x)*y' + 5*sin(2*x)^2*y = 0", "tan(2*x)"),
        ("3*exp(2*x+1)*y'' + (5 - exp(-4*x-2))*y' + 7*y = log(x)*exp(x)", "exp(2*x + 1)"),
        ("2*y'' + (3*exp(2*x+1) + exp(4*x+5))*y' + 5*exp(6*x+3)*y = exp(6*x+2)", "exp(2*x + 1)"),
        ("3*x^2*y'' + x*y' + (2*x^(2/3) + 5*x^(4/3) + 7)*y = 0", "x**(2/3)"),
        ("x^2*y'' + 2*x*y' + (3*x^n + 5*x^(2*n))*y = 0", "x**n"),
        ("x*y'' - y' + 7*x^3*exp(3*x^2)*y = 0", "exp(3*x**2)"),
        ("x*y'' + (3*x^3*sin(x^3) - 2)*y' + 7*x^5*cos(x^3)^2*y = 0", "exp(I*x**3)"),
        ("4*u*y'' + (2 + 5*sqrt(u)*tanh(sqrt(u)))*y' + exp(2*sqrt(u))*y = 0", "exp(2*sqrt(u))"),
    ],
)
def test_the_equation_in_the_new_variable_is_the_given_one(text: str, variable: str) -> None:
    """y' = t' dy/dt and y'' = t'^2 d^2y/dt^2 + t'' dy/dt, put into the given equation at a point."""
    equation = read_input(text, exponentials=True).equation
    assert equation.change.expression == variable
    here = sympy.Symbol(equation.change.variable)
    values = {here: sympy.Float("1.4", 30), "n": sympy.Rational(5, 3), "e": sympy.E}
    t = sympy.sympify(variable, {equation.change.variable: here})
    slope, bend = t.diff(here).subs(values), t.diff(here, 2).subs(values)
    a, b, c, f = (
        sympy.sympify(part.to_str().replace("^", "**")).subs(x, t.subs(values)).subs(values) / slope**k
        for part, k in zip((equation.a, equation.b, equation.c, equation.f), (2, 1, 0, 0), strict=True)
    )
    b -= a * bend / slope
    found = [b / a, c / a, f / a if equation.h is None else equation.h.subs(values)]
    left, right = text.replace("^", "**").replace("y''", "Y2").replace("y'", "Y1").replace("*y ", "*Y0 ").split("=")
    terms = sympy.expand(sympy.sympify(left, {str(here): here}))
    given = [sympy.sympify(right, {str(here): here}), *(terms.coeff(name) for name in ("Y2", "Y1", "Y0"))]
    f, a, b, c = (part.subs(values) for part in given)
    assert [size(one - other) < 1e-15 for one, other in zip(found, (b / a, c / a, f / a), strict=True)] == [True] * 3
    if is_of_a_line(equation):
        assert size(slope_squared(equation).subs(equation.variable, t.subs(values)) - slope**2) < 1e-15


@pytest.mark.parametrize("function", SQUARES, ids=str)
def test_the_square_of_the_derivative_is_a_function_of_the_value(function: Any) -> None:
    point = sympy.Float("0.6", 30)
    assert size(SQUARES[function](function(point)) - function(x).diff(x).subs(x, point) ** 2) < 1e-25

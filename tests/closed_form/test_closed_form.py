"""Closed forms as they are shown: textbook equations, the published ones, and random ones built from their answers."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import flint
import mpmath
import published
import pytest
import strategies
import sympy
import transform
from build import QQ, RatFunc, generated, jet, parametrize, residual
from flint import acb, arb
from hypothesis import given, settings
from sympy.abc import x

import kovacic
from kovacic import Limits
from kovacic.closed_form.check import is_numerical_solution
from kovacic.closed_form.form import written
from kovacic.closed_form.structure import build

X = RatFunc(QQ.poly([0, 1]))

TEXTBOOK = [
    # Constant coefficients.
    ("y'' + y = 0", "cos(x)", "sin(x)"),
    ("y'' - y' - 6*y = 0", "exp(3*x)", "exp(-2*x)"),
    ("y'' + 2*y' + 5*y = 0", "exp(-x)*cos(2*x)", "exp(-x)*sin(2*x)"),
    ("y'' + 2*y' + y = 0", "exp(-x)", "x*exp(-x)"),
    ("y'' = 2*y", "exp(sqrt(2)*x)", "exp(-sqrt(2)*x)"),
    ("y'' = 0", "1", "x"),
    ("y'' + y' = 0", "1", "exp(-x)"),
    # Euler.
    ("x^2*y'' - 3*x*y' + 4*y = 0", "x**2", "x**2*log(x)"),
    ("x^2*y'' + x*y' + y = 0", "cos(log(x))", "sin(log(x))"),
    ("x^2*y'' + 3*x*y' + 2*y = 0", "cos(log(x))/x", "sin(log(x))/x"),
    ("x^2*y'' + x*y' - 2*y = 0", "x**(sqrt(2))", "x**(-sqrt(2))"),
    ("4*x^2*y'' + y = 0", "sqrt(x)", "sqrt(x)*log(x)"),
    ("6*x^2*y'' + x*y' + y = 0", "sqrt(x)", "x**(1/3)"),
    # Bessel, half-integer order, and the spherical functions.
    ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", "cos(x)/sqrt(x)", "sin(x)/sqrt(x)"),
    ("x^2*y'' + x*y' + (x^2 - 9/4)*y = 0", "(x*cos(x) - sin(x))/x**(3/2)", "(x*sin(x) + cos(x))/x**(3/2)"),
    ("x^2*y'' + x*y' - (x^2 + 1/4)*y = 0", "exp(x)/sqrt(x)", "exp(-x)/sqrt(x)"),
    ("x*y'' + 2*y' + x*y = 0", "cos(x)/x", "sin(x)/x"),
    # Orthogonal polynomials.
    ("(1-x^2)*y'' - 2*x*y' + 2*y = 0", "x", "x*log((x + 1)/(1 - x)) - 2"),
    ("(1-x^2)*y'' - 2*x*y' + 6*y = 0", "3*x**2 - 1", "(3*x**2 - 1)*log((x + 1)/(1 - x)) - 6*x"),
    (
        "(1-x^2)*y'' - 2*x*y' + (2 - 1/(1-x^2))*y = 0",
        "sqrt(1 - x**2)",
        "sqrt(1 - x**2)*log((x + 1)/(1 - x)) + 2*x/sqrt(1 - x**2)",
    ),
    ("(1-x^2)*y'' - x*y' + 9*y = 0", "sqrt(1 - x**2)*(4*x**2 - 1)", "4*x**3 - 3*x"),
    ("(1-x^2)*y'' - x*y' + y/9 = 0", "(x + sqrt(x**2 - 1))**(1/3)", "(x + sqrt(x**2 - 1))**(-1/3)"),
    ("(1-x^2)*y'' - x*y' + 2*y = 0", "(x + sqrt(x**2 - 1))**sqrt(2)", "(x + sqrt(x**2 - 1))**(-sqrt(2))"),
    ("(1-x^2)*y'' - 5*x*y' + 5*y = 0", "(8*x**4 - 12*x**2 + 3)/(1 - x**2)**(3/2)", "x"),
    ("y'' - 2*x*y' + 4*y = 0", "2*x**2 - 1", "sqrt(pi)*(2*x**2 - 1)*erfi(x) - 2*x*exp(x**2)"),
    ("x*y'' + (1-x)*y' + 2*y = 0", "x**2 - 4*x + 2", "(x**2 - 4*x + 2)*Ei(x) - (x - 3)*exp(x)"),
    ("x*y'' + (2-x)*y' + y = 0", "x - 2", "(x - 2)*Ei(x) - (x - 1)*exp(x)/x"),
    # Others.
    ("y'' = (x^2 + 3)*y", "x*exp(x**2/2)", "sqrt(pi)*x*exp(x**2/2)*erf(x) + exp(-x**2/2)"),
    ("y'' = (x^2/4 - 1/2)*y", "exp(-x**2/4)", "sqrt(pi)*exp(-x**2/4)*erfi(sqrt(2)*x/2)"),
    ("y'' = (x-4)/(4*x)*y", "x*exp(-x/2)", "x*exp(-x/2)*Ei(x) - exp(x/2)"),
    ("y'' = (1/x - 3/(16*x^2))*y", "x**(1/4)*exp(2*sqrt(x))", "x**(1/4)*exp(-2*sqrt(x))"),
    ("y'' = (-1/x - 3/(16*x^2))*y", "x**(1/4)*cos(2*sqrt(x))", "x**(1/4)*sin(2*sqrt(x))"),
    ("(1 + x^2)*y'' + x*y' - y = 0", "x", "sqrt(x**2 + 1)"),
    ("(1 + x^2)^2*y'' + 2*x*(1 + x^2)*y' + y = 0", "cos(atan(x))", "sin(atan(x))"),
    ("x^4*y'' + y = 0", "x*cos(1/x)", "x*sin(1/x)"),
    ("y'' = y/(x^2+1)^2", "sqrt(x**2 + 1)", "sqrt(x**2 + 1)*atan(x)"),
    ("y'' = (a^2-1)/(4*x^2)*y", "x**(a/2 + 1/2)", "x**(1/2 - a/2)"),
    ("y'' = sqrt(2)*y", "exp(2**(1/4)*x)", "exp(-2**(1/4)*x)"),
    ("y'' = -sqrt(2)*y", "cos(2**(1/4)*x)", "sin(2**(1/4)*x)"),
    ("y'' = cbrt(2)*y", "exp(2**(1/6)*x)", "exp(-2**(1/6)*x)"),
    ("y'' = root(3, 4)*y", "exp(3**(1/8)*x)", "exp(-3**(1/8)*x)"),
]


@parametrize(("equation", "first", "second"), TEXTBOOK, ordinary=9, ids=[row[0] for row in TEXTBOOK])
def test_textbook_equations_look_like_the_textbook(equation: str, first: str, second: str) -> None:
    form = kovacic.solve(equation).closed_form
    assert form is not None
    for found, expected in ((form.y1, first), (form.y2, second)):
        wanted = sympy.sympify(expected)
        assert found == wanted or sympy.expand(found - wanted) == 0, f"{found} instead of {wanted}"
    assert form.checked == "exact"
    assert form.notes == ()


@parametrize(
    "entry", [entry for entry in published.load() if entry.case], ordinary=3, long=5, ids=lambda entry: entry.id
)
def test_published_equations_have_two_independent_checked_solutions(entry: published.Published) -> None:
    texts = [entry.S]
    if entry.coefficients:
        texts.append("({})*y'' + ({})*y' + ({})*y = 0".format(*entry.coefficients))
    for text in texts:
        answer = kovacic.solve(text)
        form = answer.closed_form
        assert form is not None
        assert len(answer.solutions) == 2
        # In case 3 Klein's forms are checked numerically, and Gauss' functions of a pull-back exactly.
        assert form.checked == "exact"
        if answer.S.num.height_bits() < 200:
            for real, imaginary in (("0.31", "0.83"), ("-1.7", "0.41"), ("-0.6", "-0.37"), ("2.9", "-0.2")):
                check_at(answer, acb(real, imaginary).mid())


def check_at(answer: kovacic.Solution, point: acb) -> None:
    """Residuals and the Wronskian at another point than the one where the package checks itself."""
    form = answer.closed_form
    assert form is not None
    with flint.ctx.workdps(120):
        for y in answer.solutions:
            assert residual(y, form.variable, answer.S, answer.gauge, point) < arb(10) ** -45
        (y1, d1, _), (y2, d2, _) = (jet(y, form.variable, point) for y in answer.solutions)
        assert abs(y1 * d2 - y2 * d1) > arb(10) ** -50 * (abs(y1 * d2) + abs(y2 * d1))


FORMS = [
    json.loads(line)
    for line in (Path(__file__).parents[1] / "data" / "closed_forms.jsonl").read_text(encoding="utf-8").splitlines()
]


@pytest.mark.parametrize("row", FORMS, ids=lambda row: row["equation"][:60])
def test_closed_forms_are_written_as_in_the_table(row: dict[str, Any]) -> None:
    """Both solutions, notes, what mustn't vanish and where they are real; the next test shows that they are right."""
    form = kovacic.solve(row["equation"], var="x").closed_form
    assert form is not None
    assert [str(form.y1), str(form.y2)] == row["pair"]
    assert [*form.notes] == row.get("notes", [])
    assert [str(u) for u in form.undefined] == row.get("undefined", [])
    assert (str(form.place), form.checked) == (row.get("place", "None"), row.get("checked", "exact"))


@pytest.mark.long
@pytest.mark.parametrize("part", range(4))
def test_closed_forms_of_the_table_are_solutions(part: int) -> None:
    for row in FORMS[part::4]:
        answer = kovacic.solve(row["equation"], var="x")
        assert answer.closed_form is not None
        if answer.closed_form.variable == x:  # else it is a function of x
            check_at(answer, acb("0.31", "0.83").mid())


CASES = [
    strategies.case_1_omega(),
    strategies.case_1_diagonal(),
    strategies.case_1_scalar(),
    strategies.case_1_apparent(),
    strategies.case_2_semi_invariant(),
    strategies.case_2_quaternion(),
    strategies.case_2_dihedral(),
]


@parametrize(
    "strategy",
    CASES,
    ids=["omega", "diagonal", "scalar", "apparent", "curve", "Q8", "dihedral"],
    ordinary=0,
    long=(0, 1, 5),
)
def test_random_equations_of_cases_1_and_2_have_exact_solutions(strategy: object) -> None:
    @generated(8)
    @given(strategy)  # type: ignore[arg-type]
    def check(example: strategies.Example) -> None:
        if example.size > 40:
            return
        answer = kovacic.solve((example.S.num.coefficients(), example.S.den.coefficients()))  # type: ignore[attr-defined]
        assert answer.closed_form is not None
        assert answer.closed_form.checked == "exact"

    check()


@pytest.mark.slow
@pytest.mark.parametrize("strategy", CASES, ids=["omega", "diagonal", "scalar", "apparent", "curve", "Q8", "dihedral"])
def test_many_random_equations(strategy: object) -> None:
    @settings(max_examples=300)
    @given(strategy)  # type: ignore[arg-type]
    def check(example: strategies.Example) -> None:
        if example.size <= 80:
            answer = kovacic.solve((example.S.num.coefficients(), example.S.den.coefficients()))  # type: ignore[attr-defined]
            assert answer.closed_form is not None

    check()


POWERS = [
    Fraction(1, 3) / X + Fraction(1, 2) / (X - 1),
    Fraction(1, 3) / X + 1 / (X - 1),
    Fraction(1, 3) / X + Fraction(4, 3) / (X - 2) + Fraction(1, 2) / (X + 2),
    Fraction(-1, 6) / X + Fraction(1, 6) / (X - 1) + Fraction(1, 2) / (X + 2),
    Fraction(1, 8) / X + Fraction(-1, 8) / (X + 3) + X / (X * X + 1),
    Fraction(1, 3) / X + X / (X * X + 1),
    Fraction(1, 2) / (X - 1) + Fraction(-3, 2) / (X + 1) + 1 / (X - 3),
    Fraction(1, 4) / (X - 1) + Fraction(1, 4) / (X - 2) + 1 / (X - 3),
    Fraction(1, 4) / (X - 1) - Fraction(3, 4) / (X - 2) + 1 / (X + 3),
    Fraction(1, 2) / X - 2 * X + 3 / (X - 2) + 1,
    Fraction(2, 3) / X + 1 + 1 / (X - 2),
    Fraction(1, 2) / X + Fraction(1, 2) / X**2 + 1 / (X + 1),
    1 - 3 / X - 2 * X / (X**2 - 2) + 1 / (X - 3),
    Fraction(-1, 2) / X + Fraction(1, 2) / (X + 2) - 4 / (X - 3),
]


@pytest.mark.parametrize("omega", POWERS, ids=str)
def test_second_solutions_with_fractional_powers_hold_in_every_quadrant(omega: RatFunc) -> None:
    """Roots of products and products of roots differ by constants that depend on the region."""
    answer = kovacic.solve(transform.from_omega(omega).to_str())
    for real, imaginary in (("0.31", "0.83"), ("-1.7", "0.41"), ("-0.6", "-0.37"), ("2.9", "-0.2"), ("1.2", "0.1")):
        check_at(answer, acb(real, imaginary).mid())


@settings(max_examples=8)
@given(strategies.case_2_dihedral())
def test_dihedral_groups_never_leave_an_integral(example: strategies.Example) -> None:
    """All solutions are algebraic, so nothing may be left."""
    answer = kovacic.solve((example.S.num.coefficients(), example.S.den.coefficients()))  # type: ignore[attr-defined]
    assert answer.closed_form is not None
    assert not any(y.has(sympy.Integral) for y in answer.solutions)


def test_solutions_are_real_where_the_coefficient_is() -> None:
    for text in ("-1", "6/x^2 - 1", "-3/(x^2+x+1)^2", "9/(4*x**4 + 24*x**2 + 36)", "-1/x^2", "2", "-x^2*0 - 5/x^4"):
        for y in kovacic.solve(text).solutions:
            value = y.subs(x, sympy.Rational(7, 5)).evalf(30)
            assert value.is_real, (text, y)


def test_ball_on_the_sphere_has_the_algebraic_form() -> None:
    """(sqrt(x - x1) + sqrt(x - x2))^(+-2k) ((x - x1)(x - x2))^(1/4), and neither an integral nor an arc tangent."""
    real = kovacic.solve("(-5*x**2 + 10*x - 170)/(36*x**4 - 144*x**3 - 324*x**2 + 936*x + 1521)")
    r = sympy.sqrt(30) / 2
    k = sympy.Rational(1, 3)
    expected = (2 * x**2 - 4 * x - 13) ** sympy.Rational(1, 4) * (sympy.sqrt(x - 1 + r) + sympy.sqrt(x - 1 - r)) ** (
        2 * k
    )
    assert real.solutions[0] == expected
    conjugate = kovacic.solve("9/(4*x**4 + 24*x**2 + 36)")
    assert conjugate.solutions[0] == sympy.sqrt(x + sympy.sqrt(x**2 + 3)) * (x**2 + 3) ** sympy.Rational(1, 4)


def test_third_kind_residues_are_written_as_powers() -> None:
    S = "(-5907*x**2 + 4290*x - 3675)/(784*x**6 + 6272*x**5 + 4704*x**4 - 31360*x**3 + 19600*x**2)"
    y1, _ = kovacic.solve(S).solutions
    root = sympy.sqrt(30) * sympy.sqrt(x**2 - x)
    expected = (x * (x - 1)) ** sympy.Rational(1, 4) * sympy.sqrt(x + 5)
    expected *= ((11 * x - 2 * root - 5) / (x + 5)) ** sympy.Rational(-1, 14)
    assert y1 == expected


def test_elementary_integrals_on_curves_of_positive_genus_are_done() -> None:
    pull_back = "(-45*x**8+510*x**6+4140*x**4+8820*x**2+5292)/(196*x**10+1960*x**8+7252*x**6+11760*x**4+7056*x**2)"
    y1, _ = kovacic.solve(pull_back).solutions
    power = (2 * x**2 + 2 * sympy.sqrt(x**4 + 5 * x**2 + 6) + 5) ** sympy.Rational(1, 14)
    assert y1 == ((x**2 + 2) * (x**2 + 3)) ** sympy.Rational(1, 4) * power / sympy.sqrt(x)


@pytest.mark.parametrize(
    ("S", "reason"),
    [
        ("(-3*x**4 + 4*x**3 + 24*x + 4)/(16*x**6 + 32*x**3 + 16)", "no logarithmic part"),
        ("(4*x**6 - 8*x**5 + 12*x**4 + 4*x**3 + 7*x**2 - 20*x + 4)/(4*x**4)", "with Ei and erf"),
    ],
)
def test_an_integral_is_left_with_its_reason(S: str, reason: str) -> None:
    answer = kovacic.solve(S)
    assert answer.closed_form is not None
    assert answer.solutions[1].has(sympy.Integral)
    assert len(answer.closed_form.notes) == 1
    assert answer.closed_form.notes[0].startswith("integral left because")
    assert reason in answer.closed_form.notes[0]


def _with_square(g: str, factor: str = "1", exponent: str = "1/4") -> str:
    """S for y1 = factor g^exponent."""
    y1 = sympy.sympify(factor) * sympy.sympify(g) ** sympy.Rational(exponent)
    return str(sympy.factor(sympy.simplify(y1.diff(x, 2) / y1)))


@parametrize(
    ("g", "factor", "exponent", "kinds", "at"),
    [
        ("(1 - x**2)*(4 - x**2)", "1", "1/4", "f", 0.3),
        ("(1 - x**2)*(4 - x**2)", "1", "-1/4", "ef", 0.3),
        ("(1 - x**2)*(4 - x**2)", "1", "-3/4", "ef", 0.3),
        ("(2 - x**2)*(3 - x**2)", "sqrt(x**2 - 1)", "1/4", "p", 0.3),  # irrational branch points, of rational squares
        ("(x**2 - 1)*(x**2 + 4)", "1", "1/4", "f", 0.3),
        ("(x**2 + 1)*(x**2 + 4)", "1", "-1/4", "ef", 0.3),  # no real branch point
        ("x**3 - x", "1", "1/4", "f", -0.3),
        ("x**3 - 2*x", "1", "-1/4", "ef", -0.3),  # irrational branch points
        ("x**4 - x**2 - 1", "1", "1/4", "f", 0.3),
        ("(x - 1)*(x - 2)*(x - 4)", "x", "1/4", "efp", 1.3),
        ("(x + 3)*(x - 1)*(x - 2)*(x - 4)", "1", "-1/4", "efp", 1.3),
        # Conjugate branch points.
        ("x**4 + 1", "1", "1/4", "f", 0.3),
        ("x**4 + 1", "1", "-1/4", "f", -1.7),
        ("x**4 + 1", "1/x", "1/4", "ef", 0.3),
        ("x**4 + x**2 + 1", "1", "1/4", "f", 0.3),
        ("x**4 + x**2 + 1", "1", "-1/4", "ef", 0.3),
        ("x**4 + 3", "1", "-1/4", "f", 0.3),
        ("x**3 - 2", "1", "1/4", "f", 1.5),
        ("x**3 - 2", "1", "-1/4", "f", 1.5),
        ("x**3 + 1", "x", "1/4", "ef", -0.3),
        ("x**3 + x + 1", "1", "-1/4", "ef", 1.5),
        ("(x - 1)*(x - 2)*(x**2 + 1)", "1", "1/4", "f", -0.3),
        ("(1 - x)*(x - 2)*(x**2 + 1)", "1", "1/4", "f", 1.3),
        ("(x - 1)*(x**3 + 2)", "1", "1/4", "f", 1.3),
        # Poles with residues beside these, where g is positive and where it is negative.
        ("x**3 + x", "sqrt(x - 3)", "1/4", "fp", 1.5),
        ("x**3 + x", "sqrt(x - 3)", "1/4", "fp", 0.2),  # tau s < 1
        ("x**3 + x", "sqrt(x + 3)", "1/4", "fp", 1.5),
        ("x**3 + x", "sqrt(x - 1)", "1/4", "f", 1.5),
        ("x**3 + x", "sqrt(x + 1)", "1/4", "f", 1.5),
        ("x**4 + 1", "sqrt(x**2 + 3)", "1/4", "fp", 1.5),
        ("x**3 + 1", "sqrt(x - 3)", "1/4", "fp", 0.5),
        ("x*(x - 4)*(x**2 + 1)", "sqrt(x - 5)", "1/4", "fp", 4.5),
        # Even about another point than 0.
        ("(x**2 + 1)*(x**2 - 2*x + 2)", "1", "1/4", "f", -0.3),
        ("(x**2 + 2*x + 2)*(x**2 + 2*x + 7)", "1", "1/4", "f", 0.3),
    ],
    ordinary=1,
    long=(1, 17, 22, 27),
    always=[("(x**2 + 1)*(x**2 - 2*x + 2)", "1", "1/4", "f", -0.3)],
)
def test_integrals_of_genus_1_are_named(g: str, factor: str, exponent: str, kinds: str, at: float) -> None:
    S = _with_square(g, factor, exponent)
    answer = kovacic.solve(S)
    y = answer.solutions[1]
    names = {"f": sympy.elliptic_f, "e": sympy.elliptic_e, "p": sympy.elliptic_pi}
    assert not y.has(sympy.Integral)
    assert {k for k, function in names.items() if y.has(function)} == set(kinds)
    assert answer.closed_form is not None
    assert answer.closed_form.notes[0].startswith("elliptic integrals because")
    # The values of SymPy's functions, not their derivatives, and a real solution where 0 < t < 1 (up to a constant factor).
    with mpmath.workdps(40):
        y = y.xreplace({root: root.n(50) for root in y.atoms(sympy.CRootOf)})
        value, point = sympy.lambdify(x, y, "mpmath"), mpmath.mpf(at)
        expected = sympy.lambdify(x, sympy.sympify(S), "mpmath")(point) * value(point)
        assert abs(mpmath.diff(value, point, 2) - expected) < 1e-15 * abs(value(point))
        assert abs(mpmath.im(value(point + 0.01) / value(point))) < 1e-30


@pytest.mark.long
def test_the_terms_of_an_elliptic_integral_keep_their_signs_where_the_angle_is_complex() -> None:
    """Left of s = -1, which is x = -1 - sqrt(3): the terms with F, E and the algebraic one have to agree there, too."""
    S = _with_square("x**3 + 1", "x")
    y = kovacic.solve(S).solutions[1]
    with mpmath.workdps(40):
        value, point = sympy.lambdify(x, y, "mpmath"), mpmath.mpf(-5.5)
        expected = sympy.lambdify(x, sympy.sympify(S), "mpmath")(point) * value(point)
        assert abs(mpmath.diff(value, point, 2) - expected) < 1e-15 * abs(value(point))


@pytest.mark.long
@pytest.mark.parametrize(
    ("g", "at"), [("(x - 1)*(x - 2)*(x**2 + 1)", (-3, 0, 3)), ("(x + 1)*(x**3 - 2)", (-2, 2)), ("x**3 + x + 1", (0, 3))]
)
def test_the_angle_of_an_elliptic_integral_is_real_where_the_root_of_g_is(g: str, at: tuple[int, ...]) -> None:
    (integral,) = kovacic.solve(_with_square(g)).solutions[1].atoms(sympy.elliptic_f)
    for point in at:
        assert sympy.im(integral.args[0].subs(x, point).n(20)) == 0


@parametrize(
    ("g", "factor"),
    [
        ("x**3 + k*x + 1", "1"),
        ("x**4 + k*x**2 + x + 1", "1"),
        ("x**4 + x + 1", "1"),
        ("x**3 - 3*x + 1", "1"),
        ("x**4 - 4*x**2 + x + 1", "1"),
        ("x*(x**3 - 3*x + 1)", "1"),
        ("(x**2 - 2)*(x**2 - 3*x + 1)", "1"),
        ("(x**2 - 2)*(x**2 - 8*x + 13)", "1"),
        ("(x**2 - 2)*(x**2 - 8*x + 18)", "x"),
    ],
    ordinary=1,
    long=(1, 5, 7),
)
def test_integrals_whose_branch_points_are_long_are_left_at_once(g: str, factor: str) -> None:
    answer = kovacic.solve(_with_square(g, factor), limits=Limits(seconds=20))
    assert answer.solutions[1].has(sympy.Integral)


def test_the_lemniscates_integral() -> None:
    """int dx/sqrt(x^4 + 1) = F(2 atan(x) | 1/2)/2 [Byrd & Friedman 263.00]."""
    y1, y2 = kovacic.solve(_with_square("x**4 + 1")).solutions
    assert y2 / y1 == sympy.elliptic_f(2 * sympy.atan(x), sympy.Rational(1, 2))


@pytest.mark.long
def test_branch_points_may_be_complex_constants() -> None:
    y1 = ((x - sympy.I) * (x - 2) * (x - 3)) ** sympy.Rational(1, 4)
    S = sympy.factor(sympy.simplify(y1.diff(x, 2) / y1), extension=[sympy.I])
    assert kovacic.solve(S).solutions[1].has(sympy.elliptic_f)


@pytest.mark.long
def test_legendres_modulus_may_be_a_parameter() -> None:
    y = kovacic.solve(_with_square("(1 - x**2)*(1 - k**2*x**2)")).solutions[1]
    (integral,) = y.atoms(sympy.elliptic_f)
    assert integral == sympy.elliptic_f(sympy.asin(x), sympy.Symbol("k") ** 2)


def test_incomplete_gamma_functions_of_a_cube() -> None:
    """y1 = (x^3 + 1) exp(x^3/3): the integral of its inverse square has one of them, as 1F1(s; s + 1; .), real for all x."""
    answer = kovacic.solve(next(entry.S for entry in published.load() if entry.id == "quartic-mu:mu=8"))
    assert answer.closed_form is not None
    assert answer.closed_form.checked == "exact"
    assert answer.solutions[1].has(sympy.hyper)
    check_at(answer, acb("0.31", "0.83").mid())


def test_without_a_solution_there_is_no_closed_form() -> None:
    airy = kovacic.solve("x")
    assert airy.closed_form is None
    assert airy.solutions == ()


@pytest.mark.parametrize("S", ["(2*x^2-1)/x^4", "(6*x^2-1)/x^4", "(2*x^2-4*x-2)/(x-1)^4"])
def test_a_phase_may_begin_with_a_minus_sign(S: str) -> None:
    """The spherical Bessel equation at 1/x: the phase is -1/x, and its sign belongs to the polynomial beside it as well."""
    form = kovacic.solve(S).closed_form
    assert form is not None
    assert form.checked == "exact"
    assert form.y1.has(sympy.cos)


def test_cancellation_is_no_reason_to_fail() -> None:
    """The second solution for Legendre's n = 60 is a tiny difference of two large terms."""
    answer = kovacic.solve("(1-x^2)*y'' - 2*x*y' + 3660*y = 0")
    structure = build(answer.S, answer.decision, answer.gauge)
    form = written(structure, answer.S, answer.gauge, "x")
    assert form.checked == "exact"
    assert sympy.degree(form.y1, x) == 60


@pytest.mark.parametrize("third", ["1/9", "4/25", "2", "-2", "5/7"])
@parametrize(("k", "l"), [(1, 3), (3, 3), (15, 15), (41, 25), (30 + 1, 17), (101, 101)], ordinary=1, long=1)
def test_half_integer_exponent_differences_need_no_roots(k: int, l: int, third: str) -> None:  # noqa: E741
    """Exponent differences k/2, l/2 and a third one of the given square: a conic with (k + l)/2 - 1 zeros of y1 y2."""
    a, b, c = Fraction(k * k, 16) - Fraction(1, 4), Fraction(l * l, 16) - Fraction(1, 4), (Fraction(third) - 1) / 4
    answer = kovacic.solve((a / X**2 + b / (X - 1) ** 2 + (c - a - b) / (X * (X - 1))).to_str())
    form = answer.closed_form
    assert form is not None
    assert form.checked == "exact"
    assert form.notes == ()
    assert not any(y.has(sympy.RootSum, sympy.CRootOf, sympy.Integral) for y in form)
    assert len(str(form.y1)) < 200 + (k + l) ** 2 // 3
    if k < 50:
        check_at(answer, acb("0.31", "0.83").mid())


def test_constants_over_a_number_field_are_roots_of_polynomials_over_q() -> None:
    """omega has a cubic constant over Q(sqrt(2)): SymPy has no roots of such polynomials, and raised NotImplementedError."""
    solution = kovacic.solve("-27*(x-sqrt(2))/(8*((x-sqrt(2))^3-2)^2)")
    assert solution.group.name == "dicyclic of order 8"
    assert all(y.has(sympy.CRootOf) for y in solution.solutions)
    assert all(is_numerical_solution(y, sympy.Symbol("x"), solution.S, solution.gauge) for y in solution.solutions)

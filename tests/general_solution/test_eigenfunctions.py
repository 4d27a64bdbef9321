"""Boundary problems with a parameter in `dsolve`: all its values with a solution other than 0, as textbooks print them."""

import subprocess
import sys
import warnings

import pytest
import sympy

import kovacic


def answered(equation, conditions):
    """The right-hand side of the answer, and what is said beside."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = kovacic.dsolve(equation, ics=conditions)
    return found.rhs, " ".join(str(warning.message) for warning in said)


@pytest.mark.parametrize(
    ("equation", "conditions", "function", "said"),
    [  # Haberman, ch. 2 and 5; Strauss, ch. 4; Boyce & DiPrima, ch. 10 and 11
        ("y''+lambda*y=0", "y(0)=0, y(L)=0", "C1*sin(pi*n*x/L)", "lambda = pi**2*n**2/L**2 with n = 1, 2, 3"),
        ("y''+lambda*y=0", "y'(0)=0, y'(L)=0", "C1*cos(pi*n*x/L)", "lambda = pi**2*n**2/L**2 with n = 0, 1, 2"),
        ("y''+lambda*y=0", "y(0)=0, y'(L)=0", "C1*sin(pi*x*(2*n - 1)/(2*L))", "pi**2*(2*n - 1)**2/(4*L**2) with n = 1"),
        ("y''+lambda*C1*y=0", "y(0)=0, y(1)=0", "C2*sin(pi*n*x)", "lambda = pi**2*n**2/C1 with n = 1, 2, 3"),
        ("y''+lambda*y=0", "y'(0)=0, y(L)=0", "C1*cos(pi*x*(2*n - 1)/(2*L))", "pi**2*(2*n - 1)**2/(4*L**2) with n = 1"),
        (
            "y''+lambda*y=0",
            "y(-L)=y(L), y'(-L)=y'(L)",
            "C1*cos(pi*n*x/L) + C2*sin(pi*n*x/L)",
            "lambda = pi**2*n**2/L**2 with n = 0, 1, 2",
        ),
        (
            "X''+lambda*X=0",
            "X(0)=0, X'(1)+X(1)=0",
            "C1*sin(sqrt(lambda)*x)",
            "tan(sqrt(lambda)) = -sqrt(lambda) other than 0",
        ),
        ("y''+lambda*y=0", "y'(0)=0, y'(L)+h*y(L)=0", "C1*cos(sqrt(lambda)*x)", "tan(L*sqrt(lambda)) = h/sqrt(lambda)"),
        pytest.param(
            "x^2*y''+x*y'+lambda*y=0",
            "y(1)=0, y(b)=0",
            "C1*sin(pi*n*log(x)/log(b))",
            "pi**2*n**2/log(b)**2 with n = 1",
            marks=pytest.mark.long,
        ),
        pytest.param(
            "y''+2*y'+lambda*y=0",
            "y(0)=0, y(L)=0",
            "C1*exp(-x)*sin(pi*n*x/L)",
            "1 + pi**2*n**2/L**2 with n = 1",
            marks=pytest.mark.long,
        ),
        ("y''-lambda*y=0", "y(0)=0, y(1)=0", "C1*sin(pi*n*x)", "lambda = -pi**2*n**2 with n = 1"),
    ],
)
def test_textbook_problems_have_their_families(equation, conditions, function, said):
    found, notes = answered(equation, conditions)
    names = {"n": sympy.Symbol("n", integer=True), "lamda": sympy.Symbol("lambda")}
    assert sympy.simplify(found - sympy.sympify(function.replace("lambda", "lamda"), names)) == 0
    assert said in notes


def test_first_roots_of_a_transcendental_equation_are_proven_numbers():
    _, notes = answered("y''+lambda*y=0", "y(0)=0, y(1)+y'(1)=0")
    assert "lambda = 4.11585836569452" in notes
    _, notes = answered("y''+lambda*y=0", "y(0)=0, y(pi)-2*y'(pi)=0")
    assert "lambda = -0.194592068246260" in notes  # one is negative


def test_zero_is_an_eigenvalue_where_a_straight_line_fulfils_the_conditions():
    _, notes = answered("y''+lambda*y=0", "y(0)=0, y(1)-y'(1)=0")
    assert "tan(sqrt(lambda)) = sqrt(lambda) and for 0" in notes
    assert "0 ± " in notes or "e-" in notes


@pytest.mark.parametrize(
    ("equation", "conditions"),
    [("y''+a*y=0", "y(0)=0, y(1)=0"), ("y''+lambda*y=1", "y(0)=0, y(1)=0"), ("y''+lambda*y=0", "y(0)=0, y(1)=1")],
)
def test_other_boundary_problems_are_answered_as_before(equation, conditions):
    _, notes = answered(equation, conditions)
    assert "with n = " not in notes


def test_the_same_condition_at_both_ends_keeps_the_exponential_solution():
    _, notes = answered("y''+(lambda-1)*y=0", "y(0)=y'(0), y(1)=y'(1)")  # exp(x) for lambda = 0
    assert "lambda*sin(sqrt(lambda - 1)) = 0 other than 1" in notes
    _, notes = answered("y''+lambda*y=0", "y'(0)=h*y(0), y'(L)=-h*y(L)")  # at k = h both sides vanish if cos(h*L) = 0
    assert "tan" not in notes


@pytest.mark.parametrize("conditions", [pytest.param("y(0)=0, y(1)=0", marks=pytest.mark.long), "y(-1)=0, y(1)=0"])
def test_there_is_no_family_on_an_interval_with_a_singular_point(conditions):
    with pytest.raises((NotImplementedError, kovacic.InputError)):
        kovacic.dsolve("x^2*y''+x*y'+lambda*y=0", ics=conditions)


@pytest.mark.long
def test_the_command_writes_powers_in_notices_as_in_solutions() -> None:
    command = [sys.executable, "-m", "kovacic", "dsolve", "y'' + lambda*y = 0", "--ics", "y(0)=0, y(L)=0"]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stderr
    assert "lambda = pi^2*n^2/L^2" in said

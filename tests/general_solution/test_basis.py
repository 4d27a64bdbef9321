"""A pair of solutions knows its Wronskian, for which letters it is no basis, and what holds there."""

from __future__ import annotations

import json
from typing import Any

import pytest
import sympy
from build import parametrize, run, size
from flint import acb, fmpq
from sympy.abc import a, c, k, x

import kovacic
from kovacic.algebra.precision import working_digits
from kovacic.closed_form.jets import jet
from kovacic.general_solution.zero import generic_samples

n_natural = {"n": "natural"}
#: Equations whose solutions come from every maker of pairs, with assumptions.
FAMILIES: list[tuple[str, dict[str, str]]] = [
    ("y'' = (x - a)*y", {}),
    ("y'' = a^2*x*y", {}),
    ("x^2*y'' + x*y' + (k^2*x^2 - n^2)*y = 0", {}),
    ("x^2*y'' + x*y' - (x^2 + n^2)*y = 0", {}),
    ("x^2*y'' + 2*x*y' + (x^2 - n*(n+1))*y = 0", n_natural),
    ("x^2*y'' + x*y' + (x^2 - 1/9)*y = 0", {"x": "positive"}),
    ("y'' = x^3*y", {}),
    ("y'' + a*x^n*y = 0", {}),
    ("y'' + exp(k*x)*y = 0", {}),
    ("x*y'' + (c - x)*y' - a*y = 0", {}),
    ("x*y'' + (c - x)*y' - a*y = 0", {"c": "positive integer"}),
    ("x*y'' + (c - x)*y' - a*y = 0", {"c": "integer"}),
    ("(x - 1)*y'' + (c + 1 - x)*y' - a*y = 0", {}),
    ("y'' + (2/x - l*(l+1)/x^2 - 1/n^2)*y = 0", {"n": "natural", "l": "natural"}),
    ("x*y'' + (1 - x)*y' + n*y = 0", n_natural),
    ("x*y'' + (a + 1 - x)*y' + n*y = 0", n_natural),
    ("x*y'' + (m + 1 - x)*y' + n*y = 0", {"n": "natural", "m": "natural"}),
    ("y'' - 2*x*y' + 2*n*y = 0", {}),
    ("y'' - 2*x*y' + 2*n*y = 0", n_natural),
    ("x*(1-x)*y'' + (c - (a+b+1)*x)*y' - a*b*y = 0", {}),
    ("x*(1-x)*y'' + (c - (a+b+1)*x)*y' - a*b*y = 0", {"c": "positive integer"}),
    ("x*(1-x)*y'' + (1 - 2*x)*y' - y/4 = 0", {}),
    ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", {}),
    ("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0", n_natural),
    ("(1-x^2)*y'' - 2*x*y' + 1/3*y = 0", {}),
    ("(1-x^2)*y'' - (2*a+1)*x*y' + n*(n+2*a)*y = 0", n_natural),
    ("(1-x^2)*y'' - 4*x*y' + n*(n+3)*y = 0", n_natural),
    ("(1-x^2)*y'' + (b - a - (a+b+2)*x)*y' + n*(n+a+b+1)*y = 0", n_natural),
    ("(1-x^2)*y'' - 2*x*y' + (n*(n+1) - 9/(1-x^2))*y = 0", n_natural),
    ("y'' + (a - 2*q*cos(2*x))*y = 0", {}),
    ("y'' + (a - 2*q*cosh(2*x))*y = 0", {}),
    ("y'' + n*(n+1)/cosh(x)^2*y = 0", {}),
    ("x^2*y'' + a*x*y' + b*y = 0", {}),
    ("y'' + a*y' + b*y = 0", {}),
    ("y'' + k^2*y = 0", {"k": "negative"}),
    ("(1-x^2)*y'' - x*y' + n^2*y = 0", {}),
    ("y'' = (x^2 + 3)*y", {}),
    ("x^2*y'' + x*y' + y = 0", {}),
    ("x^2*(x-a)*y'' + x*(2*x-a)*y' + b*y = 0", {}),
]


@parametrize(("equation", "assume"), FAMILIES, ordinary=(0, 6, 12, 25, 38), long=(1, 32))
def test_the_wronskian_is_that_of_the_pair(equation: str, assume: dict[str, str]) -> None:
    """W = y1 y2' - y1' y2 at a point, for letters that fit the assumptions; special functions state theirs."""
    answer = kovacic.answer_to(equation, assume=assume)
    basis = answer.basis
    y1, y2, W = map(answer.question.own, (basis.y1, basis.y2, basis.wronskian))
    assert not W.has(sympy.hyper, sympy.besselj, sympy.legendre, sympy.assoc_laguerre)
    letters = (y1 * y2).free_symbols - {sympy.Symbol("x"), answer.question.function.args[0]}
    sample = next(generic_samples(letters, basis.natural))
    with working_digits(60):
        point = acb(fmpq(37, 101), fmpq(11, 89))
        (u, du, _), (v, dv, _), (w, _, _) = (jet(e.xreplace(sample), basis.x, point) for e in (y1, y2, W))
    assert bool(abs((u * dv - du * v - w).mid()) < fmpq(1, 10**15) * (abs(u * dv) + abs(du * v)).mid())
    assert not w.contains(0)


@pytest.mark.parametrize(
    ("equation", "exceptions"),
    [
        ("y'' + k^2*y = 0", [(k, 0)]),
        ("y'' + a*x*y = 0", [(a, 0)]),
        pytest.param("x*y'' + (c - x)*y' - 2*y/3 = 0", [(c, 1), (c, 3), (c, -2)], marks=pytest.mark.long),
        ("x*(1-x)*y'' + (c - 3*x/2)*y' - y/15 = 0", [(c, 1), (c, 2), (c, 0)]),
    ],
)
def test_exceptional_cases_have_their_own_pair(equation: str, exceptions: list[tuple[Any, int]]) -> None:
    """With the value put in, the answer of the case is the equation's: two independent solutions."""
    answer = kovacic.answer_to(equation)
    for letter, value in exceptions:
        sign = "positive" if value > 0 else "nonpositive"
        names = (f"{letter} = {value}", f"{letter} is a {sign} integer")
        case = next(case for case in answer.exceptions if case.where in names)
        there = case.answer
        assert there is not None
        y1, y2 = (y.subs(letter, value) for y in there.pair)
        A, B, C, _ = (e.subs(letter, value) for e in answer.question.coefficients)
        with working_digits(50):
            point = acb(fmpq(37, 101))
            for y in (y1, y2):
                f, df, d2f = jet(y, x, point)
                p, q, r = (jet(e, x, point)[0] for e in (A, B, C))
                assert bool(abs(p * d2f + q * df + r * f) < fmpq(1, 10**30))
            (u, du, _), (v, dv, _) = (jet(y, x, point) for y in (y1, y2))
            assert not (u * dv - du * v).contains(0)


def test_an_answer_knows_what_it_rests_on() -> None:
    answer = kovacic.answer_to("y'' + k^2*y = 1", assume={"k": "positive"})
    assert answer.eq == kovacic.dsolve("y'' + k^2*y = 1", assume={"k": "positive"})
    assert (answer.basis.y1, answer.basis.y2, answer.basis.wronskian) == (sympy.cos(k * x), sympy.sin(k * x), k)
    assert (answer.particular, answer.unchecked, answer.exceptions) == (k**-2, (), ())
    assert not answer.validity
    assert kovacic.validity(answer) == answer.validity


def test_exceptions_at_poles_of_gamma_functions_are_said_in_integers() -> None:
    laguerre = kovacic.answer_to("x*y'' + (1 - x)*y' + n*y = 0")
    assert str(laguerre.validity) == "x > 0, n is none of 0, 1, 2, ..."
    (case,) = laguerre.exceptions
    assert str(case) == "n is a nonnegative integer"
    assert case.answer.eq.has(sympy.laguerre)
    (periodic,) = kovacic.answer_to("y'' + (a*x^(2*n) + b*x^(n - 1))*y = 0").exceptions
    assert str(periodic) == "sin(pi/(n + 1)) = 0"


@pytest.mark.long
def test_conditions_and_first_order_have_an_answer_too() -> None:
    assert (
        str(kovacic.answer_to("x*y'' + (c - x)*y' - a*y = 0", ics="y(1)=1, y'(1)=0").validity)
        == "x > 0, sin(pi*c) != 0"
    )
    assert str(kovacic.answer_to("y' = k*y/x").validity) == "x > 0"


def test_exceptions_are_in_the_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "--json", "y'' + k^2*y = 0"]) == 0
    assert json.loads(capsys.readouterr().out)["exceptions"] == [{"where": "k = 0", "solution": "C1 + C2*x"}]


@pytest.mark.parametrize(
    "equation", [pytest.param("x*y'' + y' + x*y = 0", marks=pytest.mark.long), "x^2*y'' + x*y' - (x^2 + 1)*y = 0"]
)
def test_beyond_a_singular_point_the_determinant_is_abels(equation: str) -> None:
    """Values at -1 are divided by W = c/x there, not by a combination of Bessel's functions."""
    value = kovacic.dsolve(equation, ics="y(-1)=1, y'(-1)=0").rhs
    assert not sympy.denom(sympy.together(value)).has(sympy.besselj, sympy.besselk)


def _with_an_algebraic_solution(y1: Any, w: Any) -> str:
    """The equation with the solution y1 and the Wronskian w: W'/W = -B, C = -(y1'' + B y1')/y1."""
    B = sympy.cancel(-w.diff(x) / w)
    C = sympy.cancel(sympy.together(-(y1.diff(x, 2) + B * y1.diff(x)) / y1))
    return f"y'' + ({B})*y' + ({C})*y = 0".replace("**", "^")


@parametrize(
    ("polynomial", "pole", "power"),
    [
        (polynomial, pole, power)
        for polynomial in (x, x - 4, x * (x - 4), x**2 + x + 3)
        for pole in (x - 1, x + 2, 2 * x - 3)
        for power in (sympy.Rational(1, 2), sympy.Rational(3, 2), sympy.Rational(5, 2))
    ],
    ordinary=(0,),
    long=(1,),
)
def test_a_second_solution_on_a_curve_is_in_lowest_terms(polynomial: Any, pole: Any, power: Any) -> None:
    """W = c/(x - a)^(e + 1) without arc tangents, on both sides of a; the zeros of y1 are no poles of y2."""
    basis = kovacic.answer_to(_with_an_algebraic_solution(polynomial / pole**power, pole ** (-power - 1))).basis
    W = basis.wronskian
    assert W.is_algebraic_expr(x)
    assert not sympy.diff(sympy.log(W * pole ** (power + 1)), x).expand().simplify()
    for at in (sympy.Rational(-11, 3), sympy.Rational(13, 3)):
        y1, y2 = basis.y1, basis.y2
        numbers = [sympy.N(e.subs(x, at), 40) for e in (y1 * y2.diff(x) - y1.diff(x) * y2, W)]
        assert abs(numbers[0] / numbers[1] - 1) < 1e-12
    below = [sympy.fraction(term)[1] for term in sympy.Add.make_args(basis.y2)]
    assert all(den.subs(x, zero) != 0 for den in below for zero in sympy.roots(polynomial, x))


@pytest.mark.parametrize(
    "c",
    [
        pytest.param(sympy.Rational(7, 3), marks=pytest.mark.long),
        sympy.Rational(-2, 5),
        pytest.param(sympy.Integer(3), marks=pytest.mark.long),
    ],
)
def test_beside_an_elementary_solution_the_constant_is_exact(c: Any) -> None:
    """x^(1-c) (1-x)^(c-2) and 2F1(1, 1; c; x): W = (c - 1) w(x), which vanishes at c = 1, and there alone."""
    answer = kovacic.answer_to("x*(1-x)*y'' + (c-3*x)*y' - y = 0", ics="y(1/2)=1, y'(1/2)=0")
    letter = sympy.Symbol("c")
    assert letter - 1 in answer.basis.dependent
    value = answer.eq.rhs.subs(letter, c)
    assert size(value.subs(x, sympy.S.Half) - 1, 30) < 1e-20
    assert size(value.diff(x).subs(x, sympy.S.Half), 30) < 1e-20
    assert not sympy.denom(sympy.together(answer.eq.rhs)).has(sympy.hyper)


@pytest.mark.parametrize(
    ("equation", "zero"),
    [
        pytest.param(
            "(x^3-x^2)*y'' + (-3*k*x^2+2*k*x+x^2-x)*y' + (2*k^2*x+k*x-2*k-x+1)*y = 0", k - 1, marks=pytest.mark.long
        ),
        ("(x-1)^2*y'' - (a*(x-1)+(x-1)^2)*y' + a*x*y = 0", a - 1),
        pytest.param("(x^3+x^2)*y'' - (2*k*x^2+k*x)*y' + (2*k*x+2*k-2*k^2)*y = 0", 3 * k - 1, marks=pytest.mark.long),
        ("x^2*y'' + x^2*y' - (k^2+k*x+k)*y = 0", 2 * k + 1),
    ],
    ids=["turned", "at 1", "roots of products", "at oo"],
)
def test_the_constant_is_found_where_only_one_branch_or_one_singular_point_shows_it(equation: str, zero: Any) -> None:
    """(D - p)(D - q) y = 0 with a hypergeometric second solution, which is a multiple of the first one at the zero."""
    assert zero in kovacic.answer_to(equation).basis.dependent

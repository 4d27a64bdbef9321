"""A pair of solutions knows its Wronskian, for which letters it is no basis, and what holds there."""

from __future__ import annotations

import json
from itertools import islice
from typing import Any

import pytest
import sympy
from build import parametrize, run
from flint import acb, fmpq
from sympy.abc import a, c, k, x

import kovacic
from kovacic.algebra.precision import working_digits
from kovacic.closed_form.jets import jet
from kovacic.general_solution.zero import samples

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
]


@parametrize(("equation", "assume"), FAMILIES, ordinary=6)
def test_the_wronskian_is_that_of_the_pair(equation: str, assume: dict[str, str]) -> None:
    """W = y1 y2' - y1' y2 at a point, for letters that fit the assumptions; special functions state theirs."""
    answer = kovacic.answer_to(equation, assume=assume)
    basis = answer.basis
    y1, y2, W = map(answer.question.own, (basis.y1, basis.y2, basis.wronskian))
    assert not W.has(sympy.hyper, sympy.besselj, sympy.legendre, sympy.assoc_laguerre)
    letters = (y1 * y2).free_symbols - {sympy.Symbol("x"), answer.question.function.args[0]}
    fits = (s for s in samples(letters) if basis.natural is None or not basis.natural.xreplace(s).is_negative)
    sample = next(islice(fits, 1, None))
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
        ("x*y'' + (c - x)*y' - 2*y/3 = 0", [(c, 1), (c, 3), (c, -2)]),
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
    assert str(laguerre.validity) == "x > 0, -n is none of 0, -1, -2, ..."


def test_conditions_and_first_order_have_an_answer_too() -> None:
    assert (
        str(kovacic.answer_to("x*y'' + (c - x)*y' - a*y = 0", ics="y(1)=1, y'(1)=0").validity)
        == "x > 0, sin(pi*c) != 0"
    )
    assert str(kovacic.answer_to("y' = k*y/x").validity) == "x > 0"


def test_exceptions_are_in_the_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["dsolve", "--json", "y'' + k^2*y = 0"]) == 0
    assert json.loads(capsys.readouterr().out)["exceptions"] == [{"where": "k = 0", "solution": "C1 + C2*x"}]


@pytest.mark.parametrize("equation", ["x*y'' + y' + x*y = 0", "x^2*y'' + x*y' - (x^2 + 1)*y = 0"])
def test_beyond_a_singular_point_the_determinant_is_abels(equation: str) -> None:
    """Values at -1 are divided by W = c/x there, not by a combination of Bessel's functions."""
    value = kovacic.dsolve(equation, ics="y(-1)=1, y'(-1)=0").rhs
    assert not sympy.denom(sympy.together(value)).has(sympy.besselj, sympy.besselk)

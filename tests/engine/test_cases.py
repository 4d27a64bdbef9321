"""Every published equation: the case, the degree of omega, the closed form where it is given, and the verification."""

from __future__ import annotations

from functools import cache

import published
import pytest
import textbook
from build import parametrize
from published import Published

import kovacic
from kovacic import Solution

ENTRIES = published.load()
BY_ID = [pytest.param(entry, id=entry.id) for entry in ENTRIES]


@cache
def solved(S: str) -> Solution:
    return kovacic.solve(S)


def test_there_are_enough_of_every_kind() -> None:
    degrees = [entry.omega_degree for entry in ENTRIES]
    assert len(ENTRIES) == len({entry.id for entry in ENTRIES}) >= 170
    assert {degree: degrees.count(degree) >= 8 for degree in (None, 1, 2, 4, 6, 12)} == dict.fromkeys(
        (None, 1, 2, 4, 6, 12), True
    )


@parametrize("entry", BY_ID, ordinary=78, long=45)
def test_case_and_degree_are_as_published(entry: Published) -> None:
    answer = solved(entry.S)
    assert answer.case == entry.case
    assert (answer.riccati.degree if answer.riccati else None) == entry.omega_degree
    assert answer.verified


@parametrize("entry", [e for e in BY_ID if e.values[0].coefficients], ordinary=3, long=10)
def test_normal_form_of_the_given_equation(entry: Published) -> None:
    """S is the normal form of `a y'' + b y' + c y = 0`: checked with SymPy, which the engine doesn't use."""
    sympy = pytest.importorskip("sympy")
    x = sympy.Symbol("x")
    a, b, c = (sympy.sympify(text) for text in entry.coefficients or ())
    p = b / a
    assert sympy.cancel(sympy.diff(p, x) / 2 + p**2 / 4 - c / a - sympy.sympify(entry.S)) == 0


@parametrize("entry", [e for e in BY_ID if e.values[0].solution and e.values[0].case == 1], ordinary=0, long=1)
def test_published_solution_is_one_of_ours(entry: Published) -> None:
    """Where omega is unique it's that of the published solution; that solution is checked against S first."""
    sympy = pytest.importorskip("sympy")
    x = sympy.Symbol("x")
    y = sympy.sympify(entry.solution)
    if entry.coefficients is not None:  # the solution of a y'' + b y' + c y = 0: y exp(1/2 int b/a) has normal form
        a, b, c = (sympy.sympify(text) for text in entry.coefficients)
        assert sympy.simplify(a * sympy.diff(y, x, 2) + b * sympy.diff(y, x) + c * y) == 0
        omega = sympy.diff(y, x) / y + b / (2 * a)
    else:
        omega = sympy.diff(y, x) / y
    omega = sympy.simplify(omega)
    assert sympy.simplify(sympy.diff(omega, x) + omega**2 - sympy.sympify(entry.S)) == 0
    ours = solved(entry.S)
    if entry.group == "Borel":
        assert sympy.simplify(omega - sympy.sympify(str(ours.omega))) == 0


@parametrize("entry", [e for e in BY_ID if len(e.values[0].S) < 300], ordinary=28, long=60)
def test_textbook_search_agrees(entry: Published) -> None:
    answer = solved(entry.S)
    try:
        expected = textbook.decide(answer.S.num.coefficients(), answer.S.den.coefficients(), limit=20_000)  # type: ignore[attr-defined]
    except textbook.OutOfDomainError:
        pytest.skip("poles outside Q, or too many families")
    assert (answer.case, answer.riccati.degree if answer.riccati else None) == expected

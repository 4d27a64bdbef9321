"""Equations of the textbooks' chapters on constant coefficients, Euler, Bessel, Legendre, Hermite, Laguerre and Riccati.

Each is given as it's printed, with a solution that the books give, or None where there is no closed form.  The answer must
contain the books' solution in its span, and be no longer than that needs.
"""

from __future__ import annotations

import pytest
import sympy
from build import parametrize, read_expression

import kovacic

EQUATIONS: list[tuple[str, tuple[str, ...] | None]] = [
    # constant coefficients
    ("y'' + y = 0", ("cos(x)", "sin(x)")),
    ("y'' - y = 0", ("exp(x)", "exp(-x)")),
    ("y'' - 3*y' + 2*y = 0", ("exp(x)", "exp(2*x)")),
    ("y'' + 2*y' + y = 0", ("exp(-x)", "x*exp(-x)")),
    ("y'' + 2*y' + 5*y = 0", ("exp(-x)*cos(2*x)", "exp(-x)*sin(2*x)")),
    ("y'' - 2*y = 0", ("exp(sqrt(2)*x)", "exp(-sqrt(2)*x)")),
    ("y'' - 4*y' + 13*y = 0", ("exp(2*x)*cos(3*x)", "exp(2*x)*sin(3*x)")),
    ("y'' = 0", ("1", "x")),
    ("y'' + 4*y' = 0", ("1", "exp(-4*x)")),
    ("y'' + y' + y = 0", ("exp(-x/2)*cos(sqrt(3)*x/2)", "exp(-x/2)*sin(sqrt(3)*x/2)")),
    # Euler
    ("x^2*y'' - 2*y = 0", ("x^2", "1/x")),
    ("x^2*y'' + x*y' - y = 0", ("x", "1/x")),
    ("x^2*y'' - x*y' + y = 0", ("x", "x*log(x)")),
    ("x^2*y'' + x*y' + y = 0", ("cos(log(x))", "sin(log(x))")),
    ("x^2*y'' + 3*x*y' + 2*y = 0", ("cos(log(x))/x", "sin(log(x))/x")),
    ("4*x^2*y'' + y = 0", ("sqrt(x)", "sqrt(x)*log(x)")),
    ("2*x^2*y'' + 3*x*y' - y = 0", ("sqrt(x)", "1/x")),
    ("x^2*y'' + 5*x*y' + 4*y = 0", ("1/x^2", "log(x)/x^2")),
    ("x^2*y'' - 3*y = 0", ("x^(1/2 + sqrt(13)/2)", "x^(1/2 - sqrt(13)/2)")),
    ("(x-1)^2*y'' - 2*(x-1)*y' + 2*y = 0", ("x - 1", "(x-1)^2")),
    # Bessel
    ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", ("cos(x)/sqrt(x)", "sin(x)/sqrt(x)")),
    ("x^2*y'' + x*y' + (x^2 - 9/4)*y = 0", ("(sin(x)/x - cos(x))/sqrt(x)", "(cos(x)/x + sin(x))/sqrt(x)")),
    ("x^2*y'' + x*y' + (x^2 - 25/4)*y = 0", ("((3/x^2 - 1)*sin(x) - 3*cos(x)/x)/sqrt(x)",)),
    ("x^2*y'' + x*y' - (x^2 + 1/4)*y = 0", ("exp(x)/sqrt(x)", "exp(-x)/sqrt(x)")),
    ("x^2*y'' + 2*x*y' + x^2*y = 0", ("sin(x)/x", "cos(x)/x")),
    ("x^2*y'' + 2*x*y' + (x^2 - 2)*y = 0", ("sin(x)/x^2 - cos(x)/x", "cos(x)/x^2 + sin(x)/x")),
    ("x*y'' + y' + x*y = 0", None),
    ("x^2*y'' + x*y' + (x^2 - 1)*y = 0", None),
    ("y'' = x*y", None),
    ("4*x*y'' + 2*y' + y = 0", ("cos(sqrt(x))", "sin(sqrt(x))")),
    # Legendre, Chebyshev, Gegenbauer
    ("(1-x^2)*y'' - 2*x*y' = 0", ("1", "log((1+x)/(1-x))")),
    ("(1-x^2)*y'' - 2*x*y' + 2*y = 0", ("x", "x*log((1+x)/(1-x))/2 - 1")),
    ("(1-x^2)*y'' - 2*x*y' + 6*y = 0", ("3*x^2 - 1",)),
    ("(1-x^2)*y'' - 2*x*y' + 12*y = 0", ("5*x^3 - 3*x",)),
    ("(1-x^2)*y'' - 2*x*y' + y = 0", None),
    ("(1-x^2)*y'' - x*y' + 4*y = 0", ("2*x^2 - 1", "x*sqrt(1-x^2)")),
    ("(1-x^2)*y'' - x*y' + 9*y = 0", ("4*x^3 - 3*x", "(4*x^2 - 1)*sqrt(1-x^2)")),
    ("(1-x^2)*y'' - 3*x*y' + 8*y = 0", ("4*x^2 - 1",)),
    ("(1-x^2)*y'' - x*y' + y/4 = 0", ("sqrt(1+x)", "sqrt(1-x)")),
    # Hermite, Laguerre, Weber
    ("y'' - 2*x*y' + 2*y = 0", ("x",)),
    ("y'' - 2*x*y' + 4*y = 0", ("2*x^2 - 1",)),
    ("y'' - 2*x*y' + 8*y = 0", ("4*x^4 - 12*x^2 + 3",)),
    ("y'' - 2*x*y' + y = 0", None),
    ("y'' - x*y' - y = 0", ("exp(x^2/2)",)),
    ("y'' + (3 - x^2)*y = 0", ("x*exp(-x^2/2)",)),
    ("x*y'' + (1-x)*y' + y = 0", ("1 - x",)),
    ("x*y'' + (1-x)*y' + 2*y = 0", ("x^2 - 4*x + 2",)),
    ("x*y'' + (2-x)*y' + y = 0", ("2 - x",)),
    ("x*y'' + (1-x)*y' + y/2 = 0", None),
    # reduction of order and others
    ("x*y'' - (x+1)*y' + y = 0", ("exp(x)", "x + 1")),
    ("(x^2+1)*y'' - 2*x*y' + 2*y = 0", ("x", "x^2 - 1")),
    ("x^4*y'' + 2*x^3*y' + y = 0", ("cos(1/x)", "sin(1/x)")),
    ("(x-1)*y'' - x*y' + y = 0", ("x", "exp(x)")),
    ("x*y'' - y' + 4*x^3*y = 0", ("cos(x^2)", "sin(x^2)")),
]


def test_there_are_fifty() -> None:
    assert len(EQUATIONS) >= 50


def values(expression: sympy.Expr) -> list[sympy.Expr]:
    x = sympy.Symbol("x")
    return [sympy.N(expression.subs(x, sympy.Rational(point)), 40) for point in ("3/10", "2/5", "11/20")]


@parametrize(("text", "expected"), EQUATIONS, ordinary=7, ids=[text for text, _ in EQUATIONS])
def test_the_answer_is_the_books(text: str, expected: tuple[str, ...] | None) -> None:
    answer = kovacic.solve(text)
    assert answer.verified
    if expected is None:
        assert answer.status is kovacic.Status.NONE_EXISTS
        assert answer.solutions == ()
        return
    y1, y2 = answer.solutions
    columns = [values(y1), values(y2)]
    assert sympy.Matrix(columns).rank() == 2
    longest = 0
    for book in expected:
        solution = read_expression(book)
        determinant = sympy.Matrix([*columns, values(solution)]).det()
        assert abs(determinant) < 1e-30
        longest = max(longest, len(str(solution)))
    assert min(len(str(y1)), len(str(y2))) <= 2 * longest + 10
    if len(expected) == 2:
        assert max(len(str(y1)), len(str(y2))) <= 3 * longest + 15


@pytest.mark.parametrize("text", [text for text, expected in EQUATIONS if expected is None][:3])
def test_a_no_is_explained(text: str) -> None:
    assert "this is a proof" in kovacic.solve(text).explain()


RICCATI = [
    ("1", "0", "1", 2),  # w' = 1 + w^2
    ("1", "0", "-1", 2),  # w' = 1 - w^2
    ("-2/x^2", "0", "1", 0),  # w' = w^2 - 2/x^2, all of whose solutions are rational
    ("x^2 + 1", "-2*x", "1", 0),  # w' = 1 + (w - x)^2, likewise
    ("1/x^2", "-1/x", "-1", 0),  # likewise
    ("x^2", "0", "1", 0),  # Riccati's own
    ("2", "-2*x", "0 + 1", 1),
    ("-3/(4*x^2)", "0", "1", 0),  # all are rational, from u = (x^2 + C)/sqrt(x)
]


@parametrize(("p", "q", "r", "count"), RICCATI, ordinary=(0, 1, 2, 4, 5, 6, 7))
def test_riccati_equations(p: str, q: str, r: str, count: int) -> None:
    x = sympy.Symbol("x")
    found = kovacic.solve_riccati(p, q, r)
    P, Q, R = (read_expression(text) for text in (p, q, r))
    assert len(found.rational) == count
    for w in [*found.rational, *([] if found.family is None else [found.family])]:
        assert sympy.simplify(w.diff(x) - P - Q * w - R * w**2) == 0

"""The check behind `dsolve` refuses forged answers of every kind, and passes the right ones.

Each row has an equation, its conditions, a right answer, and answers that differ from it in one respect.
"""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from sympy import (
    DiracDelta,
    Function,
    Heaviside,
    I,
    Integral,
    Symbol,
    cos,
    cosh,
    exp,
    log,
    nan,
    oo,
    pi,
    sin,
    sinh,
    sqrt,
    zoo,
)

import kovacic
from kovacic.errors import VerificationFailed
from kovacic.general_solution.check import check_answer
from kovacic.general_solution.places import limit_points
from kovacic.general_solution.question import Question, read_question

x, s, k, m = sympy.symbols("x s k m")
C1, C2 = sympy.symbols("C1 C2")
g = Function("g")
n = Symbol("n", integer=True, positive=True)
y = Function("y")

STEP = Heaviside(x - 1)


def from_(start: int, integrand: Any) -> Any:
    return Integral(integrand, (s, start, x))


WITH_COS, WITH_SIN = (from_(0, wave(s) * g(s)) for wave in (cos, sin))
#: Equations whose right-hand side has pieces, a right answer, forged ones.
PIECES: list[tuple[Any, Any, list[Any]]] = [
    # A step: wrong before it, wrong behind it, a jump of y, a jump of y'.
    (
        "y'' + y = Heaviside(x - 1)",
        STEP * (1 - cos(x - 1)),
        [
            STEP * (1 - cos(x - 1)) + 1,
            2 * STEP * (1 - cos(x - 1)),
            STEP * 1,
            STEP * (1 - cos(x - 1) + sin(x - 1)),
            (1 - STEP) * (1 - cos(x - 1)),
        ],
    ),
    # An impulse makes y' jump by 1: no jump, twice the jump, the opposite one, one of y, one elsewhere.
    (
        "y'' + y = DiracDelta(x - 1)",
        STEP * sin(x - 1),
        [sin(x - 1), 2 * STEP * sin(x - 1), -STEP * sin(x - 1), STEP * cos(x - 1), Heaviside(x - 2) * sin(x - 2)],
    ),
    # With damping and its derivative: y jumps by 1, and y' by -b.
    (
        "y'' + 3*y' + 2*y = Derivative(DiracDelta(x), x)",
        Heaviside(x) * (2 * exp(-2 * x) - exp(-x)),
        [
            Heaviside(x) * exp(-2 * x),
            Heaviside(x) * (2 * exp(-x) - exp(-2 * x)),
            Heaviside(x) * (exp(-x) - exp(-2 * x)),
        ],
    ),
    # Two steps: one of them is forgotten.
    (
        "y'' = Heaviside(x) - Heaviside(x - 1)",
        Heaviside(x) * x**2 / 2 - STEP * (x - 1) ** 2 / 2,
        [Heaviside(x) * x**2 / 2, x**2 / 2 - STEP * (x - 1) ** 2 / 2, Heaviside(x) * x**2 / 2 + STEP * (x - 1) ** 2],
    ),
    # Integrals that begin at the step, and others.
    (
        "y'' = Heaviside(x - 1)*exp(x^2)",
        STEP * (x * from_(1, exp(s**2)) - from_(1, s * exp(s**2))),
        [
            STEP * (x * from_(0, exp(s**2)) - from_(1, s * exp(s**2))),
            STEP * (x * from_(1, exp(s**2)) - from_(0, s * exp(s**2))),
            STEP * (x * from_(1, exp(s**2)) + from_(1, s * exp(s**2))),
        ],
    ),
    # A cusp of the right-hand side.
    ("y'' - y = Abs(x)", -sympy.Abs(x) + sympy.exp(-sympy.Abs(x)) * -1, [-sympy.Abs(x), -x, sympy.Abs(x)]),
    # A function that is given by its name: another sign, another kernel, another function, half of the answer.
    (
        sympy.Eq(y(x).diff(x, 2) + y(x), g(x)),
        sin(x) * WITH_COS - cos(x) * WITH_SIN,
        [
            sin(x) * WITH_COS + cos(x) * WITH_SIN,
            sin(x) * WITH_SIN - cos(x) * WITH_COS,
            sin(x) * from_(0, cos(s) * g(s) ** 2) - cos(x) * WITH_SIN,
            sin(x) * WITH_COS,
            g(x),
        ],
    ),
]

#: Equation, conditions, a right answer, forged ones.
ANSWERS: list[tuple[Any, Any, Any, list[Any]]] = [
    # Rational coefficients over Q.
    ("y'' + y = 0", None, C1 * sin(x) + C2 * cos(x), [C1 * sin(2 * x), sin(x) + x, exp(x), sinh(x)]),
    ("x^2*y'' + x*y' - y = 0", None, C1 * x + C2 / x, [C1 * x**2, x + 1, log(x)]),
    # A right-hand side, rational or not.
    ("y'' + y = x", None, x + sin(x), [sin(x), 2 * x, x + 1]),
    ("y'' - y = sin(x)", None, -sin(x) / 2, [sin(x) / 2, -cos(x) / 2, exp(x)]),
    # Parameters, and constants of an algebraic field.
    ("y'' + k^2*y = 0", None, sin(k * x), [sin(x), sin(2 * k * x), sinh(k * x), k * x]),
    ("y'' - 2*y = sqrt(2)*x", None, -sqrt(2) * x / 2, [sqrt(2) * x / 2, x / 2, -sqrt(2) * x]),
    ("y'' + I*y = 0", None, exp(sqrt(2) * (1 - I) * x / 2), [exp(sqrt(2) * (1 + I) * x / 2), exp(I * x)]),
    # Coefficients in exp(x): the equation in the user's variable, the rational one in another.
    (
        "y'' - y' + exp(2*x)*y = 0",
        None,
        sin(exp(x)) + C1 * cos(exp(x)),
        [sin(x), sin(exp(2 * x)), sin(exp(-x)), exp(x)],
    ),
    ("y'' - y' + exp(2*x)*y = exp(2*x)", None, sin(exp(x)) + 1, [sin(exp(x)), sin(exp(x)) + 2, sin(exp(x)) + exp(x)]),
    # Beside exp(2 x) the right-hand side has x, which is no rational function of it.
    ("y'' - y' + exp(2*x)*y = x*exp(2*x) - 1", None, x, [-x, x + 1, x * exp(x), 2 * x]),
    # Values of y and y', sums of them, conditions with letters; answers that satisfy the equation, and only that.
    ("y'' + y = 0", {"y(0)": 1, "y'(0)": 2}, cos(x) + 2 * sin(x), [cos(x), 2 * sin(x), cos(x) - 2 * sin(x)]),
    ("y'' + y = 0", {"y(0)": k, "y(pi/2)": m}, k * cos(x) + m * sin(x), [m * cos(x) + k * sin(x), k * cos(x)]),
    ("y'' = 0", "y(0) + 2*y'(0) = 3, y(1) = 2", 1 + x, [2 * x, 3 - x, 1 - x]),
    ("y'' - y = 0", {"y(0)": 0, "y'(0)": 1}, sinh(x), [cosh(x), exp(x), 2 * sinh(x)]),
    # No value at all.
    ("y'' + y = 0", None, sin(x), [nan, oo * sin(x), zoo, sin(x) + oo]),
]


def asked(equation: Any, conditions: Any = None) -> Question:
    sought = None if isinstance(equation, str) else y(x)
    return read_question(equation, sought, conditions, None, kovacic.Limits())


def refused(question: Question, value: Any) -> None:
    with pytest.raises(VerificationFailed, match="please report the equation"):
        check_answer(question, value)


@pytest.mark.parametrize(
    ("equation", "right", "forged"), PIECES, ids=lambda value: value if isinstance(value, str) else ""
)
def test_answers_with_pieces_are_compared_on_every_piece_and_at_the_breaks(
    equation: Any, right: Any, forged: list[Any]
) -> None:
    question = asked(equation)
    assert check_answer(question, right) == []
    for value in forged:
        refused(question, value)


@pytest.mark.parametrize(
    ("equation", "conditions", "right", "forged"), ANSWERS, ids=lambda value: value if isinstance(value, str) else ""
)
def test_forged_answers_are_refused(equation: str, conditions: Any, right: Any, forged: list[Any]) -> None:
    question = asked(equation, conditions)
    assert check_answer(question, right) == []
    for value in forged:
        refused(question, value)


def test_what_is_violated_is_named() -> None:
    question = asked("y'' + y = 0", {"y(0)": 1, "y'(0)": 2})
    with pytest.raises(VerificationFailed, match=r"doesn't satisfy y'\(0\) = 2"):
        check_answer(question, cos(x))
    with pytest.raises(VerificationFailed, match="doesn't satisfy the equation"):
        check_answer(question, cos(2 * x))
    with pytest.raises(VerificationFailed, match="has no value"):
        check_answer(question, nan)


def test_a_limit_is_not_a_value() -> None:
    """A condition at a point among the `limits` is refuted by values near it."""
    question = asked("x*y'' + y' = 0", {"y(0)": 3})
    assert check_answer(question, sympy.Integer(3), limits=limit_points(question)) == []
    refused(question, sympy.Integer(2))


def test_the_side_of_a_singular_point_matters() -> None:
    """sqrt(x^2) is x on the right of 0 and -x on the left, and x log(x) a second solution there alone."""
    question = asked("x^2*y'' - x*y' + y = x^2")
    right, left = (sympy.Integer(value) for value in (2, -2))
    value = x**2 + x * log(x)
    assert check_answer(question, value, right) == []
    forged = x**2 + sympy.sqrt(x**2) * log(x) + sympy.sqrt(x**2) - x + Heaviside(-x)
    with pytest.raises(VerificationFailed):
        check_answer(question, forged, left)


def test_integer_symbols_get_integers() -> None:
    """sin(n pi) is 0 for integers alone."""
    equation = sympy.Eq(y(x).diff(x, 2) + n**2 * y(x), 0)
    question = asked(equation, {y(pi): 0, y(0): 0})
    assert check_answer(question, sin(n * x)) == []
    refused(question, cos(n * x))
    refused(question, sin(n * x / 2))


def test_any_jump_is_right_at_a_singular_point_only() -> None:
    """At the singular point 0 the pieces are independent; at 1, where the right-hand side has its step, they aren't."""
    question = asked("x^2*y'' + x*y' - y = Heaviside(x - 1)")
    right = STEP * (x / 2 + 1 / (2 * x) - 1)
    assert check_answer(question, right) == []
    assert check_answer(question, right + Heaviside(x) * x) == []
    refused(question, right + STEP * x)
    refused(question, 2 * right)


def test_a_vanishing_impulse_has_no_effect() -> None:
    """x delta(x) is 0: an answer with its impulse is a forged one."""
    question = asked(sympy.Eq(y(x).diff(x, 2), x * DiracDelta(x) + DiracDelta(x - 1)))
    assert check_answer(question, STEP * (x - 1)) == []
    refused(question, STEP * (x - 1) + Heaviside(x) * x)

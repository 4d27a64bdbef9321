"""The whole question, put to the answer: the equation at a point, the conditions where they are given; and no infinities.

What is checked is what is returned, in the user's symbols, at values of the parameters that fit their assumptions.  A value at
a singular point or at infinity was a statement on all monomials of the expansion, and isn't computed again.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import islice
from typing import Any

import sympy
from flint import acb, arb, ctx, fmpq

from kovacic.algebra.rationals import QQ
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.check import DIGITS
from kovacic.closed_form.check import value_at as value_of_fraction
from kovacic.closed_form.jets import jet
from kovacic.errors import VerificationFailed
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.question import Question
from kovacic.general_solution.values import value_at
from kovacic.general_solution.zero import ball, samples
from kovacic.reading.change_of_variable import function_of_x

Expr = Any  # SymPy publishes no types
_INFINITE = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}
#: The distance from the point that is meant, at which the equation is tested.
_STEP = fmpq(3, 7 * 101)
#: How small a residual is, by the size of its terms.
_SMALL = arb(10) ** (-DIGITS // 2)


def check_answer(question: Question, value: Expr, start: Expr | None, limits: Sequence[Expr]) -> None:
    """Raises `VerificationFailed` where the answer isn't one: a defect of this package.

    `value` is the answer in the variable of the question, `start` an ordinary point on the side that is meant, and `limits`
    are the points at which conditions are on limits.
    """
    if not is_finite(value):
        raise _failed(question, value, "has no value")
    if _is_wrong_at(question, value, start):
        raise _failed(question, value, "doesn't satisfy the equation")
    for condition in question.conditions:
        if not set(condition.points) & set(limits) and _is_violated(question, value, condition):
            raise _failed(question, value, f"doesn't satisfy {condition.text}")


def is_finite(value: Expr) -> bool:
    """Does neither nan nor an infinity occur, but as a bound of an integral?"""
    if isinstance(value, sympy.Integral):
        return is_finite(value.function)
    return value not in _INFINITE and all(map(is_finite, value.args))


def _failed(question: Question, value: Expr, what: str) -> VerificationFailed:
    return VerificationFailed(f"an answer for {question.equation} {what}; please report the equation: {value}")


def _sampled(expression: Expr, symbols: set[Expr], number: int) -> Expr:
    """With values in the places of those of the symbols that are integers or not positive; others have values by name."""
    special = {s for s in symbols if s.is_integer or s.is_negative or s.is_nonpositive}
    if not special:
        return expression
    sample = next(islice(samples(special), number, None))
    return expression.xreplace(sample)


def _is_wrong_at(question: Question, value: Expr, start: Expr | None) -> bool:
    """Is the residual seen not to be zero at a point?  False where the functions can't be evaluated."""
    x = question.x
    if value.has(sympy.Heaviside, sympy.DiracDelta):
        return False
    definite = [integral for integral in value.atoms(sympy.Integral) if not integral.has_free(x)]
    value = value.xreplace(dict.fromkeys(definite, sympy.Integer(1)))  # they are factors of y1 and y2
    middle = None if start is None else ball(_sampled(start, start.free_symbols, 1))
    base = acb(fmpq(23, 71), fmpq(0) if start is not None else fmpq(41, 89)) if middle is None else middle
    with ctx.workdps(DIGITS), suppress(NotImplementedError, ZeroDivisionError, AttributeError, ValueError):
        return _residual_is_large(question, value, base + arb(_STEP))
    return False


def _residual_is_large(question: Question, value: Expr, point: Any) -> bool:
    equation, x = question.equation, question.x
    if equation.change is None and equation.a.field == QQ:
        y = value
        a, b, c, f = (value_of_fraction(part, point) for part in (equation.a, equation.b, equation.c, equation.f))
        f += 0 if equation.h is None else jet(equation.h, x, point)[0]
    else:
        parts = [question.own(part) for part in _coefficients(question)]
        symbols = {s for e in (value, *parts) for s in e.free_symbols if s != x}
        y = _sampled(value, symbols, 1)
        a, b, c, f = (jet(_sampled(part, symbols, 1), x, point)[0] for part in parts)
    own, slope, second = jet(y, x, point)
    terms = [a * second, b * slope, c * own, -f]
    return bool(abs(sum(terms)) > _SMALL * sum(map(abs, terms), arb(0)))


def _coefficients(question: Question) -> tuple[Expr, Expr, Expr, Expr]:
    """a, b, c and the right-hand side, in the variable of the question."""
    equation = question.equation
    t = sympy.Symbol(equation.variable)
    atoms = Atoms(t)
    plain = {sympy.Symbol("pi"): sympy.pi, sympy.Symbol("e"): sympy.E}
    a, b, c = (atoms.ratio(part).xreplace(plain) for part in (equation.a, equation.b, equation.c))
    f = (atoms.sum(equation.f) + (equation.h or 0)).xreplace(plain)
    if equation.change is None:
        return a, b, c, f
    value = function_of_x(equation)
    slope = value.diff(question.x)
    a, b, c, f = (part.subs(t, value) for part in (a, b, c, f))
    return a / slope**2, b / slope - a * slope.diff(question.x) / slope**3, c, f


def _is_violated(question: Question, value: Expr, condition: Condition) -> bool:
    """Is the difference of the two sides of a condition seen not to be zero?"""
    assert condition.value is not None
    total = -condition.value
    try:
        for term in condition.terms:
            total += term.coefficient * value_at(value, question.x, term.point, term.order)
    except NotImplementedError:
        return False
    difference = _sampled(total, total.free_symbols, 1)
    with ctx.workdps(2 * DIGITS):
        found = ball(difference)
        return found is not None and found.is_finite() and bool(abs(found) > _SMALL)

"""From conditions on y = C1 y1 + C2 y2 + y0 to linear equations for C1 and C2.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), where everything is in the user's symbols, so
that sin(n pi) is 0 before anything is compared.
"""

from __future__ import annotations

from typing import Any

import sympy

from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.constants import Case, Row, determine
from kovacic.general_solution.question import Question
from kovacic.general_solution.values import value_at
from kovacic.general_solution.variation import Basis
from kovacic.general_solution.zero import agree

Expr = Any  # SymPy publishes no types


def constants_of(
    question: Question, basis: Basis, particular: Expr, names: tuple[Expr, Expr]
) -> tuple[Case, list[Case]]:
    """What the conditions determine: for generic parameters, and for particular ones."""
    functions = [question.own(e) for e in (basis.y1, basis.y2, particular)]
    rows = [_row(condition, functions, question.x) for condition in question.conditions]
    return determine(rows, names, _wronskian(question, basis, rows))


def _row(condition: Condition, functions: list[Expr], x: Expr) -> Row:
    u, v, w = (_applied(condition, function, x) for function in functions)
    return Row(u, v, condition.value - w)


def _applied(condition: Condition, function: Expr, x: Expr) -> Expr:
    """l(y)."""
    values = (term.coefficient * value_at(function, x, term.point, term.order) for term in condition.terms)
    return sympy.Add(*values)


def _wronskian(question: Question, basis: Basis, rows: list[Row]) -> Expr | None:
    """For y and y' at one point, given first: the determinant, which isn't zero, in a form that is short; else None."""
    first_two = question.conditions[:2]
    if len(first_two) < 2 or not all(condition.is_value for condition in first_two):
        return None
    (first,), (second,) = (condition.terms for condition in first_two)
    if first.point != second.point or first.order == second.order:
        return None
    determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
    if determinant.is_Rational:
        return determinant
    sign = 1 if first.order == 0 else -1
    W = sign * question.own(value_at(basis.wronskian, basis.x, first.point))
    return W if agree(W, determinant) else determinant

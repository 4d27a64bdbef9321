"""From conditions on y = C1 y1 + C2 y2 + y0 to linear equations for C1 and C2.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), where everything is in the user's symbols, so
that sin(n pi) is 0 before anything is compared.

At a singular point and at infinity, y1, y2 and y0 are sums of monomials (`expansion`).  That y is bounded says that the
coefficients of all unbounded monomials in C1 y1 + C2 y2 + y0 are zero, a row for each; that y tends to v says that those of
the oscillating ones are zero as well, and the constant term is v.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.behaviour import Place, behaviour
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.constants import Case, Outcome, Row, determine
from kovacic.general_solution.expansion import CONSTANT, Expansion, Monomial, UnknownBehaviour
from kovacic.general_solution.question import Question
from kovacic.general_solution.values import value_at
from kovacic.general_solution.variation import Basis
from kovacic.general_solution.zero import agree

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)


@dataclass(frozen=True)
class Limit:
    """The rows of a condition on a limit; `uncertain`: the solutions (0, 1) of which too little is known to be part of y."""

    rows: tuple[Row, ...]
    uncertain: frozenset[int]


def constants_of(
    question: Question, basis: Basis, particular: Expr, names: tuple[Expr, Expr], limits: dict[Expr, Place]
) -> tuple[Case, list[Case]]:
    """What the conditions determine: for generic parameters, and for particular ones.

    Raises `NotImplementedError` where too little is known about the solutions.
    """
    functions = [question.own(e) for e in (basis.y1, basis.y2, particular)]
    rows: list[Row] = []
    uncertain: set[int] = set()
    for condition in question.conditions:
        place = _limit_place(condition, limits)
        if place is None:
            rows.append(_row(condition, functions, question.x))
        else:
            found = _limit(condition, functions, question.x, place)
            rows += found.rows
            uncertain |= found.uncertain
    generic, others = determine(rows, names, _wronskian(question, basis, rows, limits))
    if generic.outcome is Outcome.SOLUTIONS and any(generic.values[k] != 0 for k in uncertain):
        raise NotImplementedError("undecided: too little is known of how the solutions behave at the singular points")
    return generic, others


def _row(condition: Condition, functions: Sequence[Expr], x: Expr) -> Row:
    u, v, w = (_applied(condition, function, x) for function in functions)
    return Row(u, v, condition.value - w)


def _applied(condition: Condition, function: Expr, x: Expr) -> Expr:
    """l(y)."""
    values = (term.coefficient * value_at(function, x, term.point, term.order) for term in condition.terms)
    return sympy.Add(*values)


def _wronskian(question: Question, basis: Basis, rows: Sequence[Row], limits: dict[Expr, Place]) -> Expr | None:
    """For y and y' at one point, given first: the determinant, which isn't zero, in a form that is short; else None."""
    first_two = question.conditions[:2]
    if len(first_two) < 2 or not all(condition.is_value for condition in first_two):
        return None
    (first,), (second,) = (condition.terms for condition in first_two)
    if first.point != second.point or first.order == second.order or first.point in limits:
        return None
    determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
    if determinant.is_Rational:
        return determinant
    sign = 1 if first.order == 0 else -1
    W = sign * question.own(value_at(basis.wronskian, basis.x, first.point))
    return W if agree(W, determinant) else determinant


# ------------------------------------------------------------------------------------------------------------- limits


def _limit_place(condition: Condition, limits: dict[Expr, Place]) -> Place | None:
    """Where the condition is one on a limit; None for values at ordinary points.  Raises `InputError` for what is both."""
    at_limits = [term for term in condition.terms if term.point in limits]
    if not at_limits:
        if condition.value is None:
            point = condition.terms[0].point
            raise InputError(f"{condition.text}: {point} is an ordinary point, where every solution is bounded")
        return None
    if len(condition.terms) > 1 or at_limits[0].coefficient != 1:
        said = f"{at_limits[0].point} is a singular point, or infinite"
        raise InputError(f"{condition.text}: {said}; there, y and y' are given apart", hint="write y(0) = bounded")
    return limits[at_limits[0].point]


def _limit(condition: Condition, functions: Sequence[Expr], x: Expr, place: Place) -> Limit:
    (term,) = condition.terms
    try:
        found = [behaviour(e.diff(x) if term.order else e, x, place) for e in functions]
        rows = [_coefficients(m, found, _ZERO) for m in _forbidden(found, oscillating=condition.value is not None)]
        uncertain = [k for k, expansion in enumerate(found) if _is_uncertain(expansion, found, condition)]
    except UnknownBehaviour as unknown:
        raise NotImplementedError(f"undecided: the solutions' behaviour at {place.point}: {unknown}") from None
    if 2 in uncertain:
        raise NotImplementedError(f"undecided: the behaviour of a particular solution at {place.point}")
    if condition.value is not None:
        rows.append(_coefficients(CONSTANT, found, condition.value))
    return Limit(tuple(rows), frozenset(uncertain))


def _coefficients(m: Monomial, found: Sequence[Expansion], value: Expr) -> Row:
    u, v, w = (expansion.terms.get(m, _ZERO) for expansion in found)
    return Row(u, v, sympy.expand(value - w))


def _forbidden(found: Sequence[Expansion], *, oscillating: bool) -> Iterator[Monomial]:
    """The monomials that mustn't occur; of those with one growing exponential, the largest ones.

    The coefficients of the smaller ones follow: the series after one exponential is determined up to a factor.
    """
    least = 0 if oscillating else 1
    seen = []
    for expansion in found:
        large = [m for m in expansion.terms if not m.is_constant and m.size >= least]
        for m in large:
            smaller = m.growth_sign > 0 and any(_is_before(other, m) for other in large)
            if not smaller and m not in seen:
                seen.append(m)
                yield m


def _is_before(first: Monomial, second: Monomial) -> bool:
    return first != second and first.growth == second.growth and second.is_below(first)


def _is_uncertain(expansion: Expansion, found: Sequence[Expansion], condition: Condition) -> bool:
    """Is there an error that may not tend to 0, beside exponentials whose series follow from their first terms?"""
    growing = {m.growth for other in found[:2] for m in (*other.terms, *other.errors)}
    known = {m.growth for m in expansion.terms}
    for error in expansion.errors:
        determined = error.growth in known and len(growing) > 1 and error.growth
        if determined and error.growth_sign > 0:
            continue
        try:
            if error.size >= (1 if condition.value is None else 0):
                return True
        except UnknownBehaviour:
            return True
    return False

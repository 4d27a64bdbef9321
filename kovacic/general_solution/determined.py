"""From conditions on y = C1 y1 + C2 y2 + y0 to linear equations for C1 and C2.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), where everything is in the user's symbols, so
that sin(n pi) is 0 before anything is compared.

At a singular point and at infinity, y1, y2 and y0 are sums of monomials (`expansion`).  That y is bounded says that the
coefficients of all unbounded monomials in C1 y1 + C2 y2 + y0 are zero, a row for each; that y tends to v says that those of
the oscillating ones are zero as well, and the constant term is v.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.behaviour import Approach, behaviour
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.constants import Determined, Outcome, ParameterCase, Row, determine
from kovacic.general_solution.expansion import CONSTANT, Expansion, ExpansionTerm, UnknownBehaviour
from kovacic.general_solution.question import Question
from kovacic.general_solution.values import value_at
from kovacic.general_solution.variation import Basis
from kovacic.general_solution.zero import agree

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
Growth = tuple[tuple[Expr, Expr], ...]
#: Sizes of monomials that don't tend to 0 [`ExpansionTerm.size`].
_OSCILLATING = 0
_UNBOUNDED = 1
#: The determinant of the rows for values of these orders at one point is W, or -W.
_SIGNS: dict[tuple[int, ...], int] = {(0, 1): 1, (1, 0): -1}


@dataclass(frozen=True)
class Limit:
    """The rows of a condition on a limit; `uncertain`: why y1 (0) or y2 (1) mustn't be part of y, as far as is known."""

    rows: list[Row]
    uncertain: Mapping[int, str]


class _Solutions(NamedTuple):
    """Those of which y = C1 y1 + C2 y2 + y0 consists, in the user's symbols."""

    y1: Expr
    y2: Expr
    y0: Expr


def constants_of(
    question: Question, basis: Basis, particular: Expr, names: tuple[Expr, Expr], limits: dict[Expr, Approach]
) -> Determined:
    """What the conditions determine: for generic parameters, and for particular ones.

    Raises `NotImplementedError` where too little is known about the solutions.
    """
    solutions = _Solutions(question.own(basis.y1), question.own(basis.y2), question.own(particular))
    rows: list[Row] = []
    uncertain: dict[int, str] = {}
    for condition in question.conditions:
        place = _limit_place(condition, limits)
        if place is None:
            rows.append(_row(condition, solutions, question.x))
        else:
            limit = _limit(condition, solutions, basis, question, place)
            rows += limit.rows
            uncertain |= limit.uncertain
    found = determine(rows, names, _wronskian(question, basis, rows, limits))
    _check_certainty(found.generic, uncertain)
    return found


def _check_certainty(case: ParameterCase, uncertain: Mapping[int, str]) -> None:
    """Raises `NotImplementedError` where a solution is a part of y whose behaviour isn't known well enough."""
    if case.outcome is not Outcome.SOLUTIONS:
        return
    for k, reason in uncertain.items():
        if case.values[k] != 0:
            raise NotImplementedError(f"undecided: {reason}")


def _row(condition: Condition, solutions: _Solutions, x: Expr) -> Row:
    """(l(y1), l(y2), v - l(y0))."""
    u = _applied(condition, solutions.y1, x)
    v = _applied(condition, solutions.y2, x)
    return Row(u, v, condition.value - _applied(condition, solutions.y0, x))


def _applied(condition: Condition, y: Expr, x: Expr) -> Expr:
    """l(y)."""
    values = (term.coefficient * value_at(y, x, term.point, term.order) for term in condition.terms)
    return sympy.Add(*values)


def _wronskian(question: Question, basis: Basis, rows: Sequence[Row], limits: dict[Expr, Approach]) -> Expr | None:
    """For y and y' at one point, given first: the determinant, which isn't zero, in a form that is short; else None."""
    sign = _SIGNS.get(_orders_at_one_point(question.conditions[:2], limits))
    if sign is None:
        return None
    determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
    if determinant.is_Rational:
        return determinant
    point = question.conditions[0].points[0]
    W = sign * question.own(value_at(basis.wronskian, basis.x, point))
    is_known = W.has(sympy.mathieuc)  # by theory, for functions that can't be evaluated
    if is_known or agree(W, determinant):
        return W
    return determinant


def _orders_at_one_point(conditions: Sequence[Condition], limits: dict[Expr, Approach]) -> tuple[int, ...]:
    """The orders of values y(a), y'(a) at one ordinary point; none for other conditions."""
    if not all(condition.is_value for condition in conditions):
        return ()
    terms = [condition.terms[0] for condition in conditions]
    points = {term.point for term in terms}
    if len(points) != 1 or not points.isdisjoint(limits):
        return ()
    return tuple(term.order for term in terms)


# ------------------------------------------------------------------------------------------------------------- limits


def _limit_place(condition: Condition, limits: dict[Expr, Approach]) -> Approach | None:
    """Where the condition is one on a limit; None for values at ordinary points.

    Raises `InputError` for what is both, and where y is to be bounded at an ordinary point.
    """
    at_limits = [term for term in condition.terms if term.point in limits]
    if not at_limits:
        if condition.value is None:
            point = condition.terms[0].point
            raise InputError(f"{condition.text}: {point} is an ordinary point, where every solution is bounded")
        return None
    place = at_limits[0].point
    if len(condition.terms) > 1 or at_limits[0].coefficient != 1:
        said = f"{place} is a singular point, or infinite"
        raise InputError(f"{condition.text}: {said}; there, y and y' are given apart", hint="write y(0) = bounded")
    return limits[place]


def _limit(condition: Condition, solutions: _Solutions, basis: Basis, question: Question, place: Approach) -> Limit:
    """Of a condition on the limit of y, or of y', at a singular point or at infinity."""
    (term,) = condition.terms
    try:
        found = [behaviour(y.diff(question.x, term.order), question.x, place) for y in solutions]
        rows = _rows_of_limit(condition, found)
    except UnknownBehaviour as unknown:
        raise NotImplementedError(f"undecided: the solutions' behaviour at {place.point}: {unknown}") from None
    whole = None
    if any(_is_irregular(expansion) for expansion in found):
        whole = _growth(question.own(basis.wronskian), question.x, place)
    *of_basis, of_particular = (_uncertainty(expansion, whole, _least_forbidden(condition)) for expansion in found)
    if of_particular:
        raise NotImplementedError(
            f"undecided: the behaviour of a particular solution at {place.point}: {of_particular}"
        )
    return Limit(rows, _said(of_basis, place))


def _rows_of_limit(condition: Condition, found: Sequence[Expansion]) -> list[Row]:
    """That no monomial occurs that mustn't, and for a value that the constant term is the value."""
    rows = [_coefficients(m, found, _ZERO) for m in _forbidden(found, _least_forbidden(condition))]
    if condition.value is not None:
        rows.append(_coefficients(CONSTANT, found, condition.value))
    return rows


def _least_forbidden(condition: Condition) -> int:
    """The size from which on monomials mustn't occur: where y is bounded, and where it tends to a value."""
    if condition.value is None:
        return _UNBOUNDED
    return _OSCILLATING


def _said(reasons: Sequence[str | None], place: Approach) -> dict[int, str]:
    """Why solutions mustn't be part of y, by their indices."""
    t = f"|x - {place.point}|"
    if place.is_infinite:
        t = "1/|x|"
    return {k: f"the solutions' behaviour, t = {t}: {reason}" for k, reason in enumerate(reasons) if reason}


def _is_irregular(expansion: Expansion) -> bool:
    """Is there an exponential?"""
    return any(m.growth for m in (*expansion.terms, *expansion.errors))


def _growth(wronskian: Expr, x: Expr, place: Approach) -> Growth | None:
    """The exponential part of the Wronskian, None where it isn't known."""
    try:
        return behaviour(wronskian, x, place).leading().monomial.growth
    except (UnknownBehaviour, NotImplementedError):
        return None


def _coefficients(m: ExpansionTerm, found: Sequence[Expansion], value: Expr) -> Row:
    """That a monomial has this coefficient in y."""
    u, v, w = (expansion.terms.get(m, _ZERO) for expansion in found)
    return Row(u, v, sympy.expand(value - w))


def _forbidden(found: Sequence[Expansion], least: int) -> list[ExpansionTerm]:
    """The monomials of this size, or more, but for the constant; of those with one growing exponential, the largest ones.

    The coefficients of the smaller ones follow: the series after one exponential is determined up to a factor.
    """
    forbidden: dict[ExpansionTerm, None] = {}
    for expansion in found:
        large = [m for m in expansion.terms if not m.is_constant and _is_large(m, least)]
        forbidden |= dict.fromkeys(m for m in large if not _follows(m, large))
    return list(forbidden)


def _follows(m: ExpansionTerm, large: Sequence[ExpansionTerm]) -> bool:
    """Has it a growing exponential, and isn't the largest one with that?"""
    if m.growth_sign <= 0:
        return False
    return any(other != m and other.growth == m.growth and m.is_below(other) for other in large)


def _is_large(m: ExpansionTerm, least: int) -> bool | None:
    """Is its size this, or more?  None where the assumptions don't tell."""
    try:
        return m.size >= least
    except UnknownBehaviour:
        return None


def _uncertainty(expansion: Expansion, whole: Growth | None, least: int) -> str | None:
    """Why the expansion may have other terms of this size, or more; None if it hasn't."""
    for error in expansion.errors:
        if not _is_known(error, expansion, whole) and _is_large(error, least) is not False:
            return f"terms beyond {error} aren't known"
    for m in expansion.terms:
        if _is_large(m, least) is None:
            return f"whether {m} is bounded isn't known"
    return None


def _is_known(error: ExpansionTerm, expansion: Expansion, whole: Growth | None) -> bool:
    """Is what the error stands for 0 where the first term of its series is?

    A solution is the sum of two series, each after an exponential, whose product is that of the Wronskian (`whole`).  If
    these differ, a series is 0 where its first term is.
    """
    if whole is None:
        return False
    series = ExpansionTerm(error.growth)
    if series.power(sympy.Integer(2)).growth == whole:
        return False
    is_among_terms = any(m.growth == error.growth for m in expansion.terms)
    return is_among_terms and bool(_is_large(series, _UNBOUNDED))

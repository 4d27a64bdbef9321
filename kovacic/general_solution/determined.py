"""From conditions on y = C1 y1 + C2 y2 + y0 to linear equations for C1 and C2.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), where everything is in the user's symbols, so
that sin(n pi) is 0 before anything is compared.

At a singular point and at infinity, y1, y2 and y0 are sums of monomials (`expansion`).  That y is bounded says that the
coefficients of all unbounded monomials in C1 y1 + C2 y2 + y0 are zero, a row for each; that y tends to v says that those of
the oscillating ones are zero as well, and the constant term is v.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.behaviour import Approach, behaviour
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.constants import Outcome, ParameterCase, Row, determine
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


@dataclass(frozen=True)
class Limit:
    """The rows of a condition on a limit; `uncertain`: which solutions (0, 1) mustn't be part of y, as far as is known."""

    rows: tuple[Row, ...]
    uncertain: Mapping[int, str]


def constants_of(
    question: Question, basis: Basis, particular: Expr, names: tuple[Expr, Expr], limits: dict[Expr, Approach]
) -> tuple[ParameterCase, list[ParameterCase]]:
    """What the conditions determine: for generic parameters, and for particular ones.

    Raises `NotImplementedError` where too little is known about the solutions.
    """
    functions = [question.own(e) for e in (basis.y1, basis.y2, particular)]
    rows: list[Row] = []
    uncertain: dict[int, str] = {}
    for condition in question.conditions:
        place = _limit_place(condition, limits)
        if place is None:
            rows.append(_row(condition, functions, question.x))
        else:
            found = _limit(condition, functions, basis, question, place)
            rows += found.rows
            uncertain |= found.uncertain
    generic, others = determine(rows, names, _wronskian(question, basis, rows, limits))
    if generic.outcome is Outcome.SOLUTIONS:
        _check_certainty(generic, uncertain)
    return generic, others


def _check_certainty(case: ParameterCase, uncertain: Mapping[int, str]) -> None:
    """Raises `NotImplementedError` where a solution is a part of y whose behaviour isn't known well enough."""
    for k, reason in uncertain.items():
        if case.values[k] != 0:
            raise NotImplementedError(f"undecided: {reason}")


def _row(condition: Condition, functions: Sequence[Expr], x: Expr) -> Row:
    u, v, w = (_applied(condition, function, x) for function in functions)
    return Row(u, v, condition.value - w)


def _applied(condition: Condition, function: Expr, x: Expr) -> Expr:
    """l(y)."""
    values = (term.coefficient * value_at(function, x, term.point, term.order) for term in condition.terms)
    return sympy.Add(*values)


def _wronskian(question: Question, basis: Basis, rows: Sequence[Row], limits: dict[Expr, Approach]) -> Expr | None:
    """For y and y' at one point, given first: the determinant, which isn't zero, in a form that is short; else None."""
    orders = _orders_at_one_point(question.conditions[:2], limits)
    signs = {(0, 1): 1, (1, 0): -1}
    if orders not in signs:
        return None
    determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
    if determinant.is_Rational:
        return determinant
    point = question.conditions[0].points[0]
    W = signs[orders] * question.own(value_at(basis.wronskian, basis.x, point))
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
    """Where the condition is one on a limit; None for values at ordinary points.  Raises `InputError` for what is both."""
    at_limits = [term for term in condition.terms if term.point in limits]
    if not at_limits:
        _check_value(condition)
        return None
    place = at_limits[0].point
    if len(condition.terms) > 1 or at_limits[0].coefficient != 1:
        said = f"{place} is a singular point, or infinite"
        raise InputError(f"{condition.text}: {said}; there, y and y' are given apart", hint="write y(0) = bounded")
    return limits[place]


def _check_value(condition: Condition) -> None:
    """Raises `InputError` where y is bounded at an ordinary point."""
    if condition.value is None:
        point = condition.terms[0].point
        raise InputError(f"{condition.text}: {point} is an ordinary point, where every solution is bounded")


def _limit(condition: Condition, functions: Sequence[Expr], basis: Basis, question: Question, place: Approach) -> Limit:
    """`functions` are y1, y2, y0 in the user's symbols."""
    (term,) = condition.terms
    x = question.x
    meant = [e.diff(x, term.order) for e in functions]
    try:
        found = [behaviour(e, x, place) for e in meant]
        rows = _rows_of_limit(condition, found)
    except UnknownBehaviour as unknown:
        raise NotImplementedError(f"undecided: the solutions' behaviour at {place.point}: {unknown}") from None
    whole = None
    if any(_is_irregular(expansion) for expansion in found):
        whole = _growth(question.own(basis.wronskian), x, place)
    *of_basis, of_particular = (_uncertainty(expansion, whole, condition) for expansion in found)
    if of_particular:
        raise NotImplementedError(
            f"undecided: the behaviour of a particular solution at {place.point}: {of_particular}"
        )
    return Limit(tuple(rows), _said(of_basis, place))


def _rows_of_limit(condition: Condition, found: Sequence[Expansion]) -> list[Row]:
    """That no monomial occurs that mustn't, and for a value that the constant term is the value."""
    is_bound = condition.value is None
    rows = [_coefficients(m, found, _ZERO) for m in _forbidden(found, oscillating=not is_bound)]
    if not is_bound:
        rows.append(_coefficients(CONSTANT, found, condition.value))
    return rows


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
    u, v, w = (expansion.terms.get(m, _ZERO) for expansion in found)
    return Row(u, v, sympy.expand(value - w))


def _forbidden(found: Sequence[Expansion], *, oscillating: bool) -> Iterator[ExpansionTerm]:
    """The monomials that mustn't occur; of those with one growing exponential, the largest ones.

    The coefficients of the smaller ones follow: the series after one exponential is determined up to a factor.
    """
    least = _UNBOUNDED
    if oscillating:
        least = _OSCILLATING
    seen: set[ExpansionTerm] = set()
    for expansion in found:
        large = [m for m in expansion.terms if not m.is_constant and _is_large(m, least)]
        for m in large:
            if m not in seen and not _follows(m, large):
                seen.add(m)
                yield m


def _follows(m: ExpansionTerm, large: Sequence[ExpansionTerm]) -> bool:
    """Has it a growing exponential, and isn't the largest one with that?"""
    return m.growth_sign > 0 and any(_is_before(other, m) for other in large)


def _is_large(m: ExpansionTerm, least: int) -> bool | None:
    """Is its size this, or more?  None where the assumptions don't tell."""
    try:
        return m.size >= least
    except UnknownBehaviour:
        return None


def _is_before(first: ExpansionTerm, second: ExpansionTerm) -> bool:
    return first != second and first.growth == second.growth and second.is_below(first)


def _uncertainty(expansion: Expansion, whole: Growth | None, condition: Condition) -> str | None:
    """Why the expansion may have other terms that don't tend to 0; None if it hasn't."""
    least = _OSCILLATING
    if condition.value is None:
        least = _UNBOUNDED
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

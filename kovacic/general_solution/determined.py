"""From conditions on y = C1 y1 + C2 y2 + y0 to linear equations for C1 and C2.

A condition l(y) = v with a linear l gives the row (l(y1), l(y2), v - l(y0)), where everything is in the user's symbols, so
that sin(n pi) is 0 before anything is compared.

At a singular point and at infinity y is bounded, or tends to v.  If y1 and y2 are, the limits are such a row.  Else let y2 be
the larger one, r = lim y1/y2: then C2 + r C1 = 0, and y = C1 (y1 - r y2).  As (y1 - r y2)/y2 tends to 0 and has the slope
-W/y2^2, the limit of y1 - r y2 is by L'Hospital's rule that of W/y2'.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple

import sympy

from kovacic.errors import InputError
from kovacic.general_solution.basis import Basis
from kovacic.general_solution.behaviour import OSCILLATING, Approach, UnknownLimit, limit_at
from kovacic.general_solution.conditions import Condition
from kovacic.general_solution.constants import Determined, Outcome, ParameterCase, Row, determine
from kovacic.general_solution.question import Question
from kovacic.general_solution.substitution import finite_value
from kovacic.general_solution.values import value_at

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)
#: The determinant of the rows for values of these orders at one point is W, or -W.
_SIGNS: dict[tuple[int, ...], int] = {(0, 1): 1, (1, 0): -1}


class _Solutions(NamedTuple):
    """Those of which y = C1 y1 + C2 y2 + y0 consists, in the user's symbols."""

    y1: Expr
    y2: Expr
    y0: Expr


def constants_of(
    question: Question,
    basis: Basis,
    particular: Expr,
    names: tuple[Expr, Expr],
    limits: dict[Expr, Approach],
    steps: Mapping[Expr, Expr] = MappingProxyType({}),
) -> Determined:
    """What the conditions determine: for generic parameters, and for particular ones.

    `steps` are values of steps at the points of the conditions.

    Raises `NotImplementedError` where too little is known about the solutions.
    """
    solutions = _Solutions(question.own(basis.y1), question.own(basis.y2), question.own(particular))
    rows: list[Row] = []
    exceptional: set[Expr] = set()
    for condition in question.conditions:
        place = _limit_place(condition, limits)
        if place is None:
            u, v, of_particular = (_applied(condition, y, question.x) for y in solutions)
            rows.append(Row(u, v, condition.value - of_particular.xreplace(steps)))
        else:
            limit = _Limit(condition, place, question.own(basis.wronskian), question.x)
            of_limit, zeros = _rows_of_limit(limit, solutions)
            rows += of_limit
            exceptional |= zeros
    scale = question.own(basis.constant)
    if scale.is_zero or scale.has(sympy.Function, sympy.Integral, question.x):  # it isn't elementary
        scale = _ONE
    found = determine(rows, names, _wronskian(question, basis, rows, limits), scale)
    for symbol in sorted(exceptional, key=str):
        found.particular.append(ParameterCase((symbol,), Outcome.OPEN))
    return found


def _applied(condition: Condition, y: Expr, x: Expr) -> Expr:
    """l(y)."""
    values = (term.coefficient * value_at(y, x, term.point, term.order) for term in condition.terms)
    return sympy.Add(*values)


def _wronskian(question: Question, basis: Basis, rows: Sequence[Row], limits: dict[Expr, Approach]) -> Expr | None:
    """For y and y' at one point, given first: the determinant, which isn't zero, in a form that is short; else None."""
    if not all(condition.is_value for condition in question.conditions[:2]):
        return None
    terms = [condition.terms[0] for condition in question.conditions[:2]]
    points = {term.point for term in terms}
    sign = _SIGNS.get(tuple(term.order for term in terms))
    if sign is None or len(points) != 1 or not points.isdisjoint(limits):
        return None
    determinant = rows[0].u * rows[1].v - rows[0].v * rows[1].u
    if determinant.is_Rational:
        return determinant
    W = finite_value(question.own(basis.wronskian), question.x, terms[0].point)
    return determinant if W is None else sign * W


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


@dataclass(frozen=True)
class _Limit:
    """A condition on the limit of y, or of y', at a place; W is the Wronskian."""

    condition: Condition
    place: Approach
    W: Expr
    x: Expr

    @property
    def order(self) -> int:
        return self.condition.terms[0].order

    def of(self, e: Expr) -> Expr:
        return limit_at(e, self.x, self.place)

    def is_allowed(self, limit: Expr) -> bool:
        """May y behave like this?  A value excludes oscillations as well."""
        return limit != sympy.oo and (limit != OSCILLATING or self.condition.value is None)

    def rows(self, y1: Expr, y2: Expr, y0: Expr) -> list[Row]:
        """What the condition says of C1 and C2.  Raises `UnknownLimit`."""
        first, second, rest = (self.of(y) for y in (y1, y2, y0))
        if not self.is_allowed(rest):
            return self._with_a_large_particular(y1, y2, y0)
        if self.is_allowed(first) and self.is_allowed(second):
            return self._of_limits(first, second, rest)
        if self.is_allowed(second):  # y1 is excluded
            return [Row(_ONE, _ZERO, _ZERO), *self._of_limits(_ZERO, second, rest)]
        if self.is_allowed(first):
            return [Row(_ZERO, _ONE, _ZERO), *self._of_limits(first, _ZERO, rest)]
        both = [Row(_ONE, _ZERO, _ZERO), Row(_ZERO, _ONE, _ZERO), *self._of_limits(_ZERO, _ZERO, rest)]
        ratio = self.of(y1 / y2)
        if ratio in (0, sympy.oo, OSCILLATING):  # of other sizes, or waves in other phases: no combination is smaller
            return both
        smaller = self._of_smaller(y2)
        if not self.is_allowed(smaller):
            return both
        return [_without_gammas(ratio), *self._of_limits(smaller, _ZERO, rest)]

    def _of_limits(self, first: Expr, second: Expr, rest: Expr) -> list[Row]:
        """For limits that are allowed."""
        if self.condition.value is None:
            return []
        return [Row(first, second, self.condition.value - rest)]

    def _of_smaller(self, larger: Expr) -> Expr:
        """The limit of the combination that is smaller than y1 and y2."""
        if self.order:
            raise UnknownLimit("the slope of a combination of solutions of the same size isn't known")
        return self.of(self.W / larger.diff(self.x))

    def _with_a_large_particular(self, y1: Expr, y2: Expr, y0: Expr) -> list[Row]:
        """Where y0 isn't allowed: r = lim y0/y for the larger one of y1 and y2, and y0 - r y in its place."""
        for k, y in enumerate((y1, y2)):
            ratio = self.of(y0 / y)
            if ratio not in (0, sympy.oo, OSCILLATING):
                shifted = self.rows(y1, y2, sympy.expand(y0 - ratio * y))  # with C + r in the place of C
                return [Row(row.u, row.v, row.r - (row.u, row.v)[k] * ratio) for row in shifted]
        if any(self.of(y) == OSCILLATING for y in (y1, y2)) and self.of(y0) == OSCILLATING:
            raise UnknownLimit("the particular solution oscillates as others do")
        return [Row(_ZERO, _ZERO, _ONE)]  # no solution


def _rows_of_limit(limit: _Limit, solutions: _Solutions) -> tuple[list[Row], set[Expr]]:
    """The rows, and symbols that were taken for positive where it is only known that they aren't negative."""
    forms = [y.diff(limit.x, limit.order) for y in solutions]
    symbols = set().union(*(y.free_symbols for y in forms))
    perhaps_zero = [s for s in symbols if s.is_nonnegative and not s.is_positive]
    natural = {s: sympy.Dummy(s.name, integer=s.is_integer, positive=True) for s in perhaps_zero}
    for positive in ({}, natural):
        try:
            own = replace(limit, W=limit.W.xreplace(positive))
            rows = own.rows(*(y.xreplace(positive) for y in forms))
        except UnknownLimit as unknown:
            reason = unknown
            continue
        back = {dummy: symbol for symbol, dummy in positive.items()}
        return [Row(*(part.xreplace(back) for part in (row.u, row.v, row.r))) for row in rows], {*positive}
    raise NotImplementedError(f"undecided: the solutions' behaviour at {limit.place.point}: {reason}")


def _without_gammas(ratio: Expr) -> Row:
    """r C1 + C2 = 0, for r = p/q as p C1 + q C2 = 0 with 1/gamma, which has values everywhere, in the place of gamma."""
    p, q = sympy.fraction(sympy.powsimp(ratio))
    gammas = [f for f in ratio.atoms(sympy.gamma) if f.free_symbols]
    common = sympy.Mul(*gammas)
    return Row(p / common, q / common, _ZERO)

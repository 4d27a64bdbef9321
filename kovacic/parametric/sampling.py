"""Exact points inside and outside of conditions, for checking them against the engine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from random import Random

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.functions import degrees, powers_of
from kovacic.parametric.statements import Point, Statement


@dataclass
class _Draft:
    """A point in the making: values in one field, which is enlarged once at most."""

    values: dict[str, Poly]
    field: Field = QQ

    def point(self, names: Sequence[str]) -> Point:
        return Point(tuple(names), tuple(self.values[name].over(self.field) for name in names), self.field)


def points(
    statements: Sequence[Statement], start: Point, names: Sequence[str], assumptions: Assumptions, random: Random
) -> Iterator[Point | None]:
    """Points with small coordinates: every other one where one of the statements holds; None where an attempt failed.

    `start` has the coordinates that are fixed; `names` are those that are chosen, with values that the assumptions admit.
    """
    for attempt in count(1):
        if statements and attempt % 2:
            point = _inside(statements[attempt // 2 % len(statements)], start, names, assumptions, random)
        else:
            point = _draft(start, names, assumptions, random).point([*start.names, *names])
        yield point if point is not None and assumptions.admits(zip(point.names, point.values, strict=True)) else None


def _inside(
    statement: Statement, start: Point, names: Sequence[str], assumptions: Assumptions, random: Random
) -> Point | None:
    """A point at which the statement holds; None if none was found."""
    draft = _draft(start, names, assumptions, random)
    free = list(names)
    try:
        for function in reversed(statement.sample(random)):
            free.remove(_solve_for_zero(function, draft, free, random))
    except (ZeroDivisionError, ValueError):
        return None
    point = draft.point([*start.names, *names])
    return point if statement.holds(point) else None


def _draft(start: Point, names: Sequence[str], assumptions: Assumptions, random: Random) -> _Draft:
    fixed = dict(zip(start.names, start.values, strict=True))
    return _Draft(fixed | {name: QQ.poly([assumptions.of(name).sample(random)]) for name in names}, start.field)


def _solve_for_zero(function: FunctionPoly, draft: _Draft, free: Sequence[str], random: Random) -> str:
    """Choose one free parameter so that the function vanishes; its name, or "" where there is none."""
    names = function.field.names
    powers = dict(zip(names, degrees(function), strict=True))
    candidates = [name for name in free if powers.get(name, 0) > 0]
    random.shuffle(candidates)
    for name in sorted(candidates, key=lambda n: powers[n]):
        # The numerator as a polynomial in this parameter, the others having their values.
        values = [draft.values[n].over(draft.field) for n in names]
        parts = powers_of(function, names.index(name))
        one_variable = draft.field.poly(
            [parts[k].value_at(values, draft.field) if k in parts else 0 for k in range(powers[name] + 1)]
        )
        if one_variable.degree < 1:
            continue
        factor = random.choice([f for f, _ in one_variable.field.factor(one_variable)])
        if factor.degree == 1:
            draft.values[name] = -factor[0]
            return name
        if draft.field == QQ and len(free) == len(names) == 1:
            draft.field = AlgebraicField(QQ, factor, "alpha")
            draft.values[name] = draft.field.generator
            return name
    return ""

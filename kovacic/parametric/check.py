"""Conditions against the engine, at exact points inside and outside of them."""

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
from kovacic.parametric.functions import ParameterPoint, coefficients_in, degrees
from kovacic.parametric.statements import Statement


@dataclass(frozen=True)
class Disagreement:
    """A point at which a region and the engine differ."""

    point: str
    predicted: int | None
    found: int | None


@dataclass(frozen=True)
class CheckReport:
    """The outcome of `kovacic.parameters.Conditions.check`: true when every sample agrees.

    Attributes
    ----------
    inside, outside : int
        The number of points that were solved in a special region, and in the generic one.
    open : int
        The number of points for which the regions claim nothing.
    disagreements : tuple of Disagreement
        The points at which the regions and the engine differ.
    """

    inside: int
    outside: int
    open: int
    disagreements: tuple[Disagreement, ...]

    def __bool__(self) -> bool:
        return not self.disagreements


@dataclass(frozen=True)
class Sampler:
    """Points with small coordinates: values of the `names` that the assumptions admit, beside the `start`, which is fixed."""

    start: ParameterPoint
    names: Sequence[str]
    assumptions: Assumptions
    random: Random

    def points(self, statements: Sequence[Statement]) -> Iterator[ParameterPoint | None]:
        """Every other one where one of the statements holds; None where an attempt failed."""
        for attempt in count(1):
            chosen = None
            if statements and attempt % 2:
                chosen = statements[attempt // 2 % len(statements)]
            point = self._point(chosen)
            if point is not None and not self.assumptions.admits(zip(point.names, point.values, strict=True)):
                point = None
            yield point

    def _point(self, statement: Statement | None) -> ParameterPoint | None:
        """A point at which the statement holds, any one without a statement; None if none was found."""
        values = dict(zip(self.start.names, self.start.values, strict=True))
        values |= {name: QQ.poly([self.assumptions.of(name).sample(self.random)]) for name in self.names}
        if statement is None:
            return self._with_values(values, self.start.field)
        try:
            field = self._solve(statement.sample(self.random), values)
        except (ZeroDivisionError, ValueError):
            return None
        point = self._with_values(values, field)
        return point if statement.holds(point) else None

    def _with_values(self, values: dict[str, Poly], field: Field) -> ParameterPoint:
        """The point of a field with these values."""
        in_one_field = tuple(value.over(field) for value in values.values())
        return ParameterPoint((*self.start.names, *self.names), in_one_field, field)

    def _solve(self, functions: Sequence[FunctionPoly], values: dict[str, Poly]) -> Field:
        """Choose a parameter for each function so that it vanishes, the last function first; the field of all values."""
        field = self.start.field
        free = list(self.names)
        for function in reversed(functions):
            field = self._solve_for_zero(function, values, field, free)
        return field

    def _solve_for_zero(self, function: FunctionPoly, values: dict[str, Poly], field: Field, free: list[str]) -> Field:
        """Choose one free parameter so that the function vanishes; the field of all values.  `ValueError` if none does it."""
        names = function.field.names
        powers = dict(zip(names, degrees(function), strict=True))
        candidates = [name for name in free if powers.get(name, 0) > 0]
        self.random.shuffle(candidates)
        candidates.sort(key=powers.__getitem__)
        known = [values[name].over(field) for name in names]
        for name in candidates:
            equation = field.poly(coefficients_in(function, names.index(name), known, field))
            if equation.degree < 1:
                continue
            factor = self.random.choice([f for f, _ in field.factor(equation)])
            is_alone = len(free) == len(names) == 1
            value = _root(factor, adjoined=is_alone and field == QQ)
            if value is not None:
                values[name] = value
                free.remove(name)
                return value.field
        raise ValueError("no parameter can be chosen")


def _root(factor: Poly, *, adjoined: bool) -> Poly | None:
    """Of an irreducible polynomial, in its field, or in an extension if one may be adjoined."""
    if factor.degree == 1:
        return -factor[0]
    return AlgebraicField(QQ, factor, "alpha").generator if adjoined else None

"""Exact points inside and outside of conditions, for checking them against the engine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.riemann import Schwarz
from kovacic.parametric.statements import Both, Classes, Either, IntegerRoot, Point, Statement, Vanishes


@dataclass
class _Draft:
    """A point in the making: values in one field, which is enlarged once at most."""

    values: dict[str, Poly]
    field: Field = QQ

    def point(self, names: Sequence[str]) -> Point:
        return Point(tuple(names), tuple(self.values[name].over(self.field) for name in names), self.field)


def outside(start: Point, names: Sequence[str], assumptions: Assumptions, random: Random) -> Point:
    """A point with small rational coordinates: as a rule, outside of all conditions.

    `start` has the coordinates that are fixed; `names` are those that are chosen.
    """
    return _draft(start, names, assumptions, random).point([*start.names, *names])


def inside(
    statement: Statement, start: Point, names: Sequence[str], assumptions: Assumptions, random: Random
) -> Point | None:
    """A point at which the statement holds; None if none was found."""
    draft = _draft(start, names, assumptions, random)
    free = list(names)
    for part in reversed(_conjunction(statement, random)):
        try:
            solved = _solve(part, draft, free, random)
        except ZeroDivisionError:
            return None
        if solved is None:
            return None
        if solved in free:
            free.remove(solved)
    point = draft.point([*start.names, *names])
    try:
        return point if statement.holds(point) else None
    except ZeroDivisionError:
        return None


def _draft(start: Point, names: Sequence[str], assumptions: Assumptions, random: Random) -> _Draft:
    fixed = dict(zip(start.names, start.values, strict=True))
    return _Draft(fixed | {name: QQ.poly([assumptions.of(name).sample(random)]) for name in names}, start.field)


def _conjunction(statement: Statement, random: Random) -> list[Statement]:
    """Atoms that together imply the statement: one part of every alternative."""
    if isinstance(statement, Both):
        return [atom for part in statement.parts for atom in _conjunction(part, random)]
    if isinstance(statement, Either):
        return _conjunction(random.choice(statement.parts), random)
    if isinstance(statement, Schwarz):
        return statement.sample(random) or [statement]
    return [statement]


def _solve(statement: Statement, draft: _Draft, free: Sequence[str], random: Random) -> str | None:
    """Make the atom true by changing one of the free parameters; its name, or None."""
    if isinstance(statement, Vanishes):
        return _solve_for_zero(statement.function, draft, free, random)
    if isinstance(statement, Classes):
        value = random.choice(statement.residues) + random.randint(-4, 4) * statement.modulus
        return _solve_for_zero(statement.form - value, draft, free, random)
    if isinstance(statement, IntegerRoot):
        N = random.choice(statement.residues) + random.randint(-3, 3) * statement.modulus
        value_at_N = statement.equation(N)
        assert isinstance(value_at_N, FunctionPoly)
        return _solve_for_zero(value_at_N, draft, free, random)
    return None


def _solve_for_zero(function: FunctionPoly, draft: _Draft, free: Sequence[str], random: Random) -> str | None:
    """Choose one free parameter so that the function vanishes."""
    names = function.field.names
    degrees = {name: int(function.num.degrees()[1 + i]) for i, name in enumerate(names)}
    candidates = [name for name in free if degrees.get(name, 0) > 0]
    random.shuffle(candidates)
    for name in sorted(candidates, key=lambda n: degrees[n]):
        # The function as a polynomial in this parameter, the others having their values.
        one_variable = _in_one_parameter(function, name, draft)
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
    return None


def _in_one_parameter(function: FunctionPoly, name: str, draft: _Draft) -> Poly:
    """The numerator as a polynomial in the given parameter, the others having their values."""
    names = function.field.names
    index = names.index(name)
    coefficients: dict[int, Poly] = {}
    for exponents, coefficient in function.num.to_dict().items():
        value = draft.field.poly([int(coefficient)])
        for i, exponent in enumerate(exponents[1:]):
            if i != index and exponent:
                value = value * draft.values[names[i]].over(draft.field) ** int(exponent)
        power = int(exponents[1 + index])
        coefficients[power] = coefficients.get(power, draft.field.poly([])) + value
    return draft.field.poly([coefficients.get(k, 0) for k in range(max(coefficients, default=-1) + 1)])


__all__ = ["inside", "outside"]

"""Local conditions that a structure of the group implies, and whether one fails at the places that are named.

At an irregular point of odd order no solution has a rational logarithmic derivative; a logarithm makes the local monodromy
unipotent of infinite order, which an imprimitive or finite group hasn't; the square root of an invariant of degree 4 that isn't
a square branches at two points at least; an irregular point makes the group infinite; in a finite primitive group the local
monodromy has an order from a short list, the denominator of Delta.  [Kovacic 1986, theorem of section 2.1]
"""

from __future__ import annotations

from collections.abc import Callable

from kovacic.decision import NecessaryCondition, Rule, Structure
from kovacic.verify.local import Point
from kovacic.verify.zeros import is_proven_irrational

#: The denominators of exponent differences in the finite primitive groups, modulo +-1.
_ORDERS = {Structure.TETRAHEDRAL: {1, 2, 3}, Structure.OCTAHEDRAL: {1, 2, 3, 4}, Structure.ICOSAHEDRAL: {1, 2, 3, 5}}


def condition_fails(item: NecessaryCondition, structure: Structure, points: list[Point]) -> bool:
    """Is the condition one that this structure implies, and does it fail at each of the places that are named?"""
    named = [point for point in points if point.name in item.places]
    if len(named) < len(item.places):  # a name is that of no point, or occurs twice
        return False
    if item.rule is Rule.TOO_FEW_BRANCH_POINTS:
        # these are the places at which the square root of an invariant of degree 4 can branch: fewer than two points
        are_all = named == [point for point in points if point.can_branch]
        return structure is Structure.IMPRIMITIVE and are_all and sum(point.factor.degree for point in named) < 2
    concerns, fails = _RULES[item.rule]
    return concerns(structure) and bool(named) and all(fails(point, structure) for point in named)


def _is_ramified(point: Point, structure: Structure) -> bool:
    return point.order > 2 and point.order % 2 == 1


def _is_not_a_square(point: Point, structure: Structure) -> bool:
    return point.order > 0 and point.order % 2 == 0 and is_proven_irrational(point)


def _has_a_logarithm(point: Point, structure: Structure) -> bool:
    return point.logarithm


def _is_irregular(point: Point, structure: Structure) -> bool:
    return point.order > 2


def _has_other_exponents(point: Point, structure: Structure) -> bool:
    if point.order > 2:
        return False
    return point.difference is None or point.difference.denominator not in _ORDERS[structure]


def _is_reducible(structure: Structure) -> bool:
    return structure is Structure.REDUCIBLE


def _is_irreducible(structure: Structure) -> bool:
    return structure is not Structure.REDUCIBLE


def _is_primitive(structure: Structure) -> bool:
    return structure in _ORDERS


#: For each rule, which structures imply the condition, and whether it fails at a point.
_RULES: dict[Rule, tuple[Callable[[Structure], bool], Callable[[Point, Structure], bool]]] = {
    Rule.RAMIFIED: (_is_reducible, _is_ramified),
    Rule.NOT_A_SQUARE: (_is_reducible, _is_not_a_square),
    Rule.LOGARITHM: (_is_irreducible, _has_a_logarithm),
    Rule.IRREGULAR: (_is_primitive, _is_irregular),
    Rule.EXPONENTS: (_is_primitive, _has_other_exponents),
}

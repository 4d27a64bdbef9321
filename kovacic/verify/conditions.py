"""Local conditions that a structure of the group implies, and whether one fails at the places that are named.

At an irregular point of odd order no solution has a rational logarithmic derivative; a logarithm makes the local monodromy
unipotent of infinite order, which an imprimitive or finite group hasn't; the square root of an invariant of degree 4 that isn't
a square branches at two points at least; an irregular point makes the group infinite; in a finite primitive group the local
monodromy has an order from a short list, the denominator of Delta.  [Kovacic 1986, theorem of section 2.1]
"""

from __future__ import annotations

from kovacic.decision import NecessaryCondition, Rule, Structure
from kovacic.verify.local import Point
from kovacic.verify.zeros import is_proven_irrational

#: The denominators of exponent differences in the finite primitive groups, modulo +-1.
_LOCAL_ORDERS = {
    Structure.TETRAHEDRAL: {1, 2, 3},
    Structure.OCTAHEDRAL: {1, 2, 3, 4},
    Structure.ICOSAHEDRAL: {1, 2, 3, 5},
}


def condition_fails(item: NecessaryCondition, structure: Structure, points: list[Point]) -> bool:
    """True if the structure implies the condition, and the condition fails at each of the places that are named."""
    named = [point for point in points if point.name in item.places]
    if len(named) < len(item.places):  # a name is that of no point, or occurs twice
        return False
    if item.rule is Rule.TOO_FEW_BRANCH_POINTS:
        # The square root of an invariant of degree 4 can branch at these places alone, and they are fewer than two points.
        are_all = named == [point for point in points if point.can_branch]
        return structure is Structure.IMPRIMITIVE and are_all and sum(point.factor.degree for point in named) < 2
    return (
        structure in _IMPLIED_BY[item.rule] and bool(named) and all(_fails_at(p, item.rule, structure) for p in named)
    )


def _fails_at(point: Point, rule: Rule, structure: Structure) -> bool:
    """True if the condition of a rule fails at the point."""
    k = point.order
    if rule is Rule.RAMIFIED:
        return k > 2 and k % 2 == 1
    if rule is Rule.NOT_A_SQUARE:
        return k > 0 and k % 2 == 0 and is_proven_irrational(point)
    if rule is Rule.LOGARITHM:
        return point.logarithm
    if rule is Rule.IRREGULAR:
        return k > 2
    # EXPONENTS, which speaks of regular points only
    return k <= 2 and (point.difference is None or point.difference.denominator not in _LOCAL_ORDERS[structure])


#: The structures that imply the condition of each rule.
_IMPLIED_BY = {
    Rule.RAMIFIED: {Structure.REDUCIBLE},
    Rule.NOT_A_SQUARE: {Structure.REDUCIBLE},
    Rule.LOGARITHM: {Structure.IMPRIMITIVE, *_LOCAL_ORDERS},
    Rule.IRREGULAR: {*_LOCAL_ORDERS},
    Rule.EXPONENTS: {*_LOCAL_ORDERS},
}

"""Kovacic's necessary conditions and sharper ones: what local data alone exclude.

The group contains the local monodromies and exponential tori, so that
- a ramified irregular place leaves no omega in C(x);
- a logarithm gives a unipotent element, which no imprimitive irreducible and no finite group has;
- the square root that an imprimitive group adjoins has at least two branch points, where the local group exchanges the two
  lines: there Delta is half an odd integer, or the place is irregular and ramified;
- an irregular place gives an infinite group;
- the order of a local monodromy in PGL2 is the denominator of Delta, and the orders in A4, S4, A5 are 1 to 3, 1 to 4, and
  1, 2, 3, 5; A4 and A5 don't contain S4's elements of order 4, and 5 occurs in A5 alone.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), section 2.1; the sharper conditions follow from the facts above.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from kovacic.decision import NecessaryCondition, Rule, Structure
from kovacic.engine.places import Kind, Place, Problem

_PRIMITIVE_STRUCTURES = (Structure.TETRAHEDRAL, Structure.OCTAHEDRAL, Structure.ICOSAHEDRAL)
_MONODROMY_ORDERS = {
    Structure.TETRAHEDRAL: frozenset({1, 2, 3}),
    Structure.OCTAHEDRAL: frozenset({1, 2, 3, 4}),
    Structure.ICOSAHEDRAL: frozenset({1, 2, 3, 5}),
}


@dataclass(frozen=True)
class _Failure:
    """A condition that fails at the places `culprits`, and the structures that this excludes."""

    rule: Rule
    culprits: list[Place]
    structures: Sequence[Structure]


def excluded_by_local_data(problem: Problem) -> dict[Structure, NecessaryCondition]:
    """The structures that can't occur, each with the first condition that fails."""
    excluded: dict[Structure, NecessaryCondition] = {}
    for failure in _failures(problem.places):
        new = [structure for structure in failure.structures if structure not in excluded]
        if new:
            condition = NecessaryCondition(failure.rule, tuple([place.name for place in failure.culprits]))
            excluded.update(dict.fromkeys(new, condition))
    return excluded


def _failures(places: Sequence[Place]) -> Iterator[_Failure]:
    ramified = _of_kinds(places, Kind.RAMIFIED)
    if ramified:
        yield _Failure(Rule.RAMIFIED, ramified, [Structure.REDUCIBLE])
    logarithmic = [place for place in places if place.logarithm]
    if logarithmic:
        yield _Failure(Rule.LOGARITHM, logarithmic, [Structure.IMPRIMITIVE, *_PRIMITIVE_STRUCTURES])
    branched = ramified + [place for place in places if place.delta is not None and place.delta.denominator == 2]
    if sum(place.degree for place in branched) < 2:
        yield _Failure(Rule.TOO_FEW_BRANCH_POINTS, branched, [Structure.IMPRIMITIVE])
    irregular = _of_kinds(places, Kind.RAMIFIED, Kind.UNRAMIFIED)
    if irregular:
        yield _Failure(Rule.IRREGULAR, irregular, _PRIMITIVE_STRUCTURES)
    regular = _of_kinds(places, Kind.REGULAR)
    for structure, orders in _MONODROMY_ORDERS.items():
        culprits = [place for place in regular if place.delta is None or place.delta.denominator not in orders]
        if culprits:
            yield _Failure(Rule.EXPONENTS, culprits, [structure])


def _of_kinds(places: Sequence[Place], *kinds: Kind) -> list[Place]:
    return [place for place in places if place.kind in kinds]

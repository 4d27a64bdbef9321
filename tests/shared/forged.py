"""Evidence that is well formed and claims what may be wrong: none of it may exclude the structure that the group has.

The records that evidence and claims are made of, and what weighs them, are named here for the tests that forge them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from typing import Any

from build import Poly, RatFunc

from kovacic import Structure
from kovacic.decision import (
    CurveFunction,
    Decision,
    Evidence,
    Exclusion,
    NecessaryCondition,
    NoInvariant,
    NoRationalOmega,
    NoTerminatingSeries,
    RiccatiPolynomial,
    Rule,
    SemiInvariant,
)
from kovacic.limits import Budget
from kovacic.verify import GroupClaim
from kovacic.verify.evidence import INVARIANT_DEGREE, Inspector, least_ordinary_point, room
from kovacic.verify.primes import homomorphisms, roots_modulo
from kovacic.verify.zeros import zero_counts

__all__ = [
    "INVARIANT_DEGREE",
    "CurveFunction",
    "Decision",
    "Exclusion",
    "GroupClaim",
    "Inspector",
    "NecessaryCondition",
    "NoInvariant",
    "NoRationalOmega",
    "NoTerminatingSeries",
    "RiccatiPolynomial",
    "Rule",
    "SemiInvariant",
    "claimed",
    "forged_evidence",
    "inspector",
    "primes_with_a_root",
]


def inspector(S: RatFunc) -> Inspector:
    """What the kernel weighs evidence about y'' = S y with."""
    return Inspector(S, Budget())


def forged_evidence(S: RatFunc, structure: Structure) -> Iterator[tuple[Evidence, ...]]:
    """Evidence against a structure in every form, with the kernel's own bounds, places, primes and points.

    Forms of every degree, also those that there truly aren't; omega at every place, modulo a prime with a root there.
    """
    points = inspector(S).points
    names, h = tuple(point.name for point in points), next(S.field.homomorphisms())
    primes = [h.p for h, _ in zip(S.field.homomorphisms(), range(2), strict=False)]
    forms, omegas = [NoInvariant(m) for m in INVARIANT_DEGREE.values()], [NoRationalOmega(-1)]
    for m in INVARIANT_DEGREE.values():
        bounds = room(points, m)
        degree = -1 if bounds is None else bounds[1]
        tried = primes if m == INVARIANT_DEGREE[structure] else primes[:1]
        forms += [NoInvariant(m, p, least_ordinary_point(h(S.den)), degree) for p in tried]
    counts = zero_counts(points)
    if counts is not None:
        omegas += [NoRationalOmega(counts.largest), *(NoRationalOmega(counts.largest, primes[0], n) for n in names)]
        roots = [(p, point.name) for point in points for p in islice(primes_with_a_root(point.factor), 2)]
        omegas += [NoRationalOmega(counts.largest, p, name) for p, name in roots if p != primes[0]]
    rules = [NecessaryCondition(rule, named) for rule in Rule for named in (names, *((name,) for name in names))]
    yield ()
    series = map(NoTerminatingSeries, range(5))
    for item in (*forms, *omegas, *rules, *series):
        yield (item,)
    for form in forms:
        for omega in (*omegas, *(rule for rule in rules if rule.rule is Rule.NOT_A_SQUARE)):
            yield (form, omega)


def primes_with_a_root(factor: Poly) -> Iterator[int]:
    """The primes, among the first ones, modulo which a factor has a simple root."""
    return (h.p for h in islice(homomorphisms(factor.field), 100) if roots_modulo(factor, h))


def claimed(claim: GroupClaim, **changes: Any) -> GroupClaim:
    """The claim with another family, n or evidence, and the size that belongs to it, which then can't give it away."""
    claim = replace(claim, **changes)
    n = claim.n
    infinite = {"multiplicative": 1, "additive": 1, "infinite dihedral": 1, "borel": 2, "SL2": 3}
    finite = {"tetrahedral": 24, "octahedral": 48, "icosahedral": 120, "cyclic": n, "dicyclic": n and 4 * n}
    order = finite.get(claim.family)
    return replace(claim, order=order, dimension=infinite.get(claim.family) if order is None else 0)

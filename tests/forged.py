"""Evidence that is well formed and claims what may be wrong: none of it may exclude the structure that the group has."""

from __future__ import annotations

from collections.abc import Iterator

from kovacic.algebra.modular import ordinary_point
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Evidence, NecessaryCondition, NoInvariant, NoRationalOmega, Rule, Structure
from kovacic.limits import Budget
from kovacic.verify.evidence import INVARIANT_DEGREE, Inspector
from kovacic.verify.local import zero_counts


def forged_evidence(S: RatFunc, structure: Structure) -> Iterator[tuple[Evidence, ...]]:
    """Evidence against a structure in every form, with the kernel's own bounds, places, primes and points."""
    inspector = Inspector(S, Budget())
    names, m = tuple(point.name for point in inspector.points), INVARIANT_DEGREE[structure]
    primes = [h.p for h, _ in zip(S.field.homomorphisms(), range(2), strict=False)]
    forms, omegas = [NoInvariant(m)], [NoRationalOmega(-1)]
    room, counts = inspector.room(m)[1], zero_counts(inspector.points)
    h = next(S.field.homomorphisms())
    forms += [NoInvariant(m, p, ordinary_point(h(S.den)), room) for p in primes]
    if counts is not None:
        omegas += [NoRationalOmega(counts.largest), *(NoRationalOmega(counts.largest, primes[0], n) for n in names)]
    rules = [NecessaryCondition(rule, names) for rule in Rule]
    yield ()
    for item in (*forms, *omegas, *rules):
        yield (item,)
    for form in forms:
        for omega in (*omegas, NecessaryCondition(Rule.NOT_A_SQUARE, names)):
            yield (form, omega)

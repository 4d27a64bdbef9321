"""Evidence that is well formed and claims what may be wrong: none of it may exclude the structure that the group has."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from kovacic.algebra.modular import BadPrimeError, ordinary_point, simple_roots
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Evidence, NecessaryCondition, NoInvariant, NoRationalOmega, Rule, Structure
from kovacic.limits import Budget
from kovacic.verify.evidence import INVARIANT_DEGREE, Inspector
from kovacic.verify.local import zero_counts


def forged_evidence(S: RatFunc, structure: Structure) -> Iterator[tuple[Evidence, ...]]:
    """Evidence against a structure in every form, with the kernel's own bounds, places, primes and points.

    Forms of every degree, also those that there truly aren't; omega at every place, modulo a prime with a root there.
    """
    inspector = Inspector(S, Budget())
    names, h = tuple(point.name for point in inspector.points), next(S.field.homomorphisms())
    primes = [h.p for h, _ in zip(S.field.homomorphisms(), range(2), strict=False)]
    forms, omegas = [NoInvariant(m) for m in INVARIANT_DEGREE.values()], [NoRationalOmega(-1)]
    for m in INVARIANT_DEGREE.values():
        room, own = inspector.room(m)[1], m == INVARIANT_DEGREE[structure]
        forms += [NoInvariant(m, p, ordinary_point(h(S.den)), room) for p in (primes if own else primes[:1])]
    counts = zero_counts(inspector.points)
    if counts is not None:
        omegas += [NoRationalOmega(counts.largest), *(NoRationalOmega(counts.largest, primes[0], n) for n in names)]
        roots = [(p, point.name) for point in inspector.points for p in islice(primes_with_a_root(point.factor), 2)]
        omegas += [NoRationalOmega(counts.largest, p, name) for p, name in roots if p != primes[0]]
    rules = [NecessaryCondition(rule, named) for rule in Rule for named in (names, *((name,) for name in names))]
    yield ()
    for item in (*forms, *omegas, *rules):
        yield (item,)
    for form in forms:
        for omega in (*omegas, *(rule for rule in rules if rule.rule is Rule.NOT_A_SQUARE)):
            yield (form, omega)


def primes_with_a_root(factor: Poly) -> Iterator[int]:
    """The primes, among the first ones, modulo which a factor has a simple root."""
    for h in islice(factor.field.homomorphisms(), 100):
        try:
            if any(True for _ in simple_roots(h.keeping_degree(factor))):
                yield h.p
        except BadPrimeError:
            continue

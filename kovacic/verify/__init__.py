"""The trusted kernel: does a decision hold?  Recomputed from S, by other code than the search.

A positive decision is checked by the Riccati identity for the polynomial of omega and by the evidence against every smaller
structure, which makes that polynomial irreducible over C(x): without a rational omega a polynomial of degree 2 has no
factor; a primitive group whose smaller ones are excluded has no omega of a smaller degree.  A negative one is checked by
the evidence against every structure.  Only exact arithmetic and arithmetic modulo primes in the direction in which it
proves something (a rank can only drop) is used.
"""

from __future__ import annotations

from dataclasses import dataclass

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Status, Structure
from kovacic.verify.evidence import Inspector
from kovacic.verify.identity import solves_riccati

#: The structures in the order of the proof, with the degree of omega.
_OMEGA_DEGREE = {
    Structure.REDUCIBLE: 1,
    Structure.IMPRIMITIVE: 2,
    Structure.TETRAHEDRAL: 4,
    Structure.OCTAHEDRAL: 6,
    Structure.ICOSAHEDRAL: 12,
}
#: What the evidence against each structure shows.
_EXCLUDED = {
    structure: f"the Galois group isn't {structure.value} (case {structure.case})" for structure in _OMEGA_DEGREE
}


@dataclass(frozen=True)
class Check:
    """One statement that was checked, and whether it holds."""

    statement: str
    passed: bool


@dataclass(frozen=True)
class Verification:
    """All checks of one decision; true exactly when every one passed and there was something to check."""

    checks: tuple[Check, ...]

    def __bool__(self) -> bool:
        return bool(self.checks) and all(check.passed for check in self.checks)

    def __str__(self) -> str:
        return "\n".join(f"{'passed' if check.passed else 'FAILED'}: {check.statement}" for check in self.checks)


def verify(S: RatFunc, decision: Decision) -> Verification:
    """Recompute everything that the decision claims about y'' = S y."""
    structures = list(_OMEGA_DEGREE)
    if decision.status is Status.LIOUVILLIAN and decision.structure is not None:
        checks = _positive(S, decision, decision.structure)
        required = structures[: structures.index(decision.structure)]
    else:
        checks = []
        required = structures if decision.status is Status.NONE_EXISTS else [e.structure for e in decision.exclusions]
    inspector = Inspector(S)
    by_structure = {exclusion.structure: exclusion.evidence for exclusion in decision.exclusions}
    for structure in required:
        checks.append(Check(_EXCLUDED[structure], inspector.excludes(structure, by_structure.get(structure, ()))))
    return Verification(tuple(checks))


def _positive(S: RatFunc, decision: Decision, structure: Structure) -> list[Check]:
    riccati, form = decision.riccati, decision.semi_invariant
    if riccati is None or form is None:
        return [Check("the polynomial of omega is there", False)]
    degree = _OMEGA_DEGREE[structure]
    P, D, theta = riccati.P, riccati.D, form.theta
    checks = [
        Check(f"omega satisfies a polynomial of degree {degree}", riccati.degree == degree),
        Check("the roots of the polynomial solve omega' + omega^2 = S", solves_riccati(S, riccati)),
        Check(
            "the sum of the roots is the logarithmic derivative of the semi-invariant",
            0 < form.degree == riccati.degree
            and form.P == P
            # theta + P'/P = A_1/(P D)
            and theta.num * D * P == (riccati.numerators[1] - D * P.derivative()) * theta.den,
        ),
    ]
    field = P.field
    if isinstance(field, AlgebraicField) and field != S.field:
        checks.append(Check(f"the polynomial of {field.name} is irreducible", _is_irreducible(field)))
    return checks


def _is_irreducible(field: AlgebraicField) -> bool:
    modulus: Poly = field.modulus
    factors = field.base.factor(modulus)
    return modulus.degree > 1 and len(factors) == 1 and factors[0] == (modulus, 1)


__all__ = ["Check", "Verification", "verify"]

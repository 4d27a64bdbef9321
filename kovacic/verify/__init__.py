"""The trusted kernel: does a decision hold?  Recomputed from S, by other code than the search.

A positive decision is checked by the identities for the form and for the polynomial of omega, and by the evidence against
every smaller structure, which makes that polynomial irreducible over C(x): without a rational omega a polynomial of degree
2 has no factor; a primitive group whose smaller ones are excluded has no omega of a smaller degree.  A negative one is
checked by the evidence against every structure.  Only exact arithmetic and arithmetic modulo primes in the direction in
which it proves something (a rank can only drop) is used.

S and a `Decision` go in, a `Verification` comes out.  Read `verify` here first, then `identity` for the positive claims and
`evidence`, with `local` and `residue`, for the negative ones; `group` and `torsion` check the group.
"""

from __future__ import annotations

from dataclasses import dataclass

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, GroupClaim, Status, Structure
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.verify.evidence import INVARIANT_DEGREE, Inspector
from kovacic.verify.identity import form_numerators, is_power, is_rational

#: The structures in the order of the proof, with the degree of omega.
_OMEGA_DEGREE = dict(zip(Structure, (1, 2, 4, 6, 12), strict=True))
_EXCLUDED = {structure: f"the Galois group isn't {structure.value} (case {structure.case})" for structure in Structure}


@dataclass(frozen=True)
class Check:
    """One statement that was checked, and whether it holds."""

    statement: str
    passed: bool


@dataclass(frozen=True)
class Verification:
    """All checks of one decision; true exactly when every one passed and there was something to check.

    `unchecked` has the statements that the kernel can't recompute.
    """

    checks: tuple[Check, ...]
    unchecked: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.checks) and all(check.passed for check in self.checks)

    def __str__(self) -> str:
        lines = [f"{'passed' if check.passed else 'FAILED'}: {check.statement}" for check in self.checks]
        return "\n".join([*lines, *(f"not checked: {statement}" for statement in self.unchecked)])


def verify(
    S: RatFunc, decision: Decision, group: GroupClaim | None = None, *, budget: Budget | None = None
) -> Verification:
    """Recompute everything that the decision claims about y'' = S y, and the group where it is claimed.

    Raises `LimitExceeded` when the budget (by default that of `kovacic.Limits()`) is used up before the group is reached.
    """
    inspector = Inspector(S, budget or Budget())
    structures, structure = list(_OMEGA_DEGREE), decision.structure
    claimed = [exclusion.structure for exclusion in decision.exclusions]
    if decision.status is Status.LIOUVILLIAN and structure is not None:
        checks = _positive(inspector, decision, structure)
        required = structures[: structures.index(structure)]
    else:
        nothing = (structure, decision.invariant, decision.semi_invariant, decision.riccati)
        checks = [] if nothing == (None,) * 4 else [Check("no solution is claimed", False)]
        required = structures if decision.status is Status.NONE_EXISTS else structures[: len(claimed)]
    if claimed != required:
        checks.append(Check("the structures before the answer's are excluded, each once", False))
    for exclusion in decision.exclusions:
        passed = inspector.excludes(exclusion.structure, exclusion.evidence)
        checks.append(Check(_EXCLUDED[exclusion.structure], passed))
    if group is None or not all(check.passed for check in checks):
        return Verification(tuple(checks))
    from kovacic.verify.group import group_holds  # which a decision alone doesn't need

    statement, why = "the Galois group is the one that is named", "its order wasn't determined"
    try:
        holds = group_holds(inspector, decision, group)
    except LimitExceeded as limit:
        holds, why = None, str(limit)
    if holds is None:
        return Verification(tuple(checks), (f"{statement}: {why}",))
    return Verification((*checks, Check(statement, holds)))


def _positive(inspector: Inspector, decision: Decision, structure: Structure) -> list[Check]:
    riccati, form, S = decision.riccati, decision.semi_invariant, inspector.S
    if riccati is None or form is None:
        return [Check("the polynomial of omega is there", False)]
    degree, P, field = _OMEGA_DEGREE[structure], riccati.P, riccati.P.field
    irreducible = []
    if isinstance(field, AlgebraicField) and field != S.field:
        irreducible = [Check(f"the polynomial of {field.name} is irreducible", _is_irreducible(field))]
        if not irreducible[0].passed:
            return irreducible
    fitting = form.degree == riccati.degree == degree and form.P == P
    numerators = form_numerators(S, form, riccati.D) if fitting else None
    return [
        *irreducible,
        Check(f"omega satisfies a polynomial of degree {degree}", riccati.degree == degree),
        Check("the roots of the polynomial solve omega' + omega^2 = S", numerators == [*riccati.numerators]),
        Check(
            "the sum of the roots is the logarithmic derivative of the semi-invariant",
            numerators is not None and numerators[1] == riccati.numerators[1],
        ),
        Check("P has its zeros at ordinary points", P.degree == 0 or P.gcd(S.den.over(field)).degree == 0),
        Check("the invariant is a rational form", _invariant_holds(inspector, decision, structure)),
    ]


def _invariant_holds(inspector: Inspector, decision: Decision, structure: Structure) -> bool:
    """A rational form of the structure's degree (perhaps a power of the semi-invariant); in case 1 there need not be one."""
    F, f, riccati = decision.invariant, decision.semi_invariant, decision.riccati
    if F is None or f is None or riccati is None:
        return structure is Structure.REDUCIBLE
    factors = inspector.factors if decision.exclusions else ()  # which the exclusions need as well
    rational = F.degree == INVARIANT_DEGREE[structure] and is_rational(F, factors)
    return rational and (is_power(F, f) or form_numerators(inspector.S, F, riccati.D) is not None)


def _is_irreducible(field: AlgebraicField) -> bool:
    return field.modulus.degree > 1 and field.base.factor(field.modulus) == [(field.modulus, 1)]


__all__ = ["Check", "GroupClaim", "Verification", "verify"]

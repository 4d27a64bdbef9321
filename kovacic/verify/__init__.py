"""The trusted kernel: a decision is checked by recomputing every claim from S, by other code than the search.

A positive decision is checked by the identities for the form and for the polynomial of omega, and by the evidence against
every smaller structure, which makes that polynomial irreducible over C(x): without a rational omega a polynomial of degree
2 has no factor; a primitive group whose smaller ones are excluded has no omega of a smaller degree.  A negative one is
checked by the evidence against every structure.  Only exact arithmetic and arithmetic modulo primes in the direction in
which it proves something (a rank can only drop) is used.

S and a `Decision` go in, a `Verification` comes out.  Read `verify` here first, then `identity` for the positive claims and
`evidence` for the negative ones: conditions at the points of `local`, forms by `series`, and `omega` with `zeros`, all modulo
`primes`.  `group` and `torsion` check the group.

With the search the kernel shares the arithmetic of polynomials and rational functions over the fields, with factoring and
square roots of constants, both of which it proves again; and the classes in which claims are written down.
Everything else is written again here, as plainly as possible; a contract in pyproject.toml forbids importing it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, GroupClaim, RiccatiPolynomial, SemiInvariant, Status, Structure
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget
from kovacic.verify.evidence import INVARIANT_DEGREE, Inspector
from kovacic.verify.factors import is_a_field
from kovacic.verify.identity import form_numerators, is_power, is_rational
from kovacic.verify.terminating import solves

#: The structures in the order of the proof, with the degree of omega.
_OMEGA_DEGREE = dict(zip(Structure, (1, 2, 4, 6, 12), strict=True))
_EXCLUDED = {structure: f"the Galois group isn't {structure.value} (case {structure.case})" for structure in Structure}


@dataclass(frozen=True)
class Check:
    """One statement that was checked.

    Attributes
    ----------
    statement : str
        A sentence.
    passed : bool
        True if it holds.
    """

    statement: str
    passed: bool


@dataclass(frozen=True)
class Verification:
    """All checks of one decision; true exactly when every one passed and there was something to check.

    Attributes
    ----------
    checks : tuple of Check
        What was recomputed.
    unchecked : tuple of str
        The statements that the kernel can't recompute.

    Examples
    --------
    >>> import kovacic
    >>> report = kovacic.solve("x").verify()
    >>> bool(report), report.unchecked, report.checks[0]
    (True, (), Check(statement="the Galois group isn't reducible (case 1)", passed=True))
    """

    checks: tuple[Check, ...]
    unchecked: tuple[str, ...] = ()

    def __repr__(self) -> str:
        passed = sum(check.passed for check in self.checks)
        return f"<Verification: {passed} of {len(self.checks)} checks passed, {len(self.unchecked)} not made>"

    def _repr_html_(self) -> str:
        rows = [(check.statement, _outcome(check)) for check in self.checks]
        rows += [(statement, "not checked") for statement in self.unchecked]
        return "".join(["<table>", *(f"<tr><td>{escape(s)}</td><td>{r}</td></tr>" for s, r in rows), "</table>"])

    def __bool__(self) -> bool:
        return bool(self.checks) and all(check.passed for check in self.checks)

    def __str__(self) -> str:
        lines = [f"{_outcome(check)}: {check.statement}" for check in self.checks]
        return "\n".join([*lines, *(f"not checked: {statement}" for statement in self.unchecked)])


def _outcome(check: Check) -> str:
    return "passed" if check.passed else "FAILED"


def verify(
    S: RatFunc,
    decision: Decision,
    group: GroupClaim | Callable[[], GroupClaim | None] | None = None,
    *,
    budget: Budget | None = None,
) -> Verification:
    """Recompute everything that the decision claims about y'' = S y, and the group where it is claimed.

    A function that finds the claim about the group is called once the decision has passed.  Raises `LimitExceeded` when the
    budget (by default that of `kovacic.Limits()`) is used up before the group is reached.
    """
    if not is_a_field(S.field):
        return Verification((Check("the polynomials of the constants are irreducible", False),))
    inspector = Inspector(S, budget or Budget())
    checks = (*_claimed_solution(inspector, decision), *_claimed_exclusions(inspector, decision))
    if group is None or not all(check.passed for check in checks):
        return Verification(checks)
    claim = group() if callable(group) else group
    if claim is None:
        return Verification(checks)
    from kovacic.verify.group import group_holds  # which a decision alone doesn't need

    statement = "the Galois group is the one that is named"
    try:
        holds = group_holds(inspector, decision, claim)
    except LimitExceeded as limit:
        return Verification(checks, (f"{statement}: {limit}",))
    if holds is None:
        return Verification(checks, (f"{statement}: its order wasn't determined",))
    return Verification((*checks, Check(statement, holds)))


def _claimed_exclusions(inspector: Inspector, decision: Decision) -> list[Check]:
    """Every structure before that of the answer is excluded, each once, in this order; all are where there is no solution."""
    claimed = [exclusion.structure for exclusion in decision.exclusions]
    required = [*_EXCLUDED]
    if decision.status is not Status.NONE_EXISTS:
        # The structures before the one found; for an undecided equation, as many as it claims.
        found = decision.status is Status.LIOUVILLIAN and decision.structure
        required = required[: required.index(found) if found else len(claimed)]
    checks = []
    if claimed != required:
        checks.append(Check("the structures before the answer's are excluded, each once", False))
    for exclusion in decision.exclusions:
        passed = inspector.excludes(exclusion.structure, exclusion.evidence)
        checks.append(Check(_EXCLUDED[exclusion.structure], passed))
    return checks


def _claimed_solution(inspector: Inspector, decision: Decision) -> list[Check]:
    """Checks of the polynomial of omega and of the forms; "no" and "undecided" must come without any."""
    riccati = decision.riccati
    form = decision.semi_invariant
    series = decision.series
    structure = decision.structure
    if decision.status is not Status.LIOUVILLIAN or structure is None:
        nothing = (structure, decision.invariant, form, riccati, series)
        return [] if nothing == (None,) * 5 else [Check("no solution is claimed", False)]
    if series is not None:
        is_alone = structure is Structure.REDUCIBLE and (decision.invariant, form, riccati) == (None,) * 3
        field = series.theta.field
        is_over = field == inspector.S.field or (is_a_field(field) and field.extends(inspector.S.field))
        right = is_alone and is_over and solves(inspector.S, series)
        return [Check("exp(int theta) P solves y'' = S y, by the recurrence for P, which ends", right)]
    if riccati is None or form is None:
        return [Check("the polynomial of omega is there", False)]
    irreducible = []
    field = riccati.P.field
    if isinstance(field, AlgebraicField) and field != inspector.S.field:  # the constant that omega brings along
        irreducible = [Check(f"the polynomial of {field.name} is irreducible", is_a_field(field))]
        if not irreducible[0].passed:
            return irreducible
    # The identities of `identity`, for a form of the structure's degree whose linear factors are the solutions.
    degree = _OMEGA_DEGREE[structure]
    P = riccati.P
    numerators = None
    if form.degree == riccati.degree == degree and form.P == P:
        numerators = form_numerators(inspector.S, form, riccati.D)
    same_sum = numerators is not None and numerators[1] == riccati.numerators[1]
    ordinary = P.degree == 0 or P.gcd(inspector.S.den.over(P.field)).degree == 0
    return [
        *irreducible,
        Check(f"omega satisfies a polynomial of degree {degree}", riccati.degree == degree),
        Check("the roots of the polynomial solve omega' + omega^2 = S", numerators == [*riccati.numerators]),
        Check("the sum of the roots is the logarithmic derivative of the semi-invariant", same_sum),
        Check("P has its zeros at ordinary points", ordinary),
        Check("the invariant is a rational form", _invariant_holds(inspector, decision, structure, form, riccati)),
    ]


def _invariant_holds(
    inspector: Inspector, decision: Decision, structure: Structure, form: SemiInvariant, riccati: RiccatiPolynomial
) -> bool:
    """A rational form of the structure's degree (perhaps a power of the semi-invariant); in case 1 there need not be one."""
    F = decision.invariant
    if F is None:
        return structure is Structure.REDUCIBLE
    if F.degree != INVARIANT_DEGREE[structure] or not is_rational(F):
        return False
    return is_power(F, form) or form_numerators(inspector.S, F, riccati.D) is not None


__all__ = ["Check", "GroupClaim", "Verification", "verify"]

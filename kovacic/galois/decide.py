"""The group for each outcome of Kovacic's algorithm.

Symbols: omega = y1'/y1 = theta + P'/P; F a rational form of degree 2 in the solutions.

- Two rational omegas: the group is diagonal, mu_n or G_m; y1^n is rational exactly when n omega has simple poles with
  integer residues only.
- One rational omega: {(c, b; 0, 1/c)} with all b in C, and c^n = 1 or c arbitrary by the same condition.
- omega of degree 2: see `imprimitive`.
- Otherwise the structure determines the group.

References: Kovacic 1986, section 1; Hendriks & van der Put, J. Symb. Comp. 19 (1995).
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, SemiInvariant, Structure, TerminatingSeries
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Problem, analyse
from kovacic.engine.riccati import Form
from kovacic.engine.terminating import search_series
from kovacic.errors import LimitExceeded
from kovacic.galois.group import Ground, Group, GroupKind
from kovacic.galois.imprimitive import imprimitive_group
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits


def group_of(S: RatFunc, decision: Decision, limits: Limits = DEFAULT_LIMITS) -> Group | None:
    """The differential Galois group of y'' = S y; None if the equation is undecided, or a limit keeps a reducible group from
    being determined.

    The decision must be certified (with its semi-invariant).  Whatever is claimed is proven: where a limit of the work
    keeps the order of an imprimitive group from being determined, the kind of the group says so.
    """
    if decision.undecided is not None:
        return None
    if decision.series is not None:
        return _group_of_series(analyse(S, Budget(limits)), decision.series)
    if decision.structure is None:
        return Group(GroupKind.SL2, Ground.NO_LIOUVILLIAN)
    if decision.structure.case == 3:
        return Group(GroupKind(decision.structure.value), Ground.PRIMITIVE)
    assert decision.semi_invariant is not None
    problem = analyse(S, Budget(limits))
    if decision.structure is Structure.IMPRIMITIVE:
        return imprimitive_group(problem, decision.semi_invariant)
    try:
        return _reducible_group(problem, decision.semi_invariant, decision.invariant)
    except LimitExceeded:
        return None


def _group_of_series(problem: Problem, series: TerminatingSeries) -> Group | None:
    """The group if P is known by its recurrence and no other omega is rational; None if another one may be."""
    search = search_series(problem)
    if search is None or not (search.known and search.complete) or len(search.found) > 1:
        return None
    residues = residues_or_ground(series.theta)
    if isinstance(residues, Ground):
        return Group(GroupKind.BOREL, residues)
    return Group(GroupKind.ADDITIVE, Ground.RESIDUES, lcm(1, *(r.denominator for r in residues)))


def _reducible_group(problem: Problem, f: SemiInvariant, F: SemiInvariant | None) -> Group:
    """The group by its rational forms of degree 2: none, y1^2 alone, y1 y2 alone, or all.  F is a known one, or None."""
    residues = residues_or_ground(f.theta)
    are_all_rational = False
    if F is None or _is_square_of_solution(problem, F):
        found = invariants(problem, 2)
        forms = found if isinstance(found, list) else []  # else evidence that there are none
        are_all_rational = len(forms) == 3
        if F is None and forms:
            F = forms[0].semi_invariant(problem)
    if isinstance(residues, Ground):
        kind = GroupKind.BOREL if F is None else GroupKind.MULTIPLICATIVE
        return Group(kind, residues, form=F)
    n = lcm(1, *(r.denominator for r in residues))
    has_two_omegas = F is not None and not _is_square_of_solution(problem, F)
    if has_two_omegas:
        return Group(GroupKind.CYCLIC, Ground.RESIDUES, n, F)
    if are_all_rational:
        return Group(GroupKind.CYCLIC, Ground.ALL_INVARIANT, n, F)
    # y1^n is rational, and the second solution y1 int y1^-2 isn't, over C(x, y1)
    return Group(GroupKind.ADDITIVE, Ground.RESIDUES, n, F)


def _is_square_of_solution(problem: Problem, F: SemiInvariant) -> bool:
    """True if the quadratic form is the square of a solution: F'^2 - 2 F F'' + 4 S F^2, A1^2 - 4 A0 A2 over D^2, is 0."""
    R = (F.theta * problem.D).num
    A0, A1, A2 = Form(2, R, F.P).numerators(problem)[:3]
    return A1 * A1 == 4 * A0 * A2


def residues_or_ground(theta: RatFunc) -> list[Fraction] | Ground:
    """The residues of a rational function that has only simple poles with rational residues, else why that fails.

    A pole at infinity counts: theta must vanish there.  Residues of c p'/p are constant on p; others aren't rational.
    """
    parts = decompose(theta)
    residues = [residue.rational for residue in parts.residues if residue.rational is not None]
    if parts.exact:
        return Ground.EXPONENTIAL
    return residues if len(residues) == len(parts.residues) else Ground.IRRATIONAL

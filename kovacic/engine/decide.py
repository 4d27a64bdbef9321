"""The decision: Kovacic's cases in order, each only if local data leave it possible.

This is the only place that knows the order.  A positive outcome carries the exclusion of everything before it, so that the
degree of omega is proven to be the least one.

Reference: J. Kovacic, "An algorithm for solving second order linear homogeneous differential equations", J. Symb. Comp. 2
(1986) 3-43.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Exclusion, RiccatiPolynomial, Structure
from kovacic.engine import reducible
from kovacic.engine.irreducible import decide_imprimitive, decide_primitive
from kovacic.engine.places import Problem, analyse, excluded_by_local_data
from kovacic.engine.riccati import Found, Outcome
from kovacic.errors import LimitExceeded, VerificationFailed
from kovacic.limits import Budget

_DECIDERS: dict[Structure, Callable[[Problem], Outcome]] = {
    Structure.REDUCIBLE: reducible.decide_rational_omega,
    Structure.IMPRIMITIVE: decide_imprimitive,
    Structure.TETRAHEDRAL: partial(decide_primitive, structure=Structure.TETRAHEDRAL),
    Structure.OCTAHEDRAL: partial(decide_primitive, structure=Structure.OCTAHEDRAL),
    Structure.ICOSAHEDRAL: partial(decide_primitive, structure=Structure.ICOSAHEDRAL),
}


def decide(S: RatFunc, budget: Budget, *, certify: bool = True) -> Decision:
    """The structure of the Galois group of y'' = S y, and the form that shows it.

    With `certify=False` the polynomial of omega isn't computed.  An exhausted budget gives a decision with `undecided` set,
    and with the exclusions that were reached.
    """
    exclusions: list[Exclusion] = []
    try:
        problem = analyse(S, budget)
        impossible = excluded_by_local_data(problem)
        for structure, decider in _DECIDERS.items():
            if structure in impossible:
                exclusions.append(Exclusion(structure, (impossible[structure],)))
                continue
            budget.check()
            outcome = decider(problem)
            if isinstance(outcome, Found):
                return _certified(problem, outcome, tuple(exclusions), certify)
            exclusions += outcome
    except LimitExceeded as limit:
        return Decision(None, tuple(exclusions), undecided=str(limit))
    return Decision(None, tuple(exclusions))


def decide_reducible(S: RatFunc, budget: Budget) -> Decision | None:
    """The decision with its certificate where the group is reducible (case 1); None elsewhere, or without budget."""
    try:
        problem = analyse(S, budget)
        if Structure.REDUCIBLE in excluded_by_local_data(problem):
            return None
        outcome = reducible.decide_rational_omega(problem)
        return _certified(problem, outcome, (), True) if isinstance(outcome, Found) else None
    except LimitExceeded:
        return None


def _certified(problem: Problem, found: Found, exclusions: tuple[Exclusion, ...], certify: bool) -> Decision:
    invariant = None if found.invariant is None else found.invariant.semi_invariant(problem)
    if not certify or found.form is None:
        return Decision(found.structure, exclusions, invariant=invariant, series=found.series)
    form = found.form()
    *numerators, remainder = form.numerators(problem)
    if remainder:
        raise VerificationFailed("the engine proposed a form that isn't one; please report the equation")
    return Decision(
        found.structure,
        exclusions,
        invariant=invariant,
        semi_invariant=form.semi_invariant(problem),
        riccati=RiccatiPolynomial(form.P, problem.D, tuple(numerators)),
    )

"""For which values of the parameters is the equation solvable?  From the input to `ParametricAnswer`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.decision import Decision, Status
from kovacic.equation import PI, Parsed, over, parameters_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Budget, Limits
from kovacic.numbers.exact import whole
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.parametric.check import check_each_region
from kovacic.parametric.derivation import derived
from kovacic.parametric.letters import Letters, nonzero, own_parameters, spelled
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.restriction import with_free_constant
from kovacic.reading.read import read_input
from kovacic.reading.substitution import with_values

#: The largest d for which the determinants of conditions with a natural number d are computed.
DEFAULT_DEGREE = 2


def find_conditions(
    S: Any,
    *,
    var: Any,
    assume: Mapping[Any, Any] | None,
    max_degree: int,
    limits: Limits,
    names: Sequence[str] = (),
) -> ParametricAnswer:
    """What `kovacic.conditions` returns, as data: arguments and exceptions are the same."""
    with Budget(limits).watched():
        parsed = read_input(S, var=var, limits=limits, exponentials=True, names=names)
        given = parsed
        S, parsed, assume = with_values(S, parsed, assume, limits)
    parsed, letters = spelled(parsed)
    names = parameters_of(parsed.S.field)
    if not names:
        what = "S has no parameters"
        if parsed is not given:
            what = "every parameter has a value"
        elif var is None and parsed.S.degree:  # one was taken for x, maybe
            what += f": {parsed.variable} is taken for the variable"
        hint = "solve decides equations without parameters;"
        python = f"{hint} var= says which name is the variable"
        raise InputError(what, hint=python, shell=f"{hint} --var says which name is the variable")
    most = whole(max_degree, "max_degree")
    known = read_assumptions(assume, S, names)
    if PI in names:
        known = known.also(PI, ("irrational", "positive"))
    for name in nonzero(letters):
        known = known.also(name, ("nonzero",))
    found = conditions_of(parsed, known, most, limits, letters)
    return replace(found, given=S) if isinstance(S, str) else found


def conditions_of(
    parsed: Parsed, known: Assumptions, max_degree: int | None, limits: Limits, letters: Letters = ()
) -> ParametricAnswer:
    """The conditions for an input that was read; `max_degree` None: by theorems only."""
    budget = Budget(limits)
    if parsed.equation is not None:  # an algebraic constant of the gauge is one of the answer
        parsed = replace(parsed, S=over(parsed.S, parsed.equation.a.field))
    _, shown, constant = with_free_constant(parsed.S)
    notices = [notice for notice in parsed.notices if notice in parsed.guesses or "parameter" not in notice]
    if isinstance(constant.field, AlgebraicField):  # the constant has its own name among the parameters
        name = rf"\b{re.escape(constant.field.name)}\b"
        notices = [re.sub(name, constant.names[0], notice) for notice in notices]
    found = derived(parsed.S, parsed.variable, parsed.equation, known, budget, max_degree, letters)
    answer = ParametricAnswer(
        S=shown,
        variable=parsed.variable,
        parameters=own_parameters(parameters_of(parsed.S.field), letters),
        generic=found.generic,
        regions=found.regions,
        complete=found.complete,
        theory=found.theory,
        limits=limits,
        notices=tuple(notices),
        assumptions=known,
        constant=constant,
        equation=parsed.equation,
        letters=letters,
    )
    with budget.watched(), suppress(LimitExceeded):  # as far as time allows
        check_each_region(answer)
    return answer


def under_assumptions(
    parsed: Parsed, decision: Decision, known: Assumptions, limits: Limits, *, certify: bool
) -> tuple[Decision, str, bool]:
    """The decision where the assumptions hold, a sentence that says for which of these values, and is that proven?

    Where the assumptions imply another case, that is the decision if no certificate is asked for.  Else there is none, because
    omega depends on the value of a parameter, so that no single omega is the answer; its reason says the case, which is proven.
    """
    if decision.status is Status.UNDECIDED:
        return decision, "", False
    answer = conditions_of(parsed, known, None, limits)
    if answer.complete is not True:
        return decision, f"whether all values with {known} are generic ones isn't known ({answer.theory})", False
    if answer.generic.case != decision.case:
        if not certify:
            return Decision(answer.generic.structure, ()), "", True
        # The case that isn't the generic one, for all values with the assumptions.
        reason = (
            f"case {answer.generic.case} for all values with {answer.assumptions}{_exceptions(answer)} ({answer.theory}); "
            "omega depends on the values: give some, or use kovacic.conditions, its theorem and solve_at"
        )
        return Decision(None, (), undecided=reason), "", True
    return decision, f"with {known} the answer holds{_exceptions(answer)} ({answer.theory})", True


def _exceptions(answer: ParametricAnswer) -> str:
    exceptions = " or ".join(str(region.statement) for region in answer.regions)
    return f" except where {exceptions}" if exceptions else ""

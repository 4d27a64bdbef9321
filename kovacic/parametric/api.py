"""For which values of the parameters is the equation solvable?  From the input to `ParametricAnswer`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Status
from kovacic.engine.decide import decide
from kovacic.equation import PI, Equation, Parsed, parameters_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.exact import whole
from kovacic.limits import Budget, Limits, bounded_work
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.parametric.cases import without_redundant
from kovacic.parametric.check import check_each_region
from kovacic.parametric.functions import ParameterPoint
from kovacic.parametric.natural import Natural
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.partition import LIMITED, Partition, Settings, as_far_as, partition, together
from kovacic.parametric.powers import in_powers
from kovacic.parametric.regions import (
    ParameterRegion,
    RegionVerdict,
    equations_on,
    settled,
    without_empty,
    without_implied,
)
from kovacic.parametric.restriction import reduced, with_free_constant
from kovacic.parametric.solutions import Given
from kovacic.parametric.statements import Statement
from kovacic.reading.read import read_input
from kovacic.reading.substitution import with_values

#: Strata of parameter space up to which they are examined: Heun's general equation, in six parameters, has some hundreds.
_STRATA = 4000
#: The largest d for which the determinants of conditions with a natural number d are computed.
DEFAULT_DEGREE = 2


def find_conditions(
    S: Any, *, var: Any, assume: Mapping[Any, Any] | None, max_degree: int, limits: Limits
) -> ParametricAnswer:
    """What `kovacic.conditions` returns, as data: arguments and exceptions are the same."""
    with Budget(limits).watched():
        parsed = read_input(S, var=var, limits=limits, exponentials=True)
        given = parsed
        S, parsed, assume = with_values(S, parsed, assume, limits)
    names = parameters_of(parsed.S.field)
    if not names:
        raise _without_parameters(parsed, given, is_guessed=var is None)
    most = whole(max_degree, "max_degree")
    known = read_assumptions(assume, S, names)
    if PI in names:
        known = known.also(PI, ("irrational", "positive"))
    return conditions_of(parsed, known, most, limits)


def _without_parameters(parsed: Parsed, given: Parsed, *, is_guessed: bool) -> InputError:
    """What is said where all parameters of the `given` input got values, or there were none; maybe one was taken for x."""
    if parsed is not given:
        what = "every parameter has a value"
    elif is_guessed and parsed.S.degree:
        what = f"S has no parameters: {parsed.variable} is taken for the variable"
    else:
        what = "S has no parameters"
    hint = "solve decides equations without parameters;"
    python = f"{hint} var= says which name is the variable"
    return InputError(what, hint=python, shell=f"{hint} --var says which name is the variable")


def conditions_of(parsed: Parsed, known: Assumptions, max_degree: int | None, limits: Limits) -> ParametricAnswer:
    """The conditions for an input that was read; `max_degree` None: by theorems only."""
    lifted, shown, constant = with_free_constant(parsed.S)
    assumptions = replace(known, values=tuple(zip(constant.names, constant.values, strict=True)))
    budget = Budget(limits)
    settings = Settings(budget, parsed.variable, only_theorems=max_degree is None)
    with budget.watched():
        with bounded_work(_STRATA):
            found = partition(lifted, settings)
        if found.complete is not True:
            found = _in_powers(lifted, settings, found)
    field = lifted.field.ground
    assert isinstance(field, FunctionField)
    regions = _distinct(found.regions, constant, budget)
    result = _under(assumptions, replace(found, regions=tuple(regions)), parsed.S, budget)
    with budget.watched(), suppress(LimitExceeded):
        generic = result.generic if result.complete is True else None
        result = replace(result, regions=tuple(without_redundant(result.regions, generic)))
    regions = settled(result.regions, parsed.variable, field.names, constant.names)
    regions = [_finished(region, parsed.equation, max_degree, budget) for region in regions]
    answer = ParametricAnswer(
        S=shown,
        variable=parsed.variable,
        parameters=parameters_of(parsed.S.field),
        generic=result.generic,
        regions=tuple(regions),
        complete=result.complete,
        theory=result.theory,
        limits=limits,
        notices=_notices(parsed, constant),
        assumptions=known,
        constant=constant,
        equation=parsed.equation,
    )
    with budget.watched(), suppress(LimitExceeded):  # as far as time allows
        check_each_region(answer)
    return answer


def _in_powers(S: RatFunc, settings: Settings, direct: Partition) -> Partition:
    """The partition by powers of the parameters, where it is complete; else the direct one."""
    try:
        powers = in_powers(S)
        if powers is None:
            return direct
        with bounded_work(_STRATA):
            found = partition(powers.S, settings)
    except LimitExceeded as limit:
        return replace(direct, complete=as_far_as(limit))
    if found.complete is True:
        return replace(found, regions=tuple(map(powers.back, found.regions)))
    is_limited = str(found.complete).startswith(LIMITED)
    return replace(direct, complete=found.complete) if is_limited else direct


def _distinct(regions: Iterable[ParameterRegion], constant: ParameterPoint, budget: Budget) -> list[ParameterRegion]:
    """The regions with statements about all parameters, each statement once, and without those that earlier ones cover."""
    different: dict[Statement, ParameterRegion] = {}
    for region in regions:
        statement = without_implied(reduced(region.statement, constant))
        different.setdefault(statement, replace(region, statement=statement))
    distinct = [*different.values()]
    with budget.watched(), suppress(LimitExceeded):
        distinct = without_empty(distinct)
    return distinct


def _under(assumptions: Assumptions, found: Partition, S: RatFunc, budget: Budget) -> Partition:
    """What is left to say where the assumptions hold."""
    generic = found.generic
    complete = found.complete
    regions: list[ParameterRegion] = []
    for region in found.regions:
        decided = region.statement.decided(assumptions)
        if decided is True:
            generic = region.verdict
            if not generic.known:
                generic = RegionVerdict.of(decide(S, budget, certify=False))
            complete = together([*regions, region])
            break
        statement = region.statement.narrowed(assumptions)
        if decided is None and statement.decided(assumptions) is not False:
            regions.append(replace(region, statement=statement))
    return Partition(generic, complete, found.theory, tuple(regions))


def _finished(
    region: ParameterRegion, equation: Equation | None, max_degree: int | None, budget: Budget
) -> ParameterRegion:
    """With its first determinants, and solutions of the equation that was given."""
    if region.origin is not None and equation is not None:
        there = equations_on(region.statement, equation)
        origin = Given(region.origin, tuple((one.equation, one.zeros) for one in there)) if there else None
        region = replace(region, origin=origin)
    statement = region.statement
    if max_degree is None or not isinstance(statement, Natural) or statement.m > 1:
        return region
    determinants: list[str] = []
    with budget.watched(), suppress(LimitExceeded):  # as far as time allows
        determinants.extend(map(statement.shown_determinant, range(max_degree + 1)))
    return replace(region, determinants=tuple(determinants))


def _notices(parsed: Parsed, constant: ParameterPoint) -> tuple[str, ...]:
    """What was noticed at reading, with the constant's own name among the parameters."""
    notices = [notice for notice in parsed.notices if "parameter" not in notice]
    if isinstance(constant.field, AlgebraicField):
        name = rf"\b{re.escape(constant.field.name)}\b"
        notices = [re.sub(name, constant.names[0], notice) for notice in notices]
    return tuple(notices)


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
        return Decision(None, (), undecided=_for_all_of_them(answer)), "", True
    return decision, f"with {known} the answer holds{_exceptions(answer)} ({answer.theory})", True


def _exceptions(answer: ParametricAnswer) -> str:
    exceptions = " or ".join(str(region.statement) for region in answer.regions)
    return f" except where {exceptions}" if exceptions else ""


def _for_all_of_them(answer: ParametricAnswer) -> str:
    """The case that isn't the generic one, for all values with the assumptions."""
    return (
        f"case {answer.generic.case} for all values with {answer.assumptions}{_exceptions(answer)} ({answer.theory}); omega "
        "depends on the values: give some, or use kovacic.conditions, its theorem and solve_at"
    )

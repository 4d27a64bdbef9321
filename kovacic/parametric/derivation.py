"""From S to the regions of parameter space, each said once, under assumptions, with solutions of the given equation."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from functools import partial

from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.decide import decide
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, bounded_work
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.cases import without_empty, without_redundant
from kovacic.parametric.charts import equations_on, normal_form, without_implied
from kovacic.parametric.functions import ParameterPoint
from kovacic.parametric.letters import Letters
from kovacic.parametric.natural import Natural
from kovacic.parametric.partition import Partition, Settings, partition, together
from kovacic.parametric.powers import in_powers
from kovacic.parametric.regions import Limited, ParameterRegion, settled, verdict_of
from kovacic.parametric.restriction import in_lowest_powers, with_free_constant
from kovacic.parametric.solutions import GivenSolutions, Origin
from kovacic.parametric.statements import Statement

#: Strata of parameter space up to which they are examined: Heun's general equation, in six parameters, has some hundreds.
_STRATA = 4000


def derived(
    S: RatFunc,
    variable: str,
    equation: Equation | None,
    known: Assumptions,
    budget: Budget,
    max_degree: int | None,
    letters: Letters = (),
) -> Partition:
    """The partition of parameter space for S; `max_degree` None: by theorems only, else Delta_d is shown up to this d."""
    lifted, _, constant = with_free_constant(S)
    assumptions = replace(known, values=tuple(zip(constant.names, constant.values, strict=True)))
    settings = Settings(budget, variable, only_theorems=max_degree is None)
    with budget.watched():
        with bounded_work(_STRATA):
            found = partition(lifted, settings)
        if found.complete is not True:
            found = _in_powers(lifted, settings, found)
    field = lifted.field.ground
    assert isinstance(field, FunctionField)
    regions = _distinct(found.regions, constant, budget)
    result = _under(assumptions, replace(found, regions=tuple(regions)), S, budget)
    with budget.watched(), suppress(LimitExceeded):
        generic = result.generic if result.complete is True else None
        result = replace(result, regions=tuple(without_redundant(result.regions, generic)))
    regions = settled(result.regions, variable, field.names, constant)
    given = equation or normal_form(lifted, variable)
    return replace(result, regions=tuple([_finished(region, given, max_degree, budget, letters) for region in regions]))


def _in_powers(S: RatFunc, settings: Settings, direct: Partition) -> Partition:
    """The partition by powers of the parameters, where it is complete; else the direct one."""
    try:
        powers = in_powers(S)
        if powers is None:
            return direct
        with bounded_work(_STRATA):
            found = partition(powers.S, settings)
    except LimitExceeded as limit:
        return replace(direct, complete=Limited.by(limit))
    if found.complete is True:
        return replace(found, regions=tuple(map(powers.back, found.regions)))
    return replace(direct, complete=found.complete) if isinstance(found.complete, Limited) else direct


def _distinct(regions: Iterable[ParameterRegion], constant: ParameterPoint, budget: Budget) -> list[ParameterRegion]:
    """The regions with statements about all parameters, each statement once, and without those that earlier ones cover."""
    different: dict[Statement, ParameterRegion] = {}
    for region in regions:
        # With high powers of the constant replaced by means of its minimal polynomial.
        reduced = region.statement.rewritten(partial(in_lowest_powers, constant=constant))
        statement = without_implied(reduced)
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
                generic = verdict_of(decide(S, budget, certify=False))
            complete = together([*regions, region])
            break
        statement = region.statement.narrowed(assumptions)
        if decided is None and statement.decided(assumptions) is not False:
            regions.append(replace(region, statement=statement))
    return Partition(generic, complete, found.theory, tuple(regions))


def _finished(
    region: ParameterRegion, equation: Equation, max_degree: int | None, budget: Budget, letters: Letters
) -> ParameterRegion:
    """With solutions of the equation that was given, and the degree up to which determinants are shown."""
    statement = region.statement
    if region.origin is not None:
        pieces = tuple(equations_on(region.statement, equation))
        # With an algebraic constant the statement knows its value; the origin is about all values.
        origin: Origin = region.origin
        if isinstance(statement, Natural) and statement.constant.names:
            origin = partial(statement.solutions, equation.variable)
        region = replace(region, origin=GivenSolutions(origin, pieces, letters) if pieces else None)
    if max_degree is None or not isinstance(statement, Natural) or statement.m > 1:
        return region
    return replace(region, shown_degree=max_degree, limits=budget.limits)

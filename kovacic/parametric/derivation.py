"""From S to the regions of parameter space, each said once, under assumptions, with solutions of the given equation.

Where a parameter t occurs in S in powers of t^k only, there are conditions for T = t^k, too, and what they say of t: on a
hypersurface such as 4 w^2 + 1 = 0 no parameter is eliminated; on 4 W + 1 = 0 one is.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from math import gcd

import sympy

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.decide import decide
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, bounded_work
from kovacic.numbers.numerals import as_text
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.cases import equations_on, normal_form, without_empty, without_implied, without_redundant
from kovacic.parametric.functions import ParameterPoint, element, irreducible_factors, over_parameters, powers_of, union
from kovacic.parametric.integers import Congruence, integer_roots
from kovacic.parametric.letters import Letters
from kovacic.parametric.natural import Natural
from kovacic.parametric.partition import Partition, Settings, partition, together
from kovacic.parametric.regions import Limited, ParameterRegion, settled, verdict_of
from kovacic.parametric.restriction import in_lowest_powers, with_free_constant
from kovacic.parametric.solutions import Carried, GivenSolutions, Origin, PolynomialSolution
from kovacic.parametric.statements import Both, Either, Statement, Vanishes, both, either
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class InPowers:
    """S with T for t^k, T by the name of t, and the k of each parameter."""

    S: RatFunc
    powers: tuple[int, ...]

    def back(self, region: ParameterRegion) -> ParameterRegion:
        """What a region of T says of t."""
        field = self.S.field
        assert isinstance(field, FunctionField)
        names = dict(zip(field.names, self.powers, strict=True))
        origin = region.origin and Carried(region.origin, partial(_with_powers, names))

        def raised(function: FunctionPoly) -> FunctionPoly:  # of some of the parameters
            own = function.field
            values = [own.generator(name) ** names.get(name, 1) for name in own.names]
            return over_parameters(function.value_at(values, own))

        statement = _in_factors(region.statement.rewritten(raised))
        return replace(region, statement=statement, origin=origin)


def _with_powers(powers: Mapping[str, int], solution: PolynomialSolution) -> PolynomialSolution:
    """A solution with t^k for T."""
    raised = solution.with_values({sympy.Symbol(name): sympy.Symbol(name) ** k for name, k in powers.items()})
    if not raised.conditions and raised.where:
        return raised
    where = ", ".join(f"{caret(as_text(sympy.factor(condition)))} = 0" for condition in raised.conditions)
    return replace(raised, where=where)


def in_powers(S: RatFunc) -> InPowers | None:
    """None where each parameter occurs in powers without a common divisor."""
    field = S.field
    assert isinstance(field, FunctionField)
    parts = [over_parameters(part) for part in S.cleared()]
    occurring = [[n for part in parts for n in powers_of(part, i)] for i in range(len(field.names))]
    powers = tuple(gcd(*found) or 1 for found in occurring)  # the largest k for which t occurs in powers of t^k only
    if max(powers) == 1:
        return None
    lowered: list[FunctionPoly] = []
    for part in parts:
        terms = {}
        for (first, *exponents), coefficient in part.num.to_dict().items():  # t^(k n) -> T^n
            terms[(first, *(n // k for n, k in zip(exponents, powers, strict=True)))] = coefficient
        lowered.append(element(part.field, part.field.context.from_dict(terms)))
    return InPowers(RatFunc(*lowered), powers)


def _in_factors(statement: Statement) -> Statement:
    """The same statement, said of irreducible polynomials: T and T - t are, t^2 and t^2 - s^2 aren't."""
    if isinstance(statement, Both):
        return both(*map(_in_factors, statement.parts))
    if isinstance(statement, Either):
        return either(*map(_in_factors, statement.parts))
    if isinstance(statement, Vanishes):
        return either(*map(Vanishes, irreducible_factors(statement.function)))
    if isinstance(statement, Congruence) and statement.form is None:
        return integer_roots(statement.equation, [*map(int, statement.residues)], int(statement.modulus))
    if isinstance(statement, Natural) and statement.factors is not None:
        factored = [equation.field.factor(equation) for equation in statement.factors]  # over Q(t)
        factors = union([over_parameters(factor) for factor, _ in one] for one in factored)
        return replace(statement, factors=tuple(factors))
    return statement


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

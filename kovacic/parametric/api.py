"""The values of the parameters for which an equation is solvable: from the input to a `ParametricAnswer`, and its check.

Printed conditions are compared with the engine and its kernel at exact points inside and outside of the regions.  There a claim
has to agree with the statement from which it was made, the verdict with the engine's result, which the kernel verifies, and
each formula has to solve the given equation.  One point in each region is always compared, more by `check_at_samples`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain, cycle, islice
from random import Random
from typing import Any

import sympy
from flint import acb, fmpq

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Decision, Status
from kovacic.derived import group
from kovacic.equation import Equation, Parsed, over, parameters_of
from kovacic.errors import InputError, LimitExceeded, VerificationFailed
from kovacic.limits import Budget, Limits
from kovacic.numbers.exact import whole
from kovacic.parametric.assumptions import COMPARED_BITS, Assumptions, read_assumptions
from kovacic.parametric.claims import (
    Claim,
    DegreeExists,
    IntegerFamily,
    ParameterPoint,
    Several,
    coefficients_in,
    degrees,
    irreducible_factors,
    over_parameters,
)
from kovacic.parametric.natural import DEFAULT_DEGREE
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.partition import derived
from kovacic.parametric.regions import (
    ABELIAN,
    NOT_ABELIAN,
    ParameterRegion,
    equation_at,
    normal_form_equation,
    verdict_from_engine,
)
from kovacic.parametric.restriction import Letters, nonzero, own_parameters, spelled, transcendental, with_free_constant
from kovacic.parametric.solutions import Carried
from kovacic.parametric.statements import ALWAYS, Statement, Vanishes
from kovacic.reading.change_of_variable import function_of_x, user_variable
from kovacic.reading.read import read_input
from kovacic.reading.substitution import with_assumed_values


@dataclass(frozen=True)
class CheckReport:
    """The outcome of `kovacic.solution.conditions.Conditions.check`: true if every sample agrees.

    Attributes
    ----------
    inside, outside : int
        The number of points that were solved in a special region, and in the generic one.
    open : int
        The number of points for which the regions claim nothing.
    disagreements : tuple of str
        One sentence per false statement, beginning with the point.
    """

    inside: int
    outside: int
    open: int
    disagreements: tuple[str, ...]

    def __bool__(self) -> bool:
        return not self.disagreements


def check_each_region(found: ParametricAnswer) -> None:
    """Check the printed claims at a point in each region, on each stratum and outside; raises `VerificationFailed`."""
    sampler = Sampler(found.constant, found.names, found.assumptions, Random(1))
    points = [sampler.point_in(found, region) for region in (*found.regions, None)]
    strata = chain.from_iterable(_strata(region.statement.claim) for region in found.regions)
    points += [sampler.point(Vanishes(zero)) for zero in dict.fromkeys(strata)]
    for point in filter(None, points):
        wrong = next(contradictions(found, point), None)
        if wrong is not None:
            raise VerificationFailed(f"conditions failed their own check at {point}: {wrong}; please report it")


def check_at_samples(found: ParametricAnswer, samples: int, seed: int) -> CheckReport:
    """Compare the printed claims with engine and kernel at this number of points, or fewer if time runs out."""
    sampler = Sampler(found.constant, found.names, found.assumptions, Random(seed))
    points = islice(sampler.points([region.statement for region in found.regions]), 20 * samples)
    counts = Counter[str](inside=0, outside=0, open=0)
    wrong = list[str]()
    with Budget(found.limits).watched(), suppress(LimitExceeded):
        for point in filter(None, points):
            predicted = found.predicted(point)
            if predicted is None:
                continue
            inside = "outside" if found.region_at(point) is None else "inside"
            counts[inside if predicted.known else "open"] += 1
            wrong += [f"{point}: {sentence}" for sentence in contradictions(found, point)]
            if counts.total() == samples:
                break
    return CheckReport(**counts, disagreements=tuple(wrong))


def _strata(claim: Claim) -> Iterator[FunctionPoly]:
    """The functions of the parameters that are denominators in a printed claim."""
    if isinstance(claim, IntegerFamily):
        below = over_parameters(claim.value.cleared()[1])
        yield from (factor for factor in irreducible_factors(below) if not factor.degree)
    elif isinstance(claim, DegreeExists):
        yield from _strata(claim.degree)
    elif isinstance(claim, Several):
        yield from chain.from_iterable(map(_strata, claim.parts))


def contradictions(found: ParametricAnswer, point: ParameterPoint) -> Iterator[str]:
    """The printed claims that are false at a point, one sentence each."""
    inside = found.region_at(point)
    for region in found.regions:
        holds = region is inside
        if region.statement.claim.holds(point) is not holds:
            yield f"{region.statement} is printed, and {'holds' if holds else 'does not hold'} there"
        if holds:
            break
    predicted = found.predicted(point)
    if predicted is None or not predicted.known:
        return
    answer = found.answer_at(point)
    if answer.status is not Status.UNDECIDED and answer.case != predicted.case:
        yield f"{predicted} is printed, {verdict_from_engine(answer.decision)} is found"
    # The kernel has verified the group of the answer.
    printed = predicted.abelian
    known = group(answer) if printed in (ABELIAN, NOT_ABELIAN) else None
    if known is not None and known.dimension is not None and (known.dimension < 2) is not (printed == ABELIAN):
        yield f"the identity component is printed as {printed}, and the group is {known}"
    if inside is not None and inside.case == 1:
        yield from _false_formulas(found, inside, point, answer.S)


def _false_formulas(
    found: ParametricAnswer, region: ParameterRegion, point: ParameterPoint, S: RatFunc
) -> Iterator[str]:
    """The solutions of a region that provably don't solve the equation at a rational point, one sentence each."""
    x = sympy.Dummy()
    values = {sympy.Symbol(name): value.to_sympy(x) for name, value in zip(point.names, point.values, strict=True)}
    equation = equation_at(found.equation or normal_form_equation(found.S, found.variable), point)
    formulas = region.formulas
    if point.field != QQ or found.letters or equation is None or not isinstance(formulas, Carried):
        return
    # For larger degrees the coefficients of P, functions of the parameters, take long.
    degrees_of_P = chain.from_iterable(part.numbers_at(point) for part in region.naturals)
    for number in [d for d in degrees_of_P if d <= DEFAULT_DEGREE] if region.naturals else [None]:
        # Formulas for other values aren't even translated to the given equation.
        meant = [solution for solution in formulas.found(number) if solution.at(values) is not None]
        for solution in formulas.of(meant):
            y = solution.at(values)
            if y is not None and (y.has(sympy.nan, sympy.zoo, sympy.oo) or _is_false(y, S, equation, values)):
                yield f"{solution} is no solution"


def _is_false(y: Any, S: RatFunc, equation: Equation, values: Mapping[Any, Any]) -> bool:
    """True if y provably doesn't solve the equation with this normal form at values of the parameters."""
    from kovacic.closed_form.check import residual

    x = t = sympy.Symbol(equation.variable)
    if equation.change is not None:
        x = user_variable(equation)
        t = function_of_x(equation).xreplace(values)
    try:
        with working_precision(COMPARED_BITS):
            return not residual(y, x, S, equation.gauge, acb(fmpq(13, 7)), inner=t).contains(0)
    except (NotImplementedError, ZeroDivisionError, ValueError, TypeError):  # functions without balls
        return False


@dataclass(frozen=True)
class Sampler:
    """Points with small coordinates: the fixed `start`, and values of the `names` that the assumptions admit."""

    start: ParameterPoint
    names: Sequence[str]
    assumptions: Assumptions
    random: Random

    def points(self, statements: Sequence[Statement]) -> Iterator[ParameterPoint | None]:
        """Points at which one of the statements holds alternate with any points; None is a failed attempt."""
        for statement in cycle(statements or [ALWAYS]):
            yield self.point(statement)
            yield self.point(ALWAYS)

    def point_in(self, found: ParametricAnswer, region: ParameterRegion | None) -> ParameterPoint | None:
        """A point of this region, or of none for None; None if four attempts fail."""
        for _ in range(4):
            point = self.point(ALWAYS if region is None else region.statement)
            if point is not None and found.region_at(point) is region:
                return point
        return None

    def point(self, statement: Statement) -> ParameterPoint | None:
        """An admitted point at which the statement holds; None if the attempt failed."""
        values = dict(zip(self.start.names, self.start.values, strict=True))
        values |= {name: QQ.poly([self.assumptions.of(name).sample(self.random)]) for name in self.names}
        field = self.start.field
        free = list(self.names)
        try:
            # One parameter is chosen for each function so that it vanishes, the last function first.
            for function in reversed(statement.sample(self.random)):
                field = self._solve_for_zero(function, values, field, free)
        except (ZeroDivisionError, ValueError):
            return None
        in_one_field = tuple(value.over(field) for value in values.values())
        point = ParameterPoint((*self.start.names, *self.names), in_one_field, field)
        is_admitted = self.assumptions.admits(zip(point.names, point.values, strict=True))
        return point if is_admitted and statement.holds(point) else None

    def _solve_for_zero(self, function: FunctionPoly, values: dict[str, Poly], field: Field, free: list[str]) -> Field:
        """Choose one free parameter so that the function vanishes, and return the field of all values.

        Raises `ValueError` if no parameter can be chosen.
        """
        names = function.field.names
        powers = dict(zip(names, degrees(function), strict=True))
        candidates = [name for name in free if powers.get(name, 0) > 0]
        self.random.shuffle(candidates)
        candidates.sort(key=powers.__getitem__)
        known = [values[name].over(field) for name in names]
        for name in candidates:
            equation = field.poly(coefficients_in(function, names.index(name), known, field))
            if equation.degree < 1:
                continue
            factor = self.random.choice([f for f, _ in field.factor(equation)])
            # The only parameter may be algebraic.
            if factor.degree > 1 and not (len(free) == len(names) == 1 and field == QQ):
                continue
            value = -factor[0] if factor.degree == 1 else AlgebraicField(QQ, factor, "alpha").generator
            values[name] = value
            free.remove(name)
            return value.field
        raise ValueError("no parameter can be chosen")


def find_conditions(
    S: Any,
    *,
    var: Any,
    assume: Mapping[Any, Any] | None,
    max_degree: int,
    limits: Limits,
    names: Sequence[str] = (),
) -> ParametricAnswer:
    """The result of `kovacic.conditions` as data, with the same arguments and exceptions."""
    with Budget(limits).watched():
        parsed = read_input(S, var=var, limits=limits, exponentials=True, names=names)
        given = parsed
        S, parsed, assume = with_assumed_values(S, parsed, assume, limits)
    parsed, letters = spelled(parsed)
    names = parameters_of(parsed.S.field)
    if not names:
        what = "S has no parameters"
        if parsed is not given:
            what = "every parameter has a value"
        elif var is None and parsed.S.degree:  # a parameter may have been taken for x
            what += f": {parsed.variable} is taken for the variable"
        hint = "solve decides equations without parameters;"
        python = f"{hint} var= says which name is the variable"
        raise InputError(what, hint=python, shell=f"{hint} --var says which name is the variable")
    most = whole(max_degree, "max_degree")
    known = read_assumptions(assume, S, names)
    for name in transcendental(names, letters):
        known = known.also(name, ("irrational", "positive"))
    for name in nonzero(letters):
        known = known.also(name, ("nonzero",))
    found = conditions_of(parsed, known, most, limits, letters)
    return replace(found, given=S) if isinstance(S, str) else found


def conditions_of(
    parsed: Parsed, known: Assumptions, max_degree: int | None, limits: Limits, letters: Letters = ()
) -> ParametricAnswer:
    """The conditions for an input that was read; without a `max_degree` by theorems only."""
    budget = Budget(limits)
    if parsed.equation is not None:  # algebraic constants of the gauge belong to the answer, too
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
    """The decision under the assumptions, a sentence about the values for which it holds, and True if that is proven.

    If the assumptions imply another case than the generic one, that is the decision without a certificate.  With one it is
    undecided, because omega depends on the values of the parameters; its reason names the case, which is proven.
    """
    if decision.status is Status.UNDECIDED:
        return decision, "", False
    answer = conditions_of(parsed, known, None, limits)
    if answer.complete is not True:
        return decision, f"values with {known} may not be generic ({answer.theory})", False
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

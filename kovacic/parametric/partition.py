"""The partition of parameter space: the theory that applies, the regions in their order, and the degenerate values.

Liouvillian solutions for generic values specialise.  An omega of degree m over the algebraic closure of Q(t)(x) is a root of
a binary form F(y, y') of degree m, with polynomials in x as coefficients, whose derivative along the solutions is a multiple of
it, F' = lambda F with a rational function lambda.  Let S be defined at t0, take a valuation ring of the constants that
dominates t0, and scale F so that its coefficients are integral and not all in the maximal ideal.  Then lambda is integral
(if pi lambda were the first integral multiple, pi F' = pi lambda F would vanish in the residue field, but neither pi lambda
nor F does), so that the residue of F is a form of degree m for t0, not zero, with the same property: a product of m
solutions with an algebraic logarithmic derivative.  So an equation that is generically in case 1 is in case 1 wherever S is
defined, one in case 2 is in case 1 or 2, and one that has Liouvillian solutions has them everywhere.

Darboux' transformation gives an equation with an apparent singularity the cases of one without it.  Let y'' = (V - E) y with V
and W free of E and W' + W^2 = V - E0.  For every E other than E0 the map y -> y' - W y takes the solutions to those of
v'' = (V - 2 W' - E) v, and v -> v' + W v takes them back, times E0 - E.  W is rational, so one equation has Liouvillian
solutions where the other one has, with the same case and group.  At a pole with the exponents -m and m + 1, the same for all E,
and W = -m/(x - c) + ..., V has the coefficient m (m + 1), and V - 2 W' has m (m - 1).

On a hypersurface such as 4 w^2 + 1 = 0 no parameter is eliminated, but one is a number there.  S over Q(t)(w) is a slice of
S over Q(t, w) with a free w, whose partition holds on the slice; likewise where a form in two parameters vanishes, on
a^2 + b^2 = 0 with w = a/b.

Finally each region is stated once, under the assumptions, with solutions of the given equation.

References: G. Darboux, C. R. Acad. Sci. 94 (1882) 1456; D. Gomez-Ullate, Y. Grandati & R. Milson, J. Phys. A 47 (2014) 015203.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial, reduce
from itertools import chain, islice, takewhile

import sympy

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.engine.decide import decide
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import Equation, parameters_of
from kovacic.errors import LimitExceeded
from kovacic.galois import group_of
from kovacic.limits import Budget
from kovacic.parametric import restriction, riemann
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import (
    degrees,
    denominator,
    denominators,
    in_field,
    irreducible_factors,
    over_parameters,
    powers_of,
    rational_number,
    union,
    without_parameters,
)
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import (
    Limited,
    ParameterRegion,
    RegionVerdict,
    Theorem,
    Theory,
    equations_on,
    normal_form_equation,
    settled_regions,
    vanishing,
    verdict_from_engine,
    without_empty,
    without_implied_equations,
    without_redundant,
)
from kovacic.parametric.search import SMALL_DEGREE, Findings, degree_equation, search_special_values
from kovacic.parametric.solutions import Carried, PolynomialSolution, derivative, given, solutions_there
from kovacic.parametric.statements import ALWAYS, NEVER, Setting, Vanishes, all_of
from kovacic.parametric.theorems import kimura_theorem, martinet_ramis
from kovacic.reading.change_of_variable import function_of_x, user_variable
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class Transformation:
    """`special` vanishes where E = E0; elsewhere S is as solvable as `simpler`, unless one of the `exceptions` vanishes."""

    special: FunctionPoly
    W: RatFunc
    simpler: RatFunc
    exceptions: tuple[FunctionPoly, ...]


def carried_back(W: RatFunc, variable: str, solution: PolynomialSolution) -> PolynomialSolution:
    """A solution v of the simpler equation as y = v' + W v."""
    x = sympy.Symbol(variable)
    return replace(solution, y=derivative(solution.y, x) + sympy.factor(W.to_sympy(x)) * solution.y)


def transformations(problem: Problem) -> Iterator[Transformation]:
    """Transformations that lower the apparent singularities."""
    before = _apparent(problem)
    for special, W in _rational_logarithmic_derivatives(problem) if before else ():
        simpler = problem.S - 2 * W.derivative()
        after = analyse(simpler, problem.budget)
        if _apparent(after) < before:
            own, others = map(restriction.undefined, (problem, after))
            exceptions = union([own, irreducible_factors(W.cleared()[1].lc), others])
            yield Transformation(special, W, simpler, tuple(exceptions))


def _apparent(problem: Problem) -> int:
    """The sum of m (m + 1) over the poles with constant exponents -m, m + 1."""
    differences = [(place.delta, place.degree) for place in problem.finite_places if place.kind is Kind.REGULAR]
    # An odd integer is 2 m + 1.
    return sum(int(d * d - 1) // 4 * degree for d, degree in differences if d is not None and d % 2 == 1)


def _energies(S: RatFunc) -> list[int]:
    """The numbers of the parameters E with S = V - c E, c a number and V free of E."""
    above, below = map(over_parameters, S.cleared())
    linear = (i for i, powers in enumerate(zip(degrees(above), degrees(below), strict=True)) if powers == (1, 0))
    slopes = ((i, RatFunc(powers_of(above, i)[1], below * denominator(above))) for i in linear)
    return [i for i, c in slopes if c.is_polynomial and rational_number(c.num) is not None]


def _rational_logarithmic_derivatives(problem: Problem) -> Iterator[tuple[FunctionPoly, RatFunc]]:
    """`(E - E0, W)` with a W free of E, for solutions for E = E0 in which P has a small degree."""
    energies = _energies(problem.S)
    equation = degree_equation(problem) if energies else None
    if equation is None:
        return
    for special in chain.from_iterable(irreducible_factors(equation(Fraction(d))) for d in range(SMALL_DEGREE + 1)):
        linear = (i for i in energies if degrees(special)[i] == 1 and powers_of(special, i)[1].num.is_constant())
        for i in islice(linear, 1):
            names = special.field.names
            surface = restriction.hypersurface(special, fixed=names[:i] + names[i + 1 :])
            riccati = decide(surface.restricted(problem.S), problem.budget).riccati
            if riccati is not None and riccati.degree == 1 and riccati.coefficients[0].field == surface.field:
                omega = RatFunc(*(surface.back(part, special.field) for part in riccati.coefficients[0].cleared()))
                yield special, -omega


_NOT_EXAMINED = RegionVerdict(None, known=False)


@dataclass(frozen=True)
class Partition:
    """Regions, tried in order; `generic` holds where none of them does; `complete` is as for a region."""

    generic: RegionVerdict
    complete: bool | str
    theory: Theory
    regions: tuple[ParameterRegion, ...] = ()

    @classmethod
    def of(
        cls, theory: Theory, regions: Iterable[ParameterRegion], generic: RegionVerdict, complete: bool | str = True
    ) -> Partition:
        """The regions that hold somewhere, up to the first that holds everywhere, which may be the generic verdict."""
        held = [one for one in (*regions, ParameterRegion(ALWAYS, generic, complete)) if one.statement != NEVER]
        kept = tuple(takewhile(lambda one: one.statement != ALWAYS, held))
        rest = held[len(kept)]
        unproven = (one.complete for one in (rest, *kept) if one.complete is not True)
        return cls(rest.verdict, next(unproven, True), theory, kept)


@dataclass(frozen=True, kw_only=True)
class Settings(Setting):
    """The budget, and `only_theorems` to leave everything else undecided.  Covered zeros aren't examined."""

    budget: Budget
    variable: str
    only_theorems: bool = False


def partition(S: RatFunc, settings: Settings) -> Partition:
    """The partition for S over Q(t), or the single verdict for an S without parameters."""
    settings.budget.check()
    num, den = map(without_parameters, (S.num, S.den))
    if num is not None and den is not None:  # no parameter is left in k (1 + g/x) at k = 0
        numbers = RatFunc(num, den)
        decision = decide(numbers, settings.budget)
        verdict = verdict_from_engine(decision, group_of(numbers, decision) if decision.structure else None)
        return Partition(verdict, verdict.known or str(decision.undecided), Theory("the engine"))
    verdict = verdict_from_engine(decide(S, settings.budget, certify=False))
    if isinstance(S.field, AlgebraicField):
        # Functions on a hypersurface; the head of this module explains case 1.
        is_reducible = verdict.structure is Structure.REDUCIBLE
        has_number = isinstance(S.field.base, FunctionField) and without_parameters(S.field.modulus) is not None
        if has_number and not is_reducible and not settings.assumptions.constant.names:
            return _on_slice(S, settings)
        return Partition(verdict, is_reducible or "for generic values only", Theory("the engine"))
    try:
        return _by_theory(S, verdict, settings)
    except LimitExceeded as limit:
        return Partition(verdict, Limited.by(limit), Theory("nothing but the generic answer"))


def _without_common_factors(S: RatFunc, assumptions: Assumptions) -> RatFunc:
    """S over Q(t, alpha) in the lowest terms that it has where alpha is the assumed number."""
    number = assumptions.constant
    if not isinstance(S.field, FunctionField) or len(S.field.names) < 2 or S.field.names[-1:] != number.names:
        return S
    return restriction.with_free_constant(restriction.everywhere(S.field, number).restricted(S)).S


def _on_slice(S: RatFunc, settings: Settings) -> Partition:
    """The partition for S over Q(t)(alpha), alpha a number, by that over Q(t, alpha); for S over Q(t) its own."""
    lifted, _, number = restriction.with_free_constant(S)
    known = replace(settings.assumptions, constant=number)
    with settings.budget.watched():
        found = partition(lifted, replace(settings, covered=(), assumptions=known))
    # With high powers of the constant replaced by means of its minimal polynomial.
    reduced = partial(restriction.in_lowest_powers, constant=number)
    left = (without_implied_equations(one.statement.rewritten(reduced)).under(known) for one in found.regions)
    regions = (replace(one, statement=statement) for one, statement in zip(found.regions, left, strict=True))
    under = Partition.of(found.theory, regions, found.generic, found.complete)
    if under.generic.known:
        return under
    return replace(under, generic=verdict_from_engine(decide(S, settings.budget, certify=False)))


def _by_theory(S: RatFunc, expected: RegionVerdict, settings: Settings) -> Partition:
    problem = analyse(S, settings.budget)
    if expected.structure is Structure.REDUCIBLE:  # and so wherever S is defined, by the head of this module
        is_constant = problem.S.is_polynomial and problem.S.num.degree <= 0
        is_simple = is_constant or riemann.has_regular_points_only(problem)  # orders of poles don't matter
        changes = restriction.confluence if is_simple else restriction.structure_changes
        if {*changes(problem)} <= {*restriction.undefined(problem)}:
            expected = riemann.verdict_by_exponents(problem, Structure.REDUCIBLE)
        always = ParameterRegion(ALWAYS, expected)
        name = Theory("a rational omega for generic values, and so for all", "Kov86")
        theorem: Theorem | None = Theorem(name, restriction.undefined(problem), [always])
    else:
        theorem = kimura_theorem(problem, settings.variable) or martinet_ramis(problem, settings.variable)
    if theorem is not None:
        return _by_theorem(problem, theorem, expected, settings)
    if settings.only_theorems:
        return Partition(expected, "for generic values only", Theory("no theorem covers all values"))
    simpler = next(transformations(problem), None)
    if simpler is not None:
        return _by_transformation(problem, simpler, settings)
    return _by_candidates(problem, expected, settings)


def _by_theorem(problem: Problem, theorem: Theorem, expected: RegionVerdict, settings: Settings) -> Partition:
    """The regions up to the first that holds everywhere, whose verdict is the generic one."""
    at_exceptions = _on_zeros(problem.S, theorem.exceptions, settings)
    found = Partition.of(theorem.name, chain(at_exceptions, theorem.regions), RegionVerdict(None))
    case = found.generic.case
    if expected.known and expected.case != case:
        raise AssertionError(f"{theorem.name}: case {case} contradicts the generic answer, case {expected.case}")
    if case == 1 and found.generic == expected:  # wherever S is defined
        undefined_there = (region for region in found.regions if not region.defined)
        return Partition.of(theorem.name, undefined_there, found.generic)
    return found


def _by_transformation(problem: Problem, found: Transformation, settings: Settings) -> Partition:
    """The regions of the simpler equation, after those of the values at which the transformation isn't possible."""
    regions = [*_on_zeros(problem.S, found.exceptions, settings)]
    regions += _regions_where_zero(problem.S, found.special, settings)
    inner = partition(found.simpler, settings)
    back = partial(carried_back, found.W, settings.variable)
    origins = ((one, one.formulas and Carried(one.formulas, (back,))) for one in inner.regions if one.defined)
    regions += [replace(region, origin=origin) for region, origin in origins]
    theory = inner.theory.also(", after Darboux' transformation", "Dar82")
    return Partition.of(theory, regions, inner.generic, inner.complete)


def _by_candidates(problem: Problem, expected: RegionVerdict, settings: Settings) -> Partition:
    """The regions where S changes, those of the candidates, and those with a natural number, as far as the limits allow."""
    regions = list[ParameterRegion]()
    findings = Findings(Theory("polynomial conditions"))
    complete: bool | str = True
    try:
        changes = restriction.structure_changes(problem)
        regions.extend(_on_zeros(problem.S, changes, settings))
        findings = search_special_values(problem)
        if expected.structure is Structure.IMPRIMITIVE:
            findings.candidates += _discriminants(problem, settings)
        elif expected.structure is not None:
            findings.unproven.append("smaller groups than the generic one")
        if findings.unproven:
            complete = f"for generic values (not proven: {'; '.join(findings.unproven)})"
        elsewhere = reduce(Settings.also, changes, settings)
        regions.extend(_on_zeros(problem.S, dict.fromkeys(findings.candidates), elsewhere, expected))
    except LimitExceeded as limit:
        complete = Limited.by(limit)
    theory = findings.theory
    for statement in findings.conditions:
        if isinstance(statement, Natural) and statement.m == 1:
            verdict = riemann.verdict_by_exponents(problem, Structure.REDUCIBLE)
            regions.append(ParameterRegion(statement, verdict, origin=partial(statement.solutions, settings.variable)))
        elif expected.structure is None:  # else there is no smaller group
            verdict = RegionVerdict(Structure.IMPRIMITIVE)
            if not isinstance(statement, Natural):
                theory = theory.also("; half-integers: Treibich & Verdier", "TV90")
            elif statement.m == 12:  # an invariant of this degree leaves the group open
                verdict = RegionVerdict(statement.structure, family="binary tetrahedral, octahedral or icosahedral")
            regions.append(ParameterRegion(statement, verdict))
    return Partition.of(theory, regions, expected, complete)


def _discriminants(problem: Problem, settings: Settings) -> list[FunctionPoly]:
    """Functions that vanish where the two solutions in a generic semi-invariant y1 y2 coincide."""
    riccati = decide(problem.S, settings.budget).riccati
    if riccati is None or riccati.P.field != problem.field:
        return []
    # The discriminant of W^2 - A1/(P D) W + A2/(P D^2) is w^2 / (y1 y2)^2 with a constant w^2, which vanishes there.
    P = riccati.P
    (_, first, second) = riccati.numerators
    elements = [(first * first - 4 * P * second).lc, *denominators(P), *denominators(first), *denominators(second)]
    return union(irreducible_factors(element) for element in elements)


def _on_zeros(
    S: RatFunc, functions: Iterable[FunctionPoly], settings: Settings, expected: RegionVerdict | None = None
) -> Iterator[ParameterRegion]:
    """Regions for the zeros of functions, at which the generic theory doesn't apply; the limits may leave them unknown.

    If a verdict is expected, these are the zeros at which something else holds, or nothing is known.
    """
    number = settings.assumptions.constant
    on_slice = ((one, irreducible_factors(restriction.in_lowest_powers(one, number))) for one in functions)
    for function in dict.fromkeys(chain.from_iterable(factors or [one] for one, factors in on_slice)):
        if settings.covers(function):
            continue
        try:
            found = _regions_where_zero(S, function, settings)
        except LimitExceeded as limit:
            if expected is not None:
                raise
            found = [ParameterRegion(Vanishes(function), _NOT_EXAMINED, Limited.by(limit))]
        if expected is None or not all(one.verdict.known and one.case == expected.case for one in found):
            yield from found
            settings = settings.also(function)


def _regions_where_zero(S: RatFunc, function: FunctionPoly, settings: Settings) -> list[ParameterRegion]:
    """The regions that make up the zeros of a polynomial, in their order."""
    settings.budget.check()
    regions = _inside(S, function, settings)
    missed = _missed(S, function, settings) if regions[-1].defined else []
    return [*missed, *regions]


def _missed(S: RatFunc, function: FunctionPoly, settings: Settings) -> list[ParameterRegion]:
    """Regions for the zeros of a polynomial at which the eliminated parameter can have any value.

    There a second polynomial g vanishes, so that these are the zeros of the first one on g = 0, and those missed there.
    """
    first = Vanishes(function)
    regions = list[ParameterRegion]()
    for other in restriction.hypersurface(function).missed:
        surface = restriction.hypersurface(other)
        rest = surface.at(function)
        try:
            restricted = surface.restricted(S)
        except ZeroDivisionError:
            restricted = None
        if restricted is None or not isinstance(rest, FunctionPoly):
            regions += _also(_regions_where_zero(S, other, settings), first)
            continue
        regions += _also(_missed(S, other, settings), first)
        for factor in irreducible_factors(rest):
            regions += _also(_regions_where_zero(restricted, factor, settings.on(surface)), first, Vanishes(other))
    return regions


def _also(regions: Iterable[ParameterRegion], *conditions: Vanishes) -> list[ParameterRegion]:
    """The parts of regions, which may be about fewer parameters, where more conditions hold."""
    lift = partial(in_field, field=conditions[0].function.field)
    return [replace(r, statement=all_of((*conditions, r.statement.rewritten(lift)))) for r in regions]


def _inside(S: RatFunc, function: FunctionPoly, settings: Settings) -> list[ParameterRegion]:
    """The regions where a polynomial vanishes, except for the `missed` points; the last one is all the rest."""
    statement = Vanishes(function)
    surface = restriction.hypersurface(function)
    try:
        restricted = _without_common_factors(surface.restricted(S), settings.assumptions)
    except ZeroDivisionError:
        return [ParameterRegion(statement, _NOT_EXAMINED, defined=False)]
    inner = partition(restricted, settings.on(surface))
    rest = ParameterRegion(ALWAYS, inner.generic, inner.complete)
    if inner.complete is not True:
        rest = replace(rest, verdict=replace(inner.generic, known=False))
        if isinstance(surface.field, AlgebraicField):  # no parameter can be eliminated
            rest = replace(rest, complete=f"except for special values with {statement.text()}")
    elif rest.case == 1:
        rest = replace(rest, origin=partial(solutions_there, restricted, settings.variable))
    regions = list(inner.regions)
    if surface.curve:
        back = partial(surface.back, field=function.field)
        *regions, rest = (_without_curve(region, back) for region in (*regions, rest))
    while regions and replace(regions[-1], statement=ALWAYS) == rest:
        regions.pop()  # it needn't be named
    return _also([*regions, rest], statement)


def _without_curve(region: ParameterRegion, back: Callable[[FunctionPoly], FunctionPoly]) -> ParameterRegion:
    """The region in the original parameters, without formulas in the parameters of a curve, which the user doesn't know."""
    verdict = region.verdict
    if verdict.family and "`" in verdict.family:
        verdict = replace(verdict, family=None)
    return replace(region, statement=region.statement.rewritten(back), verdict=verdict, origin=None)


def derived(
    S: RatFunc,
    variable: str,
    equation: Equation | None,
    known: Assumptions,
    budget: Budget,
    max_degree: int | None,
    letters: restriction.Letters = (),
) -> Partition:
    """The partition of parameter space for S; Delta_d is shown up to `max_degree`, which is None for theorems only."""
    settings = Settings(budget=budget, variable=variable, only_theorems=max_degree is None, assumptions=known)
    found = _on_slice(S, settings)
    regions = found.regions
    with budget.watched(), suppress(LimitExceeded):
        regions = without_empty(regions)
        regions = without_redundant(regions, found.generic if found.complete is True else None)
    lifted, _, constant = restriction.with_free_constant(S)
    own = equation or normal_form_equation(lifted, variable)
    # In solutions the constant is SymPy's number.
    x = sympy.Symbol(variable)
    numbers = zip(constant.names, (value.to_sympy(x) for value in constant.values), strict=True)
    meanings = (*letters, *numbers)
    setting = restriction.setting_of(variable, parameters_of(lifted.field), constant, letters, known)
    finished = [_finished(region, own, max_degree, budget, meanings) for region in settled_regions(regions, setting)]
    return replace(found, regions=tuple(finished))


def _finished(
    region: ParameterRegion, equation: Equation, max_degree: int | None, budget: Budget, letters: restriction.Letters
) -> ParameterRegion:
    """The region with solutions of the given equation, and the degree up to which determinants are shown."""
    statement = region.statement
    if not region.defined and equation.change:
        # The variable as a function of the user's variable may be constant on the zeros of a function: x^n for n = 0.
        factors = sympy.Mul.make_args(sympy.factor(function_of_x(equation).diff(x := user_variable(equation))))
        zeros = [zero.function.to_sympy(x) for zero in vanishing(statement.conjuncts)]
        if any(sympy.cancel(factor / zero).is_number for factor in factors for zero in zeros):
            family = f"`{equation.variable} = {caret(equation.change.expression)}` is constant there: assume this value"
            region = replace(region, verdict=replace(region.verdict, family=family))
    if region.formulas is not None:
        pieces = tuple(partial(given, *piece) for piece in equations_on(region.statement, equation))
        # With an algebraic constant the statement knows its value, and the origin doesn't.
        origin = region.formulas
        if isinstance(statement, Natural) and statement.constant.names:
            origin = partial(statement.solutions, equation.variable)
        region = replace(region, origin=Carried(origin, pieces, letters) if pieces else None)
    has_determinants = isinstance(statement, Natural) and statement.m == 1
    return replace(region, shown_degree=max_degree if has_determinants else None, limits=budget.limits)

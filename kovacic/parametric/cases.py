"""From regions, of which the first decides, to the cases of a theorem: solvable if and only if one of them holds.

Regions without a Liouvillian solution, "a = 0: none", are no cases.  A later case holds outside of them only, which needn't
be said where the two exclude one another, or meet in values of an earlier case.

A chart gives values of the parameters at which a statement can hold, as functions of fewer ones.  All tests on it are
sufficient and exact: `within` contains every value at which a statement holds, and maybe more; `holds` is True only where a
statement holds at all values of a chart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import chain, groupby, product

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import Equation
from kovacic.limits import check_time
from kovacic.parametric.claims import Claim
from kovacic.parametric.functions import ParameterPoint, irreducible_factors, over_parameters, with_values
from kovacic.parametric.integers import Congruence
from kovacic.parametric.regions import ParameterRegion, RegionVerdict
from kovacic.parametric.restriction import Hypersurface, hypersurface, with_free_constant
from kovacic.parametric.statements import ALWAYS, Both, Either, Setting, Statement, Vanishes, all_of, either


def charts_of(statement: Statement) -> list[ParameterPoint]:
    """Charts that contain all values at which the statement holds; none for one in which no function occurs."""
    return [] if statement.field is None else within(statement, [ParameterPoint.generic(statement.field)])


def within(statement: Statement, charts: list[ParameterPoint]) -> list[ParameterPoint]:
    """Parts of the charts that contain all of their values at which the statement holds."""
    found: list[ParameterPoint] = []
    for one in charts:
        with suppress(ZeroDivisionError):  # a statement doesn't hold where it isn't defined
            found += _where_possible(statement, one)
    return found


def _where_possible(statement: Statement, chart: ParameterPoint) -> list[ParameterPoint]:
    """The parts of one chart on which the statement may hold."""
    if isinstance(statement, Both):
        return reduce(lambda charts, part: within(part, charts), statement.parts, [chart])
    if isinstance(statement, Either):
        return _union((within(part, [chart]) for part in statement.parts), chart)
    if isinstance(statement, Congruence) and statement.holds_for(chart.at(statement.equation)) is False:
        return []
    return _union((_where_solvable(chart.at(equation), chart) for equation in statement.equations), chart)


def _where_solvable(equation: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    """Where an equation for a number can have a root: everywhere, if the number occurs in it; else where it vanishes."""
    if equation.degree > 0 or not equation:
        return [chart]
    if chart.field.ground == QQ:  # a number, and not 0
        return []
    if isinstance(equation, ExtensionPoly):  # over a number field, a function of further parameters
        return [chart]
    surfaces = [*map(hypersurface, irreducible_factors(equation))]
    if any(surface.missed or surface.curve for surface in surfaces):
        return [chart]
    return [_on(surface, chart) for surface in surfaces]


def _on(surface: Hypersurface, chart: ParameterPoint) -> ParameterPoint:
    values = tuple(surface.at(over_parameters(value)) for value in chart.values)
    return ParameterPoint(chart.names, values, surface.field)


def _union(parts: Iterable[list[ParameterPoint]], chart: ParameterPoint) -> list[ParameterPoint]:
    """All of the parts of a chart; the chart alone where one of them is all of it."""
    found = [*chain.from_iterable(parts)]
    return [chart] if any(part is chart for part in found) else found


def covered(charts: Iterable[ParameterPoint], statements: Sequence[Statement]) -> bool:
    """True if on each chart one of the statements provably holds."""
    return all(any(known.holds(one) for known in statements) for one in charts)


def without_implied(statement: Statement) -> Statement:
    """The statement without an equation that follows from the values of parameters: g2 = g3 = 0 implies g2^3 = 27 g3^2.

    Others are said with the values.
    """
    valued = partial(with_values, zeros=[zero.function for zero in vanishing(statement.conjuncts)])
    return all_of(part.rewritten(valued) if isinstance(part, Vanishes) else part for part in statement.conjuncts)


def vanishing(statements: Iterable[Statement]) -> list[Vanishes]:
    """Those that say that a function vanishes."""
    return [statement for statement in statements if isinstance(statement, Vanishes)]


def is_variety(statement: Statement) -> bool:
    """True if nothing is said but that functions vanish."""
    return all(isinstance(one, Vanishes) for part in statement.conjuncts for one in part.alternatives)


def pieces_of(statement: Statement) -> list[tuple[FunctionPoly, ...]]:
    """The common zeros of functions that make up a statement, whatever else is said in it."""
    varieties = filter(is_variety, statement.conjuncts)
    return [*product(*([one.function for one in vanishing(part.alternatives)] for part in varieties))]


def settled(regions: Iterable[ParameterRegion], setting: Setting) -> list[ParameterRegion]:
    """The regions in their order, so that each is printed for the values that belong to none before it, and none twice."""
    found: dict[Claim, ParameterRegion] = {}
    for region in regions:
        statement = region.statement.avoiding(setting)
        found.setdefault(statement.claim, replace(region, statement=statement))
        if is_variety(statement):
            setting = reduce(lambda known, zeros: known.also(*zeros), pieces_of(statement), setting)
    return [*found.values()]


# ------------------------------------------------------------------------------- the equation in a region


#: The equation that was given, on one piece of a region; the functions vanish there and not on every piece.
EquationThere = tuple[Equation, tuple[FunctionPoly, ...]]


def equations_on(statement: Statement, equation: Equation) -> list[EquationThere]:
    """The equation y'' + p y' + q y = 0 restricted to the pieces of a region, whose formulas have their gauge from it.

    At the zeros that make up a region, poles of b/a can merge or go to infinity, and the gauge for generic values, specialised,
    is another function.  Pieces that aren't given by functions of fewer parameters are left out.
    """
    pieces = pieces_of(statement)
    there = ((_on_piece(equation, piece), piece) for piece in pieces)
    return [(one, piece if len(pieces) > 1 else ()) for one, piece in there if one is not None]


def _on_piece(equation: Equation, functions: Sequence[FunctionPoly]) -> Equation | None:
    """The equation at the generic point of the common zeros; None if these aren't one piece."""
    if not functions:
        return equation
    point = ParameterPoint.generic(functions[0].field)
    try:
        for function in functions:
            factors = irreducible_factors(point.at(function))
            if len(factors) != 1:
                return None
            point = _on(hypersurface(factors[0]), point)
    except (TypeError, ZeroDivisionError):  # a function on a hypersurface, or one that isn't defined at these values
        return None
    return equation_at(equation, point)


def normal_form(S: RatFunc, variable: str) -> Equation:
    """y'' - S y = 0."""
    return Equation(a=S * 0 + 1, b=S * 0, c=-S, f=S * 0, variable=variable)


def equation_at(equation: Equation, point: ParameterPoint) -> Equation | None:
    """y'' + p y' + q y = 0 with these values of the parameters; None if p or q isn't defined."""
    try:
        p, q = (point.restricted(with_free_constant(part / equation.a).S) for part in (equation.b, equation.c))
    except ZeroDivisionError:
        return None
    return replace(equation, a=q * 0 + 1, b=p, c=q, f=q * 0, h=None)


#: Regions above which not all are compared: general Heun has some hundreds.
_MANY = 100


@dataclass(frozen=True)
class Case:
    """Where `statement` holds, none of `without`, and no case before: what is said is that of each of the `regions`."""

    statement: Statement
    regions: tuple[ParameterRegion, ...]
    without: tuple[Statement, ...] = ()


def outside(regions: Iterable[ParameterRegion]) -> Iterator[ParameterRegion]:
    """The regions of which a theorem doesn't speak: S isn't defined there, or nothing is known."""
    return (region for region in regions if not region.verdict.known)


def solvable_cases(regions: Sequence[ParameterRegion]) -> list[Case]:
    """The cases in which there are Liouvillian solutions, in the order of the regions; neighbours that say the same in one."""
    found: list[Case] = []
    unsolvable: list[Statement] = []
    for region in filter(lambda one: one.verdict.known, regions):
        if region.case is None:
            unsolvable.append(region.statement)
        elif _proves_a_solution(region):
            found.append(Case(region.statement, (region,)))
        else:
            # The unsolvable ones that the statement meets outside of the cases before.
            before = [case.statement for case in found if not case.without]
            charts = charts_of(region.statement)
            meeting = ((other, within(region.statement, within(other, charts))) for other in unsolvable)
            without = [other for other, common in meeting if not covered(common, before)]
            found.append(Case(region.statement, (region,), tuple(without)))
    return grouped(found, lambda first, second: first.verdict.says_the_same(second.verdict))


def in_lines(regions: Sequence[ParameterRegion]) -> list[ParameterRegion]:
    """The regions as they are listed: those in a row in which the same case holds are one."""
    cases = [Case(region.statement, (region,)) for region in regions]
    together = grouped(cases, lambda first, second: first.case == second.case)
    return [replace(case.regions[0], statement=case.statement) for case in together]


def without_empty(regions: Iterable[ParameterRegion]) -> tuple[ParameterRegion, ...]:
    """The regions without those that earlier ones cover, for example because they say the same and more."""
    kept: list[ParameterRegion] = []
    seen: list[set[Statement]] = []
    for region in regions:
        check_time()
        said = {*region.statement.conjuncts}
        if any(known <= said for known in seen):
            continue
        charts = charts_of(region.statement)
        if covered(charts, [other.statement for other in kept]):
            continue
        seen.append(said)
        kept.append(region)
    return tuple(kept)


def without_redundant(regions: Sequence[ParameterRegion], generic: RegionVerdict | None) -> tuple[ParameterRegion, ...]:
    """The regions without those of whose values the later ones say the same, and the generic verdict; None claims nothing.

    "l = 0: no Liouvillian solution" needn't be said where no later region with a solution meets l = 0.  Of very many regions
    only the last ones are looked at, because each is compared with all of the others.
    """
    kept = [*regions]
    for k in reversed(range(len(regions))):
        check_time()
        if _is_redundant(kept[k], kept[:k], kept[k + 1 :], generic):
            del kept[k]
        elif len(regions) > _MANY:
            break
    return tuple(kept)


def _is_redundant(
    region: ParameterRegion,
    before: list[ParameterRegion],
    after: list[ParameterRegion],
    generic: RegionVerdict | None,
) -> bool:
    """True if the later regions say the same at each value of this one that is in none before.

    One that says the same of all of its values is enough.  Without one, those that say another thing may have no value in
    common with this one, but for values that are in one before, and the generic verdict has to be the same.
    """
    is_generic = generic is not None and generic.says_the_same(region.verdict)
    if not region.verdict.known or not (is_generic or is_variety(region.statement)):
        return False
    charts = charts_of(region.statement)
    known = [one.statement for one in before]
    for other in after:
        says_the_same = other.verdict.says_the_same(region.verdict)
        if says_the_same and covered(charts, [other.statement]):
            return True
        # The other one has a solution at all of its values, where this one has none.
        is_apart = region.case is None and _proves_a_solution(other)
        if says_the_same or is_apart:
            continue
        if not covered(within(other.statement, charts), known):
            return False
    return is_generic


def _proves_a_solution(region: ParameterRegion) -> bool:
    """True if its statement holds only where there is a solution, at values of earlier regions, too.

    Those about Delta_d are decided at each point by the equation there.
    """
    return region.case is not None and bool(region.naturals)


# ------------------------------------------------------------------------------- what is said in one sentence

#: True if two regions, with other values, are described in the same way.
Likeness = Callable[[ParameterRegion, ParameterRegion], bool]


def grouped(cases: Iterable[Case], is_same: Likeness) -> list[Case]:
    """The cases, those in a row in one of which the same is said, of values of one kind."""
    joined: list[Case] = []
    for case in _mirrored(cases, is_same):
        together = _together(joined[-1], case, is_same) if joined else None
        if together is None:
            joined.append(case)
        else:
            joined[-1] = together
    return joined


def _together(last: Case, case: Case, is_same: Likeness) -> Case | None:
    """Two cases in one, where nothing but the verdict is said in them, and their statements are of one kind."""
    own = either(*(all_of(region.statement.conjuncts) for region in case.regions))
    are_plain = last.regions[-1].plain and case.regions[0].plain
    if case.statement != own or not are_plain or last.without != case.without:
        return None
    if not is_same(last.regions[-1], case.regions[0]):
        return None
    statement = either(last.statement, case.statement)
    kinds = {type(part) for part in statement.alternatives}
    if len(kinds) > 1 or kinds == {Both}:
        return None
    return Case(statement, (*last.regions, *case.regions), case.without)


def _mirrored(cases: Iterable[Case], is_same: Likeness) -> list[Case]:
    """The cases, those of l = 0 and of l = -1 in one where the same is said in them but for the solutions.

    Cases in a row that begin with the same vanishing function are a block.  Two blocks in a row that say the same are one:
    no value belongs to both, because their functions differ by a number.
    """
    blocks: list[tuple[list[Statement], list[Case]]] = []  # the beginnings, and the cases without them
    for first, group in groupby(cases, key=lambda case: next(iter(case.statement.conjuncts), ALWAYS)):
        inner = [replace(case, statement=Both(case.statement.conjuncts[1:])) for case in group]
        if any(case.statement.conjuncts for case in inner):
            inner = _mirrored(inner, is_same)
        firsts = [first]
        if blocks and _exclude_one_another(blocks[-1][0][-1], first) and _say_the_same(blocks[-1][1], inner, is_same):
            before, known = blocks.pop()
            firsts = [*before, first]
            pairs = zip(known, inner, strict=True)
            inner = [replace(one, regions=(*one.regions, *other.regions)) for one, other in pairs]
        blocks.append((firsts, inner))
    return [
        replace(case, statement=all_of((either(*firsts), *case.statement.conjuncts)))
        for firsts, inner in blocks
        for case in inner
    ]


def _exclude_one_another(first: Statement, second: Statement) -> bool:
    """True for two vanishing functions that differ by a number."""
    if not isinstance(first, Vanishes) or not isinstance(second, Vanishes):
        return False
    return bool(first.function.field.rational_value(first.function - second.function))


def _say_the_same(cases: list[Case], others: list[Case], is_same: Likeness) -> bool:
    """True for the same statements and verdicts, whatever the solutions are."""
    pairs = zip(cases, others, strict=False)
    is_alike = [*map(_but_for_verdict, cases)] == [*map(_but_for_verdict, others)]
    return is_alike and all(is_same(case.regions[0], other.regions[0]) for case, other in pairs)


def _but_for_verdict(case: Case) -> Case:
    """The case without its verdict, represented by its first region."""
    plain = replace(case.regions[0], statement=ALWAYS, verdict=RegionVerdict(None))
    return replace(case, regions=(plain,))

"""From regions, of which the first decides, to the cases of a theorem: solvable if and only if one of them holds.

Regions without a Liouvillian solution, "a = 0: none", are no cases.  A later case holds outside of them only, which needn't
be said where the two exclude one another, or meet in values of an earlier case.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, groupby

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.limits import check_time
from kovacic.parametric.assumptions import NOTHING_ASSUMED
from kovacic.parametric.functions import ParameterPoint, irreducible_factors, over_parameters
from kovacic.parametric.integers import Congruence
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import ParameterRegion, RegionVerdict, holds_on
from kovacic.parametric.restriction import hypersurface, over_all
from kovacic.parametric.riemann import Schwarz
from kovacic.parametric.statements import (
    ALWAYS,
    Both,
    Either,
    Statement,
    Vanishes,
    all_of,
    alternatives_of,
    both,
    either,
)

#: Regions above which not all are compared: general Heun has some hundreds.
_MANY = 100
#: Raised where a statement isn't about functions of the parameters of a chart, or one isn't defined there.
_NOT_ON_CHART = (TypeError, ValueError, ZeroDivisionError)


@dataclass(frozen=True)
class Case:
    """Where `statement` holds, none of `without`, and no case before: what is said is that of each of the `regions`."""

    statement: Statement
    regions: tuple[ParameterRegion, ...]
    without: tuple[Statement, ...] = ()

    @property
    def verdict(self) -> RegionVerdict:
        return self.regions[0].verdict

    def holds(self, point: ParameterPoint) -> bool:
        """Is the point one of this case, if it is none of an earlier one?"""
        return self.statement.holds(point) and not any(statement.holds(point) for statement in self.without)


def outside(regions: Iterable[ParameterRegion]) -> Iterator[ParameterRegion]:
    """The regions of which a theorem doesn't speak: S isn't defined there, or nothing is known."""
    return (region for region in regions if not _is_known(region))


def _is_known(region: ParameterRegion) -> bool:
    return region.defined and region.verdict.known


def solvable_cases(regions: Sequence[ParameterRegion]) -> list[Case]:
    """The cases in which there are Liouvillian solutions, in the order of the regions; neighbours that say the same in one."""
    found: list[Case] = []
    unsolvable: list[Statement] = []
    for region in filter(_is_known, regions):
        if region.case is None:
            unsolvable.append(region.statement)
        elif _proves_a_solution(region):
            found.append(Case(region.statement, (region,)))
        else:
            before = [case.statement for case in found if not case.without]
            charts = _within(region.statement, _everything(regions))
            without = _exceptions(region.statement, unsolvable, before, charts)
            found.append(Case(region.statement, (region,), without))
    return _joined(_mirrored(found))


def _exceptions(
    statement: Statement, unsolvable: Iterable[Statement], before: Sequence[Statement], charts: list[ParameterPoint]
) -> tuple[Statement, ...]:
    """The unsolvable ones that a statement, which is about the charts, meets outside of the cases before."""
    left = []
    for other in unsolvable:
        common = _within(statement, _within(other, charts))
        if not _covered(common, before):
            left.append(_left_to_say(other, charts))
    return _shortest(left)


def without_redundant(regions: Sequence[ParameterRegion], generic: RegionVerdict | None) -> list[ParameterRegion]:
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
    return kept


def _is_redundant(
    region: ParameterRegion,
    before: list[ParameterRegion],
    after: list[ParameterRegion],
    generic: RegionVerdict | None,
) -> bool:
    """Do the later regions say the same at each value of this one that is in none before?

    One that says the same of all of its values is enough.  Without one, those that say another thing may have no value in
    common with this one, but for values that are in one before, and the generic verdict has to be the same.
    """
    if not _is_known(region) or region.complete is not True:
        return False
    is_generic = generic is not None and _is_same(generic, region.verdict)
    if not is_generic and not _is_variety(region.statement):
        return False
    everything = _everything([region])
    if not everything:
        return False
    charts = _within(region.statement, everything)
    known = [one.statement for one in before]
    said = (_is_said_by(other, region, charts, known) for other in after)
    return next((answer for answer in said if answer is not None), is_generic)


def _is_said_by(
    other: ParameterRegion, region: ParameterRegion, charts: list[ParameterPoint], known: Sequence[Statement]
) -> bool | None:
    """True where another region says the same of all charts of a region, False where it says another thing of some value.

    None where it says nothing of them, but for values at which a known statement holds, or only something of some.
    """
    if _says_the_same(other, region):
        is_whole = _covered(charts, [other.statement])
        return True if is_whole else None
    if _is_apart(other, region) or _is_said_within(known, other.statement, charts):
        return None
    return False


def _is_variety(statement: Statement) -> bool:
    """Is it that functions vanish, and nothing else?"""
    return all(isinstance(part, Vanishes) for part in both(statement).parts)


def _is_apart(other: ParameterRegion, region: ParameterRegion) -> bool:
    """Has the other region a solution at all of its values, where this one has none?"""
    return region.case is None and _proves_a_solution(other)


def _is_said_within(known: Sequence[Statement], statement: Statement, charts: list[ParameterPoint]) -> bool:
    """Does one of the known statements hold at all values of each chart at which this one does?"""
    return all(_is_said(known, statement, chart) for chart in _within(statement, charts))


def _says_the_same(other: ParameterRegion, region: ParameterRegion) -> bool:
    is_complete = other.defined and other.complete is True
    return is_complete and _is_same(other.verdict, region.verdict)


def _is_same(first: RegionVerdict, second: RegionVerdict) -> bool:
    return first == second and first.group == second.group


def _proves_a_solution(region: ParameterRegion) -> bool:
    """Does its statement hold only where there is a solution, also at values that an earlier region has?

    Those about Delta_d are decided at each point by the equation there.
    """
    return region.case is not None and any(isinstance(part, Natural) for part in both(region.statement).parts)


def _everything(regions: Sequence[ParameterRegion]) -> list[ParameterPoint]:
    """All values of the parameters, none where no region says which they are."""
    for region in regions:
        field = _field(region.statement)
        if field is not None:
            return [ParameterPoint.generic(field)]
    return []


def _field(statement: Statement) -> FunctionField | None:
    """That of the functions in a statement."""
    found: list[FunctionField] = []

    def noted(function: FunctionPoly) -> FunctionPoly:
        found.append(function.field)
        return function

    statement.rewritten(noted)
    return next(iter(found), None)


def _left_to_say(other: Statement, charts: list[ParameterPoint]) -> Statement:
    """What the other statement says of the values of a single chart: its parts that don't hold there anyway."""
    field = _field(other)
    if len(charts) != 1 or field is None:
        return other
    (chart,) = charts
    left: list[Statement] = []
    for part in both(other).parts:
        left += _left_of_part(part, chart, field)
    if not left:
        return other
    return all_of(left)


def _left_of_part(part: Statement, chart: ParameterPoint, field: FunctionField) -> list[Statement]:
    """One statement about all parameters; none where the part holds at all values of the chart, or at none."""
    if not isinstance(part, Vanishes):
        return [part]
    value = chart.at(part.function)
    if not value:
        return []
    if not isinstance(value, FunctionPoly):
        return [part]
    factors = irreducible_factors(value)
    if not factors:
        return []
    return [over_all(either(*map(Vanishes, factors)), field)]


def _shortest(statements: Iterable[Statement]) -> tuple[Statement, ...]:
    """Each once, and none that another one follows from."""
    parts = {statement: {*both(statement).parts} for statement in statements}
    found = []
    for statement, own in parts.items():
        if not any(others < own for others in parts.values()):
            found.append(statement)
    return tuple(found)


@dataclass
class _CaseBlock:
    """Cases in a row that begin with one of the `firsts`, which exclude one another; `cases` are without this beginning."""

    firsts: list[Vanishes]
    cases: list[Case]

    def takes(self, first: Vanishes, cases: list[Case]) -> bool:
        """Can another block be added: does it say the same, of no value of this one?"""
        return _exclude_each_other(first, self.firsts[-1]) and _say_the_same(self.cases, cases)

    def add(self, first: Vanishes, cases: list[Case]) -> None:
        self.firsts.append(first)
        pairs = zip(self.cases, cases, strict=True)
        self.cases = [replace(one, regions=(*one.regions, *other.regions)) for one, other in pairs]

    def complete(self) -> list[Case]:
        """The cases with their beginning."""
        beginning = either(*self.firsts)
        return [replace(case, statement=both(beginning, case.statement)) for case in self.cases]


def _mirrored(cases: Iterable[Case]) -> list[Case]:
    """The cases, those of l = 0 and of l = -1 in one where the same is said in them but for the solutions.

    Cases in a row that begin with the same vanishing function are a block.  Two blocks in a row that say the same are one:
    no value belongs to both, because their functions differ by a number.
    """
    found: list[Case] = []
    blocks: list[_CaseBlock] = []
    for first, group in groupby(cases, key=_first_part):
        members = [*group]
        if not isinstance(first, Vanishes) or not all(map(_has_more, members)):
            found += [*_completed(blocks), *members]
            blocks = []
            continue
        inner = _mirrored(map(_without_first, members))
        if blocks and blocks[-1].takes(first, inner):
            blocks[-1].add(first, inner)
        else:
            blocks.append(_CaseBlock([first], inner))
    return [*found, *_completed(blocks)]


def _completed(blocks: Iterable[_CaseBlock]) -> list[Case]:
    """All of their cases, with the beginnings."""
    return list(chain.from_iterable(block.complete() for block in blocks))


def _first_part(case: Case) -> Statement:
    return next(iter(both(case.statement).parts), ALWAYS)


def _has_more(case: Case) -> bool:
    """Than a first part?"""
    return len(both(case.statement).parts) > 1


def _without_first(case: Case) -> Case:
    return replace(case, statement=Both(both(case.statement).parts[1:]))


def _exclude_each_other(first: Vanishes, second: Vanishes) -> bool:
    difference = first.function - second.function
    return first.function.field.rational_value(difference) not in (None, 0)


def _say_the_same(first: Sequence[Case], second: Sequence[Case]) -> bool:
    return len(first) == len(second) and all(map(_says_as_much, first, second))


def _says_as_much(case: Case, other: Case) -> bool:
    """Do they say the same, of the same values?"""
    if case.statement != other.statement or case.without != other.without:
        return False
    return _is_same(case.verdict, other.verdict)


def _joined(cases: Iterable[Case]) -> list[Case]:
    """The cases, with those in a row that can be said in one sentence in one."""
    joined: list[Case] = []
    for case in cases:
        if joined and _can_be_joined(joined[-1], case):
            joined[-1] = _as_one(joined[-1], case)
        else:
            joined.append(case)
    return joined


def _as_one(last: Case, case: Case) -> Case:
    return Case(either(last.statement, case.statement), (*last.regions, *case.regions), case.without)


def _can_be_joined(last: Case, case: Case) -> bool:
    is_single = both(case.statement).parts == both(case.regions[0].statement).parts
    if not is_single or last.without != case.without:
        return False
    return _are_one(last.regions[-1], case.regions[0])


def _are_one(first: ParameterRegion, second: ParameterRegion) -> bool:
    """Can the two be said in one sentence?  Both have simple statements of the same kind, and the same group."""
    if not first.plain or not second.plain:
        return False
    statements = [*alternatives_of(first.statement), *alternatives_of(second.statement)]
    kinds = {type(statement) for statement in statements}
    is_of_one_kind = len(kinds) <= 1 and kinds <= {Vanishes, Congruence}
    return is_of_one_kind and _is_same(first.verdict, second.verdict)


def _covered(charts: list[ParameterPoint], statements: Sequence[Statement]) -> bool:
    """Does one of the statements provably hold at each of the values?"""
    return all(any(_covers(known, chart) for known in statements) for chart in charts)


def _is_said(known: Sequence[Statement], statement: Statement, chart: ParameterPoint) -> bool:
    """Does one of the known statements hold at all values of the chart at which this one does?"""
    known = _possible(known, chart)
    if not known:
        return False
    if _covered([chart], known):
        return True
    try:
        said = {*_parts_on(statement, chart)}
    except _NOT_ON_CHART:
        return False
    return any(_is_among(said, one, chart) for one in known)


def _is_among(said: Collection[Statement], statement: Statement, chart: ParameterPoint) -> bool:
    """Is all that a statement says on the chart said?"""
    try:
        return all(part in said for part in _parts_on(statement, chart))
    except _NOT_ON_CHART:
        return False


def _possible(statements: Sequence[Statement], chart: ParameterPoint) -> list[Statement]:
    """Those that don't begin with a function that vanishes at some values of the chart at most."""
    holds: dict[Statement, bool] = {}
    found = []
    for statement in statements:
        first = next(iter(both(statement).parts), None)
        if not isinstance(first, Vanishes):
            found.append(statement)
            continue
        if first not in holds:
            holds[first] = holds_on(first, chart, NOTHING_ASSUMED)
        if holds[first]:
            found.append(statement)
    return found


def _parts_on(statement: Statement, chart: ParameterPoint) -> Iterator[Statement]:
    """What it says on the chart: all of these statements.  Raises `_NOT_ON_CHART`."""
    for part in both(statement).parts:
        on_chart = part.rewritten(lambda function: over_parameters(chart.at(function)))
        if not _is_true(on_chart):
            yield on_chart


def _is_true(statement: Statement) -> bool:
    return isinstance(statement, Vanishes) and not statement.function


def _covers(statement: Statement, chart: ParameterPoint) -> bool:
    """Does it provably hold at all values of the chart?"""
    is_point = chart.field.ground == QQ
    if is_point:
        return statement.holds(chart)
    return holds_on(statement, chart, NOTHING_ASSUMED)


def _within(statement: Statement, charts: list[ParameterPoint]) -> list[ParameterPoint]:
    """Parts of the charts that contain all values at which the statement holds."""
    if isinstance(statement, Both):
        for part in statement.parts:
            charts = _within(part, charts)
        return charts
    found: list[ParameterPoint] = []
    for chart in charts:
        if isinstance(statement, Either):
            found += _union((_within(part, [chart]) for part in statement.parts), chart)
        else:
            found += _on_chart(statement, chart)
    return found


def _on_chart(statement: Statement, chart: ParameterPoint) -> list[ParameterPoint]:
    """The same for a statement that isn't made of others; the chart where nothing is known."""
    try:
        return _where_possible(statement, chart)
    except ZeroDivisionError:  # a statement doesn't hold where it isn't defined
        return []
    except (TypeError, ValueError):  # no function of parameters
        return [chart]


def _where_possible(statement: Statement, chart: ParameterPoint) -> list[ParameterPoint]:
    if isinstance(statement, Vanishes):
        return _where_zero(chart.at(statement.function), chart)
    if isinstance(statement, Congruence):
        return _where_congruent(statement, chart)
    if isinstance(statement, Schwarz):
        chart.at(statement.cubic)  # is it defined there?
    if isinstance(statement, Natural) and statement.factors is not None:
        return _union((_without_unknown(chart.at(factor), chart) for factor in statement.factors), chart)
    return [chart]


def _where_congruent(statement: Congruence, chart: ParameterPoint) -> list[ParameterPoint]:
    equation = chart.at(statement.equation)
    if statement.holds_for(equation) is False:
        return []
    return _without_unknown(equation, chart)


def _union(parts: Iterable[list[ParameterPoint]], chart: ParameterPoint) -> list[ParameterPoint]:
    """All of the parts of a chart; the chart alone where one of them is all of it."""
    found: list[ParameterPoint] = []
    for part in parts:
        if any(zeros is chart for zeros in part):
            return [chart]
        found += part
    return found


def _without_unknown(equation: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    """Where an equation for a number can have a root: everywhere, if the number occurs in it on the chart."""
    if equation.degree > 0 or not equation:
        return [chart]
    return _where_zero(equation[0], chart)


def _where_zero(value: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    if not value:
        return [chart]
    if not isinstance(value, FunctionPoly):
        return []
    found: list[ParameterPoint] = []
    for factor in irreducible_factors(value):
        surface = hypersurface(factor)
        if surface.missed or surface.curve:
            return [chart]
        values = tuple(surface.at(over_parameters(value)) for value in chart.values)
        found.append(ParameterPoint(chart.names, values, surface.field))
    return found

"""Regions of parameter space: a statement, the verdict where it holds and no earlier one does, and solutions there.

From regions, of which the first decides, to the cases of a theorem: solvable if and only if one of them holds.  Regions without
a Liouvillian solution, "a = 0: none", are no cases.  A later case holds only outside of them, which needn't be stated where the
two exclude one another, or meet only in values of an earlier case.

A chart gives values of the parameters at which a statement can hold, as functions of fewer ones.  All tests on it are
sufficient and exact: `within` contains every value at which a statement holds, and maybe more; `holds` is True only where a
statement holds at all values of a chart.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial, reduce
from itertools import chain, groupby, product

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import Decision, Status, Structure
from kovacic.equation import Equation
from kovacic.errors import LimitExceeded
from kovacic.galois.group import Group
from kovacic.limits import DEFAULT_LIMITS, MOST_CHARACTERS, MOST_TRIALS, Budget, Limits, check_time
from kovacic.parametric import prose
from kovacic.parametric.claims import (
    Claim,
    ParameterPoint,
    irreducible_factors,
    on_linear_zeros,
    rational_number,
)
from kovacic.parametric.integers import Congruence
from kovacic.parametric.natural import WITHOUT_FORMULA, Natural
from kovacic.parametric.prose import Words
from kovacic.parametric.restriction import Hypersurface, hypersurface, with_free_constant
from kovacic.parametric.solutions import Later, PolynomialSolution, SolutionsByDegree
from kovacic.parametric.statements import ALWAYS, Both, Either, Setting, Statement, Vanishes, all_of, either
from kovacic.writing.formula import text_of_words


class Limited(str):
    """A sentence about what isn't proven because a limit of the call ended the search; larger limits may change it."""

    @classmethod
    def by(cls, limit: LimitExceeded) -> Limited:
        return cls(f"only as far as the limits allowed: {limit}")


class Theory(str):
    """The theorems by which something is proven, in a sentence; in `literal` formulas stand between backquotes."""

    literal: str
    #: The keys of the publications.
    sources: tuple[str, ...]

    def __new__(cls, literal: str, *sources: str) -> Theory:
        self = super().__new__(cls, text_of_words(prose.phrase(literal)))
        self.literal = literal
        self.sources = sources
        return self

    def also(self, literal: str, *sources: str) -> Theory:
        """The sentence with another theorem, each once."""
        if self.literal.endswith(literal):
            return self
        return Theory(self.literal + literal, *self.sources, *sources)


@dataclass(frozen=True)
class RegionVerdict:
    """What holds in a region of parameters.

    Attributes
    ----------
    structure : Structure or None
        The structure of the group; None without a Liouvillian solution.
    known : bool
        False if nothing is claimed.
    family : str or None
        More about the group than its structure, with formulas between backquotes.
    abelian : str or None
        Whether the identity component of a reducible group is abelian, likewise, if more than the structure is known;
        `identity_component` has it for every group.

    Examples
    --------
    >>> import kovacic
    >>> generic = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").generic
    >>> print(generic, "|", generic.case, "|", generic.group)
    no Liouvillian solution | None | SL2(C)
    """

    structure: Structure | None
    known: bool = True
    family: str | None = field(default=None, compare=False)
    abelian: str | None = field(default=None, compare=False)

    @property
    def case(self) -> int | None:
        """Kovacic's case, 1 to 3; None without a Liouvillian solution."""
        return None if self.structure is None else self.structure.case

    @property
    def group(self) -> str:
        """The family of the Galois group."""
        said = text_of_words(self.group_in_words)
        adjective = _ADJECTIVES.get(self.structure) if self.known and self.family is None else None
        return f"{adjective}: {said}" if adjective else said

    @property
    def group_in_words(self) -> Words:
        """The family with its formulas, without the structure."""
        return prose.phrase((self.family or _GROUPS[self.structure]) if self.known else "not determined")

    @property
    def identity_component(self) -> Words:
        """Whether the group's identity component is abelian, in words: a condition for integrability by Morales and Ramis."""
        said = self.abelian or _COMPONENTS.get(self.structure, ABELIAN)
        return prose.phrase(said if self.known else "not determined")

    def says_the_same(self, other: RegionVerdict) -> bool:
        """True for the same structure and the same group.

        Parameters
        ----------
        other : RegionVerdict
            The verdict of another region.
        """
        return self == other and self.group == other.group

    def __str__(self) -> str:
        if not self.known:
            return "not determined"
        return "no Liouvillian solution" if self.case is None else f"case {self.case}"


#: Of the identity component of a group.
ABELIAN = "abelian"
NOT_ABELIAN = "not abelian"


def reducible(family: str, component: str = ABELIAN) -> RegionVerdict:
    """The verdict for a reducible group, by its name and that of its identity component, with formulas between backquotes."""
    return RegionVerdict(Structure.REDUCIBLE, family=family, abelian=component)


def borel(diagonal: str = "") -> RegionVerdict:
    """The verdict for Borel's group, which is G_m under a condition, if one is given."""
    if not diagonal:
        return reducible("the Borel group", NOT_ABELIAN)
    return reducible(f"the Borel group, or `G_m` where {diagonal}", f"abelian exactly where {diagonal}")


#: The formulas in the name of a group.
_FORMULA = re.compile(r"\w+_\w+|\w+\(\w\)|\{.*\}")


def verdict_from_engine(decision: Decision, group: Group | None = None) -> RegionVerdict:
    """The verdict by the engine's decision, and by the group if it is known."""
    verdict = RegionVerdict(decision.structure, decision.status is not Status.UNDECIDED)
    if group is None:
        return verdict
    is_small = group.dimension is not None and group.dimension < 2
    family = _FORMULA.sub(r"`\g<0>`", group.name)
    return replace(verdict, family=family, abelian=ABELIAN if is_small else NOT_ABELIAN)


_COMPONENTS = {Structure.REDUCIBLE: "abelian unless the group has dimension 2", None: NOT_ABELIAN}
_ADJECTIVES: dict[Structure | None, str] = {Structure.REDUCIBLE: "reducible", Structure.IMPRIMITIVE: "imprimitive"}
_GROUPS = {
    Structure.REDUCIBLE: "a subgroup of the triangular group",
    Structure.IMPRIMITIVE: "dicyclic, or the infinite dihedral group",
    Structure.TETRAHEDRAL: "binary tetrahedral, order 24",
    Structure.OCTAHEDRAL: "binary octahedral, order 48",
    Structure.ICOSAHEDRAL: "binary icosahedral, order 120",
    None: "`SL2(C)`",
}


#: Degrees of omega by the case, if it isn't rational.
_DEGREES_OF_OMEGA = {2: "2", 3: "4, 6 or 12"}


@dataclass(frozen=True)
class ParameterRegion:
    """A region: the values at which its `statement` holds, and no earlier region's.

    Attributes
    ----------
    statement : Statement
        Logic about the parameters; `str` of the region begins with its text.
    verdict : RegionVerdict
        The case and the group there.
    complete : bool or str
        True if the statement is proven to describe all such values and nothing else; otherwise a phrase that states what isn't
        proven, and the verdict isn't known.
    defined : bool
        False if S isn't defined there; then the verdict isn't known.
    shown_degree : int or None
        For a statement with a natural number d: the d up to which `determinants` lists Delta_d.
    limits : Limits
        The limits for `determinants`.
    origin : callable or None
        The source of `solution`; None if no formula is known.

    Examples
    --------
    >>> import kovacic
    >>> region = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").regions[0]
    >>> print(region, "|", region.case, "|", region.complete)
    n - 1/2 in Z: case 1 | 1 | True
    """

    statement: Statement
    verdict: RegionVerdict
    complete: bool | str = True
    defined: bool = True
    shown_degree: int | None = None
    limits: Limits = field(default=DEFAULT_LIMITS, compare=False)
    origin: SolutionsByDegree | Later | None = field(default=None, compare=False)

    @property
    def naturals(self) -> list[Natural]:
        """The conditions with a natural number."""
        return [part for part in self.statement.conjuncts if isinstance(part, Natural)]

    def solution(self, number: int | None = None) -> tuple[PolynomialSolution, ...]:
        """Solutions of y'' = S y for all parameters of the region at once, with the degree d that has to be a natural number.

        They contain Laguerre or Jacobi polynomials of degree d, as SymPy's functions.

        Parameters
        ----------
        number : int
            The d for which solutions are given, if the condition contains a determinant Delta_d: the coefficients of P are
            functions of the parameters, and y is a solution at those values of the region at which `where` holds.

        Returns
        -------
        tuple of PolynomialSolution
            () if no formula is known; `why_no_solution` gives the reason.

        Examples
        --------
        >>> import kovacic
        >>> bessel = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").regions[0]
        >>> bessel.solution()[0].degree
        -n - 1/2
        >>> sextic = kovacic.conditions("x^6 + a*x^2 + b", var="x").regions[0]
        >>> print(sextic.solution(0)[0])
        y = exp(-x^4/4) where a = -3, b = 0
        """
        return () if self.formulas is None else self.formulas(number)

    @property
    def formulas(self) -> SolutionsByDegree | None:
        """The source of `solution`, found only now if the conditions were read from JSON."""
        return self.origin.find() if isinstance(self.origin, Later) else self.origin

    @cached_property
    def determinants(self) -> tuple[str, ...]:
        """The first Delta_d of a statement with a natural number in it, a line each, as far as the limits allow."""
        statement = self.statement
        if self.shown_degree is None or not isinstance(statement, Natural):
            return ()
        found: list[str] = []
        with Budget(self.limits).watched(), suppress(LimitExceeded):
            for d in range(self.shown_degree + 1):
                values = statement.values(d)
                said = [
                    value + f" where {text_of_words(places)}" * (len(values) > 1 and len(places) > 0)
                    for value, places in values.items()
                ]
                text = "; ".join(said)
                if len(text) > MOST_CHARACTERS:
                    text = f"{text[:MOST_CHARACTERS]}..."
                equals = "is" if WITHOUT_FORMULA in values else "="
                found.append(f"Delta_{d} {equals} {text}" if said else f"{statement.letter} is never {d}")
        return tuple(found)

    @property
    def why_no_solution(self) -> str:
        """The reason why there is no formula in all of the parameters, in a sentence; "" if `solution()` has one."""
        if self.case is None or not self.verdict.known:
            return f"nothing is solved where the answer is: {self.said}"
        if self.case > 1:
            said = f"omega is algebraic of degree {_DEGREES_OF_OMEGA[self.case]}"
            return f"{said}, and depends on the values of the parameters: solve_at gives it"
        if self.formulas is None:
            return "omega follows from the equation on this part: solve_at, or assume the values"
        if self.naturals:
            return "P has another degree for each natural number: solution(d), () where the exponents need two square roots"
        if self.solution():
            return ""
        return "the singular points are the roots of a cubic, which isn't solved"

    @property
    def case(self) -> int | None:
        """Kovacic's case in the region; None without a Liouvillian solution."""
        return self.verdict.case

    @property
    def group(self) -> str:
        """The family of the Galois group, in words."""
        if self.defined:
            return self.verdict.group
        return text_of_words(prose.phrase(self.verdict.family or "S isn't defined"))

    @property
    def said(self) -> str:
        """The verdict in words: the case, or why none is known."""
        return str(self.verdict) if self.defined else self.group

    @property
    def plain(self) -> bool:
        """True if there is nothing to state but the statement and the case."""
        return self.verdict.known and self.shown_degree is None

    def __repr__(self) -> str:
        return f"<ParameterRegion {self.statement.text()}: {self.said}>"

    def _repr_latex_(self) -> str:
        return rf"${self.statement.latex()}\colon\ \text{{{self.said}}}$"

    def __str__(self) -> str:
        known = "" if self.complete is True else f" [{self.complete}]"
        first = f"{self.statement.text()}: {self.said}{known}"
        return "\n      ".join([first, *self.determinants])


@dataclass(frozen=True)
class Theorem:
    """The regions, in their order, that describe all values at which none of the functions in `exceptions` vanishes."""

    name: Theory
    exceptions: list[FunctionPoly]
    regions: Iterable[ParameterRegion]


def charts_of(statement: Statement) -> list[ParameterPoint]:
    """Charts that contain all values at which the statement holds; none for a statement without functions."""
    return [] if statement.field is None else within(statement, [ParameterPoint.generic(statement.field)])


def within(statement: Statement, charts: list[ParameterPoint]) -> list[ParameterPoint]:
    """Parts of the charts that contain all of their values at which the statement holds."""
    found = list[ParameterPoint]()
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
    if isinstance(statement, Congruence) and statement.numbers.has_root_of(chart.at(statement.equation)) is False:
        return []
    return _union((_where_solvable(chart.at(equation), chart) for equation in statement.equations), chart)


def _where_solvable(equation: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    """Where an equation for a number can have a root: everywhere, if the number occurs in it; else where it vanishes."""
    if equation.degree == 0 and chart.field.ground == QQ:  # a number other than 0
        return []
    # Over a number field, a function of further parameters isn't examined.
    if equation.degree != 0 or isinstance(equation, ExtensionPoly):
        return [chart]
    surfaces = [*map(hypersurface, irreducible_factors(equation))]
    if any(surface.missed or surface.curve for surface in surfaces):
        return [chart]
    return [_on(surface, chart) for surface in surfaces]


def _on(surface: Hypersurface, chart: ParameterPoint) -> ParameterPoint:
    values = tuple(map(surface.at, chart.values))
    return ParameterPoint(chart.names, values, surface.field)


def _union(parts: Iterable[list[ParameterPoint]], chart: ParameterPoint) -> list[ParameterPoint]:
    """All of the parts of a chart; the chart alone if one of them is the whole chart."""
    found = [*chain.from_iterable(parts)]
    return [chart] if any(part is chart for part in found) else found


def covered(charts: Iterable[ParameterPoint], statements: Sequence[Statement]) -> bool:
    """True if on each chart one of the statements provably holds."""
    return all(any(known.holds(one) for known in statements) for one in charts)


def without_implied_equations(statement: Statement) -> Statement:
    """The statement with linear equations inserted into the others: g2 = g3 = 0 without g2^3 = 27 g3^2, which it implies."""
    valued = partial(on_linear_zeros, zeros=[zero.function for zero in vanishing(statement.conjuncts)])
    return all_of(part.rewritten(valued) if isinstance(part, Vanishes) else part for part in statement.conjuncts)


def vanishing(statements: Iterable[Statement]) -> list[Vanishes]:
    """The statements that a function vanishes."""
    return [statement for statement in statements if isinstance(statement, Vanishes)]


def is_variety(statement: Statement) -> bool:
    """True if the statement is only that functions vanish."""
    return all(isinstance(one, Vanishes) for part in statement.conjuncts for one in part.alternatives)


def common_zeros_of(statement: Statement) -> list[tuple[FunctionPoly, ...]]:
    """The sets of common zeros that make up the part of a statement that is about vanishing functions."""
    varieties = filter(is_variety, statement.conjuncts)
    return [*product(*([one.function for one in vanishing(part.alternatives)] for part in varieties))]


def settled_regions(regions: Iterable[ParameterRegion], setting: Setting) -> list[ParameterRegion]:
    """The regions in their order, each printed for the values that belong to none before it, and none twice."""
    found: dict[Claim, ParameterRegion] = {}
    for region in regions:
        statement = region.statement.avoiding(setting)
        found.setdefault(statement.claim, replace(region, statement=statement))
        if is_variety(statement):
            setting = reduce(lambda known, zeros: known.also(*zeros), common_zeros_of(statement), setting)
    return [*found.values()]


# ------------------------------------------------------------------------------- the equation in a region


def equations_on(statement: Statement, equation: Equation) -> list[tuple[Equation, tuple[FunctionPoly, ...]]]:
    """The equation y'' + p y' + q y = 0 restricted to the pieces of a region, where formulas get their gauge from it.

    Each comes with the functions that vanish on this piece, and not on every one.  On a piece poles of b/a can merge or go to
    infinity, and the specialised generic gauge is another function.  Pieces that aren't given by functions of fewer parameters
    are left out.
    """
    pieces = common_zeros_of(statement)
    there = ((_on_piece(equation, piece), piece if len(pieces) > 1 else ()) for piece in pieces)
    return [(one, piece) for one, piece in there if one is not None]


def _on_piece(equation: Equation, functions: Sequence[FunctionPoly]) -> Equation | None:
    """The equation at the generic point of the common zeros; None if these fall apart."""
    if not functions:
        return equation
    point = ParameterPoint.generic(functions[0].field)
    try:
        for function in functions:
            factors = irreducible_factors(point.at(function))
            if len(factors) != 1:
                return None
            point = _on(hypersurface(factors[0]), point)
    except (TypeError, ZeroDivisionError):  # a function on a hypersurface, or undefined at these values
        return None
    return equation_at(equation, point)


def normal_form_equation(S: RatFunc, variable: str) -> Equation:
    """The equation y'' - S y = 0."""
    return Equation(a=S * 0 + 1, b=S * 0, c=-S, f=S * 0, variable=variable)


def equation_at(equation: Equation, point: ParameterPoint) -> Equation | None:
    """y'' + p y' + q y = 0 with these values of the parameters; None if p or q isn't defined."""
    try:
        p, q = (point.restricted(with_free_constant(part / equation.a).S) for part in (equation.b, equation.c))
    except ZeroDivisionError:
        return None
    return replace(equation, a=q * 0 + 1, b=p, c=q, f=q * 0, h=None)


@dataclass(frozen=True)
class Case:
    """Where `statement` holds, but none of `without` and no earlier case, the verdict is that of each of the `regions`."""

    statement: Statement
    regions: tuple[ParameterRegion, ...]
    without: tuple[Statement, ...] = ()


def solvable_cases(regions: Sequence[ParameterRegion]) -> list[Case]:
    """The cases with Liouvillian solutions, in the order of the regions; neighbours with the same verdict are one."""
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
    return grouped_cases(found, lambda first, second: first.verdict.says_the_same(second.verdict))


def in_lines(regions: Sequence[ParameterRegion]) -> list[ParameterRegion]:
    """The regions as they are listed, neighbours with the same case as one."""
    cases = [Case(region.statement, (region,)) for region in regions]
    together = grouped_cases(cases, lambda first, second: first.case == second.case)
    return [replace(case.regions[0], statement=case.statement) for case in together]


def without_empty(regions: Iterable[ParameterRegion]) -> tuple[ParameterRegion, ...]:
    """The regions without those that earlier ones cover, for instance because their statements are stronger."""
    kept: list[ParameterRegion] = []
    for region in regions:
        check_time()
        statement = region.statement
        earlier = [other.statement for other in kept]
        is_stronger = any({*statement.conjuncts}.issuperset(other.conjuncts) for other in earlier)
        if not is_stronger and not covered(charts_of(statement), earlier):
            kept.append(region)
    return tuple(kept)


def without_redundant(regions: Sequence[ParameterRegion], generic: RegionVerdict | None) -> tuple[ParameterRegion, ...]:
    """The regions without those at whose values the later ones, or the generic verdict, say the same; None claims nothing.

    "l = 0: no Liouvillian solution" needn't be stated where no later region with a solution meets l = 0.
    """
    kept = [*regions]
    for k in reversed(range(len(regions))):
        check_time()
        if _is_redundant(kept[k], kept[:k], kept[k + 1 :], generic):
            del kept[k]
        elif len(regions) > MOST_TRIALS // 4:  # only the last ones: Heun's general equation has 250
            break
    return tuple(kept)


def _is_redundant(
    region: ParameterRegion,
    before: list[ParameterRegion],
    after: list[ParameterRegion],
    generic: RegionVerdict | None,
) -> bool:
    """True if the later regions say the same at each value of this one that is in no earlier region.

    A later region that covers it with the same verdict is enough.  Otherwise the generic verdict has to be the same, and
    later regions with another verdict may meet this one only in values of earlier regions.
    """
    is_generic = generic is not None and generic.says_the_same(region.verdict)
    charts = charts_of(region.statement)
    known = [one.statement for one in before]
    for other in after:
        says_the_same = other.verdict.says_the_same(region.verdict)
        if says_the_same and covered(charts, [other.statement]):
            return True
        # A region that has a solution at all of its values doesn't meet one without solutions.
        is_apart = region.case is None and _proves_a_solution(other)
        if not says_the_same and not is_apart and not covered(within(other.statement, charts), known):
            return False
    return is_generic


def _proves_a_solution(region: ParameterRegion) -> bool:
    """True if its statement, about Delta_d, implies a solution by itself, also at values of earlier regions."""
    return region.case is not None and bool(region.naturals)


# ------------------------------------------------------------------------------- several regions in one sentence

#: True if two regions are described in the same way.
Likeness = Callable[[ParameterRegion, ParameterRegion], bool]


def grouped_cases(cases: Iterable[Case], is_same: Likeness) -> list[Case]:
    """The cases, neighbours that are described in the same way, for values of one kind, as one."""
    joined: list[Case] = []
    for case in _mirrored(cases, is_same):
        together = _together(joined[-1], case, is_same) if joined else None
        if together is None:
            joined.append(case)
        else:
            joined[-1] = together
    return joined


def _together(last: Case, case: Case, is_same: Likeness) -> Case | None:
    """Two cases as one, if only the verdict is stated in them, and their statements are of one kind."""
    before, after = last.regions[-1], case.regions[0]
    own = either(*(all_of(region.statement.conjuncts) for region in case.regions))
    if case.statement != own or last.without != case.without:
        return None
    if not (before.plain and after.plain and is_same(before, after)):
        return None
    statement = either(last.statement, case.statement)
    kinds = {type(part) for part in statement.alternatives}
    if len(kinds) > 1 or kinds == {Both}:
        return None
    return Case(statement, (*last.regions, *case.regions), case.without)


def _mirrored(cases: Iterable[Case], is_same: Likeness) -> list[Case]:
    """The cases, those of l = 0 and of l = -1 as one if they differ in nothing but the solutions.

    Cases in a row that begin with the same vanishing function are a block.  Two neighbouring blocks that say the same become
    one: no value belongs to both, because their functions differ by a number.
    """
    blocks: list[tuple[list[Statement], list[Case]]] = []  # the beginnings, and the cases without them
    for first, group in groupby(cases, key=lambda case: next(iter(case.statement.conjuncts), ALWAYS)):
        inner = [replace(case, statement=Both(case.statement.conjuncts[1:])) for case in group]
        if any(case.statement.conjuncts for case in inner):
            inner = _mirrored(inner, is_same)
        firsts = [first]
        before, known = blocks[-1] if blocks else ([ALWAYS], [])
        functions = [one.function for one in vanishing([before[-1], first])]
        exclude_one_another = len(functions) == 2 and rational_number(functions[0] - functions[1]) is not None
        if exclude_one_another and _say_the_same(known, inner, is_same):
            blocks.pop()
            firsts = [*before, first]
            pairs = zip(known, inner, strict=True)
            inner = [replace(one, regions=(*one.regions, *other.regions)) for one, other in pairs]
        blocks.append((firsts, inner))
    return [
        replace(case, statement=all_of((either(*firsts), *case.statement.conjuncts)))
        for firsts, inner in blocks
        for case in inner
    ]


def _say_the_same(cases: list[Case], others: list[Case], is_same: Likeness) -> bool:
    """True if the cases have the same statements and verdicts."""

    def but_for_verdict(case: Case) -> Case:
        plain = replace(case.regions[0], statement=ALWAYS, verdict=RegionVerdict(None))
        return replace(case, regions=(plain,))

    is_alike = [*map(but_for_verdict, cases)] == [*map(but_for_verdict, others)]
    pairs = zip(cases, others, strict=False)
    return is_alike and all(is_same(case.regions[0], other.regions[0]) for case, other in pairs)

"""Regions of parameter space, and which of them say nothing new, because every one of their points lies in an earlier one.

The test is sufficient and exact: a region's points are given as functions of fewer parameters, or of an integer k, and what
earlier regions state is decided for these functions.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import count, groupby
from typing import Any, NamedTuple

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Decision, Status, Structure
from kovacic.equation import PI, Equation
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits, check_time
from kovacic.parametric import prose
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions, Known
from kovacic.parametric.claims import Classes
from kovacic.parametric.functions import ParameterPoint, irreducible_factors, over_parameters
from kovacic.parametric.integers import Congruence
from kovacic.parametric.natural import Natural
from kovacic.parametric.prose import Words
from kovacic.parametric.record import statement_data
from kovacic.parametric.restriction import hypersurface, with_free_constant
from kovacic.parametric.solutions import Later, Origin, PolynomialSolution
from kovacic.parametric.solving import SolvedCondition, all_solved, possible
from kovacic.parametric.statements import (
    ALWAYS,
    Both,
    Either,
    Setting,
    Statement,
    Vanishes,
    all_of,
    alternatives_of,
    both,
    either,
)

#: Characters up to which statements share a line.
_LINE = 100


@dataclass(frozen=True)
class RegionVerdict:
    """What holds in a region of parameters.

    Attributes
    ----------
    structure : Structure or None
        The structure of the group; None without a Liouvillian solution.
    known : bool
        Is anything claimed?
    family : tuple or None
        More about the group than the structure says, in words and formulas.
    abelian : tuple or None
        Whether the identity component of a reducible group is abelian, in words and formulas, if more than the structure is
        known: `identity_component` has it for every group.

    Examples
    --------
    >>> import kovacic
    >>> generic = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").generic
    >>> print(generic, "|", generic.case, "|", generic.group)
    no Liouvillian solution | None | SL2(C)
    """

    structure: Structure | None
    known: bool = True
    family: Words | None = field(default=None, compare=False)
    abelian: Words | None = field(default=None, compare=False)

    @classmethod
    def of(cls, decision: Decision) -> RegionVerdict:
        """What the engine's decision says.

        Parameters
        ----------
        decision : Decision
            Of one equation.

        Returns
        -------
        RegionVerdict
            Its `known` is False where it is undecided.

        Examples
        --------
        >>> import kovacic
        >>> print(RegionVerdict.of(kovacic.solve("x").decision))
        no Liouvillian solution
        """
        return cls(decision.structure, decision.status is not Status.UNDECIDED)

    def to_dict(self) -> dict[str, Any]:
        """Its part of the JSON object.

        Returns
        -------
        dict
            structure, known, family.

        Examples
        --------
        >>> import kovacic
        >>> kovacic.conditions("n/x^2").generic.to_dict()
        {'structure': 'reducible', 'known': True, 'family': None}
        """
        family = self.family and prose.marked(self.family)
        data = {"structure": self.structure and self.structure.value, "known": self.known, "family": family}
        return data if self.abelian is None else data | {"abelian": prose.marked(self.abelian)}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> RegionVerdict:
        """The way back from `to_dict`.

        Parameters
        ----------
        data : mapping
            What `to_dict` returned.

        Returns
        -------
        RegionVerdict
            Equal to the one that was written.

        Examples
        --------
        >>> import kovacic
        >>> generic = kovacic.conditions("n/x^2").generic
        >>> RegionVerdict.from_dict(generic.to_dict()) == generic
        True
        """
        name = data["structure"]
        structure = None if name is None else Structure(name)
        family, abelian = (said and prose.phrase(said) for said in (data["family"], data.get("abelian")))
        return cls(structure, data["known"], family, abelian)

    @property
    def case(self) -> int | None:
        """Kovacic's case, 1 to 3; None without a Liouvillian solution."""
        return None if self.structure is None else self.structure.case

    @property
    def group(self) -> str:
        """The family of the Galois group."""
        if self.known and self.family is None and self.structure in _ADJECTIVES:
            return f"{_ADJECTIVES[self.structure]}: {prose.text_of(self.group_in_words)}"
        return prose.text_of(self.group_in_words)

    @property
    def group_in_words(self) -> Words:
        """The same with its formulas, without the structure."""
        if not self.known:
            return ("not determined",)
        return self.family or _GROUPS[self.structure]

    @property
    def identity_component(self) -> Words:
        """Is the identity component of the group abelian, as integrability by Morales and Ramis needs?  In words."""
        if not self.known:
            return ("not determined",)
        if self.structure is None:
            return prose.NOT_ABELIAN
        if self.structure is not Structure.REDUCIBLE:
            return prose.ABELIAN
        return self.abelian or ("abelian unless the group has dimension 2",)

    def __str__(self) -> str:
        if not self.known:
            return "not determined"
        return "no Liouvillian solution" if self.case is None else f"case {self.case}"


_ADJECTIVES = {Structure.REDUCIBLE: "reducible", Structure.IMPRIMITIVE: "imprimitive"}
_GROUPS: dict[Structure | None, Words] = {
    Structure.REDUCIBLE: ("a subgroup of the triangular group",),
    Structure.IMPRIMITIVE: ("dicyclic, or the infinite dihedral group",),
    Structure.TETRAHEDRAL: ("binary tetrahedral, order 24",),
    Structure.OCTAHEDRAL: ("binary octahedral, order 48",),
    Structure.ICOSAHEDRAL: ("binary icosahedral, order 120",),
    None: prose.phrase("`SL2(C)`"),
}


#: Of omega in the cases in which it isn't rational.
_DEGREES_OF_OMEGA = {2: "2", 3: "4, 6 or 12"}


@dataclass(frozen=True)
class ParameterRegion:
    """One region: where its `statement` holds and no earlier region's.

    Attributes
    ----------
    statement : Statement
        Logic about the parameters; `str` of the condition begins with its text.
    verdict : RegionVerdict
        What holds there.
    complete : bool or str
        True where it is proven that the statement describes all such values and nothing else, else what isn't proven.
    defined : bool
        False where S isn't defined.
    shown_degree : int or None
        For a statement with a natural number d: `determinants` has those up to this d.
    limits : Limits
        For these.
    origin : callable or None
        What `solution` asks; None where no formula is known.

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
    origin: Origin | None = field(default=None, compare=False)

    def solution(self, number: int | None = None) -> tuple[PolynomialSolution, ...]:
        """Solutions of y'' = S y for all parameters of the region at once, with the degree d that has to be a natural number.

        They contain Laguerre or Jacobi polynomials of degree d, as SymPy's functions.

        Parameters
        ----------
        number : int
            Where the condition has a determinant Delta_d in it, they are given for this d: the coefficients of P are functions
            of the parameters, and in the region y is a solution where `where` holds.

        Returns
        -------
        tuple of PolynomialSolution
            () where no formula is known; `why_no_solution` says why.

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
    def formulas(self) -> Origin | None:
        """What `solution` asks, found now where conditions were read from JSON."""
        return self.origin.find() if isinstance(self.origin, Later) else self.origin

    @cached_property
    def determinants(self) -> tuple[str, ...]:
        """The first Delta_d of a statement with a natural number in it, a line each, as far as the limits allow."""
        statement = self.statement
        if self.shown_degree is None or not isinstance(statement, Natural):
            return ()
        found: list[str] = []
        with Budget(self.limits).watched(), suppress(LimitExceeded):
            found.extend(map(statement.shown_determinant, range(self.shown_degree + 1)))
        return tuple(found)

    def numbers_at(self, point: ParameterPoint) -> list[int | None]:
        """For `solution`: the degrees that the exponents allow at a point; None where there is none to choose.

        Parameters
        ----------
        point : ParameterPoint
            What `Conditions.point` returned.

        Returns
        -------
        list
            Natural numbers, or None alone.
        """
        natural = [part for part in both(self.statement).parts if isinstance(part, Natural) and part.m == 1]
        if not natural:
            return [None]
        return [number for part in natural for number in part.numbers_at(point)]

    @property
    def why_no_solution(self) -> str:
        """A sentence where `solution()` is empty: why there is no formula in all of the parameters; "" where there is one."""
        if not self.defined:
            return f"nothing is solved where the answer is: {self.group}"
        if self.case is None or not self.verdict.known:
            return f"nothing is solved where the answer is: {self.verdict}"
        if self.case > 1:
            degree = _DEGREES_OF_OMEGA[self.case]
            return (
                f"omega is algebraic of degree {degree}, and depends on the values of the parameters: solve_at gives it"
            )
        if self.formulas is None:
            return "omega follows from the equation on this part: solve_at, or assume the values"
        if _has_natural_number(self.statement):
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
        return self.verdict.group if self.defined else "S isn't defined"

    @property
    def plain(self) -> bool:
        """Is there nothing to say beside the statement and the case?"""
        is_proven = self.complete is True and self.verdict.known
        return self.defined and is_proven and self.shown_degree is None

    def to_dict(self) -> dict[str, Any]:
        """The region's part of the JSON object.

        Returns
        -------
        dict
            condition, case, group, complete, defined, statement, verdict, and determinants where there are any.

        Examples
        --------
        >>> import kovacic
        >>> (region,) = kovacic.conditions("(4*n^2 - 1)/(4*x^2) - 1").regions
        >>> region.to_dict()["condition"], region.to_dict()["case"]
        ('n - 1/2 in Z', 1)
        """
        data: dict[str, Any] = {
            "condition": self.statement.text(),
            "case": self.case,
            "group": self.group,
            "complete": self.complete,
            "defined": self.defined,
            "statement": statement_data(self.statement),
            "verdict": self.verdict.to_dict(),
        }
        if self.shown_degree is not None:
            data["determinants"] = list(self.determinants)
        return data

    def __repr__(self) -> str:
        return f"<ParameterRegion {self.statement.text()}: {said_of(self)}>"

    def _repr_latex_(self) -> str:
        return rf"${self.statement.latex()}\colon\ \text{{{said_of(self)}}}$"

    def __str__(self) -> str:
        known = ""
        if self.defined and self.complete is not True:
            known = f" [{self.complete}]"
        first = f"{self.statement.text()}: {said_of(self)}{known}"
        return "\n      ".join([first, *self.determinants])


def _has_natural_number(statement: Statement) -> bool:
    """Is it about a determinant Delta_d?"""
    return any(isinstance(part, Natural) for part in both(statement).parts)


def said_of(region: ParameterRegion) -> str:
    """What holds in a region in words: the case, or that S isn't defined."""
    if region.defined:
        return str(region.verdict)
    return region.group


def settled(
    regions: Sequence[ParameterRegion], variable: str, names: tuple[str, ...], constants: tuple[str, ...]
) -> list[ParameterRegion]:
    """The regions in their order, so that each is printed for the values that belong to none before it.

    `names` are the parameters, among them the `constants`, for which nothing is solved, nor for pi.
    """
    fixed = (*constants, *(name for name in names if name == PI))
    covered: list[frozenset[FunctionPoly]] = []
    found = []
    for region in regions:
        setting = Setting((variable, *names), fixed, tuple(covered))
        found.append(replace(region, statement=region.statement.avoiding(setting)))
        for one in alternatives_of(all_of(both(region.statement).parts)):
            zeros = _vanishing(both(one).parts)
            if len(zeros) == len(both(one).parts):
                covered.append(frozenset(zeros))
    return found


@dataclass(frozen=True)
class Theorem:
    """The regions, in their order, that describe all values at which none of the functions in `exceptions` vanishes."""

    name: str
    exceptions: list[FunctionPoly]
    regions: Iterable[ParameterRegion]


def _mirrored(regions: Sequence[ParameterRegion]) -> Iterator[ParameterRegion]:
    """The regions, with those of n = 0 and n = -1 in one where what is said in all of them is the same.

    Regions in a row that begin with the same vanishing function are a block.  Two blocks in a row that differ in that function
    alone mean the same as one of either: at a point of both, the first of their common conditions that holds decides.
    """
    blocks: list[_RegionBlock] = []
    for first, group in groupby(regions, key=_first_part):
        inner = [replace(region, statement=Both(both(region.statement).parts[1:])) for region in group]
        if blocks and blocks[-1].takes(first, inner):
            blocks[-1].firsts.append(first)
        else:
            blocks.append(_RegionBlock([first], inner))
    for block in blocks:
        yield from block.complete()


@dataclass
class _RegionBlock:
    """Regions in a row that begin with one of the `firsts`; `regions` are without this beginning."""

    firsts: list[Statement]
    regions: list[ParameterRegion]

    def takes(self, first: Statement, regions: list[ParameterRegion]) -> bool:
        """Can another block be added: do both begin with functions that vanish, and say the same otherwise?"""
        are_functions = isinstance(first, Vanishes) and isinstance(self.firsts[-1], Vanishes)
        return are_functions and self.regions == regions

    def complete(self) -> Iterator[ParameterRegion]:
        """The regions with their beginning."""
        regions: Iterable[ParameterRegion] = self.regions
        if any(both(region.statement).parts for region in self.regions):
            regions = _mirrored(self.regions)
        for region in regions:
            parts = (either(*self.firsts), *both(region.statement).parts)
            statement = Both(parts) if len(parts) > 1 else parts[0]
            yield replace(region, statement=statement)


def _first_part(region: ParameterRegion) -> Statement:
    """ALWAYS for a region of which nothing is said beside what its block has in common."""
    return next(iter(both(region.statement).parts), ALWAYS)


def in_one_line(regions: Sequence[ParameterRegion]) -> list[ParameterRegion]:
    """The regions, with those in a row that have the same case in one, where that is short."""
    found: list[ParameterRegion] = []
    for region in _mirrored(regions):
        joined = _joined(found[-1], region) if found else None
        if joined is None:
            found.append(region)
        else:
            found[-1] = joined
    return found


def _joined(last: ParameterRegion, region: ParameterRegion) -> ParameterRegion | None:
    """Two regions in one, where nothing but the same case is said in them."""
    if not last.plain or not region.plain or last.case != region.case:
        return None
    statement = _together(last.statement, region.statement)
    return None if statement is None else replace(last, statement=statement)


def _together(first: Statement, second: Statement) -> Statement | None:
    """That one of the two holds, where they merge or are of one kind and short; else None."""
    merged = first.merged(second)
    if merged is not None:
        return merged
    parts = [*alternatives_of(first), *alternatives_of(second)]
    kinds = {type(part) for part in parts}
    if len(kinds) > 1 or kinds == {Both}:
        return None
    together = either(*parts)
    return together if len(together.text()) <= _LINE else None


def without_implied(statement: Statement) -> Statement:
    """The statement without an equation that follows from the others: g2 = g3 = 0 implies g2^3 = 27 g3^2."""
    if not isinstance(statement, Both):
        return statement
    parts = [*statement.parts]
    for part in statement.parts:
        if isinstance(part, Vanishes) and _follows(part, [other for other in parts if other is not part]):
            parts.remove(part)
    return Both(tuple(parts))


def _follows(statement: Vanishes, others: Iterable[Statement]) -> bool:
    """Does the function provably vanish where those of the others do, two or more?"""
    functions = _vanishing(others)
    if len(functions) < 2:
        return False
    chart = _common_zeros(functions)
    return chart is not None and holds_on(statement, chart, NOTHING_ASSUMED)


def _vanishing(statements: Iterable[Statement]) -> tuple[FunctionPoly, ...]:
    """The functions of those that say that one vanishes."""
    return tuple(statement.function for statement in statements if isinstance(statement, Vanishes))


def without_empty(regions: Sequence[ParameterRegion]) -> list[ParameterRegion]:
    """The regions without those that earlier ones cover, for example because they say the same and more."""
    kept: list[ParameterRegion] = []
    seen: list[set[Any]] = []
    for region in regions:
        check_time()
        said = {str(statement_data(part)) for part in both(region.statement).parts}
        says_more = any(known <= said for known in seen)
        if says_more or _is_covered(region, kept):
            continue
        seen.append(said)
        kept.append(region)
    return kept


def _is_covered(region: ParameterRegion, earlier: Sequence[ParameterRegion]) -> bool:
    """Are its values known, and does at all values of a chart one of the earlier regions' statements hold?"""
    charts = _charts(region.statement)
    if not charts:
        return False
    return all(any(holds_on(other.statement, *chart) for other in earlier) for chart in charts)


class _Chart(NamedTuple):
    """Values of the parameters as functions of others, and what is known of these."""

    values: ParameterPoint
    known: Assumptions


def _charts(statement: Statement) -> list[_Chart]:
    """Values that are all of those at which the statement holds, and maybe more.

    They are functions of fewer parameters, or of one more, an integer k.  [] where none are known.
    """
    functions = _vanishing(both(statement).parts)
    if len(functions) > 1:
        chart = _common_zeros(functions)
        return [] if chart is None else [_Chart(chart, NOTHING_ASSUMED)]
    charts: list[_Chart] = []
    for part in alternatives_of(statement):
        solved = _spectrum(part) if isinstance(part, Congruence) else None
        if not isinstance(part, Congruence) or solved is None:
            return []
        charts += _of_integers(part, solved)
    return charts


def _spectrum(statement: Congruence) -> SolvedCondition | None:
    """An equation for an integer, not a form, solved for a parameter that is nowhere free; None for any other."""
    if statement.form is not None:
        return None
    numbers = Classes(statement.residues, statement.modulus)
    for solved in all_solved(statement.equation):
        if not solved.strata and not possible(solved.poles, numbers):
            return solved
    return None


def _of_integers(statement: Congruence, solved: SolvedCondition) -> list[_Chart]:
    """One parameter as a function of an integer k, which is a new parameter, for each of the classes."""
    f = solved.value
    names = statement.equation.field.names
    letter = next(name for name in map("k{}".format, count()) if name not in names)
    field = FunctionField((*names, letter))
    k = field.generator(letter)
    values = {name: field.generator(name) for name in names}
    in_all = ParameterPoint(names, tuple(values.values()), field)
    above = in_all.at(over_parameters(f.num))
    below = in_all.at(over_parameters(f.den))
    known = Assumptions(((letter, Known(("integer",))),))
    charts = []
    for residue in statement.residues:
        N = k * statement.modulus + residue
        on_class = {**values, solved.parameter: above(N) / below(N)}
        charts.append(_Chart(ParameterPoint(names, tuple(on_class.values()), field), known))
    return charts


@lru_cache(maxsize=256)
def _common_zeros(functions: tuple[FunctionPoly, ...]) -> ParameterPoint | None:
    """Where the functions vanish; None where that isn't one piece."""
    *others, last = functions
    before: ParameterPoint | None = ParameterPoint.generic(last.field)
    if others:
        before = _common_zeros(tuple(others))
    if before is None:
        return None
    try:
        return _zeros_on(before, last)
    except (TypeError, ZeroDivisionError):  # a function on a hypersurface, or one that isn't defined at these values
        return None


def _zeros_on(chart: ParameterPoint, function: FunctionPoly) -> ParameterPoint | None:
    """Where a function vanishes on a chart; None where that isn't one piece."""
    factors = irreducible_factors(chart.at(function))
    if len(factors) != 1:
        return None
    surface = hypersurface(factors[0])
    values = tuple(surface.at(over_parameters(value)) for value in chart.values)
    return ParameterPoint(chart.names, values, surface.field)


@dataclass(frozen=True)
class EquationThere:
    """The equation that was given, on one piece of a region; `zeros` vanish there and not on every piece."""

    equation: Equation
    zeros: tuple[FunctionPoly, ...] = ()


def equations_on(statement: Statement, equation: Equation) -> list[EquationThere]:
    """The equation y'' + p y' + q y = 0 restricted to the pieces of a region, whose formulas have their gauge from it.

    At the zeros that make up a region, poles of b/a can merge or go to infinity, and the gauge for generic values, specialised,
    is another function.  Pieces that aren't given by functions of fewer parameters are left out.
    """
    pieces: list[tuple[FunctionPoly, ...]] = [()]
    for part in both(statement).parts:
        zeros = _vanishing(alternatives_of(part))
        if zeros and len(zeros) == len(alternatives_of(part)):
            pieces = [(*piece, zero) for piece in pieces for zero in zeros]
    found = []
    for piece in pieces:
        there = _restricted(equation, piece)
        if there is not None:
            found.append(EquationThere(there, piece if len(pieces) > 1 else ()))
    return found


def _restricted(equation: Equation, zeros: tuple[FunctionPoly, ...]) -> Equation | None:
    if not zeros:
        return equation
    chart = _common_zeros(zeros)
    return None if chart is None else equation_at(equation, chart)


def normal_form(S: RatFunc, variable: str) -> Equation:
    """y'' - S y = 0."""
    return Equation(a=S * 0 + 1, b=S * 0, c=-S, f=S * 0, variable=variable)


def equation_at(equation: Equation, point: ParameterPoint) -> Equation | None:
    """y'' + p y' + q y = 0 with these values of the parameters; None where p or q isn't defined."""
    try:
        p, q = (point.restricted(with_free_constant(part / equation.a).S) for part in (equation.b, equation.c))
    except ZeroDivisionError:
        return None
    return replace(equation, a=q * 0 + 1, b=p, c=q, f=q * 0, h=None)


def holds_on(statement: Statement, chart: ParameterPoint, known: Assumptions) -> bool:
    """Is it provably true at all of these values?"""
    if isinstance(statement, Both):
        return all(holds_on(part, chart, known) for part in statement.parts)
    if isinstance(statement, Either):
        return any(holds_on(part, chart, known) for part in statement.parts)
    try:
        if isinstance(statement, Vanishes):
            return not chart.at(statement.function)
        if isinstance(statement, Congruence):
            return _congruence_holds_on(statement, chart, known)
    except (ValueError, ZeroDivisionError):  # a function of other parameters, or not defined at these values
        pass
    return False


def _congruence_holds_on(statement: Congruence, chart: ParameterPoint, known: Assumptions) -> bool:
    equation = chart.at(statement.equation)
    for_numbers = statement.holds_for(equation)
    if for_numbers is not None or not known:
        return for_numbers is True
    on_chart = Congruence.make(over_parameters(equation), statement.residues, statement.modulus)
    return on_chart.decided(known) is True

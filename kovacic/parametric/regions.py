"""Regions of parameter space: a statement, what holds where it does and no earlier one, and solutions there."""

from __future__ import annotations

import re
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

from kovacic.algebra.function_field import FunctionPoly
from kovacic.decision import Decision, Status, Structure
from kovacic.errors import LimitExceeded
from kovacic.galois.group import Group
from kovacic.limits import DEFAULT_LIMITS, Budget, Limits
from kovacic.parametric import prose
from kovacic.parametric.natural import Natural
from kovacic.parametric.prose import Words
from kovacic.parametric.solutions import Later, Origin, PolynomialSolution
from kovacic.parametric.statements import Statement

#: Characters of a determinant that are written.
_WRITTEN_OUT = 300


class Limited(str):
    """What isn't proven because a limit of the call ended the search; no larger limit changes any other such sentence."""

    @classmethod
    def by(cls, limit: LimitExceeded) -> Limited:
        return cls(f"only as far as the limits allowed: {limit}")


class Theory(str):
    """By which theorems something is proven, in a sentence; formulas stand between backquotes where it is made."""

    literal: str
    #: The keys of the publications.
    sources: tuple[str, ...]

    def __new__(cls, literal: str, *sources: str) -> Theory:
        self = super().__new__(cls, prose.text_of(prose.phrase(literal)))
        self.literal = literal
        self.sources = sources
        return self

    def also(self, literal: str, *sources: str) -> Theory:
        """With another theorem, each said once."""
        said = self.literal
        return self if said.endswith(literal) else Theory(f"{said}{literal}", *self.sources, *sources)


@dataclass(frozen=True)
class RegionVerdict:
    """What holds in a region of parameters.

    Attributes
    ----------
    structure : Structure or None
        The structure of the group; None without a Liouvillian solution.
    known : bool
        Is anything claimed?
    family : str or None
        More about the group than the structure says, with formulas between backquotes.
    abelian : str or None
        Whether the identity component of a reducible group is abelian, likewise, if more than the structure is known:
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
        said = prose.text_of(self.group_in_words)
        adjective = _ADJECTIVES.get(self.structure) if self.known and self.family is None else None
        return f"{adjective}: {said}" if adjective else said

    @property
    def group_in_words(self) -> Words:
        """The same with its formulas, without the structure."""
        return prose.phrase((self.family or _GROUPS[self.structure]) if self.known else "not determined")

    @property
    def identity_component(self) -> Words:
        """A phrase that says whether the group's identity component is abelian, as integrability needs by Morales and Ramis."""
        said = self.abelian or _COMPONENTS.get(self.structure, ABELIAN)
        return prose.phrase(said if self.known else "not determined")

    def says_the_same(self, other: RegionVerdict) -> bool:
        """True for the same structure, of the same group.

        Parameters
        ----------
        other : RegionVerdict
            That of another region.
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
    """That of a reducible group, by its name and what its identity component is; formulas stand between backquotes."""
    return RegionVerdict(Structure.REDUCIBLE, family=family, abelian=component)


def borel(diagonal: str = "") -> RegionVerdict:
    """That of Borel's group, or G_m where a phrase says so."""
    if not diagonal:
        return reducible("the Borel group", NOT_ABELIAN)
    return reducible(f"the Borel group, or `G_m` where {diagonal}", f"abelian exactly where {diagonal}")


#: What is a formula in the name of a group.
_FORMULA = re.compile(r"\w+_\w+|\w+\(\w\)|\{.*\}")


def verdict_of(decision: Decision, group: Group | None = None) -> RegionVerdict:
    """The verdict of the engine's decision, and the group if it is known."""
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
        True where it is proven that the statement describes all such values and nothing else, else what isn't proven, and the
        verdict isn't known.
    defined : bool
        False where S isn't defined, and the verdict isn't known.
    shown_degree : int or None
        For a statement with a natural number d: `determinants` has those up to this d.
    limits : Limits
        For these.
    origin : callable or None
        What `solution` asks; None if no formula is known.

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
    origin: Origin | Later | None = field(default=None, compare=False)

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
            for d in range(self.shown_degree + 1):
                values = statement.values(d)
                said = [
                    value + f" where {prose.text_of(places)}" * (len(values) > 1 and len(places) > 0)
                    for value, places in values.items()
                ]
                text = "; ".join(said)
                if said:
                    found.append(f"Delta_{d} = {text[:_WRITTEN_OUT]}" + "..." * (len(text) > _WRITTEN_OUT))
                else:
                    found.append(f"{statement.letter} is never {d}")
        return tuple(found)

    @property
    def why_no_solution(self) -> str:
        """A sentence where `solution()` is empty: why there is no formula in all of the parameters; "" where there is one."""
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
        return prose.text_of(prose.phrase(self.verdict.family or "S isn't defined"))

    @property
    def said(self) -> str:
        """The verdict in words: the case, or why none is known."""
        return str(self.verdict) if self.defined else self.group

    @property
    def plain(self) -> bool:
        """True if there is nothing to say but the statement and the case."""
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

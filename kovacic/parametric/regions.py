"""What a partition of parameter space consists of: regions in their order, each with a verdict."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from kovacic.algebra.ratfunc import RatFunc
from kovacic.decision import Structure
from kovacic.limits import Budget
from kovacic.parametric.restriction import Restriction, UndefinedError
from kovacic.parametric.statements import Point, Statement


@dataclass(frozen=True)
class Verdict:
    """The case (None: no Liouvillian solution), the structure, and whether that is known at all.

    `family` says more about the group than the structure does.
    """

    structure: Structure | None
    known: bool = True
    family: str | None = field(default=None, compare=False)

    @property
    def case(self) -> int | None:
        return None if self.structure is None else self.structure.case

    @property
    def group(self) -> str:
        """The family of the Galois group."""
        return (self.family or _GROUPS[self.structure]) if self.known else "not determined"


_GROUPS = {
    Structure.REDUCIBLE: "reducible: a subgroup of the triangular group",
    Structure.IMPRIMITIVE: "imprimitive: dicyclic, or the infinite dihedral group",
    Structure.TETRAHEDRAL: "binary tetrahedral, order 24",
    Structure.OCTAHEDRAL: "binary octahedral, order 48",
    Structure.ICOSAHEDRAL: "binary icosahedral, order 120",
    None: "SL2(C)",
}


@dataclass(frozen=True)
class Region:
    """Where the statement holds, and no earlier region's: one verdict, or a partition of its own.

    `complete` is True where it is proven that the statement describes all such values and nothing else, else a sentence.
    `defined` is False where S itself isn't defined.  `omega` shows what becomes possible.
    """

    statement: Statement
    verdict: Verdict
    complete: bool | str = True
    defined: bool = True
    omega: str | None = None
    inner: Partition | None = None
    restriction: Restriction | None = None


@dataclass(frozen=True)
class Partition:
    """Regions, tried in order; `generic` holds where none of them does, `complete` as for a region."""

    S: RatFunc
    names: tuple[str, ...]
    regions: tuple[Region, ...]
    generic: Verdict
    complete: bool | str
    theory: str

    def locate(self, point: Point) -> tuple[Region | None, Verdict]:
        """The region that contains the point (None: the generic one), and the verdict, `known` or not.

        Raises `UndefinedError` where S isn't defined.
        """
        for region in self.regions:
            if not region.statement.holds(point):
                continue
            if not region.defined:
                raise UndefinedError
            if region.inner is None:
                return region, region.verdict
            inner, verdict = region.inner.locate(point)
            return (region if inner is None else inner), verdict
        return None, self.generic if self.complete is True else replace(self.generic, known=False)


@dataclass(frozen=True)
class Settings:
    """How far to go: where no theorem covers all degrees up to `max_degree` (None: then no search at all)."""

    max_degree: int | None
    budget: Budget
    variable: str = "x"


__all__ = ["Partition", "Region", "Settings", "Verdict"]

"""Exact statements about the parameters: true or false at every point with algebraic coordinates.

Here are the simplest one, a polynomial vanishes, and the combinations; see `integers` for statements about integers, `riemann`
for Schwarz's table, `natural` for determinants.  Nothing here is numerical.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, product
from random import Random
from typing import Self

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.parametric import prose
from kovacic.parametric.assumptions import NOTHING_ASSUMED, Assumptions
from kovacic.parametric.claims import (
    AllOf,
    AnyOf,
    Claim,
    IsZero,
    ParameterPoint,
    Several,
    irreducible_factors,
    on_linear_zeros,
)
from kovacic.writing.formula import text_of_words


@dataclass(frozen=True)
class Setting:
    """The context in which a statement is printed.

    No integer is called like one of the `names`; nothing is solved for one of the `fixed` ones, which are constants; nothing is
    said of the common zeros of functions that are `covered`, because they belong to earlier regions, or that the assumptions
    exclude.
    """

    names: tuple[str, ...] = ()
    fixed: tuple[str, ...] = ()
    covered: tuple[frozenset[FunctionPoly], ...] = ()
    assumptions: Assumptions = NOTHING_ASSUMED

    def covers(self, *zeros: FunctionPoly) -> bool:
        """True if an earlier region contains the common zeros of the functions, or there are none."""
        if any(self.assumptions.vanishes(zero) is False for zero in zeros):
            return True
        common = {*zeros}  # and the same functions as an earlier region writes them, with the values on the other zeros
        for zero in zeros:
            there = on_linear_zeros(zero, zeros)
            factors = irreducible_factors(there) if there else []
            if len(factors) == 1:
                common.update(factors)
        return any(known <= common for known in self.covered)

    def also(self, *zeros: FunctionPoly) -> Self:
        """The setting after the regions of the common zeros of functions, which needn't be examined again."""
        return replace(self, covered=(*self.covered, frozenset(zeros)))

    def on(self, chart: ParameterPoint) -> Self:
        """The setting in the parameters of a chart."""
        values = [[*map(chart.at, zeros)] for zeros in self.covered]
        are_functions = (several for several in values if all(isinstance(one, FunctionPoly) and one for one in several))
        pieces = chain.from_iterable(product(*map(irreducible_factors, several)) for several in are_functions)
        return replace(self, covered=tuple(dict.fromkeys(map(frozenset, pieces))))


class Statement(Claim):
    """A statement about the parameters."""

    @property
    def claim(self) -> Claim:
        """The claim that is printed: the statement itself, unless it is solved for something."""
        return self

    @property
    def conjuncts(self) -> tuple[Statement, ...]:
        """The parts of a `Both`, which hold together, or the statement itself."""
        return (self,)

    @property
    def alternatives(self) -> tuple[Statement, ...]:
        """The parts of an `Either`, of which one has to hold, or the statement itself."""
        return (self,)

    def text(self) -> str:
        return text_of_words(prose.sentence(self.claim))

    def latex(self) -> str:
        """Without dollar signs."""
        return prose.latex_of_claim(self.claim)

    def merged(self, other: Statement) -> Statement | None:
        """One statement that either holds, if both are about the same function; else None."""
        return None

    def under(self, assumptions: Assumptions) -> Statement:
        """The statement reduced by the assumptions: ALWAYS or NEVER if they decide it."""
        return self

    @property
    @abstractmethod
    def equations(self) -> tuple[FunctionPoly, ...]:
        """Functions of which one vanishes where the statement holds, or equations for a number of which one has a root.

        For several statements these are all of their functions.
        """

    @property
    def field(self) -> FunctionField | None:
        """The field of its functions; None for a statement without functions."""
        return next((one.field for one in self.equations), None)

    @abstractmethod
    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        """The statement in other parameters: each of its functions is mapped and factored again."""

    def sample(self, random: Random) -> list[FunctionPoly]:
        """Functions, chosen at random, at whose common zeros the statement holds."""
        return []

    def avoiding(self, setting: Setting) -> Statement:
        """The statement as it is printed in this setting."""
        return self

    def __str__(self) -> str:
        return self.text()


class Vanishes(IsZero, Statement):
    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        return (self.function,)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        changed = change(self.function)
        return either(*map(Vanishes, irreducible_factors(changed))) if changed else ALWAYS

    def sample(self, random: Random) -> list[FunctionPoly]:
        return [self.function]

    def under(self, assumptions: Assumptions) -> Statement:
        return reduced_statement(self, assumptions.vanishes(self.function))


@dataclass(frozen=True)
class _Several(Several, Statement):
    """A combination of statements, `Either` or `Both`."""

    parts: tuple[Statement, ...]

    @property
    def equations(self) -> tuple[FunctionPoly, ...]:
        return tuple(chain.from_iterable(part.equations for part in self.parts))

    @cached_property
    def claim(self) -> Claim:
        kind = AnyOf if self.decisive else AllOf
        return kind(tuple(part.claim for part in self.parts))

    def _of(self, parts: Iterable[Statement]) -> Statement:
        """This connective applied to other parts."""
        return either(*parts) if self.decisive else all_of(parts)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return self._of(part.rewritten(change) for part in self.parts)

    def avoiding(self, setting: Setting) -> Statement:
        return replace(self, parts=tuple(part.avoiding(setting) for part in self.parts))

    def under(self, assumptions: Assumptions) -> Statement:
        return self._of(part.under(assumptions) for part in self.parts)


class Either(_Several, AnyOf):
    @property
    def alternatives(self) -> tuple[Statement, ...]:
        return self.parts

    def sample(self, random: Random) -> list[FunctionPoly]:
        return random.choice(self.parts).sample(random)


class Both(_Several, AllOf):
    @property
    def conjuncts(self) -> tuple[Statement, ...]:
        return self.parts

    def sample(self, random: Random) -> list[FunctionPoly]:
        return list(chain.from_iterable(part.sample(random) for part in self.parts))


def all_of(statements: Iterable[Statement]) -> Statement:
    """The statement that all of them hold, each once."""
    different = dict.fromkeys(chain.from_iterable(one.conjuncts for one in statements))
    if NEVER in different:
        return NEVER
    return next(iter(different)) if len(different) == 1 else Both(tuple(different))


#: The statements that hold everywhere, and nowhere.
ALWAYS = Both(())
NEVER = Either(())


def reduced_statement(statement: Statement, truth: bool | None) -> Statement:
    """ALWAYS or NEVER if the statement is decided, else the statement itself."""
    return {True: ALWAYS, False: NEVER, None: statement}[truth]


def either(*statements: Statement) -> Statement:
    """The statement that at least one of them holds; those about the same function are merged."""
    if ALWAYS in statements:
        return ALWAYS
    merged: list[Statement] = []
    for part in chain.from_iterable(one.alternatives for one in statements):
        for k, known in enumerate(merged):
            union = part if part == known else known.merged(part)
            if union is not None:
                merged[k] = union
                break
        else:
            merged.append(part)
    return merged[0] if len(merged) == 1 else Either(tuple(merged))

"""Exact statements about the parameters: true or false at every point with algebraic coordinates.

Here are the simplest one, a polynomial vanishes, and the combinations; see `integers` for statements about integers, `riemann`
for Schwarz's table, `natural` for determinants.  Nothing here is numerical.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from random import Random
from typing import ClassVar

from kovacic.algebra.function_field import FunctionPoly
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.formulas import equation_written, latex_of, text_of
from kovacic.parametric.functions import ParameterPoint, numerator


class Statement(ABC):
    """A statement about the parameters."""

    def holds(self, point: ParameterPoint) -> bool:
        """Is it true at the point?  Not where a function in it isn't defined."""
        try:
            return self._holds(point)
        except ZeroDivisionError:
            return False

    @abstractmethod
    def _holds(self, point: ParameterPoint) -> bool: ...

    @cached_property
    @abstractmethod
    def written(self) -> str:
        """In words, and formulas between backquotes."""

    def text(self) -> str:
        return text_of(self.written)

    def latex(self) -> str:
        """Without dollar signs."""
        return latex_of(self.written)

    def merged(self, other: Statement) -> Statement | None:
        """Both statements in one (either holds), where they are about the same function; else None."""
        return None

    def decided(self, assumptions: Assumptions) -> bool | None:
        """True or False where that follows from what is known about the parameters; None otherwise."""
        return None

    def narrowed(self, assumptions: Assumptions) -> Statement:
        """What is left to say where the assumptions hold."""
        return self

    @abstractmethod
    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        """The same statement about other parameters: each of its functions is changed."""

    def sample(self, random: Random) -> list[FunctionPoly]:
        """Functions, chosen at random, at whose common zeros the statement holds."""
        return []

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        """The same statement, in which no integer is called like one of the names; the `fixed` ones are constants."""
        return self

    def __str__(self) -> str:
        return self.text()


@dataclass(frozen=True)
class Vanishes(Statement):
    """`function = 0`."""

    function: FunctionPoly

    def _holds(self, point: ParameterPoint) -> bool:
        return not point.at(self.function)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return Vanishes(numerator(change(self.function)))

    def sample(self, random: Random) -> list[FunctionPoly]:
        return [self.function]

    def decided(self, assumptions: Assumptions) -> bool | None:
        return assumptions.vanishes(self.function)

    @cached_property
    def written(self) -> str:
        return f"`{equation_written(self.function)}`"


@dataclass(frozen=True)
class _Several(Statement):
    """A statement made of others: one truth value of a part decides."""

    parts: tuple[Statement, ...]
    decisive: ClassVar[bool]

    def _holds(self, point: ParameterPoint) -> bool:
        return any(part.holds(point) is self.decisive for part in self.parts) is self.decisive

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return replace(self, parts=tuple(part.rewritten(change) for part in self.parts))

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, parts=tuple(part.avoiding(names, fixed) for part in self.parts))

    def decided(self, assumptions: Assumptions) -> bool | None:
        decisions = {part.decided(assumptions) for part in self.parts}
        if self.decisive in decisions:
            return self.decisive
        if None in decisions:
            return None
        return not self.decisive

    def narrowed(self, assumptions: Assumptions) -> Statement:
        """The parts that aren't the case anyway: false ones where one has to hold, true ones where all have to."""
        narrower = [part.narrowed(assumptions) for part in self.parts]
        left = [part for part in narrower if part.decided(assumptions) is not (not self.decisive)]
        if not left:
            return self
        if self.decisive:
            return either(*left)
        return all_of(left)


class Either(_Several):
    """At least one of the statements holds."""

    decisive = True

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return either(*(part.rewritten(change) for part in self.parts))

    def sample(self, random: Random) -> list[FunctionPoly]:
        return random.choice(self.parts).sample(random)

    @cached_property
    def written(self) -> str:
        """A common start "n = " or "E = f(n), ", and a common end, from "for" on, are written once."""
        parts = [part.written for part in self.parts]
        if self.is_about_one_value:
            return _values_of_one(parts)
        together = _with_common_end(parts) or _with_common_start(parts) or _one_of(parts)
        if together:
            return together
        is_long = any(" for " in part or ", " in part for part in parts)
        separator = ", or " if is_long else " or "
        return separator.join(parts)

    @property
    def is_about_one_value(self) -> bool:
        """Is it "n = 0 or -1"?"""
        heads = {part.text().partition(" = ")[0] for part in self.parts}
        return len(heads) == 1 and all(isinstance(part, Vanishes) for part in self.parts)


def _values_of_one(parts: Sequence[str]) -> str:
    """`n = 0, 1` or `2` for `n = 0`, `n = 1`, `n = 2`."""
    head = parts[0].partition(" = ")[0]
    values = [part.partition(" = ")[2].rstrip("`") for part in parts]
    return f"{head} = {', '.join(values[:-1])}` or `{values[-1]}`"


def _with_common_end(parts: Sequence[str]) -> str | None:
    """Where the last "for" is followed by the same in all of them."""
    split = [part.rpartition(" for ") for part in parts]
    ends = {end for _, _, end in split}
    if len(ends) != 1 or not all(separator for _, separator, _ in split):
        return None
    return f"{' or '.join(head for head, _, _ in split)} for {ends.pop()}"


def _with_common_start(parts: Sequence[str]) -> str | None:
    """Where the same stands before the first "with" in all of them."""
    split = [part.partition(" with ") for part in parts]
    heads = {head for head, _, _ in split}
    if len(heads) != 1 or not all(separator for _, separator, _ in split):
        return None
    return f"{heads.pop()} with {' or '.join(end for _, _, end in split)}"


@dataclass(frozen=True)
class _FormulasOfOneKind:
    """Several formulas of which the same is said."""

    formulas: list[str]
    kind: str


def _one_of(parts: Sequence[str]) -> str | None:
    """That one of several formulas is an integer of some kind; None where another thing is said of one of them."""
    known = _of_one_kind(parts, "` is ")
    if known is not None:
        return f"{_listed(known.formulas)} is {known.kind}"
    known = _of_one_kind(parts, " in Z`")
    if known is not None and len(parts) > 2:
        return f"{_listed(known.formulas)} is an integer"
    return None


def _of_one_kind(parts: Sequence[str], separator: str) -> _FormulasOfOneKind | None:
    """The formulas before the separator, and what follows it; None where that differs, or other formulas stand there."""
    formulas: list[str] = []
    kinds: set[str] = set()
    for part in parts:
        formula, found, kind = part.partition(separator)
        has_others = "`" in formula[1:]
        if not found or has_others:
            return None
        formulas.append(formula)
        kinds.add(kind)
    if len(kinds) != 1:
        return None
    return _FormulasOfOneKind(formulas, kinds.pop())


def _listed(formulas: Sequence[str]) -> str:
    """One of `a`, `b` or `c`."""
    *first, last = (formula.strip("`") for formula in formulas)
    listed = ", ".join(f"`{formula}`" for formula in first)
    text = f"{listed} or `{last}`"
    if len(first) > 1:
        return f"one of {text}"
    return text


class Both(_Several):
    """All of the statements hold."""

    decisive = False

    def merged(self, other: Statement) -> Statement | None:
        if not isinstance(other, Both) or other.parts[:-1] != self.parts[:-1]:
            return None
        last = self.parts[-1].merged(other.parts[-1])
        if last is None:
            return None
        return replace(self, parts=(*self.parts[:-1], last))

    def sample(self, random: Random) -> list[FunctionPoly]:
        return list(chain.from_iterable(part.sample(random) for part in self.parts))

    @cached_property
    def written(self) -> str:
        if len(self.parts) == 1:
            return self.parts[0].written
        return ", and ".join(map(_in_conjunction, self.parts))


def _in_conjunction(part: Statement) -> str:
    """Alternatives are in parentheses, unless they are those of one value."""
    if isinstance(part, Either) and not part.is_about_one_value:
        return f"({part.written})"
    return part.written


def both(*statements: Statement) -> Both:
    """One statement that says that all of them hold."""
    parts: list[Statement] = []
    for one in statements:
        if isinstance(one, Both):
            parts += one.parts
        else:
            parts.append(one)
    return Both(tuple(parts))


def all_of(statements: Sequence[Statement]) -> Statement:
    """That all of them hold: the only one itself, if there is one."""
    if len(statements) == 1:
        return statements[0]
    return both(*statements)


#: What is true everywhere, and nowhere.
ALWAYS = Both(())
NEVER = Either(())


def either(*statements: Statement) -> Statement:
    """One statement that says that at least one of them holds; those about one form are merged."""
    merged: list[Statement] = []
    for one in statements:
        for part in alternatives_of(one):
            _add(part, merged)
    if len(merged) == 1:
        return merged[0]
    return Either(tuple(merged))


def alternatives_of(statement: Statement) -> tuple[Statement, ...]:
    """The statements of which one has to hold: the parts of an `Either`, or a statement itself."""
    if isinstance(statement, Either):
        return statement.parts
    return (statement,)


def _add(statement: Statement, alternatives: list[Statement]) -> None:
    """Merged with the first of the alternatives with which that can be, else as a new one."""
    for k, known in enumerate(alternatives):
        union = known.merged(statement)
        if union is not None:
            alternatives[k] = union
            return
    if statement not in alternatives:
        alternatives.append(statement)

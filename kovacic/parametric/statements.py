"""Exact statements about the parameters: true or false at every point with algebraic coordinates.

Here are the simplest one, a polynomial vanishes, and the combinations; see `integers` for statements about integers, `riemann`
for Schwarz's table, `natural` for determinants.  Nothing here is numerical.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from random import Random

from kovacic.algebra.function_field import FunctionPoly
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.formulas import equation_written
from kovacic.parametric.functions import Point, numerator


class Statement(ABC):
    """A statement about the parameters."""

    def holds(self, point: Point) -> bool:
        """Is it true at the point?  Not where a function in it isn't defined."""
        try:
            return self._holds(point)
        except ZeroDivisionError:
            return False

    @abstractmethod
    def _holds(self, point: Point) -> bool: ...

    @abstractmethod
    def written(self, *, latex: bool) -> str:
        """In words and formulas, as text or as LaTeX without dollar signs."""

    def text(self) -> str:
        return self.written(latex=False)

    def latex(self) -> str:
        return self.written(latex=True)

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

    def _holds(self, point: Point) -> bool:
        return not point.at(self.function)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return Vanishes(numerator(change(self.function)))

    def sample(self, random: Random) -> list[FunctionPoly]:
        return [self.function]

    def decided(self, assumptions: Assumptions) -> bool | None:
        return assumptions.vanishes(self.function)

    def written(self, *, latex: bool) -> str:
        return equation_written(self.function, latex=latex)


@dataclass(frozen=True)
class _Several(Statement):
    """A statement made of others."""

    parts: tuple[Statement, ...]

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return replace(self, parts=tuple(part.rewritten(change) for part in self.parts))

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, parts=tuple(part.avoiding(names, fixed) for part in self.parts))

    def narrowed(self, assumptions: Assumptions) -> Statement:
        """The parts that aren't the case anyway: false ones where one has to hold, true ones where all have to."""
        needless = isinstance(self, Both)
        parts = tuple(p.narrowed(assumptions) for p in self.parts if p.decided(assumptions) is not needless)
        return parts[0] if len(parts) == 1 else replace(self, parts=parts) if parts else self


class Either(_Several):
    """At least one of the statements holds."""

    def _holds(self, point: Point) -> bool:
        return any(part.holds(point) for part in self.parts)

    def sample(self, random: Random) -> list[FunctionPoly]:
        return random.choice(self.parts).sample(random)

    def decided(self, assumptions: Assumptions) -> bool | None:
        decisions = {part.decided(assumptions) for part in self.parts}
        return True if True in decisions else None if None in decisions else False

    def written(self, *, latex: bool) -> str:
        word, before = (r" \text{ or } ", r" \text{ for ") if latex else (" or ", " for ")
        texts = [part.written(latex=latex) for part in self.parts]
        if self.is_about_one_value:
            head, values = texts[0].partition(" = ")[0], [text.partition(" = ")[2] for text in texts]
            return f"{head} = {', '.join(values[:-1])}{word}{values[-1]}"
        return joined(texts, word, before)

    @property
    def is_about_one_value(self) -> bool:
        """Is it "n = 0 or -1"?"""
        heads = {part.text().partition(" = ")[0] for part in self.parts}
        return len(heads) == 1 and all(isinstance(part, Vanishes) for part in self.parts)


class Both(_Several):
    """All of the statements hold."""

    def merged(self, other: Statement) -> Statement | None:
        if not isinstance(other, Both) or other.parts[:-1] != self.parts[:-1]:
            return None
        last = self.parts[-1].merged(other.parts[-1])
        return None if last is None else replace(self, parts=(*self.parts[:-1], last))

    def _holds(self, point: Point) -> bool:
        return all(part.holds(point) for part in self.parts)

    def sample(self, random: Random) -> list[FunctionPoly]:
        return [function for part in self.parts for function in part.sample(random)]

    def decided(self, assumptions: Assumptions) -> bool | None:
        decisions = {part.decided(assumptions) for part in self.parts}
        return False if False in decisions else None if None in decisions else True

    def written(self, *, latex: bool) -> str:
        texts = [part.written(latex=latex) for part in self.parts]
        brackets = (r"\left({}\right)" if latex else "({})") if len(texts) > 1 else "{}"
        ambiguous = [isinstance(part, Either) and not part.is_about_one_value for part in self.parts]
        texts = [brackets.format(t) if several else t for several, t in zip(ambiguous, texts, strict=True)]
        return (r" \text{ and } " if latex else ", and ").join(texts)


def joined(texts: list[str], word: str, before: str) -> str:
    """The texts with a word between them; a common start "E = f(n), " and a common end, from `before` on, are written once."""
    heads, separators, ends = zip(*(text.rpartition(before) for text in texts), strict=True)
    if len(set(ends)) == 1 and all(separators):
        return f"{word.join(heads)}{before}{ends[0]}"
    starts = {text.partition(", ")[0] for text in texts}
    if len(starts) == 1 and all(", " in text for text in texts):
        return f"{starts.pop()}, {word.join(text.partition(', ')[2] for text in texts)}"
    return word.join(texts)


def both(*statements: Statement) -> Both:
    """One statement that says that all of them hold."""
    return Both(tuple(part for one in statements for part in (one.parts if isinstance(one, Both) else (one,))))


def either(statements: Sequence[Statement]) -> Statement:
    """One statement that says that at least one of them holds; those about one form are merged."""
    merged: list[Statement] = []
    for statement in statements:
        for k, known in enumerate(merged):
            union = known.merged(statement)
            if union is not None:
                merged[k] = union
                break
        else:
            if statement not in merged:
                merged.append(statement)
    return merged[0] if len(merged) == 1 else Either(tuple(merged))

"""Ring homomorphisms to prime fields: reduction modulo a prime, by which every computation begins.

Which homomorphisms a field has is found in `splitting` and `function_field`; the way back from images is in `lifting`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from flint import nmod_poly

#: Primes from which a property is guessed where only speed depends on it: that an element with square norms is a square
#: (wrong with probability 2^-12), or that a number field splits completely at few primes.
SAMPLE_PRIMES = 12


class BadPrimeError(Exception):
    """The prime divides a denominator, or loses structure that the caller relies on: take another one."""


class Homomorphism:
    """A ring homomorphism from the p-integral elements of a field to F_p, extended to polynomials."""

    __slots__ = ()

    p: int

    @property
    def ground(self) -> Homomorphism:
        """The homomorphism of Q, or of Q(t), that this one extends."""
        return self

    @abstractmethod
    def __call__(self, polynomial: Any) -> Any:
        """The image as an `nmod_poly`.  Raises `BadPrimeError` where a coefficient isn't p-integral."""

    def keeping_degree(self, polynomial: Any) -> Any:
        """The image; `BadPrimeError` if the leading coefficient vanishes."""
        image = self(polynomial)
        if image.degree() != polynomial.degree:
            raise BadPrimeError(f"{self.p} divides a leading coefficient")
        return image


@dataclass(frozen=True, slots=True)
class ExtensionHomomorphism(Homomorphism):
    """K(c) -> F_p: a homomorphism of K and the image of c, a root of c's minimal polynomial modulo p."""

    base: Homomorphism
    root: int

    @property
    def p(self) -> int:  # type: ignore[override]
        return self.base.p

    @property
    def ground(self) -> Homomorphism:
        return self.base.ground

    @property
    def height(self) -> int:
        """The number of extensions in the tower."""
        return self.base.height + 1 if isinstance(self.base, ExtensionHomomorphism) else 1

    def __call__(self, polynomial: Any) -> Any:
        if polynomial.field.height < self.height:
            return self.base(polynomial)
        result = nmod_poly([], self.p)
        for part in reversed(polynomial.parts):
            result = result * self.root + self.base(part)
        return result


class Collector(ABC):
    """Images of polynomials of one shape (how many, and how long), from which their coordinates are guessed."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.shape = shape
        self.primes_used = 0
        self._next_attempt = 1

    @abstractmethod
    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        """Add the images under a homomorphism; a proposal when one is due and there is one, else None."""

    def _divided(self, values: Iterable[Any]) -> list[list[Any]]:
        """A list for each polynomial of the shape."""
        following = iter(values)
        return [list(islice(following, length)) for length in self.shape]

    def _is_due(self) -> bool:
        """Count one more prime; True if a guess is due: after a third more primes than for the last one."""
        self.primes_used += 1
        if self.primes_used < self._next_attempt:
            return False
        self._next_attempt = self.primes_used + 1 + self.primes_used // 3
        return True

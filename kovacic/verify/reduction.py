"""Reduction modulo a prime: the kernel's own ring homomorphisms from a field to F_p, applied to coefficients of polynomials.

Q has one for each prime, Q(t) one for each prime and value of the parameters, and K(c) one for each of K and each simple root
of the polynomial of c.  An element with p in its denominator has no image.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

from flint import nmod_poly

from kovacic.algebra.rationals import RationalPoly


class BadPrimeError(Exception):
    """The prime divides a denominator, or loses what is needed: another one may do."""


class Homomorphism(ABC):
    """To F_p, of the elements of a field that are integral at p."""

    p: int

    @abstractmethod
    def __call__(self, polynomial: Any) -> Any:
        """The polynomial over F_p.  Raises `BadPrimeError` where a coefficient has no image."""

    def keeping_degree(self, polynomial: Any) -> Any:
        """The polynomial over F_p, where it has the same degree; else raises `BadPrimeError`."""
        image = self(polynomial)
        if image.degree() < polynomial.degree:
            raise BadPrimeError("the degree changes")
        return image

    def quotient(self, numerator: Any, denominator: int) -> Any:
        """A polynomial over F_p, divided by the image of an integer."""
        if denominator % self.p == 0:
            raise BadPrimeError("a denominator vanishes")
        return numerator * pow(denominator, -1, self.p)


@dataclass(frozen=True)
class OfRationals(Homomorphism):
    """Q -> F_p."""

    p: int

    def __call__(self, polynomial: Any) -> Any:
        fraction = polynomial.rep
        return self.quotient(nmod_poly(fraction.numer(), self.p), int(fraction.denom()))


@dataclass(frozen=True)
class AtValues(Homomorphism):
    """Q(t1, ..., tk) -> F_p, which gives values to the parameters."""

    p: int
    values: tuple[int, ...]

    def __call__(self, polynomial: Any) -> Any:
        if isinstance(polynomial, RationalPoly):
            return OfRationals(self.p)(polynomial)
        denominator = self._at_values(polynomial.den)
        return self.quotient(self._at_values(polynomial.num), int(denominator[0]))

    def _at_values(self, polynomial: Any) -> Any:
        """A polynomial in x over F_p, from one over Z in x and the parameters."""
        coefficients = [0] * (int(polynomial.degrees()[0]) + 1)
        for (power, *powers), coefficient in polynomial.to_dict().items():
            term = int(coefficient)
            for value, exponent in zip(self.values, powers, strict=True):
                term = term * pow(value, int(exponent), self.p) % self.p
            coefficients[int(power)] += term
        return nmod_poly([coefficient % self.p for coefficient in coefficients], self.p)


@dataclass(frozen=True)
class AtRoot(Homomorphism):
    """K(c) -> F_p: a homomorphism of K, and for c a simple root of the image of its polynomial."""

    base: Homomorphism
    root: int
    level: int

    @property
    def p(self) -> int:  # type: ignore[override]
        return self.base.p

    def __call__(self, polynomial: Any) -> Any:
        if polynomial.field.height < self.level:
            return self.base(polynomial)
        value = nmod_poly([], self.p)
        for part in reversed(polynomial.parts):
            value = value * self.root + self.base(part)
        return value

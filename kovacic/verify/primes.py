"""The kernel's own ring homomorphisms from a field to F_p, applied to coefficients of polynomials, and roots modulo primes.

Q has one for each prime, Q(t) one for each prime and value of the parameters, and K(c) one for each of K and each simple root
of the polynomial of c.  An element with p in its denominator has no image.

A statement modulo one prime proves the one over the field only in one direction (a rank can only drop, a square stays a
square), and for this any prime will do.  So nothing here depends on the choices of the search.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from random import Random
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import RationalPoly

#: The kernel's own primes are taken downwards from here; a record may name any prime below twice this.
_KERNEL_PRIMES_BELOW = 1 << 62
#: Samples (primes, values of x) for a test that each passes by chance with a probability of 1/2 at most.
SAMPLES = 40
#: Values of the parameters that are tried for one prime.
_PARAMETER_POINTS = 64


class BadPrimeError(Exception):
    """The prime divides a denominator, or loses structure that the claim needs: another one may do."""


class Homomorphism:
    """To F_p, of the elements of a field that are integral at p."""

    p: int

    @abstractmethod
    def __call__(self, polynomial: Any) -> Any:
        """The polynomial over F_p.  Raises `BadPrimeError` if a coefficient has no image."""

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
    """K(c) -> F_p: a homomorphism of K, and for c a simple root of the image of its polynomial; `level`, the height of K(c)."""

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


@lru_cache(maxsize=1024)
def kernel_prime(index: int) -> int:
    """The kernel's prime number `index`, counted downwards from 2^62."""
    candidate = _KERNEL_PRIMES_BELOW - 1 if index == 0 else kernel_prime(index - 1) - 2
    while not fmpz(candidate).is_prime():
        candidate -= 2
    return candidate


def is_usable_prime(p: int) -> bool:
    """True for an odd prime number that fits arithmetic in machine words as a modulus."""
    return 2 < p < 2 * _KERNEL_PRIMES_BELOW and bool(fmpz(p).is_prime())


def homomorphisms_modulo(field: Field, p: int, *, points: int = _PARAMETER_POINTS) -> Iterator[Homomorphism]:
    """Homomorphisms of the field's p-integral elements to F_p: of Q the one; of Q(t) values of the parameters at some points.

    Of K(c) those that extend one of K: c goes to a simple root of its minimal polynomial, which keeps its degree.  Such a
    homomorphism belongs to an unramified prime ideal of degree 1 [Dedekind].
    """
    if isinstance(field, AlgebraicField):
        for base in homomorphisms_modulo(field.base, p, points=points):
            for root in roots_modulo(field.modulus, base):
                yield AtRoot(base, root, field.height)
    elif isinstance(field, FunctionField):
        values = Random(p)
        for _ in range(points):
            yield AtValues(p, tuple(values.randrange(p) for _ in field.names))
    else:
        yield OfRationals(p)


def homomorphisms(field: Field) -> Iterator[Homomorphism]:
    """Homomorphisms of the field modulo the kernel's own primes, without end.

    Each prime has one point only: whether a number is a square modulo p is the same at all points.
    """
    for index in count():
        yield from homomorphisms_modulo(field, kernel_prime(index), points=1)


def roots_modulo(polynomial: Poly, h: Homomorphism) -> list[int]:
    """The simple roots of the image of a polynomial, in increasing order; empty if the image loses its degree."""
    try:
        image = h.keeping_degree(polynomial)
    except BadPrimeError:
        return []
    return sorted(int(root) for root, multiplicity in image.roots() if multiplicity == 1)


def translated(polynomial: Any, point: int) -> Any:
    """polynomial(t + point)."""
    return polynomial if point == 0 else polynomial.compose(nmod_poly([point, 1], polynomial.modulus()))

"""From images modulo primes back to rational numbers: Chinese remainders and rational reconstruction.

A field reduces its elements to coordinates modulo p (`Field.coordinates`); these are collected (here for Q, in
`interpolation` and `splitting` for other fields), and the field puts them together again (`Field.assemble`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import count
from typing import Any

from flint import fmpq_poly, fmpz, fmpz_poly, nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Collector, Homomorphism
from kovacic.algebra.poly import Field, Poly
from kovacic.limits import check_time

#: Primes are taken downwards from here: large enough that a bad one is rare, small enough for flint's fast arithmetic.
_PRIMES_BELOW = 1 << 60
#: Bits that a reconstruction, or a reduced vector of a lattice, must leave unused, so that a chance hit is improbable;
#: exactness comes from verification.
UNUSED_BITS = 10


@lru_cache(maxsize=4096)
def prime(index: int) -> int:
    """The index-th prime below 2**60, counted downwards from 0."""
    candidate = _PRIMES_BELOW - 1 if index == 0 else prime(index - 1) - 2
    while not fmpz(candidate).is_prime():
        candidate -= 2
    return candidate


def primes() -> Iterator[int]:
    """The primes below 2**60, downwards."""
    return map(prime, count())


def chinese_remainders(old: Sequence[int], modulus: int, new: Sequence[int], p: int) -> list[int]:
    """The integers below `modulus * p` that are `old` modulo the modulus and `new` modulo p."""
    inverse = pow(modulus, -1, p)
    return [a + modulus * ((b - a) * inverse % p) for a, b in zip(old, new, strict=True)]


def rational_reconstruction(residue: int, modulus: int, bound: int) -> tuple[int, int] | None:
    """`(n, d)` with n = d * residue modulo `modulus`, gcd(n, d) = 1 and |n| d <= bound, the least such d > 0; None without one.

    Where the modulus is much larger than the bound another pair than the sought one is improbable; whether the numerator
    or the denominator is the long one doesn't matter [Monagan, Proc. ISSAC 2004, 243-249].
    """
    # r_i = t_i residue modulo the modulus, for i = 0 and 1 and along Euclid's algorithm.
    r0, r1 = modulus, residue % modulus
    t0, t1 = 0, 1
    # As long as r1 |t1| > bound: nearly always their lengths say so, and long numbers needn't be multiplied.
    while r1 and (r1.bit_length() + t1.bit_length() > bound.bit_length() + 1 or r1 * abs(t1) > bound):
        quotient = r0 // r1
        r0, r1, t0, t1 = r1, r0 - quotient * r1, t1, t0 - quotient * t1
    if not r1 and abs(t1) > 1:
        return None
    return (r1, t1) if t1 > 0 else (-r1, -t1)


class Lifter:
    """Collects images under bundles of homomorphisms and proposes the polynomials over the field.

    Images of different shapes (numbers and lengths of the polynomials) are collected apart, so that bad primes, at which a
    leading term vanishes or a space grows, don't spoil the others.
    """

    def __init__(self, field: Field) -> None:
        self._field = field
        self._collectors: dict[tuple[int, ...], Collector] = {}

    @property
    def primes_used(self) -> int:
        """The number of images that were used."""
        return sum(collector.primes_used for collector in self._collectors.values())

    def add(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Poly] | None:
        """Images of the same polynomials under each homomorphism of the bundle; a proposal when one is due, else None."""
        coordinates = self._field.coordinates(bundle, images)
        shape = tuple(image.length() for image in coordinates)
        if shape not in self._collectors:
            self._collectors[shape] = self._field.collector(shape)
        proposal = self._collectors[shape].add(bundle[0], coordinates)
        return None if proposal is None else self._field.assemble(proposal)


def lifted(field: Field, image: Callable[[Homomorphism], Any], is_right: Callable[[Poly], bool]) -> Poly:
    """The polynomial with these images modulo primes, which is verified; `image` may raise `BadPrimeError`."""
    lifter = Lifter(field)
    for bundle in field.bundles():
        check_time()
        try:
            proposal = lifter.add(bundle, [[image(h)] for h in bundle])
        except BadPrimeError:
            continue
        if proposal is not None and is_right(proposal[0]):
            return proposal[0]
    raise AssertionError("there are infinitely many primes")


def inverse_by_primes(element: Poly, modulus: Poly) -> Any:
    """The inverse modulo a polynomial, from inverses modulo primes: as many as the result needs.

    Euclid's algorithm over a number field works with numbers as large as resultants.
    """
    if element.gcd(modulus).degree > 0:
        raise ZeroDivisionError("not invertible: the polynomials have a common factor")

    def inverse_modulo_prime(h: Homomorphism) -> Any:
        reduced = h.keeping_degree(modulus)
        common, cofactor, _ = h(element).xgcd(reduced)
        if common.degree() > 0:
            raise BadPrimeError("not invertible modulo this prime")
        return cofactor % reduced

    return lifted(element.field, inverse_modulo_prime, lambda inverse: (inverse * element - 1) % modulus == 0)


class Residues(Collector):
    """Rational polynomials modulo the product of the primes so far: the vector of all their coefficients."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        super().__init__(shape)
        self._modulus = 1
        self._residue: Any = fmpz_poly([])

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        p = homomorphism.p
        flat = [c for image in images for c in image.coeffs()]
        if self.primes_used:
            step = (nmod_poly(flat, p) - nmod_poly(self._residue, p)) * pow(self._modulus, -1, p)
            self._residue += _to_integers(step.coeffs()) * self._modulus
        else:
            self._residue = _to_integers(flat)
        self._modulus *= p
        if not self._is_due():
            return None
        residues = [int(c) for c in self._residue.coeffs()]
        vector = reconstruct_vector(residues + [0] * (sum(self.shape) - len(residues)), self._modulus)
        if vector is None:
            return None
        numerators, denominator = vector
        return [fmpq_poly(fmpz_poly(part), denominator) for part in self._divided(numerators)]


def reconstruct_vector(residues: Sequence[int], modulus: int) -> tuple[list[int], int] | None:
    """Integers and one common denominator that give the residues, short enough for no others to be probable; else None."""
    # |n| d below this: among all pairs with a product up to B some B log B residues are hit by chance.
    bound = modulus >> (UNUSED_BITS + modulus.bit_length().bit_length())
    denominator = 1
    for residue in reversed(residues):
        value = residue * denominator % modulus
        if min(value, modulus - value) * denominator > bound:
            fraction = rational_reconstruction(value, modulus, bound // denominator)
            if fraction is None:
                return None
            denominator *= fraction[1]
    numerators = []
    for residue in residues:
        value = residue * denominator % modulus
        if value > modulus >> 1:
            value -= modulus
        if abs(value) * denominator > bound:
            return None
        numerators.append(value)
    return numerators, denominator


def _to_integers(residues: Sequence[Any]) -> Any:
    return fmpz_poly([int(c) for c in residues])

"""From images modulo primes back to rational numbers: Chinese remainders and rational reconstruction.

One lifter serves every number field: a field reduces its elements to rational coordinates modulo p
(`Field.coordinates`), the coordinates are lifted here, and the field puts them together again (`Field.assemble`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from math import isqrt
from typing import Any

from flint import fmpq_poly, fmpz, fmpz_poly, nmod_poly

#: Primes are taken downwards from here: large enough that a bad one is rare, small enough for flint's fast arithmetic.
_LARGEST = 1 << 60
#: Bits that a reconstruction must leave unused, so that a chance hit is improbable; exactness comes from verification.
_SLACK_BITS = 10


@lru_cache(maxsize=4096)
def prime(index: int) -> int:
    """The index-th prime below 2**60, counted downwards from 0."""
    candidate = _LARGEST - 1 if index == 0 else prime(index - 1) - 2
    while not fmpz(candidate).is_prime():
        candidate -= 2
    return candidate


def primes() -> Iterator[int]:
    """The primes below 2**60, downwards."""
    index = 0
    while True:
        yield prime(index)
        index += 1


def rational_reconstruction(residue: int, modulus: int, bound: int) -> tuple[int, int] | None:
    """`(n, d)` with n = d * residue modulo `modulus`, |n| <= bound and 0 < d <= bound, gcd(n, d) = 1; None without one.

    Unique when 2 * bound**2 < modulus [von zur Gathen & Gerhard, Modern Computer Algebra, Thm 5.26].
    """
    r0, r1, t0, t1 = modulus, residue % modulus, 0, 1
    while r1 > bound:
        quotient = r0 // r1
        r0, r1, t0, t1 = r1, r0 - quotient * r1, t1, t0 - quotient * t1
    if t1 == 0 or abs(t1) > bound:
        return None
    return (r1, t1) if t1 > 0 else (-r1, -t1)


class RationalLifter:
    """Collects images of a vector of rational polynomials modulo primes, and proposes the vector."""

    __slots__ = ("_lengths", "_modulus", "_next_attempt", "_residue", "primes_used")

    def __init__(self) -> None:
        self._modulus = 1
        self._residue: Any = None
        self._lengths: list[int] = []
        self._next_attempt = 1
        self.primes_used = 0

    def add(self, p: int, images: Sequence[Any]) -> list[Any] | None:
        """Add the images modulo p; a proposal (a list of fmpq_poly) when one is due and there is one, else None.

        Images of another shape than before (other degrees) show that one of the primes was bad: the larger vector wins,
        because a reduction can only lose leading terms.
        """
        lengths = [image.length() for image in images]
        if lengths != self._lengths:
            if self._lengths and sum(lengths) < sum(self._lengths):
                return None
            self.__init__()  # type: ignore[misc]
            self._lengths = lengths
        flat: list[Any] = []
        for image in images:
            flat.extend(image.coeffs())
        new = nmod_poly(flat, p)
        if self._residue is None:
            self._residue = _to_integers(new)
        else:
            step = (new - nmod_poly(self._residue, p)) * pow(self._modulus, -1, p)
            self._residue += _to_integers(step) * self._modulus
        self._modulus *= p
        self.primes_used += 1
        if self.primes_used < self._next_attempt:
            return None
        self._next_attempt = self.primes_used + 1 + self.primes_used // 3
        return self._reconstruct()

    def _reconstruct(self) -> list[Any] | None:
        """The vector over one common denominator, or None as long as the modulus is too small for it."""
        modulus, total = self._modulus, sum(self._lengths)
        bound = isqrt(modulus >> (_SLACK_BITS + 1))
        denominator = 1
        residues = [int(c) for c in self._residue.coeffs()]
        residues += [0] * (total - len(residues))
        for residue in reversed(residues):
            value = residue * denominator % modulus
            if value > bound and modulus - value > bound:
                fraction = rational_reconstruction(value, modulus, bound)
                if fraction is None or denominator * fraction[1] > bound:
                    return None
                denominator *= fraction[1]
        numerators: list[int] = []
        for residue in residues:
            value = residue * denominator % modulus
            if value > modulus >> 1:
                value -= modulus
            if abs(value) > bound:
                return None
            numerators.append(value)
        polynomials, start = [], 0
        for length in self._lengths:
            polynomials.append(fmpq_poly(fmpz_poly(numerators[start : start + length]), denominator))
            start += length
        return polynomials


def _to_integers(polynomial: Any) -> Any:
    return fmpz_poly([int(c) for c in polynomial.coeffs()])

"""Elements of a number field from their images under one homomorphism a prime, by lattice reduction.

Where primes that split completely are rare, an element a = (v_0 + v_1 c + ... )/d is found from its image modulo prime ideals
of degree 1: the integer vectors (d, v) with sum v_j c^j = d a modulo the product M of the ideals form a lattice of
determinant M, in which the vector of a small element is the shortest one [Lenstra, Lenstra & Lovasz 1982].
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from typing import Any

from flint import fmpq, fmpq_poly, fmpz_mat

from kovacic.algebra.lifting import chinese_remainders
from kovacic.algebra.poly import Collector, Homomorphism
from kovacic.algebra.splitting import ExtensionHomomorphism

#: Bits that a reduced vector must leave unused, so that a chance hit is improbable; exactness comes from verification.
_SLACK_BITS = 12


class Ideals(Collector):
    """Polynomials over Q(c) modulo the product of the prime ideals so far; proposed as n rational coordinates each."""

    __slots__ = ("_dimension", "_modulus", "_next_attempt", "_values", "primes_used", "shape")

    def __init__(self, dimension: int, shape: tuple[int, ...]) -> None:
        self._dimension, self.shape = dimension, shape
        self.primes_used = 0
        self._modulus = 1
        self._values = [0] * (1 + sum(shape))  # the image of c, and those of all coefficients
        self._next_attempt = 1

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        while isinstance(homomorphism, ExtensionHomomorphism) and isinstance(homomorphism.base, ExtensionHomomorphism):
            homomorphism = homomorphism.base
        if not isinstance(homomorphism, ExtensionHomomorphism):
            raise TypeError("a homomorphism of the number field is expected")
        values = [homomorphism.root, *(int(c) for image in images for c in image.coeffs())]
        self._values = chinese_remainders(self._values, self._modulus, values, homomorphism.p)
        self._modulus *= homomorphism.p
        self.primes_used += 1
        if self.primes_used < self._next_attempt:
            return None
        self._next_attempt = self.primes_used + 1 + self.primes_used // 3
        return self._proposal()

    def _proposal(self) -> list[Any] | None:
        root, *values = self._values
        powers = [pow(root, k, self._modulus) for k in range(self._dimension)]
        elements: list[list[Any]] = []
        for value in values:
            coordinates = self._element(value, powers)
            if coordinates is None:
                return None
            elements.append(coordinates)
        following = iter(elements)
        blocks = [list(islice(following, length)) for length in self.shape]
        return [fmpq_poly([row[j] for row in block]) for block in blocks for j in range(self._dimension)]

    def _element(self, value: int, powers: list[int]) -> list[Any] | None:
        """The coordinates of the element with this image, or None as long as the modulus is too small for it."""
        n = len(powers)
        if value == 0:
            return [fmpq(0)] * n
        rows = [[0, self._modulus, *[0] * (n - 1)], [1, value, *[0] * (n - 1)]]
        for j in range(1, n):
            row = [0, -powers[j], *[0] * (n - 1)]
            row[1 + j] = 1
            rows.append(row)
        reduced = fmpz_mat(rows).lll()
        shortest = min(
            ([int(reduced[i, k]) for k in range(n + 1)] for i in range(n + 1)), key=lambda v: sum(c * c for c in v)
        )
        size = max(abs(c) for c in shortest).bit_length()
        if shortest[0] == 0 or (n + 1) * size + _SLACK_BITS > self._modulus.bit_length():
            return None
        return [fmpq(c, shortest[0]) for c in shortest[1:]]

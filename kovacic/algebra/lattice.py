"""Elements of a number field from their images under one homomorphism a prime, by lattice reduction.

Where primes that split completely are rare, an element a = (v_0 + v_1 c + ... )/d is found from its image modulo prime ideals
of degree 1: the integer vectors (d, v) with sum v_j c^j = d a modulo the product M of the ideals form a lattice of
determinant M, in which the vector of a small element is the shortest one [Lenstra, Lenstra & Lovasz 1982].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_poly, fmpz_mat

from kovacic.algebra.extension import ExtensionHomomorphism, ExtensionPoly
from kovacic.algebra.fields import CoordinateLifter, Homomorphism
from kovacic.algebra.poly import Poly
from kovacic.algebra.rational_poly import RationalPoly

if TYPE_CHECKING:
    from kovacic.algebra.extension import AlgebraicField

#: Bits that a reduced vector must leave unused, so that a chance hit is improbable; exactness comes from verification.
_SLACK_BITS = 12


class LatticeLifter(CoordinateLifter):
    """Collects images of a vector of polynomials over Q(c), and proposes the vector."""

    __slots__ = ("_field", "_states")

    def __init__(self, field: AlgebraicField) -> None:
        self._field = field
        self._states: dict[tuple[int, ...], _Images] = {}

    @property
    def primes_used(self) -> int:
        return sum(state.primes_used for state in self._states.values())

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        while isinstance(homomorphism, ExtensionHomomorphism) and isinstance(homomorphism.base, ExtensionHomomorphism):
            homomorphism = homomorphism.base
        if not isinstance(homomorphism, ExtensionHomomorphism):
            raise TypeError("a homomorphism of the number field is expected")
        shape = tuple(image.length() for image in images)
        state = self._states.setdefault(shape, _Images(self._field, shape))
        return state.add(homomorphism.p, homomorphism.root, [int(c) for image in images for c in image.coeffs()])


class _Images:
    """The images of one shape modulo the product of the primes so far."""

    def __init__(self, field: AlgebraicField, shape: tuple[int, ...]) -> None:
        self.field, self.shape = field, shape
        self.primes_used = 0
        self.modulus, self.root = 1, 0
        self.values = [0] * sum(shape)
        self._next_attempt = 1

    def add(self, p: int, root: int, values: list[int]) -> list[Poly] | None:
        inverse = pow(self.modulus, -1, p)

        def combined(old: int, new: int) -> int:
            return old + self.modulus * ((new - old) * inverse % p)

        self.root = combined(self.root, root)
        self.values = [combined(old, new) for old, new in zip(self.values, values, strict=True)]
        self.modulus *= p
        self.primes_used += 1
        if self.primes_used < self._next_attempt:
            return None
        self._next_attempt = self.primes_used + 1 + self.primes_used // 3
        return self._proposal()

    def _proposal(self) -> list[Poly] | None:
        n = self.field.dimension
        powers = [1]
        for _ in range(n - 1):
            powers.append(powers[-1] * self.root % self.modulus)
        elements: list[list[Any]] = []
        for value in self.values:
            coordinates = self._element(value, powers)
            if coordinates is None:
                return None
            elements.append(coordinates)
        result: list[Poly] = []
        start = 0
        for length in self.shape:
            block = elements[start : start + length]
            parts = [RationalPoly(fmpq_poly([row[j] for row in block])) for j in range(n)]
            result.append(ExtensionPoly.make(self.field, parts))
            start += length
        return result

    def _element(self, value: int, powers: list[int]) -> list[Any] | None:
        """The coordinates of the element with this image, or None as long as the modulus is too small for it."""
        n = len(powers)
        if value == 0:
            return [fmpq(0)] * n
        rows = [[0, self.modulus, *[0] * (n - 1)], [1, value, *[0] * (n - 1)]]
        for j in range(1, n):
            row = [0, -powers[j], *[0] * (n - 1)]
            row[1 + j] = 1
            rows.append(row)
        reduced = fmpz_mat(rows).lll()
        shortest = min(
            ([int(reduced[i, k]) for k in range(n + 1)] for i in range(n + 1)), key=lambda v: sum(c * c for c in v)
        )
        size = max(abs(c) for c in shortest).bit_length()
        if shortest[0] == 0 or (n + 1) * size + _SLACK_BITS > self.modulus.bit_length():
            return None
        return [fmpq(c, shortest[0]) for c in shortest[1:]]

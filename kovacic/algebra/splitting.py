"""The primes at which an extension K(c) splits: homomorphisms to F_p, and coordinates from their images.

A homomorphism of K(c) to F_p is one of K and a root of c's minimal polynomial modulo p.  Where the minimal polynomial splits
completely, the images under all roots determine an element modulo p.  In a number field of a large degree such primes are
rare; then one root for each prime has to do, and lattice reduction finds the way back: `Ideals`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache, lru_cache
from itertools import count, islice
from typing import Any

from flint import fmpq, fmpq_poly, fmpz_mat, nmod_mat, nmod_poly

from kovacic.algebra.homomorphism import SAMPLE_PRIMES, BadPrimeError, Collector, ExtensionHomomorphism, Homomorphism
from kovacic.algebra.lifting import UNUSED_BITS, chinese_remainders, primes
from kovacic.algebra.modular import simple_roots
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ, RationalHomomorphism
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time

#: Homomorphisms at one prime that are taken together: 2^(1/12)/(x^2 - 1)^2 with 12 of them was undecided after minutes.
_MOST_AT_ONCE = 6
#: Primes that are tried where a number field of a large degree has parameters.
_MOST_PRIMES = 20000


def number_field_homomorphisms(field: Any, p: int) -> Iterator[Homomorphism]:
    """All homomorphisms of a number field to F_p, unramified: simple roots of minimal polynomials that keep their degrees."""
    if field == QQ:
        yield RationalHomomorphism(p)
    elif field.ground == QQ:
        for base in number_field_homomorphisms(field.base, p):
            try:
                roots = simple_roots(base.keeping_degree(field.modulus))
            except BadPrimeError:
                continue
            yield from (ExtensionHomomorphism(base, root) for root in roots)


@lru_cache(maxsize=64)
def splits_rarely(base: Field, modulus: Poly) -> bool:
    """True for a number field of a large degree, or one in which none of the first primes splits completely.

    A square root that is adjoined to a field of degree n splits over all of its homomorphisms at one prime in 2^n.
    """
    is_small = modulus.degree <= _MOST_AT_ONCE
    return base == QQ and not (is_small and any(_splits(modulus, p) for p in islice(primes(), SAMPLE_PRIMES)))


def _splits(modulus: Poly, p: int) -> bool:
    """True if a polynomial over Q has as many roots modulo p as its degree says."""
    try:
        return len(RationalHomomorphism(p).keeping_degree(modulus).roots()) == modulus.degree
    except BadPrimeError:
        return False


def bundles(
    base: Field, modulus: Poly, allowed: Callable[[int], bool] | None = None
) -> Iterator[tuple[ExtensionHomomorphism, ...]]:
    """All homomorphisms over each prime that splits completely; one over each with a simple root where those are rare."""
    needed = 1 if splits_rarely(base, modulus) else modulus.degree
    values = [base.rational_value(c) for c in modulus]
    if base.ground != QQ and None not in values:
        # c lies over Q while there are parameters: then the prime decides about splitting, not the point.
        allowed = _splitting(QQ.poly([v for v in values if v is not None]), allowed)
    for bundle in base.bundles(allowed):
        check_time()
        if found := _extended(bundle, modulus, needed):
            yield found


@lru_cache(maxsize=4096)  # every computation in a field begins with the same primes
def _extended(bundle: tuple[Homomorphism, ...], modulus: Poly, needed: int) -> tuple[ExtensionHomomorphism, ...]:
    """The homomorphisms of K(c) over these of K: to as many simple roots of the modulus; empty if there are fewer."""
    # The roots over one homomorphism of K stay together: `coordinates` takes them in blocks of n.
    found: list[ExtensionHomomorphism] = []
    for h in bundle:
        try:
            roots = list(islice(simple_roots(h.keeping_degree(modulus)), needed))
        except BadPrimeError:
            return ()
        if len(roots) < needed:
            return ()
        found += [ExtensionHomomorphism(h, root) for root in roots]
    return tuple(found)


def _splitting(modulus: Poly, allowed: Callable[[int], bool] | None) -> Callable[[int], bool]:
    """The predicate of primes that are allowed and at which a polynomial over Q splits completely.

    Raises `LimitExceeded` after many primes: one in 12! does so for a general polynomial of degree 12.
    """
    tried = count(1)

    @cache
    def splits(p: int) -> bool:
        check_time()
        if next(tried) > _MOST_PRIMES:
            raise LimitExceeded(f"{modulus} splits completely for too few primes", limit="work")
        return _splits(modulus, p) and (allowed is None or allowed(p))

    return splits


def coordinates(
    bundle: Sequence[Any], images: Sequence[Sequence[Any]], n: int
) -> tuple[list[Homomorphism], list[list[Any]]]:
    """A bundle of the base field, and the images under it of the n coordinates of each element."""
    base_bundle = list[Homomorphism]()
    base_images = list[list[Any]]()
    p = bundle[0].p
    for start in range(0, len(bundle), n):
        block = bundle[start : start + n]
        # The images at the roots r_i are sum_k c_k r_i^k: Vandermonde's matrix takes the coordinates c_k to them.
        inverse = nmod_mat(n, n, [pow(h.root, k, p) for h in block for k in range(n)], p).inv().tolist()
        base_bundle.append(block[0].base)
        columns = list(zip(*images[start : start + n], strict=True))
        base_images.append(
            [sum((column[j] * row[j] for j in range(n)), nmod_poly([], p)) for column in columns for row in inverse]
        )
    return base_bundle, base_images


class Ideals(Collector):
    """Polynomials over Q(c) modulo the product M of prime ideals of degree 1; proposed as n rational coordinates each.

    The integer vectors (d, v) with sum v_j c^j = d a modulo M form a lattice of determinant M, in which that of a small
    element a = (v_0 + v_1 c + ...)/d is the shortest one [Lenstra, Lenstra & Lovasz 1982].
    """

    def __init__(self, dimension: int, shape: tuple[int, ...]) -> None:
        super().__init__(shape)
        self._dimension = dimension
        self._modulus = 1
        self._values = [0] * (1 + sum(shape))  # the image of c, and those of all coefficients

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        while isinstance(homomorphism, ExtensionHomomorphism) and isinstance(homomorphism.base, ExtensionHomomorphism):
            homomorphism = homomorphism.base
        if not isinstance(homomorphism, ExtensionHomomorphism):
            raise TypeError("a homomorphism of the number field is expected")
        values = [homomorphism.root, *(int(c) for image in images for c in image.coeffs())]
        self._values = chinese_remainders(self._values, self._modulus, values, homomorphism.p)
        self._modulus *= homomorphism.p
        if not self._is_due():
            return None
        root, *values = self._values
        powers = [pow(root, k, self._modulus) for k in range(self._dimension)]
        elements: list[list[Any]] = []
        for value in values:
            coordinates = self._element(value, powers)
            if coordinates is None:
                return None
            elements.append(coordinates)
        return [
            fmpq_poly([row[j] for row in block]) for block in self._divided(elements) for j in range(self._dimension)
        ]

    def _element(self, value: int, powers: list[int]) -> list[Any] | None:
        """The coordinates of the element with this image, or None as long as the modulus is too small for it."""
        n = len(powers)
        if value == 0:
            return [fmpq(0)] * n
        # Rows (d, v_0, ..., v_(n-1)) generate the lattice: (0, M), (1, a), and -c^j + c^j = 0 for j > 0.
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
        if shortest[0] == 0 or (n + 1) * size + UNUSED_BITS > self._modulus.bit_length():
            return None
        return [fmpq(c, shortest[0]) for c in shortest[1:]]

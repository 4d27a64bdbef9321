"""Simple algebraic extensions K(c) of a field, and polynomials over them.

A polynomial over K(c) is the tuple of its coordinates with respect to 1, c, c**2, ...; a homomorphism to F_p is one of K and
a root of c's minimal polynomial modulo p.  Extensions of extensions are towers of these.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache
from itertools import islice
from typing import Any

from flint import fmpq, nmod_poly

from kovacic.algebra.fields import QQ, BadPrimeError, CoordinateLifter, Field, Homomorphism, RationalHomomorphism
from kovacic.algebra.lifting import primes
from kovacic.algebra.poly import Poly, Scalar


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
        """How many extensions the tower has."""
        return self.base.height + 1 if isinstance(self.base, ExtensionHomomorphism) else 1

    def __call__(self, polynomial: Poly) -> Any:
        if not isinstance(polynomial, ExtensionPoly) or polynomial.field.height < self.height:
            return self.base(polynomial)
        result = nmod_poly([], self.p)
        for part in reversed(polynomial.parts):
            result = result * self.root + self.base(part)
        return result


@dataclass(frozen=True, slots=True)
class AlgebraicField(Field):
    """K(c), c a root of the monic irreducible `modulus` over K; `name` is what c is called in print.

    `approximation` says which complex root c is, by real and imaginary part; None where any root will do.  Exact arithmetic
    doesn't depend on it, nor does equality.
    """

    base: Field
    modulus: Poly
    name: str = "c"
    approximation: tuple[Fraction, Fraction] | None = dataclasses.field(default=None, compare=False)

    @property
    def dimension(self) -> int:
        return self.modulus.degree

    @property
    def height(self) -> int:
        """How many extensions the tower has."""
        return self.base.height + 1 if isinstance(self.base, AlgebraicField) else 1

    @property
    def ground(self) -> Field:
        return self.base.ground

    @property
    def lifting_field(self) -> Field:
        return self if _splits_rarely(self) else self.base.lifting_field

    def coordinate_lifter(self) -> CoordinateLifter:
        from kovacic.algebra.lattice import LatticeLifter

        return LatticeLifter(self)

    @property
    def absolute_degree(self) -> int:
        return self.dimension * self.base.absolute_degree

    @property
    def generator(self) -> ExtensionPoly:
        """The constant c."""
        zero, one = self.base.poly([]), self.base.poly([1])
        return ExtensionPoly.make(self, [zero, one, *[zero] * (self.dimension - 2)])

    def poly(self, coefficients: Iterable[Scalar | Poly]) -> ExtensionPoly:
        parts: list[list[Scalar | Poly]] = [[] for _ in range(self.dimension)]
        for coefficient in coefficients:
            if isinstance(coefficient, ExtensionPoly) and coefficient.field == self:
                for target, part in zip(parts, coefficient.parts, strict=True):
                    target.append(part)
            else:
                parts[0].append(coefficient)
                for target in parts[1:]:
                    target.append(0)
        return ExtensionPoly.make(self, [self.base.poly(part) for part in parts])

    def extends(self, other: Field) -> bool:
        return self.base == other or self.base.extends(other)

    def embed(self, polynomial: Poly) -> Poly:
        if polynomial.field != self.base:
            polynomial = self.base.embed(polynomial)
        zero = self.base.poly([])
        return ExtensionPoly.make(self, [polynomial, *[zero] * (self.dimension - 1)])

    def factor(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        from kovacic.algebra.norms import factor_over_extension

        return factor_over_extension(self, polynomial)

    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        return iter(_splitting_bundles(self)) if allowed is None else self.splitting_bundles(allowed)

    def splitting_bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        """The bundles over primes that split completely, or one root for each prime that has any, one after the other."""
        complete = not _splits_rarely(self)
        base_bundles = self.base.bundles(self._splitting(allowed) if self._is_numerical else allowed)
        for base_bundle in base_bundles:
            homomorphisms: list[Homomorphism] = []
            try:
                for base in base_bundle:
                    roots = base.keeping_degree(self.modulus).roots()
                    if not complete:
                        roots = [pair for pair in roots if pair[1] == 1]
                        roots = sorted(roots, key=lambda pair: int(pair[0]))[:1]
                    if len(roots) < (self.dimension if complete else 1):
                        break
                    homomorphisms += [ExtensionHomomorphism(base, root) for root in sorted(int(r) for r, _ in roots)]
                else:
                    yield tuple(homomorphisms)
            except BadPrimeError:
                continue

    @property
    def _is_numerical(self) -> bool:
        """Does c lie over Q while there are parameters?  Then the prime decides about splitting, not the point."""
        return self.ground != QQ and all(self.base.rational_value(c) is not None for c in self.modulus)

    def _splitting(self, allowed: Callable[[int], bool] | None) -> Callable[[int], bool]:
        values = [self.base.rational_value(c) for c in self.modulus]
        modulus = QQ.poly([v for v in values if v is not None])

        @cache
        def splits(p: int) -> bool:
            try:
                roots = RationalHomomorphism(p).keeping_degree(modulus).roots()
            except BadPrimeError:
                return False
            return len(roots) == self.dimension and (allowed is None or allowed(p))

        return splits

    def coordinates(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Any]:
        if _splits_rarely(self):
            return list(images[0])
        n, p = self.dimension, bundle[0].p
        base_bundle: list[Homomorphism] = []
        base_images: list[list[Any]] = []
        for start in range(0, len(bundle), n):
            block = bundle[start : start + n]
            inverse = _vandermonde_inverse([h.root for h in block], p)  # type: ignore[attr-defined]
            base_bundle.append(block[0].base)  # type: ignore[attr-defined]
            base_images.append(
                [
                    sum((column[j] * row[j] for j in range(n)), nmod_poly([], p))
                    for column in zip(*images[start : start + n], strict=True)
                    for row in inverse
                ]
            )
        return self.base.coordinates(base_bundle, base_images)

    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        if _splits_rarely(self):
            return list(coordinates)
        parts, n = self.base.assemble(coordinates), self.dimension
        return [ExtensionPoly.make(self, parts[i : i + n]) for i in range(0, len(parts), n)]

    def rational_value(self, constant: Poly) -> Fraction | None:
        if not isinstance(constant, ExtensionPoly) or constant.field != self:
            return self.base.rational_value(constant)
        return None if any(constant.parts[1:]) else self.base.rational_value(constant.parts[0])

    def sqrt(self, constant: Poly) -> Poly | None:
        value = constant if isinstance(constant, ExtensionPoly) and constant.field == self else self.poly([constant])
        if not any(value.parts[1:]):
            # A square root of an element of K has degree 1 or 2 over K; sqrt(v) = a + b sqrt(d) leaves a = 0 or b = 0.
            root = self.base.sqrt(value.parts[0])
            if root is not None or self.dimension % 2:
                return None if root is None else self.embed(root)
            if self.dimension == 2:
                middle = self.generator + self.modulus[1] / 2
                square = self.modulus[1] * self.modulus[1] / 4 - self.modulus[0]
                root = self.base.sqrt(value.parts[0] / square)
                return None if root is None else middle * root
        for factor, _ in self.factor(self.poly([-constant, 0, 1])):
            if factor.degree == 1:
                return -factor[0]
        return None

    def __str__(self) -> str:
        return f"{self.base}({self.name})"


class _Remembered:
    """A sequence that remembers what an iterator gave, so that primes are searched once for each field."""

    def __init__(self, source: Iterator[tuple[Homomorphism, ...]]) -> None:
        self._source = source
        self._known: list[tuple[Homomorphism, ...]] = []

    def __iter__(self) -> Iterator[tuple[Homomorphism, ...]]:
        position = 0
        while True:
            if position == len(self._known):
                self._known.append(next(self._source))
            yield self._known[position]
            position += 1


#: From this degree on a number field may have too few primes that split completely; so many primes are tried.
_LARGE_DEGREE, _TRIED_PRIMES = 4, 12


@lru_cache(maxsize=64)
def _splits_rarely(field: AlgebraicField) -> bool:
    """Does none of the first primes split completely in a number field of a large degree?"""
    if field.base != QQ or field.dimension < _LARGE_DEGREE:
        return False
    for p in islice(primes(), _TRIED_PRIMES):
        try:
            if len(RationalHomomorphism(p).keeping_degree(field.modulus).roots()) == field.dimension:
                return False
        except BadPrimeError:
            continue
    return True


@lru_cache(maxsize=64)
def _splitting_bundles(field: AlgebraicField) -> _Remembered:
    return _Remembered(field.splitting_bundles())


def _vandermonde_inverse(nodes: Sequence[int], p: int) -> list[list[int]]:
    """Row i, column j: the coefficient of X^i in the j-th Lagrange polynomial of the nodes."""
    columns = []
    for j, node in enumerate(nodes):
        basis, scale = nmod_poly([1], p), 1
        for k, other in enumerate(nodes):
            if k != j:
                basis = basis * nmod_poly([-other % p, 1], p)
                scale = scale * (node - other) % p
        basis = basis * pow(scale, -1, p)
        columns.append([int(basis[i]) for i in range(len(nodes))])
    return [list(row) for row in zip(*columns, strict=True)]


class ExtensionPoly(Poly):
    """A polynomial over K(c): the tuple of its coordinates with respect to 1, c, c**2, ..., polynomials over K."""

    __slots__ = ("_field", "parts")

    _field: AlgebraicField
    parts: tuple[Poly, ...]

    def __init__(self, field: AlgebraicField, parts: tuple[Poly, ...]) -> None:
        object.__setattr__(self, "_field", field)
        object.__setattr__(self, "parts", parts)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("polynomials are immutable")

    @classmethod
    def make(cls, field: AlgebraicField, parts: Sequence[Poly]) -> ExtensionPoly:
        return cls(field, tuple(parts))

    def __reduce__(self) -> tuple[Any, ...]:
        return ExtensionPoly, (self._field, self.parts)

    def key(self) -> tuple[Any, ...]:
        return tuple(part.key() for part in self.parts)

    def leaves(self) -> list[Poly]:
        return [leaf for part in self.parts for leaf in part.leaves()]

    @property
    def field(self) -> AlgebraicField:
        return self._field

    @property
    def degree(self) -> int:
        return max(part.degree for part in self.parts)

    def __getitem__(self, power: int) -> ExtensionPoly:
        return ExtensionPoly(self._field, tuple(part[power] for part in self.parts))

    def __neg__(self) -> ExtensionPoly:
        return ExtensionPoly(self._field, tuple(-part for part in self.parts))

    def _add(self, other: ExtensionPoly) -> ExtensionPoly:
        return ExtensionPoly(self._field, tuple(a + b for a, b in zip(self.parts, other.parts, strict=True)))

    def _mul(self, other: ExtensionPoly) -> ExtensionPoly:
        n, modulus = self._field.dimension, self._field.modulus
        products: list[Poly] = [self._field.base.poly([])] * (2 * n - 1)
        for i, a in enumerate(self.parts):
            if a:
                for j, b in enumerate(other.parts):
                    if b:
                        products[i + j] = products[i + j] + a * b
        for top in range(2 * n - 2, n - 1, -1):
            if products[top]:
                for i in range(n):
                    products[top - n + i] = products[top - n + i] - products[top] * modulus[i]
        return ExtensionPoly(self._field, tuple(products[:n]))

    def __mul__(self, other: Poly | Scalar) -> ExtensionPoly:
        field = self._field
        below = isinstance(other, Poly) and other.field is not field and field.extends(other.field)
        if below or isinstance(other, (int, Fraction)):
            return ExtensionPoly(field, tuple(part * other for part in self.parts))
        return super().__mul__(other)

    __rmul__ = __mul__

    def __truediv__(self, other: Poly | Scalar) -> ExtensionPoly:
        return self * Fraction(1, other) if isinstance(other, (int, Fraction)) else super().__truediv__(other)

    def _divmod(self, other: ExtensionPoly) -> tuple[ExtensionPoly, ExtensionPoly]:
        if self.degree < other.degree:
            return self._field.poly([]), self
        inverse = other.lc.inverse()
        if other.degree == 0:
            return self._mul(inverse), self._field.poly([])
        if not any(other.parts[1:]):
            pairs = [divmod(part, other.parts[0]) for part in self.parts]
            return tuple(ExtensionPoly(self._field, parts) for parts in zip(*pairs, strict=True))  # type: ignore[return-value]
        remainder, quotient = self, [self._field.poly([])] * max(self.degree - other.degree + 1, 0)
        x = self._field.poly([0, 1])
        while remainder.degree >= other.degree:
            shift = remainder.degree - other.degree
            quotient[shift] = remainder.lc._mul(inverse)
            remainder = remainder - quotient[shift]._mul(x**shift)._mul(other)
        return self._field.poly(quotient), remainder

    def gcd(self, other: Poly) -> ExtensionPoly:
        """The monic greatest common divisor, through its images modulo primes, checked by division."""
        first, second = self, self._coerce(other)
        if second is None:
            raise TypeError("both polynomials must lie over the same field")
        if not first or not second:
            return (first or second).monic()
        if first.degree == 0 or second.degree == 0:
            return self._field.poly([1])
        lifter = self._field.lifter()
        for bundle in self._field.bundles():
            try:
                images = [[h.keeping_degree(first).gcd(h.keeping_degree(second))] for h in bundle]
            except BadPrimeError:
                continue
            if len({image[0].degree() for image in images}) > 1:
                continue
            if images[0][0].degree() == 0:
                break
            proposal = lifter.add(bundle, images)
            if proposal and not first % proposal[0] and not second % proposal[0]:
                return proposal[0]  # type: ignore[return-value]
        return self._field.poly([1])

    def derivative(self) -> ExtensionPoly:
        return ExtensionPoly(self._field, tuple(part.derivative() for part in self.parts))

    def inverse(self) -> ExtensionPoly:
        if self.degree > 0:
            raise ValueError("only constants have an inverse")
        base = self._field.base
        if not any(self.parts[1:]):
            return ExtensionPoly(self._field, (self.parts[0].inverse(), *self.parts[1:]))
        element = base.poly([part[0] for part in self.parts]).inverse_modulo(self._field.modulus)
        return ExtensionPoly(self._field, tuple(element[i] for i in range(self._field.dimension)))

    def rational_coefficients(self) -> tuple[Any, ...]:
        width = self._field.base.absolute_degree
        result: list[Any] = []
        for power in range(self.degree + 1):
            for part in self.parts:
                coordinates = part[power].rational_coefficients()
                result += [*coordinates, *[fmpq(0)] * (width - len(coordinates))]
        return tuple(result)

    def common_denominator(self) -> int:
        from math import lcm

        return lcm(*(part.common_denominator() for part in self.parts))

    def height_bits(self) -> int:
        return max(part.height_bits() for part in self.parts)

    def coefficient_strings(self) -> list[str]:
        base, name = self._field.base, self._field.name
        return [base.poly([part[power] for part in self.parts]).integer_str(name) for power in range(self.degree + 1)]

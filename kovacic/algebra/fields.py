"""Coefficient fields: what one is, and the rational numbers (`extension` and `function_field` have the others).

A field adds three things to the arithmetic of its polynomials, and nothing else in the package depends on which field it
is: factoring, homomorphisms to prime fields (`bundles`), and the way back from images under such homomorphisms
(`coordinates` and `assemble`, between which `lifting` does its work on rational numbers).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpq_poly, nmod_poly

from kovacic.algebra.lifting import RationalLifter as ResidueLifter
from kovacic.algebra.lifting import primes
from kovacic.algebra.poly import Poly, Scalar
from kovacic.algebra.rational_poly import RationalPoly, to_fmpq, to_fraction


class BadPrimeError(Exception):
    """The prime divides a denominator, or loses structure that the caller relies on: take another one."""


class Homomorphism(ABC):
    """A ring homomorphism from the p-integral elements of a field to F_p, extended to polynomials."""

    __slots__ = ()

    p: int

    @property
    def ground(self) -> Homomorphism:
        """The homomorphism of Q, or of Q(t), that this one extends."""
        return self

    @abstractmethod
    def __call__(self, polynomial: Poly) -> Any:
        """The image as an `nmod_poly`.  Raises `BadPrimeError` where a coefficient isn't p-integral."""

    def keeping_degree(self, polynomial: Poly) -> Any:
        """The image; `BadPrimeError` if the leading coefficient vanishes."""
        image = self(polynomial)
        if image.degree() != polynomial.degree:
            raise BadPrimeError(f"{self.p} divides a leading coefficient")
        return image


@dataclass(frozen=True, slots=True)
class RationalHomomorphism(Homomorphism):
    """Reduction of rational numbers modulo p."""

    p: int

    def __call__(self, polynomial: Poly) -> Any:
        rep = polynomial.rep  # type: ignore[attr-defined]
        image = nmod_poly(rep.numer(), self.p)
        denominator = rep.denom()
        if denominator == 1:
            return image
        residue = int(denominator) % self.p
        if residue == 0:
            raise BadPrimeError(f"{self.p} divides a denominator")
        return image * pow(residue, -1, self.p)


class CoordinateLifter(ABC):
    """From images of polynomials over Q, or over Q(t), back to the polynomials."""

    __slots__ = ()

    @property
    @abstractmethod
    def primes_used(self) -> int:
        """How many images were used."""

    @abstractmethod
    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        """Add the images under a homomorphism; a proposal when one is due and there is one, else None."""


class Field(ABC):
    """An exact field K of characteristic 0 with polynomial arithmetic, factoring, and homomorphisms to prime fields."""

    __slots__ = ()

    @property
    def ground(self) -> Field:
        """The field at the bottom: Q, or Q(t) for parameters t."""
        return self

    @property
    def lifting_field(self) -> Field:
        """The field whose elements `coordinate_lifter` finds: the ground field, or a number field with few split primes."""
        return self

    @property
    def absolute_degree(self) -> int:
        """The degree over the ground field."""
        return 1

    @abstractmethod
    def poly(self, coefficients: Iterable[Scalar | Poly]) -> Poly:
        """The polynomial with these coefficients, low to high: rational numbers or constants of the field."""

    @abstractmethod
    def extends(self, other: Field) -> bool:
        """Is `other` one of the fields below this one?"""

    @abstractmethod
    def embed(self, polynomial: Poly) -> Poly:
        """A polynomial over a field below this one, over this one."""

    @abstractmethod
    def factor(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        """The monic irreducible factors with their multiplicities, in a fixed order."""

    @abstractmethod
    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        """Sets of homomorphisms over one prime each, such that the images under a set determine an element modulo p.

        (Over Q(t): its value at one point.)  `allowed` restricts the primes.
        """

    @abstractmethod
    def coordinates(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Any]:
        """Rational coordinates modulo p of polynomials, from their images under every homomorphism of a bundle."""

    @abstractmethod
    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        """The polynomials that have these rational coordinates (`fmpq_poly`), in the order of `coordinates`."""

    def coordinate_lifter(self) -> CoordinateLifter:
        """A fresh way back for elements of this field, which is its own `lifting_field`."""
        return RationalLifter()

    def lifter(self) -> Lifter:
        """A fresh way back from images modulo primes."""
        return Lifter(self)

    def homomorphisms(self) -> Iterator[Homomorphism]:
        """One homomorphism for each usable prime."""
        return (bundle[0] for bundle in self.bundles())

    def multiplicity_bound(self, polynomial: Poly, factor: Poly) -> int:
        """How often a factor divides a polynomial modulo a prime: as often as over the field, or (improbably) oftener."""
        for h in self.homomorphisms():
            try:
                return _multiplicity(h.keeping_degree(polynomial), h.keeping_degree(factor))
            except BadPrimeError:
                pass
        raise AssertionError("the sequence of primes is infinite")

    def rational_value(self, constant: Poly) -> Fraction | None:
        """The constant as a rational number, or None if it isn't one."""
        coordinates = constant.rational_coefficients()
        if any(coordinates[1:]):
            return None
        return to_fraction(coordinates[0]) if coordinates else Fraction(0)

    def scalar(self, polynomial: Poly, power: int) -> Any:
        """The coefficient of `x**power` (0 for negative powers) in the field's fastest type for `+ - * /` and truth."""
        return polynomial[power] if power >= 0 else self.poly([])

    def from_scalars(self, coefficients: Sequence[Any]) -> Poly:
        """The polynomial with coefficients, low to high, of the type of `scalar`."""
        return self.poly(coefficients)

    @abstractmethod
    def sqrt(self, constant: Poly) -> Poly | None:
        """A square root within the field, or None if there is none."""


def _multiplicity(polynomial: Any, factor: Any) -> int:
    """How often an `nmod_poly` divides another one, by its powers to the exponents 1, 2, 4, ... and back."""
    powers, found = [factor], 0
    while True:
        quotient, rest = divmod(polynomial, powers[-1])
        if rest:
            break
        polynomial, found = quotient, 2 * found + 1
        powers.append(powers[-1] * powers[-1])
    for k in range(len(powers) - 2, -1, -1):
        quotient, rest = divmod(polynomial, powers[k])
        if not rest:
            polynomial, found = quotient, found + 2**k
    return found


class RationalLifter(CoordinateLifter):
    """The way back to rational numbers."""

    __slots__ = ("_residues",)

    def __init__(self) -> None:
        self._residues = ResidueLifter()

    @property
    def primes_used(self) -> int:
        return self._residues.primes_used

    def add(self, homomorphism: Homomorphism, images: Sequence[Any]) -> list[Any] | None:
        return self._residues.add(homomorphism.p, images)


class Lifter:
    """Collects images under bundles of homomorphisms and proposes the polynomials over the field."""

    __slots__ = ("_coordinates", "_field", "_lifts_points")

    def __init__(self, field: Field) -> None:
        self._field = field
        self._coordinates = field.lifting_field.coordinate_lifter()
        self._lifts_points = field.ground != QQ

    @property
    def primes_used(self) -> int:
        return self._coordinates.primes_used

    def add(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Poly] | None:
        """Images of the same polynomials under each homomorphism of the bundle; a proposal when one is due, else None."""
        homomorphism = bundle[0].ground if self._lifts_points else bundle[0]
        proposal = self._coordinates.add(homomorphism, self._field.coordinates(bundle, images))
        return None if proposal is None else self._field.assemble(proposal)


@dataclass(frozen=True, slots=True)
class RationalField(Field):
    """The field Q of rational numbers."""

    def poly(self, coefficients: Iterable[Scalar | Poly]) -> RationalPoly:
        return RationalPoly(fmpq_poly([c if type(c) is int else _flint_scalar(c) for c in coefficients]))

    def rational_value(self, constant: Poly) -> Fraction | None:
        return to_fraction(constant.rep[0])  # type: ignore[attr-defined]

    def extends(self, other: Field) -> bool:
        return False

    def embed(self, polynomial: Poly) -> Poly:
        return polynomial

    def factor(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        factors = polynomial.rep.numer().factor()[1]  # type: ignore[attr-defined]
        if len(factors) > 1:
            factors.sort(key=lambda pair: (pair[0].degree(), [int(c) for c in pair[0].coeffs()]))
        return [(RationalPoly(fmpq_poly(f, f.leading_coefficient())), k) for f, k in factors]

    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        return ((RationalHomomorphism(p),) for p in primes() if allowed is None or allowed(p))

    def coordinates(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Any]:
        return list(images[0])

    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        return [RationalPoly(c) for c in coordinates]

    def scalar(self, polynomial: Poly, power: int) -> Any:
        return polynomial.rep[power] if power >= 0 else fmpq(0)  # type: ignore[attr-defined]

    def from_scalars(self, coefficients: Sequence[Any]) -> Poly:
        return RationalPoly(fmpq_poly(list(coefficients)))

    def inverse_modulo(self, element: RationalPoly, modulus: RationalPoly) -> Poly:
        """The inverse modulo a polynomial of a high degree, from inverses modulo primes: as many as the result needs.

        Euclid's algorithm over Q, and flint's, work with numbers as large as resultants.
        """
        if element.gcd(modulus).degree > 0:
            raise ZeroDivisionError("not invertible: the polynomials have a common factor")
        lifter = self.lifter()
        for bundle in self.bundles():
            try:
                image, reduced = bundle[0](element), bundle[0].keeping_degree(modulus)
            except BadPrimeError:
                continue
            common, cofactor, _ = image.xgcd(reduced)
            if common.degree() > 0:
                continue
            proposal = lifter.add(bundle, [[cofactor % reduced]])
            if proposal is not None and (proposal[0] * element - 1) % modulus == 0:
                return proposal[0]
        raise AssertionError("there are infinitely many primes")

    def sqrt(self, constant: Poly) -> Poly | None:
        value = constant.rep[0]  # type: ignore[attr-defined]
        if value < 0 or not value.p.is_square() or not value.q.is_square():
            return None
        return RationalPoly(fmpq_poly([value.p.isqrt()], value.q.isqrt()))

    def __str__(self) -> str:
        return "Q"


def _flint_scalar(value: Scalar | Poly) -> Any:
    return value.rep[0] if isinstance(value, RationalPoly) else to_fmpq(value)  # type: ignore[arg-type]


QQ = RationalField()
RationalPoly.rationals = QQ

"""Polynomials over the rational numbers, on flint's `fmpq_poly`."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from flint import fmpq, fmpq_poly, fmpz_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.poly import Poly, Scalar

if TYPE_CHECKING:
    from kovacic.algebra.fields import Field

#: The degree of a modulus up to which Euclid's algorithm over Q is the fastest way to an inverse.
_EUCLID_DEGREE = 16


def to_fmpq(value: Scalar) -> Any:
    """The flint rational equal to `value`."""
    return fmpq(value.numerator, value.denominator)


def to_fraction(value: Any) -> Fraction:
    """The `Fraction` equal to a flint rational."""
    return Fraction(int(value.p), int(value.q))


class RationalPoly(Poly):
    """A polynomial over the rational numbers, on flint's `fmpq_poly`."""

    __slots__ = ("rep",)

    rationals: ClassVar[Field]  # set by `fields`, which imports this module
    rep: Any  # fmpq_poly, never changed after construction

    def __init__(self, rep: Any) -> None:
        _set_rep(self, rep)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("polynomials are immutable")

    @classmethod
    def of(cls, coefficients: Iterable[Scalar]) -> RationalPoly:
        """From coefficients, low to high."""
        return cls(fmpq_poly([c if isinstance(c, int) else to_fmpq(c) for c in coefficients]))

    def __reduce__(self) -> tuple[Any, ...]:
        return _rational_poly_from_key, self.key()

    def key(self) -> tuple[Any, ...]:
        return tuple(int(c) for c in self.rep.numer().coeffs()), int(self.rep.denom())

    @property
    def field(self) -> Field:
        return self.rationals

    @property
    def degree(self) -> int:
        degree: int = self.rep.degree()
        return degree

    def __getitem__(self, power: int) -> RationalPoly:
        return RationalPoly(fmpq_poly([self.rep[power]]))

    def __eq__(self, other: object) -> bool:
        if type(other) is RationalPoly:
            return bool(self.rep == other.rep)
        return bool(self.rep == other) if type(other) is int else super().__eq__(other)

    __hash__ = Poly.__hash__

    def __neg__(self) -> RationalPoly:
        return RationalPoly(-self.rep)

    def _coerce(self, other: object) -> RationalPoly | None:
        if isinstance(other, RationalPoly):
            return other
        if isinstance(other, int):
            return RationalPoly(fmpq_poly([other]))
        if isinstance(other, Fraction):
            return RationalPoly(fmpq_poly([to_fmpq(other)]))
        return None

    # Python's overhead is most of the time for small polynomials: hence the operators with a short way for the common cases.
    def __add__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is RationalPoly:
            return RationalPoly(self.rep + other.rep)
        return RationalPoly(self.rep + other) if type(other) is int else super().__add__(other)

    __radd__ = __add__

    def __sub__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is RationalPoly:
            return RationalPoly(self.rep - other.rep)
        return RationalPoly(self.rep - other) if type(other) is int else super().__sub__(other)

    def __mul__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is RationalPoly:
            return RationalPoly(self.rep * other.rep)
        if type(other) is int:
            return RationalPoly(self.rep * other)
        return RationalPoly(self.rep * to_fmpq(other)) if type(other) is Fraction else super().__mul__(other)

    __rmul__ = __mul__

    def __mod__(self, other: Poly | Scalar) -> RationalPoly:
        return RationalPoly(self.rep % other.rep) if type(other) is RationalPoly else super().__mod__(other)

    def __floordiv__(self, other: Poly | Scalar) -> RationalPoly:
        return RationalPoly(self.rep // other.rep) if type(other) is RationalPoly else super().__floordiv__(other)

    def __truediv__(self, other: Poly | Scalar) -> RationalPoly:
        return RationalPoly(self.rep / other) if type(other) is int and other else super().__truediv__(other)

    def _add(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self.rep + other.rep)

    def _mul(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self.rep * other.rep)

    def __call__(self, point: Poly | Scalar) -> Poly:
        if type(point) is int:
            return RationalPoly(fmpq_poly([self.rep(point)]))
        value = self._coerce(point)
        if value is None:
            return super().__call__(point)
        constant = value.degree <= 0  # evaluation is much faster than composition with a constant
        return RationalPoly(fmpq_poly([self.rep(value.rep[0])]) if constant else self.rep(value.rep))

    def _divmod(self, other: RationalPoly) -> tuple[RationalPoly, RationalPoly]:
        quotient, remainder = divmod(self.rep, other.rep)
        return RationalPoly(quotient), RationalPoly(remainder)

    def __pow__(self, exponent: int) -> RationalPoly:
        if exponent < 0:
            raise ValueError("a polynomial has no negative powers")
        return RationalPoly(self.rep**exponent)

    def __bool__(self) -> bool:
        return bool(self.rep)

    @property
    def is_monic(self) -> bool:
        return bool(self.rep.leading_coefficient() == 1)

    def monic(self) -> RationalPoly:
        return RationalPoly(self.rep / self.rep.leading_coefficient()) if self.rep else self

    def gcd(self, other: Poly) -> RationalPoly:
        if not isinstance(other, RationalPoly):
            raise TypeError("both polynomials must lie over the same field")
        return RationalPoly(self.rep.gcd(other.rep))

    def reversed(self, shift: int = 0) -> RationalPoly:
        return RationalPoly(fmpq_poly([0] * shift + self.rep.coeffs()[::-1]))

    def root(self, n: int) -> RationalPoly | None:
        if n != 2:
            return super().root(n)
        try:  # a monic r is N/e with a primitive N of leading coefficient e, so that r^2 = N^2/e^2 in lowest terms
            return RationalPoly(fmpq_poly(self.rep.numer().sqrt(), self.rep.denom().isqrt()))
        except DomainError:
            return None

    def inverse_modulo(self, modulus: Poly) -> RationalPoly:
        small = modulus.degree <= _EUCLID_DEGREE
        return super().inverse_modulo(modulus) if small else self.rationals.inverse_modulo(self, modulus)  # type: ignore[attr-defined]

    def derivative(self) -> RationalPoly:
        return RationalPoly(self.rep.derivative())

    def inverse(self) -> RationalPoly:
        if self.degree > 0:
            raise ValueError("only constants have an inverse")
        return RationalPoly(fmpq_poly([1 / self.rep[0]]))

    @property
    def lc(self) -> RationalPoly:
        return RationalPoly(fmpq_poly([self.rep.leading_coefficient()]))

    def coefficients(self) -> tuple[Fraction, ...]:
        """The coefficients from low to high."""
        return tuple(to_fraction(c) for c in self.rep.coeffs())

    def rational_coefficients(self) -> tuple[Any, ...]:
        return tuple(self.rep.coeffs())

    def common_denominator(self) -> int:
        return int(self.rep.denom())

    def content(self) -> tuple[int, int]:
        return int(self.rep.numer().content()) or 1, int(self.rep.denom())

    def height_bits(self) -> int:
        return max(int(self.rep.numer().height_bits()), int(self.rep.denom()).bit_length())

    def numerator(self) -> Any:
        """The flint integer polynomial `common_denominator() * self`."""
        return self.rep.numer()

    def coefficient_strings(self) -> list[str]:
        return list(map(str, self.rep.numer().coeffs()))

    def constant(self) -> Fraction:
        """The constant coefficient."""
        return to_fraction(self.rep[0])


_set_rep = RationalPoly.__dict__["rep"].__set__


def _rational_poly_from_key(numerators: tuple[int, ...], denominator: int) -> RationalPoly:
    return RationalPoly(fmpq_poly(fmpz_poly(list(numerators)), denominator))

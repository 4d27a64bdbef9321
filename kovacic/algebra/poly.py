"""Immutable dense polynomials in one variable over an exact coefficient field.

`Poly` is what every other module sees; flint's mutable polynomials stay inside.  A constant of the field is a polynomial
of degree 0 (or -1, for zero), so that one type serves for both.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING, Any, ClassVar, Self

from flint import fmpq, fmpq_poly, fmpz_poly

if TYPE_CHECKING:
    from kovacic.algebra.fields import Field

Scalar = int | Fraction


def to_fmpq(value: Scalar) -> Any:
    """The flint rational equal to `value`."""
    return fmpq(value.numerator, value.denominator)


def to_fraction(value: Any) -> Fraction:
    """The `Fraction` equal to a flint rational."""
    return Fraction(int(value.p), int(value.q))


class Poly(ABC):
    """A polynomial over `self.field`, immutable and hashable; arithmetic with `+ - * ** // % divmod` and scalars.

    The degree of the zero polynomial is -1.  A polynomial over a field combines with one over an extension of that field;
    the result lies over the extension.
    """

    __slots__ = ()

    @property
    @abstractmethod
    def field(self) -> Field:
        """The coefficient field."""

    @property
    @abstractmethod
    def degree(self) -> int:
        """The degree; -1 for zero."""

    @abstractmethod
    def __getitem__(self, power: int) -> Self:
        """The coefficient of `x**power`, as a constant polynomial."""

    @abstractmethod
    def __neg__(self) -> Self: ...

    @abstractmethod
    def _add(self, other: Self) -> Self: ...

    @abstractmethod
    def _mul(self, other: Self) -> Self: ...

    @abstractmethod
    def _divmod(self, other: Self) -> tuple[Self, Self]: ...

    @abstractmethod
    def gcd(self, other: Self) -> Self:
        """The monic greatest common divisor; zero when both are zero."""

    @abstractmethod
    def derivative(self) -> Self:
        """The derivative with respect to the variable."""

    @abstractmethod
    def inverse(self) -> Self:
        """The inverse of a non-zero constant."""

    @abstractmethod
    def rational_coefficients(self) -> tuple[Any, ...]:
        """All rational coordinates of all coefficients, as flint rationals: what decides about sizes and denominators."""

    @abstractmethod
    def key(self) -> tuple[Any, ...]:
        """A hashable, picklable value that determines the polynomial within its field."""

    def leaves(self) -> list[Poly]:
        """The coordinates over the ground field, polynomials themselves."""
        return [self]

    @abstractmethod
    def coefficient_strings(self) -> list[str]:
        """The coefficients in Python syntax, low to high; they must have integer coordinates."""

    def _coerce(self, other: object) -> Self | None:
        field = self.field
        if isinstance(other, Poly):
            if other.field is field or other.field == field:
                return other  # type: ignore[return-value]
            return field.embed(other) if field.extends(other.field) else None  # type: ignore[return-value]
        if isinstance(other, (int, Fraction)):
            return field.poly([other])  # type: ignore[return-value]
        return None

    def _extended(self, other: object, operation: str) -> Any:
        """The operation over the field of `other`, where that is an extension of this one.

        Python doesn't try the reflected operation of two objects of one class, as polynomials over a tower are.
        """
        if isinstance(other, Poly) and other.field.extends(self.field):
            return getattr(other.field.embed(self), operation)(other)
        return NotImplemented

    def __add__(self, other: Poly | Scalar) -> Self:
        value = self._coerce(other)
        return self._extended(other, "__add__") if value is None else self._add(value)

    __radd__ = __add__

    def __sub__(self, other: Poly | Scalar) -> Self:
        value = self._coerce(other)
        return self._extended(other, "__sub__") if value is None else self._add(-value)

    def __rsub__(self, other: Poly | Scalar) -> Self:
        value = self._coerce(other)
        return NotImplemented if value is None else value._add(-self)

    def __mul__(self, other: Poly | Scalar) -> Self:
        value = self._coerce(other)
        if value is None:
            return other * self if isinstance(other, Poly) and other.field.extends(self.field) else NotImplemented
        return self._mul(value)

    __rmul__ = __mul__

    def __divmod__(self, other: Poly | Scalar) -> tuple[Self, Self]:
        value = self._coerce(other)
        if value is None:
            return self._extended(other, "__divmod__")  # type: ignore[no-any-return]
        if value.degree < 0:
            raise ZeroDivisionError("division by the zero polynomial")
        return self._divmod(value)

    def __floordiv__(self, other: Poly | Scalar) -> Self:
        return divmod(self, other)[0]

    def __mod__(self, other: Poly | Scalar) -> Self:
        return divmod(self, other)[1]

    def __truediv__(self, other: Poly | Scalar) -> Self:
        """Division by a non-zero constant."""
        value = self._coerce(other)
        return self._extended(other, "__truediv__") if value is None else self._mul(value.inverse())

    def __pow__(self, exponent: int) -> Self:
        if exponent < 0:
            raise ValueError("a polynomial has no negative powers")
        result: Any = self.field.poly([1])
        base = self
        while exponent:
            if exponent & 1:
                result = result._mul(base)
            exponent >>= 1
            if exponent:
                base = base._mul(base)
        return result  # type: ignore[no-any-return]

    def __eq__(self, other: object) -> bool:
        value = self._coerce(other)
        if value is None:
            return (
                other._coerce(self) == other if isinstance(other, Poly) and other.field.extends(self.field) else False
            )
        return self.key() == value.key()

    def __hash__(self) -> int:
        return hash(self.key())

    def __bool__(self) -> bool:
        return self.degree >= 0

    def __iter__(self) -> Iterator[Self]:
        return (self[i] for i in range(self.degree + 1))

    def __call__(self, point: Poly | Scalar) -> Poly:
        """The value at a point: a constant, or another polynomial (composition), by Horner's rule."""
        result: Any = self.field.poly([])
        for power in range(self.degree, -1, -1):
            result = result * point + self[power]
        return result  # type: ignore[no-any-return]

    @property
    def lc(self) -> Self:
        """The leading coefficient (zero for the zero polynomial)."""
        return self[max(self.degree, 0)]

    @property
    def is_constant(self) -> bool:
        return self.degree <= 0

    @property
    def is_monic(self) -> bool:
        return self.lc == 1

    def over(self, field: Field) -> Poly:
        """The same polynomial over an extension of its field (or over the field itself)."""
        return self if self.field == field else field.embed(self)

    def monic(self) -> Self:
        """The multiple with leading coefficient 1; zero stays zero."""
        return self if not self else self * self.lc.inverse()

    def exact_quotient(self, divisor: Poly) -> Self | None:
        """`self / divisor` where the division leaves no remainder, else None."""
        quotient, remainder = divmod(self, divisor)
        return None if remainder else quotient

    def remove(self, factor: Poly) -> tuple[Self, int]:
        """`(q, k)` with `self = q * factor**k` and k as large as possible; self must not be zero."""
        rest, count = self, 0
        while rest.degree >= factor.degree and (quotient := rest.exact_quotient(factor)) is not None:
            rest, count = quotient, count + 1
        return rest, count

    def reversed(self, shift: int = 0) -> Self:
        """`x**(degree + shift) * self(1/x)`."""
        return self.field.poly([*[0] * shift, *list(self)[::-1]])  # type: ignore[return-value]

    def root(self, n: int) -> Self | None:
        """The monic r with `r**n == self` for a monic polynomial that is the n-th power of a squarefree one, else None."""
        radical = self if n == 1 or self.degree <= 0 else self // self.gcd(self.derivative())
        return radical if radical**n == self else None

    def inverse_modulo(self, modulus: Poly) -> Self:
        """The inverse of self modulo a polynomial that is coprime to it."""
        r0: Any = modulus
        r1: Any = self % modulus
        t0: Any = self.field.poly([])
        t1: Any = self.field.poly([1])
        while r1.degree > 0:
            quotient, rest = divmod(r0, r1)
            r0, r1, t0, t1 = r1, rest, t1, t0 - quotient * t1
        if not r1:
            raise ZeroDivisionError("not invertible: the polynomials have a common factor")
        return (t1 * r1.inverse()) % modulus  # type: ignore[no-any-return]

    def common_denominator(self) -> int:
        """The least positive integer d such that d * self has integer coordinates."""
        return lcm(*(int(c.q) for c in self.rational_coefficients()))

    def content(self) -> tuple[int, int]:
        """`(p, q)` in lowest terms, p/q > 0 such that self * q/p has coprime integer coordinates; (1, 1) for zero."""
        coordinates = self.rational_coefficients()
        return gcd(*(int(c.p) for c in coordinates)) or 1, lcm(*(int(c.q) for c in coordinates))

    def height_bits(self) -> int:
        """The size of the largest numerator or denominator among the coordinates, in bits."""
        return max((max(int(c.p).bit_length(), int(c.q).bit_length()) for c in self.rational_coefficients()), default=0)

    def to_str(self, variable: str = "x") -> str:
        """Python/SymPy syntax, with one common denominator."""
        if not isinstance(self.leaves()[0], RationalPoly):
            from kovacic.algebra.ratfunc import RatFunc

            return RatFunc(self, self.field.poly([1]), reduced=True).to_str(variable)
        denominator = self.common_denominator()
        if denominator == 1:
            return self.integer_str(variable)
        text = (self * denominator).integer_str(variable)
        return f"({text})/{denominator}" if " " in text else f"{text}/{denominator}"

    def integer_str(self, variable: str) -> str:
        """Python syntax for a polynomial whose coefficients have integer coordinates."""
        terms: list[str] = []
        coefficients = self.coefficient_strings()
        for power in range(len(coefficients) - 1, -1, -1):
            coefficient = coefficients[power]
            if coefficient == "0":
                continue
            if power == 0:
                terms.append(coefficient)
                continue
            monomial = variable if power == 1 else f"{variable}**{power}"
            if coefficient in ("1", "-1"):
                terms.append(coefficient[:-1] + monomial)
            else:
                terms.append(f"({coefficient})*{monomial}" if " " in coefficient else f"{coefficient}*{monomial}")
        return " + ".join(terms).replace("+ -", "- ") if terms else "0"

    def __str__(self) -> str:
        return self.to_str()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.to_str()}>"


#: The degree of a modulus up to which Euclid's algorithm over Q is the fastest way to an inverse.
_EUCLID_DEGREE = 16


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

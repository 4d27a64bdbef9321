"""Polynomials over exact fields, and the fields: the abstract classes that every implementation fills in.

`Poly` is what every other module sees; flint's mutable polynomials stay inside.  A constant of the field is a polynomial
of degree 0 (or -1, for zero), so that one type serves for both.  The fields are Q (`rationals`), Q(t) for parameters t
(`function_field`), and simple algebraic extensions of these and of one another (`extension`).

A field adds: factoring, homomorphisms to prime fields (`bundles`), and the way back from images under these
(`coordinates`, `collector`, `assemble`; see `lifting`).  Nothing else in the package depends on which field it is.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Any, Self

from kovacic.algebra.homomorphism import Collector, Homomorphism
from kovacic.limits import check_time

Scalar = int | Fraction


class Immutable:
    """A base for objects whose attributes are set once, by `object.__setattr__` in the constructor."""

    __slots__ = ()

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("polynomials and rational functions are immutable")


class Poly(Immutable):
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
        """The coefficient of `x**power`, as a constant polynomial; 0 for a negative power."""

    @abstractmethod
    def __neg__(self) -> Self: ...

    @abstractmethod
    def _add(self, other: Self) -> Self: ...

    @abstractmethod
    def _mul(self, other: Self) -> Self: ...

    def _divmod(self, other: Self) -> tuple[Self, Self]:
        inverse = other.lc.inverse()
        x = self.field.x
        remainder = self
        quotient = [self.field.zero] * max(self.degree - other.degree + 1, 0)
        while remainder.degree >= other.degree:
            check_time()
            shift = remainder.degree - other.degree
            quotient[shift] = remainder.lc * inverse
            remainder = remainder - quotient[shift] * x**shift * other
        return self.field.poly(quotient), remainder  # type: ignore[return-value]

    @abstractmethod
    def _gcd(self, other: Self) -> Self: ...

    @abstractmethod
    def derivative(self) -> Self:
        """The derivative with respect to the variable."""

    @abstractmethod
    def inverse(self) -> Self:
        """The inverse of a non-zero constant."""

    def square_part(self) -> tuple[Any, Any]:
        """(c, d) for a constant other than 0: it is c^2 d, d without squares that are seen."""
        return 1, self

    @abstractmethod
    def rational_coefficients(self) -> tuple[Any, ...]:
        """All rational coordinates of all coefficients, as flint rationals: what decides about sizes and denominators."""

    @abstractmethod
    def key(self) -> tuple[Any, ...]:
        """A hashable, picklable value that determines the polynomial within its field."""

    @property
    def parts(self) -> tuple[Poly, ...]:
        """The coordinates over the field below; the polynomial itself over a ground field."""
        return (self,)

    def leaves(self) -> list[Poly]:
        """The coordinates over the ground field, polynomials themselves."""
        return [self]

    def extent(self) -> tuple[int, tuple[int, ...]]:
        """The terms of numerator or denominator, whichever has more, and the degrees in x and in each parameter."""
        return self.degree + 1, (self.degree,)

    @abstractmethod
    def coefficient_strings(self) -> list[str]:
        """The coefficients in Python syntax, low to high; they must have integer coordinates."""

    def _common(self, other: object) -> tuple[Any, Any] | None:
        """Both over the larger one of their fields; None if neither field extends the other one, and for other types."""
        field = self.field
        if type(other) is type(self) and other.field is field:
            return self, other
        if isinstance(other, Poly):
            if other.field == field:
                return self, other
            if field.extends(other.field):
                return self, field.embed(other)
            return (other.field.embed(self), other) if other.field.extends(field) else None
        return (self, field.poly([other])) if isinstance(other, (int, Fraction)) else None

    def __add__(self, other: Poly | Scalar) -> Self:
        pair = self._common(other)
        return NotImplemented if pair is None else pair[0]._add(pair[1])

    __radd__ = __add__

    def __sub__(self, other: Poly | Scalar) -> Self:
        return self + -other

    def __rsub__(self, other: Poly | Scalar) -> Self:
        return -self + other

    def __mul__(self, other: Poly | Scalar) -> Self:
        pair = self._common(other)
        return NotImplemented if pair is None else pair[0]._mul(pair[1])

    __rmul__ = __mul__

    def __divmod__(self, other: Poly | Scalar) -> tuple[Self, Self]:
        pair = self._common(other)
        if pair is None:
            return NotImplemented
        if not pair[1]:
            raise ZeroDivisionError("division by the zero polynomial")
        return pair[0]._divmod(pair[1])  # type: ignore[no-any-return]

    def __floordiv__(self, other: Poly | Scalar) -> Self:
        return divmod(self, other)[0]

    def __mod__(self, other: Poly | Scalar) -> Self:
        return divmod(self, other)[1]

    def __truediv__(self, other: Poly | Scalar) -> Self:
        """Division by a non-zero constant."""
        pair = self._common(other)
        return NotImplemented if pair is None else pair[0]._mul(pair[1].inverse())

    def gcd(self, other: Poly) -> Poly:
        """The monic greatest common divisor; zero when both are zero."""
        pair = self._common(other)
        if pair is None:
            raise TypeError("both polynomials must lie over the same field, or over one field and an extension of it")
        return pair[0]._gcd(pair[1])  # type: ignore[no-any-return]

    def __pow__(self, exponent: int) -> Self:
        if exponent < 0:
            raise ValueError("a polynomial has no negative powers")
        if exponent < 2:
            return self if exponent else self.field.one  # type: ignore[return-value]
        root = self ** (exponent // 2)
        return root._mul(root)._mul(self) if exponent % 2 else root._mul(root)

    def __eq__(self, other: object) -> bool:
        pair = self._common(other)
        return pair is not None and pair[0].key() == pair[1].key()

    def __hash__(self) -> int:
        return hash(self.key())

    def __bool__(self) -> bool:
        return self.degree >= 0

    def __iter__(self) -> Iterator[Self]:
        return (self[i] for i in range(self.degree + 1))

    def __call__(self, point: Poly | Scalar) -> Poly:
        """The value at a point: a constant, or another polynomial (composition), by Horner's rule."""
        result: Any = self.field.zero
        for coefficient in reversed([*self]):
            result = result * point + coefficient
        return result  # type: ignore[no-any-return]

    @property
    def lc(self) -> Self:
        """The leading coefficient (zero for the zero polynomial)."""
        return self[max(self.degree, 0)]

    @property
    def mean_of_zeros(self) -> Self:
        """-c_(n-1)/(n c_n) for a degree n > 0."""
        return -self[self.degree - 1] / (self.lc * self.degree)

    @property
    def is_constant(self) -> bool:
        return self.degree <= 0

    @property
    def is_monic(self) -> bool:
        return self.lc == 1

    def over(self, field: Field) -> Poly:
        """The polynomial over an extension of its field (or over the field itself)."""
        return self if self.field == field else field.embed(self)

    def monic(self) -> Self:
        """The multiple with leading coefficient 1; zero stays zero."""
        return self if not self else self * self.lc.inverse()

    def exact_quotient(self, divisor: Poly) -> Self | None:
        """`self / divisor` where the division leaves no remainder, else None."""
        if self.degree < divisor.degree:
            return None if self else self
        quotient, remainder = divmod(self, divisor)
        return None if remainder else quotient

    def remove(self, factor: Poly) -> tuple[Self, int]:
        """`(q, k)` with `self = q * factor**k` and k as large as possible; self must not be zero."""
        quotient = self.exact_quotient(factor)
        if quotient is None:
            return self, 0
        rest, k = quotient.remove(factor * factor)
        last = rest.exact_quotient(factor)
        return (rest, 2 * k + 1) if last is None else (last, 2 * k + 2)

    def reversed(self, shift: int = 0) -> Self:
        """`x**(degree + shift) * self(1/x)`."""
        return self.field.poly([*[0] * shift, *list(self)[::-1]])  # type: ignore[return-value]

    def root(self, n: int) -> Self | None:
        """The monic r with `r**n == self` for a monic polynomial that is the n-th power of a squarefree one, else None."""
        radical = self if n == 1 or self.degree <= 0 else self // self.gcd(self.derivative())
        return radical if radical**n == self else None

    def _gcd_and_multiple(self, other: Poly) -> tuple[Any, Any]:
        """The monic greatest common divisor d, and s with d = s self modulo the other polynomial."""
        r0: Any = self
        r1: Any = other
        s0: Any = self.field.one
        s1: Any = self.field.zero
        while r1.degree > 0:
            quotient, rest = divmod(r0, r1)
            r0, r1, s0, s1 = r1, rest, s1, s0 - quotient * s1
        d, s = (r1, s1) if r1 else (r0, s0)
        inverse = d.lc.inverse()
        return d * inverse, s * inverse

    def xgcd(self, other: Poly) -> tuple[Self, Self, Self]:
        """(d, s, t) with d = s self + t other the monic greatest common divisor."""
        d, s = self._gcd_and_multiple(other)
        return d, s, (d - s * self) // other if other else other  # type: ignore[return-value]

    def inverse_modulo(self, modulus: Poly) -> Self:
        """The inverse of self modulo a polynomial that is coprime to it."""
        common, inverse = self._gcd_and_multiple(modulus)
        if common.degree > 0:
            raise ZeroDivisionError("not invertible: the polynomials have a common factor")
        return inverse % modulus  # type: ignore[no-any-return]

    def content(self) -> tuple[int, int]:
        """`(p, q)` in lowest terms, p/q > 0 such that self * q/p has coprime integer coordinates; (1, 1) for zero."""
        coordinates = self.rational_coefficients()
        return gcd(*(int(c.p) for c in coordinates)) or 1, lcm(*(int(c.q) for c in coordinates))

    def height_bits(self) -> int:
        """The size of the largest numerator or denominator among the coordinates, in bits."""
        return max(leaf.height_bits() for leaf in self.leaves())

    @abstractmethod
    def to_sympy(self, variable: Any) -> Any:
        """A SymPy expression in this symbol, and in those that `to_str` prints."""

    def to_str(self, variable: str = "x") -> str:
        """Python/SymPy syntax, with one common denominator."""
        return quotient_str(self, self.field.one, variable)

    def integer_str(self, variable: str) -> str:
        """Python syntax for a polynomial whose coefficients have integer coordinates."""
        return joined_terms(self.coefficient_strings(), variable)

    def __str__(self) -> str:
        return self.to_str()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.to_str()}>"


class Field:
    """An exact field K of characteristic 0 with polynomial arithmetic, factoring, and homomorphisms to prime fields."""

    __slots__ = ()

    @property
    def ground(self) -> Field:
        """The field at the bottom: Q, or Q(t) for parameters t."""
        return self

    @property
    def height(self) -> int:
        """The number of extensions above the ground field."""
        return 0

    @property
    def absolute_degree(self) -> int:
        """The degree over the ground field."""
        return 1

    @abstractmethod
    def poly(self, coefficients: Iterable[Scalar | Poly]) -> Poly:
        """The polynomial with these coefficients, low to high: rational numbers or constants of the field."""

    @property
    def x(self) -> Poly:
        """The polynomial x."""
        return self.poly([0, 1])

    @property
    def one(self) -> Poly:
        """The constant 1."""
        return self.poly([1])

    @property
    def zero(self) -> Poly:
        """The constant 0."""
        return self.poly([])

    @abstractmethod
    def extends(self, other: Field) -> bool:
        """True if `other` is one of the fields below this one."""

    @abstractmethod
    def embed(self, polynomial: Poly) -> Poly:
        """A polynomial over a field below this one, over this one."""

    def factor(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        """The monic irreducible factors with their multiplicities, in a fixed order; none of a constant."""
        return self._factors(polynomial) if polynomial.degree > 0 else []

    @abstractmethod
    def _factors(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        """Those of a polynomial that isn't constant."""

    @abstractmethod
    def sqrt(self, constant: Poly) -> Poly | None:
        """A square root within the field, or None if there is none."""

    @abstractmethod
    def rational_value(self, constant: Poly) -> Fraction | None:
        """The constant as a rational number, or None if it isn't one."""

    @abstractmethod
    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        """Sets of homomorphisms over one prime each, such that the images under a set determine an element modulo p.

        (Over Q(t): its value at one point.)  `allowed` restricts the primes.
        """

    @abstractmethod
    def collector(self, shape: tuple[int, ...]) -> Collector:
        """A fresh way back for `coordinates` of these lengths."""

    def coordinates(self, bundle: Sequence[Homomorphism], images: Sequence[Sequence[Any]]) -> list[Any]:
        """Coordinates modulo p of polynomials, from their images under every homomorphism of a bundle."""
        return list(images[0])

    @abstractmethod
    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        """The polynomials that have the coordinates that a collector found."""

    def homomorphisms(self) -> Iterator[Homomorphism]:
        """One homomorphism for each usable prime."""
        return (bundle[0] for bundle in self.bundles())

    def cleared(self, num: Poly, den: Poly) -> tuple[Poly, Poly]:
        """A common multiple of two polynomials over an extension of this ground field by one of its elements.

        Their coordinates are integers (over Q(t): polynomials in t) without a common factor.
        """
        (p, q), (r, s) = num.content(), den.content()
        common = gcd(p * s, r * q)
        multiple = q * s
        if common == multiple:
            return num, den
        factor = Fraction(multiple, common)
        return num * factor, den * factor


def joined_terms(coefficients: Sequence[str], variable: str) -> str:
    """The polynomial with these coefficients, low to high."""
    powers = ["", variable, *(f"{variable}**{k}" for k in range(2, len(coefficients)))]
    terms = []
    for c, power in zip(coefficients, powers, strict=False):
        if c in ("1", "-1") and power:
            terms.append(c[:-1] + power)
        elif c != "0":
            factor = f"({c})" if " " in c and power else c  # a sum
            terms.append(f"{factor}*{power}" if power else factor)
    return " + ".join(reversed(terms)).replace("+ -", "- ") or "0"


def quotient_str(num: Any, den: Any, variable: str) -> str:
    """`num/den`, two polynomials, in lowest terms, with integer coefficients."""
    num, den = num.field.ground.cleared(num, den)
    above: str = num.integer_str(variable)
    below: str = den.integer_str(variable)
    if below == "1":
        return above
    is_product = "*" in below.replace("**", "^")
    # Spaces separate the terms of a sum.
    dividend = f"({above})" if " " in above else above
    divisor = f"({below})" if " " in below or is_product else below
    return f"{dividend}/{divisor}"

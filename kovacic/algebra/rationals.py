"""The field Q of rational numbers, and polynomials over it on flint's `fmpq_poly`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import Any

from flint import fmpq, fmpq_poly, fmpz, fmpz_poly, nmod_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.homomorphism import BadPrimeError, Collector, Homomorphism
from kovacic.algebra.lifting import Residues, inverse_by_primes, primes
from kovacic.algebra.poly import Field, Poly, Scalar
from kovacic.limits import check_duration, check_time, may_be_late, watched_seconds

#: Above this degree of a modulus FLINT's inverse over Q takes longer than that by primes: 1.5 s in place of 7 ms at degree 100.
_EUCLID_OVER_Q = 16
#: Above this degree exact arithmetic takes long: it is estimated first, done modulo primes, or in another process.
LARGE_DEGREE = 400
#: FLINT's seconds for factors over Z, at most, over the cube of the degree, where there are few factors modulo a prime.
_FACTOR_SECONDS = 1e-7
_FEW_MODULAR_FACTORS = 16
#: Integers up to this size are factored, to write sqrt(8) as 2*sqrt(2); of larger ones, factors of up to `_SMOOTH_BITS` bits.
_FACTORED_BITS = 160
_SMOOTH_BITS = 15
#: FLINT's seconds for each bit of the coefficients of a product (measured: 2e-9) or a power (1.2e-9).
_PRODUCT_SECONDS = 1.6e-9
#: FLINT's seconds for each bit of a coefficient times the squares of degrees: an exact division (2e-11), a gcd (1.2e-11).
_QUOTIENT_SECONDS = 1.6e-11
#: Above this degree products and divisions look at the clock.
_LOOK_DEGREE = 100
#: A division by a divisor of degree n looks after each n/8 terms of the quotient, but not before `_LOOK_DEGREE`.
_PIECES_OF_A_DIVISION = 8
#: The time that it takes to write down a polynomial around a rational point, over a power of the bits of all coefficients.
_TRANSLATION_SECONDS = 2e-10
_MOVE_POWER = 1.21


def to_fmpq(value: Scalar) -> Any:
    """The flint rational equal to `value`."""
    return fmpq(value.numerator, value.denominator)


def to_fraction(value: Any) -> Fraction:
    """The `Fraction` equal to a rational number of FLINT or SymPy."""
    return Fraction(int(value.p), int(value.q))


def square_part(value: Fraction) -> tuple[Fraction, int]:
    """`(s, d)` with value = s**2 d, d an integer, squarefree where the numbers are small enough to be factored."""
    d = fmpz(value.numerator * value.denominator)
    outer = 1
    factors = abs(d).factor() if d.bit_length() <= _FACTORED_BITS else abs(d).factor_smooth(_SMOOTH_BITS)
    for factor, exponent in factors:
        outer *= int(factor) ** (exponent // 2) * (int(factor.isqrt()) if exponent % 2 and factor.is_square() else 1)
    return Fraction(outer, value.denominator), int(d) // outer**2


class RationalPoly(Poly):
    """A polynomial over the rational numbers, on flint's `fmpq_poly`."""

    __slots__ = ("rep",)

    rep: Any  # fmpq_poly, never changed after construction
    field: RationalField  # `QQ`, an attribute of the class

    def __init__(self, rep: Any) -> None:
        _set_rep(self, rep)

    def __reduce__(self) -> tuple[Any, ...]:
        return _rational_poly_from_key, self.key()

    def key(self) -> tuple[Any, ...]:
        return tuple(int(c) for c in self.rep.numer().coeffs()), int(self.rep.denom())

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
            if self.rep.degree() > _LOOK_DEGREE and other.rep.degree() > _LOOK_DEGREE:
                bits = (self.degree + other.degree) * (self.height_bits() + other.height_bits())
                what = f"a product of polynomials of degree {self.degree} and {other.degree}"
                check_duration(_PRODUCT_SECONDS * bits, what)
            return RationalPoly(self.rep * other.rep)
        if type(other) is int:
            return RationalPoly(self.rep * other)
        if type(other) is Fraction:
            return RationalPoly(self.rep * to_fmpq(other))
        return other * self if isinstance(other, Poly) else NotImplemented

    __rmul__ = __mul__

    def __mod__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is not RationalPoly:
            return super().__mod__(other)
        if self.rep.degree() <= _LOOK_DEGREE:
            return RationalPoly(self.rep % other.rep)
        return RationalPoly(_long_division(self.rep, other.rep)[1])

    def __floordiv__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is not RationalPoly:
            return super().__floordiv__(other)
        if self.rep.degree() <= _LOOK_DEGREE:
            return RationalPoly(self.rep // other.rep)
        return RationalPoly(_long_division(self.rep, other.rep)[0])

    def __truediv__(self, other: Poly | Scalar) -> RationalPoly:
        if type(other) is RationalPoly and other.rep.degree() == 0:
            return RationalPoly(self.rep / other.rep[0])
        return RationalPoly(self.rep / other) if type(other) is int and other else super().__truediv__(other)

    def _add(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self.rep + other.rep)

    def _mul(self, other: RationalPoly) -> RationalPoly:
        return RationalPoly(self.rep * other.rep)

    def __call__(self, point: Poly | Scalar) -> Poly:
        if isinstance(point, (int, Fraction)):
            return RationalPoly(fmpq_poly([self.rep(point if type(point) is int else to_fmpq(point))]))
        if type(point) is not RationalPoly:
            return super().__call__(point)
        constant = point.degree <= 0  # evaluation is much faster than composition with a constant
        if not constant and self.degree > LARGE_DEGREE:
            foresee_move(self.degree * point.degree, self.height_bits(), point.height_bits())
        return RationalPoly(fmpq_poly([self.rep(point.rep[0])]) if constant else self.rep(point.rep))

    def _divmod(self, other: RationalPoly) -> tuple[RationalPoly, RationalPoly]:
        quotient, remainder = _long_division(self.rep, other.rep)
        return RationalPoly(quotient), RationalPoly(remainder)

    def exact_quotient(self, divisor: Poly) -> RationalPoly | None:
        if type(divisor) is not RationalPoly:
            return super().exact_quotient(divisor)
        if self.rep.degree() > _LOOK_DEGREE and divisor.rep.degree() > _LOOK_DEGREE:
            quotient = _exact_quotient(self.rep.numer(), divisor.rep.numer())
            return None if quotient is None else RationalPoly(quotient * fmpq(divisor.rep.denom(), self.rep.denom()))
        quotient, remainder = _long_division(self.rep, divisor.rep)
        return None if remainder else RationalPoly(quotient)

    def __pow__(self, exponent: int) -> RationalPoly:
        if exponent < 0:
            raise ValueError("a polynomial has no negative powers")
        if (degree := self.rep.degree() * exponent) > LARGE_DEGREE:
            check_duration(_PRODUCT_SECONDS * degree * exponent * self.height_bits(), f"a power of degree {degree}")
        return RationalPoly(self.rep**exponent)

    def __bool__(self) -> bool:
        return bool(self.rep)

    @property
    def is_monic(self) -> bool:
        return bool(self.rep.leading_coefficient() == 1)

    def _gcd(self, other: RationalPoly) -> RationalPoly:
        if self.degree > LARGE_DEGREE and other.degree > LARGE_DEGREE:
            degree, least = sorted((self.degree, other.degree), reverse=True)
            seconds = _QUOTIENT_SECONDS * degree**2 * min(self.height_bits(), other.height_bits())
            if seconds > watched_seconds(inf):  # coprime ones take a moment only, and one prime tells
                f, g = (nmod_poly(part.rep.numer().coeffs(), next(primes())) for part in (self, other))
                common = int(f.gcd(g).degree())  # at least that over Q, unless p divides both leading coefficients
                check_duration(seconds * common / least, f"the gcd of polynomials of degree {degree} and {least}")
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
        if modulus.degree > _EUCLID_OVER_Q:
            return inverse_by_primes(self, modulus)  # type: ignore[no-any-return]
        common, inverse, _ = self.rep.xgcd(modulus.rep)  # type: ignore[attr-defined]
        if common.degree() > 0:
            raise ZeroDivisionError("not invertible: the polynomials have a common factor")
        return RationalPoly(inverse)

    def derivative(self) -> RationalPoly:
        return RationalPoly(self.rep.derivative())

    def inverse(self) -> RationalPoly:
        if self.degree > 0:
            raise ValueError("only constants have an inverse")
        return RationalPoly(fmpq_poly([1 / self.rep[0]]))

    def coefficients(self) -> tuple[Fraction, ...]:
        """The coefficients from low to high."""
        return tuple(to_fraction(c) for c in self.rep.coeffs())

    def square_part(self) -> tuple[Fraction, int]:
        return square_part(self.constant())

    def rational_coefficients(self) -> tuple[Any, ...]:
        return tuple(self.rep.coeffs())

    def content(self) -> tuple[int, int]:
        return int(self.rep.numer().content()) or 1, int(self.rep.denom())

    def height_bits(self) -> int:
        return max(int(self.rep.numer().height_bits()), int(self.rep.denom()).bit_length())

    def coefficient_strings(self) -> list[str]:
        written = []
        for coefficient in self.rep.numer().coeffs():
            check_time()
            written.append(str(coefficient))  # Python prints integers of at most 4300 digits
        return written

    def to_sympy(self, variable: Any) -> Any:
        from sympy import Add, Rational

        return Add(*(Rational(int(c.p), int(c.q)) * variable**k for k, c in enumerate(self.rep.coeffs()) if c))

    def constant(self) -> Fraction:
        """The constant coefficient."""
        return to_fraction(self.rep[0])


_set_rep = RationalPoly.__dict__["rep"].__set__


def _rational_poly_from_key(numerators: tuple[int, ...], denominator: int) -> RationalPoly:
    return RationalPoly(fmpq_poly(fmpz_poly(list(numerators)), denominator))


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


class RationalField(Field):
    """The field Q of rational numbers: `QQ` is its only instance, so that comparing fields costs nothing."""

    __slots__ = ()

    def __reduce__(self) -> str:
        return "QQ"

    def poly(self, coefficients: Iterable[Scalar | Poly]) -> RationalPoly:
        return RationalPoly(fmpq_poly([c if type(c) is int else _flint_scalar(c) for c in coefficients]))

    def rational_value(self, constant: Poly) -> Fraction | None:
        return to_fraction(constant.rep[0])  # type: ignore[attr-defined]

    def extends(self, other: Field) -> bool:
        return False

    def embed(self, polynomial: Poly) -> Poly:
        return polynomial

    def _factors(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        check_time()
        numerator = polynomial.rep.numer()  # type: ignore[attr-defined]
        if _may_take_long(numerator):
            # It may take hours, for x^5040 - 1 or where many factors lie modulo p.
            from kovacic.process import computed_apart

            what = f"factors of a polynomial of degree {numerator.degree()}"
            found = computed_apart(what, _integer_factors, _integer_coefficients(numerator))
            factors = [(fmpz_poly(list(factor)), k) for factor, k in found]
        else:
            factors = numerator.factor()[1]
        if len(factors) > 1:
            factors.sort(key=lambda pair: (pair[0].degree(), _integer_coefficients(pair[0])))
        return [(RationalPoly(fmpq_poly(f, f.leading_coefficient())), k) for f, k in factors]

    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        return ((RationalHomomorphism(p),) for p in primes() if allowed is None or allowed(p))

    def collector(self, shape: tuple[int, ...]) -> Collector:
        return Residues(shape)

    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        return [RationalPoly(c) for c in coordinates]

    def sqrt(self, constant: Poly) -> Poly | None:
        value = constant.rep[0]  # type: ignore[attr-defined]
        if value < 0 or not value.p.is_square() or not value.q.is_square():
            return None
        return RationalPoly(fmpq_poly([value.p.isqrt()], value.q.isqrt()))

    def __str__(self) -> str:
        return "Q"

    def __repr__(self) -> str:
        return "RationalField()"


def foresee_move(degree: int, bits: int, point_bits: int) -> None:
    """Raise `LimitExceeded` if there isn't the time to expand a polynomial, with coefficients of this size, around a point."""
    written = degree * (bits + degree * point_bits)
    what = f"a polynomial of degree {degree} around a point of {point_bits} bits"
    check_duration(_TRANSLATION_SECONDS * float(written) ** _MOVE_POWER, what)


def _long_division(dividend: Any, divisor: Any) -> tuple[Any, Any]:
    """Quotient and remainder, in pieces of the dividend where that takes long, with a look at the clock between them.

    FLINT's division over Q multiplies by powers of the divisor's leading coefficient even where that is 1, and takes many times
    as long as that over Z.
    """
    size = divisor.degree()
    if dividend.degree() <= _LOOK_DEGREE or dividend.degree() < size or size <= 0:
        return divmod(dividend, divisor)  # type: ignore[no-any-return]
    check_time()
    if not any(divisor.coeffs()[:-1]):  # c x^n, by which FLINT divides as by any other polynomial
        return dividend.right_shift(size) / divisor[size], dividend.mul_low(fmpq_poly([1]), size)
    over_integers = divisor.numer().leading_coefficient() == 1
    above, below = (dividend.numer(), divisor.numer()) if over_integers else (dividend, divisor)
    quotient, rest = _divided_in_pieces(above, below)
    if not over_integers:
        return quotient, rest
    scale = fmpq(1, dividend.denom())
    return fmpq_poly(quotient) * (divisor.denom() * scale), fmpq_poly(rest) * scale


def _exact_quotient(dividend: Any, divisor: Any) -> Any:
    """The quotient of integer polynomials where over Q there is no remainder, else None; over Z, where numbers stay short.

    By Gauss's lemma the quotient of the primitive parts is one over Z, and so is each piece of it; FLINT's division over Z,
    which rounds, then doesn't have to.
    """
    check_time()
    size = divisor.degree()
    below = nmod_poly(divisor, next(primes()))
    if below.degree() == size and nmod_poly(dividend, below.modulus()) % below:  # a remainder modulo p, and so over Q
        return None
    bits = divisor.height_bits()
    seconds = _QUOTIENT_SECONDS * size * (dividend.degree() - size) * bits
    check_duration(seconds, f"a division by a polynomial of degree {size} with {bits} bits")
    contents = dividend.content(), divisor.content()
    above, below = (part / content for part, content in zip((dividend, divisor), contents, strict=True))
    quotient, rest = _divided_in_pieces(above, below)
    return None if rest else fmpq_poly(quotient) * fmpq(*contents)


def _divided_in_pieces(dividend: Any, divisor: Any) -> tuple[Any, Any]:
    """Quotient and remainder, by some leading coefficients of the dividend at a time, each piece behind the last remainder."""
    size = max(divisor.degree() // _PIECES_OF_A_DIVISION, _LOOK_DEGREE)
    coefficients = dividend.coeffs()
    ring = type(dividend)
    quotient = rest = ring([])
    for end in range(len(coefficients), 0, -size):
        check_time()
        begin = max(0, end - size)
        piece = rest.left_shift(end - begin) + ring(coefficients[begin:end])
        part, rest = divmod(piece, divisor)
        quotient = quotient.left_shift(end - begin) + part
    return quotient, rest


def _may_take_long(polynomial: Any) -> bool:
    """True if the factorisation might overrun the time that is left; its factors modulo a prime tell for moderate degrees."""
    degree = polynomial.degree()
    if degree > LARGE_DEGREE:
        return watched_seconds(inf) < inf
    if not may_be_late(_FACTOR_SECONDS * degree**3):
        return False
    _, factors = nmod_poly(polynomial, next(primes())).factor()
    return len(factors) > _FEW_MODULAR_FACTORS or any(k > 1 for _, k in factors)  # a few modulo p are soon put together


def _integer_factors(coefficients: tuple[int, ...]) -> list[tuple[tuple[int, ...], int]]:
    """The factors of an integer polynomial, in a form that pickles."""
    return [(_integer_coefficients(f), k) for f, k in fmpz_poly(list(coefficients)).factor()[1]]


def _integer_coefficients(polynomial: Any) -> tuple[int, ...]:
    return tuple([int(c) for c in polynomial.coeffs()])


def _flint_scalar(value: Scalar | Poly) -> Any:
    return value.rep[0] if isinstance(value, RationalPoly) else to_fmpq(value)  # type: ignore[arg-type]


QQ = RationalField()
RationalPoly.field = QQ

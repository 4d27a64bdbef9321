"""Exact arithmetic on what a user wrote, with every size predicted and checked before it is computed.

Values are terms c*x^n with a small rational c, polynomials, and rational functions in lowest terms.  In a sum monomials are
collected by their powers, and everything else is added by halves: most of the n additions of fractions are small ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import zip_longest
from math import comb, prod
from typing import TypeVar

from flint import fmpq_poly, fmpz

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly, to_fmpq
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Limits, check_time

T = TypeVar("T")

# A polynomial may have at most this many times `Limits.bits` bits in all its coefficients together.
_TOTAL_FACTOR = 100

# Above this size, flint's numbers are faster than Python's.
_SMALL_BITS = 2048

# Bits of the integers that are printed: Python prints at most 4300 digits.
PRINTED_BITS = 14_000


@dataclass(eq=False, slots=True)
class Monomial:
    """`coefficient * x**power`, the coefficient an integer or fraction of at most `_SMALL_BITS` bits; never changed."""

    coefficient: int | Fraction
    power: int


VARIABLE = Monomial(1, 1)
Value = Monomial | Poly | RatFunc


class NotAnInteger(ValueError):
    """The exponent of a power isn't an integer constant."""


class Arithmetic:
    """Sums, products, quotients and powers within `limits`.

    Every method raises `LimitExceeded` before it computes what would be too large, and `ZeroDivisionError` where the
    result isn't defined.
    """

    def __init__(self, limits: Limits = DEFAULT_LIMITS) -> None:
        self.limits = limits

    def integer(self, digits: str) -> int:
        if digits[self.limits.digits :]:
            raise LimitExceeded(f"{len(digits)} digits, above the limit of {self.limits.digits}", limit="digits")
        return int(fmpz(digits))  # Python reads integers of at most 4300 digits

    def signed_integer(self, text: str) -> int:
        return -self.integer(text[1:]) if text[0] == "-" else self.integer(text.lstrip("+"))

    def constant(self, value: int | Fraction) -> Value:
        self._check(0, _bits(value))
        return _scaled_power(value, 0)

    def decimal(self, text: str) -> Poly:
        """The rational number that a decimal such as 1.5e-3 denotes."""
        mantissa, _, scale = text.lower().partition("e")
        whole, _, digits = mantissa.partition(".")
        power = -len(digits)
        if scale:
            power += self.signed_integer(scale)
        if abs(power) > self.limits.digits:
            raise LimitExceeded(f"over {self.limits.digits} digits, the limit", limit="digits")
        return QQ.poly([self.integer(whole + digits) * 10 ** max(power, 0)]) * QQ.poly([10 ** max(-power, 0)]).inverse()

    def number(self, value: Value) -> Fraction | None:
        closed = self.closed(value)
        if isinstance(closed, Poly) and closed.is_constant:
            return closed.field.rational_value(closed)
        return None

    def rational(self, value: Value) -> RatFunc:
        """The value as a rational function in lowest terms."""
        closed = self.closed(value)
        return closed if isinstance(closed, RatFunc) else RatFunc(closed)

    def negate(self, value: Value) -> Value:
        if isinstance(value, Monomial):
            return Monomial(-value.coefficient, value.power)
        return -self.closed(value)

    def sum(self, terms: Sequence[Value]) -> Value:
        if len(terms) == 1:
            return terms[0]
        coefficients: dict[int, int | Fraction] = {}  # of the monomials, by their powers
        polynomials: list[Poly] = []
        fractions: list[RatFunc] = []
        for term in terms:
            # A sum too long for Python's numbers stays unevaluated.
            if isinstance(term, Monomial) and _bits(known := coefficients.get(term.power, 0)) <= _SMALL_BITS:
                coefficients[term.power] = known + term.coefficient
                continue
            part = self.closed(term)
            if isinstance(part, RatFunc):
                fractions.append(part)
            else:
                polynomials.append(part)
        polynomials.append(QQ.poly([coefficients.get(k, 0) for k in range(max(coefficients, default=-1) + 1)]))
        polynomial = _total(polynomials, self._poly_sum)
        if not fractions:
            return polynomial
        fraction = _total(fractions, self._ratfunc_sum)
        if polynomial:  # the sum needs no reduction
            num = self._poly_sum(fraction.num, self._product(polynomial, fraction.den))
            fraction = RatFunc(num, fraction.den.over(num.field), reduced=True)
        return fraction.num if fraction.is_polynomial else fraction

    def multiply(self, left: Value, right: Value) -> Value:
        if isinstance(left, Monomial) and isinstance(right, Monomial):
            power = left.power + right.power
            self._check(power, 0)
            return _scaled_power(left.coefficient * right.coefficient, power)
        a, b = self.rational(left), self.rational(right)
        num = self._product(a.num, b.num)
        return num if a.is_polynomial and b.is_polynomial else RatFunc(num, self._product(a.den, b.den))

    def divide(self, left: Value, right: Value) -> Value:
        if isinstance(left, Monomial) and isinstance(right, Monomial) and right.coefficient and right.power == 0:
            return _scaled_power(Fraction(left.coefficient, right.coefficient), left.power)
        a, b = self.rational(left), self.rational(right)
        if not b:
            raise ZeroDivisionError("division by zero")
        quotient = RatFunc(self._product(a.num, b.den), self._product(b.num, a.den))
        return quotient.num if quotient.is_polynomial else quotient

    def power(self, base: Value, exponent: Value | int) -> Value:
        """`base ** exponent`; raises `NotAnInteger` if the exponent isn't an integer constant."""
        n = self._integer_of(exponent)
        if abs(n) > self.limits.exponent:
            shown = str(n) if abs(n) < 10**20 else f"of {n.bit_length()} bits"
            raise LimitExceeded(f"an exponent {shown}, above the limit of {self.limits.exponent}", limit="exponent")
        if (
            isinstance(base, Monomial)
            and n > 0
            and (base.coefficient == 1 or n * _bits(base.coefficient) <= _SMALL_BITS)
        ):
            self._check(base.power * n, 0)
            return Monomial(base.coefficient**n, base.power * n)
        base = self.closed(base)
        if n <= 0 and not base:
            raise ZeroDivisionError("0 has no powers with exponent zero or below")
        if n == 0:
            return Monomial(1, 0)
        if n < 0:
            base = self.rational(self.divide(Monomial(1, 0), base))
        if isinstance(base, Poly):
            return self._poly_power(base, n)
        # Powers of what is in lowest terms are, too.
        power = RatFunc(self._poly_power(base.num, abs(n)), self._poly_power(base.den, abs(n)), reduced=True)
        return power.num if power.is_polynomial else power

    def closed(self, value: Value) -> Poly | RatFunc:
        return _monomial(value.coefficient, value.power) if isinstance(value, Monomial) else value

    def _poly_sum(self, left: Poly, right: Poly) -> Poly:
        self._check(max(left.degree, right.degree), left.height_bits() + right.height_bits() + 1)
        return left + right

    def _ratfunc_sum(self, left: RatFunc, right: RatFunc) -> RatFunc:
        if left.den == right.den:
            return RatFunc(self._poly_sum(left.num, right.num), left.den)
        num = self._poly_sum(self._product(left.num, right.den), self._product(right.num, left.den))
        return RatFunc(num, self._product(left.den, right.den))

    def _product(self, left: Poly, right: Poly) -> Poly:
        if right == 1:
            self._check(left.degree, left.height_bits() + 2)
            return left
        m = left.degree
        n = right.degree
        carries = (min(m, n) + 1).bit_length()
        self._check(m + n, left.height_bits() + right.height_bits() + carries)
        self._check_terms((left, 1), (right, 1))
        return left * right

    def _poly_power(self, base: Poly, n: int) -> Poly:
        if n == 1:
            return base
        if base.is_constant:
            bits = n * base.height_bits()
        else:  # height(P**n) <= |P|_1**n, the sum of the moduli of the coefficients
            denominator = base.content()[1]
            norm = sum(abs(int(c.p)) * (denominator // int(c.q)) for c in base.rational_coefficients())
            bits = n * max((norm - 1).bit_length(), (denominator - 1).bit_length())
        self._check(n * base.degree, bits)
        self._check_terms((base, n))
        return base**n

    def _check(self, degree: int, bits: int) -> None:
        limits = self.limits
        if degree > limits.degree:
            raise LimitExceeded(f"a degree of up to {degree}, above the limit of {limits.degree}", limit="degree")
        if bits > limits.bits:
            raise LimitExceeded(f"coefficients of up to {bits} bits, above the limit of {limits.bits}", limit="bits")
        most = _TOTAL_FACTOR * limits.bits
        if (degree + 1) * bits > most:
            size = f"up to {degree + 1} coefficients of up to {bits} bits"
            raise LimitExceeded(f"{size}, above the limit of {most} bits for all together", limit="bits")

    def _check_terms(self, *factors: tuple[Poly, int]) -> None:
        """Refuses products of powers P^n, as pairs (P, n), with too many terms in x and the parameters.

        (t_1 + ... + t_m)^n has at most C(n + m - 1, n) terms, and no product more than its degrees leave room for.
        """
        if all(isinstance(factor, RationalPoly) for factor, _ in factors):
            return  # the degree is checked
        check_time()
        sparse = 1
        degrees: list[int] = []
        for factor, n in factors:
            terms, of_factor = factor.extent()
            sparse *= comb(n + terms - 1, n)
            degrees = [n * d + e for d, e in zip_longest(of_factor, degrees, fillvalue=0)]
        terms = min(sparse, prod(d + 1 for d in degrees))
        if terms > self.limits.terms:
            raise LimitExceeded(f"up to {terms:,} terms, above the limit of {self.limits.terms:,}", limit="terms")

    def _integer_of(self, exponent: Value | int) -> int:
        if isinstance(exponent, int):
            return exponent
        if isinstance(exponent, Monomial) and exponent.power == 0 and isinstance(exponent.coefficient, int):
            return exponent.coefficient
        number = self.number(exponent)
        if number is None or number.denominator != 1:
            raise NotAnInteger
        return number.numerator


def _total(parts: Sequence[T], add: Callable[[T, T], T]) -> T:
    """The sum of at least one part, by halves."""
    half = len(parts) // 2
    if not half:
        return parts[0]
    return add(_total(parts[:half], add), _total(parts[half:], add))


def _bits(value: int | Fraction) -> int:
    return (
        value.bit_length() if type(value) is int else max(value.numerator.bit_length(), value.denominator.bit_length())
    )


def _scaled_power(coefficient: int | Fraction, power: int) -> Monomial | Poly:
    """`coefficient * x**power`; a whole fraction becomes an integer."""
    if type(coefficient) is not int and coefficient.denominator == 1:
        coefficient = coefficient.numerator
    if _bits(coefficient) <= _SMALL_BITS:
        return Monomial(coefficient, power)
    return _monomial(coefficient, power)


def _monomial(coefficient: int | Fraction, power: int) -> Poly:
    check_time()
    return RationalPoly(fmpq_poly([to_fmpq(coefficient)]).left_shift(power))

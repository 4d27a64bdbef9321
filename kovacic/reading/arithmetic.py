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
from typing import Any, TypeVar

from flint import fmpq, fmpq_poly, fmpz

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Limits, check_time, demand

T = TypeVar("T")

# A polynomial may have at most this many times `Limits.bits` bits in all its coefficients together.
_TOTAL_FACTOR = 100

# Bits of the integers that are printed: Python prints at most 4300 digits.
PRINTED_BITS = 14_000


@dataclass(eq=False, slots=True)
class Monomial:
    """`coefficient * x**power`, never changed."""

    coefficient: fmpq
    power: int


ZERO, ONE, VARIABLE = Monomial(fmpq(0), 0), Monomial(fmpq(1), 0), Monomial(fmpq(1), 1)
Value = Monomial | Poly | RatFunc


class NotAnInteger(ValueError):
    """The exponent of a power isn't an integer constant."""


class Arithmetic:
    """Sums, products, quotients and powers within `limits`.

    Every method raises `LimitExceeded` before it computes a result that is too large, and `ZeroDivisionError` if there is none.
    """

    def __init__(self, limits: Limits = DEFAULT_LIMITS) -> None:
        self.limits = limits

    def integer(self, text: str) -> int:
        demand(self.limits, "digits", len(text.lstrip("+-")), "{} digits")
        return int(fmpz(text.lstrip("+")))  # Python reads integers of at most 4300 digits

    def constant(self, numerator: Any, denominator: Any = 1) -> Value:
        number = fmpq(int(numerator), int(denominator))
        self._check(0, number.height_bits())
        return Monomial(number, 0)

    def decimal(self, text: str) -> fmpq:
        """The rational number that a decimal such as 1.5e-3, or an integer, denotes."""
        mantissa, _, scale = text.lower().partition("e")
        whole, _, digits = mantissa.partition(".")
        power = -len(digits)
        if scale:
            power += self.integer(scale)
        demand(self.limits, "digits", abs(power), "{} digits")
        return fmpq(self.integer(whole + digits)) * fmpq(10) ** power

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
        coefficients: dict[int, list[fmpq]] = {}  # of the monomials, by their powers
        polynomials: list[Poly] = []
        fractions: list[RatFunc] = []
        for term in terms:
            if isinstance(term, Monomial):
                coefficients.setdefault(term.power, []).append(term.coefficient)
            elif isinstance(term, RatFunc):
                fractions.append(term)
            else:
                polynomials.append(term)
        numbers = [fmpq(0)] * (max(coefficients, default=-1) + 1)
        for power, summands in coefficients.items():
            numbers[power] = _total(summands, self._number_sum)
        check_time()
        polynomial = _total([*polynomials, RationalPoly(fmpq_poly(numbers))], self._poly_sum)
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
            self._check(power, left.coefficient.height_bits() + right.coefficient.height_bits())
            return Monomial(left.coefficient * right.coefficient, power)
        a, b = self.rational(left), self.rational(right)
        num = self._product(a.num, b.num)
        return num if a.is_polynomial and b.is_polynomial else RatFunc(num, self._product(a.den, b.den))

    def divide(self, left: Value, right: Value) -> Value:
        if isinstance(left, Monomial) and isinstance(right, Monomial) and right.coefficient and right.power == 0:
            self._check(left.power, left.coefficient.height_bits() + right.coefficient.height_bits())
            return Monomial(left.coefficient / right.coefficient, left.power)
        a, b = self.rational(left), self.rational(right)
        if not b:
            raise ZeroDivisionError("division by zero")
        quotient = RatFunc(self._product(a.num, b.den), self._product(b.num, a.den))
        return quotient.num if quotient.is_polynomial else quotient

    def power(self, base: Value, exponent: Value | int) -> Value:
        """`base ** exponent`; raises `NotAnInteger` if the exponent isn't an integer constant."""
        n = self._integer_of(exponent)
        demand(self.limits, "exponent", abs(n), "an exponent {}")
        if isinstance(base, Monomial) and n > 0:
            height = max(abs(base.coefficient.p), base.coefficient.q)
            self._check(base.power * n, n * int(height - 1).bit_length())
            return Monomial(base.coefficient**n, base.power * n)
        base = self.closed(base)
        if n <= 0 and not base:
            raise ZeroDivisionError("0 has no powers with exponent zero or below")
        if n == 0:
            return ONE
        if n < 0:
            base = self.rational(self.divide(ONE, base))
        if isinstance(base, Poly):
            return self._poly_power(base, n)
        # Powers of a fraction in lowest terms are in lowest terms.
        power = RatFunc(self._poly_power(base.num, abs(n)), self._poly_power(base.den, abs(n)), reduced=True)
        return power.num if power.is_polynomial else power

    def closed(self, value: Value) -> Poly | RatFunc:
        if isinstance(value, Monomial):
            return RationalPoly(fmpq_poly([value.coefficient]).left_shift(value.power))
        return value

    def _number_sum(self, left: fmpq, right: fmpq) -> fmpq:
        self._check(0, left.height_bits() + right.height_bits() + 1)
        return left + right

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
        demand(self.limits, "degree", degree, "a degree of up to {}")
        demand(self.limits, "bits", bits, "coefficients of up to {} bits")
        most = _TOTAL_FACTOR * self.limits.bits
        if (degree + 1) * bits > most:
            size = f"up to {degree + 1} coefficients of up to {bits} bits"
            raise LimitExceeded(f"{size}, above the limit of {most} bits for all together", limit="bits")

    def _check_terms(self, *factors: tuple[Poly, int]) -> None:
        """Refuse a product of powers P^n, given as pairs (P, n), with too many terms in x and the parameters.

        (t_1 + ... + t_m)^n has at most C(n + m - 1, n) terms; the degrees give another bound.
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
        demand(self.limits, "terms", min(sparse, prod(d + 1 for d in degrees)), "up to {} terms")

    def _integer_of(self, exponent: Value | int) -> int:
        if isinstance(exponent, int):
            return exponent
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

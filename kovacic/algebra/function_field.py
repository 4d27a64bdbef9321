"""Rational functions of parameters as coefficients: the field Q(t1, ..., tk), for generic parameters.

A polynomial over Q(t) is one polynomial in x and the t's over Z, divided by one in the t's alone; flint's sparse
polynomials stay inside.  A homomorphism to F_p gives the parameters random values; the way back is in `interpolation`.
An element is zero only as a function: what holds over Q(t) holds for generic values of the parameters.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, reduce
from random import Random
from typing import Any

from flint import Ordering, fmpz_mpoly_ctx

from kovacic.algebra.homomorphism import Collector, Homomorphism
from kovacic.algebra.interpolation import Evaluation, Samples
from kovacic.algebra.lifting import primes
from kovacic.algebra.poly import Field, Poly, Scalar
from kovacic.algebra.rationals import QQ, RationalPoly, square_part
from kovacic.algebra.sparse import (
    by_power,
    constant_term,
    factorisation,
    laurent_constant,
    sparse_square_root,
    terms_of,
)
from kovacic.limits import check_time

#: Samples modulo the second prime; there are more modulo each later one, as the answers that need them are longer.
_FIRST_QUOTA = 32


@cache
def _ring(parameters: int) -> Any:
    return fmpz_mpoly_ctx.get(("x", *(f"t{i}" for i in range(parameters))), Ordering.lex)


@dataclass(frozen=True, slots=True)
class FunctionField(Field):
    """The field Q(t1, ..., tk), `names` being the names of the parameters."""

    names: tuple[str, ...]

    @property
    def context(self) -> Any:
        """flint's ring Z[x, t1, ..., tk], ordered by powers of x first; its own names are never printed."""
        return _ring(len(self.names))

    def generator(self, name: str) -> FunctionPoly:
        """The parameter of this name."""
        return FunctionPoly(self, self.context.gen(1 + self.names.index(name)), self.context.constant(1))

    def make(self, num: Any, den: Any) -> FunctionPoly:
        """num/den in lowest terms; den is free of x and not zero."""
        if den.is_one():
            return FunctionPoly(self, num, den)
        if num.is_zero():
            return FunctionPoly(self, num, self.context.constant(1))
        check_time()
        common = num.gcd(den)
        if not common.is_one():
            num = num // common
            den = den // common
        if int(den.leading_coefficient()) < 0:
            num = -num
            den = -den
        return FunctionPoly(self, num, den)

    def poly(self, coefficients: Iterable[Scalar | Poly]) -> FunctionPoly:
        total = self.make(self.context.constant(0), self.context.constant(1))
        power = self.context.constant(1)
        x = self.context.gen(0)
        for coefficient in coefficients:
            if coefficient:
                if isinstance(coefficient, Poly):
                    one = coefficient if isinstance(coefficient, FunctionPoly) else self.embed(coefficient[0])
                else:
                    constant = self.context.constant
                    one = self.make(constant(coefficient.numerator), constant(coefficient.denominator))
                total = total._add(self.make(one.num * power, one.den))
            power = power * x
        return total

    def extends(self, other: Field) -> bool:
        return not isinstance(other, FunctionField) and other.absolute_degree == 1

    def embed(self, polynomial: Poly) -> FunctionPoly:
        if not isinstance(polynomial, RationalPoly):
            raise TypeError("a polynomial over Q is expected")
        num = polynomial.rep.numer()
        den = polynomial.rep.denom()
        k = len(self.names)
        terms = {(i, *[0] * k): c for i, c in enumerate(num.coeffs()) if c}
        return FunctionPoly(self, self.context.from_dict(terms), self.context.constant(den))

    def _factors(self, polynomial: Poly) -> list[tuple[Poly, int]]:
        assert isinstance(polynomial, FunctionPoly)
        factors: list[tuple[Poly, int]]
        if any(polynomial.num.degrees()[1:]):
            one = self.context.constant(1)
            factors = [
                (FunctionPoly(self, factor, one).monic(), k)
                for factor, k in factorisation(polynomial.num)[1]
                if factor.degrees()[0] > 0
            ]
        else:  # without parameters
            numbers = {int(exponents[0]): int(c) for exponents, c in polynomial.num.to_dict().items()}
            over_q = QQ.poly([numbers.get(k, 0) for k in range(max(numbers, default=-1) + 1)])
            factors = [(self.embed(factor), k) for factor, k in QQ.factor(over_q)]
        return sorted(factors, key=lambda pair: (pair[0].degree, str(pair[0])))

    def bundles(self, allowed: Callable[[int], bool] | None = None) -> Iterator[tuple[Homomorphism, ...]]:
        """Random points, most of them modulo the first prime, which is enough for functions with small coefficients."""
        usable = (p for p in primes() if allowed is None or allowed(p))
        first = next(usable)
        quota = _FIRST_QUOTA
        random = Random(20240229)
        for other in usable:
            for p in (first, first, first, other) * quota:
                check_time()
                yield (Evaluation(p, tuple(random.randrange(p) for _ in self.names)),)
            quota += quota // 4

    def collector(self, shape: tuple[int, ...]) -> Collector:
        return Samples(len(self.names), shape)

    def assemble(self, coordinates: Sequence[Any]) -> list[Poly]:
        def sparse(terms: dict[tuple[int, ...], int]) -> Any:
            return self.context.from_dict({(0, *exponents): c for exponents, c in terms.items()})

        return [self.poly([self.make(sparse(num), sparse(den)) for num, den in one]) for one in coordinates]

    def rational_value(self, constant: Poly) -> Fraction | None:
        assert isinstance(constant, FunctionPoly)
        if constant.num.is_constant() and constant.den.is_constant():
            return Fraction(constant_term(constant.num), constant_term(constant.den))
        return None

    def sqrt(self, constant: Poly) -> Poly | None:
        """A square root; the one whose numerator has a positive leading coefficient."""
        assert isinstance(constant, FunctionPoly)
        if not constant:
            return constant
        roots = [sparse_square_root(part) for part in (constant.num, constant.den)]
        return None if roots[0] is None or roots[1] is None else self.make(roots[0], roots[1])

    def cleared(self, num: Poly, den: Poly) -> tuple[Poly, Poly]:
        leaves: list[Any] = [leaf for polynomial in (num, den) for leaf in polynomial.leaves() if leaf]
        if not leaves:
            return num, den
        multiple = reduce(lambda m, leaf: m * (leaf.den // m.gcd(leaf.den)), leaves, self.context.constant(1))
        contents = [leaf.numerator_content() * (multiple // leaf.den) for leaf in leaves]
        scale: Poly = self.make(multiple, reduce(lambda a, b: a.gcd(b), contents, self.context.constant(0)))
        if int((leaves[-1] * scale).num.leading_coefficient()) < 0:  # that of the denominator, if it isn't zero
            scale = -scale
        return num * scale, den * scale

    def __str__(self) -> str:
        return f"Q({', '.join(self.names)})"


class FunctionPoly(Poly):
    """A polynomial in x over Q(t): `num/den` in lowest terms, den in Z[t] with a positive leading coefficient."""

    __slots__ = ("den", "field", "num")

    field: FunctionField
    num: Any
    den: Any

    def __init__(self, field: FunctionField, num: Any, den: Any) -> None:
        object.__setattr__(self, "field", field)
        object.__setattr__(self, "num", num)
        object.__setattr__(self, "den", den)

    def __reduce__(self) -> tuple[Any, ...]:
        return _from_key, (self.field, *self.key())

    def key(self) -> tuple[Any, ...]:
        return terms_of(self.num), terms_of(self.den)

    @property
    def degree(self) -> int:
        return -1 if self.num.is_zero() else int(self.num.degrees()[0])

    def extent(self) -> tuple[int, tuple[int, ...]]:
        degrees = zip(self.num.degrees(), self.den.degrees(), strict=True)
        return max(len(self.num), len(self.den)), tuple(int(max(pair)) for pair in degrees)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, FunctionPoly) and (other.field is self.field or other.field == self.field):
            return bool(self.num == other.num and self.den == other.den)
        return super().__eq__(other)

    __hash__ = Poly.__hash__

    @property
    def is_monic(self) -> bool:
        return bool(self.num) and bool((self.num if self.degree == 0 else self._columns()[-1]) == self.den)

    def __getitem__(self, power: int) -> FunctionPoly:
        terms = {(0, *e[1:]): c for e, c in self.num.to_dict().items() if e[0] == power}
        return self.field.make(self.field.context.from_dict(terms), self.den)

    def __iter__(self) -> Iterator[FunctionPoly]:
        return iter(self.coefficients())

    def coefficients(self) -> list[FunctionPoly]:
        """The coefficients from low to high."""
        return [self.field.make(c, self.den) for c in self._columns()]

    def _columns(self) -> list[Any]:
        """The coefficients of the powers of x in the numerator, as polynomials in the parameters."""
        columns = by_power(self.num, 0)
        zero = self.field.context.constant(0)
        return [columns.get(k, zero) for k in range(self.degree + 1)]

    def numerator_content(self) -> Any:
        """The greatest common divisor in Z[t] of the coefficients of the numerator."""
        return reduce(lambda a, b: a.gcd(b), self._columns(), self.field.context.constant(0))

    def __neg__(self) -> FunctionPoly:
        return FunctionPoly(self.field, -self.num, self.den)

    def _add(self, other: FunctionPoly) -> FunctionPoly:
        if self.den == other.den:
            return self.field.make(self.num + other.num, self.den)
        return self.field.make(self.num * other.den + other.num * self.den, self.den * other.den)

    def _mul(self, other: FunctionPoly) -> FunctionPoly:
        return self.field.make(self.num * other.num, self.den * other.den)

    def _divmod(self, other: FunctionPoly) -> tuple[FunctionPoly, FunctionPoly]:
        """The quotient and remainder; flint's division serves if there is no remainder."""
        content = other.numerator_content()
        quotient, remainder = divmod(self.num, other.num // content)
        if remainder:
            return super()._divmod(other)
        return self.field.make(quotient * other.den, self.den * content), self.field.poly([])

    def _gcd(self, other: FunctionPoly) -> FunctionPoly:
        return FunctionPoly(self.field, self.num.gcd(other.num), self.field.context.constant(1)).monic()

    def derivative(self) -> FunctionPoly:
        return self.field.make(self.num.derivative(0), self.den)

    def inverse(self) -> FunctionPoly:
        if self.degree > 0:
            raise ValueError("only constants have an inverse")
        if not self:
            raise ZeroDivisionError("zero has no inverse")
        negative = int(self.num.leading_coefficient()) < 0
        return FunctionPoly(self.field, -self.den if negative else self.den, -self.num if negative else self.num)

    def square_part(self) -> tuple[FunctionPoly, FunctionPoly]:
        """(c, d) for a constant other than 0: it is c^2 d, d a polynomial without squares of polynomials or integers."""
        number, factors = (self.num * self.den).factor_squarefree()
        outer, inner = square_part(Fraction(int(number)))
        c = self.field.context.constant(int(outer))
        d = self.field.context.constant(inner)
        for factor, exponent in factors:
            c = c * factor ** (int(exponent) // 2)
            d = d * factor ** (int(exponent) % 2)
        return self.field.make(c, self.den), self.field.make(d, self.field.context.constant(1))

    @property
    def is_written_with_minus(self) -> bool:
        """True if the leading coefficient is negative, in the order of the parameters."""
        return bool(self.num) and int(self.num.leading_coefficient()) < 0

    def to_sympy(self, variable: Any) -> Any:
        from sympy import Add, Mul, Pow, Symbol, pi

        # The parameter pi is the number: a field has no other letter of this name.
        symbols = [variable, *(pi if name == "pi" else Symbol(name) for name in self.field.names)]

        def expression(part: Any) -> Any:
            return Add(*(Mul(int(c), *map(Pow, symbols, map(int, powers))) for powers, c in part.to_dict().items()))

        return expression(self.num) / expression(self.den)

    def rational_coefficients(self) -> tuple[Any, ...]:
        """The images of the coefficients under a Q-linear map of Q(t) onto Q that is the identity on Q.

        The constant term of the iterated Laurent series at t1 = 0, then t2 = 0, ...
        """
        return tuple(laurent_constant(c.num, c.den, 1) for c in self.coefficients())

    def height_bits(self) -> int:
        values = [*self.num.coeffs(), *self.den.coeffs()]
        return max((int(c).bit_length() for c in values), default=0)

    def coefficient_strings(self) -> list[str]:
        check_time()
        texts = (str(c).replace("^", "**") for c in self._columns())
        return [re.sub(r"t(\d+)", lambda match: self.field.names[int(match[1])], text) for text in texts]

    def value_at(self, values: Sequence[Poly | Scalar], field: Field) -> Poly:
        """The polynomial over `field` in which the parameters have these values, constants of that field.

        Raises `ZeroDivisionError` if the denominator vanishes.
        """
        constants = [v if isinstance(v, Poly) else field.poly([v]) for v in values]
        below = _substitute(self.den, constants, field)
        if not below:
            raise ZeroDivisionError("a denominator vanishes at these values of the parameters")
        return _substitute(self.num, constants, field) / below


def _substitute(polynomial: Any, values: Sequence[Poly], field: Field) -> Poly:
    columns: dict[int, Poly] = {}
    powers: dict[tuple[int, int], Poly] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        term: Poly = field.poly([int(coefficient)])
        for i, exponent in enumerate(exponents[1:]):
            if exponent:
                if (i, exponent) not in powers:
                    powers[i, exponent] = values[i] ** int(exponent)
                term = term * powers[i, exponent]
        power = int(exponents[0])
        columns[power] = columns[power] + term if power in columns else term
    zero = field.zero
    return field.poly([columns.get(k, zero) for k in range(max(columns, default=-1) + 1)])


def _from_key(field: FunctionField, num: tuple[Any, ...], den: tuple[Any, ...]) -> FunctionPoly:
    context = field.context
    return FunctionPoly(field, context.from_dict(dict(num)), context.from_dict(dict(den)))

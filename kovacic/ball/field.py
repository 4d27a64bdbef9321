"""The differential field in which a rolling body's equations live: Q(parameters)(x), then sin u, then sqrt(E).

A meridian given by rational functions of cos u and sin u (or of u itself) needs two square roots and no more:

    K0 = Q(p1, ..., pk)(x),   K1 = K0(s), s^2 = 1 - x^2   (x = cos u, s = sin u),   K2 = K1(h), h^2 = E.

`Quotient` is an element of K0, reduced (multivariate polynomials of FLINT inside), and `Surd` an element `a + b r`
of a quadratic extension.  Both are immutable, compare exactly, and know nothing about mechanics.  The engine treats
rational functions of one variable; here the variable and the parameters play the same part, and so this small field
exists.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import sympy as sp
from flint import Ordering, fmpz_mpoly_ctx
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.sparse import factorisation
from kovacic.ball.irrational import sign
from kovacic.errors import InputError

Element: TypeAlias = "Quotient | Surd"


@dataclass(frozen=True, slots=True)
class Ring:
    """Z[p1, ..., pk, x]: the names of the parameters and, last, of the variable.

    `constants` are irrational numbers that belong to the field: generators under hidden names, before those of the
    parameters.  They may be algebraically dependent: an element is zero where its value is (`vanishes`).
    """

    names: tuple[str, ...]
    constants: tuple[sp.Expr, ...] = ()

    @property
    def generators(self) -> tuple[str, ...]:
        """The names of all generators, those of the constants first."""
        longer = "_" * max(map(len, self.names))
        return (*(f"c{longer}{k}" for k in range(len(self.constants))), *self.names)

    @property
    def context(self) -> Any:
        return fmpz_mpoly_ctx.get(self.generators, Ordering.lex)

    def vanishes(self, polynomial: Any) -> bool:
        """Whether a polynomial is zero, the constants having their values."""
        if polynomial.is_zero() or not self.constants:
            return bool(polynomial.is_zero())
        size = len(self.constants)
        values: dict[tuple[int, ...], sp.Expr] = {}
        for monomial, coefficient in polynomial.to_dict().items():
            powers = (base ** int(e) for base, e in zip(self.constants, monomial, strict=False) if e)
            rest = tuple(map(int, monomial[size:]))
            values[rest] = values.get(rest, sp.Integer(0)) + sp.Mul(int(coefficient), *powers)
        return all(sign(value) == 0 for value in values.values())

    def element(self, expression: sp.Expr) -> Quotient:
        """The quotient that a SymPy expression, rational in the names and the constants, stands for."""
        expression = expression.xreplace(dict(zip(self.constants, map(sp.Symbol, self.generators), strict=False)))
        numerator, denominator = sp.fraction(sp.together(expression))
        return Quotient.make(self, self._polynomial(numerator), self._polynomial(denominator))

    def _polynomial(self, expression: sp.Expr) -> tuple[Any, int]:
        """An integral polynomial and the positive integer by which it is to be divided."""
        symbols = [sp.Symbol(name) for name in self.generators]
        plain = expression.xreplace({symbol: sp.Symbol(symbol.name) for symbol in expression.free_symbols})
        try:
            polynomial = sp.Poly(plain, *symbols, domain=sp.QQ)
        except (sp.PolynomialError, sp.CoercionFailed) as error:
            raise InputError(
                f"{expression} isn't a polynomial in {', '.join(self.names)} over the rationals",
                hint="irrational numbers have to be real, and parameters of the body" if expression.is_number else None,
            ) from error
        scale, integral = polynomial.clear_denoms()
        terms = {monomial: int(c) for monomial, c in integral.terms() if c}
        return self.context.from_dict(terms), int(scale)


class Quotient:
    """A reduced fraction of two polynomials over Z; the denominator's leading coefficient is positive."""

    __slots__ = ("_den", "_num", "ring")

    def __init__(self, ring: Ring, num: Any, den: Any) -> None:
        common = num.gcd(den)
        num, den = num // common, den // common
        if den.leading_coefficient() < 0:
            num, den = -num, -den
        self.ring, self._num, self._den = ring, num, den

    @classmethod
    def make(cls, ring: Ring, num: tuple[Any, int], den: tuple[Any, int]) -> Quotient:
        if ring.vanishes(den[0]):
            raise ZeroDivisionError("the denominator is zero")
        return cls(ring, num[0] * den[1], den[0] * num[1])

    def constant(self, value: int) -> Quotient:
        one = self.ring.context.constant(1)
        return Quotient(self.ring, one * value, one)

    def _other(self, other: object) -> Quotient | None:
        if isinstance(other, Quotient):
            return other
        return self.constant(other) if isinstance(other, int) else None

    def __add__(self, other: object) -> Quotient:
        o = self._other(other)
        if o is None:
            return NotImplemented
        return Quotient(self.ring, self._num * o._den + o._num * self._den, self._den * o._den)

    def __neg__(self) -> Quotient:
        return Quotient(self.ring, -self._num, self._den)

    def __sub__(self, other: object) -> Quotient:
        o = self._other(other)
        return NotImplemented if o is None else self + (-o)

    def __rsub__(self, other: int) -> Quotient:
        return -self + other

    def __mul__(self, other: object) -> Quotient:
        o = self._other(other)
        return NotImplemented if o is None else Quotient(self.ring, self._num * o._num, self._den * o._den)

    __radd__, __rmul__ = __add__, __mul__

    def inverse(self) -> Quotient:
        if not self:
            raise ZeroDivisionError("inverse of zero")
        return Quotient(self.ring, self._den, self._num)

    def __truediv__(self, other: object) -> Quotient:
        o = self._other(other)
        return NotImplemented if o is None else self * o.inverse()

    def __rtruediv__(self, other: int) -> Quotient:
        return self.inverse() * other

    def __bool__(self) -> bool:
        return not self.ring.vanishes(self._num)

    def __eq__(self, other: object) -> bool:
        o = self._other(other)
        if o is None:
            return NotImplemented
        if self.ring.constants:
            return not self - o
        return bool(self._num == o._num and self._den == o._den)

    def __hash__(self) -> int:
        return hash(self.ring) if self.ring.constants else hash((self.ring, str(self._num), str(self._den)))

    def partial(self) -> Quotient:
        """The derivative with respect to the variable, the last name."""
        index = len(self.ring.generators) - 1
        num, den = self._num, self._den
        return Quotient(self.ring, num.derivative(index) * den - num * den.derivative(index), den * den)

    def square_root(self) -> Quotient | None:
        """The root in the same field that is positive at a sample point (parameters positive), or None."""
        try:
            root = Quotient(self.ring, self._num.sqrt(), self._den.sqrt())
        except DomainError:  # not a square
            return None
        sample = {sp.Symbol(name): sp.Rational(k + 3, k + 2) for k, name in enumerate(self.ring.names[:-1])}
        sample[sp.Symbol(self.ring.names[-1])] = sp.Rational(1, 3)
        return -root if root.expression().subs(sample) < 0 else root

    def at_half_angle(self) -> Quotient:
        """The quotient at x = (1 - t^2)/(1 + t^2), with t under the same name as x."""
        sides = []
        degree = max(side.degrees()[-1] for side in (self._num, self._den))
        t = self.ring.context.gens()[-1]
        for side in (self._num, self._den):
            powers: dict[int, dict[tuple[int, ...], Any]] = {}
            for monomial, coefficient in side.to_dict().items():
                powers.setdefault(int(monomial[-1]), {})[(*monomial[:-1], 0)] = coefficient
            terms = (
                self.ring.context.from_dict(c) * (1 - t**2) ** k * (1 + t**2) ** (degree - k) for k, c in powers.items()
            )
            sides.append(sum(terms, self.ring.context.constant(0)))
        return Quotient(self.ring, sides[0], sides[1])

    def expression(self) -> sp.Expr:
        """The quotient as a SymPy expression, each side expanded."""
        num, den = (_expression(self.ring, side) for side in (self._num, self._den))
        return num / den

    def coefficients(self) -> tuple[list[int], list[int]] | None:
        """Numerator and denominator as coefficients of x, low to high; None if a parameter occurs."""
        sides: list[list[int]] = []
        for side in (self._num, self._den):
            degrees = side.degrees()
            if any(degrees[:-1]):
                return None
            values = [0] * (int(degrees[-1]) + 1)
            for monomial, coefficient in side.to_dict().items():
                values[int(monomial[-1])] = int(coefficient)
            sides.append(values)
        return sides[0], sides[1]

    def factors(self) -> list[tuple[sp.Expr, int]]:
        """Irreducible factors over Z with their (possibly negative) exponents, the content first."""
        result: list[tuple[sp.Expr, int]] = []
        for side, power in ((self._num, 1), (self._den, -1)):
            content, parts = _factors(self.ring, side)
            if content != 1:
                result.append((sp.Integer(content), power))
            result += [(part, power * exponent) for part, exponent in parts]
        return result

    def factored(self) -> sp.Expr:
        """The quotient as a product of its irreducible factors, as SymPy prints it best."""
        return sp.Mul(*(base**exponent for base, exponent in self.factors()))

    def __repr__(self) -> str:
        return f"({self._num})/({self._den})"


def _expression(ring: Ring, polynomial: Any) -> sp.Expr:
    """The polynomial with its constants, which have hidden names in the ring."""
    symbols = [sp.Symbol(name) for name in ring.generators]
    terms = {tuple(monomial): int(c) for monomial, c in polynomial.to_dict().items()}
    expression = sp.Poly.from_dict(terms or {(0,) * len(symbols): 0}, *symbols).as_expr()
    return expression.xreplace(dict(zip(map(sp.Symbol, ring.generators), ring.constants, strict=False)))


def _factors(ring: Ring, polynomial: Any) -> tuple[int, list[tuple[sp.Expr, int]]]:
    content, parts = factorisation(polynomial)
    return content, [(_expression(ring, part), exponent) for part, exponent in parts]


@dataclass(frozen=True, slots=True)
class Extension:
    """A quadratic extension r^2 = square, with r written `symbol` in expressions; `level` 1 lies over K0."""

    square: Element
    symbol: sp.Expr
    level: int


class Surd:
    """a + b r in a quadratic extension."""

    __slots__ = ("a", "b", "extension")

    def __init__(self, extension: Extension, a: Any, b: Any) -> None:
        self.extension, self.a, self.b = extension, a, b

    def _lift(self, other: object) -> tuple[Surd, Surd] | None:
        """Both operands in the larger of the two fields."""
        if isinstance(other, Surd):
            if other.extension.level > self.extension.level:
                zero = other.b * 0
                return Surd(other.extension, zero + self, zero), other
            if other.extension.level == self.extension.level:
                return self, other
        if isinstance(other, int | Quotient | Surd):
            zero = self.b * 0
            return self, Surd(self.extension, zero + other, zero)
        return None

    def __add__(self, other: object) -> Surd:
        pair = self._lift(other)
        if pair is None:
            return NotImplemented
        p, q = pair
        return Surd(p.extension, p.a + q.a, p.b + q.b)

    def __neg__(self) -> Surd:
        return Surd(self.extension, -self.a, -self.b)

    def __sub__(self, other: Any) -> Surd:
        difference: Surd = self + (-other)
        return difference

    def __rsub__(self, other: Any) -> Surd:
        difference: Surd = -self + other
        return difference

    def __mul__(self, other: object) -> Surd:
        pair = self._lift(other)
        if pair is None:
            return NotImplemented
        p, q = pair
        return Surd(p.extension, p.a * q.a + p.b * q.b * p.extension.square, p.a * q.b + p.b * q.a)

    __radd__, __rmul__ = __add__, __mul__

    def inverse(self) -> Surd:
        norm = self.a * self.a - self.b * self.b * self.extension.square
        return Surd(self.extension, self.a / norm, -self.b / norm)

    def __truediv__(self, other: object) -> Surd:
        pair = self._lift(other)
        if pair is None:
            return NotImplemented
        p, q = pair
        return p * q.inverse()

    def __rtruediv__(self, other: object) -> Surd:
        quotient: Surd = self.inverse() * other
        return quotient

    def __bool__(self) -> bool:
        return bool(self.a) or bool(self.b)

    def __eq__(self, other: object) -> bool:
        pair = self._lift(other)
        if pair is None:
            return NotImplemented
        p, q = pair
        return bool(p.a == q.a and p.b == q.b)

    def __hash__(self) -> int:
        return hash((self.a, self.b))

    def expression(self) -> sp.Expr:
        return self.a.expression() + self.b.expression() * self.extension.symbol

    def factored(self) -> sp.Expr:
        """The sum of the factored parts."""
        return self.a.factored() + self.b.factored() * self.extension.symbol


def base_part(element: Element) -> Quotient | None:
    """The element as a member of K0, or None if a square root is left in it."""
    while isinstance(element, Surd):
        if element.b:
            return None
        element = element.a
    return element


def differentiate(element: Any, rate: Any) -> Any:
    """d(element)/du, where dx/du = `rate`: dr/du = r (d square/du) / (2 square) for every root r."""
    if isinstance(element, Quotient):
        return rate * element.partial()
    zero = element.b * 0
    generator = Surd(element.extension, zero, zero + 1)
    square = element.extension.square
    root_rate = differentiate(square, rate) / (square * 2)
    return differentiate(element.a, rate) + (differentiate(element.b, rate) + root_rate * element.b) * generator

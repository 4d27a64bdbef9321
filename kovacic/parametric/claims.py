"""Functions of the parameters, classes of rational numbers, and the claims that are printed about them.

A claim is true or false at each point, as a reader understands it.  A statement is decided by its equations, a claim by what
was made of them: a parameter as a function of an integer, a sum of square roots, a table.  The two can be compared at points,
and every printed claim is.  `integers` makes claims, `prose` writes them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from itertools import chain, product
from math import gcd
from typing import Any, ClassVar, NamedTuple

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly, norm
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.sparse import by_power, factorisation
from kovacic.equation import parameters_of


def over_parameters(value: Poly) -> FunctionPoly:
    """The polynomial, as one over a field Q(t); raises `TypeError` for another field."""
    if not isinstance(value, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    return value


def in_field(function: Poly, field: FunctionField, others: Iterable[tuple[str, FunctionPoly]] = ()) -> FunctionPoly:
    """The function over a field that contains its parameters, if there are any, or the values of the others."""
    if not isinstance(function, FunctionPoly):
        return over_parameters(function.over(field))
    values = {name: field.generator(name) for name in field.names} | dict(others)
    return over_parameters(function.value_at([values[name] for name in function.field.names], field))


def with_free_generator(polynomial: Poly, larger: FunctionField) -> FunctionPoly:
    """The polynomial with the generator of its field replaced by the last parameter of the larger field."""
    assert isinstance(polynomial, ExtensionPoly)
    generator = larger.generator(larger.names[-1])
    return reduce(
        lambda total, part: total * generator + in_field(part, larger), reversed(polynomial.parts), larger.poly([])
    )


def element(field: FunctionField, num: Any) -> FunctionPoly:
    """A polynomial in x and the parameters over Z, as one over Q(t)."""
    return FunctionPoly(field, num, field.context.constant(1))


def numerator(function: FunctionPoly) -> FunctionPoly:
    return element(function.field, function.num)


def denominator(function: FunctionPoly) -> FunctionPoly:
    return element(function.field, function.den)


def irreducible_factors(function: Poly) -> list[FunctionPoly]:
    """The irreducible factors over Q of the numerator of an element of Q(t)."""
    known = over_parameters(function)
    return [element(known.field, factor) for factor, _ in factorisation(known.num)[1]]


def polynomial_factors(polynomial: Poly) -> list[FunctionPoly]:
    """The different monic irreducible factors of a polynomial over Q(t)."""
    return [over_parameters(factor) for factor, _ in polynomial.field.factor(polynomial)]


def denominators(polynomial: Poly) -> list[FunctionPoly]:
    """The denominators of the coordinates of a polynomial over an extension of Q(t), as elements of Q(t)."""
    return [element(leaf.field, leaf.den) for leaf in polynomial.leaves() if isinstance(leaf, FunctionPoly)]


def union(lists: Iterable[Iterable[FunctionPoly]]) -> list[FunctionPoly]:
    """The different polynomials of several lists, in order."""
    return [*dict.fromkeys(chain.from_iterable(lists))]


def degrees(function: FunctionPoly) -> tuple[int, ...]:
    """The degrees of the numerator in the parameters."""
    return tuple(map(int, function.num.degrees()[1:]))


def powers_of(function: FunctionPoly, i: int) -> dict[int, FunctionPoly]:
    """The coefficients of the powers of parameter number i in the numerator."""
    return {power: element(function.field, part) for power, part in by_power(function.num, 1 + i).items()}


def on_zeros(function: FunctionPoly, zero: FunctionPoly) -> FunctionPoly:
    """The function on the zeros of another one, without a parameter for which a linear equation is solved there."""
    field = function.field
    for i, power in enumerate(degrees(zero)):
        parts = powers_of(zero, i)
        if power == 1 and parts[1].num.is_constant():
            values = [*map(field.generator, field.names)]
            values[i] = -parts.get(0, 0 * parts[1]) / parts[1]
            return over_parameters(numerator(function).value_at(values, field))
    return function


def on_linear_zeros(function: FunctionPoly, zeros: Iterable[FunctionPoly]) -> FunctionPoly:
    """The function with linear equations inserted: -4 b for a^2 - 4 b if a is one of the zeros."""
    for zero in zeros:
        if zero != function and sum(degrees(zero)) == 1:
            function = on_zeros(function, zero)
    return function


def roots(polynomial: Poly) -> list[Poly]:
    """The roots in the field, a multiple one several times."""
    found = []
    for factor, multiplicity in polynomial.field.factor(polynomial):
        if factor.degree == 1:
            found += [-factor[0]] * multiplicity
    return found


def coefficients_in(function: FunctionPoly, i: int, values: Sequence[Poly], field: Field) -> list[Poly]:
    """The coefficients of the powers of parameter number i in the numerator, low to high, at values of the others."""
    parts = powers_of(function, i)
    return [parts.get(k, 0 * function).value_at(values, field) for k in range(max(parts) + 1)]


def rational_number(constant: Poly) -> Fraction | None:
    """The number, if the constant is a rational one."""
    return constant.field.rational_value(constant)


def without_parameters(polynomial: Poly) -> Poly | None:
    """The polynomial over Q, or over its number field; None if a coefficient has parameters."""
    if polynomial.field.ground == QQ:
        return polynomial
    known = [value for value in map(rational_number, polynomial) if value is not None]
    return QQ.poly(known) if len(known) == polynomial.degree + 1 else None


def laurent_constant_term(function: Poly) -> Fraction:
    """The constant term of the Laurent series at 0 of a function of the parameters."""
    return to_fraction(function.rational_coefficients()[0]) if function else Fraction(0)


def scaled_form(function: Poly) -> tuple[FunctionPoly, Fraction, Fraction]:
    """The form, scale and shift of a function form/scale + shift of the parameters that isn't a number.

    The form has no constant term (in a Laurent series at 0), and coprime coefficients of which the first is positive.
    """
    shift = laurent_constant_term(function)
    form = over_parameters(function) - shift
    above, below = ([*map(int, part.coeffs())] for part in (form.num, form.den))
    sign = 1 if above[0] > 0 else -1
    scale = Fraction(gcd(*below), gcd(*above) * sign)
    return form * scale, scale, shift


@dataclass(frozen=True)
class ParameterPoint:
    """Values of the parameters, in the order of the names: constants of one field, Q or Q(alpha), or functions of others."""

    names: tuple[str, ...]
    values: tuple[Poly, ...]
    field: Field = QQ

    @classmethod
    def generic(cls, field: FunctionField) -> ParameterPoint:
        """The parameters themselves, which can have all values."""
        return cls(field.names, tuple(map(field.generator, field.names)), field)

    def at(self, function: Poly) -> Poly:
        """The value of a polynomial over Q(t).  Raises `ZeroDivisionError` if it isn't defined."""
        known = over_parameters(function)
        chosen = [self.values[self.names.index(name)] for name in known.field.names]
        return known.value_at(chosen, self.field)

    def restricted(self, S: RatFunc) -> RatFunc:
        """S at the point.  Raises `ZeroDivisionError` if S isn't defined there."""
        return RatFunc(*map(self.at, S.cleared()))

    def __str__(self) -> str:
        return ", ".join(f"{name} = {value.to_str()}" for name, value in zip(self.names, self.values, strict=True))


#: The point of no algebraic constant.
NO_CONSTANT = ParameterPoint((), ())


@dataclass(frozen=True)
class Classes:
    """The rational numbers congruent to one of the `residues` modulo a number; `least` bounds them from below, if it does."""

    residues: tuple[Fraction, ...]
    modulus: Fraction
    least: int | None = None

    @classmethod
    def of(cls, residues: Iterable[Fraction | int], modulus: Fraction | int) -> Classes:
        """The classes in order, with the least modulus: k of them modulo m are fewer ones modulo m/k if possible."""
        known = {Fraction(residue) % modulus for residue in residues}
        for k in range(len(known), 1, -1):
            fewer = {residue % Fraction(modulus, k) for residue in known}
            if len(fewer) * k == len(known):
                return cls(tuple(sorted(fewer)), Fraction(modulus, k))
        return cls(tuple(sorted(known)), Fraction(modulus))

    def contains(self, number: Fraction) -> bool:
        if self.least is not None and number < self.least:
            return False
        return any((number - residue) % self.modulus == 0 for residue in self.residues)

    def has(self, constant: Poly) -> bool:
        """True if the constant is one of the numbers."""
        number = rational_number(constant)
        return number is not None and self.contains(number)

    def roots_of(self, polynomial: Poly) -> Iterator[Fraction]:
        """The numbers that are roots of a polynomial over Q or an extension of it."""
        return filter(self.contains, rational_roots(polynomial))

    def has_root_of(self, polynomial: Poly) -> bool | None:
        """True if one of the numbers is a root, False if none is, None if the polynomial contains parameters."""
        known = without_parameters(polynomial)
        return None if known is None else next(self.roots_of(known), None) is not None

    def modulo(self, multiple: Fraction) -> list[Fraction]:
        """The residues modulo a multiple of the modulus."""
        return [residue + k * self.modulus for residue in self.residues for k in range(int(multiple / self.modulus))]

    def moved(self, factor: Fraction | int, shift: Fraction | int) -> Classes:
        """The classes of factor * number + shift."""
        return Classes.of((factor * residue + shift for residue in self.residues), abs(Fraction(factor)) * self.modulus)

    def joined(self, other: Classes) -> Classes:
        """The numbers that are in one of them."""
        common = common_multiple(self.modulus, other.modulus)
        return Classes.of(self.modulo(common) + other.modulo(common), common)

    def meet(self, other: Classes) -> bool:
        """True if a number is in both, bounds aside."""
        step = common_divisor(self.modulus, other.modulus)
        return any((first - second) % step == 0 for first, second in product(self.residues, other.residues))

    def are_covered_by(self, other: Classes) -> bool:
        """True if each of the numbers belongs to the others, which have no bound."""
        return all(map(other.contains, self.modulo(common_multiple(self.modulus, other.modulus))))


INTEGERS = Classes.of([0], 1)
EVEN = Classes.of([0], 2)
ODD = Classes.of([1], 2)
NATURALS = Classes((Fraction(0),), Fraction(1), 0)


def common_divisor(a: Fraction, b: Fraction) -> Fraction:
    """The largest number of which both are integral multiples; a and b are not negative."""
    return Fraction(gcd(a.numerator * b.denominator, b.numerator * a.denominator), a.denominator * b.denominator)


def common_multiple(a: Fraction, b: Fraction) -> Fraction:
    """The least positive integral multiple of both; a and b are positive."""
    return a * b / common_divisor(a, b)


class Claim(ABC):
    """A statement about the parameters, as a reader understands it."""

    def holds(self, point: ParameterPoint) -> bool:
        """True if it holds at the point, where all of its formulas are defined, or provably at all values of a chart."""
        try:
            return self._holds(point)
        except ZeroDivisionError:
            return False

    @abstractmethod
    def _holds(self, point: ParameterPoint) -> bool: ...

    def numbers_at(self, point: ParameterPoint) -> Iterable[Fraction | int]:
        """The integers for which a claim about an integer holds at the point."""
        return ()


@dataclass(frozen=True)
class IsZero(Claim):
    function: FunctionPoly

    def _holds(self, point: ParameterPoint) -> bool:
        return not point.at(self.function)


@dataclass(frozen=True)
class IsNonzero(Claim):
    function: FunctionPoly

    def _holds(self, point: ParameterPoint) -> bool:
        return bool(point.at(self.function))


@dataclass(frozen=True)
class Several(Claim):
    """A combination of claims, decided by one part with the truth value `decisive`."""

    parts: tuple[Claim, ...]
    decisive: ClassVar[bool]

    def _holds(self, point: ParameterPoint) -> bool:
        return any(part.holds(point) is self.decisive for part in self.parts) is self.decisive

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction | int]:
        if self.holds(point):
            yield from chain.from_iterable(part.numbers_at(point) for part in self.parts if part.holds(point))


class AllOf(Several):
    decisive = False


class AnyOf(Several):
    decisive = True


@dataclass(frozen=True)
class InClasses(Claim):
    form: FunctionPoly
    numbers: Classes

    def _holds(self, point: ParameterPoint) -> bool:
        return self.numbers.has(point.at(self.form))


@dataclass(frozen=True)
class SumOfRoots(Claim):
    """`mean` +- the square roots of the `squares` is one of the numbers, for some choice of the signs."""

    mean: FunctionPoly
    squares: tuple[Poly, ...]
    numbers: Classes

    def _holds(self, point: ParameterPoint) -> bool:
        squares = [*map(point.at, self.squares)]
        sums = signed_sums(squares, point.at(self.mean), point.field)
        return any(map(self.numbers.contains, rational_roots(sums)))


@dataclass(frozen=True)
class Free:
    """At n = `root` f isn't defined; there the condition is that `zero` vanishes, and the parameter is free."""

    root: FunctionPoly
    zero: FunctionPoly


@dataclass(frozen=True)
class ForInteger(Claim):
    """A claim that holds for one of some integers, the `numbers_at` a point."""

    letter: str

    def _holds(self, point: ParameterPoint) -> bool:
        return any(True for _ in self.numbers_at(point))


@dataclass(frozen=True)
class IntegerFamily(ForInteger):
    """`parameter = value`, a function of n, for an n that is one of the numbers; `poles` are the n without a value."""

    parameter: str
    value: RatFunc
    numbers: Classes
    poles: tuple[Free, ...] = ()

    def along(self, line: FunctionPoly, numbers: Classes) -> IntegerFamily:
        """The family after the substitution of line(n) for n, n among other numbers, with the poles that may occur then."""
        moved = [replace(pole, root=(pole.root - line[0]) / line[1]) for pole in self.poles]
        possible = (pole for pole in moved if rational_number(pole.root) is None or numbers.has(pole.root))
        return replace(self, value=self.value(RatFunc(line)), numbers=numbers, poles=tuple(possible))

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        """The solutions n of value(n) = parameter, and the poles at which the condition holds."""
        for pole in self.poles:
            if not point.at(pole.zero):
                yield from self.numbers.roots_of(point.field.x - point.at(pole.root))
        above, below = map(point.at, self.value.cleared())
        numbers = self.numbers.roots_of(above - below * point.values[point.names.index(self.parameter)])
        yield from (number for number in numbers if below(point.field.poly([number])))


@dataclass(frozen=True)
class EquationFor(ForInteger):
    """A polynomial in n over Q(t) vanishes for one of the numbers."""

    equation: FunctionPoly
    numbers: Classes

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        return self.numbers.roots_of(point.at(self.equation))


def rational_roots(polynomial: Poly) -> list[Fraction]:
    """The rational roots of a polynomial over Q or an extension of it."""
    common = polynomial
    while isinstance(common, ExtensionPoly):
        common = reduce(lambda a, b: a.gcd(b), common.parts)
    if common.degree < 1:
        return []
    return [number for number in dict.fromkeys(map(QQ.rational_value, roots(common))) if number is not None]


def signed_sums(squares: Sequence[Poly], constant: Poly | Fraction, field: Field) -> Poly:
    """The squarefree polynomial over the field whose roots are the constant plus sums of +- the square roots."""
    total = field.x - constant
    for square in squares:
        root = AlgebraicField(field, field.poly([-square, 0, 1])).generator  # formally, if there is one in the field
        total = norm(total(root.field.x + root))
        total = total // total.gcd(total.derivative())
    return total


# ------------------------------------------------------------------------------- natural numbers that exponents allow


class ExponentRoot(NamedTuple):
    """sqrt(square), which occurs times an integer k, |k| <= largest."""

    square: Poly
    largest: int


@dataclass(frozen=True)
class Numbers:
    """The degrees of P, or numbers of zeros of a form, that the exponents allow: constant + sum of k times a root.

    The roots are over the `field`, the `base` or a quadratic extension of it.  With `only_signs` each k is 1 or -1.
    """

    constant: Fraction
    roots: tuple[ExponentRoot, ...]
    field: Field
    base: Field
    only_signs: bool = False

    @property
    def choices(self) -> Iterator[tuple[int, ...]]:
        """The k, up to their signs."""
        return product(*(range(int(self.only_signs), root.largest + 1) for root in self.roots))

    def equation(self, multiples: Sequence[int]) -> FunctionPoly:
        """The polynomial over the base, or a multiple, whose roots are constant + sums of +- k times a root for these k."""
        squares = [k * k * root.square for k, root in zip(multiples, self.roots, strict=True) if k]
        total = signed_sums(squares, self.constant, self.field)
        if self.field != self.base:
            assert isinstance(total, ExtensionPoly)
            first, second = total.parts  # 0 if the square at one point occurs together with its conjugate
            total = norm(total) if second else first
        return over_parameters(total)

    @property
    def squares(self) -> list[FunctionPoly]:
        """The squares of the roots, with the generator of the extension as one more parameter."""
        squares = [root.square for root in self.roots]
        if self.field != self.base:
            assert isinstance(self.field, AlgebraicField)
            name = "I" if self.field.name == "sqrt(-1)" else self.field.name
            larger = FunctionField((*parameters_of(self.base), name))
            squares = [with_free_generator(square, larger) for square in squares]
        return [*map(over_parameters, squares)]


@dataclass(frozen=True)
class DegreeBySum(ForInteger):
    """d is one of the numbers; `has_zero`: all k can be 0.  `names` are those of the k; without names each is 1 or -1."""

    sums: Numbers
    names: tuple[str, ...] = ()
    has_zero: bool = False

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        for multiples in self.sums.choices:
            if any(multiples) or self.has_zero:
                yield from NATURALS.roots_of(point.at(self.sums.equation(multiples)))


@dataclass(frozen=True)
class DegreeExists(Claim):
    """For one of the natural numbers that `degree` allows, there is a polynomial P, or an invariant of degree m."""

    letter: str
    degree: Claim
    m: int
    #: True if something with one of these numbers of zeros exists at a point, which means that Delta_d vanishes.
    exists: Callable[[ParameterPoint, Sequence[int]], bool]

    def _holds(self, point: ParameterPoint) -> bool:
        numbers = sorted(map(int, {*self.degree.numbers_at(point)}))
        return len(numbers) > 0 and self.exists(point, numbers)

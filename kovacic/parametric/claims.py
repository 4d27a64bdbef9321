"""What is printed of a statement: claims, each true or false at a point in the way in which a reader takes it.

A statement is decided by its equations, a claim by what was made of them: a parameter as a function of an integer, a sum of
square roots, a table.  So the two can be compared at points, and each claim that leaves is.  `integers` makes claims, `prose`
writes them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from itertools import chain, product
from typing import ClassVar, NamedTuple

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly, norm
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import parameters_of
from kovacic.parametric.functions import NATURALS, Classes, ParameterPoint, lifted, over_parameters, roots


class Claim(ABC):
    """A statement about the parameters, true exactly where a reader finds it true."""

    def holds(self, point: ParameterPoint) -> bool:
        """True if it is true at the point; a formula that isn't defined there makes it false.

        Of a statement on a chart: True only if it provably holds at all values of the chart.
        """
        try:
            return self._holds(point)
        except ZeroDivisionError:
            return False

    @abstractmethod
    def _holds(self, point: ParameterPoint) -> bool: ...

    def numbers_at(self, point: ParameterPoint) -> Iterable[Fraction | int]:
        """The integers for which it is true at the point, of a claim about one."""
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
    """Made of others: one truth value of a part decides."""

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
        number = rational(point.at(self.form))
        return number is not None and self.numbers.contains(number)


@dataclass(frozen=True)
class SumOfRoots(Claim):
    """`mean`, +- the square roots of the `squares`, is one of the numbers for a choice of the signs."""

    mean: FunctionPoly
    squares: tuple[Poly, ...]
    numbers: Classes

    def _holds(self, point: ParameterPoint) -> bool:
        squares = [point.at(over_parameters(square)) for square in self.squares]
        sums = signed_sums(squares, point.at(self.mean), point.field)
        return any(map(self.numbers.contains, rational_roots(sums)))


@dataclass(frozen=True)
class Free:
    """At n = `root` f isn't defined, and the condition is that `zero` vanishes, whatever the parameter is."""

    root: FunctionPoly
    zero: FunctionPoly


@dataclass(frozen=True)
class ForInteger(Claim):
    """True for one of some integers: the subclass says for which."""

    letter: str

    def _holds(self, point: ParameterPoint) -> bool:
        return any(True for _ in self.numbers_at(point))


@dataclass(frozen=True)
class IntegerFamily(ForInteger):
    """`parameter = value`, a function of n, for an n that is one of the numbers.

    `poles` are what is said of the n at which the value isn't defined.
    """

    parameter: str
    value: RatFunc
    numbers: Classes
    poles: tuple[Free, ...] = ()

    def along(self, line: FunctionPoly, numbers: Classes) -> IntegerFamily:
        """The family after the substitution of line(n) for n, n among other numbers, with the poles that may occur then."""
        moved = [replace(pole, root=over_parameters((pole.root - line[0]) / line[1])) for pole in self.poles]
        possible = (p for p in moved if (number := rational(p.root)) is None or numbers.contains(number))
        return replace(self, value=self.value(RatFunc(line)), numbers=numbers, poles=tuple(possible))

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        """The poles named in messages are among them."""
        for zero in self.poles:
            number = rational(point.at(zero.root))
            if number is not None and self.numbers.contains(number) and not point.at(zero.zero):
                yield number
        above, below = (point.at(over_parameters(part)) for part in self.value.cleared())
        for number in rational_roots(above - below * point.values[point.names.index(self.parameter)]):
            if self.numbers.contains(number) and below(point.field.poly([number])):
                yield number


@dataclass(frozen=True)
class EquationFor(ForInteger):
    """A polynomial in n over Q(t) vanishes for one of the numbers."""

    equation: FunctionPoly
    numbers: Classes

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        return filter(self.numbers.contains, rational_roots(point.at(self.equation)))


def rational(constant: Poly) -> Fraction | None:
    """The number, where it is rational."""
    return constant.field.rational_value(constant)


def rational_roots(polynomial: Poly) -> list[Fraction]:
    """The rational roots of a polynomial over Q or an extension of it."""
    common = polynomial
    while isinstance(common, ExtensionPoly):
        common = reduce(lambda a, b: a.gcd(b), common.parts)
    if common.degree < 1:
        return []
    return [*dict.fromkeys(number for number in map(QQ.rational_value, roots(common)) if number is not None)]


def signed_sums(squares: Sequence[Poly], constant: Poly | Fraction, field: Field) -> Poly:
    """The squarefree polynomial over the field whose roots are the constant plus sums of +- the square roots."""
    return reduce(with_signed_root, squares, field.poly([0, 1]) - constant)


def with_signed_root(total: Poly, square: Poly) -> Poly:
    """The squarefree polynomial whose roots are those of another one, plus and minus the square root."""
    field = total.field
    root = AlgebraicField(field, field.poly([-square, 0, 1])).generator  # formally, if there is one in the field
    total = norm(total(root.field.poly([0, 1]) + root))
    return total // total.gcd(total.derivative())


# ------------------------------------------------------------------------------- natural numbers that exponents allow


class ExponentRoot(NamedTuple):
    """sqrt(square), of which multiples k occur with an integer k, |k| <= largest."""

    square: Poly
    largest: int


@dataclass(frozen=True)
class Numbers:
    """The possible degrees of P, or numbers of zeros of a form, by the exponents: constant + sum of k times a root.

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

    def equation(self, multiples: Sequence[int]) -> Poly:
        """The polynomial over the base, or a multiple, whose roots are constant + sums of +- k times a root for these k."""
        squares = [k * k * root.square for k, root in zip(multiples, self.roots, strict=True) if k]
        total = self.base.poly([0, 1]) - self.constant
        if self.field != self.base:  # the square at one point is conjugate to that at the other
            conjugate = [square for square in squares if any(square.parts[1:])]
            squares = [square.parts[0] for square in squares if square not in conjugate]
            sums = signed_sums(conjugate, self.constant, self.field)
            first, second = sums.parts
            total = norm(sums) if second else first
        return reduce(with_signed_root, squares, total)

    def at(self, point: ParameterPoint, multiples: Sequence[int]) -> list[Fraction]:
        """The rational ones for these k at a point."""
        if self.field != self.base:
            return rational_roots(point.at(over_parameters(self.equation(multiples))))
        chosen = [(k, over_parameters(root.square)) for k, root in zip(multiples, self.roots, strict=True) if k]
        squares = [k * k * point.at(square) for k, square in chosen]
        return rational_roots(signed_sums(squares, self.constant, point.field))

    @property
    def squares(self) -> list[FunctionPoly]:
        """Those of the roots, in which that of the extension is one more parameter."""
        squares = [root.square for root in self.roots]
        if self.field != self.base:
            assert isinstance(self.field, AlgebraicField)
            name = "I" if self.field.name == "sqrt(-1)" else self.field.name
            larger = FunctionField((*parameters_of(self.base), name))
            squares = [lifted(square, larger) for square in squares]
        return [*map(over_parameters, squares)]


@dataclass(frozen=True)
class DegreeBySum(ForInteger):
    """d is one of the numbers; `has_zero`: all k can be 0.  The `names` are those of the k, without them each is 1 or -1."""

    sums: Numbers
    names: tuple[str, ...] = ()
    has_zero: bool = False

    def numbers_at(self, point: ParameterPoint) -> Iterator[Fraction]:
        for multiples in self.sums.choices:
            if any(multiples) or self.has_zero:
                yield from filter(NATURALS.contains, self.sums.at(point, multiples))


@dataclass(frozen=True)
class DegreeExists(Claim):
    """For one of the natural numbers that `degree` allows, a polynomial or an invariant of degree m exists."""

    letter: str
    degree: Claim
    m: int
    #: Decides whether something with one of these numbers of zeros exists at a point: Delta_d is a determinant.
    exists: Callable[[ParameterPoint, Sequence[int]], bool]

    def _holds(self, point: ParameterPoint) -> bool:
        numbers = sorted(map(int, {*self.degree.numbers_at(point)}))
        return len(numbers) > 0 and self.exists(point, numbers)

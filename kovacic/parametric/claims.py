"""What is printed of a statement: claims, each true or false at a point in the way in which a reader takes it.

A statement is decided by its equations, a claim by what was made of them: a parameter as a function of an integer, a sum of
square roots, a table.  So the two can be compared at points, and each claim that leaves is.  `integers` makes claims, `prose`
writes them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import product

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly, norm
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.errors import VerificationFailed
from kovacic.parametric.functions import Classes, ParameterPoint, over_parameters


class Proposition(ABC):
    """What is true or false at a point."""

    def holds(self, point: ParameterPoint) -> bool:
        """True if it is true at the point; a formula that isn't defined there makes it false."""
        try:
            return self._holds(point)
        except ZeroDivisionError:
            return False

    @abstractmethod
    def _holds(self, point: ParameterPoint) -> bool: ...


class Claim(Proposition):
    """What is said of the parameters: true where a reader finds it true."""


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
class AllOf(Claim):
    parts: tuple[Claim, ...]

    def _holds(self, point: ParameterPoint) -> bool:
        return all(part.holds(point) for part in self.parts)


@dataclass(frozen=True)
class AnyOf(Claim):
    parts: tuple[Claim, ...]

    def _holds(self, point: ParameterPoint) -> bool:
        return any(part.holds(point) for part in self.parts)


@dataclass(frozen=True)
class ThatIs(Claim):
    """The same said in two ways."""

    first: Claim
    second: Claim

    def _holds(self, point: ParameterPoint) -> bool:
        found = self.first.holds(point)
        if found is not self.second.holds(point):
            raise VerificationFailed(f"two forms of one statement differ at {point}; please report it")
        return found


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
class IntegerFamily(Claim):
    """`parameter = value`, a function of n, for an n that is one of the numbers.

    `poles` are what is said of the n at which the value isn't defined.
    """

    parameter: str
    value: RatFunc
    letter: str
    numbers: Classes
    poles: tuple[Free, ...] = ()

    def _holds(self, point: ParameterPoint) -> bool:
        return any(True for _ in self.numbers_at(point))

    def numbers_at(self, point: ParameterPoint) -> Iterator[Poly]:
        """The n for which it is true at the point, those of which a pole speaks among them."""
        for zero in self.poles:
            root = point.at(zero.root)
            number = rational(root)
            if number is not None and self.numbers.contains(number) and not point.at(zero.zero):
                yield root
        above, below = (point.at(over_parameters(part)) for part in self.value.cleared())
        for number in rational_roots(above - below * point.values[point.names.index(self.parameter)]):
            n = point.field.poly([number])
            if self.numbers.contains(number) and below(n):
                yield n


@dataclass(frozen=True)
class EquationFor(Claim):
    """A polynomial in n over Q(t) vanishes for one of the numbers."""

    equation: FunctionPoly
    letter: str
    numbers: Classes

    def _holds(self, point: ParameterPoint) -> bool:
        return any(True for _ in self.numbers_at(point))

    def numbers_at(self, point: ParameterPoint) -> Iterator[Poly]:
        for number in rational_roots(point.at(self.equation)):
            if self.numbers.contains(number):
                yield point.field.poly([number])


def rational(constant: Poly) -> Fraction | None:
    """The number, where it is rational."""
    return constant.field.rational_value(constant)


def rational_roots(polynomial: Poly) -> list[Fraction]:
    """The rational roots of a polynomial over Q or Q(alpha)."""
    common = polynomial
    if isinstance(polynomial, ExtensionPoly):
        common = reduce(lambda a, b: a.gcd(b), polynomial.parts)
    if common.degree < 1:
        return []
    found: list[Fraction] = []
    for factor, _ in QQ.factor(common):
        root = QQ.rational_value(-factor[0]) if factor.degree == 1 else None
        if root is not None:
            found.append(root)
    return found


def signed_sums(squares: Sequence[Poly], constant: Poly | Fraction, field: Field) -> Poly:
    """The squarefree polynomial over the field whose roots are the constant plus sums of +- the square roots."""
    total = field.poly([0, 1]) - constant
    for square in squares:
        root = AlgebraicField(field, field.poly([-square, 0, 1])).generator  # formally, if there is one in the field
        total = norm(total(root.field.poly([0, 1]) + root))
        total = total // total.gcd(total.derivative())
    return total


# ------------------------------------------------------------------------------- natural numbers that exponents allow


class DegreeClaim(ABC):
    """Which natural numbers d the exponents allow, as it is said."""

    letter: str

    @abstractmethod
    def numbers_at(self, point: ParameterPoint) -> set[int]:
        """Those that it allows at a point."""


@dataclass(frozen=True)
class WhereZero:
    """What `said` allows where a function vanishes."""

    said: Alternatives
    zero: FunctionPoly


@dataclass(frozen=True)
class Alternatives(DegreeClaim):
    """d belongs to one of the families, solves one of the equations, or is allowed where a function vanishes."""

    letter: str
    families: tuple[IntegerFamily, ...] = ()
    equations: tuple[EquationFor, ...] = ()
    where: tuple[WhereZero, ...] = ()

    def numbers_at(self, point: ParameterPoint) -> set[int]:
        found: set[int] = set()
        parts: tuple[IntegerFamily | EquationFor, ...] = (*self.families, *self.equations)
        for part in parts:
            try:
                found |= natural_numbers(map(rational, part.numbers_at(point)))
            except ZeroDivisionError:
                continue
        for one in self.where:
            if not point.at(one.zero):
                found |= one.said.numbers_at(point)
        return found


@dataclass(frozen=True)
class DegreeBySum(DegreeClaim):
    """d = constant + the sum of j times the root for integers j, from -bound to bound; `has_zero`: they can all be 0.

    Without `names` for the integers, each of them is 1 or -1.
    """

    letter: str
    constant: Fraction
    squares: tuple[Poly, ...]
    names: tuple[str, ...] = ()
    bounds: tuple[int, ...] = ()
    has_zero: bool = False

    def numbers_at(self, point: ParameterPoint) -> set[int]:
        squares = [point.at(over_parameters(square)) for square in self.squares]
        choices: Iterable[tuple[int, ...]] = [(1,) * len(squares)]
        if self.names:
            choices = product(*(range(bound + 1) for bound in self.bounds))
        found: set[int] = set()
        for chosen in choices:
            if any(chosen) or self.has_zero or not self.names:
                multiples = [j * j * square for j, square in zip(chosen, squares, strict=True) if j]
                found |= natural_numbers(rational_roots(signed_sums(multiples, self.constant, point.field)))
        return found


def natural_numbers(numbers: Iterable[Fraction | None]) -> set[int]:
    """The natural numbers among rational ones, and None for others."""
    return {int(number) for number in numbers if number is not None and number.denominator == 1 and number >= 0}


@dataclass(frozen=True)
class DegreeExists(Claim):
    """For one of the natural numbers that `degree` allows, a polynomial or an invariant of degree m exists."""

    degree: DegreeClaim
    m: int
    #: Decides whether something with one of these numbers of zeros exists at a point: Delta_d is a determinant.
    exists: Callable[[ParameterPoint, Sequence[int]], bool]

    def _holds(self, point: ParameterPoint) -> bool:
        numbers = sorted(self.degree.numbers_at(point))
        return len(numbers) > 0 and self.exists(point, numbers)

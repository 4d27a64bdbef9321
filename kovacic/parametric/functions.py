"""What statements are made of: functions of the parameters, elements of Q(t), and classes of rational numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, product
from math import gcd
from typing import Any, NamedTuple

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.sparse import by_power, factorisation


def over_parameters(value: Poly) -> FunctionPoly:
    """The polynomial as one over a field Q(t).  Raises `TypeError` if its field isn't one."""
    if not isinstance(value, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    return value


def in_field(function: Poly, field: FunctionField) -> FunctionPoly:
    """The function over a field that contains its parameters, if there are any."""
    if not isinstance(function, FunctionPoly):
        return over_parameters(function.over(field))
    return over_parameters(function.value_at([*map(field.generator, function.field.names)], field))


def lifted(polynomial: Poly, larger: FunctionField) -> FunctionPoly:
    """The polynomial with the generator of its field replaced by the last parameter of the larger field."""
    assert isinstance(polynomial, ExtensionPoly)
    total: Poly = larger.poly([])
    for part in reversed(polynomial.parts):
        total = total * larger.generator(larger.names[-1]) + in_field(over_parameters(part), larger)
    return over_parameters(total)


def element(field: FunctionField, num: Any) -> FunctionPoly:
    """A polynomial in x and the parameters over Z, as one over Q(t)."""
    return FunctionPoly(field, num, field.context.constant(1))


def numerator(function: FunctionPoly) -> FunctionPoly:
    return element(function.field, function.num)


def irreducible_factors(function: Poly) -> list[FunctionPoly]:
    """The irreducible factors over Q of the numerator of an element of Q(t)."""
    known = over_parameters(function)
    return [element(known.field, factor) for factor, _ in factorisation(known.num)[1]]


def denominators(polynomial: Poly) -> list[FunctionPoly]:
    """The denominators of the coordinates of a polynomial over an extension of Q(t), as elements of Q(t)."""
    return [element(leaf.field, leaf.den) for leaf in polynomial.leaves() if isinstance(leaf, FunctionPoly)]


def union(lists: Iterable[Iterable[FunctionPoly]]) -> list[FunctionPoly]:
    """The different polynomials of several lists, in order."""
    return list(dict.fromkeys(chain.from_iterable(lists)))


def degrees(function: FunctionPoly) -> tuple[int, ...]:
    """The degrees of the numerator in the parameters."""
    return tuple(map(int, function.num.degrees()[1:]))


def powers_of(function: FunctionPoly, i: int) -> dict[int, FunctionPoly]:
    """The coefficients of the powers of parameter number i in the numerator."""
    return {power: element(function.field, part) for power, part in by_power(function.num, 1 + i).items()}


def on_zeros(function: FunctionPoly, zero: FunctionPoly) -> FunctionPoly:
    """The function where another one vanishes, without the parameter that follows there if one does, over the same field."""
    field = function.field
    for i, power in enumerate(degrees(zero)):
        parts = powers_of(zero, i)
        if power == 1 and parts[1].num.is_constant():
            values = [*map(field.generator, field.names)]
            values[i] = -parts.get(0, 0 * parts[1]) / parts[1]
            return over_parameters(numerator(function).value_at(values, field))
    return function


def with_values(function: FunctionPoly, zeros: Iterable[FunctionPoly]) -> FunctionPoly:
    """The function with the values that parameters have on the zeros of others: -4 b for a^2 - 4 b where a = 0."""
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
    """Those of the powers of parameter number i, low to high, in the numerator; the others have these values."""
    parts = powers_of(function, i)
    return [parts.get(k, 0 * function).value_at(values, field) for k in range(max(parts) + 1)]


def without_parameter(i: int, names: Sequence[str]) -> tuple[Field, list[Poly]]:
    """The field of the other parameters, Q if there are none, and all of them as its elements: 0 for number i."""
    others = (*names[:i], *names[i + 1 :])
    if not others:
        return QQ, [QQ.poly([0])]
    field = FunctionField(others)
    values: list[Poly] = [*map(field.generator, others)]
    values.insert(i, field.poly([0]))
    return field, values


def constant_term(function: Poly) -> Fraction:
    """The constant term of the Laurent series at 0 of a function of the parameters."""
    return to_fraction(function.rational_coefficients()[0]) if function else Fraction(0)


class NormalForm(NamedTuple):
    """A function of the parameters is form/scale + shift.

    The form has no constant term (in a Laurent series at 0) and coprime coefficients.
    """

    form: FunctionPoly
    scale: Fraction
    shift: Fraction


def normal_form(function: Poly) -> NormalForm:
    """A function that isn't a number by a form, whose first coefficient is positive."""
    shift = constant_term(function)
    form = over_parameters(function - shift)
    above, below = ([*map(int, part.coeffs())] for part in (form.num, form.den))
    sign = 1 if above[0] > 0 else -1
    scale = Fraction(gcd(*below), gcd(*above) * sign)
    return NormalForm(over_parameters(form * scale), scale, shift)


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

    def at(self, function: FunctionPoly) -> Poly:
        """The value of a polynomial over Q(t).  Raises `ZeroDivisionError` where it isn't defined."""
        chosen = [self.values[self.names.index(name)] for name in function.field.names]
        return function.value_at(chosen, self.field)

    def restricted(self, S: RatFunc) -> RatFunc:
        """S there.  Raises `ZeroDivisionError` where the denominator vanishes identically: S isn't defined."""
        above, below = map(over_parameters, S.cleared())
        return RatFunc(self.at(above), self.at(below))

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
        return cls(tuple(map(Fraction, residues)), Fraction(modulus))

    def contains(self, number: Fraction) -> bool:
        if self.least is not None and number < self.least:
            return False
        return any((number - residue) % self.modulus == 0 for residue in self.residues)

    def modulo(self, multiple: Fraction) -> list[Fraction]:
        """The residues modulo a multiple of the modulus."""
        periods = range(int(multiple / self.modulus))
        return [residue + k * self.modulus for residue in self.residues for k in periods]

    def meet(self, other: Classes) -> bool:
        """True if a number is in both, bounds aside."""
        step = common_divisor(self.modulus, other.modulus)
        return any((first - second) % step == 0 for first, second in product(self.residues, other.residues))

    def are_covered_by(self, other: Classes) -> bool:
        """True if each of the numbers belongs to the others, which have no bound."""
        return all(map(other.contains, self.modulo(common_multiple(self.modulus, other.modulus))))


INTEGERS = Classes.of([0], 1)
NATURALS = Classes((Fraction(0),), Fraction(1), 0)


def common_divisor(a: Fraction, b: Fraction) -> Fraction:
    """The largest number of which both are integral multiples; a and b are not negative."""
    return Fraction(gcd(a.numerator * b.denominator, b.numerator * a.denominator), a.denominator * b.denominator)


def common_multiple(a: Fraction, b: Fraction) -> Fraction:
    """The least positive integral multiple of both; a and b are positive."""
    return a * b / common_divisor(a, b)

"""Statements about integers: a polynomial in N over Q(t) has a root N in given classes.

For a polynomial of degree 1 that is: a form in the parameters is congruent to one of some rational numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain, count
from math import ceil, lcm
from random import Random
from typing import NamedTuple

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.claims import AllOf, AnyOf, Claim, InClasses, IsNonzero, rational_roots
from kovacic.parametric.functions import (
    INTEGERS,
    Classes,
    ParameterPoint,
    common_multiple,
    degrees,
    element,
    irreducible_factors,
    normal_form,
    numerator,
    over_parameters,
    values_at_integers,
)
from kovacic.parametric.solving import all_solved, integer_condition, on_zeros
from kovacic.parametric.statements import ALWAYS, NEVER, Setting, Statement, Vanishes, all_of, both, either

#: What integers are called, the first that isn't a parameter.
LETTERS = "nNmMkKjJ"


@dataclass(frozen=True)
class Congruence(Statement):
    """`equation`, a polynomial in N over Q(t), has a rational root N congruent to one of `residues` modulo `modulus`.

    The numbers are integers but for degree 1.
    """

    equation: FunctionPoly
    residues: tuple[Fraction, ...]
    modulus: Fraction
    setting: Setting = field(default=Setting(), compare=False)

    @classmethod
    def make(cls, equation: FunctionPoly, residues: Iterable[Fraction | int], modulus: Fraction | int) -> Congruence:
        """Normalised, with the least modulus, by N -> a N + b.

        A form gets no constant term (in a Laurent series at 0) and coprime coefficients; else the mean of the roots lies in
        (-1, 0] if it is a number, and the classes are symmetric about it if the equation is.
        """
        classes = {Fraction(r) for r in residues}
        m = Fraction(modulus)
        k = equation.degree
        if k == 1:
            return cls._of_form(-equation[0] / equation[1], classes, m)
        field = equation.field
        mean = field.rational_value(-equation[k - 1] / (k * equation.lc))
        if mean is None:
            return cls._with_least_modulus(equation, classes, m)
        shift = ceil(mean)
        Z = field.poly([0, 1])
        moved = over_parameters(equation(Z + shift))
        moved_classes = {residue - shift for residue in classes}
        twice = 2 * (mean - shift)
        is_symmetric = twice.denominator == 1 and moved(twice - Z) == (-1) ** k * moved
        if is_symmetric:
            moved_classes |= {twice - residue for residue in moved_classes}
        return cls._with_least_modulus(moved, moved_classes, m)

    @classmethod
    def _of_form(cls, value: Poly, classes: Iterable[Fraction], modulus: Fraction) -> Congruence:
        """A form of the parameters is congruent to one of the classes: value = form/scale + shift."""
        form, scale, shift = normal_form(value)
        equation = over_parameters(form.field.poly([0, 1]) - form)
        scaled = {(residue - shift) * scale for residue in classes}
        return cls._with_least_modulus(equation, scaled, abs(modulus * scale))

    @classmethod
    def _with_least_modulus(cls, equation: FunctionPoly, classes: Iterable[Fraction], modulus: Fraction) -> Congruence:
        """k classes modulo m may be one modulo m/k, which is an integer where the numbers are integers."""
        known = {residue % modulus for residue in classes}
        for k in range(len(known), 1, -1):
            if equation.degree != 1 and modulus % k != 0:
                continue
            fewer = {residue % (modulus / k) for residue in known}
            if len(fewer) * k == len(known):
                return cls(equation, tuple(sorted(fewer)), modulus / k)
        return cls(equation, tuple(sorted(known)), modulus)

    @property
    def form(self) -> FunctionPoly | None:
        """The form that is congruent to one of the numbers; None for an equation of higher degree."""
        return over_parameters(-self.equation[0]) if self.equation.degree == 1 else None

    @property
    def numbers(self) -> Classes:
        """Those of which N has to be one."""
        return Classes(self.residues, self.modulus)

    def _holds(self, point: ParameterPoint) -> bool:
        return self._has_one_of(rational_roots(point.at(self.equation)))

    def _has_one_of(self, numbers: Iterable[Fraction]) -> bool:
        """Does one of the numbers lie in one of the classes?"""
        return any(map(self.numbers.contains, numbers))

    def holds_for(self, equation: Poly) -> bool | None:
        """Is it true where this is the equation?  None where there are parameters in it."""
        numbers = equation if equation.field.ground == QQ else _without_parameters(equation)
        if numbers is None:
            return None
        return self._has_one_of(rational_roots(numbers))

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        made = Congruence.make(change(self.equation), self.residues, self.modulus)
        return replace(made, setting=self.setting)

    def sample(self, random: Random) -> list[FunctionPoly]:
        N = random.choice(self.residues) + random.randint(-4, 4) * self.modulus
        return [over_parameters(self.equation(N))]

    def merged(self, other: Statement) -> Congruence | None:
        if not isinstance(other, Congruence):
            return None
        relation = self._relation(other.equation)
        if relation is None:
            return None
        common = common_multiple(self.modulus, other.modulus)
        numbers = self.numbers.modulo(common)
        numbers += [relation.sign * number + relation.shift for number in other.numbers.modulo(common)]
        made = Congruence.make(self.equation, numbers, common)
        return replace(made, setting=self.setting)

    def _relation(self, other: FunctionPoly) -> _Relation | None:
        """Between the roots of the other equation and those of this one."""
        own = self.equation
        k = own.degree
        if other == own:
            return _Relation(1, 0)
        if other.degree != k or other.field != own.field:
            return None
        N = own.field.poly([0, 1])
        for sign in (1, -1):
            shift = own.field.rational_value((own[k - 1] / own.lc - sign * other[k - 1] / other.lc) / -k)
            if shift is None or shift.denominator > 1:
                continue
            moved = own(sign * N + int(shift))
            if moved * other.lc == other * moved.lc:
                return _Relation(sign, int(shift))
        return None

    def decided(self, assumptions: Assumptions) -> bool | None:
        if self.form is not None:
            return assumptions.meets_classes(self.form, self.numbers)
        if not assumptions:
            return None
        for factor, _ in self.equation.field.factor(self.equation):
            if factor.degree == 1 and assumptions.meets_classes(over_parameters(-factor[0]), self.numbers):
                return True
        return None

    def narrowed(self, assumptions: Assumptions) -> Statement:
        """The values of an integer parameter t, of which only finitely many make (a t + b)/(c t + d) so integral."""
        if self.form is None:
            return self
        largest = lcm(self.modulus.denominator, *(residue.denominator for residue in self.residues))
        known = values_at_integers(self.form, largest)
        if known is None or not assumptions.is_integer(known.name):
            return self
        parameter = self.equation.field.generator(known.name)
        found: list[Statement] = []
        for number, value in known.values.items():
            here = Vanishes(over_parameters(parameter - number))
            if self._has_one_of([value]) and here.decided(assumptions) is not False:
                found.append(here)
        return either(*found)

    def avoiding(self, setting: Setting) -> Statement:
        return replace(self, setting=setting)

    @property
    def letter(self) -> str:
        return free_letter(self.setting.names)

    @cached_property
    def claim(self) -> Claim:
        if self.form is None:
            return self._solved(self.equation, self.numbers)
        if len(self.residues) == 1:
            return self._one_class(self.form)
        return InClasses(self.form, self.numbers)

    def _solved(self, equation: FunctionPoly, numbers: Classes) -> Claim:
        """An equation for an integer, with what holds where the parameter for which it was solved is free."""
        found = integer_condition(equation, numbers, self.letter, self.setting)
        claims = [found.claim]
        for zero, rest in found.strata:
            there = integer_roots(rest, [*map(int, numbers.residues)], int(numbers.modulus)) if rest else ALWAYS
            if there != NEVER:
                claims.append(all_of(both(Vanishes(zero), there).parts).avoiding(self.setting).claim)
        said = claims[0] if len(claims) == 1 else AnyOf(tuple(claims))
        return self._where_defined(said, equation) if found.is_solved else said

    def _where_defined(self, said: Claim, equation: FunctionPoly) -> Claim:
        """With the denominators of the equation, which solving it cleared, where no earlier region has their zeros."""
        above = numerator(equation)
        guards = []
        for factor in irreducible_factors(element(equation.field, equation.den)):
            there = irreducible_factors(on_zeros(above, factor))
            if not all(self.setting.covers(factor, zero) for zero in there):
                guards.append(IsNonzero(factor))
        return AllOf((said, *guards)) if guards else said

    def _one_class(self, form: FunctionPoly) -> Claim:
        """That a form is congruent to one number."""
        (residue,) = self.residues
        modulus = self.modulus
        below = modulus.denominator
        multiple = over_parameters(form * below)
        remainder = residue * below
        if modulus.numerator == 1:
            return InClasses(over_parameters(multiple - remainder), INTEGERS)
        if modulus.numerator == 2 and remainder.denominator == 1:
            return InClasses(multiple, Classes.of([remainder], 2))
        scale = lcm(residue.denominator, below)
        equation = over_parameters(form * scale - form.field.poly([0, 1]))
        has_several_parameters = sum(map(bool, degrees(equation))) > 1
        if has_several_parameters and all_solved(equation, self.setting.fixed):
            return self._solved(equation, Classes.of([residue * scale], modulus * scale))
        return InClasses(form, self.numbers)


class _Relation(NamedTuple):
    """N is a root of one equation exactly where sign * N + shift is one of another."""

    sign: int
    shift: int


def free_letter(names: Collection[str], preferred: str = LETTERS) -> str:
    """A name for an integer that isn't one of the names."""
    return next(letter for letter in chain(preferred, map("n{}".format, count())) if letter not in names)


def integer_roots(equation: FunctionPoly, residues: Sequence[int], modulus: int) -> Statement:
    """When does a polynomial in N over Q(t) have an integer root in these classes?"""
    classes = {r % modulus for r in residues}
    is_symmetric = classes == {-r % modulus for r in classes}  # and then the signs of N say the same
    statements: list[Statement] = []
    seen: list[Poly] = []
    field = equation.field
    for factor, _ in field.factor(equation):
        if is_symmetric and factor(field.poly([0, -1])).monic() in seen:
            continue
        seen.append(factor)
        numbers = _without_parameters(factor)
        if numbers is None:
            statements.append(Congruence.make(over_parameters(factor), classes, modulus))
        elif any(root % modulus in classes for root in rational_roots(numbers)):
            return ALWAYS
    return either(*statements)


def _without_parameters(polynomial: Poly) -> Poly | None:
    """The same over Q; None where a coefficient has parameters."""
    values: list[Fraction] = []
    for coefficient in polynomial:
        value = polynomial.field.rational_value(coefficient)
        if value is None:
            return None
        values.append(value)
    return QQ.poly(values)

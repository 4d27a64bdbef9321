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

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.parametric.assumptions import Assumptions
from kovacic.parametric.functions import (
    Coset,
    ParameterPoint,
    common_multiple,
    degrees,
    normal_form,
    over_parameters,
    values_at_integers,
)
from kovacic.parametric.spectra import Notation, families, integer_condition, kind
from kovacic.parametric.statements import ALWAYS, Statement, Vanishes, either

#: What integers are called, the first that isn't a parameter.
LETTERS = "nNmMkKjJ"


@dataclass(frozen=True)
class Congruence(Statement):
    """`equation`, a polynomial in N over Q(t), has a rational root N congruent to one of `residues` modulo `modulus`.

    The numbers are integers but for degree 1.  N is called `letter`; the `fixed` parameters are constants, for which it isn't
    solved.
    """

    equation: FunctionPoly
    residues: tuple[Fraction, ...]
    modulus: Fraction
    letter: str = field(default="n", compare=False)
    fixed: tuple[str, ...] = field(default=(), compare=False)

    @classmethod
    def make(cls, equation: FunctionPoly, residues: Iterable[Fraction | int], modulus: Fraction | int) -> Congruence:
        """Normalised, with the least modulus, by N -> a N + b.

        A form gets no constant term (in a Laurent series at 0) and coprime coefficients; else the mean of the roots lies in
        (-1, 0] if it is a number, and the classes are symmetric about it if the equation is.
        """
        Z, classes, modulus = equation.field.poly([0, 1]), {Fraction(r) for r in residues}, Fraction(modulus)
        if equation.degree == 1:
            form, scale, shift = normal_form(-equation[0] / equation[1])
            equation, modulus = over_parameters(Z - form), abs(modulus * scale)
            classes = {(residue - shift) * scale for residue in classes}
        else:
            mean = equation.field.rational_value(-equation[equation.degree - 1] / (equation.degree * equation.lc))
            if mean is not None:
                equation = over_parameters(equation(Z + ceil(mean)))
                classes, twice = {r - ceil(mean) for r in classes}, 2 * (mean - ceil(mean))
                if twice.denominator == 1 and equation(twice - Z) == (-1) ** equation.degree * equation:
                    classes |= {twice - r for r in classes}
        classes = {residue % modulus for residue in classes}
        for k in range(len(classes), 1, -1):
            fewer = {residue % (modulus / k) for residue in classes}
            if len(fewer) * k == len(classes) and (equation.degree == 1 or modulus % k == 0):
                classes, modulus = fewer, modulus / k
                break
        return cls(equation, tuple(sorted(classes)), modulus)

    @property
    def form(self) -> FunctionPoly | None:
        """The form that is congruent to one of the numbers; None for an equation of higher degree."""
        return over_parameters(-self.equation[0]) if self.equation.degree == 1 else None

    @property
    def cosets(self) -> list[Coset]:
        """The classes of N."""
        return [Coset(residue, self.modulus) for residue in self.residues]

    def _holds(self, point: ParameterPoint) -> bool:
        return any(coset.contains(N) for N in rational_roots(point.at(self.equation)) for coset in self.cosets)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        made = Congruence.make(change(self.equation), self.residues, self.modulus)
        return replace(made, letter=self.letter, fixed=self.fixed)

    def sample(self, random: Random) -> list[FunctionPoly]:
        N = random.choice(self.residues) + random.randint(-4, 4) * self.modulus
        return [over_parameters(self.equation(N))]

    def merged(self, other: Statement) -> Congruence | None:
        relation = self._relation(other.equation) if isinstance(other, Congruence) else None
        if relation is None or not isinstance(other, Congruence):
            return None
        sign, shift = relation
        common = common_multiple(self.modulus, other.modulus)
        numbers = [r + k * self.modulus for r in self.residues for k in range(int(common / self.modulus))]
        numbers += [
            sign * (r + k * other.modulus) + shift for r in other.residues for k in range(int(common / other.modulus))
        ]
        made = Congruence.make(self.equation, numbers, common)
        return replace(made, letter=self.letter, fixed=self.fixed)

    def _relation(self, other: FunctionPoly) -> tuple[int, int] | None:
        """`(sign, shift)` where each root N of the other equation is one, sign N + shift, of this one."""
        own, N, k = self.equation, self.equation.field.poly([0, 1]), self.equation.degree
        if other == own:
            return 1, 0
        if other.degree != k or other.field != own.field:
            return None
        for sign in (1, -1):
            shift = own.field.rational_value((own[k - 1] / own.lc - sign * other[k - 1] / other.lc) / -k)
            if shift is not None and shift.denominator == 1:
                moved = own(sign * N + int(shift))
                if moved * other.lc == other * moved.lc:
                    return sign, int(shift)
        return None

    def decided(self, assumptions: Assumptions) -> bool | None:
        if self.form is not None:
            return assumptions.meets_classes(self.form, self.cosets)
        roots = [-f[0] for f, _ in self.equation.field.factor(self.equation) if f.degree == 1] if assumptions else []
        return True if any(assumptions.meets_classes(over_parameters(root), self.cosets) for root in roots) else None

    def narrowed(self, assumptions: Assumptions) -> Statement:
        """The values of an integer parameter t, of which only finitely many make (a t + b)/(c t + d) so integral."""
        largest = lcm(self.modulus.denominator, *(residue.denominator for residue in self.residues))
        known = None if self.form is None else values_at_integers(self.form, largest)
        if known is None or not assumptions.is_integer(known[0]):
            return self
        name, values = known
        field = self.equation.field
        numbers = [t for t, value in values.items() if any(coset.contains(value) for coset in self.cosets)]
        found = [Vanishes(over_parameters(field.generator(name) - number)) for number in numbers]
        return either(*(here for here in found if here.decided(assumptions) is not False))

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, letter=free_letter(names), fixed=tuple(fixed))

    @cached_property
    def written(self) -> str:
        n, form, (first, *others), modulus = Notation(self.letter, self.fixed), self.form, self.residues, self.modulus
        if form is None:
            return integer_condition(self.equation, [*map(int, self.residues)], int(modulus), n)
        if not others and modulus == 1:
            return f"`{n.function(form)}{f' - {first}' if first else ''} in Z`"
        if not others and not first and modulus.numerator == 1:
            return f"`{n.function(form * modulus.denominator)} in Z`"
        if not others and modulus == 2 and first.denominator == 1:
            return f"`{n.function(form)}` is {kind(self.residues, modulus)}"
        scale = lcm(first.denominator, modulus.denominator)
        equation = over_parameters(form * scale - form.field.poly([0, 1]))
        if not others and sum(map(bool, degrees(equation))) > 1 and families(equation):
            return integer_condition(equation, [int(first * scale)], int(modulus * scale), Notation(self.letter))
        return f"`{n.function(form)} = {', '.join(map(str, self.residues))} mod {modulus}`"


def free_letter(names: Collection[str], preferred: str = LETTERS) -> str:
    """A name for an integer that isn't one of the names."""
    return next(letter for letter in chain(preferred, map("n{}".format, count())) if letter not in names)


def integer_roots(equation: FunctionPoly, residues: Sequence[int], modulus: int) -> Statement:
    """When does a polynomial in N over Q(t) have an integer root in these classes?"""
    classes = {r % modulus for r in residues}
    symmetric = classes == {-r % modulus for r in classes}  # and then the signs of N say the same
    statements: list[Statement] = []
    seen: list[Poly] = []
    field = equation.field
    for factor, _ in field.factor(equation):
        if symmetric and factor(field.poly([0, -1])).monic() in seen:
            continue
        seen.append(factor)
        values = [value for c in factor if (value := field.rational_value(c)) is not None]
        if len(values) <= factor.degree:
            statements.append(Congruence.make(over_parameters(factor), classes, modulus))
        elif any(root % modulus in classes for root in rational_roots(QQ.poly(values))):
            return ALWAYS
    return either(*statements)


def rational_roots(polynomial: Poly) -> list[Fraction]:
    """The rational roots of a polynomial over Q or Q(alpha)."""
    common = polynomial
    if isinstance(polynomial, ExtensionPoly):
        common = polynomial.parts[0]
        for part in polynomial.parts[1:]:
            common = common.gcd(part)
    factors = QQ.factor(common) if common.degree > 0 else []
    roots = (QQ.rational_value(-factor[0]) for factor, _ in factors if factor.degree == 1)
    return [root for root in roots if root is not None]

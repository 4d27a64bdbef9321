"""Statements about integers: a function of the parameters lies in given classes modulo a number; a polynomial in N over Q(t)
has an integer root N in given classes.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import chain, count
from math import ceil, gcd, lcm
from random import Random
from typing import Literal

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.parametric.assumptions import Assumptions, Coset, common_multiple
from kovacic.parametric.formulas import written
from kovacic.parametric.functions import degrees, over_parameters
from kovacic.parametric.spectra import LETTERS, classes_text, families, integer_condition
from kovacic.parametric.statements import Point, Statement


@dataclass(frozen=True)
class Classes(Statement):
    """`form` is a rational number that is congruent to one of `residues` modulo `modulus`."""

    form: FunctionPoly
    residues: tuple[Fraction, ...]
    modulus: Fraction
    letter: str = field(default="n", compare=False)

    @classmethod
    def make(cls, form: FunctionPoly, residues: Iterable[Fraction], modulus: Fraction) -> Classes:
        """Normalised: no constant term (in a Laurent series at 0), coprime coefficients, the least modulus."""
        shift = to_fraction(form.rational_coefficients()[0]) if form else Fraction(0)
        numerator = [int(c) for c in (form - shift).num.coeffs()]
        content = gcd(*numerator) * (1 if numerator[0] > 0 else -1)
        scale = Fraction(gcd(*(int(c) for c in (form - shift).den.coeffs())), content)
        normal = (form - shift) * scale
        modulus = abs(modulus * scale)
        found = {((residue - shift) * scale) % modulus for residue in residues}
        reduced, smallest = _reduced(found, modulus)
        return cls(normal, tuple(sorted(reduced)), smallest)

    def _holds(self, point: Point) -> bool:
        value = rational(point.at(self.form))
        return value is not None and any((value - residue) % self.modulus == 0 for residue in self.residues)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return Classes.make(change(self.form), self.residues, self.modulus)

    def sample(self, random: Random) -> list[FunctionPoly]:
        return [self.form - (random.choice(self.residues) + random.randint(-4, 4) * self.modulus)]

    def merged(self, other: Statement) -> Classes | None:
        if not isinstance(other, Classes) or other.form not in (self.form, -self.form):
            return None
        sign = 1 if other.form == self.form else -1
        common = common_multiple(self.modulus, other.modulus)
        numbers = [r + k * self.modulus for r in self.residues for k in range(int(common / self.modulus))]
        numbers += [sign * r + k * other.modulus for r in other.residues for k in range(int(common / other.modulus))]
        return Classes.make(self.form, numbers, common)

    def decided(self, assumptions: Assumptions) -> bool | None:
        return assumptions.meets_classes(self.form, [Coset(residue, self.modulus) for residue in self.residues])

    @property
    def _in_integers(self) -> tuple[FunctionPoly, Fraction] | None:
        """A form and a number whose difference is said to be an integer; None where it isn't one class of integers."""
        if len(self.residues) == 1 and self.modulus == 1:
            return self.form, self.residues[0]
        if not any(self.residues) and len(self.residues) == 1 and self.modulus.numerator == 1:
            return self.form * self.modulus.denominator, Fraction(0)
        return None

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, letter=free_letter(names))

    def written(self, *, latex: bool) -> str:
        if self._in_integers:
            form, residue = self._in_integers
            text = written(form, latex=latex) + (f" - {residue}" if residue else "")
            return rf"{text} \in \mathbb{{Z}}" if latex else f"{text} in Z"
        first, single = self.residues[0], len(self.residues) == 1
        if single and self.modulus != 1 and (self.modulus != 2 or first.denominator > 1):
            scale = lcm(first.denominator, self.modulus.denominator)
            equation = over_parameters(self.form * scale - self.form.field.poly([0, 1]))
            if sum(map(bool, degrees(equation))) > 1 and families(equation):
                residues, modulus = [int(first * scale)], int(self.modulus * scale)
                return integer_condition(equation, residues, modulus, self.letter, latex=latex)
        text = written(self.form, latex=latex)
        if self.modulus == 2 and single and first.denominator == 1:
            kind = classes_text(self.residues, self.modulus)
            return rf"{text} \text{{ is {kind}}}" if latex else f"{text} is {kind}"
        classes = ", ".join(map(str, self.residues))
        return (
            rf"{text} \equiv {classes} \pmod{{{self.modulus}}}" if latex else f"{text} = {classes} mod {self.modulus}"
        )


@dataclass(frozen=True)
class IntegerRoot(Statement):
    """`equation`, a polynomial in N over Q(t), has an integer root N congruent to one of `residues` modulo `modulus`.

    `letter` is what N is called; the `fixed` parameters are constants, for which it isn't solved.
    """

    equation: FunctionPoly
    residues: tuple[int, ...]
    modulus: int
    letter: str = field(default="n", compare=False)
    fixed: tuple[str, ...] = field(default=(), compare=False)

    @classmethod
    def make(cls, equation: FunctionPoly, residues: Iterable[int], modulus: int) -> IntegerRoot:
        """Normalised: the mean of the roots in (-1, 0] by a shift of N, both signs about it, the least modulus."""
        classes, shift, Z = set(residues), 0, equation.field.poly([0, 1])
        mean = equation.field.rational_value(-equation[equation.degree - 1] / (equation.degree * equation.lc))
        if mean is not None:
            shift = ceil(mean)
            equation = over_parameters(equation(Z + shift))
            classes = {r - shift for r in classes}
            twice = int(2 * (mean - shift)) if (2 * mean).denominator == 1 else None
            if twice is not None and equation(twice - Z) == (-1) ** equation.degree * equation:
                classes |= {twice - r for r in classes}
        reduced, smallest = _reduced({Fraction(r % modulus) for r in classes}, Fraction(modulus))
        return cls(equation, tuple(sorted(map(int, reduced))), int(smallest))

    def merged(self, other: Statement) -> IntegerRoot | None:
        if not isinstance(other, IntegerRoot):
            return None
        relation = self._relation(other)
        if relation is None:
            return None
        sign, shift = relation
        common = lcm(self.modulus, other.modulus)
        own = [r + k * self.modulus for r in self.residues for k in range(common // self.modulus)]
        own += [sign * r + shift for m in other.residues for r in range(m, common, other.modulus)]
        return IntegerRoot.make(self.equation, own, common)

    def _relation(self, other: IntegerRoot) -> tuple[int, int] | None:
        """`(sign, shift)` where each root N of the other equation is one, sign N + shift, of this one."""
        if other.equation == self.equation:
            return 1, 0
        N, k, f = self.equation.field.poly([0, 1]), self.equation.degree, self.equation.field
        if other.equation.degree != k or other.equation.field != f:
            return None
        own, others = (e[k - 1] / (e.lc * -k) for e in (self.equation, other.equation))
        for sign in (1, -1):
            shift = f.rational_value(own - sign * others)
            if shift is not None and shift.denominator == 1:
                moved = self.equation(sign * N + int(shift))
                if moved * other.equation.lc == other.equation * moved.lc:
                    return sign, int(shift)
        return None

    def avoiding(self, names: Collection[str], fixed: Collection[str] = ()) -> Statement:
        return replace(self, letter=free_letter(names), fixed=tuple(fixed))

    def _holds(self, point: Point) -> bool:
        roots = rational_roots(point.at(self.equation))
        return any(root.denominator == 1 and int(root) % self.modulus in self.residues for root in roots)

    def rewritten(self, change: Callable[[FunctionPoly], FunctionPoly]) -> Statement:
        return replace(self, equation=change(self.equation))

    def sample(self, random: Random) -> list[FunctionPoly]:
        N = random.choice(self.residues) + random.randint(-3, 3) * self.modulus
        return [over_parameters(self.equation(N))]

    def written(self, *, latex: bool) -> str:
        return integer_condition(self.equation, self.residues, self.modulus, self.letter, self.fixed, latex=latex)


def free_letter(names: Collection[str], preferred: str = LETTERS) -> str:
    """A name for an integer that isn't one of the names."""
    return next(letter for letter in chain(preferred, map("n{}".format, count())) if letter not in names)


def integer_roots(equation: FunctionPoly, residues: Sequence[int], modulus: int) -> Literal[True] | list[Statement]:
    """When does a polynomial in N over Q(t) have an integer root in these classes?

    A list of statements, one for each way (up to the sign of N where the classes are symmetric); True if it always has one.
    """
    classes = {r % modulus for r in residues}
    symmetric = classes == {-r % modulus for r in classes}
    statements: list[Statement] = []
    seen: list[Poly] = []
    field = equation.field
    minus = field.poly([0, -1])
    for factor, _ in field.factor(equation):
        assert isinstance(factor, FunctionPoly)
        mirrored = factor(minus).monic()
        if symmetric and mirrored in seen:
            continue
        seen.append(factor)
        coefficients = [field.rational_value(c) for c in factor]
        if all(c is not None for c in coefficients):
            roots = rational_roots(QQ.poly([c for c in coefficients if c is not None]))
            if any(root.denominator == 1 and int(root) % modulus in classes for root in roots):
                return True
        elif factor.degree == 1:
            statements.append(Classes.make(-factor[0], [Fraction(r) for r in sorted(classes)], Fraction(modulus)))
        else:
            statements.append(IntegerRoot.make(factor, classes, modulus))
    return statements


def rational_roots(polynomial: Poly) -> list[Fraction]:
    """The rational roots of a polynomial over Q or Q(alpha)."""
    common = polynomial
    if isinstance(polynomial, ExtensionPoly):
        common = polynomial.parts[0]
        for part in polynomial.parts[1:]:
            common = common.gcd(part)
    if common.degree < 1:
        return []
    roots = (rational(-factor[0]) for factor, _ in QQ.factor(common) if factor.degree == 1)
    return [root for root in roots if root is not None]


def rational(constant: Poly) -> Fraction | None:
    """A constant as a rational number, or None."""
    return constant.field.rational_value(constant)


def _reduced(residues: set[Fraction], modulus: Fraction) -> tuple[set[Fraction], Fraction]:
    """The same classes for the least modulus of which the given one is a multiple."""
    for k in range(len(residues), 1, -1):
        smaller = modulus / k
        classes = {residue % smaller for residue in residues}
        if len(classes) * k == len(residues):
            return classes, smaller
    return residues, modulus

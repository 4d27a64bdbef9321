"""Exact statements about the parameters: true or false at every point with algebraic coordinates.

The atoms are: a polynomial vanishes; a function of the parameters lies in given classes modulo a number; a polynomial in N
has an integer root N in given classes.  Nothing here is numerical.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import count
from math import gcd
from typing import Any

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ
from kovacic.parametric.assumptions import Assumptions, Coset, common_multiple
from kovacic.parametric.formulas import as_latex, factored, shown, symbol


@dataclass(frozen=True)
class Point:
    """Values of the parameters: constants of one field, Q or Q(alpha), in the order of the names."""

    names: tuple[str, ...]
    values: tuple[Poly, ...]
    field: Field = QQ

    def at(self, function: FunctionPoly) -> Poly:
        """The value of a polynomial over Q(t).  Raises `ZeroDivisionError` where it isn't defined."""
        chosen = [self.values[self.names.index(name)] for name in function.field.names]
        return function.value_at(chosen, self.field)

    def __str__(self) -> str:
        return ", ".join(f"{name} = {value.to_str()}" for name, value in zip(self.names, self.values, strict=True))


class Statement(ABC):
    """A statement about the parameters."""

    @abstractmethod
    def holds(self, point: Point) -> bool:
        """Is it true at the point?"""

    @abstractmethod
    def text(self) -> str:
        """In words and formulas."""

    @abstractmethod
    def latex(self) -> str:
        """As LaTeX, without dollar signs."""

    def decided(self, assumptions: Assumptions) -> bool | None:
        """True or False where that follows from what is known about the parameters; None otherwise."""
        return None

    def avoiding(self, names: Collection[str]) -> Statement:
        """The same statement, in which no integer is called like one of the names."""
        return self

    def __str__(self) -> str:
        return self.text()


@dataclass(frozen=True)
class Vanishes(Statement):
    """`function = 0`."""

    function: FunctionPoly

    def holds(self, point: Point) -> bool:
        return not point.at(self.function)

    def decided(self, assumptions: Assumptions) -> bool | None:
        return assumptions.vanishes(self.function)

    def text(self) -> str:
        return f"{shown(self.function)} = 0"

    def latex(self) -> str:
        return f"{as_latex(self.function)} = 0"


@dataclass(frozen=True)
class Classes(Statement):
    """`form` is a rational number that is congruent to one of `residues` modulo `modulus`."""

    form: FunctionPoly
    residues: tuple[Fraction, ...]
    modulus: Fraction

    @classmethod
    def make(cls, form: FunctionPoly, residues: Iterable[Fraction], modulus: Fraction) -> Classes:
        """Normalised: no constant term (in a Laurent series at 0), coprime coefficients, the least modulus."""
        shift = _constant(form)
        numerator = [int(c) for c in (form - shift).num.coeffs()]
        content = gcd(*numerator) * (1 if numerator[0] > 0 else -1)
        scale = Fraction(gcd(*(int(c) for c in (form - shift).den.coeffs())), content)
        normal = (form - shift) * scale
        modulus = abs(modulus * scale)
        found = {((residue - shift) * scale) % modulus for residue in residues}
        reduced, smallest = _reduced(found, modulus)
        return cls(normal, tuple(sorted(reduced)), smallest)

    def holds(self, point: Point) -> bool:
        value = rational(point.at(self.form))
        return value is not None and any((value - residue) % self.modulus == 0 for residue in self.residues)

    def merged(self, other: Classes) -> Classes | None:
        """Both statements in one (either holds), where they are about the same form."""
        if other.form == self.form:
            residues = other.residues
        elif other.form == -self.form:
            residues = tuple(-r for r in other.residues)
        else:
            return None
        common = common_multiple(self.modulus, other.modulus)
        both = [
            residue + k * modulus
            for values, modulus in ((self.residues, self.modulus), (residues, other.modulus))
            for residue in values
            for k in range(int(common / modulus))
        ]
        return Classes.make(self.form, both, common)

    def decided(self, assumptions: Assumptions) -> bool | None:
        return assumptions.meets_classes(self.form, [Coset(residue, self.modulus) for residue in self.residues])

    def text(self) -> str:
        form = shown(self.form)
        if len(self.residues) == 1 and self.modulus == 1:
            return f"{_shifted(form, self.residues[0])} in Z"
        if len(self.residues) == 1 and not self.residues[0] and self.modulus.numerator == 1:
            return f"{shown(self.form * self.modulus.denominator)} in Z"
        if self.modulus == 2 and self.residues in ((Fraction(0),), (Fraction(1),)):
            return f"{form} is an {'odd' if self.residues[0] else 'even'} integer"
        return f"{form} = {', '.join(map(str, self.residues))} mod {self.modulus}"

    def latex(self) -> str:
        if len(self.residues) == 1 and self.modulus == 1:
            return rf"{_shifted(as_latex(self.form), self.residues[0])} \in \mathbb{{Z}}"
        if len(self.residues) == 1 and not self.residues[0] and self.modulus.numerator == 1:
            return rf"{as_latex(self.form * self.modulus.denominator)} \in \mathbb{{Z}}"
        classes = ", ".join(map(str, self.residues))
        return rf"{as_latex(self.form)} \equiv {classes} \pmod{{{self.modulus}}}"


@dataclass(frozen=True)
class IntegerRoot(Statement):
    """`equation`, a polynomial in N over Q(t), has an integer root N congruent to one of `residues` modulo `modulus`.

    `letter` is what N is called.
    """

    equation: FunctionPoly
    residues: tuple[int, ...]
    modulus: int
    letter: str = field(default="N", compare=False)

    def avoiding(self, names: Collection[str]) -> Statement:
        return replace(self, letter=next(name for name in _letters() if name not in names))

    def holds(self, point: Point) -> bool:
        try:
            value = point.at(self.equation)
        except ZeroDivisionError:
            return False
        return any(
            root.denominator == 1 and int(root) % self.modulus in self.residues for root in rational_roots(value)
        )

    def _numerator(self) -> FunctionPoly:
        return FunctionPoly(self.equation.field, self.equation.num, self.equation.field.context.constant(1))

    def _classes(self) -> str:
        if self.modulus == 1:
            return f"an integer {self.letter}"
        if self.modulus == 2:
            return f"an {'odd' if self.residues == (1,) else 'even'} integer {self.letter}"
        return f"an integer {self.letter} = {', '.join(map(str, self.residues))} mod {self.modulus}"

    def text(self) -> str:
        family = self.family()
        if family is not None:
            return f"{family[0]} = {factored(family[1], self.letter)} for {self._classes()}"
        return f"{shown(self._numerator(), self.letter)} = 0 for {self._classes()}"

    def latex(self) -> str:
        family = self.family()
        formula = (
            f"{symbol(family[0])} = {as_latex(family[1], self.letter)}"
            if family is not None
            else f"{as_latex(self._numerator(), self.letter)} = 0"
        )
        return rf"{formula} \text{{ for {self._classes()}}}"

    def family(self) -> tuple[str, Any] | None:
        """`(name, f)` where the equation says that a parameter is the rational function f(N)."""
        from kovacic.algebra.ratfunc import RatFunc

        field, numerator = self.equation.field, self.equation.num
        used = [i for i in range(len(field.names)) if int(numerator.degrees()[1 + i]) > 0]
        for i in used:
            if int(numerator.degrees()[1 + i]) != 1:
                continue
            parts = {0: {}, 1: {}}  # type: dict[int, dict[Any, Any]]
            for exponents, coefficient in numerator.to_dict().items():
                rest = (*exponents[: 1 + i], 0, *exponents[2 + i :])
                parts[int(exponents[1 + i])][rest] = coefficient
            one = field.context.constant(1)
            above, below = (field.make(field.context.from_dict(parts[k]), one) for k in (0, 1))
            return field.names[i], RatFunc(-above, below)
        return None


@dataclass(frozen=True)
class Either(Statement):
    """At least one of the statements holds."""

    parts: tuple[Statement, ...]

    def holds(self, point: Point) -> bool:
        return any(part.holds(point) for part in self.parts)

    def decided(self, assumptions: Assumptions) -> bool | None:
        decisions = [part.decided(assumptions) for part in self.parts]
        if any(decisions):
            return True
        return False if all(d is False for d in decisions) else None

    def avoiding(self, names: Collection[str]) -> Statement:
        return Either(tuple(part.avoiding(names) for part in self.parts))

    def text(self) -> str:
        return " or ".join(part.text() for part in self.parts)

    def latex(self) -> str:
        return r" \text{ or } ".join(part.latex() for part in self.parts)


@dataclass(frozen=True)
class Both(Statement):
    """All of the statements hold."""

    parts: tuple[Statement, ...]

    def holds(self, point: Point) -> bool:
        return all(part.holds(point) for part in self.parts)

    def decided(self, assumptions: Assumptions) -> bool | None:
        decisions = [part.decided(assumptions) for part in self.parts]
        if any(d is False for d in decisions):
            return False
        return True if all(decisions) else None

    def avoiding(self, names: Collection[str]) -> Statement:
        return Both(tuple(part.avoiding(names) for part in self.parts))

    def text(self) -> str:
        return ", and ".join(f"({part.text()})" if isinstance(part, Either) else part.text() for part in self.parts)

    def latex(self) -> str:
        return r" \text{ and } ".join(part.latex() for part in self.parts)


def either(statements: Sequence[Statement]) -> Statement:
    """One statement that says that at least one of them holds; those about one form are merged."""
    merged: list[Statement] = []
    for statement in statements:
        for k, known in enumerate(merged):
            union = known.merged(statement) if isinstance(known, Classes) and isinstance(statement, Classes) else None
            if union is not None:
                merged[k] = union
                break
        else:
            if statement not in merged:
                merged.append(statement)
    return merged[0] if len(merged) == 1 else Either(tuple(merged))


def integer_roots(equation: FunctionPoly, residues: Sequence[int], modulus: int) -> bool | list[Statement]:
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
            statements.append(IntegerRoot(factor, tuple(sorted(classes)), modulus))
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


def _letters() -> Iterator[str]:
    yield from "NMKJ"
    yield from (f"N{k}" for k in count())


def _shifted(form: str, residue: Fraction) -> str:
    """`form - residue`, in symbols."""
    return form if not residue else f"{form} - {residue}"


def _constant(form: FunctionPoly) -> Fraction:
    value = form.rational_coefficients()
    return Fraction(int(value[0].p), int(value[0].q)) if value else Fraction(0)


def _reduced(residues: set[Fraction], modulus: Fraction) -> tuple[set[Fraction], Fraction]:
    """The same classes for the least modulus of which the given one is a multiple."""
    for k in range(len(residues), 1, -1):
        smaller = modulus / k
        classes = {residue % smaller for residue in residues}
        if len(classes) * k == len(residues):
            return classes, smaller
    return residues, modulus

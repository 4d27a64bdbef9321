"""The constants of an input: algebraic numbers and parameters, and the coefficient field that they need.

An input is read over Q first.  Where a constant turns up that the field lacks, `Enlarged` carries the larger field, and
the input is read again; so every value lies in one field, and an input over Q costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple, TypeVar

from flint import acb, arb, fmpq

from kovacic.algebra.embedding import adjoined_root, principal_root, refined_root, substituted, vanishing_factor
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.rationals import QQ, square_part, to_fraction
from kovacic.equation import ENERGY, EULER
from kovacic.errors import LimitExceeded, NotRational
from kovacic.limits import DEFAULT_LIMITS, MOST_TRIALS, Limits, demand
from kovacic.reading.arithmetic import PRINTED_BITS

T = TypeVar("T")


class Radical(NamedTuple):
    """A root that is known: the principal root of the degree n of a rational number."""

    radicand: Fraction
    n: int
    root: Poly


@dataclass(frozen=True)
class Constants:
    """The algebraic numbers and the names of the parameters that occurred, in the order of appearance.

    `numbers` is Q or the simple extension of it that has the numbers, and `radicals` the roots in it that are known.
    """

    limits: Limits = DEFAULT_LIMITS
    numbers: Field = QQ
    radicals: tuple[Radical, ...] = ()
    parameters: tuple[str, ...] = ()

    @property
    def field(self) -> Field:
        """Q(t1, ..., tk)(theta)."""
        numbers = self.numbers
        if not self.parameters:
            return numbers
        from kovacic.algebra.function_field import FunctionField

        base = FunctionField(self.parameters)
        if not isinstance(numbers, AlgebraicField):
            return base
        return AlgebraicField(base, base.embed(numbers.modulus), numbers.name, numbers.approximation)

    def parameter(self, name: str) -> Poly:
        """The parameter of this name.  Raises `Enlarged` where it is new."""
        if name not in self.parameters:
            demand(self.limits, "parameters", len(self.parameters) + 1, "{} parameters or more")
            raise Enlarged(replace(self, parameters=(*self.parameters, name)))
        field = self.field
        constant: Poly = field.ground.generator(name)  # type: ignore[attr-defined]
        return constant.over(field)

    def radical(self, radicand: Poly, n: int, label: str) -> Poly | None:
        """The principal n-th root of a number, or None if it depends on parameters and isn't in the field.

        Raises `Enlarged` if a number's root isn't in the field, or `LimitExceeded` if the field with it is too large.
        """
        value = self._number(radicand)
        if value is None:
            return radicand.field.sqrt(radicand) if n == 2 else None
        rational = self.numbers.rational_value(value)
        if not value:
            return self._with_parameters(value)
        outer, radical = Fraction(1), None
        if rational is not None:
            if n == 2:  # so that sqrt(8) and sqrt(2) are in one field
                outer, rest = square_part(rational)
                if rest.bit_length() > PRINTED_BITS:  # too long for a name
                    said = f"a root of a number of {rest.bit_length()} bits, above the limit of {PRINTED_BITS}"
                    raise LimitExceeded(said, limit="bits")
                rational, label = Fraction(rest), "I" if rest == -1 else f"sqrt({rest})"
            radical = rational, n
        root = next((known.root for known in self.radicals if radical == known[:2]), None)
        if root is None:
            if (
                n * self.numbers.absolute_degree > MOST_TRIALS
            ):  # factoring takes 0.02 s over Q, and minutes in degree 1200
                raise NotRational(f"{label} isn't an algebraic number of degree {MOST_TRIALS} or less")
            equation = self.numbers.poly([-value if rational is None else -rational, *[0] * (n - 1), 1])
            root = self._root(equation, principal_root(-equation[0], n), label, radical)
        return self._with_parameters(root * outer)

    def algebraic(self, node: Any) -> Poly | None:
        """An algebraic number that SymPy has in any other form, through its minimal polynomial; None if it finds none."""
        import sympy

        if node is sympy.I:
            return self.radical(QQ.poly([-1]), 2, "I")
        exact = node.as_expr() if isinstance(node, sympy.AlgebraicNumber) else node
        minimal = exact.poly if isinstance(exact, sympy.CRootOf) else None
        try:
            minimal = minimal or sympy.minimal_polynomial(exact, sympy.Dummy(), polys=True)
        except NotImplementedError:
            return None
        coefficients = [*map(to_fraction, reversed(minimal.all_coeffs()))]
        real, imaginary = sympy.N(exact).as_real_imag()
        return self.root(QQ.poly(coefficients), acb(arb(str(real)), arb(str(imaginary))))

    def root(self, minimal: Poly, approximation: Any) -> Poly:
        """The root of a polynomial over Q that lies nearest to an approximation (an `acb`)."""
        return self._with_parameters(self._root(minimal.over(self.numbers), refined_root(minimal, approximation), ""))

    def _root(self, equation: Poly, target: Any, label: str, radical: tuple[Fraction, int] | None = None) -> Poly:
        """The root nearest to `target` of a polynomial over the number field; `radical` is (radicand, index) of a root in Q.

        A root that isn't in the field is called `label` if the polynomial is irreducible, else alpha.
        """
        factor = vanishing_factor(equation, target)
        if factor.degree == 1:
            return -factor[0]
        degree = factor.degree * self.numbers.absolute_degree
        demand(self.limits, "constants", degree, "constants in a field of degree {} over the rational numbers")
        is_irreducible = factor.degree == equation.degree
        name = label if label and is_irreducible else "alpha"
        theta, root = adjoined_root(factor, target, name)
        radicals = [known._replace(root=substituted(known.root, theta)) for known in self.radicals]
        if radical is not None:
            radicals.append(Radical(*radical, root))
        raise Enlarged(replace(self, numbers=root.field, radicals=tuple(radicals)))

    def _with_parameters(self, number: Poly) -> Poly:
        """An element of the number field in the whole field."""
        field = self.field
        if not isinstance(field, AlgebraicField) or field.base == QQ:
            return number
        parts = number.parts if isinstance(number, ExtensionPoly) else (number,)
        return field.element(field.base.poly([part.field.rational_value(part) or 0 for part in parts]))

    def _number(self, value: Poly) -> Poly | None:
        """A constant that doesn't depend on parameters, as an element of the number field."""
        if value.field in (self.numbers, QQ):
            return value.over(self.numbers)
        numbers: list[Any] = [part.field.rational_value(part) for part in getattr(value, "parts", (value,))]
        if None in numbers:
            return None
        constant = QQ.poly(numbers)
        return self.numbers.element(constant) if isinstance(self.numbers, AlgebraicField) else constant

    def notices(self, letters: Collection[str] = ()) -> list[str]:
        """Notes for the user about the field; `letters` stand for numbers."""
        found = []
        if self.parameters:
            taken = "is taken as a parameter" if len(self.parameters) == 1 else "are taken as parameters"
            found.append(f"{', '.join(self.parameters)} {taken} with generic values")
        if ENERGY in self.parameters:
            said = f"{ENERGY} is a parameter here, an energy; Euler's number, being transcendental, is one of its"
            found.append(f"{said} generic values")
        if EULER in letters:
            found.append(f"{EULER} is Euler's number; it is a letter where it is declared, --names {EULER}")
        if f"{EULER}_" in letters:
            found.append(f"{EULER}_ is Euler's number")
        numbers = self.numbers
        if isinstance(numbers, AlgebraicField) and numbers.name == "alpha":
            real, imaginary = map(float, numbers.approximation or ())
            where = f"{real:.6g}"
            if imaginary:
                where += f" {'-' if imaginary < 0 else '+'} {abs(imaginary):.6g}*I"
            found.append(f"alpha is the root of {numbers.modulus.to_str('alpha')} near {where}")
        return found


class Enlarged(Exception):
    """The field must be larger; the argument is the `Constants` that have it."""


def with_root(numbers: Sequence[Poly], field: Field, other: AlgebraicField, limits: Limits) -> list[Poly]:
    """Numbers of one field, followed by the generator of another one, in a common field within the limits."""
    near = acb(*(arb(fmpq(part.numerator, part.denominator)) for part in other.approximation or ()))

    def read(constants: Constants) -> list[Poly]:
        root = constants.root(other.modulus, near)
        return [*(known.root.over(root.field) for known in constants.radicals), root]

    # As radicals, the numbers are carried into a larger field; no root is one of degree 0.
    known = tuple(Radical(Fraction(0), 0, number) for number in numbers)
    return read_with_constants(read, Constants(limits, field, known))


def read_with_constants(read: Callable[[Constants], T], constants: Constants) -> T:
    """The result of `read`, called again with a larger field as long as it raises `Enlarged`."""
    while True:
        try:
            return read(constants)
        except Enlarged as enlarged:
            (constants,) = enlarged.args

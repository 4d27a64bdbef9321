"""The constants of an input: algebraic numbers and parameters, and the coefficient field that they need.

An input is read over Q first.  Where a constant turns up that the field lacks, `Enlarged` carries the larger field, and
the input is read again; so every value lies in one field, and an input over Q costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, TypeVar

from flint import acb, arb, fmpq

from kovacic.algebra.embedding import adjoined_root, principal_root, refined_root, substituted, vanishing_factor
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, square_part
from kovacic.equation import ENERGY, lowered, over
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Limits

T = TypeVar("T")

#: Bits of a number whose square root becomes the name of a field: Python prints integers of at most 4300 digits.
_LARGEST_RADICAND = 14_000

#: Digits of the approximation that tells an algebraic number of SymPy from its conjugates.
_DIGITS = 15


@dataclass(frozen=True)
class Constants:
    """The algebraic numbers and the names of the parameters that occurred, in the order of appearance.

    `numbers` is Q or the simple extension of it that has the numbers, and `radicals` the roots in it that are known:
    (radicand, n, root).
    """

    limits: Limits = DEFAULT_LIMITS
    numbers: Field = QQ
    radicals: tuple[tuple[Fraction, int, Poly], ...] = ()
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
            if len(self.parameters) >= self.limits.parameters:
                raise LimitExceeded(f"more than {self.limits.parameters} parameters, the limit", limit="parameters")
            raise Enlarged(replace(self, parameters=(*self.parameters, name)))
        field = self.field
        constant: Poly = field.ground.generator(name)  # type: ignore[attr-defined]
        return constant.over(field)

    def radical(self, radicand: Poly, n: int, label: str) -> Poly | None:
        """The principal n-th root of a number; None where it depends on parameters and isn't in the field.

        Raises `Enlarged` where a number's root isn't in the field, and `LimitExceeded` where the field with it would be
        too large.
        """
        value = self._number(radicand)
        if value is None:
            return radicand.field.sqrt(radicand) if n == 2 else None
        if n == 2 and radicand.field == QQ and (bits := radicand.height_bits()) > _LARGEST_RADICAND:
            root = QQ.sqrt(radicand)
            if root is None:
                said = f"a root of a number of {bits} bits, above the limit of {_LARGEST_RADICAND}"
                raise LimitExceeded(said, limit="bits")
            return root.over(self.field)
        if not value:
            return self._with_parameters(value)
        rational = self.numbers.rational_value(value)
        outer = Fraction(1)
        if n == 2 and rational is not None:
            outer, rest = square_part(rational)
            rational = Fraction(rest)
            value = self.numbers.poly([rest])
            label = "I" if rest == -1 else f"sqrt({rest})"
        one = (Fraction(1), 2, self.numbers.poly([1]))
        root = next((c for q, k, c in (one, *self.radicals) if k == n and q == rational), None)
        if root is None:
            equation = self.numbers.poly([-value, *[0] * (n - 1), 1])
            root = self._root(equation, principal_root(value, n), label, () if rational is None else ((rational, n),))
        return self._with_parameters(root * outer)

    def algebraic(self, node: Any) -> Poly | None:
        """An algebraic number that SymPy has in any other form, through its minimal polynomial; None where it finds none."""
        import sympy

        if node is sympy.I:
            return self.radical(QQ.poly([-1]), 2, "I")
        exact = node.as_expr() if isinstance(node, sympy.AlgebraicNumber) else node
        try:
            is_root = isinstance(exact, sympy.CRootOf)
            minimal = exact.poly if is_root else sympy.minimal_polynomial(exact, sympy.Dummy(), polys=True)
        except NotImplementedError:
            return None
        coefficients = [Fraction(int(c.p), int(c.q)) for c in reversed(minimal.all_coeffs())]
        real, imaginary = sympy.N(exact, _DIGITS).as_real_imag()
        return self.root(QQ.poly(coefficients), acb(arb(str(real)), arb(str(imaginary))))

    def root(self, minimal: Poly, approximation: Any) -> Poly:
        """The root of a polynomial over Q that lies nearest to an approximation (an `acb`)."""
        return self._with_parameters(self._root(minimal.over(self.numbers), refined_root(minimal, approximation), ""))

    def _root(self, equation: Poly, target: Any, label: str, radical: tuple[tuple[Fraction, int], ...] = ()) -> Poly:
        """The root nearest to `target` of a polynomial over the number field; `radical` says which one it is, if any."""
        factor = vanishing_factor(equation, target)
        if factor.degree == 1:
            return -factor[0]
        degree = factor.degree * self.numbers.absolute_degree
        limit = self.limits.constants
        if degree > limit:
            said = f"constants in a field of degree {degree} over the rational numbers, above the limit of {limit}"
            raise LimitExceeded(said, limit="constants")
        theta, root = adjoined_root(factor, target, label if label and factor.degree == equation.degree else "alpha")
        known = [(q, n, substituted(c, theta)) for q, n, c in self.radicals]
        radicals = (*known, *((q, n, root) for q, n in radical))
        raise Enlarged(replace(self, numbers=root.field, radicals=radicals))

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
        parts = getattr(value, "parts", (value,))
        known = [c for part in parts if (c := part.field.rational_value(part)) is not None]
        if len(known) < len(parts):
            return None
        constant = QQ.poly(known)
        return self.numbers.element(constant) if isinstance(self.numbers, AlgebraicField) else constant

    def embedded(self, function: RatFunc) -> RatFunc:
        """The rational function over the whole field, or over Q if it lies there."""
        field = self.field
        return function if field == function.field == QQ else lowered(over(function, field))

    def notices(self) -> list[str]:
        """What the user should know about the field."""
        found = []
        if self.parameters:
            taken = "is taken as a parameter" if len(self.parameters) == 1 else "are taken as parameters"
            found.append(f"{', '.join(self.parameters)} {taken} with generic values")
        for name, meaning in ((ENERGY, "a parameter here, an energy"), ("e", "a parameter here")):
            if name in self.parameters:
                found.append(f"{name} is {meaning}; Euler's number, being transcendental, is one of its generic values")
        numbers = self.numbers
        if isinstance(numbers, AlgebraicField) and numbers.name == "alpha":
            real, imaginary = map(float, numbers.approximation or ())
            where = f"{real:.6g}"
            if imaginary:
                where += f" {'-' if imaginary < 0 else '+'} {abs(imaginary):.6g}*I"
            found.append(f"alpha is the root of {numbers.modulus.to_str('alpha')} near {where}")
        return found


class Enlarged(Exception):
    """The field must be larger; `constants` has it."""

    def __init__(self, constants: Constants) -> None:
        super().__init__()
        self.constants = constants


def with_root(numbers: Sequence[Poly], field: Field, other: AlgebraicField, limits: Limits) -> list[Poly]:
    """Numbers of one field, and after them the generator of another one, in a field that has them all.

    Raises `LimitExceeded` where its degree would be above the limit.
    """
    near = acb(*(arb(fmpq(part.numerator, part.denominator)) for part in other.approximation or ()))

    def read(constants: Constants) -> list[Poly]:
        root = constants.root(other.modulus, near)
        return [*(number.over(root.field) for _, _, number in constants.radicals), root]

    return read_with_constants(read, limits, Constants(limits, field, tuple((Fraction(0), 0, n) for n in numbers)))


def read_with_constants(read: Callable[[Constants], T], limits: Limits, known: Constants | None = None) -> T:
    """The result of `read`, called again with a larger field as long as it raises `Enlarged`."""
    constants = known or Constants(limits)
    while True:
        try:
            return read(constants)
        except Enlarged as enlarged:
            constants = enlarged.constants

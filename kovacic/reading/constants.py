"""The constants of an input: algebraic numbers and parameters, and the coefficient field that they need.

An input is read over Q first.  Where a constant turns up that the field lacks, `Enlarged` carries the larger field, and
the input is read again; so every value lies in one field, and an input over Q costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from kovacic.algebra.embedding import RATIONAL_NUMBERS, NumberField, refined_root
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.errors import LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.parsed import ENERGY

T = TypeVar("T")

#: Bits of a number whose square root becomes the name of a field: Python prints integers of at most 4300 digits.
_LARGEST_RADICAND = 14_000


@dataclass(frozen=True)
class Constants:
    """The algebraic numbers (`numbers`) and the names of the parameters that occurred, in the order of appearance."""

    limits: Limits = DEFAULT_LIMITS
    numbers: NumberField = RATIONAL_NUMBERS
    parameters: tuple[str, ...] = ()

    @property
    def field(self) -> Field:
        """Q(t1, ..., tk)(theta)."""
        base: Field = QQ
        if self.parameters:
            from kovacic.algebra.function_field import FunctionField

            base = FunctionField(self.parameters)
        algebraic = self.numbers.field
        if not isinstance(algebraic, AlgebraicField):
            return base
        if base == QQ:
            return algebraic
        return AlgebraicField(base, base.embed(algebraic.modulus), algebraic.name, algebraic.approximation)

    def parameter(self, name: str) -> Poly:
        """The parameter of this name.  Raises `Enlarged` where it is new."""
        if name not in self.parameters:
            if len(self.parameters) >= self.limits.parameters:
                raise LimitExceeded(f"more than {self.limits.parameters} parameters, the limit", limit="parameters")
            raise Enlarged(replace(self, parameters=(*self.parameters, name)))
        from kovacic.algebra.function_field import FunctionField

        field = self.field
        ground = field.ground
        assert isinstance(ground, FunctionField)
        constant: Poly = ground.generator(name)
        return constant if field == ground else field.embed(constant)

    def radical(self, radicand: Poly, n: int, label: str) -> Poly | None:
        """The principal n-th root of a number; None where it depends on parameters and isn't in the field."""
        value = self._number(radicand)
        if value is None:
            return radicand.field.sqrt(radicand) if n == 2 else None
        if n == 2 and radicand.field == QQ and radicand.height_bits() > _LARGEST_RADICAND:
            root = QQ.sqrt(radicand)
            if root is None:
                said = f"a root of a number of {radicand.height_bits()} bits, above the limit of {_LARGEST_RADICAND}"
                raise LimitExceeded(said, limit="bits")
            return root.over(self.field)
        return self._accepted(*self.numbers.radical(value, n, label, self.limits.constants))

    def imaginary_unit(self) -> Poly:
        """I."""
        root = self.radical(QQ.poly([-1]), 2, "I")
        assert root is not None
        return root

    def root(self, minimal: Poly, approximation: Any, label: str) -> Poly:
        """The root of a polynomial over Q that lies nearest to an approximation (an `acb`)."""
        equation = minimal.over(self.numbers.field)
        target = refined_root(minimal, approximation)
        return self._accepted(*self.numbers.root(equation, target, label, self.limits.constants))

    def embedded(self, function: RatFunc) -> RatFunc:
        """The rational function over the whole field, or over Q if it lies there."""
        field = self.field
        if field == function.field == QQ:
            return function
        parts = [function.num.over(field), function.den.over(field)]
        leaves = [leaf for part in parts for leaf in (part.parts[1:] if isinstance(part, ExtensionPoly) else ())]
        if isinstance(field, AlgebraicField) and not any(leaves):
            parts = [part.parts[0] for part in parts if isinstance(part, ExtensionPoly)]
        return RatFunc(parts[0], parts[1], reduced=True)

    def notices(self) -> list[str]:
        """What the user should know about the field."""
        found = []
        if self.parameters:
            names = ", ".join(self.parameters)
            one = len(self.parameters) == 1
            found.append(
                f"{names} {'is taken as a parameter' if one else 'are taken as parameters'} with generic values"
            )
        for name, meaning in ((ENERGY, "a parameter here, an energy"), ("e", "a parameter here")):
            if name in self.parameters:
                found.append(f"{name} is {meaning}; Euler's number, being transcendental, is one of its generic values")
        algebraic = self.numbers.field
        if isinstance(algebraic, AlgebraicField) and algebraic.name == "alpha":
            where = self.numbers.located()
            found.append(f"alpha is the root of {algebraic.modulus.to_str('alpha')} near {where}")
        return found

    def _accepted(self, numbers: NumberField, root: Poly) -> Poly:
        if numbers.field != self.numbers.field:
            raise Enlarged(replace(self, numbers=numbers))
        field = self.field
        if field == numbers.field or not isinstance(field, AlgebraicField):
            return root
        return field.poly([]) if not root else _over_parameters(root, field)

    def _number(self, value: Poly) -> Poly | None:
        """A constant that doesn't depend on parameters, as an element of the number field."""
        field = self.numbers.field
        if value.field == field or value.field == QQ:
            return value.over(field)
        parts = value.parts if isinstance(value, ExtensionPoly) else (value,)
        rational = [part.field.rational_value(part) for part in parts]
        known = [c for c in rational if c is not None]
        if len(known) < len(rational):
            return None
        if not isinstance(field, AlgebraicField):
            return field.poly(known)
        zeros = [QQ.poly([c]) for c in known] + [QQ.poly([])] * (field.dimension - len(known))
        return ExtensionPoly.make(field, zeros)


def _over_parameters(root: Poly, field: AlgebraicField) -> Poly:
    parts = root.parts if isinstance(root, ExtensionPoly) else (root,)
    padded = [field.base.embed(part) for part in parts] + [field.base.poly([])] * (field.dimension - len(parts))
    return ExtensionPoly.make(field, padded)


class Enlarged(Exception):
    """The field must be larger; `constants` has it."""

    def __init__(self, constants: Constants) -> None:
        super().__init__()
        self.constants = constants


def read_with_constants(read: Callable[[Constants], T], limits: Limits) -> T:
    """The result of `read`, called again with a larger field as long as it raises `Enlarged`."""
    constants = Constants(limits)
    while True:
        try:
            return read(constants)
        except Enlarged as enlarged:
            constants = enlarged.constants

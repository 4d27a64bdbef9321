"""Functions that the package wrote, read back over the field that they are known to belong to: those of JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.reading.arithmetic import Arithmetic, Value
from kovacic.reading.expression import parse_with


@dataclass(frozen=True)
class WrittenReader:
    """`names` are what the names stand for that occur, formulas such as sqrt(2) among them, in the field or below it."""

    field: Field
    names: Mapping[str, Value]
    arithmetic: Arithmetic

    def ratfunc(self, text: str) -> RatFunc:
        """Raises `InputError` for what isn't a rational function in these names."""
        names: dict[str, Value] = {}
        for number, (name, value) in enumerate(self.names.items()):
            plain = name if name.isidentifier() else f"constant_{number}_"
            names[plain] = value
            if plain != name:
                text = text.replace(name, f"({plain})")
        value = self.arithmetic.rational(parse_with(text, names, self.arithmetic))
        return RatFunc(value.num.over(self.field), value.den.over(self.field), reduced=True)

    def poly(self, text: str) -> Poly:
        """Raises `ValueError` where it isn't a polynomial."""
        value = self.ratfunc(text)
        if not value.is_polynomial:
            raise ValueError(f"{text!r} isn't a polynomial")
        return value.num

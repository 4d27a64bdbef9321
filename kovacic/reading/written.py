"""Functions that the package wrote, read back over the field that they are known to belong to: those of JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import Equation, over
from kovacic.reading.arithmetic import Arithmetic, Value
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.dialects import tokenize
from kovacic.reading.differential import EquationReader
from kovacic.reading.expression import parse_with
from kovacic.reading.parser import evaluate
from kovacic.reading.source import Source


@dataclass(frozen=True)
class WrittenReader:
    """`names` are what the names stand for that occur, formulas such as sqrt(2) among them, in the field or below it."""

    field: Field
    names: Mapping[str, Value]
    arithmetic: Arithmetic

    def plain(self, text: str) -> tuple[str, dict[str, Value]]:
        """The text with a name for each formula among the names, and the values of all of them."""
        names: dict[str, Value] = {}
        for number, (name, value) in enumerate(self.names.items()):
            plain = name if name.isidentifier() else f"constant_{number}_"
            names[plain] = value
            if plain != name:
                text = text.replace(name, f"({plain})")
        return text, names

    def ratfunc(self, text: str) -> RatFunc:
        """Raises `InputError` for what isn't a rational function in these names."""
        text, names = self.plain(text)
        return over(self.arithmetic.rational(parse_with(text, names, self.arithmetic)), self.field)

    def poly(self, text: str) -> Poly:
        """Raises `ValueError` where it isn't a polynomial."""
        value = self.ratfunc(text)
        if not value.is_polynomial:
            raise ValueError(f"{text!r} isn't a polynomial")
        return value.num


def written_equation(text: str, variable: str, unknown: str, known: Constants) -> Equation:
    """The equation that a text denotes over the field of these constants, whose parameters may be called like formulas."""

    def read(constants: Constants) -> Equation:
        field = constants.field
        values: dict[str, Value] = {
            name: field.ground.generator(name).over(field)  # type: ignore[attr-defined]
            for name in constants.parameters
        }
        if isinstance(field, AlgebraicField):
            values[field.name] = field.generator
        plain, names = WrittenReader(field, values, Arithmetic(constants.limits)).plain(text)
        source = Source(partial(evaluate, tokenize(plain)), variable, unknown)
        reader = EquationReader(source, constants.limits, constants)
        reader.names = {**reader.names, **names}
        return reader.equation_of(source.walk(reader), plain)

    return read_with_constants(read, known.limits, known)

"""How the variable, the generator of the constants and the unknown of the Riccati polynomial are called in print."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import count

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ

# The names within the engine.
_VARIABLE = "x"
_SYMBOL = "c"


def parameters_of(field: Field) -> tuple[str, ...]:
    """The names of the parameters of a coefficient field."""
    ground = field.ground
    return () if ground == QQ else ground.names  # type: ignore[attr-defined]


def _first_free(name: str, taken: set[str]) -> str:
    return next(candidate for k in count() if (candidate := name + (str(k) if k else "")) not in taken)


class Names:
    """The names of one answer: those of the engine, unless the user's variable is called the same."""

    def __init__(self, variable: str, taken: Sequence[str] = ()) -> None:
        """`taken` are the names of the parameters."""
        self.variable = variable
        self.symbol = _first_free(_SYMBOL, {variable, *taken})
        self.unknown = next(name for name in ("w", "W", "w1", "w2", "w3") if name not in {variable, *taken})

    def poly(self, polynomial: Poly) -> str:
        """Python syntax."""
        return self._renamed(polynomial).to_str(self.variable)

    def ratfunc(self, function: RatFunc) -> str:
        """Python syntax."""
        return self.renamed(function).to_str(self.variable)

    def renamed(self, function: RatFunc) -> RatFunc:
        """The same function, whose constants are printed with `symbol`."""
        return RatFunc(self._renamed(function.num), self._renamed(function.den), reduced=True)

    def place(self, place: str) -> str:
        """A factor of the denominator, which evidence has in the engine's variable, in the user's."""
        return place if self.variable == _VARIABLE else re.sub(rf"\b{_VARIABLE}\b", self.variable, place)

    def internal_place(self, place: str) -> str:
        """The inverse of `place`."""
        return place if self.variable == _VARIABLE else re.sub(rf"\b{re.escape(self.variable)}\b", _VARIABLE, place)

    def _renamed(self, polynomial: Poly) -> Poly:
        if not isinstance(polynomial, ExtensionPoly):
            return polynomial
        field = polynomial.field
        if field.name != _SYMBOL or self.symbol == _SYMBOL:  # any other name belongs to the field of S
            return polynomial
        return ExtensionPoly.make(AlgebraicField(field.base, field.modulus, self.symbol), polynomial.parts)

"""How the variable, the generator of the constants and the unknown of the Riccati polynomial are called in print."""

from __future__ import annotations

import re

from kovacic.algebra.fields import AlgebraicField, ExtensionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc

# The names within the engine.
_VARIABLE = "x"
_SYMBOL = "c"


class Names:
    """The names of one answer: those of the engine, unless the user's variable is called the same."""

    def __init__(self, variable: str) -> None:
        self.variable = variable
        self.symbol = _SYMBOL if variable != _SYMBOL else _SYMBOL + "1"
        self.unknown = "w" if variable != "w" else "W"

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
        if not isinstance(polynomial, ExtensionPoly) or polynomial.field.name == self.symbol:
            return polynomial
        field = polynomial.field
        return ExtensionPoly.make(AlgebraicField(field.base, field.modulus, self.symbol), polynomial.parts)

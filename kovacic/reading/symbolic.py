"""Text into SymPy expressions, as SymPy's own operators build them; nothing is ever executed.

>>> read_expression("3/2*cos(u) + sin(u)^2/4", names={"u": sympy.Symbol("u")})
sin(u)**2/4 + 3*cos(u)/2
>>> read_expression("sqrt(8) + n*e^2")
n*exp(2) + 2*sqrt(2)
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy

from kovacic.errors import InputError
from kovacic.limits import Limits
from kovacic.reading.arithmetic import NotAnInteger, Term
from kovacic.reading.expression import Place, RationalReader
from kovacic.reading.given import FUNCTION_NAMES, NUMBER_NAMES
from kovacic.reading.lexer import tokens_of
from kovacic.reading.linear import LinearArithmetic
from kovacic.reading.parser import Site, evaluate

LIMITS = Limits(text_length=10_000, digits=1000, exponent=1000, bits=10_000)
_CONSTANTS = {"pi": sympy.pi, "π": sympy.pi, "e": sympy.E, "I": sympy.I}


def read_expression(
    text: str, *, names: Mapping[str, Any] | None = None, what: str = "the expression", limits: Limits = LIMITS
) -> Any:
    """The SymPy expression that a text denotes in `names`, pi, e, I and the elementary functions; decimals are exact.

    Without `names`, every other name is a symbol.  Raises `InputError`, with the position, for anything else (`what` says
    in the message what the text stands for), and `LimitExceeded` for a text, a number or a power that is too large.
    """
    tokens = tokens_of(text, limits, what=what)
    reader = SymbolicReader(names, what, limits)
    return reader.arithmetic.expression(evaluate(tokens, reader))


class SymbolicReader(RationalReader):
    """What a text means as a SymPy expression."""

    arithmetic: LinearArithmetic

    def __init__(self, names: Mapping[str, Any] | None, what: str, limits: Limits) -> None:
        super().__init__(names or {}, "", LinearArithmetic(limits))
        self.any_name = names is None
        self.what = what

    def name(self, name: str) -> Any:
        if name in self.names or name in _CONSTANTS:
            return self.names.get(name, _CONSTANTS.get(name))
        if not self.any_name or name in NUMBER_NAMES:
            raise InputError(f"{self.what} can't contain {name}")
        return sympy.Symbol(name)

    def derivative(self, text: str) -> Any:
        raise InputError(f"{self.what} can't contain the derivative {text}")

    def equation(self, left: Any, right: Any) -> Any:
        raise InputError(f"{self.what} is an expression, not an equation")

    def power(self, base: Any, exponent: Any, place: Place) -> Any:
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            return self.arithmetic.symbolic_power(base, exponent)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        if head == "root" and len(arguments) == 2:
            return self.power(arguments[0], self.arithmetic.divide(Term(1, 0), arguments[1]), site)
        if head not in FUNCTION_NAMES or len(arguments) != 1 or isinstance(arguments[0], tuple):
            hint = f"the functions are {', '.join(sorted(FUNCTION_NAMES))}, of one argument"
            raise InputError(f"{self.what} can't contain {site.text()}", hint=hint)
        return self.arithmetic.applied(head, arguments[0])

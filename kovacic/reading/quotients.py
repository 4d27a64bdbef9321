"""Equations with the unknown function in denominators, y''/y = x: multiplied out.

>>> from kovacic.reading.source import source_of
>>> expression = expression_of(source_of("y''/y = x", None, equation=True), Limits())
>>> multiplied_out(expression, sympy.Function("y")(sympy.Symbol("x")))
-x*y(x) + Derivative(y(x), (x, 2))
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy.core.function import AppliedUndef

from kovacic.errors import InputError
from kovacic.limits import Limits
from kovacic.reading.lexer import DERIVATIVES, PRIMES
from kovacic.reading.parser import Site
from kovacic.reading.source import Source
from kovacic.reading.symbolic import SymbolicReader

Expr = Any  # SymPy publishes no types
_HIGHEST = 2


def multiplied_out(expression: Expr, function: Expr) -> Expr | None:
    """What is zero where a quotient is, linear in y, y' and y''; None where there is no such.  y = 0 is left out."""
    x = function.args[0]
    derivatives = [function.diff(x, 2), function.diff(x), function]
    unknown = [sympy.Dummy("y2"), sympy.Dummy("y1"), sympy.Dummy("y0")]
    plain = expression.xreplace(dict(zip(derivatives, unknown, strict=True)))
    is_left = any(f.func == function.func for f in plain.atoms(AppliedUndef))
    if is_left or plain.has(sympy.Derivative):
        return None
    numerator, denominator = sympy.fraction(sympy.together(plain))
    if not denominator.has(*unknown) or not numerator.is_polynomial(*unknown):
        return None
    polynomial = sympy.Poly(numerator, *unknown)
    if polynomial.total_degree() != 1:
        return None
    return sympy.expand(polynomial.as_expr().xreplace(dict(zip(unknown, derivatives, strict=True))))


def expression_of(source: Source, limits: Limits, *, what: str = "the equation") -> Expr:
    """An equation in a text as the SymPy expression that is zero, whether it is linear or not.  Raises `InputError`."""
    reader = _TextReader(source.variable, source.unknown, limits, what)
    return reader.arithmetic.expression(source.walk(reader))


class _TextReader(SymbolicReader):
    """What a text means; the unknown function y is y(x)."""

    def __init__(self, variable: str, unknown: str, limits: Limits, what: str) -> None:
        super().__init__(None, what, limits)
        self.unknown = unknown
        self.x = sympy.Symbol(variable)
        self.function = sympy.Function(unknown)(self.x)

    def name(self, name: str) -> Any:
        if name == self.unknown:
            return self.function
        return super().name(name)

    def derivative(self, text: str) -> Any:
        order = len(text) - len(self.unknown)
        if text.rstrip(PRIMES) != self.unknown or order > _HIGHEST:
            return super().derivative(text)
        return self.function.diff(self.x, order)

    def equation(self, left: Any, right: Any) -> Any:
        return self.arithmetic.sum([left, self.arithmetic.negate(right)])

    def follows_without_sign(self, name: str) -> bool:
        return name.rstrip(PRIMES) == self.unknown or name in DERIVATIVES

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        if head in DERIVATIVES:
            return self._differentiated(arguments, site)
        if head.rstrip(PRIMES) != self.unknown or arguments != [self.x]:
            return super().call(head, arguments, site)
        if head == self.unknown:
            return self.function
        return self.derivative(head)

    def _differentiated(self, arguments: list[Any], site: Site) -> Any:
        """diff(y, x), diff(y, x, 2): what is differentiated may be any expression."""
        order = self._order(arguments)
        if order is None:
            raise InputError(f"{self.what} can't contain {site.text()}", hint="for example diff(y, x) or diff(y, x, 2)")
        return self.arithmetic.expression(arguments[0]).diff(self.x, order)

    def _order(self, arguments: list[Any]) -> int | None:
        """1 or 2, where the arguments are an expression, x, and maybe the order; 1 for (...)'; else None."""
        if len(arguments) == 1:
            return 1
        if any(isinstance(argument, tuple) for argument in arguments):
            return None
        _, *by = (self.arithmetic.expression(argument) for argument in arguments)
        if by == [self.x]:
            return 1
        for order in range(1, _HIGHEST + 1):
            if by == [self.x, order]:
                return order
        return None

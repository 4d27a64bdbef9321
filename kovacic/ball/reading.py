"""Numbers and potentials as text, read by the package's own grammar into SymPy expressions; nothing is ever executed.

>>> read_expression("3/2*cos(u) + sin(u)^2/4", what="the potential", names={"u": sp.Symbol("u")})
sin(u)**2/4 + 3*cos(u)/2
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy as sp

from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Arithmetic, NotAnInteger
from kovacic.reading.automaton import run
from kovacic.reading.lexer import tokenize
from kovacic.reading.parser import ExpressionBuilder, Where

FUNCTIONS = {"sqrt": sp.sqrt, "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "exp": sp.exp, "log": sp.log}
#: Small enough for SymPy, whose functions are recursive and whose integers aren't bounded.
LIMITS = Limits(text_length=500, digits=100, exponent=100, bits=500)


def read_expression(text: str, *, what: str, names: Mapping[str, sp.Expr]) -> sp.Expr:
    """The expression in `names`, pi and `FUNCTIONS` that a text denotes; decimals are exact.

    Raises `InputError`, with the position, for anything else (`what` says in the message what the text stands for), and
    `LimitExceeded` for a text, a number or a power that is too large.
    """
    if len(text) > LIMITS.text_length:
        raise LimitExceeded(
            f"{what} has {len(text)} characters, above the limit of {LIMITS.text_length}", limit="text_length"
        )
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise InputError(f"{what} is empty", text=text, position=0)
    return run(tokens, _Builder({"pi": sp.pi, **names}, what))


class _Expressions(Arithmetic):
    """The arithmetic of SymPy expressions, with the sizes of numbers checked before powers and after products."""

    def constant(self, value: int | Fraction) -> Any:
        return self._checked(sp.Rational(value))

    def negate(self, value: Any) -> Any:
        return -value

    def add(self, left: Any, right: Any, *, subtract: bool = False) -> Any:
        return self._checked(left - right if subtract else left + right)

    def multiply(self, left: Any, right: Any) -> Any:
        return self._checked(left * right)

    def divide(self, left: Any, right: Any) -> Any:
        if right.is_zero:
            raise ZeroDivisionError("division by zero")
        return self._checked(left / right)

    def power(self, base: Any, exponent: Any) -> Any:
        n = sp.sympify(exponent, strict=True)
        if not n.is_Integer:
            raise NotAnInteger
        if abs(n) > self.limits.exponent:
            raise LimitExceeded(f"an exponent above the limit of {self.limits.exponent}", limit="exponent")
        if base.is_zero and n <= 0:
            raise ZeroDivisionError("0 has no powers with exponent zero or below")
        if base.is_Rational:
            self._check(0, int(abs(n)) * max(int(base.p).bit_length(), int(base.q).bit_length()))
        return base**n

    def _checked(self, value: Any) -> Any:
        if value.is_Rational:
            self._check(0, max(int(value.p).bit_length(), int(value.q).bit_length()))
        return value


class _Builder(ExpressionBuilder):
    """What the grammar's rules build: SymPy expressions."""

    def __init__(self, names: Mapping[str, Any], what: str) -> None:
        super().__init__(names, "u", _Expressions(LIMITS))
        self.what = what

    def name(self, values: list[Any], where: Where) -> Any:
        if values[0] in self.names:
            return self.names[values[0]]
        raise self._refused(f"{self.what} can't contain {values[0]}", where)

    def power(self, values: list[Any], where: Where) -> Any:
        base, exponent = values
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            hint = "exponents are integers; write sqrt(...) for a square root, exp(...) for a power of e"
            raise self._refused(f"{exponent} isn't an integer", where, hint) from None

    def call(self, values: list[Any], where: Where) -> Any:
        head, arguments = values
        if head not in FUNCTIONS or len(arguments) != 1 or isinstance(arguments[0], list):
            hint = f"the functions are {', '.join(sorted(FUNCTIONS))}, of one argument"
            raise self._refused(f"{self.what} can't contain {where().piece_of_all()}", where, hint)
        value = FUNCTIONS[head](arguments[0])
        if value.has(sp.zoo, sp.nan, sp.oo):
            raise self._refused(f"{where().piece_of_all()} isn't finite", where)
        return value

    def primed(self, values: list[Any], where: Where) -> Any:
        raise self._refused(f"{self.what} can't contain the derivative {values[0]}", where)

    def equation(self, values: list[Any], where: Where) -> Any:
        raise self._refused(f"{self.what} is an expression, not an equation", where)

    def _decimal(self, text: str) -> Any:
        scale = text.lower().partition("e")[2]
        if scale and abs(self.arithmetic.signed_integer(scale)) > LIMITS.digits:
            raise LimitExceeded(f"over {LIMITS.digits} digits, the limit", limit="digits")
        return self.arithmetic.constant(Fraction(text))

    def _refused(self, message: str, where: Where, hint: str | None = None) -> InputError:
        site = where()
        position, length = site.span()
        return InputError(message, text=site.tokens.text, position=position, length=length, hint=hint)

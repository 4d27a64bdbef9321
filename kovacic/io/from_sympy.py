"""SymPy expressions into a rational function.

The expression is walked as it stands, by an explicit stack, and every node becomes exact arithmetic on polynomials.
SymPy simplifies nothing on the way: its `cancel` and `together` cost more than the whole decision.  This module imports
SymPy only when it is called, that is when the caller has done so.
"""

from __future__ import annotations

from fractions import Fraction
from operator import index
from typing import Any

from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.io.arithmetic import VARIABLE, Arithmetic, NotAnInteger, Value
from kovacic.io.parsed import DEFAULT_VARIABLE, Parsed
from kovacic.limits import DEFAULT_LIMITS, Limits


def parse_sympy(expression: Any, *, variable: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """The rational function over Q that a SymPy expression denotes.

    The variable is the only symbol in the expression, else x; or the one with the given name.  Floats are taken
    exactly, with a notice.  Raises `NotRational` for whatever isn't a rational function of that variable, and `LimitExceeded`.
    """
    import sympy

    if isinstance(expression, sympy.Poly):
        expression = expression.as_expr()
    if not isinstance(expression, sympy.Expr):
        raise InputError(
            f"{type(expression).__name__!r} isn't a SymPy expression", hint="give S alone, from y'' = S(x) y"
        )
    symbols = sorted(expression.free_symbols, key=str)
    names = [str(symbol) for symbol in symbols]
    if len(set(names)) < len(names):
        raise InputError(
            f"different symbols have the same name: {', '.join(names)}", hint="use one symbol x throughout"
        )
    if variable is None:
        variable = names[0] if len(names) == 1 else DEFAULT_VARIABLE
    walker = _Walker(variable, Arithmetic(limits))
    value = walker.value(expression)
    return Parsed(walker.arithmetic.rational(value), variable, tuple(walker.notices))


class _Walker:
    """The post-order walk over one expression."""

    def __init__(self, variable: str, arithmetic: Arithmetic) -> None:
        self.variable = variable
        self.arithmetic = arithmetic
        self.notices: list[str] = []

    def value(self, expression: Any) -> Value:
        """The value of an expression; children are on the stack `values` before their parent is combined."""
        values: list[Value] = []
        pending: list[tuple[Any, bool]] = [(expression, False)]
        while pending:
            node, ready = pending.pop()
            if ready:
                count = len(node.args)
                arguments = values[-count:]
                del values[-count:]
                values.append(self._combined(node, arguments))
            elif node.is_Add or node.is_Mul or node.is_Pow:
                pending.append((node, True))
                pending.extend((child, False) for child in reversed(node.args))
            else:
                values.append(self._leaf(node))
        return values[0]

    def _combined(self, node: Any, arguments: list[Value]) -> Value:
        arithmetic = self.arithmetic
        try:
            if node.is_Pow:
                return arithmetic.power(arguments[0], arguments[1])
            combine = arithmetic.add if node.is_Add else arithmetic.multiply
            result = arguments[0]
            for argument in arguments[1:]:
                result = combine(result, argument)
        except NotAnInteger:
            raise self._refused(node, "exponents are integers") from None
        except ZeroDivisionError:
            raise NotRational(f"division by zero in {_shown(node)}") from None
        except LimitExceeded as error:
            raise LimitExceeded(f"{_shown(node)} would have {error}", limit=error.limit) from None
        return result

    def _leaf(self, node: Any) -> Value:
        if node.is_Symbol:
            if node.name == self.variable:
                return VARIABLE
            raise NotRational(
                f"the symbol {node.name} beside the variable {self.variable}: parameters aren't supported yet",
                hint="substitute numbers for parameters; if another symbol is the variable, name it (var=)",
            )
        if node.is_Rational:
            return self.arithmetic.constant(Fraction(index(node.p), index(node.q)))
        if node.is_Float and node.is_finite:
            exact = exact_float(node)
            self.notices.append(f"the float {_shown(node)} was taken exactly, as {_shown(exact)}")
            return self.arithmetic.constant(exact)
        raise self._refused(node, None)

    def _refused(self, node: Any, hint: str | None) -> NotRational:
        if node.is_number:
            return NotRational(
                f"{_shown(node)} isn't a rational number; constants outside the rational numbers aren't supported yet"
            )
        return NotRational(f"{_shown(node)} isn't a rational function of {self.variable}", hint=hint)


def exact_float(number: Any) -> Fraction:
    """The binary fraction that a SymPy Float is."""
    sign, mantissa, exponent, _ = number._mpf_
    signed = -int(mantissa) if sign else int(mantissa)
    return Fraction(signed) * Fraction(2) ** int(exponent)


def _shown(node: Any, width: int = 60) -> str:
    text = str(node)
    return text if len(text) <= width else f"{text[: width // 2]}...{text[-width // 4 :]}"

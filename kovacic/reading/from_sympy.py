"""SymPy expressions into exact arithmetic, node by node: what `parser` is for texts, with the same readers.

The expression is walked as it stands, by an explicit stack.  SymPy simplifies nothing on the way: its `cancel` and `together`
cost more than the whole decision.  SymPy is imported only when these functions are called, that is when the caller has done so.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from operator import index
from typing import Any

from kovacic.errors import InputError, LimitExceeded, NotLinear, NotRational
from kovacic.reading.arithmetic import VARIABLE
from kovacic.reading.expression import RationalReader
from kovacic.reading.parser import shown


class _Node:
    """The place of an operation, for messages."""

    def __init__(self, node: Any) -> None:
        self.node = node

    def text(self) -> str:
        return shown(self.node, 60)


def walked(expression: Any, reader: RationalReader) -> Any:
    """The value of a SymPy expression; children are on the stack `values` before their parent is combined."""
    arithmetic = reader.arithmetic
    values: list[Any] = []
    pending: list[tuple[Any, bool]] = [(expression, False)]
    while pending:
        node, ready = pending.pop()
        if not ready and (node.is_Add or node.is_Mul or node.is_Pow):
            pending.append((node, True))
            pending.extend((child, False) for child in reversed(node.args))
        elif not ready:
            values.append(_leaf(node, reader))
        else:
            arguments = values[-len(node.args) :]
            del values[1 - len(node.args) :]
            try:
                if node.is_Pow:
                    values[-1] = reader.power(arguments[0], arguments[1], _Node(node))
                else:
                    values[-1] = arithmetic.sum(arguments) if node.is_Add else reduce(arithmetic.multiply, arguments)
            except ZeroDivisionError:
                raise NotRational(f"division by zero in {shown(node, 60)}") from None
            except LimitExceeded as error:
                raise LimitExceeded(f"{shown(node, 60)} would have {error}", limit=error.limit) from None
    return values[0]


def _leaf(node: Any, reader: RationalReader) -> Any:
    if node.is_Symbol:
        return VARIABLE if node.name == reader.variable else reader.constants.parameter(node.name)  # type: ignore[union-attr]
    if node.is_Rational:
        return reader.arithmetic.constant(Fraction(index(node.p), index(node.q)))
    if node.is_Float and node.is_finite:
        sign, mantissa, exponent, _ = node._mpf_
        exact = Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** int(exponent)
        reader.decimals.append(f"the float {shown(node, 60)} was taken exactly, as {shown(exact, 60)}")
        return reader.arithmetic.constant(exact)
    value = reader.constants.algebraic(node) if node.is_number and node.is_algebraic else None  # type: ignore[union-attr]
    return reader.other_leaf(node) if value is None else value


def names_of(expression: Any) -> list[str]:
    """The names of the symbols, in alphabetical order.  Refuses what would be lost in them."""
    names = sorted(symbol.name for symbol in expression.free_symbols)
    if len(set(names)) < len(names):
        raise InputError(
            f"different symbols have the same name: {', '.join(names)}", hint="use one symbol x throughout"
        )
    if expression.is_commutative is False:
        raise InputError("a product of symbols that don't commute", hint="use commutative symbols")
    return names


def functions_in(value: Any) -> set[Any]:
    """The applied undefined functions, such as y(x)."""
    from sympy.core.function import AppliedUndef

    return value.atoms(AppliedUndef) if hasattr(value, "atoms") else set()


def is_sympy_equation(value: Any) -> bool:
    """Is it an `Eq` with an undefined function, or an expression with a derivative of one?"""
    from sympy import Derivative

    return bool(functions_in(value)) and (bool(getattr(value, "is_Equality", False)) or value.has(Derivative))


def function_of(expression: Any) -> Any:
    """The unknown function, the only one in the expression or the one that is differentiated."""
    from sympy import Derivative

    candidates = functions = functions_in(expression)
    if len(functions) > 1:
        derived = {d.expr for d in expression.atoms(Derivative)} & functions
        candidates = derived if len(derived) == 1 else functions
    if len(candidates) != 1:
        found = ", ".join(sorted(map(str, functions))) or "none"
        raise NotLinear(f"one unknown function is expected, and there are: {found}", hint="write y(x) for it")
    return candidates.pop()

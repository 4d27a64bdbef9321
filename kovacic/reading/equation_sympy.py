"""SymPy equations into an equation a y'' + b y' + c y = f.

Read are `Eq(lhs, rhs)` and expressions that are zero, in an applied function such as y(x) and its derivatives.
"""

from __future__ import annotations

from typing import Any

from kovacic.equation import Equation
from kovacic.errors import InputError, NotLinear, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import NotAnInteger, Term
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.equation_parser import as_equation
from kovacic.reading.from_sympy import Walker
from kovacic.reading.linear import LinearArithmetic, LinearForm


def is_sympy_equation(value: Any) -> bool:
    """Is it an `Eq` with an undefined function, or an expression with a derivative of one?"""
    from sympy import Derivative

    return bool(_functions(value)) and (bool(getattr(value, "is_Equality", False)) or value.has(Derivative))


def _functions(value: Any) -> set[Any]:
    from sympy.core.function import AppliedUndef

    return value.atoms(AppliedUndef) if hasattr(value, "atoms") else set()


def parse_sympy_equation(
    value: Any, *, variable: str | None = None, unknown: Any = None, limits: Limits = DEFAULT_LIMITS
) -> tuple[Equation, tuple[str, ...], Any]:
    """The equation, what the user should know about how it was read, and the function y(x) that occurs in it.

    `unknown` is that function, where more than one occurs.  Raises `NotLinear`, `NotRational` and `LimitExceeded`.
    """
    from sympy import Symbol

    expression = value.lhs - value.rhs if getattr(value, "is_Equality", False) else value
    function = _function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    symbol = function.args[0]
    if variable is not None and symbol.name != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    same_name = [s for s in expression.free_symbols if s.name == symbol.name]
    if same_name and same_name != [symbol]:
        raise InputError(f"different symbols have the same name: {symbol.name}", hint="use one symbol x throughout")
    plain = expression.xreplace({symbol: Symbol(symbol.name)}) if symbol != Symbol(symbol.name) else expression
    plain_function = function.xreplace({symbol: Symbol(symbol.name)})

    def read(constants: Constants) -> tuple[Equation, tuple[str, ...]]:
        arithmetic = LinearArithmetic(limits, symbol.name, str(function.func))
        walker = _EquationWalker(symbol.name, plain_function, arithmetic, constants)
        equation = as_equation(arithmetic, walker.value(plain), constants, None)
        return equation, (*walker.notices, *constants.notices())

    equation, notices = read_with_constants(read, limits)
    return equation, notices, function


def _function_of(expression: Any) -> Any:
    from sympy import Derivative

    functions = _functions(expression)
    derived = {d.expr for d in expression.atoms(Derivative)} & functions
    candidates = derived if len(derived) == 1 else functions
    if len(candidates) != 1:
        found = ", ".join(sorted(map(str, functions))) or "none"
        raise NotLinear(f"one unknown function is expected, and there are: {found}", hint="write y(x) for it")
    return candidates.pop()


class _EquationWalker(Walker):
    """The walk over an equation; the unknown function and its derivatives are leaves."""

    arithmetic: LinearArithmetic

    def __init__(self, variable: str, function: Any, arithmetic: LinearArithmetic, constants: Constants) -> None:
        super().__init__(variable, arithmetic, constants)
        self.function = function

    def _power(self, node: Any, base: Any, exponent: Any) -> Any:
        if isinstance(base, LinearForm) or isinstance(exponent, LinearForm):
            try:
                return self.arithmetic.power(base, exponent)
            except NotAnInteger:
                return self.arithmetic.opaque(self._free(node))
        try:
            return super()._power(node, base, exponent)
        except NotRational:
            return self.arithmetic.opaque(self._free(node))

    def _leaf(self, node: Any) -> Any:
        if node == self.function:
            return LinearForm({0: Term(1, 0)})
        if node.is_Derivative:
            value = self.value(node.expr)
            for symbol, count in node.variable_count:
                if symbol.name != self.variable or not getattr(count, "is_Integer", False):
                    raise NotLinear(f"{node} isn't a derivative with respect to {self.variable}")
                for _ in range(int(count)):
                    value = self.arithmetic.derivative(value)
            return self.arithmetic.constant(0) if value is None else value
        try:
            return super()._leaf(node)
        except NotRational:
            return self.arithmetic.opaque(self._free(node))

    def _free(self, node: Any) -> Any:
        if _functions(node):
            raise NotLinear(f"{self.function} within {node}: the equation isn't linear")
        return node

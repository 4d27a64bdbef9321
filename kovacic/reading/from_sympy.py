"""SymPy expressions into a rational function, and SymPy equations into an equation a y'' + b y' + c y = f.

The expression is walked as it stands, by an explicit stack, and every node becomes exact arithmetic on polynomials.
SymPy simplifies nothing on the way: its `cancel` and `together` cost more than the whole decision.  This module imports
SymPy only when it is called, that is when the caller has done so.
"""

from __future__ import annotations

from typing import Any

from kovacic.errors import InputError, NotLinear, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, Term
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.equation import EquationReader
from kovacic.reading.expression import RationalReader, chosen_variable
from kovacic.reading.given import EULER, PI, Equation, Parsed
from kovacic.reading.linear import LinearArithmetic, LinearForm
from kovacic.reading.walker import Walker


def parse_sympy(expression: Any, *, variable: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """The rational function that a SymPy expression denotes.

    The variable is the only symbol in the expression, else x; or the one with the given name; other symbols are parameters.
    Constants may be algebraic numbers: I, radicals, `CRootOf`, `AlgebraicNumber`, cosines of rational angles.  Floats are taken
    exactly, with a notice.  Raises `NotRational` for whatever isn't a rational function of that variable, and `LimitExceeded`.
    """
    import sympy

    if isinstance(expression, sympy.Poly):
        expression = expression.as_expr()
    if not isinstance(expression, sympy.Expr):
        raise InputError(
            f"{type(expression).__name__!r} isn't a SymPy expression", hint="give S alone, from y'' = S(x) y"
        )
    names = _names_of(expression)
    chosen = variable or chosen_variable(names)

    def read(constants: Constants) -> Parsed:
        reader = RationalReader({chosen: VARIABLE}, chosen, Arithmetic(limits), constants)
        walker = Walker(reader, constants)
        S = constants.embedded(reader.arithmetic.rational(walker.value(expression)))
        return Parsed(S, chosen, (*walker.notices, *constants.notices()))

    return read_with_constants(read, limits)


def is_sympy_equation(value: Any) -> bool:
    """Is it an `Eq` with an undefined function, or an expression with a derivative of one?"""
    from sympy import Derivative

    return bool(_functions(value)) and (bool(getattr(value, "is_Equality", False)) or value.has(Derivative))


def parse_sympy_equation(
    value: Any, *, variable: str | None = None, unknown: Any = None, limits: Limits = DEFAULT_LIMITS
) -> tuple[Equation, tuple[str, ...], Any]:
    """The equation, what the user should know about how it was read, and the function y(x) that occurs in it.

    Read are `Eq(lhs, rhs)` and expressions that are zero, in an applied function such as y(x) and its derivatives; `unknown`
    is that function, where more than one occurs.  Raises `NotLinear`, `NotRational` and `LimitExceeded`.
    """
    from sympy import E, Symbol, pi

    expression = value.lhs - value.rhs if getattr(value, "is_Equality", False) else value
    function = function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    name = function.args[0].name
    if variable is not None and name != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    names = _names_of(expression)
    for letter, number in ((PI, pi), (EULER, E)):
        if letter in names and expression.has(number):
            raise InputError(f"{letter} is a symbol and a number in one equation", hint="rename the symbol")
    plain = {symbol: Symbol(symbol.name) for symbol in expression.free_symbols | function.free_symbols}
    own_expression, own_function = expression.xreplace(plain), function.xreplace(plain)

    def read(constants: Constants) -> tuple[Equation, tuple[str, ...]]:
        unknown = str(function.func)
        reader = EquationReader(name, unknown, LinearArithmetic(limits, name, unknown), constants)
        walker = _EquationWalker(reader, constants, own_function)
        equation = reader.equation_of(walker.value(own_expression), None)
        return equation, (*walker.notices, *constants.notices())

    return *read_with_constants(read, limits), function


def _names_of(expression: Any) -> list[str]:
    """The names of the symbols, in alphabetical order.  Refuses what would be lost in them."""
    symbols = sorted(expression.free_symbols, key=str)
    names = [symbol.name for symbol in symbols]
    if len(set(names)) < len(names):
        raise InputError(
            f"different symbols have the same name: {', '.join(names)}", hint="use one symbol x throughout"
        )
    if expression.is_commutative is False:
        raise InputError("a product of symbols that don't commute", hint="use commutative symbols")
    return names


def _functions(value: Any) -> set[Any]:
    from sympy.core.function import AppliedUndef

    return value.atoms(AppliedUndef) if hasattr(value, "atoms") else set()


def function_of(expression: Any) -> Any:
    """The unknown function, the only one in the expression or the one that is differentiated."""
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

    reader: EquationReader

    def __init__(self, reader: EquationReader, constants: Constants, function: Any) -> None:
        super().__init__(reader, constants)
        self.function = function

    def _leaf(self, node: Any) -> Any:
        arithmetic = self.reader.arithmetic
        if node == self.function:
            return LinearForm({0: Term(1, 0)})
        if node.is_Derivative:
            value = self.value(node.expr)
            for symbol, count in node.variable_count:
                if symbol.name != self.reader.variable or not getattr(count, "is_Integer", False):
                    raise NotLinear(f"{node} isn't a derivative with respect to {self.reader.variable}")
                for _ in range(int(count)):
                    value = arithmetic.derivative(value)
            return value
        try:
            return super()._leaf(node)
        except NotRational:
            if _functions(node):
                raise NotLinear(f"{self.function} within {node}: the equation isn't linear") from None
            return arithmetic.opaque(node)

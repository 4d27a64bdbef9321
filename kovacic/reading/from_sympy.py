"""SymPy expressions into a rational function, and SymPy equations into an equation a y'' + b y' + c y = f.

The expression is walked as it stands, by an explicit stack, and every node becomes exact arithmetic on polynomials.
SymPy simplifies nothing on the way: its `cancel` and `together` cost more than the whole decision.  This module imports
SymPy only when it is called, that is when the caller has done so.
"""

from __future__ import annotations

from fractions import Fraction
from operator import index
from typing import Any

from flint import acb, arb

from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, LimitExceeded, NotLinear, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, Term
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.equation import EquationReader
from kovacic.reading.expression import RationalReader, chosen_variable
from kovacic.reading.given import TRANSCENDENTAL_HINT, Equation, Parsed
from kovacic.reading.linear import LinearArithmetic, LinearForm
from kovacic.reading.parser import shown

#: Digits of the approximation that tells an algebraic number from its conjugates.
_DIGITS = 15


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
        walker = _Walker(reader, constants)
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
    from sympy import Symbol

    expression = value.lhs - value.rhs if getattr(value, "is_Equality", False) else value
    function = _function_of(expression) if unknown is None else unknown
    if len(function.args) != 1 or not function.args[0].is_Symbol:
        raise NotLinear(f"{function} isn't a function of one variable")
    name = function.args[0].name
    if variable is not None and name != variable:
        raise InputError(f"{function} isn't a function of {variable}")
    _names_of(expression)
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


def _function_of(expression: Any) -> Any:
    from sympy import Derivative

    functions = _functions(expression)
    derived = {d.expr for d in expression.atoms(Derivative)} & functions
    candidates = derived if len(derived) == 1 else functions
    if len(candidates) != 1:
        found = ", ".join(sorted(map(str, functions))) or "none"
        raise NotLinear(f"one unknown function is expected, and there are: {found}", hint="write y(x) for it")
    return candidates.pop()


class _Walker:
    """The post-order walk over one expression; what powers mean is the reader's affair, as in a text."""

    def __init__(self, reader: RationalReader, constants: Constants) -> None:
        self.reader = reader
        self.constants = constants
        self.notices: list[str] = []
        self.node: Any = None

    def text(self) -> str:
        """The operation that is being carried out."""
        return shown(self.node, 60)

    def value(self, expression: Any) -> Any:
        """The value of an expression; children are on the stack `values` before their parent is combined."""
        values: list[Any] = []
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

    def _combined(self, node: Any, arguments: list[Any]) -> Any:
        arithmetic, self.node = self.reader.arithmetic, node
        try:
            if node.is_Pow:
                return self.reader.power(arguments[0], arguments[1], self)
            combine = arithmetic.add if node.is_Add else arithmetic.multiply
            result = arguments[0]
            for argument in arguments[1:]:
                result = combine(result, argument)
        except ZeroDivisionError:
            raise NotRational(f"division by zero in {shown(node, 60)}") from None
        except LimitExceeded as error:
            raise LimitExceeded(f"{shown(node, 60)} would have {error}", limit=error.limit) from None
        return result

    def _leaf(self, node: Any) -> Any:
        reader = self.reader
        if node.is_Symbol:
            return VARIABLE if node.name == reader.variable else self.constants.parameter(node.name)
        if node.is_Rational:
            return reader.arithmetic.constant(Fraction(index(node.p), index(node.q)))
        if node.is_Float and node.is_finite:
            exact = exact_float(node)
            self.notices.append(f"the float {shown(node, 60)} was taken exactly, as {shown(exact, 60)}")
            return reader.arithmetic.constant(exact)
        if node.is_number and node.is_algebraic:
            return self._algebraic(node)
        raise self._refused(node)

    def _algebraic(self, node: Any) -> Any:
        """An algebraic number of any other form, through its minimal polynomial."""
        import sympy

        if node is sympy.I:
            return self.constants.imaginary_unit()
        exact = node.as_expr() if isinstance(node, sympy.AlgebraicNumber) else node
        try:
            is_root = isinstance(exact, sympy.CRootOf)
            minimal = exact.poly if is_root else sympy.minimal_polynomial(exact, sympy.Dummy(), polys=True)
        except NotImplementedError:
            raise self._refused(node) from None
        coefficients = [Fraction(index(c.p), index(c.q)) for c in reversed(minimal.all_coeffs())]
        real, imaginary = sympy.N(exact, _DIGITS).as_real_imag()
        approximation = acb(arb(str(real)), arb(str(imaginary)))
        return self.constants.root(QQ.poly(coefficients), approximation)

    def _refused(self, node: Any) -> NotRational:
        if node.is_number:
            message = f"{shown(node, 60)} isn't a rational number, nor known to be an algebraic one"
            return NotRational(message, hint=TRANSCENDENTAL_HINT)
        return NotRational(f"{shown(node, 60)} isn't a rational function of {self.reader.variable}")


class _EquationWalker(_Walker):
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


def exact_float(number: Any) -> Fraction:
    """The binary fraction that a SymPy Float is."""
    sign, mantissa, exponent, _ = number._mpf_
    signed = -int(mantissa) if sign else int(mantissa)
    return Fraction(signed) * Fraction(2) ** int(exponent)

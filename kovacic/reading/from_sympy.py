"""SymPy expressions into a rational function.

The expression is walked as it stands, by an explicit stack, and every node becomes exact arithmetic on polynomials.
SymPy simplifies nothing on the way: its `cancel` and `together` cost more than the whole decision.  This module imports
SymPy only when it is called, that is when the caller has done so.
"""

from __future__ import annotations

from fractions import Fraction
from operator import index
from typing import Any

from flint import acb, arb

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, NotAnInteger, Value
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.parsed import DEFAULT_VARIABLE, TRANSCENDENTAL_HINT, Parsed

#: Digits of the approximation that tells an algebraic number from its conjugates.
_DIGITS = 15
LARGEST_INDEX = 100


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
    symbols = sorted(expression.free_symbols, key=str)
    names = [str(symbol) for symbol in symbols]
    if len(set(names)) < len(names):
        raise InputError(
            f"different symbols have the same name: {', '.join(names)}", hint="use one symbol x throughout"
        )
    if variable is None:
        if len(names) > 1 and DEFAULT_VARIABLE not in names:
            raise InputError(
                f"which of {', '.join(names[:6])} is the variable?",
                hint=f"name it: var={names[0]!r}; the others are parameters",
            )
        variable = names[0] if len(names) == 1 else DEFAULT_VARIABLE
    chosen = variable

    def read(constants: Constants) -> Parsed:
        walker = Walker(chosen, Arithmetic(limits), constants)
        S = constants.embedded(walker.arithmetic.rational(walker.value(expression)))
        return Parsed(S, chosen, (*walker.notices, *constants.notices()))

    return read_with_constants(read, limits)


class Walker:
    """The post-order walk over one expression."""

    def __init__(self, variable: str, arithmetic: Arithmetic, constants: Constants) -> None:
        self.variable = variable
        self.arithmetic = arithmetic
        self.constants = constants
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
                return self._power(node, arguments[0], arguments[1])
            combine = arithmetic.add if node.is_Add else arithmetic.multiply
            result = arguments[0]
            for argument in arguments[1:]:
                result = combine(result, argument)
        except ZeroDivisionError:
            raise NotRational(f"division by zero in {_shown(node)}") from None
        except LimitExceeded as error:
            raise LimitExceeded(f"{_shown(node)} would have {error}", limit=error.limit) from None
        return result

    def _power(self, node: Any, base: Value, exponent: Value) -> Value:
        arithmetic = self.arithmetic
        try:
            return arithmetic.power(base, exponent)
        except NotAnInteger:
            pass
        closed, power = arithmetic.closed(base), arithmetic.closed(exponent)
        if isinstance(closed, Poly) and closed.is_constant and isinstance(power, Poly) and power.is_constant:
            number = power.field.rational_value(power)
            if number is not None and number.denominator <= LARGEST_INDEX:
                root = self.constants.radical(closed, number.denominator, _label(node.base, number.denominator))
                if root is not None:
                    return arithmetic.power(root, number.numerator)
        raise self._refused(node, "exponents are integers, and roots those of numbers")

    def _leaf(self, node: Any) -> Value:
        if node.is_Symbol:
            return VARIABLE if node.name == self.variable else self.constants.parameter(node.name)
        if node.is_Rational:
            return self.arithmetic.constant(Fraction(index(node.p), index(node.q)))
        if node.is_Float and node.is_finite:
            exact = exact_float(node)
            self.notices.append(f"the float {_shown(node)} was taken exactly, as {_shown(exact)}")
            return self.arithmetic.constant(exact)
        if node.is_number and node.is_algebraic:
            return self._algebraic(node)
        raise self._refused(node, None)

    def _algebraic(self, node: Any) -> Value:
        """An algebraic number of any other form, through its minimal polynomial."""
        import sympy

        if node is sympy.I:
            root = self.constants.radical(QQ.poly([-1]), 2, "I")
            assert root is not None
            return root
        exact = node.as_expr() if isinstance(node, sympy.AlgebraicNumber) else node
        try:
            is_root = isinstance(exact, sympy.CRootOf)
            minimal = exact.poly if is_root else sympy.minimal_polynomial(exact, sympy.Dummy(), polys=True)
        except NotImplementedError:
            raise self._refused(node, None) from None
        coefficients = [Fraction(index(c.p), index(c.q)) for c in reversed(minimal.all_coeffs())]
        real, imaginary = sympy.N(exact, _DIGITS).as_real_imag()
        approximation = acb(arb(str(real)), arb(str(imaginary)))
        return self.constants.root(QQ.poly(coefficients), approximation, "")

    def _refused(self, node: Any, hint: str | None) -> NotRational:
        if node.is_number:
            message = f"{_shown(node)} isn't a rational number, nor known to be an algebraic one"
            return NotRational(message, hint=hint or TRANSCENDENTAL_HINT)
        return NotRational(f"{_shown(node)} isn't a rational function of {self.variable}", hint=hint)


def _label(base: Any, n: int) -> str:
    """The n-th root of a number as `reading.parser` reads it."""
    return f"{'sqrt' if n == 2 else 'cbrt'}({base})" if n < 4 else f"root({base}, {n})"


def exact_float(number: Any) -> Fraction:
    """The binary fraction that a SymPy Float is."""
    sign, mantissa, exponent, _ = number._mpf_
    signed = -int(mantissa) if sign else int(mantissa)
    return Fraction(signed) * Fraction(2) ** int(exponent)


def _shown(node: Any, width: int = 60) -> str:
    text = str(node)
    return text if len(text) <= width else f"{text[: width // 2]}...{text[-width // 4 :]}"

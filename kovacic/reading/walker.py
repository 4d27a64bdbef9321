"""The walk over one SymPy expression, node by node, into exact arithmetic; used for equations in SymPy and parts of texts."""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from operator import index
from typing import Any

from flint import acb, arb

from kovacic.algebra.rationals import QQ
from kovacic.errors import LimitExceeded, NotRational
from kovacic.reading.arithmetic import VARIABLE
from kovacic.reading.constants import Constants
from kovacic.reading.expression import RationalReader
from kovacic.reading.given import TRANSCENDENTAL_HINT
from kovacic.reading.parser import shown

#: Digits of the approximation that tells an algebraic number from its conjugates.
_DIGITS = 15


class Walker:
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
            return arithmetic.sum(arguments) if node.is_Add else reduce(arithmetic.multiply, arguments)
        except ZeroDivisionError:
            raise NotRational(f"division by zero in {shown(node, 60)}") from None
        except LimitExceeded as error:
            raise LimitExceeded(f"{shown(node, 60)} would have {error}", limit=error.limit) from None

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


def exact_float(number: Any) -> Fraction:
    """The binary fraction that a SymPy Float is."""
    sign, mantissa, exponent, _ = number._mpf_
    signed = -int(mantissa) if sign else int(mantissa)
    return Fraction(signed) * Fraction(2) ** int(exponent)

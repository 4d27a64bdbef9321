"""Text into SymPy expressions, as SymPy's own operators build them; nothing is ever executed.

>>> read_expression("3/2*cos(u) + sin(u)^2/4", names={"u": sympy.Symbol("u")})
sin(u)**2/4 + 3*cos(u)/2
>>> read_expression("sqrt(8) + n*e^2")
n*exp(2) + 2*sqrt(2)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from typing import Any

import sympy

from kovacic.algebra.embedding import real_root_index
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import DEFAULT_LIMITS, Limits, check_duration
from kovacic.reading.arithmetic import Arithmetic
from kovacic.reading.given import FUNCTION_NAMES, NUMBER_NAMES, parameters_of
from kovacic.reading.lexer import tokenize
from kovacic.reading.parser import Site, evaluate

#: SymPy's functions are recursive, and its integers aren't bounded.
_LARGEST_BITS = 14_000  # Python prints integers of at most 4300 digits
LIMITS = Limits(text_length=10_000, digits=1000, exponent=1000, bits=10_000)

FUNCTIONS = {name: getattr(sympy, own) for name, own in FUNCTION_NAMES.items()}
FUNCTIONS |= {"sech": lambda z: 1 / sympy.cosh(z), "csch": lambda z: 1 / sympy.sinh(z)}
CONSTANTS = {"pi": sympy.pi, "π": sympy.pi, "e": sympy.E, "I": sympy.I}


def read_expression(
    text: str, *, names: Mapping[str, Any] | None = None, what: str = "the expression", limits: Limits = LIMITS
) -> Any:
    """The SymPy expression that a text denotes in `names`, pi, e, I and the elementary functions; decimals are exact.

    Without `names`, every other name is a symbol.  Raises `InputError`, with the position, for anything else (`what` says
    in the message what the text stands for), and `LimitExceeded` for a text, a number or a power that is too large.
    """
    if len(text) > limits.text_length:
        raise LimitExceeded(
            f"{what} has {len(text)} characters, above the limit of {limits.text_length}", limit="text_length"
        )
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise InputError(f"{what} is empty", text=text, position=0)
    return evaluate(tokens, SymbolicReader(names, what, limits))


def expression_of(function: RatFunc, variable: str) -> Any:
    """A rational function as a SymPy expression.  Raises `LimitExceeded` for numbers that Python couldn't print."""
    bits = max(function.num.height_bits(), function.den.height_bits())
    if bits > _LARGEST_BITS:
        raise LimitExceeded(f"coefficients of {bits} bits, above the limit of {_LARGEST_BITS}", limit="bits")
    field = function.field
    names = {name: sympy.Symbol(name) for name in (*parameters_of(field), variable)}
    if isinstance(field, AlgebraicField) and field.name.isidentifier() and field.name not in CONSTANTS:
        # Any other name is that of a radical.
        names[field.name] = chosen_root(sympy.Poly(field.modulus.to_sympy(sympy.Symbol("t"))), field)
    return read_expression(function.to_str(variable), names=names, limits=DEFAULT_LIMITS)


def chosen_root(polynomial: Any, field: AlgebraicField) -> Any:
    """The root of the modulus, as SymPy's polynomial, that the field means, or SymPy's first one."""
    if field.approximation is None or field.ground != field.base:
        return sympy.CRootOf(polynomial, 0)
    values = [field.base.rational_value(c) for c in field.modulus]
    index = real_root_index(QQ.poly([v for v in values if v is not None]), field.approximation)
    if index is not None:
        return sympy.CRootOf(polynomial, index)
    real, imaginary = (float(part) for part in field.approximation)
    check_duration(1.5**field.dimension / 20, f"isolating the roots of a polynomial of degree {field.dimension}")
    roots = [sympy.CRootOf(polynomial, k) for k in range(field.dimension)]
    return min(roots, key=lambda root: abs(complex(root.evalf(15)) - complex(real, imaginary)))


class SymbolicArithmetic(Arithmetic):
    """The arithmetic of SymPy expressions, with the sizes of numbers checked before powers and after products."""

    def __init__(self, limits: Limits) -> None:
        super().__init__(replace(limits, bits=min(limits.bits, _LARGEST_BITS)))

    def constant(self, value: int | Fraction) -> Any:
        return self._checked(sympy.Rational(value))

    def decimal(self, text: str) -> Any:
        value = super().number(super().decimal(text))
        return self.constant(value or 0)

    def negate(self, value: Any) -> Any:
        return -value

    def sum(self, terms: Sequence[Any]) -> Any:
        return reduce(lambda total, term: self._checked(total + term), terms)

    def multiply(self, left: Any, right: Any) -> Any:
        return self._checked(left * right)

    def divide(self, left: Any, right: Any) -> Any:
        if right.is_zero:
            raise ZeroDivisionError("division by zero")
        return self._checked(left / right)

    def power(self, base: Any, exponent: Any) -> Any:
        self.check_exponent(exponent)
        if base.is_zero and exponent.is_nonpositive:
            raise ZeroDivisionError("0 has no powers with exponent zero or below")
        if exponent.is_Rational:
            self._check(0, abs(int(exponent.p)) * _bits(base.as_coeff_Mul()[0]))
        return base**exponent

    def check_exponent(self, exponent: Any) -> None:
        """Refuses numbers as exponents, and as factors of logarithms in exponents, that are too large."""
        numbers = exponent.atoms(sympy.Rational) if exponent.is_Rational or exponent.has(sympy.log) else ()
        if any(abs(number) > self.limits.exponent for number in numbers):
            raise LimitExceeded(f"an exponent above the limit of {self.limits.exponent}", limit="exponent")

    def applied(self, head: str, argument: Any) -> Any:
        """One of `FUNCTIONS` of an argument.  Raises `InputError` where it isn't finite."""
        if head == "exp":
            self.check_exponent(argument)
        value = FUNCTIONS[head](argument)
        if value.has(sympy.zoo, sympy.nan, sympy.oo):
            raise InputError(f"{head}({argument}) isn't finite")
        return value

    def _checked(self, value: Any) -> Any:
        if value.is_Rational:
            self._check(0, _bits(value))
        return value


def _bits(value: Any) -> int:
    return max(int(value.p).bit_length(), int(value.q).bit_length()) if value.is_Rational else 1


class SymbolicReader:
    """What a text means as a SymPy expression."""

    def __init__(self, names: Mapping[str, Any] | None, what: str, limits: Limits) -> None:
        self.names = names
        self.what = what
        self.arithmetic = SymbolicArithmetic(limits)

    def number(self, text: str) -> Any:
        arithmetic = self.arithmetic
        return arithmetic.constant(arithmetic.integer(text)) if text.isdigit() else arithmetic.decimal(text)

    def name(self, name: str) -> Any:
        if self.names is not None and name in self.names:
            return self.names[name]
        if name in CONSTANTS:
            return CONSTANTS[name]
        if self.names is not None or name in NUMBER_NAMES:
            raise InputError(f"{self.what} can't contain {name}")
        return sympy.Symbol(name)

    def derivative(self, text: str) -> Any:
        raise InputError(f"{self.what} can't contain the derivative {text}")

    def equation(self, left: Any, right: Any) -> Any:
        raise InputError(f"{self.what} is an expression, not an equation")

    def follows_without_sign(self, name: str) -> bool:
        return False

    def power(self, base: Any, exponent: Any, site: Site) -> Any:
        return self.arithmetic.power(base, exponent)

    def call(self, head: str, arguments: list[Any], site: Site) -> Any:
        if head == "root" and len(arguments) == 2:
            return self.arithmetic.power(arguments[0], self.arithmetic.divide(sympy.Integer(1), arguments[1]))
        if head not in FUNCTIONS or len(arguments) != 1 or isinstance(arguments[0], tuple):
            hint = f"the functions are {', '.join(sorted(FUNCTIONS))}, of one argument"
            raise InputError(f"{self.what} can't contain {site.text()}", hint=hint)
        return self.arithmetic.applied(head, arguments[0])

"""Reader of texts and SymPy expressions that denote rational functions.

The rational function grows while the text is read, and no part of it is ever executed.  `arithmetic` checks sizes before each
operation.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.equation import DEFAULT_VARIABLE, UNKNOWN
from kovacic.errors import InputError, NotRational
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, NotAnInteger, Value
from kovacic.reading.constants import Constants, Enlarged
from kovacic.reading.dialects import tokenize
from kovacic.reading.lexer import DERIVATIVES, PRIME
from kovacic.reading.names import (
    FUNCTION_NAMES,
    INSTEAD,
    NUMBER_NAMES,
    POWER_CALLS,
    STEP_LETTERS,
    TRANSCENDENTAL_HINT,
    is_function,
    is_letter,
    unglued,
)
from kovacic.reading.parser import Site, excerpt, parse

_SHOWN_DECIMALS = 3

#: The functions that stand for roots, with their index (root has it as its second argument).
ROOTS = {"sqrt": 2, "cbrt": 3, "root": 0}


def parse_with(text: str, names: Mapping[str, Value], arithmetic: Arithmetic) -> Value:
    """The value of an expression in these names, whatever field their values belong to.

    Raises `ParseError`, `NotRational` and `LimitExceeded`.
    """
    variable = next((name for name, value in names.items() if value is VARIABLE), DEFAULT_VARIABLE)
    try:
        return parse(tokenize(text), RationalReader(names, variable, arithmetic, Constants()))  # type: ignore[no-any-return]
    except Enlarged:
        raise NotRational(f"a constant in {excerpt(text)} that isn't one of {', '.join(names)}") from None


class RationalReader:
    """Reads texts and SymPy expressions that denote rational functions.

    `names` gives the values of the names that may occur: the variable, and whatever constants the caller's coefficient
    field has.  `constants` supplies algebraic numbers and parameters.  `arithmetic` has the operations on the values.  Each
    method raises `InputError` without a position, which the parser adds.  The `place` of an operation, in a text or in a SymPy
    expression, has a `text()`: what the user wrote.
    """

    def __init__(self, names: Mapping[str, Value], variable: str, arithmetic: Arithmetic, constants: Constants) -> None:
        self.names = names
        self.variable = variable
        self.arithmetic = arithmetic
        self.constants = constants
        self.decimals: list[str] = []
        #: The unknown functions, by their names.
        self.functions: Mapping[str, Any] = {}
        #: Names that are parameters, whatever they look like.
        self.declared: Collection[str] = ()

    def notices(self) -> list[str]:
        """Notes for the user on how the text was read."""
        more = len(self.decimals) - _SHOWN_DECIMALS
        rest = [f"{more} more decimals were taken exactly"] if more > 0 else []
        return self.decimals[:_SHOWN_DECIMALS] + rest

    def number(self, text: str) -> Value:
        value = self.arithmetic.decimal(text)
        if not text.isdigit():
            self.decimals.append(f"{excerpt(text)} was taken exactly, as {excerpt(str(value))}")
        return self.arithmetic.constant(value.p, value.q)

    def name(self, name: str) -> Value:
        value = self.names.get(name)
        if value is not None:
            return value
        if name in self.declared:
            return self.constants.parameter(name)
        if name == "I":
            return self.constants.radical(QQ.poly([-1]), 2, name)  # type: ignore[return-value]
        if is_function(name):
            said = f"{name} looks like a function without its parentheses"
            raise NotRational(said, hint=f"write {name}(...), a power of it {name}(...)^2")
        if name in NUMBER_NAMES:
            raise NotRational(
                f"{name} is {NUMBER_NAMES[name]}; constants are rational or algebraic numbers",
                hint=f"if {name} is the variable, say so: var={name!r}",
                shell=f"if {name} is the variable, say so: --var {name}",
            )
        if name == UNKNOWN:
            hint = f"y is the unknown function: give S alone, from y'' = S({self.variable}) y"
            raise NotRational(f"the symbol y in a function of {self.variable}", hint=hint)
        return self.constants.parameter(name)

    def refusal(self, why: str) -> InputError:
        return NotRational(f"S {why}", hint="give S alone, the factor of y on the right of y'' = S(x) y")

    def derivative(self, text: str) -> Value:
        raise self.refusal(f"can't contain the derivative {excerpt(text)}")

    def operator(self, variable: str) -> Value:
        raise self.refusal(f"can't contain the operator d/d{variable}")

    def equation(self, left: Value, right: Value) -> Value:
        raise self.refusal("is an expression, not an equation")

    def follows_without_sign(self, name: str) -> bool:
        """True if this name or call may be the second factor of an implicit product: a coefficient stands before y or y'."""
        return bool(self.functions) and (name.rstrip(PRIME) in self.functions or name in DERIVATIVES)

    def power(self, base: Value, exponent: Value, place: Any) -> Value:
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            return self.other_power(base, exponent, place)

    def call(self, head: str, arguments: list[Any], site: Site) -> Value:
        """A call of a name, with primes or not; a pair among the arguments is a tuple."""
        name = head.rstrip(PRIME)
        is_plain = not any(isinstance(argument, tuple) for argument in arguments)
        match (name if is_plain else None), arguments:
            case (("sqrt" | "cbrt"), [value]):
                return self._radical(value, ROOTS[name], site)
            case "root", [value, index]:
                number = self.arithmetic.number(index)
                if number is None or number.denominator != 1 or number < 2:
                    hint = "root(2, 3) is the cube root of 2"
                    raise NotRational("the index of a root is an integer from 2 on", hint=hint)
                return self._radical(value, number.numerator, site)
            case (("Integer" | "S"), [value]) if self.arithmetic.number(value) is not None:
                return value  # type: ignore[no-any-return]
            case "Rational", [_, _]:
                return self.arithmetic.divide(*arguments)
            case _, [base, exponent] if name in POWER_CALLS:
                return self.power(base, exponent, site)
        if head in self.names:
            hint = f"for a product write {head}*({site.inside()})"
            raise NotRational(f"{head} is followed by a parenthesis like a function", hint=hint)
        raise NotRational(f"{site.text()} isn't a rational function of {self.variable}", hint=usage(head))

    def other_leaf(self, node: Any) -> Any:
        """The value of a SymPy expression that is no sum, product, power or algebraic number."""
        message = f"{excerpt(node, 60)} isn't a rational"
        if node.is_number:
            raise NotRational(f"{message} number, nor known to be an algebraic one", hint=TRANSCENDENTAL_HINT)
        raise NotRational(f"{message} function of {self.variable}")

    def _radical(self, value: Value, n: int, place: Any) -> Poly:
        """The principal n-th root of a number, or of a parameter's square; an error for a function of the variable."""
        closed = self.arithmetic.closed(value)
        if not isinstance(closed, Poly) or not closed.is_constant:
            raise NotRational(f"{place.text()} isn't a rational function of {self.variable}", hint=usage("sqrt"))
        label = place.text()
        if closed.field == QQ:
            radicand = closed.to_str()
            label = {2: f"sqrt({radicand})", 3: f"cbrt({radicand})"}.get(n, f"root({radicand}, {n})")
        root = self.constants.radical(closed, n, label)
        if root is None:
            hint = "take the root itself as the parameter: sqrt(t) with t = s^2"
            raise NotRational(f"{place.text()} isn't rational in the parameters", hint=hint)
        return root

    def other_power(self, base: Value, exponent: Value, place: Any) -> Value:
        """`base ** exponent` for an exponent that isn't an integer: a power of a root of a number, or an error."""
        power = self.arithmetic.closed(exponent)
        if not isinstance(power, Poly) or not power.is_constant:
            raise NotRational(f"the variable in the exponent: {place.text()}")
        closed = self.arithmetic.closed(base)
        number = power.field.rational_value(power)
        constant = isinstance(closed, Poly) and closed.is_constant
        if number is None or not constant:
            kind = "n algebraic number" if constant else " rational function"
            hint = "exponents are integers, and roots those of numbers"
            raise NotRational(f"{place.text()} isn't a{kind}", hint=hint)
        return self.arithmetic.power(self._radical(base, number.denominator, place), number.numerator)


def usage(name: str) -> str:
    name = name.rstrip(PRIME)
    if name in ROOTS:
        return "roots are those of numbers: sqrt(2), cbrt(2), root(2, 5)"
    if name in FUNCTION_NAMES:
        return f"{name} has one argument; S is rational in x, or in exp(k*x), sin(k*x), ..."
    if name in INSTEAD:
        return f"write {INSTEAD[name]}"
    if name in STEP_LETTERS:
        return f"for a product write {name}*(...), for a step heaviside(...), for an impulse dirac(...)"
    if is_letter(name):
        return f"for a product write {name}*(...)"
    product = unglued(name)
    if product.endswith("(...)"):
        return f"write {product} for the product"
    known = ", ".join(sorted(FUNCTION_NAMES))
    return f"for a product write {name}*(...); the functions are {known}, of one argument"

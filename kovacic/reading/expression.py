"""Text into a rational function.

>>> parsed = parse_rational("3x/(x^2 - 1) + 0.5")
>>> str(parsed.S), parsed.variable, parsed.notices
('(x**2 + 6*x - 1)/(2*x**2 - 2)', 'x', ('0.5 was taken exactly, as 1/2',))

The rational function grows while the `parser` reads the text, and no part of the text is ever executed.  `arithmetic` checks
sizes before each operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Protocol

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, NotAnInteger, Value
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.given import (
    DEFAULT_VARIABLE,
    ENERGY,
    FUNCTION_NAMES,
    NUMBER_NAMES,
    TRANSCENDENTAL_HINT,
    UNKNOWN,
    Parsed,
)
from kovacic.reading.lexer import PRIMES, Tokens, tokenize, tokens_of
from kovacic.reading.parser import Site, evaluate, shortened, shown

_SHOWN_DECIMALS = 3

#: The functions that stand for roots, with their index (root has it as its second argument).
ROOTS = {"sqrt": 2, "cbrt": 3, "root": 0}
_FUNCTIONS = frozenset({*FUNCTION_NAMES, *ROOTS})
_LARGEST_INDEX = 100

_ALONE = "give S alone, the factor of y on the right of y'' = S(x) y"


class Place(Protocol):
    """Where an operation stands, in a text or in a SymPy expression."""

    def text(self) -> str:
        """The operation with its operands, as the user wrote it."""


def parse_rational(text: str, *, variable: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """The rational function over Q, or over a larger field of constants, that `text` denotes.

    Read are `+ - * / ^ **`, parentheses, integers and decimals (taken exactly, with a notice), and products without a
    sign where a digit or a closing parenthesis meets a letter or an opening one: `3x`, `2(x+1)(x-1)`.  Such a product
    as a divisor has two readings and is refused: `1/2x`.  Powers bind to the right, stronger than a minus before them.
    The variable is the only name in the text, else x; or the given one; other names are parameters.

    Raises `ParseError` for what isn't an expression, `NotRational` for what isn't a rational function of one variable,
    both with the position, and `LimitExceeded` before anything would become larger than the limits allow.
    """
    tokens = tokens_of(text, limits, what="the text", hint="give S(x), for example x^2 + 3")
    if marks := [k for k, kind in enumerate(tokens.kinds) if kind in ("EQUAL", "PRIMED")]:
        raise tokens.error(NotRational, "an equation, where S alone is expected", marks[0], marks[0] + 1, hint=_ALONE)
    chosen = variable or _chosen_variable(tokens)
    _refuse_ambiguous_decimals(tokens, chosen)
    return read_rational(partial(evaluate, tokens), chosen, limits)


def read_rational(walk: Callable[[RationalReader], Any], variable: str, limits: Limits) -> Parsed:
    """The rational function that a walk over a text or a SymPy expression gives to a reader."""

    def read(constants: Constants) -> Parsed:
        reader = RationalReader({variable: VARIABLE}, variable, Arithmetic(limits), constants)
        S = constants.embedded(reader.arithmetic.rational(walk(reader)))
        return Parsed(S, variable, (*reader.notices(), *constants.notices()))

    return read_with_constants(read, limits)


def parse_with(text: str, names: Mapping[str, Value], arithmetic: Arithmetic) -> Value:
    """The value of an expression in these names, whatever field their values belong to.

    Raises `ParseError`, `NotRational` and `LimitExceeded` as `parse_rational` does.
    """
    variable = next((name for name, value in names.items() if value is VARIABLE), DEFAULT_VARIABLE)
    return evaluate(tokenize(text), RationalReader(names, variable, arithmetic))  # type: ignore[no-any-return]


class RationalReader:
    """What texts and SymPy expressions mean that denote rational functions.

    `names` gives the values of the names that may occur: the variable, and whatever constants the caller's coefficient
    field has.  `constants` supplies algebraic numbers and parameters; without it both are refused.
    """

    def __init__(
        self, names: Mapping[str, Value], variable: str, arithmetic: Arithmetic, constants: Constants | None = None
    ) -> None:
        self.names = names
        self.variable = variable
        self.arithmetic = arithmetic
        self.constants = constants
        self.decimals: list[str] = []

    def notices(self) -> list[str]:
        """What the user should know about how the text was read."""
        more = len(self.decimals) - _SHOWN_DECIMALS
        return [*self.decimals[:_SHOWN_DECIMALS], *([f"{more} more decimals were taken exactly"] if more > 0 else [])]

    def number(self, text: str) -> Value:
        if text.isdigit():
            return self.arithmetic.constant(self.arithmetic.integer(text))
        value = self.arithmetic.decimal(text)
        self.decimals.append(f"{shortened(text)} was taken exactly, as {shortened(value.to_str())}")
        return value

    def name(self, name: str) -> Value:
        value = self.names.get(name)
        if value is not None:
            return value
        if self.constants is not None and name == "I":
            return self.constants.radical(QQ.poly([-1]), 2, name)  # type: ignore[return-value]
        if (meant := as_function(name)) is not None:
            raise NotRational(f"{name} looks like a function without its parentheses", hint=f"write {meant}")
        if self.constants is not None and name not in NUMBER_NAMES and name != UNKNOWN:
            return self.constants.parameter(name)
        if name in NUMBER_NAMES:
            raise NotRational(
                f"{name} is {NUMBER_NAMES[name]}; constants are rational or algebraic numbers",
                hint=f"if {name} is the variable, say so: var={name!r} (--var {name})",
            )
        if name == UNKNOWN:
            hint = f"y is the unknown function: give S alone, from y'' = S({self.variable}) y"
        else:
            hint = "write * in products; give numbers for parameters; if x isn't the variable, name it (var=, --var)"
        raise NotRational(f"the symbol {shortened(name)} beside the variable {self.variable}", hint=hint)

    def derivative(self, text: str) -> Value:
        raise NotRational(f"{shortened(text)} is a derivative, and S contains none", hint=_ALONE)

    def equation(self, left: Value, right: Value) -> Value:
        raise NotRational("an equation, where S alone is expected", hint=_ALONE)

    def follows_without_sign(self, name: str) -> bool:
        return False

    def power(self, base: Value, exponent: Value, place: Place) -> Value:
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            return self._rational_power(base, exponent, place)

    def call(self, head: str, arguments: list[Any], site: Site) -> Value:
        index = ROOTS.get(head.rstrip(PRIMES))
        if index is not None and not any(isinstance(argument, tuple) for argument in arguments):
            if len(arguments) == 1 and index:
                return self._radical(arguments[0], index, site)
            if len(arguments) == 2 and not index:
                return self._radical(arguments[0], self._index(arguments[1]), site)
        if head in self.names:
            hint = f"for a product write {head}*({site.inside()})"
            raise NotRational(f"{head} is followed by a parenthesis like a function", hint=hint)
        raise NotRational(f"{site.text()} isn't a rational function of {self.variable}", hint=usage(head))

    def other_leaf(self, node: Any) -> Any:
        """The value of a SymPy expression that is no sum, product, power or algebraic number."""
        message = f"{shown(node, 60)} isn't a rational"
        if node.is_number:
            raise NotRational(f"{message} number, nor known to be an algebraic one", hint=TRANSCENDENTAL_HINT)
        raise NotRational(f"{message} function of {self.variable}")

    def _index(self, value: Value) -> int:
        number = self.arithmetic.number(value)
        if number is None or number.denominator != 1 or not 1 < number <= _LARGEST_INDEX:
            raise NotRational(
                f"the index of a root is an integer from 2 to {_LARGEST_INDEX}", hint="root(2, 3) is the cube root of 2"
            )
        return number.numerator

    def _radical(self, value: Value, n: int, place: Place) -> Poly:
        """The principal n-th root of a number, or of a parameter's square; an error for a function of the variable."""
        closed = self.arithmetic.closed(value)
        if not isinstance(closed, Poly) or not closed.is_constant:
            raise NotRational(f"{place.text()} isn't a rational function of {self.variable}", hint=usage("sqrt"))
        if self.constants is None:
            root = closed.field.sqrt(closed) if n == 2 else None
            hint = None
        else:
            radicand = closed.to_str() if closed.field == QQ else ""
            label = f"{'cbrt' if n == 3 else 'sqrt'}({radicand})" if n < 4 else f"root({radicand}, {n})"
            root = self.constants.radical(closed, n, label if radicand else place.text())
            hint = "take the root itself as the parameter: sqrt(t) with t = s^2"
        if root is None:
            raise NotRational(f"{place.text()} isn't rational in the parameters", hint=hint)
        return root

    def _rational_power(self, base: Value, exponent: Value, place: Place) -> Value:
        """`base ** exponent` for an exponent that isn't an integer: a power of a root of a number, or an error."""
        power = self.arithmetic.closed(exponent)
        if not isinstance(power, Poly) or not power.is_constant:
            raise NotRational(f"the variable in the exponent: {place.text()}")
        closed, number = self.arithmetic.closed(base), power.field.rational_value(power)
        constant = isinstance(closed, Poly) and closed.is_constant
        if number is None or not constant:
            kind = "n algebraic number" if constant else " rational function"
            hint = "exponents are integers, and roots those of numbers"
            raise NotRational(f"{place.text()} isn't a{kind}", hint=hint)
        if number.denominator > _LARGEST_INDEX:
            raise NotRational(f"{place.text()} isn't an algebraic number of degree {_LARGEST_INDEX} or less")
        return self.arithmetic.power(self._radical(base, number.denominator, place), number.numerator)


def usage(name: str) -> str:
    """How a function is written that wasn't understood."""
    name = name.rstrip(PRIMES)
    if name in ROOTS:
        return "roots are those of numbers: sqrt(2), cbrt(2), root(2, 5)"
    if name in FUNCTION_NAMES:
        return f"{name} has one argument; S is rational in x, or in exp(k*x), sin(k*x), ..."
    known = ", ".join(sorted(FUNCTION_NAMES))
    return f"for a product write {name}*(...); the functions are {known}, of one argument"


def as_function(name: str) -> str | None:
    """sin(x) for sinx and sin: what a name probably means that looks like a function without parentheses; None for others."""
    if name in _FUNCTIONS:
        return f"{name}(x)"
    return f"{name[:-1]}({name[-1]})" if name[:-1] in _FUNCTIONS and name[-1] in "xtz" else None


def chosen_variable(names: list[str]) -> str:
    """The only name, or x.  Raises `InputError` where neither is among several names."""
    if len(names) > 1 and DEFAULT_VARIABLE not in names:
        raise InputError(
            f"which of {', '.join(names[:6])} is the variable?",
            hint=f"name it: var={names[0]!r} (--var {names[0]}); the others are parameters",
        )
    return names[0] if len(names) == 1 else DEFAULT_VARIABLE


def _chosen_variable(tokens: Tokens) -> str:
    found = tokens.names()
    names = [name for name in found if name not in {*NUMBER_NAMES, ENERGY, UNKNOWN} and as_function(name) is None]
    try:
        return chosen_variable(names)
    except InputError as error:
        k = found[names[1]]
        raise tokens.error(InputError, error.message, k, k + 1, hint=error.hint) from None


def _refuse_ambiguous_decimals(tokens: Tokens, variable: str) -> None:
    """`2e-3` is 0.002, unless the variable is called e: then it might be 2*e - 3."""
    if variable not in ("e", "E"):
        return
    for k, (kind, text) in enumerate(zip(tokens.kinds, tokens.pieces, strict=True)):
        if kind == "NUMBER" and variable in text:
            mantissa, _, rest = text.partition(variable)
            other = f"{mantissa}*{variable} {rest[0]} {rest[1:]}" if rest[0] in "+-" else f"{mantissa}*{variable}{rest}"
            message = f"{text} can be read as a decimal or as {other}, the variable being {variable}"
            hint = "write decimals without an exponent, and products with *"
            raise tokens.error(ParseError, message, k, k + 1, hint=hint)

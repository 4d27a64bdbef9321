"""Text into a rational function.

>>> parsed = parse_rational("3x/(x^2 - 1) + 0.5")
>>> str(parsed.S), parsed.variable, parsed.notices
('(x**2 + 6*x - 1)/(2*x**2 - 2)', 'x', ('0.5 was taken exactly, as 1/2',))

The text is read from left to right by the automaton of `grammar.lark`, and the rational function grows with it: there
is no tree and no recursion, and no part of the text is ever executed.  `arithmetic` checks sizes before each operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ
from kovacic.errors import InputError, LimitExceeded, NotRational, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.arithmetic import VARIABLE, Arithmetic, NotAnInteger, Value
from kovacic.reading.automaton import Site, run
from kovacic.reading.constants import Constants, read_with_constants
from kovacic.reading.lexer import Tokens, tokenize
from kovacic.reading.parsed import DEFAULT_VARIABLE, ENERGY, NUMBER_NAMES, UNKNOWN, Parsed

_SUPERSCRIPTS = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_SHOWN_DECIMALS = 3

# The functions that stand for roots of numbers, with their index (root has it as its second argument).
_ROOTS = {"sqrt": 2, "cbrt": 3, "root": 0}
_LARGEST_INDEX = 100

# Names that aren't the variable unless the caller says so.
_NEVER_CHOSEN = frozenset({*NUMBER_NAMES, ENERGY, UNKNOWN})

# A function that says where in the text the symbols of a rule are.
Where = Callable[[], Site]


def parse_rational(text: str, *, variable: str | None = None, limits: Limits = DEFAULT_LIMITS) -> Parsed:
    """The rational function over Q that `text` denotes.

    Read are `+ - * / ^ **`, parentheses, integers and decimals (taken exactly, with a notice), and products without a
    sign where a digit or a closing parenthesis meets a letter or an opening one: `3x`, `2(x+1)(x-1)`.  Such a product
    as a divisor has two readings and is refused: `1/2x`.  Powers bind to the right, stronger than a minus before them.
    The variable is the only name in the text, else x; or the given one.

    Raises `ParseError` for what isn't an expression, `NotRational` for what isn't a rational function of one variable
    over Q, both with the position, and `LimitExceeded` before anything would become larger than the limits allow.
    """
    if len(text) > limits.text_length:
        raise LimitExceeded(
            f"the text has {len(text)} characters, above the limit of {limits.text_length}", limit="text_length"
        )
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise ParseError("there is no expression", text=text, position=0, hint="give S(x), for example x^2 + 3")
    _refuse_equations(tokens)
    variable = _choose_variable(tokens, variable)
    chosen = variable

    def read(constants: Constants) -> Parsed:
        builder = ExpressionBuilder({chosen: VARIABLE}, chosen, Arithmetic(limits), constants)
        S = constants.embedded(builder.arithmetic.rational(run(tokens, builder)))
        return Parsed(S, chosen, (*builder.notices(), *constants.notices()))

    return read_with_constants(read, limits)


def parse_with(text: str, names: Mapping[str, Value], arithmetic: Arithmetic) -> Value:
    """The value of an expression in these names, whatever field their values belong to.

    Raises `ParseError`, `NotRational` and `LimitExceeded` as `parse_rational` does.
    """
    variable = next((name for name, value in names.items() if value is VARIABLE), DEFAULT_VARIABLE)
    return run(tokenize(text), ExpressionBuilder(names, variable, arithmetic))  # type: ignore[no-any-return]


class ExpressionBuilder:
    """The methods that `automaton.run` calls: one for each alias of the grammar.

    `names` gives the values of the names that may occur: the variable, and whatever constants the caller's coefficient
    field has.  `constants` supplies algebraic numbers and parameters; without it both are refused.  A method gets the
    values of the rule's symbols and the place in the text.
    """

    def __init__(
        self,
        names: Mapping[str, Value],
        variable: str,
        arithmetic: Arithmetic,
        constants: Constants | None = None,
    ) -> None:
        self.names = names
        self.variable = variable
        self.arithmetic = arithmetic
        self.constants = constants
        self._decimals: list[str] = []
        self._more_decimals = 0

    def located(self, error: LimitExceeded | ZeroDivisionError, site: Site) -> Exception:
        """The error of the arithmetic, with its place in the text."""
        if isinstance(error, LimitExceeded):
            where = f"{_shortened(site.piece_of_all())} at position {site.span()[0]}"
            said = f"{error} while {where} was read" if error.limit == "seconds" else f"{where} would have {error}"
            return LimitExceeded(said, limit=error.limit)
        if "power" in str(error):
            return _not_rational(str(error), site, hint="0^0 isn't defined")
        position, length = site.span(len(site.begins) - 1)
        return NotRational(str(error), text=site.tokens.text, position=position, length=length, hint="this is zero")

    def notices(self) -> list[str]:
        """What the user should know about how the text was read."""
        if not self._more_decimals:
            return self._decimals
        return [*self._decimals, f"{self._more_decimals} more decimals were taken exactly"]

    def number(self, values: list[Any], where: Where) -> Value:
        text = values[0]
        if text.isdigit():
            return self.arithmetic.constant(self.arithmetic.integer(text))
        return self._decimal(text)

    def name(self, values: list[Any], where: Where) -> Value:
        name = values[0]
        value = self.names.get(name)
        if value is not None:
            return value
        if self.constants is not None and name == "I":
            return self._constant(self.constants.radical(QQ.poly([-1]), 2, "I"))
        if self.constants is not None and name not in NUMBER_NAMES and name != UNKNOWN:
            return self.constants.parameter(name)
        if name in NUMBER_NAMES:
            raise _not_rational(
                f"{name} is {NUMBER_NAMES[name]}; constants are rational or algebraic numbers",
                where(),
                hint=f"if {name} is the variable, say so: var={name!r} (--var {name})",
            )
        if name == UNKNOWN:
            hint = f"y is the unknown function: give S alone, from y'' = S({self.variable}) y"
        else:
            hint = "write * in products; give numbers for parameters; if x isn't the variable, name it (var=, --var)"
        raise _not_rational(
            f"the symbol {_shortened(name)} beside the variable {self.variable}",
            where(),
            hint=hint,
        )

    def primed(self, values: list[Any], where: Where) -> Value:
        raise _not_rational(f"{_shortened(values[0])} is a derivative, and S contains none", where())

    def equation(self, values: list[Any], where: Where) -> Value:
        raise _not_rational("an equation, where S alone is expected", where())

    def negate(self, values: list[Any], where: Where) -> Value:
        return self.arithmetic.negate(values[0])

    def add(self, values: list[Any], where: Where) -> Value:
        return self.arithmetic.add(values[0], values[1])

    def subtract(self, values: list[Any], where: Where) -> Value:
        return self.arithmetic.add(values[0], values[1], subtract=True)

    def multiply(self, values: list[Any], where: Where) -> Value:
        return self.arithmetic.multiply(values[0], values[1])

    def divide(self, values: list[Any], where: Where) -> Value:
        return self.arithmetic.divide(values[0], values[1])

    def power(self, values: list[Any], where: Where) -> Value:
        base, exponent = values
        try:
            return self.arithmetic.power(base, exponent)
        except NotAnInteger:
            pass
        return self._root(base, exponent, where)

    def superscript(self, values: list[Any], where: Where) -> Value:
        base, exponent = values
        return self.arithmetic.power(base, self.arithmetic.signed_integer(exponent.translate(_SUPERSCRIPTS)))

    # An implicit product is a pair: its value, and the number of the token with which its second factor begins.

    def juxtapose(self, values: list[Any], where: Where) -> tuple[Value, int]:
        return self.arithmetic.multiply(values[0], values[1]), self._adjacent(where)

    def juxtapose_more(self, values: list[Any], where: Where) -> tuple[Value, int]:
        (left, split), right = values
        self._adjacent(where)
        return self.arithmetic.multiply(left, right), split

    def juxtaposed(self, values: list[Any], where: Where) -> Value:
        return values[0][0]  # type: ignore[no-any-return]

    def negate_juxtaposed(self, values: list[Any], where: Where) -> tuple[Value, int]:
        value, split = values[0]
        return self.arithmetic.negate(value), split

    def ambiguous(self, values: list[Any], where: Where) -> Value:
        site = where()
        split, tokens = values[1][1], site.tokens
        above, below = _shortened(site.piece(0)), site.piece(2)
        first, rest = tokens.piece(site.begins[2], split), tokens.piece(split, site.end)
        first, rest, below = _shortened(first), _shortened(rest), _shortened(below)
        position, length = site.span()
        raise ParseError(
            "a product without a sign after / can be read in two ways",
            text=tokens.text,
            position=position,
            length=length,
            hint=f"write {above}/({below}) or ({above}/{first})*{rest}",
        )

    def call(self, values: list[Any], where: Where) -> Value:
        site = where()
        head, arguments = values
        bare = head.rstrip("'’′″")
        inside = site.tokens.piece(site.begins[2], site.end - 1)
        if bare in _ROOTS and all(type(argument) is not tuple for argument in arguments):  # not a pair
            if len(arguments) == 1 and bare != "root":
                return self._radical(arguments[0], _ROOTS[bare], where)
            if len(arguments) == 2 and bare == "root":
                return self._radical(arguments[0], self._index(arguments[1], site), where)
        if head in self.names:
            hint = f"for a product write {head}*({_shortened(inside)})"
            raise _not_rational(f"{head} is followed by a parenthesis like a function", site, hint=hint)
        raise _not_rational(f"{_shortened(site.piece_of_all())} isn't a rational function of {self.variable}", site)

    def first_argument(self, values: list[Any], where: Where) -> list[Any]:
        return [values[0]]

    def next_argument(self, values: list[Any], where: Where) -> list[Any]:
        values[0].append(values[1])
        return values[0]  # type: ignore[no-any-return]

    def pair(self, values: list[Any], where: Where) -> list[Value]:
        return values

    def _decimal(self, text: str) -> Value:
        mantissa, _, scale = text.lower().partition("e")
        whole, _, digits = mantissa.partition(".")
        power = (self.arithmetic.signed_integer(scale) if scale else 0) - len(digits)
        limit = self.arithmetic.limits.digits
        if abs(power) > limit:
            raise LimitExceeded(f"over {limit} digits, the limit", limit="digits")
        numerator = self.arithmetic.integer(whole + digits) * 10 ** max(power, 0)
        value = self.arithmetic.quotient_of_integers(numerator, 10 ** max(-power, 0))
        if len(self._decimals) < _SHOWN_DECIMALS:
            self._decimals.append(f"{_shortened(text)} was taken exactly, as {_shortened(value.to_str())}")
        else:
            self._more_decimals += 1
        return value

    def _adjacent(self, where: Where) -> int:
        """The token with which the right factor of an implicit product begins; refuses what isn't one."""
        site = where()
        tokens, right = site.tokens, site.begins[1]
        before, after = tokens.kinds[right - 1], tokens.kinds[right]
        if before in ("NAME", "PRIMED") or after == "NUMBER":
            left_text, right_text = tokens.pieces[right - 1], tokens.pieces[right]
            raise ParseError(
                f"an operator is missing between {_shortened(left_text)!r} and {_shortened(right_text)!r}",
                text=tokens.text,
                position=tokens.starts[right - 1],
                length=tokens.ends[right] - tokens.starts[right - 1],
                hint="write a product with *",
            )
        return right

    def _constant(self, value: Poly | None) -> Poly:
        if value is None:
            raise AssertionError("the constant is a number")
        return value

    def _index(self, value: Value, site: Site) -> int:
        number = self._rational_number(value)
        if number is None or number.denominator != 1 or not 1 < number <= _LARGEST_INDEX:
            raise _not_rational(
                f"the index of a root is an integer from 2 to {_LARGEST_INDEX}",
                site,
                hint="root(2, 3) is the cube root of 2",
            )
        return number.numerator

    def _rational_number(self, value: Value) -> Fraction | None:
        closed = self.arithmetic.closed(value)
        if not isinstance(closed, Poly) or not closed.is_constant:
            return None
        return closed.field.rational_value(closed)

    def _radical(self, value: Value, n: int, where: Where) -> Value:
        """The principal n-th root of a number, or of a parameter's square; an error for a function of the variable."""
        site = where()
        closed = self.arithmetic.closed(value)
        shown = _shortened(site.piece_of_all())
        if not isinstance(closed, Poly) or not closed.is_constant:
            raise _not_rational(f"{shown} isn't a rational function of {self.variable}", site)
        if self.constants is None:
            root = closed.field.sqrt(closed) if n == 2 else None
            hint = None
        else:
            radicand = closed.to_str() if closed.field == QQ else ""
            label = f"{'cbrt' if n == 3 else 'sqrt'}({radicand})" if n < 4 else f"root({radicand}, {n})"
            root = self.constants.radical(closed, n, label if radicand else shown)
            hint = "take the root itself as the parameter: sqrt(t) with t = s^2"
        if root is None:
            raise _not_rational(f"{shown} isn't rational in the parameters", site, hint=hint)
        return root

    def _root(self, base: Value, exponent: Value, where: Where) -> Value:
        """`base ** exponent` for an exponent that isn't an integer: a power of a root of a number, or an error."""
        site = where()
        power = self.arithmetic.closed(exponent)
        if not isinstance(power, Poly) or not power.is_constant:
            raise _not_rational(f"the variable in the exponent: {_shortened(site.piece_of_all())}", site)
        number = power.field.rational_value(power)
        closed = self.arithmetic.closed(base)
        if number is None or not isinstance(closed, Poly) or not closed.is_constant:
            kind = "n algebraic number" if isinstance(closed, Poly) and closed.is_constant else " rational function"
            what = f"{_shortened(site.piece_of_all())} isn't a{kind}"
            raise _not_rational(what, site, hint="exponents are integers, and roots those of numbers")
        if number.denominator > _LARGEST_INDEX:
            raise _not_rational(
                f"{_shortened(site.piece_of_all())} isn't an algebraic number of degree {_LARGEST_INDEX} or less", site
            )
        return self.arithmetic.power(self._radical(base, number.denominator, where), number.numerator)


def _choose_variable(tokens: Tokens, variable: str | None) -> str:
    if variable is not None:
        if not variable.isidentifier():
            raise InputError(f"{variable!r} can't be the name of a variable", hint="a letter, or a word: x, t, x1")
        chosen = variable
    else:
        names = [name for name in tokens.names() if name not in _NEVER_CHOSEN]
        if len(names) > 1 and DEFAULT_VARIABLE not in names:
            raise InputError(
                f"which of {', '.join(names[:6])} is the variable?",
                text=tokens.text,
                position=tokens.starts[tokens.names()[names[1]]],
                length=len(names[1]),
                hint=f"name it: var={names[0]!r} (--var {names[0]}); the others are parameters",
            )
        chosen = names[0] if len(names) == 1 else DEFAULT_VARIABLE
    _refuse_ambiguous_decimals(tokens, chosen)
    return chosen


def _refuse_ambiguous_decimals(tokens: Tokens, variable: str) -> None:
    """`2e-3` is 0.002, unless the variable is called e: then it might be 2*e - 3."""
    if variable not in ("e", "E"):
        return
    for k, (kind, text) in enumerate(zip(tokens.kinds, tokens.pieces, strict=True)):
        if kind == "NUMBER" and variable in text:
            mantissa, _, rest = text.partition(variable)
            reading = (
                f"{mantissa}*{variable} {rest[0]} {rest[1:]}" if rest[0] in "+-" else f"{mantissa}*{variable}{rest}"
            )
            raise ParseError(
                f"{text} can be read as a decimal or as {reading}, the variable being {variable}",
                text=tokens.text,
                position=tokens.starts[k],
                length=len(text),
                hint="write decimals without an exponent, and products with *",
            )


def _refuse_equations(tokens: Tokens) -> None:
    found = [tokens.kinds.index(kind) for kind in ("EQUAL", "PRIMED") if kind in tokens.kinds]
    if found:
        first = min(found)
        raise NotRational(
            "this is an equation, or a part of one",
            text=tokens.text,
            position=tokens.starts[first],
            length=len(tokens.pieces[first]),
            hint="give S alone, the factor of y on the right of y'' = S(x) y",
        )


def _not_rational(message: str, site: Site, *, hint: str | None = None) -> NotRational:
    position, length = site.span()
    return NotRational(message, text=site.tokens.text, position=position, length=length, hint=hint)


def _shortened(text: str, width: int = 40) -> str:
    text = " ".join(text.split()) if len(text) < 10_000 else text
    return text if len(text) <= width else f"{text[: width // 2]}...{text[-width // 4 :]}"


__all__ = ["ExpressionBuilder", "parse_rational", "parse_with"]

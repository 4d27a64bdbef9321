"""The parser: a text is read once from left to right, and values are combined as soon as their operator's turn has come.

A stack holds the operators whose right operand is still being read, another one the values: there is no tree and no
recursion, so that 10^5 nested parentheses are nothing special, and the time is linear in the length of the text.

Precedence, from weak to strong: = ; + - ; * / ; unary + - ; implicit product ; power (to the right: 2^3^2 = 2^9).
-x^2 is -(x^2), x^-2 is 1/x^2, 2*-x is allowed.  An implicit product as a divisor (1/2x) has two readings and is refused.
A power or a superscript belongs to a number, a name, a parenthesis or a call: x²^3 is refused.  A call f(a, (b, c)) has
expressions and pairs of expressions as its arguments.  An equation has one equals sign, outside all parentheses.

What the numbers, names and calls mean is a reader's affair: a rational function, an equation, a SymPy expression.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kovacic.errors import InputError, LimitExceeded, NotRational, ParseError
from kovacic.reading.lexer import DERIVATIVES, Tokens
from kovacic.reading.names import FUNCTION_NAMES
from kovacic.reading.notation import GREEK

_OPEN, _PAIR, _SUM, _PRODUCT, _SIGN, _IMPLICIT, _POWER = range(-1, 6)
_BINARY = {"PLUS": _SUM, "MINUS": _SUM, "STAR": _PRODUCT, "SLASH": _PRODUCT}
_OPERANDS = frozenset({"NUMBER", "NAME", "PRIMED", "HEAD", "LPAR"})
_OPERATORS = (*_BINARY, "CIRCUMFLEX")
#: SymPy's functions are recursive.
_DEEPEST_CALL = 100
_SUPERSCRIPTS = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")


class Site:
    """Where the operation stands that is being carried out: tokens `begin`, ..., `end - 1`, the last operand from `right`."""

    __slots__ = ("begin", "end", "right", "tokens")

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.begin = self.right = self.end = 0

    def text(self) -> str:
        """The text of the operation with its operands, shortened."""
        return shortened(self.tokens.piece(self.begin, self.end))

    def inside(self) -> str:
        """The text between the parentheses of a call, shortened."""
        return shortened(self.tokens.piece(self.begin + 2, self.end - 1))

    def located(self, error: Exception) -> Exception:
        """An error of the operation with its place in the text."""
        if isinstance(error, LimitExceeded):
            where = f"{self.text()} at position {self.tokens.starts[self.begin]}"
            said = f"{error} while {where} was read" if error.limit == "seconds" else f"{where} would have {error}"
            return LimitExceeded(said, limit=error.limit)
        if isinstance(error, ZeroDivisionError):
            power = "power" in str(error)
            begin, hint = (self.begin, "0^0 isn't defined") if power else (self.right, "this is zero")
            return self.tokens.error(NotRational, str(error), begin, self.end, hint=hint)
        if isinstance(error, InputError) and error.text is None:
            return self.tokens.error(type(error), error.message, self.begin, self.end, hint=error.hint)
        return error


def evaluate(tokens: Tokens, reader: Any) -> Any:
    """The value of a text to a reader: a `RationalReader`, or what extends it.

    Raises `ParseError` where it isn't an expression or equation, and what the reader raises, with the place in the text.
    """
    site = Site(tokens)
    try:
        return _evaluated(tokens, reader, site)
    except (LimitExceeded, ZeroDivisionError, InputError) as error:
        raise site.located(error) from None
    except RecursionError:
        raise LimitExceeded(f"{site.text()} is nested too deeply for SymPy", limit="text_length") from None


def _evaluated(tokens: Tokens, reader: Any, site: Site) -> Any:
    kinds, pieces = tokens.kinds, tokens.pieces
    arithmetic, number, name = reader.arithmetic, reader.number, reader.name
    # The operands: their values, their first tokens, and where they are implicit products the second factor's token.
    values: list[Any] = []
    begins: list[int] = []
    splits: list[int] = []
    # The operators and opening parentheses (the name of a call for its own): their strengths and tokens.
    pending: list[tuple[int, int]] = [(_OPEN, -1)]
    arguments: list[list[Any]] = []  # of the calls and pairs that are being read
    left_side: list[Any] = []

    def add(end: int) -> None:
        """Carries out the pending additions, which are one sum: its terms are all known now."""
        count = 1
        while pending[-1][0] == _SUM:
            if kinds[pending.pop()[1]] == "MINUS":
                values[-count] = arithmetic.negate(values[-count])
            count += 1
        site.right, site.end, site.begin = begins[-1], end, begins[-count]
        values[-count:] = [arithmetic.sum(values[-count:])]
        del begins[1 - count :], splits[1 - count :]

    def reduce(strength: int, end: int) -> None:
        """Carries out the pending operations that bind at least so strongly: as products do, or stronger."""
        while pending[-1][0] >= strength:
            level, k = pending.pop()
            kind = kinds[k]
            site.right, site.end = begins[-1], end
            if level == _SIGN or (level == _POWER and kind != "CIRCUMFLEX"):
                site.begin = begins[-1] = k
                if kind == "MINUS":
                    values[-1] = arithmetic.negate(values[-1])
                continue
            right, split = values.pop(), splits.pop()
            del begins[-1]
            left, site.begin = values[-1], begins[-1]
            if level == _IMPLICIT:
                _check_neighbours(tokens, reader, site.begin, site.right)
                values[-1] = arithmetic.multiply(left, right)
                splits[-1] = splits[-1] or site.right
            elif level == _POWER:
                values[-1] = reader.power(left, right, site)
            elif kind == "STAR":
                values[-1] = arithmetic.multiply(left, right)
                splits[-1] = 0
            elif split:
                raise _ambiguous(tokens, site, k, split)
            else:
                values[-1] = arithmetic.divide(left, right)
                splits[-1] = 0

    operand = True  # is an operand expected, or an operator?
    for k, kind in enumerate(kinds):
        if not operand:
            if kind in _BINARY:
                reduce(_PRODUCT, k)
                pending.append((_BINARY[kind], k))
                operand = True
                continue
            if kind in ("CIRCUMFLEX", "SUPERSCRIPT") and kinds[k - 1] != "SUPERSCRIPT":
                if kind == "CIRCUMFLEX":
                    pending.append((_POWER, k))
                    operand = True
                else:
                    site.begin, site.right, site.end = begins[-1], k, k + 1
                    exponent = arithmetic.signed_integer(pieces[k].translate(_SUPERSCRIPTS))
                    values[-1] = reader.power(values[-1], arithmetic.constant(exponent), site)
                continue
            if kind not in _OPERANDS:
                reduce(_PRODUCT, k)
                if pending[-1][0] == _SUM:
                    add(k)
                level, opened = pending[-1]
                call = opened >= 0 and kinds[opened] == "HEAD"
                if kind == "RPAR" and opened >= 0:
                    del pending[-1]
                    begins[-1], splits[-1] = opened, 0
                    if call:
                        site.begin, site.right, site.end = opened, k, k + 1
                        values[-1] = reader.call(pieces[opened], [*arguments.pop(), values[-1]], site)
                    elif level == _PAIR:
                        values[-1] = (*arguments.pop(), values[-1])
                        if kinds[k + 1] not in ("COMMA", "RPAR"):
                            raise _syntax_error(tokens, k + 1, pending)
                elif kind == "COMMA" and (call or (level == _OPEN and _is_argument(pending, kinds))):
                    if not call:
                        pending[-1] = (_PAIR, opened)
                        arguments.append([])
                    arguments[-1].append(values.pop())
                    del begins[-1], splits[-1]
                    operand = True
                elif kind == "EQUAL" and opened < 0 and not left_side:
                    left_side.append(values.pop())
                    del splits[-1]
                    operand = True
                elif kind != "$END" or opened >= 0:
                    raise _syntax_error(tokens, k, pending)
                continue
            reduce(_IMPLICIT, k)
            pending.append((_IMPLICIT, k))
        site.begin, site.right, site.end = k, k, k + 1
        if kind == "LPAR" and kinds[k - 1] == "HEAD" and k:
            continue
        if kind == "LPAR" or kind == "HEAD":
            pending.append((_OPEN, k))
            if kind == "HEAD":
                arguments.append([])
                if len(arguments) > _DEEPEST_CALL:
                    raise LimitExceeded(f"over {_DEEPEST_CALL} nested calls, the limit", limit="text_length")
            operand = True
            continue
        if kind == "NUMBER":
            values.append(number(pieces[k]))
        elif kind == "NAME":
            values.append(name(pieces[k]))
        elif kind == "PRIMED":
            values.append(reader.derivative(pieces[k]))
        elif kind == "MINUS" or kind == "PLUS":
            pending.append((_POWER if pending[-1][0] == _POWER else _SIGN, k))
            continue
        else:
            raise _syntax_error(tokens, k, pending)
        begins.append(k)
        splits.append(0)
        operand = False
    if left_side:
        site.begin, site.right, site.end = begins[0], begins[-1], len(kinds) - 1
        return reader.equation(left_side[0], values[0])
    return values[0]


def _is_argument(pending: Sequence[tuple[int, int]], kinds: Sequence[str]) -> bool:
    """Does the innermost parenthesis begin an argument of a call?"""
    level, opened = pending[-2] if len(pending) > 1 else (_SUM, -1)
    return level == _OPEN and opened >= 0 and kinds[opened] == "HEAD"


def _check_neighbours(tokens: Tokens, reader: Any, begin: int, right: int) -> None:
    """Refuses a product without a sign whose second factor, from token `right`, can't be told from the first one."""
    left = right - 1
    applied = tokens.pieces[begin] in DERIVATIVES and tokens.kinds[right] == "LPAR"  # D(y)(x)
    if tokens.kinds[left] not in ("NAME", "PRIMED") and tokens.kinds[right] != "NUMBER" and not applied:
        return
    if tokens.kinds[right] in ("NAME", "PRIMED", "HEAD") and reader.follows_without_sign(tokens.pieces[right]):
        return
    if _are_apart(tokens, left, right):
        return
    first, second = shortened(tokens.pieces[left]), shortened(tokens.pieces[right])
    message = f"an operator is missing between {first!r} and {second!r}"
    raise tokens.error(ParseError, message, left, right + 1, hint="write a product with *")


def _are_apart(tokens: Tokens, left: int, right: int) -> bool:
    """Are these a letter and another letter or a call, with a space between: a x, a sin(x)?"""
    if tokens.kinds[left] != "NAME" or tokens.kinds[right] not in ("NAME", "HEAD"):
        return False
    if tokens.ends[left] == tokens.starts[right] or not _is_letter(tokens.pieces[left]):
        return False
    return _is_letter(tokens.pieces[right]) or tokens.pieces[right] in FUNCTION_NAMES


def _is_letter(name: str) -> bool:
    """x, x1, omega, omega_0; not a word."""
    bare = name.rstrip("0123456789").rstrip("_")
    return len(bare) == 1 or bare in GREEK


def _ambiguous(tokens: Tokens, site: Site, slash: int, split: int) -> InputError:
    """What to say of a/b c, where c begins with token `split`."""
    spans = ((site.begin, slash), (site.right, site.end), (site.right, split), (split, site.end))
    above, below, first, rest = (shortened(tokens.piece(*span)) for span in spans)
    hint = f"write {above}/({below}) or ({above}/{first})*{rest}"
    message = "a product without a sign after / can be read in two ways"
    return tokens.error(ParseError, message, site.begin, site.end, hint=hint)


def _syntax_error(tokens: Tokens, k: int, pending: Sequence[tuple[int, int]]) -> InputError:
    """What is wrong with token k, which can't follow what was read."""
    kinds, kind = tokens.kinds, tokens.kinds[k]
    before, here = kinds[k - 1] if k else "", tokens.pieces[k]
    first, message, hint = k, f"{here!r} doesn't belong here", None
    opened = [at + (kinds[at] == "HEAD") for level, at in pending if level < _SUM and at >= 0]
    if kind == "$END":
        first = k - 1
        if before in (*_OPERATORS, "EQUAL", "COMMA"):
            message, hint = f"the expression ends after {tokens.pieces[k - 1]!r}", "something is missing after it"
            k = first
        elif opened:
            message, first, k = "this parenthesis is never closed", opened[-1], opened[-1]
            hint = f"add {')' * len(opened)!r} where it ends" if len(opened) < 20 else "count the parentheses"
        else:
            message, first = "the expression isn't complete", k
    elif kind == "RPAR" and before == "LPAR":
        message, hint = "there is nothing between these parentheses", "leave them out, or write what belongs there"
        first = k - 1
    elif kind == "RPAR" and not opened:
        message, hint = "this parenthesis closes nothing", "remove it, or open it before"
    elif before in _OPERATORS and kind in (*_OPERATORS, "RPAR", "EQUAL", "COMMA"):
        message, first = f"something is missing between {tokens.pieces[k - 1]!r} and {here!r}", k - 1
        hint = "write the number or name that belongs there, or one of the signs"
    elif kind in (*_OPERATORS, "SUPERSCRIPT"):
        message = f"there is nothing before {here!r} for it to act on"
        hint = "write the number or name that belongs there"
    elif kind == "COMMA":
        message, hint = "a comma doesn't belong here", "decimals are written with a point, and one expression is one S"
    elif kind == "EQUAL":
        hint = "an equation has one equals sign, outside all parentheses"
    return tokens.error(ParseError, message, first, k + 1, hint=hint)


def listed(text: str) -> list[str]:
    """The parts between commas, those within parentheses apart."""
    parts, depth = [""], 0
    for character in text:
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def shown(value: Any, width: int = 40) -> str:
    """Any value as text, shortened."""
    try:
        return shortened(str(value), width)
    except ValueError:  # Python prints integers of at most 4300 digits
        return "a number of thousands of digits"


def shortened(text: str, width: int = 40) -> str:
    """The text on one line, without its middle where it is long."""
    text = " ".join(text.split()) if len(text) < 10_000 else text
    return text if len(text) <= width else f"{text[: width // 2]}...{text[-width // 4 :]}"

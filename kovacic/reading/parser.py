"""The parser: a text is read once from left to right, and values are combined as soon as their operator's turn has come.

A stack holds the operators whose right operand is still being read, another one the values: there is no tree and no
recursion, so that 10^5 nested parentheses are nothing special, and the time is linear in the length of the text.

Precedence, from weak to strong: = ; + - ; * / ; unary + - ; implicit product ; power (to the right: 2^3^2 = 2^9).
-x^2 is -(x^2), x^-2 is 1/x^2, 2*-x is allowed.  An implicit product as a divisor (1/2x) has two readings and is refused.
A power or a superscript belongs to a number, a name, a parenthesis or a call: x²^3 is refused.  A call f(a, (b, c)) has
expressions and pairs of expressions as its arguments; the second of a pair may be a comparison, 0 <= x < 1.  An equation
has one equals sign, outside all parentheses.

Readers define the meaning of numbers, names and calls: a rational function, an equation, a SymPy expression.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

from kovacic.errors import InputError, LimitExceeded, NotRational, ParseError
from kovacic.limits import check_time
from kovacic.numbers.numerals import plain_text
from kovacic.reading.lexer import DERIVATIVES, PRIME, SUPERSCRIPT_DIGITS, unexpected
from kovacic.reading.notations import ParserTokens

# Strengths; no operation reaches beyond a parenthesis that is open.
_OPEN, _SUM, _PRODUCT, _SIGN, _IMPLICIT, _POWER = range(6)
_UNARY_KINDS = ("PLUS", "MINUS")
_BINARY = {"PLUS": _SUM, "MINUS": _SUM, "STAR": _PRODUCT, "SLASH": _PRODUCT}
_ATOMS = ("NUMBER", "NAME", "PRIMED", "OPERATOR")
_OPERANDS = frozenset({*_ATOMS, "HEAD", "LPAR"})
_BINARY_KINDS = (*_BINARY, "CIRCUMFLEX")
_NO_OPERANDS = (*_BINARY_KINDS, "RPAR", "COMMA", "EQUAL")
#: The deepest nesting of calls, exponents, fractions and derivatives: SymPy and the look ahead at fractions are recursive.
DEEPEST = 100


@dataclass(slots=True)
class Site:
    """The place of the operation that is being carried out; `span` is (begin, right, end).

    It has the tokens `begin`, ..., `end - 1`, and its last operand those from `right`.
    """

    tokens: ParserTokens
    span: tuple[int, int, int] = (0, 0, 0)

    def text(self) -> str:
        """The text of the operation with its operands, shortened."""
        begin, _, end = self.span
        return excerpt(self.tokens.piece(begin, end))

    def inside(self) -> str:
        """The text between the parentheses of a call, shortened."""
        begin, _, end = self.span
        return excerpt(self.tokens.piece(begin + 2, end - 1))

    def located(self, error: Exception) -> Exception:
        """An error of the operation with its place in the text."""
        begin, right, end = self.span
        if isinstance(error, LimitExceeded):
            where = f"{self.text() or 'the text'} at position {self.tokens[begin].start}"
            said = f"{error} while {where} was read" if error.limit == "seconds" else f"{where} would have {error}"
            return LimitExceeded(said, limit=error.limit)
        if isinstance(error, ZeroDivisionError):
            power = "power" in str(error)
            first, hint = (begin, "0^0 isn't defined") if power else (right, "this is zero")
            return self.tokens.error(NotRational, str(error), first, end, hint=hint)
        if isinstance(error, InputError) and error.text is None:
            return self.tokens.error(type(error), error.message, begin, end, hint=error.hint, shell=error.shell)
        return error


def parse(tokens: ParserTokens, reader: Any) -> Any:
    """The value of a text to a reader.  Raises `ParseError`, and the errors of the reader with their place in the text."""
    parser = _Parser(tokens, reader)
    site = parser.site
    try:
        return parser.read()
    except (LimitExceeded, ZeroDivisionError, InputError) as error:
        raise site.located(error) from None
    except RecursionError:
        raise LimitExceeded(f"{site.text()} is nested too deeply for SymPy", limit="text_length") from None


class Comparison(NamedTuple):
    """values[0] signs[0] values[1] ...; without signs it is always true."""

    signs: tuple[str, ...]
    values: tuple[Any, ...] = ()


@dataclass(slots=True)
class _Operand:
    """A value that was read, its first token, and of a product without a sign the first token of the second factor."""

    value: Any
    begin: int
    split: int = 0


@dataclass(slots=True)
class _Group:
    """The contents of a parenthesis, and the operands in it before a comma; or the whole text, and the left side of its =.

    `opened` is the token of the parenthesis, or of the name before it, -1 for the whole text; `signs` those of a comparison.
    """

    opened: int
    is_call: bool = False
    is_pair: bool = False
    signs: list[str] = field(default_factory=list)
    arguments: list[_Operand] = field(default_factory=list)


class _Parser:
    """One pass over the tokens: `_PREFIX` has their methods where an operand is expected, `_INFIX` those after an operand.

    Each of these takes the number of its token, and returns True if an operand is expected next.
    """

    def __init__(self, tokens: ParserTokens, reader: Any) -> None:
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.pieces = tokens.pieces
        self.reader = reader
        self.arithmetic = reader.arithmetic
        self.atoms = {
            "NUMBER": reader.number,
            "NAME": reader.name,
            "PRIMED": reader.derivative,
            "OPERATOR": reader.operator,
        }
        self.site = Site(tokens)
        self.operands: list[_Operand] = []
        #: The strengths and tokens of the operators whose right operand is still being read, and of the open groups.
        self.pending = [(_OPEN, -1)]
        self.groups = [_Group(-1)]
        #: The number of calls and pairs that are open.
        self.argument_lists = 0
        #: The number of exponents within each other that are being read.
        self.exponents = 0

    def read(self) -> Any:
        operand_is_next = True
        for k, kind in enumerate(self.kinds):
            check_time()
            table = _PREFIX if operand_is_next else _INFIX
            if kind not in table:
                raise self.syntax_error(k)
            operand_is_next = table[kind](self, k)
        right = self.operands[-1]
        if not self.groups[0].arguments:
            return right.value
        left = self.groups[0].arguments[0]
        self.site.span = left.begin, right.begin, len(self.kinds) - 1
        return self.reader.equation(left.value, right.value)

    def atom(self, k: int) -> bool:
        """A number, a name, or a name with primes."""
        self.site.span = k, k, k + 1
        self.operands.append(_Operand(self.atoms[self.kinds[k]](self.pieces[k]), k))
        return False

    def sign(self, k: int) -> bool:
        """Of an operand, or of an exponent: x^-2."""
        self.pending.append((_POWER if self.pending[-1][0] == _POWER else _SIGN, k))
        return True

    def head(self, k: int) -> bool:
        self.site.span = k, k, k + 1
        self.open(_Group(k, is_call=True))
        self.argument_lists += 1
        if self.argument_lists > DEEPEST:
            raise LimitExceeded(f"over {DEEPEST} nested calls, the limit", limit="text_length")
        return True

    def parenthesis(self, k: int) -> bool:
        if self.kinds[k - 1] != "HEAD":  # which has opened the group already
            self.open(_Group(k))
        return True

    def open(self, group: _Group) -> None:
        self.groups.append(group)
        self.pending.append((_OPEN, group.opened))

    def binary(self, k: int) -> bool:
        self.reduce(_PRODUCT, k)
        self.pending.append((_BINARY[self.kinds[k]], k))
        return True

    def power(self, k: int) -> bool:
        """The exponent is the operand that follows, or the token itself, a superscript."""
        if self.kinds[k - 1] == "SUPERSCRIPT":  # x²^3
            self.complete(k)  # so that an earlier error is reported first
            raise self.syntax_error(k)
        self.pending.append((_POWER, k))
        self.exponents += 1
        if self.exponents > DEEPEST:
            raise LimitExceeded(f"over {DEEPEST} nested exponents, the limit", limit="text_length")
        if self.kinds[k] == "CIRCUMFLEX":
            return True
        self.site.span = self.operands[-1].begin, k, k + 1
        exponent = self.arithmetic.integer(self.pieces[k].translate(SUPERSCRIPT_DIGITS))
        self.operands.append(_Operand(self.arithmetic.constant(exponent), k))
        return False

    def implicit_product(self, k: int) -> bool:
        """The token begins the second factor; a quotient before a derivative is its factor: 1/2m y'' is (1/(2m)) y''."""
        self.reduce(_IMPLICIT, k)
        level, slash = self.pending[-1]
        if level == _PRODUCT and self.kinds[slash] == "SLASH" and self.is_derivative(k):
            self.reduce(_PRODUCT, k)
        self.pending.append((_IMPLICIT, k))
        return _PREFIX[self.kinds[k]](self, k)

    def is_derivative(self, k: int) -> bool:
        piece = self.pieces[k]
        is_call = self.kinds[k] == "HEAD" and piece in DERIVATIVES
        return is_call or piece.endswith(PRIME) or self.kinds[k] == "OPERATOR"

    def is_in_factor(self, begin: int, end: int) -> bool:
        """True for a divisor without blanks, apart from the derivative: 2m in 1/2m y'' and (1/2m) y'', not in 1/2 m y''."""
        is_enclosed = self.kinds[end] == "RPAR"
        *gaps, last = (self.tokens[j].end < self.tokens[j + 1].start for j in range(begin, end))
        return (is_enclosed or last) and not any(gaps) and self.is_derivative(end + is_enclosed)

    def close(self, k: int) -> bool:
        self.complete(k)
        group = self.groups[-1]
        if group.opened < 0:
            raise self.syntax_error(k)
        self.groups.pop()
        self.pending.pop()
        enclosed = self.operands[-1]
        enclosed.begin = group.opened
        enclosed.split = 0
        if group.is_call or group.is_pair:
            self.argument_lists -= 1
            values = [*(argument.value for argument in group.arguments), enclosed.value]
        if group.signs:
            values[1:] = [Comparison(tuple(group.signs), tuple(values[1:]))]
        if group.is_call:
            self.site.span = group.opened, k, k + 1
            enclosed.value = self.reader.call(self.pieces[group.opened], values, self.site)
        elif group.is_pair:
            enclosed.value = tuple(values)
            if self.kinds[k + 1] not in ("COMMA", "RPAR"):
                raise self.syntax_error(k + 1)
        return False

    def comma(self, k: int) -> bool:
        self.complete(k)
        group = self.groups[-1]
        if not group.is_call:
            # A pair is a parenthesis with which an argument of a call begins.
            around = self.groups[-2] if group.opened >= 0 else group
            if group.is_pair or not around.is_call or self.pending[-2] != (_OPEN, around.opened):
                raise self.syntax_error(k)
            group.is_pair = True
            self.argument_lists += 1
        group.arguments.append(self.operands.pop())
        return True

    def comparison(self, k: int) -> bool:
        """In the second of a pair."""
        self.complete(k)
        group = self.groups[-1]
        if not group.is_pair:
            raise unexpected(self.tokens.text, self.tokens[k])
        group.signs.append(self.pieces[k])
        group.arguments.append(self.operands.pop())
        return True

    def otherwise(self, k: int) -> bool:
        if not self.groups[-1].is_pair or self.kinds[k - 1] != "COMMA":
            raise self.syntax_error(k)
        self.operands.append(_Operand(Comparison(()), k))
        return False

    def equals(self, k: int) -> bool:
        self.complete(k)
        group = self.groups[-1]
        if group.opened >= 0 or group.arguments:
            raise self.syntax_error(k)
        group.arguments.append(self.operands.pop())
        return True

    def end(self, k: int) -> bool:
        self.complete(k)
        if self.groups[-1].opened >= 0:
            raise self.syntax_error(k)
        return False

    def complete(self, end: int) -> None:
        """Carries out all that is pending in the innermost group."""
        self.reduce(_PRODUCT, end)
        if self.pending[-1][0] == _SUM:
            self.add(end)

    def reduce(self, strength: int, end: int) -> None:
        """Carries out the pending operations that bind at least so strongly: as products do, or stronger."""
        pending = self.pending
        while pending[-1][0] >= strength:
            level, k = pending.pop()
            if level != _SIGN and not (level == _POWER and self.kinds[k] in _UNARY_KINDS):
                self.combine(level, k, end)
                continue
            operand = self.operands[-1]
            self.site.span = k, operand.begin, end
            operand.begin = k
            if self.kinds[k] == "MINUS":
                operand.value = self.arithmetic.negate(operand.value)

    def add(self, end: int) -> None:
        """Carries out the pending additions, which are one sum: its terms are all known now."""
        signs = []
        while self.pending[-1][0] == _SUM:
            signs.append(self.kinds[self.pending.pop()[1]])
        first = len(self.operands) - len(signs) - 1
        terms = self.operands[first:]
        self.site.span = terms[0].begin, terms[-1].begin, end
        for term, sign in zip(terms[:0:-1], signs, strict=True):
            if sign == "MINUS":
                term.value = self.arithmetic.negate(term.value)
        terms[0].value = self.arithmetic.sum([term.value for term in terms])
        terms[0].split = 0
        del self.operands[first + 1 :]

    def combine(self, level: int, k: int, end: int) -> None:
        """A power, a product or a quotient of the last two operands takes their place."""
        right = self.operands.pop()
        left = self.operands[-1]
        self.site.span = left.begin, right.begin, end
        if level == _POWER:
            self.exponents -= 1
            left.value = self.reader.power(left.value, right.value, self.site)
        elif level == _IMPLICIT:
            _check_neighbours(self.tokens, self.reader, left.begin, right.begin)
            left.value = self.arithmetic.multiply(left.value, right.value)
            left.split = left.split or right.begin
        else:
            is_product = self.kinds[k] == "STAR"
            if right.split and not is_product and not self.is_in_factor(right.begin, end):
                # a/b c, where c begins with token `right.split`
                spans = ((left.begin, k), (right.begin, end), (right.begin, right.split), (right.split, end))
                above, below, first, rest = (excerpt(self.tokens.piece(*span)) for span in spans)
                hint = f"write {above}/({below}) or ({above}/{first})*{rest}"
                said = "a product without a sign after / can be read in two ways"
                raise self.tokens.error(ParseError, said, left.begin, end, hint=hint)
            operation = self.arithmetic.multiply if is_product else self.arithmetic.divide
            left.value = operation(left.value, right.value)
            left.split = 0

    def syntax_error(self, k: int) -> InputError:
        """The error for token k, which can't follow the tokens before it."""
        tokens = self.tokens
        opened = [group.opened + group.is_call for group in self.groups[1:]]
        kind, piece, before = self.kinds[k], self.pieces[k], self.kinds[k - 1]
        fault: _Fault = f"{piece!r} doesn't belong here" if piece else "the expression isn't complete", k, k, None
        if kind == "$END" and before in (*_BINARY_KINDS, "EQUAL", "COMMA"):
            fault = f"the expression ends after {self.pieces[k - 1]!r}", k - 1, k - 1, "something is missing after it"
        elif kind == "$END" and opened:
            hint = f"add {excerpt(')' * len(opened))!r} where it ends"
            fault = "this parenthesis is never closed", opened[-1], opened[-1], hint
        elif kind == "RPAR" and before == "LPAR":
            said = "there is nothing between these parentheses"
            fault = said, k - 1, k, "leave them out, or write what belongs there"
        elif kind == "RPAR" and not opened:
            fault = "this parenthesis closes nothing", k, k, "remove it, or open it before"
        elif before in _BINARY_KINDS and kind in _NO_OPERANDS:
            said = f"something is missing between {self.pieces[k - 1]!r} and {piece!r}"
            fault = said, k - 1, k, "write the number or name that belongs there, or one of the signs"
        elif kind == "COMMA":
            fault = _comma(tokens, k)
        elif kind in (*_BINARY_KINDS, "SUPERSCRIPT"):
            said = f"there is nothing before {piece!r} for it to act on"
            fault = said, k, k, "write the number or name that belongs there"
        elif kind == "EQUAL":
            fault = (*fault[:3], "an equation has one equals sign, outside all parentheses")
        message, begin, last, remedy = fault
        return tokens.error(ParseError, message, begin, last + 1, hint=remedy)


#: The methods for tokens where an operand is expected; all other kinds are misplaced there.
_PREFIX = {
    **dict.fromkeys(_ATOMS, _Parser.atom),
    "HEAD": _Parser.head,
    "LPAR": _Parser.parenthesis,
    "PLUS": _Parser.sign,
    "MINUS": _Parser.sign,
    "OTHERWISE": _Parser.otherwise,
}
#: The methods for tokens after an operand.
_INFIX = {
    **dict.fromkeys(_BINARY, _Parser.binary),
    "CIRCUMFLEX": _Parser.power,
    "SUPERSCRIPT": _Parser.power,
    **dict.fromkeys(_OPERANDS, _Parser.implicit_product),
    "RPAR": _Parser.close,
    "COMMA": _Parser.comma,
    "COMPARISON": _Parser.comparison,
    "EQUAL": _Parser.equals,
    "$END": _Parser.end,
}


def _check_neighbours(tokens: ParserTokens, reader: Any, begin: int, right: int) -> None:
    """Refuses a product without a sign whose second factor, from token `right`, can't be told from the first one."""
    left = right - 1
    is_applied = tokens.pieces[begin] in DERIVATIVES and tokens.kinds[right] == "LPAR"  # D(y)(x)
    may_run_together = tokens.kinds[left] in ("NAME", "PRIMED") or tokens.kinds[right] == "NUMBER"
    if not may_run_together and not is_applied:
        return
    if tokens.kinds[right] in ("NAME", "PRIMED", "HEAD") and reader.follows_without_sign(tokens.pieces[right]):
        return
    if tokens.kinds[left] == "NAME" and tokens.kinds[right] in ("NAME", "HEAD", "LPAR", "OPERATOR"):
        return  # letters that stand apart, as `naming` has found
    first = excerpt(tokens.pieces[left])
    second = excerpt(tokens.pieces[right])
    message = f"an operator is missing between {first!r} and {second!r}"
    raise tokens.error(ParseError, message, left, right + 1, hint="write a product with *")


#: A message, the first and the last token that it is about, and a hint.
_Fault = tuple[str, int, int, str | None]


def _comma(tokens: ParserTokens, k: int) -> _Fault:
    """The fault of a comma outside calls: a decimal comma, or one that separates values."""
    begin, hint = k, "decimals are written with a point, and one expression is one S"
    if tokens.are(k - 1, "NUMBER", "COMMA", "NUMBER") and tokens[k - 1].end + 1 == tokens[k + 1].start:
        begin, whole, digits = k - 1, tokens.pieces[k - 1], tokens.pieces[k + 1]
        grouped = f"; digits aren't grouped: {whole}{digits}" if len(digits) == 3 else ""
        hint = f"decimals are written with a point: {whole.replace('.', '')}.{digits}{grouped}"
    elif "EQUAL" in tokens.kinds[:k]:
        hint = "values, y(0) = 1, are for dsolve, which takes them after the equation"
    return "a comma doesn't belong here", begin, k, hint


def excerpt(value: Any, width: int = 40) -> str:
    """A text, number or expression on one line, without its middle if it is longer than `width`."""
    text = " ".join(plain_text(value).split())
    return text if len(text) <= width else f"{text[: width // 2]}...{text[-width // 4 :]}"

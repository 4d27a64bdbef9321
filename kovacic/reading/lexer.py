"""Text into numbers, names and signs, with their positions."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache, cached_property
from string import ascii_letters, digits

from kovacic.errors import InputError, LimitExceeded, ParseError
from kovacic.limits import Limits

# Superscript digits count as word characters for `re`; they must not become part of a name.
_SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
PRIMES = "'’′″"

_SIGNS = {
    "PLUS": ["+"],
    "MINUS": ["-", "−"],
    "STAR": ["*", "·", "×", "⋅", "∙"],
    "SLASH": ["/", "÷", "∕"],
    "CIRCUMFLEX": ["^", "**"],
    "LPAR": ["("],
    "RPAR": [")"],
    "COMMA": [","],
    "EQUAL": ["="],
}

#: The kinds of the signs and of the shortest numbers and names, which are most of a text.
_KINDS = {
    **{sign: kind for kind, signs in _SIGNS.items() for sign in signs},
    **dict.fromkeys(digits, "NUMBER"),
    **dict.fromkeys(ascii_letters, "NAME"),
}


@cache
def _terminals(ascii_only: bool) -> re.Pattern[str]:
    """The pattern of one terminal, or else of one character; for ASCII text a short one, which compiles fast."""
    beyond = "" if ascii_only else _SUPERSCRIPTS
    primes = "'" if ascii_only else f"[{PRIMES}]"
    superscript = "" if ascii_only else rf"[⁺⁻]?[{_SUPERSCRIPTS}]+ |"
    alphabet = re.ASCII if ascii_only else re.UNICODE
    return re.compile(
        rf"""
        (?: [0-9]+ (?:\.[0-9]*)? | \.[0-9]+ ) (?: [eE][+-]?[0-9]+(?!\w) )?
      | [^\W\d_{beyond}] [^\W{beyond}]* {primes}*
      | {superscript} \*\* | \S
        """,
        re.VERBOSE | alphabet,
    )


def _kind(piece: str) -> str:
    """The kind of a terminal that isn't in `_KINDS`; `OTHER` if it is none."""
    first = piece[0]
    last = piece[-1]
    if first in digits or (first == "." and last in digits):
        return "NUMBER"
    if last in _SUPERSCRIPTS:
        return "SUPERSCRIPT"
    if first.isalnum() and not first.isdecimal():
        return "PRIMED" if last in PRIMES else "NAME"
    return "OTHER"


_HINTS = {
    "[": "use round parentheses ( )",
    "]": "use round parentheses ( )",
    "{": "use round parentheses ( )",
    "}": "use round parentheses ( )",
    "!": "write factorials out as numbers",
    "\\": "this isn't LaTeX that is read; write for example (x^2 + 1)/(2*x)",
    "|": "write abs(...); on the right-hand side of an equation it is read",
    "√": "square roots aren't rational functions; write S with rational numbers",
    ";": "give one expression at a time; values are separated by commas: y'' + y = 0, y(0) = 1",
    "_": "names begin with a letter, and digits aren't grouped: write 1000000, x1",
    "'": "primes belong to the unknown function of an equation, as in y''",
    '"': "leave the quotation marks out",
    "%": "write percentages as fractions: 1/100",
    "∞": "infinity isn't a number here",
    "°": "angles are in radians: 90 degrees are pi/2",
    "$": "leave the $ out, or put the whole text between two of them",
    **dict.fromkeys(
        "<>≤≥≠", "an equation has the sign =; what is known about a parameter is given apart, as assumption"
    ),
}


#: Names of derivatives, and what an equation contains, and S alone doesn't.
DERIVATIVES = frozenset({"diff", "Diff", "Derivative", "D"})
_MARKS = ("=", *PRIMES, *(f"{name}(" for name in DERIVATIVES))


def is_equation(text: str) -> bool:
    """Does a text mean an equation rather than S alone: has it an equals sign, a prime or a derivative?"""
    return any(map(text.__contains__, _MARKS))


@dataclass(frozen=True)
class Tokens:
    """The terminals of a text: token k is `pieces[k]`, of the kind `kinds[k]`; the last one is `$END`, and empty."""

    text: str
    kinds: list[str]
    pieces: list[str]

    @cached_property
    def starts(self) -> list[int]:
        """Where the tokens begin in the text: found when somebody asks, as for an error."""
        matches = _terminals(self.text.isascii()).finditer(self.text)
        return [*(match.start() for match in matches), len(self.text)]

    @cached_property
    def ends(self) -> list[int]:
        """Where the tokens end in the text."""
        return [start + len(piece) for start, piece in zip(self.starts, self.pieces, strict=True)]

    def are(self, k: int, *kinds: str) -> bool:
        """Have the tokens from number k on these kinds?  Not where the text ends before."""
        return self.kinds[k : k + len(kinds)] == [*kinds]

    def piece(self, begin: int, end: int) -> str:
        """The text of the tokens begin, ..., end - 1."""
        return self.text[self.starts[begin] : self.ends[end - 1]] if end > begin else ""

    def span(self, begin: int, end: int) -> tuple[int, int]:
        """Position and length of the text of the tokens begin, ..., end - 1."""
        return self.starts[begin], self.ends[end - 1] - self.starts[begin]

    def error(
        self,
        kind: type[InputError],
        message: str,
        begin: int,
        end: int,
        *,
        hint: str | None = None,
        shell: str | None = None,
    ) -> InputError:
        """An error at the tokens begin, ..., end - 1."""
        position, length = self.span(begin, end)
        return kind(message, text=self.text, position=position, length=max(1, length), hint=hint, shell=shell)

    def names(self) -> dict[str, int]:
        """The different plain names in order of appearance, each with the number of its first token."""
        found: dict[str, int] = {}
        for k, kind in enumerate(self.kinds):
            if kind == "NAME":
                found.setdefault(self.pieces[k], k)
        return found


def check_length(text: str, limits: Limits, *, what: str) -> None:
    if len(text) > limits.text_length:
        said = f"{what} has {len(text)} characters, above the limit of {limits.text_length}"
        raise LimitExceeded(said, limit="text_length")


def tokens_of(text: str, limits: Limits, *, what: str, hint: str | None = None) -> Tokens:
    """The tokens of a text that isn't empty and not too long; `what` it is and the `hint` are for the message."""
    check_length(text, limits, what=what)
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise ParseError(f"there is no expression: {what} is empty", text=text, position=0, hint=hint)
    return tokens


def tokenize(text: str) -> Tokens:
    """The terminals of `text`; raises `ParseError` at a character that no terminal begins with."""
    ascii_only = text.isascii()
    pieces = _terminals(ascii_only).findall(text)
    kinds = [_KINDS.get(piece) or _kind(piece) for piece in pieces]
    for k, kind in enumerate(kinds):
        if kind == "LPAR" and k and kinds[k - 1] in ("NAME", "PRIMED"):
            kinds[k - 1] = "HEAD"
        elif kind == "NAME" and not ascii_only and not pieces[k].isidentifier():
            kinds[k] = "OTHER"
    tokens = Tokens(text, [*kinds, "$END"], [*pieces, ""])
    if "OTHER" in kinds:
        k = kinds.index("OTHER")
        raise _unexpected(text, tokens.starts[k], tokens.ends[k])
    return tokens


def _unexpected(text: str, start: int, end: int) -> ParseError:
    offending = text[start:end]
    position = next((start + k for k, char in enumerate(offending) if not offending[: k + 1].isidentifier()), start)
    char = text[position]
    shown = repr(char) if char.isprintable() else f"U+{ord(char):04X}"
    return ParseError(f"unexpected character {shown}", text=text, position=position, hint=_hint_for(char))


def _hint_for(char: str) -> str:
    if char in _HINTS:
        return _HINTS[char]
    if "₀" <= char <= "₉":
        return "write indices as ordinary digits: x1"
    if char.isnumeric():
        return "write numbers with the digits 0 to 9: 1/2"
    return "there are numbers, names, + - * / ^ ( ) = and y''"

"""Text into one stream of tokens: signs, numbers and words as anybody types them, each with its place in the text.

`scanned` is the only reader of characters.  It knows alphabets and typography (dashes, curved primes, x in italics, dots above
letters, raised and lowered characters), and no notation: that is `notations` and `dialects`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from itertools import groupby
from typing import NamedTuple

from kovacic.errors import ParseError

PRIME = "'"
#: Derivatives by the time: ẋ.
DOTS = "˙"
#: Names of derivatives.
DERIVATIVES = frozenset({"diff", "Diff", "Derivative", "D"})

_SUPERSCRIPTS = "⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹"
#: Raised characters, and the same on the line.
SUPERSCRIPT_DIGITS = str.maketrans(_SUPERSCRIPTS, "+-0123456789")
_LOWERED = "₀₁₂₃₄₅₆₇₈₉"
_FRACTIONS = "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
#: Names of functions, on which dots are derivatives; other letters with dots belong to an alphabet.
_DOTTED = frozenset("xyzuvwqrsθφψ")
_DOTS = {"\u0307": DOTS, "\u0308": 2 * DOTS}
#: Replacements of characters.
_CHARACTERS = {
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015−", "-"),
    **dict.fromkeys("´‘’′ʹʼ", "'"),
    **dict.fromkeys("“”„″ʺˮ", '"'),
    **dict.fromkeys("\u00ad\u200b\u200c\u200d\u2060\u2061\u2062\u2063\ufeff", ""),
    **dict.fromkeys("·×⋅∙•∗", "*"),
    **dict.fromkeys("÷∕\u2044", "/"),
    "‴": "'" * 3,
    "∂": "d",
    "\u00a0": " ",
    "∞": "oo",
    "≤": "<=",
    "≥": ">=",
    "ϕ": "φ",
    **_DOTS,
}

_NO_LETTERS = f"Α-Ωα-ωħ{_SUPERSCRIPTS}{_LOWERED}{_FRACTIONS}"
_TOKEN = re.compile(
    rf"""
    (?P<NUMBER> (?: [0-9]+ (?:\.[0-9]*)? | \.[0-9]+ ) (?: [eE][+-]?[0-9]+(?!\w) )? )
  | (?P<CHARACTER> \\\[[A-Z][a-z]+\][0-9]* )
  | (?P<COMMAND> \\[A-Za-z]+ | \\. )
  | (?P<WORD> [Α-Ωα-ωħ] (?: _[A-Za-z0-9]+ | [0-9]+ )? | [^\W\d_{_NO_LETTERS}] [^\W{_NO_LETTERS}]* )
  | (?P<PRIMES> ['"`˙]+ )
  | (?P<SUPERSCRIPT> [⁺⁻]? [⁰¹²³⁴⁵⁶⁷⁸⁹]+ )
  | (?P<NEWLINE> \n )
  | (?P<SIGN> \*\* | := | == | @@ | <= | >= | \.[*/^] | \S )
    """,
    re.VERBOSE | re.DOTALL,
)


class Token(NamedTuple):
    """A token and its place: `kind` is NUMBER, COMMAND (of LaTeX), WORD, PRIMES, SUPERSCRIPT, NEWLINE or SIGN."""

    kind: str
    text: str
    start: int
    end: int


def scanned(text: str) -> list[Token]:
    """The tokens of a text.

    >>> [token.text for token in scanned("ẍ + ½x² = 3e-1")]
    ['x', '˙˙', '+', '(', '1', '/', '2', ')', 'x', '²', '=', '3e-1']
    """
    plain, origins = text, [*range(len(text))]
    if not text.isascii():
        pieces: list[str] = []
        for is_raised, run in groupby(range(len(text)), key=lambda k: _kind_of(text[k]) == "<super"):
            places = [*run]
            word = "".join(text[k] for k in places)
            if is_raised and any(character not in _SUPERSCRIPTS for character in word):  # e²ˣ
                plain = unicodedata.normalize("NFKC", word).replace("−", "-")
                pieces += [f"^({plain}", *[""] * (len(word) - 1)]
                pieces[-1] += ")"  # so that the last token ends where the word does
            else:
                pieces += list(word) if is_raised else [_ordinary(text, k) for k in places]
        plain = "".join(pieces)
        origins = [k for k, piece in enumerate(pieces) for _ in piece]
    tokens: list[Token] = []
    for found in _TOKEN.finditer(plain):
        kind, word = str(found.lastgroup), found[0]
        if kind == "CHARACTER":  # Mathematica's \[Alpha]1
            kind, word = "WORD", word[2:].replace("]", "").lower()
        tokens.append(Token(kind, word, origins[found.start()], origins[found.end() - 1] + 1))
    return tokens


def _ordinary(text: str, k: int) -> str:
    character = text[k]
    before = text[k - 1 : k]
    if character == "∞" and before.isalpha():  # T∞ is T_∞
        return "_oo"
    if character in _CHARACTERS:
        return _CHARACTERS[character]
    if character in _FRACTIONS:
        is_mixed = before.isdecimal()
        return character if is_mixed else f"({unicodedata.normalize('NFKC', character)})".replace("\u2044", "/")
    kind = _kind_of(character)
    plain = unicodedata.normalize("NFKC", character)
    if kind == "<sub" and character.isnumeric() and not (before.isalpha() or before in _LOWERED):
        return character
    if kind == "<sub":  # the index ends with the last lowered character: ω₀x is ω_0 x
        plain = plain if before and _kind_of(before) == "<sub" else f"_{plain}"
        return plain if _kind_of(text[k + 1 : k + 2]) == "<sub" else f"{plain} "
    letter, *dots = list(unicodedata.normalize("NFD", character))
    if letter in _DOTTED and "".join(dots) in _DOTS:
        return letter + _DOTS["".join(dots)]
    return plain if kind == "<font" else character


def _kind_of(character: str) -> str:
    """ "<super", "<sub", "<font" or the like for a character that is another one in another style."""
    return unicodedata.decomposition(character).partition(">")[0] if character else ""


_CHARACTER_HINTS = {
    "!": "write factorials out as numbers",
    "|": "a bar is missing; write abs(...)",
    "√": "write sqrt(...)",
    ";": "give one expression at a time",
    "_": "names begin with a letter, and digits aren't grouped: write 1000000, x1",
    "'": "primes belong to the unknown function of an equation, as in y''",
    '"': "primes belong to the unknown function of an equation, as in y''",
    "%": "write percentages as fractions, 1/100; a comment stands behind a space: % like this",
    "#": "a comment stands behind a space: # like this",
    "?": "leave out all but the equation",
    "°": "angles are in radians: 90 degrees are pi/2",
    "$": "leave the $ out, or put the whole text between two of them",
    ".": "decimals are written 1.5; a derivative is y.diff(x, 2), or y''",
    ":": "leave the colon out",
    **dict.fromkeys("<>≤≥≠", "an equation has the sign =; facts about a parameter are given apart, as assumptions"),
}


def error_at(text: str, message: str, scan: Sequence[Token], hint: str | None = None) -> ParseError:
    """An error that marks these tokens of a text, or all of it without tokens."""
    start, end = (scan[0].start, scan[-1].end) if scan else (0, len(text))
    return ParseError(message, text=text, position=start, length=max(1, end - start), hint=hint)


def unexpected(text: str, token: Token) -> ParseError:
    char = text[token.start] if token.start < len(text) else token.text[0]
    shown = repr(char) if char.isprintable() else f"U+{ord(char):04X}"
    hint = _CHARACTER_HINTS.get(token.text[0])
    if char in _LOWERED:
        hint = "write indices as ordinary digits: x1"
    elif char.isnumeric():
        hint = "write numbers with the digits 0 to 9: 1/2"
    hint = hint or "there are numbers, names, + - * / ^ ( ) = and y''"
    return error_at(text, f"unexpected character {shown}", [token._replace(end=token.start + 1)], hint)

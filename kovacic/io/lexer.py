"""Text into the terminals of `grammar.lark`, with their positions."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

from kovacic.errors import ParseError

# Superscript digits count as word characters for `re`; they must not become part of a name.
_SUPERSCRIPT = "²³¹⁰⁴-⁹"


@cache
def _terminals(ascii_only: bool) -> re.Pattern[str]:
    """The pattern of all terminals; for ASCII text a short one, which compiles in a tenth of the time."""
    beyond = "" if ascii_only else _SUPERSCRIPT
    name = rf"[^\W\d_{beyond}][^\W{beyond}]*"
    prime = "'" if ascii_only else "['’′″]"
    superscript = "" if ascii_only else rf"| (?P<SUPERSCRIPT>[⁺⁻]?[{_SUPERSCRIPT}]+)"
    return re.compile(
        rf"""
        (?P<SPACE>\s+)
      | (?P<NUMBER>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+(?!\w))?)
      | (?P<HEAD>{name}{prime}*(?=\s*\())
      | (?P<PRIMED>{name}{prime}+)
      | (?P<NAME>{name})
      | (?P<CIRCUMFLEX>\^|\*\*)
      | (?P<STAR>{"[*]" if ascii_only else "[*·×⋅∙]"})
      | (?P<SLASH>{"/" if ascii_only else "[/÷∕]"})
      | (?P<PLUS>\+)
      | (?P<MINUS>{"-" if ascii_only else "[-−]"})
      | (?P<LPAR>\()
      | (?P<RPAR>\))
      | (?P<COMMA>,)
      | (?P<EQUAL>=)
      {superscript}
      | (?P<OTHER>.)
        """,
        re.VERBOSE | re.DOTALL | (re.ASCII if ascii_only else re.UNICODE),
    )


_HINTS = {
    "[": "use round parentheses ( )",
    "]": "use round parentheses ( )",
    "{": "use round parentheses ( )",
    "}": "use round parentheses ( )",
    "!": "write factorials out as numbers",
    "\\": "LaTeX isn't read; write for example (x^2 + 1)/(2*x)",
    "|": "absolute values aren't rational functions",
    "√": "square roots aren't rational functions; write S with rational numbers",
    ";": "give one expression at a time",
    "_": "names begin with a letter, and digits aren't grouped: write 1000000, x1",
    "'": "primes belong to the unknown function of an equation, as in y''",
    '"': "leave the quotation marks out",
    "%": "write percentages as fractions: 1/100",
    "∞": "infinity isn't a number here",
}


@dataclass(frozen=True, slots=True)
class Tokens:
    """The terminals of a text: token k is `text[starts[k]:ends[k]]`, of the kind `kinds[k]`; the last one is `$END`."""

    text: str
    kinds: list[str]
    starts: list[int]
    ends: list[int]

    def piece(self, begin: int, end: int) -> str:
        """The text of the tokens begin, ..., end - 1."""
        return self.text[self.starts[begin] : self.ends[end - 1]] if end > begin else ""

    def names(self) -> dict[str, int]:
        """The different plain names in order of appearance, each with the number of its first token."""
        found: dict[str, int] = {}
        for k, kind in enumerate(self.kinds):
            if kind == "NAME":
                found.setdefault(self.text[self.starts[k] : self.ends[k]], k)
        return found


def tokenize(text: str) -> Tokens:
    """The terminals of `text`; raises `ParseError` at a character that no terminal begins with."""
    kinds: list[str] = []
    starts: list[int] = []
    ends: list[int] = []
    ascii_only = text.isascii()
    for match in _terminals(ascii_only).finditer(text):
        kind = match.lastgroup
        assert kind is not None
        if kind == "SPACE":
            continue
        start, end = match.span()
        if kind == "OTHER" or (not ascii_only and kind == "NAME" and not text[start:end].isidentifier()):
            raise _unexpected(text, start, end)
        kinds.append(kind)
        starts.append(start)
        ends.append(end)
    kinds.append("$END")
    starts.append(len(text))
    ends.append(len(text))
    return Tokens(text, kinds, starts, ends)


def _unexpected(text: str, start: int, end: int) -> ParseError:
    offending = text[start:end]
    position = next((start + k for k, char in enumerate(offending) if not offending[: k + 1].isidentifier()), start)
    char = text[position]
    shown = repr(char) if char.isprintable() else f"U+{ord(char):04X}"
    hint = _HINTS.get(char)
    if hint is None and ("₀" <= char <= "₉"):
        hint = "write indices as ordinary digits: x1"
    elif hint is None and char.isnumeric():
        hint = "write numbers with the digits 0 to 9: 1/2"
    return ParseError(f"unexpected character {shown}", text=text, position=position, hint=hint)

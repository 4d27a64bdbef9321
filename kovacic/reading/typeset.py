"""Signs and forms as word processors, pages and people write them: dashes, curved quotation marks, |x|, sin x, sin^2(x), √x.

>>> ordinary_signs("y” – ½ x y = 0"), with_calls("|x - 1| + sin 2x + cos^2(x)")
("y'' - (1/2) x y = 0", ' abs(x - 1) + sin(2x) + cos(x)^2')

Linear time; what can be read in two ways stays as it is, and the parser asks.
"""

from __future__ import annotations

import re
import unicodedata

#: Fractions that are one character.
_FRACTIONS = "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"
_FRACTION_SLASH = "\u2044"
_SIGNS = {
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015", "-"),
    **dict.fromkeys("´`‘", "'"),
    **dict.fromkeys("“”„", "''"),
    **dict.fromkeys("\u00ad\u200b\u200c\u200d\u2060\u2061\u2062\u2063\ufeff", ""),
    "\u00a0": " ",
    "‴": "'" * 3,
    "∂": "d",
    _FRACTION_SLASH: "/",
}
_UNUSUAL = re.compile(f"[{''.join(_SIGNS)}\U0001d400-\U0001d7ff]|(?<![0-9])[{_FRACTIONS}]")


def ordinary_signs(text: str) -> str:
    """With ordinary signs and letters; the fraction in 3½ stays, for it is no factor."""
    return _UNUSUAL.sub(lambda found: _ordinary(found[0]), text)


def _ordinary(character: str) -> str:
    known = _SIGNS.get(character)
    if known is not None:
        return known
    plain = unicodedata.normalize("NFKC", character)  # of letters in italics, and of fractions
    return f"({plain.replace(_FRACTION_SLASH, '/')})" if character in _FRACTIONS else plain


def with_calls(text: str) -> str:
    """With the parentheses of functions: abs(x) for |x|, sin(2x) for sin 2x, sin(x)^2 for sin^2(x)."""
    if "|" in text:
        text = _without_bars(text)
    text = _ROOT_OF_FACTOR.sub(r"sqrt(\1)", text)
    text = _ROOT_OF_PARENTHESIS.sub("sqrt", text)
    text = _BEFORE_ONE_FACTOR.sub(lambda found: f"{found[1]}({found[3].strip()}){_power(found[2])}", text)
    return _powers_behind(text) if _BEFORE_PARENTHESIS.search(text) else text


def _without_bars(text: str) -> str:
    """|...| as abs(...); a bar is closed by the next one within the same parentheses."""
    if text.count("|") % 2:
        return text
    pieces: list[str] = []
    is_open = [False]  # of the text, and of each parenthesis that is open: has a bar been opened in it?
    for character in text:
        if character == "(":
            is_open.append(False)
        elif character == ")" and len(is_open) > 1:
            is_open.pop()
        if character != "|":
            pieces.append(character)
            continue
        bar = ")" if is_open[-1] else " abs("
        pieces.append(bar)
        is_open[-1] = not is_open[-1]
    return "".join(pieces)


#: The functions whose parentheses may be left out.
BARE = "sinh|cosh|tanh|coth|sech|csch|sin|cos|tan|cot|sec|csc|arcsin|arccos|arctan|exp|log|ln"
_FUNCTION = rf"(?<![^\W\d])({BARE})"
_POWER = r"(\s*\^\s*[2-9]|\s*²)"
#: A number, a letter, or both, and then no further factor, power or divisor.
_FACTOR = r"(\s\s*\d*\s*[^\W\d_](?!\w)|(?<=²)\s*\d*\s*[^\W\d_](?!\w))"
_BEFORE_ONE_FACTOR = re.compile(rf"{_FUNCTION}{_POWER}?{_FACTOR}(?=\s*(?:$|[-+=,;)]))")
#: √x and √2, where no factor follows; √(...).
_ROOT_OF_FACTOR = re.compile(r"√\s*([0-9]+|[^\W\d_])(?![\w^²³(])")
_ROOT_OF_PARENTHESIS = re.compile(r"√\s*(?=\()")
_BEFORE_PARENTHESIS = re.compile(rf"{_FUNCTION}{_POWER}\s*(?=\()")


def _power(written: str | None) -> str:
    return "" if written is None else written.strip().replace(" ", "")


def _powers_behind(text: str) -> str:
    """sin(x)^2 for sin^2(x): the powers stand where the parentheses behind them are closed."""
    pieces: list[str] = []
    behind: list[str] = []  # of each parenthesis that is open
    k = 0
    starts = {found.start(): found for found in _BEFORE_PARENTHESIS.finditer(text)}
    while k < len(text):
        found = starts.get(k)
        if found is not None:
            pieces.append(f"{found[1]}(")
            behind.append(_power(found[2]))
            k = found.end() + 1
            continue
        pieces.append(text[k])
        if text[k] == "(":
            behind.append("")
        elif text[k] == ")" and behind:
            pieces.append(behind.pop())
        k += 1
    return "".join(pieces)

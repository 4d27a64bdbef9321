"""What people paste, as this package writes it: Leibniz' derivatives, LaTeX, Mathematica, Maple, MATLAB, Maxima, SymPy's repr.

Only the notation of derivatives, calls, grouping and signs is rewritten, from left to right and in linear time; what the
result means, and whether it is an equation at all, is found by the parser, in whose errors the rewritten text stands.

>>> plain("\\\\frac{d^2y}{dx^2} = x^{2} y").text
'diff(y, x, 2)  = x ^( 2 ) y'
>>> plain("y''[x] == x y[x]").text, plain("diff(y(x),x$2) + y(x) = 0;").text
("y''(x) = x y(x)", 'diff(y(x),x, 2) + y(x) = 0')
>>> plain("D2y + 4*y = 0").text, plain("D2y + 4*y = 0").variable
("y'' + 4*y = 0", 't')
"""

from __future__ import annotations

import re
import unicodedata
from typing import NamedTuple

from kovacic.reading.latex import without_latex
from kovacic.reading.names import LETTER
from kovacic.reading.typeset import BARE, ordinary_signs, with_calls


class Plain(NamedTuple):
    """The text in this package's notation, and the variable that the notation stands for where none is named."""

    text: str
    variable: str | None = None


def plain(text: str) -> Plain:
    """The text rewritten, or itself if there is nothing to rewrite.

    Raises `ParseError` for commands of LaTeX that have no meaning here, and for braces that don't match.
    """
    if not _FOREIGN.search(text):
        return Plain(text)
    found = ordinary_signs(_DOLLAR.sub(r"\1$\2", text))
    dotted = _DOTS.search(found) is not None or "\\dot" in found or "\\ddot" in found
    latex = "\\" in found or "^{" in found or "_{" in found
    if latex and not _MATHEMATICA.search(found):
        found = without_latex(found, text)
    found = _unicode(found)
    if _MATHEMATICA.search(found):
        found = _mathematica(found)
    found = with_calls(found.translate(_BRACKETS))
    found = _python(found)
    found = _maple(found)
    found = _leibniz(found)
    found = _indexed(found)
    found = _primed_parentheses(found)
    found, by_time = _matlab(found)
    variable = "t" if dotted or by_time else None
    return Plain(found.replace("==", "="), variable)


#: Maple's diff(y(x), `$`(x, 2)).
_DOLLAR = re.compile(r"[`']\$[`']\(\s*(\w+)\s*,\s*(\d+)\s*\)")
#: Something of these occurs in every text that is rewritten.
_FOREIGN = re.compile(
    r'\\|\[|\||[\^_]\{|==|\$|@@|["`´\xa0\xad]|;\s*$|%[eip]|/\s*\(?\s*d|\bD|\bEq|\.diff|\bFunction\(|\bPi\b|[₀-₉]'
    r"|[^\x00-\xac\xae-\xb3\xb5-\xbb\xbf-\xfe\u0100-\u02ff]|diff\(|Rational\(|\w_[a-z]{2}\b|\)'"
    rf"|(?:{BARE})[ ^²]"
)
_DOTS = re.compile("[\u00ff\u1e8d\u1e8b\u1e8f]|[\u0307\u0308]")
_MATHEMATICA = re.compile(r"(?<![\\\w])\w+'*\[")
_BRACKETS = str.maketrans("[]", "()")
_SQUARED = r"\s*(?:\^\s*\(?\s*2\s*\)?|\*\*\s*2|²|2)"


def _unicode(text: str) -> str:
    """Dots above a letter are derivatives, a double quotation mark after one is two primes, lowered digits an index."""
    text = re.sub(r'(?<=\w)"', "''", text)
    if text.isascii():
        return text
    text = _INDEX.sub(lambda found: "_" + unicodedata.normalize("NFKC", found[0]), text)
    text = "".join(map(_with_primes, text))
    # A small Greek letter is a name of its own: two of them, or one and a Latin letter beside it, are factors.
    return re.sub(r"(?<=[α-ω])(?=[A-Za-zα-ω])|(?<=[A-Za-z])(?=[α-ω])", " ", text)


def _with_primes(character: str) -> str:
    """A letter with a prime for each dot above it, dots that follow their letter as primes; others as they are."""
    decomposed = unicodedata.normalize("NFD", character)
    letter = decomposed[0]
    dots = decomposed[1:]
    if letter in _DOTTED and dots in _DOT_PRIMES:
        return letter + _DOT_PRIMES[dots]
    return _DOT_PRIMES.get(character, character)


#: All lowered digits behind a letter are one index; behind a number they are none.
_INDEX = re.compile(r"(?<=[^\W\d_])[₀-₉]+")
#: Letters that functions have; others with dots are letters of an alphabet.
_DOTTED = frozenset("xyzuvwqrsθφψ")
_DOT_PRIMES = {"\u0307": "'", "\u0308": "''"}

#: Functions that have one name in every notation.
_COMMON = ("sin", "cos", "tan", "cot", "sinh", "cosh", "tanh", "coth", "exp", "log")
_MATHEMATICA_NAMES = {
    "ArcSin": "asin",
    "ArcCos": "acos",
    "ArcTan": "atan",
    "Pi": "pi",
    "D": "diff",
    "Abs": "abs",
    "Sign": "sign",
    "UnitStep": "heaviside",
    "HeavisideTheta": "heaviside",
    "DiracDelta": "dirac",
    **{name.capitalize(): name for name in (*_COMMON, "sec", "csc", "sech", "csch", "sqrt", "erf")},
}


#: Its full form of y''[x].
_DERIVATIVE = re.compile(r"\bDerivative\[(\d+)\]\[(\w+)\]\[(\w+)\]")


def _mathematica(text: str) -> str:
    """Sin[x], y''[x], D[y[x], {x, 2}], \\[Alpha], E^x, ==."""
    text = re.sub(r"\\\[(\w+)\](?=(\d)?)", _greek_letter, text)
    text = _DERIVATIVE.sub(r"D[\2[\3], {\3, \1}]", text)
    text = re.sub(r"\b[A-Z]\w*(?=\[)|\bPi\b", lambda found: _MATHEMATICA_NAMES.get(found[0], found[0]), text)
    text = re.sub(r"\bE(?=\s*\^)", "e", text)
    return text.translate(str.maketrans("[]{}", "()()")).replace("==", "=")


def _greek_letter(found: re.Match[str]) -> str:
    """alpha for \\[Alpha]; a digit behind it belongs to the name."""
    name = found[1].lower()
    return name if found[2] else f"{name} "


def _python(text: str) -> str:
    """SymPy's repr and methods: Eq(a, b), y(x).diff(x, 2), Function('y'), Rational(1, 2)."""
    text = re.sub(r"\b(?:sympy|sp)\.", "", text)
    text = re.sub(r"\bEquality\(", "Eq(", text)
    text = re.sub(r"\b(?:Function|Symbol)\(\s*['\"](\w+)['\"]\s*\)", r"\1", text)
    text = re.sub(r"\bRational\(\s*(-?\d+)\s*,\s*(\d+)\s*\)", r"(\1/\2)", text)
    text = re.sub(r"\bIntegral?\b(?=\()", "Integer", text)
    text = re.sub(r"\bInteger\(\s*(-?\d+)\s*\)", r"(\1)", text)
    method = re.compile(r"((?<!\w)\w+\(\w+\)|\b[^\W\d]|diff\([^()]*\([^()]*\)[^()]*\))\.diff\(([^()]*)\)")
    for _ in range(_DERIVATIVES_IN_A_ROW):
        text, count = method.subn(r"diff(\1, \2)", text)
        if not count:
            break
    stripped = text.strip()
    if stripped.startswith("Eq(") and _closing(stripped).get(2) == len(stripped) - 1:
        inside = stripped[3:-1]
        comma = _outer_comma(inside)
        if comma is not None:
            return f"{inside[:comma]} = {inside[comma + 1 :].strip()}"
    return text


#: y(x).diff(x).diff(x): so many methods in a row are read.
_DERIVATIVES_IN_A_ROW = 4


def _closing(text: str) -> dict[int, int]:
    """Where each parenthesis is closed, by the place where it is opened."""
    found: dict[int, int] = {}
    opened: list[int] = []
    for k, character in enumerate(text):
        if character == "(":
            opened.append(k)
        elif character == ")" and opened:
            found[opened.pop()] = k
    return found


def _outer_comma(text: str) -> int | None:
    """The first comma outside all parentheses."""
    depth = 0
    for k, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            return k
    return None


def _maple(text: str) -> str:
    """Maple's x$2, (D@@2)(y)(x), D(y)(x); Maxima's 'diff(y, x, 2), %e, %i, %pi; a semicolon or $ at the end of both."""
    if text.rstrip().endswith((";", "$")):
        text = text.rstrip()[:-1]
    text = re.sub(r"(?<!\w)(\w+)\s*\$\s*(\d+)", r"\1, \2", text)
    text = re.sub(rf"\(\s*D\s*@@\s*(\d+)\s*\)\s*\(({LETTER})\)\s*\((\w+)\)", r"diff(\2(\3), \3, \1)", text)
    text = re.sub(rf"\bD\(\s*D\(({LETTER})\)\s*\)\s*\((\w+)\)", r"diff(\1(\2), \2, 2)", text)
    text = re.sub(rf"\bD\(({LETTER})\)\s*\((\w+)\)", r"diff(\1(\2), \2)", text)
    text = re.sub(r"(?<!\w)'(?=diff\()", "", text)
    text = re.sub(r"\bPi\b", "pi", text)
    text = re.sub(r"%i\b", "I", text)
    return re.sub(r"%(e|pi)\b", r"\1", text)


_D = r"(?<![\w.])d"
_SECOND = re.compile(
    rf"{_D}{_SQUARED}\s*({LETTER})(?:\(\s*(?:{LETTER})\s*\))?\s*/\s*\(?d\s*({LETTER})\s*\)?{_SQUARED}(?!\w)"
)
_SECOND_APPLIED = re.compile(
    rf"\(?{_D}{_SQUARED}\s*/\s*\(?d\s*({LETTER})\s*\)?{_SQUARED}\)?\s*\*?\s*({LETTER})(?!\w)(?:\(\s*{LETTER}\s*\))?"
)
_FIRST = re.compile(rf"{_D}\s?({LETTER})(?:\(\s*(?:{LETTER})\s*\))?\s*/\s*d\s?({LETTER})(?![\w^²*])")
_FIRST_APPLIED = re.compile(rf"{_D}\s*/\s*d\s?({LETTER})\s*\*?\s*(?=\()")


#: (d^2y)/(dx^2), as pages show a fraction that is copied.
_IN_PARENTHESES = re.compile(
    rf"\(\s*(d(?:{_SQUARED})?\s*{LETTER}(?:\(\w\))?)\s*\)\s*/\s*\(\s*(d\s*{LETTER}(?:{_SQUARED})?)\s*\)"
)


def _leibniz(text: str) -> str:
    """d^2y/dx^2, d²y/dx², d2y/dx2, (d^2y)/(dx^2), (d^2/dx^2) y, dy/dx, d/dx(...)."""
    text = _IN_PARENTHESES.sub(r"\1/\2", text)
    text = _SECOND.sub(r"diff(\1, \2, 2)", text)
    text = _SECOND_APPLIED.sub(r"diff(\2, \1, 2)", text)
    text = _FIRST.sub(r"diff(\1, \2)", text)
    return _applied(text)


def _applied(text: str) -> str:
    """d/dx(...) from the left; one that stands within another is reached when that has been rewritten."""
    if not _FIRST_APPLIED.search(text):
        return text
    pieces: list[str] = []
    #: Where the parentheses of the operators end that are being rewritten, and what stands there then.
    closing: list[tuple[int, str]] = []
    k = 0
    closed = _closing(text)
    matches = {found.start(): found for found in _FIRST_APPLIED.finditer(text)}
    while k < len(text):
        found = matches.get(k)
        if found is not None:
            end = closed.get(found.end())
            if end is None:
                break
            closing.append((end, f", {found[1]})"))
            pieces.append("diff(")
            k = found.end() + 1
        elif closing and closing[-1][0] == k:
            pieces.append(closing.pop()[1])
            k += 1
        else:
            pieces.append(text[k])
            k += 1
    return "".join(pieces) + text[k:]


def _indexed(text: str) -> str:
    """y_xx and y_x: derivatives as indices, where one is of second order and no derivative is written otherwise."""
    second = re.search(r"\b([a-zA-Z])_([xtzsr])\2\b", text)
    if second is None or "'" in text or "diff(" in text:
        return text
    y = second[1]
    x = second[2]
    text = re.sub(rf"\b{y}_{x}{x}\b", f"diff({y}, {x}, 2)", text)
    return re.sub(rf"\b{y}_{x}\b", f"diff({y}, {x})", text)


def _primed_parentheses(text: str) -> str:
    """diff((1 - x^2) y') for ((1 - x^2) y')'."""
    if not re.search(r"\)'", text):
        return text
    pieces = list(text)
    for start, end in _closing(text).items():
        is_primed_once = text[end + 1 : end + 2] == "'" and text[end + 2 : end + 3] != "'"
        is_call = text[start - 1 : start].isalnum()
        if is_primed_once and not is_call:
            pieces[start] = "diff("
            pieces[end + 1] = ""
    return "".join(pieces)


def _matlab(text: str) -> tuple[str, bool]:
    """D2y and Dy, in which t is the variable, and diff(y, 2)."""
    text = re.sub(rf"\bdiff\(\s*({LETTER})(\(\w+\))?\s*,\s*([1-4])\s*\)", _primed, text)
    second = re.search(r"\bD2([A-Za-z])\b", text)
    if second is None:
        return text, False
    y = second[1]
    text = re.sub(rf"\bD([2-4]?){y}\b", lambda found: y + "'" * int(found[1] or 1), text)
    named = re.search(r"\bx\b", text) is not None and y != "x"
    return text, not named


def _primed(found: re.Match[str]) -> str:
    return found[1] + "'" * int(found[3]) + (found[2] or "")

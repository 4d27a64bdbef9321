"""Notations of other systems and of books, as a table: a few tokens of theirs, and the same in tokens of this package.

>>> [token.text for token in rewritten(scanned("(D@@2)(y)(x) + Sin[x] = 0"), NOTATIONS)]
['y', "''", '(', 'x', ')', '+', 'sin', '[', 'x', ']', '=', '0']
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache
from typing import NamedTuple

from kovacic.reading.lexer import DERIVATIVES, DOTS, PRIMES, Token, scanned
from kovacic.reading.names import BARE, FUNCTION_NAMES, GREEK, LETTER

Match = re.Match[str]

#: Commands that solve an equation, in other systems.
SOLVERS = frozenset("DSolve NDSolve DSolveValue NDSolveValue dsolve desolve ode2 rhs kovacicsols".split())  # noqa: SIM905
_KNOWN = {*FUNCTION_NAMES, *GREEK, *DERIVATIVES, *SOLVERS, "Eq", "Equality", "hbar", "ell", "eps", "lam"}
_KNOWN |= {"sqrt", "cbrt", "root", "Piecewise", "SingularityFunction", "max", "min", "Max", "Min"}
#: What patterns are written with: one space glues tokens together or not, ~ glues them, and · is a gap between them.
_SIGNS = {
    "OPEN": r"[(\[{]",
    "CLOSE": r"[)\]}]",
    "LETTER": LETTER,
    "WORD": rf"(?!(?:{'|'.join(sorted(_KNOWN, key=len, reverse=True))})(?!\S))[^\W\d_]{{3,}}",
    " ": " +",
    "~": " (?! )",
    "·": "  +",
}
_SIGN = re.compile("|".join(_SIGNS))


def pattern(text: str) -> re.Pattern[str]:
    """A pattern of whole tokens, in the signs above."""
    return re.compile(rf"(?s)(?<!\S)(?:{_SIGN.sub(lambda sign: _SIGNS[sign[0]], text)})(?!\S)")


class Spaced:
    """Tokens as one text for such patterns: a space behind each of them, two where a gap follows."""

    def __init__(self, scan: Sequence[Token]) -> None:
        self.scan = scan
        starts = [token.start for token in scan[1:]]
        parts = [f"{t.text}  " if t.end < start else f"{t.text} " for t, start in zip(scan, starts, strict=False)]
        self.parts = [*parts, scan[-1].text] if scan else []
        self.text = "".join(self.parts)

    @cached_property
    def starts(self) -> list[int]:
        found = [0]
        for part in self.parts:
            found.append(found[-1] + len(part))
        return found

    def number(self, offset: int) -> int:
        """The number of the token that begins with a character, or behind it."""
        return bisect_left(self.starts, offset)


class Rewrite(NamedTuple):
    """A notation: where its `pattern` occurs, tokens are replaced by the `result`."""

    notation: str
    pattern: re.Pattern[str]
    result: str | Callable[[Match], str] = ""
    #: What the words of the first group become, which stay where they are.
    kind: str = ""

    def applied(self, spaced: Spaced) -> list[Token]:
        found: list[Token] = []
        done = 0
        for match in self.pattern.finditer(spaced.text):
            first, behind = spaced.number(match.start()), spaced.number(match.end())
            found += spaced.scan[done:first]
            done = behind
            if self.kind:
                group = spaced.scan[spaced.number(match.start(1)) : spaced.number(match.end(1))]
                found += [token._replace(kind=self.kind) if token.kind == "WORD" else token for token in group]
                continue
            result = match.expand(self.result) if isinstance(self.result, str) else self.result(match)
            place = spaced.scan[first].start, spaced.scan[behind - 1].end
            kinds = {text: "NEWLINE" if text == "\n" else scanned(text)[0].kind for text in result.split(" ") if text}
            found += [Token(kinds[text], text, *place) for text in result.split(" ") if text]
        return [*found, *spaced.scan[done:]]


#: Numbers, letters but D and E, and signs of arithmetic that are no comment: no rule is about these alone.
_PLAIN = re.compile(
    r"(?!.*\^ +\(.*')(?:(?:\d+|[a-zA-CF-Z]|[+)=]|-(?! +-)|\*\*?|\((?! +\*)|/(?! +[/*])|\^(?! +')|''?)(?: +|$))*"
)


def rewritten(scan: Sequence[Token], rules: Sequence[Rewrite]) -> list[Token]:
    """The tokens after all rules, in their order."""
    spaced = Spaced(scan)
    if _PLAIN.fullmatch(spaced.text):  # as most texts are: some fifty searches are saved
        return list(scan)
    for rule in rules:
        if rule.pattern.search(spaced.text):
            spaced = Spaced(rule.applied(spaced))
    return list(spaced.scan)


def primes_of(marks: str) -> str:
    """A prime for each of the marks; a quotation mark is two."""
    return PRIMES * len(marks.replace('"', "''").replace(" ", ""))


@lru_cache(maxsize=8)
def _occurs(pattern: str, text: str) -> Match | None:
    """The first occurrence in a whole text, which is the same for all matches of a rule."""
    return re.search(pattern, text, re.DOTALL)


def _derivative(match: Match) -> str:
    """y'' for an order n, one if none is said."""
    return f"{match['y']} {PRIMES * int(match['n'] or 1)}"


def _by_time(match: Match) -> str:
    """MATLAB's D2y: by time, unless x occurs."""
    is_by_x = match["y"] != "x" and _occurs(r"(?<!\S)x(?!\S)", match.string)
    return f"{match['y']} {(PRIMES if is_by_x else DOTS) * int(match['n'] or 1)}"


def _by_index(match: Match) -> str:
    """diff(y, x, 2) for y_xx, and diff(y, x) for y_x beside it, where no derivative is written otherwise."""
    second = _occurs(r"(?<!\S)([a-zA-Z])_([xtzsr])\2(?!\S)", match.string)
    is_other = second is None or (match["y"], match["x"]) != second.groups()
    if is_other or _occurs(r"\w +['˙]|(?<!\S)(?:diff|D|Derivative)(?!\S)", match.string):
        return match[0]
    return f"diff ( {match['y']} , {match['x']} , {2 if match['second'] else 1} )"


def _exponential(match: Match) -> str:
    """E of Mathematica, whose notation it is where functions have brackets."""
    return "e ^" if _occurs(r"(?:\w|') \[ +[a-z] +\]|[A-Z][a-z]+ \[", match.string) else match[0]


#: What names of Mathematica's, Maple's and SymPy's are.
_SYNONYMS = {
    "ArcSin": "asin",
    "ArcCos": "acos",
    "ArcTan": "atan",
    "UnitStep": "heaviside",
    "HeavisideTheta": "heaviside",
    "DiracDelta": "dirac",
    "Dirac": "dirac",
    "Sign": "sign",
    "Max": "max",
    "Min": "min",
    **{name.capitalize(): name for name in (*BARE - {"ln"}, "sqrt", "erf", "abs", "floor")},
}


def _rule(notation: str, text: str, result: str | Callable[[Match], str] = "", kind: str = "") -> Rewrite:
    return Rewrite(notation, pattern(text), result, kind)


_PACKAGES = "sympy|sp|sm|sy|np|math|numpy"
_MAKERS = "Function|function|Symbol|symbols|var"
_OF_X = r"(LETTER) \( (LETTER) \)"
_SLOPE = rf"(?:diff|Derivative) \( {_OF_X} , \2 \)"
_BEHIND_NAME = r"(?:(?<=\w\x20)|(?<=\w\x20\x20))"
NOTATIONS = (
    _rule("the name of a package", rf"(?:{_PACKAGES}) \."),
    _rule("a quoted name", rf"(?<!=\x20)(?<!=\x20\x20)(?:{_MAKERS}) \( ['\"] (\w+) ['\"] \)", r"\1"),
    _rule("Maple", r"OPEN D @@ (?P<n>\d) CLOSE OPEN (?P<y>LETTER) CLOSE", _derivative),
    _rule("Mathematica", r"Derivative OPEN (?P<n>\d) CLOSE OPEN (?P<y>LETTER) CLOSE", _derivative),
    _rule("Maple", r"OPEN D OPEN D OPEN (LETTER) CLOSE CLOSE CLOSE(?= OPEN)", r"\1 ''"),
    _rule("Maple", r"D OPEN D OPEN (LETTER) CLOSE CLOSE(?= OPEN)", r"\1 ''"),
    _rule("Maple", r"OPEN D OPEN (LETTER) CLOSE CLOSE(?= OPEN)", r"\1 '"),
    _rule("Maple", r"(?:OPEN D CLOSE|D) OPEN (LETTER) CLOSE(?= OPEN)", r"\1 '"),
    _rule("MATLAB", r"(?<!\.\x20)diff OPEN (?P<y>LETTER) , (?P<n>[1-4]) CLOSE", _derivative),
    _rule("MATLAB", r"D(?P<n>[2-4]?)(?P<y>[xyzuvwqf])", _by_time),
    _rule("SymPy", rf"{_OF_X} \. diff \( \2(?: , 1)? \) \. subs \( \2 ,", r"\1 ' ("),
    _rule("SymPy", rf"{_SLOPE} \. subs \( \2 ,", r"\1 ' ("),
    _rule("SymPy", rf"{_OF_X} \. subs \( \2 ,", r"\1 ("),
    _rule("SymPy", rf"Subs \( {_SLOPE} , \2 ,", r"\1 ' ("),
    _rule("SymPy", rf"Subs \( {_SLOPE} , \( \2 , \) , \( (\S+) , \) \)", r"\1 ' ( \3 )"),
    _rule("Maple", r"` \$ ` \( (LETTER) , (\d) \)", r"\1 , \2"),
    _rule("Maple", r"([^\W\d]\w*) \$ (\d+)", r"\1 , \2"),
    _rule("Maxima", r"'(?= diff )"),
    _rule("Maxima", r"%~(e|pi)", r"\1"),
    _rule("Maxima", r"%~i", "I"),
    _rule("names of functions", rf"(?:{'|'.join(_SYNONYMS)})(?= [(\[])", lambda match: _SYNONYMS[match[0]]),
    _rule("pi", "Pi|π", "pi"),
    _rule("Mathematica", r"E \^", _exponential),
    _rule(
        "raised primes",
        rf"{_BEHIND_NAME}\^ (?:OPEN ((?:['\"]+ )+)CLOSE|(['\"]+(?: '+)*))",
        lambda m: primes_of(m[1] or m[2]),
    ),
    _rule("indices", r"(?P<y>[a-zA-Z])_(?P<x>[xtzsr])(?P<second>(?P=x))?", _by_index),
)
#: For what the commands of LaTeX have become signs and letters.
LATEX = (
    _rule("dots", r"\\(d{1,3})ot (?:\{ (\S+) \}|(\S+))", lambda m: f"{m[2] or m[3]} {DOTS * len(m[1])}"),
    _rule("an order", rf"{_BEHIND_NAME}\^ \{{ \( ([1-4]) \) \}}", lambda match: PRIMES * int(match[1])),
    *NOTATIONS,
)

_LINE = r"(?:^|(?<=\n\x20)|(?<=\n\x20\x20))"
_NO_INDEX = r"(?<!_\x20)(?<!_\x20\{\x20)"
_NO_NAME = rf"(?!(?:{'|'.join(FUNCTION_NAMES)}|\w) \}})"
#: Comments, breaks and layout, before all else.
AROUND = (
    _rule("Mathematica", r"\(~\* .{0,2000}? \*~\)"),
    _rule("C", r"/~\* .{0,2000}? \*~/"),
    _rule("a whole line", rf"{_LINE}(?:/~/|#|%(?!~(?:e|i|pi|o\d*|i\d+)(?!\S)))[^\n]*"),
    _rule("behind a line", rf"(?:{_LINE}|(?<=\x20\x20))(?:/~/|#|%|-~-) (?:WORD|hi|an?|is|no)(?!\S)[^\n]*"),
    _rule("environments", r"\\(?:begin|end|label|tag|ref)(?: [^\s}]+){0,12} \}", "\n"),
    _rule(
        "words",
        rf"{_NO_INDEX}\\(?:text|textrm|mbox|textnormal) \{{ {_NO_NAME}((?:(?:[^\W\d_]+|[^\w\s}}]) ){{0,99}})\}}",
        kind="TEXT",
    ),
    _rule("breaks", r"\\\\|\\quad|\\qquad", "\n"),
    _rule("the end of a line", r"\\$"),
    _rule(
        "dollars",
        r"(?<![^\W\d]\x20)(?<!`\x20)\$|\$(?! [\d`])",
        lambda match: "\n" if _occurs(r"\$.*\$", match.string) else "$" if match.start() == 0 else " ; ",  # Maxima's
    ),
)

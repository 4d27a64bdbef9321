"""Notations of other systems and of books, as a table: a few tokens of theirs, and the same in tokens of this package.

>>> [token.text for token in rewritten(Tokens(scanned("(D@@2)(y)(x) + Sin[x] = 0")), NOTATIONS)]
['y', "''", '(', 'x', ')', '+', 'sin', '[', 'x', ']', '=', '0']
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Collection, Iterable, Sequence
from functools import lru_cache
from itertools import accumulate, pairwise
from typing import NamedTuple

from kovacic.compatibility import cached_property
from kovacic.errors import InputError
from kovacic.reading.lexer import DERIVATIVES, DOTS, PRIME, Token, scanned
from kovacic.reading.names import BARE, FUNCTION_NAMES, FUNCTIONS, GREEK, LETTER, SPECIAL_LETTERS, pairs

Match = re.Match[str]
OPENING = frozenset("([{")
CLOSING = frozenset(")]}")

#: Commands of other systems that make names, and those that solve an equation.
MAKERS = frozenset("symbols Symbol Function function var symfun Differential".split())  # noqa: SIM905
SOLVERS = frozenset(
    "DSolve NDSolve DSolveValue NDSolveValue dsolve desolve ode2 contrib_ode rhs kovacicsols".split()  # noqa: SIM905
)
_KNOWN_WORDS = FUNCTIONS | GREEK | SPECIAL_LETTERS | DERIVATIVES | SOLVERS | {"Eq", "Equality"}
#: Signs of patterns: a space stands between tokens with or without a gap, ~ between tokens without one, · for a gap.
_PATTERN_SIGNS = {
    "OPEN": r"[(\[{]",
    "CLOSE": r"[)\]}]",
    "LETTER": LETTER,
    "WORD": rf"(?!(?:{'|'.join(sorted(_KNOWN_WORDS, key=len, reverse=True))})(?!\S))[^\W\d_]{{3,}}",
    " ": " +",
    "~": " (?! )",
    "·": "  +",
}
_SIGN = re.compile("|".join(_PATTERN_SIGNS))


@lru_cache(maxsize=1000)
def pattern(text: str) -> re.Pattern[str]:
    """A pattern of whole tokens, in the signs above."""
    return re.compile(rf"(?s)(?<!\S)(?:{_SIGN.sub(lambda sign: _PATTERN_SIGNS[sign[0]], text)})(?!\S)")


class Tokens(list[Token]):
    """A sequence of tokens, never changed after creation, with the queries of rules."""

    def has(self, texts: Collection[str]) -> bool:
        """True if one of these tokens occurs."""
        return any(token.text in texts for token in self)

    @cached_property
    def spaced(self) -> str:
        """The tokens as one text for patterns: each followed by a space, or by two where there is a gap."""
        return "".join(self._parts)

    @cached_property
    def _parts(self) -> list[str]:
        parts = [f"{a.text}  " if a.end < b.start else f"{a.text} " for a, b in pairwise(self)]
        return [*parts, self[-1].text] if self else []

    @cached_property
    def _offsets(self) -> list[int]:
        return [0, *accumulate(map(len, self._parts))]

    def span(self, match: Match, group: int = 0) -> tuple[int, int]:
        """The index of the first token of a match in the spaced text, and of the token after it."""
        return bisect_left(self._offsets, match.start(group)), bisect_left(self._offsets, match.end(group))

    @cached_property
    def partners(self) -> dict[int, int]:
        """Maps the index of each opening bracket, or bar, to that of the one that closes it; bars do so within brackets."""
        found: dict[int, int] = {}
        opened: list[int] = []
        for k, (_, text, _, _) in enumerate(self):
            is_bar = bool(opened) and self[opened[-1]].text == "|"
            if text == "|" and (k == 0 or self[k - 1].text in "([{+-*/^=" or opened[-1:] == [k - 1]):
                opened.append(k)  # ||x| - 1|: nothing is there that it could close
                continue
            if is_bar and text in CLOSING:
                opened.pop()
            if opened and (text in CLOSING or (is_bar and text == "|")):
                found[opened.pop()] = k
            elif text in OPENING or text == "|":
                opened.append(k)
        return found

    @cached_property
    def depths(self) -> list[int]:
        """The number of brackets that are open behind each token."""
        steps = ((token.text in OPENING) - (token.text in CLOSING) for token in self)
        return [*accumulate(steps, lambda depth, step: max(0, depth + step), initial=0)][1:]

    def split(self, signs: Collection[str] = (",",)) -> list[Tokens]:
        """The parts between commas, or other signs, outside all brackets."""
        cuts = [k for k, token in enumerate(self) if token.text in signs and not self.depths[k]]
        return [Tokens(self[begin + 1 : end]) for begin, end in pairwise([-1, *cuts, len(self)])]

    @property
    def is_enclosed(self) -> bool:
        """True if the first token is a bracket closed by the last one, of its kind."""
        return self.partners.get(0) == len(self) - 1 and self.mismatched() is None

    def mismatched(self) -> int | None:
        """The index of the first bracket that one of another kind closes."""
        pairs = ((k, self[k].text + self[last].text) for k, last in self.partners.items())
        return next((k for k, pair in sorted(pairs) if pair not in ("()", "[]", "{}", "||")), None)


class ParserTokens(Tokens):
    """The tokens of an expression or equation in `text`, for names and the parser; the last one is `$END`, and empty.

    Token k is `pieces[k]`, of the kind `kinds[k]`.  `variable` is what the notation stands for where none is named.
    """

    def __init__(self, tokens: Iterable[Token], text: str, variable: str | None = None) -> None:
        super().__init__(tokens)
        self.text = text
        self.variable = variable

    def of(self, tokens: Iterable[Token]) -> ParserTokens:
        """This text with other tokens."""
        return ParserTokens(tokens, self.text, self.variable)

    @cached_property
    def kinds(self) -> list[str]:
        return [token.kind for token in self]

    @cached_property
    def pieces(self) -> list[str]:
        return [token.text for token in self]

    @cached_property
    def names(self) -> dict[str, int]:
        """The distinct plain names in order of appearance, each with the index of its first token."""
        found: dict[str, int] = {}
        for k, kind in enumerate(self.kinds):
            if kind == "NAME":
                found.setdefault(self.pieces[k], k)
        return found

    @cached_property
    def line(self) -> str:
        """The tokens as one text for patterns in which gaps don't count."""
        return " ".join(self.pieces)

    def are(self, k: int, *kinds: str) -> bool:
        return self.kinds[k : k + len(kinds)] == [*kinds]

    def piece(self, begin: int, end: int) -> str:
        return self.text[self[begin].start : self[end - 1].end] if end > begin else ""

    def error(self, kind: type[InputError], message: str, begin: int, end: int, **hints: str | None) -> InputError:
        """An error that marks the tokens begin, ..., end - 1; `hints` are hint and shell."""
        start = self[begin].start
        return kind(message, text=self.text, position=start, length=max(1, self[end - 1].end - start), **hints)


class Rewrite(NamedTuple):
    """A notation: where its `pattern` occurs, tokens are replaced by the `result`."""

    notation: str
    text: str
    result: str | Callable[[Match], str] = ""
    #: If given, the result is the match itself, and the words of its first group get this kind.
    kind: str = ""

    @property
    def pattern(self) -> re.Pattern[str]:
        return pattern(self.text)

    def applied(self, scan: Tokens) -> Tokens:
        found = Tokens()
        done = 0
        for match in self.pattern.finditer(scan.spaced):
            first, behind = scan.span(match)
            found += scan[done:first]
            done = behind
            if self.kind:
                begin, end = scan.span(match, 1)
                found += [t._replace(kind=self.kind) if t.kind == "WORD" else t for t in scan[begin:end]]
                continue
            result = match.expand(self.result) if isinstance(self.result, str) else self.result(match)
            place = scan[first].start, scan[behind - 1].end
            found += [Token(scanned(text)[0].kind, text, *place) for text in filter(None, result.split(" "))]
        found += scan[done:]
        return found


def rewritten(scan: Tokens, rules: Sequence[Rewrite]) -> Tokens:
    """The tokens after all rules, in their order."""
    for notation in rules:
        if notation.pattern.search(scan.spaced):
            scan = notation.applied(scan)
    return scan


def primes_of(marks: str) -> str:
    """A prime for each of the marks; a quotation mark is two."""
    return PRIME * len(marks.replace('"', "''").replace(" ", ""))


@lru_cache(maxsize=8)
def _occurs(pattern: str, text: str) -> Match | None:
    """The first occurrence in a whole text, which is the same for all matches of a rule."""
    return re.search(pattern, text, re.DOTALL)


def _primed_by_order(match: Match) -> str:
    """y'' for the order 2; the order is 1 if none is given."""
    return f"{match['y']} {PRIME * int(match['n'] or 1)}"


def _by_time(match: Match) -> str:
    """MATLAB's D2y: by time, unless x occurs, or D alone, as in D^2 y + 2Dy."""
    is_by_x = match["y"] != "x" and _occurs(r"(?<!\S)(?:x|D)(?!\S)", match.string)
    return f"{match['y']} {(PRIME if is_by_x else DOTS) * int(match['n'] or 1)}"


def _by_index(match: Match) -> str:
    """diff(u, x, 2) for u_xx, and diff(u, x) for u_x in the same text, if no derivative is written otherwise."""
    second = _occurs(r"(?<!\S)([a-zA-Z])_([xytzsr])\2(?!\S)", match.string)
    is_other = second is None or match["y"] != second[1] or match["y"] == "d"  # an operator, as in \\partial_{xx} u
    if is_other or _occurs(r"\w +['˙]|(?<!\S)(?:diff|D|Derivative)(?!\S)", match.string):
        return match[0]
    return f"diff ( {match['y']} , {match['x']} , {2 if match['second'] else 1} )"


def _power_of_e(match: Match) -> str:
    """E of Mathematica, whose notation it is where functions have brackets."""
    return "e ^" if _occurs(r"(?:\w|') \[ +[a-z] +\]|[A-Z][a-z]+ \[", match.string) else match[0]


def _cases(match: Match) -> str:
    r"""Piecewise((a, x < 1), (b, True)) for the rows a & x < 1 \\ b & \text{otherwise}; words such as if are left out."""
    rows = []
    for row in filter(str.strip, re.split(r"\\\\ ", match[1])):
        value, _, case = _CASE_WORDS.sub(lambda m: " True " if m[1] in _OTHERWISE else " ", row).partition("& ")
        rows.append(f"( {value.rstrip(' ,')} , {case.rstrip(' ,.')} )")
    return f"Piecewise ( {' , '.join(rows)} )"


_OTHERWISE = ("otherwise", "else", "elsewhere")
_CASE_WORDS = re.compile(rf"\\(?:text|textrm|mbox|mathrm) \{{ +(if|for|when|{'|'.join(_OTHERWISE)}) *(?:[.,] +)?\}}")


#: Our names of functions of Mathematica, Maple and SymPy.
_SYNONYMS = {
    **pairs("ArcSin asin ArcCos acos ArcTan atan UnitStep heaviside HeavisideTheta heaviside Dirac dirac"),
    **pairs("DiracDelta dirac Sign sign Max max Min min"),
    **{name.capitalize(): name for name in (*BARE - {"ln"}, "sqrt", "erf", "abs", "floor")},
}


_PACKAGES = "sympy|sp|sm|sy|np|math|numpy"
_SLOPE = r"(?:diff|Derivative) \( (LETTER) \( (LETTER) \) , \2 \)"
_D = r"d(?: )?\\?LETTER"
_RATE = rf"\\?LETTER [\x27˙]+|{_D} / {_D}|\\frac \{{ {_D} \}} \{{ {_D} \}}"
_BEHIND_NAME = r"(?:(?<=\w\x20)|(?<=\w\x20\x20))"
NOTATIONS = (
    Rewrite("Julia", r"Differential \( (LETTER) \)(?= \()", r"d / d\1"),
    Rewrite("the name of a package", rf"(?:{_PACKAGES}) \."),
    Rewrite("a quoted name", rf"(?<!=\x20)(?<!=\x20\x20)(?:{'|'.join(MAKERS)}) \( ['\"] (\w+) ['\"] \)", r"\1"),
    Rewrite("Maple", r"OPEN D @@ (?P<n>\d) CLOSE OPEN (?P<y>LETTER) CLOSE", _primed_by_order),
    Rewrite("Mathematica", r"Derivative OPEN (?P<n>\d) CLOSE OPEN (?P<y>LETTER) CLOSE", _primed_by_order),
    Rewrite("Maple", r"(OPEN )?D OPEN D OPEN (LETTER) CLOSE CLOSE(?(1) CLOSE)(?= OPEN)", r"\2 ''"),
    Rewrite("Maple", r"(OPEN )?D OPEN (LETTER) CLOSE(?(1) CLOSE)(?= OPEN)", r"\2 '"),
    Rewrite("Maple", r"OPEN D CLOSE OPEN (LETTER) CLOSE(?= OPEN)", r"\1 '"),
    Rewrite("MATLAB", r"(?<!\.\x20)diff OPEN (?P<y>LETTER) , (?P<n>[1-4]) CLOSE", _primed_by_order),
    Rewrite("MATLAB", r"D(?P<n>[2-4]?)(?P<y>[xyzuvwqf])", _by_time),
    Rewrite("SymPy", r"(LETTER)(?: \( LETTER \))? \. diff \( (LETTER)(?: , 1)? \) \. subs \( \2 ,", r"\1 ' ("),
    Rewrite("SymPy", rf"{_SLOPE} \. subs \( \2 ,", r"\1 ' ("),
    Rewrite("SymPy", r"(LETTER)(?: \( LETTER \))? \. subs \( LETTER ,", r"\1 ("),
    Rewrite("SymPy", rf"Subs \( {_SLOPE} , \2 ,", r"\1 ' ("),
    Rewrite("SymPy", rf"Subs \( {_SLOPE} , \( \2 , \) , \( (\S+) , \) \)", r"\1 ' ( \3 )"),
    Rewrite("Maple", r"` \$ ` \( (LETTER) , (\d) \)", r"\1 , \2"),
    Rewrite("Maple", r"([^\W\d]\w*) \$ (\d+)", r"\1 , \2"),
    Rewrite("Maxima", r"'(?= diff )"),
    Rewrite("Maxima", r"%~(e|pi)", r"\1"),
    Rewrite("Maxima", r"%~i", "I"),
    Rewrite("Mathematica", r"Subscript \[ (LETTER) , (\w+) \]", r"\1_\2"),
    Rewrite("functions", rf"(?:{'|'.join(_SYNONYMS)})(?= [(\[])", lambda match: _SYNONYMS[match[0]]),
    Rewrite("pi", "Pi|π", "pi"),
    Rewrite("Mathematica", r"E \^", _power_of_e),
    Rewrite(
        "raised primes",
        rf"{_BEHIND_NAME}\^ (?:OPEN ((?:['\"]+ )+)CLOSE|(['\"]+(?: '+)*))",
        lambda m: primes_of(m[1] or m[2]),
    ),
    Rewrite(
        "evaluated at",
        r"\| _ \{ (LETTER) = ((?:[^{}()=\s]+ +){1,9})\}",
        lambda m: " ".join(f"( {m[1]} = {m[2]} )".split()),
    ),
    Rewrite(
        "(dy/dx)(0)", rf"OPEN ({_RATE}) CLOSE(?= OPEN (?:- )?(?:[\d.]+|\\?pi|π) )", lambda m: " ".join(m[1].split())
    ),
    Rewrite("indices", r"(?P<y>[a-zA-Z])_(?P<x>[xytzsr])(?P<second>(?P=x))?", _by_index),
)
#: For what the commands of LaTeX have become signs and letters.
LATEX = (
    Rewrite("dots", r"\\(d{1,3})ot (?:\{ (\S+) \}|(\S+))", lambda m: f"{m[2] or m[3]} {DOTS * len(m[1])}"),
    Rewrite("an order", rf"{_BEHIND_NAME}\^ \{{ \( ([1-4]) \) \}}", lambda match: PRIME * int(match[1])),
    *NOTATIONS,
)

_LINE = r"(?:^|(?<=\n\x20)|(?<=\n\x20\x20))"
_NO_INDEX = r"(?<!_\x20)(?<!_\x20\{\x20)"
_NO_END = r"(?:(?!(?:==?|\\end|\\begin) )\S+ +)"
_ARRAY = r"\\left \\\{ \\begin \{ array \} \{ [lcr ]+\}"
_END_OF_ARRAY = r"\\end \{ array \} \\right \."
_NO_NAME = rf"(?!(?:{'|'.join(FUNCTION_NAMES)}|\w) \}})"
#: Comments, breaks and layout, before all else.
AROUND = (
    Rewrite("Julia", r"@~(?:variables|parameters|independent_variables) [^\n;]*"),
    Rewrite("Julia", r"\x7e", lambda m: "" if _occurs(r"(?<!\S)\\", m.string) else "="),
    Rewrite("within a line", r"[(/]~\* .{0,2000}? \*~[)/]"),
    Rewrite("a whole line", rf"{_LINE}(?:/~/|#|%(?!~(?:e|i|pi|o\d*|i\d+)(?!\S)))[^\n]*"),
    Rewrite("behind a line", rf"(?:{_LINE}|(?<=\x20\x20))(?:/~/|#|%|-~-) (?:WORD|hi|an?|is|no)(?!\S)[^\n]*"),
    Rewrite(
        "cases",
        rf"(?:{_ARRAY}|\\begin \{{ cases \}}) +((?:(?!& ){_NO_END}){{0,2000}}& +{_NO_END}{{0,2000}})"
        rf"(?:{_END_OF_ARRAY}|\\end \{{ cases \}})",
        _cases,
    ),
    Rewrite("comparisons", r"\\([lg])eq?", lambda m: "<=" if m[1] == "l" else ">="),
    Rewrite("environments", rf"{_ARRAY}|{_END_OF_ARRAY}|\\(?:begin|end|label|tag|ref)(?: [^\s}}]+){{0,12}} \}}", "\n"),
    Rewrite(
        "words",
        rf"{_NO_INDEX}\\(?:text|textrm|mbox|textnormal) \{{ {_NO_NAME}((?:(?:[^\W\d_]+|[^\w\s}}]) ){{0,99}})\}}",
        kind="TEXT",
    ),
    Rewrite("no delimiter", r"\\(?:left|right) \."),
    Rewrite("breaks", r"\\\\|\\quad|\\qquad", "\n"),
    Rewrite("the end of a line", r"\\$"),
    Rewrite(
        "dollars",
        r"(?<![^\W\d]\x20)(?<!`\x20)\$|\$(?! [\d`])",
        lambda match: "\n" if _occurs(r"\$.*\$", match.string) else "$" if match.start() == 0 else " ; ",  # Maxima's
    ),
)

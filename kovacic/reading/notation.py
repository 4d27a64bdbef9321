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

from kovacic.errors import ParseError

GREEK = frozenset(
    [
        "alpha",
        "beta",
        "gamma",
        "delta",
        "epsilon",
        "zeta",
        "eta",
        "theta",
        "iota",
        "kappa",
        "lambda",
        "mu",
        "nu",
        "xi",
        "omicron",
        "rho",
        "sigma",
        "tau",
        "upsilon",
        "phi",
        "chi",
        "psi",
        "omega",
        "Gamma",
        "Delta",
        "Theta",
        "Lambda",
        "Xi",
        "Sigma",
        "Upsilon",
        "Phi",
        "Psi",
        "Omega",
    ]
)


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
    found = text
    dotted = _DOTS.search(found) is not None or "\\dot" in found or "\\ddot" in found
    latex = "\\" in found or "^{" in found or "_{" in found
    if latex and not _MATHEMATICA.search(found):
        found = _latex(found)
    found = _unicode(found)
    if _MATHEMATICA.search(found):
        found = _mathematica(found)
    found = _python(found)
    found = _maple(found)
    found = _leibniz(found)
    found, by_time = _matlab(found)
    found = found.replace("==", "=")
    return Plain(found, "t" if dotted or by_time else None)


#: Something of these occurs in every text that is rewritten.
_FOREIGN = re.compile(
    r'\\|\[|[\^_]\{|==|\$|@@|"|;\s*$|%[eip]|\bd\W*[2²]?\s*\w*\W{0,3}/|\bD|\bEq\(|\.diff|\bFunction\(|[₀-₉]|[^\x00-\u02ff]|[ÿ]|diff\(|Rational\('
)
_DOTS = re.compile("[\u00ff\u1e8d\u1e8b\u1e8f]|[\u0307\u0308]")
_MATHEMATICA = re.compile(r"\w'*\[")
#: A name of one letter, or of a Greek one.
_LETTER = rf"(?:{'|'.join(sorted(GREEK, key=len, reverse=True))}|[^\W\d_])"
_SQUARED = r"\s*(?:\^\s*\(?\s*2\s*\)?|\*\*\s*2|²|2)"


def _unicode(text: str) -> str:
    """Dots above a letter are derivatives, a double quotation mark after one is two primes, lowered digits an index."""
    text = re.sub(r'(?<=\w)"', "''", text)
    if text.isascii():
        return text
    pieces: list[str] = []
    for character in text:
        decomposed = unicodedata.normalize("NFD", character)
        if decomposed[1:] in _DOT_PRIMES and decomposed[0] in _DOTTED:
            pieces.append(decomposed[0] + _DOT_PRIMES[decomposed[1:]])
        elif character in _DOT_PRIMES:
            pieces.append(_DOT_PRIMES[character])
        elif "₀" <= character <= "₉":
            before = pieces[-1] if pieces else ""
            index = str(ord(character) - ord("₀"))
            pieces.append(index if before.isdigit() else f"_{index}")
        else:
            pieces.append(character)
    # A small Greek letter is a name of its own: two of them, or one and a Latin letter behind it, are factors.
    return re.sub(r"(?<=[α-ω])(?=[A-Za-zα-ω])", " ", "".join(pieces))


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
    **{name.capitalize(): name for name in (*_COMMON, "sec", "csc", "sech", "csch", "sqrt", "erf")},
}


def _mathematica(text: str) -> str:
    """Sin[x], y''[x], D[y[x], {x, 2}], \\[Alpha], E^x, ==."""
    text = re.sub(r"\\\[(\w+)\]", lambda found: found[1].lower() + " ", text)
    text = re.sub(r"\b[A-Z]\w*(?=\[)|\bPi\b", lambda found: _MATHEMATICA_NAMES.get(found[0], found[0]), text)
    text = re.sub(r"\bE(?=\s*\^)", "e", text)
    return text.translate(str.maketrans("[]{}", "()()")).replace("==", "=")


def _python(text: str) -> str:
    """SymPy's repr and methods: Eq(a, b), y(x).diff(x, 2), Function('y'), Rational(1, 2)."""
    text = re.sub(r"\b(?:sympy|sp)\.", "", text)
    text = re.sub(r"\b(?:Function|Symbol)\(\s*['\"](\w+)['\"]\s*\)", r"\1", text)
    text = re.sub(r"\bRational\(\s*(-?\d+)\s*,\s*(\d+)\s*\)", r"(\1/\2)", text)
    text = re.sub(r"\bIntegral?\b(?=\()", "Integer", text)
    text = re.sub(r"\bInteger\(\s*(-?\d+)\s*\)", r"(\1)", text)
    method = re.compile(r"((?<!\w)\w+\(\w+\)|diff\([^()]*\([^()]*\)[^()]*\))\.diff\(([^()]*)\)")
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
        if character == "(":
            depth += 1
        elif character == ")":
            depth -= 1
        elif character == "," and depth == 0:
            return k
    return None


def _maple(text: str) -> str:
    """Maple's x$2, (D@@2)(y)(x), D(y)(x); Maxima's 'diff(y, x, 2), %e, %i, %pi; a semicolon or $ at the end of both."""
    if text.rstrip().endswith((";", "$")):
        text = text.rstrip()[:-1]
    text = re.sub(r"(?<!\w)(\w+)\s*\$\s*(\d+)", r"\1, \2", text)
    text = re.sub(rf"\(\s*D\s*@@\s*(\d+)\s*\)\s*\(({_LETTER})\)\s*\((\w+)\)", r"diff(\2(\3), \3, \1)", text)
    text = re.sub(rf"\bD\(\s*D\(({_LETTER})\)\s*\)\s*\((\w+)\)", r"diff(\1(\2), \2, 2)", text)
    text = re.sub(rf"\bD\(({_LETTER})\)\s*\((\w+)\)", r"diff(\1(\2), \2)", text)
    text = re.sub(r"(?<!\w)'(?=diff\()", "", text)
    return re.sub(r"%(e|i|pi)\b", lambda found: "I" if found[1] == "i" else found[1], text)


_D = r"(?<![\w.])d"
_SECOND = re.compile(
    rf"{_D}{_SQUARED}\s*({_LETTER})(?:\(\s*(?:{_LETTER})\s*\))?\s*/\s*\(?d\s*({_LETTER})\s*\)?{_SQUARED}(?!\w)"
)
_SECOND_APPLIED = re.compile(
    rf"\(?{_D}{_SQUARED}\s*/\s*\(?d\s*({_LETTER})\s*\)?{_SQUARED}\)?\s*\*?\s*({_LETTER})(?!\w)(?:\(\s*{_LETTER}\s*\))?"
)
_FIRST = re.compile(rf"{_D}\s?({_LETTER})(?:\(\s*(?:{_LETTER})\s*\))?\s*/\s*d\s?({_LETTER})(?![\w^²*])")
_FIRST_APPLIED = re.compile(rf"{_D}\s*/\s*d\s?({_LETTER})\s*\*?\s*(?=\()")


def _leibniz(text: str) -> str:
    """d^2y/dx^2, d²y/dx², d2y/dx2, (d^2/dx^2) y, dy/dx, d/dx(...)."""
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


def _matlab(text: str) -> tuple[str, bool]:
    """D2y and Dy, in which t is the variable, and diff(y, 2)."""
    text = re.sub(rf"\bdiff\(\s*({_LETTER})(\(\w+\))?\s*,\s*([1-4])\s*\)", _primed, text)
    second = re.search(r"\bD2([A-Za-z])\b", text)
    if second is None:
        return text, False
    y = second[1]
    text = re.sub(rf"\bD([2-4]?){y}\b", lambda found: y + "'" * int(found[1] or 1), text)
    named = re.search(r"\bx\b", text) is not None and y != "x"
    return text, not named


def _primed(found: re.Match[str]) -> str:
    return found[1] + "'" * int(found[3]) + (found[2] or "")


_TERMINAL = re.compile(r"\\[A-Za-z]+|\\.|[0-9]+(?:\.[0-9]*)?|.", re.DOTALL)
_SPACES = {
    "\\,",
    "\\;",
    "\\!",
    "\\:",
    "\\ ",
    "\\quad",
    "\\qquad",
    "\\left",
    "\\right",
    "\\displaystyle",
    "$",
    "\\\\",
    "&",
}
_SPACES |= {
    "\\[",
    "\\]",
    "\\(",
    "\\)",
    "\\bigl",
    "\\bigr",
    "\\big",
    "\\Big",
    "\\bigg",
    "\\limits",
    "\\mathrm",
    "\\mathit",
    "\\text",
    "\\rm",
    "\\operatorname",
    "~",
}
_COMMANDS = {
    "\\cdot": "*",
    "\\times": "*",
    "\\div": "/",
    "\\infty": "oo",
    "\\ell": "ell",
    "\\hbar": "hbar",
    "\\prime": "'",
}
_COMMANDS |= {
    "\\lbrace": "(",
    "\\rbrace": ")",
    "\\lbrack": "(",
    "\\rbrack": ")",
    "[": "(",
    "]": ")",
    "\\pi": "pi",
    "\\imath": "I",
}
_LATEX_FUNCTIONS = frozenset((*_COMMON, "sec", "csc", "ln", "arcsin", "arccos", "arctan"))
#: Braces in braces.
_DEEPEST = 60


def _latex(text: str) -> str:
    """LaTeX, in which letters stand for themselves: xy is a product."""
    pieces = [piece for piece in _TERMINAL.findall(text) if piece not in _SPACES]
    translator = _Latex(text, pieces)
    translated = translator.until(None)
    return re.sub(r" (?='|\()(?!\( )", "", translated).strip()


class _Latex:
    """One pass over the terminals of a text in LaTeX."""

    def __init__(self, text: str, pieces: list[str]) -> None:
        self.text = text
        self.pieces = pieces
        self.k = 0
        self.depth = 0

    def error(self, message: str) -> ParseError:
        return ParseError(message, text=self.text, position=0, hint="write for example (x^2 + 1)/(2*x), y''")

    def until(self, stop: str | None) -> str:
        """The translation up to `stop`, which is passed over."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise self.error(f"braces within more than {_DEEPEST} braces")
        found: list[str] = []
        while True:
            self.skip_spaces()
            if self.k == len(self.pieces):
                if stop is not None:
                    raise self.error("a brace is never closed")
                break
            piece = self.take()
            if piece == stop:
                break
            found.append(self.translated(piece))
        self.depth -= 1
        return " ".join(part for part in found if part)

    def skip_spaces(self) -> None:
        while self.k < len(self.pieces) and self.pieces[self.k].isspace():
            self.k += 1

    def peek(self) -> str:
        self.skip_spaces()
        return self.pieces[self.k] if self.k < len(self.pieces) else ""

    def take(self) -> str:
        self.k += 1
        return self.pieces[self.k - 1]

    def group(self) -> str:
        """The group in braces, or the one terminal, that follows."""
        following = self.peek()
        if not following:
            raise self.error("something is missing at the end")
        piece = self.take()
        return self.until("}") if piece == "{" else self.translated(piece)

    def translated(self, piece: str) -> str:
        if piece == "}":
            raise self.error("a brace closes nothing")
        if piece == "{":
            return f"( {self.until('}')} )"
        if piece == "^":
            exponent = self.group()
            primes = exponent.replace(" ", "")
            if primes in ("(1)", "(2)"):  # y^{(2)}
                return "'" * int(primes[1])
            return primes if primes and not primes.strip("'") else f"^( {exponent} )"
        if piece == "_":
            return f"_{self.group().replace(' ', '')}"
        if piece in ("\\frac", "\\dfrac", "\\tfrac"):
            return self.fraction()
        if piece in ("\\dot", "\\ddot"):
            return self.group() + ("'" if piece == "\\dot" else "''")
        if piece == "\\sqrt":
            return self.root()
        name = piece.removeprefix("\\")
        if piece in _COMMANDS:
            return _COMMANDS[piece]
        if name in _LATEX_FUNCTIONS and piece != name:
            return self.function(name)
        if piece.startswith("\\"):
            known = name.removeprefix("var")
            if known not in GREEK:
                shown = piece if piece.isprintable() else repr(piece)
                raise self.error(f"{shown} isn't a command that is read here")
            return self.indexed(known)
        return self.indexed(piece) if piece.isalpha() else piece

    def indexed(self, name: str) -> str:
        """A name with its index, and with the primes and the argument that belong to it."""
        if self.peek() == "_":
            self.take()
            name += "_" + self.group().replace(" ", "")
        while self.peek() == "'":
            name += self.take()
        if self.peek() == "(" and not self.is_argument():
            return f"{name} *"
        return name

    def is_argument(self) -> bool:
        """Are the parentheses that follow about one letter, as in y(x)?  Others are factors, as in n(n+1)."""
        inside = [piece for piece in self.pieces[self.k + 1 : self.k + 6] if not piece.isspace()]
        return len(inside) > 1 and inside[0].isalpha() and inside[1] == ")"

    def fraction(self) -> str:
        """A derivative, or a quotient."""
        above = self.group()
        below = self.group()
        written = f"{above.replace(' ', '')}/{below.replace(' ', '')}".replace("(2)", "2").replace("(d)", "d")
        second = re.fullmatch(rf"d\^2({_LETTER})?(?:\(\w+\))?/d({_LETTER})\^2", written)
        first = re.fullmatch(rf"d({_LETTER})?(?:\(\w+\))?/d({_LETTER})", written)
        found = second or first
        if found is None:
            return f"(( {above} )/( {below} ))"
        y = found[1] or self.group()
        return f"diff({y}, {found[2]}, 2) " if second else f"diff({y}, {found[2]}) "

    def root(self) -> str:
        index = ""
        if self.peek() == "[":
            self.take()
            index = self.until("]")
        radicand = self.group()
        return f"root({radicand}, {index})" if index else f"sqrt({radicand})"

    def function(self, name: str) -> str:
        """sin x, sin 2x, sin(x), sin^2 x, sin^{2}(x)."""
        power = ""
        if self.peek() == "^":
            self.take()
            power = self.group()
        if self.peek() == "(":
            self.take()
            argument = self.until(")")
        else:
            argument = self.group()
            while argument.isdigit() and (self.peek().isalpha() or self.peek().startswith("\\")):
                argument += f" {self.group()}"
        call = f"{name}({argument})"
        return f"({call})^( {power} )" if power else call

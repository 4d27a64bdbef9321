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
from collections import Counter
from typing import NamedTuple

from kovacic.errors import ParseError
from kovacic.reading.names import FUNCTION_NAMES
from kovacic.reading.typeset import BARE, ordinary_signs, with_calls

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
    found = ordinary_signs(_DOLLAR.sub(r"\1$\2", text))
    dotted = _DOTS.search(found) is not None or "\\dot" in found or "\\ddot" in found
    latex = "\\" in found or "^{" in found or "_{" in found
    if latex and not _MATHEMATICA.search(found):
        found = _latex(found, text)
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
    found = found.replace("==", "=")
    return Plain(found, "t" if dotted or by_time else None)


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
    # A small Greek letter is a name of its own: two of them, or one and a Latin letter beside it, are factors.
    return re.sub(r"(?<=[α-ω])(?=[A-Za-zα-ω])|(?<=[A-Za-z])(?=[α-ω])", " ", "".join(pieces))


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
    text = re.sub(r"\\\[(\w+)\](?=(\d)?)", lambda found: found[1].lower() + ("" if found[2] else " "), text)
    text = _DERIVATIVE.sub(r"D[\2[\3], {\3, \1}]", text)
    text = re.sub(r"\b[A-Z]\w*(?=\[)|\bPi\b", lambda found: _MATHEMATICA_NAMES.get(found[0], found[0]), text)
    text = re.sub(r"\bE(?=\s*\^)", "e", text)
    return text.translate(str.maketrans("[]{}", "()()")).replace("==", "=")


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
    text = re.sub(r"\bPi\b", "pi", text)
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


#: (d^2y)/(dx^2), as pages show a fraction that is copied.
_IN_PARENTHESES = re.compile(
    rf"\(\s*(d(?:{_SQUARED})?\s*{_LETTER}(?:\(\w\))?)\s*\)\s*/\s*\(\s*(d\s*{_LETTER}(?:{_SQUARED})?)\s*\)"
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
    closed = _closing(text)
    opened = {end: start for start, end in closed.items()}
    primed = [found.start() for found in re.finditer(r"\)'(?!')", text)]
    starts = {opened[end] for end in primed if end in opened and not text[: opened[end]][-1:].isalnum()}
    ends = {closed[start] + 1 for start in starts}
    return "".join("" if k in ends else "diff(" if k in starts else character for k, character in enumerate(text))


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


#: Names that are words without a backslash, too; mu and nu may be products.
_WORDS = sorted((*FUNCTION_NAMES, *(name for name in GREEK if len(name) > 2), "sqrt"), key=len, reverse=True)
_TERMINAL = re.compile(
    rf"\\[A-Za-z]+|\\.|(?:{'|'.join(_WORDS)})(?![A-Za-z])|[0-9]+(?:\.[0-9]*)?|.",
    re.DOTALL,
)
#: What the argument of a function without parentheses ends with, as in \cos\omega t.
_VARIABLES = frozenset("xtzsr") | {"theta", "phi", "tau", "xi", "rho"}
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
    "\\pi": "pi",
    "\\imath": "I",
    "\\partial": "d",
    **dict.fromkeys(("\\vert", "\\lvert", "\\rvert", "\\mid"), "|"),
}
_LATEX_FUNCTIONS = frozenset((*_COMMON, "sec", "csc", "ln", "arcsin", "arccos", "arctan"))
#: Names of functions, and the d of derivatives, as they are set upright.
_ROMAN = re.compile(r"\\(?:operatorname\*?|mathrm|mathop|text)\s*\{\s*([A-Za-z]+)\s*\}|\{\\rm\s+d\}")
#: d/dx with more braces than it needs, as Maple prints it.
_DERIVATIVE_IN_BRACES = re.compile(
    r"\{\\frac\s*(?:\{\s*d\s*(\^\{?2\}?)?\}|d)\s*\{\s*d\s*\{?(\w)\}?\s*(\^\{?2\}?)?\s*\}\}"
)


def _in_italics(found: re.Match[str]) -> str:
    name = found[1] or "d"
    is_index = found.string[: found.start()].rstrip("{ ").endswith("_")
    is_word = len(name) > 1 and name not in FUNCTION_NAMES and not is_index
    if is_word and found[0].startswith(("\\operatorname", "\\text")):
        hint = "leave words out; functions are sin, exp, log, erf and the like"
        raise ParseError(
            f"{name} isn't a function that is read here",
            text=found.string,
            position=found.start(),
            length=len(found[0]),
            hint=hint,
        )
    return name


#: What closes a group.
_CLOSING = {"{": "}", "(": ")", "[": "]", "\\{": "\\}", "\\lbrace": "\\rbrace", "\\lbrack": "\\rbrack"}
#: How many terminals of an argument without parentheses are looked at.
_MOST_LETTERS = 20
#: Letters that often are a step or an impulse before a parenthesis, and no factors.
_STEPS = frozenset({"delta", "theta", "Theta", "H", "u"})
#: Braces in braces.
_DEEPEST = 100


def _latex(text: str, given: str) -> str:
    """LaTeX, in which letters stand for themselves: xy is a product; errors are located in what was `given`."""
    text = _ROMAN.sub(_in_italics, text)
    text = _DERIVATIVE_IN_BRACES.sub(r"\\frac{d\1}{d\2\3}", text)
    pieces = [piece for piece in _TERMINAL.findall(text) if piece not in _SPACES]
    translator = _Latex(given, pieces)
    translated = translator.until(None)
    return re.sub(r" (?='|\()(?!\( )", "", translated).strip()


def _is_name(piece: str) -> bool:
    """A letter, or a Greek one."""
    return (len(piece) == 1 and piece.isalpha()) or piece.removeprefix("\\") in GREEK


class _Latex:
    """One pass over the terminals of a text in LaTeX."""

    def __init__(self, text: str, pieces: list[str]) -> None:
        self.text = text
        self.pieces = pieces
        self.k = 0
        self.depth = 0
        self.names = Counter(piece.removeprefix("\\") for piece in pieces)

    def error(self, message: str, piece: str = "") -> ParseError:
        """An error at the first place where a terminal stands, or at the beginning."""
        position = max(0, self.text.find(piece))
        hint = "write for example (x^2 + 1)/(2*x), y''"
        return ParseError(message, text=self.text, position=position, length=max(1, len(piece)), hint=hint)

    def until(self, stop: str | None) -> str:
        """The translation up to `stop`, which is passed over."""
        self.descend()
        found: list[str] = []
        while True:
            self.skip_spaces()
            if self.k == len(self.pieces):
                if stop is not None:
                    raise self.error(f"{'a brace' if stop == '}' else 'a parenthesis'} is never closed")
                break
            piece = self.take()
            if piece == stop:
                break
            found.append(self.translated(piece))
        self.depth -= 1
        return " ".join(part for part in found if part)

    def descend(self) -> None:
        """One group more is open, which what calls this closes."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise self.error(f"braces within more than {_DEEPEST} braces")

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
        self.descend()
        found = self.until("}") if piece == "{" else self.translated(piece)
        self.depth -= 1
        return found

    def argument(self) -> str:
        """The group that a command is about: of a number that has no braces the first digit, as in \\frac12."""
        number = self.peek()
        if number.isdigit() and len(number) > 1:
            self.pieces[self.k] = number[1:]
            return number[0]
        return self.group()

    def translated(self, piece: str) -> str:
        if piece == "}":
            raise self.error("a brace closes nothing")
        closing = _CLOSING.get(piece)
        if closing is not None:
            return f"( {self.until(closing)} )"
        if piece == "^":
            return self.power()
        if piece == "_":
            return f"_{self.group().replace(' ', '')}"
        if piece in ("\\frac", "\\dfrac", "\\tfrac"):
            return self.fraction()
        if piece in ("\\dot", "\\ddot", "\\dddot"):
            return self.group() + "'" * piece.count("d", 1, -2)
        if piece in ("\\sqrt", "sqrt"):
            return self.root()
        name = piece.removeprefix("\\")
        if piece in _COMMANDS:
            return _COMMANDS[piece]
        if piece == name and name in FUNCTION_NAMES:  # a word
            return self.function(name)
        if name in _LATEX_FUNCTIONS and piece != name:
            return self.function(name)
        if piece.startswith("\\"):
            return self.letter(piece)
        return self.indexed(piece) if piece.isalpha() else piece

    def power(self) -> str:
        """What stands behind ^: primes, the order of a derivative as in y^{(2)}, or an exponent."""
        exponent = self.group()
        primes = exponent.replace(" ", "")
        if primes in ("(1)", "(2)", "(3)", "(4)"):
            return "'" * int(primes[1])
        return primes if primes and not primes.strip("'") else f"^( {exponent} )"

    def letter(self, command: str) -> str:
        """The Greek letter of a command, \\alpha or \\varphi, with its index."""
        known = command.removeprefix("\\").removeprefix("var")
        if known not in GREEK:
            shown = command if command.isprintable() else repr(command)
            raise self.error(f"{shown} isn't a command that is read here", command)
        return self.indexed(known)

    def indexed(self, name: str) -> str:
        """A name with its index, and with the primes and the argument that belong to it."""
        if self.peek() == "_":
            self.take()
            index = self.group().replace(" ", "")
            if not index.isalnum():
                raise self.error(f"the index of {name} is {index}, and an index has letters and digits alone", "_")
            name += "_" + index
        while self.peek() == "'":
            name += self.take()
        if self.is_application("{"):
            return f"{name}({self.applied('{')})"
        if self.peek() == "(" and not self.is_application("(") and not self.may_be_a_step(name):
            return f"{name} *"
        return name

    def may_be_a_step(self, name: str) -> bool:
        """Is it a letter of a step or an impulse, and occurs nowhere else?"""
        return name in _STEPS and self.names[name] == 1

    def is_application(self, opening: str) -> bool:
        """Do parentheses about one letter follow, y(x), or y{\\left(x\\right)}, as SymPy prints it?  Others are factors."""
        expected = ["{", "(", "", ")", "}"] if opening == "{" else ["(", "", ")"]
        inside = [piece for piece in self.pieces[self.k : self.k + 2 * len(expected)] if not piece.isspace()]
        found = inside[: len(expected)]
        return len(found) == len(expected) and all(
            piece == wanted if wanted else _is_name(piece) for piece, wanted in zip(found, expected, strict=True)
        )

    def applied(self, opening: str) -> str:
        """The letter in the parentheses that `is_application` found, which are passed over."""
        terminals: list[str] = []
        while len(terminals) < (5 if opening == "{" else 3):
            self.skip_spaces()
            terminals.append(self.take())
        return terminals[len(terminals) // 2].removeprefix("\\")

    def fraction(self) -> str:
        """A derivative, or a quotient."""
        above = self.argument()
        below = self.argument()
        written = f"{above.replace(' ', '')}/{below.replace(' ', '')}".replace("(2)", "2").replace("(d)", "d")
        second = re.fullmatch(rf"d\^2({_LETTER})?(?:\(\w+\))?/d({_LETTER})\^2", written)
        first = re.fullmatch(rf"d({_LETTER})?(?:\(\w+\))?/d({_LETTER})", written)
        found = second or first
        if found is None:
            return f"(( {above} )/( {below} ))"
        y = found[1] or self.differentiated()
        return f"diff({y}, {found[2]}, 2) " if second else f"diff({y}, {found[2]}) "

    def differentiated(self) -> str:
        """What follows d/dx: a letter, with its argument or not, or what is in parentheses."""
        y = self.group()
        if self.is_application("("):
            return f"{y}({self.applied('(')})"
        return y

    def root(self) -> str:
        index = ""
        if self.peek() == "[":
            self.take()
            index = self.until("]")
        radicand = self.group()
        return f"({radicand})^(1/({index}))" if index else f"sqrt({radicand})"

    def factors(self) -> str:
        """The argument of a function without parentheses: x, 2x, x^2; letters before a variable belong to it."""
        found = [self.group()]
        count = self.letters_before_variable()
        if found[0].isdigit():
            count = max(count, int(self.is_letter(self.peek())))
        elif found[0] in _VARIABLES:
            count = 0
        found += [self.group() for _ in range(count)]
        if self.peek() == "^":
            found.append(self.translated(self.take()))
        return " ".join(found)

    def letters_before_variable(self) -> int:
        """How many letters follow up to one that usually is a variable, that one counted; 0 where there is none."""
        letters = 0
        for piece in self.pieces[self.k : self.k + _MOST_LETTERS]:
            if piece.isspace():
                continue
            if not self.is_letter(piece):
                return 0
            letters += 1
            if piece.removeprefix("\\") in _VARIABLES:
                return letters
        return 0

    def is_letter(self, piece: str) -> bool:
        return _is_name(piece) or piece in ("\\pi", "\\ell")

    def inverse(self, name: str) -> str:
        """asin for \\sin^{-1}: what it means in books, and no reciprocal."""
        if f"a{name}" not in FUNCTION_NAMES:
            raise self.error(f"\\{name}^{{-1}} can be read in two ways")
        return f"a{name}"

    def function(self, name: str) -> str:
        """sin x, sin 2x, sin(x), sin^2 x, sin^{2}(x)."""
        power = ""
        if self.peek() == "^":
            self.take()
            power = self.argument()
        if power.replace(" ", "") == "-1":
            name = self.inverse(name)
            power = ""
        if self.peek() == "(":
            self.take()
            argument = self.until(")")
        else:
            argument = self.factors()
        call = f"{name}({argument})"
        return f"({call})^( {power} )" if power else call

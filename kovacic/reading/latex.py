"""LaTeX, as this package writes it: letters stand for themselves, xy is a product, and braces are parentheses.

>>> without_latex("\\\\frac{d^2y}{dx^2} = x^{2} \\\\sin^2 \\\\omega x", "")
'diff(y, x, 2)  = x ^( 2 )(sin(omega x))^( 2 )'

A text is split into terminals, which are translated in one pass from left to right, each with what belongs to it: a group in
braces, an index, an exponent, the argument of a function.  Linear time; what the result means is found by the parser.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable

from kovacic.errors import ParseError
from kovacic.reading.names import FUNCTION_NAMES, GREEK, LETTER

#: Names that are words without a backslash, too; mu and nu may be products.
_WORDS = sorted((*FUNCTION_NAMES, *(name for name in GREEK if len(name) > 2), "sqrt"), key=len, reverse=True)
_TERMINAL = re.compile(
    rf"\\[A-Za-z]+|\\.|(?:{'|'.join(_WORDS)})(?![A-Za-z])|[0-9]+(?:\.[0-9]*)?|.",
    re.DOTALL,
)
#: What the argument of a function without parentheses ends with, as in \cos\omega t.
_VARIABLES = frozenset("xtzsr") | {"theta", "phi", "tau", "xi", "rho"}
_LAYOUT = r"""
    \, \; \! \: \[ \] \( \) \\ & ~ $ \quad \qquad \left \right \bigl \bigr \big \Big \bigg \limits
    \displaystyle \mathrm \mathit \text \rm \operatorname
"""
#: Terminals that mean nothing.
_SPACES = frozenset((*_LAYOUT.split(), "\\ "))
#: Commands that stand for a sign or a name.
_COMMANDS = {
    "\\cdot": "*",
    "\\times": "*",
    "\\div": "/",
    "\\infty": "oo",
    "\\ell": "ell",
    "\\hbar": "hbar",
    "\\prime": "'",
    "\\pi": "pi",
    "\\imath": "I",
    "\\partial": "d",
    **dict.fromkeys(("\\vert", "\\lvert", "\\rvert", "\\mid"), "|"),
}
_FUNCTIONS = "sin cos tan cot sec csc sinh cosh tanh coth exp log ln arcsin arccos arctan"
_LATEX_FUNCTIONS = frozenset(_FUNCTIONS.split())
#: Dots above what follows are derivatives.
_DOTS = {"\\dot": "'", "\\ddot": "'" * 2, "\\dddot": "'" * 3}
#: Names of functions, and the d of derivatives, as they are set upright.
_ROMAN = re.compile(r"\\(?:operatorname\*?|mathrm|mathop|text)\s*\{\s*([A-Za-z]+)\s*\}|\{\\rm\s+d\}")
#: d/dx with more braces than it needs, as Maple prints it.
_DERIVATIVE_IN_BRACES = re.compile(
    r"\{\\frac\s*(?:\{\s*d\s*(\^\{?2\}?)?\}|d)\s*\{\s*d\s*\{?(\w)\}?\s*(\^\{?2\}?)?\s*\}\}"
)
#: d^2y/dx^2 and dy/dx of a fraction, the function maybe behind it.
_SECOND = re.compile(rf"d\^2({LETTER})?(?:\(\w+\))?/d({LETTER})\^2")
_FIRST = re.compile(rf"d({LETTER})?(?:\(\w+\))?/d({LETTER})")


def _in_italics(found: re.Match[str]) -> str:
    """The name that is set upright.  Raises `ParseError` for words."""
    name = found[1] or "d"
    is_index = found.string[: found.start()].rstrip("{ ").endswith("_")
    is_word = len(name) > 1 and name not in FUNCTION_NAMES and not is_index
    if is_word and found[0].startswith(("\\operatorname", "\\text")):
        said = f"{name} isn't a function that is read here"
        hint = "leave words out; functions are sin, exp, log, erf and the like"
        raise ParseError(said, text=found.string, position=found.start(), length=len(found[0]), hint=hint)
    return name


#: What closes a group.
_CLOSING = {"{": "}", "(": ")", "[": "]", "\\{": "\\}", "\\lbrace": "\\rbrace", "\\lbrack": "\\rbrack"}
#: What stands around the letter of an application before and behind it, by the first of these terminals.
_AROUND = {"(": (["("], [")"]), "{": (["{", "("], [")", "}"])}
#: How many terminals of an argument without parentheses are looked at.
_MOST_LETTERS = 20
#: Letters that often are a step or an impulse before a parenthesis, and no factors.
_STEPS = frozenset({"delta", "theta", "Theta", "H", "u"})
#: Braces in braces.
_DEEPEST = 100


def without_latex(text: str, given: str) -> str:
    """A text in LaTeX, rewritten; errors are located in what was `given`.

    Raises `ParseError` for commands that have no meaning here, and for braces that don't match.
    """
    text = _ROMAN.sub(_in_italics, text)
    text = _DERIVATIVE_IN_BRACES.sub(r"\\frac{d\1}{d\2\3}", text)
    pieces = [piece for piece in _TERMINAL.findall(text) if piece not in _SPACES]
    translator = _Latex(given, pieces)
    translated = translator.until(None)
    return re.sub(r" (?='|\()(?!\( )", "", translated).strip()


def _is_name(piece: str) -> bool:
    """A letter, or a Greek one."""
    return (len(piece) == 1 and piece.isalpha()) or piece.removeprefix("\\") in GREEK


def _function_of(piece: str) -> str | None:
    """The function that a command or a word stands for."""
    name = piece.removeprefix("\\")
    known = FUNCTION_NAMES if piece == name else _LATEX_FUNCTIONS
    return name if name in known else None


class _Latex:
    """One pass over the terminals of a text in LaTeX: `pieces[k]` is the next one."""

    def __init__(self, text: str, pieces: list[str]) -> None:
        self.text = text
        self.pieces = pieces
        self.k = 0
        #: How many groups are open.
        self.depth = 0
        #: How often each name occurs.
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
                self.check_nothing_is_open(stop)
                break
            piece = self.take()
            if piece == stop:
                break
            found.append(self.translated(piece))
        self.depth -= 1
        return " ".join(part for part in found if part)

    def check_nothing_is_open(self, stop: str | None) -> None:
        """Refuses the end of the text where `stop` is expected before it."""
        if stop == "}":
            raise self.error("a brace is never closed")
        if stop is not None:
            raise self.error("a parenthesis is never closed")

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
        """A terminal that has been taken, with what belongs to it."""
        if piece in _CLOSING:
            return f"( {self.until(_CLOSING[piece])} )"
        if piece in _RULES:
            return _RULES[piece](self)
        if piece in _DOTS:
            return self.group() + _DOTS[piece]
        if piece in _COMMANDS:
            return _COMMANDS[piece]
        function = _function_of(piece)
        if function is not None:
            return self.function(function)
        if piece.startswith("\\"):
            return self.letter(piece)
        return self.indexed(piece) if piece.isalpha() else piece

    def closed_too_often(self) -> str:
        raise self.error("a brace closes nothing")

    def index(self) -> str:
        return f"_{self.group().replace(' ', '')}"

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
        before, behind = _AROUND[opening]
        size = len(before) + 1 + len(behind)
        following = [piece for piece in self.pieces[self.k : self.k + 2 * size] if not piece.isspace()]
        found = following[:size]
        if len(found) < size or not _is_name(found[len(before)]):
            return False
        return found[: len(before)] == before and found[-len(behind) :] == behind

    def applied(self, opening: str) -> str:
        """The letter in the parentheses that `is_application` found, which are passed over."""
        before, behind = _AROUND[opening]
        terminals: list[str] = []
        for _ in range(len(before) + 1 + len(behind)):
            self.skip_spaces()
            terminals.append(self.take())
        return terminals[len(before)].removeprefix("\\")

    def fraction(self) -> str:
        """A derivative, or a quotient."""
        above = self.argument()
        below = self.argument()
        written = f"{above.replace(' ', '')}/{below.replace(' ', '')}".replace("(2)", "2").replace("(d)", "d")
        second = _SECOND.fullmatch(written)
        if second is not None:
            return f"diff({second[1] or self.differentiated()}, {second[2]}, 2) "
        first = _FIRST.fullmatch(written)
        if first is not None:
            return f"diff({first[1] or self.differentiated()}, {first[2]}) "
        return f"(( {above} )/( {below} ))"

    def differentiated(self) -> str:
        """What follows d/dx: a letter, with its argument or not, or what is in parentheses."""
        y = self.group()
        if self.is_application("("):
            return f"{y}({self.applied('(')})"
        return y

    def root(self) -> str:
        """\\sqrt{x} or \\sqrt[n]{x}."""
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


#: What a terminal means that begins something.
_RULES: dict[str, Callable[[_Latex], str]] = {
    "}": _Latex.closed_too_often,
    "^": _Latex.power,
    "_": _Latex.index,
    **dict.fromkeys(("\\frac", "\\dfrac", "\\tfrac"), _Latex.fraction),
    **dict.fromkeys(("\\sqrt", "sqrt"), _Latex.root),
}

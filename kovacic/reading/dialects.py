"""Notations as tables of token rules: LaTeX, Mathematica, Maple, Maxima, MATLAB, Python, and what people write by hand.

`translated` goes through the scanned tokens once, from left to right.  A rule looks at the token that is next, takes what
belongs to it, and writes tokens of the parser's grammar; what has to stand behind a bracket or a factor that is still to be
read is kept in `closers` until then.  Linear time, no recursion; every token keeps its place in the user's text.

>>> translated("", scanned(r"\\frac{d^2y}{dx^2} = x^{2} \\sin^2 \\omega x")).pieces
['diff', '(', 'y', ',', 'x', ',', '2', ')', '=', 'x', '^', '(', '2', ')', 'sin', '(', 'omega', 'x', ')', '^', '2', '']
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from functools import cached_property, lru_cache
from itertools import pairwise, zip_longest

from kovacic.errors import ParseError
from kovacic.limits import Limits, check_time
from kovacic.reading.lexer import DERIVATIVES, Token, Tokens, check_length, has_dots, scanned, unexpected
from kovacic.reading.names import BARE, FUNCTION_NAMES, GREEK, LETTER, SPECIAL_LETTERS, is_function, unglued

_KINDS = {
    "+": "PLUS",
    "-": "MINUS",
    **dict.fromkeys(("*", ".*"), "STAR"),
    **dict.fromkeys(("/", "./"), "SLASH"),
    **dict.fromkeys(("^", "**", ".^"), "CIRCUMFLEX"),
    **dict.fromkeys("([{", "LPAR"),
    **dict.fromkeys(")]}", "RPAR"),
    ",": "COMMA",
    **dict.fromkeys(("=", "=="), "EQUAL"),
    **dict.fromkeys(("<", ">", "<=", ">=", "≤", "≥"), "COMPARISON"),
}
OPENING = frozenset("([{")
CLOSING = frozenset(")]}")
#: The condition of the last of several pieces.
_OTHERWISE = ("True", "otherwise")
_POWERS = ("^", "**")
_SUPERSCRIPT_DIGITS = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_AS_PARENTHESES = str.maketrans("[]{}", "()()")

#: How tokens of a kind are written, however they were.
_PLAIN = {"LPAR": "(", "RPAR": ")", "EQUAL": "=", "STAR": "*", "SLASH": "/"}

# ------------------------------------------------------------------------------------------------- LaTeX

#: Commands, and letters between dollar signs, that mean nothing.
LAYOUT = frozenset(
    r"""
    \, \; \! \: \[ \] \( \) \\ \quad \qquad \left \right \bigl \bigr \big \Big \bigg \Bigl \Bigr \limits \displaystyle \rm
    \nonumber \notag & ~
    """.split()  # noqa: SIM905
) | {"\\ "}
#: Commands about a name that is set upright, or in another style.
_STYLES = frozenset(r"\operatorname \mathrm \mathop \mathit \mathbf \text \textrm \textit".split())  # noqa: SIM905
_FRACTIONS = frozenset({"\\frac", "\\dfrac", "\\tfrac", "\\cfrac"})
_DOTS = {"\\dot": "'", "\\ddot": "''", "\\dddot": "'''"}
#: What commands stand for.
_COMMANDS = {
    **dict.fromkeys(("\\cdot", "\\times"), ("SIGN", "*")),
    "\\div": ("SIGN", "/"),
    "\\infty": ("WORD", "oo"),
    "\\prime": ("PRIMES", "'"),
    "\\imath": ("WORD", "I"),
    "\\partial": ("WORD", "d"),
    **dict.fromkeys(("\\vert", "\\lvert", "\\rvert", "\\mid"), ("SIGN", "|")),
    **dict.fromkeys(("\\{", "\\lbrace", "\\lbrack"), ("SIGN", "(")),
    **dict.fromkeys(("\\}", "\\rbrace", "\\rbrack"), ("SIGN", ")")),
    **{f"\\{name}": ("WORD", name) for name in (*GREEK, *SPECIAL_LETTERS, *BARE)},
    **{f"\\var{name}": ("WORD", name) for name in GREEK},
}
#: Words that are one name in LaTeX without a backslash, too; mu and nu may be products.
_WORDS = sorted((*FUNCTION_NAMES, *(name for name in GREEK if len(name) > 2), "pi", "diff"), key=len, reverse=True)
_LETTERS = re.compile(rf"(?:{'|'.join(_WORDS)})(?![A-Za-z])|[^\W\d_](?:_[A-Za-z0-9])?|[0-9]+|_")


def _is_latex(scan: Sequence[Token]) -> bool:
    """True for a text with commands, or with braces behind ^ and _."""
    for token, following in zip_longest(scan, scan[1:]):
        if token.kind == "COMMAND" and not (following and token.text == "\\[" and following.text[0].isupper()):
            return True
        if following is not None and following.text == "{" and (token.text == "^" or token.text.endswith("_")):
            return True
    return False


class _Latex:
    """The tokens of a text in LaTeX as those of other texts: letters are names, commands are signs and words."""

    def __init__(self, text: str, scan: Sequence[Token]) -> None:
        self.text = text
        self.scan = scan
        self.found: list[Token] = []
        self.k = 0

    def ordinary(self) -> list[Token]:
        while self.k < len(self.scan):
            token = self.scan[self.k]
            self.k += 1
            if token.kind == "TEXT":
                raise self.error(f"{token.text} is a word and no part of the equation", token, "leave it out")
            if token.kind == "WORD":
                self.letters(token)
            elif token.kind == "COMMAND":
                self.command(token)
            elif token.text == "_":
                self.index()
            elif token.kind == "NUMBER" and token.text.isdigit() and self.found and self.found[-1].text in _FRACTIONS:
                self.digits(token)
            elif token.text not in LAYOUT:
                self.found.append(token)
        return self.found

    def letters(self, word: Token) -> None:
        is_word = len(word.text) > 4 and word.text.isalpha() and unglued(word.text).count("*") == len(word.text) - 1
        if is_word and word.text not in _WORDS:
            raise self.error(f"{word.text} is a word that isn't known here", word, "leave it out, or write *")
        for part in _LETTERS.finditer(word.text):
            if part[0] == "_":
                self.index()
                continue
            kind = "NUMBER" if part[0].isdigit() else "WORD"
            last = min(word.start + part.end(), word.end)
            self.found.append(Token(kind, part[0], min(word.start + part.start(), last), last))

    def digits(self, number: Token) -> None:
        r"""Of \frac12 each digit is an argument."""
        for k, digit in enumerate(number.text):
            self.found.append(Token("NUMBER", digit, number.start + k, number.start + k + 1))

    def command(self, token: Token) -> None:
        if token.text in _STYLES:
            self.upright(token)
        elif token.text in _COMMANDS:
            self.found.append(Token(*_COMMANDS[token.text], token.start, token.end))
        elif token.text in _FRACTIONS or token.text in _DOTS or token.text == "\\sqrt":
            self.found.append(token)
        elif token.text not in LAYOUT:
            shown = token.text if token.text.isprintable() else repr(token.text)
            raise self.error(f"{shown} isn't a command that is read here", token)

    def upright(self, command: Token) -> None:
        r"""\mathrm{d}, \operatorname{sech}, \text{eff}: a name, of which the braces are no parentheses."""
        following = self.scan[self.k] if self.k < len(self.scan) else command
        if following.kind == "WORD" and len(following.text) > 1:  # \\mathrm dt
            self.k += 1
            first = following.start + 1
            self.found.append(Token("WORD", following.text[0], command.start, first))
            self.letters(Token("WORD", following.text[1:], first, following.end))
            return
        group = self.group()
        name = "".join(token.text for token in group)
        is_name = len(name) == 1 or is_function(name)
        if command.text in ("\\mathrm", "\\mathit", "\\mathbf", "\\mathop") and name.isalpha() and not is_name:
            is_name = name in GREEK
        if not group or not is_name:
            hint = "leave words out; functions are sin, exp, log, erf and the like"
            raise self.error(f"{name} isn't a function that is read here", command, hint)
        self.found.append(Token("WORD", name, command.start, group[-1].end))

    def group(self) -> list[Token]:
        """The tokens in the braces that follow, or the one that follows; they are passed over."""
        if self.k == len(self.scan):
            return []
        if self.scan[self.k].text != "{":
            self.k += 1
            return [self.scan[self.k - 1]]
        first = self.k + 1
        depth = 0
        while self.k < len(self.scan):
            text = self.scan[self.k].text
            depth += (text == "{") - (text == "}")
            self.k += 1
            if depth == 0:
                return list(self.scan[first : self.k - 1])
        raise self.error("a brace is never closed", self.scan[first - 1])

    def index(self) -> None:
        """A name with its index is one name."""
        name = self.found[-1] if self.found else None
        group = [token for token in self.group() if token.text not in _STYLES and token.text not in "{}"]
        index = "".join(token.text.removeprefix("\\") for token in group)
        if name is None or name.kind != "WORD" or not group:
            raise self.error("an index belongs to a name", self.scan[self.k - 1])
        if not index.isalnum():
            said = f"the index of {name.text} is {index}, and an index has letters and digits alone"
            raise self.error(said, group[0])
        self.found[-1] = Token("WORD", f"{name.text}_{index}", name.start, group[-1].end)

    def error(self, message: str, token: Token, hint: str = "write for example (x^2 + 1)/(2*x), y''") -> ParseError:
        length = token.end - token.start
        return ParseError(message, text=self.text, position=token.start, length=length, hint=hint)


# ----------------------------------------------------------------------------------- derivatives of all kinds

_NUMERATOR = re.compile(rf"d\^?([2-9]?)({LETTER})?({LETTER})?")
_DENOMINATOR = re.compile(rf"d({LETTER})\^?([2-9]?)")
_OF_POINT = rf"({LETTER})\(({LETTER})\)"
#: Derivatives of y that are several tokens, written without spaces and with round brackets: y and the order are found.
_AS_PRIMES = [
    re.compile(pattern)
    for pattern in (
        rf"\(D@@(?P<n>\d)\)\((?P<y>{LETTER})\)",
        rf"Derivative\((?P<n>\d)\)\((?P<y>{LETTER})\)",
        rf"\(?D\(D\((?P<y>{LETTER})\)\)\)?(?=\()(?P<n>)",
        rf"\(D\((?P<y>{LETTER})\)\)(?=\()",
        rf"\(D\)\((?P<y>{LETTER})\)(?=\()",
        rf"D\((?P<y>{LETTER})\)(?=\()",
        rf"diff\((?P<y>{LETTER}),(?P<n>[1-4])\)",
    )
]
#: MATLAB's D2y, and Dy.
_MATLAB = re.compile(r"D([2-4]?)([xyzuvwqf])")
#: The first derivative at a point, up to the point.
_AT_POINT = [
    re.compile(rf"{_OF_POINT}\.diff\(\2(?:,1)?\)\.subs\(\2,"),
    re.compile(rf"(?:diff|Derivative)\({_OF_POINT},\2\)\.subs\(\2,"),
    re.compile(rf"Subs\((?:diff|Derivative)\({_OF_POINT},\2\),\(?\2,?\)?,\(?"),
]
#: Function('y'), Symbol("x").
_QUOTED = re.compile(r"(?:Function|function|Symbol|symbols|var)\(['\"](\w+)['\"]\)")
_SECOND_INDEX = re.compile(r"([a-zA-Z])_([xtzsr])\2")
#: A token takes some 30 calls of functions, and a look at the clock is due after some thousands.
_TOKENS_BETWEEN_LOOKS = 100
_MOST = 18  # tokens of what these patterns describe

#: What names of Mathematica's and Maple's are.
_SYNONYMS = {
    "ArcSin": "asin",
    "ArcCos": "acos",
    "ArcTan": "atan",
    "Sign": "sign",
    "UnitStep": "heaviside",
    "HeavisideTheta": "heaviside",
    "DiracDelta": "dirac",
    "Dirac": "dirac",
    "Max": "max",
    "Min": "min",
    **{name.capitalize(): name for name in (*BARE, "sqrt", "erf", "abs", "floor") if name not in ("ln",)},
}
_CONSTANTS = {"Pi": "pi", "π": "pi"}
#: Letters that often are a step or an impulse before a parenthesis, and no factors.
_STEPS = frozenset({"delta", "theta", "Theta", "H", "u"})
#: What the argument of a function without parentheses ends with, as in cos omega t.
_VARIABLES = frozenset("xtzsr") | {"theta", "phi", "tau", "xi", "rho"}


def _is_name(text: str) -> bool:
    """A letter, with an index or not, or the name of one."""
    bare = text.partition("_")[0]
    return (len(bare) == 1 and bare.isalpha()) or bare in GREEK or bare in SPECIAL_LETTERS


def translated(text: str, scan: Sequence[Token], *, condition: bool = False) -> Tokens:
    """The tokens of an expression or equation; those of a `condition` have the unknown function at points.

    Raises `ParseError` for what has no meaning in any notation.
    """
    latex = _is_latex(scan)
    scan = [token for token in (_Latex(text, scan).ordinary() if latex else scan) if token.kind != "NEWLINE"]
    return _Translation(text, scan, latex=latex, condition=condition).tokens()


class _Translation:
    """One pass over the tokens, number `k` of which is the next one."""

    def __init__(self, text: str, scan: list[Token], *, latex: bool, condition: bool) -> None:
        self.text = text
        self.scan = scan
        self.latex = latex
        self.condition = condition
        self.k = 0
        self.found: list[tuple[str, str, int, int]] = []
        #: The numbers in `found` of the parentheses that are open, and of the one that was closed last.
        self.opened: list[int] = []
        self.closed = 0
        #: What is written before a token.
        self.closers: dict[int, list[tuple[str, str]]] = {}
        self.skipped: set[int] = set()
        self.partner = partners(self.scan)
        self.words = Counter(token.text for token in scan)
        self.bars = _bars(scan) if "|" in self.words else {}
        self.by_time = not self.words.keys().isdisjoint(_DOTS) or has_dots(text)
        self.mathematica = "[" in self.words and not latex and _calls_with_brackets(scan)

    def tokens(self) -> Tokens:
        rules = _rules_for(_MARKS.intersection("".join(self.words)))
        while self.k < len(self.scan):
            if self.k % _TOKENS_BETWEEN_LOOKS == 0:
                check_time()
            if self.k in self.closers:
                self.close()
            token = self.scan[self.k]
            if self.k in self.skipped:
                self.k += 1
                continue
            for rule in rules.get(token.text) or rules.get(token.kind, ()):
                if rule(self, token):
                    break
            else:
                raise unexpected(self.text, token)
        for k in sorted(self.closers):
            self.k = k
            self.close()
        self.indices()
        end = self.scan[-1].end if self.scan else len(self.text)
        end = max(end, len(self.text))
        kinds, pieces, starts, ends = map(list, zip(*self.found, ("$END", "", end, end), strict=True))
        variable = "t" if self.by_time else None
        return Tokens(self.text, kinds, pieces, starts, ends, variable, self.latex)

    # ------------------------------------------------------------------------------------------- writing

    def write(self, kind: str, piece: str, token: Token | None = None) -> None:
        """A token where the `token` stands, or behind what was written before."""
        start, end = (token.start, token.end) if token else (self.here(), self.here())
        if kind == "LPAR":
            self.opened.append(len(self.found))
        elif kind == "RPAR":
            self.closed = self.opened.pop() if self.opened else -1
        self.found.append((kind, piece, start, end))

    def here(self) -> int:
        if self.k == 0:
            return self.scan[0].start
        return self.scan[min(self.k, len(self.scan)) - 1].end

    def close(self) -> None:
        for kind, piece in self.closers.pop(self.k, ()):
            self.write(kind, piece)

    def later(self, k: int, *tokens: tuple[str, str]) -> None:
        """Tokens to be written before number k, and before what is to be written there already."""
        self.closers[k] = [*tokens, *self.closers.get(k, [])]

    def head(self, name: str, token: Token) -> None:
        """A name with a parenthesis that opens."""
        self.write("HEAD", name, token)
        self.write("LPAR", "(")

    def primed(self, y: str, order: int, first: Token, end: int) -> bool:
        """y'' for the tokens up to number `end`."""
        self.write("PRIMED", y + "'" * order, Token("", "", first.start, self.scan[end - 1].end))
        self.k = end
        return True

    # ------------------------------------------------------------------------------------------- looking

    def text_at(self, k: int) -> str:
        return self.scan[k].text if k < len(self.scan) else ""

    def kind_at(self, k: int) -> str:
        return self.scan[k].kind if k < len(self.scan) else ""

    def compact(self, begin: int, end: int) -> str:
        """The tokens without brackets, for comparison."""
        texts = [token.text for token in self.scan[begin:end] if token.text not in "()[]{}"]
        return "".join(texts).replace("**", "^").translate(_SUPERSCRIPT_DIGITS)

    @cached_property
    def in_parentheses(self) -> list[str]:
        """The texts of the tokens, with round brackets for all."""
        return [token.text.translate(_AS_PARENTHESES) for token in self.scan]

    def match(self, pattern: re.Pattern[str], k: int) -> tuple[re.Match[str], int] | None:
        """Whole tokens from number k on, in round brackets, and the number of the token behind them."""
        texts = self.in_parentheses[k : k + _MOST]
        found = pattern.match("".join(texts))
        if found is None:
            return None
        length = 0
        for count, text in enumerate(texts, 1):
            length += len(text)
            if length == found.end():
                return found, k + count
        return None

    def operand_end(self, k: int) -> int | None:
        """The number of the token behind the one operand that begins with number k; None where there is none."""
        text = self.text_at(k)
        if k in self.partner or k in self.bars:
            return (self.partner.get(k) or self.bars[k]) + 1
        if text in _FRACTIONS:
            groups = self.groups(k + 1)
            return groups[3] if groups else None
        if text == "\\sqrt":
            k += 1
            if self.text_at(k) == "[" and k in self.partner:
                k = self.partner[k] + 1
            return self.operand_end(k)
        if text in _DOTS:
            return self.operand_end(k + 1)
        if self.kind_at(k) in ("NUMBER", "WORD"):
            end = k + 1
            if self.kind_at(end) == "PRIMES":
                end += 1
            return (self.kind_at(k) == "WORD" and self.argument_end(end)) or end
        return None

    def argument_end(self, k: int) -> int | None:
        """The number of the token behind (x) or {(x)}, an argument that is one letter; None where that isn't next."""
        if self.text_at(k) in OPENING and k in self.partner:
            last = self.partner[k]
            if last == k + 2 and self.kind_at(k + 1) == "WORD" and _is_name(self.text_at(k + 1)):
                return last + 1
            if self.argument_end(k + 1) == last:
                return last + 1
        return None

    def groups(self, k: int) -> tuple[int, int, int, int] | None:
        """Where the two arguments of a fraction begin and end."""
        middle = self.operand_end(k)
        end = self.operand_end(middle) if middle is not None else None
        if middle is None or end is None:
            return None
        return k, middle, middle, end

    # ------------------------------------------------------------------------------------------- derivatives

    def derivative(self, token: Token) -> bool:
        """d^2y/dx^2, (d^2/dx^2) y, \\frac{d}{dx}(...)."""
        found = self.quotient(self.k)
        if found is None:
            return False
        y, x, order, end = found
        if y is None:
            return self.operator(token, x, order, end)
        behind = self.argument_end(end)
        if behind is not None and self.text_at(behind - 2) == x:
            end = behind
        elif self.text_at(end) == "(" and self.condition:
            return self.primed(y, order, token, end)
        whole = Token("", "", token.start, self.scan[end - 1].end)
        for kind, piece in (("HEAD", "diff"), ("LPAR", "("), ("NAME", y), *_by(x, order)):
            self.write(kind, piece, whole)
        self.k = end
        return True

    def operator(self, token: Token, x: str, order: int, end: int) -> bool:
        """What follows d/dx is differentiated."""
        if self.text_at(end) == "*":
            end += 1
        inner = self.quotient(end)
        behind = inner[3] if inner and inner[0] else self.operand_end(end)
        if behind is None:
            return False
        self.head("diff", Token("", "", token.start, self.scan[end - 1].end))
        self.later(behind, *_by(x, order))
        self.k = end
        return True

    def quotient(self, k: int) -> tuple[str | None, str, int, int] | None:
        """y or None, x, the order, and the number of the token behind d^2y/dx^2 or d^2/dx^2; None for anything else."""
        text = self.text_at(k)
        if text in ("(", "{") and self.partner.get(k, k) - k < 2 * _MOST:
            inner = self.quotient(k + 1)
            if inner is not None and inner[3] == self.partner.get(k):
                return (*inner[:3], inner[3] + 1)
        if text in _FRACTIONS:
            groups = self.groups(k + 1)
            if groups is None or groups[3] - k > 2 * _MOST:
                return None
            above, below, end = self.compact(*groups[:2]), self.compact(*groups[2:]), groups[3]
        elif text.startswith("d") or text == "(":
            slash = next((j for j in range(k, min(k + 12, len(self.scan))) if self.scan[j].text == "/"), None)
            if slash is None:
                return None
            end = self.differential_end(slash + 1)
            above, below = self.compact(k, slash), self.compact(slash + 1, end)
        else:
            return None
        numerator, denominator = _NUMERATOR.fullmatch(above), _DENOMINATOR.fullmatch(below)
        if not numerator or not denominator or numerator[1] != denominator[2]:
            return None
        return numerator[2], denominator[1], int(numerator[1] or 1), end

    def differential_end(self, k: int) -> int:
        """The number of the token behind dx^2, (dx)^2 or (dx^2)."""
        end = self.partner.get(k, k) + 1
        if self.text_at(k) == "d":
            end = k + 2
        if self.text_at(end) in _POWERS:
            end = self.operand_end(end + 1) or end
        elif self.kind_at(end) == "SUPERSCRIPT":
            end += 1
        return end

    def several(self, token: Token) -> bool:
        """Derivatives that are several tokens in other systems: (D@@2)(y)(x), Derivative[2][y][x], diff(y, 2), D2y."""
        matlab = _MATLAB.fullmatch(token.text)
        if matlab is not None:
            self.by_time = self.by_time or "x" not in self.words or matlab[2] == "x"
            return self.primed(matlab[2], int(matlab[1] or 1), token, self.k + 1)
        if token.text in ("D", "Derivative", "diff", "Derivative", "("):
            for pattern in _AS_PRIMES:
                found = self.match(pattern, self.k)
                if found is not None:
                    order = found[0].groupdict().get("n")
                    return self.primed(found[0]["y"], 1 if order is None else int(order or 2), token, found[1])
        return False

    def at_point(self, token: Token) -> bool:
        """y(x).diff(x).subs(x, 0), Subs(Derivative(y(x), x), x, 0), y(x).subs(x, 0)."""
        if "subs" not in self.words and "Subs" not in self.words:
            return False
        for pattern in _AT_POINT:
            found = self.match(pattern, self.k)
            if found is not None:
                self.primed(found[0][1], 1, token, found[1])
                self.found[-1] = ("HEAD", *self.found[-1][1:])
                self.write("LPAR", "(")
                if self.text_at(found[1] - 1) == "(":
                    self.skipped.add(self.partner.get(found[1] - 1, -1))
                return True
        return False

    def method(self, token: Token) -> bool:
        """y(x).diff(x, 2): what stands before the point is differentiated."""
        is_method = self.text_at(self.k + 1) in DERIVATIVES and self.text_at(self.k + 2) == "("
        if not is_method or not self.found:
            return False
        self.differentiate_last(token)
        if self.text_at(self.k + 3) != ")":
            self.write("COMMA", ",", token)
        self.k += 3
        return True

    def primes(self, token: Token) -> bool:
        """((1 - x^2) y')', and quotation marks before Maxima's 'diff."""
        if self.text_at(self.k + 1) == "diff":
            self.k += 1
            return True
        if self.text_at(self.k + 1) == "$" and self.kind_at(self.k + 2) == "PRIMES" and self.text_at(self.k + 3) == "(":
            self.skipped.add(self.partner.get(self.k + 3, -1))  # Maple's `$`(x, 2)
            self.k += 4
            return True
        is_behind = self.found and self.found[-1][0] == "RPAR" and self.text_at(self.k - 1) in CLOSING
        if not is_behind or self.found[max(0, self.closed - 1)][0] == "HEAD":
            return False
        for _ in range(_count(token)):
            self.differentiate_last(token)
            self.write("RPAR", ")", token)
        self.k += 1
        return True

    def differentiate_last(self, token: Token) -> None:
        """Begins a call of diff before the operand that was written last."""
        first = len(self.found) - 1
        if self.found[-1][0] == "RPAR":
            first = max(0, self.closed)
            if first and self.found[first - 1][0] == "HEAD":
                first -= 1
        start = self.found[first][2]
        self.found[first:first] = [("HEAD", "diff", start, start), ("LPAR", "(", start, start)]
        self.opened.append(first + 1)

    # ------------------------------------------------------------------------------------------- words

    def prefix(self, token: Token) -> bool:
        """The name of a package: sympy.exp; and the quoted name in Function('y')."""
        if token.text in ("sympy", "sp", "sm", "sy", "np", "math", "numpy") and self.text_at(self.k + 1) == ".":
            self.k += 2
            return True
        found = self.match(_QUOTED, self.k) if self.kind_at(self.k + 2) == "PRIMES" else None
        if found is None:
            return False
        self.write("NAME", found[0][1], token)
        self.k = found[1]
        return True

    def synonym(self, token: Token) -> bool:
        """Sin of Mathematica, Pi, and E^x where brackets tell whose notation it is."""
        if token.text in _CONSTANTS or (self.mathematica and token.text == "E" and self.text_at(self.k + 1) == "^"):
            self.write("NAME", _CONSTANTS.get(token.text, "e"), token)
            self.k += 1
            return True
        if token.text in _SYNONYMS and self.text_at(self.k + 1) == "[":
            self.write("NAME", _SYNONYMS[token.text], token)
            self.k += 1
            return True
        return False

    def function(self, token: Token) -> bool:
        """sin x, sin 2x, cos omega t, sin^2 x, sin^2(x), sin^{-1}(x), ln|x|."""
        name = token.text
        if name not in FUNCTION_NAMES or (name not in BARE and not self.latex):
            return False
        k = self.k + 1
        power: list[tuple[str, str]] = []
        if self.text_at(k) in _POWERS or self.kind_at(k) == "SUPERSCRIPT":
            end = k + 1
            if self.text_at(k) in _POWERS:
                first = k + 1 + (self.text_at(k + 1) == "-")
                end = self.partner.get(first, first) + 1
            exponent = self.compact(k, end).removeprefix("^")
            if exponent == "-1":
                name = self.inverse(token)
            elif exponent:
                power = [("CIRCUMFLEX", "^"), ("NUMBER" if exponent.isdigit() else "NAME", exponent)]
            is_exponent = exponent.isalnum() or exponent == "-1"
            k = end
            if not is_exponent or self.factors_end(k) is None:
                return False
        behind = self.factors_end(k)
        if behind is None:
            return False
        self.head(name, token)
        if self.partner.get(k) == behind - 1 and self.text_at(k) in OPENING:  # parentheses of its own
            self.skipped |= {k, behind - 1}
        self.later(behind, ("RPAR", ")"), *power)
        self.k = k
        return True

    def inverse(self, token: Token) -> str:
        r"""asin for \sin^{-1}: what it means in books, and no reciprocal."""
        name = f"a{token.text}"
        if name not in FUNCTION_NAMES:
            said = f"{token.text}^(-1) can be read in two ways"
            hint = f"write 1/{token.text}(x) for the reciprocal"
            raise ParseError(said, text=self.text, position=token.start, length=len(token.text), hint=hint)
        return name

    def factors_end(self, k: int) -> int | None:
        """The number of the token behind the argument of a function, x, 2x, x^2 or (x), with letters before it."""
        end = k
        if self.kind_at(end) == "NUMBER":
            end += 1
        if self.kind_at(end) == "WORD" and not is_function(self.text_at(end)):
            end = self.letters_end(end, after_number=end > k)
        elif self.kind_at(end) != "NUMBER" and (end == k or self.text_at(end) in _FRACTIONS | {"\\sqrt"}):
            end = self.operand_end(end) or end
        if end == k:
            return None
        is_call = end - 1 in self.partner.values() and self.text_at(k) == "("
        if self.text_at(end) in _POWERS and not is_call:
            end = self.operand_end(end + 1) or end
        elif self.kind_at(end) == "SUPERSCRIPT" and not is_call:
            end += 1
        return end

    def letters_end(self, k: int, *, after_number: bool) -> int:
        """The number of the token behind the letters up to one that usually is a variable; else behind the first one."""
        if self.text_at(k) in _VARIABLES:
            return k + 1
        for last in range(k, min(k + _MOST, len(self.scan))):
            text = self.text_at(last)
            if self.kind_at(last) != "WORD" or not _is_name(text) or self.kind_at(last + 1) == "PRIMES":
                break
            if text in _VARIABLES:
                return last + 1
        return k + 1

    def word(self, token: Token) -> bool:
        """A name, with its primes."""
        self.k += 1
        primes = self.scan[self.k] if self.kind_at(self.k) == "PRIMES" else None
        if primes is not None and primes.start <= token.end and not self.is_quote_of_maxima():
            self.k += 1
            self.write("PRIMED", token.text + "'" * _count(primes), Token("", "", token.start, primes.end))
        else:
            kind = "OTHERWISE" if token.text in _OTHERWISE else "NAME"
            self.write(kind, token.text, token)
        return True

    def is_quote_of_maxima(self) -> bool:
        return self.scan[self.k].text == "'" and self.text_at(self.k + 1) in DERIVATIVES

    def indices(self) -> None:
        """y_xx and y_x: derivatives as indices, where one is of second order and no derivative is written otherwise."""
        second = next((found for row in self.found if (found := _SECOND_INDEX.fullmatch(row[1]))), None)
        others = {row[0] for row in self.found if row[1] in DERIVATIVES or row[0] == "PRIMED"}
        if second is None or others:
            return
        y, x = second.groups()
        derivatives = {f"{y}_{x}{x}": 2, f"{y}_{x}": 1}
        for k in range(len(self.found) - 1, -1, -1):
            _, piece, start, end = self.found[k]
            if piece in derivatives:
                call = [("HEAD", "diff"), ("LPAR", "("), ("NAME", y), *_by(x, derivatives[piece])]
                self.found[k : k + 1] = [(*token, start, end) for token in call]

    # ------------------------------------------------------------------------------------------- signs

    def opening(self, token: Token) -> bool:
        """A parenthesis, the argument of a name before it or a factor."""
        k = self.k
        if token.text == "{" and k not in self.partner and self.latex:
            hint = "write for example (x^2 + 1)/(2*x), y''"
            raise ParseError("a brace is never closed", text=self.text, position=token.start, hint=hint)
        self.k += 1
        if token.text == "{" and self.text_at(k + 1) == "(" and self.partner.get(k + 1) == self.partner.get(k, 0) - 1:
            self.skipped.add(self.partner[k])  # y{\left(x\right)}, as SymPy prints it
            return True
        if self.is_application(token, k):
            self.found[-1] = ("HEAD", *self.found[-1][1:])
        self.write("LPAR", "(", token)
        return True

    def is_application(self, token: Token, k: int) -> bool:
        """True if the parenthesis is the argument of the name before it."""
        if k == 0 or not self.found or self.found[-1][0] not in ("NAME", "PRIMED") or self.closers.get(k):
            return False
        if not self.latex or self.condition or self.argument_end(k) is not None:
            return token.text != "{" or not self.latex
        name = self.found[-1][1]
        return token.text == "(" and (is_function(name) or (name in _STEPS and self.words[name] == 1))

    def fraction(self, token: Token) -> bool:
        groups = self.groups(self.k + 1)
        if groups is None:
            return self.incomplete(token)
        self.write("LPAR", "(", token)
        self.k += 1
        self.grouped(groups[0], groups[1], ("SLASH", "/"))
        self.grouped(groups[2], groups[3], ("RPAR", ")"))
        return True

    def grouped(self, begin: int, end: int, *behind: tuple[str, str]) -> None:
        """Puts an operand into parentheses, if it has none."""
        if begin in self.partner:
            self.later(end, *behind)
            return
        self.closers.setdefault(begin, []).append(("LPAR", "("))
        if begin == self.k:
            self.close()
        self.later(end, ("RPAR", ")"), *behind)

    def incomplete(self, token: Token) -> bool:
        hint = "write for example (x^2 + 1)/(2*x), y''"
        raise ParseError("something is missing behind this", text=self.text, position=token.start, hint=hint)

    def root(self, token: Token) -> bool:
        r"""\sqrt{x}, \sqrt[3]{x}, √x, √(x+1), ∛x."""
        k = self.k + 1
        index = "3" if token.text == "∛" else ""
        if token.text == "\\sqrt" and self.text_at(k) == "[" and k in self.partner:
            index = self.compact(k, self.partner[k])
            k = self.partner[k] + 1
        end = self.operand_end(k)
        is_clear = token.text == "\\sqrt" or self.text_at(k) == "(" or self.is_end_of_factor(k + 1)
        if end is None or not is_clear or (index and not index.isdigit()):
            return False
        if index:
            self.later(
                end,
                ("CIRCUMFLEX", "^"),
                ("LPAR", "("),
                ("NUMBER", "1"),
                ("SLASH", "/"),
                ("NUMBER", index),
                ("RPAR", ")"),
            )
        else:
            self.write("HEAD", "sqrt", token)
        self.k = k
        self.grouped(k, end)
        return True

    def is_end_of_factor(self, k: int) -> bool:
        """False before a power, which might belong to the root or to what is under it."""
        return self.text_at(k) not in (*_POWERS, "(") and self.kind_at(k) != "SUPERSCRIPT"

    def dotted(self, token: Token) -> bool:
        k = self.k + 1
        inside = k + 1 if self.text_at(k) == "{" else k
        if self.kind_at(inside) != "WORD" or (inside > k and self.partner.get(k) != inside + 1):
            return self.incomplete(token)
        return self.primed(self.text_at(inside), len(_DOTS[token.text]), token, inside + 1 + (inside > k))

    def bar(self, token: Token) -> bool:
        if self.k in self.bars:
            self.head("abs", token)
        elif self.k in self.bars.values():
            self.write("RPAR", ")", token)
        else:
            return False
        self.k += 1
        return True

    def raised_primes(self, token: Token) -> bool:
        r"""y^{\prime\prime}, y^{(2)}."""
        if not self.found or self.found[-1][0] not in ("NAME", "PRIMED"):
            return False
        if self.kind_at(self.k + 1) != "PRIMES" and self.text_at(self.k + 1) not in OPENING:
            return False
        for pattern in _RAISED_PRIMES[not self.latex :]:
            found = self.match(pattern, self.k)
            if found is not None:
                count = int(found[0][1]) if found[0][1].isdigit() else len(found[0][1].replace('"', "''"))
                _, piece, start, _ = self.found[-1]
                self.found[-1] = ("PRIMED", piece + "'" * count, start, self.scan[found[1] - 1].end)
                self.k = found[1]
                return True
        return False

    def percent(self, token: Token) -> bool:
        """Maxima's %e, %i, %pi."""
        following = self.text_at(self.k + 1)
        if following not in ("e", "i", "pi"):
            return False
        self.write("NAME", {"i": "I"}.get(following, following), token)
        self.k += 2
        return True

    def dollar(self, token: Token) -> bool:
        """Maple's x$2."""
        is_order = self.kind_at(self.k - 1) == "WORD" and self.kind_at(self.k + 1) == "NUMBER"
        if not is_order:
            return False
        self.write("COMMA", ",", token)
        self.k += 1
        return True

    def greek(self, token: Token) -> bool:
        r"""Mathematica's \[Alpha]; a digit behind it belongs to the name."""
        if self.text_at(self.k + 2) != "]":
            return False
        name = self.text_at(self.k + 1).lower()
        self.k += 3
        if self.kind_at(self.k) == "NUMBER" and self.scan[self.k].start == self.scan[self.k - 1].end:
            name += self.text_at(self.k)
            self.k += 1
        self.write("NAME", name, token)
        return True

    def ordinary(self, token: Token) -> bool:
        """A number or a sign that is one everywhere."""
        kind = token.kind
        if kind == "SIGN":
            if token.text not in _KINDS:
                return False
            kind = _KINDS[token.text]
        self.k += 1
        self.write(kind, _PLAIN.get(kind, token.text), token)
        return True


_Rule = Callable[[_Translation, Token], bool]
#: What a sign, a command or else a kind of token may begin, the first rule that applies.
_RULES: dict[str, tuple[_Rule, ...]] = {
    "NUMBER": (_Translation.ordinary,),
    "SUPERSCRIPT": (_Translation.ordinary,),
    "SIGN": (_Translation.ordinary,),
    "PRIMES": (_Translation.primes,),
    "WORD": (
        _Translation.derivative,
        _Translation.at_point,
        _Translation.several,
        _Translation.prefix,
        _Translation.synonym,
        _Translation.function,
        _Translation.word,
    ),
    **dict.fromkeys(_FRACTIONS, (_Translation.derivative, _Translation.fraction)),
    **dict.fromkeys(_DOTS, (_Translation.dotted,)),
    **dict.fromkeys(("\\sqrt", "√", "∛"), (_Translation.root,)),
    "\\[": (_Translation.greek,),
    "(": (_Translation.derivative, _Translation.several, _Translation.opening),
    "{": (_Translation.derivative, _Translation.opening),
    "[": (_Translation.opening,),
    ".": (_Translation.method,),
    "^": (_Translation.raised_primes, _Translation.ordinary),
    "|": (_Translation.bar,),
    "%": (_Translation.percent,),
    "$": (_Translation.dollar,),
}
#: Characters one of which a text has if the rule applies anywhere in it: d/dx, D or diff, subs, a quotation mark or a point.
_NEEDED: dict[_Rule, str] = {
    _Translation.derivative: "d",
    _Translation.several: "Df",
    _Translation.at_point: "b",
    _Translation.prefix: "'\".",
}
_MARKS = frozenset("".join(_NEEDED.values()))


@lru_cache(maxsize=128)
def _rules_for(marks: frozenset[str]) -> dict[str, tuple[_Rule, ...]]:
    """The rules that may apply in a text with these of the characters that rules need."""
    idle = {rule for rule, needed in _NEEDED.items() if marks.isdisjoint(needed)}
    return {key: tuple(rule for rule in rules if rule not in idle) for key, rules in _RULES.items()}


#: The order of a derivative as an exponent, the first form in LaTeX alone.
_RAISED_PRIMES = [re.compile(r"\^\(\(([1-4])\)\)"), re.compile(r"\^\(?(['\"]+)\)?")]


def _by(x: str, order: int) -> list[tuple[str, str]]:
    """The end of a call of diff."""
    return [("COMMA", ","), ("NAME", x), ("COMMA", ","), ("NUMBER", str(order)), ("RPAR", ")")]


def _count(primes: Token) -> int:
    return len(primes.text.replace('"', "''"))


def partners(scan: Sequence[Token]) -> dict[int, int]:
    """The number of the bracket that closes, by that of the one that opens."""
    found: dict[int, int] = {}
    opened: list[int] = []
    for k, token in enumerate(scan):
        if token.text in OPENING:
            opened.append(k)
        elif token.text in CLOSING and opened:
            found[opened.pop()] = k
    return found


def _bars(scan: Sequence[Token]) -> dict[int, int]:
    """The number of the bar that closes |x|, by that of the one that opens; a bar is closed within the same brackets."""
    found: dict[int, int] = {}
    opened: list[int | None] = [None]
    for k, token in enumerate(scan):
        if token.text in OPENING:
            opened.append(None)
        elif token.text in CLOSING and len(opened) > 1:
            opened.pop()
        elif token.text == "|" and opened[-1] is None:
            opened[-1] = k
        elif token.text == "|":
            found[opened[-1]] = k  # type: ignore[index]
            opened[-1] = None
    return found


def _calls_with_brackets(scan: Sequence[Token]) -> bool:
    """True where a name is followed by a bracket at once, as in Mathematica."""
    pairs = pairwise(scan)
    return any(b.text == "[" and a.end == b.start and a.kind in ("WORD", "PRIMES") for a, b in pairs)


def tokens_of(text: str, limits: Limits, *, what: str, hint: str | None = None) -> Tokens:
    """The tokens of a text that isn't empty and not too long; `what` it is and the `hint` are for the message."""
    check_length(text, limits, what=what)
    tokens = tokenize(text)
    if len(tokens.kinds) == 1:
        raise ParseError(f"there is no expression: {what} is empty", text=text, position=0, hint=hint)
    return tokens


def tokenize(text: str) -> Tokens:
    """The tokens of an expression.  Raises `ParseError` for what has no meaning."""
    return translated(text, scanned(text))

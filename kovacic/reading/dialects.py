"""Notations of several tokens whose parts may be anything: fractions, roots, bars, functions without parentheses, derivatives.

`in_own_notation` goes through the tokens once, from left to right.  A rule looks at the next token, takes the tokens of its
notation, and writes tokens of the parser's grammar; those that belong behind a bracket or factor still to be read wait in
`closers`.  Every token keeps its place in the user's text.

>>> in_own_notation("", Tokens(scanned(r"\\frac{d^2y}{dx^2} = x^{2} \\sin^2 \\omega x"))).pieces
['diff', '(', 'y', ',', 'x', ',', '2', ')', '=', 'x', '^', '(', '2', ')', 'sin', '(', 'omega', 'x', ')', '^', '2', '']
"""

from __future__ import annotations

import re
from collections.abc import Callable

from kovacic.errors import ParseError
from kovacic.limits import check_time
from kovacic.reading.lexer import DERIVATIVES, DOTS, PRIME, SUPERSCRIPT_DIGITS, Token, error_at, scanned, unexpected
from kovacic.reading.names import (
    BARE,
    FUNCTION_NAMES,
    GREEK,
    LETTER,
    SPECIAL_LETTERS,
    STEP_LETTERS,
    is_function,
    is_letter,
    pairs,
    unglued,
)
from kovacic.reading.notations import CLOSING, LATEX, NOTATIONS, OPENING, ParserTokens, Tokens, primes_of, rewritten
from kovacic.reading.parser import DEEPEST

_SIGN_KINDS = pairs(
    "+ PLUS  - MINUS  * STAR  .* STAR  / SLASH  ./ SLASH  ^ CIRCUMFLEX  ** CIRCUMFLEX  .^ CIRCUMFLEX  , COMMA  = EQUAL"
    "  == EQUAL  ( LPAR  [ LPAR  { LPAR  ) RPAR  ] RPAR  } RPAR  < COMPARISON  > COMPARISON  <= COMPARISON  >= COMPARISON"
)
#: The condition of the last of several pieces.
_LAST_CASE = ("True", "otherwise")
_POWERS = ("^", "**")

#: The kinds of the texts that rules write; all others are numbers and names.
_WRITTEN_KINDS = {**_SIGN_KINDS, "diff": "HEAD", "True": "OTHERWISE"}
#: How tokens of a kind are written, however they were.
_WRITTEN_AS = pairs("LPAR ( RPAR ) EQUAL = STAR * SLASH /")

#: Commands, and letters between dollar signs, that mean nothing.
LAYOUT = frozenset(
    r"""
    \, \; \! \: \[ \] \( \) \\ \quad \qquad \left \right \bigl \bigr \big \Big \bigg \Bigl \Bigr \limits \displaystyle \rm
    \boxed \nonumber \notag &
    """.split()  # noqa: SIM905
) | {"\\ "}
#: Commands about a name that is set upright, or in another style.
_STYLES = frozenset(r"\operatorname \mathrm \mathop \mathit \mathbf \text \textrm \textit".split())  # noqa: SIM905
FRACTIONS = frozenset({"\\frac", "\\dfrac", "\\tfrac", "\\cfrac"})
#: Commands that are read later.
_MACROS = FRACTIONS | {"\\sqrt", "\\dot", "\\ddot", "\\dddot"}
#: The texts that other commands stand for.
_COMMANDS = {
    **pairs(
        r"\cdot *  \times *  \div /  \infty oo  \prime '  \imath I  \partial d  \vert |  \lvert |  \rvert |  \mid |"
    ),
    **pairs(r"\{ (  \lbrace (  \lbrack [  \} )  \rbrace )  \rbrack ]"),
    **{f"\\{name}": name for name in (*GREEK, *SPECIAL_LETTERS, *BARE)},
    **{f"\\var{name}": name for name in GREEK},
}
#: Words that are one name in LaTeX without a backslash, too; mu and nu may be products.
_LATEX_WORDS = sorted(
    (*FUNCTION_NAMES, *(name for name in GREEK if len(name) > 2), "pi", "diff", "Piecewise", "True"),
    key=len,
    reverse=True,
)
_LATEX_PARTS = re.compile(rf"(?:{'|'.join(_LATEX_WORDS)})(?![A-Za-z])|[^\W\d_](?:_[A-Za-z0-9])?|[0-9]+|_")


_EXAMPLE = "write for example (x^2 + 1)/(2*x), y''"


class _Latex:
    """The tokens of a text in LaTeX as those of other texts: letters are names, commands are signs and words."""

    def __init__(self, text: str, scan: Tokens) -> None:
        self.text = text
        self.scan = scan
        self.found = Tokens()
        self.k = 0

    def ordinary(self) -> Tokens:
        while self.k < len(self.scan):
            token = self.scan[self.k]
            kind, text = token[:2]
            if text in _COMMANDS:
                kind, text = scanned(_COMMANDS[text])[0][:2]
            self.k += 1
            if token.kind == "WORD":
                self.letters(token)
            elif text in _STYLES:
                self.upright(token)
            elif text == "_":
                self.index()
            elif text.isdecimal() and self.found and self.found[-1].text in FRACTIONS:
                # Of \frac12 each digit is an argument.
                first = token.start
                self.found += [Token("NUMBER", digit, first + k, first + k + 1) for k, digit in enumerate(token.text)]
            elif kind == "COMMAND" and text not in LAYOUT and text not in _MACROS:
                shown = text if text.isprintable() else repr(text)
                raise self.error(f"{shown} isn't a command that is read here", token)
            elif text not in LAYOUT:
                self.found.append(token._replace(kind=kind, text=text))
        return self.found

    def letters(self, word: Token) -> None:
        is_word = len(word.text) > 4 and word.text.isalpha() and unglued(word.text).count("*") == len(word.text) - 1
        if is_word and word.text not in _LATEX_WORDS:
            raise self.error(f"{word.text} is a word that isn't known here", word, "leave it out, or write *")
        for part in _LATEX_PARTS.finditer(word.text):
            if part[0] == "_":
                self.index()
                continue
            kind = "NUMBER" if part[0].isdigit() else "WORD"
            last = min(word.start + part.end(), word.end)
            self.found.append(Token(kind, part[0], min(word.start + part.start(), last), last))

    def upright(self, command: Token) -> None:
        r"""\mathrm{d}, \operatorname{sech}, \text{eff}: a name, of which the braces are no parentheses."""
        if [token.kind for token in self.scan[self.k : self.k + 1]] == ["WORD"]:  # \mathrm dt
            return
        group = self.group()
        name = "".join(token.text for token in group)
        if not (len(name) == 1 or is_function(name) or name in GREEK):
            hint = "leave words out; functions are sin, exp, log, erf and the like"
            raise self.error(f"{name} isn't a function that is read here", command, hint)
        self.found.append(Token("WORD", name, command.start, group[-1].end))

    def group(self) -> list[Token]:
        """The tokens in the braces that follow, or the one that follows; they are passed over."""
        first = self.k
        if self.scan[first : first + 1] and self.scan[first].text == "{":
            closing = self.scan.partners.get(first)
            if closing is None:
                raise self.error("a brace is never closed", self.scan[first])
            self.k = closing + 1
            return list(self.scan[first + 1 : closing])
        self.k = min(first + 1, len(self.scan))
        return list(self.scan[first : self.k])

    def index(self) -> None:
        name = self.found[-1] if self.found else self.scan[self.k - 1]
        group = [token for token in self.group() if token.text not in _STYLES and token.text not in "{}"]
        index = "".join(token.text.removeprefix("\\") for token in group)
        if name.kind != "WORD" or not group:
            raise self.error("an index belongs to a name", self.scan[self.k - 1])
        if not index.isalnum():
            said = f"the index of {name.text} is {index}, and an index has letters and digits alone"
            raise self.error(said, group[0])
        self.found[-1] = Token("WORD", f"{name.text}_{index}", name.start, group[-1].end)

    def error(self, message: str, token: Token, hint: str = _EXAMPLE) -> ParseError:
        return error_at(self.text, message, [token], hint)


#: d^2 y/dx^2, d^2 P_l/dx^2, d y(x)/dx, d/dx without brackets.
_LEIBNIZ = re.compile(rf"d\^?([2-9]?)({LETTER}(?:_(?:[0-9]+|[A-Za-z]))?)?(?:{LETTER})?/d({LETTER})\^?\1")
#: \partial_x, ∂ₓₓ.
_INDEXED_OPERATOR = re.compile(r"d_([a-z])\1*")
#: Letters that end the argument of a function without parentheses, as in cos omega t.
_VARIABLES = frozenset("xtzsr") | {"theta", "phi", "tau", "xi", "rho"}


def in_own_notation(text: str, scan: Tokens, *, condition: bool = False) -> ParserTokens:
    """The tokens of an expression or equation, in which `NOTATIONS` are rewritten but for those that LaTeX hides.

    In a `condition` the unknown function stands at points.  Raises `ParseError` for tokens without a meaning in any notation.
    """
    scan = Tokens(token for token in scan if token.kind != "NEWLINE")
    latex = any(token.kind == "COMMAND" for token in scan) or _BRACES.search(scan.spaced) is not None
    if latex:
        scan = rewritten(_Latex(text, scan).ordinary(), LATEX)
    first = scan.mismatched()
    if first is not None:
        opening, closing = scan[first], scan[scan.partners[first]]
        said = f"{closing.text} closes {opening.text}, a bracket of another kind"
        raise error_at(text, said, [opening, closing], "brackets come in pairs: (...), [...], {...}")
    return _Translation(text, scan, latex=latex, condition=condition).tokens()


#: An exponent or an index in braces.
_BRACES = re.compile(r"(?:(?<!\S)\^|_) +\{")


class _Translation:
    """One pass over the tokens, number `k` of which is the next one."""

    def __init__(self, text: str, scan: Tokens, *, latex: bool, condition: bool) -> None:
        self.text = text
        self.scan = scan
        #: The texts and kinds of the tokens, and empty ones behind the last token.
        self.texts = [*(token.text for token in scan), *[""] * 4]
        self.kinds = [*(token.kind for token in scan), *[""] * 4]
        self.latex = latex
        self.condition = condition
        self.k = 0
        self.found: list[Token] = []
        #: The numbers in `found` of the parentheses that are open, and of the one that was closed last.
        self.opened: list[int] = []
        self.closed = 0
        #: Texts to be written before a token, by its number.
        self.closers: dict[int, list[str]] = {}
        self.skipped: set[int] = set()
        self.partner = {k: last for k, last in scan.partners.items() if self.texts[k] != "|"}
        self.closing_bars = {last for k, last in scan.partners.items() if self.texts[k] == "|"}

    def tokens(self) -> ParserTokens:
        while self.k < len(self.scan):
            check_time()
            self.close()
            token = self.scan[self.k]
            if self.k in self.skipped:
                self.k += 1
                continue
            if not any(rule(self, token) for rule in _TOKEN_RULES.get(token.text) or _TOKEN_RULES[token.kind]):
                raise unexpected(self.text, token)
        for k in sorted(self.closers):
            self.k = k
            self.close()
        end = len(self.text)
        variable = "t" if any(DOTS in text for text in self.texts) else None
        return ParserTokens([*self.found, Token("$END", "", end, end)], self.text, variable)

    def write(self, text: str, token: Token | None = None, kind: str = "") -> None:
        """A token where the `token` stands, or behind what was written before."""
        kind = kind or _WRITTEN_KINDS.get(text) or ("NUMBER" if text.isdigit() else "NAME")
        if token is None:
            here = self.scan[min(self.k, len(self.scan)) - 1].end if self.k else self.scan[0].start
            token = Token("", "", here, here)
        if kind == "LPAR":
            self.opened.append(len(self.found))
        elif kind == "RPAR":
            self.closed = self.opened.pop() if self.opened else -1
        self.found.append(Token(kind, text, token.start, token.end))

    def close(self) -> None:
        for text in self.closers.pop(self.k, ()):
            self.write(text)

    def later(self, k: int, *texts: str) -> None:
        """Write texts before token k, ahead of those that wait there already."""
        self.closers[k] = [*texts, *self.closers.get(k, [])]

    def head(self, name: str, token: Token) -> None:
        self.write(name, token, "HEAD")
        self.write("(")

    def compact(self, begin: int, end: int) -> str:
        """The tokens without brackets, for comparison."""
        texts = [text for text in self.texts[begin:end] if text not in OPENING and text not in CLOSING]
        return "".join(texts).replace("**", "^").translate(SUPERSCRIPT_DIGITS)

    def operand_end(self, k: int, depth: int = 0) -> int | None:
        """The number of the token behind the one operand that begins with number k, or None."""
        text = self.texts[k]
        if depth > DEEPEST:
            return None
        if k in self.scan.partners:
            return self.scan.partners[k] + 1
        if text in FRACTIONS:
            middle = self.operand_end(k + 1, depth + 1)
            return middle and self.operand_end(middle, depth + 1)
        if text == "\\sqrt":
            index = self.partner.get(k + 1, k) if self.texts[k + 1] == "[" else k
            return self.operand_end(index + 1, depth + 1)
        if self.kinds[k] not in ("NUMBER", "WORD"):
            return None
        if text in BARE and k + 1 not in self.partner:  # in sin cos x, and d/dx sin x
            return self.factors_end(self.power_end(k + 1), depth + 1)
        end = k + 2 if self.kinds[k + 1] == "PRIMES" else k + 1
        return (self.kinds[k] == "WORD" and self.argument_end(end)) or end

    def argument_end(self, k: int) -> int | None:
        """The number of the token behind (x) or {(x)}, an argument that is one letter; None if that isn't next."""
        last = self.partner.get(k)
        if last is None:
            return None
        is_one = last == k + 2 and self.kinds[k + 1] == "WORD" and is_letter(self.texts[k + 1])
        return last + 1 if is_one or self.argument_end(k + 1) == last else None

    def derivative(self, token: Token) -> bool:
        """d^2y/dx^2, (d^2/dx^2) y, \\frac{d}{dx}(...)."""
        found = self.quotient(self.k)
        if found is None:
            return False
        y, x, order, end = found
        whole = Token("", "", token.start, self.scan[end - 1].end)
        inner = None
        while y is None:  # what follows is differentiated, perhaps more than once
            end += self.texts[end] == "*"
            inner = self.quotient(end)
            if inner is None or inner[:2] != (None, x):
                break
            order, end = order + inner[2], inner[3]
        by = [",", x, ",", str(order), ")"]
        if y is None:
            behind = inner[3] if inner and inner[0] else self.operand_end(end)
            written = ["diff", "("]
            if behind is None:  # d^2/dx^2 - x
                self.write(x, whole, "OPERATOR")
                written = ["^", str(order)]
            else:
                self.later(behind, *by)
        else:
            behind = self.argument_end(end)
            written = ["diff", "(", y, *by]
            if behind is None and self.texts[end] == "(" and self.condition:
                self.write(y + PRIME * order, whole, "PRIMED")
                written = []
            elif behind is not None and self.texts[behind - 2] == x:
                end = behind
        for text in written:
            self.write(text, whole)
        self.k = end
        return True

    def quotient(self, k: int) -> tuple[str | None, str, int, int] | None:
        """y or None, x, the order, and the number of the token behind d^2y/dx^2 or d^2/dx^2; None for anything else."""
        # Within `DEEPEST` tokens: a search to the end would take quadratic time.
        text = self.texts[k]
        closing = self.partner.get(k, k)
        if _INDEXED_OPERATOR.fullmatch(text) and self.text.startswith(("∂", "\\partial"), self.scan[k].start):
            return self.operator(text[2], len(text) - 2, k + 1)
        inner = self.quotient(k + 1) if 0 < closing - k < DEEPEST else None
        if inner is not None and inner[3] == closing:
            y, x, order, _ = inner
            return (y, x, order, closing + 1) if y else self.operator(x, order, closing + 1)
        if text in FRACTIONS:
            middle = self.operand_end(k + 1)
            end = middle and self.operand_end(middle)
        elif (text.startswith("d") or closing > k) and "/" in self.texts[k : k + DEEPEST]:
            middle = self.texts.index("/", k)
            first = middle + 1  # of dx^2, (dx)^2 or (dx^2)
            end = self.power_end(first + 2 if self.texts[first] == "d" else self.partner.get(first, first) + 1)
        else:
            return None
        if middle is None or end is None or end - k > DEEPEST or closing > middle:  # (d/dx + 1)
            return None
        above, below = self.compact(k, middle), self.compact(middle, end)
        found = _LEIBNIZ.fullmatch(f"{above.removeprefix(text)}/{below}" if text in FRACTIONS else above + below)
        return found and (found[2], found[3], int(found[1] or 1), end)

    def operator(self, x: str, order: int, k: int) -> tuple[None, str, int, int] | None:
        """The quotient of an operator, (d/dx)^2, whose exponent begins with number k; None if that isn't a number."""
        power, end = self.exponent(k)
        return (None, x, order * int(power or 1), end) if (power or "1").isdigit() else None

    def method(self, token: Token) -> bool:
        """y(x).diff(x, 2): the operand before the point is differentiated."""
        if not self.found or self.texts[self.k + 1] not in DERIVATIVES or self.texts[self.k + 2] != "(":
            return False
        self.differentiate_last()
        if self.texts[self.k + 3] != ")":
            self.write(",", token)
        self.k += 3
        return True

    def primes(self, token: Token) -> bool:
        """((1 - x^2) y')' and sin(x)': the operand before the primes is differentiated; y(x)'' is y''(x)."""
        if self.texts[self.k - 1] not in CLOSING or self.found[-1][0] != "RPAR":
            return False
        kind, name, start, end = self.found[max(0, self.closed - 1)]
        if kind == "HEAD" and not is_function(name):
            self.found[self.closed - 1] = Token(kind, name + primes_of(token.text), start, end)
            self.k += 1
            return True
        for _ in primes_of(token.text):
            self.differentiate_last()
            self.write(")", token)
        self.k += 1
        return True

    def differentiate_last(self) -> None:
        """Begins a call of diff before the operand that was written last."""
        first = len(self.found) - 1
        if self.found[-1][0] == "RPAR":
            first = max(0, self.closed)
            if first and self.found[first - 1][0] == "HEAD":
                first -= 1
        start = self.found[first][2]
        self.found[first:first] = [Token("HEAD", "diff", start, start), Token("LPAR", "(", start, start)]
        self.opened.append(first + 1)

    def function(self, token: Token) -> bool:
        """sin x, sin 2x, cos omega t, sin^2 x, sin^2(x), sin^{-1}(x), ln|x|."""
        name = token.text
        k = self.k + 1
        power: list[str] = []
        if name not in BARE and not self.latex:
            return False
        exponent, k = self.exponent(k)
        if exponent == "-1":
            name = f"a{token.text}"  # the inverse function, as in books, not the reciprocal
            if name not in FUNCTION_NAMES:
                hint = f"write 1/{token.text}(x) for the reciprocal"
                raise error_at(self.text, f"{token.text}^(-1) can be read in two ways", [token], hint)
        elif exponent.isalnum():
            power = ["^", exponent]
        elif exponent:
            return False
        behind = self.factors_end(k)
        if behind is None:
            return False
        self.head(name, token)
        if self.partner.get(k) == behind - 1:  # parentheses of its own
            self.skipped |= {k, behind - 1}
        self.later(behind, ")", *power)
        self.k = k
        return True

    def exponent(self, k: int) -> tuple[str, int]:
        """The exponent that begins with its sign at number k, empty if there is none, and the number of the token behind it."""
        end = self.power_end(k)
        return self.compact(k, end).removeprefix("^"), end

    def power_end(self, k: int) -> int:
        """The number of the token behind ^2, ^{-2}, ^n or ², beginning at number k; k if there is no exponent."""
        if self.texts[k] not in _POWERS:
            return k + (self.kinds[k] == "SUPERSCRIPT")
        first = k + 1 + (self.texts[k + 1] == "-")
        # A letter alone: in sin^n (x) the parentheses are the argument of the sine.
        return first + 1 if self.kinds[first] == "WORD" else self.operand_end(first) or k

    def factors_end(self, k: int, depth: int = 0) -> int | None:
        """The number of the token behind the argument of a function, x, 2x, x^2 or (x), with letters before it."""
        end = k + (self.kinds[k] == "NUMBER")
        if self.kinds[end] == "WORD" and not is_function(self.texts[end]):
            end = self.letters_end(end)
        elif end == k or self.texts[end] in FRACTIONS | {"\\sqrt"}:
            end = self.operand_end(end, depth) or end
        if end == k:
            return None
        is_call = self.texts[k] in ("(", "[") and self.partner.get(k) == end - 1
        return end if is_call else self.power_end(end)

    def letters_end(self, k: int) -> int:
        """The number of the token behind the letters up to one that usually is a variable; else behind the first one."""
        for last in range(k, len(self.scan)):
            if self.texts[last] in _VARIABLES:
                return last + 1
            if not is_letter(self.texts[last]) or self.kinds[last + 1] == "PRIMES":
                break
        return k + 1

    def word(self, token: Token) -> bool:
        self.k += 1
        primes = self.scan[self.k] if self.kinds[self.k] == "PRIMES" else None
        if primes is not None and primes.start <= token.end:
            self.k += 1
            self.write(token.text + primes_of(primes.text), token._replace(end=primes.end), "PRIMED")
        else:
            self.write(token.text, token, "OTHERWISE" if token.text in _LAST_CASE else "NAME")
        return True

    def prose(self, token: Token) -> bool:
        raise error_at(self.text, f"{token.text} is a word and no part of the equation", [token], "leave it out")

    def opening(self, token: Token) -> bool:
        """A parenthesis, the argument of a name before it or a factor."""
        k = self.k
        if token.text == "{" and k not in self.partner:
            raise error_at(self.text, "a brace is never closed", [token], _EXAMPLE)
        self.k += 1
        if token.text == "{" and self.texts[k + 1] == "(" and self.partner.get(k + 1) == self.partner.get(k, 0) - 1:
            self.skipped.add(self.partner[k])  # y{\left(x\right)}, as SymPy prints it
            return True
        if token.text == "{" and self.texts[max(0, k - 2) : k] == ["Piecewise", "["] and k - 1 in self.partner:
            # Mathematica's Piecewise[{{1, x < 5}}, 2] is Piecewise((1, x < 5), (2, True)); the last value is 0 by default.
            inner, outer = self.partner[k], self.partner[k - 1]
            self.skipped.add(inner)
            default = [",", "(", "0"]
            if self.texts[inner + 1] == ",":
                default = []
                self.later(inner + 2, "(")
            self.later(outer, *default, ",", "True", ")")
            return True
        if self.is_application(token, k):
            self.found[-1] = self.found[-1]._replace(kind="HEAD")
        self.write("(", token)
        return True

    def is_application(self, token: Token, k: int) -> bool:
        """True if the parenthesis is the argument of the name before it."""
        if not self.found or self.found[-1][0] not in ("NAME", "PRIMED"):
            return False
        if not self.latex or self.condition or self.argument_end(k) is not None:
            return token.text != "{" or not self.latex
        name = self.found[-1][1]
        is_step = name in STEP_LETTERS and self.texts.count(name) == 1
        return token.text == "(" and (is_function(name) or name in DERIVATIVES or is_step)

    def fraction(self, token: Token) -> bool:
        middle = self.operand_end(self.k + 1)
        end = middle and self.operand_end(middle)
        if middle is None or end is None:
            raise error_at(self.text, "something is missing behind this", [token], _EXAMPLE)
        self.write("(", token)
        self.k += 1
        self.grouped(self.k, middle, "/")
        self.grouped(middle, end, ")")
        return True

    def grouped(self, begin: int, end: int, *behind: str) -> None:
        """Puts an operand into parentheses, if it has none."""
        if begin in self.partner:
            self.later(end, *behind)
            return
        self.closers.setdefault(begin, []).append("(")
        self.later(end, ")", *behind)

    def root(self, token: Token) -> bool:
        r"""\sqrt{x}, \sqrt[3]{x}, √x, √(x+1), ∛x."""
        k = self.k + 1
        index = "3" if token.text == "∛" else ""
        if token.text == "\\sqrt" and self.texts[k] == "[" and k in self.partner:
            index = self.compact(k, self.partner[k])
            k = self.partner[k] + 1
        end = self.operand_end(k)
        if end is None or (index and not index.isdigit()):
            return False
        if token.text != "\\sqrt" and self.texts[k] != "(":
            self.check_radicand(token, k, end)
        if index:
            self.later(end, "^", "(", "1", "/", index, ")")
        else:
            self.write("sqrt", token, "HEAD")
        self.k = k
        self.grouped(k, end)
        return True

    def check_radicand(self, token: Token, k: int, end: int) -> None:
        """Raise `ParseError` for √x², √xy and √2x, whose radicand is ambiguous."""
        has_power = self.texts[end] == "(" or self.power_end(end) > end
        is_glued = self.kinds[end] == "WORD" and self.scan[end].start == self.scan[end - 1].end
        is_factor = is_glued and not is_function(self.texts[end]) and self.kinds[end + 1] != "PRIMES"
        is_product = self.kinds[k] == "WORD" and not is_letter(self.texts[k])
        if has_power or is_factor or is_product:
            said = "a root without parentheses can be read in two ways"
            hint = f"enclose the radicand in parentheses: {token.text}(...)"
            raise error_at(self.text, said, [token, self.scan[end - is_product]], hint)

    def bar(self, token: Token) -> bool:
        if self.k in self.scan.partners:
            self.head("abs", token)
        elif self.k in self.closing_bars:
            self.write(")", token)
        else:
            return False
        self.k += 1
        return True

    def ordinary(self, token: Token) -> bool:
        kind = _SIGN_KINDS.get(token.text, "") if token.kind == "SIGN" else token.kind
        if not kind:
            return False
        self.k += 1
        self.write(_WRITTEN_AS.get(kind, token.text), token, kind)
        return True


_TokenRule = Callable[[_Translation, Token], bool]
#: The rules for a sign, a command, a function, or else for a kind of token; the first one that applies is used.
_TOKEN_RULES: dict[str, tuple[_TokenRule, ...]] = {
    **dict.fromkeys(("NUMBER", "SUPERSCRIPT", "SIGN"), (_Translation.ordinary,)),
    "WORD": (_Translation.derivative, _Translation.word),
    "PRIMES": (_Translation.primes,),
    "TEXT": (_Translation.prose,),
    "COMMAND": (),
    **dict.fromkeys(FUNCTION_NAMES, (_Translation.function, _Translation.word)),
    **dict.fromkeys(FRACTIONS, (_Translation.derivative, _Translation.fraction)),
    **dict.fromkeys(("\\sqrt", "√", "∛"), (_Translation.root,)),
    "(": (_Translation.derivative, _Translation.opening),
    "{": (_Translation.derivative, _Translation.opening),
    "[": (_Translation.opening,),
    ".": (_Translation.method,),
    "|": (_Translation.bar,),
}


#: This package's own notation alone: whole numbers, single letters with their primes, signs.  Not numbers of lists and
#: equations, "2) y''", "(2) y''", "y'' = y (2)", nor what may begin a comment.
_PLAIN_TEXT = re.compile(
    r"""
    (?! \ * (?: [^ (]{1,2}\ *\) | \(\ *\w+\ *\)\  ) )
    (?: [0-9]+(?![0-9.eE]) | [A-CF-Za-ce-z](?:'+(?!'))?(?![\w'.]) | \*{1,2}(?!\*) | \((?! \* | \ *[0-9]+\ *\)\ *$ )
      | /(?![*/]) | -(?!-) | =(?!=) | [+^)\ ] )+
    """,
    re.VERBOSE | re.ASCII,
)


def is_plain(text: str) -> bool:
    """True for a text in which no notation of another system can occur: it is one equation, or S alone.

    >>> is_plain("y''(x) = -4 y"), is_plain("y'' = sin x")
    (True, False)
    """
    return _PLAIN_TEXT.fullmatch(text) is not None and not text.isspace()


def tokenize(text: str) -> ParserTokens:
    """The tokens of an expression.  Raises `ParseError` for tokens without a meaning."""
    return in_own_notation(text, rewritten(Tokens(scanned(text)), NOTATIONS))

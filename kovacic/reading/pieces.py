"""A text that was pasted, taken apart into pieces with roles, before anything in it is read.

>>> paste = taken_apart("sol := dsolve({diff(y(x),x$2) + y(x) = 0, y(0) = 1, D(y)(0) = 0}, y(x));")
>>> [piece.role for piece in paste.pieces]
['command', 'equation', 'condition', 'condition', 'name']
>>> paste.conditions
(PlacedValue(place='y(0)', value='1'), PlacedValue(place="y'(0)", value='0'))
>>> taken_apart("3. Solve the equation y'' + y = 0;  // easy").notes
('3. was taken for a number in a list', 'left out: Solve the equation')

Comments, numbers of lists and equations, prose, dollar signs, environments of LaTeX, assignments and commands of other systems
are what stands around an equation; values follow it, or are arguments of the command.  What the equation means is found by
`dialects`, `source` and the parser.  Linear time.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from kovacic.errors import ParseError
from kovacic.reading.dialects import CLOSING, LAYOUT, OPENING, partners, translated
from kovacic.reading.lexer import DERIVATIVES, Token, Tokens, scanned
from kovacic.reading.names import GREEK, is_function, is_letter

Scan = Sequence[Token]

#: Commands that solve an equation, in other systems.
_COMMANDS = frozenset(
    "DSolve NDSolve DSolveValue NDSolveValue dsolve desolve ode2 rhs kovacicsols".split()  # noqa: SIM905
)
#: Words between an equation and what is said of it.
_BETWEEN = frozenset("and with where subject such given for if at when".split())  # noqa: SIM905
_FILLERS = frozenset({"to", "that", "the", "conditions", "condition", "initial", "boundary", "by", "values", "value"})
#: Statements that say what names are, and solve nothing.
_DECLARATIONS = frozenset("from import syms with restart clear clc depends assume var init_printing".split())  # noqa: SIM905
_MAKERS = frozenset("symbols Symbol Function function var symfun".split())  # noqa: SIM905
_OPERATORS = frozenset("+ - * / ^ ** = == , := .".split())  # noqa: SIM905
_EQUALS = ("=", "==")
_INEQUALITIES = frozenset({*"<>≤≥≠", "<=", ">="})
_ENVIRONMENTS = ("\\begin", "\\end", "\\label", "\\tag", "\\ref")
_TEXTS = ("\\text", "\\textrm", "\\mbox", "\\textnormal")
#: With what else than a command comments and layout begin.
_AROUND = frozenset("( / - # % $ \\".split()) | LAYOUT  # noqa: SIM905
_PROMPTS = ([">", ">", ">"], [">", ">"], [">"], ["sage", ":"], ["In", "[", "*", "]", ":="], ["(", "%", "*", ")"])
BOUNDED = "bounded"


_FRACTIONS = frozenset({"/", "\\frac", "\\dfrac", "\\tfrac"})
#: What no derivative is without, if it isn't written with primes or dots: the d of dy/dx, or an index.
_DIFFERENTIAL = re.compile(r"d|_|\\partial")
#: D2y and y_xx.
_SECOND_ORDER = re.compile(r"D[23]\w|[a-zA-Z]_([xtzsr])\1")


class PastedPiece(NamedTuple):
    """A part of a text, and what it is.

    The roles are equation, condition, name (of the unknown function or the variable in a command), command, declaration,
    number (in a list), prose, comment, remark (an inequality).
    """

    role: str
    scan: tuple[Token, ...]

    @property
    def span(self) -> tuple[int, int]:
        return (self.scan[0].start, self.scan[-1].end) if self.scan else (0, 0)


class PlacedValue(NamedTuple):
    """A condition: y'(0), or what is linear in such, and its value."""

    place: str
    value: str


@dataclass
class Paste:
    """A text with its pieces; `variable` is one that a command names, `notes` say what was left out."""

    text: str
    pieces: list[PastedPiece] = field(default_factory=list)
    variable: str | None = None
    notes: tuple[str, ...] = ()

    def scans(self, role: str) -> list[tuple[Token, ...]]:
        return [piece.scan for piece in self.pieces if piece.role == role]

    @cached_property
    def is_equation(self) -> bool:
        """True for an equation, false for S alone."""
        return any(map(_is_equation, self.scans("equation")))

    @cached_property
    def equations(self) -> list[Tokens]:
        return [translated(self.text, scan) for scan in self.scans("equation")]

    @cached_property
    def conditions(self) -> tuple[PlacedValue, ...]:
        return tuple(given for scan in self.scans("condition") for given in _given(self.text, scan))

    def error(self, message: str, scan: Scan, hint: str) -> ParseError:
        return _error(self.text, message, scan, hint)

    def equation_text(self) -> str:
        """The equation as the user wrote it."""
        scan = self.scans("equation")[0]
        return self.text[scan[0].start : scan[-1].end]


def _error(text: str, message: str, scan: Scan, hint: str) -> ParseError:
    start, end = (scan[0].start, scan[-1].end) if scan else (0, len(text))
    return ParseError(message, text=text, position=start, length=max(1, end - start), hint=hint)


def taken_apart(text: str) -> Paste:
    """The pieces of a text.  Raises `ParseError` for arguments of a command that say nothing about the equation."""
    return _Apart(text).paste()


def conditions_in(text: str) -> tuple[PlacedValue, ...]:
    """Conditions that stand alone: "y(0) = 1, y'(0) = 0".  Raises `ParseError` for anything else."""
    apart = _Apart(text)
    found: list[PlacedValue] = []
    for statement in apart.statements(apart.lines()):
        found += _given(text, statement)
    return tuple(found)


def _is_equation(scan: Scan) -> bool:
    """True if an equals sign, a prime or a derivative occurs."""
    for k, token in enumerate(scan):
        following = scan[k + 1].text if k + 1 < len(scan) else ""
        if token.text in _EQUALS or (token.kind == "PRIMES" and k) or token.text in ("\\dot", "\\ddot", "\\prime"):
            return True
        if token.text in DERIVATIVES and following in OPENING and following:
            return True
    texts = [token.text for token in scan]
    if not _FRACTIONS.isdisjoint(texts):
        return _DIFFERENTIAL.search(" ".join(texts)) is not None and "diff" in _pieces_of(scan)
    return any(map(_SECOND_ORDER.fullmatch, texts))


def _pieces_of(scan: Scan) -> list[str]:
    try:
        return translated("", scan).pieces
    except ParseError:
        return []


class _Apart:
    """Goes through the tokens of a text once for each kind of what stands around an equation."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.notes: list[str] = []
        self.found: list[PastedPiece] = []
        self.variable: str | None = None
        #: Statements that have names.
        self.named: dict[str, list[Token]] = {}

    def paste(self) -> Paste:
        statements = [list(statement) for statement in self.statements(self.lines())]
        for k, statement in enumerate(statements):
            self.statement(statement, is_alone=len(statements) == 1, is_last=k == len(statements) - 1)
        if not any(piece.role == "equation" for piece in self.found):
            self.found += [PastedPiece("equation", tuple(scan)) for scan in list(self.named.values())[-1:]]
        self.found = self.sorted_roles()
        return Paste(self.text, self.found, self.variable, tuple(self.notes))

    # -------------------------------------------------------------------------------------- around the text

    def lines(self) -> list[Token]:
        """The tokens without comments, dollar signs and environments."""
        scan = scanned(self.text)
        found: list[Token] = []
        k = 0
        while k < len(scan):
            if scan[k].kind != "COMMAND" and scan[k].text not in _AROUND:
                found.append(scan[k])
                k += 1
                continue
            end = self.comment_end(scan, k)
            if end is not None:
                self.found.append(PastedPiece("comment", tuple(scan[k:end])))
                k = end
                continue
            k = self.layout(scan, k, found)
        if (
            found
            and found[0].text == "{"
            and "\\displaystyle" in self.text
            and partners(found).get(0) == len(found) - 1
        ):
            found = found[1:-1]  # as Wikipedia has its formulas
        quotes = [k for k in (0, -1) if found and found[k].text in ("'", '"', "`", "```")]
        if len(quotes) == 2 and len(found) > 2 and found[0].text == found[-1].text and not _is_primed(found[-2:]):
            found = found[1:-1]
        return found

    def comment_end(self, scan: Scan, k: int) -> int | None:
        """The number of the token behind a comment that begins with number k."""
        text = scan[k].text
        two = text + (scan[k + 1].text if k + 1 < len(scan) and scan[k + 1].start == scan[k].end else "")
        if two in ("(*", "/*"):
            closing = two[::-1].replace("(", ")")
            for j in range(k + 2, len(scan) - 1):
                if scan[j].text + scan[j + 1].text == closing:
                    return j + 2
            return None
        if two == "//" or two == "--":
            first = k + 2
        elif text in ("#", "%"):
            first = k + 1
        else:
            return None
        is_apart = k == 0 or scan[k - 1].end < scan[k].start or scan[k - 1].kind == "NEWLINE"
        is_prose = first < len(scan) and (_is_prose(scan[first]) or scan[first].text in ("hi", "a", "an", "is", "no"))
        is_whole_line = two != "--" and (k == 0 or scan[k - 1].kind == "NEWLINE")
        if not is_apart or not (is_prose or is_whole_line):
            return None
        return next((j for j in range(k, len(scan)) if scan[j].kind == "NEWLINE"), len(scan))

    def layout(self, scan: Scan, k: int, found: list[Token]) -> int:
        """Takes a token, or leaves what is layout; the number of the next one."""
        token = scan[k]
        following = scan[k + 1] if k + 1 < len(scan) else None
        if token.text in _ENVIRONMENTS:
            end = k + 1
            while end < len(scan) and scan[end - 1].text != "}" and end - k < 12:
                end += 1
            found.append(token._replace(kind="NEWLINE", text="\n"))
            return end
        if token.text in _TEXTS and following is not None and following.text == "{":
            end = k + 2
            while end < len(scan) and scan[end].text != "}":
                end += 1
            words = scan[k + 2 : end]
            is_name = len(words) == 1 and (is_function(words[0].text) or len(words[0].text) == 1)
            is_index = (bool(found) and found[-1].text.endswith("_")) or (
                len(found) > 1 and found[-2].text.endswith("_")
            )
            if not is_name and not is_index and all(word.kind in ("WORD", "SIGN") for word in words):
                found += [word._replace(kind="TEXT") if word.kind == "WORD" else word for word in words]
                return end + 1
        if token.text in ("\\\\", "\\quad", "\\qquad"):
            found.append(token._replace(kind="NEWLINE", text="\n"))
        elif token.text == "\\" and following is None:
            pass
        elif token.text == "$" and self.text.count("$") > 1 and not _is_sequence(scan, k):
            if k and following is not None and scan[k - 1].text != "$" and following.text != "$":
                found.append(token._replace(kind="NEWLINE", text="\n"))
        elif token.text != "&" and (token.text not in LAYOUT or token.text == "\\["):
            found.append(token)
        return k + 1

    # -------------------------------------------------------------------------------------- statements

    def statements(self, scan: Scan) -> Iterator[list[Token]]:
        """What stands between commas, semicolons, words and ends of lines that separate."""
        current: list[Token] = []
        depth = 0
        is_first = True
        for k, token in enumerate(scan):
            depth = max(0, depth + (token.text in OPENING) - (token.text in CLOSING))
            if depth == 0 and self.separates(scan, k, current):
                yield from [current] * bool(current)
                is_first = is_first and not current
                current = []
            elif token.kind != "NEWLINE" and (current or is_first or token.text not in (*_FILLERS, *_BETWEEN)):
                current.append(token)
        yield from [current] * bool(current)

    def separates(self, scan: Scan, k: int, current: Scan) -> bool:
        token = scan[k]
        if token.text in (";", ","):
            return token.text == ";" or not _is_decimal_comma(scan, k)
        if token.text == ":":  # Maple's other end of a statement
            is_complete = bool(current) and (_has_equals(current) or current[0].text in _DECLARATIONS)
            return is_complete and k + 1 < len(scan)
        if token.text in _BETWEEN:
            return _has_equals(current) and (
                k + 1 == len(scan) or scan[k + 1].kind in ("WORD", "COMMAND", "NEWLINE", "TEXT")
            )
        if token.kind != "NEWLINE" or not current or k + 1 == len(scan):
            return False
        is_complete = _has_equals(current) or current[0].text in _DECLARATIONS
        if not is_complete or current[-1].text in _OPERATORS or scan[k + 1].text in _OPERATORS:
            return False
        rest = scan[k + 1 : k + 200]
        end = next((j for j, t in enumerate(rest) if t.kind == "NEWLINE" or t.text == ";"), len(rest))
        return _has_equals(rest[:end]) or any(t.text in _COMMANDS for t in rest[:end])

    def statement(self, scan: list[Token], *, is_alone: bool, is_last: bool) -> None:
        """Gives a statement its role, without what stands around it."""
        scan = self.without_ends(scan, is_alone=is_alone, is_last=is_last)
        if not scan:
            return
        if scan[0].text in _DECLARATIONS or (len(scan) == 1 and scan[0].text in _COMMANDS):
            self.found.append(PastedPiece("declaration", tuple(scan)))
            return
        name, scan = _without_assignment(scan)
        if scan and scan[0].text in _MAKERS and name:
            self.found.append(PastedPiece("declaration", tuple(scan)))
        elif self.command(scan):
            return
        elif not is_alone and _has_sign(scan, _INEQUALITIES):
            self.notes.append(f"not used: {self.written(scan)}")
            self.found.append(PastedPiece("remark", tuple(scan)))
        elif name:
            self.named[name] = scan
            if is_alone:
                self.equation(scan)
        else:
            self.equation(scan)

    def equation(self, scan: Scan) -> None:
        self.found.append(PastedPiece("equation", tuple(_without_eq(scan))))

    def written(self, scan: Scan) -> str:
        return self.text[scan[0].start : scan[-1].end] if scan else ""

    def without_ends(self, scan: list[Token], *, is_alone: bool, is_last: bool) -> list[Token]:
        """Without prompts, numbers of lists and equations, prose and punctuation."""
        while scan and scan[-1].text in (".", ":", "$", ",") and len(scan) > 1:
            scan = scan[:-1]
        for prompt in _PROMPTS:
            if not scan or scan[0].text != prompt[0]:
                continue
            texts = [token.text for token in scan[: len(prompt)]]
            if len(texts) == len(prompt) and all(b in (a, "*") for a, b in zip(texts, prompt, strict=True)):
                scan = scan[len(prompt) :]
        scan = self.without_number(scan)
        scan = self.without_prose(scan)
        is_numbered = (
            is_last and len(scan) > 4 and [t.text for t in scan[-3::2]] == ["(", ")"] and scan[-2].text.isdigit()
        )
        if is_numbered and scan[-3].start > scan[-4].end and scan[-4].text not in _OPERATORS and _has_equals(scan[:-3]):
            self.notes.append(f"({scan[-2].text}) was taken for the number of the equation")
            self.found.append(PastedPiece("number", tuple(scan[-3:])))
            scan = scan[:-3]
        while scan and scan[-1].text in (".", ":", ","):
            scan = scan[:-1]
        return scan

    def without_number(self, scan: list[Token]) -> list[Token]:
        """Without the number of a list: 3. or (3) or 3) or b)."""
        texts = [token.text for token in scan[:3]]
        length = 0
        if len(scan) > 3 and _has_equals(scan):
            if texts[0].endswith(".") and texts[0][:-1].isdigit() and scan[1].start > scan[0].end:
                length = 1
            elif texts[1] == ")" and len(texts[0]) <= 2:
                length = 2
            elif texts[0] == "(" and texts[1].isdigit() and texts[2] == ")" and scan[3].start > scan[2].end:
                length = 3
        if length:
            self.notes.append(f"{self.written(scan[:length])} was taken for a number in a list")
            self.found.append(PastedPiece("number", tuple(scan[:length])))
        return scan[length:]

    def without_prose(self, scan: list[Token]) -> list[Token]:
        """Without the words before an equation: some of them, or one with a capital letter or a colon."""
        count = 0
        while count < len(scan) and (scan[count].kind in ("WORD", "TEXT") or scan[count].text in ":,."):
            count += 1
        ends = (":", "of", "to", "is", "by", "the")
        while count and not (_is_prose(scan[count - 1]) or scan[count - 1].text in ends):
            count -= 1
        if len(scan) > count + 1 and scan[count + 1].text == ":" and scan[count].kind == "NUMBER":
            count += 2  # Problem 3:
        words = scan[:count]
        prose = [token for token in words if _is_prose(token)]
        is_sentence = len(prose) > 1 or words[-1:] == [Token("SIGN", ":", *words[-1][2:])] if words else False
        is_capital = bool(prose) and prose[0].text.istitle() and len(words) == 1
        if not prose or not (is_sentence or is_capital) or not _is_equation(scan[count:]):
            return scan
        following = scan[count]
        if following.text in ("=", "==", ":=", "*", "/", "^", ")", "(", "[") and not (
            following.text == "(" and is_sentence
        ):
            return scan
        if words[-1].text == ":" and len(words) == 2:  # the name of an equation
            return scan
        self.notes.append(f"left out: {self.written(words)}")
        self.found.append(PastedPiece("prose", tuple(words)))
        return scan[count:]

    # -------------------------------------------------------------------------------------- commands

    def command(self, scan: list[Token]) -> bool:
        """The arguments of a command of another system: its equation, values, and names that occur in the equation."""
        first = next((k for k, token in enumerate(scan[:6]) if token.text in _COMMANDS), None)
        if first is None or first + 1 == len(scan):
            return self.list_of(scan)
        partner = partners(scan)
        opening = next((k for k in range(first + 1, min(first + 4, len(scan))) if scan[k].text in ("(", "[")), 0)
        if scan[opening - 1].text == "]":
            opening = opening
        if not opening or partner.get(opening) != len(scan) - 1:
            return False
        command = tuple(scan[: opening + 1])
        if any(token.kind != "WORD" and token.text not in (".", "[", "]", "(") for token in command):
            return False
        self.found.append(PastedPiece("command", command))
        arguments = [self.resolved(_unquoted(part)) for part in _listed(scan[opening + 1 : -1])]
        if arguments and arguments[0] and arguments[0][0].text in _COMMANDS:
            return self.command(arguments[0])
        self.arguments(scan, arguments)
        return True

    def resolved(self, part: list[Token]) -> list[Token]:
        """What was assigned to a name."""
        if len(part) == 1 and part[0].text in self.named:
            return self.named.pop(part[0].text)
        return part

    def list_of(self, scan: list[Token]) -> bool:
        """{y'' + y = 0, y(0) = 1}."""
        if len(scan) < 3 or scan[0].text not in ("{", "[") or partners(scan).get(0) != len(scan) - 1:
            return False
        if not _has_equals(scan, depth=1):
            return False
        for part in _listed(scan[1:-1]):
            self.equation(self.resolved(part))
        return True

    def arguments(self, whole: Scan, arguments: list[list[Token]]) -> None:
        if not arguments or not arguments[0]:
            return
        first, *rest = arguments
        if not self.list_of(first):
            self.equation(first)
        names = {token.text for piece in self.found if piece.role == "equation" for token in piece.scan}
        for part in rest:
            if not self.argument(part, names):
                given = [self.written(piece.scan) for piece in self.found if piece.role == "equation"]
                said = f"{self.written(part)} isn't read in {self.written(whole[:1])}(...)"
                hint = f"give the equation and its values: {', '.join(given)}"
                raise _error(self.text, said, part, hint)

    def argument(self, part: list[Token], names: set[str]) -> bool:
        """An argument behind the equation; false where it says nothing that is read."""
        texts = [token.text for token in part]
        if not part:
            return False
        if texts[:1] in (["ivar"], ["func"], ["function"]) and texts[1:2] == ["="]:
            part = part[2:]
            texts = texts[2:]
            self.variable = texts[0] if len(texts) == 1 else self.variable
        if texts[:1] == ["ics"] and len(texts) > 4 and texts[1] == "=":
            return self.ics(part[2:])
        if len(texts) in (1, 4) and part[0].kind == "WORD" and (len(texts) == 1 or texts[1] in ("(", "[")):
            is_known = texts[0] in names or any(texts[0] in name for name in names if len(name) == 3)
            if not is_known and not (len(texts) == 1 and is_letter(texts[0])):
                return False
            if len(texts) == 1 and texts[0] not in names and is_letter(texts[0]):
                self.variable = texts[0]  # MATLAB's variable
            self.found.append(PastedPiece("name", tuple(part)))
            return True
        if texts[0] in ("[", "{") and not _has_equals(part, depth=1):  # the unknown functions of a system
            return all(inner and self.argument(inner, names) for inner in _listed(part[1:-1]))
        if _has_equals(part) and not (len(texts) > 2 and texts[1] == "=" and is_word(texts[0])):
            self.equation(part)
            return True
        return self.list_of(part)

    def ics(self, part: list[Token]) -> bool:
        """SymPy's ics={y(0): 1}, and Sage's ics=[x0, y0, dy0]."""
        inside = _listed(part[1:-1])
        if part[0].text == "{":
            for value in inside:
                colon = next((k for k, token in enumerate(value) if token.text == ":"), None)
                if colon is None:
                    return False
                value[colon] = value[colon]._replace(text="=")
                self.equation(value)
            return True
        function = next((piece.scan[0] for piece in self.found if piece.role == "name"), None)
        if part[0].text != "[" or function is None or len(inside) != 3:
            return False
        point, *values = inside
        for order, value in enumerate(values):
            primes = [Token("PRIMES", "'", function.end, function.end)] * order
            at = [
                token._replace(kind="SIGN", text=sign)
                for token, sign in ((point[0], "("), (point[0], ")"), (point[0], "="))
            ]
            self.equation([function, *primes, at[0], *point, at[1], at[2], *value])
        return True

    # -------------------------------------------------------------------------------------- roles

    def sorted_roles(self) -> list[PastedPiece]:
        """Conditions among the statements; where nothing else is there, the first one is an equation."""
        equations = [k for k, piece in enumerate(self.found) if piece.role == "equation"]
        if len(equations) < 2:
            return self.found
        letters = _arguments(self.found[equations[0]].scan)
        are_conditions = {
            k: _is_condition(self.found[k].scan, is_first=k == equations[0])
            and not (k > equations[0] and letters & _arguments(self.found[k].scan))
            for k in equations
        }
        if all(are_conditions.values()):
            are_conditions[equations[0]] = False
        return [
            PastedPiece("condition", piece.scan) if are_conditions.get(k) else piece
            for k, piece in enumerate(self.found)
        ]


def _arguments(scan: Scan) -> set[str]:
    """The letters that functions are applied to: t of y(t) and y'[t]."""
    found: set[str] = set()
    if any(token.text in ("subs", "Subs") for token in scan):
        return found
    for k in range(len(scan) - 2):
        is_applied = scan[k].text in ("(", "[") and scan[k + 2].text in (")", "]") and k > 0
        if is_applied and scan[k + 1].kind == "WORD" and scan[k - 1].kind in ("WORD", "PRIMES"):
            found.add(scan[k + 1].text)
    return found - _POINTS


def is_word(text: str) -> bool:
    return text.isalpha() and len(text) > 1 and not is_letter(text)


def _is_prose(token: Token) -> bool:
    """A word that means nothing here."""
    text = token.text
    is_known = is_function(text) or text in GREEK or is_letter(text) or text in DERIVATIVES or text in _COMMANDS
    return (
        token.kind in ("WORD", "TEXT")
        and len(text) > 2
        and text.isalpha()
        and not is_known
        and text not in ("Eq", "Equality")
    )


def _is_primed(ending: Scan) -> bool:
    return ending[0].kind == "WORD" and ending[0].end == ending[1].start


def _is_sequence(scan: Scan, k: int) -> bool:
    """Maple's x$2."""
    before = scan[k - 1].kind if k else ""
    after = scan[k + 1].kind if k + 1 < len(scan) else ""
    return (before, after) in (("WORD", "NUMBER"), ("PRIMES", "PRIMES"))


def _is_decimal_comma(scan: Scan, k: int) -> bool:
    """1,5: no blank about the comma between two numbers."""
    if not 0 < k < len(scan) - 1:
        return False
    before, after = scan[k - 1], scan[k + 1]
    return before.kind == after.kind == "NUMBER" and before.end == scan[k].start and scan[k].end == after.start


def _has_equals(scan: Scan, depth: int = 0) -> bool:
    """True if an equals sign stands outside all brackets, or as deep as is said."""
    if _has_sign(scan, (*_EQUALS, ":="), depth):
        return True
    return bool(scan) and scan[0].text in ("Eq", "Equality", "sympy", "sp", "sm") and depth == 0


def _has_sign(scan: Scan, signs: Collection[str], depth: int = 0) -> bool:
    level = 0
    for token in scan:
        level += (token.text in OPENING) - (token.text in CLOSING)
        if token.text in signs and level <= depth:
            return True
    return False


def _without_assignment(scan: list[Token]) -> tuple[str, list[Token]]:
    """The name to which an equation or a command is assigned, and the rest: ode := ..., eq: ..., eq = Eq(...)."""
    if len(scan) < 3 or scan[0].kind != "WORD":
        return "", scan
    if [token.text for token in scan[1:5:2]] == ["(", ")"] and len(scan) > 6 and scan[5].text in _COMMANDS:
        return scan[0].text, scan[5:]  # ySol(t) = dsolve(ode)
    sign = scan[1].text
    if sign == ":=":
        return scan[0].text, scan[2:]
    if sign == ":" and len(scan) > 3:
        rest = scan[3:] if scan[2].text == "=" else scan[2:]
        return scan[0].text, rest
    after = scan[2].text
    is_package = after in ("sympy", "sp", "sm")
    makes = after in (*_COMMANDS, *_MAKERS, "Eq", "Equality") or is_package
    has_double = any(token.text == "==" for token in scan[2:]) and sign == "="
    if sign == "=" and (makes or has_double or is_word(scan[0].text)):
        return scan[0].text, scan[2:]
    return "", scan


def _without_eq(scan: Scan) -> list[Token]:
    """left = right for Eq(left, right) of SymPy."""
    tokens = list(scan)
    while len(tokens) > 2 and tokens[0].text in ("sympy", "sp", "sm") and tokens[1].text == ".":
        if tokens[2].text not in ("Eq", "Equality"):
            return list(scan)
        tokens = tokens[2:]
    if len(tokens) < 4 or tokens[0].text not in ("Eq", "Equality") or partners(tokens).get(1) != len(tokens) - 1:
        return list(scan)
    sides = _listed(tokens[2:-1])
    if len(sides) < 2 or not sides[0] or not sides[1]:
        return list(scan)
    equals = Token("SIGN", "=", sides[0][-1].end, sides[1][0].start)
    return [*sides[0], equals, *sides[1]]


def _listed(scan: Scan, separators: Sequence[str] = (",",)) -> list[list[Token]]:
    """The parts between commas outside all brackets."""
    parts: list[list[Token]] = [[]]
    depth = 0
    for token in scan:
        depth += (token.text in OPENING) - (token.text in CLOSING)
        if depth == 0 and token.text in separators:
            parts.append([])
        else:
            parts[-1].append(token)
    return parts


def _unquoted(part: list[Token]) -> list[Token]:
    """Without quotation marks around it; an apostrophe before diff is Maxima's."""
    while len(part) > 2 and part[0].kind == part[-1].kind == "PRIMES" and part[0].text == part[-1].text:
        part = part[1:-1]
    return part


def _is_condition(scan: Scan, *, is_first: bool) -> bool:
    """True if a function stands at a point; a letter is a point behind the equation, and the variable in it."""
    if not _has_equals(scan):
        return False
    texts = [token.text for token in scan]
    if "subs" in texts or "Subs" in texts:
        return True
    partner = partners(scan)
    for k, token in enumerate(scan):
        opening = k + 1 + (k + 1 < len(scan) and scan[k + 1].kind == "PRIMES")
        is_call = token.kind == "WORD" and opening in partner and texts[opening] in ("(", "[")
        is_behind = token.text == "}" or (token.text == ")" and "D" in texts)  # \dot{y}(0), D(y)(0)
        if is_behind and k + 1 in partner and texts[k + 1] == "(":
            is_call, opening = True, k + 1
        if not is_call or is_function(token.text) or token.text in (*DERIVATIVES, "Derivative"):
            continue
        inside = scan[opening + 1 : partner[opening]]
        is_letter_alone = len(inside) == 1 and inside[0].kind == "WORD" and inside[0].text not in _POINTS
        starts = k == 0 or is_first or token.text in "})" or not _is_equation(scan[:k])
        if is_letter_alone:
            return not is_first and k == 0 and not any(t.kind == "PRIMES" and len(t.text) > 1 for t in scan)
        if (
            texts[:1] == [token.text]
            or texts[0] in ("\\dot", "\\frac", "(", "D", "-")
            or texts[0].startswith(("d", "D"))
        ):
            return starts
        if inside and inside[0].kind == "NUMBER" and len(inside) == 1:
            return True
    return False


_POINTS = frozenset({"oo", "inf", "infty", "infinity", "Infinity", "pi", "Pi", "\\pi"})


def spelled(tokens: Tokens, begin: int = 0, end: int | None = None) -> str:
    """Tokens in this package's notation."""
    text = ""
    for piece in tokens.pieces[begin:end]:
        if text and piece and (text[-1].isalnum() or text[-1] in "_'") and (piece[0].isalnum() or piece[0] == "_"):
            text += " "
        text += piece
    return text


def _given(text: str, scan: Scan) -> Iterator[PlacedValue]:
    """The conditions that one statement has; y(0) = y'(0) = 1 are two."""
    tokens = translated(text, [token for token in scan if token.text not in ("$", "`")], condition=True)
    depth = 0
    bounds = [-1]
    for k, kind in enumerate(tokens.kinds):
        depth += (kind == "LPAR") - (kind == "RPAR")
        if kind == "EQUAL" and depth == 0:
            bounds.append(k)
    bounds.append(len(tokens.kinds) - 1)
    sides = [spelled(tokens, a + 1, b) for a, b in pairwise(bounds)]
    *places, value = sides
    if not places or not all(sides):
        hint = 'write "y(0)=1, y\'(0)=0", each with its value'
        raise _error(text, f"{text[scan[0].start : scan[-1].end]!r} isn't an initial value", scan, hint)
    for a, b in list(pairwise(bounds))[1:-1]:
        is_place = tokens.kinds[a + 1] == "HEAD" and _call_end(tokens, a + 1) == b
        if not is_place:
            split = next((k for k in range(a + 2, b) if tokens.kinds[k] == "HEAD" and _call_end(tokens, k) == b), b)
            hint = "write y(0) = 1, y'(0) = 0"
            if split < b:
                left, right = text[scan[0].start : tokens.ends[split - 1]], text[tokens.starts[split] : scan[-1].end]
                hint = f"write {left}, {right}"
            raise _error(text, "a comma is missing between two values", scan, hint)
    for place in places:
        yield PlacedValue(place, value)


def _call_end(tokens: Tokens, k: int) -> int:
    """The number of the token behind a call."""
    depth = 0
    for j in range(k + 1, len(tokens.kinds)):
        depth += (tokens.kinds[j] == "LPAR") - (tokens.kinds[j] == "RPAR")
        if depth == 0:
            return j + 1
    return len(tokens.kinds)


def is_equation(text: str) -> bool:
    """True for a text with an equation in it, false for S alone."""
    return taken_apart(text).is_equation

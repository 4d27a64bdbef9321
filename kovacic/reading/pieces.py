"""A text that was pasted, taken apart before anything in it is read.

>>> paste = Paste("sol := dsolve({diff(y(x),x$2) + y(x) = 0, y(0) = 1, D(y)(0) = 0}, y(x));")
>>> paste.conditions
(PlacedValue(place='y(0)', value='1'), PlacedValue(place="y'(0)", value='0'))
>>> Paste("3. Solve the equation y'' + y = 0;  // easy").notes
['3. was taken for a number in a list', 'left out: Solve the equation']

Comments, numbers of lists and equations, prose, dollar signs, environments of LaTeX, assignments and commands of other systems
surround an equation; values follow it, or are arguments of the command.  The meaning of the equation is found by
`dialects`, `source` and the parser.  Linear time.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from functools import cached_property
from itertools import compress, takewhile
from typing import NamedTuple

from kovacic.errors import ParseError
from kovacic.reading.dialects import LAYOUT, in_own_notation, is_plain
from kovacic.reading.lexer import DERIVATIVES, PRIME, Token, error_at, scanned
from kovacic.reading.names import INFINITIES, is_function, is_letter
from kovacic.reading.notations import (
    AROUND,
    MAKERS,
    NOTATIONS,
    SOLVERS,
    ParserTokens,
    Rewrite,
    Tokens,
    pattern,
    rewritten,
)

#: Words between an equation and its conditions.
_BETWEEN = frozenset("and with where subject such given for if at when satisfying".split())  # noqa: SIM905
_FILLERS = frozenset("to that the conditions condition initial boundary by values value".split())  # noqa: SIM905
#: The first words of statements that declare names and solve nothing.
_DECLARATIONS = frozenset("from import syms with restart clear clc depends assume var init_printing".split())  # noqa: SIM905
_UNFINISHED = frozenset("+ - * / ^ ** = == , := .".split())  # noqa: SIM905
_ASSIGNS = ("=", "==", ":=")
#: With what Eq(left, right) begins.
_WHOLE = frozenset({"Eq", "Equality"})
_BEGINNINGS = ("WORD", "COMMAND", "NEWLINE", "TEXT", "NUMBER")
_DISPLAYS = ("\\displaystyle", "\\boxed")
_INEQUALITIES = frozenset({*"<>≠", "<=", ">="})
_NAMED_POINTS = frozenset({*INFINITIES, "pi", "\\pi"})


class PlacedValue(NamedTuple):
    """A condition: y'(0), or a linear combination of such values, and the value it has."""

    place: str
    value: str


def conditions_in(text: str, variable: str) -> tuple[PlacedValue, ...]:
    """Conditions that stand alone: "y(0) = 1, y'(x = 0) = 0".  Raises `ParseError` for anything else."""
    statements = [*_statements(_plain_tokens(text))]
    check_points(text, [letter for statement in statements for letter in _letters_of_points(statement)], variable)
    return tuple(given for statement in statements for given in _placed_values(text, statement))


def _letters_of_points(scan: Tokens) -> list[Token]:
    """t of y(t = 0)."""
    return [scan[scan.span(match, 1)[0]] for match in _LETTER_OF_POINT.finditer(scan.spaced)]


def check_points(text: str, letters: Sequence[Token], variable: str) -> None:
    """Raises `ParseError` for y(t = 0) where t isn't the variable."""
    for letter in letters:
        if letter.text != variable:
            said = f"the value is given in {letter.text}, and the variable is {variable}"
            raise error_at(text, said, [letter], f"write y({variable} = 0), or y(0)")


def _plain_tokens(text: str) -> Tokens:
    """The tokens in this package's notation, without comments, layout, and marks around the whole."""
    scan = rewritten(Tokens(scanned(text)), AROUND)
    is_displayed = scan.has(_DISPLAYS)  # as Wikipedia has its formulas
    found = rewritten(Tokens(token for token in scan if token.text not in LAYOUT), NOTATIONS)
    is_around = (is_displayed and found.is_enclosed) or _is_quoted(found)
    return Tokens(found[1:-1]) if is_around else found


def _statements(scan: Tokens) -> Iterator[Tokens]:
    """The statements that commas, semicolons, words and ends of lines separate."""
    current: list[Token] = []
    is_first = True
    is_complete = False
    for k, token in enumerate(scan):
        depth = scan.depths[k]
        if depth == 0 and token.text in _SEPARATORS and _SEPARATORS[token.text](scan, k, current, is_complete):
            yield from [Tokens(current)] * bool(current)
            is_first = is_first and not current
            current, is_complete = [], False
        elif token.kind != "NEWLINE" and (current or is_first or token.text not in (*_FILLERS, *_BETWEEN)):
            is_whole = not current and token.text in _WHOLE | _DECLARATIONS
            is_complete |= is_whole or (depth == 0 and token.text in _ASSIGNS)
            current.append(token)
    yield from [Tokens(current)] * bool(current)


def _comma_separates(scan: Tokens, k: int, *_: object) -> bool:
    """Not that of a decimal, 1,5: no blank about it between two numbers."""
    around = scan[max(0, k - 1) : k + 2]
    is_decimal = [token.kind for token in around] == ["NUMBER", "SIGN", "NUMBER"]
    return not is_decimal or around[0].end < around[2].start - 1


def _line_separates(scan: Tokens, k: int, current: list[Token], is_complete: bool) -> bool:
    """Between two statements, each of which has an equals sign or solves something."""
    if not is_complete or {current[-1].text, scan[min(k + 1, len(scan) - 1)].text} & _UNFINISHED:
        return False
    following = Tokens(takewhile(lambda token: token.text not in ("\n", ";"), scan[k + 1 : k + 200]))
    return following.has(SOLVERS) or _has_equals(following)


#: Separators of statements, and the test whether one separates; Maple ends statements with colons.
_SEPARATORS: dict[str, Callable[[Tokens, int, list[Token], bool], bool]] = {
    ";": lambda *_: True,
    ",": _comma_separates,
    ":": lambda scan, k, _, is_complete: is_complete and k + 1 < len(scan),
    "\n": _line_separates,
    **dict.fromkeys(
        _BETWEEN,
        lambda scan, k, _, is_complete: is_complete and (k + 1 == len(scan) or scan[k + 1].kind in _BEGINNINGS),
    ),
}


#: The note on a piece of each role.
_NOTES = {
    "number": "{} was taken for a number in a list",
    "label": "{} was taken for the number of the equation",
    "prose": "left out: {}",
}
#: Words that have numbers.
_LABEL_WORDS = "Exercise|Problem|Example|Question|Equation|Task|Aufgabe|Ex|No|Nr"
_SOME = r"(?:(?:[^\W\d]\S*|'~s|[-:,.]) ){0,40}"
_NO_OPERATOR = r"(?! (?:==?|:=|[*/^)\[])(?!\S))"
_UNKNOWN_WORD = pattern("WORD")
_LABEL_NUMBERS = r"\d+(?:\.\d+)?|[a-i]|i{2,3}|iv|vi{1,3}"
#: Patterns that are left out before or behind a statement, in this order, with their roles; layout has none.
SURROUNDINGS = (
    Rewrite("the next sentence", r"(?<=\.\x20\x20)[A-Z][a-z]*(?: (?:[^\W\d]+|[-,.!?']))+$", kind="prose"),
    Rewrite("the end of a sentence", r"(?<!^)[.:$,?](?: [.:$,?])*$"),
    Rewrite("a prompt", r"^(?:>(?: >){0,2}|sage :|In \[ \S+ \] :=|\( % \w+ \))"),
    Rewrite("1.", r"^(?:\d+\.|[A-Z]\d+ \.)(?=\x20\x20)", kind="number"),
    Rewrite("1)", r"^[^\s(]{1,2} \)(?= \S+ \S)", kind="number"),
    Rewrite("(1)", rf"^\( (?:{_LABEL_NUMBERS}) \)(?=\x20\x20\S+ )", kind="number"),
    Rewrite("Problem 3:", rf"^(?:WORD|{_LABEL_WORDS})(?: \.)? \d+(?:\.\d+)?(?:\.(?=\x20\x20)| [:.)])", kind="prose"),
    Rewrite("Problem 3", rf"^(?:{_LABEL_WORDS})(?: \.)? \d+(?=\x20\x20\S+ )", kind="number"),
    Rewrite("a sentence", rf"^{_SOME}?WORD {_SOME}(?:WORD|of|to|is|by|(?<=\w\x20):){_NO_OPERATOR}", kind="prose"),
    Rewrite("a capital", rf"^(?=[A-Z][a-z]+ )WORD{_NO_OPERATOR}(?! \()", kind="prose"),
    Rewrite("the number behind an equation", r"(?<=[^-+*/^=,:.\s]\x20\x20)OPEN \d+(?:\.\d+)? CLOSE$", kind="label"),
    Rewrite(
        "a remark behind an equation",
        r"(?:(?<=\x200\x20\x20)|\n ?)\( (?:WORD(?: \S+){0,5}|\S+ (?:[<>]=?|≠) \S+) \)$",
        kind="prose",
    ),
    Rewrite("the end of a sentence", r"[.:,](?: [.:,])*$"),
)


class Paste:
    """A text taken apart into the tokens of each equation and of each value.

    `variable` is one that a command names, `notes` say what was left out.  Raises `ParseError` for arguments of a command
    that say nothing about the equation.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.equation_scans: list[Tokens] = []
        self.value_scans: list[Tokens] = []
        self.has_command = False
        #: The unknown function that a command names.
        self.function: Token | None = None
        self.variable: str | None = None
        self.notes: list[str] = []
        #: Statements that have names, until they are used.
        self.named: dict[str, Tokens] = {}
        if is_plain(text):  # which takes a third of the time
            self.equation_scans.append(Tokens(scanned(text)))
            return
        statements = list(_statements(_plain_tokens(text)))
        for scan in filter(None, map(self.without_surroundings, statements)):
            self.statement(scan, is_alone=len(statements) == 1)
        is_solved = self.has_command and self.equation_scans
        for scan in [*self.named.values()]:
            if is_solved:  # MATLAB's dsolve(ode) where the values have names
                self.notes.append(f"not used: {self.written(scan)}")
            elif not self.list_of(scan):
                self.add(scan)
        # Values among the statements; where nothing else is there, the first one is an equation.
        first, *others = self.equation_scans or [Tokens()]
        letters = _argument_letters(first)
        is_value = [_is_condition(scan) and not letters & _argument_letters(scan) for scan in others]
        is_value.insert(0, not all(is_value) and _is_condition(first, is_first=True))
        self.value_scans = [*compress(self.equation_scans, is_value)]
        self.equation_scans = [scan for scan, is_one in zip(self.equation_scans, is_value, strict=False) if not is_one]

    @cached_property
    def is_equation(self) -> bool:
        """True for an equation, false for S alone."""
        return any(map(is_equation, self.equation_scans))

    @cached_property
    def equations(self) -> list[ParserTokens]:
        found = [in_own_notation(self.text, scan) for scan in self.equation_scans]
        for tokens in found:
            tokens.variable = next((token.text for token in self.points), tokens.variable)
        return found

    @cached_property
    def points(self) -> list[Token]:
        """The letters of y(t = 0)."""
        return [letter for scan in self.value_scans for letter in _letters_of_points(scan)]

    @cached_property
    def conditions(self) -> tuple[PlacedValue, ...]:
        return tuple(given for scan in self.value_scans for given in _placed_values(self.text, scan))

    def add(self, scan: Tokens) -> None:
        """Adds an equation or a value; left = right for SymPy's Eq(left, right)."""
        is_call = scan[0].text in _WHOLE and Tokens(scan[1:]).is_enclosed
        match Tokens(scan[2:-1]).split() if is_call else []:
            case [[*_, last] as left, [first, *_] as right, *_]:
                scan = Tokens([*left, Token("SIGN", "=", last.end, first.start), *right])
        self.equation_scans.append(scan)

    def written(self, scan: Sequence[Token]) -> str:
        return self.text[scan[0].start : scan[-1].end] if scan else ""

    def without_surroundings(self, scan: Tokens) -> Tokens:
        """Without prompts, numbers of lists and equations, prose and punctuation."""
        for around in SURROUNDINGS if scan[0].text not in _DECLARATIONS else ():
            match = around.pattern.search(scan.spaced)
            if match is None:
                continue
            first, behind = scan.span(match)
            left, rest = Tokens(scan[first:behind]), Tokens([*scan[:first], *scan[behind:]])
            is_name = len(left) == 2 and left[1].text == ":" and self.text.count(left[0].text) > 1  # eqn: ... ode2(eqn)
            if around.kind and (is_name or not is_equation(rest)):
                if around.kind == "label":
                    self.notes.append(f"{self.written(left)} was read as a factor; leave the number of an equation out")
                continue
            if around.notation in ("(1)", "Problem 3"):
                self.check_number(left, rest)
            if around.kind:
                self.notes.append(_NOTES[around.kind].format(self.written(left)))
            scan = rest
        if scan and scan[-1].text[-1] == "." and _has_equals(scan):  # y(0) = 1.
            return Tokens([*scan[:-1], scan[-1]._replace(text=scan[-1].text[:-1])])
        return scan

    def check_number(self, number: Tokens, rest: Tokens) -> None:
        """Raises `ParseError` for (2) y'' + y = 0 on one line, where 2 may be a coefficient."""
        gap = self.text[number[-1].end : rest[0].start]
        label = next(token.text for token in number[::-1] if token.text != ")")
        is_clear = label == "1" or rest[0].kind == "NUMBER" or _UNKNOWN_WORD.match(rest.spaced)
        if is_clear or re.search(r"[\t\n]|\\\\|quad", gap):
            return
        said = f"{self.written(number)} may be the number of the equation, or a factor"
        raise error_at(self.text, said, number, f"leave it out, or write {label}* for a factor")

    def statement(self, scan: Tokens, *, is_alone: bool) -> None:
        is_declared = scan[0].text in _DECLARATIONS or (len(scan) == 1 and scan[0].text in SOLVERS)
        name, scan = _without_assignment(scan)
        if is_declared or _IDENTITY.fullmatch(scan.spaced) or (name and scan[0].text in MAKERS):
            match [token.text for token in scan]:
                case ["Differential", "(", variable, ")"] if is_letter(variable):  # Julia's D = Differential(t)
                    self.variable = variable
        elif self.command(scan):
            return
        elif name and not is_alone:
            self.named[name] = scan
        elif self.list_of(scan):
            return
        elif is_alone or _has_equals(scan) or scan.has(("else",)):
            self.add(scan)
        elif _has_equals(scan, _INEQUALITIES):
            self.notes.append(f"not used: {self.written(scan)}")
        elif len(scan) > 1 or not is_letter(scan[0].text) or "=" not in self.text:  # else x, t = var("x t")
            self.add(scan)

    def command(self, scan: Tokens) -> bool:
        """The arguments of a command of another system: its equation, values, and names that occur in the equation."""
        match = _COMMAND.match(scan.spaced)
        if match is None:
            return False
        opening = scan.span(match)[1] - 1
        if not Tokens(scan[opening:]).is_enclosed:
            return False
        self.has_command = True
        first, *rest = map(self.resolved, Tokens(scan[opening + 1 : -1]).split())
        if not first:
            return True
        if first[0].text in SOLVERS:
            return self.command(first)
        if not self.list_of(first):
            self.add(first)
        names = {token.text for equation in self.equation_scans for token in equation}
        for part in rest:
            if not self.argument(part, names):
                given = ", ".join(map(self.written, self.equation_scans))
                said = f"{self.written(part)} isn't read in {self.written(scan[:1])}(...)"
                raise error_at(self.text, said, part, f"give the equation and its values: {given}")
        return True

    def resolved(self, part: Tokens) -> Tokens:
        """Without quotation marks; what a name stands for."""
        while _is_quoted(part):
            part = Tokens(part[1:-1])
        return self.named.pop(part[0].text, part) if len(part) == 1 else part

    def list_of(self, scan: Tokens) -> bool:
        """{y'' + y = 0, y(0) = 1}, and SymPy's {y(0): 1}."""
        if scan[0].text not in ("{", "[") or not scan.is_enclosed:
            return False
        scan = Tokens(token._replace(text="=") if token.text == ":" else token for token in scan)
        names = [token.text for token in scan[1:-1] if token.text != ","]
        if self.named.keys() >= {*names}:  # MATLAB's [cond1 cond2], too
            parts = [self.named.pop(name) for name in dict.fromkeys(names)]
        elif _has_equals(scan, depth=1):
            parts = [*map(self.resolved, Tokens(scan[1:-1]).split())]
        else:
            return False
        for part in parts:
            if part and not self.list_of(part):
                self.add(part)
        return True

    def argument(self, part: Tokens, names: set[str]) -> bool:
        """An argument behind the equation; false where it says nothing that is read."""
        match [token.text for token in part]:
            case ["ivar" | "dvar" | "func" | "function" | "ics" as keyword, "=", name, *_]:
                self.variable = name if keyword == "ivar" else self.variable
                return self.argument(self.resolved(Tokens(part[2:])), names)
            case ["singsol" | "IncludeSingularSolutions", *_] | ["ics", "="]:
                return True
            case [name] | [name, "(" | "[", _, _]:
                if name not in names:
                    if len(part) > 1 or not is_letter(name):
                        return False
                    self.variable = name  # MATLAB's
                self.function = self.function or part[0]
                return True
            case ["[" | "{", *_] if self.list_of(part):
                return True
            case ["[" | "{", *_] if not _has_equals(part, depth=1):  # the unknown functions of a system
                inside = Tokens(part[1:-1]).split()  # or a range {t, 0, 30}
                if inside[0] and inside[0][0].kind == "NUMBER":
                    return self.values_of_sage(inside)
                return all((inner[:1] and inner[0].kind == "NUMBER") or self.argument(inner, names) for inner in inside)
            case [name, "=", _, *_] if is_word(name):
                return False
            case _ if _has_equals(part):
                self.add(part)
                return True
        return False

    def values_of_sage(self, inside: Sequence[Tokens]) -> bool:
        """Sage's ics=[x0, y0, dy0], and [x0, y0] for an equation of order 1."""
        function = self.function
        if function is None or len(inside) not in (2, 3) or not all(inside):
            return False
        point, *values = inside
        opening, closing, equals = (Token("SIGN", sign, point[0].start, point[0].end) for sign in "()=")
        primes = [Token("PRIMES", PRIME, function.end, function.end)]
        for k, value in enumerate(values):
            self.add(Tokens([function, *primes[:k], opening, *point, closing, equals, *value]))
        return True


_COMMAND = pattern(rf"(?:\w+ [.\[]? ?)?(?:{'|'.join(SOLVERS)}) (?:\] |\[ \w+ \] )?[(\[]")
#: An equals sign, primes behind something, a derivative.
_EQUATION = pattern(r"==?|(?<!^)['\"˙]+|\\prime|\\d+ot|(?:diff|Diff|Derivative|D) OPEN")
#: MATLAB's Dy = diff(y, t).
_IDENTITY = pattern(r"(?P<y>LETTER) (?:˙+ = diff \( (?P=y) .*\)|˙ = (?P=y) '|˙˙ = (?P=y) '')")
#: A name, or a derivative, with an argument.
_CALL = pattern(r"(?:\\?[^\W\d]\S*(?: ['\"˙]+)?|\}) (?:\{ )?[(\[]")
_LETTER_OF_POINT = pattern(r"\( (LETTER) =")
#: Primes that belong to no value: y'', y''(x).
_PRIMES_ALONE = pattern(r"(?:''|\"|˙˙)(?! OPEN)")


def is_equation(scan: Tokens) -> bool:
    """True if an equals sign, a prime or a derivative occurs."""
    if _EQUATION.search(scan.spaced):
        return True
    if not any(token.text.startswith(("d", "\\partial")) for token in scan):
        return False
    try:
        return "diff" in in_own_notation("", scan).pieces
    except ParseError:
        return False


def _argument_letters(scan: Tokens) -> set[str]:
    """The letters that functions are applied to: t of y(t) and y'[t]."""
    return {match[1] for match in _ARGUMENT.finditer(scan.spaced)} - _NAMED_POINTS


_ARGUMENT = pattern(r"(?:\\?[^\W\d]\S*|['\"˙]+) [(\[] ([^\W\d]\S*) [)\]]")


def is_word(text: str) -> bool:
    return text.isalpha() and not is_letter(text)


def _has_equals(scan: Tokens, signs: Collection[str] = _ASSIGNS, depth: int = 0) -> bool:
    """True if one of the signs stands in at most `depth` brackets."""
    has_sign = any(token.text in signs and scan.depths[k] <= depth for k, token in enumerate(scan))
    return has_sign or (bool(scan) and scan[0].text in _WHOLE)


#: The name to which an equation or a command is assigned: ode := ..., eq: ..., eq = Eq(...), ySol(t) = dsolve(...).
_ASSIGNMENT = pattern(
    rf"(?P<name>[^\W\d]\w*) (?:\( \w+ \) =(?= (?:{'|'.join(SOLVERS)}) )|:(?: =)?(?= \S+ \S)|:=|=(?=.* == )"
    rf"|=(?= (?:{'|'.join([*SOLVERS, *MAKERS])}|Eq|Equality) ))"
)


def _without_assignment(scan: Tokens) -> tuple[str, Tokens]:
    """The name to which an equation or a command is assigned, and the rest."""
    match = _ASSIGNMENT.match(scan.spaced)
    is_named = len(scan) > 2 and scan[1].text == "=" and is_word(scan[0].text)
    behind = scan.span(match)[1] if match else 2 * is_named
    return (scan[0].text, Tokens(scan[behind:])) if 0 < behind < len(scan) else ("", scan)


def _is_quoted(scan: Tokens) -> bool:
    return len(scan) > 2 and scan[0].kind == scan[-1].kind == "PRIMES" and scan[0].text == scan[-1].text


def _is_condition(scan: Tokens, *, is_first: bool = False) -> bool:
    """True if a function stands at a point; a letter is a point behind the equation, and the variable in it."""
    if _PRIMES_ALONE.search(scan.spaced):
        return False
    partner = scan.partners
    for call in _CALL.finditer(scan.spaced):
        name, behind = scan.span(call)
        opening = behind - 1
        function = scan[name].text.removeprefix("\\")
        if opening not in partner or is_function(function) or function in DERIVATIVES:
            continue
        match [token[:2] for token in scan[opening + 1 : partner[opening]]]:
            case [("WORD", point)] if point not in _NAMED_POINTS:
                return name == 0 and not is_first
            case [("NUMBER", _)]:
                return True
        if scan[name].text == "}" or not is_equation(Tokens(scan[:name])):  # \dot{y}(0)
            return True
    return False


def _placed_values(text: str, scan: Tokens) -> Iterator[PlacedValue]:
    """The conditions that one statement has; y(0) = y'(0) = 1 are two."""
    letters = _letters_of_points(scan)
    points = (token for k, token in enumerate(scan) if token not in letters and scan[k - 1] not in letters)
    plain = Tokens(token for token in points if token.text not in ("$", "`"))
    sides = [in_own_notation(text, side, condition=True) for side in plain.split(_ASSIGNS)]
    # In this package's notation a blank stands between names and numbers alone.
    *places, value = (re.sub(r"(?<![\w']) | (?!\w)", "", " ".join(tokens.pieces)) for tokens in sides)
    if not places or not all((*places, value)):
        hint = 'write "y(0)=1, y\'(0)=0", each with its value'
        raise error_at(text, f"{text[scan[0].start : scan[-1].end]!r} isn't an initial value", scan, hint)
    for tokens in sides[1:-1]:  # 1 y'(0), between two equals signs
        last = len(tokens.kinds) - 2  # before $END
        closing = tokens.partners
        calls = [k for k, kind in enumerate(tokens.kinds) if kind == "HEAD" and closing.get(k + 1, last) == last]
        if 0 not in calls:
            hint = "write y(0) = 1, y'(0) = 0"
            if calls:
                k = calls[0]
                hint = f"write {text[scan[0].start : tokens[k - 1].end]}, {text[tokens[k].start : scan[-1].end]}"
            raise error_at(text, "a comma is missing between two values", scan, hint)
    for place in places:
        yield PlacedValue(place, value)

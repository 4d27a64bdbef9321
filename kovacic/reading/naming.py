"""The meaning of every name in a text: the variable, the unknown function, a parameter, a function, a number, a product.

The world of names is closed.  A name is one letter (Latin, Greek, or the name of a Greek letter) with an index or digits, a
function, a number such as pi, one of a few letters of physics, or it has been declared.  Two letters that are glued together
are their product if one of them is the variable or the unknown function; anything else is refused, with what was probably
meant.  It is decided here once; the reasons are notes.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from string import digits
from typing import Any, NamedTuple

from kovacic.equation import DEFAULT_VARIABLE, ENERGY, EULER, UNKNOWN
from kovacic.errors import InputError, ParseError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.reading.lexer import DERIVATIVES, PRIME, Token
from kovacic.reading.names import BARE, FUNCTION_NAMES, INSTEAD, LETTER, NUMBER_NAMES, is_function, is_letter, unglued
from kovacic.reading.notations import OPENING, ParserTokens, pattern
from kovacic.reading.parser import excerpt, parse

#: Names that stand for the variable where they are the only one; others might be parameters of an equation in x.
USUAL_VARIABLES = frozenset("xtzsruXTZθφτξρζ") | {"theta", "phi", "tau", "xi", "rho", "zeta"}
#: Of these, the names of constants: they are the variable where a function or several powers of them occur.
_OFTEN_CONSTANT = frozenset("TXZsuτξρζ") | {"tau", "xi", "rho", "zeta"}
#: Beside a frequency z and zeta are damping ratios: x'' + 2 zeta omega x' + omega^2 x = 0.
_DAMPING_RATIOS = frozenset({"zeta", "ζ", "z"})
_FREQUENCIES = ("omega", "ω", "w")
_USUAL_UNKNOWNS = frozenset("xyzuvwqf")
_NO_VARIABLES = frozenset({*NUMBER_NAMES, ENERGY, "e", "D"})
OPERATOR = "D"
_NAME = r"[^\W\d]\w*"
#: x^1/2, x^-3/2; e^-x^2/2, without blanks; 1/2m before a derivative.
_ROOT = pattern(r"\^ ((?:- )?1|- \d+) / (\d+)")
_EXPONENTIAL = pattern(r"(e~\^~(?:-~)?[^\W\d]\w*(?:~\^~\w+)?)~/~(\w+)")
_DIVISOR = pattern(rf"/~([\d.]+(?:~\w+)+)(?=(?: \)|\x20) (?:{_NAME}'|(?:diff|Derivative) \())")
#: Patterns with two readings, the message and the hint: e^2x is e^(2x) or e^2 x, 1e-3y is 0.001 y or e - 3 y.
_EXPONENT = (
    r"BASE \^ ((?:- )?[\d.]+)~(NAME)(?! \()",
    "{0} can be read in two ways",
    "write {base}^({1}*{2}) or {base}^({1})*{2}",
)
_POWER_OF_TEN = r"([\d.]+~[eE]~[-+]~\d+)~(NAME'*)", "{0} can be read in two ways", "write {1}*{2} for the decimal"
_DECIMAL = (
    r"([\d.]+)({x})([-+]?)(\d+)",
    "{0} can be read as a decimal or as {1}*{2}{3}{4}, the variable being {2}",
    "write decimals without an exponent, and products with *",
)
_STIFFNESS = (
    r"(E (?:\* )?I|I (?:\* )?E)(?! \()",
    "E I may be a stiffness, or an energy times the imaginary unit",
    "take one letter for a stiffness, such as B; or declare I as a parameter: ",
    ("parameters=['I']", "--names I"),
)
_GLUED_INDEX = re.compile(rf"{LETTER}_\d+([^\W\d_]+)")
#: y'', diff(y, x), diff(y(x), x), and diff((y(x)), x) for d/dx(y(x)).
_DIFFERENTIATED = pattern(
    rf"({_NAME})'+|(?:{'|'.join(DERIVATIVES)}) \((?:(?= ({_NAME}) [(,)](?! \2 ))| \((?= ({_NAME}) \( {_NAME} \) \)))"
)
_NAME_KINDS = frozenset({"NAME", "PRIMED", "HEAD"})
#: What may stand behind an operand that it belongs to, or not: a factor, an exponent.
_FACTORS = frozenset({"STAR", "NUMBER", "NAME", "PRIMED", "OPERATOR", "HEAD", "LPAR"})
_POWERS = frozenset({"CIRCUMFLEX", "SUPERSCRIPT"})
_FOLLOWING = _FACTORS | _POWERS | {"SLASH"}


class Source(NamedTuple):
    """The input, not yet read: `walk(reader)` is its value; `unknown` is the function of an equation, empty for S alone."""

    walk: Callable[[Any], Any]
    variable: str
    unknown: str = ""
    text: str | None = None
    notes: tuple[str, ...] = ()
    tokens: ParserTokens | None = None
    declared: frozenset[str] = frozenset()
    #: The unknown function was named: others, g(x), are given ones.
    has_functions: bool = False
    #: Those of the notes that say what was guessed.
    guesses: tuple[str, ...] = ()
    limits: Limits = DEFAULT_LIMITS
    #: The parameters of the field in this order, all of which occur; by default in that of their appearance.
    order: tuple[str, ...] = ()


@dataclass(frozen=True)
class Vocabulary:
    """Declarations of the user: the `variable` and the `unknown`, if given, and the `declared` parameters."""

    variable: str | None = None
    unknown: str | None = None
    declared: frozenset[str] = frozenset()

    def of(self, tokens: ParserTokens, *, is_equation: bool, notes: Sequence[str] = ()) -> Source:
        """The source of an equation, or of S alone.  Raises `InputError` for unknown and for ambiguous names."""
        y, has_operator = self._unknown_of(tokens) if is_equation else ("", False)
        if is_equation and "I" not in self.declared:
            _check_readings(tokens, *_STIFFNESS)
        _check_readings(tokens, *_POWER_OF_TEN)
        choose = _equation_variable if is_equation else _variable_of_S
        x, reasons = (self.variable, []) if self.variable else choose(tokens, y, self.declared)
        if x == y:
            said = f"{y} is the unknown function, and can't be the variable"
            raise InputError(said, hint="name another variable: var='x'", shell="name another variable: --var x")
        _check_readings(tokens, _DECIMAL[0].replace("{x}", x), *_DECIMAL[1:])
        split, products = self._with_products(tokens, x, y)
        base = "e" if "\\" in tokens.text else rf"(?:e|{re.escape(x)}|[\d.]+|CLOSE)"  # in LaTeX, ^2 ends with the digit
        _check_readings(split, _EXPONENT[0].replace("BASE", base), *_EXPONENT[1:], unknown=y)
        _check_ends(tokens, x, y)
        named, factors = _with_factors(split, x, y) if "HEAD" in split.kinds else (split, [])
        guesses = [*_guesses(tokens), *products, *factors, *self._imaginary_unit(split, x, y)]
        if has_operator:
            new = [t._replace(kind="OPERATOR", text=x) if t[:2] == ("NAME", OPERATOR) else t for t in named]
            named = tokens.of(new)
        is_usual = is_equation and x in (DEFAULT_VARIABLE, "t")
        return Source(
            partial(parse, named),
            x,
            y,
            tokens.text,
            (*notes, *reasons, *guesses),
            named,
            self.declared,
            has_functions=self.unknown is not None,
            guesses=(*notes, *([] if is_usual else reasons), *guesses),
        )

    def _unknown_of(self, tokens: ParserTokens) -> tuple[str, bool]:
        """The unknown function of an equation, and True if D stands for the derivative."""
        has_operator = (
            OPERATOR not in self.declared
            and OPERATOR in _single_letters(tokens, self.declared)
            and not any(piece.endswith("''") or piece in DERIVATIVES - {OPERATOR} for piece in tokens.pieces)
        )
        y = self.unknown or next(iter(differentiated(tokens, self.declared)), None) or _operand(tokens)
        if y is None:  # what the operator D is applied to
            usual = [UNKNOWN, *(name for name in tokens.names if has_operator and name in _USUAL_UNKNOWNS)]
            y = UNKNOWN if UNKNOWN in usual[1:] else usual[-1]
        return y, has_operator

    def _imaginary_unit(self, tokens: ParserTokens, x: str, y: str) -> list[str]:
        """Notes: undeclared i, j, and E in a text with y[x], are parameters, and I before y'' isn't a moment of inertia."""
        free = tokens.names.keys() - {x, y, *self.declared}
        found = [f"{name} is a parameter; the imaginary unit is I" for name in "ij" if name in free]
        if "E" in free and f"{y}[{x}]" in tokens.text:  # Mathematica's
            found.append("E is a parameter; Euler's number is e")
        if "I" in free and pattern(rf"(?:^|[-+=] )I (?:\* )?{re.escape(y)}''").search(tokens.line):
            found.append("I is the imaginary unit: a moment of inertia needs another letter, or is declared")
        return found

    def _with_products(self, tokens: ParserTokens, x: str, y: str) -> tuple[ParserTokens, list[str]]:
        """With x y for xy; notes say so.  Raises `ParseError` for all other names that aren't known."""
        unknown = [
            k for k, kind in enumerate(tokens.kinds) if kind in _NAME_KINDS and not self._is_known(tokens, k, x, y)
        ]
        rows = list(tokens)
        notes: dict[str, None] = {}
        for k in reversed(unknown):
            kind, piece, start, end = rows[k]
            name = piece.rstrip(PRIME)
            # A product begins with its coefficient.
            if len(name) != 2 or not name.isalpha() or not (name[0] == x or name[1] in (x, y)):
                raise self._unknown_name(tokens, unknown[0], x, y)
            if tokens.are(k - 1, "CIRCUMFLEX") or tokens.are(k - 2, "CIRCUMFLEX", "MINUS"):
                hint = f"write ({name[0]}*{name[1]}) for the product"
                raise tokens.error(ParseError, f"{name} in an exponent can be read in two ways", k, k + 1, hint=hint)
            notes[f"{name} was read as {name[0]}*{name[1]}"] = None
            rows[k : k + 1] = [Token("NAME", name[0], start, start + 1), Token(kind, piece[1:], start + 1, end)]
        return tokens.of(rows), list(reversed(notes))

    def _is_known(self, tokens: ParserTokens, k: int, x: str, y: str) -> bool:
        name = tokens.pieces[k].rstrip(PRIME)
        if name in {x, y, *self.declared, *NUMBER_NAMES} or is_function(name):
            return True
        indexed = _GLUED_INDEX.fullmatch(name)
        if indexed is not None and {*indexed[1]} <= {x, y} and "{" not in tokens.piece(k, k + 1):
            return False  # w_0t is the product w_0 t, or a name
        numbered = {other for other in tokens.names if other.rstrip(digits) in (x, y)} - {x, y}
        if numbered == {name} and name not in (f"{x}0", f"{x}1", f"{y}0", f"{y}1"):
            return False  # x2 alone may be a product, or a power; x1 and x2 are two points
        return is_letter(name) or tokens.kinds[k] == "HEAD"

    def _unknown_name(self, tokens: ParserTokens, k: int, x: str, y: str) -> InputError:
        name = tokens.pieces[k].rstrip(PRIME)
        meant = f"write {unglued(name)}"
        said = f"{name} is one name, and not a known one"
        bare = name.rstrip(digits)
        if name in INSTEAD:
            meant = f"write {INSTEAD[name]}"
        elif bare in (x, y):
            number = name[len(bare) :]
            meant = f"write {bare}^{number} or {number}*{bare}"
        elif name == f"d{x}":
            meant = f"write {y}' or d{y}/d{x} for a derivative"
        elif name.startswith(("asin", "acos", "atan")):
            inside = f"({unglued(name[4:])})"
            meant = f"write a*{name[1:4]}{inside} for the product, {name[:4]}{inside} for the inverse function"
        elif len(name) > 3 and meant.count("*") == len(name) - 1:
            said, meant = f"{name} is a word that isn't known here", f"leave it out, {meant} for a product"
        hint = f"{meant}, or declare it: parameters=[{name!r}]"
        return tokens.error(ParseError, said, k, k + 1, hint=hint, shell=f"{meant}, or declare it: --names {name}")


def _guesses(tokens: ParserTokens) -> Iterator[str]:
    """Notes on readings that may not be the intended ones: x^1/2 is x/2; sin x/2, without parentheses or a blank, (sin x)/2."""
    for number, below in _ROOT.findall(tokens.line)[:1]:
        n = number.replace(" ", "")
        yield f"^{n}/{below} was read as (...)^{n} divided by {below}; a root is written ^({n}/{below})"
    for power, below in _EXPONENTIAL.findall(tokens.spaced):
        shown = power.replace(" ", "")
        yield f"{shown}/{below} was read as ({shown})/{below}"
    for divisor in _DIVISOR.findall(tokens.spaced):
        shown = divisor.replace(" ", "")
        yield f"/{shown} was read as /({shown})"
    for opening, k in tokens.partners.items():
        head = opening - 1
        is_bare = tokens[k].start == tokens[k].end and tokens.kinds[head] == "HEAD"
        if is_bare and tokens.are(k + 1, "SLASH") and tokens[k - 1].end == tokens[k + 1].start:
            function, below = tokens.piece(head, k), tokens.pieces[k + 2]
            yield f"{function}/{below} was read as ({function})/{below}"


def _check_readings(
    tokens: ParserTokens, readings: str, said: str, hint: str, ends: Sequence[str] = ("", ""), unknown: str = ""
) -> None:
    """Raises `ParseError` for a pattern with two readings, unless it ends with `unknown`; `ends` complete the hint."""
    for found in pattern(readings.replace("NAME", _NAME)).finditer(tokens.spaced):
        parts = [part.replace(" ", "") for part in found.groups()]
        if parts[-1] != unknown:
            begin, behind = tokens.span(found)
            begin = {last: first for first, last in tokens.partners.items()}.get(begin, begin)  # (x + 1)^2n
            whole = tokens.piece(begin, behind)
            shown, shell = (hint.format(whole, *parts, base=whole.rpartition("^")[0]) + end for end in ends)
            raise tokens.error(ParseError, said.format(whole, *parts), begin, behind, hint=shown, shell=shell)


def _check_ends(tokens: ParserTokens, x: str, y: str) -> None:
    """Raises `ParseError` where the operand of d/dx, or of a function without parentheses, may go on: d/dx x y', sin a*x."""
    for opening, closing in tokens.partners.items():
        head, sign = opening - 1, tokens.piece(opening - 1, opening)
        if _is_rate(tokens, opening):
            end, behind = closing - 4, closing + 1  # diff(y, x, 1)
            is_clear, kind = _is_whole_operand(tokens, opening, end, behind, y), "operand"
        elif tokens.pieces[head] in BARE:
            end, behind = closing, closing + 1
            if tokens.are(behind, "CIRCUMFLEX") and tokens[behind].start == tokens[behind].end:
                behind += 2  # sin^2 x is sin(x)^2
            is_clear, kind = _is_whole_argument(tokens, opening, end, behind, x, y), "argument"
        else:
            continue
        if not is_clear:
            factor = behind + (tokens.kinds[behind] in ("STAR", "SLASH", "CIRCUMFLEX"))
            last = tokens.partners.get(factor + (tokens.kinds[factor] == "HEAD"), factor)
            rest = tokens.text[tokens[end - 1].end : tokens[last].end]
            hint = f"write {sign}({tokens.piece(opening + 1, end)}{rest}) or ({tokens.piece(head, end)}){rest}"
            raise tokens.error(ParseError, f"the {kind} of {sign} can be read in two ways", head, last + 1, hint=hint)


def _is_rate(tokens: ParserTokens, opening: int) -> bool:
    """True for d/dx before its operand, not for dy/dx and diff(y, x)."""
    sign = tokens.piece(opening - 1, opening)
    is_written_out = tokens.pieces[opening - 1] in DERIVATIVES and sign not in ("", *DERIVATIVES)
    return is_written_out and tokens[opening - 1].end <= tokens[opening + 1].start


def _is_whole_operand(tokens: ParserTokens, opening: int, end: int, behind: int, y: str) -> bool:
    """True if what stands behind the operand of d/dx can't belong to it: the operand has y and ends, as d/dx (x y')."""
    inside = tokens.pieces[opening + 1 : end]
    if tokens.kinds[behind] not in _FOLLOWING:
        return True
    is_enclosed = tokens.partners.get(opening + 1) == end - 1 or tokens.are(behind + 1, "NUMBER")
    has_unknown = y in (piece.rstrip(PRIME) for piece in inside)
    return has_unknown and is_enclosed and tokens.kinds[behind] not in _POWERS


def _is_whole_argument(tokens: ParserTokens, opening: int, end: int, behind: int, x: str, y: str) -> bool:
    """True if no factor stands behind an argument without parentheses, or the argument has x, or the factor is y."""
    inside = {piece.rstrip(PRIME) for piece in tokens.pieces[opening + 1 : end]}
    gap = tokens.text[tokens[opening - 1].end : tokens[opening + 1].start]
    is_marked = x in inside or bool(OPENING & {*gap})
    return is_marked or tokens.pieces[behind].rstrip(PRIME) == y or tokens.kinds[behind] not in _FACTORS


def _with_factors(tokens: ParserTokens, x: str, y: str) -> tuple[ParserTokens, list[str]]:
    """With factors for heads that aren't functions: n(n+1) if n occurs without parentheses, and, with a note, y(1 - y)."""
    alone = {*tokens.names, x} - {*FUNCTION_NAMES, *DERIVATIVES}
    rows = list(tokens)
    bare = [k for k, token in enumerate(tokens) if token[:2] == ("NAME", y)]
    notes: list[str] = []
    for k, (kind, name, _, _) in enumerate(tokens[:-3]):
        is_applied = tokens.kinds[k + 2] in ("NAME", "NUMBER") and tokens.kinds[k + 3] == "RPAR"
        if kind != "HEAD" or name not in alone or is_applied:
            continue
        if name == y:
            end = tokens.partners.get(k + 1, k)
            if bisect_left(bare, k) == bisect_left(bare, end):
                continue
            notes = notes or [f"{excerpt(tokens.piece(k, end + 1))} was read as a product"]
        rows[k] = rows[k]._replace(kind="NAME")
    return tokens.of(rows), notes


def _operand(tokens: ParserTokens) -> str | None:
    """The name after the parentheses around an operator: y in (d^2/dx^2 - x) y."""
    depth = 0
    for k in range(tokens.kinds.index("OPERATOR"), len(tokens.kinds)) if "OPERATOR" in tokens.kinds else ():
        depth += tokens.are(k, "LPAR") - tokens.are(k, "RPAR")
        if depth < 0 and tokens.kinds[k] in ("NAME", "HEAD"):
            return tokens.pieces[k]
    return None


def differentiated(tokens: ParserTokens, declared: Collection[str] = ()) -> list[str]:
    """The names that have primes, x for mx'', and then those that are y in diff(y, x), diff(y(x), x) and diff(y)."""
    names = []
    for found in sorted(_DIFFERENTIATED.finditer(tokens.line), key=lambda match: match[1] is None):
        name = found[1] or found[2] or found[3]
        last = _letters_of(name, declared)[-1]
        if not is_function(name) and (found[1] or name not in DERIVATIVES):
            names.append(last if last in _USUAL_UNKNOWNS else name)
    return names


def _equation_variable(tokens: ParserTokens, y: str, declared: Collection[str]) -> tuple[str, list[str]]:
    """The variable of an equation, with a note where it was guessed.

    It is the argument of the unknown function, or the variable of a derivative, or time in dot notation; else x or t
    if it occurs; else the only usual letter that occurs as only a variable does; else x, and all names are parameters.
    """
    named = argument_of(tokens, y)
    if "OPERATOR" in tokens.kinds:
        named = tokens.pieces[tokens.kinds.index("OPERATOR")]
    if named is not None:
        return named, []
    excluded = {*_NO_VARIABLES, y, *declared}
    names = [name for name in _single_letters(tokens, declared) if name not in excluded and is_letter(name)]
    usual = tokens.variable or DEFAULT_VARIABLE
    default = next((name for name in (usual, *"txsz") if name not in (y, *declared)), usual)
    for likely in (DEFAULT_VARIABLE, default, "t"):
        if likely in names:
            return likely, []
    likely_ones = [name for name in names if _varies(name, tokens, names)]
    if len(likely_ones) > 1:
        hint = f"write {y}''(x) for the derivative, or name the variable:"
        said = f"{', '.join(likely_ones[:6])}: which is the variable?"
        k = tokens.names.get(likely_ones[-1], 0)
        first = likely_ones[0]
        raise tokens.error(InputError, said, k, k + 1, hint=f"{hint} var={first!r}", shell=f"{hint} --var {first}")
    if likely_ones:
        return likely_ones[0], [f"{likely_ones[0]} is taken for the variable"]
    which = "a parameter" if len(names) == 1 else "parameters"
    return default, [f"{default} is the variable, {', '.join(names[:6])} {which}"] if names else []


def _single_letters(tokens: ParserTokens, declared: Collection[str]) -> list[str]:
    """The plain names, those of two glued letters apart."""
    found = dict.fromkeys(letter for name in tokens.names for letter in _letters_of(name, declared))
    return [name for name in found if not is_function(name)]


def _letters_of(name: str, declared: Collection[str]) -> Sequence[str]:
    """Two letters that are glued together, or the name alone."""
    is_glued = len(name) == 2 and name.isalpha() and not is_letter(name) and name not in declared
    return name if is_glued else [name]


def argument_of(tokens: ParserTokens, unknown: str) -> str | None:
    """The name in y''(x), or in D(y, x) and Derivative(y, (x, 2)); None if the unknown function stands alone."""
    found = pattern(rf"{re.escape(unknown)}'* (?:\( ({_NAME}) \)|, (?:\( )?({_NAME}))").search(tokens.line)
    return found and (found[1] or found[2])


def _positions(name: str, tokens: ParserTokens) -> Iterator[str]:
    """The first role of each occurrence: "function" (or exponent), "power", "sum" (or denominator), "factor"."""
    heads = {k: tokens.kinds[k - 1] == "CIRCUMFLEX" or is_function(tokens.pieces[k - 1]) for k in tokens.partners}
    for k in (k for k, token in enumerate(tokens) if token[:2] == ("NAME", name)):
        before, after = tokens.kinds[k - 1], tokens.kinds[k + 1]
        around = [heads[begin] for begin, end in tokens.partners.items() if begin < k < end]
        if any(around) or before == "CIRCUMFLEX" or tokens.are(k - 2, "CIRCUMFLEX", "MINUS"):
            yield "function"
        elif after in ("CIRCUMFLEX", "SUPERSCRIPT"):
            yield "power"
        elif before == "SLASH" or tokens.are(k - 2, "SLASH", "LPAR"):
            yield "sum"
        else:
            yield "sum" if around and {before, after} & {"PLUS", "MINUS"} else "factor"


def _varies(name: str, tokens: ParserTokens, names: Collection[str]) -> bool:
    """True if a usual name of a variable occurs more than once, or not as a factor: constants hardly do.

    T, tau, rho, zeta, ... are often constants: they must occur in a function, or both as a power and otherwise.
    """
    is_ratio = name in _DAMPING_RATIOS and any(other.startswith(_FREQUENCIES) for other in names)
    has_small = name.lower() != name and name.lower() in names
    if is_ratio or has_small or name not in USUAL_VARIABLES:
        return False
    found = Counter(_positions(name, tokens))
    if name in _OFTEN_CONSTANT:
        return found["function"] > 0 or found.total() > found["power"] > 0
    return name == "z" or found.total() > min(found["factor"], 1)


def _variable_of_S(tokens: ParserTokens, _: str, declared: Collection[str]) -> tuple[str, list[str]]:
    """The only name that isn't one of a number, the energy or a function, or x.  Asks where it can't be told."""
    no_variables = {*NUMBER_NAMES, ENERGY, UNKNOWN, *declared}
    letters = [name for name in _single_letters(tokens, declared) if is_letter(name)]
    names = [name for name in letters if name not in no_variables] or [name for name in letters if name == EULER]
    try:
        x = chosen_variable(names)
    except InputError as error:
        k = tokens.names.get(names[1], 0)
        raise tokens.error(InputError, error.message, k, k + 1, hint=error.hint, shell=error.shell) from None
    why = f"{x} is taken for the variable; name another one where it is a parameter: var='x' (--var x)"
    return x, [] if x in USUAL_VARIABLES or x not in letters else [why]


def chosen_variable(names: Sequence[str]) -> str:
    """The only name, or x.  Raises `InputError` where neither is among several names."""
    if len(names) == 1:
        return names[0]
    if not names or DEFAULT_VARIABLE in names:
        return DEFAULT_VARIABLE
    usual = [name for name in names if name in USUAL_VARIABLES and name.islower()]
    likely = (usual or names)[0]
    raise InputError(
        f"which of {', '.join(names[:6])} is the variable?",
        hint=f"name it: var={likely!r}; the others are parameters",
        shell=f"name it: --var {likely}; the others are parameters",
    )

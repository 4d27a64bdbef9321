"""What stands around an equation that was pasted whole: a command of another system, an assignment, dollar signs; and values.

>>> unwrapped("sol := dsolve({diff(y(x),x$2) + y(x) = 0, y(0) = 1, D(y)(0) = 0}, y(x));").text
"diff(y(x),x$2) + y(x) = 0, y(0) = 1, y'(0) = 0"
>>> unwrapped("DSolve[y''[x] == x y[x], y[x], x]").text
"y''[x] == x y[x]"

Only what is around the equation is taken away, in linear time; what the rest means is found by `notation` and the parser.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from kovacic.errors import ParseError
from kovacic.reading.notation import plain
from kovacic.reading.parser import listed


class Unwrapped(NamedTuple):
    """An equation, and the values that were given with it, each as y'(a) = b."""

    equation: str
    values: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """Both, as `dsolve` reads them."""
        return ", ".join((self.equation, *self.values))


_COMMAND = re.compile(
    r"(?:(?:sympy|sp|sm)\.)?(N?DSolve(?:Value)?|dsolve|desolve|ode2|(?:DEtools\[)?kovacicsols\]?)\s*(?=[(\[])"
)
#: What programs print before a line that is typed.
_PROMPT = re.compile(r"(?:>+|In\[\d+\]:=|\(%i\d+\)|sage:)\s*")
#: The words and the space between an equation and its values in LaTeX.
_TEXT = re.compile(r"\\text\{\s*(and|with|where|subject to)\s*\}")
_SPACING = re.compile(r"\\(?:quad|qquad|[,;:! ])")
#: What assigns an equation to a name: ode := ..., eq: ..., eq = Eq(...).
_ASSIGNED = re.compile(
    r"\w+\s*(?::=?|=\s*(?=(?:(?:sympy|sp|sm)\.)?(?:Eq|N?DSolve|DSolveValue|dsolve|desolve|ode2)\s*[(\[]|[^=]*==))\s*"
)
_ENVIRONMENT = re.compile(r"\\begin\{(\w+\*?)\}(.*)\\end\{\1\}", re.DOTALL)
_LABEL = re.compile(r"\\(?:label|tag\*?)\{[^{}]*\}")
#: What an environment has beside its formula.
_ALIGNMENT = re.compile(r"&|\\\\|\\label\{[^{}]*\}|\\nonumber|\\notag|[.,]\s*$")
_DELIMITERS = (("$$", "$$"), ("$", "$"), ("\\[", "\\]"), ("\\(", "\\)"))
_OPENED = "([{"
_CLOSED = ")]}"
#: y, y(x), y[x]: what names the unknown function or the variable to a command.
_NAMED = re.compile(r"\w+(?:\(\w+\)|\[\w+\])?")
_NAME_OF_OPTION = re.compile(r"\w+\s*=(?!=)")


def unwrapped(text: str) -> Unwrapped:
    """The equation with its values, without what stands around them; a text that is none of these is its own equation.

    Raises `ParseError` for arguments of a command that are neither.
    """
    if "\\" in text:
        text = _LABEL.sub("", text)
    inner = _without_assignment(_without_delimiters(_without_prompt(text.strip())))
    command = _COMMAND.match(inner)
    if command is None:
        if "=" in inner and _is_list(inner):
            return _of_arguments("", f"({inner})", text)
        if inner == text.strip():  # nothing stands around it
            return Unwrapped(text)
        return Unwrapped(inner)
    call = inner[command.end() :].rstrip(";:$ \n")
    if not _is_enclosed(call):
        return Unwrapped(inner)
    return _of_arguments(command[1], call, text)


def without_spacing(text: str) -> str:
    """Without LaTeX's commands for space, whose commas and semicolons separate nothing."""
    if "\\" not in text:
        return text
    return _TEXT.sub(r" \1 ", _SPACING.sub(" ", text))


def _without_prompt(text: str) -> str:
    prompt = _PROMPT.match(text)
    if prompt is None:
        return text
    return text[prompt.end() :]


def _without_assignment(text: str) -> str:
    assigned = _ASSIGNED.match(text)
    if assigned is None:
        return text
    return text[assigned.end() :].removesuffix(":")  # Maple's silent end


def _without_delimiters(text: str) -> str:
    """Without dollar signs, or an environment of LaTeX, around the whole text."""
    environment = _ENVIRONMENT.fullmatch(text)
    if environment is not None:
        between_lines = ", " if environment[1] == "cases" else " "
        inside = environment[2].replace("\\\\", between_lines)
        return _ALIGNMENT.sub(" ", inside).strip()
    if text.endswith(("$,", "$.", "$;", " .")):
        text = text[:-1].rstrip()
    for opening, closing in _DELIMITERS:
        if not (text.startswith(opening) and text.endswith(closing)):
            continue
        inner = text[len(opening) : -len(closing)]
        if inner.strip() and opening not in inner:
            return inner.strip()
    return text


def _is_list(text: str) -> bool:
    """Is the whole text a list or a set?"""
    return text.startswith(("{", "[")) and _is_enclosed(text)


def _is_enclosed(call: str) -> bool:
    """Is a text enclosed by one pair of parentheses or brackets?"""
    depth = 0
    for k, character in enumerate(call):
        if character in _OPENED:
            depth += 1
        elif character in _CLOSED:
            depth -= 1
        if depth == 0:
            return k == len(call) - 1
    return False


def _of_arguments(command: str, call: str, text: str) -> Unwrapped:
    """What the arguments of a command in a text say: its equation, values, and names that are in the equation as well."""
    first, *rest = _listed(call[1:-1])
    equations = _listed(first[1:-1]) if _is_list(first) else [first]
    equation, *given = [_unquoted(part) for part in equations]
    variable = None
    for argument in rest:
        part = _unquoted(argument)
        is_quoted = part != argument
        values = _values_in(part)
        if values is not None:
            given += values
        elif _NAMED.fullmatch(part) and is_quoted:  # MATLAB's variable
            variable = part
        elif not _is_name_in(part, equation):
            said = f"{part} isn't read in {command}(...)"
            hint = f"give the equation and its values: {', '.join((equation, *given))}"
            raise ParseError(said, text=text, position=text.find(argument), length=len(argument), hint=hint)
    if variable is not None:
        equation = _differentiated_by(variable, equation)
    values_found: list[str] = []
    for part in given:
        values_found += plain_values(part)
    return Unwrapped(equation, tuple(values_found))


def _values_in(part: str) -> list[str] | None:
    """The values in an argument: in SymPy's ics={...}, in a list, or one alone; None where it is something else."""
    if re.match(r"ics\s*=", part) and part.endswith("}"):
        return _of_mapping(part)
    if "=" not in part:
        return None
    if _is_list(part):
        return _listed(part[1:-1])
    if _NAME_OF_OPTION.match(part):
        return None
    return [part]


def _is_name_in(part: str, equation: str) -> bool:
    """Is it y, y(x) or y[x], with a name that occurs in the equation?"""
    if not _NAMED.fullmatch(part):
        return False
    name = re.split(r"\W", part)[0]
    return re.search(rf"(?<![^\W\d_]){name}(?![^\W_])", equation) is not None


def _listed(text: str) -> list[str]:
    """The parts between commas that are outside all parentheses, brackets and braces."""
    return listed(text, _OPENED, _CLOSED)


def _unquoted(part: str) -> str:
    """Without quotation marks around it; an apostrophe before diff is Maxima's."""
    is_quoted = len(part) > 1 and part[0] == part[-1] and part[0] in "'\""
    return part[1:-1].strip() if is_quoted else part


def _of_mapping(option: str) -> list[str]:
    """y(0) = 1 for each y(0): 1 of SymPy's ics={...}."""
    inside = option[option.index("{") + 1 : -1]
    return [part.replace(":", "=", 1) for part in _listed(inside) if part]


def _differentiated_by(variable: str, equation: str) -> str:
    """MATLAB's D2y and Dy as derivatives by the variable that the command names."""
    return re.sub(r"\bD([2-4]?)([A-Za-z])\b", lambda found: f"diff({found[2]}, {variable}, {found[1] or 1})", equation)


def plain_values(text: str) -> list[str]:
    """y'(a) = b for a value as it is written elsewhere; y(a) = y'(a) = b are two.

    >>> plain_values("y'[0] == 0"), plain_values("Derivative(y(x), x).subs(x, 0) = 0"), plain_values("y(0) = y'(0) = 1")
    (["y'(0) = 0"], ["y'(0) = 0"], ['y(0) = 1', "y'(0) = 1"])
    """
    for pattern, replacement in _VALUES:
        text = pattern.sub(replacement, text)
    *places, value = (side.strip() for side in text.split("="))
    if len(places) < 2:
        return [_without_latex(text)]
    return [_without_latex(f"{place} = {value}") for place in places]


_Y_OF_X = r"(\w)\(\w\)"
#: How values are written elsewhere, from left to right, and what they are here.
_VALUES: list[tuple[re.Pattern[str], str]] = [
    (re.compile(pattern), replacement)
    for pattern, replacement in (
        (r"==", "="),
        (r"\bPi\b", "pi"),
        (r"(?<=\w)[´`‘’′]|(?<=['´`‘’′])[´`‘’′]", "'"),
        (r"(\w'*)\[([^\[\]]*)\]", r"\1(\2)"),
        (r"\(?\bD\(\s*(\w)\s*\)\)?\s*(?=\()", r"\1'"),
        (r"\bD([a-z])\s*(?=\()", r"\1'"),
        (rf"{_Y_OF_X}\.diff\(\w\)\.subs\(\s*\w\s*,\s*([^()]*)\)", r"\1'(\2)"),
        (rf"(?:diff|Derivative)\({_Y_OF_X}\s*,\s*\w\)\.subs\(\s*\w\s*,\s*([^()]*)\)", r"\1'(\2)"),
        (rf"Subs\(\s*(?:diff|Derivative)\({_Y_OF_X}\s*,\s*\w\)\s*,\s*\w\s*,\s*([^()]*)\)", r"\1'(\2)"),
        (r"\\[dt]?frac\s*\{\s*d\s*(\w)\s*\}\s*\{\s*d\s*\w\s*\}\s*(?=\()", r"\1'"),
        (r"(?<!\w)d(\w)/d\w\s*(?=\()", r"\1'"),
    )
]


def _without_latex(text: str) -> str:
    """y'(pi) = 0 for \\dot{y}(\\pi) = 0: a value may be in LaTeX, as its equation is."""
    if "\\" not in text and "^{" not in text:
        return text
    text = re.sub(r"\\(?:quad|qquad|left|right|,|;|:|!)", " ", text)
    text = re.sub(r"\\ddot\s*\{?\s*(\w)\s*\}?", r"\1''", text)
    text = re.sub(r"\\dot\s*\{?\s*(\w)\s*\}?", r"\1'", text)
    text = re.sub(r"\^\s*\{?\s*(?:\\prime|'|\(1\))\s*\}?", "'", text)
    parts = _LATEX_VALUE.match(text)
    if parts is None:
        return text
    return f"{parts['function']}({plain(parts['point']).text}) = {plain(parts['value']).text}"


#: y'(a) = b, with LaTeX in a and b alone.
_LATEX_VALUE = re.compile(r"\s*(?P<function>\w+'*)\s*\((?P<point>[^=]*)\)\s*=(?P<value>.*)", re.DOTALL)

"""Values of parameters, put into the text of an equation before it is read.

A value takes the place of the parameter's name as a number in parentheses, which is what a name is to the grammar: an atom.
So the result means what the text meant, and no arithmetic is done here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from kovacic.algebra.rationals import QQ
from kovacic.equation import Parsed, parameters_of
from kovacic.errors import InputError
from kovacic.exact import exact_text
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.numerals import plain_text
from kovacic.reading.lexer import tokenize
from kovacic.reading.read import read_input

#: What is known about a parameter, in words and inequalities; anything else is its value.
_WORDS = re.compile(r"(\s*([A-Za-z-]{2,}|([<>]=?|!=)\s*[^\s,<>=!]+),?)*\s*")
#: `0 < E <= 20`: the lower end, two signs around a name, the upper end.
_CHAIN = re.compile(r"\s*([^<>=!]+?)\s*([<>]=?)\s*(\w+)\s*([<>]=?)\s*([^<>=!]+?)\s*")
_TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


class Template:
    """A text whose parameters have been found, to be filled with many values.

    Raises `InputError` where the text has no such name, or uses one as a function.

    >>> from fractions import Fraction
    >>> Template("(4*n^2 - 1)/(4*x^2) - n", ["n"]).filled({"n": Fraction(-1, 2)})
    '(4*(-1/2)^2 - 1)/(4*x^2) - (-1/2)'
    """

    def __init__(self, text: str, names: Sequence[str]) -> None:
        tokens = tokenize(text)
        places = [k for k, token in enumerate(tokens.pieces) if token in names]
        for k in places:
            if tokens.kinds[k] != "NAME":
                message = f"the parameter {tokens.pieces[k]} is followed by a parenthesis like a function"
                hint = f"for a product write {tokens.pieces[k]}*(...)"
                raise tokens.error(InputError, message, k, k + 1, hint=hint)
        for name in names:
            if name not in (tokens.pieces[k] for k in places):
                raise InputError(f"the expression has no parameter {name}", text=text)
        ends = [0, *(tokens.ends[k] for k in places)]
        starts = [*(tokens.starts[k] for k in places), len(text)]
        self._pieces = [text[end:start] for end, start in zip(ends, starts, strict=True)]
        self._names = [tokens.pieces[k] for k in places]

    def filled(self, values: Mapping[str, Any]) -> str:
        """The text with these values."""
        given = [f"({values[name]})" for name in self._names] + [""]
        return "".join(piece + value for piece, value in zip(self._pieces, given, strict=True))


def number_text(value: Any, limits: Limits = DEFAULT_LIMITS) -> str:
    """The value of a parameter as text: a rational or algebraic number.  Raises `InputError` for anything else."""
    text = exact_text(value, "the value of a parameter")
    number = read_input(text, var="x_", limits=limits).S
    if number.num.degree > 0 or number.den.degree > 0 or number.field.ground != QQ:
        raise InputError(f"{text!r} isn't a number")
    return text


def relations(text: str) -> tuple[str, str] | None:
    """The name in an inequality with two ends, and what it says of the name; None for any other text.

    >>> relations("0 < E <= 20")
    ('E', '>0 <=20')
    """
    match = _CHAIN.fullmatch(text)
    if match is None:
        return None
    first, sign, name, other, last = match.groups()
    return name, f"{_TURNED[sign]}{first} {other}{last}"


def value_text(value: Any, parameter: str, variable: str, limits: Limits = DEFAULT_LIMITS) -> str:
    """The value of a parameter as text: a number, or a function b^2 of other parameters.  Raises `InputError` for others."""
    text = exact_text(value, "the value of a parameter")
    read = read_input(text, var="x_", limits=limits).S
    names = parameters_of(read.field)
    if read.num.degree > 0 or read.den.degree > 0 or {parameter, variable} & {*names}:
        raise InputError(
            f"{text!r} isn't a number", hint="the value of a parameter is a number, or a function of others"
        )
    return text


def with_values(
    S: Any, parsed: Parsed, assume: Mapping[Any, Any] | None, limits: Limits
) -> tuple[Any, Parsed, Mapping[Any, Any] | None]:
    """The input with the values that are among the assumptions, {"n": 3}, as it is read then, and the other assumptions.

    Raises `InputError` for values that aren't numbers, or of what isn't a parameter.

    >>> S = "(4*n^2 - 1)/(4*x^2) - k"
    >>> text, parsed, rest = with_values(S, read_input(S), {"n": "3/2", "k": "integer"}, DEFAULT_LIMITS)
    >>> text, rest
    ('(4*(3/2)^2 - 1)/(4*x^2) - k', {'k': 'integer'})
    """
    given = {name: _told(str(name), what) for name, what in assume.items()} if isinstance(assume, Mapping) else {}
    values = {str(name): what for name, what in given.items() if _WORDS.fullmatch(plain_text(what)) is None}
    if not values:
        return S, parsed, given or assume
    names = parameters_of(parsed.S.field)
    for name in values:
        if name not in names:
            raise InputError(f"{name} isn't a parameter of S", hint=f"the parameters are {', '.join(names) or 'none'}")
    texts = {name: value_text(value, name, parsed.variable, limits) for name, value in values.items()}
    change = None if parsed.equation is None else parsed.equation.change
    text = parsed.text if change is None and not isinstance(S, str) else plain_text(S).strip()
    filled = Template(text, [*texts]).filled(texts)
    rest = {name: what for name, what in given.items() if str(name) not in texts}
    variable = parsed.variable if change is None else change.variable
    return filled, read_input(filled, var=variable, limits=limits, exponentials=True), rest or None


def _told(name: str, what: Any) -> Any:
    """What is said of a parameter; an inequality with two ends in two parts."""
    both = relations(what) if isinstance(what, str) else None
    return what if both is None or both[0] != name else both[1]

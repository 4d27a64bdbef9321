"""Values of parameters, put into the text of an equation before it is read.

A value takes the place of the parameter's name as a number in parentheses, which is what a name is to the grammar: an atom.
So the result means what the text meant, and no arithmetic is done here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import Change, Parsed, parameters_of
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.numbers.exact import exact_text
from kovacic.numbers.numerals import plain_text
from kovacic.reading.dialects import tokenize
from kovacic.reading.lexer import Tokens
from kovacic.reading.names import words_among
from kovacic.reading.read import read_input
from kovacic.reading.source import source_of

#: What is known about a parameter, in words and inequalities; anything else is its value.
_WORDS = re.compile(r"(\s*([A-Za-z-]{2,}|([<>]=?|!=)\s*[^\s,<>=!]+),?)*\s*")
#: `0 < E <= 20`: the lower end, two signs around a name, the upper end.
_CHAIN = re.compile(r"\s*([^<>=!]+?)\s*([<>]=?)\s*(\w+)\s*([<>]=?)\s*([^<>=!]+?)\s*")
#: A variable that no value contains.
_NO_VARIABLE = "x_"
_TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


class Template:
    """A text whose parameters have been found, to be filled with many values.

    Raises `InputError` where the text has no such name, or uses one as a function.

    >>> from fractions import Fraction
    >>> Template("(4*n^2 - 1)/(4*x^2) - n", ["n"]).filled({"n": Fraction(-1, 2)})
    '(4*(-1/2)^2 - 1)/(4*x^2) - (-1/2)'
    """

    def __init__(self, text: str, names: Sequence[str], variable: str | None = None) -> None:
        tokens = _tokens(text, names, variable)
        places = [k for k, piece in enumerate(tokens.pieces) if piece in names]
        for k in places:
            if tokens.kinds[k] != "NAME":
                name = tokens.pieces[k]
                said = f"the parameter {name} is followed by a parenthesis like a function"
                raise tokens.error(InputError, said, k, k + 1, hint=f"for a product write {name}*(...)")
        #: The parameters in the order of the text, and the pieces of text before, between and behind them.
        self._names = [tokens.pieces[k] for k in places]
        self._pieces: list[str] = []
        end = 0
        for k in places:
            self._pieces.append(text[end : tokens.starts[k]])
            end = tokens.ends[k]
        self._pieces.append(text[end:])
        for name in names:
            if name not in self._names:
                raise InputError(f"the expression has no parameter {name}", text=text)

    def filled(self, values: Mapping[str, Any]) -> str:
        """The text with these values."""
        first, *others = self._pieces
        filled = [first]
        for name, piece in zip(self._names, others, strict=True):
            filled += [f"({values[name]})", piece]
        return "".join(filled)


def _tokens(text: str, names: Sequence[str], variable: str | None) -> Tokens:
    """The tokens of a text, products that are glued together apart where it can be told."""
    try:
        tokens = source_of(text, variable, names=names).tokens
    except InputError:  # of which the reader of the filled text will speak
        return tokenize(text)
    assert tokens is not None
    return tokens


def number_text(value: Any, limits: Limits = DEFAULT_LIMITS) -> str:
    """The value of a parameter as text: a rational or algebraic number.  Raises `InputError` for anything else."""
    text = exact_text(value, "the value of a parameter")
    number = read_input(text, var=_NO_VARIABLE, limits=limits).S
    if not _is_constant(number) or number.field.ground != QQ:
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
    value_read = read_input(text, var=_NO_VARIABLE, limits=limits).S
    names = parameters_of(value_read.field)
    if not _is_constant(value_read) or parameter in names or variable in names:
        hint = "the value of a parameter is a number, or a function of others"
        raise InputError(f"{text!r} isn't a number", hint=hint)
    return text


def _is_constant(function: RatFunc) -> bool:
    return function.num.degree <= 0 and function.den.degree <= 0


class Substituted(NamedTuple):
    """An input in which values have taken the place of parameters, as it is read, and what is known of the others."""

    given: Any
    parsed: Parsed
    assumptions: Mapping[Any, Any] | None


def with_values(S: Any, parsed: Parsed, assume: Mapping[Any, Any] | None, limits: Limits) -> Substituted:
    """The input with the values that are among the assumptions, {"n": 3}, as it is read then, and the other assumptions.

    Raises `InputError` for values that aren't numbers, or of what isn't a parameter.

    >>> S = "(4*n^2 - 1)/(4*x^2) - k"
    >>> text, parsed, rest = with_values(S, read_input(S), {"n": "3/2", "k": "integer"}, DEFAULT_LIMITS)
    >>> text, rest
    ('(4*(3/2)^2 - 1)/(4*x^2) - k', {'k': 'integer'})
    """
    if not isinstance(assume, Mapping):
        return Substituted(S, parsed, assume)
    values, others = values_among(assume)
    if not values:
        return Substituted(S, parsed, others or assume)
    names = parameters_of(parsed.S.field)
    for name in values:
        if name not in names:
            raise InputError(f"{name} isn't a parameter of S", hint=f"the parameters are {', '.join(names) or 'none'}")
    texts = {name: value_text(value, name, parsed.variable, limits) for name, value in values.items()}
    template = _text_with_parameters(S, parsed)
    filled = Template(template, [*texts], _user_variable(parsed)).filled(texts)
    declared = words_among(names)
    read = read_input(filled, var=_user_variable(parsed), limits=limits, exponentials=True, names=declared)
    return Substituted(filled, read, others or None)


def values_among(assume: Mapping[Any, Any]) -> tuple[dict[str, Any], dict[Any, Any]]:
    """The values, by name, and what else is assumed."""
    told = {name: _told(str(name), what) for name, what in assume.items()}
    others = {name: what for name, what in told.items() if _WORDS.fullmatch(plain_text(what)) is not None}
    return {str(name): what for name, what in told.items() if name not in others}, others


def _told(name: str, what: Any) -> Any:
    """What is said of a parameter; an inequality with two ends in two parts."""
    if not isinstance(what, str):
        return what
    chain = relations(what)
    if chain is None or chain[0] != name:
        return what
    return chain[1]


def _text_with_parameters(S: Any, parsed: Parsed) -> str:
    """The input as the user's text, or as one where S is none; in the user's variable where there is a change of it."""
    if _change(parsed) is None and not isinstance(S, str):
        return parsed.text
    return plain_text(S).strip()


def _user_variable(parsed: Parsed) -> str:
    change = _change(parsed)
    return parsed.variable if change is None else change.variable


def _change(parsed: Parsed) -> Change | None:
    return None if parsed.equation is None else parsed.equation.change

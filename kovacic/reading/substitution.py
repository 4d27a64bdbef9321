"""Values of parameters, put into the text of an equation before it is read.

A value takes the place of the parameter's name as a number in parentheses, which is what a name is to the grammar: an atom.
So the result means what the text meant, and no arithmetic is done here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from kovacic.equation import Parsed, parameters_of
from kovacic.errors import InputError
from kovacic.limits import DEFAULT_LIMITS, Limits
from kovacic.numbers.exact import exact_text
from kovacic.numbers.numerals import plain_text
from kovacic.reading.dialects import tokenize
from kovacic.reading.names import words_among
from kovacic.reading.read import read_input
from kovacic.reading.source import source_of

#: Facts about a parameter, in words and inequalities; any other text is its value.
_FACT_WORDS = re.compile(r"(\s*([A-Za-z-]{2,}|([<>]=?|!=)\s*[^\s,<>=!]+),?)*\s*")
#: `0 < E <= 20`: the lower end, two signs around a name, the upper end.
_CHAIN = re.compile(r"\s*([^<>=!]+?)\s*([<>]=?)\s*(\w+)\s*([<>]=?)\s*([^<>=!]+?)\s*")
#: A variable that no value contains.
_NO_VARIABLE = "x_"
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


class Template:
    """A text whose parameters have been found, to be filled with many values.

    Raises `InputError` where the text has no such name, or uses one as a function.

    >>> from fractions import Fraction
    >>> Template("(4*n^2 - 1)/(4*x^2) - n", ["n"]).filled({"n": Fraction(-1, 2)})
    '(4*(-1/2)^2 - 1)/(4*x^2) - (-1/2)'
    """

    def __init__(self, text: str, names: Sequence[str], variable: str | None = None) -> None:
        try:  # products that are glued together are apart, where it can be told
            tokens = source_of(text, variable, names=names).tokens or tokenize(text)
        except InputError:  # of which the reader of the filled text will speak
            tokens = tokenize(text)
        places = [k for k, piece in enumerate(tokens.pieces) if piece in names]
        for k in places:
            if tokens.kinds[k] != "NAME":
                name = tokens.pieces[k]
                said = f"the parameter {name} is followed by a parenthesis like a function"
                raise tokens.error(InputError, said, k, k + 1, hint=f"for a product write {name}*(...)")
        self._text = text
        self._places = [tokens[k] for k in places]
        for name in names:
            if name not in {token.text for token in self._places}:
                raise InputError(f"the expression has no parameter {name}", text=text)

    def filled(self, values: Mapping[str, Any]) -> str:
        """The text with these values."""
        ends = [0, *(token.end for token in self._places)]
        before = [self._text[end : token.start] for end, token in zip(ends, self._places, strict=False)]
        filled = (f"{text}({values[token.text]})" for text, token in zip(before, self._places, strict=True))
        return "".join([*filled, self._text[ends[-1] :]])


def number_text(value: Any, limits: Limits = DEFAULT_LIMITS) -> str:
    """The value of a parameter as text: a rational or algebraic number.  Raises `InputError` for anything else."""
    text = value_text(value, limits=limits)
    if parameters_of(read_input(text, var=_NO_VARIABLE, limits=limits).S.field):
        raise InputError(f"{text!r} isn't a number")
    return text


def relations(text: str) -> tuple[str, str] | None:
    """The name in an inequality with two ends and its two bounds, or None for any other text.

    >>> relations("0 < E <= 20")
    ('E', '>0 <=20')
    """
    match = _CHAIN.fullmatch(text)
    if match is None:
        return None
    first, sign, name, other, last = match.groups()
    return name, f"{_MIRRORED[sign]}{first} {other}{last}"


def value_text(value: Any, *excluded: str, limits: Limits = DEFAULT_LIMITS) -> str:
    """The value of a parameter as text: a number, or a function b^2 of parameters.

    Raises `InputError` for others, and where it contains one of the `excluded` names.
    """
    text = exact_text(value, "the value of a parameter")
    read = read_input(text, var=_NO_VARIABLE, limits=limits).S
    is_constant = read.num.degree <= 0 and read.den.degree <= 0
    if not is_constant or {*excluded} & {*parameters_of(read.field)}:
        hint = "the value of a parameter is a number, or a function of others"
        raise InputError(f"{text!r} isn't a number", hint=hint)
    return text


#: An input in which values have taken the place of parameters, the result of reading it, and the other assumptions.
Substituted = tuple[Any, Parsed, Mapping[Any, Any] | None]


def with_assumed_values(S: Any, parsed: Parsed, assume: Mapping[Any, Any] | None, limits: Limits) -> Substituted:
    """The input with the values that are among the assumptions, {"n": 3}, the result of reading it, and the other assumptions.

    Raises `InputError` for values that aren't numbers, or of what isn't a parameter.

    >>> S = "(4*n^2 - 1)/(4*x^2) - k"
    >>> text, parsed, rest = with_assumed_values(S, read_input(S), {"n": "3/2", "k": "integer"}, DEFAULT_LIMITS)
    >>> text, rest
    ('(4*(3/2)^2 - 1)/(4*x^2) - k', {'k': 'integer'})
    """
    if not isinstance(assume, Mapping):
        return S, parsed, assume
    values, others = values_among(assume)
    if not values:
        return S, parsed, others or assume
    names = parameters_of(parsed.S.field)
    for name in values:
        if name not in names:
            hint = f"the parameters are {', '.join(names) or 'none'}"
            raise InputError(f"{name} isn't a parameter of the equation", hint=hint)
    texts = {name: value_text(value, name, parsed.variable, limits=limits) for name, value in values.items()}
    # The user's text, or one where S is none; in the user's variable where there is a change of it.
    change = None if parsed.equation is None else parsed.equation.change
    variable = parsed.variable if change is None else change.variable
    template = parsed.text if change is None and not isinstance(S, str) else plain_text(S).strip()
    filled = Template(template, [*texts], variable).filled(texts)
    declared = words_among({*names} - {*dict(parsed.letters)})
    read = read_input(filled, var=variable, limits=limits, exponentials=True, names=declared)
    return filled, read, others or None


def values_among(assume: Mapping[Any, Any]) -> tuple[dict[str, Any], dict[Any, Any]]:
    """The values, by name, and what else is assumed; an inequality with two ends is in two parts."""
    told = dict(assume)
    for name, what in assume.items():
        chain = relations(what) if isinstance(what, str) else None
        if chain is not None and chain[0] == str(name):
            told[name] = chain[1]
    others = {name: what for name, what in told.items() if _FACT_WORDS.fullmatch(plain_text(what)) is not None}
    return {str(name): what for name, what in told.items() if name not in others}, others

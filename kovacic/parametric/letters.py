"""Parameters that stand for constants, sqrt(a) or exp(a/2), by the name of what they stand for.

The engine computes with a letter for each; in all that is printed, in values and in solutions they are the user's own.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.equation import Parsed
from kovacic.errors import InputError
from kovacic.numbers.numerals import as_text
from kovacic.parametric.functions import over_parameters
from kovacic.reading.symbolic import read_expression
from kovacic.writing.formula import caret

#: Names of parameters that aren't the user's, with what they stand for.
Letters = tuple[tuple[str, Any], ...]


def spelled(parsed: Parsed) -> tuple[Parsed, Letters]:
    """The input over the field whose parameters are called like what they stand for; as it is without letters.

    Beside an algebraic constant the letters stay.
    """
    field = parsed.S.field
    if not isinstance(field, FunctionField):
        return parsed, parsed.letters
    if not parsed.letters:
        return parsed, ()
    meanings = dict(parsed.letters)
    letters = tuple((_spelling(meanings[name]), meanings[name]) for name in field.names if name in meanings)
    larger = FunctionField(tuple(_spelling(meanings[name]) if name in meanings else name for name in field.names))
    equation = parsed.equation
    if equation is not None:
        a, b, c, f = (_over(part, larger) for part in (equation.a, equation.b, equation.c, equation.f))
        equation = replace(equation, a=a, b=b, c=c, f=f)
    said = tuple(f"{name} is " for name in meanings)
    notices = tuple(notice for notice in parsed.notices if not notice.startswith(said))
    return replace(parsed, S=_over(parsed.S, larger), equation=equation, notices=notices, letters=()), letters


def _spelling(meaning: Any) -> str:
    """sqrt(a), exp(a/2), and powers in parentheses: (a^(1/3)), so that they can be raised to others."""
    text = caret(as_text(meaning))
    is_power = meaning.is_Pow and meaning.exp != sympy.S.Half and meaning.base != sympy.E
    return f"({text})" if is_power else text


def _over(function: RatFunc, field: FunctionField) -> RatFunc:
    """The same function with other names for the parameters."""
    return RatFunc(_renamed(function.num, field), _renamed(function.den, field), reduced=True)


def _renamed(polynomial: Poly, field: FunctionField) -> FunctionPoly:
    known = over_parameters(polynomial)
    return FunctionPoly(field, known.num, known.den)


def own_parameters(names: Sequence[str], letters: Letters) -> tuple[str, ...]:
    """The user's parameters: those in what letters stand for, in the place of the letters."""
    meanings = dict(letters)
    found: dict[str, None] = {}
    for name in names:
        symbols = sorted(symbol.name for symbol in meanings[name].free_symbols) if name in meanings else [name]
        found.update(dict.fromkeys(symbols))
    return tuple(found)


def letters_from(names: Sequence[str], parameters: Collection[str]) -> Letters:
    """Those among names that are no parameters of the user's: formulas, and numbers."""
    return tuple((name, read_expression(name)) for name in names if name not in parameters)


def nonzero(letters: Letters) -> list[str]:
    """The letters for exponentials, and powers of numbers, which have no zeros."""
    found = []
    for name, meaning in letters:
        base, _ = meaning.as_base_exp()
        if isinstance(meaning, sympy.exp) or (base.is_number and base.is_nonzero):
            found.append(name)
    return found


def values_of_letters(values: Mapping[str, Any], letters: Letters) -> dict[str, Any]:
    """The values of the letters where the user's parameters have these, SymPy's.

    Raises `InputError` for what isn't an algebraic number.
    """
    numbers = {sympy.Symbol(name): value for name, value in values.items()}
    found = {}
    for name, meaning in letters:
        value = meaning.subs(numbers)
        if not value.is_algebraic:
            raise InputError(f"{name} is {value} there, which isn't known to be an algebraic number")
        found[name] = value
    return found

"""Constants for which letters stand while the spectrum is looked for: sqrt(a), and square roots of several numbers.

One square root, or another root of one number, is computed with as such.  Several of them would have a common generator, that
isn't written in the user's roots, and beside sines and cosines there is I; so each is a positive parameter, and its value is
put in at the end.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import count
from typing import Any

import sympy
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.bound_states.answer import Algebraic, Levels, Spectrum
from kovacic.errors import InputError
from kovacic.numerals import as_text
from kovacic.reading.symbolic import names_of, read_expression
from kovacic.writing.formula import caret

#: The steps from one number to the next, between which a root is said to lie.
_STEPS = 10**6


def with_named_roots(V: Any) -> tuple[Any, dict[str, Any]]:
    """V with names for its roots of numbers, where there are several or nested ones, and what the names mean."""
    try:
        expression = read_expression(V) if isinstance(V, str) else sympy.sympify(V)
    except (InputError, sympy.SympifyError):  # said where it is read
        return V, {}
    powers = (e for e in expression.atoms(sympy.Pow) if e.is_number and not e.exp.is_Integer)
    roots = sorted((e for e in powers if e.is_positive and e.is_algebraic), key=sympy.default_sort_key)
    is_enough = len(roots) > 1 or (roots and expression.has(TrigonometricFunction))
    if not is_enough:
        return V, {}
    outermost = [e for e in roots if not any(e is not other and other.has(e) for other in roots)]
    taken = {*names_of(expression)}
    names = (name for name in map("root_{}".format, count(1)) if name not in taken)
    meanings = dict(zip(names, outermost, strict=False))
    return expression.xreplace({e: sympy.Symbol(name) for name, e in meanings.items()}), meanings


def assumed_of_letters(
    assume: Mapping[Any, Any] | None, letters: Sequence[tuple[str, Any]]
) -> Mapping[Any, Any] | None:
    """What is assumed, with that of a letter for sqrt(a): it isn't negative, and positive where a is."""
    found = dict(assume or {})
    for letter, meaning in letters:
        base, exponent = meaning.as_base_exp()
        if exponent == sympy.S.Half and base.is_Symbol:
            own = next((key for key in found if str(key) == base.name), None)
            word = found.pop(own, "nonnegative") if own is not None else "nonnegative"
            found[letter] = "positive" if word in ("positive", ">0") else "nonnegative"
    return found if letters else assume


def between(value: Any, name: str) -> str:
    """That a letter lies between two decimals, as an assumption."""
    below = sympy.floor(value * _STEPS)
    return f"{sympy.Rational(below, _STEPS)}<{name}<{sympy.Rational(below + 1, _STEPS)}"


def in_their_meanings(found: Spectrum, meanings: Mapping[str, Any]) -> Spectrum:
    """The answer with the meanings in the place of the letters."""
    values = {sympy.Symbol(name): meaning for name, meaning in meanings.items()}

    def put_in(expression: Any) -> Any:
        return sympy.sympify(expression).xreplace(values)

    def said(text: str) -> str:
        for name, meaning in meanings.items():
            text = re.sub(rf"\b{name}\b", lambda _: caret(as_text(meaning)), text)  # noqa: B023
        return text

    def conditions(one: Levels | Algebraic) -> tuple[Any, ...]:
        return tuple(c for c in map(put_in, one.conditions) if c != sympy.true)

    levels = [
        replace(
            one,
            energy=put_in(one.energy),
            wave=put_in(one.wave),
            conditions=conditions(one),
            zeros=put_in(one.zeros),
            norm=None if one.norm is None else put_in(one.norm),
        )
        for one in found.levels
    ]
    algebraic = [
        replace(
            one,
            constraint=put_in(one.constraint),
            polynomial=put_in(one.polynomial),
            wave=put_in(one.wave),
            conditions=conditions(one),
        )
        for one in found.algebraic
    ]
    others = {name for meaning in meanings.values() for name in names_of(meaning)}
    parameters = [name for name in found.parameters if name not in meanings]
    known = tuple((name, known) for name, known in found.assumptions.known if name not in meanings)
    return replace(
        found,
        potential=put_in(found.potential),
        parameters=(*parameters, *sorted(others - {*parameters})),
        assumptions=replace(found.assumptions, known=known),
        ends=tuple(map(said, found.ends)),
        excluded=tuple(e for e in map(put_in, found.excluded) if e != sympy.false),
        levels=tuple(one for one in levels if sympy.false not in one.conditions),
        algebraic=tuple(one for one in algebraic if sympy.false not in one.conditions),
        reason=said(found.reason),
    )

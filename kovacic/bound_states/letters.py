"""Constants for which letters stand while the spectrum is looked for: sqrt(a), and square roots of several numbers.

One square root, or another root of one number, is computed with as such.  Several of them would have a common generator, that
isn't written in the user's roots, and beside sines and cosines there is I; so each is a positive parameter, and its value is
put in at the end.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from itertools import count
from typing import Any, TypeVar

import sympy
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.bound_states.levels import NO_FORMULA, Algebraic, Levels, Spectrum
from kovacic.errors import InputError
from kovacic.numbers.numerals import as_text
from kovacic.reading.symbolic import names_of, read_expression
from kovacic.writing.formula import caret

#: What can be assumed of a parameter under a root, and what is known of its root then.
_SIGNS = {
    "positive": "positive",
    ">0": "positive",
    "nonnegative": "nonnegative",
    ">=0": "nonnegative",
    "real": "nonnegative",
}
#: A root is enclosed between neighbouring multiples of the inverse of this number.
_STEPS = 10**6
LevelsOrAlgebraic = TypeVar("LevelsOrAlgebraic", Levels, Algebraic)


def with_named_roots(V: Any) -> tuple[Any, dict[str, Any]]:
    """V with names for its roots of numbers, where there are several or nested ones, and what the names mean."""
    try:
        expression = read_expression(V) if isinstance(V, str) else sympy.sympify(V)
    except (InputError, sympy.SympifyError):  # reported by the reader
        return V, {}
    powers = (power for power in expression.atoms(sympy.Pow) if power.is_number and not power.exp.is_Integer)
    roots = sorted((p for p in powers if p.is_positive and p.is_algebraic), key=sympy.default_sort_key)
    least = 1 if expression.has(TrigonometricFunction) else 2
    if len(roots) < least:
        return V, {}
    outermost = [root for root in roots if not any(root is not other and other.has(root) for other in roots)]
    taken = {*names_of(expression)}
    names = (name for name in map("root_{}".format, count(1)) if name not in taken)
    meanings = dict(zip(names, outermost, strict=False))
    return expression.xreplace({root: sympy.Symbol(name) for name, root in meanings.items()}), meanings


def assumed_of_letters(
    assume: Mapping[Any, Any] | None, letters: Sequence[tuple[str, Any]]
) -> Mapping[Any, Any] | None:
    """What is assumed, and the sign of a letter for log(2), or for sqrt(a): not negative, and positive where a is.

    Raises `InputError` where something else than that is assumed of such an a.
    """
    if not letters:
        return assume
    found = dict(assume or {})
    for letter, meaning in letters:
        base, exponent = meaning.as_base_exp()
        if exponent == sympy.S.Half and base.is_Symbol:
            found[letter] = _sign_of_root(base.name, found)
        elif meaning.is_number and meaning.is_real:
            found[letter] = "positive" if meaning.is_positive else "negative"
    return found


def _sign_of_root(name: str, assumed: dict[Any, Any]) -> str:
    """Of the root of a parameter, of which nothing is `assumed` afterwards: it occurs in its root alone."""
    key = next((key for key in assumed if str(key) == name), None)
    if key is None:
        return "nonnegative"
    said = assumed.pop(key)
    word = said.replace(" ", "") if isinstance(said, str) else said
    if word not in _SIGNS:
        raise InputError(
            f"sqrt({name}) is real, and of {name} it can be assumed only that it is positive or nonnegative",
            hint=f'assume={{"{name}": "positive"}}, or write {name} = b^2 where more is known',
            shell=f"--assume {name}=positive, or write {name} = b^2 where more is known",
        )
    return _SIGNS[word]


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
            shown = caret(as_text(meaning))
            text = re.sub(rf"\b{name}\b", shown, text)
        return text

    def of(one: LevelsOrAlgebraic) -> LevelsOrAlgebraic:
        """The levels without letters, and without conditions that say nothing."""
        parts = {field.name: getattr(one, field.name) for field in fields(one)}
        changed = {name: put_in(part) for name, part in parts.items() if isinstance(part, sympy.Expr)}
        conditions = tuple(condition for condition in map(put_in, one.conditions) if condition != sympy.true)
        return replace(one, **changed, conditions=conditions)

    levels = tuple(one for one in map(of, found.levels) if sympy.false not in one.conditions)
    algebraic = tuple(one for one in map(of, found.algebraic) if sympy.false not in one.conditions)
    plain = [name for name in found.parameters if name not in meanings]
    inside = {name for meaning in meanings.values() for name in names_of(meaning)}
    known = tuple((name, facts) for name, facts in found.assumptions.known if name not in meanings)
    return replace(
        found,
        potential=put_in(found.potential),
        parameters=(*plain, *sorted(inside - {*plain})),
        assumptions=replace(found.assumptions, known=known),
        ends=tuple(map(said, found.ends)),
        excluded=tuple(relation for relation in map(put_in, found.excluded) if relation != sympy.false),
        levels=levels,
        algebraic=algebraic,
        reason=NO_FORMULA if found.algebraic and not algebraic else said(found.reason),
    )

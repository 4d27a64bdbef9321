"""Constants for which letters stand while the spectrum is looked for: sqrt(a), and square roots of several numbers.

One square root, or another root of one number, is computed with as such.  Several of them would have a common generator, that
isn't written in the user's roots, and beside sines and cosines there is I; so each is a positive parameter, and its value is
put in at the end.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import Any

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
#: The steps from one number to the next, between which a root is said to lie.
_STEPS = 10**6


def with_named_roots(V: Any) -> tuple[Any, dict[str, Any]]:
    """V with names for its roots of numbers, where there are several or nested ones, and what the names mean."""
    try:
        expression = read_expression(V) if isinstance(V, str) else sympy.sympify(V)
    except (InputError, sympy.SympifyError):  # said where it is read
        return V, {}
    roots = sorted(_roots_in(expression), key=sympy.default_sort_key)
    least = 1 if expression.has(TrigonometricFunction) else 2
    if len(roots) < least:
        return V, {}
    outermost = [root for root in roots if not _is_inside(root, roots)]
    meanings = dict(zip(_free_names(expression), outermost, strict=False))
    return expression.xreplace({root: sympy.Symbol(name) for name, root in meanings.items()}), meanings


def _roots_in(expression: Any) -> Iterator[Any]:
    """The positive algebraic numbers with a fractional exponent."""
    for power in expression.atoms(sympy.Pow):
        is_root = power.is_number and not power.exp.is_Integer
        if is_root and power.is_positive and power.is_algebraic:
            yield power


def _is_inside(root: Any, roots: list[Any]) -> bool:
    """Does another of the roots contain it?"""
    return any(root is not other and other.has(root) for other in roots)


def _free_names(expression: Any) -> Iterator[str]:
    """root_1, root_2, ..., but those which the user has taken."""
    taken = {*names_of(expression)}
    for number in count(1):
        name = f"root_{number}"
        if name not in taken:
            yield name


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
    letters = _LetterMeanings(meanings)
    known = tuple((name, facts) for name, facts in found.assumptions.known if name not in meanings)
    excluded = map(letters.put_in, found.excluded)
    levels = map(letters.in_levels, found.levels)
    algebraic = tuple(one for one in map(letters.in_algebraic, found.algebraic) if sympy.false not in one.conditions)
    reason = letters.said(found.reason)
    if found.algebraic and not algebraic:
        reason = NO_FORMULA
    return replace(
        found,
        potential=letters.put_in(found.potential),
        parameters=letters.parameters(found.parameters),
        assumptions=replace(found.assumptions, known=known),
        ends=tuple(map(letters.said, found.ends)),
        excluded=tuple(relation for relation in excluded if relation != sympy.false),
        levels=tuple(one for one in levels if sympy.false not in one.conditions),
        algebraic=algebraic,
        reason=reason,
    )


def _replaced(name: str, meaning: str, text: str) -> str:
    """The text with the meaning for each word that is the name."""
    return re.sub(rf"\b{name}\b", lambda _: meaning, text)


@dataclass(frozen=True)
class _LetterMeanings:
    """What letters mean, and how it is put in."""

    meanings: Mapping[str, Any]

    def put_in(self, expression: Any) -> Any:
        """An expression, or a relation, without letters."""
        values = {sympy.Symbol(name): meaning for name, meaning in self.meanings.items()}
        return sympy.sympify(expression).xreplace(values)

    def said(self, text: str) -> str:
        """A sentence without letters."""
        for name, meaning in self.meanings.items():
            text = _replaced(name, caret(as_text(meaning)), text)
        return text

    def conditions(self, one: Levels | Algebraic) -> tuple[Any, ...]:
        """Those that say something."""
        found = map(self.put_in, one.conditions)
        return tuple(condition for condition in found if condition != sympy.true)

    def in_levels(self, one: Levels) -> Levels:
        """The same levels without letters."""
        norm = None if one.norm is None else self.put_in(one.norm)
        return replace(
            one,
            energy=self.put_in(one.energy),
            wave=self.put_in(one.wave),
            conditions=self.conditions(one),
            zeros=self.put_in(one.zeros),
            norm=norm,
        )

    def in_algebraic(self, one: Algebraic) -> Algebraic:
        """The same, for levels under a constraint."""
        return replace(
            one,
            constraint=self.put_in(one.constraint),
            polynomial=self.put_in(one.polynomial),
            wave=self.put_in(one.wave),
            conditions=self.conditions(one),
        )

    def parameters(self, names: Sequence[str]) -> tuple[str, ...]:
        """The user's own parameters, those that stand only in a meaning last."""
        plain = [name for name in names if name not in self.meanings]
        inside = {name for meaning in self.meanings.values() for name in names_of(meaning)}
        return (*plain, *sorted(inside - {*plain}))

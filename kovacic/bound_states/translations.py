"""Questions brought to -y'' + V y = E y with simple constants, and answers brought back.

Letters stand for sqrt(a), and for square roots of several numbers, while the spectrum is looked for.  One square root, or
another root of one number, is computed with as such.  Several of them would have a common generator, that isn't written in the
user's roots, and beside sines and cosines there is I; so each is a positive parameter, and its value is put in at the end.

Schroedinger's equation as a physicist writes it is -hbar^2/(2 m) psi'' + V psi = E psi.  With the kinetic factor
k = hbar^2/(2 m) > 0 the energies are k times those of V/k, with the same functions.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from itertools import count
from typing import Any, TypeVar

import sympy
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.bound_states.levels import NO_FORMULA, Algebraic, Levels, Spectrum
from kovacic.errors import InputError
from kovacic.limits import Limits
from kovacic.numbers.numerals import as_text
from kovacic.reading.source import source_of
from kovacic.reading.symbolic import expression_of, function_of, names_of, read_expression
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
        expression = read_expression(V) if isinstance(V, str) else sympy.sympify(V, strict=True)
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
        return sympy.sympify(expression, strict=True).xreplace(values)

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


@dataclass(frozen=True)
class Schroedinger:
    """-kinetic psi'' + V psi = E psi in the variable x; V and kinetic are free of E, kinetic of x.

    `guesses` say what was guessed when the text was read.
    """

    V: Any
    kinetic: Any
    variable: str
    guesses: tuple[str, ...] = ()

    @property
    def scaled(self) -> Any:
        return sympy.expand(self.V / self.kinetic)

    @property
    def positive(self) -> tuple[str, ...]:
        """The parameters in the kinetic factor, which are taken as positive."""
        return tuple(sorted(symbol.name for symbol in self.kinetic.free_symbols))

    def physical(self, found: Spectrum) -> Spectrum:
        """The spectrum of V/kinetic as that of the equation."""
        k = self.kinetic
        energy = sympy.Symbol(found.energy)
        notes = [*self.guesses]
        if self.positive:
            notes.append(f"{' and '.join(self.positive)} taken as positive")
        return replace(
            found,
            potential=self.V,
            kinetic=k,
            levels=tuple(replace(one, energy=_simple(k * one.energy)) for one in found.levels),
            algebraic=tuple(self._algebraic(one, energy) for one in found.algebraic),
            notices=(*found.notices, *notes),
        )

    def _algebraic(self, one: Algebraic, energy: Any) -> Algebraic:
        scaled = {energy: energy / self.kinetic}
        P = None if one.P is None else sympy.Poly(one.P.as_expr().xreplace(scaled), one.P.gen)
        polynomial = sympy.factor(sympy.primitive(sympy.numer(sympy.together(one.polynomial.xreplace(scaled))))[1])
        states = tuple(replace(s, energy=_simple(self.kinetic * s.energy)) for s in one.states)
        return replace(one, polynomial=polynomial, wave=one.wave.xreplace(scaled), states=states, P=P)


def _simple(energy: Any) -> Any:
    """The shorter of the product and its expanded form."""
    return min((energy, sympy.factor(energy), sympy.expand(energy)), key=sympy.count_ops)


def read_schroedinger(text: str, var: str | None, energy: str, limits: Limits) -> Schroedinger:
    """The equation in a text.  Raises `InputError` for one that isn't Schroedinger's."""
    source = source_of(text, var, limits, equation=True)
    whole = expression_of(source, limits)
    psi = function_of(whole)
    x = psi.args[0]
    letters = [sympy.Dummy() for _ in range(3)]
    plain = sympy.expand(whole.subs(psi.diff(x, 2), letters[2]).subs(psi.diff(x), letters[1]).subs(psi, letters[0]))
    c, b, a = (sympy.cancel(plain.diff(letter)) for letter in letters)
    if b != 0 or a == 0 or plain.subs(dict.fromkeys(letters, 0)) != 0 or {*letters} & (a.free_symbols | c.free_symbols):
        raise InputError("an equation -k*psi'' + V*psi = E*psi is expected, without a first derivative")
    slope = sympy.cancel(c.diff(sympy.Symbol(energy)))
    if slope == 0 or slope.has(sympy.Symbol(energy)):
        raise InputError(f"the equation has no energy {energy}", hint="energy= gives it another name")
    kinetic = sympy.cancel(a / slope)
    if kinetic.has(x) or kinetic.is_negative:
        raise InputError(f"the factor of psi'' over that of {energy}, {kinetic}, isn't a positive constant")
    V = sympy.Symbol(energy) - c / slope
    return Schroedinger(sympy.expand(V), kinetic, x.name, source.guesses)


#: V(x) = ..., V = ...
_LEFT_SIDE = re.compile(r"\s*[VU]\s*(?:\(\s*(\w+)\s*\))?\s*=(?!=)")


def without_left_side(V: Any, var: Any) -> tuple[Any, Any]:
    """The right-hand side of a text V(x) = ..., and the variable that it names, if none was given."""
    found = _LEFT_SIDE.match(V) if isinstance(V, str) else None
    if found is None:
        return V, var
    return V[found.end() :], var or found[1]


def is_equation(V: Any) -> bool:
    """True for a text with an equals sign."""
    return isinstance(V, str) and "=" in V

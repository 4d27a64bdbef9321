"""Schroedinger's equation as a physicist writes it, -hbar^2/(2 m) psi'' + V psi = E psi, brought to -y'' + V y = E y and back.

With the kinetic factor k = hbar^2/(2 m) > 0 the energies are k times those of V/k, with the same functions.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.levels import Algebraic, Spectrum
from kovacic.errors import InputError
from kovacic.limits import Limits
from kovacic.reading.source import source_of
from kovacic.reading.symbolic import expression_of, function_of


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
        """V/kinetic."""
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

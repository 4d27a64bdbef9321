"""The first level of each printed family, put into the equation at values of its parameters before a spectrum leaves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import islice, product
from typing import Any

import sympy
from flint import acb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ
from kovacic.bound_states.levels import Levels, Spectrum
from kovacic.closed_form.jets import jet
from kovacic.errors import VerificationFailed
from kovacic.parametric.assumptions import Assumptions

#: Values that are tried for the parameters, the n of a first level, and choices of both.
_VALUES = (Fraction(3), Fraction(1), Fraction(7, 2), Fraction(1, 2), Fraction(12), Fraction(-2), Fraction(0))
_FIRST = 3
_CHOICES = 400
#: Bits with which a wave function is compared.
_PRECISION = 192
Values = Mapping[Any, Any]


def check_first_levels(found: Spectrum, known: Assumptions) -> None:
    """Raises `VerificationFailed` if y'' = (V - E_n) y provably doesn't hold for the first n of a family."""
    for levels in found.levels:
        chosen = next(_choices(levels, found, known), None)
        if chosen is None:
            continue
        energy, wave = (part.xreplace(chosen) for part in (levels.energy, levels.wave))
        if _is_false(wave, found.potential.xreplace(chosen) - energy, sympy.Symbol(found.variable), found, chosen):
            said = ", ".join(f"{name} = {value}" for name, value in chosen.items())
            raise VerificationFailed(f"a spectrum failed its own check at {said}: E = {energy}; please report it")


def _choices(levels: Levels, found: Spectrum, known: Assumptions) -> Iterator[dict[Any, Any]]:
    """Values of the parameters and of n that the conditions and the assumptions admit."""
    names = sorted(symbol.name for symbol in levels.wave.free_symbols | levels.energy.free_symbols)
    names = [name for name in names if name not in (found.variable, levels.number.name)]
    symbols = {symbol.name: symbol for symbol in levels.wave.free_symbols | levels.energy.free_symbols}
    every: Iterator[tuple[Any, ...]] = product(range(_FIRST), *([_VALUES] * len(names)))
    for n, *values in islice(every, _CHOICES):
        if not known.admits((name, QQ.poly([value])) for name, value in zip(names, values, strict=True)):
            continue
        chosen = {symbols[name]: sympy.Rational(value) for name, value in zip(names, values, strict=True)}
        chosen[levels.number] = sympy.Integer(n)
        if all(condition.xreplace(chosen) == sympy.true for condition in levels.conditions):
            yield chosen


def _is_false(y: Any, difference: Any, x: Any, found: Spectrum, chosen: Values) -> bool:
    """True if y'' = (V - E) y provably fails at a point of the domain."""
    low, high = (sympy.sympify(end).xreplace(chosen) for end in found.domain)
    place = _inside(low, high)
    if place is None or y.has(sympy.nan, sympy.zoo) or y.free_symbols - {x}:
        return False
    try:
        with working_precision(_PRECISION):
            point = acb(fmpq(place.numerator, place.denominator))
            value, _, second = jet(y, x, point)
            return not (second - jet(difference, x, point)[0] * value).contains(0)
    except (NotImplementedError, ZeroDivisionError, ValueError, TypeError):  # functions without balls
        return False


def _inside(low: Any, high: Any) -> Fraction | None:
    """A rational point of the domain."""
    step = Fraction(13, 17)
    if low.is_infinite:
        return step if high.is_infinite else _near(high, -step)
    if high.is_infinite:
        return _near(low, step)
    if not (low.is_number and high.is_number):
        return None
    return _near(low, Fraction(str(sympy.N((high - low) * 13 / 34, 12))))


def _near(end: Any, step: Fraction) -> Fraction | None:
    return Fraction(str(sympy.N(end, 12))) + step if end.is_number else None

"""The first level of each printed family, put into the equation at values of its parameters before a spectrum leaves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product
from typing import Any

import sympy
from flint import acb, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.algebra.rationals import QQ
from kovacic.bound_states.levels import Spectrum
from kovacic.closed_form.jets import jet
from kovacic.errors import InputError, VerificationFailed
from kovacic.parametric.assumptions import Assumptions

#: Values that are tried for the parameters, and choices of them.
_VALUES = (Fraction(3), Fraction(1), Fraction(7, 2), Fraction(1, 2), Fraction(12), Fraction(-2), Fraction(0))
_CHOICES = 400
#: Bits with which a wave function is compared.
_PRECISION = 192


def check_first_levels(found: Spectrum, known: Assumptions) -> None:
    """Raises `VerificationFailed` if y'' = (V - E_0) y provably doesn't hold for the first level of a family."""
    x = sympy.Symbol(found.variable)
    for levels in found.levels:
        for values in _admissible(found, known):
            at = {sympy.Symbol(name): sympy.Rational(value) for name, value in values.items()}
            try:
                states = replace(found, levels=(levels,), algebraic=()).states(values, count=1)
            except InputError:  # not known whether the level exists
                continue
            if not states:
                continue
            (state,) = states
            if _is_false(state.wave, found.potential.xreplace(at) / found.kinetic - state.energy, x, found.domain, at):
                said = "".join(f", {name} = {value}" for name, value in values.items())
                raise VerificationFailed(
                    f"a spectrum failed its own check at n = 0{said}: E = {state.energy}; please report it"
                )
            break


def _admissible(found: Spectrum, known: Assumptions) -> Iterator[dict[str, Fraction]]:
    """Values of the parameters that the assumptions admit."""
    for values in islice(product(_VALUES, repeat=len(found.parameters)), _CHOICES):
        chosen = dict(zip(found.parameters, values, strict=True))
        if known.admits((name, QQ.poly([value])) for name, value in chosen.items()):
            yield chosen


def _is_false(y: Any, difference: Any, x: Any, domain: tuple[Any, Any], at: dict[Any, Any]) -> bool:
    """True if y'' = (V - E) y provably fails at a point of the domain."""
    low, high = (sympy.sympify(end).xreplace(at) for end in domain)
    if low.is_infinite:
        place = sympy.Rational(13, 17) if high.is_infinite else high - sympy.Rational(13, 17)
    else:
        place = low + (sympy.Rational(13, 17) if high.is_infinite else (high - low) * sympy.Rational(13, 34))
    if not place.is_number or y.has(sympy.nan, sympy.zoo) or y.free_symbols - {x}:
        return False
    point = Fraction(str(sympy.N(place, 12)))
    try:
        with working_precision(_PRECISION):
            ball = acb(fmpq(point.numerator, point.denominator))
            value, _, second = jet(y, x, ball)
            return not (second - jet(difference, x, ball)[0] * value).contains(0)
    except (NotImplementedError, ZeroDivisionError, ValueError, TypeError):  # functions without balls
        return False

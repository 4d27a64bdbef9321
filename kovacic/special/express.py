"""`solutions`: what was found as SymPy expressions."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from sympy import Symbol

from kovacic.algebra.ratfunc import RatFunc
from kovacic.special.bessel import airy, bessel
from kovacic.special.hypergeometric import gauss
from kovacic.special.kummer import whittaker
from kovacic.special.pullback import Airy, Gauss, Pullback
from kovacic.special.writer import Writer


def solutions(pullback: Pullback, gauge: RatFunc, variable: str, symbols: Mapping[str, Any]) -> tuple[Any, Any] | None:
    """y1 and y2; None where the assumptions on the symbols leave open which solutions are independent."""
    equation, f, writer = pullback.equation, pullback.f, Writer(gauge, Symbol(variable), symbols)
    if isinstance(equation, Airy):
        return airy(writer, equation, f)
    if isinstance(equation, Gauss):
        return gauss(writer, equation, f)
    if not equation.q:
        return bessel(writer, 4 * equation.M + 1, f * equation.r)
    if not equation.r:
        return bessel(writer, equation.M + Fraction(1, 4), f * f * equation.q * Fraction(-1, 4))
    return whittaker(writer, equation, f)

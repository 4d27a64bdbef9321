"""`solutions`: what was found as SymPy expressions."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from sympy import Symbol

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.check import is_numerical_solution
from kovacic.errors import VerificationFailed
from kovacic.special.bessel import airy, bessel
from kovacic.special.find import Search
from kovacic.special.hypergeometric import gauss
from kovacic.special.kummer import whittaker
from kovacic.special.pullback import Airy, Gauss, Pullback
from kovacic.special.writer import Writer


def solutions(
    search: Search, S: RatFunc, gauge: RatFunc, variable: str, symbols: Mapping[str, Any]
) -> tuple[Any, Any] | None:
    """y1 and y2, checked at a point; None where the assumptions on the symbols leave open which solutions are independent.

    Raises `VerificationFailed` if the check fails, which is a defect of this package; `LimitExceeded` within `Budget.watched`.
    """
    assert search.pullback is not None
    writer = Writer(gauge, Symbol(variable), symbols)
    found = _written(writer, search.pullback)
    for y in found or ():
        if not is_numerical_solution(y, writer.atoms.x, S, gauge):
            raise VerificationFailed(
                f"a special function for S = {S} failed its check; please report the equation: {y}"
            )
    return None if found is None else (found[0].xreplace(writer.symbols), found[1].xreplace(writer.symbols))


def _written(writer: Writer, pullback: Pullback) -> tuple[Any, Any] | None:
    equation, f = pullback.equation, pullback.f
    if isinstance(equation, Airy):
        return airy(writer, equation, f)
    if isinstance(equation, Gauss):
        return gauss(writer, equation, f)
    if not equation.q:
        return bessel(writer, 4 * equation.M + 1, f * equation.r)
    if not equation.r:
        return bessel(writer, equation.M + Fraction(1, 4), f * f * equation.q * Fraction(-1, 4))
    return whittaker(writer, equation, f)

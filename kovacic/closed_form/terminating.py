"""Solutions exp(int theta) P where P has too many terms to be listed: P as a hypergeometric polynomial.

Hermite's, Laguerre's and Jacobi's polynomials are of this kind; under their names SymPy would write them out.
"""

from __future__ import annotations

from fractions import Fraction

from flint import arb, fmpq
from sympy import Integral, Mul

from kovacic.algebra.precision import working_digits
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Atoms, Expr, display, hypergeometric
from kovacic.closed_form.check import DIGITS, check_point, residual
from kovacic.closed_form.product import product
from kovacic.decision import TerminatingSeries
from kovacic.engine.terminating import recurrence_about
from kovacic.errors import VerificationFailed

#: Digits at the point of the check.
_CHECK_DIGITS = 6 * DIGITS


def hypergeometric_pair(series: TerminatingSeries, S: RatFunc, gauge: RatFunc, atoms: Atoms) -> tuple[Expr, Expr]:
    """exp(int theta) P and another solution, times exp(int gauge dx): from the same recurrence, or times an integral.

    Raises `VerificationFailed` if one isn't a solution near the centre, where that is a rational number.
    """
    recurrence = recurrence_about(series.centre, S, series.theta)
    if recurrence is None:
        raise AssertionError("the recurrence was verified")
    t = atoms.x - atoms.constant(series.centre)
    bare, factor = (display(product(series.theta + g), atoms, around_zero=True) for g in (gauge * 0, gauge))
    written = []
    for P in recurrence.solutions(series.degree, series.lowest):
        top, bottom = (tuple(map(atoms.constant, values)) for values in (P.top, P.bottom))
        z = atoms.constant(P.factor) * t**P.step
        written.append(t ** atoms.constant(P.start) * hypergeometric(top, bottom, z))
        centre = series.centre.field.rational_value(series.centre)
        if centre is None:
            continue
        # z is small at this distance: the terms become smaller from the first one on
        distance = Fraction(series.degree) ** (-2 if P.step > 0 else 2)
        y = factor * written[-1]
        with working_digits(_CHECK_DIGITS):
            point = check_point() * fmpq(*distance.as_integer_ratio()) + fmpq(*centre.as_integer_ratio())
            if not residual(y, atoms.x, S, gauge, point) < arb(10) ** -DIGITS:
                raise VerificationFailed(f"{y} for S = {S} failed its check; please report the equation")
    y1, *others = (factor * y for y in written)
    return y1, others[0] if others else Mul(y1, Integral((bare * written[0]) ** -2, atoms.x))

"""Logarithmic derivatives of solutions at a point, in balls, and the local exponents that product forms are made of.

`omega` numbers the solutions whose logarithmic derivative is algebraic: in case 1 the conjugates of omega, or the two
rational ones; in cases 2 and 3 the roots of the polynomial of omega at the point, by real part and then imaginary part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from typing import TYPE_CHECKING

from kovacic.errors import InputError
from kovacic.numeric.closed_form import closed_form_of
from kovacic.numeric.exponential import conjugates, embed, sharp_roots
from kovacic.numeric.points import Point, to_acb
from kovacic.numeric.problem import NumericProblem

if TYPE_CHECKING:
    from flint import acb

    from kovacic.algebra.poly import Poly
    from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Exponential:
    """y = exp(int theta) P, with the gauge in theta; constants are embedded by the conjugate number `embedding`."""

    theta: RatFunc
    P: Poly
    embedding: int

    def constant(self) -> acb | None:
        """The value of the generator of the field, at the working precision in force."""
        field = self.P.field if hasattr(self.P.field, "modulus") else self.theta.field
        return conjugates(field)[self.embedding]

    def omega(self, z: acb) -> acb:
        """y'/y at z."""
        c = self.constant()
        P = embed(self.P, c)
        return value(self.theta, c, z) + P.derivative()(z) / P(z)


def value(function: RatFunc, c: acb | None, z: acb) -> acb:
    """A rational function at z."""
    return embed(function.num, c)(z) / embed(function.den, c)(z)


def exponentials(problem: NumericProblem) -> list[Exponential]:
    """The solutions of case 1 with a rational logarithmic derivative; empty in the other cases.

    Raises InputError where there is no certificate.
    """
    closed = closed_form_of(problem)
    if closed.case != 1:
        return []
    theta, P = closed.theta, closed.P
    count = len(conjugates(P.field if hasattr(P.field, "modulus") else theta.field))
    found = [Exponential(_gauged(theta, problem), P, k) for k in range(count)]
    if count == 1 and closed.second is not None:
        found.append(Exponential(_gauged(closed.second[0], problem), closed.second[1], 0))
    return found


def _gauged(theta: RatFunc, problem: NumericProblem) -> RatFunc:
    return theta if problem.gauge is None else theta + problem.gauge


def omegas(problem: NumericProblem, x0: Point) -> list[acb]:
    """The logarithmic derivatives at x0 in their order, at the working precision in force; not finite at a zero."""
    z = to_acb(x0)
    found = exponentials(problem)
    if found:
        return [branch.omega(z) for branch in found]
    from flint import ctx

    closed_form_of(problem)
    roots: list[acb] = []
    for factor in (1, 2, 4, 8):  # the polynomial may have large coefficients, and roots that are close together
        with ctx.workprec(ctx.prec * factor):
            roots = _riccati_roots(problem.source.riccati.coefficients, x0)
        if roots:
            break
    roots.sort(key=cmp_to_key(_order))
    shift = 0 if problem.gauge is None else value(problem.gauge, None, z)
    return [root + shift for root in roots]


def _riccati_roots(coefficients: Sequence[RatFunc], x0: Point) -> list[acb]:
    from flint import acb_poly

    c, z = conjugates(coefficients[0].field)[0], to_acb(x0)
    return sharp_roots(acb_poly([value(r, c, z) for r in coefficients]))


def _order(a: acb, b: acb) -> int:
    """By real part, and by imaginary part where the real parts can't be told apart (conjugates)."""
    if a.real.overlaps(b.real):
        return -1 if a.imag < b.imag else 1
    return -1 if a.real < b.real else 1


def omega(problem: NumericProblem, which: int, x0: Point) -> acb:
    """One of them; raises InputError if there is no solution of this number."""
    values = omegas(problem, x0)
    if values and not 0 <= which < len(values):
        names = "only which = 0" if len(values) == 1 else f"which = 0, ..., {len(values) - 1}"
        raise InputError(
            f"which = {which}: the equation has {names} here", hint="tabulate gives every solution, by initial values"
        )
    if not values or not values[which].is_finite():
        raise ZeroDivisionError(f"the logarithmic derivative isn't finite at {x0}")
    return values[which]


def finite_base(problem: NumericProblem, which: int, candidates: list[Point]) -> Point:
    """The first of the points where y'/y is finite for the solution of this number."""
    from flint import ctx

    for x0 in candidates:
        try:
            with ctx.workprec(200):
                omega(problem, which, x0)
        except ZeroDivisionError:
            continue
        return x0
    raise InputError("no point was found where the logarithmic derivative of the solution is finite")

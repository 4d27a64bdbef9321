"""Logarithmic derivatives of solutions at a point, in balls, and the local exponents that product forms are made of.

`omega` numbers the solutions whose logarithmic derivative is algebraic: in case 1 the conjugates of omega, or the two
rational ones; in cases 2 and 3 the roots of the polynomial of omega at the point, by real part and then imaginary part.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cmp_to_key
from typing import TYPE_CHECKING

from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.partial_fractions import decompose
from kovacic.enclosure.closed_form import ClosedForm, closed_form_of
from kovacic.enclosure.exponential import conjugates, embed, sharp_roots
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.errors import InputError

if TYPE_CHECKING:
    from flint import acb

    from kovacic.algebra.poly import Poly

_HIGHEST = 40_000
"""Bits up to which a logarithmic derivative is computed: the polynomial may cancel as many."""

_SMALL = 60
"""Degree up to which a second rational omega is sought by integration."""


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
    second = (closed.second or _companion(closed)) if count == 1 else None
    if second is not None:
        found.append(Exponential(_gauged(second[0], problem), second[1], 0))
    return found


def _companion(closed: ClosedForm) -> tuple[RatFunc, Poly] | None:
    """(theta, P) of y2 = y1 int y1^-2 where y1^2 is rational, of small degree, and the integral is rational too."""
    if closed.square_size is None or closed.square_size // 2 + closed.P.degree > _SMALL:
        return None
    square = closed.rational_square
    assert square is not None
    inverse = decompose(1 / (square * RatFunc(closed.P) ** 2))
    if inverse.residues:
        return None
    factor = inverse.exact * closed.P
    return closed.theta - RatFunc(factor.den.derivative(), factor.den), factor.num


def _gauged(theta: RatFunc, problem: NumericProblem) -> RatFunc:
    return theta if problem.gauge is None else theta + problem.gauge


def omegas(problem: NumericProblem, x0: Point) -> list[acb]:
    """The logarithmic derivatives at x0 in their order, at the working precision in force; not finite at a zero.

    The list is empty where the precision is too low to tell the roots of the polynomial of omega apart.
    """
    from flint import acb_poly

    z = to_acb(x0)
    found = exponentials(problem)
    if found:
        return [branch.omega(z) for branch in found]
    coefficients = problem.source.riccati.coefficients
    c = conjugates(coefficients[0].field)[0]
    roots = sorted(sharp_roots(acb_poly([value(r, c, z) for r in coefficients])), key=cmp_to_key(_order))
    shift = 0 if problem.gauge is None else value(problem.gauge, None, z)
    return [root + shift for root in roots]


def _order(a: acb, b: acb) -> int:
    """By real part, and by imaginary part where the real parts can't be told apart (conjugates)."""
    if a.real.overlaps(b.real):
        return -1 if a.imag < b.imag else 1
    return -1 if a.real < b.real else 1


def omega(problem: NumericProblem, which: int, x0: Point, bits: int) -> acb:
    """One of them, accurate to that many bits.

    Raises InputError if there is no solution of this number, and ZeroDivisionError where it is zero at x0, as far as the
    highest precision can tell.
    """
    from flint import ctx

    prec = bits + 64
    while prec <= max(4 * bits, _HIGHEST):
        with ctx.workprec(prec):
            values = omegas(problem, x0)
            if values and not 0 <= which < len(values):
                names = "only which = 0" if len(values) == 1 else f"which = 0, ..., {len(values) - 1}"
                raise InputError(
                    f"which = {which}: the equation has {names} here",
                    hint="tabulate gives every solution, by initial values",
                )
            if values and values[which].is_finite() and _is_sharp(values[which], bits):
                return values[which]
        prec *= 2
    raise ZeroDivisionError(f"the logarithmic derivative isn't finite at {x0}")


def _is_sharp(ball: acb, bits: int) -> bool:
    from flint import arb

    return bool(ball.rel_accuracy_bits() >= bits) or bool(ball.real.rad() + ball.imag.rad() < arb((1, -bits - 400)))


def finite_base(problem: NumericProblem, which: int, candidates: list[Point]) -> Point:
    """The first of the points where y'/y is finite for the solution of this number."""
    for x0 in candidates:
        try:
            omega(problem, which, x0, 64)
        except ZeroDivisionError:
            continue
        return x0
    raise InputError("no point was found where the logarithmic derivative of the solution is finite")

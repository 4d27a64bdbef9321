"""How many zeros a solution with a unique rational omega can have, exactly, and when there can be no such solution.

The exponents of the solution at the roots of a factor p are conjugate, (A +- sqrt g)/2 with g in K[x]/p, because omega is
rational over K.  So g must be a square in K[x]/p, and the sum of the exponents over the roots follows from the trace of its
root.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, trace_of_square_root
from kovacic.decision import Evidence, NecessaryCondition, NoRationalOmega, Rule
from kovacic.engine.places import Kind, Place, Problem


def irrational_exponents(problem: Problem) -> NecessaryCondition | None:
    """A place at which the exponents provably aren't rational over the field of its roots, if one is found quickly."""
    for place in problem.places:
        if place.kind in (Kind.REGULAR, Kind.UNRAMIFIED) and place.delta is None:
            p = place.factor
            bottom = _leading_coefficient(place)
            top = place.local_num % p if place.kind is Kind.UNRAMIFIED else bottom + 4 * place.local_num
            if is_provably_not_a_square(top * bottom % p, p):
                return NecessaryCondition(Rule.NOT_A_SQUARE, (str(place),))
    return None


def _leading_coefficient(place: Place) -> Poly:
    """E with S = num / (t^order E) to leading order at the class of x in K[x]/p."""
    p = place.factor
    return place.cofactor % p if p.degree == 1 else p.derivative() ** place.order * place.cofactor % p


@dataclass(frozen=True)
class DegreeBound:
    """For a unique omega = R/D + P'/P the degree of P is `total` plus or minus each choice, and at most `largest`.

    There is a choice for a place where two exponents are possible, half the difference of their sums over its points.
    """

    largest: int
    total: Fraction
    choices: list[tuple[Place, Fraction]]

    def exponents(self, place: Place) -> list[Fraction] | None:
        """The exponents of omega at a place that leave a natural number for the degree, whatever those elsewhere are.

        None where the place isn't a single point with a choice between rational numbers.
        """
        halves = [half for other, half in self.choices if other is place]
        if place.degree > 1 or not halves or (place.delta is None and place.factor.field != QQ):
            return None
        others = [half for other, half in self.choices if other is not place]
        signed = (halves[0], -halves[0])
        return [Fraction(place.weight, 2) + h for h in signed if largest_integer_total(self.total - h, others) >= 0]


def degree_bound(problem: Problem) -> DegreeBound | Evidence:
    """The degrees that P can have for a unique omega = R/D + P'/P: 1 - sum of the exponents over all places.

    The exponents at the roots of a factor are conjugate, (A +- sqrt g)/2 with g in K[x]/p, so their sum follows from the
    trace of sqrt g [sec. 3.2 of Kovacic 1986 for the exponents], one sign for each factor.  Evidence against omega if no
    choice of signs gives a natural number, or if the exponents at a place aren't rational over K[x]/p.
    """
    twice, choices = 2, list[tuple[Place, Fraction]]()
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        n, delta = place.degree, place.delta
        twice -= n * place.weight
        if delta is None:
            trace = _trace(place)
            if trace is None:
                return NecessaryCondition(Rule.NOT_A_SQUARE, (place.name,))
            choices.append((place, _rational_part(trace) / 2))
        elif place.logarithm:  # then Delta is an integer
            twice -= n * delta.numerator
        else:
            choices.append((place, Fraction(n * delta.numerator, 2 * delta.denominator)))
    total = Fraction(twice, 2)
    largest = largest_integer_total(total, [half for _, half in choices])
    return DegreeBound(largest, total, choices) if largest >= 0 else NoRationalOmega(-1)


def is_cheap(problem: Problem) -> bool:
    """Does `degree_bound` need no traces of square roots in extensions?"""
    return all(
        place.kind is Kind.ORDINARY or place.delta_squared is not None or place.degree == 1 for place in problem.places
    )


def _rational_part(constant: Poly) -> Fraction:
    """The first rational coordinate: a Q-linear map of the field onto Q that is the identity on Q."""
    return to_fraction(constant.rational_coefficients()[0]) if constant else Fraction(0)


def _trace(place: Place) -> Poly | None:
    """The trace of an irrational difference of exponents over the roots, up to sign; None if it isn't in K[x]/p."""
    if place.kind is Kind.REGULAR:
        if place.delta_squared is not None:
            return trace_of_square_root(place.delta_squared, place.factor)
        p = place.factor
        return trace_of_square_root((1 + 4 * place.local_num * _leading_coefficient(place).inverse_modulo(p)) % p, p)
    return trace_of_square_root(irregular_difference_squared(place), place.factor)


def irregular_difference_squared(place: Place) -> Poly:
    """(b/a)^2 at an unramified irregular place, in K[x]/p: 4 s_0 rho^2, rho the coefficient of t^(nu-1) in sqrt(s/s_0).

    Here S = s(t)/t^(2 nu) with t = x - c, c the class of x modulo p.
    """
    p, k, field = place.factor, place.order, place.factor.field
    nu = k // 2
    top = place.local_num % p**nu
    if p.degree == 1:  # K[x]/p is K
        t = field.poly([-p[0], 1])
        N, E = ([field.scalar(part(t), i) for i in range(nu)] for part in (top, place.cofactor))
        one = field.scalar(field.poly([1]), 0)
        s0, rho = _square_root_term(N, E, nu, lambda element: element, lambda element: one / element)
        return field.from_scalars([4 * s0 * rho * rho])
    N, E = _taylor(top, p, nu), _taylor(p**k * place.cofactor, p, k + nu)[k:]
    s0, rho = _square_root_term(N, E, nu, lambda element: element % p, lambda element: element.inverse_modulo(p))
    square: Poly = 4 * s0 * rho * rho % p
    return square


def _square_root_term(
    N: list[Any], E: list[Any], nu: int, reduced: Callable[[Any], Any], inverse: Callable[[Any], Any]
) -> tuple[Any, Any]:
    """s_0 and the coefficient of t^(nu-1) in sqrt(s/s_0) for s = N/E, over the ring that the two functions describe."""
    unit = inverse(E[0])
    s: list[Any] = []
    for i in range(nu):
        s.append(reduced((N[i] - sum([E[j] * s[i - j] for j in range(1, i + 1)])) * unit))
    half = inverse(2 * s[0])
    rho: list[Any] = [1]
    for i in range(1, nu):
        rho.append(reduced((s[i] - s[0] * sum([rho[j] * rho[i - j] for j in range(1, i)])) * half))
    return s[0], rho[nu - 1]


def _taylor(polynomial: Poly, p: Poly, count: int) -> list[Any]:
    """The first Taylor coefficients at the class of x in K[x]/p."""
    coefficients = []
    for i in range(count):
        coefficients.append(polynomial % p)
        polynomial = polynomial.derivative() * Fraction(1, i + 1)
    return coefficients

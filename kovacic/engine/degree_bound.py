"""The number of zeros that a solution with a unique rational omega can have, and when there can be no such solution.

The exponents of the solution at the roots of a factor p are conjugate, (A +- sqrt g)/2 with g in K[x]/p, because omega is
rational over K.  So g must be a square in K[x]/p, and the sum of the exponents over the roots follows from the trace of its
root.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, power_sums
from kovacic.decision import Evidence, NecessaryCondition, NoRationalOmega, Rule
from kovacic.engine.places import Kind, Place, Problem


def irrational_exponents(problem: Problem) -> NecessaryCondition | None:
    """A place at which the exponents provably aren't rational over the field of its roots, if one is found quickly."""
    for place in problem.places:
        if place.kind in (Kind.REGULAR, Kind.UNRAMIFIED) and place.delta is None:
            p = place.factor
            top = place.near[0]
            bottom = _leading_coefficient(place)
            if place.kind is Kind.REGULAR:
                top = bottom + 4 * top
            if is_provably_not_a_square(top * bottom % p, p):
                return NecessaryCondition(Rule.NOT_A_SQUARE, (place.name,))
    return None


def _leading_coefficient(place: Place) -> Poly:
    """E with S = num / (t^order E) to leading order at the class of x in K[x]/p."""
    p = place.factor
    cofactor = place.near[1]
    return cofactor % p if p.degree == 1 else p.derivative() ** place.order * cofactor % p


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

        None unless the place is a single point with a choice between rational numbers.
        """
        halves = [half for other, half in self.choices if other is place]
        if place.degree > 1 or not halves:
            return None
        if place.delta is None and place.factor.field != QQ:
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
    twice = 2
    choices = list[tuple[Place, Fraction]]()
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        n = place.degree
        delta = place.delta
        twice -= n * place.weight
        if delta is None:
            p = place.factor
            if place.kind is not Kind.REGULAR:
                square = irregular_difference_squared(place)
            elif place.delta_squared is not None:
                square = place.delta_squared
            else:
                square = (1 + 4 * place.near[0] * _leading_coefficient(place).inverse_modulo(p)) % p
            trace = trace_of_square_root(square, p)
            if trace is None:
                return NecessaryCondition(Rule.NOT_A_SQUARE, (place.name,))
            # a Q-linear map of the field onto Q that is the identity on Q: the first rational coordinate
            first = to_fraction(trace.rational_coefficients()[0]) if trace else Fraction(0)
            choices.append((place, first / 2))
        elif place.logarithm:  # then Delta is an integer
            twice -= n * delta.numerator
        else:
            choices.append((place, Fraction(n * delta.numerator, 2 * delta.denominator)))
    total = Fraction(twice, 2)
    largest = largest_integer_total(total, [half for _, half in choices])
    return DegreeBound(largest, total, choices) if largest >= 0 else NoRationalOmega(-1)


def is_cheap(problem: Problem) -> bool:
    """True if `degree_bound` needs no traces of square roots in extensions."""
    return all(
        place.kind is Kind.ORDINARY or place.delta_squared is not None or place.degree == 1 for place in problem.places
    )


def trace_of_square_root(square: Poly, p: Poly) -> Poly | None:
    """The trace over K of a square root of an element of K[x]/p, with one choice of its sign; None if it has none there."""
    field = p.field
    if p.degree == 1:
        return field.sqrt(square)
    extension = AlgebraicField(field, p)
    root = extension.sqrt(extension.element(square))
    if root is None:
        return None
    parts = root.over(extension).parts
    return sum((part[0] * total for part, total in zip(parts, power_sums(p), strict=True)), field.poly([]))


def irregular_difference_squared(place: Place) -> Poly:
    """(b/a)^2 at an unramified irregular place, in K[x]/p: 4 s_0 rho^2, rho the coefficient of t^(nu-1) in sqrt(s/s_0).

    Here S = s(t)/t^(2 nu) with t = x - c, c the class of x modulo p.  For s = N/E and v = 1/(N_0 E_0) that is 4 v l^2, l the
    coefficient of t^(nu-1) in N (v N E)^(-1/2), which Newton's iteration gives.
    """
    p = place.factor
    nu = place.order // 2
    (num, cofactor) = place.near
    extension = AlgebraicField(p.field, p) if p.degree > 1 else None
    t = (extension or p.field).poly([0, 1])
    end = t**nu
    N, E = (_taylor_shifted(f, p, extension, nu) for f in (num, cofactor))
    if extension:
        slope = _taylor_shifted(p, p, extension, nu + 1) // t  # p = t slope
        power = extension.poly([1])
        for digit in f"{place.order:b}":
            power = power * power % end
            if digit == "1":
                power = power * slope % end
        E = E * power
    u = N * E % end
    v = u[0].inverse()
    u = u * v
    # Newton's first step, from 1
    root = (3 - u) / 2
    known = 2
    while known < nu:
        known = min(2 * known, nu)
        ahead = t**known
        root = (root + root * (1 - u * root * root % ahead) / 2) % ahead
    last = (N * root)[nu - 1]
    value = 4 * v * last * last
    return value if p.degree == 1 else p.field.poly([part[0] for part in value.parts])


def _taylor_shifted(f: Poly, p: Poly, extension: AlgebraicField | None, count: int) -> Poly:
    """f(t + c) modulo t^count, c the class of x modulo p: by Taylor's formula over the extension by c, if there is one."""
    if extension is None:
        t = p.field.poly([0, 1])
        if p[0]:
            f = f(t - p[0])
        return f % t**count
    coefficients = []
    for k in range(count):
        coefficients.append(extension.element(f % p))
        f = f.derivative() / (k + 1)
    return extension.poly(coefficients)

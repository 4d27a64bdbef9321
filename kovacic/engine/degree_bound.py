"""How many zeros a solution with a unique rational omega can have, exactly, and when there can be no such solution.

The exponents of the solution at the roots of a factor p are conjugate, (A +- sqrt g)/2 with g in K[x]/p, because omega is
rational over K.  So g must be a square in K[x]/p, and the sum of the exponents over the roots follows from the trace of its
root.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, trace_of_square_root
from kovacic.decision import Evidence, NecessaryCondition, NoRationalOmega, Rule
from kovacic.engine.places import Kind, Place, Problem

#: Series of so many terms are multiplied term by term.
_FEW_TERMS = 16


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

    Here S = s(t)/t^(2 nu) with t = x - c, c the class of x modulo p.  For s = N/E and v = 1/(N_0 E_0) that is 4 v l^2, l the
    coefficient of t^(nu-1) in N (v N E)^(-1/2).
    """
    p, nu = place.factor, place.order // 2
    ring = _Expansions(p, nu)
    N = ring.expand(place.local_num % p**nu)
    E = ring.expand(place.cofactor % p**nu)
    if p.degree > 1:  # p = t slope
        E = ring.product(E, ring.slope_power(place.order), nu)
    v = ring.inverse(ring.reduced(N[0] * E[0]))
    root = ring.inverse_square_root([ring.reduced(term * v) for term in ring.product(N, E, nu)])
    last = ring.reduced(sum([N[j] * root[nu - 1 - j] for j in range(nu)]))
    return p.field.from_scalars(ring.scalars(ring.reduced(4 * v * ring.reduced(last * last))))


class _Expansions:
    """Power series in t = x - c over K[x]/p, c the class of x, as the lists of their first `count` coefficients.

    For a linear p these are scalars of K, else polynomials of degree below that of p.
    """

    def __init__(self, p: Poly, count: int) -> None:
        self.p, self.count, self.field, self._linear = p, count, p.field, p.degree == 1
        self._slope: dict[int, list[Any]] = {} if self._linear else {1: [*_taylor(p, p)[1:], *[p * 0] * count][:count]}

    def reduced(self, element: Any) -> Any:
        return element if self._linear else element % self.p

    def inverse(self, element: Any) -> Any:
        one = self.field.scalar(self.field.poly([1]), 0)
        return one / element if self._linear else element.inverse_modulo(self.p)

    def scalars(self, element: Any) -> list[Any]:
        return [element] if self._linear else [self.field.scalar(element, i) for i in range(2 * self.p.degree - 1)]

    def product(self, one: list[Any], other: list[Any], count: int) -> list[Any]:
        """The first `count` coefficients; many of them by one product of polynomials over K [Kronecker's substitution]."""
        if count <= _FEW_TERMS:
            return [self.reduced(sum([one[i] * other[k - i] for i in range(k + 1)])) for k in range(count)]
        field, width = self.field, 2 * self.p.degree - 1  # coefficients begin so far apart that products don't overlap
        factors = [
            field.from_scalars([scalar for term in terms[:count] for scalar in self.scalars(term)])
            for terms in (one, other)
        ]
        product = factors[0] * factors[1]
        scalars = [field.scalar(product, i) for i in range(width * count)]
        if self._linear:
            return scalars
        return [field.from_scalars(scalars[k : k + width]) % self.p for k in range(0, width * count, width)]

    def inverse_square_root(self, u: list[Any]) -> list[Any]:
        """u^(-1/2) for u_0 = 1: the first terms from 2 u r' = -u' r, the others by Newton's iteration."""
        root = [u[0]]
        for k in range(1, min(self.count, _FEW_TERMS)):
            total = sum([(2 * k - j) * u[j] * root[k - j] for j in range(1, k + 1)])
            root.append(self.reduced(total) / (-2 * k))
        while len(root) < self.count:
            known = min(2 * len(root), self.count)
            root += [root[0] * 0] * (known - len(root))
            residual = self.product(u, self.product(root, root, known), known)
            change = self.product(root, [residual[0] - 1, *residual[1:]], known)
            root = [term - correction / 2 for term, correction in zip(root, change, strict=True)]
        return root

    def slope_power(self, exponent: int) -> list[Any]:
        """(p/t)^exponent."""
        if exponent not in self._slope:
            half = self.slope_power(exponent // 2)
            square = self.product(half, half, self.count)
            self._slope[exponent] = self.product(square, self._slope[1], self.count) if exponent % 2 else square
        return self._slope[exponent]

    def expand(self, f: Poly) -> list[Any]:
        """f(c + t), for many terms from the quotient and the remainder modulo a power of p."""
        n = self.p.degree
        if self._linear:
            moved = f(self.field.poly([-self.p[0], 1])) if self.p[0] else f
            return [self.field.scalar(moved, i) for i in range(self.count)]
        half = (f.degree // n + 1) // 2
        if f.degree < n or self.count <= _FEW_TERMS:
            return [*_taylor(f, self.p), *[f * 0] * self.count][: self.count]
        high, low = divmod(f, self.p**half)
        shifted = self.product(self.expand(high), self.slope_power(half), self.count)
        terms = self.expand(low)
        return [*terms[:half], *(a + b for a, b in zip(terms[half:], shifted, strict=False))]


def _taylor(polynomial: Poly, p: Poly) -> list[Any]:
    """All Taylor coefficients at the class of x in K[x]/p."""
    coefficients = []
    while polynomial:
        coefficients.append(polynomial % p)
        polynomial = polynomial.derivative() / len(coefficients)
    return coefficients

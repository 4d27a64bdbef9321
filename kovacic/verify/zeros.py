"""The possible numbers of zeros, at ordinary points of the equation, of a solution with a rational omega.

The residues of the differential omega dx, omega = y'/y rational, add up to 0.  At a zero of y the residue is 1, and at a
singular point it is the exponent of y there; so the number of zeros and the exponents at all singular points, that at infinity
included, add up to 1.  [Kovacic 1986, sections 2.1 and 3.2]

There are two exponents at a point of the order k > 0, A/2 plus or minus half their difference, where A = 1 for k <= 2 and
A = k/2 for even k > 2.  The difference is Delta or, at an irregular point, twice the residue of sqrt(S) dx.  Which of the two
belongs to y isn't known, hence the numbers that are possible.

The roots of an irreducible factor p aren't told apart: only the square of the difference is known, at "the" root, the class
of x in K[x]/p.  But at all of them y has the "same" exponent.  For an automorphism that leaves the elements of K alone, and
moves one root to another, leaves omega alone, whose coefficients are in K; so it moves the residue of omega at the one root to
that at the other.  These residues are thus the values at the roots of one element of K[x]/p, and so is the difference.  If its
square is no square in K[x]/p, no omega is rational over K; if it is one, the differences at the roots add up to the trace of
its square root, with one choice of the sign for all of them.

Unramified irregular points: for S = N/(p^(2 nu) q), p irreducible over K, the solutions at a root theta of p have the
exponents nu/2 +- r with r the residue of sqrt(S) dx (Kovacic's b/(2a)), and

    sqrt(S) = sqrt((N q)(theta)) R/(q p^nu),    R^2 = N q/(N q)(theta),  R = 1 + O(x - theta).                   (1)

Series at theta have coefficients in K[x]/p, so that no root leaves K; the residue is the coefficient of t^(nu - 1) in that of
R/(q (p/t)^nu), t = x - theta.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, islice
from operator import mul

from flint import fmpz

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.compatibility import cached_property
from kovacic.errors import VerificationFailed
from kovacic.limits import MOST_TRIALS
from kovacic.verify.factors import inverse
from kovacic.verify.local import Point
from kovacic.verify.primes import SAMPLES, BadPrimeError, Homomorphism, homomorphisms, roots_modulo


def residue_over_leading_root(N: Poly, q: Poly, p: Poly, nu: int) -> Poly:
    """The residue of R/(q p^nu) at the class of x in K[x]/p: times the square root of N q it is that of sqrt(S)."""
    one = p.field.one
    if p.degree == 1:  # at a rational pole, whose order may be high, by Newton's iteration for 1/R
        N, q = (f(p.field.poly([-p[0], 1])) for f in (N, q))
        t = p.field.x
        square = N * q % t**nu / (N * q)[0]
        root = one
        k = 1
        while k < nu:
            k = min(2 * k, nu)
            root = (root + root * (1 - square * root * root % t**k) / 2) % t**k
        return (square * root * inverse(q, t**nu) % t**nu)[nu - 1]
    coefficients = taylor(N * q, p, nu)
    scale = inverse(coefficients[0], p)
    R = [one]
    for k in range(1, nu):
        rest = coefficients[k] * scale - sum(map(mul, R[1:], reversed(R[1:])), 0 * one)
        R.append(rest / 2 % p)
    return last_of_quotient(R, taylor(q * p**nu, p, 2 * nu)[nu:], p)


def taylor(f: Poly, p: Poly, count: int) -> list[Poly]:
    """The first coefficients of f(theta + t) in K[x]/p, theta the class of x."""
    found = []
    for k in range(1, count + 1):
        found.append(f % p)
        f = f.derivative() / k
    return found


def last_of_quotient(above: list[Poly], below: list[Poly], p: Poly) -> Poly:
    """The last coefficient of the quotient of two series of one length in K[x]/p."""
    scale = inverse(below[0], p)
    found: list[Poly] = []
    for k, c in enumerate(above):
        found.append((c - sum(map(mul, found, below[k:0:-1]), p.field.zero)) * scale % p)
    return found[-1]


@dataclass(frozen=True)
class ZeroCounts:
    """The possible numbers of zeros: `total` plus or minus each of the `choices`, one for a point with two exponents.

    A choice is half the difference of the exponents, summed over the roots of the factor.
    """

    total: Fraction
    choices: tuple[tuple[Point, Fraction], ...]

    @cached_property
    def largest(self) -> int:
        """The largest number; -1 if there is none."""
        return largest_natural_sum(self.total, [half for _, half in self.choices])

    def by_exponent(self, point: Point) -> list[tuple[Fraction, int]] | None:
        """The exponents that omega can have at a single point, each with the largest number of zeros.

        None if there is no choice, and for irrational exponents over another field than Q, of which `choices` has the first
        coordinate only.
        """
        own = [half for other, half in self.choices if other is point]
        is_exact = point.difference is not None or point.factor.field == QQ
        if not own or point.factor.degree > 1 or not is_exact:
            return None
        others = [half for other, half in self.choices if other is not point]
        possible = [(shift, largest_natural_sum(self.total - shift, others)) for shift in (own[0], -own[0])]
        mean = Fraction(_double_mean(point), 2)
        return [(mean + shift, bound) for shift, bound in possible if bound >= 0]


def zero_counts(all_points: list[Point]) -> ZeroCounts | None:
    """The possible numbers of zeros; None if exponents at a point don't lie in K[x]/p, so that no omega is rational over K."""
    twice = 2
    choices = []
    for point in all_points:
        if point.order == 0:
            continue
        if point.order > 2 and point.order % 2:  # ramified
            return None
        twice -= point.factor.degree * _double_mean(point)
        half = _half_difference(point)
        if half is None:
            return None
        # At a logarithm omega belongs to the solution without one, which has the larger exponent; Delta is natural.
        if point.logarithm:
            twice -= int(2 * half)
        else:
            choices.append((point, half))
    return ZeroCounts(Fraction(twice, 2), tuple(choices))


def is_proven_irrational(point: Point) -> bool:
    """True if the exponents at the point, of an even order, are provably not rational over the field K[x]/p of its roots."""
    return point.difference is None and is_no_square(_radicand(point), point.factor)


def _double_mean(point: Point) -> int:
    """A, the sum of the two exponents at a root."""
    return max(point.order // 2, 1)


def _half_difference(point: Point) -> Fraction | None:
    """Half the difference of the exponents, added up over the roots of the factor; its sign is left open.

    None if the difference is provably no element of K[x]/p, so that no omega is rational over K.
    """
    p = point.factor
    if point.difference is not None:  # the same rational number at all roots
        return Fraction(p.degree * point.difference.numerator, 2 * point.difference.denominator)
    radicand = _radicand(point)
    if is_no_square(radicand, p):
        return None
    # The cofactor of the square root: 1/M for Delta; at an irregular point twice the residue of sqrt(S) over sqrt(N q).
    if point.order == 2:
        scale = inverse(point.at_double_pole[1], p)
    else:
        scale = 2 * residue_over_leading_root(*point.near, p, point.order // 2)
    # The trace over K is that of the matrix by which the difference multiplies 1, x, x^2, ...
    column = _proven_square_root(radicand, p) * scale % p
    trace = p.field.zero
    for k in range(p.degree):
        trace = trace + column[k]
        column = p.field.x * column % p
    # The first coordinate over Q is a linear map that leaves rational numbers alone.  Exponents and zeros add up to 1 in K;
    # applied to all of them, it makes this a relation of rational numbers, with the same number of zeros.
    return to_fraction(trace.rational_coefficients()[0]) / 2 if trace else Fraction(0)


def _radicand(point: Point) -> Poly:
    """The square root of which the difference is a multiple: Delta^2 = 1 + 4 N/M, or S = N/(p^k q), both in K[x]/p."""
    if point.order == 2:
        N, M = point.at_double_pole
        return M * (M + 4 * N) % point.factor
    N, q = point.near
    return N * q % point.factor


def is_no_square(element: Poly, p: Poly) -> bool:
    """True if an element of K[x]/p is no square, because its norm or its value at a simple root of p isn't one mod a prime.

    The norm costs least, but that of a rational number, for instance, is a square for every even degree of p.  Roots are
    sought among enough primes for one to be there as a rule; if none is found, or an element happens to be a square modulo
    all of them, nothing is proven.
    """
    if element.degree <= 0 and p.field.sqrt(element) is not None:  # which spares the tests
        return False
    # Norms come first: they cost less than a hundredth of the roots at degree 60, and two of them tell as a rule.
    tests = chain(islice(_norms(element, p), SAMPLES), islice(_values_at_roots(element, p), SAMPLES))
    return any(fmpz(value).jacobi(h.p) == -1 for h, value in tests)


def _norms(element: Poly, p: Poly) -> Iterator[tuple[Homomorphism, int]]:
    """The norm to K of an element of K[x]/p modulo primes."""
    for h in homomorphisms(p.field):
        try:
            yield h, int(h.keeping_degree(p).resultant(h(element)))
        except BadPrimeError:
            continue


def _values_at_roots(element: Poly, p: Poly) -> Iterator[tuple[Homomorphism, int]]:
    """The values of an element of K[x]/p at the simple roots of p modulo primes."""
    for h in homomorphisms(p.field):
        try:
            image = h(element)
        except BadPrimeError:
            continue
        for root in roots_modulo(p, h):
            yield h, int(image(root))


def _proven_square_root(element: Poly, p: Poly) -> Poly:
    """A square root in K[x]/p of an element that is a square modulo many primes: found by the field, and squared again."""
    field = p.field
    if p.degree == 1:
        root = field.sqrt(element)
    else:
        extension = AlgebraicField(field, p)
        found = extension.sqrt(extension.element(element))
        root = None if found is None else field.poly([part[0] for part in found.parts])
    if root is None or (root * root - element) % p:
        raise VerificationFailed(f"{element} is a square modulo many primes, and no square root modulo {p} was found")
    return root


def largest_natural_sum(total: Fraction, choices: list[Fraction]) -> int:
    """The largest natural number among `total` plus or minus each of the choices; -1 if there is none.

    All signs plus give the largest sum; a minus instead takes off twice a choice.  Of what is taken off the least is kept for
    each fractional part that is left.  With too many of these the largest sum of all, rounded down, is an upper bound.
    """
    unit = math.lcm(total.denominator, *(choice.denominator for choice in choices))  # all in units of 1/unit
    sizes = [abs(choice.numerator) * (unit // choice.denominator) for choice in choices]
    largest = total.numerator * (unit // total.denominator) + sum(sizes)
    losses = {largest % unit: 0}
    for size in sizes:
        for loss in [*losses.values()]:
            more = loss + 2 * size
            part = (largest - more) % unit
            losses[part] = min(more, losses.get(part, more))
        if len(losses) > MOST_TRIALS:
            return max(largest // unit, -1)
    return max((largest - losses.get(0, largest + unit)) // unit, -1)

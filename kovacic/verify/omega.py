"""No rational omega: at a point where finitely many local solutions could have one, none does, modulo a prime.

If omega = A/(den P) + ... is the only one it is rational over K, and the degree of P, the number of zeros, is bounded; so it
reduces modulo a prime to a rational function with that denominator, or a divisor, whose expansion at the point is that of
y'/y for one of the local solutions.  Euclid's algorithm tells whether an expansion is that of such a function.
[van Hoeij, J. Symb. Comp. 24 (1997)]
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.verify.local import Point, solution_with_exponential_part
from kovacic.verify.primes import BadPrimeError, Homomorphism, translated
from kovacic.verify.series import rational_candidate, square_root_of_series
from kovacic.verify.zeros import ZeroCounts


@dataclass(frozen=True)
class Chart:
    """S = M/(t^k E) modulo a prime at a root of the place, t = 0; omega is A/(den P) with deg A <= growth + deg P."""

    place: Point
    M: Any
    E: Any
    num: Any
    den: Any
    growth: int

    @property
    def p(self) -> int:
        return int(self.E.modulus())

    @property
    def nu(self) -> int:
        """The order of the pole of omega."""
        return max(self.place.order, 2) // 2


def chart(place: Point, points: list[Point], h: Homomorphism, root: int) -> Chart:
    """In the coordinate t of the place; its other end is x = infinity or, for the place at infinity, x = 0.

    There omega grows like x^(k/2 - 2), k > 2 the order of the pole of S at that end, or like 1/x.
    """
    M, E = place.localised(h, root)
    den = translated(h.keeping_degree(place.den), root)
    origin = place.factor.field.x
    growth = -1
    for other in points:
        if other.at_infinity != place.at_infinity and other.factor == origin:
            growth = max(growth, (other.order + 1) // 2 - 2)
    num = translated(h(place.num), root)
    return Chart(place, M, E, num, den, den.degree() + growth)


def no_expansion_is_rational(at: Chart, counts: ZeroCounts) -> bool:
    """True if no expansion that omega can have there is that of a rational function with a possible number of zeros.

    Raises `BadPrimeError` if the prime is too small for the series, or changes the equation.
    """
    bounds = counts.by_exponent(at.place)
    for start in first_terms(at):
        degree = counts.largest
        if bounds is not None:  # the largest number of zeros of a solution with this exponent modulo the prime
            exponent = int(start[at.nu - 1])
            possible = [bound for e, bound in bounds if (exponent * e.denominator - e.numerator) % at.p == 0]
            degree = max(possible, default=-1)
        if degree >= 0 and _has_rational_omega(at, start, degree):
            return False
    return True


def first_terms(at: Chart) -> Iterator[Any]:
    """The first nu terms of t^nu omega, the last of them the exponent, for every local solution that can have a rational omega.

    At a regular place one or two exponents e with e (e - 1) = M/E; at an irregular one +- sqrt(M/E) + nu/2 t^(nu-1).
    """
    s = at.M.mul_low(at.E.inverse_series_trunc(at.nu), at.nu)
    half = pow(2, -1, at.p)
    if at.nu > 1:
        middle = nmod_poly([at.nu * half], at.p).left_shift(at.nu - 1)
        for root in _square_roots(int(s[0]), at.p):
            yield square_root_of_series(s, root, at.nu) + middle
        return
    difference = at.place.difference
    if difference is None:
        differences = _square_roots(1 + 4 * int(s[0]), at.p)
    else:
        value = difference.numerator * pow(difference.denominator, -1, at.p)
        differences = [value] if at.place.logarithm else [value, -value]
    for value in differences:
        yield nmod_poly([(1 + value) * half % at.p], at.p)


def _square_roots(value: int, p: int) -> list[int]:
    """Both square roots modulo p, none for a non-residue.  Raises `BadPrimeError` for 0: the exponents are different ones."""
    if value % p == 0:
        raise BadPrimeError("exponents agree modulo the prime")
    if fmpz(value).jacobi(p) == -1:
        return []
    root = int(fmpz(value % p).sqrtmod(p))
    return [root, p - root]


def _has_rational_omega(at: Chart, start: Any, degree: int) -> bool:
    """True if some omega = A/(den P) has this expansion, with deg P <= degree and deg A <= degree + growth.

    The only candidate with these terms, one more than there are unknowns, must solve the Riccati equation as well.
    """
    top = degree + at.growth
    count = top + degree + 2
    if at.p <= 2 * count:
        raise BadPrimeError("the prime is small")
    u = solution_with_exponential_part(at.M, at.E, start, at.nu, count)
    correction = u.derivative().mul_low(u.inverse_series_trunc(count), count).left_shift(at.nu)
    series = (start + correction).truncate(count)
    A, P = rational_candidate(at.den.right_shift(at.nu).mul_low(series, count), count, top)
    B = at.den * P  # (A/B)' + (A/B)^2 = num/den
    is_omega = at.den * (A.derivative() * B - A * B.derivative() + A * A) == at.num * B * B
    return bool(P.degree() <= degree and is_omega)

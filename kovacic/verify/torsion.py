"""The order of a divisor class modulo a prime, for groups on curves of positive genus.

For f = y1 y2, H = (y1'/y1 - y2'/y2)^2 is rational, and eta = sqrt(H) dx = d log(y1/y2) here has simple poles with rational
residues +-Delta only, l their common denominator.  D is the sum of the l Delta (P - P') over the poles: P is the point with the
residue Delta > 0, P' its conjugate.  Reduction is injective on torsion where p is odd and unramified and no zeros or poles of
H, infinity among them, meet; so a D with different orders modulo two such primes has none.

Modulo p there is a coordinate t, x = r + 1/t, for which H(r) isn't a square.  Then H dx^2 = N/M dt^2 and N M = h T^2, where
h is squarefree, of an even degree 2g + 2, and its leading coefficient isn't a square: on y^2 = h the two points at t = infinity
are conjugate, and a + b y has a pole of the order max(deg a, deg b + g + 1) at both.  So

- eta = T y/M dt, and y = Delta q' (M/q^2)/(T/q) at the P over a double root of M, a root of q;
- an effective divisor E stands for the class of E - (deg E/2) (both points at infinity), and P + P' for 0;
- E without pairs P + P', of an even degree up to g + 1, is principal only if it is 0: a function with poles at infinity alone,
  of the order deg E/2 < g + 1, is a polynomial in t, whose zeros are such pairs.

References: D. Cantor, Math. Comp. 48 (1987) 95-101, for sums and reduction; N. Katz, Invent. Math. 62 (1981) 481-502, appendix,
for torsion under reduction.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any, NamedTuple

from flint import fmpz

from kovacic.algebra.ratfunc import RatFunc
from kovacic.verify.primes import BadPrimeError, Homomorphism, homomorphisms_modulo, is_usable_prime, translated


def order_holds(H: RatFunc, residues: set[Fraction], p: int, k: int) -> bool:
    """True if p is a prime of good reduction, modulo which the class of D has the order k."""
    if k < 1 or not is_usable_prime(p):
        return False
    for h in homomorphisms_modulo(H.field, p):
        try:
            eta = _differential(H, h)
            D = _class_of_poles(eta, residues)
        except BadPrimeError:
            continue
        # k D is principal, and k/q D is for no prime q that divides k.
        curve = Curve(eta.h)
        smaller = [k // int(q) for q, _ in fmpz(k).factor()]
        if curve.multiple(k, D).is_zero and not any(curve.multiple(m, D).is_zero for m in smaller):
            return True
    return False


class Differential(NamedTuple):
    """eta = T y/M dt on y^2 = h over F_p, as in the module's text."""

    h: Any
    T: Any
    M: Any


def _differential(H: RatFunc, homomorphism: Homomorphism) -> Differential:
    """eta modulo p; raises `BadPrimeError` if zeros or poles meet."""
    num, den = (homomorphism.keeping_degree(f) for f in (H.num, H.den))
    p = num.modulus()
    r = next((r for r in range(p) if fmpz(int(num(r)) * int(den(r))).jacobi(p) == -1), None)  # where H is no square
    if r is None:
        raise BadPrimeError("all values are squares")
    # num/den dx^2 = N/M dt^2 for x = r + 1/t, dx = -dt/t^2; num and den don't vanish at r.
    shift = den.degree() - num.degree() - 4
    N = translated(num, r).reverse().left_shift(max(shift, 0))
    M = translated(den, r).reverse().left_shift(max(-shift, 0))
    leading, factors = (N * M).factor()
    # The number of zeros and poles of H dx^2, infinity counted, must not change modulo p.
    support = sum(f.degree - f.gcd(f.derivative()).degree for f in (H.num, H.den))
    support += H.den.degree != H.num.degree + 4
    if sum(q.degree() for q, _ in factors) < support:
        raise BadPrimeError("zeros or poles meet")
    h = N**0 * int(leading)
    T = N**0
    for q, multiplicity in factors:
        T *= q ** (multiplicity // 2)
        if multiplicity % 2:
            h *= q
    return Differential(h, T, M)


def _class_of_poles(eta: Differential, residues: set[Fraction]) -> ReducedDivisor:
    """D: with 2 P for P - P', the sum of the 2 l Delta P."""
    curve = Curve(eta.h)
    l = lcm(*(residue.denominator for residue in residues))  # noqa: E741 - as in the module's text
    p = eta.h.modulus()
    by_square = {}  # the residues by their squares modulo p, which have to be different
    for residue in residues:
        if residue.denominator % p == 0:
            raise BadPrimeError("a residue isn't integral")
        by_square[residue.numerator**2 * pow(residue.denominator, -2, p) % p] = residue
    if len(by_square) < len(residues):
        raise BadPrimeError("residues agree up to their signs")
    total = curve.zero
    for q in (q for q, multiplicity in eta.M.factor()[1] if multiplicity == 2):
        # y at the points over the roots of q where the residue is 1; it is proportional to the residue.
        y = q.derivative() * (eta.M // (q * q)) * _inverse_modulo(eta.T // q, q) % q
        square = eta.h * _inverse_modulo(y * y, q) % q
        positive = by_square.get(int(square[0]))
        if square.degree() > 0 or positive is None:
            raise BadPrimeError("a residue is another one")
        points = ReducedDivisor(q, y * (positive.numerator * pow(positive.denominator, -1, p) % p))
        total = curve.sum(total, curve.multiple(int(2 * l * positive), points))
    return total


def _inverse_modulo(value: Any, modulus: Any) -> Any:
    """1/value modulo an irreducible polynomial that doesn't divide it."""
    return (value % modulus).xgcd(modulus)[1]


class ReducedDivisor(NamedTuple):
    """The points over the roots of the monic u, with y = v there [Mumford]: an effective divisor without pairs P + P'."""

    u: Any
    v: Any

    @property
    def is_zero(self) -> bool:
        return bool(self.u.degree() == 0)


@dataclass(frozen=True)
class Curve:
    """y^2 = h over F_p, the two points at infinity conjugate."""

    h: Any

    @property
    def zero(self) -> ReducedDivisor:
        return ReducedDivisor(self.h**0, self.h * 0)

    def multiple(self, n: int, E: ReducedDivisor) -> ReducedDivisor:
        """n E, reduced, for n > 0: by doubling, from the leading binary digit of n on."""
        total = self.zero
        for digit in f"{n:b}":
            total = self.sum(total, total)
            if digit == "1":
                total = self.sum(total, E)
        return total

    def sum(self, first: ReducedDivisor, second: ReducedDivisor) -> ReducedDivisor:
        """The sum without pairs P + P', which are over the roots of d, reduced [Cantor].

        The functions u1 u2, u1 (y - v2), u2 (y - v1) and (y - v1)(y - v2) vanish on the sum; what they generate
        contains u d and (y - v) d.
        """
        u1, v1 = first
        u2, v2 = second
        common, e1, e2 = u1.xgcd(u2)
        d, c, c3 = common.xgcd(v1 + v2)
        u = u1 * u2 // (d * d)
        v = (c * e1 * u1 * v2 + c * e2 * u2 * v1 + c3 * (v1 * v2 + self.h)) // d % u
        # Reduced to the degree g + 1 at most: the conjugates of the other zeros of y - v have the same class.
        while 2 * u.degree() > self.h.degree():
            others = (v * v - self.h) // u
            u = others * pow(int(others.leading_coefficient()), -1, u.modulus())
            v = -v % u
        return ReducedDivisor(u, v)

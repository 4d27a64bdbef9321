"""The order of a divisor class modulo a prime, for groups on curves of positive genus.

For f = y1 y2, H = (y1'/y1 - y2'/y2)^2 is rational, and eta = sqrt(H) dx = d log(y1/y2) here has simple poles with rational
residues +-Delta only, l their common denominator.  Modulo p, H = h s^2, h squarefree; eta lives on y^2 = h, y = sqrt(H)/s.
At a double pole of H, a root of q, y = Delta q'/(s q) has the residue Delta; there the divisor D of l eta has m = l Delta
points P, less their conjugates.  By norms, n D is the divisor of some (a + b y)/prod q^(n m) exactly when

    a + b v = 0 mod U = prod q^(2 n m),    2 deg a <= deg U,    2 deg b + deg h <= deg U,                          (1)

v^2 = h modulo U, v = y at the P.  Euclid's algorithm for U and v has the only candidate.  Reduction is injective on torsion
where p is odd and unramified and no points of the support of H, or infinity, meet.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm, prod
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.ratfunc import RatFunc
from kovacic.limits import Budget
from kovacic.verify.primes import homomorphisms_modulo


def order_holds(H: RatFunc, residues: set[Fraction], p: int, k: int, budget: Budget) -> bool:
    """Is p a prime of good reduction, modulo which the class of D has the order k?"""
    if p < 3 or k < 1 or not fmpz(p).is_prime():
        return False
    for h in homomorphisms_modulo(H.field, p):
        try:
            divisor = _divisor(H, residues, h)
        except BadPrimeError:
            continue
        budget.check_degree(k * sum(2 * m * q.degree() for q, _, m in divisor.points), "a function on the curve")
        if divisor.is_principal(k) and not any(divisor.is_principal(k // int(q)) for q, _ in fmpz(k).factor()):
            return True
    return False


@dataclass(frozen=True)
class _Divisor:
    """m points (x, y) over the roots of each q, less their conjugates, on y^2 = h over F_p; y modulo q."""

    h: Any
    points: tuple[tuple[Any, Any, int], ...]

    def is_principal(self, n: int) -> bool:
        """Is n times the divisor that of a function?  By (1)."""
        v, one, known, most = self.h * 0, self.h**0, 1, max(2 * n * m for _, _, m in self.points)
        radical, U = prod((q for q, *_ in self.points), start=one), prod(q ** (2 * n * m) for q, _, m in self.points)
        for q, y, _ in self.points:
            v += radical // q * (y * _inverse(radical // q, q) % q)
        while known < most:
            known = min(2 * known, most)
            v = (v - (v * v - self.h) * _inverse(2 * v, radical**known)) % radical**known
        r0, r1 = U, v % U
        while 2 * r1.degree() > U.degree():
            r0, r1 = r1, r0 % r1
        return bool(U.degree() + self.h.degree() <= 2 * r0.degree())  # a = r1, deg b = deg U - deg r0


def _divisor(H: RatFunc, residues: set[Fraction], h: Homomorphism) -> _Divisor:
    """D modulo p; raises `BadPrimeError` where points of the support meet, or residues are the same up to their signs."""
    p, num, den = h.p, h.keeping_degree(H.num), h.keeping_degree(H.den)
    support = sum(f.degree - f.gcd(f.derivative()).degree for f in (H.num, H.den)) + (H.den.degree != H.num.degree + 4)
    if (
        den.degree() == num.degree() + 2
    ):  # a double pole at infinity becomes t = 0, x = r + 1/t, and no other one infinity
        r = next((r for r in range(p) if not any(k == 2 and not q(r) for q, k in den.factor()[1])), None)
        if r is None:
            raise BadPrimeError("every point is a pole")
        num, den = (f.compose(nmod_poly([r, 1], p)).reverse() for f in (num, den))
        den = den.left_shift(2)
    (c, above), (d, below) = num.factor(), den.factor()
    factors = [*above, *((q, -k) for q, k in below)]
    count = sum(q.degree() for q, _ in factors) + (den.degree() != num.degree() + 4)
    squares = {r.numerator**2 * pow(r.denominator, -2, p) % p: r for r in residues if r.denominator % p}
    if num.gcd(den).degree() > 0 or count < support or len(squares) < len(residues):
        raise BadPrimeError("points meet, or residues agree")
    curve = prod((q for q, k in factors if k % 2), start=nmod_poly([int(c) * pow(int(d), -1, p)], p))
    top, bottom = (prod((q ** abs(k // 2) for q, k in factors if sign * k > 0), start=num**0) for sign in (1, -1))
    points, l = [], lcm(*(r.denominator for r in residues))  # noqa: E741 - as in the module's text
    for q in (q for q, k in below if k == 2):
        y = q.derivative() * (bottom // q) * _inverse(top, q) % q  # for Delta = 1
        delta = squares.get(int((curve * _inverse(y * y, q) % q)[0]))
        if delta is None:
            raise BadPrimeError("a residue is another one")
        points.append((q, y * (delta.numerator * pow(delta.denominator, -1, p) % p), int(l * delta)))
    return _Divisor(curve, tuple(points))


def _inverse(value: Any, modulus: Any) -> Any:
    return (value % modulus).xgcd(modulus)[1]

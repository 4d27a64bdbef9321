"""The order of an imprimitive group: dicyclic of order 4n, or N(T).

Let f = y1 y2 be the semi-invariant, g = f^2 a rational function and w = y1 y2' - y1' y2.  On the curve z^2 = g,

    u = y1/y2 = exp(int eta),      eta = -w dx / z                                                                 (1)

(the sign doesn't matter: the conjugate of u is 1/u).  The group is dicyclic of order 4n when n is the least positive integer
for which u^n is a function on the curve, and N(T) when there is none.

Let e be the valuation of g at a place, in the coordinate of `places` (at infinity: 4 minus the growth of g).  The branch
points are the places with odd e.  In the Fuchsian case e <= 2, and eta has its poles where e = 2: simple ones, with the
residues +-Delta (+-1 at an ordinary point, where y1 or y2 vanishes).  So with rational Delta and l the common denominator,

- genus 0: every divisor of degree 0 is principal, and a differential is determined by its residues, so n = l;
- genus > 0, no poles: u isn't algebraic;
- genus > 0: n = l k, k the order of the divisor D of l eta in the Jacobian; if it is infinite, N(T).  Reduction modulo a
  prime of good reduction is injective on torsion: two different orders prove that k is infinite.  Where some primes agree on
  k, `chain` finds the function f with the divisor k D, if there is one: then u^n = f if n eta = df/f, and if there is a rest,
  a holomorphic differential, the group is N(T).

Divisor classes on a curve z^2 = h(x) over F_p, deg h odd: Cantor's arithmetic in Mumford's representation.  A class is (u,
v): u monic, deg v < deg u <= genus, u | h - v^2; it stands for the points (x, v(x)) at the roots x of u, each minus the one
point at infinity.  The neutral element is (1, 0).

References: Kovacic 1986, sec. 4; J. H. Davenport, On the Integration of Algebraic Functions (1981), for the torsion test;
D. Cantor, "Computing in the Jacobian of a hyperelliptic curve", Math. Comp. 48 (1987) 95-101; D. Shanks, "Class
number, a theory of factorization, and genera", Proc. Symp. Pure Math. 20 (1971) 415-440, for the steps to an order.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, count, islice, takewhile
from math import isqrt, lcm, prod
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.modular import simple_roots
from kovacic.algebra.poly import Field
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.algebra.splitting import number_field_homomorphisms
from kovacic.decision import SemiInvariant
from kovacic.engine.places import Problem
from kovacic.engine.riccati import logarithmic_residue
from kovacic.errors import LimitExceeded
from kovacic.galois.chain import Divisor, function_of_order
from kovacic.galois.group import Ground, Group, GroupKind
from kovacic.limits import MOST_TRIALS


@dataclass(frozen=True)
class Jacobian:
    """The divisor classes of degree 0 of z^2 = h, h squarefree of odd degree over F_p, p odd."""

    h: Any

    @property
    def zero(self) -> Divisor:
        return Divisor(self.h**0, self.h * 0)

    def point(self, u: Any, v: Any) -> Divisor:
        """The class of the points (x, v(x)) at the roots of u.  Raises `ValueError` unless they lie on the curve."""
        if (self.h - v * v) % u:
            raise ValueError("the points don't lie on the curve")
        return self._reduced(_monic(u), v % u)

    def add(self, first: Divisor, second: Divisor) -> Divisor:
        """The sum of two classes."""
        return self._reduced(*first.plus(second, self.h))

    def multiple(self, k: int, value: Divisor) -> Divisor:
        """k times a class, for an integer k of either sign."""
        if k < 0:
            k = -k
            value = Divisor(value.u, -value.v)
        result = self.zero
        while k:
            if k & 1:
                result = self.add(result, value)
            value = self.add(value, value)
            k >>= 1
        return result

    def order(self, value: Divisor) -> int:
        """The order of a class: of a multiple that is zero, without the prime factors that aren't needed."""
        order = self._vanishing_multiple(value)
        for q, _ in fmpz(order).factor():
            while order % int(q) == 0 and self.multiple(order // int(q), value) == self.zero:
                order //= int(q)
        return order

    def _vanishing_multiple(self, value: Divisor) -> int:
        """Some n > 0 with n D = 0, from the interval of Hasse and Weil in which the number of all classes lies.

        n = least + i s - j for one of the giant steps i and of the s baby steps j [Shanks].
        """
        # The number of classes is between (sqrt(p) - 1)^(2g) and (sqrt(p) + 1)^(2g) [Weil].
        genus = (self.h.degree() - 1) // 2
        root = Fraction(isqrt(int(self.h.modulus()) << 40), 1 << 20)  # at most sqrt(p), and more than sqrt(p) - 2^-20
        least = max(int((root - 1) ** (2 * genus)), 1)
        most = int((root + 1 + Fraction(1, 1 << 20)) ** (2 * genus)) + 1
        s = isqrt(most - least) + 1
        babies: dict[tuple[Any, ...], int] = {}
        current = self.zero
        for j in range(s):
            babies[_key(current)] = j
            current = self.add(current, value)
            if current == self.zero:
                return j + 1
        giant = self.multiple(s, value)
        current = self.multiple(least, value)
        for i in range(s + 2):
            n = least + i * s - babies.get(_key(current), 0)
            if _key(current) in babies and n > 0:
                return n
            current = self.add(current, giant)
        raise AssertionError("the number of classes is in the interval of Hasse and Weil")

    def _reduced(self, u: Any, v: Any) -> Divisor:
        while 2 * u.degree() >= self.h.degree():
            u = _monic((self.h - v * v) // u)
            v = -v % u
        return Divisor(u, v)


def _key(divisor: Divisor) -> tuple[Any, ...]:
    """A dictionary key for a divisor: FLINT's polynomials are unhashable."""
    return tuple(divisor.u), tuple(divisor.v)


def _monic(u: Any) -> Any:
    return u * pow(int(u.leading_coefficient()), -1, u.modulus())


#: Primes whose orders must agree before a function of this order is sought.
_AGREEING_PRIMES = 3
#: The orders 1, 2, ... up to this are tried where no prime shows one.
_ORDERS_TRIED = 12


@dataclass(frozen=True)
class CurvePoint:
    """The places over the roots of a factor: the valuation e of g there, and the residue of eta (0 without a pole).

    The factor is one over the field, or its image modulo a prime.
    """

    factor: Any
    e: int
    residue: Fraction


@dataclass(frozen=True)
class SquareRootCurve:
    """z^2 = g with the points that matter: those with e != 0, infinity apart."""

    points: tuple[CurvePoint, ...]
    infinity: CurvePoint

    @property
    def genus(self) -> int:
        return int(sum(point.factor.degree for point in (*self.points, self.infinity) if point.e % 2)) // 2 - 1

    @property
    def residues(self) -> list[Fraction]:
        return [point.residue for point in (*self.points, self.infinity) if point.residue]


def imprimitive_group(problem: Problem, f: SemiInvariant) -> Group:
    """The group of an equation whose semi-invariant f = y1 y2 of degree 2 isn't rational, with two conjugate omegas."""
    if any(place.order > 2 for place in problem.places):
        return Group(GroupKind.INFINITE_DIHEDRAL, Ground.IRREGULAR)
    if any(place.delta is None for place in problem.places):
        return Group(GroupKind.INFINITE_DIHEDRAL, Ground.IRRATIONAL_EXPONENT)
    if f.P.field != problem.field:  # three pairs of lines: only the quaternion group has them
        return Group(GroupKind.DICYCLIC, Ground.THREE_PAIRS, 2)
    curve = square_root_curve(problem, f)
    l = lcm(1, *(r.denominator for r in curve.residues))  # noqa: E741 - as in the module's text
    if curve.genus == 0:
        return Group(GroupKind.DICYCLIC, Ground.GENUS_ZERO, l)
    if not curve.residues:
        return Group(GroupKind.INFINITE_DIHEDRAL, Ground.FIRST_KIND)
    try:
        return _of_positive_genus(problem, f, curve, l)
    except LimitExceeded:
        return Group(GroupKind.IMPRIMITIVE, Ground.UNDETERMINED, max(l, 2))


def square_root_curve(problem: Problem, f: SemiInvariant) -> SquareRootCurve:
    """The valuations of g = f^2 and the residues of eta."""
    R = 2 * (f.theta * problem.D).num
    points = []
    growth = 2 * f.P.degree
    for place in problem.finite_places:
        e = logarithmic_residue(problem, R, place)
        growth += e * place.degree
        if e:
            points.append(CurvePoint(place.factor, e, _residue_of_eta(e, place.delta)))
    if f.P.degree > 0:
        points.append(CurvePoint(f.P, 2, Fraction(1)))
    place = problem.infinity
    e = 4 - growth
    return SquareRootCurve(tuple(points), CurvePoint(place.factor, e, _residue_of_eta(e, place.delta)))


def _residue_of_eta(e: int, delta: Fraction | None) -> Fraction:
    """The difference of the exponents where the valuation is 2, else 0."""
    return delta if e == 2 and delta else Fraction(0)


def _of_positive_genus(problem: Problem, f: SemiInvariant, curve: SquareRootCurve, l: int) -> Group:  # noqa: E741
    """Orders modulo primes, and the function that has the divisor, once some of them agree."""
    # eta = sqrt(H) dx: with omega1 + omega2 = phi = f'/f, phi' + (omega1^2 + omega2^2) = 2 S, H = (omega1 - omega2)^2.
    H = 4 * problem.S - 2 * f.logarithmic_derivative.derivative() - f.logarithmic_derivative**2
    orders: list[tuple[int, int]] = []
    for h in _small_homomorphisms(problem.field, curve.genus):
        problem.budget.check()
        try:
            # The kernel moves infinity to where H isn't a square modulo p: there has to be such a place.
            num = h(H.num)
            den = h(H.den)
            if all(fmpz(int(num(r)) * int(den(r))).jacobi(h.p) != -1 for r in range(h.p)):
                continue
            k = _order_modulo(h, curve, l)
        except BadPrimeError:
            continue
        orders.append((h.p, k))
        if k != orders[0][1]:
            return Group(GroupKind.INFINITE_DIHEDRAL, Ground.NOT_TORSION, orders=(orders[0], orders[-1]))
        if len(orders) == _AGREEING_PRIMES:
            group = _by_function(H, k)
            if group is not None:
                return group
    if len(orders) < _AGREEING_PRIMES:  # too few of them are small enough
        candidates = [orders[0][1]] if orders else range(1, _ORDERS_TRIED + 1)
        for k in candidates:
            problem.budget.check()
            group = _by_function(H, k)
            if group is not None:
                return group
    return Group(GroupKind.IMPRIMITIVE, Ground.UNDETERMINED, max(l, 2))


def _by_function(H: RatFunc, k: int) -> Group | None:
    """The group if k D is the divisor of a function: finite exactly if its logarithm is k l times that of u."""
    f = function_of_order(H, k)
    if f is None:
        return None
    if f.rest:
        return Group(GroupKind.INFINITE_DIHEDRAL, Ground.HOLOMORPHIC_REST, function=f)
    return Group(GroupKind.DICYCLIC, Ground.FUNCTION, f.multiple, function=f)


def _small_homomorphisms(field: Field, genus: int) -> Iterator[Homomorphism]:
    """Homomorphisms to prime fields, from p = 5 on; smaller ones first, since orders grow like p^genus.  Numbers only."""
    if field.ground != QQ:
        return iter(())
    primes = (p for p in count(5) if fmpz(p).is_prime())
    tried = islice((h for p in primes for h in number_field_homomorphisms(field, p)), MOST_TRIALS)
    return takewhile(lambda h: h.p**genus <= 10**7, tried)


def _order_modulo(h: Homomorphism, curve: SquareRootCurve, l: int) -> int:  # noqa: E741 - as in the module's text
    """The order of the divisor of l eta in the Jacobian modulo p.  Raises `BadPrimeError` at a prime of bad reduction."""
    # The kernel knows the residues by their squares modulo p: these have to be units, and different ones.
    squares = {residue**2 for residue in curve.residues}
    differences = {a - b for a, b in combinations(squares, 2)}
    if any(value.numerator * value.denominator % h.p == 0 for value in squares | differences):
        raise BadPrimeError("a residue isn't a unit, or two have the same square")
    images = [replace(point, factor=h.keeping_degree(point.factor)) for point in curve.points]
    together = prod((image.factor for image in images), start=nmod_poly([1], h.p))
    if together.gcd(together.derivative()).degree() > 0:
        raise BadPrimeError("points meet")
    if curve.infinity.e % 2 == 0:
        images = _with_branch_point_at_infinity(images, curve.infinity, h.p)
    # With g = c b Q^2, b the product over the branch points, eta = dx/(s Q) on the curve s^2 = b/c', c' a constant that one
    # of its points tells.
    poles = [(image, _ordinate(image, images)) for image in images if image.residue]
    first, s = poles[0]
    branch = prod((image.factor for image in images if image.e % 2), start=first.factor**0)
    jacobian = Jacobian(branch * int((s * s * branch.xgcd(first.factor)[1] % first.factor)[0]))
    total = jacobian.zero
    for image, s in poles:
        points = jacobian.point(image.factor, s)
        total = jacobian.add(total, jacobian.multiple(int(2 * l * image.residue), points))
    return jacobian.order(total)


def _with_branch_point_at_infinity(images: list[CurvePoint], infinity: CurvePoint, p: int) -> list[CurvePoint]:
    """The points in a coordinate t = 1/(x - r), which keeps eta, with a branch point at infinity; the old infinity is 0."""
    r = next((root for image in images if image.e % 2 for root in simple_roots(image.factor)), None)
    if r is None:
        raise BadPrimeError("no branch point is rational modulo this prime")
    moved = []
    for image in images:
        factor = image.factor.compose(nmod_poly([r, 1], p)).reverse()
        if factor.degree():
            moved.append(replace(image, factor=factor))
    return [*moved, replace(infinity, factor=nmod_poly([0, 1], p))]


def _ordinate(pole: CurvePoint, images: list[CurvePoint]) -> Any:
    """s = 1/(residue * Q') at the roots of a factor of Q."""
    q = pole.factor
    one = q**0
    above = prod((image.factor for image in images if image.e == 2), start=one)
    below = prod((image.factor ** (-(image.e // 2)) for image in images if image.e < 0), start=one)
    residue = pole.residue.numerator * pow(pole.residue.denominator, -1, q.modulus())
    return below * (above.derivative() * residue).xgcd(q)[1] % q

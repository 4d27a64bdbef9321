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
- genus > 0: n = l k, k the order of the divisor of l eta in the Jacobian; if it is infinite, N(T).  Reduction modulo a
  prime of good reduction is injective on torsion, so two different orders prove that k is infinite, and a common order k
  leaves only n = l k, which the invariants of degree 2n (y1^2n + y2^2n, and (y1 y2)^n for even n) confirm or refute.

References: Kovacic 1986, sec. 4; J. H. Davenport, On the Integration of Algebraic Functions (1981), for the torsion test.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from math import lcm
from typing import Any

from flint import fmpz, nmod_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.modular import BadPrimeError, simple_roots, square_root
from kovacic.algebra.poly import Field, Homomorphism, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalField, RationalHomomorphism
from kovacic.algebra.splitting import ExtensionHomomorphism
from kovacic.decision import NoInvariant, SemiInvariant
from kovacic.engine.invariants import invariants
from kovacic.engine.places import Kind as PlaceKind
from kovacic.engine.places import Problem
from kovacic.engine.riccati import residue
from kovacic.errors import LimitExceeded
from kovacic.galois.group import Ground, Group, Kind
from kovacic.galois.jacobian import Jacobian

#: Primes whose orders must agree before the invariants are asked.
_AGREEING_PRIMES = 3
#: The largest order of a divisor that is looked for modulo a prime.
_LARGEST_ORDER = 3000
#: The largest degree of invariants that are computed for the order.
_LARGEST_DEGREE = 600
#: Primes that are tried, beyond which the bad ones are too many.
_PRIMES_TRIED = 400


@dataclass(frozen=True)
class Point:
    """The places over the roots of a factor: the valuation e of g there, and the residue of eta (0 without a pole)."""

    factor: Poly
    e: int
    residue: Fraction


@dataclass(frozen=True)
class Curve:
    """z^2 = g with the points that matter: those with e != 0, infinity apart."""

    points: tuple[Point, ...]
    infinity: Point

    @property
    def genus(self) -> int:
        branched = sum(point.factor.degree for point in (*self.points, self.infinity) if point.e % 2)
        return branched // 2 - 1

    @property
    def residues(self) -> list[Fraction]:
        return [point.residue for point in (*self.points, self.infinity) if point.residue]


def imprimitive_group(problem: Problem, f: SemiInvariant) -> Group:
    """The group of an equation whose semi-invariant f = y1 y2 of degree 2 isn't rational, with two conjugate omegas."""
    singular = [place for place in problem.places if place.kind is not PlaceKind.ORDINARY]
    if any(place.kind is not PlaceKind.REGULAR for place in singular):
        return Group(Kind.INFINITE_DIHEDRAL, Ground.IRREGULAR)
    if any(place.delta is None for place in singular):
        return Group(Kind.INFINITE_DIHEDRAL, Ground.IRRATIONAL_EXPONENT)
    if f.P.field != problem.field:  # three pairs of lines: only the quaternion group has them
        return Group(Kind.DICYCLIC, Ground.INVARIANT, 2)
    curve = curve_of(problem, f)
    l = lcm(1, *(r.denominator for r in curve.residues))  # noqa: E741 - as in the module's text
    if curve.genus == 0:
        return Group(Kind.DICYCLIC, Ground.GENUS_ZERO, l)
    if not curve.residues:
        return Group(Kind.INFINITE_DIHEDRAL, Ground.FIRST_KIND)
    try:
        return _of_positive_genus(problem, f, curve, l)
    except LimitExceeded:
        return Group(Kind.IMPRIMITIVE, Ground.UNDETERMINED, max(l, 2))


def curve_of(problem: Problem, f: SemiInvariant) -> Curve:
    """The valuations of g = f^2 and the residues of eta."""
    R = 2 * (f.theta * problem.D).num
    points = []
    growth = 2 * f.P.degree
    for place in problem.finite_places:
        e = residue(problem, R, place)
        growth += e * place.degree
        if e:
            points.append(Point(place.factor, e, place.delta if e == 2 and place.delta else Fraction(0)))
    if f.P.degree > 0:
        points.append(Point(f.P, 2, Fraction(1)))
    place, e = problem.infinity, 4 - growth
    delta = Fraction(1) if place.kind is PlaceKind.ORDINARY else place.delta
    return Curve(tuple(points), Point(place.factor, e, delta if e == 2 and delta else Fraction(0)))


def _of_positive_genus(problem: Problem, f: SemiInvariant, curve: Curve, l: int) -> Group:  # noqa: E741
    orders: list[int] = []
    for h in _small_homomorphisms(problem.field, max(curve.genus, 1)):
        problem.budget.check()
        try:
            order = _order_modulo(h, problem, f, curve, l)
        except BadPrimeError:
            continue
        if order is None:
            break
        if orders and order != orders[0]:
            return Group(Kind.INFINITE_DIHEDRAL, Ground.NOT_TORSION)
        orders.append(order)
        if len(orders) == _AGREEING_PRIMES:
            break
    least = max(l, 2)
    for k in [orders[0]] if orders else range(1, _LARGEST_DEGREE // (20 * l) + 1):
        n = l * k
        if 2 * n > _LARGEST_DEGREE:
            break
        if (form := form_of_order(problem, f, n)) is not None:
            return Group(Kind.DICYCLIC, Ground.INVARIANT, n, form)
        least = n + l
    else:
        if orders:
            return Group(Kind.INFINITE_DIHEDRAL, Ground.NO_INVARIANT)
    return Group(Kind.IMPRIMITIVE, Ground.UNDETERMINED, least)


def form_of_order(problem: Problem, f: SemiInvariant, n: int) -> SemiInvariant | None:
    """The rational form of degree 2n that a dicyclic group of order 4n, or 4n/j, has beside powers of f = y1 y2.

    For even n the invariants are f^n and y1^(2n) + y2^(2n), for odd n only the latter.  Either answer is proven.
    """
    space = invariants(problem, 2 * n)
    if isinstance(space, NoInvariant) or len(space) != (1 if n % 2 else 2):
        return None
    forms = [SemiInvariant(2 * n, RatFunc(F.R, problem.D), F.P) for F in space]
    power = n * f.logarithmic_derivative
    return next(form for form in forms if form.logarithmic_derivative != power)


def _small_homomorphisms(field: Field, genus: int) -> Iterator[Homomorphism]:
    """Homomorphisms to small prime fields, from p = 5 on; smaller ones first, since orders grow like p^genus."""
    for _, h in zip(range(_PRIMES_TRIED), _homomorphisms(field), strict=False):
        if h.p**genus > 10**7:
            return
        yield h


def _homomorphisms(field: Field) -> Iterator[Homomorphism]:
    if isinstance(field, RationalField):
        yield from (RationalHomomorphism(p) for p in count(5) if fmpz(p).is_prime())
    elif isinstance(field, AlgebraicField):
        for base in _homomorphisms(field.base):
            try:
                modulus = base.keeping_degree(field.modulus)
            except BadPrimeError:
                continue
            yield from (ExtensionHomomorphism(base, root) for root in simple_roots(modulus))


def _order_modulo(h: Homomorphism, problem: Problem, f: SemiInvariant, curve: Curve, l: int) -> int | None:  # noqa: E741
    """The order of the divisor of l eta in the Jacobian modulo p; None if it exceeds the bound."""
    p = h.p
    images = [(h.keeping_degree(point.factor), point) for point in curve.points]
    for _, point in images:
        if point.residue.numerator % p == 0 and point.residue:
            raise BadPrimeError("a residue vanishes")
    if l % p == 0 or curve.infinity.residue.numerator % p == 0 != curve.infinity.residue.numerator:
        raise BadPrimeError("a residue isn't a unit")
    together = nmod_poly([1], p)
    for image, _ in images:
        together = together * image
    if together.gcd(together.derivative()).degree() > 0:
        raise BadPrimeError("points meet")
    w = square_root(_squared_wronskian(h, problem, images), p)
    if not w:
        raise BadPrimeError("w isn't a non-zero number of F_p")
    local, scale = _with_branch_point_at_infinity(images, curve, p)
    # g = scale * branch * Q^2, z^2 = scale * branch: eta = w dx / (z Q), so z = w / (residue * Q') at a pole.
    branch, above, below = nmod_poly([scale], p), nmod_poly([1], p), nmod_poly([1], p)
    for image, e, _ in local:
        if e % 2:
            branch = branch * image
        half = e // 2
        if half > 0:
            above = above * image**half
        elif half < 0:
            below = below * image**-half
    jacobian = Jacobian(branch)
    total = jacobian.zero
    for image, _, value in local:
        if value:
            slope = above.derivative() * _inverse(below, image) % image
            z = _inverse(slope * int(value.numerator * pow(value.denominator, -1, p) % p), image) * w
            total = jacobian.add(total, jacobian.multiple(int(2 * l * value), jacobian.point(image, z)))
    return jacobian.order(total, _LARGEST_ORDER)


def _squared_wronskian(h: Homomorphism, problem: Problem, images: list[tuple[Any, Point]]) -> int:
    """w^2 = g (4 S - 2 phi' - phi^2) modulo p, phi = f'/f, for g the product of the monic factors to their powers."""
    p = h.p
    num, den = h(problem.S.num), h.keeping_degree(problem.S.den)
    for x in range(p):
        if int(den(x)) == 0 or any(int(image(x)) == 0 for image, _ in images):
            continue
        g, phi, slope = 1, 0, 0
        for image, point in images:
            value, first, second = (int(d(x)) for d in (image, image.derivative(), image.derivative().derivative()))
            inverse = pow(value, -1, p)
            half = point.e * pow(2, -1, p)
            g = g * pow(value, point.e, p) % p
            phi += half * first * inverse
            slope += half * (second * inverse - (first * inverse) ** 2)
        S = int(num(x)) * pow(int(den(x)), -1, p)
        return g * (4 * S - 2 * slope - phi * phi) % p
    raise BadPrimeError("every point of F_p is singular")


def _with_branch_point_at_infinity(
    images: list[tuple[Any, Point]], curve: Curve, p: int
) -> tuple[list[tuple[Any, int, Fraction]], int]:
    """The points and the leading coefficient of g in a coordinate t = 1/(x - r) for which t = infinity is a branch point.

    With x = r + 1/t, dx/sqrt(g) = -dt/sqrt(t^4 g(r + 1/t)): the valuations stay, and the old infinity is t = 0.
    """
    if curve.infinity.e % 2:
        return [(image, point.e, point.residue) for image, point in images], 1
    for image, point in images:
        if point.e % 2:
            for r in simple_roots(image):
                return _moved(images, curve, r, p)
    raise BadPrimeError("no branch point is rational modulo this prime")


def _moved(
    images: list[tuple[Any, Point]], curve: Curve, r: int, p: int
) -> tuple[list[tuple[Any, int, Fraction]], int]:
    local, scale = [], 1
    for image, point in images:
        moved = image.compose(nmod_poly([r, 1], p)).reverse()
        lead = int(moved.leading_coefficient())
        scale = scale * pow(lead, point.e, p) % p
        if moved.degree() > 0:
            local.append((moved * pow(lead, -1, p), point.e, point.residue))
    if curve.infinity.e:
        local.append((nmod_poly([0, 1], p), curve.infinity.e, curve.infinity.residue))
    return local, scale


def _inverse(value: Any, modulus: Any) -> Any:
    common, inverse, _ = (value % modulus).xgcd(modulus)
    if common.degree() != 0:
        raise BadPrimeError("not invertible modulo this prime")
    return inverse * pow(int(common[0]), -1, modulus.modulus()) % modulus

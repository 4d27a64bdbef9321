"""A function with a given divisor on a hyperelliptic curve, as a product of a few small ones (Miller's doubling).

eta = sqrt(H) dx has simple poles with the rational residues +-Delta on the curve y^2 = h, h the squarefree part of H; l is the
common denominator of the Delta, and D = sum l Delta (P - P') with P where the residue is +Delta and P' its conjugate.  The
question is whether k D is the divisor of a function f, and whether df/f = k l eta then.

- The coordinate t, x = r + 1/t, is chosen with H(r) not a square: then the two points at t = infinity are conjugate over the
  field, every function has the same order at both, and E -> [E - (deg E/2) (both)] turns effective divisors E of an even
  degree into classes.  All poles of eta are at finite points.
- E is represented by (u, v): u(t) = 0 and y = v(t) at its points [Mumford].  A function a - b y vanishes on E if a = b v
  modulo u.  Euclid's algorithm for u and v has those of the least max(deg a, deg b + deg h/2); where they are more than the
  multiples of one, the shortest is taken, which keeps the coefficients small.  Its other zeros are those of (a^2 - h b^2)/u,
  deg h/2 at most; the conjugates of these have the class of E.
- From the leading binary digit of the N_P = 2 k l Delta on, E is doubled, the P whose digit is 1 are added, and the sum is
  replaced by a small divisor of its class.  The functions a - b y, each to the power of two by which it is doubled later, are
  the pieces of f; k D is principal exactly if nothing is left at the end.

References: V. Miller, J. Cryptology 17 (2004) 235-261, for the doubling; D. Cantor, Math. Comp. 48 (1987) 95-101, for the sum
of divisors.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any, NamedTuple

from flint import fmpq_mat, fmpz_mat

from kovacic.algebra.embedding import padded_coordinates
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.modular import integers_by_size
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.decision import CurveFunction, Piece
from kovacic.engine.places import rational_square_root
from kovacic.limits import check_time

#: Bits of a coefficient beyond which a class is taken for one of infinite order.
_LARGEST_HEIGHT = 50_000


class Divisor(NamedTuple):
    """The points over the roots of u, with y = v there: an effective divisor without two conjugate points.

    Over a field, or modulo a prime.
    """

    u: Any
    v: Any

    def plus(self, other: Divisor, h: Any) -> Divisor:
        """The sum of two divisors on y^2 = h, without pairs of conjugate points [Cantor]."""
        u1, v1 = self
        u2, v2 = other
        d, e1, e2 = u1.xgcd(u2)
        d, c1, c2 = d.xgcd(v1 + v2)
        u = u1 * u2 // (d * d)
        v = (c1 * e1 * u1 * v2 + c1 * e2 * u2 * v1 + c2 * (v1 * v2 + h)) // d % u
        return Divisor(u, v)


@dataclass(frozen=True)
class Model:
    """eta = s y dt on y^2 = h(t), x = r + 1/t, and its poles with their positive residues."""

    r: int
    h: Poly
    s: RatFunc
    poles: tuple[tuple[Divisor, Fraction], ...]

    @property
    def half(self) -> int:
        """The order of the pole of y at both points at infinity: the genus and 1."""
        return self.h.degree // 2


def function_of_order(H: RatFunc, k: int) -> CurveFunction | None:
    """f with the divisor k D, and the holomorphic rest of k l sqrt(H) dx - df/f; None if k D isn't principal.

    Also None if the coefficients become too long for a torsion class, whose coefficients stay short.
    """
    model = model_of(H)
    l = lcm(*(residue.denominator for _, residue in model.poles))  # noqa: E741 - as in the module's text
    # k D = sum k l Delta (P - P') has the class of sum 2 k l Delta P, since P + P' is principal up to infinity.
    multiples = [int(2 * k * l * residue) for _, residue in model.poles]
    pieces = _doubled(model, multiples)
    if pieces is None:
        return None
    slope = RatFunc(H.field.zero)
    for piece in pieces:
        slope = slope + logarithmic_slope(piece.a, piece.b, model.h) * piece.exponent
    rest = model.s * model.h * (k * l) - slope
    assert rest.is_polynomial
    return _in_x(model, CurveFunction(k * l, model.h, tuple(pieces), rest.num))


def logarithmic_slope(a: Poly, b: Poly, h: Poly) -> RatFunc:
    """R with R dx/y the odd part of d log(a + b y): half of d log of its quotient by the conjugate."""
    odd = (b.derivative() * h + b * h.derivative() / 2) * a - a.derivative() * b * h
    return RatFunc(odd, a * a - h * b * b)


def model_of(H: RatFunc) -> Model:
    """The curve in a coordinate in which the points at infinity aren't rational, and the poles of eta."""
    field = H.field
    # The first of 0, 1, -1, 2, ... at which H(r) is a number, not 0, without a root in the field.
    for r in integers_by_size():
        above = H.num(field.poly([r]))
        below = H.den(field.poly([r]))
        if above and below and field.sqrt(above * below) is None:
            break
    shifted = [f(field.poly([r, 1])) for f in (H.num, H.den)]
    top = max(f.degree for f in shifted)
    num, den = (f.reversed(top - f.degree) for f in shifted)
    t = field.x
    moved = RatFunc(num, den * t**4)  # dx = -dt/t^2
    h, s = _squarefree_part(moved)
    double = [q for q, multiplicity in field.factor(moved.den) if multiplicity == 2]
    return Model(r, h, s, tuple(_pole_over(moved, h, s, q) for q in double))


def _squarefree_part(H: RatFunc) -> tuple[Poly, RatFunc]:
    """h and s with H = h s^2, h squarefree."""
    field = H.field
    h = H.num.lc
    s = RatFunc(field.one)
    for f, sign in ((H.num, 1), (H.den, -1)):
        for q, multiplicity in field.factor(f):
            odd = multiplicity % 2
            h = h * q**odd
            s = s * RatFunc(q) ** ((sign * multiplicity - odd) // 2)
    return h, s


def _pole_over(H: RatFunc, h: Poly, s: RatFunc, q: Poly) -> tuple[Divisor, Fraction]:
    """The point over the roots of q at which s y dt has a positive residue, and the residue: y = residue q'/(s q) there."""
    regular = s * q
    y = q.derivative() * regular.den * regular.num.inverse_modulo(q) % q  # for the residue 1
    square = H.field.rational_value(h % q * (y * y % q).inverse_modulo(q) % q)
    assert square is not None
    residue = rational_square_root(QQ.poly([square]))
    assert residue
    # y is proportional to the residue.
    return Divisor(q, y * residue), residue


def _in_x(model: Model, f: CurveFunction) -> CurveFunction:
    """The function in the coordinate x: t = 1/(x - r), y(t) = y(x)/(x - r)^half, dt = -dx/(x - r)^2."""
    half = model.half
    shift = f.h.field.poly([-model.r, 1])

    def cleared(polynomial: Poly, degree: int) -> Poly:
        """(x - r)^degree times the polynomial in t."""
        return polynomial.reversed(degree - polynomial.degree)(shift) if polynomial else polynomial

    pieces = []
    for piece in f.pieces:
        degree = max(piece.a.degree, piece.b.degree + half)
        pair = cleared(piece.a, degree), cleared(piece.b, degree - half)
        pieces.append(Piece(piece.exponent, *f.h.field.ground.cleared(*pair)))
    return CurveFunction(f.multiple, cleared(f.h, 2 * half), tuple(pieces), -cleared(f.rest, half - 2))


def _doubled(model: Model, multiples: list[int]) -> list[Piece] | None:
    """The pieces of a function with the divisor sum N_P P, up to functions of x alone; None if none was found."""
    one = model.h.field.one
    total = Divisor(one, one * 0)
    pieces: list[Piece] = []
    for digit in reversed(range(max(multiples).bit_length())):
        check_time()
        total = total.plus(total, model.h)
        for (points, _), N in zip(model.poles, multiples, strict=True):
            if N >> digit & 1:
                total = total.plus(points, model.h)
        # total - (a smaller divisor) is that of a - b y, up to points at infinity and functions of t.
        total, found = _small_divisor(model, total)
        if total.u.height_bits() > _LARGEST_HEIGHT:
            return None
        if found is not None:
            pieces.append(Piece(2**digit, *found))  # it is doubled `digit` times from now on
    return None if total.u.degree else pieces


def _small_divisor(model: Model, E: Divisor) -> tuple[Divisor, tuple[Poly, Poly] | None]:
    """A divisor of the class of E, of degree deg h/2 at most, and (a, b) of the function a + b y that shows it."""
    if E.u.degree <= model.half:
        return E, None
    a, b = _least_function(model, E)
    common = a.gcd(b)  # points of E that are left as they are
    a = a // common
    b = b // common
    others = ((a * a - model.h * b * b) // (E.u // common)).monic()
    ordinate = others * 0
    if others.degree:
        ordinate = -a * b.inverse_modulo(others) % others
    conjugate = Divisor(others, ordinate)
    return conjugate.plus(Divisor(common, E.v % common), model.h), (a, -b)


def _least_function(model: Model, E: Divisor) -> tuple[Poly, Poly]:
    """(a, b) with a = b v modulo u, of the least max(deg a, deg b + deg h/2), and short."""
    first = E.u, E.u * 0
    for second in remainders(E.v, E.u):
        before = first[0].degree
        after = second[1].degree + model.half
        if second[0].degree <= after:
            break
        first = second
    if before == after:
        return _shortest_pair(first, second)
    return model.h.field.ground.cleared(*(first if before < after else second))


def remainders(v: Poly, u: Poly) -> Iterator[tuple[Poly, Poly]]:
    """(a, b) with a = b v modulo u, without end and of falling degrees of a: those of Euclid's algorithm."""
    before = u, u * 0
    a, b = v % u, u * 0 + 1
    while True:
        yield a, b
        scale = a.lc.inverse()  # else the coefficients become long
        a, b = a * scale, b * scale
        quotient, rest = divmod(before[0], a)
        before, (a, b) = (a, b), (rest, before[1] - quotient * b)


def _shortest_pair(first: tuple[Poly, Poly], second: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
    """A short one of the pairs c first + d second; over a field with parameters, simply the first one.

    The pairs with integral coordinates are a lattice, which LLL reduces.  It is M' = T^-1 M, where the rows of M are
    such pairs, and T has a basis of the lattice that the columns of M generate.
    """
    field = first[0].field
    if field.ground != QQ:
        return field.ground.cleared(*first)
    basis = [field.ground.cleared(a * c, b * c) for a, b in (first, second) for c in _power_basis(field)]
    length = field.absolute_degree * (1 + max(max(a.degree, b.degree) for a, b in basis))
    M = fmpz_mat([[int(c.p) for part in pair for c in padded_coordinates(part, length)] for pair in basis])
    size = len(basis)
    columns = M.transpose().hnf()
    T = fmpz_mat([[columns[j, i] for j in range(size)] for i in range(size)])
    saturated = (fmpq_mat(T).inv() * fmpq_mat(M)).numer_denom()[0]
    rows, change = saturated.lll(transform=True)
    squares = [sum(int(c) ** 2 for c in row) for row in rows.tolist()]
    shortest = squares.index(min(squares))
    factors = (fmpq_mat(change) * fmpq_mat(T).inv()).tolist()[shortest]
    a = b = first[0] * 0
    for factor, pair in zip(factors, basis, strict=True):
        scale = to_fraction(factor)
        a = a + pair[0] * scale
        b = b + pair[1] * scale
    return a, b


def _power_basis(field: Field) -> list[Poly]:
    """A basis over Q of a number field, as constants."""
    if not isinstance(field, AlgebraicField):
        return [field.one]
    below = [field.embed(c) for c in _power_basis(field.base)]
    return [c * field.generator**k for k in range(field.dimension) for c in below]

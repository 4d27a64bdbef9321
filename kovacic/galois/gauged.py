"""The differential Galois group of the equation as given: solutions z = gamma y with y'' = S y, gamma'/gamma = rho.

The group lies in GL2.  It consists of the products chi g of the elements (g, chi) of the joint group H of the y and of
gamma, a subgroup of G x Gamma, where G is the group of the normal form and Gamma = mu_N or G_m that of gamma.

- Reducible: the diagonal characters belong to lambda_1 = rho + omega and lambda_2 = rho - omega.  With the lattice
  L = {(a, b) : a lambda_1 + b lambda_2 is the logarithmic derivative of a rational function} they form the diagonalisable
  group with the characters Z^2/L; a unipotent part is unchanged.
- Imprimitive and finite on a curve of genus 0: likewise with the residues on the curve z^2 = g of `imprimitive`, where every
  divisor of degree 0 is principal; the diagonal part has index 2.
- Imprimitive and finite on a curve of positive genus: see `_order_on_curve`.
- N(T): see `_infinite_dihedral`.
- Primitive: |group| = |G| N/(e k), e the degree of the largest common quotient of G and Gamma (at most 3, 2, 1 for SL(2,3),
  the binary octahedral group, SL(2,5): the semi-invariant of Kovacic's degree decides it), and k = 2 if (-1, -1) lies in H.
- SL2: with scalars mu_N, or GL2.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import zip_longest
from math import gcd, lcm, prod
from typing import Any, NamedTuple

from kovacic.algebra.extension import adjoined_square_root
from kovacic.algebra.factors import product, squarefree_factors
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.decision import CurveFunction, Decision, SemiInvariant
from kovacic.engine.places import analyse
from kovacic.galois.decide import residues_or_ground
from kovacic.galois.group import Ground, Group, GroupKind
from kovacic.galois.imprimitive import SquareRootCurve, square_root_curve
from kovacic.limits import Budget

_COMMON_QUOTIENT = {GroupKind.TETRAHEDRAL: 3, GroupKind.OCTAHEDRAL: 2, GroupKind.ICOSAHEDRAL: 1}


class Torus(NamedTuple):
    """A diagonalisable group: its name, and its order, None if it is infinite."""

    name: str
    order: int | None

    @classmethod
    def of(cls, rank: int, *orders: int) -> Torus:
        """G_m^rank times the groups of roots of unity of these orders."""
        parts = ["G_m"] * rank + [f"mu_{n}" for n in orders if n > 1]
        order = None if rank else prod(orders)
        return cls(" x ".join(parts) or "trivial", order)


@dataclass(frozen=True)
class EquationGroup:
    """The group of the equation as given, in GL2(C).

    Attributes
    ----------
    normal_form : Group
        That of the normal form, in SL2(C).
    scalars : int or None
        N for a gauge factor whose N-th power is the first rational one, None if there is none.
    name : str
        In plain characters.
    finite : bool or None
        None if that wasn't determined.
    order : int or None
        None if the group is infinite (`finite` False) or its order wasn't determined (`finite` True or None).

    Examples
    --------
    >>> import kovacic
    >>> kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0").equation_group
    <EquationGroup G_m>
    """

    normal_form: Group
    scalars: int | None
    name: str
    finite: bool | None
    order: int | None = None

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<EquationGroup {self.name}>"


def equation_group(S: RatFunc, decision: Decision, normal_form: Group, rho: RatFunc) -> EquationGroup | None:
    """The group of the equation with the gauge rho; None over a field with parameters if rho isn't zero."""
    if rho and S.field.ground != QQ:
        return None
    residues = residues_or_ground(rho)
    # The order of the gauge's own group; None if it is infinite.
    N = None if isinstance(residues, Ground) else lcm(1, *(residue.denominator for residue in residues))
    kind = normal_form.kind
    f = decision.semi_invariant
    if N == 1:
        return EquationGroup(normal_form, 1, normal_form.name, normal_form.finite, normal_form.order)
    if kind is GroupKind.SL2:
        name = "GL2"
        if N is not None:  # -1 lies in SL2
            name = "SL2" if N == 2 else f"SL2 with the scalars mu_{lcm(2, N)}"
        return EquationGroup(normal_form, N, name, False)
    if kind in (GroupKind.ADDITIVE, GroupKind.BOREL):
        known = f or decision.series
        assert known is not None
        torus = _torus(*_lattice_forms(known.theta, rho))
        name = "G_a" if torus.order == 1 else f"G_a extended by {torus.name}"
        return EquationGroup(normal_form, N, name, False)
    assert f is not None
    if kind in (GroupKind.CYCLIC, GroupKind.MULTIPLICATIVE):
        torus = _torus(*_lattice_forms(f.theta, rho))
        return EquationGroup(normal_form, N, torus.name, torus.order is not None, torus.order)
    if N is None:
        return EquationGroup(normal_form, N, f"{normal_form.name} with the scalars G_m", False)
    if kind is GroupKind.INFINITE_DIHEDRAL:
        return EquationGroup(normal_form, N, _infinite_dihedral(N, f, rho), False)
    return _finite_gauge(S, normal_form, f, rho, N)


def _finite_gauge(S: RatFunc, normal_form: Group, f: SemiInvariant, rho: RatFunc, N: int) -> EquationGroup:
    """The group for a gauge of order N > 1 and an irreducible normal form whose group may be finite."""
    given = normal_form.name
    order = _finite_order(S, normal_form, f, rho, N)
    if order is None:
        return EquationGroup(normal_form, N, f"{given} with scalars", normal_form.finite)
    # Where gamma^2/f is rational, the determinant is -1 on the elements that exchange lines, else 1: so these are involutions.
    # Of the two groups of order 8 that aren't commutative, only the quaternion group has determinant 1.
    is_dihedral = normal_form.kind is GroupKind.DICYCLIC and (order == 8 or _is_integral(rho * 2 - f.theta))
    if N == 2:  # it is isomorphic to that of the normal form, with determinant 1
        name = f"{given}, twisted by signs"
    elif is_dihedral:
        name = "S3" if order == 6 else f"dihedral of order {order}"
    else:
        name = f"{given} with scalars, order {order}"
    return EquationGroup(normal_form, N, name, normal_form.finite, order)


def _infinite_dihedral(N: int, f: SemiInvariant, rho: RatFunc) -> str:
    """The name of T mu_n with a coset: n = N, or N/2 if gamma^(N/2)/f is rational; the scalars in it are mu_lcm(2, n).

    T is connected, so that over C(x, f) it and gamma are independent.  In the second case the coset is that of w zeta, w in
    N(T) of square -1 and zeta of order N; it makes a difference where zeta isn't in mu_lcm(2, n): (w zeta)^2 = 1 for N = 4.
    """
    # gamma^(N/2)/f rational: the characters of gamma and of f, which is -1 on the coset, agree to the power N/2.
    twisted = N % 4 == 0 and _is_integral(rho * (N // 2) - f.theta)
    if twisted:
        return "O(2)" if N == 4 else f"N(T) with the scalars mu_{N // 2}, twisted"
    return "N(T)" if N == 2 else f"N(T) with the scalars mu_{lcm(2, N)}"


def _finite_order(S: RatFunc, group: Group, f: SemiInvariant, rho: RatFunc, N: int) -> int | None:
    """The order of the group for a finite gauge of order N > 1 and a finite irreducible normal form."""
    if group.order is None:
        return None
    if group.kind in _COMMON_QUOTIENT:
        # The quotient of degree e is common if f has the same character as gamma to a power of the order e.
        e = _COMMON_QUOTIENT[group.kind]
        powers = [j * (N // e) for j in range(1, e + 1) if gcd(j, e) == 1]
        if N % e or not any(_is_integral(power * rho - f.theta) for power in powers):
            e = 1
        common = e if (N // e) % 2 else 2 * e  # with -1, which is in both
        return group.order * N // common
    if N == 2:  # the sign is a character of G that is trivial at -1, or independent of it
        return group.order
    if N % 2:
        return group.order * N
    if f.P.field != S.field:
        return None
    curve = square_root_curve(analyse(S, Budget()), f)
    if curve.genus > 0:
        return _order_on_curve(group, f, rho, N)
    order = _torus([], _residues_on_curve(curve, rho)).order
    return order and 2 * order


def _order_on_curve(group: Group, f: SemiInvariant, rho: RatFunc, N: int) -> int | None:
    """The order for an even N and a dicyclic group of order 4n on a curve of positive genus, by the function u^n.

    Over the field K of the curve y1 has the order 2n and gamma an order M, N or N/2.  If gamma^i y1^j lies in K, so does
    gamma^i y2^j, since the conjugation of the curve leaves gamma alone; hence u^j and gamma^(2i), and j = n, i = M/2.  So the
    diagonal part of H has the order 2 n M, or half of that if y1^(2n) gamma^M = f^n u^n gamma^M is a square in K.  Here f^2
    is rational: with an odd power of f the norm would be that of y, which is no square.
    """
    function = group.function
    n = group.n
    if function is None or n is None or function.rest:
        return None
    is_in_K = _is_integral(rho * (N // 2) - f.theta)  # gamma^(N/2)/f is rational
    M = N // 2 if is_in_K else N
    if M % 2:
        return 4 * n * M  # nothing in common, and (-1, -1) isn't in H
    coincide = False
    if (n + is_in_K) % 2 == 0:
        rational = rho * M - f.theta if is_in_K else rho * M
        factors = [part.factor for part in decompose(rational).residues if (part.rational or 0) % 2]
        coincide = _is_square_on_curve(*_up_to_squares(function, [*factors, f.P] if is_in_K else factors), function.h)
    order = 4 * n * M // (2 if coincide else 1)  # of H
    # (zeta, chi) in the diagonal part satisfy zeta^n chi^(M/2) = 1 if they coincide; (-1, -1) does if n + M/2 is even.
    has_minus_one = not coincide or (n + M // 2) % 2 == 0
    return order // 2 if has_minus_one else order


def _up_to_squares(function: CurveFunction, factors: Sequence[Poly]) -> tuple[Poly, Poly]:
    """A and B with A + B y a constant times a square times u^n and the factors.

    u^n = prod (a + b y)^e/(G prod N^(e//2)), N the norms a^2 - h b^2, G^2 the product of those with an odd e, up to a constant.
    """
    h = function.h
    A = h**0
    B = A * 0
    of_odd = h**0
    for piece in function.pieces:
        norm = piece.a * piece.a - h * piece.b * piece.b
        if piece.exponent // 2 % 2:
            A, B = A * norm, B * norm
        if piece.exponent % 2:
            of_odd = of_odd * norm
            A, B = A * piece.a + B * piece.b * h, A * piece.b + B * piece.a
    rational = product([h**0, *factors, *(part for part, k in squarefree_factors(of_odd) if k // 2 % 2)])
    return A * rational, B * rational


def _is_square_on_curve(A: Poly, B: Poly, h: Poly) -> bool:
    """True if A + B y on the curve y^2 = h is a square, up to a constant.

    The norm A^2 - h B^2 of a square is the square of some m, and 2 (A + m) (A + B y) = (A + m + B y)^2; so it is one exactly
    if A + m is a square on the curve, which for a rational function is the square of a rational function, or h times one.
    """
    rational = A
    if B:
        norm = A * A - h * B * B
        parts = squarefree_factors(norm)
        if any(k % 2 for _, k in parts):
            return False
        root = adjoined_square_root(norm.field, norm.lc)
        rational = A.over(root.field) + product([root, *((part ** (k // 2)).over(root.field) for part, k in parts)])
    return any(all(k % 2 == 0 for _, k in squarefree_factors(F)) for F in (rational, rational * h.over(rational.field)))


def _is_integral(theta: RatFunc) -> bool:
    """True if exp(int theta) is a rational function: simple poles with integer residues only."""
    residues = residues_or_ground(theta)
    return not isinstance(residues, Ground) and all(r.denominator == 1 for r in residues)


def _residues_on_curve(curve: SquareRootCurve, rho: RatFunc) -> list[tuple[Fraction, Fraction]]:
    """The residues of lambda_1 and lambda_2 at the points of the curve, up to integers."""
    residues = {part.factor: part.rational or Fraction(0) for part in decompose(rho).residues}
    total = sum((r * factor.degree for factor, r in residues.items()), Fraction(0))
    rows: list[tuple[Fraction, Fraction]] = []

    def add(e: int, delta: Fraction, r: Fraction) -> None:
        """Add the residues over a point: 2 (e/4 + r) at a branch point, else e/4 + r at two, with +-delta/2 if e = 2."""
        middle = (Fraction(e, 4) + r) * (1 + e % 2)
        apart = delta / 2 if e == 2 else Fraction(0)
        rows.extend((middle + sign * apart, middle - sign * apart) for sign in (1, -1))

    for point in curve.points:
        for factor, _ in rho.field.factor(point.factor.over(rho.field)):
            add(point.e, point.residue, residues.pop(factor, Fraction(0)))
    for r in residues.values():
        add(0, Fraction(0), r)
    add(curve.infinity.e, curve.infinity.residue, -total)
    return rows


def _lattice_forms(
    theta: RatFunc, rho: RatFunc
) -> tuple[list[tuple[Fraction, Fraction]], list[tuple[Fraction, Fraction]]]:
    """Linear forms in (a, b) that must vanish, and those that must be integers, for a lambda_1 + b lambda_2 to be in L."""
    zero = theta * 0 + rho * 0
    pair = [decompose(zero + rho + theta), decompose(zero + rho - theta)]
    den = product([part.exact.den for part in pair])
    vanishing = _rational_coordinates([part.exact.num * (den // part.exact.den) for part in pair])
    integral: list[tuple[Fraction, Fraction]] = []
    residues = [{residue.factor: residue.value for residue in part.residues} for part in pair]
    for factor in residues[0] | residues[1]:
        constant, *rest = _rational_coordinates([part.get(factor, factor * 0) for part in residues])
        integral.append(constant)
        vanishing += rest
    return vanishing, integral


def _rational_coordinates(pair: Sequence[Any]) -> list[tuple[Fraction, Fraction]]:
    """The rational coordinates of two polynomials, side by side; that of the constant 1 comes first."""
    first, second = (map(to_fraction, part.rational_coefficients()) for part in pair)
    return list(zip_longest(first, second, fillvalue=Fraction(0)))


def _torus(vanishing: Iterable[tuple[Fraction, Fraction]], integral: Sequence[tuple[Fraction, Fraction]]) -> Torus:
    """The diagonalisable group with the characters Z^2/L, L = {(a, b) : the first forms vanish, the others are integers}."""
    rows = [row for row in vanishing if any(row)]
    if not rows:
        n = lcm(1, *(value.denominator for row in integral for value in row))
        matrix = [(int(r * n), int(s * n)) for r, s in integral] + [(n, 0), (0, n)]
        # The entries have no common factor, n being the least common denominator: the elementary divisors are 1 and the gcd
        # of the minors.
        minors = gcd(*(r[0] * s[1] - r[1] * s[0] for k, r in enumerate(matrix) for s in matrix[:k]))
        return Torus.of(0, n // minors, n)
    p, q = rows[0]
    if any(p * s != q * r for r, s in rows):
        return Torus.of(2)
    a, b = (-q / p).as_integer_ratio() if p else (1, 0)  # p a + q b = 0
    return Torus.of(1, lcm(1, *((r * a + s * b).denominator for r, s in integral)))

"""Local data of y'' = S y: the singular places, their exponents, and Kovacic's necessary conditions.

Conjugate poles are never separated: one irreducible factor p of the denominator stands for all of its roots.  Infinity is
treated as the pole z = 0 of the equation that v(z) = y(1/z) z satisfies, v'' = S_inf(z) v with S_inf(z) = S(1/z)/z^4, so
that one set of formulas serves for every place: with k the order of the pole,

- k = 0 at infinity: an ordinary point;
- k = 1: exponents 0 and 1, and a logarithm;
- k = 2, S = b/t^2 + ...: exponents (1 +- Delta)/2 with Delta^2 = 1 + 4b; a logarithm if Delta = 0, and possibly if Delta is a
  positive integer;
- k >= 3: irregular; ramified for odd k, two exponential parts of opposite signs for even k.

Kovacic's necessary conditions and sharper ones follow from these data alone.  The group contains the local monodromies and
exponential tori, so that
- a ramified irregular place leaves no omega in C(x);
- a logarithm gives a unipotent element, which no imprimitive irreducible and no finite group has;
- the square root that an imprimitive group adjoins has at least two branch points, where the local group exchanges the two
  lines: there Delta is half an odd integer, or the place is irregular and ramified;
- an irregular place gives an infinite group;
- the order of a local monodromy in PGL2 is the denominator of Delta, and the orders in A4, S4, A5 are 1 to 3, 1 to 4, and
  1, 2, 3, 5; A4 and A5 don't contain S4's elements of order 4, and 5 occurs in A5 alone.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), section 2.1; the sharper conditions follow from the facts above.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import isqrt
from typing import Any

from flint import nmod_poly

from kovacic.algebra.factors import expansions, product
from kovacic.algebra.homomorphism import BadPrimeError
from kovacic.algebra.modular import series_solution, simple_roots, translate
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.compatibility import cached_property
from kovacic.decision import NecessaryCondition, Rule, Structure
from kovacic.limits import Budget


class Kind(Enum):
    """The local type of an equation at a place."""

    ORDINARY = "ordinary point"
    REGULAR = "regular singular point"
    UNRAMIFIED = "irregular singular point, unramified"
    RAMIFIED = "irregular singular point, ramified"


@dataclass(frozen=True)
class Place:
    """All roots of one irreducible factor, or infinity (the root 0 in the coordinate z = 1/x).

    `num/den` is S in the coordinate of `factor`, and `order` the multiplicity of `factor` in den.  `near` has N and q with
    S = N/(factor^order q) to as many terms as the exponents depend on, order/2 or 1.
    """

    factor: Poly
    at_infinity: bool
    order: int
    num: Poly
    den: Poly
    near: tuple[Poly, Poly]
    budget: Budget

    @cached_property
    def delta_squared(self) -> Poly | None:
        """The square of the exponent difference Delta unless the place is irregular, if it is the same in K at all roots.

        For a double pole Delta^2 = 1 + 4b, b = N/(p'^2 q) in K[x]/p.  None elsewhere; then Delta is irrational.
        """
        p = self.factor
        (top, bottom) = self.near
        if self.order != 2:
            return p.field.one if self.order < 2 else None
        if p.degree > 1:
            bottom = p.derivative() ** 2 * bottom % p
        b = top[bottom.degree] / bottom.lc
        return 4 * b + 1 if p.degree == 1 or top == bottom * b else None

    @property
    def difference_squared(self) -> Poly:
        """Delta^2 in K[x]/p at a place that is regular or ordinary: a function of the root where it isn't the same at all."""
        if self.delta_squared is not None:
            return self.delta_squared
        p = self.factor
        (top, bottom) = self.near
        return (1 + 4 * top * (p.derivative() ** 2 * bottom % p).inverse_modulo(p)) % p

    def unit(self, precision: int) -> Poly:
        """V modulo p^precision, for S = V/p^order."""
        power = self.factor**precision
        return self.num * (self.den // self.factor**self.order).inverse_modulo(power) % power

    @cached_property
    def delta(self) -> Fraction | None:
        """Delta >= 0 at a regular or ordinary place where it is rational, else None."""
        square = self.delta_squared
        return None if square is None else rational_square_root(square)

    @cached_property
    def logarithm(self) -> bool:
        """True if a logarithm provably occurs; False says only that no proof was found.

        For Delta > 0 the series with the smaller exponent meets an obstruction at its term number Delta.  If it doesn't vanish
        modulo a prime, it doesn't vanish; if it does vanish, nothing is claimed (and then there is a logarithm only by a
        chance of about 1 in 2^60).  Nothing is claimed either where the series would be longer than the limits allow; but the
        terms of t^2 y'' = (M_0 + M_d t^d) y are multiples of those d places before, and obstructed exactly if d divides Delta.
        """
        if self.order != 2 or (delta := self.delta) is None or delta.denominator > 1:
            return self.order == 1
        n = delta.numerator
        if n > 0 and self.den.degree == 2:
            M = self.num(self.factor.field.poly([-self.factor[0], 1]))
            powers = [k for k in range(1, M.degree + 1) if M[k]]
            if len(powers) < 2:
                return bool(powers) and n % powers[0] == 0
        if not 0 < n <= self.budget.limits.unknown_degree:
            return n == 0
        for h in self.factor.field.homomorphisms():
            self.budget.check()
            try:
                root = next(simple_roots(h.keeping_degree(self.factor)), None)
                if root is not None:
                    num, den = translate(h(self.num), root), translate(h.keeping_degree(self.den), root)
                    equation = local_equation(num, den, 2)
                    return logarithm_obstruction(equation, n) != 0
            except BadPrimeError:
                pass
        raise AssertionError("the sequence of primes is infinite")

    @property
    def degree(self) -> int:
        """The number of points of the Riemann sphere that the place stands for."""
        return self.factor.degree

    @cached_property
    def name(self) -> str:
        """The factor as a text, or "infinity"."""
        return "infinity" if self.at_infinity else str(self.factor)

    @cached_property
    def kind(self) -> Kind:
        if self.order == 0:
            return Kind.ORDINARY
        if self.order <= 2:
            return Kind.REGULAR
        return Kind.RAMIFIED if self.order % 2 else Kind.UNRAMIFIED

    @property
    def weight(self) -> int:
        """The order of the pole that omega = y'/y can have: ceil(order / 2), at least 1 except at an ordinary point."""
        return (self.order + 1) // 2

    @property
    def is_apparent(self) -> bool:
        """True if all solutions look alike here up to a sign: an integer exponent difference, and no logarithm found."""
        return self.delta is not None and self.delta.denominator == 1 and not self.logarithm

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Problem:
    """y'' = S y with its local data: `places` has the finite ones first and ends with infinity, ordinary or not.

    D is the product of the finite factors to the power of their weights, so that D * omega has no pole at a singular point,
    and T = S * D^2 is a polynomial.
    """

    S: RatFunc
    places: tuple[Place, ...]
    budget: Budget

    @property
    def field(self) -> Field:
        return self.S.field

    @property
    def finite_places(self) -> tuple[Place, ...]:
        return self.places[:-1]

    @property
    def infinity(self) -> Place:
        return self.places[-1]

    @cached_property
    def D(self) -> Poly:
        return product([self.field.one, *(place.factor**place.weight for place in self.finite_places)])

    @cached_property
    def T(self) -> Poly:
        return self.S.num * (self.D * self.D // self.S.den)


def analyse(S: RatFunc, budget: Budget) -> Problem:
    """The singular places of y'' = S y and their local data."""
    factors = S.field.factor(S.den)
    num, den, order = at_infinity(S)
    infinity = (S.field.x, order)
    places = []
    for above, below, found, at_end in ((S.num, S.den, factors, False), (num, den, [infinity], True)):
        for (p, k), near in zip(found, expansions(above, below, found), strict=True):
            places.append(Place(p, at_end, k, above, below, near, budget))
    return Problem(S, tuple(places), budget)


def at_infinity(S: RatFunc) -> tuple[Poly, Poly, int]:
    """Numerator and denominator of S(1/z)/z^4, and the order of its pole at z = 0."""
    field = S.field
    if not S.num:
        return S.num, field.one, 0
    order = S.degree + 4
    return S.num.reversed(max(-order, 0)), S.den.reversed(max(order, 0)), max(order, 0)


def rational_square_root(constant: Poly) -> Fraction | None:
    """The non-negative rational square root of a constant of the field, or None."""
    value = constant.field.rational_value(constant)
    if value is None:
        return None
    above, below = value.as_integer_ratio()
    if above < 0:
        return None
    root = isqrt(above), isqrt(below)
    return Fraction(*root) if root[0] ** 2 == above and root[1] ** 2 == below else None


@dataclass(frozen=True)
class LocalEquation:
    """y'' = N / (t^(2 nu) E) y modulo p near t = 0, E(0) != 0: omega has a pole of order nu."""

    N: Any
    E: Any
    nu: int

    @property
    def p(self) -> int:
        return int(self.E.modulus())

    def expanded(self, order: int) -> LocalEquation:
        """The equation to `order` terms, with E = 1 if E is long: a term of a solution takes one scalar product, not three."""
        if 6 * self.E.degree() <= order:
            return self
        size = order + 2 * self.nu
        return LocalEquation(self.N.mul_low(self.E.inverse_series_trunc(size), size), self.E**0, self.nu)


def local_equation(num: Any, den: Any, order: int) -> LocalEquation:
    """y'' = num/den y modulo p, with a pole of this order at t = 0.  Raises `BadPrimeError` if it has another order."""
    if not den[order]:
        raise BadPrimeError("the order of a pole changes")
    return LocalEquation(num.left_shift(order % 2), den.right_shift(order), (order + 1) // 2)


def reduced_equation(equation: LocalEquation, Q: Any) -> tuple[Any, Any, Any]:
    """The polynomial coefficients of `u''`, `u'`, `u` after y = exp(int Q/t^nu) u.

    t^nu E u'' + 2 E Q u' + V u = 0 with t^nu V = E (t^(2 nu) (Q/t^nu)' + Q^2) - N.
    """
    nu = equation.nu
    E = equation.E
    derivative = Q.derivative().left_shift(nu) - (Q * nu).left_shift(nu - 1)
    rest = E * (derivative + Q * Q) - equation.N
    if any(int(rest[i]) for i in range(nu)):
        raise BadPrimeError("the exponential part doesn't solve the equation to leading order")
    return E.left_shift(nu), E * Q * 2, rest.right_shift(nu)


def logarithm_obstruction(equation: LocalEquation, delta: int) -> int:
    """The term of order delta that the series with exponent (1 - delta)/2 can't compensate, modulo p."""
    p = equation.p
    alpha = (1 - delta) * pow(2, -1, p)
    needed = LocalEquation(equation.N.truncate(delta + 1), equation.E.truncate(delta + 1), equation.nu)
    second, first, zeroth = reduced_equation(needed, nmod_poly([alpha], p))
    u = series_solution(second, first, zeroth, delta)
    residual = second * u.derivative().derivative() + first * u.derivative() + zeroth * u
    return int(residual[delta - 1])


_MONODROMY_ORDERS = {
    Structure.TETRAHEDRAL: frozenset({1, 2, 3}),
    Structure.OCTAHEDRAL: frozenset({1, 2, 3, 4}),
    Structure.ICOSAHEDRAL: frozenset({1, 2, 3, 5}),
}


def excluded_by_local_data(problem: Problem) -> dict[Structure, NecessaryCondition]:
    """The structures that can't occur, each with the first condition that fails."""
    excluded: dict[Structure, NecessaryCondition] = {}
    for rule, culprits, structures in _failures(problem.places):
        new = [structure for structure in structures if structure not in excluded]
        if new:
            condition = NecessaryCondition(rule, tuple([place.name for place in culprits]))
            excluded.update(dict.fromkeys(new, condition))
    return excluded


def _failures(places: Sequence[Place]) -> Iterator[tuple[Rule, list[Place], list[Structure]]]:
    """The conditions that fail, at which places, and the structures that this excludes."""
    ramified = [place for place in places if place.kind is Kind.RAMIFIED]
    if ramified:
        yield Rule.RAMIFIED, ramified, [Structure.REDUCIBLE]
    logarithmic = [place for place in places if place.logarithm]
    if logarithmic:
        yield Rule.LOGARITHM, logarithmic, [Structure.IMPRIMITIVE, *_MONODROMY_ORDERS]
    branched = ramified + [place for place in places if place.delta is not None and place.delta.denominator == 2]
    if sum(place.degree for place in branched) < 2:
        yield Rule.TOO_FEW_BRANCH_POINTS, branched, [Structure.IMPRIMITIVE]
    irregular = [place for place in places if place.order > 2]
    if irregular:
        yield Rule.IRREGULAR, irregular, [*_MONODROMY_ORDERS]
    regular = [place for place in places if place.kind is Kind.REGULAR]
    for structure, orders in _MONODROMY_ORDERS.items():
        culprits = [place for place in regular if place.delta is None or place.delta.denominator not in orders]
        if culprits:
            yield Rule.EXPONENTS, culprits, [structure]

"""The singular points of y'' = S y, computed anew from S: orders, exponent differences, logarithms.

Let S have a pole of the order k at c.  If k <= 2, the point is regular, the solutions have the exponents (1 +- Delta)/2 with
Delta^2 = 1 + 4b for S = b/(x - c)^2 + ..., and there is a logarithm if Delta = 0, if k = 1, or perhaps if Delta is a whole
number.  If k > 2, the point is irregular.  Infinity is z = 0 for S(1/z)/z^4.  [Kovacic 1986, sections 2.1 and 3.1]
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any

from flint import nmod_poly

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.compatibility import cached_property
from kovacic.limits import Budget, check_time
from kovacic.verify.factors import factors_of, product, quotient
from kovacic.verify.primes import BadPrimeError, Homomorphism, homomorphisms, roots_modulo, translated
from kovacic.verify.series import solution_at_singular_point


@dataclass(frozen=True)
class Point:
    """All roots of an irreducible factor p of den, of multiplicity `order`, with S = num/den; or infinity, with S(1/z)/z^4.

    `expansions` is shared by all finite points of a kind, regular or irregular.
    """

    factor: Poly
    order: int
    num: Poly
    den: Poly
    budget: Budget
    expansions: Expansions
    at_infinity: bool = False

    @cached_property
    def name(self) -> str:
        return "infinity" if self.at_infinity else str(self.factor)

    @cached_property
    def near(self) -> tuple[Poly, Poly]:
        """N and q modulo p^nu with S = N/(p^order q), nu = order/2 or 1."""
        return self.expansions.near[self.factor]

    @cached_property
    def at_double_pole(self) -> tuple[Poly, Poly]:
        """N and M in K[x]/p with S = b/(x - c)^2 + ..., b = N/M: M = p'^2 q."""
        N, q = self.near
        return N, self.factor.derivative() ** 2 * q % self.factor

    @cached_property
    def difference(self) -> Fraction | None:
        """Delta >= 0 at a regular point where it is the same rational number for all roots (1 at an ordinary point)."""
        if self.order < 2:
            return Fraction(1)
        if self.order > 2:
            return None
        N, M = self.at_double_pole
        b = quotient(N[M.degree], M.lc)
        if b * M != N:
            return None
        square = b.field.rational_value(4 * b + 1)
        if square is None or square < 0:
            return None
        root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
        return root if root * root == square else None

    @cached_property
    def logarithm(self) -> bool:
        """True if there provably is a logarithm: for Delta = n > 0, within the limit of degrees, by an obstruction mod a prime.

        For t^2 y'' = (M_0 + M_d t^d) y the series with the smaller exponent has u_k k (k - n) = M_d u_(k-d): without any limit,
        there is a logarithm exactly if n is a multiple of d.
        """
        if self.order == 1 or self.difference == 0:
            return True
        if self.order != 2 or self.difference is None or self.difference.denominator > 1:
            return False
        n = self.difference.numerator
        if self.den.degree == 2:  # the pole is the only finite one
            M = self.num(self.factor.field.poly([-self.factor[0], 1]))
            steps = [k for k in range(1, M.degree + 1) if M[k]]
            if len(steps) < 2:
                return steps != [] and n % steps[0] == 0
        return n <= self.budget.limits.unknown_degree and self._is_obstructed(n)

    def _is_obstructed(self, n: int) -> bool:
        """True if the series with the smaller exponent is obstructed, at a root modulo the first prime that has one."""
        for h in homomorphisms(self.factor.field):
            self.budget.check()
            for root in roots_modulo(self.factor, h):
                try:
                    return has_no_series(*self.localised(h, root), n)
                except BadPrimeError:
                    continue
        raise AssertionError("the sequence of primes is infinite")

    @property
    def can_branch(self) -> bool:
        """True if the square root of an invariant can branch here: for odd k > 2, and where Delta is half an odd number."""
        if self.order > 2:
            return self.order % 2 == 1
        return self.difference is not None and self.difference.denominator == 2

    @property
    def tells_solutions_apart(self) -> bool:
        """True if a solution with a rational omega is one of finitely many local ones.

        At an unramified irregular point it has one of two exponential parts; at a regular one it has one of two exponents
        unless these differ by a whole number and there is no logarithm.
        """
        if self.order > 2:
            return self.order % 2 == 0
        if self.order == 0:
            return False
        return self.difference is None or self.difference.denominator > 1 or self.logarithm

    def localised(self, h: Homomorphism, root: int) -> tuple[Any, Any]:
        """M and E with S = M/(t^k E) at a root modulo p, k the order of the pole (2 for order 1), E(0) not 0."""
        den = translated(h.keeping_degree(self.den), root)
        if any(int(den[i]) for i in range(self.order)) or not int(den[self.order]):
            raise BadPrimeError("the order of a pole changes")
        num = translated(h(self.num), root)
        return num.left_shift(max(2 - self.order, 0)), den.right_shift(self.order)


def points(S: RatFunc, budget: Budget) -> list[Point]:
    """Every singular place, and infinity even if it is ordinary."""
    factors = factors_of(S.den)
    regular = Expansions(S.num, S.den, [(p, order) for p, order in factors if order <= 2])
    irregular = Expansions(S.num, S.den, [(p, order) for p, order in factors if order > 2])
    found = [Point(p, order, S.num, S.den, budget, regular if order <= 2 else irregular) for p, order in factors]
    # S(1/z)/z^4 = N/(z^k M), k = deg num - deg den + 4, where N and M have the coefficients of num and den in the reversed
    # order; a negative k gives N a power of z.
    k = S.num.degree - S.den.degree + 4 if S.num else 0
    num = S.num.reversed(max(-k, 0))
    den = S.den.reversed(max(k, 0))
    x = S.field.x
    return [*found, Point(x, max(k, 0), num, den, budget, Expansions(num, den, [(x, max(k, 0))]), at_infinity=True)]


@dataclass(frozen=True, eq=False)
class Expansions:
    """Shared by the points at some factors of the denominator, with these orders.

    All are expanded together when the first one is needed: at 200 poles that takes a fifth of the time.  A claim at irregular
    points, where there are many digits, may need one of them, or all.
    """

    num: Poly
    den: Poly
    factors: list[tuple[Poly, int]]

    @cached_property
    def near(self) -> dict[Poly, tuple[Poly, Poly]]:
        """`Point.near` for each factor, order by order: their product has much shorter numbers than its power in den."""
        found = {}
        for order in {order for _, order in self.factors}:
            # With den = P^order R, P the product of the places p of this order, q is (P/p)^order R.
            places = [p for p, other in self.factors if other == order]
            nu = max(order // 2, 1)
            P = product(places)
            R = self.den // P**order
            moduli = [p**nu for p in places]
            nums = _remainders_by_halves(self.num, moduli)
            outer = _remainders_by_halves(R, moduli)
            inner = _remainders_by_halves(P, [p ** (nu + 1) for p in places])
            for p, modulus, N, far, close in zip(places, moduli, nums, outer, inner, strict=True):
                found[p] = (N, _power_modulo(close // p, order, modulus) * far % modulus)
        return found


def _remainders_by_halves(polynomial: Poly, moduli: list[Poly]) -> list[Poly]:
    """The polynomial modulo each of several ones, through its remainders modulo the products of halves of them."""
    if len(moduli) == 1:
        return [polynomial % moduli[0]]
    check_time()
    half = len(moduli) // 2
    first = polynomial % product(moduli[:half])
    second = polynomial % product(moduli[half:])
    return [*_remainders_by_halves(first, moduli[:half]), *_remainders_by_halves(second, moduli[half:])]


def _power_modulo(base: Poly, exponent: int, modulus: Poly) -> Poly:
    """The power modulo a polynomial, by repeated squaring: no product is longer than twice the modulus."""
    power = base**0
    for digit in f"{exponent:b}":
        power = power * power % modulus
        if digit == "1":
            power = power * base % modulus
    return power


def has_no_series(M: Any, E: Any, n: int) -> bool:
    """True if t^2 E y'' = M y has no solution t^e (1 + O(t)) with the smaller exponent e = (1-n)/2: there is a logarithm.

    For y = t^e u the equation t u'' + 2 e u' + (e (e-1) - M/E)/t u = 0 determines u below t^n; the coefficient of t^(n-1)
    in it doesn't depend on u_n, and must vanish [Frobenius].
    """
    p = E.modulus()
    S = M.mul_low(E.inverse_series_trunc(n + 1), n + 1)  # no later terms have a part in it
    e = (1 - n) * pow(2, -1, p) % p
    second = nmod_poly([0, 1], p)
    first = nmod_poly([2 * e], p)
    zeroth = (e * (e - 1) - S).right_shift(1)
    u = solution_at_singular_point(second, first, zeroth, n)
    rest = second * u.derivative().derivative() + first * u.derivative() + zeroth * u
    return bool(int(rest[n - 1]))


def solution_with_exponential_part(M: Any, E: Any, start: Any, nu: int, count: int) -> Any:
    """u = 1 + O(t), to `count` terms, with y = u exp(int t^-nu start) a solution of t^(2 nu) E y'' = M y.

    It satisfies t^nu E u'' + 2 start E u' + V u = 0, t^nu V = E (t^(2 nu) (start/t^nu)' + start^2) - M.
    """
    slope = start.derivative().left_shift(nu) - (nu * start).left_shift(nu - 1)
    V = (E * (slope + start * start) - M).right_shift(nu)
    return solution_at_singular_point(E.left_shift(nu), 2 * start * E, V, count)

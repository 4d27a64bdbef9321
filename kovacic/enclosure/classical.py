"""Values by FLINT's Airy, Bessel, Kummer and Gauss functions, where S is a pull-back of one of their equations.

The guarantee of the matrices is that of the Taylor route, with which nothing is shared: they contain the exact transition
matrices along the leg.  S = f'^2 S0(f) - {f, x}/2 was verified exactly (`kovacic.special.pullback`), so with f = n/d

    y_i = f'^(-1/2) z^alpha_i (1 - z)^beta_i E_i(z),    z = f(x),    i = 1, 2,                                           (1)
        = W^(-1/2) n^alpha_i (d - n)^beta_i d^(1 - alpha_i - beta_i) E_i(f),    W = n' d - n d',

are solutions, with the functions E_i of the modules of `kovacic.special`.  The matrix is Y(b) Y(a)^-1, if Y(a) is
invertible (its ball tells), if the powers are followed continuously (`_followed`), and if no E_i is carried over its slit
(`_avoids`).  Where one of these isn't proven, there is no matrix.

At a zero x0 of f of order k, with t = x - x0 and E_i(0) = 1, the equation (1) without the powers of t in n and W is analytic:
divided by its value and multiplied by t to the exponent it is the Frobenius solution there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache
from operator import mul
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_poly

from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.enclosure.closed_form import CaseOneForm
from kovacic.enclosure.frame import System, check_segment, isolated_zeros
from kovacic.enclosure.log_derivative import log_derivative
from kovacic.enclosure.matrices import Matrix, State, fundamental, inverse_matrix, multiply
from kovacic.enclosure.points import ExactPoint, kept_at_precision, to_acb
from kovacic.enclosure.singular import Singular, power_of
from kovacic.errors import LimitExceeded
from kovacic.limits import MOST_TRIALS, Budget, Limits
from kovacic.special.pullback import Pullback, StandardForm
from kovacic.special.search import SEARCH_WORK, find

_LEG_BITS = 64  # in which the course of a leg is proven
_MOST_FROM_ZERO = 2_000  # digits up to which the functions cost less than the series at a singular point (measured)
_NO_GAUGE = RatFunc(QQ.zero)
# Parameters up to which a call of FLINT, which can't be stopped, is short: at 2,000 bits 0.03 s, and 1.7 s for 10,000
_LARGEST_PARAMETER = 1_000


class NotServed(Exception):
    """Raised where FLINT's functions don't prove the values on a leg."""


@lru_cache(maxsize=64)
def classical_of(S: RatFunc, work: int = SEARCH_WORK) -> Classical | None:
    """The standard equation that S is pulled back from over Q, or None if none with short parameters is found in this work."""
    if S.field != QQ:
        return None
    budget = Budget(Limits(constants=1))
    search = find(S, budget, extended=False, work=work)
    if search.stopped and budget.seconds_left <= 0:  # an exception isn't kept
        raise LimitExceeded(search.stopped, limit="seconds")
    found = search.pullback
    if found is None or found.f.field != QQ:
        return None
    is_short = all(abs(square) < _LARGEST_PARAMETER**2 for square in found.equation.parameters)
    return Classical(found) if is_short else None


@dataclass(frozen=True, eq=False)
class Classical:
    """A pull-back, and the transition matrices and Frobenius solutions that follow from it."""

    pullback: Pullback

    def __str__(self) -> str:
        return f"FLINT's functions: {self.pullback.equation.name} equation in {self.pullback.f}"

    def price(self, digits: float) -> float:
        """The estimated cost of a target."""
        return self.pullback.equation.cost.target(digits)

    def lost_digits(self, start: ExactPoint | Singular) -> float:
        """The approximate number of digits that Y(b) Y(a)^-1 loses: those of y1 y2' in the determinant, and as many in the
        product; none from a singular point on."""
        if isinstance(start, Singular):
            return 0.0
        with suppress(NotServed), working_precision(_LEG_BITS):
            y1, y2, dy1, dy2 = _solutions_at_start(self, start, False).at(start)
            # The larger product in the Wronskian y1 dy2 - y2 dy1, which counts twice.
            product = abs(y1 * dy2).max(abs(y2 * dy1)).mid()
            return 2 * float(product.log()) / math.log(10) if product > 1 else 0.0
        return 0.0

    def is_cheap(self, digits: int, *, from_zero: bool) -> bool:
        """True if the functions cost less than the Taylor route; `from_zero` says that the start is a zero of f."""
        return digits <= max(self.pullback.equation.cost.most, _MOST_FROM_ZERO if from_zero else 0)

    def coordinate(self, point: ExactPoint) -> int:
        """The number of the standard coordinate that serves best at the point."""
        n, d = (polynomial_at(poly, point) for poly in self.fraction)
        return self.pullback.equation.coordinate(n, d)

    @property
    def fraction(self) -> tuple[fmpq_poly, fmpq_poly]:
        """n and d."""
        system = System.of(self.pullback.f)
        return fmpq_poly(list(system.num)), fmpq_poly(list(system.den))

    def leg(self, a: ExactPoint, b: ExactPoint) -> Matrix:
        """The transition matrix that carries (y, y') from a to b along the straight segment; raises NotServed."""
        return _settled(lambda: self._leg(a, b), _sharper(ctx.prec))

    def frobenius(self, point: Singular, gauge: RatFunc, needed: tuple[bool, bool], x: ExactPoint) -> Matrix:
        """The needed solutions of the Frobenius basis of the user's equation at a rational zero of f, at x; raises NotServed at
        other points, and if a needed solution may have a logarithm."""
        return _settled(lambda: _frobenius(self, point, gauge, needed).at(x), ctx.prec)

    def _leg(self, a: ExactPoint, b: ExactPoint) -> Matrix:
        start = _solutions_at_start(self, a, False)
        if not start.form.independent:
            raise NotServed
        # Through an ordinary zero of f the powers of f can't be followed, but solutions from there on both sides can.
        zero = _ordinary_zero(start.form, a, b)
        if zero is None:
            return multiply(start.at(b), start.coordinates)
        basis = _solutions_at_start(self, zero, True)
        coordinates = basis.coordinates if a == zero else inverse_matrix(basis.at(a))
        return multiply(basis.at(b), coordinates)


Closed = CaseOneForm | Classical
"""The routes that share nothing with Taylor's method."""


def _settled(compute: Callable[[], Matrix], bits: int) -> Matrix:
    """A finite matrix, computed with these bits or a few times as many: two solutions may be nearly dependent."""
    for factor in (1, 2, 4):
        with working_precision(factor * bits):
            matrix = compute()
        if all(entry.is_finite() for entry in matrix):
            return matrix
    raise NotServed


@kept_at_precision(maxsize=64)
def _solutions_at_start(classical: Classical, a: ExactPoint, is_zero: bool) -> Solutions:
    """The solutions from a on; `is_zero` says that a is an ordinary zero of f."""
    form = _form(classical, classical.coordinate(a))
    return Solutions.make(form, a, (fmpq(0), fmpq(1)) if is_zero else None)


@kept_at_precision(maxsize=16)
def _form(classical: Classical, coordinate: int) -> StandardForm:
    return classical.pullback.equation.form(*classical.fraction, coordinate)


@kept_at_precision(maxsize=64)
def _frobenius(classical: Classical, point: Singular, gauge: RatFunc, needed: tuple[bool, bool]) -> Solutions:
    if not point.is_rational or point.inverted:
        raise NotServed
    with working_precision(_sharper(ctx.prec)):
        x0 = point.near.x
        lower, upper = point.exponents()
        form = _form(classical, classical.coordinate(point.near))
    if form.n(x0) != 0 or form.d(x0) == 0:  # f isn't zero there
        raise NotServed
    may_have_logarithm = needed[0] and point.difference is not None  # the dominant solution
    if may_have_logarithm or form.powers[0][0] == 0 or not acb(upper).imag.is_zero():
        raise NotServed
    # The gauge without its part c/t, at most a simple pole with c = (gauge t)(x0); c is 0 at an ordinary point.
    t = QQ.poly([-point.near.re, 1])
    regular = gauge - (gauge * t)(point.near.re) / t
    return Solutions.make(form, point.near, (lower, upper), regular, needed)


def _ordinary_zero(form: StandardForm, a: ExactPoint, b: ExactPoint) -> ExactPoint | None:
    """A zero of f on a real leg where y'' = S y is regular: there f^(1/2 +- mu) has the orders 1/2 +- 1/2."""
    if not (a.is_real() and b.is_real()):
        return None
    low, high = sorted((a.x, b.x))
    doubled = 2 * form.powers[0][0] - 1  # 2 mu, or -2 mu
    zeros = (z for z, k in form.n.roots() if k > 1 and k * doubled == 1 and low <= z <= high)
    return next(map(ExactPoint, zeros), None)


@dataclass(frozen=True, eq=False)
class Solutions:
    """The solutions (1) on straight ways from a point, with powers and a gauge that are 1 there; or with `exponents` the
    Frobenius solutions to the exponents in this order: then `factors` and `gauge` are without the powers of t.

    `factors` are those of W, n, d - n and d that aren't constant, with derivatives and their exponents in either solution.
    """

    form: StandardForm
    point: ExactPoint
    factors: tuple[tuple[fmpq_poly, fmpq_poly, tuple[Any, Any]], ...]
    exponents: tuple[Any, Any] | None
    gauge: RatFunc
    needed: tuple[bool, bool]

    @classmethod
    def make(
        cls,
        form: StandardForm,
        point: ExactPoint,
        exponents: tuple[Any, Any] | None = None,
        gauge: RatFunc = _NO_GAUGE,
        needed: tuple[bool, bool] = (True, True),
    ) -> Solutions:
        """The solutions that are needed (in the order of the exponents)."""
        n, d = form.n, form.d
        factors = []
        t = fmpq_poly([-point.x, 1])
        for poly, powers in zip((n.derivative() * d - n * d.derivative(), n, d - n, d), form.exponents, strict=True):
            while exponents is not None and poly != 0 and poly(point.x) == 0:
                poly //= t
            if poly.degree() > 0 and (poly == d or any(e != 0 for e in powers)):  # d: f has no pole on the way
                factors.append((poly, poly.derivative(), powers))
        return cls(form, point, tuple(factors), exponents, gauge, needed)

    @cached_property
    def coordinates(self) -> Matrix:
        """The matrix from (y, y') at the point to coordinates in these solutions."""
        return inverse_matrix(self.at(self.point))

    def at(self, x: ExactPoint) -> Matrix:
        """The values and slopes at x, perhaps not finite, a column for each solution (zero if not needed); raises NotServed."""
        if self.exponents is not None:
            if self.point == x:  # an ordinary point, where the second solution in the form's order is 1
                # There E = 1, and the slope of the first solution is that of the factors alone.
                rate = sum((powers[1] * acb(slope(x.x) / poly(x.x)) for poly, slope, powers in self.factors), acb(0))
                return acb(1), acb(0), rate, acb(1)
            with working_precision(_sharper(ctx.prec)):
                return fundamental(*self._frobenius(x, self.exponents))
        return fundamental(*self._states(x, (True, True)))

    def _states(self, x: ExactPoint, needed: tuple[bool, bool]) -> list[State]:
        """The solutions and slopes at x with the powers, in the order of the form."""
        form = self.form
        logs = [_followed(poly, self.point, x) for poly, *_ in self.factors]
        if x != self.point:
            _avoids(form, self.point, x, needed[::-1])
        n, d, dn, dd = (polynomial_at(poly, x) for poly in (form.n, form.d, *form.derivatives))
        # f' = (n' d - n d')/d^2.
        slope = acb((dn - n / d * dd) / d)
        rates = [acb(polynomial_at(derivative, x) / polynomial_at(poly, x)) for poly, derivative, _ in self.factors]
        found = []
        for i, (E, dE) in enumerate(form.values(acb(n / d), needed)):
            exponents = [powers[i] for _, _, powers in self.factors]
            rate = sum(map(mul, exponents, rates), acb(0))
            # The product of the factors to their powers, 1 at the point, by sums of continued logarithms.
            power = sum(map(mul, exponents, logs), acb(0)).exp()
            found.append((E * power, (rate * E + slope * dE) * power))
        return found

    def _frobenius(self, x: ExactPoint, exponents: tuple[Any, Any]) -> list[State]:
        check_segment(System.of(self.gauge), self.point, x)
        theta = log_derivative(self.gauge)
        growth = theta.growth(to_acb(self.point), to_acb(x))
        rate = theta.value(to_acb(x))
        t = to_acb(x - self.point)
        columns = []
        # A form has the solution with the larger exponent first, a Frobenius basis second.
        first, second = self._states(x, self.needed[::-1])
        for (y, dy), exponent in zip((second, first), exponents, strict=True):
            # (t^e g y)' = t^e g (y' + (e/t + g'/g) y), and t^e follows.
            state = y * growth, (dy + (exponent / t + rate) * y) * growth
            power = power_of(t, exponent, t.log())
            y, dy = (acb(part.real) if x.is_real() else part for part in state)
            columns.append((y * power, dy * power))
        return columns


def polynomial_at(poly: fmpq_poly, x: ExactPoint) -> Any:
    """A rational number at a rational point, else a ball."""
    return poly(x.x) if x.is_real() else acb_poly(poly)(to_acb(x))


def _sharper(bits: int) -> int:
    """FLINT's series with parameters that aren't dyadic lose some sqrt(bits)/2 bits, as measured."""
    return bits + math.isqrt(bits)


def _followed(poly: fmpq_poly, a: ExactPoint, b: ExactPoint) -> acb:
    """The logarithm of p(b)/p(a), continued from 0 along the segment; raises NotServed if p may have a zero there.

    The quotients (x - zeta)/(a - zeta) run along straight lines from 1, so their principal logarithms are the continuous ones
    and add up to the logarithm.  This gives its imaginary part to a few digits, which determine the multiple of pi i to be
    added to the principal logarithm of p(b)/p(a) or of its negative.
    """
    # 0 where the way begins at a zero of f, of 1 - f or a pole.
    start = polynomial_at(poly, a)
    if start == 0:
        raise NotServed
    ratio = acb(polynomial_at(poly, b) / start)
    if poly.degree() == 1:
        if not _off(ratio):
            raise NotServed
        return ratio.log()
    with working_precision(_LEG_BITS):
        zeros = isolated_zeros(tuple(map(int, poly.numer().coeffs())), _LEG_BITS)
        quotients = [((to_acb(b) - zeta) / (to_acb(a) - zeta), k) for zeta, k in zeros]
        if not all(_off(quotient) for quotient, _ in quotients):
            raise NotServed
        angle = sum((quotient.log().imag * k for quotient, k in quotients), arb(0))
    # log p(b)/p(a) = log(+-ratio) + i pi half_turns, an odd number of half turns for the negative ratio.
    is_negative = ratio.real.mid() < 0
    log = (-ratio if is_negative else ratio).log()  # away from the cut of the principal logarithm
    half_turns = ((angle - log.imag) / arb.pi()).unique_fmpz()
    if half_turns is None or bool(half_turns % 2) is not is_negative:
        raise NotServed
    return log + acb(0, arb.pi() * half_turns)


def _check_slit(over: acb_poly, under: acb_poly, a: ExactPoint, b: ExactPoint) -> None:
    """Raise NotServed unless balls on pieces of the segment prove that the quotient is neither 0 nor negative there."""
    start = to_acb(a)
    step = to_acb(b - a)
    waiting = [(0, 0)]  # k and depth: the piece from k/2^depth to (k + 1)/2^depth
    for _ in range(MOST_TRIALS):
        k, depth = waiting.pop()
        # A ball around the middle (2 k + 1)/2^(depth + 1) of the piece, with half of it as its radius.
        x = start + step * acb(arb((2 * k + 1, -depth - 1), (1, -depth - 1)))
        if not _off(over(x) / under(x)):
            waiting += [(2 * k + 1, depth + 1), (2 * k, depth + 1)]
        if not waiting:
            return
    raise NotServed


def _off(z: acb) -> bool:
    """True if the ball contains neither 0 nor negative numbers."""
    return bool(z.real > 0) or not z.imag.contains(0)


def _avoids(form: StandardForm, a: ExactPoint, b: ExactPoint, needed: tuple[bool, bool]) -> None:
    """Raise NotServed unless the segment is proven not to meet a slit; that of z concerns the second solution only."""
    # z and 1 - z are these numerators over d; each has its slit.
    for c, top, matters in zip(form.slits, (form.n, form.d - form.n), (needed[0], True), strict=True):
        if c is None or not matters:
            continue
        with working_precision(_LEG_BITS):
            _check_slit(acb_poly(top) * c, acb_poly(form.d), a, b)

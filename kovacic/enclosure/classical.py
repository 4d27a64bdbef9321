"""Values by FLINT's Airy, Bessel, Kummer and Gauss functions, where S is a pull-back of one of their equations.

The guarantee of the matrices is that of the Taylor route, with which nothing is shared: they contain the exact transition
matrices along the leg.  S = f'^2 S0(f) - {f, x}/2 was verified exactly (`kovacic.special.pullback`), so with f = n/d

    y_i = f'^(-1/2) z^alpha_i (1 - z)^beta_i E_i(z),    z = f(x),    i = 1, 2,                                           (1)
        = W^(-1/2) n^alpha_i (d - n)^beta_i d^(1 - alpha_i - beta_i) E_i(f),    W = n' d - n d',

are solutions, with the functions E_i of `kovacic.enclosure.classical_functions`.  The matrix is Y(b) Y(a)^-1, if Y(a) is
invertible (its ball tells), if the powers are followed continuously (`_followed`), and if no E_i is carried over its slit
(`_avoids`).  Where one of these isn't proven, there is no matrix.

At a zero x0 of f of order k, with t = x - x0 and E_i(0) = 1, the equation (1) without the powers of t in n and W is analytic:
divided by its value and multiplied by t to the exponent it is the Frobenius solution there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_poly

from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.enclosure.classical_functions import Form, choice_at, form_of, is_integer, rational
from kovacic.enclosure.constants import Number
from kovacic.enclosure.exponential import LogDerivative
from kovacic.enclosure.matrices import Matrix, State, adjugate, fundamental, identity, inverse, multiply
from kovacic.enclosure.points import Point, to_acb, working_precision
from kovacic.enclosure.problem import System, check_segment, distance_lower
from kovacic.enclosure.singular import Singular
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, Limits
from kovacic.special.answer import find
from kovacic.special.pullback import Airy, Confluent, Gauss, Pullback

_BITS = 64  # in which the course of a leg is proven
_POLES = 3  # the place of d among the polynomials
_PIECES = 400  # into which a leg is cut for that, at most
#: Digits up to which FLINT's functions cost less than Taylor steps, once the pull-back is known, on a short way and on others.
_NEAR: dict[type, int] = {Airy: 20_000, Confluent: 500, Gauss: 0}
_FAR: dict[type, int] = {Airy: 20_000, Confluent: 20_000, Gauss: 5_000}
_NOTHING_NEAR = 4  # what counts as the distance to singular points where there are none
_DEGREE = 24  # of S, up to which a pull-back is sought
_KNOWN = 16  # forms that are kept for other legs and calls
_LARGEST = 1_000  # parameters of special functions up to which a call of FLINT, which can't be stopped, is short


class NotServed(Exception):
    """The values on this leg aren't proven by FLINT's functions."""


@lru_cache(maxsize=64)
def classical_of(S: RatFunc) -> Classical | None:
    """The standard equation that S is pulled back from over Q; None where none is found, or its parameters are large."""
    if S.field != QQ or S.num.degree + S.den.degree > _DEGREE:
        return None
    budget = Budget(Limits(constants=1))
    search = find(S, budget)
    if search.stopped and budget.seconds_left <= 0:  # an exception isn't kept
        raise LimitExceeded(search.stopped, limit="seconds")
    found = search.pullback
    if found is None or found.f.field != QQ:
        return None
    equation, squares = found.equation, []
    if isinstance(equation, Gauss):
        squares = [rational(v) for v in (equation.A, equation.B, equation.C)]
    elif isinstance(equation, Confluent):
        q, r, M = (rational(v) for v in (equation.q, equation.r, equation.M))
        squares = [M, r * r / q if q != 0 else fmpq(0)]
    return Classical(found) if all(abs(v) < _LARGEST**2 for v in squares) else None


@dataclass(frozen=True)
class Classical:
    """A pull-back, and the transition matrices and Frobenius solutions that follow from it."""

    pullback: Pullback

    def is_cheaper(self, digits: int, system: System, start: Singular | Number, targets: Sequence[Number]) -> bool:
        """Do FLINT's functions cost less than Taylor steps, as measured?  On a short way a disc or two do the same."""
        kind = type(self.pullback.equation)
        return digits <= _NEAR[kind] or (digits <= _FAR[kind] and not is_short(system, start, targets))

    @cached_property
    def _known(self) -> dict[tuple[int, int], tuple[Form, Factors]]:
        """The forms by their coordinate and the working precision: of several calls, or of several legs."""
        return {}

    def form_at(self, a: Point) -> tuple[Form, Factors]:
        """Two solutions near f(a), at the working precision in force."""
        key = choice_at(self.pullback, a), ctx.prec
        found = self._known.get(key)
        if found is None:
            form = form_of(self.pullback, key[0])
            if len(self._known) >= _KNOWN:
                self._known.clear()
            found = self._known[key] = form, Factors.of(form)
        return found

    def leg(self, a: Point, b: Point) -> Matrix:
        """The transition matrix that carries (y, y') from a to b along the straight segment; raises NotServed."""
        with working_precision(_sharper(ctx.prec)):
            return self._leg(a, b)

    def _leg(self, a: Point, b: Point) -> Matrix:
        form, factors = self.form_at(a)
        zero = _ordinary_zero(form, a, b)
        if zero is not None:
            return _finite(multiply(_from_zero(form, factors, zero, b), adjugate(_from_zero(form, factors, zero, a))))
        growths = factors.growths(form, a, b)
        _avoids(form, a, b, (True, True))
        start, end = (fundamental(*factors.states(form, x, (True, True))) for x in (a, b))
        p, q = growths
        return _finite(multiply((end[0] * p, end[1] * q, end[2] * p, end[3] * q), inverse(start)))

    def frobenius(self, point: Singular, gauge: RatFunc | None, needed: Sequence[bool]) -> Frobenius:
        """The Frobenius basis of the user's equation at a rational zero of f, or its solutions that are needed.

        Raises NotServed at other points, and where a solution is needed that may have a logarithm.
        """
        if not point.is_rational or point.inverted:
            raise NotServed
        with working_precision(_sharper(ctx.prec)):
            x0, (lower, upper), (form, factors) = point.near.x, point.exponents(), self.form_at(point.near)
        if not acb(upper).imag.is_zero() or form.n(x0) != 0 or form.d(x0) == 0 or form.powers[0][0] == 0:
            raise NotServed
        if needed[0] and point.difference is not None:
            raise NotServed
        rest = None if gauge is None else _without_pole(gauge, point.near)
        return Frobenius(point.near, (lower, upper), form, factors.without(x0), rest, needed)


def is_short(system: System, start: Singular | Number, targets: Sequence[Number]) -> bool:
    """Do a disc or two of Taylor's series reach all targets, which are within half the distance to the singular points?"""
    if not isinstance(start, Point):
        return False
    near = distance_lower(system, start) or _NOTHING_NEAR
    return all(isinstance(x, Point) and bool(abs(to_acb(x - start)) < near / 2) for x in targets)


@lru_cache(maxsize=64)
def _without_pole(gauge: RatFunc, point: Point) -> RatFunc | None:
    """Without the part c/(x - x0), at most a simple pole; None for zero."""
    t = QQ.poly([-point.re, 1])
    return (gauge - (gauge * t)(point.re) / t) or None


def _from_zero(form: Form, factors: Factors, zero: Point, x: Point) -> Matrix:
    """The matrix from an ordinary point of y'' = S y that is a zero of f."""
    basis = Frobenius(zero, (fmpq(0), fmpq(1)), form, factors.without(zero.x), None, (True, True))
    y1, y2, d1, d2 = basis.at(x)
    slope = basis.factors.rate(form, 1, zero)  # of the first solution at the point, where the second one's is 1
    return y1 - slope * y2, y2, d1 - slope * d2, d2


def _ordinary_zero(form: Form, a: Point, b: Point) -> Point | None:
    """A zero of f on a real leg that is an ordinary point of y'' = S y: where f^(1/2 +- mu) has the orders 1/2 +- 1/2."""
    if form.n.degree() < 2 or not a.is_real() or not b.is_real() or form.powers[0][0] == 0:
        return None
    doubled = 2 * form.powers[0][0] - 1
    zeros = [z for z, k in form.n.roots() if k > 1 and k * doubled == 1 and min(a.x, b.x) <= z <= max(a.x, b.x)]
    return Point(zeros[0]) if zeros else None


@dataclass(frozen=True)
class Frobenius:
    """Frobenius solutions at a real point, by their exponents; `factors` and `gauge` are without the powers of t."""

    point: Point
    exponents: tuple[Any, Any]
    form: Form
    factors: Factors
    gauge: RatFunc | None
    needed: Sequence[bool]

    def at(self, x: Point) -> Matrix:
        """The values and slopes at x (the columns: the two solutions; zero where one isn't needed); raises NotServed."""
        if self.point == x:
            return identity()
        with working_precision(_sharper(ctx.prec)):
            return self._at(x)

    def _at(self, x: Point) -> Matrix:
        a, form, columns = self.point, self.form, []
        growths = self.factors.growths(form, a, x)
        _avoids(form, a, x, self.needed)
        t, growth, rate = to_acb(x - a), acb(1), acb(0)
        if self.gauge is not None:
            check_segment(System.of(self.gauge), a, x)
            theta = LogDerivative.make(self.gauge, None)
            growth, rate = theta.growth(to_acb(a), to_acb(x)), theta.value(to_acb(x))
        states = self.factors.states(form, x, self.needed[::-1])
        for (y, dy), power, exponent in zip(states[::-1], growths[::-1], self.exponents, strict=True):
            factor = growth * power
            y, dy = y * factor, (dy + (exponent / t + rate) * y) * factor
            if x.is_real():
                y, dy = acb(y.real), acb(dy.real)
            power = t ** int(exponent.p) if is_integer(exponent) else (exponent * t.log()).exp()
            columns.append((y * power, dy * power))
        return _finite(fundamental(*columns))


def _sharper(bits: int) -> int:
    """FLINT's series with parameters that aren't dyadic lose some sqrt(bits)/2 bits, as measured."""
    return bits + math.isqrt(bits)


def _finite(matrix: Matrix) -> Matrix:
    if not all(entry.is_finite() for entry in matrix):
        raise NotServed
    return matrix


@dataclass(frozen=True)
class Factors:
    """W, n, d - n and d, or what is left of them."""

    polynomials: tuple[fmpq_poly, ...]

    @classmethod
    def of(cls, form: Form) -> Factors:
        n, d = form.n, form.d
        return cls((n.derivative() * d - n * d.derivative(), n, d - n, d))

    def without(self, x0: Any) -> Factors:
        """Without their factors x - x0."""
        polynomials, t = [], fmpq_poly([-x0, 1])
        for poly in self.polynomials:
            while poly != 0 and poly(x0) == 0:
                poly //= t
            polynomials.append(poly)
        return Factors(tuple(polynomials))

    def growths(self, form: Form, a: Point, b: Point) -> list[acb]:
        """The powers in both solutions at b over those at a, continued along the segment, which has no pole of f."""
        exponents = [form.exponents(i) for i in (0, 1)]
        logs = [
            _followed(poly, a, b) if k == _POLES or any(row[k] != 0 for row in exponents) else acb(0)
            for k, poly in enumerate(self.polynomials)
        ]
        return [sum(e * log for e, log in zip(row, logs, strict=True)).exp() for row in exponents]

    @cached_property
    def derivatives(self) -> tuple[fmpq_poly | None, ...]:
        """Those of the polynomials that aren't constant."""
        return tuple(poly.derivative() if poly.degree() > 0 else None for poly in self.polynomials)

    def rate(self, form: Form, i: int, x: Point) -> acb:
        """The logarithmic derivative of the powers in solution i."""
        total = acb(0)
        for e, poly, slope in zip(form.exponents(i), self.polynomials, self.derivatives, strict=True):
            if slope is not None and e != 0:
                total += e * acb(_at(slope, x) / _at(poly, x))
        return total

    def states(self, form: Form, x: Point, needed: Sequence[bool]) -> list[State]:
        """y and y' of both solutions without the powers: as if these were 1 at x; zeros for one that isn't needed."""
        n, d = _at(form.n, x), _at(form.d, x)
        slope = acb((_at(form.n.derivative(), x) - n / d * _at(form.d.derivative(), x)) / d)
        values = form.values(acb(n / d), needed)
        return [(E, self.rate(form, i, x) * E + slope * dE) for i, (E, dE) in enumerate(values)]


def _at(poly: fmpq_poly, x: Point) -> Any:
    """The value: a rational number at a rational point, else a ball."""
    return poly(x.x) if x.is_real() else acb_poly(poly)(to_acb(x))


def _followed(poly: fmpq_poly, a: Point, b: Point) -> acb:
    """The logarithm of p(b)/p(a) that is continued from 0 along the segment; raises NotServed if p may have a zero there.

    On each of the pieces the real part of p over its value at the start of the piece is positive: the principal logarithms of
    the quotients are continuous and add up to the logarithm.  So its imaginary part is known to a few digits, and which
    multiple of pi i is to be added to the principal logarithm of p(b)/p(a) or of its negative.
    """
    if poly.degree() < 1:
        return acb(0)
    start = _at(poly, a)
    if start == 0:
        raise NotServed
    ratio = acb(_at(poly, b) / start)
    if poly.degree() == 1:  # the quotient runs along a straight line from 1
        if not _off(ratio):
            raise NotServed
        return ratio.log()
    balls = acb_poly(poly)
    with working_precision(_BITS):

        def quotient(x: acb, left: acb) -> acb | None:
            return acb(1) if (balls(x) / balls(left)).real > 0 else None

        angle = sum(((balls(end) / balls(left)).log().imag for left, end in _pieces(a, b, quotient)), arb(0))
    back = ratio.real.mid() < 0
    log = (-ratio if back else ratio).log()
    turns = ((angle - log.imag) / arb.pi()).unique_fmpz()
    if turns is None or bool(turns % 2) is not back:
        raise NotServed
    return log + acb(0, arb.pi() * turns) if turns else log


def _pieces(a: Point, b: Point, allowed: Callable[[acb, acb], Any]) -> list[tuple[acb, acb]]:
    """The ends of pieces of the segment for whose balls the condition holds, given the ball and the start of the piece.

    Raises NotServed where a bounded number of pieces isn't enough.
    """
    start, step = to_acb(a), to_acb(b - a)
    waiting, done = [(0, 0)], []  # k and depth: the piece from k/2^depth to (k + 1)/2^depth
    while waiting:
        k, depth = waiting.pop()
        left, right = (start + step * acb(arb((k + j, -depth))) for j in (0, 1))
        ball = start + step * acb(arb((2 * k + 1, -depth - 1), (1, -depth - 1)))
        if allowed(ball, left):
            done.append((left, right))
        elif len(waiting) + len(done) > _PIECES or depth > _PIECES:
            raise NotServed
        else:
            waiting += [(2 * k + 1, depth + 1), (2 * k, depth + 1)]
    return done


def _off(z: acb) -> bool:
    """Does the ball contain neither 0 nor negative numbers?"""
    return bool(z.real > 0) or not z.imag.contains(0)


def _avoids(form: Form, a: Point, b: Point, needed: Sequence[bool]) -> None:
    """Raise NotServed unless the segment is proven not to meet a slit.  That of z is the second solution's only.

    On the real axis z and 1 - z keep their signs, since their numerators and denominators have no zeros (`_followed`).
    """
    slits = (form.slits[0] if needed[0] else None, form.slits[1])
    tops = (form.n, form.d - form.n)
    for c, top in zip(slits, tops, strict=True):
        if c is None:
            continue
        if a.is_real() and b.is_real():
            if top(a.x) / form.d(a.x) <= 0:
                raise NotServed
            continue
        over, under = acb_poly(top), acb_poly(form.d)
        with working_precision(_BITS):
            _pieces(a, b, partial(_misses, over, under, acb(c)))


def _misses(over: acb_poly, under: acb_poly, c: acb, x: acb, _left: acb) -> bool:
    return _off(c * over(x) / under(x))

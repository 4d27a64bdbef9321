"""Ways of equations with rational coefficients: by Taylor discs of the normal form, or by a closed form.

A state (y, y') of the normal form y'' = S y is carried; with a gauge g, z = g y is the user's solution, and on a straight line
from u to v, with gamma = g'/g,

    (z, z')(v) = E G(v) M G(u)^-1 (z, z')(u),    E = exp int_u^v gamma,    G(x) = (1, 0; gamma(x), 1).

A pole of gamma is a singular point of the user's equation even where S is regular: lines through one are refused.

Each disc is free of singular points, so the matrix from where it is entered to where it is left is E(leave) E(enter)^-1 with
the expansion E at its centre; the inverse is the adjugate, since det = 1 exactly.  The matrices E come from one expansion,
summed term by term (`kovacic.enclosure.taylor`), or at thousands of digits from binary splitting
(`kovacic.enclosure.splitting`).  The scale of a disc is half the distance from the centre to the nearest singular point (the
terms then fall like 2^-n), or less where the solutions grow by more than a fixed share of the working precision.

Solutions that oscillate towards infinity, over any distance in one step: by amplitude and phase.

The guarantee: from `edge` on, on its half of the real axis, every state that is carried lies in the ball that is returned.

Let S be real and S ~ -c x^d for x to infinity, c > 0 and d >= -1 (to minus infinity: S(-x) instead).  With
any smooth f > 0 and phi' = sqrt(c) f,

    w = f^(-1/2) (cos phi, sin phi)    solves    w'' = S~ w,    S~ = -c f^2 + 3/4 (f'/f)^2 - f''/(2 f),

and its Wronskian is sqrt(c).  Here f = x^(d/2) T(1/x) with a polynomial T, so phi is elementary, and the defect S~ - S is known
exactly: with t = 1/x, U = (d/2) T - t T', V = (d/2 - 1) U - t U' and S = x^d n(t)/D(t),

    f^2 (S~ - S) = x^(2 d) E(t)/D(t),    E = D (-c T^4 + t^(d+2) (3/4 U^2 - 1/2 T V)) - n T^2.

A solution y of y'' = S y and y' are w.C and w'.C with C' = -(S~ - S) (-w_2, w_1) (w.C)/sqrt(c), so |C'| <= |S~ - S|/(sqrt(c) f)
|C|: over any part of the half line C moves by at most (exp(I) - 1) |C|, I = int |S~ - S|/(sqrt(c) f).

T is chosen so that E begins with a high power of t: 1/T is the series of the product M = x^(d/2) (w_1^2 + w_2^2) of solutions,
N = x^(-d/2) M(t) with N''' = 4 S N' + 2 S' N, which is a recurrence over Q.

References: F. W. J. Olver, "Asymptotics and Special Functions" (1974), chapters 6 and 7; NIST DLMF, 2.7(ii) and 10.18.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from typing import Any

from flint import acb, acb_poly, arb, arb_poly, fmpq, fmpq_poly, fmpq_series

from kovacic.algebra.precision import series_length, working_precision
from kovacic.enclosure.classical import Classical, Closed
from kovacic.enclosure.frame import Frame, System, frequency, is_apart, largest_exponent, log2, make_frame
from kovacic.enclosure.frobenius import basis, junction
from kovacic.enclosure.log_derivative import LogDerivative, log_derivative
from kovacic.enclosure.matrices import (
    NOTHING,
    Affine,
    MapProduct,
    Matrix,
    State,
    adjugate,
    apply,
    fundamental,
    inverse_matrix,
    matrix_product,
    multiply,
    real_part,
)
from kovacic.enclosure.points import ExactPoint, Points, are_real, around_zero, binary_exponent, power_of_two, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.enclosure.singular import Singular
from kovacic.enclosure.splitting import is_split, legs
from kovacic.enclosure.start import recessive_rate
from kovacic.enclosure.taylor import expand
from kovacic.enclosure.way import (
    MAX_DISCS,
    Followed,
    Forecast,
    States,
    Step,
    Traveller,
    Way,
    cover,
    disc_step,
    position,
)
from kovacic.limits import check_time, count_work

_LOG = logging.getLogger(__name__)

#: Terms of the series for the amplitude: this number takes one or two seconds, twice as many take ten (measured).
_MOST_TERMS_OF_AMPLITUDE = 2000
#: Beyond the precision of a way, for the phase and for products.
_BITS_FOR_PRODUCTS = 40


def growth_of_disc(prec: int, *, alone: bool) -> float:
    """The bits by which the solutions may grow from the centre of a disc to its ends.

    They are fewer where the disc is kept: polynomials are shorter at its targets, and a value that is smaller than the others
    in the disc by more than the spare bits of the precision would need a second run.
    """
    return max(100.0, 0.2 * prec) if alone else max(30.0, 0.05 * prec)


def frames(
    system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True
) -> Iterator[tuple[ExactPoint, Frame, ExactPoint]]:
    """The discs that cover the straight way from a to b, with their ends: O(log(far/near)) of them for each singular point at
    a distance between near and far.  `alone` if only the state at the end is needed."""
    if a == b:
        return
    growth = growth_of_disc(prec, alone=alone)
    steepest = largest_exponent(system, a)
    e = binary_exponent((b - a).norm_squared()) if steepest is None else steepest
    # Scales are powers of two: 5/8 of the distance to a singular point allows one half.
    yield from cover(a, b, e, lambda centre, e, _: make_frame(system, centre, e, 0.625, growth))


def walk(
    system: System, a: ExactPoint, b: ExactPoint, prec: int, *, alone: bool = True, split: bool = False
) -> Iterator[tuple[ExactPoint, Frame, Step]]:
    """The discs of `frames` with the steps in them, `split` for matrices from binary splitting, which serve no targets."""
    _LOG.debug("from %s to %s, %d bits%s", a, b, prec, ", by binary splitting" if split else "")
    for number, (enter, frame, leave) in enumerate(frames(system, a, b, prec, alone=alone), 1):
        _LOG.debug("disc %d: centre %s, radius 2^%d", number, frame.centre, frame.e)
        count_work(prec)
        if split:
            step = Step(leave, partial(_split, system, frame, enter, leave, prec), _serves_none)
        else:
            step = disc_step(enter, leave, expand(frame, prec))
        yield enter, frame, step


def _split(system: System, frame: Frame, enter: ExactPoint, leave: ExactPoint, prec: int) -> Affine:
    start, stop = map(matrix_product, legs(system, frame, enter, leave, prec))
    return multiply(stop, adjugate(start)), NOTHING


def _serves_none(state: State) -> Followed:
    raise NotImplementedError("by splitting no targets are served but the end")


@dataclass(frozen=True)
class Oscillation:
    """Amplitude and phase on the half line sign * x >= edge, to about 2^-prec."""

    sign: int
    d: int
    c: Any
    T: Any
    edge: Any
    change: arb
    prec: int

    def reaches(self, x: ExactPoint) -> bool:
        """True if the point lies on the half line."""
        return x.is_real() and bool(self.sign * x.x >= self.edge)

    def fundamental(self, x: ExactPoint) -> Matrix:
        """w and dw/dx at a point of the half line."""
        abscissa = self.sign * x.x
        bits = self.prec + _BITS_FOR_PRODUCTS + max(0, int(_phase_bits(self.c, self.d, abscissa)))
        with working_precision(bits):
            t = 1 / arb(abscissa)
            # f = x^(d/2) T(1/x), and f' = x^(d/2) t (d/2 T - t T') with t = 1/x.
            head = _half_power(arb(abscissa), self.d)
            f = head * arb_poly(self.T)(t)
            slope = head * t * arb_poly(self.T * fmpq(self.d, 2) - self.T.derivative() * fmpq_poly([0, 1]))(t)
            # phi = kappa int x^(d/2) T(1/x) dx term by term; the power x^-1 gives the logarithm.
            kappa = arb(self.c).sqrt()
            phi = arb(0)
            for k, coefficient in enumerate(self.T.coeffs()):
                e = fmpq(self.d, 2) - k + 1
                phi += (arb(coefficient / e) * t**k) if e != 0 else arb(coefficient) * t**k * arb(abscissa).log()
            phi *= kappa * head * arb(abscissa)
            sin, cos = phi.sin_cos()
            y1 = cos / f.sqrt()
            y2 = sin / f.sqrt()
            share = slope / f / 2
            # w = f^(-1/2) (cos phi, sin phi), dw/d|x| = -f'/(2 f) w + kappa f f^(-1/2) (-sin phi, cos phi); f' is `slope`.
            dy1 = self.sign * (-share * y1 - kappa * f * y2)
            dy2 = self.sign * (-share * y2 + kappa * f * y1)
            return acb(y1), acb(y2), acb(dy1), acb(dy2)


def _is_worth_while(phase_bits: float, prec: int) -> bool:
    """True for four times as many radians as bits on the whole way, and more: with fewer, discs are as fast."""
    return phase_bits > math.log2(4 * prec)


def _phase_bits(c: Any, d: int, abscissa: Any) -> float:
    """About log2 of the phase at an abscissa."""
    return log2(arb(c)) / 2 + (d / 2 + 1) * log2(arb(abscissa)) - math.log2(d / 2 + 1)


def _half_power(x: arb, d: int) -> arb:
    """x^(d/2)."""
    return x ** (d // 2) if d % 2 == 0 else x ** ((d - 1) // 2) * x.sqrt()


def swing_from(system: System, near: ExactPoint, end: ExactPoint, prec: int) -> ExactPoint:
    """Where, on the way from `near` out to `end`, one step to the end may begin; the end itself if discs are to go there."""
    found = _towards(system, end, prec) if near.is_real() and end.is_real() else None
    if found is None or (abs(near.x) >= abs(end.x) and found.reaches(near)):
        return end
    edge = near if found.reaches(near) else ExactPoint(found.sign * found.edge)
    # The share of the phase at the end that lies between both: about as many radians are on the way.
    share = (end - edge).x / end.x
    is_long = share > 0 and _is_worth_while(_phase_bits(found.c, found.d, abs(end.x)) + log2(arb(share)), prec)
    return edge if is_long else end


def swing(system: System, a: ExactPoint, b: ExactPoint, prec: int) -> Step:
    """The step between two points of a half line, one of which `swing_from` gave for the other."""
    found = _towards(system, max(a, b, key=lambda point: abs(point.x)), prec)
    assert found is not None
    bits = prec + _BITS_FOR_PRODUCTS

    def local(state: State) -> Followed:
        count_work(prec)
        with working_precision(bits):
            C = apply(inverse_matrix(found.fundamental(a)), state)
            # |C| changes by at most (exp(I) - 1) |C|, over whichever part of the half line.
            error = (found.change * (abs(C[0]).upper() + abs(C[1]).upper())).upper()
        off = around_zero(error, real=are_real(C))
        constants = C[0] + off, C[1] + off

        def followed(x: ExactPoint) -> State:
            if not found.reaches(x):
                raise ArithmeticError("the target lies outside of its half line")
            with working_precision(bits):
                return apply(found.fundamental(x), constants)

        return followed

    def affine() -> Affine:
        return fundamental(*(local(start)(b) for start in ((acb(1), acb(0)), (acb(0), acb(1))))), NOTHING

    return Step(b, affine, local)


def _towards(system: System, end: ExactPoint, prec: int) -> Oscillation | None:
    """The solutions on the half line of the end, if amplitude and phase may be the faster way there."""
    d = len(system.num) - len(system.den)
    if d < -1 or not system.num:
        return None
    sign = 1 if end.x > 0 else -1
    # S(sign x) ~ -c x^d for x to infinity.
    c = -fmpq(system.num[-1], system.den[-1]) * sign ** abs(d)
    with working_precision(64):
        if c < 0 or not _is_worth_while(_phase_bits(c, d, abs(end.x)), prec):
            return None
    return _oscillation(system, sign, prec)


@lru_cache(maxsize=64)
def _oscillation(system: System, sign: int, prec: int) -> Oscillation | None:
    """The solutions on one half line; None if the series would be long."""
    d = len(system.num) - len(system.den)
    half = fmpq(d, 2)
    length = math.ceil((prec / 4 + 10) * (d / 2 + 1))  # enough at twice the least phase at which the series is so sharp
    if length > _MOST_TERMS_OF_AMPLITUDE:
        return None
    num, den = ([fmpq(v) * sign**k / system.den[-1] for k, v in enumerate(part)] for part in (system.num, system.den))
    num, den = ([v * sign ** (len(den) - 1) for v in part] for part in (num, den))  # S(sign x), and den with the head 1
    c = -num[-1]
    with series_length(length):
        T = fmpq_poly((1 / fmpq_series(_modulus(num, den, half, length), prec=length)).coeffs())
    t = fmpq_poly([0, 1])
    # Up to a factor U and V are f' and f'' [see above]: x d/dx is -t d/dt.
    U = T * half - t * T.derivative()
    V = U * (half - 1) - t * U.derivative()
    n, D = (fmpq_poly(part[::-1]) for part in (num, den))
    E = D * (T**4 * -c + t ** (d + 2) * (U * U * fmpq(3, 4) - T * V / 2)) - n * T * T
    with working_precision(64):
        sizes = [[abs(arb(v)) for v in part.coeffs()] for part in (E, T, D)]
        # Farther out where there are singular points.
        e = int((math.log2(prec) - 1 - _phase_bits(c, d, fmpq(1))) / (d / 2 + 1))
        while (change := _change(sizes, c, d, arb((1, e)))) is None or not change < arb((1, -prec)):
            check_time()
            e += 1
    return Oscillation(sign, d, c, T, power_of_two(e), change, prec)


def _modulus(num: Sequence[Any], den: Sequence[Any], half: Any, length: int) -> list[Any]:
    """M from A N''' = B N' + G N with A = den^2, B = 4 num den and G = 2 (num' den - num den')."""
    # S = p/q in N''' = 4 S N' + 2 S' N, times q^2; the coefficient of each power of x gives one of N.
    p, q = fmpq_poly(list(num)), fmpq_poly(list(den))
    A = q * q
    B = p * q * 4
    G = (p.derivative() * q - p * q.derivative()) * 2
    top = B.degree()
    d = top - A.degree()
    found = [fmpq(1)]
    for k in range(1, length):
        check_time()
        total = fmpq(0)  # of x^(top - 1 - half - k), and found[j] goes with x^r
        for j in range(max(0, k - top), k):
            r = -half - j
            total += found[j] * (B[top + j - k] * r + G[top - 1 + j - k])
        for j in range(max(0, k - d - 2 - A.degree()), k - d - 1):
            r = -half - j
            total -= found[j] * A[j + d + 2 + A.degree() - k] * r * (r - 1) * (r - 2)
        found.append(-total / (B[top] * (-half - k) + G[top - 1]))
    return found


def _change(sizes: Sequence[Sequence[arb]], c: Any, d: int, x: arb) -> arb | None:
    """A bound of exp(I) - 1 from x on, from the absolute values of the coefficients of E, T and D; None if there is none."""
    t = 1 / x
    E, T, D = sizes
    T_least, D_least = (1 - sum((v * t**k for k, v in enumerate(part) if k), arb(0)) for part in (T, D))
    if not (T_least > 0 and D_least > 0):
        return None
    # |S~ - S|/(sqrt(c) f) = x^(d/2) |E|/(sqrt(c) D T^3), integrated from x on: x^(d/2 - k) gives
    # x^(d/2 - k + 1)/(k - d/2 - 1).
    powers = ((v / (k - arb(d) / 2 - 1)) * t**k for k, v in enumerate(E) if v != 0)
    integral = sum(powers, arb(0)) * _half_power(x, d) * x / (arb(c).sqrt() * D_least * T_least**3)
    return (integral.exp() - 1).upper() if integral < 1 else None


@dataclass(frozen=True, eq=False)
class RationalWay(Way):
    """The user's equation without a right-hand side, in discs of its normal form."""

    problem: NumericProblem

    @cached_property
    def gauge(self) -> LogDerivative:
        """gamma: zero for a normal form, and its growth 1."""
        return log_derivative(self.problem.gauge)

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        self.problem.check_segment(a, b)

    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        system = self.problem.system
        enter, leave = self._in_discs(a, b)
        # A disc of growth g bits, on either side of its centre, has int |S|^(1/2) below 2 (g + 10) log 2.
        in_a_disc = 2 * (growth_of_disc(self.prec, alone=True) + 10) * math.log(2)
        found = Forecast(enter, leave, frequency(system), in_a_disc)
        e = largest_exponent(system, enter)
        if e is not None and power_of_two(2 * e) * MAX_DISCS**2 < (leave - enter).norm_squared():
            found.refuse()  # too many steps, were all as short as the first one has to be
        return found

    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[Step]:
        system = self.problem.system
        split = alone and is_split(system, self.prec, a, b)
        enter, leave = self._in_discs(a, b)
        if enter != a:
            yield swing(system, a, enter, self.prec)
        yield from (step for *_, step in walk(system, enter, leave, self.prec, alone=alone, split=split))
        if leave != b:
            yield swing(system, leave, b, self.prec)

    def _in_discs(self, a: ExactPoint, b: ExactPoint) -> tuple[ExactPoint, ExactPoint]:
        """The part of the way that goes by discs: far out, solutions that oscillate are known by amplitude and phase."""
        system = self.problem.system
        return swing_from(system, b, a, self.prec), swing_from(system, a, b, self.prec)

    def into(self, x: ExactPoint) -> Matrix:
        # y = z/g, y' = (z' - gamma z)/g, up to the factor 1/g(x).
        return acb(1), acb(0), -self.gauge.value(to_acb(x)), acb(1)

    def out_of(self, a: ExactPoint, x: ExactPoint) -> Matrix:
        E = self.gauge.growth(to_acb(a), to_acb(x))
        if a.is_real() and x.is_real():
            E = acb(E.real)
        # z = E y, z' = E (y' + gamma y), with E = g(x)/g(a).
        return E, acb(0), E * self.gauge.value(to_acb(x)), E

    def around(self, ball: acb) -> tuple[acb, acb, acb, bool]:
        # a y'' + b y' + c y = 0 over a, with the coefficients of the user's equation.
        top, first, last = (acb_poly(poly)(ball) for poly in self.problem.equation)
        return first / top, last / top, acb(0), True

    def decay_rate(self, x: ExactPoint) -> acb:
        prec = self.prec + 20
        normal = replace(self.problem, gauge=self.problem.gauge * 0)
        rate = recessive_rate(RationalWay(normal, prec=prec), self.problem.system, x, prec)
        return rate + self.gauge.value(to_acb(x))

    def departure(self, point: Singular, stop: ExactPoint, needed: tuple[bool, bool]) -> tuple[ExactPoint, Matrix]:
        last, bound = junction(point, stop, self.prec)
        return last, basis(point, last, stop, bound, self.prec, needed=needed)

    def fan(self, traveller: Traveller, stops: Points) -> States:
        here = traveller.here
        found: States = {}
        ends = stops if isinstance(here, Singular) else [here, *stops]
        # By splitting every target has a way of its own; it has to pay although nothing is shared.
        is_far = is_split(self.problem.system, self.prec // len(stops), *ends)
        if is_far or isinstance(here, Singular):
            for first, *others in sides(here, stops):
                found |= traveller.moved(first).fan([first, *others])
            return found
        if here.is_real() and all(stop.is_real() for stop in stops):
            return traveller.along_rays(stops)
        return self._by_discs(traveller, here, stops)

    def _by_discs(self, traveller: Traveller, here: ExactPoint, stops: Points) -> States:
        """Along the line to the farthest stop, again and again: the discs on it serve others, too."""
        system, places = self.problem.system, self.problem.places
        found: States = {}
        waiting = sorted(set(stops), key=lambda stop: (stop - here).norm_squared())
        inward = self.into(here)
        while waiting:
            farthest = waiting[-1]
            self.check(here, farthest)
            maps = traveller.maps.after(inward)
            ahead = self.forecast(here, farthest)
            for number, (enter, frame, step) in enumerate(walk(system, here, farthest, self.prec), 1):
                # Those in the disc to which it carries a solution from here as the straight line does: without a singular
                # point in the triangle, both ways are homotopic.  The end is reached along the way itself.
                square = frame.scale**2
                served = [
                    stop
                    for stop in waiting
                    if stop == step.leave
                    or ((stop - frame.centre).norm_squared() <= square and is_apart(places, here, enter, stop))
                ]
                if served:
                    local = step.local(maps.apply(traveller.start))
                    for stop in served:
                        found[stop] = apply(self.out_of(here, stop), local(stop))
                    waiting = [stop for stop in waiting if stop not in found]
                if step.leave != farthest:  # the matrix of the last step isn't needed
                    maps = maps.after(*step.affine())
                    ahead.check(number)
        return found


@dataclass(frozen=True, eq=False)
class ClosedWay(RationalWay):
    """A way by a closed form of the solutions of the normal form, in one step to each target."""

    closed: Closed | None = None

    def carried(self, a: ExactPoint, b: ExactPoint, maps: MapProduct) -> MapProduct:
        assert self.closed is not None
        check_time()
        count_work(self.prec)
        self.check(a, b)
        matrix = self.closed.leg(a, b)
        if a.is_real() and b.is_real():
            matrix = real_part(matrix)
        return maps.after(multiply(self.out_of(a, b), multiply(matrix, self.into(a))))

    def fan(self, traveller: Traveller, stops: Points) -> States:
        return traveller.to_each(stops)

    def departure(self, point: Singular, stop: ExactPoint, needed: tuple[bool, bool]) -> tuple[ExactPoint, Matrix]:
        assert isinstance(self.closed, Classical)
        check_time()
        count_work(self.prec)
        return stop, self.closed.frobenius(point, self.problem.gauge, needed, stop)


def way_for(problem: NumericProblem) -> Way:
    """The way of an equation with rational coefficients."""
    if problem.right is None and problem.is_rational:
        return RationalWay(problem)
    from kovacic.enclosure.analytic import way_of  # imports SymPy

    return way_of(problem)


def side_of(here: ExactPoint, stop: ExactPoint) -> bool | None:
    """True for a stop to the right on the real axis, False to the left; None unless both points lie on it."""
    return bool(stop.x >= here.x) if here.is_real() and stop.is_real() else None


def sides(here: ExactPoint | Singular, stops: Points) -> list[list[ExactPoint]]:
    """The stops by straight ways that are shared: those on the same side on the real axis, in the order of visit (from
    infinity the farthest first), and each of the others alone."""
    origin, is_inverted = (here.near, here.inverted) if isinstance(here, Singular) else (here, False)
    groups: dict[Any, list[ExactPoint]] = {}
    for stop in sorted(stops, key=lambda stop: position(origin, stop), reverse=is_inverted):
        side = side_of(origin, stop)
        groups.setdefault(stop if side is None else side, []).append(stop)
    return list(groups.values())

"""Ways of equations y'' + b y' + c y = f whose coefficients are analytic functions of x.

A way is covered by discs around points of it (`kovacic.enclosure.jets`).  In each of them balls that contain twice the disc
show that the coefficients are analytic: a pole or a branch point on the way is never passed, since no disc contains it.  Discs
become smaller towards one; the way is refused once they would be as small as 2^-60 of the way on either side.

If the coefficients have values at an end of the way but aren't analytic there, as sqrt(x) at 0, a short piece next to it is
bounded: with |b| <= B, |c| <= C and |f| <= F on a piece of length r, for any s > 0 the vector (y, s y') has the derivative
(s y'/s, -b (s y') - s c y + s f), and where 1/s >= B + s C it changes by at most

    (exp(r/s) - 1) (max(|y|, s |y'|) + s^2 F)    [Gronwall].                                                               (1)

Two kinds of equations have steps over any distance.  Constant coefficients, and a right-hand side of powers, exponentials and
waves: one step to every target.  For f = sum P(x) exp(alpha x) the functions P^(k)(x) exp(alpha x) form a vector g with
g' = J g, and f = w g is the sum of those with k = 0.  On the way from u to v

    (y, y', g)' = A (y, y', g),    A = (0, 1, 0; -c, -b, w; 0, 0, J),    (y, y', g)(v) = exp((v - u) A) (y, y', g)(u).

FLINT's exponential of a matrix is a ball around the exact one.

Coefficients with a common period T: any number of periods in one step.  With the map P from the state at a to that at a + T,
affine where there is a right-hand side, and R from a to a + r, the map to a + n T + r is R P^n [Floquet].  T is known by a
ball: discs lead to the midpoint of a + T, and its state is spread over the ball.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import sympy
from flint import acb, acb_mat, acb_poly, arb, ctx, fmpq

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.precision import working_precision
from kovacic.closed_form.atoms import Atoms
from kovacic.enclosure.frame import upper_exponent
from kovacic.enclosure.jets import CoefficientField, Jets, step_of
from kovacic.enclosure.matrices import NOTHING, Affine, MapProduct, Matrix, State, compose, fundamental, real_part
from kovacic.enclosure.points import (
    Constant,
    ExactPoint,
    Number,
    Points,
    are_real,
    around_zero,
    binary_exponent,
    in_balls,
    middle,
    power_of_two,
    to_acb,
    to_ball,
)
from kovacic.enclosure.problem import Coefficients, NumericProblem, cleared, root_of
from kovacic.enclosure.way import Followed, Forecast, States, Step, Traveller, Way, cover, spread
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import check_time, count_work

# Steps as small as 2^-60 of the ways behind and ahead mean that there is a singular point.
_SMALLEST_STEP_BITS = 60
# Periods from which on they are taken in one step; one of them may lead beyond a way from 5/4 to 3/4, to a pole of tan(x).
_FEWEST_PERIODS = 4
_PERIODIC = (sympy.sin, sympy.cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc, sympy.exp)
# Length of g.  At 20 the matrices take as long as the discs to x = 20 (y'' + y = x^19, 15 ms), at 40 five times as long.
_MOST_RIGHT_TERMS = 20
_MOST_LOST_BITS = 10_000  # on a long way: 2.6 s there with three terms, and 44 s with 40,000 bits


def _edge(functions: CoefficientField, enter: ExactPoint, leave: ExactPoint) -> Step:
    """A short piece on which (1) bounds the change of a solution; raises InputError unless the coefficients have bounds."""
    middle = to_acb((enter + leave).scaled(fmpq(1, 2)))
    length = abs(to_acb(leave - enter)).upper()
    real = enter.is_real() and leave.is_real()
    values = functions.values(middle + around_zero(length, real=real))
    if not all(value.is_finite() for value in values):
        raise InputError(f"the coefficients have no bound near {enter} or {leave}, an end of the path")
    # The coefficients are analytic inside the piece, so real on all of it where they are on a part.
    real = real and are_real(functions.values(middle + arb(0, length / 8)))
    b, c, _ = values

    def affine() -> Affine:
        starts = (acb(1), acb(0)), (acb(0), acb(1))
        matrix = fundamental(*(spread((b, c, acb(0)), length, start, real=real) for start in starts))
        return matrix, spread(values, length, NOTHING, real=real)

    def local(state: State) -> Followed:
        everywhere = spread(values, length, state, real=real and are_real(state))
        return lambda _: everywhere

    return Step(leave, affine, local)


@dataclass(frozen=True, eq=False)
class AnalyticWay(Way):
    """An equation by the power series of its coefficients and its right-hand side.

    `problem` has its left-hand side if that is rational: then its singular points are known.
    """

    functions: CoefficientField
    problem: NumericProblem | None = None

    @property
    def steepest(self) -> float:
        """The largest lambda of a disc, in which solutions grow by exp(lambda)."""
        return max(40.0, 0.15 * self.prec)

    @property
    def is_exact(self) -> bool:
        return self.functions.coefficients.is_exact

    def check(self, a: ExactPoint, b: ExactPoint) -> None:
        if self.problem is not None:
            self.problem.check_segment(a, b)
        # Between the ends the discs decide; at the ends values are enough.
        undefined = "the coefficients have" if self.problem is None else "the right-hand side has"
        for end in (a, b):
            if not all(value.is_finite() for value in self.functions.values(to_acb(end))):
                said = f"{undefined} no value at {end}, an end of the path"
                raise InputError(said, hint="choose a point beside it")

    def forecast(self, a: ExactPoint, b: ExactPoint) -> Forecast:
        def rate(x: acb) -> float:
            # About lambda of `kovacic.enclosure.jets` over the scale: max(|b|, |c|^(1/2)).
            b_value, c_value, _ = self.functions.values(x)
            return float(abs(b_value).max(abs(c_value).sqrt()).mid())

        e = (binary_exponent((b - a).norm_squared()) + 1) // 2
        found = Forecast(a, b, rate, 2 * self.steepest, lambda x: self.functions.crowd(x, e, self.steepest))
        found.refuse()
        return found

    def horizon(self, here: ExactPoint, stop: ExactPoint) -> ExactPoint:
        """The stop itself where the coefficients aren't analytic there."""
        return super().horizon(here, stop) if self.functions.is_regular(to_acb(stop)) else stop

    def around(self, ball: acb) -> tuple[acb, acb, acb, bool]:
        b, c, f = self.functions.values(ball, analytic=True)
        return b, c, f, are_real(self.functions.values(ball))

    def walk(self, a: ExactPoint, b: ExactPoint, *, alone: bool = False) -> Iterator[Step]:
        # The length of a piece at an end where the coefficients aren't analytic, as a share of the way.
        edge = power_of_two(-self.prec - 16)
        length = b - a
        first = a if self.functions.is_regular(to_acb(a)) else a + length.scaled(edge)
        last = b if self.functions.is_regular(to_acb(b)) else b - length.scaled(edge)
        if first != a:
            yield _edge(self.functions, a, first)

        def fits(centre: ExactPoint, e: int, enter: ExactPoint) -> Jets | None:
            jets = self.functions.jets(centre, e, self.prec, self.steepest)
            # Nothing lies behind the first disc: there 2^-least of the way counts.
            least = max(512, 2 * self.prec)
            behind = max((enter - first).norm_squared(), (last - first).norm_squared() / power_of_two(2 * least))
            shortest = min(behind, (last - enter).norm_squared())
            if jets is None and power_of_two(2 * (e + _SMALLEST_STEP_BITS)) < shortest:
                raise _not_analytic(enter, first)
            return jets

        for enter, jets, leave in cover(first, last, binary_exponent(length.norm_squared()), fits):
            count_work(self.prec)
            yield step_of(jets, enter, leave)
        if last != b:
            yield _edge(self.functions, last, b)


def _not_analytic(point: ExactPoint, start: ExactPoint) -> InputError:
    """The error for steps so small compared with the ways behind and ahead that there must be a singular point."""
    where = to_acb(point)
    with working_precision(64):
        shown = (where.real if where.imag.is_zero() else where).str(10, radius=False)
    return InputError(
        f"the coefficients aren't known to be analytic near {shown}, on the path from {start}",
        hint="stay on one side of it, or evaluate along path=[...], with a vertex off the axis; the result depends on "
        "where it passes",
        shell="stay on one side of it",
    )


@dataclass(frozen=True, eq=False)
class PeriodicWay(AnalyticWay):
    """An equation all of whose coefficients have the `period`, an expression."""

    period: Any = None
    _maps: dict[Any, Affine] = field(default_factory=dict, init=False)

    def _length(self) -> arb:
        return abs(in_balls(self.period, self.functions.coefficients.at(sympy.Integer(0))))

    def _periods(self, a: ExactPoint, b: ExactPoint) -> int:
        """The approximate number of whole periods from a to b, negative to the left; 0 off the real axis."""
        if not (a.is_real() and b.is_real()):
            return 0
        with working_precision(64 + (b - a).height_bits()):
            # Rounded down, also to the left: the rest of the way goes to the right, and is shorter than a period.
            return int((arb((b - a).x) / self._length()).mid().floor().unique_fmpz())

    def carried(self, a: ExactPoint, b: ExactPoint, maps: MapProduct) -> MapProduct:
        n = self._periods(a, b)
        if abs(n) < _FEWEST_PERIODS:
            return super().carried(a, b, maps)
        # If P isn't diagonal, P^m is of the size m, and its square loses log2(m) bits and some more; n T loses those of n.
        squares = n.bit_length()
        lost = squares * (squares + 12) // 2
        with working_precision(ctx.prec + lost):
            way = replace(self, prec=self.prec + lost)
            step = self._length() * (1 if n > 0 else -1)
            key = a, n > 0, lost
            if key not in self._maps:
                self._maps[key] = way._map(a, Constant("a period later", lambda: to_acb(a) + step))
            period = self._maps[key]
            power = period
            # P^|n| by the binary digits of |n| after the first one.
            for bit in bin(abs(n))[3:]:
                power = compose(power, power)
                power = compose(period, power) if bit == "1" else power
            rest = way._map(a, Constant("less than a period later", lambda: to_acb(b) - step * abs(n)))
            return maps.after(*compose(rest, power))

    def _map(self, a: ExactPoint, number: Constant) -> Affine:
        """The map from the state at a to that at a number in a ball."""
        stop = middle(number)
        maps = MapProduct() if stop == a else super().carried(a, stop, MapProduct())
        M, particular = maps.whole()
        # M = (m11, m12, m21, m22): its columns are solutions, and so is the particular one.
        first, second, own = (self.spread(number, v) for v in ((M[0], M[2]), (M[1], M[3]), particular))
        return fundamental(first, second), own

    def fan(self, traveller: Traveller, stops: Points) -> States:
        here = traveller.point
        periods = {stop: abs(self._periods(here, stop)) for stop in stops}
        if max(periods.values()) < _FEWEST_PERIODS + len(stops):  # discs on the way serve all of them
            return super().fan(traveller, stops)
        return traveller.to_each(stops)


def period_of(coefficients: Coefficients) -> Any:
    """A period of functions of waves with commensurable frequencies, or None."""
    x = coefficients.variable
    waves = sorted({e for part in coefficients.all_parts for e in part.atoms(*_PERIODIC) if e.has(x)}, key=str)
    known = {e: sympy.Dummy() for e in waves}
    if not waves or any(part.xreplace(known).has(x) for part in coefficients.all_parts):
        return None
    # Of sin(r x + s) and of exp(i (r x + s)): r.
    rates = [e.args[0].diff(x) / (sympy.I if e.func is sympy.exp else 1) for e in waves]
    shares = [sympy.simplify(rate / rates[0]) for rate in rates]
    if rates[0].has(x) or not all(share.is_Rational for share in shares):
        return None
    # All rates are multiples of rates[0] gcd(shares), and with tan and cot this is a period, too.
    period = 2 * sympy.pi / (rates[0] * sympy.gcd(shares))
    value = in_balls(period, coefficients.at(to_ball(ExactPoint(0))))
    return period if value.is_finite() and value.imag.is_zero() and not value.contains(0) else None


ExponentialTerm = tuple[Any, tuple[Any, ...]]


@dataclass(frozen=True, eq=False)
class ConstantWay(AnalyticWay):
    """An equation with constant coefficients, whose right-hand side is the sum of the `terms` exp(alpha x) P(x): alpha, and the
    coefficients of P from low to high."""

    terms: tuple[ExponentialTerm, ...] = ()

    def carried(self, a: ExactPoint, b: ExactPoint, maps: MapProduct) -> MapProduct:
        check_time()
        count_work(self.prec)
        self.check(a, b)
        start = to_acb(a)
        values = self.functions.coefficients.at(start)
        p, q, _ = self.functions.values(start)
        size = 2 + sum(len(polynomial) for _, polynomial in self.terms)
        A, begin = acb_mat(size, size), acb_mat(size, 1)  # the latter is (0, 0, g(a))
        # y' = y', y'' = -q y - p y' + f.
        A[0, 1], A[1, 0], A[1, 1] = acb(1), -q, -p
        row = 2
        for alpha, polynomial in self.terms:
            rate = in_balls(alpha, values)
            P = acb_poly([in_balls(weight, values) for weight in polynomial])
            A[1, row] = acb(1)
            for k in range(len(polynomial)):
                if k > 0:  # (P^(k-1) exp(alpha x))' = alpha P^(k-1) exp(alpha x) + P^(k) exp(alpha x)
                    A[row - 1, row] = acb(1)
                A[row, row] = rate
                begin[row, 0] = P(start) * (rate * start).exp()
                P = P.derivative()
                row += 1
        # (b - a) A is halved until it is small; then each of as many squarings makes the ball a few times as wide.
        growth = sum((abs(entry) for entry in A.entries()), arb(1)) * abs(to_acb(b - a))
        lost = 4 * max(0, upper_exponent(growth))
        if lost > _MOST_LOST_BITS:
            raise LimitExceeded(f"the way is so long that values lose {lost} bits", limit="digits")
        with working_precision(ctx.prec + lost):
            E = (A * to_acb(b - a)).exp()
            particular = E * begin
        matrix: Matrix = (E[0, 0], E[0, 1], E[1, 0], E[1, 1])
        first, second = particular[0, 0], particular[1, 0]
        if a.is_real() and b.is_real() and self.functions.is_real(a, 0):
            matrix = real_part(matrix)
            first, second = acb(first.real), acb(second.real)
        return maps.after(matrix, (first, second))

    def fan(self, traveller: Traveller, stops: Points) -> States:
        return traveller.to_each(stops)


def constant_way(coefficients: Coefficients, problem: NumericProblem | None = None) -> AnalyticWay:
    """The way by matrices if there is one, else by power series, many periods at a time if the coefficients are periodic."""
    functions = CoefficientField(coefficients)
    x = coefficients.variable
    a, b, c, f = coefficients.all_parts
    terms = None if any(part.has(x) for part in (a, b, c)) else _right_side_terms(f, x)
    if terms is not None:
        return ConstantWay(functions, problem, terms=terms)
    period = period_of(coefficients)
    return AnalyticWay(functions, problem) if period is None else PeriodicWay(functions, problem, period=period)


def _right_side_terms(f: Any, x: Any) -> tuple[ExponentialTerm, ...] | None:
    """The terms of a right-hand side, or None if it has others or too many.

    The logarithmic derivative of w x^k exp(alpha x) is alpha + k/x; a constant quotient w proves that a term is one.
    """
    polynomials: dict[Any, Any] = {}
    for term in (part for part in sympy.Add.make_args(sympy.expand(f.rewrite(sympy.exp))) if part != 0):
        rate = sympy.expand(term.diff(x) / term)
        k = rate.coeff(x, -1)
        alpha = sympy.expand(rate - k / x)
        weight = term / (x**k * sympy.exp(alpha * x))
        if alpha.has(x) or weight.has(x) or not (k.is_Integer and k >= 0):
            return None
        polynomials[alpha] = polynomials.get(alpha, 0) + weight * x**k
    found = [(alpha, tuple(sympy.Poly(P, x, domain="EX").all_coeffs()[::-1])) for alpha, P in polynomials.items()]
    return tuple(found) if sum(len(polynomial) for _, polynomial in found) <= _MOST_RIGHT_TERMS else None


@lru_cache(maxsize=32)
def way_of(problem: NumericProblem) -> AnalyticWay:
    """The way of an equation with rational coefficients and a right-hand side, or with constants known by balls."""
    equation = problem.right
    if equation is None:
        atoms = _Letters(sympy.Symbol("the variable"))  # no parameter has this name
        a, b, c = map(atoms.ratio, problem.cleared)
        f = sympy.Integer(0)
    else:
        atoms = _Letters(sympy.Symbol(equation.variable))
        one = equation.a * 0 + 1
        a, b, c, f, common = map(atoms.ratio, cleared(equation.a, equation.b, equation.c, equation.f, one))
        if equation.h is not None:
            f += common * equation.h.xreplace({s: sympy.Symbol(s.name) for s in equation.h.free_symbols})
    # Only a constant is divided by: over a polynomial b and c would be quotients, whose series are wider.
    if not a.has(atoms.x):
        a, b, c, f = sympy.Integer(1), b / a, c / a, f / a
    values = {**atoms.constants, **problem.values}
    return constant_way(Coefficients(atoms.x, b, c, f, tuple(sorted(values.items())), a=a), problem)


class _Letters(Atoms):
    """Atoms with the generators of algebraic fields as symbols, whose values by their names are `constants`."""

    @cached_property
    def constants(self) -> dict[str, Number]:
        return {}

    def generator(self, field: Any) -> Any:
        assert isinstance(field, AlgebraicField)
        self.constants[field.name] = Constant(field.name, lambda: root_of(field))
        return sympy.Symbol(field.name)

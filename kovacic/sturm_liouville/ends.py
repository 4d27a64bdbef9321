"""The initial data of the solution of an end: values at the end, a Frobenius series, or bounds at a cut.

At a regular end the condition gives Y and Y'.  At a regular singular one, where t^2 (Q - E W) = G(t) is analytic in the
distance t, the principal solution is t^s (1 + a_1 t + ...) with s = 1/2 + sqrt(1/4 + G(0)).  At all others Q - E W is
to be positive from the end to a cut: there the principal solution has Y'/Y between 0 and the direction of growth,
infinitely steep, and between sqrt(m) and sqrt(M) in that direction where m <= Q - E W <= M is known.  So its angle
lies between those of two solutions, and the counts that belong to these are an upper and a lower bound of the count
(the angle at the other end is monotonic in the one at the cut).

Lower bounds of an elementary function on a half-line [c, oo), proven in interval arithmetic with infinite ends.

>>> import sympy
>>> x = sympy.Symbol("x")
>>> round(float(lower_bound(x**4 - 20*x**2, x, sympy.Integer(5))), 9)  # x^4 (1 - 20/x^2)
125.0
>>> float(lower_bound(sympy.cosh(x) - x**2, x, sympy.Integer(4))) > 11
True
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import zip_longest
from operator import mul
from typing import Any

import mpmath
import sympy
from flint import acb, arb, ctx
from mpmath.ctx_iv import MPIntervalContext
from sympy.printing.pycode import MpmathPrinter
from sympy.simplify.fu import TR1, TR2

from kovacic.algebra.precision import working_precision
from kovacic.closed_form.jets import BallEvaluator
from kovacic.closed_form.order import ball, dyadic_midpoint
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import check_time
from kovacic.sturm_liouville.discs import germ, size_bound, taylor_coefficients
from kovacic.sturm_liouville.problem import Robin, Span, Stretch, SturmProblem, Wish, kept, plain

_INFINITY = arb.pos_inf()
#: Intervals whose ends may be infinite.
_INTERVALS = MPIntervalContext()
_INTERVALS.prec = 100
_QUARTER_TURN = _INTERVALS.pi / 2

_HYPERBOLIC = [sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth, sympy.sech, sympy.csch]


def lower_bound(e: Expr, x: Expr, c: Expr, *, derivatives: int = 4) -> Any:
    """A number (an exact arb, maybe -oo) that isn't above any value of e on [c, oo).

    The expression as it stands, or with its dominant term as a factor where that isn't positive; and, where its derivative
    isn't negative, its value at c: cosh(x) - x^2 needs three derivatives.
    """
    simple = _direct(e, x, c)
    best = simple if simple > 0 else simple.max(_dominated(e, x, c))
    if best > -_INFINITY or derivatives == 0:
        return best
    slope = lower_bound(sympy.expand(e.diff(x)), x, c, derivatives=derivatives - 1)
    if slope >= 0:
        value = BallEvaluator({x: BallEvaluator({})(c)})(e).real
        if value.is_finite():
            return value.lower()
    return -_INFINITY


def _direct(e: Expr, x: Expr, c: Expr) -> Any:
    """The lower end of the range of e as it stands; -oo where it has functions that aren't known here."""
    start = _INTERVALS.mpf(int(c.p)) / int(c.q)
    try:
        found = sympy.lambdify(x, e, [_FUNCTIONS], printer=_PRINTER)(_INTERVALS.mpf([start.a, mpmath.inf]))
    except (AttributeError, NameError, TypeError, ValueError):
        return -_INFINITY
    found = _INTERVALS.convert(found)  # a constant is none of these numbers
    sign, mantissa, exponent, _ = found._mpi_[0]
    if mantissa == 0 and exponent:  # infinite, or unknown
        return _INFINITY if found.a == mpmath.inf else -_INFINITY
    return (arb(-mantissa if sign else mantissa) * arb(2) ** exponent).lower()


def _atan(v: Any) -> Any:
    """The range of an arctangent, pi/2 - 1/v < atan(v) < pi/2 for v > 0."""
    least = _QUARTER_TURN - 1 / v if v.a > 0 else -_QUARTER_TURN
    return _INTERVALS.mpf([least.a, _QUARTER_TURN.b])


#: Interval versions of mpmath's functions and constants.
_FUNCTIONS = {
    **{name: getattr(_INTERVALS, name) for name in ("mpf", "exp", "log", "sqrt", "sin", "cos", "pi", "e")},
    "sinh": lambda v: (_INTERVALS.exp(v) - _INTERVALS.exp(-v)) / 2,
    "cosh": lambda v: (_INTERVALS.exp(abs(v)) + _INTERVALS.exp(-abs(v))) / 2,
    "tanh": lambda v: 1 - 2 / (_INTERVALS.exp(2 * v) + 1),
    "atan": _atan,
}
#: As for mpmath: rational numbers are quotients of its numbers.
_PRINTER = MpmathPrinter({"fully_qualified_modules": False, "inline": True, "allow_unknown_functions": True})


def _dominated(e: Expr, x: Expr, c: Expr) -> Any:
    """num/den, each as its dominant term times 1 plus quotients of terms; for hyperbolic functions in exponentials."""
    parts = sympy.fraction(sympy.together(e.rewrite(_HYPERBOLIC, sympy.exp)))
    far = BallEvaluator({x: BallEvaluator({})(c) + 2**20})
    dominant, sums = [], []
    for part in parts:
        terms = sympy.Add.make_args(sympy.expand(part))
        dominant.append(max(terms, key=lambda term: abs(far(term)).mid()))
        sums.append(sympy.Add(*(sympy.powsimp(term / dominant[-1]) for term in terms)))
    return _direct(sympy.powsimp(dominant[0] / dominant[1]) * sums[0] / sums[1], x, c)


Expr = Any
StartValues = tuple[Any, Any]


@dataclass(frozen=True)
class RegularEnd:
    """alpha Y + beta Y' = 0 at a point at which Q and W are analytic; `inwards` is the sign of the direction."""

    at: Expr
    alpha: Expr
    beta: Expr
    inwards: int
    threshold = None

    def position(self, span: Span, digits: int) -> Any:
        return ball(self.at)

    def state(self, E: Any, span: Span, at: Any, *, high: bool) -> StartValues:
        """(beta, -alpha) up to a sign, with Y >= 0 near the end."""
        u, v = ball(self.beta), -ball(self.alpha)
        sign = -1 if u < 0 or (u == 0 and v * self.inwards < 0) else 1
        return sign * u, sign * v


@dataclass(frozen=True)
class SingularEnd:
    """The principal solution at a regular singular point: G is t^2 Q, H is t^2 W, with H(0) = 0, for t below `reach`."""

    at: Expr
    t: Expr
    G: Expr
    H: Expr
    inwards: int
    reach: Any
    threshold = None

    @cached_property
    def square(self) -> Expr:
        """nu^2 = 1/4 + G(0), exactly; the exponents are 1/2 +- nu."""
        return sympy.simplify(self.G.subs(self.t, 0) + sympy.Rational(1, 4))

    @kept
    def _radius(self, top: Any) -> Any:
        """R with pi sqrt(M) <= 2, where M bounds |G - G(0)| + |E H| in the disc; the series is used at R/4."""
        radius = arb(1) * 2**20
        while radius > arb(1) / 2**180:  # below, no radius is likely to do
            M = self._variation(radius, top)
            if M.is_finite() and 5 * M <= 2 and radius < self.reach:
                return radius
            radius = radius / 2
        raise InputError(f"the coefficients aren't known to be meromorphic at {self.at}")

    def _variation(self, radius: Any, top: Any) -> Any:
        G = self.G - self.G.subs(self.t, 0)
        return size_bound(G, self.t, arb(0), radius) + top * size_bound(self.H, self.t, arb(0), radius)

    def position(self, span: Span, digits: int) -> Any:
        return ball(self.at) + self.inwards * self._radius(span.size) / 4

    def state(self, E: Any, span: Span, at: Any, *, high: bool) -> StartValues:
        """Without the factor t^s.  n (n + 2 nu) a_n = sum of (G - E H)_k a_(n-k) over k > 0, and n (n + 2 nu) >= n^2.

        |a_n| R^n =: b_n <= (M/n^2) (b_0 + ... + b_(n-1)), and the product of all 1 + M/n^2 is at most exp(pi sqrt M).
        With pi sqrt(M) <= 2 the terms beside 1 sum up to less than 1 at t = R/4, so that there is no zero up to there.
        """
        radius = self._radius(span.size)
        t = radius / 4
        terms = ctx.prec // 2 + 20
        G = taylor_coefficients(self.G, self.t, arb(0), terms)
        H = taylor_coefficients(self.H, self.t, arb(0), terms)
        nu = ball(self.square).sqrt() if self.square != 0 else arb(0)
        S = [(g - E * h) * t**k for k, (g, h) in enumerate(zip_longest(G, H, fillvalue=arb(0)))]
        a = [arb(1)]
        for n in range(1, terms):
            a.append(sum(map(mul, S[1:], reversed(a)), arb(0)) / (n * (n + 2 * nu)))
        rest = arb(0, (8 * self._variation(radius, span.size) / arb(4) ** terms).upper())  # (4/3) M exp(2) / N < 8 M
        u = sum(a) + rest
        v = (arb(1) / 2 + nu) * u + sum(n * c for n, c in enumerate(a)) + rest
        return u, v / t * self.inwards


@dataclass(frozen=True)
class CutEnd:
    """An infinite end, or an irregular singular one: tau grows to oo towards it, and x = point(tau)."""

    x: Expr
    tau: Expr
    place: Expr
    piece: Stretch
    inwards: int
    threshold: Expr | None
    origin: Any

    @cached_property
    def of_tau(self) -> tuple[Expr, Expr]:
        Q, W = (e.subs(self.x, self.place) for e in (self.piece.Q, self.piece.W))
        return plain(Q, self.tau), plain(W, self.tau)

    def position(self, span: Span, digits: int) -> Any:
        """The cut for all E <= span.high; the solution decays beyond it by more than half of the digits, twice over."""
        return self._cut(span.high, digits)

    @kept
    def _cut(self, top: Any, digits: int) -> Any:
        tau = self._positive_from(top)
        action = arb(0)
        needed = 1.16 * (digits + 3)
        while (root := self._S(tau, top).sqrt()) > 0:
            check_time()
            step = min(abs(tau) / 16 + arb(1) / 256, 1 / (2 * root)) if self.place.is_polynomial(self.tau) else tau / 32
            after = (tau + step).mid()
            action += root * abs(self._x(after) - self._x(tau))
            tau = after
            saved = arb(0)  # half the logarithm of S over what S varies by beyond, where that is known
            if self.threshold is not None:
                variation = abs(self._S(tau, ball(self.threshold)))
                saved = ((root * root / variation).log() / 2).max(arb(0)) if variation > 0 else arb(1000)
            if action > needed - saved:
                return self._x(tau).mid()
        raise LimitExceeded(f"the solutions don't decay fast enough towards {self._name()}", limit="unknown_degree")

    @kept
    def _potential_beyond(self, x: Any) -> tuple[Any, Any]:
        """Bounds of Q from x on if W = 1 and the potential has a limit, else infinite ones."""
        Q, W = self.of_tau
        if self.threshold is None or W != 1:
            return -arb.pos_inf(), arb.pos_inf()
        tau = dyadic_midpoint((-self.inwards * x).lower())
        return lower_bound(Q, self.tau, tau), -lower_bound(-Q, self.tau, tau)

    def _name(self) -> str:
        return "infinity" if self.place.is_polynomial(self.tau) else f"{self.x} = {self.place.subs(self.tau, sympy.oo)}"

    def _x(self, tau: Any) -> Any:
        return BallEvaluator({self.tau: acb(tau)})(self.place).real

    def _S(self, tau: Any, E: Any) -> Any:
        Q, W = self.of_tau
        value = BallEvaluator({self.tau: acb(tau)})
        return (value(Q) - E * value(W)).real.mid()

    def _positive_from(self, top: Any) -> Any:
        """A number from which on Q - top W > 0 is proven."""
        Q, W = self.of_tau
        excess = Q - dyadic_midpoint(top) * W
        candidates = [self.origin + arb(2) ** k for k in range(-3, 60)]
        signs = [bool(self._S(tau, top) > 0) for tau in candidates]
        for k, tau in enumerate(candidates):
            if all(signs[k : k + 12]) and lower_bound(excess, self.tau, dyadic_midpoint(tau)) > 0:
                return tau
        raise InputError(
            f"it isn't proven that the potential is above {top.str(6, radius=False)} towards {self._name()}"
        )

    def state(self, E: Any, span: Span, at: Any, *, high: bool) -> StartValues:
        """The steeper solution, which gives the lower count, or for `high` the flatter one; without bounds Y = 0 or Y' = 0."""
        low, above = self._potential_beyond(at)
        if high:
            return arb(1), self.inwards * (low - E).sqrt() if low > E else arb(0)
        if above.is_finite():
            return arb(1), self.inwards * (above - E).sqrt()
        return arb(0), arb(self.inwards)


End = RegularEnd | SingularEnd | CutEnd


def at_threshold(end: End, threshold: Expr) -> End | None:
    """The end for E at the bottom of the essential spectrum; None if the bound for it isn't proven.

    It is a point beyond which Q - E W >= -1/(4 tau^2), for all lower E, too.  There the decaying solution has
    Y'/Y <= 1/(2 tau), or its quotient with sqrt(tau) would grow as log(tau).  So the count with equality is an upper bound.
    """
    if not isinstance(end, CutEnd) or end.threshold is None or end.threshold != threshold:
        return end
    Q, W = end.of_tau
    excess = sympy.expand((Q - threshold * W) * end.tau**2)
    for k in range(8):
        tau = dyadic_midpoint(abs(end.origin) + arb(2) ** k)
        if lower_bound(excess, end.tau, tau, derivatives=1) >= -arb(1) / 4:
            return RegularEnd(-end.inwards * tau, end.inwards / (2 * tau), sympy.S.One, end.inwards)
    return None


def end_of(problem: SturmProblem, side: int) -> End:
    """The left end for side 0, the right one for 1.  Raises `InputError` where the solution that belongs to it isn't known."""
    piece = problem.pieces[-side]
    at = problem.ends[side]
    wish = problem.conditions[side]
    inwards = 1 - 2 * side  # the sign of dx from the end into the interval
    if isinstance(wish, Robin) and not wish.is_zero and not is_regular(piece, problem, at):
        raise InputError(
            f"at {problem.x} = {at} the condition is y = 0, or that y is bounded: there is no value of y' there"
        )
    if at.is_infinite:
        return _infinite_end(problem.x, piece, at, inwards)
    if is_regular(piece, problem, at):
        if not isinstance(wish, Robin):
            raise InputError(f"a condition is needed at {problem.x} = {at}", hint=f'for example "y({at}) = 0"')
        slope = problem.slope(at) if wish.beta != 0 else 0
        return RegularEnd(at, wish.alpha - wish.beta * slope, wish.beta, inwards)
    t = sympy.Dummy("t", positive=True)
    Q, W = (_times_square(e.subs(problem.x, at + inwards * t), t) for e in (piece.Q, piece.W))
    length = arb(1)  # a lower bound of the piece's; 1 for an infinite one
    if piece.low.is_finite and piece.high.is_finite:
        with working_precision(64):
            length = (ball(piece.high) - ball(piece.low)).lower()
    found = SingularEnd(at, t, Q, W, inwards, length)
    if _are_analytic((Q, W), t, arb(0)) and W.subs(t, 0) == 0:
        square = found.square
        if square != 0 and not ball(square) > 0:
            said = f"at {problem.x} = {at} the exponents are 1/2 ± sqrt({square}), not known to be real"
            raise InputError(f"{said}: then solutions oscillate, and there is no lowest level")
        _check_wish(found, problem, wish)
        return found
    tau = sympy.Dummy("tau", positive=True)
    return CutEnd(problem.x, tau, at + inwards / tau, piece, inwards, None, (1 / length).upper())


def _times_square(e: Expr, t: Expr) -> Expr:
    """t^2 e, without removable singular points at t = 0: for a zero D of the denominator of order k, D is t^k germ(D)."""
    if e.is_rational_function(t):
        return plain(e * t**2, t)
    num, den = sympy.fraction(sympy.together(TR2(TR1(e)).rewrite(_HYPERBOLIC, sympy.exp)))
    power = sympy.Integer(2)
    for base, exponent in (factor.as_base_exp() for factor in sympy.Mul.make_args(den)):
        order = next((k for k in range(3) if base.diff(t, k).subs(t, 0) != 0), 0)
        if order and exponent.is_Integer:
            power -= order * exponent
            num, den = num / germ(base, t, order) ** exponent, den / base**exponent
    return t**power * num / den if power in (0, 1) else sympy.expand(e * t**2)


def is_regular(piece: Stretch, problem: SturmProblem, at: Expr) -> bool:
    """True if the coefficients are analytic at this end."""
    with working_precision(64):
        return not at.is_infinite and _are_analytic((piece.Q, piece.W, problem.B), problem.x, ball(at))


def _are_analytic(functions: Iterable[Expr], x: Expr, at: Any) -> bool:
    """True if functions of x are analytic near a point."""
    return all(size_bound(e, x, at, arb(1) / 2**40).is_finite() for e in functions)


def _check_wish(end: SingularEnd, problem: SturmProblem, wish: Wish) -> None:
    """Raise `InputError` unless the condition singles out the principal solution, y ~ t^(larger exponent)."""
    if wish is None or end.square >= 1:  # nu >= 1: t^(1/2 - nu) isn't square integrable
        return
    rate = sympy.limit(end.inwards * end.t * problem.B.subs(problem.x, end.at + end.inwards * end.t), end.t, 0)
    nu = sympy.sqrt(end.square)
    larger, smaller = (sympy.Rational(1, 2) + side * nu - rate / 2 for side in (1, -1))
    is_meant = larger > 0 >= smaller if wish.is_zero else larger >= 0 and (smaller < 0 or nu == 0)
    if not is_meant:
        said = f"at {problem.x} = {end.at} solutions behave like powers with the exponents {larger} and {smaller}"
        raise InputError(
            f"{said}: the condition there doesn't single out the first", hint="leave it out to mean that one"
        )


def _infinite_end(x: Expr, piece: Stretch, at: Expr, inwards: int) -> CutEnd:
    tau = sympy.Dummy("tau", positive=True)
    place = -inwards * tau
    Q, W = (e.subs(x, place) for e in (piece.Q, piece.W))
    limit = sympy.limit(Q / W, tau, sympy.oo)
    if limit is sympy.oo:
        threshold = None
    elif limit.is_finite and limit.is_number and limit.is_real:
        threshold = limit
    elif limit is -sympy.oo:
        # The end is a limit circle if int |Q|^(-1/2) converges, as for Q < -tau^2.1.
        said = f"the potential tends to -oo at {x} = {at}, where all solutions oscillate"
        if sympy.limit(Q / tau ** sympy.Rational(21, 10), tau, sympy.oo) is -sympy.oo:
            raise InputError(f"{said} and are square integrable (limit circle): a boundary condition is needed")
        raise InputError(f"{said}: there is no lowest level")
    else:
        raise InputError(f"{Q.subs(tau, x)} has no limit at {at}: whether there are levels isn't known here")
    if W.has(tau) and not lower_bound(W, tau, sympy.Integer(10)) > 0:
        raise InputError(f"the weight isn't known to stay positive at {at}")
    other = piece.low if at is sympy.oo else piece.high
    origin = arb(0) if other.is_infinite else (-inwards * ball(other)).mid()
    return CutEnd(x, tau, place, piece, inwards, threshold, origin)

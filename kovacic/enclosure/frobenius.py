"""Starting at a regular singular point: Frobenius series with exponents and logarithms, and a proven bound of their tails.

The guarantee: `basis` returns balls that contain the values and slopes at a point of the two solutions of the Frobenius basis,
continued along the straight segment from the singular point, with the principal logarithm of t.

Conventions (those of ore_algebra).  The basis has the leading terms t^lambda log(t)^k, the dominant one first: by the real
part of lambda upwards, then by its imaginary part, and the logarithm before its companion.  Each solution has the coefficient
1 at its own leading term and 0 at that of the other.  At an ordinary point these are the solutions with (y, y') = (1, 0), (0,
1).

The mathematics.  Write a coefficient of t^(lambda+n) as u + v log t, and eps = d/d(log t), so that eps (u, v) = (v, 0) and
eps^2 = 0.  With the operators P_j of `kovacic.enclosure.singular`

    P_0(lambda + n + eps) a_n = - sum_(j>=1) P_j(lambda + n - j + eps) a_(n-j).                                          (1)

Where the exponents differ by an integer N, the larger one makes P_0 vanish at n = N: that equation gives v_N, and u_N = 0.

The tail.  Divided by A = sum A_j t^j the equation is I(theta) y = -((beta - beta_0) theta + gamma - gamma_0) y.  The sum of the
terms before t^N leaves a defect R of finitely many terms, all from the last a_n.  With |(u, v)| = |u| + |v|, E_n the size of
the error's coefficients, delta the difference of lambda from the other exponent, and Cauchy's bounds |beta_j| <= M_beta rho^-j,
|gamma_j| <= M_gamma rho^-j, j > 0,

    |I(lambda + n + eps)^-1| <= 1/(kappa n^2),   kappa = (1 - |delta|/N)/(1 + (2 + |delta|/N)/(N - |delta|)),   n >= N,

(with 0 for |delta| where Re delta >= 0: I(lambda + n) = n (n + delta), and |n + delta| >= n)

    kappa n^2 E_n <= C sum_(j>=1) rho^-j (n - j) E_(n-j) + r_n,   C = M_gamma/N + M_beta (1 + (|lambda| + 1)/N),

so F = sum n E_n t^n stays below the solution of kappa t F' = C (t/rho)/(1 - t/rho) F + r, r the majorant of R/A, which gives

    F(t) <= (1 - t/rho)^(-1 - C/kappa) M_1 sum |R_n| t^n / (kappa N),   |1/A| <= M_1 on |t| = rho.                       (2)

References: F. G. Frobenius, J. reine angew. Math. 76 (1873).  M. Mezzarobba, "Truncation bounds for differentially finite
series", Ann. H. Lebesgue 2 (2019).  J. van der Hoeven, "Fast evaluation of holonomic functions near and in regular
singularities", J. Symb. Comp. 31 (2001).
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import log2
from kovacic.enclosure.matrices import NOTHING, Matrix, State, fundamental
from kovacic.enclosure.points import ExactPoint, are_real, around_zero, power_of_two
from kovacic.enclosure.singular import Operator, Singular, power_of
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import MOST_TRIALS, check_time
from kovacic.special.pullback import is_integer

_LOG = logging.getLogger(__name__)

_GROWTH_SHARE = 0.2  # growth of the majorant in bits as a share of the working precision, at most
LogPair = tuple[Any, Any]  # u + v log t


@dataclass(frozen=True)
class Majorant:
    """Bounds on the circle |t| = rho: of |beta - beta_0|, |gamma - gamma_0| and |1/A|."""

    rho: arb
    beta: arb
    gamma: arb
    inverse: arb

    @classmethod
    def make(cls, op: Operator, neighbours: list[tuple[acb, int]], rho: arb) -> Majorant:
        """The bounds, from the coefficients and the other zeros of A."""
        # |A| >= |A_0| prod (1 - rho/|zeta|)^k on the circle.
        inverse = 1 / abs(op.A[0])
        for zeta, k in neighbours:
            inverse /= (1 - rho / abs(zeta)) ** k
        # beta - beta_0 = (B - B_0/A_0 A)/A, with nothing at t^0 in the numerator.
        rows = ([v - row[0] / op.A[0] * a for v, a in zip(row, op.A, strict=True)] for row in (op.B, op.C))
        beta, gamma = (sum((abs(v) * rho**j for j, v in enumerate(row) if j), arb(0)) * inverse for row in rows)
        return cls(rho, beta.upper(), gamma.upper(), inverse.upper())

    def growth(self, n: int, delta: arb, size: arb, t: arb) -> tuple[arb, arb]:
        """(1 - t/rho)^(-1 - C/kappa) and kappa for the terms from n on; `size` bounds |lambda|, and `delta` |delta| if its real
        part is negative, else it's 0, since |n + delta| >= n."""
        kappa = (1 - delta / n) / (1 + (2 + delta / n) / (n - delta))
        C = self.gamma / n + self.beta * (1 + (size + 1) / n)
        return (1 - t / self.rho) ** (-1 - C / kappa), kappa


def radius(point: Singular, prec: int, distance: arb) -> tuple[int, Majorant]:
    """The disc |t| <= 2^e in which the series are summed: e, and the bounds for it.

    2^e is at most about `distance`, and half the distance to the next singular point.  On the disc sum |A_j t^j| <= |A_0| for
    j > 0, so that the recurrence loses no digits, and the majorant grows by a share of the precision only.
    """
    op = point.operator().in_balls()
    neighbours = point.neighbours()
    near = min((math.floor(log2(d.abs_lower())) for d, _ in neighbours), default=math.inf)
    e = int(min(math.ceil(log2(distance)), near - 1))
    lower, upper = (acb(v) for v in point.exponents())
    delta = abs(upper - lower).upper()
    size = max(abs(lower).upper(), abs(upper).upper())
    for _ in range(20_000):
        r = arb((1, e))
        if sum((abs(v) * r**j for j, v in enumerate(op.A) if j), arb(0)) <= abs(op.A[0]):
            # On the circle |t| = 3/2 r, at most 3/4 of the distance to the next singular point.
            bound = Majorant.make(op, neighbours, r * 3 / 2)
            factor, _ = bound.growth(max(_terms_before_bound(delta), prec // 2), delta, size, r)
            if factor > 0 and log2(factor) < max(60.0, _GROWTH_SHARE * prec):
                return e, bound
        e -= 1
    raise LimitExceeded("no disc around the singular point was found", limit="unknown_degree")


def _terms_before_bound(delta: arb) -> int:
    """Terms before which the bound isn't used."""
    difference = float(delta.upper())
    if math.isinf(difference):
        raise LimitExceeded(
            "the exponents differ by more than 1e308, and the series needs as many terms", limit="unknown_degree"
        )
    return int(2 * difference) + 8


def junction(point: Singular, towards: ExactPoint, prec: int) -> tuple[ExactPoint, Majorant]:
    """The point where the straight way to `towards` leaves the disc, or its end if that's inside, and the disc's bounds."""
    with working_precision(64):
        t = abs(point.offset(towards))
        if not t.is_finite() or t.contains(0):
            raise InputError(f"{towards} can't be reached from {point}: it's a singular point or 0")
        e, bound = radius(point, prec, t.upper())
        if t <= arb((1, e)):
            return towards, bound
        # 2^share of the way to `towards` is in the disc; at infinity x grows as t = 1/x shrinks.
        share = math.floor(log2(arb((1, e)) / t))
    if point.inverted:
        return towards.scaled(power_of_two(-share)), bound
    return (point.near + (towards - point.near).scaled(power_of_two(share))).rounded(e - 20), bound


def basis(
    point: Singular,
    last: ExactPoint,
    towards: ExactPoint,
    bound: Majorant,
    prec: int,
    *,
    needed: Sequence[bool] = (True, True),
) -> Matrix:
    """The values and slopes of the Frobenius basis (the columns) at `last`, a point of the disc on the way to `towards`.

    Solutions that aren't `needed` are zero.
    """
    with working_precision(int(prec * (1 + _GROWTH_SHARE)) + 100):
        _LOG.debug("Frobenius series at %s, up to %s, %d bits", point, last, prec)
        t = point.offset(last)
        end = point.offset(towards)
        if not (t / end).real > 0:
            raise LimitExceeded(f"{last} can't be told from the singular point {point}", limit="digits")
        log = end.log() + (t / end).log()  # continued along the segment
        states = [NOTHING, NOTHING]
        for k, solution in _expansions(point, last, bound, prec, needed).items():
            states[k] = solution.at(t, log)
        # Slopes: dy/dx = theta y / t, and -t theta y for t = 1/x.
        factor = -t if point.inverted else 1 / t
        first, second = ((y, theta_y * factor) for y, theta_y in states)
        return fundamental(first, second)


def _expansions(
    point: Singular, last: ExactPoint, bound: Majorant, prec: int, needed: Sequence[bool]
) -> dict[int, FrobeniusSeries]:
    """The needed solutions in the disc up to `last`, by their numbers."""
    lower, upper = point.exponents()
    length = abs(point.offset(last)).upper()
    op = point.operator()
    balls = op.in_balls()
    delta = abs(acb(upper) - lower).upper()
    N = point.difference
    dominant = _Beginning(lower, delta, N, start=(0, 1) if N == 0 else (1, 0))
    # A few terms of the smaller exponent, in exact numbers, decide whether there is a logarithm.
    if N and point.is_rational and N <= MOST_TRIALS:
        terms: list[LogPair] = [(fmpq(1), fmpq(0))]
        while len(terms) <= N:
            terms.append(_next_term(op, lower + len(terms), terms, dominant))
        dominant = replace(dominant, logarithm=bool(terms[N][1] != 0))
    beginnings = dominant, _Beginning(upper, arb(0))
    return {k: _expand(balls, beginnings[k], length, bound, prec) for k in (0, 1) if needed[k]}


@dataclass(frozen=True)
class _Beginning:
    """A solution that begins with t^exponent (u + v log t), (u, v) = `start`.

    `delta` bounds the difference of the exponents if the other one is larger, else it's 0.  P_0 vanishes at the term with the
    number `resonance`, if there is one; `logarithm` says that a logarithm may begin there.
    """

    exponent: Any
    delta: arb
    resonance: int | None = None
    logarithm: bool = True
    start: tuple[int, int] = (1, 0)


def limit(point: Singular, start: State) -> State:
    """y and y' at the point itself, for coordinates in the basis; raises InputError if one is infinite."""
    # At the point itself t is 0, and the direction of the way doesn't matter.
    last, bound = junction(point, point.near + ExactPoint(1), 64)
    needed = [not coordinate.is_zero() for coordinate in start]
    total = NOTHING
    for k, solution in _expansions(point, last, bound, max(64, ctx.prec), needed).items():
        y, dy = (solution.derivative_at_zero(order) for order in (0, 1))
        if y is None or dy is None:
            raise InputError(f"y or y' is infinite at the singular point {point}", hint="choose a point beside it")
        total = total[0] + start[k] * y, total[1] + start[k] * dy
    return total


def _apply_term(op: Operator, j: int, nu: Any, a: LogPair) -> LogPair:
    """P_j(nu + eps) a."""
    A, B, C = op.A[j], op.B[j], op.C[j]
    u, v = a
    # P_j(nu + eps) = P_j(nu) + P_j'(nu) eps, and eps (u, v) = (v, 0).
    value = (A * nu + B) * nu + C
    return value * u + (2 * A * nu + B) * v, value * v


def _next_term(op: Operator, nu: Any, terms: list[LogPair], beginning: _Beginning) -> LogPair:
    """a_n by equation (1), n the number of `terms`."""
    n = len(terms)
    f0 = f1 = op.A[0] * 0
    for j in range(1, min(n, len(op.A) - 1) + 1):
        p, q = _apply_term(op, j, nu - j, terms[n - j])
        f0, f1 = f0 - p, f1 - q
    slope = 2 * op.A[0] * nu + op.B[0]
    # There P_0 is P_0' eps: it gives P_0' v = f0, and u may be chosen.
    if n == beginning.resonance:
        return f0 * 0, f0 / slope * beginning.logarithm
    value = (op.A[0] * nu + op.B[0]) * nu + op.C[0]
    # P_0 v = f1 and P_0 u + P_0' v = f0.
    v = f1 / value
    return (f0 - slope * v) / value, v


@dataclass(frozen=True)
class FrobeniusSeries:
    """t^exponent (U(t) + V(t) log t) on a disc, with bounds of the errors of the second factor in y and theta y, over
    max(1, |log t|)."""

    exponent: Any
    U: acb_poly
    V: acb_poly
    errors: tuple[arb, arb]

    def derivative_at_zero(self, k: int) -> acb | None:
        """The limit of the derivative of order k = 0 or 1 for t to 0, or None if it is infinite."""
        exponent = self.exponent
        if is_integer(exponent) and 0 <= exponent <= k:
            # t^p sum U_m t^m: the derivative of order k at 0 is k! U_(k - p), and k! is 1.
            n = k - int(exponent.p)
            has_logarithm = any(not self.V[m].is_zero() for m in range(n + 1))
            return None if has_logarithm else self.U[n]
        return acb(0) if acb(exponent).real > k else None

    def at(self, t: acb, log: acb) -> tuple[acb, acb]:
        """y and theta y at t, with the logarithm of t."""
        U, V, lam = self.U, self.V, acb(self.exponent)
        value = U(t) + V(t) * log
        # theta = t d/dt, and theta (t^lam log t) = t^lam (lam log t + 1).
        slope = lam * U(t) + t * U.derivative()(t)
        slope += (lam * V(t) + t * V.derivative()(t)) * log + V(t)
        real = are_real([t, value, slope])
        # The errors are over max(1, |log t|).
        size = max(arb(1), abs(log).upper())
        tails = [around_zero((error * size).upper(), real=real) for error in self.errors]
        power = power_of(t, self.exponent, log)
        return (value + tails[0]) * power, (slope + tails[1]) * power


def _expand(op: Operator, beginning: _Beginning, length: arb, bound: Majorant, prec: int) -> FrobeniusSeries:
    """The solution with this beginning for |t| <= length."""
    exponent = acb(beginning.exponent)
    with working_precision(64):
        size = abs(exponent).upper()
    # Real numbers if the equation and the exponent are real.
    is_real = isinstance(op.A[0], arb) and exponent.imag.is_zero()
    kind, lam = (arb, exponent.real) if is_real else (acb, exponent)
    terms: list[LogPair] = [(kind(beginning.start[0]), kind(beginning.start[1]))]
    # The number of the first term from which on the bound holds.
    first = max(_terms_before_bound(beginning.delta), len(op.A), (beginning.resonance or 0) + 1)
    cap = 40 * prec + 4000 + 4 * first
    while True:
        check_time()
        terms.append(_next_term(op, lam + len(terms), terms, beginning))
        n = len(terms)
        if n <= first or (n - first) % 16 != 1:  # the tail is bounded at every sixteenth term
            continue
        with working_precision(64):
            defect = _tail_defect(op, lam, terms, length)
            factor, kappa = bound.growth(n, beginning.delta, size, length)
            F = (factor * bound.inverse * defect * length**n / (kappa * n)).upper()  # equation (2)
        # F bounds sum n E_n t^n: the values are off by F/n at most, and theta y by F (1 + (|lambda| + 1)/n).
        if arb((1, -prec - 20)) > F:
            U, V = (acb_poly([pair[k] for pair in terms]) for k in (0, 1))
            return FrobeniusSeries(beginning.exponent, U, V, ((F / n).upper(), (F * (1 + (size + 1) / n)).upper()))
        if n > cap:
            raise LimitExceeded(f"a Frobenius expansion needs more than {cap} terms", limit="unknown_degree")


def _tail_defect(op: Operator, lam: Any, terms: list[LogPair], length: arb) -> arb:
    """A bound of sum |R_n| t^(n - N) for |t| <= length: the contributions of the terms to the equations of later ones."""
    n = len(terms)
    order = len(op.A) - 1
    zero = type(lam)(0)
    total = arb(0)
    for m in range(order):
        # P_j with j > m takes a known term, n - 1 or an earlier one, to the equation of t^(n + m).
        pairs = [_apply_term(op, j, lam + (n + m - j), terms[n + m - j]) for j in range(m + 1, order + 1)]
        u, v = (abs(sum(part, zero)).upper() for part in zip(*pairs, strict=True))
        total += (u + v) * length**m
    return total

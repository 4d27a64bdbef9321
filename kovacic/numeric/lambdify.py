"""Closed forms of case 1 as vectorised NumPy functions in double precision, with a measured error.

y = exp(int theta) P(x) on an interval of the real axis without singular points becomes

    sign * prod_k |x - z_k|^(n_k) * prod_j |x - zeta_j|^(r_j) * exp(polynomial and polar parts of int theta - 2 sum_j
    Im(r_j) arg):

- P as a product over its zeros z_k, never expanded; zeros and exponents are double-doubles, so x - z_k keeps its
digits near a zero;
- factors are collected with their binary exponents apart: no overflow or underflow before the end;
- a power |d|^r is pow(|d|, r_hi) times 1 + r_lo log|d| + r d_lo/d; the exponent of exp is a double-double.

Measured, not proven: `measure` compares with route (b) at 50 digits on given points.  The default call measures on 24
points of
the interval and warns if the median exceeds 8 units in the last place, or the worst 1,000.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kovacic.errors import InputError
from kovacic.numeric.closed_form import closed_form_of
from kovacic.numeric.double_double import Pair, add, horner, two_product, two_sum
from kovacic.numeric.evaluate import AccuracyWarning, evaluate
from kovacic.numeric.exponential import LogDerivative, conjugates, embed, zeros
from kovacic.numeric.points import as_point, to_acb
from kovacic.numeric.problem import as_problem

if TYPE_CHECKING:
    from flint import acb, arb

_PREC = 200
_MEDIAN, _WORST = 8.0, 1000.0


@dataclass(frozen=True)
class Factor:
    """|x - zeta|^power: zeta = (a + a_lo) + i b; for b > 0 the pair of conjugates, |x - zeta|^2 to the power, with
    turn = -2 Im(residue)."""

    a: float
    a_lo: float
    b: float
    power: float
    power_lo: float
    turn: float


@dataclass(frozen=True)
class ClosedFormFunction:
    """A solution in double precision: call it with an array of points of the interval; `log` gives (sign, log |y|).

    The constant factor is that of the product in the head of this module.  Real solutions only.
    """

    interval: tuple[float, float]
    factors: tuple[Factor, ...]
    exponent: tuple[tuple[float, float], ...]
    poles: tuple[tuple[float, float, float, float, int], ...]
    negate: bool

    def __call__(self, x: Any) -> Any:
        """y(x) as doubles (inf or 0 where the value is beyond their range)."""
        import numpy as np

        points = self._checked(x)
        mantissa, binary, argument = self._parts(points)
        turns = np.rint(argument[0] / 0.6931471805599453)
        rest = add(argument, _negated(_log2_times(turns)))
        value = mantissa * np.exp(rest[0]) * (1 + rest[1])
        with np.errstate(over="ignore", under="ignore"):
            return np.ldexp(value, np.clip(binary + turns, -5000, 5000).astype(np.int64))

    def log(self, x: Any) -> tuple[Any, Any]:
        """(sign, log |y(x)|), without overflow."""
        import numpy as np

        mantissa, binary, argument = self._parts(self._checked(x))
        with np.errstate(divide="ignore"):
            size = np.log(np.abs(mantissa)) + binary * 0.6931471805599453 + argument[0]
        return np.sign(mantissa), size

    def _checked(self, x: Any) -> Any:
        import numpy as np

        points = np.asarray(x, dtype=float)
        low, high = self.interval
        if not np.all((points > low) & (points < high)):
            raise InputError(f"a point lies outside of the interval ({low}, {high}) of this function")
        return points

    def _parts(self, x: Any) -> tuple[Any, Any, Pair]:
        """y = mantissa * 2^binary * exp(argument)."""
        import numpy as np

        mantissa = np.ones_like(x) * (-1.0 if self.negate else 1.0)
        lost = np.zeros_like(x)  # relative correction of first order
        binary = np.zeros_like(x)
        argument: Pair = horner(self.exponent, x) if self.exponent else (0.0 * x, 0.0 * x)
        for a, a_lo, coefficient, coefficient_lo, k in self.poles:
            argument = add(argument, _pole(x, a, a_lo, coefficient, coefficient_lo, k))
        for factor in self.factors:
            d, d_lo = two_sum(x, -factor.a)
            d_lo = d_lo - factor.a_lo
            if factor.b:
                s, e = two_product(d, d)
                t, f = two_product(factor.b, factor.b)
                d, d_lo = add((s, e + 2 * d * d_lo), (t, f))
                if factor.turn:
                    argument = add(argument, (factor.turn * np.arctan2(-factor.b, x - factor.a), 0.0 * x))
            head, tail = two_sum(d, d_lo)
            if factor.power == 1.0:
                part, e2 = np.frexp(head)
                correction = np.divide(tail, head, out=np.zeros_like(head), where=head != 0)
            else:
                part, e2, correction = _power(np.abs(head), factor.power)
                logs = np.log(np.abs(head))
                correction = correction + factor.power * tail / head + factor.power_lo * logs
            mantissa, error = two_product(mantissa, part)
            lost = lost + correction + np.divide(error, mantissa, out=np.zeros_like(error), where=mantissa != 0)
            mantissa, shift = np.frexp(mantissa)
            binary = binary + e2 + shift
        return mantissa * (1 + lost), binary, argument


def _power(d: Any, r: float) -> tuple[Any, Any, Any]:
    """d^r as mantissa, binary exponent and a relative correction: the exponent of d is split off, so that nothing
    overflows."""
    import numpy as np

    m, e = np.frexp(d)
    low = m < 0.7071067811865476
    m, e = np.where(low, 2 * m, m), np.where(low, e - 1, e)
    h, l = two_product(r, e.astype(float))  # noqa: E741
    whole = np.rint(h)
    fraction = (h - whole) + l
    if abs(r) <= 1000:
        return np.power(m, r) * np.exp2(fraction), whole, np.zeros_like(d)
    # beyond: exp(r log m), whose error of |r log m| / 2 units the measurement will show
    p, q = two_product(r, np.log(m))
    turns = np.rint(p / 0.6931471805599453)
    rest = add((p, q), _negated(_log2_times(turns)))
    return np.exp(rest[0]) * (1 + rest[1]) * np.exp2(fraction), whole + turns, np.zeros_like(d)


def _log2_times(turns: Any) -> Pair:
    """turns * log 2 as a pair (turns is integral and below 2^30)."""
    high, low = two_product(turns, 0.6931471805599453)
    return two_sum(high, low + turns * 2.3190468138462996e-17)


def _negated(pair: Pair) -> Pair:
    return -pair[0], -pair[1]


def _pole(x: Any, a: float, a_lo: float, coefficient: float, coefficient_lo: float, k: int) -> Pair:
    """coefficient / (x - a)^k."""
    d, d_lo = two_sum(x, -a)
    d, d_lo = two_sum(d, d_lo - a_lo)
    power: Pair = (d, d_lo)
    for _ in range(k - 1):
        p, e = two_product(power[0], d)
        power = two_sum(p, e + power[0] * d_lo + power[1] * d)
    q = coefficient / power[0]
    p, e = two_product(q, power[0])
    return two_sum(q, ((coefficient - p) - e - q * power[1] + coefficient_lo) / power[0])


def lambdify(
    solution: object, *, interval: tuple[object, object], which: int = 0, check: bool = True
) -> ClosedFormFunction:
    """The closed form of a case-1 solution with real omega, as a NumPy function on an interval without singular points.

    `which` chooses between conjugate omegas.  With `check` the error is measured at 24 points, and an AccuracyWarning
    is given above 8 units in the last place (median) or 1,000 (worst).  Raises InputError for other cases (`tabulate`
    works
    for all), for a complex omega, and for an interval with a singular point inside.
    """
    from flint import ctx

    problem = as_problem(solution)
    if problem.gauge is not None:
        raise InputError("lambdify needs a normal form y'' = S y", hint="use tabulate, which treats every equation")
    closed = closed_form_of(problem)
    if closed.case != 1:
        raise InputError("lambdify needs a solution of case 1 (exponential)", hint="use tabulate, which treats every S")
    low, high = (as_point(v, "an end of the interval") for v in interval)
    if not (low.is_real() and high.is_real()) or low.re >= high.re:
        raise InputError("the interval is empty", hint="give two real numbers, the smaller one first")
    with ctx.workprec(_PREC):
        embeddings = conjugates(closed.P.field)
        if not 0 <= which < len(embeddings):
            raise InputError(f"which = {which}: there are {len(embeddings)} conjugates")
        c = embeddings[which]
        theta = LogDerivative.make(closed.theta, c)
        _require_real([*theta.num.coeffs(), *theta.den.coeffs(), *embed(closed.P, c).coeffs()])
        a, b = to_acb(low).real, to_acb(high).real
        factors, poles = _theta_parts(theta, a, b)
        factors += [_factor(z, _real_arb(k), 0.0) for z, k in zeros(closed.P, c) if not _below_axis(z)]
        lead = embed(closed.P, c).coeffs()[-1]
        exponent = tuple(_pair(v.real) for v in reversed(theta.primitive.coeffs()))
    result = ClosedFormFunction(
        (float(low.re), float(high.re)), tuple(factors), exponent, tuple(poles), bool(lead.real < 0)
    )
    if check:
        _warn(*measure(result, problem))
    return result


def _theta_parts(
    theta: LogDerivative, a: arb, b: arb
) -> tuple[list[Factor], list[tuple[float, float, float, float, int]]]:
    factors, poles = [], []
    for pole in theta.poles:
        zeta = pole.zeta
        if zeta.imag.is_zero():
            if not (zeta.real < a or zeta.real > b or zeta.real.overlaps(a) or zeta.real.overlaps(b)):
                raise InputError(f"the interval contains the singular point {zeta.real.mid().str(12, radius=False)}")
            _require_real(pole.coefficients)
            if not pole.coefficients[0].is_zero():
                factors.append(_factor(zeta, pole.coefficients[0].real, 0.0))
            hi, lo = _pair(zeta.real)
            for k, coefficient in enumerate(pole.coefficients[1:], start=2):
                poles.append((hi, lo, *_pair(-coefficient.real / (k - 1)), k - 1))
        elif not _below_axis(zeta):
            if any(not c.contains(0) for c in pole.coefficients[1:]):
                raise InputError("poles of higher order off the real axis aren't treated here", hint="use tabulate")
            residue = pole.coefficients[0]
            factors.append(_factor(zeta, residue.real, -2.0 * float(residue.imag.mid())))
    return factors, poles


def _below_axis(z: acb) -> bool:
    return bool(z.imag < 0)


def _factor(zeta: acb, power: arb, turn: float) -> Factor:
    hi, lo = _pair(zeta.real)
    return Factor(hi, lo, float(zeta.imag.mid()), *_pair(power), turn)


def _real_arb(value: int) -> arb:
    from flint import arb

    return arb(value)


def _pair(value: arb) -> tuple[float, float]:
    from flint import arb

    hi = float(value.mid())
    return hi, float((value - arb(hi)).mid())


def _require_real(values: Any) -> None:
    if any(not v.imag.contains(0) for v in values):
        raise InputError("the solution isn't real on the real axis", hint="use tabulate, or evaluate")


def measure(function: ClosedFormFunction, equation: object, points: Any = None) -> tuple[float, float]:
    """(median, worst) error in units in the last place at `points` (24 of the interval by default), against route (b)
    at 50 digits.

    Both sides are normalised at the first point, whose own error is therefore included in every other one.
    """
    from fractions import Fraction

    import numpy as np

    low, high = function.interval
    if points is None:
        points = low + (high - low) * (np.arange(24) + 0.5) / 24.13
    xs = [float(x) for x in np.asarray(points, dtype=float)]
    values = [float(v) for v in function(np.asarray(xs))]
    start = max(range(len(xs)), key=lambda i: abs(values[i]) if np.isfinite(values[i]) else -1.0)
    slope = _slope(function, equation, xs[start])
    references = evaluate(equation, xs, x0=xs[start], y0=Fraction(values[start]), dy0=slope, digits=50, method="taylor")
    errors = []
    for value, ball in zip(values, references if isinstance(references, tuple) else (references,), strict=True):
        exact = ball.midpoint[0]
        if exact == 0 or not np.isfinite(value) or value == 0.0:
            continue
        errors.append(float(abs(Fraction(value) - exact) / Fraction(float(np.spacing(abs(float(exact)))))))
    return (float(np.median(errors)), max(errors)) if errors else (float("inf"), float("inf"))


def _slope(function: ClosedFormFunction, equation: object, x: float) -> Any:
    """y'(x) for the function's own value at x: y omega, from the certificate, to 70 digits."""
    from fractions import Fraction

    from flint import arb, ctx

    closed = closed_form_of(as_problem(equation))
    with ctx.workprec(300):
        z = to_acb(as_point(x, "x"))
        wanted = arb(float(function(x)))
        best = None
        for c in conjugates(closed.P.field):
            theta, P = LogDerivative.make(closed.theta, c), embed(closed.P, c)
            omega = theta.value(z) + P.derivative()(z) / P(z)
            step = 2.0**-20 * max(1.0, abs(x)) / (1 + abs(float(omega.real.mid())))
            low, high = float(function(x - step)), float(function(x + step))
            rough = (high - low) / (2 * step) / float(wanted.mid())
            distance = abs(rough - float(omega.real.mid()))
            if best is None or distance < best[0]:
                best = (distance, omega)
        assert best is not None
        mantissa, exponent = (best[1].real * wanted).mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def _warn(median: float, worst: float) -> None:
    if median > _MEDIAN or worst > _WORST:
        warnings.warn(
            f"measured error of the double-precision closed form, in units in the last place: "
            f"median {median:.3g}, worst {worst:.3g}",
            AccuracyWarning,
            stacklevel=3,
        )

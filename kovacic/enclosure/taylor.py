"""Taylor expansions of den y'' = num y at an ordinary point, with a proven bound of the whole error.

The guarantee: for every point s of the disc the solutions' states (y, y') at s are balls that contain the exact ones.

With x = c + H u, H = h 2^e, the equation is q(u) y'' = p(u) y, q, p polynomials over Z[i] (the centre and H are
dyadic, so nothing is rounded).  The recurrence for the coefficients,

    q_0 (n+2)(n+1) a_(n+2) = sum_j p_j a_(n-j) - sum_(j>=1) q_j (n+2-j)(n+1-j) a_(n+2-j),

runs in fixed point, with integers A_n for a_n 2^w and division with remainder.  So the defect r = q Y'' - p Y of the
polynomial Y = sum A_n 2^-w u^n is known: its coefficients are those remainders, smaller than the divisors, and a few more
at the end that consist of the last A_n only.  Nothing is assumed about the stability of the recurrence.  The error e = y -
Y satisfies

    q e'' = p e - r,   e(0) = e'(0) = 0.

Along every ray from 0, |e''| <= sigma |e| + rho with sigma >= |p/q|, rho >= |r/q|, constant on each ring of the disc; so |e|
and |e'| stay below the solution of z'' = sigma z + rho (a Volterra inequality with a positive kernel, iterated).  This
majorant covers the truncation of the series and every rounding at once, and is sharp where classical majorant series are
not: the coefficients of 1/q never enter with absolute values.

References: M. Mezzarobba and B. Salvy, "Effective bounds for P-recursive sequences", J. Symb. Comp. 45 (2010).
A. Neumaier, "Global, rigorous and realistic bounds for the solution of dissipative differential equations. Part I:
Theory", Computing 52 (1994) 315-336, for bounds by the defect (the comparison used here is classical).
"""

from __future__ import annotations

from operator import mul
from typing import Any

from flint import acb, acb_poly, arb, arb_poly, fmpz, fmpz_poly

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import REACH, Frame, GaussianParts, coefficient_sum, log2
from kovacic.enclosure.way import Columns, Local, check_terms
from kovacic.limits import check_time


def expand(frame: Frame, prec: int) -> Columns:
    """The solutions with the states (1, 0) and (0, 1) at the centre, to about 2^-prec in the disc, with their error bounds."""
    w, columns = approximations(frame, prec)
    with working_precision(w + 10):
        units = arb((1, -w)), arb((1, frame.e - w))  # the second one has the slope 1 in x
        found = []
        for (parts, defect), unit in zip(columns, units, strict=True):
            re, im = (None if part is None else arb_poly(fmpz_poly(part)) * unit for part in parts)
            poly = re if im is None else acb_poly(re) + acb_poly(im) * acb(0, 1)
            found.append(Local(frame.centre, frame.e, poly, *error_radii(defect * unit, frame), REACH, w + 10))
        return found[0], found[1]


def approximations(frame: Frame, prec: int) -> tuple[int, list[tuple[GaussianParts, int]]]:
    """w, and the coefficients times 2^w of both columns of the identity at u = 0, each with a bound of sum |r_n| 2^w, the
    coefficient sum of q Y'' - p Y."""
    p = frame.p
    q = frame.q
    bound = frame.bound
    q_0 = q[0][0]
    loss = max(0.0, log2(arb(coefficient_sum(q)) / q_0) - bound.log2_least)
    quiet = 6 + int(loss)  # rounding errors keep the terms above about 2^loss units: they count as zero below 2^quiet
    # For the loss and the growth of errors, and 3 log2(N) for the sum of N remainders of the size q_0 N^2.
    w = prec + quiet + int(loss + bound.log2_growth) + 12 + 3 * max(6, prec.bit_length() + 1)
    # Bits of q_0 beyond those of the fixed point: no coefficient needs them.
    excess = max(0, q_0.bit_length() - (w + 40))
    p = _cut(p, excess)
    q = _cut(q, excess)
    columns = []
    for start in (0, 1):
        terms = fixed_point_series(p, q, w, start, 1 << quiet)
        columns.append((terms, _proven_defect(p, q, terms, excess, 1 << quiet) + 1))
    return w, columns


def _cut(parts: GaussianParts, excess: int) -> GaussianParts:
    """The coefficients without their lowest `excess` bits, which are beyond the fixed point anyway."""
    re, im = parts
    return [v >> excess for v in re], None if im is None else [v >> excess for v in im]


class _Series:
    """Real numbers a_n and b_n = n (n - 1) a_n, behind as many zeros as the sums reach back."""

    __slots__ = ("a", "b")

    def __init__(self, pad: int, first: Any, second: Any) -> None:
        zeros = [first * 0] * pad
        self.a = [*zeros, first, second]
        self.b = [*zeros, *zeros[:2]]

    def known(self, p_back: list[Any], q_back: list[Any]) -> Any:
        """sum_j p_j a_(n-j) - sum_(j>=1) q_j b_(n+2-j), where a_(n+1) is the last one, as p_0 and q_1 are in their lists."""
        a = self.a
        total = sum(map(mul, p_back, a[len(a) - 1 - len(p_back) : -1]))
        if q_back:
            total -= sum(map(mul, q_back, self.b[-len(q_back) :]))
        return total

    def add(self, term: Any, k: int) -> None:
        """a_(n+2), with k = (n + 1)(n + 2)."""
        self.a.append(term)
        self.b.append(term * k)


def fixed_point_series(p: GaussianParts, q: GaussianParts, w: int, start: int, small: int) -> GaussianParts:
    """The coefficients of q Y'' = p Y, real and imaginary parts (None: real), up to a run of terms below `small`.

    With b_n = n (n - 1) a_n,

        q_0 b_(n+2) = sum_j p_j a_(n-j) - sum_(j>=1) q_j b_(n+2-j).
    """
    number: Any = int if w < 700 else fmpz  # the faster kind (measured)
    p_re, p_im = ([number(v) for v in (part or [])[::-1]] for part in p)
    q_re, q_im = ([number(v) for v in (part or [])[:0:-1]] for part in q)
    one, zero, q_0 = number(1 << w), number(0), number(q[0][0])
    pad = max(map(len, (p_re, p_im, q_re, q_im))) + 2
    real = _Series(pad, *((zero, one) if start else (one, zero)))
    imag = None if p[1] is q[1] is None else _Series(pad, zero, zero)
    n = 0
    quiet = 0
    while quiet <= pad:
        if n % 64 == 0:
            check_time()
            check_terms(n, w)
        k = (n + 1) * (n + 2)
        # (p + i p')(a + i a') = (p a - p' a') + i (p a' + p' a), and q so.
        re = real.known(p_re, q_re)
        im = zero
        if imag is not None:
            re -= imag.known(p_im, q_im)
            im = (imag.known(p_re, q_re) + real.known(p_im, q_im)) // (q_0 * k)
            imag.add(im, k)
        # Rounded down: the remainder is a coefficient of the defect, and smaller than the divisor.
        re //= q_0 * k
        real.add(re, k)
        # Once as many terms are small as the sums reach back, the defect behind them is small.
        quiet = quiet + 1 if -small < re < small and -small < im < small else 0
        n += 1
    return real.a[pad:], None if imag is None else imag.a[pad:]


def _proven_defect(p: GaussianParts, q: GaussianParts, column: GaussianParts, excess: int, small: int) -> int:
    """A bound of sum |r_n| 2^w for the column, r = q Y'' - p Y with the untrimmed coefficients.

    With N terms and D_n = q_0 (n+1)(n+2): r_n is the remainder of the n-th division for n <= N - 3, below sqrt(2) D_n, and
    sum D_n <= q_0 N^3 / 2; for n >= N - 2 it involves the last terms only, all below `small` in both parts when the
    recurrence stopped.  A trimmed coefficient is off by less than 2^excess in both parts.
    """
    n = len(column[0])
    width = max(len(p[0]), len(q[0])) + 3
    # The first sum is that of the remainders, the second one what the last terms give to later equations.
    total = q[0][0] * n**3 + 2 * small * width * (n * n * coefficient_sum(q) + coefficient_sum(p))
    if excess:
        total += 2 * int(coefficient_sum(column)) * (len(p[0]) + len(q[0]) * n * n)
    return int(total) << excess


def error_radii(defect: arb, frame: Frame) -> tuple[arb, arb]:
    """Bounds of |e| and |de/du| in the disc for a defect q Y'' - p Y whose coefficients have the sum `defect`."""
    share = defect / frame.q[0][0]
    return (share * frame.bound.gain).upper(), (share * frame.bound.slope_gain).upper()

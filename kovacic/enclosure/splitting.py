"""Transition matrices to thousands of digits: binary splitting of the Taylor recurrence, and the bit-burst method.

The guarantee: as for `kovacic.enclosure.taylor`, every returned matrix of balls contains the exact transition matrix from the
centre c to the target s.  Not guaranteed: that the balls are small.

The mathematics.  With x = c + H u and s = c + H z the equation q(u) y'' = p(u) y of `kovacic.enclosure.frame` becomes, for
u = z v and after clearing denominators, Q(v) y_vv = P(v) y with Q, P over Z[i] and Q_0 > 0, and the target is v = 1.  Steps
of the recurrence for the coefficients b_m of a solution are matrices over Z[i] (`kovacic.enclosure.recurrence`).  A tree of
products, with integers of equal length at each level, costs a bounded number of multiplications of long integers at each
level: near-linear in the digits, where term by term is quadratic.  A run whose integers are about as long as the working
precision is a block; blocks act on the state V (the last r coefficients of two solutions, in balls) one after the other,
because beyond that length exact integers would only grow.  As V falls, the blocks get shorter.

The tail.  The polynomial Y(v) = sum_(k<N) b_k v^k of the *exact* coefficients leaves the defect Q Y'' - P Y, whose
coefficients vanish but for those that involve b_N and later ones: combinations of V_N.  The majorant of
`kovacic.enclosure.taylor` turns its size into a bound of the error; terms are added until that bound is small.

Bit-burst.  The integers are short only if c and z are.  A target of many digits is reached by a chain c -> s_1 -> s_2 -> ...
-> s, where s_k agrees with s to about 2^k bits: the k-th step needs 2^-k times as many terms, with coefficients 2^k times as
long.  The last step is short enough for term by term.

Symbols: c centre, H scale, s target, z = (s - c)/H, N the number of terms, r the order of the recurrence.

References: D. V. and G. V. Chudnovsky, "Computer algebra in the service of mathematical physics and number theory" (1990).
J. van der Hoeven, "Fast evaluation of holonomic functions", Theor. Comp. Sci. 210 (1999).
M. Mezzarobba, "NumGfun: a package for numerical and analytic computation with D-finite functions", ISSAC 2010.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from kovacic.enclosure.frame import Frame, RayBound, log2_lead, make_frame, ray_to, shift_system
from kovacic.enclosure.points import Point, to_acb
from kovacic.enclosure.recurrence import LEAF, Gauss, Recurrence, make_block, recurrence
from kovacic.enclosure.singular import System
from kovacic.enclosure.taylor import Matrix, error_radii, expand, transition
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget

if TYPE_CHECKING:
    from flint import arb

_BLOCK = 3.0
"""Length of the integers of a block, by the bits that are still needed (the first block: 1)."""

_LOWEST = 3500
_ENTIRE = 65
_SINGULAR = 130
"""Splitting pays above max(3500, factor * order^3) bits; the factor without and with singular points."""

_LEAST = 2000
"""Bits below which a block isn't shortened any more."""

_BURST = 16
"""Bits of the first point of a chain towards a target of many digits; each one has twice as many as the one before."""

_FEW = 128
"""Terms that the last step of a chain may have: it goes term by term."""


@dataclass(frozen=True)
class Series:
    """The sums up to the term m in balls: rows Y, Y' (and at -v), columns b = (1, 0, ...) and (0, 1, ...).

    `errors[k]` has the bounds of |e| and |e_v| for column k.
    """

    sums: Any
    errors: tuple[tuple[arb, arb], tuple[arb, arb]]


def _sum_series(
    system: System, frame: Frame, z: Point, bound: RayBound, mirror: bool, prec: int, budget: Budget
) -> Series:
    """Blocks until the bound of the tail is about 2^-prec."""
    from flint import acb, acb_mat, arb, arb_mat, ctx, fmpq

    shifted = shift_system(system, frame)
    steps, lead = recurrence(shifted.p, shifted.q, z), log2_lead(shifted.q)
    leaf, r, m = steps.leaf(mirror), steps.order, 2
    goal = prec + int(bound.log2_growth) + 20
    full = goal + 64
    matrix, number = (arb_mat, arb) if steps.is_real else (acb_mat, acb)
    with ctx.workprec(full):
        V = matrix([[0, 0]] * (r - 2) + [[1, 0], [0, 1]])
        sums = matrix([[1, 1], [0, 1], [1, -1], [0, 1]][: 4 if mirror else 2])
        length = abs(to_acb(z)).upper()
        scale = arb(fmpq(steps.K.denominator, steps.K.numerator)) / abs(to_acb(z)).lower() ** 2
        before: tuple[int, int] | None = None
        while True:
            heights = [sum((V[n, k].abs_upper() for n in range(r)), arb(0)).upper() for k in (0, 1)]
            radii = [error_radii((h * steps.size(m) * scale).upper(), lead, bound) for h in heights]
            errors = tuple((e, (slope * length).upper()) for e, slope in radii)
            if all(_order(e) <= -goal for pair in errors for e in pair):
                return Series(sums, errors)  # type: ignore[arg-type]
            if m > 40 * full + 4000:
                raise LimitExceeded(f"a Taylor expansion needs more than {m} terms", limit="unknown_degree")
            needed = max(64, full + 32 + max(map(_order, heights)))
            leaves = _leaves(steps, m, needed, before)
            block = make_block(leaf, m, leaves, budget)
            m, before = m + leaves * LEAF, (m, needed)
            with ctx.workprec(needed):
                inverse = number(1) / number(block.D)
                change, V = _balls(block.R) * V * inverse, _balls(block.C) * V * inverse
            sums = sums + change


def _leaves(steps: Recurrence, m: int, needed: int, before: tuple[int, int] | None) -> int:
    """The length of the next block: by the size of its integers, and no more than seem to be needed.

    `before` has m and `needed` as they were before the last block.
    """
    each = steps.size(m).bit_length()
    if before is None:
        return max(1, needed // (each * LEAF))
    steps_left = needed * (m - before[0]) / max(1, before[1] - needed)
    return max(1, math.ceil(min(_BLOCK * max(needed, _LEAST) / each, steps_left) / LEAF))


def _balls(a: Gauss) -> Any:
    from flint import acb, acb_mat, arb_mat

    return arb_mat(a[0]) if a[1] is None else acb_mat(a[0]) + acb_mat(a[1]) * acb(0, 1)


def _order(x: arb) -> int:
    """An integer e with x < 2^e, for an exact x >= 0."""
    mantissa, exponent = x.man_exp()
    return int(exponent) + int(mantissa).bit_length() if mantissa else -(1 << 60)


def is_split(system: System, prec: int) -> bool:
    """True if splitting is the cheaper way at this precision: by the order of the recurrence, as measured.

    (`benchmarks/numeric_long_series.py` measures both ways on both sides of the bound.)
    """
    order = max(2, len(system.num) + 1, len(system.den) - 1)
    return prec > max(_LOWEST, (_ENTIRE if len(system.den) == 1 else _SINGULAR) * order**3)


def split_legs(
    system: System, frame: Frame, target: Point, bound: RayBound, prec: int, budget: Budget, *, mirror: bool = False
) -> list[Matrix]:
    """Enclosure of the transition matrix from the centre to `target`, and with `mirror` of that to 2 c - target as well.

    `bound` must hold on every ray asked for.  The numbers of centre and target should be short.
    """
    from flint import acb, arb, ctx

    offset = target - frame.centre
    series = _sum_series(system, frame, offset.scaled(1 / frame.scale), bound, mirror, prec, budget)
    real = offset.is_real() and frame.centre.is_real()
    with ctx.workprec(prec + int(bound.log2_growth) + 84):
        h = to_acb(offset)
        balls = [[arb(0, error) for error in pair] for pair in series.errors]
        matrices = []
        for row in (0, 2) if mirror else (0,):
            y1, d1, y2, d2 = (
                acb(series.sums[row + i, k]) + acb(balls[k][i], 0 if real else balls[k][i])
                for k in (0, 1)
                for i in (0, 1)
            )
            matrices.append((y1, y2 * h, d1 / h, d2))
        return matrices


def bit_burst(system: System, frame: Frame, target: Point, prec: int, budget: Budget) -> list[Matrix]:
    """The matrices, in order, of a chain of steps from the centre to any `target` of the disc.

    The chain is homotopic to the straight line: the points s_k lie within 2^-16 scales of the disc, and there is no singular
    point within 1.6 scales of the centre.
    """
    matrices: list[Matrix] = []
    length = step = _BURST
    while target != frame.centre:
        z = (target - frame.centre).scaled(1 / frame.scale)
        bits = prec + length  # the slopes are divided by the length of the step
        if _height(z) <= 2 * length:
            return [*matrices, *split_legs(system, frame, target, ray_to(system, frame, target), bits, budget)]
        if prec < _FEW * length:
            bound = ray_to(system, frame, target)
            return [*matrices, transition(expand(system, frame, bits, bound, budget), target, bound)]
        stop = frame.centre + z.rounded(-step).scaled(frame.scale)
        if stop != frame.centre:
            matrices += split_legs(system, frame, stop, ray_to(system, frame, stop), bits, budget)
        frame = make_frame(system, stop, 1, frame.e - step)
        length, step = 2 * length, length
    return matrices


def legs(
    system: System, frame: Frame, enter: Point, leave: Point, bound: RayBound, prec: int, budget: Budget
) -> tuple[list[Matrix], list[Matrix]]:
    """The factors, in order, of the matrices from the centre to both junctions of a disc; `bound` holds on both rays."""
    offset = leave - frame.centre
    if enter == frame.centre - offset and _height(offset.scaled(1 / frame.scale)) <= 2 * _BURST:
        stop, start = split_legs(system, frame, leave, bound, prec, budget, mirror=True)
        return [start], [stop]
    start_factors, stop_factors = (bit_burst(system, frame, point, prec, budget) for point in (enter, leave))
    return start_factors, stop_factors


def _height(z: Point) -> int:
    """The bits of the longest of the integers that z is made of."""
    return max(abs(v).bit_length() for x in (z.re, z.im) for v in (x.numerator, x.denominator))

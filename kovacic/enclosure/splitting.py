"""Transition matrices to thousands of digits: binary splitting of the Taylor recurrence, and the bit-burst method.

The guarantee: every returned matrix of balls contains the exact transition matrix from the centre c to the target s.  Not
guaranteed: that the balls are small.

With x = c + H u and s = c + H z the equation q(u) y'' = p(u) y of `kovacic.enclosure.frame` becomes, for
u = z v and after clearing denominators, Q(v) y_vv = P(v) y with Q, P over Z[i] and Q_0 > 0, and the target is v = 1.  Steps
of the recurrence for the coefficients b_m of a solution are matrices over Z[i]: with r = max(2, deg P + 2, deg Q),

    Q_0 m (m-1) b_m = sum_j P_j b_(m-2-j) - sum_(j>=1) Q_j (m-j) (m-1-j) b_(m-j),

so the state V_m = (b_(m-r), ..., b_(m-1)) and the sums Y = sum_(k<m) b_k and Y' = sum_(k<m) k b_k obey

    D V_(m+1) = C V_m,    D (Y, Y')_(m+1) = D (Y, Y')_m + R V_m,    D = Q_0 m (m-1),

with matrices C, R of polynomials in m.  A matrix A + i B stands as (A, -B; B, A) over Z, and a vector as its real part above
its imaginary part; where c and z are real, both are as they are.

A run of steps has the same form: two of them in succession give (C2 C1, R2 C1 + D2 R1, D2 D1).  Runs are formed by a balanced
tree of products with integers of equal length at each level, which costs a bounded number of multiplications of long integers
at each level: near-linear in the digits, where term by term is quadratic.  A run whose integers are about as long as the
working precision is a block; blocks act on the state V (the last r coefficients of two solutions, in balls) one after the
other, because beyond that length exact integers would only grow.  As V falls, the blocks get shorter.

The tail.  The polynomial Y(v) = sum_(k<N) b_k v^k of the *exact* coefficients leaves the defect Q Y'' - P Y, whose
coefficients vanish but for those that involve b_N and later ones: combinations of V_N.  The majorant of
`kovacic.enclosure.taylor` turns its size into a bound of the error; terms are added until that bound is small.

Bit-burst.  The integers are short only if c and z are.  A target of many digits is reached by a chain c -> s_1 -> s_2 -> ...
-> s, where s_k agrees with s to about 2^k bits: the k-th step needs 2^-k times as many terms, with coefficients 2^k times as
long.  The last step is short enough for term by term.

References: D. V. and G. V. Chudnovsky, "Computer algebra in the service of mathematical physics and number theory" (1990).
J. van der Hoeven, "Fast evaluation of holonomic functions", Theor. Comp. Sci. 210 (1999).
M. Mezzarobba, "NumGfun: a package for numerical and analytic computation with D-finite functions", ISSAC 2010.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import acb, arb, arb_mat, fmpz_mat

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import Frame, GaussianParts, System, coefficient_sum, log2, make_frame, shift
from kovacic.enclosure.matrices import Matrix
from kovacic.enclosure.points import ExactPoint, around_zero, to_acb
from kovacic.enclosure.taylor import error_radii, expand
from kovacic.enclosure.way import check_terms, transition
from kovacic.limits import check_time

#: Bits of the first point of a chain towards a target of many digits; each one has twice as many as the one before.
_FIRST_BITS = 16


@dataclass(frozen=True)
class Run:
    """A run of steps, with integers: D V' = C V, D (Y, Y')' = D (Y, Y') + R V."""

    C: fmpz_mat
    R: fmpz_mat
    D: int

    def after(self, first: Run) -> Run:
        """`first`, then this."""
        return Run(self.C * first.C, self.R * first.C + first.R * self.D, self.D * first.D)


@dataclass(frozen=True)
class SplitRecurrence:
    """Q y_vv = P y over Z[i], with Q_0 > 0; with `mirror` the sums at -v, too."""

    P: GaussianParts
    Q: GaussianParts
    mirror: bool

    @cached_property
    def order(self) -> int:
        """r: the number of coefficients in the state."""
        return max(2, len(self.P[0]) + 1, len(self.Q[0]) - 1)

    @cached_property
    def is_real(self) -> bool:
        """True if all coefficients are real."""
        return self.P[1] is None and self.Q[1] is None

    @cached_property
    def _terms(self) -> list[list[tuple[int, int, int]]]:
        """P_(j-2), Q_j and j for j = r, ..., 1: real parts, and imaginary ones where there are any."""
        found = []
        for P, Q in list(zip(self.P, self.Q, strict=True))[: 1 if self.is_real else 2]:
            p, q = [0, 0, *(P or []), *[0] * self.order], [*(Q or []), *[0] * (self.order + 1)]
            found.append([(p[j], q[j], j) for j in range(self.order, 0, -1)])
        return found

    def size(self, m: int) -> int:
        """An upper bound of sum |coefficient| for the step to m."""
        return coefficient_sum(self.P) + m * m * coefficient_sum(self.Q)

    def step(self, m: int) -> Run:
        """The step to m; rows of R: Y, Y' and with `mirror` their values at -v."""
        D = self.Q[0][0] * m * (m - 1)
        # Of b_(m-r), ..., b_(m-1): the last row of A, and of B.
        last, *imaginary = [[p - q * ((m - j) * (m - 1 - j)) for p, q, j in part] for part in self._terms]
        sign = 1 if m % 2 == 0 else -1
        # b_m goes into Y = sum b_k and Y' = sum k b_k; at -v into sum (-1)^k b_k and -sum (-1)^k k b_k.
        factors = [1, m, sign, -sign * m] if self.mirror else [1, m]
        # The state moves on by one place, times the common divisor; its last member is new.
        shift = [[D if k == n + 1 else 0 for k in range(self.order)] for n in range(self.order - 1)]
        C, R = [*shift, last], [[f * entry for entry in last] for f in factors]
        for B in imaginary:
            zero = [0] * self.order
            C = _as_real(C, [*[zero] * len(shift), B])
            R = _as_real(R, [[f * entry for entry in B] for f in factors])
        return Run(fmpz_mat(C), fmpz_mat(R), D)

    def block(self, m: int, steps: int) -> Run:
        """The run of `steps` steps that starts at m, as a balanced tree."""
        if steps == 1:
            return self.step(m)
        check_time()
        half = steps // 2
        first = self.block(m, half)
        return self.block(m + half, steps - half).after(first)


def _as_real(A: list[list[int]], B: list[list[int]]) -> list[list[int]]:
    """(A, -B; B, A)."""
    # i (u, v) = (-v, u), real part above imaginary part.
    upper = [[*a, *(-entry for entry in b)] for a, b in zip(A, B, strict=True)]
    return upper + [[*b, *a] for a, b in zip(A, B, strict=True)]


def _sum_series(
    system: System, frame: Frame, z: ExactPoint, mirror: bool, prec: int
) -> tuple[Any, list[tuple[arb, arb]]]:
    """Sums in balls, rows Y, Y' (and at -v), columns b = (1, 0, ...) and (0, 1, ...), and for either column the bounds of |e|
    and |e_v|: blocks until these are about 2^-prec."""
    steps = SplitRecurrence(*shift(system, frame.centre, z.scaled(frame.scale)), mirror)
    m = 2
    # Errors grow with the solutions; 20 and 64 bits more for the bound and for the roundings of blocks.
    goal = prec + int(frame.bound.log2_growth) + 20
    full = goal + 64
    with working_precision(full):
        # The state ends with b_0 and b_1: 1, 0 in the first column, 0, 1 in the second one.
        first = [[0, 0]] * (steps.order - 2) + [[1, 0], [0, 1]]
        first_sums = [[1, 1], [0, 1]]  # of b_0 and b_1
        if mirror:
            first_sums += [[1, -1], [0, 1]]
        rows = len(first_sums)
        if not steps.is_real:
            first, first_sums = ([*part, *[[0, 0]] * len(part)] for part in (first, first_sums))
        V, sums = arb_mat(first), arb_mat(first_sums)
        length = abs(to_acb(z)).upper()
        # From the defect of Q y_vv = P y to that of q y_uu = p y: y_vv = z^2 y_uu, and Q is a multiple of q.
        ratio = arb(frame.q[0][0]) / steps.Q[0][0] / abs(to_acb(z)).lower() ** 2
        before: tuple[int, int] | None = None
        while True:
            heights = [sum((abs(V[n, k]).upper() for n in range(len(first))), arb(0)).upper() for k in (0, 1)]
            radii = [error_radii((h * steps.size(m) * ratio).upper(), frame) for h in heights]
            errors = [(e, (slope * length).upper()) for e, slope in radii]
            if all(log2(e) < -goal for pair in errors for e in pair):
                below = 0 if steps.is_real else rows  # where the imaginary parts stand
                values = [[acb(sums[n, k], sums[n + below, k] if below else 0) for k in (0, 1)] for n in range(rows)]
                return values, errors
            check_terms(m, full)
            # V falls like the terms, and with it the bits of V that count.
            needed = max(64, full + 33 + int(max(map(log2, heights))))
            length_of_block = _block_length(steps, m, needed, before)
            block = steps.block(m, length_of_block)
            before = (m, needed)
            m += length_of_block
            with working_precision(needed):
                inverse = arb(1) / block.D
                change = arb_mat(block.R) * V * inverse
                V = arb_mat(block.C) * V * inverse
            sums = sums + change


def _block_length(steps: SplitRecurrence, m: int, needed: int, before: tuple[int, int] | None) -> int:
    """The length of the next block: by the size of its integers, and no more than seem to be needed.

    `before` has m and `needed` as they were before the last block.
    """
    # Bits that a step adds to the integers of a block.
    each = steps.size(m).bit_length()
    if before is None:
        count = needed // each
        for _ in range(3):  # the steps get longer
            count = needed // steps.size(m + count).bit_length()
        return max(1, count)
    # As many steps as the last block took for the bits by which `needed` has fallen.
    steps_left = needed * (m - before[0]) / max(1, before[1] - needed)
    # Later blocks may be half as long again as the bits that are needed, and aren't shortened below 2,000 bits (measured).
    return max(1, math.ceil(min(1.5 * max(needed, 2000) / each, steps_left)))


def is_split(system: System, prec: int, *ends: ExactPoint) -> bool:
    """True if splitting is the cheaper way at this precision: by the order of the recurrence, as measured.

    (`benchmarks/enclosure_long_series.py` measures both ways on both sides of the bound.)
    """
    order = max(2, len(system.num) + 1, len(system.den) - 1)
    # Without and with singular points.
    least = max(1500, (10 if len(system.den) == 1 else 35) * order**3)
    return prec > (least if all(end.is_real() for end in ends) else 3 * least)


def split_legs(system: System, frame: Frame, target: ExactPoint, prec: int, *, mirror: bool = False) -> list[Matrix]:
    """Enclosure of the transition matrix from the centre to a `target` in the disc, and with `mirror` of that to 2 c - target.

    The numbers of centre and target should be short.
    """
    sums, errors = _sum_series(system, frame, frame.seen(target), mirror, prec)
    first_rows = (0, 2) if mirror else (0,)
    with working_precision(prec + int(frame.bound.log2_growth) + 84):
        h = to_acb(target - frame.centre)
        real = frame.centre.is_real() and target.is_real()
        matrices = []
        for row in first_rows:
            (y1, d1), (y2, d2) = (
                [sums[row + i][k] + around_zero(error, real=real) for i, error in enumerate(errors[k])] for k in (0, 1)
            )
            # v = (x - c)/h: the second solution has the slope 1 in v, 1/h in x; slopes are d/dx = (1/h) d/dv.
            matrices.append((y1, y2 * h, d1 / h, d2))
        return matrices


def bit_burst(system: System, frame: Frame, target: ExactPoint, prec: int) -> list[Matrix]:
    """The matrices, in order, of a chain of steps from the centre to any `target` of the disc.

    The chain is homotopic to the straight line: the points s_k lie within 2^-16 scales of the disc, and there is no singular
    point within 1.6 scales of the centre.
    """
    matrices: list[Matrix] = []
    length = step = _FIRST_BITS
    while target != frame.centre:
        z = frame.seen(target)
        bits = prec + length  # the slopes are divided by the length of the step
        if z.height_bits() <= 2 * length:
            return [*matrices, *split_legs(system, frame, target, bits)]
        if prec < 128 * length:  # some 128 terms: one by one
            return [*matrices, transition(expand(frame, bits), target)]
        stop = frame.centre + z.rounded(-step).scaled(frame.scale)
        if stop != frame.centre:
            matrices += split_legs(system, frame, stop, bits)
        inner = make_frame(system, stop, frame.e - step)
        assert inner is not None  # the points of the chain lie within 2^-16 scales of a disc without singular points
        frame, step, length = inner, length, 2 * length
    return matrices


def legs(
    system: System, frame: Frame, enter: ExactPoint, leave: ExactPoint, prec: int
) -> tuple[list[Matrix], list[Matrix]]:
    """The factors, in order, of the matrices from the centre to both junctions of a disc."""
    if enter == frame.centre + frame.centre - leave and frame.seen(leave).height_bits() <= 2 * _FIRST_BITS:
        stop, start = split_legs(system, frame, leave, prec, mirror=True)
        return [start], [stop]
    start_factors, stop_factors = (bit_burst(system, frame, point, prec) for point in (enter, leave))
    return start_factors, stop_factors

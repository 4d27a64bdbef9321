"""Transition matrices to thousands of digits: binary splitting of the Taylor recurrence, and the bit-burst method.

The guarantee: as for `kovacic.enclosure.taylor`, every returned matrix of balls contains the exact transition matrix from the
centre c to the target s.  Not guaranteed: that the balls are small.

The mathematics.  With x = c + H u and s = c + H z the equation q(u) y'' = p(u) y of `kovacic.enclosure.frame` becomes, for
u = z v and after clearing denominators, Q(v) y_vv = P(v) y with Q, P over Z[i] and Q_0 > 0, and the target is v = 1.  Steps
of the recurrence for the coefficients b_m of a solution are matrices over Z[i]: with r = max(2, deg P + 2, deg Q),

    Q_0 m (m-1) b_m = sum_j P_j b_(m-2-j) - sum_(j>=1) Q_j (m-j) (m-1-j) b_(m-j),

so the state V_m = (b_(m-r), ..., b_(m-1)) and the sums Y = sum_(k<m) b_k and Y' = sum_(k<m) k b_k obey

    D V_(m+1) = C V_m,    D (Y, Y')_(m+1) = D (Y, Y')_m + R V_m,    D = Q_0 m (m-1),

with matrices C, R of polynomials in m.  A run of steps has the same form: two of them in succession give (C2 C1,
R2 C1 + D2 R1, D2 D1).  The shortest runs are formed once, with polynomials in m as entries; longer ones by a balanced tree
of products with integers of equal length at each level, which costs a bounded number of multiplications of long integers at
each level: near-linear in the digits, where term by term is quadratic.  A run whose integers are about as long as the working
precision is a block; blocks act on the state V (the last r coefficients of two solutions, in balls) one after the other,
because beyond that length exact integers would only grow.  As V falls, the blocks get shorter.

The tail.  The polynomial Y(v) = sum_(k<N) b_k v^k of the *exact* coefficients leaves the defect Q Y'' - P Y, whose
coefficients vanish but for those that involve b_N and later ones: combinations of V_N.  The majorant of
`kovacic.enclosure.taylor` turns its size into a bound of the error; terms are added until that bound is small.

Bit-burst.  The integers are short only if c and z are.  A target of many digits is reached by a chain c -> s_1 -> s_2 -> ...
-> s, where s_k agrees with s to about 2^k bits: the k-th step needs 2^-k times as many terms, with coefficients 2^k times as
long.  The last step is short enough for term by term.

Symbols: c centre, H scale, s target, z = (s - c)/H, N the number of terms, m the index of the next coefficient, r the order
of the recurrence, V its state; C, R, D a run.

References: D. V. and G. V. Chudnovsky, "Computer algebra in the service of mathematical physics and number theory" (1990).
J. van der Hoeven, "Fast evaluation of holonomic functions", Theor. Comp. Sci. 210 (1999).
M. Mezzarobba, "NumGfun: a package for numerical and analytic computation with D-finite functions", ISSAC 2010.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from flint import acb, acb_mat, arb, arb_mat, fmpz_mat, fmpz_poly

from kovacic.algebra.precision import working_precision
from kovacic.enclosure.frame import Frame, GaussianParts, log2, make_frame, norm, shift
from kovacic.enclosure.matrices import Matrix
from kovacic.enclosure.points import ExactPoint, around_zero, to_acb
from kovacic.enclosure.system import System
from kovacic.enclosure.taylor import error_radii, expand, transition
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time

LEAF = 8  # steps whose product is formed once, with polynomials in m as entries
_BLOCK = 1.5  # length of the integers of a block, by the bits that are still needed (the first block: 1)
# Splitting pays above max(1500, factor * order^3) bits; the factor without and with singular points
_LOWEST = 1500
_ENTIRE = 10
_SINGULAR = 35
_LEAST = 2000  # bits below which a block isn't shortened any more
# Bits of the first point of a chain towards a target of many digits; each one has twice as many as the one before
_BURST = 16
_FEW = 128  # terms that the last step of a chain may have: it goes term by term


@dataclass(frozen=True)
class GaussianMatrix:
    """A matrix, or a number, over Z[i]: real and imaginary part (None: zero)."""

    re: Any
    im: Any = None

    def __mul__(self, other: GaussianMatrix) -> GaussianMatrix:
        if self.im is None and other.im is None:
            return GaussianMatrix(self.re * other.re)
        if self.im is None:
            return GaussianMatrix(self.re * other.re, self.re * other.im)
        if other.im is None:
            return GaussianMatrix(self.re * other.re, self.im * other.re)
        # three products instead of four
        x = self.re * other.re
        y = self.im * other.im
        return GaussianMatrix(x + y * -1, (self.re + self.im) * (other.re + other.im) + (x + y) * -1)

    def __add__(self, other: GaussianMatrix) -> GaussianMatrix:
        re = self.re + other.re
        if self.im is None:
            return GaussianMatrix(re, other.im)
        if other.im is None:
            return GaussianMatrix(re, self.im)
        return GaussianMatrix(re, self.im + other.im)

    def at(self, m: int) -> GaussianMatrix:
        """The matrix of integers for a matrix of polynomials."""
        im = None if self.im is None else self.im.at(m)
        return GaussianMatrix(self.re.at(m), im)

    def in_balls(self) -> Any:
        """The matrix of balls for a matrix of integers, at the working precision in force."""
        if self.im is None:
            return arb_mat(self.re)
        return acb_mat(self.re) + acb_mat(self.im) * acb(0, 1)


@dataclass(frozen=True)
class Run:
    """A run of steps: D V' = C V, D (Y, Y')' = D (Y, Y') + R V."""

    C: GaussianMatrix
    R: GaussianMatrix
    D: Any

    def at(self, m: int) -> Run:
        """The run of integers for a run of polynomials."""
        return Run(self.C.at(m), self.R.at(m), self.D(m))

    def after(self, first: Run) -> Run:
        """`first`, then this."""
        return Run(self.C * first.C, self.R * first.C + first.R * GaussianMatrix(self.D), self.D * first.D)


class PolynomialMatrix:
    """A small matrix of polynomials in m."""

    def __init__(self, rows: list[list[fmpz_poly]]) -> None:
        self.rows = rows

    def __mul__(self, other: Any) -> PolynomialMatrix:
        if not isinstance(other, PolynomialMatrix):
            return PolynomialMatrix([[entry * other for entry in row] for row in self.rows])
        columns = list(zip(*other.rows, strict=True))
        return PolynomialMatrix(
            [[sum(x * y for x, y in zip(row, column, strict=True)) for column in columns] for row in self.rows]
        )

    def __add__(self, other: PolynomialMatrix) -> PolynomialMatrix:
        return PolynomialMatrix(
            [[x + y for x, y in zip(a, b, strict=True)] for a, b in zip(self.rows, other.rows, strict=True)]
        )

    def at(self, m: int) -> fmpz_mat:
        """The matrix of integers at m."""
        return fmpz_mat(len(self.rows), len(self.rows[0]), [entry(m) for row in self.rows for entry in row])


@dataclass(frozen=True)
class Recurrence:
    """Q y_vv = P y over Z[i], with Q_0 > 0."""

    P: GaussianParts
    Q: GaussianParts

    @property
    def order(self) -> int:
        """r: the length of the state."""
        return max(2, len(self.P[0]) + 1, len(self.Q[0]) - 1)

    @property
    def is_real(self) -> bool:
        """True if all coefficients are."""
        return self.P[1] is None and self.Q[1] is None

    def size(self, m: int) -> int:
        """An upper bound of sum |coefficient| for the step to m."""
        return norm(self.P) + m * m * norm(self.Q)

    def leaf(self, mirror: bool) -> Run:
        """The steps to m, ..., m + LEAF - 1, as one run of polynomials in m."""
        leaf = self._step(0, mirror)
        for i in range(1, LEAF):
            leaf = self._step(i, mirror).after(leaf)
        return leaf

    def _step(self, i: int, mirror: bool) -> Run:
        """The step to m + i; rows of R: Y, Y' and with `mirror` their values at -v (m even)."""
        r = self.order
        m = fmpz_poly([i, 1])
        zero = fmpz_poly([])
        D = self.Q[0][0] * m * (m - 1)

        def coefficient(p: list[int], q: list[int], j: int) -> fmpz_poly:  # of b_(m-j)
            first = fmpz_poly([p[j - 2]]) if 0 <= j - 2 < len(p) else zero
            return first - q[j] * (m - j) * (m - 1 - j) if j < len(q) else first

        def tables(p: list[int], q: list[int], diagonal: fmpz_poly) -> tuple[PolynomialMatrix, PolynomialMatrix]:
            last = [coefficient(p, q, j) for j in range(r, 0, -1)]
            shift = [[zero] * r for _ in range(r - 1)]
            for n in range(r - 1):
                shift[n][n + 1] = diagonal
            factors = [fmpz_poly([1]), m]
            if mirror:
                factors += [fmpz_poly([(-1) ** i]), m * (-1) ** (i + 1)]
            return PolynomialMatrix([*shift, last]), PolynomialMatrix([[f * entry for entry in last] for f in factors])

        C, R = tables(self.P[0], self.Q[0], D)
        if self.is_real:
            return Run(GaussianMatrix(C), GaussianMatrix(R), D)
        C_im, R_im = tables(self.P[1] or [], self.Q[1] or [], zero)
        return Run(GaussianMatrix(C, C_im), GaussianMatrix(R, R_im), D)


def make_block(leaf: Run, m: int, leaves: int) -> Run:
    """The run of `leaves` leaves that starts at m, as a balanced tree."""
    check_time()
    if leaves == 1:
        return leaf.at(m)
    half = leaves // 2
    first = make_block(leaf, m, half)
    return make_block(leaf, m + half * LEAF, leaves - half).after(first)


def _sum_series(
    system: System, frame: Frame, z: ExactPoint, mirror: bool, prec: int
) -> tuple[Any, list[tuple[arb, arb]]]:
    """Sums in balls, rows Y, Y' (and at -v), columns b = (1, 0, ...) and (0, 1, ...), and for either column the bounds of |e|
    and |e_v|: blocks until these are about 2^-prec."""
    steps = Recurrence(*shift(system, frame.centre, z.scaled(frame.scale)))
    leaf = steps.leaf(mirror)
    r = steps.order
    m = 2
    goal = prec + int(frame.bound.log2_growth) + 20
    full = goal + 64
    matrix, number = (arb_mat, arb) if steps.is_real else (acb_mat, acb)
    with working_precision(full):
        V = matrix([[0, 0]] * (r - 2) + [[1, 0], [0, 1]])
        first_sums = [[1, 1], [0, 1]]  # of b_0 and b_1
        if mirror:
            first_sums += [[1, -1], [0, 1]]
        sums = matrix(first_sums)
        length = abs(to_acb(z)).upper()
        ratio = arb(frame.q[0][0]) / steps.Q[0][0] / abs(to_acb(z)).lower() ** 2
        before: tuple[int, int] | None = None
        while True:
            heights = [sum((V[n, k].abs_upper() for n in range(r)), arb(0)).upper() for k in (0, 1)]
            radii = [error_radii((h * steps.size(m) * ratio).upper(), frame) for h in heights]
            errors = [(e, (slope * length).upper()) for e, slope in radii]
            if all(log2(e) < -goal for pair in errors for e in pair):
                return sums, errors
            if m > 40 * full + 4000:
                raise LimitExceeded(f"a Taylor expansion needs more than {m} terms", limit="unknown_degree")
            needed = max(64, full + 33 + int(max(map(log2, heights))))
            leaves = _leaves(steps, m, needed, before)
            block = make_block(leaf, m, leaves)
            before = (m, needed)
            m += leaves * LEAF
            with working_precision(needed):
                inverse = number(1) / number(block.D)
                change = block.R.in_balls() * V * inverse
                V = block.C.in_balls() * V * inverse
            sums = sums + change


def _leaves(steps: Recurrence, m: int, needed: int, before: tuple[int, int] | None) -> int:
    """The length of the next block: by the size of its integers, and no more than seem to be needed.

    `before` has m and `needed` as they were before the last block.
    """
    each = steps.size(m).bit_length()
    if before is None:
        count = needed // each
        for _ in range(3):  # the steps get longer
            count = needed // steps.size(m + count).bit_length()
        return max(1, count // LEAF)
    steps_left = needed * (m - before[0]) / max(1, before[1] - needed)
    return max(1, math.ceil(min(_BLOCK * max(needed, _LEAST) / each, steps_left) / LEAF))


def is_split(system: System, prec: int) -> bool:
    """True if splitting is the cheaper way at this precision: by the order of the recurrence, as measured.

    (`benchmarks/enclosure_long_series.py` measures both ways on both sides of the bound.)
    """
    order = max(2, len(system.num) + 1, len(system.den) - 1)
    factor = _ENTIRE if len(system.den) == 1 else _SINGULAR
    return prec > max(_LOWEST, factor * order**3)


def split_legs(system: System, frame: Frame, target: ExactPoint, prec: int, *, mirror: bool = False) -> list[Matrix]:
    """Enclosure of the transition matrix from the centre to a `target` in the disc, and with `mirror` of that to 2 c - target.

    The numbers of centre and target should be short.
    """
    offset = target - frame.centre
    sums, errors = _sum_series(system, frame, frame.seen(target), mirror, prec)
    real = offset.is_real() and frame.centre.is_real()
    first_rows = (0, 2) if mirror else (0,)
    with working_precision(prec + int(frame.bound.log2_growth) + 84):
        h = to_acb(offset)
        matrices = []
        for row in first_rows:
            (y1, d1), (y2, d2) = (
                [acb(sums[row + i, k]) + around_zero(error, real=real) for i, error in enumerate(errors[k])]
                for k in (0, 1)
            )
            matrices.append((y1, y2 * h, d1 / h, d2))
        return matrices


def bit_burst(system: System, frame: Frame, target: ExactPoint, prec: int) -> list[Matrix]:
    """The matrices, in order, of a chain of steps from the centre to any `target` of the disc.

    The chain is homotopic to the straight line: the points s_k lie within 2^-16 scales of the disc, and there is no singular
    point within 1.6 scales of the centre.
    """
    matrices: list[Matrix] = []
    length = step = _BURST
    while target != frame.centre:
        z = frame.seen(target)
        bits = prec + length  # the slopes are divided by the length of the step
        if z.height_bits() <= 2 * length:
            return [*matrices, *split_legs(system, frame, target, bits)]
        if prec < _FEW * length:
            return [*matrices, transition(expand(frame, bits), target)]
        stop = frame.centre + z.rounded(-step).scaled(frame.scale)
        if stop != frame.centre:
            matrices += split_legs(system, frame, stop, bits)
        inner = make_frame(system, stop, frame.e - step)
        assert inner is not None  # the points of the chain lie within 2^-16 scales of a disc without singular points
        frame = inner
        step = length
        length = 2 * length
    return matrices


def legs(
    system: System, frame: Frame, enter: ExactPoint, leave: ExactPoint, prec: int
) -> tuple[list[Matrix], list[Matrix]]:
    """The factors, in order, of the matrices from the centre to both junctions of a disc."""
    if enter == frame.centre + frame.centre - leave and frame.seen(leave).height_bits() <= 2 * _BURST:
        stop, start = split_legs(system, frame, leave, prec, mirror=True)
        return [start], [stop]
    start_factors, stop_factors = (bit_burst(system, frame, point, prec) for point in (enter, leave))
    return start_factors, stop_factors

"""Runs of steps of the Taylor recurrence of Q y'' = P y, as matrices over Z[i] with a common denominator.

With Q, P over Z[i] and Q_0 > 0 the coefficients of a solution sum b_m v^m satisfy, with r = max(2, deg P + 2, deg Q),

    Q_0 m (m-1) b_m = sum_j P_j b_(m-2-j) - sum_(j>=1) Q_j (m-j) (m-1-j) b_(m-j),

so the state V_m = (b_(m-r), ..., b_(m-1)) and the sums Y = sum_(k<m) b_k and Y' = sum_(k<m) k b_k obey

    D V_(m+1) = C V_m,    D (Y, Y')_(m+1) = D (Y, Y')_m + R V_m,    D = Q_0 m (m-1),

with matrices C, R of polynomials in m.  A run of steps has the same form: two of them in succession give (C2 C1,
R2 C1 + D2 R1, D2 D1).  The shortest runs are formed once, with polynomials in m as entries; longer ones are balanced trees of
products of integers (`kovacic.enclosure.splitting`).

Symbols: m index of the next coefficient, r order of the recurrence, V state, C, R, D the run.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from kovacic.enclosure.frame import Parts
from kovacic.enclosure.points import Point
from kovacic.limits import Budget

if TYPE_CHECKING:
    from flint import fmpz_mat, fmpz_poly

Gauss = tuple[Any, Any]
"""A matrix, or number, over Z[i]: real and imaginary part (None: zero)."""

LEAF = 8
"""Steps whose product is formed once, with polynomials in m as entries."""


@dataclass(frozen=True)
class Run:
    """A run of steps: D V' = C V, D (Y, Y')' = D (Y, Y') + R V."""

    C: Gauss
    R: Gauss
    D: Any

    def at(self, m: int) -> Run:
        """The run of integers for a run of polynomials."""
        C, R = ((re.at(m), None if im is None else im.at(m)) for re, im in (self.C, self.R))
        return Run(C, R, self.D(m))

    def after(self, first: Run) -> Run:
        """`first`, then this."""
        return Run(
            _times(self.C, first.C),
            _plus(_times(self.R, first.C), _scaled(first.R, self.D)),
            self.D * first.D,
        )


def _times(a: Gauss, b: Gauss) -> Gauss:
    (ar, ai), (br, bi) = a, b
    if ai is None:
        return ar * br, None if bi is None else ar * bi
    if bi is None:
        return ar * br, ai * br
    x, y = ar * br, ai * bi
    return x - y, (ar + ai) * (br + bi) - x - y


def _plus(a: Gauss, b: Gauss) -> Gauss:
    return a[0] + b[0], b[1] if a[1] is None else a[1] if b[1] is None else a[1] + b[1]


def _scaled(a: Gauss, factor: Any) -> Gauss:
    return a[0] * factor, None if a[1] is None else a[1] * factor


class Table:
    """A small matrix of polynomials in m."""

    def __init__(self, rows: list[list[fmpz_poly]]) -> None:
        self.rows = rows

    def __mul__(self, other: Any) -> Table:
        if not isinstance(other, Table):
            return Table([[entry * other for entry in row] for row in self.rows])
        columns = list(zip(*other.rows, strict=True))
        return Table(
            [[sum(x * y for x, y in zip(row, column, strict=True)) for column in columns] for row in self.rows]
        )

    def __add__(self, other: Table) -> Table:
        return Table([[x + y for x, y in zip(a, b, strict=True)] for a, b in zip(self.rows, other.rows, strict=True)])

    def __sub__(self, other: Table) -> Table:
        return Table([[x - y for x, y in zip(a, b, strict=True)] for a, b in zip(self.rows, other.rows, strict=True)])

    def at(self, m: int) -> fmpz_mat:
        """The matrix of integers at m."""
        from flint import fmpz_mat

        return fmpz_mat(len(self.rows), len(self.rows[0]), [entry(m) for row in self.rows for entry in row])


@dataclass(frozen=True)
class Recurrence:
    """Q y_vv = P y over Z[i], and K > 0 with Q(v) = K q(z v), P(v) = K z^2 p(z v)."""

    P: Parts
    Q: Parts
    K: Fraction

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
        P, Q = (sum(abs(v) for part in parts if part is not None for v in part) for parts in (self.P, self.Q))
        return P + m * m * Q

    def leaf(self, mirror: bool) -> Run:
        """The steps to m, ..., m + LEAF - 1, as one run of polynomials in m."""
        leaf = self._step(0, mirror)
        for i in range(1, LEAF):
            leaf = self._step(i, mirror).after(leaf)
        return leaf

    def _step(self, i: int, mirror: bool) -> Run:
        """The step to m + i; rows of R: Y, Y' and with `mirror` their values at -v (m even)."""
        from flint import fmpz_poly

        r, m, zero = self.order, fmpz_poly([i, 1]), fmpz_poly([])
        D = self.Q[0][0] * m * (m - 1)

        def coefficient(p: list[int], q: list[int], j: int) -> fmpz_poly:  # of b_(m-j)
            first = fmpz_poly([p[j - 2]]) if 0 <= j - 2 < len(p) else zero
            return first - q[j] * (m - j) * (m - 1 - j) if j < len(q) else first

        def tables(p: list[int], q: list[int], diagonal: fmpz_poly) -> tuple[Table, Table]:
            last = [coefficient(p, q, j) for j in range(r, 0, -1)]
            shift = [[diagonal if k == n + 1 else zero for k in range(r)] for n in range(r - 1)]
            factors = [fmpz_poly([1]), m, fmpz_poly([(-1) ** i]), m * (-1) ** (i + 1)][: 4 if mirror else 2]
            return Table([*shift, last]), Table([[f * entry for entry in last] for f in factors])

        C, R = tables(self.P[0], self.Q[0], D)
        if self.is_real:
            return Run((C, None), (R, None), D)
        C_im, R_im = tables(self.P[1] or [], self.Q[1] or [], zero)
        return Run((C, C_im), (R, R_im), D)


def recurrence(p: Parts, q: Parts, z: Point) -> Recurrence:
    """The recurrence of q y'' = p y in the variable v = u/z (q_0 > 0), by its integers without a common factor."""
    g = math.lcm(z.re.denominator, z.im.denominator)
    a, b = int(z.re * g), int(z.im * g)
    degree = max(len(q[0]) - 1, len(p[0]) + 1)
    powers = [(1, 0)]  # of a + i b
    for _ in range(degree):
        x, y = powers[-1]
        powers.append((a * x - b * y, a * y + b * x))

    def scaled(parts: Parts, start: int) -> tuple[list[int], list[int]]:
        re, im = [], []
        for j, x in enumerate(parts[0]):
            y = 0 if parts[1] is None else parts[1][j]
            (c, d), f = powers[j + start], g ** (degree - j - start)
            re.append((x * c - y * d) * f)
            im.append((x * d + y * c) * f)
        return re, im

    P, Q = scaled(p, 2), scaled(q, 0)
    content = math.gcd(*P[0], *P[1], *Q[0], *Q[1])

    def reduced(re: list[int], im: list[int]) -> Parts:
        return [v // content for v in re], [v // content for v in im] if any(im) else None

    return Recurrence(reduced(*P), reduced(*Q), Fraction(g**degree, content))


def make_block(leaf: Run, m: int, leaves: int, budget: Budget) -> Run:
    """The run of `leaves` leaves that starts at m, as a balanced tree."""
    budget.check()
    if leaves == 1:
        return leaf.at(m)
    half = leaves // 2
    first = make_block(leaf, m, half, budget)
    return make_block(leaf, m + half * LEAF, leaves - half, budget).after(first)

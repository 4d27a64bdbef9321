"""The logarithms in integrals on s^2 = g with conjugate poles gathered into one.

If rho(a)^2/g(a) is the same constant 1/tau^2 at all roots a of p, then sqrt(g(a)) = rho(a) tau, and the sum over the roots in
equation (2) of `kovacic.closed_form.curve` is -log((A + B tau s)/p)/tau with A, B in K[x]:

    A + B t = prod over the roots a of (L_a + rho(a) t),   t = tau s,   t^2 = tau^2 g.                                     (1)
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.partial_fractions import Residue

MAX_DEGREE = 12  # the determinant of (1) takes about degree^4 polynomial products


@dataclass(frozen=True)
class Unit:
    """The contribution factor * log((A + B tau s)/p)/tau to an integral; tau^2 = `tau_squared`, a constant of K."""

    A: Poly
    B: Poly
    p: Poly
    tau_squared: Poly
    factor: Fraction = Fraction(-1)

    def integrand(self, g: Poly) -> RatFunc:
        """r with r dx/s the derivative of the contribution, for A^2 - tau^2 B^2 g a constant times p^2."""
        A, B = self.A, self.B
        norm = A * A - B * B * g * self.tau_squared
        top = (B.derivative() * g + B * g.derivative() * Fraction(1, 2)) * A - A.derivative() * B * g
        return RatFunc(top, norm) * self.factor

    def is_unit(self, g: Poly) -> bool:
        """Is A^2 - tau^2 B^2 g a constant times p^2?"""
        return (self.A * self.A - self.B * self.B * g * self.tau_squared).monic() == (self.p * self.p).monic()


def unit(g: Poly, residue: Residue) -> Unit | None:
    """The unit of one residue, None if rho(a)^2/g(a) isn't constant or p is too large to be worth writing out."""
    p, rho = residue.factor, residue.value
    gamma = g % p
    inverse = rho.inverse_modulo(p) if rho.degree > 0 else rho.inverse()
    tau_squared = gamma * inverse * inverse % p
    if tau_squared.degree > 0 or p.degree > MAX_DEGREE:
        return None
    A, B = _norm(g, p, rho, gamma, tau_squared[0])
    return Unit(A, B, p, tau_squared[0])


Pair = tuple[Poly, Poly]


def _norm(g: Poly, p: Poly, rho: Poly, gamma: Poly, tau_squared: Poly) -> Pair:
    """Equation (1), as the determinant of multiplication by L_a + rho(a) t on K(x, t)[a]/p [Faddeev & LeVerrier]."""
    field, n = p.field, p.degree
    half_slope = g.derivative() * Fraction(1, 2) % p
    a, x = field.poly([0, 1]), field.poly([0, 1])
    constant, slope = (gamma - half_slope * a) % p, half_slope  # L_a = constant + slope x
    square = tau_squared * g
    rows: list[list[Pair]] = []
    power = field.poly([1])
    for _ in range(n):
        low, high, t = constant * power % p, slope * power % p, rho * power % p
        rows.append([(field.poly([low[j]]) + x * high[j], field.poly([t[j]])) for j in range(n)])
        power = power * a
    zero: Pair = (field.poly([]), field.poly([]))
    current: list[list[Pair]] = [[(field.poly([int(i == j)]), zero[1]) for j in range(n)] for i in range(n)]
    coefficient = zero
    for k in range(1, n + 1):
        product = [[_dot(row, [c[j] for c in current], square, zero) for j in range(n)] for row in rows]
        trace = zero
        for i in range(n):
            trace = (trace[0] + product[i][i][0], trace[1] + product[i][i][1])
        scale = Fraction(-1, k)
        coefficient = (trace[0] * scale, trace[1] * scale)
        for i in range(n):
            product[i][i] = (product[i][i][0] + coefficient[0], product[i][i][1] + coefficient[1])
        current = product
    sign = 1 if n % 2 == 0 else -1
    return coefficient[0] * sign, coefficient[1] * sign


def _dot(row: list[Pair], column: list[Pair], square: Poly, zero: Pair) -> Pair:
    total = zero
    for (a, b), (c, d) in zip(row, column, strict=True):
        total = (total[0] + a * c + b * d * square, total[1] + a * d + b * c)
    return total

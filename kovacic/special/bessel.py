"""Airy and Bessel functions: Ai, Bi; J_nu, Y_nu; I_nu, K_nu; j_n, y_n where nu = n + 1/2 with a symbolic natural n.

Y_nu and K_nu are independent of J_nu and I_nu for every nu.

Reference: DLMF 9.2, 10.2, 10.25, 10.47.
"""

from __future__ import annotations

from fractions import Fraction

import sympy

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.atoms import Expr
from kovacic.special.pullback import Airy
from kovacic.special.writer import HALF, Number, Writer


def airy(writer: Writer, equation: Airy, f: RatFunc) -> tuple[Expr, Expr]:
    """u = Ai(q^(1/3) z)."""
    z = writer.root(equation.q, 3) * writer.argument(f)
    before = writer.factor(f, ())
    return writer.pair((before, sympy.airyai(z)), (before, sympy.airybi(z)))


def bessel(writer: Writer, nu_squared: Poly, t: RatFunc) -> tuple[Expr, Expr]:
    """u = sqrt(t) J_nu(2 sqrt t), or with I, K and -t where the constant factor of t is negative."""
    nu = writer.square_root(nu_squared)
    modified = writer.is_negative(t.num.lc)
    z = writer.root_of(t * (-4 if modified else 4))

    def times_power(power: Fraction) -> list[tuple[Number, RatFunc]]:
        return [(Number(nu_squared * 0 + power), t)]

    degree = next((m - HALF for m in (nu, -nu) if writer.is_degree(m - HALF)), None)
    if degree is not None and not modified:
        n, before = writer.constant(degree), writer.factor(t, times_power(Fraction(3, 4)))  # J_nu = sqrt(2 z/pi) j_n
        return writer.pair((before, sympy.jn(n, z)), (before, sympy.yn(n, z)))
    first, second = (sympy.besseli, sympy.besselk) if modified else (sympy.besselj, sympy.bessely)
    before, order = writer.factor(t, times_power(HALF)), writer.constant(nu)
    return writer.pair((before, first(order, z, evaluate=False)), (before, second(order, z, evaluate=False)))

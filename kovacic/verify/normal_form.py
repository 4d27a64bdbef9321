"""The check that y'' = S v is the normal form of the equation as given.

y = v exp(int rho dx), rho = -b/(2a), turns a y'' + b y' + c y = 0 into v'' = S v with S = (b/a)'/2 + (b/a)^2/4 - c/a
[Kovacic 1986, section 1.1].  With b/a = u/v and c/a = w/z that is an identity of polynomials,

    4 v^2 z num(S) = den(S) (z (2 (u' v - u v') + u^2) - 4 v^2 w),    2 v num(rho) = -u den(rho).
"""

from __future__ import annotations

from kovacic.algebra.ratfunc import RatFunc


def is_normal_form(S: RatFunc, gauge: RatFunc, a: RatFunc, b: RatFunc, c: RatFunc) -> bool:
    """True if y'' = S y is the normal form of a y'' + b y' + c y = 0, with this gauge rho."""
    u = b.num * a.den
    v = b.den * a.num
    w = c.num * a.den
    z = c.den * a.num
    square = v * v
    wanted = z * (2 * (u.derivative() * v - u * v.derivative()) + u * u) - 4 * square * w
    is_S = not (4 * square * z * S.num - S.den * wanted)
    return is_S and not (2 * v * gauge.num + u * gauge.den)

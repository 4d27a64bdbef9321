"""Equations with parameters: what the theory says about them, and where it comes from.

`expected` is a predicate on exact values; it is written independently of the package.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

F = Fraction


@dataclass(frozen=True)
class Family:
    """S with its parameters, the case that is expected at a point, and points that must be tried."""

    name: str
    S: str
    parameters: tuple[str, ...]
    expected: Callable[..., int | None]
    points: tuple[tuple[Fraction | int, ...], ...]
    source: str


def integer(value: Fraction) -> bool:
    return F(value).denominator == 1


def odd(value: Fraction) -> bool:
    return integer(value) and F(value).numerator % 2 == 1


def hypergeometric(differences: tuple[str, str, str]) -> str:
    """The normal form with these exponent differences at 0, 1, infinity [Kimura 1969]."""
    p, q, r = differences
    return with_squares(f"({p})^2", f"({q})^2", f"({r})^2")


def with_squares(p: str, q: str, r: str) -> str:
    """The same, from the squares of the exponent differences."""
    return f"-(1-{p})/(4*x^2) - (1-{q})/(4*(x-1)^2) - ({p}+{q}-{r}-1)/(4*x*(x-1))"


def rational_root(value: Fraction | int) -> Fraction | None:
    """The square root that isn't negative, if it is rational."""
    fraction = F(value)
    if fraction < 0:
        return None
    root = F(isqrt(fraction.numerator), isqrt(fraction.denominator))
    return root if root * root == fraction else None


BALL = "(1+8*k^2)/(8*(x1-x2)*(x-x1)) - 3/(16*(x-x1)^2) - (1+8*k^2)/(8*(x1-x2)*(x-x2)) - 3/(16*(x-x2)^2)"

FAMILIES = [
    Family(
        "bessel",
        "(4*n^2-1)/(4*x^2) - 1",
        ("n",),
        lambda n: 1 if integer(n - F(1, 2)) else None,
        ((F(1, 2),), (F(-7, 2),), (0,), (3,), (F(1, 4),)),
        "Kovacic 1986",
    ),
    Family(
        "legendre",
        "((n^2+n)*x^2 - n^2 - n - 1)/(x^2-1)^2",
        ("n",),
        lambda n: 1 if integer(n) else None,
        ((0,), (4,), (-3,), (F(1, 2),), (F(1, 5),)),
        "Duval & Loday-Richaud 1992",
    ),
    Family(
        "weber",
        "x^2 + mu",
        ("mu",),
        lambda mu: 1 if odd(mu) else None,
        ((1,), (-3,), (2,), (F(1, 2),), (0,)),
        "Kovacic 1986",
    ),
    Family(
        "whittaker",
        "1/4 - k/x + (4*m^2-1)/(4*x^2)",
        ("k", "m"),
        lambda k, m: 1 if integer(k + m - F(1, 2)) or integer(k - m - F(1, 2)) else None,
        ((1, F(1, 2)), (F(-3, 4), F(1, 4)), (0, F(3, 2)), (F(1, 3), F(1, 5)), (F(1, 4), F(1, 3)), (0, 1)),
        "Martinet & Ramis 1989",
    ),
    Family(
        "quartic",
        "x^4 + mu*x",
        ("mu",),
        lambda mu: 1 if integer(mu) and int(mu) % 6 in (2, 4) else None,
        ((2,), (4,), (-8,), (0,), (6,), (3,), (14,)),
        "Acosta-Humanez & Blazquez-Sanz 2008",
    ),
    Family(
        "chebyshev",
        "((4*n^2-1)*x^2 - 4*n^2 - 2)/(4*(x^2-1)^2)",
        ("n",),
        lambda n: 1 if integer(2 * n) else 2,
        ((2,), (F(1, 2),), (F(1, 3),), (F(3, 7),)),
        "classical",
    ),
    Family(
        "dihedral",
        hypergeometric(("1/2", "1/2", "n")),
        ("n",),
        lambda n: 1 if integer(n) else 2,
        ((1,), (0,), (F(1, 2),), (F(2, 7),)),
        "Kimura 1969",
    ),
    Family(
        "lame 1",
        "(5*x^4 + 4*B*x^3 - 98*x^2 + (-28*B + 192)*x + 24*B - 147)/(16*(x^3-7*x+6)^2)",
        ("B",),
        lambda B: 1 if B in (1, 2, -3) else 2,
        ((1,), (2,), (-3,), (0,), (5,)),
        "Hermite 1877",
    ),
    Family(
        "lame 1/2",
        "(64*B*x^3 - 108*x^2 + (-48*B - 756)*x - 112*B - 27)/(16*(4*x^3-3*x-7)^2)",
        ("B",),
        lambda B: 2 if B == 0 else None,
        ((0,), (1,), (F(-2, 3),)),
        "Brioschi, Halphen, Crawford",
    ),
    Family(
        "ball on the sphere",
        BALL,
        ("k", "x1", "x2"),
        lambda k, x1, x2: 1 if integer(2 * k) or x1 == x2 else 2,
        ((F(1, 2), 1, -1), (1, F(5, 3), -7), (F(1, 3), 1, -1), (F(5, 7), 2, 3), (0, 1, -1), (F(1, 3), 2, 2)),
        "Kuleshov & Katasonova 2018, Theorems 1 and 2",
    ),
    Family(
        "coulomb",
        "l*(l+1)/x^2 - 2*Z/x + b^2",
        ("l", "Z", "b"),
        lambda l_, Z, b: (
            (1 if Z == 0 else 2 if odd(2 * (2 * l_ + 1)) else None)
            if b == 0
            else 1
            if odd(2 * Z / b + 2 * l_ + 1) or odd(2 * Z / b - 2 * l_ - 1)
            else None
        ),
        ((0, 1, 1), (1, 1, F(1, 2)), (0, 1, F(2, 3)), (F(1, 4), 1, 0), (0, 0, 0), (1, 1, 0), (F(1, 3), 1, 1)),
        "bound states at energy -b^2: Z/b = l + 1 + d",
    ),
    Family(
        "harmonic oscillator",
        "x^2 - E",
        ("E",),
        lambda E: 1 if odd(E) else None,
        ((1,), (7,), (-3,), (0,), (2,), (F(1, 2),)),
        "bound states at E = 2d + 1",
    ),
    Family(
        "coulomb, in the energy",
        "l*(l+1)/x^2 - Z/x - E",
        ("l", "Z", "E"),
        lambda l_, Z, E: _coulomb(l_, Z, E),
        ((0, 2, -1), (1, 2, F(-1, 4)), (0, 3, -1), (2, 0, 5), (F(1, 3), 1, -1), (F(1, 4), 1, 0), (0, 0, 0), (1, 1, 0)),
        "bound states at E = -Z^2/(4 (l + 1 + d)^2)",
    ),
    Family(
        "poeschl-teller, in the energy",
        with_squares("(-E)", "(-E)", "(2*l+1)^2"),
        ("l", "E"),
        lambda l_, E: _poeschl_teller(l_, rational_root(-E)),
        ((3, -4), (3, -1), (F(3, 2), F(-1, 4)), (F(1, 3), -1), (F(1, 3), F(-1, 4)), (2, 3), (F(1, 3), 3)),
        "bound states at E = -(l - d)^2, in the variable (1 + tanh x)/2",
    ),
    Family(
        "morse, in the energy",
        "A^2 - 2*A*b/x - (E + 1/4)/x^2",
        ("A", "b", "E"),
        lambda A, b, E: _morse(A, b, rational_root(-4 * E)),
        ((1, F(3, 2), -1), (1, F(3, 2), 0), (2, 3, F(-25, 4)), (1, 2, -1), (0, 1, 3), (1, 1, F(1, 4))),
        "bound states at E = -(b - d - 1/2)^2, in the variable exp(-x)",
    ),
    Family(
        "poeschl-teller",
        hypergeometric(("m", "m", "2*l+1")),
        ("l", "m"),
        lambda l_, m: _poeschl_teller(l_, m),
        ((1, F(1, 3)), (2, 2), (F(1, 3), F(1, 2)), (F(1, 2), F(1, 5)), (F(1, 3), F(4, 3))),
        "associated Legendre functions, y = sqrt(1-z^2) P_l^m(z)",
    ),
    Family(
        "morse",
        "(4*s^2-1)/(4*x^2) - A/x + 1/4",
        ("s", "A"),
        lambda s, A: 1 if integer(A + s - F(1, 2)) or integer(A - s - F(1, 2)) else None,
        ((1, F(3, 2)), (F(1, 2), 3), (F(1, 3), F(5, 6)), (F(1, 3), 1)),
        "in the variable 2A exp(-x): bound states s = A - d - 1/2",
    ),
]


def _poeschl_teller(l_: Fraction, m: Fraction | None) -> int | None:
    """The points of the family avoid Schwarz's rows 2-15; m is None where it is irrational."""
    if integer(l_):
        return 1
    if m is None:
        return None
    if integer(m + l_) or integer(m - l_):
        return 1
    return 2 if F(m).denominator == 2 else None


def _coulomb(l_: Fraction, Z: Fraction, E: Fraction) -> int | None:
    if E == 0:
        return 1 if Z == 0 else 2 if odd(2 * (2 * l_ + 1)) else None
    root = rational_root(-Z * Z / F(E))
    if root is None:
        return None
    return 1 if odd(root + 2 * l_ + 1) or odd(root - 2 * l_ - 1) else None


def _morse(A: Fraction, b: Fraction, root: Fraction | None) -> int | None:
    """root^2 = -4 E."""
    if A == 0:
        return 1
    return 1 if root is not None and (odd(root + 2 * b) or odd(root - 2 * b)) else None

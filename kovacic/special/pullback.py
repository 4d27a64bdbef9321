"""Pull-backs of the standard equations: what is searched for, and the identity by which it is verified.

If u'' = S0(z) u and z = f(x), then y = u(f)/sqrt(f') satisfies y'' = S y with

    S = f'^2 S0(f) - {f, x}/2,        {f, x} = f'''/f' - (3/2) (f''/f')^2.                                       (1)

The standard equations are written so that their coefficients, and f, lie in the field of S:

- `Airy`: S0 = q z, solutions Ai(q^(1/3) z), Bi;
- `Confluent`: S0 = q - r/z + M/z^2.  For q != 0 it is Whittaker's, kappa = r/(2 sqrt q), mu^2 = M + 1/4, in 2 sqrt(q) z; there
  r = 0 gives Bessel's of order mu in sqrt(-q) z.  For q = 0 it is Bessel's of order nu, nu^2 = 4 M + 1, in 2 sqrt(r z);
- `Gauss`: the hypergeometric one with the squares A, B, C of the exponent differences at 0, 1 and infinity.

Reference: DLMF 9.2, 10.13, 13.14, 15.10.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc


@dataclass(frozen=True)
class Airy:
    """S0 = q z."""

    q: Poly

    @property
    def S(self) -> RatFunc:
        return RatFunc(_variable(self.q.field) * self.q)


@dataclass(frozen=True)
class Confluent:
    """S0 = q - r/z + M/z^2."""

    q: Poly
    r: Poly
    M: Poly

    @property
    def S(self) -> RatFunc:
        z = _variable(self.M.field)
        return RatFunc(z * z * self.q - z * self.r + self.M, z * z)


@dataclass(frozen=True)
class Gauss:
    """S0 = (A - 1)/(4 z^2) + (B - 1)/(4 (z-1)^2) + (1 - A - B + C)/(4 z (z-1))."""

    A: Poly
    B: Poly
    C: Poly

    @property
    def S(self) -> RatFunc:
        z = _variable(self.A.field)
        w, A, B, C = z - 1, self.A, self.B, self.C
        return RatFunc(w * w * (A - 1) + z * z * (B - 1) + z * w * (1 - A - B + C), z * z * w * w * 4)


Standard = Airy | Confluent | Gauss


@dataclass(frozen=True)
class Pullback:
    """A standard equation and the function f that it is pulled back by."""

    equation: Standard
    f: RatFunc

    @property
    def S(self) -> RatFunc:
        """The coefficient of the pulled-back normal form, by (1)."""
        slope = self.f.derivative()
        return slope * slope * self.equation.S(self.f) - schwarzian(self.f) / 2

    def gives(self, S: RatFunc) -> bool:
        """Does the identity (1) hold exactly?"""
        return self.f.derivative() != 0 and self.S == S


def schwarzian(f: RatFunc) -> RatFunc:
    """{f, x} for a function that isn't constant."""
    slope = f.derivative()
    ratio = slope.derivative() / slope
    return ratio.derivative() - ratio * ratio * Fraction(1, 2)


def _variable(field: Field) -> Poly:
    return field.poly([0, 1])

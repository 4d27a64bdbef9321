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
from itertools import islice
from math import comb
from typing import Any

from kovacic.algebra.modular import BadPrimeError
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc

#: Where the identity is tried modulo a prime, and with how many homomorphisms at most.
_POINT, _TRIALS = 1_000_003, 5


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
        return self.f.derivative() != 0 and self._gives_modulo_a_prime(S) and self.S == S

    def _gives_modulo_a_prime(self, S: RatFunc) -> bool:
        """The identity at a point modulo a prime, which excludes most of what is wrong at once."""
        field, standard = self.f.field, self.equation.S
        functions = [r.over(field) for one in (self.f, S, standard) for r in (one.num, one.den)]
        for h in islice(field.homomorphisms(), _TRIALS):
            try:
                N, D, top, bottom, over, under = map(h, functions)
                return _identity_at(h.p, N, D, top, bottom, over, under)
            except (BadPrimeError, ZeroDivisionError):
                continue
        return True


def _identity_at(p: int, N: Any, D: Any, top: Any, bottom: Any, over: Any, under: Any) -> bool:
    """(1) for f = N/D, S = top/bottom, S0 = over/under at a point modulo p.  Raises `ZeroDivisionError` at a pole."""
    n, d, jets = N, D, []
    for _ in range(4):
        jets.append((int(n(_POINT)), int(d(_POINT))))
        n, d = n.derivative(), d.derivative()
    inverse, f = _inverse(jets[0][1], p), list[int]()
    for k, (value, _) in enumerate(jets):  # f D = N by Leibniz' rule
        f.append((value - sum(comb(k, i) * f[i] * jets[k - i][1] for i in range(k))) * inverse % p)
    ratio = f[2] * _inverse(f[1], p)
    bracket = f[3] * _inverse(f[1], p) - ratio * ratio * 3 * _inverse(2, p)
    pulled = f[1] ** 2 * int(over(f[0])) * _inverse(int(under(f[0])), p) - bracket * _inverse(2, p)
    return (pulled * int(bottom(_POINT)) - int(top(_POINT))) % p == 0


def _inverse(value: int, p: int) -> int:
    if value % p == 0:
        raise ZeroDivisionError
    return pow(value, -1, p)


def schwarzian(f: RatFunc) -> RatFunc:
    """{f, x} for a function that isn't constant."""
    slope = f.derivative()
    ratio = slope.derivative() / slope
    return ratio.derivative() - ratio * ratio * Fraction(1, 2)


def _variable(field: Field) -> Poly:
    return field.poly([0, 1])

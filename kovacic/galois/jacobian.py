"""Divisor classes on a hyperelliptic curve z^2 = h(x) over F_p, deg h odd: Cantor's arithmetic in Mumford's representation.

A class of degree 0 is represented by (u, v): u monic, deg v < deg u <= genus, u | h - v^2; it stands for the points
(x, v(x)) at the roots x of u, each minus the one point at infinity.  The neutral element is (1, 0).

Reference: D. Cantor, "Computing in the Jacobian of a hyperelliptic curve", Math. Comp. 48 (1987) 95-101.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, repeat
from typing import Any, NamedTuple


class DivisorClass(NamedTuple):
    """(u, v) in Mumford's representation; compared by the coefficients."""

    u: Any
    v: Any


@dataclass(frozen=True)
class Jacobian:
    """The divisor classes of degree 0 of z^2 = h, h squarefree of odd degree over F_p, p odd."""

    h: Any

    @property
    def zero(self) -> DivisorClass:
        return DivisorClass(self.h**0, self.h * 0)

    def point(self, u: Any, v: Any) -> DivisorClass:
        """The class of the points (x, v(x)) at the roots of u.  Raises `ValueError` unless they lie on the curve."""
        if (self.h - v * v) % u:
            raise ValueError("the points don't lie on the curve")
        return self._reduced(_monic(u), v % u)

    def add(self, first: DivisorClass, second: DivisorClass) -> DivisorClass:
        """The sum of two classes."""
        u1, v1, u2, v2 = first.u, first.v, second.u, second.v
        d, e1, e2 = u1.xgcd(u2)
        d, c1, c2 = d.xgcd(v1 + v2)
        u = u1 * u2 // (d * d)
        v = (c1 * e1 * u1 * v2 + c1 * e2 * u2 * v1 + c2 * (v1 * v2 + self.h)) // d % u
        return self._reduced(u, v)

    def multiple(self, k: int, value: DivisorClass) -> DivisorClass:
        """k times a class, for an integer k of either sign."""
        if k < 0:
            k, value = -k, DivisorClass(value.u, -value.v)
        result = self.zero
        while k:
            if k & 1:
                result = self.add(result, value)
            value = self.add(value, value)
            k >>= 1
        return result

    def order(self, value: DivisorClass, bound: int) -> int | None:
        """The order of a class, or None if it exceeds `bound`."""
        multiples = accumulate(repeat(value, bound), self.add)
        return next((k for k, multiple in enumerate(multiples, start=1) if not multiple.u.degree()), None)

    def _reduced(self, u: Any, v: Any) -> DivisorClass:
        while 2 * u.degree() >= self.h.degree():
            u = _monic((self.h - v * v) // u)
            v = -v % u
        return DivisorClass(u, v)


def _monic(u: Any) -> Any:
    return u * pow(int(u.leading_coefficient()), -1, u.modulus())

"""Divisor classes on a hyperelliptic curve z^2 = h(x) over F_p, deg h odd: Cantor's arithmetic in Mumford's representation.

A class of degree 0 is represented by (u, v): u monic, deg v < deg u <= genus, u | h - v^2; it stands for the points
(x, v(x)) at the roots x of u, each minus the one point at infinity.  The neutral element is (1, 0).

References: D. Cantor, "Computing in the Jacobian of a hyperelliptic curve", Math. Comp. 48 (1987) 95-101; D. Shanks, "Class
number, a theory of factorization, and genera", Proc. Symp. Pure Math. 20 (1971) 415-440, for the steps to an order.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any, NamedTuple

from flint import fmpz


class DivisorClass(NamedTuple):
    """(u, v) in Mumford's representation; compared by the coefficients."""

    u: Any
    v: Any

    @property
    def key(self) -> tuple[Any, ...]:
        """A hashable form."""
        return tuple(self.u), tuple(self.v)


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
        u1 = first.u
        v1 = first.v
        u2 = second.u
        v2 = second.v
        d, e1, e2 = u1.xgcd(u2)
        d, c1, c2 = d.xgcd(v1 + v2)
        u = u1 * u2 // (d * d)
        v = (c1 * e1 * u1 * v2 + c1 * e2 * u2 * v1 + c2 * (v1 * v2 + self.h)) // d % u
        return self._reduced(u, v)

    def multiple(self, k: int, value: DivisorClass) -> DivisorClass:
        """k times a class, for an integer k of either sign."""
        if k < 0:
            k = -k
            value = DivisorClass(value.u, -value.v)
        result = self.zero
        while k:
            if k & 1:
                result = self.add(result, value)
            value = self.add(value, value)
            k >>= 1
        return result

    def order(self, value: DivisorClass) -> int:
        """The order of a class: of a multiple that is zero, without the prime factors that aren't needed."""
        order = self._vanishing_multiple(value)
        for q, _ in fmpz(order).factor():
            while order % int(q) == 0 and self.multiple(order // int(q), value) == self.zero:
                order //= int(q)
        return order

    def _vanishing_multiple(self, value: DivisorClass) -> int:
        """Some n > 0 with n D = 0, from the interval of Hasse and Weil in which the number of all classes lies.

        n = least + i s - j for one of the giant steps i and of the s baby steps j [Shanks].
        """
        # The number of classes is between (sqrt(p) - 1)^(2g) and (sqrt(p) + 1)^(2g) [Weil].
        genus = (self.h.degree() - 1) // 2
        root = Fraction(isqrt(int(self.h.modulus()) << 40), 1 << 20)  # at most sqrt(p), and more than sqrt(p) - 2^-20
        least = max(int((root - 1) ** (2 * genus)), 1)
        most = int((root + 1 + Fraction(1, 1 << 20)) ** (2 * genus)) + 1
        s = isqrt(most - least) + 1
        babies: dict[tuple[Any, ...], int] = {}
        current = self.zero
        for j in range(s):
            babies[current.key] = j
            current = self.add(current, value)
            if current == self.zero:
                return j + 1
        giant = self.multiple(s, value)
        current = self.multiple(least, value)
        for i in range(s + 2):
            n = least + i * s - babies.get(current.key, 0)
            if current.key in babies and n > 0:
                return n
            current = self.add(current, giant)
        raise AssertionError("the number of classes is in the interval of Hasse and Weil")

    def _reduced(self, u: Any, v: Any) -> DivisorClass:
        while 2 * u.degree() >= self.h.degree():
            u = _monic((self.h - v * v) // u)
            v = -v % u
        return DivisorClass(u, v)


def _monic(u: Any) -> Any:
    return u * pow(int(u.leading_coefficient()), -1, u.modulus())

"""Values of rational functions of parameters modulo a prime: the homomorphisms of Q(t1, ..., tk)."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any

from flint import nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.poly import Poly
from kovacic.algebra.rationals import RationalHomomorphism, RationalPoly

Exponents = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Evaluation(Homomorphism):
    """The parameters take the values `point` modulo p."""

    p: int
    point: Exponents

    def __call__(self, polynomial: Poly) -> Any:
        if isinstance(polynomial, RationalPoly):
            return RationalHomomorphism(self.p)(polynomial)
        num = polynomial.num  # type: ignore[attr-defined]
        den = polynomial.den  # type: ignore[attr-defined]
        scale = sum(self._columns(den)) % self.p
        if scale == 0:
            raise BadPrimeError("a parameter takes a forbidden value")
        image = nmod_poly(self._columns(num), self.p)
        return image if scale == 1 else image * pow(scale, -1, self.p)

    def _columns(self, polynomial: Any) -> list[int]:
        """The coefficients of the powers of x, which is variable number 0."""
        columns = [0] * (int(polynomial.degrees()[0]) + 1)
        for exponents, coefficient in polynomial.to_dict().items():
            columns[int(exponents[0])] += int(coefficient) * power_product(self.point, exponents[1:], self.p)
        return [c % self.p for c in columns]


def power_product(point: Exponents, exponents: Exponents, p: int) -> int:
    return prod(pow(base, exponent, p) for base, exponent in zip(point, exponents, strict=True) if exponent) % p

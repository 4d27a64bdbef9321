"""What products of powers and exponentials are made of: factors, rational functions and conics, with their derivatives.

The letters are those of `kovacic.doubles.product_form`, with the parametrisations (1) there.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from kovacic.doubles.double_double import Complex, Pair, absolute, double, horner, select, square_root

_MULTIPLIED_OUT = 8
"""Powers up to here are multiplied out, if they are integers."""


class Shape(Enum):
    """The three parametrisations (1)."""

    LINE = "line"
    HYPERBOLA = "hyperbola"
    ELLIPSE = "ellipse"


@dataclass(frozen=True)
class Conic:
    """s^2 = sigma g: `vertex` is -g(0) or -g'(0)/2, `m` as in (1), `ends` the real zeros of g for deg g = 2, in order.

    The numbers are Pairs here, and real balls in `kovacic.doubles.arrangement`.
    """

    shape: Shape
    sigma: int
    vertex: Any
    m: Any = None
    ends: tuple[Any, ...] = ()

    def coordinates(self, x: Any) -> tuple[Any, Any]:
        """(t, s) at points with sigma g(x) > 0, Pairs or arrays."""
        X = x - self.vertex
        if self.shape is Shape.LINE:
            sigma_g = X if self.sigma > 0 else -X
            s = square_root(sigma_g)
            return s, s
        if self.shape is Shape.ELLIPSE:
            left = x - self.ends[0]
            right = self.ends[1] - x
            return square_root(right / left), square_root(left * right)
        sigma_g = X * X + self.m
        if self.ends:  # the differences are exact near a branch point
            sigma_g = (x - self.ends[0]) * (x - self.ends[1])
        s = square_root(sigma_g)
        far = absolute(X) + s  # for X < 0, X + s would cancel, and m/(s - X) doesn't
        return select(double(X) < 0, self.m / far, far), s

    def slopes(self, x: Any, t: Any, s: Any) -> tuple[Any, Any]:
        """(dt/dx, ds/dx), by s ds/dx = sigma g'(x)/2 and the parametrisations."""
        if self.shape is Shape.LINE:
            slope = Pair(0.5 * self.sigma) / s
            return slope, slope
        X = x - self.vertex
        if self.shape is Shape.HYPERBOLA:
            return t / s, X / s
        M = (self.ends[1] - self.ends[0]) * Pair(0.5)
        return -(M / (s * (x - self.ends[0]))), -(X / s)


@dataclass(frozen=True)
class RootFactor:
    """((t - zeta)/turn)^power; a natural power up to 8 stands without its turn.

    `paired` stands for the product with the complex conjugate factor, which is positive for real t.
    """

    zeta: Complex
    power: Complex
    turn: Complex
    paired: bool

    @property
    def whole(self) -> int | None:
        """The power, where that is a small integer."""
        k = self.power.re.hi
        is_small = self.power.im is None and abs(k) <= _MULTIPLIED_OUT
        return round(k) if is_small and k == round(k) else None

    @property
    def is_natural(self) -> bool:
        """Is the power a small integer that isn't negative?"""
        return self.whole is not None and self.whole >= 0

    def slope(self, t: Complex) -> Complex:
        """The derivative of its logarithm by t."""
        found = self.power * (t - self.zeta).reciprocal()
        return Complex(found.re * Pair(2.0)) if self.paired else found

    def zeros(self, t: Complex) -> Any:
        """Where t is exactly its zero, for a natural power."""
        d = t - self.zeta
        if self.power.im is not None or self.power.re.hi <= 0:
            return np.zeros(np.shape(double(d.re)), dtype=bool)
        found = double(d.re) == 0
        return found if d.im is None else found & (double(d.im) == 0)


@dataclass(frozen=True)
class RationalFunction:
    """Polynomial (coefficients high to low) plus the sum of c/(x - a)^k over `polar` = ((a, c, k), ...)."""

    polynomial: tuple[Complex, ...] = ()
    polar: tuple[tuple[Complex, Complex, int], ...] = ()

    def __call__(self, x: Complex, times: Complex | None = None) -> Complex | None:
        """The value at x, `times` something; None for the zero function."""
        terms = [horner(self.polynomial, x)] if self.polynomial else []
        for a, c, k in self.polar:
            inverse = (x - a).reciprocal()
            for _ in range(k):
                c *= inverse
            terms.append(c)
        total = sum_of(terms)
        if total is None or times is None:
            return total
        return total * times

    @property
    def derivative(self) -> RationalFunction:
        """By x."""
        degree = len(self.polynomial) - 1
        powers = [Complex(Pair(float(degree - k))) for k in range(degree)]
        polynomial = tuple(c * power for c, power in zip(self.polynomial[:-1], powers, strict=True))
        polar = tuple((a, c * Complex(Pair(float(-k))), k + 1) for a, c, k in self.polar)
        return RationalFunction(polynomial, polar)


def sum_of(terms: list[Complex]) -> Complex | None:
    """None for no terms."""
    return sum(terms[1:], terms[0]) if terms else None

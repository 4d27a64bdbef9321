"""The data of a product in double precision: its factors, its exponent, and the curve that it lives on.

With X = x + g'(0)/2 and g = X^2 + m for deg g = 2 (g is monic), sigma = +-1 so that sigma g > 0:

    LINE       deg g = 1:                t = s,                x = -g(0) + sigma t^2,
    HYPERBOLA  deg g = 2, sigma = 1:     t = X + s,            X = (t^2 - m)/(2 t),
    ELLIPSE    deg g = 2, sigma = -1:    t = s/(M + X),        X = M (1 - t^2)/(1 + t^2),      M = sqrt(-m).            (1)
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from kovacic.doubles.double_double import (
    Complex,
    Pair,
    add,
    complex_add,
    complex_horner,
    complex_multiply,
    complex_reciprocal,
    divide,
    multiply,
    negative,
    square_root,
    subtract,
)


class Shape(Enum):
    """The three parametrisations (1)."""

    LINE = "line"
    HYPERBOLA = "hyperbola"
    ELLIPSE = "ellipse"


@dataclass(frozen=True)
class Conic:
    """s^2 = sigma g with double-double data: `vertex` is -g(0) or -g'(0)/2, `m` as in (1).

    `ends` are the real zeros of g, in order (empty for deg g = 2 without real zeros).
    """

    shape: Shape
    sigma: int
    vertex: tuple[float, float]
    m: tuple[float, float]
    ends: tuple[tuple[float, float], ...]

    def coordinates(self, x: Pair) -> tuple[Pair, Pair]:
        """(t, s) at points with sigma g(x) > 0."""
        if self.shape is Shape.LINE:
            d = subtract(x, self.vertex)
            s = square_root(d if self.sigma > 0 else negative(d))
            return s, s
        X = subtract(x, self.vertex)
        if self.shape is Shape.ELLIPSE:
            left, right = subtract(x, self.ends[0]), subtract(self.ends[1], x)
            return square_root(divide(right, left)), square_root(multiply(left, right))
        differences = [subtract(x, end) for end in self.ends]  # exact near a branch point, unlike X^2 + m
        s = square_root(multiply(*differences) if differences else add(multiply(X, X), self.m))
        behind = X[0] < 0  # there X + s would cancel, and m/(s - X) doesn't
        far = add((np.abs(X[0]), np.where(behind, -X[1], X[1])), s)
        near = divide(self.m, far)
        return (np.where(behind, near[0], far[0]), np.where(behind, near[1], far[1])), s


@dataclass(frozen=True)
class Factor:
    """(t - zeta)^power, over `turn`; `whole` is the exponent where it is a small natural number.

    `paired` stands for the product with the complex conjugate factor, which is positive for real t.
    """

    zeta: Complex
    power: Complex
    turn: Complex
    whole: int | None
    paired: bool


@dataclass(frozen=True)
class RationalFunction:
    """Polynomial (coefficients high to low) plus the sum of c/(x - a)^k over `polar` = ((a, c, k), ...)."""

    polynomial: tuple[Complex, ...]
    polar: tuple[tuple[Complex, Complex, int], ...]

    def __call__(self, x: Complex) -> Complex:
        """The value at x."""
        total = complex_horner(self.polynomial, x)
        for a, c, k in self.polar:
            inverse = complex_reciprocal((subtract(x[0], a[0]), subtract(x[1], a[1])))
            term = c
            for _ in range(k):
                term = complex_multiply(term, inverse)
            total = complex_add(total, term)
        return total

    def __bool__(self) -> bool:
        return bool(self.polynomial or self.polar)

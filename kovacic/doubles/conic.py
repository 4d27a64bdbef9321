"""Rational curves s^2 = sigma g(x), deg g = 1 or 2, sigma = +-1 so that sigma g > 0: parameters that are real on an interval.

On such a curve the solutions of case 2 are of case 1 in the parameter t: y'/y dx has simple poles with constant residues in t,
apart from an exact part.  With X = x + g'(0)/2 and g = X^2 + m for deg g = 2 (g is monic):

    LINE       deg g = 1:                t = s,                x = -g(0) + sigma t^2,
    HYPERBOLA  deg g = 2, sigma = 1:     t = X + s,            X = (t^2 - m)/(2 t),
    ELLIPSE    deg g = 2, sigma = -1:    t = s/(M + X),        X = M (1 - t^2)/(1 + t^2),      M = sqrt(-m).            (1)

A point (a, s_a) has the parameter t_a, its conjugate (a, -s_a) has t_a', and x - a is a constant times
(t - t_a)(t - t_a')/D(t) with D = 1, t, 1 + t^2 respectively.  On the ellipse a = -M has t_a = infinity: x - a = 2 M/D.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

from kovacic.doubles.double_double import Pair, add, divide, multiply, negative, pair_of, square_root, subtract

if TYPE_CHECKING:
    from flint import acb, acb_poly, arb


class Shape(Enum):
    """The three parametrisations of (1)."""

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
        import numpy as np

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
class ExactConic:
    """The same with balls, for the parameters of given points."""

    shape: Shape
    sigma: int
    vertex: arb
    m: arb

    def root(self, a: acb) -> acb:
        """s_a, one of the two square roots of sigma g(a)."""
        X = a - self.vertex
        square = X if self.shape is Shape.LINE else X * X + self.m
        return square * 0 if square.contains(0) else (square * self.sigma).sqrt()

    def parameters(self, a: acb, s: acb) -> tuple[acb, acb] | None:
        """t_a and t_a'; None for a at infinity of the ellipse."""
        if self.shape is Shape.LINE:
            return s, -s
        X = a - self.vertex
        if self.shape is Shape.HYPERBOLA:
            return X + s, X - s
        M = (-self.m).sqrt()
        if (M + X).contains(0):
            return None
        return s / (M + X), -s / (M + X)

    def rounded(self) -> Conic:
        """The data for double precision."""
        if self.shape is Shape.LINE:
            return Conic(self.shape, self.sigma, pair_of(self.vertex), (0.0, 0.0), (pair_of(self.vertex),))
        ends: tuple[tuple[float, float], ...] = ()
        if self.m < 0:
            M = (-self.m).sqrt()
            ends = (pair_of(self.vertex - M), pair_of(self.vertex + M))
        return Conic(self.shape, self.sigma, pair_of(self.vertex), pair_of(self.m), ends)


def conic_of(g: acb_poly, middle: arb) -> ExactConic | None:
    """The curve whose s is real near `middle`; None for another degree, or coefficients that aren't real."""
    coefficients: list[Any] = g.coeffs()
    if len(coefficients) not in (2, 3) or any(not c.imag.contains(0) for c in coefficients):
        return None
    low, *rest = (c.real for c in coefficients)
    value = g(middle).real
    if value.contains(0):
        return None
    sigma = 1 if value > 0 else -1
    if len(rest) == 1:
        return ExactConic(Shape.LINE, sigma, -low, low)
    vertex = -rest[0] / 2
    return ExactConic(Shape.HYPERBOLA if sigma > 0 else Shape.ELLIPSE, sigma, vertex, low - vertex * vertex)

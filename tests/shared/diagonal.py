"""Eigenvalues of -y'' + V y = E y by diagonalisation with spectral elements, independent of every formula of the package.

Infinite ends are cut where solutions of the energy have decayed, and elements get smaller towards finite ends by a fixed ratio,
so that powers of the distance and essential singularities are met.  y = 0 at all ends, but where `neumann` says y' = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import inf, sqrt

import numpy as np
import scipy.linalg

Potential = Callable[[np.ndarray], np.ndarray]
_DEGREE = 14
#: Of the sizes of elements next to a finite end, and how many there are.
_RATIO, _GRADED = 0.35, 28
#: exp(-_DEPTH) is small enough for y at a cut.
_DEPTH = 26.0


def eigenvalues(
    V: Potential,
    ends: tuple[float, float],
    below: float,
    energy: float,
    neumann: tuple[bool, bool] = (False, False),
) -> np.ndarray:
    """The lowest ones, in order; those of at most the energy are right to some ten digits.

    No eigenvalue may be `below` a number e: these are the e + 1/mu, mu the largest eigenvalues of M v = mu (H - e M) v, which
    small elements don't disturb.  Raises `LinAlgError` where one is.
    """
    nodes = _nodes(V, ends, energy, neumann)
    x, weights = np.polynomial.legendre.leggauss(_DEGREE + 12)
    # Functions on an element: the two linear ones, and integrals of Legendre polynomials, 0 at both ends.
    P = [np.polynomial.legendre.Legendre.basis(k) for k in range(_DEGREE + 1)]
    shapes = [(1 - x) / 2, (1 + x) / 2, *((P[k](x) - P[k - 2](x)) / sqrt(4 * k - 2) for k in range(2, _DEGREE + 1))]
    slopes = [0 * x - 0.5, 0 * x + 0.5, *(sqrt(k - 0.5) * P[k - 1](x) for k in range(2, _DEGREE + 1))]
    values, slopes = np.array(shapes), np.array(slopes)
    inner = _DEGREE - 1
    size = len(nodes) + (len(nodes) - 1) * inner
    H, M = np.zeros((size, size)), np.zeros((size, size))
    for k, (a, b) in enumerate(pairwise(nodes)):
        half = (b - a) / 2
        first = len(nodes) + k * inner
        numbers = np.array([k, k + 1, *range(first, first + inner)])
        w = weights * half
        potential = V((a + b) / 2 + half * x)
        H[np.ix_(numbers, numbers)] += slopes * w @ slopes.T / half**2 + values * (w * potential) @ values.T
        M[np.ix_(numbers, numbers)] += values * w @ values.T
    fixed = [number for number, free in zip((0, len(nodes) - 1), neumann, strict=True) if not free]
    kept = np.delete(np.arange(size), fixed)
    shifted = (H - below * M)[np.ix_(kept, kept)]
    scale = 1 / np.sqrt(np.diag(shifted))
    shifted, M = (matrix * np.outer(scale, scale) for matrix in (shifted, M[np.ix_(kept, kept)]))
    last = len(kept) - 1
    return below + 1 / scipy.linalg.eigvalsh(M, shifted, subset_by_index=[last - 12, last])[::-1]


def _nodes(V: Potential, ends: tuple[float, float], energy: float, regular: tuple[bool, bool]) -> np.ndarray:
    """The ends of the elements, which needn't get smaller towards a regular end."""
    low, high = ends
    if np.isfinite(low) and np.isfinite(high):
        centre = (low + high) / 2
    elif np.isfinite(low):
        centre = low + 1
    else:
        centre = high - 1 if np.isfinite(high) else 0.0
    left, right = (_half(V, centre, end, energy, is_graded=not flag) for end, flag in zip(ends, regular, strict=True))
    return np.array([*left[::-1], centre, *right])


def _half(V: Potential, centre: float, end: float, energy: float, *, is_graded: bool) -> list[float]:
    """From the middle towards one end."""
    if np.isfinite(end):
        parts = np.linspace(centre, end, 9)[1:-1]
        rest = end - parts[-1]
        graded = [end - rest * _RATIO**k for k in range(1, _GRADED)] if is_graded else []
        return [*parts, *graded, end]
    sign = 1.0 if end == inf else -1.0
    found, x, depth, last = [], centre, 0.0, 0.0
    while depth < _DEPTH and abs(x) < 2000:
        kappa = float(np.sqrt(abs(V(np.array([x]))[0] - energy)))
        step = min(1.5 / (kappa + 0.02), 0.25 + abs(x - centre) / 3)
        x += sign * step
        excess = float(V(np.array([x]))[0] - energy)
        last = sqrt(excess) if excess > 0 else 0.0
        depth += last * step
        found.append(x)
    return found

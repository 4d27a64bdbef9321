"""Smooth even 2 pi-periodic functions as cosine series, and their integrals: the quadratures of the motion.

Between two turning points x = mid + amp cos(phi); whatever depends on x alone is a function of cos(phi), so an integral
over phi is a multiple of phi plus a sine series, which converges as fast as a Chebyshev series: geometrically.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.fft import dct

from kovacic.errors import LimitExceeded

Array = NDArray[np.float64]

#: The largest number of sample points; beyond it the motion is as good as asymptotic to a steady one.
MAX_SAMPLES = 1 << 14
#: The way out where the quadratures over the phase don't converge.
ASYMPTOTIC = "change the initial velocity by 1e-5 of itself, or follow it by kovacic.ball.direct.integrate"


def cosine_series(function: Callable[[Any], Any], tolerance: float) -> Array:
    """c with function(phi) = sum c_k cos(k phi) up to `tolerance` times the largest c_k (or to rounding).

    The function is sampled at (j + 1/2) pi/N, never at a turning point.  The number of samples is doubled until the last
    eighth of the coefficients is below the tolerance or is a plateau of rounding errors; raises `LimitExceeded` at
    `MAX_SAMPLES`.
    """
    samples = 16
    while samples <= MAX_SAMPLES:
        phi = (np.arange(samples) + 0.5) * (np.pi / samples)
        coefficients: Array = dct(function(phi), type=2) / samples
        coefficients[0] /= 2
        size = np.abs(coefficients)
        floor = max(tolerance, 2e-16 * samples) * size.max()
        if size[-max(2, samples // 8) :].max() <= floor:
            kept = np.flatnonzero(size > floor / 4)
            return coefficients[: int(kept[-1]) + 1 if kept.size else 1]
        samples *= 2
    raise LimitExceeded(
        f"the integrand needs more than {MAX_SAMPLES} samples: the motion is nearly asymptotic, or the potential rough\n"
        f"  hint: {ASYMPTOTIC}",
        limit="samples",
    )


def divide(series: Array, pole: float) -> tuple[Array, float]:
    """H and the value G(pole) with G(z) = G(pole) + (z - pole) H(z), for a Chebyshev series G in z and |pole| near 1."""
    n = len(series) - 1
    H = np.zeros(n + 2)
    for k in range(n, 1, -1):
        H[k - 1] = 2 * series[k] + 2 * pole * H[k] - H[k + 1]
    if n >= 1:
        H[0] = series[1] + pole * H[1] - H[2] / 2
    value = float(series[0] - (H[1] / 2 - pole * H[0]))
    return H[: max(n, 1)], value


@dataclass(frozen=True, slots=True)
class Primitive:
    """The integral from 0 of a cosine series, and of at most two near poles split off it.

    `near` holds (offset, half weight, ratio): an angle 2 arctan(ratio tan((phi - offset)/2)), followed continuously, times
    the weight; an infinite ratio is a jump at phi = offset, half before and half after.
    """

    mean: float
    sines: Array
    near: tuple[tuple[float, float, float], ...] = ()

    @classmethod
    def of(cls, series: Array, near: tuple[tuple[float, float, float], ...] = ()) -> Primitive:
        return cls(float(series[0]), series[1:] / np.arange(1, len(series)), near)

    def __call__(self, phi: Array) -> Array:
        """The integral from 0 to phi."""
        value = self.mean * phi + _sine_sum(self.sines, phi)
        for offset, weight, ratio in self.near:
            value = value + weight * (_followed(phi - offset, ratio) - _followed(np.array(-offset), ratio))
        return value

    @property
    def over_period(self) -> float:
        """The integral over one period of phi."""
        return 2 * np.pi * (self.mean + sum(weight for _, weight, _ in self.near))


def _sine_sum(sines: Array, phi: Array) -> Array:
    """sum sines[k-1] sin(k phi), by Clenshaw's recurrence."""
    double = 2 * np.cos(phi)
    b1, b2 = np.zeros_like(phi), np.zeros_like(phi)
    for coefficient in sines[::-1]:
        b1, b2 = coefficient + double * b1 - b2, b1
    result: Array = np.sin(phi) * b1
    return result


def _followed(phi: Array, ratio: float) -> Array:
    """2 arctan(ratio tan(phi/2)), continuous in phi; for an infinite ratio the step function 2 pi floor(phi/(2 pi)) + pi."""
    if np.isinf(ratio):
        turns: Array = 2 * np.pi * np.floor(phi / (2 * np.pi)) + np.pi
        return turns
    s, c = np.sin(phi / 2), np.cos(phi / 2)
    result: Array = phi + 2 * np.arctan2((ratio - 1) * s * c, c * c + ratio * s * s)
    return result


def invert(primitive: Primitive, values: Array, tolerance: float) -> Array:
    """phi with primitive(phi) = values, for an increasing primitive: a table for the start, then Newton's method."""
    period = primitive.over_period
    turns = np.floor(values / period)
    rest = values - turns * period
    size = max(64, 4 * len(primitive.sines))
    grid = np.linspace(0, 2 * np.pi, size + 1)
    phi: Array = np.interp(rest, primitive(grid), grid)
    density = np.concatenate(([primitive.mean], primitive.sines * np.arange(1, len(primitive.sines) + 1)))
    for _ in range(12):
        change = (primitive(phi) - rest) / chebyshev.chebval(np.cos(phi), density)
        phi = phi - change
        if np.abs(change).max(initial=0.0) <= max(tolerance, 4e-16 * 2 * np.pi):
            break
    return phi + 2 * np.pi * turns

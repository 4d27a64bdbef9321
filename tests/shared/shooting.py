"""Eigenvalues of -y'' + V y = E y, bracketed by counting zeros: independent of every formula of the package.

The solution that is the smaller one at the left end is integrated to the right.  By Sturm's oscillation theorem it has as many
zeros in the domain as there are eigenvalues below E, so that E_n is the n-th one within eps exactly where it has n zeros at
E_n - eps and n + 1 at E_n + eps, zeros so near the right end that they aren't reached told by the sign of the growing part.
"""

from __future__ import annotations

from collections.abc import Callable
from math import isinf, sqrt

import numpy as np
from scipy.integrate import solve_ivp

Potential = Callable[[float], float]
#: exp(-_DEPTH) is small enough for the wrong solution at the start.
_DEPTH = 22.0


def zeros(V: Potential, a: float, b: float, energy: float, inside: float) -> int:
    """How many eigenvalues are below the energy: the zeros of the smaller solution on (a, b), from both sides to `inside`.

    The left and the right solution have k and m zeros; there is one more in between where their Wronskian has the sign that
    turns them into each other.
    """
    left, k = _from(V, a, inside, energy)
    right, m = _from(V, b, inside, energy)
    angle_left = np.arctan2(left[0], left[1]) % np.pi
    angle_right = np.arctan2(right[0], right[1]) % np.pi
    return k + m + int(angle_left > angle_right)


def _from(V: Potential, end: float, inside: float, energy: float) -> tuple[np.ndarray, int]:
    start, slope = _start(V, end, inside, energy)

    def equation(x: float, y: np.ndarray) -> tuple[float, float]:
        return y[1], (V(x) - energy) * y[0]

    found = solve_ivp(equation, (start, inside), (1.0, slope), method="DOP853", rtol=2e-13, atol=1e-300)
    assert found.success, found.message
    values = found.y[0]
    count = int(np.sum(values[1:] * values[:-1] < 0))
    last = found.y[:, -1]
    return last / np.abs(last).max(), count


def _start(V: Potential, end: float, inside: float, energy: float) -> tuple[float, float]:
    """A point near the end, and y'/y of the solution that is small there."""
    if isinf(end):
        step, x, depth = (0.02 if end > 0 else -0.02), inside, 0.0
        while depth < _DEPTH:
            x += step
            depth += sqrt(max(V(x) - energy, 0.0)) * abs(step)
            if abs(x) > 1e4:
                raise ValueError("no decay")
        return x, -np.sign(end) * sqrt(V(x) - energy)
    distance = 1e-5 * (inside - end)
    x = end + distance
    near, nearer = (V(end + d) * d**2 for d in (distance, distance / 2))
    if near > 50:  # an irregular end
        x = end + 0.02 * (inside - end)
        return x, np.sign(inside - end) * sqrt(V(x) - energy)
    strength = 2 * nearer - near  # V = strength/(x - a)^2 + weaker/(x - a) + ...
    weaker = (near - strength) / distance
    power = 0.5 + sqrt(max(strength + 0.25, 0.0))
    return x, power / distance + weaker / (2 * power)


def is_level(V: Potential, a: float, b: float, energy: float, number: int, inside: float, digits: int = 10) -> bool:
    """Is the eigenvalue of this number equal to the energy, to so many digits?"""
    eps = 10.0**-digits * max(1.0, abs(energy))
    below = zeros(V, a, b, energy - eps, inside)
    above = zeros(V, a, b, energy + eps, inside)
    return (below, above) == (number, number + 1)

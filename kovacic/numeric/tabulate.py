"""Any real solution as a vectorised NumPy function: piecewise Chebyshev interpolation of proven values.

For S of every kind, Liouvillian or not.  The interpolation error is estimated from the decay of the coefficients, not
proven; the
values at the nodes are enclosures by route (b).  The relative error is measured against the largest value on a piece:
near a zero of the
solution the absolute error stays as small, the relative one doesn't.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Limits
from kovacic.numeric.evaluate import evaluate_states
from kovacic.numeric.points import as_point
from kovacic.numeric.problem import as_problem

_NODES = 24
_TOLERANCE = 2.0**-50
"""Size of the last coefficients; the rounding of the transformation is just below."""

_MAX_PIECES = 2000


@dataclass(frozen=True)
class TabulatedFunction:
    """Pieces [ends[i], ends[i+1]] with Chebyshev coefficients (rows of `coefficients`): call it with an array of
    points."""

    ends: tuple[float, ...]
    coefficients: tuple[tuple[float, ...], ...]

    def __call__(self, x: Any) -> Any:
        """y(x); raises InputError outside of the interval."""
        import numpy as np

        points = np.asarray(x, dtype=float)
        ends = np.asarray(self.ends)
        if not np.all((points >= ends[0]) & (points <= ends[-1])):
            raise InputError(f"a point lies outside of the interval [{ends[0]}, {ends[-1]}] of this table")
        index = np.clip(np.searchsorted(ends, points, side="right") - 1, 0, len(ends) - 2)
        low, high = ends[index], ends[index + 1]
        t = ((points - low) - (high - points)) / (high - low)
        rows = np.asarray(self.coefficients)[index]
        later, last = np.zeros_like(t), np.zeros_like(t)
        for k in range(rows.shape[-1] - 1, 0, -1):
            later, last = 2 * t * later - last + rows[..., k], later
        return t * later - last + rows[..., 0]


def tabulate(
    equation: object,
    start: object,
    stop: object,
    *,
    x0: object,
    y0: object,
    dy0: object,
    limits: Limits | None = None,
) -> TabulatedFunction:
    """The solution with y(x0) = y0, y'(x0) = dy0 on [start, stop] in double precision; the interval must be regular.

    Raises InputError (an empty interval, a singular point, values that aren't real) and LimitExceeded (too many
    pieces).
    """
    a, b = as_point(start, "start"), as_point(stop, "stop")
    if not (a.is_real() and b.is_real()) or a.re >= b.re:
        raise InputError("the interval is empty", hint="give two real numbers, the smaller one first")
    problem = as_problem(equation)
    todo, done = [(a.re, b.re)], []
    while todo:
        low, high = todo.pop()
        coefficients = _piece(problem, low, high, x0, y0, dy0, limits)
        size = max(abs(c) for c in coefficients)
        if max(abs(c) for c in coefficients[-4:]) <= _TOLERANCE * size:
            done.append((low, high, coefficients))
            continue
        if len(todo) + len(done) > _MAX_PIECES:
            raise LimitExceeded(f"the table needs more than {_MAX_PIECES} pieces", limit="unknown_degree")
        middle = Fraction((low + high) / 2).limit_denominator(1 << 40)
        todo += [(low, middle), (middle, high)]
    done.sort()
    return TabulatedFunction(
        (*(float(piece[0]) for piece in done), float(done[-1][1])), tuple(piece[2] for piece in done)
    )


def _piece(
    problem: Any, low: Fraction, high: Fraction, x0: object, y0: object, dy0: object, limits: Limits | None
) -> tuple[float, ...]:
    """Chebyshev coefficients of the interpolant at the zeros of T_24."""
    import numpy as np

    angles = (np.arange(_NODES) + 0.5) * np.pi / _NODES
    nodes = [(low + high) / 2 + (high - low) / 2 * Fraction(float(c)) for c in np.cos(angles)]
    states = evaluate_states(problem, nodes, x0=x0, y0=y0, dy0=dy0, digits=20, limits=limits)
    if not all(state.y.real for state in states):
        raise InputError("the solution isn't real on the interval")
    values = np.array([float(state.y) for state in states])
    steps = np.outer(np.arange(_NODES), 2 * np.arange(_NODES) + 1) % (4 * _NODES)  # reduced exactly
    table = np.cos(steps * (np.pi / (2 * _NODES))) @ values * (2 / _NODES)
    table[0] /= 2
    return tuple(float(c) for c in table)

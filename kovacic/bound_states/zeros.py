"""Energies that are zeros of a polynomial, and the zeros of their solutions, in balls.

Zeros of P are counted in balls that contain one root each: a root whose ball meets the real axis is real, since its conjugate
is a root as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy
from flint import acb, acb_poly, arb, fmpz_poly

from kovacic.algebra.embedding import complex_zeros
from kovacic.closed_form.balls import BallEvaluator


def levels_of(polynomial: Any, E: Any) -> Iterator[tuple[Any, arb]]:
    """The real zeros of a polynomial with rational coefficients, as SymPy's numbers and as balls."""
    for factor, _ in sympy.factor_list(polynomial, E)[1]:
        exact = sympy.Poly(factor, E)
        scaled = exact.clear_denoms()[1] if exact.domain.is_QQ else exact
        balls = complex_zeros(fmpz_poly([int(c) for c in reversed(scaled.all_coeffs())]))
        real = sorted((ball.real for ball, _ in balls if ball.imag == 0), key=lambda ball: float(ball.mid()))
        yield from zip(exact.real_roots(), real, strict=True)


def zeros_inside(P: Any, E: Any, ball: arb, bounds: tuple[Any, Any]) -> int | None:
    """Number of zeros of the polynomial P between two bounds (None: unbounded) at the E in the ball.

    None if the balls are too large.
    """
    value = BallEvaluator({E: acb(ball)})
    coefficients = [value(c) for c in reversed(P.all_coeffs())]
    if len(coefficients) < 2:
        return 0
    low, high = (None if bound is None else BallEvaluator({})(bound).real for bound in bounds)
    count = 0
    for root in acb_poly(coefficients).roots():
        distances = [*([] if low is None else [root.real - low]), *([] if high is None else [high - root.real])]
        if not root.imag.contains(0) or any(distance < 0 for distance in distances):
            continue
        if any(distance.contains(0) for distance in distances):
            return None
        count += 1
    return count

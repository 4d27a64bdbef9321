"""Polynomial solutions of linear differential equations of second order with polynomial coefficients, exactly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from kovacic.algebra.poly import Poly


@dataclass(frozen=True)
class _Operator:
    """`second P'' + first P' + zeroth P`, which takes x^k to sum_j L_j(k) x^(k+s-j), L_j(k) = a_j k (k-1) + b_j k + c_j."""

    a: list[Any]
    b: list[Any]
    c: list[Any]

    def L(self, j: int, k: int) -> Any:
        return self.a[j] * (k * (k - 1)) + self.b[j] * k + self.c[j]


@dataclass(frozen=True)
class _Descent:
    """Coefficients p_0, ..., p_start; the power whose coefficient was free, and set to 0; what remains below x^0."""

    coefficients: list[Any]
    free: int | None
    remainder: list[Any]


def polynomial_solution(second: Poly, first: Poly, zeroth: Poly, degree: int, check: Callable[[], None]) -> Poly | None:
    """The monic P of the given degree with `second P'' + first P' + zeroth P = 0`, or None if there is none.

    The coefficients follow from the top: L_0(k) p_k = -sum_(j>0) L_j(k+j) p_(k+j).  L_0 vanishes at the degree and at no
    more than one other k; if that is a smaller natural number, a multiple of the solution that begins there may have to
    be added.  `check` is called now and then, for a time limit.
    """
    field = first.field
    shift = max(second.degree - 2, first.degree - 1, zeroth.degree)
    a, b, c = (
        [field.scalar(f, shift + offset - j) for j in range(shift + 3)]
        for f, offset in ((second, 2), (first, 1), (zeroth, 0))
    )
    operator = _Operator(a, b, c)
    if operator.L(0, degree):
        return None
    main = _descend(operator, degree, field.scalar(field.poly([1]), 0), check)
    if main is None:
        return None
    coefficients = main.coefficients
    if any(main.remainder):
        if main.free is None:
            return None
        other = _descend(operator, main.free, field.scalar(field.poly([1]), 0), check)
        if other is None:
            return None
        factor = next((-r / q for r, q in zip(main.remainder, other.remainder, strict=True) if q), None)
        if factor is None or any(r + factor * q for r, q in zip(main.remainder, other.remainder, strict=True)):
            return None
        for k, value in enumerate(other.coefficients):
            coefficients[k] = coefficients[k] + factor * value
    return field.from_scalars(coefficients)


def _descend(operator: _Operator, start: int, one: Any, check: Callable[[], None]) -> _Descent | None:
    """The solution x^start + ... as far as it goes; None if the free coefficient meets an obstruction."""
    width = len(operator.a)
    window: list[Any] = [one]  # p_(k+1), p_(k+2), ..., at most width - 1 of them
    coefficients: list[Any] = [one]
    remainder: list[Any] = []
    free: int | None = None
    for k in range(start - 1, -width, -1):
        if k % 64 == 0:
            check()
        total = one * 0
        for j, value in enumerate(window, start=1):
            if value:
                total = total + operator.L(j, k + j) * value
        if k < 0:
            remainder.append(total)
            value = one * 0
        else:
            pivot = operator.L(0, k)
            if pivot:
                value = -total / pivot
            elif total:
                return None
            else:
                free, value = k, one * 0
            coefficients.append(value)
        window.insert(0, value)
        del window[width - 1 :]
    return _Descent(coefficients[::-1], free, remainder)

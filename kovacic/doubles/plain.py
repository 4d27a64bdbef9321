"""The product of `kovacic.doubles.product_form` in plain double precision: a few operations a factor, for speed.

The arrangement is the same, and so is what it protects: t - zeta subtracts both halves of zeta, so that factors keep their
digits near their zeros.  What is lost against the careful variant: half a unit in the last place for each factor, the rounding
error of the exponent times its size, and values whose factors leave the range of doubles, although they don't.  Whole powers
are multiplied out, half-integer ones are square roots; every 900 bits the binary exponent is taken out of the product.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from kovacic.doubles.double_double import Complex
from kovacic.doubles.factors import Conic, Factor, RationalFunction, Shape

_LARGEST_WHOLE = 16
"""Twice a power up to here is multiplied out."""


def values(
    x: Any,
    factors: Sequence[Factor],
    exponent: RationalFunction,
    sheet: RationalFunction,
    conic: Conic | None,
    is_real: bool,
) -> Any:
    """y at an array of points, from the data of a `ProductForm`; overflow is silent, since the error is measured."""
    with np.errstate(all="ignore"):
        t, s = (x, 0.0) if conic is None else coordinates(conic, x)
        size, phase = rational(exponent, x)
        if sheet:
            on_sheet = rational(sheet, x)
            size, phase = size + s * on_sheet[0], phase + s * on_sheet[1]
        product = _Product(t, factors, is_real)
        for factor in factors:
            product.multiply(factor)
        return product.times_exponential(size, phase)


class _Product:
    """The product of the factors so far: real / below * complex * 2^binary * exp(size + i phase)."""

    def __init__(self, t: Any, factors: Sequence[Factor], is_real: bool) -> None:
        self.t, self.is_real = t, is_real
        self.real: Any = np.ones(np.shape(t))
        self.below: Any = None
        self.complex: Any = 1.0 + 0.0j
        self.binary: Any = None
        self.size: Any = 0.0
        self.phase: Any = 0.0
        self._bits, self._scratch = 0.0, np.empty(np.shape(t))
        reach = np.max(np.abs(t)) if np.size(t) else 1.0
        self._reach = max([abs(f.zeta[0][0]) + abs(f.zeta[1][0]) for f in factors], default=0.0) + reach + 2.0

    def multiply(self, f: Factor) -> None:
        (a, a_low), (b, _) = f.zeta
        power, twist = f.power[0][0], f.power[1][0]
        if np.iscomplexobj(self.t) or (b and not self.is_real) or (twist and not f.paired):
            self._multiply_complex(f)
            return
        d = np.subtract(self.t, a, out=self._scratch)
        if a_low:
            d -= a_low
        if twist:
            self.size = self.size - 2 * twist * _angle(d, -b, f.turn)
        if f.paired:
            d *= d
            d += b * b
        if f.whole is None:
            np.abs(d, out=d)
        whole = 2 * power
        if whole != round(whole) or abs(whole) > _LARGEST_WHOLE:
            self.real *= np.power(d, power)
            return
        count, odd = divmod(abs(round(whole)), 2)
        if power < 0 and self.below is None:
            self.below = np.ones(np.shape(self.t))
        target = self.real if power > 0 else self.below
        for _ in range(count):
            self._take_out(target, 2 if f.paired else 1)
            target *= d
        if odd:
            target *= np.sqrt(d, out=d)

    def times_exponential(self, size: Any, phase: Any) -> Any:
        """The value, times exp(size + i phase)."""
        size, phase = size + self.size, phase + self.phase
        result = self.real if self.below is None else self.real / self.below
        if np.ndim(size) or size:
            result = result * np.exp(size)
        if self.binary is not None:
            result = np.ldexp(result, self.binary)
        if self.is_real:
            return result
        if np.ndim(phase) or phase:
            turned = np.empty(np.shape(self.t), dtype=complex)
            turned.real, turned.imag = np.cos(phase) * result, np.sin(phase) * result
            result = turned
        return result * self.complex

    def _take_out(self, target: Any, degree: int) -> None:
        """The binary exponent of the numerator, before the product may leave the range of doubles."""
        self._bits += degree * math.log2(self._reach)
        if self._bits > 900 and target is self.real:
            self.real[...], shift = np.frexp(self.real)
            self.binary = shift if self.binary is None else self.binary + shift
            self._bits = degree * math.log2(self._reach)

    def _multiply_complex(self, f: Factor) -> None:
        d = self.t - complex(f.zeta[0][0], f.zeta[1][0])
        d -= complex(f.zeta[0][1], f.zeta[1][1])
        if f.whole is not None:
            for _ in range(f.whole):
                self.complex = self.complex * d
            return
        logarithm = np.log(d * complex(f.turn[0][0], -f.turn[1][0])) * complex(f.power[0][0], f.power[1][0])
        self.size, self.phase = self.size + logarithm.real, self.phase + logarithm.imag


def _angle(re: Any, im: float, turn: Complex) -> Any:
    """The argument of (re + i im)/turn."""
    c, s = turn[0][0], turn[1][0]
    return np.arctan2(im * c - re * s, re * c + im * s)


def coordinates(conic: Conic, x: Any) -> tuple[Any, Any]:
    """(t, s) as `Conic.coordinates`."""
    X = (x - conic.vertex[0]) - conic.vertex[1]
    if conic.shape is Shape.LINE:
        s = np.sqrt(conic.sigma * X)
        return s, s
    ends = [(x - end[0]) - end[1] for end in conic.ends]
    if conic.shape is Shape.ELLIPSE:
        return np.sqrt(-ends[1] / ends[0]), np.sqrt(-ends[0] * ends[1])
    s = np.sqrt(ends[0] * ends[1] if ends else X * X + conic.m[0])
    far = np.abs(X) + s
    return np.where(X < 0, conic.m[0] / far, far), s


def rational(r: RationalFunction, x: Any) -> tuple[Any, Any]:
    """Real and imaginary part; for real x and poles in real arithmetic, and 0.0 for a part that is 0."""
    if np.iscomplexobj(x) or any(a[1][0] for a, _, _ in r.polar):
        total = _sum([_number(c) for c in r.polynomial], [(_number(a), _number(c), k) for a, c, k in r.polar], x + 0.0j)
        return np.real(total), np.imag(total)
    parts = [_sum([c[i][0] for c in r.polynomial], [(a[0][0], c[i][0], k) for a, c, k in r.polar], x) for i in (0, 1)]
    return parts[0], parts[1]


def _number(z: Complex) -> complex:
    return complex(z[0][0], z[1][0])


def _sum(coefficients: list[Any], polar: list[tuple[Any, Any, int]], x: Any) -> Any:
    total: Any = 0.0
    for c in coefficients:
        total = total * x + c if np.ndim(total) or total else c
    for a, c, k in polar:
        if c:
            inverse, term = 1 / (x - a), c
            for _ in range(k):
                term = term * inverse
            total = total + term
    return total

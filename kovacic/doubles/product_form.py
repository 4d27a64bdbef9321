"""Products of powers and exponentials in double precision, arranged so that no digit is lost:

    y(x) = constant * prod_k (t - z_k)^(n_k) * prod_j ((t - zeta_j)/turn_j)^(r_j) * exp(E(x) + s F(x)),

t = x itself, or the parameter of a rational curve s^2 = sigma g(x), deg g = 1 or 2, sigma = +-1 so that sigma g > 0, that is
real on an interval (`kovacic.doubles.factors`).

- Polynomial factors stay products over their zeros z_k, which are double-doubles: t - z_k keeps its digits near a zero.
- Their product is collected with its binary exponent apart, and all powers with other exponents as one logarithm r_j log
  in double-doubles: huge exponents, and factors that cancel, cost neither range nor digits.
- E and F are kept as partial fractions with double-double coefficients.
- |turn_j| = 1, and (t - zeta_j)/turn_j > 0 at the middle of the interval, so that the principal power is the continuous
  one along the straight line from there: a quotient of points on a line that misses 0 never meets the negative real axis.

Nothing is proven about rounding errors here; `kovacic.doubles.lambdify` measures them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from kovacic.doubles.double_double import (
    Complex,
    Pair,
    add,
    angle,
    complex_add,
    complex_multiply,
    log,
    log_2,
    multiply,
    negative,
    scaled,
    subtract,
    two_sum,
)
from kovacic.doubles.factors import Conic, Factor, RationalFunction
from kovacic.doubles.plain import values
from kovacic.doubles.region import Measured, Region, in_blocks
from kovacic.enclosure.points import Point


@dataclass(frozen=True)
class ProductForm:
    """The product at the head of this module: call it with an array of points, `log` gives the sign (or phase factor)
    and log |y|, without overflow.

    `base` is the point near the middle where powers are positive.  `is_real` says that the function is real; then pairs of
    conjugate factors are merged.  `careful` stands for double-doubles, else it is plain double arithmetic
    (`kovacic.doubles.plain`); `measured` is the error that `lambdify` found.
    """

    region: Region
    base: Point
    factors: tuple[Factor, ...]
    exponent: RationalFunction
    sheet: RationalFunction
    conic: Conic | None
    is_real: bool
    careful: bool = True
    measured: Measured | None = None

    def __call__(self, x: Any) -> Any:
        """y(x) as doubles, or complex doubles (inf or 0 where the value is beyond their range)."""
        return in_blocks(self._values if self.careful else self._plain_values, self.region.points(x))

    def _plain_values(self, x: Any) -> Any:
        return values(x, self.factors, self.exponent, self.sheet, self.conic, self.is_real)

    def _values(self, x: Any) -> Any:
        mantissa, binary, size, phase = self._parts(x)
        turns = np.rint(size[0] / log_2()[0])
        rest = subtract(size, multiply((turns, 0.0 * turns), log_2()))
        growth = np.exp(rest[0])
        growth = growth + growth * rest[1]
        exponent = np.clip(binary + turns, -6000, 6000).astype(np.int64)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            if phase is None:
                return np.ldexp(growth * (mantissa[0][0] + mantissa[0][1]), exponent)
            c, s = np.cos(phase[0]), np.sin(phase[0])
            unit = ((c, -phase[1] * s), (s, phase[1] * c))
            (a, a_lo), (b, b_lo) = complex_multiply(mantissa, unit)
            result = np.empty(np.shape(c), dtype=complex)
            result.real, result.imag = np.ldexp(growth * (a + a_lo), exponent), np.ldexp(growth * (b + b_lo), exponent)
            return result[()]

    def log(self, x: Any) -> tuple[Any, Any]:
        """(sign, log |y(x)|), or for complex functions (y/|y|, log |y|)."""
        mantissa, binary, size, phase = self._parts(self.region.points(x))
        value = mantissa[0][0] if phase is None else mantissa[0][0] + 1j * mantissa[1][0]
        modulus = np.abs(value)
        with np.errstate(divide="ignore"):
            total = add(size, multiply((binary, 0.0 * binary), log_2()))[0] + np.log(modulus)
        if phase is None:
            return np.sign(value), total
        unit = np.divide(value, modulus, out=np.zeros_like(value), where=modulus != 0)
        return unit * np.exp(1j * phase[0]), total

    def _parts(self, x: Any) -> tuple[Complex, Any, Pair, Pair | None]:
        """y = mantissa * 2^binary * exp(size + i phase); phase None for a real function."""
        zero = 0.0 * x.real
        point: Complex = ((x.real, zero), (x.imag + zero, zero))
        t, total = point, self.exponent(point)
        if self.conic is not None:
            parameter, s = self.conic.coordinates(point[0])
            t = (parameter, (zero, zero))
            if self.sheet:
                total = complex_add(total, complex_multiply(self.sheet(point), (s, (zero, zero))))
        if self.is_real:
            return self._real_product(t[0], total[0])
        return self._complex_product(t, total)

    def _real_product(self, t: Pair, size: Pair) -> tuple[Complex, Any, Pair, None]:
        zero = 0.0 * t[0]
        mantissa, binary = (zero + 1.0, zero), zero
        for f in self.factors:
            d = subtract(t, f.zeta[0])
            e = _exponent(d[0], zero + f.zeta[1][0])
            d, height = scaled(d, -e), scaled((zero + f.zeta[1][0], zero + f.zeta[1][1]), -e)
            base = add(multiply(d, d), multiply(height, height)) if f.paired else d
            double = 2 if f.paired else 1
            if f.whole is not None:
                for _ in range(f.whole):
                    mantissa = multiply(mantissa, base)
                    shift = np.frexp(mantissa[0])[1]
                    mantissa, binary = two_sum(*scaled(mantissa, -shift)), binary + shift + double * e
                continue
            negated = base[0] < 0
            logarithm = log((np.abs(base[0]), np.where(negated, -base[1], base[1])))
            logarithm = add(logarithm, multiply((double * e.astype(float), zero), log_2()))
            size = add(size, multiply(f.power[0], logarithm))
            if f.paired and f.power[1][0] != 0.0:
                turned = complex_multiply((d, negative(height)), _conjugate(f.turn))
                bend = multiply(f.power[1], angle(turned[1], turned[0]))
                size = subtract(size, (2 * bend[0], 2 * bend[1]))
        return (mantissa, (zero, zero)), binary, size, None

    def _complex_product(self, t: Complex, total: Complex) -> tuple[Complex, Any, Pair, Pair]:
        zero = 0.0 * t[0][0]
        mantissa: Complex = ((zero + 1.0, zero), (zero, zero))
        binary, (size, phase) = zero, total
        for f in self.factors:
            d: Complex = (subtract(t[0], f.zeta[0]), subtract(t[1], f.zeta[1]))
            e = _exponent(d[0][0], d[1][0])
            d = (scaled(d[0], -e), scaled(d[1], -e))
            if f.whole is not None:
                for _ in range(f.whole):
                    mantissa = complex_multiply(mantissa, d)
                    shift = _exponent(mantissa[0][0], mantissa[1][0])
                    mantissa, binary = (scaled(mantissa[0], -shift), scaled(mantissa[1], -shift)), binary + shift + e
                continue
            norm = log(add(multiply(d[0], d[0]), multiply(d[1], d[1])))
            modulus = add((norm[0] / 2, norm[1] / 2), multiply((e.astype(float), zero), log_2()))
            turned = complex_multiply(d, _conjugate(f.turn))
            term = complex_multiply(f.power, (modulus, angle(turned[1], turned[0])))
            size, phase = add(size, term[0]), add(phase, term[1])
        return mantissa, binary, size, phase


def _conjugate(z: Complex) -> Complex:
    return z[0], negative(z[1])


def _exponent(a: Any, b: Any) -> Any:
    """The binary exponent of the larger of |a| and |b| (0 for 0)."""
    return np.frexp(np.maximum(np.abs(a), np.abs(b)))[1]

"""Equations whose constants are known by balls: algebraic constants such as sqrt(2), and parameters with irrational values.

The guarantee: `Embedded.system` has (Gaussian) integers and a radius, such that every coefficient of the exact equation,
scaled by the same power of two, differs from its integer by at most that radius.  What this means for the solutions is bounded
disc by disc (`kovacic.enclosure.frame`), so the exact solution of the exact equation lies in the balls.

A constant of an extension Q(c) is the root of the modulus that the text named (sqrt(2) is positive).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from flint import acb, acb_poly, arb, arb_poly

from kovacic.algebra.embedding import root_near
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.factors import squarefree_factors
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly, to_fmpq
from kovacic.enclosure.constants import Number, to_ball
from kovacic.enclosure.log_derivative import LogDerivative, sharp_roots
from kovacic.enclosure.points import are_real, floor
from kovacic.enclosure.system import System
from kovacic.errors import InputError, LimitExceeded

# Bits beyond twice the precision to which the constants are known: the solutions grow in a disc, and poles may be near
_EXTRA = 256
_UNDEFINED = "the equation isn't defined at these values of the parameters, as far as they are known"


@dataclass(frozen=True)
class Embedded:
    """S and the gauge over a field of constants, with the values of the parameters."""

    S: RatFunc
    gauge: RatFunc | None
    values: Mapping[str, Number]

    @property
    def exact(self) -> bool:
        """True if every precision can be had."""
        return not any(getattr(value, "fixed", False) for value in self.values.values())

    def system(self, prec: int) -> System:
        """Numerator and denominator of S times the same power of two, rounded to integers, with the radius of the rounding."""
        bits = 2 * prec + _EXTRA
        with working_precision(2 * bits):
            num, den = ([c * arb((1, bits)) for c in part.coeffs()] for part in self.polynomials())
            is_finite = all(c.is_finite() for c in (*num, *den))
            if not is_finite or not den[-1].real != 0:
                raise InputError(_UNDEFINED)
            above = _Integers.below(num)
            below = _Integers.below(den)
            below.re[-1] = below.re[-1] or 1  # which makes the radius larger
            radius = max(above.radius(num), below.radius(den))
            imaginary = None
            if not all(c.imag.is_zero() for c in (*num, *den)):
                imaginary = (tuple(above.im), tuple(below.im))
            return System(tuple(above.re), tuple(below.re), radius, imaginary)

    def is_real(self) -> bool:
        """True if the coefficients of S and of the gauge are real."""
        functions = [self.S] if self.gauge is None else [self.S, self.gauge]
        return all(are_real(self._embed(part).coeffs()) for f in functions for part in (f.num, f.den))

    def polynomials(self) -> tuple[acb_poly, acb_poly]:
        """Numerator and denominator of S, at the working precision in force."""
        return self._embed(self.S.num), self._embed(self.S.den)

    def poles(self, function: RatFunc | None = None) -> list[tuple[acb, int]]:
        """Those of S, or of another function, with their exact multiplicities; raises LimitExceeded where they can't be told
        apart."""
        found: list[tuple[acb, int]] = []
        for factor, k in squarefree_factors((function or self.S).den):
            roots = sharp_roots(self._embed(factor)) if factor.degree else []
            if len(roots) < factor.degree:
                raise LimitExceeded("the singular points can't be told apart at this precision", limit="digits")
            found += [(root, k) for root in roots]
        return found

    def log_derivative(self) -> LogDerivative | None:
        """The gauge at the working precision in force."""
        if self.gauge is None:
            return None
        return LogDerivative.of(self.gauge, self._embed, self.poles(self.gauge))

    def equation(self) -> tuple[arb_poly, arb_poly, arb_poly]:
        """a, b and c of the user's equation, whose constants are real, at the working precision in force."""
        gauge = self.gauge or self.S * 0
        parts = (self.S.num, self.S.den, gauge.num, gauge.den)
        p, q, n, d = (arb_poly([c.real for c in self._embed(part).coeffs()]) for part in parts)
        return d * d * q, -2 * n * d * q, (n * n - n.derivative() * d + n * d.derivative()) * q - p * d * d

    def coefficients(self, ball: acb) -> tuple[acb, acb]:
        """b/a and c/a on the ball, for a z'' + b z' + c z = 0, z = g y."""
        total = self.value(self.S, ball)
        if self.gauge is None:
            return acb(0), -total
        gamma, slope = (self.value(f, ball) for f in (self.gauge, self.gauge.derivative()))
        return -2 * gamma, gamma * gamma - slope - total

    def value(self, function: RatFunc, x: acb) -> acb:
        """Another function over the same field, on a ball."""
        value: acb = self._embed(function.num)(x) / self._embed(function.den)(x)
        return value

    def _embed(self, poly: Poly) -> acb_poly:
        """The polynomial at the working precision in force."""
        if isinstance(poly, RationalPoly):
            return acb_poly(poly.rep)
        if isinstance(poly, ExtensionPoly):
            c = root_of(poly.field)
            return sum((self._embed(part) * c**k for k, part in enumerate(poly.parts)), acb_poly([]))
        assert isinstance(poly, FunctionPoly)
        balls = [to_ball(self.values[name]) for name in poly.field.names]
        return _at(poly.num, balls) * (1 / _at(poly.den, balls)[0])


@dataclass(frozen=True)
class _Integers:
    """Gaussian integers in the place of coefficients: the real and the imaginary parts."""

    re: list[int]
    im: list[int]

    @classmethod
    def below(cls, coefficients: list[acb]) -> _Integers:
        """The integers below the midpoints."""
        return cls([floor(c.real.mid()) for c in coefficients], [floor(c.imag.mid()) for c in coefficients])

    def radius(self, coefficients: list[acb]) -> int:
        """An integer beyond their distances from the coefficients; 0 where there are none."""
        integers = map(acb, self.re, self.im)
        errors = [abs(c - integer).upper() for c, integer in zip(coefficients, integers, strict=True)]
        return max((floor(error) + 1 for error in errors), default=0)


def check_apart(points: Iterable[acb], a: acb, b: acb) -> None:
    """Raise InputError unless it is certain that none of these singular points lies on the straight segment."""
    ratios = ((b - point) / (a - point) for point in points)
    # (b - z)/(a - z) is negative or 0 for z on the segment only
    if not all(ratio.real > 0 or not ratio.imag.contains(0) for ratio in ratios):
        raise InputError(
            "the path runs through a singular point of the equation, or so near that its constants don't tell",
            hint="go around it: path='above', or path=[...] with a vertex off the axis",
            shell="go around it: --path above, or --path below",
        )


def _at(polynomial: Any, values: list[acb]) -> acb_poly:
    """A polynomial over Z in x and the parameters at these values of the latter."""
    columns: dict[int, acb] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        term = acb(coefficient)
        for value, exponent in zip(values, exponents[1:], strict=True):
            term *= value ** int(exponent)
        power = int(exponents[0])
        columns[power] = columns.get(power, acb(0)) + term
    return acb_poly([columns.get(k, acb(0)) for k in range(max(columns, default=-1) + 1)])


def root_of(field: AlgebraicField) -> acb:
    """The generator, at the working precision in force."""
    modulus = [field.base.rational_value(field.modulus[k]) for k in range(field.dimension + 1)]
    if field.approximation is None or None in modulus:
        raise InputError(f"which root of {field.modulus} the constant {field.name} is isn't known")
    rep = QQ.poly([c for c in modulus if c is not None]).rep
    return root_near(rep.numer(), acb(*(arb(to_fmpq(part)) for part in field.approximation)))

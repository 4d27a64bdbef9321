"""Equations whose constants are known by balls: algebraic constants such as sqrt(2), and parameters with irrational values.

The guarantee: `Embedded.system` returns a system with integer coefficients and a `radius`, such that every coefficient of the
exact equation, scaled by the same power of two, differs from the integer by at most that radius.  What this means for the
solutions is bounded disc by disc (`kovacic.enclosure.frame`), so the exact solution of the exact equation lies in the balls.

A constant of an extension Q(c) is the root of the modulus that the text named (sqrt(2) is positive).  The coefficients
must be real.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from flint import acb, acb_poly, arb, arb_poly, ctx

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.factors import squarefree_factors
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly, to_fmpq
from kovacic.enclosure.constants import Number, to_ball
from kovacic.enclosure.exponential import LogDerivative, sharp_roots
from kovacic.enclosure.points import floor, working_precision
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

    def coefficients(self, prec: int) -> tuple[tuple[int, ...], tuple[int, ...], int]:
        """Numerator and denominator of S times the same power of two, rounded to integers, and the radius."""
        bits = 2 * prec + _EXTRA
        with working_precision(2 * bits):
            parts = [_real(self._embed(part)) for part in (self.S.num, self.S.den)]
            scaled = [[c * arb((1, bits)) for c in part] for part in parts]
            if not scaled[1][-1] != 0:
                raise InputError(_UNDEFINED)
            whole = [[floor(c.mid()) for c in part[:-1]] + [floor(c.mid()) or 1 for c in part[-1:]] for part in scaled]
            pairs = (pair for part, ints in zip(scaled, whole, strict=True) for pair in zip(part, ints, strict=True))
            radius = max((floor(abs(c - n).upper()) + 1 for c, n in pairs), default=0)
            return tuple(whole[0]), tuple(whole[1]), radius

    def polynomials(self) -> tuple[acb_poly, acb_poly]:
        """Numerator and denominator of S, at the working precision in force."""
        return self._embed(self.S.num), self._embed(self.S.den)

    def poles(self, function: RatFunc | None = None) -> list[tuple[acb, int]]:
        """Those of S, or of another function, with their exact multiplicities; raises LimitExceeded where they can't be told
        apart."""
        found = []
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
        for part in (self.gauge.num, self.gauge.den):
            _real(self._embed(part))
        return LogDerivative.of(self.gauge, self._embed, self.poles(self.gauge))

    def equation(self) -> tuple[arb_poly, arb_poly, arb_poly]:
        """a, b and c of the user's equation, at the working precision in force."""
        functions = (self.S, self.gauge or self.S * 0)
        p, q, n, d = (
            arb_poly(_real(self._embed(part))) for function in functions for part in (function.num, function.den)
        )
        return d * d * q, -2 * n * d * q, (n * n - n.derivative() * d + n * d.derivative()) * q - p * d * d

    def bound(self, ball: acb) -> arb:
        """Of |b/a| + |c/a| on the ball, for a z'' + b z' + c z = 0, z = g y."""
        total = self._value(self.S, ball)
        if self.gauge is None:
            return arb(abs(total).upper())
        gamma, slope = (self._value(f, ball) for f in (self.gauge, self.gauge.derivative()))
        return arb((2 * abs(gamma) + abs(gamma * gamma - slope - total)).upper())

    def _value(self, function: RatFunc, x: acb) -> acb:
        value: acb = self._embed(function.num)(x) / self._embed(function.den)(x)
        return value

    def _embed(self, poly: Poly) -> acb_poly:
        """The polynomial at the working precision in force."""
        if isinstance(poly, RationalPoly):
            return acb_poly(poly.rep)
        if isinstance(poly, ExtensionPoly):
            c = _root(poly.field)
            return sum((self._embed(part) * c**k for k, part in enumerate(poly.parts)), acb_poly([]))
        assert isinstance(poly, FunctionPoly)
        balls = [to_ball(self.values[name]) for name in poly.field.names]
        return _at(poly.num, balls) * (1 / _at(poly.den, balls)[0])


def _real(poly: acb_poly) -> list[arb]:
    coefficients = poly.coeffs()
    if not all(c.is_finite() for c in coefficients):
        raise InputError(_UNDEFINED)
    if not all(c.imag.is_zero() for c in coefficients):
        raise InputError("numerical evaluation needs an equation with real coefficients")
    return [c.real for c in coefficients]


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


def _root(field: AlgebraicField) -> acb:
    """The generator, at the working precision in force."""
    modulus = [field.base.rational_value(field.modulus[k]) for k in range(field.dimension + 1)]
    if field.approximation is None or None in modulus:
        raise InputError(f"which root of {field.modulus} the constant {field.name} is isn't known")
    rep = QQ.poly([c for c in modulus if c is not None]).rep
    target = acb(*(arb(to_fmpq(part)) for part in field.approximation))
    with working_precision(max(ctx.prec, 128)):
        return min((root for root, _ in rep.numer().complex_roots()), key=lambda root: float(abs(root - target).mid()))

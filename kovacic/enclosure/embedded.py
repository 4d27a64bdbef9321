"""Equations whose constants are known by balls: algebraic constants such as sqrt(2), and parameters with irrational values.

Their solutions are carried by power series in balls (`kovacic.enclosure.analytic`); here are S and the gauge at the working
precision in force, their poles, and the lines that meet none.

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
from kovacic.enclosure.log_derivative import sharp_roots
from kovacic.enclosure.points import are_real, midpoint
from kovacic.errors import InputError, LimitExceeded

_SHOWN = 64  # bits after the binary point of a singular point that is named
_SHARP = 700  # bits at which a leading coefficient is told from zero


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

    def check(self) -> None:
        """Raise InputError unless numerator and denominator of S are known, with a leading coefficient of the latter."""
        with working_precision(_SHARP):
            num, den = (part.coeffs() for part in self.polynomials())
            if not all(c.is_finite() for c in (*num, *den)) or den[-1].contains(0):
                raise InputError(
                    "the equation isn't defined at these values of the parameters, as far as they are known"
                )

    def is_real(self) -> bool:
        """True if the coefficients of S and of the gauge are real."""
        functions = [self.S] if self.gauge is None else [self.S, self.gauge]
        return all(are_real(self._embed(part).coeffs()) for f in functions for part in (f.num, f.den))

    def polynomials(self) -> tuple[acb_poly, acb_poly]:
        """Numerator and denominator of S, at the working precision in force."""
        return self._embed(self.S.num), self._embed(self.S.den)

    def poles(self, function: RatFunc) -> list[tuple[acb, int]]:
        """Those of S, or of another function, with their exact multiplicities; raises LimitExceeded where they can't be told
        apart."""
        found: list[tuple[acb, int]] = []
        for factor, k in squarefree_factors(function.den):
            roots = sharp_roots(self._embed(factor)) if factor.degree else []
            if len(roots) < factor.degree:
                raise LimitExceeded("the singular points can't be told apart at this precision", limit="digits")
            found += [(root, k) for root in roots]
        return found

    def equation(self) -> tuple[arb_poly, arb_poly, arb_poly]:
        """a, b and c of the user's equation, whose constants are real, at the working precision in force."""
        gauge = self.gauge or self.S * 0
        parts = (self.S.num, self.S.den, gauge.num, gauge.den)
        p, q, n, d = (arb_poly([c.real for c in self._embed(part).coeffs()]) for part in parts)
        return d * d * q, -2 * n * d * q, (n * n - n.derivative() * d + n * d.derivative()) * q - p * d * d

    def quotients(self) -> tuple[RatFunc, RatFunc]:
        """b/a and c/a, for a z'' + b z' + c z = 0, z = g y."""
        gamma = self.gauge or self.S * 0
        return -2 * gamma, gamma * gamma - gamma.derivative() - self.S

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


def check_apart(points: Iterable[acb], a: acb, b: acb) -> None:
    """Raise InputError unless it is certain that none of these singular points lies on the straight segment."""
    for point in points:
        ratio = (b - point) / (a - point)  # negative or 0 on the segment only
        if not (ratio.real > 0 or not ratio.imag.contains(0)):
            place = midpoint(point).rounded(-_SHOWN)
            raise InputError(
                f"the path runs through the singular point near {place}, or so near that its constants don't tell",
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

"""A solution with given values as a sum of the two that a certificate has, c1 y1 + c2 y2, each in product form.

At a base point, x0 where the interval contains it, y1 = y2 = 1 and y' = omega_1, omega_2, so that

    c1 = (y' - omega_2 y)/(omega_1 - omega_2),        c2 = (omega_1 y - y')/(omega_1 - omega_2),

in balls.  Where omega_1 and omega_2 are conjugate and y is real, y = 2 Re(c1 y1).  A coefficient that can't be told from zero
is no basis for this: the other solution may become larger, and a table serves.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from flint import acb

from kovacic.algebra.precision import working_precision
from kovacic.doubles.arrangement import product_form
from kovacic.doubles.chart import RationalChart
from kovacic.doubles.product_form import ProductDerivative, ProductForm
from kovacic.doubles.region import Measured, Region, facts
from kovacic.enclosure.closed_form import closed_form_of, decided, omega
from kovacic.enclosure.points import ExactPoint, as_point
from kovacic.enclosure.problem import NumericProblem
from kovacic.limits import Limits

_PREC = 400
_DIGITS = 60
_DEGREE = 40
"""Of S, up to which an equation is decided for this."""
_UNKNOWN = 400
"""Degree of a polynomial that is sought for that."""


@dataclass(frozen=True, eq=False)
class Combination:
    """c1 y1 + c2 y2 on a real interval: call it with a number or an array, as the functions that it is made of.

    Attributes
    ----------
    region : Region
        Where it is defined.
    forms : tuple of ProductForm
        y1 and y2; y1 alone, where y2 is its conjugate.
    factors : tuple
        c1 and c2, over the values of the forms at the base.
    careful : bool
        Double-doubles in the forms; else they are plain double arithmetic.
    measured : Measured or None
        The error that `lambdify` found; None where it wasn't measured.
    """

    region: Region
    forms: tuple[ProductForm, ...]
    factors: tuple[complex, ...]
    careful: bool = False
    measured: Measured | None = None

    def __call__(self, x: Any) -> Any:
        """y(x), of the shape of x; raises InputError outside of the interval.

        Parameters
        ----------
        x : number or array
            Within the interval.

        Returns
        -------
        float or array
            Of the shape of x.

        Raises
        ------
        InputError
            For others.

        Examples
        --------
        >>> import kovacic
        >>> f = kovacic.solve("1").lambdify(interval=(0, 2), x0=0, y0=1, dy0=0)      # the hyperbolic cosine
        >>> print(f"{f(1.0):.12f}")
        1.543080634815
        """
        return self.sum_of(self.forms, x)

    def __repr__(self) -> str:
        return f"<Combination on {self.region}>"

    def _repr_html_(self) -> str:
        return facts("a combination of closed forms", self.region, self.measured, values="real")

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of the interval, doubles."""
        return self.region.interval

    @property
    def derivative(self) -> CombinationDerivative:
        """y', for the same arguments; its error isn't measured."""
        return CombinationDerivative(self)

    def sum_of(self, functions: Sequence[ProductForm | ProductDerivative], x: Any) -> Any:
        """c1 f1 + c2 f2 at x, of y1 and y2 or of their derivatives."""
        values = [replace(function, careful=self.careful)(x) for function in functions]
        if len(values) == 1:
            return 2 * np.real(self.factors[0] * values[0])
        with np.errstate(all="ignore"):
            return self.factors[0].real * values[0] + self.factors[1].real * values[1]


@dataclass(frozen=True, eq=False)
class CombinationDerivative:
    """y' of a combination."""

    combination: Combination

    def __call__(self, x: Any) -> Any:
        """y'(x), of the shape of x; raises InputError outside of the interval."""
        return self.combination.sum_of([form.derivative for form in self.combination.forms], x)

    def __repr__(self) -> str:
        return f"<CombinationDerivative on {self.combination.region}>"

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of the interval, doubles."""
        return self.combination.interval


def combination(
    chart: RationalChart, region: Region, candidates: list[ExactPoint], limits: Limits | None
) -> Combination | None:
    """The solution that the chart is given, if it is real, from the certificate of case 1; None where there is none."""
    if chart.is_forced or not region.is_real or any(region.singular):
        return None
    known = _with_certificate(chart.problem)
    if known is None:
        return None
    chart = replace(chart, problem=known)
    with working_precision(_PREC):
        base = _base(chart, region, candidates)
        if base is None:
            return None
        y, dy = chart.states([base], _DIGITS, limits)[0]
        if not (y.imag.is_zero() and dy.imag.is_zero()):
            return None
        first, second = (omega(known, which, base, _PREC) for which in (0, 1))
        gap = first - second
        factors = [(dy - second * y) / gap, (first * y - dy) / gap]
        if any(factor.contains(0) or not factor.is_finite() for factor in factors):
            return None
        are_conjugate = not first.imag.contains(0)
        used = (0,) if are_conjugate else (0, 1)
        forms = [product_form(known, which, region, base, False) for which in used]
    return _with_factors(region, forms, factors, float(base.x))


def _with_certificate(problem: NumericProblem) -> NumericProblem | None:
    """The problem, decided; None where S is large, and where there is no elementary solution."""
    S = problem.S
    if S is None or S.num.degree + S.den.degree > _DEGREE:
        return None
    known = decided(problem, _UNKNOWN)
    closed = None if known is None else closed_form_of(known)
    return known if closed is not None and closed.is_elementary else None


def _with_factors(
    region: Region, forms: list[ProductForm | None], factors: list[acb], base: float
) -> Combination | None:
    """None where a form has a table in it, or leaves the doubles at the base."""
    plain = tuple(form for form in forms if form is not None and form.polynomial is None)
    if len(plain) < len(forms):
        return None
    values = [complex(replace(form, careful=True)(base)) for form in plain]
    if not all(np.isfinite(value) and value != 0 for value in values):
        return None
    chosen = tuple(complex(factor.mid()) / value for factor, value in zip(factors, values, strict=False))
    return Combination(region, plain, chosen)


def _base(chart: RationalChart, region: Region, candidates: list[ExactPoint]) -> ExactPoint | None:
    """x0 in the interval, or a point near its middle, where both logarithmic derivatives are finite; a double."""
    low, high = region.interval
    start = as_point(chart.given.get("x0"), "x0")
    if start.is_real() and low <= start.re <= high:
        candidates = [start, *candidates]
    for point in candidates:
        base = ExactPoint(Fraction(float(point.x)))
        with suppress(ZeroDivisionError):
            for which in (0, 1):
                omega(chart.problem, which, base, _PREC)
            return base
    return None

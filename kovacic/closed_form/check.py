"""Checks of solutions: exactly, from the structure, in rational functions; and as printed, at a point, to 50 digits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import count
from typing import Any

import sympy
from flint import acb, acb_poly, arb, fmpq
from sympy import Dummy

from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_digits
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.algebra.rationals import RationalPoly
from kovacic.closed_form.atoms import Atoms
from kovacic.closed_form.curve import CurveIntegral
from kovacic.closed_form.jets import jet
from kovacic.closed_form.primitive import OpenPrimitive, Primitive
from kovacic.closed_form.structure import (
    ClosedStructure,
    Conjugate,
    Diagonal,
    OnCurve,
    Triangular,
)
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time

DIGITS = 50


def is_exact_solution(form: ClosedStructure, S: RatFunc, gauge: RatFunc) -> bool:
    """True if both solutions, divided by the gauge factor, satisfy y'' = S y, computed from the factors as they are written.

    With omega = y'/y the condition is omega' + omega^2 = S; for omega = u +- w, w^2 rational and not 0, that is
    u' + u^2 + w^2 = S and w' + 2 u w = 0.  An integral is right if its derivative, computed from its parts, is the integrand.
    Only for cases 1 and 2.
    """
    if isinstance(form, Diagonal):
        first = form.first.logarithmic_derivative - gauge
        second = form.second.logarithmic_derivative - gauge
        return first != second and _is_riccati_solution(first, S) and _is_riccati_solution(second, S)
    if isinstance(form, Triangular):
        omega = form.bare.logarithmic_derivative
        is_solution = omega == form.first.logarithmic_derivative - gauge and _is_riccati_solution(omega, S)
        return is_solution and _is_inverse_square(form.primitive, omega)
    assert isinstance(form, Conjugate | OnCurve)
    u, square = _mean_and_square(form)
    u = u - gauge
    solves = u.derivative() + u * u + square == S and not square.derivative() + 4 * u * square
    return bool(square) and solves and (isinstance(form, Conjugate) or _is_complete(form.integral))


def _is_riccati_solution(omega: RatFunc, S: RatFunc) -> bool:
    return omega.derivative() + omega * omega == S


def _mean_and_square(form: Conjugate | OnCurve) -> tuple[RatFunc, RatFunc]:
    """u and w^2: those of the common factor and of sqrt(delta) V' or kappa r/sqrt(g), and of the zeros A +- ...."""
    u = form.common.logarithmic_derivative
    if isinstance(form, Conjugate):
        A, B, delta = form.A, form.B, form.delta
        norm = A * A - B * B * delta
        v = form.phase.derivative + RatFunc(A * B.derivative() - A.derivative() * B, norm)
        return u + logarithmic_derivative(norm) / 2, v * v * delta
    r, g = form.integral.integrand, form.integral.g
    if form.zeros is not None:
        u = u + logarithmic_derivative(form.zeros.norm(g)) / 2
        r = r + form.zeros.integrand(g)
    return u, r * r / g * form.kappa_squared


def _is_complete(integral: CurveIntegral) -> bool:
    """True unless units stand for the residues and the rest with derivatives that don't add up to them."""
    return not integral.units or integral.slope_of_units(integral.units) == integral.without_exact


def _is_inverse_square(primitive: Primitive, omega: RatFunc) -> bool:
    """True if the derivative r k of the integral is y^-2 up to a constant: r'/r + k'/k = -2 omega for omega = y'/y."""
    if isinstance(primitive, OpenPrimitive):
        return True  # the integral is left unevaluated
    r = primitive.integrand
    is_complete = not isinstance(primitive, CurveIntegral) or _is_complete(primitive)
    return is_complete and bool(r) and r.derivative() == r * (omega * -2 - primitive.kernel_derivative)


def residual(expression: Any, variable: Any, S: RatFunc, gauge: RatFunc, point: Any, *, inner: Any = None) -> Any:
    """|y'' - 2 g y' + (g^2 - g' - S) y| relative to its terms, g the logarithmic derivative of the gauge factor: a ball.

    With `inner` the equation is one in t = inner(x), x the variable of the expression and of the point.
    """
    y, first, second = jet(expression, variable, point)
    if inner is not None:
        point, slope, curvature = jet(inner, variable, point)
        first = first / slope
        second = (second - first * curvature) / slope**2
    coefficient = -value_at(S, point)
    g0 = acb(0)
    if gauge:
        g0 = value_at(gauge, point)
        coefficient += g0 * g0 - value_at(gauge.derivative(), point)
    terms = (second, -2 * g0 * first, coefficient * y)
    scale = sum(map(abs, terms), abs(y) + abs(first))
    return abs(sum(terms)) / scale


def are_independent(y1: Any, y2: Any, variable: Any) -> bool:
    """True if the Wronskian of the expressions is proven not to vanish at the point of `is_numerical_solution`."""
    return independent([(y1, y2)], variable) is not None


def independent(pairs: Sequence[tuple[Any, Any]], variable: Any) -> tuple[Any, Any] | None:
    """A pair proven to be independent; one that takes few digits comes first."""
    # Where both solutions grow alike, y z' and y' z agree in many digits although W isn't 0.
    for digits in (DIGITS + 15, 4 * DIGITS, 10 * DIGITS):
        for pair in pairs:
            with working_digits(digits), suppress(NotImplementedError):  # a function without balls
                (y, dy, _), (z, dz, _) = (jet(expression, variable, check_point()) for expression in pair)
                W = y * dz - dy * z
                if W.is_finite() and not W.contains(0):
                    return pair
    return None


def is_nonzero(expression: Any, variable: Any) -> bool:
    """True if this is proven at the point of `is_numerical_solution`."""
    with working_digits(DIGITS), suppress(NotImplementedError):
        value = jet(expression, variable, check_point())[0]
        return bool(value.is_finite() and not value.contains(0))
    return False


def is_numerical_solution(expression: Any, variable: Any, S: RatFunc, gauge: RatFunc) -> bool:
    """True if the expression satisfies the equation to 50 digits at a point with negative real and imaginary part.

    Raises `LimitExceeded` if 4,800 digits don't decide.
    """
    # Legendre's Q_60 is the difference of two terms that agree in a hundred digits; hence the repetitions.  Functions of large
    # parameters, as 1F1(10^9; 1/2; -x^2), are such sums of many terms everywhere but near 0.
    for digits, scale in (
        (DIGITS + 15, 1),
        (3 * DIGITS, 1),
        (3 * DIGITS, 10**6),
        *((n * DIGITS, 1) for n in (8, 24, 96)),
    ):
        check_time()
        with working_digits(digits):
            value = residual(expression, variable, S, gauge, check_point() / scale)
            bound = arb(10) ** -DIGITS
            if value < bound or value > bound:  # neither holds for a ball that contains the bound
                return bool(value < bound)
    raise LimitExceeded(f"the check of a written-out solution needs more than {digits} digits", limit="digits")


def check_point() -> Any:
    """An ordinary point of no particular equation, at the precision in force."""
    return acb(arb(fmpq(-137, 101)), arb(fmpq(-71, 89)))


def letter_samples(symbols: set[Any]) -> Iterator[dict[Any, Any]]:
    """Endless values of symbols that fit what is assumed of them: small numbers, the symbols in many orders; {} for none."""
    ordered = sorted(symbols, key=str)
    for k in count() if symbols else (0,):
        # turned round k/2 times, and backwards for odd k: which of two is the larger one may matter
        start = k // 2 % max(len(ordered), 1)
        turned = [*ordered[start:], *ordered[:start]][:: (-1) ** k]
        yield {symbol: _sample_value(symbol, k + 3 * position) for position, symbol in enumerate(turned)}


def _sample_value(symbol: Any, k: int) -> Any:
    """The k-th value of a symbol: for integers the k-th natural number, or the k-th of those that are even or odd."""
    if symbol.is_integer:
        value = sympy.Integer(k + 1 if symbol.is_odd is None else 2 * k + 2 - symbol.is_odd)
    else:
        # Between 1 and 2 but for k, and different for most names.  Numerators are short, since SymPy reduces (17/4)^(5/7) to
        # a root of 17^5 4^2.
        code = sum(ord(character) * 31**place for place, character in enumerate(symbol.name))
        value = sympy.Rational(102 + 2 * code % 99, 101) + k
    return -value if symbol.is_nonpositive else value


def value_at(r: RatFunc, point: Any) -> Any:
    return _polynomial_value(r.num, point) / _polynomial_value(r.den, point)


def _polynomial_value(polynomial: Poly, point: Any) -> Any:
    if isinstance(polynomial, RationalPoly):
        return acb_poly(polynomial.rep)(point)
    # The constants as in the printed formulas.
    variable = Dummy()
    constants = (jet(c, variable, acb(0))[0] for c in Atoms(variable).coefficients(polynomial))
    return acb_poly(list(constants))(point)

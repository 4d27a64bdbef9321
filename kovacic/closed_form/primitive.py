"""int y^-2 dx for a product y: the second solution y int y^-2 of a reducible equation.

With h = y^-2 = r k, r rational and k the part that isn't, the integral is W k plus what no W k can express: logarithms for
k = 1, the integrals (2) of `kovacic.closed_form.curve` for k = 1/sqrt(g), and those of
`kovacic.closed_form.exponential_integrals` for k = t^alpha exp(E).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from kovacic.algebra.partial_fractions import Decomposition, decompose
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.closed_form.curve import CurveIntegral, integrate_on_curve
from kovacic.closed_form.exponential_integrals import ExponentialPrimitive, integrate_exponential, monomial
from kovacic.closed_form.product import Product
from kovacic.closed_form.torsion import completed

#: Above this power of a factor in y^-2 the integral isn't computed: it would be a sum of about as many terms.
_LARGEST_EXPONENT = 1000


@dataclass(frozen=True)
class RationalPrimitive:
    """k = 1: a rational function and logarithms."""

    parts: Decomposition

    @property
    def kernel_derivative(self) -> RatFunc:
        return self.parts.exact * 0

    @property
    def integrand(self) -> RatFunc:
        return self.parts.derivative


@dataclass(frozen=True)
class OpenPrimitive:
    """The integral is left as it is, and `reason` says why."""

    reason: str


#: int r k dx, with r as `integrand` and k'/k as `kernel_derivative`.
Primitive = RationalPrimitive | CurveIntegral | ExponentialPrimitive | OpenPrimitive


def integrate_inverse_square(y: Product) -> Primitive:
    """int y^-2 dx."""
    return integrate(y.to_power(-2))


def integrate(h: Product) -> Primitive:
    """int h dx.

    >>> from kovacic.algebra.rationals import QQ
    >>> from kovacic.closed_form.product import product
    >>> x = RatFunc(QQ.poly([0, 1]))
    >>> y = product(-x / 2, QQ.poly([0, -3, 0, 1]))  # (x^3 - 3 x) exp(-x^2/4)
    >>> done = integrate(y.to_power(-2))
    >>> print(done.W, [(str(term.coefficient), term.n, term.power) for term in done.terms])
    (-x**2 + 2)/(6*x**3 - 18*x) [('1/6', 2, 0)]
    """
    found = _integrated(h)
    return OpenPrimitive(found) if isinstance(found, str) else found


def _integrated(h: Product) -> Primitive | str:
    """The integral, or why it is left."""
    field = h.field
    if h.roots:
        return f"the exponents at the roots of {h.roots[0].factor} are different algebraic numbers"
    rational = RatFunc(field.poly([1]))
    fractional: list[tuple[Poly, Fraction]] = []
    for power in h.powers:
        exponent = power.rational_exponent
        if exponent is None:
            return f"the exponent at {power.base} is irrational"
        if abs(exponent) > _LARGEST_EXPONENT:
            return f"the factor {power.base} has the power {exponent} in the integrand"
        if exponent.denominator == 1:
            rational = rational * RatFunc(power.base) ** int(exponent)
        else:
            fractional.append((power.base, exponent))
    E = h.exponential
    if E.is_polynomial and E.num.degree <= 0:
        return _without_exponential(rational, fractional)
    return _with_exponential(rational, fractional, E)


def _without_exponential(rational: RatFunc, fractional: list[tuple[Poly, Fraction]]) -> Primitive | str:
    if not fractional:
        return RationalPrimitive(decompose(rational))
    if all(exponent.denominator == 2 for _, exponent in fractional):
        g = rational.field.poly([1])
        for p, exponent in fractional:
            g = g * p
            rational = rational * RatFunc(p) ** int(exponent + Fraction(1, 2))
        return completed(integrate_on_curve(rational, g))
    linear = all(p.degree == 1 for p, _ in fractional)
    if linear and len(fractional) == 1:
        (p, alpha), t = fractional[0], RatFunc(fractional[0][0])
        return _with_power(rational(rational.field.poly([-p[0], 1])), alpha, t)
    if linear and len(fractional) == 2 and sum(exponent for _, exponent in fractional).denominator == 1:
        (p, alpha), (q, beta) = fractional
        # x = (d t - c)/(t - 1), x - d = (d - c)/(t - 1), dx = (c - d) dt/(t - 1)^2.
        c = -p[0]
        d = -q[0]
        below = RatFunc(p.field.poly([-1, 1]))
        x = RatFunc(p.field.poly([-c, d])) / below
        r = rational(x) * (RatFunc(d - c) / below) ** int(alpha + beta) * (c - d) / (below * below)
        return _with_power(r, alpha, RatFunc(p, q))
    return "it is an incomplete beta integral, with fractional powers of several factors"


def _with_power(r: RatFunc, alpha: Fraction, t: RatFunc) -> Primitive | str:
    """int r(t) t^alpha dt."""
    shift = alpha.numerator // alpha.denominator + 1
    found = integrate_exponential(r * RatFunc(r.field.poly([0, 1])) ** shift, r * 0, alpha - shift)
    return found if isinstance(found, str) else replace(found, t=t)


def _with_exponential(r: RatFunc, fractional: list[tuple[Poly, Fraction]], E: RatFunc) -> Primitive | str:
    if len(fractional) > 1 or any(p.degree > 1 for p, _ in fractional):
        return "the integrand has an exponential and fractional powers of several factors"
    alpha = Fraction(0)
    below = E.num if E.is_polynomial else E.den
    if fractional:
        below, alpha = fractional[0]
    n = below.degree
    centre = -below[n - 1] / (below.lc * n) if fractional or n > 1 or not E.is_polynomial else below * 0
    moved = RatFunc(r.field.poly([centre[0], 1]))
    if not fractional and monomial(E(moved)) is None:
        return integrate_exponential(r, E)
    found = integrate_exponential(r(moved), E(moved), alpha)
    return found if isinstance(found, str) else replace(found, t=RatFunc(r.field.poly([-centre[0], 1])))


def normalised_constant(exact: RatFunc) -> RatFunc:
    """The antiderivative that vanishes at a multiple zero of the integrand, or has the least degree in the numerator."""
    slope = exact.derivative()
    zeros = exact.field.factor(slope.num) if slope.num.degree > 1 else []
    at_zeros = [(k, exact.num * exact.den.inverse_modulo(p) % p) for p, k in zeros if p.degree == 1 and k > 1]
    if at_zeros:
        return exact - max(at_zeros, key=lambda pair: pair[0])[1]
    if exact.num.degree != exact.den.degree or exact.den.degree <= 0:
        return exact
    return exact - exact.num.lc

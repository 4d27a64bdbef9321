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

#: A pair of solutions is short if it takes at most so many characters, or so many times those of the shortest form.
SHORT = 1000
FACTOR = 4
#: Why an integral is left.
LONG = "written out it would take some {} characters"
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
    """int y^-2 dx; left where it would be too long beside the integral as it stands."""
    h = y.to_power(-2)
    terms = _number_of_terms(h)
    most = max(SHORT, FACTOR * (2 * y.length + h.length))
    if terms**2 > 4 * most:
        return OpenPrimitive(LONG.format(terms**2))
    return integrate(h)


def _number_of_terms(h: Product) -> int:
    """About how many terms int h dx has, with coefficients of as many digits: about this number squared is its length.

    (x - 1)^-40 (x - 2)^-2 exp(-2 x) has 42 and 2,000 characters, its power 400 has 1.5 million.
    """
    poles = [(power.base.degree, -(power.rational_exponent or 0)) for power in h.powers]
    is_a_power = len(poles) == 1 and poles[0][0] == 1 and not h.exponential
    if is_a_power:
        return 1
    return sum(degree * int(order) for degree, order in poles if order > 0)


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
    if h.roots:
        return f"the exponents at the roots of {h.roots[0].factor} are different algebraic numbers"
    rational = RatFunc(h.field.poly([1]))
    fractional: list[_Root] = []
    for power in h.powers:
        exponent = power.rational_exponent
        if exponent is None:
            return f"the exponent at {power.base} is irrational"
        if abs(exponent) > _LARGEST_EXPONENT:
            return f"the factor {power.base} has the power {exponent} in the integrand"
        if exponent.denominator == 1:
            rational = rational * RatFunc(power.base) ** int(exponent)
        else:
            fractional.append(_Root(power.base, exponent))
    E = h.exponential
    if E.is_polynomial and E.num.degree <= 0:
        return _without_exponential(rational, fractional)
    return _with_exponential(rational, fractional, E)


@dataclass(frozen=True)
class _Root:
    """p^alpha for a polynomial p and a fraction alpha."""

    p: Poly
    alpha: Fraction


def _without_exponential(rational: RatFunc, fractional: list[_Root]) -> Primitive | str:
    """int r k dx for a product k of roots, or why it is left."""
    if not fractional:
        return RationalPrimitive(decompose(rational))
    if all(root.alpha.denominator == 2 for root in fractional):
        g = rational.field.poly([1])  # on s^2 = g, g the product of what is under the roots
        for root in fractional:
            g = g * root.p
            rational = rational * RatFunc(root.p) ** int(root.alpha + Fraction(1, 2))
        return completed(integrate_on_curve(rational, g))
    are_lines = all(root.p.degree == 1 for root in fractional)
    if are_lines and len(fractional) == 1:
        (root,) = fractional
        centre = -root.p[0]
        return _with_power(rational(RatFunc(root.p.field.poly([centre, 1]))), root.alpha, RatFunc(root.p))
    if are_lines and len(fractional) == 2:
        first, second = fractional
        if (first.alpha + second.alpha).denominator == 1:
            return _with_a_quotient(rational, first, second)
    return "it is an incomplete beta integral, with fractional powers of several factors"


def _with_a_quotient(rational: RatFunc, first: _Root, second: _Root) -> Primitive | str:
    """int r (x - c)^alpha (x - d)^beta dx for an integer alpha + beta, by t = (x - c)/(x - d).

    x = (d t - c)/(t - 1), x - d = (d - c)/(t - 1), dx = (c - d) dt/(t - 1)^2.
    """
    c = -first.p[0]
    d = -second.p[0]
    below = RatFunc(first.p.field.poly([-1, 1]))
    x = RatFunc(first.p.field.poly([-c, d])) / below
    r = rational(x) * (RatFunc(d - c) / below) ** int(first.alpha + second.alpha) * (c - d) / (below * below)
    return _with_power(r, first.alpha, RatFunc(first.p, second.p))


def _with_power(r: RatFunc, alpha: Fraction, t: RatFunc) -> Primitive | str:
    """int r(t) t^alpha dt."""
    shift = alpha.numerator // alpha.denominator + 1
    found = integrate_exponential(r * RatFunc(r.field.poly([0, 1])) ** shift, r * 0, alpha - shift)
    if isinstance(found, str):
        return found
    return replace(found, t=t)


def _with_exponential(r: RatFunc, fractional: list[_Root], E: RatFunc) -> Primitive | str:
    """int r k exp(E) dx for at most one root k of a linear polynomial, or why it is left: in x less a centre."""
    if len(fractional) > 1 or any(root.p.degree > 1 for root in fractional):
        return "the integrand has an exponential and fractional powers of several factors"
    alpha = fractional[0].alpha if fractional else Fraction(0)
    centre = _centre(fractional, E)
    moved = RatFunc(r.field.poly([centre[0], 1]))
    if not fractional and monomial(E(moved)) is None:
        return integrate_exponential(r, E)
    found = integrate_exponential(r(moved), E(moved), alpha)
    if isinstance(found, str):
        return found
    return replace(found, t=RatFunc(r.field.poly([-centre[0], 1])))


def _centre(fractional: list[_Root], E: RatFunc) -> Poly:
    """The zero of the root, else the mean of the poles, or of the zeros of a polynomial; 0 for a linear one."""
    below = E.den
    if fractional:
        below = fractional[0].p
    elif E.is_polynomial:
        below = E.num
        if below.degree == 1:
            return below * 0
    n = below.degree
    return -below[n - 1] / (below.lc * n)


def normalised_constant(exact: RatFunc) -> RatFunc:
    """The antiderivative that vanishes at a multiple zero of the integrand, or has the least degree in the numerator."""
    slope = exact.derivative()
    zeros = exact.field.factor(slope.num) if slope.num.degree > 1 else []
    multiple = [(p, k) for p, k in zeros if p.degree == 1 and k > 1]
    if multiple:
        p, _ = max(multiple, key=lambda pair: pair[1])
        return exact - exact.num * exact.den.inverse_modulo(p) % p
    if exact.num.degree != exact.den.degree or exact.den.degree <= 0:
        return exact
    return exact - exact.num.lc

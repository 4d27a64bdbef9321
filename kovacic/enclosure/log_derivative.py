"""Exact polynomials and rational functions in balls, and exp(int theta) for rational theta: partial fractions, with powers
and logarithms followed along straight legs.

The guarantee: `growth(a, b)` contains exp(int_a^b theta dx) along the straight segment, if it returns.

The mathematics.  theta = q(x) + sum_zeta sum_k r_(zeta,k) / (x - zeta)^k.  Along a straight segment from a that doesn't meet
zeta the quotient (x - zeta)/(a - zeta) starts at 1 and never meets the negative real axis (it lies on a line through 1 that
misses 0), so its *principal* logarithm is the continuous one: no branch has to be chosen, and none can be chosen wrongly.

Symbols: c, the root of the field's modulus that constants are embedded by.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpz

from kovacic.algebra.embedding import complex_zeros
from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.factors import squarefree_factors
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.enclosure.points import kept_at_precision
from kovacic.limits import check_time


@kept_at_precision(maxsize=32)
def conjugates(field: Field) -> list[acb | None]:
    """The embeddings of K(c) over K = Q as values of c at the working precision in force; [None] for Q itself."""
    return [root for root, _ in _isolated_roots(field.modulus)] if isinstance(field, AlgebraicField) else [None]


def _isolated_roots(poly: Poly) -> tuple[tuple[acb, int], ...]:
    """Enclosures of the zeros of a polynomial over Q by certified isolation."""
    assert isinstance(poly, RationalPoly)
    return complex_zeros(poly.rep.numer())


def embed(poly: Poly, c: acb | None) -> acb_poly:
    """The polynomial with ball coefficients."""
    parts: tuple[Any, ...] = poly.parts if isinstance(poly, ExtensionPoly) else (poly,)
    # The parts are the coefficients of 1, c, c^2, ...; over Q there is one.
    total = acb_poly([])
    for part in reversed(parts):
        total = acb_poly(part.rep) + (0 if c is None else total * c)
    return total


def enclosed_zeros(poly: Poly, c: acb | None) -> list[tuple[acb, int]]:
    """Enclosures of the distinct zeros, with multiplicities (certified isolation; multiplicities are exact)."""
    if poly.degree < 1:
        return []
    if not isinstance(poly, ExtensionPoly):
        return list(_isolated_roots(poly))
    result = []
    for p, k in squarefree_factors(poly):
        factor = p.monic()
        # A factor with coefficients in Q is isolated as such: its balls don't depend on c.
        rational, *rest = factor.parts
        found = sharp_roots(embed(factor, c)) if any(rest) else [root for root, _ in _isolated_roots(rational)]
        result += [(root, k) for root in found]
    return result


def sharp_roots(poly: acb_poly) -> list[acb]:
    """All zeros of a squarefree polynomial, isolated and refined; an empty list where the coefficients don't allow it."""
    # A share of the precision that the coefficients may allow; the first one at which all zeros are isolated.
    for share in (0.95, 0.85, 0.75, 0.6, 0.45, 0.3):
        try:
            roots: list[acb] = poly.roots(tol=arb(2) ** -int(ctx.prec * share), maxprec=4 * ctx.prec)
        except ValueError:
            continue
        return roots
    return []


@dataclass(frozen=True)
class Pole:
    """A pole of theta: its place and the coefficients of (x - zeta)^-1, (x - zeta)^-2, ..."""

    zeta: acb
    coefficients: tuple[acb, ...]


@dataclass(frozen=True)
class LogDerivative:
    """theta = primitive' + sum over the poles = num/den, in balls of the precision at which it was made."""

    primitive: acb_poly
    poles: tuple[Pole, ...]
    num: acb_poly
    den: acb_poly

    @classmethod
    def make(cls, theta: RatFunc, c: acb | None) -> LogDerivative:
        """The partial fractions of theta at the working precision in force."""
        quotient, rest = divmod(theta.num, theta.den)
        num = embed(rest, c)
        den = embed(theta.den, c)
        parts = tuple(Pole(zeta, _principal_part(num, den, zeta, k)) for zeta, k in enclosed_zeros(theta.den, c))
        return cls(embed(quotient, c).integral(), parts, embed(theta.num, c), den)

    def value(self, x: acb) -> acb:
        """theta(x)."""
        return self.num(x) / self.den(x)

    def exponent(self, a: acb, b: acb, *, analytic: bool = False) -> acb:
        """int_a^b theta along the straight segment."""
        total = self.primitive(b) - self.primitive(a)
        for pole in self.poles:
            u, v = b - pole.zeta, a - pole.zeta
            residue = pole.coefficients[0]
            if not residue.is_zero():
                total += residue * (u / v).log(analytic=analytic)
            for k, coefficient in enumerate(pole.coefficients[1:], start=2):
                # int (x - zeta)^-k = -(x - zeta)^(1 - k)/(k - 1).
                total += coefficient * (v ** (1 - k) - u ** (1 - k)) / (k - 1)
        return total

    def growth(self, a: acb, b: acb) -> acb:
        """exp(int_a^b theta) along the straight segment."""
        return self.exponent(a, b).exp()


@kept_at_precision(maxsize=32)
def log_derivative(theta: RatFunc, embedding: int = 0) -> LogDerivative:
    """The partial fractions of theta at the precision in force, kept for many calls with the same certificate and gauge.

    Algebraic constants are embedded by the conjugate number `embedding`.
    """
    # Over Q there is one value, None.
    values = conjugates(theta.field)
    return LogDerivative.make(theta, values[embedding % len(values)])


def _principal_part(num: acb_poly, den: acb_poly, zeta: acb, k: int) -> tuple[acb, ...]:
    """The coefficients of t^-1, ..., t^-k of num/den at x = zeta + t, a zero of den of multiplicity exactly k."""
    check_time()
    # num/den = t^-k top/bottom, and found[n] is the coefficient of t^(n - k).  FLINT's series end after `flint.ctx.cap` terms.
    top = _taylor_coefficients(num, zeta, k)
    bottom = _taylor_coefficients(den, zeta, 2 * k)[k:]  # the first k coefficients are exactly zero
    found: list[acb] = []
    for n in range(k):
        rest = sum((c * found[n - j] for j, c in enumerate(bottom[1 : n + 1], start=1)), acb(0))
        found.append((top[n] - rest) / bottom[0])
    return tuple(found[::-1])


def _taylor_coefficients(poly: acb_poly, point: acb, count: int) -> list[acb]:
    """The first coefficients in powers of x - point, by derivatives: FLINT would compute all of them."""
    found: list[acb] = []
    derivative = poly
    factorial = fmpz(1)
    for n in range(count):
        found.append(derivative(point) / factorial)
        derivative = derivative.derivative()
        factorial *= n + 1
    return found

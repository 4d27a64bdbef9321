"""Regular singular points: exponents, the operator in theta, and how far its coefficients can be trusted to go.

t = x - c at the point c, and t = 1/x at infinity; theta = t d/dt.  An equation a y'' + b y' + c y = 0 over Q is, up to a power
of t, sum_j t^j P_j(theta) y = 0 with P_j = A_j theta^2 + B_j theta + C_j, and A_0 isn't zero where the point is a regular
singular one or ordinary [Fuchs].  The exponents are the zeros of P_0.  Whether they differ by an integer is decided exactly,
by division by the polynomial, irreducible over Q, of which the point is a zero.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from flint import acb, acb_poly, arb, arb_poly, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.embedding import complex_zeros, root_near
from kovacic.algebra.precision import working_precision
from kovacic.enclosure.points import ExactPoint, midpoint, to_acb
from kovacic.enclosure.problem import NumericProblem
from kovacic.errors import InputError
from kovacic.limits import check_time
from kovacic.special.pullback import is_integer

OperatorCoefficients = tuple["fmpq_poly", "fmpq_poly", "fmpq_poly"]  # a, b, c of a y'' + b y' + c y = 0


@dataclass(frozen=True)
class Operator:
    """The coefficients A_j, B_j, C_j of P_j: rational numbers or balls."""

    A: list[Any]
    B: list[Any]
    C: list[Any]

    def in_balls(self) -> Operator:
        """The operator in balls, real if all of them are."""
        kind = acb if any(isinstance(v, acb) for v in (*self.A, *self.B, *self.C)) else arb
        return Operator(*([kind(v) for v in part] for part in (self.A, self.B, self.C)))


@dataclass(frozen=True, eq=False)
class Singular:
    """A regular singular point, or an ordinary one, of the user's equation.

    At infinity the equation is that in t = 1/x, and the point is its point 0 (`inverted`).  `minimal` is the polynomial,
    irreducible over Q, of which the point is a zero; `near` tells it from the others, and is the point itself if `exact`.
    """

    equation: OperatorCoefficients
    minimal: fmpq_poly
    near: ExactPoint
    exact: bool = True
    inverted: bool = False
    fixed: ClassVar[bool] = False  # known to every precision

    @classmethod
    def at(cls, problem: NumericProblem, point: ExactPoint | acb | None) -> Singular:
        """The place of an exact point, of the only singular point in a ball, or of infinity (None).

        Raises InputError at an irregular singular point, and where the ball has none or several.
        """
        a, b, c = problem.equation
        if point is None:
            # In t = 1/x: t^4 a y.. + (2 t^3 a - t^2 b) y. + c y = 0, cleared of denominators.
            size = max(a.degree(), b.degree(), c.degree())

            def reverse(poly: fmpq_poly, power: int) -> fmpq_poly:  # t^(power + size) poly(1/t)
                return fmpq_poly([0] * (power + size - poly.degree()) + poly.coeffs()[::-1])

            inverted = reverse(a, 4), 2 * reverse(a, 3) - reverse(b, 2), reverse(c, 0)
            found = cls(inverted, fmpq_poly([0, 1]), ExactPoint(0), inverted=True)
        elif isinstance(point, ExactPoint):
            # x - p, or (x - z)(x - conj z).
            minimal = [-point.x, 1] if point.is_real() else [point.norm_squared(), -2 * point.x, 1]
            found = cls((a, b, c), fmpq_poly(minimal), point)
        else:
            found = cls((a, b, c), *_root_in(a, point), exact=False)
        # Fuchs: b has at most one order less than a, and c two.
        orders = found._orders
        if orders[1] < orders[0] - 1 or orders[2] < orders[0] - 2:
            raise InputError(
                f"{found} is an irregular singular point: there is no Frobenius basis", hint="start beside it"
            )
        return found

    def value(self) -> acb:
        """The point, in a ball of the working precision in force (0 for infinity)."""
        here = to_acb(self.near)
        if self.exact:
            return here
        # The zero of the minimal polynomial next to `near`.
        return root_near(self.minimal.numer(), here)

    def is_at(self, x: ExactPoint) -> bool:
        """True if x is provably this point."""
        return self.exact and not self.inverted and x == self.near

    @property
    def is_rational(self) -> bool:
        """True if it is a rational number (or infinity): the operator's coefficients are rational, then."""
        return self.exact and self.near.is_real()

    @property
    def is_ordinary(self) -> bool:
        """True if the equation is regular here."""
        return self._orders[0] == 0

    def __str__(self) -> str:
        return "infinity" if self.inverted else str(self.near)

    def offset(self, x: ExactPoint) -> acb:
        """t at x."""
        if self.inverted:
            return 1 / to_acb(x)
        return to_acb(x - self.near) if self.exact else to_acb(x) - self.value()

    @cached_property
    def _orders(self) -> tuple[int, int, int]:
        a, b, c = (_multiplicity(poly, self.minimal) for poly in self.equation)
        return a, b, c

    @cached_property
    def _indicial(self) -> tuple[fmpq_poly, fmpq_poly]:
        """The sum of the exponents and the square of their difference, as polynomials in the point, reduced by `minimal`:
        constant where they are rational."""
        first = self._orders[0]
        alpha, beta, gamma = (_taylor_coefficient(poly, first - k) for k, poly in enumerate(self.equation))
        # 1/alpha modulo the minimal polynomial: alpha isn't 0 at the point.
        inverse = alpha.xgcd(self.minimal)[1]  # P_0 = alpha theta^2 + (beta - alpha) theta + gamma
        total, product = ((part * inverse) % self.minimal for part in (alpha - beta, gamma))
        return total, (total * total - 4 * product) % self.minimal

    @property
    def difference(self) -> int | None:
        """The difference of the exponents if it is an integer, decided exactly."""
        return int(self._delta.p) if is_integer(self._delta) else None

    @property
    def _delta(self) -> Any:
        """The difference of the exponents: a rational number if it is one, else a ball."""
        # rho^2 - s rho + p = 0 has the roots (s +- (s^2 - 4 p)^(1/2))/2.
        square = self._at(self._indicial[1])
        with suppress(DomainError):  # no square of a rational number
            if isinstance(square, fmpq):
                return square.sqrt()
        return acb(square).sqrt()

    def _at(self, poly: fmpq_poly) -> Any:
        """The value of a reduced polynomial: rational where it is constant, real where the point is."""
        if poly.degree() < 1:
            return poly[0]
        here = self.value()
        value = acb_poly(poly)(here)
        return value.real if here.imag.is_zero() else value

    def exponents(self) -> tuple[Any, Any]:
        """The exponents in the order of the basis: rational numbers if they are such, else balls."""
        total = self._at(self._indicial[0])
        delta = self._delta
        return (total - delta) / 2, (total + delta) / 2

    def operator(self) -> Operator:
        """The operator: rational coefficients at a rational point, else balls of the working precision in force."""
        here = self.value()
        kind, place = (arb_poly, here.real) if here.imag.is_zero() else (acb_poly, here)
        if self.is_rational:
            kind, place = fmpq_poly, self.near.x
        # t^2 y.. = theta (theta - 1) y, t y. = theta y: t^2 times the equation is a theta (theta - 1) + t b theta + t^2 c,
        # so A = a, B = t b - a and C = t^2 c, up to a power of t.
        lines = []
        for k, poly in enumerate(self.equation):
            lines.append([0] * k + kind(poly)(kind([place, 1])).coeffs())
        size = max(map(len, lines))
        a, b, c = (line + [0] * (size - len(line)) for line in lines)
        first = self._orders[0]
        return Operator(a[first:], [y - x for x, y in zip(a, b, strict=True)][first:], c[first:])

    def neighbours(self) -> list[tuple[acb, int]]:
        """The other singular points in t, with their multiplicities as zeros of A."""
        prec = 64
        own = 0 if self.is_ordinary else 1
        while True:
            with working_precision(prec):
                here = self.value()
                found = [(root - here, k) for root, k in complex_zeros(self.equation[0].numer())]
            # The point itself is a zero of a unless it is ordinary; balls that contain 0 can't be told from it.
            others = [(d, k) for d, k in found if not d.contains(0)]
            if len(others) == len(found) - own:
                return others
            prec *= 2


def power_of(t: acb, exponent: Any, log: acb) -> acb:
    """t^exponent with this logarithm of t, which integers don't need."""
    return t ** int(exponent.p) if is_integer(exponent) else (acb(exponent) * log).exp()


def _multiplicity(poly: fmpq_poly, minimal: fmpq_poly) -> int:
    """How often `minimal` divides the polynomial (a large number for zero)."""
    if poly == 0:
        return 1 << 30
    # A divisor over Q with integer coefficients and no content divides over Z (Gauss), where FLINT is many times as fast.
    rest = poly.numer()
    divisor = minimal.numer()
    order = 0
    with suppress(DomainError):  # there is a remainder
        while True:
            check_time()
            rest = rest / divisor
            order += 1
    return order


def _taylor_coefficient(poly: fmpq_poly, k: int) -> fmpq_poly:
    """The derivative of order k over k!; zero for negative k."""
    for n in range(1, k + 1):
        poly = poly.derivative() / n
    return poly if k >= 0 else fmpq_poly([])


def _root_in(a: fmpq_poly, ball: acb) -> tuple[fmpq_poly, ExactPoint]:
    """The irreducible factor with the only zero of `a` in the ball, and a point that tells this zero from the others."""
    found = []
    with working_precision(256):
        for factor, _ in a.numer().factor()[1]:
            found += [(fmpq_poly(factor), root) for root, _ in complex_zeros(factor) if root.overlaps(ball)]
    if len(found) != 1:
        raise InputError(f"there are {len(found)} singular points in the ball {ball}", hint="give the point itself")
    return found[0][0], midpoint(found[0][1])

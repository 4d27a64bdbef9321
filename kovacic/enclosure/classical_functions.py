"""Solutions of Airy's, Bessel's, Whittaker's and Gauss' equations by FLINT's functions: z^alpha (1 - z)^beta E(z).

E is entire, or analytic where no number of `slits` lies on the negative axis, and `StandardForm.values` contain E and E';
E(0) = 1 where the form has the power z^alpha of its exponent at 0.  With (1/2 +- mu) for the exponents at 0 and q, r, M of
`kovacic.special.pullback.Confluent`, rho^2 = q, kappa = r/(2 rho):

    Bessel, r = 0      0F1(; 1 +- mu; q z^2/4),           else sqrt(z) Y_mu(rho z/i) or sqrt(z) K_mu(rho z)
    Bessel, q = 0      0F1(; 1 +- 2 mu; -r z),            else sqrt(z) Y_2mu(2 sqrt(r z)) or sqrt(z) K_2mu(2 sqrt(-r z))
    Whittaker          e^(-rho z) 1F1(1/2 +- mu - kappa; 1 +- 2 mu; 2 rho z),      else e^(-rho z) U(..., 2 rho z)
    Gauss              2F1(a, b; 1 +- e0; z),             else 2F1(a, b; 1 + e1; 1 - z),    a, b = (1 +- e0 + e1 +- einf)/2

with the second kind ("else") for the lower sign where the exponents differ by an integer.  Where two of the differences are
1/2 (the dihedral case) Gauss' solutions are elementary:

    e1 = einf = 1/2    ((1 + sqrt(1 - z))/2)^(-+e0)
    e0 = e1 = 1/2      sin(einf theta)/(einf sqrt(z)), cos(einf theta),    sin(theta)^2 = z

References: DLMF 9.2, 10.2, 10.25, 10.39, 13.2, 13.14, 15.4.11-18, 15.10.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import acb, acb_poly, arb, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import RationalPoly
from kovacic.enclosure.matrices import State
from kovacic.enclosure.points import ExactPoint, to_acb
from kovacic.special.pullback import Airy, Confluent, Gauss, Pullback

Solution = Callable[["acb"], "State"]  # E and E' at z
Solutions = Callable[["acb", Sequence[bool]], "list[State]"]  # for those of both that are needed, zeros for the other
_HALF = fmpq(1, 2)


@dataclass(frozen=True)
class StandardForm:
    """Two solutions at the working precision in force, as functions of z = n(x)/d(x), the powers (alpha, beta) and the slits.

    The numbers z or 1 - z mustn't reach the negative axis (or 0) where their place in `slits` has a factor c, nor c times them.
    Unless `independent` both are multiples of one polynomial times powers and exp.
    """

    n: fmpq_poly
    d: fmpq_poly
    powers: tuple[tuple[Any, Any], tuple[Any, Any]]
    values: Solutions
    slits: tuple[Any, Any] = (None, None)
    independent: bool = True

    @cached_property
    def derivatives(self) -> tuple[fmpq_poly, fmpq_poly]:
        """n' and d'."""
        return self.n.derivative(), self.d.derivative()

    @property
    def exponents(self) -> list[tuple[Any, Any]]:
        """Those of W, n, d - n and d in either solution, f'^(-1/2) z^alpha (1 - z)^beta."""
        rows = [(-_HALF, alpha, beta, 1 - alpha - beta) for alpha, beta in self.powers]
        return list(zip(*rows, strict=True))


def _parts(f: RatFunc) -> tuple[fmpq_poly, fmpq_poly]:
    num, den = f.num, f.den
    assert isinstance(num, RationalPoly)
    assert isinstance(den, RationalPoly)
    return num.rep, den.rep


def rational(constant: Any) -> Any:
    """A constant of Q as FLINT's rational."""
    assert isinstance(constant, RationalPoly)
    return constant.rep[0]


def square_root(number: Any) -> Any:
    """The principal square root: a rational number where it is one, else a ball."""
    try:
        return number.sqrt()
    except (DomainError, ValueError):
        return acb(number).sqrt()


def is_integer(number: Any) -> bool:
    """Is it known to be an integer?"""
    return isinstance(number, fmpq) and number.q == 1


def choice_at(pullback: Pullback, a: ExactPoint) -> int:
    """Which of the coordinates z, 1 - z, 1/z, ... of Gauss' equation is the smallest at a: there z is between 0 and 1/2 where f
    is real.  For Confluent equations whether Re f(a) < 0: -f is taken, by the symmetry z -> -z, r -> -r."""
    n, d = (value_at(part, a) for part in _parts(pullback.f))
    if isinstance(pullback.equation, Confluent):
        return int(bool(acb(n / d).real < 0)) if d != 0 else 0
    if isinstance(pullback.equation, Airy):
        return 0
    sizes = [(abs(acb(top / bottom)), k) for k, (top, bottom, *_) in enumerate(_maps(n, d, 0, 0, 0)) if bottom != 0]
    return min(sizes, key=lambda item: float(item[0]))[1]


def value_at(poly: fmpq_poly, x: ExactPoint) -> Any:
    """A rational number at a rational point, else a ball."""
    return poly(x.x) if x.is_real() else acb_poly(poly)(to_acb(x))


def form_of(pullback: Pullback, choice: int) -> StandardForm:
    """Two solutions, by this choice of the coordinate."""
    n, d = _parts(pullback.f)
    if isinstance(pullback.equation, Airy):
        return _airy(pullback.equation, n, d)
    if isinstance(pullback.equation, Gauss):
        return _gauss(pullback.equation, n, d, choice)
    return _confluent(pullback.equation, -n if choice else n, d, -1 if choice else 1)


def _airy(equation: Airy, n: fmpq_poly, d: fmpq_poly) -> StandardForm:
    """Ai and Bi of q^(1/3) z."""
    q = rational(equation.q)
    c = acb(arb(abs(q)).root(3)) * (1 if q > 0 else -1) if abs(q) != 1 else acb(q)

    def values(z: acb, needed: Sequence[bool]) -> list[State]:
        Ai, dAi, Bi, dBi = (c * z).airy()
        return [(Ai, c * dAi), (Bi, c * dBi)]

    return StandardForm(n, d, ((0, 0), (0, 0)), values)


def _each(*solutions: Solution) -> Solutions:
    """The values of either."""
    return lambda z, needed: [
        solution(z) if wanted else (acb(0), acb(0)) for solution, wanted in zip(solutions, needed, strict=True)
    ]


def _confluent(equation: Confluent, n: fmpq_poly, d: fmpq_poly, sign: int) -> StandardForm:
    """Bessel's and Whittaker's, with r of this sign."""
    q, r, M = rational(equation.q), sign * rational(equation.r), rational(equation.M)
    mu = square_root(M + fmpq(1, 4))
    if q != 0 and r != 0:
        solutions, slit = _whittaker(q, r, mu)
        independent = slit is None or not _ends(_HALF + mu - r / (2 * slit))
    else:
        solutions, slit = _bessel(q, r, mu if q != 0 else 2 * mu)
        independent = True
    upper = (_HALF + mu, 0)
    lower = (_HALF - mu, 0) if slit is None else (_HALF, 0) if r == 0 or q == 0 else upper
    return StandardForm(n, d, (upper, lower), _each(*solutions), (slit, None), independent)


def _bessel(q: Any, r: Any, order: Any) -> tuple[tuple[Solution, Solution], Any]:
    """0F1(; 1 +- order; argument), the argument q z^2/4 or -r z, and the factor of the slit."""
    square = q != 0

    def first(order: Any) -> Solution:
        c = acb(1 + order)

        def values(z: acb) -> State:
            argument, slope = (z * z * (q / 4), z * (q / 2)) if square else (z * -r, acb(-r))
            return argument.hypgeom_0f1(c), argument.hypgeom_0f1(c + 1) * slope / c

        return values

    if not is_integer(order):
        return (first(order), first(-order)), None
    n, decays = acb(order), q > 0 or r < 0
    root = acb(abs(q) if square else abs(r)).sqrt()

    def second(z: acb) -> State:
        w, slope = (root * z, root) if square else (2 * root * z.sqrt(), root / z.sqrt())
        value, above = (w.bessel_k(v) if decays else w.bessel_y(v) for v in (n, n + 1))
        return value, (n / w * value - above) * slope

    return (first(order), second), 1


def _whittaker(q: Any, r: Any, mu: Any) -> tuple[tuple[Solution, Solution], Any]:
    rho = square_root(q)
    kappa = r / (2 * rho)

    def first(mu: Any) -> Solution:
        a, b = acb(_HALF + mu - kappa), acb(1 + 2 * mu)

        def values(z: acb) -> State:
            decay, w = (-(rho * z)).exp(), 2 * rho * z
            value, above = w.hypgeom_1f1(a, b), w.hypgeom_1f1(a + 1, b + 1)
            return decay * value, decay * rho * (2 * a / b * above - value)

        return values

    if not is_integer(2 * mu):
        return (first(mu), first(-mu)), None
    a, b = acb(_HALF + mu - kappa), acb(1 + 2 * mu)

    def second(z: acb) -> State:
        decay, w = (-(rho * z)).exp(), 2 * rho * z
        value, above = w.hypgeom_u(a, b), w.hypgeom_u(a + 1, b + 1)
        return decay * value, -decay * rho * (value + 2 * a * above)

    return (first(mu), second), rho


def _maps(n: Any, d: Any, A: Any, B: Any, C: Any) -> list[tuple[Any, Any, Any, Any, Any]]:
    """z = n/d, 1 - z, 1/z, z/(z - 1), 1/(1 - z) and (z - 1)/z, with what belongs to their points 0, 1 and infinity."""
    return [
        (n, d, A, B, C),
        (d - n, d, B, A, C),
        (d, n, C, B, A),
        (n, n - d, A, C, B),
        (d, d - n, C, A, B),
        (n - d, n, B, C, A),
    ]


def _gauss(equation: Gauss, n: fmpq_poly, d: fmpq_poly, choice: int) -> StandardForm:
    """About the point 0 of one of the coordinates."""
    differences = (square_root(rational(v)) for v in (equation.A, equation.B, equation.C))
    n, d, e0, e1, e2 = _maps(n, d, *differences)[choice]
    if e0 == _HALF == e2:  # in z/(z - 1)
        n, d, e0, e1, e2 = _maps(n, d, e0, e1, e2)[3]
    upper, right = ((1 + e0) / 2, (1 + e1) / 2)
    if e1 == _HALF and _HALF in (e0, e2) and e0 != 0:
        pair = (_root(e0), _root(-e0)) if e2 == _HALF else (_sine(e2), _cosine(e2))
        return StandardForm(n, d, ((upper, _HALF / 2), ((1 - e0) / 2, _HALF / 2)), _each(*pair), (None, 1))
    if not is_integer(e0):
        pair = (_hypergeometric(e0, e1, e2, False), _hypergeometric(-e0, e1, e2, False))
        return StandardForm(n, d, ((upper, right), ((1 - e0) / 2, right)), _each(*pair), (None, 1))
    pair = (_hypergeometric(e0, e1, e2, False), _hypergeometric(e1, e0, e2, True))
    independent = not any(_ends((1 + e0 + e1 + e) / 2) for e in (e2, -e2))
    return StandardForm(n, d, ((upper, right), (upper, right)), _each(*pair), (1, 1), independent)


def _ends(a: Any) -> bool:
    """Is a hypergeometric series with this upper parameter a polynomial?"""
    return is_integer(a) and a <= 0


def _root(e: Any) -> Solution:
    """((1 + w)/2)^(-e), w = sqrt(1 - z)."""

    def values(z: acb) -> State:
        w = (1 - z).sqrt()
        value = (-(e * ((1 + w) / 2).log())).exp()
        return value, value * e / (2 * w * (1 + w))

    return values


def _sine(e: Any) -> Solution:
    """sin(e theta)/(e sqrt(z)), theta/sqrt(z) for e = 0."""

    def values(z: acb) -> State:
        root = z.sqrt()
        theta = root.asin()
        sine, slope = (theta, acb(1)) if e == 0 else ((e * theta).sin() / e, (e * theta).cos())
        return sine / root, (slope / (1 - z).sqrt() - sine / root) / (2 * z)

    return values


def _cosine(e: Any) -> Solution:
    """cos(e theta)."""

    def values(z: acb) -> State:
        root = z.sqrt()
        angle = e * root.asin()
        return angle.cos(), -angle.sin() * e / (2 * root * (1 - z).sqrt())

    return values


def _hypergeometric(e0: Any, e1: Any, e2: Any, mirrored: bool) -> Solution:
    """2F1 with the exponent differences e0 at 0, e1 at 1, e2 at infinity, in z, or in 1 - z if it is mirrored."""
    a, b, c = (1 + e0 + e1 + e2) / 2, (1 + e0 + e1 - e2) / 2, 1 + e0
    whole = [is_integer(v) for v in (e2, a - c, b - c, e1)]
    first, second, third = acb(a), acb(b), acb(c)

    def values(z: acb) -> State:
        w = 1 - z if mirrored else z
        value = w.hypgeom_2f1(first, second, third, False, *whole)
        slope = w.hypgeom_2f1(first + 1, second + 1, third + 1, False, *whole) * first * second / third
        return value, -slope if mirrored else slope

    return values

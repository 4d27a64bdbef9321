"""Bessel's equation, S0 = q - r/z + M/z^2 with q = 0 or r = 0: of order nu, nu^2 = 4 M + 1, in 2 sqrt(r z), or of nu/2 in
sqrt(-q) z, which is found as one of Whittaker's.

Pull-backs: where the orders of all poles of S are odd, all polar parts of f are determined.  Else its zeros are taken from the
regular places: the exponent difference is the multiplicity times nu.

Solutions: sqrt(t) J_nu(2 sqrt t) and Y_nu, t = r f, and I_nu, K_nu of -t.  Y_nu and K_nu are independent of J_nu and I_nu for
every nu.  For nu = N + 1/2 with a symbolic natural number N there are spherical Bessel functions.

Values: z^((1 +- nu)/2) 0F1(; 1 +- nu; -r z).  Where the exponents differ by an integer the second is sqrt(z) Y_nu(2 sqrt(r z)),
or sqrt(z) K_nu(2 sqrt(-r z)).

Reference: DLMF 10.2, 10.13, 10.25, 10.39, 10.47; 10.5.2, 10.28.2, 10.50.1 (Wronskians).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, ClassVar

from flint import acb, arb, ctx, fmpq, fmpq_poly

from kovacic.algebra.poly import Poly
from kovacic.algebra.precision import working_precision
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Place, Problem
from kovacic.limits import count_work
from kovacic.special import prices
from kovacic.special.maps import (
    HALF,
    TRIAL,
    Fibre,
    Surd,
    as_function_of_x,
    fibres,
    irregular_places,
    leading_square,
    regular_points,
    square,
    zeros,
)
from kovacic.special.pullback import (
    Pullback,
    StandardEquation,
    StandardForm,
    StandardSolution,
    ValueAndSlope,
    each,
    is_integer,
    root_or_ball,
)

if TYPE_CHECKING:
    from kovacic.special.writer import Writer, WrittenPair


@dataclass(frozen=True)
class Bessel(StandardEquation):
    """S0 = q - r/z + M/z^2, q = 0 or r = 0."""

    q: Poly
    r: Poly
    M: Poly

    searched: ClassVar[str] = "Bessel's equation in the square root of f(x), f rational"
    irregular: ClassVar[bool] = True

    @property
    def name(self) -> str:
        return "Whittaker's" if self.q and self.r else "Bessel's"

    @property
    def S(self) -> RatFunc:
        z = self.M.field.x
        return RatFunc(z * z * self.q - z * self.r + self.M, z * z)

    @classmethod
    def candidates(cls, problem: Problem, *, extended: bool, shifted: bool = False) -> Iterator[Pullback]:
        places = irregular_places(problem)
        zero = problem.field.zero
        found: Iterable[tuple[RatFunc, Poly]] = ()
        if all(place.order % 2 for place in places):
            found = zeros(problem, sum((square(place) for place in places), RatFunc(zero)), shifted=shifted)
        elif not shifted:  # the exponents at the zeros are needed
            found = _by_zeros(problem, places)
        for f, nu_squared in found:
            yield Pullback(Bessel(zero, zero + 1, (nu_squared - 1) * Fraction(1, 4)), f)

    def written(self, writer: Writer, f: RatFunc) -> WrittenPair | None:
        return written_pair(writer, 4 * self.M + 1, f * self.r)

    @property
    def parameters(self) -> list[fmpq]:
        return [4 * self.constants[2] + 1]

    @property
    def cost(self) -> prices.Cost:
        return prices.BESSEL

    def coordinate(self, n: Any, d: Any) -> int:
        """1 if Re f < 0: then -f is taken, by the symmetry z -> -z, r -> -r."""
        return int(d != 0 and bool(acb(n / d).real < 0))

    def form(self, n: fmpq_poly, d: fmpq_poly, coordinate: int) -> StandardForm:
        """0F1(; 1 +- order; argument) with the argument -r z or q z^2/4; one of the second kind for an integer order."""
        q, r, M = self.constants
        if coordinate:
            n = -n
            r = -r
        half = fmpq(1, 2)
        mu = root_or_ball(4 * M + 1) / 2
        order, factor = (mu, q) if q else (2 * mu, -r)

        def first(order: Any) -> StandardSolution:
            c = 1 + order

            def value(z: acb) -> ValueAndSlope:
                argument, slope = (z * z * (factor / 4), z * (factor / 2)) if q else (z * factor, acb(factor))
                return _0f1(argument, c), _0f1(argument, c + 1) * slope / c

            return value

        if not is_integer(order):
            return StandardForm(n, d, ((half + mu, 0), (half - mu, 0)), each(first(order), first(-order)))
        nu = acb(order)
        root = acb(abs(factor)).sqrt()

        def second(z: acb) -> ValueAndSlope:
            w, slope = (root * z, acb(root)) if q else (2 * root * z.sqrt(), root / z.sqrt())
            kind = w.bessel_k if factor > 0 else w.bessel_y
            value = kind(nu)
            above = kind(nu + 1)
            return value, (nu / w * value - above) * slope

        return StandardForm(n, d, ((half + mu, 0), (half, 0)), each(first(order), second), (1, None))


# ------------------------------------------------------------------------------------------ found by zeros


def _by_zeros(problem: Problem, irregular: list[Place]) -> Iterator[tuple[RatFunc, Poly]]:
    """f and nu^2 for r = 1: f is a constant times the product of its zeros, by their multiplicities, over that of its poles."""
    one = problem.field.one
    poles = prod((place.factor ** (place.order - 2) for place in irregular if not place.at_infinity), start=one)
    n = sum((place.order - 2) * place.degree for place in irregular)
    points = regular_points(problem)
    logarithmic = [point for point in points if not point.square]
    found: Iterable[Fibre] = fibres(points, n)
    if logarithmic:
        # nu = 0: all zeros are here, and the exponents don't tell the multiplicities.
        choices = product(*(range(1, n // point.degree + 1) for point in logarithmic))
        found = (Fibre(tuple(zip(logarithmic, choice, strict=True)), logarithmic[0].square) for choice in choices)
    for fibre in found:
        problem.budget.check()
        count_work(1)
        if fibre.degree != n:
            continue
        count_work(TRIAL)
        f = RatFunc(fibre.polynomial, poles)
        scale = _scale(f, irregular[0])
        if scale is not None:
            yield f * scale, fibre.square


def _scale(f: RatFunc, place: Place) -> Poly | None:
    """The constant c for which c f has the leading coefficient at the pole that S shows; None if there is none."""
    p = place.factor
    d = place.order - 2
    local = as_function_of_x(f, place)
    scale = leading_square(place) * (local.den // p**d) * local.num.inverse_modulo(p) % p
    return scale if scale.degree == 0 else None


# ------------------------------------------------------------------------------------------ written


def written_pair(writer: Writer, nu_squared: Poly, t: RatFunc) -> WrittenPair:
    """u = sqrt(t) J_nu(2 sqrt t), or with I, K and -t where the constant factor of t is negative.

    Where t vanishes at a point that isn't `singular`, nu isn't an integer, and t^((1 +- nu)/2) 0F1(; 1 +- nu; -t) are analytic.
    """
    import sympy

    nu = writer.square_root(nu_squared)
    singular = writer.singular
    if singular is not None and any(k > 0 and p.gcd(singular).degree == 0 for p, k in t.multiplicities):
        first, second = (
            (writer.factor(t, [((m + 1) * HALF, t)]), writer.hypergeometric((), (m + 1,), writer.argument(-t)))
            for m in (nu, -nu)
        )
        # t^((1 + nu)/2) and t^((1 - nu)/2) are the leading terms at t = 0.
        return writer.pair(first, second, -writer.constant(nu) * writer.rate(t), (nu,))
    modified = writer.is_negative(writer.scale(t))
    four_t = t * -4 if modified else t * 4
    z = writer.root_of(four_t)
    degree = next((m - HALF for m in (nu, -nu) if writer.is_degree(m - HALF)), None)
    rate = writer.rate(t) / 2  # z'/z
    kinds, order, power, bracket = (sympy.besselj, sympy.bessely), nu, HALF, 2 * rate / sympy.pi
    if modified:
        kinds, bracket = (sympy.besseli, sympy.besselk), -rate
    elif degree is not None:  # J_nu = sqrt(2 z/pi) j_n
        kinds, order, power, bracket = (sympy.jn, sympy.yn), degree, Fraction(3, 4), rate / z
    before = writer.factor(t, [(Surd(nu.part * 0 + power), t)])
    first, second = ((before, kind(writer.constant(order), z, evaluate=False)) for kind in kinds)
    return writer.pair(first, second, bracket)


# ------------------------------------------------------------------------------------------ values


def _0f1(argument: Any, c: Any) -> Any:
    """0F1(; c; argument), where FLINT sums the power series with its middle, and with more bits.

    The terms are as large as exp(w), w = 2 sqrt(|argument|), while the sum may be near 1: w/log(2) bits, and as much of the
    radius of the argument, are lost up to where FLINT takes the asymptotic expansion, at a w that grows with the precision.
    For a real c >= -1/2 the derivative, 0F1(; c + 1; a)/c, is at most exp(|Im 2 sqrt(-a)|)/|c| [DLMF 10.14.4].
    """
    found = argument.hypgeom_0f1(acb(c))
    bits = ctx.prec
    is_accurate = found.rel_accuracy_bits() > bits // 2
    is_bounded = isinstance(c, fmpq) and c >= fmpq(-1, 2) and argument.is_finite()
    if is_accurate or not is_bounded:
        return found
    w = 2 * math.sqrt(float(abs(argument).upper()))
    if w > 2 * bits:
        return found
    with working_precision(bits + int(w / math.log(2)) + 10):
        middle = acb(argument.real.mid(), argument.imag.mid()).hypgeom_0f1(acb(c))
    growth = abs((2 * (-argument).sqrt()).imag).exp()
    error = ((argument.real.rad() + argument.imag.rad()) * growth / abs(arb(c))).upper()
    off_axis = 0 if argument.imag == 0 else error
    return acb(arb(middle.real.mid(), middle.real.rad() + error), arb(middle.imag.mid(), middle.imag.rad() + off_axis))

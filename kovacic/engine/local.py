"""Local solutions modulo a prime at a place that tells solutions apart, and the rational omega that they determine.

If omega is unique it is rational over K, and at such a place it has one of at most two expansions.  Modulo a prime for which
the place has a root in F_p, Euclid's algorithm finds the rational function with that expansion, if there is one of the
bounded degree: the signs at all other places come out by themselves.

References: van Hoeij, J. Symb. Comp. 24 (1997); Cluzeau & van Hoeij, J. Symb. Comp. 38 (2004).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import nmod_poly

from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.modular import (
    rational_function_from_series,
    reverse,
    series_solution,
    simple_roots,
    square_root,
    square_root_series,
    translate,
)
from kovacic.engine.places import Kind, LocalEquation, Place, Problem, local_equation, reduced_equation


@dataclass(frozen=True)
class ModularChart:
    """The equation modulo p in a coordinate t in which the chosen place is t = 0: y'' = num/den y, with D as in `Problem`.

    `growth` bounds deg A - deg P for omega = A / (D P): deg D - 1, or more if infinity is irregular.
    """

    num: Any
    den: Any
    D: Any
    growth: int
    equation: LocalEquation
    root: int
    inverted: bool


def chart(h: Homomorphism, problem: Problem, place: Place) -> ModularChart | None:
    """The chart at the least simple root of the place's factor; None if it has none in F_p."""
    # `opposite` is the weight of the place at t = infinity: of x = 0 for the place at infinity, else of infinity.
    if place.at_infinity:
        root: int | None = 0
        opposite = next((p.weight for p in problem.finite_places if p.factor.degree == 1 and not p.factor[0]), 0)
    else:
        root = next(simple_roots(h.keeping_degree(place.factor)), None)
        opposite = problem.infinity.weight
    if root is None:
        return None
    num = h(place.num)
    den = h.keeping_degree(place.den)
    D = h.keeping_degree(problem.D)
    if place.at_infinity:
        D = reverse(D, D.degree()).left_shift(place.weight)
    num, den, D = (translate(f, root) for f in (num, den, D))
    equation = local_equation(num, den, place.order)
    # There omega grows like t^(weight - 2), and like 1/t at an ordinary point, where the weight is 0.
    return ModularChart(num, den, D, D.degree() + max(opposite, 1) - 2, equation, root, place.at_infinity)


def exponential_parts(equation: LocalEquation, place: Place, exponents: Sequence[Fraction] | None = None) -> list[Any]:
    """The polynomials Q such that y = exp(int Q/t^nu) u, u a unit, can be a solution with a rational omega.

    The coefficient of t^(nu-1) in Q is the exponent; with `exponents` it must be one of these.

    At a regular place Q is an exponent: (1 + Delta)/2 alone if there is a logarithm.  At an unramified irregular place
    Q = +-[sqrt S] + (nu +- b/a)/2 t^(nu-1) [Kovacic 1986, sec. 3.2].  Empty if a square root doesn't exist modulo p.
    """
    nu = equation.nu
    ratio = equation.N.mul_low(equation.E.inverse_series_trunc(nu), nu)
    if place.kind is Kind.REGULAR:
        # (1 + Delta)/2 and (1 - Delta)/2 with Delta^2 = 1 + 4 s, s the leading coefficient.
        p = equation.p
        delta = square_root(1 + 4 * int(ratio[0]), p) if place.delta is None else _modulo(place.delta, p)
        signs = [1] if place.logarithm or delta == 0 else [1, -1]
        half = pow(2, -1, p)
        parts = [] if delta is None else [nmod_poly([(1 + sign * delta) * half % p], p) for sign in signs]
    else:
        parts = _irregular_parts(equation.p, nu, ratio)
    if exponents is None:
        return parts
    allowed = [_modulo(exponent, equation.p) for exponent in exponents]
    return [Q for Q in parts if int(Q[nu - 1]) in allowed]


def _modulo(number: Fraction, p: int) -> int:
    return number.numerator * pow(number.denominator, -1, p) % p


def _irregular_parts(p: int, nu: int, ratio: Any) -> list[Any]:
    """+-[sqrt S] + (nu +- b/a)/2 t^(nu-1), for S = ratio/t^(2 nu).

    With S = (a + ... + r t^(nu-1))^2 / t^(2 nu) + O(t^-nu): b = 2 a r, so that b/a = 2 r.
    """
    if not int(ratio[0]):
        raise BadPrimeError("the leading coefficient at an irregular place vanishes")
    root = square_root(int(ratio[0]), p)
    if root is None:
        return []
    half = pow(2, -1, p)
    parts = []
    for leading in (root, -root % p):
        series = square_root_series(ratio, nu, leading)
        exponent = (nu * half + int(series[nu - 1])) % p
        parts.append(series.truncate(nu - 1) + nmod_poly([exponent], p).left_shift(nu - 1))
    return parts


def rational_omega(c: ModularChart, Q: Any, degree: int) -> tuple[Any, Any] | None:
    """`(A, P)` modulo p with omega = A/(D P) in the chart, deg P <= degree, for the local solution of type Q, or None.

    None is a proof that no such rational omega over K has a P of degree at most `degree` (see `engine.reducible`).
    """
    top = degree + c.growth
    order = top + degree + 2  # one term more than A and P have unknowns
    u = series_solution(*reduced_equation(c.equation.expanded(order), Q), order)
    local = (Q * u + u.derivative().left_shift(c.equation.nu)).mul_low(u.inverse_series_trunc(order), order)
    series = c.D.right_shift(c.equation.nu).mul_low(local, order)
    found = rational_function_from_series(series, order, top)
    if found is None or found[1].degree() > degree:
        return None
    A, P = found
    B = c.D * P
    if c.den * (A.derivative() * B - A * B.derivative() + A * A) != c.num * B * B:
        return None
    return A, P


def omega_parts(h: Homomorphism, problem: Problem, c: ModularChart, A: Any, P: Any) -> tuple[Any, int]:
    """R and the degree of P for omega = R/D + P'/P in the coordinate x, modulo p."""
    if c.inverted:
        # omega(x) = 1/x - omega_z(1/x)/x^2 with omega_z = A/B.
        B = c.D * P
        size = max(A.degree(), B.degree())
        above = reverse(A, size)
        below = reverse(B, size)
        A = below.left_shift(1) - above
        B = below.left_shift(2)
    else:
        A, B = (translate(f, -c.root % h.p) for f in (A, c.D * P))
    D = h(problem.D)
    A = A * D
    common = A.gcd(B)
    A = A // common
    P = B // common
    leading = pow(int(P.leading_coefficient()), -1, h.p)
    A = A * leading
    P = P * leading
    R, rest = divmod(A - D * P.derivative(), P)
    if rest:
        raise BadPrimeError("zeros of a solution meet modulo this prime")
    return R, int(P.degree())

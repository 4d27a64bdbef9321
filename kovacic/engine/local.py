"""Local solutions modulo a prime at a place that tells solutions apart, and the rational omega that they determine.

If omega is unique it is rational over K, and at such a place it has one of at most two expansions.  Modulo a prime for which
the place has a root in F_p, Euclid's algorithm finds the rational function with that expansion, if there is one of the
bounded degree: the signs at all other places come out by themselves.

The number of zeros of the solution, the degree of P, is bounded by its exponents.  At the roots of a factor p they are
conjugate, (A +- sqrt g)/2 with g in K[x]/p, because omega is rational over K.  So g must be a square in K[x]/p, and the sum of
the exponents over the roots follows from the trace of its root.

References: van Hoeij, J. Symb. Comp. 24 (1997); Cluzeau & van Hoeij, J. Symb. Comp. 38 (2004).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import nmod_poly

from kovacic.algebra.extension import inverse_root, root_in_residue_field
from kovacic.algebra.homomorphism import BadPrimeError, Homomorphism
from kovacic.algebra.modular import (
    rational_function_from_series,
    reverse,
    series_solution,
    simple_roots,
    square_root_modulo,
    square_root_series,
    translate,
)
from kovacic.algebra.partial_fractions import reduce_poles
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative
from kovacic.algebra.rationals import QQ, to_fraction
from kovacic.algebra.traces import is_provably_not_a_square, largest_integer_total, power_sums
from kovacic.decision import Evidence, NecessaryCondition, NoRationalOmega, Rule
from kovacic.engine.places import Kind, LocalEquation, Place, Problem, local_equation, reduced_equation


def irrational_exponents(problem: Problem) -> NecessaryCondition | None:
    """A place at which the exponents provably aren't rational over the field of its roots, if one is found quickly."""
    for place in problem.places:
        if place.kind in (Kind.REGULAR, Kind.UNRAMIFIED) and place.delta is None:
            p = place.factor
            top, cofactor = place.near
            # S = top / (t^order bottom) to leading order at the class of x in K[x]/p.
            bottom = cofactor % p if p.degree == 1 else p.derivative() ** place.order * cofactor % p
            if place.kind is Kind.REGULAR:
                top = bottom + 4 * top
            if is_provably_not_a_square(top * bottom % p, p):
                return NecessaryCondition(Rule.NOT_A_SQUARE, (place.name,))
    return None


@dataclass(frozen=True)
class DegreeBound:
    """For a unique omega = R/D + P'/P the degree of P is `total` plus or minus each choice, and at most `largest`.

    There is a choice for a place where two exponents are possible, half the difference of their sums over its points.
    """

    largest: int
    total: Fraction
    choices: list[tuple[Place, Fraction]]

    def exponents(self, place: Place) -> list[Poly] | None:
        """The exponents of omega at a place that leave a natural number for the degree, whatever those elsewhere are.

        None unless the place is a single point with a choice between rational numbers.
        """
        halves = [half for other, half in self.choices if other is place]
        if place.degree > 1 or not halves:
            return None
        if place.delta is None and place.factor.field != QQ:
            return None
        others = [half for other, half in self.choices if other is not place]
        signed = (halves[0], -halves[0])
        possible = [half for half in signed if largest_integer_total(self.total - half, others) >= 0]
        return [place.factor.field.poly([Fraction(place.weight, 2) + half]) for half in possible]


def degree_bound(problem: Problem) -> DegreeBound | Evidence:
    """The degrees that P can have for a unique omega = R/D + P'/P: 1 - sum of the exponents over all places.

    The exponents at the roots of a factor are conjugate, (A +- sqrt g)/2 with g in K[x]/p, so their sum follows from the
    trace of sqrt g [sec. 3.2 of Kovacic 1986 for the exponents], one sign for each factor.  Evidence against omega if no
    choice of signs gives a natural number, or if the exponents at a place aren't rational over K[x]/p.
    """
    twice = 2
    choices = list[tuple[Place, Fraction]]()
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        n = place.degree
        delta = place.delta
        twice -= n * place.weight
        if delta is None:
            p = place.factor
            is_regular = place.kind is Kind.REGULAR
            square = place.difference_squared if is_regular else irregular_difference_squared(place)
            trace = trace_of_square_root(square, p)
            if trace is None:
                return NecessaryCondition(Rule.NOT_A_SQUARE, (place.name,))
            # a Q-linear map of the field onto Q that is the identity on Q: the first rational coordinate
            first = to_fraction(trace.rational_coefficients()[0]) if trace else Fraction(0)
            choices.append((place, first / 2))
        elif place.logarithm:  # then Delta is an integer
            twice -= n * delta.numerator
        else:
            choices.append((place, Fraction(n * delta.numerator, 2 * delta.denominator)))
    total = Fraction(twice, 2)
    largest = largest_integer_total(total, [half for _, half in choices])
    return DegreeBound(largest, total, choices) if largest >= 0 else NoRationalOmega(-1)


def is_cheap(problem: Problem) -> bool:
    """True if `degree_bound` needs no traces of square roots in extensions."""
    return all(place.delta_squared is not None or place.degree == 1 for place in problem.places)


def trace_of_square_root(square: Poly, p: Poly) -> Poly | None:
    """The trace over K of a square root of an element of K[x]/p, with one choice of its sign; None if it has none there."""
    root = root_in_residue_field(square, p, 2)
    if root is None:
        return None
    return sum((root[i] * total for i, total in enumerate(power_sums(p))), p.field.zero)


def irregular_difference_squared(place: Place) -> Poly:
    """(b/a)^2 in K[x]/p at an unramified irregular place: four times the square of the residue of sqrt(S) dx.

    For S = N/(p^(2 nu) q) and v = N q modulo p, sqrt(S) = v^(-1/2) N Y/p^nu, where Y = 1 modulo p and N q Y^2 = v.
    """
    p = place.factor
    nu = place.order // 2
    power = p**nu
    N, q = place.near
    v = N * q % p
    Y = inverse_root(N * q * v.inverse_modulo(power) % power, p, 2, nu)
    root = N * Y % power
    if p.degree == 1:
        residue = root(p.field.poly([-p[0], 1]))[nu - 1]
    else:
        _, _, residues = reduce_poles(RatFunc(root, power), logarithmic_derivative(v) / -2, v)
        residue = residues[0].value if residues else 0 * v
    return 4 * residue * residue * v.inverse_modulo(p) % p


@dataclass(frozen=True)
class ModularChart:
    """The equation modulo p in a coordinate t in which the chosen place is t = 0: y'' = num/den y, with D as in `Problem`.

    `growth` bounds deg A - deg P for omega = A / (D P): deg D - 1, or more if infinity is irregular.  `root` is x at t = 0;
    `inverted` says that t = 1/x.
    """

    num: Any
    den: Any
    D: Any
    growth: int
    equation: LocalEquation
    root: int
    inverted: bool


def modular_chart(h: Homomorphism, problem: Problem, place: Place) -> ModularChart | None:
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


def exponential_parts(equation: LocalEquation, place: Place, exponents: Sequence[int] | None = None) -> list[Any]:
    """The polynomials Q such that y = exp(int Q/t^nu) u, u a unit, can be a solution with a rational omega.

    The coefficient of t^(nu-1) in Q is the exponent; with `exponents` modulo p it must be one of these.

    At a regular place Q is an exponent: (1 + Delta)/2 alone if there is a logarithm.  At an unramified irregular place
    Q = +-[sqrt S] + (nu +- b/a)/2 t^(nu-1) [Kovacic 1986, sec. 3.2].  Empty if a square root doesn't exist modulo p.
    """
    nu = equation.nu
    ratio = equation.N.mul_low(equation.E.inverse_series_trunc(nu), nu)
    if place.kind is Kind.REGULAR:
        # (1 + Delta)/2 and (1 - Delta)/2 with Delta^2 = 1 + 4 s, s the leading coefficient.
        p = equation.p
        delta = square_root_modulo(1 + 4 * int(ratio[0]), p) if place.delta is None else _modulo(place.delta, p)
        signs = [1] if place.logarithm or delta == 0 else [1, -1]
        half = pow(2, -1, p)
        parts = [] if delta is None else [nmod_poly([(1 + sign * delta) * half % p], p) for sign in signs]
    else:
        parts = _irregular_parts(equation.p, nu, ratio)
    if exponents is None:
        return parts
    return [Q for Q in parts if int(Q[nu - 1]) in exponents]


def _modulo(number: Fraction, p: int) -> int:
    return number.numerator * pow(number.denominator, -1, p) % p


def _irregular_parts(p: int, nu: int, ratio: Any) -> list[Any]:
    """+-[sqrt S] + (nu +- b/a)/2 t^(nu-1), for S = ratio/t^(2 nu).

    With S = (a + ... + r t^(nu-1))^2 / t^(2 nu) + O(t^-nu): b = 2 a r, so that b/a = 2 r.
    """
    if not int(ratio[0]):
        raise BadPrimeError("the leading coefficient at an irregular place vanishes")
    root = square_root_modulo(int(ratio[0]), p)
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
    if c.inverted:  # t = 1/x
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

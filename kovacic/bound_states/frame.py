"""The coordinate z(x) in which y'' = (V - E) y is a standard equation, and what the ends of the domain are in it.

The reader has put t = x, exp(k x), sinh(k x), ... ; s = t - c or 1/(t - p) - c and z = s^m follow from the symmetries of the
equation in t.  With (dz/dx)^2 = C prod (z - c)^mu_c and v'' = S_z v, the solutions are y = (dz/dx)^(-1/2) v.  So where v has
the exponents (1 +- delta)/2 at z = c, y has

    (1 +- delta)/2 - mu/4,                                                                                          (1)

and where x is finite at c (mu < 2), z - c ~ (x - a)^p with p = 2/(2 - mu), so that y ~ (x - a)^(1/2 +- nu), nu = p delta/2.
At z = oo the coordinate is 1/z, and the sum of all mu is 4.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import compress
from typing import Any

import sympy

from kovacic.bound_states.coordinates import Original, near
from kovacic.bound_states.ends import leading
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs, Uncovered
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.limits import Budget
from kovacic.parametric.theorems import roots_of, symmetries
from kovacic.reading.symbolic import written_expression


@dataclass(frozen=True)
class Spot:
    """A singular point of v'' = S_z v: where, delta^2 (None: irregular), mu, and what of the domain is there.

    `sides` are 0 for its left end, or the middle of a symmetric one, and 1 for the right one.
    """

    point: Any
    square: Any
    mu: Any
    sides: tuple[int, ...] = ()

    def exponent(self, delta: Any) -> Any:
        """The exponent of y for a signed exponent difference, by (1)."""
        return (1 + delta) / 2 - self.mu / 4


@dataclass(frozen=True)
class SingularFrame:
    """A coordinate z with the singular points, and the ends of the domain among them; (dz/dx)^2 = `slope`.

    `coordinate` is z = s^m as a function of t, S and `slope` are functions of the symbol `z`.  `fold` is the x about which the
    domain and the equation are symmetric, where z doesn't tell x from its mirror image, and the problem is that on the right
    half; None if z is a coordinate.  `original` is t on this half.
    """

    question: SpectralProblem
    original: Original
    coordinate: Any
    S: Any
    z: Any
    slope: Any
    spots: tuple[Spot, ...]
    fold: Any

    def ends_at(self, spot: Spot) -> tuple[int, ...]:
        """The sides of the spot that are ends of the domain."""
        return tuple(side for side in spot.sides if side == 1 or self.fold is None)

    def direction(self, side: int) -> int:
        """The sign of z near an end at which it is infinite."""
        u = sympy.Dummy("u")
        local = near(self.original.at(side), u)
        order, strength = leading(self.coordinate.xreplace({self.question.t: local}), u)
        sign = self.original.signs.known_sign(strength, f"the sign of z = {self.coordinate} isn't known")
        return int(sign * self.original.side_of(side) ** abs(order))


def frames(question: SpectralProblem, budget: Budget) -> Iterator[SingularFrame]:
    """The equation as it was read, and in each coordinate that its symmetries give."""
    t = question.t
    problem = analyse(question.parsed.S, budget)
    yield _frame(question, t, 1, problem)
    for symmetric in symmetries(problem, t.name):
        coordinate = symmetric.coordinate
        is_another = coordinate.n % 2 == 0 or (coordinate.n == 1 and coordinate.base != t.name)
        base = question.signs.real(written_expression(coordinate.base))
        if is_another and not base.has(question.E):
            yield _frame(question, base, coordinate.n, symmetric.quotient(problem))


def _frame(question: SpectralProblem, base: Any, m: int, problem: Problem) -> SingularFrame:
    """The problem v'' = S_z v in z = base^m."""
    signs = question.signs
    z = sympy.Dummy("Z")
    constant, powers = _squared_slope(question, base, m)
    # dz/dx vanishes where dt/dx does, and where base does for an even m.
    zeros = sympy.solve(sympy.numer(sympy.together(base)), question.t) if m % 2 == 0 else []
    fold = question.original.middle(zeros)
    if fold is not None and len({wish is None or wish.is_zero for wish in question.boundary.wishes}) > 1:
        conditions = "the conditions at the ends aren't symmetric about"
        raise Uncovered(f"{conditions} {question.x} = {fold}, and the equation is")
    original = question.original if fold is None else question.original.on(fold, question.domain[1])
    places = tuple(_value(base**m, question.t, original.at(side)) for side in (0, 1))
    return SingularFrame(
        question,
        original,
        base**m,
        S=signs.real(problem.S.to_sympy(z)),
        z=z,
        slope=constant * sympy.Mul(*((z - c) ** mu for c, mu in powers.items())),
        spots=tuple(_spots(problem, powers, places, signs)),
        fold=fold,
    )


def _value(function: Any, t: Any, point: Any) -> Any:
    """The value of a rational function on the sphere, at a number or oo: at a pole it is oo, whatever the sign."""
    u = sympy.Dummy("u")
    local = sympy.cancel(sympy.together(function.xreplace({t: near(point, u)})))
    num, den = (sympy.simplify(part.xreplace({u: sympy.S.Zero})) for part in sympy.fraction(local))
    return sympy.oo if den == 0 else sympy.simplify(num / den)


def linear_factors(expression: Any, z: Any) -> tuple[Any, dict[Any, Any]]:
    """The constant, and the exponents of z - c by c, of a product of powers of polynomials."""
    constant = sympy.Integer(1)
    found = defaultdict[Any, Any](int)
    for factor in sympy.Mul.make_args(sympy.factor(expression)):
        base, exponent = factor.as_base_exp()
        if not base.has(z):
            constant *= factor
            continue
        polynomial = sympy.Poly(base, z)
        constant *= polynomial.LC() ** exponent
        for root, multiplicity in sympy.roots(polynomial).items():
            found[root] += multiplicity * exponent
    return constant, found


def _squared_slope(question: SpectralProblem, base: Any, m: int) -> tuple[Any, dict[Any, Any]]:
    """C and the mu_c in (dz/dx)^2 = C prod (z - c)^mu_c, from the same in s, z = s^m."""
    t, s = question.t, sympy.Dummy("s")
    t_of_s = sympy.solve(base - s, t)[0]
    ds_dx_squared = (sympy.diff(base, t) ** 2 * question.original.slope_squared(t)).xreplace({t: t_of_s})
    constant, exponents = linear_factors(m**2 * s ** (2 * m - 2) * ds_dx_squared, s)
    powers = defaultdict[Any, Any](int)
    for root, exponent in exponents.items():
        powers[root**m] += sympy.S.One * exponent / m  # m roots s for one z
    return constant, powers


def _spots(problem: Problem, powers: Mapping[Any, Any], places: tuple[Any, ...], signs: Signs) -> Iterator[Spot]:
    """The singular points, with the `places` of the ends, or of the middle and an end.

    Where mu > 0 there is one: E (z - c)^(-mu) occurs in S_z.
    """
    x = sympy.Dummy("x")
    squares: dict[Any, Any] = {}
    for place in problem.places:
        if place.degree > 2:
            raise Uncovered(f"the roots of {place.factor} aren't used")
        for c in roots_of(place, x) if place.kind is not Kind.ORDINARY else ():
            point = sympy.oo if c is None else signs.real(c)
            squares[point] = None
            if place.kind is Kind.REGULAR:
                square = signs.real(place.difference_squared.to_sympy(x))
                squares[point] = sympy.expand(square.xreplace({x: point}))
    powers = {**powers, sympy.oo: sympy.Integer(4) - sum(powers.values())}
    for point, square in squares.items():
        is_there = (place == point or sympy.simplify(place - point) == 0 for place in places)
        yield Spot(point, square, powers.get(point, sympy.S.Zero), tuple(compress((0, 1), is_there)))

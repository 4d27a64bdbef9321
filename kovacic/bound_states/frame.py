"""The coordinate z(x) in which y'' = (V - E) y is a standard equation, and what the ends of the domain are in it.

The reader has put t = x, exp(k x), sinh(k x), ... ; s = t - c or 1/(t - p) - c and z = s^m follow from the symmetries of the
equation in t.  With (dz/dx)^2 = C prod (z - c)^mu_c and v'' = S_z v, the solutions are y = (dz/dx)^(-1/2) v.  So where v has
the exponents (1 +- delta)/2 at z = c, y has

    (1 +- delta)/2 - mu/4,                                                                                          (1)

and where x is finite at c (mu < 2), z - c ~ (x - a)^p with p = 2/(2 - mu), so that y ~ (x - a)^(1/2 +- nu), nu = p delta/2.
At z = oo the coordinate is 1/z, and the sum of all mu is 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import sympy

from kovacic.bound_states.question import Signs, SpectralProblem, Uncovered
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import Equation
from kovacic.limits import Budget
from kovacic.parametric import riemann
from kovacic.parametric.theorems import roots_of, symmetries
from kovacic.reading.change_of_variable import SQUARES
from kovacic.reading.symbolic import written_expression
from kovacic.writing.formula import caret


@dataclass(frozen=True)
class Original:
    """t as a function of the user's variable: the function's name, and its argument theta = rate * x + offset."""

    x: Any
    kind: str = "x"
    rate: Any = sympy.S.One
    offset: Any = sympy.S.Zero

    @classmethod
    def of(cls, equation: Equation | None, x: Any, signs: Signs) -> Original:
        """The one that the reader has chosen."""
        if equation is None or equation.change is None:
            return cls(x)
        t = signs.real(written_expression(equation.change.expression)).xreplace({sympy.Symbol(x.name): x})
        if t.func not in SQUARES:
            raise Uncovered(f"no formula is known for potentials in {caret(str(t))}")
        theta = sympy.expand(t.args[0])
        return cls(x, t.func.__name__, theta.coeff(x, 1), theta.coeff(x, 0))

    @property
    def is_circular(self) -> bool:
        """True for t = exp(i theta) with a real theta."""
        return self.kind == "exp" and self.rate.has(sympy.I)

    @property
    def is_periodic(self) -> bool:
        return self.is_circular or self.kind in ("sin", "cos", "tan")

    @property
    def theta(self) -> Any:
        return self.rate * self.x + self.offset

    @property
    def t(self) -> Any:
        return self.theta if self.kind == "x" else getattr(sympy, self.kind)(self.theta)

    def slope_squared(self, t: Any) -> Any:
        """(dt/dx)^2 as a function of t."""
        if self.kind == "x":
            return sympy.Integer(1)
        return SQUARES[getattr(sympy, self.kind)](t) * self.rate**2

    def theta_at(self, end: Any, signs: Signs) -> Any:
        """The argument at an end of the domain."""
        if not end.is_infinite:
            return sympy.simplify(self.rate * end + self.offset)
        sign = signs.sign(self.rate)
        if sign is None:
            raise Uncovered(f"the sign of {self.rate} isn't known: assume that it is positive")
        return sign * end

    def at(self, end: Any, signs: Signs) -> Any:
        """t at an end of the domain, a number or oo (both of its ends are one point)."""
        theta = self.theta_at(end, signs)
        if theta.is_infinite:
            if self.kind in ("sin", "cos", "tan"):
                raise Uncovered(f"V is periodic: no solution is square integrable at {self.x} = {end}")
            is_zero = self.kind == "exp" and theta == -sympy.oo
            return sympy.Integer(0) if is_zero else sympy.oo
        if self.kind == "x":
            return theta
        value = sympy.simplify(getattr(sympy, self.kind)(theta))
        return sympy.oo if value.is_infinite else value  # the pole of a tangent

    def angles_at(self, point: Any, ends: tuple[Any, Any]) -> list[Any]:
        """The real theta with a value of t; of a sine, cosine or tangent those near the domain and between its ends."""
        if self.kind == "x":
            return [point]
        if self.kind == "sinh":
            return [sympy.asinh(point)]
        if self.kind == "exp":
            return [] if point.is_positive is False else [sympy.log(point)]
        inverse = {"cosh": sympy.acosh, "cos": sympy.acos, "sin": sympy.asin, "tan": sympy.atan}[self.kind]
        angle = sympy.pi / 2 if point == sympy.oo else inverse(point)
        if angle.is_real is False:
            return []
        other = sympy.pi - angle if self.kind == "sin" else angle + sympy.pi if self.kind == "tan" else -angle
        in_a_period = list(dict.fromkeys((angle, other)))
        if self.kind == "cosh":
            return in_a_period
        period = 2 * sympy.pi
        lowest = sympy.floor(min(ends) / period) - 1
        number = int(sympy.ceiling((max(ends) - min(ends)) / period)) + 3
        return [a + period * (lowest + k) for a in in_a_period for k in range(number)]

    def turning_points(self, domain: tuple[Any, Any], signs: Signs) -> list[Any]:
        """Where dt/dx vanishes inside the domain: where t is 1 or -1."""
        values = {"cosh": (1,), "cos": (1, -1), "sin": (1, -1)}.get(self.kind)
        if values is None:
            return []
        first, last = (self.theta_at(end, signs) for end in domain)
        if self.kind != "cosh" and not (first.is_number and last.is_number):
            raise Uncovered(f"the ends of the domain aren't multiples of pi/({self.rate})")
        angles = [a for value in values for a in self.angles_at(sympy.Integer(value), (first, last))]
        return [(a - self.offset) / self.rate for a in angles if is_between(a, first, last, signs)]


@dataclass(frozen=True)
class RealPotential:
    """V as a function of a real t, what t is, and the k of -k y'' + k V y = E y, in which V is shown."""

    V: Any
    original: Original
    t: Any
    kinetic: Any = sympy.S.One


def is_between(value: Any, first: Any, last: Any, signs: Signs) -> bool:
    """True strictly between the ends.  Raises `Uncovered` if that isn't known."""
    from_first, to_last = (sympy.simplify(difference) for difference in (value - first, last - value))
    if 0 in (from_first, to_last):
        return False
    known = [signs.sign(from_first), signs.sign(to_last)]
    if None not in known:
        return known[0] == known[1]
    raise Uncovered(f"whether {value} lies between {first} and {last} isn't known")


@dataclass(frozen=True)
class Spot:
    """A singular point of v'' = S_z v: where, delta^2 (None: irregular), mu, and what of the domain is there.

    `sides` are 0 for its left end and 1 for the right one; it `is_fold` where the middle of the domain is there.
    """

    point: Any
    square: Any
    mu: Any
    sides: tuple[int, ...] = ()
    is_fold: bool = False

    @property
    def is_used(self) -> bool:
        return self.is_fold or bool(self.sides)

    def exponent(self, delta: Any) -> Any:
        """That of y for a signed exponent difference, by (1)."""
        return (1 + delta) / 2 - self.mu / 4


@dataclass(frozen=True)
class SingularFrame:
    """A coordinate z with the singular points, and the ends of the domain among them; (dz/dx)^2 = `slope`.

    `coordinate` is z = s^m as a function of t, S and `slope` are functions of the symbol `z`.  `fold` is the x about which the
    domain and the equation are symmetric, where z doesn't tell x from its mirror image, and the problem is that on the right
    half; None if z is a coordinate.  `limits_of_t` are the least and the largest value of t on this half, each None if it is
    unknown.
    """

    original: Original
    t: Any
    coordinate: Any
    S: Any
    z: Any
    slope: Any
    spots: tuple[Spot, ...]
    domain: tuple[Any, Any]
    fold: Any
    limits_of_t: tuple[Any, Any] = (None, None)

    @property
    def is_in_x(self) -> bool:
        """True for the user's own variable."""
        return self.original.kind == "x" and self.coordinate == self.t

    @property
    def is_even(self) -> bool:
        """True if z is a square."""
        return self.coordinate.is_Pow and bool(self.coordinate.exp % 2 == 0)


def frames(question: SpectralProblem, budget: Budget) -> Iterator[SingularFrame]:
    """The equation as it was read, and in each coordinate that its symmetries give."""
    signs = question.signs
    variable = question.parsed.variable
    original = Original.of(question.parsed.equation, question.x, signs)
    problem = analyse(question.parsed.S, budget)
    t = sympy.Symbol(variable)
    yield _frame(question, original, t, t, 1, problem)
    for symmetric in symmetries(problem, variable):
        coordinate = symmetric.coordinate
        is_another = coordinate.n % 2 == 0 or (coordinate.n == 1 and coordinate.base != variable)
        base = signs.real(written_expression(coordinate.base))
        if is_another and not base.has(question.E):
            yield _frame(question, original, t, base, coordinate.n, symmetric.quotient(problem))


def _frame(question: SpectralProblem, original: Original, t: Any, base: Any, m: int, problem: Problem) -> SingularFrame:
    """The problem v'' = S_z v in z = base^m."""
    signs = question.signs
    z = sympy.Dummy("Z")
    constant, powers = _slope(original, t, base, m)
    fold = _fold(original, t, base, m, question)
    half = question.domain if fold is None else (fold, question.domain[1])
    places = tuple(_value(base**m, t, original.at(end, signs)) for end in half)
    return SingularFrame(
        original,
        t,
        base**m,
        S=signs.real(sympy.sympify(problem.S.num.to_sympy(z) / problem.S.den.to_sympy(z))),
        z=z,
        slope=constant * sympy.Mul(*((z - c) ** mu for c, mu in powers.items())),
        spots=tuple(_spots(problem, powers, places, signs, is_fold=fold is not None)),
        domain=question.domain,
        fold=fold,
        limits_of_t=range_of(original, half, signs),
    )


def _value(function: Any, t: Any, point: Any) -> Any:
    """That of a rational function at a number or at oo, the sphere's: a pole is oo, whatever the sign."""
    u = sympy.Dummy("u")
    local = sympy.cancel(sympy.together(function.xreplace({t: 1 / u if point == sympy.oo else point + u})))
    num, den = (sympy.simplify(part.xreplace({u: sympy.S.Zero})) for part in sympy.fraction(local))
    return sympy.oo if den == 0 else sympy.simplify(num / den)


def linear_factors(expression: Any, z: Any) -> tuple[Any, dict[Any, Any]]:
    """The constant, and the exponents of z - c by c, of a product of powers of polynomials."""
    constant = sympy.Integer(1)
    found = dict[Any, Any]()
    for factor in sympy.Mul.make_args(sympy.factor(expression)):
        base, exponent = factor.as_base_exp()
        if not base.has(z):
            constant *= factor
            continue
        polynomial = sympy.Poly(base, z)
        constant *= polynomial.LC() ** exponent
        for root, multiplicity in sympy.roots(polynomial).items():
            found[root] = found.get(root, 0) + multiplicity * exponent
    return constant, found


def _slope(original: Original, t: Any, base: Any, m: int) -> tuple[Any, dict[Any, Any]]:
    """C and the mu_c in (dz/dx)^2 = C prod (z - c)^mu_c, from the same in s, z = s^m."""
    s = sympy.Dummy("s")
    t_of_s = sympy.solve(base - s, t)[0]
    ds_dx_squared = (sympy.diff(base, t) ** 2 * original.slope_squared(t)).xreplace({t: t_of_s})
    constant, exponents = linear_factors(m**2 * s ** (2 * m - 2) * ds_dx_squared, s)
    powers = dict[Any, Any]()
    for root, exponent in exponents.items():
        powers[root**m] = powers.get(root**m, 0) + sympy.sympify(exponent) / m  # m roots s for one z
    return constant, powers


def _spots(
    problem: Problem, powers: Mapping[Any, Any], places: tuple[Any, ...], signs: Signs, *, is_fold: bool
) -> Iterator[Spot]:
    """The singular points, those of the change of variable, and the `places` of the ends, or of the middle and an end."""
    x = sympy.Dummy("x")
    squares: dict[Any, Any] = {}
    ordinary = []
    for place in problem.places:
        if place.degree > 2:
            raise Uncovered(f"the roots of {place.factor} aren't used")
        for c in roots_of(place, x):
            point = sympy.oo if c is None else signs.real(c)
            squares[point] = None
            if place.kind is Kind.ORDINARY:
                squares[point] = sympy.Integer(1)
                ordinary.append(point)
            elif place.kind is Kind.REGULAR:
                square = signs.real(riemann.difference_squared(place).to_sympy(x))
                squares[point] = sympy.expand(square.xreplace({x: point}))
    for point in powers:
        if not any(_is_same(point, other) for other in squares):
            squares[point] = sympy.Integer(1)
    rest = sympy.Integer(4) - sum(powers.values(), sympy.Integer(0))
    for point, square in squares.items():
        mu = rest if point == sympy.oo else powers.get(point, sympy.Integer(0))
        is_at_first, is_at_last = (_is_same(point, place) for place in places)
        sides = () if is_fold or not is_at_first else (0,)
        spot = Spot(point, square, mu, (*sides, 1) if is_at_last else sides, is_fold and is_at_first)
        if point not in ordinary or mu or spot.is_used:
            yield spot


def _is_same(first: Any, second: Any) -> bool:
    """True if two points are one."""
    if sympy.oo in (first, second):
        return bool(first == second)
    return bool(sympy.simplify(first - second) == 0)


def _fold(original: Original, t: Any, base: Any, m: int, question: SpectralProblem) -> Any:
    """The only point inside the domain at which dz/dx vanishes, or None."""
    domain, signs = question.domain, question.signs
    found = original.turning_points(domain, signs)
    if m % 2 == 0 and original.kind in ("x", "sinh"):
        zeros = sympy.solve(sympy.numer(sympy.together(base)), t)
        angles = zeros if original.kind == "x" else map(sympy.asinh, zeros)
        for x in ((angle - original.offset) / original.rate for angle in angles if angle.is_real is not False):
            if x not in found and is_between(x, *domain, signs):
                found.append(x)
    if not found:
        return None
    middle = found[0]
    first, last = domain
    is_symmetric = (first, last) == (-sympy.oo, sympy.oo) or sympy.simplify(first + last - 2 * middle) == 0
    on_y = {wish is None or wish.is_zero for wish in question.boundary.wishes}
    if len(found) > 1 or not is_symmetric or len(on_y) > 1:
        raise Uncovered(f"the domain isn't symmetric about {original.x} = {middle}, and the equation is")
    return middle


def monotonic_range(original: Original, domain: tuple[Any, Any], signs: Signs) -> tuple[Any, Any] | None:
    """The least and the largest value of t on the domain, where t is known to be monotonic there."""
    with suppress(Uncovered):
        if not original.turning_points(domain, signs):
            return range_of(original, domain, signs)
    return None


def range_of(original: Original, half: tuple[Any, Any], signs: Signs) -> tuple[Any, Any]:
    """The least and the largest value of t, where it is monotonic and they are known."""
    if original.kind == "tan":
        return None, None
    angles = [original.theta_at(end, signs) for end in half]
    first, last = angles if original.kind == "x" else map(getattr(sympy, original.kind), angles)
    difference = sympy.simplify(last - first)
    is_increasing = difference.is_positive or last == sympy.oo or first == -sympy.oo
    low, high = (first, last) if is_increasing else (last, first)
    return None if low == -sympy.oo else low, None if high == sympy.oo else high

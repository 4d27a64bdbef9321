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
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import sympy

from kovacic.algebra.ratfunc import RatFunc
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs
from kovacic.engine.places import Kind, Place, Problem, analyse
from kovacic.equation import Equation
from kovacic.limits import Budget
from kovacic.parametric import riemann
from kovacic.parametric.theorems import symmetries
from kovacic.reading.symbolic import written_expression
from kovacic.writing.formula import caret

#: (dt/dtheta)^2 as a function of t, for t a function of theta = k x + c.
SLOPES = {
    "x": lambda t: sympy.Integer(1),
    "exp": lambda t: t**2,
    "sinh": lambda t: 1 + t**2,
    "cosh": lambda t: t**2 - 1,
    "sin": lambda t: 1 - t**2,
    "cos": lambda t: 1 - t**2,
    "tan": lambda t: (1 + t**2) ** 2,
}


class Uncovered(Exception):
    """Why a problem isn't treated, in a sentence."""


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
        kind = t.func.__name__
        if kind not in SLOPES:
            raise Uncovered(f"no formula is known for potentials in {caret(str(t))}")
        theta = sympy.expand(t.args[0])
        return cls(x, kind, theta.coeff(x, 1), theta.coeff(x, 0))

    @property
    def is_circular(self) -> bool:
        """Is t = exp(i theta) with a real theta?"""
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
        if not theta.is_infinite:
            return self._at_angle(theta)
        if self.kind in ("sin", "cos", "tan"):
            raise Uncovered(f"V is periodic: no solution is square integrable at {self.x} = {end}")
        is_zero = self.kind == "exp" and theta == -sympy.oo
        return sympy.Integer(0) if is_zero else sympy.oo

    def _at_angle(self, theta: Any) -> Any:
        """The value of t, the pole of a tangent as oo."""
        if self.kind == "x":
            return theta
        value = sympy.simplify(getattr(sympy, self.kind)(theta))
        return sympy.oo if value.is_infinite else value

    def turning_points(self, domain: tuple[Any, Any], signs: Signs) -> list[Any]:
        """Where dt/dx vanishes inside the domain."""
        if self.kind not in ("cosh", "cos", "sin"):
            return []
        first, last = (self.theta_at(end, signs) for end in domain)
        if self.kind == "cosh":
            angles = [sympy.Integer(0)]
        elif first.is_number and last.is_number:
            angles = _turning_angles(self.kind, first, last)
        else:
            raise Uncovered(f"the ends of the domain aren't multiples of pi/({self.rate})")
        return [(a - self.offset) / self.rate for a in angles if is_between(a, first, last, signs)]


def _turning_angles(kind: str, first: Any, last: Any) -> list[Any]:
    """The angles at which the sine or the cosine is 1 or -1, from below the domain to above it."""
    start = sympy.pi / 2 if kind == "sin" else sympy.Integer(0)
    lowest = sympy.floor(min(first, last) / sympy.pi)
    number = int(sympy.ceiling(abs(last - first) / sympy.pi)) + 2
    return [start + sympy.pi * (lowest + k) for k in range(number)]


@dataclass(frozen=True)
class RealPotential:
    """V as a function of a real t, what t is, and the k of -k y'' + k V y = E y, in which V is shown."""

    V: Any
    original: Original
    t: Any
    kinetic: Any = sympy.S.One


def is_between(value: Any, first: Any, last: Any, signs: Signs) -> bool:
    """Does it lie between the ends, and isn't one of them?"""
    from_first, to_last = (sympy.simplify(difference) for difference in (value - first, last - value))
    if 0 in (from_first, to_last):
        return False
    known = [signs.sign(from_first), signs.sign(to_last)]
    if None not in known:
        return known[0] == known[1]
    raise Uncovered(f"whether {value} lies between {first} and {last} isn't known")


@dataclass(frozen=True)
class Spot:
    """A singular point of v'' = S_z v: where, delta^2 (None: irregular), mu, and which ends of the half domain are there."""

    point: Any
    square: Any
    mu: Any
    roles: tuple[str, ...] = ()

    @property
    def p(self) -> Any:
        """z - c ~ (x - a)^p, for mu < 2."""
        return 2 / (2 - self.mu)

    @property
    def is_fold(self) -> bool:
        """Is it the middle of the domain?"""
        return "fold" in self.roles

    @property
    def end_roles(self) -> list[str]:
        """The roles of the ends of the whole domain that are there."""
        return [role for role in self.roles if role != "fold"]


def end_with_role(domain: tuple[Any, Any], role: str) -> Any:
    """The end of the domain that is at its "left" or "right"."""
    left, right = domain
    return right if role == "right" else left


@dataclass(frozen=True)
class SingularFrame:
    """A coordinate z = s^m with the singular points, and the ends of the domain among them.

    `fold` is the x about which the domain and the equation are symmetric, where z doesn't tell x from its mirror image, and the
    problem is that on the right half; None where z is a coordinate.  `limits_of_t` are the least and the largest value of t
    on this half, each None where it isn't known.
    """

    original: Original
    base: Any
    m: int
    S: Any
    z: Any
    constant: Any
    spots: tuple[Spot, ...]
    domain: tuple[Any, Any]
    fold: Any
    problem: Problem = field(repr=False)
    problem_variable: str = "t"
    limits_of_t: tuple[Any, Any] = (None, None)

    @property
    def x(self) -> Any:
        return self.original.x

    @property
    def is_in_x(self) -> bool:
        """Is z a power of the user's variable?"""
        return self.original.kind == "x" and self.base == sympy.Symbol(self.problem_variable)

    @property
    def ends(self) -> list[Spot]:
        return [spot for spot in self.spots if {"left", "right"} & {*spot.roles}]

    @property
    def is_fuchsian(self) -> bool:
        return all(spot.square is not None for spot in self.spots)

    @property
    def slope(self) -> Any:
        """(dz/dx)^2 as a function of z."""
        return self.constant * sympy.Mul(*((self.z - s.point) ** s.mu for s in self.spots if s.point != sympy.oo))

    @property
    def z_of_x(self) -> Any:
        t = sympy.Symbol(self.problem_variable)
        return (self.base**self.m).xreplace({t: self.original.t})


@dataclass(frozen=True)
class _Coordinate:
    """z = s^m, s = `base`, a Moebius function of t."""

    base: Any
    m: int
    t: Any

    def at(self, t: Any) -> Any:
        """z at a value of t, or oo."""
        num, den = sympy.fraction(sympy.together(self.base))
        if t == sympy.oo:
            return _at_infinity(num, den, self.t) ** self.m
        below = sympy.simplify(den.xreplace({self.t: t}))
        if below == 0:
            return sympy.oo
        return sympy.simplify(num.xreplace({self.t: t}) / below) ** self.m


def _at_infinity(num: Any, den: Any, t: Any) -> Any:
    """The limit of num/den, both polynomials of degree 1 or 0, or oo."""
    top = _degree(num, t)
    bottom = _degree(den, t)
    if top > bottom:
        return sympy.oo
    if top < bottom:
        return sympy.Integer(0)
    return sympy.LC(num, t) / sympy.LC(den, t)


def _degree(polynomial: Any, t: Any) -> int:
    return int(sympy.degree(polynomial, t)) if polynomial.has(t) else 0


def frames(question: SpectralProblem, budget: Budget) -> Iterator[SingularFrame]:
    """The equation as it was read, and in each coordinate that its symmetries give."""
    S = question.parsed.S
    variable = question.parsed.variable
    signs = question.signs
    original = Original.of(question.parsed.equation, question.x, signs)
    problem = analyse(S, budget)
    t = sympy.Symbol(variable)
    yield _frame(question, original, _Coordinate(t, 1, t), problem)
    z = RatFunc(problem.field.poly([0, 1]))
    for coordinate, num, den in symmetries(problem, variable):
        n = coordinate.n
        is_another = n % 2 == 0 or (n == 1 and coordinate.base != variable)
        if not is_another:
            continue
        base = signs.real(written_expression(coordinate.base))
        if not base.has(question.E):
            S_z = (RatFunc(num, den) - Fraction(n * n - 1, 4)) / (n * z) ** 2
            yield _frame(question, original, _Coordinate(base, n, t), analyse(S_z, budget))


def _frame(question: SpectralProblem, original: Original, coordinate: _Coordinate, problem: Problem) -> SingularFrame:
    """The problem v'' = S_z v is in z."""
    domain = question.domain
    signs = question.signs
    constant, powers = _powers(original, coordinate)
    fold = _fold(original, coordinate, domain, signs)
    half = domain if fold is None else (fold, domain[1])
    first, last = (coordinate.at(original.at(end, signs)) for end in half)
    at = {"left": first, "right": last} if fold is None else {"right": last, "fold": first}
    Z = sympy.Dummy("Z")
    S = signs.real(sympy.sympify(problem.S.num.to_sympy(Z) / problem.S.den.to_sympy(Z)))
    return SingularFrame(
        original,
        coordinate.base,
        coordinate.m,
        S=S,
        z=Z,
        constant=constant,
        spots=tuple(_spots(problem, powers, at, signs)),
        domain=domain,
        fold=fold,
        problem=problem,
        problem_variable=question.parsed.variable,
        limits_of_t=range_of(original, half, signs),
    )


def _spots(problem: Problem, powers: Mapping[Any, Any], at: Mapping[str, Any], signs: Signs) -> list[Spot]:
    """The singular points, those of the change of variable, and the ends, `at` which value of Z they are."""
    spots: list[Spot] = []
    rest = sympy.Integer(4) - sum(powers.values(), sympy.Integer(0))
    for place in problem.places:
        for point in _roots(place, signs):
            square = _square(place, point, signs)
            mu = rest if point == sympy.oo else powers.get(point, sympy.Integer(0))
            roles = _roles(point, at)
            if place.kind is not Kind.ORDINARY or mu or roles:
                spots.append(Spot(point, square, mu, roles))
    known = [spot.point for spot in spots]
    for point, mu in powers.items():
        if not any(_same(point, other) for other in known):
            spots.append(Spot(point, sympy.Integer(1), mu, _roles(point, at)))
    return spots


def _roles(point: Any, at: Mapping[str, Any]) -> tuple[str, ...]:
    """Of which ends the point is the value."""
    return tuple(role for role, value in at.items() if _same(value, point))


def range_of(original: Original, half: tuple[Any, Any], signs: Signs) -> tuple[Any, Any]:
    """The least and the largest value of t, where it is monotonic and they are known."""
    if original.kind == "tan":
        return None, None
    if original.kind == "x":
        first, last = half
    else:
        first, last = (_limit(original.kind, original.theta_at(end, signs)) for end in half)
    difference = sympy.simplify(last - first)
    is_increasing = difference.is_positive or last == sympy.oo or first == -sympy.oo
    low, high = (first, last) if is_increasing else (last, first)
    return _unless(low, -sympy.oo), _unless(high, sympy.oo)


def _limit(kind: str, theta: Any) -> Any:
    """The value of exp, sinh, ... at an angle, which may be infinite."""
    function = getattr(sympy, kind)
    if not theta.is_infinite:
        return function(theta)
    u = sympy.Symbol("u")
    return sympy.limit(function(u), u, theta)


def _unless(value: Any, infinite: Any) -> Any:
    """The value, None for the infinite one."""
    return None if value == infinite else value


def _powers(original: Original, coordinate: _Coordinate) -> tuple[Any, dict[Any, Any]]:
    """C and the mu_c in (dz/dx)^2 = C prod (z - c)^mu_c, from the same in s, z = s^m."""
    t = coordinate.t
    m = coordinate.m
    s = sympy.Dummy("s")
    t_of_s = sympy.solve(coordinate.base - s, t)[0]
    ds_dx_squared = (sympy.diff(coordinate.base, t) ** 2 * SLOPES[original.kind](t)).xreplace({t: t_of_s})
    slope = m**2 * s ** (2 * m - 2) * ds_dx_squared
    constant = sympy.Integer(1)
    found = dict[Any, Any]()
    for factor in sympy.Mul.make_args(sympy.factor(slope * original.rate**2)):
        base, exponent = factor.as_base_exp()
        if not base.has(s):
            constant *= factor
            continue
        polynomial = sympy.Poly(base, s)
        constant *= polynomial.LC() ** exponent
        for root, multiplicity in sympy.roots(polynomial).items():
            share = multiplicity * exponent / sympy.Integer(m)  # m roots s for one z
            found[root**m] = found.get(root**m, 0) + share
    return constant, found


def _fold(original: Original, coordinate: _Coordinate, domain: tuple[Any, Any], signs: Signs) -> Any:
    """The only point inside the domain at which dz/dx vanishes; None where there is none."""
    found = original.turning_points(domain, signs)
    if coordinate.m % 2 == 0:
        zeros = _zeros(original, coordinate)
        found += [x for x in zeros if x not in found and is_between(x, *domain, signs)]
    if not found:
        return None
    middle = found[0]
    first, last = domain
    is_symmetric = (first, last) == (-sympy.oo, sympy.oo) or sympy.simplify(first + last - 2 * middle) == 0
    if len(found) > 1 or not is_symmetric:
        raise Uncovered(f"the domain isn't symmetric about {original.x} = {middle}, and the equation is")
    return middle


def _zeros(original: Original, coordinate: _Coordinate) -> list[Any]:
    """Where s vanishes: only points of the real axis count."""
    values = sympy.solve(sympy.numer(sympy.together(coordinate.base)), coordinate.t)
    theta = {"x": lambda v: v, "sinh": sympy.asinh}.get(original.kind)
    if theta is None:
        return []
    return [(theta(v) - original.offset) / original.rate for v in values if v.is_real is not False]


def _same(first: Any, second: Any) -> bool:
    """Are two points one?"""
    if sympy.oo in (first, second):
        return bool(first == second)
    return bool(sympy.simplify(first - second) == 0)


def _square(place: Place, point: Any, signs: Signs) -> Any:
    """delta^2 at one of the points of a place; None where they are irregular."""
    if place.kind is Kind.ORDINARY:
        return sympy.Integer(1)
    if place.kind is not Kind.REGULAR:
        return None
    x = sympy.Dummy("x")
    square = signs.real(riemann.difference_squared(place).to_sympy(x))
    if point == sympy.oo:
        return square
    return sympy.expand(square.xreplace({x: point}))


def _roots(place: Place, signs: Signs) -> list[Any]:
    """oo, or the roots of a factor of degree 1 or 2.  Raises `Uncovered` for others."""
    if place.at_infinity:
        return [sympy.oo]
    if place.degree > 2:
        raise Uncovered(f"the roots of {place.factor} aren't used")
    x = sympy.Dummy("x")
    rest = signs.real(place.factor[0].to_sympy(x))
    if place.degree == 1:
        return [-rest]
    middle = signs.real(place.factor[1].to_sympy(x))
    root = sympy.sqrt(sympy.factor(middle**2 - 4 * rest))
    return [(-middle + sign * root) / 2 for sign in (1, -1)]

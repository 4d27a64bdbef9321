"""The coordinate z(x) in which y'' = (V - E) y is a standard equation, and what the ends of the domain are in it.

The reader has put t = x, exp(k x), sinh(k x), ... ; s = t - c or 1/(t - p) - c and z = s^m follow from the symmetries of the
equation in t.  With (dz/dx)^2 = C prod (z - c)^mu_c and v'' = S_z v, the solutions are y = (dz/dx)^(-1/2) v.  So where v has
the exponents (1 +- delta)/2 at z = c, y has

    (1 +- delta)/2 - mu/4,                                                                                          (1)

and where x is finite at c (mu < 2), z - c ~ (x - a)^p with p = 2/(2 - mu), so that y ~ (x - a)^(1/2 +- nu), nu = p delta/2.
At z = oo the coordinate is 1/z, and the sum of all mu is 4.

An `End` says how many of the solutions are square integrable there [Weyl; see Titchmarsh 1962].  V ~ s u^(-j) in
a local coordinate u of t, (du/dx)^2 ~ u^mu.  At a finite regular end V ~ (nu^2 - 1/4)/(x - a)^2, and both solutions are square
integrable where nu^2 < 1: the limit circle.  Where V -> -oo both oscillate, and both are square
integrable if int |V|^(-1/2) dx is finite, which is mu < j + 2.  Everywhere else one solution at most is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import sympy

from kovacic.bound_states.energies import exact_root, tidied
from kovacic.bound_states.question import Signs, SpectralProblem, Uncovered
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.limits import Budget
from kovacic.numbers.numerals import as_text
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
        S=signs.real(sympy.sympify(problem.S.num.to_sympy(z) / problem.S.den.to_sympy(z), strict=True)),
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
        powers[root**m] = powers.get(root**m, 0) + sympy.sympify(exponent, strict=True) / m  # m roots s for one z
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


#: How far from an end, in theta, the sign of a local coordinate is read off.
_STEP = sympy.Rational(1, 1000)


@dataclass(frozen=True)
class End:
    """One end: where both solutions are square integrable (`circle`, a relation, True or False), and a sentence about it.

    `oscillates` says that V falls without bound there, so that no boundary condition is distinguished; `oscillation` is where
    the solutions oscillate at a regular end, which has the same effect.  `threshold` is where
    the continuous spectrum begins at an infinite end, None if it doesn't.  The end is t = `point`, with
    (du/dx)^2 ~ u^mu for a local coordinate u of this `direction` inside the domain.  It `is_ordinary` where the exponents are
    those at an ordinary point, and `is_regular` where V has a value.
    """

    at: Any
    circle: Any
    sentence: str
    oscillates: bool = False
    oscillation: Any = False
    threshold: Any = None
    is_right: bool = True
    point: Any = sympy.oo
    mu: int = 4
    direction: int = 1
    is_ordinary: bool = False
    is_regular: bool = False


def potential_in_t(question: SpectralProblem, original: Original) -> RealPotential:
    """V as a function of t, which may be complex here."""
    signs = question.signs
    parsed = question.parsed
    equation = parsed.equation
    t = sympy.Symbol(parsed.variable)
    if equation is None or equation.change is None:
        S = signs.real(parsed.S.num.to_sympy(t) / parsed.S.den.to_sympy(t))
        return RealPotential(sympy.cancel(S + question.E), original, t, question.kinetic)
    quotient = equation.c / equation.a
    c = signs.real(quotient.num.to_sympy(t) / quotient.den.to_sympy(t))
    V = sympy.cancel(question.E - original.slope_squared(t) * c)
    return RealPotential(V, original, t, question.kinetic)


def check_inside(real: RealPotential, domain: tuple[Any, Any], signs: Signs) -> None:
    """Raises `InputError` where V has a pole inside the domain, and `Uncovered` where that isn't known."""
    original = real.original
    denominator = sympy.Poly(sympy.denom(real.V), real.t)
    points = real_zeros(denominator, signs)
    if original.kind == "tan" and sympy.degree(sympy.numer(real.V), real.t) > denominator.degree():
        points.append(sympy.oo)
    if not points:
        return
    first, last = (original.theta_at(end, signs) for end in domain)
    angles = [angle for point in points for angle in original.angles_at(point, (first, last))]
    inside = [(a - original.offset) / original.rate for a in angles if is_between(a, first, last, signs)]
    if not inside:
        return
    message = f"V isn't regular at {original.x} = {caret(as_text(inside[0]))}, inside the domain"
    hint = "choose a domain without a pole inside"
    largest = [point for point in inside if all(signs.is_nonnegative(point - other) for other in inside)]
    if not largest:
        raise InputError(message, hint=hint)
    python, shell = domain_as_given(largest[0], domain[1])
    raise InputError(message, hint=f"{hint}: {python}", shell=f"{hint}: {shell}")


def domain_as_given(first: Any, last: Any) -> tuple[str, str]:
    """How a domain is given in Python and at the command line."""
    start = _as_given(first)
    stop = _as_given(last)
    options = f"--from {start}"
    if last != sympy.oo:
        options = f"{options} --to {stop}"
    return f"domain=({start}, {stop})", options


def _as_given(end: Any) -> str:
    """An integer, or anything else as text in quotes."""
    shown = end if end.is_infinite else sympy.simplify(end)
    text = caret(as_text(shown))
    return text if shown.is_Integer else f'"{text}"'


def real_zeros(polynomial: Any, signs: Signs) -> list[Any]:
    """Each once.  Raises `Uncovered` where it isn't known which zeros are real."""
    if all(c.is_Rational for c in polynomial.coeffs()):
        return [*dict.fromkeys(polynomial.real_roots())]
    at_a_real_point = polynomial.as_expr().xreplace({polynomial.gen: sympy.Dummy("t", real=True)})
    if signs.sign(at_a_real_point) is not None:
        return []
    roots = sympy.roots(polynomial)
    if sum(roots.values()) < polynomial.degree() or any(root.is_real is None for root in roots):
        raise Uncovered("whether V has a pole inside the domain isn't known")
    return [root for root in roots if root.is_real]


@dataclass(frozen=True)
class _Place:
    """An end of the domain as a point t = `point` with the local coordinate u: t = point + u, or 1/u.

    `slope` is (du/dx)^2 ~ u^mu, and V ~ strength u^(-pole).  `direction` is the sign of u inside the domain, and
    `distance` the printed distance of x from the end.
    """

    at: Any
    x: Any
    distance: Any
    point: Any
    u: Any
    slope: Any
    mu: int
    pole: int
    strength: Any
    direction: int

    @property
    def where(self) -> str:
        """The end in a sentence."""
        shown = str(self.at) if self.at.is_infinite else caret(as_text(self.at))
        return f"{self.x} -> {shown}"

    @property
    def inside(self) -> Any:
        """The strength for |u|: that of V inside the domain."""
        return self.strength * self.direction ** abs(self.pole)


def end_of(real: RealPotential, domain: tuple[Any, Any], signs: Signs, *, is_right: bool) -> End:
    """An end of the domain."""
    place = _place(real, domain, signs, is_right=is_right)
    if place.at.is_infinite:
        end = _infinite(place, signs, real.kinetic)
    elif place.pole > 2 - place.mu:
        end = _unbounded(place, signs)
    else:
        end = _finite(place, signs)
    return replace(
        end,
        is_right=is_right,
        point=place.point,
        mu=place.mu,
        direction=place.direction,
        is_regular=place.at.is_finite and place.pole <= 0,
    )


def _place(real: RealPotential, domain: tuple[Any, Any], signs: Signs, *, is_right: bool) -> _Place:
    """The end in its local coordinate."""
    original = real.original
    at, other = (domain[1], domain[0]) if is_right else domain
    point = original.at(at, signs)
    u = sympy.Dummy("u")
    t, dt_du_squared = (1 / u, u**-4) if point == sympy.oo else (point + u, sympy.Integer(1))
    slope = sympy.cancel(original.slope_squared(t) / dt_du_squared)
    order, strength = leading(sympy.cancel(real.V.xreplace({real.t: t})), u)
    return _Place(
        at,
        original.x,
        distance=at - original.x if is_right else original.x - at,
        point=point,
        u=u,
        slope=slope,
        mu=leading(slope, u)[0],
        pole=-order,
        strength=strength,
        direction=_side(original, at, other, point, signs),
    )


def leading(function: Any, u: Any) -> tuple[int, Any]:
    """The order at u = 0 and the coefficient; (0, 0) for 0."""
    num, den = sympy.fraction(sympy.together(function))
    if sympy.Poly(num, u).is_zero:
        return 0, sympy.Integer(0)
    (above,), top = sympy.Poly(num, u).terms()[-1]
    (below,), bottom = sympy.Poly(den, u).terms()[-1]
    return above - below, sympy.factor(top / bottom)


def _side(original: Original, at: Any, other: Any, point: Any, signs: Signs) -> int:
    """The sign of the local coordinate of t on the domain, near this end."""
    kind = original.kind
    if kind == "cosh" or (kind == "exp" and point in (0, sympy.oo)):
        return 1  # t > 0, and t > 1 for the hyperbolic cosine
    is_left = at == -sympy.oo or other == sympy.oo or (at != sympy.oo and signs.sign(other - at) == 1)
    if kind in ("x", "exp", "sinh"):  # t grows with theta: u > 0 beside a left end, and at a right one that is infinite
        sign = signs.sign(original.rate)
        if sign is None:
            raise Uncovered(f"the sign of {original.rate} isn't known: assume that it is positive")
        return sign if is_left != at.is_infinite else -sign
    angle = original.theta_at(at, signs)
    if not angle.is_number:
        raise Uncovered(f"the end {at} isn't a multiple of pi/({original.rate})")
    t = getattr(sympy, kind)(angle + (_STEP if is_left else -_STEP))
    u = 1 / t if point == sympy.oo else t - point
    return 1 if u > 0 else -1


def _infinite(place: _Place, signs: Signs, kinetic: Any) -> End:
    """An infinite end, by what V tends to."""
    if place.pole < 0 or place.inside == 0:
        said = f"{place.where}: V -> 0, continuous spectrum from 0"
        return End(place.at, False, said, threshold=sympy.Integer(0))
    if place.pole == 0:
        shown = caret(as_text(sympy.factor(kinetic * place.inside)))
        said = f"{place.where}: V -> {shown}, continuous spectrum from there"
        return End(place.at, False, said, threshold=place.inside)
    return _unbounded(place, signs)


def _unbounded(place: _Place, signs: Signs) -> End:
    """Where V -> oo or V -> -oo; in the second case int |V|^(-1/2) dx may be finite, at a finite end or where V falls fast."""
    at = place.at
    where = place.where
    sign = signs.sign(place.inside)
    is_fast = at.is_finite or place.mu < place.pole + 2
    if sign == 1:
        return End(at, False, f"{where}: V -> oo, one solution decays")
    if not is_fast:
        said = "at most one solution" if sign is None else "V -> -oo, no solution"
        return End(at, False, f"{where}: {said} is square integrable", oscillates=sign == -1)
    if sign == -1:
        said = "V -> -oo so fast that both solutions are square integrable (limit circle)"
        return End(at, True, f"{where}: {said}", oscillates=True)
    said = f"one solution decays where {caret(as_text(place.inside))} > 0"
    return End(at, sympy.Lt(place.inside, 0), f"{where}: {said}", oscillates=True)


def _finite(place: _Place, signs: Signs) -> End:
    """A finite regular end: V ~ (nu^2 - 1/4)/(x - a)^2."""
    at = place.at
    where = place.where
    if place.mu >= 2:
        raise Uncovered(f"the coordinate isn't regular at {where}")
    # u ~ (x - a)^p with p = 2/(2 - mu), so that with (du/dx)^2 ~ C u^mu it is (x - a)^p (C/p^2)^(p/2).
    square = sympy.Rational(1, 4)
    if place.pole == 2 - place.mu:
        _, C = leading(place.slope, place.u)
        square = sympy.factor(sympy.factor(4 * place.strength / (C * (2 - place.mu) ** 2)) + square)
    circle = _less_than_1(square, signs)
    known = signs.holds(circle)
    powers = _powers(place.distance, square)
    if known is False:
        return End(at, False, f"{where}: y ~ {powers}, the smaller one is square integrable")
    if signs.is_nonnegative(square) is False:
        shown = caret(as_text(-sympy.Symbol("c") / place.distance**2))
        said = f"V ~ {shown} with c > 1/4, the solutions oscillate (limit circle)"
        return End(at, True, f"{where}: {said}", oscillates=True)
    said = f"y ~ {powers}, both are square integrable (limit circle)"
    is_ordinary = square == sympy.Rational(1, 4)
    oscillation = False if signs.is_nonnegative(square) else sympy.Lt(square, 0)
    if known:
        return End(at, True, f"{where}: {said}", oscillation=oscillation, is_ordinary=is_ordinary)
    condition = tidied([circle], signs)[0]
    relation = f"{caret(as_text(condition.lhs))} {condition.rel_op} {caret(as_text(condition.rhs))}"
    return End(at, circle, f"{where}: {said} where {relation}", oscillation=oscillation)


def _less_than_1(square: Any, signs: Signs) -> Any:
    """square < 1, for nu where that is no radical and has a sign."""
    root = exact_root(square)
    is_of_square = square.is_number or root is None or signs.holds(sympy.Lt(square, 1)) is not None
    if is_of_square:
        return sympy.Lt(square, 1)
    sign = signs.sign(root)
    size = sympy.Abs(root) if sign is None else sign * root
    return tidied([sympy.Lt(size, 1)], signs)[0]


def _powers(distance: Any, square: Any) -> str:
    """How the two solutions behave at a distance from an end where the exponents are 1/2 +- nu."""
    shown = caret(as_text(distance))
    if square == sympy.Rational(1, 4):
        return f"{shown} or 1"
    root = exact_root(square)
    nu = sympy.sqrt(square) if root is None else root
    larger, smaller = (sympy.factor(sympy.expand(sympy.Rational(1, 2) + s * nu)) for s in (1, -1))
    first = caret(as_text(distance**larger))
    second = caret(as_text(distance**smaller))
    if square == 0:
        return f"{first} or {second}*log({shown})"
    return f"{first} or {second}"

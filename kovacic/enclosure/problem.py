"""What is to be evaluated: the equation den y'' = num y with integer coefficients, rigorous enclosures of its singular points,
the gauge of the user's equation, and a decision where there is one.

Symbols: S = num/den; zeta_i the zeros of den (the singular points), eta_j the zeros of num.  The zeros are enclosed by
FLINT's certified isolation (`fmpz_poly.complex_roots`: pairwise disjoint rectangles, one zero in each) and refined when a
distance cannot be told from zero.  Whether a path meets a singular point is decided exactly, by Sturm-free real root
isolation of the common factor of two polynomials over Q.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations
from typing import Literal

from flint import acb, acb_poly, arb, fmpq_poly, fmpz_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ, RationalPoly, to_fraction
from kovacic.decision import Decision
from kovacic.enclosure.constants import Number, as_number
from kovacic.enclosure.embedded import Embedded
from kovacic.enclosure.points import Point, midpoint, to_acb, working_precision
from kovacic.errors import InputError
from kovacic.limits import check_duration
from kovacic.reading.given import EULER, PI, Equation, parameters_of

_ISOLATION = 4e-6  # seconds that it takes to isolate the zeros of a polynomial, over the square of its degree
_SHARP = 40  # relative bits to which the distances of singular points are known
_SHORT = 10**9  # the largest denominator of a singular point that messages name exactly
_EXACT = 400  # bits from which on it is worth while to decide exactly whether a point is singular
Zeros = tuple[tuple[acb, int], ...]  # zeros with their multiplicities
Which = Literal["num", "den"]


@dataclass(frozen=True)
class System:
    """den y'' = num y: integer coefficients, low to high, without a common factor, den not zero.

    With a `radius` these are approximations, and the coefficients of the exact equation differ by at most so much from them;
    `imaginary` are the imaginary parts of both then, where there are any.

    >>> System.make((2, 0), (0, 0, 4))   # S = 2/(4 x^2)
    System(num=(1,), den=(0, 0, 2), radius=0, imaginary=None)
    """

    num: tuple[int, ...]
    den: tuple[int, ...]
    radius: int = 0
    imaginary: tuple[tuple[int, ...], tuple[int, ...]] | None = None

    @classmethod
    def make(cls, num: tuple[int, ...], den: tuple[int, ...]) -> System:
        """The system in lowest terms; raises InputError if den is zero."""
        p, q = fmpz_poly(list(num)), fmpz_poly(list(den))
        if q == 0:
            raise InputError("the denominator of S is zero")
        g = p.gcd(q) * (-1 if q.leading_coefficient() < 0 else 1)
        num, den = (tuple(int(c) for c in (part // g).coeffs()) for part in (p, q))
        return cls(num, den)

    @classmethod
    def of(cls, function: RatFunc) -> System:
        """A rational function over Q, as num/den; raises InputError over another field."""
        num, den = function.num, function.den
        if not isinstance(num, RationalPoly) or not isinstance(den, RationalPoly):
            raise InputError(
                "numerical evaluation needs S with rational coefficients (no parameters, no algebraic constants)"
            )
        p, q = num.rep, den.rep
        whole = (p.numer() * q.denom(), q.numer() * p.denom())
        return cls.make(*(tuple(int(c) for c in part.coeffs()) for part in whole))

    def polynomial(self, which: Which) -> acb_poly:
        """Numerator or denominator, at the working precision in force."""
        re = acb_poly(list(getattr(self, which)))
        return re if self.imaginary is None else re + acb_poly(list(self.imaginary[which == "den"])) * acb(0, 1)

    def along(self, which: Which, a: Point, step: Point) -> tuple[fmpq_poly, fmpq_poly]:
        """Real and imaginary part of numerator or denominator at a + t step, as polynomials in t over Q."""
        real, imag = _along(getattr(self, which), a, step)
        if self.imaginary is None:
            return real, imag
        first, second = _along(self.imaginary[which == "den"], a, step)
        return real - second, imag + first

    def roots(self, which: Which, prec: int) -> Zeros:
        """Enclosures of the zeros of numerator or denominator at about `prec` bits, with multiplicities.

        Where coefficients aren't real, multiplicities may be too large, and zeros of the conjugate polynomial among them.
        """
        prec = max(64, 1 << (prec - 1).bit_length())
        if self.imaginary is None:
            return _isolated(getattr(self, which), prec)
        re, im = fmpz_poly(list(getattr(self, which))), fmpz_poly(list(self.imaginary[which == "den"]))
        found = _isolated(tuple(int(c) for c in (re * re + im * im).coeffs()), prec)
        with working_precision(prec):
            return tuple((z, k) for z, k in found if self.polynomial(which)(z).contains(0))

    def singular_points(self, prec: int) -> list[Point]:
        """The midpoints of the enclosures of the singular points; on the real axis exactly where the singular point is."""
        return [midpoint(root) for root, _ in self.roots("den", prec)]

    def is_singular(self, point: Point) -> bool:
        """True if the point is a zero of the denominator, decided exactly."""
        if point.is_real() and self.imaginary is None:
            return bool(fmpz_poly(list(self.den))(point.x) == 0)
        return all(part == 0 for part in self.along("den", point, Point(0)))


@dataclass(frozen=True, eq=False)
class NumericProblem:
    """y'' = S y as `system`; S and the decision on it where the problem was read from a solution.

    `gauge` is g'/g = -b/(2a) where the user's equation is a z'' + b z' + c z = 0 with z = g y; None for a normal form.
    `right` is that equation where its right-hand side isn't zero.  `embedded` has S and the gauge where their constants are
    known by balls only: `system` is an approximation then, S and gauge are None.
    """

    system: System
    S: RatFunc | None = None
    decision: Decision | None = None
    gauge: RatFunc | None = None
    right: Equation | None = None
    embedded: Embedded | None = None

    @cached_property
    def is_real(self) -> bool:
        """Are the coefficients real, and the right-hand side at real points where it is analytic?"""
        given = self.right
        if given is not None and given.h is not None and any(node.is_imaginary for node in given.h.atoms()):
            return False
        if self.embedded is None:
            return True
        with working_precision(_SHARP):
            return self.embedded.is_real(() if given is None else (given.f / given.a, 1 / given.a))

    @property
    def is_exact(self) -> bool:
        """True unless a parameter's value is a ball."""
        return self.embedded is None or self.embedded.exact

    @cached_property
    def gauge_poles(self) -> System:
        """The poles of the gauge where S is regular: singular points of the user's equation."""
        if self.gauge is None:
            return System((), (1,))
        den, own = (fmpz_poly(list(part)) for part in (System.of(self.gauge).den, self.system.den))
        while (common := den.gcd(own)).degree() > 0:
            den //= common
        return System((), tuple(int(c) for c in den.coeffs()))

    @cached_property
    def equation(self) -> tuple[fmpq_poly, fmpq_poly, fmpq_poly]:
        """The user's equation: with the gauge gamma, z'' - 2 gamma z' + (gamma^2 - gamma' - S) z = 0."""
        num, den = (fmpq_poly(list(part)) for part in (self.system.num, self.system.den))
        if self.gauge is None:
            return den, fmpq_poly([]), -num
        gamma, square = self.gauge, self.gauge * self.gauge - self.gauge.derivative()
        parts = [part for function in (gamma, square) for part in (function.num, function.den)]
        p, q, r, s = (part.rep for part in parts if isinstance(part, RationalPoly))
        common = den
        for other in (q, s):
            common = common * other // common.gcd(other)
        return common, -2 * p * (common // q), r * (common // s) - num * (common // den)

    def at(self, prec: int) -> NumericProblem:
        """With the constants to this precision."""
        if self.embedded is None:
            return self
        return replace(self, system=System(*self.embedded.coefficients(prec)))

    def poles(self, prec: int) -> Zeros:
        """Enclosures of the poles of S at about `prec` bits, with their multiplicities."""
        if self.embedded is None:
            return self.system.roots("den", prec)
        with working_precision(2 * prec):
            return tuple(self.embedded.poles())

    def polynomials(self) -> tuple[acb_poly, acb_poly]:
        """Numerator and denominator of S, at the working precision in force."""
        if self.embedded is not None:
            return self.embedded.polynomials()
        return self.system.polynomial("num"), self.system.polynomial("den")

    def singular_points(self, prec: int) -> list[Point]:
        """Those of the system and the poles of the gauge, as `System.singular_points` gives them."""
        return [*self.system.singular_points(prec), *self.gauge_poles.singular_points(prec)]


def as_problem(
    equation: object, params: Mapping[str, object] | None = None, *, forced: bool = False, constants: bool = False
) -> NumericProblem:
    """The numerical problem that `equation` stands for, with these values of its parameters; see
    `kovacic.enclosure.evaluate.evaluate` for what is accepted.  Only with `forced` may it have a right-hand side, and only
    with `constants` coefficients that aren't rational."""
    if isinstance(equation, NumericProblem):
        return equation
    if isinstance(equation, System):
        return NumericProblem(equation)
    if params is None and isinstance(equation, str):
        found = _of_text(equation)
    else:
        kept = None if params is not None else getattr(equation, "numeric", None)
        found = kept or read_problem(equation, params)
    if found.right is not None and not forced:
        raise InputError("an equation without a right-hand side is needed here")
    if found.embedded is not None and not constants:
        raise InputError("numerical evaluation needs S with rational coefficients here, and values such as '1/3'")
    return found


@lru_cache(maxsize=64)
def _of_text(equation: str) -> NumericProblem:
    return read_problem(equation)


def read_problem(equation: object, params: Mapping[str, object] | None = None) -> NumericProblem:
    """As `as_problem`, whatever its coefficients and its right-hand side are."""
    decision = getattr(equation, "decision", None)  # a `Solution`, which has an S and perhaps an equation
    found = equation
    if not isinstance(decision, Decision):
        from kovacic.reading.read import read_input

        decision, found = None, read_input(equation)
    S, given = found.S, found.equation  # type: ignore[attr-defined]
    gauge = None if given is None else given.gauge or None
    names = parameters_of(S.field) if given is None else parameters_of((given.a + given.b + given.c).field)
    if given is not None and given.change is not None:
        raise InputError(f"numerical evaluation needs coefficients that are rational in {given.change.variable}")
    right = None if given is None or given.is_homogeneous else given
    if right is not None and right.h is not None:
        names = tuple(sorted({*names, *(symbol.name for symbol in right.h.free_symbols)} - {right.variable}))
    numbers = _values(names, params or {}) if params is not None or names else {}
    values = {name: value.re for name, value in numbers.items() if isinstance(value, Point) and value.is_real()}
    extended = [f for f in (S, gauge, right and right.f) if f is not None and isinstance(f.field, AlgebraicField)]
    if extended or len(values) < len(numbers):
        return NumericProblem(System((), (1,)), right=right, embedded=Embedded(S, gauge, numbers)).at(_SHARP)
    if numbers:
        decision, S = None, _specialised(S, values)  # the decision is that for generic values
        gauge = gauge and _specialised(gauge, values)
        if right is not None:
            parts = {name: _specialised(getattr(right, name), values) for name in "abcf"}
            at = {name: str(value) for name, value in values.items()}
            right = replace(right, **parts, h=right.h and right.h.subs(at))
    return NumericProblem(System.of(S), S, decision, gauge, right)


def _values(names: tuple[str, ...], params: Mapping[str, object]) -> dict[str, Number]:
    """The values of the parameters; raises InputError unless there is one for each.  pi and e have theirs."""
    own = {name: text for name, text in ((PI, "pi"), (EULER, "exp(1)")) if name in names}
    given = {str(name): as_number(value, f"the parameter {name}") for name, value in (own | dict(params)).items()}
    if set(given) != set(names):
        wanted = ", ".join(names) or "no parameter"
        raise InputError(
            f"values are needed for {wanted}; given are {', '.join(given) or 'none'}",
            hint="params={'n': 3}, for instance",
        )
    return given


def _specialised(function: RatFunc, values: dict[str, Fraction]) -> RatFunc:
    """A rational function at these values of its parameters."""
    parts = [part for part in (function.num, function.den) if isinstance(part, FunctionPoly)]
    try:
        return (
            RatFunc(*(p.value_at([values[name] for name in p.field.names], QQ) for p in parts)) if parts else function
        )
    except ZeroDivisionError:
        raise InputError("the equation isn't defined at these values of the parameters") from None


@lru_cache(maxsize=64)
def _isolated(coefficients: tuple[int, ...], prec: int) -> Zeros:
    poly = fmpz_poly(list(coefficients))
    check_duration(
        _ISOLATION * poly.degree() ** 2, f"the isolation of the zeros of a polynomial of degree {poly.degree()}"
    )
    with working_precision(prec):
        return tuple((root, int(k)) for root, k in poly.complex_roots()) if poly.degree() > 0 else ()


def _along(coefficients: tuple[int, ...], a: Point, step: Point) -> tuple[fmpq_poly, fmpq_poly]:
    lines = fmpq_poly([a.x, step.x]), fmpq_poly([a.y, step.y])
    if lines[1] == 0:
        return fmpq_poly(list(coefficients))(lines[0]), fmpq_poly([])
    real, imag = fmpq_poly([]), fmpq_poly([])
    for c in reversed(coefficients):
        real, imag = real * lines[0] - imag * lines[1] + c, real * lines[1] + imag * lines[0]
    return real, imag


def offsets(system: System, centre: Point) -> Zeros:
    """The singular points seen from `centre` (point - centre), to 40 relative bits at least, with their multiplicities.

    Raises InputError if the centre is one of them.
    """
    prec = 64 + min(max(int(part.height_bits()) for part in (centre.x, centre.y)), 1 << 14)
    while True:
        with working_precision(max(128, prec)):
            here = to_acb(centre)
            found = tuple((root - here, k) for root, k in system.roots("den", prec))
        if all(d.rel_accuracy_bits() >= _SHARP for d, _ in found):
            return found
        if prec > _EXACT and system.is_singular(centre):
            raise InputError(f"the point {centre} is a singular point of the equation")
        prec *= 2


def distance_lower(system: System, centre: Point) -> arb | None:
    """A proven lower bound, positive and exact, of the distance to the nearest singular point; None if there is none."""
    with working_precision(64):
        return min((d.abs_lower() for d, _ in offsets(system, centre)), default=None)


def is_apart(system: System, *points: Point) -> bool:
    """Is it certain that no singular point lies in the convex hull of these?  In some direction each is beyond all of them."""
    with working_precision(128):
        left = [root for root, _ in system.roots("den", 128)]
        for a, b in combinations(points, 2):
            for x, y in ((b.x - a.x, b.y - a.y), (a.y - b.y, b.x - a.x)):
                reach = [x * p.x + y * p.y for p in points]
                low, high, along, across = map(arb, (min(reach), max(reach), x, y))
                left = [z for z in left if not (low > (s := along * z.real + across * z.imag) or s > high)]
    return not left and not system.radius


def check_segment(system: System, a: Point, b: Point) -> None:
    """Raise InputError if the closed segment from a to b contains a singular point, with that point and the distances.

    Exact: with z = x or, on a vertical line, z = iy for its points, den(z + ...) = A + i B with A, B in Q[x] or Q[y]; the line
    is singular where gcd(A, B), on the real axis the denominator itself, has a real zero.
    """
    for name, point in (("start", a), ("end", b)):
        if system.is_singular(point):
            raise InputError(
                f"the {name} {point} of the path is a singular point of the equation (distance 0)",
                hint="choose a point beside it; the solutions aren't analytic there",
            )
    if a == b or is_apart(system, a, b):
        return
    step = b - a
    first, length = (a.x, step.x) if step.x != 0 else (a.y, step.y)
    unit = step.scaled(1 / length)
    real, imaginary = system.along("den", a - unit.scaled(first), unit)
    poly, prec = real.gcd(imaginary).numer(), 128
    while poly.degree() > 0:
        roots = _isolated(tuple(int(c) for c in poly.coeffs()), prec)
        with working_precision(prec):
            inside = [(z.real - first) / length for z, _ in roots if z.imag.is_zero()]
            inside = [t for t in inside if not (t < 0 or t > 1)]
            if not inside:
                return
            t = min(inside, key=lambda t: float(t.mid()))
            if not (t.contains(0) or t.contains(1)):  # the ends were excluded exactly: else refine
                distance = float(t.mid()) * math.sqrt(to_fraction(step.norm_squared()))
                raise InputError(
                    f"the path from {a} to {b} runs through the singular point {name_of(system, to_acb(a) + to_acb(step) * t)} "
                    f"(distance 0; {distance:.6g} from the start)",
                    hint="go around it through the complex plane, e.g. path=[...] with a vertex off the axis; "
                    "the result depends on the side",
                )
        prec *= 2


def name_of(system: System, point: acb) -> str:
    """The singular point in this ball, in words: its exact value where that is a short Gaussian rational, else 12 digits."""
    middle = midpoint(point)
    guess = Point(*(part.limit_denominator(_SHORT) for part in (middle.re, middle.im)))
    if point.overlaps(to_acb(guess)) and system.is_singular(guess):
        return str(guess)
    re, im = (part.mid().str(12, radius=False) + "..." for part in (point.real, point.imag))
    return re if point.imag.contains(0) else f"{re} + {im}i"

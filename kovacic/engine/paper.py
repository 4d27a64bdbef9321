"""Kovacic's own steps 1 to 3, for reading beside the paper: the sets of exponents, the families, theta, and P.

The engine doesn't search in this way, for there are up to (m+1)^(n+1) families for n poles; `explain` does, within limits,
so that every line of the paper can be compared.  With r = S, and m = 1, 2, 4, 6 or 12 for the degree of omega:

- step 1: at a pole c the singular part [sqrt r]_c and alpha_c^+-, or the set E_c; the same at infinity;
- step 2: the families for which d = alpha_inf - sum alpha_c, or m/12 (e_inf - sum e_c), m/4 (...) for m = 2, is a natural
  number; for m = 2 one of the e is odd;
- step 3: theta, and a polynomial P of degree d such that P exp(int theta) is a product of m solutions: L_(m+1) = 0 for

      L_0 = P,  L_1 = P' + theta P,  L_(k+1) = L_k' + theta L_k - k (m-k+1) r L_(k-1).

  That is the paper's equation of second order for P (m = 1), its equation of third order (m = 2), and the recursion of
  section 5.1 with P_(m-k) = (-1)^(k+1) D^k L_k, D the product of the x - c.

Numbers lie in the field K of the coefficients of r (algebraic numbers, parameters with generic values), or in one that square
roots are adjoined to.  Poles of degree 1 or 2 over K are taken one by one; where more are conjugate, only families in which
these have equal exponents are tried.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), sections 3.1, 4.1 and 5.1.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import factorial, prod
from string import ascii_letters
from typing import Any

from sympy import Add, Integer, Symbol, expand, symbols, sympify

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import numerators
from kovacic.equation import parameters_of
from kovacic.limits import check_time

_MOST_FAMILIES = 4096
_FEW_FAMILIES = 8
_MOST_POINTS = 24
_HIGHEST_ORDER = 40
#: Of the coefficients of r, and of all numbers.
_HIGHEST_DEGREE, _MOST_ROOTS = 6, 256
#: Multiplications of coefficients.
_MOST_WORK = 1_000_000
#: d = scale * (value at infinity - sum of the values at the poles), and theta has the residues scale * value.
SCALE = {1: Fraction(1), 2: Fraction(1, 2), 4: Fraction(1, 3), 6: Fraction(1, 2), 12: Fraction(1)}

Number = int | Fraction | Poly


@dataclass(frozen=True)
class Point:
    """A pole c (`at`), infinity (`at` is None), or `count` conjugate poles that are taken together (None, too)."""

    place: Place
    at: Poly | None = None
    count: int = 1


@dataclass(frozen=True)
class Choice:
    """alpha_c or e_c, and +-[sqrt r]_c as pairs (power of x - c, or of x at infinity; coefficient)."""

    value: Number
    singular: tuple[tuple[int, Poly], ...] = ()


@dataclass(frozen=True)
class Family:
    """One choice at every point, infinity first; if d is natural and the family was tried, theta and P, None without one.

    `theta` is a SymPy expression, and so are the `conditions` in the `unknowns` a_0, ..., a_(d-1) that would have to vanish
    for P = x^d + ... (d <= 3).
    """

    choices: tuple[Choice, ...]
    d: Number
    theta: Any = None
    P: Poly | None = None
    conditions: tuple[Any, ...] = ()
    unknowns: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Search:
    """What steps 1 to 3 give for one degree m of omega.

    `total` is the number of families, `natural` that of those with a natural d (None where there are too many sums).
    `families` are the ones with a natural d, in the order of the paper, or all of them, if they are few; None where they are
    too many.
    """

    m: int
    points: tuple[Point, ...]
    choices: tuple[tuple[Choice, ...], ...]
    total: int
    natural: int | None
    families: tuple[Family, ...] | None

    @property
    def complete(self) -> bool:
        """Were all families of the paper enumerated, every pole on its own?"""
        return self.families is not None and all(point.count == 1 for point in self.points)


class _Roots:
    """The field of all numbers that occur, to which square roots are adjoined when they are asked for."""

    def __init__(self, field: Field) -> None:
        self.field = field

    def root(self, square: Poly) -> Poly | None:
        """None where the field would become too large."""
        found = self.field.sqrt(square.over(self.field))
        if found is None and self.field.absolute_degree < _MOST_ROOTS:
            outer, inner = square.square_part() if isinstance(square, FunctionPoly) else (1, square)
            radicand = -inner.over(self.field)
            self.field = AlgebraicField(self.field, self.field.poly([radicand, 0, 1]), f"sqrt({inner})")
            found = self.field.generator * outer
        return found


def search(problem: Problem, variable: str, m: int) -> Search | None:
    """Steps 1 to 3 for omega of degree m; of many families they try those up to the first that succeeds.

    None outside the domain: exponents that are no square roots of constants, constants of a high degree, poles of a high
    order.
    """
    places, roots = problem.places, _Roots(problem.field)
    if max(place.order for place in places) > _HIGHEST_ORDER or problem.field.absolute_degree > _HIGHEST_DEGREE:
        return None
    points = [Point(places[-1]), *(point for place in places[:-1] for point in _points(place, roots))]
    options = [_choices(point, m, roots) for point in points]
    choices = [chosen for chosen in options if chosen is not None]
    if len(choices) < len(points):
        return None
    total = prod(len(chosen) ** point.count for chosen, point in zip(choices, points, strict=True))
    families, count, signs = None, None, [1, *(-point.count for point in points[1:])]
    zero: Number = roots.field.poly([]) if m == 1 else 0
    if prod(map(len, choices)) <= _MOST_FAMILIES:
        sums: list[tuple[tuple[Choice, ...], Number]] = [((), zero)]
        for sign, chosen in zip(signs, choices, strict=True):
            check_time()
            parts = [(choice, zero + SCALE[m] * sign * choice.value) for choice in chosen]
            sums = [((*family, choice), d + part) for family, d in sums for choice, part in parts]
        every = [Family(family, d) for family, d in sums]
        natural = [f for f in every if is_natural(f.d) and (m != 2 or any(c.value % 2 for c in f.choices))]
        tried = _tried(natural, points, m, problem, roots.field, Symbol(variable))
        shown = every if m == 1 and total <= _FEW_FAMILIES else natural
        families, count = tuple(tried.get(id(family), family) for family in shown), len(natural)
    if count is None or any(point.count > 1 for point in points):
        count = _naturals(choices, points, m)
    return Search(m, tuple(points), tuple(choices), total, count, families)


def is_natural(d: Number) -> bool:
    """Is it 0, 1, 2, ...?"""
    value = d.field.rational_value(d) if isinstance(d, Poly) else Fraction(d)
    return value is not None and value >= 0 and value.denominator == 1


def in_sympy(value: Any, x: Any) -> Any:
    """A number, or a polynomial in x, as a SymPy expression."""
    return expand(value.to_sympy(x)) if isinstance(value, Poly) else sympify(value, strict=True)


def _points(place: Place, roots: _Roots) -> list[Point]:
    p = place.factor
    if place.degree == 1:
        return [Point(place, -p[0])]
    half = roots.root(p[1] * p[1] / 4 - p[0]) if place.degree == 2 and place.order <= 2 else None
    return [Point(place, None, place.degree)] if half is None else [Point(place, s * half - p[1] / 2) for s in (-1, 1)]


def _naturals(choices: Sequence[Sequence[Choice]], points: Sequence[Point], m: int) -> int | None:
    """How many families have a natural d, conjugate poles counted one by one; None for many poles."""
    if len(points) > _MOST_POINTS:
        return None
    sums: Counter[tuple[Number, bool]] = Counter({(0, m == 2): 1})
    for point, chosen in zip(points, choices, strict=True):
        sign = SCALE[m] * (1 if point.place.at_infinity else -1)
        parts = [(sign * choice.value, m == 2 and choice.value % 2 == 0) for choice in chosen]
        for _ in range(point.count):
            following: Counter[tuple[Number, bool]] = Counter()
            for (value, even), count in sums.items():
                for part, also_even in parts:
                    following[value + part, even and also_even] += count
            sums = following
            if len(sums) > _MOST_FAMILIES:
                return None
    return sum(count for (value, even), count in sums.items() if is_natural(value) and not even)


def _choices(point: Point, m: int, roots: _Roots) -> tuple[Choice, ...] | None:
    """Step 1; None where the exponents aren't square roots of constants."""
    place, centre = point.place, 2 if m == 2 else 6
    if place.kind is Kind.ORDINARY or (place.at_infinity and place.order == 1):
        return tuple(map(Choice, (0, 1) if m == 1 else (0, 2, 4) if m == 2 else range(13)))
    if place.order > 2:
        if m == 2:
            return (Choice(4 - place.order if place.at_infinity else place.order),)
        return _irregular(place, roots) if m == 1 and place.degree == 1 and place.order % 2 == 0 else None
    if place.order == 1:
        return (Choice(1 if m == 1 else 2 * centre),)
    if m == 1:
        delta = None if place.delta_squared is None else roots.root(place.delta_squared)
        return None if delta is None else tuple(Choice((1 + s * delta) / 2) for s in ((1, -1) if delta else (1,)))
    values = {centre + Fraction(2 * centre * k, m) * (place.delta or 0) for k in range(-m // 2, m // 2 + 1)}
    return tuple(Choice(int(value)) for value in sorted(values) if value.denominator == 1)


def _irregular(place: Place, roots: _Roots) -> tuple[Choice, ...] | None:
    """(c3) and (inf3) of section 3.1: r = s t^(-2 nu) w^2, w = 1 + ..., so [sqrt r] begins with a = sqrt s, and
    b/a = 2 a w_k for the first term w_k that isn't in [sqrt r].
    """
    nu, sign = (place.order // 2, 1) if not place.at_infinity else (place.order // 2 - 2, -1)
    count = place.order // 2  # of the terms up to w_k
    shift = place.num.field.poly([0, 2]) - place.factor
    top, bottom = place.num(shift), place.den(shift)
    u, w = list[Poly](), [place.num.field.poly([1])]
    zero = place.num.field.poly([])
    for k in range(count):
        known = sum((bottom[place.order + i] * u[k - i] for i in range(1, k + 1)), zero)
        u.append((top[k] - known) / bottom[place.order])
        if k:
            w.append((u[k] / u[0] - sum((w[i] * w[k - i] for i in range(1, k)), zero)) / 2)
    if (a := roots.root(u[0])) is None:
        return None
    terms = tuple((sign * (k - nu), a * w[k]) for k in range(count - 1))
    last = 2 * a * w[-1]
    return tuple(Choice((s * last + sign * nu) / 2, tuple((power, s * c) for power, c in terms if c)) for s in (1, -1))


def _tried(
    families: Sequence[Family], points: Sequence[Point], m: int, problem: Problem, field: Field, x: Any
) -> dict[int, Family]:
    """Step 3: the families that were tried, by their ids: all of few, else those up to the first success."""
    tried, work, degree = dict[int, Family](), 0, problem.D.degree
    D, T, X = problem.D.over(field), problem.T.over(field), field.poly([0, 1])
    factors = [X - point.at if point.at is not None else point.place.factor.over(field) for point in points[1:]]
    for family in families:
        d = int(in_sympy(family.d, x))
        work += (d + 1) * m * (m * degree + d) * (degree + 1) * field.absolute_degree**2
        if work > _MOST_WORK:
            break
        R, theta = field.poly([]), []
        for choice, f in zip(family.choices[1:], factors, strict=True):
            value = SCALE[m] * choice.value
            R += D // f * f.derivative() * value
            theta.append(in_sympy(value, x) * (in_sympy(f.derivative(), x) / in_sympy(f, x)))
            for power, c in choice.singular:
                R += D // f**-power * c
                theta.append(in_sympy(c, x) * in_sympy(f, x) ** power)
        for power, c in family.choices[0].singular:
            R += D * X**power * c
            theta.append(in_sympy(c, x) * x**power)
        images = [numerators(D, T, R, X**k, m, m + 1)[-1] * factorial(m + 1) for k in range(d + 1)]  # D^(m+1) L_(m+1)
        P = _null_vector(images)
        unknowns, conditions = ((), ()) if P is not None or d > 3 else _conditions(images, parameters_of(field))
        tried[id(family)] = replace(family, theta=Add(*theta), P=P, conditions=conditions, unknowns=unknowns)
        if P is not None and len(families) > _FEW_FAMILIES:
            break
    return tried


def _null_vector(images: Sequence[Poly]) -> Poly | None:
    """The monic polynomial P of the highest degree whose image is zero, those of 1, x, x^2, ... being given."""
    found, reduced, x = None, dict[int, tuple[Poly, Poly]](), images[0].field.poly([0, 1])
    for k, image in enumerate(images):
        P = x**k
        while image and image.degree in reduced:
            other, Q = reduced[image.degree]
            factor = image.lc / other.lc
            image, P = image - other * factor, P - Q * factor
        if image:
            reduced[image.degree] = image, P
        else:
            found = P
    return found


def _conditions(images: Sequence[Poly], parameters: Sequence[str]) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """The lower coefficients of P, of a low degree, and what would have to vanish."""
    letter = next(c for c in ascii_letters if not any(name[0] == c for name in parameters))
    unknowns = symbols(f"{letter}:{len(images) - 1}")
    x, rows = Symbol("x"), range(1 + max(image.degree for image in images))
    terms = (zip((image[i] for image in images), (*unknowns, Integer(1)), strict=True) for i in rows)
    found = [expand(Add(*(in_sympy(c, x) * a for c, a in row))) for row in terms]
    return unknowns, tuple(dict.fromkeys(e.primitive()[1] if e.is_Add else e for e in found if e))

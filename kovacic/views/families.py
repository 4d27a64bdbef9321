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

The coefficients of r may be algebraic numbers and parameters, which have generic values.  Poles of degree 1 or 2 over their
field K are taken one by one, with exact square roots; where more are conjugate, only families in which these have equal
exponents are tried.  No family is tried where its numbers have square roots of two different functions of parameters.

Reference: J. Kovacic, J. Symb. Comp. 2 (1986), sections 3.1, 4.1 and 5.1.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from math import prod
from string import ascii_letters
from typing import Any

from sympy import Add, Dummy, Integer, Mul, Rational, Symbol, expand, oo, symbols
from sympy.polys.domains import EX
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import ring

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Kind, Place
from kovacic.reading.given import parameters_of
from kovacic.views.numbers import domain, number, root, settled

_MOST_FAMILIES = 4096
_FEW_FAMILIES = 8
_MOST_POINTS = 24
_HIGHEST_ORDER = 40
_HIGHEST_DEGREE = 6
#: Multiplications of coefficients.
_MOST_WORK = 200_000
#: d = scale * (value at infinity - sum of the values at the poles), and theta has the residues scale * value.
SCALE = {1: Rational(1), 2: Rational(1, 2), 4: Rational(1, 3), 6: Rational(1, 2), 12: Rational(1)}


@dataclass(frozen=True)
class Point:
    """A pole c (`at`), infinity, or `count` conjugate poles that are taken together (`at` is None)."""

    place: Place
    at: Any
    count: int = 1


@dataclass(frozen=True)
class Choice:
    """alpha_c or e_c, and +-[sqrt r]_c as pairs (power of x - c, or of x at infinity; coefficient)."""

    value: Any
    singular: tuple[tuple[int, Any], ...] = ()


@dataclass(frozen=True)
class Family:
    """One choice at every point, infinity first; if d is natural and the family was tried, theta and P, None without one.

    `conditions` are expressions in the `unknowns` a_0, ..., a_(d-1) that would have to vanish for P = x^d + ... (d <= 3).
    """

    choices: tuple[Choice, ...]
    d: Any
    theta: Any = None
    P: Any = None
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


def search(S: RatFunc, places: Sequence[Place], variable: str, m: int) -> Search | None:
    """Steps 1 to 3 for omega of degree m; of many families they try those up to the first that succeeds.

    `places` end with infinity.  None outside the domain: exponents that are no square roots of constants, constants of a
    high degree, poles of a high order.
    """
    if max(place.order for place in places) > _HIGHEST_ORDER or S.field.absolute_degree > _HIGHEST_DEGREE:
        return None
    points = [Point(places[-1], oo), *(point for place in places[:-1] for point in _points(place))]
    options = [_choices(point, m) for point in points]
    choices = [chosen for chosen in options if chosen is not None]
    if len(choices) < len(points):
        return None
    total = prod(len(chosen) ** point.count for chosen, point in zip(choices, points, strict=True))
    families = None
    if prod(map(len, choices)) <= _MOST_FAMILIES:
        all_families = [Family(family, _degree(family, points, m)) for family in product(*choices)]
        natural = [
            family
            for family in all_families
            if is_natural(family.d) and not (m == 2 and all(choice.value % 2 == 0 for choice in family.choices))
        ]
        field = _field(S, points, choices) if natural else None
        tried = {} if field is None else _Trial(S, points, m, variable, field).of(natural)
        chosen = all_families if m == 1 and total <= _FEW_FAMILIES else natural
        families = tuple(tried.get(id(family), family) for family in chosen)
    return Search(m, tuple(points), tuple(choices), total, _naturals(choices, points, m), families)


def is_natural(d: Any) -> bool:
    """Is it 0, 1, 2, ...?"""
    return bool(d.is_Integer and d >= 0)


def _points(place: Place) -> list[Point]:
    if place.degree > 2 or (place.degree == 2 and place.order > 2):
        return [Point(place, None, place.degree)]
    if place.degree == 1:
        return [Point(place, -number(place.factor[0]))]
    middle, half = place.factor[1] / -2, root(place.factor[1] * place.factor[1] / 4 - place.factor[0])
    return [Point(place, number(middle) + sign * half) for sign in (-1, 1)]


def _degree(choices: Sequence[Choice], points: Sequence[Point], m: int) -> Any:
    finite = Add(*(point.count * choice.value for point, choice in zip(points[1:], choices[1:], strict=True)))
    return settled(SCALE[m] * (choices[0].value - finite))


def _naturals(choices: Sequence[Sequence[Choice]], points: Sequence[Point], m: int) -> int | None:
    """How many families have a natural d, conjugate poles counted one by one; None for many poles."""
    if len(points) > _MOST_POINTS:
        return None
    sums = Counter({(choice.value, m == 2 and choice.value % 2 == 0): 1 for choice in choices[0]})
    for point, chosen in zip(points[1:], choices[1:], strict=True):
        for _ in range(point.count):
            following: Counter[tuple[Any, bool]] = Counter()
            for (value, even), count in sums.items():
                for choice in chosen:
                    following[value - choice.value, even and choice.value % 2 == 0] += count
            sums = following
            if len(sums) > _MOST_FAMILIES:
                return None
    return sum(count for (value, even), count in sums.items() if is_natural(settled(SCALE[m] * value)) and not even)


def _choices(point: Point, m: int) -> tuple[Choice, ...] | None:
    """Step 1; None where the exponents aren't square roots of constants."""
    place, centre = point.place, 2 if m == 2 else 6
    if place.kind is Kind.ORDINARY or (place.at_infinity and place.order == 1):
        return tuple(Choice(Integer(e)) for e in ((0, 1) if m == 1 else (0, 2, 4) if m == 2 else range(13)))
    if place.order > 2:
        if m == 2:
            return (Choice(Integer(4 - place.order if place.at_infinity else place.order)),)
        return _irregular(place) if m == 1 and place.degree == 1 and place.order % 2 == 0 else None
    if place.order == 1:
        return (Choice(Integer(1 if m == 1 else 2 * centre)),)
    if m == 1 and place.delta_squared is not None:
        delta = root(place.delta_squared)
        return tuple(Choice((1 + sign * delta) / 2) for sign in ((1, -1) if delta else (1,)))
    if m == 1:
        return None
    values = {centre + Fraction(2 * centre * k, m) * (place.delta or 0) for k in range(-m // 2, m // 2 + 1)}
    return tuple(Choice(Integer(int(value))) for value in sorted(values) if value.denominator == 1)


def _irregular(place: Place) -> tuple[Choice, ...]:
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
    a = root(u[0])
    terms = tuple((sign * (k - nu), expand(a * number(w[k]))) for k in range(count - 1))
    last = expand(2 * a * number(w[-1]))
    return tuple(Choice((s * last + sign * nu) / 2, tuple((power, s * c) for power, c in terms if c)) for s in (1, -1))


def _field(S: RatFunc, points: Sequence[Point], choices: Sequence[Sequence[Choice]]) -> Any:
    """The field of all numbers that occur; None for numbers outside every `domain`."""
    chosen = [choice for options in choices for choice in options]
    numbers = [Integer(1), *(point.at for point in points if point.at not in (None, oo))]
    numbers += [choice.value for choice in chosen] + [c for choice in chosen for _, c in choice.singular]
    return domain(numbers + [number(part[k]) for part in (S.num, S.den) for k in range(part.degree + 1)])


class _Trial:
    """Step 3, in the ring K[x], K the field of all numbers that occur; everything over the common denominator D."""

    def __init__(self, S: RatFunc, points: Sequence[Point], m: int, variable: str, field: Any) -> None:
        self.m, self.x, self.field = m, Symbol(variable), field
        self.parameters = parameters_of(S.field)
        self.ring, X = ring(Dummy("x"), field)
        self.factors = [
            X - field.from_sympy(point.at) if point.at is not None else self._polynomial(point.place.factor)
            for point in points[1:]
        ]
        self.weights = [point.place.weight for point in points[1:]]
        self.D = self._product(self.weights)
        rest = self._product([2 * point.place.weight - point.place.order for point in points[1:]])
        self.D2r = rest * self._polynomial(S.num / S.den.lc)

    def _product(self, powers: Sequence[int]) -> Any:
        return prod((f**k for f, k in zip(self.factors, powers, strict=True)), start=self.ring.one)

    def _polynomial(self, polynomial: Poly) -> Any:
        return self.ring.from_list([self.field.from_sympy(number(c)) for c in reversed([*polynomial])])

    def of(self, families: Sequence[Family]) -> dict[int, Family]:
        """The families that were tried, by their ids: all of few, else those up to the first success."""
        tried, work, degree = {}, 0, self.D.degree()
        most = _MOST_WORK if self.field != EX else _MOST_WORK // 100
        for family in families:
            work += (family.d + 1) * self.m * (self.m * degree + family.d) * (degree + 1)
            if work > most:
                break
            tried[id(family)] = result = self._tried(family)
            if result.P is not None and len(families) > _FEW_FAMILIES:
                break
        return tried

    def _tried(self, family: Family) -> Family:
        D, scale, convert = self.D, SCALE[self.m], self.field.from_sympy
        theta, Dtheta = [], self.ring.zero
        for index, (choice, f) in enumerate(zip(family.choices[1:], self.factors, strict=True)):
            others = self._product([k * (i != index) for i, k in enumerate(self.weights)])  # D = others f^weight
            rest, slope = self.weights[index], f.diff(0)
            Dtheta += others * f ** (rest - 1) * slope * convert(scale * choice.value)
            theta.append(Mul(scale * choice.value, slope.as_expr(self.x) / f.as_expr(self.x)))
            for power, c in choice.singular:
                Dtheta += others * f ** (rest + power) * convert(c)
                theta.append(c * f.as_expr(self.x) ** power)
        for power, c in family.choices[0].singular:
            Dtheta += D * self.ring.gens[0] ** power * convert(c)
            theta.append(c * self.x**power)
        d = int(family.d)
        columns = [self._image(self.ring.gens[0] ** k, Dtheta) for k in range(d + 1)]
        height = 1 + max([0, *(column.degree() for column in columns if column)])
        rows = [[column.coeff(self.ring.gens[0] ** i) for column in columns] for i in range(height)]
        kernel = DomainMatrix(rows, (height, d + 1), self.field).nullspace().to_list()
        if kernel:
            longest = max((self.ring.from_list(vector[::-1]) for vector in kernel), key=lambda P: P.degree())
            return replace(family, theta=Add(*theta), P=longest.monic().as_expr(self.x))
        return self._failed(replace(family, theta=Add(*theta)), rows)

    def _image(self, P: Any, Dtheta: Any) -> Any:
        """D^(m+1) L_(m+1)."""
        before, current, slope = self.ring.zero, P, self.D.diff(0)
        for k in range(self.m + 1):
            after = self.D * current.diff(0) + (Dtheta - slope * k) * current
            if k:
                after -= self.D2r * before * (k * (self.m - k + 1))
            before, current = current, after
        return current

    def _failed(self, family: Family, rows: Sequence[Sequence[Any]]) -> Family:
        if family.d > 3:
            return family
        letter = next(c for c in ascii_letters if not any(name[0] == c for name in self.parameters))
        unknowns = symbols(f"{letter}:{family.d}")
        terms = (zip(row, (*unknowns, Integer(1)), strict=True) for row in rows)
        found = [Add(*(self.field.to_sympy(c) * a for c, a in row)) for row in terms]
        conditions = tuple(dict.fromkeys(e.primitive()[1] if e.is_Add else e for e in found if e))
        return replace(family, conditions=conditions, unknowns=unknowns)

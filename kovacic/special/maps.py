"""The functions f of pull-backs, from the polar parts of S or from its exponents; and the constants in them.

For irregular singular points: f from its polar parts, up to its constant term.  The irregular places of S are the poles of f,
where S = f'^2 S0(f) + O(order 2).  With q = S0(infinity), and S0 = q - r/z + ...,

- q != 0: sqrt(S/q) dx = df - (r/(2 q)) dlog f + ..., so f is the integral of the polar parts of sqrt(S/q), up to a sign at each
  place; the residues, r/(2 q) times the order of the pole, tell the signs where r != 0.  All orders of poles of S are even;
- q = 0, r = 1: S = -f'^2/f + ..., so where all orders are odd all polar parts of f are determined;
- S0 = q z (Airy's), q F'^2 F = S + ...: F is a cubic root, and all polar parts are determined.

S0(f) has its only other pole at f = 0: so the zeros of f, which give its constant term, are the regular places of S, or
critical points of f.  Every f is tested by the exact identity; the theory shows that nothing of the first three kinds is
overlooked but where a scale q or a root of unity lies in the residue field of a conjugate set of poles alone.

At a finite place with the irreducible p, S = V/p^k for a p-adic unit V.  Infinity is the place z = 0 of S(1/z)/z^4, and what
is found there is a polynomial in x = 1/z.  All computing is in K[x]/p^j, so that conjugate poles stay together.

References: R. Debeerst, M. van Hoeij, W. Koepf, ISSAC 2008, 39-46; Q. Yuan, M. van Hoeij, ISSAC 2010, 37-43.

Where all singular points are regular, for Gauss' equation: f from its fibres over 0, 1 and infinity.  The singular points that
aren't apparent lie over 0, 1 or infinity, and where f has the multiplicity m over a point with exponent difference e, the
exponent difference of S is m e.  So the singular places are distributed: zeros of f, poles of f, and the rest, zeros of f - 1.
The first two groups have to be complete; then f is known up to a constant factor, which a place of the third group determines,
or, where that has none because m e = 1 at its points, a critical value of f.

A function of degree n has 2 n - 2 ramification points, so that there are n + 2 + R points over 0, 1 and infinity, R being the
ramification elsewhere, which the apparent places show.

Reference: M. van Hoeij & R. Vidunas, J. Algebra 441 (2015) 626-659 [vHV15], for the patterns of branching.

A `Surd` is a parameter of special functions, linear in square roots of constants of the field.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations
from math import gcd, lcm, prod

from kovacic.algebra.extension import root_modulo, root_of_constant
from kovacic.algebra.partial_fractions import decompose
from kovacic.algebra.poly import Poly, Scalar
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.compatibility import cached_property
from kovacic.engine.places import Kind, Place, Problem, rational_square_root
from kovacic.errors import LimitExceeded
from kovacic.limits import check_time, count_work

HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Surd:
    """part + sum of coefficient * sqrt(square) over `roots`, pairs (square, coefficient) of constants of one field."""

    part: Poly
    roots: tuple[tuple[Poly, Poly], ...] = ()

    def __add__(self, other: Surd | Poly | Scalar) -> Surd:
        if not isinstance(other, Surd):
            return Surd(self.part + other, self.roots)
        total = dict(self.roots)
        for square, coefficient in other.roots:
            total[square] = coefficient + total.get(square, 0)
        return Surd(self.part + other.part, tuple((square, c) for square, c in total.items() if c))

    __radd__ = __add__

    def __mul__(self, factor: Poly | Scalar) -> Surd:
        return Surd(self.part * factor, tuple((square, c * factor) for square, c in self.roots))

    __rmul__ = __mul__

    def __neg__(self) -> Surd:
        return self * -1

    def __sub__(self, other: Surd | Poly | Scalar) -> Surd:
        return self + -other

    def __rsub__(self, other: Poly | Scalar) -> Surd:
        return -self + other


#: Conjugate poles up to which roots are taken where the field has parameters: for f = (x + b)/(x^3 + a x + 1) a cubic root
#: takes minutes in which nothing checks the time.
_MOST_CONJUGATE_POLES = 2
#: Units of work for a trial of a function f; a point of a fibre, and a pair of fibres, are one unit.
TRIAL = 30


def irregular_places(problem: Problem) -> list[Place]:
    """The poles of f."""
    return [place for place in problem.places if place.kind in (Kind.UNRAMIFIED, Kind.RAMIFIED)]


def parts_by_scale(problem: Problem, n: int) -> Iterator[tuple[Poly, list[PolarPart]]]:
    """q with the parts of an n-th root at all irregular places, for each q for which there are such.

    Raises `LimitExceeded` where poles are conjugate over a larger field than the limit on constants allows.
    """
    places = irregular_places(problem)
    largest = max(place.degree for place in places)
    most = problem.budget.limits.constants if problem.field.ground == QQ else _MOST_CONJUGATE_POLES
    if largest > most:
        raise LimitExceeded(f"f has {largest} conjugate poles; roots are taken up to degree {most}", limit="constants")
    for q in scales(places, n):
        parts = [found for place in places if (found := _NTH_ROOTS[n][1](place, q)) is not None]
        if len(parts) == len(places):
            yield q, parts


@dataclass(frozen=True)
class PolarPart:
    """The polar part of f (a square root up to its sign), its order, and the residue of sqrt(S/q) dx, a constant in K[x]/p."""

    part: RatFunc
    order: int
    residue: Poly


def integral_of_square_root(place: Place, q: Poly) -> PolarPart | None:
    """int sqrt(S/q) dx at an unramified place, up to its sign.

    None if S/q has no square root over the residue field, or its residues at the roots of p aren't equal.
    """
    p = place.factor
    m = place.order // 2
    s = root_modulo(place.unit(m) / q, p, 2, m)
    if s is None:
        return None
    parts = decompose(RatFunc(s, p**m))
    residue = parts.residues[0].value if parts.residues else s.field.zero
    return None if residue.degree > 0 else PolarPart(as_function_of_x(parts.exact, place), m - 1, residue)


def leading_square(place: Place) -> Poly:
    """T modulo p for the t = T/p^d with t'^2/t = -S + ..., d = k - 2: d^2 p'^2 T = -V."""
    p = place.factor
    d = place.order - 2
    return -place.unit(1) * (d * d * p.derivative() ** 2).inverse_modulo(p) % p


def square(place: Place) -> RatFunc:
    """The polar part of t with t'^2/t = -S + ... at a ramified place: (T'p - d T p')^2 = -T V modulo p^d for t = T/p^d."""
    p = place.factor
    d = place.order - 2
    return as_function_of_x(RatFunc(expanded_square(place, d), p**d), place)


def expanded_square(place: Place, precision: int) -> Poly:
    """T modulo p^precision, term by term; for even d = k - 2 only d/2 terms are determined."""
    p = place.factor
    d = place.order - 2
    V = place.unit(precision)
    slope = p.derivative()
    T = leading_square(place)
    scale = (d * slope * slope * T).inverse_modulo(p)
    for i in range(1, precision):
        # T + p^i e changes the difference of both sides by d (d - 2 i) p'^2 T e p^i.
        step = T.derivative() * p - d * slope * T
        rest = (step * step + T * V) // p**i
        T = T - rest * scale % p * Fraction(1, d - 2 * i) * p**i
    return T


def integral_of_cubic_root(place: Place, q: Poly) -> PolarPart | None:
    """F at a place where q F'^2 F = S + ...: F^3 = -9 t/q has a pole of order d = k - 2; None without a cubic root."""
    p = place.factor
    d = (place.order - 2) // 3
    W = root_modulo(expanded_square(place, d) * -9 / q, p, 3, d)
    return None if W is None else PolarPart(as_function_of_x(RatFunc(W, p**d), place), d, p * 0)


def as_function_of_x(function: RatFunc, place: Place) -> RatFunc:
    """A function of the coordinate of the place as one of x."""
    if not place.at_infinity:
        return function
    field = function.field
    return function(RatFunc(field.one, field.x))


# ------------------------------------------------------------------------------------------ scale and constant


#: By n what shows q up to n-th powers at a place, and the part of the n-th root there.
_NTH_ROOTS: dict[int, tuple[Callable[[Place], Poly], Callable[[Place, Poly], PolarPart | None]]] = {
    2: (lambda place: place.unit(1), integral_of_square_root),
    3: (lambda place: leading_square(place) * -9, integral_of_cubic_root),
}


def scales(places: list[Place], n: int) -> list[Poly]:
    """Candidates for q, up to n-th powers: the leading coefficient at a place of degree 1; else 1, -1 and what norms tell."""
    place = min(places, key=lambda place: place.degree)
    v = _NTH_ROOTS[n][0](place)
    field = place.num.field
    one = field.one
    if place.degree == 1:
        return [v[0]] if root_of_constant(v[0], n) is None else [one]
    scales = [one] if n == 3 else [one, -one]
    if place.degree == 2 and n == 2:
        # v = q w^2 has the norm (q N(w))^2, and (v + sqrt N(v))^2 = v (tr v + 2 sqrt N(v)).
        p = place.factor
        trace = 2 * v[0] - v[1] * p[1]
        norm = field.sqrt(v[0] * v[0] - v[0] * v[1] * p[1] + v[1] * v[1] * p[0])
        if norm is not None:
            scales += [trace + 2 * norm, trace - 2 * norm]
    return list(dict.fromkeys(scale for scale in scales if scale))


@dataclass(frozen=True)
class Orbit:
    """Conjugate points: all roots of a polynomial, or infinity, with the square of the exponent difference there."""

    factor: Poly
    at_infinity: bool
    square: Poly

    @property
    def degree(self) -> int:
        return self.factor.degree


def regular_points(problem: Problem, *, apparent: bool | None = None) -> list[Orbit]:
    """The regular places whose roots have one exponent difference: all, the apparent ones, or the others."""
    places = (place for place in problem.places if place.kind is Kind.REGULAR)
    return [
        Orbit(place.factor, place.at_infinity, place.delta_squared)
        for place in places
        if place.delta_squared is not None and apparent in (None, place.is_apparent)
    ]


def unseen_points(f: RatFunc) -> list[Orbit]:
    """The critical points of f, and infinity, as ordinary points."""
    one = f.field.one
    critical = [Orbit(p, False, one) for p, _ in f.field.factor(f.derivative().num)]
    return [*critical, Orbit(f.field.x, True, one)]


def zeros(problem: Problem, polar: RatFunc, *, shifted: bool) -> Iterator[tuple[RatFunc, Poly]]:
    """f with its constant, and e^2 for the standard equation's exponent difference e at 0: a k-fold zero of f has k e.

    Zeros of f are all places with exponents that integers don't explain; without such, apparent places or critical points.
    With `shifted`, S has k e up to integers only.
    """
    seen = regular_points(problem, apparent=False)
    for point in seen or [*regular_points(problem, apparent=True), *unseen_points(polar)]:
        value = value_at_point(polar, point)
        if value is None:
            continue
        check_time()
        f = polar - value
        k = -f.degree if point.at_infinity else f.num.remove(point.factor)[1]
        yield f, point.square * Fraction(1, k * k)
        if shifted:
            yield from ((f, e_squared) for e_squared in _shifted_differences(point.square, k))


def value_at_point(f: RatFunc, point: Orbit | Place) -> Poly | None:
    """The value at all roots of a factor, or at infinity, if it is one and finite."""
    if point.at_infinity:
        if not f or f.degree < 0:
            return f.num * 0
        return f.num.lc if f.degree == 0 else None
    p = point.factor
    if f.den.gcd(p).degree > 0:
        return None
    value = f.num * f.den.inverse_modulo(p) % p
    return value if value.degree <= 0 else None


def _shifted_differences(square: Poly, k: int) -> Iterator[Poly]:
    """The squares of e with k e = Delta up to sign and integers, small ones first where they are rational."""
    root = square.field.sqrt(square)
    if root is None:
        return
    centre = round(root.field.rational_value(root) or 0)
    found = [(root - centre + j) * Fraction(1, k) for j in range(-k, k + 1)]
    found.sort(key=lambda e: abs(e.field.rational_value(e) or Fraction(0)))
    yield from (e * e for e in found)


def coverings(
    points: list[Orbit], apparent: list[Orbit], hidden: int = 0
) -> Iterator[tuple[RatFunc, Poly, Poly, Poly]]:
    """f with the squares of the exponent differences at its zeros, at its ones and at its poles.

    Those that are possible for these singular points, of small degree first.  Apparent ones may lie anywhere; up to `hidden`
    ramification points may lie at places that S doesn't show.
    """
    # n + 2 points lie over 0, 1 and infinity, and as many more as there is ramification elsewhere
    elsewhere = sum(int(rational_square_root(point.square) or 1) * point.degree for point in apparent)
    least_degree = _count(points) - 2 - elsewhere - hidden
    without = _distributed(points, points, least_degree)
    with_apparent = _distributed(points, [*points, *apparent], least_degree) if apparent else ()
    tried = set()
    for zeros, poles, rest in chain(without, with_apparent):
        f = RatFunc(zeros.polynomial, poles.polynomial)
        if f in tried:
            continue
        tried.add(f)
        # the multiples of f that are 1 at the points of the rest, or have 1 for a critical value
        values = dict.fromkeys(value_at_point(f, point) for point in rest[:1] or unseen_points(f))
        for g in [f / value for value in values if value]:
            count_work(zeros.degree)  # what stands over 1 is factored
            yield g, zeros.square, _difference_at_ones(g, zeros.degree, [*points, *apparent]), poles.square


# ------------------------------------------------------------------------------------------ places to fibres


@dataclass(frozen=True)
class Fibre:
    """All points over one of 0, 1, infinity with their multiplicities, and the square of the exponent difference."""

    multiplicities: tuple[tuple[Orbit, int], ...]
    square: Poly

    @cached_property
    def degree(self) -> int:
        return sum(k * point.degree for point, k in self.multiplicities)

    @cached_property
    def points(self) -> frozenset[Orbit]:
        return frozenset(point for point, _ in self.multiplicities)

    @property
    def polynomial(self) -> Poly:
        """The product over the finite ones."""
        finite = (point.factor**k for point, k in self.multiplicities if not point.at_infinity)
        return prod(finite, start=self.square.field.one)


def _distributed(
    points: list[Orbit], among: list[Orbit], least_degree: int
) -> Iterator[tuple[Fibre, Fibre, list[Orbit]]]:
    """Disjoint fibres of one degree n over 0 and infinity, made of `among`, and the points that are left over 1."""
    by_degree: dict[int, list[Fibre]] = {}
    for fibre in fibres(among, 2 * _count(among) - 4):
        check_time()
        count_work(len(fibre.multiplicities))
        if fibre.degree >= least_degree:
            by_degree.setdefault(fibre.degree, []).append(fibre)
    for n, found in sorted(by_degree.items()):
        # polynomials f first
        found.sort(key=lambda fibre: not all(point.at_infinity for point in fibre.points))
        for zeros, poles in combinations(found, 2):
            check_time()
            count_work(1)
            if not zeros.points.isdisjoint(poles.points):
                continue
            used = zeros.points | poles.points
            rest = [point for point in points if point not in used]
            over_one = _count(rest)
            multiple = (n - over_one) // 2  # at most: S doesn't show these
            if _count(used) + over_one + multiple >= n + 2:
                yield zeros, poles, rest


def _count(points: Iterable[Orbit]) -> int:
    """The number of points."""
    return sum(point.degree for point in points)


def fibres(points: list[Orbit], most: int, chosen: tuple[Orbit, ...] = ()) -> Iterator[Fibre]:
    """Every set of points that can be a whole fibre of a function of degree `most` or less, with its multiplicities.

    These have rational quotients of their exponent differences, and begin with the chosen ones.
    """
    if chosen:
        # The smallest natural numbers in the proportion of the exponent differences; where these are 0 the multiplicities are
        # free, and only equal ones are tried.
        ratios = [_ratio(point, chosen[0]) or Fraction(1) for point in chosen]
        unit = Fraction(gcd(*(r.numerator for r in ratios)), lcm(*(r.denominator for r in ratios)))
        least = [int(ratio / unit) for ratio in ratios]
        size = sum(m * point.degree for m, point in zip(least, chosen, strict=True))
        if size > most:  # with more points it only grows
            return
        for k in range(1, most // size + 1):
            multiplicities = tuple((point, k * m) for point, m in zip(chosen, least, strict=True))
            yield Fibre(multiplicities, chosen[0].square * Fraction(1, (k * least[0]) ** 2))
    for k, point in enumerate(points):
        if not chosen or _ratio(point, chosen[0]) is not None:
            yield from fibres(points[k + 1 :], most, (*chosen, point))


def _ratio(point: Orbit, other: Orbit) -> Fraction | None:
    """The quotient of the exponent differences if it is rational; 1 where both vanish."""
    if point.square and other.square:
        return rational_square_root(point.square / other.square)
    return None if point.square or other.square else Fraction(1)


# ------------------------------------------------------------------------------------------ fibres to f


def _difference_at_ones(f: RatFunc, degree: int, points: list[Orbit]) -> Poly:
    """The square of the exponent difference over 1, from that and the multiplicity of one point there."""
    over_one = f.num - f.den
    m = degree - over_one.degree  # at infinity
    if m:
        found = [point.square for point in points if point.at_infinity]
    else:
        p, m = max(over_one.field.factor(over_one), key=lambda pair: pair[1])
        found = [point.square for point in points if point.factor == p and not point.at_infinity]
    return next(iter(found), over_one.field.one) * Fraction(1, m * m)  # an ordinary point has the difference 1

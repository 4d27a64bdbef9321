"""f from its fibres over 0, 1 and infinity, where all singular points of the pull-back are regular: for Gauss' equation.

The singular points that aren't apparent lie over 0, 1 or infinity, and where f has the multiplicity m over a point with
exponent difference e, the exponent difference of S is m e.  So the singular places are distributed: zeros of f, poles of f, and
the rest, zeros of f - 1.  The first two groups have to be complete; then f is known up to a constant factor, which a place of
the third group determines, or, where that has none because m e = 1 at its points, a critical value of f.

A function of degree n has 2 n - 2 ramification points, so that there are n + 2 + R points over 0, 1 and infinity, R being the
ramification elsewhere, which the apparent places show.

Reference: M. van Hoeij & R. Vidunas, J. Algebra 441 (2015) 626-659 [vHV15], for the patterns of branching.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from math import gcd, lcm

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import rational_square_root
from kovacic.errors import LimitExceeded
from kovacic.limits import Budget, count_work
from kovacic.special.polar_parts import value_at

#: What a function f costs, in pairs of fibres, about.
_TRIAL = 20
#: The most places that are distributed, up to which number apparent ones are among them, and the most functions f.
_PLACES = 14
_WITH_APPARENT = 7
_TRIALS = 1000


@dataclass(frozen=True)
class Covering:
    """f with the squares of the exponent differences at its zeros, at its ones and at its poles."""

    f: RatFunc
    zeros: Poly
    ones: Poly
    poles: Poly


@dataclass(frozen=True)
class Point:
    """All roots of a polynomial, or infinity, and the square of the exponent difference there."""

    factor: Poly
    at_infinity: bool
    square: Poly

    @property
    def degree(self) -> int:
        return self.factor.degree


def coverings(points: list[Point], apparent: list[Point], budget: Budget, hidden: int = 0) -> Iterator[Covering]:
    """Those that are possible for these singular points, of small degree first.

    Apparent ones may lie anywhere; up to `hidden` ramification points may lie at places that S doesn't show.
    """
    if len(points) > _PLACES:
        return
    for zeros, poles, f in _functions(_Distribution(points, apparent, budget, hidden)):
        ones = _difference_at_ones(f, zeros.degree, [*points, *apparent])
        if ones is not None:
            yield Covering(f, zeros.square, ones, poles.square)


# ------------------------------------------------------------------------------------------ places to fibres


@dataclass(frozen=True)
class Fibre:
    """All points over one of 0, 1, infinity with their multiplicities, and the square of the exponent difference."""

    multiplicities: tuple[tuple[Point, int], ...]
    square: Poly
    mask: int = 0
    """The points as bits, by their numbers among those that are distributed."""

    @cached_property
    def degree(self) -> int:
        return sum(k * point.degree for point, k in self.multiplicities)

    @property
    def points(self) -> int:
        return _count(point for point, _ in self.multiplicities)

    @property
    def polynomial(self) -> Poly:
        """The product over the finite ones."""
        result = self.square.field.poly([1])
        for point, k in self.multiplicities:
            if not point.at_infinity:
                result = result * point.factor**k
        return result


@dataclass(frozen=True)
class _Distribution:
    points: list[Point]
    apparent: list[Point]
    budget: Budget
    hidden: int

    @property
    def among(self) -> list[Point]:
        """The points that are distributed."""
        found = [*self.points, *self.apparent]
        return found if len(found) <= _WITH_APPARENT else self.points


def _functions(search: _Distribution) -> Iterator[tuple[Fibre, Fibre, RatFunc]]:
    """The functions f, each once, with their zeros and poles.  Raises `LimitExceeded` for too many of them."""
    tried = set()
    for zeros, poles, rest in _distributed(search):
        for f in _scaled(zeros.polynomial, poles.polynomial, rest):
            if f in tried:
                continue
            tried.add(f)
            count_work(_TRIAL)
            if len(tried) > _TRIALS:
                raise LimitExceeded(f"there are more than {_TRIALS} functions f to try", limit="degree")
            yield zeros, poles, f


def _distributed(search: _Distribution) -> Iterator[tuple[Fibre, Fibre, list[Point]]]:
    """Fibres over 0 and infinity of one degree n that have no point in common, and the points that are left over 1."""
    among = search.among
    by_degree: dict[int, list[Fibre]] = {}
    # n + 2 points lie over 0, 1 and infinity, and as many more as there is ramification elsewhere
    elsewhere = sum(int(rational_square_root(point.square) or 1) * point.degree for point in search.apparent)
    least_degree = _count(search.points) - 2 - elsewhere - search.hidden
    for fibre in fibres(among, 2 * _count(among) - 4):
        search.budget.check()
        count_work(1)
        if fibre.degree >= least_degree:
            by_degree.setdefault(fibre.degree, []).append(fibre)
    for n, found in sorted(by_degree.items()):
        for zeros, poles in combinations(found, 2):
            search.budget.check()
            count_work(1)
            if zeros.mask & poles.mask:
                continue
            used = zeros.mask | poles.mask
            rest = [point for point in search.points if not used >> among.index(point) & 1]
            over_one = _count(rest)
            multiple = (n - over_one) // 2  # at most: S doesn't show these
            if zeros.points + poles.points + over_one + multiple >= n + 2:
                yield zeros, poles, rest


def _count(points: Iterable[Point]) -> int:
    """How many points these are."""
    return sum(point.degree for point in points)


def fibres(points: list[Point], most: int) -> Iterator[Fibre]:
    """Every set of points that can be a whole fibre of a function of degree `most` or less, with its multiplicities."""
    for chosen, mask in _commensurable(points, most, 0, [], 0):
        least = _least_multiplicities(chosen)
        size = sum(m * point.degree for m, point in zip(least, chosen, strict=True))
        for k in range(1, most // size + 1):
            multiplicities = tuple((point, k * m) for point, m in zip(chosen, least, strict=True))
            square = chosen[0].square * Fraction(1, (k * least[0]) ** 2)
            yield Fibre(multiplicities, square, mask)


def _least_multiplicities(chosen: list[Point]) -> list[int]:
    """The smallest natural numbers in the proportion of the exponent differences.

    Where these are 0 the multiplicities are free, and only equal ones are tried.
    """
    if not chosen[0].square:
        return [1] * len(chosen)
    ratios = [ratio for point in chosen if (ratio := _ratio(point, chosen[0])) is not None]
    unit = Fraction(gcd(*(r.numerator for r in ratios)), lcm(*(r.denominator for r in ratios)))
    return [int(ratio / unit) for ratio in ratios]


def _commensurable(
    points: list[Point], most: int, index: int, chosen: list[Point], mask: int
) -> Iterator[tuple[list[Point], int]]:
    """Sets of `most` points or fewer with rational quotients of their exponent differences, as lists and as bits: what has been
    chosen before the index, and all that goes with it from there."""
    if chosen:
        yield chosen, mask
    left = most - _count(chosen)
    for k in range(index, len(points)):
        point = points[k]
        goes_with_others = not chosen or _ratio(point, chosen[0]) is not None
        if goes_with_others and point.degree <= left:
            yield from _commensurable(points, most, k + 1, [*chosen, point], mask | 1 << k)


def _ratio(point: Point, other: Point) -> Fraction | None:
    """The quotient of the exponent differences if it is rational; 1 where both vanish."""
    if point.square and other.square:
        return rational_square_root(point.square / other.square)
    return None if point.square or other.square else Fraction(1)


# ------------------------------------------------------------------------------------------ fibres to f


def _scaled(zeros: Poly, poles: Poly, rest: list[Point]) -> Iterator[RatFunc]:
    """The multiples of zeros/poles that are 1 at the points of the rest, or have 1 for a critical value."""
    f = RatFunc(zeros, poles)
    factors = [point.factor for point in rest[:1] if not point.at_infinity]
    slope = f.derivative().num
    if not rest and slope.degree > 0:
        factors = [p for p, _ in slope.field.factor(slope)]
    values = [value_at(f, p, at_infinity=False) for p in factors]
    if f.degree == 0 and not (rest and factors):
        values.append(f.num.lc)
    yield from (f / value for value in values if value)


def _difference_at_ones(f: RatFunc, degree: int, points: list[Point]) -> Poly | None:
    """The square of the exponent difference over 1, from that and the multiplicity of one point there; None if f is 1.

    A point that isn't singular has the exponent difference 1.
    """
    over_one = f.num - f.den
    if over_one.degree < 0:
        return None
    m = degree - over_one.degree  # at infinity
    if m:
        found = [point.square for point in points if point.at_infinity]
    else:
        p, m = max(over_one.field.factor(over_one), key=lambda pair: pair[1])
        found = [point.square for point in points if point.factor == p and not point.at_infinity]
    square = found[0] if found else over_one.field.poly([1])
    return square * Fraction(1, m * m)

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
from itertools import combinations
from math import gcd, lcm

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.places import Kind, Place, Problem, analyse, rational_square_root
from kovacic.errors import LimitExceeded
from kovacic.limits import count_work

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


def coverings(problem: Problem, *, extended: bool, hidden: int = 0) -> Iterator[Covering]:
    """Those that are possible, of small degree first.  With `extended`, conjugate places are separated over a larger field.

    Up to `hidden` ramification points may lie at places that S doesn't show.
    """
    regular = [place for place in problem.places if place.kind is Kind.REGULAR]
    places = [place for place in regular if not place.is_apparent]
    different = [place.factor for place in places if place.delta_squared is None]
    if different:
        if extended and different[0].degree == 2:
            field = AlgebraicField(problem.field, different[0])  # with a root of the factor
            S = RatFunc(problem.S.num.over(field), problem.S.den.over(field), reduced=True)
            yield from coverings(analyse(S, problem.budget), extended=extended, hidden=hidden)
        return
    if len(places) > _PLACES:
        return
    for zeros, poles, f in _functions(problem, regular, places, hidden):
        ones = _difference_at_ones(f, zeros.degree, regular)
        if ones is not None:
            yield Covering(f, zeros.square, ones, poles.square)


# ------------------------------------------------------------------------------------------ places to fibres


@dataclass(frozen=True)
class _Fibre:
    """All points over one of 0, 1, infinity: places with multiplicities, and the square of the exponent difference."""

    places: tuple[tuple[Place, int], ...]
    square: Poly
    degree: int
    mask: int

    @property
    def points(self) -> int:
        return _points(place for place, _ in self.places)

    @property
    def polynomial(self) -> Poly:
        """The product over the finite places."""
        result = self.square.field.poly([1])
        for place, k in self.places:
            if not place.at_infinity:
                result = result * place.factor**k
        return result


def _functions(
    problem: Problem, regular: list[Place], places: list[Place], hidden: int
) -> Iterator[tuple[_Fibre, _Fibre, RatFunc]]:
    """The functions f, each once, with their zeros and poles.  Raises `LimitExceeded` for too many of them."""
    tried = set()
    for zeros, poles, rest in _distributed(problem, regular, places, hidden):
        for f in _scaled(zeros.polynomial, poles.polynomial, rest):
            if f in tried:
                continue
            tried.add(f)
            count_work(_TRIAL)
            if len(tried) > _TRIALS:
                raise LimitExceeded(f"there are more than {_TRIALS} functions f to try", limit="degree")
            yield zeros, poles, f


def _distributed(
    problem: Problem, regular: list[Place], places: list[Place], hidden: int
) -> Iterator[tuple[_Fibre, _Fibre, list[Place]]]:
    """Fibres over 0 and infinity of one degree n that have no place in common, and the places that are left over 1."""
    among = regular if len(regular) <= _WITH_APPARENT else places
    for n, fibres in sorted(_by_degree(problem, regular, among, hidden).items()):
        for zeros, poles in combinations(fibres, 2):
            problem.budget.check()
            count_work(1)
            if zeros.mask & poles.mask:
                continue
            used = zeros.mask | poles.mask
            rest = [place for place in places if not used >> among.index(place) & 1]
            over_one = _points(rest)
            multiple = (n - over_one) // 2  # at most: S doesn't show these
            if zeros.points + poles.points + over_one + multiple >= n + 2:
                yield zeros, poles, rest


def _points(places: Iterable[Place]) -> int:
    """How many roots the places have together."""
    return sum(place.degree for place in places)


def _by_degree(problem: Problem, regular: list[Place], among: list[Place], hidden: int) -> dict[int, list[_Fibre]]:
    """The fibres that can be, by the degree of f."""
    points = _points(place for place in regular if not place.is_apparent)
    elsewhere = hidden + sum(int(place.delta or 1) * place.degree for place in regular if place.is_apparent)
    fibres: dict[int, list[_Fibre]] = {}
    for fibre in _fibres(among, 2 * _points(among) - 4):
        problem.budget.check()
        count_work(1)
        if fibre.degree >= points - 2 - elsewhere:
            fibres.setdefault(fibre.degree, []).append(fibre)
    return fibres


def _fibres(places: list[Place], most: int) -> Iterator[_Fibre]:
    """Every set of places that can be a whole fibre of a function of degree `most` or less, with its multiplicities."""
    for chosen, mask in _commensurable(places, most, 0, [], 0):
        first = chosen[0].delta_squared
        assert first is not None
        least = _least_multiplicities(chosen)
        size = sum(m * place.degree for m, place in zip(least, chosen, strict=True))
        for k in range(1, most // size + 1):
            points = tuple((place, k * m) for place, m in zip(chosen, least, strict=True))
            square = first * Fraction(1, (k * least[0]) ** 2)
            yield _Fibre(points, square, k * size, mask)


def _least_multiplicities(chosen: list[Place]) -> list[int]:
    """The smallest natural numbers in the proportion of the exponent differences.

    Where these are 0 the multiplicities are free, and only equal ones are tried.
    """
    if not chosen[0].delta_squared:
        return [1] * len(chosen)
    found = (_ratio(place, chosen[0]) for place in chosen)
    ratios = [ratio for ratio in found if ratio is not None]
    unit = Fraction(gcd(*(r.numerator for r in ratios)), lcm(*(r.denominator for r in ratios)))
    return [int(ratio / unit) for ratio in ratios]


def _commensurable(
    places: list[Place], most: int, index: int, chosen: list[Place], mask: int
) -> Iterator[tuple[list[Place], int]]:
    """Sets of `most` points or fewer with rational quotients of their exponent differences, as lists and as bits: what has been
    chosen before the index, and all that goes with it from there."""
    if chosen:
        yield chosen, mask
    left = most - _points(chosen)
    for k in range(index, len(places)):
        place = places[k]
        goes_with_others = not chosen or _ratio(place, chosen[0]) is not None
        if goes_with_others and place.degree <= left:
            yield from _commensurable(places, most, k + 1, [*chosen, place], mask | 1 << k)


def _ratio(place: Place, other: Place) -> Fraction | None:
    """The quotient of the exponent differences if it is rational; 1 where both vanish."""
    over = place.delta_squared
    under = other.delta_squared
    assert over is not None
    assert under is not None
    if over and under:
        return rational_square_root(over / under)
    return None if over or under else Fraction(1)


# ------------------------------------------------------------------------------------------ fibres to f


def _scaled(zeros: Poly, poles: Poly, rest: list[Place]) -> Iterator[RatFunc]:
    """The multiples of zeros/poles that are 1 at the places of the rest, or have 1 for a critical value."""
    f = RatFunc(zeros, poles)
    if not rest:
        factors = _critical(f)
    elif rest[0].at_infinity:
        factors = []
    else:
        factors = [rest[0].factor]
    values = [f.num * f.den.inverse_modulo(p) % p for p in factors if f.den.gcd(p).degree == 0]
    is_known_at_infinity = f.degree == 0
    if is_known_at_infinity and not (rest and factors):
        values.append(f.num.lc)
    for value in values:
        if value.degree == 0:
            yield f / value


def _critical(f: RatFunc) -> list[Poly]:
    """The irreducible polynomials at whose roots f' vanishes."""
    slope = f.derivative().num
    if slope.degree <= 0:
        return []
    return [p for p, _ in slope.field.factor(slope)]


def _difference_at_ones(f: RatFunc, degree: int, regular: list[Place]) -> Poly | None:
    """The square of the exponent difference over 1, from that and the multiplicity of one point there; None if f is 1.

    A point that isn't singular has the exponent difference 1.
    """
    over_one = f.num - f.den
    if over_one.degree < 0:
        return None
    field = over_one.field
    m = degree - over_one.degree  # at infinity
    if m:
        place = next((place for place in regular if place.at_infinity), None)
    else:
        p, m = max(field.factor(over_one), key=lambda pair: pair[1])
        place = next((place for place in regular if place.factor == p and not place.at_infinity), None)
    square = None if place is None else place.delta_squared
    if square is None:
        square = field.poly([1])
    return square * Fraction(1, m * m)

"""Solutions exp(int theta) P with a P of given degree: theta from a choice of exponents at each place, conditions for P.

At a regular place theta has the residue (1 +- Delta)/2; at an irregular one its polar part is that of +- sqrt S, with a residue
that follows [Kovacic 1986, sec. 3.1].  With theta = R/D, D P'' + 2 R P' + ((R' D - R D' + R^2 - T)/D) P = 0 is a system for the
coefficients of P.  The roots Delta and sqrt S need lie in no field that is given: conjugate poles are split, and square roots
adjoined, one after the other.  A system over such an extension is one over the field below for the coordinates of P, and it has
a solution where one of the conjugate systems has one; P itself tells which, since its coefficients follow from the highest one.
In the same way the valuations at all places leave a system for the P of a rational form of degree m.

The rank of a matrix over Q[t], generically r, drops exactly at the common zeros of the r-minors.  A hypersurface of such values
is among the zeros of each minor that isn't 0; one at whose random point the rank is r is none.  Which of these values really
are special is for the engine to say.  First the constant entries are used as pivots, which changes the rank by the same number
at all values.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from itertools import chain, combinations, product
from math import comb, gcd
from operator import mul
from random import Random
from typing import Any, NamedTuple

from flint import nmod_mat, nmod_poly

from kovacic.algebra.extension import AlgebraicField, adjoined_square_root
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.lifting import primes
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.algebra.sparse import by_power
from kovacic.engine.invariants import bounds, least_invariant_valuation
from kovacic.engine.local import irregular_difference_squared
from kovacic.engine.places import Kind, Place, Problem, analyse
from kovacic.engine.riccati import Form, singular_part
from kovacic.equation import parameters_of
from kovacic.errors import LimitExceeded
from kovacic.limits import MOST_TRIALS, bounded_work, check_time, count_work
from kovacic.parametric.claims import (
    ExponentRoot,
    Numbers,
    element,
    in_field,
    irreducible_factors,
    over_parameters,
    rational_number,
    with_free_generator,
)

#: Products of terms for the determinants of one matrix, some seconds' worth.
_MOST_TERM_PRODUCTS = 10**7


def _counted_product(first: Any, second: Any) -> Any:
    count_work(len(first) * len(second))
    return first * second


@dataclass(frozen=True)
class RankConditions:
    """Where a rank drops: where one of the irreducible `polynomials` vanishes, or all of the `system`.

    The system is empty if that happens nowhere else, and None if it wasn't computed.  `deficient`: the images are linearly
    dependent for all values.
    """

    polynomials: tuple[FunctionPoly, ...] = ()
    system: tuple[FunctionPoly, ...] | None = ()
    deficient: bool = False


#: The rank drops nowhere; conditions that weren't computed.
NOWHERE = RankConditions()
NOT_COMPUTED = RankConditions(system=None)


def rank_conditions(images: Sequence[Poly], field: Field) -> RankConditions:
    """Where polynomials span less than generically, over Q(t) or the field of a hypersurface in parameter space.

    On a hypersurface the algebraic parameter is one more parameter, and the conditions hold modulo its equation.
    """
    surface = None
    if isinstance(field, AlgebraicField):
        larger = FunctionField((*parameters_of(field.base), field.name))
        surface = over_parameters(in_field(field.modulus, larger)(larger.generator(field.name))).num
        images = [with_free_generator(image, larger) for image in images]
    try:
        with bounded_work(_MOST_TERM_PRODUCTS):
            return _minor_conditions([*map(over_parameters, images)], surface)
    except LimitExceeded as limit:
        if limit.limit != "work":
            raise
        return NOT_COMPUTED


def _minor_conditions(images: Sequence[FunctionPoly], surface: Any) -> RankConditions:
    """Conditions by all minors of the size of the rank, or by two of them if there are too many.

    The rank at a random point is a lower bound, and differs from the generic rank with a probability of about 2**-60.
    """
    # By powers of x, without denominators.
    smaller, eliminated = without_constant_pivots([by_power(image.num, 0) for image in images])
    field = images[0].field
    # Each row once, the shortest first.
    different = {tuple(map(str, row)): row for row in smaller}
    rows = sorted(different.values(), key=lambda row: sum(map(len, row)))
    point = _random_point(field, surface)
    rank = point.values(rows).rank() if rows else 0
    deficient = eliminated + rank < len(images)
    if rank == 0:
        return RankConditions(deficient=deficient)
    has_one_parameter = len(field.names) == 1  # on a surface there are two
    most = 1 if has_one_parameter else MOST_TRIALS
    # If columns would have to be chosen, too, or rows in too many ways.
    if rank < len(rows[0]) or comb(len(rows), rank) > most:
        polynomials = _factors_of_minors(rows, rank, point, field) if surface is None else ()
        return RankConditions(polynomials, () if has_one_parameter else None, deficient)
    minors = [*filter(None, (_determinant([[*row] for row in chosen]) for chosen in combinations(rows, rank)))]
    common = reduce(lambda a, b: a.gcd(b), minors)
    factors = tuple(irreducible_factors(element(field, common)))
    # The system of the cofactors of the minors, without powers, the shortest first.
    rests = [irreducible_factors(element(field, minor // common)) for minor in minors]
    system = {reduce(mul, parts) for parts in rests} if all(rests) else set()
    shortest_first = sorted(system, key=lambda function: (len(function.num), str(function)))
    return RankConditions(factors, tuple(shortest_first), deficient)


def _factors_of_minors(
    rows: list[list[Any]], rank: int, point: _ModularPoint, field: FunctionField
) -> tuple[FunctionPoly, ...]:
    """The irreducible factors that all minors of this size share: those of two minors at whose zeros the rank is smaller."""
    common = _minor(rows, point)
    if not common.is_constant():
        common = common.gcd(_minor(rows[::-1], point))
    factors = irreducible_factors(element(field, common))
    return tuple(factor for factor in factors if _random_point(field, factor.num).values(rows).rank() < rank)


def _minor(rows: list[list[Any]], point: _ModularPoint) -> Any:
    """The minor of the first rows and columns that are independent at the point."""
    chosen = [rows[i] for i in _pivots(point.values(rows).transpose())]
    columns = _pivots(point.values(chosen))
    return _determinant([[row[k] for k in columns] for row in chosen])


class _ModularPoint(NamedTuple):
    """Values of the parameters modulo a prime."""

    prime: int
    parameters: list[int]

    def values(self, rows: list[list[Any]]) -> Any:
        """The matrix with these rows at the point."""
        entries = [int(entry(0, *self.parameters)) % self.prime for entry in chain.from_iterable(rows)]
        return nmod_mat(len(rows), len(rows[0]), entries, self.prime)


def _random_point(field: FunctionField, equation: Any = None) -> _ModularPoint:
    """A random point, one at which a polynomial in the parameters vanishes if an `equation` is given."""
    random = Random(1)
    for p in primes():  # modulo every other prime a surface such as a^2 + 1 = 0 has points
        check_time()
        point = [random.randrange(p) for _ in field.names]
        if equation is None:
            return _ModularPoint(p, point)
        # The last parameter that occurs is a root; it is variable number `last`, after x, and parameter number last - 1.
        last = max(k for k, degree in enumerate(equation.degrees()) if degree)
        parts = by_power(equation, last)
        coefficients = [int(parts.get(k, 0 * equation)(0, *point)) % p for k in range(max(parts) + 1)]
        found = nmod_poly(coefficients, p).roots()
        if found:
            point[last - 1] = int(found[0][0])
            return _ModularPoint(p, point)
    raise AssertionError("the sequence of primes is infinite")


def _pivots(matrix: Any) -> list[int]:
    """The first columns that are independent."""
    reduced, rank = matrix.rref()
    columns = range(matrix.ncols())
    return [next(k for k in columns if reduced[i, k]) for i in range(rank)]


def without_constant_pivots(columns: list[dict[int, Any]]) -> tuple[list[list[Any]], int]:
    """The rows of a smaller matrix, and the number of eliminated rows, by which its rank is smaller.

    The given matrix is described by the entries of its columns.  A constant entry clears its column, and its row and column
    are left out then; the one that touches the fewest entries is chosen first [Markowitz 1957].  A matrix for a polynomial P
    is banded, so that this eliminates its coefficients by their recurrence.
    """
    rows = [{k: column[i] for k, column in enumerate(columns) if column.get(i)} for i in sorted(set().union(*columns))]
    eliminated = 0
    while True:
        weights = Counter(chain.from_iterable(rows))
        constant = ((i, k) for i, row in enumerate(rows) for k, entry in row.items() if entry.is_constant())
        pivot = min(((len(rows[i]) * weights[k], i, k) for i, k in constant), default=None)
        if pivot is None:
            break
        _, i, k = pivot
        chosen = rows.pop(i)
        rows = [_cleared(row, k, chosen) if k in row else row for row in rows]
        eliminated += 1
    left = [row for row in rows if row]
    numbers = sorted(set().union(*left))
    zero = 0 * next(iter(left[0].values())) if left else 0
    return [[*_primitive({k: row.get(k, zero) for k in numbers}).values()] for row in left], eliminated


def _cleared(row: dict[int, Any], k: int, chosen: dict[int, Any]) -> dict[int, Any]:
    """The row with its entry in column k cleared by the chosen one, without its content."""
    check_time()
    pivot, factor = chosen[k], row[k]
    zero = 0 * pivot
    columns = row.keys() | chosen.keys()
    combined = {
        j: _counted_product(pivot, row.get(j, zero)) - _counted_product(factor, chosen.get(j, zero)) for j in columns
    }
    return _primitive({j: entry for j, entry in combined.items() if entry})


def _primitive(row: dict[int, Any]) -> dict[int, Any]:
    """The multiple with coprime coefficients, the first one positive; pivots would grow exponentially without this."""
    coefficients = [int(c) for entry in row.values() for c in entry.coeffs()]
    content = -gcd(*coefficients) if coefficients[:1] < [0] else gcd(*coefficients)
    return row if content in (0, 1) else {j: entry // content for j, entry in row.items()}


def _determinant(rows: list[list[Any]]) -> Any:
    """Up to its sign, by elimination without fractions [Bareiss 1968]; the rows are used up."""
    n = len(rows)
    previous = None
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if not rows[i][k].is_zero()), None)
        if pivot is None:
            return rows[k][k]
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i, j in product(range(k + 1, n), repeat=2):  # minors take the place of the entries below
            check_time()
            minor = _counted_product(rows[k][k], rows[i][j]) - _counted_product(rows[i][k], rows[k][j])
            rows[i][j] = minor if previous is None else minor // previous
        previous = rows[k][k]
    return rows[-1][-1]


#: The degree of a hypersurface in its parameter up to which roots are looked for in its field.  With the degree 4 the equation
#: of Regge and Wheeler takes 2.1 s rather than 0.8 s, and a solution fills a page.
_LARGEST_SURFACE_DEGREE = 2


@dataclass(frozen=True)
class LocalPart:
    """The part of theta at a point: exponent/u - main(1/u)/u^2 with u = x - c, the `factor`.

    At infinity, where the factor is None, it is main(x), and the exponent is that of 1/x.
    """

    factor: Poly | None
    exponent: Poly
    main: Poly

    @property
    def theta(self) -> RatFunc:
        if self.factor is None:
            return RatFunc(self.main)
        inverse = RatFunc(self.exponent * 0 + 1, self.factor)
        return inverse * self.exponent - RatFunc(self.main)(inverse) * inverse * inverse


@dataclass(frozen=True)
class ChosenExponents:
    """A choice of exponents at each singular point of the `problem`; the points are rational over the `field`."""

    problem: Problem
    field: Field
    parts: tuple[LocalPart, ...]

    @property
    def degree(self) -> Poly:
        """The degree of P, by Fuchs' relation."""
        return 1 - sum((part.exponent for part in self.parts), self.field.zero)

    @property
    def operator(self) -> tuple[Poly, Poly, Poly]:
        """D, 2 R and (R' D - R D' + R^2 - T)/D for theta = R/D: the coefficients of P'', P' and P."""
        D, T = self.problem.D.over(self.field), self.problem.T.over(self.field)
        R = (sum((part.theta for part in self.parts), RatFunc(0 * D)) * D).num
        return D, 2 * R, (R.derivative() * D - R * D.derivative() + R * R - T) // D

    def images(self, d: int) -> list[Poly]:
        """The images of 1, x, ..., x^d under the operator."""
        second, first, zeroth = self.operator
        found = []
        for k in range(d + 1):
            check_time()
            P = self.field.poly([0] * k + [1])
            found.append(second * P.derivative().derivative() + first * P.derivative() + zeroth * P)
        return found

    def conditions(self, d: int, below: Field) -> RankConditions:
        """The condition for a polynomial P of this degree, over the field below.

        The map is linear over each field below, from the basis of the extension times 1, x, ...; for each power of x the
        coordinates of an image follow one another in one polynomial.
        """
        images = self.images(d)
        level = self.field
        while level != below:
            assert isinstance(level, AlgebraicField)
            members = [image * level.generator**k for image in images for k in range(level.dimension)]
            level = level.base
            images = [level.poly([part[k] for k in range(one.degree + 1) for part in one.parts]) for one in members]
        return rank_conditions(images, below)


def degrees_of_solutions(problem: Problem) -> Numbers | None:
    """The degrees of P in exp(int theta) P; None if different exponents at conjugate points need too large an extension."""
    apart = with_points_apart(problem)
    if apart is None:
        return None
    roots: list[ExponentRoot] = []
    singular = singular_places(apart)
    for place in singular:
        square = _difference_squared(place)
        roots += [ExponentRoot(square / 4, 1)] * place.degree if square else []
    weights = sum(place.weight * place.degree for place in singular)
    return Numbers(1 - Fraction(weights) / 2, tuple(roots), apart.field, problem.field, only_signs=True)


def zeros_of_forms(problem: Problem, m: int) -> Numbers | None:
    """The numbers of zeros of rational forms of an even degree m; None if some place leaves none, and as for solutions."""
    apart = with_points_apart(problem)
    if apart is None:
        return None
    roots: list[ExponentRoot] = []
    room = m
    for place in apart.places:
        if place.kind is Kind.REGULAR and rational_number(place.difference_squared) is None:
            largest = m // 2 * place.degree
            roots.append(ExponentRoot(place.difference_squared, largest))
            room -= largest
            continue
        valuation = least_invariant_valuation(place, m, logarithms=False)
        if valuation is None:
            return None
        room -= valuation * place.degree
    return Numbers(Fraction(room), tuple(roots), apart.field, problem.field)


def _difference_squared(place: Place) -> Poly:
    """The square of the exponent difference at a singular place: a constant if it is the same at conjugate points."""
    return place.difference_squared if place.kind is Kind.REGULAR else irregular_difference_squared(place)


def choices_of_degree(problem: Problem, d: int) -> list[ChosenExponents] | None:
    """The choices that give P this degree; None if there are too many, or their roots need too large an extension."""
    choices = exponent_choices(problem)
    if choices is None:
        return None
    chosen = (ChosenExponents(choices.problem, choices.field, parts) for parts in product(*choices.parts))
    return [exponents for exponents in chosen if rational_number(exponents.degree) == d]


def conditions_of_degree(problem: Problem, d: int) -> list[RankConditions]:
    """For each choice that gives P this degree, where such a P exists, over the field of the problem; open without choices."""
    chosen = choices_of_degree(problem, d)
    return [NOT_COMPUTED] if chosen is None else [exponents.conditions(d, problem.field) for exponents in chosen]


@dataclass(frozen=True)
class PossibleExponents:
    """One or two choices at each singular point, rational over the field."""

    problem: Problem
    field: Field
    parts: list[list[LocalPart]]


def exponent_choices(problem: Problem) -> PossibleExponents | None:
    """The choices, which differ by the sign of a root: the exponent difference, or the root of a leading coefficient.

    None if there are too many, or they need too large an extension.
    """
    points = sum(place.degree for place in singular_places(problem))
    is_too_large = problem.field.ground != QQ and problem.field.absolute_degree > _LARGEST_SURFACE_DEGREE
    if is_too_large or 2**points > MOST_TRIALS:
        return None
    largest = problem.budget.limits.constants * problem.field.absolute_degree
    split = problem  # over an extension over which its singular points are rational
    while factor := next((place.factor for place in split.finite_places if place.degree > 1), None):
        if split.field.absolute_degree * factor.degree > largest:
            return None
        split = _with_root_of(factor, split)
    singular = singular_places(split)
    field = split.field
    roots: list[Poly] = []
    for place in singular:
        square = place.difference_squared if place.kind is Kind.REGULAR else _at_infinity(place, split.S).lc
        root = adjoined_square_root(field, square.over(field), as_radical=True)
        field = root.field
        if field.absolute_degree > largest:
            return None
        roots.append(root)
    S = RatFunc(split.S.num.over(field), split.S.den.over(field), reduced=True)
    parts = [_parts_at(place, S, root.over(field)) for place, root in zip(singular, roots, strict=True)]
    return PossibleExponents(split, field, parts)


def singular_places(problem: Problem) -> list[Place]:
    return [place for place in problem.places if place.kind is not Kind.ORDINARY]


def _with_root_of(factor: Poly, problem: Problem) -> Problem:
    """The problem over an extension in which an irreducible factor of its denominator has a root."""
    if factor.degree == 2:
        square = factor[1] * factor[1] - 4 * factor[0]
        extension = adjoined_square_root(problem.field, square, as_radical=True).field
    else:
        extension = AlgebraicField(problem.field, factor, "point")
    S = RatFunc(problem.S.num.over(extension), problem.S.den.over(extension), reduced=True)
    return analyse(S, problem.budget)


def with_points_apart(problem: Problem) -> Problem | None:
    """The problem, over a quadratic extension if exponents differ at two conjugate points; None if at more of them."""
    conjugate = [place for place in singular_places(problem) if place.degree > 1 and place.kind is not Kind.RAMIFIED]
    if all(_difference_squared(place).degree <= 0 for place in conjugate):
        return problem
    return _with_root_of(conjugate[0].factor, problem) if [place.degree for place in conjugate] == [2] else None


def _at_infinity(place: Place, S: RatFunc) -> Poly:
    """The polynomial part of z S(z), where v'' = S(z) v is the equation in a coordinate in which the place is infinity."""
    x = S.field.x
    if not place.at_infinity:  # v(z) = z y(c + 1/z)
        S = S(RatFunc(1 - place.factor[0] * x, x)) / RatFunc(x**4)
    return S.num * x // S.den


def _parts_at(place: Place, S: RatFunc, root: Poly) -> list[LocalPart]:
    """The two local parts of theta; one if the exponents are equal."""
    x = root.field.x
    factor = None if place.at_infinity else place.factor.over(root.field)
    if place.kind is Kind.REGULAR:
        signs = (1, -1) if root else (1,)
        return [LocalPart(factor, (1 + sign * root) / 2, 0 * x) for sign in signs]
    n = place.order // 2 - 2
    quotient = _at_infinity(place, S)
    main = root * x**n  # S - main^2 = b x^(n-1) + ..., and omega = +-main + e/x + ... with e = (+-b/a - n)/2
    for k in range(1, n + 1):
        rest = quotient - x * main * main
        main = main + rest[2 * n - k + 1] / (2 * root) * x ** (n - k)
    ratio = (quotient - x * main * main)[n] / root
    return [LocalPart(factor, 1 - (sign * ratio - n) / 2, sign * main) for sign in (1, -1)]


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically, with or without logarithms.

    There the images of 1, x, ..., x^N under P -> A_(m+1) span less.
    """
    bound = bounds(problem, m, logarithms=False)
    if bound is None:
        return RankConditions()
    valuations, N = bound
    x = problem.field.x
    R0 = singular_part(problem, valuations[:-1])
    images = [Form(m, R0, x**j).numerators(problem)[-1] for j in range(N + 1)]
    return replace(rank_conditions(images, problem.field), deficient=False)

"""At which values of the parameters does the rank of a matrix over Q[t] drop?

Where the generic rank is r, it drops exactly at the common zeros of the r-minors.  Random combinations of the minors (by the
theorem of Cauchy and Binet, determinants of U M V) vanish there too, so that their common factors contain every such value;
which of these values really are special is for the engine to say.  First the constant entries are used as pivots, which
changes a rank by the same number at all values.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import chain, combinations, product
from math import comb, gcd, lcm
from operator import mul
from random import Random
from typing import Any, NamedTuple

from flint import fmpz_mat, nmod_mat, nmod_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.lifting import primes
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.sparse import by_power
from kovacic.errors import LimitExceeded
from kovacic.limits import bounded_work, check_time, count_work
from kovacic.parametric.functions import element, in_field, irreducible_factors, over_parameters

#: Determinants whose common factors are taken, and minors up to which all of them are computed.
_DETERMINANTS = 3
_MINORS = 60
_PRIME = 2**61 - 1
#: Products of terms for the determinants of one matrix: those of some seconds.
_WORK = 10**7


def _product(first: Any, second: Any) -> Any:
    """Counted as work."""
    count_work(len(first) * len(second))
    return first * second


@dataclass(frozen=True)
class RankConditions:
    """Where a rank drops: where one of the irreducible `polynomials` vanishes, or all of the `system`.

    The system is empty where that happens nowhere else, and None where it wasn't computed.  `deficient`: the images are
    linearly dependent for all values.
    """

    polynomials: tuple[FunctionPoly, ...] = ()
    system: tuple[FunctionPoly, ...] | None = ()
    deficient: bool = False


def has_kernel(images: Sequence[Poly]) -> bool:
    """Are polynomials over Q linearly dependent?

    A rank modulo a prime can only be smaller: where it is full there, it is full.
    """
    count = len(images)
    width = max((image.degree for image in images), default=-1) + 1
    if width < count:
        return True
    rows = []
    for image in images:  # the coefficients of a multiple, padded
        coefficients = image.rational_coefficients()
        common = lcm(*(int(c.q) for c in coefficients))
        numbers = [int(c.p) * (common // int(c.q)) for c in coefficients]
        rows.append([*numbers, *[0] * (width - len(numbers))])
    residues = [entry % _PRIME for entry in chain.from_iterable(rows)]
    if nmod_mat(count, width, residues, _PRIME).rank() == count:
        return False
    return bool(fmpz_mat(rows).rank() < count)


def rank_conditions(images: Sequence[Poly], field: Field) -> RankConditions:
    """Where do polynomials span less than generically, over Q(t) or, on a hypersurface in parameter space, over its field?

    On a hypersurface the algebraic parameter is one more parameter, and the conditions are said modulo its equation.
    """
    surface = None
    if isinstance(field, AlgebraicField):
        surface = _Surface.of(field)
        images = [surface.lifted(image) for image in images]
        field = surface.field
    assert isinstance(field, FunctionField)
    try:
        with bounded_work(_WORK):
            return _conditions(images, field, surface)
    except LimitExceeded as limit:
        if limit.limit != "work":
            raise
        return RankConditions(system=None)


def _conditions(images: Sequence[Poly], field: FunctionField, surface: _Surface | None) -> RankConditions:
    """By the gcd of the minors where that says all, or else by all of them, if there aren't too many."""
    matrix = _Matrix.of(images, field, surface)
    if matrix.rank == 0:
        return RankConditions(deficient=matrix.deficient)
    has_one_parameter = surface is None and len(field.names) == 1
    if matrix.is_square or has_one_parameter:
        return matrix.common_factors()
    if matrix.has_many_minors:
        polynomials: tuple[FunctionPoly, ...] = ()
        if surface is None:
            polynomials = matrix.common_factors().polynomials
        return RankConditions(polynomials, None, matrix.deficient)
    minors = matrix.minors()
    if surface is not None:
        return RankConditions((), tuple(element(field, minor) for minor in minors), matrix.deficient)
    return matrix.common_zeros(minors)


@dataclass(frozen=True)
class _Matrix:
    """Rows over Z[t] without constant pivots, their generic rank, and whether the images they are from are `deficient`."""

    field: FunctionField
    rows: list[list[Any]]
    rank: int
    deficient: bool

    @classmethod
    def of(cls, images: Sequence[Poly], field: FunctionField, surface: _Surface | None) -> _Matrix:
        """That of the images, each row once."""
        # By powers of x, without denominators.
        smaller = without_constant_pivots([by_power(over_parameters(image).num, 0) for image in images])
        different: dict[tuple[str, ...], list[Any]] = {}
        for row in smaller.rows:  # with coprime coefficients, the leading one positive
            sign = 1 if int(next(filter(None, row)).leading_coefficient()) > 0 else -1
            normalised = [sign * entry for entry in _primitive(dict(enumerate(row))).values()]
            different.setdefault(tuple(map(str, normalised)), normalised)
        rows = [*different.values()]
        rank = 0
        if rows:  # at a random point: a lower bound, and the generic rank but for a probability of about 1/_PRIME
            p, point = _random_point(field, surface)
            residues = [int(entry(0, *point)) % p for entry in chain.from_iterable(rows)]
            rank = int(nmod_mat(len(rows), len(rows[0]), residues, p).rank())
        return cls(field, rows, rank, deficient=smaller.eliminated + rank < len(images))

    @property
    def is_square(self) -> bool:
        return len(self.rows) == len(self.rows[0]) == self.rank

    @property
    def has_many_minors(self) -> bool:
        """Are columns to be chosen, too, or more than `_MINORS` choices of rows?"""
        return self.rank < len(self.rows[0]) or comb(len(self.rows), self.rank) > _MINORS

    def minors(self) -> list[Any]:
        """Those of the size of the rank that don't vanish, for a rank that is the number of columns."""
        found = []
        for chosen in combinations(self.rows, self.rank):
            minor = _determinant([[*row] for row in chosen])
            if not minor.is_zero():
                found.append(minor)
        return found

    def common_factors(self) -> RankConditions:
        """The irreducible factors that all minors of the size of the rank have in common."""
        zero = self.field.context.constant(0)
        common = zero
        random = Random(20240229)
        determinants = 1 if self.is_square else _DETERMINANTS
        for _ in range(determinants):
            check_time()
            determinant = _determinant(_mixed(self.rows, self.rank, random, zero))
            if determinant.is_constant() and not determinant.is_zero():
                return RankConditions(deficient=self.deficient)
            common = common.gcd(determinant)
        return RankConditions(tuple(irreducible_factors(element(self.field, common))), deficient=self.deficient)

    def common_zeros(self, minors: list[Any]) -> RankConditions:
        """Common factors, and the system of what is left of the minors, without powers."""
        common = reduce(lambda a, b: a.gcd(b), minors)
        factors = tuple(irreducible_factors(element(self.field, common)))
        products: dict[FunctionPoly, None] = {}
        for minor in minors:
            check_time()
            parts = irreducible_factors(element(self.field, minor // common))
            if not parts:
                return RankConditions(factors, deficient=self.deficient)
            products[reduce(mul, parts)] = None
        shortest_first = sorted(products, key=lambda function: (len(function.num), str(function)))
        return RankConditions(factors, tuple(shortest_first), self.deficient)


@dataclass(frozen=True)
class _Surface:
    """A hypersurface: `field` has its algebraic parameter as the last one, and `equation` vanishes on it."""

    field: FunctionField
    equation: Any

    @classmethod
    def of(cls, field: AlgebraicField) -> _Surface:
        base = field.base
        assert isinstance(base, FunctionField)
        larger = FunctionField((*base.names, field.name))
        modulus = in_field(over_parameters(field.modulus), larger)
        return cls(larger, over_parameters(modulus(larger.generator(field.name))).num)

    def lifted(self, image: Poly) -> FunctionPoly:
        """The polynomial of the lowest degree in the algebraic parameter that is equal to the image there."""
        last = self.field.generator(self.field.names[-1])
        total = self.field.poly([])
        for power, part in enumerate(image.parts):
            total = total + in_field(over_parameters(part), self.field) * last**power
        return over_parameters(total)

    def values_of_last(self, others: Sequence[int], p: int) -> list[int]:
        """The values modulo p of the algebraic parameter, where the others have these."""
        parts = by_power(self.equation, len(others) + 1)
        coefficients = [0] * (max(parts) + 1)
        for k, part in parts.items():
            coefficients[k] = int(part(0, *others, 1)) % p
        return [int(root) for root, _ in nmod_poly(coefficients, p).roots()]


def _random_point(field: FunctionField, surface: _Surface | None) -> tuple[int, list[int]]:
    """A prime, and values of the parameters modulo the prime, on the surface if there is one."""
    random = Random(1)
    for p in primes():  # a surface such as a^2 + 1 = 0 has points for every other one
        check_time()
        point = [random.randrange(p) for _ in field.names]
        if surface is None:
            return p, point
        last = surface.values_of_last(point[:-1], p)
        if last:
            return p, [*point[:-1], last[0]]
    raise AssertionError("the sequence of primes is infinite")


class WithoutPivots(NamedTuple):
    """A matrix whose rank is smaller than that of another one, by the number of rows that were `eliminated`."""

    rows: list[list[Any]]
    eliminated: int


def without_constant_pivots(columns: list[dict[int, Any]]) -> WithoutPivots:
    """A smaller matrix, without zero rows and columns, and by how much its rank is smaller.

    The columns are given by their entries.  A constant entry clears its column, and its row and column are left out then;
    among them the one that touches the fewest entries is chosen [Markowitz 1957].  A matrix for a polynomial P is banded,
    so that this is the elimination of its coefficients by their recurrence.
    """
    entries: dict[int, dict[int, Any]] = {}
    for k, column in enumerate(columns):
        for i, entry in column.items():
            row = entries.setdefault(i, {})
            if entry:
                row[k] = entry
    rows = [entries[i] for i in sorted(entries)]
    eliminated = 0
    pivot = _constant_entry(rows)
    while pivot is not None:
        chosen = rows.pop(pivot.row)
        rows = [_cleared(row, pivot.column, chosen) if pivot.column in row else row for row in rows]
        eliminated += 1
        pivot = _constant_entry(rows)
    left = [row for row in rows if row]
    numbers = sorted(set().union(*left))
    zero = 0 * next(iter(left[0].values())) if left else 0
    return WithoutPivots([[row.get(k, zero) for k in numbers] for row in left], eliminated)


class _ConstantPivot(NamedTuple):
    """A constant entry; those with the smallest `cost` come first."""

    cost: int
    row: int
    column: int


def _constant_entry(rows: Sequence[dict[int, Any]]) -> _ConstantPivot | None:
    """The constant entry with the fewest others in its row times those in its column; None without any."""
    weights: Counter[int] = Counter()
    for row in rows:
        weights.update(row.keys())
    best: _ConstantPivot | None = None
    for i, row in enumerate(rows):
        for k, entry in row.items():
            if not entry.is_constant():
                continue
            pivot = _ConstantPivot(len(row) * weights[k], i, k)
            if best is None or pivot < best:
                best = pivot
    return best


def _cleared(row: dict[int, Any], k: int, chosen: dict[int, Any]) -> dict[int, Any]:
    """The row with its entry in column k cleared by the chosen one, without its content."""
    check_time()
    pivot = chosen[k]
    factor = row[k]
    combined: dict[int, Any] = {}
    for j in row.keys() | chosen.keys():
        if j == k:
            continue
        entry = _product(pivot, row[j]) if j in row else 0
        if j in chosen:
            entry = entry - _product(factor, chosen[j])
        if entry:
            combined[j] = entry
    return _primitive(combined)


def _primitive(row: dict[int, Any]) -> dict[int, Any]:
    """A multiple with coprime coefficients: otherwise pivots would grow exponentially."""
    content = 0
    for entry in row.values():
        content = gcd(content, *map(int, entry.coeffs()))
    if content <= 1:
        return row
    return {j: entry // content for j, entry in row.items()}


def _mixed(rows: list[list[Any]], rank: int, random: Random, zero: Any) -> list[list[Any]]:
    """U M V with random small integer matrices, of size rank."""
    for _ in range(2):
        if len(rows) > rank:
            weights = [[random.randint(-3, 3) for _ in rows] for _ in range(rank)]
            columns = [*zip(*rows, strict=True)]
            rows = [[sum(map(mul, line, column), zero) for column in columns] for line in weights]
        rows = [list(column) for column in zip(*rows, strict=True)]
    return rows


def _determinant(rows: list[list[Any]]) -> Any:
    """Up to its sign, by elimination without fractions [Bareiss 1968]; the rows are used up."""
    n = len(rows)
    previous = None
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if not rows[i][k].is_zero()), None)
        if pivot is None:
            return rows[k][k]
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i, j in product(range(k + 1, n), repeat=2):  # minors in the place of the entries below
            check_time()
            minor = _product(rows[k][k], rows[i][j]) - _product(rows[i][k], rows[k][j])
            rows[i][j] = minor if previous is None else minor // previous
        previous = rows[k][k]
    return rows[-1][-1]

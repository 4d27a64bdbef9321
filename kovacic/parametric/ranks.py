"""At which values of the parameters does the rank of a matrix over Q[t] drop?

Where the generic rank is r, it drops exactly at the common zeros of the r-minors.  Random combinations of the minors (by the
theorem of Cauchy and Binet, determinants of U M V) vanish there too, so that their common factors contain every such value;
which of these values really are special is for the engine to say.  First the constant entries are used as pivots, which
changes a rank by the same number at all values.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from math import gcd
from random import Random
from typing import Any

from flint import nmod_mat

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.sparse import by_power
from kovacic.engine.places import Problem
from kovacic.limits import check_time
from kovacic.parametric.functions import element, irreducible_factors, over_parameters

#: Determinants whose common factors are taken.
_DETERMINANTS = 3
_PRIME = 2**61 - 1
#: A sparse matrix: the entries that aren't zero, by row and column.
Sparse = dict[int, dict[int, Any]]


@dataclass(frozen=True)
class RankConditions:
    """Irreducible polynomials that vanish where a rank drops; `complete` False where it may drop elsewhere too.

    With several parameters the minors may have common zeros where their common divisor doesn't vanish, unless there is one
    minor only.  Where one unknown is left, the rank drops exactly at the common zeros of the `system`.  `deficient`: the
    polynomials are linearly dependent for all values.
    """

    polynomials: tuple[FunctionPoly, ...] = ()
    complete: bool = True
    system: tuple[FunctionPoly, ...] = ()
    deficient: bool = False


def rank_conditions(images: list[Poly], problem: Problem) -> RankConditions:
    """Where do the polynomials over Q(t), or the coordinates of those over an extension, span less than generically?"""
    field = problem.field
    assert isinstance(field, FunctionField)
    columns = []
    for image in images:
        check_time()
        columns.append(_column(image))
    rows, eliminated = without_constant_pivots(columns)
    rows = _distinct(rows)
    rank = _generic_rank(rows, field)
    deficient = eliminated + rank < len(images)
    if rank == 0:
        return RankConditions(deficient=deficient)
    single = len(rows) == len(rows[0]) == rank
    zero = common = field.context.constant(0)
    random = Random(20240229)
    for _ in range(1 if single else _DETERMINANTS):
        check_time()
        determinant = _determinant(_mixed(rows, rank, random, zero), field.context.constant(1))
        if determinant.is_constant() and not determinant.is_zero():
            return RankConditions(deficient=deficient)
        common = common.gcd(determinant)
    system = tuple(element(field, row[0]) for row in rows) if len(rows[0]) == 1 else ()
    complete = single or len(field.names) == 1
    return RankConditions(tuple(irreducible_factors(element(field, common))), complete, system, deficient)


def _distinct(rows: list[list[Any]]) -> list[list[Any]]:
    """The rows without multiples of others by a number."""
    known: dict[tuple[str, ...], list[Any]] = {}
    for row in rows:
        content = gcd(*(int(c) for entry in row for c in entry.coeffs()))
        leading = next(entry for entry in row if entry).leading_coefficient()
        reduced = [entry // (content if int(leading) > 0 else -content) for entry in row]
        known.setdefault(tuple(map(str, reduced)), reduced)
    return list(known.values())


def _column(image: Poly) -> dict[int, Any]:
    """The coefficients of the coordinates of a polynomial over Q(t) or an extension, without denominators."""
    leaves = [over_parameters(leaf) for leaf in image.leaves()]
    common = leaves[0].den
    for leaf in leaves[1:]:
        common = common * (leaf.den // common.gcd(leaf.den))
    return {
        power * len(leaves) + k: coefficient
        for k, leaf in enumerate(leaves)
        for power, coefficient in by_power(leaf.num * (common // leaf.den), 0).items()
    }


def without_constant_pivots(columns: list[dict[int, Any]]) -> tuple[list[list[Any]], int]:
    """A smaller matrix, without zero rows and columns, and by how much its rank is smaller.

    The columns are given by their entries.  A constant entry clears its column, and its row and column are left out then;
    among them the one that touches the fewest entries is chosen [Markowitz 1957].  A matrix for a polynomial P is banded,
    so that this is the elimination of its coefficients by their recurrence.
    """
    rows: Sparse = defaultdict(dict)
    for k, column in enumerate(columns):
        for i, entry in column.items():
            if entry:
                rows[i][k] = entry
    where: dict[int, set[int]] = defaultdict(set)
    for i, row in rows.items():
        for k in row:
            where[k].add(i)
    eliminated = 0
    while True:
        pivots = (
            (len(row) * len(where[k]), i, k)
            for i, row in rows.items()
            for k, entry in row.items()
            if entry.is_constant()
        )
        best = min(pivots, default=None)
        if best is None:
            break
        _, i, k = best
        _clear(rows, where, i, k)
        eliminated += 1
    used = sorted({k for row in rows.values() for k in row})
    zero = next((0 * entry for row in rows.values() for entry in row.values()), 0)
    return [[row.get(k, zero) for k in used] for _, row in sorted(rows.items()) if row], eliminated


def _clear(rows: Sparse, where: dict[int, set[int]], i: int, k: int) -> None:
    """Clear column k by the pivot in row i, and leave them out."""
    chosen = rows.pop(i)
    pivot = chosen.pop(k)
    for j in chosen:
        where[j].discard(i)
    for other in where.pop(k) - {i}:
        check_time()
        row = rows[other]
        factor = row.pop(k)
        for j in row:
            row[j] = row[j] * pivot
        for j, entry in chosen.items():
            value = row.pop(j, 0) - factor * entry
            where[j].discard(other)
            if value:
                row[j] = value
                where[j].add(other)
        _divide_by_content(row)


def _divide_by_content(row: dict[int, Any]) -> None:
    """Without it the pivots would grow exponentially."""
    content = 0
    for entry in row.values():
        content = gcd(content, *(int(c) for c in entry.coeffs()))
        if content == 1:
            return
    for j in row:
        row[j] = row[j] // content


def _generic_rank(rows: list[list[Any]], field: FunctionField) -> int:
    """A lower bound, and the rank itself but for a probability of about 1/_PRIME: the rank at a random point."""
    point = [Random(k).randrange(_PRIME) for k in range(len(field.names))]
    entries = [int(entry(0, *point)) % _PRIME for row in rows for entry in row]
    return int(nmod_mat(len(rows), len(rows[0]), entries, _PRIME).rank()) if rows else 0


def _mixed(rows: list[list[Any]], rank: int, random: Random, zero: Any) -> list[list[Any]]:
    """U M V with random small integer matrices, of size rank."""

    def combinations(vectors: list[list[Any]]) -> list[list[Any]]:
        if len(vectors) == rank:
            return vectors
        mixed = []
        for _ in range(rank):
            weights = [random.randint(-3, 3) for _ in vectors]
            columns = zip(*vectors, strict=True)
            mixed.append([sum((w * c for w, c in zip(weights, column, strict=True)), zero) for column in columns])
        return mixed

    half = combinations(rows)
    return combinations([list(column) for column in zip(*half, strict=True)])


def _determinant(matrix: list[list[Any]], one: Any) -> Any:
    """Up to its sign, by elimination without fractions [Bareiss 1968]."""
    rows = [list(row) for row in matrix]
    n, previous = len(rows), one
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if not rows[i][k].is_zero()), None)
        if pivot is None:
            return 0 * one
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                check_time()
                rows[i][j] = (rows[k][k] * rows[i][j] - rows[i][k] * rows[k][j]) // previous
        previous = rows[k][k]
    return rows[-1][-1]

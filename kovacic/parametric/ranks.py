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
from math import gcd
from operator import mul
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


def rank_conditions(images: Sequence[Poly], problem: Problem) -> RankConditions:
    """Where do the polynomials over Q(t), or the coordinates of those over an extension, span less than generically?"""
    field = problem.field
    assert isinstance(field, FunctionField)
    rows, eliminated = without_constant_pivots([*map(_column, images)])
    rows = [*{tuple(map(str, row)): row for row in map(_normalised, rows)}.values()]
    # The rank at a random point is a lower bound, and the generic rank but for a probability of about 1/_PRIME.
    point = [Random(k).randrange(_PRIME) for k in range(len(field.names))]
    entries = [int(entry(0, *point)) % _PRIME for row in rows for entry in row]
    rank = int(nmod_mat(len(rows), len(rows[0]), entries, _PRIME).rank()) if rows else 0
    deficient = eliminated + rank < len(images)
    if rank == 0:
        return RankConditions(deficient=deficient)
    single = len(rows) == len(rows[0]) == rank
    zero = common = field.context.constant(0)
    random = Random(20240229)
    for _ in range(1 if single else _DETERMINANTS):
        check_time()
        determinant = _determinant(_mixed(rows, rank, random, zero))
        if determinant.is_constant() and not determinant.is_zero():
            return RankConditions(deficient=deficient)
        common = common.gcd(determinant)
    system = tuple(element(field, row[0]) for row in rows) if len(rows[0]) == 1 else ()
    complete = single or len(field.names) == 1
    return RankConditions(tuple(irreducible_factors(element(field, common))), complete, system, deficient)


def _normalised(row: list[Any]) -> list[Any]:
    """The multiple by a number with coprime coefficients, the leading one positive."""
    reduced = _primitive(dict(enumerate(row)))
    sign = 1 if int(next(e for e in row if e).leading_coefficient()) > 0 else -1
    return [sign * entry for entry in reduced.values()]


def _column(image: Poly) -> dict[int, Any]:
    """The coefficients of the coordinates of a polynomial over Q(t) or an extension, without denominators."""
    check_time()
    leaves = [over_parameters(leaf) for leaf in image.leaves()]
    common = reduce(lambda m, leaf: m * (leaf.den // m.gcd(leaf.den)), leaves[1:], leaves[0].den)
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
    used = sorted({i for column in columns for i in column})
    rows = [{k: column[i] for k, column in enumerate(columns) if column.get(i)} for i in used]
    while True:
        weights = Counter(k for row in rows for k in row)
        places = (
            (len(row) * weights[k], i, k) for i, row in enumerate(rows) for k, e in row.items() if e.is_constant()
        )
        best = min(places, default=None)
        if best is None:
            break
        chosen = rows.pop(best[1])
        rows = [_cleared(row, best[2], chosen) if best[2] in row else row for row in rows]
    zero = next((0 * entry for row in rows for entry in row.values()), 0)
    left = sorted({k for row in rows for k in row})
    return [[row.get(k, zero) for k in left] for row in rows if row], len(used) - len(rows)


def _cleared(row: dict[int, Any], k: int, chosen: dict[int, Any]) -> dict[int, Any]:
    """The row with its entry in column k cleared by the chosen one, without its content."""
    check_time()
    pivot, factor = chosen[k], row[k]
    combined = {j: pivot * row.get(j, 0) - factor * chosen.get(j, 0) for j in row.keys() | chosen.keys() if j != k}
    return _primitive({j: entry for j, entry in combined.items() if entry})


def _primitive(row: dict[int, Any]) -> dict[int, Any]:
    """A multiple with coprime coefficients: otherwise pivots would grow exponentially."""
    content = gcd(*(int(c) for entry in row.values() for c in entry.coeffs()))
    return {j: entry // content for j, entry in row.items()} if content > 1 else row


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
    n, previous = len(rows), None
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if not rows[i][k].is_zero()), None)
        if pivot is None:
            return rows[k][k]
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                check_time()
                value = rows[k][k] * rows[i][j] - rows[i][k] * rows[k][j]
                rows[i][j] = value // previous if k else value
        previous = rows[k][k]
    return rows[-1][-1]

"""Elimination with constant pivots, which changes a rank by the same number at all values of the parameters."""

from __future__ import annotations

from collections import defaultdict
from math import gcd
from typing import Any

from kovacic.limits import Budget

#: A sparse matrix: the entries that aren't zero, by row and column.
Sparse = dict[int, dict[int, Any]]


def without_constant_pivots(columns: list[dict[int, Any]], budget: Budget) -> tuple[list[list[Any]], int]:
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
        _clear(rows, where, i, k, budget)
        eliminated += 1
    used = sorted({k for row in rows.values() for k in row})
    zero = next((0 * entry for row in rows.values() for entry in row.values()), 0)
    return [[row.get(k, zero) for k in used] for _, row in sorted(rows.items()) if row], eliminated


def _clear(rows: Sparse, where: dict[int, set[int]], i: int, k: int, budget: Budget) -> None:
    """Clear column k by the pivot in row i, and leave them out."""
    chosen = rows.pop(i)
    pivot = chosen.pop(k)
    for j in chosen:
        where[j].discard(i)
    for other in where.pop(k) - {i}:
        budget.check()
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


__all__ = ["without_constant_pivots"]

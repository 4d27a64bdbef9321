"""The constants C1, C2 that linear conditions determine: u C1 + v C2 = r for each condition, by rank.

The rank of the matrix with the rows (u, v) is 2 if a minor isn't zero, 1 if an entry isn't and all minors are; with the
column r it must be the same.  Then one solution, or a family with free constants; else there is none.  Where a minor is zero
for particular values of the parameters alone, the answer is the one for all others, and the particular case is said beside.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import combinations
from typing import Any

import sympy
from sympy import acos, atan, cos, cosh, exp, log, sin, sinh, tan, tanh
from sympy.simplify.fu import TR8, TR2i

from kovacic.general_solution.substitution import size
from kovacic.general_solution.zero import Zero, is_nowhere_zero, when_zero
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
#: Functions whose values are simplified, in constants of so many subexpressions.
_ELEMENTARY = {exp, log, sin, cos, tan, sinh, cosh, tanh, atan, acos}
_LONGEST = 200
#: The longest expression that is factored, in subexpressions, and the most symbols, functions and roots in it.
_LONGEST_FACTORED = 300
_MOST_ATOMS = 10
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)


@dataclass(frozen=True)
class Row:
    """u C1 + v C2 = r."""

    u: Expr
    v: Expr
    r: Expr

    def rest(self, c1: Expr, c2: Expr) -> Expr:
        """u c1 + v c2 - r."""
        return self.u * c1 + self.v * c2 - self.r


class Outcome(Enum):
    """One solution or a family; none; or what depends on more than the case says."""

    SOLUTIONS = "solutions"
    NONE = "none"
    OPEN = "open"


@dataclass(frozen=True)
class ParameterCase:
    """What the conditions determine where all of `zeros` are zero; without any, for generic values of the parameters.

    `values` are those of C1 and C2, in terms of the ones that stay free, where there are solutions; and there are only if
    all of `needed` are zero, too.
    """

    zeros: tuple[Expr, ...]
    outcome: Outcome
    values: tuple[Expr, Expr] = (sympy.Integer(0), sympy.Integer(0))
    needed: tuple[Expr, ...] = ()


def determine(
    rows: Sequence[Row], names: tuple[Expr, Expr], wronskian: Expr | None = None
) -> tuple[ParameterCase, list[ParameterCase]]:
    """The generic case and the particular ones.  `wronskian`: that at the point where both y and y' are given, in this order.

    Raises `NotImplementedError` where it can't be told whether a constant is zero.

    >>> k, C1, C2 = sympy.symbols("k C1 C2")
    >>> generic, others = determine([Row(1, 0, 0), Row(cos(k), sin(k), 0)], (C1, C2))
    >>> generic.values, others[0].zeros, others[0].values
    ((0, 0), (sin(k),), (0, C2))
    """
    minor, pair, when = _best_minor(rows, wronskian)
    if when is Zero.ALWAYS:
        return _split(*_of_rank_one(rows, names))
    generic, others = _split(*_of_rank_two(rows, pair, minor))
    if when is Zero.SOMETIMES:
        others.append(_where_minor_vanishes(rows, names, minor))
    return generic, others


Values = tuple[Expr, Expr]
#: Values of the constants, what must be zero for them to be a solution, and what must not be.
DeterminedConstants = tuple[Values, list[Expr], Expr]


def _best_minor(rows: Sequence[Row], wronskian: Expr | None) -> tuple[Expr, tuple[Row, Row], Zero]:
    """A minor and its rows: one that is never zero if there is one, else one that isn't always zero."""
    nothing = Row(_ZERO, _ZERO, _ZERO)
    best = _ZERO, (nothing, nothing), Zero.ALWAYS
    if wronskian is not None:
        return wronskian, (rows[0], rows[1]), Zero.NEVER
    undecided: NotImplementedError | None = None
    for first, second in combinations(rows, 2):
        minor = first.u * second.v - first.v * second.u
        try:
            when = when_zero(minor)
        except NotImplementedError as reason:
            undecided = reason
            continue
        if when is Zero.NEVER:
            return minor, (first, second), when
        if when is Zero.SOMETIMES and best[2] is Zero.ALWAYS:
            best = minor, (first, second), when
    if undecided is not None:
        raise undecided
    return best


def _of_rank_two(rows: Sequence[Row], pair: tuple[Row, Row], minor: Expr) -> DeterminedConstants:
    """Cramer's rule for two of the rows; the others must be satisfied."""
    first, second = pair
    c1 = tidy((first.r * second.v - first.v * second.r) / minor)
    c2 = tidy((first.u * second.r - first.r * second.u) / minor)
    others = [row for row in rows if row is not first and row is not second]
    return (c1, c2), [row.rest(c1, c2) for row in others], _ONE


def _of_rank_one(rows: Sequence[Row], names: Values) -> DeterminedConstants:
    """One equation for both constants; all rows must be multiples of it."""
    pivot = _pivot(rows)
    if pivot is None:
        return names, [row.r for row in rows], _ONE
    row, is_first = pivot
    others = [other for other in rows if other is not row]
    norm = _norm(row)
    if norm is not None:
        values = tidy(row.r * row.u / norm) + row.v * names[0], tidy(row.r * row.v / norm) - row.u * names[0]
        return values, [other.rest(*values).subs(names[0], 0) for other in others], _ONE
    if is_first:
        values = tidy(row.r / row.u) - tidy(row.v / row.u) * names[1], names[1]
        return values, [other.u * row.r - other.r * row.u for other in others], row.u
    values = names[0], tidy(row.r / row.v) - tidy(row.u / row.v) * names[0]
    return values, [other.v * row.r - other.r * row.v for other in others], row.v


def _norm(row: Row) -> Expr | None:
    """u^2 + v^2, where that is known not to be zero while u and v may be, each alone; else None."""
    if Zero.NEVER in (when_zero(row.u), when_zero(row.v)) or 0 in (row.u, row.v):
        return None
    norm = sympy.factor_terms(sympy.expand(TR8(sympy.expand(row.u**2 + row.v**2))))
    return norm if is_nowhere_zero(norm) else None


def _pivot(rows: Sequence[Row]) -> tuple[Row, bool] | None:
    """A row whose u (True) or v isn't zero, preferably never and without the other; None where all are zero."""
    found: list[tuple[bool, bool, int, Row, bool]] = []
    for row in rows:
        for entry, other, is_first in ((row.v, row.u, False), (row.u, row.v, True)):
            when = when_zero(entry)
            if when is not Zero.ALWAYS:
                found.append((when is not Zero.NEVER, other != 0, len(found), row, is_first))
    best = min(found, key=lambda item: item[:3], default=None)
    return None if best is None else (best[3], best[4])


def _split(values: Values, needed: list[Expr], pivot: Expr) -> tuple[ParameterCase, list[ParameterCase]]:
    """The generic case, and those of the parameters for which more is possible or less."""
    open_cases = [ParameterCase((pivot,), Outcome.OPEN)] if when_zero(pivot) is Zero.SOMETIMES else []
    whens = [(value, when_zero(value)) for value in needed]
    if any(when is Zero.NEVER for _, when in whens):
        return ParameterCase((), Outcome.NONE), open_cases
    sometimes = tuple(value for value, when in whens if when is Zero.SOMETIMES)
    if sometimes:  # generic parameters don't meet what only particular ones do
        return ParameterCase((), Outcome.NONE), [ParameterCase(sometimes, Outcome.SOLUTIONS, values), *open_cases]
    return ParameterCase((), Outcome.SOLUTIONS, values), open_cases


def _where_minor_vanishes(rows: Sequence[Row], names: Values, minor: Expr) -> ParameterCase:
    """The case of rank one, as far as it follows from the minor's being zero."""
    values, needed, pivot = _of_rank_one(rows, names)
    if len(rows) > 2 or when_zero(pivot) is Zero.SOMETIMES:
        return ParameterCase((minor,), Outcome.OPEN)
    generic, particular = _split(values, needed, pivot)
    if particular:
        return ParameterCase((minor,), Outcome.SOLUTIONS, values, particular[0].zeros)
    return ParameterCase((minor,), generic.outcome, values)


def condition_of(zero: Expr) -> str:
    """`zero = 0` in a short form: without factors that aren't zero."""
    left = vanishing_factors(zero)
    return f"{-left if left.could_extract_minus_sign() else left} = 0"


def can_be(case: ParameterCase) -> bool:
    """Are there factors that may be zero in all that is zero in a case?"""
    return all(vanishing_factors(zero) != 1 for zero in case.zeros)


def vanishing_factors(zero: Expr) -> Expr:
    """The factors that may be zero, each once; a long expression is taken with the factors that are seen."""
    factored = zero
    if size(zero) <= _LONGEST_FACTORED and len(_atoms_of(zero)) <= _MOST_ATOMS:
        whole = sympy.numer(sympy.together(zero))
        waves = sympy.expand(TR8(sympy.expand(whole)))
        factored = min(map(sympy.factor, (whole, waves)), key=size)
    found = []
    for factor in sympy.Mul.make_args(factored):
        if not is_nowhere_zero(factor):
            is_power = factor.is_Pow and factor.exp.is_positive
            found.append(factor.base if is_power else factor)
    return sympy.Mul(*found)


def _atoms_of(e: Expr) -> set[Expr]:
    """What SymPy takes for variables when it factors an expression."""
    powers = {power for power in e.atoms(sympy.Pow) if not power.exp.is_Integer}
    return {*e.free_symbols, *e.atoms(sympy.Function), *powers}


def tidy(value: Any) -> Any:
    """A shorter form of a constant, where that is known at once."""
    check_time()
    value = sympy.sympify(value, strict=True)
    if value.is_Rational or size(value) > _LONGEST or value.has(sympy.RootSum, sympy.Integral):
        return value
    if any(_is_irrational_power(p) for p in value.atoms(sympy.Pow)):
        return value
    functions = {f.func for f in value.atoms(sympy.Function)}
    is_number = not value.free_symbols
    if is_number and functions <= {exp, log} and not value.has(sympy.Add):  # a product of powers
        return value
    if not functions:
        has_terms = not is_number or value.has(sympy.E)
        return sympy.radsimp(sympy.cancel(value) if has_terms else sympy.expand(value))
    if not functions <= _ELEMENTARY:
        expanded = sympy.expand(value)
        return min((value, expanded, sympy.expand(TR8(expanded))), key=size)
    shorter = sympy.cancel(value)
    return shorter if functions == {exp} else min(map(TR2i, (value, shorter)), key=size)


def _is_irrational_power(power: Expr) -> bool:
    return not power.exp.is_Rational and not power.base.is_Symbol

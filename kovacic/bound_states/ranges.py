"""Conditions as they are read: n < A/a, l >= 1/2, in the place of -(2 n a - 2 A)/a > 0."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations
from typing import Any

import sympy

from kovacic.bound_states.energies import shortest
from kovacic.bound_states.signs import Signs


def tidied(conditions: Iterable[Any], signs: Signs, radicals: Mapping[Any, Any] | None = None) -> tuple[Any, ...]:
    """The conditions that don't hold anyway, each solved for n, or for a parameter, where it is linear in it.

    `radicals` are the square roots for which symbols stand: sqrt(a) >= 2 is written a >= 4, and then a >= 0 isn't.
    """
    meanings = dict(radicals or {})
    squares = {symbol: sympy.expand(root**2) for symbol, root in meanings.items()}
    roots = {symbol: square for symbol, square in squares.items() if not _radicals(square)}
    left = [c for c in dict.fromkeys(conditions) if signs.holds(c) is not True]
    found: list[Any] = []
    any_squared = False
    for condition in _paired(left, signs):
        squared = _squared(_solved(condition, signs), roots)
        if squared is None:
            found.append(_solved(condition, signs).xreplace(meanings))
        else:
            found.append(_solved(squared, signs))
            any_squared = True
    implied = {sympy.true}
    if any_squared:
        implied |= {_solved(sympy.Ge(square, 0), signs) for square in roots.values()}
    return _compared([c for c in dict.fromkeys(found) if c not in implied], signs)


def _compared(conditions: list[Any], signs: Signs) -> tuple[Any, ...]:
    """Without those that others imply; (False,) where two of them exclude each other."""
    implied: list[Any] = []
    for first, second in combinations(conditions, 2):
        if sympy.false in (first, second) or first.lhs != second.lhs:
            continue
        gap = first.rhs - second.rhs
        if _is_lower_bound(first) and _is_lower_bound(second):
            if signs.is_positive(gap):
                implied.append(second)
            elif signs.is_positive(-gap):
                implied.append(first)
        elif _is_lower_bound(first):
            if signs.is_positive(gap):
                return (sympy.false,)
        elif _is_lower_bound(second) and signs.is_positive(-gap):
            return (sympy.false,)
    return tuple(c for c in conditions if c not in implied)


def _is_lower_bound(condition: Any) -> bool:
    return isinstance(condition, sympy.StrictGreaterThan | sympy.GreaterThan)


def _radicals(expression: Any) -> set[Any]:
    return {power for power in expression.atoms(sympy.Pow) if not power.exp.is_Integer and power.base.free_symbols}


def _squared(condition: Any, roots: Mapping[Any, Any]) -> Any:
    """r > c, c >= 0 a number, as r^2 > c^2; None for another condition."""
    if condition in (sympy.true, sympy.false) or condition.lhs not in roots or not condition.rhs.is_number:
        return None
    if condition.rhs.is_negative or not _is_lower_bound(condition):
        return None
    return condition.func(roots[condition.lhs], condition.rhs**2)


def _paired(conditions: list[Any], signs: Signs) -> list[Any]:
    """s + t > 0 and s - t > 0 as s > sqrt(|s t|), where s t doesn't depend on n: s > 0, and s^2 > |s t| means s > |t|."""
    for first, second in combinations(conditions, 2):
        one, other = (condition.gts - condition.lts for condition in (first, second))
        if not (isinstance(first, sympy.StrictGreaterThan) and one.has(signs.n) and other.has(signs.n)):
            continue
        half = sympy.simplify((one + other) / 2)
        product = sympy.simplify(half * (one - other) / 2)
        if product.has(signs.n) or sympy.degree(sympy.numer(sympy.together(half)), signs.n) != 1:
            continue
        sign = signs.sign(product)
        size = sympy.Abs(product) if sign is None else sign * product
        together = sympy.StrictGreaterThan(half, sympy.sqrt(sympy.factor(size)))
        return _paired([together, *(c for c in conditions if c not in (first, second))], signs)
    return conditions


def _solved(condition: Any, signs: Signs) -> Any:
    if condition in (sympy.true, sympy.false) or (condition.has(sympy.Abs) and not condition.has(signs.n)):
        return condition
    strict = isinstance(condition, sympy.StrictGreaterThan | sympy.StrictLessThan)
    greater = sympy.StrictGreaterThan if strict else sympy.GreaterThan
    less = sympy.StrictLessThan if strict else sympy.LessThan
    rest = _without_signs(condition.gts - condition.lts, signs)
    number, factor = rest.as_coeff_Mul()
    base, exponent = factor.as_base_exp()
    if strict and exponent == -1:  # 1/p > 0 where p > 0
        rest = sympy.expand(number * base)
    for unknown in (signs.n, *sorted(rest.free_symbols - {signs.n}, key=str)):
        if not rest.is_polynomial(unknown) or sympy.degree(rest, unknown) != 1:
            continue
        slope = rest.coeff(unknown, 1)
        sign = signs.sign(slope)
        if sign is not None:
            bound = shortest(sympy.factor(-rest.coeff(unknown, 0) / slope))
            return greater(unknown, bound) if sign == 1 else less(unknown, bound)
    if rest.is_polynomial(signs.n) and sympy.degree(rest, signs.n) == 2:
        return _square(rest, signs, greater, less)
    return greater(rest, 0)


def _without_signs(difference: Any, signs: Signs) -> Any:
    """With the signs in the place of the factors whose signs are known."""
    rest = sympy.Integer(1)
    for factor in sympy.Mul.make_args(sympy.factor(sympy.together(difference))):
        sign = signs.sign(factor)
        rest *= factor if sign is None else sign
    return sympy.expand(rest)


def _square(rest: Any, signs: Signs, greater: Any, less: Any) -> Any:
    """c (n + h)^2 + k > 0 as (n + h)^2 < -k/c."""
    c, b, k = (rest.coeff(signs.n, i) for i in (2, 1, 0))
    sign = signs.sign(c)
    if sign is None:
        return greater(rest, 0)
    square = (signs.n + shortest(sympy.factor(b / (2 * c)))) ** 2
    bound = shortest(sympy.factor((b**2 / (4 * c) - k) / c))
    return greater(square, bound) if sign == 1 else less(square, bound)

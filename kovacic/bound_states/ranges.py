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
    # Not those with a root of what depends on parameters.
    squares = {
        symbol: square for symbol, square in squares.items() if square.is_rational_function(*square.free_symbols)
    }
    left = [c for c in dict.fromkeys(conditions) if signs.holds(c) is not True]
    found = []
    implied = {sympy.true}
    for condition in _paired(left, signs):
        solved = _solved(condition, signs)
        squared = _squared(solved, squares)
        if squared is None:
            found.append(solved.xreplace(meanings))
        else:
            found.append(_solved(squared, signs))
            implied |= {_solved(sympy.Ge(square, 0), signs) for square in squares.values()}
    return _compared([c for c in dict.fromkeys(found) if c not in implied], signs)


def _compared(conditions: list[Any], signs: Signs) -> tuple[Any, ...]:
    """Without lower bounds that others imply; (False,) where a lower bound excludes an upper one."""
    left = [*conditions]
    for first, second in combinations(conditions, 2):
        if sympy.false in (first, second) or first.lhs != second.lhs:
            continue
        sign = signs.sign(first.rhs - second.rhs)
        match _is_lower_bound(first), _is_lower_bound(second):
            case True, True if sign is not None:
                left = [c for c in left if c is not (second if sign == 1 else first)]
            case (True, False) if sign == 1:
                return (sympy.false,)
            case (False, True) if sign == -1:
                return (sympy.false,)
    return tuple(left)


def _is_lower_bound(condition: Any) -> bool:
    return isinstance(condition, sympy.StrictGreaterThan | sympy.GreaterThan)


def _squared(condition: Any, squares: Mapping[Any, Any]) -> Any:
    """r > c, c >= 0 a number, as r^2 > c^2, r a symbol for a root with one of the squares; None for another condition."""
    if not _is_lower_bound(condition) or condition.lhs not in squares:
        return None
    bound = condition.rhs
    if not bound.is_number or bound.is_negative:
        return None
    return condition.func(squares[condition.lhs], bound**2)


def _paired(conditions: list[Any], signs: Signs) -> list[Any]:
    """The conditions, with each two that `_pair` says in one."""
    for first, second in combinations(conditions, 2):
        together = _pair(first, second, signs)
        if together is not None:
            others = [c for c in conditions if c not in (first, second)]
            return _paired([together, *others], signs)
    return conditions


def _pair(first: Any, second: Any, signs: Signs) -> Any:
    """s + t > 0 and s - t > 0 as s > sqrt(|s t|), where s t doesn't depend on n: s > 0, and s^2 > |s t| means s > |t|.

    None for other conditions.
    """
    n = signs.n
    if not isinstance(first, sympy.StrictGreaterThan):
        return None
    total = first.gts - first.lts
    difference = second.gts - second.lts
    if not (total.has(n) and difference.has(n)):
        return None
    s = sympy.simplify((total + difference) / 2)
    st = sympy.simplify(s * (total - difference) / 2)
    if st.has(n) or sympy.degree(sympy.numer(sympy.together(s)), n) != 1:
        return None
    sign = signs.sign(st)
    size = sympy.Abs(st) if sign is None else sign * st
    return sympy.StrictGreaterThan(s, sympy.sqrt(sympy.factor(size)))


def _solved(condition: Any, signs: Signs) -> Any:
    """The condition for n, or else for a parameter, where it is linear in it; for (n + h)^2 where it is quadratic in n."""
    n = signs.n
    if condition in (sympy.true, sympy.false):
        return condition
    if condition.has(sympy.Abs) and not condition.has(n):
        return condition
    is_strict = isinstance(condition, sympy.StrictGreaterThan | sympy.StrictLessThan)
    rest = sympy.Integer(1)  # with the signs in the place of factors whose signs are known
    for factor in sympy.Mul.make_args(sympy.factor(sympy.together(condition.gts - condition.lts))):
        rest *= signs.sign(factor) or factor
    rest = sympy.expand(rest)
    number, factor = rest.as_coeff_Mul()
    base, exponent = factor.as_base_exp()
    if is_strict and exponent == -1:  # c p in the place of c/p, which is positive where that is
        rest = sympy.expand(number * base)
    parameters = sorted(rest.free_symbols - {n}, key=str)
    for unknown in (n, *parameters):
        solved = _solved_for(unknown, rest, signs, is_strict=is_strict)
        if solved is not None:
            return solved
    if _degree(rest, n) == 2:
        return _solved_for_square(rest, signs, is_strict=is_strict)
    return _beyond(shortest(rest), 0, 1, is_strict=is_strict)


def _solved_for(unknown: Any, rest: Any, signs: Signs, *, is_strict: bool) -> Any:
    """rest > 0, or >= 0, for an unknown in which it is linear with a slope of a known sign; None for another one."""
    if _degree(rest, unknown) != 1:
        return None
    slope = rest.coeff(unknown, 1)
    sign = signs.sign(slope)
    if sign is None:
        return None
    bound = shortest(sympy.factor(-rest.coeff(unknown, 0) / slope))
    return _beyond(unknown, bound, sign, is_strict=is_strict)


def _degree(expression: Any, unknown: Any) -> Any:
    """The degree as a polynomial in the unknown, None for anything else."""
    return sympy.degree(expression, unknown) if expression.is_polynomial(unknown) else None


def _beyond(unknown: Any, bound: Any, sign: int, *, is_strict: bool) -> Any:
    """unknown > bound for the sign 1, unknown < bound for -1; or >= and <=."""
    return sympy.Rel(unknown, bound, (">" if sign == 1 else "<") + ("" if is_strict else "="))


def _solved_for_square(rest: Any, signs: Signs, *, is_strict: bool) -> Any:
    """c n^2 + b n + k > 0 as (n + b/(2 c))^2 < (b^2/(4 c) - k)/c for c < 0, and > for c > 0."""
    n = signs.n
    c = rest.coeff(n, 2)
    b = rest.coeff(n, 1)
    k = rest.coeff(n, 0)
    sign = signs.sign(c)
    if sign is None:
        return _beyond(rest, 0, 1, is_strict=is_strict)
    square = (n + shortest(sympy.factor(b / (2 * c)))) ** 2
    bound = shortest(sympy.factor((b**2 / (4 * c) - k) / c))
    return _beyond(square, bound, sign, is_strict=is_strict)

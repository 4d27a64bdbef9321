"""Conditions on unknown functions: every boundary and initial value of the package is read here.

A condition is linear, sum of c_k y^(m_k)(a_k) = v with m_k = 0 or 1: initial and boundary values, periodic conditions
y(0) = y(2 pi), Robin's y'(0) = h y(0).  At a singular point, and at oo and -oo, y(a) = v says that y tends to v there, and
y(a) = "bounded" that it stays bounded.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import sympy
from sympy import S, Symbol, Tuple, oo
from sympy.core.function import AppliedUndef

from kovacic.errors import InputError
from kovacic.general_solution.behaviour import value_or_limit
from kovacic.general_solution.substitution import exact_decimals
from kovacic.numbers.exact import exact_real, exact_text, is_complex
from kovacic.numbers.numerals import plain_text
from kovacic.reading.lexer import error_at
from kovacic.reading.pieces import Paste, conditions_in
from kovacic.reading.symbolic import read_expression

Expr = Any  # SymPy publishes no types
#: The word that may stand in the place of a value.
BOUNDED = "bounded"


class ConditionTerm(NamedTuple):
    """coefficient * y(point), or coefficient * y'(point) for order 1."""

    point: Expr
    order: int
    coefficient: Expr


@dataclass(frozen=True)
class Condition:
    """The sum of the terms, of a function y(x), is `value`, or bounded if that is None."""

    function: Expr
    terms: tuple[ConditionTerm, ...]
    value: Expr | None
    text: str

    @property
    def points(self) -> tuple[Expr, ...]:
        return tuple(term.point for term in self.terms)

    def in_symbols(self, others: Mapping[Expr, Expr]) -> Condition:
        """The condition in other symbols."""
        terms = (ConditionTerm(a.xreplace(others), order, c.xreplace(others)) for a, order, c in self.terms)
        value = self.value and self.value.xreplace(others)
        return replace(self, function=self.function.xreplace(others), terms=tuple(terms), value=value)

    def of(self, y: Expr, x: Expr) -> Expr:
        """The sum of the terms for a function of x.  Raises `NotImplementedError` as `value_or_limit` does."""
        return sympy.Add(*(term.coefficient * value_or_limit(y, x, term.point, term.order) for term in self.terms))

    @property
    def is_value(self) -> bool:
        """True for y(a) = v and y'(a) = v."""
        return len(self.terms) == 1 and self.terms[0].coefficient == 1 and self.value is not None

    @property
    def by_order(self) -> tuple[Expr, Expr]:
        """alpha and beta, where the terms are alpha y + beta y' at one point."""
        parts = [S.Zero, S.Zero]
        for term in self.terms:
            parts[term.order] += term.coefficient
        return parts[0], parts[1]


def symbols_of(conditions: Iterable[Condition]) -> set[Expr]:
    """The symbols in points, coefficients and values."""
    return set().union(*(Tuple(*condition.terms, condition.value or 0).free_symbols for condition in conditions))


def conditions_at(values: Mapping[Expr, Expr], conditions: Iterable[Condition]) -> dict[Expr, Any]:
    """Conditions as for `dsolve`, for particular values of letters.  Raises `InputError` for two on one value."""
    found: dict[Expr, Any] = {}
    for condition in conditions:
        y, (x,) = condition.function, condition.function.args
        left = sympy.Add(*(c * y.diff(x, order).subs(x, a) for a, order, c in condition.terms)).subs(values)
        if left in found:
            raise InputError(f"two values are given for {left}")
        found[left] = BOUNDED if condition.value is None else condition.value.subs(values)
    return found


def periodicity(conditions: Sequence[Condition], ends: tuple[Expr, Expr]) -> int:
    """1 for y(a) = y(b), y'(a) = y'(b), -1 for y(a) = -y(b), y'(a) = -y'(b), and 0 for other conditions."""
    factors = {}
    for condition in conditions:
        orders = {term.order for term in condition.terms}
        at = {term.point: term.coefficient for term in condition.terms}
        if len(orders) == 1 and {*at} == {*ends}:
            factors[orders.pop()] = sympy.simplify(-at[ends[1]] / at[ends[0]])
    is_periodic = len(conditions) == 2 and factors in ({0: 1, 1: 1}, {0: -1, 1: -1})
    return int(factors[0]) if is_periodic else 0


# ------------------------------------------------------------------------------------------------------------ reading


def apart(eq: Any, ics: Any) -> tuple[Any, Any]:
    """The equation and its values, if a text has both: y'' + y = 0, y(0) = 1, y'(0) = 0."""
    if not isinstance(eq, str):
        return eq, ics
    paste = Paste(eq)
    values = dict(paste.conditions)
    if len(values) < len(paste.conditions):
        raise error_at(eq, "a value is given twice", paste.value_scans[-1], "write every value once")
    if values and ics:
        raise InputError("values stand in the equation's text and apart from it", hint="give them in one of these ways")
    return paste, values or ics


def read_conditions(ics: Mapping[Any, Any] | str | None, *functions: Expr) -> list[Condition]:
    """Conditions on unknown functions, from a mapping or from one text: "y(0)=1, y'(0)=0".  Raises `InputError`."""
    pairs = conditions_in(ics, functions[0].args[0].name) if isinstance(ics, str) else (ics or {}).items()
    given = dict(pairs)
    if len(given) < len(pairs):
        raise InputError(f"a value is given twice in {ics!r}", hint='write "y(0)=1, y\'(0)=0", every value once')
    unknowns = {str(f.func): f for f in functions}
    first, *others = unknowns
    found = []
    for key, value in given.items():
        name = str(key).partition("(")[0].strip() if others else first
        if name not in unknowns:
            raise InputError(f"{key} isn't a value of an unknown", hint=f"write {first}(0) = 1, {others[0]}(0) = 0")
        found.append(_ConditionReader(unknowns[name]).read(key, value))
    return found


class _ConditionReader:
    """Reads one condition on y(x), which is written with the user's symbols, or by its name in a text."""

    def __init__(self, function: Expr) -> None:
        self.function = function
        self.unknown = str(function.func)
        #: Symbols for y(a), (a, 0), and y'(a), (a, 1), in an expression.
        self._symbols: dict[tuple[Expr, int], Expr] = {}

    def read(self, key: Any, value: Any) -> Condition:
        """The condition.  Raises `InputError`."""
        whole = self._side(key)
        if not self._symbols:
            raise self._no_condition(key)
        is_bounded = plain_text(value).strip() == BOUNDED
        if not is_bounded:
            whole = sympy.expand(whole - self._side(value))
        slopes = {term: sympy.expand(whole.diff(symbol)) for term, symbol in self._symbols.items()}
        symbols = {*self._symbols.values()}
        if Tuple(*slopes.values()).free_symbols & symbols:
            raise InputError(f"the condition {key} isn't linear in {self.unknown}")
        terms = tuple(ConditionTerm(*term, slope) for term, slope in slopes.items() if slope != 0)
        if not terms:
            raise self._no_condition(key)
        rest = whole.xreplace(dict.fromkeys(symbols, S.Zero))
        text = f"{plain_text(key)} = {plain_text(value)}"
        return Condition(self.function, terms, None if is_bounded else -rest, text)

    def _side(self, side: Any) -> Expr:
        """One side with symbols for y(a), and for y(x).diff(x).subs(x, a) in either form that SymPy gives it."""
        if isinstance(side, str):  # `y(0)`, `y'(0) - h*y(0)`, or a constant
            value = read_expression(side, what="the initial value", values={self.unknown: self._symbol})
            return self._checked(value, side)
        value = _exact(side)
        value = value.xreplace({e: self._derivative(e.expr, e.point[0]) for e in value.atoms(sympy.Subs)})
        value = value.xreplace({e: self._derivative(e, e.expr.args[0]) for e in value.atoms(sympy.Derivative)})
        applied = sorted((e for e in value.atoms(AppliedUndef) if e.func == self.function.func), key=str)
        return self._checked(value.xreplace({e: self._symbol(e.args[0], 0) for e in applied if len(e.args) == 1}), side)

    def _derivative(self, derivative: Expr, point: Expr) -> Expr:
        orders = [int(count) for _, count in getattr(derivative, "variable_count", ())]
        if orders != [1] or derivative.expr.func != self.function.func:
            raise self._no_condition(derivative)
        return self._symbol(point, 1)

    def _symbol(self, point: Expr, order: int) -> Expr:
        """The symbol for y(a) or y'(a) in an expression."""
        if order > 1:
            raise self._no_condition(self.unknown + "'" * order + f"({point})")
        if point not in (oo, -oo):
            self._checked(point, point)
        return self._symbols.setdefault((point, order), Symbol(f"value_{len(self._symbols)}_"))

    def _checked(self, value: Expr, given: Any) -> Expr:
        """The value, which must be a constant.  Raises `InputError`."""
        if not isinstance(value, sympy.Expr) or value.has(oo, -oo, sympy.nan, sympy.zoo):
            raise InputError(f"the value {given!r} isn't a finite number")
        if str(self.function.args[0]) in map(str, value.free_symbols):
            raise InputError(f"{given} contains the variable: a condition holds at one point", hint="write y(0): 1")
        if value.atoms(AppliedUndef):
            raise InputError(f"the value {given!r} can't be read", hint="give a number, or text such as 'sqrt(2)'")
        return value

    def _no_condition(self, key: Any) -> InputError:
        y = self.unknown
        if isinstance(key, str):
            python, shell = f"write {{'{y}(0)': 1, \"{y}'(0)\": 2}}", f"write {y}(0) = 1, {y}'(0) = 2"
            return InputError(f"{key!r} isn't an initial value", hint=python, shell=shell)
        return InputError(f"{key} isn't an initial value", hint="write {y(0): 1, y(x).diff(x).subs(x, 0): 2}")


def _exact(given: Any) -> Expr:
    """A SymPy expression; a float becomes the decimal that is written for it."""
    if isinstance(given, sympy.Expr):
        return exact_decimals(given)
    if is_complex(given):
        return _exact(given.real) + sympy.I * _exact(given.imag)
    return sympy.Rational(exact_real(exact_text(given, "the value"), "the value"))

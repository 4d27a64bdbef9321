"""Conditions as a user writes them: values, boundary conditions, and how a solution behaves at a singular point or at infinity.

A condition is linear, sum of c_k y^(m_k)(a_k) = v with m_k = 0 or 1: initial and boundary values, periodic conditions
y(0) = y(2 pi), Robin's y'(0) = h y(0).  At a singular point, and at oo and -oo, y(a) = v says that y tends to v there, and
y(a) = "bounded" that it stays bounded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy
from sympy.core.function import AppliedUndef

from kovacic.errors import InputError
from kovacic.numbers.exact import exact_real, exact_text, is_complex
from kovacic.numbers.numerals import plain_text
from kovacic.reading.pieces import conditions_in
from kovacic.reading.symbolic import read_expression

Expr = Any  # SymPy publishes no types
#: The word that stands for a value.
BOUNDED = "bounded"
_NO_VALUES = (sympy.nan, sympy.zoo)


@dataclass(frozen=True)
class Term:
    """coefficient * y(point), or times y'(point) for order 1."""

    point: Expr
    order: int
    coefficient: Expr


@dataclass(frozen=True)
class Condition:
    """The sum of the terms is `value`; None: it is bounded."""

    terms: tuple[Term, ...]
    value: Expr | None
    text: str

    @property
    def points(self) -> tuple[Expr, ...]:
        return tuple(term.point for term in self.terms)

    @property
    def free_symbols(self) -> set[Expr]:
        """Those of its points, coefficients and value."""
        parts = [part for term in self.terms for part in (term.point, term.coefficient)]
        return set().union(*(part.free_symbols for part in parts), getattr(self.value, "free_symbols", ()))

    def in_symbols(self, others: Mapping[Expr, Expr]) -> Condition:
        """The condition in other symbols."""
        terms = (Term(t.point.xreplace(others), t.order, t.coefficient.xreplace(others)) for t in self.terms)
        value = None if self.value is None else self.value.xreplace(others)
        return Condition(tuple(terms), value, self.text)

    @property
    def is_value(self) -> bool:
        """True for y(a) = v and y'(a) = v."""
        return len(self.terms) == 1 and self.terms[0].coefficient == 1 and self.value is not None

    @property
    def by_order(self) -> tuple[Expr, Expr]:
        """alpha and beta, where the terms are alpha y + beta y' at one point."""
        parts = [sympy.S.Zero, sympy.S.Zero]
        for term in self.terms:
            parts[term.order] += term.coefficient
        return parts[0], parts[1]


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


def as_mapping(ics: Mapping[Any, Any] | str | None) -> dict[Any, Any]:
    """Conditions that are given as a mapping, or as one text: "y(0)=1, y'(0)=0".  Raises `InputError`."""
    if not isinstance(ics, str):
        return dict(ics or {})
    found: dict[Any, Any] = {}
    for place, value in conditions_in(ics):
        if place in found:
            raise InputError(f"{place} is given twice in {ics!r}", hint='write "y(0)=1, y\'(0)=0", every value once')
        found[place] = value
    return found


class ConditionReader:
    """Reads conditions on the unknown function y(x): `function` as the user writes it, or its name in a text."""

    def __init__(self, function: Expr, unknown: str) -> None:
        self.function = function
        self.unknown = unknown
        self._terms: dict[Expr, tuple[Expr, int]] = {}  # what stands for y(a), y'(a) in an expression

    def read(self, key: Any, value: Any) -> Condition:
        """One condition.  Raises `InputError`."""
        self._terms = {}
        left = self._side(key, is_key=True)
        text = f"{plain_text(key)} = {plain_text(value)}"
        if not self._terms:
            raise self._no_condition(key)
        if plain_text(value).strip() == BOUNDED:
            return Condition(self._linear(left, key), None, text)
        right = self._side(value, is_key=False)
        whole = sympy.expand(left - right)
        terms = self._linear(whole, key)
        rest = whole.xreplace(dict.fromkeys(self._terms, sympy.Integer(0)))
        return Condition(terms, -rest, text)

    def _linear(self, whole: Expr, key: Any) -> tuple[Term, ...]:
        terms = []
        for symbol, (point, order) in self._terms.items():
            coefficient = sympy.expand(whole.diff(symbol))
            if coefficient.free_symbols & self._terms.keys():
                raise InputError(f"the condition {key} isn't linear in {self.unknown}")
            if coefficient != 0:
                terms.append(Term(point, order, coefficient))
        if not terms:
            raise self._no_condition(key)
        return tuple(terms)

    def _side(self, side: Any, *, is_key: bool) -> Expr:
        """One side, with symbols in the place of y(a) and y'(a)."""
        if isinstance(side, str):  # `y(0)`, `y'(0) - h*y(0)`, or a constant
            value = read_expression(side, what="the initial value", values={self.unknown: self._symbol})
        elif is_key and not isinstance(side, sympy.Basic):
            raise self._no_condition(side)
        else:
            value = self._expression(side)
        return self._checked(value, side)

    def _expression(self, given: Any) -> Expr:
        """With symbols for y(a), y(x).diff(x).subs(x, a) in either form that SymPy gives it."""
        value = _exact(given)
        for e in value.atoms(sympy.Subs):
            value = value.xreplace({e: self._derivative(e.expr, e.point[0])})
        for e in value.atoms(sympy.Derivative):
            value = value.xreplace({e: self._derivative(e, e.expr.args[0])})
        for e in sorted(value.atoms(AppliedUndef), key=str):
            if e.func == self.function.func and len(e.args) == 1:
                value = value.xreplace({e: self._symbol(e.args[0], 0)})
        return value

    def _derivative(self, derivative: Expr, point: Expr) -> Expr:
        orders = [int(count) for _, count in getattr(derivative, "variable_count", ())]
        if orders != [1] or derivative.expr.func != self.function.func:
            raise self._no_condition(derivative)
        return self._symbol(point, 1)

    def _symbol(self, point: Expr, order: int) -> Expr:
        """The symbol that stands for y(a) or y'(a) in an expression."""
        if order > 1:
            raise self._no_condition(self.unknown + "'" * order + f"({point})")
        if point not in (sympy.oo, -sympy.oo):
            self._checked(point, point)
        known = next((symbol for symbol, term in self._terms.items() if term == (point, order)), None)
        if known is None:
            known = sympy.Symbol(f"value_{len(self._terms)}_")
            self._terms[known] = point, order
        return known

    def _checked(self, value: Expr, given: Any) -> Expr:
        """Refuses what is no constant."""
        if not isinstance(value, sympy.Expr) or value.has(sympy.oo, -sympy.oo, *_NO_VALUES):
            raise InputError(f"the value {given!r} isn't a finite number")
        variables = {argument.name for argument in self.function.args}
        if any(symbol.name in variables for symbol in value.free_symbols):
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
    """A SymPy expression; a float is the decimal that it is written as."""
    if isinstance(given, sympy.Expr):
        return exact(given)
    if is_complex(given):
        return _exact(given.real) + sympy.I * _exact(given.imag)
    try:
        value = exact_real(exact_text(given, "the value"), "the value")
    except (TypeError, ValueError):
        said = f"the value {plain_text(given)[:60]!r} can't be read"
        raise InputError(said, hint="give a number, or text such as 'sqrt(2)'") from None
    return sympy.Rational(value.numerator, value.denominator)


def exact(expression: Expr) -> Expr:
    """With the decimals that floats are written as in their places."""
    floats: Iterator[Expr] = (number for number in expression.atoms(sympy.Float) if number.is_finite)
    return expression.xreplace({number: sympy.Rational(str(number)) for number in floats})

"""Arithmetic on expressions that are linear in an unknown function and its derivatives.

A value is what `arithmetic` knows, or a `LinearForm` sum_k c_k y^(k) + r + h with rational c_k and r, and h a SymPy
expression that isn't rational: the right-hand sides of equations contain exponentials, coefficients don't.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import NotLinear, NotRational
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Arithmetic, NotAnInteger, Value
from kovacic.reading.given import TRANSCENDENTAL_HINT

#: The largest integer power of an expression that isn't rational.
_LARGEST_POWER = 1000

#: The key of the rational part r of a linear form.
REST = -1


class LinearForm:
    """`parts[k]` is the coefficient of the k-th derivative, `parts[REST]` the rational part, `other` SymPy's (None: 0)."""

    __slots__ = ("other", "parts")

    def __init__(self, parts: Mapping[int, Value], other: Any = None) -> None:
        self.parts = parts
        self.other = other

    @property
    def coefficients(self) -> dict[int, Value]:
        """The coefficients of the unknown function and its derivatives, by the order."""
        return {k: c for k, c in self.parts.items() if k != REST}


class LinearArithmetic(Arithmetic):
    """Sums, products, quotients and powers of linear forms.

    Raises `NotLinear` for a product of two forms with the unknown function, and `NotRational` where a coefficient
    wouldn't be rational, without a place in the text; and what `Arithmetic` raises.
    """

    def __init__(self, limits: Limits, variable: str, unknown: str) -> None:
        super().__init__(limits)
        self.variable = variable
        self.unknown = unknown

    @cached_property
    def _symbolic(self) -> Any:
        from kovacic.reading.symbolic import SymbolicArithmetic

        return SymbolicArithmetic(self.limits)

    def form(self, value: Any) -> LinearForm:
        """Any value as a linear form."""
        return value if isinstance(value, LinearForm) else LinearForm({REST: value})

    def opaque(self, expression: Any) -> LinearForm:
        """A SymPy expression as a form without the unknown function."""
        return LinearForm({}, expression)

    def expression(self, value: Any) -> Any:
        """A value without the unknown function as a SymPy expression."""
        from kovacic.reading.symbolic import expression_of

        form = self.form(value)
        if form.coefficients:
            raise NotLinear(f"the unknown function {self.unknown} within a function or a power")
        terms = [form.other] if form.other is not None else []
        if REST in form.parts:
            terms.append(expression_of(self.rational(form.parts[REST]), self.variable))
        return sum(terms[1:], terms[0]) if terms else self._symbolic.constant(0)

    def negate(self, value: Any) -> Any:
        if not isinstance(value, LinearForm):
            return super().negate(value)
        parts = {k: super(LinearArithmetic, self).negate(c) for k, c in value.parts.items()}
        return LinearForm(parts, None if value.other is None else -value.other)

    def sum(self, terms: Sequence[Any]) -> Any:
        if not any(isinstance(term, LinearForm) for term in terms):
            return super().sum(terms)
        parts: dict[int, list[Value]] = {}
        others: list[Any] = []
        for form in map(self.form, terms):
            for k, c in form.parts.items():
                parts.setdefault(k, []).append(c)
            others += [] if form.other is None else [form.other]
        other = sum(others[1:], others[0]) if others else None
        return LinearForm({k: super(LinearArithmetic, self).sum(c) for k, c in parts.items()}, other)

    def multiply(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return super().multiply(left, right)
        first, second = self.form(left), self.form(right)
        if first.coefficients and second.coefficients:
            raise NotLinear(f"a product of {self.unknown} or its derivatives: the equation isn't linear")
        form, factor = (first, second) if first.coefficients else (second, first)
        if form.coefficients and factor.other is not None:
            factor = LinearForm({REST: self.with_parameters(self.expression(factor))})
        if factor.other is None and form.other is None:
            return LinearForm(self._scaled(form.parts, factor))
        rest = LinearForm({REST: form.parts[REST]} if REST in form.parts else {}, form.other)
        return LinearForm(self._scaled(form.coefficients, factor), self.expression(factor) * self.expression(rest))

    def _scaled(self, parts: Mapping[int, Value], factor: LinearForm) -> dict[int, Value]:
        """The products with a rational factor."""
        if not parts or REST not in factor.parts:
            return {}
        closed = self.closed(factor.parts[REST])
        return {k: super(LinearArithmetic, self).multiply(c, closed) for k, c in parts.items()}

    def with_parameters(self, coefficient: Any) -> Value:
        """A coefficient that is a SymPy expression; a reader may have the means to understand it."""
        raise self.not_rational(coefficient)

    def not_rational(self, coefficient: Any) -> NotRational:
        from sympy import E, Symbol

        shown = coefficient.xreplace({E: Symbol("e")})  # E is the energy in texts
        if coefficient.free_symbols:
            return NotRational(f"a coefficient that isn't a rational function of {self.variable}: {shown}")
        return NotRational(f"{shown} isn't an algebraic number", hint=TRANSCENDENTAL_HINT)

    def divide(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return super().divide(left, right)
        denominator = self.form(right)
        if denominator.coefficients:
            raise NotLinear(f"{self.unknown} or a derivative of it in a denominator: the equation isn't linear")
        one = self.constant(1)
        if denominator.other is None:
            return self.multiply(left, super().divide(one, denominator.parts[REST]))
        inverse = self._symbolic.divide(self.expression(one), self.expression(denominator))
        return self.multiply(left, self.opaque(inverse))

    def power(self, base: Any, exponent: Any) -> Any:
        if isinstance(exponent, LinearForm):
            raise NotAnInteger
        if not isinstance(base, LinearForm):
            return super().power(base, exponent)
        n = exponent if isinstance(exponent, int) else self._integer_value(exponent)
        if base.coefficients:
            if n == 1:
                return base
            raise NotLinear(f"a power of {self.unknown} or of a derivative: the equation isn't linear")
        if abs(n) > _LARGEST_POWER:
            raise NotRational(f"the power {n} of {base.other}")
        return self.symbolic_power(base, self.constant(n))

    def symbolic_power(self, base: Any, exponent: Any) -> LinearForm:
        """`base ** exponent` as a form with a SymPy expression."""
        return self.opaque(self._symbolic.power(self.expression(base), self.expression(exponent)))

    def applied(self, head: str, argument: Any) -> LinearForm:
        """An elementary function of a value without the unknown function."""
        return self.opaque(self._symbolic.applied(head, self.expression(argument)))

    def derivative(self, value: Any) -> Any:
        """The derivative with respect to the variable."""
        form = self.form(value)
        terms: list[Any] = []
        for k, c in form.parts.items():
            closed = self.closed(c)
            slopes = {k: closed.derivative()} if k == REST else {k: closed.derivative(), k + 1: closed}
            terms += [LinearForm({order: slope}) for order, slope in slopes.items() if slope]
        parts = self.sum(terms).parts if terms else {}
        if form.other is not None:
            from sympy import Symbol

            return LinearForm(parts, form.other.diff(Symbol(self.variable)))
        return LinearForm(parts) if any(k != REST for k in parts) else parts.get(REST, self.constant(0))

    def closed(self, value: Any) -> Any:
        return value if isinstance(value, LinearForm) else super().closed(value)

    def rational(self, value: Any) -> RatFunc:
        if isinstance(value, LinearForm):
            raise NotRational(f"this isn't a rational function of {self.variable}")
        return super().rational(value)

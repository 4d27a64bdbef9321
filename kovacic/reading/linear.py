"""Arithmetic on expressions that are linear in an unknown function and its derivatives.

A value is what `arithmetic` knows, or a `LinearForm` sum_k c_k y^(k) + r + h with rational c_k and r, and h a SymPy
expression that isn't rational: the right-hand sides of equations contain exponentials, coefficients don't.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import NotLinear, NotRational
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Arithmetic, NotAnInteger, Value
from kovacic.reading.parsed import TRANSCENDENTAL_HINT

#: The largest integer power of an expression that isn't rational.
_LARGEST_POWER = 1000


class LinearForm:
    """`parts[k]` is the coefficient of the k-th derivative, `rest` the rational part (None: 0), `other` SymPy's (None: 0)."""

    __slots__ = ("other", "parts", "rest")

    def __init__(self, parts: Mapping[int, Value], rest: Value | None = None, other: Any = None) -> None:
        self.parts = dict(parts)
        self.rest = rest
        self.other = other


class LinearArithmetic(Arithmetic):
    """Sums, products, quotients and powers of linear forms.

    Raises `NotLinear` for a product of two forms with the unknown function, and `NotRational` where a coefficient
    wouldn't be rational, without a place in the text; and what `Arithmetic` raises.
    """

    def __init__(self, limits: Limits, variable: str, unknown: str) -> None:
        super().__init__(limits)
        self.variable = variable
        self.unknown = unknown

    def form(self, value: Any) -> LinearForm:
        """Any value as a linear form."""
        return value if isinstance(value, LinearForm) else LinearForm({}, value)

    def opaque(self, expression: Any) -> LinearForm:
        """A SymPy expression as a form without the unknown function."""
        return LinearForm({}, None, expression)

    def expression(self, value: Any) -> Any:
        """A value without the unknown function as a SymPy expression."""
        from sympy import Symbol

        from kovacic.closed_form.atoms import Atoms

        form = self.form(value)
        if form.parts:
            raise NotLinear(f"the unknown function {self.unknown} within a function or a power")
        result = 0 if form.rest is None else Atoms(Symbol(self.variable)).ratio(self.rational(form.rest))
        return result if form.other is None else result + form.other

    def negate(self, value: Any) -> Any:
        if not isinstance(value, LinearForm):
            return super().negate(value)
        parts = {k: super(LinearArithmetic, self).negate(c) for k, c in value.parts.items()}
        rest = None if value.rest is None else super().negate(value.rest)
        return LinearForm(parts, rest, None if value.other is None else -value.other)

    def add(self, left: Any, right: Any, *, subtract: bool = False) -> Any:
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return super().add(left, right, subtract=subtract)
        first, second = self.form(left), self.form(right)
        if subtract:
            second = self.negate(second)
        parts = dict(first.parts)
        for k, c in second.parts.items():
            parts[k] = super().add(parts[k], c) if k in parts else c
        rests = [r for r in (first.rest, second.rest) if r is not None]
        rest = super().add(*rests) if len(rests) == 2 else next(iter(rests), None)
        others = [h for h in (first.other, second.other) if h is not None]
        return LinearForm(parts, rest, sum(others[1:], others[0]) if others else None)

    def _not_rational(self, coefficient: Any) -> NotRational:
        from sympy import E, Symbol

        shown = coefficient.xreplace({E: Symbol("e")})  # E is the energy in texts
        if coefficient.free_symbols:
            return NotRational(f"a coefficient that isn't a rational function of {self.variable}: {shown}")
        return NotRational(f"{shown} isn't an algebraic number", hint=TRANSCENDENTAL_HINT)

    def multiply(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return super().multiply(left, right)
        first, second = self.form(left), self.form(right)
        if first.parts and second.parts:
            raise NotLinear(f"a product of {self.unknown} or its derivatives: the equation isn't linear")
        form, factor = (first, second) if first.parts else (second, first)
        if form.parts and factor.other is not None:
            raise self._not_rational(factor.other)
        if factor.other is not None or form.other is not None:
            # Without coefficients; or a rational factor of a form with a part that isn't rational.
            other: Any = self.expression(factor) * self.expression(LinearForm({}, form.rest, form.other))
            if not form.parts:
                return self.opaque(other)
            return LinearForm(self._scaled(form.parts, factor), None, other)
        scaled = self._scaled(form.parts, factor)
        both = form.rest is not None and factor.rest is not None
        return LinearForm(scaled, self._product(form.rest, factor.rest) if both else None)

    def _scaled(self, parts: Mapping[int, Value], factor: LinearForm) -> dict[int, Value]:
        if factor.rest is None:
            return {}
        closed = self.closed(factor.rest)
        return {k: super(LinearArithmetic, self).multiply(c, closed) for k, c in parts.items()}

    def _product(self, left: Any, right: Any) -> Any:
        if isinstance(left, Poly) and isinstance(right, Poly):
            return super()._product(left, right)
        return super().multiply(left, self.closed(right))

    def divide(self, left: Any, right: Any) -> Any:
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return super().divide(left, right)
        denominator = self.form(right)
        if denominator.parts:
            raise NotLinear(f"{self.unknown} or a derivative of it in a denominator: the equation isn't linear")
        if denominator.other is not None:
            return self.multiply(left, self.opaque(1 / self.expression(denominator)))
        return self.multiply(left, super().divide(self.constant(1), denominator.rest))  # type: ignore[arg-type]

    def power(self, base: Any, exponent: Any) -> Any:
        if isinstance(exponent, LinearForm):
            raise NotAnInteger
        if not isinstance(base, LinearForm):
            return super().power(base, exponent)
        n = exponent if isinstance(exponent, int) else self._integer_value(exponent)
        if base.parts:
            if n == 1:
                return base
            raise NotLinear(f"a power of {self.unknown} or of a derivative: the equation isn't linear")
        if abs(n) > _LARGEST_POWER:
            raise NotRational(f"the power {n} of {base.other}")
        return self.opaque(self.expression(base) ** n)

    def derivative(self, value: Any) -> Any:
        """The derivative with respect to the variable."""
        form = self.form(value)
        parts: dict[int, Value] = {}
        for k, c in form.parts.items():
            closed = self.closed(c)
            slope = closed.derivative()
            if slope:
                parts[k] = super().add(parts[k], slope) if k in parts else slope
            parts[k + 1] = super().add(parts[k + 1], closed) if k + 1 in parts else closed
        rest = None if form.rest is None else self.closed(form.rest).derivative()
        other = None
        if form.other is not None:
            from sympy import Symbol

            other = form.other.diff(Symbol(self.variable))
        if not parts and other is None:
            return rest
        return LinearForm(parts, rest, other)

    def closed(self, value: Any) -> Any:
        return value if isinstance(value, LinearForm) else super().closed(value)

    def rational(self, value: Any) -> RatFunc:
        if isinstance(value, LinearForm):
            raise NotRational(f"this isn't a rational function of {self.variable}")
        return super().rational(value)

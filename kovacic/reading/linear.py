"""Arithmetic on expressions that are linear in an unknown function and its derivatives.

A value is what `arithmetic` knows, or a SymPy expression that isn't rational (right-hand sides contain exponentials), or a
`LinearForm` sum_k c_k y^(k) + r, with c_k and r of these kinds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.errors import NotLinear, NotRational
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Arithmetic, Term

#: The largest integer power of an expression that isn't rational.
_LARGEST_POWER = 1000

#: The key of the part r of a linear form.
REST = -1


class LinearForm:
    """`parts[k]` is the coefficient of the k-th derivative, `parts[REST]` the part without the unknown function."""

    __slots__ = ("parts",)

    def __init__(self, parts: Mapping[int, Any]) -> None:
        self.parts = parts


def is_rational(value: Any) -> bool:
    """Is it a value of `Arithmetic`, neither a SymPy expression nor a linear form?"""
    return isinstance(value, Term | Poly | RatFunc)


class LinearArithmetic(Arithmetic):
    """Sums, products, quotients and powers of linear forms; `coefficient` says what a SymPy expression as a factor of y is.

    Raises `NotLinear` for a product of two forms with the unknown function, without a place in the text; and what
    `coefficient` and `Arithmetic` raise.
    """

    def __init__(self, limits: Limits, variable: str, unknown: str, coefficient: Callable[[Any], Any]) -> None:
        super().__init__(limits)
        self.variable = variable
        self.unknown = unknown
        self.coefficient = coefficient

    @cached_property
    def _symbolic(self) -> Any:
        from kovacic.reading.symbolic import SymbolicArithmetic

        return SymbolicArithmetic(self.limits)

    def expression(self, value: Any) -> Any:
        """A value without the unknown function as a SymPy expression."""
        from kovacic.reading.symbolic import expression_of

        if isinstance(value, LinearForm):
            raise NotLinear(f"the unknown function {self.unknown} within a function or a power")
        return expression_of(self.rational(value), self.variable) if is_rational(value) else value

    def negate(self, value: Any) -> Any:
        if isinstance(value, LinearForm):
            return LinearForm({k: self.negate(c) for k, c in value.parts.items()})
        return super().negate(value) if is_rational(value) else -value

    def sum(self, terms: Sequence[Any]) -> Any:
        if any(isinstance(term, LinearForm) for term in terms):
            parts: dict[int, list[Any]] = {}
            for term in terms:
                for k, c in term.parts.items() if isinstance(term, LinearForm) else ((REST, term),):
                    parts.setdefault(k, []).append(c)
            return LinearForm({k: self.sum(c) for k, c in parts.items()})
        rational = [term for term in terms if is_rational(term)]
        if len(rational) == len(terms):
            return super().sum(rational)
        others = [term for term in terms if not is_rational(term)]
        return self._symbolic.sum([*others, *([self.expression(super().sum(rational))] if rational else [])])

    def multiply(self, left: Any, right: Any) -> Any:
        if is_rational(left) and is_rational(right):
            return super().multiply(left, right)
        if not isinstance(left, LinearForm) and not isinstance(right, LinearForm):
            return self._symbolic.multiply(self.expression(left), self.expression(right))
        if isinstance(left, LinearForm) and isinstance(right, LinearForm):
            raise NotLinear(f"a product of {self.unknown} or its derivatives: the equation isn't linear")
        form, factor = (left, right) if isinstance(left, LinearForm) else (right, left)
        factor = self.closed(factor) if is_rational(factor) else self.coefficient(factor)
        return LinearForm({k: self.multiply(c, factor) for k, c in form.parts.items()})

    def divide(self, left: Any, right: Any) -> Any:
        if isinstance(right, LinearForm):
            raise NotLinear(f"{self.unknown} or a derivative of it in a denominator: the equation isn't linear")
        if isinstance(left, LinearForm):
            return self.multiply(left, self.divide(self.constant(1), right))
        if is_rational(left) and is_rational(right):
            return super().divide(left, right)
        return self._symbolic.divide(self.expression(left), self.expression(right))

    def power(self, base: Any, exponent: Any) -> Any:
        n = exponent if isinstance(exponent, int) else self._integer_value(exponent)
        if is_rational(base):
            return super().power(base, n)
        if not isinstance(base, LinearForm):
            if abs(n) > _LARGEST_POWER:
                raise NotRational(f"the power {n} of {base}")
            return self._symbolic.power(base, self._symbolic.constant(n))
        if n != 1:
            raise NotLinear(f"a power of {self.unknown} or of a derivative: the equation isn't linear")
        return base

    def symbolic_power(self, base: Any, exponent: Any) -> Any:
        """`base ** exponent` as a SymPy expression."""
        return self._symbolic.power(self.expression(base), self.expression(exponent))

    def applied(self, head: str, argument: Any) -> Any:
        """An elementary function of a value without the unknown function."""
        return self._symbolic.applied(head, self.expression(argument))

    def derivative(self, value: Any) -> Any:
        """The derivative with respect to the variable."""
        if isinstance(value, LinearForm):
            slopes = [LinearForm({k: self.derivative(c)}) for k, c in value.parts.items()]
            return self.sum([*slopes, *(LinearForm({k + 1: c}) for k, c in value.parts.items() if k != REST)])
        if is_rational(value):
            return self.closed(value).derivative()
        from sympy import Symbol

        return value.diff(Symbol(self.variable))

    def rational(self, value: Any) -> RatFunc:
        if not is_rational(value):
            raise NotRational(f"this isn't a rational function of {self.variable}")
        return super().rational(value)

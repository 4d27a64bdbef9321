"""Arithmetic beyond rational functions: SymPy expressions, and linear forms in an unknown function and its derivatives.

A value is what `arithmetic` knows, or a SymPy expression that isn't a number (right-hand sides contain exponentials), or a
`LinearForm` sum_k c_k y^(k) + r, with c_k and r of these kinds.  The operations on SymPy's expressions are SymPy's own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

from kovacic.algebra.embedding import real_root_index
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import over
from kovacic.errors import InputError, LimitExceeded, NotLinear, NotRational
from kovacic.limits import Limits, check_duration
from kovacic.reading.arithmetic import ONE, PRINTED_BITS, ZERO, Arithmetic, Monomial
from kovacic.reading.names import FUNCTION_NAMES, RECIPROCALS, SEVERAL_ARGUMENTS
from kovacic.reading.parser import DEEPEST, Comparison

#: Limits on input that SymPy calculates with: it expands powers, and its integers have no limit of their own.
SYMBOLIC_LIMITS = Limits(text_length=10_000, digits=1000, exponent=1000, bits=10_000)

#: Functions, and powers with symbols in their exponents, that may be nested.
_MOST_NESTED = 5

LINEAR_HINT = "the equation is a y'' + b y' + c y = f, where a, b, c and f depend on the variable alone"

_RATIONAL_VALUES = (Monomial, Poly, RatFunc)

_ARGUMENTS_HINT = "for example max(x, 0), Piecewise((1, 0 <= x < 5), (0, True))"

#: The key of the part r of a linear form.
REST = -1


@dataclass(eq=False)
class LinearForm:
    """`parts[k]` is the coefficient of the k-th derivative, `parts[REST]` the part without the unknown function."""

    parts: Mapping[int, Any]


class DerivativeOperator(LinearForm):
    """`parts[k]` is the coefficient of D^k: what a linear form is before it is applied to the unknown function."""


def is_plain(value: Any) -> bool:
    """True for a value of `Arithmetic`, which is neither a SymPy expression nor a linear form."""
    return isinstance(value, _RATIONAL_VALUES)


class LinearArithmetic(Arithmetic):
    """Sums, products, quotients and powers of linear forms; `coefficient` converts a SymPy expression that is a factor of y.

    Raises `NotLinear`, without a place in the text, for a product of two forms with the unknown function.
    """

    def __init__(
        self, limits: Limits, variable: str = "", unknown: str = "", coefficient: Callable[[Any], Any] | None = None
    ) -> None:
        super().__init__(limits)
        self.variable = variable
        self.unknown = unknown
        self.coefficient = coefficient

    def expression(self, value: Any) -> Any:
        """A value without the unknown function as a SymPy expression."""
        import sympy

        if isinstance(value, LinearForm):
            raise NotLinear(f"the unknown function {self.unknown} within a function or a power", hint=LINEAR_HINT)
        if not is_plain(value):
            return value
        x = sympy.Symbol(self.variable)
        function = self.rational(value)
        function = over(function, (function.num * function.den).field)  # they may be over different fields: a/x^2
        bits = max(function.num.height_bits(), function.den.height_bits())
        if bits > PRINTED_BITS:  # too long to be printed
            raise LimitExceeded(f"coefficients of {bits} bits, above the limit of {PRINTED_BITS}", limit="bits")
        parts = ([c.to_sympy(x) * x**k for k, c in enumerate(part) if c] for part in function.cleared())
        num, den = (sympy.Add(*terms) for terms in parts)
        field = function.field
        # Any name that isn't an identifier is that of a radical.
        if not isinstance(field, AlgebraicField) or not field.name.isidentifier() or field.name == "I":
            return num / den
        root = chosen_root(sympy.Poly(field.modulus.to_sympy(sympy.Symbol("t"))), field)
        return (num / den).xreplace({sympy.Symbol(field.name): root})

    def _checked(self, value: Any) -> Any:
        if value.is_Rational:
            return self.constant(value.p, value.q)
        return value

    def negate(self, value: Any) -> Any:
        if isinstance(value, LinearForm):
            return type(value)({k: self.negate(c) for k, c in value.parts.items()})
        if is_plain(value):
            return super().negate(value)
        return -value

    def sum(self, terms: Sequence[Any]) -> Any:
        if any(isinstance(term, LinearForm) for term in terms):
            return self._sum_of_forms(terms)
        rational = [term for term in terms if is_plain(term)]
        others = [term for term in terms if not is_plain(term)]
        if not others:
            return super().sum(rational)
        from sympy import Add

        others.append(self.expression(super().sum([ZERO, *rational])))
        return self._checked(Add(*others))  # at once: one by one, a sum of n terms is taken apart n times

    def _sum_of_forms(self, terms: Sequence[Any]) -> LinearForm:
        """The sum, some terms of which have no unknown function."""
        kinds = {type(term) for term in terms if isinstance(term, LinearForm)}
        if len(kinds) > 1:
            raise NotLinear("a sum of an operator and a function", hint=f"write (D^2 + 1) {self.unknown} = 0")
        (kind,) = kinds
        parts: dict[int, list[Any]] = {}
        for term in terms:
            own: Mapping[int, Any] = {REST: term}
            if isinstance(term, LinearForm):
                own = term.parts
            elif kind is DerivativeOperator:
                own = {0: self._coefficient_of(term)}
            for k, c in own.items():
                parts.setdefault(k, []).append(c)
        return kind({k: self.sum(coefficients) for k, coefficients in parts.items()})

    def multiply(self, left: Any, right: Any) -> Any:
        if is_plain(left) and is_plain(right):
            return super().multiply(left, right)
        if isinstance(left, DerivativeOperator):
            return self._applied(left, right if isinstance(right, LinearForm) else DerivativeOperator({0: right}))
        if isinstance(left, LinearForm) and isinstance(right, LinearForm):
            raise self._not_linear(f"a product of {self.unknown} or its derivatives")
        if isinstance(left, LinearForm):
            return self._multiple(left, right)
        if isinstance(right, LinearForm):
            return self._multiple(right, left)
        return self._checked(self.expression(left) * self.expression(right))

    def _not_linear(self, what: str) -> NotLinear:
        return NotLinear(f"{what}: the equation isn't linear", hint=LINEAR_HINT)

    def _multiple(self, form: LinearForm, factor: Any) -> LinearForm:
        """A form times a value free of the unknown function."""
        coefficient = self._coefficient_of(factor)
        return type(form)({k: self.multiply(c, coefficient) for k, c in form.parts.items()})

    def _applied(self, operator: DerivativeOperator, form: LinearForm) -> Any:
        """The sum of c_k D^k, applied to a form, or to another operator: D c = c' + c D."""
        terms = []
        for k in range(max(operator.parts) + 1):
            form = self.derivative(form) if k else form
            if k in operator.parts:
                terms.append(self._multiple(form, operator.parts[k]))
        return self.sum(terms)

    def called(self, head: str, arguments: Sequence[Any]) -> Any:
        """The value, by SymPy, of a function of `FUNCTION_NAMES` or `SEVERAL_ARGUMENTS`, or None for other names."""
        import sympy

        are_pairs = {isinstance(argument, tuple) for argument in arguments}
        if head in FUNCTION_NAMES and are_pairs == {False} and len(arguments) == 1:
            return self.applied(head, arguments[0])
        if head not in SEVERAL_ARGUMENTS:
            return None
        if are_pairs != {head == "Piecewise"}:
            raise NotRational(f"{head} doesn't have such arguments", hint=_ARGUMENTS_HINT)
        pieces: Any = map(self.expression, arguments)
        if head == "Piecewise":
            pieces = ((self.expression(value), self._condition(case)) for value, case in arguments)
        return self._checked(getattr(sympy, SEVERAL_ARGUMENTS[head])(*pieces))

    def _condition(self, case: Any) -> Any:
        import sympy

        if not isinstance(case, Comparison):
            raise NotRational("a condition is missing behind a piece", hint=_ARGUMENTS_HINT)
        values = [self.expression(value) for value in case.values]
        relations = zip(values, values[1:], case.signs, strict=False)
        return sympy.And(*(sympy.Rel(left, right, sign) for left, right, sign in relations))

    def _coefficient_of(self, factor: Any) -> Any:
        """A value free of the unknown function, as a coefficient of it."""
        return self.closed(factor) if is_plain(factor) else self.coefficient(factor)  # type: ignore[misc]

    def divide(self, left: Any, right: Any) -> Any:
        if isinstance(right, LinearForm):
            raise self._not_linear(f"{self.unknown} or a derivative of it in a denominator")
        if isinstance(left, LinearForm):
            return self.multiply(left, self.divide(self.constant(1), right))
        if is_plain(left) and is_plain(right):
            return super().divide(left, right)
        denominator = self.expression(right)
        if _is_zero(denominator):
            raise ZeroDivisionError("division by zero")
        return self._checked(self.expression(left) / denominator)

    def power(self, base: Any, exponent: Any) -> Any:
        n = self._integer_of(exponent)
        if is_plain(base):
            return super().power(base, n)
        if not isinstance(base, LinearForm):
            return self.symbolic_power(base, self.constant(n))
        if isinstance(base, DerivativeOperator) and n > 0:
            power = base
            for _ in range(n - 1):
                power = self._applied(base, power)
            return power
        if n != 1:
            raise self._not_linear(f"a power of {self.unknown} or of a derivative")
        return base

    def symbolic_power(self, base: Any, exponent: Any) -> Any:
        base = self.expression(base)
        exponent = self._argument(exponent)
        self._check_exponent(exponent)
        if exponent.is_nonpositive and _is_zero(base):
            raise ZeroDivisionError("0 has no powers with exponent zero or below")
        factor = base.as_coeff_Mul()[0]
        if exponent.is_Rational and factor.is_Rational:
            self._check(0, abs(int(exponent.p)) * max(int(factor.p).bit_length(), int(factor.q).bit_length()))
        return self._checked(base**exponent)

    def _argument(self, value: Any) -> Any:
        """An argument of a function, or an exponent, as a SymPy expression: each function around it may double SymPy's time."""
        expression = self.expression(value)
        if _height(expression) >= _MOST_NESTED:
            raise InputError(f"more than {_MOST_NESTED} functions or powers inside of one another")
        return expression

    def _check_exponent(self, exponent: Any) -> None:
        """Refuses numbers as exponents, and as factors of logarithms in exponents, that are too large."""
        from sympy import Rational, log

        if not (exponent.is_Rational or exponent.has(log)):
            return
        largest = min(self.limits.exponent, SYMBOLIC_LIMITS.exponent)
        if any(abs(number) > largest for number in exponent.atoms(Rational)):
            raise LimitExceeded(f"an exponent above the limit of {largest}", limit="exponent")

    def applied(self, head: str, argument: Any) -> Any:
        """One of the functions of `FUNCTION_NAMES`, by SymPy.  Raises `InputError` where it isn't finite."""
        import sympy

        if head in RECIPROCALS:
            return self.divide(ONE, self.applied(RECIPROCALS[head], argument))
        argument = self._argument(argument)
        if head == "exp":
            self._check_exponent(argument)
        value = getattr(sympy, FUNCTION_NAMES[head])(argument)
        if value.has(sympy.zoo, sympy.nan, sympy.oo):
            hint = "leave the point out where the function is infinite"
            raise InputError(f"{head}({argument}) isn't finite", hint=hint)
        return self._checked(value)

    def derivative(self, value: Any) -> Any:
        if isinstance(value, LinearForm):
            # (c y^(k))' = c' y^(k) + c y^(k+1)
            check_order(max(value.parts) + 1)
            kind = type(value)
            slopes = [kind({k: self.derivative(c)}) for k, c in value.parts.items()]
            higher = [kind({k + 1: c}) for k, c in value.parts.items() if k != REST]
            return self.sum([*slopes, *higher])
        if is_plain(value):
            return self.closed(value).derivative()
        from sympy import Symbol

        return value.diff(Symbol(self.variable))


def check_order(order: int) -> None:
    """Raise `NotLinear` for a high order: ((D^10)^10) y takes half a second, and a power of it would take minutes."""
    if order > DEEPEST:
        raise NotLinear(f"a derivative of order {order}, above the limit of {DEEPEST}", hint=LINEAR_HINT)


def differentiations(arguments: Sequence[Any], reader: Any) -> int:
    """The order of a derivative by x; x, x; x, 2; or (x, 2), the arguments after the function; 1 without any."""
    function, *pairs = arguments
    if isinstance(function, tuple):
        raise NotLinear("this isn't a derivative that can be read")
    by = [value for pair in pairs for value in (pair if isinstance(pair, tuple) else (pair,))]
    order = 0 if by else 1
    for before, value in pairwise([None, *by]):
        number = reader.arithmetic.number(value)
        if reader.is_variable(value):
            order += 1
        elif not reader.is_variable(before):
            hint = "the unknown function has one variable; a partial differential equation isn't read"
            raise NotLinear(f"a derivative with respect to something else than {reader.variable}", hint=hint)
        elif number is None or number.denominator != 1 or number < 0:
            raise NotLinear("the order of a derivative is a number 0, 1, 2, ...", hint="for example diff(y, x, 2)")
        else:
            order += number.numerator - 1
    check_order(order)
    return order


@lru_cache(maxsize=1024)
def _height(expression: Any) -> int:
    """The number of functions, and powers with symbols in their exponents, that are nested."""
    is_function = expression.is_Function or (expression.is_Pow and bool(expression.exp.free_symbols))
    return max(map(_height, expression.args), default=0) + bool(is_function)


def _is_zero(expression: Any) -> bool:
    """True if a factor is provably 0.  Only numbers are tested: SymPy spends seconds on a long sum with symbols, in vain."""
    if expression.is_Mul:
        return any(map(_is_zero, expression.args))
    return not expression.free_symbols and bool(expression.is_zero)


def chosen_root(polynomial: Any, field: AlgebraicField) -> Any:
    """The root of the modulus, as SymPy's polynomial, that the field means, or SymPy's first one."""
    import sympy

    if field.approximation is None or field.ground != field.base:
        return sympy.CRootOf(polynomial, 0)
    values = [field.base.rational_value(c) for c in field.modulus]
    index = real_root_index(QQ.poly([v for v in values if v is not None]), field.approximation)
    if index is not None:
        return sympy.CRootOf(polynomial, index)
    real, imaginary = (float(part) for part in field.approximation)
    check_duration(1.5**field.dimension / 20, f"isolating the roots of a polynomial of degree {field.dimension}")
    roots = [sympy.CRootOf(polynomial, k) for k in range(field.dimension)]
    return min(roots, key=lambda root: abs(complex(root.evalf(15)) - complex(real, imaginary)))

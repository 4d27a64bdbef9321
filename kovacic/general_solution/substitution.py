"""The value of an expression at a point by substitution, where each part of it is finite; its derivative; and its size.

How much SymPy writes when it expands an expression is counted before, since it can't be stopped inside.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import reduce
from operator import mul
from typing import Any

import sympy
from sympy.simplify.fu import TR8

from kovacic.closed_form.atoms import antiderivative_parameters, hypergeometric, sign_of_root
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
_ZERO = sympy.Integer(0)
_ONE = sympy.Integer(1)
#: Mathieu's odd function, and the slope of his even one, which SymPy leaves as they are at 0.
_ODD = (sympy.mathieus, sympy.mathieucprime)
#: Not a value.
_OPEN = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}
#: From which on terms and exponent of a power aren't counted.
_MANY = 10**4
#: A power of the variable with its coefficient has so many subexpressions.
_MONOMIAL = 5


def finite_value(expression: Expr, x: Expr, point: Expr) -> Expr | None:
    """The value at a point, also of a series at 0, or of an integral from the point on; None if it isn't finite."""
    check_time()
    totals = {}
    # Beside the root alone: SymPy's substitution would compute rational sums exactly, without end.
    for total in expression.atoms(sympy.RootSum):
        term = finite_value(total.fun.expr, x, point)
        if term is None:
            return None
        totals[total] = sympy.RootSum(total.poly, sympy.Lambda(total.fun.variables, term), auto=False)
    try:
        value = expression.xreplace(totals).subs(x, point)
    except TypeError:  # SymPy has compared a part that isn't a number
        return None
    if value.has(sympy.hyper, sympy.Integral, *_ODD):
        value = _at_zero(value)
    powers = (power for power in value.atoms(sympy.Pow) if power.base == 0 and not power.exp.is_nonnegative)
    zeros = {power: sign_of_root(power.exp) for power in powers}
    value = value.xreplace(dict.fromkeys(zeros, _ZERO))
    is_known = {1} >= {*zeros.values()} and not any(map(_may_diverge, value.atoms(sympy.hyper)))
    return value if is_known and _OPEN.isdisjoint(value.atoms()) else None


def slope(expression: Expr, x: Expr) -> Expr:
    """What SymPy's `diff` gives, with a look at the clock at each term and factor: it takes seconds where there are many."""
    check_time()
    if expression.is_Add:
        return sympy.Add(*[slope(term, x) for term in expression.args])
    if expression.is_Mul:
        factors = expression.args
        slopes = [(i, slope(factor, x)) for i, factor in enumerate(factors)]
        products = [(*factors[:i], inner, *factors[i + 1 :]) for i, inner in slopes if inner != 0]
        return sympy.Add(*(math.prod(product, start=_ONE) for product in products))
    if expression.is_Pow and expression.exp.is_Number:
        inner = slope(expression.base, x)
        return expression * (inner * expression.exp / expression.base)
    if isinstance(expression, sympy.hyper):
        z = expression.argument
        for e, b in antiderivative_parameters(expression):  # z F' + e F is e times the function without e and b
            rest = hypergeometric((*expression.ap, b), (*expression.bq, e), z)
            return e * (rest - expression) * z.diff(x) / z
    if expression.has(sympy.Abs):  # of what is real, else SymPy writes real and imaginary parts
        real = {symbol: sympy.Dummy(real=True) for symbol in expression.free_symbols}
        own = {dummy: symbol for symbol, dummy in real.items()}
        return expression.xreplace(real).diff(real.get(x, x)).xreplace(own)
    return expression.diff(x)


def _may_diverge(f: Expr) -> bool:
    """True for a hypergeometric function at 1, a singular point, unless its series is seen to converge there, or to end."""
    excess = sympy.Add(*f.bq) - sympy.Add(*f.ap)
    is_polynomial = any(a.is_integer and a.is_nonpositive for a in f.ap)
    return f.argument == 1 and len(f.ap) == len(f.bq) + 1 and not (excess.is_positive or is_polynomial)


def _at_zero(value: Expr) -> Expr:
    """With the values of series and odd functions of 0, and of integrals over nothing, which SymPy leaves as they are."""
    value = value.replace(lambda e: isinstance(e, sympy.hyper) and e.argument == 0, lambda e: _ONE)
    value = value.replace(lambda e: isinstance(e, _ODD) and e.args[-1] == 0, lambda e: _ZERO)
    return value.replace(
        lambda e: isinstance(e, sympy.Integral) and e.limits[0][1:2] == e.limits[0][2:], lambda e: _ZERO
    )


def in_single_waves(e: Expr) -> Expr:
    """Expanded, with sums of waves for their products."""
    return sympy.expand(TR8(sympy.expand(e)))


def by_functions(total: Expr, is_coefficient: Callable[[Expr], Any]) -> dict[Expr, Expr]:
    """The coefficients in a sum of products by what they stand before, the other factors."""
    found: dict[Expr, Expr] = defaultdict(lambda: _ZERO)
    for term in sympy.Add.make_args(total):
        own, others = sympy.sift(sympy.Mul.make_args(term), lambda factor: bool(is_coefficient(factor)), binary=True)
        found[sympy.Mul(*others)] += sympy.Mul(*own)
    return found


def changed_beside(parts: Iterable[Expr], e: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """An expression changed with a letter for each of the parts, which stay."""
    letters = {part: sympy.Dummy() for part in parts}
    return change(e.xreplace(letters)).xreplace({letter: part for part, letter in letters.items()})


# ---------------------------------------------------------------------------------------------------------------- size


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


@dataclass(frozen=True)
class _Size:
    """Terms and subexpressions at most, and the degree of a polynomial in the variable, infinite for anything else."""

    terms: float
    parts: float
    degree: float

    def __mul__(self, other: _Size) -> _Size:
        """A part of a factor is written beside every term of the other one; like powers of the variable are gathered."""
        degree = self.degree + other.degree
        terms = self.terms * other.terms
        parts = self.parts * other.terms + other.parts * self.terms + terms
        return _Size(min(terms, degree + 1), min(parts, _MONOMIAL * (degree + 1)), degree)

    def __pow__(self, k: int) -> _Size:
        """Each term has at most k of the terms of the base as factors; SymPy writes all of them before it gathers any."""
        terms = 1.0
        if self.terms > 1:
            if self.terms * k >= _MANY:
                return _Size(math.inf, math.inf, math.inf)
            terms = math.comb(int(self.terms) + k - 1, k)  # the monomials of degree k in so many letters
        parts = terms * min(k, self.terms) * (self.parts / self.terms + 2)
        return _Size(terms, parts, self.degree * k)


def expanded_size(expression: Expr) -> float:
    """The number of subexpressions at most, under roots and in functions, too; those of products of denominators aren't known.

    >>> import sympy
    >>> from sympy.abc import x
    >>> expanded_size((x + 1) * (x + 2) * (x + 3) * (x + 4))
    25.0
    >>> expanded_size((x + sympy.sin(x)) * (x + sympy.cos(x)) * (x + sympy.exp(x)))
    52.0
    """
    has_one_symbol = len(expression.free_symbols) == 1
    return float(_expression_size(expression, 1 if has_one_symbol else math.inf).parts)


def _expression_size(expression: Expr, degree: float) -> _Size:
    """`degree`: that of a symbol."""
    if expression.is_Symbol:
        return _Size(1, 1, degree)
    if expression.is_Number:
        return _Size(1, 1, 0)
    inner = [_expression_size(part, degree) for part in expression.args]
    parts = sum(one.parts for one in inner)
    if expression.is_Add:
        return _Size(sum(one.terms for one in inner), parts, max(one.degree for one in inner))
    if expression.is_Mul:
        return reduce(mul, sorted(inner, key=lambda part: part.degree))
    if expression.is_Pow and expression.exp.is_Rational and expression.exp >= 1:
        power = inner[0] ** int(expression.exp)
        if expression.exp.is_Integer:
            return power
        return replace(power, degree=math.inf)  # u^(7/3) is expanded as u^2 u^(1/3)
    return _Size(1, 1 + parts, math.inf)

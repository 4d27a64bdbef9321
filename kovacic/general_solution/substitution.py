"""The value of an expression at a point by substitution, where each part of it is finite; its derivative; and its size.

How much SymPy writes when it expands an expression is counted before, since it can't be stopped inside.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from typing import Any

import sympy
from sympy import Add, Mul, hyper
from sympy.functions.special.bessel import BesselBase
from sympy.simplify.fu import TR8

from kovacic.closed_form.atoms import RootSum, antiderivative_parameters, hypergeometric, sign_of_root
from kovacic.limits import check_time

Expr = Any  # SymPy publishes no types
#: Mathieu's odd function, and the slope of his even one, which SymPy doesn't evaluate at 0.
_ODD = (sympy.mathieus, sympy.mathieucprime)
#: Functions that SymPy leaves as they are at 0, where they may have no value.
_SINGULAR_AT_ZERO = (BesselBase, sympy.uppergamma, sympy.expint)
#: What isn't a value.
_WITHOUT_VALUE = {sympy.nan, sympy.zoo, sympy.oo, -sympy.oo}


def finite_value(expression: Expr, x: Expr, point: Expr) -> Expr | None:
    """The value at a point, also of a series at 0, or of an integral from the point on; None if it isn't finite."""
    check_time()
    totals = {}
    # beside the root alone
    for total in expression.atoms(sympy.RootSum):
        term = finite_value(total.fun.expr, x, point)
        if term is None or _is_infinite_at_a_root(total.poly, term):
            return None
        totals[total] = RootSum(total.poly, sympy.Lambda(total.fun.variables, term))
    try:
        value = expression.xreplace(totals).subs(x, point)
    except TypeError:  # SymPy has compared a part that isn't a number
        return None
    if value.has(hyper, sympy.Integral, *_ODD):
        value = _at_zero(value)
    powers = (power for power in value.atoms(sympy.Pow) if power.base == 0 and not power.exp.is_nonnegative)
    zeros = {power: sign_of_root(power.exp) for power in powers}
    value = value.xreplace(dict.fromkeys(zeros, sympy.S.Zero))
    # a factor that is zero hides them in the value
    functions = (f.subs(x, point) for f in expression.atoms(hyper, *_SINGULAR_AT_ZERO) if f.has(x))
    is_known = {1} >= {*zeros.values()} and not any(map(_may_diverge, functions))
    return value if is_known and _WITHOUT_VALUE.isdisjoint(value.atoms()) else None


def _is_infinite_at_a_root(p: Any, term: Expr) -> bool:
    """True if a logarithm of a polynomial in the letter of p has no value at one of the roots of p."""
    a = p.gen
    arguments = (f.args[0] for f in term.atoms(sympy.log) if f.args[0].has(a))
    return any(sympy.expand(sympy.resultant(p.as_expr(), u, a)) == 0 for u in arguments if u.is_polynomial(a))


def slope(expression: Expr, x: Expr) -> Expr:
    """SymPy's `diff`, with a look at the clock at each term and factor: it takes seconds where there are many."""
    check_time()
    if expression.is_Add:
        return Add(*[slope(term, x) for term in expression.args])
    if expression.is_Mul:
        factors = expression.args
        products = ((*factors[:i], slope(factor, x), *factors[i + 1 :]) for i, factor in enumerate(factors))
        return Add(*(math.prod(product, start=sympy.S.One) for product in products))
    if isinstance(expression, hyper):
        z = expression.argument
        for e, b in antiderivative_parameters(expression):  # z F' + e F is e times the function without e and b
            rest = hypergeometric((*expression.ap, b), (*expression.bq, e), z)
            return e * (rest - expression) * z.diff(x) / z
    if expression.has(sympy.Abs):  # of what is real, else SymPy writes real and imaginary parts
        real = {symbol: sympy.Dummy(real=True) for symbol in expression.free_symbols}
        return expression.xreplace(real).diff(real.get(x, x)).xreplace(inverted(real))
    return expression.diff(x)


def _may_diverge(f: Expr) -> bool:
    """True for a function at its singular point, unless it is seen to be finite: a series that converges at 1, or ends."""
    if not isinstance(f, hyper):
        return isinstance(f, _SINGULAR_AT_ZERO) and f.args[-1] == 0
    if f.argument.has(*_WITHOUT_VALUE):
        return True
    excess = Add(*f.bq) - Add(*f.ap)
    is_polynomial = any(a.is_integer and a.is_nonpositive for a in f.ap)
    return f.argument == 1 and len(f.ap) == len(f.bq) + 1 and not (excess.is_positive or is_polynomial)


def _at_zero(value: Expr) -> Expr:
    """With the values of series and odd functions at 0, and of integrals over a point, which SymPy doesn't evaluate."""
    value = value.replace(lambda e: isinstance(e, hyper) and e.argument == 0, lambda e: sympy.S.One)
    value = value.replace(lambda e: isinstance(e, _ODD) and e.args[-1] == 0, lambda e: sympy.S.Zero)
    return value.replace(
        lambda e: isinstance(e, sympy.Integral) and e.limits[0][1:2] == e.limits[0][2:], lambda e: sympy.S.Zero
    )


def in_single_waves(e: Expr) -> Expr:
    """Expanded, with sums of waves for their products and powers: of cos(x)^4 a step leaves cos(2*x)^2."""
    found = sympy.expand(TR8(sympy.expand(e)))
    return found if found == e else in_single_waves(found)


def exact_decimals(expression: Expr) -> Expr:
    """The expression with exact decimals for floats."""
    floats = (number for number in expression.atoms(sympy.Float) if number.is_finite)
    return expression.xreplace({number: sympy.Rational(str(number)) for number in floats})


def by_functions(total: Expr, is_coefficient: Callable[[Expr], Any]) -> dict[Expr, Expr]:
    """The coefficients in a sum of products by what they stand before, the other factors."""
    found: dict[Expr, Expr] = defaultdict(lambda: sympy.S.Zero)
    for term in Add.make_args(total):
        own, others = sympy.sift(Mul.make_args(term), lambda factor: bool(is_coefficient(factor)), binary=True)
        found[Mul(*others)] += Mul(*own)
    return found


def inverted(mapping: Mapping[Expr, Expr]) -> dict[Expr, Expr]:
    """The keys by their values."""
    return {value: key for key, value in mapping.items()}


def changed_beside(parts: Iterable[Expr], e: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """An expression changed with a letter for each of the parts, which stay."""
    letters = {part: sympy.Dummy() for part in parts}
    return change(e.xreplace(letters)).xreplace(inverted(letters))


def powers_of_roots(e: Expr) -> set[Expr]:
    """(x + 1)^(3/2), (x + 1)^(-3/2) and the like, which SymPy multiplies out."""
    powers = (p for p in e.atoms(sympy.Pow) if p.base.is_Add and p.exp.is_Rational)
    return {p for p in powers if not p.exp.is_Integer and abs(p.exp) > 1}


# ---------------------------------------------------------------------------------------------------------------- size


def size(expression: Expr) -> int:
    """The number of subexpressions."""
    return 1 + sum(map(size, expression.args))


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
    return float(_expansion(expression, 1 if has_one_symbol else math.inf)[1])


def _expansion(e: Expr, degree: float) -> tuple[float, float, float]:
    """Terms and subexpressions at most when it is expanded, and its degree in symbols of this one, infinite for functions."""
    if e.is_Symbol or e.is_Number:
        return 1, 1, degree if e.is_Symbol else 0
    inner = [_expansion(part, degree) for part in e.args]
    terms, parts, degrees = zip(*inner, strict=True) if inner else ((), (), ())
    if e.is_Add:
        return sum(terms), sum(parts), max(degrees)
    if e.is_Mul:
        return reduce(_product_size, sorted(inner, key=lambda factor: factor[2]))  # polynomials first
    if e.is_Pow and e.exp.is_Rational and e.exp >= 1:
        count, k = terms[0], int(e.exp)
        if count > 1 and count * k >= 10**4:  # the binomial coefficient would be a long number
            return math.inf, math.inf, math.inf
        # SymPy writes all monomials of degree k in the terms before it gathers any; each has at most k of them as factors
        monomials = math.comb(count + k - 1, k)
        whole = degrees[0] * k if e.exp.is_Integer else math.inf  # u^(7/3) is expanded as u^2 u^(1/3)
        return monomials, monomials * min(k, count) * (parts[0] / count + 2), whole
    return 1, 1 + sum(parts), math.inf


def _product_size(u: tuple[float, float, float], v: tuple[float, float, float]) -> tuple[float, float, float]:
    """A part of a factor is written beside every term of the other one; like powers of the variable are gathered."""
    (n, parts, degree), (m, others, other_degree) = u, v
    total = degree + other_degree
    # c x^n has five subexpressions
    return min(n * m, total + 1), min(parts * m + others * n + n * m, 5 * (total + 1)), total

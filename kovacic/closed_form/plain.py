"""SymPy expressions put together without SymPy's evaluation, where that would return the same expression.

`Mul`, `Pow` and functions ask about the signs, zeros and infinities of their arguments, which takes most of the time in
which a closed form is built.  The functions here return what `Mul(*factors)`, `base**exponent` and so on return: directly
where the arguments are of the kinds that closed forms are made of and have nothing in common, and through SymPy elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, cmp_to_key
from typing import Any

import sympy
from sympy import Add, Basic, Integer, Integral, Mul, Pow, Rational, S, exp, hyper, log
from sympy.core.basic import ordering_of_classes
from sympy.core.function import Function
from sympy.functions.special.hyper import TupleArg

Expr = Any  # SymPy publishes no types
_compared = cmp_to_key(Basic.compare)


@cache
def _rank(kind: Any) -> tuple[int, str]:
    """By what `Basic.compare` sorts first: the place of the class in SymPy's list, or its name if it isn't there."""
    name = kind.__name__
    return (ordering_of_classes.index(name), "") if name in ordering_of_classes else (len(ordering_of_classes), name)


def _order(e: Expr) -> tuple[tuple[int, str], Expr]:
    """The key of SymPy's order; it compares expressions, which takes long, only within a class."""
    return _rank(e.__class__), _compared(e)


class RootSum(sympy.RootSum):  # type: ignore[misc]
    """SymPy's, for polynomials with irrational coefficients: SymPy compares these with a TypeError, and so can't add two."""

    def _hashable_content(self) -> tuple[Expr, ...]:
        return self.poly.as_expr(), self.poly.gen, self.fun


def _is_sum_or_symbol(e: Expr) -> bool:
    return e.is_Symbol or (e.is_Add and not e.is_number)


def _is_sum_symbol_or_power(e: Expr) -> bool:
    return _is_sum_or_symbol(e.base if e.is_Pow and e.exp.is_Integer else e)


def power(base: Expr, exponent: Expr) -> Expr:
    """`base**exponent`."""
    if exponent is S.One:
        return base
    if exponent is S.Zero or not (exponent.is_Rational or (exponent.is_number and not exponent.has(log))):
        return Pow(base, exponent)
    product = base.is_Mul and not exponent.is_Integer and all(map(_is_sum_symbol_or_power, base.args))
    return Pow(base, exponent, evaluate=not (product or _is_sum_or_symbol(base)))


def root_of_rational(value: Expr, exponent: Expr) -> Expr:
    """`value**exponent` for a positive rational number and a rational exponent that isn't an integer."""
    p, q, e = (value.p, value.q, exponent) if exponent.p > 0 else (value.q, value.p, -exponent)
    above = -(-e.p // e.q)
    return times(Integer(p) ** e, Integer(q) ** (above - e), Rational(1, q**above))


def power_of_multiple(factor: Expr, base: Expr, exponent: Expr) -> Expr:
    """`(factor * base)**exponent` for a power `base` of a symbol or a sum."""
    if factor.is_Rational and not exponent.is_Integer and not base.is_Add:
        signed = base if factor > 0 else Mul(-1, base, evaluate=False)
        return times(root_of_rational(abs(factor), exponent), Pow(signed, exponent, evaluate=False))
    return (factor * base) ** exponent


def _is_radical(factor: Expr) -> bool:
    """A root of a positive integer."""
    return bool(factor.is_Pow and factor.base.is_Integer and factor.base.p > 0 and factor.exp.is_Rational)


def _base(factor: Expr) -> Expr:
    """The base of a factor that stays as it is beside factors with other bases; None for other factors."""
    if factor.is_Pow:
        base = factor.base
        if factor.exp.is_Rational:
            return base if base is S.Pi or not base.is_number else None
        return base if _is_sum_or_symbol(base) and factor.exp.is_number else None
    if isinstance(factor, exp):
        return S.Exp1 if not factor.args[0].is_number else None
    if isinstance(factor, Integral) or factor is S.ImaginaryUnit:  # an indefinite one: no number
        return factor
    if _is_sum_or_symbol(factor) or (isinstance(factor, Function) and not factor.is_number):
        return factor
    return None


def _collected(powers: dict[Expr, Expr], factor: Expr) -> bool:
    """Multiply the powers, which are given by base; False for a factor that needs SymPy."""
    base = _base(factor)
    if base is None:
        return False
    if base in powers:
        exponents = powers.pop(base).as_base_exp()[1], factor.as_base_exp()[1]
        if not (_is_sum_or_symbol(base) and all(e.is_Rational for e in exponents)):
            return False
        factor = power(base, sum(exponents))
    if factor is not S.One:
        powers[base] = factor
    return True


def times(*factors: Expr) -> Expr:
    """`Mul(*factors)`."""
    coefficient, powers = S.One, dict[Expr, Expr]()
    radicals: list[list[Expr]] = []  # of each product, within which they have been multiplied already
    for product in sorted(factors, key=lambda product: product.is_Mul):  # SymPy's order, which matters for the radicals
        own = []
        for factor in product.args if product.is_Mul else (product,):
            if factor.is_Rational:
                coefficient = factor if coefficient is S.One else coefficient * factor
            elif _is_radical(factor):
                own.append(factor)
            elif not _collected(powers, factor):
                return Mul(*factors)
        if own:
            radicals.append(own)
    if len(radicals) > 1:
        coefficient, product = Mul(coefficient, *(root for own in radicals for root in own)).as_coeff_Mul()
        radicals = [[factor for factor in Mul.make_args(product) if factor is not S.One]]
    return _product(coefficient, [*powers.values(), *(radicals[0] if radicals else ())])


def _product(coefficient: Expr, rest: list[Expr]) -> Expr:
    """The product of a rational number and of factors that have nothing in common."""
    if coefficient is S.Zero or not rest:
        return coefficient
    if len(rest) > 1:
        rest.sort(key=_order)
        return Mul._from_args(rest if coefficient is S.One else [coefficient, *rest], True)
    (factor,) = rest
    if coefficient is S.One:
        return factor
    if factor.is_Add:
        return plus(*(times(coefficient, term) for term in factor.args))
    return Mul._from_args([coefficient, factor], True)


def plus(*terms: Expr) -> Expr:
    """`Add(*terms)`."""
    constant, rest, monomials = S.Zero, [], set()
    for total in terms:
        for term in total.args if total.is_Add else (total,):
            if term.is_Rational:
                constant = constant + term
                continue
            monomial = term.as_coeff_Mul()[1]
            if monomial in monomials:
                return Add(*terms)
            monomials.add(monomial)
            rest.append(term)
    return Add._from_args([*([constant] if constant is not S.Zero else []), *sorted(rest, key=_order)], True)


def ratio_of_constants(c: Expr, d: Expr) -> Expr:
    """`c / d`."""
    (p, unit), (q, other) = c.as_coeff_Mul(), d.as_coeff_Mul()
    return p / q if unit == other else c / d


def quotient(numerator: Expr, denominator: Expr) -> Expr:
    """`numerator / denominator`."""
    return numerator if denominator is S.One else times(numerator, power(denominator, S.NegativeOne))


def polynomial(coefficients: Sequence[Expr], variable: Expr) -> Expr:
    """The sum of `coefficients[k] * variable**k`."""
    if not (variable.is_Symbol and all(c.is_Rational for c in coefficients)):
        return Add(*(c * variable**k for k, c in enumerate(coefficients) if c is not S.Zero))
    # In SymPy's order: the powers, then their multiples by coefficient.
    powers, multiples = [], []
    for k, c in enumerate(coefficients[1:], 1):
        if c is not S.Zero:
            x_k = variable if k == 1 else Pow(variable, Integer(k), evaluate=False)
            if c is S.One:
                powers.append(x_k)
            else:
                multiples.append((c, Mul._from_args([c, x_k], True)))
    multiples.sort(key=lambda pair: _order(pair[0]))
    constant = [c for c in coefficients[:1] if c is not S.Zero]
    return Add._from_args([*constant, *powers, *(multiple for _, multiple in multiples)], True)


def exponential(argument: Expr) -> Expr:
    """`exp(argument)`."""
    if argument is S.Zero:
        return S.One
    evaluated = argument.is_number or argument.has(log, S.ImaginaryUnit)
    return exp(argument) if evaluated else exp(argument, evaluate=False)


def logarithm(rational_function: Expr) -> Expr:
    """`log(f)` for a rational function that isn't a constant, without common factors and constant ones."""
    return log(rational_function, evaluate=False)


def hypergeometric(a: Expr, b: Expr, c: Expr, z: Expr) -> Expr:
    """`hyper((a, b), (c,), z)` for rational a, b and c, c neither a nor b, and an argument that isn't a constant."""
    return Function.__new__(hyper, TupleArg(min(a, b), max(a, b)), TupleArg(c), z, evaluate=False)

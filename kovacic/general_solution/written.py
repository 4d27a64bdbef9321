"""C1 y1 + C2 y2 + y0 as SymPy's `Eq`, in the user's symbols."""

from __future__ import annotations

from itertools import islice
from typing import Any

import sympy

from kovacic.general_solution.basis import Basis
from kovacic.general_solution.question import Question
from kovacic.general_solution.substitution import size

Expr = Any  # SymPy publishes no types
#: Digits of a float that is given back.
_DIGITS = 15


def free_constants(question: Question, basis: Basis, particular: Expr) -> tuple[Expr, Expr]:
    """C1 and C2, or the next of these names that nothing else has."""
    used = sympy.Tuple(basis.y1, basis.y2, particular).free_symbols
    used = used.union(*(condition.free_symbols for condition in question.conditions))
    excluded = [sympy.Symbol(name) for name in {*question.symbols, *(symbol.name for symbol in used)}]
    c1, c2 = islice(sympy.numbered_symbols("C", start=1, exclude=excluded), 2)
    return c1, c2


def combination(question: Question, basis: Basis, particular: Expr, constants: tuple[Expr, Expr]) -> Expr:
    """c1 y1 + c2 y2 + y0 in the user's symbols, factors that y1 and y2 share before the sum; in the variable of `basis`."""
    common: list[Expr] = []
    if 0 not in constants:
        others = sympy.Mul.make_args(basis.y2)
        common = [factor for factor in sympy.Mul.make_args(basis.y1) if factor in others]
    summands = []
    for constant, y in zip(constants, (basis.y1, basis.y2), strict=True):
        own = [factor for factor in sympy.Mul.make_args(y) if factor not in common]
        summands.append(sympy.Mul(constant, *own))
    general = sympy.Mul(*common, sympy.Add(*summands)) + particular
    if question.conditions:
        general = min(general, sympy.expand_mul(general, deep=False), key=size)
    return question.own(general)


def written(question: Question, value: Expr) -> Expr:
    """Eq(y(x), value) with the user's symbols for the variable and for those with the names of numbers."""
    x = question.function.args[0]
    if x != question.x:
        value = value.xreplace({question.x: x})
    found = sympy.Eq(question.function, value, evaluate=False)
    back = {new: symbol for symbol, new in question.renamed.items()}
    found = found.xreplace(back)
    if question.has_floats:
        return sympy.Eq(found.lhs, with_floats(found.rhs), evaluate=False)
    return found


def with_floats(e: Expr) -> Expr:
    """With floats for constants that aren't integers; orders and parameters of functions, and roots, stay as they are.

    >>> x = sympy.Symbol("x")
    >>> print(with_floats(sympy.sqrt(2) * x**2 * sympy.exp(-x / 5)))
    1.4142135623731*x**2*exp(-0.2*x)
    """
    if e.is_Integer or e.is_Symbol or isinstance(e, sympy.Integral):
        return e
    if e.is_number and not e.has(sympy.Integral):
        value = e.evalf(_DIGITS)
        if e.is_real:  # to as many digits as are given back; complex numbers as SymPy writes them
            return sympy.Float(str(value), _DIGITS)
        return value
    is_power = e.is_Pow and not isinstance(e, sympy.exp)
    if is_power and e.exp.is_Rational and e.exp.q <= 2:
        return with_floats(e.base) ** e.exp
    if e.is_Function and len(e.args) > 1:
        *parameters, argument = e.args
        return e.func(*parameters, with_floats(argument), evaluate=False)
    return e.func(*map(with_floats, e.args))

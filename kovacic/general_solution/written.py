"""C1 y1 + C2 y2 + y0 as SymPy's `Eq`, in the user's symbols."""

from __future__ import annotations

from itertools import islice
from typing import Any

import sympy

from kovacic.general_solution.question import Question
from kovacic.general_solution.substitution import size
from kovacic.general_solution.variation import Basis

Expr = Any  # SymPy publishes no types


def free_constants(question: Question, basis: Basis, particular: Expr) -> tuple[Expr, Expr]:
    """C1 and C2, or the next of these names that nothing else has."""
    taken = set(question.symbols)
    for e in (basis.y1, basis.y2, particular):
        taken |= _names_in(e)
    for condition in question.conditions:
        for e in (condition.value, *condition.points, *(term.coefficient for term in condition.terms)):
            taken |= _names_in(e)
    c1, c2 = islice(sympy.numbered_symbols("C", start=1, exclude=[sympy.Symbol(name) for name in taken]), 2)
    return c1, c2


def _names_in(e: Any) -> set[str]:
    return {symbol.name for symbol in getattr(e, "free_symbols", ())}


def combination(question: Question, basis: Basis, particular: Expr, constants: tuple[Expr, Expr]) -> Expr:
    """c1 y1 + c2 y2 + y0 in the user's symbols, factors that y1 and y2 share before the sum; in the variable of `basis`."""
    factors = [sympy.Mul.make_args(y) for y in (basis.y1, basis.y2)]
    both = 0 not in constants
    common = [factor for factor in factors[0] if factor in factors[1]] if both else []
    summands = []
    for constant, own in zip(constants, factors, strict=True):
        if constant != 0:
            summands.append(sympy.Mul(constant, *(factor for factor in own if factor not in common)))
    general = sympy.Mul(*common, sympy.Add(*summands)) + particular
    if question.conditions:
        general = min(general, sympy.expand_mul(general, deep=False), key=size)
    return question.own(general)


def written(question: Question, value: Expr) -> Expr:
    """Eq(y(x), value) with the user's symbols for the variable and for what was replaced in the equation."""
    x = question.function.args[0]
    if x != question.x:
        value = value.xreplace({question.x: x})
    found = sympy.Eq(question.function, value, evaluate=False)
    for back in question.back:
        found = found.subs(back)
    return found

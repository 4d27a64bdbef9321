"""Boundary problems with a parameter: for which of its values there are solutions other than 0, and these.

Two homogeneous conditions at two points, and an equation with lambda (or mu) in it: y'' + lambda y = 0, y(0) = y(L) = 0.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import sympy

from kovacic.errors import InputError, LimitExceeded
from kovacic.general_solution.boundary_problems import wishes_of
from kovacic.general_solution.question import Question
from kovacic.sturm_liouville.families import EigenvalueFamily, family
from kovacic.sturm_liouville.problem import SturmProblem, normal_form
from kovacic.sturm_liouville.solve import Eigenproblem

Expr = Any
_PARAMETERS = ("lambda", "lamda", "λ", "mu", "μ")
_NUMBERS = ("n", "k", "m", "j", "n_")


def eigenfunctions(question: Question) -> tuple[Expr, list[str]] | None:
    """y, with a number n in it or lambda, and for which lambda it holds; None if that isn't the question."""
    conditions = _conditions(question)
    if conditions is None or question.given.f != 0 or question.given.h is not None:
        return None
    x = question.x
    a, b, c, _ = question.coefficients
    B, c = sympy.simplify(b / a), sympy.simplify(c / a)
    parameter = next((s for s in c.free_symbols if s.name in _PARAMETERS), None)
    if parameter is None:
        return None
    c1 = sympy.simplify(c.diff(parameter))
    ends, wishes = conditions
    robins = () if isinstance(wishes, int) else wishes
    others = [B, c1, *ends, *(e for robin in robins for e in (robin.alpha, robin.beta))]
    if c1 == 0 or any(e.has(parameter) for e in others):
        return None
    c0 = sympy.simplify(c - parameter * c1)
    taken = {s.name for s in sympy.Add(*others, c0).free_symbols}
    n = sympy.Symbol(next(name for name in _NUMBERS if name not in taken), integer=True)
    sign = -1 if _with_positive_symbols(c1).is_negative else 1
    found = family(x, B, c0, sign * c1, sign * parameter, *conditions, n=n)
    if found is None:
        return None
    residues = (y.diff(x, 2) + B * y.diff(x) + (c0 + sign * found.value * c1) * y for y in found.functions)
    if any(sympy.simplify(residue) != 0 for residue in residues):
        return None
    constants = sympy.symbols("C1 C2")
    y = sympy.Add(*(constant * function for constant, function in zip(constants, found.functions, strict=False)))
    said = _said_of_eigenvalue(found, parameter, sign)
    if found.equation is not None and not taken - {x.name}:
        pieces, B, sturm_sign = normal_form(x, (sympy.S.One, B, c0, c1), ends)
        problem = Eigenproblem(SturmProblem(x, pieces, wishes, 0, B, sturm_sign), "lambda")
        with suppress(InputError, LimitExceeded):
            roots = ", ".join(str(level.value) for level in problem.levels(3, digits=15))
            said = f"{said}: {parameter} = {roots}, ..."
    return y, [f"{said}; for all other {parameter} {question.function} is 0"]


def _conditions(question: Question) -> tuple[tuple[Expr, Expr], Any] | None:
    """The two ends, and the conditions there, or 1 or -1 where they are periodic or antiperiodic; None for others."""
    given = question.conditions
    points = sorted({point for condition in given for point in condition.points}, key=sympy.default_sort_key)
    is_homogeneous = len(given) == 2 and all(condition.value == 0 for condition in given)
    if not is_homogeneous or len(points) != 2 or any(point.is_infinite for point in points):
        return None
    low, high = points
    difference = _with_positive_symbols(high - low)
    if difference.is_negative or difference.is_positive is False:
        low, high = high, low
    with suppress(InputError):  # other conditions
        wrap, wishes = wishes_of(given, (low, high))
        return (low, high), wrap or wishes
    return None


def _with_positive_symbols(e: Expr) -> Expr:
    """With positive symbols."""
    return e.xreplace({s: sympy.Symbol(s.name, positive=True) for s in e.free_symbols})


def _said_of_eigenvalue(found: EigenvalueFamily, parameter: Expr, sign: int) -> str:
    """For which values of the parameter, which is the eigenvalue times a sign."""
    if found.equation is None:
        numbers = ", ".join(str(found.first + k) for k in range(3))
        return f"this holds for {parameter} = {sign * found.value} with {found.n} = {numbers}, ..."
    shift = sign * found.shift
    said = f"this holds for the solutions of {found.equation.lhs} = {found.equation.rhs}"
    if found.zero == 0:
        return f"{said} and for {shift}"
    said = f"{said} other than {shift}"
    if found.zero.free_symbols:
        return f"{said} (that is one only if {found.zero} = 0)"
    return said

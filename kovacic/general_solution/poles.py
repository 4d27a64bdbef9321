"""The real singular points of an equation: poles of b/a and c/a, and those of the right-hand side.

Those without parameters are found: of rational coefficients, of coefficients in t = f(k x + c) and in t = x^k, and of a
right-hand side with polynomials, roots of x, or waves below the line.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import sympy

from kovacic.algebra.poly import Poly
from kovacic.closed_form.atoms import Atoms
from kovacic.equation import Equation
from kovacic.general_solution.particular import right_hand_side
from kovacic.general_solution.question import Question
from kovacic.general_solution.values import have_values
from kovacic.general_solution.zero import is_zero
from kovacic.limits import check_time
from kovacic.reading.change_of_variable import function_of_x, is_of_a_line, is_power, user_variable

Expr = Any  # SymPy publishes no types


#: Beside a point, how far zeros are looked for at first, and how many of them are looked at.
_NEAR = 8
_MOST_POINTS = 200


def is_singular(question: Question, point: Expr) -> bool:
    """True for a finite pole of b/a or c/a, and where f/a has neither a value nor a limit."""
    equation = question.equation
    atoms = Atoms(sympy.Symbol(equation.variable))
    at = question.own(function_of_x(equation)).subs(user_variable(equation), point)
    values = (question.own(atoms.poly(den)).subs(atoms.x, at) for den in _denominators(equation, equation.h is None))
    if any(value.is_finite is False or is_zero(value) for value in values):
        return True
    if equation.h is None:
        return False
    whole = right_hand_side(equation)
    smooth = whole.xreplace(dict.fromkeys(whole.atoms(sympy.Heaviside, sympy.DiracDelta), sympy.Integer(0)))
    return not have_values([smooth], question.x, point)


def _denominators(equation: Equation, with_right: bool) -> list[Poly]:
    """Those of b/a, c/a and, if it is asked for, of the rational part of f/a that aren't constant."""
    parts = (equation.b, equation.c, equation.f)[: 2 + with_right]
    return [quotient.den for part in parts if (quotient := part / equation.a).den.degree > 0]


def poles_between(question: Question, first: Expr, last: Expr) -> Iterator[tuple[Expr, bool]]:
    """Singular points between two numbers that `rational_poles` doesn't have; and True for removable ones of f/a."""
    x = question.x
    equation = question.equation
    parts = [] if equation.h is None else [right_hand_side(equation)]
    if equation.change is not None:
        if is_power(equation) and first < 0 < last:
            yield sympy.Integer(0), False
        elif not is_power(equation) and not is_of_a_line(equation):
            raise NotImplementedError("undecided: whether a singular point lies between the points that are given")
        a, b, c, f = map(question.own, question.coefficients)
        parts = [b / a, c / a, f / a]
    for below in {base: None for part in parts for base in _below_the_line(part, x)}:
        for point in _zeros(below, x, first, last):
            if point.is_number and first < point < last:
                yield point, have_values(parts, x, point)


def rational_poles(question: Question) -> Iterator[Expr]:
    """The real singular points without parameters of an equation with rational coefficients."""
    equation = question.equation
    if equation.change is not None:
        return
    for den in _denominators(equation, True):
        for factor, _ in den.field.factor(den):
            polynomial = question.own(Atoms(question.x).poly(factor))
            if polynomial.free_symbols != {question.x}:
                continue
            # an i, or roots of polynomials without a formula
            with suppress(NotImplementedError, sympy.PolynomialError):
                roots = dict.fromkeys(sympy.real_roots(sympy.Poly(polynomial, question.x, extension=True)))
                yield from (root for root in roots if equation.h is None or is_singular(question, root))


def _below_the_line(e: Expr, x: Expr) -> list[Expr]:
    """Functions whose zeros are singular points: bases of powers, cosines of tangents, arguments of logarithms."""
    powers = [power for power in e.atoms(sympy.Pow) if power.exp.is_Rational and power.exp < 0]
    found = [power.base for power in powers] + [f.args[0] for f in e.atoms(sympy.log)]
    found += [sympy.cos(f.args[0]) for f in e.atoms(sympy.tan, sympy.sec)]
    found += [sympy.sin(f.args[0]) for f in e.atoms(sympy.cot, sympy.csc)]
    return sorted({base for base in found if base.free_symbols == {x}}, key=str)


def _zeros(e: Expr, x: Expr, first: Expr, last: Expr) -> Iterator[Expr]:
    """Those between two numbers that SymPy finds, the first ones where there are many; of complex values the real part's.

    None of an expression with several functions, other than exponentials.
    """
    functions = {f for f in e.atoms(sympy.Function) if f.has(x)}
    if len(functions) > 1 and {f.func for f in functions} != {sympy.exp}:
        return  # of sin(3 x) and cos(5 x) it thinks for minutes
    t = sympy.Dummy(real=True)
    e = e.xreplace({x: t})
    if e.has(sympy.I):
        e = e.as_real_imag()[0]
    found, width = 0, _NEAR
    while first < last and found < _MOST_POINTS:
        check_time()
        end = sympy.Min(first + width, last)
        with suppress(NotImplementedError, ValueError, TypeError):
            zeros = sympy.solveset(e, t, sympy.Interval(first, end))
            if isinstance(zeros, sympy.FiniteSet):
                yield from zeros
                found += len(zeros)
        first, width = end, 2 * width

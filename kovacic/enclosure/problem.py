"""What is to be evaluated: S as a system with integer coefficients, the gauge of an equation, a decision where there
is one."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

from kovacic.algebra.ratfunc import RatFunc
from kovacic.enclosure.singular import System
from kovacic.equation import Equation
from kovacic.errors import InputError
from kovacic.solution import Solution


@dataclass(frozen=True)
class NumericProblem:
    """y'' = S y as `system`; `source` is the object that it was read from (a solution carries its certificate).

    `gauge` is g'/g = -b/(2a) where the user's equation is a z'' + b z' + c z = 0 with z = g y; None for a normal form.
    """

    system: System
    source: Any = None
    gauge: Any = None


def as_problem(equation: object) -> NumericProblem:
    """The numerical problem that `equation` stands for; see `kovacic.enclosure.evaluate.evaluate` for what is
    accepted."""
    if isinstance(equation, NumericProblem):
        return equation
    if isinstance(equation, System):
        return NumericProblem(equation)
    if isinstance(equation, Equation):
        return NumericProblem(_from_ratfunc(equation.S), equation, _gauge(equation))
    if isinstance(equation, Solution):
        return NumericProblem(_from_ratfunc(equation.S), equation, _gauge(equation.equation))
    if isinstance(equation, RatFunc):
        return NumericProblem(_from_ratfunc(equation))
    from kovacic.reading.read import read_input

    parsed = read_input(equation)
    return NumericProblem(_from_ratfunc(parsed.S), None, _gauge(parsed.equation))


def _gauge(equation: Equation | None) -> RatFunc | None:
    if equation is None:
        return None
    if not equation.is_homogeneous:
        raise InputError("numerical evaluation needs a homogeneous equation (right-hand side 0)")
    return equation.gauge if equation.gauge else None


def clear_denominators(function: RatFunc) -> System:
    """A rational function over Q as num/den with integer coefficients."""
    return _from_ratfunc(function)


def _from_ratfunc(S: Any) -> System:
    try:
        num, den = ([Fraction(c) for c in part.coefficients()] for part in (S.num, S.den))
    except (AttributeError, TypeError):
        raise InputError(
            "numerical evaluation needs S with rational coefficients (no parameters, no algebraic constants)"
        ) from None
    common = lcm(*(c.denominator for c in (*num, *den)))
    n, d = (tuple(int(c * common) for c in part) for part in (num, den))
    return System.make(n, d)

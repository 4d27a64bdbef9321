"""What tests build with, from one place: fields, polynomials, rational functions, equations, and texts that are read.

A test that needs more of the inside than this says so by its imports.

>>> str(function("(x^2 + 3)/x"))
'(x**2 + 3)/x'
>>> str(equation("x^2*y'' + x*y' + (x^2 - 1)*y = 0"))
"x^2*y'' + x*y' + (x^2 - 1)*y = 0"
"""

from __future__ import annotations

from typing import Any

from kovacic import Equation
from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.reading.read import read_input

__all__ = [
    "QQ",
    "AlgebraicField",
    "Equation",
    "Field",
    "FunctionField",
    "Poly",
    "RatFunc",
    "equation",
    "function",
    "read_input",
]


def function(text: Any, var: str | None = "x") -> RatFunc:
    """The rational function of a text or a SymPy expression."""
    return read_input(text, var=var).S


def equation(text: Any, var: str | None = None) -> Equation:
    """The equation of a text with y''."""
    found = read_input(text, var=var).equation
    assert found is not None
    return found

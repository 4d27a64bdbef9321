"""The coefficients of what was given as SymPy expressions, whatever functions they have, and the way back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy

from kovacic.errors import NotLinear
from kovacic.limits import Limits
from kovacic.reading.arithmetic import Monomial
from kovacic.reading.differential import EquationReader
from kovacic.reading.linear import REST, Symbols
from kovacic.reading.source import Source, source_of

Expr = Any  # SymPy publishes no types
Parts = Sequence[Expr]  # a, b, c, r of a y'' + b y' + c y + r = 0


def parts_of(source: Source, limits: Limits) -> tuple[Parts, list[str]]:
    """a, b, c and r, in plain symbols, and what the user should know about how they were read."""
    reader = EquationReader(source, limits, Symbols())  # type: ignore[arg-type]
    reader.arithmetic.coefficient = lambda expression: expression  # any one
    value = source.walk(reader)
    parts = getattr(value, "parts", {}) if source.unknown else {2: Monomial(1, 0), 0: reader.arithmetic.negate(value)}
    found = {k: reader.arithmetic.expression(c) for k, c in parts.items()}
    if max(found, default=0) != 2:
        raise NotLinear("a linear equation of second order is expected")
    return [found.get(k, sympy.Integer(0)) for k in (2, 1, 0, REST)], reader.notices()


def source_of_parts(parts: Parts, source: Source) -> Source:
    """The equation with these coefficients and the unknown function of `source`; S alone if that has S alone."""
    a, b, c, rest = parts
    if not source.unknown:
        return source_of(-c, source.variable)
    x = sympy.Symbol(source.variable)
    y = sympy.Function(source.unknown)(x)
    equation = a * y.diff(x, 2) + b * y.diff(x) + c * y + rest
    return source_of(equation, source.variable, unknown=y, equation=True)

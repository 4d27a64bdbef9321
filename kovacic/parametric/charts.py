"""Charts: where a statement can hold, as values of the parameters that are functions of fewer ones, and what holds there.

All tests are sufficient and exact: `within` contains every value at which a statement holds, and maybe more; `holds_on` is
True only where a statement holds at all values of a chart.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import chain, product

from kovacic.algebra.extension import ExtensionPoly
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.equation import Equation
from kovacic.parametric.functions import ParameterPoint, irreducible_factors, over_parameters
from kovacic.parametric.integers import Congruence
from kovacic.parametric.natural import Natural
from kovacic.parametric.restriction import Hypersurface, hypersurface, with_free_constant
from kovacic.parametric.riemann import Schwarz
from kovacic.parametric.statements import Both, Either, Statement, Vanishes, alternatives_of, both


def everything(statement: Statement) -> list[ParameterPoint]:
    """All values of the parameters, as one chart; none for a statement in which no function occurs."""
    fields: dict[FunctionField, None] = {}

    def noted(function: FunctionPoly) -> FunctionPoly:
        fields[function.field] = None
        return function

    statement.rewritten(noted)
    return [ParameterPoint.generic(field) for field in fields][:1]


def within(statement: Statement, charts: list[ParameterPoint]) -> list[ParameterPoint]:
    """Parts of the charts that contain all of their values at which the statement holds."""
    if isinstance(statement, Both):
        for part in statement.parts:
            charts = within(part, charts)
        return charts
    found: list[ParameterPoint] = []
    for one in charts:
        if isinstance(statement, Either):
            found += _union((within(part, [one]) for part in statement.parts), one)
            continue
        try:
            found += _where_possible(statement, one)
        except ZeroDivisionError:  # a statement doesn't hold where it isn't defined
            continue
        except (TypeError, ValueError):  # no function of parameters
            found.append(one)
    return found


def _where_possible(statement: Statement, chart: ParameterPoint) -> list[ParameterPoint]:
    """The same for a statement that isn't made of others."""
    if isinstance(statement, Vanishes):
        return _where_zero(chart.at(statement.function), chart)
    if isinstance(statement, Congruence):
        equation = chart.at(statement.equation)
        return [] if statement.holds_for(equation) is False else _where_solvable(equation, chart)
    if isinstance(statement, Schwarz):
        chart.at(statement.cubic)  # is it defined there?
    if isinstance(statement, Natural) and statement.factors is not None:
        return _union((_where_solvable(chart.at(factor), chart) for factor in statement.factors), chart)
    return [chart]


def _where_solvable(equation: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    """Where an equation for a number can have a root: everywhere, if the number occurs in it on the chart."""
    if equation.degree > 0 or not equation:
        return [chart]
    return _where_zero(equation[0], chart)


def _where_zero(value: Poly, chart: ParameterPoint) -> list[ParameterPoint]:
    if not value:
        return [chart]
    if isinstance(value, ExtensionPoly):  # over a number field, maybe a function of further parameters
        return [chart]
    if not isinstance(value, FunctionPoly):
        return []
    surfaces = [*map(hypersurface, irreducible_factors(value))]
    if any(surface.missed or surface.curve for surface in surfaces):
        return [chart]
    return [_on(surface, chart) for surface in surfaces]


def _on(surface: Hypersurface, chart: ParameterPoint) -> ParameterPoint:
    values = tuple(surface.at(over_parameters(value)) for value in chart.values)
    return ParameterPoint(chart.names, values, surface.field)


def _union(parts: Iterable[list[ParameterPoint]], chart: ParameterPoint) -> list[ParameterPoint]:
    """All of the parts of a chart; the chart alone where one of them is all of it."""
    found = [*chain.from_iterable(parts)]
    return [chart] if any(part is chart for part in found) else found


def holds_on(statement: Statement, chart: ParameterPoint) -> bool:
    """True if the statement provably holds at all values of the chart."""
    if chart.field.ground == QQ:  # a point
        return statement.holds(chart)
    if isinstance(statement, Both):
        return all(holds_on(part, chart) for part in statement.parts)
    if isinstance(statement, Either):
        return any(holds_on(part, chart) for part in statement.parts)
    try:
        if isinstance(statement, Vanishes):
            return not chart.at(statement.function)
        if isinstance(statement, Congruence):
            return statement.holds_for(chart.at(statement.equation)) is True
    except (ValueError, ZeroDivisionError):  # a function of other parameters, or not defined at these values
        pass
    return False


def covered(charts: Iterable[ParameterPoint], statements: Sequence[Statement]) -> bool:
    """True if on each chart one of the statements provably holds."""
    return all(any(holds_on(known, one) for known in statements) for one in charts)


def without_implied(statement: Statement) -> Statement:
    """The statement without an equation that follows from the others: g2 = g3 = 0 implies g2^3 = 27 g3^2."""
    if not isinstance(statement, Both):
        return statement
    parts = [*statement.parts]
    for part in statement.parts:
        others = Both(tuple(other for other in vanishing(parts) if other is not part))
        follows = isinstance(part, Vanishes) and len(others.parts) > 1
        if follows and covered(within(others, everything(part)), [part]):
            parts.remove(part)
    return Both(tuple(parts))


def vanishing(statements: Iterable[Statement]) -> list[Vanishes]:
    """Those that say that a function vanishes."""
    return [statement for statement in statements if isinstance(statement, Vanishes)]


# ------------------------------------------------------------------------------- the equation in a region


#: The equation that was given, on one piece of a region; the functions vanish there and not on every piece.
EquationThere = tuple[Equation, tuple[FunctionPoly, ...]]


def equations_on(statement: Statement, equation: Equation) -> list[EquationThere]:
    """The equation y'' + p y' + q y = 0 restricted to the pieces of a region, whose formulas have their gauge from it.

    At the zeros that make up a region, poles of b/a can merge or go to infinity, and the gauge for generic values, specialised,
    is another function.  Pieces that aren't given by functions of fewer parameters are left out.
    """
    alternatives = [alternatives_of(part) for part in both(statement).parts]
    zeros = [
        [one.function for one in vanishing(parts)] for parts in alternatives if len(vanishing(parts)) == len(parts)
    ]
    pieces = [*product(*zeros)]
    found: list[EquationThere] = []
    for piece in pieces:
        generic = _generic_zero(piece) if piece else None
        there = equation_at(equation, generic) if generic else equation
        if there is not None and (generic or not piece):
            found.append((there, piece if len(pieces) > 1 else ()))
    return found


def _generic_zero(functions: Sequence[FunctionPoly]) -> ParameterPoint | None:
    """The generic point of the common zeros; None where these aren't one piece."""
    point = ParameterPoint.generic(functions[0].field)
    try:
        for function in functions:
            factors = irreducible_factors(point.at(function))
            if len(factors) != 1:
                return None
            point = _on(hypersurface(factors[0]), point)
    except (TypeError, ZeroDivisionError):  # a function on a hypersurface, or one that isn't defined at these values
        return None
    return point


def normal_form(S: RatFunc, variable: str) -> Equation:
    """y'' - S y = 0."""
    return Equation(a=S * 0 + 1, b=S * 0, c=-S, f=S * 0, variable=variable)


def equation_at(equation: Equation, point: ParameterPoint) -> Equation | None:
    """y'' + p y' + q y = 0 with these values of the parameters; None where p or q isn't defined."""
    try:
        p, q = (point.restricted(with_free_constant(part / equation.a).S) for part in (equation.b, equation.c))
    except ZeroDivisionError:
        return None
    return replace(equation, a=q * 0 + 1, b=p, c=q, f=q * 0, h=None)

"""What the formulas of `conditions` mean, by SymPy and mpmath alone: points as numbers, solutions put into equations."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import mpmath
import sympy
from build import AlgebraicField
from parametric_cases import FAMILIES
from parametric_texts import RANGE, NotReadError, numbers_said, says

from kovacic.parametric.api import Sampler
from kovacic.parametric.claims import DegreeExists, ParameterPoint
from kovacic.parametric.natural import Natural
from kovacic.parametric.parametric_answer import ParametricAnswer
from kovacic.parametric.regions import ParameterRegion
from kovacic.parametric.statements import Statement

_PUBLISHED = Path(__file__).parents[1] / "data" / "families.jsonl"
#: The digits that are computed, and those that have to agree.
_DIGITS, _AGREE = 50, 25
#: The largest degree of a polynomial that is written out.
_LARGEST = 8


def all_families() -> dict[str, str]:
    """S by name: those with a theory in `parametric_cases`, and those of the literature."""
    found = {family.name: family.S for family in FAMILIES}
    for line in _PUBLISHED.read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        found[f"{row['name']}, published"] = row["S"]
    return found


def points_in(
    answer: ParametricAnswer, region: ParameterRegion, number: int, seed: int = 1
) -> Iterator[ParameterPoint]:
    """Points that belong to this region and to none before, at most so many."""
    sampler = Sampler(answer.constant, answer.parameters, answer.assumptions, Random(seed))
    found, points = 0, sampler.points([region.statement])
    for attempt in range(6 * number):
        point = next(points)
        if attempt % 2 or point is None or answer.region_at(point) is not region:
            continue
        found += 1
        yield point
        if found == number:
            return


def numbers_in(point: ParameterPoint, region: ParameterRegion) -> list[int | None]:
    """The degrees to be asked for: those that the exponents allow at the point, and None where there is none to choose."""
    natural = [part for part in region.naturals if part.m == 1]
    return [number for part in natural for number in part.numbers_at(point)] if natural else [None]


def as_sympy(point: ParameterPoint) -> dict[Any, Any] | None:
    """The values by symbol, exact ones where they are rational, else numbers; None where no root is meant."""
    field = point.field
    if not isinstance(field, AlgebraicField):
        return {
            sympy.Symbol(n): value.to_sympy(sympy.Symbol("x"))
            for n, value in zip(point.names, point.values, strict=True)
        }
    if field.height > 1:
        return None
    t = sympy.Symbol("t")
    root = sympy.Poly(field.modulus.to_sympy(t), t).nroots(n=_DIGITS + 20, maxsteps=500)[0]
    values = {}
    for name, value in zip(point.names, point.values, strict=True):
        value = value.over(field)
        parts = [part.to_sympy(sympy.Symbol("x")) for part in value.parts]
        exact = not any(parts[1:])
        total = sum(part * root**k for k, part in enumerate(parts))
        values[sympy.Symbol(name)] = parts[0] if exact else sympy.N(total, _DIGITS + 10)
    return values


def vanishes(expression: Any) -> bool:
    """Is a constant zero, to as many digits as are compared?"""
    with mpmath.workdps(_DIGITS):
        return abs(complex(sympy.N(expression, _DIGITS))) < 10**-_AGREE


def is_natural(degree: Any) -> bool:
    degree = sympy.nsimplify(sympy.simplify(degree)) if degree.is_number else degree
    return bool(degree.is_Integer and degree >= 0)


def residual(y: Any, equation: tuple[Any, Any, Any], x: Any, at: Any) -> tuple[Any, Any]:
    """|a y'' + b y' + c y| relative to its largest term at a point, and y there."""
    with mpmath.workdps(_DIGITS):
        function = sympy.lambdify(x, y, "mpmath")
        value, slope, half = mpmath.taylor(function, at, 2)
        a, b, c = (sympy.lambdify(x, part, "mpmath")(at) for part in equation)
        terms = [2 * a * half, b * slope, c * value]
        largest = max(map(abs, terms))
        return (abs(sum(terms)) / largest if largest else mpmath.mpf(0)), value


def equation_of(answer: ParametricAnswer) -> tuple[Any, Any, Any]:
    """The coefficients of the equation whose normal form was given, as SymPy reads them."""
    names = {name: sympy.Symbol(name) for name in (*answer.parameters, answer.variable)}
    S = sympy.sympify(answer.S.to_str(answer.variable), locals=names)
    return sympy.Integer(1), sympy.Integer(0), -S


def wrong_solutions(
    answer: ParametricAnswer, equation: tuple[Any, Any, Any], x: Any, points: int
) -> tuple[int, list[str]]:
    """How many solutions were put into the equation, and those that don't solve it, or points without one."""
    tried = 0
    wrong: list[str] = []
    for region in answer.regions:
        if region.case != 1 or not region.defined:
            continue
        for point in points_in(answer, region, points):
            values = as_sympy(point)
            if values is None:
                continue
            number, alarms = _tried_at(point, values, region, equation, x)
            tried += number
            wrong += [f"{region.statement.text()}: {alarm}" for alarm in alarms]
    return tried, wrong


def _tried_at(
    point: ParameterPoint, values: dict[Any, Any], region: ParameterRegion, equation: tuple[Any, Any, Any], x: Any
) -> tuple[int, list[str]]:
    there = tuple(sympy.sympify(part).subs(values) for part in equation)
    tried, wrong, offered = 0, list[str](), False
    for number in numbers_in(point, region):
        if number is not None and number > _LARGEST:
            return 0, []
        for solution in region.solution(number):
            offered = True
            meant = all(vanishes(condition.subs(values)) for condition in solution.conditions)
            if not meant or not is_natural(solution.degree.subs(values)):
                continue
            y = solution.y.subs(values)
            if y == 0:
                continue  # one of Jacobi's polynomials: another solution has to do
            error, _ = residual(y, there, x, mpmath.mpf(13) / 7)
            tried += 1
            if error > mpmath.mpf(10) ** -20:
                wrong.append(f"{solution} at {point}")
    return tried, wrong if tried or not offered else [f"no solution at {point}"]


def misread(answer: ParametricAnswer, points: int, seed: int = 5) -> tuple[int, list[str]]:
    """How many statements were read as text at rational points, and those whose text says something else."""
    statements = [region.statement for region in answer.regions]
    sampler = Sampler(answer.constant, answer.parameters, answer.assumptions, Random(seed))
    found = sampler.points(statements)
    read = 0
    wrong: list[str] = []
    for point in (next(found) for _ in range(points)):
        if point is None or isinstance(point.field, AlgebraicField):
            continue
        values = {
            name: value.to_sympy(sympy.Symbol("x")) for name, value in zip(point.names, point.values, strict=True)
        }
        for statement in statements:
            for part in statement.conjuncts:
                said = _comparison(part, point, values)
                read += said is not None
                wrong += [f"{part.text()} at {point}"] * (said is False)
            if statement.holds(point):
                break  # what later regions say holds elsewhere only
    return read, wrong


def text_differs(part: Statement, point: ParameterPoint, values: dict[str, Any]) -> bool:
    """Does the text say another thing than the statement means there?"""
    return _comparison(part, point, values) is False


def _comparison(part: Statement, point: ParameterPoint, values: dict[str, Any]) -> bool | None:
    """Does the text say what the statement means there?  None where it isn't one that is read."""
    try:
        claim = part.claim
        if isinstance(part, Natural) and isinstance(claim, DegreeExists):
            meant = {number for number in part.numbers_at(point) if number < RANGE.stop}
            return numbers_said(claim, values) == meant
        return says(claim, values) == part.holds(point)
    except (NotReadError, ZeroDivisionError):  # no such sentence, or a function in it isn't defined there
        return None

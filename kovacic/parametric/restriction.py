"""S on a part of parameter space: at a point, or where one polynomial vanishes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.parametric.bounded import irreducible_factors
from kovacic.parametric.formulas import shown
from kovacic.parametric.statements import Point


class UndefinedError(Exception):
    """S isn't defined at these values of the parameters."""


@dataclass(frozen=True)
class Restriction:
    """S where the parameters have the given values: constants of `field`, in the order of the names."""

    S: RatFunc
    field: Field
    names: tuple[str, ...]
    values: tuple[Poly, ...]
    text: str


def at_point(S: RatFunc, point: Point) -> RatFunc:
    """S at a point.  Raises `UndefinedError` where the denominator vanishes identically."""
    field = S.field
    if not isinstance(field, FunctionField):
        return S
    chosen = [point.values[point.names.index(name)] for name in field.names]
    return substituted(S, chosen, point.field)


def substituted(S: RatFunc, values: list[Poly], field: Field) -> RatFunc:
    """S with these values of the parameters."""
    above, below = S.cleared()
    if not isinstance(above, FunctionPoly) or not isinstance(below, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    den = below.value_at(values, field)
    if not den:
        raise UndefinedError
    return RatFunc(above.value_at(values, field), den)


def on_hypersurface(S: RatFunc, function: Poly) -> Restriction:
    """S where an irreducible polynomial in the parameters vanishes.

    A parameter that occurs linearly is eliminated, which misses the zeros of its coefficient (`missed`); else one becomes
    algebraic over the others: a number, if there are none.  Raises `UndefinedError` where S isn't defined.
    """
    field = S.field
    if not isinstance(field, FunctionField) or not isinstance(function, FunctionPoly):
        raise TypeError("parameters are expected")
    i = _eliminated(function)
    if i is None:
        return _algebraic(S, function, field)
    smaller = _without(field, i)
    above, below = (_part(function, i, k, smaller) for k in (0, 1))
    value = -above / below
    values = [value if k == i else _variable(smaller, name) for k, name in enumerate(field.names)]
    text = f"{field.names[i]} = {shown(RatFunc(-above, below))}" if below.degree >= 0 else ""
    return Restriction(substituted(S, values, smaller), smaller, field.names, tuple(values), text)


def leading_factors(function: Poly) -> list[FunctionPoly]:
    """The irreducible factors of A where `on_hypersurface` solves A t + B = 0 by t = -B/A.

    It covers the zeros at which none of them vanishes.
    """
    assert isinstance(function, FunctionPoly)
    i = _eliminated(function)
    if i is None or not _depends(function, i):
        return []
    field = function.field
    A = {(*e[: 1 + i], 0, *e[2 + i :]): c for e, c in function.num.to_dict().items() if e[1 + i]}
    factors = irreducible_factors(field.make(field.context.from_dict(A), field.context.constant(1)))
    return [factor for factor in factors if isinstance(factor, FunctionPoly)]


def missed(function: Poly) -> list[FunctionPoly]:
    """Those leading factors that can vanish at a zero of the function."""
    assert isinstance(function, FunctionPoly)
    used = sum(1 for k in function.num.degrees()[1:] if int(k))
    return leading_factors(function) if used > 2 else []  # else A and B are coprime polynomials in one parameter


def _eliminated(function: FunctionPoly) -> int | None:
    """The parameter that is eliminated: one that occurs linearly, with a constant coefficient if there is such a one."""
    linear = [i for i, k in enumerate(function.num.degrees()[1:]) if int(k) == 1]
    terms = function.num.to_dict()
    return min(linear, key=lambda i: (_depends(function, i), sum(1 for e in terms if e[1 + i])), default=None)


def _depends(function: FunctionPoly, i: int) -> bool:
    """Does the coefficient of a parameter that occurs linearly depend on the others?"""
    return any(e[1 + i] and sum(e) > 1 for e in function.num.to_dict())


def _algebraic(S: RatFunc, function: FunctionPoly, field: FunctionField) -> Restriction:
    degrees = [int(k) for k in function.num.degrees()[1:]]
    i = min((k for k, degree in enumerate(degrees) if degree), key=lambda k: degrees[k])
    smaller = _without(field, i)
    coefficients = [_part(function, i, power, smaller) for power in range(degrees[i] + 1)]
    extension = AlgebraicField(smaller, smaller.poly([c / coefficients[-1] for c in coefficients]), field.names[i])
    values: list[Poly] = [extension.generator if k == i else _variable(smaller, n) for k, n in enumerate(field.names)]
    values = [value.over(extension) for value in values]
    text = f"{shown(function)} = 0"
    return Restriction(substituted(S, values, extension), extension, field.names, tuple(values), text)


def _without(field: FunctionField, i: int) -> Field:
    rest = tuple(name for k, name in enumerate(field.names) if k != i)
    return FunctionField(rest) if rest else QQ


def _variable(field: Field, name: str) -> Poly:
    assert isinstance(field, FunctionField)
    return field.generator(name)


def _part(function: FunctionPoly, index: int, power: int, smaller: Field) -> Poly:
    """The coefficient of a power of one parameter, over the field of the others."""
    terms: dict[Any, Any] = {}
    for exponents, coefficient in function.num.to_dict().items():
        if int(exponents[1 + index]) == power:
            terms[(0, *exponents[1 : 1 + index], *exponents[2 + index :])] = coefficient
    if not isinstance(smaller, FunctionField):
        return smaller.poly([int(next(iter(terms.values()), 0))])
    return smaller.make(smaller.context.from_dict(terms), smaller.context.constant(1))

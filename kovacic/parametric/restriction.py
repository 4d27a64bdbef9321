"""S on a part of parameter space: at a point, or where one polynomial vanishes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.fields import QQ, Field
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
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


def on_hypersurface(S: RatFunc, function: Poly) -> Restriction | None:
    """S where an irreducible polynomial in the parameters vanishes; None where it can't be solved rationally.

    A parameter that occurs linearly is eliminated; with one parameter alone it becomes an algebraic number.
    """
    field = S.field
    if not isinstance(field, FunctionField) or not isinstance(function, FunctionPoly):
        raise TypeError("parameters are expected")
    degrees = [int(k) for k in function.num.degrees()[1:]]
    linear = [i for i, k in enumerate(degrees) if k == 1]
    if len(field.names) == 1 and degrees[0] > 1:
        return _algebraic(S, function, field)
    if not linear:
        return None
    i = min(linear, key=lambda k: sum(1 for e in function.num.to_dict() if e[1 + k]))
    rest = tuple(name for k, name in enumerate(field.names) if k != i)
    smaller: Field = FunctionField(rest) if rest else QQ
    above, below = (_part(function, i, k, smaller) for k in (0, 1))
    value = -above / below
    values = [
        value if k == i else smaller.generator(name)  # type: ignore[attr-defined]
        for k, name in enumerate(field.names)
    ]
    text = f"{field.names[i]} = {shown(RatFunc(-above, below))}" if below.degree >= 0 else ""
    return Restriction(substituted(S, values, smaller), smaller, field.names, tuple(values), text)


def _algebraic(S: RatFunc, function: FunctionPoly, field: FunctionField) -> Restriction:
    coefficients = [0] * (int(function.num.degrees()[1]) + 1)
    for exponents, coefficient in function.num.to_dict().items():
        coefficients[int(exponents[1])] = int(coefficient)
    modulus = QQ.poly(coefficients).monic()
    extension = AlgebraicField(QQ, modulus, field.names[0])
    values = (extension.generator,)
    return Restriction(
        substituted(S, list(values), extension), extension, field.names, values, f"{shown(function)} = 0"
    )


def _part(function: FunctionPoly, index: int, power: int, smaller: Field) -> Poly:
    """The coefficient of a power of one parameter, over the field of the others."""
    terms: dict[Any, Any] = {}
    for exponents, coefficient in function.num.to_dict().items():
        if int(exponents[1 + index]) == power:
            terms[(0, *exponents[1 : 1 + index], *exponents[2 + index :])] = coefficient
    if not isinstance(smaller, FunctionField):
        return smaller.poly([int(next(iter(terms.values()), 0))])
    return smaller.make(smaller.context.from_dict(terms), smaller.context.constant(1))

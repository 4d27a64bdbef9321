"""Functions of the parameters, elements of Q(t): their parts and their factors."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.sparse import by_power, factorisation


def over_parameters(value: Poly) -> FunctionPoly:
    """The same polynomial; raises `TypeError` where its field isn't a Q(t)."""
    if not isinstance(value, FunctionPoly):
        raise TypeError("a function over Q(t) is expected")
    return value


def element(field: FunctionField, num: Any) -> FunctionPoly:
    """A polynomial in x and the parameters over Z, as one over Q(t)."""
    return FunctionPoly(field, num, field.context.constant(1))


def numerator(function: Poly) -> FunctionPoly:
    """The numerator of a polynomial over Q(t)."""
    known = over_parameters(function)
    return element(known.field, known.num)


def irreducible_factors(function: Poly) -> list[FunctionPoly]:
    """The irreducible factors over Q of the numerator of an element of Q(t)."""
    known = over_parameters(function)
    return [element(known.field, factor) for factor, _ in factorisation(known.num)[1]]


def denominators(polynomial: Poly) -> list[FunctionPoly]:
    """The denominators of the coordinates of a polynomial over an extension of Q(t), as elements of Q(t)."""
    leaves = [leaf for leaf in polynomial.leaves() if isinstance(leaf, FunctionPoly) and not leaf.den.is_one()]
    return [element(leaf.field, leaf.den) for leaf in leaves]


def union(lists: Iterable[Iterable[FunctionPoly]]) -> list[FunctionPoly]:
    """The different polynomials of several lists, in order."""
    return list(dict.fromkeys(function for functions in lists for function in functions))


def degrees(function: FunctionPoly) -> tuple[int, ...]:
    """The degrees of the numerator in the parameters."""
    return tuple(map(int, function.num.degrees()[1:]))


def powers_of(function: FunctionPoly, i: int) -> dict[int, FunctionPoly]:
    """The coefficients of the powers of parameter number i in the numerator."""
    return {power: element(function.field, part) for power, part in by_power(function.num, 1 + i).items()}

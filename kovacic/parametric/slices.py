"""Algebraic constants together with parameters: a slice of a larger parameter space.

S over Q(t)(alpha), alpha an algebraic number, is S over Q(t, alpha) at one value of the parameter alpha.  A partition of the
larger space that is right at all of its points is right on the slice, and if it is complete there it is complete here.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import count
from typing import Any

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.parametric.statements import Both, Classes, Either, Point, Statement, Vanishes

#: The point of no algebraic constant.
NO_CONSTANT = Point((), ())


def with_free_constant(S: RatFunc) -> tuple[RatFunc, Point]:
    """S with its algebraic constant as one more parameter, and the value of this parameter.

    S is over Q(t), and then the point is empty, or over Q(t)(alpha) with a number alpha.
    """
    field = S.field
    if not isinstance(field, AlgebraicField):
        return S, NO_CONSTANT
    base = field.base
    if not isinstance(base, FunctionField):
        raise TypeError("one algebraic constant over a field with parameters is expected")
    name = next(name for k in count() if (name := field.name + "_" * k) not in base.names)
    larger = FunctionField((*base.names, name))
    lifted = RatFunc(_free(S.num, larger), _free(S.den, larger))
    numbers = AlgebraicField(QQ, _rational(field.modulus), field.name, field.approximation)
    return lifted, Point((name,), (numbers.generator,), numbers)


def _free(polynomial: Poly, larger: FunctionField) -> Poly:
    """The polynomial with the generator of its field replaced by the last parameter of the larger field."""
    assert isinstance(polynomial, ExtensionPoly)
    alpha = larger.generator(larger.names[-1])
    total = larger.poly([])
    for part in reversed(polynomial.parts):
        assert isinstance(part, FunctionPoly)
        total = total * alpha + larger.make(_widened(part.num, larger), _widened(part.den, larger))
    return total


def _widened(polynomial: Any, larger: FunctionField) -> Any:
    return larger.context.from_dict({(*e, 0): c for e, c in polynomial.to_dict().items()})


def _rational(polynomial: Poly) -> Poly:
    """A polynomial over Q(t) with rational coefficients, over Q."""
    coefficients = [polynomial.field.rational_value(polynomial[k]) for k in range(polynomial.degree + 1)]
    return QQ.poly([c for c in coefficients if c is not None])


def reduced(statement: Statement, constant: Point) -> Statement:
    """The same statement, with high powers of the constant replaced by means of its minimal polynomial."""
    if not constant.names:
        return statement
    if isinstance(statement, Vanishes):
        return Vanishes(_reduced(statement.function, constant))
    if isinstance(statement, Classes):
        return Classes.make(_reduced(statement.form, constant), statement.residues, statement.modulus)
    if isinstance(statement, Either | Both):
        return replace(statement, parts=tuple(reduced(part, constant) for part in statement.parts))
    return statement


def _reduced(function: FunctionPoly, constant: Point) -> FunctionPoly:
    """The numerator in lowest powers of the constant, the last parameter of its field."""
    field, numbers = function.field, constant.field
    assert isinstance(numbers, AlgebraicField)
    alpha, one = field.generator(field.names[-1]), field.context.constant(1)
    parts: dict[int, dict[Any, Any]] = {}
    for exponents, coefficient in function.num.to_dict().items():
        parts.setdefault(int(exponents[-1]), {})[(*exponents[:-1], 0)] = coefficient
    total = field.poly([])
    for power, terms in parts.items():
        value = numbers.generator**power
        low = sum((part[0].over(field) * alpha**k for k, part in enumerate(value.parts)), field.poly([]))
        total = total + low * field.make(field.context.from_dict(terms), one)
    return field.make(total.num, total.den * function.den)


__all__ = ["NO_CONSTANT", "reduced", "with_free_constant"]

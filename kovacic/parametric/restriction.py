"""S on a part of parameter space: at a point, where one polynomial vanishes, and on a slice that an algebraic constant makes.

S over Q(t)(alpha), alpha an algebraic number, is S over Q(t, alpha) at one value of the parameter alpha.  A partition of the
larger space that is right at all of its points is right on the slice, and if it is complete there it is complete here.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from math import gcd

from kovacic.algebra.extension import AlgebraicField, ExtensionPoly
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.parametric.functions import (
    Point,
    degrees,
    element,
    irreducible_factors,
    numerator,
    over_parameters,
    powers_of,
)
from kovacic.parametric.statements import Statement

#: The point of no algebraic constant.
NO_CONSTANT = Point((), ())


@dataclass(frozen=True)
class Hypersurface(Point):
    """Where an irreducible polynomial in the parameters vanishes: their values over a field of fewer ones, or an extension.

    The zeros of the `leading` functions (of fewer parameters) aren't covered, and `missed` are functions of which one vanishes
    at each zero that isn't covered.  On a curve with two terms `curve` is its parameter: its name, and itself.
    """

    leading: tuple[FunctionPoly, ...] = ()
    missed: tuple[FunctionPoly, ...] = ()
    curve: tuple[str, FunctionPoly] | None = None

    def back(self, function: FunctionPoly) -> FunctionPoly:
        """A function of the parameter of the curve, and of others, in the original parameters."""
        if self.curve is None:
            return function
        (T, parameter), names = self.curve, function.field.names
        values = [parameter if name == T else parameter.field.generator(name) for name in names]
        return over_parameters(function.value_at(values, parameter.field))


def hypersurface(function: FunctionPoly) -> Hypersurface:
    """Values of the parameters at which an irreducible polynomial vanishes.

    A parameter that occurs linearly is eliminated, one with a constant coefficient if there is one; else one becomes algebraic
    over the others: a number, if there are none.  A linear one with the coefficient A in A t + B misses the zeros of A; these
    are zeros of the polynomial only if there are two others, since A and B are coprime.
    """
    curve = _with_two_terms(function)
    if curve is not None:
        return curve
    names, powers = function.field.names, degrees(function)
    leading = {i: powers_of(function, i)[k] for i, k in enumerate(powers) if k}
    i = min(
        leading, key=lambda i: (powers[i], powers[i] == 1 and (not leading[i].num.is_constant(), len(leading[i].num)))
    )
    rest = FunctionField(tuple(name for name in names if name != names[i]))
    smaller: Field = rest if rest.names else QQ
    values = [rest.generator(name) if name in rest.names else smaller.poly([0]) for name in names]
    parts = powers_of(function, i)
    coefficients = [
        parts[k].value_at(values, smaller) if k in parts else smaller.poly([]) for k in range(powers[i] + 1)
    ]
    if powers[i] == 1:
        values[i] = -coefficients[0] / coefficients[1]
        factors = tuple(irreducible_factors(leading[i]))
        return Hypersurface(names, tuple(values), smaller, factors, factors if len(leading) > 2 else ())
    extension = AlgebraicField(smaller, smaller.poly([c / coefficients[-1] for c in coefficients]), names[i])
    values[i] = extension.generator
    return Hypersurface(names, tuple(value.over(extension) for value in values), extension)


def _with_two_terms(function: FunctionPoly) -> Hypersurface | None:
    """A u^p + B v^q = 0 with coprime p, q > 1, as u = alpha T^q, v = beta T^p; None for any other.

    T is a monomial in u and v, which isn't defined at u = v = 0.
    """
    names, terms = function.field.names, function.num.to_dict()
    powers = [(k, int(n), int(c)) for e, c in terms.items() for k, n in enumerate(e[1:]) if n]
    if [sum(map(bool, e)) for e in terms] != [1, 1]:
        return None
    (i, p, A), (j, q, B) = powers
    if i == j or min(p, q) < 2 or gcd(p, q) > 1:
        return None
    name = next(t for k in count() if (t := f"T{k or ''}") not in names)
    field = FunctionField((*(n for k, n in enumerate(names) if k not in (i, j)), name))
    T, s = field.generator(name), pow(p, -1, q)
    r = -s % q
    # A alpha^p + B beta^q = 0 with alpha = A^r (-B)^s, beta = A^((1 + r p)/q) (-B)^((s p - 1)/q).
    alpha = Fraction(A) ** r * Fraction(-B) ** s
    beta = Fraction(A) ** ((1 + r * p) // q) * Fraction(-B) ** ((s * p - 1) // q)
    values: list[Poly] = [field.generator(n) if n in field.names else T for n in names]
    values[i], values[j] = T**q * alpha, T**p * beta
    u, v = (function.field.generator(names[k]) for k in (i, j))
    a = pow(q, -1, p)
    parameter = (u / alpha) ** a / (v / beta) ** ((a * q - 1) // p)
    return Hypersurface(names, tuple(values), field, (T,), (u if i < j else v,), (name, parameter))


def with_free_constant(S: RatFunc) -> tuple[RatFunc, RatFunc, Point]:
    """S with its algebraic constant as one more parameter, the same as it is shown, and the value of this parameter.

    The first has its denominator in factors: with a free constant it needn't be a square where it is one.  S is over Q(t),
    and then the point is empty, or over Q(t)(alpha) with a number alpha.
    """
    field = S.field
    if not isinstance(field, AlgebraicField):
        return S, S, NO_CONSTANT
    base = field.base
    if not isinstance(base, FunctionField):
        raise TypeError("one algebraic constant over a field with parameters is expected")
    name = next(name for k in count() if (name := field.name + "_" * k) not in base.names)
    larger = FunctionField((*base.names, name))
    den = larger.poly([1])
    for factor, power in field.factor(S.den):
        den = den * _free(factor, larger) ** power
    lifted = RatFunc(_free(S.num, larger), den * _free(field.poly([S.den.lc]), larger))
    modulus = QQ.poly([base.rational_value(c) or 0 for c in field.modulus])
    numbers = AlgebraicField(QQ, modulus, field.name, field.approximation)
    shown = RatFunc(_free(S.num, larger), _free(S.den, larger))
    return lifted, shown, Point((name,), (numbers.generator,), numbers)


def _free(polynomial: Poly, larger: FunctionField) -> Poly:
    """The polynomial with the generator of its field replaced by the last parameter of the larger field."""
    assert isinstance(polynomial, ExtensionPoly)
    values = [larger.generator(name) for name in larger.names[:-1]]
    total = larger.poly([])
    for part in reversed(polynomial.parts):
        total = total * larger.generator(larger.names[-1]) + over_parameters(part).value_at(values, larger)
    return total


def reduced(statement: Statement, constant: Point) -> Statement:
    """The same statement, with high powers of the constant replaced by means of its minimal polynomial."""
    return statement.rewritten(lambda function: _reduced(function, constant)) if constant.names else statement


def _reduced(function: FunctionPoly, constant: Point) -> FunctionPoly:
    """The numerator in lowest powers of the constant, the last parameter of its field."""
    field, base, numbers = function.field, FunctionField(function.field.names[:-1]), constant.field
    assert isinstance(numbers, AlgebraicField)
    extension = AlgebraicField(base, base.poly([QQ.rational_value(c) or 0 for c in numbers.modulus]))
    values = [*(extension.embed(base.generator(name)) for name in base.names), extension.generator]
    total = _free(numerator(function).value_at(values, extension), field)
    return over_parameters(total / element(field, function.den))

"""Linear forms in the parameters, c + c1 t1 + ... + cn tn with rational coefficients."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from kovacic.algebra.function_field import FunctionPoly
from kovacic.parametric.functions import Coset, common_divisor, degrees


@dataclass(frozen=True)
class LinearCombination:
    """constant + the sum of factor * parameter, by the parameter's name."""

    constant: Fraction
    factors: Mapping[str, Fraction]

    def values(self, known: Mapping[str, Coset]) -> Coset:
        """A class that contains the values, for parameters in these classes; one occurs at least."""
        start = self.constant + sum(factor * known[name].start for name, factor in self.factors.items())
        steps = [abs(factor) * known[name].step for name, factor in self.factors.items()]
        return Coset(start, reduce(common_divisor, steps))


@dataclass(frozen=True)
class Line:
    """constant + factor * the parameter of this name."""

    name: str
    constant: Fraction
    factor: Fraction

    @property
    def root(self) -> Fraction:
        """Where it is zero."""
        return -self.constant / self.factor

    def solutions(self, values: Coset) -> Coset:
        """The values of the parameter where that of the line is one of these."""
        return Coset((values.start - self.constant) / self.factor, values.step / abs(self.factor))


def linear_of(form: FunctionPoly) -> LinearCombination | None:
    """An element of Q(t) as a linear form; None for anything else."""
    if not form.den.is_constant() or form.num.total_degree() > 1:
        return None
    den = int(form.den.leading_coefficient())
    constant = Fraction(0)
    factors = {}
    for exponents, coefficient in form.num.to_dict().items():
        value = Fraction(int(coefficient), den)
        if any(exponents[1:]):
            factors[form.field.names[exponents.index(1) - 1]] = value
        else:
            constant = value
    return LinearCombination(constant, factors)


def line_of(form: FunctionPoly) -> Line | None:
    """A linear form of one parameter; None for anything else."""
    linear = linear_of(form)
    if linear is None or len(linear.factors) != 1:
        return None
    ((name, factor),) = linear.factors.items()
    return Line(name, linear.constant, factor)


def parameters_of(form: FunctionPoly) -> list[str]:
    """The parameters in the numerator."""
    return [name for name, k in zip(form.field.names, degrees(form), strict=True) if k]

"""Darboux' transformation: an equation with an apparent singularity has the cases of one without it.

Let y'' = (V - E) y with V and W free of E and W' + W^2 = V - E0.  For every E other than E0 the map y -> y' - W y takes the
solutions to those of v'' = (V - 2 W' - E) v, and v -> v' + W v takes them back, times E0 - E.  W is rational, so one equation
has Liouvillian solutions where the other one has, with the same case and group.  At a pole with the exponents -m and m + 1,
the same for all E, and W = -m/(x - c) + ..., V - 2 W' has the coefficient m (m - 1) where V has m (m + 1).

References: G. Darboux, C. R. Acad. Sci. 94 (1882) 1456; D. Gomez-Ullate, Y. Grandati & R. Milson, J. Phys. A 47 (2014) 015203.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

import sympy

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.decide import decide
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.parametric.functions import (
    ParameterPoint,
    degrees,
    in_field,
    irreducible_factors,
    over_parameters,
    powers_of,
    union,
)
from kovacic.parametric.restriction import hypersurface, undefined
from kovacic.parametric.search import degree_equation
from kovacic.parametric.solutions import PolynomialSolution, derivative

#: Degrees of P up to which an E0 is looked for.
_DEGREE = 4


@dataclass(frozen=True)
class Transformation:
    """`special` vanishes where E = E0; S for all other values is as `simpler`, unless one of the `exceptions` vanishes."""

    special: FunctionPoly
    W: RatFunc
    simpler: RatFunc
    exceptions: tuple[FunctionPoly, ...]


def carried_back(W: RatFunc, variable: str, solution: PolynomialSolution) -> PolynomialSolution:
    """A solution v of the simpler equation as y = v' + W v."""
    x = sympy.Symbol(variable)
    quotient = W.num.to_sympy(x) / W.den.to_sympy(x)
    return replace(solution, y=derivative(solution.y, x) + sympy.factor(quotient) * solution.y)


def transformation(problem: Problem) -> Transformation | None:
    """One that lowers the apparent singularities; None where none is found."""
    before = _apparent(problem)
    energies = _energies(problem.S) if before else []
    if not energies:
        return None
    for special, W in _rational_logarithmic_derivatives(problem, energies):
        simpler = problem.S - 2 * W.derivative()
        after = analyse(simpler, problem.budget)
        if _apparent(after) < before:
            exceptions = [undefined(problem), irreducible_factors(W.cleared()[1].lc), undefined(after)]
            return Transformation(special, W, simpler, tuple(union(exceptions)))
    return None


def _apparent(problem: Problem) -> int:
    """The sum of m (m + 1) over the poles with constant exponents -m, m + 1."""
    total = 0
    for place in problem.finite_places:
        difference = place.delta  # 2 m + 1
        if place.kind is not Kind.REGULAR or difference is None:
            continue
        is_odd = difference.denominator == 1 and difference % 2 == 1
        if is_odd:
            total += int(difference**2 - 1) // 4 * place.degree
    return total


def _energies(S: RatFunc) -> list[int]:
    """The numbers of the parameters E with S = V - c E, c a number and V free of E."""
    field = S.field
    assert isinstance(field, FunctionField)
    above, below = map(over_parameters, S.cleared())
    candidates = [i for i in range(len(field.names)) if degrees(above)[i] == 1 and not degrees(below)[i]]
    found = []
    for i in candidates:
        values = [field.generator(name) for name in field.names]
        values[i] = values[i] + 1
        slope = RatFunc(above.value_at(values, field) - above, below)  # S(E + 1) - S(E)
        if slope.is_polynomial and slope.num.degree == 0 and field.rational_value(slope.num) is not None:
            found.append(i)
    return found


def _rational_logarithmic_derivatives(problem: Problem, energies: list[int]) -> Iterator[tuple[FunctionPoly, RatFunc]]:
    """`(E - E0, W)` with a W free of E, where the exponents give a P of small degree."""
    equation = degree_equation(problem)
    if equation is None:
        return
    for d in range(_DEGREE + 1):
        for special in irreducible_factors(equation(Fraction(d))):
            surfaces = (surface for surface in (_solved_for(special, i) for i in energies) if surface is not None)
            surface = next(surfaces, None)
            W = None if surface is None else _logarithmic_derivative(problem, surface)
            if W is not None:
                yield special, W


def _logarithmic_derivative(problem: Problem, surface: ParameterPoint) -> RatFunc | None:
    """The rational one of a solution on a surface, with all parameters in its field; None where there is none."""
    riccati = decide(surface.restricted(problem.S), problem.budget).riccati
    if riccati is None or riccati.degree > 1:
        return None
    W = -riccati.coefficients[0]
    if W.field != surface.field:
        return None
    field = problem.field
    assert isinstance(field, FunctionField)
    if not isinstance(W.num, FunctionPoly):
        return RatFunc(field.poly(W.num.rational_coefficients()), field.poly(W.den.rational_coefficients()))
    return RatFunc(*(in_field(over_parameters(part), field) for part in W.cleared()))


def _solved_for(function: FunctionPoly, i: int) -> ParameterPoint | None:
    """The values of the parameters where a function vanishes, if it is linear in parameter i with a constant coefficient."""
    powers = powers_of(function, i)
    is_linear = 1 in powers and powers.keys() <= {0, 1}
    if not is_linear or not powers[1].num.is_constant():
        return None
    return hypersurface(function, i)

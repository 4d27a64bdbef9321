"""Levels one degree at a time: for potentials of which only some levels are Liouvillian, or where no formula is known for all.

A solution exp(int theta) P, P of degree d, needs exponents at each singular point, at the ends those of square integrable
solutions.  The degree, a function of the parameters and maybe of E, is d on a hypersurface; there P follows from its highest
coefficient down, and what is left of the linear system vanishes exactly for the energies: Delta_d(E) = 0.

Which level it is says Sturm's theorem: a square integrable solution with k zeros is the k-th level; `zeros` counts them.

References: A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467; A. G. Ushveridze, Quasi-exactly Solvable Models (1994);
M. Razavy, Amer. J. Phys. 48 (1980) 285.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import prod
from typing import Any

import sympy

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.bound_states.ends import End
from kovacic.bound_states.families import Ends, possible
from kovacic.bound_states.frame import Spot, Uncovered
from kovacic.bound_states.question import SpectralProblem
from kovacic.bound_states.signs import Signs
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import parameters_of
from kovacic.limits import Budget
from kovacic.parametric.exponents import Exponents, LocalPart, choices, choices_of_degree
from kovacic.parametric.functions import irreducible_factors, over_parameters
from kovacic.parametric.restriction import Hypersurface, hypersurface
from kovacic.parametric.solutions import has_radicals, solution_of_degree, translated

#: Higher degrees aren't proposed.
_HIGHEST = 50
#: Conjugate poles that are used beside parameters.
_CONJUGATES = 2


@dataclass(frozen=True)
class QuasiSolution:
    """A solution with a P of degree d: a function of the parameters that vanishes, one of E, the wave function, and P.

    It is square integrable where the `conditions` hold.
    """

    degree: int
    constraint: Any
    polynomial: Any
    wave: Any
    P: Any
    conditions: tuple[Any, ...]

    @property
    def key(self) -> tuple[Any, Any, Any]:
        """Two with the same are one."""
        return self.constraint, self.polynomial, self.wave


@dataclass(frozen=True)
class _Restricted:
    """Where the degree is d: a function that vanishes there, S there, and what is known of parameters that are eliminated."""

    given: FunctionPoly
    S: RatFunc
    bounds: tuple[Any, ...] = ()


def found_of_degree(
    question: SpectralProblem, d: int, ends: Sequence[End], demands: Ends, budget: Budget
) -> Iterator[QuasiSolution]:
    """All of them; raises `Uncovered` where the exponents need too large an extension of the field."""
    S = question.parsed.S
    seen: set[Any] = set()
    for degree in _degrees(analyse(S, budget), question.energy):
        for restricted in _restricted(S, degree, d, demands.signs):
            for found in _found_on(question, restricted, d, ends, demands=demands, budget=budget):
                if found.key not in seen:
                    seen.add(found.key)
                    yield found


def constant_degrees(question: SpectralProblem, budget: Budget) -> set[int]:
    """The degrees of P that the exponents allow for every E: natural numbers, of which none is above `_HIGHEST`."""
    problem = analyse(question.parsed.S, budget)
    found = set[int]()
    with suppress(Uncovered):
        for degree in _degrees(problem, question.energy):
            value = problem.field.rational_value(degree)
            if value is not None and value.denominator == 1 and 0 <= value <= _HIGHEST:
                found.add(int(value))
    return found


@dataclass(frozen=True)
class AtEnergy:
    """What is known at one energy of a potential without parameters: levels, or that it is none.

    `is_excluded`: a solution exp(int theta) P is square integrable at an end where no other one is, and not at the other end.
    """

    levels: tuple[QuasiSolution, ...]
    is_excluded: bool


def found_at(
    question: SpectralProblem, factor: FunctionPoly, ends: Sequence[End], demands: Ends, budget: Budget
) -> AtEnergy:
    """The levels at the E where an irreducible `factor` vanishes, by the exponents that the equation has at this E."""
    surface = hypersurface(factor)
    where = _Restricted(factor, surface.restricted(question.parsed.S))
    problem = analyse(where.S, budget)
    levels = []
    is_excluded = False
    for choice in choices(problem) or ():
        value = choice.field.rational_value(choice.degree)
        if value is None or value.denominator != 1 or not 0 <= value <= _HIGHEST:
            continue
        d = int(value)
        if solution_of_degree(choice, d, question.parsed.variable, factor) is None:
            continue
        fits = [possible(_decay(choice, end, demands), demands.signs) for end in ends]
        if all(fits):
            found = _found(question, choice, d, factor, ())
            if found is not None:
                levels.append(found)
        elif any(fit and end.circle is False for fit, end in zip(fits, ends, strict=True)):
            is_excluded = True
    return AtEnergy(tuple(levels), is_excluded)


def _found_on(
    question: SpectralProblem, where: _Restricted, d: int, ends: Sequence[End], *, demands: Ends, budget: Budget
) -> Iterator[QuasiSolution]:
    """Those on one hypersurface, by the exponents."""
    for choice in choices_of_degree(analyse(where.S, budget), d) or ():
        conditions = [*where.bounds]
        for end in ends:
            conditions += _decay(choice, end, demands)
        if possible(conditions, demands.signs):
            found = _found(question, choice, d, where.given, tuple(conditions))
            if found is not None:
                yield found


def _degrees(problem: Problem, energy: str) -> Iterator[Poly]:
    """The degrees of P that the exponents give, as functions of the parameters and E.

    Raises `Uncovered` where a point is ramified, or the exponents aren't looked for.
    """
    if any(place.kind is Kind.RAMIFIED for place in problem.places):
        raise Uncovered("at a ramified singular point no solution has a polynomial in it")
    # Over a field with parameters beside E, factoring takes minutes where there are more poles than one pair.
    beside = set(parameters_of(problem.field)) - {energy}
    is_long = bool(beside) and prod(place.degree for place in problem.finite_places) > _CONJUGATES
    found = None if is_long else choices(problem)
    if found is None:
        raise Uncovered("the exponents need too large an extension of the field")
    yield from _over_field(found, problem.field)


def _over_field(found: Iterable[Exponents], field: Field) -> Iterator[Poly]:
    """The degrees that are in the field."""
    for choice in found:
        degree = _over_base(choice.degree, field)
        if degree is not None:
            yield degree


def degree_beyond(S: RatFunc, d: int, budget: Budget) -> int | None:
    """The least degree above d that P may have: the exponents say it, or it depends on E or on parameters and may be any.

    None where P has no higher degree, or where none is below `_HIGHEST`.
    """
    problem = analyse(S, budget)
    degrees = [*_over_field(choices(problem) or (), problem.field)]
    for higher in range(d + 1, _HIGHEST):
        if any(_may_be(degree, higher) for degree in degrees):
            return higher
    return None


def _may_be(degree: Poly, d: int) -> bool:
    """Is the degree d, or is it d for some values of the parameters and E?"""
    difference = over_parameters(degree - d)
    return not difference or bool(irreducible_factors(difference))


def _over_base(value: Poly, base: Field) -> Poly | None:
    """A constant of an extension as one of the field; None where it isn't one."""
    while value.field != base:
        first, *others = value.parts
        if any(others):
            return None
        value = first
    return value


def _restricted(S: RatFunc, degree: Poly, d: int, signs: Signs) -> Iterator[_Restricted]:
    """Everything, where the degree is d; the hypersurfaces on which it is, as far as the assumptions admit them."""
    difference = over_parameters(degree - d)
    if not difference:
        yield _Restricted(difference, S)
        return
    for factor in irreducible_factors(difference):
        surface = hypersurface(factor)
        if surface.curve is not None:
            continue
        eliminated = _eliminated(surface, signs)
        if all(signs.admits(name, value) for name, value in eliminated.items()):
            bounds = [bound for name, value in eliminated.items() for bound in signs.bounds_of(name, value)]
            yield _Restricted(factor, surface.restricted(S), tuple(bounds))


def _eliminated(surface: Hypersurface, signs: Signs) -> dict[str, Any]:
    """The parameters that are functions of others on it, with their values."""
    x = sympy.Dummy("x")
    found = {}
    for name, function in zip(surface.names, surface.values, strict=True):
        value = signs.real(function.to_sympy(x))
        if str(value) != name:
            found[name] = value
    return found


def _decay(choice: Exponents, end: End, demands: Ends) -> list[Any]:
    """When the exponent at an end is that of a square integrable solution."""
    x = sympy.Dummy("x")
    signs = demands.signs
    part = _part_at(end, choice, signs)
    if part.main:
        rate = -signs.real(part.main.lc.to_sympy(x)) * end.direction ** (part.main.degree + 1)
        if rate.is_number and rate.is_real is False:
            return [sympy.false]
        return [sympy.Gt(rate, 0)]
    delta = signs.real(sympy.simplify(2 * part.exponent.to_sympy(x) - 1))
    role = "right" if end.is_right else "left"
    spot = Spot(end.point, None, sympy.Integer(end.mu), (role,))
    return demands.conditions(end.domain, spot, delta)


def _part_at(end: End, choice: Exponents, signs: Signs) -> LocalPart:
    """What is chosen at an end.  Raises `Uncovered` where that is an ordinary point."""
    for part in choice.parts:
        point = sympy.oo
        if part.factor is not None:
            point = signs.real(sympy.simplify((-part.factor[0]).to_sympy(sympy.Dummy("x"))))
        if point == end.point:
            return part
    raise Uncovered(f"x = {end.at} is an ordinary point")


def _found(
    question: SpectralProblem, choice: Exponents, d: int, given: FunctionPoly, demands: tuple[Any, ...]
) -> QuasiSolution | None:
    """The solution with these exponents, and the equation for its energies; None where there is none."""
    parsed = question.parsed
    solution = solution_of_degree(choice, d, parsed.variable, given)
    possible_P = choice.polynomial(d)
    if possible_P is None or not has_radicals(choice.field):
        raise Uncovered(f"the polynomials of degree {d} don't follow from their highest coefficients")
    if solution is None:
        return None
    constraint, *conditions = solution.conditions
    E = sympy.Symbol(question.energy)
    found = QuasiSolution(
        degree=d,
        constraint=constraint,
        polynomial=_common_numerator(conditions),
        wave=_joined(solution.y, choice.field),
        P=possible_P.P.to_sympy(sympy.Symbol(parsed.variable)),
        conditions=demands,
    )
    with_energy = _at_its_energy(found, E) if constraint.has(E) else found
    if with_energy is None or not with_energy.polynomial.has(E):
        return None
    if not with_energy.polynomial.is_polynomial(E):
        raise Uncovered("the energies aren't the zeros of a polynomial")
    wave = with_energy.wave
    if parsed.equation is not None:
        wave = translated(wave, parsed.equation)
    return replace(with_energy, polynomial=sympy.factor(with_energy.polynomial), wave=wave)


def _at_its_energy(found: QuasiSolution, E: Any) -> QuasiSolution | None:
    """Where the constraint gives E: it is the equation for the energy, which is put in; None where it has several zeros.

    None as well where P exists for some values of the parameters only.
    """
    if found.polynomial != 0:
        return None
    polynomial = sympy.numer(sympy.together(found.constraint))
    energies = sympy.solve(polynomial, E)
    if len(energies) != 1:
        return None
    (energy,) = energies
    return replace(
        found,
        constraint=sympy.Integer(0),
        polynomial=polynomial,
        wave=found.wave.xreplace({E: energy}),
        conditions=tuple(condition.subs(E, energy) for condition in found.conditions),
    )


def _common_numerator(conditions: Iterable[Any]) -> Any:
    """The polynomial that is 0 where all of these functions are."""
    found = sympy.Integer(0)
    for condition in conditions:
        found = sympy.gcd(found, sympy.numer(sympy.together(condition)))
    return found


def _joined(y: Any, field: Field) -> Any:
    """With the square roots that generate the field written out, and the powers of conjugate factors as one power."""
    while isinstance(field, AlgebraicField):
        is_named = field.name.isidentifier() and field.name != "I"
        if is_named and field.dimension == 2:
            y = y.xreplace({sympy.Symbol(field.name): _root_of(field)})
        field = field.base
    powers: dict[Any, list[Any]] = {}
    for part in sympy.Mul.make_args(y):
        base, exponent = part.as_base_exp()
        powers.setdefault(exponent, []).append(base)
    return sympy.Mul(*(_product(bases) ** exponent for exponent, bases in powers.items()))


def _root_of(field: AlgebraicField) -> Any:
    """The generator a of a quadratic extension, a^2 + middle a + rest = 0."""
    x = sympy.Dummy("x")
    middle = field.modulus[1].to_sympy(x)
    rest = field.modulus[0].to_sympy(x)
    return sympy.sqrt(middle**2 / 4 - rest) - middle / 2


def _product(bases: list[Any]) -> Any:
    """The product, of whose factors the last two are multiplied out."""
    if len(bases) == 1:
        return bases[0]
    *others, first, second = bases
    return sympy.Mul(*others, sympy.expand(first * second))

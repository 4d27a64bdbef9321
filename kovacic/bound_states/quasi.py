"""Levels one degree at a time: for potentials of which only some levels are Liouvillian, or where no formula is known for all.

A solution exp(int theta) P, P of degree d, needs exponents at each singular point, at the ends those of square integrable
solutions.  The degree, a function of the parameters and maybe of E, is d on a hypersurface; there P follows from its highest
coefficient down, and what is left of the linear system vanishes exactly for the energies: Delta_d(E) = 0.

Which level it is says Sturm's theorem: a square integrable solution with k zeros is the k-th level.  Zeros of P are counted in
balls that contain one root each: a root whose ball meets the real axis is real, since its conjugate is a root as well.

References: A. V. Turbiner, Comm. Math. Phys. 118 (1988) 467; A. G. Ushveridze, Quasi-exactly Solvable Models (1994);
M. Razavy, Amer. J. Phys. 48 (1980) 285.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import prod
from typing import Any

import sympy
from flint import acb, acb_poly, arb, fmpq, fmpz_poly

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.isolation import complex_zeros
from kovacic.algebra.poly import Field, Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.bound_states.ends import End
from kovacic.bound_states.families import Ends, possible
from kovacic.bound_states.frame import Spot, Uncovered
from kovacic.engine.places import Kind, Problem, analyse
from kovacic.equation import Equation, parameters_of
from kovacic.limits import Budget
from kovacic.parametric.exponents import Exponents, choices, choices_of_degree
from kovacic.parametric.functions import irreducible_factors, over_parameters
from kovacic.parametric.restriction import hypersurface
from kovacic.parametric.solutions import Given, has_radicals, solution_of_degree

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


def found_of_degree(
    S: RatFunc, equation: Equation | None, variable: str, d: int, ends: list[End], demands: Ends, E: str, budget: Budget
) -> Iterator[QuasiSolution]:
    """All of them; raises `Uncovered` where the exponents need too large an extension of the field."""
    problem = analyse(S, budget)
    if any(place.kind is Kind.RAMIFIED for place in problem.places):
        raise Uncovered("at a ramified singular point no solution has a polynomial in it")
    generic = None if _has_many_conjugates(problem, E) else choices(problem)
    if generic is None:
        raise Uncovered("the exponents need too large an extension of the field")
    seen: set[Any] = set()
    for choice in generic:
        degree = _over_base(choice.degree, problem.field)
        if degree is None:
            continue
        for given, restricted, bounds in _of_degree(degree, d, S, problem.field, demands):
            for special in choices_of_degree(analyse(restricted, budget), d) or ():
                conditions = [*bounds, *(c for end in ends for c in _decay(special, end, demands))]
                if not possible(conditions, demands.signs):
                    continue
                found = _found(special, d, variable, given, equation, E, tuple(conditions))
                if found is not None and (found.constraint, found.polynomial, found.wave) not in seen:
                    seen.add((found.constraint, found.polynomial, found.wave))
                    yield found


def _has_many_conjugates(problem: Problem, E: str) -> bool:
    """Are there more poles than one pair outside of a field with parameters beside E, where factoring takes minutes?"""
    beside = set(parameters_of(problem.field)) - {E}
    return bool(beside) and prod(place.degree for place in problem.finite_places) > _CONJUGATES


def degree_beyond(S: RatFunc, d: int, budget: Budget) -> int | None:
    """The least degree above d that P may have: the exponents say it, or it depends on E or on parameters and may be any.

    None where P has no higher degree, or where none is below `_HIGHEST`.
    """
    problem = analyse(S, budget)
    degrees = [_over_base(choice.degree, problem.field) for choice in choices(problem) or ()]
    for higher in range(d + 1, _HIGHEST):
        for degree in degrees:
            if degree is None:
                continue
            difference = over_parameters(degree - higher)
            if not difference or irreducible_factors(difference):
                return higher
    return None


def _over_base(value: Poly, base: Field) -> Poly | None:
    """A constant of an extension as one of the field; None where it isn't one."""
    while value.field != base:
        first, *others = value.parts
        if any(others):
            return None
        value = first
    return value


def _of_degree(
    degree: Poly, d: int, S: RatFunc, field: Field, demands: Ends
) -> Iterator[tuple[FunctionPoly, RatFunc, list[Any]]]:
    """Where the degree is d: a function that vanishes there, S there, and what is known of parameters that were eliminated."""
    difference = over_parameters(degree - d)
    if not difference:
        yield difference, S, []
        return
    for factor in irreducible_factors(difference):
        surface = hypersurface(factor)
        if surface.curve is not None:
            continue
        signs = demands.signs
        values = {
            name: signs.real(v.to_sympy(sympy.Dummy("x")))
            for name, v in zip(surface.names, surface.values, strict=True)
        }
        eliminated = {name: value for name, value in values.items() if str(value) != name}
        if all(signs.admits(name, value) for name, value in eliminated.items()):
            bounds = [bound for name, value in eliminated.items() for bound in signs.bounds_of(name, value)]
            yield factor, surface.restricted(S), bounds


def _decay(choice: Exponents, end: End, demands: Ends) -> list[Any]:
    """When the exponent at an end is that of a square integrable solution."""
    x = sympy.Dummy("x")
    signs = demands.signs
    for part in choice.parts:
        point = sympy.oo if part.factor is None else signs.real(sympy.simplify((-part.factor[0]).to_sympy(x)))
        if point != end.point:
            continue
        if not part.main:
            delta = signs.real(sympy.simplify(2 * part.exponent.to_sympy(x) - 1))
            spot = Spot(point, None, sympy.Integer(end.mu), ("right" if end.is_right else "left",))
            return demands.conditions(end.domain, spot, delta)
        rate = -signs.real(part.main.lc.to_sympy(x)) * end.direction ** (part.main.degree + 1)
        return [sympy.false if rate.is_number and rate.is_real is False else sympy.Gt(rate, 0)]
    raise Uncovered(f"x = {end.at} is an ordinary point")


def _found(
    choice: Exponents,
    d: int,
    variable: str,
    given: FunctionPoly,
    equation: Equation | None,
    E: str,
    demands: tuple[Any, ...],
) -> QuasiSolution | None:
    solution = solution_of_degree(choice, d, variable, given)
    system = choice.polynomial(d)
    if system is None or not has_radicals(choice.field):
        raise Uncovered(f"the polynomials of degree {d} don't follow from their highest coefficients")
    if solution is None:  # none exists
        return None
    y = _joined(solution.y, choice.field)
    constraint, *conditions = solution.conditions
    energy = sympy.Symbol(E)
    polynomial = sympy.Integer(0)
    for condition in conditions:
        polynomial = sympy.gcd(polynomial, sympy.numer(sympy.together(condition)))
    if constraint.has(energy):
        if polynomial != 0:  # E is given, and P exists for some values of the parameters only
            return None
        constraint, polynomial = sympy.Integer(0), sympy.numer(sympy.together(constraint))
        energies = sympy.solve(polynomial, energy)
        if len(energies) != 1:
            return None
        y = y.xreplace({energy: energies[0]})
        demands = tuple(c.subs(energy, energies[0]) for c in demands)
    if not polynomial.has(energy):
        return None
    if not polynomial.is_polynomial(energy):
        raise Uncovered("the energies aren't the zeros of a polynomial")
    t = sympy.Symbol(variable)
    wave = y if equation is None else Given(lambda _: (), equation).translated(y)
    P = system[0].to_sympy(t)
    return QuasiSolution(d, constraint, sympy.factor(polynomial), wave, P, demands)


def _joined(y: Any, field: Field) -> Any:
    """With the powers of conjugate factors as one power."""
    while isinstance(field, AlgebraicField):
        if field.name.isidentifier() and field.name != "I" and field.dimension == 2:
            middle, rest = (field.modulus[k].to_sympy(sympy.Dummy("x")) for k in (1, 0))
            y = y.xreplace({sympy.Symbol(field.name): sympy.sqrt(middle**2 / 4 - rest) - middle / 2})
        field = field.base
    powers: dict[Any, list[Any]] = {}
    for part in sympy.Mul.make_args(y):
        base, exponent = part.as_base_exp()
        powers.setdefault(exponent, []).append(base)
    return sympy.Mul(*(_product(bases) ** exponent for exponent, bases in powers.items()))


def _product(bases: list[Any]) -> Any:
    return bases[0] if len(bases) == 1 else sympy.Mul(*bases[:-2], sympy.expand(bases[-2] * bases[-1]))


def levels_of(polynomial: Any, E: Any) -> Iterator[tuple[Any, Any]]:
    """The real zeros of a polynomial with rational coefficients, as SymPy's numbers and as balls."""
    for factor, _ in sympy.factor_list(polynomial, E)[1]:
        exact = sympy.Poly(factor, E)
        scaled = exact.clear_denoms()[1] if exact.domain.is_QQ else exact
        balls = complex_zeros(fmpz_poly([int(c) for c in reversed(scaled.all_coeffs())]))
        real = sorted((ball.real for ball, _ in balls if ball.imag == 0), key=lambda ball: float(ball.mid()))
        yield from zip(sympy.Poly(factor, E).real_roots(), real, strict=True)


def zeros_inside(P: Any, t: Any, E: Any, ball: arb, low: Any, high: Any) -> int | None:
    """How many zeros P has between low and high, None for no bound; None where the balls are too large."""
    coefficients = [_value(c, E, ball) for c in reversed(sympy.Poly(P, t).all_coeffs())]
    if len(coefficients) < 2:
        return 0
    count = 0
    for root in acb_poly(coefficients).roots():
        if not root.imag.contains(0):
            continue
        sides = [None if end is None else root.real - arb(str(sympy.N(end, 30))) for end in (low, high)]
        if any(side is not None and side.contains(0) for side in sides):
            return None
        above = sides[0] is None or sides[0] > 0
        below = sides[1] is None or sides[1] < 0
        count += above and below
    return count


def _value(coefficient: Any, E: Any, ball: arb) -> acb:
    """A rational function of E over Q at a ball."""
    num, den = (sympy.Poly(part, E) for part in sympy.fraction(sympy.together(coefficient)))
    above, below = (_horner(part, ball) for part in (num, den))
    return above / below


def _horner(polynomial: Any, ball: arb) -> acb:
    total = acb(0)
    for c in polynomial.all_coeffs():
        if not c.is_Rational:
            raise Uncovered("the polynomials have coefficients that aren't rational")
        total = total * ball + acb(arb(fmpq(int(c.p), int(c.q))))
    return total

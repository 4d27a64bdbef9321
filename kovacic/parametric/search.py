"""Candidates for special values from the exponents: all of them if the exponents are constant, else up to a degree.

A form F = Q0 P of degree m in the solutions, with a known Q0 and deg P <= N, exists for those parameter values at which the
linear map P -> A_(m+1) of `kovacic.engine.riccati` has a kernel; a solution exp(int theta) P, deg P = d, where
P -> P'' + 2 theta P' + (theta' + theta^2 - S) P has one.  Where no exponent depends on the parameters, N is known.

Otherwise the degree d of P in case 1 satisfies 2 (1 - d) = sum of the weights + sum of +- the exponent differences.  If the sum
doesn't depend on the parameters, P exists under polynomial conditions.  If it does, d is a natural number that is a root of a
polynomial over Q(t), and P exists where a determinant Delta_d vanishes: a statement with a natural number in it, which says
exactly when.  Cases 2 and 3 are treated in the same way through the invariants of degree 4 and 12 and their number of zeros.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import lcm, prod

from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.recurrence import FieldSeries
from kovacic.engine.places import Kind, Place, Problem
from kovacic.limits import MOST_TRIALS, check_time
from kovacic.parametric import exponents, riemann
from kovacic.parametric.claims import (
    degrees,
    irreducible_factors,
    over_parameters,
    polynomial_factors,
    rational_number,
    union,
)
from kovacic.parametric.integers import may_be_natural
from kovacic.parametric.natural import Natural
from kovacic.parametric.regions import Theory
from kovacic.parametric.restriction import hypersurface
from kovacic.parametric.statements import NEVER, Statement, all_of
from kovacic.parametric.theorems import mean_of_singular_points

#: The degree up to which solutions with generic parameters are expanded: a series for a/x + b + c x + x^2 takes 0.4 s up to the
#: degree 16, 5 s up to 24, and 33 s up to 40.
SMALL_DEGREE = 8


@dataclass
class Findings:
    """Candidates for special values, conditions for structures in their order, and phrases for what isn't proven."""

    theory: Theory
    candidates: list[FunctionPoly] = field(default_factory=list)
    conditions: list[Statement] = field(default_factory=list)
    unproven: list[str] = field(default_factory=list)

    def add(self, found: exponents.RankConditions) -> bool:
        """Add the candidates that a matrix gives; False if there can be more special values.

        All zeros of one function of a system are examined, since they contain those of the system.
        """
        examined = _examinable(found.system or ())
        self.candidates += [*found.polynomials, *(examined or [])]
        return examined is not None or found.system == ()


def _examinable(functions: Iterable[FunctionPoly]) -> list[FunctionPoly] | None:
    """The factors of the first function on whose zeros all special values are found; None without one.

    These are functions of one parameter, and those whose zeros are given by rational functions.
    """
    for factors in map(irreducible_factors, functions):
        surfaces = (hypersurface(factor) for factor in factors if sum(map(bool, degrees(factor))) > 1)
        if all(isinstance(surface.field, FunctionField) for surface in surfaces):
            return factors
    return None


def search_special_values(problem: Problem) -> Findings:
    """Candidates for the special values of the parameters.

    The exponents say which degrees of invariants are examined; a logarithm leaves none of them, and each one gives equations
    for the number of its zeros, from which the statements are made.
    """
    findings = Findings(Theory("the exponents, and polynomials of bounded or natural degree", "Kov86", "AMW11"))
    q = _common_denominator(problem)
    if q is not None:
        name = "exponents that don't depend on the parameters: invariants of bounded degree"
        findings = Findings(Theory(name, "UW96", "HW97"))
    _add_reducible(problem, q, findings)
    half_integers = _all_half_integers(problem)
    if half_integers != NEVER:
        findings.conditions.append(half_integers)
    degrees_of_invariants = _degrees_that_are_possible(problem)
    # An exponent difference that is a positive integer means a logarithm, and so case 1 or none, unless the obstruction to a
    # solution without one vanishes: its zeros are examined as a whole.
    obstructions = filter(None, map(_obstruction, problem.places)) if degrees_of_invariants else ()
    candidates = _examinable(map(over_parameters, obstructions))
    if candidates is not None:
        findings.candidates += candidates
        return findings
    for m in degrees_of_invariants:
        natural = Natural(problem.S, m, _equations_for_zeros(problem, m, findings))
        findings.conditions.append(natural)
        if exponents.with_points_apart(problem) is None:
            findings.unproven.append(f"case {natural.structure.case} where the exponents at conjugate points differ")
    return findings


def _common_denominator(problem: Problem) -> int | None:
    """The common denominator of all exponents; None if an exponent difference isn't a rational number."""
    places = [place for place in problem.places if place.kind in (Kind.REGULAR, Kind.UNRAMIFIED)]
    known = [(1 + place.delta) / 2 for place in places if place.delta is not None]
    return lcm(*(exponent.denominator for exponent in known)) if len(known) == len(places) else None


def _obstruction(place: Place) -> Poly | None:
    """The right side of the recurrence n (n - Delta) c_n = ... at n = Delta, which has to vanish, from the smaller exponent on.

    None unless the place is a rational pole of order 2, and Delta a small positive integer.
    """
    delta = place.delta
    if delta is None or delta not in range(1, SMALL_DEGREE + 1) or place.order != 2 or place.degree > 1:
        return None
    field = place.factor.field
    t = field.x - place.factor[0]
    num, den = place.num(t), place.den(t)  # den = den_2 t^2 + ...
    series = FieldSeries(field, delta.numerator)
    obstruction = None
    for n in range(1, delta.numerator + 1):
        check_time()
        powers = [(h, (1 - delta) / 2 + n - h) for h in range(1, n + 1)]
        factors = [(den[2 + h] * (e * (e - 1)) - num[h]) / den[2] for h, e in powers]
        obstruction = series.extend(field.poly([n * (n - delta)]), factors)
    return obstruction


def _degrees_that_are_possible(problem: Problem) -> list[int]:
    """4 if two places can be branch points of case 2 for some values of the parameters; 12 unless case 3 is excluded."""
    # A simple pole, or a double exponent, means a logarithm for all values, which leaves only case 1 or none.
    if any(place.order == 1 or (place.order == 2 and place.delta == 0) for place in problem.places):
        return []
    found: list[int] = []
    # The square root of an invariant needs two branch points, whose exponent differences are half-integers or unknown.
    halves = [p for p in problem.places if p.kind is Kind.REGULAR and (p.delta is None or p.delta.denominator == 2)]
    ramified = [place for place in problem.places if place.kind is Kind.RAMIFIED]
    if sum(place.degree for place in halves + ramified) >= 2:
        found.append(4)
    denominators = [place.delta.denominator for place in problem.places if place.delta is not None]
    are_possible = max(denominators, default=1) <= riemann.LARGEST_DENOMINATOR  # of Schwarz's table
    if riemann.has_regular_points_only(problem) and are_possible:
        found.append(12)
    return found


def degree_equation(problem: Problem) -> Poly | None:
    """The polynomial over Q(t) whose roots are the degrees that P can have in a solution exp(int theta) P.

    None if a solution has no rational omega, or the exponents differ at more than two conjugate points.
    """
    numbers = None if _is_ramified(problem) else exponents.degrees_of_solutions(problem)
    return None if numbers is None else numbers.equation(*numbers.choices)


def _is_ramified(problem: Problem) -> bool:
    return any(place.kind is Kind.RAMIFIED for place in problem.places)


def _add_reducible(problem: Problem, q: int | None, findings: Findings) -> None:
    """Add the values with a rational omega: candidates for each degree of P that is a number, and a statement for others.

    If the exponents have the common denominator q, there is a rational form of degree 2 or q: the product of two solutions with
    a rational omega, or y^q for a single one y = prod (x - c)^(e_c) P.
    """
    if _is_ramified(problem) or _is_excluded_by_symmetry(problem):
        return
    # All forms are examined: a set evaluates each.
    if q is not None and {*(findings.add(exponents.form_conditions(problem, m)) for m in {2, q})} == {True}:
        return
    equation = degree_equation(problem)
    if equation is None:
        findings.unproven.append("case 1 where the exponents at conjugate points differ")
        return
    factors: list[FunctionPoly] = []
    for factor in filter(may_be_natural, polynomial_factors(equation)):
        # For a degree that is a number no statement is needed if the candidates are the only special values.
        number = rational_number(-factor[0]) if factor.degree == 1 else None
        found = [exponents.NOT_COMPUTED] if number is None else exponents.conditions_of_degree(problem, int(number))
        are_complete = [findings.add(conditions) for conditions in found]  # all of them have to be added
        if not all(are_complete):
            factors.append(factor)
    if factors:
        findings.conditions.append(Natural(problem.S, 1, tuple(factors)))


def _all_half_integers(problem: Problem) -> Statement:
    """The statement that there are four regular singular points, and each exponent difference is half an odd integer.

    Then there is an invariant of degree 4 for every accessory parameter: the equation is that of the potential
    sum l_i (l_i + 1) p(z - w_i) in x = p(z), l_i the integers nearest to the differences, of which two solutions have an
    elliptic product [Darboux, C. R. Acad. Sci. 94 (1882); Treibich & Verdier 1990].
    """
    if not riemann.has_regular_points_only(problem) or riemann.singular_points(problem) != 4:
        return NEVER
    squares = [place.difference_squared for place in exponents.singular_places(problem)]
    known = [riemann.has_denominator(square, 2) for square in squares if square.degree <= 0]
    return all_of(known) if len(known) == len(squares) else NEVER


def _is_excluded_by_symmetry(problem: Problem) -> bool:
    """True if S(2c - x) = S(x) excludes a rational omega.

    With omega(x), -omega(2c - x) solves the Riccati equation.  Let its polar part at one irregular fixed point, c or infinity,
    have the other sign, so that this is another solution, and the same sign at the other one.  The Wronskian of the two
    solutions y1, y2 is y1 y2 times a rational function, a constant; but y1 y2 has an essential singularity at the other point.
    """
    center = mean_of_singular_points(problem.S)  # the mean of the poles, or of the zeros of a polynomial
    if center is None or problem.S(2 * center - problem.field.x) != problem.S:
        return False
    irregular = (place for place in problem.places if place.kind is Kind.UNRAMIFIED)
    fixed = [one for one in irregular if one.at_infinity or (one.degree == 1 and one.factor[0] == -center)]
    # In the coordinate u at a fixed point u -> -u, the leading term is that of u^(-order/2) du.
    return len({place.order // 2 % 2 for place in fixed}) == 2


def _equations_for_zeros(problem: Problem, m: int, findings: Findings) -> tuple[FunctionPoly, ...] | None:
    """Equations for the number of zeros of invariants of degree m; None if there are too many combinations of exponents.

    The constant number is left out if the candidates that are added for it are all of its special values.
    """
    complete = findings.add(exponents.form_conditions(problem, m))
    numbers = exponents.zeros_of_forms(problem, m)
    if numbers is None:
        return ()
    if prod(root.largest + 1 for root in numbers.roots) > MOST_TRIALS:
        return None
    constant = [] if complete else [over_parameters(problem.field.poly([-numbers.constant, 1]))]
    sums = map(numbers.equation, filter(any, numbers.choices))
    return tuple(union([constant, *(filter(may_be_natural, polynomial_factors(equation)) for equation in sums)]))

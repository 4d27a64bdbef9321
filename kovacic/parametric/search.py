"""Candidates for special values from the exponents: all of them where the exponents are constant, else up to a degree.

A form F = Q0 P of degree m in the solutions, with a known Q0 and deg P <= N, exists for those parameter values at which the
linear map P -> A_(m+1) of `kovacic.engine.riccati` has a kernel; a solution exp(int theta) P, deg P = d, where
P -> P'' + 2 theta P' + (theta' + theta^2 - S) P has one.  Where no exponent depends on the parameters, N is known.

Else in case 1 the degree d of P satisfies 2 (1 - d) = sum of the weights + sum of +- the exponent differences.  Where the sum
doesn't depend on the parameters, P exists under polynomial conditions.  Where it does, d is a natural number that is a root of
a polynomial over Q(t), and P exists where a determinant Delta_d vanishes: a statement with a natural number in it, which says
exactly when.  Cases 2 and 3 are treated in the same way through the invariants of degree 4 and 12 and their number of zeros.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product
from math import lcm, prod

from kovacic.algebra.extension import AlgebraicField, norm
from kovacic.algebra.function_field import FunctionField, FunctionPoly
from kovacic.algebra.poly import Field, Poly
from kovacic.decision import Structure
from kovacic.engine.places import Kind, Place, Problem
from kovacic.limits import check_time
from kovacic.parametric import riemann
from kovacic.parametric.exponents import Numbers, degrees_of_solutions, form_conditions, with_degree, zeros_of_forms
from kovacic.parametric.functions import degrees, irreducible_factors, over_parameters
from kovacic.parametric.integers import integer_roots
from kovacic.parametric.natural import Natural
from kovacic.parametric.ranks import RankConditions
from kovacic.parametric.restriction import hypersurface
from kovacic.parametric.statements import ALWAYS, NEVER, Statement, both

#: Combinations of exponents above which invariants aren't examined.
_COMBINATIONS = 400
#: Exponent differences up to which the obstruction to a solution without logarithm is computed.
_SERIES = 8
#: Singular points of Heun's equation.
_HEUN = 4
#: A rational form of this degree has a linear factor with a rational omega; one of degree 4 is that of case 2, maybe.
_SHOWS_CASE_1 = 2


@dataclass
class Findings:
    """Candidates for special values, conditions with a natural number, and what limits completeness (sentences)."""

    theory: str
    candidates: list[FunctionPoly] = field(default_factory=list)
    natural: list[Natural] = field(default_factory=list)
    unproven: list[str] = field(default_factory=list)

    def add(self, found: RankConditions) -> bool:
        """The candidates that a matrix gives; False where there can be more special values.

        Where all functions of a system vanish, one of them does: its zeros are examined as a whole.
        """
        self.candidates += found.polynomials
        if found.system is None:
            return False
        for function in found.system:
            factors = irreducible_factors(function)
            if all(map(_is_eliminated, factors)):
                self.candidates += factors
                return True
        return not found.system


def _is_eliminated(function: FunctionPoly) -> bool:
    """Does its vanishing leave rational functions of fewer parameters, so that everything on it is found?"""
    return isinstance(hypersurface(function).field, FunctionField) or sum(map(bool, degrees(function))) == 1


def search(problem: Problem) -> Findings:
    """Candidates for the special values of the parameters."""
    degrees = _degrees_that_decide(problem)
    findings = Findings("exponents that don't depend on the parameters: invariants of bounded degree")
    if degrees is None:
        findings = Findings("the exponents, and polynomials of bounded or natural degree")
        _reducible(problem, findings)
        degrees = _degrees_that_are_possible(problem)
    without_logarithm = _where_a_logarithm_vanishes(problem) if degrees else None
    if without_logarithm is not None:
        findings.candidates += without_logarithm
        degrees = {m: [Structure.REDUCIBLE] for m, possible in degrees.items() if Structure.REDUCIBLE in possible}
    by_degree: dict[int, tuple[FunctionPoly, ...] | None] = {}
    for m, possible in degrees.items():
        factors = _forms(problem, m, findings)
        if factors == ():
            continue
        if _has_conjugate_exponents(problem):
            findings.unproven.append(f"case {possible[0].case}")
        else:
            by_degree[m] = factors
    if any(m > _SHOWS_CASE_1 and Structure.REDUCIBLE in degrees[m] for m in by_degree):
        _reducible(problem, findings)
    for structure in (Structure.REDUCIBLE, Structure.IMPRIMITIVE, Structure.TETRAHEDRAL):
        for m, factors in by_degree.items():
            is_shown = structure is not Structure.REDUCIBLE or m <= _SHOWS_CASE_1
            if is_shown and structure in degrees[m]:
                findings.natural.append(Natural(problem.S, m, factors, structure))
    return findings


def _degrees_that_decide(problem: Problem) -> dict[int, list[Structure]] | None:
    """Degrees m such that every Liouvillian equation with these exponents has a rational form of one of them, and its group.

    2 and q for the reducible ones, q the common denominator of the exponents: if y1 = prod (x - c)^(e_c) P is the only
    solution with a rational omega, y1^q is rational; 4 for the imprimitive ones; 12 for the primitive ones.  None where an
    exponent difference isn't a rational number.
    """
    singular = [place for place in problem.places if place.kind in (Kind.REGULAR, Kind.UNRAMIFIED)]
    differences = [place.delta for place in singular if place.delta is not None]
    if len(differences) < len(singular):
        return None
    found: dict[int, list[Structure]] = {}
    is_ramified = _is_ramified(problem)
    if not is_ramified:
        q = lcm(*(((1 + difference) / 2).denominator for difference in differences))
        for m in {2, q}:
            found[m] = [Structure.REDUCIBLE]
    if not _has_logarithms(problem):
        if _has_two_branch_points(problem):
            found.setdefault(4, []).append(Structure.IMPRIMITIVE)
        if not is_ramified:
            found.setdefault(12, []).append(Structure.TETRAHEDRAL)
    return dict(sorted(found.items()))


def _has_logarithms(problem: Problem) -> bool:
    """Is there a simple pole, or a double exponent?  The logarithm, for all values, leaves only case 1 or none."""
    return any(place.order == 1 or (place.order == 2 and place.delta == 0) for place in problem.places)


def _where_a_logarithm_vanishes(problem: Problem) -> list[FunctionPoly] | None:
    """Hypersurfaces outside of which there is a logarithm, and so only case 1 or none: each is examined as a whole.

    Where an exponent difference is a positive integer, that is where the obstruction to a solution without one vanishes.
    None where the obstructions vanish everywhere, or their zeros can't be examined.
    """
    for place in problem.places:
        obstruction = _obstruction(place)
        if obstruction:
            factors = irreducible_factors(over_parameters(obstruction))
            if all(map(_is_eliminated, factors)):
                return factors
    return None


def _obstruction(place: Place) -> Poly | None:
    """What n (n - Delta) c_n = s_1 c_(n-1) + s_2 c_(n-2) + ... asks to vanish for n = Delta, S = s_0/t^2 + s_1/t + s_2 + ...

    c_n are the coefficients of the solution with the smaller exponent.  None where Delta isn't a small positive integer.
    """
    delta = place.delta
    if place.order != 2 or place.degree > 1 or delta is None or delta.denominator > 1 or not 0 < delta <= _SERIES:
        return None
    field = place.factor.field
    last = delta.numerator
    t = field.poly([0, 1])
    num, den = (part(t - place.factor[0]) for part in (place.num, place.den))
    s: list[Poly] = []
    for k in range(last + 1):
        s.append((num[k] - sum((den[2 + j] * s[k - j] for j in range(1, k + 1)), field.poly([]))) / den[2])
    c = [field.poly([1])]
    for n in range(1, last + 1):
        check_time()
        value = sum((s[k] * c[n - k] for k in range(1, n + 1)), field.poly([]))
        c.append(value / (n * (n - last)) if n < last else value)
    return c[last]


def _degrees_that_are_possible(problem: Problem) -> dict[int, list[Structure]]:
    """4 where two places can be branch points of case 2 for some values of the parameters; 12 where case 3 isn't excluded."""
    found: dict[int, list[Structure]] = {}
    if _has_logarithms(problem):
        return found
    if _has_two_branch_points(problem):
        found[4] = [Structure.IMPRIMITIVE]
    if riemann.is_fuchsian(problem) and all(map(_is_finite_or_unknown, problem.places)):
        found[12] = [Structure.TETRAHEDRAL]
    return found


def _is_finite_or_unknown(place: Place) -> bool:
    """Can the denominator of the exponent difference be one of Schwarz's table?"""
    return place.delta is None or place.delta.denominator <= riemann.LARGEST


def _has_two_branch_points(problem: Problem) -> bool:
    """Are there two places that can be branch points of case 2, which the square root of an invariant needs?"""
    return sum(place.degree for place in problem.places if _may_be_branch_point(place)) >= 2


def _may_be_branch_point(place: Place) -> bool:
    """Can it be one of case 2: is the exponent difference a half-integer, or not known?"""
    if place.kind is Kind.RAMIFIED:
        return True
    return place.kind is Kind.REGULAR and (place.delta is None or place.delta.denominator == 2)


def _signed_sums(squares: Sequence[Poly], constant: Fraction, field: Field) -> Poly:
    """The squarefree polynomial in Y over Q(t) whose roots are the constant plus sums of +- the square roots."""
    total = field.poly([-constant, 1])
    for square in squares:
        root = AlgebraicField(field, field.poly([-square, 0, 1])).generator  # formally, if there is one in the field
        total = norm(total(root.field.poly([0, 1]) + root))
        total = total // total.gcd(total.derivative())
    return total


def degree_equation(problem: Problem) -> Poly | None:
    """The polynomial over Q(t) whose roots are the degrees that P can have in a solution exp(int theta) P.

    None where a solution has no rational omega, or the exponents at conjugate points differ.
    """
    numbers = None if _is_ramified(problem) else degrees_of_solutions(problem)
    if numbers is None:
        return None
    return _signed_sums([square for square, _ in numbers.roots], numbers.constant, problem.field)


def _is_ramified(problem: Problem) -> bool:
    return any(place.kind is Kind.RAMIFIED for place in problem.places)


def _reducible(problem: Problem, findings: Findings) -> None:
    if _is_ramified(problem) or _is_excluded_by_symmetry(problem):
        return
    equation = degree_equation(problem)
    if equation is None:
        findings.unproven.append("case 1 where the exponents at conjugate points differ")
        return
    factors: list[FunctionPoly] = []
    for factor, _ in problem.field.factor(equation):
        if _may_be_natural(factor) and not _is_settled(problem, factor, findings):
            factors.append(over_parameters(factor))
    if factors:
        findings.natural.append(Natural(problem.S, 1, tuple(factors), Structure.REDUCIBLE))


def _is_settled(problem: Problem, factor: Poly, findings: Findings) -> bool:
    """Is the degree a number, for which the candidates are all that is special?  They are added in any case."""
    root = problem.field.rational_value(-factor[0]) if factor.degree == 1 else None
    if root is None:
        return False
    found = with_degree(problem, int(root))
    if found is None:
        return False
    complete = [findings.add(conditions) for _, conditions in found]
    return all(complete)


def all_half_integers(problem: Problem) -> Statement:
    """That there are four singular points, regular ones, and each exponent difference is half an odd integer.

    Then there is an invariant of degree 4 for every accessory parameter: the equation is that of the potential
    sum l_i (l_i + 1) p(z - w_i) in x = p(z), l_i the integers nearest to the differences, of which two solutions have an
    elliptic product [Darboux, C. R. Acad. Sci. 94 (1882); Treibich & Verdier 1990].
    """
    if not riemann.is_fuchsian(problem) or riemann.singular_points(problem) != _HEUN:
        return NEVER
    found: list[Statement] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        if place.delta_squared is None or place.delta_squared.degree > 0:
            return NEVER
        equation = over_parameters(problem.field.poly([-4 * place.delta_squared, 0, 1]))
        statement = integer_roots(equation, [1], 2)
        if statement == NEVER:
            return NEVER
        if statement != ALWAYS and statement not in found:
            found.append(statement)
    return found[0] if len(found) == 1 else both(*found)


def _is_excluded_by_symmetry(problem: Problem) -> bool:
    """Does S(2c - x) = S(x) exclude a rational omega?

    With omega(x), -omega(2c - x) solves the Riccati equation.  Let its polar part at one irregular fixed point, c or infinity,
    have the other sign, so that this is another solution, and the same sign at the other one.  The Wronskian of the two
    solutions y1, y2 is y1 y2 times a rational function, a constant; but y1 y2 has an essential singularity at the other point.
    """
    S = problem.S
    field = problem.field
    points = S.den if S.den.degree else S.num
    if points.degree < 1:
        return False
    center = -points[points.degree - 1] / (points.lc * points.degree)
    if S(2 * center - field.poly([0, 1])) != S:
        return False
    changes = set()
    for place in problem.places:
        is_fixed = place.at_infinity or (place.degree == 1 and place.factor[0] == -center)
        if is_fixed and place.kind is Kind.UNRAMIFIED:
            # In the coordinate u at a fixed point u -> -u, the leading term is that of u^(-order/2) du.
            changes.add(place.order // 2 % 2 == 0)
    return len(changes) == 2


def _forms(problem: Problem, m: int, findings: Findings) -> tuple[FunctionPoly, ...] | None:
    """Equations for the number of zeros of invariants of degree m; None where there are too many combinations of exponents."""
    complete = findings.add(form_conditions(problem, m))
    numbers = zeros_of_forms(problem, m)
    if numbers is None:
        return ()
    largest = [largest for _, largest in numbers.roots]
    if prod(k + 1 for k in largest) > _COMBINATIONS:
        return None
    factors = [] if complete else [over_parameters(problem.field.poly([-numbers.constant, 1]))]
    for multiples in product(*(range(k + 1) for k in largest)):
        if any(multiples):
            factors += _numbers_of_zeros(multiples, numbers, problem.field)
    return tuple(dict.fromkeys(factors))


def _has_conjugate_exponents(problem: Problem) -> bool:
    """Do the exponents differ at conjugate poles of order 2?"""
    return any(place.kind is Kind.REGULAR and place.delta_squared is None for place in problem.places)


def _numbers_of_zeros(multiples: Sequence[int], numbers: Numbers, field: Field) -> list[FunctionPoly]:
    """Equations for the constant + the sums of +- k times the roots."""
    chosen = [k * k * square for k, (square, _) in zip(multiples, numbers.roots, strict=True) if k]
    sums = _signed_sums(chosen, numbers.constant, field)
    return [over_parameters(factor) for factor, _ in field.factor(sums) if _may_be_natural(factor)]


def _may_be_natural(factor: Poly) -> bool:
    """Can an irreducible polynomial over Q(t) have a natural root for some values of the parameters?"""
    values = [factor.field.rational_value(c) for c in factor]
    if None in values:
        return True
    if factor.degree != 1 or values[0] is None:
        return False
    root = -values[0]
    return root.denominator == 1 and root >= 0

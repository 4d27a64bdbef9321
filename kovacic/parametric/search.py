"""Candidates for special values from the exponents: all of them where the exponents are constant, else up to a degree.

A form F = Q0 P of degree m in the solutions, with a known Q0 and deg P <= N, exists for those parameter values at which the
linear map P -> A_(m+1) of `kovacic.engine.riccati` has a kernel; a solution exp(int theta) P, deg P = d, where
P -> P'' + 2 theta P' + (theta' + theta^2 - S) P has one.  Where no exponent depends on the parameters, N is known.

Else in case 1 the degree d of P satisfies 2 (1 - d) = sum of the weights + sum of +- the exponent differences.  Where the sum
depends on the parameters each d gives an algebraic condition; where it doesn't, P exists under polynomial conditions.  Cases
2 and 3 are treated in the same way through the degree of the invariants of degree 4 and 12.  The result is a list of
polynomials that contains every special value up to the degree, and what remains unproven.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import product
from math import lcm

from kovacic.algebra.function_field import FunctionPoly
from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine import invariants
from kovacic.engine.degree_bound import irregular_difference_squared
from kovacic.engine.places import Kind, Place, Problem
from kovacic.engine.riccati import Form, singular_part
from kovacic.parametric.functions import irreducible_factors, union
from kovacic.parametric.ranks import RankConditions, rank_conditions

#: Places with exponents that depend on the parameters, above which combinations aren't tried.
_VARIABLE_PLACES = 3
_PRIMITIVE_DENOMINATORS = {1, 2, 3, 4, 5}


def has_constant_rational_exponents(problem: Problem) -> bool:
    """Are all exponent differences rational numbers, without unramified irregular places?"""
    return all(
        place.kind in (Kind.ORDINARY, Kind.RAMIFIED) or (place.kind is Kind.REGULAR and place.delta is not None)
        for place in problem.places
    )


def degrees_that_decide(problem: Problem) -> list[int]:
    """Degrees m such that every Liouvillian equation with these exponents has a rational form of one of them.

    2 and q for the reducible ones, q the common denominator of the exponents: if y1 = prod (x - c)^(e_c) P is the only
    solution with a rational omega, y1^q is rational; 4 for the imprimitive ones; 12 for the primitive ones.
    """
    if any(place.kind is Kind.RAMIFIED for place in problem.places):
        return [4]
    deltas = [place.delta for place in problem.places if place.kind is Kind.REGULAR and place.delta is not None]
    return sorted({2, 4, 12, lcm(*(((1 + delta) / 2).denominator for delta in deltas))})


def least_valuation(place: Place, m: int) -> int | None:
    """The least valuation of a rational form of degree m, whether or not there is a logarithm at special values."""
    return invariants.least_valuation(replace(place, logarithm=False), m)


def form_conditions(problem: Problem, m: int) -> RankConditions:
    """Where there are more rational forms of degree m than generically."""
    valuations = [least_valuation(place, m) for place in problem.places]
    known = [v for v in valuations if v is not None]
    if len(known) < len(valuations):
        return RankConditions()
    N = m - known[-1] - sum(v * place.degree for v, place in zip(known, problem.finite_places, strict=False))
    R0 = singular_part(problem, known[:-1])
    x = problem.field.poly([0, 1])
    images = []
    for j in range(N + 1):
        images.append(Form(m, R0, x**j).numerators(problem)[-1])
        problem.budget.check()
    return rank_conditions(images, problem) if images else RankConditions()


@dataclass
class Findings:
    """Candidates for special values, and what limits completeness (sentences).

    `reducible` are those among the candidates at which a solution of case 1 is known to exist.
    """

    candidates: list[FunctionPoly] = field(default_factory=list)
    reducible: list[FunctionPoly] = field(default_factory=list)
    unproven: list[str] = field(default_factory=list)

    def add(self, found: RankConditions) -> None:
        """The candidates that a matrix gives."""
        self.candidates += found.polynomials
        self.reducible += found.certain
        if not found.complete:
            self.unproven.append("values that are special in two or more parameters at once")


def search(problem: Problem, max_degree: int) -> Findings:
    """Candidates for the special values of the parameters."""
    findings = Findings()
    _reducible(problem, max_degree, findings)
    _imprimitive(problem, max_degree, findings)
    _primitive(problem, max_degree, findings)
    findings.candidates = union([findings.candidates])
    findings.unproven = list(dict.fromkeys(findings.unproven))
    return findings


def _differences(problem: Problem) -> list[Poly] | None:
    """The square of the exponents' difference at every singular point; None where they differ at conjugate points."""
    found: list[Poly] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        square = place.delta_squared if place.kind is Kind.REGULAR else irregular_difference_squared(place)
        if square is None or square.degree > 0:
            return None
        found += [square] * place.degree
    return found


def _signed_sums(squares: list[Poly], start: Poly) -> Poly:
    """The squarefree polynomial in Y over Q(t) whose roots are the sums of +- the square roots."""
    total = start
    for square in squares:
        # F(Y + Z) = even + odd Z with Z^2 = square, by Taylor's formula.
        even, odd, derivative = 0 * start, 0 * start, total
        for k in range(total.degree + 1):
            if k % 2:
                odd = odd + derivative * square ** (k // 2)
            else:
                even = even + derivative * square ** (k // 2)
            derivative = derivative.derivative() / (k + 1)
        total = even * even - square * odd * odd
        total = total // total.gcd(total.derivative())
    return total


def _reducible(problem: Problem, max_degree: int, findings: Findings) -> None:
    if any(place.kind is Kind.RAMIFIED for place in problem.places):
        return
    differences = _differences(problem)
    if differences is None:
        findings.unproven.append("case 1 where the exponents at conjugate points differ")
        return
    Y = problem.field.poly([0, 1])
    weights = sum(p.weight * p.degree for p in problem.places if p.kind is not Kind.ORDINARY)
    sums = _signed_sums(differences, Y)
    unbounded = any(problem.field.rational_value(c) is None for factor, _ in problem.field.factor(sums) for c in factor)
    constant: set[int] = set()
    for factor, _ in problem.field.factor(sums):
        values = [problem.field.rational_value(c) for c in factor]
        if factor.degree == 1 and values[0] is not None:
            d = 1 - (weights - values[0]) / 2
            if d.denominator == 1 and d >= 0:
                constant.add(int(d))
            continue
        if all(v is not None for v in values):
            continue  # irrational for all values of the parameters
        for d_ in range(max_degree + 1):
            problem.budget.check()
            value = factor(problem.field.poly([2 * (d_ - 1) + weights]))
            findings.candidates += irreducible_factors(value)
    if unbounded:
        findings.unproven.append(f"case 1 above degree {max_degree} of P")
    if constant and not _with_constant_degree(problem, constant, findings):
        findings.unproven.append("case 1 where the exponents are irrational functions of the parameters")


def _with_constant_degree(problem: Problem, degrees: set[int], findings: Findings) -> bool:
    """Conditions for P where the sum of the exponents doesn't depend on the parameters; False if theta isn't rational."""
    choices: list[list[tuple[RatFunc, Poly]]] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        options = _local_parts(place, problem)
        if options is None:
            return False
        choices.append(options)
    x = problem.field.poly([0, 1])
    for choice in product(*choices):
        theta = sum((part for part, _ in choice), RatFunc(problem.field.poly([])))
        total = sum((exponent for _, exponent in choice), problem.field.poly([]))
        d = problem.field.rational_value(1 - total)
        if d is None or d.denominator != 1 or int(d) not in degrees or d < 0:
            continue
        zeroth = theta.derivative() + theta * theta - problem.S
        common = theta.den * zeroth.den
        images = []
        for j in range(int(d) + 1):
            problem.budget.check()
            P = x**j
            value = (P.derivative().derivative() + zeroth * P + 2 * theta * P.derivative()) * common
            images.append(value.num)
        findings.add(rank_conditions(images, problem, certify=True))
    return True


def _local_parts(place: Place, problem: Problem) -> list[tuple[RatFunc, Poly]] | None:
    """The two local parts of theta, with the sum of the exponents; None where they aren't rational over Q(t)."""
    base = problem.field
    zero = RatFunc(base.poly([]))
    if place.kind is Kind.REGULAR:
        if place.delta_squared is None:
            return None
        root = base.sqrt(place.delta_squared)
        if root is None or (place.degree > 1 and not place.at_infinity):
            return None
        exponents = [(1 + root) / 2, (1 - root) / 2]
        if place.at_infinity:
            return [(zero, e) for e in exponents]
        return [(RatFunc(e * place.factor.derivative(), place.factor), e) for e in exponents]
    if not place.at_infinity:
        return None
    S, n, x = problem.S, place.order // 2 - 2, base.poly([0, 1])
    quotient = S.num * x // S.den
    lead = base.sqrt(quotient.lc)
    if lead is None:
        return None
    root = lead * x**n  # S - root^2 = b x^(n-1) + ..., and omega = +-root + e/x + ... with e = (+-b/a - n)/2
    for k in range(1, n + 1):
        root = root + (quotient - x * root * root)[2 * n - k + 1] / (2 * lead) * x ** (n - k)
    ratio = (quotient - x * root * root)[n] / lead
    return [(RatFunc(sign * root), 1 - (sign * ratio - n) / 2) for sign in (1, -1)]


def _imprimitive(problem: Problem, max_degree: int, findings: Findings) -> None:
    branch_points = sum(  # places that can be branch points of case 2 for some values of the parameters
        place.degree
        for place in problem.places
        if place.kind is Kind.RAMIFIED
        or (place.kind is Kind.REGULAR and (place.delta is None or place.delta.denominator == 2))
    )
    if branch_points >= 2 and not _forms(problem, 4, max_degree, findings):
        findings.unproven.append("case 2")


def _primitive(problem: Problem, max_degree: int, findings: Findings) -> None:
    if any(place.kind in (Kind.UNRAMIFIED, Kind.RAMIFIED) for place in problem.places):
        return
    for place in problem.places:
        if place.delta is not None and place.delta.denominator not in _PRIMITIVE_DENOMINATORS:
            return
    if not _forms(problem, 12, max_degree, findings):
        findings.unproven.append("case 3")


def _forms(problem: Problem, m: int, max_degree: int, findings: Findings) -> bool:
    """Candidates for invariants of degree m; False where there are too many combinations of exponents."""
    variable = [
        place
        for place in problem.places
        if place.kind is Kind.REGULAR
        and (place.delta_squared is None or problem.field.rational_value(place.delta_squared) is None)
    ]
    findings.add(replace(form_conditions(problem, m), certain=()))
    if not variable:
        return True
    points = [place.delta_squared for place in variable for _ in range(place.degree)]
    known = [square for square in points if square is not None]
    if len(known) < len(points) or len(variable) > (_VARIABLE_PLACES if m == 4 else 1):
        return False
    room = m - m // 2 * len(points)
    for place in problem.places:
        if place not in variable:
            v = least_valuation(place, m)
            if v is None:
                return True
            room -= v * place.degree
    seen: list[Poly] = []
    for choice in product(range(m // 2 + 1), repeat=len(points)):
        squares = [k * k * square for k, square in zip(choice, known, strict=True) if k]
        if not squares:
            continue
        sums = _signed_sums(squares, problem.field.poly([0, 1]))
        if sums in seen:
            continue
        seen.append(sums)
        for N in range(max_degree + 1):
            problem.budget.check()
            value = sums(problem.field.poly([N - room]))
            if value:
                findings.candidates += irreducible_factors(value)
    findings.unproven.append(f"invariants of degree {m} with more than {max_degree} zeros")
    return True

"""Everything else: candidates from the exponents, up to a degree.

In case 1 the degree d of P satisfies 2 (1 - d) = sum of the weights + sum of +- the exponent differences.  Where the sum
depends on the parameters each d gives an algebraic condition; where it doesn't, P exists under polynomial conditions.  Cases
2 and 3 are treated in the same way through the degree of the invariants of degree 4 and 12.  The result is a list of
polynomials that contains every special value up to the degree, and what remains unproven.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc
from kovacic.engine.degree_bound import irregular_difference_squared
from kovacic.engine.places import Kind, Place, Problem
from kovacic.parametric.bounded import (
    form_conditions,
    irreducible_factors,
    least_valuation,
    rank_conditions,
    rank_drops,
    union,
)

#: Places with exponents that depend on the parameters, above which combinations aren't tried.
_VARIABLE_PLACES = 3
_SEVERAL = "values that are special in two or more parameters at once"
_PRIMITIVE_DENOMINATORS = {1, 2, 3, 4, 5}


@dataclass
class Findings:
    """Candidates for special values, and what limits completeness (sentences).

    `reducible` are those among the candidates at which a solution of case 1 is known to exist.
    """

    candidates: list[Poly] = field(default_factory=list)
    reducible: list[Poly] = field(default_factory=list)
    unproven: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class _Difference:
    """The square of the exponents' difference, and the sign-independent part (the weight), at one point of a place."""

    place: Place
    square: Poly
    weight: int


def search(problem: Problem, max_degree: int) -> Findings:
    """Candidates for the special values of the parameters."""
    findings = Findings()
    _reducible(problem, max_degree, findings)
    _imprimitive(problem, max_degree, findings)
    _primitive(problem, max_degree, findings)
    findings.candidates = union([findings.candidates])
    findings.unproven = list(dict.fromkeys(findings.unproven))
    return findings


def _differences(problem: Problem) -> list[_Difference] | None:
    """One entry for every singular point; None where conjugate points have different exponents."""
    found: list[_Difference] = []
    for place in problem.places:
        if place.kind is Kind.ORDINARY:
            continue
        regular = place.kind is Kind.REGULAR
        square = place.delta_squared if regular else irregular_difference_squared(place)
        if square is None or square.degree > 0:
            return None
        found += [_Difference(place, square, place.weight)] * place.degree
    return found


def _signed_sums(squares: list[Poly], start: Poly) -> Poly:
    """The squarefree polynomial in Y over Q(t) whose roots are the sums of +- the square roots."""
    field_ = start.field
    total = start
    for square in squares:
        # F(Y + delta) = A + delta B
        even, odd = field_.poly([]), field_.poly([])
        derivative, factorial, power = total, 1, field_.poly([1])
        for k in range(total.degree + 1):
            term = derivative * power * Fraction(1, factorial)
            if k % 2:
                odd = odd + term
                power = power * square
            else:
                even = even + term
            derivative, factorial = derivative.derivative(), factorial * (k + 1)
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
    weights = sum(d.weight for d in differences)
    sums = _signed_sums([d.square for d in differences], Y)
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
        found = rank_conditions(images, problem)
        if not found.complete:
            findings.unproven.append(_SEVERAL)
        for function in found.polynomials:
            findings.candidates.append(function)
            if function in found.certain or rank_drops(images, function):
                findings.reducible.append(function)
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
    S, n = problem.S, place.order // 2 - 2
    quotient = S.num // S.den
    lead = base.sqrt(quotient.lc)
    if lead is None:
        return None
    polynomial = [lead]
    for k in range(1, n + 1):
        known = sum((polynomial[i] * polynomial[k - i] for i in range(1, k)), base.poly([]))
        polynomial.append((quotient[2 * n - k] - known) / (2 * lead))
    root_part = base.poly(polynomial[::-1])
    rest = (S - root_part * root_part) * RatFunc(base.poly([0, 1]))
    # S - [sqrt S]^2 = b x^(n-1) + ..., and omega = +-[sqrt S] + e/x + ... with e = (+-b/a - n)/2.
    ratio = (rest.num // rest.den)[n] / lead
    parts = []
    for sign in (1, -1):
        growth = (sign * ratio - n) / 2
        parts.append((RatFunc(sign * root_part), 1 - growth))
    return parts


def _branch_places(problem: Problem) -> list[Place]:
    """Places that can be branch points of case 2 for some values of the parameters."""
    return [
        place
        for place in problem.places
        if place.kind is Kind.RAMIFIED
        or (place.kind is Kind.REGULAR and (place.delta is None or place.delta.denominator == 2))
    ]


def _imprimitive(problem: Problem, max_degree: int, findings: Findings) -> None:
    if sum(place.degree for place in _branch_places(problem)) < 2:
        return
    if not _forms(problem, 4, max_degree, findings):
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
    found = form_conditions(problem, m)
    findings.candidates += found.polynomials
    if not found.complete:
        findings.unproven.append(_SEVERAL)
    if not variable:
        return True
    if any(place.delta_squared is None for place in variable) or len(variable) > (_VARIABLE_PLACES if m == 4 else 1):
        return False
    fixed = [least_valuation(place, m) for place in problem.places if place not in variable]
    if any(v is None for v in fixed):
        return True
    degrees = [place.degree for place in problem.places if place not in variable]
    room = m - sum(v * k for v, k in zip(fixed, degrees, strict=True) if v is not None)
    points = [place for place in variable for _ in range(place.degree)]
    room -= sum(m // 2 for _ in points)
    Y = problem.field.poly([0, 1])
    seen: list[Poly] = []
    multiples = product(range(m // 2 + 1), repeat=len(points))
    for choice in multiples:
        squares = [k * k * _square(p) for k, p in zip(choice, points, strict=True) if k]
        if not squares:
            continue
        sums = _signed_sums(squares, Y)
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


def _square(place: Place) -> Poly:
    if place.delta_squared is None:
        raise AssertionError("checked by the caller")
    return place.delta_squared


__all__ = ["Findings", "search"]

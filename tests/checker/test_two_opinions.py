"""The checker and the kernel, two programs, say the same of every place, of the room for forms, and of divisor classes."""

from __future__ import annotations

import json
from itertools import product
from math import inf
from typing import Any

import flint
import pytest
from forged import inspector

import kovacic
from kovacic import Structure, checker
from kovacic.decision import Rule
from kovacic.verify.evidence import _IMPLIED_BY, INVARIANT_DEGREE, _fails_at, least_valuation, room
from kovacic.verify.torsion import Curve, ReducedDivisor

S_OF_EVERY_KIND = [
    "0",
    "7/5",
    "x",
    "x^2 + 3/7",
    "x^4 + x^2 + 12*x",
    "3/(4*x^2)",
    "-2/(9*x^2)",
    "2/x^2 + x",
    "2/x^2 + x^3",
    "2/x^2 + 5 + 7*x",
    "15/(4*x^2) + 3*x",
    "35/(4*x^2) + 5*x^2 + x^6",
    "5/x",
    "-3/(16*x^2) + 1/x",
    "-5/(36*x^2) - 3/(16*(x - 2)^2) + 1/(x - 2)",
    "-4/(25*x^2) - 21/(100*(x + 1)^2) + 7/(x*(x + 1))",
    "-(3*x^2 + 7)/(16*(x^2 - 2)^2)",
    "(8 + 4*x)/(x^2 - 2)^2",
    "3/(x^2 + 1)^2 + x",
    "6/(x^2 + 1)^2 + 2/(x - 3)^2",
    "1/x^3 + 2/(x - 5)^2",
    "4/x^4 + 3/x^3 + 1/(x + 1)",
    "(x^2 + 2)/(x^3 - 2)^4 + 1/x",
    "-1/(4*x^2) + 1/x^5 + 9/x^6",
    "(x + 7)/((x - 1)^2*(x^2 + x + 1))",
    "sqrt(2)/x^2 - 3/(16*(x - sqrt(2))^2)",
    "(sqrt(2)*x + 1)/(x^2 - sqrt(3))^2",
]  # fmt: skip


@pytest.mark.parametrize("text", S_OF_EVERY_KIND)
def test_places_and_forms(text: str) -> None:
    answer = kovacic.solve(text, var="x")
    exclusions = checker.CheckedAnswer(json.loads(answer.to_json())).exclusions
    kernel = inspector(answer.S)
    others = {place.name.replace("**", "^"): place for place in exclusions.places}
    assert len(others) == len(kernel.points)
    for point in kernel.points:
        place = exclusions.place(point.name.replace("^", "**"))
        assert (place.k, place.size, place.is_ramified) == (point.order, point.factor.degree, point.order in (3, 5, 7))
        difference = None if place.difference is None else (int(place.difference.p), int(place.difference.q))
        assert difference == (None if point.difference is None else point.difference.as_integer_ratio())
        assert (place.logarithm, place.can_branch) == (point.logarithm, point.can_branch)
        assert (place.tells_solutions_apart and not place.is_ramified) == point.tells_solutions_apart
        for m in range(1, 13):
            assert place.least_valuation(m) == (inf if (v := least_valuation(point, m)) is None else v)
        for rule, structure in product(Rule, Structure):
            holds = checker.RULES[rule.name.lower()][1](place, checker.STRUCTURES[structure.value])
            if rule is Rule.TOO_FEW_BRANCH_POINTS:
                assert holds == (structure is Structure.IMPRIMITIVE and point.can_branch)
            else:
                assert holds == (structure in _IMPLIED_BY[rule] and _fails_at(point, rule, structure)), rule
    for m in INVARIANT_DEGREE.values():
        bounds = room(kernel.points, m)
        assert max(exclusions.room(m), -1) == (-1 if bounds is None else bounds[1])
        if bounds is not None and bounds[1] < 90:
            dimension = exclusions.dimension(m)
            assert kernel.dimension_is_at_most(dimension, m)
            assert not kernel.dimension_is_at_most(dimension - 1, m)
    zeros, is_bound = exclusions.zeros
    counts = kernel.zero_counts
    if counts is not None and not is_bound:  # the kernel has none where the exponents aren't rational
        assert zeros == counts.largest
    if any(place.is_ramified for place in exclusions.places):
        assert (zeros, counts) == (-1, None)


Q = 10007  # 5 is no square modulo it


def divisor(h: Any, roots: str) -> ReducedDivisor:
    """The points over small x, two for each place in the text: signs of y."""
    curve = Curve(h)
    total, x = curve.zero, 0
    for sign in roots:
        x = next(x for x in range(x + 1, Q) if flint.fmpz(int(h(x))).jacobi(Q) == 1)
        y = int(flint.fmpz(int(h(x))).sqrtmod(Q)) * (1 if sign == "+" else -1)
        double = curve.sum(*[ReducedDivisor(flint.nmod_poly([-x, 1], Q), flint.nmod_poly([y], Q))] * 2)
        total = curve.sum(total, double)
    return total


@pytest.mark.parametrize("coefficients", [[3, 1, 4, 1, 5], [2, 7, 1, 8, 2, 8, 5], [1, 0, 9, 0, 0, 4, 0, 2, 5]])
def test_sums_of_divisor_classes(coefficients: list[int]) -> None:
    """On curves of genus 1, 2 and 3: also of a divisor with itself, with its conjugate, and with points in common."""
    h = flint.nmod_poly(coefficients, Q)
    assert flint.fmpz(5).jacobi(Q) == -1
    kernel, other = Curve(h), checker.ClassGroup(h)
    divisors = [divisor(h, signs) for signs in ("", "+", "-", "+-", "-+", "++-", "+-+")]

    def same(first: Any, second: Any) -> bool:
        return (first.u * int(second.u[0]), first.v) == (second.u * int(first.u[0]), second.v)

    for E, F in product(divisors, divisors):
        total = kernel.sum(E, F)
        assert total.u.degree() <= h.degree() // 2
        assert (total.v * total.v - h) % total.u == 0
        assert same(other.together(checker.DivisorPoints(*E), checker.DivisorPoints(*F)), total)
    for E in divisors[1:]:
        points = checker.DivisorPoints(*E)
        conjugate = checker.DivisorPoints(E.u, -E.v)
        assert other.together(points, conjugate) == (1, 0)
        assert other.multiple(0, points) == (1, 0)
        for n in (1, 2, 3, 7, 12):
            assert same(other.multiple(n, points), kernel.multiple(n, E))


@pytest.mark.parametrize(
    ("text", "zeros"),
    [
        ("(8 + 4*x)/(x^2 - 2)^2", 1),  # 1 - 1 - 1 + ((5 + 2 sqrt(2))^(1/2) + (5 - 2 sqrt(2))^(1/2))/2 = 1.14 at most
        ("(40 + 4*x)/(x^2 - 2)^2", 3),  # so with 21 in place of 5: 3.57
        ("(40 + 4*x)/(x^2 - 2)^2 - 3/(16*(x - 7)^2)", 4),  # 1 - 1 - 1/4 - 1/4 + 4.57, with exponents at 7 and infinity
    ],
)
def test_a_bound_of_the_zeros_by_conjugate_exponents(text: str, zeros: int) -> None:
    answer = json.loads(kovacic.solve(text, limits=kovacic.Limits(unknown_degree=30)).to_json())
    assert checker.CheckedAnswer(answer).exclusions.zeros == (zeros, True)

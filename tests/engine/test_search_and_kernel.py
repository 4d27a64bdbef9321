"""The search and the kernel, which share no code, find the same exponents, valuations and numbers of zeros."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from typing import Any

import pytest
import strategies
import transform
from build import QQ, Budget, RatFunc, analyse, function, generated
from forged import inspector
from hypothesis import example, given, settings
from hypothesis import strategies as st

import kovacic
from kovacic import checker
from kovacic.engine.invariants import least_invariant_valuation
from kovacic.engine.local import DegreeBound, degree_bound
from kovacic.verify import evidence
from kovacic.verify.local import has_no_series
from kovacic.verify.zeros import zero_counts

X = RatFunc(QQ.poly([0, 1]))


@pytest.mark.long
@generated(20)
@given(st.one_of(strategies.omegas(), strategies.case_1_orthogonal()))
@example((X + 1) / (X**2 - 2))
@example((2 * X + 3) / (X**2 + 1) + 1 / (X - 1) + 1)
@example((X**2 - 5) / (X**3 - 2) + X)
@example((X + 1) / (X**2 - 3) + (5 * X - 2) / (X**2 + 1) ** 2)
def test_a_solution_has_one_of_the_possible_numbers_of_zeros(given_: Any) -> None:
    """For y with a rational omega the exponents at a place sum up to half its weights, plus or minus the choice there.

    The sums are those of the residues of omega (at infinity 1 minus all of them), and the zeros of y number 1 minus the sum
    of all exponents: both in the search and in the kernel.
    """
    omega = given_ if isinstance(given_, RatFunc) else kovacic.solve(str(given_.S)).omega
    problem = analyse(transform.from_omega(omega), Budget())
    places, points = problem.places, inspector(problem.S).points
    sums = {place: _sum_of_residues(omega, place.factor) for place in problem.finite_places}
    zeros = sum((_sum_of_residues(omega, p) for p, _ in QQ.factor(omega.den)), Fraction(0)) - sum(sums.values())
    sums[places[-1]] = 1 - sum(sums.values()) - zeros
    bound, counts = degree_bound(problem), zero_counts(points)
    assert isinstance(bound, DegreeBound)
    assert counts is not None
    assert zeros <= bound.largest == counts.largest
    assert [abs(half) for _, half in bound.choices] == [abs(half) for _, half in counts.choices]
    for place, half in bound.choices:
        assert abs(half) == abs(sums[place] - Fraction(place.degree * place.weight, 2))
        allowed, point = bound.exponents(place), next(point for point in points if point.name == place.name)
        if allowed is not None:
            rational = {QQ.rational_value(exponent) for exponent in allowed}
            assert sums[place] in rational
            assert rational <= {Fraction(place.weight, 2) + sign * half for sign in (1, -1)}
            assert {e for e, n in counts.by_exponent(point) or [] if n >= zeros} >= {sums[place]}
    for place, e in sums.items():
        if place.logarithm and place.delta is not None:
            assert e == place.degree * (1 + place.delta) / 2


def _sum_of_residues(f: RatFunc, p: Any) -> Fraction:
    """Over the roots of p: the coefficient of 1/x at infinity of the part of f with the powers of p in its denominator."""
    rest, order = f.den.remove(p)
    if not order:
        return Fraction(0)
    part = f.num * rest.inverse_modulo(p**order) % p**order
    return (part[order * p.degree - 1] / (p**order).lc).constant()


@settings(max_examples=15)
@given(
    st.sampled_from(["x", "x", "sqrt(2)*x"]),
    st.dictionaries(st.integers(-6, 6), st.integers(1, 7), min_size=2, max_size=5),
    st.lists(st.integers(-9, 9), min_size=1, max_size=9),
    st.integers(1, 5),
)
def test_the_kernel_expands_at_many_poles_of_any_orders(t: str, poles: Any, quotient: Any, rest: int) -> None:
    """S = N/(p^k q) + O(p^(nu - k)): N den - num p^k q has the factor p^(k + nu), whichever way N and q were found."""
    t = function(t).num
    den = prod(((t - c) ** order for c, order in poles.items()), start=t**0)
    num = den.field.poly(quotient) * den + rest
    finite = [point for point in inspector(RatFunc(num, den)).points if not point.at_infinity]
    assert sorted(point.order for point in finite) == sorted(poles.values())
    for point in finite:
        p, k = point.factor, point.order
        N, q = point.near
        assert not (N * den - num * p**k * q) % p ** (k + max(k // 2, 1))


@pytest.mark.parametrize("k", range(3, 10))
@pytest.mark.parametrize("m", [2, 4, 6, 8, 12])
def test_valuations_at_irregular_places_in_the_search_and_the_kernel(k: int, m: int) -> None:
    """There y1 y2 has the valuation k/2, and only its powers can be rational: m k/4, if that is an integer."""
    S = 1 / X**k + 1
    (pole, _), point = analyse(S, Budget()).places, inspector(S).points[0]
    assert (
        least_invariant_valuation(pole, m) == evidence.least_valuation(point, m) == (None if m * k % 4 else m * k // 4)
    )


@pytest.mark.parametrize("d", range(1, 6))
@pytest.mark.parametrize("centre", [0, 3])
def test_logarithms_of_two_term_recurrences(d: int, centre: int) -> None:
    """t^2 y'' = ((n^2 - 1)/4 + a t^d) y: search and kernel say what the series modulo a prime says."""
    for n in range(1, 13):
        t = X - centre
        S = (Fraction(n * n - 1, 4) + Fraction(-2, 3) * t**d) / t**2
        point = inspector(S).points[0]
        if S.den.degree < 2:
            continue
        h = next(QQ.homomorphisms())
        expected = has_no_series(*point.localised(h, centre), n)
        assert expected is (n % d == 0)
        assert point.logarithm is analyse(S, Budget()).places[0].logarithm is expected


@pytest.mark.parametrize(
    "text", ["x^2*y'' + x*y' + (x^2 - 10^10)*y = 0", "(10^20 - 1/4)/(x - 3)^2 - 1", "(10^10 - 1/4)/x^2 + x^3"]
)
def test_bessels_equation_of_a_large_order(text: str) -> None:
    """Orders beyond the limit of degrees, in z^(1/k) as well: a logarithm leaves no room for a solution."""
    answer = kovacic.solve(text)
    assert (answer.status.value, str(answer.group)) == ("none", "SL2")
    assert answer.verify()
    assert checker.verdict(answer.to_json()).startswith("checked: ")

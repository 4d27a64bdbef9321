"""Primes at which an equation degenerates are recognised and replaced: equations made to degenerate at the first ones."""

from __future__ import annotations

from fractions import Fraction
from itertools import islice

import pytest
import transform
from build import QQ, RatFunc

import kovacic

X = RatFunc(QQ.poly([0, 1]))
P0, P1 = (h.p for h in islice(QQ.homomorphisms(), 2))


@pytest.mark.parametrize("p", [P0, P0 * P1], ids=["one prime", "two primes"])
@pytest.mark.parametrize(
    ("S", "case"),
    [
        (X**2 + 3, 1),
        ((6 - X**2) / X**2, 1),
        (1 / X - Fraction(3, 16) / X**2, 2),
        (transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 3)), 3),
        (transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 4)), 3),
        (transform.hypergeometric(Fraction(1, 2), Fraction(1, 3), Fraction(1, 5)), 3),
        (transform.hypergeometric(Fraction(1, 3), Fraction(1, 4), Fraction(1, 7)), None),
        (X, None),
    ],
    ids=str,
)
def test_scalings_and_translations_by_the_first_primes(S: RatFunc, case: int | None, p: int) -> None:
    variants = (
        transform.scaling(S, p),
        transform.scaling(S, Fraction(1, p)),
        transform.translation(S, p),
        transform.moebius(S, 1, 0, 1, p),
    )
    for variant in variants:
        answer = kovacic.solve(variant)
        assert answer.case == case
        assert answer.verified


def test_poles_that_meet_modulo_the_first_prime() -> None:
    for omega, case in ((1 / (3 * X) + 1 / (5 * (X - P0)) + 1, 1), (2 / X**2 + 1 / (X - P0) ** 2, 1)):
        assert kovacic.solve(transform.from_omega(omega)).case == case
    g = X * (X - P0) * (X - 1)
    assert kovacic.solve(transform.from_squared_product(g, 7)).case == 2


def test_an_exponent_difference_that_vanishes_modulo_the_first_prime() -> None:
    assert kovacic.solve(transform.from_omega(Fraction(P0 + 7, 14) / X + 1 / (X - 1) + 1)).case == 1
    assert kovacic.solve(Fraction(P0, 7) / X**2 + 1).case is None


def test_simple_solutions_with_exponents_far_apart_are_found() -> None:
    n = 10**30
    for S in (n * (n + 1) / X**2, transform.from_omega(Fraction(P0 + 2, 3) / X + 1 / (X - 1) + 1)):
        for variant in (S, transform.moebius(S, 1, 2, 3, 4)):
            answer = kovacic.solve(variant)
            assert answer.case == 1
            assert answer.verified


def test_a_polynomial_far_too_long_is_known_by_its_recurrence() -> None:
    answer = kovacic.solve((P0 * P0 - 1) / (4 * X**2) + 1)
    assert (answer.case, answer.verified, answer.series.degree) == (1, True, (P0 - 1) // 2)

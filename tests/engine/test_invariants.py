"""Invariants and semi-invariants: two ways to lift, Klein's identities, and the closing of the recursion for omega."""

from __future__ import annotations

from fractions import Fraction

import pytest
import transform
from build import QQ, Budget, RatFunc, analyse
from forged import NoInvariant

import kovacic
from kovacic.engine.expansion import polynomial_invariant
from kovacic.engine.invariants import bounds, invariants, invariants_modulo
from kovacic.engine.riccati import Form, hessian, jacobian

X = RatFunc(QQ.poly([0, 1]))
HALF, THIRD = Fraction(1, 2), Fraction(1, 3)
SCHWARZ = {6: (HALF, THIRD, THIRD), 8: (HALF, THIRD, Fraction(1, 4)), 12: (HALF, THIRD, Fraction(1, 5))}


@pytest.mark.parametrize("m", SCHWARZ)
@pytest.mark.parametrize("shift", [0, 2, 6])
@pytest.mark.parametrize("moved", [(1, 0, 0, 1), (1, 2, 0, 1), (2, 3, 1, 1)])
def test_lifting_by_primes_and_by_the_recurrence_agree(m: int, shift: int, moved: tuple[int, int, int, int]) -> None:
    first, *others = SCHWARZ[m]
    S = transform.moebius(transform.hypergeometric(first + shift, *others), *moved)
    problem = analyse(S, Budget())
    bound = bounds(problem, m)
    found = invariants(problem, m)
    assert not isinstance(found, NoInvariant)
    assert len(found) == 1
    assert bound is not None
    valuations, N = bound
    by_recurrence = polynomial_invariant(problem, m, N, valuations)
    assert by_recurrence == found[0].P
    images = [
        invariants_modulo(h, problem, m, *bound, margin=6) for h, _ in zip(QQ.homomorphisms(), range(3), strict=False)
    ]
    for h, (space, _) in zip(QQ.homomorphisms(), images, strict=False):
        assert space == [h(found[0].P)]


def test_a_larger_margin_and_another_prime_give_the_same_dimension() -> None:
    for S in (X, X**2 + Fraction(1, 3), transform.hypergeometric(THIRD, Fraction(1, 4), Fraction(1, 7)), X * 0):
        problem = analyse(S, Budget())
        for m in (2, 4):
            bound = bounds(problem, m)
            if bound is None:
                continue
            dimensions = {
                len(invariants_modulo(h, problem, m, *bound, margin=margin)[0])
                for h, _ in zip(QQ.homomorphisms(), range(3), strict=False)
                for margin in (6, 30)
            }
            assert len(dimensions) == 1


def test_klein_relation_of_the_icosahedral_forms() -> None:
    """T^2 + h^3 is a constant multiple of F^5 for h = Hess(F)/121, T = Jac(F, h)/20 (up to the normalisation of F)."""
    problem = analyse(transform.hypergeometric(*SCHWARZ[12]), Budget())
    F = invariants(problem, 12)[0]  # type: ignore[index]
    H = hessian(F, problem)
    T = jacobian(F, H, problem)
    assert H.degree == 20
    assert T.degree == 30
    assert H.is_form(problem)
    assert T.is_form(problem)


@pytest.mark.parametrize("S", ["x", "x^2 + 3", "-3/(16*x^2) + 1/x", "2/x^2", "-(5*x^2+27)/(36*(x^2-1)^2)"])
def test_a_form_that_isnt_one_is_recognised(S: str) -> None:
    answer = kovacic.solve(S)
    problem = analyse(answer.S, Budget())
    assert not Form(4, problem.D.derivative(), QQ.poly([1, 2, 3])).is_form(problem)
    if answer.semi_invariant is not None:
        form = answer.semi_invariant
        R = problem.D.over(form.P.field) * form.theta.num // form.theta.den
        assert Form(form.degree, R, form.P).is_form(problem)
        assert not Form(form.degree, R, form.P + QQ.poly([0, 0, 0, 0, 0, 1])).is_form(problem)


@pytest.mark.parametrize("n", [1, 24, 25, 26, 30, 90])
def test_bessels_equation_of_whole_order_has_a_logarithm(n: int) -> None:
    """Y_n has log(x) with the exponents +-n, however far these are apart; of the order n + 1/2 there is none."""
    answer = kovacic.solve(f"x^2*y'' + x*y' + (x^2 - {n}^2)*y = 0")
    assert answer.case is None
    assert answer.verified
    half = kovacic.solve(f"x^2*y'' + x*y' + (x^2 - ({n} + 1/2)^2)*y = 0")
    assert half.case == 1
    assert half.verified

"""`transform`: every transformation against what it does to a solution omega, and composition laws."""

from __future__ import annotations

from fractions import Fraction

import pytest
import strategies
import transform
from build import QQ, Poly, RatFunc, generated
from hypothesis import assume, given, settings
from hypothesis import strategies as st

X = strategies.X
ZERO = RatFunc(QQ.poly([]))
small_functions = strategies.rational_functions(2, 3)
omegas = strategies.omegas(2, 2)


def solves_riccati(omega: RatFunc, S: RatFunc) -> bool:
    return omega.derivative() + omega * omega == S


@settings(max_examples=20)
@given(omegas)
def test_from_omega_solves_the_riccati_equation(omega: RatFunc) -> None:
    assert solves_riccati(omega, transform.from_omega(omega))


@pytest.mark.long
@given(strategies.products((-2, -1, 1, 2), 2, 2), st.integers(-4, 4))
def test_from_product_has_both_omegas(F: RatFunc, w: int) -> None:
    S = transform.from_product(F, w * w)
    for sign in (1, -1):
        assert solves_riccati((F.derivative() + sign * w) / (2 * F), S)


@settings(max_examples=20)
@given(strategies.products((-2, -1, 1, 2), 2, 2), strategies.nonzero(4))
def test_product_squared_product_and_squared_difference_agree(F: RatFunc, W: int) -> None:
    S = transform.from_product(F, W)
    assert transform.from_squared_product(F * F, W) == S
    assert transform.from_squared_difference(W / (F * F)) == S


@settings(max_examples=20)
@given(strategies.products((-2, -1, 1, 3), 2, 2), strategies.nonzero(4))
def test_squared_product_satisfies_the_first_integral(g: RatFunc, W: int) -> None:
    """`F'^2 - 2 F F'' + 4 S F^2 = w^2` with F = sqrt(g), `F'/F = phi`, multiplied out by `F^2 = g`."""
    S, phi = transform.from_squared_product(g, W), g.derivative() / (2 * g)
    assert g * (phi * phi - 2 * (phi.derivative() + phi * phi) + 4 * S) == W


@settings(max_examples=20)
@given(strategies.products((-1, 1, 2), 2, 2), st.integers(1, 4))
def test_conjugate_omegas(F: RatFunc, w: int) -> None:
    first, second = ((F.derivative() + sign * w) / (2 * F) for sign in (1, -1))
    assert transform.from_conjugate_omegas(first, second) == transform.from_product(F, w * w)
    with pytest.raises(ValueError, match="different solutions"):
        transform.from_conjugate_omegas(first, first)
    with pytest.raises(ValueError, match="different solutions"):
        transform.from_conjugate_omegas(first, second + 1)


@pytest.mark.long
@given(omegas, small_functions)
@generated(12)
def test_pull_back_of_a_solution(omega: RatFunc, f: RatFunc) -> None:
    """`y(f) f'^(-1/2)` has the logarithmic derivative `omega(f) f' - f''/(2 f')`."""
    first = f.derivative()
    assume(first)
    pulled = omega(f) * first - first.derivative() / (2 * first)
    assert solves_riccati(pulled, transform.pull_back(transform.from_omega(omega), f))


@pytest.mark.long
@given(omegas.map(transform.from_omega), small_functions, small_functions)
@generated(8)
def test_pull_backs_compose(S: RatFunc, f: RatFunc, g: RatFunc) -> None:
    assume(f.derivative() and g.derivative())
    assume(S.den.degree + S.num.degree <= 12)
    assert transform.pull_back(transform.pull_back(S, f), g) == transform.pull_back(S, f(g))


@pytest.mark.long
@given(omegas.map(transform.from_omega), strategies.moebius_maps())
@generated(12)
def test_moebius_is_a_pull_back_and_has_an_inverse(S: RatFunc, m: tuple[int, int, int, int]) -> None:
    a, b, c, d = m
    image = transform.moebius(S, a, b, c, d)
    assert image == transform.pull_back(S, (a * X + b) / (c * X + d))
    assert transform.moebius(image, d, -b, -c, a) == S


@pytest.mark.long
@given(omegas.map(transform.from_omega), strategies.fractions(5), strategies.fractions(5).filter(bool))
def test_translation_and_scaling(S: RatFunc, shift: Fraction, factor: Fraction) -> None:
    assert transform.translation(S, shift) == S(X + shift)
    assert transform.scaling(S, factor) == S(factor * X) * factor**2


@pytest.mark.long
@given(omegas, small_functions, strategies.polynomials(0, 1, 3))
@generated(12)
def test_gauge_of_a_solution(omega: RatFunc, a: RatFunc, b: Poly) -> None:
    """`u = a y + b y'` divided by `sqrt(det)` solves the new equation."""
    S, b_function = transform.from_omega(omega), RatFunc(b)
    image = a + b_function * omega
    assume(image)
    c, d = a.derivative() + b_function * S, a + b_function.derivative()
    determinant = a * d - b_function * c
    assume(determinant)
    new = omega + image.derivative() / image - determinant.derivative() / (2 * determinant)
    assert solves_riccati(new, transform.gauge(S, a, b_function))


def test_gauge_refuses_to_lose_a_solution() -> None:
    with pytest.raises(ValueError, match="solves the Riccati equation"):
        transform.gauge(transform.from_omega(X), -X, 1)


@settings(max_examples=20)
@given(strategies.fractions(6), strategies.fractions(6), strategies.fractions(6))
def test_hypergeometric_has_its_exponent_differences(l: Fraction, m: Fraction, n: Fraction) -> None:  # noqa: E741
    """`x^2 S -> (Delta^2 - 1)/4` at each of the three points, and no other pole."""
    S = transform.hypergeometric(l, m, n)
    at_one = transform.translation(S, 1)
    at_infinity = transform.moebius(S, 0, 1, 1, 0)
    for image, delta in ((S, l), (at_one, m), (at_infinity, n)):
        local = X * X * image
        assert local.den(0)
        assert local(0) == (delta * delta - 1) / 4
    assert (QQ.poly([0, -1, 1]) ** 2).exact_quotient(S.den) is not None


@pytest.mark.long
@given(strategies.moebius_maps(), small_functions)
def test_schwarzian_vanishes_exactly_for_moebius_maps(m: tuple[int, int, int, int], f: RatFunc) -> None:
    a, b, c, d = m
    assert transform.schwarzian((a * X + b) / (c * X + d)) == 0
    assume(max(f.num.degree, f.den.degree) > 1)
    assert transform.schwarzian(f) != 0


@pytest.mark.parametrize(
    ("call", "error"),
    [
        (lambda: transform.moebius(X, 1, 2, 2, 4), ValueError),
        (lambda: transform.scaling(X, 0), ValueError),
        (lambda: transform.pull_back(X, ZERO + 3), ZeroDivisionError),
        (lambda: transform.from_product(ZERO, 1), ZeroDivisionError),
        (lambda: transform.from_squared_difference(ZERO), ZeroDivisionError),
    ],
)
def test_impossible_arguments_raise(call, error) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error):
        call()

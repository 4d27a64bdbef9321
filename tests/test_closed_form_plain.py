"""Expressions that are put together without SymPy's evaluation are the ones that SymPy makes."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Add, Integer, Mul, Pow, Rational, cos, exp, log, pi, sqrt
from sympy.abc import n, x

from kovacic.closed_form import plain

exponents = st.sampled_from([Rational(p, q) for p in (-3, -2, -1, 0, 1, 2, 3) for q in (1, 2, 3)])
bases = st.sampled_from(
    [
        x,
        x + 1,
        1 - x,
        x**2 - 2,
        2 * x + 3,
        x + sqrt(2),
        3 * x**2 + x,
        n + x,
        n,
        Integer(2),
        Integer(-3),
        1 + sqrt(5),
        3 * x,
    ]
)
factors = st.one_of(
    st.builds(Pow, bases, exponents),
    st.sampled_from(
        [
            sympy.Integral(exp(x**2) / (x - 1), x),
            Integer(0),
            Integer(1),
            Integer(-1),
            Rational(2, 3),
            sqrt(2),
            sqrt(3),
            Pow(2, Rational(1, 3)),
            Pow(6, Rational(2, 3)),
            1 / sqrt(3),
            x ** sqrt(2),
            (x + 1) ** (-sqrt(2) / 3),
            (x + 1) ** (sqrt(2) - 1),
            Pow(12, Rational(1, 3)) * (x + 1),
            sqrt(pi),
            pi,
            sympy.I,
            sqrt(-2),
            1 + sqrt(5),
        ]
    ),
    st.sampled_from(
        [exp(x), exp(-(x**2)), exp(2), cos(x), log(x + 1), sympy.erf(x), Mul(2, x, x + 1), -x, 2 * x, sqrt(x) * x]
    ),
)


def assert_same(ours: Any, theirs: Any) -> None:
    assert ours == theirs
    assert sympy.srepr(ours) == sympy.srepr(theirs)
    assert ours.is_commutative


@settings(max_examples=200)
@given(st.lists(factors, max_size=4))
def test_products(chosen: list[Any]) -> None:
    assert_same(plain.times(*chosen), Mul(*chosen))


@settings(max_examples=200)
@given(st.lists(factors, max_size=4))
def test_sums(chosen: list[Any]) -> None:
    assert_same(plain.plus(*chosen), Add(*chosen))


@settings(max_examples=200)
@given(
    st.one_of(bases, st.builds(Mul, bases, st.builds(Pow, bases, exponents))),
    st.one_of(exponents, st.sampled_from([sqrt(2), -sqrt(3) / 3, (1 + sqrt(5)) / 2, sympy.I, log(2), 2 * log(3), pi])),
)
def test_powers(base: Any, exponent: Any) -> None:
    assert_same(plain.power(base, exponent), Pow(base, exponent))


@given(factors, bases)
def test_quotients(numerator: Any, denominator: Any) -> None:
    assert_same(plain.quotient(numerator, denominator), numerator / denominator)


@given(
    st.one_of(
        st.lists(st.sampled_from([Integer(0), Integer(1), Integer(-1), Rational(1, 2), sqrt(2), n]), max_size=6),
        st.lists(st.builds(Rational, st.integers(-3, 12), st.sampled_from([1, 1, 2, 3])), max_size=12),
    )
)
def test_polynomials(coefficients: list[Any]) -> None:
    for variable in (x, 2 * x, x**3):
        expected = Add(*(c * variable**k for k, c in enumerate(coefficients)))
        assert_same(plain.polynomial(coefficients, variable), expected)


@pytest.mark.parametrize("argument", [x, -x, 1 / x, x**2 / 2 + 3, (x + 1) / (x - 1), 3 * x / 2 - 1 / x**2])
def test_exponentials(argument: Any) -> None:
    assert_same(plain.exponential(argument), exp(argument))


@pytest.mark.parametrize("z", [x, x**2 / (x - 2) ** 2, (x**2 + n) / x, sqrt(2) * x])
@pytest.mark.parametrize("a", [Rational(-1, 24), Rational(11, 24), Rational(13, 7)])
def test_hypergeometric_functions(a: Any, z: Any) -> None:
    b, c = Rational(5, 24), Rational(3, 4)
    assert_same(plain.hypergeometric(a, b, c, z), sympy.hyper((a, b), (c,), z))


@pytest.mark.parametrize("exponent", [Rational(-2, 3), Rational(1, 2), Rational(-7, 4), Integer(-2), Rational(5, 3)])
@pytest.mark.parametrize("factor", [Rational(2, 3), Rational(-2, 3), Integer(1), Integer(-1), Integer(8), sqrt(2), n])
@pytest.mark.parametrize("base", [x, x - 1, x**3, x**2, (x - 1) ** 2, (x + sqrt(2)) ** 5])
def test_powers_of_multiples(factor: Any, base: Any, exponent: Any) -> None:
    assert_same(plain.power_of_multiple(factor, base, exponent), (factor * base) ** exponent)


@settings(max_examples=200)
@given(st.integers(1, 400), st.integers(1, 400), st.integers(-20, 20), st.integers(2, 8))
def test_roots_of_rational_numbers(p: int, q: int, a: int, b: int) -> None:
    exponent = Rational(a, b)
    if not exponent.is_Integer:
        assert_same(plain.root_of_rational(Rational(p, q), exponent), Rational(p, q) ** exponent)

"""Each rule for antiderivatives is right by itself, whatever the other ones would have taken first."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
import sympy
from build import parametrize
from flint import acb, fmpq
from sympy import atan, cos, exp, log, sin, sqrt

import kovacic
from kovacic.closed_form.jets import jet
from kovacic.general_solution import antiderivatives
from kovacic.general_solution.integrands import (
    UnknownIntegral,
    incomplete_gamma,
    power_beside_wave,
    prepared_integrand,
)
from kovacic.general_solution.waves import beside_waves, by_coefficients

x = sympy.Symbol("x")
POINTS = (acb(fmpq(3, 10), fmpq(1, 7)), acb(fmpq(6, 5)), acb(fmpq(17, 10), fmpq(-1, 9)))
INNER = [x, 2 * x, x**2, sin(x), cos(x), exp(x), exp(-2 * x), log(x), sqrt(x), x + 1, 1 / x, sympy.I * x, sqrt(x + 1)]
OUTER: list[Any] = [
    exp,
    sin,
    cos,
    log,
    atan,
    sqrt,
    sympy.erf,
    lambda u: 1 / u,
    lambda u: u**2,
    lambda u: 1 / (1 + u**2),
]


def integrands(count: int) -> Iterator[Any]:
    """f(u) u', f(u) g and f(u) g(v), each as a single term."""
    choice = random.Random(5).choice
    for k in range(count):
        u = choice(INNER)
        beside = [u.diff(x), choice(INNER), choice(OUTER)(choice(INNER))][k % 3]
        whole = prepared_integrand(choice(OUTER)(u) * beside)
        yield from sympy.Add.make_args(whole)


@parametrize("claim", antiderivatives._RULES, ordinary=0, long=(0, 5, 7, 9))
def test_each_rule_alone_finds_antiderivatives(claim: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rule = antiderivatives._RULES[claim]
    monkeypatch.setattr(antiderivatives, "_RULES", {claim: rule})
    for term in integrands(60):
        with suppress(UnknownIntegral):
            found = rule(term, x)
            for point in POINTS:
                value, wanted = jet(found, x, point)[1], jet(term, x, point)[0]
                assert value.is_finite(), (claim, term, found)
                assert value.overlaps(wanted), (claim, term, found)


#: By what is special in them: the exponents 0, 1/2, an integer, others, of powers of lines with letters.
FORMULAS = [
    (incomplete_gamma, "7*(2*x + 3)**a", "7*(2*x + 3)**(a + 1)/(2*(a + 1))"),
    (incomplete_gamma, "5*x**a*exp(-3*x)", "-5*x**(a + 1)*(3*x)**(-a - 1)*uppergamma(a + 1, 3*x)"),
    (incomplete_gamma, "5*x**a*exp(3*x)", "5*x**(a + 1)*hyper((a + 1,), (a + 2,), 3*x)/(a + 1)"),
    (incomplete_gamma, "x**a*exp(-2*x**3 + 5)", None),
    (incomplete_gamma, "7*x**(4/3)*exp(2*x**5)", None),
    (incomplete_gamma, "7*x**(4/3)*exp(-2*x**5)", None),
    (incomplete_gamma, "sqrt(x)*exp(-2*x**3)", None),
    (incomplete_gamma, "sqrt(x)*exp(2*x**3)", None),
    (incomplete_gamma, "(3*x + 2)**4*exp(x)", None),
    (incomplete_gamma, "(3*x + 2)**(1/3)*exp(5 - 2*x)", None),
    (power_beside_wave, "5*x**a*cos(3*x)", None),
    (power_beside_wave, "5*x**a*sin(3*x)", None),
    (power_beside_wave, "x**(2/3)*sin(2*x**3 + 1)", None),
    (power_beside_wave, "x**(2/3)*cos(2*x**3 + 1)", None),
    (power_beside_wave, "7*x**(1/5)*cos(x**b/2 - 3)", None),
    (beside_waves, "x**3*sin(2*x + 3)", None),
    (beside_waves, "cos(2*x + 3)/(5*x - 2)**3", None),
    (beside_waves, "sin(3*x)/(x - 2) + x*cos(5*x)", None),
    (beside_waves, "x**4*cos(3*x**2 + 1)", None),
    (beside_waves, "sin(3*x**2 - 6*x + 5)", None),
    (beside_waves, "(x - 1)**2*cos(3*x**2 - 6*x + 5)", None),
    (beside_waves, "cos(2*x**2)/x**3", None),
    (beside_waves, "sin(2*x**2)/x**2 + 3/(x + 5)**2", None),
    (by_coefficients, "x**2*exp(3*x)*sin(2*x) + 5*x", None),
]


@pytest.mark.parametrize(
    ("rule", "text", "printed"), FORMULAS, ids=lambda value: value if isinstance(value, str) else ""
)
def test_formulas_for_integrals(rule: Any, text: str, printed: str | None) -> None:
    term = sympy.sympify(text, {"x": x}, rational=True)
    found = rule(term, x)
    assert printed is None or str(found) == printed
    for point in POINTS:
        value, wanted = jet(found, x, point)[1], jet(term, x, point)[0]
        assert abs(value - wanted) < 1e-9 * abs(wanted), found


def test_functions_of_a_logarithm_beside_a_square_in_an_exponent() -> None:
    """exp(-t^2) for t = log(x) is no power of x with a constant exponent."""
    found = antiderivatives.antiderivative(sympy.erf(log(x)) / x, x)
    assert found == log(x) * sympy.erf(log(x)) + exp(-(log(x) ** 2)) / sqrt(sympy.pi)


def test_powers_of_two_lines_have_no_incomplete_gamma_function() -> None:
    with pytest.raises(UnknownIntegral):
        incomplete_gamma(sqrt(x) / (x + 1), x)


def test_an_exponential_of_a_wave_is_no_power_of_another() -> None:
    """exp(sin(x)) isn't u^cos(x) with u = exp(x)."""
    assert antiderivatives.antiderivative(exp(sin(x)) * cos(x), x) == exp(sin(x))
    assert antiderivatives.antiderivative(exp(sin(x)), x) is None


@pytest.mark.parametrize("n", range(-5, 5))
@pytest.mark.parametrize("wave", [sin(x**2), cos(3 * x**2 + 1), sin(x) ** 2 / sqrt(x)])
def test_powers_beside_waves_of_squares_are_real(n: int, wave: Any) -> None:
    """Fresnel functions, Si and Ci of real arguments; sin(x)/x^(3/2) has waves of t^2 in t = sqrt(x)."""
    term = x**n * wave
    found = antiderivatives.antiderivative(term, x)
    assert not found.has(sympy.I, sympy.Integral)
    for point in POINTS[1:]:
        assert jet(found, x, point)[1].overlaps(jet(term, x, point)[0])


@pytest.mark.parametrize(
    "term",
    [
        exp(sympy.I * x) / sin(x),  # cos(x) + i sin(x) for exp(i x)
        exp(2 * sympy.I * x) / (1 + cos(2 * x)),
        log(x + 2) ** 2 / x**2,  # by parts, as x^-2 = k l' + H'
        log(x) ** 2 / (x + 1) ** 2,
    ],
    ids=str,
)
def test_integrals_that_one_rule_alone_finds(term: Any) -> None:
    found = antiderivatives.antiderivative(term, x)
    assert not found.has(sympy.Integral)
    for point in POINTS:
        assert jet(found, x, point)[1].overlaps(jet(term, x, point)[0])


@pytest.mark.parametrize(
    "term", [1 / (sqrt(4 - x**2) * (x**2 - 4)), 1 / ((1 - x) ** sympy.Rational(3, 2) * sqrt(1 + x))]
)
def test_roots_that_are_real_on_an_interval_alone(term: Any) -> None:
    """The constant beside a product is found where the term is real, not at 2 or 3."""
    found = antiderivatives.antiderivative(term, x)
    for point in (acb(fmpq(-3, 4)), acb(fmpq(0)), acb(fmpq(2, 3))):
        assert jet(found, x, point)[1].overlaps(jet(term, x, point)[0])


@parametrize("c", ["I", "1+2*I", "sqrt(2)", "-1-sqrt(3)"], ordinary=2, long=1)
def test_roots_of_numbers_before_an_integral_stay_roots(c: str) -> None:
    """1/sqrt(-i) stood before it as a power of `CRootOf(_Dummy**4 + 1, 2)`."""
    found = kovacic.dsolve(f"y'' + ({c})*y = log(x)").rhs
    assert not found.has(sympy.CRootOf, sympy.Dummy, sympy.Integral)


def test_powers_in_a_denominator_are_kept_together() -> None:
    assert prepared_integrand((x + 2) * (x + 1) ** sympy.Rational(-3, 2)) == x / (x + 1) ** sympy.Rational(3, 2) + 2 / (
        x + 1
    ) ** sympy.Rational(3, 2)


def test_a_linear_argument_with_letters_is_a_new_variable() -> None:
    """f(u) du with u = 3 x/a + b is the term again, which has x = a (u - b)/3 in it."""
    a, b = sympy.symbols("a b")
    term, u = x * sympy.asin(3 * x / a + b), 3 * x / a + b
    [change] = [change for change in antiderivatives._arguments(term, x) if change.u == u]
    assert sympy.expand(change.integrand.subs(change.t, u) * u.diff(x) - term) == 0

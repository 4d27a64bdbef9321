"""int r exp(E) dx with Ei and error functions: built first, differentiated, found again; and what isn't of this form."""

from __future__ import annotations

import pytest
import sympy
from build import QQ, RatFunc, parametrize
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from sympy import Ei, erf, erfi, exp

import kovacic
from kovacic.algebra.factors import combination
from kovacic.closed_form.exponential_integrals import integrate_exponential

X = RatFunc(QQ.poly([0, 1]))
x = sympy.Symbol("x")

small = st.integers(-3, 3)
polynomials = st.lists(small, min_size=1, max_size=3).map(lambda c: RatFunc(QQ.poly(c)))
ratios = st.tuples(polynomials, polynomials).filter(lambda pair: bool(pair[1])).map(lambda pair: pair[0] / pair[1])


@pytest.mark.long
@settings(max_examples=60, deadline=None)
@given(ratios, ratios, st.lists(st.tuples(small, small), max_size=2))
def test_derivatives_are_integrated(E: RatFunc, W: RatFunc, levels: list[tuple[int, int]]) -> None:
    """W exp(E) + sum c exp(e) Ei(E - e), for rational e."""
    slope = E.derivative()
    assume(bool(slope) and len({e for _, e in levels}) == len(levels))
    r = W.derivative() + W * slope
    for c, e in levels:
        r = r + slope / (E - e) * c
    done = integrate_exponential(r, E)
    assert not isinstance(done, str)
    assert done.integrand == r


@pytest.mark.long
@settings(max_examples=30, deadline=None)
@given(ratios, ratios, st.sampled_from([1, -1, 2, -3]), small, small)
def test_error_functions(q: RatFunc, W: RatFunc, b: int, e: int, c: int) -> None:
    E = q * q * b + e
    assume(bool(q.derivative()))
    r = W.derivative() + W * E.derivative() + q.derivative() * c
    done = integrate_exponential(r, E)
    assert not isinstance(done, str)
    assert done.integrand == r


def test_what_is_left_and_why() -> None:
    """int x exp(x + 1/x), and a residue at a pole that E - E(a) has no zeros to go with."""
    assert "isn't a rational function times the exponential" in str(integrate_exponential(X, X + 1 / X))
    assert "residue" in str(integrate_exponential(1 / (X - 1), X * X))
    assert not isinstance(integrate_exponential(1 / (X - 1) + 1 / (X + 1), X * X), str)


@parametrize(
    ("integrand", "functions"),
    [
        ((x**2 + 1) * exp(x - 1 / x) / (x * (x**2 - 1)), {Ei(x - 1 / x)}),
        ((x + 1) ** 2 * exp(4 / (3 * (x + 1))) / (4 * x + 1) ** 5, {Ei(4 / (3 * (x + 1)) - sympy.Rational(16, 9))}),
        ((1 + 1 / x**2) * exp(-((x - 1 / x) ** 2)), {erf(x - 1 / x)}),
        ((1 - 1 / x**2) * exp((x + 1 / x) ** 2), {erfi(x + 1 / x)}),
        ((2 * x + 1) * exp(x**2 + x) / (x**2 + x - 5), {Ei(x**2 + x - 5)}),
        (exp(x / (x - 1)) / (x - 1), {Ei(1 / (x - 1))}),
    ],
    ordinary=0,
    long=3,
)
def test_second_solutions(integrand: sympy.Expr, functions: set) -> None:
    """y1 = h^(-1/2), so that y2 = y1 int h; substituted, by 30 digits."""
    omega = -sympy.cancel(integrand.diff(x) / integrand) / 2
    S = sympy.cancel(sympy.together(omega.diff(x) + omega**2))
    form = kovacic.solve(S).closed_form
    assert form is not None
    found = {f.func(sympy.cancel(f.args[0])) for f in form.y2.atoms(Ei, erf, erfi)}
    assert found == {f.func(sympy.cancel(f.args[0])) for f in functions}
    for y in form:
        rest = (y.diff(x, 2) - S * y).subs(x, sympy.Rational(17, 10))
        assert abs(sympy.N(rest, 30)) < 1e-25 * (1 + abs(sympy.N(y.subs(x, sympy.Rational(17, 10)), 30)))


def test_combinations_over_a_field_with_a_parameter() -> None:
    S = kovacic.solve("y'' = (a*x + 1)/x^2*y", var="x").S
    field = S.field
    a = S.num[1]
    p, q = field.poly([1, a]), field.poly([a, 0, 1])
    target = p * a - q * (a + 1)
    assert combination(target, [p, q]) == [a, -(a + 1)]
    assert combination(target + field.poly([0, 0, 0, 1]), [p, q]) is None

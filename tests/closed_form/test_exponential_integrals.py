"""Second solutions with Ei and error functions: the integrand is chosen, and the function that it leads to found again."""

from __future__ import annotations

import sympy
from build import parametrize
from sympy import Ei, Rational, erf, erfi, exp, hyper, uppergamma

import kovacic

x = sympy.Symbol("x", positive=True)
THIRD = Rational(1, 3)


@parametrize(
    ("integrand", "functions"),
    [
        ((x**2 + 1) * exp(x - 1 / x) / (x * (x**2 - 1)), {Ei(x - 1 / x)}),
        ((x + 1) ** 2 * exp(4 / (3 * (x + 1))) / (4 * x + 1) ** 5, {Ei(4 / (3 * (x + 1)) - sympy.Rational(16, 9))}),
        ((1 + 1 / x**2) * exp(-((x - 1 / x) ** 2)), {erf(x - 1 / x)}),
        ((1 - 1 / x**2) * exp((x + 1 / x) ** 2), {erfi(x + 1 / x)}),
        ((2 * x + 1) * exp(x**2 + x) / (x**2 + x - 5), {Ei(x**2 + x - 5)}),
        (exp(x / (x - 1)) / (x - 1), {Ei(1 / (x - 1))}),
        ((x + 2) ** 2 * exp(-3 * x) / x**THIRD, {uppergamma(2 * THIRD, 3 * x)}),
        ((x + 2) ** 2 * exp(3 * x) / x**THIRD, {hyper((2 * THIRD,), (5 * THIRD,), 3 * x)}),
        ((x + 2) ** 2 * exp(3 * x) / sympy.sqrt(x), {erfi(sympy.sqrt(3 * x))}),
        ((x**2 + 2) ** 2 * exp(-3 * x**2), {erf(sympy.sqrt(3) * x)}),
        (x**2 * exp(x**3), set()),
    ],
    ordinary=(6, 7),
    long=3,
)
def test_second_solutions(integrand: sympy.Expr, functions: set) -> None:
    """y1 = h^(-1/2), so that y2 = y1 int h; substituted, by 30 digits."""
    omega = sympy.cancel(sympy.expand_log(sympy.log(integrand)).diff(x)) / -2
    S = sympy.cancel(sympy.together(omega.diff(x) + omega**2))
    form = kovacic.solve(S).closed_form
    assert form is not None
    y1, y2 = (y.subs(sympy.Symbol("x"), x) for y in form)
    found = {_in_lowest_terms(f) for f in y2.atoms(sympy.Function) - y2.atoms(exp)}
    assert found == {_in_lowest_terms(f) for f in functions}
    for y in (y1, y2):
        rest = (y.diff(x, 2) - S * y).subs(x, Rational(17, 10))
        assert abs(sympy.N(rest, 30)) < 1e-25 * (1 + abs(sympy.N(y.subs(x, Rational(17, 10)), 30)))


def _in_lowest_terms(f: sympy.Expr) -> sympy.Expr:
    *parameters, argument = f.args
    return f.func(*parameters, sympy.cancel(argument))


def test_incomplete_gamma_functions_and_poles_at_irrational_points() -> None:
    """y1^-2 = x^(-1/3) exp(-x) and exp(x)/(x^2 - 2): the sum over both poles is written out."""
    (_, y2), (_, z2) = (
        (y.subs(sympy.Symbol("x"), x) for y in kovacic.solve(S).solutions)
        for S in ("1/4 + 1/(6*x) - 5/(36*x^2)", "1/4 - x/(x^2 - 2) - 2/(x^2 - 2)^2")
    )
    assert y2.atoms(sympy.uppergamma) == {sympy.uppergamma(sympy.Rational(2, 3), x)}
    assert z2.atoms(Ei) == {Ei(x - sympy.sqrt(2)), Ei(x + sympy.sqrt(2))}

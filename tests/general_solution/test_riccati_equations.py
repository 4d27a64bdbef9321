"""Riccati equations through `dsolve` and `solve_riccati`: built from the solutions of their linear equations."""

from __future__ import annotations

from functools import reduce
from typing import Any

import mpmath
import pytest
import sympy
from build import parametrize, read_expression, size
from sympy import Rational, airyai, airybi, cos, erf, exp, log, sin

import kovacic

x, C1, a = sympy.symbols("x C1 a")
w = sympy.Function("w")

#: u1, u2 and r with w = -u'/(r u).
PROBLEMS: list[tuple[Any, Any, Any]] = [
    (cos(3 * x), sin(3 * x), sympy.Integer(2)),
    (exp(x**2 / 2), exp(x**2 / 2) * erf(x / sympy.sqrt(2)), sympy.Integer(-1)),
    (airyai(-x), airybi(-x), sympy.Integer(1)),
    (x**2 * exp(a * x), x**2 * exp(a * x) * log(x), -x),
    (x + 1, x**3, 1 / x),
    (exp(x) * cos(x), exp(x) * sin(x), exp(x)),
]
POINT = Rational(5, 4)


def coefficients(u1: Any, u2: Any, r: Any) -> list[Any]:
    """p, q and r of the equation with the solutions -u'/(r u)."""
    wronskian = sympy.simplify((u1 * u2.diff(x) - u1.diff(x) * u2).rewrite(airyai))
    if u1.has(airyai):
        b, c = sympy.Integer(0), x
    else:
        b = sympy.simplify(-wronskian.diff(x) / wronskian)
        c = sympy.simplify(-(u1.diff(x, 2) + b * u1.diff(x)) / u1)
    return [sympy.simplify(part) for part in (c / r, -b - r.diff(x) / r, r)]


def number(e: Any, at: Any = 1.25, constant: Any = 2) -> Any:
    slopes = {"airyaiprime": lambda z: mpmath.airyai(z, 1), "airybiprime": lambda z: mpmath.airybi(z, 1)}
    plain = sympy.lambdify((x, C1, a), e, [slopes, "mpmath"])
    with mpmath.workdps(40):
        return plain(mpmath.mpf(at), mpmath.mpf(constant), mpmath.mpf(2) / 3)


@parametrize("problem", PROBLEMS, ids=lambda problem: str(problem[0]), ordinary=0, long=1)
def test_general_solution_and_values(problem: tuple[Any, Any, Any]) -> None:
    p, q, r = coefficients(*problem)
    equation = sympy.Eq(w(x).diff(x), p + q * w(x) + r * w(x) ** 2)
    found = kovacic.dsolve(equation)
    general = found.rhs
    residual = general.diff(x) - p - q * general - r * general**2
    assert found.lhs == w(x)
    for constant in (2, -0.375):
        assert abs(number(residual, constant=constant)) < 1e-15
    assert abs(number(general, constant=2) - number(general, constant=3)) > 1e-6
    u = problem[0] + 2 * problem[1]
    wanted = -u.diff(x) / (r * u)
    special = kovacic.dsolve(equation, ics={w(POINT): wanted.subs(x, POINT)}).rhs
    assert not special.has(C1)
    assert abs(number(special - wanted, at=1.6)) < 1e-15


def test_known_forms() -> None:
    assert kovacic.dsolve("w' = 1 + w^2").rhs == sympy.tan(x + C1)
    assert kovacic.dsolve("w'(t) = w(t)^2, w(0) = 1/2").rhs == 1 / (2 - sympy.Symbol("t"))
    assert kovacic.dsolve("w' = -w^2 + x*w + 1").rhs.has(erf)


@pytest.mark.parametrize(
    ("equation", "printed"),
    [
        ("w' = -w^2 - 4*w/x - 2/x^2", "1/(C1 + x) - 2/x"),
        ("w' = -w^2 + (2*x + 1/x)*w - x^2", "x + 2*x/(C1 + x**2)"),
        ("w' = w^2/x^2 - w/x + 1", "(C1*x + x*log(x))/(C1 + log(x) + 1)"),  # by that for 1/w, which has poles
        (
            "w' = -w^2*(x+1) + x^2*(x+1) + 1",
            "x + exp(-2*x**3/3 - x**2)/(C1 + Integral((x + 1)*exp(-2*x**3/3 - x**2), x))",
        ),
        ("w' = -w^2 - 2/(x^3-x^2)", "-x**2/((x - 1)**2*(-C1 - x - 2*log(x - 1) + 1/(x - 1))) + 1/(x**2 - x)"),
        pytest.param("w' = 2*I*(w^2+1)/x", "I + 2*I/(4*C1*x**4 - 1)", marks=pytest.mark.long),
        ("v' = g - k*v^2, v(0) = 0", "sqrt(g*k)*tanh(x*sqrt(g*k))/k"),
        ("w' = 1 + w^2, w(0) = a", "tan(x + atan(a))"),
        (
            "w' = x^n + w^2",
            "-x**(n/2)*(C1*besselj(-1 + 1/(n + 2), 2*x**(n/2 + 1)/(n + 2))"
            " + bessely(-1 + 1/(n + 2), 2*x**(n/2 + 1)/(n + 2)))"
            "/(C1*besselj(1/(n + 2), 2*x**(n/2 + 1)/(n + 2)) + bessely(1/(n + 2), 2*x**(n/2 + 1)/(n + 2)))",
        ),
    ],
)
def test_the_forms_are_reduced(equation: str, printed: str) -> None:
    """No 0/0 at a regular point, and nothing that cancels."""
    assert str(kovacic.dsolve(equation).rhs) == printed


def test_the_unknown_may_stand_in_a_denominator() -> None:
    found = kovacic.dsolve(sympy.Eq(w(x).diff(x) / w(x), 2 / x + w(x)))
    assert sympy.checkodesol(sympy.Eq(w(x).diff(x), 2 * w(x) / x + w(x) ** 2), found) == (True, 0)


def test_solve_riccati_takes_an_equation() -> None:
    wanted = kovacic.solve_riccati("x^2 + 3", 0, -1).rational
    assert kovacic.solve_riccati("w' = x^2 + 3 - w^2").rational == wanted
    assert kovacic.solve_riccati(sympy.Eq(w(x).diff(x), x**2 + 3 - w(x) ** 2)).rational == wanted


@pytest.mark.parametrize("equation", ["w' = w^3 + 1", "w'^2 = w", "w'' = w^2", "w' = sin(w)", "w' = w^2 + v'"])
def test_others_are_refused(equation: str) -> None:
    with pytest.raises(kovacic.InputError):
        kovacic.dsolve(equation)
    with pytest.raises(kovacic.InputError):
        kovacic.solve_riccati(equation)


def test_solve_riccati_refuses_linear_equations() -> None:
    with pytest.raises(kovacic.InputError, match="isn't a Riccati equation"):
        kovacic.solve_riccati("w' = w")


@pytest.mark.parametrize("ics", ["w(0)=1, w(1)=2", "w'(0)=1", "w(0)=w(1)"])
def test_one_value_is_expected(ics: str) -> None:
    with pytest.raises(kovacic.InputError, match="has one value"):
        kovacic.dsolve("w' = 1 + w^2", ics=ics)


#: p, q, r whose r vanishes at 0, with p or without; and values there.
VANISHING = [
    ("1", "0", "x"),
    ("1", "1", "x"),
    ("2", "0", "-x^2"),
    ("x", "0", "x"),
    ("0", "1", "x"),
    ("x", "x", "x"),
    ("x^2", "0", "-x^2"),
    ("x^3", "0", "-x"),
    ("0", "2*x", "x"),
    ("x + x^2", "0", "x + x^2"),
    ("sin(x)", "0", "sin(x)"),
]


@parametrize("start", ["0", "1", "-2/3"], ordinary=1, long=1)
@parametrize("coefficients_as_text", VANISHING, ordinary=1, long=2, ids=str)
def test_a_value_where_the_square_has_no_coefficient(coefficients_as_text: tuple[str, str, str], start: str) -> None:
    """The linear equation is singular there, Riccati's isn't: one solution, that of an integration."""
    p, q, r = (read_expression(text) for text in coefficients_as_text)
    found = kovacic.dsolve(f"w' = {p} + ({q})*w + ({r})*w^2".replace("**", "^"), ics=f"w(0) = {start}").rhs
    assert found.free_symbols <= {x}
    here = sympy.Symbol("w")
    slope = sympy.lambdify((x, here), p + q * here + r * here**2, "mpmath")
    with mpmath.workdps(20):
        first = mpmath.mpf(Rational(start).p) / Rational(start).q
        integrated = mpmath.odefun(slope, mpmath.mpf(0), first)(mpmath.mpf("0.375"))
        assert abs(number(found, at=0.375) - integrated) < 1e-12


def test_values_at_singular_points() -> None:
    assert kovacic.dsolve("x*w' = w + w^2", ics="w(0)=0").rhs.has(C1)
    assert kovacic.dsolve("x*w' = w + w^2", ics="w(0)=-1").rhs == -1
    with pytest.raises(kovacic.UnsatisfiableConditions, match="no solution with this value at 0, a singular point"):
        kovacic.dsolve("x*w' = w + w^2", ics="w(0)=1")


def test_the_linear_equation_for_the_reciprocal_where_it_is_the_simpler_one() -> None:
    assert kovacic.dsolve("w' = 1 - x*w^2").rhs.atoms(sympy.Function) == {
        *(f(x) for f in (airyai, airybi, sympy.airyaiprime, sympy.airybiprime))
    }


k, L, b = sympy.Symbol("k", positive=True), sympy.Symbol("L", positive=True), sympy.Symbol("b")

#: p, q, r, with symbols that the linear equation or the value alone has, and points at which r is 0; and a value.
WITH_VALUES: list[tuple[Any, Any, Any, Any, Any]] = [
    (0, k, -k / L, 0, b),
    (0, k, C1 * k, 1, b),
    (a, 0, 1, Rational(1, 3), L * b),
    (0, 0, b * x, 0, C1),
    (0, L / x, b * x, 1, k),
    (0, a, x**2, 0, b),
    (0, 2, (x - 1) ** 2, 1, b),
    (2 / (x - 3) ** 2, 0, 1, 1, b),
]


@parametrize(("p", "q", "r", "point", "value"), WITH_VALUES, ordinary=1, long=2)
def test_values_with_symbols(p: Any, q: Any, r: Any, point: Any, value: Any) -> None:
    """No symbol of the question is taken for a constant, and r may be 0 at the point."""
    found = kovacic.dsolve(sympy.Eq(w(x).diff(x), p + q * w(x) + r * w(x) ** 2), w(x), ics={w(point): value}).rhs
    numbers = {k: Rational(7, 5), L: Rational(9, 4), b: Rational(-3, 7), C1: Rational(5, 3), a: Rational(1, 3)}
    residual = found.diff(x) - p - q * found - r * found**2
    assert size(residual.subs(numbers).subs(x, Rational(6, 5)), 30) < 1e-20
    beside = point + Rational(1, 10**15)
    assert size((found.subs(x, beside) - value).subs(numbers), 30) < 1e-12


def test_a_value_is_given_at_a_finite_point() -> None:
    with pytest.raises(kovacic.InputError, match="at a finite point"):
        kovacic.dsolve("w' = 1 - w^2", ics="w(oo)=1")


def test_signs_and_floats() -> None:
    assert str(kovacic.dsolve("w' = 1 + w^2", ics="w(0)=1").rhs) == "tan(x + pi/4)"
    found = kovacic.dsolve(sympy.Eq(w(x).diff(x), w(x) ** 2 + 0.25), ics={w(0): 0.5}).rhs
    assert found.atoms(sympy.Float)
    assert not found.has(sympy.sqrt(2), Rational(1, 2))


@parametrize("third", ["1/3", "1/5", "1/4", "6/5"], ordinary=(0,), long=1)
def test_polynomials_of_case_3_have_no_common_factor(third: str) -> None:
    """w' = S - w^2 for the hypergeometric equations with the exponent differences 1/2, 1/3 and this one."""
    c = sympy.Rational(third) ** 2
    x, w = sympy.symbols("x w")
    S = (
        -sympy.Rational(3, 16) / x**2
        - sympy.Rational(2, 9) / (x - 1) ** 2
        + (sympy.Rational(23, 36) + c) / (4 * x * (x - 1))
    )
    M = kovacic.solve_riccati(S, 0, -1).polynomial
    coefficients = [sympy.Poly(a, x) for a in sympy.Poly(M, w).all_coeffs()]
    assert reduce(sympy.gcd, coefficients).degree() == 0
    assert reduce(sympy.gcd, (c for a in coefficients for c in a.coeffs())) == 1
    total = (M.diff(w) * (S - w**2) + M.diff(x)).subs(x, 3)
    assert sympy.rem(sympy.Poly(total, w), sympy.Poly(M.subs(x, 3), w)) == 0


@parametrize("particular", [x, x**2, x**3], ordinary=2)
@pytest.mark.parametrize("r", [-(x + 1), x**2 + 1, x**2 - x, -(x**3) - 2])
def test_an_integral_that_stays_has_the_exponential_beside_it(particular: Any, r: Any) -> None:
    """For w0' = p + r w0^2 the others are w0 - E/(r (C1 + int E dx)) with one E, whose exponent has one form."""
    p = sympy.expand(particular.diff(x) - r * particular**2)
    found = kovacic.dsolve(sympy.Eq(w(x).diff(x), p + r * w(x) ** 2), w(x)).rhs
    (integral,) = found.atoms(sympy.Integral)
    assert found.atoms(exp) == integral.function.atoms(exp)
    assert found.xreplace({integral: C1}).atoms(exp) == integral.function.atoms(exp)


@parametrize(
    ("h", "r"),
    [
        (1 / x, log(x)),
        (exp(x), log(x)),
        (1 / (x * log(x)), log(x)),
        (exp(sympy.sqrt(x)), sympy.Integer(1)),
        (1 / sympy.sqrt(log(x)), 1 / x),
        (log(x) ** 2, -1 / x),
    ],
    ordinary=2,
)
@pytest.mark.parametrize("value", [None, 0, Rational(1, 3)])
def test_bernoulli_equations_with_functions_in_their_coefficients(h: Any, r: Any, value: Any) -> None:
    """w' = (h'/h) w + r w^2, whose linear equation of second order isn't rational: 1/w = (C - int h r)/h."""
    q = sympy.cancel(h.diff(x) / h)
    ics = None if value is None else {w(2): value}
    found = kovacic.dsolve(sympy.Eq(w(x).diff(x), q * w(x) + r * w(x) ** 2), ics=ics).rhs.doit()
    found = found.subs(C1, 3)
    residual = found.diff(x) - q * found - r * found**2
    assert size(residual.subs(x, Rational(7, 3))) < 1e-12
    if value is not None:
        assert size(found.subs(x, 2) - value) < 1e-12


@pytest.mark.parametrize(
    ("text", "point"),
    [
        ("w' = sin(x)*w^2 - 2*sin(x)/cos(x)^2", 0),
        pytest.param("w' = cos(x)*w^2 - 2*cos(x)/sin(x)^2", "pi/2", marks=pytest.mark.long),
    ],
)
def test_quotients_of_waves_are_reduced(text: str, point: Any) -> None:
    """sin(2 x)/sin(x) would be 0/0 at a regular point: there, the general solution has a value for each constant."""
    x = sympy.Symbol("x")
    found = kovacic.dsolve(text).rhs
    value = found.subs(x, sympy.sympify(point))
    assert value.is_finite is not False
    assert value.diff(sympy.Symbol("C1")) != 0
    p, r = (sympy.sympify(part.replace("^", "**")) for part in text.partition("= ")[2].replace("*w^2", "").split(" - "))
    residual = found.diff(x) - p * found**2 + r
    assert size(residual.subs({x: sympy.Rational(3, 7), sympy.Symbol("C1"): 3})) < 1e-15


@pytest.mark.parametrize(
    ("text", "needed"),
    [
        ("y' = y^2 + k", "k > 0, cos(C1 + sqrt(k)*x) != 0"),
        ("y' = y^2 - k^2", "C1*exp(2*k*x) + 1 != 0, k != 0"),
        ("y' = y^2 + k*x", "k > 0, C1*airyai(-k**(1/3)*x) + airybi(-k**(1/3)*x) != 0"),
    ],
)
def test_solutions_are_not_all_of_them_where_the_linear_pair_is_dependent(text: str, needed: str) -> None:
    """At k = 0 the formulas are 0, and the solutions are 0 and 1/(C1 - x)."""
    assert str(kovacic.answer_to(text).validity) == needed
    assert str(kovacic.validity(kovacic.dsolve(text))) == needed


def test_a_letter_may_stand_in_the_point_of_the_value_alone() -> None:
    a, b, x = sympy.symbols("a b x")
    assert kovacic.dsolve("y' = 1 + y^2, y(a) = b").rhs == sympy.tan(x - a + sympy.atan(b))

"""dsolve and Riccati equations: general solutions, initial values, refusals."""

from __future__ import annotations

import time

import mpmath
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import I, Rational, cos, exp, sin, sqrt

import kovacic
from kovacic.general_solution import dsolve, solve_riccati
from kovacic.general_solution.undetermined import undetermined
from kovacic.reading.symbolic import read_expression

x, C1, C2, w = sympy.symbols("x C1 C2 w")
y = sympy.Function("y")


def residual(left: sympy.Expr, solution: sympy.Eq, point: str = "0.37") -> float:
    """|left| at a point for the solution with C1 = 2, C2 = -3, by 30 digits."""
    value = solution.rhs.subs({C1: 2, C2: -3})
    expression = left.subs(y(x), value).doit()
    return abs(complex(sympy.N(expression.subs(x, Rational(point)), 30)))


EQUATIONS = [
    y(x).diff(x, 2) + y(x) - x,
    y(x).diff(x, 2) + y(x) - sin(x),
    y(x).diff(x, 2) + y(x) - 1 / cos(x),
    y(x).diff(x, 2) + y(x) - sympy.tan(x),
    x**2 * y(x).diff(x, 2) + x * y(x).diff(x) + (x**2 - Rational(1, 4)) * y(x) - x ** Rational(3, 2),
    y(x).diff(x, 2) - 2 * y(x).diff(x) + y(x) - exp(x) / x,
    y(x).diff(x, 2) - (x**2 + 3) * y(x),
    x**2 * y(x).diff(x, 2) - 2 * y(x) - x**3,
    y(x).diff(x, 2) + 4 * y(x).diff(x) + 4 * y(x) - exp(-2 * x),
    y(x).diff(x, 2) + y(x).diff(x) - x**2,
    x**2 * y(x).diff(x, 2) + x * y(x).diff(x) + y(x) - sympy.log(x),
    (1 - x**2) * y(x).diff(x, 2) - 2 * x * y(x).diff(x) + 6 * y(x) - 1,
]


@pytest.mark.parametrize("left", EQUATIONS, ids=str)
def test_general_solutions(left: sympy.Expr) -> None:
    solution = dsolve(left)
    assert solution.lhs == y(x)
    assert {C1, C2} <= solution.rhs.free_symbols
    assert not solution.rhs.has(sympy.Integral)
    assert residual(left, solution) < 1e-20


@pytest.mark.parametrize("left", EQUATIONS[:3] + EQUATIONS[6:10], ids=str)
def test_checkodesol_agrees(left: sympy.Expr) -> None:
    assert sympy.checkodesol(left, dsolve(sympy.Eq(left, 0)), y(x)) == (True, 0)


def test_an_integral_that_is_not_done() -> None:
    solution = dsolve("y'' - y = exp(x^3)")
    assert solution.rhs.has(sympy.Integral)
    left = y(x).diff(x, 2) - y(x) - exp(x**3)
    assert sympy.simplify(left.subs(y(x), solution.rhs).doit(integrals=False)) == 0
    started = dsolve("y'' - y = exp(x^3)", ics={"y(0)": 0, "y'(0)": 1}).rhs
    assert started.subs(x, 0).doit() == 0
    value = complex(sympy.N(started.subs(x, 1), 20))

    expected = mpmath.sinh(1) + mpmath.quad(lambda s: mpmath.sinh(1 - s) * mpmath.exp(s**3), [0, 1])
    assert abs(value - expected) < 1e-9


def test_an_error_function() -> None:
    left = y(x).diff(x, 2) - y(x) - exp(x**2)
    solution = dsolve(left)
    assert solution.rhs.has(sympy.erfi)
    assert not solution.rhs.has(sympy.Integral)
    assert residual(left, solution) < 1e-20


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("y'' + y = cos(5*x)", -cos(5 * x) / 24),
        ("y'' + 4*y = cosh(x)", exp(x) / 10 + exp(-x) / 10),
        ("y'' + 2*y' + 5*y = sin(x)", sin(x) / 5 - cos(x) / 10),
        ("y'' + y = sin(x)", -x * cos(x) / 2),
        ("y'' - 2*y' + y = x*exp(x)", x**3 * exp(x) / 6),
        ("y'' + 4*y = sin(x)^2", Rational(1, 8) - x * sin(2 * x) / 8),
    ],
)
def test_undetermined_coefficients(text: str, expected: sympy.Expr) -> None:
    """No integrals: at once, and without parts that solve the homogeneous equation."""
    assert sympy.expand(dsolve(text).rhs.subs({C1: 0, C2: 0}) - expected) == 0


numbers = st.integers(-3, 3).map(sympy.Integer)
waves = st.tuples(
    numbers, st.integers(0, 3), numbers, st.sampled_from((sin, cos, sympy.sinh, sympy.cosh)), numbers, numbers
)
#: (b, c), with the roots 0, 1, -2, +-i, 1 +- 2i, +-sqrt(2) among those of the characteristic polynomials.
constants = st.sampled_from(
    [(0, 0), (0, 1), (-1, 0), (2, 0), (4, 4), (1, -2), (-2, 5), (0, -2), (-2, 1), (0, 9), (1, 1)]
)


@settings(max_examples=60, deadline=None)
@given(constants, st.lists(waves, min_size=1, max_size=3))
def test_random_right_hand_sides(equation: tuple[int, int], terms: list) -> None:
    """Substituted; the roots of the characteristic polynomial often are exponents on the right: resonance."""
    b, c = map(sympy.Integer, equation)
    right = sympy.Add(*(k * x**m * exp(r * x) * wave(w * x + d) for k, m, r, wave, w, d in terms))
    found = undetermined(b, c, right, x)
    assert found is not None
    left = found.diff(x, 2) + b * found.diff(x) + c * found - right
    for point in (Rational(3, 7), Rational(-5, 4)):
        assert abs(sympy.N(left.subs(x, point), 30)) < 1e-15 * (1 + abs(sympy.N(right.subs(x, point))))


@pytest.mark.parametrize("right", [1 / x, exp(x**2), sympy.tan(x), sympy.log(x), sqrt(x), sin(x**2), sin(x) / cos(x)])
def test_other_right_hand_sides(right: sympy.Expr) -> None:
    assert undetermined(sympy.Integer(0), sympy.Integer(1), right, x) is None


def test_constants_and_variables_are_new() -> None:
    """Where the equation has a C1, the constants are C2 and C3; and no integral captures a parameter."""
    found = dsolve("y'' - C1^2*y = 0", var="x").rhs
    assert {symbol.name for symbol in found.free_symbols} == {"x", "C1", "C2", "C3"}
    started = dsolve("y'' - C1^2*y = 0", var="x", ics={"y(0)": 1, "y'(0)": 0}).rhs
    assert sympy.simplify(started.rewrite(sympy.cosh) - sympy.cosh(C1 * x)) == 0
    s = sympy.Symbol("s")
    captured = dsolve(y(x).diff(x, 2) - y(x) - exp(s * x**3), ics={y(0): 0, y(x).diff(x).subs(x, 0): 0}).rhs
    assert captured.has(sympy.Integral)
    assert s in captured.free_symbols
    assert all(s not in integral.variables for integral in captured.atoms(sympy.Integral))


def test_symbols_are_the_users() -> None:
    omega = sympy.Symbol("w", positive=True)
    found = dsolve(y(x).diff(x, 2) + omega**2 * y(x) - 1).rhs
    assert omega in found.free_symbols
    assert w not in found.free_symbols


@pytest.mark.parametrize("right", ["sin(x)/x", "exp(x)*log(x)*sin(x)", "exp(sin(x))"])
def test_integration_ends_in_time(right: str) -> None:
    """SymPy's integration runs in a process that is killed; what isn't done is an `Integral`."""
    start = time.monotonic()
    found = dsolve(f"y'' + 2*y' + 5*y = {right}", limits=kovacic.Limits(seconds=2)).rhs
    assert time.monotonic() - start < 2 + 1 + 5  # other processes share the machine
    assert found.has(sympy.Integral)
    part = found.subs({C1: 0, C2: 0})
    left = part.diff(x, 2) + 2 * part.diff(x) + 5 * part - read_expression(right)
    assert sympy.simplify(left.doit(integrals=False)) == 0


@pytest.mark.parametrize(
    ("text", "ics", "expected"),
    [
        ("y'' + y = 0", {"y(0)": 1, "y'(0)": 2}, cos(x) + 2 * sin(x)),
        ("y'' + y = 0", {y(0): 1, y(x).diff(x).subs(x, 0): 2}, cos(x) + 2 * sin(x)),
        ("y'' + y = x", {y(0): 0, y(x).diff(x).subs(x, 0): 0}, x - sin(x)),
        ("x^2 y'' - 2 y = 0", {"y(1)": 0, "y'(1)": 3}, x**2 - 1 / x),
        ("y'' - 2*x*y' + 2*y = 0", {"y(0)": 0, "y'(0)": 5}, 5 * x),
        ("y'' = 2*y", {"y(0)": 1, "y'(0)": "sqrt(2)"}, exp(sqrt(2) * x)),
        ("y'' + y = 0", {"y(0)": 1}, cos(x) + C2 * sin(x)),
        ("x^2 y'' + x y' + (x^2 - 9/4) y = 0", {"y(1)": 1, "y'(1)": "-3/2"}, None),
    ],
)
def test_initial_values(text: str, ics: dict, expected: sympy.Expr | None) -> None:
    found = dsolve(text, ics=ics).rhs
    if expected is not None:
        assert sympy.simplify(found - expected) == 0
    else:
        assert abs(sympy.N(found.subs(x, 1) - 1, 30)) < 1e-25
        assert abs(sympy.N(found.diff(x).subs(x, 1) + Rational(3, 2), 30)) < 1e-25


def test_initial_values_that_cannot_be() -> None:
    with pytest.raises(ValueError, match="singular point"):
        dsolve("x^2 y'' - 2 y = 0", ics={"y(0)": 1})
    with pytest.raises(kovacic.InputError, match="one point"):
        dsolve("y'' = y", ics={"y(0)": 1, "y'(1)": 1})
    with pytest.raises(kovacic.InputError, match="float"):
        dsolve("y'' = y", ics={"y(0)": 0.1})
    for key in ("z(0)", "y''(0)", "y"):
        with pytest.raises(kovacic.InputError, match="initial value"):
            dsolve("y'' = y", ics={key: 1})


def test_symbols_keep_their_assumptions() -> None:
    t = sympy.Symbol("t", positive=True)
    solution = dsolve(sympy.Eq(t**2 * y(t).diff(t, 2), 2 * y(t)))
    assert solution.lhs == y(t)
    assert solution.rhs.free_symbols == {t, C1, C2}


def test_no_liouvillian_solution_is_a_proven_reason() -> None:
    with pytest.raises(NotImplementedError, match=r"proven.*SL2"):
        dsolve("y'' = x*y")
    with pytest.raises(kovacic.NotLinear):
        dsolve(y(x).diff(x, 2) + y(x) ** 2)
    with pytest.raises(kovacic.InputError):
        dsolve(3)


def riccati_residual(p: str, q: str, r: str, value: sympy.Expr) -> sympy.Expr:
    P, Q, R = (read_expression(text) for text in (p, q, r))
    return sympy.simplify(value.diff(x) - P - Q * value - R * value**2)


@pytest.mark.parametrize(
    ("p", "q", "r", "count"),
    [
        ("x^2 + 3", "0", "-1", 1),
        ("1", "0", "1", 2),
        ("1/x", "1/x", "x", 2),
        ("2/x^2 + 1", "0", "-1", 2),
        ("1/x^2", "-1/x", "1", 2),
        ("-x^2", "1", "1", 0),
        ("x", "0", "1", 0),
    ],
)
def test_rational_solutions_of_riccati_equations(p: str, q: str, r: str, count: int) -> None:
    found = solve_riccati(p, q, r)
    assert len(found.rational) == count
    assert len(set(found)) == count
    assert all(riccati_residual(p, q, r, value) == 0 for value in found)


@pytest.mark.parametrize(
    ("p", "q", "r"), [("0", "0", "1"), ("2/x^2", "0", "-1"), ("6/x^2", "-1/x", "-1"), ("-2/(9*x^2)", "0", "-1")]
)
def test_families_of_algebraic_solutions(p: str, q: str, r: str) -> None:
    found = solve_riccati(p, q, r)
    assert found.all_algebraic or found.family is None
    if found.family is not None:
        assert C1 in found.family.free_symbols
        assert riccati_residual(p, q, r, found.family) == 0


def test_algebraic_solutions_of_degree_two() -> None:
    found = solve_riccati("1/x - 3/(16*x^2)", 0, -1)
    assert found.rational == ()
    assert found.all_algebraic is False
    roots = sympy.solve(found.polynomial, w)
    assert len(roots) == 2
    assert all(riccati_residual("1/x - 3/(16*x^2)", "0", "-1", value) == 0 for value in roots)


def test_algebraic_solutions_of_degree_four() -> None:
    found = solve_riccati("(-32*x^2 + 27*x - 27)/(144*x^2*(x-1)^2)", 0, -1)
    assert found.all_algebraic
    assert sympy.degree(found.polynomial, w) == 4


def test_the_solutions_of_a_constant_riccati_equation() -> None:
    assert set(solve_riccati(1, 0, 1).rational) == {I, -I}
    with pytest.raises(kovacic.InputError, match="linear of first order"):
        solve_riccati("x", 1, 0)

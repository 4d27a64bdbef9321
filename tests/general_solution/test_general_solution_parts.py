"""What `dsolve` is made of: behaviours at a point, ranks, antiderivatives, undetermined coefficients, values."""

from __future__ import annotations

import pickle
import random
from random import Random
from typing import Any

import mpmath
import pytest
import sympy
from build import generated, parametrize, size
from hypothesis import given
from hypothesis import strategies as st
from sympy import Rational, Symbol, cos, exp, log, oo, pi, sin, sqrt

import kovacic
from kovacic import answer_to, dsolve
from kovacic.closed_form import steps
from kovacic.general_solution.antiderivatives import antiderivative
from kovacic.general_solution.behaviour import (
    _LEADING,
    OSCILLATING,
    Approach,
    UnknownLimit,
    _term_by_term,
    _with_leading_terms,
    limit_at,
    value_or_limit,
    values_at,
)
from kovacic.general_solution.check import is_finite
from kovacic.general_solution.conditions import read_conditions
from kovacic.general_solution.constants import CaseOutcome, Row, determine
from kovacic.general_solution.homogeneous import _real_places
from kovacic.general_solution.particular import DefiniteIntegral
from kovacic.general_solution.question import read_question, with_floats
from kovacic.general_solution.riccati import RiccatiSolutions
from kovacic.general_solution.substitution import finite_value
from kovacic.general_solution.textbook import as_quotient, in_book_form, with_waves
from kovacic.general_solution.undetermined import undetermined
from kovacic.general_solution.validity import POSITIVE, Need, _in_one_interval, needed_for
from kovacic.general_solution.waves import _at_tangent, _continuous_angle, fractions_of_waves, wave_zeros
from kovacic.general_solution.zero import Zero, is_algebraic_zero, when_zero
from kovacic.limits import DEFAULT_LIMITS

x, C1, C2, w = sympy.symbols("x C1 C2 w")


n = Symbol("n", integer=True, positive=True)


L = Symbol("L", positive=True)


k, a = Symbol("k", positive=True), Symbol("a", positive=True)


#: Expressions, and points at which they aren't analytic.
EXPANDED = [
    *(
        (sympy.sympify(e), 0)
        for e in ("bessely(0, x)", "besselk(2, x)", "bessely(1/3, x)", "Ci(x)", "Ei(-x)", "besselj(1/2, x)/x")
    ),
    *(
        (sympy.sympify(e), 0)
        for e in ("log(sin(x))/x**2", "x**(3/2)*exp(-x)/(1 - cos(x))", "elliptic_k(1 - x)", "exp(-1/x)*x")
    ),
    *(
        (sympy.hyper((Rational(1, 3), Rational(1, 2)), (c,), 1 - x), 0)
        for c in map(Rational, ("5/6", "11/6", "17/6", "7/5", "-1/6", "3/2"))
    ),
    (sympy.hyper((Rational(1, 3), Rational(4, 3)), (), -1 / x), oo),
    (sympy.hyper((Rational(1, 3), Rational(1, 5)), (), -1 / x), 0),
    (sympy.hyper((Rational(1, 3), Rational(4, 3)), (), -1 / x), 0),
    (sympy.hyper((Rational(1, 3), Rational(-5, 3)), (), -1 / x), 0),
    (sympy.hyper((Rational(1, 3),), (Rational(1, 2),), x), oo),
    (sympy.hyper((Rational(1, 3),), (Rational(1, 2),), x), -oo),
    *(
        (sympy.sympify(e), oo)
        for e in ("besselj(1, x)", "bessely(1/4, x)", "besseli(1, x)", "besselk(1, x)", "airyai(x)")
    ),
    *(
        (sympy.sympify(e), oo)
        for e in ("airybi(x)", "erf(x) - 1", "erfi(x)", "Ei(x)", "Ei(-x)", "Si(x)", "Ci(x)", "atan(x)")
    ),
    *((sympy.sympify(e), -oo) for e in ("erf(x)", "atan(x)", "Ei(x)", "sqrt(x**2 + 1) + x", "cosh(x)")),
    (sympy.tan(x), pi / 2),
    (sympy.legendre(n, cos(x)), pi),
]


@parametrize(("e", "point"), EXPANDED, ordinary=2, long=(1, 9, 14, 17, 19, 26, 34), ids=str)
def test_limits(e: Any, point: Any) -> None:
    """Against values by mpmath, near the point."""
    place = Approach(sympy.sympify(point))
    found = limit_at(e, x, place)
    with mpmath.workdps(40):
        far, near = (
            abs(sympy.N((e if found == oo else e - found).subs(n, 3).subs(x, place.in_terms_of(t)), 30, maxn=400))
            for t in (Rational(1, 50), Rational(1, 2000))
        )
    assert far < near if found == oo else near <= far


#: Functions of t > 0 that tends to 0, with a positive integer n and a letter a.
LEADING = [
    *(f"airy{kind}({z})" for kind in ("ai", "bi", "aiprime", "biprime") for z in ("1/t", "-1/t")),
    *(f"bessel{kind}({order}, {z})" for kind in "jyik" for order in ("2/7", "a") for z in ("1/t", "t")),
    *("bessely(0, t)", "besselk(0, t)", "jn(a, t)", "yn(a, t)", "legendre(a, t - 1)"),
    *(f"{name}, {z})" for name in ("hermite(n", "laguerre(n", "assoc_laguerre(n, a") for z in ("1/t", "-1/t")),
    *(f"hyper({top}, {c}, {z})" for top, c in (("()", "(2/7,)"), ("(3/5,)", "(a,)")) for z in ("1/t", "-1/t", "t")),
    *("hyper((-3,), (2/7,), 1/t)", "hyper((-3,), (2/7,), -1/t)", "hyper((3/5,), (-2/5,), -1/t)"),
    *(
        f"hyper({top}, (), {z})"
        for top in ("(3/5, 7/4)", "(7/4, 3/5)", "(5/3, 5/3)", "(-3, 4/7)")
        for z in ("1/t", "-1/t")
    ),
    *(f"hyper((2/3, a), ({c},), 1 - t)" for c in ("a + 2/3", "a + 7/5", "a - 1/5")),
    *("hyper((-3, 2/7), (a,), 1 - t)", "hyper((2/7, -3), (a,), 1 - t)", "hyper((-n, 2/7), (a,), 1 - t)"),
    *("hyper((-3, 9/2), (1/2,), 1 - t)", "hyper((-3, -9/2), (1/2,), 1 - t)"),  # (-4)_3, and (5)_3, over (1/2)_3
    *("hyper((3/5, 2/7), (), t)", "hyper((3/5, 2/7), (a,), t)", "hyper((3/5, 2/7), (a, 4/3), t)"),
    "hyper((3/5,), (a, 4/3), t)",
]


@pytest.mark.parametrize("text", LEADING)
def test_leading_terms(text: str) -> None:
    """f = (1 + small) times the leading term, but for a constant beside log(t); for waves, beside their amplitude."""
    t = Symbol("t", positive=True)
    f = sympy.sympify(text, {"n": n, "a": a, "t": t}, rational=True)
    leading = _with_leading_terms(f, t)
    assert not leading.has(*(e.func for e in f.atoms(sympy.Function)))
    for spherical, function in ((sympy.jn, sympy.besselj), (sympy.yn, sympy.bessely)):
        f = f.replace(spherical, lambda nu, z, of=function: sqrt(pi / (2 * z)) * of(nu + Rational(1, 2), z))
    with mpmath.workdps(30):
        numbers = [{n: 3, a: Rational(11, 8), t: Rational(1, 10**8) * k} for k in (1, Rational(8, 7))]
        values = [[sympy.N(e.subs(at), 25, maxn=500) for e in (f, leading)] for at in numbers]
    if f.has(sympy.legendre) or text.startswith("hyper((5/3, 5/3)"):
        power = Rational(5, 3) if f.has(sympy.hyper) else 0
        values = [[left - right / Rational(8, 7) ** power for left, right in zip(*values, strict=True)]]
    scale = max(abs(wanted) for wanted, _ in values)
    assert all(abs(found - wanted) < 1e-3 * scale for wanted, found in values), leading


def test_limits_that_are_not_known() -> None:
    """Integrals, nested logarithms of 0, and what SymPy's leading terms would get wrong."""
    for e in (sympy.zeta(1 / x), sympy.Integral(exp(-(x**2)) / x, x)):
        with pytest.raises((UnknownLimit, NotImplementedError)):
            limit_at(e, x, Approach(sympy.Integer(0)))
    right = limit_at((1 - sympy.besselj(0, x)) / x**2, x, Approach(sympy.Integer(0)))  # oo, by SymPy's leading terms
    assert right == Rational(1, 4)
    rising = 1 / (x * sympy.hyper((Rational(4, 3), Rational(13, 6)), (Rational(5, 2),), 1 - x))  # to a finite limit
    assert limit_at(rising, x, Approach(sympy.Integer(0))).is_finite


@pytest.mark.long
def test_when_a_constant_is_zero() -> None:
    z = Symbol("z")
    always = [
        sin(n * pi),
        sympy.jn(0, a) / sympy.jn(0, 1) - sin(a) / (a * sin(1)),
        sin(z) ** 2 + cos(z) ** 2 - 1,
        log(6) - log(2) - log(3),
        sympy.sympify("sqrt(2)+sqrt(3)-sqrt(5+2*sqrt(6))"),
    ]
    never = [
        exp(z),
        k + L,
        (-1) ** n,
        sympy.besselk(n, 1),
        sqrt(2) - Rational(141421356, 10**8),
        sympy.E - Rational(2718281, 10**6),
    ]
    never.append(sin(pi * n / 2) / sympy.gamma(-n / 2) + cos(pi * n / 2) / sympy.gamma((1 - n) / 2))
    sometimes = [z, a - 1, 1 - (-1) ** n, sin(k * L), cos(n * pi / 3)]
    for constants, outcome in ((always, Zero.ALWAYS), (never, Zero.NEVER), (sometimes, Zero.SOMETIMES)):
        assert [when_zero(constant) for constant in constants] == [outcome] * len(constants)
    assert not is_algebraic_zero(sqrt(2) - Rational(1414213562373095048801688724209, 10**30))


@parametrize("seed", range(40), ordinary=2, long=3)
def test_ranks(seed: int) -> None:
    """Rows made of a rank and of solutions, with numbers that aren't recognised at sight."""
    random = Random(seed)
    numbers = [
        sympy.Integer(0),
        sympy.Integer(1),
        sqrt(2) - 1,
        1 / (1 + sqrt(2)),
        pi,
        exp(1),
        sin(1) ** 2,
        1 - cos(1) ** 2,
    ]
    c1, c2, u, v = (random.choice(numbers) for _ in range(4))
    rank = random.choice([1, 2])
    factors = [random.choice([1, -2, sqrt(3), pi]) for _ in range(3)]
    rows = [Row(f * u, f * v, f * (u * c1 + v * c2)) for f in factors]
    if rank == 2:
        rows.append(Row(v + 1, -u - 2, (v + 1) * c1 - (u + 2) * c2))  # its minor with (u, v) is 0 for u = v = 0 only
    spoiled = random.random() < 0.3
    if spoiled:
        rows.append(Row(rows[0].u, rows[0].v, rows[0].r + 1))
    generic, others, _ = determine(rows, (C1, C2))
    assert not others
    if spoiled:
        assert generic.outcome is CaseOutcome.NONE
        return
    assert generic.outcome is CaseOutcome.SOLUTIONS
    assert all(size(row.rest(*generic.values).subs({C1: 3, C2: -2}), 30) < 1e-20 for row in rows)
    free = {C1, C2} & (generic.values[0].free_symbols | generic.values[1].free_symbols)
    assert len(free) == 2 - (rank if u or v else rank - 1)


def test_nothing_infinite_leaves() -> None:
    assert not is_finite(sympy.zoo * sin(x))
    assert not is_finite(sympy.nan + x)
    assert is_finite(sympy.Integral(exp(-(x**2)), (x, 0, oo)) + 1)


numbers = st.integers(-3, 3).map(sympy.Integer)


waves = st.tuples(
    numbers, st.integers(0, 3), numbers, st.sampled_from((sin, cos, sympy.sinh, sympy.cosh)), numbers, numbers
)


#: (b, c), with the roots 0, 1, -2, +-i, 1 +- 2i, +-sqrt(2) among those of the characteristic polynomials.
constants = st.sampled_from(
    [(0, 0), (0, 1), (-1, 0), (2, 0), (4, 4), (1, -2), (-2, 5), (0, -2), (-2, 1), (0, 9), (1, 1)]
)


@pytest.mark.long
@generated(8)
@given(constants, st.lists(waves, min_size=1, max_size=3))
def test_random_right_hand_sides(equation: tuple[int, int], terms: list) -> None:
    """Substituted; the roots of the characteristic polynomial often are exponents on the right: resonance."""
    b, c = map(sympy.Integer, equation)
    right = sympy.Add(*(k * x**m * exp(r * x) * wave(w * x + d) for k, m, r, wave, w, d in terms))
    found = undetermined(b, c, right, x)
    assert found is not None
    left = found.diff(x, 2) + b * found.diff(x) + c * found - right
    values = sympy.lambdify(x, [left, right], "mpmath", cse=True)
    with mpmath.workdps(30):
        for point in (mpmath.mpf(3) / 7, -mpmath.mpf(5) / 4):
            rest, size = map(abs, values(point))
            assert rest < 1e-15 * (1 + size)


@pytest.mark.parametrize("right", [1 / x, exp(x**2), sympy.tan(x), sympy.log(x), sqrt(x), sin(x**2), sin(x) / cos(x)])
def test_other_right_hand_sides(right: sympy.Expr) -> None:
    assert undetermined(sympy.Integer(0), sympy.Integer(1), right, x) is None


@parametrize(
    ("integrand", "functions"),
    [
        (sympy.sec(x), {sympy.log}),
        (sympy.tan(x) ** 2 * sin(2 * x), {sympy.log}),
        (1 / (2 + sin(3 * x + 1)), {sympy.atan}),
        (1 / (1 + cos(x) ** 2), {sympy.atan}),
        (sin(2 * x) * sympy.tan(x), set()),
        (1 / (1 + sin(x)), set()),
        (1 / (1 + sympy.tan(x)), {sympy.log}),
        (sympy.sec(sympy.pi * x), {sympy.log}),
        (x**2 * sympy.log(x) ** 2, {sympy.log}),
        (exp(2 * x) / (1 + exp(x)), {sympy.log}),
        (exp(3 * x) * sin(exp(x)), set()),
        (exp(-x) * sqrt(x), {sympy.erf}),
        (1 / (exp(x) + exp(-x)), {sympy.atan}),
        (sin(x) / x, {sympy.Si}),
        (cos(2 * x + 1) / (x * (x + 1) ** 3), {sympy.Si, sympy.Ci}),
        (sin(x) ** 2 / x**2, {sympy.Si}),
        (sympy.log(x) * cos(sqrt(2) * x), {sympy.log, sympy.Si}),
        ((x**2 - 1) * sympy.log(x) / (x**2 + 1) ** 2, {sympy.log, sympy.atan}),
        (x * sympy.log(x) / sqrt(x**2 + 1), {sympy.log}),
        (x * sympy.atan(x), {sympy.atan}),
        (exp(-x) / (x + 1), {sympy.Ei}),
        (sympy.log(x) * exp(3 * x), {sympy.log, sympy.Ei}),
        ((x**2 + 1) * exp(x - 1 / x) / (x * (x**2 - 1)), {sympy.Ei}),
        ((1 + 1 / x**2) * exp(x) * exp(-1 / x), set()),
        (sympy.asin(x) / sqrt(1 - x**2), {sympy.asin}),
        (x * sympy.acos(x), {sympy.acos, sympy.asin}),
        (sympy.asinh(x) ** 2 / sqrt(x**2 + 1), {sympy.asinh}),
        (sqrt(4 - x**2), {sympy.asin}),
        (x / cos(x) ** 2, {sympy.log}),
        (x**2 * sin(2 * x**2 + x), {sympy.fresnels, sympy.fresnelc}),
        (cos(x) / sqrt(x), {sympy.fresnelc}),
        (x * exp(x**2 / 2) * sympy.erf(x), {sympy.erf}),
        (exp(2 * x) * sympy.Ei(-x), {sympy.Ei}),
        (exp(-x) * cos(x) / x, {sympy.Ei}),
        (cos(x) * exp(-(x**2)), {sympy.erf}),
        (sin(x) / (x**2 + 1), {sympy.Ei}),
        (sympy.log(x) / (x + 1), {sympy.log, sympy.polylog}),
        (sympy.log(x + 1) / x, {sympy.polylog}),
        (x**sympy.pi * exp(-(x**2)), {sympy.uppergamma}),
        (sin(x) * sympy.tan(2 * x), {sympy.log}),  # the angles x, 2 x and 2 x have the common one x
        ((1 + x**2) ** Rational(-3, 2), set()),
        (1 / sqrt(1 + x) ** 3, set()),
        (1 / (sqrt(x) * (1 + x)), {sympy.atan}),
        (sqrt(x**2 - 1), {sympy.log}),
        (x * sympy.asin(x / 2) ** 2, {sympy.asin}),
        (sympy.log(x + sqrt(1 + x**2)), {sympy.log}),
        (x / sympy.cosh(x) ** 2, {sympy.log}),
        (x * exp(x) * sin(exp(x)), {sympy.Ci}),
        (cos(x) * (2 - cos(2 * x)) ** Rational(-3, 2), set()),
        (sin(x) * sqrt(cos(x) + 2), set()),
        (sympy.log(1 + exp(-x)), {sympy.polylog}),
        (x / (1 + exp(x)), {sympy.log, sympy.polylog}),
        (exp(x) / sqrt(1 + exp(2 * x)), {sympy.asinh}),
        (sqrt(1 + exp(-x)), {sympy.log}),
        (sqrt(1 + x) * cos(x), {sympy.fresnels, sympy.fresnelc}),
        (sin(x**2) * cos(x), {sympy.fresnels, sympy.fresnelc}),
        (2 * exp(sympy.I * x) / ((exp(2 * sympy.I * x) + 4 * exp(sympy.I * x) + 1) * cos(x)), {sympy.log, sympy.atan}),
    ],
    ordinary=2,
    long=(1, 12, 23, 35, 46, 50),
)
def test_integrals_known_at_once(integrand: sympy.Expr, functions: set) -> None:
    found = antiderivative(integrand, x)
    assert found is not None
    assert {f.func for f in found.atoms(sympy.Function)} - {sin, cos, sympy.tan, exp} == functions
    for point in (Rational(3, 7), Rational(9, 8)):
        assert size((found.diff(x) - integrand).subs(x, point), 30) < 1e-20


@parametrize(
    "integrand", [sin(x) / (x**3 + sqrt(x)), exp(sin(x)), sympy.besselj(1, x), sqrt(1 + x**2) * cos(x)], ordinary=2
)
def test_other_integrals(integrand: sympy.Expr) -> None:
    assert antiderivative(integrand, x) is None


def test_an_integral_that_is_not_elementary_stays_beside_a_tangent() -> None:
    assert antiderivative(x * sympy.tan(x), x) == sympy.Integral(x * sin(x) / cos(x), x)
    q = antiderivative(x * sin(x) * sympy.tan(x), x) - sympy.Integral(x / cos(x), x)
    assert sympy.expand(q + x * sin(x) + cos(x)) == 0


@parametrize(
    "text",
    [
        "(1-x^2)*y'' - 2*x*y' + 3/4*y = exp(x)",  # Legendre, DLMF 14.2.3
        "y'' - 2*x*y' + (1 - 16/x^2)*y = 1/x",  # series at 0 with irrational exponents
        "y'' = (x^2/4 + 1)*y + 1",  # 1F1 and its value at 0
        "x*(1-x)*y'' + (1/2 - 3*x)*y' - 5/7*y = 1",
    ],
    ordinary=0,
    long=2,
)
def test_wronskians_of_special_functions(text: str) -> None:
    """No Wronskian is written out under an integral; that of the two solutions is the one of the equation."""
    found = dsolve(text).rhs
    basis = answer_to(text).basis
    direct = basis.y1 * basis.y2.diff(x) - basis.y1.diff(x) * basis.y2
    point = Rational(2, 7)
    assert size((direct / basis.wronskian).subs(x, point) - 1, 30) < 1e-20
    functions = (sympy.hyper, sympy.legendre)
    assert not basis.wronskian.has(*functions)
    assert all(len(i.function.atoms(*functions)) == 1 for i in found.atoms(sympy.Integral))


def test_an_integral_between_numbers_has_a_value() -> None:
    x = sympy.Symbol("x")
    exact = DefiniteIntegral(x**2, (x, 0, 1))
    assert abs(exact.evalf(30) - sympy.Rational(1, 3)) < 1e-29
    assert abs((1 + 2 * exact).evalf(30) - sympy.Rational(5, 3)) < 1e-29
    assert exact.doit() == sympy.Rational(1, 3)
    assert str(exact) == "Integral(x**2, (x, 0, 1))"
    assert pickle.loads(pickle.dumps(exact)) == exact


@pytest.mark.parametrize(
    "text",
    ["x*exp(2*x)*cos(3*x)", "(x-2)**5*(C1 + C2*log(x))/sqrt(x)", "x**w", "w**x*(x-1)*(x-2)", "besselj(w, x**2)*(x-1)"],
)
@pytest.mark.parametrize("point", [1, 2, Rational(3, 7)])
def test_values_and_slopes_are_those_of_the_derivative(text: str, point: Any) -> None:
    e, a = sympy.sympify(text), sympy.sympify(point)
    value, slope = values_at(e, x, a)
    assert sympy.simplify(value - e.subs(x, a)) == 0
    assert sympy.simplify(slope - e.diff(x).subs(x, a)) == 0


def test_values_at_a_jump_and_of_forms_without_a_value() -> None:
    step = sympy.Heaviside(x - 1) * exp(x) + x
    assert values_at(step, x, sympy.Integer(1)) == (1, 1)
    assert values_at(step, x, sympy.Integer(2)) == (2 + exp(2), 1 + exp(2))
    assert values_at(sin(x) / x, x, sympy.Integer(0)) == (1, 0)
    assert values_at(sympy.Integral(exp(w**2), (w, 1, x)), x, sympy.Integer(1)) == (0, sympy.E)
    assert finite_value(2 / x, x, sympy.Integer(0)) is None


def test_an_argument_of_a_function_as_the_variable() -> None:
    """The derivative of f(u) is f'(u) u'."""
    for f in (exp(sin(x)), exp(exp(x)) + sin(exp(x)), sin(log(x)) ** 2):
        assert sympy.simplify(antiderivative(f.diff(x), x).diff(x) - f.diff(x)) == 0


FACTORS = """
    x x^2 1/x exp(x) exp(-x) exp(2*x) sin(x) cos(3*x) log(x) log(x+2) sqrt(x) x^(1/3) 1/(x+1) atan(x) tan(x) sec(x) 1/(1+exp(x))
    exp(exp(x)) exp(sqrt(x)) sin(sqrt(x)) tan(sqrt(x)) atan(sqrt(x)) cos(log(x)) sin(exp(x)) 1/log(x) log(log(x)) atan(exp(x))
    log(cos(x)) log(1+exp(x)) exp(-x^2) exp(1/x) tan(log(x)) cot(x) atan(2*x+1) log(x)^2 log(sqrt(x)+1) exp(sin(x)) sqrt(1+x)
    asin(x/4) acos(x/5) asinh(x) erf(x) Ei(x) Si(x) sin(x^2) cos(x^2+x) 1/sqrt(9-x^2) sqrt(x^2+1) x^pi
""".replace("^", "**").split()


@parametrize("seed", range(80), ordinary=2, long=5)
def test_what_is_called_an_antiderivative_is_one(seed: int) -> None:
    """For sums of products of functions that were drawn by lot: the derivative at three points, in x alone; or None."""
    rng = random.Random(seed)
    integrand = sympy.Add(
        *(
            sympy.Mul(
                rng.choice([1, -1, 2]), *(sympy.sympify(f) for f in rng.sample(FACTORS, rng.choice([1, 2, 2, 3])))
            )
            for _ in range(rng.choice([1, 1, 2]))
        )
    )
    found = antiderivative(integrand, sympy.Symbol("x"))
    if found is not None:
        assert found.free_symbols <= {sympy.Symbol("x")}
        difference = found.diff(sympy.Symbol("x")) - integrand
        for point in ("1.37", "0.61", "2.9"):
            value, size = (complex(sympy.N(e.subs("x", sympy.Float(point, 30)), 20)) for e in (difference, integrand))
            assert abs(value) < 1e-9 * (1 + abs(size))


def test_partial_fractions_of_waves_leave_integrands_alone() -> None:
    """The waves in an integral that stays are not those beside it."""
    integral = sympy.Integral(exp(x) * sin(x) ** 2 / cos(x), x)
    forms = fractions_of_waves(integral * sin(x) ** 2 / cos(x) + exp(x), x)
    assert forms
    assert all(form.atoms(sympy.Integral) == {integral} for form in forms)


# --------------------------------------------------------------------------------------------- branches of the parts


def test_a_wave_has_no_limit_and_a_root_decides_the_sign_of_a_rate() -> None:
    v, p = sympy.symbols("v p", positive=True)
    assert limit_at(1 + sin(x), x, Approach(oo)) == OSCILLATING
    assert limit_at(exp(x * (v - sqrt(v**2 + 4 * p))), x, Approach(oo)) == 0


def test_steps_in_cases_and_in_steps() -> None:
    """Cases of two intervals; a step of a step; an impulse beside a step at the same point isn't split."""
    inside = sympy.Piecewise((0, sympy.Or(x < -1, x > 1)), (1, True))
    assert sympy.expand(steps.in_steps(inside, x) - sympy.Heaviside(x + 1) * (1 - sympy.Heaviside(x - 1))) == 0
    assert steps.heaviside_of(x * sympy.Heaviside(x) - 1, x) == sympy.Heaviside(x - 1)
    assert steps.split_at_jumps(sympy.DiracDelta(x - 1) * sympy.Heaviside(x - 1), x) is None
    twice, once = (steps.split_at_jumps(x**5 * sympy.DiracDelta(*u), x) for u in ((2 * x - 6, 2), (6 - 2 * x, 1)))
    assert twice is not None
    assert once is not None  # x^5, 5 x^4 and 20 x^3 at 3 are 243, 405 and 540
    assert twice.impulses == {3: {2: Rational(243, 8), 1: -Rational(810, 8), 0: Rational(540, 8)}}
    assert once.impulses == {3: {1: -Rational(243, 4), 0: Rational(405, 4)}}
    near = (sympy.DiracDelta(x - 2) + sympy.DiracDelta(x + 2)) / 4
    assert steps.in_steps(sympy.DiracDelta(x**2 - 4), x) == sympy.expand(near)


def test_constants_that_nothing_determines() -> None:
    """No condition on either; 1/gamma(a) and 1/gamma(a + 1/2) are never zero together."""
    assert determine([Row(*[sympy.S.Zero] * 3)], (C1, C2)).generic.values == (C1, C2)
    row = Row(1 / sympy.gamma(w), 1 / sympy.gamma(w + Rational(1, 2)), sympy.S.Zero)
    found = determine([row], (C1, C2))
    assert sympy.simplify(row.rest(*found.generic.values)) == 0
    assert not found.particular


def test_parts_without_a_value_or_a_form() -> None:
    assert undetermined(sympy.I, 2, sin(x), x) is None  # the factor i + i in two meanings has the norm 0
    poly = sympy.Poly(C1**3 - 2, C1)
    assert finite_value(sympy.RootSum(poly, sympy.Lambda(C1, log(x) / C1), auto=False), x, sympy.S.Zero) is None
    pair = exp(-x + x * sqrt(w**2 + 1)), exp(-x - x * sqrt(w**2 + 1))
    assert with_waves(*pair) == pair  # the root is real


def test_complex_values_and_floats_beside_orders() -> None:
    y = sympy.Function("y")
    assert read_conditions({y(0): 1.5 + 2j}, y(x))[0].value == Rational(3, 2) + 2 * sympy.I
    assert str(with_floats(sympy.besselj(Rational(1, 3), x / 2))) == "besselj(1/3, 0.5*x)"


def test_a_polynomial_of_algebraic_solutions_is_shown() -> None:
    assert RiccatiSolutions((), None, w**2 - x, True, None)._repr_latex_() == "$w^{2} - x = 0$"  # type: ignore[arg-type]


def test_numbers_with_logarithms_are_zero() -> None:
    assert when_zero(log(6) - log(2) - log(3)) is Zero.ALWAYS


def test_two_terms_that_are_zero_by_turns_have_no_zero_together() -> None:
    """For even n the second one is 1 up to a factor, for odd n the first one."""
    assert when_zero(sin(pi * n / 2) / sympy.gamma(-n / 2) + cos(pi * n / 2) / sympy.gamma((1 - n) / 2)) is Zero.NEVER


def test_integrals_of_powers_have_short_constants() -> None:
    """(2 a + b) cancels in the factor that is read off at a point."""
    found = antiderivative(x * (w * x + C1) ** Rational(3, 2), x)
    assert sympy.denom(sympy.together(found)).subs(w, 1).is_number


def test_fractions_of_waves_of_the_double_angle() -> None:
    assert Rational(1, 2) + 1 / (2 * cos(2 * x)) in fractions_of_waves(sin(x) ** 2 / cos(2 * x) + 1, x)


def test_the_angle_of_a_falling_tangent_is_continuous() -> None:
    """atan(1 - 2 tan(x))."""
    assert not _continuous_angle(1 - 2 * w, x, w).has(w)


def test_values_of_polynomials_of_a_symbolic_degree_and_of_integrals() -> None:
    """H_n' = 2 x H_n - H_(n+1), also for n = 0; an integral from the point on is 0 there, beside a form 0/0."""
    degree = Symbol("n", integer=True, nonnegative=True)
    value, slope = values_at(sympy.hermite(degree, x), x, sympy.S.One)
    assert [(value.subs(degree, j), slope.subs(degree, j)) for j in (1, 2)] == [(2, 2), (2, 8)]
    assert slope.subs(degree, 0) == 0
    integral = sympy.Integral(exp(C1**2), (C1, 0, x))
    assert value_or_limit(integral + sin(x) / x, x, sympy.S.Zero) == 1


def test_limits_in_another_direction_and_of_a_function_without_values() -> None:
    """2F0(a, b; i/x) tends to 0 as x^a; nothing is known of g(x)."""
    assert limit_at(sympy.hyper((Rational(1, 3), Rational(1, 2)), (), sympy.I / x), x, Approach(sympy.S.Zero)) == 0
    with pytest.raises(UnknownLimit):
        limit_at(sympy.Function("g")(x) + x, x, Approach(oo))


def test_a_logarithm_of_an_imaginary_letter_has_no_real_values() -> None:
    assert not needed_for([x * log(Symbol("c", imaginary=True))], x).has_real_parts


def test_waves_of_other_forms_are_left() -> None:
    assert not [*wave_zeros(sin(x) / cos(x), x, 0, 10), *wave_zeros(sin(w * x), x, 0, 10)]
    assert _at_tangent(log(sqrt(w) + 1), x, w) == log(sqrt(sin(x) / cos(x)) + 1)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("w' = w + w^3", "Note: -w(x) is a solution, too."),
        ("w' = 2*w", "w(x) = C1*exp(2*x)"),
    ],
)
def test_steps_for_powers_and_without_a_right_hand_side(text: str, said: str) -> None:
    steps_there = kovacic.general_solution.explain(text)
    assert said in steps_there
    assert ("w^m makes it linear" in steps_there) == ("^" in text)
    assert "integrating factor" not in steps_there or "int p/h" not in steps_there


def test_a_parameter_in_the_conditions_is_no_eigenvalue() -> None:
    assert answer_to("y'' + lambda*y = 0, y(0)=0, y(-L)=0").eq.rhs.has(Symbol("L"))
    assert answer_to("y'' + lambda*y = 0, y(0)=0, y(lambda)=0").eq.rhs == 0


def test_an_integral_that_holds_on_one_side_only_is_none() -> None:
    """sqrt((x - 1)^2) is 1 - x for x < 1."""
    assert antiderivative(sqrt(x**2 - 2 * x + 1), x) is None


def test_coefficients_in_a_sum_are_short() -> None:
    """The amplitude of a driven oscillator, with m = 1, beside another term."""
    amplitude = C1 * cos(w * x) / (C2**2 * w**2 + k**2 - 2 * k * w**2 + w**4)
    assert in_book_form(amplitude + x, x) == C1 * cos(w * x) / (C2**2 * w**2 + (w**2 - k) ** 2) + x


def test_a_double_impulse_beside_damping_moves_the_slope() -> None:
    """y jumps by 1, and y' by -1."""
    y = sympy.Function("y")
    found = dsolve(y(x).diff(x, 2) + y(x).diff(x) - sympy.DiracDelta(x - 1, 1), y(x)).rhs
    assert sympy.expand(found.coeff(sympy.Heaviside(x - 1)) - exp(1 - x)) == 0


def test_special_functions_are_real_at_the_point_of_the_values() -> None:
    """Beyond the singular point 1; about 0 they would be complex there."""
    asked = read_question("x*(1-x)*y'' + (1/3-x)*y' + y/5 = 0", None, "y(2)=1, y'(2)=0", None, DEFAULT_LIMITS)
    assert _real_places(asked) == (2,)


def test_quotients_in_lowest_terms() -> None:
    """Over one denominator, or multiplied out; a sum of products stays."""
    forms = [
        (x * (x + 1) + 3 * x, x**2 + 4 * x),
        (1 / x + 1 / w, (x + w) / (x * w)),
        (x + 3 * w * x**2, x + 3 * w * x**2),
    ]
    for value, expected in forms:
        assert as_quotient(value) == expected


def test_limits_of_sums_by_their_terms() -> None:
    """Known for one unbounded term or for comparable ones; not for such as cancel."""
    assert [_term_by_term(e, k) for e in (1 / k + 3, 2 + 5 * k, 1 / k - k**-2)] == [oo, 2, None]
    assert _term_by_term(3 / k + log(k), k) == oo


@pytest.mark.parametrize(("order", "first", "second"), [(2, Rational(1, 15), -3), (3, Rational(1, 105), -15)])
def test_spherical_bessel_functions_begin_as_in_the_handbook(order: int, first: Any, second: Any) -> None:
    """j_n = z^n/(2 n + 1)!! + ..., y_n = -(2 n - 1)!!/z^(n + 1) + ... [DLMF 10.52.1, 10.52.2]."""
    j, y = (_LEADING[kind][sympy.S.Zero](sympy.Integer(order), k) for kind in (sympy.jn, sympy.yn))
    assert sympy.limit(sympy.expand(j / k**order), k, 0) == first
    assert sympy.limit(sympy.expand(y * k ** (order + 1)), k, 0) == second


def test_relations_that_hold_in_an_interval() -> None:
    """x + sqrt(2) is positive between 2 and 5, x - pi isn't everywhere."""
    needs = [Need(u, POSITIVE) for u in (x - 2, 5 - x, x + sqrt(2), x - pi)]
    assert _in_one_interval(needs, x) == (x - 2 > 0, 5 - x > 0, x - pi > 0)


def test_functions_of_a_tangent_in_single_waves() -> None:
    whole = 1 / (w**2 + 1) + 3 * log(w**2 + 1) + sympy.atan(w)
    assert _at_tangent(whole, 2 * x, w) == cos(2 * x) ** 2 - 6 * log(cos(2 * x)) + 2 * x
    assert _at_tangent(w / (w**2 + 1) ** 2, x / 2, w) == sin(x / 2) * cos(x / 2) ** 3

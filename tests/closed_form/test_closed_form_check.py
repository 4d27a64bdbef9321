"""What checks closed forms refuses: each condition alone violated; and real pairs, built from their phases."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest
import sympy
import transform
from build import (
    QQ,
    AlgebraicField,
    Atoms,
    Poly,
    RatFunc,
    Triangular,
    decompose,
    is_exact_solution,
    parametrize,
    residual,
)
from flint import acb
from sympy.abc import x

import kovacic
from kovacic.algebra.ratfunc import logarithmic_derivative
from kovacic.closed_form.check import is_numerical_solution, value_at
from kovacic.closed_form.curve import CurveIntegral, integrate_on_curve
from kovacic.closed_form.primitive import ExponentialPrimitive, RationalPrimitive
from kovacic.closed_form.product import product
from kovacic.closed_form.real_pair import is_real_pair
from kovacic.closed_form.structure import (
    Conjugate,
    Covariants,
    Diagonal,
    OnCurve,
    build,
    curve_of_pair,
)
from kovacic.special.choice import chosen_form

X = RatFunc(QQ.poly([0, 1]))
ZERO, ONE = RatFunc(QQ.poly([])), QQ.poly([1])


def solve(S: RatFunc) -> kovacic.Solution:
    return kovacic.solve((S.num.coefficients(), S.den.coefficients()))  # type: ignore[attr-defined]


def structure_of(answer: kovacic.Solution, kind: type) -> Any:
    assert answer.closed_form is not None
    structure = answer.closed_form.structure
    assert isinstance(structure, kind)
    assert is_exact_solution(structure, answer.S, answer.gauge)
    return structure


# ------------------------------------------------------------------------------- conditions, violated one at a time


def test_two_equal_solutions_are_no_pair() -> None:
    form = structure_of(solve(1 + ZERO), Diagonal)
    assert not is_exact_solution(Diagonal(form.first, form.first), ONE + ZERO, ZERO)


@pytest.mark.parametrize("position", ["first", "second"])
def test_each_of_two_products_must_solve_the_equation(position: str) -> None:
    form = structure_of(solve(1 + ZERO), Diagonal)
    assert not is_exact_solution(replace(form, **{position: product(ZERO + 2)}), ONE + ZERO, ZERO)


def conjugate(u: RatFunc, v: RatFunc, delta: int) -> Conjugate:
    """omega = u +- sqrt(delta) v."""
    return Conjugate(product(u), QQ.poly([delta]), decompose(v), ONE, ONE * 0)


@pytest.mark.parametrize(
    ("u", "v", "delta", "S", "right"),
    [
        (ZERO, ONE + ZERO, 2, 2 + ZERO, True),
        (-1 / (2 * X), X, 2, 3 / (4 * X**2) + 2 * X**2, True),
        (ZERO, X, 2, 2 * X**2, False),  # u' + u^2 + delta v^2 = S, but v' + 2 u v isn't 0
        (ZERO, ONE + ZERO, 2, 3 + ZERO, False),  # v' + 2 u v = 0, but u' + u^2 + delta v^2 isn't S
        (1 / X, ZERO, 2, ZERO, False),  # v = 0: one solution twice
    ],
)
def test_conjugate_solutions_must_satisfy_both_equations(
    u: RatFunc, v: RatFunc, delta: int, S: RatFunc, right: bool
) -> None:
    assert is_exact_solution(conjugate(u, v, delta), S, ZERO) is right


@pytest.mark.parametrize("gauge", [ZERO, 1 / X])
def test_a_second_solution_needs_the_first_one_and_its_own_integral(gauge: RatFunc) -> None:
    S = 2 / X**2
    bare = product(2 / X)  # x^2; the second solution is x^2 int x^-4
    right = Triangular(product(2 / X + gauge), bare, RationalPrimitive(decompose(1 / X**4)))
    assert is_exact_solution(right, S, gauge)
    assert is_exact_solution(replace(right, primitive=RationalPrimitive(decompose(-7 / X**4))), S, gauge)
    for changes in (
        {"first": product(3 / X + gauge)},
        {"first": product(2 / X + gauge), "bare": product(1 / X)},
        {"primitive": RationalPrimitive(decompose(1 / X**3))},
        {"primitive": RationalPrimitive(decompose(ZERO))},
    ):
        assert not is_exact_solution(replace(right, **changes), S, gauge), changes  # type: ignore[arg-type]
    assert not is_exact_solution(right, S + 1, gauge)
    assert not is_exact_solution(right, S, gauge + 1)


def test_an_integral_on_a_curve_needs_all_of_its_parts() -> None:
    """y1^-2 = A'/sqrt(A^2 - 3), on a curve of genus 2: the integral is log(A + sqrt(A^2 - 3))."""
    A = X**3 + X + 1
    g = A * A - 3
    answer = solve(transform.from_omega(-(A.derivative().derivative() / A.derivative() - A * A.derivative() / g) / 2))
    form = structure_of(answer, Triangular)
    assert isinstance(form.primitive, CurveIntegral)
    integral = form.primitive
    first, *others = integral.units
    for changed in (
        replace(integral, units=(replace(first, factor=first.factor * 2), *others)),
        replace(integral, units=(replace(first, A=first.A + 1), *others)),
        replace(integral, units=(first, first, *others)),
        replace(integral, rest=integral.rest + 1),
    ):
        assert not is_exact_solution(replace(form, primitive=changed), answer.S, ZERO)


def test_the_other_integrals_are_compared_with_y1() -> None:
    omega = Fraction(21, 2) / (X + 15) + Fraction(1, 3) / X
    large = structure_of(solve(transform.from_omega(omega)), Triangular)
    assert isinstance(large.primitive, ExponentialPrimitive)
    S = transform.from_omega(omega)
    assert not is_exact_solution(replace(large, primitive=RationalPrimitive(decompose(ONE + ZERO))), S, ZERO)


def test_solutions_on_a_curve_must_satisfy_both_equations() -> None:
    """u +- kappa r/sqrt(g): each of the two equations alone doesn't suffice, nor does a wrong unit."""
    A = X**3 + X + 1
    answer = solve(transform.from_squared_product((A * A - 3) / A.derivative() ** 2, Fraction(4, 25)))
    form = structure_of(answer, OnCurve)
    for changes in (
        {"kappa_squared": form.kappa_squared * 2},
        {"common": product(form.common.logarithmic_derivative + 1 / X)},
        {"integral": replace(form.integral, units=(replace(form.integral.units[0], factor=Fraction(1)),))},
    ):
        assert not is_exact_solution(replace(form, **changes), answer.S, ZERO), changes
    assert not is_exact_solution(form, answer.S + 1, ZERO)
    # u' + u^2 + kappa^2 r^2/g is S for another u, with (r/sqrt g)' + 2 u r/sqrt(g) other than 0.
    r, g = form.integral.integrand, RatFunc(form.integral.g)
    u = form.common.logarithmic_derivative + 1
    S = u.derivative() + u * u + r * r / g * form.kappa_squared
    assert not is_exact_solution(replace(form, common=product(u)), S, ZERO)


def test_residuals_tell_solutions_from_other_functions() -> None:
    """Each of the three terms of y'' - 2 g y' + (g^2 - g' - S) y counts, with and without a gauge factor."""
    point = acb(-1.25, -0.75)
    for S, gauge, y in (
        (ONE + ZERO, ZERO, sympy.exp(x)),
        (2 / X**2, ZERO, x**2),
        (ONE + ZERO, 1 / X, x * sympy.exp(x)),
        (ONE + ZERO, X, sympy.exp(x**2 / 2 + x)),
    ):
        assert residual(y, x, S, gauge, point) < 1e-10
        assert is_numerical_solution(y, x, S, gauge)
        for wrong in (S + 1, S * 2, S + Fraction(1, 10**40)):
            assert not is_numerical_solution(y, x, wrong, gauge)
        for wrong in (gauge + 1, gauge + 1 / X**2):
            assert residual(y, x, S, wrong, point) > 1e-3
    assert not is_numerical_solution(sympy.exp(x) + sympy.Rational(1, 10**45), x, ONE + ZERO, ZERO)
    assert is_numerical_solution(sympy.exp(x) + sympy.Rational(1, 10**55), x, ONE + ZERO, ZERO)
    assert complex(value_at((X**2 + 1) / (X - 3), acb(1, 2))) == pytest.approx((-2 + 4j) / (-2 + 2j))


# ------------------------------------------------------------------------------------------------ real pairs

I_CENTRED, SHIFTED = X**2 + 1, X**2 + X + 5


@parametrize("k", range(1, 9), ordinary=2)
@parametrize(("p", "discriminant"), [(I_CENTRED, 4), (SHIFTED, 19), (4 * X**2 - 4 * X + 5, 64)], ids=str, ordinary=1)
def test_a_pair_that_turns_by_half_turns(p: RatFunc, discriminant: int, k: int) -> None:
    """y1 y2 = p and the exponent difference k/2 at both roots: y+- = sqrt(p) exp(+-i (k/2) phi), phi the argument."""
    check_pair(p, Fraction(discriminant * k * k, 4), turned=True)


@parametrize(
    ("constant", "slope"), [(Fraction(1, 2), 1), (Fraction(1, 2), Fraction(1, 2)), (Fraction(5, 4), 1)], ordinary=1
)
def test_residues_at_the_roots_of_a_cubic_turn_nothing(constant: Fraction, slope: Fraction) -> None:
    """y = exp(i int r)/sqrt(r), r the sum of slope a/(x - a) over the roots of p = x^3 + x + constant: -1 is a square times
    the number p_1^2 - 4 p_0 that would be the discriminant of a quadratic p, and the residues would be half integers."""
    p = QQ.poly([constant, 1, 0, 1])
    r = RatFunc(QQ.poly([0, slope]) * p.derivative() % p, p)
    form = solve(transform.from_squared_product(1 / (r * r), -4)).closed_form
    assert form is not None
    assert form.checked == "exact"
    (angle,) = form.y1.find(sympy.RootSum)
    expected = sum(root * sympy.log(x - root) for root in sympy.Poly(p.to_sympy(x), x).nroots())
    point = {x: 3}
    ratio = sympy.N(angle.doit().subs(point)) / sympy.N(expected.subs(point))
    assert abs(ratio - 1) < 1e-9


@parametrize("shift", [0, 1, Fraction(-3, 2)], ordinary=1)
@parametrize("w", [3, 6, 9, 12, 18, 30], ordinary=1)
def test_two_factors_that_turn_in_opposite_directions(w: int, shift: Fraction) -> None:
    """F = (x^2 + 1)(x^2 + 4): exponent differences w/6 at i and -w/12 at 2i."""
    F = ((X + shift) ** 2 + 1) * ((X + shift) ** 2 + 4)
    check_pair(F, Fraction(w * w), turned=w % 6 == 0)


@parametrize("k", [1, 2, 3, 4], ordinary=2)
@parametrize(
    "F",
    [X * (X**2 + X + 5), (X**2 + 1) ** 2, (X**2 + 1) / (X - 3), (X**2 + 1) * (X**2 + 3), 1 / (X**2 + 2 * X + 3)],
    ordinary=1,
    long=2,
    ids=str,
)  # fmt: skip
def test_pairs_with_other_phases(F: RatFunc, k: int) -> None:
    check_pair(F, Fraction(k * k, 4))
    check_pair(F, 2 * k)


def check_pair(F: RatFunc, minus_w_squared: Fraction | int, turned: bool = False) -> None:
    """Both are real, solve the equation and are independent; without an angle where the pair turns by half turns."""
    answer = solve(transform.from_product(F, -minus_w_squared))
    form = answer.closed_form
    assert form is not None
    if isinstance(form.structure, Diagonal | Triangular):
        return  # a square root that is rational after all
    assert isinstance(form.structure, Conjugate)
    assert form.checked == "exact"
    assert not form.y1.has(sympy.I)
    assert not form.y2.has(sympy.I)
    assert not turned or not (form.y1 + form.y2).has(sympy.cos, sympy.sin, sympy.atan)
    wronskians = []
    for point in (4.75, 5.3):
        values = [complex(f.subs(x, point).evalf(30)) for y in (form.y1, form.y2) for f in (y, y.diff(x))]
        assert all(value.imag == 0 for value in values)
        a, b, c, d = (value.real for value in values)
        wronskians.append(a * d - b * c)
    assert wronskians[0] == pytest.approx(wronskians[1])
    assert abs(wronskians[0]) > 1e-6


def over(field: AlgebraicField, delta: int) -> Conjugate:
    t: Poly = field.poly([0, 1])
    return Conjugate(
        product(RatFunc(t) * 0), field.poly([delta]), decompose(RatFunc(t)), field.poly([1]), field.poly([])
    )


def test_what_a_real_pair_is() -> None:
    """delta < 0 over a real field."""
    real, imaginary = (AlgebraicField(QQ, QQ.poly([c, 0, 1]), "c") for c in (-2, 1))
    assert is_real_pair(conjugate(ZERO, ONE + ZERO, -1), Atoms(x))
    assert not is_real_pair(conjugate(ZERO, ONE + ZERO, 2), Atoms(x))
    assert is_real_pair(over(real, -3), Atoms(x))
    assert not is_real_pair(over(real, 3), Atoms(x))
    assert not is_real_pair(over(imaginary, -3), Atoms(x))


@parametrize("text", ["x^2 + sqrt(2)", "x^2 + sqrt(2)*x + 2", "x^2 + 2*x + 1 + sqrt(3)", "x^4 + sqrt(2)"], ordinary=2)
def test_pairs_with_irrational_coefficients(text: str) -> None:
    """y1 y2 = F with w^2 = -1 over Q(sqrt d): the phase stays an angle."""
    f = sympy.sympify(text.replace("^", "**"))
    S = (2 * f * f.diff(x, 2) - f.diff(x) ** 2 - 1) / (4 * f**2)
    form = kovacic.solve(sympy.together(S)).closed_form
    assert form is not None
    assert form.checked == "exact"
    assert not form.y1.has(sympy.I)


# ------------------------------------------------------------------------------------- whole answers


def test_without_a_solution_there_is_nothing_to_write() -> None:
    airy = kovacic.solve("x")
    with pytest.raises(ValueError, match="no Liouvillian solution"):
        chosen_form(airy.S, airy.decision, airy.gauge)


def test_the_gauge_can_be_given() -> None:
    answer = kovacic.solve("-1")
    gauge = RatFunc(answer.S.field.poly([-1]), answer.S.field.poly([0, 2]))
    assert [str(y) for y in chosen_form(answer.S, answer.decision, gauge)] == ["cos(x)/sqrt(x)", "sin(x)/sqrt(x)"]


def test_wrong_answers_do_not_pass_the_checks() -> None:
    answer, other = kovacic.solve("2/x^2 - 1"), kovacic.solve("6/x^2 - 1")
    zero = answer.gauge
    form, wrong = answer.closed_form, other.closed_form
    assert form is not None
    assert wrong is not None
    assert is_exact_solution(form.structure, answer.S, zero)
    assert not is_exact_solution(wrong.structure, answer.S, zero)
    assert is_numerical_solution(form.y1, x, answer.S, zero)
    assert not is_numerical_solution(wrong.y1, x, answer.S, zero)
    assert not is_numerical_solution(form.y1 + sympy.Rational(1, 10**40), x, answer.S, zero)


@pytest.mark.parametrize(
    ("S", "kind"),
    [
        ("1", Diagonal),
        ("-1", Conjugate),
        ("x^2 + 3", Triangular),
        ("1/x - 3/(16*x^2)", OnCurve),
        ("(-32*x**2 + 27*x - 27)/(144*x**4 - 288*x**3 + 144*x**2)", Covariants),
    ],
)
def test_structure_needs_no_sympy(S: str, kind: type) -> None:
    answer = kovacic.solve(S)
    assert isinstance(build(answer.S, answer.decision, answer.gauge), kind)


@pytest.mark.parametrize(
    "equation", ["(-32*x^2+32*x+8613)/(144*x^2*(x-1)^2)", "x*(1-x)*y'' + (1/2 - 3*x)*y' - 5/7*y"], ids=["2", "1, odd"]
)
def test_gathered_zeros_are_the_spread_ones(equation: str) -> None:
    """The short form and the one with a square root and logarithms at the zeros have the same logarithmic derivatives."""
    answer = kovacic.solve(equation)
    form = build(answer.S, answer.decision, answer.gauge)
    assert isinstance(form, OnCurve)
    assert form.zeros is not None
    assert answer.decision.semi_invariant is not None
    g, r, kappa_squared = curve_of_pair(answer.S, answer.decision.semi_invariant)
    norm = logarithmic_derivative(form.zeros.norm(g))
    spread = OnCurve(product(form.common.logarithmic_derivative + norm / 2), kappa_squared, integrate_on_curve(r, g))
    for curve in (form, spread):
        assert is_exact_solution(curve, answer.S, answer.gauge)
    changed = replace(form, zeros=replace(form.zeros, A=form.zeros.A * 2))
    assert not is_exact_solution(changed, answer.S, answer.gauge)

"""The derived equations of rolling bodies: against the printed ones, symbolically, and against each other."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sp

from kovacic.ball import Ball, Body, Profile, U, X
from kovacic.ball.ball import exact
from kovacic.ball.field import Ring, base_part
from kovacic.ball.theorems import printed_forms, symbolic_ball
from kovacic.errors import InputError, LimitExceeded

m, R, a, A1, A3, R1 = sp.symbols("m R a A1 A3 R1")
sine, cosine = sp.sin(U), sp.cos(U)
DELTA = A1 * A3 + A1 * m * R**2 * sine**2 + A3 * m * (R * cosine + a) ** 2

PRINTED_7 = {
    "a1": -m * R**2 * ((A3 - A1) * R * cosine + A3 * a) * sine / (DELTA * R1),
    "a2": (R1 + R) * ((A3 + m * R**2) * (A3 - A1) - A3 * m * a**2) * sine / (DELTA * R1),
    "b1": m * R**3 * A1 * sine / (DELTA * R1),
    "b2": m * R * (R1 + R) * ((A3 - A1) * R * cosine + A3 * a) * sine / (DELTA * R1),
}
PRINTED_11 = {
    "d1": -(
        2 * m * R**2 * (A3 - A1) * sine**2 * cosine
        + (3 - cosine**2) * m * R * a * A3
        + A3 * (A1 + m * R**2 + m * a**2) * cosine
    )
    / (DELTA * sine),
    "d2": m * R**2 * (R1**2 - R**2) * (A3 - A1) * sine**2 / (DELTA * R1**2),
}


def is_zero(expression: sp.Expr) -> bool:
    """Exactly: as a polynomial in cos u and sin u modulo sin^2 + cos^2 = 1, over the polynomials in all parameters."""
    c, s = sp.symbols("c_ s_")
    numerator = sp.fraction(sp.together(expression.subs({sine: s, cosine: c})))[0]
    names = sorted(numerator.free_symbols - {s}, key=str)
    return sp.Poly(numerator, s, *names).rem(sp.Poly(s**2 + c**2 - 1, s, *names)).is_zero


@pytest.mark.parametrize("name", sorted(PRINTED_7))
def test_linear_system_of_the_ball_is_the_printed_one(name):
    assert is_zero(getattr(symbolic_ball().linear_system(), name) - PRINTED_7[name])


@pytest.mark.parametrize("name", sorted(PRINTED_11))
def test_equation_11_of_the_ball_is_the_printed_one(name):
    assert is_zero(getattr(symbolic_ball().second_order(), name) - PRINTED_11[name])


def test_is_zero_can_say_no():
    assert not is_zero(PRINTED_7["a1"] * (1 + sine**2) - PRINTED_7["a1"])


def test_equations_12_and_13_are_the_printed_ones():
    proof = printed_forms()
    assert proof, proof.text()


def test_kinetic_energy_of_the_ball():
    q = symbolic_ball().body.quantities()
    rho = R / R1
    expected = {
        "K11": (1 + rho) ** 2 * (A1 + m * (R**2 + a**2 + 2 * R * a * cosine)),
        "K22": (1 + rho) ** 2 * sine**2 * (m * (R + a * cosine) ** 2 + A1 * cosine**2 + A3 * sine**2),
        "K23": (1 + rho) * sine**2 * (m * a * (R + a * cosine) - (A3 - A1) * cosine),
        "K33": m * a**2 * sine**2 + A1 * sine**2 + A3 * cosine**2,
    }
    for name, value in expected.items():
        assert is_zero(q.meridian.in_u(getattr(q, name)) - value), name


def test_plane_is_the_limit_of_large_spheres():
    m_, R_, a_, A1_, A3_ = "2", "1", "1/5", "1/3", "1/4"
    ball = Ball(m=m_, R=R_, a=a_, A1=A1_, A3=A3_)
    plane = ball.on_plane().linear_system()
    general = ball.on_sphere(R1).linear_system()
    for name in ("a1", "a2", "b1", "b2"):
        assert is_zero(sp.limit(getattr(general, name), R1, sp.oo) - getattr(plane, name))
    with pytest.raises(InputError, match="first order"):
        plane.second_order()
    assert plane.second_order("n").rational_form().first


def test_rolling_inside_is_a_negative_radius():
    ball = Ball(m="2", R="1", a="1/5", A1="1/3", A3="1/4")
    inside, general = ball.on_sphere(-3).linear_system(), ball.on_sphere(R1).linear_system()
    for name in ("a1", "a2", "b1", "b2"):
        assert is_zero(getattr(general, name).subs(R1, -3) - getattr(inside, name))


def test_thin_disk_on_the_plane_is_legendre():
    """Appell and Korteweg: omega_3 is a Legendre function of cos u, nu(nu + 1) = m R^2 A3/(A1 (A3 + m R^2))... negative."""
    disk = Body(Profile(R, sp.Integer(0), edge=True), m, A1, A3, sp.oo)
    equation = disk.linear_system().second_order().rational_form()
    constant = A3 * m * R**2 / (A1 * (A3 + m * R**2))
    assert sp.cancel(equation.d1 + 2 * X / (1 - X**2)) == 0
    assert sp.cancel(equation.d2 + constant / (1 - X**2)) == 0


def test_disk_is_the_limit_of_the_torus():
    r, at = sp.Rational(1, 10**12), sp.Rational(7, 10)
    rest = (sp.Integer(2), sp.Integer(5), sp.Integer(7), sp.Integer(4))
    torus = Body(Profile(3 + r * sine, r * cosine), *rest).linear_system()
    disk = Body(Profile(sp.Integer(3), sp.Integer(0), edge=True), *rest).linear_system()
    for name in ("a1", "a2", "b1", "b2"):
        assert abs(sp.N(getattr(torus, name).subs(U, at) - getattr(disk, name).subs(U, at), 30)) < 1e-10


def test_sphere_as_an_ellipsoid_gives_the_ball():
    """The square root of E that is there for the ellipsoid is continuous where the half axes agree."""
    rest = (sp.Integer(2), sp.Integer(5), sp.Integer(7), sp.Integer(5))
    at, near = sp.Rational(7, 10), 3 + sp.Rational(1, 10**14)
    ball = Body(Profile(3 * sine, 3 * cosine), *rest).linear_system()
    ellipsoid = Body(Profile(3 * sine, near * cosine), *rest).linear_system()
    for name in ("a1", "a2", "b1", "b2"):
        assert abs(sp.N(getattr(ellipsoid, name).subs(U, at) - getattr(ball, name).subs(U, at), 40)) < 1e-12


def test_reparametrised_meridian_gives_the_same_equation():
    """The paraboloid as f = u and as f = 2 p tan u: the same rational equation after the substitution."""
    p, g0 = sp.Rational(1, 3), sp.Rational(1, 2)
    plain = Body(Profile(U, g0 - U**2 / (4 * p)), sp.Integer(2), sp.Integer(3), sp.Integer(4), sp.oo)
    angle = Body(
        Profile(2 * p * sp.tan(U), g0 - p * sp.tan(U) ** 2), sp.Integer(2), sp.Integer(3), sp.Integer(4), sp.oo
    )
    one, two = plain.linear_system(), angle.linear_system()
    at = sp.Rational(2, 5)
    f = 2 * p * sp.tan(at)
    speed = 2 * p / sp.cos(at) ** 2
    for name in ("a1", "a2", "b1", "b2"):
        left = sp.N(getattr(one, name).subs(U, f) * speed)
        assert abs(left - sp.N(getattr(two, name).subs(U, at))) < 1e-12


def test_half_angle_where_cos_u_does_not_suffice():
    torus = Body(Profile(2 + sine, cosine), sp.Integer(1), sp.Integer(3), sp.Integer(4), sp.oo)
    second = torus.linear_system().second_order()
    with pytest.raises(InputError, match="half_angle"):
        second.rational_form()
    form = second.rational_form(half_angle=True)
    at = sp.Rational(9, 10)
    t = sp.tan(at / 2)
    rate = (1 + t**2) / 2
    # z_uu + d1 z_u + d2 z with z_u = z_t t', z_uu = z_tt t'^2 + z_t t t'
    assert abs(sp.N(form.d1.subs(X, t) * rate - second.d1.subs(U, at) - t)) < 1e-12
    assert abs(sp.N(form.d2.subs(X, t) * rate**2 - second.d2.subs(U, at))) < 1e-12


def test_equations_print():
    sphere = symbolic_ball()
    assert sphere.equation(13).latex().startswith("y'' = ")
    assert r"\omega_{3}''" in sphere.equation(11).latex()
    assert r"\begin{aligned}" in sphere.equation(7).latex()
    with pytest.raises(InputError, match="7, 11, 12 and 13"):
        sphere.equation(8)


def test_profiles_outside_the_field_are_refused():
    ball = (sp.Integer(1), sp.Integer(1), sp.Integer(1), sp.oo)
    with pytest.raises(InputError, match="isn't rational in cos u"):
        Body(Profile(sp.sin(U) * U, cosine), *ball).linear_system()
    with pytest.raises(InputError, match="circle"):
        Body(Profile(sine, sp.Integer(0), edge=True), *ball).linear_system()
    with pytest.raises(InputError, match="point"):
        Body(Profile(sp.Integer(1), sp.Integer(1)), *ball).linear_system()
    with pytest.raises(InputError, match="variables of the equations"):
        Body(Profile(X * sine, X * cosine), *ball).linear_system()
    with pytest.raises(InputError, match="along a curve"):
        Body(Profile(sine, cosine), *ball[:3], sp.Integer(-1)).linear_system()
    with pytest.raises(InputError, match="isn't a polynomial"):
        Ring(("x",)).element(sp.sqrt(X))


def test_field_arithmetic():
    ring = Ring(("p", "x"))
    x, p = ring.element(X), ring.element(sp.Symbol("p"))
    assert (x * x - p * p) / (x - p) == x + p
    assert (1 / (x + p)).partial() == -1 / ((x + p) * (x + p))
    assert (4 * x * x * p * p).square_root() == 2 * x * p
    assert (x + 1).square_root() is None
    assert base_part(x) == x
    with pytest.raises(ZeroDivisionError):
        1 / (x - x)


@pytest.mark.parametrize(
    ("changes", "inequality"),
    [
        ({"m": -1}, "m > 0"),
        ({"m": 0}, "m > 0"),
        ({"R": 0}, "R > 0"),
        ({"A1": -1}, "A1 > 0"),
        ({"A3": 0}, "A3 > 0"),
        ({"a": 2}, r"\|a\| <= R"),
        ({"a": -2}, r"\|a\| <= R"),
        ({"A3": "51/100"}, "A3 <= 2 A1"),
        ({"a": "9/10"}, r"A1 \+ A3/2 <= m"),
        ({"A1": "9/10", "A3": "1/3"}, r"A1 \+ A3/2 <= m"),
    ],
)
def test_impossible_bodies_are_refused_with_the_inequality(changes, inequality):
    possible = {"m": 1, "R": 1, "a": "1/5", "A1": "1/4", "A3": "1/3"}
    Ball(**possible)
    with pytest.raises(InputError, match=inequality):
        Ball(**{**possible, **changes})


def test_two_mass_points_are_the_limit_that_is_still_possible():
    """Rings on the surface reach equality in A1 + A3/2 <= m (R^2 - a^2)."""
    Ball(m=1, R=1, a=0, A1="1/2", A3=1)
    with pytest.raises(InputError, match="A1"):
        Ball(m=1, R=1, a=0, A1="501/1000", A3=1)


def test_spheres_that_are_refused():
    ball = Ball(m=1, R=1, a=0, A1="1/4", A3="1/4")
    with pytest.raises(InputError, match="other than 0"):
        ball.on_sphere(0)
    for radius in (-1, "-1/2"):
        with pytest.raises(InputError, match="doesn't fit"):
            ball.on_sphere(radius)


def test_exact_numbers_only():
    assert exact(Fraction(1, 3), "m") == sp.Rational(1, 3)
    assert exact("0.1", "m") == sp.Rational(1, 10)
    for value in (0.5, sp.Float(0.5), True, None):
        with pytest.raises(InputError, match="exact number"):
            exact(value, "m")
    assert exact("2*sqrt(2)", "m") == sp.sqrt(8)
    for text in ("__import__('os')", "one", "", "1/0", "9^^9", "1 2", "cos(u)"):
        with pytest.raises(InputError):
            exact(text, "m")
    for value in (sp.I, sp.oo, sp.nan, "sqrt(-1)"):
        with pytest.raises(InputError, match="isn't a real number"):
            exact(value, "m")


def test_numbers_that_are_too_large_are_refused_before_they_are_computed():
    for value in ("1e999999999", "9^9^9", "((9^100)^100)^100", 10**400, Fraction(1, 10**400)):
        with pytest.raises(LimitExceeded):
            exact(value, "m")

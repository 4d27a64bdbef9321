"""Theorems 1 and 2: the proofs' identities, the engine's decisions, the degenerate balls, the closed forms."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
import sympy as sp

import kovacic
from kovacic.ball import Ball, X, closed_form
from kovacic.ball.closed import C1, C2, NumericBall, closed_form_in_roots
from kovacic.ball.decision import decide, degree_of_omega, group_of, normalised
from kovacic.ball.field import Ring
from kovacic.ball.theorems import (
    constant_coefficients,
    double_root,
    exponents,
    printed_equations,
    rational_solutions,
    semi_invariant,
    spin_in_the_roots,
    symbolic_ball,
    two_exponentials,
)
from kovacic.errors import InputError

# m, R, a, A1, A3: complex roots; l < 0; a = 0; A1 = A3; homogeneous; real roots beyond -1 and beyond 1; a double root.
BALLS = {
    "complex": (1, 1, "1/5", "1/4", "1/3"),
    "negative": (1, 1, "1/5", "1/3", "1/4"),
    "centred": (1, 2, 0, "1/2", "2/3"),
    "equal moments": (2, 1, "1/3", "1/4", "1/4"),
    "homogeneous": (1, 1, 0, "2/5", "2/5"),
    "roots left": (1, 1, "1/2", "1/4", "7/24"),
    "roots right": (1, 1, "-1/2", "1/4", "7/24"),
    "double root": (1, 1, "1/2", "1/4", "1/3"),
}


def ball(name):
    if name == "double root":
        # a^2 = (A3 + m R^2)(A3 - A1)/(A3 m) must be a square: A3 = 1/3, A1 = 7/24 gives a^2 = 1/6; A1 = 1/4: a^2 = 1/3.
        m, R, A3, a = sp.Integer(1), sp.Integer(1), sp.Rational(1, 3), sp.Rational(1, 4)
        return Ball(m=m, R=R, a=a, A1=A3 - A3 * m * a**2 / (A3 + m * R**2), A3=A3)
    m, R, a, A1, A3 = BALLS[name]
    return Ball(m=m, R=R, a=a, A1=A1, A3=A3)


def places(name):
    rolling = ball(name)
    return [rolling.on_sphere(3), rolling.on_sphere("4/7"), rolling.on_sphere(-8), rolling.on_plane()]


@pytest.mark.parametrize(
    "proof",
    [
        constant_coefficients(symbolic_ball()),
        semi_invariant(symbolic_ball()),
        two_exponentials(),
        exponents(),
        double_root(),
        spin_in_the_roots(),
    ],
    ids=lambda proof: proof.statement[:40],
)
def test_every_step_of_the_proofs_holds_for_all_parameters(proof):
    assert proof, proof.text()


def test_a_wrong_step_is_seen(monkeypatch):
    """The proof compares with the derived coefficients: a wrong radius makes it fail."""
    from kovacic.ball.ball import BallOnSphere

    sphere = symbolic_ball()
    monkeypatch.setattr(BallOnSphere, "ratio", property(lambda self: 2 * self.ball.R / self.R1))
    proof = constant_coefficients(sphere)
    assert not proof
    assert "FAILS" in proof.text()


@pytest.mark.parametrize("name", sorted(BALLS))
def test_the_degenerate_balls_obey_the_same_system(name):
    for sphere in places(name):
        assert constant_coefficients(sphere), (name, sphere.R1)
        assert semi_invariant(sphere), (name, sphere.R1)


def test_theorem_1_solutions_for_N_up_to_50():
    for N in range(1, 51):
        found = rational_solutions(N)
        assert found.verified, N
        first, second = found.omegas
        assert first != second, N


def test_theorem_1_printed_solutions():
    x1, x2 = sp.symbols("x1 x2")
    printed = {
        1: (1 / sp.sqrt(X - x1), 1 / sp.sqrt(X - x2)),
        3: ((4 * X - x1 - 3 * x2) / sp.sqrt(X - x2), (4 * X - 3 * x1 - x2) / sp.sqrt(X - x1)),
    }
    for N, solutions in printed.items():
        assert set(rational_solutions(N).expressions()) == set(solutions)
    assert sp.diff(rational_solutions(2).expressions()[1], X) == 0  # R = R1: omega_3 = const
    with pytest.raises(InputError, match="positive integer"):
        rational_solutions(0)


@pytest.mark.parametrize("sign", [1, -1])
def test_n_of_theorem_1_for_N_up_to_50(sign):
    """The other linear equation, dn/du = a1 n + a2 omega_3, exactly, for R/R1 = N/2 and -N/2."""
    for N in range(1, 51):
        found = rational_solutions(N)
        ring = found.factors[0].ring
        alpha = ring.element(X)
        beta = alpha + ring.element(sp.Symbol("delta"))
        rho = ring.element(sp.Rational(sign * N, 2))
        for P, Q, theta in zip(found.factors, found.spins(sign), found.thetas, strict=True):
            slope = Q.partial() + (theta - (1 / alpha + 1 / beta) * 3 / 4) * Q
            right = rho * (alpha + beta) * Q / 2 - (1 + rho) * (alpha - beta) * (alpha - beta) * P / 4
            assert slope == right / (alpha * beta), N


@pytest.mark.parametrize("ratio", ["1/2", "-1/2", "1", "3/2", "-3/4", "1/3", "17/5", "sqrt(2)"])
@pytest.mark.parametrize("body", ["negative", "roots left"])
def test_closed_form_in_the_roots_of_a_ball_solves_its_linear_equations(body, ratio):
    """The two ways to write it, with the roots and with D, span the same space: both fitted to one initial state."""
    rolling = ball(body)
    sphere = rolling.on_sphere(rolling.R / sp.sympify(sp.Rational(ratio) if "s" not in ratio else sp.sqrt(2)))
    x1, x2 = sphere.roots
    values = {"A1": rolling.A1, "A3": rolling.A3, "x1": x1, "x2": x2}
    in_roots = closed_form_in_roots(sphere.ratio)
    with mpmath.workdps(40):
        numeric = NumericBall.of(sphere, mpmath)
        parts = [part.subs(values) for part in (in_roots.omega_3, in_roots.n)]
        rows = [sp.Matrix([part.subs(X, at) for part in parts]) for at in (sp.Rational(4, 5), sp.Rational(-3, 5))]
        before, after = (row.jacobian([C1, C2]).evalf(60) for row in rows)
        expected = (after * before.inv() * sp.Matrix([-1, 3])).evalf(35)
        got = numeric.transport(mpmath.mpf(-3) / 5, mpmath.mpf(4) / 5, -1, 3)
        for value, reference in zip(got, expected, strict=True):
            assert abs(value - mpmath.mpmathify(sp.re(reference))) < mpmath.mpf(10) ** -30


def test_theorem_1_by_the_engine_for_N_up_to_50():
    for N in range(1, 51):
        ratio = sp.Rational(N, 2)
        verdict = decide(normalised(ratio), ratio)
        assert (verdict.degree, verdict.verified) == (1, True), N


def test_theorem_1_by_the_parametric_engine_for_every_physical_parameter():
    """m, R, a, A1, A3, R1 all symbolic: the whole statement with its degenerate balls, proven to be complete."""
    statement = kovacic.conditions(symbolic_ball().S, var="x")
    assert statement.complete is True
    assert statement.generic.case == 2
    general = {"m": 1, "R": 1, "a": Fraction(1, 5), "A1": Fraction(1, 4), "A3": Fraction(1, 3)}
    double = {**general, "a": Fraction(1, 4), "A1": Fraction(1, 3) - Fraction(1, 64)}
    for R1 in (1, 2, 3, 4, 5, Fraction(2, 3), Fraction(4, 7), -3, Fraction(-1, 2)):
        expected = 1 if (2 / Fraction(R1)).denominator == 1 else 2
        assert statement.case_at({**general, "R1": R1}) == expected
        assert statement.case_at({**double, "R1": R1}) == 1
        assert statement.case_at({**general, "A1": Fraction(1, 3), "R1": R1}) == 1


def test_the_engine_finds_one_of_our_two_omegas_or_a_pair_of_them():
    """Its omega solves the same Riccati equation over Q(x): for N odd both omegas are rational, and so is every one."""
    for N in (1, 2, 3, 7):
        S = normalised(sp.Rational(N, 2))
        answer = kovacic.solve(S.expression())
        omega = sp.sympify(answer.omega.to_str("x")) if answer.omega is not None else None
        assert omega is not None
        assert sp.cancel(sp.diff(omega, X) + omega**2 - S.expression()) == 0


def test_theorem_2_by_the_engine():
    for p in range(1, 16):
        for q in range(3, 9):
            ratio = sp.Rational(p, q)
            verdict = decide(normalised(ratio), ratio)
            expected = 1 if (2 * ratio).is_integer else 2
            assert (verdict.degree, verdict.verified) == (expected, True), ratio


@pytest.mark.parametrize(
    ("ratio", "order"), [("1/4", 8), ("3/4", 8), ("1/3", 12), ("2/3", 12), ("2/5", 20), ("1/6", 12)]
)
def test_groups_are_dicyclic(ratio, order):
    S = normalised(sp.Rational(ratio))
    assert kovacic.solve(S.expression()).group.order == order


def test_quaternion_group():
    """The dicyclic group of order 8: every solution is algebraic, of degree 8 over C(x)."""
    group = kovacic.solve(normalised(sp.Rational(1, 4)).expression()).group
    assert (group.name, group.order) == ("dicyclic of order 8", 8)


@pytest.mark.parametrize("ratio", [sp.sqrt(2), 1 + sp.sqrt(2), sp.sqrt(3) / 2])
def test_irrational_ratios_have_the_normaliser_of_the_torus(ratio):
    (S,) = printed_equations(ratio)[1].coefficients
    answer = kovacic.solve(S.subs({"x1": 1, "x2": -1}))
    assert (answer.case, answer.group.name, answer.verified) == (2, "N(T)", True)


@pytest.mark.parametrize("ratio", ["1414213562/1000000007", "665857/470832", "10000000001/20000000000"])
def test_ratios_that_are_nearly_irrational_or_nearly_of_theorem_1(ratio):
    rho = sp.Rational(ratio)
    verdict = decide(normalised(rho), rho)
    assert (verdict.degree, verdict.verified) == (2, True)
    answer = kovacic.solve(normalised(rho).expression())
    assert answer.group.order == 4 * sp.denom(2 * rho)


def test_normalised_equation_is_the_general_one():
    """x = (x1 + x2)/2 + s (x1 - x2)/2 carries (13) into the one with the roots 1 and -1."""
    x1, x2, rho = sp.symbols("x1 x2 rho")
    k = (1 + 8 * rho**2) / (8 * (x1 - x2))
    S = k / (X - x1) - k / (X - x2) - sp.Rational(3, 16) * ((X - x1) ** -2 + (X - x2) ** -2)
    scale = (x1 - x2) / 2
    moved = S.subs(X, (x1 + x2) / 2 + X * scale) * scale**2
    fixed = S.subs({x1: 1, x2: -1}, simultaneous=True)
    ring = Ring(("rho", "x1", "x2", "x"))
    assert ring.element(moved) == ring.element(fixed)
    ratio = sp.Rational(3, 7)
    assert sp.cancel(normalised(ratio).expression() - fixed.subs(rho, ratio)) == 0


@pytest.mark.parametrize("name", sorted(BALLS))
def test_degree_and_group_of_every_ball_agree_with_the_engine(name):
    for sphere in (*places(name), ball(name).on_sphere(ball(name).R), ball(name).on_sphere(4 * ball(name).R)):
        answer = kovacic.solve(sphere.S)
        assert answer.case == degree_of_omega(sphere), (name, sphere.R1)
        assert answer.group.name == group_of(sphere), (name, sphere.R1, sphere.kind)


def test_symbolic_parameters_leave_the_group_open():
    assert group_of(symbolic_ball()) is None
    assert degree_of_omega(symbolic_ball()) is None
    with pytest.raises(InputError, match="over Q here"):
        decide(symbolic_ball().rational_form().normal_form(), sp.Symbol("rho"))


def test_irrational_ratio_is_known_to_have_an_infinite_group():
    sphere = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(sp.sqrt(2))
    assert (group_of(sphere), degree_of_omega(sphere)) == ("N(T)", 2)


@pytest.mark.parametrize("name", sorted(BALLS))
def test_kinds_and_roots(name):
    sphere = ball(name).on_sphere(3)
    word = {
        "complex": "complex",
        "negative": "real",
        "centred": "a = 0",
        "equal moments": "linear",
        "homogeneous": "constant",
        "roots left": "real",
        "roots right": "real",
        "double root": "double",
    }[name]
    assert word in sphere.kind
    for root in sphere.roots:
        assert sp.expand(sphere.D.subs(X, root)) == 0
        assert not root.is_real or abs(root) > 1


@pytest.mark.parametrize("name", sorted(BALLS))
def test_closed_form_solves_the_linear_equations(name):
    """At 30 digits, at three points, for both constants; real and regular on [-1, 1]."""
    for sphere in places(name):
        solution = closed_form(sphere)
        system = sphere.linear_system()
        sine = sp.sin(sp.Symbol("u"))
        rate_n = [(entry / sine).subs(sp.cos(sp.Symbol("u")), X) for entry in (system.a1, system.a2)]
        rate_w = [(entry / sine).subs(sp.cos(sp.Symbol("u")), X) for entry in (system.b1, system.b2)]
        n, w = solution.n, solution.omega_3
        for residue in (
            -sp.diff(n, X) - rate_n[0] * n - rate_n[1] * w,
            -sp.diff(w, X) - rate_w[0] * n - rate_w[1] * w,
        ):
            for at in ("-9/10", "1/7"):
                for constants in ({C1: 1, C2: 0}, {C1: 0, C2: 1}):
                    value = residue.subs(constants).subs(X, sp.Rational(at)).evalf(30)
                    assert abs(value) < 1e-25, (name, sphere.R1)
        assert all(
            sp.im(w.subs({C1: 2, C2: 3, X: at}).evalf(20)) == 0 for at in (sp.Rational(-1, 2), sp.Rational(1, 2))
        )


@pytest.mark.parametrize("name", sorted(BALLS))
def test_transport_is_the_closed_form_at_40_digits(name):
    """Two ways of computing: the chord formula from initial values, and the expressions with fitted constants."""
    start, end = sp.Rational(4, 5), sp.Rational(-3, 5)
    for sphere in places(name):
        solution = closed_form(sphere)
        rows = [sp.Matrix([part.subs(X, at) for part in (solution.omega_3, solution.n)]) for at in (start, end)]
        before, after = (row.jacobian([C1, C2]).evalf(60) for row in rows)
        expected = (after * before.inv() * sp.Matrix([-1, 3])).evalf(45)
        with mpmath.workdps(45):
            got = NumericBall.of(sphere, mpmath).transport(mpmath.mpf(-3) / 5, mpmath.mpf(4) / 5, -1, 3)
            for value, reference in zip(got, expected, strict=True):
                assert abs(value - mpmath.mpmathify(sp.re(reference))) < mpmath.mpf(10) ** -38, (name, sphere.R1)


def test_transport_agrees_with_an_ode_solver():
    with mpmath.workdps(18):
        sphere = ball("negative").on_sphere(3)
        u = sp.Symbol("u")
        system = sphere.linear_system()
        rates = sp.lambdify(u, (system.a1, system.a2, system.b1, system.b2), "mpmath")

        def slope(at, y):
            a1, a2, b1, b2 = rates(at)
            return [a1 * y[0] + a2 * y[1], b1 * y[0] + b2 * y[1]]

        start, end = mpmath.mpf(1) / 2, mpmath.mpf(1)
        reference = mpmath.odefun(slope, start, [mpmath.mpf(3), mpmath.mpf(-1)], tol=mpmath.mpf(10) ** -14)(end)
        omega_3, n = NumericBall.of(sphere, mpmath).transport(mpmath.cos(end), mpmath.cos(start), -1, 3)
        assert abs(omega_3 - reference[1]) < 1e-12
        assert abs(n - reference[0]) < 1e-12

"""Theorems 1 and 2: by the engine, for all parameters and for many ratios; the closed forms, exactly; degenerate balls."""

from __future__ import annotations

from fractions import Fraction
from math import prod

import mpmath
import pytest
import sympy as sp
from build import QQ, RatFunc, parametrize, read_input, run

import kovacic
from kovacic.ball import BallSolution, InRoots, RollingBall, X, closed_form

k, x1, x2, A1, A3, m, R, a, R1, C1, C2 = sp.symbols("k x1 x2 A1 A3 m R a R1 c1 c2")
# m, R, a, A1, A3: complex roots; l < 0; a = 0; A1 = A3; homogeneous; real roots beyond -1 and beyond 1; a double root.
BALLS = {
    "complex": (1, 1, "1/5", "1/4", "1/3"),
    "negative": (1, 1, "1/5", "1/3", "1/4"),
    "centred": (1, 2, 0, "1/2", "2/3"),
    "equal moments": (2, 1, "1/3", "1/4", "1/4"),
    "homogeneous": (1, 1, 0, "2/5", "2/5"),
    "roots left": (1, 1, "1/2", "1/4", "7/24"),
    "roots right": (1, 1, "-1/2", "1/4", "7/24"),
    "double root": (1, 1, "1/4", sp.Rational(1, 3) - sp.Rational(1, 64), "1/3"),
}
KINDS = {
    "complex": "complex",
    "negative": "real",
    "centred": "a = 0",
    "equal moments": "linear",
    "homogeneous": "constant",
    "roots left": "real",
    "roots right": "real",
    "double root": "double",
}


def ball(name):
    return RollingBall(**dict(zip(("m", "R", "a", "A1", "A3"), BALLS[name], strict=True)))


def places(name):
    rolling = ball(name)
    radii = (3, "4/7", -8, "sqrt(2)", rolling.R, 2 * rolling.R, 4 * rolling.R)
    return [*map(rolling.on_sphere, radii), rolling.on_plane()]


def thirteen(rho, **roots):
    """S of (13), by default with x1 = 1, x2 = -1: the general case up to an affine change of x."""
    return InRoots(sp.sympify(rho)).S.subs(roots or {"x1": 1, "x2": -1})


def group_of(sphere):
    """The differential Galois group, by hand, for real rho and rational or algebraic parameters.

    y1/y2 = t^(2 rho) and C(x, sqrt(D)) = C(t): with 2 rho = p/q in lowest terms the projective group is dihedral of order 2 q.
    """
    rho = sphere.ratio
    if sphere.leading == 0:
        return "trivial" if sphere.ball.a == 0 else "mu_4"
    if sphere.discriminant == 0:
        if rho == 0:
            return "G_a extended by mu_2"
        n = sp.denom(rho + sp.Rational(1, 2))  # y = (x - x1)^(1/2 +- rho)
        return "G_m" if not rho.is_rational else "trivial" if n == 1 else f"mu_{n}"
    if rho == 0:
        return "G_a extended by mu_4"
    if not rho.is_rational:
        return "N(T)"
    q = int(sp.denom(2 * rho))
    return "mu_4" if q == 1 else f"dicyclic of order {4 * q}"


class Chart:
    """Roots of x - x1 and x - x2, or of D, as rational functions of t: substitution makes an algebraic identity rational.

    `roots` maps a base to its square root, `x` is x.
    """

    def __init__(self, roots, x):
        self.roots, self.x = roots, x

    def vanishes(self, expression):
        """Decided in the engine's fields."""
        plain = expression.replace(
            lambda z: z.is_Pow and z.base in self.roots and (2 * z.exp).is_Integer,
            lambda z: self.roots[z.base] ** (2 * z.exp),
        )
        limits = kovacic.Limits(terms=10**6)
        return not read_input(sp.sympify(plain.xreplace({X: self.x})), var="t_u", limits=limits).S.num


t = sp.Symbol("t_u")
# t = sqrt(x - x1) + sqrt(x - x2)
_SUM, _DIFFERENCE = (t + (x2 - x1) / t) / 2, (t - (x2 - x1) / t) / 2
IN_ROOTS = Chart({X - x1: _SUM, X - x2: _DIFFERENCE}, x1 + _SUM**2)


def rate(product):
    """The logarithmic derivative of a product of powers."""
    return sum(exponent * sp.diff(base, X) / base for base, exponent in product.as_powers_dict().items())


def satisfies(form: BallSolution, place, chart: Chart) -> bool:
    """The linear system, (13) and the Riccati equation, exactly and for all values of the symbols, for c1 and for c2."""
    (a1, a2, b1, b2), S = place.linear_system, place.S
    identities = [sp.diff(omega, X) + omega**2 - S for omega in form.omega]
    for constants in ({C1: 1, C2: 0}, {C1: 0, C2: 1}):
        y, w, n = (sp.powsimp(part.subs(constants)) for part in (form.y, form.omega_3, form.n))
        q = sum(sp.powsimp(term / w) for term in sp.Add.make_args(sp.expand_mul(n)))  # n/omega_3
        L, omega = rate(w), rate(y)
        identities += [sp.diff(q, X) + q * L + a1 * q + a2, L + b1 * q + b2, sp.diff(omega, X) + omega**2 - S]
    return all(map(chart.vanishes, identities))


def test_both_theorems_by_the_engine_for_all_radii_and_roots():
    """The reproduction: one call on (13) as printed."""
    statement = kovacic.conditions(InRoots(R / R1).S, var="x")
    assert statement.complete is True
    assert statement.generic.case == 2
    assert {str(region) for region in statement.regions if region.defined} == {
        "x1 = x2: case 1",
        "2*R/R1 in Z: case 1",
    }
    for values, case in (((3, 2), 1), ((1, 3), 2), ((-7, 2), 1), ((5, 7), 2)):
        at = {"R": values[0], "R1": values[1], "x1": Fraction(3), "x2": Fraction(-5, 2)}
        assert statement.case_at(at) == case
        assert statement.case_at({**at, "x1": at["x2"]}) == 1


@pytest.mark.long
def test_both_theorems_for_every_physical_parameter():
    """m, R, a, A1, A3, R1 all symbolic: the whole statement with its degenerate balls, proven to be complete."""
    statement = kovacic.conditions(RollingBall(m=m, R=R, a=a, A1=A1, A3=A3).on_sphere(R1).S, var="x")
    assert statement.complete is True
    assert statement.generic.case == 2
    general = {"m": 1, "R": 1, "a": Fraction(1, 5), "A1": Fraction(1, 4), "A3": Fraction(1, 3)}
    double = {**general, "a": Fraction(1, 4), "A1": Fraction(1, 3) - Fraction(1, 64)}
    for radius in (1, 2, 3, 4, 5, Fraction(2, 3), Fraction(4, 7), -3, Fraction(-1, 2)):
        expected = 1 if (2 / Fraction(radius)).denominator == 1 else 2
        assert statement.case_at({**general, "R1": radius}) == expected
        assert statement.case_at({**double, "R1": radius}) == 1
        assert statement.case_at({**general, "A1": Fraction(1, 3), "R1": radius}) == 1


@pytest.mark.long
def test_theorem_2_formula_for_all_ratios_and_roots():
    assert satisfies(closed_form(InRoots(k)), InRoots(k), IN_ROOTS)


@parametrize("part", ["omega", "y", "omega_3", "n"], ordinary=0, long=1)
def test_a_wrong_sign_in_a_closed_form_is_seen(part):
    for rho in (k, sp.Rational(3, 2)):
        good = closed_form(InRoots(rho))
        turned = {
            "omega": tuple(-omega for omega in good.omega),
            "y": good.y / (X - x1),
            "omega_3": good.omega_3 * X,
            "n": -good.n,
        }
        parts = {name: getattr(good, name) for name in ("omega", "y", "omega_3", "n")}
        bad = BallSolution(**{**parts, part: turned[part]})
        assert not bad.solves(InRoots(rho))
        assert not satisfies(bad, InRoots(rho), IN_ROOTS)
        assert good.solves(InRoots(rho))


@pytest.mark.long
def test_the_formula_in_E_for_all_parameters():
    """The closed form of a ball whose parameters are symbols, with l = s^2: A3 = A1 + s^2/(m R^2)."""
    s = sp.Symbol("s")
    sphere = RollingBall(m=m, R=R, a=a, A1=A1, A3=A1 + s**2 / (m * R**2)).on_sphere(R1)
    form, D = closed_form(sphere), sphere.D
    half = sp.diff(D, X) / 2
    constant = sp.expand(half**2 - s**2 * D)  # E times its conjugate
    chart = Chart({D: (t - constant / t) / (2 * s), s**2: s}, ((t + constant / t) / 2 - half.subs(X, 0)) / s**2)
    assert form.E == half + sp.sqrt(s**2) * sp.sqrt(D) or sp.expand(form.E - half - sp.sqrt(s**2) * sp.sqrt(D)) == 0
    assert satisfies(form, sphere, chart)


@pytest.mark.parametrize("sign", [1, -1])
@parametrize("N", range(1, 7), ordinary=0, long=4)
def test_theorem_1_solutions_exactly(N, sign):
    """Both solutions, both omegas and both n, for all x1, x2; for 2R/R1 = N and -N."""
    rho = sp.Rational(sign * N, 2)
    form = closed_form(InRoots(rho))
    assert satisfies(form, InRoots(rho), Chart({}, X))
    assert sp.cancel(form.omega[0] - form.omega[1]) != 0


#: The roots and the moments are numbers.
NUMBERS = {x1: 1, x2: -1, A1: 3, A3: 5}


def bases(product) -> dict[RatFunc, Fraction]:
    """The bases of a product of powers as rational functions over Q, with their exponents."""
    found: dict[RatFunc, Fraction] = {}
    for base, e in product.as_powers_dict().items():
        number = read_input(base.subs(NUMBERS), var="x").S
        found[number] = found.get(number, Fraction(0)) + Fraction(int(e.p), int(e.q))
    return found


def product_of(powers: dict[RatFunc, Fraction]) -> RatFunc:
    """Of integer powers of rational functions."""
    return prod((base ** int(e) for base, e in powers.items() if not e % 1), start=RatFunc(QQ.poly([1])))


@parametrize("sign", [1, -1], ordinary=0, long=1)
def test_theorem_1_solutions_for_N_up_to_12(sign):
    """The same, over Q: x1 = 1, x2 = -1, to which an affine change of x carries any two roots."""
    for N in range(1, 13):
        rho = sp.Rational(sign * N, 2)
        form, S = closed_form(InRoots(rho)), read_input(thirteen(rho)).S
        a1, a2, b1, b2 = (read_input(part.subs(NUMBERS), var="x").S for part in InRoots(rho).linear_system)
        rates = set()
        for omega, constant in zip((part.subs(NUMBERS) for part in form.omega), (C1, C2), strict=True):
            y, w, n = (bases(part.subs({A1: 3, A3: 5}).coeff(constant)) for part in (form.y, form.omega_3, form.n))
            L, rate_of_y = (sum((b.derivative() / b * e for b, e in powers.items()), S * 0) for powers in (w, y))
            exponents = {base: n.get(base, Fraction(0)) - w.get(base, Fraction(0)) for base in {**n, **w}}
            q = product_of(exponents)  # n/omega_3
            assert not any(e % 1 for e in exponents.values())
            assert q.derivative() + q * L + a1 * q + a2 == 0
            assert L + b1 * q + b2 == 0
            assert rate_of_y == read_input(omega, var="x").S
            assert rate_of_y.derivative() + rate_of_y**2 == S
            rates.add(rate_of_y)
        assert len(rates) == 2


def test_theorem_1_printed_solutions():
    printed = {
        1: C1 / sp.sqrt(X - x1) + C2 / sp.sqrt(X - x2),
        3: C1 * (4 * X - x1 - 3 * x2) / sp.sqrt(X - x2) + C2 * (4 * X - 3 * x1 - x2) / sp.sqrt(X - x1),
    }
    for N, omega_3 in printed.items():
        assert closed_form(InRoots(sp.Rational(N, 2))).omega_3 == omega_3
    assert closed_form(InRoots(sp.Integer(1))).omega_3.coeff(C2).is_number  # R = R1: omega_3 = const


@pytest.mark.long
def test_rational_omega_beyond_what_is_written_out():
    form = closed_form(InRoots(sp.Integer(9)))
    assert satisfies(
        BallSolution(form.omega, form.y, form.omega_3, form.n),
        InRoots(sp.Integer(9)),
        IN_ROOTS,
    )
    for omega in form.omega:  # the same at the other values of the roots
        at = {x1: -3, x2: 2, X: sp.Rational(1, 3)}
        exact = sp.nsimplify(sp.expand(sp.simplify(omega.subs(at))))
        assert exact.is_Rational


@parametrize("name", sorted(BALLS), ordinary=0, long=2)
def test_closed_form_and_group_of_every_ball(name):
    for sphere in places(name):
        answer = kovacic.solve(sphere.S)
        group = group_of(sphere)
        case = 2 if group.startswith(("N(T)", "dicyclic")) else 1
        assert (answer.case, answer.group.name) == (case, group), (name, sphere.R1)
        form = closed_form(sphere)
        assert form.solves(sphere), (name, sphere.R1)
        at = {C1: 2, C2: 3}
        for x in (sp.Rational(-1, 2), sp.Rational(1, 2)):  # real and regular on [-1, 1]
            assert sp.im(form.omega_3.subs({**at, X: x}).evalf(20)) == 0
            assert sp.im(form.n.subs({**at, X: x}).evalf(20)) == 0


@parametrize("name", ["centred", "equal moments", "complex", "double root", "roots left"], ordinary=1)
def test_a_wrong_ratio_in_a_closed_form_is_seen(name):
    right, wrong = ball(name).on_sphere(3), ball(name).on_sphere(4)
    assert not closed_form(wrong).solves(right)


@pytest.mark.parametrize("body", [(m, R, a, A1, A3), (1, 1, a, "1/4", "1/3")], ids=str)
def test_the_closed_form_of_a_ball_with_symbols_is_checked(body):
    right, wrong = (
        RollingBall(**dict(zip(("m", "R", "a", "A1", "A3"), body, strict=True))).on_sphere(r) for r in (2, 4)
    )
    assert closed_form(right).solves(right)
    assert not closed_form(wrong).solves(right)


@pytest.mark.parametrize("name", sorted(BALLS))
def test_kinds_and_roots(name):
    sphere = ball(name).on_sphere(3)
    assert KINDS[name] in sphere.kind
    for root in sphere.roots:
        assert sp.expand(sphere.D.subs(X, root)) == 0
        assert not root.is_real or abs(root) > 1


def test_omega_is_rational_for_every_ratio_if_A1_is_A3_or_x1_is_x2():
    for name in ("equal moments", "homogeneous", "double root"):
        for sphere in places(name):
            assert all(omega.is_rational_function(X) for omega in closed_form(sphere).omega)


@pytest.mark.long
def test_R1_is_R_has_a_constant_omega_3():
    """For all balls: omega_3 = 1 with the n that its own linear equation demands satisfies the other one."""
    rolling = RollingBall(m=m, R=R, a=a, A1=A1, A3=A3)
    a1, a2, b1, b2 = rolling.on_sphere(R).linear_system
    n = -b2 / b1
    assert sp.cancel(sp.diff(n, X) + a1 * n + a2) == 0
    assert sp.cancel(sp.diff(closed_form(rolling.on_sphere(R)).omega_3.coeff(C1), X)) == 0
    a1, a2, b1, b2 = rolling.on_sphere(2 * R).linear_system
    assert sp.cancel(sp.diff(-b2 / b1, X) - a1 * b2 / b1 + a2) != 0


# Real, complex and conjugate roots x1, x2.
ROOTS = (
    {"x1": 1, "x2": -1},
    {"x1": sp.Rational(5, 3), "x2": -7},
    {"x1": 2 + sp.I, "x2": 2 - sp.I},
    {"x1": sp.I, "x2": 3},
)


@parametrize("roots", ROOTS, ordinary=1, ids=str)
def test_theorem_1_by_the_engine(roots):
    for N in (*range(1, 13), 49, 50) if roots == ROOTS[0] else (1, 2, 3, 4, 7, 11, 12):
        answer = kovacic.solve(thirteen(sp.Rational(N, 2), **roots))
        assert (answer.case, answer.riccati.degree, answer.verified, answer.group.name) == (1, 1, True, "mu_4"), N


@parametrize("roots", ROOTS, ordinary=(2,), ids=str)
def test_theorem_2_by_the_engine(roots):
    for q in range(3, 9) if roots == ROOTS[0] else (3, 5):
        for p in range(1, 16, 3) if roots == ROOTS[0] else (1, 4):
            ratio = sp.Rational(p, q)
            answer = kovacic.solve(thirteen(ratio, **roots))
            expected = 1 if (2 * ratio).is_integer else 2
            assert (answer.case, answer.riccati.degree, answer.verified) == (expected, expected, True), ratio


@pytest.mark.long
def test_the_engine_finds_one_of_our_two_omegas_or_a_pair_of_them():
    """Its omega solves the same Riccati equation over Q(x): for N odd both omegas are rational, and so is every one."""
    for N in (1, 2, 3, 7):
        S = thirteen(sp.Rational(N, 2))
        omega = sp.sympify(kovacic.solve(S).omega.to_str("x"))
        assert sp.cancel(sp.diff(omega, X) + omega**2 - S) == 0


@pytest.mark.parametrize(
    ("ratio", "order"), [("1/4", 8), ("3/4", 8), ("1/3", 12), ("2/3", 12), ("2/5", 20), ("1/6", 12)]
)
def test_groups_are_dicyclic(ratio, order):
    group = kovacic.solve(thirteen(ratio)).group
    assert (group.name, group.order) == (f"dicyclic of order {order}", order)


@pytest.mark.parametrize("ratio", [sp.sqrt(2), 1 + sp.sqrt(2), sp.sqrt(3) / 2])
def test_irrational_ratios_have_the_normaliser_of_the_torus(ratio):
    answer = kovacic.solve(thirteen(ratio))
    assert (answer.case, answer.group.name, answer.verified) == (2, "N(T)", True)


@pytest.mark.parametrize("ratio", ["1414213562/1000000007", "665857/470832", "10000000001/20000000000"])
def test_ratios_that_are_nearly_irrational_or_nearly_of_theorem_1(ratio):
    rho = sp.Rational(ratio)
    answer = kovacic.solve(thirteen(rho))
    assert (answer.case, answer.verified, answer.group.order) == (2, True, 4 * sp.denom(2 * rho))


@pytest.mark.long
def test_normalised_equation_is_the_general_one():
    """x = (x1 + x2)/2 + s (x1 - x2)/2 carries (13) into the one with the roots 1 and -1."""
    scale = (x1 - x2) / 2
    moved = InRoots(k).S.subs(X, (x1 + x2) / 2 + X * scale) * scale**2
    assert sp.cancel(moved - thirteen(k)) == 0


@pytest.mark.parametrize("text", ["0", "-1", "-3/2", "x1", "c1", "u", "A3", "k+1", "1/0"])
def test_ratios_that_are_refused(text):
    assert run(["ball", "--ratio", text]) == 2


def test_closed_form_agrees_with_an_ode_solver():
    with mpmath.workdps(18):
        sphere = ball("negative").on_sphere(3)
        form = closed_form(sphere)
        rates = sp.lambdify(X, sphere.linear_system, "mpmath")

        def slope(x, y):
            a1, a2, b1, b2 = rates(x)
            return [-a1 * y[0] - a2 * y[1], -b1 * y[0] - b2 * y[1]]

        values = sp.lambdify((X, C1, C2), (form.n, form.omega_3), "mpmath")
        start, end = mpmath.mpf(1) / 2, mpmath.mpf(9) / 10
        reference = mpmath.odefun(slope, start, list(values(start, 2, 3)), tol=mpmath.mpf(10) ** -14)(end)
        for value, expected in zip(values(end, 2, 3), reference, strict=True):
            assert abs(value - expected) < 1e-12


def test_lengths_may_be_in_any_unit():
    """D, l and the weight are of the fourth power of a length, and (11) has no unit."""
    small = RollingBall(m=3, R=2, a="1/5", A1=1, A3="4/3").on_sphere(5)
    large = RollingBall(m=3, R=6, a="3/5", A1=9, A3=12).on_sphere(15)
    assert (large.leading, large.weight) == (81 * small.leading, 81 * small.weight)
    assert sp.expand(large.D - 81 * small.D) == 0
    assert (large.ratio, large.S) == (small.ratio, small.S)

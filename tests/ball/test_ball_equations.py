"""The equations of the ball: derived from the definitions, exactly; at the values of a ball; and bodies that can't exist."""

from __future__ import annotations

import shutil
import subprocess
from fractions import Fraction

import pytest
import sympy as sp
from _pytest.mark import ParameterSet
from build import parametrize

from kovacic import InputError, LimitExceeded
from kovacic.ball import InRoots, RollingBall, U, X
from kovacic.ball.body import sign
from kovacic.ball.derivation import PRINTED, equations_of, explained, holds, residuals, vanishes
from kovacic.ball.theorems import C1, ball_theorem, closed_form
from kovacic.writing.breaking import breakable

m, R, a, A1, A3, R1, x1, x2, D, k = sp.symbols("m R a A1 A3 R1 x1 x2 D k")

GENERAL = RollingBall(m=m, R=R, a=a, A1=A1, A3=A3)
SYSTEM = ("a1", "a2", "b1", "b2")


def with_roots() -> RollingBall:
    """The general ball in terms of the roots x1, x2 of D, instead of m and a."""
    offset = -R * (A3 - A1) * (x1 + x2) / (2 * A3)
    mass = A1 * A3 / (R**2 * (A3 - A1) * x1 * x2 - A1 * R**2 - A3 * offset**2)
    return RollingBall(m=mass, R=R, a=offset, A1=A1, A3=A3)


@pytest.mark.long
def test_every_printed_formula_is_derived_for_all_parameters():
    found = holds()
    assert set(found) == {
        *(
            "(8)",
            "(1)",
            "(2)",
            "(4)",
            "(5)",
            "(3), (6)",
            "(7)",
            "(9)",
            "(10)",
            "a1, a2, b1, b2",
            "(11)",
            "(12)",
            "(13)",
        ),
    }
    assert all(found.values()), found


def planted() -> list[ParameterSet]:
    """Every formula; all but the last of each second of the paper's numbers in the slow tests."""
    cases = []
    for index, (key, formulas) in enumerate(PRINTED.items()):
        *others, last = formulas
        cases += [pytest.param(key, name, marks=pytest.mark.slow) for name in others]
        cases.append(pytest.param(key, last, marks=[pytest.mark.slow] if index % 2 else []))
    return cases


@parametrize(("key", "name"), planted(), ordinary=0, long=1)
def test_a_wrong_term_in_a_printed_formula_is_seen(key, name, monkeypatch):
    """Every formula enters into the derivation: with the ball's mass added, one of the groups fails."""
    monkeypatch.setitem(PRINTED[key], name, PRINTED[key][name] + m)
    assert not all(vanishes(part) for _, parts in residuals() for part in parts)


def test_the_equations_of_motion_are_derived():
    """(7): the one for u enters nothing else."""
    found = dict(residuals())["(7)"]
    assert len(found) == 3
    assert all(map(vanishes, found))


@pytest.mark.long
def test_the_equations_of_a_ball_are_the_printed_ones():
    """`BallOnSphere` has its own short formulas; here for all parameters."""
    sphere = GENERAL.on_sphere(R1)
    printed = {
        name: value.subs(D, PRINTED["system"]["D"]) for name, value in (PRINTED["system"] | PRINTED["11"]).items()
    }
    for name, part in zip(SYSTEM, sphere.linear_system, strict=True):
        assert vanishes(part.subs(X, sp.cos(U)) * sp.sin(U) - printed[name]), name
    d1, d2 = (part.subs(X, sp.cos(U)) for part in sphere.second_order)
    assert vanishes(-sp.sin(U) * d1 - sp.cos(U) / sp.sin(U) - printed["d1"])
    assert vanishes(sp.sin(U) ** 2 * d2 - printed["d2"])
    first, second = sphere.second_order
    assert sp.cancel(sp.diff(first, X) / 2 + first**2 / 4 - second - sphere.S) == 0


@pytest.mark.long
def test_equations_12_and_13_in_the_roots():
    sphere = with_roots().on_sphere(R1)
    place = InRoots(R / R1)
    (d1, d2), S = place.second_order, place.S
    for found, expected in ((sphere.second_order[0], d1), (sphere.second_order[1], d2), (sphere.S, S)):
        assert sp.cancel(found - expected) == 0


@pytest.mark.long
def test_constant_coefficients_and_the_semi_invariant():
    """The identities behind the closed forms, for all parameters; and l D = m R^2 A1 B + D'^2/4."""
    sphere = GENERAL.on_sphere(R1)
    (a1, a2, b1, b2), D_, lead, rho = sphere.linear_system, sphere.D, sphere.leading, sphere.ratio
    half, weight = sp.diff(D_, X) / 2, m * R**2 * A1
    B = (A3 + m * R**2) * (A3 - A1) - A3 * m * a**2
    assert sp.expand(lead * D_ - weight * B - half**2) == 0
    n, w = sp.symbols("n omega_3")
    dn, dw = -(a1 * n + a2 * w), -(b1 * n + b2 * w)
    zeta = weight * n + half * w
    assert sp.cancel(D_ * dw + half * w + rho * zeta) == 0  # d eta/d xi = -rho zeta, eta = omega_3 sqrt(D)
    assert sp.cancel(weight * dn + lead * w + half * dw + rho * lead * w) == 0  # d zeta/d xi = -rho l eta
    phi = sp.diff(D_, X) / (2 * D_)
    assert sp.cancel(D_ * (4 * sphere.S - 2 * sp.diff(phi, X) - phi**2) - 4 * rho**2 * lead) == 0


def test_plane_is_the_limit_of_large_spheres():
    ball = RollingBall(m=2, R=1, a="1/5", A1="1/3", A3="1/4")
    plane, general = ball.on_plane(), ball.on_sphere(R1)
    pairs = zip((*plane.linear_system, plane.S), (*general.linear_system, general.S), strict=True)
    for flat, curved in pairs:
        assert sp.cancel(sp.limit(curved, R1, sp.oo) - flat) == 0
    assert plane.linear_system[2] == 0


def test_rolling_inside_is_a_negative_radius():
    ball = RollingBall(m=2, R=1, a="1/5", A1="1/3", A3="1/4")
    inside, general = ball.on_sphere(-3), ball.on_sphere(R1)
    for found, symbolic in zip(inside.linear_system, general.linear_system, strict=True):
        assert sp.cancel(symbolic.subs(R1, -3) - found) == 0


def test_equations_print():
    found = equations_of(RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/3").on_sphere(2))
    assert found["12"].text == "omega_3''(x) + (3*x/(x**2 + 4))*omega_3'(x) + (3/(4*(x**2 + 4)))*omega_3(x) = 0"
    assert found["13"].latex.startswith("y'' = ")
    assert found["11"].latex.endswith("= 0")


@pytest.mark.long
def test_the_paper_s_equations_print_under_its_numbers():
    text, latex, markdown = explained(), explained(format="latex"), explained(format="markdown")
    for number in range(1, 14):
        assert f"({number}) " in text
        assert f"({number}) " in markdown
    for formulas in PRINTED.values():
        for name in formulas:
            assert f"  {name} = " in text
    assert r"R_{1}\dot{u}_{1} = -\sqrt{E}\,\dot{u}\sin\theta + \sqrt{G}\,\dot{v}\cos\theta" in latex
    assert latex.count("{") == latex.count("}")


@pytest.mark.long
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex isn't installed")
def test_latex_compiles_without_overfull_boxes(tmp_path):
    """The derivation as `--explain --latex` prints it, and the equations of balls as `--latex` does."""
    odd = RollingBall(m="2.718281828", R="1.41421356", a="0.3333", A1="0.31", A3="0.42").on_sphere("3.1415926")
    ball = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3")
    places = [GENERAL.on_sphere(R1), odd, ball.on_sphere("sqrt(2)"), ball.on_plane()]
    formulas = [math.latex for place in (*places, InRoots(sp.Symbol("r"))) for math in equations_of(place).values()]
    body = "".join(rf"\hangindent2em$\displaystyle {breakable(latex)}$\par" for latex in formulas)
    head = "\\documentclass{article}\\usepackage{amsmath,amssymb,graphicx}\\begin{document}\n"
    (tmp_path / "a.tex").write_text(f"{head}{explained(format='latex')}{body}\\end{{document}}\n", encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "a.tex"]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert b"Overfull" not in done.stdout


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
    RollingBall(**possible)
    with pytest.raises(InputError, match=inequality):
        RollingBall(**{**possible, **changes})


def test_two_mass_points_are_the_limit_that_is_still_possible():
    """Rings on the surface reach equality in A1 + A3/2 <= m (R^2 - a^2)."""
    RollingBall(m=1, R=1, a=0, A1="1/2", A3=1)
    with pytest.raises(InputError, match="A1"):
        RollingBall(m=1, R=1, a=0, A1="501/1000", A3=1)


def test_spheres_that_are_refused():
    ball = RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/4")
    with pytest.raises(InputError, match="other than 0"):
        ball.on_sphere(0)
    for radius in (-1, "-1/2"):
        with pytest.raises(InputError, match="doesn't fit"):
            ball.on_sphere(radius)


def exact(value, name):
    """The mass or the radius of a body, as it is read."""
    body = {"m": 9, "R": 9, "a": 0, "A1": "1/1000", "A3": "1/1000"} | {name: value}
    return getattr(RollingBall(**body), name)


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
    for name in ("x", "u"):
        with pytest.raises(InputError, match="variables of the equations"):
            exact(sp.Symbol(name), "m")


def test_numbers_that_are_too_large_are_refused_before_they_are_computed():
    for value in ("1e999999999", "9^9^9", "((9^100)^100)^100", 10**400, Fraction(1, 10**400)):
        with pytest.raises(LimitExceeded):
            exact(value, "m")


def test_what_the_theorems_say():
    assert ball_theorem(InRoots(sp.Integer(3)))[1] == 1
    assert ball_theorem(InRoots(sp.Rational(1, 3)))[1] == 2
    assert ball_theorem(InRoots(k))[1] is None
    assert "omega_3 = const" in ball_theorem(InRoots(sp.Integer(1)))[0]
    round_body = RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/4").on_sphere(3)
    assert ball_theorem(round_body) == ("A1 = A3: omega is rational for every ratio (case 1)", 1)
    assert "constant" in ball_theorem(RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_plane())[0]


def test_symbolic_parameters_leave_the_case_open():
    assert ball_theorem(RollingBall(m=m, R=R, a=a, A1=A1, A3=A3).on_sphere(R1))[1] is None


def test_equal_radii_and_large_integers():
    """For R1 = R omega_3 = c1 is a solution; for N = 15 omega is written in powers of sqrt(x - x1) +- sqrt(x - x2)."""
    place = RollingBall(m=1, R=1, a=0, A1="1/4", A3="1/3").on_sphere(1)
    found = closed_form(place)
    assert found.omega_3.expand().coeff(C1) == 1
    assert found.solves(place)
    place = InRoots(sp.Rational(15, 2))
    found = closed_form(place)
    assert found.solves(place)
    r, s = sp.sqrt(X - x1), sp.sqrt(X - x2)
    assert all((r + s) ** 15 in omega.atoms(sp.Pow) for omega in found.omega)


def test_what_is_neither_zero_nor_known_not_to_be():
    machin = 4 * sp.atan(sp.Rational(1, 5)) - sp.atan(sp.Rational(1, 239)) - sp.pi / 4
    with pytest.raises(InputError, match=r"can't be decided whether .* is zero"):
        sign(machin)
    assert (sign(machin + sp.Rational(1, 10**9)), sign(machin - sp.Rational(1, 10**9))) == (1, -1)

"""`kovacic ball` without the motion, and what the ball's constructors refuse."""

from __future__ import annotations

import json

import pytest
import sympy as sp

from kovacic.ball import Ball, Body, Profile, U
from kovacic.ball.ball import ball_with_roots
from kovacic.ball.closed import closed_form_in_roots
from kovacic.ball.decision import normalised
from kovacic.ball.theorems import rational_solutions
from kovacic.errors import InputError

BALL = Ball(m=1, R=1, a="1/5", A1="1/4", A3="1/3")


@pytest.fixture
def run(capsys):
    from kovacic.cli.main import run as command_line

    def call(*arguments):
        status = command_line(["ball", *arguments])
        return status, capsys.readouterr()

    return call


def test_command_by_ratio(run):
    status, output = run("--ratio", "3/2", "--json")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 1, "mu_4", True)
    assert data["omega_3"] == "c1*(4*x - x1 - 3*x2)/sqrt(x - x2) + c2*(4*x - 3*x1 - x2)/sqrt(x - x1)"
    status, output = run("--ratio", "1/4")
    assert "dicyclic of order 8" in output.out


@pytest.mark.parametrize("ratio", ["3/2", "1/3", "-2/5", "1/2"])
def test_command_prints_n_in_closed_form(run, ratio):
    """n and omega_3 as printed, read back, solve the linear equations derived from the profile; also in --json."""
    status, output = run("--ratio", ratio, "--json")
    data = json.loads(output.out)
    assert status == 0
    n, omega_3 = (sp.parse_expr(data[name]) for name in ("n", "omega_3"))
    x = sp.Symbol("x")
    assert n.free_symbols == set(sp.symbols("x x1 x2 c1 c2 A1 A3"))
    rolling = ball_with_roots()
    system, values = rolling.linear_system(), {"x1": -3, "x2": -2, "A1": 2, "A3": 3, "R": sp.Rational(ratio), "R1": 1}
    at = {x: sp.Rational(1, 7), "c1": 2, "c2": -5}
    rates = [
        (entry / sp.sin(U)).subs(sp.cos(U), x).subs(values) for entry in (system.a1, system.a2, system.b1, system.b2)
    ]
    n, omega_3 = n.subs(values), omega_3.subs(values)
    for derivative, first, second in ((sp.diff(n, x), *rates[:2]), (sp.diff(omega_3, x), *rates[2:])):
        assert abs(sp.N((derivative + first * n + second * omega_3).subs(at), 30)) < 1e-25
    text = run("--ratio", ratio)[1].out
    for label in ("equation (12):", "case:", "group:", "omega_3:", "n:"):
        assert label in text


def test_command_with_a_large_ratio(run):
    """Theorem 1 with N = 401: decided, and the solutions in powers instead of pages of coefficients."""
    status, output = run("--ratio", "401/2", "--json")
    data = json.loads(output.out)
    assert (status, data["case"], data["verified"]) == (0, 1, True)
    assert "(sqrt(x - x1) + sqrt(x - x2))**401" in data["omega_3"]


def test_command_with_an_irrational_ratio_and_latex(run):
    status, output = run("--ratio", "sqrt(2)", "--json", "--latex")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 2, "N(T)", True)
    assert set(data["latex"]) == {"12", "13"}


def test_command_by_parameters(run):
    body = ("--mass", "1", "--radius", "2", "--offset", "1/5", "--A1", "1", "--A3", "4/3", "--sphere", "3")
    status, output = run(*body, "--json", "--latex")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"]) == (0, 2, "dicyclic of order 12")
    assert set(data["latex"]) == {"7", "11", "12", "13"}


_BALL = ("--mass", "1", "--radius", "1", "--sphere", "3")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--mass", "1", "--radius", "1", "--offset", "2", "--sphere", "1"), "|a| <= R"),
        (("--mass", "1", "--radius", "1"), "either --ratio"),
        (("--ratio", "1", "--mass", "1"), "stands alone"),
        (("--ratio", "x"), "can't contain x"),
        (("--ratio", "0"), "R/R1 = 0"),
        (("--mass", "-1", "--radius", "1", "--sphere", "1"), "m > 0 fails, as m = -1"),
        (("--mass", "1", "--radius", "0", "--sphere", "1"), "R > 0 fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "0"), "other than 0"),
        (("--mass", "1", "--radius", "1", "--sphere", "-1/2"), "R < |R1| fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "1", "--A3", "2"), "A3 <= 2 A1 fails"),
        (("--mass", "one", "--radius", "1", "--sphere", "1"), "can't contain one"),
        ((*_BALL, "--plot", "a.gif"), "doesn't end in"),
        ((*_BALL, "--plot", "/nowhere/a.png"), "can't be written"),
        (("--ratio", "-3/2"), "R < |R1| fails"),
    ],
)
def test_command_refuses(run, arguments, message):
    status, output = run(*arguments)
    assert status == 2
    assert message in output.err


EVIL = "print('executed') or 1#"


@pytest.mark.parametrize(
    "call",
    [
        lambda text: closed_form_in_roots(text),
        lambda text: normalised(text),
        lambda text: rational_solutions(text),
        lambda text: BALL.on_sphere(text),
        lambda text: Body(Profile(sp.sin(U), sp.cos(U)), text, 1, 1, sp.oo),
    ],
)
@pytest.mark.parametrize("text", [EVIL, "__import__('os').getcwd()"])
def test_text_is_never_executed(call, text, capsys):
    with pytest.raises(InputError):
        call(text)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("value", [0.1, sp.Float("0.1"), sp.nan, sp.zoo, -sp.oo, sp.I, True, None])
def test_bodies_refuse_what_is_not_exact_real_and_finite(value):
    for field in ("m", "A1", "A3", "R1"):
        with pytest.raises(InputError):
            Body(Profile(sp.sin(U), sp.cos(U)), **{"m": 1, "A1": 1, "A3": 1, "R1": 3, field: value})
    with pytest.raises(InputError):
        Profile(value * sp.sin(U) if isinstance(value, float | sp.Expr) else value, sp.cos(U))


@pytest.mark.parametrize(
    ("change", "message"),
    [({"m": -1}, "m > 0"), ({"A1": 0}, "A1 > 0"), ({"A3": 3}, "A3 <= 2 A1"), ({"R1": 0}, "other than 0")],
)
def test_impossible_bodies_are_refused_with_the_inequality(change, message):
    with pytest.raises(InputError, match=message):
        Body(Profile(sp.sin(U), sp.cos(U)), **{"m": 1, "A1": 1, "A3": 1, "R1": 3, **change})

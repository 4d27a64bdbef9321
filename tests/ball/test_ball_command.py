"""`kovacic ball`, the motion included, and what the ball's constructors refuse."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time

import build
import pytest
import sympy as sp
from build import parametrize

from kovacic import InputError
from kovacic.ball import InRoots, RollingBall, X


@pytest.fixture
def run(capsys):
    def call(*arguments):
        status = build.run(["ball", *arguments])
        return status, capsys.readouterr()

    return call


@pytest.mark.long
def test_command_by_ratio(run):
    status, output = run("--ratio", "3/2", "--json")
    data = json.loads(output.out)
    assert (status, data["N"], data["case"], data["group"], data["verified"]) == (0, "3", 1, "mu_4", True)
    assert data["omega_3"] == "c1*(4*x - x1 - 3*x2)/sqrt(x - x2) + c2*(4*x - 3*x1 - x2)/sqrt(x - x1)"
    assert "Theorem 1" in data["theorem"]
    status, output = run("--ratio", "1/4")
    assert "dicyclic of order 8" in output.out
    assert "N = 2R/R1:          1/2, not an integer" in output.out
    assert "Theorem 2" in output.out


@pytest.mark.long
def test_command_with_a_name_for_the_ratio(run):
    status, output = run("--ratio", "k", "--json")
    data = json.loads(output.out)
    assert (status, data["N"], data["verified"]) == (0, "2*k", True)
    assert "2*k in Z: case 1" in " ".join(data["conditions"])
    assert "(sqrt(x - x1) + sqrt(x - x2))**(2*k)" in data["omega_3"]


@pytest.mark.long
def test_command_with_equal_radii(run):
    """omega_3 = const is a solution: c1, for every ball, l < 0 included."""
    for moments in (("1/4", "1/3"), ("1/3", "1/4")):
        _, output = run(
            "--mass", "1", "--radius", "1", "--sphere", "1", "--A1", moments[0], "--A3", moments[1], "--json"
        )
        data = json.loads(output.out)
        assert "omega_3 = const is a solution" in data["theorem"]
        assert sp.diff(sp.parse_expr(data["omega_3"]).expand().coeff("c1"), X) == 0


@parametrize("ratio", ["3/2", "1/3", "-2/5", "1/2"], ordinary=0, long=2)
def test_command_prints_n_in_closed_form(run, ratio):
    """n and omega_3 as printed, read back, solve the linear equations in the roots; y solves (13)."""
    status, output = run("--ratio", ratio, "--json")
    data = json.loads(output.out)
    assert status == 0
    n, omega_3, y, S = (sp.parse_expr(data[name]) for name in ("n", "omega_3", "y", "S"))
    assert n.free_symbols == set(sp.symbols("x x1 x2 c1 c2 A1 A3"))
    values = {"x1": -3, "x2": -2, "A1": 2, "A3": 3}
    at = {X: sp.Rational(1, 7), "c1": 2, "c2": -5}
    a1, a2, b1, b2 = InRoots(sp.Rational(ratio)).linear_system
    for residual in (
        sp.diff(n, X) + a1 * n + a2 * omega_3,
        sp.diff(omega_3, X) + b1 * n + b2 * omega_3,
        sp.diff(y, X, 2) - S * y,
    ):
        assert abs(sp.N(residual.subs(values).subs(at), 30)) < 1e-25
    text = run("--ratio", ratio)[1].out
    for label in (
        "N = 2R/R1:",
        "theorem:",
        "equation (12):",
        "case:",
        "omega(x) = y'/y:",
        "group:",
        "y:",
        "omega_3:",
        "n:",
    ):
        assert label in text


def test_both_omegas_solve_the_riccati_equation(run):
    body = ("--mass", "1", "--radius", "1", "--offset", "1/5", "--A1", "1/4", "--A3", "1/3", "--sphere", "3")
    data = json.loads(run(*body, "--json")[1].out)
    S, *omegas = map(sp.parse_expr, (data["S"], *data["omega"]))
    assert len(omegas) == 2
    for omega in omegas:
        assert abs(sp.N((sp.diff(omega, X) + omega**2 - S).subs(X, sp.Rational(1, 7)), 30)) < 1e-25


@pytest.mark.long
def test_text_names_D_and_E(run):
    body = ("--mass", "1", "--radius", "1", "--offset", "1/5", "--A1", "1/4", "--A3", "1/3", "--sphere", "3")
    text = run(*body)[1].out
    assert "omega_3:            (c1*E**(1/3) + c2/E**(1/3))/sqrt(D)" in text
    assert json.loads(run(*body, "--json")[1].out)["omega_3"].count("x**2") == 3


@pytest.mark.long
def test_command_with_a_large_ratio(run):
    """Theorem 1 with N = 401: decided, and the solutions in powers instead of pages of coefficients."""
    status, output = run("--ratio", "401/2", "--json")
    data = json.loads(output.out)
    assert (status, data["case"], data["verified"]) == (0, 1, True)
    assert "(sqrt(x - x1) + sqrt(x - x2))**401" in data["omega_3"]


@pytest.mark.long
def test_command_with_an_irrational_ratio_and_latex(run):
    status, output = run("--ratio", "sqrt(2)", "--json", "--latex")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 2, "N(T)", True)
    assert set(data["latex"]) == {"a1", "a2", "b1", "b2", "11", "12", "13"}


@pytest.mark.long
def test_command_by_parameters(run):
    body = ("--mass", "1", "--radius", "2", "--offset", "1/5", "--A1", "1", "--A3", "4/3", "--sphere", "3")
    status, output = run(*body, "--json", "--latex", "--explain")
    data = json.loads(output.out)
    assert (status, data["case"], data["group"], data["verified"]) == (0, 2, "dicyclic of order 12", True)
    assert set(data["latex"]) == {"a1", "a2", "b1", "b2", "11", "12", "13"}
    assert data["derived"] is True
    assert r"K_{11} = " in data["derivation"]


@pytest.mark.long
def test_command_with_irrational_numbers(run):
    body = ("--mass", "sqrt(2)", "--radius", "sqrt(3)", "--sphere", "2*sqrt(3)", "--A1", "sqrt(2)", "--A3", "3/2")
    status, output = run(*body, "--json")
    data = json.loads(output.out)
    assert (status, data["ratio"], data["case"], data["verified"]) == (0, "1/2", 1, True)


_BALL = ("--mass", "1", "--radius", "1", "--sphere", "3")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((*_BALL, "--offset", "2", "--A1", "1/4", "--A3", "1/4"), "|a| <= R"),
        ((*_BALL, "--offset", "1/5"), "isn't homogeneous"),
        ((*_BALL, "--offset", "1/5", "--A1", "1/4"), "isn't homogeneous"),
        (("--mass", "1", "--radius", "1"), "either --ratio"),
        (("--ratio", "1", "--mass", "1"), "stands alone"),
        (("--ratio", "x"), "can't contain x"),
        (("--ratio", "nan"), "can't contain nan"),
        (("--ratio", "0"), "R/R1 = 0"),
        (("--mass", "-1", "--radius", "1", "--sphere", "1"), "m > 0 fails, as m = -1"),
        (("--mass", "1", "--radius", "0", "--sphere", "1"), "R > 0 fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "0"), "other than 0"),
        (("--mass", "1", "--radius", "1", "--sphere", "-1/2"), "R < |R1| fails"),
        (("--mass", "1", "--radius", "1", "--sphere", "1", "--A3", "2"), "A3 <= 2 A1 fails"),
        (("--mass", "one", "--radius", "1", "--sphere", "1"), "can't contain one"),
        ((*_BALL, "--plot", "a.gif"), "isn't one of"),
        ((*_BALL, "--plot", "/nowhere/a.png"), "there is no directory"),
        (("--ratio", "-3/2"), "R < |R1| fails"),
    ],
)
def test_command_refuses(run, arguments, message):
    status, output = run(*arguments)
    assert status == 2
    assert message in output.err


@pytest.mark.parametrize("text", ["print('executed') or 1#", "__import__('os').getcwd()"])
def test_text_is_never_executed(run, text):
    status, output = run("--ratio", text)
    assert (status, output.out) == (2, "")
    with pytest.raises(InputError):
        RollingBall(m=1, R=1, a="1/5", A1="1/4", A3="1/3").on_sphere(text)


@pytest.mark.parametrize("value", [0.1, sp.Float("0.1"), sp.nan, sp.zoo, -sp.oo, sp.I, True, None])
def test_bodies_refuse_what_is_not_exact_real_and_finite(value):
    possible = {"m": 1, "R": 1, "a": 0, "A1": "1/4", "A3": "1/4"}
    for name in possible:
        with pytest.raises(InputError):
            RollingBall(**{**possible, name: value})
    with pytest.raises(InputError):
        RollingBall(**possible).on_sphere(value)


_BODY = ("--mass", "1", "--radius", "1", "--offset", "1/5", "--A1", "1/4", "--A3", "1/3")


def simulated(run, *arguments):
    status, output = run(*arguments, "--simulate", "--json")
    assert status == 0, output.err
    return json.loads(output.out)["motion"]


@parametrize(
    "arguments",
    [
        (*_BALL, "--time", "1/2"),
        (*_BODY, "--sphere", "3", "--start", "1.41", "0.07", "0.85", "-0.14"),
        (*_BODY, "--sphere", "-11/10"),
        (*_BODY, "--sphere", "3", "--start", "3.1415", "0", "0", "0"),
        (*_BALL, "--start", "0.71", "-0.05", "0.17", "1.64"),
        (*_BODY, "--sphere", "3", "--start", "1", "0", "0", "0"),
        (*_BODY, "--sphere", "3", "--start", "1", "0", "0", "1e-6"),
        (*_BODY, "--sphere", "3", "--time", "3000"),
        (*_BODY, "--sphere", "plane", "--start", "0", "1", "1", "1"),
        (*_BODY, "--sphere", "-4", "--potential", "3/2*cos(u)", "--time", "sqrt(5)"),
    ],
    ordinary=1,
    long=3,
)
def test_command_follows_every_start(run, arguments):
    motion = simulated(run, *arguments)
    assert max(motion["difference"].values()) < 1e-11
    assert motion["energy_drift"] < 1e-11
    assert (motion["least_reaction"] is None) == ("--potential" in arguments)


def test_long_motions_are_sampled_in_every_oscillation(run):
    """The reaction vanishes first at t = 0.78; that is found up to a share of a period, not of the time."""
    start = (*_BODY, "--sphere", "3", "--start", "5/2", "2", "0", "0")
    short, long = (simulated(run, *start, "--time", time) for time in ("1", "150"))
    assert 0 < long["pulled_from"] - short["pulled_from"] + long["period"] / 1200 < long["period"] / 60


@pytest.mark.long
def test_command_says_what_happens(run, tmp_path):
    picture = tmp_path / "path.png"
    status, output = run(*_BODY, "--sphere", "3", "--time", "4", "--plot", str(picture))
    assert status == 0
    for label in ("potential:", "turning points:", "period:", "normal reaction:", "energy drift:", "picture:"):
        assert f"\n{label}" in output.out
    assert "pull" not in output.out
    assert picture.stat().st_size > 20_000
    _, output = run(*_BODY, "--sphere", "3", "--time", "4", "--start", "1", "5", "0", "0", "--simulate")
    assert "from t = 0 on it has to pull" in output.out
    _, output = run(*_BODY, "--sphere", "3", "--start", "0", "0", "0", "5", "--simulate")
    assert "steady motion:      u = 0 stays constant" in output.out


@parametrize(
    ("arguments", "message"),
    [
        (("--potential", "cos(w)"), "can't contain w"),
        (("--time", "nan"), "can't contain nan"),
        (("--time", "-1"), "must be positive"),
        (("--start", "inf", "1", "1", "1"), "can't contain inf"),
        (("--start", "4", "1", "1", "1"), "between 0 and pi"),
        (("--start", "1", "1e60", "1", "1"), "can start with"),
        (("--potential", "cos(u)", "--gravity", "1"), "either --gravity"),
        (("--plot", "a.gif"), "isn't one of"),
        (("--plot", "/nowhere/a.png"), "there is no directory"),
    ],
    ordinary=3,
)
def test_simulation_refuses(run, arguments, message):
    status, output = run(*_BALL, "--simulate", *arguments)
    assert status == 2
    assert message in output.err


def test_simulation_refuses_what_would_take_too_long(run):
    status, output = run(*_BALL, "--simulate", "--time", "1e9")
    assert status == 3
    assert "100000 oscillations" in output.err


@pytest.mark.long
def test_ctrl_c_during_a_simulation_is_status_130_and_leaves_no_picture(tmp_path):
    """A run of minutes, interrupted when it has begun to integrate; an older picture stays what it was."""
    picture, started = tmp_path / "path.png", tmp_path / "started"
    picture.write_bytes(b"an older one")
    script = f"""
import runpy
from pathlib import Path
from kovacic.ball import motion
solve_motion = motion.solve_motion
def marked(*arguments, **options):
    Path({str(started)!r}).touch()
    return [solve_motion(*arguments, **options) for _ in range(10000)]
motion.solve_motion = marked
runpy.run_module("kovacic", run_name="__main__")
"""
    arguments = ["ball", *_BODY, "--sphere", "3", "--simulate", "--time", "500", "--plot", str(picture)]
    process = subprocess.Popen(
        [sys.executable, "-c", script, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    while process.poll() is None and not started.exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=60)
    assert (process.returncode, output, errors) == (130, "", "kovacic: interrupted\n")
    assert picture.read_bytes() == b"an older one"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["path.png", "started"]

"""The two routes against each other, monodromy against exponents, double precision against proven values, pictures."""

from __future__ import annotations

import random
import warnings
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import kovacic
from kovacic.algebra.fields import QQ
from kovacic.algebra.ratfunc import RatFunc
from kovacic.cli.plot import plot_command
from kovacic.errors import InputError, LimitExceeded
from kovacic.limits import Limits
from kovacic.numeric.double_double import horner, two_product, two_sum
from kovacic.numeric.evaluate import AccuracyWarning, evaluate, evaluate_states
from kovacic.numeric.lambdify import lambdify, measure
from kovacic.numeric.monodromy import monodromy
from kovacic.numeric.plot import plot, sample
from kovacic.numeric.tabulate import tabulate
from kovacic.transform import from_omega, from_squared_difference

PRIMITIVE = {
    "tetrahedral": "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)",
    "octahedral": "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)",
    "icosahedral": "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)",
}


def agree(S: Any, *, x: Any, x0: Any, path: Any = None, digits: int = 25) -> None:
    solution = kovacic.solve(S)
    assert solution.case is not None
    results = [
        evaluate_states(solution, [x], x0=x0, y0=1, dy0=Fraction(-3, 7), digits=digits, method=method, path=path)[0]
        for method in ("taylor", "closed form")
    ]
    first, second = results
    assert first.y.overlaps(second.y)
    assert first.dy.overlaps(second.dy)
    assert first.reached
    assert second.reached
    assert second.method == "closed form"


@pytest.mark.parametrize(
    "S", ["x^2 + 3", "2", "-2", "2/x^2", "1 + 2/x^2", "1/(4*x^2)", "-1/(4*x^2)", "x^6 - 3*x^2", "x^2 - 21"]
)
@pytest.mark.parametrize("path", [None, [Fraction(3, 2) + 1]])
def test_case_1(S: str, path: Any) -> None:
    agree(S, x=Fraction(19, 7), x0=Fraction(3, 7), path=path)


@pytest.mark.parametrize("x", [0, "1e-20", -2, "0.5"])
def test_values_at_and_beyond_a_zero_of_the_closed_form(x: Any) -> None:
    agree("x^2 + 3", x=x, x0=2)  # y1 = x exp(x^2/2) vanishes at 0, an ordinary point


def test_initial_values_at_a_zero_of_the_closed_form() -> None:
    agree("x^2 + 3", x=1, x0=0)
    agree("x^2 - 7", x="1/3", x0=0)


@pytest.mark.parametrize(
    "S",
    ["(16*x - 3)/(16*x^2)", "(7*x^2 - 10)/(4*x^4 - 8*x^2 + 4)", "(-84*x^2 + 84*x - 75)/(400*x^4 - 800*x^3 + 400*x^2)"],
)
def test_case_2(S: str) -> None:
    agree(S, x=Fraction(19, 7), x0=Fraction(3, 7), path=[1 + 1j])
    agree(S, x=Fraction(3, 7), x0=Fraction(1, 7))


@pytest.mark.parametrize("name", sorted(PRIMITIVE))
def test_case_3(name: str) -> None:
    agree(PRIMITIVE[name], x=Fraction(19, 7), x0=Fraction(3, 7), path=[1 + 1j])
    agree(PRIMITIVE[name], x=Fraction(1, 2), x0=2, path=[1 - 1j], digits=60)


def random_solvable(rng: random.Random) -> RatFunc:
    """S of case 1 or 2 by construction."""
    x = RatFunc(QQ.poly([0, 1]))
    if rng.random() < 0.5:
        omega = RatFunc(QQ.poly([rng.randint(-2, 2)]))
        for _ in range(rng.randint(1, 3)):
            omega = omega + RatFunc(QQ.poly([Fraction(rng.randint(-3, 5), rng.choice([1, 2, 3]))])) / (
                x - rng.randint(-3, 3)
            )
        return from_omega(omega)
    num, den = QQ.poly([rng.choice([1, 2, -3]), rng.randint(-2, 2)]), QQ.poly([rng.randint(-3, 3), 1])
    return from_squared_difference(RatFunc(num, den))


def routes_agree_on(seed: int) -> None:
    rng = random.Random(seed)
    S = random_solvable(rng)
    x0, x = (Fraction(rng.randint(-40, 40), 13) + Fraction(1, 17) for _ in range(2))
    path = [complex(rng.randint(-3, 3), rng.choice([-1.5, 0.75, 2.25]))]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        agree(S, x=x, x0=x0, path=path, digits=12)


@pytest.mark.parametrize("seed", range(12))
def test_the_routes_agree_on_random_problems(seed: int) -> None:
    routes_agree_on(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(40))
def test_the_routes_agree_on_thousands_of_random_problems(block: int) -> None:
    for seed in range(1000 + 50 * block, 1050 + 50 * block):
        routes_agree_on(seed)


def test_an_equation_without_closed_form_says_so() -> None:
    with pytest.raises(InputError, match="needs a Liouvillian solution"):
        evaluate(kovacic.solve("x"), 1, x0=0, y0=1, dy0=0, method="closed form")
    assert evaluate(kovacic.solve("x"), 1, x0=0, y0=1, dy0=0).digits > 15


def test_a_quadrature_stops_at_the_time_limit() -> None:
    solution = kovacic.solve("-(10100*(1-x^2) + 1)/(1-x^2)^2")  # P has 100 zeros beside the path
    with pytest.raises(LimitExceeded, match="time limit"):
        evaluate(solution, "9/10", x0=0, y0=1, dy0=0, method="closed form", limits=Limits(seconds=0.5))


# --- monodromy -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "orders"), [("tetrahedral", {4, 6}), ("octahedral", {4, 6, 8}), ("icosahedral", {4, 6, 10})]
)
def test_finite_groups_have_monodromy_of_finite_order(name: str, orders: set[int]) -> None:
    for local in monodromy(PRIMITIVE[name]):
        assert local.consistent
        order = next(k for k in range(1, 61) if local.is_identity_to_the_power(k))
        assert any(k % order == 0 for k in orders), order
        assert not local.is_identity_to_the_power(order + 1) or order == 1


@pytest.mark.parametrize(
    "S", ["1/(x^2+1)^2 + x", "x/(x^3-x-1)^2 + 1/(x+2)", "1/x^3 + 1/(x-1)", "(3/4)/x^2 + 1", "-1/(4*x^2)"]
)
def test_traces_come_out_of_the_exponents(S: str) -> None:
    found = monodromy(S)
    assert found
    for local in found:
        assert local.consistent
        assert (local.trace is None) == (local.multiplicity > 2)


def test_a_logarithm_has_infinite_order_and_a_polynomial_has_no_monodromy() -> None:
    (local,) = monodromy("-1/(4*x^2)")
    assert not any(local.is_identity_to_the_power(k) for k in range(1, 30))
    assert monodromy("x^2 + 1") == ()


# --- double precision ------------------------------------------------------------------------------------------------


def test_double_doubles_are_exact_where_they_claim_it() -> None:
    rng = np.random.default_rng(1)
    a, b = (rng.normal(size=200) * 10.0 ** rng.integers(-9, 9, 200) for _ in range(2))
    for (hi, lo), exact in (
        (two_sum(a, b), [Fraction(p) + Fraction(q) for p, q in zip(a, b, strict=True)]),
        (two_product(a, b), [Fraction(p) * Fraction(q) for p, q in zip(a, b, strict=True)]),
    ):
        assert [Fraction(h) + Fraction(r) for h, r in zip(hi, lo, strict=True)] == exact
    hi, lo = horner(((1.0, 0.0), (-3.0, 0.0), (3.0, 0.0), (-1.0, 0.0)), np.array([1 + 2.0**-20]))
    assert abs(Fraction(float(hi[0])) + Fraction(float(lo[0])) - Fraction(2) ** -60) < Fraction(2) ** -96


@pytest.mark.parametrize(
    ("S", "interval"),
    [
        ("x^2 + 3", (-3, 5)),
        ("2", (0, 30)),
        ("1 + 2/x^2", (0, 9)),
        ("x^2 - 1", (0, 20)),
        ("x^2 - 101", (-5, 5)),
        ("-2/(9*x^2)", (0, 50)),
        ("(35*x^2 - 38)/(4*x^4 - 8*x^2 + 4)", (-1, 1)),
        ("(x^2 - 4*x + 8)/(4*x^2)", (0, 4)),
    ],
)
def test_the_double_precision_closed_form_keeps_its_promise(S: str, interval: tuple[int, int]) -> None:
    solution = kovacic.solve(S)
    function = lambdify(solution, interval=interval)  # warnings are errors here
    median, worst = measure(function, solution)
    assert median <= 8
    assert worst <= 1000


def test_the_closed_form_keeps_its_digits_close_to_a_zero_of_a_polynomial_factor() -> None:
    # H_10(x) exp(-x^2/2): relative accuracy at doubles next to a zero of H_10
    solution = kovacic.solve("x^2 - 21")
    function = lambdify(solution, interval=(-5, 5))
    zero = float(max(np.polynomial.hermite.hermroots([0] * 10 + [1])))
    points = np.array([0.1, *(zero + k * 2.0**-40 for k in range(-3, 4))])
    median, worst = measure(function, solution, points)
    assert worst <= 1000, (median, worst)


def test_huge_values_have_logarithms() -> None:
    function = lambdify(kovacic.solve("x^2 - 1"), interval=(0, 1000), check=False)
    sign, size = function.log(np.array([900.0]))
    assert sign[0] == 1
    assert size[0] == pytest.approx(-(900.0**2) / 2, rel=1e-14)
    assert function(np.array([900.0]))[0] == 0.0


def test_what_lambdify_cannot_do_it_refuses() -> None:
    with pytest.raises(InputError, match="case 1"):
        lambdify(kovacic.solve(PRIMITIVE["tetrahedral"]), interval=(2, 3))
    with pytest.raises(InputError, match="isn't real"):
        lambdify(kovacic.solve("-2"), interval=(0, 1))
    conjugate_poles = "9/(2*x^4 + 16*x^3 + 72*x^2 + 160*x + 200)"  # omega over Q(sqrt(-6))
    with pytest.raises(InputError, match="isn't real"):
        lambdify(kovacic.solve(conjugate_poles), interval=(-1, 1))
    with pytest.raises(InputError, match="singular point"):
        lambdify(kovacic.solve("2/x^2"), interval=(-1, 1))
    with pytest.raises(InputError, match="outside"):
        lambdify(kovacic.solve("2/x^2"), interval=(1, 2))(np.array([3.0]))


def test_a_table_of_a_solution_without_closed_form() -> None:
    table = tabulate("x", -6, 2, x0=0, y0=1, dy0=-1)
    points = np.linspace(-6, 2, 37)
    balls = evaluate("x", [float(p) for p in points], x0=0, y0=1, dy0=-1)
    exact = np.array([float(ball) for ball in balls])
    assert np.max(np.abs(table(points) - exact)) < 4e-15 * np.max(np.abs(exact))
    with pytest.raises(InputError, match="outside"):
        table(np.array([2.5]))


# --- pictures --------------------------------------------------------------------------------------------------------


def test_samples_are_cut_at_singular_points_and_complex_beyond() -> None:
    samples = sample("-1/(4*x^2) - 3", -2, 2, x0=1, points=40)
    left, right = samples.runs
    assert all(result.x.re < 0 for result in left)
    assert all(result.y.real for result in right)
    assert not any(result.y.real for result in left)


def test_a_plot_is_a_figure_of_its_own() -> None:
    import matplotlib

    backend = matplotlib.get_backend()
    figure = plot("x", -3, 1, points=20)
    (line, *_rest) = figure.axes[0].lines
    assert len(line.get_xdata()) == 20
    assert matplotlib.get_backend() == backend


def test_the_plot_command_writes_a_picture(tmp_path: Path) -> None:
    target = tmp_path / "curve.png"
    run = CliRunner().invoke(
        plot_command, ["-1/x^2 + 2", "--from", "-1", "--to", "3/2", "--points", "30", "-o", str(target)]
    )
    assert run.exit_code == 0, run.output
    assert target.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    "arguments",
    [
        ["x", "--from", "2", "--to", "1", "-o", "a.png"],
        ["x", "--from", "1", "--to", "2", "-o", "a.exe"],
        ["x+", "--from", "1", "--to", "2", "-o", "a.png"],
        ["x", "--from", "nan", "--to", "2", "-o", "a.png"],
    ],
)
def test_the_plot_command_refuses_wrong_input(arguments: list[str]) -> None:
    run = CliRunner().invoke(plot_command, arguments)
    assert run.exit_code in (1, 2)
    assert "Error" in run.output
    assert "Traceback" not in run.output

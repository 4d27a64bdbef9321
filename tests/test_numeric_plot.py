"""The two routes against each other, monodromy against exponents, double precision against proven values, pictures."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import kovacic
from kovacic.cli.plot import plot_command
from kovacic.errors import InputError
from kovacic.numeric.double_double import horner, two_product, two_sum
from kovacic.numeric.evaluate import evaluate
from kovacic.numeric.lambdify import lambdify, measure
from kovacic.numeric.plot import plot, sample
from kovacic.numeric.tabulate import tabulate

PRIMITIVE = {
    "tetrahedral": "(-32*x^2 + 27*x - 27)/(144*x^4 - 288*x^3 + 144*x^2)",
    "octahedral": "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)",
    "icosahedral": "(-864*x^2 + 739*x - 675)/(3600*x^4 - 7200*x^3 + 3600*x^2)",
}


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

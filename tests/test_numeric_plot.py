"""Pictures of solutions: what is drawn, what is marked, what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from kovacic.cli.plot import plot_command
from kovacic.numeric.plot import plot, sample


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

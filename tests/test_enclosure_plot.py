"""Pictures of solutions: what is drawn, what is marked, what is refused."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import pytest

from kovacic.cli.main import run
from kovacic.enclosure.ball import Ball
from kovacic.enclosure.points import Point
from kovacic.views.plot import plot, sample


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


def test_the_error_band_is_drawn_where_it_is_visible_and_a_vanishing_imaginary_part_is_not() -> None:
    wide = plot("x", -3, 1, x0=-1, y0=Ball((1, 0), rad=(1, -4)), points=20)
    assert [text.get_text() for text in wide.axes[0].get_legend().get_texts()] == ["y", "error band"]
    around = plot("2/x^2", -2, 3, points=40)  # real on both sides, as far as the enclosures tell
    assert [text.get_text() for text in around.axes[0].get_legend().get_texts()] == ["y", "singular point"]


def test_the_plot_command_writes_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "curve.png"
    assert run(["plot", "-1/x^2 + 2", "--from", "-1", "--to", "3/2", "--points", "30", "-o", str(target)]) == 0
    assert target.read_bytes()[:4] == b"\x89PNG"
    assert capsys.readouterr().out == f"wrote {target}\n"


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["x", "--from", "2", "--to", "1", "-o", "a.png"], 2, "empty"),
        (["x", "--from", "1", "--to", "2", "-o", "a.exe"], 2, ".exe"),
        (["x", "--from", "1", "--to", "2", "-o", "no/such/place/a.png"], 2, "no directory"),
        (["x+", "--from", "1", "--to", "2", "-o", "a.png"], 2, "ends after"),
        (["x", "--from", "nan", "--to", "2", "-o", "a.png"], 2, "from isn't"),
        (["1/x", "--from", "-1", "--to", "2", "--x0", "0", "-o", "a.png"], 2, "singular point"),
        (["x", "--from", "0", "--to", "100000", "-o", "a.png", "--limit", "seconds=0.2"], 3, "time limit"),
    ],
)
def test_the_plot_command_refuses_wrong_input(
    arguments: list[str], status: int, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["plot", *arguments]) == status
    assert words in capsys.readouterr().err


def test_without_matplotlib_the_command_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    for name in [name for name in sys.modules if name.split(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert run(["plot", "x", "--from", "0", "--to", "1", "-o", str(tmp_path / "a.png")]) == 2
    assert "pip install 'kovacic[plot]'" in capsys.readouterr().err


def test_ctrl_c_ends_the_command_without_a_picture(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("kovacic.doubles.chart.evaluate_states", interrupted)
    assert run(["plot", "x", "--from", "0", "--to", "1", "-o", str(tmp_path / "a.png")]) == 130
    assert not (tmp_path / "a.png").exists()


def test_a_pole_of_the_gauge_is_a_singular_point() -> None:
    """Bessel's equation of order 1/2 has the normal form y'' = -y: 0 is singular for the equation alone."""
    samples = sample("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", -2, 2, points=20)
    assert samples.singular == (0,)
    assert len(samples.runs) == 2


def test_a_picture_of_an_equation_with_an_algebraic_constant() -> None:
    """y'' = 2^(1/2) y: cosh(2^(1/4) x)."""
    (run,) = sample("sqrt(2)", -1, 2, x0=0, points=20).runs
    for result in run:
        assert isinstance(result.x, Point)
        assert float(result.y) == pytest.approx(math.cosh(2**0.25 * float(result.x.re)), rel=1e-7)

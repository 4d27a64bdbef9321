"""Pictures of solutions: what is drawn, what is marked, what is refused."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy
from build import parametrize, run, sample
from clocks import interrupted

import kovacic
from kovacic import Ball


def test_samples_are_cut_at_singular_points_and_complex_beyond() -> None:
    curve = sample("-1/(4*x^2) - 3", -2, 2, x0=1, points=40)
    (left,), (right,) = curve.runs
    assert left.x.max() < 0 < right.x.min()
    assert not np.any(np.abs(right.y.imag) > right.radius)
    assert np.all(np.abs(left.y.imag) > left.radius)


def test_a_plot_is_a_figure_of_its_own() -> None:
    import matplotlib

    backend = matplotlib.get_backend()
    figure = plot("x", -3, 1, points=20)
    (line, *_rest) = figure.axes[0].lines
    assert len(line.get_xdata()) >= 20
    assert matplotlib.get_backend() == backend


def plot(equation: str, start: Any, stop: Any, **options: Any) -> Any:
    return kovacic.solve(equation).plot(start, stop, **options)


def legend(figure: Any) -> list[str]:
    (box,) = figure.legends
    return [text.get_text() for text in box.get_texts()]


@pytest.mark.long
def test_the_error_band_is_drawn_where_it_is_visible_and_a_vanishing_imaginary_part_is_not() -> None:
    wide = plot("x", -3, 1, x0=-1, y0=Ball((1, 0), rad=(1, -4)), points=20)
    assert legend(wide)[1:] == ["error band"]
    around = plot("2/x^2", -2, 3, x0="1/2", y0=1, points=40)  # real on both sides, as far as the enclosures tell
    assert len(legend(around)) == 2
    assert legend(around)[1] == "singular point"


x = sympy.Symbol("x", positive=True)


def random_solution(random: Random) -> tuple[str, sympy.Expr, Fraction, Fraction]:
    """An equation, one of its solutions, and an interval: from a tenth of a period to some thousands of them."""
    low = Fraction(random.randint(1, 30), 10)
    high = low + Fraction(random.randint(5, 80), 10)
    k = sympy.Rational(random.randint(1, 10 ** random.randint(1, 4)), random.randint(1, 9))
    d = sympy.Rational(random.randint(-3, 3), 10)
    kind = random.choice(["damped", "Euler", "Fresnel", "growing"])
    if kind == "damped":
        return f"y'' + ({2 * d})*y' + ({d**2 + k**2})*y = 0", sympy.exp(-d * x) * sympy.sin(k * x), low, high
    if kind == "Euler":
        return f"-({k**2} + 1/4)/x^2", sympy.sqrt(x) * sympy.sin(k * sympy.log(x)), low, high
    if kind == "Fresnel":
        c = k / 20
        return f"3/(4*x^2) - {4 * c**2}*x^2", sympy.sin(c * x**2) / sympy.sqrt(x), low, high
    small = k / 1000
    return f"{small**2}", sympy.sinh(small * (x - 2)), low, high


def difference(random: Random) -> float:
    """By how much a picture differs from its solution, over the solution's largest value.

    For an envelope: by how much the solution leaves it, or by how much it stays away from it.
    """
    equation, y, low, high = random_solution(random)
    middle = sympy.Rational((low + high) / 2)
    y0, dy0 = (str(sympy.N(f.subs(x, middle), 40)) for f in (y, y.diff(x)))
    curve = sample(equation, low, high, x0=str(middle), y0=y0, dy0=dy0)
    truth = sympy.lambdify(x, y, "numpy")
    largest = np.abs(truth(np.linspace(float(low), float(high), 20_000))).max()
    worst = 0.0
    for arc in curve.arcs:
        at, drawn = arc.drawn()
        places = np.array([random.uniform(at[0], at[-1]) for _ in range(500)])
        worst = max(worst, np.abs(np.interp(places, at, drawn.real) - truth(places)).max() / largest)
    for envelope in curve.envelopes:
        places = np.array([random.uniform(envelope.x[0], envelope.x[-1]) for _ in range(500)])
        share = np.abs(truth(places)) / np.interp(places, envelope.x, envelope.real)
        worst = max(worst, share.max() - 1, 0.9 - share.max())
    return float(worst)


@pytest.mark.long
@pytest.mark.parametrize(
    ("seed", "count"), [pytest.param(1, 12), pytest.param(2, 200, marks=pytest.mark.slow)], ids=["some", "many"]
)
def test_the_line_is_the_solution_or_the_envelope_is_shown(seed: int, count: int) -> None:
    random = Random(seed)
    assert max(difference(random) for _ in range(count)) < 0.02


@pytest.mark.long
@pytest.mark.parametrize(
    ("equation", "stop", "periods"), [("-10000", 20, 318), ("y'' + 10000*y = 0", 7, 111), ("-400*x^2", 40, 2546)]
)
def test_an_oscillation_that_a_page_cannot_show_is_an_envelope_and_the_legend_says_so(
    equation: str, stop: int, periods: int
) -> None:
    figure = plot(equation, 0, stop, x0=0, y0=0, dy0=100)
    said = [text for text in legend(figure) if "oscillations" in text]
    if periods < 125:
        assert not said
        return
    (text,) = said
    count = float(text.split("envelope of ")[1].split()[0].replace(",", ""))
    assert 0.9 * periods < count <= 1.01 * periods


@pytest.mark.long
def test_the_legend_says_which_solution_is_drawn() -> None:
    """Values without a place are those at the left end, as in initial value problems; there must be one."""
    waves = "y'' + y'/10 + y = 0"
    figure = plot(waves, 0, 20, y0=1, points=20)
    assert legend(figure) == ["y, where y(0) = 1, y'(0) = 0"]
    assert figure.axes[0].lines[0].get_ydata()[0] == pytest.approx(1)
    assert legend(plot("x^3 + 1", 0, 2, points=20)) == ["y, where y(1) = 1, y'(1) = 0"]  # no solution is known
    assert legend(plot(waves, 0, 9, x0=3, y0="1/3", dy0="sqrt(2)", points=20)) == [
        "y, where y(3) = 1/3, y'(3) = sqrt(2)"
    ]
    bessel = "x^2*y'' + x*y' + x^2*y = 0"
    assert legend(plot(bessel, 0, 9, x0=0, which="regular", points=20))[0] == "y, regular at 0"
    with pytest.raises(kovacic.InputError, match="the values need a place: 0, the left end, is a singular point"):
        plot(bessel, 0, 9, y0=1)


@pytest.mark.long
def test_both_solutions_of_a_solved_equation_are_drawn_and_named() -> None:
    figure = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0").plot(1, 9)
    assert legend(figure) == ["y1 = cos(x)/sqrt(x)", "y2 = sin(x)/sqrt(x)"]
    assert figure.axes[0].get_title() == "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0"
    for line, y in zip(figure.axes[0].lines, (np.cos, np.sin), strict=False):
        at = line.get_xdata()
        assert np.abs(line.get_ydata() - y(at) / np.sqrt(at)).max() < 1e-3
    special = kovacic.solve("x").plot(-12, 6)
    assert legend(special) == ["y1 = airyai(x)", "y2 = airybi(x)"]
    decaying = special.axes[0].lines[0]
    assert 0 < decaying.get_ydata()[-1] < 1e-4


@pytest.mark.long
def test_a_growing_solution_leaves_the_rest_to_be_seen() -> None:
    axes = kovacic.solve("x^2 + 3").plot(-6, 6).axes[0]
    assert axes.get_yscale() == "function"
    assert "logarithmic beyond" in axes.get_ylabel()
    assert kovacic.solve("-1").plot(0, 9).axes[0].get_yscale() == "linear"


@pytest.mark.long
def test_the_plot_command_writes_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "curve.png"
    assert run(["plot", "-1/x^2 + 2", "--from", "-1", "--to", "3/2", "--points", "30", "-o", str(target)]) == 0
    assert target.read_bytes()[:4] == b"\x89PNG"
    assert capsys.readouterr().out == f"wrote {target}\n"


@parametrize(
    ("arguments", "status", "words"),
    [
        (["x", "--from", "2", "--to", "1", "-o", "a.png"], 2, "empty"),
        (["x", "--from", "1", "--to", "2", "-o", "a.exe"], 2, ".exe"),
        (["x", "--from", "1", "--to", "2", "-o", "no/such/place/a.png"], 2, "no directory"),
        (["x+", "--from", "1", "--to", "2", "-o", "a.png"], 2, "ends after"),
        (["x", "--from", "nan", "--to", "2", "-o", "a.png"], 2, "from isn't"),
        (["1/x", "--from", "-1", "--to", "2", "--x0", "0", "-o", "a.png"], 2, "singular point"),
        (["x", "--from", "0", "--to", "100000", "-o", "a.png"], 3, "beyond the range of doubles"),
        (["x^3+x", "--from", "-90", "--to", "90", "-o", "a.png", "--limit", "seconds=0.001"], 3, "time limit"),
    ],
    ordinary=3,
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
    assert "pip install 'matplotlib" in capsys.readouterr().err


def test_ctrl_c_ends_the_command_without_a_picture(tmp_path: Path) -> None:
    with interrupted(20):
        assert run(["plot", "x", "--from", "0", "--to", "1", "-o", str(tmp_path / "a.png")]) == 130
    assert not (tmp_path / "a.png").exists()


def test_a_pole_of_the_gauge_is_a_singular_point() -> None:
    """Bessel's equation of order 1/2 has the normal form y'' = -y: 0 is singular for the equation alone."""
    curve = sample("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", -2, 2, points=20)
    assert curve.singular == (0,)
    assert len(curve.runs) == 2


def test_a_picture_of_an_equation_with_an_algebraic_constant() -> None:
    """y'' = 2^(1/2) y: cosh(2^(1/4) x)."""
    (arc,) = sample("sqrt(2)", -1, 2, x0=0, points=20).arcs
    assert np.abs(arc.y.real / np.cosh(2**0.25 * arc.x) - 1).max() < 1e-7


@pytest.mark.long
def test_the_legend_says_which_solution_is_drawn_and_the_title_which_equation() -> None:
    figure = plot("x", -3, 1, y0=2, points=20)
    assert legend(figure) == ["y, where y(-3) = 2, y'(-3) = 0"]
    assert figure.axes[0].get_title() == "y'' = x y"
    assert legend(plot("x^2*y'' + x*y' + x^2*y = 0", 0, 5, x0=0, which="regular", points=20))[0] == "y, regular at 0"
    assert legend(plot("-1", 0, 5, x0=0, frobenius=(1, 2), points=20)) == ["y = (1) y1 + (2) y2, Frobenius' basis at 0"]


@pytest.mark.long
def test_no_entry_of_a_legend_leaves_the_picture() -> None:
    figure = kovacic.solve("y'' + y'/10 + 400*y = 0").plot(0, 60)
    figure.draw_without_rendering()
    (box,) = figure.legends
    extent = box.get_window_extent()
    assert extent.x0 >= 0
    assert extent.x1 <= figure.bbox.x1


@pytest.mark.parametrize("stop", [9, 600])
def test_the_axis_of_a_growing_solution_has_an_inverse_and_no_corner(stop: int) -> None:
    """cosh(x), up to 4,000 and up to 10^260."""
    (axes,) = plot("1", 0, stop, x0=0, y0=1, dy0=0, points=20).axes
    assert axes.get_yscale() == "function"
    forward = axes.yaxis.get_transform()
    largest = np.cosh(stop)
    y = np.array([-largest, -1.0, -0.3, 0.0, 0.5, 0.9, 7.0, largest])
    assert forward.inverted().transform(forward.transform(y)) == pytest.approx(y, rel=1e-9)
    sizes = np.geomspace(1e-3, largest, 5000)
    heights = forward.transform(sizes)
    assert heights[-1] < 4
    slopes = np.diff(heights) / np.diff(sizes)
    assert (slopes > 0).all()
    assert stop > 9 or (slopes[1:] / slopes[:-1] > 0.9).all()

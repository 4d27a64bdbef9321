"""Pictures of solutions: what is drawn, what is marked, what is refused."""

from __future__ import annotations

import re
import sys
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy
from build import parametrize, run, sample
from clocks import interrupted
from matplotlib.lines import Line2D

import kovacic
from kovacic import Ball
from kovacic.reading.symbolic import read_expression


def test_samples_are_cut_at_singular_points_and_complex_beyond() -> None:
    curve = sample("-1/(4*x^2) - 3", -2, 2, x0=1, points=40)
    left, right = curve.arcs
    assert left.x.max() < 0 < right.x.min()
    assert not np.any(np.abs(right.y.imag) > right.radius)
    assert np.all(np.abs(left.y.imag) > left.radius)


def test_without_a_start_the_middle_of_the_longest_interval_has_the_values() -> None:
    assert sample("1/x", -2, 4, points=10).initial.x0 == 2


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
        share = np.abs(truth(places)) / np.interp(places, envelope.x, envelope.size.real)
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
    assert legend(figure) == [r"$y$, where $y(0) = 1,\ y'(0) = 0$"]
    assert figure.axes[0].lines[0].get_ydata()[0] == pytest.approx(1)
    assert legend(plot("x^3 + 1", 0, 2, points=20)) == [r"$y$, where $y(1) = 1,\ y'(1) = 0$"]  # no solution is known
    assert legend(plot(waves, 0, 9, x0=3, y0="1/3", dy0="sqrt(2)", points=20)) == [
        r"$y$, where $y(3) = \frac{1}{3},\ y'(3) = \sqrt{2}$"
    ]
    bessel = "x^2*y'' + x*y' + x^2*y = 0"
    assert legend(plot(bessel, 0, 9, x0=0, which="regular", points=20))[0] == "$y$ regular at $x = 0$"
    with pytest.raises(kovacic.InputError, match="the values need a place: 0, the left end, is a singular point"):
        plot(bessel, 0, 9, y0=1)


@pytest.mark.long
def test_both_solutions_of_a_solved_equation_are_drawn_and_named() -> None:
    figure = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0").plot(1, 9)
    assert legend(figure) == [
        r"$y_1 = \frac{\cos{\left(x \right)}}{\sqrt{x}}$",
        r"$y_2 = \frac{\sin{\left(x \right)}}{\sqrt{x}}$",
    ]
    assert figure.axes[0].get_title() == r"$x^{2} y'' + x y' + \left(x^{2} - \dfrac{1}{4}\right) y = 0$"
    for line, y in zip(figure.axes[0].lines, (np.cos, np.sin), strict=False):
        at = line.get_xdata()
        assert np.abs(line.get_ydata() - y(at) / np.sqrt(at)).max() < 1e-3
    special = kovacic.solve("x").plot(-12, 6)
    assert legend(special) == [r"$y_1 = Ai\left(x\right)$", r"$y_2 = Bi\left(x\right)$"]
    decaying = special.axes[0].lines[0]
    assert 0 < decaying.get_ydata()[-1] < 1e-4


@pytest.mark.long
def test_a_growing_solution_leaves_the_rest_to_be_seen() -> None:
    """Bi outgrows the waves from which it comes, and 1/x is as large as one comes near to 0."""
    for equation, start, stop, height in (("x", -12, 3, 0.536), ("2/x^2", -2, 3, 9), ("x^2 - 7", -6, 6, 2.1)):
        axes = kovacic.solve(equation).plot(start, stop).axes[0]
        assert axes.get_yscale() == "linear"
        assert axes.get_ylim()[1] == pytest.approx(1.1 * height, rel=0.01)
        assert f"(cut off at {height:.2g})" in axes.get_ylabel()


@parametrize(
    ("equation", "stop", "options"),
    [
        ("1", 9, {"x0": 0}),  # cosh
        ("1", 600, {"x0": 0}),  # up to 10^260
        ("y'' + (1 + 2/5*cos(2*x))*y = 0", 60, {"x0": 0}),  # parametric resonance
        ("-1", 9, {}),
        ("x^2*y'' + x*y' + x^2*y = 0", 60, {}),
    ],
    ordinary=1,
    long=1,
)
def test_what_grows_evenly_is_drawn_whole_on_a_linear_axis(equation: str, stop: int, options: dict[str, Any]) -> None:
    axes = plot(equation, "1/10" if "x^2" in equation else 0, stop, **options).axes[0]
    assert axes.get_yscale() == "linear"
    assert axes.get_ylabel() == "$y$"
    low, high = axes.get_ylim()
    for line in axes.lines:
        if not line.get_label().startswith("_"):
            assert low < line.get_ydata().min() <= line.get_ydata().max() < high


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
    long=(1, 6),
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
    assert len(curve.parts) == 2


def test_a_picture_of_an_equation_with_an_algebraic_constant() -> None:
    """y'' = 2^(1/2) y: cosh(2^(1/4) x)."""
    (arc,) = sample("sqrt(2)", -1, 2, x0=0, points=20).arcs
    assert np.abs(arc.y.real / np.cosh(2**0.25 * arc.x) - 1).max() < 1e-7


@pytest.mark.long
def test_the_legend_says_which_solution_is_drawn_and_the_title_which_equation() -> None:
    figure = plot("x", -3, 1, y0=2, points=20)
    assert legend(figure) == [r"$y$, where $y(-3) = 2,\ y'(-3) = 0$"]
    assert figure.axes[0].get_title() == "$y'' = x y$"
    assert (
        legend(plot("x^2*y'' + x*y' + x^2*y = 0", 0, 5, x0=0, which="regular", points=20))[0]
        == "$y$ regular at $x = 0$"
    )
    assert legend(plot("-1", 0, 5, x0=0, frobenius=(1, 2), points=20)) == [
        "$y$ = (1) $y_1$ + (2) $y_2$ of the Frobenius basis at $x = 0$"
    ]


@pytest.mark.long
def test_no_entry_of_a_legend_leaves_the_picture() -> None:
    figure = kovacic.solve("y'' + y'/10 + 400*y = 0").plot(0, 60)
    figure.draw_without_rendering()
    (box,) = figure.legends
    extent = box.get_window_extent()
    assert extent.x0 >= 0
    assert extent.x1 <= figure.bbox.x1


#: Special functions as SymPy writes them in LaTeX.
_SPECIAL = {
    "Ai": sympy.airyai,
    "Bi": sympy.airybi,
    "J_{0}": partial(sympy.besselj, 0),
    "Y_{0}": partial(sympy.bessely, 0),
    "K": sympy.elliptic_k,
}


def formula_of(latex: str) -> Any:
    """The SymPy expression of a formula in a legend, in which a special function occurs once at most."""
    for name, function in _SPECIAL.items():
        before, found, rest = latex.partition(rf"{name}\left(")
        if found:
            argument, _, after = rest.rpartition(r"\right)")
            place = sympy.Symbol("w")
            return formula_of(f"{before} w {after}").subs(place, function(formula_of(argument)))
    return read_expression(latex)


def demand_what_the_label_says(label: str, at: Any, drawn: Any, variable: sympy.Symbol) -> bool:
    """Read the label of a line, evaluate it, and compare it with the line's data; False without anything to compare."""
    part = {"Re": np.real, "Im": np.imag}.get(label[:2], lambda values: values)
    size = np.abs(drawn).max()
    found = re.search(r"\$[a-z]_[12] = (.*)\$", label)
    if found is not None:
        formula = formula_of(found[1])
        for k in np.linspace(0, len(at) - 1, 7).astype(int):
            value = complex(sympy.N(formula.subs(variable, float(at[k]))))
            assert abs(part(value) - drawn[k]) < 1e-3 * size + 1e-9, (label, at[k])
        return True
    found = re.search(r"\$[a-z](\\left)?\((.*?)(\\right)?\) = (.*?)(,\\ [a-z]'.* = (.*))?\$", label)
    if found is None:
        return False
    place, value, slope = (float(sympy.N(formula_of(found[k]))) for k in (2, 4, 6))
    near = np.argsort(np.abs(at - place))[:2]
    if np.abs(at[near[0]] - place) > 0.1:  # on another stretch
        return True
    low, high = sorted(near)
    slope_drawn = (drawn[high] - drawn[low]) / (at[high] - at[low])
    scale = max(1.0, np.abs(np.gradient(drawn, at)).max())
    assert part(complex(value)) == pytest.approx(np.interp(place, at, drawn), abs=2e-3 * size + 1e-9), label
    assert part(complex(slope)) == pytest.approx(slope_drawn, abs=0.1 * scale), label
    return True


_RIGHT_HAND_SIDES = ["x", "exp(-x^2)", "1/(2 + cos(x))", "x^2 - 1", "cos(3*x)"]
_LEFT_HAND_SIDES = ["y'' + y", "y'' + y'/5 + 2*y", "x^2*y'' + x*y' + x^2*y", "y'' - x*y"]
#: What is drawn, from where to where, and the number of real lines that there have to be, if it matters.
PICTURES: list[tuple[str, Any, Any, int | None]] = [
    *((f"{left} = {right}", "1/2", 7, 1) for left in _LEFT_HAND_SIDES for right in _RIGHT_HAND_SIDES),
    *(
        (f"y'' + {f}*y = 0", "-9/10", "9/10", None)
        for f in ("exp(x)", "tan(x)", "cos(x)", "sinh(x)", "exp(-2*x)", "tanh(x)")
    ),
    ("y'' + exp(x)*y = x", 0, 3, 1),
    ("x^2 + 3", -2, 2, 2),
    ("-1/(4*x^2) - 3", -2, 2, 2),
    ("-1/x - 3/(16*x^2)", -3, 30, 2),
    ("2/x^2", -2, 3, 2),
    ("4*x^2*y'' + y = 0", -2, 4, 2),
    ("x*(1-x)*y'' + (1-2*x)*y' - y/4 = 0", -1, 2, None),
    ("(1-x^2)*y'' - 2*x*y' + 6*y = 0", -3, 3, 2),
    ("x", -12, 2, 2),
    ("x^2*y'' + x*y' + x^2*y = 0", 1, 40, 2),
    ("u''(t) + 4*u(t) = 0", 0, 5, 2),
    ("-3/16/x^2 - 2/9/(x-1)^2 + 3/16/(x*(x-1))", 0, 1, 2),  # tetrahedral
    ("x^2*y'' + x*y' + (x^2+1)*y = 0", "1/100", 10, 2),
    ("x^3", -4, 2, 2),
    ("sqrt(2)", -1, 2, 2),
    ("y''+(1+2/5*cos(2*x))*y=0", 0, 9, 1),  # no spaces around the signs of a fraction
    ("y''+100*y'+y=0", 0, 5, 2),  # one of the two is 10^109 times as large as the other
    ("x^2/4 - 7", -7, 7, 2),  # a formula that matplotlib doesn't set
    ("(1-x^2)*y'' - 2*x*y' + 20*y = 0", -1, 1, 2),  # the second one is 170 times as large
]


@parametrize(("equation", "start", "stop", "count"), PICTURES, ordinary=(11, 22, 33), long=(27, 32, 39, 40, 43, 44))
def test_a_picture_shows_what_its_labels_say(equation: str, start: Any, stop: Any, count: int | None) -> None:
    """The title is the equation in the variable of the axis, each entry of the legend has the data of its line."""
    answer = kovacic.solve(equation)
    figure = answer.plot(start, stop)
    (axes,) = figure.axes
    variable = axes.get_xlabel().strip("$")
    again = kovacic.solve(axes.get_title().strip("$"), var=variable)
    assert again.S == answer.S
    is_homogeneous = answer.equation is None or answer.equation.is_homogeneous
    assert is_homogeneous == (again.equation is None or again.equation.is_homogeneous)
    named: dict[str, list[Any]] = {}
    for line in axes.lines:
        if line.get_label() == "singular point":
            break
        if line.get_label() == "_":  # beyond a singular point
            list(named.values())[-1].append(line)
        elif not line.get_label().startswith("_"):
            named[line.get_label()] = [line]
    assert count is None or len(named) == count
    data = []
    for label, parts in named.items():
        assert r"\$" not in label
        at, drawn = (
            np.concatenate([np.asarray(get(part)) for part in parts]) for get in (Line2D.get_xdata, Line2D.get_ydata)
        )
        assert demand_what_the_label_says(label, at, drawn, sympy.Symbol(variable)) or is_homogeneous
        data.append(drawn)
    if len(data) == 2 and len(data[0]) == len(data[1]):
        assert np.linalg.matrix_rank(np.stack(data), tol=1e-6 * np.abs(data[0]).max()) == 2


@pytest.mark.long
@pytest.mark.parametrize("a", ["4", "1/4", "sqrt(2)"])
def test_solutions_with_values_of_parameters_are_named_with_these(a: str) -> None:
    figure = kovacic.solve("y'' + a*y = 0").plot(0, 7, params={"a": a})
    lines = [line for line in figure.axes[0].lines if line.get_label().startswith("$y_")]
    assert len(lines) == 2
    for line in lines:
        assert demand_what_the_label_says(line.get_label(), line.get_xdata(), line.get_ydata(), sympy.Symbol("x"))
    (line, *_) = kovacic.solve("y'' + a*y = 0").plot(0, 7, params={"a": 0}).axes[0].lines  # where sin(sqrt(a) x) is 0
    assert line.get_label().startswith("$y$, where")


def test_the_envelope_of_bessels_functions_is_their_amplitude() -> None:
    """Between its points, too: near 1, where it falls as 1/sqrt(x), they are near to each other."""
    from scipy.special import hankel1

    bessel = "x^2*y'' + x*y' + x^2*y = 0"
    values = {"y0": "0.765197686557966551449717526103", "dy0": "-0.440050585744933515959682203719"}
    (envelope,) = sample(bessel, 1, 2000, x0=1, **values).envelopes
    assert envelope.x[-1] == 2000
    at = np.geomspace(1.5, 2000, 400)
    assert np.interp(at, envelope.x, envelope.size.real) == pytest.approx(np.abs(hankel1(0, at)), rel=0.1)
    assert np.interp(at[100:], envelope.x, envelope.size.real) == pytest.approx(np.abs(hankel1(0, at[100:])), rel=0.02)

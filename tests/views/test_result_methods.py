"""The methods of an answer that import their part of the package when they are called."""

from __future__ import annotations

import json
import pickle
import shlex
import subprocess
import sys
import tomllib
import warnings
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import sympy
from build import parametrize
from clocks import controlled
from flint import arb

import kovacic
from kovacic.enclosure.request import Start


def test_values_of_a_solution_by_its_own_method() -> None:
    answer = kovacic.solve("x^2 + 3")
    value = answer.at(2, x0=1, y0=1, dy0=0, digits=30)
    assert value == kovacic.evaluate("x^2 + 3", 2, x0=1, y0=1, dy0=0, digits=30) or value.overlaps(
        kovacic.evaluate("x^2 + 3", 2, x0=1, y0=1, dy0=0, digits=30)
    )
    assert len(answer.at([2, 3], x0=1, y0=1, dy0=0)) == 2


@pytest.mark.long
def test_a_vectorised_function_and_a_figure() -> None:
    answer = kovacic.solve("x^2 + 3")
    f = answer.lambdify(interval=(1, 3))
    ratio = f([2.0])[0] / f([1.5])[0]
    assert ratio == pytest.approx(2 / 1.5 * 2.718281828459045 ** ((4 - 2.25) / 2), rel=1e-12)
    figure = answer.plot(1, 2, x0=1, points=20)
    assert figure.axes[0].get_xlabel() == "$x$"


def test_an_answer_pickles_after_its_parts_were_used() -> None:
    answer = kovacic.solve("1/x - 3/(16*x^2)")
    assert len(answer.solutions) == 2
    assert str(answer.group)
    copy = pickle.loads(pickle.dumps(answer))
    assert copy == answer
    assert copy.verify()
    assert copy.solutions == answer.solutions


def test_the_interpreter_shows_the_verdict() -> None:
    assert repr(kovacic.solve("x^2 + 3")) == "<Solution of y'' = (x^2 + 3) y: case 1, omega = (x^2 + 1)/x>"
    assert repr(kovacic.solve("x")) == "<Solution of y'' = x y: no Liouvillian solution>"


@pytest.mark.parametrize(
    ("text", "line", "latex"),
    [
        ("y'' + y = tan(x)", "omega = i or -i", "two solutions of the homogeneous equation"),
        ("y'' = a*y", "omega = c/2, where c is any root of c^2 - 4*a", r"e^{\sqrt{a} x}"),
        ("y'' + exp(2*x)*y = 0", "no Liouvillian solution", "t = e^{2 x}"),
    ],
)
def test_one_line_and_formulas_explain_their_letters(text: str, line: str, latex: str) -> None:
    answer = kovacic.solve(text)
    assert str(answer).endswith(line)
    assert latex in answer._repr_latex_()
    assert ("homogeneous" in latex) == ("homogeneous" in answer._repr_html_())


def test_a_status_is_equal_to_its_string() -> None:
    assert kovacic.solve("x").status == "none"
    assert kovacic.solve("2").status == "liouvillian" == kovacic.Status.LIOUVILLIAN
    assert {"none": 1}[kovacic.Status.NONE_EXISTS] == 1
    assert repr(kovacic.Status.NONE_EXISTS) == "<Status.NONE_EXISTS: 'none'>"


@parametrize(
    ("missing", "code", "extra"),
    [
        ("numpy", "answer.lambdify(interval=(1, 3))([2.0])", "numeric"),
        ("numpy", "kovacic.tabulate('x', 0, 1, x0=0, y0=1, dy0=0)", "numeric"),
        ("numpy", "answer.plot(1, 2, x0=1, points=5)", "plot"),
        ("matplotlib", "answer.plot(1, 2, x0=1, points=5)", "plot"),
        ("matplotlib", "draw_map('n*x + m', (parse_grid('n=1'), parse_grid('m=1')), {}, 'map.png')", "plot"),
    ],
    ordinary=0,
    long=3,
)
def test_a_missing_extra_names_the_command_that_installs_it(missing: str, code: str, extra: str) -> None:
    program = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "import kovacic\nfrom kovacic.batch.scan import draw_map, parse_grid\n"
        "answer = kovacic.solve('x^2 + 3')\n"
        f"try:\n    {code}\nexcept kovacic.MissingExtra as error:\n    print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert f"needs {missing}" in done.stdout
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    command = done.stdout.partition("pip install ")[2]
    assert set(shlex.split(command)) == set(project["optional-dependencies"][extra])


@pytest.mark.long
def test_a_missing_package_is_named_as_the_index_names_it() -> None:
    program = "import sys; sys.modules['flint'] = None\nimport kovacic\ntry:\n    kovacic.tabulate\n"
    program += "except kovacic.MissingExtra as error:\n    print(error)\n"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "kovacic.tabulate needs python-flint: pip install 'python-flint'"


@pytest.mark.long
@pytest.mark.parametrize(
    "arguments", ["plot x --from 0 --to 1 -o p.png", "ball --mass 1 --radius 1 --sphere 3 --simulate"]
)
def test_a_command_without_its_extra_says_so_in_one_line(arguments: str, tmp_path: Path) -> None:
    program = f"import sys; sys.modules['numpy'] = None\nfrom kovacic.cli import main\nmain.main({arguments.split()!r})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, cwd=tmp_path)
    assert done.stderr.startswith("kovacic: a ")
    assert "needs numpy: pip install" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.long
@pytest.mark.parametrize("missing", ["numpy", "matplotlib"])
def test_a_page_is_whole_without_a_picture(missing: str) -> None:
    program = (
        f"import sys; sys.modules[{missing!r}] = None\nimport kovacic\nprint(kovacic.solve('x').explain(format='html'))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert "<svg" not in done.stdout
    assert done.stdout.rstrip().endswith("</html>")


@pytest.mark.parametrize(
    "text",
    ["x^2 + 3", "0", "-3/7", "(x^2 - 1/2)/(3*x^3 - x)", "n*x/(m^2 - n*x)", "sqrt(2)*x + 1/(x - sqrt(2))", "I/(x^2 + I)",
     "cbrt(2)*x + 1/x^2", "2^(1/5)/x", "n*x + sqrt(2)/(x + n)", "sqrt(2)*x + sqrt(3)"],
)  # fmt: skip
def test_sympy_takes_rational_functions(text: str) -> None:
    """The same as the text that is printed means to SymPy (which would execute it, and so is used here only)."""
    import sympy

    S = kovacic.solve(text, limits=kovacic.Limits(unknown_degree=10)).S
    printed = sympy.sympify(str(S), locals={"root": lambda a, n: sympy.root(a, n)})
    assert sympy.simplify(sympy.sympify(S) - printed) == 0
    assert sympy.Symbol("x") + S == sympy.Symbol("x") + sympy.sympify(S)


def test_omega_in_sympy_solves_the_riccati_equation() -> None:
    import sympy

    for text in ("x^2 + 3", "2/x^2", "(n^2 - 1/4)/x^2", "n^2*x^2 + n"):
        answer = kovacic.solve(text)
        omega = sympy.sympify(answer.omega)
        assert sympy.simplify(sympy.diff(omega, sympy.Symbol("x")) + omega**2 - sympy.sympify(answer.S)) == 0
    assert sympy.sympify(kovacic.solve("2").omega) == sympy.Symbol("c")


@pytest.mark.long
def test_views_keep_the_limits_of_solve() -> None:
    """A view that would take longer says so; the limits aren't a part of the answer."""
    answer = kovacic.solve("y'' - 2*x*y' + 2400*y = 0")
    hurried = replace(answer, limits=kovacic.Limits(seconds=0.03))
    assert hurried == answer
    with controlled(step=0.001) as clock, pytest.raises(kovacic.LimitExceeded, match="time limit"):
        _ = hurried.closed_form  # 80 looks at the clock
    assert clock.time < 0.03 + 0.01
    with controlled(step=0.001) as clock:
        answer.to_json()
    hurried = replace(answer, limits=kovacic.Limits(seconds=clock.time + 0.03))
    with controlled(step=0.001):
        assert json.loads(hurried.to_json(full=True))["solutions"] is None
    assert "hyper((-600,), (1/2,), x^2)" in answer.explain()
    assert "limits" not in json.loads(answer.to_json())
    tetrahedral = kovacic.solve("-3/(16*x^2) - 2/(9*(x-1)^2) + 3/(16*x*(x-1))")
    assert replace(tetrahedral, limits=kovacic.Limits(seconds=0)).group is None


def test_warnings_name_the_line_of_the_user() -> None:
    """Not one of this package: through functions, methods and objects that call one another."""
    x, k, L = sympy.symbols("x k L")
    y = sympy.Function("y")
    wide = arb(3, 0.1)
    with warnings.catch_warnings(record=True, action="always") as found:
        kovacic.dsolve(y(x).diff(x, 2) + k**2 * y(x), ics={y(0): 0, y(L): 0})
        kovacic.evaluate("x", wide, x0=0, y0=1, dy0=0)
        kovacic.solve("x").at(wide, x0=0, y0=1, dy0=0)
        kovacic.prepared("x", x0=0, y0=1, dy0=0)(wide)
    assert len(found) >= 4
    assert {warning.filename for warning in found} == {__file__}


@pytest.mark.parametrize(
    ("start", "name"),
    [
        ({"x0": Fraction(1, 3), "which": "regular"}, r"$u$ regular at $x = \frac{1}{3}$"),
        (
            {"x0": Fraction(2, 3), "frobenius": (2, Fraction(-3, 5))},
            r"$u$ = (2) $u_1$ + (-3/5) $u_2$ of the Frobenius basis at $x = \frac{2}{3}$",
        ),
        ({"x0": 2, "y0": 3, "dy0": 5}, r"$u$, where $u(2) = 3,\ u'(2) = 5$"),
        ({"x0": 2, "which": "decaying"}, "$u$ decaying, $u(2) = 1$"),
        ({"x0": 2, "y0": 7, "which": "decaying"}, "$u$ decaying, $u(2) = 7$"),
        ({"x0": 2, "y0": 10**20, "dy0": 10**11}, f"$u$, where $u(2) = {10**20},\\ u'(2) = {10**11}$"),
        ({"x0": 2, "y0": 10**20, "dy0": 10**12}, "$u$"),
    ],
)
def test_a_solution_is_named_by_its_values(start: dict[str, Any], name: str) -> None:
    """And by its unknown alone where these are longer than 50 characters."""
    from kovacic.views.plot import _name_by_values

    assert _name_by_values("u", Start(**start)) == name


def test_titles_of_pictures() -> None:
    from kovacic.views.plot import _title

    answer = kovacic.solve("y'' = a*y/x")
    half = _title(answer, answer, {"a": Fraction(3, 2)})
    assert half == r"$y'' + \left(-\dfrac{a}{x}\right) y = 0$,   $a = \frac{3}{2}$"
    assert _title(([1], [0, 1]), ([1], [0, 1]), None) == ""
    text = f"y'' = {'+'.join(['x'] * 47)}"
    assert len(text) == 99
    assert _title(f"{text}7", f"{text}7", None).startswith("$y''")
    assert _title(f"{text}77", f"{text}77", None) == ""


def test_maps_of_too_many_points_are_refused() -> None:
    """Steps of a map are one fewer than its points."""
    whittaker = kovacic.conditions("a + b/x^2")
    with pytest.raises(kovacic.InputError, match="a map of 3001 x 3001 points"):
        whittaker.plot(steps=3000)
    with pytest.raises(kovacic.InputError, match="a map of 5000001 x 1 points"):
        whittaker.plot(parameters=["b"], steps=5_000_000, fixed={"a": 2})

"""Numbers of more than 4,300 digits, which Python doesn't convert: in and out, through every view and the command."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction

import flint
import jsonschema
import pytest
import sympy
from build import parametrize

import kovacic
from kovacic import checker


def digits(n: int) -> str:
    """Python's own conversion ends at 4,300 digits."""
    return flint.fmpz(n).str()


N = 10**5000 + 7
TEXT = digits(N)

EQUATIONS = {
    "exponents": f"(1/{TEXT}^2 - 1/{TEXT})/x^2",
    "far apart": f"{TEXT}*({TEXT} + 1)/x^2",
    "degree": f"x^2 + {TEXT}",
    "Legendre": f"(1 - x^2)*y'' - 2*x*y' + {TEXT}*({TEXT} + 1)*y = 0",
}


@pytest.mark.slow
@pytest.mark.parametrize("equation", EQUATIONS.values(), ids=EQUATIONS.keys())
def test_every_view_of_an_answer(equation: str) -> None:
    answer = kovacic.solve(equation)
    line = answer.to_json(full=True)
    assert kovacic.Solution.from_json(line) == answer
    verdict = checker.verdict(line)
    assert verdict.startswith("not checked" if answer.case is None else "checked")
    for text in (str(answer), answer.explain(), answer.explain(format="latex"), answer.explain(format="markdown")):
        assert text
    assert answer._repr_latex_()


@pytest.mark.long
def test_the_group_of_a_root_of_high_order() -> None:
    """y = x^(1/N), whose group has N elements: its order is a text in JSON."""
    answer = kovacic.solve(EQUATIONS["exponents"])
    assert answer.group is not None
    assert answer.group.name == f"mu_{TEXT}"
    line = answer.to_json(full=True)
    data = json.loads(line)
    assert data["group"]["order"] == data["group"]["n"] == TEXT
    jsonschema.validate(data, json.loads(_schema()))
    assert checker.verdict(line).startswith("checked")
    data["group"]["n"] = digits(N + 1)
    assert checker.verdict(json.dumps(data)).startswith("refuted")


@parametrize(
    "call",
    [
        lambda n: kovacic.evaluate("x", 1, x0=0, frobenius=(n, 1), limits=kovacic.Limits(seconds=1)),
        lambda n: kovacic.evaluate("1/x^2", 1, x0=n, which="regular", limits=kovacic.Limits(seconds=1)),
        lambda n: kovacic.connection_matrix(([Fraction(1, n), 1], [1]), [n, 2], limits=kovacic.Limits(seconds=1)),
        lambda n: kovacic.solve("a/x^2", assume={"a": n}),
        lambda n: kovacic.solve("a/x^2", assume={"a": sympy.Integer(n)}),
        lambda n: kovacic.tabulate("x", 0, 1, x0=sympy.sqrt(-n), y0=1, dy0=0),
        lambda n: kovacic.conditions("x^2 + a", max_degree=Fraction(1, n)),
        lambda n: kovacic.evaluate("x", [n], x0=0, y0=[n], dy0=1),
        lambda n: kovacic.solve("x^2 + 3").plot(0, n),
        lambda n: kovacic.solve("x^2 + 3").plot(0, 1, points=n),
        lambda n: kovacic.solve("x^2 + 3").lambdify(interval=(0, 1), which=n),
        lambda n: kovacic.conditions("n*(n + 1)/x^2 - 1").plot(ranges=[(0, n)]),
        lambda n: kovacic.conditions("n*(n + 1)/x^2 - 1").plot(steps=n),
        lambda n: kovacic.solve("x", limits=kovacic.Limits(seconds=n)),
        lambda n: kovacic.dsolve("y'' = y", ics={"y(0)": n, "y'(0)": 1}),
        lambda n: kovacic.solve_riccati(n, n, n, var="x"),
        lambda n: kovacic.dsolve(f"y'' = {digits(n)}*y"),
        lambda n: kovacic.solve(n).explain(),
        lambda n: kovacic.solve(([0, Fraction(1, n)], [1])).special,
        lambda n: kovacic.solve(([n * (n + 1)], [0, 0, 1])).plot(1, 2),
        lambda n: kovacic.evaluate(([n * (n + 1)], [0, 0, 1]), 1, x0=0, which="regular"),
        lambda n: kovacic.evaluate(([n * n + 1, -2 * n, 1], [1]), 1, x0=2, which="decaying"),
        lambda n: kovacic.solve(([Fraction(1, n * n) - Fraction(1, n)], [0, 0, 1])).compare_with_monodromy(),
        lambda n: kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x", limits=kovacic.Limits(seconds=1)).determinant(n),
        lambda n: kovacic.spectrum(sympy.Symbol("x") ** 2 + n),
    ],
    ordinary=0,
    long=6,
)
def test_a_long_argument_gives_a_value_or_says_why_not(call: Callable[[int], object]) -> None:
    said = ""
    try:
        call(N)
    except (kovacic.KovacicError, NotImplementedError) as error:  # the latter is dsolve's
        said = str(error)
    assert len(said) < 1000


def _schema() -> str:
    from importlib.resources import files

    return (files("kovacic") / "views" / "schema.json").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_command() -> None:
    equation = EQUATIONS["exponents"]
    command = [sys.executable, "-m", "kovacic"]
    solved = subprocess.run(
        [*command, "solve", "--json", "--full", equation], capture_output=True, text=True, timeout=60
    )
    assert solved.returncode == 0
    checked = subprocess.run([*command, "check", "-"], input=solved.stdout, capture_output=True, text=True, timeout=60)
    assert checked.returncode == 0
    shown = subprocess.run([*command, "solve", equation], capture_output=True, text=True, timeout=60)
    assert shown.returncode == 0

"""The explanation and the views of an answer: what they say, that it's right, and that it is well formed."""

from __future__ import annotations

import re
import shutil
import subprocess
from fractions import Fraction
from html.parser import HTMLParser
from pathlib import Path

import published
import pytest
import strategies
import sympy
from hypothesis import given, settings

import kovacic
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.cli.main import run
from kovacic.engine.places import Kind
from kovacic.views.formula import latex_ratfunc, latex_text
from kovacic.views.trace import rational_form, trace_of

EQUATIONS = [
    "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0",
    "x^2 + 3",
    "x",
    "-3/(16*x^2) + 1/x",
    "(-32*x^2 + 27*x - 27)/(144*x^2*(x-1)^2)",
    "2/(x^2+1)^2",
    "0",
    "w'' = sqrt(2)*w/t^2",
    "(1-x^2)*y'' - 2*x*y' + 6*y = x",
    "1/(x^5-x-1)",
]


def test_bessel_is_explained() -> None:
    text = kovacic.solve(EQUATIONS[0]).explain()
    for part in (
        "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0",
        "gamma = -1/(2*x)",
        "v'' = (-1) v",
        "where c is a root of c^2 + 1",
        "y1 = cos(x)/sqrt(x)",
        "is G_m",
        "passed",
        "[Kov86]",
    ):
        assert part in text


def test_kovacic_s_third_example_has_his_numbers() -> None:
    """E_0, E_1, E_inf and the choice of section 5 of the paper, for n = 4 (his e_0 = 3, e_1 = 4, e_inf = 7)."""
    trace = trace_of(kovacic.solve(EQUATIONS[4]))
    sets = {str(data.place): data.case_3 for data in trace.places}
    assert sets == {"x": (3, 4, 5, 6, 7, 8, 9), "x - 1": (4, 5, 6, 7, 8), "infinity": (4, 5, 6, 7, 8)}
    assert {str(choice.place): choice.value for choice in trace.choices} == {"x": 3, "x - 1": 4, "infinity": 7}
    assert str(trace.solution.semi_invariant.P) == "1"


def test_kovacic_s_second_example_has_his_numbers() -> None:
    trace = trace_of(kovacic.solve(EQUATIONS[3]))
    assert [data.case_2 for data in trace.places] == [(1, 2, 3), (1,)]
    assert [choice.value for choice in trace.choices] == [1, 1]
    assert str(rational_form(trace, trace.solution.decision.invariant)) == "x"


def test_a_no_names_what_excludes_every_case() -> None:
    text = kovacic.solve("x").explain()
    assert text.count("Not case 3") == 3
    assert "Not case 1" in text
    assert "Not case 2" in text
    assert "this is a proof" in text


def test_an_undecided_answer_says_why() -> None:
    answer = kovacic.solve("x^2 + 41", limits=kovacic.Limits(unknown_degree=5))
    assert "Undecided: " in answer.explain()
    assert "undecided" in answer._repr_html_()
    assert "undecided" in answer._repr_latex_()


@settings(max_examples=25)
@given(strategies.examples("case", "odd"))
def test_the_choice_satisfies_kovacic_s_relation(example: strategies.Example) -> None:
    """d from the chosen exponents is the degree of P, and every choice at a regular place lies in Kovacic's set."""
    trace = trace_of(kovacic.solve(example.S))
    case = trace.solution.case
    if case is None:
        return
    for data, choice in zip(trace.places, trace.choices, strict=True):
        if choice.value is None or data.place.kind is Kind.RAMIFIED:
            continue
        if case == 1 and data.exponents is not None:
            assert choice.value in data.exponents
        if case == 2:
            assert choice.value in data.case_2
        if case == 3:
            assert data.case_3 is not None
            assert choice.value in data.case_3


@pytest.mark.parametrize("text", EQUATIONS)
@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_every_format_of_every_kind(text: str, form: str) -> None:
    explained = kovacic.solve(text).explain(format=form)
    assert "nan" not in explained.lower().split()
    assert "None" not in explained
    if form == "markdown":
        assert explained.count("$$") % 2 == 0
        assert all(line.count("$") % 2 == 0 for line in explained.splitlines())
    if form == "latex":
        assert explained.count("\\[") == explained.count("\\]")
        assert explained.count("{") == explained.count("}")
        assert explained.count(r"\begin") == explained.count(r"\end")


def test_an_unknown_format() -> None:
    answer = kovacic.solve("x")
    with pytest.raises(ValueError, match="format"):
        answer.explain(format="word")
    with pytest.raises(ValueError, match="style"):
        answer.citation(style="word")


def test_latex_compiles(tmp_path: Path) -> None:
    if shutil.which("pdflatex") is None:
        pytest.skip("pdflatex isn't installed")
    body = "\n".join(kovacic.solve(text).explain(format="latex") for text in EQUATIONS[:5])
    document = "\\documentclass{article}\\usepackage{amsmath,amssymb}\\begin{document}\n" + body + "\\end{document}\n"
    (tmp_path / "a.tex").write_text(document)
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "a.tex"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)


def test_rational_functions_in_latex() -> None:
    x = RatFunc(QQ.poly([0, 1]))
    assert latex_ratfunc((2 * x**2 - 1) / (4 * x)) == r"\frac{2 x^{2} - 1}{4 x}"
    assert latex_ratfunc(-1 / x) == r"-\frac{1}{x}"
    assert latex_ratfunc(x * 0) == "0"
    assert latex_ratfunc(x**12 / 3) == r"\frac{x^{12}}{3}"
    assert latex_text("sqrt(2)*lambda**2 + x_1") == r"\sqrt{2} \lambda^{2} + x_{1}"


class _Cells(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.rows: list[list[str]] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.rows[-1][-1] += data


@pytest.mark.parametrize("text", EQUATIONS)
def test_the_table_for_jupyter(text: str) -> None:
    answer = kovacic.solve(text)
    parser = _Cells()
    parser.feed(answer._repr_html_())
    assert not parser.open
    cells = dict(row for row in parser.rows if row[0] != "note")
    assert cells["verified"] == "yes, by independent code"
    assert ("case" in cells) == (answer.case is not None)
    assert sum(cell.count("$") for row in parser.rows for cell in row) % 2 == 0
    assert answer._repr_latex_().count("$") == 2


def test_the_command_explains(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "x^2 + 3"]) == 0
    assert "y1 = x*exp(x^2/2)" in capsys.readouterr().out
    assert run(["explain", "--markdown", "y'' = x y"]) == 0
    assert "# The equation" in capsys.readouterr().out
    assert run(["explain", "--latex", "--no-solutions", "x^2 + 3"]) == 0
    out = capsys.readouterr().out
    assert r"\section*" in out
    assert "Solutions" not in out
    assert run(["explain", "--cite", "x^2 + 3"]) == 0
    assert capsys.readouterr().out.startswith("@article{Kov86")
    assert run(["explain", "x^2 +"]) == 2


@pytest.mark.parametrize("row", [row for row in published.load() if row.case is not None][::9], ids=lambda row: row.id)
def test_published_equations_are_explained_without_closed_forms(row: published.Published) -> None:
    answer = kovacic.solve(row.S)
    text = answer.explain(solutions=False)
    assert answer.group.name in text
    assert "FAILED" not in text


def test_the_bibliography_is_that_of_the_answer() -> None:
    def keys(text: str) -> set[str]:
        return set(re.findall(r"\[(\w+)\]", kovacic.solve(text).citation()))

    assert keys("x") == {"Kov86"}
    assert keys("x^2 + 3") >= {"Kov86", "vH97"}
    assert keys("2/x^2") >= {"HvdP95", "UW96"}
    assert "SU93" in keys(EQUATIONS[4])


def test_str_names_the_equation_that_was_given() -> None:
    assert str(kovacic.solve("x^2*y'' = 2*y")) == "x^2*y'' - 2*y = 0: case 1, omega = -1/x"
    assert str(kovacic.solve("2/x^2")).startswith("y'' = (2/x^2) y: case 1")


def test_exponents_at_irregular_places() -> None:
    """S = x^2 + 3: a = 1, b = 3, nu = 1, so (+-3 - 1)/2."""
    (data,) = trace_of(kovacic.solve("x^2 + 3")).places
    assert data.exponents == (Fraction(-2), Fraction(1))
    assert sympy.Rational(data.order) == -2


def test_the_command_solves_equations_in_every_view(capsys: pytest.CaptureFixture[str]) -> None:
    bessel = EQUATIONS[0]
    assert run(["solve", bessel]) == 0
    assert "normal form: y'' = (-1) y" in capsys.readouterr().out
    assert run(["solve", "--latex", bessel]) == 0
    assert r"\frac{\cos{\left(x \right)}}{\sqrt{x}}" in capsys.readouterr().out
    assert run(["solve", "--explain", bessel, "x"]) == 0
    assert capsys.readouterr().out.count("The equation\n===") == 2
    assert run(["solve", "--json", "--full", bessel]) == 0
    assert '"group": {"name": "G_m"' in capsys.readouterr().out

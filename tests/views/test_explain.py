"""The explanation and the views of an answer: what they say, that it's right, and that it is well formed."""

from __future__ import annotations

import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import published
import pytest
import sympy
import transform
from build import parametrize, run, size
from clocks import controlled
from sympy import Rational

import kovacic
from kovacic import derived
from kovacic.algebra.ratfunc import RatFunc
from kovacic.algebra.rationals import QQ
from kovacic.decision import RiccatiPolynomial
from kovacic.galois.group import Ground, Group, GroupKind
from kovacic.views.explain import ExplanationWriter
from kovacic.views.sentences import formulas_of, omega_math
from kovacic.views.text import render
from kovacic.writing.document import format_of

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

#: Formulas of more than a line: functions of a pull-back, square roots of large numbers, a polynomial of degree 12.
LONG = [
    "(-8*x^2 - x + 16)/(36*x^4 - 72*x^3 + 36*x^2)",
    "(96*x^2 - 75*x - 96)/(400*x^4 - 800*x^3 + 400*x^2)",
    "(-56184274944*x^6 + 287722616832*x^5 - 646252860132*x^4 + 747979016419*x^3 - 464048291925*x^2 + 172132340625*x"
    " - 41860546875)/(234101145600*x^8 - 1347184742400*x^7 + 3274376403600*x^6 - 4301984462400*x^5 + 3222329205600*x^4"
    " - 1304893800000*x^3 + 223256250000*x^2)",
]


def test_bessel_is_explained() -> None:
    text = kovacic.solve(EQUATIONS[0]).explain()
    for part in (
        "x^2*y'' + x*y' + (x^2 - 1/4)*y = 0",
        "gamma = -1/(2*x)",
        "v'' = -v",
        "where c is a root of c^2 + 1",
        "y1 = cos(x)/sqrt(x)",
        "is G_m",
        "passed",
        "[Kov86]",
    ):
        assert part in text


def test_of_many_families_some_are_shown_and_the_others_counted() -> None:
    """24 of the 44 for which d is a natural number."""
    text = kovacic.solve("+".join(f"2/(x-{k})^2" for k in range(1, 7)) + "+1").explain()
    assert "128 families of exponents, d is a natural number in 44 of them" in text
    assert "and 20 more." in text


def test_polynomials_and_invariants_that_were_found_are_printed() -> None:
    text = kovacic.solve("x^2 + 3").explain()
    assert "infinity  d   P\n--------  --  -\n1         1   x\n" in text
    assert "There is no invariant of degree 2, so at most one omega is rational" in text
    assert "There is an invariant of degree 2: " in kovacic.solve("1").explain()
    assert "All solutions are algebraic functions." in kovacic.solve("-3/(16*x^2)").explain()


def test_a_no_names_what_excludes_every_case() -> None:
    text = kovacic.solve("x").explain()
    assert text.count("Not case 3") == 3
    assert "Not case 1" in text
    assert "Not case 2" in text
    assert "this is a proof" in text
    assert "y1 = airyai(x)" in text


def test_a_change_of_variable_is_named_before_its_letter_is_used() -> None:
    text = kovacic.solve("y'' = exp(2*x)*y").explain()
    assert text.index("an equation with rational coefficients in t = exp(2*x):") < text.index("t*y'' + y'")
    assert "The case and the group are those over C(exp(2*x))." in text


def test_an_undecided_answer_says_why() -> None:
    answer = kovacic.solve("x^4 + x^2 + 42*x + 1/4", limits=kovacic.Limits(unknown_degree=5))
    assert "Undecided: " in answer.explain()
    assert "this is a proof" not in answer.explain()
    assert "undecided" in answer._repr_html_()
    assert "undecided" in answer._repr_latex_()


@parametrize("text", EQUATIONS, ordinary=1, long=15)
@parametrize("form", ["text", "markdown", "latex", "html"], ordinary=2, long=1)
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


@pytest.mark.long
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex isn't installed")
def test_latex_compiles_without_overfull_boxes(tmp_path: Path) -> None:
    answers = [kovacic.solve(text) for text in [*EQUATIONS, *LONG]]
    body = "\n".join(answer.explain(format="latex") for answer in answers)
    document = (
        "\\documentclass{article}\\usepackage{amsmath,amssymb,graphicx}\\begin{document}\n" + body + "\\end{document}\n"
    )
    (tmp_path / "a.tex").write_text(document, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "a.tex"]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert b"Overfull" not in done.stdout


@pytest.mark.long
def test_nothing_wider_than_a_line_is_beyond_a_break() -> None:
    """What stands between two places where TeX breaks, + and = and \allowbreak outside of groups, is short."""
    for text in LONG:
        for formula in re.findall(r"\$\\displaystyle (.*?)\$\\par", kovacic.solve(text).explain(format="latex")):
            depth = characters = 0
            for token in re.findall(r"\\[A-Za-z]+|\\.|.", formula):
                depth += {"{": 1, "}": -1, r"\left": 1, r"\right": -1}.get(token, 0)
                characters += token not in "{}^ "
                if depth == 0 and token in ("+", "-", "=", r"\allowbreak"):
                    characters = 0
                assert characters <= 120  # those above and below a fraction are counted together
            assert depth == 0


def test_signs_in_sentences_are_those_of_latex() -> None:
    text = kovacic.solve("x").explain(format="latex")
    assert r"even or $>$ 2" in text
    assert r"order is $\ge" in text


class _Tags(HTMLParser):
    """The tags that are open, and every place from which a browser would load something."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: set[str] = set()
        self.loaded: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.add(tag)
        self.loaded += [value or "" for name, value in attrs if name in ("src", "href", "xlink:href", "data")]
        if tag not in ("meta", "br", "path", "use"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        if tag not in ("meta", "br", "path", "use"):
            assert self.open.pop() == tag


@parametrize(
    ("text", "picture"), [(EQUATIONS[0], True), (EQUATIONS[4], True), (EQUATIONS[7], False)], ordinary=0, long=2
)
def test_a_page_needs_nothing_from_elsewhere(text: str, picture: bool) -> None:
    page = kovacic.solve(text).explain(format="html")
    tags = _Tags()
    tags.feed(page)
    assert not tags.open
    assert "math" in tags.seen
    assert "script" not in tags.seen
    assert "link" not in tags.seen
    assert all(place.startswith("#") for place in tags.loaded)
    assert ("svg" in tags.seen) == picture
    assert "@import" not in page
    assert "url(http" not in page


@pytest.mark.long
@pytest.mark.filterwarnings("error")
def test_an_envelope_ends_where_nothing_oscillates() -> None:
    assert "</html>" in kovacic.solve("x^3 + 10^6*x").explain(format="html")


@parametrize("text", LONG, ordinary=0, long=1)
def test_long_formulas_on_a_page_are_many_short_ones(text: str) -> None:
    page = kovacic.solve(text).explain(format="html")
    tags = _Tags()
    tags.feed(page)
    assert not tags.open
    assert "<wbr/>" in page
    assert "<merror" not in page
    shown = re.findall(r"<math.*?</math>", page, re.DOTALL)
    assert max(len(re.sub(r"<[^>]*>|&#x[0-9A-F]*;|\s", "", formula)) for formula in shown) <= 180


def test_many_families_and_the_primes_of_linear_systems_are_told_in_short() -> None:
    text = kovacic.solve(" + ".join(f"2/(x-{pole})^2" for pole in range(6)) + " + 1").explain(solutions=False)
    assert re.search(r"^and \d+ more\.$", text, re.MULTILINE)
    text = kovacic.solve("-3/(16*x^2) - 4/(25*(x-1)^2) - 3/(16*(x+1)^2) - 1/(8*x) + 1/(4*(x-1)) - 1/(8*(x+1))").explain(
        solutions=False
    )
    assert re.search(r"by a linear system of nullity 0 modulo \d+", text)


@parametrize("S", LONG[1:], ordinary=1)
def test_a_long_polynomial_of_omega_is_given_by_its_recurrence(S: str) -> None:
    """e_0 = 1, e_1 = phi and (k+1) e_(k+1) = e_k' + phi e_k - (m-k+1) S e_(k-1) give its coefficients, up to signs."""
    answer = kovacic.solve(S)
    text = answer.explain(solutions=False)
    assert "sum_(k=0)^12 (-1)^k e_k w^(12-k) = 0" in text
    assert "e_(k+1) = (e_k' + phi e_k - (m-k+1) S e_(k-1))/(k+1)" in text
    form, riccati = answer.semi_invariant, answer.riccati
    assert form is not None
    assert riccati is not None
    phi = form.theta + form.P.derivative() / RatFunc(form.P)
    e = [phi * 0 + 1, phi]
    for k in range(1, 12):
        e.append((e[k].derivative() + phi * e[k] - answer.S * e[k - 1] * (13 - k)) / (k + 1))
    assert [e_k * (-1) ** k for k, e_k in enumerate(e)][:0:-1] == list(riccati.coefficients[:12])
    assert kovacic.solve("-3/(16*x^2) + 1/x").explain(solutions=False).count("e_k") == 0


def test_the_bibliography_has_volume_pages_and_doi() -> None:
    text = kovacic.solve("x").citation(style="bibtex")
    for field in ("volume = {2}", "pages = {3--43}", "doi = {10.1016/S0747-7171(86)80010-4}"):
        assert field in text


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


@parametrize("text", EQUATIONS, ordinary=4)
def test_the_table_for_jupyter(text: str) -> None:
    answer = kovacic.solve(text)
    parser = _Cells()
    parser.feed(answer._repr_html_())
    assert not parser.open
    cells = dict(row for row in parser.rows if row[0] != "note")
    assert cells["verified"] == "yes, by independent code"
    assert "<math" in answer._repr_html_()
    assert "$" not in answer._repr_html_()
    assert ("case" in cells) == (answer.case is not None)
    assert answer._repr_latex_().count("$") == 2


def test_the_command_explains(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "x^2 + 3"]) == 0
    assert "y1 = x*exp(x^2/2)" in capsys.readouterr().out
    assert run(["explain", "--format", "markdown", "y'' = x y"]) == 0
    assert "# Kovacic" in capsys.readouterr().out
    assert run(["explain", "--format", "latex", "--no-solutions", "x^2 + 3"]) == 0
    out = capsys.readouterr().out
    assert r"\section*" in out
    assert "Solutions" not in out
    assert run(["explain", "--cite", "x^2 + 3"]) == 0
    assert capsys.readouterr().out.startswith("@article{Kov86")
    assert run(["explain", "x^2 +"]) == 2


@parametrize("row", [row for row in published.load() if row.case is not None][::9], ordinary=3, ids=lambda row: row.id)
def test_published_equations_are_explained_without_closed_forms(row: published.Published) -> None:
    answer = kovacic.solve(row.S)
    text = answer.explain(solutions=False)
    assert answer.group.name in text
    assert "FAILED" not in text


def test_exponents_are_fractions_in_the_letters() -> None:
    """alpha = (1 +- Delta)/2 at x = p, with Delta = q/(p - q)."""
    lines = kovacic.solve("(x-p)*(x-q)*y'' + x*y' + c*y = 0").explain(solutions=False).splitlines()
    at_p = [line.split("  ") for line in lines if line.startswith("x = p ")]
    assert at_p[0][-1].strip() == "q/(p - q)"
    assert [cell.strip() for cell in at_p[-2] if cell][-2:] == ["p/(2*p - 2*q)", "(p - 2*q)/(2*p - 2*q)"]


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


def test_the_command_solves_equations_in_every_view(capsys: pytest.CaptureFixture[str]) -> None:
    bessel = EQUATIONS[0]
    assert run(["solve", bessel]) == 0
    assert "normal form: y'' = -y" in capsys.readouterr().out
    assert run(["solve", "--latex", bessel]) == 0
    assert r"\frac{\cos{\left(x \right)}}{\sqrt{x}}" in capsys.readouterr().out
    assert run(["explain", bessel, "x"]) == 0
    assert capsys.readouterr().out.count("Kovacic's algorithm for ") == 2
    assert run(["solve", "--json", "--full", bessel]) == 0
    assert '"group": {"name": "G_m"' in capsys.readouterr().out


@pytest.mark.long
def test_an_answer_in_special_functions_shows_them_in_jupyter() -> None:
    airy = kovacic.solve("x")
    assert "<mi>A</mi><mi>i</mi>" in airy._repr_html_()
    assert "Ai" in airy._repr_latex_()
    assert airy.plot(-3, 1, points=20)._repr_png_().startswith(b"\x89PNG")


@pytest.mark.long
def test_a_page_has_a_picture_beside_an_irregular_singular_point() -> None:
    """Kovacic's Example 1; solutions are as large as exp(1/x) at 0."""
    page = kovacic.solve("(4*x^6-8*x^5+12*x^4+4*x^3+7*x^2-20*x+4)/(4*x^4)").explain(format="html")
    assert "<svg" in page


@pytest.mark.parametrize(
    ("S", "shown"),
    [
        ("2000000*x", "on an interval that is short"),
        ("10^40*x + 1", "There is no picture: solutions oscillate or grow too fast"),
        ("x + 10^6", "on an interval that is short"),
        pytest.param("x^300 + 1", "on an interval that is short", marks=pytest.mark.long),
        pytest.param("10^6/x^4", "There is no picture: solutions oscillate or grow too fast", marks=pytest.mark.long),
    ],
)
def test_a_page_has_a_picture_of_few_oscillations(S: str, shown: str) -> None:
    """On the usual interval there would be thousands, or values that differ by thousands of digits."""
    page = kovacic.solve(S).explain(format="html")
    assert shown in page
    assert ("<svg" in page) == shown.startswith("on")
    assert '<a href="#a-picture">' in page


@pytest.mark.long
def test_a_page_on_a_slow_machine_has_its_picture() -> None:
    with controlled(step=0.01):
        page = kovacic.solve("x").explain(format="html")
    assert "<svg" in page


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("n^2*x^2 + 3*n + k/x", "for a coefficient is -k, which isn't 0"),
        ("n^2*x^2 + 5*n + a0/x", "for the lower coefficient b0 of P would satisfy -a0*b0 + 2 = 0, -a0 - 2*b0*n = 0"),
        ("x^2 + 1/x + 5", "for the lower coefficient a0 of P would satisfy 2 - a0 = 0, -2*a0 - 1 = 0"),
    ],
)
def test_why_a_family_fails(text: str, why: str) -> None:
    """theta = n x + 1/x: P = 1 leaves -k; P = x + b0 leaves an impossible system, whatever the parameters are called."""
    assert f"no solution, {why}." in kovacic.solve(text, var="x").explain(solutions=False)


def test_a_parameter_may_be_called_x() -> None:
    assert "d = 0: P = 1 is a solution." in kovacic.solve("-3/(16*t^2) + x/t", var="t").explain(solutions=False)


@pytest.mark.long
def test_a_page_begins_with_the_answer_and_its_links_lead_somewhere() -> None:
    """Headings with apostrophes and signs, too; nothing is loaded, and the styles don't reach beyond the page's own part."""
    for S in ("1/x - 3/(16*x^2)", "x"):
        page = kovacic.solve(S).explain(format="html")
        headings = re.findall(r'<h[12] id="([^"]+)"', page)
        assert headings[0].startswith("kovacic-s-algorithm-for")
        assert headings[1] == "the-answer"
        assert len(set(headings)) == len(headings)
        links = re.findall(r'<a href="#([^"]+)"', page)
        assert links == headings[2:]
        assert "solution" in page[page.index('id="the-answer"') : page.index("<nav>")]
        style = re.sub(r"url\([^)]*\)", "", page[page.index("<style>") : page.index("</style>")])
        assert all(
            rule.strip().startswith((".kovacic", "@font-face")) for rule in re.findall(r"[^{}]+(?=\{)", style[7:])
        )
        assert not re.search(r"(?:src|href)=.https?:|url\((?!data:|#)", page)
        assert page.isascii()


@pytest.mark.long
def test_an_explanation_in_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The suffix says which format."""
    for suffix, form in ((".html", "html"), (".md", "markdown"), (".tex", "latex"), (".txt", "text")):
        target = tmp_path / f"answer{suffix}"
        assert run(["explain", "x^2 + 3", "-o", str(target)]) == 0
        assert capsys.readouterr().out == f"wrote {target}\n"
        written, _, _ = target.read_text(encoding="utf-8").partition("<svg")  # whose names change from one to the next
        assert written == kovacic.solve("x^2 + 3").explain(format=form).partition("<svg")[0]
    assert run(["explain", "x", "x^2", "-o", str(tmp_path / "b.txt")]) == 2
    assert run(["explain", "x", "-o", str(tmp_path / "b.doc")]) == 2


@pytest.mark.long
def test_the_page_names_its_equation_and_whose_the_solutions_are() -> None:
    """y1 solves the equation that was given, and omega belongs to the normal form: both are said."""
    answer = kovacic.solve("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0")
    text = answer.explain()
    assert text.startswith("Kovacic's algorithm for x^2*y'' + x*y' + (x^2 - 1/4)*y = 0\n")
    assert "the solutions y1 and y2 are those of the equation as given" in text
    assert "stands for v" not in text
    html = answer.explain(format="html")
    assert "<h1 id=" in html
    assert html.count("overflow-x:auto") == html.count("overflow-x:auto; overflow-y:hidden")


#: Problems with a right-hand side, values, or both; the last ones with jumps and letters.
PROBLEMS = [
    "y'' + y = 1/cos(x), y(0) = 1, y'(0) = 0",
    "x^2*y'' - 2*y = 3*x^2 - 1, y(1) = 0, y'(1) = 1",
    "y'' + 2*y' + y = exp(-x)/x^2",
    "y'' - 3*y' + 2*y = exp(3*x), y(0) = 0, y(1) = 2",
    "x*y'' + y' + x*y = 0, y(1) = 1, y'(1) = 0",
    "y'' + k^2*y = cos(w*x), y(0) = 0, y'(0) = 0",
    "y'' + y = Heaviside(x - 1), y(0) = 0, y'(0) = 0",
]


def parsed(printed: str) -> Any:
    return sympy.sympify(printed.replace("^", "**"))


@parametrize("text", PROBLEMS, ordinary=3, long=2)
@pytest.mark.filterwarnings("ignore:this holds unless")
def test_the_steps_to_a_solution_are_true(text: str) -> None:
    """What is printed for the pair, the Wronskian, the integrands, y0 and the constants is put into what it is said to be."""
    document = kovacic.explain(text, var="x")
    formulas = [line.strip().partition(" = ") for line in document.splitlines() if line.startswith("    ")]
    said = {left: parsed(right) for left, _, right in formulas if "'" not in left + right and " int " not in right}
    x = sympy.Symbol("x")
    y1, y2, W = said["y1"], said["y2"], said["W"]
    at = {s: Rational(7 + k, 5) for k, s in enumerate(sorted(y1.free_symbols | said["y(x)"].free_symbols, key=str))}

    def vanishes(e: Any) -> bool:
        return bool(size(e.doit().subs(at)) < 1e-12)

    assert vanishes(y1 * y2.diff(x) - y1.diff(x) * y2 - W)
    constants = {sympy.Symbol(name): said.get(name, sympy.Symbol(name)) for name in ("C1", "C2")}
    general = constants[sympy.Symbol("C1")] * y1 + constants[sympy.Symbol("C2")] * y2 + said.get("y0", 0)
    assert vanishes((said["y(x)"] - general).subs({"C1": 2, "C2": 3}))
    if "y0" in said:
        F = said["y2 F/W"] * W / y2
        assert vanishes(said["y1 F/W"] * W / y1 - F)
        slopes = [y.diff(x) for y in (y1, y2)]
        b, c = sympy.Matrix([[slopes[0], y1], [slopes[1], y2]]).LUsolve(-sympy.Matrix([s.diff(x) for s in slopes]))
        assert vanishes(said["y0"].diff(x, 2) + b * said["y0"].diff(x) + c * said["y0"] - F)
    for left, _, right in formulas:
        if left not in constants and "C1" in left + right and "y" not in left:
            assert vanishes((parsed(left) - parsed(right)).subs(constants))


@pytest.mark.parametrize("format", ["text", "markdown", "latex", "html"])
def test_the_steps_in_each_format(format: str) -> None:
    for text in ("y'' + y = 1/cos(x), y(0) = 1, y'(0) = 0", "x*y' + 2*y = x^2, y(1) = 2", "w' = x^2 + w^2"):
        document = kovacic.explain(text, format=format)
        assert "The solution" in document
    with pytest.raises(ValueError, match="unknown format"):
        kovacic.explain("y' = y", format="pdf")


@pytest.mark.parametrize(
    ("text", "steps"),
    [
        ("y'' + W^2*y = F", ["    D = W", "A solution with the right-hand side R is", "    y1 R/D = F*cos(W*x)/W"]),
        (
            "y'' + y = x, y(0) = y1, y'(0) = y0",
            ["    u1 = cos(x)", "y = C1 u1 + C2 u2 + y_p has the given values where"],
        ),
        ("h' + p*h = C1", ["    H = exp(-p*x)", "With h = H c it says that c' = f/H, so h = H (C2 + int f/H), where"]),
        ("u' = u^2 + r*x", ["u = -z'/(q z), q the coefficient of u^2, makes it linear:"]),
    ],
)
def test_names_in_the_steps_are_none_of_the_users_letters(text: str, steps: list[str]) -> None:
    lines = kovacic.explain(text).splitlines()
    assert [line for line in lines if line in steps] == steps


def test_names_in_the_algorithm_are_none_of_the_parameters() -> None:
    document = kovacic.solve("y'' + v*y' + b/x^2*y = 0").explain(solutions=False)
    assert (
        "With y = u exp(int gamma dx), gamma = -B/(2A), A and B the coefficients of y'' and y', it becomes" in document
    )
    assert (
        "S = s/(x - c)^2 + ..., the local solutions have exponents with the difference Delta = sqrt(1 + 4s)" in document
    )
    document = kovacic.solve("(d*(d + 1) + P)/x^2 + 1").explain(solutions=False)
    assert "Step 2: N = alpha_inf - sum alpha_c; 4 families of exponents, N is a natural number in none" in document
    assert "theta and Q of the answer" in kovacic.solve("2/x^2 + P^2").explain()
    assert "becomes, with y = u exp(int (" in kovacic.conditions("x*y'' + (v - x)*y' + n*y = 0").theorem()


def test_the_command_explains_problems(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "y'' + y = x, y(0) = 0, y'(0) = 0"]) == 0
    printed = capsys.readouterr().out
    assert "Variation of parameters" in printed
    assert printed.rstrip().endswith("y(x) = x - sin(x)")
    assert run(["explain", "y'' + y = 0"]) == 0
    assert "Kovacic's algorithm" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("S", "lines"),
    [
        ("-1", ["omega = i or -i", "y = exp(integral of omega dx)"]),
        ("-2/3", ["omega = c/3", "where c is i*sqrt(6) or -i*sqrt(6)"]),
        ("3/x^2", ["omega = (c + 1)/(2*x)", "where c is sqrt(13) or -sqrt(13)"]),
        ("sqrt(2)/x^2", ["omega = (c + 1)/(2*x)", "where c is any root of c^2 - 4*sqrt(2) - 1"]),
        (
            "-27*x/(8*(x^3-2)^2)",
            [
                "omega is a root w of",
                "    w^2",
                "    - ((2*x^2 + c^2*x - c)/(x^3 - 2)) w",
                "    + ((8*x^4 + 8*c^2*x^3 - 6*c*x^2 - x - 4*c^2)/(8*x^6 - 32*x^3 + 32)) = 0",
                "where c is any root of (2*c^3 + 1)/2",
            ],
        ),
        (
            "-3/(16*x^2) + 1/x",
            ["omega is a root w of", "    w^2", "    - (1/(2*x)) w", "    - ((16*x - 1)/(16*x^2)) = 0"],
        ),
        ("-3/(16*x^2) - 1/x", ["    - (1/(2*x)) w", "    + ((16*x + 1)/(16*x^2)) = 0"]),
        ("x^2*y'' + x*y' + (x^2 - 1/4)*y = 0", ["y = exp(integral of omega dx), a solution of the normal form"]),
    ],
)
def test_lines_of_omega_and_its_constants(S: str, lines: list[str]) -> None:
    text = "\n".join(render(kovacic.solve(S)))
    assert "\n".join(f"  {line}" for line in lines) + "\n" in text


def test_terms_of_omega_that_are_zero_are_left_out() -> None:
    numerators = [QQ.poly(coefficients) for coefficients in ([1], [], [1, -1], [2, -1])]
    polynomial = RiccatiPolynomial(P=numerators[0], D=numerators[0], numerators=tuple(numerators))
    assert omega_math(polynomial, formulas_of(kovacic.solve("x"))).text == "w^3\n- (x - 1) w\n+ (x - 2) = 0"


def test_the_literature_on_a_group_is_cited_once_it_was_computed() -> None:
    def keys(answer: kovacic.Solution) -> list[str]:
        return re.findall(r"^\[(\w+)\]", answer.citation(), re.MULTILINE)

    algebraic = kovacic.solve(EQUATIONS[4])
    before = keys(algebraic)
    assert algebraic.closed_form is not None
    assert keys(algebraic) == [*before, "HW05"]
    infinite = kovacic.solve(transform.from_squared_product(RatFunc(QQ.poly([1, 1, 0, 0, 1]), QQ.poly([4, 4, 1])), 1))
    before = keys(infinite)
    assert infinite.group.name == "N(T)"
    assert keys(infinite) == [*before, "Dav81", "Can87"]
    assert [key for key in before if key in ("HW05", "Dav81", "Can87")] == []


def test_a_group_whose_order_is_not_known(monkeypatch: pytest.MonkeyPatch) -> None:
    writer = ExplanationWriter(kovacic.solve("-3/(16*x^2) + 1/x"))
    group = Group(GroupKind.IMPRIMITIVE, Ground.UNDETERMINED, 6)
    monkeypatch.setattr(derived, "group", lambda answer: group)
    assert f"{group.description}, of order at least 24 if it is finite: " in format_of("text").render([*writer.group()])


def test_equations_with_a_right_hand_side_are_explained_by_their_homogeneous_ones() -> None:
    """1/x and x^2 don't solve x^2*y'' - 2*y = 3."""
    text = kovacic.solve("x^2*y'' = 2*y + 3").explain()
    assert (
        "With y = v exp(int gamma dx), gamma = -b/(2a), the homogeneous equation becomes its normal form for v:" in text
    )
    assert "the solutions y1 and y2 are those of the homogeneous equation.\n" in text
    text = kovacic.solve("x^2*y'' + x*y' = 2*y").explain(solutions=False)
    assert "With y = v exp(int gamma dx), gamma = -b/(2a), it becomes its normal form for v:" in text
    assert "the solutions y1 and y2 are those of the equation as given.\n" in text


def test_necessary_conditions_name_the_places_where_they_fail() -> None:
    text = str(kovacic.solve("x + 1/x").explain()).splitlines()
    verdicts = [re.split("  +", line) for line in text if re.match("[123]  ", line)]
    assert [(case, verdict) for case, _, verdict in verdicts] == [
        ("1", "fails at infinity"),
        ("2", "fails"),
        ("3", "fails at infinity"),
    ]

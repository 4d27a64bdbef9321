"""Formulas as text and in LaTeX: they mean what they are made of, and long ones break."""

from __future__ import annotations

import re

import pytest
import strategies
import sympy
from build import QQ, RatFunc, generated, parametrize
from hypothesis import given

import kovacic
from kovacic.views.sentences import formulas_of, normal_form_of
from kovacic.writing.breaking import breakable, pieces, width
from kovacic.writing.formula import Formulas, latex_text, with_single_powers


@pytest.mark.long
@generated(8)
@given(strategies.rational_functions(max_degree=6, bound=99))
def test_a_broken_formula_has_the_same_value(function: RatFunc) -> None:
    latex = latex_text(function.to_str())
    for line in (1000, 20, 5):
        written = re.sub(r"\\allowbreak ?|\\bigl|\\bigr", "", breakable(latex, line))
        assert sympy.cancel(_read_latex(written) - sympy.sympify(function.to_str())) == 0


@pytest.mark.parametrize(
    ("latex", "line", "written"),
    [
        (r"y = \sqrt[3]{x + 1 + x^{2}}", 8, r"y = \bigl(x + 1 + x^{2}\bigr)^{1/3}"),
        (r"e^{x + 1 + x^{2}} z", 8, r"\exp\bigl(x + 1 + x^{2}\bigr) z"),
        (
            r"\frac{\left(x + 1 + x^{2}\right)^{2}}{2 x}",
            8,
            r"\bigl(x + 1 + x^{2}\bigr)^{2}/\allowbreak \bigl(2 x\bigr)",
        ),
        (
            r"{}_{2}F_{1}\left(\begin{matrix}a, b \\ \frac{c}{2} \end{matrix}\middle|{x} \right)",
            8,
            r"{}_{2}F_{1}\bigl(a, b ; \tfrac {c}{2} ; {x} \bigr)",
        ),
        (r"\int e^{x}\, dx = \cos{\left(x \right)}", 8, r"\int  e^{x}\, dx = \cos {\left (x \right )}"),
        # What is as wide as half a line stays, and what is wider by a digit doesn't.
        (
            r"\sqrt{1234} \left(1234\right) {1234} e^{1234} \frac{1234}{5}",
            8,
            r"\sqrt {1234}\allowbreak \left (1234\right ) {1234} e^{1234} \frac {1234}{5}",
        ),
        (
            r"\sqrt{12345}z\left(12345\right) y^{12345} 3e^{12345} \frac{12345}{5}x",
            8,
            r"\bigl(12345\bigr)^{1/2}z\allowbreak \bigl(12345\bigr) y^{12345} 3\exp\bigl(12345\bigr)"
            r"\allowbreak \bigl(12345/\allowbreak 5\bigr)x",
        ),
        (
            "123456789012+1234567890123 + (123456789012345678901234)",
            48,
            r"123456789012+1234567890\allowbreak 123 + (1234567890\allowbreak 1234567890\allowbreak 1234)",
        ),
        (r"\frac{" + 60 * "7" + "}{3}", 60, r"\frac{" + 60 * "7" + "}{3}"),
        (r"\frac{" + 61 * "7" + "}{3}", 60, 6 * r"7777777777\allowbreak " + r"7/\allowbreak 3"),
        (
            r"\left(a + \left(b + 3\right) c\right) \left[x + 3\right] \P x\, \{z\}",
            8,
            r"\bigl(a + \bigl(b + 3\bigr) c\bigr)\allowbreak \left [x + 3\right ] \P  x\, \{z\}",
        ),
        (
            r"\frac{\sqrt[3]{x}}{\left(x + 1\right)} + \frac{\sqrt{x} y + 5}{c^{2}} + \frac{\frac{x + 1}{22}}{e^{z + 3} y}",
            3,
            r"\sqrt [3]{x}/\allowbreak \bigl(x + 1\bigr) + \bigl(\sqrt {x} y + 5\bigr)/\allowbreak c^{2}"
            r" + \bigl(\bigl(x + 1\bigr)/\allowbreak 22\bigr)/\allowbreak \bigl(\exp\bigl(z + 3\bigr) y\bigr)",
        ),
        (
            r"x e\frac{x + 7}{y}, \sqrt[3]{x + y} u v f(a, b) 12345}+e^",
            8,
            r"x e\allowbreak \bigl(x + 7\bigr)/\allowbreak y,\allowbreak  \bigl(x + y\bigr)^{1/3} u v"
            r" f(a,\allowbreak  b) 12345}+e^",
        ),
        # a/b before a factor would be a/(b y).
        (
            r"\frac{a + 1}{b} y - \frac{a + 1}{b} + \frac{a + 1}{b} \left(x\right)\frac{a + 1}{b}{}_{2}F",
            3,
            r"\bigl(\bigl(a + 1\bigr)/\allowbreak b\bigr) y - \bigl(a + 1\bigr)/\allowbreak b"
            r" + \bigl(\bigl(a + 1\bigr)/\allowbreak b\bigr)\allowbreak \left (x\right )"
            r"\allowbreak \bigl(\bigl(a + 1\bigr)/\allowbreak b\bigr)\allowbreak {}_{2}F",
        ),
        (
            r"\frac{a + 1}{b}(x)\, \int \frac{a + 1}{b}\, dx",
            3,
            r"\bigl(\bigl(a + 1\bigr)/\allowbreak b\bigr)(x)\, \int \bigl(a + 1\bigr)/\allowbreak b\, dx",
        ),
    ],
)
def test_how_long_formulas_are_written_on_a_line(latex: str, line: int, written: str) -> None:
    assert breakable(latex, line) == written


@pytest.mark.parametrize(
    ("latex", "characters"),
    [
        (r"\cos a + \sin b", 10.6),
        (r"\exp 123 - \frac{4567}{8} = \sqrt{x^{2}}", 17.7),
        (r"\frac{1}{23456}_{1234567890}", 12),
    ],
)
def test_how_wide_a_formula_is(latex: str, characters: float) -> None:
    assert width(latex) == pytest.approx(characters)


def test_a_broken_formula_can_be_broken_further() -> None:
    """As in the cells of a table, which are narrower than a line."""
    once = r"y = \frac {x^{2} + 1}{\sqrt {x}} + \cos x"
    assert breakable(once, 4) == breakable(once.replace(r"c {", "c{").replace(r"t {", "t{"), 4)
    assert breakable(once, 4).count("/") == 1


def test_the_pieces_of_a_formula_are_the_formula() -> None:
    formula = r"y = \frac{" + " + ".join(f"{10**k} x^{{{k}}}" for k in range(40)) + r"}{\sqrt{x}} - e^{x}"
    assert "".join(pieces(formula)).replace(" ", "") == breakable(formula).replace(r"\allowbreak", "").replace(" ", "")
    assert len(pieces(formula)) == 97
    assert pieces("y = -x") == ["y = -x"]
    with_parentheses = r"y = \left(x + 1\right) e^{x + 2}z + \left[3\right] - 5"
    assert pieces(with_parentheses) == [r"y = \left(x + 1\right) e^{x + 2}z ", r"+ \left[3\right] ", "- 5"]
    assert pieces(r"a(-b) + e^{2}- c = -d") == ["a(-b) ", "+ e^{2}", "- c = -d"]
    sevens = 61 * "7"
    assert pieces(rf"\frac{{{sevens[1:]}}}{{3}}") == [rf"\frac{{{sevens[1:]}}}{{3}}"]
    assert len(pieces(rf"\frac{{{sevens}}}{{3}}")) == 8


def test_rational_functions_in_latex() -> None:
    x = RatFunc(QQ.poly([0, 1]))
    assert latex_text(((2 * x**2 - 1) / (4 * x)).to_str()) == r"\frac{2 x^{2} - 1}{4 x}"
    assert latex_text((-1 / x).to_str()) == r"-\frac{1}{x}"
    assert latex_text((x * 0).to_str()) == "0"
    assert latex_text((x**12 / 3).to_str()) == r"\frac{x^{12}}{3}"
    assert latex_text("sqrt(2)*lambda**2 + x_1") == r"\sqrt{2} \lambda^{2} + x_{1}"
    assert latex_text("cbrt(5)*root(7, 4)/(2*(x + 1)**2)") == r"\frac{\sqrt[3]{5} \sqrt[4]{7}}{2 (x + 1)^{2}}"
    assert latex_text("y''+sin(x)/x*y-1/2=1e-3/7") == (r"y''+\frac{\sin\left(x\right)}{x} y-\frac{1}{2}=\frac{1e-3}{7}")
    assert latex_text("-(a + 1/b)*y'' + 0") == r"-\left(a + \frac{1}{b}\right) y'' + 0"
    assert latex_text("((mu_1 + 1)*x - 3)/sqrt(n^2/4 - b)") == (
        r"\frac{(\mu_{1} + 1) x - 3}{\sqrt{\frac{n^{2}}{4} - b}}"
    )


def _read_latex(latex: str) -> sympy.Expr:
    """The value of a LaTeX formula made of fractions, powers, products, parentheses and names."""
    text = re.sub(r"\^\{(\d+)\}", r"**\1", latex.replace(r"\left", "").replace(r"\right", ""))
    text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", text)
    return sympy.sympify(re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text))


@parametrize(
    "S",
    [
        "a/b",
        "a/(2*b)",
        "1/(b*x)",
        "a*x/b + 1/(a + 1)",
        "x/(3*a) + 1/2",
        "-a/b/x",
        "-2*x/3",
        "(x + a)/(x - b/2)^2",
        "1/(-x - 1)",
    ],
    ordinary=3,
)
def test_latex_of_functions_with_parameters_has_their_denominators(S: str) -> None:
    answer = kovacic.solve(S, var="x")
    formulas = formulas_of(answer)
    value = sympy.sympify(S.replace("^", "**"))
    assert sympy.simplify(_read_latex(formulas.math(answer.S).latex) - value) == 0
    assert sympy.simplify(_read_latex(formulas.times(answer.S, "y").latex) - value * sympy.Symbol("y")) == 0


@pytest.mark.parametrize(
    ("S", "text", "latex"),
    [
        ("1", "y", "y"),
        ("-1", "-y", "-y"),
        ("-2", "-2 y", "-2 y"),
        ("-x^2", "-x^2 y", "-x^{2} y"),
        ("2*a*x", "2 a x y", "2 a x y"),
        ("-1/x", "(-1/x) y", r"-\frac{1}{x} y"),
        ("1 - x", "(-x + 1) y", r"\left(-x + 1\right) y"),
        ("0", "0", "0"),
    ],
)
def test_the_normal_form_is_written_as_a_mathematician_would(S: str, text: str, latex: str) -> None:
    shown = normal_form_of(kovacic.solve(S, var="x"))
    assert (shown.text, shown.latex) == (f"y'' = {text}", f"y'' = {latex}")


@pytest.mark.parametrize(
    ("factor", "written"),
    [
        ("infinity", "infinity"),
        ("x", "t = 0"),
        ("x - 2", "t = 2"),
        ("x + 1/2", "t = -1/2"),
        ("x - c", "t = c"),
        ("x - c - 1", "t - c - 1 = 0"),
        ("x**2 + 1", "t^2 + 1 = 0"),
    ],
)
def test_a_place_is_its_point_or_the_equation_of_its_points(factor: str, written: str) -> None:
    """The factor is in the engine's variable, what is written in the user's."""
    assert Formulas("t", QQ).place(factor).text == written


@pytest.mark.parametrize(
    ("text", "short"),
    [
        ("3*(b^(1/2))^2 + exp(a + b)^2", "3*b + exp(a + b)^2"),
        ("(a^(2/3))^6*sqrt(b)^6", "a^4*b^3"),
        ("(a^n)^3 - sqrt(a)^3", "a^(3*n) - sqrt(a)^3"),
        ("exp(2)^3 + (a^(b + 1))^2", "exp(6) + (a^(b + 1))^2"),
        ("exp(-2*a*b/3)^5/(b^(-1/2))^4", "exp(-10*a*b/3)/b^(-2)"),
        ("sqrt(a + b)^4 - sqrt(a + b)^2", "(a + b)^2 - (a + b)"),
    ],
)
def test_powers_of_powers_are_single_ones(text: str, short: str) -> None:
    assert with_single_powers(text) == short
    values = {"a": sympy.Rational(2, 7), "b": sympy.Rational(3, 5), "n": sympy.Rational(4, 3)}
    difference = sympy.sympify(f"{text} - ({short})".replace("^", "**"))
    assert abs(difference.subs(values).evalf(20)) < 1e-15

"""What people paste from other systems, and as they write it by hand, is read, and means what it means there.

Each equation is written in every notation from its coefficients, by SymPy's printers or by hand, and is read back.
"""

from __future__ import annotations

import json
import random
import re
import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import sympy
from build import parametrize, read_input

import kovacic
from kovacic.cli.main import run
from kovacic.doubles.lambdify import lambdify
from kovacic.general_solution.conditions import apart
from kovacic.general_solution.question import read_question
from kovacic.reading.dialects import is_plain, tokenize
from kovacic.reading.pieces import Paste
from kovacic.reading.source import source_of

x, t, k, n, a, omega_0, alpha = sympy.symbols("x t k n a omega_0 alpha")
#: a, b, c, f of a y'' + b y' + c y = f in the variable x.
EQUATIONS: list[tuple[Any, Any, Any, Any]] = [
    (1, 0, -x, 0),
    (1, 0, 1, 0),
    (1, 0, k**2, 0),
    (1, 0, -(x**2) + 3, 0),
    (x**2, x, x**2 - sympy.Rational(1, 4), 0),
    (x**2, x, x**2 - n**2, 0),
    (1 - x**2, -2 * x, n * (n + 1), 0),
    (x, 1 - x, a, 0),
    (1, -2 * x, 2 * n, 0),
    (1, 3, 2, 0),
    (1, 2 * a, omega_0**2, 0),
    (1, 0, 4, x),
    (1, 1 / x, 1 - n**2 / x**2, 0),
    (x * (1 - x), sympy.Rational(1, 2) - 3 * x, -1, 0),
    (1, 0, alpha * x**2, 0),
    (1, -1, 0, x**2 + 1),
    (x**2, 4 * x, 2, 0),
    (1, 0, sympy.Rational(3, 16) / x**2 + sympy.Rational(2, 9) / (x - 1) ** 2, 0),
    (x**3, 0, 1, 0),
    (1, 0, x**4 + a * x**2, 0),
    (1, 0, 9, sympy.sin(2 * x)),
    (1, 2, 1, sympy.exp(-x)),
    (2, 0, k, 0),
    (1, 0, -(k**2), 0),
    (x, 2, x, 0),
]


def summed(terms: list[tuple[Any, str]], write: Callable[[Any], str], times: str) -> str:
    """The sum of coefficients and what they multiply, in a notation's signs."""
    written = []
    for coefficient, factor in terms:
        value = sympy.sympify(coefficient)
        if value == 0:
            continue
        written.append(factor if value == 1 else f"({write(value)}){times}{factor}")
    return " + ".join(written)


def notation(
    derivatives: tuple[str, str, str], write: Callable[[Any], str], times: str, equal: str = "="
) -> Callable[[Any], str]:
    """The writer of a whole equation from how y'', y' and y are written."""

    def text(parts: tuple[Any, Any, Any, Any]) -> str:
        *coefficients, f = parts
        left = summed(list(zip(coefficients, derivatives, strict=True)), write, times)
        return f"{left} {equal} {write(sympy.sympify(f))}"

    return text


def by_hand(value: Any) -> str:
    return sympy.sstr(value).replace("**", "^").replace("omega_0", "ω₀").replace("alpha", "α")


def latex(value: Any) -> str:
    return sympy.latex(value)


def mathematica(value: Any) -> str:
    return sympy.mathematica_code(value).replace("omega_0", "omega0")


def eq(value: Any) -> str:
    return sympy.sstr(value)


def in_eq(parts: tuple[Any, Any, Any, Any]) -> str:
    y = sympy.Function("y")(x)
    *coefficients, f = parts
    left = sum(sympy.sympify(c) * d for c, d in zip(coefficients, (y.diff(x, 2), y.diff(x), y), strict=True))
    return str(sympy.srepr(sympy.Integer(0)) and sympy.Eq(left, sympy.sympify(f), evaluate=False))


NOTATIONS: dict[str, Callable[[Any], str]] = {
    "primes": notation(("y''", "y'", "y"), by_hand, "*"),
    "a double quotation mark": notation(('y"', "y'", "y"), by_hand, " "),
    "Leibniz": notation(("d^2y/dx^2", "dy/dx", "y"), by_hand, " "),
    "Leibniz with superscripts": notation(("d²y/dx²", "dy/dx", "y"), by_hand, "·"),
    "LaTeX, fractions": notation((r"\frac{d^2y}{dx^2}", r"\frac{dy}{dx}", "y"), latex, " "),
    "LaTeX, braces": notation((r"\frac{d^{2} y}{d x^{2}}", r"\frac{d y}{d x}", "y"), latex, r" \cdot "),
    "LaTeX, primes": notation((r"y^{\prime\prime}", r"y^{\prime}", "y"), latex, r" \, "),
    "Mathematica": notation(("y''[x]", "y'[x]", "y[x]"), mathematica, " ", "=="),
    "Mathematica, D": notation(("D[y[x], {x, 2}]", "D[y[x], x]", "y[x]"), mathematica, "*", "=="),
    "Maple": notation(("diff(y(x), x$2)", "diff(y(x), x)", "y(x)"), eq, "*"),
    "Maple, D": notation(("(D@@2)(y)(x)", "D(y)(x)", "y(x)"), eq, "*"),
    "Maxima": notation(("'diff(y,x,2)", "'diff(y,x)", "y"), eq, "*"),
    "MATLAB": notation(("diff(y,2)", "diff(y,1)", "y"), eq, "*"),
    "SymPy": in_eq,
    "SymPy, methods": notation(("y(x).diff(x, 2)", "y(x).diff(x)", "y(x)"), eq, "*"),
}


def normal_form(parts: tuple[Any, Any, Any, Any]) -> Any:
    """S of y'' = S y for the left-hand side."""
    a2, b, c, _ = map(sympy.sympify, parts)
    p, q = b / a2, c / a2
    return p.diff(x) / 2 + p**2 / 4 - q


#: How names come out of notations that don't have SymPy's.
NAMES = {"ω_0": "omega_0", "omega0": "omega_0", "α": "alpha"}


@parametrize("name", NOTATIONS, ordinary=0, long=1)
def test_equations_in_a_notation_mean_what_they_mean_there(name: str) -> None:
    for parts in EQUATIONS:
        text = NOTATIONS[name](parts)
        if text.startswith("(2) "):  # a coefficient, or the number of the equation
            with pytest.raises(kovacic.InputError, match="may be the number of the equation, or a factor"):
                read_input(text)
            continue
        found = read_input(text, exponentials=True)
        S, f = found.S.to_str(), f"{found.equation.f.to_str()} + {found.equation.h or 0}"
        for other, usual in NAMES.items():
            S, f = S.replace(other, usual), f.replace(other, usual)
        assert sympy.simplify(sympy.sympify(S) - normal_form(parts)) == 0, text
        assert sympy.simplify(sympy.sympify(f) - parts[3]) == 0, text
        assert found.variable == "x"


@pytest.mark.parametrize(
    ("text", "variable", "S"),
    [
        ("D2y + 4*y = 0", "t", "-4"),
        ("D2y + 3*Dy + 2*y = 0", "t", "1/4"),
        ("D2y = x*y", "x", "x"),
        (r"\ddot{x} + 9x = 0", "t", "-9"),
        (r"\ddot{\theta} + 4\theta = 0", "t", "-4"),
        ("ẍ + ẋ + x = 0", "t", "-3/4"),
        ("ÿ + y = 0", "t", "-1"),
        (r"x^2 y'' = \left(\frac{3}{4}+x^{2}\right) y", "x", "(4*x**2 + 3)/(4*x**2)"),
        ("d/dx((1-x^2) dy/dx) + 6 y = 0", "x", "(6*x**2 - 7)/(x**4 - 2*x**2 + 1)"),
        ("(d^2/dx^2) y = x y", "x", "x"),
        ("d^2u/dz^2 = z u", "z", "x"),
        ("y″ = x y", "x", "x"),
        ("y’’ = x y", "x", "x"),
        ("u'' = -k^2*u", "x", "-k**2"),
        ("y'' = -k^2*y", "x", "-k**2"),
        ("y'' + omega^2 y = 0", "x", "-omega**2"),
        ("y'' = (a t + b) y", "t", "a*x + b"),
        ("y'' + k_xx*y = 0", "x", "-k_xx"),
        ("u_tt + 4*u = 0", "t", "-4"),
        (r"y'' + k_{\text{eff}}^2 y = 0", "x", "-k_eff**2"),
        ("α x^2", "x", "α*x**2"),
        ("n(n+1)/x^2 + 1", "x", "(x**2 + n**2 + n)/x**2"),
        ("x(x+1)", "x", "x**2 + x"),
        ("½x", "x", "x/2"),
        ("$x^2+3$", "x", "x**2 + 3"),
        (r"\frac34 x^{-2}", "x", "3/(4*x**2)"),
        (r"\hbar x", "x", "hbar*x"),
        ("Rational(1, 2)/x^2 + S(2)*Pow(x, 2)", "x", "(4*x**4 + 1)/(2*x**2)"),
        ("x^{2} + 1", "x", "x**2 + 1"),
        (r"\frac{1}{x} - \frac{3}{16x^2}", "x", "(16*x - 3)/(16*x**2)"),
        (r"\frac{d^{2}}{d x^{2}} y{\left(x \right)} + y{\left(x \right)} = 0", "x", "-1"),
        (r"\frac{d^{2}}{d x^{2}} y{\left(x \right)} = (x + 3) y{\left(x \right)}", "x", "x + 3"),
        ("y'' + tau*y' + tau²*y = 0", "tau", "(-3*x**2 + 2)/4"),
        ("y'' = T*y + T^2*a*y", "T", "a*x**2 + x"),
        ("y''^1 = x*y^1", "x", "x"),
        ("(d^2y/dx^2)(x) + (dy/dx)(x) = 3 y", "x", "13/4"),
        ("(x + root(0, 500))*2", "x", "2*x"),
        ("{y'' = x y}", "x", "x"),
    ],
)
def test_what_is_pasted(text: str, variable: str, S: str) -> None:
    found = read_input(text)
    assert (found.variable, found.S.to_str()) == (variable, S)


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("y'' = -k^2*y", "x is the variable, k a parameter"),
        ("y'' + 2*c*y' + w0^2*y = 0", "x is the variable, c, w0 parameters"),
        ("x^1/2", "a root is written ^(1/2)"),
        ("(1+I)^(1/3)*x", "near 1.08422 + 0.290515*I"),
        ("(1-I)^(1/3)*x", "near 1.08422 - 0.290515*I"),
    ],
)
def test_what_is_guessed_is_said(text: str, note: str) -> None:
    assert any(note in said for said in kovacic.solve(text).notices)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("y'' = xab", "write x*a*b"),
        ("y'' + axy' = 0", "write a*x*y"),
        (r"y'' = \foo{x} y", "write for example"),
        ("y.foo(x) = 0", "a derivative is y.diff(x, 2)"),
        ("y'' + word y = 0", "leave it out"),
        ("y'' + sin^(n+1)(x) y = 0", "a power of it sin(...)^2"),
        ("dsolve(", "add ')' where it ends"),
    ],
)
def test_what_is_not_read_is_refused_with_a_hint_that_works(text: str, hint: str) -> None:
    with pytest.raises(kovacic.InputError) as caught:
        read_input(text)
    assert hint in str(caught.value.hint)


@parametrize(
    "piece",
    [
        "d/dx(",
        r"\frac{",
        "d^2y/dx^2 + ",
        "x$",
        "y(x).diff(x)",
        "D(",
        "'",
        "a",
        " ",
        "[",
        "{",
        "d",
        "_{",
        "|",
        "√",
        "½",
        ")'",
        "sin^2(",
        "sin x ",
        r"\sin k ",
        r"\sin",
        r"\dot",
        "^",
        r"\operatorname{",
        r"y{\left(x\right)}",
        "y_xx ",
        "\n",
        "dsolve(",
    ],
    ordinary=3,
    long=13,
)
def test_rewriting_takes_linear_time(piece: str) -> None:
    """Counted in characters of the result, and by ending at all: each piece 4,000 times in a row."""
    try:
        found = tokenize(piece * 4_000 + "\\,$")
        apart(piece * 4_000, None)
    except kovacic.InputError:
        return
    assert len(found.kinds) < 40 * 4_000 * len(piece) + 100


@pytest.mark.parametrize(
    ("text", "solution"),
    [
        ("y''+y=0, y(0)=1", "C2*sin(x) + cos(x)"),
        ("y'' + y = 0, y(0) = 1, y'(0) = 2", "2*sin(x) + cos(x)"),
        (r"\ddot{x} + 4 x = 0, x(0)=1, x'(0)=0", "cos(2*t)"),
        ("diff(y(x), x, 2) = y(x), y(0)=1, y'(0)=1", "exp(x)"),
        ("desolve(diff(y,x,2)+y, y, ics=[0,1,2])", "2*sin(x) + cos(x)"),
        ("eq = Eq(y(x).diff(x,2)+y(x),0); ic = {y(0):1}; dsolve(eq, y(x), ics=ic)", "C2*sin(x) + cos(x)"),
        ("c1 = y(0)==1; c2 = Dy(0)==0; dsolve(diff(y,x,2)+y==0, [c1 c2])", "cos(x)"),
        (r"y'' + y = 0, y{\left(0 \right)} = 3, y'{\left(0 \right)} = 2", "2*sin(x) + 3*cos(x)"),
        ("desolve(diff(y,x)+4*y==0, y, ics=[2,3])", "3*exp(8 - 4*x)"),
        (r"\frac{d^{2}}{d x^{2}} y{\left(x \right)} = 4 y{\left(x \right)}, y(0) = 3, y'(0) = 6", "3*exp(2*x)"),
        ("[y'' + 4*y = 0, y(0) = 3]", "C2*sin(2*x) + 3*cos(2*x)"),
        ("rhs(dsolve(y'' + 4*y = 0, y(0) = 3))", "C2*sin(2*x) + 3*cos(2*x)"),
        ("dsolve(); y'' + y = 0, y(0) = 3", "C2*sin(x) + 3*cos(x)"),
        ("y'' + y = 0, y(0) = 1, (dy/dx)(0) = 2", "2*sin(x) + cos(x)"),
        ("y'' + 2•y∗2 = 0, y(0) = 1, y'(0) = 0", "cos(2*x)"),
        ("x'' + x = 0, [x'](0) = 2, x(t=0) = 1", "2*sin(t) + cos(t)"),
        (r"y'' + y = 0, \left(\frac{dy}{dx}\right)(0) = 2, y|_{x=\pi/2} = 2", "C1*cos(x) + 2*sin(x)"),
        (r"y'' + y = 0, \left.\frac{dy}{dx}\right|_{x=0} = 2, y(0) = 1", "2*sin(x) + cos(x)"),
        ("y'' + y = 0, y(t=0) = 1, y'(t=0) = 2", "2*sin(t) + cos(t)"),
    ],
)
def test_values_behind_the_equation_are_taken(text: str, solution: str) -> None:
    assert str(kovacic.dsolve(text).rhs) == solution


@pytest.mark.parametrize(
    ("text", "said", "position"),
    [
        ("y'' + 4*y = 0, y(0)", r"'y\(0\)' isn't an initial value", 15),
        ("y'' = y, y(0) = 3 y''", "can't contain y", 9),
        ("x = 3, y = 2*x", "contain no derivative", None),
        ("y'' + x*y = 0, y(t=0) = 1", "given in t, and the variable is x", 17),
        ("y' = x*z, z' = y, y(x=0) = 1, z(t=0) = 1", "given in t, and the variable is x", 32),
        ("{y'' = x*y, y(0) = 1]", "closes {, a bracket of another kind", 0),
    ],
)
def test_what_is_no_value_is_refused(text: str, said: str, position: int | None) -> None:
    with pytest.raises(kovacic.InputError, match=said) as caught:
        kovacic.dsolve(text)
    assert caught.value.position == position


def test_values_in_two_places_are_refused() -> None:
    with pytest.raises(kovacic.InputError, match="apart from it"):
        kovacic.dsolve("y''+y=0, y(0)=1", ics={"y'(0)": 1})
    with pytest.raises(kovacic.ParseError, match="given in t, and the variable is x"):
        kovacic.dsolve("y''=x*y", ics="y(t=0)=1")


@parametrize(
    ("text", "meant"),
    [
        ("y'' + aky = 0", "a*k*y"),
        ("y'' = axy", "a*x*y"),
        ("x'' + gkx = 0", "g*k*x"),
        ("y'' + y = cos(akx)", "a*k*x"),
        ("y'' + y = exp(-abt)", "a*b*t"),
        ("y'' + 4*y = sin2x", "sin(2*x)"),
        ("y'' + 4*y = cos3t", "cos(3*t)"),
        ("y'' + y = x*sinx", "sin(x)"),
        ("y'' + y = Fcoswt", "F*cos(w*t)"),
    ],
    ordinary=5,
)
def test_a_product_without_its_sign_is_refused_with_what_was_meant(text: str, meant: str) -> None:
    var = "t" if "t" in text else None
    with pytest.raises(kovacic.InputError) as refused:
        kovacic.dsolve(text, var=var)
    assert meant in str(refused.value.hint)
    glued = meant.replace("*", "").replace("sin(2x)", "sin2x").replace("cos(3t)", "cos3t")
    glued = {"sin(x)": "sinx", "Fcos(wt)": "Fcoswt"}.get(glued, glued)
    kovacic.dsolve(text.replace(glued, meant), var=var)


def test_wave_vectors_and_words_are_names() -> None:
    for name in ("k_x", "kappa", "hbar", "omega_0", "m", "xi"):
        assert name in str(kovacic.dsolve(f"y'' + {name}*y = 0"))


@pytest.mark.parametrize(
    ("text", "variable"),
    [
        ("y'' + y = Heaviside(t) - Heaviside(t - T)", "t"),
        ("y'' + y = T*sin(pi*t/T)", "t"),
        ("y'' + (1 - R/r)*y = 0", "r"),
        ("y'' + Z/z*y = 0", "z"),
        ("y'' + T*y = 0", "x"),
        ("y'' + T*y = sin(T)", "T"),
    ],
)
@pytest.mark.filterwarnings("ignore:. is taken for the variable")
def test_beside_a_variable_its_capital_is_a_parameter(text: str, variable: str) -> None:
    answer = kovacic.dsolve(text)
    assert [str(argument) for argument in answer.lhs.args] == [variable]


@pytest.mark.long
def test_beside_a_frequency_zeta_is_the_damping_ratio() -> None:
    time, zeta, omega = sympy.symbols("t zeta omega")
    for text in (
        "x'' + 2*zeta*omega*x' + omega^2*x = 0",
        "\\ddot{x} + 2\\zeta\\omega\\dot{x} + \\omega^2 x = 0",
    ):
        found = kovacic.dsolve(text).rhs
        residual = found.diff(time, 2) + 2 * zeta * omega * found.diff(time) + omega**2 * found
        assert sympy.simplify(residual) == 0
    greek = kovacic.dsolve("x'' + 2ζω x' + ω²x = 0").rhs
    assert sympy.simplify(greek.subs({"ζ": zeta, "ω": omega}) - kovacic.dsolve(text).rhs) == 0
    assert kovacic.dsolve("y'' + zeta*y = 0").lhs.args[0].name == "x"


@pytest.mark.parametrize(
    "text",
    [
        r"\ddot{y} + 4y = 0, y(0)=1, \dot{y}(0)=2",
        r"y'' + 4y = 0, \quad y(0)=1, \quad y'(0) = 2",
        r"y^{\prime\prime} + 4 y = 0, y(0) = \frac{2}{2}, y^{\prime}(0) = 2",
        "y'' + 4y = 0; y(0) = 1; y'(0) = 2",
        "$y'' + 4y = 0$, $y(0) = 1$, $y'(0) = 2$",
        r"\frac{\mathrm{d}^2y}{\mathrm{d}x^2} + 4y = 0, y(0) = 1, y'(0) = 2",
        r"y^{(2)} + 4y = 0, y(0) = 1, y^{\prime}(0) = 2",
    ],
)
def test_values_in_the_notation_of_their_equation(text: str) -> None:
    found = kovacic.dsolve(text)
    argument = found.lhs.args[0]
    assert found.rhs == sympy.cos(2 * argument) + sympy.sin(2 * argument)


@pytest.mark.parametrize(
    "text", ["x y' = y^2 + y + x^2", r"x\frac{dy}{dx} = y^2 + y + x^2", "x*diff(y, x) = y^2 + y + x^2"]
)
def test_riccati_equations_in_any_notation(text: str) -> None:
    constant = sympy.Symbol("C1")
    assert kovacic.dsolve(text).rhs == x * sympy.tan(constant + x)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("y''[x] + y[x] == Piecewise[{{1, x < 5}, {x, x >= 5}}]", "y'' + y = Piecewise((1, x < 5), (x, True))"),
        ("y'[x] == Piecewise[{{1, 0 <= x < 5}}]", "y' = Piecewise((1, 0 <= x < 5), (0, True))"),
        ("y'[x] == Piecewise[{{1, x < 5}}, 2]", "y' = Piecewise((1, x < 5), (2, True))"),
        (
            r"y'' + y = \begin{cases} 1, & x < 5 \\ \frac{x}{2}, & \text{if } x \ge 5. \end{cases}",
            "y'' + y = Piecewise((1, x < 5), (x/2, True))",
        ),
        (
            r"y' = \left\{\begin{array}{rl} 1 & 0 \leq x < 5 \\ 0 & \text{otherwise} \end{array}\right.",
            "y' = Piecewise((1, 0 <= x < 5), (0, True))",
        ),
        (r"\left\{\begin{array}{l} x' = y \\ y' = -x \end{array}\right.", "x' = y, y' = -x"),
        ("T' = -k*(T - T∞)", "T' = -k*(T - T_oo)"),
        (r"\frac{dN}{dt} = r N (1 - N/K)", "dN/dt = r*N*(1 - N/K)"),
        ("\"y'' = x*y\"", "y'' = x*y"),
        ("dsolve(y'' + y = 0, func=y)", "y'' + y = 0"),
        (r"\frac{\mathrm d^2y}{\mathrm dx^2} + \sin\frac{x}{2} y = 0", "y'' + sin(x/2)*y = 0"),
        (r"y' = \cos\sqrt[3]{a} + \sin^{-1} a", "y' = cos(a^(1/3)) + asin(a)"),
        ("d^2y/dx^2(x) + y(x)'' = sin(x)'", "2*y'' = cos(x)"),
        ("y' = sin a + max(x, 1)", "y' = sin(a) + 1 + (x - 1)*Heaviside(x - 1)"),
    ],
)
def test_notations_of_one_equation_have_one_solution(text: str, plain: str) -> None:
    assert kovacic.dsolve(text) == kovacic.dsolve(plain)


@pytest.mark.parametrize("infinity", ["oo", "inf", "infinity", "Infinity", "+oo", "∞"])
def test_infinity_has_many_names(infinity: str) -> None:
    assert kovacic.dsolve(f"y'' - y = 0, y(0) = 1, y({infinity}) = 0").rhs == sympy.exp(-x)
    assert kovacic.dsolve("y'' - y = 0, y(0) = 1, y(-infinity) = 0").rhs == sympy.exp(x)


PASTED = [
    json.loads(line) for line in (Path(__file__).parents[1] / "data" / "pasted.jsonl").read_text("utf-8").splitlines()
]
#: Greek letters as they are written in texts, and by their names.
GREEK_NAMES = {"ν": "nu", "ω": "omega", "ω_0": "omega_0", "λ": "lambda", "θ": "theta", "ψ": "psi", "γ": "gamma"}
#: What isn't a symbol in a meaning.
KNOWN = [
    "Abs",
    "DiracDelta",
    "Heaviside",
    "I",
    "Max",
    "Rational",
    "acos",
    "asin",
    "atan",
    "cos",
    "cosh",
    "csc",
    "exp",
    "log",
    "pi",
    "sec",
    "sin",
    "sign",
    "sinh",
    "sqrt",
    "tan",
]


def meant(text: str) -> Any:
    """The expression that a text of SymPy's means; all names are symbols but those of `KNOWN`."""
    text = text.replace("lambda", "lambda_")  # a word of Python's
    names = {
        name: sympy.Symbol(GREEK_NAMES.get(name, name.replace("lambda_", "lambda")))
        for name in re.findall(r"[^\W\d]\w*", text)
    }
    symbols = {name: symbol for name, symbol in names.items() if name not in KNOWN}
    return sympy.sympify(text, locals=symbols)


@pytest.mark.parametrize("label", ["(2)", "(a)", "(ii)", "Exercise 4", "Problem 12", "No. 3"])
def test_a_label_that_may_be_a_factor_is_asked_back(label: str) -> None:
    with pytest.raises(kovacic.InputError, match="may be the number of the equation, or a factor"):
        read_input(f"{label} y'' + x*y = 0")
    for certain in (f"{label} 3y'' + x*y = 0", f"{label}\ny'' + x*y = 0"):
        assert any(label in note for note in read_input(certain).notices)


@pytest.mark.parametrize("number", ["(3)", "(1.2)", "[7]"])
def test_a_number_behind_a_function_is_a_factor_which_is_said(number: str) -> None:
    """Behind an equation it is its number."""
    for blank in (" ", ""):
        read = read_input(f"x^2 + 3{blank}{number}")
        assert read.S == read_input(f"x^2 + 3*{number[1:-1]}").S
        assert any(f"{number} was read as a factor" in note for note in read.notices) == bool(blank)
    assert read_input(f"y'' = x^2*y + 3 {number}").equation == read_input("y'' = x^2*y + 3").equation


@pytest.mark.parametrize(
    ("operator", "plain"),
    [
        ("(D + 2) y = 0", "y' + 2*y = 0"),
        ("D y + k y = x", "y' + k*y = x"),
        ("(d/dx + 2) y = e^x, y(0) = 1", "y' + 2*y = e^x, y(0) = 1"),
        (r"\left(t\frac{d}{dt} + 1\right) x = t", "t*x' + x = t"),
        ("(d/dx + 1)(d/dx + 2) y = 0", "y'' + 3*y' + 2*y = 0"),
        ("(x d/dx)^2 y = n^2 y", "x^2*y'' + x*y' = n^2*y"),
        ("x (d/dx)^2 y + y = 0", "x*y'' + y = 0"),
        ("(d/dx)(d/dx) y + y = x", "y'' + y = x"),
        (r"\left(\frac{d}{dt}\right)^{2} u = u", "u''(t) = u(t)"),
        (r"\left[\frac{d^2}{dr^2} + \frac{2}{r}\frac{d}{dr} + k^2\right] R(r) = 0", "R'' + 2/r*R' + k^2*R = 0"),
    ],
)
def test_operators_mean_the_derivatives_that_they_take(operator: str, plain: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the letter for the variable
        assert kovacic.dsolve(operator) == kovacic.dsolve(plain)


LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


@pytest.mark.parametrize("index", ["0", "1", "12"])
@pytest.mark.parametrize("letter", ["ω", "a", "k", "λ"])
def test_a_lowered_index_ends_before_what_follows(letter: str, index: str) -> None:
    """ω₀x is a product of ω₀ and x; on the line w_0x is no name, unless it is declared or in braces."""
    name = letter + index.translate(LOWERED)
    meant_name = f"{letter}_{index}"
    for glued, product in (
        ("{}y", "{}*y"),
        ("{}x y", "{}*x*y"),
        ("{}y' + {}²y", "{}*y' + {}^2*y"),
        ("{}sin x", "{}*sin(x)"),
    ):
        found = read_question(f"y'' + {glued.format(name, name)} = 0", None, None, None, kovacic.Limits()).given
        expected = read_question(
            f"y'' + {product.format(meant_name, meant_name)} = 0", None, None, None, kovacic.Limits()
        )
        assert found == expected.given
    for glued in (f"{meant_name}x", f"{meant_name}xy"):
        with pytest.raises(kovacic.ParseError, match=rf"(?s){glued} is one name.*write {meant_name}\*x"):
            kovacic.solve(f"y'' + {glued} y = 0")
        assert kovacic.solve(f"y'' + {glued} y = 0", parameters=[glued]).S.field.ground.names == (glued,)
    assert kovacic.solve(rf"y'' + {letter}_{{{index}x}} y = 0").S.field.ground.names == (f"{meant_name}x",)


@pytest.mark.parametrize("sign", ["∂", r"\partial"])
def test_indexed_partial_signs_are_derivatives(sign: str) -> None:
    x_index, second = ("ₓ", "ₓₓ") if sign == "∂" else ("_x ", "_{xx} ")
    square = "ₓ²" if sign == "∂" else "_x^2 "
    for text, plain in (
        (f"{sign}{second}u + u = 0", "u'' + u = 0"),
        (f"{sign}{square}u + x u = 0", "u'' + x u = 0"),
        (f"{sign}{square}u + 2{sign}{x_index}u + u = 0", "u'' + 2u' + u = 0"),
        (f"({sign}{square} - x) u = 0", "u'' - x u = 0"),
        (f"u_xx + {sign}{x_index}u = 0", "u'' + u' = 0"),
    ):
        assert kovacic.solve(text).equation == kovacic.solve(plain).equation


@pytest.mark.parametrize("variable", ["t", "s", "x"])
@pytest.mark.parametrize("right", ["0", "sin(3{})"])
def test_julias_derivative_names_the_variable(variable: str, right: str) -> None:
    declared = f"@variables {variable} y({variable})\nD = Differential({variable})\n"
    question = read_question(
        f"{declared}D(D(y)) + 2D(y) + 5y ~ {right.format(variable)}", None, None, None, kovacic.Limits()
    )
    expected = read_question(
        f"y''({variable}) + 2y' + 5y = {right.format(variable)}", None, None, None, kovacic.Limits()
    )
    assert (question.x, question.given) == (expected.x, expected.given)
    for end in range(len(declared)):  # of what is still being typed
        with suppress(kovacic.InputError):
            Paste(declared[:end])


def test_values_of_a_function_with_a_greek_name_in_latex() -> None:
    text = r"\ddot{\theta} + \frac{g}{L}\theta = 0,\quad \theta(0)=\theta_0,\ \dot\theta(0)=0"
    question = read_question(text, None, None, None, kovacic.Limits())
    assert [condition.text for condition in question.conditions] == ["theta(0) = theta_0", "theta'(0) = 0"]
    assert (
        kovacic.solve(r"\theta'' + \cos(2) \theta = 0").equation == kovacic.solve("theta'' + cos(2) theta = 0").equation
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("(D + y) y = 0", "a sum of an operator and a function"),
        ("(D + 1) = 0", "applied to nothing"),
        ("y'' + (d/dx + x) = 0", "a sum of an operator and a function"),
        ("(d/dx + 1) y = dy/dt", "with respect to something else than x"),
        ("x*d/dx + 1", "the operator d/dx is applied to nothing"),
        ("y'' = diff((1, 2), x)", "isn't a derivative that can be read"),
        ("y'' + y(x, t) = 0", "a function of x alone"),
    ],
)
def test_derivatives_that_mean_nothing_are_refused(text: str, said: str) -> None:
    for door in (kovacic.solve, kovacic.dsolve):
        with pytest.raises(kovacic.InputError, match=said):
            door(text)


def test_eigenvalue_problems_take_their_conditions_from_the_text() -> None:
    (apart_from_it,) = kovacic.eigenvalues("y'' + lambda*y = 0", "y(0)=0, y(pi)=0", count=1)
    (within,) = kovacic.eigenvalues("y'' + λ y = 0, y(0)=0, y(π)=0", count=1)
    assert within == apart_from_it


@parametrize("row", PASTED, ordinary=30, long=161, ids=[row["text"] for row in PASTED])
def test_what_people_paste_is_what_they_mean(row: dict[str, Any]) -> None:
    """The coefficients of an equation, its right-hand side, its variable and its values are those that a reader finds."""
    question = read_question(row["text"], None, None, None, kovacic.Limits())
    equation = question.given
    argument = sympy.Symbol(row["variable"])
    assert str(question.x) == row["variable"]
    values = [condition.text.replace(" ", "").replace("π", "pi") for condition in question.conditions]
    assert values == row["values"]
    a, b, c, f = (meant(part) for part in row["equation"])
    if equation.change is not None:
        return
    e = {sympy.Symbol("e"): sympy.E}
    parts = (equation.a, equation.b, equation.c, equation.f)
    A, B, C, F = (meant(part.to_str()).subs(x, argument).subs(e) for part in parts)
    F += 0 if equation.h is None else meant(str(question.own(equation.h)))
    for found, expected in ((A * b, a * B), (A * c, a * C), (A * f, a * F)):
        assert sympy.simplify(found - expected) == 0


@pytest.mark.parametrize(
    ("text", "written", "typed"),
    [
        ("y'' + 2.5*y = e^2x", "e^2x", "e^(2*x)"),
        ("y'' + y = e^at", "at", "(a*t)"),
        ("y'' = 1,5*y", "1,5", "1.5"),
        ("y'' + y = u(t-1)", "u(t-1)", "heaviside(t-1)"),
        ("y'' + 3y' + 2y = δ(t)", "δ(t)", "dirac(t)"),
        ("y'' = 3⁄4 y", "3⁄4 y", "(3/4)*y"),
        ("solve y'' + x*y = 0", "solve ", ""),
        ("(2) y'' + y = sec(x)", "(2)", "2*"),
        ("y'' + 1e-3y = 0", "1e-3y", "1e-3*y"),
        ("y'' + 1e-3y' + y = 0", "1e-3y'", "1e-3*y'"),
        ("y'' + y = 1e-3sin(x)", "1e-3sin", "1e-3*sin"),
        ("y'' = 2e+1x y", "2e+1x", "2e+1*x"),
        ("(2.3) y'' + y = 0", "(2.3)", "2.3*"),
        ("u_t = u_xx", "u_t", "t"),
        ("u_xx + u_yy = 0", "u_yy", "u"),
        ("y'' + y = t if t<1 else 0", "t if t<1 else 0", "Piecewise((t, t<1), (0, True))"),
        ("could you solve y''+3y'+2y=e^(-x) for me?", " for me", ""),
        ("y'' + y = log10(x)", "log10(x)", "log(x)/log(10)"),
        ("y''+4y=0 (y(0)=1)", " (y(0)=1)", ", y(0)=1"),
        ("dsolve(y(x).diff(x,2)+y(x), hint='best')", "dsolve(y(x).diff(x,2)+y(x), hint='best')", "y(x).diff(x,2)+y(x)"),
        (r"y'' + y = \operatorname{sinc} x", r"\operatorname{sinc} x", "x"),
        (r"y'' + \alpha y = 0 \text{whatever}", r"\text{whatever}", ""),
        (r"y'' + a_{n+1} y = \cos x", "_{n+1}", "_{n1}"),
    ],
)
def test_what_can_be_read_in_two_ways_is_refused_with_what_to_type(text: str, written: str, typed: str) -> None:
    with pytest.raises(kovacic.InputError) as refused:
        read_question(text, None, None, None, kovacic.Limits())
    assert refused.value.hint
    read_question(text.replace(written, typed), None, None, None, kovacic.Limits())


@pytest.mark.parametrize(
    "text",
    [
        "y'' + y = sin 2*x",
        "y'' + y = cos omega*t",
        "y'' + y = sin 2(x+1)",
        "y'' + y = ln^2 n*x",
        "y'' + y = x^2n",
        "y'' + y = (1-x)^2n",
        "y'' + y = 2^-3x",
        "y'' + d/dx x y = 0",
        "y'' + (d/dx) x y = 0",
        "d/dx (1-x^2) dy/dx + y'' = 0",
        "y'' + d/dx sin x y = x",
        "y'' + y = d/dx x^2",
        "y'' + d/dx y/x = 0",
        "1/2 m y'' + y = 0",
        "y'' + 1/2 x y' + y = 0",
        "y'' + (1/2my') + y = 0",
    ],
)
def test_both_readings_of_what_is_refused_can_be_written_and_differ(text: str) -> None:
    with pytest.raises(kovacic.ParseError, match="two ways") as refused:
        read_input(text, exponentials=True)
    readings = str(refused.value.hint).removeprefix("write ").split(" or ")
    first, second = (
        read_input(text.replace(refused.value.excerpt, reading), exponentials=True) for reading in readings
    )
    assert first.equation != second.equation


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("y'' + x^-3/2*y = 0", r"a root is written ^(-3/2)"),
        ("y'' + y = e^-x^2/2", "e^-x^2/2 was read as (e^-x^2)/2"),
        ("y'' + y = e^x/2", "e^x/2 was read as (e^x)/2"),
        ("y'' + 1/2x y' = 0", "/2x was read as /(2x)"),
        ("(ħ²/2m) y'' = y", "/2m was read as /(2m)"),
    ],
)
def test_the_less_likely_of_two_readings_is_said(text: str, said: str) -> None:
    assert any(said in each for each in read_input(text).guesses)


def test_the_imaginary_unit_is_a_capital_letter_which_is_said() -> None:
    assert any("the imaginary unit is I" in said for said in read_input("y'' + (x + i)*y = 0").notices)


def test_command_and_values_are_read_in_one_way_with_values_apart() -> None:
    """DSolve and dsolve with values, pasted whole, give what the equation and its values give."""
    expected = kovacic.dsolve("y'' + y = 0, y(0) = 1, y'(0) = 2")
    for text in (
        "DSolve[{y''[x] + y[x] == 0, y[0] == 1, y'[0] == 2}, y[x], x]",
        "dsolve({diff(y(x), x, x) + y(x) = 0, y(0) = 1, D(y)(0) = 2}, y(x));",
        "dsolve(Eq(y(x).diff(x, 2) + y(x), 0), ics={y(0): 1, y(x).diff(x).subs(x, 0): 2})",
        "dsolve('D2y = -y', 'y(0)=1', 'Dy(0)=2', 'x')",
        r"y''+y=0 \text{ and } y(0)=1, \quad y'(0)=2",
        "y''(x) + \ny(x) = 0 where y(0) = 1\ny'(0) = 2",
        r"\begin{cases} y''+y=0 \\ y(0)=1 \\ y'(0)=2 \end{cases}",
    ):
        assert kovacic.dsolve(text) == expected
    assert kovacic.dsolve("y'' + y = 0", ics="y(0) = 1, D(y)(0) = 2") == expected


@pytest.mark.parametrize("letter", ["a", "k", "ω", "alpha"])
@pytest.mark.parametrize("digits", ["0", "1", "12", "307", "10"])
def test_lowered_digits_are_one_index(letter: str, digits: str) -> None:
    lowered = "".join(chr(ord("₀") + int(digit)) for digit in digits)
    expected = read_input(f"y'' = {letter}_{digits}*y")
    assert read_input(f"y'' = {letter}{lowered}*y").equation == expected.equation
    assert read_input(f"y'' + x*y' = {letter}{lowered}*x*y").S.field.ground.names == (f"{letter}_{digits}",)


@pytest.mark.parametrize("number", ["2", "12", "0.5"])
def test_a_lowered_digit_behind_a_number_is_no_digit_of_it(number: str) -> None:
    with pytest.raises(kovacic.ParseError, match="indices"):
        read_input(f"y'' = {number}₁*y")


@pytest.mark.parametrize(
    ("text", "written", "typed"),
    [
        ("y'' + y = xsinx", "xsinx", "x*sin(x)"),
        ("y'' + y = sinxcosx", "sinxcosx", "sin(x)*cos(x)"),
        ("y'' + y = xlnx", "xlnx", "x*ln(x)"),
        ("x'' + x = tsint", "tsint", "t*sin(t)"),
        ("x'' + x = Fcoswt", "Fcoswt", "F*cos(w*t)"),
        ("y'' = x2y", "x2y", "x*2*y"),
        ("y'' = x2*y", "x2", "x^2"),
        ("y'' + y = asinx", "asinx", "a*sin(x)"),
        ("y'' + y = acosx", "acosx", "acos(x)"),
        ("EI w'' + P w = 0", "EI", "B"),
        ("E I w'' = -P w", "E I", "B"),
        (r"E I \frac{d^2w}{dx^2} = -P w", "E I", "B"),
        ("y'' = 1/2x*y", "1/2x", "(1/2)*x"),
        ("mass*y'' + k*y = 0", "mass", "m"),
        ("y'' + y = 0, y(0)=1 y'(0)=0", "y(0)=1 y'(0)=0", "y(0)=1, y'(0)=0"),
        ("y'' + y = 0, k=2", ", k=2", ""),
        ("f := x^2; ode := y'' = f*y", "f := x^2; ", ""),
        ("eq1: y'' + y = 0; eq2: z'' + z = 0", "; eq2: z'' + z = 0", ""),
        ("solve y'' + x*y = 0", "solve", ""),
    ],
)
def test_what_means_nothing_is_refused_with_what_to_type(text: str, written: str, typed: str) -> None:
    with pytest.raises(kovacic.InputError) as refused:
        read_question(text, None, None, None, kovacic.Limits())
    assert refused.value.hint
    assert refused.value.position is not None
    read_question(text.replace(written, typed), None, None, None, kovacic.Limits())


def test_declared_names_are_parameters_at_every_door() -> None:
    assert kovacic.solve("EI*y'' + P*y = 0", parameters=["EI"]).S.field.ground.names == ("EI", "P")
    assert "EI" in str(kovacic.dsolve("EI*y'' + P*y = 0", parameters=["EI"]))
    assert kovacic.decide("mass*x", var="x", parameters=["mass"]).case is None
    assert kovacic.conditions("mass*(mass+1)/x^2 - 1", parameters=["mass"]).parameters == ("mass",)
    assert kovacic.spectrum("mass*x^2", parameters=["mass"], assume={"mass": "positive"}).complete
    assert kovacic.solve("EI*y'' + P*y = 0", assume={"EI": 1}).S.field.ground.names == ("P",)
    with pytest.raises(kovacic.InputError, match="list of names"):
        kovacic.solve("EI*y'' + P*y = 0", parameters="EI")
    answer = kovacic.solve("EI*y'' + P*y = 0", parameters=["EI"])
    assert kovacic.Solution.from_json(answer.to_json()) == answer


#: What is put into texts.
ALPHABET = [*"x|()[]{}^/=,;:%#$\\_\n", "y'", "''", "ˣ", "½", r"\frac", r"\sqrt", "sin", "dx", "d^2", "diff("]
ALPHABET += ["D@@", "==", "and ", ":=", r"\text{", "dsolve(", "Derivative[2]", "1E2"]


@parametrize("seed", range(12), ordinary=1, long=(1, 2, 3, 4, 5, 6, 8, 9, 10, 11))
def test_mutated_texts_are_read_or_refused(seed: int) -> None:
    """Nothing but `InputError` is raised, whatever is left out, put in or repeated."""
    rng = random.Random(seed)
    for _ in range(250):
        text = list(rng.choice(PASTED)["text"])
        for _ in range(rng.randint(1, 4)):
            k = rng.randrange(len(text) + 1)
            action = rng.randrange(3)
            if action == 0:
                del text[k : k + rng.randint(1, 3)]
            elif action == 1:
                text.insert(k, rng.choice(ALPHABET))
            else:
                text[k:k] = text[: rng.randint(1, 9)]
        mutated = "".join(text)
        with suppress(kovacic.InputError):
            equation, _ = apart(mutated, None)
            source_of(equation, None, kovacic.Limits(), equation=True)


def test_a_named_equation_beside_another_belongs_to_the_system() -> None:
    """Only a command says which equations are meant."""
    u, v = kovacic.dsolve("u' = v; de2 := v' = -u")
    assert "cos" in str(u.rhs)
    assert "sin" in str(v.rhs)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("xy'' + 2y' + xy = 0", "xy was read as x\\*y"),
        ("r*y'' + y' + r*y = 0", "r is taken for the variable"),
        ("y'' - 2^-tau*y = 0", "tau is taken for the variable"),
        ("y'' + y = sin x/2", "sin x/2 was read as \\(sin x\\)/2"),
        (r"u'' + u = \sin n\pi x/L", "was read as"),
        ("y'' + 2jωy' + y = 0", "the imaginary unit is I"),
        ("DSolve[y''[x] + E y[x] == 0, y[x], x]", "Euler's number is e"),
        ("I*θ'' + b*θ' + k*θ = 0", "I is the imaginary unit"),
        ("I y'' = M", "I is the imaginary unit"),
        ("dN/dt = r N (1 - N/K)", r"N \(1 - N/K\) was read as a product"),
        ("y'' + y = x [2]", "number of the equation"),
        ("3. y'' - 4y = 0", "3. was taken for a number in a list"),
        ("Solve the equation y'' + y = 0", "left out: Solve the equation"),
    ],
)
def test_dsolve_warns_of_what_was_guessed(text: str, said: str) -> None:
    with pytest.warns(UserWarning, match=said):
        kovacic.dsolve(text)


@pytest.mark.parametrize("text", ["T'' - m^2*(T - Ta) = 0, T(0) = Tb", "V'' + Vs = 0", "u' = k*(us - u)"])
def test_an_unknown_with_an_index_is_not_a_product(text: str) -> None:
    with pytest.raises(kovacic.ParseError, match=r"(?s)is one name, and not a known one.*declare it"):
        kovacic.dsolve(text)


@pytest.mark.parametrize(
    "door",
    [
        lambda text, values: kovacic.evaluate(text, 1, x0=0, y0=1, dy0=0, params=values),
        lambda text, values: kovacic.tabulate(text, 0, 1, x0=0, y0=1, dy0=0, params=values)(1.0),
        lambda text, values: lambdify(text, interval=(0, 1), x0=0, y0=1, dy0=0, params=values, check=False)(1.0),
        lambda text, values: kovacic.connection_matrix(text, [0, 1], params=values)[0][0],
        lambda text, values: kovacic.dsolve(text, ics="y(0)=1, y'(0)=0", assume={"mass": "positive"}).rhs.subs(x, 1),
    ],
)
def test_a_name_with_a_value_is_declared(door: Callable[[str, dict[str, int]], Any]) -> None:
    assert float(door("mass*y'' + mass*y = 0", {"mass": 2})) == pytest.approx(0.5403023058681398)


def test_a_name_with_a_value_is_declared_in_eigenvalue_problems() -> None:
    given = {"mass": 2, "width": 1}
    (first,) = kovacic.eigenvalues(
        "mass*y'' + rate*y = 0", "y(0)=0, y(width)=0", parameter="rate", params=given, count=1
    )
    assert float(first.value) == pytest.approx(19.739208802178716)


def test_names_are_declared_for_a_batch_or_a_row() -> None:
    rows = ["EI*w'' = -P*w", {"S": "rate/x^2", "names": ["rate"]}, {"S": "rate/x^2"}]
    assert [record.label for record in kovacic.solve_many(rows, parameters=["EI"], jobs=1)] == [
        "case 1", "case 1", "bad input",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["dsolve", "m x'' + c x' + k x = 0"], "m*x'' + c*x' + k*x = 0, x(t), parameters m, c, k"),
        (["dsolve", "y' = k y - r y^2"], "y' = k*y - r*y^2, y(x), parameters k, r"),
        (["dsolve", "y' + y = x"], None),
        (["evaluate", "y'' + xy = 0", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"], "y'' + x*y = 0, y(x)"),
        (["evaluate", "k*x", "--param", "k=2", "--x0", "0", "--y0", "1", "--dy0", "0", "--at", "1"], None),
    ],
)
def test_the_command_says_what_was_read(
    arguments: list[str], said: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run(arguments)
    lines = capsys.readouterr().err.splitlines()
    assert [line for line in lines if "read as" in line and "was" not in line] == (
        [f"kovacic: read as {said}"] if said else []
    )


def test_given_functions_are_read_where_the_unknown_one_is_named() -> None:
    given, y = sympy.Function("g"), sympy.Function("y")
    equation = sympy.Eq(y(x).diff(x, 2) + y(x), given(x))
    assert (
        kovacic.dsolve("y'' + y = g(x)", "y(x)") == kovacic.dsolve(equation, y(x)) == kovacic.dsolve("y''+y=g(x)", "y")
    )
    with pytest.raises(kovacic.InputError):
        kovacic.dsolve("y'' + y = g(x)")


@pytest.mark.parametrize(
    "text",
    [
        "x' = y, y' = -x, x(0) = 1, y(0) = 0",
        "dx/dt = y; dy/dt = -x; x(0) = 1; y(0) = 0",
        r"\dot{x} = y, \dot{y} = -x, x(0) = 1, y(0) = 0",
        "DSolve[{x'[t] == y[t], y'[t] == -x[t], x[0] == 1, y[0] == 0}, {x[t], y[t]}, t]",
        "dsolve([diff(x(t),t) = y(t), diff(y(t),t) = -x(t), x(0) = 1, y(0) = 0], [x(t), y(t)])",
    ],
)
def test_systems_are_read_in_their_notations(text: str) -> None:
    first, second = kovacic.dsolve(text)
    assert (str(first), str(second)) == ("Eq(x(t), cos(t))", "Eq(y(t), -sin(t))")


def test_a_value_declares_its_name() -> None:
    expected = kovacic.evaluate("y'' + 2*y = 0", 1, x0=0, y0=1, dy0=0)
    assert kovacic.evaluate("mass*y'' + k*y = 0", 1, x0=0, y0=1, dy0=0, params={"mass": 1, "k": 2}) == expected


def test_plain_texts_are_read_as_all_others() -> None:
    """The short way of texts without notations of others gives the tokens, places included, of the long one."""
    rng = random.Random(3)
    parts = [*"xytakiITHuSCn()+-*/^=2013", "y'", "y''", "**", "(x)", "13", " ", "  ", " = "]
    texts = [row["text"] for row in PASTED] + [
        "".join(rng.choice(parts) for _ in range(rng.randint(1, 14))) for _ in range(4000)
    ]
    plain = 0
    for text in texts:
        if not is_plain(text):
            continue
        plain += 1
        paste = Paste(text)
        (found,) = paste.equations
        other = tokenize(text)
        assert (list(found), found.text, found.variable) == (list(other), other.text, other.variable), text
        assert paste.is_equation == ("=" in text or "'" in text)
        assert (paste.notes, paste.variable, len(paste.equation_scans)) == ([], None, 1), text
    assert plain > 1000


def test_evaluate_warns_of_what_was_guessed() -> None:
    with pytest.warns(UserWarning, match=r"a root is written \^\(1/2\)"):
        value = kovacic.evaluate("a^1/2*x^2", 2, x0=1, y0=1, dy0=0, params={"a": 4})
    assert value.overlaps(kovacic.evaluate("2*x^2", 2, x0=1, y0=1, dy0=0))

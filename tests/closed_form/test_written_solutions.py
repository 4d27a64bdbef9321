"""The solutions that the command prints: the same as `Solution.solutions` has, and solutions of the equation."""

from __future__ import annotations

import contextlib
import io
import json
import re
from pathlib import Path

import pytest
import sympy
from build import generated, parametrize, run, size
from hypothesis import given
from hypothesis import strategies as st
from test_textbook_equations import EQUATIONS

import kovacic

x = sympy.Symbol("x")
DATA = Path(__file__).parents[1] / "data" / "cases.jsonl"
CASES = [json.loads(line)["S"] for line in DATA.read_text(encoding="utf-8").splitlines()]


def read(text: str) -> sympy.Expr:
    return sympy.sympify(text.replace("^", "**"))


def texts_of(equation: str, *options: str) -> tuple[str, ...] | None:
    """What the command prints, where it can be read as it is: neither shortened nor with sums over roots."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        assert run(["solve", equation, *options]) == 0
    lines = [line.strip() for line in printed.getvalue().splitlines()]
    texts = [line.partition(" = ")[2] for line in lines if line.startswith(("y1 = ", "y2 = "))]
    readable = len(texts) == 2 and not any(re.search(r"Sum|Root|\.\.\.|elliptic", text) for text in texts)
    return tuple(texts) if readable else None


def vanishes(expression: sympy.Expr) -> bool:
    return size(expression.subs(x, sympy.Rational(137, 101)), 30) < 1e-20


@pytest.mark.long
@pytest.mark.parametrize("equations", [CASES[::4], [text for text, _ in EQUATIONS]], ids=["published", "textbooks"])
def test_the_text_is_that_of_the_closed_form(equations: list[str]) -> None:
    seen = 0
    for equation in equations:
        answer = kovacic.solve(equation)
        texts = texts_of(equation) if answer.case else None
        if texts is None:
            continue
        seen += 1
        for text, y in zip(texts, answer.solutions, strict=True):
            assert sympy.expand(read(text) - y) == 0 or vanishes(sympy.diff(read(text) / y, x)), (equation, text, y)
    assert seen >= 20


EXPONENTS = st.fractions(min_value=-2, max_value=2, max_denominator=3)


@pytest.mark.long
@generated(4)
@given(
    st.tuples(EXPONENTS, EXPONENTS),
    st.tuples(EXPONENTS, EXPONENTS),
    st.integers(-2, 2),
    st.sampled_from(["0", "x", "-x^2/2 + x", "3/(2*x)", "x - 2/(3*x^2)", "x/(3*x - 1)"]),
)
def test_products_come_back(first: tuple, second: tuple, a: int, exponent: str) -> None:
    """y1 and y2 are chosen; both satisfy the equation that is made of them, and nothing else does."""

    def omega(powers: tuple, inner: sympy.Expr) -> sympy.Expr:
        alpha, beta = (sympy.Rational(p.numerator, p.denominator) for p in powers)
        return alpha / x + beta * 2 * x / (x**2 - 3) + sympy.diff(inner, x)

    u, v = omega(first, read(exponent)), omega(second, a * x)
    if vanishes(u - v):
        return
    # y'' + b y' + c y = 0 with (u' + u^2) + b u + c = 0, and so for v.
    b = -((sympy.diff(u, x) + u**2) - (sympy.diff(v, x) + v**2)) / (u - v)
    c = -(sympy.diff(u, x) + u**2) - b * u
    texts = texts_of(f"y'' + ({b})*y' + ({c})*y = 0")
    if texts is None:  # an integral of y1^-2 that is no product, where y1 is the only one
        return
    rates = [sympy.diff(read(text), x) / read(text) for text in texts]
    assert not vanishes(rates[0] - rates[1])
    for rate in rates:
        assert vanishes(sympy.diff(rate, x) + rate**2 + b * rate + c)


@parametrize(
    ("S", "texts"),
    [
        ("-1", ("cos(x)", "sin(x)")),
        ("2", ("exp(sqrt(2)*x)", "exp(-sqrt(2)*x)")),
        ("2/x^2", ("1/x", "x^2")),
        ("6/x^2 - 3", None),
        ("0", ("1", "x")),
        ("(4*x^6-8*x^5+12*x^4+4*x^3+7*x^2-20*x+4)/(4*x^4)", None),
    ],
    ordinary=(0,),
)
def test_texts(S: str, texts: tuple[str, str] | None) -> None:
    found = texts_of(S)
    assert found is not None
    if texts is None:
        for text in found:
            y = read(text)
            residual = sympy.expand((sympy.diff(y, x, 2) - read(S) * y) / read(found[0]))
            integrals = {integral: sympy.Dummy() for integral in residual.atoms(sympy.Integral)}
            assert sympy.simplify(residual.xreplace(integrals)) == 0
    else:
        assert found == texts


@pytest.mark.parametrize("S", ["x^2 + 3", "1/x - 3/(16*x^2)", "3/x^2", "n^2"])
def test_what_is_no_product_over_the_rationals_is_that_of_sympy(S: str) -> None:
    answer = kovacic.solve(S, var="x")
    assert texts_of(S, "--var", "x") == tuple(str(y).replace("**", "^") for y in answer.solutions)

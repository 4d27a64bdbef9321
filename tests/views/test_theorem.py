"""Conditions as a theorem: its cases are those of the regions, what is printed is true, and every format can be read."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise, product
from pathlib import Path
from random import Random
from typing import Any

import pytest
import sympy
from build import Conditions, parametrize, run
from parametric_cases import hypergeometric

import kovacic
from kovacic.decision import Structure
from kovacic.parametric.api import Sampler
from kovacic.parametric.regions import Theory, solvable_cases
from kovacic.parametric.riemann import Schwarz, kimura_structure
from kovacic.parametric.solutions import families_of
from kovacic.parametric.statements import Both, Either, Statement, Vanishes
from kovacic.views.theorem import blocks
from kovacic.writing.document import Formula, Math, Paragraph, Table, format_of
from kovacic.writing.formula import text_of_words

R = sympy.Rational
x = sympy.Symbol("x")
#: The variational equations of homogeneous potentials of degree k, with the eigenvalue L [Morales-Ruiz & Ramis 2001].
HOMOGENEOUS = "-(1-1/k^2)/(4*x^2) - (1-1/4)/(4*(x-1)^2) - (1/k^2+1/4-((k-2)^2+8*k*L)/(4*k^2)-1)/(4*x*(x-1))"
#: Perturbations of a black hole [Chandrasekhar 1984]: solvable where s = +-(l-1) l (l+1) (l+2)/6.
#: Lame's equation with n = 1/2.
HALF_LAME = "(-16*B*g2*x - 16*B*g3 + 64*B*x^3 - 3*g2^2 - 36*g2*x^2 - 108*g3*x)/(16*(-g2*x - g3 + 4*x^3)^2)"
BLACK_HOLE = "(s^2 + (x-1)*(l*(l+1)*x-3)/x^4)*x^2/(x-1)^2 - (4*x-3)/(4*x^2*(x-1)^2)"
FAMILIES = {
    "whittaker": "1/4 - k/x + (4*m^2-1)/(4*x^2)",
    "weber": "x^2 + mu",
    "quartic": "x^4 + a*x^2 + b*x + c",
    "riemann": hypergeometric(("l", "m", "n")),
    "homogeneous": HOMOGENEOUS,
    "black hole": BLACK_HOLE,
    "doubly confluent": "1 + D/x + q/x^2 + a/x^4",
    "lame": "(5*x^4 + 4*B*x^3 - 98*x^2 + (-28*B + 192)*x + 24*B - 147)/(16*x^6 - 224*x^4 + 192*x^3 + 784*x^2 - 1344*x + 576)",
    "legendre": "(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0",
    "morse": "A^2*exp(-2*x) - 2*A*b*exp(-x) - E",
    "coulomb": "l*(l+1)/x^2 - 2*Z/x + b^2",
    "constant": "sqrt(2)*mu + x^2",
}
PREAMBLE = r"""\documentclass{article}
\usepackage{amsmath,amssymb,amsthm,graphicx}
\newtheorem{theorem}{Theorem}
\begin{document}"""


@cache
def conditions(name: str, k: str = "") -> kovacic.Conditions:
    return kovacic.conditions(FAMILIES[name], var="x", assume={"k": k} if k else None)


@parametrize("name", FAMILIES, ordinary=1, long=1)
def test_the_cases_say_what_the_regions_say(name: str) -> None:
    """Solvable exactly where one of the cases holds, in the case of the first one."""
    answer = conditions(name)
    cases = solvable_cases(answer.regions)
    statements = [region.statement for region in answer.regions]
    points = Sampler(answer.constant, answer.parameters, answer.assumptions, Random(7)).points(statements)
    seen = 0
    while seen < 60:
        point = next(points)
        verdict = None if point is None else answer.predicted(point)
        if point is None or verdict is None:
            continue
        seen += 1
        holding = [case for case in cases if case.statement.holds(point)]
        first = next((one for one in holding if not any(other.holds(point) for other in one.without)), None)
        assert (first.regions[0].verdict if first else answer.generic).case == verdict.case, str(point)


@parametrize(
    ("S", "last", "exceptions"),
    [
        # What isn't solvable is said where a later case would hold there, and only then: not where Delta_d decides.
        ("a + D/x + q/x^2 + a/x^4", "a = D^2/(4*(d + 1)^2)", []),
        (BLACK_HOLE, "s = +-(d + 3)/2", []),
        (HALF_LAME, ") B = 0", ["g2^3 != 27*g3^2"]),
    ],
    ordinary=1,
)
def test_exceptions_are_named_where_they_matter(S: str, last: str, exceptions: list[str]) -> None:
    text = kovacic.conditions(S, var="x").theorem()
    (sentence,) = (line for line in text.split("\n\n") if last in line)
    assert re.findall(r"\S+ != \S+(?=[,.])", sentence) == exceptions


def table_of_morales_and_ramis(k: int, p: int) -> Iterator[Fraction]:
    """All L of the table for one k and one p, but for k = 2 and -2, where there is no condition."""
    F = Fraction
    yield p + F(p * (p - 1) * k, 2)
    yield F(1, 2) * (F(k - 1, k) + p * (p + 1) * k)
    rows = {
        -5: (F(49, 40), F(-1, 40), 10, (F(10, 3), F(4))),
        -4: (F(9, 8), F(-1, 8), 4, (F(4, 3),)),
        -3: (F(25, 24), F(-1, 24), 6, (F(2), F(3, 2), F(6, 5), F(12, 5))),
        3: (F(-1, 24), F(1, 24), 6, (F(2), F(3, 2), F(6, 5), F(12, 5))),
        4: (F(-1, 8), F(1, 8), 4, (F(4, 3),)),
        5: (F(-9, 40), F(1, 40), 10, (F(10, 3), F(4))),
    }
    if k in rows:
        start, factor, step, residues = rows[k]
        for residue in residues:
            yield start + factor * (residue + step * p) ** 2


@pytest.mark.long
def test_the_table_of_morales_and_ramis() -> None:
    """For an integer k: solvable at every value of the table, and at no other one between them."""
    answer = conditions("homogeneous", "integer")
    random = Random(3)
    for k in (-6, -5, -4, -3, 3, 4, 5, 7):
        known = {L for p in range(-9, 10) for L in table_of_morales_and_ramis(k, p)}
        near = {L + Fraction(random.randint(-5, 5), random.choice((24, 40, 96))) for L in sorted(known)[:12]}
        for L in {*list(known)[:20], *near}:
            expected = any(L in {*table_of_morales_and_ramis(k, p)} for p in range(-60, 61))
            assert (answer.case_at({"k": k, "L": L}) is not None) is expected, (k, L)
    assert answer.case_at({"k": 2, "L": Fraction(1, 7)}) == answer.case_at({"k": -2, "L": Fraction(3, 7)}) == 2
    theorem = answer.theorem()
    for k in (-5, -4, -3, 3, 4, 5):
        assert f"k = {k} " in theorem.replace(",", " ")
    assert "Schwarz" not in theorem


@pytest.mark.long
def test_an_integer_parameter_has_few_values_where_a_quotient_is_a_fraction_of_the_table() -> None:
    """2/(2k+1) in place of 1/k; what is outside of the assumptions isn't named."""
    S = hypergeometric(("2/(2*k+1)", "1/2", "l"))
    answer = kovacic.conditions(S, var="x", assume={"k": ">=0 integer"})
    assert answer.check(120)
    assert answer.complete is True
    assert not any("-" in str(region.statement).split(",")[0] for region in answer.regions if region.case == 3)


def test_a_row_without_parameters_is_decided() -> None:
    """At L = 0 and an integer k the third difference, sqrt(4/k^2 - 3)/2, is no rational number but for k = +-1."""
    S = "L*(1+2*k)/(2*k*x) + (1/k^2-1)/(4*x^2) - 3/(16*(x-1)^2) - L/(2*k*(x-1))"
    answer = kovacic.conditions(S, var="x", assume={"k": "integer"}, max_degree=0)
    assert "Schwarz" not in answer.text()
    assert answer.check(20)


def schwarz_parts(statement: Statement) -> Iterator[Schwarz]:
    if isinstance(statement, Schwarz):
        yield statement
    if isinstance(statement, Both | Either):
        for part in statement.parts:
            yield from schwarz_parts(part)


@parametrize("third", [Fraction(1, 2), Fraction(1, 3), Fraction(2, 5), Fraction(7, 4)], ordinary=0, long=1)
def test_rows_beside_a_constant_difference_are_those_of_the_table(third: Fraction) -> None:
    answer = kovacic.conditions(hypergeometric(("l", "m", str(third))), var="x")
    parts = [part for region in answer.regions for part in schwarz_parts(region.statement)]
    rows = [(kind, [*map(text_of_words, words)]) for part in parts for kind, words in part.resolved()[1]]
    for l, m in product((Fraction(i, 60) for i in range(-7, 150, 3)), repeat=2):  # noqa: E741
        found = {
            kind
            for kind, texts in rows
            if all(_lies_in(value, text) for value, text in zip((l, m), texts, strict=True))
        }
        structure = kimura_structure((l, m, third))
        is_primitive = structure is not None and structure.case == 3
        assert found == ({structure} if is_primitive else set()), (l, m)


def _lies_in(value: Fraction, text: str) -> bool:
    """`+-1/3 + 2*Z`."""
    match = re.fullmatch(r"\+-(\S+) \+ (2\*)?Z", text)
    assert match is not None
    modulus = 2 if match[2] else 1
    return any((value - sign * Fraction(match[1])) % modulus == 0 for sign in (1, -1))


def parsed(text: str, names: dict[str, Any]) -> Any:
    words = {*re.findall(r"[A-Za-z_]\w*", text)} - {"exp", "sqrt", "assoc_laguerre", "I"}
    symbols = {name: sympy.Symbol(name) for name in words}
    return sympy.sympify(text.replace("^", "**"), locals=symbols | {"jacobi": jacobi} | names)


def jacobi(n: Any, a: Any, b: Any, z: Any) -> Any:
    """Jacobi's polynomial by its sum [DLMF 18.5.8], for a natural number n."""
    degree = int(n)
    return sum(
        sympy.binomial(n + a, degree - s)
        * sympy.binomial(n + b, s)
        * ((z - 1) / 2) ** s
        * ((z + 1) / 2) ** (degree - s)
        for s in range(degree + 1)
    )


def printed_solutions(answer: kovacic.Conditions) -> Iterator[tuple[str, str, list[str]]]:
    """y, the degree that has to be natural, and the signs to choose, as the theorem prints them."""
    parts = blocks(answer)
    for block, following in pairwise(parts):
        if isinstance(block, Formula) and block.math.text.startswith("y = ") and isinstance(following, Paragraph):
            said = [part for part in following.sentence if isinstance(part, Math)]
            if said and "natural number" in "".join(p for p in following.sentence if isinstance(p, str)):
                degree, *signs = (part.text for part in said if part.text != "+-1")
                yield block.math.text.removeprefix("y = "), degree, signs


def printed_rows(answer: kovacic.Conditions) -> Iterator[tuple[str, list[int]]]:
    """y, and the integers n of its progression with small absolute values, as the theorem prints them."""
    for block, following in pairwise(blocks(answer)):
        if isinstance(block, Paragraph) and isinstance(following, Formula):
            said = "".join(part if isinstance(part, str) else part.text for part in block.sentence)
            found = re.fullmatch(r"For (even |odd |)n ([<>])= (-?\d+)(?:, n != .*)?:", said)
            if found is not None:
                parity, sign, end = found.groups()
                numbers = range(int(end), 30, 1) if sign == ">" else range(int(end), -30, -1)
                step = 2 if parity else 1
                yield following.math.text.removeprefix("y = "), [*numbers][::step]


@parametrize(
    ("name", "S", "values"),
    [
        ("whittaker", "1/4 - k/x + (4*m^2-1)/(4*x^2)", {"k": R(10, 3), "m": R(5, 6)}),
        ("weber", "x^2 + mu", {"mu": -7}),
        ("riemann", FAMILIES["riemann"], {"l": R(1, 3), "m": R(1, 5), "n": R(53, 15)}),
        ("homogeneous", HOMOGENEOUS, {"k": 3, "L": 12}),
        ("morse", FAMILIES["morse"], {"A": R(2, 3), "b": R(7, 2), "E": -4}),
        ("coulomb", FAMILIES["coulomb"], {"l": 1, "Z": 3, "b": 1}),
    ],
    ordinary=1,
    long=1,
)
def test_printed_solutions_solve_the_equation(name: str, S: str, values: dict[str, Any]) -> None:
    """For every choice of the signs for which the printed degree is natural, by derivatives to 30 digits."""
    right = parsed(S, values)
    natural = 0
    for text, degree, signs in printed_solutions(conditions(name)):
        for chosen in product((1, -1), repeat=len(signs)):
            given = {**values, **dict(zip(signs, map(sympy.Integer, chosen), strict=True))}
            letter, _, value_of_degree = degree.rpartition(" = ")
            d = sympy.nsimplify(parsed(value_of_degree, given))
            if not (d.is_Integer and d >= 0):
                continue
            natural += 1
            given[letter] = d
            y = sympy.expand_func(parsed(text, given)).doit()
            value = (y.diff(x, 2) - right * y).subs(x, R(13, 7)).evalf(30, maxn=60)
            assert abs(value) < sympy.Float("1e-20") * abs(y.subs(x, R(13, 7)).evalf(30)), (text, given)
    families = [family for region in conditions(name).regions for family in families_of(region.statement.claim)]
    for text, numbers in printed_rows(conditions(name)):
        for n in numbers:
            given = {**values, "n": n}
            solved = {family.parameter: parsed(family.value.to_str("n"), given) for family in families}
            if any(sympy.nsimplify(value - values[parameter]) == 0 for parameter, value in solved.items()):
                natural += 1
                y = sympy.expand_func(parsed(text, given)).doit()
                value = (y.diff(x, 2) - right * y).subs(x, R(13, 7)).evalf(30, maxn=60)
                assert abs(value) < sympy.Float("1e-20") * abs(y.subs(x, R(13, 7)).evalf(30)), (text, given)
    assert natural


@parametrize(
    ("name", "values"),
    [
        ("quartic", {"a": R(2, 3), "b": R(5, 7), "c": R(1, 9)}),
        ("doubly confluent", {"D": R(2, 3), "q": R(5, 7), "a": R(9, 4)}),
        ("black hole", {"s": R(3, 7), "l": R(2, 5)}),
    ],
    ordinary=0,
    long=1,
)
def test_printed_weights_leave_a_polynomial_of_the_printed_degree(name: str, values: dict[str, Any]) -> None:
    """For theta = y'/y with P = 1, theta' + theta^2 - S has its poles with no more orders, and x^d fits at infinity."""
    right = parsed(FAMILIES[name], values)
    theorem = conditions(name).theorem()
    found = re.findall(
        r"y = (P_d\S*.*)\n\nwith a polynomial P_d of degree d = (.*?), with a choice of (.*?) from", theorem
    )
    assert found
    for text, degree, names in found:
        signs = re.split(", | and ", names)
        for chosen in product((1, -1), repeat=len(signs)):
            given = {**values, **dict(zip(signs, map(sympy.Integer, chosen), strict=True)), "P_d": sympy.Integer(1)}
            y, d = parsed(text, given), parsed(degree, given)
            theta = sympy.cancel(sympy.together(sympy.simplify(y.diff(x) / y)))
            rest = sympy.cancel(sympy.together(theta.diff(x) + theta**2 - right))
            assert sympy.rem(sympy.denom(theta), sympy.denom(rest), x) == 0
            terms = d * (d - 1) / x**2 + 2 * theta * d / x + rest
            assert _order(terms) < max(_order(theta / x), -2), (text, given)


def _order(function: Any) -> int:
    """The power of x with which it grows; a large negative one for 0."""
    above, below = sympy.fraction(sympy.cancel(sympy.together(function)))
    return -(10**6) if above == 0 else int(sympy.degree(above, x) - sympy.degree(below, x))


@pytest.mark.long
def test_polynomials_are_printed_in_factors() -> None:
    """Chandrasekhar's algebraically special frequencies."""
    assert "s = -l*(l - 1)*(l + 1)*(l + 2)/6 or l*(l - 1)*(l + 1)*(l + 2)/6" in str(conditions("black hole"))


@parametrize("name", FAMILIES, ordinary=1, long=6)
def test_words_and_formulas_are_kept_apart(name: str) -> None:
    """No formula stands among the words, where LaTeX would print it raw."""
    for block in blocks(conditions(name)):
        sentences = [block.sentence] if isinstance(block, Paragraph) else []
        if isinstance(block, Table):
            sentences = [cell for row in (block.head, *block.rows) for cell in row]
        for sentence in sentences:
            parts = [sentence] if isinstance(sentence, str) else sentence if not isinstance(sentence, Math) else []
            for part in parts:
                if isinstance(part, str) and not part.startswith("["):
                    assert not re.search(r"[\^*=]|sqrt|\w_\w|\w\(|\w/\w|!", part), part


@pytest.mark.parametrize("form", ["markdown", "html"])
def test_other_formats(form: str) -> None:
    theorem = conditions("weber").theorem(format=form)
    assert "if and only if" in theorem
    if form == "html":
        assert theorem.startswith("<!doctype html>")
        assert theorem.isascii()
        assert "<math" in theorem
    else:
        assert theorem.count("$$") % 2 == 0
    with pytest.raises(ValueError, match="unknown format"):
        conditions("weber").theorem(format="word")


@pytest.mark.long
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex isn't installed")
def test_latex_compiles_with_lines_that_fit_a_page(tmp_path: Path) -> None:
    body = "\n\\clearpage\n".join(conditions(name).theorem(format="latex") for name in FAMILIES)
    (tmp_path / "a.tex").write_text(f"{PREAMBLE}\n{body}\n\\end{{document}}\n", encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "a.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stdout[-2000:]
    assert not re.findall(r"Overfull \\hbox \((?!\d\.)", done.stdout)


def test_latex_has_the_environments_of_amsthm() -> None:
    """One theorem with its proof after it; the lines that follow are the author's again."""
    latex = conditions("weber").theorem(format="latex")
    inside = r"\\begin\{theorem\}(.*)\\end\{theorem\}\s*\\begin\{proof\}(.*)\\end\{proof\}\s*\{(.*)\\par\}\n"
    found = re.fullmatch(inside, latex, re.DOTALL)
    assert found is not None
    claim, proof, rest = found.groups()
    assert "if and only if" in claim
    assert "The list is complete" in proof
    assert r"\subsection*{References}" in rest
    assert r"\section" not in latex
    assert "section" not in claim + proof


def test_what_isnt_known_is_said() -> None:
    answer = kovacic.conditions("(n^2-2)*x^4 + m*x", var="x")
    assert "0 is" not in answer.theorem()
    undecided = kovacic.conditions(
        "w^2*x^2 + (3 - m)/x + l/(x - 1) + 1/(x - 2)", var="x", limits=kovacic.Limits(seconds=0.05)
    )
    if undecided.complete is not True:
        assert "The list is complete only as far as the limits allowed" in undecided.theorem()


def test_the_command_prints_the_theorem(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conditions", "--format", "text", "x^2 + mu"]) == 0
    assert "mu is an odd integer." in capsys.readouterr().out
    assert run(["conditions", "--assume", "mu=positive", "x^2 + mu"]) == 0
    assert capsys.readouterr().out.startswith("y'' = (x^2 + mu) y, parameters mu (mu positive)\n")
    assert run(["conditions", "--format", "latex", "--assume", "mu=positive", "x^2 + mu"]) == 0
    assert r"Let $\mu$ be a complex number, $\mu$ a positive number" in capsys.readouterr().out


@parametrize(
    ("S", "sentence"),
    [
        # The solutions are in the integer of the condition.
        ("l*(l+1)/x^2 + x^2 - E", "For E = 4*n - 2*l + 1, n >= 0:"),
        # A name means one thing: the integer of the condition isn't the degree, and no group is named after a parameter.
        ("k*(1+g/x)", "where N = (epsilon*g*sqrt(k) - zeta - 1)/2 is a natural number"),
        # What holds for l = 0 and l = -1 is said once.
        ("a*x^2 + c + l*(l+1)/x^2 + x^6", "(1) l = 0 or -1, and a = +-(2*d + 3), d in N, and Delta_d = 0."),
        (
            "((n^2+n)*x^2 - n^2 - n - 1)/(x^2-1)^2",
            "The group is finite cyclic, or G_a extended by a finite cyclic group.",
        ),
        # No condition that follows from the others.
        ("a*x^2 + c + l*(l+1)/x^2 + x^6", "(2) a = +-(2*d + 2*l + 5) or +-(2*d - 2*l + 3), d in N, and Delta_d = 0."),
        # One of several forms; the variable comes first.
        (hypergeometric(("l", "m", "n")), "(1) one of l + m + n, l + m - n, l - m + n or l - m - n is an odd integer."),
        ("(x-c)^2*y'' = (b + q*(x-c)^2 + r*(x-c))*y", "y'' = (q + r/(x - c) + b/(x - c)^2) y"),
        ("b/(x-c)^2 + q + r/(x-c)", "y = (x - c)^(sqrt(4*b + 1)/2 + 1/2)"),
    ],
    ordinary=3,
    long=(1, 3),
)
def test_theorems_are_printed_as_people_write_them(S: str, sentence: str) -> None:
    text = kovacic.conditions(S, var="x").theorem()
    assert sentence in text
    assert "mu_n" not in text
    assert not re.search(r"\*1\b|\b1\*|\+ -|For [^\n]*:\n\n(?!    )", text)


@parametrize(
    ("S", "expected"),
    [
        ("k*(1+g/x)", "abelian exactly where k*g^2 < 1"),
        ("x*y''+(1-x)*y'+m*y=0", "not abelian"),
        ("a/x^2 + b/x + c", "abelian exactly where sqrt(4*a + 1) is an integer and b^2/c < 4*a + 1"),
        ("a*b/(x^2 - 1)^2", "abelian"),
        ("y'' - 2*x*y' + 2*n*y = 0", "not abelian"),
        ("x^4 + a*x^2 + b*x + c", "not abelian"),
        ("x^6 + a*x^2 + b + c/x^2", "abelian exactly where two solutions have rational logarithmic derivatives"),
        (hypergeometric(("1/2", "1/2", "n")), "abelian"),
        (
            hypergeometric(("l", "m", "1/3")),
            "abelian where l, m are rational; elsewhere exactly where the group is G_m",
        ),
        # The sum of +-sqrt(...)/(2*k), 1/k and 1/2 is an integer.
        (HOMOGENEOUS, "abelian where 1/k is rational; elsewhere exactly where the group is G_m"),
    ],
    ordinary=(0, 4),
    long=(1, 2, 5, 7, 8, 9),
)
def test_the_identity_component_is_named(S: str, expected: str) -> None:
    answer = kovacic.conditions(S, var="x")
    assert f"Its identity component is {expected}." in answer.theorem()
    assert ("Cases and groups are those of the normal form." in answer.theorem()) is ("y'" in S)
    assert Conditions.from_json(answer.to_json()).theorem() == answer.theorem()


def test_whittakers_group_is_diagonal_where_the_theorem_says_so() -> None:
    """2 m an integer and k^2 < m^2, given that k + m or k - m is a half-integer, against the group at each point."""
    S = FAMILIES["whittaker"]
    assert "G_m where 2*m is an integer and 4*k^2 < 4*m^2." in kovacic.conditions(S).theorem()
    for twice_k, twice_m in product(range(-3, 4), repeat=2):
        if (twice_k + twice_m) % 2:
            k, m = Fraction(twice_k, 2), Fraction(twice_m, 2)
            group = kovacic.solve(S.replace("k", f"({k})").replace("m", f"({m})")).group
            assert (group.dimension < 2) is (k * k < m * m)


@parametrize(
    ("given", "printed"),
    [
        ("A^2*exp(-2*x) - 2*A*b*exp(-x) - E", "y'' = (A^2*exp(-2*x) - 2*A*b*exp(-x) - E) y"),
        ("y'' + 2y'/x + (n(n+1)/x² - 1)y = 0", "y'' + 2*y'/x + (n*(n + 1)/x^2 - 1)*y = 0"),
        ("m-(-(x-b))+(-x)**2", "y'' = (m - (-(x - b)) + (-x)^2) y"),
        ("-(1-m^2)/(4*x^2)/2 + x*(-2)", "y'' = (-(1 - m^2)/(4*x^2)/2 + x*(-2)) y"),
        ("1/(2/x)^2 - (m/(x))*(1/x)", "y'' = (1/(2/x)^2 - (m/x)*(1/x)) y"),
        ("x^4 - (a - (x - m))*x^-2", "y'' = (x^4 - (a - (x - m))*x^(-2)) y"),
    ],
    ordinary=4,
)
def test_the_equation_is_printed_as_it_was_given(given: str, printed: str) -> None:
    """Its sums and products stand as they were read, and what is printed is read as the same equation."""
    answer = kovacic.conditions(given, var="x", max_degree=0)
    text = answer.theorem()
    assert f"The equation\n\n    {printed}\n" in text
    again = kovacic.conditions(re.sub(r" y$", "*y", printed), var="x", max_degree=0)
    assert again.S == answer.S
    assert Conditions.from_json(answer.to_json()).theorem() == text


def test_the_latex_of_a_given_equation_is_unambiguous() -> None:
    latex = kovacic.conditions("x*3*(1/x)*m + 2*(1/2)*x^2 + (m/x)^2 + m/2*x/3", var="x").theorem(format="latex")
    assert r"x \cdot 3 \left(\frac{1}{x}\right) m" in latex
    assert r"2 \left(\frac{1}{2}\right) x^{2}" in latex
    assert r"\left(\frac{m}{x}\right)^{2}" in latex
    assert r"\frac{\frac{m}{2} x}{3}" in latex


def test_an_equation_that_was_not_given_like_this_is_printed_as_it_was_read() -> None:
    """Values are put in; a constant has a letter; an expression has no text; a text that was changed is another equation."""
    assert "y'' = (2*x^2 + m) y" in kovacic.conditions("a*x^2 + m", assume={"a": 2}).theorem()
    assert "y'' = (x^2 + mu*alpha) y" in kovacic.conditions("(sqrt(2)+cbrt(3))*mu + x^2", var="x").theorem()
    assert "y'' = (x^2 + m) y" in kovacic.conditions(sympy.Symbol("m") + x**2, var="x").theorem()
    for unclear in ("m--x^2", "m + x^2^1", "m + x*-(-x)"):
        assert "y'' = (x^2 + m) y" in kovacic.conditions(unclear, var="x").theorem()
    data = kovacic.conditions("m + x^2", var="x").to_dict()
    assert "y'' = (m + x^2) y" in Conditions.from_json(data).theorem()
    assert "y'' = (x^2 + m) y" in Conditions.from_json({**data, "given": "m + x^4"}).theorem()


def test_a_normal_form_in_another_variable_says_in_which() -> None:
    """y'' - y' has no first derivative in t = exp(x)."""
    text = kovacic.conditions("y'' - y' + (a*exp(3*x) + b*exp(2*x))*y = 0", var="x").theorem()
    assert "\n\nis, in t = exp(x), the equation\n\n" in text
    assert "\n\nwhich has the normal form\n\n    y'' = " in text


def test_a_case_for_two_regions_excludes_the_first_from_the_second() -> None:
    text = kovacic.conditions("y'' + a*y' + (a^2/4 - a*b*x)*y = 0", var="x").theorem()
    assert "For b = 0:\n\n    y = exp(-a*x/2)\n\nFor a = 0, and b != 0:\n\n    y = 1\n" in text
    assert "\n\nEach of these equations has Liouvillian solutions if and only if" in text


def test_the_generic_case_is_stated_after_the_others_or_for_all_values() -> None:
    bessel = kovacic.conditions("a/x - 3/(16*x^2)", var="x").theorem()
    first = bessel.index("a = 0.")
    assert "Otherwise it is case 2. The group is the infinite dihedral group." in bessel[first:]
    assert "For all values" not in bessel
    oscillator = kovacic.conditions("2/x^2 + a", var="x").theorem()
    assert "For all values it is case 1." in oscillator
    assert "Otherwise" not in oscillator


def test_the_polynomial_of_a_determinant_is_one_in_the_variable_of_the_normal_form() -> None:
    """And theta, whose equation is printed, belongs to the solution v of the normal form."""
    text = kovacic.conditions("exp(4*x) + a*exp(2*x) + b*exp(x) + c", max_degree=0).theorem()
    assert "y = P_d*exp(" in text
    assert "with a polynomial P_d in t of degree d = " in text
    assert "with theta the logarithmic derivative of v/P_d." in text
    assert "with theta the logarithmic derivative of y/P_d." in kovacic.conditions("x^4+a*x^2+b*x+c", var="x").theorem()


def test_a_progression_begins_where_the_parameter_has_a_value() -> None:
    """a = n + 1 + c/n has no value at n = 0."""
    theorem = kovacic.conditions("x^2*y''+(a*x+b)*y'+c*y=0").theorem()
    assert "For n >= 1:" in theorem
    assert "For n <= -1:" in theorem
    assert "!= 0" not in theorem


def test_values_of_parameters_are_put_into_other_equations() -> None:
    """a^2 = 4 b and a = 0, which is the case before the others, so that these needn't exclude it."""
    text = kovacic.conditions("y''+(a/x^2)*y'+b*y/x^4=0").text()
    assert "b = 0, and a = 0: case 1" in text
    assert "!=" not in text


def test_rows_in_the_integer_beside_a_constant() -> None:
    """a = sqrt(2) b^2/n^2: the root of sqrt(2) a/2 is b/n."""
    theorem = kovacic.conditions("y''=(a*x^2/sqrt(2)+b)*y").theorem()
    assert "For n = 3, 7, 11, ...:\n\n    y = x*exp(b*x^2/(2*n))*assoc_laguerre(n/4 - 3/4, 1/2, -b*x^2/n)" in theorem
    assert "epsilon" not in theorem


@pytest.mark.parametrize("format", ["text", "markdown", "latex"])
def test_cases_are_said_to_be_those_of_the_normal_form(format: str) -> None:
    """Without an empty formula where there is no change of variable."""
    written = kovacic.conditions("y'' - 2*x*y' + 2*n*y = 0", var="x").theorem(format=format)
    assert "Cases and groups are those of the normal form.\n" in written


@pytest.mark.parametrize(
    ("given", "reduction", "claim"),
    [
        ("x*u'' = a*u", "becomes, with u = y, its normal form\n\n    y'' = (a/x) y", "Each of these equations"),
        (
            "x*y'' = a*y + 3",
            "has, without its right-hand side, the normal form\n\n    y'' = (a/x) y",
            "The normal form",
        ),
        (
            "x*y'' + y' = a*y + 5*x",
            "becomes, with y = v exp(int (-1/(2*x)) dx) and without its right-hand side, its normal form\n\n"
            "    v'' = (a/x - 1/(4*x^2)) v",
            "The normal form",
        ),
    ],
)
def test_the_claim_is_about_homogeneous_equations(given: str, reduction: str, claim: str) -> None:
    """y = x solves y'' = x y - x^2, whose homogeneous equation has no Liouvillian solution."""
    theorem = kovacic.conditions(given, var="x").theorem()
    printed = f"The equation\n\n    {given}\n\n{reduction}\n\n{claim} has Liouvillian solutions if and only if"
    assert printed in theorem


def in_text(answer: Conditions) -> str:
    return "".join(format_of("text").render([*blocks(answer)]))


def test_three_alternatives_are_a_table_and_two_are_a_sentence() -> None:
    answer = kovacic.conditions("l*(l+1)/x^2 + k", var="x")
    zero, integer = answer.regions
    assert isinstance(zero.statement, Vanishes)
    k = zero.statement.function
    rows = [Both((Vanishes(k - number), integer.statement)) for number in (-3, 2, 5)]
    for first, second in pairwise(rows):
        several = Either((first, second))
        text = in_text(replace(answer, regions=(replace(zero, statement=several),)))
        assert f"\n\n{several.text()}.\n" in text
        assert "table" not in text
    text = in_text(replace(answer, regions=(replace(zero, statement=Either(tuple(rows))), integer)))
    table = "where   condition\n------  ---------\nk = -3  l in Z\nk = 2   l in Z\nk = 5   l in Z\n"
    assert f"\n\n(1) one row of the table holds:\n\n{table}\nCase 1. " in text


def test_schwarz_table_has_its_reference_beside_every_theory() -> None:
    answer = kovacic.conditions(hypergeometric(("l", "1/2", "n")), var="x")
    other = replace(answer, theory=Theory("the exponents", "AMW11"), regions=answer.regions[2:3])
    assert re.findall(r"\[(\w+)\] ", in_text(other)) == ["AMW11", "Kim69"]
    other = replace(other, regions=answer.regions[1:2])
    assert re.findall(r"\[(\w+)\] ", in_text(other)) == ["AMW11"]


def test_signs_and_determinants_are_written_once() -> None:
    theorem = kovacic.conditions("k*(1+g/x)", var="x").theorem()
    assert theorem.count("is a natural number, with a choice of epsilon and zeta from +-1.") == 1
    assert theorem.count(" y = ") == 2
    quartic = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x", max_degree=1).theorem()
    assert "d  where        Delta_d\n" in quartic
    assert "\n0  b = -2 or 2  a^2 - 4*c\n1  b = -4 or 4  a^4 - 8*a^2*c + 32*a + 16*c^2\n\n" in quartic


def test_the_first_regions_fill_a_screen() -> None:
    """24 of them; one more needs no more lines than to say that there is another one."""
    answer = kovacic.conditions("l*(l+1)/x^2 + k", var="x")
    cases = [replace(answer.regions[0].verdict, structure=structure) for structure in (None, Structure.REDUCIBLE)]
    for number, shown in ((25, 25), (26, 24), (29, 24)):
        regions = tuple(replace(answer.regions[0], verdict=cases[i % 2]) for i in range(number))
        many = replace(answer, regions=regions)
        first, *lines, generic, _ = many.text().splitlines()
        assert first == "y'' = ((k*x^2 + l^2 + l)/x^2) y, parameters l, k"
        assert generic == "  otherwise: no Liouvillian solution"
        assert lines[:shown] == [f"  {region}" for region in regions[:shown]]
        assert lines[shown:] == [f"  ... and {number - 24} more regions: text(all=True), or --all"] * (number > 25)
        assert len(many.text(all=True).splitlines()) == number + 3

"""For which values of the parameters?  Theorems against known answers, and every region against the engine."""

from __future__ import annotations

import json
import pickle
import re
from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
import sympy
from build import QQ, Conditions, generated, parametrize, run
from clocks import controlled
from hypothesis import given, settings
from parametric_cases import FAMILIES, Family, hypergeometric, with_squares
from parametric_formulas import misread
from strategies import parametric_equations

import kovacic
from kovacic import Limits, Structure

F = Fraction


class Answers(dict[str, Conditions]):
    """Those of the families, by name, each when it is asked for first."""

    def __missing__(self, name: str) -> Conditions:
        (family,) = (family for family in FAMILIES if family.name == name)
        self[name] = kovacic.conditions(family.S, var="x")
        return self[name]


@pytest.fixture(scope="module")
def answers() -> dict[str, Conditions]:
    return Answers()


@parametrize("family", FAMILIES, ordinary=(0, 2, 4, 12, 14), long=3, ids=lambda family: family.name)
def test_known_conditions_are_found_and_proven_complete(family: Family, answers: dict[str, Conditions]) -> None:
    answer = answers[family.name]
    assert answer.complete is True
    assert set(answer.parameters) == set(family.parameters)
    for values in family.points:
        point = dict(zip(family.parameters, values, strict=True))
        assert answer.case_at(point) == family.expected(*values), point


@parametrize("family", FAMILIES, ids=lambda family: family.name, ordinary=0, long=(0, 7))
def test_two_hundred_exact_points_agree_with_the_engine(family: Family, answers: dict[str, Conditions]) -> None:
    report = answers[family.name].check(200)
    assert report, report.disagreements
    assert report.inside >= 20
    assert report.outside >= 20
    assert report.inside + report.outside >= 200


@pytest.mark.long
def test_a_wrong_region_is_noticed(answers: dict[str, Conditions]) -> None:
    answer = answers["bessel"]
    wrong = replace(answer.regions[0], verdict=replace(answer.regions[0].verdict, structure=Structure.IMPRIMITIVE))
    assert not replace(answer, regions=(wrong,)).check(20)
    assert not replace(answer, regions=()).check(200) or not replace(
        answer, generic=replace(answer.generic, structure=wrong.verdict.structure)
    ).check(20)


@pytest.mark.long
def test_kimura_for_three_parameters() -> None:
    answer = kovacic.conditions("-((1-l^2)/(4*x^2)+(1-m^2)/(4*(x-1)^2)+(l^2+m^2-n^2-1)/(4*x*(x-1)))", var="x")
    assert answer.complete is True
    for values, case in [
        ((F(1, 2), F(1, 2), F(2, 7)), 2),
        ((F(1, 2), F(1, 3), F(1, 4)), 3),
        ((F(1, 3), F(1, 5), F(1, 7)), None),
        ((F(1, 3), F(1, 4), F(5, 12)), 1),
        ((F(5, 3), F(1, 3), F(1, 3)), 1),
        ((F(5, 3), F(4, 3), F(1, 3)), 3),
    ]:
        assert answer.case_at(dict(zip("lmn", values, strict=True))) == case
    assert answer.check(200)


@pytest.mark.long
def test_yoshida_homogeneous_potentials_of_degree_three() -> None:
    """Morales-Ruiz & Ramis 2001, k = 3, with the dihedral family (exponent differences 1/3, 1/2, 1/2 + j) as well."""
    answer = kovacic.conditions("((24*lam-35)*x^2 + (40-24*lam)*x - 32)/(144*x^2*(x-1)^2)", var="x")
    assert answer.complete is True
    for j in range(-3, 4):
        assert answer.case_at({"lam": j + F(3 * j * (j - 1), 2)}) == 1
        assert answer.case_at({"lam": F((2 * j + 1) ** 2 * 9 - 1, 24)}) == 2
        for square in (4 * (1 + 3 * j) ** 2, F(9, 4) * (1 + 4 * j) ** 2, F(36, 25) * (1 + 5 * j) ** 2):
            assert answer.case_at({"lam": (square - 1) / F(24)}) == 3
        assert answer.case_at({"lam": (F(36, 25) * (2 + 5 * j) ** 2 - 1) / 24}) == 3
    assert answer.case_at({"lam": 3}) is None
    assert {region.case for region in answer.regions} == {1, 2, 3}
    assert answer.check(200)


@pytest.mark.long
def test_ball_on_the_sphere_with_all_its_constants() -> None:
    """Theorem 1 with its converse, and Theorem 2, in the physical parameters."""
    x = sympy.Symbol("x")
    m, R, R1, a, A1, A3 = sympy.symbols("m R R1 a A1 A3")
    D = A1 * A3 + A1 * m * R**2 * (1 - x**2) + A3 * m * (R * x + a) ** 2
    phi = sympy.diff(D, x) / (2 * D)
    S = sympy.diff(phi, x) / 2 + phi**2 / 4 + m * R**4 * (A3 - A1) / (R1**2 * D)
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert answer.generic.case == 2
    assert any(str(region.statement) == "2*R/R1 in Z" and region.case == 1 for region in answer.regions)
    values = {"m": 1, "R": 1, "R1": 3, "a": F(1, 3), "A1": 1, "A3": 2}
    assert answer.case_at(values) == 2
    assert answer.case_at({**values, "R1": 2}) == 1
    assert answer.case_at({**values, "A3": 1}) == 1
    with pytest.raises(kovacic.InputError, match="isn't defined"):
        answer.case_at({**values, "R1": 0})
    assert answer.check(200)


@pytest.mark.long
def test_sextic_oscillator() -> None:
    """Quasi-exactly solvable: a determinant for each natural number, and nothing else [Turbiner 1988]."""
    answer = kovacic.conditions("x^6 + a*x^2 + b", var="x", max_degree=3)
    assert answer.complete is True
    (region,) = answer.regions
    assert str(region.statement) == "a = +-(2*d + 3), d in N, and Delta_d = 0"
    assert region.case == 1
    assert region.determinants[2] == "Delta_2 = b^2 - 8 where a = -7; b^2 + 8 where a = 7"
    assert len(region.determinants) == 4
    assert answer.case_at({"a": -7, "b": sympy.sqrt(8)}) == 1
    assert answer.case_at({"a": -7, "b": 1}) is None
    assert answer.case_at({"a": -3, "b": 0}) == 1
    for point in ({"a": -23, "b": 0}, {"a": -11, "b": 0}, {"a": 11, "b": 0}, {"a": 5, "b": 0}):
        assert answer.case_at(point) == answer.solve_at(point).case
    report = answer.check(60)
    assert report, report.disagreements
    assert report.open == 0
    assert report.inside >= 15


@parametrize(
    ("S", "statement", "delta"),
    [
        (
            "x^4 + a*x^2 + b*x + c",
            "b = +-(2*d + 2), d in N, and Delta_d = 0",
            {0: {"a^2 - 4*c"}, 1: {"a^4 - 8*a^2*c + 32*a + 16*c^2"}},
        ),
        ("x^4 - 2*x^2*a + b*x", "b = +-(2*d + 2), d in N, and Delta_d = 0", {0: {"a"}}),
        ("(x^2+a)^2 + b*x", "b = +-(2*d + 2), d in N, and Delta_d = 0", {0: {"0"}, 1: {"a"}}),
        ("g^2*x^4 + b*x + c", "g = +-b/(2*(d + 1)), d in N, and Delta_d = 0", {0: {"c"}}),
        ("g*x^4 + b*x + c", "g = b^2/(4*(d + 1)^2), d in N, and Delta_d = 0", {0: {"c"}}),
        (
            "x^6 + a*x^3 + b*x^2 + c*x + k",
            "b = +-(2*d + 3), d in N, and Delta_d = 0",
            {0: {"(c, a^2 - 4*k)"}},
        ),
    ],
    ordinary=0,
    long=1,
)
def test_polynomial_potentials_have_one_statement_with_a_natural_number(
    S: str, statement: str, delta: dict[int, set[str]]
) -> None:
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert statement in [str(region.statement) for region in answer.regions]
    for number, polynomials in delta.items():
        assert {str(determinant) for determinant in answer.determinant(number)} == polynomials
    report = answer.check(60)
    assert report, report.disagreements
    assert report.open == 0


@parametrize("number", range(5), ordinary=1, long=1)
def test_the_determinant_of_the_quartic_is_that_of_the_banded_system(number: int) -> None:
    """P'' + (2 x^2 + a) P' + (x - a^2/4 ... ) P: the matrix for y = P exp(x^3/3 + a x/2), written down independently."""
    a, c = sympy.symbols("a c")
    matrix = sympy.zeros(number + 1)
    for j in range(number + 1):  # (x^2 + a/2) is Q, b = 2 number + 2, and x^j is mapped to
        # j (j-1) x^(j-2) + 2 j (x^2 + a/2) x^(j-1) + (2 x + a^2/4 - b x - c) x^j
        for power, value in (
            (j - 2, j * (j - 1)),
            (j - 1, j * a),
            (j, a**2 / 4 - c),
            (j + 1, 2 * j + 2 - 2 * number - 2),
        ):
            if 0 <= power <= number:
                matrix[power, j] += value
    answer = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x")
    (found,) = [d for d in answer.determinant(number) if str(d.exponents) == f"b - {2 * number + 2}"]
    product = sympy.prod(sympy.sympify(str(factor).replace("^", "**")) for factor in found.factors or ())
    ratio = sympy.cancel(product / matrix.det())
    assert ratio.is_number


def test_wrong_numbers_for_determinants(answers: dict[str, Conditions]) -> None:
    quartic = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x")
    for wrong in (-1, 1.0, "1", True, None):
        with pytest.raises(kovacic.InputError, match="natural number"):
            quartic.determinant(wrong)  # type: ignore[arg-type]
    with pytest.raises(kovacic.InputError, match="no condition"):
        answers["bessel"].determinant(1)


def test_natural_numbers_under_assumptions() -> None:
    assert not kovacic.conditions("x^6 + a*x^2 + b", var="x", assume={"a": "even"}).regions
    assert not kovacic.conditions("x^6 + a*x^2 + b", var="x", assume={"a": "noninteger"}).regions
    assert kovacic.conditions("x^6 + a*x^2 + b", var="x", assume={"a": "odd"}).regions


@pytest.mark.long
def test_algebraic_points(answers: dict[str, Conditions]) -> None:
    assert answers["chebyshev"].case_at({"n": sympy.sqrt(2)}) == 2
    assert answers["whittaker"].case_at({"k": sympy.sqrt(2), "m": sympy.Rational(1, 2) - sympy.sqrt(2)}) == 1
    assert answers["whittaker"].case_at({"k": "sqrt(2)", "m": "1/2 + sqrt(2)"}) == 1
    assert answers["whittaker"].case_at({"k": "sqrt(2)", "m": "1/2"}) is None
    assert answers["whittaker"].case_at({"k": sympy.sqrt(2), "m": "1/2 + sqrt(2)"}) == 1
    for values in ({"k": sympy.sqrt(2), "m": None}, {"k": sympy.pi, "m": 1}, {"k": "__import__('os')", "m": 1}):
        with pytest.raises(kovacic.InputError):
            answers["whittaker"].case_at(values)


@pytest.mark.long
def test_a_polynomial_of_degree_two_in_all_its_coefficients() -> None:
    answer = kovacic.conditions("a*x^2 + b*x + c", var="x")
    assert answer.complete is True
    assert answer.case_at({"a": 1, "b": 0, "c": 3}) == 1
    assert answer.case_at({"a": 1, "b": 2, "c": 4}) == 1
    assert answer.case_at({"a": 1, "b": 2, "c": 3}) is None
    assert answer.case_at({"a": 0, "b": 1, "c": 3}) is None
    assert answer.case_at({"a": 0, "b": 0, "c": 3}) == 1
    assert answer.check(200)


@pytest.mark.long
def test_a_pole_of_high_order_is_moved_to_infinity() -> None:
    answer = kovacic.conditions("(x^2 + mu*(x-t)^2)/(x-t)^6", var="x")
    assert answer.complete is True
    assert answer.check(30)


def test_known_spectra_of_bound_states(answers: dict[str, Conditions]) -> None:
    for d in range(4):
        assert answers["harmonic oscillator"].case_at({"E": 2 * d + 1}) == 1
        for l_ in range(3):
            energy = F(-9, 4 * (l_ + 1 + d) ** 2)
            assert answers["coulomb, in the energy"].case_at({"l": l_, "Z": 3, "E": energy}) == 1
            assert answers["coulomb, in the energy"].case_at({"l": l_, "Z": 3, "E": energy * F(8, 9)}) is None
        assert answers["poeschl-teller, in the energy"].case_at({"l": F(22, 5), "E": -((F(22, 5) - d) ** 2)}) == 1
        assert answers["morse, in the energy"].case_at({"A": 2, "b": F(22, 5), "E": -((F(39, 10) - d) ** 2)}) == 1
        assert answers["morse, in the energy"].case_at({"A": 2, "b": F(22, 5), "E": -((F(38, 10) - d) ** 2)}) is None


@pytest.mark.long
def test_the_group_of_a_region() -> None:
    def group(S: str, values: dict[str, object] | None = None) -> str:
        answer = kovacic.conditions(S, var="x")
        region = None if values is None else answer.region_at(values)
        return answer.generic.group if region is None else region.group

    assert group("(4*n^2-1)/(4*x^2) - 1", {"n": F(1, 2)}) == "G_m"
    assert group("(4*n^2-1)/(4*x^2) - 1") == "SL2(C)"
    assert group("((4*n^2-1)*x^2 - 4*n^2 - 2)/(4*(x^2-1)^2)").startswith("dicyclic where 2*n is rational")
    assert group("n/x^2 + 1/x", {"n": F(-3, 16)}) == "the infinite dihedral group"
    lame = "(5*x^4 + 4*B*x^3 - 98*x^2 + (-28*B + 192)*x + 24*B - 147)/(16*(x^3-7*x+6)^2)"
    assert group(lame, {"B": 2}) == "G_a extended by mu_4"
    yoshida = "((24*lam-35)*x^2 + (40-24*lam)*x - 32)/(144*x^2*(x-1)^2)"
    assert group(yoshida, {"lam": F(1, 3)}) == "dicyclic"


def test_a_natural_number_in_case_3_leaves_the_group_open() -> None:
    """Heun's equation with three exponent differences 1/3: each of the three groups has an invariant of degree 12."""
    heun = kovacic.conditions("-2/(9*x^2) - 2/(9*(x-1)^2) - 2/(9*(x+1)^2) + (a*x + B)/(x*(x^2-1))", var="x")
    last = heun.regions[-1]
    assert "for an invariant of degree 12: case 3" in str(last)
    assert last.group == "binary tetrahedral, octahedral or icosahedral"


@parametrize("family", FAMILIES, ordinary=6, long=5, ids=lambda family: family.name)
def test_the_group_of_a_region_is_that_of_its_points(family: Family, answers: dict[str, Conditions]) -> None:
    """The names of groups that a family's text doesn't mention don't occur."""
    answer = answers[family.name]
    words = {
        "MULTIPLICATIVE": "G_m",
        "BOREL": "Borel",
        "CYCLIC": "cyclic",
        "ADDITIVE": "G_a",
        "INFINITE_DIHEDRAL": "infinite dihedral",
        "DICYCLIC": "dicyclic",
        "TETRAHEDRAL": "tetrahedral",
        "OCTAHEDRAL": "octahedral",
        "ICOSAHEDRAL": "icosahedral",
        "SL2": "SL2(C)",
    }
    for values in family.points:
        point = dict(zip(family.parameters, values, strict=True))
        region = answer.region_at(point)
        text = answer.generic.group if region is None else region.group
        group = answer.solve_at(point).group
        assert group is not None
        assert words[group.kind.name] in text or text.startswith("reducible"), (point, text, group.name)
        if "dicyclic where" in text:
            assert group.kind.name == "DICYCLIC"  # the exponents at these points are rational


def test_the_solution_at_a_single_value_is_written_out() -> None:
    lame = "(5*x^4 + 4*B*x^3 - 98*x^2 + (-28*B + 192)*x + 24*B - 147)/(16*(x^3-7*x+6)^2)"
    answer = kovacic.conditions(lame, var="x")
    region = answer.region_at({"B": 2})
    assert region is not None
    (solution,) = region.solution()
    x = sympy.Symbol("x")
    S = sympy.sympify(lame.replace("^", "**")).subs("B", 2)
    omega = sympy.cancel(sympy.expand_log(sympy.log(solution.y.subs("B", 2)), force=True).diff(x))
    assert sympy.cancel(omega.diff(x) + omega**2 - S) == 0


def test_the_coordinate_of_the_theorem_is_the_users() -> None:
    answer = kovacic.conditions("z^2 + 2*a*z + b", var="z")
    assert "Whittaker's equation in (z + a)^2" in answer.theory


@parametrize(
    ("S", "assume", "always", "statements"),
    [
        ("(4*n^2-1)/(4*x^2) - 1", "integer", None, []),
        ("(4*n^2-1)/(4*x^2) - 1", "irrational", None, []),
        ("(4*n^2-1)/(4*x^2) - 1", "half-integer", 1, []),
        ("(4*n^2-1)/(4*x^2) - 1", "noninteger", None, ["n - 1/2 in Z"]),
        ("((n^2+n)*x^2 - n^2 - n - 1)/(x^2-1)^2", "positive integer", 1, []),
        ("((n^2+n)*x^2 - n^2 - n - 1)/(x^2-1)^2", "noninteger", None, []),
        ("x^2 + n", "odd", 1, []),
        ("x^2 + n", "even", None, []),
        ("x^2 + n", "integer", None, ["n is an odd integer"]),
        ("n*x^5 + x", "nonzero", None, []),
        ("x^2 + n^2 - n", "integer", None, []),  # n^2 - n is even, and that isn't noticed
    ],
    ordinary=(0,),
    long=2,
)
def test_assumptions_leave_out_what_cannot_happen(
    S: str, assume: str, always: int | None, statements: list[str]
) -> None:
    answer = kovacic.conditions(S, assume={"n": assume}, var="x")
    assert answer.generic.case == always
    if S != "x^2 + n^2 - n":
        assert [str(region.statement) for region in answer.regions] == statements
    assert answer.check(20)
    for n in (F(-5, 2), -2, F(1, 3), 3):
        known = answer.assumptions.of("n")
        if known.admits(QQ.poly([n])):
            assert answer.case_at({"n": n}) == kovacic.conditions(S, var="x").case_at({"n": n})
        else:
            with pytest.raises(kovacic.InputError, match="contradicts"):
                answer.case_at({"n": n})


def test_assumptions_of_symbols_and_wrong_ones() -> None:
    x, n = sympy.Symbol("x"), sympy.Symbol("n", odd=True)
    assert kovacic.conditions(x**2 + n, var=x).generic.case == 1
    assert kovacic.conditions(x**2 + n, var=x, assume={n: "positive"}).to_dict()["assumptions"] == {"n": "odd positive"}
    for assume in ({"mu": "prime"}, {"nu": "integer"}, {"mu": ""}, ["mu"], "mu"):
        with pytest.raises(kovacic.InputError):
            kovacic.conditions("x^2 + mu", assume=assume, var="x")  # type: ignore[arg-type]


def test_solve_under_assumptions() -> None:
    bessel = kovacic.solve("(4*n^2-1)/(4*x^2) - 1", assume={"n": "integer"})
    assert bessel.case is None
    assert bessel.status is kovacic.Status.NONE_EXISTS
    assert any(notice.startswith("with n integer the answer holds (") for notice in bessel.notices)
    weber = kovacic.solve("x^2 + mu", assume={"mu": "integer"})
    assert any("except where mu is an odd integer" in notice for notice in weber.notices)
    n = sympy.Symbol("n", integer=True)
    x = sympy.Symbol("x")
    legendre = ((n**2 + n) * x**2 - n**2 - n - 1) / (x**2 - 1) ** 2
    assert kovacic.decide(legendre, var=x).case == 1
    answer = kovacic.solve(legendre, var=x)
    assert answer.status is kovacic.Status.UNDECIDED
    assert "case 1" in str(answer.reason)
    assert "solve_at" in str(answer.reason)


@parametrize(
    ("S", "known"),
    [
        ("x^2 + sqrt(2)*n*x", {0: None, "sqrt(2)": None, 1: None, "I*sqrt(2)": None, 2: None}),
        ("(4*n^2-1)/(4*x^2) - I", {F(1, 2): 1, 1: None, F(-5, 2): 1}),
        ("I*n/x^2 + x^2", {0: None, "-3*I/4": 1, "I": None}),
        ("x^4 + I*n*x", {"2*I": 1, "-4*I": 1, 2: None, "6*I": None}),
        ("sqrt(2)*n/x^2 - 3/(16*(x-1)^2)", {0: 1, 1: None}),
        ("(n-sqrt(3))^2/x^2 + 1/x^4", {"sqrt(3)": 1, 1: None, "sqrt(3) + sqrt(2)": 1}),
    ],
    ordinary=0,
    long=1,
)
def test_algebraic_constants_and_parameters(S: str, known: dict[object, int | None]) -> None:
    answer = kovacic.conditions(S, var="x")
    assert answer.parameters == ("n",)
    for value, case in known.items():
        if isinstance(value, str) and ("I" in value or "sqrt" in value) and case is None:
            case = kovacic.solve(S.replace("n", f"({value})"), var="x").case
        assert answer.case_at({"n": value}) == case, value
    assert answer.check(60)


def test_an_integer_is_not_called_like_a_parameter() -> None:
    statement = kovacic.conditions("n*x^3 + N*n^2/x^2", var="x").regions[-1].statement
    assert "m^2" in str(statement)
    assert "for an integer m = 5 mod 10" in str(statement)
    assert "m^{2}" in statement.latex()
    assert "for an integer n" in str(kovacic.conditions("x^2 - E/x^2 + 1", var="x").regions[-1].statement)
    latex = kovacic.conditions("mu/x^2 + 1/x", var="x").regions[-1].statement.latex()
    assert latex.startswith(r"\mu = ")


@parametrize(
    ("S", "curve", "points"),
    [
        # The anharmonic oscillator: P of degree 1 exists on a curve of genus 1 that no parameter can be eliminated from.
        ("x^4 + a*x^2 + 4*x + c", "a^4 - 8*a^2*c + 32*a + 16*c^2 = 0", [(0, 0), (8, "16 + 4*I"), (2, 1), (0, 1)]),
        ("(n^2-2)*x^4 + m*x", "n^2 = 2", [("sqrt(2)", 1), ("sqrt(2)", 0), (1, 1), (1, 2)]),
        ("(n^2-2)*x^3 + m", "n^2 = 2", [("sqrt(2)", 1), ("-sqrt(2)", 0), (1, 1), (1, 0)]),
        ("(n^2-m^3-1)*x^4 + n*x + m", "m^3 = (n - 1)*(n + 1)", [(1, 0), (3, 2), (8, 4)]),
        # One of two conjugate poles becomes simple.
        (
            "(a*x+b)/(x^2+1)^2 + c/(x*(x^2+1))",
            "a^2 + b^2 = 0",
            [("4*I", -4, "-2*I"), ("4*I", -4, 1), ("I", 1, 0), (0, 0, 0), (0, -3, 0), (2, 1, -2)],
        ),
        pytest.param(
            "(n^2*x^2+m)/(x^3-1)^2*x",
            "n^4 - n^2*m + m^2 = 0",
            [(2, "2 + 2*sqrt(-3)"), (1, 0), (0, 4), (1, -1)],
            marks=pytest.mark.long,
        ),
        ("a*x^6 + (w^2+1)*x^3 + b/x^2", "w^2 + 1 = 0", [(1, "I", 6), (1, "-I", 2), (0, "I", 0), (1, 2, 6)]),
    ],
    ordinary=(1, 2, 4),
    long=2,
)
def test_hypersurfaces_from_which_no_parameter_is_eliminated(
    S: str, curve: str, points: list[tuple[object, ...]]
) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=2)
    regions = [region for region in answer.regions if curve in str(region.statement)]
    assert regions
    assert answer.complete is True or "m^3" in curve
    for region in regions:
        assert region.complete is True or "special values" in str(region.complete)
    for values in points:
        point = dict(zip(answer.parameters, values, strict=True))
        assert answer.case_at(point) == answer.solve_at(point).case, point
    assert answer.check(10)


@pytest.mark.long
def test_with_a_fixed_degree_and_several_parameters_one_determinant_is_complete() -> None:
    answer = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x", max_degree=3)
    (region,) = answer.regions
    assert region.complete is True
    assert len(region.determinants) == 4
    verdict = answer.predicted(answer.point({"a": 1, "b": 4, "c": 5}))
    assert verdict is not None
    assert verdict.known
    assert verdict.case is None
    report = answer.check(200)
    assert report, report.disagreements
    assert report.inside > 40
    assert report.open == 0


@pytest.mark.long
def test_a_polynomial_of_high_degree() -> None:
    """P of degree 150 for 76 values of b, the roots of a polynomial that only the recurrence gives quickly."""
    answer = kovacic.conditions("x^6 - 303*x^2 + b", var="x")
    assert answer.complete is True
    assert [region.case for region in answer.regions] == [1]
    assert str(answer.regions[0].statement).startswith("b^76 - ")
    assert answer.case_at({"b": 1}) is None


@pytest.mark.long
def test_an_incomplete_answer_is_for_generic_values() -> None:
    heun = "a/x^2 + b/(x-1)^2 + c/(x-t)^2 + (e*x+q)/(x*(x-1)*(x-t))"
    answer = kovacic.conditions(heun, var="x", limits=Limits(seconds=0.5))
    assert not answer.within_limits
    assert not type(answer).from_json(answer.to_json()).within_limits
    assert "for generic values: no Liouvillian solution" in str(answer)
    assert "otherwise, for generic values" in answer.latex()
    unfinished = kovacic.conditions("x^6 - 200000003*x^2 + b", var="x", limits=Limits(seconds=0.5))
    assert not unfinished.within_limits
    assert "always" not in str(unfinished)


def test_views(answers: dict[str, Conditions]) -> None:
    answer = answers["whittaker"]
    data = json.loads(answer.to_json())
    assert data["parameters"] == ["k", "m"]
    assert data["generic"]["case"] is None
    assert data["regions"][0]["condition"] == "k + m - 1/2 in Z or k - m - 1/2 in Z"
    assert data["regions"][0]["complete"] is True
    assert "otherwise: no Liouvillian solution" in str(answer)
    assert r"\mathbb{Z}" in answer.latex()
    assert r"\mu \sqrt{2}\text{ is an odd integer}" in kovacic.conditions("x^2 + sqrt(2)*mu", var="x").latex()
    assert pickle.loads(pickle.dumps(answer)) == answer


@pytest.mark.long
def test_a_map_of_two_parameters(answers: dict[str, Conditions]) -> None:
    pytest.importorskip("matplotlib")
    axes = answers["whittaker"].plot(ranges=((-1, 1), (-1, 1)), steps=4)
    mesh = axes.collections[0].get_array().reshape(5, 5).tolist()
    # k, m in {-1, -1/2, 0, 1/2, 1}: solvable where k + m - 1/2 or k - m - 1/2 is an integer.
    assert mesh[0] == [0, 1, 0, 1, 0]
    assert mesh[1] == [1, 0, 1, 0, 1]
    strip = answers["bessel"].plot(ranges=((-1, 1),), steps=4)  # n - 1/2 in Z
    assert strip.collections[0].get_array().ravel().tolist() == [0, 1, 0, 1, 0]
    with pytest.raises(kovacic.InputError, match="one parameter or two"):
        answers["bessel"].plot(parameters=("m",))


@pytest.mark.long
def test_wrong_input_and_limits() -> None:
    with pytest.raises(kovacic.InputError, match="no parameters"):
        kovacic.conditions("x^2 + 3")
    with pytest.raises(kovacic.InputError, match="values are needed"):
        kovacic.conditions("x^2 + mu", var="x").case_at({"nu": 1})
    with pytest.raises(kovacic.LimitExceeded, match="parameters"):
        kovacic.conditions("a*x + b", var="x", limits=Limits(parameters=1))
    heun = "A/x + B/(x - 1) + C/(x - c) + a/x^2 + b/(x - 1)^2 + d/(x - c)^2"
    partial = kovacic.conditions(heun, var="x", limits=Limits(seconds=0.5))
    assert isinstance(partial.complete, str)
    assert "limits" in partial.complete


def _regions_agree_with_the_engine(S: str, samples: int, seconds: float) -> None:
    try:
        answer = kovacic.conditions(S, var="x", max_degree=2, limits=Limits(seconds=seconds))
    except kovacic.InputError:  # no parameters were drawn
        return
    report = answer.check(samples)
    assert report, (S, report.disagreements)


@pytest.mark.long
@given(parametric_equations())
@generated(8)
def test_random_equations_agree_with_the_engine(S: str) -> None:
    _regions_agree_with_the_engine(S, 12, 1.0)


@pytest.mark.slow
@given(parametric_equations())
@settings(max_examples=400)
def test_many_random_equations_agree_with_the_engine(S: str) -> None:
    _regions_agree_with_the_engine(S, 60, 10.0)


MORE = [
    "-3/(16*x^2)-3/(16*(x-1)^2)-3/(16*(x-2)^2)+(3*x/8+B)/(x*(x-1)*(x-2))",
    "2/x^2 + a/x + b",
    "a/x^4 + b/x^3 + c/x^2",
    "a/x^4 + 2/x^2 + x",
    "x^2 + a/x^2 + b",
    "-3/16/x^2 + a*x + b",
    "x^3 + a*x",
    "n*(n+1)/x^2 + m*(m+1)/(x-1)^2",
    "a/(x^2+1)^2 + b/(x^2+1)",
    "1/(x^2-t)^2",
    "(x^2+a)^2 + b*x",
]


@parametrize("S", MORE, ordinary=(5,), long=2)
def test_other_families_agree_with_the_engine(S: str) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=2)
    report = answer.check(20)
    assert report, report.disagreements
    assert answer.complete is True or "not proven" in str(answer.complete)


@parametrize(
    ("S", "points"),
    [
        # a b = c d is solved for one of them where its coefficient isn't zero; at these points it is.
        (
            "(a*b-c*d)*x^2 + a*x + d",
            [(5, 0, 0, 1), (0, 0, 0, 1), (0, 0, 3, 0), (0, 5, 3, 0), (0, 1, 1, 1), (1, 1, 0, 1)],
        ),
        ("(a*b-c*d)*x^4 + a*x^2 + b/x^2 + d", [(5, 0, 0, 5), (4, 0, 0, 10), (0, 0, 0, 1), (1, 2, 2, 1)]),
        ("(a*b-c)*x^2 + a/x^2 + b", [(0, 0, 0), (2, 0, 0), (0, 3, 0), (2, 1, 2)]),
        ("(a*b-c*a-d)*x^2 + c*x + b", [(0, 1, 2, 0), (0, 1, 0, 0), (3, 1, 1, 0), (3, 0, 0, 0)]),
        ("(a*b-1)*x^2 + b", [(1, 1), (F(1, 2), 2), (0, 0), (0, 3)]),
    ],
    ordinary=1,
    long=1,
)
def test_values_at_which_a_parameter_cannot_be_eliminated(S: str, points: list[tuple[Fraction | int, ...]]) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=1)
    for values in points:
        point = dict(zip(answer.parameters, values, strict=True))
        assert answer.case_at(point) == answer.solve_at(point).case, point
    assert answer.check(20)


@pytest.mark.parametrize(
    ("S", "undefined"),
    [
        ("1/((a^2-b^3)*x^2)", (8, 4)),
        ("1/((a^2-b^3)*x^2 + a + b - 2)^2", (1, 1)),
        ("x/((a^2-b^3)*x^2 + a + b - 2)", (1, 1)),
    ],
)
def test_S_is_undefined_where_its_denominator_vanishes(S: str, undefined: tuple[int, int]) -> None:
    answer = kovacic.conditions(S, var="x")
    with pytest.raises(kovacic.InputError, match="isn't defined"):
        answer.case_at(dict(zip("ab", undefined, strict=True)))
    assert answer.case_at({"a": 1, "b": 2}) == answer.solve_at({"a": 1, "b": 2}).case


def test_the_answer_at_a_point_has_its_omega(answers: dict[str, Conditions]) -> None:
    answer = answers["quartic"].solve_at({"mu": 2})
    assert answer.verified
    assert str(answer.omega) in {"-x**2", "x**2", "(x**3 + 1)/x", "(-x**3 + 1)/x"}


def test_integer_symbols_of_sympy() -> None:
    n, x = sympy.Symbol("n", integer=True), sympy.Symbol("x")
    assert not kovacic.conditions((4 * n**2 - 1) / (4 * x**2) - 1).regions


def test_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conditions", "--check", "20", "x^4 + mu*x"]) == 0
    assert "mu = +-2 mod 6: case 1" in capsys.readouterr().out
    assert run(["conditions", "--json", "--var", "x", "(4*n^2-1)/(4*x^2) - 1"]) == 0
    assert json.loads(capsys.readouterr().out)["regions"][0]["condition"] == "n - 1/2 in Z"
    assert run(["conditions", "x^2 + 3"]) == 2
    assert "no parameters" in capsys.readouterr().err


def test_an_equation_in_place_of_S() -> None:
    answer = kovacic.conditions("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0")
    assert [str(region.statement) for region in answer.regions] == ["n in Z"]


@parametrize("exponents", [(2, 3, 3), (2, 3, 4), (2, 3, 5), (2, 2, 7), (3, 5, 7)], ordinary=1)
def test_a_pole_as_parameter_with_constant_exponents(exponents: tuple[int, int, int]) -> None:
    """Three points are as good as any others: the same case for every pole, and no impossible region."""
    p, q, r = (F(1, n * n) for n in exponents)
    S = f"-(1-{p})/(4*x^2) - (1-{q})/(4*(x-a)^2) - ({p}+{q}-{r}-1)/(4*x*(x-a))"
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert [str(region.statement) for region in answer.regions] == ["a = 0"]
    assert answer.generic.case == kovacic.solve(S.replace("a", "7"), var="x").case
    assert answer.check(20)
    assert kovacic.solve(S, var="x", assume={"a": "nonzero"}).case == answer.generic.case


@pytest.mark.long
def test_rows_that_contain_no_constant_exponent_are_left_out() -> None:
    with_sevenths = kovacic.conditions(hypergeometric(("1/7", "m", "n")), var="x")
    assert {region.case for region in with_sevenths.regions} == {1, 2}
    with_fifths = kovacic.conditions(hypergeometric(("1/5", "m", "n")), var="x")
    assert {region.case for region in with_fifths.regions} == {1, 2, 3}
    assert not any("rows 2-3" in str(region.statement) for region in with_fifths.regions)
    assert with_fifths.check(40)


@pytest.mark.parametrize(
    "value", ["x", "3+x", sympy.Symbol("x"), sympy.Symbol("x") + 3, "n", "x1", None, sympy.pi, sympy.oo]
)
def test_values_that_are_no_numbers_are_refused(value: Any, answers: dict[str, Conditions]) -> None:
    for method in (answers["bessel"].case_at, answers["bessel"].solve_at):
        with pytest.raises(kovacic.InputError):
            method({"n": value})


@pytest.mark.parametrize("degree", ["7", -5, 2.0, True, None])
def test_a_degree_is_a_natural_number(degree: Any) -> None:
    with pytest.raises(kovacic.InputError, match="max_degree"):
        kovacic.conditions("x^6 + a*x^2 + b", var="x", max_degree=degree)


def test_a_name_alone_is_the_variable() -> None:
    with pytest.raises(kovacic.InputError, match="n is taken for the variable"):
        kovacic.conditions("n")
    assert kovacic.conditions("n", var="x").generic.case == 1


def test_assumptions_refute_single_values() -> None:
    S = "(b+2)*x^4 + x^2 + b*x"
    assert any(str(region.statement) == "b = -2" for region in kovacic.conditions(S, var="x", max_degree=1).regions)
    for what in ("noninteger", "positive", "odd"):
        answer = kovacic.conditions(S, var="x", assume={"b": what}, max_degree=1)
        assert not any(str(region.statement) == "b = -2" for region in answer.regions)


def test_a_proven_answer_under_assumptions_has_no_further_conditions(capsys: pytest.CaptureFixture[str]) -> None:
    answer = kovacic.solve("(4*n^2-1)/(4*x^2) - 1", assume={"n": "integer"})
    assert not answer.generic_conditions
    assert run(["solve", "--assume", "n=integer", "(4*n^2-1)/(4*x^2) - 1"]) == 0
    assert "isn't rational" not in capsys.readouterr().out
    assert kovacic.solve("(4*n^2-1)/(4*x^2) - 1", var="x").generic_conditions


def test_the_note_uses_the_name_of_the_constant() -> None:
    answer = kovacic.conditions("alpha*x^2 + (sqrt(2)+sqrt(3))*x", var="x")
    assert any("alpha_ is the root of alpha_**4" in notice for notice in answer.notices)


@pytest.mark.long
def test_families_of_integers_are_merged_and_covered_ones_left_out() -> None:
    """Yoshida's degrees -1 and 2: each family once, and no region all of whose points lie in an earlier one."""

    def yoshida(k: int) -> list[str]:
        squares = (F(1, k * k), F(1, 4), f"(({(k - 2) ** 2} + {8 * k}*L)/{4 * k * k})")
        answer = kovacic.conditions(with_squares(*map(str, squares)), var="x")
        assert answer.complete is True
        assert answer.check(60)
        return [str(region.statement) for region in answer.regions]

    assert yoshida(-1) == ["L = -n*(n - 3)/2 for an integer n"]
    assert yoshida(2) == ["L = n^2 for an integer n"]
    assert yoshida(1) == ["L = (n^2 + n)/2 for an integer n"]


@pytest.mark.long
def test_a_region_inside_an_earlier_one_is_left_out() -> None:
    answer = kovacic.conditions("(A + B*x + C*x^2)/(x^2 - 1) - 3/(8*(x^2 - 1)^2)", var="x", max_degree=1)
    statements = [str(region.statement) for region in answer.regions]
    assert any(text.startswith("C = 0, and B = 0") for text in statements)
    assert not any(text.startswith("B^2 = 4*C, and B = 0") for text in statements)
    assert answer.check(40)


@parametrize(
    "S",
    [
        "a/x^2 + b/(x-1)^2 + c/(x-2)^2",
        "(x+a)^2 + b/(x-c)^2 + 1",
        # Ince's equation in algebraic form, and Regge & Wheeler's.
        "(16*a*x^2 - 16*a*x + 16*b*x^3 - 16*b*x^2 + 4*k^2*x^4 - 8*k^2*x^3 + 4*k^2*x^2 + 8*k*x^3 - 12*k*x^2 + 4*k*x - 4*x^2 "
        "+ 4*x - 3)/(16*x^2*(x - 1)^2)",
        "(l*(1 - 1/x)*(l + 1)/x^2 - w^2 + (1 - s^2)*(1 - 1/x)/x^3)/(1 - 1/x)^2",
    ],
    ordinary=0,
    long=1,
)
def test_the_limit_of_time_holds(S: str) -> None:
    kovacic.conditions("x^2 + n", var="x")  # imports
    with controlled(step=0.0005) as clock:
        answer = kovacic.conditions(S, var="x", limits=Limits(seconds=1.5))
    assert clock.time < 1.5 + 0.3 + 0.1
    assert answer.regions
    report = answer.check(10)
    assert report, report.disagreements


LITERATURE = {
    "sextic with a centrifugal term": "a*x^2 + c + l*(l + 1)/x^2 + x^6",
    "decatic": "a*x^4 + b*x^2 + c + x^10",
    "inverse square root": "4*x^2*(-E + V/x) + 3/(4*x^2)",
    "cornell": "-E - a/x + l*(l + 1)/x^2 + x",
    "doubly confluent Heun": "a^2/x^4 + b/x^3 + c/x^2 + d/x + 1",
    "confluent Heun": "A/x + B/(x - 1) + 1/4",
    "whittaker-hill": "(A + B*x + C*x^2)/(x^2 - 1) - 3/(8*(x^2 - 1)^2)",
    "spheroidal": "-(-L*x^2 + L + c2*x^4 - 2*c2*x^2 + c2 - m^2 + 1)/((x - 1)^2*(x + 1)^2)",
    "lame in n": "(4*n^2*x^4 - 4*n^2*x^2 + 4*n*x^4 - 4*n*x^2 - 3*x^4 - 6*x^2 - 3)/(16*x^2*(x - 1)^2*(x + 1)^2)",
    "lame 1 on every curve": (
        "(-16*B*g2*x - 16*B*g3 + 64*B*x^3 - 3*g2^2 - 56*g2*x^2 - 128*g3*x + 80*x^4)/(16*(-g2*x - g3 + 4*x^3)^2)"
    ),
}


@parametrize("name", LITERATURE, ordinary=0, long=(0, 2))
def test_families_of_the_literature_are_complete(name: str) -> None:
    answer = kovacic.conditions(LITERATURE[name], var="x", limits=Limits(seconds=60))
    assert answer.complete is True
    report = answer.check(40)
    assert report, report.disagreements
    assert report.open == 0


@pytest.mark.long
def test_a_curve_with_a_cusp_is_parametrised() -> None:
    """g2 = 12 t^2, g3 = -8 t^3 on the discriminant, where Lame's equation has three singular points."""
    answer = kovacic.conditions(LITERATURE["lame 1 on every curve"], var="x")
    statements = [str(region.statement) for region in answer.regions]
    assert "g2^3 = 27*g3^2, and B = -(3*n^2 - 2)*g2^2/(18*g3) for an integer n, and g2 != 0" in statements
    assert "4*B^3 - B*g2 - g3 = 0" in statements
    for g2, g3, B in (
        (12, -8, 5),
        (12, -8, 2),
        (3, 1, F(-1, 2)),
        (3, 1, 1),
        (0, 0, 0),
        (0, 0, 1),
        (48, 64, -4),
        (4, 0, 1),
    ):
        point = {"g2": g2, "g3": g3, "B": B}
        assert answer.case_at(point) == answer.solve_at(point).case, point


def test_natural_numbers_at_a_point() -> None:
    answer = kovacic.conditions("x^4 + a*x^2 + b*x + c", var="x")
    statement = answer.regions[0].statement
    assert statement.numbers_at(answer.point({"a": 0, "b": 6, "c": 1})) == [2]
    assert statement.numbers_at(answer.point({"a": 0, "b": 5, "c": 1})) == []
    assert statement.numbers_at(answer.point({"a": 0, "b": "sqrt(2)", "c": 1})) == []
    assert statement.latex().startswith(r"b = \pm (2 d + 2)")
    assert pickle.loads(pickle.dumps(answer)) == answer
    data = json.loads(answer.to_json())
    assert data["regions"][0]["determinants"][0] == "Delta_0 = a^2 - 4*c"
    assert "d = +-(2*m + 2), m in N, and" in str(kovacic.conditions("x^4 + n*x^2 + d*x + k"))  # not N in N


@parametrize(
    ("S", "number", "known"),
    [
        # The exponents are rational only over Q(t) with the square root of -c2.
        (LITERATURE["spheroidal"], 1, {"m - 2": "L^2 - 2*L + 4*c2", "m + 2": "L^2 - 2*L + 4*c2"}),
        (LITERATURE["doubly confluent Heun"], 0, {"a*d + 2*a + b": "8*a + 4*c - d^2 - 2*d"}),
        (LITERATURE["sextic with a centrifugal term"], 2, {"a + 2*l + 9": "c^2 - 16*l - 24"}),
        (LITERATURE["sextic with a centrifugal term"], 1, {"a + 2*l + 7": "(c, l + 1)"}),
    ],
    ordinary=0,
    long=1,
)
def test_determinants_of_the_literature(S: str, number: int, known: dict[str, str]) -> None:
    answer = kovacic.conditions(S, var="x")
    found = {
        str(determinant.exponents).replace("**", "^"): str(determinant) for determinant in answer.determinant(number)
    }
    assert known.items() <= found.items()
    assert answer.check(30)


@pytest.mark.long
def test_rows_that_are_multiples_of_others_are_left_out() -> None:
    """Then one polynomial, not a system of equal ones, tells where P exists: Judd's solutions of Rabi's model."""
    S = (
        "(-4*L*x^2 + 4*L*x + 16*N^2*x^2 - 16*N^2*x + 4*N^2 + 4*N*g*x^3 - 8*N*g*x^2 + 4*N*g*x + 4*N*x + g^2*x^4 - 2*g^2*x^3 "
        "+ g^2*x^2 - 2*g*x^3 + 4*g*x^2 - 2*g*x - x^2 + 2*x - 1)/(4*x^2*(x - 1)^2)"
    )
    answer = kovacic.conditions(S, var="x", limits=Limits(seconds=60))
    assert answer.complete is True
    assert {"L - g - 4", "L - 3"} <= {str(determinant) for determinant in answer.determinant(0)}
    report = answer.check(30)
    assert report, report.disagreements


@pytest.mark.long
def test_points_of_a_rational_curve() -> None:
    answer = kovacic.conditions("(n^2-m^3)*x^4 + n*x + m", var="x")
    assert answer.complete is True
    for n, m in ((1, 1), (0, 0), (8, 4), (-8, 4), (1, 2)):
        assert answer.case_at({"n": n, "m": m}) == answer.solve_at({"n": n, "m": m}).case
    assert answer.check(60)


@pytest.mark.long
def test_each_stratum_is_examined_once() -> None:
    """Three moving simple poles: what lies on a hypersurface before isn't said again."""
    answer = kovacic.conditions("a/(x-p) + b/(x-q) + c/(x-r)", var="x", max_degree=0)
    assert answer.complete is True
    assert answer.check(30)
    before: set[str] = set()
    for region in answer.regions:
        parts = region.statement.text().split(", and ")
        assert not before & set(parts[1:])
        before |= {parts[0]} if len(parts) == 1 else set()


@pytest.mark.long
def test_exponents_are_summed_where_equations_are_long() -> None:
    """Regge and Wheeler's equation: no condition asks for a number that isn't said."""
    regge = "(l*(1 - 1/x)*(l + 1)/x^2 - w^2 + (1 - s^2)*(1 - 1/x)/x^3)/(1 - 1/x)^2"
    answer = kovacic.conditions(regge, var="x", max_degree=0)
    assert "d + 1 = +-sqrt(4*s^2 - 3)/2 +- sqrt(-4*w^2 + 1)/2 +- w*I, d in N" in str(answer)
    assert "its linear system decides" in str(answer)
    _, wrong = misread(answer, 4)
    assert not wrong


@pytest.mark.slow
def test_more_sums_of_exponents_than_are_listed() -> None:
    """Four regular points with irrational differences: 7^4 sums for an invariant of degree 12."""
    heun = "a/x^2 + b/(x-1)^2 + c/(x-2)^2 + e/(x*(x-1)) + q/(x*(x-1)*(x-2))"
    answer = kovacic.conditions(heun, var="x", max_degree=0)
    assert answer.complete is True
    assert "`" not in str(answer)
    assert "an invariant of degree 12" in answer.regions[-1].statement.text()
    assert Conditions.from_json(answer.to_json()) == answer
    assert answer.check(10)


@pytest.mark.parametrize(
    ("V", "field"), [pytest.param("a*exp(2*x) - E", "C(exp(2*x))", marks=pytest.mark.long), ("x^n", "C(x^(n + 2))")]
)
def test_cases_are_those_over_the_field_that_is_said(V: str, field: str) -> None:
    answer = kovacic.conditions(V, var="x")
    # x^n is 1/x^2 for n = -2: it is the coordinate that isn't one there.
    assert [region.group for region in answer.regions if not region.defined] == [
        "t = x^(n + 2) is constant there: assume this value"
    ] * (V == "x^n")
    assert f"cases and groups over {field}" in str(answer)
    assert json.loads(answer.to_json())["equation"]["change"]["field"] == field
    assert f"Cases and groups are those of the normal form over {field}." in answer.theorem()
    assert Conditions.from_json(answer.to_json()) == answer


@pytest.mark.long
def test_exponents_at_conjugate_points_are_sums_of_roots() -> None:
    """Scarf's hyperbolic potential: (A + 1/2 +- I B)^2 at t = +-I."""
    scarf = "(B^2 - A*(A+1))/cosh(x)^2 + B*(2*A+1)*sinh(x)/cosh(x)^2 - E"
    answer = kovacic.conditions(scarf, var="x", max_degree=0)
    assert "two of 2*sqrt(-E), (2*A + 1)/2 + B*I, (2*A + 1)/2 - B*I are half-integers" in str(answer)
    assert answer.check(20)


def test_pi_of_sympy_is_that_of_a_text() -> None:
    """Read in x, in which the coefficient is rational."""
    z, a = sympy.symbols("x a")
    assert str(kovacic.conditions(sympy.pi * z**2 + a, var=z)) == str(kovacic.conditions("pi*x^2 + a", var="x"))


@parametrize(
    ("S", "unsaid"),
    [
        ("a/x + b/x^2 + c + x^2", {"b": 0, "a": 1, "c": 2}),
        ("x^6 + a*x^2 + c + l*(l+1)/x^2", {"l": -1, "a": 4, "c": 1}),
        ("-E - a/x + l*(l+1)/x^2 + x", {"l": 0, "E": 1, "a": 1}),
        ("A/x + B/(x-1) + 1/4", {"A": 0, "B": "1/2"}),
        ("-2*E - 2*Z/x + l*(l+1)/x^2", {"E": 0, "Z": 1, "l": 1}),
    ],
    ordinary=(2,),
)
def test_no_region_says_what_holds_otherwise(S: str, unsaid: dict[str, object]) -> None:
    """A theorem lists where there are solutions: "b = 0: none" isn't said, since no case with a solution is about it."""
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert all(region.case is not None for region in answer.regions)
    assert answer.region_at(unsaid) is None
    assert answer.case_at(unsaid) is None
    assert answer.solve_at(unsaid).case is None


def test_a_needed_exclusion_is_said() -> None:
    """B = 0 gives case 2 for half of Lame's equation, but not where g2^3 = 27 g3^2: that region stays."""
    S = "(-16*B*g2*x - 16*B*g3 + 64*B*x^3 - 3*g2^2 - 36*g2*x^2 - 108*g3*x)/(16*(-g2*x - g3 + 4*x^3)^2)"
    answer = kovacic.conditions(S, var="x")
    texts = [str(region.statement) for region in answer.regions]
    assert texts[0] == "g2 = 0, and g3 = 0, and B = 0"
    assert "g2^3 = 27*g3^2" in texts
    assert answer.case_at({"B": 0, "g2": 3, "g3": 1}) == 1
    assert answer.case_at({"B": 0, "g2": 3, "g3": 2}) == 2
    assert answer.case_at({"B": 1, "g2": 12, "g3": 8}) is None


@pytest.mark.long
def test_two_pairs_of_conjugate_poles_are_used() -> None:
    """Over a field of degree 4 beside the parameter the exponents leave no polynomial but for a = 0."""
    found = kovacic.conditions("-3/(4*(x^2+1)^2) + a/((x^2+1)*(x^2+2))")
    assert found.complete
    assert [str(region.statement) for region in found.regions] == ["a = 0"]


@pytest.mark.parametrize(
    "S", ["a*(a-1)/x^2 + 2*a*b/x + e", "l*(l+1)/sin(x)^2 - e", "exp(2)*a/x^2 - b", "a/x^2 + b/x + e*pi"]
)
def test_no_condition_is_solved_for_e(S: str) -> None:
    """e is a number that isn't rational: neither e = n^2/4 nor e = 0 is a condition."""
    answer = kovacic.conditions(S, var="x", max_degree=0)
    assert not re.search(r"(exp\(\d\)|pi)(\^\d)? (!?=)| or 2\*sqrt\(exp\(1\)\) is", answer.text())
    assert Conditions.from_json(answer.to_json()).text() == answer.text()


@parametrize(
    ("S", "root"),
    product(["{0}*a^2/x^2 + {0}*b/x - c", "{0}*a*x^2 + b + c/x^2"], ["sqrt(2)", "sqrt(5)", "i"]),
    ordinary=(0,),
    long=1,
)
def test_conditions_with_a_root_in_them_are_sums_of_roots(S: str, root: str) -> None:
    """beta +- Delta = n, not the equation of degree 4 for n, also where the squares are squares over Q(t, sqrt(2)) alone."""
    answer = kovacic.conditions(S.format(root), var="x", max_degree=0)
    assert "n^4" not in answer.text()
    assert " +- " in answer.text()
    assert answer.check(30)


@pytest.mark.parametrize(
    "name", [pytest.param("L", marks=pytest.mark.long), "lam", pytest.param("a", marks=pytest.mark.long)]
)
def test_the_spectrum_of_a_homogeneous_potential_is_written_alike_for_all_names(name: str) -> None:
    """p + k p (p - 1)/2 [Yoshida 1987], and for k = 5 p (5 p - 3)/2, whatever the order of the parameters is."""
    S = f"z*(1-z)*y''+((k-1)/k-(3*k-2)/(2*k)*z)*y'+{name}/(2*k)*y=0"
    general = kovacic.conditions(S, var="z", max_degree=0)
    assert f"{name} = n + k*n*(n - 1)/2 for an integer n: case 1" in general.text()
    fifth = kovacic.conditions(S, var="z", max_degree=0, assume={"k": 5})
    assert f"{name} = n*(5*n - 3)/2 for an integer n: case 1" in fifth.text()


@parametrize(("b", "options"), [("1", {"max_degree": 0}), ("b", {})], ordinary=(0,))
def test_determinants_of_simple_poles_know_the_value_of_a_constant(b: str, options: dict[str, int]) -> None:
    """y = (x^2 + b) exp(x/(2 sqrt 2)) for a = 2, c = 1/8 and all b."""
    (first, *_) = kovacic.conditions(f"(a + sqrt(2)*x)/(x^2 + {b}) + c", var="x", **options).regions[-1].determinants
    assert first == f"Delta_0 = a - 2 where c = 1/8; a^2 + 2{'*b' if b == 'b' else ''} where c = 1/2"


def test_determinants_know_the_value_of_a_constant() -> None:
    """y = exp(-x^4/4 - sqrt(2) x^2/4)."""
    sextic = kovacic.conditions("x^6 + sqrt(2)*x^4 + a*x^2 + b", var="x").regions[-1]
    assert sextic.determinants[0] == "Delta_0 = 2*b + sqrt(2) where a = -5/2; 2*b - sqrt(2) where a = 7/2"
    assert str(sextic.solution(0)[0]).startswith("y = exp(-x^4/4 - sqrt(2)*x^2/4) where a = -5/2")
    # Where the exponents and the constant need one extension, nothing is claimed.  In the second equation sqrt(2) is the only
    # name that could be eliminated, but x exp(w x^2/2 + c x/(2 w)), w = 2^(1/4), is a solution for d = 0.
    for S in ("sqrt(2) + a/x + b/x^2 + c*x^2", "a/x + b + c*x + sqrt(2)*x^2"):
        both = kovacic.conditions(S, var="x", max_degree=0).regions[-1]
        assert both.determinants[0].startswith("Delta_0 is not written out")

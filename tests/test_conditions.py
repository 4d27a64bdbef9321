"""For which values of the parameters?  Theorems against known answers, and every region against the engine."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy

import kovacic
from kovacic.limits import Limits
from kovacic.parametric.api import Conditions
from kovacic.parametric.partition import Verdict
from kovacic.parametric.riemann import kimura
from kovacic.solution import Structure
from tests.parametric_cases import FAMILIES, Family

F = Fraction


@pytest.fixture(scope="module")
def answers() -> dict[str, Conditions]:
    return {family.name: kovacic.conditions(family.S, var="x") for family in FAMILIES}


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_known_conditions_are_found_and_proven_complete(family: Family, answers: dict[str, Conditions]) -> None:
    answer = answers[family.name]
    assert answer.complete is True
    assert set(answer.parameters) == set(family.parameters)
    for values in family.points:
        point = dict(zip(family.parameters, values, strict=True))
        assert answer.case_at(point) == family.expected(*values), point


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_two_hundred_exact_points_agree_with_the_engine(family: Family, answers: dict[str, Conditions]) -> None:
    report = answers[family.name].check(200)
    assert report, report.disagreements
    assert report.inside >= 20
    assert report.outside >= 20
    assert report.inside + report.outside >= 200


def test_a_wrong_region_is_noticed(answers: dict[str, Conditions]) -> None:
    answer = answers["bessel"]
    wrong = replace(answer.regions[0], verdict=Verdict(Structure.IMPRIMITIVE))
    assert not replace(answer, regions=(wrong,)).check(20)
    assert not replace(answer, regions=()).check(200) or not replace(
        answer, generic=Verdict(wrong.verdict.structure)
    ).check(20)


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


def test_schwarz_table_has_the_parities() -> None:
    assert kimura((F(2, 3), F(1, 3), F(1, 3))) is Structure.TETRAHEDRAL
    assert kimura((F(2, 3) + 1, F(1, 3), F(1, 3))) is None
    assert kimura((F(2, 5), F(2, 5), F(2, 5))) is Structure.ICOSAHEDRAL
    assert kimura((F(2, 5), F(2, 5), F(7, 5))) is None
    assert kimura((F(1, 2), F(5, 2), None)) is Structure.IMPRIMITIVE
    assert kimura((None, F(1, 3), F(1, 3))) is None


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
    assert answer.check(60)


def test_sextic_oscillator_up_to_a_degree() -> None:
    """Quasi-exactly solvable: a determinant for each degree, and no claim beyond the degree that was examined."""
    answer = kovacic.conditions("x^6 + a*x^2 + b", var="x", max_degree=3)
    assert isinstance(answer.complete, str)
    assert "up to degree 3" in answer.complete
    assert answer.case_at({"a": -7, "b": sympy.sqrt(8)}) == 1
    assert answer.case_at({"a": -7, "b": 1}) is None
    assert answer.case_at({"a": -3, "b": 0}) == 1
    found = {str(region.statement): region.case for region in answer.regions}
    assert found["a + 7 = 0, and b^2 - 8 = 0"] == 1
    report = answer.check(60)
    assert report, report.disagreements
    assert report.open > 0


def test_algebraic_points(answers: dict[str, Conditions]) -> None:
    assert answers["chebyshev"].case_at({"n": sympy.sqrt(2)}) == 2
    assert answers["whittaker"].case_at({"k": sympy.sqrt(2), "m": sympy.Rational(1, 2) - sympy.sqrt(2)}) == 1
    assert answers["whittaker"].case_at({"k": "sqrt(2)", "m": "1/2 + sqrt(2)"}) == 1
    assert answers["whittaker"].case_at({"k": "sqrt(2)", "m": "1/2"}) is None


def test_a_polynomial_of_degree_two_in_all_its_coefficients() -> None:
    answer = kovacic.conditions("a*x^2 + b*x + c", var="x")
    assert answer.complete is True
    assert answer.case_at({"a": 1, "b": 0, "c": 3}) == 1
    assert answer.case_at({"a": 1, "b": 2, "c": 4}) == 1
    assert answer.case_at({"a": 1, "b": 2, "c": 3}) is None
    assert answer.case_at({"a": 0, "b": 1, "c": 3}) is None
    assert answer.case_at({"a": 0, "b": 0, "c": 3}) == 1
    assert answer.check(200)


def test_a_pole_of_high_order_is_moved_to_infinity() -> None:
    answer = kovacic.conditions("(x^2 + mu*(x-t)^2)/(x-t)^6", var="x")
    assert answer.complete is True
    assert answer.check(100)


def test_assumptions_leave_out_what_cannot_happen() -> None:
    bessel = kovacic.conditions("(4*n^2-1)/(4*x^2) - 1", assume={"n": "integer"}, var="x")
    assert not bessel.regions
    assert bessel.generic.case is None
    legendre = kovacic.conditions(
        "((n^2+n)*x^2 - n^2 - n - 1)/(x^2-1)^2", assume={sympy.Symbol("n"): "integer"}, var="x"
    )
    assert not legendre.regions
    assert legendre.generic.case == 1
    weber = kovacic.conditions("x^2 + mu", assume={"mu": "integer"}, var="x")
    assert len(weber.regions) == 1
    with pytest.raises(kovacic.InputError):
        kovacic.conditions("x^2 + mu", assume={"mu": "prime"}, var="x")
    with pytest.raises(kovacic.InputError):
        kovacic.conditions("x^2 + mu", assume={"nu": "integer"}, var="x")


def test_views(answers: dict[str, Conditions]) -> None:
    answer = answers["whittaker"]
    data = json.loads(answer.to_json())
    assert data["parameters"] == ["k", "m"]
    assert data["generic"]["case"] is None
    assert data["regions"][0]["condition"] == "k + m - 1/2 in Z or k - m - 1/2 in Z"
    assert data["regions"][0]["complete"] is True
    assert "otherwise: no Liouvillian solution" in str(answer)
    assert r"\mathbb{Z}" in answer.latex()
    assert pickle.loads(pickle.dumps(answer)) == answer


def test_a_map_of_two_parameters(answers: dict[str, Conditions]) -> None:
    pytest.importorskip("matplotlib")
    axes = answers["whittaker"].plot(ranges=((-1, 1), (-1, 1)), steps=4)
    mesh = axes.collections[0].get_array().reshape(5, 5).tolist()
    # k, m in {-1, -1/2, 0, 1/2, 1}: solvable where k + m - 1/2 or k - m - 1/2 is an integer.
    assert mesh[0] == [0, 1, 0, 1, 0]
    assert mesh[1] == [1, 0, 1, 0, 1]
    with pytest.raises(kovacic.InputError, match="two parameters"):
        answers["bessel"].plot()


def test_wrong_input_and_limits() -> None:
    with pytest.raises(kovacic.InputError, match="no parameters"):
        kovacic.conditions("x^2 + 3")
    with pytest.raises(kovacic.InputError, match="values are needed"):
        kovacic.conditions("x^2 + mu", var="x").case_at({"nu": 1})
    with pytest.raises(kovacic.LimitExceeded, match="parameters"):
        kovacic.conditions("a*x + b", var="x", limits=Limits(parameters=1))
    partial = kovacic.conditions("x^6 + a*x^2 + b", var="x", limits=Limits(seconds=0.3))
    assert isinstance(partial.complete, str)
    assert "limits" in partial.complete


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


@pytest.mark.parametrize("S", MORE)
def test_other_families_agree_with_the_engine(S: str) -> None:
    answer = kovacic.conditions(S, var="x", max_degree=2)
    report = answer.check(40)
    assert report, report.disagreements
    assert answer.complete is True or "not proven" in str(answer.complete)


def test_the_answer_at_a_point_has_its_omega(answers: dict[str, Conditions]) -> None:
    answer = answers["quartic"].solve_at({"mu": 2})
    assert answer.verified
    assert str(answer.omega) in {"-x**2", "x**2", "(x**3 + 1)/x", "(-x**3 + 1)/x"}
    assert "deg P" in str(answers["quartic"].regions[0].omega)


def test_integer_symbols_of_sympy() -> None:
    n, x = sympy.Symbol("n", integer=True), sympy.Symbol("x")
    assert not kovacic.conditions((4 * n**2 - 1) / (4 * x**2) - 1).regions


def test_command(capsys: pytest.CaptureFixture[str]) -> None:
    from kovacic.cli.main import run

    assert run(["conditions", "--check", "20", "x^4 + mu*x"]) == 0
    assert "mu = 2, 4 mod 6: case 1" in capsys.readouterr().out
    assert run(["conditions", "--json", "--var", "x", "(4*n^2-1)/(4*x^2) - 1"]) == 0
    assert json.loads(capsys.readouterr().out)["regions"][0]["condition"] == "n - 1/2 in Z"
    assert run(["conditions", "x^2 + 3"]) == 2
    assert "no parameters" in capsys.readouterr().err


def test_an_equation_in_place_of_S() -> None:
    answer = kovacic.conditions("(1-x^2)*y'' - 2*x*y' + n*(n+1)*y = 0")
    assert [str(region.statement) for region in answer.regions] == ["n in Z"]

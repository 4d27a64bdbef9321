"""Symmetric equations: the conditions of the quotient, and the case of the equation itself."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from build import parametrize

import kovacic

F = Fraction
LAME = "((4*n^2 + 4*n - 3)*x^4 + (-4*n^2 - 4*n - 6)*x^2 - 3)/(16*x^6 - 32*x^4 + 16*x^2)"
EQUIANHARMONIC = "((4*n^2 + 4*n - 3)*x^4 + (-4*n^2 - 4*n - 24)*x)/(16*x^6 - 32*x^3 + 16)"


def pulled_back(n: int, p: str, q: str, r: str) -> str:
    """The equation in x, z = x^n, whose quotient has these exponent differences at z = 0, 1, infinity."""
    S = f"(-(1-({p})^2)/(4*z^2)-(1-({q})^2)/(4*(z-1)^2)-(({p})^2+({q})^2-({r})^2-1)/(4*z*(z-1)))".replace(
        "z", f"(x^{n})"
    )
    return f"{n}^2*x^{2 * n - 2}*({S}) + ({n}^2-1)/(4*x^2)"


def moved(S: str, m: str) -> str:
    """The equation in x for the one in m(x)."""
    function = sympy.sympify(S.replace("^", "**"), rational=True)
    change = sympy.sympify(m, rational=True)
    x = sympy.Symbol("x")
    return str(sympy.factor(function.subs(x, change) * change.diff(x) ** 2)).replace("**", "^")


def lines(S: str) -> list[str]:
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    return [line.strip() for line in answer.text().splitlines()[1:-2]]


@pytest.mark.long
def test_lame_on_the_lemniscatic_and_the_equianharmonic_curve() -> None:
    """B = 0 with g3 = 0 and with g2 = 0; n in 1/2 + N by Brioschi and Halphen, the finite groups by Baldassarri 1981."""
    assert lines(LAME) == ["n in Z: case 1", "n = 1/2 mod 2: case 2", "n = 1/6, 5/6 mod 2: case 3"]
    assert lines(EQUIANHARMONIC) == [
        "n = 0, 2 mod 3: case 1",
        "n = 1/2, 1, 3/2 mod 3: case 2",
        "n = 1/10, 1/4, 7/10, 13/10, 7/4, 19/10 mod 3: case 3",
    ]
    for n, case in ((F(40), 1), (F(-83, 2), 2), (F(1, 6) + 40, 3), (F(3, 2), None), (F(1, 3), None)):
        assert kovacic.conditions(LAME, var="x").case_at({"n": n}) == case


@parametrize(
    ("n", "differences"),
    [
        (2, ("p", "q", "r")),
        (3, ("p", "q", "r")),
        (4, ("p", "1/2", "r")),
        (3, ("p", "1/2", "1/3")),
        (3, ("1/3", "1/3", "r")),
        (2, ("1/4", "1/3", "r")),
        (2, ("1/2", "1/2", "r")),
        (6, ("1/3", "1/2", "r")),
    ],
    ordinary=1,
    long=1,
)
def test_the_case_of_the_equation_itself_agrees_with_the_engine(n: int, differences: tuple[str, str, str]) -> None:
    answer = kovacic.conditions(pulled_back(n, *differences), var="x")
    assert answer.complete is True
    report = answer.check(40)
    assert report, report.disagreements
    assert report.open == 0


@pytest.mark.long
def test_the_groups_over_the_quotient_split() -> None:
    """Half-integers at 0 and infinity: reducible over C(sqrt z); a tetrahedral group over C(z^(1/3)): the quaternions."""
    quadratic = kovacic.conditions(pulled_back(2, "p", "q", "r"), var="x")
    assert quadratic.case_at({"p": F(1, 2), "q": F(1, 7), "r": F(3, 2)}) == 1
    assert quadratic.case_at({"p": F(1, 2), "q": F(1, 2), "r": F(1, 7)}) == 2
    cubic = kovacic.conditions(pulled_back(3, "p", "q", "r"), var="x")
    assert cubic.case_at({"p": F(1, 3), "q": F(1, 2), "r": F(2, 3)}) == 2
    assert cubic.case_at({"p": F(1, 3), "q": F(2, 3), "r": F(1, 3)}) == 3  # all three are branch points
    region = cubic.region_at({"p": F(1, 3), "q": F(1, 2), "r": F(2, 3)})
    assert region is not None
    assert region.group == "the quaternion group"


@pytest.mark.long
def test_the_centre_of_symmetry_is_found() -> None:
    moved = pulled_back(2, "p", "q", "r").replace("x", "(x-3)")
    answer = kovacic.conditions(moved, var="x")
    assert answer.complete is True
    assert "(x - 3)^2" in answer.theory
    assert answer.check(30)


@parametrize(
    "m", ["1/(x - 2)", "(2*x + 1)/(x - 3)", "1/x", "(x - 1)/(x + 1)", "(x - 1/2)/(3*x + 5)"], ordinary=1, long=1
)
@pytest.mark.parametrize("S", [LAME, EQUIANHARMONIC])
def test_moebius_maps_change_nothing(S: str, m: str) -> None:
    """The symmetry x -> zeta x is another Moebius map in another coordinate; the conditions and the engine's cases agree."""
    answer = kovacic.conditions(moved(S, m), var="x")
    assert answer.complete is True
    assert [str(region) for region in answer.regions] == [
        str(region) for region in kovacic.conditions(S, var="x").regions
    ]
    report = answer.check(30)
    assert report, report.disagreements
    assert report.open == 0


def test_heun_with_two_equal_exponents() -> None:
    """z = (x/(x - 1))^2: the differences are 2 l at 0, 2 m at 1, and p at infinity and at 1/2, which a map exchanges."""
    S = moved(pulled_back(2, "l", "p", "m"), "x/(x - 1)")
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    assert "Kimura" in answer.theory
    for values, case in (
        ({"l": F(1, 3), "p": F(1, 5), "m": F(23, 15)}, 1),
        ({"l": F(1, 3), "p": F(1, 5), "m": F(22, 15)}, None),
        ({"l": F(1, 2), "p": F(1, 2), "m": F(1, 7)}, 2),
        ({"l": F(1, 2), "p": F(1, 3), "m": F(1, 4)}, 3),
    ):
        assert answer.case_at(values) == answer.solve_at(values).case == case


def test_three_square_roots_are_written_as_such() -> None:
    answer = kovacic.conditions("(a*x^4+b*x^2+c)/(x^2*(x^2-1)^2)", var="x")
    first = str(answer.regions[0].statement)
    assert first == "sqrt(4*a + 1)/2 +- sqrt(4*c + 1)/2 +- sqrt(a + b + c + 1) is an odd integer"

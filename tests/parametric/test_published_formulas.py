"""Conditions beside the formulas of the literature: what is printed, and the formula's own points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import pytest
from build import parametrize
from parametric_cases import hypergeometric, with_squares

import kovacic

F = Fraction


@dataclass(frozen=True)
class Published:
    """S, its condition as printed, the case, the formula of the source and where it puts the parameters for small integers."""

    name: str
    S: str
    printed: str
    case: int
    formula: str
    point: Callable[[int, int], dict[str, Any]]
    source: str


def yoshida(k: int) -> str:
    return with_squares(str(F(1, k * k)), "1/4", f"(({(k - 2) ** 2} + {8 * k}*L)/{4 * k * k})")


TABLE = [
    Published(
        "Coulomb",
        "-2*E - 2*Z/x + l*(l+1)/x^2",
        "E = -Z^2/(2*(n - l)^2) (Z = 0 where n = l) for an integer n",
        1,
        "E = -Z^2/(2 n^2), n - l - 1 in N",
        lambda n, l: {"E": -F(9, 2 * (n + l + 1) ** 2), "Z": 3, "l": l},  # noqa: E741
        "Bohr; Schroedinger 1926",
    ),
    Published(
        "oscillator",
        "x^2 - E + l*(l+1)/x^2",
        "E = 4*n - 2*l + 1 or E = 4*n + 2*l + 3 for an integer n",
        1,
        "E = 4 n + 2 l + 3",
        lambda n, l: {"E": 4 * n + 2 * l + 3, "l": l},  # noqa: E741
        "Fluegge, Practical Quantum Mechanics 65",
    ),
    Published(
        "one-dimensional oscillator",
        "x^2 - E",
        "E is an odd integer",
        1,
        "E = 2 n + 1",
        lambda n, _: {"E": 2 * n + 1},
        "Kovacic 1986; Heisenberg 1925",
    ),
    Published(
        "Morse",
        "A^2 - 2*A*b/x - (E + 1/4)/x^2",
        "E = -(n - 2*b)^2/4 for an odd integer n",
        1,
        "E = -(b - n - 1/2)^2",
        lambda n, b: {"A": 2, "b": b, "E": -((b - n - F(1, 2)) ** 2)},
        "Morse 1929",
    ),
    Published(
        "Rosen-Morse",
        "-(1-(-E-b))/(4*x^2)-(1-(-E+b))/(4*(x-1)^2)-((-E-b)+(-E+b)-(2*l+1)^2-1)/(4*x*(x-1))",
        "E = -(n - l)^2 - b^2/(4*(n - l)^2) (b = 0 where n = l) for an integer n",
        1,
        "E = -(l - n)^2 - b^2/(4 (l - n)^2)",
        lambda n, l: {"E": -F((l + n + 1) ** 2) - F(4, 4 * (l + n + 1) ** 2), "b": 2, "l": l},  # noqa: E741
        "Rosen & Morse 1932; Infeld & Hull 1951",
    ),
    Published(
        "Hulthen",
        "-(1-(-E))/(4*(x-1)^2)*0+((-E+V-1)*x-V)/(4*x*(x-1)^2)",
        "E = -(4*n^2 - V)^2/(16*n^2) (V = 0 where n = 0) for an integer n",
        1,
        "E = -((V - N^2)/(2 N))^2, N even",
        lambda n, v: {"E": -(F(v - 4 * (n + 1) ** 2, 4 * (n + 1)) ** 2), "V": v},
        "Fluegge, Practical Quantum Mechanics 68",
    ),
    Published(
        "Poeschl-Teller",
        "-(1-(-E))/(4*x^2)-(1-(-E))/(4*(x-1)^2)-(2*(-E)-(2*l+1)^2-1)/(4*x*(x-1))",
        "l in Z, or E = -(n - l)^2 for an integer n",
        1,
        "sqrt(-E) = l - n",
        lambda n, l: {"E": -F((l + n + 1) ** 2), "l": l},  # noqa: E741
        "Poeschl & Teller 1933",
    ),
    Published(
        "Bessel",
        "(4*n^2-1)/(4*x^2) - 1",
        "n - 1/2 in Z",
        1,
        "n - 1/2 in Z",
        lambda n, _: {"n": n + F(1, 2)},
        "Kovacic 1986",
    ),
    Published(
        "Whittaker",
        "1/4 - k/x + (4*m^2-1)/(4*x^2)",
        "k + m - 1/2 in Z or k - m - 1/2 in Z",
        1,
        "k +- m - 1/2 in Z",
        lambda n, k: {"k": k + F(1, 3), "m": n + F(1, 6)},
        "Martinet & Ramis 1989",
    ),
    Published(
        "Weber",
        "x^2/4 + a",
        "a - 1/2 in Z",
        1,
        "a + 1/2 in Z",
        lambda n, _: {"a": n + F(1, 2)},
        "Duval & Loday-Richaud 1992",
    ),
    Published(
        "Whittaker with its squares",
        "a + b/x + c/x^2",
        "sqrt(4*c + 1) +- b/sqrt(a) is an odd integer",
        1,
        "b/sqrt(a) +- sqrt(1 + 4 c) odd",
        lambda n, m: {"a": 4, "b": 2 * (2 * n + 1 + m), "c": F(m * m - 1, 4)},
        "Acosta-Humanez & Blazquez-Sanz 2008",
    ),
    Published(
        "quadratic polynomial",
        "a*x^2 + b*x + c",
        "(4*a*c - b^2)/(4*a*sqrt(a)) is an odd integer",
        1,
        "(b^2 - 4 a c)/(4 a^(3/2)) odd",
        lambda n, m: {"a": 1, "b": 2 * m, "c": m * m + 2 * n + 1},
        "Acosta-Humanez & Blazquez-Sanz 2008",
    ),
    Published(
        "Legendre",
        "(n*(n+1)*x^2 - n^2 - n - 1)/(x^2-1)^2",
        "n in Z",
        1,
        "n in Z",
        lambda n, _: {"n": n},
        "Kimura 1969",
    ),
    *(
        Published(
            f"homogeneous potential of degree {k}",
            yoshida(k),
            printed,
            1,
            "L = p + k p (p - 1)/2",
            lambda p, _, k=k: {"L": p + F(k * p * (p - 1), 2)},
            "Yoshida 1987; Morales-Ruiz & Ramis 2001",
        )
        for k, printed in (
            (3, "L = (3*n^2 - n)/2 for an integer n"),
            (5, "L = n*(5*n - 3)/2 for an integer n"),
            (-3, "L = -n*(3*n - 5)/2 for an integer n"),
            (-5, "L = -n*(5*n - 7)/2 for an integer n"),
        )
    ),
    Published(
        "homogeneous potential of degree k",
        with_squares("1/k^2", "1/4", "((k-2)^2+8*k*L)/(4*k^2)"),
        "L = n + k*n*(n - 1)/2 for an integer n",
        1,
        "L = p + k p (p - 1)/2",
        lambda p, k: {"k": k + 3, "L": p + F((k + 3) * p * (p - 1), 2)},
        "Yoshida 1987",
    ),
    Published(
        "homogeneous potential of degree 4, case 3",
        yoshida(4),
        "L = 2*n^2/9 - 1/8 for an integer n not divisible by 3",
        3,
        "L = -1/8 + 2/9 (1 + 3 p)^2",
        lambda p, _: {"L": -F(1, 8) + F(2, 9) * (1 + 3 * p) ** 2},
        "Morales-Ruiz & Ramis 2001",
    ),
    Published(
        "quartic polynomial",
        "x^4 + a*x^2 + b*x + c",
        "b = +-(2*d + 2), d in N, and Delta_d = 0",
        1,
        "b = +-2 (n + 1), and a determinant",
        lambda _, a: {"a": 2 * a, "b": 2, "c": a * a},
        "Acosta-Humanez, Blazquez-Sanz & Venegas-Gomez",
    ),
    Published(
        "Schwarz: three equal angles",
        hypergeometric(("l", "l", "l")),
        "l = +-2/5, +-2/3, +-4/5 mod 2",
        3,
        "rows 3 and 11 modulo signs and integers, with the parity",
        lambda n, _: {"l": 2 * n + F(2, 5)},
        "Schwarz 1873; Kimura 1969",
    ),
    Published(
        "Riemann's equation",
        hypergeometric(("l", "m", "n")),
        "two of l, m, n are half-integers",
        2,
        "two of l, m, n in 1/2 + Z",
        lambda n, m: {"l": n + F(1, 2), "m": m - F(3, 2), "n": F(1, 7)},
        "Kimura 1969",
    ),
]


@parametrize("entry", TABLE, ordinary=(11,), long=4, ids=lambda entry: entry.name)
def test_conditions_are_printed_as_in_the_literature(entry: Published) -> None:
    answer = kovacic.conditions(entry.S, var="x")
    assert answer.complete is True
    lines = [line.strip() for line in answer.text().splitlines()]
    assert f"{entry.printed}: case {entry.case}" in lines
    for integers in ((0, 0), (1, 0), (1, 2), (3, 1)):
        point = entry.point(*integers)
        assert answer.case_at(point) == kovacic.decide(_at(entry.S, point), var="x").case == entry.case, point


def _at(S: str, point: dict[str, Any]) -> Any:
    import sympy

    values = {sympy.Symbol(name): sympy.Rational(value) for name, value in point.items()}
    names = {name: sympy.Symbol(name) for name in (*point, "x")}
    return sympy.sympify(S.replace("^", "**"), locals=names).subs(values)


def test_integers_at_which_a_spectrum_has_no_value_are_not_lost() -> None:
    """E = -Z^2/(2 n^2) says nothing for n = 0, and Z = 0 with an integer l is solvable for every E."""
    answer = kovacic.conditions("-2*E - 2*Z/x + l*(l+1)/x^2", var="x")
    assert answer.case_at({"E": 5, "Z": 0, "l": 2}) == 1
    assert answer.case_at({"E": 5, "Z": 0, "l": "1/3"}) is None
    assert "E = -Z^2/(2*(n - l)^2) (Z = 0 where n = l) for an integer n" in answer.text()
    assert "where" not in kovacic.conditions("a*x^8 + mu*x^3", var="x").text()  # n = 4, 6 mod 10 isn't 0


def test_no_row_of_schwarz_has_the_difference_1() -> None:
    assert "Schwarz" not in kovacic.conditions("a/x^2 + b/(x*(x-1))", var="x").text()  # 1 has exponents 0 and 1
    assert "Schwarz" in kovacic.conditions("a/x^2 + b/(x*(x-1)) + c/(x-1)^2", var="x").text()


def test_jacobi_polynomials_have_powers_of_1_minus_x() -> None:
    """As on the interval on which they are orthogonal [DLMF 18.3]."""
    answer = kovacic.conditions("x*(1-x)*y'' + (c-2*x)*y' - m*y = 0", var="x")
    powers = {str(s).partition("*jacobi")[0] for region in answer.regions for s in region.solution()}
    assert {"y = (1 - x)^(c - 1)", "y = x^(1 - c)*(1 - x)^(c - 1)"} <= powers


def test_constants_are_never_solved_for() -> None:
    for S in ("sqrt(2)*x^2 + a^2 + b/x^2", "(a*sqrt(2)+1)*x^2+a*x+b", "sqrt(2)*x^2 + a^2"):
        answer = kovacic.conditions(S, var="x")
        assert answer.complete is True
        assert not any(line.strip().startswith("sqrt(2) =") for line in answer.text().splitlines())
        assert "sqrt(2)^" not in answer.text()


@pytest.mark.long
def test_a_screen_of_regions() -> None:
    answer = kovacic.conditions("c*x^2/(x-a)^2 + b/(x*(x-1))", var="x", max_degree=0)
    everything = answer.text(all=True)
    assert len(str(answer).splitlines()) <= 30
    assert len(everything.splitlines()) >= len(str(answer).splitlines())


@parametrize("S", ["(a*b*x^2 - a)/(x^2 - sqrt(2)*a)^2", "((a^2 - b^2)*x^2 + a)/(x^2 - I*b)^2"], ordinary=0, long=1)
def test_a_denominator_that_is_a_square_because_of_a_constant(S: str) -> None:
    """x^4 - 2 a s x^2 + 2 a^2 is a square for s = sqrt(2) alone; the answer is complete, and s^2 is 2."""
    answer = kovacic.conditions(S, var="x")
    assert answer.complete is True
    report = answer.check(30)
    assert report, report.disagreements
    assert report.inside
    assert "sqrt(2)^2" not in answer.text().splitlines()[0]
    assert "I^2" not in answer.text().splitlines()[0]


@pytest.mark.parametrize(
    ("S", "printed"),
    [
        pytest.param(
            "(x^2+1)*y'' + 2*x*y' - n*(n+1)*y = 0",
            "y = jacobi(n, 0, 0, -I*x) where n is a natural number",
            marks=pytest.mark.long,
        ),
        pytest.param(
            "(x^2-s)*y'' + 2*x*y' - n*(n+1)*y = 0",
            "y = jacobi(n, 0, 0, x/sqrt(s)) where n is a natural number",
            marks=pytest.mark.long,
        ),
        (
            "(x^2+3*x+1)*y'' - n*(n+1)*y = 0",
            "y = (x^2 + 3*x + 1)*jacobi(n - 1, 1, 1, -sqrt(5)*(-2*x - 3)/5) where n - 1 is a natural number",
        ),
    ],
)
def test_conjugate_points_stand_together(S: str, printed: str) -> None:
    """The polynomials of Legendre at i x [DLMF 14.1], without (x - i)^(1/2) (x + i)^(1/2)/(x^2 + 1)^(1/2)."""
    answer = kovacic.conditions(S, var="x", max_degree=0)
    assert printed in [str(solution) for region in answer.regions for solution in region.solution()]
    assert answer.check(20)
